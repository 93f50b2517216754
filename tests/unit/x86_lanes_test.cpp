// SPDX-License-Identifier: MIT
//
// Lanes in registers, wherever this translation unit has them, beside those in an array; without them, the array beside
// itself. Built a second time with -march=native.
#include <shadowmath/irregular/lanes.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>

using namespace shadowmath;

namespace {

template <class Lanes>
class X86Lanes : public ::testing::Test {
protected:
    using Array = std::array<float, 16>;

    std::mt19937 random{20021201};

    std::uint32_t word() { return static_cast<std::uint32_t>(random()); }

    // Small numbers, of which some are alike and sums of products are exact; if asked for, some are NaN or infinite.
    Array numbers(bool any = false) {
        constexpr float odd[4] = {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity(),
                                  -std::numeric_limits<float>::infinity(), -0.0f};
        Array made;
        for (float& one : made) {
            one = float(int(word() % 65) - 32) / 4.0f;
            if (any && word() % 4 == 0) one = odd[word() % 4];
        }
        return made;
    }
    template <class Any>
    static Array stored(Any const& lanes) {
        Array made;
        lanes.store(made.data());
        return made;
    }
    static void expect_same(Array const& a, Array const& b, char const* what) {
        for (std::size_t k = 0; k < 16; ++k)
            EXPECT_TRUE(a[k] == b[k] || (std::isnan(a[k]) && std::isnan(b[k])))
                << what << " in lane " << k << ": " << a[k] << ", not " << b[k];
    }
    static std::array<double, 16> doubles(typename Lanes::Wide const& wide) {
        std::array<double, 16> made;
        wide.store(made.data());
        return made;
    }
};
using Kinds = ::testing::Types<PlainLanes<float>
#if defined(__AVX512F__) && defined(__AVX512BW__) && defined(__AVX512VL__)
                               ,
                               Avx512Lanes
#endif
#if defined(__AVX2__) && defined(__FMA__)
                               ,
                               Avx2Lanes
#endif
                               >;
TYPED_TEST_SUITE(X86Lanes, Kinds);

}  // namespace

TYPED_TEST(X86Lanes, DoWhatAnArrayDoes) {
    using Plain = PlainLanes<float>;
    for (int i = 0; i < 200; ++i) {
        bool const any = i % 2 == 1;
        auto const x = this->numbers(any), y = this->numbers(any), z = this->numbers();
        auto const a = TypeParam::load(x.data()), b = TypeParam::load(y.data()), c = TypeParam::load(z.data());
        auto const p = Plain::load(x.data()), q = Plain::load(y.data()), r = Plain::load(z.data());
        auto const same = [this](auto const& lanes, auto const& plain, char const* what) {
            this->expect_same(this->stored(lanes), this->stored(plain), what);
        };
        same(a + b, p + q, "sum");
        same(a - b, p - q, "difference");
        same(a * b, p * q, "product");
        same(a / b, p / q, "quotient");
        same(fused(a, b, c), fused(p, q, r), "fused");
        same(least(a, b), least(p, q), "least");
        same(most(a, b), most(p, q), "most");
        same(absolute(a), absolute(p), "absolute");
        same(with_sign_of(a, b), with_sign_of(p, q), "sign");
        auto const signs = this->stored(with_sign_of(c, b));
        for (std::size_t k = 0; k < 16; ++k) EXPECT_EQ(std::signbit(signs[k]), std::signbit(y[k]));
        std::uint32_t const bits = this->word() & 0xffffu;
        same(chosen(bits, a, b), chosen(bits, p, q), "chosen");
        EXPECT_EQ(at_least(a, b), at_least(p, q));
        EXPECT_EQ(smallest(c), smallest(r));
        EXPECT_EQ(largest(c), largest(r));
        auto const over = this->stored(reciprocal(c));
        for (std::size_t k = 0; k < 16; ++k) {
            if (z[k] == 0.0f) continue;
            EXPECT_NEAR(over[k] * z[k], 1.0f, 4.0f * std::numeric_limits<float>::epsilon());
        }
    }
}

