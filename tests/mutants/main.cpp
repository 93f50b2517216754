// SPDX-License-Identifier: MIT
//
// Runs tests with one mutant chosen: MUTANT is its number. With MUTANTS_REACHED set to a file's name, writes there
// which mutants each test reaches, one line a test: whether it passed, its name, its milliseconds, then the numbers; a
// minus sign before those that have no change for the types they met.

#include "tests/mutants/mutants.hpp"
#include "tests/support/counted_new.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

class Reach : public ::testing::EmptyTestEventListener {
public:
    explicit Reach(std::FILE* file) : file_(file) {}
    void OnTestStart(::testing::TestInfo const&) override { std::memset(mutants::reached, 0, sizeof mutants::reached); }
    void OnTestEnd(::testing::TestInfo const& test) override {
        std::fprintf(file_, "%s %s.%s %d", test.result()->Passed() ? "passed" : "failed", test.test_suite_name(),
                     test.name(), static_cast<int>(test.result()->elapsed_time()));
        for (int i = 0; i < mutants::most; ++i)
            if (mutants::reached[i] != mutants::never)
                std::fprintf(file_, " %d", (mutants::reached[i] & mutants::once) != 0 ? i : -i);
        std::fprintf(file_, "\n");
    }

private:
    std::FILE* file_;
};

}  // namespace

int main(int argc, char** argv) {
    setenv("RC_PARAMS", "seed=20021201 max_success=200", 0);
    ::testing::InitGoogleTest(&argc, argv);
    if (char const* const mutant = std::getenv("MUTANT")) mutants::chosen = std::atoi(mutant);
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
