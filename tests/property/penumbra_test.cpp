// SPDX-License-Identifier: MIT
#include "tests/laws/penumbra.hpp"
#include "tests/support/any_map.hpp"
#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

namespace {

template <class T>
class AnyPenumbra : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(AnyPenumbra, Scalars);

rc::Gen<Vec2<double>> in_disk() {
    return rc::gen::exec([] {
        double const reach = *uniform<double>(0.0, 1.0);
        double const angle = *uniform<double>(0.0, 6.283);
        return Vec2<double>(reach * std::cos(angle), reach * std::sin(angle));
    });
}

double radius_for(Light<double> const& light, double drawn) {
    return light.kind == LightKind::spot ? drawn : sun_radius(drawn * 0.2);
}

Vec4<double> receiver_in(ShadowMap<double> const& map, Vec3<double> const& point) {
    return place_from_world(map) * Vec4<double>(point, 1.0);
}

}  // namespace

TYPED_TEST(AnyPenumbra, OfAnythingAtAllIsFinite) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        ShadowMap<T> const map = *nasty_map<T>();
        auto const any = *any_map<T>();
        Light<T> light = any.light;
        bool const bad_light = *one_in(3);
        if (bad_light) light.direction = *nasty_vec3<T>();
        T const a = *nasty<T>();
        T const b = *nasty<T>();
        Vec3<T> const point = *nasty_vec3<T>();
        RC_ASSERT(laws::is_harmless(penumbra_for(map, light, a)));
        RC_ASSERT(laws::is_harmless(penumbra_for(any.map, light, a)));
        T const radius = sun_radius(a);
        RC_ASSERT(all_finite(&radius, 1) && radius >= T(0));
        for (Vec3<T> const& at : {point, Vec3<T>(T(1))}) {
            RC_ASSERT(laws::is_gap(gap_of_metres(light, at, a)));
            T const metres = metres_of_gap(light, at, b);
            RC_ASSERT(all_finite(&metres, 1) && metres >= T(0));
        }
        Vec2<T> const texels = kernel_texels(penumbra_for(any.map, any.light, a), Vec4<T>(point, b), 1024, b);
        RC_ASSERT(all_finite(texels));
    }));
}

TEST(PenumbraProperty, EachTapLiesOnTheRayFromThePointToItsPartOfTheLightInAnyMap) {
    EXPECT_TRUE(rc::check([] {
        auto const any = *any_map<double>();
        auto const point = *point_in(any.map);
        auto const drawn = *log_uniform<double>(1e-3, 1.0);
        auto const u = *in_disk();
        auto const gap = *log_uniform<double>(1e-3, any.light.kind == LightKind::spot ? 0.5 : 5.0);
        double const radius = radius_for(any.light, drawn);
        MapPenumbra<double> const penumbra = penumbra_for(any.map, any.light, radius);
        Vec4<double> const receiver = receiver_in(any.map, point);
        Vec4<double> on_ray = across(penumbra, receiver, u, gap);
        on_ray.z -= gap * penumbra.depth_of_gap;
        auto const truth = laws::place_of(any.map, laws::toward_disk(any.light, radius, point, u, gap));
        RC_PRE(on_ray.w > 0.1 * receiver.w);
        // The matrix has offsets of up to 1e3 where NDC has 1, w falls to a tenth: 1e4 of 2e-16, a dozen times.
        RC_ASSERT(laws::apart(Vec4<long double>(on_ray), truth) <= 1e-10L);
        RC_ASSERT(watched([&] { return penumbra_for(any.map, any.light, radius); }).calm_in_range());
    }));
}

