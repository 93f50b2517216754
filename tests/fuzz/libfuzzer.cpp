// SPDX-License-Identifier: MIT
//
// libFuzzer's way in. The environment variable SHADOWMATH_TARGET names the target; scripts/fuzz sets it.
#include "tests/fuzz/case.hpp"
#include "tests/support/counted_new.hpp"

#include <cstdio>
#include <cstdlib>
#include <cstring>

extern "C" int LLVMFuzzerTestOneInput(std::uint8_t const* bytes, std::size_t size) {
    using namespace shadowmath::fuzz;
    static Target const* const chosen = [] {
        char const* const name = std::getenv("SHADOWMATH_TARGET");
        for (Target const& target : targets())
            if (name != nullptr && std::strcmp(target.name, name) == 0) return &target;
        std::fprintf(stderr, "SHADOWMATH_TARGET must be one of:\n");
        for (Target const& target : targets()) std::fprintf(stderr, "  %s\n", target.name);
        std::exit(2);
    }();
    Case c(bytes, size, Numbers::any);
    chosen->laws(c);
    if (c.broken_law() == nullptr) return 0;
    std::fprintf(stderr, "%s, a law is broken: %s\n", chosen->name, c.broken_law());
    std::abort();
}
