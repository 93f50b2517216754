// SPDX-License-Identifier: MIT
#include "oracle/ray_oracle.hpp"

#include <embree3/rtcore.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <stdexcept>
#include <thread>

namespace shadowmath::oracle {

namespace {

// NOTE: Embree asks for coordinates below 1.8e18; beyond this nothing here is a scene, and squares still fit a float.
constexpr double largest_coordinate = 1e9;

bool usable(glm::dvec3 v) {
    return std::abs(v.x) < largest_coordinate && std::abs(v.y) < largest_coordinate &&
           std::abs(v.z) < largest_coordinate;
}

// Calls body(begin, end) over [0, count) in blocks, on the given number of threads.
template <class Body>
void in_parallel(std::size_t count, int threads, Body&& body) {
    auto const workers = static_cast<std::size_t>(std::max(1, threads));
    std::vector<std::jthread> running;
    for (std::size_t k = 1; k < workers; ++k)
        running.emplace_back(
            [&body, begin = count * k / workers, end = count * (k + 1) / workers] { body(begin, end); });
    body(std::size_t{0}, count / workers);
}

}  // namespace

double ray_offset(glm::dvec3 point) noexcept {
    double const largest = std::max({std::abs(point.x), std::abs(point.y), std::abs(point.z)});
    return std::max(5e-5, 32.0 * 0x1p-24 * largest);
}

struct RayOracle::Embree {
    RTCDevice device = nullptr;
    RTCScene scene = nullptr;
    std::vector<std::uint32_t> triangles;  // Embree's primitive to the scene's triangle
    glm::dvec3 centre{0.0};
    double radius = 0.0;

    Embree() = default;
    Embree(Embree const&) = delete;
    Embree& operator=(Embree const&) = delete;
    ~Embree() {
        if (scene != nullptr) rtcReleaseScene(scene);
        if (device != nullptr) rtcReleaseDevice(device);
    }

    // Far enough to leave the scene from there: finite, as Embree's asserts demand.
    [[nodiscard]] float reach(glm::dvec3 from) const {
        return static_cast<float>(glm::length(from - centre) + 2.0 * radius + 1.0);
    }
};

RayOracle::RayOracle(backend::Scene const& scene) : embree_(std::make_unique<Embree>()) {
    embree_->device = rtcNewDevice(nullptr);
    if (embree_->device == nullptr) throw std::runtime_error("Embree cannot start");
    embree_->scene = rtcNewScene(embree_->device);
    rtcSetSceneFlags(embree_->scene, RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(embree_->scene, RTC_BUILD_QUALITY_MEDIUM);

    std::vector<std::uint32_t> corners;
    glm::dvec3 lo{std::numeric_limits<double>::max()};
    glm::dvec3 hi{std::numeric_limits<double>::lowest()};
    for (backend::Object const& object : scene.objects) {
        if (!object.casts) continue;
        std::size_t const end = std::min(scene.indices.size(), std::size_t{object.first_index} + object.index_count);
        for (std::size_t i = object.first_index; i + 3 <= end; i += 3) {
            std::span const triple(&scene.indices[i], 3);
            bool const sound = std::ranges::all_of(triple, [&](std::uint32_t k) {
                return k < scene.vertices.size() && usable(scene.vertices[k].position);
            });
            if (!sound) continue;
            embree_->triangles.push_back(static_cast<std::uint32_t>(i / 3));
            for (std::uint32_t const k : triple) {
                corners.push_back(k);
                lo = glm::min(lo, glm::dvec3(scene.vertices[k].position));
                hi = glm::max(hi, glm::dvec3(scene.vertices[k].position));
            }
        }
    }

    if (!corners.empty()) {
        embree_->centre = (lo + hi) * 0.5;
        embree_->radius = glm::length(hi - lo) * 0.5;
        RTCGeometry const mesh = rtcNewGeometry(embree_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* const vertices = static_cast<float*>(rtcSetNewGeometryBuffer(
            mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), scene.vertices.size()));
        auto* const indices = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
            mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), corners.size() / 3));
        if (vertices == nullptr || indices == nullptr) {
            rtcReleaseGeometry(mesh);
            throw std::runtime_error("Embree has no memory for the scene");
        }
        for (std::size_t k = 0; k < scene.vertices.size(); ++k) {
            glm::vec3 const p = usable(scene.vertices[k].position) ? scene.vertices[k].position : glm::vec3(0.0f);
            vertices[3 * k] = p.x;
            vertices[3 * k + 1] = p.y;
            vertices[3 * k + 2] = p.z;
        }
        std::ranges::copy(corners, indices);
        rtcCommitGeometry(mesh);
        rtcAttachGeometry(embree_->scene, mesh);
        rtcReleaseGeometry(mesh);
    }
    rtcCommitScene(embree_->scene);
    if (rtcGetDeviceError(embree_->device) != RTC_ERROR_NONE) throw std::runtime_error("Embree cannot build the scene");
}

