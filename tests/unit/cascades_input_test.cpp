// SPDX-License-Identifier: MIT
//
// Where ranges of options end, and what is done with what lies outside them. The maps: cascades_test.cpp.
#include "tests/laws/cascades.hpp"
#include "tests/support/cascades_of.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <utility>

using namespace shadowmath;
using namespace shadowmath::test;

namespace {

using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(CascadesOf, Scalars);

TYPED_TEST(CascadesOf, NothingFollowsTheShadowDistance) {
    this->options.shadow_distance = TypeParam(120);
    auto const cascades = this->fitted();
    EXPECT_EQ(cascades.at[cascades.count - 1].range.end, TypeParam(120));
    EXPECT_FALSE(cascades.faults.any());
}

TYPED_TEST(CascadesOf, AShadowDistanceMayBeLessThanAMetre) {
    this->options.shadow_distance = TypeParam(0.5);
    auto const cascades = this->fitted();
    EXPECT_EQ(cascades.at[cascades.count - 1].range.end, TypeParam(0.5));
}

TYPED_TEST(CascadesOf, AShadowDistanceThatIsNoneLeavesTheViewsOwnEnd) {
    using T = TypeParam;
    for (T const bad : {T(-1), std::numeric_limits<T>::quiet_NaN(), std::numeric_limits<T>::infinity()}) {
        this->options.shadow_distance = bad;
        auto const cascades = this->fitted();
        EXPECT_TRUE(cascades.faults.has(Fault::clamped_option)) << bad;
        EXPECT_EQ(cascades.at[cascades.count - 1].range.end, this->view.z_far) << bad;
    }
}

TYPED_TEST(CascadesOf, AShadowDistanceThatEndsWhereTheViewBeginsIsAnEmptyRange) {
    for (TypeParam const part : {TypeParam(0.5), TypeParam(1)}) {
        this->options.shadow_distance = this->view.z_near * part;
        EXPECT_TRUE(this->fitted().faults.has(Fault::empty_range));
        EXPECT_EQ(this->fitted().count, 0);
    }
}

TYPED_TEST(CascadesOf, AnEndlessViewNeedsAShadowDistance) {
    this->view.z_far = std::numeric_limits<TypeParam>::infinity();
    auto const cut = this->fitted();
    EXPECT_TRUE(cut.faults.has(Fault::far_clamped));
    EXPECT_EQ(cut.at[cut.count - 1].range.end, TypeParam(1000));
    this->options.shadow_distance = TypeParam(250);
    auto const given = this->fitted();
    EXPECT_FALSE(given.faults.any());
    EXPECT_EQ(given.at[given.count - 1].range.end, TypeParam(250));
}

TYPED_TEST(CascadesOf, AnEndlessViewOfALargeUnitEndsAtTenThousandNearDistances) {
    this->view.z_near = TypeParam(20);
    this->view.z_far = std::numeric_limits<TypeParam>::infinity();
    auto const cut = this->fitted();
    EXPECT_EQ(cut.at[cut.count - 1].range.end, TypeParam(20) * TypeParam(1e4));
}

TYPED_TEST(CascadesOf, AKernelOfNegativeRadiusIsOneOfNone) {
    this->options.filter_radius = 0;
    auto const none = this->fitted();
    this->options.filter_radius = -3;
    auto const negative = this->fitted();
    EXPECT_TRUE(negative.faults.has(Fault::clamped_option));
    EXPECT_EQ(negative.at[0].map.clip_from_world, none.at[0].map.clip_from_world);
}

TYPED_TEST(CascadesOf, AKernelWiderThanAQuarterOfTheMapOrThan64TexelsIsOfThatWidth) {
    auto const with = [this](int map_size, int radius) {
        this->options.map_size = map_size;
        this->options.filter_radius = radius;
        return this->fitted();
    };
    for (auto const& [size, most] : {std::pair{32, 8}, std::pair{1024, 64}}) {
        auto const widest = with(size, most), wider = with(size, most + 1);
        EXPECT_FALSE(widest.faults.any());
        EXPECT_TRUE(wider.faults.has(Fault::clamped_option));
        EXPECT_EQ(wider.at[0].map.clip_from_world, widest.at[0].map.clip_from_world);
    }
}

TYPED_TEST(CascadesOf, BoxesThatAreNotFiniteAreNamedEachAlone) {
    Aabb<TypeParam> endless = this->world;
    endless.hi.y = std::numeric_limits<TypeParam>::infinity();
    for (bool const casters : {true, false}) {
        auto const cascades = fit_cascades(this->view, this->sun, casters ? endless : this->world,
                                           casters ? this->world : endless, this->options);
        EXPECT_TRUE(cascades.faults.has(Fault::not_finite)) << casters;
        EXPECT_EQ(cascades.count, 0) << casters;
    }
}

TYPED_TEST(CascadesOf, NoCastersOrNoReceiversIsNoFault) {
    for (bool const casters : {true, false}) {
        Aabb<TypeParam> const empty;
        auto const cascades = fit_cascades(this->view, this->sun, casters ? empty : this->world,
                                           casters ? this->world : empty, this->options);
        EXPECT_FALSE(cascades.faults.any());
        for (auto const& c : cascades) {
            EXPECT_FALSE(c.map.visible);
            EXPECT_TRUE(laws::harmless(c.map));
        }
    }
}

TYPED_TEST(CascadesOf, CountsOutsideTheCapacityAreClamped) {
    this->options.count = 0;
    EXPECT_EQ(this->fitted().count, 0);
    EXPECT_FALSE(this->fitted().faults.any());
    this->options.count = 1;
    EXPECT_EQ(this->fitted().count, 1);
    EXPECT_EQ(this->fitted().at[0].range.end, this->view.z_far);
    this->options.count = 1000;
    EXPECT_EQ(this->fitted().count, max_splits);
    EXPECT_TRUE(this->fitted().faults.has(Fault::count_clamped));
    this->options.fit = CascadeFit::warped;
    for (auto const& c : this->fitted()) EXPECT_TRUE(c.map.visible);
    this->options.count = -3;
    EXPECT_EQ(this->fitted().count, 0);
    EXPECT_TRUE(this->fitted().faults.has(Fault::count_clamped));
}

TYPED_TEST(CascadesOf, MapsWithoutRoomForTheFilterAreRefused) {
    for (int const size : {-5, 0, 1, 4}) {
        this->options.map_size = size;
        auto const cascades = this->fitted();
        EXPECT_TRUE(cascades.faults.has(Fault::map_too_small)) << size;
        EXPECT_EQ(cascades.count, 0) << size;
        for (auto const& c : cascades) EXPECT_FALSE(c.map.visible) << size;
    }
    this->options.map_size = 1000;  // no power of two
    EXPECT_FALSE(this->fitted().faults.any());
}

TYPED_TEST(CascadesOf, OptionsOutsideTheirRangesAreClampedAndSaid) {
    using T = TypeParam;
    for (T const bad : {T(-1), T(7), std::numeric_limits<T>::quiet_NaN(), std::numeric_limits<T>::infinity()}) {
        for (T CascadeOptions<T>::*option : {&CascadeOptions<T>::lambda, &CascadeOptions<T>::blend}) {
            CascadeOptions<T> wrong;
            wrong.*option = bad;
            auto const cascades = fit_cascades(this->view, this->sun, this->world, this->world, wrong);
            EXPECT_TRUE(cascades.faults.has(Fault::clamped_option));
            EXPECT_TRUE(laws::well_formed(cascades));
            EXPECT_TRUE(cascades.count == 4 && cascades.at[0].map.visible);
        }
    }
    this->options.filter_radius = 1000000000;
    EXPECT_TRUE(this->fitted().faults.has(Fault::clamped_option));
    EXPECT_TRUE(this->fitted().at[0].map.visible);
}

TYPED_TEST(CascadesOf, ABlendOutsideItsRangeIsTheNearestOne) {
    using T = TypeParam;
    auto const with = [this](T blend) {
        this->options.blend = blend;
        return this->fitted();
    };
    auto const whole = with(T(1)), none = with(T(0));
    EXPECT_FALSE(whole.faults.any()) << "from end to end is a blend too";
    EXPECT_FALSE(none.faults.any()) << "and so is none";
    EXPECT_EQ(whole.at[1].range.blend_begin, whole.at[0].range.end);
    EXPECT_EQ(none.at[1].range.blend_begin, none.at[1].range.end);
    EXPECT_EQ(with(T(7)).at[1].range.blend_begin, whole.at[1].range.blend_begin);
    EXPECT_EQ(with(T(-1)).at[1].range.blend_begin, none.at[1].range.blend_begin);
}

TYPED_TEST(CascadesOf, AMessyPoseWithinAThousandthIsMended) {
    using T = TypeParam;
    auto const clean = this->fitted();
    this->view.pose.right *= T(1.0003);
    this->view.pose.up += this->view.pose.forward * T(2e-4);
    auto const mended = this->fitted();
    EXPECT_FALSE(mended.faults.any());
    EXPECT_TRUE(laws::is_map_of(mended.at[0].map.clip_from_world, this->sun, this->options.clip));
    EXPECT_EQ(mended.at[0].texel_metres, clean.at[0].texel_metres);
    this->view.pose.right *= T(2);
    EXPECT_TRUE(this->fitted().faults.has(Fault::bad_pose));
    EXPECT_EQ(this->fitted().count, 0);
}

}  // namespace
