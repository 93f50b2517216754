// SPDX-License-Identifier: MIT
//
// One split of the view volume: itself a view volume, with the split's range of depth.
//
// With a blend band every slice but the first starts early, inside its forerunner, so that a renderer can fade from one
// map to the next. The band is a fraction of the forerunner's depth, at its end.
#pragma once

#include <shadowmath/config.hpp>
#include <shadowmath/splits.hpp>
#include <shadowmath/view_volume.hpp>

namespace shadowmath {
inline namespace v0 {

template <class T>
struct SliceRange {
    T begin = T(0);        // eye depth, metres: the map must hold everything from here
    T blend_begin = T(0);  // fading into the next map starts here; equal to end where nothing follows
    T end = T(0);          // to here
};

namespace detail {

// Where the last `share` of [begin, end] starts; never before begin, however the product rounds.
template <class T>
[[nodiscard]] inline T fade_begin(T begin, T end, T share) noexcept {
    // By halves, whose difference no type is too narrow for.
    T const at = end - T(2) * (share * (end * T(0.5) - begin * T(0.5)));
    return at > begin && at <= end ? at : begin;
}

}  // namespace detail

// Metres of eye depth that split `index` must serve; `blend` in [0, 1] is the fraction of each split that fades.
template <class T>
[[nodiscard]] inline SliceRange<T> slice_range(Splits<T> const& splits, int index, T blend = T(0)) noexcept {
    SHADOWMATH_ASSERT(index >= 0 && index < splits.count, "slice index outside the splits");
    T const share = blend > T(0) ? (blend < T(1) ? blend : T(1)) : T(0);
    SliceRange<T> range{splits.plane[index], splits.plane[index + 1], splits.plane[index + 1]};
    if (index > 0) range.begin = detail::fade_begin(splits.plane[index - 1], splits.plane[index], share);
    if (index + 1 < splits.count) range.blend_begin = detail::fade_begin(splits.plane[index], range.end, share);
    return range;
}

template <class T>
[[nodiscard]] inline ViewVolume<T> slice(ViewVolume<T> const& view, SliceRange<T> const& range) noexcept {
    ViewVolume<T> part = view;
    part.z_near = range.begin;
    part.z_far = range.end;
    return part;
}

}  // namespace v0
}  // namespace shadowmath
