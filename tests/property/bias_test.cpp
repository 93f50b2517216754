// SPDX-License-Identifier: MIT
#include "tests/laws/bias.hpp"
#include "tests/support/any_map.hpp"
#include "tests/support/watched.hpp"

#include <shadowmath/filter.hpp>

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

namespace {

// A plane through a map: lit, and leaning from the light by up to 84 degrees.
struct LitPlane {
    AnyMap<double> any;
    int map_size;
    Vec3<double> point, normal;
};

void showValue(LitPlane const& plane, std::ostream& out) {
    showValue(plane.any, out);
    out << " map size " << plane.map_size << " point ";
    showValue(plane.point, out);
    out << " normal ";
    showValue(plane.normal, out);
}

rc::Gen<LitPlane> lit_plane() {
    return rc::gen::exec([] {
        LitPlane plane;
        plane.any = *any_map<double>();
        plane.map_size = static_cast<int>(64 + *below(4000));
        plane.point = *point_in(plane.any.map);
        plane.normal = *normal_facing(plane.any.light, plane.point, 10.0);
        return plane;
    });
}

// Only what the kernel needs, and what rounding in double needs.
BiasOptions<double> bare(int filter_radius, bool tap_plane) {
    BiasOptions<double> options;
    options.flat_texels = 0;
    options.texels = 0;
    options.filter_radius = filter_radius;
    options.tap_plane = tap_plane;
    options.steepest = 1e6;
    options.depth_step = 1e-9;
    return options;
}

template <class T>
class AnyBias : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(AnyBias, Scalars);

}  // namespace

TYPED_TEST(AnyBias, OfAnythingAtAllIsFinite) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        ShadowMap<T> const map = *nasty_map<T>();
        auto const any = *any_map<T>();
        Light<T> light = any.light;
        bool const bad_light = *one_in(3);
        if (bad_light) light.direction = *nasty_vec3<T>();
        Vec3<T> const point = *nasty_vec3<T>();
        Vec3<T> const normal = *nasty_vec3<T>();
        Vec3<T> const inside = *point_in(any.map);
        BiasOptions<T> options;
        options.flat_texels = *nasty<T>();
        options.texels = *nasty<T>();
        options.metres = *nasty<T>();
        options.depth_step = *nasty<T>();
        options.steepest = *nasty<T>();
        auto const size = static_cast<int>(*below(5000)) - 1;
        for (ShadowMap<T> const& each : {map, any.map}) {
            RC_ASSERT(laws::is_harmless(bias_for(each, light, size, options)));
            RC_ASSERT(laws::is_harmless(bias_for(each, light, size, BiasOptions<T>{})));
            RC_ASSERT(laws::is_harmless(bias_at(each, light, size, options, point)));
            T const shift = depth_shift(each, light, inside, options.metres);
            RC_ASSERT(all_finite(&shift, 1) && shift >= T(0));
            RC_ASSERT(laws::is_within(slope(each, size, inside, normal, T(0.5)), T(0.5)));
            RC_ASSERT(laws::is_within(lean(each, size, inside, T(0.5)), T(0.5)));
            RC_ASSERT(laws::is_within(lean(each, size, point, T(0.5)), T(0.5)));
            RC_ASSERT(laws::is_within(slope(each, size, point, Vec3<T>(T(0), T(1), T(0)), T(0.5)), T(0.5)));
            T const amount = depth_bias(bias_for(each, light, size, options), options.metres, DepthSlope<T>{});
            RC_ASSERT(all_finite(&amount, 1) && amount >= T(0));
            T const offset = normal_offset_metres(options.metres, size, normal, point);
            RC_ASSERT(all_finite(&offset, 1) && offset >= T(0));
        }
        DepthSlope<T> const unlimited = slope(any.map, 1024, inside, normal, options.steepest);
        RC_ASSERT(all_finite(&unlimited.x, 1) && all_finite(&unlimited.y, 1));
    }));
}

