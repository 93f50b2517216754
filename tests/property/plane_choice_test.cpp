// SPDX-License-Identifier: MIT
#include "tests/support/gen.hpp"
#include "tests/support/watched.hpp"

#include <shadowmath/plane_choice.hpp>

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

namespace {

template <class T>
class PlaneChoiceProperty : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(PlaneChoiceProperty, Scalars);

TYPED_TEST(PlaneChoiceProperty, LeastSquaresBeatAnyPlaneDrawn) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        ViewVolume<T> view = perspective_view(*pose<T>(T(3)), T(1), T(1.5), T(0.1), T(100));
        std::array<SurfacePoint<T>, 20> points;
        for (SurfacePoint<T>& p : points)
            p.point = point_at(view, *centred<T>(T(0.5)), *centred<T>(T(0.5)), *uniform<T>(T(1), T(30)));
        auto const cost = [&](ShadowPlane<T> const& plane) {
            T sum = T(0);
            for (SurfacePoint<T> const& p : points) {
                T const distance = (glm::dot(plane.normal, p.point) + plane.offset) / eye_depth(view, p.point);
                sum += distance * distance;
            }
            return sum;
        };
        auto const best = least_squares_plane(view, points.data(), 20);
        RC_PRE(glm::dot(best.normal, best.normal) > T(0));
        Vec3<T> const normal = *direction<T>();
        T const shift = *centred<T>(T(1));
        // A small turn and a small shift of it, and any other through the middle.
        Vec3<T> const near_normal = safe_normalize(best.normal + normal * T(0.05)).direction;
        T const noise = T(1e4) * std::numeric_limits<T>::epsilon();
        for (Vec3<T> const& other : {normal, near_normal, best.normal})
            RC_ASSERT(cost(best) <= cost({other, best.offset + shift}) * (T(1) + noise) + noise);
    }));
}

TYPED_TEST(PlaneChoiceProperty, TheWeightedMedianHasNoMoreThanHalfOfTheWeightOnEitherSide) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        ViewVolume<T> const view = perspective_view(*pose<T>(T(3)), T(1), T(1.5), T(0.1), T(100));
        Vec3<T> const normal = *direction<T>();
        std::array<SurfacePoint<T>, 20> points;
        for (SurfacePoint<T>& p : points)
            p.point = point_at(view, *centred<T>(T(0.5)), *centred<T>(T(0.5)), *uniform<T>(T(1), T(30)));
        auto const plane = weighted_median_plane(view, normal, points.data(), 20);
        T above = T(0), below = T(0), total = T(0);
        for (SurfacePoint<T> const& p : points) {
            T const depth = eye_depth(view, p.point), weight = T(1) / (depth * depth);
            T const height = glm::dot(plane.normal, p.point) + plane.offset;
            total += weight;
            if (height > T(1e-4)) above += weight;
            if (height < T(-1e-4)) below += weight;
        }
        RC_ASSERT(above <= total * T(0.50001));
        RC_ASSERT(below <= total * T(0.50001));
    }));
}

TYPED_TEST(PlaneChoiceProperty, IsFiniteAndCalmForAnyInput) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        ViewVolume<T> const view = *any_view<T>();
        Light<T> const light = *any_sun<T>();
        std::array<SurfacePoint<T>, 4> points;
        for (SurfacePoint<T>& p : points) {
            p.point = *one_in(3) ? *nasty_vec3<T>() : *point_within<T>(T(100));
            p.normal = *one_in(3) ? *nasty_vec3<T>() : *direction<T>();
        }
        Vec3<T> const ground = *nasty_vec3<T>();
        T const offset = *nasty<T>();
        ShadowPlane<T> const previous{ground, offset};
        T const hysteresis = *nasty<T>();
        auto const choice =
            watched([&] { return choose_plane(view, light, points.data(), 4, ground, &previous, hysteresis); });
        RC_ASSERT(choice.allocations == 0u);
        if (!choice.result.visible) return;
        RC_ASSERT(all_finite(choice.result.plane.normal) && all_finite(&choice.result.plane.offset, 1));
        RC_ASSERT(all_finite(&choice.result.distortion, 1) && choice.result.distortion >= T(0));
    }));
}

}  // namespace
