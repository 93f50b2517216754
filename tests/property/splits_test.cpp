// SPDX-License-Identifier: MIT
#include "tests/laws/splits.hpp"
#include "tests/support/gen.hpp"
#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

namespace {

template <class T>
struct Case {
    T z_near, z_far, lambda;
    int count;
};

// Ranges wide enough for every split, so that the law of the formula applies to all of them.
template <class T>
rc::Gen<Case<T>> valid_case() {
    return rc::gen::exec([] {
        T const z_near = *log_uniform<T>(T(1e-3), T(1e3));
        T const ratio = *log_uniform<T>(T(1.01), T(1e8));
        bool const extreme = *one_in(3);
        T const anything = *uniform<T>(T(0), T(1));
        bool const logarithmic = *one_in(2);
        int const count = 1 + static_cast<int>(*below(max_splits));
        return Case<T>{z_near, z_near * ratio, extreme ? (logarithmic ? T(1) : T(0)) : anything, count};
    });
}

template <class T>
void showValue(Case<T> const& c, std::ostream& out) {
    out.precision(std::numeric_limits<T>::max_digits10);
    out << "near " << c.z_near << " far " << c.z_far << " lambda " << c.lambda << " count " << c.count;
}

}  // namespace

template <class T>
class SplitsProperty : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(SplitsProperty, Scalars);

TYPED_TEST(SplitsProperty, AreOrderedAndFollowTheFormula) {
    EXPECT_TRUE(rc::check([] {
        Case<TypeParam> const c = *valid_case<TypeParam>();
        auto const made = watched([&c] { return practical_splits(c.z_near, c.z_far, c.count, c.lambda); });
        RC_ASSERT(made.calm_in_range());
        RC_ASSERT(made.result.count == c.count);
        RC_ASSERT(laws::is_ordered(made.result, c.z_near, c.z_far, c.count));
        RC_ASSERT(laws::follows_the_formula(made.result, c.z_near, c.z_far, c.lambda));
    }));
}

TYPED_TEST(SplitsProperty, FallWithLambda) {
    EXPECT_TRUE(rc::check([] {
        Case<TypeParam> const c = *valid_case<TypeParam>();
        TypeParam const less = *uniform<TypeParam>(TypeParam(0), c.lambda);
        RC_ASSERT(laws::falls_with_lambda(practical_splits(c.z_near, c.z_far, c.count, less),
                                          practical_splits(c.z_near, c.z_far, c.count, c.lambda)));
    }));
}

TYPED_TEST(SplitsProperty, ScaleWithTheWorld) {
    EXPECT_TRUE(rc::check([] {
        Case<TypeParam> const c = *valid_case<TypeParam>();
        TypeParam const two = TypeParam(2);
        RC_ASSERT(laws::is_scaled_by_two(practical_splits(c.z_near, c.z_far, c.count, c.lambda),
                                         practical_splits(two * c.z_near, two * c.z_far, c.count, c.lambda)));
    }));
}

TYPED_TEST(SplitsProperty, AreRefinedByTwiceAsMany) {
    EXPECT_TRUE(rc::check([] {
        Case<TypeParam> const c = *valid_case<TypeParam>();
        int const count = 1 + c.count / 2;
        RC_PRE(2 * count <= max_splits);
        RC_ASSERT(laws::is_refined_by(practical_splits(c.z_near, c.z_far, count, c.lambda),
                                      practical_splits(c.z_near, c.z_far, 2 * count, c.lambda)));
    }));
}

TYPED_TEST(SplitsProperty, AreBehindThePinWhatPracticalSplitsAre) {
    EXPECT_TRUE(rc::check([] {
        Case<TypeParam> const c = *valid_case<TypeParam>();
        TypeParam const first_end = *uniform<TypeParam>(c.z_near, c.z_far);
        Splits<TypeParam> const splits = pinned_splits(c.z_near, c.z_far, c.count, first_end, c.lambda);
        RC_ASSERT(laws::is_ordered(splits, c.z_near, c.z_far, c.count));
        bool const inside = first_end > c.z_near && first_end < c.z_far;
        RC_ASSERT(splits.faults.has(Fault::clamped_option) == !inside);
        RC_ASSERT(!inside || c.count < 2 || splits.plane[1] == first_end);
    }));
}

TYPED_TEST(SplitsProperty, BeginWhereTheirLambdaWasAskedToPutThem) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        Case<T> const c = *valid_case<T>();
        RC_PRE(c.count >= 2);
        T const wanted = practical_splits(c.z_near, c.z_far, c.count, c.lambda).plane[1];
        T const lambda = lambda_for_first_split(c.z_near, c.z_far, c.count, wanted);
        T const reached = practical_splits(c.z_near, c.z_far, c.count, lambda).plane[1];
        // The difference of the schemes' first planes is known to a few roundings of the uniform one.
        T const uniform = uniform_splits(c.z_near, c.z_far, c.count).plane[1];
        RC_ASSERT(std::abs(reached - wanted) <= T(16) * std::numeric_limits<T>::epsilon() * uniform);
    }));
}

TYPED_TEST(SplitsProperty, AreOrderedOrRefusedForAnyInputAtAll) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        T const z_near = *nasty<T>();
        T const z_far = *nasty<T>();
        T const lambda = *nasty<T>();
        T const pin = *nasty<T>();
        int const count = static_cast<int>(*below(40)) - 10;
        int const asked = count < 0 ? 0 : count;
        auto const practical = watched([&] { return practical_splits(z_near, z_far, count, lambda); });
        auto const pinned = watched([&] { return pinned_splits(z_near, z_far, count, pin, lambda); });
        RC_ASSERT(practical.calm() && pinned.calm());
        RC_ASSERT(laws::is_ordered(practical.result, z_near, z_far, asked));
        RC_ASSERT(laws::is_ordered(pinned.result, z_near, z_far, asked));
        T const found = lambda_for_first_split(z_near, z_far, count, pin);
        RC_ASSERT(found >= T(0) && found <= T(1));
        T const inner[] = {z_near, z_far, lambda, pin};
        RC_ASSERT(laws::is_ordered(explicit_splits(z_near, z_far, inner, 5), z_near, z_far, 5));
    }));
}
