// SPDX-License-Identifier: MIT
//
// A rectangle of a map, as a matrix on the left: crop to what is used, place in an atlas, compose both. And the
// rectangle that a body needs, clipped before the divide.
//
// Use it after any technique: nothing here knows how the matrix was made, and neither the light's law nor the order of
// depth is touched. Source: Kwon 2002 (thesis), 4.1, with its y scale corrected; the clip before the divide is ours.
#pragma once

#include <shadowmath/bounds.hpp>
#include <shadowmath/clip_space.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/fault.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/reach.hpp>
#include <shadowmath/wide.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

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

// The region fills the map: lo lands on (-1, -1), hi on (1, 1); depth and w are left alone. A region that is empty, not
// finite, or so small or so large that its scale would not be, gives the identity.
template <class T>
[[nodiscard]] inline Mat4<T> region_matrix(Region<T> const& region) noexcept {
    if (!all_finite(region.lo) || !all_finite(region.hi) || is_empty(region)) return Mat4<T>(T(1));
    Vec2<T> const scale = T(2) / (region.hi - region.lo);
    Vec2<T> const offset = -(region.hi + region.lo) / (region.hi - region.lo);
    if (!all_finite(scale) || !all_finite(offset)) return Mat4<T>(T(1));
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

// Bounds in NDC of the part of a convex body at w >= w_min; empty when nothing is left, or an input is not finite. The
// body is given by eight corners whose indices differ in one bit along an edge, as those of a box or a view volume.
// Every point of the body at w >= w_min lies inside, to rounding, for any matrix and for boxes of +-FLT_MAX: the
// twelve edges are cut at w_min before anything is divided. A w_min that is not positive becomes the least one whose
// quotients still mean something: epsilon times the largest w.
template <class T>
[[nodiscard]] inline Aabb<T> projected_bounds(Mat4<T> const& clip_from_world, std::array<Vec3<T>, 8> const& corners,
                                              T w_min) noexcept {
    if (!all_finite(clip_from_world) || !all_finite(&w_min, 1)) return {};
    T entry = T(0);
    for (int column = 0; column < 4; ++column)
        for (int r = 0; r < 4; ++r) entry = glm::max(entry, std::abs(clip_from_world[column][r]));
    if (!(entry > T(0))) return {};
    // Homogeneous coordinates may be scaled by anything positive. Matrices and points too large to be multiplied are
    // brought down, each point together with its own share of w_min; ordinary ones keep every bit.
    constexpr T ordinary = T(1e15);
    Mat4<T> const clip = entry > ordinary ? clip_from_world * (T(1) / entry) : clip_from_world;
    T const floor = entry > ordinary ? w_min / entry : w_min;
    std::array<Vec4<T>, 8> point;
    std::array<T, 8> share;
    T largest_w = T(0);
    for (unsigned i = 0; i < 8; ++i) {
        if (!all_finite(corners[i])) return {};
        T const reach = glm::max(std::abs(corners[i].x), glm::max(std::abs(corners[i].y), std::abs(corners[i].z)));
        share[i] = reach > ordinary ? T(1) / reach : T(1);
        point[i] = clip * Vec4<T>(corners[i] * share[i], share[i]);
        largest_w = glm::max(largest_w, point[i].w);
    }
    constexpr T tiny = T(8) * std::numeric_limits<T>::min();
    T const least = glm::max(floor > T(0) ? floor : std::numeric_limits<T>::epsilon() * largest_w, tiny);
    T const largest = std::numeric_limits<T>::max();
    Aabb<T> bounds;
    auto const add = [&bounds, largest](Vec4<T> const& p, T w) {
        // A quotient may overflow where w is far below the rest; the largest number still bounds it.
        Vec3<T> const ndc(p.x / w, p.y / w, p.z / w);
        bounds = merge(bounds, glm::clamp(ndc, Vec3<T>(-largest), Vec3<T>(largest)));
    };
    for (unsigned i = 0; i < 8; ++i) {
        T const above = point[i].w - least * share[i];
        if (above >= T(0)) add(point[i], glm::max(point[i].w, tiny));
        for (unsigned bit = 1; bit < 8; bit <<= 1) {
            unsigned const j = i | bit;
            T const other = point[j].w - least * share[j];
            if (j == i || (above >= T(0)) == (other >= T(0))) continue;
            T const t = above / (above - other);
            add(point[i] * (T(1) - t) + point[j] * t, glm::max(least * (share[i] * (T(1) - t) + share[j] * t), tiny));
        }
    }
    return bounds;
}

namespace detail {

inline constexpr int bodies_at_once = 16;

// The least and the largest NDC so far, one of each for every place in a block.
template <class T>
struct BoundsInLanes {
    T lo[3][bodies_at_once];
    T hi[3][bodies_at_once];
};

// One block of boxes. `plain` says which of them were taken: all eight corners at w >= w_min, nothing empty, nothing
// too large. The others are left to the caller, but for those wholly behind w_min, which have no bounds.
template <class T>
struct BoundsBlock {
    Mat4<T> const& m;
    T w_min;
    BoxArrays<T> const& boxes;
    BoundsInLanes<T>& bounds;
    std::uint32_t* plain;
    std::uint32_t* behind;

    // Products of a row with both ends of each axis: a corner is X + Y + Z, so eight corners are six products.
    struct Row {
        T x0, x1, y0, y1, z0, z1;
    };
    [[gnu::always_inline]] Row row_of(int r, int i) const noexcept {
        return {m[0][r] * boxes.lo_x[i], m[0][r] * boxes.hi_x[i],           m[1][r] * boxes.lo_y[i],
                m[1][r] * boxes.hi_y[i], m[2][r] * boxes.lo_z[i] + m[3][r], m[2][r] * boxes.hi_z[i] + m[3][r]};
    }
    [[gnu::always_inline]] static T less(T a, T b) noexcept { return a < b ? a : b; }
    [[gnu::always_inline]] static T more(T a, T b) noexcept { return a > b ? a : b; }

    [[gnu::always_inline]] static T sum(Row const& row, int corner) noexcept {
        return (corner & 1 ? row.x1 : row.x0) + (corner & 2 ? row.y1 : row.y0) + (corner & 4 ? row.z1 : row.z0);
    }

    // The four rows of a matrix with (0, 0, 0, w) below: extents add up, and one quotient at the end serves all.
    [[gnu::always_inline]] void affine() const noexcept {
        for (int r = 0; r < 3; ++r) {
            for (int i = 0; i < bodies_at_once; ++i) {
                Row const at = row_of(r, i);
                T const lo = less(at.x0, at.x1) + less(at.y0, at.y1) + less(at.z0, at.z1);
                T const hi = more(at.x0, at.x1) + more(at.y0, at.y1) + more(at.z0, at.z1);
                bounds.lo[r][i] = plain[i] != 0 ? less(bounds.lo[r][i], lo) : bounds.lo[r][i];
                bounds.hi[r][i] = plain[i] != 0 ? more(bounds.hi[r][i], hi) : bounds.hi[r][i];
            }
        }
    }

    [[gnu::always_inline]] void perspective() const noexcept {
        T inverse[8][bodies_at_once];
        for (int i = 0; i < bodies_at_once; ++i) {
            Row const w = row_of(3, i);
            T const least = less(w.x0, w.x1) + less(w.y0, w.y1) + less(w.z0, w.z1);
            T const most = more(w.x0, w.x1) + more(w.y0, w.y1) + more(w.z0, w.z1);
            behind[i] = ((most < w_min) & (plain[i] != 0)) ? 1u : 0u;
            plain[i] = least >= w_min ? plain[i] : 0u;
            inverse[0][i] = T(1) / sum(w, 0), inverse[1][i] = T(1) / sum(w, 1);
            inverse[2][i] = T(1) / sum(w, 2), inverse[3][i] = T(1) / sum(w, 3);
            inverse[4][i] = T(1) / sum(w, 4), inverse[5][i] = T(1) / sum(w, 5);
            inverse[6][i] = T(1) / sum(w, 6), inverse[7][i] = T(1) / sum(w, 7);
        }
        for (int r = 0; r < 3; ++r) {
            for (int i = 0; i < bodies_at_once; ++i) {
                Row const at = row_of(r, i);
                T const a = sum(at, 0) * inverse[0][i], b = sum(at, 1) * inverse[1][i];
                T const c = sum(at, 2) * inverse[2][i], d = sum(at, 3) * inverse[3][i];
                T const e = sum(at, 4) * inverse[4][i], f = sum(at, 5) * inverse[5][i];
                T const g = sum(at, 6) * inverse[6][i], h = sum(at, 7) * inverse[7][i];
                T const lo = less(less(less(a, b), less(c, d)), less(less(e, f), less(g, h)));
                T const hi = more(more(more(a, b), more(c, d)), more(more(e, f), more(g, h)));
                bounds.lo[r][i] = plain[i] != 0 ? less(bounds.lo[r][i], lo) : bounds.lo[r][i];
                bounds.hi[r][i] = plain[i] != 0 ? more(bounds.hi[r][i], hi) : bounds.hi[r][i];
            }
        }
    }

    [[gnu::always_inline]] void operator()() const noexcept {
        decltype(beyond_reach(T(0))) beyond = 0;
        for (int i = 0; i < bodies_at_once; ++i) {
            T const sizes = std::abs(boxes.lo_x[i]) + std::abs(boxes.hi_x[i]) + std::abs(boxes.lo_y[i]) +
                            std::abs(boxes.hi_y[i]) + std::abs(boxes.lo_z[i]) + std::abs(boxes.hi_z[i]);
            beyond |= beyond_reach(sizes);
        }
        if (beyond >> (8 * sizeof beyond - 1) != 0) {
            for (int i = 0; i < bodies_at_once; ++i) plain[i] = behind[i] = 0;
            return;
        }
        for (int i = 0; i < bodies_at_once; ++i) {
            plain[i] =
                ((boxes.lo_x[i] <= boxes.hi_x[i]) & (boxes.lo_y[i] <= boxes.hi_y[i]) & (boxes.lo_z[i] <= boxes.hi_z[i]))
                    ? 1u
                    : 0u;
            behind[i] = 0;
        }
        bool const flat = m[0][3] == T(0) && m[1][3] == T(0) && m[2][3] == T(0);
        if (flat)
            affine();
        else
            perspective();
    }
};

}  // namespace detail

// The bounds of many boxes together: what projected_bounds of each, merged, would give, to rounding; a box that is
// empty or not finite adds nothing. For a w_min that is not positive one by one, and slowly, unless the matrix is
// affine.
template <class T>
[[nodiscard]] inline Aabb<T> projected_bounds(Mat4<T> const& clip_from_world, BoxArrays<T> const& boxes, int count,
                                              T w_min) noexcept {
    if (!all_finite(clip_from_world) || !all_finite(&w_min, 1)) return {};
    Mat4<T> const& m = clip_from_world;
    T entry = T(0);
    for (int column = 0; column < 4; ++column)
        for (int r = 0; r < 4; ++r) entry = glm::max(entry, std::abs(m[column][r]));
    bool const flat = m[0][3] == T(0) && m[1][3] == T(0) && m[2][3] == T(0);
    T const w = m[3][3];
    bool const in_blocks = entry <= T(1e15) && (flat ? w >= T(1e-15) && w >= w_min : w_min >= T(1e-15));
    Aabb<T> all;
    detail::BoundsInLanes<T> lanes;
    for (int r = 0; r < 3; ++r)
        for (int i = 0; i < detail::bodies_at_once; ++i) {
            lanes.lo[r][i] = std::numeric_limits<T>::max();
            lanes.hi[r][i] = std::numeric_limits<T>::lowest();
        }
    constexpr int n = detail::bodies_at_once;
    for (int begin = 0; begin < count; begin += n) {
        BoxArrays<T> const block = boxes_from(boxes, begin);
        int const length = count - begin < n ? count - begin : n;
        std::uint32_t plain[n] = {}, behind[n] = {};
        if (in_blocks && length == n) detail::run_widely(detail::BoundsBlock<T>{m, w_min, block, lanes, plain, behind});
        for (int i = 0; i < length; ++i) {
            if ((plain[i] | behind[i]) != 0) continue;
            Aabb<T> const box = box_at(block, i);
            if (all_finite(box) && !is_empty(box)) all = merge(all, projected_bounds(m, corners(box), w_min));
        }
    }
    Aabb<T> in_lanes;
    for (int r = 0; r < 3; ++r)
        for (int i = 0; i < n; ++i) {
            in_lanes.lo[r] = glm::min(in_lanes.lo[r], lanes.lo[r][i]);
            in_lanes.hi[r] = glm::max(in_lanes.hi[r], lanes.hi[r][i]);
        }
    if (is_empty(in_lanes)) return all;
    return merge(all, flat ? Aabb<T>{in_lanes.lo / w, in_lanes.hi / w} : in_lanes);
}

}  // namespace v0
}  // namespace shadowmath
