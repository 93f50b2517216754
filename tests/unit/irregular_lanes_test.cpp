// SPDX-License-Identifier: MIT
//
// Every kind of lanes does what an array does.
#include <shadowmath/irregular/lanes.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>

using namespace shadowmath;

namespace {

template <class Lanes>
class AnyLanes : public ::testing::Test {};
using Kinds = ::testing::Types<PlainLanes<float>, PlainLanes<double>, BestLanes<float>
#if defined(__AVX2__) && defined(__FMA__)
                               ,
                               Avx2Lanes
#endif
                               >;
TYPED_TEST_SUITE(AnyLanes, Kinds);

template <class Lanes, class T = typename Lanes::Scalar>
std::array<T, 16> numbers(Lanes const& lanes) {
    std::array<T, 16> stored;
    lanes.store(stored.data());
    return stored;
}

template <class T>
constexpr std::array<T, 16> some{1, -2, 3, T(-0.5), 7, T(0.25), -8, T(1.5), 2, -3, T(0.125), 9, -11, 4, -6, 5};
template <class T>
constexpr std::array<T, 16> others{2, -3, 3, T(0.5), -7, T(0.5), 8, T(-1.5), 2, 3, T(-0.125), 1, 11, -4, 6, T(-2.5)};

}  // namespace

TYPED_TEST(AnyLanes, DoToEachLaneWhatIsDoneToANumber) {
    using T = typename TypeParam::Scalar;
    TypeParam const a = TypeParam::load(some<T>.data()), b = TypeParam::load(others<T>.data()),
                    c = TypeParam::all(T(0.75));
    for (std::size_t k = 0; k < 16; ++k) {
        T const x = some<T>[k], y = others<T>[k];
        EXPECT_EQ(numbers(a + b)[k], x + y);
        EXPECT_EQ(numbers(a - b)[k], x - y);
        EXPECT_EQ(numbers(a * b)[k], x * y);
        EXPECT_EQ(numbers(a / b)[k], x / y);
        EXPECT_EQ(numbers(least(a, b))[k], std::min(x, y));
        EXPECT_EQ(numbers(most(a, b))[k], std::max(x, y));
        EXPECT_EQ(numbers(absolute(a))[k], std::abs(x));
        EXPECT_EQ(numbers(with_sign_of(c, b))[k], std::copysign(T(0.75), y));
        EXPECT_EQ(numbers(fused(a, b, c))[k], x * y + T(0.75)) << "exact in these numbers";
        EXPECT_NEAR(numbers(reciprocal(b))[k] * y, T(1), T(4) * std::numeric_limits<T>::epsilon());
        EXPECT_EQ(at_least(a, b) >> k & 1u, x >= y ? 1u : 0u);
        EXPECT_EQ(numbers(chosen(0x5a3cu, a, b))[k], (0x5a3cu >> k & 1u) != 0 ? x : y);
    }
    EXPECT_EQ(smallest(a), T(-11));
    EXPECT_EQ(largest(a), T(9));
    EXPECT_EQ(numbers(c)[11], T(0.75));
}

TYPED_TEST(AnyLanes, FindNothingAtLeastNaN) {
    using T = typename TypeParam::Scalar;
    std::array<T, 16> broken = some<T>;
    broken[5] = std::numeric_limits<T>::quiet_NaN();
    TypeParam const a = TypeParam::load(broken.data()), zero = TypeParam::all(T(-100));
    EXPECT_EQ(at_least(a, zero), 0xffdfu);
    EXPECT_EQ(at_least(TypeParam::all(T(100)), a), 0xffdfu);
    EXPECT_EQ(numbers(least(a, zero))[5], T(-100));
    EXPECT_EQ(numbers(most(a, zero))[5], T(-100));
}

TYPED_TEST(AnyLanes, CompressWordsInOrder) {
    std::array<std::uint32_t, 16> from;
    for (std::uint32_t k = 0; k < 16; ++k) from[k] = 100 + k;
    for (std::uint32_t const bits : {0u, 1u, 0x8000u, 0xa5c3u, 0xffffu}) {
        std::array<std::uint32_t, 32> to{};
        std::uint32_t const count = TypeParam::compress(bits, from.data(), to.data());
        std::uint32_t at = 0;
        for (std::uint32_t k = 0; k < 16; ++k)
            if ((bits >> k & 1u) != 0) {
                EXPECT_EQ(to[at++], 100 + k);
            }
        EXPECT_EQ(count, at);
        for (std::size_t k = 16; k < 32; ++k) EXPECT_EQ(to[k], 0u) << "past the sixteenth";
    }
}

