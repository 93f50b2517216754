// SPDX-License-Identifier: MIT
#include "tests/support/watched.hpp"

#include <shadowmath/light_samples.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

using namespace shadowmath;

namespace {

using V2 = glm::dvec2;
using V3 = glm::dvec3;

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr double endless = std::numeric_limits<double>::infinity();

V2 const picture(1920, 1080), cells(48, 27);

ViewVolume<double> some_view() {
    return perspective_view(pose_looking(V3(3, 1.7, -2), V3(0.4, -0.15, -1), V3(0, 1, 0)), 1.0, 16.0 / 9, 0.1, 150.0);
}

ViewVolume<double> flat_view() {
    return orthographic_view(some_view().pose, -32.0, 32.0, -18.0, 18.0, 0.1, 150.0);
}

Light<double> const morning = directional(V3(0.8, -0.5, 0.4));

V2 pixel_of(ViewVolume<double> const& view, V3 const& point) {
    glm::dvec4 const clip = clip_from_world(view, gl_clip) * glm::dvec4(point, 1);
    return V2(clip) / clip.w * 0.5 * picture;
}

// From the point along the surface, as far on the light's plane as `step` says.
V3 moved_on_surface(LightBasis<double> const& basis, SurfacePoint<double> const& at, V2 step) {
    V3 const across = basis.x * step.x + basis.y * step.y;
    return at.point + across - basis.depth * (glm::dot(at.normal, across) / glm::dot(at.normal, basis.depth));
}

std::vector<SurfacePoint<double>> some_surfaces(ViewVolume<double> const& view) {
    std::vector<SurfacePoint<double>> surfaces;
    for (double const depth : {0.5, 4.0, 60.0})
        for (V2 const share : {V2(0), V2(0.7, -0.4), V2(-0.9, 0.8)})
            for (V3 const normal : {V3(0, 1, 0), V3(-1, 0, 0), V3(-0.5, 0.6, 0.4)})
                surfaces.push_back({point_at(view, share.x * view.right, share.y * view.top, depth), normal});
    return surfaces;
}

bool is_unusable(LightSample<double> const& sample) {
    return !sample.usable && all_finite(sample.place) && all_finite(sample.gain_x) && all_finite(sample.reach_x);
}

}  // namespace

// 10 m above a square under a sun at noon, 90 degrees wide: 20 m of it for the whole picture.
TEST(LightSamples, StraightFromAboveAMetreIsAsManyPixelsOnEitherAxis) {
    ViewVolume<double> const view =
        perspective_view(pose_looking(V3(0, 10, 0), V3(0, -1, 0), V3(0, 0, -1)), 1.57079632679489662, 1.0, 0.1, 50.0);
    Light<double> const noon = directional(V3(0, -1, 0));
    LightSampler<double> const sampler = light_sampler(view, noon, V2(1000), V2(50));
    ASSERT_TRUE(sampler.usable);
    for (V3 const point : {V3(0), V3(4, 0, -7)}) {
        LightSample<double> const sample = light_sample(sampler, {point, V3(0, 1, 0)});
        ASSERT_TRUE(sample.usable);
        EXPECT_NEAR(glm::length(sample.gain_x), 50.0, 1e-9);
        EXPECT_NEAR(glm::length(sample.gain_y), 50.0, 1e-9);
        EXPECT_NEAR(glm::dot(sample.gain_x, sample.gain_y), 0.0, 1e-9);
        EXPECT_NEAR(glm::length(sample.reach_x), 0.2, 1e-12) << "50 cells in 20 m: 0.2 m to their sides";
        EXPECT_NEAR(glm::length(sample.reach_y), 0.2, 1e-12);
        EXPECT_NEAR(sample.depth, 10.0, 1e-12);
        EXPECT_EQ(sample.weight, 1.0);
    }
}

TEST(LightSamples, PlaceAndDepthLeadBackToThePoint) {
    for (ViewVolume<double> const& view : {some_view(), flat_view()}) {
        LightSampler<double> const sampler = light_sampler(view, morning, picture, cells);
        for (auto const& surface : some_surfaces(view)) {
            LightSample<double> const sample = light_sample(sampler, surface);
            ASSERT_TRUE(sample.usable);
            V3 const back = view.pose.position + sampler.basis.x * sample.place.x + sampler.basis.y * sample.place.y +
                            sampler.basis.depth * sample.depth;
            EXPECT_NEAR(glm::length(back - surface.point), 0.0, 1e-12 * (1 + sample.seen.z));
            V3 const seen = point_at(view, sample.seen.x, sample.seen.y, sample.seen.z);
            EXPECT_NEAR(glm::length(seen - surface.point), 0.0, 1e-12 * (1 + sample.seen.z));
        }
    }
}