TEST(BiasProperty, SlopePredictsTheDepthOfAPlaneAtEveryTexelOfAnyMap) {
    EXPECT_TRUE(rc::check([] {
        LitPlane const p = *lit_plane();
        DepthSlope<double> const s = slope(p.any.map, p.map_size, p.point, p.normal, 1e9);
        laws::RasterisedPlane<double> const raster(p.any.map, p.map_size, p.point, p.normal);
        auto const at = laws::texture_place(p.any.map, Vec3<long double>(p.point));
        auto const dx = static_cast<long double>(*centred<double>(8.0));
        auto const dy = static_cast<long double>(*centred<double>(8.0));
        long double const predicted = at.z + s.x * dx + s.y * dy;
        long double const there = raster.depth_at(at.x * p.map_size + dx, at.y * p.map_size + dy);
        // The matrix has offsets of up to 1e3 where NDC has 1, and the plane leans up to 10: 1e4 of 2e-16 each.
        RC_ASSERT(std::abs(predicted - there) <= 1e-9L * (1 + std::abs(there)));
    }));
}

TEST(BiasProperty, LeanIsTheSlopeOfThePlaneAcrossTheLightInAnyMap) {
    EXPECT_TRUE(rc::check([] {
        LitPlane const p = *lit_plane();
        DepthSlope<double> const own = lean(p.any.map, p.map_size, p.point, 1e9);
        DepthSlope<double> const across = slope(p.any.map, p.map_size, p.point, toward(p.any.light, p.point), 1e9);
        DepthSlope<double> const steep = slope(p.any.map, p.map_size, p.point, p.normal, 1e9);
        // The ray comes out of a matrix whose offsets are up to 1e3 where NDC has 1.
        double const scale = 1.0 + std::abs(across.x) + std::abs(across.y) + std::abs(steep.x) + std::abs(steep.y);
        RC_ASSERT(std::abs(own.x - across.x) <= 1e-9 * scale);
        RC_ASSERT(std::abs(own.y - across.y) <= 1e-9 * scale);
    }));
}

TEST(BiasProperty, ShiftIsWhatPullingThePointTowardTheLightDoesToItsDepth) {
    EXPECT_TRUE(rc::check([] {
        auto const any = *any_map<double>();
        auto const point = *point_in(any.map);
        auto metres = *log_uniform<double>(1e-4, 1.0);
        if (any.light.kind == LightKind::spot) metres = std::min(metres, 0.5 * glm::length(point - any.light.position));
        long double const measured = laws::measured_shift(any.map, any.light, point, metres);
        RC_PRE(measured < 1);
        RC_ASSERT(std::abs(depth_shift(any.map, any.light, point, metres) - measured) <= 1e-9L * (1 + measured));
        RC_ASSERT(watched([&] { return depth_shift(any.map, any.light, point, metres); }).calm());
    }));
}

TEST(BiasProperty, MetresAreExactEverywhereInAnyDirectionalMap) {
    EXPECT_TRUE(rc::check([] {
        auto const any = *any_directional_map<double>();
        auto const point = *point_in(any.map);
        BiasOptions<double> options = bare(0, true);
        MapBias<double> const none = bias_for(any.map, any.light, 1024, options);
        options.metres = *log_uniform<double>(1e-3, 0.5);
        MapBias<double> const some = bias_for(any.map, any.light, 1024, options);
        double const w = projected(any.map.clip_from_world, point).w;
        double const added = depth_bias(some, w, {}) - depth_bias(none, w, {});
        double const wanted = depth_shift(any.map, any.light, point, options.metres);
        RC_ASSERT(std::abs(added - wanted) <= 1e-12);
        RC_ASSERT(watched([&] { return bias_for(any.map, any.light, 1024, options); }).calm());
    }));
}

TEST(BiasProperty, MetresOfASpotAreNeverLessThanAskedForAndExactAtOnePoint) {
    EXPECT_TRUE(rc::check([] {
        auto const any = *any_spot_map<double>();
        auto const point = *point_in(any.map);
        BiasOptions<double> options = bare(0, true);
        MapBias<double> const none = bias_for(any.map, any.light, 1024, options);
        options.metres = *log_uniform<double>(1e-5, 1e-2);
        double const w = projected(any.map.clip_from_world, point).w;
        double const added = depth_bias(bias_for(any.map, any.light, 1024, options), w, {}) - depth_bias(none, w, {});
        double const wanted = depth_shift(any.map, any.light, point, options.metres);
        double const distance = glm::length(point - any.light.position);
        RC_ASSERT(added >= wanted * (1 - options.metres / distance) - 1e-12);
        double const here = depth_bias(bias_at(any.map, any.light, 1024, options, point), w, {});
        RC_ASSERT(std::abs(here - depth_bias(none, w, {}) - wanted) <= 1e-12);
    }));
}

