// SPDX-License-Identifier: MIT
#include "tests/laws/judge.hpp"
#include "tests/support/watched.hpp"

#include <shadowmath/aliasing.hpp>
#include <shadowmath/cascades.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace shadowmath;

namespace {

using V2 = glm::dvec2;
using V3 = glm::dvec3;

V2 const pixels(1000, 1000);
Aabb<double> const everything{V3(-1e4), V3(1e4)};
Light<double> const overhead = directional(V3(0, -1, 0));

// Narrow enough for the error along the view to exceed the one across it.
ViewVolume<double> narrow_view(double z_near, double z_far) {
    ViewVolume<double> view =
        perspective_view(pose_looking(V3(3, 2, 1), V3(0, 0, -1), V3(0, 1, 0)), 1.0, 1.0, z_near, z_far);
    view.right = view.top = 0.2;
    view.left = view.bottom = -0.2;
    return view;
}

// On the view axis, where the closed forms hold, with neutral normals.
Samples<double> on_the_axis(ViewVolume<double> const& view) {
    Samples<double> samples;
    samples.count = max_samples;
    for (int i = 0; i < max_samples; ++i) {
        double const depth = view.z_near * std::pow(view.z_far / view.z_near, (i + 0.5) / max_samples);
        V3 const point = point_at(view, 0.0, 0.0, depth);
        samples.at[static_cast<std::size_t>(i)] = {point, neutral_normal(view, overhead, point)};
    }
    return samples;
}

double worst_measured(ViewVolume<double> const& view, CascadeOptions<double> const& options) {
    Samples<double> const samples = on_the_axis(view);
    auto const cascades = fit_cascades(view, overhead, everything, everything, options);
    auto const judgement = judge(cascades, options.map_size, view, pixels, samples.at.data(), samples.count);
    EXPECT_TRUE(laws::adds_up(judgement));
    EXPECT_EQ(judgement.all.unserved, 0);
    return judgement.all.worst / closed_form::pixels_per_texel(pixels.y, view.top, double(options.map_size));
}

CascadeOptions<double> plain(int count) {
    CascadeOptions<double> options;
    options.fit = CascadeFit::tight;
    options.count = count;
    options.map_size = 4096;
    options.lambda = 1.0;
    options.blend = 0.0;
    options.filter_radius = 0;
    return options;
}

}  // namespace

TEST(Judge, MeasuresTheClosedFormsToAHundredth) {
    for (double const ratio : {3.0, 30.0, 1000.0}) {
        ViewVolume<double> const view = narrow_view(1.0, ratio);
        // The first and last samples stand half a step inside the range.
        double const step = std::pow(ratio, 0.5 / max_samples);
        double const uniform = std::max(closed_form::uniform_along(step, 1.0, ratio), 0.4 * ratio / step);
        EXPECT_NEAR(worst_measured(view, plain(1)) / uniform, 1.0, 0.01) << ratio;
        for (int const count : {2, 4}) {
            // The view is 0.4 m wide for a metre of depth: across it decides where the splits are short.
            double const across = 0.4 * std::pow(ratio, 1.0 / count);
            double const split = std::max(closed_form::split_uniform_worst(1.0, ratio, count), across);
            EXPECT_NEAR(worst_measured(view, plain(count)) / split, 1.0, 0.01 + std::log(ratio) / max_samples) << ratio;
        }
        CascadeOptions<double> warped = plain(1);
        warped.fit = CascadeFit::warped;
        double const best = closed_form::warped_worst(1.0, ratio, closed_form::best_centre(1.0, ratio));
        double const across = closed_form::warped_across(step, 1.0, ratio, closed_form::best_centre(1.0, ratio)) * 0.4;
        EXPECT_NEAR(worst_measured(view, warped) / std::max(best, across), 1.0, 0.01 + std::log(ratio) / max_samples)
            << ratio;
    }
}

TEST(Judge, TellsTheMapsApart) {
    ViewVolume<double> const view = narrow_view(1.0, 100.0);
    CascadeOptions<double> options = plain(4);
    Samples<double> const samples = on_the_axis(view);
    auto const cascades = fit_cascades(view, overhead, everything, everything, options);
    auto const judgement = judge(cascades, 4096, view, pixels, samples.at.data(), samples.count);
    // Logarithmic splits: as many samples, as bad a worst, in each.
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(judgement.map[i].count, max_samples / 4);
        EXPECT_NEAR(judgement.map[i].worst / judgement.all.worst, 1.0, 0.02);
    }
    EXPECT_EQ(judgement.map[4].count, 0);
}

