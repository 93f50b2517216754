// SPDX-License-Identifier: MIT
#include "tests/laws/pcss.hpp"
#include "tests/laws/bias.hpp"
#include "tests/support/any_map.hpp"
#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

namespace {

template <class T>
class AnyPcss : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(AnyPcss, Scalars);

template <class T>
rc::Gen<PcssOptions<T>> options() {
    return rc::gen::exec([] {
        PcssOptions<T> drawn;
        drawn.search_taps = static_cast<int>(1 + *below(40));
        drawn.filter_taps = static_cast<int>(1 + *below(40));
        T const angle = *uniform<T>(T(0), T(6.28));
        drawn.turn = Vec2<T>(std::cos(angle), std::sin(angle));
        return drawn;
    });
}

double radius_for(Light<double> const& light, double drawn) {
    return light.kind == LightKind::spot ? drawn : sun_radius(drawn * 0.2);
}

BiasOptions<double> only_rounding() {
    BiasOptions<double> options;
    options.flat_texels = 0;
    options.texels = 0;
    options.steepest = 1e6;
    options.depth_step = 1e-9;
    return options;
}

}  // namespace

namespace shadowmath {
inline namespace v0 {
template <class T>
void showValue(PcssOptions<T> const& options, std::ostream& out) {
    out << options.search_taps << " + " << options.filter_taps << " taps turned by ";
    glm::showValue(options.turn, out);
}
}  // namespace v0
}  // namespace shadowmath

TYPED_TEST(AnyPcss, OfAnythingAtAllIsAShareOfLight) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        ShadowMap<T> const map = *nasty_map<T>();
        auto const any = *any_map<T>();
        Vec3<T> const point = *nasty_vec3<T>();
        Vec3<T> const inside = *point_in(any.map);
        MapBias<T> bias;
        bias.constant = *nasty<T>();
        bias.slope_limit = *nasty<T>();
        MapPenumbra<T> penumbra = penumbra_for(any.map, any.light, T(0.1));
        std::uint64_t const broken = *below(5);
        T const bad = *nasty<T>();
        if (broken == 0) penumbra.rim_x = Vec4<T>(point, bad);
        if (broken == 1) penumbra.rim_y.w = bad;
        if (broken == 2) penumbra.depth_of_gap = bad;
        if (broken == 3) penumbra.largest_gap = bad;
        PcssOptions<T> taps = *options<T>();
        bool const bad_turn = *one_in(4);
        if (bad_turn) taps.turn = Vec2<T>(bad, T(0));
        T const nasty_depth = *nasty<T>();
        auto const stored = [nasty_depth](int x, int y) { return (x + y) % 2 == 0 ? nasty_depth : T(0.25); };
        auto const size = static_cast<int>(*below(64)) - 2;
        for (Vec3<T> const& at : {point, inside}) {
            RC_ASSERT(laws::is_soft_shadow(soft_visibility(map, size, at, point, bias, penumbra, taps, stored)));
            RC_ASSERT(laws::is_soft_shadow(soft_visibility(any.map, size, at, point, bias, penumbra, taps, stored)));
        }
        Receiver<T> receiver{Vec2<T>(T(3.5), T(4.25)), *nasty<T>(), {*nasty<T>(), T(0)}};
        RC_ASSERT(
            laws::is_soft_shadow(soft_filtered(receiver, *nasty<T>(), penumbra, size, any.map.clip, taps, stored)));
    }));
}

TEST(PcssProperty, ALitPlaneNeverShadowsItselfHoweverWideTheKernel) {
    EXPECT_TRUE(rc::check([] {
        auto const any = *any_map<double>();
        auto const map_size = static_cast<int>(64 + *below(4000));
        auto const point = *point_in(any.map);
        auto const normal = *normal_facing(any.light, point, 10.0);
        auto const drawn = *log_uniform<double>(1e-3, 1.0);
        auto const taps = *options<double>();
        laws::RasterisedPlane<double> const raster(any.map, map_size, point, normal);
        auto const stored = [&raster](int x, int y) { return static_cast<double>(raster(x, y)); };
        MapBias<double> const bias = bias_for(any.map, any.light, map_size, only_rounding());
        MapPenumbra<double> const penumbra = penumbra_for(any.map, any.light, radius_for(any.light, drawn));
        auto const shadow = soft_visibility(any.map, map_size, point, normal, bias, penumbra, taps, stored);
        RC_ASSERT(shadow.visibility == 1.0);
        RC_ASSERT(!shadow.blocked);
    }));
}

