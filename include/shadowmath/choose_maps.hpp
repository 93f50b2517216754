// SPDX-License-Identifier: MIT
//
// Maps instead of options: up to four, put where the picture needs them, found by measuring.
#pragma once

#include <shadowmath/bounds.hpp>
#include <shadowmath/box_samples.hpp>
#include <shadowmath/clip_space.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/fault.hpp>
#include <shadowmath/fit_quad.hpp>
#include <shadowmath/judge.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/light_samples.hpp>
#include <shadowmath/margin.hpp>
#include <shadowmath/polytope.hpp>
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

// Nearest and farthest eye depth in each of width * height equal tiles of the picture, row by row from the bottom:
// what a renderer's depth pyramid holds. A tile in which nothing is seen has nearest > farthest.
template <class T>
struct DepthTiles {
    T const* nearest = nullptr;
    T const* farthest = nullptr;
    int width = 0;
    int height = 0;
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

}  // namespace detail

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
    int samples = 0;  // that it serves
    T mean = T(0);    // footprint of those, eye pixels
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

template <class T>
struct PartSearch {
    MapSearch<T>& work;
    T usable_texels;
    int tried = 0;

    int gather(SeenPart<T> const& part) noexcept {
        int n = 0;
        for (int i = 0; i < work.count; ++i)
            if (holds(part, work.sample[unsigned(i)].seen)) work.list[unsigned(n++)] = std::uint16_t(i);
        return n;
    }