TEST(LightSamples, GainsAreThePixelsThatDifferencesSay) {
    for (ViewVolume<double> const& view : {some_view(), flat_view()}) {
        LightSampler<double> const sampler = light_sampler(view, morning, picture, cells);
        for (auto const& surface : some_surfaces(view)) {
            LightSample<double> const sample = light_sample(sampler, surface);
            ASSERT_TRUE(sample.usable);
            double const h = 1e-5 * sample.seen.z;
            auto const gained = [&](V2 axis) {
                return (pixel_of(view, moved_on_surface(sampler.basis, surface, axis * h)) -
                        pixel_of(view, moved_on_surface(sampler.basis, surface, axis * -h))) /
                       (2 * h);
            };
            EXPECT_NEAR(glm::length(gained(V2(1, 0)) - sample.gain_x), 0.0, 1e-5 * glm::length(sample.gain_x));
            EXPECT_NEAR(glm::length(gained(V2(0, 1)) - sample.gain_y), 0.0, 1e-5 * glm::length(sample.gain_y));
        }
    }
}

TEST(LightSamples, ACellIsAsManyPixelsWideAsItsShareOfThePicture) {
    LightSampler<double> const sampler = light_sampler(some_view(), morning, picture, cells);
    int whole = 0;
    for (auto const& surface : some_surfaces(some_view())) {
        LightSample<double> const sample = light_sample(sampler, surface);
        auto const pixels = [&](V2 reach) { return sample.gain_x * reach.x + sample.gain_y * reach.y; };
        double const limit = 8.0 * sample.seen.z * 0.5 * (some_view().top - some_view().bottom) / cells.y;
        EXPECT_LE(std::max(std::abs(sample.reach_x.x), std::abs(sample.reach_x.y)), limit * 1.0001);
        EXPECT_LE(std::max(std::abs(sample.reach_y.x), std::abs(sample.reach_y.y)), limit * 1.0001);
        // Those of surfaces that the eye grazes are cut.
        if (glm::length(pixels(sample.reach_x) - V2(20, 0)) < 1e-9) ++whole;
        if (glm::length(pixels(sample.reach_y) - V2(0, 20)) < 1e-9) ++whole;
    }
    EXPECT_GE(whole, 30);
}

TEST(LightSamples, OnlyWhatTheLightFallsOnHasAWeight) {
    LightSampler<double> const from_above = light_sampler(some_view(), morning, picture, cells);
    LightSampler<double> const from_below = light_sampler(some_view(), directional(-morning.direction), picture, cells);
    SurfacePoint<double> const floor{point_at(some_view(), 0.0, -0.3, 6.0), V3(0, 1, 0)};
    EXPECT_EQ(light_sample(from_above, floor).weight, 1.0);
    EXPECT_EQ(light_sample(from_below, floor).weight, 0.0);
    EXPECT_TRUE(light_sample(from_below, floor).usable) << "the map must hold it all the same";
}

TEST(LightSamples, LengthAndSideOfTheNormalNeverMatter) {
    LightSampler<double> const sampler = light_sampler(some_view(), morning, picture, cells);
    for (auto const& surface : some_surfaces(some_view())) {
        LightSample<double> const once = light_sample(sampler, surface);
        for (double const scale : {8.0, -1.0, 0x1p-300}) {
            LightSample<double> const again = light_sample(sampler, {surface.point, surface.normal * scale});
            ASSERT_TRUE(again.usable);
            EXPECT_EQ(once.weight, again.weight);
            EXPECT_NEAR(glm::length(once.gain_x - again.gain_x), 0.0, 1e-12 * glm::length(once.gain_x));
            EXPECT_NEAR(glm::length(once.gain_y - again.gain_y), 0.0, 1e-12 * glm::length(once.gain_y));
        }
    }
}

TEST(LightSamples, WithoutANormalASurfaceFacesTheEye) {
    LightSampler<double> const sampler = light_sampler(some_view(), morning, picture, cells);
    V3 const point = point_at(some_view(), 0.2, -0.3, 6.0);
    LightSample<double> const none = light_sample(sampler, {point, V3(0)});
    LightSample<double> const facing = light_sample(sampler, {point, some_view().pose.position - point});
    ASSERT_TRUE(none.usable);
    EXPECT_NEAR(glm::length(none.gain_x - facing.gain_x) + glm::length(none.gain_y - facing.gain_y), 0.0, 1e-9);
}

