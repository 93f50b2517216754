// SPDX-License-Identifier: MIT
//
// The other way to a frame of exact shadows: Embree builds a tree over the triangles, then asks for a ray a sample.
// Only what Embree itself does is timed; writing down its rays is not.
//
// Rays start 0.2 mm off their surface: another rule of contact than ours, so masks are compared in
// tests/scenes/irregular_test.cpp, where both follow one.
#pragma once

#include "tests/support/caster_scenes.hpp"

#include <shadowmath/irregular.hpp>

#include <embree3/rtcore.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <ctime>
#include <vector>

namespace shadowmath::bench {

inline constexpr int width = 1280, height = 720;

// Of this thread's processor.
inline double now_ms() {
    timespec at{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &at);
    return 1e3 * static_cast<double>(at.tv_sec) + 1e-6 * static_cast<double>(at.tv_nsec);
}

// What an eye sees of a scene: a G-buffer. Sky has depth 0.
struct Picture {
    std::vector<float> depth, normal;  // one and three a pixel
};

class Embree {
public:
    explicit Embree(test::CasterScene const& scene)
        : scene_(scene), device_(rtcNewDevice("threads=1,set_affinity=0")) {}
    ~Embree() {
        if (tree_ != nullptr) rtcReleaseScene(tree_);
        rtcReleaseDevice(device_);
    }
    Embree(Embree const&) = delete;
    Embree& operator=(Embree const&) = delete;

    double build(RTCBuildQuality quality) {
        if (tree_ != nullptr) rtcReleaseScene(tree_);
        double const begin = now_ms();
        tree_ = rtcNewScene(device_);
        rtcSetSceneFlags(tree_, RTC_SCENE_FLAG_ROBUST);
        rtcSetSceneBuildQuality(tree_, quality);
        RTCGeometry const mesh = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        rtcSetGeometryBuildQuality(mesh, quality);
        std::size_t const vertices = scene_.positions.size() / 3;
        if (indices_.empty()) {
            padded_ = scene_.positions;
            padded_.resize(padded_.size() + 4);
            for (std::size_t i = 0; i < vertices; ++i) indices_.push_back(static_cast<std::uint32_t>(i));
        }
        rtcSetSharedGeometryBuffer(mesh, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, padded_.data(), 0, 12, vertices);
        rtcSetSharedGeometryBuffer(mesh, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, indices_.data(), 0, 12,
                                   vertices / 3);
        rtcCommitGeometry(mesh);
        rtcAttachGeometry(tree_, mesh);
        rtcReleaseGeometry(mesh);
        rtcCommitScene(tree_);
        return now_ms() - begin;
    }