TEST(BiasProperty, ALitPlaneNeverShadowsItselfWhateverKernelMapAndConvention) {
    EXPECT_TRUE(rc::check([] {
        LitPlane const p = *lit_plane();
        laws::RasterisedPlane<double> const raster(p.any.map, p.map_size, p.point, p.normal);
        auto const radius = static_cast<int>(*below(4));
        bool const tap_plane = *one_in(2);
        MapBias<double> const bias = bias_for(p.any.map, p.any.light, p.map_size, bare(radius, tap_plane));
        auto const stored = [&raster](int x, int y) { return static_cast<double>(raster(x, y)); };
        RC_ASSERT(visibility(p.any.map, p.map_size, p.point, p.normal, bias, {radius, tap_plane}, stored) >= 1 - 1e-12);
    }));
}

// The table's amount is not merely enough: with less than the kernel's reach the same planes shadow themselves
// somewhere.
TEST(BiasProperty, HalfATexelLessThanTheKernelNeedsIsTooLittle) {
    EXPECT_TRUE(rc::check([] {
        LitPlane const p = *lit_plane();
        auto const radius = static_cast<int>(*below(4));
        // The worst place: the point at that corner of its texel from which depth rises, where the opposite tap is
        // radius + 1/2 texels away on both axes.
        DepthSlope<double> const s = slope(p.any.map, p.map_size, p.point, p.normal, 1e9);
        auto const at = laws::texture_place(p.any.map, Vec3<long double>(p.point));
        auto const corner = [](long double texel, double rise) {
            return std::floor(texel) + (rise > 0 ? 0.999L : 0.001L);
        };
        laws::RasterisedPlane<double> const raster(p.any.map, p.map_size, p.point, p.normal);
        long double const x = corner(at.x * p.map_size, p.any.map.clip.depth == DepthOrder::one_to_zero ? -s.x : s.x);
        long double const y = corner(at.y * p.map_size, p.any.map.clip.depth == DepthOrder::one_to_zero ? -s.y : s.y);
        double const depth = static_cast<double>(raster.depth_at(x, y));
        RC_PRE(std::abs(s.x) + std::abs(s.y) > 1e-5);
        double const reach = 8 * (std::abs(s.x) + std::abs(s.y));  // beyond 0 and 1 depths are cut
        RC_PRE(depth > reach && depth < 1 - reach);
        double const amount = (kernel_reach_texels<double>(radius) - 0.5) * (std::abs(s.x) + std::abs(s.y));
        bool const reversed_depth = p.any.map.clip.depth == DepthOrder::one_to_zero;
        Receiver<double> const receiver{Vec2<double>(static_cast<double>(x), static_cast<double>(y)),
                                        reversed_depth ? depth + amount : depth - amount, s};
        auto const stored = [&raster](int i, int j) { return static_cast<double>(raster(i, j)); };
        RC_PRE(x > 8 && y > 8 && x < p.map_size - 8 && y < p.map_size - 8);
        RC_ASSERT(filtered(receiver, p.map_size, p.any.map.clip, {radius, false}, stored) < 1);
    }));
}

TEST(BiasProperty, ANormalOffsetAloneKeepsAPlaneFromShadowingItself) {
    EXPECT_TRUE(rc::check([] {
        Light<double> const light = *sun<double>();
        LightBox<double> box = *light_box_near_origin<double>(light);
        box.hi.y = box.lo.y + (box.hi.x - box.lo.x);  // texels are square, as the amount is one for both axes
        ShadowMap<double> map;
        map.clip = *clip_space();
        map.visible = true;
        map.clip_from_world = clip_from_world(box, map.clip);
        Vec3<double> const point = *point_in(map);
        Vec3<double> const normal = *normal_facing(light, point, 10.0);
        auto const radius = static_cast<int>(*below(4));
        double const offset =
            normal_offset_metres(texel_metres(box, 1024).x, radius, normal, toward(light, point)) + 1e-7;
        laws::RasterisedPlane<double> const raster(map, 1024, point, normal);
        auto const stored = [&raster](int x, int y) { return static_cast<double>(raster(x, y)); };
        RC_ASSERT(visibility(map, 1024, point + normal * offset, normal, {}, {radius, false}, stored) >= 1 - 1e-12);
    }));
}