TYPED_TEST(AnyLanes, GatherRowsAndComponentsOfTiles) {
    using T = typename TypeParam::Scalar;
    std::array<T, 64> numbers_of;
    for (std::size_t i = 0; i < 64; ++i) numbers_of[i] = static_cast<T>(i);
    T const* const row[4] = {&numbers_of[0], &numbers_of[13], &numbers_of[27], &numbers_of[52]};
    TypeParam components[3];
    TypeParam::triples(row, components);
    auto const lone = numbers(TypeParam::rows(row));
    for (std::size_t k = 0; k < 16; ++k) {
        EXPECT_EQ(lone[k], row[k / 4][k % 4]);
        for (std::size_t axis = 0; axis < 3; ++axis)
            EXPECT_EQ(numbers(components[axis])[k], row[k / 4][3 * (k % 4) + axis]);
    }
}

TYPED_TEST(AnyLanes, GatherPointsFromAnywhere) {
    using T = typename TypeParam::Scalar;
    std::array<T, 100> numbers_of;
    for (std::size_t i = 0; i < 100; ++i) numbers_of[i] = static_cast<T>(i);
    auto const at = [&](int k) { return numbers_of.data() + (k * 37 + 5) % 98; };
    TypeParam xyz[3];
    TypeParam::points(at, xyz);
    for (int axis = 0; axis < 3; ++axis)
        for (int k = 0; k < 16; ++k)
            EXPECT_EQ(numbers(xyz[axis])[static_cast<std::size_t>(k)], at(k)[axis]) << axis << " of " << k;
}

TYPED_TEST(AnyLanes, GatherWideRowsAndNarrowThem) {
    using T = typename TypeParam::Scalar;
    using Real = Wider<T>;
    std::array<Real, 40> numbers_of;
    for (std::size_t i = 0; i < 40; ++i) numbers_of[i] = Real(i) + Real(1) / Real(3);
    Real const* const row[4] = {&numbers_of[0], &numbers_of[13], &numbers_of[7], &numbers_of[36]};
    auto const narrow = numbers(TypeParam::narrow(TypeParam::Wide::rows(row)));
    for (std::size_t k = 0; k < 16; ++k) EXPECT_EQ(narrow[k], static_cast<T>(row[k / 4][k % 4]));
}

TYPED_TEST(AnyLanes, StoreBytesWithoutFractionsFrom0To255) {
    using T = typename TypeParam::Scalar;
    std::array<T, 16> const values{0,  1,       T(1.99), T(254.5), 255, T(255.5), 300, T(1e9),
                                   -1, T(-0.5), 17,      3,        99,  128,      127, 200};
    std::array<unsigned char, 18> bytes;
    bytes.fill(77);
    TypeParam::load(values.data()).store_bytes(bytes.data() + 1);
    std::array<unsigned char, 18> const wanted{77, 0, 1,  1, 254, 255, 255, 255, 255,
                                               0,  0, 17, 3, 99,  128, 127, 200, 77};
    EXPECT_EQ(bytes, wanted);
}

TYPED_TEST(AnyLanes, LoadBytesAndStoreWordsWithoutFractions) {
    using T = typename TypeParam::Scalar;
    std::array<unsigned char, 17> bytes;
    for (std::size_t k = 0; k < 17; ++k) bytes[k] = static_cast<unsigned char>(k * 17 - 17);
    TypeParam const loaded = TypeParam::load_bytes(bytes.data() + 1);
    std::array<std::uint32_t, 18> words;
    words.fill(77);
    (loaded * TypeParam::all(T(100)) + TypeParam::all(T(0.75))).store_words(words.data() + 1);
    for (std::size_t k = 0; k < 16; ++k) {
        EXPECT_EQ(numbers(loaded)[k], static_cast<T>(17 * k));
        EXPECT_EQ(words[k + 1], 1700 * k);
    }
    EXPECT_EQ(words[0] + words[17], 154u) << "nothing beside the sixteen";
}

TEST(Lanes, AreAtLeastPlainAndWidenWhereFloatsCancel) {
    EXPECT_EQ(sizeof(BestLanes<float>::Scalar), sizeof(float));
    EXPECT_EQ(sizeof(Wider<float>), sizeof(double));
    EXPECT_EQ(sizeof(Wider<long double>), sizeof(long double));
    std::array<double, 16> stored;
    typename BestLanes<float>::Wide const wide = BestLanes<float>::Wide::load(some<float>.data());
    (wide * wide + fused(wide, wide, BestLanes<float>::Wide::all(-1.0)) - absolute(wide)).store(stored.data());
    for (std::size_t k = 0; k < 16; ++k) {
        double const x = static_cast<double>(some<float>[k]);
        EXPECT_EQ(stored[k], x * x + (x * x - 1.0) - std::abs(x));
    }
    EXPECT_EQ(at_least(wide, BestLanes<float>::Wide::all(2.0)),
              at_least(BestLanes<float>::load(some<float>.data()), BestLanes<float>::all(2.0f)));
    with_sign_of(BestLanes<float>::Wide::all(3.0), wide).store(stored.data());
    EXPECT_EQ(stored[0], 3.0);
    EXPECT_EQ(stored[12], -3.0);
}
