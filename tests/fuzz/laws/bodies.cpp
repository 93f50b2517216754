// SPDX-License-Identifier: MIT
//
// Convex bodies, what casts on them, how deep they are, and the fits that are made from them.
#include "tests/fuzz/inputs.hpp"
#include "tests/laws/depth_range.hpp"
#include "tests/laws/fit_focus.hpp"

namespace shadowmath::fuzz {
namespace {

// A box of some millimetres or kilometres, cut a few times, and a point that every cut has kept.
template <class T>
struct Cut {
    ConvexBody<T> body;
    Vec3<T> kept;
    T unit;   // its coordinates are at most 35 of it
    T slack;  // twenty roundings a cut over coordinates as large
    int cuts;
};

template <class T>
Cut<T> cut_body(Case& c) {
    T const unit = c.magnitude<T>(-10, 10);
    Aabb<T> const start = small_box<T>(c, T(10) * unit);
    Vec3<T> const kept = in_box(c, start);
    Cut<T> cut{convex_body(start), kept, unit, T(20 * 18) * std::numeric_limits<T>::epsilon() * T(35) * unit,
               c.below(10)};
    for (int i = 0; i < cut.cuts; ++i) {
        Vec3<T> const normal = direction<T>(c);
        Vec4<T> const half_space(normal, c.uniform<T>(T(0.01), T(5)) * unit - glm::dot(normal, cut.kept));
        cut.body = c.call([&] { return clipped(cut.body, half_space); });
        c.require(laws::lies_inside(cut.body, half_space, cut.slack), "a cut leaves nothing outside");
    }
    return cut;
}

template <class T>
void try_bodies(Case& c) {
    Cut<T> const cut = cut_body<T>(c);
    c.require(laws::may_contain(cut.body, cut.kept, cut.slack), "a cut loses nothing inside");
    c.require(cut.cuts > 1 || laws::is_a_polyhedron(cut.body), "a cut body is a polyhedron");
    Light<T> const sun = good_sun<T>(c);
    bool const is_sun = c.one_in(2);
    Vec3<T> const place = point_within<T>(c, T(50) * cut.unit);
    Light<T> const light = is_sun ? sun : spot(place, sun.direction, T(1), T(100) * cut.unit);
    HalfSpaces<T> const swept = c.call([&] { return swept_to_light(cut.body, homogeneous(light)); });
    Vec3<T> const way = is_sun ? -light.direction * (T(200) * cut.unit) : light.position - cut.kept;
    // As for the body, over 250 units on the way to the light.
    T const slack = T(220) * std::numeric_limits<T>::epsilon() * T(250) * cut.unit;
    c.require(laws::inside(swept, cut.kept + way * c.uniform<T>(T(0), T(1)), slack), "all of the way is swept");
    Vec3<T> const point = cut.kept + point_within<T>(c, T(30) * cut.unit);
    bool const casts = laws::inside(swept, point, T(0));
    // At the lamp itself all rays meet, and none has a direction.
    bool const apart = is_sun || glm::length(point - place) > cut.unit;
    T const around = casts ? T(1e-3) * cut.unit : T(-1e-3) * cut.unit;
    c.require(!apart || laws::casts_on(cut.body, homogeneous(light), point, around) == casts,
              "what is swept is what casts");

    LightBasis<T> const basis = light_basis(sun.direction);
    T const margin = c.uniform<T>(T(0), T(8));
    int const size = 19 + c.below(8000);
    Vec3<T> const last = direction<T>(c);
    T const hysteresis = c.number<T>();
    LightBox<T> const box = c.call([&] { return fit_rectangle(basis, cut.body, size, margin, last, hysteresis); });
    c.hash(&box.lo.x, 2);
    c.hash(&box.hi.x, 2);
    c.require(laws::is_a_box(box), "a rectangle has an extent");
    c.require(laws::is_rolled(box.basis, basis), "a rectangle is turned about the light");
    c.require(laws::holds_body_and_margin(box, cut.body, size, margin), "a rectangle holds its body and margin");
}

template <class T>
void try_common_depths(Case& c) {
    ViewVolume<T> volume = good_view<T>(c);
    volume.pose.position = point_within<T>(c, T(10));
    volume.z_near = c.uniform<T>(T(0.1), T(5));
    volume.z_far = volume.z_near + c.uniform<T>(T(0.5), T(30));
    T* const sides[] = {&volume.left, &volume.bottom, &volume.right, &volume.top};
    for (int i = 0; i < 4; ++i) *sides[i] = c.uniform<T>(T(0.2), T(3)) * T(i < 2 ? -1 : 1);
    Aabb<T> const body = small_box<T>(c, T(10));
    c.require(laws::finds_the_common_depths(body, volume, 1000.0L * 150.0L * std::numeric_limits<T>::epsilon()),
              "the depths in common are found");
}

template <class T>
void try_depths(Case& c) {
    LightBasis<T> const basis = light_basis(good_sun<T>(c).direction);
    LightBox<T> box = fit_box(basis, corners(small_box<T>(c, T(20))), 256, T(2));
    DepthRange<T> slice{box.depth_lo, box.depth_hi, true};
    Aabb<T> const casters = small_box<T>(c, T(50)), receivers = small_box<T>(c, T(50));
    bool const pancake = c.one_in(2);
    DepthRange<T> const range = c.call([&] { return depth_range(box, slice, casters, receivers, pancake); });
    c.require(laws::is_a_range(range), "depths are a range");
    c.require(laws::reaches(range, box, slice, in_box(c, receivers)), "a range reaches every receiver");
    c.require(pancake || laws::starts_before(range, box, in_box(c, casters)), "a range starts before every caster");
    for (T* const number : {&box.lo.x, &box.hi.y, &slice.lo, &slice.hi, &box.basis.depth.y})
        if (c.one_in(2)) *number = c.number<T>();
    Aabb<T> const any = any_box<T>(c), other = any_box<T>(c);
    DepthRange<T> const odd = c.call([&] { return depth_range(box, slice, any, other, pancake); });
    c.require(laws::is_a_range(odd) && laws::is_a_range(in_steps(odd, c.number<T>())), "any depths are a range");
}

template <class T>
void try_focus(Case& c) {
    SeenCase<T> const seen = seen_case<T>(c);
    Light<T> light = good_sun<T>(c);
    T const away = c.magnitude<T>(-10, 7);
    Vec3<T> const& eye = seen.view.pose.position;
    Vec3<T> const caster = seen.point - light.direction * (away * glm::length(seen.point - eye));
    Vec3<T> const half = glm::abs(point_within<T>(c, away));
    Aabb<T> casters{caster - half, caster + half}, receivers = seen.receivers;
    Focus<T> focus = c.calm_call([&] { return focus_of(seen.view, light, casters, receivers); });
    T const noise = T(64) * std::numeric_limits<T>::epsilon() *
                    (glm::length(eye) + glm::length(seen.point) + glm::length(caster) + seen.view.z_far);
    c.require(laws::focuses(focus, light.direction, seen.point, caster, noise), "what is seen in shadow is in focus");
    ViewVolume<T> view = seen.view;
    spoil(c, view);
    if (c.one_in(2)) light = any_light<T>(c);
    casters = any_box<T>(c);
    focus = c.call([&] { return focus_of(view, light, casters, receivers); });
    c.require(laws::is_a_box(fit_focus(light_basis(light.direction), focus, 512, T(2))), "any focus has a box");
}

template <class T>
void try_fits(Case& c) {
    int const kind = c.below(20);
    if (kind == 0) return try_common_depths<T>(c);  // its oracle costs as much as a hundred others
    switch (kind % 3) {
        case 0: return try_bodies<T>(c);
        case 1: return try_depths<T>(c);
        default: return try_focus<T>(c);
    }
}

[[maybe_unused]] bool const bodies_target =
    add_target("bodies", [](Case& c) { c.one_in(2) ? try_fits<float>(c) : try_fits<double>(c); });

}  // namespace
}  // namespace shadowmath::fuzz
