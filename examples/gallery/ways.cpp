// SPDX-License-Identifier: MIT
#include "examples/gallery/ways.hpp"

#include "examples/gallery/measure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace shadowmath::gallery {
namespace {

using backend::Backend;
using backend::DepthPass;
using backend::DrawWay;
using backend::DrawWork;
using backend::DriverCount;
using backend::Image;
using backend::Rgba8;
using backend::ScenePass;

constexpr std::array every_count{&DriverCount::vertices,           &DriverCount::triangles,
                                 &DriverCount::vertex_runs,        &DriverCount::geometry_runs,
                                 &DriverCount::geometry_triangles, &DriverCount::clipper_triangles,
                                 &DriverCount::raster_triangles};

// One pass and then another.
DrawWork sum(DrawWork a, DrawWork const& b) {
    a.milliseconds += b.milliseconds;
    a.passes += b.passes;
    a.draw_calls += b.draw_calls;
    a.vertices += b.vertices;
    a.triangles += b.triangles;
    if (!b.driver) a.driver.reset();
    if (!a.driver) return a;
    for (auto const count : every_count) *a.driver.*count += *b.driver.*count;
    return a;
}

backend::FrameConstants by_depth_alone(backend::FrameConstants frame) {
    frame.choice = backend::MapChoice::by_depth;
    for (backend::MapConstants& map : frame.maps) map.blend_begin = map.depth_end;
    return frame;
}

struct Way {
    WayRecord record;
    std::function<DrawWork()> draw;
};

void compare_maps(WayRecord& record, std::vector<Image<float>> const& expected,
                  std::vector<Image<float>> const& drawn) {
    for (std::size_t map = 0; map < expected.size(); ++map)
        for (std::size_t i = 0; i < expected[map].pixels.size(); ++i) {
            double const difference = std::fabs(double(drawn[map].pixels[i]) - double(expected[map].pixels[i]));
            ++record.texels;
            record.unlike_texels += difference != 0.0;
            record.largest_difference = std::fmax(record.largest_difference, difference);
        }
}

// What the first way of each kind drew.
class Reference {
public:
    void hold_against(WayRecord& record, Backend& backend) {
        if (record.with_picture) {
            Image<Rgba8> const drawn = backend.read_frame().colour;
            if (picture_.pixels.empty()) picture_ = drawn;
            record.pixels = static_cast<long>(drawn.pixels.size());
            record.unlike_pixels = unlike_pixels(picture_, drawn);
        } else {
            std::vector<Image<float>> drawn;
            for (int map = 0; map < record.maps; ++map) drawn.push_back(backend.read_depth(map));
            if (maps_.empty()) maps_ = drawn;
            compare_maps(record, maps_, drawn);
        }
    }

private:
    Image<Rgba8> picture_;
    std::vector<Image<float>> maps_;
};

}  // namespace

std::vector<WayRecord> measure_ways(Backend& backend, MapSet const& set, SplitObjects const& shown,
                                    backend::Extent extent, int runs) {
    if (set.maps.empty()) return {};
    std::vector<backend::DepthLayer> layers;
    for (Map const& map : set.maps) layers.push_back({glm::mat4(map.clip_from_world), map.casters});
    std::vector<std::span<std::uint32_t const>> const lists(shown.begin(), shown.end());
    ScenePass const picture{extent, by_depth_alone(set.frame), false, lists};

    std::vector<Way> ways;
    auto const add = [&](std::string const& name, bool with_picture, int in_memory, std::function<DrawWork()> draw) {
        WayRecord record;
        record.way = name;
        record.with_picture = with_picture;
        record.map_size = set.map_size;
        record.maps = static_cast<int>(layers.size());
        record.maps_in_memory = in_memory;
        ways.push_back({std::move(record), std::move(draw)});
    };
    auto const all_maps = static_cast<int>(layers.size());
    auto const maps = [&](DrawWay way) { return DepthPass{set.map_size, layers, true, way}; };
    DrawWork last;  // of the maps that are there
    for (DrawWay const way : backend.ways()) {
        add(name_of(way), false, all_maps, [&, way] { return last = backend.draw_depth(maps(way)); });
        if (way == DrawWay::pass_per_map)
            add("all maps, then the picture", true, all_maps, [&] {
                return sum(last, backend.draw_scene({extent, picture.frame}));
            });
    }
    add("split by split", true, 1, [&] { return backend.draw_split_by_split(maps(DrawWay::pass_per_map), picture); });

    // In turns, so that whatever else the machine does falls on all of them.
    Reference reference;
    for (int run = 0; run < runs; ++run)
        for (Way& way : ways) {
            DrawWork const work = way.draw();
            if (run == 0) reference.hold_against(way.record, backend);
            if (run == 0 || work.milliseconds < way.record.work.milliseconds) way.record.work = work;
        }
    std::ranges::stable_partition(ways, [](Way const& way) { return !way.record.with_picture; });
    std::vector<WayRecord> records;
    for (Way& way : ways) records.push_back(std::move(way.record));
    return records;
}

}  // namespace shadowmath::gallery
