// SPDX-License-Identifier: MIT
//
// Runs tests with one mutant chosen: MUTANT is its number, MUTANT_SECONDS the processor's seconds after which it counts
// as one that never ends. With MUTANTS_REACHED set to a file's name, writes there which mutants each test reaches, one
// line a test: whether it passed, its name, the processor's microseconds, then the numbers; a minus sign before those
// that have no change for the types they met.

#include "tests/mutants/mutants.hpp"
#include "tests/support/counted_new.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>

namespace {

class Reach : public ::testing::EmptyTestEventListener {
public:
    explicit Reach(std::FILE* file) : file_(file) {}
    void OnTestStart(::testing::TestInfo const&) override {
        std::memset(mutants::reached, 0, sizeof mutants::reached);
        begun_ = std::clock();
    }
    void OnTestEnd(::testing::TestInfo const& test) override {
        double const seconds = static_cast<double>(std::clock() - begun_) / CLOCKS_PER_SEC;
        std::fprintf(file_, "%s %s.%s %.0f", test.result()->Passed() ? "passed" : "failed", test.test_suite_name(),
                     test.name(), seconds * 1e6);
        for (int i = 0; i < mutants::most; ++i)
            if (mutants::reached[i] != mutants::never)
                std::fprintf(file_, " %d", (mutants::reached[i] & mutants::once) != 0 ? i : -i);
        std::fprintf(file_, "\n");
    }

private:
    std::FILE* file_;
    std::clock_t begun_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
    setenv("RC_PARAMS", "seed=20021201 max_success=200 noshrink=1", 0);
    ::testing::InitGoogleTest(&argc, argv);
    if (char const* const mutant = std::getenv("MUTANT")) mutants::chosen = std::atoi(mutant);
    if (char const* const seconds = std::getenv("MUTANT_SECONDS")) {
        auto const most = static_cast<rlim_t>(std::atoi(seconds));
        rlimit const limit{most, most};
        if (setrlimit(RLIMIT_CPU, &limit) != 0) return 2;
    }
    std::FILE* file = nullptr;
    if (char const* const name = std::getenv("MUTANTS_REACHED")) {
        file = std::fopen(name, "w");
        if (file == nullptr) return 2;
        ::testing::UnitTest::GetInstance()->listeners().Append(new Reach(file));
    }
    int const status = RUN_ALL_TESTS();
    if (file != nullptr) std::fclose(file);
    return status;
}