TEST(LightSamples, SurfacesThatLightOrEyeGrazeHaveACellWithAnEnd) {
    ViewVolume<double> const view = some_view();
    LightSampler<double> const sampler = light_sampler(view, morning, picture, cells);
    V3 const point = point_at(view, 0.2, -0.3, 6.0), to_eye = view.pose.position - point;
    V3 const edge_on_to_light = glm::cross(morning.direction, V3(0.3, 1, -0.2));
    V3 const edge_on_to_eye = glm::cross(to_eye, V3(0.3, 1, -0.2)),
             edge_on_to_both = glm::cross(to_eye, morning.direction);
    for (V3 const normal : {edge_on_to_light, edge_on_to_eye, edge_on_to_both}) {
        LightSample<double> const sample = light_sample(sampler, {point, normal});
        ASSERT_TRUE(sample.usable);
        EXPECT_LT(glm::length(sample.gain_x) + glm::length(sample.gain_y), 1e6);
        EXPECT_LT(glm::length(sample.reach_x) + glm::length(sample.reach_y), 2 * 8 * std::sqrt(2.0) * 6.0 * 0.0203);
    }
}

TEST(LightSamples, ACellSeenEdgeOnIsEightTimesAsDeepAsItsLongerSide) {
    ViewVolume<double> const view = some_view();
    V3 const point = point_at(view, 0.2, -0.3, 6.0);
    V3 const edge_on = glm::cross(view.pose.position - point, V3(0.3, 1, -0.2));
    for (V2 const shape : {V2(48, 270), V2(480, 27)}) {
        LightSample<double> const sample = light_sample(light_sampler(view, morning, picture, shape), {point, edge_on});
        ASSERT_TRUE(sample.usable);
        double const side = std::max((view.right - view.left) / shape.x, (view.top - view.bottom) / shape.y) * 6.0;
        for (V2 const reach : {sample.reach_x, sample.reach_y})
            EXPECT_NEAR(std::max(std::abs(reach.x), std::abs(reach.y)), 8 * side / 2, 1e-9);
    }
}

TEST(LightSamples, ACellIsTheSameHoweverFineThePicture) {
    auto surfaces = some_surfaces(some_view());
    V3 const point = point_at(some_view(), 0.2, -0.3, 6.0);
    surfaces.push_back({point, glm::cross(some_view().pose.position - point, V3(0.3, 1, -0.2))});  // seen edge-on
    for (auto const& surface : surfaces) {
        LightSample<double> const fine = light_sample(light_sampler(some_view(), morning, picture, cells), surface);
        V2 const few = picture * 0x1p-30;
        LightSample<double> const coarse = light_sample(light_sampler(some_view(), morning, few, cells), surface);
        EXPECT_EQ(fine.reach_x, coarse.reach_x);
        EXPECT_EQ(fine.reach_y, coarse.reach_y);
    }
}

// A level surface as high as the eye: nothing on it is as much as a pixel higher.
TEST(LightSamples, AlongASurfaceThatIsALineInThePictureACellHasNoHeight) {
    ViewVolume<double> const view = perspective_view(Pose<double>{}, 1.0, 16.0 / 9, 0.1, 150.0);
    LightSampler<double> const sampler = light_sampler(view, directional(V3(0, -1, 0)), picture, cells);
    LightSample<double> const sample = light_sample(sampler, {V3(0, 0, -5), V3(0, 1, 0)});
    ASSERT_TRUE(sample.usable);
    EXPECT_EQ(sample.gain_x.y, 0.0);
    EXPECT_EQ(sample.gain_y.y, 0.0);
    EXPECT_EQ(sample.reach_x, V2(0));
    EXPECT_GT(glm::length(sample.reach_y), 0.0);
}

TEST(LightSamples, ACellTooLargeForANumberIsUnusable) {
    SurfacePoint<double> const surface{point_at(some_view(), 0.1, 0.1, 0.5), V3(0, 1, 0)};
    for (V2 const shape : {V2(1e-304, 27), V2(48, 1e-304)}) {
        LightSampler<double> const sampler = light_sampler(some_view(), morning, picture, shape);
        ASSERT_TRUE(sampler.usable);
        EXPECT_FALSE(light_sample(sampler, surface).usable);
    }
}

TEST(LightSamples, APlaceTooFarForANumberIsUnusable) {
    ViewVolume<double> const view = orthographic_view(Pose<double>{}, -32.0, 32.0, -18.0, 18.0, 0.1, 150.0);
    int too_far = 0;
    for (V3 const travel : {V3(1, -1, -1), V3(1, 1, -1), V3(-1, 1, -1), V3(0, 0, -1), V3(0, -1, -1)}) {
        LightSampler<double> const sampler = light_sampler(view, directional(travel), picture, cells);
        LightSample<double> const sample = light_sample(sampler, {V3(1.5e308, 1.5e308, -5), V3(0, 0, 1)});
        EXPECT_EQ(sample.usable, all_finite(sample.place)) << travel.x << ' ' << travel.y;
        too_far += all_finite(sample.place) ? 0 : 1;
    }
    EXPECT_GT(too_far, 0);
}

