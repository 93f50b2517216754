// SPDX-License-Identifier: MIT
#include "tests/laws/moments.hpp"
#include "tests/support/kernels.hpp"
#include "tests/support/watched.hpp"

#include <shadowmath/msm.hpp>
#include <shadowmath/vsm.hpp>

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

namespace {

template <class T>
class AnyMoments : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(AnyMoments, Scalars);

// One in five at an atom, where shares jump.
rc::Gen<double> receiver_for(laws::Kernel kernel) {
    return rc::gen::exec([=] {
        bool const at_atom = *one_in(5);
        double const anywhere = *uniform<double>(0.0, 1.0);
        return at_atom ? kernel.depth.front() : anywhere;
    });
}

template <class T>
rc::Gen<EvsmExponents<T>> exponents() {
    return rc::gen::exec([] {
        EvsmExponents<T> drawn;
        drawn.growing = *uniform<T>(T(0.5), T(10));
        drawn.falling = *uniform<T>(T(0.5), T(10));
        return drawn;
    });
}

Vec4<double> through_16_bits(Vec4<double> const& moments) {
    Vec4<double> packed = msm_packed(moments);
    for (int k = 0; k < 4; ++k) packed[k] = std::round(packed[k] * 65535) / 65535;
    return msm_unpacked(packed);
}

}  // namespace

TYPED_TEST(AnyMoments, OfAnythingAtAllAreAShareOfLight) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        T const a = *nasty<T>();
        T const b = *nasty<T>();
        Vec3<T> const c = *nasty_vec3<T>();
        Vec4<T> const four(c, a);
        EvsmExponents<T> const warp{b, a};
        RC_ASSERT(laws::is_share_of_light(vsm_visibility(Vec2<T>(c), a, b)));
        RC_ASSERT(laws::is_share_of_light(evsm_visibility(four, b, warp, a)));
        RC_ASSERT(laws::is_share_of_light(msm_visibility(four, b, a)));
        RC_ASSERT(laws::is_share_of_light(less_bleeding(a, b)));
        RC_ASSERT(all_finite(vsm_moments(a)) && all_finite(msm_moments(a)) && all_finite(evsm_moments(a, warp)));
        RC_ASSERT(all_finite(msm_packed(msm_moments(a))));
        T const depth = *uniform<T>(T(0), T(1));
        T const off = *centred<T>(T(1e-3));
        Vec4<T> const noise = msm_moments(depth) + Vec4<T>(off, T(0), -off, off);
        RC_ASSERT(laws::is_share_of_light(msm_visibility(noise, depth, T(0))));
    }));
}

TYPED_TEST(AnyMoments, AreNeverDarkerThanTheKernel) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        laws::Kernel const drawn = *kernel(6);
        auto const receiver = static_cast<T>(*receiver_for(drawn));
        auto const warp = *exponents<T>();
        double const truth = drawn.lit(receiver), eps = std::numeric_limits<T>::epsilon();
        auto const vsm = drawn.mean<T>(vsm_moments<T>);
        auto const evsm = drawn.mean<T>([&warp](T depth) { return evsm_moments(depth, warp); });
        auto const msm = drawn.mean<T>(msm_moments<T>);
        // The variance v has lost 12 eps of the mean square, which is at most v + 2 d^2 + 2 w^2 for a receiver at w and
        // d from the mean; v / (v + d^2) changes by d^2 / (v + d^2)^2 of that, and v is at least (deviation w)^2.
        T const deviation = T(0.01);
        double const lost = 24 * eps + 6 * eps / 1e-4;
        RC_ASSERT(vsm_visibility(vsm, receiver, deviation) >= truth - lost);
        RC_ASSERT(evsm_visibility(evsm, receiver, warp, deviation) >= truth - lost);
        T const bias = sizeof(T) == 4 ? msm_bias_float<T> : T(1e-9);
        RC_ASSERT(msm_visibility(msm, receiver, bias) >= (1 - static_cast<double>(bias)) * truth - 64 * eps);
        RC_ASSERT(watched([&] { return msm_visibility(msm, receiver, bias); }).calm_in_range());
        RC_ASSERT(watched([&] { return evsm_visibility(evsm, receiver, warp, deviation); }).calm_in_range());
    }));
}

TEST(MomentsProperty, NeverGrowWithTheReceiversDepth) {
    EXPECT_TRUE(rc::check([] {
        laws::Kernel const drawn = *kernel(6);
        auto const warp = *exponents<double>();
        auto const vsm = drawn.mean<double>(vsm_moments<double>);
        auto const evsm = drawn.mean<double>([&warp](double depth) { return evsm_moments(depth, warp); });
        auto const msm = drawn.mean<double>(msm_moments<double>);
        RC_ASSERT(laws::never_grows([&](double depth) { return vsm_visibility(vsm, depth, 1e-4); }, 1e-12));
        RC_ASSERT(laws::never_grows([&](double depth) { return evsm_visibility(evsm, depth, warp, 0.0); }, 1e-9));
        RC_ASSERT(laws::never_grows([&](double depth) { return msm_visibility(msm, depth, 1e-6); }, 1e-9));
    }));
}