TEST(PenumbraProperty, GapsAreMetresOfAnyLightInAnyMap) {
    EXPECT_TRUE(rc::check([] {
        auto const any = *any_map<double>();
        auto const point = *point_in(any.map);
        auto const gap = *log_uniform<double>(1e-2, any.light.kind == LightKind::spot ? 3.0 : 50.0);
        double const metres = metres_of_gap(any.light, point, gap);
        double const back = gap_of_metres(any.light, point, metres);
        // Metres over what is left of a distance: 1 + gap <= 4 times the rounding of metres. Far points and near lamps:
        // distance itself has lost 100 m / 0.1 m.
        RC_ASSERT(std::abs(back - gap) <= 1e-11 * gap);
        auto const occluder = laws::toward_disk(any.light, 0.0L, point, Vec2<double>(0.0), gap);
        auto const place = laws::place_of(any.map, occluder);
        MapPenumbra<double> const penumbra = penumbra_for(any.map, any.light, 0.1);
        double const seen = gap_at(penumbra, receiver_in(any.map, point), static_cast<double>(place.z / place.w));
        // Depths differ by gap * k / w, of which the matrix has lost 1e3 epsilon.
        double const per_depth = receiver_in(any.map, point).w / penumbra.depth_of_gap;
        RC_ASSERT(std::abs(seen - gap) <= 1e-12 * (per_depth + gap));
    }));
}

TEST(PenumbraProperty, IsLinearInTheSizeOfTheLight) {
    EXPECT_TRUE(rc::check([] {
        auto const any = *any_map<double>();
        auto const radius = *log_uniform<double>(1e-3, 1.0);
        MapPenumbra<double> const one = penumbra_for(any.map, any.light, radius);
        MapPenumbra<double> const four = penumbra_for(any.map, any.light, 4 * radius);
        RC_ASSERT(four.rim_x == one.rim_x * 4.0);
        RC_ASSERT(four.rim_y == one.rim_y * 4.0);
        RC_ASSERT(four.depth_of_gap == one.depth_of_gap);
        RC_ASSERT(penumbra_metres(4 * radius, 3.0) == 4 * penumbra_metres(radius, 3.0));
    }));
}

TEST(PenumbraProperty, IsTheSameInAWorldOfAnyScale) {
    EXPECT_TRUE(rc::check([] {
        auto const any = *any_map<double>();
        auto const point = *point_in(any.map);
        auto const power = static_cast<int>(*below(16)) - 8;
        double const scale = std::ldexp(1.0, power);
        bool const lamp = any.light.kind == LightKind::spot;
        ShadowMap<double> map = any.map;
        Light<double> light = any.light;
        for (int i = 0; i < 3; ++i) map.clip_from_world[i] /= scale;
        light.position *= scale;
        light.range *= scale;
        MapPenumbra<double> const here = penumbra_for(any.map, any.light, 0.1);
        MapPenumbra<double> const there = penumbra_for(map, light, lamp ? 0.1 * scale : 0.1);
        // Gaps of a sun are metres.
        double const gap = 0.25, scaled_gap = lamp ? gap : gap * scale;
        Vec2<double> const u(0.6, -0.3);
        RC_ASSERT(across(here, receiver_in(any.map, point), u, gap) ==
                  across(there, receiver_in(map, point * scale), u, scaled_gap));
    }));
}

TEST(PenumbraProperty, KernelTexelsBoundTheTaps) {
    EXPECT_TRUE(rc::check([] {
        auto const any = *any_map<double>();
        auto const point = *point_in(any.map);
        auto const u = *in_disk();
        auto const drawn = *log_uniform<double>(1e-3, 1.0);
        MapPenumbra<double> const penumbra = penumbra_for(any.map, any.light, radius_for(any.light, drawn));
        Vec4<double> const receiver = receiver_in(any.map, point);
        double const gap = 1e-4;  // to first order: in a warp a kernel is a disk seen at an angle
        Vec2<double> const most = kernel_texels(penumbra, receiver, 1024, gap);
        Vec4<double> const tap = across(penumbra, receiver, u, gap);
        Vec2<double> const off = Vec2<double>(tap) / tap.w - Vec2<double>(receiver) / receiver.w;
        RC_ASSERT(std::abs(off.x) * 1024 <= most.x * 1.001 + 1e-9);
        RC_ASSERT(std::abs(off.y) * 1024 <= most.y * 1.001 + 1e-9);
    }));
}
