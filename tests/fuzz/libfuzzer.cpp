// SPDX-License-Identifier: MIT
//
// libFuzzer's way in. The environment variable SHADOWMATH_TARGET names the target; scripts/fuzz sets it. The address
// sanitizer wants operator new for itself: allocations are then counted by its own hook.
//
// One mutation in eight throws the input away for random bytes of full length. What libFuzzer grows byte by byte stays
// short for a long time and reads as zeros from there on: a few thousand of the others reach what it finds in millions.
#include "tests/fuzz/case.hpp"

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>

#if __has_feature(address_sanitizer)
#include <sanitizer/allocator_interface.h>

namespace {

// Of this thread: libFuzzer's own, which watches the memory, starts while the first inputs run, and allocates.
thread_local std::uint64_t allocations = 0;
void count_allocation(void const volatile*, std::size_t) {
    ++allocations;
}
void ignore_deallocation(void const volatile*) {}
[[maybe_unused]] int const installed =
    __sanitizer_install_malloc_and_free_hooks(&count_allocation, &ignore_deallocation);

}  // namespace

std::uint64_t shadowmath::test::allocation_count() {
    return allocations;
}
#else
#include "tests/support/counted_new.hpp"
#endif

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* bytes, std::size_t size, std::size_t capacity);

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* bytes, std::size_t size, std::size_t capacity,
                                               unsigned seed) {
    std::minstd_rand random(seed);
    if (random() % 8 != 0) return LLVMFuzzerMutate(bytes, size, capacity);
    for (std::size_t i = 0; i < capacity; ++i) bytes[i] = static_cast<std::uint8_t>(random() >> 16);
    return capacity;
}

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
