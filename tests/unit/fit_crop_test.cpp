// SPDX-License-Identifier: MIT
#include "tests/laws/fit_crop.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;

template <class T>
class FitCrop : public ::testing::Test {
public:
    // A lamp 10 m above the floor, shining straight down, and an eye that looks at the floor from the side.
    Light<T> lamp = spot(Vec3<T>(0, 10, 0), Vec3<T>(0, -1, 0), T(0.7), T(20));
    ViewVolume<T> view = perspective_view(pose_looking(Vec3<T>(0, 3, 8), Vec3<T>(0, T(-0.5), -1), Vec3<T>(0, 1, 0)),
                                          T(1), T(1.5), T(0.1), T(100));
    Aabb<T> floor{Vec3<T>(-50, -1, -50), Vec3<T>(50, 0, 50)};
    Aabb<T> crate{Vec3<T>(-1, 0, -1), Vec3<T>(1, 2, 1)};

    ShadowMap<T> fit(Aabb<T> const& casters, Aabb<T> const& receivers, ClipSpace clip = {}) const {
        return fit_spot(view, lamp, casters, receivers, 1024, T(2), clip);
    }
};
using Scalars = ::testing::Types<float, double, long double>;
TYPED_TEST_SUITE(FitCrop, Scalars);

TYPED_TEST(FitCrop, OfTheWholeVolumeIsTheIdentity) {
    using T = TypeParam;
    EXPECT_EQ(crop_matrix(Aabb<T>{Vec3<T>(-1, -1, 0), Vec3<T>(1)}), Mat4<T>(T(1)));
}

TYPED_TEST(FitCrop, OfABoxHasThePrintedScalesAndOffsets) {
    using T = TypeParam;
    // Chapter 10, eq. 5: S = 2 / (max - min), O = -(max + min) / (max - min); depth 1 / (max - min), -min S.
    Mat4<T> const crop = crop_matrix(Aabb<T>{Vec3<T>(T(-0.5), T(0), T(0.25)), Vec3<T>(T(0.5), T(0.5), T(0.75))});
    EXPECT_EQ(row(crop, 0), Vec4<T>(2, 0, 0, 0));
    EXPECT_EQ(row(crop, 1), Vec4<T>(0, 4, 0, -1));
    EXPECT_EQ(row(crop, 2), Vec4<T>(0, 0, 2, T(-0.5)));
    EXPECT_EQ(row(crop, 3), Vec4<T>(0, 0, 0, 1));
}

TYPED_TEST(FitCrop, OfNothingShowsNothing) {
    using T = TypeParam;
    T const nan = std::numeric_limits<T>::quiet_NaN(), huge = std::numeric_limits<T>::max();
    EXPECT_EQ(crop_matrix(Aabb<T>{}), nowhere<T>());
    EXPECT_EQ(crop_matrix(Aabb<T>{Vec3<T>(nan), Vec3<T>(1)}), nowhere<T>());
    EXPECT_EQ(crop_matrix(Aabb<T>{Vec3<T>(-huge), Vec3<T>(huge)}), nowhere<T>());
    for (T const at : {T(0.3), T(0)}) EXPECT_TRUE(laws::finite(crop_matrix(Aabb<T>{Vec3<T>(at), Vec3<T>(at)}))) << at;
}

TYPED_TEST(FitCrop, SceneIndependentBoxStartsAtTheLight) {
    using T = TypeParam;
    auto const box =
        scene_independent_box(Aabb<T>{Vec3<T>(T(-0.5), T(-0.25), T(0.4)), Vec3<T>(T(0.5), T(0.25), T(0.6))});
    EXPECT_EQ(box.lo, Vec3<T>(T(-0.5), T(-0.25), T(0)));
    EXPECT_EQ(box.hi, Vec3<T>(T(0.5), T(0.25), T(0.6)));
}

