// SPDX-License-Identifier: MIT
//
// What a header whose operators can be changed at run time calls (schemata.py): each function does what its name says,
// unless the mutant with this number is chosen. In constant expressions none ever is.
#pragma once

#include <glm/glm.hpp>

#include <cmath>
#include <type_traits>
#include <utility>

namespace mutants {

inline constexpr int most = 200000;
enum Reached : unsigned char { never, once, without_a_change };  // bits
inline unsigned char reached[most];
inline int chosen = -1;

[[gnu::always_inline]] constexpr bool is(int number) noexcept {
    if (__builtin_is_constant_evaluated()) return false;
    reached[number] |= once;
    return chosen == number;
}

[[gnu::always_inline]] constexpr bool has_no_change(int number) noexcept {
    if (!__builtin_is_constant_evaluated()) reached[number] |= without_a_change;
    return false;
}

// By value: a constant that a lambda has not captured may be passed on, a bit field too.
#define MUTANTS_BINARY(name, op, other)                                                                     \
    template <class A, class B, class R = decltype(std::declval<A>() op std::declval<B>()), class = void>   \
    struct name##_has : std::false_type {};                                                                 \
    template <class A, class B, class R>                                                                    \
    struct name##_has<A, B, R, std::void_t<decltype(std::declval<A>() other std::declval<B>())>>            \
        : std::is_same<R, decltype(std::declval<A>() other std::declval<B>())> {};                          \
    template <class A, class B>                                                                             \
    [[gnu::always_inline]] constexpr decltype(std::declval<A>() op std::declval<B>()) name(int number, A a, \
                                                                                           B b) noexcept {  \
        if constexpr (name##_has<A, B>::value) {                                                            \
            if (is(number)) return a other b;                                                               \
        } else {                                                                                            \
            has_no_change(number);                                                                          \
        }                                                                                                   \
        return a op b;                                                                                      \
    }

MUTANTS_BINARY(less, <, <=)
MUTANTS_BINARY(less_or_equal, <=, <)
MUTANTS_BINARY(greater, >, >=)
MUTANTS_BINARY(greater_or_equal, >=, >)
MUTANTS_BINARY(less_turned, <, >)
MUTANTS_BINARY(less_or_equal_turned, <=, >=)
MUTANTS_BINARY(greater_turned, >, <)
MUTANTS_BINARY(greater_or_equal_turned, >=, <=)
MUTANTS_BINARY(plus, +, -)
MUTANTS_BINARY(minus, -, +)
MUTANTS_BINARY(times, *, /)
MUTANTS_BINARY(over, /, *)
MUTANTS_BINARY(equal, ==, !=)
MUTANTS_BINARY(unequal, !=, ==)
#undef MUTANTS_BINARY

template <class A, class B>
[[gnu::always_inline]] constexpr decltype(auto) add(int number, A& a, B b) noexcept {
    return is(number) ? (a -= b) : (a += b);
}
template <class A, class B>
[[gnu::always_inline]] constexpr decltype(auto) subtract(int number, A& a, B b) noexcept {
    return is(number) ? (a += b) : (a -= b);
}
template <class A, class B>
[[gnu::always_inline]] constexpr A& unite(int number, A& a, B b) noexcept {
    if (!is(number)) a |= b;
    return a;
}

#define MUTANTS_FUNCTION(space, name, other)                                                        \
    constexpr auto space##_##name(int number) noexcept {                                            \
        return [number](auto... a) { return is(number) ? space::other(a...) : space::name(a...); }; \
    }

MUTANTS_FUNCTION(std, fmin, fmax)
MUTANTS_FUNCTION(std, fmax, fmin)
MUTANTS_FUNCTION(std, floor, ceil)
MUTANTS_FUNCTION(std, ceil, floor)
MUTANTS_FUNCTION(glm, min, max)
MUTANTS_FUNCTION(glm, max, min)
#undef MUTANTS_FUNCTION

}  // namespace mutants
