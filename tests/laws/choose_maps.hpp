// SPDX-License-Identifier: MIT
//
// What a choice of maps promises, whatever it has chosen.
#pragma once

#include "tests/laws/shadow_map.hpp"

#include <shadowmath/choose_maps.hpp>
#include <shadowmath/sampling.hpp>

#include <cmath>
#include <cstring>

namespace shadowmath::laws {

// Every matrix is a map of the light, and finite; figures are no more than what they are figures of.
template <class T>
[[nodiscard]] bool are_maps_of(ChosenMaps<T> const& chosen, Light<T> const& light, ClipSpace clip) {
    if (chosen.count < 0 || chosen.count > max_chosen_maps) return false;
    for (ChosenMap<T> const& made : chosen) {
        if (!made.map.visible || !harmless(made.map) || made.map.w_min <= T(0)) return false;
        // A row is a sum of four sides, each with a dozen roundings behind it.
        if (!is_map_of(made.map.clip_from_world, light, clip, 512)) return false;
        if (!(made.mean >= T(0) && made.mean <= made.worst * T(1.0001) && made.growth >= T(0.999))) return false;
    }
    return true;
}

// Which map a renderer would look the point up in, with the margin that the choice was made for, less `slack` of a map;
// -1: none, so it would be lit.
template <class T>
[[nodiscard]] int server_of(ChosenMaps<T> const& chosen, MapLimits<T> const& limits, Vec3<T> const& point, T slack) {
    for (int k = 0; k < chosen.count; ++k) {
        ShadowMap<T> const& map = chosen.at[static_cast<std::size_t>(k)].map;
        T const margin = T(2) * limits.margin_texels / T(limits.map_size);
        Vec4<long double> const at =
            canonical_from_clip<long double>(map.clip) * image_of(map.clip_from_world, Vec4<T>(point, T(1)));
        long double const side = (1 - static_cast<long double>(margin) + static_cast<long double>(slack)) * at.w;
        long double const end = (1 + static_cast<long double>(slack)) * at.w;
        if (at.w > 0 && std::abs(at.x) <= side && std::abs(at.y) <= side && at.z <= end) return k;
    }
    return -1;
}

template <class T>
[[nodiscard]] bool same(ChosenMaps<T> const& a, ChosenMaps<T> const& b) {
    if (a.count != b.count || a.tried != b.tried || a.faults != b.faults || a.price != b.price) return false;
    for (int k = 0; k < a.count; ++k)
        if (a.at[static_cast<std::size_t>(k)].map.clip_from_world !=
            b.at[static_cast<std::size_t>(k)].map.clip_from_world)
            return false;
    return true;
}

}  // namespace shadowmath::laws
