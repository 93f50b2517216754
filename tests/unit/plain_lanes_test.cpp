// SPDX-License-Identifier: MIT
//
// Lane by lane, each operation is that of a single number.
#include <shadowmath/irregular/plain_lanes.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

using namespace shadowmath;

namespace {

template <class T>
class PlainLanesOf : public ::testing::Test {};
using Scalars = ::testing::Types<float, double, long double>;
TYPED_TEST_SUITE(PlainLanesOf, Scalars);

// Small numbers, so that some are alike and sums of products are exact; if asked for, some are NaN or infinite.
template <class T>
struct Dice {
    std::mt19937 bits{20021201};

    std::uint32_t below(std::uint32_t end) { return std::uniform_int_distribution<std::uint32_t>(0, end - 1)(bits); }
    T number() { return T(int(below(33)) - 16) / T(4); }
    PlainLanes<T> lanes(bool any = false) {
        constexpr T odd[4] = {std::numeric_limits<T>::quiet_NaN(), std::numeric_limits<T>::infinity(),
                              -std::numeric_limits<T>::infinity(), T(-0.0)};
        PlainLanes<T> made;
        for (T& lane : made.lane) lane = any && below(4) == 0 ? odd[below(4)] : number();
        return made;
    }
};

template <class T>
void expect_same(T a, T b) {
    EXPECT_TRUE(a == b || (std::isnan(a) && std::isnan(b))) << a << ", not " << b;
}

}  // namespace

TYPED_TEST(PlainLanesOf, AreAddedMultipliedDividedAndFused) {
    using T = TypeParam;
    Dice<T> dice;
    for (int i = 0; i < 50; ++i) {
        auto const a = dice.lanes(), b = dice.lanes(), c = dice.lanes();
        auto const sum = a + b, rest = a - b, product = a * b, ratio = a / b, both = fused(a, b, c);
        for (int k = 0; k < lane_count; ++k) {
            expect_same(sum.lane[k], a.lane[k] + b.lane[k]);
            expect_same(rest.lane[k], a.lane[k] - b.lane[k]);
            expect_same(product.lane[k], a.lane[k] * b.lane[k]);
            expect_same(ratio.lane[k], a.lane[k] / b.lane[k]);
            expect_same(both.lane[k], a.lane[k] * b.lane[k] + c.lane[k]);
        }
    }
}

TYPED_TEST(PlainLanesOf, OfTwoTheSecondIsTheLeastAndTheMostWhereEitherIsNaN) {
    using T = TypeParam;
    Dice<T> dice;
    for (int i = 0; i < 50; ++i) {
        auto const a = dice.lanes(true), b = dice.lanes(true), less = least(a, b), more = most(a, b);
        std::uint32_t const bits = at_least(a, b);
        EXPECT_EQ(bits >> 16, 0u);
        for (int k = 0; k < lane_count; ++k) {
            bool const nan = std::isnan(a.lane[k]) || std::isnan(b.lane[k]);
            expect_same(less.lane[k], nan ? b.lane[k] : std::fmin(a.lane[k], b.lane[k]));
            expect_same(more.lane[k], nan ? b.lane[k] : std::fmax(a.lane[k], b.lane[k]));
            EXPECT_EQ((bits >> k & 1u) != 0, !nan && !(a.lane[k] < b.lane[k]));
        }
    }
}

TYPED_TEST(PlainLanesOf, KeepTheirSignOrTakeAnothers) {
    using T = TypeParam;
    Dice<T> dice;
    for (int i = 0; i < 50; ++i) {
        auto const a = dice.lanes(), b = dice.lanes(true), size = absolute(a), turned = with_sign_of(a, b);
        auto const over = reciprocal(a);
        for (int k = 0; k < lane_count; ++k) {
            expect_same(size.lane[k], std::fabs(a.lane[k]));
            expect_same(std::fabs(turned.lane[k]), std::fabs(a.lane[k]));
            EXPECT_EQ(std::signbit(turned.lane[k]), std::signbit(b.lane[k]));
            if (a.lane[k] != T(0)) expect_same(over.lane[k], T(1) / a.lane[k]);
        }
    }
}

TYPED_TEST(PlainLanesOf, SmallestAndLargestAreOfAllSixteenWhereverTheyLie) {
    using T = TypeParam;
    for (int k = 0; k < lane_count; ++k) {
        auto lanes = PlainLanes<T>::all(T(0.5));
        for (int j = 0; j < lane_count; ++j) EXPECT_EQ(lanes.lane[j], T(0.5));
        lanes.lane[k] = T(-3);
        EXPECT_EQ(smallest(lanes), T(-3)) << k;
        lanes.lane[k] = T(7);
        EXPECT_EQ(largest(lanes), T(7)) << k;
    }
}

TYPED_TEST(PlainLanesOf, AreChosenByBits) {
    using T = TypeParam;
    Dice<T> dice;
    for (int i = 0; i < 50; ++i) {
        auto const a = dice.lanes(), b = PlainLanes<T>::all(T(99));
        std::uint32_t const bits = dice.below(1u << 16);
        auto const either = chosen(bits, a, b);
        for (int k = 0; k < lane_count; ++k) expect_same(either.lane[k], (bits >> k) % 2 == 1 ? a.lane[k] : T(99));
    }
}