TEST(LightSamples, PointsThatAreNotSeenAreUnusable) {
    ViewVolume<double> const view = some_view();
    LightSampler<double> const sampler = light_sampler(view, morning, picture, cells);
    V3 const up(0, 1, 0), seen = point_at(view, 0.1, 0.1, 5.0);
    ASSERT_TRUE(light_sample(sampler, {seen, up}).usable);
    EXPECT_TRUE(is_unusable(light_sample(sampler, {view.pose.position, up}))) << "at the eye";
    EXPECT_TRUE(is_unusable(light_sample(sampler, {point_at(view, 0.1, 0.1, -5.0), up}))) << "behind it";
    EXPECT_TRUE(is_unusable(light_sample(sampler, {point_at(view, 0.1, 0.1, 151.0), up}))) << "beyond far";
    EXPECT_TRUE(light_sample(sampler, {point_at(view, 0.1, 0.1, 150.0), up}).usable) << "at far";
    for (double const bad : {no_number, endless, -endless})
        for (int axis = 0; axis < 3; ++axis) {
            V3 point = seen, normal = up;
            point[axis] = bad;
            normal[axis] = bad;
            EXPECT_TRUE(is_unusable(light_sample(sampler, {point, up})));
            EXPECT_TRUE(is_unusable(light_sample(sampler, {seen, normal})));
        }
}

TEST(LightSamples, AnySizeOfAPictureWillDo) {
    EXPECT_TRUE(light_sampler(some_view(), morning, V2(1, 1), V2(1, 1)).usable);
    EXPECT_TRUE(light_sampler(some_view(), morning, V2(0.5, 0.5), V2(0.25, 0.25)).usable);
}

TEST(LightSamples, ASamplerOfBadInputIsUnusableAndSoAreItsSamples) {
    ViewVolume<double> const view = some_view();
    SurfacePoint<double> const surface{point_at(view, 0.1, 0.1, 5.0), V3(0, 1, 0)};
    std::vector<LightSampler<double>> samplers;
    for (double const bad : {0.0, -4.0, no_number, endless}) {
        samplers.push_back(light_sampler(view, morning, V2(bad, 1080), cells));
        samplers.push_back(light_sampler(view, morning, V2(1920, bad), cells));
        samplers.push_back(light_sampler(view, morning, picture, V2(bad, 27)));
        samplers.push_back(light_sampler(view, morning, picture, V2(48, bad)));
    }
    ViewVolume<double> crossed = view, nowhere_at_all = view;
    std::swap(crossed.left, crossed.right);
    nowhere_at_all.pose.position.y = no_number;
    samplers.push_back(light_sampler(crossed, morning, picture, cells));
    samplers.push_back(light_sampler(nowhere_at_all, morning, picture, cells));
    samplers.push_back(light_sampler(view, directional(V3(0)), picture, cells));
    samplers.push_back(light_sampler(view, directional(V3(no_number)), picture, cells));
    samplers.push_back(light_sampler(view, spot(V3(0, 9, 0), V3(0, -1, 0), 0.5, 30.0), picture, cells));
    samplers.push_back(light_sampler(view, morning, V2(std::numeric_limits<double>::max(), 1080), V2(1e-300, 27)));
    samplers.push_back(light_sampler(view, morning, picture, V2(1e-308, 27)));
    for (std::size_t i = 0; i < samplers.size(); ++i) {
        EXPECT_FALSE(samplers[i].usable) << i;
        EXPECT_TRUE(is_unusable(light_sample(samplers[i], surface))) << i;
    }
}

TEST(LightSamples, AreMadeWithoutTheHeapAndCalmlyAtAnyPrecision) {
    LightSampler<float> const sampler =
        light_sampler(perspective_view(Pose<float>{}, 1.0f, 1.6f, 0.1f, 150.0f), directional(glm::vec3(0.3f, -1, 0.2f)),
                      glm::vec2(1920, 1080), glm::vec2(48, 27));
    auto const seen = test::watched([&] { return light_sample(sampler, {glm::vec3(1, -2, -9), glm::vec3(0, 1, 0)}); });
    EXPECT_TRUE(seen.calm_in_range());
    EXPECT_TRUE(seen.result.usable);
    auto const bad = test::watched([&] { return light_sample(sampler, {glm::vec3(1, NAN, -9), glm::vec3(0, 1, 0)}); });
    EXPECT_TRUE(bad.calm());
    EXPECT_FALSE(bad.result.usable);
}
