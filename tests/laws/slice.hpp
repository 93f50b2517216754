// SPDX-License-Identifier: MIT
//
// Laws of slices: together they cover the view, and only neighbours overlap.
#pragma once

#include <shadowmath/slice.hpp>

namespace shadowmath::laws {

// Every slice holds its split; it starts no earlier than its forerunner and fades only inside itself. Where no blend is
// asked for, slices meet exactly. All exact: the order survives rounding.
template <class T>
[[nodiscard]] bool slices_cover(Splits<T> const& splits, T blend) {
    for (int i = 0; i < splits.count; ++i) {
        SliceRange<T> const range = slice_range(splits, i, blend);
        bool const holds_its_split = range.begin <= splits.plane[i] && range.end == splits.plane[i + 1];
        bool const in_its_forerunner = range.begin >= (i == 0 ? splits.plane[0] : splits.plane[i - 1]);
        bool const fades_inside = range.blend_begin >= splits.plane[i] && range.blend_begin <= range.end;
        bool const last_does_not_fade = i + 1 < splits.count || range.blend_begin == range.end;
        bool const meets = blend > T(0) || (range.begin == splits.plane[i] && range.blend_begin == range.end);
        if (!(holds_its_split && in_its_forerunner && fades_inside && last_does_not_fade && meets)) return false;
        // Where this map fades into the next, the next one is already there.
        if (i + 1 < splits.count && !(slice_range(splits, i + 1, blend).begin <= range.blend_begin)) return false;
    }
    return true;
}

// A slice is the view in all but depth.
template <class T>
[[nodiscard]] bool is_a_part_of(ViewVolume<T> const& part, ViewVolume<T> const& view) {
    return part.pose.position == view.pose.position && part.pose.right == view.pose.right &&
           part.pose.up == view.pose.up && part.pose.forward == view.pose.forward && part.left == view.left &&
           part.right == view.right && part.bottom == view.bottom && part.top == view.top && part.kind == view.kind &&
           part.z_near >= view.z_near && part.z_far <= view.z_far;
}

}  // namespace shadowmath::laws
