// SPDX-License-Identifier: MIT
#include "tests/laws/by_footprint.hpp"
#include "tests/support/any_map.hpp"
#include "tests/support/watched.hpp"

#include <shadowmath/plane_set.hpp>

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

namespace {

template <class T>
class PlaneSetProperty : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(PlaneSetProperty, Scalars);

TYPED_TEST(PlaneSetProperty, NoTangentPlaneServesMoreThanTheFirst) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        ViewVolume<T> const view = perspective_view(*pose<T>(T(3)), T(1), T(1.5), T(0.1), T(100));
        Light<T> const light = *sun<T>();
        std::array<SurfacePoint<T>, 24> points;
        std::array<Vec3<T>, 3> const normals{*direction<T>(), *direction<T>(), *direction<T>()};
        for (SurfacePoint<T>& p : points) {
            p.point = point_at(view, *centred<T>(T(0.5)), *centred<T>(T(0.5)), *uniform<T>(T(1), T(30)));
            p.normal = normals[*below(3)];
        }
        PlaneSetOptions<T> const options;
        auto const planes = choose_planes(view, light, points.data(), 24, options);
        Samples<T> lit;
        for (SurfacePoint<T> const& p : points)
            if (!faces_away(light, p.point, p.normal)) lit.at[static_cast<std::size_t>(lit.count++)] = p;
        Mat4<T> const eye = clip_from_world(view, ClipSpace{});
        T total = T(0);
        for (int i = 0; i < planes.count; ++i) {
            T const share = planes.share[static_cast<std::size_t>(i)];
            RC_ASSERT(share >= options.least_share);
            if (i > 0) RC_ASSERT(share <= planes.share[static_cast<std::size_t>(i - 1)]);
            total += share;
        }
        RC_ASSERT(total <= T(1.0001));
        T const first = planes.count > 0 ? planes.share[0] : options.least_share;
        for (int i = 0; i < lit.count; ++i) {
            SurfacePoint<T> const& p = lit.at[static_cast<std::size_t>(i)];
            int const served =
                detail::well_served(plane_through(p.point, p.normal), eye, light, lit, options.good_pixels);
            RC_ASSERT(T(served) <= first * T(lit.count) * T(1.0001));
        }
    }));
}

TYPED_TEST(PlaneSetProperty, ByFootprintIsTheFinestOfAnyMapsWhateverThePoint) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        std::array<ShadowMap<T>, 3> maps;
        for (ShadowMap<T>& map : maps) map = (*any_map<T>()).map;
        bool const spoilt = *one_in(3);
        if (spoilt) maps[1] = *nasty_map<T>();
        auto const view = *view_volume<T>();
        auto const eye = clip_from_world(view, ClipSpace{});
        auto const inside = *point_in(maps[0]);
        auto const anywhere = *nasty_vec3<T>();
        auto const point = *one_in(4) ? anywhere : inside;
        auto const good_normal = *direction<T>();
        auto const normal = *one_in(4) ? anywhere : good_normal;
        auto const band = *nasty<T>();
        auto const run = watched([&] {
            return by_footprint(maps.data(), 3, 1024, T(2), eye, Vec2<T>(T(1600), T(900)), point, normal, band);
        });
        RC_ASSERT(run.allocations == 0u);
        RC_ASSERT(
            laws::is_finest(run.result, maps.data(), 3, 1024, T(2), eye, Vec2<T>(T(1600), T(900)), point, normal));
    }));
}

TYPED_TEST(PlaneSetProperty, IsFiniteAndCalmForAnyInput) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        ViewVolume<T> const view = *any_view<T>();
        Light<T> const light = *any_sun<T>();
        std::array<SurfacePoint<T>, 4> points;
        for (SurfacePoint<T>& p : points) {
            p.point = *one_in(3) ? *nasty_vec3<T>() : *point_within<T>(T(100));
            p.normal = *one_in(3) ? *nasty_vec3<T>() : *direction<T>();
        }
        PlaneSetOptions<T> options;
        bool const odd = *one_in(3);
        T const number = *nasty<T>();
        if (odd) options.good_pixels = options.least_share = options.hysteresis = number;
        options.most = static_cast<int>(*below(12)) - 3;
        PlaneSet<T> last;
        last.count = static_cast<int>(*below(9)) - 2;
        last.at[0] = {light.direction, number};
        auto const run = watched([&] { return choose_planes(view, light, points.data(), 4, options, &last); });
        RC_ASSERT(run.allocations == 0u);
        RC_ASSERT(run.result.count >= 0 && run.result.count <= max_planes);
        for (int i = 0; i < run.result.count; ++i) {
            auto const& plane = run.result.at[static_cast<std::size_t>(i)];
            RC_ASSERT(all_finite(plane.normal) && all_finite(&plane.offset, 1));
        }
    }));
}

}  // namespace
