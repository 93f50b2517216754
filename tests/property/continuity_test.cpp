// SPDX-License-Identifier: MIT
//
// Every technique is continuous in the camera's and in the light's direction. Over a turn of a third of a radian the
// half in which a point moves more texels is halved again, until nothing is left of the turn: where anything jumps, a
// side, an axis, the strength of a warp, that is where the halves end, and the point still moves.
//
// Stable maps move in whole texels, so theirs is another law (their stillness). Which angle a rectangle takes may jump,
// and is held from frame to frame; its area may not. Fits to sampled depths are left out: what is seen may jump.
#include "tests/laws/warp.hpp"
#include "tests/support/gen.hpp"

#include <shadowmath/shadowmath.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <optional>

using namespace shadowmath;
using namespace shadowmath::test;

namespace {

using V3 = Vec3<double>;

// The ground's edge in view runs away as h / angle^2 where it nears the horizon: (300 m)^2 / 1 m of 300 m, and a few
// times that where a warp magnifies the near end.
constexpr double steepest = 1e4;
constexpr double whole_turn = 0.3;  // radians
constexpr int halvings = 27;
constexpr int map_size = 1024;

Aabb<double> const receivers{V3(-200, 0, -200), V3(200, 5, 200)}, casters{V3(-200, 0, -200), V3(200, 30, 200)};

struct Street {
    ViewVolume<double> view;
    Light<double> sun;
    Light<double> lamp;
    V3 point;  // on the ground or up to 5 m above it, in view
    V3 axis;   // about which something turns
};

void showValue(Street const& street, std::ostream& out) {
    shadowmath::showValue(street.view, out);
    out << "\nsun ";
    shadowmath::showValue(street.sun, out);
    out << "\nlamp ";
    shadowmath::showValue(street.lamp, out);
    out << "\npoint ";
    glm::showValue(street.point, out);
    out << "\naxis ";
    glm::showValue(street.axis, out);
}

rc::Gen<Street> any_street() {
    return rc::gen::exec([] {
        Street made;
        auto const height = *uniform<double>(1.0, 20.0);
        auto const pitch = *uniform<double>(-0.2, 1.4);
        auto const heading = *uniform<double>(0.0, 6.28);
        auto const fov = *uniform<double>(0.6, 1.4);
        auto const z_far = *log_uniform<double>(20.0, 300.0);
        V3 const forward(std::cos(heading) * std::cos(pitch), -std::sin(pitch), std::sin(heading) * std::cos(pitch));
        made.view = perspective_view(pose_looking(V3(3, height, -7), forward, V3(0, 1, 0)), fov, 1.6, 0.2, z_far);
        auto const elevation = *uniform<double>(0.1, 1.5);
        auto const azimuth = *uniform<double>(0.0, 6.28);
        made.sun = directional(
            -V3(std::cos(azimuth) * std::cos(elevation), std::sin(elevation), std::sin(azimuth) * std::cos(elevation)));
        auto const across = *uniform<double>(0.05, 0.95);
        auto const upward = *uniform<double>(0.05, 0.95);
        auto const depth = *log_uniform<double>(0.5, z_far * 0.9);
        made.point = point_at(made.view, made.view.left + (made.view.right - made.view.left) * across,
                              made.view.bottom + (made.view.top - made.view.bottom) * upward, depth);
        RC_PRE(contains(receivers, made.point));
        auto const aside = *direction<double>();
        auto const half_angle = *uniform<double>(0.3, 1.0);
        V3 const lamp = made.point + V3(aside.x * 4, 8 + aside.y * 3, aside.z * 4);
        made.lamp = spot(lamp, made.point - lamp + aside * 0.5, half_angle, 40.0);
        made.axis = *direction<double>();
        return made;
    });
}

V3 turned(V3 const& v, V3 const& axis, double angle) {
    return v * std::cos(angle) + glm::cross(axis, v) * std::sin(angle) +
           axis * (glm::dot(axis, v) * (1.0 - std::cos(angle)));
}

Street with_camera_turned(Street street, double angle) {
    Pose<double>& pose = street.view.pose;
    for (V3* const v : {&pose.forward, &pose.up, &pose.right}) *v = turned(*v, street.axis, angle);
    pose = orthonormalized(pose);
    return street;
}

Street with_light_turned(Street street, double angle) {
    street.sun = directional(turned(street.sun.direction, street.axis, angle));
    street.lamp = spot(street.lamp.position, turned(street.lamp.direction, street.axis, angle),
                       street.lamp.half_angle_radians, street.lamp.range);
    return street;
}

using Place = std::optional<Vec2<double>>;  // texels

Place place_in(ShadowMap<double> const& map, V3 const& point) {
    Projected<double> const at = projected(map.clip_from_world, point, map.w_min);
    if (!map.visible || !at.in_front) return std::nullopt;
    return Vec2<double>(at.at) * (map_size / 2.0);
}

// place_of(street): where the street's point lies, or nothing.
template <class PlaceOf>
void expect_no_jump(char const* technique, PlaceOf const& place_of) {
    int tried = 0;
    EXPECT_TRUE(rc::check([&] {
        Street const street = *any_street();
        bool const camera = *one_in(2);
        auto const at = [&](double angle) {
            return place_of(camera ? with_camera_turned(street, angle) : with_light_turned(street, angle));
        };
        double lo = 0.0, hi = whole_turn;
        Place a = at(lo), b = at(hi);
        for (int i = 0; i < halvings; ++i) {
            double const middle = (lo + hi) / 2.0;
            Place const m = at(middle);
            RC_PRE(a && b && m);
            bool const first = glm::distance(*a, *m) >= glm::distance(*m, *b);
            (first ? hi : lo) = middle;
            (first ? b : a) = m;
        }
        ++tried;
        RC_ASSERT(glm::distance(*a, *b) <= steepest * (hi - lo) * map_size);
    })) << technique;
    EXPECT_GT(tried, 100) << technique;
}

}  // namespace

