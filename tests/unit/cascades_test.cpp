// SPDX-License-Identifier: MIT
//
// What the maps are, option by option. What bad options and inputs give: cascades_input_test.cpp.
#include "tests/laws/cascades.hpp"
#include "tests/support/cascades_of.hpp"
#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace shadowmath;
using namespace shadowmath::test;

namespace {

using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(CascadesOf, Scalars);

TYPED_TEST(CascadesOf, DefaultsGiveFourVisibleMapsWithoutAFault) {
    auto const cascades = this->fitted();
    ASSERT_EQ(cascades.count, 4);
    EXPECT_FALSE(cascades.faults.any()) << describe(cascades.faults);
    EXPECT_TRUE(laws::well_formed(cascades));
    for (auto const& c : cascades) {
        EXPECT_TRUE(c.map.visible);
        EXPECT_TRUE(laws::is_map_of(c.map.clip_from_world, this->sun, this->options.clip));
    }
    EXPECT_EQ(cascades.at[0].range.begin, this->view.z_near);
    EXPECT_EQ(cascades.at[3].range.end, this->view.z_far);
}

TYPED_TEST(CascadesOf, EachMapIsCoarserThanTheOneBefore) {
    auto const cascades = this->fitted();
    for (int i = 1; i < cascades.count; ++i) EXPECT_GT(cascades.at[i].texel_metres, cascades.at[i - 1].texel_metres);
}

TYPED_TEST(CascadesOf, TightMapsHaveSmallerTexelsThanStableOnes) {
    auto const stable = this->fitted();
    this->options.fit = CascadeFit::tight;
    auto const tight = this->fitted();
    for (int i = 0; i < stable.count; ++i) EXPECT_LT(tight.at[i].texel_metres, stable.at[i].texel_metres);
}

TYPED_TEST(CascadesOf, RectanglesCoverLessThanBoxesAndTheFocusLessThanRectangles) {
    using T = TypeParam;
    this->view.pose = pose_looking(this->view.pose.position, Vec3<T>(T(1), T(-0.1), T(-2)), this->view.pose.up);
    double covered[3] = {};
    for (int i = 0; i < 3; ++i) {
        this->options.fit = static_cast<CascadeFit>(1 + i);
        auto const cascades = this->fitted();
        EXPECT_FALSE(cascades.faults.any());
        for (auto const& c : cascades) {
            EXPECT_TRUE(c.map.visible);
            EXPECT_TRUE(laws::is_map_of(c.map.clip_from_world, this->sun, this->options.clip));
            covered[i] += static_cast<double>(laws::square_metres(c.map));
        }
    }
    EXPECT_LT(covered[1], 0.95 * covered[0]);
    EXPECT_LT(covered[2], 0.95 * covered[1]);
}

TYPED_TEST(CascadesOf, TexelsAndDepthAreAsLongAsTheMatrixMakesThem) {
    using T = TypeParam;
    for (CascadeFit const fit : {CascadeFit::stable, CascadeFit::tight, CascadeFit::rectangle, CascadeFit::focus}) {
        this->options.fit = fit;
        // A row has a handful of roundings of its own.
        for (auto const& c : this->fitted())
            EXPECT_TRUE(laws::measures_itself(c, this->options, 32 * std::numeric_limits<T>::epsilon())) << int(fit);
    }
}

TYPED_TEST(CascadesOf, RectanglesKeepTheAngleOfTheLastFrame) {
    using T = TypeParam;
    this->options.fit = CascadeFit::rectangle;
    auto const before = this->fitted();
    // Half a degree to the left.
    this->view.pose = pose_looking(this->view.pose.position, Vec3<T>(T(-0.009), T(0), T(-1)), this->view.pose.up);
    auto const after = fit_cascades(this->view, this->sun, this->world, this->world, this->options, &before);
    for (int i = 0; i < after.count; ++i) {
        auto const x = [i](Cascades<T> const& c) {
            return safe_normalize(Vec3<T>(row(c.at[i].map.clip_from_world, 0))).direction;
        };
        EXPECT_NEAR(glm::dot(x(before), x(after)), T(1), 1e-6);
        EXPECT_LT(glm::dot(x(this->fitted()), x(before)), T(1) - T(1e-5));
    }
}

// From 60 to 30 degrees and back in half degrees: with the last frame at hand texels change a few times, not each time.
TYPED_TEST(CascadesOf, ASlowZoomKeepsTheTexelsOfStableMaps) {
    using T = TypeParam;
    auto last = this->fitted();
    int changes = 0;
    for (int i = 0; i <= 120; ++i) {
        T const half = T(0.2618) + T(0.2618) * std::abs(T(1) - T(i) / T(60));
        ViewVolume<T> zoomed = this->view;
        zoomed.top = std::tan(half);
        zoomed.bottom = -zoomed.top;
        zoomed.right = zoomed.top * T(1.6);
        zoomed.left = -zoomed.right;
        auto const now = fit_cascades(zoomed, this->sun, this->world, this->world, this->options, &last);
        T const needed = fit_cascades(zoomed, this->sun, this->world, this->world, this->options).at[2].texel_metres;
        EXPECT_GE(now.at[2].texel_metres, needed);
        EXPECT_LE(now.at[2].texel_metres, needed * T(1.25));
        changes += now.at[2].texel_metres != last.at[2].texel_metres;
        last = now;
    }
    EXPECT_LE(changes, 16);
}

TYPED_TEST(CascadesOf, TheNearestMapsStayStableBeforeAnyOtherFit) {
    auto const stable = this->fitted();
    for (CascadeFit const fit : {CascadeFit::rectangle, CascadeFit::warped}) {
        this->options.fit = fit;
        this->options.steady_maps = 0;
        auto const other = this->fitted();
        for (int const steady : {-1, 2, 4, 9}) {
            this->options.steady_maps = steady;
            auto const mixed = this->fitted();
            for (int i = 0; i < 4; ++i)
                EXPECT_EQ(mixed.at[i].map.clip_from_world, (i < steady ? stable : other).at[i].map.clip_from_world)
                    << steady << ' ' << i;
        }
    }
}

TYPED_TEST(CascadesOf, WarpedSlicesAreWarpedMaps) {
    using T = TypeParam;
    this->options.fit = CascadeFit::warped;
    auto const cascades = this->fitted();
    for (auto const& c : cascades) {
        EXPECT_TRUE(c.map.visible);
        EXPECT_GT(glm::length(Vec3<T>(row(c.map.clip_from_world, 3))), T(0));
        EXPECT_TRUE(laws::is_map_of(c.map.clip_from_world, this->sun, this->options.clip));
        EXPECT_EQ(c.texel_metres, T(0));
    }
    this->options.warp_strength = T(0);
    for (auto const& c : this->fitted()) EXPECT_EQ(glm::length(Vec3<T>(row(c.map.clip_from_world, 3))), T(0));
}

TYPED_TEST(CascadesOf, EachMapHasItsShareOfTheWarp) {
    using T = TypeParam;
    this->options.fit = CascadeFit::warped;
    auto const warped = this->fitted();
    this->options.warp_less[1] = T(1);
    this->options.warp_less[2] = T(0.5);
    auto const mixed = this->fitted();
    auto const growth = [](Cascade<T> const& c) { return glm::length(Vec3<T>(row(c.map.clip_from_world, 3))); };
    for (int i : {0, 3}) EXPECT_EQ(mixed.at[i].map.clip_from_world, warped.at[i].map.clip_from_world) << i;
    EXPECT_EQ(growth(mixed.at[1]), T(0));
    EXPECT_GT(growth(mixed.at[2]), T(0));
    EXPECT_LT(growth(mixed.at[2]), growth(warped.at[2]));
    this->options.warp_less[1] = std::numeric_limits<T>::quiet_NaN();
    auto const broken = this->fitted();
    EXPECT_FALSE(broken.at[1].map.visible);
    EXPECT_TRUE(broken.faults.has(Fault::not_finite));
    EXPECT_TRUE(broken.at[2].map.visible);
}

TYPED_TEST(CascadesOf, NoFewerThanNoMapsAndNoMoreThanAllAreSteady) {
    this->options.fit = CascadeFit::warped;
    auto const same = [](auto const& a, auto const& b) {
        for (int i = 0; i < 4; ++i)
            if (a.at[i].map.clip_from_world != b.at[i].map.clip_from_world) return false;
        return a.count == 4 && b.count == 4;
    };
    auto const none = this->fitted();
    this->options.steady_maps = -3;
    EXPECT_TRUE(same(this->fitted(), none));
    this->options.steady_maps = 4;
    auto const all = this->fitted();
    this->options.steady_maps = 9;
    EXPECT_TRUE(same(this->fitted(), all));
    this->options.fit = CascadeFit::stable;
    EXPECT_TRUE(same(this->fitted(), all));
    EXPECT_FALSE(same(none, all));
}

TYPED_TEST(CascadesOf, AWarpThatIsStrongerThanThereIsIsTheStrongest) {
    using T = TypeParam;
    this->options.fit = CascadeFit::warped;
    this->options.warp_strength = T(2);
    auto const strongest = this->fitted();
    EXPECT_FALSE(strongest.faults.any());
    this->options.warp_strength = T(2.5);
    auto const beyond = this->fitted();
    EXPECT_TRUE(beyond.faults.has(Fault::clamped_option));
    auto const growth = [](Cascade<T> const& c) { return glm::length(Vec3<T>(row(c.map.clip_from_world, 3))); };
    for (int i = 0; i < 4; ++i) EXPECT_NEAR(growth(beyond.at[i]) / growth(strongest.at[i]), T(1), T(1e-3)) << i;
}

TYPED_TEST(CascadesOf, PancakedFocusBeginsWithItsReceivers) {
    this->options.fit = CascadeFit::focus;
    auto const whole = this->fitted();
    this->options.pancake = true;
    auto const flat = this->fitted();
    for (int i = 0; i < flat.count; ++i) EXPECT_LT(flat.at[i].depth_metres, whole.at[i].depth_metres);
}

TYPED_TEST(CascadesOf, AFrameBeforeWithFewerMapsHelpsThoseThatItHad) {
    // Of a view that is a little wider: its texels will do.
    ViewVolume<TypeParam> const narrow = this->view;
    this->view.top *= TypeParam(1.03);
    this->view.bottom *= TypeParam(1.03);
    auto before = this->fitted();
    this->view = narrow;
    before.count = 2;
    auto const after = fit_cascades(this->view, this->sun, this->world, this->world, this->options, &before);
    auto const fresh = this->fitted();
    ASSERT_EQ(after.count, 4);
    for (int i = 0; i < 4; ++i)
        EXPECT_EQ(after.at[i].texel_metres, i < 2 ? before.at[i].texel_metres : fresh.at[i].texel_metres) << i;
    EXPECT_NE(before.at[3].texel_metres, fresh.at[3].texel_metres);
}

TYPED_TEST(CascadesOf, APinnedFirstSplitEndsWhereItIsPinned) {
    this->options.first_split_end = TypeParam(2);
    EXPECT_EQ(this->fitted().at[0].range.end, TypeParam(2));
}

TYPED_TEST(CascadesOf, ANoonSunAndALookStraightDownAreOrdinary) {
    using T = TypeParam;
    this->sun = directional(Vec3<T>(T(0), T(-1), T(0)));
    this->view.pose = pose_looking(Vec3<T>(T(0), T(30), T(0)), Vec3<T>(T(0), T(-1), T(0)), Vec3<T>(T(0), T(1), T(0)));
    auto const cascades = this->fitted();
    EXPECT_FALSE(cascades.faults.any());
    EXPECT_TRUE(cascades.at[0].map.visible);
    for (auto const& c : cascades) {
        // The ground is 35 m down: what is cut off behind it has nothing to see.
        EXPECT_EQ(c.map.visible, c.range.begin < T(35));
        if (c.map.visible) {
            EXPECT_TRUE(laws::is_map_of(c.map.clip_from_world, this->sun, this->options.clip));
        }
    }
}

TYPED_TEST(CascadesOf, ASpotGetsAMapInEachSliceThatItsConeReaches) {
    using T = TypeParam;
    Light<T> const lamp = spot(Vec3<T>(T(3), T(8), T(-15)), Vec3<T>(T(0), T(-1), T(0)), T(0.6), T(20));
    auto const cascades = fit_cascades(this->view, lamp, this->world, this->world, this->options);
    ASSERT_TRUE(cascades.at[0].map.visible) << describe(cascades.faults);
    EXPECT_TRUE(laws::is_map_of(cascades.at[0].map.clip_from_world, lamp, this->options.clip, 256));
    EXPECT_FALSE(cascades.at[3].map.visible);
    EXPECT_TRUE(laws::well_formed(cascades));
}

TYPED_TEST(CascadesOf, TheCallAllocatesNothingAndRaisesNoFlag) {
    EXPECT_TRUE(test::watched([this] { return this->fitted(); }).calm_in_range());
}

// Moving in whole centimetres and turning freely, a million metres from the origin.
TEST(Cascades, AreStillInDoubleAMillionMetresAway) {
    ViewVolume<double> view = perspective_view(Pose<double>{}, 1.0, 1.6, 0.1, 300.0);
    Aabb<double> const world{glm::dvec3(-1e7), glm::dvec3(1e7)};
    auto const sun = directional(glm::dvec3(0.3, -1.0, 0.2));
    CascadeOptions<double> options;
    glm::dvec3 const home(1e6, 120.0, -2e6);
    glm::dvec3 const witness = home + glm::dvec3(0.123, -1.7, -4.567);
    view.pose = pose_looking(home, glm::dvec3(0, 0, -1), glm::dvec3(0, 1, 0));
    auto const before = fit_cascades(view, sun, world, world, options);
    for (int step = 1; step < 100; ++step) {
        glm::dvec3 const eye = home + glm::dvec3(0.01, 0.003, -0.02) * double(step);
        view.pose = pose_looking(eye, glm::dvec3(std::sin(0.05 * step), 0.01 * step, -std::cos(0.05 * step)),
                                 glm::dvec3(0, 1, 0));
        auto const after = fit_cascades(view, sun, world, world, options);
        for (int i = 0; i < before.count; ++i) {
            ASSERT_EQ(before.at[i].texel_metres, after.at[i].texel_metres);
            ASSERT_TRUE(laws::keeps_its_place(before.at[i].map.clip_from_world, after.at[i].map.clip_from_world,
                                              options.map_size, witness, 1.0L / 64))
                << "step " << step << ", cascade " << i;
        }
    }
}

TEST(Cascades, SayInFloatWhenTheyCannotBeStill) {
    ViewVolume<float> const view = perspective_view(Pose<float>{glm::vec3(1e6f, 0.0f, 0.0f)}, 1.0f, 1.6f, 0.1f, 100.0f);
    Aabb<float> const world{glm::vec3(-1e7f), glm::vec3(1e7f)};
    auto const cascades =
        fit_cascades(view, directional(glm::vec3(0.3f, -1.0f, 0.2f)), world, world, CascadeOptions<float>{});
    EXPECT_TRUE(cascades.faults.has(Fault::precision_lost));
    EXPECT_TRUE(laws::well_formed(cascades));
}

}  // namespace