RayOracle::~RayOracle() = default;
RayOracle::RayOracle(RayOracle&&) noexcept = default;
RayOracle& RayOracle::operator=(RayOracle&&) noexcept = default;

namespace {

RTCRay ray_from(glm::dvec3 origin, glm::dvec3 direction, float reach) {
    RTCRay ray{};
    ray.org_x = static_cast<float>(origin.x);
    ray.org_y = static_cast<float>(origin.y);
    ray.org_z = static_cast<float>(origin.z);
    ray.dir_x = static_cast<float>(direction.x);
    ray.dir_y = static_cast<float>(direction.y);
    ray.dir_z = static_cast<float>(direction.z);
    ray.tnear = 0.0f;
    ray.tfar = reach;
    ray.mask = ~0u;
    return ray;
}

}  // namespace

Truth RayOracle::truth(glm::dvec3 point, glm::dvec3 normal, glm::dvec4 light) const {
    if (!usable(point)) return Truth::sky;
    glm::dvec3 const light_xyz(light);
    if (!usable(normal) || !usable(light_xyz) || !std::isfinite(light.w)) return Truth::facing_away;
    bool const positional = light.w != 0.0;
    glm::dvec3 const to_light = positional ? light_xyz - point : light_xyz;
    double const distance = glm::length(to_light);
    double const steepness = glm::length(normal);
    if (!(distance > 1e-12) || !(steepness > 1e-12) || !(glm::dot(normal, to_light) > 0.0)) return Truth::facing_away;

    glm::dvec3 const origin = point + normal * (ray_offset(point) / steepness);
    // NOTE: from the lifted origin, the way to a lamp has turned a little.
    glm::dvec3 const way = positional ? light_xyz - origin : to_light;
    double const length = glm::length(way);
    if (!(length > 1e-12)) return Truth::lit;
    // NOTE: a lamp is reached just short of it, so that rounding finds nothing behind it.
    float const reach = positional ? static_cast<float>(length * (1.0 - 0x1p-20)) : embree_->reach(origin);
    RTCRay ray = ray_from(origin, way / length, reach);
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(embree_->scene, &context, &ray);
    return ray.tfar < 0.0f ? Truth::shadowed : Truth::lit;
}

std::vector<std::uint8_t> RayOracle::lit(std::span<glm::dvec3 const> points, std::span<glm::dvec3 const> normals,
                                         glm::dvec4 light, int threads) const {
    std::vector<std::uint8_t> answers(std::min(points.size(), normals.size()));
    in_parallel(answers.size(), threads, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) answers[i] = lit(points[i], normals[i], light) ? 1 : 0;
    });
    return answers;
}

backend::Image<Truth> RayOracle::truth(backend::Image<backend::Texel4> const& position,
                                       backend::Image<backend::Texel4> const& normal, glm::dvec4 light,
                                       int threads) const {
    backend::Image<Truth> answers(position.extent, Truth::sky);
    in_parallel(std::min(position.pixels.size(), normal.pixels.size()), threads,
                [&](std::size_t begin, std::size_t end) {
                    for (std::size_t i = begin; i < end; ++i) {
                        backend::Texel4 const& p = position.pixels[i];
                        backend::Texel4 const& n = normal.pixels[i];
                        if (p.w > -1.5f)
                            answers.pixels[i] = truth(glm::dvec3(p.x, p.y, p.z), glm::dvec3(n.x, n.y, n.z), light);
                    }
                });
    return answers;
}

std::optional<Hit> RayOracle::first_hit(glm::dvec3 origin, glm::dvec3 direction) const {
    double const length = glm::length(direction);
    if (!usable(origin) || !usable(direction) || !(length > 1e-12)) return std::nullopt;
    RTCRayHit query{};
    query.ray = ray_from(origin, direction / length, embree_->reach(origin));
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(embree_->scene, &context, &query);
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    Hit hit;
    hit.distance = static_cast<double>(query.ray.tfar);
    hit.triangle = embree_->triangles[query.hit.primID];
    hit.u = static_cast<double>(query.hit.u);
    hit.v = static_cast<double>(query.hit.v);
    hit.back_face = glm::dot(glm::dvec3(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z), direction) > 0.0;
    return hit;
}

}  // namespace shadowmath::oracle
