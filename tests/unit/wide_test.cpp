// SPDX-License-Identifier: MIT
#include <shadowmath/wide.hpp>

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

using namespace shadowmath;

namespace {

struct Sum {
    std::int32_t const* numbers;
    std::int32_t& sum;
    [[gnu::always_inline]] inline void operator()() const noexcept {
        for (int i = 0; i < 64; ++i) sum += numbers[i];
    }
};

}  // namespace

TEST(Wide, RunsALoopOnce) {
    std::vector<std::int32_t> numbers(64);
    for (std::int32_t i = 0; i < 64; ++i) numbers[static_cast<std::size_t>(i)] = i;
    std::int32_t sum = 0;
    detail::run_widely(Sum{numbers.data(), sum});
    EXPECT_EQ(sum, 63 * 32);
}
