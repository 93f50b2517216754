// SPDX-License-Identifier: MIT
#include "tests/laws/slice_warps.hpp"
#include "tests/support/watched.hpp"

#include <shadowmath/cascades.hpp>

#include <gtest/gtest.h>

using namespace shadowmath;

namespace {

template <class T>
struct SliceWarps : ::testing::Test {
    Light<T> const sun = directional(Vec3<T>(T(0.4), T(-0.8), T(0.3)));
    ViewVolume<T> view = perspective_view(
        pose_looking(Vec3<T>(T(3), T(2), T(10)), Vec3<T>(T(0.3), T(-0.1), T(-1)), Vec3<T>(T(0), T(1), T(0))), T(1),
        T(1.6), T(0.1), T(200));
    Aabb<T> const town{Vec3<T>(T(-120), T(0), T(-120)), Vec3<T>(T(120), T(30), T(120))};
    Splits<T> const splits = practical_splits(T(0.1), T(200), 6);
    WarpOptions<T> options;
    ShadowMap<T> maps[max_splits];

    unsigned fitted(Aabb<T> const& casters, ClipSpace clip = gl_clip) {
        return fit_slice_warps(view, sun, splits, T(0.1), casters, town, options, clip, maps);
    }
    ShadowMap<T> twin(int i, Light<T> const& light, ClipSpace clip = gl_clip) const {
        return simple_perspective_map(slice(view, slice_range(splits, i, T(0.1))), light, town, town, options, clip);
    }
};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(SliceWarps, Scalars);

// To a part of the largest entry of a row.
template <class T>
T apart(Mat4<T> const& a, Mat4<T> const& b) {
    T worst = T(0);
    for (int r = 0; r < 4; ++r) {
        T const size = glm::length(row(b, r));
        worst = std::max(worst, glm::length(row(a, r) - row(b, r)) / size);
    }
    return worst;
}

}  // namespace

TYPED_TEST(SliceWarps, AreTheirTwinsInEveryConvention) {
    using T = TypeParam;
    for (T const strength : {T(0), T(0.5), T(1), T(1.5), T(2)})
        for (ClipSpace const clip : {gl_clip, vulkan_clip, d3d_clip, reversed(d3d_clip), reversed(vulkan_clip)}) {
            this->options.strength = strength;
            auto const made = test::watched([&] { return this->fitted(this->town, clip); });
            EXPECT_TRUE(made.calm_in_range());
            EXPECT_EQ(made.result, 0x3fu);
            for (int i = 0; i < 6; ++i) {
                ShadowMap<T> const twin = this->twin(i, this->sun, clip);
                // Planes are 16 epsilon of 800 m farther out and bounds as much again, of a first slice that begins
                // 0.1 m from the eye.
                EXPECT_LT(apart(this->maps[i].clip_from_world, twin.clip_from_world),
                          T(2 * 16 * 800 / 0.1) * std::numeric_limits<T>::epsilon())
                    << i;
                EXPECT_EQ(this->maps[i].faults.bits, twin.faults.bits);
                EXPECT_EQ(this->maps[i].w_min, twin.w_min);
                EXPECT_EQ(this->maps[i].clip.depth, clip.depth);
            }
        }
}

TYPED_TEST(SliceWarps, AreWhatFitCascadesGives) {
    using T = TypeParam;
    CascadeOptions<T> cascading;
    cascading.count = 6;
    cascading.map_size = this->options.map_size;
    cascading.fit = CascadeFit::warped;
    cascading.steady_maps = 1;
    auto const cascades = fit_cascades(this->view, this->sun, this->town, this->town, cascading);
    EXPECT_EQ(this->fitted(this->town), 0x3fu);
    for (int i = 1; i < 6; ++i) {
        EXPECT_TRUE(cascades.at[i].map.visible);
        EXPECT_LT(apart(cascades.at[i].map.clip_from_world, this->maps[i].clip_from_world),
                  T(1e4) * std::numeric_limits<T>::epsilon());
    }
    EXPECT_EQ(glm::length(Vec3<T>(row(cascades.at[0].map.clip_from_world, 3))), T(0));
}

TYPED_TEST(SliceWarps, OfCastersThatTheLightHasPassedAreNotVisible) {
    using T = TypeParam;
    Aabb<T> const below{Vec3<T>(T(-120), T(-200), T(-120)), Vec3<T>(T(120), T(-150), T(120))};
    EXPECT_EQ(this->fitted(below), 0u);
    for (int i = 0; i < 6; ++i) EXPECT_EQ(this->maps[i].clip_from_world, nowhere<T>());
    Aabb<T> const aside{Vec3<T>(T(5000), T(0), T(0)), Vec3<T>(T(5100), T(50), T(100))};
    EXPECT_EQ(this->fitted(aside), 0u);
    EXPECT_EQ(this->fitted(Aabb<T>{}), 0u);
}

