// SPDX-License-Identifier: MIT
#include <shadowmath/aliasing.hpp>
#include <shadowmath/choose.hpp>

#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace shadowmath;

namespace {

using V3 = glm::dvec3;

Aabb<double> const town{V3(-300, 0, -300), V3(300, 20, 300)};
Light<double> const morning = directional(V3(0.8, -0.5, 0.4));

ViewVolume<double> street_view() {
    return perspective_view(pose_looking(V3(0, 1.7, 0), V3(0.4, -0.05, -1), V3(0, 1, 0)), 1.0, 1.6, 0.1, 250.0);
}

struct Chosen {
    Samples<double> samples = samples_in(street_view(), morning, town);

    [[nodiscard]] Choice<double> within(ChoiceLimits<double> const& limits,
                                        CascadeOptions<double> const& given = {}) const {
        return choose(street_view(), morning, town, town, samples.at.data(), samples.count, given, limits);
    }
    [[nodiscard]] double worst_of(CascadeOptions<double> const& options, ChoiceLimits<double> const& limits) const {
        auto const cascades = fit_cascades(street_view(), morning, town, town, options);
        return judge(cascades, options.map_size, street_view(), limits.eye_pixels, samples.at.data(), samples.count)
            .all.worst;
    }
};

}  // namespace

TEST(Choose, IsNoWorseThanAnyOptionsThatOneMightTry) {
    Chosen const chosen;
    for (Motion const motion : {Motion::still, Motion::at_ease, Motion::any}) {
        ChoiceLimits<double> limits;
        limits.motion = motion;
        Choice<double> const choice = chosen.within(limits);
        ASSERT_TRUE(choice.visible);
        EXPECT_EQ(choice.judgement.all.worst, chosen.worst_of(choice.options, limits));
        for (int count = 1; count <= 4; ++count)
            for (double lambda = 0.0; lambda <= 1.0; lambda += 0.05) {
                CascadeOptions<double> options;
                options.count = count;
                options.map_size = map_size_within(limits.texels, count, limits.largest_map);
                options.lambda = lambda;
                if (motion == Motion::any) options.fit = static_cast<CascadeFit>(count);
                EXPECT_LE(choice.judgement.all.worst * 0.97, chosen.worst_of(options, limits))
                    << count << ' ' << lambda;
            }
    }
}

TEST(Choose, TriesOneMapOnceAndTwoAtTwentyNineSplits) {
    ChoiceLimits<double> limits;
    limits.most_maps = 1;
    EXPECT_EQ(Chosen{}.within(limits).tried, 1);
    limits.most_maps = 2;
    EXPECT_EQ(Chosen{}.within(limits).tried, 1 + 29);
}

TEST(Choose, SaysWhichLimitsAreOutsideTheirRange) {
    ChoiceLimits<double> least;
    least.most_maps = 1;
    least.texels = 16;
    least.largest_map = 4;
    EXPECT_FALSE(Chosen{}.within(least).faults.any());
    for (int i = 0; i < 4; ++i) {
        ChoiceLimits<double> limits = least;
        if (i == 0) limits.most_maps = 0;
        if (i == 1) limits.most_maps = max_splits + 1;
        if (i == 2) limits.texels = 15;
        if (i == 3) limits.largest_map = 3;
        EXPECT_TRUE(Chosen{}.within(limits).faults.has(Fault::clamped_option)) << i;
    }
}

// Between the eleven values first tried it goes on: a hundred values for its own count and fit find nothing better.
TEST(Choose, PlacesTheSplitsToAHundredth) {
    Chosen const chosen;
    for (int const count : {2, 3, 4}) {
        ChoiceLimits<double> limits;
        limits.most_maps = count;
        Choice<double> const choice = chosen.within(limits);
        CascadeOptions<double> options = choice.options;
        for (int i = 0; i <= 100; ++i) {
            options.lambda = 0.01 * i;
            EXPECT_LE(choice.judgement.all.worst, chosen.worst_of(options, limits) * 1.01) << count << ' ' << i;
        }
    }
}

