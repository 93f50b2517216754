// SPDX-License-Identifier: MIT
//
// Exact hard shadows at 1280 x 720 with 32 samples a pixel: the irregular z-buffer against ray tracing with Embree, the
// whole frame of each, interleaved in one program, medians over the rounds. A frame of ours lists the receivers and
// traces every triangle; a frame of Embree's builds the tree and asks for every sample's ray, in the fastest of eight
// ways. On two threads the picture is divided where the frames before took half their time, and the longer one counts,
// by the time of its processor.
//
// Before that, what each choice of grid makes of the lists.
//
//   irregular [triangles ...] [--rounds n] [--scene name] [--grid name] [--grid-size n] [--ours]
#include "bench/embree_frame.hpp"
#include "tests/support/caster_scenes.hpp"

#include <shadowmath/irregular.hpp>
#include <shadowmath/shadowmath.hpp>

#include <algorithm>
#include <array>
#include <bitset>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string>
#include <thread>
#include <vector>

using namespace shadowmath;
using namespace shadowmath::test;
using namespace shadowmath::bench;

namespace {

double median(std::vector<double> values) {
    if (values.empty()) return 0.0;
    auto const middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

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
    static constexpr int columns = width / tile_side;
    std::vector<Strip> strips;
    std::vector<std::uint32_t> masks;

    int map_size;

    Ours(int parts, int size) : masks(std::size_t{width} * height), map_size(size) {
        std::vector<int> borders;
        for (int k = 0; k <= parts; ++k) borders.push_back(columns * k / parts);
        divide(borders);
    }

    // At these columns of tiles.
    void divide(std::vector<int> const& borders) {
        strips.clear();
        for (std::size_t k = 0; k + 1 < borders.size(); ++k) {
            int const begin = borders[k] * tile_side, end = borders[k + 1] * tile_side;
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

    // Moves the borders to where all strips take as long, by how long they took in the frame before.
    void balance() {
        double whole = 0.0;
        for (Strip const& strip : strips) whole += strip.list_ms + strip.trace_ms;
        std::vector<int> borders{0};
        double before = 0.0;
        for (Strip const& strip : strips) {
            double const ms = strip.list_ms + strip.trace_ms;
            double const share = whole / static_cast<double>(strips.size());
            while (borders.size() < strips.size() && before + ms >= share * static_cast<double>(borders.size())) {
                double const within = (share * static_cast<double>(borders.size()) - before) / ms;
                int const column = strip.rect.x / tile_side + static_cast<int>(within * strip.rect.width / tile_side);
                borders.push_back(std::clamp(column, borders.back() + 1, columns - 1));
            }
            before += ms;
        }
        borders.push_back(columns);
        divide(borders);
    }

    double frame(PixelFrame<float> const& pixels, Picture const& picture, CasterScene const& scene,
                 ShadowMap<float> const& grid) {
        Receivers<float> receivers;
        receivers.depth = picture.depth.data();
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

// The ways of Embree's, and how long each took.
struct Way {
    RTCBuildQuality quality;
    Embree::Query query;
    char const* name;
    std::vector<double> whole, at_one_ray;
};

std::vector<Way> embree_ways() {
    std::vector<Way> ways;
    for (auto const& [quality, names] :
         {std::pair(RTC_BUILD_QUALITY_LOW, std::array{"morton 1", "morton 8", "morton 16", "morton 1M"}),
          std::pair(RTC_BUILD_QUALITY_MEDIUM, std::array{"sah 1", "sah 8", "sah 16", "sah 1M"})})
        for (std::size_t i = 0; i < names.size(); ++i)
            ways.push_back(
                {quality,
                 std::array{Embree::Query::one, Embree::Query::eight, Embree::Query::sixteen, Embree::Query::many}[i],
                 names[i],
                 {},
                 {}});
    return ways;
}

Way const& best_of(std::vector<Way> const& ways, std::vector<double> Way::*times) {
    return *std::ranges::min_element(
        ways, [times](Way const& a, Way const& b) { return median(a.*times) < median(b.*times); });
}

double share_dark(std::vector<std::uint32_t> const& masks, Picture const& picture) {
    std::size_t dark = 0, samples = 0;
    for (std::size_t i = 0; i < masks.size(); ++i) {
        if (!(picture.depth[i] > 0.0f)) continue;
        samples += samples_per_pixel;
        dark += std::bitset<32>(masks[i]).count();
    }
    return 100.0 * static_cast<double>(dark) / static_cast<double>(samples);
}

struct Request {
    std::vector<std::uint32_t> sizes;
    std::string scene, grid = "warp";
    int grid_size = 64;
    int rounds = 3;
    bool embree = true;
};

Request read(int argc, char** argv) {
    Request request;
    for (int i = 1; i < argc; ++i) {
        std::string const word = argv[i];
        bool const more = i + 1 < argc;
        if (word == "--rounds" && more)
            request.rounds = std::max(1, std::atoi(argv[++i]));
        else if (word == "--scene" && more)
            request.scene = argv[++i];
        else if (word == "--grid-size" && more)
            request.grid_size = std::atoi(argv[++i]);
        else if (word == "--grid" && more)
            request.grid = argv[++i];
        else if (word == "--ours")
            request.embree = false;
        else
            request.sizes.push_back(static_cast<std::uint32_t>(std::atoi(argv[i])));
    }
    if (request.sizes.empty()) request.sizes = {100000, 1000000};
    return request;
}

void show_grids(PixelFrame<float> const& frame, Picture const& picture, CasterScene const& scene, int map_size) {
    for (char const* const name : {"plain", "turned", "warp", "plane"}) {
        Ours ours(1, map_size);
        std::vector<double> times;
        for (int i = 0; i < 3; ++i)
            times.push_back(ours.frame(frame, picture, scene, grid_named(name, scene)));
        ListCounts const& c = ours.strips[0].counts;
        std::printf("  grid %-6s %6u lists, mean %6.2f, longest %5u nodes; %7.1f ms%s\n", name, c.lists,
                    static_cast<double>(c.nodes) / std::max(1u, c.lists), c.longest, median(times),
                    ours.strips[0].faults.any() ? " FAULT" : "");
    }
}

void measure(CasterScene const& scene, Request const& request) {
    PixelFrame<float> const frame = pixel_frame(scene.eye, width, height);
    Embree embree(scene);
    embree.build(RTC_BUILD_QUALITY_MEDIUM);
    Picture const picture = embree.picture(frame);
    std::printf("%s, %u triangles\n", scene.name.c_str(), scene.triangle_count());
    show_grids(frame, picture, scene, request.grid_size);

    ShadowMap<float> const grid = grid_named(request.grid, scene);
    Ours one(1, request.grid_size), two(2, request.grid_size);
    for (int i = 0; i < 4; ++i) {
        two.frame(frame, picture, scene, grid);
        two.balance();
    }
    std::vector<double> alone, listing, pair;
    std::vector<Way> ways = embree_ways();
    std::vector<std::uint32_t> truth, at_one_ray;
    for (int round = 0; round < request.rounds; ++round) {
        for (int i = 0; i < 3; ++i) {
            alone.push_back(one.frame(frame, picture, scene, grid));
            listing.push_back(one.strips[0].list_ms);
            pair.push_back(two.frame(frame, picture, scene, grid));
        }
        if (!request.embree) continue;
        double build = 0.0;
        for (Way& way : ways) {
            if (way.query == Embree::Query::one) build = embree.build(way.quality);
            way.whole.push_back(build + embree.occlusion(frame, picture, way.query, samples_per_pixel, truth));
            way.at_one_ray.push_back(build + embree.occlusion(frame, picture, way.query, 1, at_one_ray));
        }
    }
    double const ours = median(alone);
    std::printf("  ours %.1f ms, of which %.1f to list; on two threads %.1f ms: x%.2f%s\n", ours, median(listing),
                median(pair), ours / median(pair), one.strips[0].faults.any() ? " FAULT" : "");
    if (!request.embree) return;
    Way const &best = best_of(ways, &Way::whole), &lone = best_of(ways, &Way::at_one_ray);
    std::printf("  Embree %.1f ms (%s): x%.2f; at one ray a pixel %.1f ms (%s): x%.2f; dark %.1f %%, ours %.1f %%\n",
                median(best.whole), best.name, median(best.whole) / ours, median(lone.at_one_ray), lone.name,
                median(lone.at_one_ray) / ours, share_dark(truth, picture), share_dark(one.masks, picture));
}

}  // namespace

int main(int argc, char** argv) {
    Request const request = read(argc, argv);
    float const aspect = static_cast<float>(width) / height;
    for (std::uint32_t const size : request.sizes)
        for (auto* const make : {terrain_scene, boxes_scene, leaves_scene}) {
            CasterScene const scene = make(size, aspect);
            if (request.scene.empty() || scene.name == request.scene) measure(scene, request);
        }
    return 0;
}
