// SPDX-License-Identifier: MIT
#include "tests/laws/filter.hpp"
#include "tests/support/any_map.hpp"
#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

namespace {

constexpr int side = 24;

// Depths in sixteenths, so that all of them, their complements and their shifts are exact.
struct Depths {
    std::array<double, side * side> at{};
    [[nodiscard]] double operator()(int x, int y) const { return at[static_cast<std::size_t>(y * side + x)]; }
};

void showValue(Depths const& depths, std::ostream& out) {
    out << "depths, the first " << depths.at[0];
}

rc::Gen<Depths> depths() {
    return rc::gen::exec([] {
        Depths drawn;
        for (double& depth : drawn.at) depth = static_cast<double>(*below(17)) / 16;
        return drawn;
    });
}

rc::Gen<Receiver<double>> receiver() {
    return rc::gen::exec([] {
        Receiver<double> drawn;
        drawn.texel.x = *uniform<double>(-6.0, side + 6.0);
        drawn.texel.y = *uniform<double>(-6.0, side + 6.0);
        drawn.depth = static_cast<double>(*below(17)) / 16;
        return drawn;
    });
}

constexpr ClipSpace plain = gl_zero_to_one_clip;

template <class T>
class AnyFilter : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(AnyFilter, Scalars);

}  // namespace

TYPED_TEST(AnyFilter, OfAnythingAtAllIsAShareOfLight) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        Receiver<T> r;
        r.texel.x = *nasty<T>();
        r.texel.y = T(3.5);
        r.depth = *nasty<T>();
        r.slope.x = *nasty<T>();
        T const stored = *nasty<T>();
        auto const radius = static_cast<int>(*below(6)) - 1;
        auto const size = static_cast<int>(*below(64)) - 2;
        auto const depth = [stored](int, int) { return stored; };
        RC_ASSERT(laws::is_share(filtered(r, size, plain, {radius, true}, depth)));
        r.texel.x = T(4.25);
        RC_ASSERT(laws::is_share(filtered(r, size, reversed(plain), {radius, true}, depth)));
        ShadowMap<T> const map = *nasty_map<T>();
        Vec3<T> const point = *nasty_vec3<T>();
        Vec3<T> const inside = *point_in((*any_map<T>()).map);
        MapBias<T> bias;
        bias.constant = *nasty<T>();
        bias.slope_limit = *nasty<T>();
        RC_ASSERT(laws::is_share(visibility(map, size, point, point, bias, {radius, true}, depth)));
        RC_ASSERT(laws::is_share(visibility(map, size, inside, point, bias, {radius, true}, depth)));
    }));
}

TEST(FilterProperty, WeightsOfAnAxisSumToOne) {
    EXPECT_TRUE(rc::check([] {
        auto const radius = static_cast<int>(*below(8));
        auto const fraction = *uniform<double>(0.0, 1.0);
        double sum = 0;
        for (int tap = -radius; tap <= radius; ++tap) sum += tap_weight(tap, radius, fraction);
        RC_ASSERT(std::abs(sum - 1) <= 32 * std::numeric_limits<double>::epsilon());
    }));
}

TEST(FilterProperty, IsTheShareOfABoxThatLiesOverLitTexelsAndOutsideIsLit) {
    EXPECT_TRUE(rc::check([] {
        Depths const map = *depths();
        Receiver<double> const r = *receiver();
        auto const radius = static_cast<int>(1 + *below(4));
        auto const is_lit = [&](int x, int y) {
            return x < 0 || y < 0 || x >= side || y >= side || r.depth <= map(x, y);
        };
        double const wanted = laws::lit_share_of_box(r.texel, radius, is_lit);
        // 81 taps of two products each.
        RC_ASSERT(std::abs(filtered(r, side, plain, {radius, true}, map) - wanted) <= 512 * 2.3e-16);
    }));
}

TEST(FilterProperty, OfRadiusZeroIsTheTexelThatHoldsThePoint) {
    EXPECT_TRUE(rc::check([] {
        Depths const map = *depths();
        Receiver<double> const r = *receiver();
        auto const x = static_cast<int>(std::floor(r.texel.x)), y = static_cast<int>(std::floor(r.texel.y));
        bool const lit = x < 0 || y < 0 || x >= side || y >= side || r.depth <= map(x, y);
        RC_ASSERT(filtered(r, side, plain, {0, true}, map) == (lit ? 1.0 : 0.0));
    }));
}

