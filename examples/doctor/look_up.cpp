// SPDX-License-Identifier: MIT
#include "examples/doctor/look_up.hpp"

#include <shadowmath/tangent.hpp>

namespace shadowmath::doctor {

ShadowMap<double> map_of(EngineMap const& map, ClipSpace clip) {
    ShadowMap<double> made;
    made.clip_from_world = map.clip_from_world;
    made.clip = clip;
    made.visible = true;
    return made;
}

Inside inside(ShadowMap<double> const& map, glm::dvec3 point) {
    Projected<double> const at = projected(canonical_from_clip<double>(map.clip) * map.clip_from_world, point);
    return {glm::dvec3(at.at.x * 0.5 + 0.5, at.at.y * 0.5 + 0.5, at.at.z), at.in_front};
}

Place place_of(Case const& read, Frame const& frame, std::vector<ShadowMap<double>> const& maps, glm::dvec3 point,
               double eye_depth) {
    auto const in_map = [&](std::size_t i) {
        Inside const place = inside(maps[i], point);
        if (!place.in_front) return Served::behind;
        double const slack = 0.5 / frame.maps[i].size;
        for (int axis = 0; axis < 2; ++axis)
            if (place.at[axis] < -slack || place.at[axis] > 1.0 + slack) return Served::outside;
        return place.at.z > 1.0 + 1e-6 ? Served::past_end : Served::yes;
    };
    if (read.choice == Selection::by_depth) {
        for (std::size_t i = 0; i < maps.size(); ++i) {
            SliceRange<double> const& range = *frame.maps[i].range;
            if (!(eye_depth < range.end)) continue;
            if (eye_depth < range.begin) return {Served::between, static_cast<int>(i)};
            return {in_map(i), static_cast<int>(i)};
        }
        return {Served::between, -1};
    }
    Place best{Served::outside, -1};
    for (std::size_t i = 0; i < maps.size(); ++i) {
        Served const served = in_map(i);
        if (served == Served::yes) return {served, static_cast<int>(i)};
        if (served == Served::past_end) best = {served, static_cast<int>(i)};
    }
    return best;
}

}  // namespace shadowmath::doctor