// From above a little of the far end's share is best.
TEST(Choose, PlacesTheSplitsToAHundredthFarFromTheLogarithmicOnes) {
    ViewVolume<double> const view =
        perspective_view(pose_looking(V3(0, 60, 0), V3(0.4, -2, -1), V3(0, 1, 0)), 1.0, 1.6, 0.1, 250.0);
    Samples<double> const samples = samples_in(view, morning, town);
    ChoiceLimits<double> const limits;
    auto const choice = choose(view, morning, town, town, samples.at.data(), samples.count, {}, limits);
    EXPECT_GT(choice.options.lambda, 0.05);
    EXPECT_LT(choice.options.lambda, 0.6);
    CascadeOptions<double> options = choice.options;
    for (int i = 0; i <= 100; ++i) {
        options.lambda = 0.01 * i;
        auto const cascades = fit_cascades(view, morning, town, town, options);
        EXPECT_LE(
            choice.judgement.all.worst,
            judge(cascades, options.map_size, view, limits.eye_pixels, samples.at.data(), samples.count).all.worst *
                1.005)
            << i;
    }
}

TEST(Choose, GainsWithFreedomAndWithTexels) {
    Chosen const chosen;
    ChoiceLimits<double> limits;
    double const still = chosen.within(limits).judgement.all.worst;
    limits.motion = Motion::any;
    double const any = chosen.within(limits).judgement.all.worst;
    EXPECT_LT(any, still);
    limits.texels *= 4;
    limits.largest_map *= 2;
    EXPECT_LT(chosen.within(limits).judgement.all.worst, any * 0.6);
}

// Of a warped choice each map has the strength that serves it best: under some suns not all of it.
TEST(Choose, WarpsEachMapAsMuchAsHelpsIt) {
    ViewVolume<double> view = street_view();
    view.pose.position.y = 15.0;
    int warped = 0, weaker = 0;
    for (double const azimuth : {1.5, 2.8})
        for (Goal const goal : {Goal::fewest_wrong, Goal::least_mean}) {
            double const elevation = 0.15;
            Light<double> const sun = directional(-V3(std::cos(azimuth) * std::cos(elevation), std::sin(elevation),
                                                      std::sin(azimuth) * std::cos(elevation)));
            Samples<double> const samples = samples_in(view, sun, town);
            ChoiceLimits<double> limits;
            limits.motion = Motion::any;
            limits.goal = goal;
            limits.texels = 4 * 512 * 512;
            Choice<double> const choice = choose(view, sun, town, town, samples.at.data(), samples.count, {}, limits);
            if (choice.options.fit != CascadeFit::warped) continue;
            ++warped;
            // One map as it is and three counts at 29 splits, each with five fits; then two strengths a map.
            EXPECT_EQ(choice.tried, 5 * (1 + 3 * 29) + 2 * choice.options.count);
            auto const value_of = [&](CascadeOptions<double> const& options) {
                auto const cascades = fit_cascades(view, sun, town, town, options);
                Judgement<double> const judged =
                    judge(cascades, options.map_size, view, limits.eye_pixels, samples.at.data(), samples.count);
                return goal == Goal::least_mean ? judged.all.mean : judged.all.price;
            };
            double const chosen = value_of(choice.options);
            for (std::size_t c = 0; c < std::size_t(choice.options.count); ++c) {
                weaker += choice.options.warp_less[c] > 0.0 ? 1 : 0;
                for (double const less : {0.0, 0.5, 1.0}) {
                    CascadeOptions<double> other = choice.options;
                    other.warp_less[c] = less;
                    EXPECT_LE(chosen, value_of(other) * (1.0 + 1e-12)) << c << ' ' << less;
                }
            }
        }
    EXPECT_GT(warped, 0);
    EXPECT_GT(weaker, 0);
}

TEST(Choose, KeepsStillWhatMustBeStill) {
    Chosen const chosen;
    ChoiceLimits<double> limits;
    EXPECT_EQ(chosen.within(limits).options.fit, CascadeFit::stable);
    limits.motion = Motion::at_ease;
    EXPECT_EQ(chosen.within(limits).options.steady_maps, 1);
}

TEST(Choose, AtEaseTheOnlyMapIsTheStillOne) {
    ChoiceLimits<double> limits;
    limits.motion = Motion::at_ease;
    limits.most_maps = 1;
    Choice<double> const choice = Chosen{}.within(limits);
    EXPECT_TRUE(choice.visible);
    EXPECT_EQ(choice.options.fit, CascadeFit::stable);
    EXPECT_EQ(choice.tried, 1);
}

