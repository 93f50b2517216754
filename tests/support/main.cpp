// SPDX-License-Identifier: MIT
//
// Runs all tests. Properties use the same seed in every run, printed here; set RC_PARAMS to choose another, or more
// cases:
//   RC_PARAMS="seed=7 max_success=20000" ./shadowmath_property

#include "counted_new.hpp"

#include <gtest/gtest.h>

#include <cfenv>
#include <cstdio>

namespace {
class Flags : public ::testing::EmptyTestEventListener {
    void OnTestStart(::testing::TestInfo const&) override { std::feclearexcept(FE_ALL_EXCEPT); }
    void OnTestEnd(::testing::TestInfo const& t) override {
        int const raised = std::fetestexcept(shadowmath::test::watched_flags);
        if (raised)
            std::printf("FLAGS %s.%s%s%s%s\n", t.test_suite_name(), t.name(), raised & FE_INVALID ? " invalid" : "",
                        raised & FE_DIVBYZERO ? " div" : "", raised & FE_OVERFLOW ? " over" : "");
    }
};
}  // namespace

int main(int argc, char** argv) {
    setenv("RC_PARAMS", "seed=20021201 max_success=200", 0);
    std::printf("RC_PARAMS=\"%s\"\n", std::getenv("RC_PARAMS"));
    ::testing::InitGoogleTest(&argc, argv);
    ::testing::UnitTest::GetInstance()->listeners().Append(new Flags);
    return RUN_ALL_TESTS();
}