TEST(FilterProperty, ChangesByNoMoreThanTheStripThatTheBoxSweeps) {
    EXPECT_TRUE(rc::check([] {
        Depths const map = *depths();
        Receiver<double> const r = *receiver();
        auto const radius = static_cast<int>(1 + *below(4));
        Receiver<double> moved = r;
        moved.texel.x += *centred<double>(0.3);
        moved.texel.y += *centred<double>(0.3);
        double const sweep =
            (std::abs(moved.texel.x - r.texel.x) + std::abs(moved.texel.y - r.texel.y)) / (2.0 * radius);
        double const change =
            filtered(r, side, plain, {radius, true}, map) - filtered(moved, side, plain, {radius, true}, map);
        RC_ASSERT(std::abs(change) <= sweep + 1e-13);
    }));
}

TEST(FilterProperty, OnlyDifferencesOfDepthCount) {
    EXPECT_TRUE(rc::check([] {
        Depths map = *depths();
        Receiver<double> r = *receiver();
        auto const radius = static_cast<int>(*below(4));
        for (double& depth : map.at) depth = depth / 2;
        r.depth = r.depth / 2;
        double const before = filtered(r, side, plain, {radius, true}, map);
        double const shift = static_cast<double>(*below(9)) / 16;
        for (double& depth : map.at) depth += shift;
        r.depth += shift;
        RC_ASSERT(filtered(r, side, plain, {radius, true}, map) == before);
    }));
}

TEST(FilterProperty, AnOccluderNeverBrightens) {
    EXPECT_TRUE(rc::check([] {
        Depths map = *depths();
        Receiver<double> const r = *receiver();
        auto const radius = static_cast<int>(*below(4));
        double const before = filtered(r, side, plain, {radius, true}, map);
        map.at[*below(side * side)] = 0;
        RC_ASSERT(filtered(r, side, plain, {radius, true}, map) <= before);
    }));
}

TEST(FilterProperty, ReversedDepthGivesTheSameShare) {
    EXPECT_TRUE(rc::check([] {
        Depths const map = *depths();
        Receiver<double> r = *receiver();
        auto const radius = static_cast<int>(*below(4));
        r.slope = {static_cast<double>(*below(5)) / 64, -static_cast<double>(*below(5)) / 64};
        double const forward = filtered(r, side, plain, {radius, true}, map);
        r.depth = 1 - r.depth;
        r.slope = {-r.slope.x, -r.slope.y};
        auto const complement = [&map](int x, int y) { return 1 - map(x, y); };
        RC_ASSERT(filtered(r, side, reversed(plain), {radius, true}, complement) == forward);
    }));
}

// One blocker that covers half of the map, seen in every convention.
TEST(FilterProperty, EveryConventionDecidesAlike) {
    EXPECT_TRUE(rc::check([] {
        auto any = *any_map<double>();
        auto const point = *point_in(any.map);
        auto const normal = *normal_facing(any.light, point, 3.0);
        auto const blocker = *uniform<double>(0.05, 0.95);
        Mat4<double> const canonical = canonical_from_clip<double>(any.map.clip) * any.map.clip_from_world;
        double first = -1;
        for (int depth = 0; depth < 3; ++depth) {
            for (int axes = 0; axes < 4; ++axes) {
                ClipSpace clip{static_cast<DepthOrder>(depth), static_cast<YAxis>(axes % 2),
                               static_cast<YAxis>(axes / 2)};
                any.map.clip = clip;
                any.map.clip_from_world = in_convention(canonical, clip);
                bool const flipped = clip.texture_v == YAxis::down;
                auto const stored = [&](int x, int y) {
                    double const d = x + 2 * (flipped ? 63 - y : y) < 96 ? blocker : 1.0;
                    return clip.depth == DepthOrder::one_to_zero ? 1 - d : d;
                };
                MapBias<double> const bias = bias_for(any.map, any.light, 64, BiasOptions<double>{});
                double const share = visibility(any.map, 64, point, normal, bias, {2, true}, stored);
                if (first < 0) first = share;
                RC_ASSERT(std::abs(share - first) <= 1e-9);
            }
        }
    }));
}

TEST(FilterProperty, RaisesNothingAndAllocatesNothing) {
    EXPECT_TRUE(rc::check([] {
        auto const any = *any_map<double>();
        auto const point = *point_in(any.map);
        auto const normal = *normal_facing(any.light, point, 3.0);
        MapBias<double> const bias = bias_for(any.map, any.light, side, BiasOptions<double>{});
        Depths const map = *depths();
        RC_ASSERT(watched([&] { return visibility(any.map, side, point, normal, bias, {}, map); }).calm_in_range());
    }));
}
