// SPDX-License-Identifier: MIT
#include "tests/laws/clip_space.hpp"
#include "tests/support/gen.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

namespace {

// A multiple of 2^-10 in [lo, hi]: the conversions do not round it.
template <class T>
rc::Gen<T> dyadic(int lo, int hi) {
    return rc::gen::map(below(static_cast<std::uint64_t>(hi - lo) * 1024 + 1),
                        [lo](std::uint64_t drawn) { return T(lo) + static_cast<T>(drawn) / T(1024); });
}

}  // namespace

template <class T>
class ClipSpaceProperty : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(ClipSpaceProperty, Scalars);

TYPED_TEST(ClipSpaceProperty, EveryConventionConvertsBothWaysExactly) {
    EXPECT_TRUE(rc::check([] {
        ClipSpace const clip = *clip_space();
        RC_ASSERT(laws::converts_both_ways<TypeParam>(clip));
    }));
}

TYPED_TEST(ClipSpaceProperty, EveryConventionReadsTheMapWhereItWasWritten) {
    EXPECT_TRUE(rc::check([] {
        ClipSpace const clip = *clip_space();
        TypeParam const x = *dyadic<TypeParam>(-2, 2);
        TypeParam const y = *dyadic<TypeParam>(-2, 2);
        TypeParam const z = *dyadic<TypeParam>(-1, 2);
        RC_ASSERT(laws::reads_where_it_was_written(clip, Vec3<TypeParam>(x, y, z)));
    }));
}

TYPED_TEST(ClipSpaceProperty, EveryConventionDecidesAlike) {
    EXPECT_TRUE(rc::check([] {
        ClipSpace const clip = *clip_space();
        TypeParam const occluder = *dyadic<TypeParam>(0, 1);
        bool const touching = *one_in(4);
        TypeParam const anywhere = *dyadic<TypeParam>(0, 1);
        TypeParam const receiver = touching ? occluder : anywhere;
        TypeParam const bias = *dyadic<TypeParam>(0, 1) / TypeParam(8);
        RC_ASSERT(laws::keeps_the_decision(clip, occluder, receiver, bias));
        RC_ASSERT(laws::is_lit_by_a_cleared_map(clip, receiver));
    }));
}