TEST(Continuity, OfTightMaps) {
    CascadeOptions<double> options;
    options.count = 1;
    options.map_size = map_size;
    options.fit = CascadeFit::tight;
    expect_no_jump("tight", [options](Street const& s) {
        return place_in(fit_cascades(s.view, s.sun, casters, receivers, options).at[0].map, s.point);
    });
}

TEST(Continuity, OfTheFocusInGivenAxes) {
    expect_no_jump("focus", [](Street const& s) -> Place {
        Focus<double> const focus = focus_of(s.view, s.sun, casters, receivers);
        if (!focus.visible) return std::nullopt;
        LightBox<double> const box = fit_focus(light_basis(s.sun.direction), focus, map_size, 2.0);
        V3 const at = in_light(box.basis, s.point);
        return (Vec2<double>(at) - box.lo) / (box.hi - box.lo) * double(map_size);
    });
}

TEST(Continuity, OfTheLeastRectanglesArea) {
    expect_no_jump("rectangle", [](Street const& s) -> Place {
        auto const box = fit_rectangle(light_basis(s.sun.direction), convex_body(corners(s.view)), map_size, 2.0);
        return Vec2<double>(std::log(area(box)) * map_size, 0.0);
    });
}

TEST(Continuity, OfWarpsOfEveryRuleAndStrength) {
    for (WarpRule const rule : {WarpRule::by_strength, WarpRule::trapezoid, WarpRule::extended})
        for (double const strength : {0.5, 1.0, 2.0}) {
            WarpOptions<double> options;
            options.map_size = map_size;
            options.rule = rule;
            options.strength = strength;
            expect_no_jump("warp", [options](Street const& s) {
                return place_in(simple_perspective_map(s.view, s.sun, casters, receivers, options, gl_clip), s.point);
            });
        }
}

TEST(Continuity, OfViewDependentMapsOnAPlaneThatStays) {
    VdsmOptions<double> options;
    options.map_size = map_size;
    expect_no_jump("view-dependent", [options](Street const& s) {
        ShadowPlane<double> const plane{V3(0, 1, 0), -0.5};
        return place_in(view_dependent_map(s.view, s.sun, plane, casters, receivers, options, gl_clip), s.point);
    });
}

TEST(Continuity, OfSpotsAndFacesCroppedToWhatIsSeen) {
    expect_no_jump("spot", [](Street const& s) {
        return place_in(fit_spot(s.view, s.lamp, casters, receivers, map_size, 2.0, gl_clip), s.point);
    });
    expect_no_jump("cube", [](Street const& s) {
        auto const maps = fit_cube(s.view, s.lamp.position, s.lamp.range, casters, receivers, map_size, 2.0, gl_clip);
        return place_in(maps.face[static_cast<std::size_t>(face_toward(s.lamp.position, s.point))], s.point);
    });
}