TEST(MomentsProperty, FourMomentsAreSharperThanTwo) {
    EXPECT_TRUE(rc::check([] {
        laws::Kernel const drawn = *kernel(6);
        auto const receiver = *uniform<double>(0.0, 1.0);
        constexpr double bias = 1e-6;
        Vec4<double> const msm = drawn.mean<double>(msm_moments<double>);
        // Cantelli's bound of the same biased moments; z is twice the depth.
        double const mean = msm.x * (1 - bias), square = msm.y * (1 - bias) + 0.375 * bias, z = 2 * receiver - 1;
        double const variance = square - mean * mean, distance = z - mean;
        double const cantelli = distance > 0 ? variance / (variance + distance * distance) : 1.0;
        RC_ASSERT(msm_visibility(msm, receiver, bias) <= cantelli + 1e-8);
    }));
}

TEST(MomentsProperty, FourMomentsAreExactForTwoDepths) {
    EXPECT_TRUE(rc::check([] {
        laws::Kernel const drawn = *kernel(2);
        auto const receiver = *uniform<double>(0.0, 1.0);
        RC_PRE(drawn.distance_to(receiver) > 0.05);
        double const apart = std::abs(drawn.depth.front() - drawn.depth.back());
        RC_PRE(apart == 0 || apart > 0.1);
        auto const msm = drawn.mean<double>(msm_moments<double>);
        // The bias counts for as much more as the atoms are close: 1 / 0.1^2 twice.
        RC_ASSERT(std::abs(msm_visibility(msm, receiver, 1e-10) - drawn.lit(receiver)) <= 1e-6);
    }));
}

TEST(MomentsProperty, AreExactWhereTheKernelHoldsOneDepth) {
    EXPECT_TRUE(rc::check([] {
        auto const depth = *uniform<double>(0.0, 1.0);
        auto const receiver = *uniform<double>(0.0, 1.0);
        RC_PRE(std::abs(depth - receiver) > 0.01);
        double const lit = depth > receiver ? 1.0 : 0.0;
        auto const warp = *exponents<double>();
        RC_ASSERT(std::abs(vsm_visibility(vsm_moments(depth), receiver, 0.0) - lit) <= 1e-10);
        RC_ASSERT(std::abs(evsm_visibility(evsm_moments(depth, warp), receiver, warp, 0.0) - lit) <= 1e-6);
        RC_ASSERT(std::abs(msm_visibility(msm_moments(depth), receiver, 1e-12) - lit) <= 1e-4);
    }));
}

TEST(MomentsProperty, SixteenBitsAndTheirBiasStayOnTheSideOfLight) {
    EXPECT_TRUE(rc::check([] {
        laws::Kernel const drawn = *kernel(6);
        auto const receiver = *receiver_for(drawn);
        auto const stored = drawn.mean<double>([](double depth) { return through_16_bits(msm_moments(depth)); });
        double const share = msm_visibility(stored, receiver, msm_bias_16_bits<double>);
        RC_ASSERT(share >= drawn.lit(receiver) - 2 * msm_bias_16_bits<double>);
    }));
}

TEST(MomentsProperty, PackingIsUndoneAndMaySumMixtures) {
    EXPECT_TRUE(rc::check([] {
        laws::Kernel const drawn = *kernel(6);
        auto const moments = drawn.mean<double>(msm_moments<double>);
        auto const packed = drawn.mean<double>([](double depth) { return msm_packed(msm_moments(depth)); });
        auto const back = msm_unpacked(packed);
        for (int k = 0; k < 4; ++k) {
            RC_ASSERT(packed[k] >= -1e-15 && packed[k] <= 1 + 1e-15);
            RC_ASSERT(std::abs(back[k] - moments[k]) <= 32 * std::numeric_limits<double>::epsilon());
        }
    }));
}

TEST(MomentsProperty, MeanOfABoxIsLinearInWhatTheTexelsHold) {
    EXPECT_TRUE(rc::check([] {
        constexpr int side = 12;
        auto const x = *uniform<double>(-4.0, side + 4.0);
        auto const y = *uniform<double>(-4.0, side + 4.0);
        auto const radius = static_cast<int>(*below(4));
        auto const seed = *below(1000);
        auto const first = [seed](int i, int j) {
            return Vec2<double>(static_cast<double>((static_cast<std::uint64_t>(i * 31 + j * 17) + seed) % 16) / 16);
        };
        auto const second = [seed](int i, int j) {
            return Vec2<double>(static_cast<double>((static_cast<std::uint64_t>(i * 7 + j * 29) + seed) % 16) / 16);
        };
        auto const mean = [&](auto const& of, Vec2<double> const& outside) {
            return mean_moments(Vec2<double>(x, y), side, radius, outside, of);
        };
        auto const mixed = [&](int i, int j) { return first(i, j) * 0.25 + second(i, j) * 0.75; };
        Vec2<double> const one(1.0), half(0.5);
        Vec2<double> const apart = mean(first, one) * 0.25 + mean(second, half) * 0.75;
        Vec2<double> const together = mean(mixed, one * 0.25 + half * 0.75);
        RC_ASSERT(std::abs(apart.x - together.x) <= 1e-14);
        RC_ASSERT(together.x >= 0.0 && together.x <= 1.0 + 1e-14);
    }));
}