TEST(Judge, ItsPriceIsTheMeanOfWhatEachPointCosts) {
    ViewVolume<double> const view = narrow_view(1.0, 1000.0);
    Samples<double> const samples = on_the_axis(view);
    auto const cascades = fit_cascades(view, overhead, everything, everything, plain(1));
    auto const judgement = judge(cascades, 64, view, pixels, samples.at.data(), samples.count);
    double price = 0.0;
    for (int i = 0; i < samples.count; ++i) {
        auto const& sample = samples.at[static_cast<std::size_t>(i)];
        double const major = footprint(clip_from_world(view, ClipSpace{}), pixels, cascades.at[0].map.clip_from_world,
                                       64.0, sample.point, sample.normal)
                                 .major;
        price += price_of(major) / samples.count;
    }
    EXPECT_NEAR(judgement.all.price, price, 1e-9 * price);
    EXPECT_LT(judgement.all.price, 0.5 * judgement.all.mean) << "lost points cost no more than lost ones";
    EXPECT_TRUE(laws::adds_up(judgement));
}

TEST(Judge, CountsWhatNoMapHolds) {
    ViewVolume<double> const view = narrow_view(1.0, 100.0);
    Samples<double> const samples = on_the_axis(view);
    Cascades<double> cascades = fit_cascades(view, overhead, everything, everything, plain(2));
    cascades.at[1].map = {};
    auto const judgement = judge(cascades, 4096, view, pixels, samples.at.data(), samples.count);
    EXPECT_EQ(judgement.all.unserved, max_samples / 2);
    EXPECT_EQ(judgement.all.worst, footprint_limit<double>);
    EXPECT_TRUE(laws::adds_up(judgement));
}

TEST(SamplesIn, AreInTheBoxAndInView) {
    ViewVolume<double> const view =
        perspective_view(pose_looking(V3(0, 2, 0), V3(0, -0.2, -1), V3(0, 1, 0)), 1.0, 1.6, 0.1, 200.0);
    Aabb<double> const town{V3(-80, 0, -150), V3(80, 12, 30)}, ground{V3(-500, 0, -500), V3(500, 0, 500)};
    auto const in_town = samples_in(view, overhead, town), on_ground = samples_in(view, overhead, ground);
    EXPECT_GT(in_town.count, 100);
    EXPECT_GT(on_ground.count, 30);
    EXPECT_LE(on_ground.count, 64);
    for (auto const* samples : {&in_town, &on_ground})
        for (int i = 0; i < samples->count; ++i) {
            auto const& sample = samples->at[static_cast<std::size_t>(i)];
            Aabb<double> const& box = samples == &in_town ? town : ground;
            EXPECT_TRUE(contains(Aabb<double>{box.lo - 1e-9, box.hi + 1e-9}, sample.point));
            double const depth = eye_depth(view, sample.point);
            EXPECT_TRUE(depth > view.z_near && depth < view.z_far);
            EXPECT_NEAR(glm::length(sample.normal), 1.0, 1e-12);
            V3 const to_eye = glm::normalize(view.pose.position - sample.point);
            EXPECT_NEAR(glm::dot(sample.normal, to_eye), glm::dot(sample.normal, V3(0, 1, 0)), 1e-12);
        }
    EXPECT_EQ(samples_in(view, overhead, Aabb<double>{}).count, 0);
    EXPECT_EQ(samples_in(view, overhead, Aabb<double>{V3(0, 0, 20), V3(1, 1, 30)}).count, 0);
}

TEST(NeutralNormal, FacesTheEyeWhereTheLightComesFromBehindThePoint) {
    ViewVolume<double> const view = narrow_view(1.0, 100.0);
    V3 const point = point_at(view, 0.0, 0.0, 10.0);
    EXPECT_EQ(neutral_normal(view, directional(V3(0, 0, 1)), point), V3(0, 0, 1));
}

TEST(DepthsInBox, AreWhereAShortAndSlantingRayEntersAndLeaves) {
    ViewVolume<double> const view =
        perspective_view(pose_looking(V3(0), V3(0, 0, -1), V3(0, 1, 0)), 1.0, 1.0, 0.1, 0.9);
    Aabb<double> const box{V3(-1, -1, -0.7), V3(1, 1, -0.5)};
    DepthSpan<double> const span = depths_in_box(view, 0.1, -0.2, box);
    EXPECT_NEAR(span.first, 0.5, 1e-15);
    EXPECT_NEAR(span.last, 0.7, 1e-15);
    // At 0.35 m a side of 0.2 is 0.07 m across, and at 0.5 m 0.1 m.
    EXPECT_NEAR(depths_in_box(view, 0.2, 0.0, Aabb<double>{V3(0.07, -1, -2), V3(0.1, 1, 2)}).first, 0.35, 1e-15);
    EXPECT_NEAR(depths_in_box(view, 0.2, 0.0, Aabb<double>{V3(0.07, -1, -2), V3(0.1, 1, 2)}).last, 0.5, 1e-15);
}