TYPED_TEST(X86Lanes, PackBytesAndWordsAsAnArrayDoes) {
    using Plain = PlainLanes<float>;
    for (int i = 0; i < 100; ++i) {
        std::array<float, 16> x;
        for (float& one : x) one = float(int(this->word() % 4000) - 800) / 8.0f;
        std::array<unsigned char, 18> bytes, wanted;
        bytes.fill(77);
        wanted.fill(77);
        TypeParam::load(x.data()).store_bytes(bytes.data() + 1);
        Plain::load(x.data()).store_bytes(wanted.data() + 1);
        EXPECT_EQ(bytes, wanted);
        this->expect_same(this->stored(TypeParam::load_bytes(bytes.data() + 1)),
                          this->stored(Plain::load_bytes(bytes.data() + 1)), "bytes");
        for (float& one : x) one = std::abs(one) * 1000.0f;
        std::array<std::uint32_t, 18> words, all;
        words.fill(77);
        all.fill(77);
        TypeParam::load(x.data()).store_words(words.data() + 1);
        Plain::load(x.data()).store_words(all.data() + 1);
        EXPECT_EQ(words, all);
        std::uint32_t const some = i == 0 ? 0xffffu : this->word() & 0xffffu;
        std::array<std::uint32_t, 17> to{}, as{};
        EXPECT_EQ(TypeParam::compress(some, words.data() + 1, to.data()),
                  Plain::compress(some, words.data() + 1, as.data()));
        // What is behind those that are asked for may be anything.
        for (std::size_t k = 0; k < 16; ++k) EXPECT_TRUE(to[k] == as[k] || as[k] == 0u);
        EXPECT_EQ(to[16], 0u);
    }
}

TYPED_TEST(X86Lanes, GatherAsAnArrayDoes) {
    using Plain = PlainLanes<float>;
    std::array<float, 100> from;
    for (std::size_t i = 0; i < 100; ++i) from[i] = float(i) + 0.5f;
    for (int i = 0; i < 50; ++i) {
        float const* const row[4] = {&from[this->word() % 80], &from[this->word() % 80], &from[this->word() % 80],
                                     &from[this->word() % 80]};
        this->expect_same(this->stored(TypeParam::rows(row)), this->stored(Plain::rows(row)), "rows");
        std::uint32_t const step = this->word() % 97;
        auto const at = [&](int k) { return from.data() + (std::uint32_t(k) * step + 5) % 98; };
        TypeParam triples[3], points[3];
        Plain plain_triples[3], plain_points[3];
        TypeParam::triples(row, triples);
        Plain::triples(row, plain_triples);
        TypeParam::points(at, points);
        Plain::points(at, plain_points);
        for (int axis = 0; axis < 3; ++axis) {
            this->expect_same(this->stored(triples[axis]), this->stored(plain_triples[axis]), "triples");
            this->expect_same(this->stored(points[axis]), this->stored(plain_points[axis]), "points");
        }
    }
    this->expect_same(this->stored(TypeParam::all(0.75f)), this->stored(Plain::all(0.75f)), "all");
}

TYPED_TEST(X86Lanes, WidenWhatFloatsCancelIn) {
    using Wide = typename TypeParam::Wide;
    using Plain = PlainLanes<double>;
    for (int i = 0; i < 100; ++i) {
        auto const x = this->numbers(), y = this->numbers();
        auto const a = Wide::load(x.data()), b = Wide::load(y.data());
        auto const p = Plain::load(x.data()), q = Plain::load(y.data());
        auto const same = [this](Wide const& wide, Plain const& plain, char const* what) {
            auto const stored = this->doubles(wide);
            for (std::size_t k = 0; k < 16; ++k) EXPECT_EQ(stored[k], plain.lane[k]) << what << " in lane " << k;
        };
        same(a + b, p + q, "sum");
        same(a - b, p - q, "difference");
        same(a * b, p * q, "product");
        same(fused(a, b, a), fused(p, q, p), "fused");
        same(absolute(a), absolute(p), "absolute");
        same(with_sign_of(a, b), with_sign_of(p, q), "sign");
        same(Wide::all(1.0 / 3.0), Plain::all(1.0 / 3.0), "all");
        EXPECT_EQ(at_least(a, b), at_least(p, q));
        std::array<double, 40> numbers;
        for (std::size_t k = 0; k < 40; ++k) numbers[k] = double(k) + 1.0 / 3.0;
        double const* const row[4] = {&numbers[0], &numbers[this->word() % 36], &numbers[7], &numbers[36]};
        same(Wide::rows(row), Plain::rows(row), "rows");
        this->expect_same(this->stored(TypeParam::narrow(Wide::rows(row))),
                          this->stored(PlainLanes<float>::narrow(Plain::rows(row))), "narrow");
    }
}