// In warped maps too, whose texels differ from place to place and whose depth leans. A spot's amount is of first order,
// so it gets a hundredth on top.
TEST(BiasProperty, ANormalOffsetOfTheMapItselfIsEnoughInAnyMap) {
    EXPECT_TRUE(rc::check([] {
        LitPlane const p = *lit_plane();
        auto const radius = static_cast<int>(*below(4));
        double const offset = normal_offset_at(p.any.map, p.any.light, p.map_size, radius, p.point, p.normal, 1e3);
        RC_PRE(offset < 1e3);
        bool const is_sun = p.any.light.kind == LightKind::directional;
        RC_PRE(is_sun || offset < 1e-3 * glm::length(p.point - p.any.light.position));
        laws::RasterisedPlane<double> const raster(p.any.map, p.map_size, p.point, p.normal);
        auto const stored = [&raster](int x, int y) { return static_cast<double>(raster(x, y)); };
        double const moved = offset * (is_sun ? 1.0 + 1e-9 : 1.01) + 1e-9;
        RC_ASSERT(visibility(p.any.map, p.map_size, p.point + p.normal * moved, p.normal, {}, {radius, false},
                             stored) >= 1 - 1e-12);
    }));
}

// And no more than enough: over the plane, the moved point is lifted by the kernel's reach of slopes and nothing else.
TEST(BiasProperty, ANormalOffsetOfTheMapItselfLiftsByWhatTheKernelNeeds) {
    EXPECT_TRUE(rc::check([] {
        LitPlane const p = *lit_plane();
        auto const radius = static_cast<int>(*below(4));
        double const offset = normal_offset_at(p.any.map, p.any.light, p.map_size, radius, p.point, p.normal, 1e3);
        DepthSlope<double> const s = slope(p.any.map, p.map_size, p.point, p.normal, 1e6);
        double const needed = kernel_reach_texels<double>(radius) * (std::abs(s.x) + std::abs(s.y));
        bool const is_sun = p.any.light.kind == LightKind::directional;
        RC_PRE(offset < 1e3 && needed > 1e-6);
        RC_PRE(is_sun || offset < 1e-3 * glm::length(p.point - p.any.light.position));
        laws::RasterisedPlane<double> const raster(p.any.map, p.map_size, p.point, p.normal);
        auto const at = laws::texture_place(p.any.map, Vec3<long double>(p.point + p.normal * offset));
        long double const lifted = std::abs(raster.depth_at(at.x * p.map_size, at.y * p.map_size) - at.z);
        RC_ASSERT(std::abs(lifted - needed) <= (is_sun ? 1e-6L : 0.01L) * needed);
    }));
}

TEST(BiasProperty, ANormalOffsetOfAnythingIsBetweenZeroAndTheMost) {
    EXPECT_TRUE(rc::check([] {
        auto const map = *nasty_map<double>();
        auto const good = *any_map<double>();
        auto const light = *one_in(2) ? *spot_light<double>() : good.light;
        auto const point = *nasty_vec3<double>();
        auto const inside = *point_in(good.map);
        auto const normal = *one_in(3) ? *nasty_vec3<double>() : *direction<double>();
        auto const most = *nasty<double>();
        auto const size = static_cast<int>(*below(3000)) - 2;
        for (auto const& [m, p] : {std::pair{map, point}, std::pair{good.map, inside}}) {
            auto const run =
                watched([&, m = m, p = p] { return normal_offset_at(m, light, size, 2, p, normal, most); });
            RC_ASSERT(run.allocations == 0u && all_finite(&run.result, 1));
            RC_ASSERT(run.result >= 0.0 && (run.result == 0.0 || run.result <= most));
        }
    }));
}

TEST(BiasProperty, SlopesAreCutAtTheSteepestAngleAndNotBefore) {
    EXPECT_TRUE(rc::check([] {
        auto const any = *any_map<double>();
        auto const point = *point_in(any.map);
        auto const normal = *normal_facing(any.light, point, 5.0);
        BiasOptions<double> options = bare(0, true);
        // Where x and y of a map are not orthogonal one texel along x is longer than the gap between its columns: warps
        // of 0.8 skew to at most 1 / cos = 3.
        options.steepest = 15.0;
        MapBias<double> const bias = bias_for(any.map, any.light, 1024, options);
        DepthSlope<double> const s = slope(any.map, 1024, point, normal, 1e9);
        RC_ASSERT(std::max(std::abs(s.x), std::abs(s.y)) <= bias.slope_limit);
    }));
}