TEST(Choose, TriesNoMapThatItsFilterLeavesNothingOf) {
    ChoiceLimits<double> limits;
    limits.most_maps = 1;
    CascadeOptions<double> given;
    // Three texels and a margin of a filter and one texel on either side.
    for (int const texels : {4, 8, 12})
        for (int const radius : {0, 1, 2, 3, 4}) {
            limits.texels = texels * texels;
            given.filter_radius = radius;
            EXPECT_EQ(Chosen{}.within(limits, given).tried, texels >= 3 + 2 * (radius + 1) ? 1 : 0);
        }
}

// One map of each fit is measured here as there: a later one is taken where it is better by more than a fiftieth.
TEST(Choose, OfFitsThatAreEqualToAFiftiethTheCalmerStays) {
    int close = 0;
    for (V3 const look : {V3(0, -1, 0), V3(0.1, -1, 0.3), V3(0.4, -0.05, -1)}) {
        ViewVolume<double> const view =
            perspective_view(pose_looking(V3(0, 60, 0), look, V3(0, 0, -1)), 1.0, 1.6, 0.1, 250.0);
        Light<double> const sun = directional(V3(0, -1, 0));
        Samples<double> const samples = samples_in(view, sun, town);
        ChoiceLimits<double> limits;
        limits.motion = Motion::any;
        limits.most_maps = 1;
        CascadeOptions<double> options;
        options.count = 1;
        options.map_size = map_size_within(limits.texels, 1, limits.largest_map);
        double least = footprint_limit<double>;
        CascadeFit expected = options.fit;
        for (CascadeFit const fit :
             {CascadeFit::stable, CascadeFit::tight, CascadeFit::rectangle, CascadeFit::focus, CascadeFit::warped}) {
            options.fit = fit;
            double const worst = judge(fit_cascades(view, sun, town, town, options), options.map_size, view,
                                       limits.eye_pixels, samples.at.data(), samples.count)
                                     .all.worst;
            close += worst > 0.98 * least && worst < least / 0.98 ? 1 : 0;
            if (worst >= 0.98 * least) continue;
            least = worst;
            expected = fit;
        }
        Choice<double> const choice = choose(view, sun, town, town, samples.at.data(), samples.count, {}, limits);
        EXPECT_EQ(choice.options.fit, expected) << look.x;
    }
    EXPECT_GT(close, 0);
}

TEST(Choose, StaysWithinItsTexelsAndItsTries) {
    Chosen const chosen;
    ChoiceLimits<double> limits;
    limits.motion = Motion::any;
    limits.most_maps = 3;
    limits.texels = 1 << 20;
    limits.goal = Goal::least_mean;
    Choice<double> const choice = chosen.within(limits);
    EXPECT_LE(std::int64_t(choice.options.map_size) * choice.options.map_size * choice.options.count, limits.texels);
    EXPECT_LE(choice.tried, 3 * 5 * 29 + 2 * 3);
    EXPECT_LE(choice.options.count, 3);
}

TEST(Choose, GivesTheSameForTheSameAndAllocatesNothing) {
    Chosen const chosen;
    ChoiceLimits<double> limits;
    limits.motion = Motion::any;
    limits.most_maps = 2;
    auto const first = test::watched([&] { return chosen.within(limits); });
    Choice<double> const second = chosen.within(limits);
    EXPECT_TRUE(first.calm_in_range());
    EXPECT_EQ(first.result.options.lambda, second.options.lambda);
    EXPECT_EQ(first.result.judgement.all.worst, second.judgement.all.worst);
}

