// SPDX-License-Identifier: MIT
//
// The irregular z-buffer against Embree: one ray for each of the 32 samples of each pixel, robust traversal.
//
// A ray starts on the sample's plane itself, so which hits count as contact is the same rule for both: nearer to the
// triangle's plane than the margin of trace.hpp is no shadow. It is applied to Embree's hits by a filter, in double.
#include "tests/support/caster_scenes.hpp"

#include <shadowmath/irregular.hpp>
#include <shadowmath/shadowmath.hpp>

#include <embree3/rtcore.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bitset>
#include <cmath>
#include <vector>

namespace {

using namespace shadowmath;
using namespace shadowmath::test;

constexpr int width = 320, height = 180;

// A ray's context, for the filter. The first member is what Embree hands back.
struct ContactContext {
    RTCIntersectContext embree;
    CasterScene const* scene;
    glm::dvec3 eye, travel, sample;
    double metres, share_of_depth;
};

void reject_contact(RTCFilterFunctionNArguments const* arguments) {
    auto const& context = *reinterpret_cast<ContactContext const*>(arguments->context);
    for (unsigned k = 0; k < arguments->N; ++k) {
        if (arguments->valid[k] == 0) continue;
        float const* const p =
            context.scene->positions.data() + std::size_t{9} * RTCHitN_primID(arguments->hit, arguments->N, k);
        glm::dvec3 const a(p[0], p[1], p[2]), b(p[3], p[4], p[5]), c(p[6], p[7], p[8]);
        glm::dvec3 n = glm::cross(b - a, c - a);
        double const length = glm::length(n);
        if (!(length > 0.0)) continue;
        n *= (glm::dot(n, context.travel) < 0.0 ? -1.0 : 1.0) / length;
        double reach = 0.0;
        for (glm::dvec3 const& v : {a, b, c}) {
            glm::dvec3 const r = glm::abs(v - context.eye);
            reach = std::max(reach, r.x + r.y + r.z);
        }
        double const weight = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
        double const margin = weight * (context.metres + contact_share<double> * reach + context.share_of_depth);
        if (glm::dot(n, context.sample - a) < margin) arguments->valid[k] = 0;
    }
}

class Rays {
public:
    explicit Rays(CasterScene const& scene) : scene_(scene), device_(rtcNewDevice(nullptr)) {
        tree_ = rtcNewScene(device_);
        rtcSetSceneFlags(tree_, RTC_SCENE_FLAG_ROBUST);
        RTCGeometry const mesh = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* const v = static_cast<float*>(rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                    12, scene.positions.size() / 3));
        std::ranges::copy(scene.positions, v);
        auto* const indices = static_cast<std::uint32_t*>(
            rtcSetNewGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, scene.triangle_count()));
        for (std::uint32_t i = 0; i < 3 * scene.triangle_count(); ++i) indices[i] = i;
        rtcSetGeometryOccludedFilterFunction(mesh, reject_contact);
        rtcCommitGeometry(mesh);
        rtcAttachGeometry(tree_, mesh);
        rtcReleaseGeometry(mesh);
        rtcCommitScene(tree_);
    }
    ~Rays() {
        rtcReleaseScene(tree_);
        rtcReleaseDevice(device_);
    }
    Rays(Rays const&) = delete;
    Rays& operator=(Rays const&) = delete;

    [[nodiscard]] RTCRayHit first_hit(glm::vec3 from, glm::vec3 along) const {
        RTCRayHit query{};
        query.ray = {from.x, from.y, from.z, 0.0f, along.x, along.y, along.z, 0.0f, 1e6f, ~0u, 0, 0};
        query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcIntersect1(tree_, &context, &query);
        return query;
    }

    [[nodiscard]] bool dark(glm::dvec3 sample, ContactContext context) const {
        rtcInitIntersectContext(&context.embree);
        context.scene = &scene_;
        context.sample = sample;
        glm::vec3 const from(sample), along(-context.travel);
        RTCRay ray{from.x, from.y, from.z, 0.0f, along.x, along.y, along.z, 0.0f, 1e4f, ~0u, 0, 0};
        rtcOccluded1(tree_, &context.embree, &ray);
        return ray.tfar < 0.0f;
    }

private:
    CasterScene const& scene_;
    RTCDevice device_;
    RTCScene tree_;
};

struct Compared {
    std::size_t samples = 0, dark = 0, differing = 0, off_edge = 0;
};

