// SPDX-License-Identifier: MIT
//
// What a matrix makes of bodies: the bounds in NDC of one, or of a hundred thousand boxes together, clipped before the
// divide. The rectangle of a map that receivers or casters need (region.hpp).
//
// Any matrix will do. Source: ours; boxes as in culling.hpp, a corner is X + Y + Z.
#pragma once

#include <shadowmath/bounds.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/lanes.hpp>
#include <shadowmath/reach.hpp>
#include <shadowmath/wide.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace shadowmath {
inline namespace v0 {

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
        // No farther down than that: 1 / FLT_MAX is no normal number.
        share[i] = reach > ordinary ? ordinary / reach : T(1);
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

// Least and largest NDC so far, one of each for every place in a block of boxes.
template <class T>
struct BoundsInBlocks {
    static constexpr int n = bodies_at_once;
    static constexpr T none = std::numeric_limits<T>::max();
    T lo[3][bodies_at_once];
    T hi[3][bodies_at_once];

    [[gnu::always_inline]] BoundsInBlocks() noexcept {
        for (int r = 0; r < 3; ++r)
            for (int i = 0; i < n; ++i) lo[r][i] = none, hi[r][i] = -none;
    }
    [[gnu::always_inline]] static T less(T a, T b) noexcept { return a < b ? a : b; }
    [[gnu::always_inline]] static T more(T a, T b) noexcept { return a > b ? a : b; }
    // `away`: 0, or `none` for what does not count, which is then farther in than anything.
    [[gnu::always_inline]] void add(int r, int i, T away, T least, T most) noexcept {
        lo[r][i] = less(least + away, lo[r][i]);
        hi[r][i] = more(most - away, hi[r][i]);
    }
    [[nodiscard]] Aabb<T> merged() const noexcept {
        Aabb<T> all;
        for (int r = 0; r < 3; ++r)
            for (int i = 0; i < n; ++i) {
                all.lo[r] = less(all.lo[r], lo[r][i]);
                all.hi[r] = more(all.hi[r], hi[r][i]);
            }
        return all;
    }
};

// Products of a row with both ends of each axis of a box. A corner is X + Y + Z, so that eight corners are six
// products, and the extent of all of them is three sums.
template <class T>
struct EndProducts {
    T x0, x1, y0, y1, z0, z1;

    [[gnu::always_inline]] EndProducts(Vec4<T> const& row, BoxArrays<T> const& at, int i) noexcept
        : x0(row.x * at.lo_x[i]), x1(row.x * at.hi_x[i]), y0(row.y * at.lo_y[i]), y1(row.y * at.hi_y[i]),
          z0(row.z * at.lo_z[i] + row.w), z1(row.z * at.hi_z[i] + row.w) {}
    [[gnu::always_inline]] T least() const noexcept {
        return (x0 < x1 ? x0 : x1) + (y0 < y1 ? y0 : y1) + (z0 < z1 ? z0 : z1);
    }
    [[gnu::always_inline]] T most() const noexcept {
        return (x0 > x1 ? x0 : x1) + (y0 > y1 ? y0 : y1) + (z0 > z1 ? z0 : z1);
    }
};

// Bounds of whole blocks of boxes; projected_bounds below prepares the matrix.
template <class T>
struct BoundsOfBoxes {
    Mat4<T> const& matrix;
    T w_min;
    BoxArrays<T> const& boxes;
    int blocks;
    Aabb<T>& bounds;

    static constexpr int n = bodies_at_once;

    // What a block of boxes is: all in order and in reach, or some empty, or some that no product can be made of.
    enum class Kind { all_full, some_empty, beyond_reach };

    // As much as all coordinates of a box together.
    [[gnu::always_inline]] static T size_of(BoxArrays<T> const& at, int i) noexcept {
        return std::abs(at.lo_x[i]) + std::abs(at.hi_x[i]) + std::abs(at.lo_y[i]) + std::abs(at.hi_y[i]) +
               std::abs(at.lo_z[i]) + std::abs(at.hi_z[i]);
    }
    [[gnu::always_inline]] static Kind kind_of(BoxArrays<T> const& at,
                                               std::uint32_t (&taken)[bodies_at_once]) noexcept {
        decltype(beyond_reach(T(0))) beyond = 0;
        std::uint32_t all_taken = ~0u;
        for (int i = 0; i < n; ++i) beyond |= beyond_reach(size_of(at, i));
        if (beyond >> (8 * sizeof beyond - 1) != 0) return Kind::beyond_reach;
        for (int i = 0; i < n; ++i) {
            taken[i] = full(at, i) ? ~0u : 0u;
            all_taken &= taken[i];
        }
        return all_taken != 0 ? Kind::all_full : Kind::some_empty;
    }
    [[gnu::always_inline]] static bool full(BoxArrays<T> const& at, int i) noexcept {
        return (at.lo_x[i] <= at.hi_x[i]) & (at.lo_y[i] <= at.hi_y[i]) & (at.lo_z[i] <= at.hi_z[i]);
    }

    // w is the same everywhere: one quotient at the end serves all. So is what a row adds to every box. Which end of a
    // box goes farther along a row is a matter of the row's signs.
    [[gnu::always_inline]] void affine() const noexcept {
        BoundsInBlocks<T> so_far;
        std::uint32_t taken[bodies_at_once];
        T least[bodies_at_once], most[bodies_at_once];
        for (int block = 0; block < blocks; ++block) {
            BoxArrays<T> const at = boxes_from(boxes, block * n);
            Kind const kind = kind_of(at, taken);
            if (kind == Kind::beyond_reach) {
                one_by_one(at);
                continue;
            }
            for (int r = 0; r < 3; ++r) {
                Vec3<T> const above(row(matrix, r));
                T const *const x0 = above.x > T(0) ? at.lo_x : at.hi_x, *const x1 = above.x > T(0) ? at.hi_x : at.lo_x;
                T const *const y0 = above.y > T(0) ? at.lo_y : at.hi_y, *const y1 = above.y > T(0) ? at.hi_y : at.lo_y;
                T const *const z0 = above.z > T(0) ? at.lo_z : at.hi_z, *const z1 = above.z > T(0) ? at.hi_z : at.lo_z;
                T(&lo)[bodies_at_once] = so_far.lo[r], (&hi)[bodies_at_once] = so_far.hi[r];
                if (kind == Kind::all_full) {
                    for (int i = 0; i < n; ++i) {
                        lo[i] = so_far.less(lo[i], above.x * x0[i] + above.y * y0[i] + above.z * z0[i]);
                        hi[i] = so_far.more(hi[i], above.x * x1[i] + above.y * y1[i] + above.z * z1[i]);
                    }
                    continue;
                }
                for (int i = 0; i < n; ++i) {
                    least[i] = above.x * x0[i] + above.y * y0[i] + above.z * z0[i];
                    most[i] = above.x * x1[i] + above.y * y1[i] + above.z * z1[i];
                }
                // NOTE: in the loop above, this would become a branch.
                for (int i = 0; i < n; ++i) so_far.add(r, i, taken[i] != 0 ? T(0) : so_far.none, least[i], most[i]);
            }
        }
        Aabb<T> const merged = so_far.merged();
        Vec3<T> const offset(matrix[3]);
        if (!is_empty(merged))
            bounds = merge(bounds, Aabb<T>{(merged.lo + offset) / matrix[3][3], (merged.hi + offset) / matrix[3][3]});
    }

    // A side of what is known: a box does not reach beyond x / w = h where x - h w, which is linear, is negative at its
    // farthest corner. No quotient is needed for that.
    struct Side {
        T x, y, z, offset;
        T growth;               // by what the rounding of a quotient can make of it, for every metre of `size`
        bool hi_x, hi_y, hi_z;  // where the farthest corner is
    };
    void take_sides(Aabb<T> const& known, Side (&sides)[6]) const noexcept {
        auto const magnitude = [](Vec4<T> const& v) {
            return glm::max(glm::max(std::abs(v.x), std::abs(v.y)), std::abs(v.z));
        };
        constexpr T unsure = T(16) * std::numeric_limits<T>::epsilon();
        Vec4<T> const below = row(matrix, 3);
        for (int i = 0; i < 6; ++i) {
            Vec4<T> const above = row(matrix, i / 2);
            T const h = i % 2 == 0 ? known.lo[i / 2] : known.hi[i / 2], further = std::abs(h);
            Vec4<T> const beyond = (above - below * h) * (i % 2 == 0 ? T(-1) : T(1));
            T const offset = beyond.w + unsure * (std::abs(above.w) + further * std::abs(below.w));
            sides[i] = {beyond.x,
                        beyond.y,
                        beyond.z,
                        offset,
                        unsure * (magnitude(above) + further * magnitude(below)),
                        beyond.x > T(0),
                        beyond.y > T(0),
                        beyond.z > T(0)};
        }
    }
    // Whether a box of the block that is `taken` may reach beyond a side.
    [[gnu::always_inline]] bool may_extend(Side const (&sides)[6], BoxArrays<T> const& at,
                                           std::uint32_t const (&taken)[bodies_at_once]) const noexcept {
        T size[bodies_at_once];
        for (int i = 0; i < n; ++i) size[i] = size_of(at, i);
        for (Side const& side : sides) {
            T const* const x = side.hi_x ? at.hi_x : at.lo_x;
            T const* const y = side.hi_y ? at.hi_y : at.lo_y;
            T const* const z = side.hi_z ? at.hi_z : at.lo_z;
            T const a = side.x, b = side.y, c = side.z, growth = side.growth, offset = side.offset;
            std::uint32_t may = 0;
            for (int i = 0; i < n; ++i) {
                T const beyond = a * x[i] + b * y[i] + c * z[i] + (growth * size[i] + offset);
                may |= beyond > T(0) ? taken[i] : 0u;
            }
            if (may != 0) return true;
        }
        return false;
    }

    [[gnu::always_inline]] void perspective() const noexcept {
        BoundsInBlocks<T> so_far;
        // Of what is known after the first 64 blocks, and after 128, 256, ... It does not pay sooner.
        Side sides[6];
        T inverse[8][bodies_at_once];
        std::uint32_t taken[bodies_at_once], astride[bodies_at_once];  // all of it at w >= w_min; a part of it
        for (int block = 0; block < blocks; ++block) {
            BoxArrays<T> const at = boxes_from(boxes, block * n);
            if (kind_of(at, taken) == Kind::beyond_reach) {
                one_by_one(at);
                continue;
            }
            std::uint32_t any_astride = 0;
            Vec4<T> const below = row(matrix, 3);
            for (int i = 0; i < n; ++i) {
                EndProducts<T> const w(below, at, i);
                T const least = w.least(), most = w.most();
                std::uint32_t const in_front = least >= w_min ? ~0u : 0u, reaches = most >= w_min ? ~0u : 0u;
                astride[i] = taken[i] & reaches & ~in_front;
                taken[i] &= in_front;
                any_astride |= astride[i];
                T const xy00 = w.x0 + w.y0, xy10 = w.x1 + w.y0, xy01 = w.x0 + w.y1, xy11 = w.x1 + w.y1;
                // Corners that do not count may be at w = 0 itself; of those that do this changes none.
                auto const over = [this](T corner_w) { return T(1) / (corner_w > w_min ? corner_w : w_min); };
                inverse[0][i] = over(xy00 + w.z0), inverse[1][i] = over(xy10 + w.z0);
                inverse[2][i] = over(xy01 + w.z0), inverse[3][i] = over(xy11 + w.z0);
                inverse[4][i] = over(xy00 + w.z1), inverse[5][i] = over(xy10 + w.z1);
                inverse[6][i] = over(xy01 + w.z1), inverse[7][i] = over(xy11 + w.z1);
            }
            if (any_astride != 0)
                for (int i = 0; i < n; ++i)
                    if (astride[i] != 0) add_astride(at, i);
            if (block >= 64) {
                if ((block & (block - 1)) == 0) take_sides(merge(bounds, so_far.merged()), sides);
                if (!may_extend(sides, at, taken)) continue;
            }
            T away[bodies_at_once];
            for (int i = 0; i < n; ++i) away[i] = taken[i] != 0 ? T(0) : so_far.none;
            for (int r = 0; r < 3; ++r) {
                Vec4<T> const above = row(matrix, r);
                for (int i = 0; i < n; ++i) {
                    EndProducts<T> const p(above, at, i);
                    T const xy00 = p.x0 + p.y0, xy10 = p.x1 + p.y0, xy01 = p.x0 + p.y1, xy11 = p.x1 + p.y1;
                    T const a = (xy00 + p.z0) * inverse[0][i], b = (xy10 + p.z0) * inverse[1][i];
                    T const c = (xy01 + p.z0) * inverse[2][i], d = (xy11 + p.z0) * inverse[3][i];
                    T const e = (xy00 + p.z1) * inverse[4][i], f = (xy10 + p.z1) * inverse[5][i];
                    T const g = (xy01 + p.z1) * inverse[6][i], h = (xy11 + p.z1) * inverse[7][i];
                    auto const less = [](T s, T t) { return BoundsInBlocks<T>::less(s, t); };
                    auto const more = [](T s, T t) { return BoundsInBlocks<T>::more(s, t); };
                    T const least = less(less(less(a, b), less(c, d)), less(less(e, f), less(g, h)));
                    T const most = more(more(more(a, b), more(c, d)), more(more(e, f), more(g, h)));
                    so_far.add(r, i, away[i], least, most);
                }
            }
        }
        bounds = merge(bounds, so_far.merged());
    }

    // Points of one box, four at a time: least and largest NDC of those that count, which have nothing lacking.
    struct BoundsInLanes {
        using Four = Lanes<T>;
        Four lo[3] = {Four::all(none), Four::all(none), Four::all(none)};
        Four hi[3] = {Four::all(-none), Four::all(-none), Four::all(-none)};
        static constexpr T none = std::numeric_limits<T>::max();

        [[gnu::always_inline]] void add(Four const (&point)[3], Four const& per_w, Four const& lacking) noexcept {
            Four const zero = Four::all(T(0));
            for (int r = 0; r < 3; ++r) {
                Four const ndc = point[r] * per_w;
                lo[r] = least(where_at_most(lacking, zero, ndc, Four::all(none)), lo[r]);
                hi[r] = largest(where_at_most(lacking, zero, ndc, Four::all(-none)), hi[r]);
            }
        }
    };

    // A box in reach that is partly at w < w_min: its corners in front of that, and where its edges pass through it.
    [[gnu::always_inline]] void add_astride(BoxArrays<T> const& at, int i) const noexcept {
        using Four = Lanes<T>;
        Four const zero = Four::all(T(0)), one = Four::all(T(1)), least_w = Four::all(w_min);
        Four lower[4], upper[4];  // rows of the corners at either end of z: x grows first, then y
        for (int r = 0; r < 4; ++r) {
            EndProducts<T> const p(row(matrix, r), at, i);
            Four const xy = Four::of(p.x0, p.x1, p.x0, p.x1) + Four::of(p.y0, p.y0, p.y1, p.y1);
            lower[r] = xy + Four::all(p.z0), upper[r] = xy + Four::all(p.z1);
        }
        BoundsInLanes in_lanes;
        auto const add_corners = [&](Four const(&corner)[4]) {
            in_lanes.add({corner[0], corner[1], corner[2]}, one / largest(corner[3], least_w),
                         where_at_most(least_w, corner[3], zero, one));
        };
        add_corners(lower), add_corners(upper);
        auto const add_edges = [&](Four const(&from)[4], Four const(&to)[4]) {
            Four const above = from[3] - least_w, other = to[3] - least_w;
            Four const none_behind = where_at_most(zero, least(above, other), one, zero);
            Four const lacking = where_at_most(zero, largest(above, other), none_behind, one);
            // Of an edge that does not pass through: its beginning.
            Four const t = where_at_most(lacking, zero, above, zero) / where_at_most(lacking, zero, above - other, one),
                       rest = one - t;
            in_lanes.add({from[0] * rest + to[0] * t, from[1] * rest + to[1] * t, from[2] * rest + to[2] * t},
                         one / least_w, lacking);
        };
        Four x_from[4], x_to[4], y_from[4], y_to[4];
        for (int r = 0; r < 4; ++r) {
            x_from[r] = picked<0, 2, 4, 6>(lower[r], upper[r]), x_to[r] = picked<1, 3, 5, 7>(lower[r], upper[r]);
            y_from[r] = picked<0, 1, 4, 5>(lower[r], upper[r]), y_to[r] = picked<2, 3, 6, 7>(lower[r], upper[r]);
        }
        add_edges(x_from, x_to), add_edges(y_from, y_to), add_edges(lower, upper);
        // Numbers that are too large for the type are the largest.
        constexpr T largest_number = std::numeric_limits<T>::max();
        for (int r = 0; r < 3; ++r)
            for (int k = 0; k < 4; ++k) {
                T const lo = in_lanes.lo[r][k], hi = in_lanes.hi[r][k];
                bounds.lo[r] = BoundsInBlocks<T>::less(BoundsInBlocks<T>::more(lo, -largest_number), bounds.lo[r]);
                bounds.hi[r] = BoundsInBlocks<T>::more(BoundsInBlocks<T>::less(hi, largest_number), bounds.hi[r]);
            }
    }

    // Whatever they are.
    void one_by_one(BoxArrays<T> const& at) const noexcept {
        for (int i = 0; i < n; ++i) {
            Aabb<T> const box = box_at(at, i);
            if (all_finite(box) && !is_empty(box))
                bounds = merge(bounds, projected_bounds(matrix, corners(box), w_min));
        }
    }

    [[gnu::always_inline]] void operator()() const noexcept {
        bool const flat = matrix[0][3] == T(0) && matrix[1][3] == T(0) && matrix[2][3] == T(0);
        if (flat)
            affine();
        else
            perspective();
    }
};

}  // namespace detail