// Overhead sun, level and narrow view: logarithmic splits are the best there are, and closed forms tell how good.
TEST(Choose, FindsLogarithmicSplitsWhereTheoryWantsThem) {
    ViewVolume<double> view =
        perspective_view(pose_looking(V3(0, 2, 0), V3(0, 0, -1), V3(0, 1, 0)), 1.0, 1.0, 1.0, 200.0);
    view.right = view.top = 0.2;
    view.left = view.bottom = -0.2;
    Light<double> const overhead = directional(V3(0, -1, 0));
    Samples<double> samples;
    samples.count = max_samples;
    for (int i = 0; i < max_samples; ++i) {
        V3 const point = point_at(view, 0.0, 0.0, std::pow(200.0, (i + 0.5) / max_samples));
        samples.at[static_cast<std::size_t>(i)] = {point, neutral_normal(view, overhead, point)};
    }
    CascadeOptions<double> given;
    given.fit = CascadeFit::tight;
    given.blend = 0.0;
    given.filter_radius = 0;
    ChoiceLimits<double> limits;
    limits.eye_pixels = glm::dvec2(1000);
    limits.motion = Motion::any;
    limits.most_maps = 3;
    Aabb<double> const everything{V3(-1e4), V3(1e4)};
    Choice<double> const choice =
        choose(view, overhead, everything, everything, samples.at.data(), samples.count, given, limits);
    ASSERT_TRUE(choice.visible);
    EXPECT_EQ(choice.options.count, 3);
    double const unit = closed_form::pixels_per_texel(1000.0, 0.2, double(choice.options.map_size));
    EXPECT_LT(choice.judgement.all.worst / unit, closed_form::split_uniform_worst(1.0, 200.0, 3) * 1.01);
    EXPECT_GT(choice.judgement.all.worst / unit, closed_form::split_logarithmic_worst(1.0, 200.0, 3) * 0.99);
}

TEST(Choose, LeavesTheOptionsAloneWhereNothingIsSeen) {
    CascadeOptions<double> given;
    given.count = 3;
    Choice<double> const choice =
        choose<double>(street_view(), morning, town, town, nullptr, 0, given, ChoiceLimits<double>{});
    EXPECT_FALSE(choice.visible);
    EXPECT_EQ(choice.options.count, 3);
    ChoiceLimits<double> odd;
    odd.most_maps = -1;
    odd.texels = 0;
    EXPECT_TRUE(
        choose<double>(street_view(), morning, town, town, nullptr, 0, given, odd).faults.has(Fault::clamped_option));
}

TEST(Choose, TriesStableMapsAloneForALamp) {
    Light<double> const lamp = spot(V3(4, 12, -12), V3(0, -1, 0.1), 1.0, 40.0);
    Aabb<double> const ground{V3(-30, -1, -40), V3(30, 0, 10)};
    Samples<double> const samples = samples_in(street_view(), lamp, ground);
    ChoiceLimits<double> limits;
    limits.most_maps = 2;
    Choice<double> const choice =
        choose(street_view(), lamp, ground, ground, samples.at.data(), samples.count, {}, limits);
    EXPECT_EQ(choice.tried, 1 + 29);
    EXPECT_EQ(choice.options.fit, CascadeFit::stable);
}

// A warp is all that the caller knows of.
TEST(Choose, ThatSeesNothingWeighsNoWarpsEither) {
    CascadeOptions<double> given;
    given.fit = CascadeFit::warped;
    ChoiceLimits<double> limits;
    limits.most_maps = 1;
    Choice<double> const choice =
        choose(street_view(), morning, town, town, static_cast<SurfacePoint<double>*>(nullptr), 0, given, limits);
    EXPECT_FALSE(choice.visible);
    EXPECT_EQ(choice.options.fit, CascadeFit::warped);
    limits.motion = Motion::any;
    int const every_fit = 5;
    EXPECT_EQ(
        choose(street_view(), morning, town, town, static_cast<SurfacePoint<double>*>(nullptr), 0, given, limits).tried,
        every_fit);
}

TEST(MapSizeWithin, IsTheLargestMultipleOfFourThatFits) {
    EXPECT_EQ(map_size_within(4 * 2048 * 2048, 4, 8192), 2048);
    EXPECT_EQ(map_size_within(4 * 2048 * 2048 - 1, 4, 8192), 2044);
    EXPECT_EQ(map_size_within(4 * 2048 * 2048, 1, 1024), 1024);
    EXPECT_EQ(map_size_within(-5, 1, 1024), 0);
    EXPECT_EQ(map_size_within(std::int64_t(1) << 62, 1, 1 << 30), (1 << 21) - 4);
    EXPECT_EQ(map_size_within(100, 0, 1024), 0);
}
