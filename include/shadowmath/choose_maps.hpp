// SPDX-License-Identifier: MIT
//
// Maps instead of options: up to four, put where the picture needs them, found by measuring.
#pragma once

#include <shadowmath/bounds.hpp>
#include <shadowmath/clip_space.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/fault.hpp>
#include <shadowmath/fit_quad.hpp>
#include <shadowmath/judge.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/light_samples.hpp>
#include <shadowmath/margin.hpp>
#include <shadowmath/quad_map.hpp>
#include <shadowmath/shadow_map.hpp>
#include <shadowmath/view_volume.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace shadowmath {
inline namespace v0 {

inline constexpr int max_chosen_maps = 4;
inline constexpr int max_search_samples = 1024;

template <class T>
struct MapLimits {
    Vec2<T> eye_pixels{T(1920), T(1080)};
    Vec2<T> cells{T(240), T(135)};  // of the picture that a sample each was taken from
    int maps = 4;
    int map_size = 1024;
    T margin_texels = T(2);
    ClipSpace clip = gl_clip;
};

// What the search works on; some 160 kB that the caller keeps, so that no stack has to.
template <class T>
struct MapSearch {
    std::array<LightSample<T>, max_search_samples> sample;
    std::array<std::uint16_t, max_search_samples> list;
    int count = 0;
};

template <class T>
struct ChosenMap {
    ShadowMap<T> map;
    int samples = 0;        // that it serves
    T mean = T(0);          // footprint of those, eye pixels
};

template <class T>
struct ChosenMaps {
    std::array<ChosenMap<T>, max_chosen_maps> at;
    int count = 0;
    int tried = 0;  // fits
    T price = T(0);
    Faults faults;
};

namespace detail {

// A part of the picture and of its depth: lo <= seen < hi.
template <class T>
struct SeenPart {
    Vec3<T> lo{std::numeric_limits<T>::lowest()};
    Vec3<T> hi{std::numeric_limits<T>::max()};
};

template <class T>
[[nodiscard]] inline bool holds(SeenPart<T> const& part, Vec3<T> const& seen) noexcept {
    return part.lo.x <= seen.x && seen.x < part.hi.x && part.lo.y <= seen.y && seen.y < part.hi.y &&
           part.lo.z <= seen.z && seen.z < part.hi.z;
}

// Parts as a binary tree of cuts. A leaf has no axis.
template <class T>
struct PartTree {
    struct Node {
        SeenPart<T> part;
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

template <class T>
struct PartSearch {
    MapSearch<T>& work;
    T usable_texels;
    int tried = 0;

    int gather(SeenPart<T> const& part) {
        int n = 0;
        for (int i = 0; i < work.count; ++i)
            if (holds(part, work.sample[unsigned(i)].seen)) work.list[unsigned(n++)] = std::uint16_t(i);
        return n;
    }

    QuadFit<T> fit(SeenPart<T> const& part, int most_samples) {
        int const n = gather(part);
        ++tried;
        QuadFit<T> none;
        none.price = T(0);
        if (n == 0) return none;
        Supports<T> supports = no_supports(frame_of(work.sample.data(), work.list.data(), n));
        for (int i = 0; i < n; ++i) add(supports, work.sample[work.list[unsigned(i)]]);
        int const stride = (n + most_samples - 1) / most_samples;
        return fit_quad(supports, work.sample.data(), work.list.data(), n, usable_texels, stride);
    }
};

}  // namespace detail

template <class T>
[[nodiscard]] inline ChosenMaps<T> choose_maps(ViewVolume<T> const& view, Light<T> const& light,
                                               Aabb<T> const& casters, SurfacePoint<T> const* samples,
                                               int sample_count, MapLimits<T> const& limits,
                                               MapSearch<T>& work) noexcept {
    using namespace detail;
    ChosenMaps<T> chosen;
    chosen.faults = faults_of(view) | faults_of(light) | faults_of_margin(limits.map_size, limits.margin_texels);
    LightSampler<T> const sampler = light_sampler(view, light, limits.eye_pixels, limits.cells);
    if (!sampler.usable) return chosen;
    T const usable = usable_texels(limits.map_size, limits.margin_texels);
    int const most = glm::clamp(limits.maps, 1, max_chosen_maps);
    work.count = 0;
    int usable_count = 0;
    for (int i = 0; i < sample_count; ++i) {
        LightSample<T> const s = light_sample(sampler, samples[i]);
        if (s.usable && s.weight > T(0)) ++usable_count;
    }
    int seen = 0;
    int const stride = (usable_count + max_search_samples - 1) / max_search_samples;
    for (int i = 0; i < sample_count; ++i) {
        LightSample<T> const s = light_sample(sampler, samples[i]);
        if (!s.usable || !(s.weight > T(0))) continue;
        // One of each `stride`, not always the same one: else they might all lie in a few columns of the picture.
        if (seen % stride == seen / stride * 7 % stride && work.count < max_search_samples)
            work.sample[unsigned(work.count++)] = s;
        ++seen;
    }
    if (work.count == 0) return chosen;

    PartSearch<T> search{work, usable};
    constexpr int coarse = 128;
    using Tree = PartTree<T>;
    auto const ends_of = [&](SeenPart<T> const& part, int axis, T& lo, T& hi) {
        lo = std::numeric_limits<T>::max(), hi = std::numeric_limits<T>::lowest();
        for (int i = 0; i < work.count; ++i) {
            Vec3<T> const& s = work.sample[unsigned(i)].seen;
            if (!holds(part, s)) continue;
            lo = std::fmin(lo, s[axis]);
            hi = std::fmax(hi, s[axis]);
        }
    };
    auto const cut = [](SeenPart<T> const& part, int axis, T at, SeenPart<T>& a, SeenPart<T>& b) {
        a = part, b = part;
        a.hi[axis] = at;
        b.lo[axis] = at;
    };
    // Greedy: the leaf and the cut that save most.
    auto const grow = [&](bool only_depth) {
        Tree tree;
        tree.node[0].fit = search.fit({}, coarse);
        tree.count = 1, tree.leaves = 1;
        struct Cut {
            int axis = -1;
            T at = T(0), saved = T(0);
            QuadFit<T> a, b;
        };
        std::array<Cut, 2 * max_chosen_maps> best;
        std::array<bool, 2 * max_chosen_maps> known{};
        while (tree.leaves < most) {
            int take = -1;
            for (int n = 0; n < tree.count; ++n) {
                auto const& node = tree.node[unsigned(n)];
                if (node.axis >= 0) continue;
                Cut& found = best[unsigned(n)];
                if (!known[unsigned(n)]) {
                    known[unsigned(n)] = true;
                    found = {};
                    for (int axis = 2; axis >= (only_depth ? 2 : 0); --axis) {
                        T lo, hi;
                        ends_of(node.part, axis, lo, hi);
                        if (!(lo < hi)) continue;
                        constexpr int steps = 8;
                        for (int k = 1; k < steps; ++k) {
                            T const t = T(k) / T(steps);
                            T const at = axis == 2 ? lo * std::pow(hi / lo, t) : lo + (hi - lo) * t;
                            SeenPart<T> a, b;
                            cut(node.part, axis, at, a, b);
                            QuadFit<T> const fa = search.fit(a, coarse), fb = search.fit(b, coarse);
                            T const saved = node.fit.price - fa.price - fb.price;
                            if (saved > found.saved) found = {axis, at, saved, fa, fb};
                        }
                    }
                }
                if (found.axis >= 0 && (take < 0 || found.saved > best[unsigned(take)].saved)) take = n;
            }
            if (take < 0) break;
            auto& node = tree.node[unsigned(take)];
            Cut const& found = best[unsigned(take)];
            node.axis = found.axis, node.at = found.at, node.child = tree.count;
            auto &a = tree.node[unsigned(tree.count)], &b = tree.node[unsigned(tree.count + 1)];
            cut(node.part, node.axis, node.at, a.part, b.part);
            a.fit = found.a, b.fit = found.b;
            known[unsigned(tree.count)] = known[unsigned(tree.count + 1)] = false;
            tree.count += 2;
            ++tree.leaves;
        }
        tree.price = T(0);
        for (int n = 0; n < tree.count; ++n)
            if (tree.node[unsigned(n)].axis < 0) tree.price += tree.node[unsigned(n)].fit.price;
        return tree;
    };
    Tree best = grow(false);
    Tree const by_depth = grow(true);
    if (by_depth.price < best.price) best = by_depth;

    // The cuts move while that helps.
    auto const refit = [&](Tree& tree) {
        tree.price = T(0);
        for (int n = 0; n < tree.count; ++n) {
            auto& node = tree.node[unsigned(n)];
            if (node.axis < 0) {
                node.fit = search.fit(node.part, coarse);
                tree.price += node.fit.price;
            } else {
                cut(node.part, node.axis, node.at, tree.node[unsigned(node.child)].part,
                    tree.node[unsigned(node.child + 1)].part);
            }
        }
    };
    for (T step : {T(0.06), T(0.03), T(0.015)})
        for (int n = 0; n < best.count; ++n) {
            if (best.node[unsigned(n)].axis < 0) continue;
            for (T const sign : {T(-1), T(1)}) {
                for (int again = 0; again < 3; ++again) {
                    Tree moved = best;
                    auto& node = moved.node[unsigned(n)];
                    T lo, hi;
                    ends_of(node.part, node.axis, lo, hi);
                    if (node.axis == 2)
                        node.at *= std::pow(hi / lo, sign * step);
                    else
                        node.at += (hi - lo) * sign * step;
                    refit(moved);
                    if (!(moved.price < best.price)) break;
                    best = moved;
                }
            }
        }

    // Finest first: whoever is inside two maps gets the better one.
    std::array<int, max_chosen_maps> order{};
    int leaves = 0;
    for (int n = 0; n < best.count; ++n)
        if (best.node[unsigned(n)].axis < 0 && best.node[unsigned(n)].fit.quad.visible) order[unsigned(leaves++)] = n;
    auto const area_of = [&](int n) {
        auto const& c = best.node[unsigned(n)].fit.quad.corner;
        Vec2<T> const d = c[3] - c[0], e = c[2] - c[1];
        return std::abs(d.x * e.y - d.y * e.x);
    };
    for (int i = 1; i < leaves; ++i)
        for (int j = i; j > 0 && area_of(order[unsigned(j)]) < area_of(order[unsigned(j - 1)]); --j) {
            int const swap = order[unsigned(j)];
            order[unsigned(j)] = order[unsigned(j - 1)];
            order[unsigned(j - 1)] = swap;
        }

    // All samples now, those that an earlier map holds left out.
    std::array<Quad<T>, max_chosen_maps> quads;
    int made = 0;
    auto const is_inside = [](Quad<T> const& quad, LightSample<T> const& s) {
        for (T const a : {T(-1), T(1)})
            for (T const b : {T(-1), T(1)}) {
                Vec3<T> const p(s.place + s.reach_x * a + s.reach_y * b, T(1));
                T const w = glm::dot(quad.w, p);
                if (!(w >= quad.w_least) || !(std::abs(glm::dot(quad.x, p)) <= w) ||
                    !(std::abs(glm::dot(quad.y, p)) <= w))
                    return false;
            }
        return true;
    };
    auto const holder = [&](LightSample<T> const& s) {
        for (int k = 0; k < made; ++k)
            if (is_inside(quads[unsigned(k)], s)) return k;
        return -1;
    };
    for (int k = 0; k < leaves; ++k) {
        SeenPart<T> const& part = best.node[unsigned(order[unsigned(k)])].part;
        int n = 0;
        for (int i = 0; i < work.count; ++i) {
            LightSample<T> const& s = work.sample[unsigned(i)];
            if (holds(part, s.seen) && holder(s) < 0) work.list[unsigned(n++)] = std::uint16_t(i);
        }
        if (n == 0) {  // all of the search's samples are held: those of the whole part give the frame
            n = search.gather(part);
        }
        Supports<T> supports = no_supports(frame_of(work.sample.data(), work.list.data(), n));
        for (int i = 0; i < sample_count; ++i) {
            LightSample<T> const s = light_sample(sampler, samples[i]);
            if (!s.usable || !(s.weight > T(0)) || !holds(part, s.seen) || holder(s) >= 0) continue;
            add(supports, s);
        }
        if (supports.count == 0) continue;
        QuadFit<T> const fit = fit_quad(supports, work.sample.data(), work.list.data(), n, usable, 1);
        if (!fit.quad.visible) continue;
        quads[unsigned(made++)] = fit.quad;
    }
    std::array<T, max_chosen_maps> first, last, sum;
    std::array<int, max_chosen_maps> served{};
    first.fill(std::numeric_limits<T>::max());
    last.fill(std::numeric_limits<T>::lowest());
    sum.fill(T(0));
    for (int i = 0; i < sample_count; ++i) {
        LightSample<T> const s = light_sample(sampler, samples[i]);
        if (!s.usable || !(s.weight > T(0))) continue;
        int const k = holder(s);
        if (k < 0) continue;
        first[unsigned(k)] = std::fmin(first[unsigned(k)], s.depth);
        last[unsigned(k)] = std::fmax(last[unsigned(k)], s.depth);
        sum[unsigned(k)] += major_at(quads[unsigned(k)], usable, s);
        ++served[unsigned(k)];
    }
    for (int k = 0; k < made; ++k) {
        if (served[unsigned(k)] == 0) continue;
        T const room = T(0.02) * (last[unsigned(k)] - first[unsigned(k)]) + T(0.5);
        ChosenMap<T>& out = chosen.at[unsigned(chosen.count)];
        out.map = quad_map(quads[unsigned(k)], sampler.basis, sampler.view.pose.position, first[unsigned(k)] - room,
                           last[unsigned(k)] + room, casters, limits.map_size, limits.margin_texels, limits.clip);
        if (!out.map.visible) continue;
        out.samples = served[unsigned(k)];
        out.mean = sum[unsigned(k)] / T(served[unsigned(k)]);
        ++chosen.count;
    }
    chosen.tried = search.tried;
    return chosen;
}

}  // namespace v0
}  // namespace shadowmath