TEST(SamplesIn, StandInTheMiddleOfTheirCells) {
    ViewVolume<double> const view = narrow_view(1.0, 100.0);
    Samples<double> const samples = samples_in(view, overhead, everything);
    ASSERT_EQ(samples.count, max_samples);
    V2 middle(0);
    for (int i = 0; i < samples.count; ++i) {
        V3 const way = samples.at[static_cast<std::size_t>(i)].point - view.pose.position;
        middle += V2(glm::dot(view.pose.right, way), glm::dot(view.pose.up, way)) / glm::dot(view.pose.forward, way);
    }
    EXPECT_NEAR(middle.x, 0.0, 1e-12);
    EXPECT_NEAR(middle.y, 0.0, 1e-12);
}

TEST(SamplesIn, AreNoneWhereAnythingIsWrong) {
    double const nan = std::numeric_limits<double>::quiet_NaN();
    ViewVolume<double> const view = narrow_view(1.0, 100.0);
    ViewVolume<double> bad = view, endless = view;
    bad.left = bad.right;
    endless.z_far = std::numeric_limits<double>::infinity();
    EXPECT_EQ(samples_in(bad, overhead, everything).count, 0);
    EXPECT_EQ(samples_in(endless, overhead, everything).count, 0);
    EXPECT_EQ(samples_in(view, directional(V3(0)), everything).count, 0);
    EXPECT_EQ(samples_in(view, overhead, Aabb<double>{V3(nan), V3(1)}).count, 0);
    EXPECT_EQ(samples_in(view, overhead, Aabb<double>{}).count, 0);
}

TEST(Judge, LeavesOutWhatHasNoFootprint) {
    ViewVolume<double> const view = narrow_view(1.0, 100.0);
    CascadeOptions<double> const options = plain(1);
    auto const cascades = fit_cascades(view, overhead, everything, everything, options);
    SurfacePoint<double> const without_a_side{point_at(view, 0.0, 0.0, 10.0), V3(0)};
    EXPECT_EQ(judge(cascades, options.map_size, view, pixels, &without_a_side, 1).all.count, 0);
}

// A ray along an axis never meets the sides of a box beside it, nor divides by the way that it does not go.
TEST(DepthsInBox, OfARayAlongAnAxisAreThoseOfTheBoxAroundIt) {
    ViewVolume<double> const view = orthographic_view(Pose<double>{}, -1.0, 1.0, -1.0, 1.0, 1.0, 101.0);
    auto const met = [&](Vec3<double> const& lo, Vec3<double> const& hi) {
        auto const run = test::watched([&] { return depths_in_box(view, 0.0, 0.0, Aabb<double>{lo, hi}); });
        EXPECT_TRUE(run.calm_in_range());
        return run.result.first <= run.result.last;
    };
    using V3 = Vec3<double>;
    EXPECT_TRUE(met(V3(-0.5, -0.5, -20), V3(0.5, 0.5, -10)));
    EXPECT_TRUE(met(V3(0, 0, -20), V3(0.5, 0.5, -10)));
    EXPECT_FALSE(met(V3(0.5, -0.5, -20), V3(0.9, 0.5, -10)));
    EXPECT_FALSE(met(V3(-0.5, 0.5, -20), V3(0.5, 0.9, -10)));
    EXPECT_FALSE(met(V3(-0.9, -0.5, -20), V3(-0.5, 0.5, -10)));
    EXPECT_FALSE(met(V3(-0.5, -0.9, -20), V3(0.5, -0.5, -10)));
}

TEST(StillGood, IsAMapWhoseWorstTexelIsNoLargerThanAFewPixelsHoweverFineItWas) {
    Worth<double> drawn, now;
    drawn.worst = 0.2;
    now.worst = 1.4;
    EXPECT_TRUE(still_good(drawn, now));
    now.worst = 1.6;
    EXPECT_FALSE(still_good(drawn, now));
    drawn.worst = 2.0;
    EXPECT_TRUE(still_good(drawn, now));
    now.unserved = 1;
    EXPECT_FALSE(still_good(drawn, now));
}
