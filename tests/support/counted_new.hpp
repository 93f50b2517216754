// SPDX-License-Identifier: MIT
//
// Replaces operator new by one that counts, for watched.hpp. Include it in one file of a program: the one with main().
#pragma once

#include "watched.hpp"

#include <cstdint>
#include <cstdlib>
#include <new>

namespace {

thread_local std::uint64_t allocations = 0;  // what the threads of drivers and fuzzers do is their affair

void* allocate(std::size_t bytes) {
    ++allocations;
    if (void* const memory = std::malloc(bytes == 0 ? 1 : bytes)) return memory;
    std::abort();
}

}  // namespace

std::uint64_t shadowmath::test::allocation_count() {
    return allocations;
}

void* operator new(std::size_t bytes) {
    return allocate(bytes);
}
void* operator new[](std::size_t bytes) {
    return allocate(bytes);
}
void operator delete(void* memory) noexcept {
    std::free(memory);
}
void operator delete[](void* memory) noexcept {
    std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
    std::free(memory);
}
