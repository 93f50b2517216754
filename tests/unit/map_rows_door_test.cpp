// SPDX-License-Identifier: MIT
#include <shadowmath/map_rows.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

using namespace shadowmath;

namespace {

using V3 = Vec3<double>;

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

struct DoorOfMaps : ::testing::Test {
    ViewVolume<double> view =
        perspective_view(pose_looking(V3(3, 2, 10), V3(0.3, -0.1, -1), V3(0, 1, 0)), 1.0, 1.6, 0.1, 200.0);
    Light<double> light = directional(V3(0.4, -0.8, 0.3));
    Aabb<double> receivers{V3(-120, 0, -120), V3(120, 30, 120)};
    Aabb<double> casters = receivers;
    int map_size = 1024;
    double margin = 2;

    Door<double> opened() const { return door(view, light, casters, receivers, map_size, margin); }
    void expect_stop(Fault fault) const {
        Door<double> const at = opened();
        EXPECT_TRUE(at.stop);
        EXPECT_TRUE(at.faults.has(fault));
    }
};

}  // namespace

TEST_F(DoorOfMaps, IsOpenToAViewALightAndTwoBoxes) {
    view.pose.right *= 1.0002;
    light.direction *= 1.0002;
    Door<double> const at = opened();
    EXPECT_FALSE(at.stop);
    EXPECT_EQ(at.faults.bits, 0u);
    EXPECT_NEAR(glm::length(at.view.pose.right), 1.0, 1e-15);
    EXPECT_NEAR(glm::length(at.light.direction), 1.0, 1e-15);
    EXPECT_EQ(at.view.z_far, view.z_far);
}

TEST_F(DoorOfMaps, IsClosedToWhatNoMapCanBeMadeOf) {
    auto const expect_closed = [this](Fault fault, auto const& spoil) {
        auto const was = std::tuple(view, light, receivers, casters, map_size, margin);
        spoil();
        expect_stop(fault);
        std::tie(view, light, receivers, casters, map_size, margin) = was;
    };
    expect_closed(Fault::not_finite, [&] { casters.hi.y = no_number; });
    expect_closed(Fault::not_finite, [&] { receivers.lo.z = infinity; });
    expect_closed(Fault::not_finite, [&] { view.pose.position.x = no_number; });
    expect_closed(Fault::not_finite, [&] { margin = no_number; });
    expect_closed(Fault::zero_light, [&] { light.direction = V3(0); });
    expect_closed(Fault::empty_range, [&] { view.z_near = view.z_far; });
    expect_closed(Fault::bad_frustum, [&] { view.left = view.right; });
    expect_closed(Fault::bad_pose, [&] { view.pose.up *= 2; });
    expect_closed(Fault::map_too_small, [&] { map_size = 2; });
}

TEST_F(DoorOfMaps, IsClosedWithoutAFaultWhereABoxIsEmpty) {
    for (Aabb<double>* box : {&casters, &receivers}) {
        Aabb<double> const was = *box;
        *box = {};
        EXPECT_TRUE(opened().stop);
        EXPECT_EQ(opened().faults.bits, 0u);
        *box = was;
    }
}

TEST_F(DoorOfMaps, IsClosedToWhatLiesBeyond1e12) {
    double const most = 1e12, more = std::nextafter(most, infinity);
    light = spot(V3(0, 40, 0), V3(0.1, -1, 0), 0.8, 100.0);
    for (V3* place : {&view.pose.position, &light.position})
        for (int axis = 0; axis < 3; ++axis)
            for (double const sign : {1.0, -1.0}) {
                double const was = (*place)[axis];
                (*place)[axis] = sign * most;
                EXPECT_FALSE(opened().stop) << axis;
                EXPECT_EQ(opened().faults.bits, 0u) << axis;
                (*place)[axis] = sign * more;
                expect_stop(Fault::precision_lost);
                (*place)[axis] = was;
            }
    light.range = most;
    EXPECT_FALSE(opened().stop);
    light.range = more;
    expect_stop(Fault::precision_lost);
    light.range = 100;
    view.right = 1e11;
    expect_stop(Fault::precision_lost);
}

TEST_F(DoorOfMaps, EndsAViewWithoutAnEndBehindTheFarthestReceiver) {
    double end = 0;
    for (V3 const& corner : corners(receivers)) end = std::max(end, eye_depth(view, corner));
    for (double const z_far : {infinity, 1e13, std::nextafter(1e12, infinity)}) {
        view.z_far = z_far;
        Door<double> const at = opened();
        EXPECT_FALSE(at.stop);
        EXPECT_EQ(at.faults.bits, Faults(Fault::far_clamped).bits);
        EXPECT_EQ(at.view.z_far, end);
    }
    view.z_near = end;
    EXPECT_TRUE(opened().stop);
    view.z_near = end - 1;
    EXPECT_FALSE(opened().stop);
    view.left = view.bottom = -0.2, view.right = view.top = 0.2;
    view.z_far = 1e12;
    EXPECT_EQ(opened().faults.bits, 0u);
    EXPECT_EQ(opened().view.z_far, 1e12);
}

TEST_F(DoorOfMaps, EndsAViewWithoutAnEndAt1e12AtMost) {
    view.z_far = infinity;
    view.left = view.bottom = -1e-3, view.right = view.top = 1e-3;
    receivers.hi = V3(1e14), receivers.lo = V3(-1e14);
    Door<double> const at = opened();
    EXPECT_EQ(at.view.z_far, 1e12);
    EXPECT_TRUE(at.faults.has(Fault::far_clamped));
}

TEST_F(DoorOfMaps, IsClosedWhereAllReceiversLieBehindAViewWithoutAnEnd) {
    view.z_near = 0, view.z_far = infinity;
    V3 const behind = view.pose.position - view.pose.forward * 100.0;
    receivers = {behind - V3(1), behind + V3(1)};
    EXPECT_TRUE(opened().stop);
    EXPECT_EQ(opened().faults.bits, Faults(Fault::far_clamped).bits);
}
