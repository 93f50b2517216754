// SPDX-License-Identifier: MIT
//
// The one place where GLM comes in, the names of its types, and the assertion.
//
// Only what is used of GLM is included: all of it takes an eighth longer to compile. GLM's macros may be set in any
// way, since shadowmath calls nothing whose meaning depends on them.
//
// To replace the assertion, put a header <shadowmath_user_config.hpp> that defines SHADOWMATH_ASSERT on the include
// path.
#pragma once

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#if defined(__has_include)
#if __has_include(<shadowmath_user_config.hpp>)
#include <shadowmath_user_config.hpp>
#endif
#endif

// Misuse only (a null pointer, a capacity of zero); data never gets here.
#ifndef SHADOWMATH_ASSERT
#if defined(NDEBUG)
#define SHADOWMATH_ASSERT(condition, sentence) static_cast<void>(0)
#else
#include <cassert>
#define SHADOWMATH_ASSERT(condition, sentence) assert((condition) && (sentence))
#endif
#endif

namespace shadowmath {
inline namespace v0 {

template <class T>
using Vec2 = glm::vec<2, T, glm::defaultp>;
template <class T>
using Vec3 = glm::vec<3, T, glm::defaultp>;
template <class T>
using Vec4 = glm::vec<4, T, glm::defaultp>;
template <class T>
using Mat4 = glm::mat<4, 4, T, glm::defaultp>;

// Row r of a matrix as a vector: what is dotted with a point to give its r-th coordinate.
template <class T>
[[nodiscard]] inline Vec4<T> row(Mat4<T> const& m, int r) noexcept {
    return Vec4<T>(m[0][r], m[1][r], m[2][r], m[3][r]);
}

// The matrix whose rows are given.
template <class T>
[[nodiscard]] inline Mat4<T> from_rows(Vec4<T> const& x, Vec4<T> const& y, Vec4<T> const& z,
                                       Vec4<T> const& w) noexcept {
    return Mat4<T>(x.x, y.x, z.x, w.x, x.y, y.y, z.y, w.y, x.z, y.z, z.z, w.z, x.w, y.w, z.w, w.w);
}

// The harmless matrix of a map that serves nothing: every point lands at NDC x = 2, outside the map, with w = 1.
template <class T>
[[nodiscard]] inline Mat4<T> nowhere() noexcept {
    return Mat4<T>(T(0), T(0), T(0), T(0), T(0), T(0), T(0), T(0), T(0), T(0), T(0), T(0), T(2), T(2), T(2), T(1));
}

}  // namespace v0
}  // namespace shadowmath
