// SPDX-License-Identifier: MIT
//
// Every technique is continuous in the camera's and in the light's direction: a turn that is a hundredth of what anyone
// could see moves no point by more than a tenth of a texel. A jump anywhere, of a side, an axis or the strength of a
// warp, would be hundreds.
//
// Where a rectangle may turn by a quarter, the last frame's is given, as a renderer does. Fits to sampled depths are
// left out: what is seen may jump.
#include "tests/laws/warp.hpp"
#include "tests/support/gen.hpp"

#include <shadowmath/shadowmath.hpp>

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

namespace {

using V3 = Vec3<double>;
using Last = ShadowMap<double> const*;

// The ground's edge in view runs away as h / angle^2 where it nears the horizon: (300 m)^2 / 1 m of 300 m, and a few
// times that where a warp magnifies the near end.
constexpr double steepest = 1e4;
constexpr double turn = 1e-8;  // radians
constexpr int map_size = 1024;
constexpr double tolerated_texels = steepest * turn * map_size;

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

rc::Gen<Street> street() {
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

V3 turned(V3 const& v, V3 const& axis) {
    return v + glm::cross(axis, v) * turn;
}

Street with_camera_turned(Street street) {
    Pose<double>& pose = street.view.pose;
    pose.forward = turned(pose.forward, street.axis);
    pose.up = turned(pose.up, street.axis);
    pose.right = turned(pose.right, street.axis);
    pose = orthonormalized(pose);
    return street;
}

Street with_light_turned(Street street) {
    street.sun = directional(turned(street.sun.direction, street.axis));
    street.lamp = spot(street.lamp.position, turned(street.lamp.direction, street.axis), street.lamp.half_angle_radians,
                       street.lamp.range);
    return street;
}

// Calls make(street, before), where `before` is what the unturned street gave, or null.
template <class Make>
void expect_small_steps(char const* technique, Make const& make) {
    int moved = 0;
    EXPECT_TRUE(rc::check([&] {
        Street const before = *street();
        ShadowMap<double> const map = make(before, nullptr);
        RC_PRE(map.visible && projected(map.clip_from_world, before.point, map.w_min).in_front);
        for (Street const& after : {with_camera_turned(before), with_light_turned(before)}) {
            ShadowMap<double> const next = make(after, &map);
            RC_ASSERT(next.visible);
            double const texels = laws::moved_texels(map, next, before.point, map_size);
            RC_ASSERT(texels <= tolerated_texels);
            moved += texels > 0.0 ? 1 : 0;
        }
    })) << technique;
    EXPECT_GT(moved, 100) << technique << ": nothing was tried";
}

ShadowMap<double> cascade(CascadeFit fit, Street const& street, Last previous) {
    CascadeOptions<double> options;
    options.count = 1;
    options.map_size = map_size;
    options.fit = fit;
    Cascades<double> last;
    last.count = previous != nullptr ? 1 : 0;
    if (previous != nullptr) last.at[0].map = *previous;
    return fit_cascades(street.view, street.sun, casters, receivers, options, &last).at[0].map;
}

}  // namespace

TEST(Continuity, OfTightMaps) {
    expect_small_steps("tight", [](Street const& s, Last last) { return cascade(CascadeFit::tight, s, last); });
}

TEST(Continuity, OfRectanglesThatKeepTheirAngle) {
    expect_small_steps("rectangle", [](Street const& s, Last last) { return cascade(CascadeFit::rectangle, s, last); });
}

TEST(Continuity, OfTheFocus) {
    expect_small_steps("focus", [](Street const& s, Last last) { return cascade(CascadeFit::focus, s, last); });
}

TEST(Continuity, OfWarpsOfEveryRuleAndStrength) {
    for (WarpRule const rule : {WarpRule::by_strength, WarpRule::trapezoid, WarpRule::extended})
        for (double const strength : {0.0, 0.5, 1.0, 2.0}) {
            WarpOptions<double> options;
            options.map_size = map_size;
            options.rule = rule;
            options.strength = strength;
            expect_small_steps("warp", [options](Street const& s, Last) {
                return simple_perspective_map(s.view, s.sun, casters, receivers, options, gl_clip);
            });
        }
}

TEST(Continuity, OfViewDependentMapsOnAPlaneThatStays) {
    VdsmOptions<double> options;
    options.map_size = map_size;
    expect_small_steps("view-dependent", [options](Street const& s, Last) {
        return view_dependent_map(s.view, s.sun, {V3(0, 1, 0), -0.5}, casters, receivers, options, gl_clip);
    });
}

TEST(Continuity, OfSpotsAndFacesCroppedToWhatIsSeen) {
    expect_small_steps("spot", [](Street const& s, Last) {
        return fit_spot(s.view, s.lamp, casters, receivers, map_size, 2.0, gl_clip);
    });
    expect_small_steps("cube", [](Street const& s, Last) {
        auto const maps = fit_cube(s.view, s.lamp.position, s.lamp.range, casters, receivers, map_size, 2.0, gl_clip);
        return maps.face[static_cast<std::size_t>(face_toward(s.lamp.position, s.point))];
    });
}

// Those move in whole texels; what is left beside them is nothing.
TEST(Continuity, OfStableMapsIsTheirStillness) {
    EXPECT_TRUE(rc::check([] {
        Street const before = *street();
        ShadowMap<double> const map = cascade(CascadeFit::stable, before, nullptr);
        RC_PRE(map.visible);
        for (Street const& after : {with_camera_turned(before), with_light_turned(before)})
            RC_ASSERT(shimmer_texels(texel_shift(map, cascade(CascadeFit::stable, after, &map), map_size,
                                                 before.point)) <= tolerated_texels);
    }));
}
