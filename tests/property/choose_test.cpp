// SPDX-License-Identifier: MIT
#include "tests/laws/judge.hpp"
#include "tests/support/gen.hpp"
#include "tests/support/watched.hpp"

#include <shadowmath/choose.hpp>

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

namespace {

template <class T>
class ChooseProperty : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(ChooseProperty, Scalars);

TYPED_TEST(ChooseProperty, BeatsOptionsDrawnAtRandom) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        ViewVolume<T> view = *view_volume<T>();
        view.pose = *pose<T>(T(50));
        view.z_far = view.z_near * *log_uniform<T>(T(2), T(1e3));
        Light<T> const light = *sun<T>();
        Aabb<T> const world = *box<T>(T(100));
        CascadeOptions<T> given;
        ChoiceLimits<T> limits;
        limits.most_maps = 2;
        limits.goal = *one_in(2) ? Goal::least_mean : Goal::least_worst;
        limits.motion = static_cast<Motion>(*below(3));
        Samples<T> const samples = samples_in(view, light, world);
        auto const choice = choose(view, light, world, world, samples.at.data(), samples.count, given, limits);
        RC_ASSERT(laws::adds_up(choice.judgement));
        RC_ASSERT(choice.tried <= 2 * 5 * 29 + 2 * 2);
        if (!choice.visible) return;
        CascadeOptions<T> other = given;
        other.count = static_cast<int>(1 + *below(2));
        other.lambda = static_cast<T>(*below(11)) * T(0.1);
        other.map_size = map_size_within(limits.texels, other.count, limits.largest_map);
        if (limits.motion == Motion::any) other.fit = static_cast<CascadeFit>(*below(5));
        auto const cascades = fit_cascades(view, light, world, world, other);
        auto const judged = judge(cascades, other.map_size, view, limits.eye_pixels, samples.at.data(), samples.count);
        RC_ASSERT(laws::adds_up(judged));
        bool const by_worst = limits.goal == Goal::least_worst;
        T const mine = by_worst ? choice.judgement.all.worst : choice.judgement.all.mean;
        T const theirs = by_worst ? judged.all.worst : judged.all.mean;
        // A fiftieth is what an earlier candidate may be behind; and lambda on the grid differs by a rounding.
        RC_ASSERT(mine <= theirs * T(1.03));
    }));
}

TYPED_TEST(ChooseProperty, IsCalmForAnyInput) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        ViewVolume<T> const view = *nasty_view_volume<T>();
        Vec3<T> const travel = *nasty_vec3<T>();
        Aabb<T> const world = *nasty_box<T>();
        Light<T> const light = directional(travel);
        T const odd = *nasty<T>();
        ChoiceLimits<T> limits;
        limits.most_maps = 1;
        limits.motion = Motion::any;
        limits.eye_pixels.x = odd;
        auto const samples = watched([&] { return samples_in(view, light, world); });
        RC_ASSERT(samples.allocations == 0u);
        Samples<T> drawn = samples.result;
        for (int i = 0; i < drawn.count; ++i) RC_ASSERT(all_finite(drawn.at[static_cast<std::size_t>(i)].point));
        drawn.at[0] = {*nasty_vec3<T>(), *nasty_vec3<T>()};
        drawn.count = drawn.count > 0 ? drawn.count : 1;
        auto const choice =
            choose(view, light, world, world, drawn.at.data(), drawn.count, CascadeOptions<T>{}, limits);
        RC_ASSERT(laws::adds_up(choice.judgement));
    }));
}

}  // namespace
