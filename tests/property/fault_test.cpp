// SPDX-License-Identifier: MIT
#include "tests/laws/fault.hpp"
#include "tests/support/gen.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

TEST(FaultsProperty, AnyTwoSetsFormAUnionDescribedByItsLowestMember) {
    EXPECT_TRUE(rc::check([] {
        Faults a;
        Faults b;
        a.bits = static_cast<std::uint32_t>(*below(std::uint64_t(1) << 32));
        b.bits = static_cast<std::uint32_t>(*below(std::uint64_t(1) << 32));
        RC_ASSERT(laws::is_a_union(a, b));
        RC_ASSERT(laws::describes_the_lowest(a | b));
    }));
}
