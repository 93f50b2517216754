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

// With the sun nearly overhead a street wants a warp near the eye; each map of a warped choice has the strength that
// serves it best.
TEST(Choose, WarpsEachMapAsMuchAsHelpsIt) {
    Chosen const chosen;
    ChoiceLimits<double> limits;
    limits.motion = Motion::any;
    limits.goal = Goal::fewest_wrong;
    Choice<double> const choice = chosen.within(limits);
    ASSERT_EQ(choice.options.fit, CascadeFit::warped);
    auto const price_of_options = [&](CascadeOptions<double> const& options) {
        auto const cascades = fit_cascades(street_view(), morning, town, town, options);
        return judge(cascades, options.map_size, street_view(), limits.eye_pixels, chosen.samples.at.data(),
                     chosen.samples.count)
            .all.price;
    };
    EXPECT_EQ(price_of_options(choice.options), choice.judgement.all.price);
    for (std::size_t c = 0; c < std::size_t(choice.options.count); ++c) {
        CascadeOptions<double> all_of_it = choice.options;
        all_of_it.warp_less[c] = 0.0;
        EXPECT_LE(choice.judgement.all.price, price_of_options(all_of_it)) << c;
    }
}

TEST(Choose, KeepsStillWhatMustBeStill) {
    Chosen const chosen;
    ChoiceLimits<double> limits;
    EXPECT_EQ(chosen.within(limits).options.fit, CascadeFit::stable);
    limits.motion = Motion::at_ease;
    EXPECT_EQ(chosen.within(limits).options.steady_maps, 1);
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

TEST(MapSizeWithin, IsTheLargestMultipleOfFourThatFits) {
    EXPECT_EQ(map_size_within(4 * 2048 * 2048, 4, 8192), 2048);
    EXPECT_EQ(map_size_within(4 * 2048 * 2048 - 1, 4, 8192), 2044);
    EXPECT_EQ(map_size_within(4 * 2048 * 2048, 1, 1024), 1024);
    EXPECT_EQ(map_size_within(-5, 1, 1024), 0);
    EXPECT_EQ(map_size_within(std::int64_t(1) << 62, 1, 1 << 30), (1 << 21) - 4);
    EXPECT_EQ(map_size_within(100, 0, 1024), 0);
}
