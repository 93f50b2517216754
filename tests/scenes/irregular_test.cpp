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

struct Seen {
    std::vector<float> depth = std::vector<float>(std::size_t{width} * height, 0.0f);  // along the frame; 0: sky
    std::vector<float> normal = std::vector<float>(3 * std::size_t{width} * height, 0.0f);
};

std::size_t pixel_at(int x, int y) {
    return static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
}

Seen seen_through(PixelFrame<float> const& frame, Rays const& rays) {
    Seen seen;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            glm::vec3 const along = frame.across * (static_cast<float>(x) + 0.5f - 0.5f * width) +
                                    frame.upward * (static_cast<float>(y) + 0.5f - 0.5f * height) + frame.inward;
            RTCRayHit const hit = rays.first_hit(frame.eye, along);
            if (hit.hit.geomID == RTC_INVALID_GEOMETRY_ID) continue;
            std::size_t const pixel = pixel_at(x, y);
            seen.depth[pixel] = hit.ray.tfar;
            glm::vec3 const n = glm::normalize(glm::vec3(hit.hit.Ng_x, hit.hit.Ng_y, hit.hit.Ng_z));
            for (int i = 0; i < 3; ++i) seen.normal[3 * pixel + static_cast<std::size_t>(i)] = n[i];
        }
    return seen;
}

// What the irregular z-buffer makes of it.
struct Traced {
    std::vector<std::uint32_t> masks;
    double contact_reach = 0.0, contact_ray = 0.0;
};

Traced traced(CasterScene const& scene, PixelFrame<float> const& frame, Seen const& seen) {
    Aabb<float> const box{{-scene.extent, -scene.height, -scene.extent}, {scene.extent, scene.height, scene.extent}};
    ShadowMap<float> const grid = simple_perspective_map(scene.eye, scene.sun, box, box, {}, gl_zero_to_one_clip);
    StorageSize const need = storage_for(width, height, 64);
    std::vector<float> scalars(need.scalars);
    std::vector<std::uint32_t> words(need.words);
    Receivers<float> receivers;
    receivers.depth = seen.depth.data();
    receivers.normal = seen.normal.data();
    IrregularBuffer<float> buffer =
        list_receivers(frame, receivers, scene.sun, grid, 64, Storage<float>{scalars.data(), words.data(), need});
    EXPECT_FALSE(buffer.faults.any()) << describe(buffer.faults);
    Casters<float> casters;
    casters.position = scene.positions.data();
    casters.vertex_count = 3 * scene.triangle_count();
    casters.triangle_count = scene.triangle_count();
    trace(buffer, casters);
    Traced result{std::vector<std::uint32_t>(seen.depth.size()), double(buffer.contact_reach),
                  double(buffer.contact_ray)};
    write_masks(buffer, result.masks.data());
    return result;
}

struct Compared {
    std::size_t samples = 0, dark = 0, differing = 0, off_edge = 0;
};

class Comparison {
public:
    explicit Comparison(CasterScene const& scene)
        : rays_(scene), frame_(pixel_frame(scene.eye, width, height)), exact_(frame_in<double>(frame_)),
          seen_(seen_through(frame_, rays_)), traced_(traced(scene, frame_, seen_)) {
        context_.eye = glm::dvec3(frame_.eye);
        context_.travel = glm::dvec3(scene.sun.direction);
        context_.metres = contact_share<double> * (1.0 + traced_.contact_reach);
    }

    Compared of_all_pixels() {
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) compare(x, y);
        return compared_;
    }

private:
    void compare(int x, int y) {
        std::size_t const pixel = pixel_at(x, y);
        std::uint32_t const mask = traced_.masks[pixel];
        double const depth = static_cast<double>(seen_.depth[pixel]);
        if (!(depth > 0.0)) {
            EXPECT_EQ(mask, 0u);
            return;
        }
        float const* const n = &seen_.normal[3 * pixel];
        glm::dvec3 const normal(n[0], n[1], n[2]);
        MicroQuad<double> const quad = micro_quad(exact_, x, y, depth, normal);
        double const toward_light = glm::dot(normal, context_.travel);
        // At less than a twentieth of a degree rounding of the ray's origin moves shadows by millimetres.
        if (std::abs(toward_light) < 1e-3) return;
        double const facing = toward_light * glm::dot(normal, point_on(exact_, quad, x, y, 0.5, 0.5) - context_.eye);
        compared_.samples += 32;
        if (facing < 0.0) {
            EXPECT_EQ(mask, every_sample);
            return;
        }
        context_.share_of_depth = contact_share<double> * traced_.contact_ray * depth;
        auto const sample = [&](int s) {
            return point_on(exact_, quad, x, y, pixel_samples<double>.u[s], pixel_samples<double>.v[s]);
        };
        std::uint32_t truth = 0;
        for (int s = 0; s < 32; ++s) truth |= (rays_.dark(sample(s), context_) ? 1u : 0u) << s;
        compared_.dark += std::bitset<32>(truth).count();
        for (std::uint32_t wrong = truth ^ mask; wrong != 0; wrong &= wrong - 1) {
            ++compared_.differing;
            int const s = detail::lowest_bit(wrong);
            compared_.off_edge += is_on_an_edge(sample(s), (truth >> s & 1u) != 0) ? 0u : 1u;
        }
    }

    // Within rounding of a border: of the rays that start 16 roundings beside the sample, one sees the other side.
    [[nodiscard]] bool is_on_an_edge(glm::dvec3 const& sample, bool dark) const {
        double const step = 16.0 * 0x1p-24 * (glm::length(sample) + glm::length(sample - context_.eye));
        for (int i = 0; i < 27; ++i) {
            glm::dvec3 const aside(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
            if (rays_.dark(sample + aside * step, context_) != dark) return true;
        }
        return false;
    }

    Rays rays_;
    PixelFrame<float> frame_;
    PixelFrame<double> exact_;
    Seen seen_;
    Traced traced_;
    ContactContext context_{};
    Compared compared_;
};

void expect_agreement(CasterScene const& scene) {
    Compared const compared = Comparison(scene).of_all_pixels();
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