// A tower far up the light: depth begins at it, and no sooner.
TYPED_TEST(SliceWarps, BeginAtTheFirstCasterOnTheirLight) {
    using T = TypeParam;
    for (T const distance : {T(10), T(100), T(1000)}) {
        Vec3<T> const seen = point_at(this->view, T(0), T(-0.1), T(20)), up = seen - this->sun.direction * distance;
        Aabb<T> const tower = {up - Vec3<T>(T(1)), up + Vec3<T>(T(1))};
        unsigned const visible = this->fitted(tower);
        int serving = 0;
        for (int i = 0; i < 6; ++i) {
            if ((visible >> i & 1u) == 0) continue;
            ShadowMap<T> const twin = simple_perspective_map(slice(this->view, slice_range(this->splits, i, T(0.1))),
                                                             this->sun, tower, this->town, this->options, gl_clip);
            ++serving;
            Vec4<T> const ours = this->maps[i].clip_from_world * Vec4<T>(up, T(1));
            Vec4<T> const theirs = twin.clip_from_world * Vec4<T>(up, T(1));
            EXPECT_NEAR(ours.z / ours.w, theirs.z / theirs.w, T(2e-3)) << distance << ' ' << i;
        }
        EXPECT_GE(serving, 1) << distance;
        EXPECT_LT(serving, 6) << distance;
    }
}

TYPED_TEST(SliceWarps, AreMadeOneByOneWhereLanesHaveNoRuleForThem) {
    using T = TypeParam;
    for (WarpRule const rule : {WarpRule::trapezoid, WarpRule::extended}) {
        this->options.rule = rule;
        EXPECT_EQ(this->fitted(this->town), 0x3fu);
        for (int i = 0; i < 6; ++i) EXPECT_EQ(this->maps[i].clip_from_world, this->twin(i, this->sun).clip_from_world);
    }
    this->options.rule = WarpRule::by_strength;
    Light<T> const lamp = spot(Vec3<T>(T(0), T(40), T(-20)), Vec3<T>(T(0), T(-1), T(0.1)), T(0.8), T(100));
    unsigned const visible = fit_slice_warps(this->view, lamp, this->splits, T(0.1), this->town, this->town,
                                             this->options, gl_clip, this->maps);
    EXPECT_NE(visible, 0u);
    for (int i = 0; i < 6; ++i) EXPECT_EQ(this->maps[i].clip_from_world, this->twin(i, lamp).clip_from_world);
}

TYPED_TEST(SliceWarps, AreMadeOneByOneWhereTheViewReachesBeyond1e12) {
    using T = TypeParam;
    this->view.z_near = T(1e9), this->view.z_far = T(3e11);
    Aabb<T> const world{Vec3<T>(T(-4e11)), Vec3<T>(T(4e11))};
    Splits<T> const distant = practical_splits(this->view.z_near, this->view.z_far, 6);
    EXPECT_EQ(fit_slice_warps(this->view, this->sun, distant, T(0.1), world, world, this->options, gl_clip, this->maps),
              0x3fu);
    for (int i = 0; i < 6; ++i) {
        ShadowMap<T> const twin = simple_perspective_map(slice(this->view, slice_range(distant, i, T(0.1))), this->sun,
                                                         world, world, this->options, gl_clip);
        EXPECT_EQ(this->maps[i].clip_from_world, twin.clip_from_world) << i;
        EXPECT_EQ(this->maps[i].faults.bits, twin.faults.bits) << i;
    }
}

// What only the other rules ask for must be a number all the same, as for the map of one slice.
TYPED_TEST(SliceWarps, AreWhatTheirTwinsAreOfOptionsThatAreNoNumbers) {
    using T = TypeParam;
    constexpr T nan = std::numeric_limits<T>::quiet_NaN();
    WarpOptions<T> const good = this->options;
    for (T WarpOptions<T>::*spoilt :
         {&WarpOptions<T>::strength, &WarpOptions<T>::focus_metres, &WarpOptions<T>::coefficient}) {
        this->options = good;
        this->options.*spoilt = nan;
        unsigned const visible = this->fitted(this->town);
        for (int i = 0; i < 6; ++i) {
            ShadowMap<T> const twin = this->twin(i, this->sun);
            EXPECT_EQ((visible >> i & 1u) != 0, twin.visible);
            EXPECT_EQ(this->maps[i].clip_from_world, twin.clip_from_world);
            EXPECT_EQ(this->maps[i].faults.bits, twin.faults.bits);
        }
    }
}

TYPED_TEST(SliceWarps, OfMoreSplitsThanThereIsRoomForWriteNothing) {
    using T = TypeParam;
    Splits<T> many;
    many.count = max_splits + 1;
    ShadowMap<T> const before;
    this->maps[0].faults = Fault::bad_region;
    EXPECT_EQ(
        fit_slice_warps(this->view, this->sun, many, T(0), this->town, this->town, this->options, gl_clip, this->maps),
        0u);
    EXPECT_EQ(this->maps[0].faults.bits, Faults(Fault::bad_region).bits);
    EXPECT_EQ(this->maps[1].faults.bits, before.faults.bits);
}

