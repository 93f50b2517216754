// SPDX-License-Identifier: MIT
//
// What a pass hands to the driver, worked out once for all APIs. The lists of DepthLayer::objects become a set of maps
// for each object. An object whose sweep meets neighbouring splits alone has a set without a hole, which is the range
// of GPU Gems 3, section 10.3.3; here a set may be any.
#pragma once

#include "backends/backend.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

namespace shadowmath::backend {

using MapSet = std::uint32_t;  // bit i: map i

// What an instanced attribute reads, in both APIs alike: an instance's number, counted from its draw's first_instance.
inline constexpr auto instance_numbers = [] {
    std::array<std::uint32_t, 1u << max_maps> numbers{};
    for (std::uint32_t i = 0; i < numbers.size(); ++i) numbers[i] = i;
    return numbers;
}();

// A draw of indices, laid out as both APIs lay it out for their indirect draws.
struct Draw {
    std::uint32_t index_count = 0;
    std::uint32_t instance_count = 1;
    std::uint32_t first_index = 0;
    std::int32_t vertex_offset = 0;
    std::uint32_t first_instance = 0;  // what the vertex shader sees as its number
};

// What is drawn into the same maps at once.
struct DrawGroup {
    MapSet maps = 0;
    std::vector<Draw> draws;
};

// Objects that are neighbours in the index array and are drawn alike become one draw.
inline void append(std::vector<Draw>& draws, Object const& object, std::uint32_t first_instance = 0,
                   std::uint32_t instance_count = 1) {
    if (object.index_count == 0u) return;
    if (!draws.empty()) {
        Draw& last = draws.back();
        if (last.first_index + last.index_count == object.first_index && last.first_instance == first_instance &&
            last.instance_count == instance_count) {
            last.index_count += object.index_count;
            return;
        }
    }
    draws.push_back({object.index_count, instance_count, object.first_index, 0, first_instance});
}

// The maps that each object is listed in.
using MapsOfObjects = std::vector<MapSet>;

[[nodiscard]] inline MapsOfObjects maps_of_objects(DepthPass const& pass, std::size_t object_count) {
    MapsOfObjects maps(object_count, 0u);
    for (std::size_t map = 0; map < pass.layers.size(); ++map)
        for (std::uint32_t const object : pass.layers[map].objects) maps[object] |= 1u << map;
    return maps;
}

[[nodiscard]] inline DrawGroup draws_of_map(std::uint32_t map, std::span<Object const> objects,
                                            MapsOfObjects const& maps) {
    DrawGroup group{1u << map, {}};
    for (std::size_t i = 0; i < objects.size(); ++i)
        if ((maps[i] >> map & 1u) != 0u) append(group.draws, objects[i]);
    return group;
}

// The shader sees the set of maps as its number.
[[nodiscard]] inline DrawGroup draws_of_clones(MapSet all, std::span<Object const> objects, MapsOfObjects const& maps) {
    DrawGroup group{all, {}};
    for (std::size_t i = 0; i < objects.size(); ++i)
        if (maps[i] != 0u) append(group.draws, objects[i], maps[i]);
    return group;
}

// A run of neighbouring maps is one draw, and its instances are the maps.
[[nodiscard]] inline DrawGroup draws_of_instances(MapSet all, std::span<Object const> objects,
                                                  MapsOfObjects const& maps) {
    DrawGroup group{all, {}};
    for (std::size_t i = 0; i < objects.size(); ++i)
        for (MapSet rest = maps[i]; rest != 0u;) {
            auto const first = static_cast<std::uint32_t>(std::countr_zero(rest));
            auto const count = static_cast<std::uint32_t>(std::countr_one(rest >> first));
            append(group.draws, objects[i], first, count);
            rest &= ~(((1u << count) - 1u) << first);
        }
    return group;
}

// One group for each set that occurs, added to what is there.
inline void append_draws_of_views(std::vector<DrawGroup>& groups, MapSet views, std::span<Object const> objects,
                                  MapsOfObjects const& maps) {
    for (std::size_t i = 0; i < objects.size(); ++i) {
        MapSet const seen = maps[i] & views;
        if (seen == 0u) continue;
        auto group = std::ranges::find(groups, seen, &DrawGroup::maps);
        if (group == groups.end()) group = groups.insert(group, DrawGroup{seen, {}});
        append(group->draws, objects[i]);
    }
}

// The groups of a depth pass, one after the other. Multiview draws views_at_once maps and then the next as many.
[[nodiscard]] inline std::vector<DrawGroup> plan_draws(DepthPass const& pass, std::span<Object const> objects,
                                                       std::uint32_t views_at_once = max_maps) {
    MapsOfObjects const maps = maps_of_objects(pass, objects.size());
    auto const map_count = static_cast<std::uint32_t>(pass.layers.size());
    MapSet const all = (1u << map_count) - 1u;
    std::vector<DrawGroup> groups;
    switch (pass.way) {
        case DrawWay::pass_per_map:
            for (std::uint32_t map = 0; map < map_count; ++map) groups.push_back(draws_of_map(map, objects, maps));
            break;
        case DrawWay::geometry_clones: groups.push_back(draws_of_clones(all, objects, maps)); break;
        case DrawWay::instances: groups.push_back(draws_of_instances(all, objects, maps)); break;
        case DrawWay::multiview:
            for (std::uint32_t first = 0; first < map_count; first += views_at_once)
                append_draws_of_views(groups, ((1u << views_at_once) - 1u) << first, objects, maps);
            break;
    }
    return groups;
}

inline void count(DrawWork& work, std::span<Draw const> draws) {
    work.draw_calls += draws.size();
    for (Draw const& draw : draws) {
        std::uint64_t const vertices = std::uint64_t{draw.index_count} * draw.instance_count;
        work.vertices += vertices;
        work.triangles += vertices / 3;
    }
}

// Clones and views are made of a triangle after it was handed over; an instance is a triangle of its own.
[[nodiscard]] inline DrawWork work_of(DrawWay way, std::span<DrawGroup const> groups) {
    DrawWork work;
    work.passes = groups.size() + (way == DrawWay::multiview ? 1u : 0u);  // which first clears all maps
    for (DrawGroup const& group : groups) {
        count(work, group.draws);
        for (Draw const& draw : group.draws) {
            MapSet const maps = way == DrawWay::geometry_clones ? draw.first_instance : group.maps;
            if (way == DrawWay::geometry_clones || way == DrawWay::multiview)
                work.triangles += draw.index_count / 3 * (static_cast<std::uint64_t>(std::popcount(maps)) - 1u);
        }
    }
    return work;
}

}  // namespace shadowmath::backend
