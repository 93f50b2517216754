// SPDX-License-Identifier: MIT
//
// Exact hard shadows at 1280 x 720 with 32 samples a pixel: the irregular z-buffer against ray tracing with Embree, the
// whole frame of each, interleaved in one program. Medians over the rounds; a frame of ours lists the receivers and
// traces every triangle, a frame of Embree's builds the tree and asks for every sample's ray. The time that it takes
// to write down its rays is not counted.
//
//   irregular [triangles ...] [--rounds n] [--scene name] [--grid name]
#include "tests/support/caster_scenes.hpp"

#include <shadowmath/irregular.hpp>
#include <shadowmath/shadowmath.hpp>

#include <embree3/rtcore.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

using namespace shadowmath;
using namespace shadowmath::test;

namespace {

constexpr int width = 1280, height = 720;
int grid_size = 64;

double now_ms() {
    timespec at{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &at);
    return 1e3 * static_cast<double>(at.tv_sec) + 1e-6 * static_cast<double>(at.tv_nsec);
}

double median(std::vector<double> values) {
    if (values.empty()) return 0.0;
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    return *std::min_element(values.begin(), values.end());
}

struct Picture {
    std::vector<float> position, normal;  // three a pixel; sky has normal 0
};

class Embree {
public:
    explicit Embree(CasterScene const& scene) : scene_(scene), device_(rtcNewDevice("threads=1,set_affinity=0")) {}
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
        made.position.assign(std::size_t{3} * width * height, 0.0f);
        made.normal = made.position;
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
                std::size_t const at = 3 * (static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x));
                glm::vec3 const n = glm::normalize(glm::vec3(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z));
                for (int i = 0; i < 3; ++i) {
                    made.position[at + static_cast<std::size_t>(i)] = frame.eye[i] + d[i] * query.ray.tfar;
                    made.normal[at + static_cast<std::size_t>(i)] = n[i];
                }
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
                glm::vec3 const p(picture.position[3 * pixel], picture.position[3 * pixel + 1],
                                  picture.position[3 * pixel + 2]);
                if (glm::dot(n, to_light) * glm::dot(n, frame.eye - p) <= 0.0f) {
                    masks[pixel] = ~0u;
                    continue;
                }
                float const depth = glm::dot(frame.to_inward, p - frame.eye);
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
    CasterScene const& scene_;
    RTCDevice device_;
    RTCScene tree_ = nullptr;
    std::vector<float> padded_;
    std::vector<std::uint32_t> indices_;
};

ShadowMap<float> plain_grid(CasterScene const& scene) {
    Aabb<float> const box{{-scene.extent, -scene.height, -scene.extent}, {scene.extent, scene.height, scene.extent}};
    LightBox<float> light_box;
    light_box.basis = light_basis(scene.sun.direction);
    Aabb<float> in;
    for (Vec3<float> const& corner : corners(box)) in = merge(in, in_light(light_box.basis, corner));
    light_box.lo = Vec2<float>(in.lo);
    light_box.hi = Vec2<float>(in.hi);
    light_box.depth_lo = in.lo.z;
    light_box.depth_hi = in.hi.z;
    ShadowMap<float> map;
    map.clip = gl_zero_to_one_clip;
    map.clip_from_world = clip_from_world(light_box, map.clip);
    map.visible = true;
    return map;
}

// Grids to choose from: a uniform one, the same turned along the view, and two that follow the eye.
ShadowMap<float> grid_named(std::string const& name, CasterScene const& scene) {
    if (name == "plain") return plain_grid(scene);
    Aabb<float> const box{{-scene.extent, -scene.height, -scene.extent}, {scene.extent, scene.height, scene.extent}};
    if (name == "plane")
        return view_dependent_map(scene.eye, scene.sun, plane_through<float>({0, 0, 0}, {0, 1, 0}), box, box, {},
                                  gl_zero_to_one_clip);
    WarpOptions<float> options;
    options.strength = name == "turned" ? 0.0f : 1.0f;
    return simple_perspective_map(scene.eye, scene.sun, box, box, options, gl_zero_to_one_clip);
}

struct Strip {
    std::vector<float> scalars;
    std::vector<std::uint32_t> words;
    PixelRect rect;
    ListCounts counts;
    Faults faults;
    double list_ms = 0.0, trace_ms = 0.0;
};

struct Ours {
    std::vector<Strip> strips;
    std::vector<std::uint32_t> masks;

    Ours(int parts, int map_size) : masks(std::size_t{width} * height) {
        for (int k = 0; k < parts; ++k) {
            int const begin = width / 4 * k / parts * 4, end = width / 4 * (k + 1) / parts * 4;
            StorageSize const need = storage_for(end - begin, height, map_size);
            strips.push_back({std::vector<float>(need.scalars),
                              std::vector<std::uint32_t>(need.words),
                              {begin, 0, end - begin, height},
                              {},
                              {},
                              0,
                              0});
        }
    }

