// SPDX-License-Identifier: MIT
//
// Bounds in NDC of many boxes together, sixteen at a time: the inside of projected_bounds.hpp.
//
// Source: ours. A corner is X + Y + Z, as in culling.hpp; whether a box reaches beyond what is known needs no quotient.
#pragma once

#include <shadowmath/bounds.hpp>
#include <shadowmath/bounds_of_body.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/lanes.hpp>
#include <shadowmath/reach.hpp>

#include <cmath>
#include <cstdint>
#include <limits>

namespace shadowmath {
inline namespace v0 {
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
        for (int r = 0; r < 3; ++r) {
            T least = none, most = -none;
            for (int i = 0; i < n; ++i) least = less(least, lo[r][i]), most = more(most, hi[r][i]);
            all.lo[r] = least, all.hi[r] = most;
        }
        return {within_numbers(all.lo), within_numbers(all.hi)};
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

// Points of one box after another, four at a time: least and largest NDC of those that count, which have nothing
// lacking.
template <class T>
struct BoundsInLanes {
    using Four = Lanes<T>;
    static constexpr T none = std::numeric_limits<T>::max();
    Four lo[3] = {all_four(none), all_four(none), all_four(none)};
    Four hi[3] = {all_four(-none), all_four(-none), all_four(-none)};

    [[gnu::always_inline]] void add(Four const& x, Four const& y, Four const& z, Four const& per_w,
                                    Four const& lacking) noexcept {
        add(0, x * per_w, lacking), add(1, y * per_w, lacking), add(2, z * per_w, lacking);
    }
    [[gnu::always_inline]] void add(int r, Four const& ndc, Four const& lacking) noexcept {
        Four const zero = all_four(T(0));
        lo[r] = least(where_at_most(lacking, zero, ndc, all_four(none)), lo[r]);
        hi[r] = largest(where_at_most(lacking, zero, ndc, all_four(-none)), hi[r]);
    }
    [[nodiscard]] Aabb<T> merged() const noexcept {
        Aabb<T> all;
        for (int r = 0; r < 3; ++r)
            for (int k = 0; k < 4; ++k) {
                all.lo[r] = glm::min(all.lo[r], lo[r][k]);
                all.hi[r] = glm::max(all.hi[r], hi[r][k]);
            }
        return {within_numbers(all.lo), within_numbers(all.hi)};
    }
};

// Bounds of boxes, block by block, under a matrix that projected_bounds.hpp has prepared.
template <class T>
struct BoundsOfBoxes {
    Mat4<T> const& matrix;
    Vec4<T> const (&rows)[4];  // of the matrix
    T w_min;
    BoxArrays<T> const& boxes;
    int count;  // a block and more
    Aabb<T>& bounds;

    static constexpr int n = bodies_at_once;

    [[nodiscard, gnu::always_inline]] int blocks() const noexcept { return (count + n - 1) / n; }
    // The last block has some boxes of the one before once more, which changes nothing.
    [[nodiscard, gnu::always_inline]] int begin_of(int block) const noexcept {
        return block * n + n <= count ? block * n : count - n;
    }

    // What a block of boxes is: all in order and in reach, or some empty, or some that no product can be made of.
    enum class Kind { all_full, some_empty, beyond_reach };

    // As much as all coordinates of a box together.
    [[gnu::always_inline]] static T size_of(BoxArrays<T> const& at, int i) noexcept {
        return std::abs(at.lo_x[i]) + std::abs(at.hi_x[i]) + std::abs(at.lo_y[i]) + std::abs(at.hi_y[i]) +
               std::abs(at.lo_z[i]) + std::abs(at.hi_z[i]);
    }
    [[gnu::always_inline]] static Kind kind_of(BoxArrays<T> const& at, std::uint32_t (&taken)[bodies_at_once],
                                               T (&size)[bodies_at_once]) noexcept {
        decltype(beyond_reach(T(0))) beyond = 0;
        std::uint32_t all_taken = ~0u;
        for (int i = 0; i < n; ++i) {
            size[i] = size_of(at, i);
            beyond |= beyond_reach(size[i]);
        }
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
        T size[bodies_at_once], least[bodies_at_once], most[bodies_at_once];
        for (int block = 0; block < blocks(); ++block) {
            BoxArrays<T> const at = boxes_from(boxes, begin_of(block));
            Kind const kind = kind_of(at, taken, size);
            if (kind == Kind::beyond_reach) {
                one_by_one(at);
                continue;
            }
            for (int r = 0; r < 3; ++r) {
                Vec3<T> const above(rows[r]);
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
        auto const ndc = [&](Vec3<T> const& p) { return within_numbers((p + offset) / matrix[3][3]); };
        if (!is_empty(merged)) bounds = merge(bounds, Aabb<T>{ndc(merged.lo), ndc(merged.hi)});
    }

    // Of each box of a block the corner that is farthest along a row, or nearest: a matter of the row's signs.
    struct Ends {
        T const *x, *y, *z;

        [[gnu::always_inline]] Ends from(int begin) const noexcept { return {x + begin, y + begin, z + begin}; }
        // In the order of EndProducts.
        [[gnu::always_inline]] T along(Vec4<T> const& row, int i) const noexcept {
            return (row.x * x[i] + row.y * y[i]) + (row.z * z[i] + row.w);
        }
    };
    [[gnu::always_inline]] static Ends ends_of(BoxArrays<T> const& at, Vec4<T> const& row, bool farthest) noexcept {
        return {(row.x > T(0)) == farthest ? at.hi_x : at.lo_x, (row.y > T(0)) == farthest ? at.hi_y : at.lo_y,
                (row.z > T(0)) == farthest ? at.hi_z : at.lo_z};
    }

    // A side of what is known: a box does not reach beyond x / w = h where x - h w, which is linear, is negative at its
    // farthest corner. No quotient is needed for that.
    struct Side {
        T x, y, z, offset;
        Ends farthest;  // of all boxes
        T growth;       // by what the rounding of a quotient can make of it, for every metre of `size`
    };
    // False where nothing is known.
    bool take_sides(Aabb<T> const& known, Side (&sides)[6]) const noexcept {
        if (is_empty(known)) return false;
        auto const magnitude = [](Vec4<T> const& v) {
            return glm::max(glm::max(std::abs(v.x), std::abs(v.y)), std::abs(v.z));
        };
        constexpr T unsure = T(16) * std::numeric_limits<T>::epsilon();
        Vec4<T> const below = rows[3];
        for (int i = 0; i < 6; ++i) {
            Vec4<T> const above = rows[i / 2];
            T const h = i % 2 == 0 ? known.lo[i / 2] : known.hi[i / 2], further = std::abs(h);
            Vec4<T> const beyond = (above - below * h) * (i % 2 == 0 ? T(-1) : T(1));
            T const offset = beyond.w + unsure * (std::abs(above.w) + further * std::abs(below.w));
            sides[i] = {beyond.x,
                        beyond.y,
                        beyond.z,
                        offset,
                        ends_of(boxes, beyond, true),
                        unsure * (magnitude(above) + further * magnitude(below))};
        }
        return true;
    }
    // Whether a box of the block that is `taken` may reach beyond a side.
    [[gnu::always_inline]] bool may_extend(Side const (&sides)[6], int begin, T const (&size)[bodies_at_once],
                                           std::uint32_t const (&taken)[bodies_at_once]) const noexcept {
        for (int r = 0; r < 3; ++r) {
            Vec4<T> const below(sides[2 * r].x, sides[2 * r].y, sides[2 * r].z, sides[2 * r].offset);
            Vec4<T> const above(sides[2 * r + 1].x, sides[2 * r + 1].y, sides[2 * r + 1].z, sides[2 * r + 1].offset);
            Ends const lower = sides[2 * r].farthest.from(begin), upper = sides[2 * r + 1].farthest.from(begin);
            T const lo_growth = sides[2 * r].growth, hi_growth = sides[2 * r + 1].growth;
            std::uint32_t may = 0;
            // NOTE: what is no number may.
            for (int i = 0; i < n; ++i) {
                std::uint32_t const inside_lo = lower.along(below, i) + lo_growth * size[i] <= T(0) ? ~0u : 0u;
                std::uint32_t const inside_hi = upper.along(above, i) + hi_growth * size[i] <= T(0) ? ~0u : 0u;
                may |= taken[i] & ~(inside_lo & inside_hi);
            }
            if (may != 0) return true;
        }
        return false;
    }

    // Which of a block's boxes are wholly at w >= w_min, and which but partly; false where none is the latter.
    [[gnu::always_inline]] bool sort(Ends const& least, Ends const& most, std::uint32_t (&taken)[bodies_at_once],
                                     std::uint32_t (&astride)[bodies_at_once]) const noexcept {
        Vec4<T> const below = rows[3];
        std::uint32_t any_astride = 0;
        for (int i = 0; i < n; ++i) {
            std::uint32_t const in_front = least.along(below, i) >= w_min ? ~0u : 0u;
            std::uint32_t const reaches = most.along(below, i) >= w_min ? ~0u : 0u;
            astride[i] = taken[i] & reaches & ~in_front;
            taken[i] &= in_front;
            any_astride |= astride[i];
        }
        return any_astride != 0;
    }

    [[gnu::always_inline]] void add_all_corners(BoxArrays<T> const& at, std::uint32_t const (&taken)[bodies_at_once],
                                                BoundsInBlocks<T>& so_far) const noexcept {
        T inverse[8][bodies_at_once], away[bodies_at_once];
        Vec4<T> const below = rows[3];
        for (int i = 0; i < n; ++i) {
            EndProducts<T> const w(below, at, i);
            T const xy00 = w.x0 + w.y0, xy10 = w.x1 + w.y0, xy01 = w.x0 + w.y1, xy11 = w.x1 + w.y1;
            // Corners that do not count may be at w = 0 itself, and farther out than numbers go: they are taken to the
            // origin. Of those that do this changes none.
            T const counts = taken[i] != 0 ? T(1) : T(0);
            auto const over = [this, counts](T corner_w) { return counts / (corner_w > w_min ? corner_w : w_min); };
            inverse[0][i] = over(xy00 + w.z0), inverse[1][i] = over(xy10 + w.z0);
            inverse[2][i] = over(xy01 + w.z0), inverse[3][i] = over(xy11 + w.z0);
            inverse[4][i] = over(xy00 + w.z1), inverse[5][i] = over(xy10 + w.z1);
            inverse[6][i] = over(xy01 + w.z1), inverse[7][i] = over(xy11 + w.z1);
            away[i] = taken[i] != 0 ? T(0) : so_far.none;
        }
        for (int r = 0; r < 3; ++r) {
            Vec4<T> const above = rows[r];
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

    [[gnu::always_inline]] void perspective() const noexcept {
        BoundsInBlocks<T> so_far;
        Side sides[6];
        std::uint32_t taken[bodies_at_once], astride[bodies_at_once];
        Ends const nearest = ends_of(boxes, rows[3], false), farthest = ends_of(boxes, rows[3], true);
        T size[bodies_at_once];
        BoundsInLanes<T> of_astride;
        bool known = false;
        for (int block = 0; block < blocks(); ++block) {
            int const begin = begin_of(block);
            BoxArrays<T> const at = boxes_from(boxes, begin);
            if (kind_of(at, taken, size) == Kind::beyond_reach) {
                one_by_one(at);
                continue;
            }
            if (sort(nearest.from(begin), farthest.from(begin), taken, astride))
                for (int i = 0; i < n; ++i)
                    if (astride[i] != 0) add_astride(at, i, of_astride);
            // It does not pay sooner, nor to look more often.
            if (block >= 16 && (block & (block - 1)) == 0)
                known = take_sides(merge(bounds, merge(of_astride.merged(), so_far.merged())), sides);
            if (known && !may_extend(sides, begin, size, taken)) continue;
            add_all_corners(at, taken, so_far);
        }
        bounds = merge(bounds, merge(of_astride.merged(), so_far.merged()));
    }

    // A box in reach that is partly at w < w_min: its corners in front of that, and where its edges pass through it.
    [[gnu::always_inline]] void add_astride(BoxArrays<T> const& at, int i, BoundsInLanes<T>& of) const noexcept {
        using Four = Lanes<T>;
        Four const zero = Four::all(T(0)), one = Four::all(T(1)), least_w = Four::all(w_min), per_w = one / least_w;
        Four lower[4], upper[4];  // rows of the corners at either end of z: x grows first, then y
        for (int r = 0; r < 4; ++r) {
            EndProducts<T> const p(rows[r], at, i);
            Four const xy = Four::of(p.x0, p.x1, p.x0, p.x1) + Four::of(p.y0, p.y0, p.y1, p.y1);
            lower[r] = xy + Four::all(p.z0), upper[r] = xy + Four::all(p.z1);
        }
        auto const add_corners = [&](Four const(&corner)[4]) {
            of.add(corner[0], corner[1], corner[2], one / largest(corner[3], least_w),
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
            of.add(from[0] * rest + to[0] * t, from[1] * rest + to[1] * t, from[2] * rest + to[2] * t, per_w, lacking);
        };
        Four x_from[4], x_to[4], y_from[4], y_to[4];
        for (int r = 0; r < 4; ++r) {
            x_from[r] = picked<0, 2, 4, 6>(lower[r], upper[r]), x_to[r] = picked<1, 3, 5, 7>(lower[r], upper[r]);
            y_from[r] = picked<0, 1, 4, 5>(lower[r], upper[r]), y_to[r] = picked<2, 3, 6, 7>(lower[r], upper[r]);
        }
        add_edges(x_from, x_to), add_edges(y_from, y_to), add_edges(lower, upper);
    }

    // Whatever they are.
    void one_by_one(BoxArrays<T> const& at) const noexcept {
        for (int i = 0; i < n; ++i) {
            Aabb<T> const box = box_at(at, i);
            if (all_finite(box) && !is_empty(box)) bounds = merge(bounds, bounds_of_body(matrix, corners(box), w_min));
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
}  // namespace v0
}  // namespace shadowmath
