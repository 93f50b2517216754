// SPDX-License-Identifier: MIT
//
// How loops over arrays get the whole width of the machine although their user compiles for the oldest one: the same
// portable loop is compiled twice, plain and for AVX2, and the processor is asked once a call.
//
// There are no intrinsics and there is no second source. AVX2 is taken without fused multiplication, so that both give
// the same bits. A build that is told of AVX2 or more (-march=native), another processor and another compiler have one
// version only.
//
// For a compiler to make vectors of it at -O2, a loop has a constant length, writes to local arrays or to another type
// than it reads, and has neither branches nor loops in it.
#pragma once

#include <shadowmath/config.hpp>

namespace shadowmath {
inline namespace v0 {
namespace detail {

#if defined(__GNUC__) && defined(__x86_64__) && !defined(__AVX2__) && !defined(_WIN32)

template <class Loop>
[[gnu::target("avx2")]] inline void run_in_avx2(Loop const& loop) noexcept {
    loop();
}

// `loop` is a struct whose operator() is [[gnu::always_inline]].
template <class Loop>
inline void run_widely(Loop const& loop) noexcept {
    if (__builtin_cpu_supports("avx2"))
        run_in_avx2(loop);
    else
        loop();
}

#else

template <class Loop>
inline void run_widely(Loop const& loop) noexcept {
    loop();
}

#endif

}  // namespace detail
}  // namespace v0
}  // namespace shadowmath