TYPED_TEST(PlainLanesOf, AreLoadedStoredAndNarrowedAsTheyAre) {
    using T = TypeParam;
    std::array<T, 18> from, to;
    for (std::size_t i = 0; i < 18; ++i) from[i] = T(i) / T(3);
    to.fill(T(-77));
    auto const loaded = PlainLanes<T>::load(from.data() + 1);
    loaded.store(to.data() + 1);
    EXPECT_EQ(to[0] + to[17], T(-154)) << "nothing beside the sixteen";
    for (std::size_t k = 1; k < 17; ++k) EXPECT_EQ(to[k], from[k]);
    auto const wide = PlainLanes<T>::Wide::load(from.data());
    auto const narrow = PlainLanes<T>::narrow(wide);
    for (std::size_t k = 0; k < 16; ++k) EXPECT_EQ(narrow.lane[k], from[k]);
    EXPECT_EQ(sizeof(wide.lane[0]), sizeof(T) == sizeof(float) ? sizeof(double) : sizeof(T));
}

TYPED_TEST(PlainLanesOf, AreGatheredFromRowsTriplesAndPoints) {
    using T = TypeParam;
    std::array<T, 100> from;
    for (std::size_t i = 0; i < 100; ++i) from[i] = T(i);
    T const* const row[4] = {&from[0], &from[13], &from[27], &from[52]};
    PlainLanes<T> triples[3], points[3];
    PlainLanes<T>::triples(row, triples);
    PlainLanes<T>::points([&](int k) { return from.data() + (k * 37 + 5) % 98; }, points);
    auto const rows = PlainLanes<T>::rows(row);
    for (int j = 0; j < 4; ++j)
        for (int i = 0; i < 4; ++i) {
            EXPECT_EQ(rows.lane[4 * j + i], row[j][i]);
            for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(triples[axis].lane[4 * j + i], row[j][3 * i + axis]);
        }
    for (int k = 0; k < lane_count; ++k)
        for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(points[axis].lane[k], T((k * 37 + 5) % 98 + axis));
}

TYPED_TEST(PlainLanesOf, BytesEndAt0AndAt255AndNaNIsTheLast) {
    using T = TypeParam;
    constexpr T endless = std::numeric_limits<T>::infinity(), no_number = std::numeric_limits<T>::quiet_NaN();
    std::array<T, 16> const values{0,  1,       T(1.99), T(254.5),  255, T(255.5), 300,      T(1e9),
                                   -1, T(-0.5), endless, no_number, 17,  T(0.5),   -endless, 200};
    std::array<unsigned char, 18> bytes;
    bytes.fill(77);
    PlainLanes<T>::load(values.data()).store_bytes(bytes.data() + 1);
    std::array<unsigned char, 18> const wanted{77, 0, 1, 1, 254, 255, 255, 255, 255, 0, 0, 255, 255, 17, 0, 0, 200, 77};
    EXPECT_EQ(bytes, wanted);
    auto const back = PlainLanes<T>::load_bytes(bytes.data() + 1);
    for (std::size_t k = 0; k < 16; ++k) EXPECT_EQ(back.lane[k], T(wanted[k + 1]));
    std::array<std::uint32_t, 18> words;
    words.fill(77);
    (back * PlainLanes<T>::all(T(1000)) + PlainLanes<T>::all(T(0.75))).store_words(words.data() + 1);
    EXPECT_EQ(words[0] + words[17], 154u);
    for (std::size_t k = 0; k < 16; ++k) EXPECT_EQ(words[k + 1], 1000u * wanted[k + 1]);
}

TEST(PlainLanes, CompressWordsInOrderAndCountThem) {
    Dice<float> dice;
    std::array<std::uint32_t, 16> from;
    for (std::uint32_t k = 0; k < 16; ++k) from[k] = 100 + k;
    for (int i = 0; i < 100; ++i) {
        std::uint32_t const bits = i == 0 ? 0u : i == 1 ? 0xffffu : dice.below(1u << 16);
        std::array<std::uint32_t, 17> to{};
        std::uint32_t count = 0;
        std::uint32_t const counted = PlainLanes<float>::compress(bits, from.data(), to.data());
        for (std::uint32_t k = 0; k < 16; ++k)
            if ((bits >> k) % 2 == 1) {
                EXPECT_EQ(to[count++], 100 + k) << bits;
            }
        EXPECT_EQ(counted, count) << bits;
        EXPECT_EQ(to[16], 0u);
    }
}

TEST(PlainLanes, AreSixteenAndTheLowestBitIsThatOfTheFirst) {
    EXPECT_EQ(lane_count, 16);
    for (int bit = 0; bit < 32; ++bit) EXPECT_EQ(detail::lowest_bit(0x80000000u | 1u << bit), bit);
}