    QuadFit<T> fit(SeenPart<T> const& part, int most_samples) noexcept {
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

template <class T>
inline void cut(SeenPart<T> const& part, int axis, T at, SeenPart<T>& a, SeenPart<T>& b) noexcept {
    a = part, b = part;
    a.hi[axis] = at;
    b.lo[axis] = at;
}

template <class T>
inline void ends_of(MapSearch<T> const& work, SeenPart<T> const& part, int axis, T& lo, T& hi) noexcept {
    lo = std::numeric_limits<T>::max(), hi = std::numeric_limits<T>::lowest();
    for (int i = 0; i < work.count; ++i) {
        Vec3<T> const& s = work.sample[unsigned(i)].seen;
        if (!holds(part, s)) continue;
        lo = std::fmin(lo, s[axis]);
        hi = std::fmax(hi, s[axis]);
    }
}

// Greedy: always the part and the cut that save most.
template <class T>
[[nodiscard]] inline PartTree<T> grown(PartSearch<T>& search, int most, bool only_depth, int most_samples) noexcept {
    PartTree<T> tree;
    tree.node[0].fit = search.fit({}, most_samples);
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
                    ends_of(search.work, node.part, axis, lo, hi);
                    if (!(lo < hi)) continue;
                    constexpr int steps = 8;
                    for (int k = 1; k < steps; ++k) {
                        T const t = T(k) / T(steps);
                        T const at = axis == 2 ? lo * std::pow(hi / lo, t) : lo + (hi - lo) * t;
                        SeenPart<T> a, b;
                        cut(node.part, axis, at, a, b);
                        QuadFit<T> const fa = search.fit(a, most_samples), fb = search.fit(b, most_samples);
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
}

template <class T>
inline void refit(PartSearch<T>& search, PartTree<T>& tree, int most_samples) noexcept {
    tree.price = T(0);
    for (int n = 0; n < tree.count; ++n) {
        auto& node = tree.node[unsigned(n)];
        if (node.axis < 0) {
            node.fit = search.fit(node.part, most_samples);
            tree.price += node.fit.price;
        } else {
            cut(node.part, node.axis, node.at, tree.node[unsigned(node.child)].part,
                tree.node[unsigned(node.child + 1)].part);
        }
    }
}

// The cuts move while that helps.
template <class T>
inline void settle(PartSearch<T>& search, PartTree<T>& tree, int most_samples) noexcept {
    for (T step : {T(0.06), T(0.03), T(0.015)})
        for (int n = 0; n < tree.count; ++n) {
            if (tree.node[unsigned(n)].axis < 0) continue;
            for (T const sign : {T(-1), T(1)}) {
                for (int again = 0; again < 3; ++again) {
                    PartTree<T> moved = tree;
                    auto& node = moved.node[unsigned(n)];
                    T lo, hi;
                    ends_of(search.work, node.part, node.axis, lo, hi);
                    if (node.axis == 2)
                        node.at *= std::pow(hi / lo, sign * step);
                    else
                        node.at += (hi - lo) * sign * step;
                    refit(search, moved, most_samples);
                    if (!(moved.price < tree.price)) break;
                    tree = moved;
                }
            }
        }
}

// `cover(part, visit)` calls visit(points, count) for convex pieces that together hold all that may be seen in the
// part, as light-space points relative to the eye.
template <class T, class Cover>
[[nodiscard]] inline ChosenMaps<T> search_maps(LightSampler<T> const& sampler, Aabb<T> const& casters,
                                               MapLimits<T> const& limits, MapSearch<T>& work,
                                               Cover const& cover) noexcept {
    ChosenMaps<T> chosen;
    T const usable = usable_texels(limits.map_size, limits.margin_texels);
    int const most = glm::clamp(limits.maps, 1, max_chosen_maps);
    PartSearch<T> search{work, usable};
    constexpr int coarse = 256;
    PartTree<T> best = grown(search, most, false, coarse);
    PartTree<T> const by_depth = grown(search, most, true, coarse);
    if (by_depth.price < best.price) best = by_depth;
    settle(search, best, coarse);

    // Finest first: whoever is inside two maps gets the better one.
    std::array<int, max_chosen_maps> order{};
    int leaves = 0;
    for (int n = 0; n < best.count; ++n)
        if (best.node[unsigned(n)].axis < 0) order[unsigned(leaves++)] = n;
    auto const area_of = [&](int n) { return area(best.node[unsigned(n)].fit.quad); };
    for (int i = 1; i < leaves; ++i)
        for (int j = i; j > 0 && area_of(order[unsigned(j)]) < area_of(order[unsigned(j - 1)]); --j) {
            int const swap = order[unsigned(j)];
            order[unsigned(j)] = order[unsigned(j - 1)];
            order[unsigned(j - 1)] = swap;
        }

    std::array<Quad<T>, max_chosen_maps> quads;
    std::array<T, max_chosen_maps> first, last, sum;
    std::array<int, max_chosen_maps> served{};
    first.fill(std::numeric_limits<T>::max());
    last.fill(std::numeric_limits<T>::lowest());
    sum.fill(T(0));
    int made = 0;
    auto const holder_of = [&](Vec3<T> const* points, int count) {
        for (int k = 0; k < made; ++k) {
            bool inside = true;
            for (int i = 0; i < count && inside; ++i) inside = shadowmath::holds(quads[unsigned(k)], Vec2<T>(points[i]));
            if (inside) return k;
        }
        return -1;
    };
    auto const holder_of_sample = [&](LightSample<T> const& s) {
        Vec3<T> const place(s.place, s.depth);
        return holder_of(&place, 1);
    };
    for (int k = 0; k < leaves; ++k) {
        SeenPart<T> const& part = best.node[unsigned(order[unsigned(k)])].part;
        int n = 0;
        for (int i = 0; i < work.count; ++i) {
            LightSample<T> const& s = work.sample[unsigned(i)];
            if (holds(part, s.seen) && holder_of_sample(s) < 0) work.list[unsigned(n++)] = std::uint16_t(i);
        }
        SampleFrame<T> frame = frame_of(work.sample.data(), work.list.data(), n);
        if (n < 3) {
            int const all = search.gather(part);
            frame = frame_of(work.sample.data(), work.list.data(), all);
            n = 0;
        }
        Supports<T> supports = no_supports(frame);
        cover(part, [&](Vec3<T> const* points, int count) {
            if (holder_of(points, count) >= 0) return;
            for (int i = 0; i < count; ++i) add(supports, Vec2<T>(points[i]));
        });
        if (supports.count == 0) continue;
        if (n == 0) n = search.gather(part);
        QuadFit<T> const fit = fit_quad(supports, work.sample.data(), work.list.data(), n, usable, 1);
        if (!fit.quad.visible) continue;
        quads[unsigned(made++)] = fit.quad;
    }
    // Each piece is served by the first map that holds the whole of it, and each of its points by the first that holds
    // that: all of these maps must reach as deep.
    for (int k = 0; k < leaves; ++k)
        cover(best.node[unsigned(order[unsigned(k)])].part, [&](Vec3<T> const* points, int count) {
            T lo = points[0].z, hi = points[0].z;
            for (int i = 1; i < count; ++i) lo = std::fmin(lo, points[i].z), hi = std::fmax(hi, points[i].z);
            int const whole = holder_of(points, count);
            for (int m = 0; m < made; ++m) {
                if (m == whole) {
                    first[unsigned(m)] = std::fmin(first[unsigned(m)], lo);
                    last[unsigned(m)] = std::fmax(last[unsigned(m)], hi);
                }
            }
        });
    for (int i = 0; i < work.count; ++i) {
        LightSample<T> const& s = work.sample[unsigned(i)];
        int const k = holder_of_sample(s);
        if (k < 0) continue;
        sum[unsigned(k)] += major_at(quads[unsigned(k)], usable, s);
        ++served[unsigned(k)];
    }
    for (int k = 0; k < made; ++k) {
        if (!(first[unsigned(k)] <= last[unsigned(k)])) continue;
        ChosenMap<T>& out = chosen.at[unsigned(chosen.count)];
        T const room = T(0.001) * (last[unsigned(k)] - first[unsigned(k)]) + T(1e-3);
        out.map = quad_map(quads[unsigned(k)], sampler.basis, sampler.view.pose.position, first[unsigned(k)] - room,
                           last[unsigned(k)] + room, casters, limits.map_size, limits.margin_texels, limits.clip);
        if (!out.map.visible) continue;
        out.samples = served[unsigned(k)];
        out.mean = served[unsigned(k)] > 0 ? sum[unsigned(k)] / T(served[unsigned(k)]) : T(0);
        ++chosen.count;
    }
    chosen.tried = search.tried;
    return chosen;
}

// At most max_search_samples of the samples, evenly.
template <class T>
inline void take_samples(MapSearch<T>& work, LightSampler<T> const& sampler, SurfacePoint<T> const* samples,
                         int count) noexcept {
    work.count = 0;
    int usable = 0;
    for (int i = 0; i < count; ++i) {
        LightSample<T> const s = light_sample(sampler, samples[i]);
        if (s.usable && s.weight > T(0)) ++usable;
    }
    int const stride = (usable + max_search_samples - 1) / max_search_samples;
    int seen = 0;
    for (int i = 0; i < count; ++i) {
        LightSample<T> const s = light_sample(sampler, samples[i]);
        if (!s.usable || !(s.weight > T(0))) continue;
        // One of each `stride`, not always the same one: else they might all lie in a few columns of the picture.
        if (seen % stride == seen / stride * 7 % stride && work.count < max_search_samples)
            work.sample[unsigned(work.count++)] = s;
        ++seen;
    }
}

}  // namespace detail

template <class T>
[[nodiscard]] inline ChosenMaps<T> choose_maps(ViewVolume<T> const& view, Light<T> const& light,
                                               Aabb<T> const& casters, SurfacePoint<T> const* samples,
                                               int sample_count, DepthTiles<T> const& tiles,
                                               MapLimits<T> const& limits, MapSearch<T>& work) noexcept {
    ChosenMaps<T> chosen;
    chosen.faults = faults_of(view) | faults_of(light) | faults_of_margin(limits.map_size, limits.margin_texels);
    LightSampler<T> const sampler = light_sampler(view, light, limits.eye_pixels, limits.cells);
    if (!sampler.usable) return chosen;
    detail::take_samples(work, sampler, samples, sample_count);
    if (work.count == 0) return chosen;
    ViewVolume<T> const& eye = sampler.view;
    Vec3<T> const right = in_light(sampler.basis, eye.pose.right), up = in_light(sampler.basis, eye.pose.up),
                  forward = in_light(sampler.basis, eye.pose.forward);
    bool const flat = eye.kind == ViewKind::orthographic;
    auto const cover = [&](detail::SeenPart<T> const& part, auto const& visit) {
        for (int y = 0; y < tiles.height; ++y)
            for (int x = 0; x < tiles.width; ++x) {
                int const i = y * tiles.width + x;
                T const z0 = std::fmax(tiles.nearest[i] * (T(1) - T(1e-5)), part.lo.z);
                T const z1 = std::fmin(tiles.farthest[i] * (T(1) + T(1e-5)), part.hi.z);
                T const wide = (eye.right - eye.left) / T(tiles.width), high = (eye.top - eye.bottom) / T(tiles.height);
                T const x0 = std::fmax(eye.left + wide * T(x), part.lo.x), x1 = std::fmin(eye.left + wide * T(x + 1), part.hi.x);
                T const y0 = std::fmax(eye.bottom + high * T(y), part.lo.y), y1 = std::fmin(eye.bottom + high * T(y + 1), part.hi.y);
                if (!(z0 <= z1) || !(x0 <= x1) || !(y0 <= y1)) continue;
                std::array<Vec3<T>, 8> points;
                int n = 0;
                for (T const z : {z0, z1})
                    for (T const sx : {x0, x1})
                        for (T const sy : {y0, y1})
                            points[unsigned(n++)] =
                                forward * z + (right * sx + up * sy) * (flat ? T(1) : z);
                visit(points.data(), n);
            }
    };
    ChosenMaps<T> found = detail::search_maps(sampler, casters, limits, work, cover);
    found.faults |= chosen.faults;
    return found;
}

// The same where no depth buffer is at hand: every point of the boxes that the view sees is in a map.
template <class T>
[[nodiscard]] inline ChosenMaps<T> choose_maps(ViewVolume<T> const& view, Light<T> const& light,
                                               Aabb<T> const& casters, Aabb<T> const* receivers, int receiver_count,
                                               MapLimits<T> const& limits, MapSearch<T>& work) noexcept {
    ChosenMaps<T> chosen;
    chosen.faults = faults_of(view) | faults_of(light) | faults_of_margin(limits.map_size, limits.margin_texels);
    constexpr int rays_x = 20, rays_y = 12;
    LightSampler<T> const sampler =
        light_sampler(view, light, limits.eye_pixels, Vec2<T>(T(rays_x), T(rays_y)));
    if (!sampler.usable) return chosen;
    work.count = guesses_in_boxes(sampler, light, receivers, receiver_count, rays_x, rays_y, work.sample.data(),
                                  max_search_samples);
    if (work.count == 0) return chosen;
    ViewVolume<T> const& eye = sampler.view;
    auto const cover = [&](detail::SeenPart<T> const& part, auto const& visit) {
        ViewVolume<T> piece = eye;
        piece.left = std::fmax(eye.left, part.lo.x);
        piece.right = std::fmin(eye.right, part.hi.x);
        piece.bottom = std::fmax(eye.bottom, part.lo.y);
        piece.top = std::fmin(eye.top, part.hi.y);
        piece.z_near = std::fmax(eye.z_near, part.lo.z);
        piece.z_far = std::fmin(eye.z_far, part.hi.z);
        if (!(piece.left < piece.right) || !(piece.bottom < piece.top) || !(piece.z_near < piece.z_far)) return;
        Aabb<T> const around = bounds_of(corners(piece));
        for (int i = 0; i < receiver_count; ++i) {
            if (is_empty(intersect(around, receivers[i]))) continue;
            ConvexBody<T> const body = visible_body(piece, receivers[i]);
            if (body.edge_count == 0) continue;
            std::array<Vec3<T>, 2 * max_body_edges> points;
            int n = 0;
            for_each_vertex(body, [&](Vec3<T> const& p) { points[unsigned(n++)] = in_light(sampler.basis, p); });
            visit(points.data(), n);
        }
    };
    ChosenMaps<T> found = detail::search_maps(sampler, casters, limits, work, cover);
    found.faults |= chosen.faults;
    return found;
}

}  // namespace v0
}  // namespace shadowmath
