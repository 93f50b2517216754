// SPDX-License-Identifier: MIT
//
// What everything goes through: the door for numbers, conventions, the box in light space, projections of points.
#include "tests/fuzz/inputs.hpp"
#include "tests/laws/aliasing.hpp"
#include "tests/laws/clip_space.hpp"
#include "tests/laws/fault.hpp"
#include "tests/laws/finite.hpp"
#include "tests/laws/light_box.hpp"
#include "tests/laws/tangent.hpp"

namespace shadowmath::fuzz {
namespace {

template <class T>
void try_numbers(Case& c) {
    T const number = c.number<T>();
    Vec3<T> const any = any_vector<T>(c);
    if (c.numbers() == Numbers::any) {
        c.require(laws::tells_numbers_apart(number), "what is finite is told from what is not");
        if (all_finite(any)) c.require(laws::normalizes(any), "any length is normalised");
    }
    Normalized<T> const unit = c.call([&] { return safe_normalize(any); });
    c.require(all_finite(unit.direction), "a direction is finite, whatever it was made of");
    Faults a, b;
    a.bits = static_cast<std::uint32_t>(c.bits(4));
    b.bits = static_cast<std::uint32_t>(c.bits(4));
    c.require(laws::is_a_union(a, b), "faults add up");
    c.require(laws::describes_the_lowest(a), "each fault has its sentence");
}

template <class T>
T dyadic(Case& c, int lo, int hi) {
    return T(lo) + static_cast<T>(c.below((hi - lo) * 1024 + 1)) / T(1024);
}

template <class T>
void try_conventions(Case& c) {
    ClipSpace const clip = any_clip(c);
    T const x = dyadic<T>(c, -2, 2), y = dyadic<T>(c, -2, 2), z = dyadic<T>(c, -1, 2);
    T const occluder = dyadic<T>(c, 0, 1), receiver = dyadic<T>(c, 0, 1), bias = dyadic<T>(c, 0, 1) / T(8);
    c.require(laws::converts_both_ways<T>(clip), "conversions are exact inverses");
    c.require(fast_math || laws::reads_where_it_was_written(clip, Vec3<T>(x, y, z)),
              "a map is read where it was written");
    c.require(laws::keeps_the_decision(clip, occluder, receiver, bias), "conventions change no decision");
    c.require(laws::is_lit_by_a_cleared_map(clip, receiver), "a cleared map shadows nothing");
}

template <class T>
void try_light_boxes(Case& c) {
    Light<T> const sun = good_sun<T>(c);
    Vec3<T> const centre = point_within<T>(c, T(1000)), origin = point_within<T>(c, T(1000));
    Vec3<T> const relative = point_within<T>(c, T(100));
    T const x = c.magnitude<T>(-3, 13), y = c.magnitude<T>(-3, 13), depth = c.magnitude<T>(-3, 16);
    LightBox<T> box{light_basis(sun.direction), Vec2<T>(centre.x - x, centre.y - y),
                    Vec2<T>(centre.x + x, centre.y + y), centre.z - depth, centre.z + depth};
    ClipSpace const clip = any_clip(c);
    Mat4<T> const map = c.calm_call([&] { return clip_from_world(box, clip); });
    c.require(laws::is_map_of(map, sun, clip), "the map of a box is a map of its light");
    c.require(laws::fills_the_map(box, clip), "a box fills its map");
    c.require(laws::is_rebased(map, origin, relative), "rebasing moves the origin and nothing else");
    c.hash(map);
    for (T* const number : {&box.lo.x, &box.hi.y, &box.depth_lo, &box.depth_hi, &box.basis.x.y})
        if (c.one_in(2)) *number = c.number<T>();
    c.require(laws::finite(c.call([&] { return clip_from_world(box, clip); })), "any box has a finite matrix");
}

template <class T>
void try_projections(Case& c) {
    Mat4<T> matrix(T(0));
    for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = c.one_in(3) ? c.number<T>() : c.uniform<T>(T(-2), T(2));
    Vec3<T> const point = any_vector<T>(c), unit = direction<T>(c);
    T const a = c.number<T>(), b = c.number<T>(), limit = c.magnitude<T>(-20, 20);
    Projected<T> const there = c.call([&] { return projected(matrix, point, a); });
    c.require(overflow_unseen || laws::is_finite(there), "any point is projected to something finite");
    T const quotient = c.call([&] { return bounded_quotient(a, b, limit); });
    c.require(all_finite(&quotient, 1) && std::abs(quotient) <= limit, "a quotient keeps to its limit");
    T const length = c.magnitude<T>(-90, 90);
    constexpr T tolerance = T(16) * std::numeric_limits<T>::epsilon();
    c.require(laws::span_the_plane(tangents(unit * length), unit, tolerance), "tangents span the plane");
}

// Each worst case of the closed forms is one that occurs, and none that occurs is worse.
template <class T>
void try_closed_forms(Case& c) {
    using namespace closed_form;
    T const n = c.magnitude<T>(-7, 7), f = n * (T(1) + c.magnitude<T>(-3, 14));
    T const z = c.uniform<T>(n, f), centre = n * c.magnitude<T>(0, 14), least = warped_worst(n, f, best_centre(n, f));
    constexpr T up = T(1) + T(64) * std::numeric_limits<T>::epsilon();
    c.require(warped_along(z, n, f, centre) <= warped_worst(n, f, centre) * up, "a warp is worst at an end");
    c.require(least <= warped_worst(n, f, centre) * up, "no centre beats the best");
    c.require(logarithmic_along(n, f) <= least * up, "no warp beats the logarithm");
    if (c.numbers() == Numbers::any) {
        long double const from = n, to = f, here = c.uniform<T>(T(1.01), T(1.9)) * n;
        if (here < to * 0.99L) {
            auto const uniform = [=](long double at) { return (at - from) / (to - from); };
            long double const ratio = uniform_along(here, from, to) / laws::measured_along(uniform, here, 1e-6L * here);
            c.require(std::abs(ratio - 1) <= 1e-9L, "the error is the step of the map over the depth");
        }
    }
    T const a = c.number<T>(), b = c.number<T>(), d = c.number<T>();
    (void)c.call([&] { return warped_along(a, b, d, a) + split_warped_worst(a, b, 3) + best_centre(b, d); });
}

template <class T>
void try_foundations(Case& c) {
    switch (c.below(5)) {
        case 0: return try_numbers<T>(c);
        case 1: return try_conventions<T>(c);
        case 2: return try_light_boxes<T>(c);
        case 3: return try_projections<T>(c);
        default: return try_closed_forms<T>(c);
    }
}

[[maybe_unused]] bool const conventions_target =
    add_target("conventions", [](Case& c) { c.one_in(2) ? try_foundations<float>(c) : try_foundations<double>(c); });

}  // namespace
}  // namespace shadowmath::fuzz