TYPED_TEST(FitCrop, SceneDependentBoxIsWhereCastersAndReceiversShareRays) {
    using T = TypeParam;
    Aabb<T> const split{Vec3<T>(T(-0.5), T(-0.5), T(0.4)), Vec3<T>(T(0.5), T(0.5), T(0.9))};
    Aabb<T> const receivers{Vec3<T>(T(-0.5), T(-0.5), T(0.6)), Vec3<T>(T(0.25), T(0.5), T(0.7))};
    Aabb<T> const casters{Vec3<T>(T(-0.125), T(-1), T(0.1)), Vec3<T>(T(1), T(0.25), T(0.8))};
    auto const box = scene_dependent_box(split, receivers, casters);
    EXPECT_EQ(box.lo, Vec3<T>(T(-0.125), T(-0.5), T(0.1)));
    EXPECT_EQ(box.hi, Vec3<T>(T(0.25), T(0.25), T(0.7)));
    Aabb<T> const beside{Vec3<T>(T(0.6), T(-1), T(0.1)), Vec3<T>(T(1), T(1), T(0.8))};
    for (Aabb<T> const& none : {beside, Aabb<T>{}}) {
        EXPECT_EQ(scene_dependent_box(split, receivers, none).lo, split.lo);
        EXPECT_EQ(scene_dependent_box(split, receivers, none).hi, split.hi);
    }
}

// The sun's case: the split's box in the NDC of one common light projection.
TYPED_TEST(FitCrop, CropsACommonSunProjectionToASplit) {
    using T = TypeParam;
    Light<T> const sun = directional(Vec3<T>(T(0.2), T(-1), T(0.3)));
    Mat4<T> const common = clip_from_world(fit_box(light_basis(sun.direction), corners(this->floor), 1024, T(0)), {});
    ViewVolume<T> split = this->view;
    split.z_far = T(20);
    Aabb<T> const box = scene_independent_box(projected_bounds(common, corners(split), T(0)));
    Mat4<T> const map = crop_matrix(box) * common;
    EXPECT_TRUE(laws::is_map_of(map, sun, {}));
    for (Vec3<T> const& corner : corners(split))
        EXPECT_TRUE(laws::holds(map, {}, corner, T(-1e3) * std::numeric_limits<T>::epsilon()));
}

TYPED_TEST(FitCrop, TheWholeConeIsAPyramidFromTheNearPlaneToTheRange) {
    using T = TypeParam;
    for (ClipSpace const clip : {gl_clip, vulkan_clip, d3d_clip, reversed(vulkan_clip)}) {
        Mat4<T> const map = spot_clip_from_world(this->lamp, T(0.5), clip);
        EXPECT_TRUE(laws::is_map_of(map, this->lamp, clip));
        auto const at = [&](Vec3<T> const& world) {
            auto const p = canonical_from_clip<long double>(clip) * laws::image_of(map, Vec4<T>(world, T(1)));
            return Vec3<long double>(p) / p.w;
        };
        double const rounding = 256 * double(std::numeric_limits<T>::epsilon());
        EXPECT_NEAR(double(at(Vec3<T>(0, T(9.5), 0)).z), 0, rounding);
        EXPECT_NEAR(double(at(Vec3<T>(0, -10, 0)).z), 1, rounding);
        EXPECT_NEAR(double(at(Vec3<T>(std::tan(T(0.7)) * T(10), 0, 0)).x), 1, rounding);
        EXPECT_NEAR(double(at(Vec3<T>(0, 0, -std::tan(T(0.7)) * T(10))).y), 1, rounding);
    }
    EXPECT_EQ(spot_clip_from_world(directional(Vec3<T>(0, -1, 0)), T(1), gl_clip), nowhere<T>());
    for (T const z_near : {T(0), T(-1), T(1e30L), std::numeric_limits<T>::max()})
        EXPECT_TRUE(laws::finite(spot_clip_from_world(this->lamp, z_near, gl_clip)));
    T const nan = std::numeric_limits<T>::quiet_NaN();
    EXPECT_EQ(spot_clip_from_world(this->lamp, nan, gl_clip), nowhere<T>());
}

TYPED_TEST(FitCrop, ASpotsNearPlaneLiesBetweenAMillionthAndHalfOfItsRange) {
    using T = TypeParam;
    EXPECT_EQ(spot_view(this->lamp, T(19)).z_near, T(10));
    EXPECT_EQ(spot_view(this->lamp, T(0)).z_near, T(20) / T(1 << 20));
    EXPECT_EQ(spot_view(this->lamp, T(3)).z_near, T(3));
}

