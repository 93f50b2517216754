// SPDX-License-Identifier: MIT
//
// Runs a call and tells what it did besides returning: allocations from the heap, and exceptions raised in the
// floating-point unit. shadowmath promises neither. Nothing traps: the flags are read afterwards.
#pragma once

#include <cfenv>
#include <cstdint>

namespace shadowmath::test {

// Calls of any operator new since the program began (main.cpp replaces them to count).
[[nodiscard]] std::uint64_t allocation_count();

#if defined(SHADOWMATH_FLAGS_MAY_RISE)  // where a compiler computes both sides of a choice
inline constexpr int watched_flags = 0;
#else
inline constexpr int watched_flags = FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW;
#endif

template <class Result>
struct Watched {
    Result result;
    std::uint64_t allocations;
    int raised;  // of the flags below

    // For anything at all: numbers as large as the type allows may overflow, but nothing becomes of it.
    [[nodiscard]] bool calm() const { return allocations == 0 && (raised & ~FE_OVERFLOW) == 0; }
    // For inputs that are all in their ranges.
    [[nodiscard]] bool calm_in_range() const { return allocations == 0 && raised == 0; }
};

template <class Call>
[[nodiscard, gnu::noinline]] auto watched(Call const& call) -> Watched<decltype(call())> {
    if (std::fetestexcept(watched_flags) != 0) std::feclearexcept(watched_flags);  // to clear is slow, to ask is not
    std::uint64_t const before = allocation_count();
    auto result = call();
    // NOTE: without it the compiler may move the arithmetic past the reading of the flags.
    asm volatile("" : : "g"(&result) : "memory");
    int const raised = std::fetestexcept(watched_flags);
    return {result, allocation_count() - before, raised};
}

}  // namespace shadowmath::test