TEST(PcssProperty, TheGapOfAnOccluderIsTheSameMetresInEveryMapAndConvention) {
    EXPECT_TRUE(rc::check([] {
        auto any = *any_map<double>();
        auto const point = *point_in(any.map);
        auto const normal = *normal_facing(any.light, point, 3.0);
        auto const share = *uniform<double>(0.05, 0.9);
        auto const drawn = *log_uniform<double>(1e-3, 1.0);
        auto const map_size = static_cast<int>(64 + *below(4000));
        Mat4<double> const canonical = canonical_from_clip<double>(any.map.clip) * any.map.clip_from_world;
        MapPenumbra<double> const penumbra = penumbra_for(any.map, any.light, radius_for(any.light, drawn));
        double const gap = share * gap_at(penumbra, place_from_world(any.map) * Vec4<double>(point, 1.0), 0.0);
        RC_PRE(gap > 1e-6 && gap < 1e3);
        // A plane across the light that holds the occluder.
        Vec3<double> const way = any.light.kind == LightKind::spot ? any.light.position - point : -any.light.direction;
        double const metres = metres_of_gap(any.light, point, gap);
        Vec3<double> const occluder = point + glm::normalize(way) * metres;
        for (int depth = 0; depth < 3; ++depth) {
            any.map.clip.depth = static_cast<DepthOrder>(depth);
            any.map.clip_from_world = in_convention(canonical, any.map.clip);
            laws::RasterisedPlane<double> const raster(any.map, map_size, occluder, any.light.direction);
            auto const stored = [&raster](int x, int y) { return static_cast<double>(raster(x, y)); };
            MapBias<double> const bias{0, 0, 0, 1e6};
            MapPenumbra<double> const in_map = penumbra_for(any.map, any.light, radius_for(any.light, drawn));
            auto const found =
                soft_visibility(any.map, map_size, point, normal, bias, in_map, PcssOptions<double>{1, 1}, stored);
            RC_ASSERT(found.blocked);
            // Half a texel aside the plane across the light is as deep in the map, but for a lean. Depth has lost 1e3
            // epsilon to the offsets of the matrix.
            double const per_depth = (place_from_world(any.map) * Vec4<double>(point, 1.0)).w / in_map.depth_of_gap;
            DepthSlope<double> const leaning = lean(any.map, map_size, occluder, 1e6);
            double const in_reach = 1e-12 + std::abs(leaning.x) + std::abs(leaning.y);
            RC_ASSERT(std::abs(found.gap - gap) <= in_reach * per_depth);
        }
    }));
}

TEST(PcssProperty, AnOccluderOverEverythingLeavesNoLightWhereTheKernelStaysInTheMap) {
    EXPECT_TRUE(rc::check([] {
        auto const any = *any_map<double>();
        auto const point = *point_in(any.map);
        auto const normal = *normal_facing(any.light, point, 3.0);
        auto const taps = *options<double>();
        auto const stored = [&any](int, int) { return any.map.clip.depth == DepthOrder::one_to_zero ? 1.0 : 0.0; };
        MapPenumbra<double> const penumbra = penumbra_for(any.map, any.light, 1e-5);
        MapBias<double> const bias = bias_for(any.map, any.light, 1024, only_rounding());
        Vec4<double> const place = place_from_world(any.map) * Vec4<double>(point, 1.0);
        double const gap = gap_at(penumbra, place, 0.0);
        Vec2<double> const reach = kernel_texels(penumbra, place, 1024, gap);
        RC_PRE(reach.x < 20 && reach.y < 20);
        RC_PRE(place.z > 0.05 * place.w);
        auto const shadow = soft_visibility(any.map, 1024, point, normal, bias, penumbra, taps, stored);
        RC_ASSERT(shadow.blocked);
        RC_ASSERT(shadow.visibility == 0.0);
        RC_ASSERT(watched([&] {
                      return soft_visibility(any.map, 1024, point, normal, bias, penumbra, taps, stored);
                  }).calm_in_range());
    }));
}

TEST(PcssProperty, ALightWithoutSizeGivesTheFourTexelsAroundThePoint) {
    EXPECT_TRUE(rc::check([] {
        constexpr int side = 16;
        std::array<double, side * side> depths{};
        for (double& depth : depths) depth = static_cast<double>(*below(17)) / 16;
        auto const stored = [&depths](int x, int y) { return depths[static_cast<std::size_t>(y * side + x)]; };
        Receiver<double> receiver;
        receiver.texel.x = *uniform<double>(2.0, side - 2.0);
        receiver.texel.y = *uniform<double>(2.0, side - 2.0);
        receiver.depth = static_cast<double>(*below(17)) / 16;
        auto const taps = *options<double>();
        MapPenumbra<double> const penumbra;
        SoftShadow<double> const shadow =
            soft_filtered(receiver, 1.0, penumbra, side, gl_zero_to_one_clip, taps, stored);
        double lit = 0;
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                double const dx = 1 - std::abs(receiver.texel.x - x - 0.5),
                             dy = 1 - std::abs(receiver.texel.y - y - 0.5);
                if (dx > 0 && dy > 0 && receiver.depth <= stored(x, y)) lit += dx * dy;
            }
        RC_ASSERT(std::abs(shadow.visibility - lit) <= 1e-13);
    }));
}
