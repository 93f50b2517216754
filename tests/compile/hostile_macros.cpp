// SPDX-License-Identifier: MIT
//
// A translation unit after windows.h and Xlib: C++17, no exceptions, no RTTI, and the macros that those headers leave
// behind.

#define near
#define far
#define small char
#define interface struct
#define IN
#define OUT
#define min(a, b) (((a) < (b)) ? (a) : (b))
#define max(a, b) (((a) > (b)) ? (a) : (b))
#define None 0L
#define Status int
#define Bool int
#define Success 0
#define Always 2
#define Complex 0

#include "tests/compile/every_function.hpp"

namespace shadowmath::compile {

int functions_between_hostile_macros() noexcept {
    return every_function<float>() + every_function<double>() + every_function<long double>();
}

}  // namespace shadowmath::compile