TYPED_TEST(FitCrop, AConeBeyondReachIsNowhereByItsPlaceOrItsRangeAlone) {
    using T = TypeParam;
    Light<T> far_out = this->lamp, endless = this->lamp;
    far_out.position.x = T(1e19);
    endless.range = T(1e18);
    EXPECT_EQ(spot_clip_from_world(far_out, T(1), gl_clip), nowhere<T>());
    EXPECT_EQ(spot_clip_from_world(endless, T(1), gl_clip), nowhere<T>());
}

TYPED_TEST(FitCrop, AnEndlessViewSeesAWideConeToItsRim) {
    using T = TypeParam;
    this->lamp.half_angle_radians = T(1.4);
    this->view.z_far = std::numeric_limits<T>::infinity();
    ShadowMap<T> const map = this->fit(this->crate, this->floor);
    ASSERT_TRUE(map.visible);
    // 10 m below the lamp the light reaches 58 m out.
    EXPECT_TRUE(laws::serves(map, 1024, T(2), Vec3<T>(0, 0, -49), T(1e-3)));
}

TYPED_TEST(FitCrop, ASpotStartsAtItsFirstCasterAndEndsAtItsLastReceiver) {
    using T = TypeParam;
    auto const map = this->fit(this->crate, this->floor);
    ASSERT_TRUE(map.visible);
    EXPECT_FALSE(map.faults.any());
    // The crate's top is 8 m below the lamp, the floor's bottom 11 m; a thousandth is added at both ends.
    EXPECT_NEAR(double(map.w_min), 8 * (1 - 1 / 1024.0), 1e-4);
    auto const depth = [&](T height) {
        auto const p = laws::image_of(map.clip_from_world, Vec4<T>(0, height, 0, 1));
        return double(p.z / p.w);
    };
    EXPECT_NEAR(depth(T(10 - 8 * (1 - 1 / 1024.0))), 0, 1e-4);
    EXPECT_NEAR(depth(T(10 - 11 * (1 + 1 / 1024.0))), 1, 1e-4);
}

TYPED_TEST(FitCrop, ASpotZoomsInOnWhatIsSeen) {
    using T = TypeParam;
    auto const scale = [](Mat4<T> const& m) { return glm::length(Vec3<long double>(Vec4<long double>(row(m, 0)))); };
    auto const whole = scale(spot_clip_from_world(this->lamp, T(8), ClipSpace{}));
    EXPECT_GE(scale(this->fit(this->crate, this->floor).clip_from_world), 0.95 * whole);
    Aabb<T> const tile{Vec3<T>(T(-0.5), -1, T(-0.5)), Vec3<T>(T(0.5), 0, T(0.5))};
    // 1 m of 2 * 10 * tan 0.7 = 16.8 m.
    EXPECT_GE(scale(this->fit(this->crate, tile).clip_from_world), 16 * whole);
    EXPECT_TRUE(this->fit(this->crate, tile).visible);
}

TYPED_TEST(FitCrop, ASpotZoomsInUntilTheConeWouldBeAMapSizeOfMapsWide) {
    using T = TypeParam;
    auto const scale = [](Mat4<T> const& m) { return double(glm::length(Vec3<T>(row(m, 0)))); };
    Aabb<T> const point{Vec3<T>(0), Vec3<T>(0)};
    double const usable = double(usable_texels(1024, T(2)));
    double const whole = scale(spot_clip_from_world(this->lamp, T(8), ClipSpace{}));
    EXPECT_NEAR(scale(this->fit(this->crate, point).clip_from_world) / whole, usable, 1);
}

TYPED_TEST(FitCrop, ASliceSmallerThanAMetreIsServed) {
    using T = TypeParam;
    this->view = perspective_view(pose_looking(Vec3<T>(0, T(0.3), 0), Vec3<T>(0, -1, 0), Vec3<T>(0, 0, 1)), T(0.5),
                                  T(1), T(0.1), T(0.5));
    auto const map = this->fit(this->crate, this->floor);
    EXPECT_TRUE(map.visible);
    EXPECT_TRUE(laws::serves(map, 1024, T(2), Vec3<T>(0), T(1e-3)));
}

