// SPDX-License-Identifier: MIT
//
// Which part of what is seen gets a map of its own: cuts across depth, or across the picture, where they save most.
//
//   grown     one part to begin with; always the part and the cut that make the price least; depth alone, and freely
//   settled   each cut moves either way while that helps
//
// Cascades cut depth alone. That is nearly best for a street; not for a square seen from above, where four strips have
// texels four times as long as wide, and not for two fronts with a gap between.
//
// Everything is searched on at most max_search_samples samples, and no sum depends on anything but these: no clock, no
// randomness. At most 3 * 7 pairs of fits for a part, seven parts, and 3 * 6 * 3 * 4 fits to settle.
//
// Source: the greedy tree is that of classification trees (Breiman 1984).
#pragma once

#include <shadowmath/config.hpp>
#include <shadowmath/fit_quad.hpp>
#include <shadowmath/light_samples.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace shadowmath {
inline namespace v0 {

inline constexpr int max_chosen_maps = 4;
inline constexpr int max_search_samples = 1024;

inline constexpr int max_settling_pieces = 1024;
inline constexpr int max_piece_points = 8;

// Points of the light's plane that one map must hold together (quad_settle.hpp).
template <class T>
struct SettlingPiece {
    std::array<Vec2<T>, max_piece_points> point;
    int count = 0;
};

// What one map makes of them all.
template <class T>
struct SettlingView {
    std::array<T, max_search_samples> price;              // of each sample; below 0: not in the map
    std::array<std::uint8_t, max_settling_pieces> holds;  // each piece
};

// What a search works on: 200 to 400 kB that the caller keeps, so that no stack has to. Nothing in it outlives a call.
template <class T>
struct MapSearch {
    std::array<LightSample<T>, max_search_samples> sample;
    std::array<std::uint16_t, max_search_samples> list;
    int count = 0;
    std::array<SettlingPiece<T>, max_settling_pieces> piece;
    int piece_count = 0;
    std::array<SettlingView<T>, max_chosen_maps + 2> view;
};

// Sides of the view, and eye depth: lo <= (side x, side y, depth) < hi.
template <class T>
struct ViewPart {
    Vec3<T> lo{std::numeric_limits<T>::lowest()};
    Vec3<T> hi{std::numeric_limits<T>::max()};
};

template <class T>
[[nodiscard]] inline bool is_in(ViewPart<T> const& part, Vec3<T> const& seen) noexcept {
    return part.lo.x <= seen.x && seen.x < part.hi.x && part.lo.y <= seen.y && seen.y < part.hi.y &&
           part.lo.z <= seen.z && seen.z < part.hi.z;
}

namespace detail {

inline constexpr int depth_axis = 2;

// Parts as a binary tree of cuts; leaves have no axis.
template <class T>
struct PartTree {
    struct Node {
        ViewPart<T> part;
        int axis = -1;
        T at = T(0);
        int child = 0;  // and the next one
        QuadFit<T> fit;
    };
    std::array<Node, 2 * max_chosen_maps> node;
    int count = 0;
    int leaves = 0;
    T price = std::numeric_limits<T>::max();
};

// `bound(part, count, supports)` adds what a map of the part must hold; the first `count` of work.list are its samples.
template <class T, class Bound>
struct PartSearch {
    MapSearch<T>& work;
    Bound const& bound;
    T usable_texels;
    int most_priced;  // samples that a fit is priced by
    int tried = 0;

    int gather(ViewPart<T> const& part) noexcept {
        unsigned n = 0;
        for (int i = 0; i < work.count; ++i)
            if (is_in(part, work.sample[static_cast<unsigned>(i)].seen)) work.list[n++] = static_cast<std::uint16_t>(i);
        return static_cast<int>(n);
    }

    QuadFit<T> fit(ViewPart<T> const& part) noexcept {
        int const n = gather(part);
        ++tried;
        QuadFit<T> fitted;
        fitted.price = T(0);
        if (n == 0) return fitted;
        Supports<T> supports = no_supports(frame_of(work.sample.data(), work.list.data(), n));
        bound(part, n, supports);
        int const stride = (n + most_priced - 1) / most_priced;
        return fit_quad(supports, work.sample.data(), work.list.data(), n, usable_texels, stride);
    }
};

template <class T>
struct PartPair {
    ViewPart<T> a;
    ViewPart<T> b;
};

template <class T>
[[nodiscard]] inline PartPair<T> cut(ViewPart<T> const& part, int axis, T at) noexcept {
    PartPair<T> pair{part, part};
    pair.a.hi[axis] = at;
    pair.b.lo[axis] = at;
    return pair;
}

// The place `share` of the way between the first and the last sample of the part: evenly, or in ratios of depth.
template <class T>
[[nodiscard]] inline T between_ends(MapSearch<T> const& work, ViewPart<T> const& part, int axis, T share) noexcept {
    T lo = std::numeric_limits<T>::max(), hi = std::numeric_limits<T>::lowest();
    for (int i = 0; i < work.count; ++i) {
        Vec3<T> const& seen = work.sample[static_cast<unsigned>(i)].seen;
        if (!is_in(part, seen)) continue;
        lo = std::fmin(lo, seen[axis]);
        hi = std::fmax(hi, seen[axis]);
    }
    if (!(lo < hi)) return lo;
    return axis == depth_axis ? lo * std::pow(hi / lo, share) : lo + (hi - lo) * share;
}

template <class T>
struct BestCut {
    int axis = -1;  // -1: none saves anything
    T at = T(0);
    T saved = T(0);
    QuadFit<T> a;
    QuadFit<T> b;
};

template <class T, class Bound>
[[nodiscard]] inline BestCut<T> best_cut(PartSearch<T, Bound>& search, ViewPart<T> const& part, T price,
                                         int first_axis) noexcept {
    BestCut<T> best;
    constexpr int steps = 8;
    for (int axis = depth_axis; axis >= first_axis; --axis)
        for (int k = 1; k < steps; ++k) {
            T const at = between_ends(search.work, part, axis, T(k) / T(steps));
            PartPair<T> const halves = cut(part, axis, at);
            QuadFit<T> const a = search.fit(halves.a), b = search.fit(halves.b);
            T const saved = price - a.price - b.price;
            if (saved > best.saved) best = {axis, at, saved, a, b};
        }
    return best;
}

template <class T, class Bound>
[[nodiscard]] inline PartTree<T> grown(PartSearch<T, Bound>& search, int most_leaves, bool by_depth_alone) noexcept {
    PartTree<T> tree;
    tree.node[0].fit = search.fit({});
    tree.price = tree.node[0].fit.price;
    tree.count = tree.leaves = 1;
    std::array<BestCut<T>, 2 * max_chosen_maps> best;
    unsigned known = 0;  // nodes whose best cut has been looked for
    while (tree.leaves < most_leaves) {
        int take = -1;
        for (unsigned n = 0; n < static_cast<unsigned>(tree.count); ++n) {
            auto const& node = tree.node[n];
            if (node.axis >= 0) continue;
            if (n >= known) best[n] = best_cut(search, node.part, node.fit.price, by_depth_alone ? depth_axis : 0);
            if (best[n].axis >= 0 && (take < 0 || best[n].saved > best[static_cast<unsigned>(take)].saved))
                take = static_cast<int>(n);
        }
        known = static_cast<unsigned>(tree.count);
        if (take < 0) break;
        auto& node = tree.node[static_cast<unsigned>(take)];
        BestCut<T> const& found = best[static_cast<unsigned>(take)];
        node.axis = found.axis;
        node.at = found.at;
        node.child = tree.count;
        PartPair<T> const halves = cut(node.part, node.axis, node.at);
        auto &a = tree.node[static_cast<unsigned>(tree.count)], &b = tree.node[static_cast<unsigned>(tree.count) + 1];
        a.part = halves.a;
        a.fit = found.a;
        b.part = halves.b;
        b.fit = found.b;
        tree.count += 2;
        ++tree.leaves;
        tree.price -= found.saved;
    }
    return tree;
}

// After a cut has moved: all parts and their fits anew.
template <class T, class Bound>
inline void refit(PartSearch<T, Bound>& search, PartTree<T>& tree) noexcept {
    tree.price = T(0);
    for (int n = 0; n < tree.count; ++n) {
        auto& node = tree.node[static_cast<unsigned>(n)];
        if (node.axis < 0) {
            node.fit = search.fit(node.part);
            tree.price += node.fit.price;
            continue;
        }
        PartPair<T> const halves = cut(node.part, node.axis, node.at);
        tree.node[static_cast<unsigned>(node.child)].part = halves.a;
        tree.node[static_cast<unsigned>(node.child) + 1].part = halves.b;
    }
}

template <class T, class Bound>
inline void settle(PartSearch<T, Bound>& search, PartTree<T>& tree) noexcept {
    for (T const step : {T(0.06), T(0.03), T(0.015)})
        for (int n = 0; n < tree.count; ++n) {
            if (tree.node[static_cast<unsigned>(n)].axis < 0) continue;
            for (T const way : {-step, step})
                for (int again = 0; again < 3; ++again) {
                    PartTree<T> moved = tree;
                    auto& node = moved.node[static_cast<unsigned>(n)];
                    T const lo = between_ends(search.work, node.part, node.axis, T(0));
                    T const hi = between_ends(search.work, node.part, node.axis, T(1));
                    if (!(lo < hi)) break;
                    node.at = node.axis == depth_axis ? node.at * std::pow(hi / lo, way) : node.at + (hi - lo) * way;
                    refit(search, moved);
                    if (!(moved.price < tree.price)) break;
                    tree = moved;
                }
        }
}

}  // namespace detail
}  // namespace v0
}  // namespace shadowmath
