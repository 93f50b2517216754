// SPDX-License-Identifier: MIT
//
// The last tenth: four quadrilaterals move against each other, corner by corner, until no small move makes the picture
// better.
//
//   A part's quadrilateral is the best around that part (fit_quad.hpp). Parts, though, are cut across the picture or
//   across depth, and what lies along a cut may be served better from the other side. Here a corner or a side moves; a
//   piece that falls out is taken in by the neighbour to whom that costs least, who grows around it.
//
// A piece is a few points that one map must hold together, such as a tile between its two depths. The pieces looked at
// are some of all, and those at the rim; at the end all of them are, and a quadrilateral grows around what none holds.
//
// A step of choose_maps.hpp; of no use without it. Source: none.
#pragma once

#include <shadowmath/config.hpp>
#include <shadowmath/fit_quad.hpp>
#include <shadowmath/footprint.hpp>
#include <shadowmath/light_samples.hpp>
#include <shadowmath/part_search.hpp>
#include <shadowmath/quad_map.hpp>
#include <shadowmath/quad_stack.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace shadowmath {
inline namespace v0 {
namespace detail {

// Sides of a quadrilateral about its own middle.
template <class T>
struct SidedQuad {
    QuadSides<T> side{};
    Vec2<T> middle{T(0)};
};

// Through corners in the order of Quad::corner.
template <class T>
[[nodiscard]] inline SidedQuad<T> sides_of(std::array<Vec2<T>, 4> const& corner) noexcept {
    SidedQuad<T> sided;
    sided.middle = (corner[0] + corner[1] + corner[2] + corner[3]) * T(0.25);
    auto const through = [&](unsigned i, unsigned j) {
        Vec2<T> const a = corner[i] - sided.middle, b = corner[j] - sided.middle;
        Vec3<T> const line(a.y - b.y, b.x - a.x, a.x * b.y - a.y * b.x);
        return line.z < T(0) ? -line : line;
    };
    sided.side = {through(0, 2), through(1, 3), through(0, 1), through(2, 3)};
    return sided;
}

template <class T>
[[nodiscard]] inline Quad<T> quad_of(SidedQuad<T> const& sided) noexcept {
    return moved(quad_between(sided.side), sided.middle);
}

// Each side moved out, where it stands, until the points (their x and y) are inside and a little more.
template <class T, class Point>
inline void grow(SidedQuad<T>& sided, Point const* points, int count) noexcept {
    for (Vec3<T>& side : sided.side) {
        T least = T(0);
        for (int i = 0; i < count; ++i) {
            Vec2<T> const p = Vec2<T>(points[i]) - sided.middle;
            T const inside = side.x * p.x + side.y * p.y + side.z;
            least = inside < least ? inside : least;
        }
        if (least < T(0)) side.z = (side.z - least) * (T(1) + T(1e-4));
    }
}

template <class T>
[[nodiscard]] inline bool holds(Quad<T> const& quad, SettlingPiece<T> const& piece) noexcept {
    for (int i = 0; i < piece.count; ++i)
        if (!is_in(quad, piece.point[static_cast<unsigned>(i)])) return false;
    return true;
}

template <class T>
class Settling {
public:
    Settling(MapSearch<T>& work, QuadStack<T> const& stack, T usable_texels) noexcept
        : work_(work), stack_(stack), usable_(usable_texels) {
        for (unsigned k = 0; k < maps(); ++k) {
            slot_[k] = k;
            judge(slot_[k], stack_.quad[k]);
        }
        price_ = price_with(maps(), 0, maps(), 0);
    }

    // Until no move of the smallest size helps, or `rounds` are over.
    void run(int rounds) noexcept {
        T step = T(0.16);
        for (int round = 0; round < rounds && step > T(0.01); ++round) {
            T const before = price_;
            for (unsigned k = 0; k < maps(); ++k)
                for (unsigned way = 0; way < ways; ++way) try_move(k, way, step);
            if (!(price_ < before * T(0.995))) step *= T(0.5);
        }
    }

    [[nodiscard]] QuadStack<T> const& stack() const noexcept { return stack_; }

private:
    static constexpr unsigned ways = 24;

    [[nodiscard]] unsigned maps() const noexcept { return static_cast<unsigned>(stack_.count); }

    void judge(unsigned slot, Quad<T> const& quad) noexcept {
        SettlingView<T>& view = work_.view[slot];
        for (unsigned i = 0; i < static_cast<unsigned>(work_.count); ++i) {
            LightSample<T> const& sample = work_.sample[i];
            view.price[i] =
                is_in(quad, sample.place) ? sample.weight * price_of(major_at(quad, usable_, sample)) : T(-1);
        }
        for (unsigned i = 0; i < static_cast<unsigned>(work_.piece_count); ++i)
            view.holds[i] = holds(quad, work_.piece[i]) ? 1 : 0;
    }

    // Of all samples, with map a in slot_a instead of its own, and b in slot_b; maps() for none.
    [[nodiscard]] T price_with(unsigned a, unsigned slot_a, unsigned b, unsigned slot_b) const noexcept {
        std::array<SettlingView<T> const*, max_chosen_maps> view{};
        for (unsigned k = 0; k < maps(); ++k) view[k] = &work_.view[k == a ? slot_a : k == b ? slot_b : slot_[k]];
        T sum = T(0);
        for (unsigned i = 0; i < static_cast<unsigned>(work_.count); ++i) {
            T price = T(-1);
            for (unsigned k = 0; k < maps() && price < T(0); ++k) price = view[k]->price[i];
            sum += price < T(0) ? work_.sample[i].weight * price_of(footprint_limit<T>) : price;
        }
        return sum;
    }

    [[nodiscard]] unsigned free_slot(unsigned but) const noexcept {
        for (unsigned slot = 0;; ++slot) {
            bool taken = slot == but;
            for (unsigned k = 0; k < maps(); ++k) taken = taken || slot_[k] == slot;
            if (!taken) return slot;
        }
    }

    // Each corner along either of its sides, and each side along its two neighbours: out and in.
    [[nodiscard]] static std::array<Vec2<T>, 4> moved_corners(Quad<T> const& quad, unsigned way, T step) noexcept {
        std::array<Vec2<T>, 4> const& c = quad.corner;
        std::array<Vec2<T>, 4> moved = c;
        T const size = way % 2 == 0 ? -step : step;
        unsigned const what = way / 2;
        auto const along_x = [&](unsigned i) { moved[i] += (c[i] - c[i ^ 1u]) * size; };
        auto const along_y = [&](unsigned i) { moved[i] += (c[i] - c[i ^ 2u]) * size; };
        switch (what) {
            case 0: along_x(0), along_x(2); break;
            case 1: along_x(1), along_x(3); break;
            case 2: along_y(0), along_y(1); break;
            case 3: along_y(2), along_y(3); break;
            default:
                if (what % 2 == 0)
                    along_x((what - 4) / 2);
                else
                    along_y((what - 4) / 2);
        }
        return moved;
    }

    void try_move(unsigned k, unsigned way, T step) noexcept {
        Quad<T> const quad = quad_of(sides_of(moved_corners(stack_.quad[k], way, step)));
        if (!quad.visible) return;
        unsigned const slot = free_slot(~0u);
        judge(slot, quad);
        int lost = 0;
        for (unsigned i = 0; i < static_cast<unsigned>(work_.piece_count); ++i) {
            bool held = work_.view[slot].holds[i] != 0;
            for (unsigned j = 0; j < maps() && !held; ++j) held = j != k && work_.view[slot_[j]].holds[i] != 0;
            if (!held) work_.list[static_cast<unsigned>(lost++)] = static_cast<std::uint16_t>(i);
        }
        T const enough = price_ * T(0.9995);
        if (lost == 0) {
            T const price = price_with(k, slot, maps(), 0);
            if (!(price < enough)) return;
            take(k, slot, quad, price);
            return;
        }
        if (4 * lost > work_.piece_count) return;
        T least = enough;
        unsigned best = maps();
        Quad<T> best_quad;
        unsigned const other = free_slot(slot);
        for (unsigned j = 0; j < maps(); ++j) {
            if (j == k) continue;
            Quad<T> const grown = around_lost(j, lost);
            if (!grown.visible) continue;
            judge(other, grown);
            if (!takes_in(other, lost)) continue;
            T const price = price_with(k, slot, j, other);
            if (!(price < least)) continue;
            least = price;
            best = j;
            best_quad = grown;
        }
        if (best == maps()) return;
        judge(other, best_quad);
        take(k, slot, quad, least);
        take(best, other, best_quad, least);
    }

    [[nodiscard]] Quad<T> around_lost(unsigned map, int lost) const noexcept {
        SidedQuad<T> sided = sides_of(stack_.quad[map].corner);
        for (int i = 0; i < lost; ++i) {
            SettlingPiece<T> const& piece = work_.piece[work_.list[static_cast<unsigned>(i)]];
            grow(sided, piece.point.data(), piece.count);
        }
        return quad_of(sided);
    }

    [[nodiscard]] bool takes_in(unsigned slot, int lost) const noexcept {
        for (int i = 0; i < lost; ++i)
            if (work_.view[slot].holds[work_.list[static_cast<unsigned>(i)]] == 0) return false;
        return true;
    }

    void take(unsigned map, unsigned slot, Quad<T> const& quad, T price) noexcept {
        slot_[map] = slot;
        stack_.quad[map] = quad;
        price_ = price;
    }

    MapSearch<T>& work_;
    QuadStack<T> stack_;
    T usable_;
    std::array<unsigned, max_chosen_maps> slot_{};
    T price_ = std::numeric_limits<T>::max();
};

template <class T>
[[nodiscard]] inline T farthest_along(Vec2<T> const& way, Vec3<T> const* points, int count) noexcept {
    T farthest = std::numeric_limits<T>::lowest();
    for (int i = 0; i < count; ++i) {
        T const here = way.x * points[i].x + way.y * points[i].y;
        farthest = here > farthest ? here : farthest;
    }
    return farthest;
}

// The octagon around more points than a piece can keep.
template <class T>
inline void outline(SettlingPiece<T>& piece, Vec3<T> const* points, int count) noexcept {
    constexpr unsigned sides = 8;
    static_assert(sides == max_piece_points);
    T const half = std::sqrt(T(0.5));
    std::array<Vec2<T>, sides> const way{Vec2<T>(1, 0),  Vec2<T>(half, half),   Vec2<T>(0, 1),  Vec2<T>(-half, half),
                                         Vec2<T>(-1, 0), Vec2<T>(-half, -half), Vec2<T>(0, -1), Vec2<T>(half, -half)};
    std::array<T, sides> reach;
    for (unsigned d = 0; d < sides; ++d) reach[d] = farthest_along(way[d], points, count);
    // Where two neighbouring sides meet: half a right angle apart, so the determinant is its sine.
    for (unsigned d = 0; d < sides; ++d) {
        unsigned const e = (d + 1) % sides;
        piece.point[d] =
            Vec2<T>(reach[d] * way[e].y - reach[e] * way[d].y, reach[e] * way[d].x - reach[d] * way[e].x) / half;
    }
}

// Every n-th of the pieces of the stack's parts, n as small as there is room, and in each part those that reach
// farthest in each of the directions of fit_quad.
template <class T, class Cover>
inline void take_pieces(MapSearch<T>& work, QuadStack<T> const& stack, Cover const& cover) noexcept {
    int all = 0;
    stack.for_each_part([&](ViewPart<T> const& part) { cover(part, [&](Vec3<T> const*, int) { ++all; }); });
    work.piece_count = 0;
    auto const put = [&work](unsigned at, Vec3<T> const* points, int count) {
        SettlingPiece<T>& piece = work.piece[at];
        piece.count = count < max_piece_points ? count : max_piece_points;
        if (count <= max_piece_points)
            for (int i = 0; i < count; ++i) piece.point[static_cast<unsigned>(i)] = Vec2<T>(points[i]);
        else
            outline(piece, points, count);
    };
    constexpr int at_rim = quad_directions * max_chosen_maps, even = max_settling_pieces - at_rim;
    Supports<T> const around = no_supports(SampleFrame<T>{});
    int const stride = (all + even - 1) / even;
    int room = even;  // up to the rims of the parts still to come
    stack.for_each_part([&](ViewPart<T> const& part) {
        std::array<T, quad_directions> reach;
        reach.fill(std::numeric_limits<T>::lowest());
        auto const rim = static_cast<unsigned>(work.piece_count);
        work.piece_count += quad_directions;
        room += quad_directions;
        for (unsigned d = 0; d < quad_directions; ++d) work.piece[rim + d].count = 0;
        int seen = 0;
        cover(part, [&](Vec3<T> const* points, int count) {
            for (unsigned d = 0; d < quad_directions; ++d) {
                T const farthest = farthest_along(around.direction[d], points, count);
                if (!(farthest > reach[d])) continue;
                reach[d] = farthest;
                put(rim + d, points, count);
            }
            if (seen++ % stride == 0 && work.piece_count < room)
                put(static_cast<unsigned>(work.piece_count++), points, count);
        });
    });
}

// The stack with its quadrilaterals moved so that its `price` (price_in) is less; every piece of its parts is in one of
// them, whole, as before. Stack and price as they were where that cannot be had.
template <class T, class Cover>
[[nodiscard]] inline QuadStack<T> settled(MapSearch<T>& work, QuadStack<T> const& stack, T usable_texels,
                                          Cover const& cover, T& price) noexcept {
    if (stack.count < 2) return stack;
    take_pieces(work, stack, cover);
    Settling<T> settling(work, stack, usable_texels);
    settling.run(24);
    QuadStack<T> settled = settling.stack();
    std::array<SidedQuad<T>, max_chosen_maps> sided;
    for (unsigned k = 0; k < static_cast<unsigned>(settled.count); ++k) sided[k] = sides_of(settled.quad[k].corner);
    bool sound = true;
    auto const keep = [&](Vec3<T> const* points, int count) {
        if (!sound || settled.holder(points, count) >= 0) return;
        // Whose area grows least, of all.
        T least = std::numeric_limits<T>::max();
        unsigned best = max_chosen_maps;
        SidedQuad<T> best_sides;
        Quad<T> best_quad;
        for (unsigned k = 0; k < static_cast<unsigned>(settled.count); ++k) {
            SidedQuad<T> grown = sided[k];
            grow(grown, points, count);
            Quad<T> const quad = quad_of(grown);
            if (!quad.visible) continue;
            T const more = area(quad) / area(settled.quad[k]);
            if (!(more < least)) continue;
            least = more;
            best = k;
            best_sides = grown;
            best_quad = quad;
        }
        if (best == max_chosen_maps) {
            sound = false;
            return;
        }
        sided[best] = best_sides;
        settled.quad[best] = best_quad;
        sound = settled.holder(points, count) >= 0;
    };
    stack.for_each_part([&](ViewPart<T> const& part) { cover(part, keep); });
    T const after = price_in(settled, work, usable_texels);
    if (!sound || !(after < price)) return stack;
    price = after;
    return settled;
}

}  // namespace detail
}  // namespace v0
}  // namespace shadowmath
