// SPDX-License-Identifier: MIT
//
// A rectangle of a map, as a matrix on the left: crop to what is used, place in an atlas, compose both. Which rectangle
// a body needs says projected_bounds.hpp, which comes with it.
//
// Use it after any technique: nothing here knows how the matrix was made, and neither the light's law nor the order of
// depth is touched. Source: Kwon 2002 (thesis), 4.1, with its y scale corrected.
#pragma once

#include <shadowmath/bounds.hpp>
#include <shadowmath/clip_space.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/fault.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/projected_bounds.hpp>

namespace shadowmath {
inline namespace v0 {

template <class T>
struct Region {
    Vec2<T> lo{T(-1)};  // NDC; the default is the whole map
    Vec2<T> hi{T(1)};
};

// A square of texels in an atlas. Rows count from texture v = 0.
struct Tile {
    int x = 0;
    int y = 0;
    int size = 0;
    int atlas_width = 0;
    int atlas_height = 0;
};

// Empty as soon as one axis has no length.
template <class T>
[[nodiscard]] inline bool is_empty(Region<T> const& region) noexcept {
    return !(region.lo.x < region.hi.x && region.lo.y < region.hi.y);
}

// May be empty.
template <class T>
[[nodiscard]] inline Region<T> intersect(Region<T> const& a, Region<T> const& b) noexcept {
    return {glm::max(a.lo, b.lo), glm::min(a.hi, b.hi)};
}

template <class T>
[[nodiscard]] inline Region<T> region_of(Aabb<T> const& box_in_ndc) noexcept {
    return {Vec2<T>(box_in_ndc.lo.x, box_in_ndc.lo.y), Vec2<T>(box_in_ndc.hi.x, box_in_ndc.hi.y)};
}

// At least `least` wide on both axes, about the same centre: what a point or a line needs before it can fill a map. One
// texel is 2 / map_size of the whole map.
template <class T>
[[nodiscard]] inline Region<T> widened(Region<T> const& region, T least) noexcept {
    Region<T> wide = region;
    for (int axis = 0; axis < 2; ++axis) {
        if (region.hi[axis] - region.lo[axis] >= least) continue;
        T const centre = region.lo[axis] / T(2) + region.hi[axis] / T(2);
        wide.lo[axis] = centre - least / T(2);
        wide.hi[axis] = centre + least / T(2);
    }
    return wide;
}

// Leaves `margin_texels` of the map free on every side, for the kernel of a filter. 2 * margin_texels < map_size.
template <class T>
[[nodiscard]] inline Region<T> with_margin(Region<T> const& region, int map_size, T margin_texels) noexcept {
    Vec2<T> const border = (region.hi - region.lo) * (margin_texels / (T(map_size) - T(2) * margin_texels));
    return {region.lo - border, region.hi + border};
}

// The region fills the map: lo lands on (-1, -1), hi on (1, 1); depth and w are left alone. A region that is empty or
// not finite gives the identity.
template <class T>
[[nodiscard]] inline Mat4<T> region_matrix(Region<T> const& region) noexcept {
    if (!all_finite(region.lo) || !all_finite(region.hi) || is_empty(region)) return Mat4<T>(T(1));
    Vec2<T> const size = region.hi - region.lo;
    Vec2<T> const scale = T(2) / size, offset = -(region.hi + region.lo) / size;
    if (!all_finite(size) || !all_finite(scale) || !all_finite(offset)) return Mat4<T>(T(1));
    return from_rows(Vec4<T>(scale.x, T(0), T(0), offset.x), Vec4<T>(T(0), scale.y, T(0), offset.y),
                     Vec4<T>(T(0), T(0), T(1), T(0)), Vec4<T>(T(0), T(0), T(0), T(1)));
}

// bad_region for a tile without area, or not wholly inside its atlas.
[[nodiscard]] constexpr Faults faults_of(Tile const& tile) noexcept {
    // Compared by subtraction: x + size may overflow.
    bool const inside = tile.size > 0 && tile.x >= 0 && tile.y >= 0 && tile.atlas_width > 0 && tile.atlas_height > 0 &&
                        tile.x <= tile.atlas_width - tile.size && tile.y <= tile.atlas_height - tile.size;
    return inside ? Faults{} : Faults(Fault::bad_region);
}

// The whole map lands on the tile: tile_matrix * clip_from_world is the map inside its atlas, to look receivers up
// with. The identity where faults_of(tile) says bad_region.
//
// NOTE: nothing clips to the tile. Draw casters with the plain matrix and the tile as the viewport, and test
// a receiver against the plain matrix first: a point beyond the map lands in a neighbour's tile.
template <class T>
[[nodiscard]] inline Mat4<T> tile_matrix(Tile const& tile, ClipSpace clip = {}) noexcept {
    if (faults_of(tile).any()) return Mat4<T>(T(1));
    T const width = T(tile.atlas_width), height = T(tile.atlas_height), size = T(tile.size);
    T const up = clip.ndc_y == clip.texture_v ? T(1) : T(-1);
    T const x = (T(2) * T(tile.x) + size) / width - T(1), y = (T(2) * T(tile.y) + size) / height - T(1);
    return from_rows(Vec4<T>(size / width, T(0), T(0), x), Vec4<T>(T(0), size / height, T(0), up * y),
                     Vec4<T>(T(0), T(0), T(1), T(0)), Vec4<T>(T(0), T(0), T(0), T(1)));
}

}  // namespace v0
}  // namespace shadowmath