TYPED_TEST(FitCrop, ReceiversNearerThanALampCastsAreInTheDark) {
    using T = TypeParam;
    // Nearer than 1/4096 of the range nothing casts.
    Aabb<T> const fly{Vec3<T>(T(-0.001), T(10) - T(0.004), T(-0.001)), Vec3<T>(T(0.001), T(10) - T(0.002), T(0.001))};
    this->view.pose = pose_looking(Vec3<T>(0, 10, 8), Vec3<T>(0, 0, -1), Vec3<T>(0, 1, 0));
    EXPECT_FALSE(this->fit(this->crate, fly).visible);
}

TYPED_TEST(FitCrop, CastersInTheConeButBesideWhatIsSeenNeedNoMap) {
    using T = TypeParam;
    Aabb<T> const tile{Vec3<T>(-4, T(-0.1), -1), Vec3<T>(-3, 0, 1)}, beside{Vec3<T>(3, 1, -1), Vec3<T>(4, 2, 1)};
    auto const map = this->fit(beside, tile);
    EXPECT_FALSE(map.visible);
    EXPECT_FALSE(map.faults.any());
    EXPECT_TRUE(this->fit({Vec3<T>(-4, 1, -1), Vec3<T>(-3, 2, 1)}, tile).visible);
}

TYPED_TEST(FitCrop, AConeThatEndsAtTheFarthestOrTheLeastDistanceIsWithinReach) {
    using T = TypeParam;
    for (T const range : {detail::farthest_metres<T> / T(20), detail::least_metres<T>}) {
        Light<T> const light = spot(Vec3<T>(0), Vec3<T>(0, -1, 0), T(0.7), range);
        EXPECT_NE(spot_clip_from_world(light, range / T(2), gl_clip), nowhere<T>());
    }
}

TYPED_TEST(FitCrop, ASpotServesEveryReceiverInEveryConvention) {
    using T = TypeParam;
    int served = 0;
    for (ClipSpace const clip : {gl_clip, gl_zero_to_one_clip, vulkan_clip, d3d_clip, reversed(vulkan_clip)}) {
        auto const map = this->fit(this->crate, this->floor, clip);
        EXPECT_TRUE(laws::is_map_of(map.clip_from_world, this->lamp, clip));
        for (int i = 0; i < 40; ++i)
            for (int j = 0; j < 40; ++j) {
                Vec3<T> const point(T(i) / T(2) - T(10), T(0), T(j) / T(2) - T(10));
                if (!laws::is_seen_and_lit(this->view, this->lamp, point)) continue;
                ++served;
                EXPECT_TRUE(laws::serves(map, 1024, T(2), point, T(512) * std::numeric_limits<T>::epsilon()));
            }
    }
    EXPECT_GT(served, 1000);
}

TYPED_TEST(FitCrop, ASpotLeavesTheFilterItsMarginAroundTheReceivers) {
    using T = TypeParam;
    Aabb<T> const tile{Vec3<T>(T(-0.5), T(-0.1), T(-0.5)), Vec3<T>(T(0.5), 0, T(0.5))};
    for (T const margin : {T(2), T(40)}) {
        auto const map = fit_spot(this->view, this->lamp, this->crate, tile, 256, margin, gl_clip);
        ASSERT_TRUE(map.visible);
        for (Vec3<T> const& corner : corners(tile)) {
            EXPECT_TRUE(laws::is_seen_and_lit(this->view, this->lamp, corner));
            EXPECT_TRUE(laws::serves(map, 256, margin, corner, T(4096) * std::numeric_limits<T>::epsilon()));
        }
    }
}

TYPED_TEST(FitCrop, AnEndlessViewEndsWhereTheLightDoes) {
    using T = TypeParam;
    this->view.z_far = std::numeric_limits<T>::infinity();
    auto const map = this->fit(this->crate, this->floor);
    EXPECT_TRUE(map.visible);
    EXPECT_FALSE(map.faults.any());
    EXPECT_TRUE(laws::harmless(map));
}