    double frame(PixelFrame<float> const& pixels, Picture const& picture, CasterScene const& scene,
                 ShadowMap<float> const& grid, int map_size) {
        Receivers<float> receivers;
        receivers.position = picture.position.data();
        receivers.normal = picture.normal.data();
        Casters<float> casters;
        casters.position = scene.positions.data();
        casters.vertex_count = scene.triangle_count() * 3;
        casters.triangle_count = scene.triangle_count();
        auto const work = [&](Strip& strip) {
            double const a = now_ms();
            IrregularBuffer<float> buffer = list_receivers(
                pixels, receivers, scene.sun, grid, map_size,
                Storage<float>{strip.scalars.data(), strip.words.data(), {strip.scalars.size(), strip.words.size()}},
                strip.rect);
            double const b = now_ms();
            trace(buffer, casters);
            write_masks(buffer, masks.data() + strip.rect.x, width);
            strip.list_ms = b - a;
            strip.trace_ms = now_ms() - b;
            strip.counts = buffer.counts;
            strip.faults = buffer.faults;
        };
        std::vector<std::thread> threads;
        for (std::size_t k = 1; k < strips.size(); ++k) threads.emplace_back(work, std::ref(strips[k]));
        work(strips[0]);
        for (std::thread& thread : threads) thread.join();
        double longest = 0.0;
        for (Strip const& strip : strips) longest = std::max(longest, strip.list_ms + strip.trace_ms);
        return longest;
    }
};

}  // namespace

int main(int argc, char** argv) {
    std::vector<std::uint32_t> sizes;
    std::string only, grid_name = "warp";
    int rounds = 3;
    bool embree_too = true;
    for (int i = 1; i < argc; ++i) {
        std::string const word = argv[i];
        if (word == "--rounds" && i + 1 < argc)
            rounds = std::atoi(argv[++i]);
        else if (word == "--scene" && i + 1 < argc)
            only = argv[++i];
        else if (word == "--grid-size" && i + 1 < argc)
            grid_size = std::atoi(argv[++i]);
        else if (word == "--grid" && i + 1 < argc)
            grid_name = argv[++i];
        else if (word == "--ours")
            embree_too = false;
        else
            sizes.push_back(static_cast<std::uint32_t>(std::atoi(argv[i])));
    }
    if (sizes.empty()) sizes = {100000, 1000000};
    float const aspect = static_cast<float>(width) / height;
    for (std::uint32_t const size : sizes)
        for (auto* const make : {terrain_scene, boxes_scene, leaves_scene}) {
            CasterScene const scene = make(size, aspect);
            if (!only.empty() && scene.name != only) continue;
            PixelFrame<float> const frame = pixel_frame(scene.eye, width, height);
            Embree embree(scene);
            embree.build(RTC_BUILD_QUALITY_MEDIUM);
            Picture const picture = embree.picture(frame);
            ShadowMap<float> const grid = grid_named(grid_name, scene);
            std::vector<std::uint32_t> truth;
            Ours one(1, grid_size), two(2, grid_size);
            std::vector<double> single, pair;
            for (int round = 0; round < rounds * 3; ++round) {
                single.push_back(one.frame(frame, picture, scene, grid, grid_size));
                pair.push_back(two.frame(frame, picture, scene, grid, grid_size));
            }
            ListCounts const& c = one.strips[0].counts;
            std::printf("%s %u: ours %.1f ms (list %.1f, trace %.1f), 2 threads %.1f (x%.2f); tiles %u parts %u nodes "
                        "%u lists %u longest %u mean %.2f faults %x\n",
                        scene.name.c_str(), scene.triangle_count(), median(single), one.strips[0].list_ms,
                        one.strips[0].trace_ms, median(pair), median(single) / median(pair), c.tiles, c.parts, c.nodes,
                        c.lists, c.longest, double(c.nodes) / c.lists, one.strips[0].faults.bits);
            if (!embree_too) continue;
            double best = 1e30, best_one = 1e30;
            for (auto const& [quality, label] :
                 {std::pair(RTC_BUILD_QUALITY_LOW, "morton"), std::pair(RTC_BUILD_QUALITY_MEDIUM, "sah")}) {
                double const build = embree.build(quality);
                std::printf("  embree %s build %.1f:", label, build);
                for (auto const& [query, name] :
                     {std::pair(Embree::Query::one, "1"), std::pair(Embree::Query::eight, "8"),
                      std::pair(Embree::Query::sixteen, "16"), std::pair(Embree::Query::many, "1M")}) {
                    double const ms = embree.occlusion(frame, picture, query, 32, truth);
                    std::vector<std::uint32_t> other;
                    double const lone = embree.occlusion(frame, picture, query, 1, other);
                    std::printf("  %s %.0f (1spp %.1f)", name, ms, lone);
                    best = std::min(best, build + ms);
                    best_one = std::min(best_one, build + lone);
                }
                std::printf("\n");
            }
            std::size_t samples = 0, wrong = 0, dark = 0, partial = 0;
            for (std::size_t i = 0; i < truth.size(); ++i) {
                if (picture.normal[3 * i] == 0 && picture.normal[3 * i + 1] == 0 && picture.normal[3 * i + 2] == 0)
                    continue;
                samples += 32;
                dark += static_cast<std::size_t>(__builtin_popcount(truth[i]));
                partial += truth[i] != 0 && truth[i] != ~0u;
                wrong += static_cast<std::size_t>(__builtin_popcount(truth[i] ^ one.masks[i]));
            }
            std::printf("  best frame %.0f ms: x%.1f; at one ray a pixel %.1f ms: x%.2f; samples %zu dark %.1f%% "
                        "partial pixels %.1f%% differing %.1f ppm\n",
                        best, best / median(single), best_one, best_one / median(single), samples,
                        100.0 * static_cast<double>(dark) / static_cast<double>(samples),
                        3200.0 * static_cast<double>(partial) / static_cast<double>(samples),
                        1e6 * static_cast<double>(wrong) / static_cast<double>(samples));
        }
    return 0;
}
