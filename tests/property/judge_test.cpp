// SPDX-License-Identifier: MIT
#include "tests/laws/judge.hpp"
#include "tests/support/any_map.hpp"
#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

namespace {

template <class T>
class JudgeProperty : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(JudgeProperty, Scalars);

TYPED_TEST(JudgeProperty, SamplesLieInTheBoxAndInView) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        ViewVolume<T> view = *view_volume<T>();
        view.pose = *pose<T>(T(50));
        view.z_far = view.z_near * *log_uniform<T>(T(2), T(1e4));
        Light<T> const light = *sun<T>();
        Aabb<T> const receivers = *box<T>(T(100));
        Samples<T> const samples = samples_in(view, light, receivers);
        RC_ASSERT(samples.count >= 0 && samples.count <= max_samples);
        T const size =
            glm::length(view.pose.position) + view.z_far * (T(1) + std::abs(view.left) + std::abs(view.right) +
                                                            std::abs(view.bottom) + std::abs(view.top));
        T const slack = T(64) * std::numeric_limits<T>::epsilon() * size;
        Aabb<T> const wide{receivers.lo - slack, receivers.hi + slack};
        for (int i = 0; i < samples.count; ++i) {
            SurfacePoint<T> const& p = samples.at[static_cast<std::size_t>(i)];
            T const depth = eye_depth(view, p.point);
            RC_ASSERT(contains(wide, p.point));
            RC_ASSERT(depth >= view.z_near - slack && depth <= view.z_far + slack);
            RC_ASSERT(std::abs(glm::length(p.normal) - T(1)) < T(1e-5));
        }
    }));
}

TYPED_TEST(JudgeProperty, AddsUpAndIsCalmForAnyMapsAndPoints) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        ViewVolume<T> const view = *any_view<T>();
        Cascades<T> cascades;
        cascades.count = static_cast<int>(1 + *below(3));
        T end = T(0);
        for (int i = 0; i < cascades.count; ++i) {
            ShadowMap<T> const good = (*any_map<T>()).map;
            ShadowMap<T> const odd = *nasty_map<T>();
            cascades.at[i].map = *one_in(3) ? odd : good;
            end += *log_uniform<T>(T(0.1), T(1000));
            cascades.at[i].range.end = end;
        }
        std::array<SurfacePoint<T>, 8> points;
        for (SurfacePoint<T>& p : points) {
            Vec3<T> const odd = *nasty_vec3<T>();
            Vec3<T> const good = *point_in(cascades.at[0].map);
            p.point = *one_in(3) ? odd : good;
            p.normal = *one_in(3) ? *nasty_vec3<T>() : *direction<T>();
        }
        Vec2<T> const pixels(T(1600), T(900));
        auto const run = watched([&] { return judge(cascades, 1024, view, pixels, points.data(), 8); });
        RC_ASSERT(run.allocations == 0u);
        RC_ASSERT(laws::adds_up(run.result));
        Worth<T> const alone = worth_of(cascades.at[0].map, 1024, view, pixels, points.data(), 8);
        RC_ASSERT(still_good(alone, alone));
        Worth<T> worse = alone;
        worse.worst = std::fmax(alone.worst, T(1)) * T(1.6);
        RC_ASSERT(!still_good(alone, worse));
        worse = alone;
        ++worse.unserved;
        RC_ASSERT(!still_good(alone, worse));
    }));
}

}  // namespace