Compared compare(CasterScene const& scene) {
    Rays const rays(scene);
    PixelFrame<float> const frame = pixel_frame(scene.eye, width, height);
    std::vector<float> depth(std::size_t{width} * height, 0.0f), normal(3 * depth.size(), 0.0f);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            glm::vec3 const along = frame.across * (static_cast<float>(x) + 0.5f - 0.5f * width) +
                                    frame.upward * (static_cast<float>(y) + 0.5f - 0.5f * height) + frame.inward;
            RTCRayHit const hit = rays.first_hit(frame.eye, along);
            if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) continue;
            std::size_t const pixel = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
            depth[pixel] = hit.ray.tfar;
            glm::vec3 const n = glm::normalize(glm::vec3(hit.hit.Ng_x, hit.hit.Ng_y, hit.hit.Ng_z));
            for (int i = 0; i < 3; ++i) normal[3 * pixel + static_cast<std::size_t>(i)] = n[i];
        }

    Aabb<float> const box{{-scene.extent, -scene.height, -scene.extent}, {scene.extent, scene.height, scene.extent}};
    ShadowMap<float> const grid = simple_perspective_map(scene.eye, scene.sun, box, box, {}, gl_zero_to_one_clip);
    StorageSize const need = storage_for(width, height, 64);
    std::vector<float> scalars(need.scalars);
    std::vector<std::uint32_t> words(need.words), masks(depth.size());
    Receivers<float> receivers;
    receivers.depth = depth.data();
    receivers.normal = normal.data();
    IrregularBuffer<float> buffer =
        list_receivers(frame, receivers, scene.sun, grid, 64, Storage<float>{scalars.data(), words.data(), need});
    EXPECT_FALSE(buffer.faults.any()) << describe(buffer.faults);
    Casters<float> casters;
    casters.position = scene.positions.data();
    casters.vertex_count = 3 * scene.triangle_count();
    casters.triangle_count = scene.triangle_count();
    trace(buffer, casters);
    write_masks(buffer, masks.data());

    PixelFrame<double> const exact = frame_in<double>(frame);
    ContactContext context{};
    context.eye = glm::dvec3(frame.eye);
    context.travel = glm::dvec3(scene.sun.direction);
    context.metres = contact_share<double> * (1.0 + static_cast<double>(buffer.contact_reach));
    Compared compared;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            std::size_t const pixel = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
            glm::dvec3 const n(normal[3 * pixel], normal[3 * pixel + 1], normal[3 * pixel + 2]);
            double const d = static_cast<double>(depth[pixel]);
            if (!(d > 0.0)) {
                EXPECT_EQ(masks[pixel], 0u);
                continue;
            }
            MicroQuad<double> const quad = micro_quad(exact, x, y, d, n);
            glm::dvec3 const middle = point_on(exact, quad, x, y, 0.5, 0.5);
            double const toward_light = glm::dot(n, context.travel);
            // At less than a twentieth of a degree rounding of the ray's origin moves shadows by millimetres.
            if (std::abs(toward_light) < 1e-3) continue;
            double const facing = toward_light * glm::dot(n, middle - context.eye);
            compared.samples += 32;
            if (facing < 0.0) {
                EXPECT_EQ(masks[pixel], every_sample);
                continue;
            }
            std::uint32_t truth = 0;
            auto const dark = [&](double u, double v) {
                context.share_of_depth = contact_share<double> * static_cast<double>(buffer.contact_ray) * d;
                return rays.dark(point_on(exact, quad, x, y, u, v), context);
            };
            for (int s = 0; s < 32; ++s)
                truth |= (dark(pixel_samples<double>.u[s], pixel_samples<double>.v[s]) ? 1u : 0u) << s;
            compared.dark += std::bitset<32>(truth).count();
            for (std::uint32_t wrong = truth ^ masks[pixel]; wrong != 0; wrong &= wrong - 1) {
                ++compared.differing;
                int const s = detail::lowest_bit(wrong);
                // Within rounding of a border: of the rays that start 16 roundings beside it, one sees the other side.
                double const u = pixel_samples<double>.u[s], v = pixel_samples<double>.v[s];
                glm::dvec3 const at = point_on(exact, quad, x, y, u, v);
                double const step = 16.0 * 0x1p-24 * (glm::length(at) + glm::length(at - context.eye));
                bool mixed = false;
                for (int i = 0; i < 27; ++i) {
                    glm::dvec3 const aside(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
                    mixed = mixed || rays.dark(at + aside * step, context) != ((truth >> s & 1u) != 0);
                }
                compared.off_edge += mixed ? 0u : 1u;
            }
        }
    return compared;
}

void expect_agreement(CasterScene const& scene) {
    Compared const compared = compare(scene);
    double const millionths = 1e6 * static_cast<double>(compared.differing) / static_cast<double>(compared.samples);
    std::printf("%s, %u triangles: %.1f million samples, %.1f %% dark, %.2f ppm differ, %zu of them off an edge\n",
                scene.name.c_str(), scene.triangle_count(), 1e-6 * static_cast<double>(compared.samples),
                100.0 * static_cast<double>(compared.dark) / static_cast<double>(compared.samples), millionths,
                compared.off_edge);
    EXPECT_GT(compared.dark, compared.samples / 50);
    EXPECT_LE(millionths, 15.0);
    EXPECT_EQ(compared.off_edge, 0u);
}

constexpr float aspect = static_cast<float>(width) / height;

}  // namespace

TEST(IrregularAgainstRays, AgreesOnAHundredThousandTrianglesOfTerrain) {
    expect_agreement(terrain_scene(100000, aspect));
}
TEST(IrregularAgainstRays, AgreesOnAHundredThousandTrianglesOfBoxes) {
    expect_agreement(boxes_scene(100000, aspect));
}
TEST(IrregularAgainstRays, AgreesOnAHundredThousandTrianglesOfLeaves) {
    expect_agreement(leaves_scene(100000, aspect));
}
TEST(IrregularAgainstRays, AgreesOnAMillionTrianglesOfTerrain) {
    expect_agreement(terrain_scene(1000000, aspect));
}
TEST(IrregularAgainstRays, AgreesOnAMillionTrianglesOfBoxes) {
    expect_agreement(boxes_scene(1000000, aspect));
}
TEST(IrregularAgainstRays, AgreesOnAMillionTrianglesOfLeaves) {
    expect_agreement(leaves_scene(1000000, aspect));
}