TYPED_TEST(FitCrop, BoxesWithoutAnEndAreServed) {
    using T = TypeParam;
    T const huge = std::numeric_limits<T>::max();
    Aabb<T> const everything{Vec3<T>(-huge), Vec3<T>(huge)};
    auto const map = this->fit(everything, everything);
    EXPECT_TRUE(map.visible);
    EXPECT_TRUE(laws::is_map_of(map.clip_from_world, this->lamp, {}));
    EXPECT_TRUE(laws::serves(map, 1024, T(2), Vec3<T>(0, 0, 0), T(1e-3)));
}

TYPED_TEST(FitCrop, ASpotThatServesNothingIsNotVisible) {
    using T = TypeParam;
    T const nan = std::numeric_limits<T>::quiet_NaN();
    auto const nothing = [this](Faults faults, Aabb<T> const& casters, Aabb<T> const& receivers, int size = 1024) {
        auto const map = fit_spot(this->view, this->lamp, casters, receivers, size, T(2), gl_clip);
        return !map.visible && map.faults == faults && laws::harmless(map);
    };
    EXPECT_TRUE(nothing({}, {}, this->floor));
    EXPECT_TRUE(nothing({}, this->crate, {}));
    EXPECT_TRUE(nothing({}, Aabb<T>{Vec3<T>(40), Vec3<T>(41)}, this->floor));
    EXPECT_TRUE(nothing({}, this->crate, Aabb<T>{Vec3<T>(40), Vec3<T>(41)}));
    EXPECT_TRUE(nothing({}, Aabb<T>{Vec3<T>(-1, -9, -1), Vec3<T>(1, -8, 1)}, this->floor));
    EXPECT_TRUE(nothing(Fault::not_finite, Aabb<T>{Vec3<T>(nan), Vec3<T>(1)}, this->floor));
    EXPECT_TRUE(nothing(Fault::map_too_small, this->crate, this->floor, 6));
    this->view.z_near = T(-1);
    EXPECT_TRUE(nothing(Fault::empty_range, this->crate, this->floor));
    this->view.z_near = T(0.1);
    this->view.pose.position.x = nan;
    EXPECT_TRUE(nothing(Fault::not_finite, this->crate, this->floor));
    this->view.pose = pose_looking(Vec3<T>(0, 3, 8), Vec3<T>(0, 0, 1), Vec3<T>(0, 1, 0));
    EXPECT_TRUE(nothing({}, this->crate, this->floor));
    this->lamp = directional(Vec3<T>(0, -1, 0));
    EXPECT_TRUE(nothing(Fault::clamped_option, this->crate, this->floor));
    this->lamp = spot(Vec3<T>(0, 10, 0), Vec3<T>(0, -1, 0), T(0.7), T(0));
    EXPECT_TRUE(nothing(Fault::empty_range, this->crate, this->floor));
    this->lamp = spot(Vec3<T>(0, 10, 0), Vec3<T>(0, 0, 0), T(0.7), T(20));
    EXPECT_TRUE(nothing(Fault::zero_light, this->crate, this->floor));
}

TYPED_TEST(FitCrop, AnglesOutOfRangeAreClampedAndServed) {
    using T = TypeParam;
    for (T const angle : {T(0), T(-1), T(1.5707963L), T(3), T(100)}) {
        this->lamp = spot(Vec3<T>(0, 10, 0), Vec3<T>(0, -1, 0), angle, T(20));
        auto const map = this->fit(this->crate, this->floor);
        EXPECT_EQ(map.faults, Faults(Fault::cone_clamped)) << double(angle);
        EXPECT_TRUE(map.visible);
        EXPECT_TRUE(laws::is_map_of(map.clip_from_world, this->lamp, {}));
    }
}

TYPED_TEST(FitCrop, ALightInsideACasterKeepsItsNearPlane) {
    using T = TypeParam;
    auto const map = this->fit({Vec3<T>(-5, -5, -5), Vec3<T>(5, 15, 5)}, this->floor);
    EXPECT_TRUE(map.visible);
    EXPECT_NEAR(double(map.w_min), 20.0 / 4096, 1e-4);
    EXPECT_TRUE(laws::is_map_of(map.clip_from_world, this->lamp, {}));
}
