// SPDX-License-Identifier: MIT
//
// Runs all tests. Properties use the same seed in every run, printed here; set RC_PARAMS to choose another, or more
// cases:
//   RC_PARAMS="seed=7 max_success=20000" ./shadowmath_property

#include "counted_new.hpp"

#include <gtest/gtest.h>

#include <cstdio>

int main(int argc, char** argv) {
    setenv("RC_PARAMS", "seed=20021201 max_success=200", 0);
    std::printf("RC_PARAMS=\"%s\"\n", std::getenv("RC_PARAMS"));
    ::testing::InitGoogleTest(&argc, argv);
    return RUN_ALL_TESTS();
}
