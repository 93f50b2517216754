// SPDX-License-Identifier: MIT
//
// Maps one behind another: the parts of a search as quadrilaterals, finest first, each around what no earlier one
// holds.
//
//   by_map (sampling.hpp) looks a point up in the first map that holds it, so what lies in an earlier one need not be
//   in a later one: that becomes smaller, and its texels finer. A part that the earlier ones hold whole gets no map.
//
// The last step of choose_maps.hpp; of no use without it.
//
// Source: none; that overlapping cascades serve best by containment is folklore.
#pragma once

#include <shadowmath/config.hpp>
#include <shadowmath/fit_quad.hpp>
#include <shadowmath/footprint.hpp>
#include <shadowmath/light_samples.hpp>
#include <shadowmath/map_rows.hpp>
#include <shadowmath/part_search.hpp>
#include <shadowmath/quad_map.hpp>

#include <array>

namespace shadowmath {
inline namespace v0 {
namespace detail {

// The quadrilaterals of the parts, finest first, each around what no earlier one holds.
template <class T>
struct QuadStack {
    std::array<Quad<T>, max_chosen_maps> quad;
    std::array<ViewPart<T>, max_chosen_maps> part;  // that each was made for
    int count = 0;
    std::array<ViewPart<T>, max_chosen_maps> held;  // parts that needed none of their own
    int held_count = 0;

    template <class Visit>
    void for_each_part(Visit const& visit) const noexcept {
        for (int k = 0; k < count; ++k) visit(part[static_cast<unsigned>(k)]);
        for (int k = 0; k < held_count; ++k) visit(held[static_cast<unsigned>(k)]);
    }

    // The first that holds all of the points; -1: none.
    [[nodiscard]] int holder(Vec3<T> const* points, int point_count) const noexcept {
        for (int k = 0; k < count; ++k) {
            int inside = 0;
            while (inside < point_count && is_in(quad[static_cast<unsigned>(k)], Vec2<T>(points[inside]))) ++inside;
            if (inside == point_count) return k;
        }
        return -1;
    }
    [[nodiscard]] int holder(LightSample<T> const& sample) const noexcept {
        Vec3<T> const place(sample.place, sample.depth);
        return holder(&place, 1);
    }
};

// `cover(part, visit)` calls visit(points, count) for convex pieces that together hold all that may be seen in the
// part: a piece that an earlier quadrilateral holds whole is left out, any other is held whole.
template <class T, class Bound, class Cover>
[[nodiscard]] inline QuadStack<T> stacked(PartSearch<T, Bound>& search, PartTree<T> const& tree,
                                          Cover const& cover) noexcept {
    MapSearch<T>& work = search.work;
    std::array<unsigned, max_chosen_maps> order{};
    unsigned leaves = 0;
    for (unsigned n = 0; n < static_cast<unsigned>(tree.count); ++n) {
        if (tree.node[n].axis >= 0) continue;
        unsigned at = leaves++;
        for (; at > 0 && area(tree.node[order[at - 1]].fit.quad) > area(tree.node[n].fit.quad); --at)
            order[at] = order[at - 1];
        order[at] = n;
    }
    QuadStack<T> stack;
    for (unsigned k = 0; k < leaves; ++k) {
        ViewPart<T> const& part = tree.node[order[k]].part;
        int const all = search.gather(part);
        SampleFrame<T> const frame = frame_of(work.sample.data(), work.list.data(), all);
        unsigned own = 0;  // those that are left to this map
        for (unsigned i = 0; i < static_cast<unsigned>(all); ++i)
            if (stack.holder(work.sample[work.list[i]]) < 0) work.list[own++] = work.list[i];
        SampleFrame<T> const own_frame = frame_of(work.sample.data(), work.list.data(), static_cast<int>(own));
        Supports<T> supports = no_supports(own > 2 ? own_frame : frame);
        cover(part, [&](Vec3<T> const* points, int count) {
            if (stack.holder(points, count) >= 0) return;
            for (int i = 0; i < count; ++i) add(supports, Vec2<T>(points[i]));
        });
        QuadFit<T> const fit =
            fit_quad(supports, work.sample.data(), work.list.data(), static_cast<int>(own), search.usable_texels);
        if (!fit.quad.visible) {
            stack.held[static_cast<unsigned>(stack.held_count++)] = part;
            continue;
        }
        stack.part[static_cast<unsigned>(stack.count)] = part;
        stack.quad[static_cast<unsigned>(stack.count++)] = fit.quad;
    }
    return stack;
}

// All samples, each in the first map that holds it; those that none holds are lost.
template <class T>
[[nodiscard]] inline T price_in(QuadStack<T> const& stack, MapSearch<T> const& work, T usable_texels) noexcept {
    T sum = T(0);
    for (int i = 0; i < work.count; ++i) {
        LightSample<T> const& sample = work.sample[static_cast<unsigned>(i)];
        int const k = stack.holder(sample);
        T const major =
            k < 0 ? footprint_limit<T> : major_at(stack.quad[static_cast<unsigned>(k)], usable_texels, sample);
        sum += sample.weight * price_of(major);
    }
    return sum;
}

// Of each map the depths that it serves. A piece inside one map is served there. One that lies across several is in
// each of them with some of its points, and whole in the map of its own part.
template <class T, class Cover>
[[nodiscard]] inline std::array<Extent<T>, max_chosen_maps> depths_served(QuadStack<T> const& stack,
                                                                          Cover const& cover) noexcept {
    std::array<Extent<T>, max_chosen_maps> depth;
    auto const reach = [&](ViewPart<T> const& part, int own) {
        cover(part, [&](Vec3<T> const* points, int count) {
            int const holder = stack.holder(points, count);
            // A side touches its points, so rounding may put one outside: it is its own part's all the same.
            int const serving = holder < 0 ? own : holder;
            for (int i = 0; i < count && serving >= 0; ++i) depth[static_cast<unsigned>(serving)].add(points[i].z);
        });
    };
    for (int k = 0; k < stack.count; ++k) reach(stack.part[static_cast<unsigned>(k)], k);
    for (int k = 0; k < stack.held_count; ++k) reach(stack.held[static_cast<unsigned>(k)], -1);
    return depth;
}

// A map that serves no piece would be drawn for nothing: all of its own part is whole in others.
template <class T>
inline void leave_out_idle(QuadStack<T>& stack, std::array<Extent<T>, max_chosen_maps>& depth) noexcept {
    unsigned kept = 0;
    for (unsigned k = 0; k < static_cast<unsigned>(stack.count); ++k) {
        if (!(depth[k].lo <= depth[k].hi)) {
            stack.held[static_cast<unsigned>(stack.held_count++)] = stack.part[k];
            continue;
        }
        stack.quad[kept] = stack.quad[k];
        stack.part[kept] = stack.part[k];
        depth[kept++] = depth[k];
    }
    stack.count = static_cast<int>(kept);
}

}  // namespace detail
}  // namespace v0
}  // namespace shadowmath