// The bounds of many boxes together: what projected_bounds of each, merged, would give, to rounding; a box that is
// empty or not finite adds nothing. Fast where w_min is positive, or the matrix affine; otherwise box by box.
template <class T>
[[nodiscard]] inline Aabb<T> projected_bounds(Mat4<T> const& clip_from_world, BoxArrays<T> const& boxes, int count,
                                              T w_min) noexcept {
    Aabb<T> bounds;
    if (!all_finite(clip_from_world) || !all_finite(&w_min, 1)) return bounds;
    Mat4<T> const& m = clip_from_world;
    T entry = T(0);
    for (int column = 0; column < 4; ++column)
        for (int r = 0; r < 4; ++r) entry = glm::max(entry, std::abs(m[column][r]));
    bool const flat = m[0][3] == T(0) && m[1][3] == T(0) && m[2][3] == T(0);
    bool const ordinary = entry <= T(1e15) && (flat ? m[3][3] >= T(1e-15) && m[3][3] >= w_min : w_min >= T(1e-15));
    constexpr int n = detail::bodies_at_once;
    int const whole = ordinary && count > 0 ? count / n * n : 0;
    if (whole > 0) detail::run_widely(detail::BoundsOfBoxes<T>{m, w_min, boxes, whole / n, bounds});
    if (ordinary && count > whole) {
        // What is left of a block, filled up with copies of its first box, which change nothing.
        T ends[6][n];
        for (int i = 0; i < n; ++i) {
            Aabb<T> const box = box_at(boxes, whole + i < count ? whole + i : whole);
            for (int axis = 0; axis < 3; ++axis) ends[axis][i] = box.lo[axis], ends[axis + 3][i] = box.hi[axis];
        }
        BoxArrays<T> const rest{ends[0], ends[1], ends[2], ends[3], ends[4], ends[5]};
        detail::run_widely(detail::BoundsOfBoxes<T>{m, w_min, rest, 1, bounds});
    }
    for (int i = ordinary ? count : 0; i < count; ++i) {
        Aabb<T> const box = box_at(boxes, i);
        if (all_finite(box) && !is_empty(box)) bounds = merge(bounds, projected_bounds(m, corners(box), w_min));
    }
    return bounds;
}

}  // namespace v0
}  // namespace shadowmath