    [[nodiscard]] Picture picture(PixelFrame<float> const& frame) const {
        Picture made;
        made.depth.assign(std::size_t{width} * height, 0.0f);
        made.normal.assign(std::size_t{3} * width * height, 0.0f);
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                glm::vec3 const d = frame.across * (static_cast<float>(x) + 0.5f - 0.5f * width) +
                                    frame.upward * (static_cast<float>(y) + 0.5f - 0.5f * height) + frame.inward;
                RTCRayHit query{};
                query.ray = {frame.eye.x, frame.eye.y, frame.eye.z, 0.0f, d.x, d.y, d.z, 0.0f, 1e6f, ~0u, 0, 0};
                query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
                rtcIntersect1(tree_, &context, &query);
                if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) continue;
                std::size_t const pixel = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
                made.depth[pixel] = query.ray.tfar;  // the frame's directions are one deep
                glm::vec3 const n = glm::normalize(glm::vec3(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z));
                for (int i = 0; i < 3; ++i) made.normal[3 * pixel + static_cast<std::size_t>(i)] = n[i];
            }
        return made;
    }

    enum class Query { one, eight, sixteen, many };

    // Milliseconds inside Embree. `spread`: samples of each pixel.
    double occlusion(PixelFrame<float> const& frame, Picture const& picture, Query query, int spread,
                     std::vector<std::uint32_t>& masks) const {
        masks.assign(std::size_t{width} * height, 0);
        glm::vec3 const to_light = -scene_.sun.direction;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        constexpr int batch = 64;  // pixels
        static std::vector<RTCRay> rays(batch * 32);
        static std::vector<RTCRay16> packets16(batch * 2);
        static std::vector<RTCRay8> packets8(batch * 4);
        alignas(64) static int all_valid[16];
        std::fill(all_valid, all_valid + 16, -1);
        double total = 0.0;
        std::vector<std::size_t> pixels;
        auto const flush = [&] {
            std::size_t const count = pixels.size() * static_cast<std::size_t>(spread);
            if (count == 0) return;
            std::size_t const padded = (count + 15) / 16 * 16;
            for (std::size_t k = count; k < padded; ++k) {
                rays[k] = rays[0];
                rays[k].tfar = -1.0f;
            }
            auto const fill = [&](auto& packets, std::size_t lanes) {
                for (std::size_t k = 0; k < padded; ++k) {
                    auto& p = packets[k / lanes];
                    std::size_t const l = k % lanes;
                    RTCRay const& r = rays[k];
                    p.org_x[l] = r.org_x, p.org_y[l] = r.org_y, p.org_z[l] = r.org_z, p.tnear[l] = r.tnear;
                    p.dir_x[l] = r.dir_x, p.dir_y[l] = r.dir_y, p.dir_z[l] = r.dir_z, p.tfar[l] = r.tfar;
                    p.mask[l] = ~0u, p.time[l] = 0.0f, p.flags[l] = 0, p.id[l] = 0;
                }
            };
            if (query == Query::eight) fill(packets8, 8);
            if (query == Query::sixteen) fill(packets16, 16);
            double const begin = now_ms();
            if (query == Query::one)
                for (std::size_t k = 0; k < count; ++k) rtcOccluded1(tree_, &context, &rays[k]);
            if (query == Query::eight)
                for (std::size_t k = 0; k < padded / 8; ++k) rtcOccluded8(all_valid, tree_, &context, &packets8[k]);
            if (query == Query::sixteen)
                for (std::size_t k = 0; k < padded / 16; ++k) rtcOccluded16(all_valid, tree_, &context, &packets16[k]);
            if (query == Query::many)
                rtcOccluded1M(tree_, &context, rays.data(), static_cast<unsigned>(count), sizeof(RTCRay));
            total += now_ms() - begin;
            for (std::size_t k = 0; k < count; ++k) {
                float const far = query == Query::eight     ? packets8[k / 8].tfar[k % 8]
                                  : query == Query::sixteen ? packets16[k / 16].tfar[k % 16]
                                                            : rays[k].tfar;
                auto const spp = static_cast<std::size_t>(spread);
                if (far < 0.0f) masks[pixels[k / spp]] |= 1u << (k % spp);
            }
            pixels.clear();
        };
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                std::size_t const pixel = static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x);
                glm::vec3 const n(picture.normal[3 * pixel], picture.normal[3 * pixel + 1],
                                  picture.normal[3 * pixel + 2]);
                if (n == glm::vec3(0.0f)) continue;
                float const depth = picture.depth[pixel];
                glm::vec3 const along = frame.across * (static_cast<float>(x) + 0.5f - 0.5f * width) +
                                        frame.upward * (static_cast<float>(y) + 0.5f - 0.5f * height) + frame.inward;
                glm::vec3 const p = frame.eye + along * depth;
                if (glm::dot(n, to_light) * glm::dot(n, frame.eye - p) <= 0.0f) {
                    masks[pixel] = ~0u;
                    continue;
                }
                MicroQuad<float> const quad = micro_quad(frame, x, y, depth, n);
                float const start = 2e-4f / std::abs(glm::dot(n, to_light));
                for (int s = 0; s < spread; ++s) {
                    float const u = spread == 1 ? 0.5f : pixel_samples<float>.u[s],
                                v = spread == 1 ? 0.5f : pixel_samples<float>.v[s];
                    glm::vec3 const from = point_on(frame, quad, x, y, u, v);
                    rays[pixels.size() * static_cast<std::size_t>(spread) + static_cast<std::size_t>(s)] = {
                        from.x, from.y, from.z, start, to_light.x, to_light.y, to_light.z, 0.0f, 1e4f, ~0u, 0, 0};
                }
                pixels.push_back(pixel);
                if (pixels.size() == batch) flush();
            }
        flush();
        return total;
    }

private:
    test::CasterScene const& scene_;
    RTCDevice device_;
    RTCScene tree_ = nullptr;
    std::vector<float> padded_;
    std::vector<std::uint32_t> indices_;
};

}  // namespace shadowmath::bench