TYPED_TEST(SliceWarps, OfAMarginBelowNothingHaveNone) {
    using T = TypeParam;
    for (T const margin : {T(0), T(-3)}) {
        this->options.margin_texels = margin;
        EXPECT_EQ(this->fitted(this->town), 0x3fu);
        for (int i = 0; i < 6; ++i) {
            ShadowMap<T> const twin = this->twin(i, this->sun);
            EXPECT_LT(apart(this->maps[i].clip_from_world, twin.clip_from_world),
                      T(2 * 16 * 800 / 0.1) * std::numeric_limits<T>::epsilon());
            EXPECT_EQ(this->maps[i].faults.bits, twin.faults.bits);
        }
    }
}

TYPED_TEST(SliceWarps, OfABlendThatIsNoNumberHaveNone) {
    using T = TypeParam;
    auto const fitted = [this](T blend) {
        return fit_slice_warps(this->view, this->sun, this->splits, blend, this->town, this->town, this->options,
                               gl_clip, this->maps);
    };
    EXPECT_EQ(fitted(T(0)), 0x3fu);
    Mat4<T> wanted[6];
    for (int i = 0; i < 6; ++i) wanted[i] = this->maps[i].clip_from_world;
    EXPECT_EQ(fitted(std::numeric_limits<T>::quiet_NaN()), 0x3fu);
    for (int i = 0; i < 6; ++i) EXPECT_EQ(this->maps[i].clip_from_world, wanted[i]);
}

TYPED_TEST(SliceWarps, OfPlanesThatAreNoNumbersAreWrittenAndNoMore) {
    using T = TypeParam;
    Splits<T> endless = this->splits;
    endless.plane[6] = std::numeric_limits<T>::infinity();
    this->maps[6].faults = Fault::bad_region;
    EXPECT_EQ(fit_slice_warps(this->view, this->sun, endless, T(0), this->town, this->town, this->options, gl_clip,
                              this->maps),
              0u);
    for (int i = 0; i < 6; ++i) EXPECT_EQ(this->maps[i].faults.bits, Faults(Fault::not_finite).bits);
    EXPECT_EQ(this->maps[6].faults.bits, Faults(Fault::bad_region).bits);
}

TYPED_TEST(SliceWarps, NameWhatIsWrong) {
    using T = TypeParam;
    constexpr T nan = std::numeric_limits<T>::quiet_NaN();
    this->options.strength = T(3);
    EXPECT_EQ(this->fitted(this->town), 0x3fu);
    for (int i = 0; i < 6; ++i) EXPECT_TRUE(this->maps[i].faults.has(Fault::clamped_option));
    this->options.strength = T(0);
    EXPECT_EQ(this->fitted(this->town), 0x3fu);
    for (int i = 0; i < 6; ++i) EXPECT_TRUE(this->maps[i].faults.has(Fault::warp_faded));
    this->options.strength = nan;
    EXPECT_EQ(this->fitted(this->town), 0u);
    for (int i = 0; i < 6; ++i) EXPECT_TRUE(this->maps[i].faults.has(Fault::not_finite));
    this->options.strength = T(1);
    Splits<T> none;
    none.count = 0;
    EXPECT_EQ(
        fit_slice_warps(this->view, this->sun, none, T(0), this->town, this->town, this->options, gl_clip, this->maps),
        0u);
    // A blend that is no number is none.
    EXPECT_EQ(fit_slice_warps(this->view, this->sun, this->splits, nan, this->town, this->town, this->options, gl_clip,
                              this->maps),
              0x3fu);
    Splits<T> endless = this->splits;
    endless.plane[6] = std::numeric_limits<T>::infinity();
    EXPECT_EQ(fit_slice_warps(this->view, this->sun, endless, T(0), this->town, this->town, this->options, gl_clip,
                              this->maps),
              0u);
    EXPECT_TRUE(this->maps[0].faults.has(Fault::not_finite));
    this->view.pose.position.x = T(1e7);
    Aabb<T> const there{this->town.lo + Vec3<T>(T(1e7), T(0), T(0)), this->town.hi + Vec3<T>(T(1e7), T(0), T(0))};
    EXPECT_NE(
        fit_slice_warps(this->view, this->sun, this->splits, T(0), there, there, this->options, gl_clip, this->maps),
        0u);
    EXPECT_EQ(this->maps[0].faults.has(Fault::precision_lost), sizeof(T) == 4);
}

TYPED_TEST(SliceWarps, OfAnOrthographicViewHaveNoWarp) {
    using T = TypeParam;
    this->view = orthographic_view(this->view.pose, T(-20), T(20), T(-10), T(10), T(0.1), T(200));
    EXPECT_NE(this->fitted(this->town), 0u);
    for (int i = 0; i < 6; ++i) {
        ShadowMap<T> const twin = this->twin(i, this->sun);
        ASSERT_EQ(this->maps[i].visible, twin.visible);
        EXPECT_EQ(this->maps[i].faults.bits, twin.faults.bits);
        if (!twin.visible) continue;
        EXPECT_LT(apart(this->maps[i].clip_from_world, twin.clip_from_world),
                  T(1e4) * std::numeric_limits<T>::epsilon());
        EXPECT_EQ(glm::length(Vec3<T>(row(this->maps[i].clip_from_world, 3))), T(0));
    }
}
