// SPDX-License-Identifier: MIT
//
// shadowmath 0.1.0.
// All of its headers as one, made by scripts/amalgamate. Take this file or the folder of headers: both in one
// translation unit define everything twice.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

// ======== shadowmath/version.hpp ========
//
// The version, once: the build reads these three lines too.

#define SHADOWMATH_VERSION_MAJOR 0
#define SHADOWMATH_VERSION_MINOR 1
#define SHADOWMATH_VERSION_PATCH 0

// ======== shadowmath/config.hpp ========
//
// The one place where GLM comes in, the names of its types, and the assertion.
//
// Only what is used of GLM is included: all of it takes an eighth longer to compile. GLM's macros may be set in any
// way, since shadowmath calls nothing whose meaning depends on them.
//
// To replace the assertion, put a header <shadowmath_user_config.hpp> that defines SHADOWMATH_ASSERT on the include
// path.

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

// ======== shadowmath/finite.hpp ========
//
// Is it finite, and how long is it: the two questions that every public function asks of its input.
//
// NOTE: under -ffast-math compilers assume that NaN and infinity do not exist and fold std::isnan, x != x and even bit
// tests of computed values to a constant. What survives is a look at the bits in the memory of the caller's inputs. So
// the test takes a pointer, and is called on inputs before any arithmetic.

namespace shadowmath {
inline namespace v0 {

// True when none of the `count` values at `values` is NaN or infinite.
[[nodiscard]] inline bool all_finite(float const* values, int count) noexcept {
    for (int i = 0; i < count; ++i) {
        std::uint32_t bits;
        std::memcpy(&bits, values + i, sizeof bits);
        if ((bits & 0x7f800000u) == 0x7f800000u) return false;
    }
    return true;
}

[[nodiscard]] inline bool all_finite(double const* values, int count) noexcept {
    constexpr std::uint64_t exponent = 0x7ff0000000000000u;
    for (int i = 0; i < count; ++i) {
        std::uint64_t bits;
        std::memcpy(&bits, values + i, sizeof bits);
        if ((bits & exponent) == exponent) return false;
    }
    return true;
}

// For the high-precision twin of tests, never run with -ffast-math: formats of long double differ between platforms.
[[nodiscard]] inline bool all_finite(long double const* values, int count) noexcept {
    for (int i = 0; i < count; ++i)
        if (!(values[i] >= std::numeric_limits<long double>::lowest() &&
              values[i] <= std::numeric_limits<long double>::max()))
            return false;
    return true;
}

// True for +infinity alone: a camera without a far plane. Its name is not used: clang warns of that under -ffast-math.
template <class T>
[[nodiscard]] inline bool is_positive_infinity(T const* value) noexcept {
    constexpr std::uint32_t of_float = 0x7f800000u;
    constexpr std::uint64_t of_double = 0x7ff0000000000000u;
    if (sizeof(T) == sizeof of_float) return std::memcmp(value, &of_float, sizeof of_float) == 0;
    if (std::numeric_limits<T>::digits == 53) return std::memcmp(value, &of_double, sizeof of_double) == 0;
    return *value > std::numeric_limits<T>::max();
}

template <class T>
[[nodiscard]] inline bool all_finite(Vec2<T> const& v) noexcept {
    return all_finite(&v.x, 2);
}
template <class T>
[[nodiscard]] inline bool all_finite(Vec3<T> const& v) noexcept {
    return all_finite(&v.x, 3);
}
template <class T>
[[nodiscard]] inline bool all_finite(Vec4<T> const& v) noexcept {
    return all_finite(&v.x, 4);
}
template <class T>
[[nodiscard]] inline bool all_finite(Mat4<T> const& m) noexcept {
    return all_finite(m[0]) && all_finite(m[1]) && all_finite(m[2]) && all_finite(m[3]);
}

template <class T>
struct Normalized {
    Vec3<T> direction{T(0)};  // unit, or zero when `ok` is false
    T length = T(0);          // of the input; may overflow to infinity for components near the largest number
    bool ok = false;
};

// Unit to 2 ulp for every finite vector but the zero vector: nothing overflows, and a length of 1e-30 in float is as
// good as one of 1. Dividing by the largest component first is what makes it so. A vector with a NaN or an infinity in
// it is as good as zero.
template <class T>
[[nodiscard]] inline Normalized<T> safe_normalize(Vec3<T> const& v) noexcept {
    if (!all_finite(v)) return {};
    Vec3<T> const magnitude(std::abs(v.x), std::abs(v.y), std::abs(v.z));
    T largest = magnitude.x > magnitude.y ? magnitude.x : magnitude.y;
    largest = largest > magnitude.z ? largest : magnitude.z;
    if (!(largest > T(0))) return {};
    // -ffast-math divides by way of the reciprocal, which overflows or vanishes for what is very short or very long. A
    // power of two first, which is exact, leaves it room.
    constexpr T up = T(0x1p100), down = T(0x1p-100);
    T const power = largest < down ? up : (largest > up ? down : T(1));
    Vec3<T> const moderate = v * power;
    T const divisor = largest * power;
    Vec3<T> const scaled(moderate.x / divisor, moderate.y / divisor, moderate.z / divisor);
    T const length = std::sqrt(glm::dot(scaled, scaled));
    return {scaled / length, length * largest, true};
}

namespace detail {

// The length of (a, b) to an ulp, where neither is NaN or infinite; no square over- or underflows. With a root alone:
// the last bit of std::hypot is the platform's.
template <class T>
[[nodiscard]] inline T hypotenuse(T a, T b) noexcept {
    using Exact = decltype(T() + double());
    Exact x = Exact(a), y = Exact(b);
    if (sizeof(T) == sizeof(float)) return T(std::sqrt(x * x + y * y));
    // By a power of two, which is exact.
    constexpr Exact up = Exact(0x1p700), down = Exact(0x1p-700);
    Exact const largest = std::abs(x) > std::abs(y) ? std::abs(x) : std::abs(y);
    Exact const power = largest < Exact(0x1p-400) ? up : (largest > Exact(0x1p400) ? down : Exact(1));
    x *= power, y *= power;
    Exact const back = power < Exact(1) ? up : (power > Exact(1) ? down : Exact(1));
    return T(std::sqrt(x * x + y * y) * back);
}

}  // namespace detail

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/bounds.hpp ========
//
// Boxes and spheres in whatever space they are said to be in. An empty box is a value, the default one: merging with it
// changes nothing, and a fit that is given one has nothing to see.

namespace shadowmath {
inline namespace v0 {

template <class T>
struct Aabb {
    Vec3<T> lo{std::numeric_limits<T>::max()};
    Vec3<T> hi{std::numeric_limits<T>::lowest()};
};

template <class T>
struct Sphere {
    Vec3<T> center{T(0)};
    T radius = T(0);
};

// Boxes as structure of arrays: box i is [lo_x[i], hi_x[i]] x ...
template <class T>
struct BoxArrays {
    T const* lo_x = nullptr;
    T const* lo_y = nullptr;
    T const* lo_z = nullptr;
    T const* hi_x = nullptr;
    T const* hi_y = nullptr;
    T const* hi_z = nullptr;
};

template <class T>
[[nodiscard]] inline Aabb<T> box_at(BoxArrays<T> const& boxes, int i) noexcept {
    return {Vec3<T>(boxes.lo_x[i], boxes.lo_y[i], boxes.lo_z[i]), Vec3<T>(boxes.hi_x[i], boxes.hi_y[i], boxes.hi_z[i])};
}

// The boxes from `begin` on.
template <class T>
[[nodiscard]] inline BoxArrays<T> boxes_from(BoxArrays<T> const& boxes, int begin) noexcept {
    return {boxes.lo_x + begin, boxes.lo_y + begin, boxes.lo_z + begin,
            boxes.hi_x + begin, boxes.hi_y + begin, boxes.hi_z + begin};
}

// Empty as soon as one axis has lo > hi, or a NaN.
template <class T>
[[nodiscard]] inline bool is_empty(Aabb<T> const& box) noexcept {
    return !(box.lo.x <= box.hi.x && box.lo.y <= box.hi.y && box.lo.z <= box.hi.z);
}

template <class T>
[[nodiscard]] inline bool all_finite(Aabb<T> const& box) noexcept {
    return all_finite(box.lo) && all_finite(box.hi);
}

template <class T>
[[nodiscard]] inline Aabb<T> merge(Aabb<T> const& box, Vec3<T> const& point) noexcept {
    return {glm::min(box.lo, point), glm::max(box.hi, point)};
}

template <class T>
[[nodiscard]] inline Aabb<T> merge(Aabb<T> const& a, Aabb<T> const& b) noexcept {
    return {glm::min(a.lo, b.lo), glm::max(a.hi, b.hi)};
}

// May be empty.
template <class T>
[[nodiscard]] inline Aabb<T> intersect(Aabb<T> const& a, Aabb<T> const& b) noexcept {
    return {glm::max(a.lo, b.lo), glm::min(a.hi, b.hi)};
}

template <class T>
[[nodiscard]] inline bool contains(Aabb<T> const& box, Vec3<T> const& point) noexcept {
    return box.lo.x <= point.x && point.x <= box.hi.x && box.lo.y <= point.y && point.y <= box.hi.y &&
           box.lo.z <= point.z && point.z <= box.hi.z;
}

// Bit 0 of the index chooses x, bit 1 y, bit 2 z; two corners share an edge when their indices differ in one bit.
template <class T>
[[nodiscard]] inline std::array<Vec3<T>, 8> corners(Aabb<T> const& box) noexcept {
    return {box.lo,
            Vec3<T>(box.hi.x, box.lo.y, box.lo.z),
            Vec3<T>(box.lo.x, box.hi.y, box.lo.z),
            Vec3<T>(box.hi.x, box.hi.y, box.lo.z),
            Vec3<T>(box.lo.x, box.lo.y, box.hi.z),
            Vec3<T>(box.hi.x, box.lo.y, box.hi.z),
            Vec3<T>(box.lo.x, box.hi.y, box.hi.z),
            box.hi};
}

template <class T>
[[nodiscard]] inline Aabb<T> bounds_of(std::array<Vec3<T>, 8> const& points) noexcept {
    Aabb<T> box;
    for (Vec3<T> const& point : points) box = merge(box, point);
    return box;
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/clip_space.hpp ========
//
// The conventions of a graphics API as a value, never as a macro: the order of depth, the direction of NDC y, and how
// texture rows count. Every function that makes a matrix takes one; the same scene gives the same lit or shadowed
// decision in all of them.
//
//   canonical   what shadowmath computes in before the last step: depth 0 at the near end, 1 at the far end, y up.
//   clip        what the API wants: clip_from_canonical(clip) * canonical_from_world.
//
// Choose by the pass that DRAWS THE MAP, not by the pass that draws the screen. Reversed depth: take a named value and
// set `depth` to DepthOrder::one_to_zero; clear to far_depth(clip) and test with "greater".

namespace shadowmath {
inline namespace v0 {

enum class DepthOrder : std::uint8_t {
    zero_to_one,      // near 0, far 1
    one_to_zero,      // near 1, far 0: "reversed z"
    minus_one_to_one  // near -1, far 1: OpenGL without glClipControl
};

enum class YAxis : std::uint8_t { up, down };

struct ClipSpace {
    DepthOrder depth = DepthOrder::zero_to_one;
    YAxis ndc_y = YAxis::up;      // which way NDC y = +1 points in the picture
    YAxis texture_v = YAxis::up;  // which way texture v = 1 points in the picture
};

inline constexpr ClipSpace gl_clip{DepthOrder::minus_one_to_one, YAxis::up, YAxis::up};
inline constexpr ClipSpace gl_zero_to_one_clip{DepthOrder::zero_to_one, YAxis::up, YAxis::up};
inline constexpr ClipSpace vulkan_clip{DepthOrder::zero_to_one, YAxis::down, YAxis::down};
inline constexpr ClipSpace d3d_clip{DepthOrder::zero_to_one, YAxis::up, YAxis::down};
inline constexpr ClipSpace metal_clip = d3d_clip;
inline constexpr ClipSpace webgpu_clip = d3d_clip;
inline constexpr ClipSpace vulkan_negative_viewport_clip = d3d_clip;

[[nodiscard]] constexpr ClipSpace reversed(ClipSpace clip) noexcept {
    clip.depth = DepthOrder::one_to_zero;
    return clip;
}

// The value that a map is cleared to, and that "nothing in the way" reads as.
template <class T>
[[nodiscard]] constexpr T far_depth(ClipSpace clip) noexcept {
    return clip.depth == DepthOrder::one_to_zero ? T(0) : T(1);
}

// Changes convention only: in canonical form the identity.
template <class T>
[[nodiscard]] inline Mat4<T> clip_from_canonical(ClipSpace clip) noexcept {
    T const y = clip.ndc_y == YAxis::up ? T(1) : T(-1);
    Vec4<T> depth(T(0), T(0), T(1), T(0));
    if (clip.depth == DepthOrder::one_to_zero) depth = Vec4<T>(T(0), T(0), T(-1), T(1));
    if (clip.depth == DepthOrder::minus_one_to_one) depth = Vec4<T>(T(0), T(0), T(2), T(-1));
    return from_rows(Vec4<T>(T(1), T(0), T(0), T(0)), Vec4<T>(T(0), y, T(0), T(0)), depth,
                     Vec4<T>(T(0), T(0), T(0), T(1)));
}

template <class T>
[[nodiscard]] inline Mat4<T> canonical_from_clip(ClipSpace clip) noexcept {
    T const y = clip.ndc_y == YAxis::up ? T(1) : T(-1);
    Vec4<T> depth(T(0), T(0), T(1), T(0));
    if (clip.depth == DepthOrder::one_to_zero) depth = Vec4<T>(T(0), T(0), T(-1), T(1));
    if (clip.depth == DepthOrder::minus_one_to_one) depth = Vec4<T>(T(0), T(0), T(0.5), T(0.5));
    return from_rows(Vec4<T>(T(1), T(0), T(0), T(0)), Vec4<T>(T(0), y, T(0), T(0)), depth,
                     Vec4<T>(T(0), T(0), T(0), T(1)));
}

// texture_from_clip * clip, divided by w, is (u, v, stored depth), each in [0, 1] exactly for points inside the map.
// "Stored depth" is what the depth buffer holds: OpenGL's default range is halved on the way there.
template <class T>
[[nodiscard]] inline Mat4<T> texture_from_clip(ClipSpace clip) noexcept {
    T const half = T(0.5);
    T const v = clip.ndc_y == clip.texture_v ? half : -half;
    Vec4<T> depth(T(0), T(0), T(1), T(0));
    if (clip.depth == DepthOrder::minus_one_to_one) depth = Vec4<T>(T(0), T(0), half, half);
    return from_rows(Vec4<T>(half, T(0), T(0), half), Vec4<T>(T(0), v, T(0), half), depth,
                     Vec4<T>(T(0), T(0), T(0), T(1)));
}

// One shadow test: is the receiver at or before the occluder that the map stored? `bias` is an amount of stored depth
// in favour of light, never negative. A depth of exactly the map's is lit.
template <class T>
[[nodiscard]] constexpr bool is_lit(T stored_depth, T receiver_depth, T bias, ClipSpace clip) noexcept {
    return clip.depth == DepthOrder::one_to_zero ? receiver_depth + bias >= stored_depth
                                                 : receiver_depth - bias <= stored_depth;
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/fault.hpp ========
//
// What was wrong with the data, and which fallback was taken: a set of bits inside every result.
//
// Data (whatever a level, a configuration file, a window or a user can produce) never aborts and never poisons. A
// result says `visible` when its matrix serves something; `faults` says why not, or what was mended on the way.
// A result may be visible with faults (mended), and invisible without any (there was simply nothing to see).

namespace shadowmath {
inline namespace v0 {

enum class Fault : std::uint32_t {
    not_finite = 1u << 0,         // a NaN or an infinity where a number was needed
    zero_light = 1u << 1,         // the light's direction has no length
    near_clamped = 1u << 2,       // the near distance was raised so that ratios of distances exist
    empty_range = 1u << 3,        // near < 0, or near >= far
    far_clamped = 1u << 4,        // the far distance is infinite or too far, and was cut
    bad_frustum = 1u << 5,        // sides crossed, equal or not finite: a field of view outside (0, pi), an aspect of 0
    bad_pose = 1u << 6,           // the axes are too far from orthonormal to be mended
    count_clamped = 1u << 7,      // more maps asked for than fit, or than the range can be divided into
    clamped_option = 1u << 8,     // an option outside its stated range was brought to the nearer end
    map_too_small = 1u << 9,      // fewer texels than filter and snapping need
    bad_region = 1u << 10,        // a tile or region without area, or outside its map
    cone_clamped = 1u << 11,      // a spot's half angle was brought into its range
    invalid_plane = 1u << 12,     // a shadow plane that contains the light or the eye, or has no normal
    bad_projection = 1u << 13,    // a given projection matrix from which no view volume can be read
    precision_lost = 1u << 14,    // coordinates too large for the scalar type to keep texels still; use double
    warp_faded = 1u << 15,        // light and view are nearly parallel: the warp gave way to a uniform map
    storage_too_small = 1u << 16  // the caller's arrays are shorter than the result needs
};

struct Faults {
    std::uint32_t bits = 0;

    constexpr Faults() noexcept = default;
    constexpr Faults(Fault fault) noexcept : bits(static_cast<std::uint32_t>(fault)) {}

    [[nodiscard]] constexpr bool any() const noexcept { return bits != 0; }
    [[nodiscard]] constexpr bool has(Fault fault) const noexcept {
        return (bits & static_cast<std::uint32_t>(fault)) != 0;
    }
    constexpr Faults& operator|=(Faults other) noexcept {
        bits |= other.bits;
        return *this;
    }
    friend constexpr Faults operator|(Faults a, Faults b) noexcept { return a |= b; }
    friend constexpr bool operator==(Faults a, Faults b) noexcept { return a.bits == b.bits; }
    friend constexpr bool operator!=(Faults a, Faults b) noexcept { return a.bits != b.bits; }
};

[[nodiscard]] constexpr Faults operator|(Fault a, Fault b) noexcept {
    return Faults(a) | Faults(b);
}

// One sentence a fault; never null.
[[nodiscard]] constexpr char const* describe(Fault fault) noexcept {
    switch (fault) {
        case Fault::not_finite: return "an input is NaN or infinite";
        case Fault::zero_light: return "the light direction has no length";
        case Fault::near_clamped: return "the near distance was raised above zero";
        case Fault::empty_range: return "the near distance is negative or not below the far distance";
        case Fault::far_clamped: return "the far distance was cut to a finite one";
        case Fault::bad_frustum: return "the sides of the view volume are crossed, equal or not finite";
        case Fault::bad_pose: return "the axes of the pose are not orthonormal";
        case Fault::count_clamped: return "the number of maps was reduced";
        case Fault::clamped_option: return "an option outside its range was clamped";
        case Fault::map_too_small: return "the map has fewer texels than filter and snapping need";
        case Fault::bad_region: return "a region has no area or lies outside its map";
        case Fault::cone_clamped: return "the half angle of the spot light was clamped";
        case Fault::invalid_plane: return "the shadow plane contains the light or the eye, or has no normal";
        case Fault::bad_projection: return "no view volume can be read from the projection matrix";
        case Fault::precision_lost: return "coordinates are too large for this scalar type to keep texels still";
        case Fault::warp_faded: return "light and view are nearly parallel, the warp gave way to a uniform map";
        case Fault::storage_too_small: return "the storage given is smaller than the result needs";
    }
    return "no fault";
}

// The sentence of the lowest bit set; "no fault" for the empty set. Clear bits to walk through all of them.
[[nodiscard]] constexpr char const* describe(Faults faults) noexcept {
    return describe(static_cast<Fault>(faults.bits & (~faults.bits + 1u)));
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/shadow_map.hpp ========
//
// What every technique ends as: one matrix, where it is valid, and what went wrong.

namespace shadowmath {
inline namespace v0 {

template <class T>
struct ShadowMap {
    Mat4<T> clip_from_world = nowhere<T>();  // draw casters and look receivers up with it; always finite
    ClipSpace clip;                          // the convention it was made for
    T w_min = T(0);                          // the map holds no receiver whose clip w is at or below this
    bool visible = false;                    // false: it serves nothing, the matrix sends everything outside
    Faults faults;
};

// Where the map holds a point: u, v and stored depth in [0, 1].
template <class T>
[[nodiscard]] inline Mat4<T> texture_from_world(ShadowMap<T> const& map) noexcept {
    return texture_from_clip<T>(map.clip) * map.clip_from_world;
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/light.hpp ========
//
// A light as one homogeneous point, and the axes to look along it by.
//
// The law of shadow maps: a matrix M is a map of the light l exactly when M * homogeneous(l) = (0, 0, k, 0) with k > 0
// (k < 0 where depth is reversed) and w > 0 on what it must see. Then every light ray is one texel, and depth along it
// is ordered. l = (L, 0) for light that travels along L, l = (-p, -1) for a light at p.

namespace shadowmath {
inline namespace v0 {

enum class LightKind : std::uint8_t { directional, spot };

template <class T>
struct Light {
    LightKind kind = LightKind::directional;
    Vec3<T> direction{T(0), T(-1), T(0)};  // world, unit: how the light TRAVELS; of a spot, its axis
    Vec3<T> position{T(0)};                // world; spots only
    T half_angle_radians = T(0.5);         // spots only: from the axis to the edge of the cone, [1e-3, 1.5]
    T range = T(100);                      // spots only: metres that the light reaches, > 0
    Faults faults;                         // of the making: zero_light, not_finite, cone_clamped
};

// `travel` is the way the light goes (a sun overhead travels along -up), of any length.
template <class T>
[[nodiscard]] inline Light<T> directional(Vec3<T> const& travel) noexcept {
    Light<T> light;
    if (!all_finite(travel)) {
        light.faults = Fault::not_finite;
        return light;
    }
    Normalized<T> const unit = safe_normalize(travel);
    if (unit.ok)
        light.direction = unit.direction;
    else
        light.faults = Fault::zero_light;
    return light;
}

// The angle is HALF the cone: from its axis to its edge. It is clamped to [1e-3, 1.5] rad (86 degrees): beyond, the
// tangent that a map needs leaves every range of depth and resolution.
template <class T>
[[nodiscard]] inline Light<T> spot(Vec3<T> const& position, Vec3<T> const& axis, T half_angle_radians,
                                   T range) noexcept {
    Light<T> light = directional(axis);
    light.kind = LightKind::spot;
    if (!all_finite(position) || !all_finite(&half_angle_radians, 1) || !all_finite(&range, 1)) {
        light.faults |= Fault::not_finite;
        return light;
    }
    light.position = position;
    light.range = range;
    light.half_angle_radians = half_angle_radians;
    if (!(half_angle_radians >= T(1e-3))) light.half_angle_radians = T(1e-3);
    if (!(half_angle_radians <= T(1.5))) light.half_angle_radians = T(1.5);
    if (light.half_angle_radians != half_angle_radians) light.faults |= Fault::cone_clamped;
    if (!(range > T(0))) light.faults |= Fault::empty_range;
    return light;
}

// What a light made by hand or loaded from a file has wrong; includes the faults of its making.
template <class T>
[[nodiscard]] inline Faults faults_of(Light<T> const& light) noexcept {
    if (!all_finite(light.direction) || !all_finite(light.position) || !all_finite(&light.half_angle_radians, 1) ||
        !all_finite(&light.range, 1))
        return light.faults | Fault::not_finite;
    T const length2 = glm::dot(light.direction, light.direction);
    return std::abs(length2 - T(1)) <= T(1e-3) ? light.faults : light.faults | Fault::zero_light;
}

// True for a light from which no map can be made.
template <class T>
[[nodiscard]] inline bool unusable(Light<T> const& light) noexcept {
    Faults const faults = faults_of(light);
    return faults.has(Fault::not_finite) || faults.has(Fault::zero_light) || faults.has(Fault::empty_range);
}

template <class T>
[[nodiscard]] inline Vec4<T> homogeneous(Light<T> const& light) noexcept {
    return light.kind == LightKind::directional ? Vec4<T>(light.direction, T(0)) : Vec4<T>(-light.position, T(-1));
}

// From a point to the light: unit, or zero when the point is the light's own position.
template <class T>
[[nodiscard]] inline Vec3<T> toward(Light<T> const& light, Vec3<T> const& point) noexcept {
    if (light.kind == LightKind::directional) return -light.direction;
    return safe_normalize(light.position - point).direction;
}

// True where a plane with this normal sees nothing of the light: below a horizon, behind a wall.
template <class T>
[[nodiscard]] inline bool faces_away(Light<T> const& light, Vec3<T> const& point, Vec3<T> const& normal) noexcept {
    return !(glm::dot(normal, toward(light, point)) > T(0));
}

// Light space: x and y across the light, depth along it. right * up = -depth, so that a map keeps the winding of
// triangles as a camera would.
template <class T>
struct LightBasis {
    Vec3<T> x{T(1), T(0), T(0)};
    Vec3<T> y{T(0), T(0), T(-1)};
    Vec3<T> depth{T(0), T(-1), T(0)};  // the direction in which the light travels
};

// Orthonormal to 4 ulp for every direction, and continuous for all but one: light that travels straight along +y.
// The axes are those of light straight along -y, carried along the shortest turn. No up vector to be parallel to, and a
// sun that crosses the zenith makes no jump. `travel` is unit; one that is not finite gives the default axes.
template <class T>
[[nodiscard]] inline LightBasis<T> light_basis(Vec3<T> const& travel) noexcept {
    if (!all_finite(travel)) return {};
    Vec3<T> const& d = travel;
    // 1 + cos of the turn; past a right angle written so that nothing cancels.
    T const flat = d.x * d.x + d.z * d.z;
    T const k = d.y <= T(0) ? T(1) - d.y : flat / (T(1) + d.y);
    LightBasis<T> basis;
    basis.depth = d;
    // Closer to the one singular direction than a rounding error: its own axes are as good, and no denormals enter.
    constexpr T eps = std::numeric_limits<T>::epsilon();
    if (!(k > eps * eps)) {
        basis.y = Vec3<T>(T(0), T(0), T(1));
        return basis;
    }
    basis.x = Vec3<T>(T(1) - d.x * d.x / k, d.x, -d.x * d.z / k);
    basis.y = Vec3<T>(d.x * d.z / k, -d.z, d.z * d.z / k - T(1));
    return basis;
}

// Coordinates of a world point in light space: (x, y, depth), metres from the world origin.
template <class T>
[[nodiscard]] inline Vec3<T> in_light(LightBasis<T> const& basis, Vec3<T> const& point) noexcept {
    return Vec3<T>(glm::dot(basis.x, point), glm::dot(basis.y, point), glm::dot(basis.depth, point));
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/view_volume.hpp ========
//
// What the eye sees: a pose, four sides, and a range of depth. Perspective, off-centre, jittered, stereo and
// orthographic cameras are all one ViewVolume, and so is every slice of one.
//
// Corners come from the sides, never from the inverse of a view-projection matrix: at far/near = 1e6 the float inverse
// loses the far corners altogether, while the sides keep them to 4 ulp. So near and far distances are inputs; only the
// sides can be read from a projection matrix (view_from_projection).
//
//   pose.up    right side = right * depth          All axes are unit vectors in world space. Handedness of the world
//      |   /                                       never matters: "depth" grows along pose.forward.
//      |  /  forward
//      | /__________ pose.right
//    position

namespace shadowmath {
inline namespace v0 {

template <class T>
struct Pose {
    Vec3<T> position{T(0)};           // world
    Vec3<T> right{T(1), T(0), T(0)};  // world, unit, orthogonal to the other two
    Vec3<T> up{T(0), T(1), T(0)};
    Vec3<T> forward{T(0), T(0), T(-1)};  // the viewing direction
};

enum class ViewKind : std::uint8_t { perspective, orthographic };

template <class T>
struct ViewVolume {
    Pose<T> pose;
    T left = T(-1);  // sides: metres per metre of depth (perspective), or metres (orthographic)
    T right = T(1);
    T bottom = T(-1);
    T top = T(1);
    T z_near = T(0.1);  // metres along pose.forward
    T z_far = T(100);   // metres; may be infinite for a camera, not for a slice
    ViewKind kind = ViewKind::perspective;
};

// Looks from `position` along `forward`; `rough_up` only chooses the roll. Orthonormal for every input: where
// forward is (nearly) parallel to rough_up, the world axis least along forward takes its place; a forward that is zero
// or not finite becomes -z.
template <class T>
[[nodiscard]] inline Pose<T> pose_looking(Vec3<T> const& position, Vec3<T> const& forward,
                                          Vec3<T> const& rough_up) noexcept {
    Pose<T> pose;
    pose.position = position;
    Normalized<T> const direction = safe_normalize(forward);
    if (direction.ok) pose.forward = direction.direction;
    Normalized<T> const hint = safe_normalize(rough_up);
    Normalized<T> side = safe_normalize(glm::cross(pose.forward, hint.direction));
    if (!(side.length > T(1e-4))) {
        Vec3<T> const a(std::abs(pose.forward.x), std::abs(pose.forward.y), std::abs(pose.forward.z));
        Vec3<T> axis(T(0));
        axis[a.x <= a.y && a.x <= a.z ? 0 : (a.y <= a.z ? 1 : 2)] = T(1);
        side = safe_normalize(glm::cross(pose.forward, axis));
    }
    // The shorter the cross product, the less of it is orthogonal; a second look along it makes up for that.
    pose.right = safe_normalize(side.direction - pose.forward * glm::dot(pose.forward, side.direction)).direction;
    pose.up = glm::cross(pose.right, pose.forward);
    return pose;
}

// Symmetric perspective. Field of view in (0, pi), aspect = width / height > 0; anything else gives bad sides, which
// faults_of reports as bad_frustum.
template <class T>
[[nodiscard]] inline ViewVolume<T> perspective_view(Pose<T> const& pose, T fov_y_radians, T aspect, T z_near,
                                                    T z_far) noexcept {
    constexpr T pi = T(3.14159265358979323846264338327950288L);
    ViewVolume<T> view;
    view.pose = pose;
    view.top = fov_y_radians > T(0) && fov_y_radians < pi ? std::tan(fov_y_radians / T(2)) : T(0);
    view.bottom = -view.top;
    view.right = view.top * aspect;
    view.left = -view.right;
    view.z_near = z_near;
    view.z_far = z_far;
    return view;
}

template <class T>
[[nodiscard]] inline ViewVolume<T> orthographic_view(Pose<T> const& pose, T left, T right, T bottom, T top, T z_near,
                                                     T z_far) noexcept {
    return {pose, left, right, bottom, top, z_near, z_far, ViewKind::orthographic};
}

// Reads the four sides from a projection matrix of any kind and convention: right- or left-handed, y up or down,
// off-centre, reversed, infinite, orthographic. Near and far are given, because float entries have lost them. Take the
// projection without its sub-pixel jitter, or the fit will jitter too. A matrix from which no sides can be read gives
// equal sides, which faults_of reports as bad_frustum.
template <class T>
[[nodiscard]] inline ViewVolume<T> view_from_projection(Pose<T> const& pose, Mat4<T> const& clip_from_view, T z_near,
                                                        T z_far) noexcept {
    ViewVolume<T> view;
    view.pose = pose;
    view.z_near = z_near;
    view.z_far = z_far;
    view.left = view.right = view.bottom = view.top = T(0);
    T const x_scale = clip_from_view[0][0], y_scale = clip_from_view[1][1];
    if (!all_finite(clip_from_view) || x_scale == T(0) || y_scale == T(0)) return view;
    // Perspective: w = h * z_view, so a side is where scale * side + offset * sign(h) = +-|h|. Orthographic: w =
    // m[3][3].
    T const h = clip_from_view[2][3];
    view.kind = h == T(0) ? ViewKind::orthographic : ViewKind::perspective;
    bool const flat = view.kind == ViewKind::orthographic;
    T const w = std::abs(flat ? clip_from_view[3][3] : h);
    T const x_offset = flat ? clip_from_view[3][0] : (h < T(0) ? -clip_from_view[2][0] : clip_from_view[2][0]);
    T const y_offset = flat ? clip_from_view[3][1] : (h < T(0) ? -clip_from_view[2][1] : clip_from_view[2][1]);
    T const x0 = (-w - x_offset) / x_scale, x1 = (w - x_offset) / x_scale;
    T const y0 = (-w - y_offset) / y_scale, y1 = (w - y_offset) / y_scale;
    view.left = x0 < x1 ? x0 : x1;
    view.right = x0 < x1 ? x1 : x0;
    view.bottom = y0 < y1 ? y0 : y1;
    view.top = y0 < y1 ? y1 : y0;
    return view;
}

// Empty when every function may use the view as it is. An infinite z_far is no fault, a z_near of 0 neither.
template <class T>
[[nodiscard]] inline Faults faults_of(ViewVolume<T> const& view) noexcept {
    Faults faults;
    if (!all_finite(&view.left, 1) || !all_finite(&view.right, 1) || !all_finite(&view.bottom, 1) ||
        !all_finite(&view.top, 1) || !(view.left < view.right) || !(view.bottom < view.top))
        faults |= Fault::bad_frustum;
    bool const endless = is_positive_infinity(&view.z_far);
    if (!all_finite(view.pose.position) || !all_finite(view.pose.right) || !all_finite(view.pose.up) ||
        !all_finite(view.pose.forward) || !all_finite(&view.z_near, 1) || (!all_finite(&view.z_far, 1) && !endless))
        return faults | Fault::not_finite;
    if (!(view.z_near >= T(0)) || (!endless && !(view.z_near < view.z_far))) faults |= Fault::empty_range;
    Vec3<T> const &r = view.pose.right, &u = view.pose.up, &f = view.pose.forward;
    auto const differ = [](T value, T wanted) { return !(std::abs(value - wanted) <= T(1e-3)); };
    if (differ(glm::dot(r, r), T(1)) || differ(glm::dot(u, u), T(1)) || differ(glm::dot(f, f), T(1)) ||
        differ(glm::dot(r, u), T(0)) || differ(glm::dot(u, f), T(0)) || differ(glm::dot(f, r), T(0)))
        faults |= Fault::bad_pose;
    return faults;
}

// Mends a pose that is orthonormal to 1e-3 (float matrices that were multiplied often) to the last bit or two; the
// forward axis keeps its direction. A worse pose comes back as it is, and so does one that has nothing to mend.
// NOTE: products that depend on nothing are sooner known than roots of roots, which a processor then goes on without.
template <class T>
[[nodiscard]] inline Pose<T> orthonormalized(Pose<T> const& pose) noexcept {
    Vec3<T> const &r = pose.right, &u = pose.up, &f = pose.forward;
    auto const off = [](T value, T wanted) {
        return std::abs(value - wanted) <= T(4) * std::numeric_limits<T>::epsilon() ? 0 : 1;
    };
    int const how_many = (off(glm::dot(r, r), T(1)) + off(glm::dot(u, u), T(1)) + off(glm::dot(f, f), T(1))) +
                         (off(glm::dot(r, u), T(0)) + off(glm::dot(u, f), T(0)) + off(glm::dot(f, r), T(0)));
    if (how_many == 0) return pose;
    Normalized<T> const forward = safe_normalize(pose.forward);
    Normalized<T> const right =
        safe_normalize(pose.right - forward.direction * glm::dot(forward.direction, pose.right));
    if (!forward.ok || !right.ok) return pose;
    Pose<T> mended = pose;
    mended.forward = forward.direction;
    mended.right = right.direction;
    Vec3<T> const up = glm::cross(mended.right, mended.forward);
    mended.up = glm::dot(up, pose.up) < T(0) ? -up : up;  // a mirrored pose stays mirrored
    return mended;
}

namespace detail {

// In the unit of the sides, of a view without faults.
template <class T>
[[nodiscard]] inline T largest_side(ViewVolume<T> const& view) noexcept {
    auto const more = [](T a, T b) { return a > b ? a : b; };
    return more(more(std::abs(view.left), std::abs(view.right)), more(std::abs(view.bottom), std::abs(view.top)));
}

// Nothing that it sees is farther aside than `farthest` metres, which is what its far end says.
template <class T>
[[nodiscard]] inline bool sides_are_within(ViewVolume<T> const& view, T farthest) noexcept {
    T const spread = view.kind == ViewKind::perspective && view.z_far > T(1) ? view.z_far : T(1);
    return largest_side(view) <= farthest / spread;
}

}  // namespace detail

// The point seen at `side_x`, `side_y` (in the unit of the sides) and `depth` metres along the view.
template <class T>
[[nodiscard]] inline Vec3<T> point_at(ViewVolume<T> const& view, T side_x, T side_y, T depth) noexcept {
    T const spread = view.kind == ViewKind::perspective ? depth : T(1);
    return view.pose.position + view.pose.forward * depth + view.pose.right * (side_x * spread) +
           view.pose.up * (side_y * spread);
}

// The eight corners, each within 4 ulp of the larger of two ways: eye to corner, origin to eye. Bit 0 of the index
// chooses right, bit 1 top, bit 2 far; two corners share an edge when their indices differ in one bit. z_far must be
// finite.
template <class T>
[[nodiscard]] inline std::array<Vec3<T>, 8> corners(ViewVolume<T> const& view) noexcept {
    return {point_at(view, view.left, view.bottom, view.z_near), point_at(view, view.right, view.bottom, view.z_near),
            point_at(view, view.left, view.top, view.z_near),    point_at(view, view.right, view.top, view.z_near),
            point_at(view, view.left, view.bottom, view.z_far),  point_at(view, view.right, view.bottom, view.z_far),
            point_at(view, view.left, view.top, view.z_far),     point_at(view, view.right, view.top, view.z_far)};
}

// Metres along the view, positive in front of the eye.
template <class T>
[[nodiscard]] inline T eye_depth(ViewVolume<T> const& view, Vec3<T> const& point) noexcept {
    return glm::dot(view.pose.forward, point - view.pose.position);
}

// The eye's own matrix, for drawing the receivers and for measuring footprints. Written by rows: right, up and depth of
// a point against the pose, so that no handedness enters. An infinite z_far is exact. A view with faults, or too far
// from the origin for its scalar type, sees nothing.
template <class T>
[[nodiscard]] inline Mat4<T> clip_from_world(ViewVolume<T> const& view, ClipSpace clip) noexcept {
    if (faults_of(view).any()) return nowhere<T>();
    Pose<T> const& pose = view.pose;
    auto const plane = [&pose](Vec3<T> const& axis) { return Vec4<T>(axis, -glm::dot(axis, pose.position)); };
    Vec4<T> const x = plane(pose.right), y = plane(pose.up), depth = plane(pose.forward);
    Vec4<T> const one(T(0), T(0), T(0), T(1));
    bool const flat = view.kind == ViewKind::orthographic;
    Vec4<T> const& w = flat ? one : depth;
    T const width = view.right - view.left, height = view.top - view.bottom;
    T const n = view.z_near, range = view.z_far - view.z_near;
    bool const endless = is_positive_infinity(&view.z_far);
    // Depth as scale * depth + offset * one, 0 at near and w at far.
    T const scale = flat ? (endless ? T(0) : T(1) / range) : (endless ? T(1) : view.z_far / range);
    Mat4<T> const canonical =
        from_rows(T(2) / width * x - (view.right + view.left) / width * w,
                  T(2) / height * y - (view.top + view.bottom) / height * w, scale * (depth - n * one), w);
    Mat4<T> const converted = clip_from_canonical<T>(clip) * canonical;
    return all_finite(converted) ? converted : nowhere<T>();
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/reach.hpp ========
//
// How far numbers may reach before arithmetic on them leaves the range of float: the one limit of all fits. What lies
// beyond is not visible; boxes alone may be larger, since they are cut to what is in reach first.

namespace shadowmath {
inline namespace v0 {
namespace detail {

// Metres: a hundred light years. Squares stay finite in float.
template <class T>
inline constexpr T farthest_metres = T(1e18);

// Its inverse: lengths below have reciprocals that are too large.
template <class T>
inline constexpr T least_metres = T(1e-18);

// std::fmax of what is not negative; without a call of it, which is what compilers make of that one.
template <class T>
[[nodiscard]] inline T larger(T a, T b) noexcept {
    return b < a || b != b ? a : b;
}

template <class T>
[[nodiscard]] inline T largest_of(Vec3<T> const& v) noexcept {
    return larger(std::abs(v.x), larger(std::abs(v.y), std::abs(v.z)));
}

template <class T>
[[nodiscard]] inline T largest_of(Aabb<T> const& box) noexcept {
    return larger(largest_of(box.lo), largest_of(box.hi));
}

// The top bit is set where a value that is not negative is a NaN, an infinity, or 2^60 and more (above
// farthest_metres). By its bits (finite.hpp) and without a branch, so that many are a few instructions.
[[nodiscard]] inline std::uint32_t beyond_reach(float value) noexcept {
    std::uint32_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    return bits + (0x80000000u - 0x5d800000u);
}
[[nodiscard]] inline std::uint64_t beyond_reach(double value) noexcept {
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    return bits + (0x8000000000000000u - 0x43b0000000000000u);
}
[[nodiscard]] inline std::uint64_t beyond_reach(long double value) noexcept {
    return std::isless(value, 0x1p60L) ? 0 : ~std::uint64_t(0);
}

// The top bit is set where a value is not from `lo` to `hi`, lo > 0; likewise by its bits.
[[nodiscard]] inline std::uint32_t beyond(float value, float lo, float hi) noexcept {
    std::uint32_t bits, least, most;
    std::memcpy(&bits, &value, sizeof bits);
    std::memcpy(&least, &lo, sizeof least);
    std::memcpy(&most, &hi, sizeof most);
    return bits | (bits - least) | (most - bits);
}
[[nodiscard]] inline std::uint64_t beyond(double value, double lo, double hi) noexcept {
    std::uint64_t bits, least, most;
    std::memcpy(&bits, &value, sizeof bits);
    std::memcpy(&least, &lo, sizeof least);
    std::memcpy(&most, &hi, sizeof most);
    return bits | (bits - least) | (most - bits);
}
[[nodiscard]] inline std::uint64_t beyond(long double value, long double lo, long double hi) noexcept {
    return value >= lo && value <= hi ? 0 : ~std::uint64_t(0);
}

// Numbers that are not negative by their bits: these order as the numbers do, and above all of them come infinity and
// NaN. Negative numbers come below all others, but for -0, which is 0.
[[nodiscard]] inline std::int32_t order_of(float value) noexcept {
    std::int32_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    return bits == std::numeric_limits<std::int32_t>::min() ? 0 : bits;
}
[[nodiscard]] inline std::int64_t order_of(double value) noexcept {
    std::int64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    return bits == std::numeric_limits<std::int64_t>::min() ? 0 : bits;
}
[[nodiscard]] inline long double order_of(long double value) noexcept {
    constexpr std::uint32_t bits = 0x7f800000u;  // infinity without its name, of which clang warns under -ffast-math
    float infinity;
    std::memcpy(&infinity, &bits, sizeof infinity);
    return value == value ? value : static_cast<long double>(infinity);
}

// Unit to a thousandth, as light_basis makes them for every light that is usable.
template <class T>
[[nodiscard]] inline bool has_unit_axes(LightBasis<T> const& basis) noexcept {
    auto const is_unit = [](Vec3<T> const& axis) {
        return all_finite(axis) && largest_of(axis) < T(2) && std::abs(glm::dot(axis, axis) - T(1)) <= T(1e-3);
    };
    return is_unit(basis.x) && is_unit(basis.y) && is_unit(basis.depth);
}

}  // namespace detail
}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/splits.hpp ========
//
// Where to cut the view along its depth: n = C[0] < C[1] < ... < C[m] = f, in metres of eye depth.
//
//   uniform      C = n + (f - n) i/m         what one plain map does; starved near the eye
//   logarithmic  C = n (f/n)^(i/m)           optimal for perspective aliasing; the near maps hold almost nothing
//   practical    lambda * log + (1 - lambda) * uniform, lambda = 1/2 by default: use this
//   pinned       the first split ends where you say (a first-person weapon, a cockpit), practical behind it
//   explicit     your own list
//
// Source: Zhang, Sun, Nyman, "Parallel-Split Shadow Maps on Programmable GPUs", GPU Gems 3, chapter 10.1 (2007).
// Traps met in tutorials that retell it, each with the right value:
//   - lambda weights the LOGARITHM here and in the chapter; some code weights the uniform scheme. They agree only at
//     1/2.
//   - i/m in integers is 0 until i = m: every split lands on n.
//   - m splits have m + 1 planes. n = 1, f = 1000, m = 4, lambda = 1/2 gives
//     1, 128.18670662595, 266.06138830084, 464.03897050195, 1000 (not 128.185, 266.05, 463.625).
//   - n = 1, f = 1000, m = 3, logarithmic: the first two splits END at 1 % and 10 % of f; they OCCUPY 0.9009 % and
//     9.009 % of the range.
//   - the logarithmic map parameter is ln(z/n) / ln(f/n); without the division by n it is right for n = 1 only.

namespace shadowmath {
inline namespace v0 {

// The most splits that any function here makes; renderers use three to five, virtual clip maps more.
inline constexpr int max_splits = 16;

template <class T>
struct Splits {
    T plane[max_splits + 1] = {};  // plane[0] = n, plane[count] = f, exactly; the rest is zero
    int count = 0;                 // splits, one fewer than planes; 0: nothing to see
    Faults faults;
};

namespace detail {

// n and f as they can be used, and how many splits fit.
template <class T>
[[nodiscard]] inline Splits<T> open_splits(T const& z_near, T const& z_far, int count) noexcept {
    Splits<T> splits;
    if (!all_finite(&z_near, 1) || !all_finite(&z_far, 1)) {
        splits.faults = Fault::not_finite;
        return splits;
    }
    if (!(z_near >= T(0)) || !(z_near < z_far)) {
        splits.faults = Fault::empty_range;
        return splits;
    }
    splits.count = count < 0 ? 0 : (count > max_splits ? max_splits : count);
    if (splits.count != count) splits.faults |= Fault::count_clamped;
    return splits;
}

// Ends exact whatever the powers rounded to, planes strictly increasing: where rounding or a range of few representable
// numbers makes neighbours equal, the later one goes.
template <class T>
inline void close_splits(Splits<T>& splits, T z_near, T z_far) noexcept {
    if (splits.count == 0) return;
    splits.plane[0] = z_near;
    splits.plane[splits.count] = z_far;
    bool ordered = true;
    for (int i = 0; i < splits.count; ++i) ordered = ordered & (splits.plane[i] < splits.plane[i + 1]);
    if (ordered) return;
    int kept = 0;
    for (int i = 1; i < splits.count; ++i)
        if (splits.plane[i] > splits.plane[kept] && splits.plane[i] < z_far) splits.plane[++kept] = splits.plane[i];
    splits.plane[++kept] = z_far;
    splits.faults |= Fault::count_clamped;
    for (int i = kept + 1; i <= splits.count; ++i) splits.plane[i] = T(0);
    splits.count = kept;
}

// power[i] = ratio^(i / count), 0 < i < count. Where count is a power of two, from square roots alone: a pow costs more
// than all else in a fit. Twice as many hold the same values at every other place, to the bit.
template <class T>
inline void powers_of_ratio(T ratio, int count, T* power) noexcept {
    if ((count & (count - 1)) != 0) {
        for (int i = 1; i < count; ++i) power[i] = std::pow(ratio, T(i) / T(count));
        return;
    }
    power[0] = T(1);
    T root = ratio;
    for (int step = count / 2; step > 0; step /= 2) {
        root = std::sqrt(root);
        for (int i = step; i < count; i += 2 * step) power[i] = power[i - step] * root;
    }
}

template <class T>
[[nodiscard]] inline T clamped_lambda(T const& lambda, Faults& faults) noexcept {
    if (all_finite(&lambda, 1) && lambda >= T(0) && lambda <= T(1)) return lambda;
    faults |= Fault::clamped_option;
    return all_finite(&lambda, 1) ? (lambda > T(1) ? T(1) : T(0)) : T(0.5);
}

// Any case of practical_splits.
template <class T>
[[nodiscard]] inline Splits<T> any_practical_splits(T const& z_near, T const& z_far, int count,
                                                    T const& lambda) noexcept {
    Splits<T> splits = open_splits(z_near, z_far, count);
    T const weight = clamped_lambda(lambda, splits.faults);
    if (splits.count == 0) return splits;
    bool const has_ratio = z_near > z_far * T(0x1p-64);
    if (weight > T(0) && !has_ratio) splits.faults |= Fault::near_clamped;
    T const ratio = has_ratio ? z_far / z_near : T(1 << 20);
    T const log_near = has_ratio ? z_near : z_far / ratio;
    auto const blended = [&](T fraction, T power) {
        return weight * (log_near * power) + (T(1) - weight) * (z_near + (z_far - z_near) * fraction);
    };
    if (weight > T(0)) powers_of_ratio(ratio, splits.count, splits.plane);
    for (int i = 1; i < splits.count; ++i) splits.plane[i] = blended(T(i) / T(splits.count), splits.plane[i]);
    close_splits(splits, z_near, z_far);
    return splits;
}

// What most renderers ask for: four splits between ordinary distances. False where any of that is not so, and then
// `splits` is not to be used. The same bits as in any case.
template <class T>
[[nodiscard, gnu::always_inline]] inline bool four_practical_splits(T const& z_near, T const& z_far, T const& lambda,
                                                                    T (&plane)[max_splits + 1]) noexcept {
    auto const n = order_of(z_near), f = order_of(z_far), weight = order_of(lambda);
    auto const endless = order_of(std::numeric_limits<T>::max()) + 1, one = order_of(T(1));
    if (!((n > 0) & (n < f) & (f < endless) & (weight > 0) & (weight <= one)) || !(z_near > z_far * T(0x1p-64)))
        return false;
    T const ratio = z_far / z_near, half = std::sqrt(ratio), quarter = std::sqrt(half);
    auto const blended = [&](T fraction, T power) {
        return lambda * (z_near * power) + (T(1) - lambda) * (z_near + (z_far - z_near) * fraction);
    };
    plane[0] = z_near;
    plane[1] = blended(T(0.25), quarter);
    plane[2] = blended(T(0.5), half);
    plane[3] = blended(T(0.75), half * quarter);
    plane[4] = z_far;
    return (plane[0] < plane[1]) & (plane[1] < plane[2]) & (plane[2] < plane[3]) & (plane[3] < plane[4]);
}

}  // namespace detail

// Ends exact, strictly increasing, between the uniform and the logarithmic planes; lambda = 1 is logarithmic, 0
// uniform. z_near and z_far in metres, 0 <= z_near < z_far < infinity; count from 1 to max_splits (0 gives no split and
// no fault). Where no ratio of distances exists (z_near = 0, or below 2^-64 of z_far) the logarithmic part starts at
// 2^-20 of z_far (near_clamped).
template <class T>
[[nodiscard, gnu::always_inline]] inline Splits<T> practical_splits(T z_near, T z_far, int count,
                                                                    T lambda = T(0.5)) noexcept {
    // NOTE: one object and one return, or it is copied before it has left the store buffer.
    Splits<T> splits;
    if (count == 4 && detail::four_practical_splits(z_near, z_far, lambda, splits.plane))
        splits.count = 4;
    else
        splits = detail::any_practical_splits(z_near, z_far, count, lambda);
    return splits;
}

template <class T>
[[nodiscard]] inline Splits<T> uniform_splits(T z_near, T z_far, int count) noexcept {
    return practical_splits(z_near, z_far, count, T(0));
}

template <class T>
[[nodiscard]] inline Splits<T> logarithmic_splits(T z_near, T z_far, int count) noexcept {
    return practical_splits(z_near, z_far, count, T(1));
}

// As practical_splits, with plane[1] = first_end exactly. A first_end outside (z_near, z_far) is clamped_option, and
// the splits are practical throughout.
template <class T>
[[nodiscard]] inline Splits<T> pinned_splits(T z_near, T z_far, int count, T first_end, T lambda = T(0.5)) noexcept {
    bool const numbers = all_finite(&z_near, 1) && all_finite(&z_far, 1) && all_finite(&first_end, 1);
    bool const inside = numbers && first_end > z_near && first_end < z_far;
    if (count < 2 || !inside) {
        Splits<T> splits = practical_splits(z_near, z_far, count, lambda);
        if (!inside) splits.faults |= Fault::clamped_option;
        return splits;
    }
    Splits<T> splits = detail::open_splits(z_near, z_far, count);
    if (splits.count < 2) return splits;
    Splits<T> const behind = practical_splits(first_end, z_far, splits.count - 1, lambda);
    splits.faults |= behind.faults;
    for (int i = 0; i < behind.count; ++i) splits.plane[i + 1] = behind.plane[i];
    splits.count = behind.count + 1;
    detail::close_splits(splits, z_near, z_far);
    return splits;
}

// The caller's own inner planes, metres, increasing: `planes` holds count - 1 values. Those not inside (z_near, z_far)
// or not above their forerunner are left out (count_clamped).
template <class T>
[[nodiscard]] inline Splits<T> explicit_splits(T z_near, T z_far, T const* planes, int count) noexcept {
    SHADOWMATH_ASSERT(planes != nullptr || count <= 1, "explicit_splits needs count - 1 planes");
    Splits<T> splits = detail::open_splits(z_near, z_far, count);
    if (splits.count > 1 && !all_finite(planes, splits.count - 1)) {
        splits.faults |= Fault::not_finite;
        splits.count = 0;
    }
    for (int i = 1; i < splits.count; ++i) splits.plane[i] = planes[i - 1];
    detail::close_splits(splits, z_near, z_far);
    return splits;
}

// The lambda for which practical_splits puts its first inner plane at `first_end`; clamped to [0, 1] where none does.
template <class T>
[[nodiscard]] inline T lambda_for_first_split(T z_near, T z_far, int count, T first_end) noexcept {
    Splits<T> const uniform = uniform_splits(z_near, z_far, count), log = logarithmic_splits(z_near, z_far, count);
    if (uniform.count < 2 || log.count < 2 || !all_finite(&first_end, 1)) return T(0.5);
    T const span = uniform.plane[1] - log.plane[1];
    T const lambda = span > T(0) ? (uniform.plane[1] - first_end) / span : T(0.5);
    return lambda < T(0) ? T(0) : (lambda > T(1) ? T(1) : lambda);
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/slice.hpp ========
//
// One split of the view volume: itself a view volume, with the split's range of depth.
//
// With a blend band every slice but the first starts early, inside its forerunner, so that a renderer can fade from one
// map to the next. The band is a fraction of the forerunner's depth, at its end.

namespace shadowmath {
inline namespace v0 {

template <class T>
struct SliceRange {
    T begin = T(0);        // eye depth, metres: the map must hold everything from here
    T blend_begin = T(0);  // fading into the next map starts here; equal to end where nothing follows
    T end = T(0);          // to here
};

namespace detail {

// Where the last `share` of [begin, end] starts; never before begin, however the product rounds.
template <class T>
[[nodiscard]] inline T fade_begin(T begin, T end, T share) noexcept {
    // By halves, whose difference no type is too narrow for.
    T const at = end - T(2) * (share * (end * T(0.5) - begin * T(0.5)));
    return at > begin && at <= end ? at : begin;
}

}  // namespace detail

// Metres of eye depth that split `index` must serve; `blend` in [0, 1] is the fraction of each split that fades.
template <class T>
[[nodiscard]] inline SliceRange<T> slice_range(Splits<T> const& splits, int index, T blend = T(0)) noexcept {
    SHADOWMATH_ASSERT(index >= 0 && index < splits.count, "slice index outside the splits");
    T const share = blend > T(0) ? (blend < T(1) ? blend : T(1)) : T(0);
    SliceRange<T> range{splits.plane[index], splits.plane[index + 1], splits.plane[index + 1]};
    if (index > 0) range.begin = detail::fade_begin(splits.plane[index - 1], splits.plane[index], share);
    if (index + 1 < splits.count) range.blend_begin = detail::fade_begin(splits.plane[index], range.end, share);
    return range;
}

template <class T>
[[nodiscard]] inline ViewVolume<T> slice(ViewVolume<T> const& view, SliceRange<T> const& range) noexcept {
    ViewVolume<T> part = view;
    part.z_near = range.begin;
    part.z_far = range.end;
    return part;
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/fit_sphere.hpp ========
//
// The smallest ball around a slice: the fit that does not change when the camera turns. Put it on a texel grid and
// shadow edges stand still. A ball wastes what a box would use (about half of the texels, near half a right angle
// more); use fit_box where crawling edges do not show.
//
// Source: the closed form for symmetric perspective is that of lxjk, "Tight bounding sphere for cascaded shadow maps"
// (2017). Departures: orthographic and off-centre views (stereo, jitter, tiles) get the exact smallest ball too, and
// the radius is computed in view space and scaled, so that it is the same to the last bit wherever the camera stands.
//
//   far face decides           both faces decide
//    ________                    ______
//    \      /   centre on        \    /    centre between,
//     \    /    the far face      |  |     all eight corners
//      \  /                       |  |     on the sphere

namespace shadowmath {
inline namespace v0 {

namespace detail {

// The smallest ball of eight points that lie within a few units of the origin.
// It is the circumsphere of two, three or four of them. Any centre is good with the radius that it needs, so the least
// of those radii is the answer: no test has a tolerance, and a flat set of four costs nothing but a bad candidate.
template <class T>
[[nodiscard]] inline Sphere<T> smallest_ball(std::array<Vec3<T>, 8> const& points) noexcept {
    Sphere<T> best{Vec3<T>(T(0)), std::numeric_limits<T>::max()};  // the radius is squared until the end
    auto const consider = [&](Vec3<T> const& center) {
        T needed = T(0);
        for (Vec3<T> const& point : points) {
            Vec3<T> const arm = point - center;
            T const square = glm::dot(arm, arm);
            needed = square > needed ? square : needed;
        }
        if (needed < best.radius) best = {center, needed};
    };
    for (std::size_t i = 0; i < 8; ++i) {
        for (std::size_t j = i + 1; j < 8; ++j) {
            Vec3<T> const a = points[j] - points[i];
            consider(points[i] + a * T(0.5));
            for (std::size_t k = j + 1; k < 8; ++k) {
                Vec3<T> const b = points[k] - points[i], normal = glm::cross(a, b);
                T const aa = glm::dot(a, a), bb = glm::dot(b, b), area2 = glm::dot(normal, normal);
                if (area2 > T(0)) consider(points[i] + glm::cross(aa * b - bb * a, normal) / (T(2) * area2));
                for (std::size_t l = k + 1; l < 8; ++l) {
                    Vec3<T> const d = points[l] - points[i];
                    T const volume = glm::dot(normal, d);
                    if (volume == T(0)) continue;
                    Vec3<T> const sum = aa * glm::cross(b, d) + bb * glm::cross(d, a) + glm::dot(d, d) * normal;
                    consider(points[i] + sum / (T(2) * volume));
                }
            }
        }
    }
    best.radius = std::sqrt(best.radius);
    return best;
}

// A perspective slice whose far plane is at depth 1; view space is (right, up, forward).
template <class T>
[[nodiscard]] inline Sphere<T> ball_of_unit_slice(ViewVolume<T> const& view, T n) noexcept {
    if (view.left == -view.right && view.bottom == -view.top) {
        T const k2 = view.right * view.right + view.top * view.top;  // k: corner radius per metre of depth
        if (k2 * (T(1) + n) >= T(1) - n) return {Vec3<T>(T(0), T(0), T(1)), std::sqrt(k2)};
        T const c = T(0.5) * (T(1) + n) * (T(1) + k2), behind = T(1) - c;
        return {Vec3<T>(T(0), T(0), c), std::sqrt(behind * behind + k2)};
    }
    std::array<Vec3<T>, 8> points;
    for (std::size_t i = 0; i < 8; ++i) {
        T const depth = (i & 4u) != 0 ? T(1) : n;
        points[i] = Vec3<T>(((i & 1u) != 0 ? view.right : view.left) * depth,
                            ((i & 2u) != 0 ? view.top : view.bottom) * depth, depth);
    }
    return smallest_ball(points);
}

template <class T>
struct BallInView {
    Vec3<T> center{T(0)};  // (right, up, forward), in units
    T unit = T(1);         // metres
    T radius_metres = T(0);
};

// Of a slice without faults, of any kind.
template <class T>
[[nodiscard]] inline BallInView<T> ball_in_view(ViewVolume<T> const& slice) noexcept {
    bool const flat = slice.kind == ViewKind::orthographic;
    T const side = largest_side(slice);
    T const unit = flat ? std::fmax(side, slice.z_far) : slice.z_far;
    Sphere<T> ball;
    if (flat) {
        T const half = T(0.5) / unit;
        Vec3<T> const extent((slice.right - slice.left) * half, (slice.top - slice.bottom) * half,
                             (slice.z_far - slice.z_near) * half);
        ball.center = Vec3<T>((slice.left + slice.right) * half, (slice.bottom + slice.top) * half,
                              (slice.z_near + slice.z_far) * half);
        ball.radius = std::sqrt(glm::dot(extent, extent));
    } else {
        ball = ball_of_unit_slice(slice, slice.z_near / slice.z_far);
    }
    // Up by what the coordinates of corner and centre were rounded by.
    T const slack = T(8) * std::numeric_limits<T>::epsilon();
    return {ball.center, unit, (ball.radius + slack * (T(1) + ball.radius)) * unit};
}

}  // namespace detail

// Holds all eight corners, each to the rounding of its own world coordinates, and no smaller ball does, but for a few
// ulp. World centre, metres. The radius depends on sides, near and far only: bit for bit the same for every pose.
// Radius 0: there is no such ball, because faults_of(slice) is not empty, z_far is infinite, or something lies beyond
// 1e18 m.
template <class T>
[[nodiscard]] inline Sphere<T> bounding_sphere(ViewVolume<T> const& slice) noexcept {
    if (faults_of(slice).any() || is_positive_infinity(&slice.z_far)) return {};
    bool const flat = slice.kind == ViewKind::orthographic;
    Vec3<T> const &p = slice.pose.position, &f = slice.pose.forward, &r = slice.pose.right, &u = slice.pose.up;
    T const side = detail::largest_side(slice);
    if (!(std::fmax(slice.z_far, detail::largest_of(p)) <= detail::farthest_metres<T>) ||
        !(side <= (flat ? detail::farthest_metres<T> : T(1e9))) ||
        (!flat && !(side * slice.z_far <= detail::farthest_metres<T>)))
        return {};
    detail::BallInView<T> const seen = detail::ball_in_view(slice);
    Vec3<T> const& c = seen.center;
    return {p + (f * c.z + r * c.x + u * c.y) * seen.unit, seen.radius_metres};
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/lanes.hpp ========
//
// Four numbers that are computed with as one: a register where the compiler has vectors of float, an array elsewhere.
// The same operations in the same order either way, so the same bits.

// One instruction each, where the compiler lets them be named.
#if defined(__SSE2__) && defined(__has_builtin)
#if __has_builtin(__builtin_ia32_sqrtps) && __has_builtin(__builtin_ia32_minps) && __has_builtin(__builtin_ia32_maxps)
#define SHADOWMATH_NAMES_SSE 1
#endif
#endif
#ifndef SHADOWMATH_NAMES_SSE
#define SHADOWMATH_NAMES_SSE 0
#endif

namespace shadowmath {
inline namespace v0 {
namespace detail {

template <class T>
struct Lanes {
    using Scalar = T;
    static constexpr int fours = 1;
    T at[4];

    [[nodiscard]] static Lanes of(T a, T b, T c, T d) noexcept { return {{a, b, c, d}}; }
    [[nodiscard]] static Lanes all(T a) noexcept { return {{a, a, a, a}}; }
    [[nodiscard]] T operator[](int i) const noexcept { return at[i]; }

    friend Lanes absolute(Lanes const& a) noexcept {
        return {{std::abs(a.at[0]), std::abs(a.at[1]), std::abs(a.at[2]), std::abs(a.at[3])}};
    }
    friend Lanes operator+(Lanes const& a, Lanes const& b) noexcept {
        return {{a.at[0] + b.at[0], a.at[1] + b.at[1], a.at[2] + b.at[2], a.at[3] + b.at[3]}};
    }
    friend Lanes operator-(Lanes const& a, Lanes const& b) noexcept {
        return {{a.at[0] - b.at[0], a.at[1] - b.at[1], a.at[2] - b.at[2], a.at[3] - b.at[3]}};
    }
    friend Lanes operator*(Lanes const& a, Lanes const& b) noexcept {
        return {{a.at[0] * b.at[0], a.at[1] * b.at[1], a.at[2] * b.at[2], a.at[3] * b.at[3]}};
    }
    friend Lanes operator/(Lanes const& a, Lanes const& b) noexcept {
        return {{a.at[0] / b.at[0], a.at[1] / b.at[1], a.at[2] / b.at[2], a.at[3] / b.at[3]}};
    }
    friend Lanes least(Lanes const& a, Lanes const& b) noexcept {
        auto const less = [](T x, T y) { return x < y ? x : y; };
        return {{less(a.at[0], b.at[0]), less(a.at[1], b.at[1]), less(a.at[2], b.at[2]), less(a.at[3], b.at[3])}};
    }
    // Place by place, a <= b ? then : otherwise.
    friend Lanes where_at_most(Lanes const& a, Lanes const& b, Lanes const& then, Lanes const& otherwise) noexcept {
        Lanes chosen;
        for (int i = 0; i < 4; ++i) chosen.at[i] = a.at[i] <= b.at[i] ? then.at[i] : otherwise.at[i];
        return chosen;
    }
    friend Lanes root(Lanes const& a) noexcept {
        return {{std::sqrt(a.at[0]), std::sqrt(a.at[1]), std::sqrt(a.at[2]), std::sqrt(a.at[3])}};
    }
    friend Lanes largest(Lanes const& a, Lanes const& b) noexcept {
        auto const more = [](T x, T y) { return x > y ? x : y; };
        return {{more(a.at[0], b.at[0]), more(a.at[1], b.at[1]), more(a.at[2], b.at[2]), more(a.at[3], b.at[3])}};
    }
};

#if defined(__GNUC__) && (defined(__SSE2__) || defined(__ARM_NEON))

template <>
struct Lanes<float> {
    using Scalar = float;
    static constexpr int fours = 1;
    using Register [[gnu::vector_size(16)]] = float;
    Register at;

    [[nodiscard]] static Lanes of(float a, float b, float c, float d) noexcept { return {Register{a, b, c, d}}; }
    [[nodiscard]] static Lanes all(float a) noexcept { return {Register{a, a, a, a}}; }
    [[nodiscard]] float operator[](int i) const noexcept { return at[i]; }

    friend Lanes absolute(Lanes const& a) noexcept {
        using Bits [[gnu::vector_size(16)]] = std::uint32_t;
        Bits bits;
        std::memcpy(&bits, &a, sizeof bits);
        bits &= 0x7fffffffu;
        Lanes made;
        std::memcpy(&made, &bits, sizeof bits);
        return made;
    }
    friend Lanes operator+(Lanes const& a, Lanes const& b) noexcept { return {a.at + b.at}; }
    friend Lanes operator-(Lanes const& a, Lanes const& b) noexcept { return {a.at - b.at}; }
    friend Lanes operator*(Lanes const& a, Lanes const& b) noexcept { return {a.at * b.at}; }
    friend Lanes operator/(Lanes const& a, Lanes const& b) noexcept { return {a.at / b.at}; }
    friend Lanes where_at_most(Lanes const& a, Lanes const& b, Lanes const& then, Lanes const& otherwise) noexcept {
        return {a.at <= b.at ? then.at : otherwise.at};
    }
#if SHADOWMATH_NAMES_SSE
    friend Lanes least(Lanes const& a, Lanes const& b) noexcept {
        return {__builtin_ia32_minps(a.at, b.at)};
    }
    friend Lanes largest(Lanes const& a, Lanes const& b) noexcept {
        return {__builtin_ia32_maxps(a.at, b.at)};
    }
    friend Lanes root(Lanes const& a) noexcept {
        return {__builtin_ia32_sqrtps(a.at)};
    }
#else
    friend Lanes least(Lanes const& a, Lanes const& b) noexcept {
        return {a.at < b.at ? a.at : b.at};
    }
    friend Lanes largest(Lanes const& a, Lanes const& b) noexcept {
        return {a.at > b.at ? a.at : b.at};
    }
    friend Lanes root(Lanes const& a) noexcept {
        return of(std::sqrt(a.at[0]), std::sqrt(a.at[1]), std::sqrt(a.at[2]), std::sqrt(a.at[3]));
    }
#endif
};

#endif

// The last three of the four, and `after` them.
// NOTE: to be preferred to loading them where the four have just been written one by one.
template <class T>
[[nodiscard]] inline Lanes<T> moved_up(Lanes<T> const& four, T after) noexcept {
    return Lanes<T>::of(four[1], four[2], four[3], after);
}

// The places a, b, c and d of the four; 4 to 7 are those of `more`.
template <int a, int b, int c, int d, class T>
[[nodiscard]] inline Lanes<T> picked(Lanes<T> const& four, Lanes<T> const& more) noexcept {
    auto const at = [&](int i) { return i < 4 ? four[i] : more[i - 4]; };
    return Lanes<T>::of(at(a), at(b), at(c), at(d));
}

// Place by place, brought from `lo` to `hi`, 0 < lo: by their bits, so that nothing is raised by what is no number.
template <class T>
[[nodiscard]] inline Lanes<T> between(Lanes<T> const& four, T lo, T hi) noexcept {
    auto const brought = [lo, hi](T at) {
        return order_of(at) < order_of(lo) ? lo : order_of(hi) < order_of(at) ? hi : at;
    };
    return Lanes<T>::of(brought(four[0]), brought(four[1]), brought(four[2]), brought(four[3]));
}

// Whether any of them is beyond reach (reach.hpp), for several at a time.
template <class T>
class BeyondReach {
public:
    void look_at(Lanes<T> const& four) noexcept {
        for (int i = 0; i < 4; ++i) beyond_ |= beyond_reach(std::abs(four[i]));
    }
    // Parts of unit vectors: 2 and more is beyond, as the rounding that is allowed for would be too little.
    void look_at_parts(Lanes<T> const& four) noexcept { look_at(four * Lanes<T>::of(big, big, big, big)); }
    // Whatever is finite is within reach.
    void look_for_finite(Lanes<T> const& four) noexcept {
        for (int i = 0; i < 4; ++i) beyond_ |= all_finite(&four.at[i], 1) ? 0 : ~decltype(beyond_)(0);
    }
    [[nodiscard]] bool any() const noexcept { return beyond_ >> (8 * sizeof beyond_ - 1) != 0; }

private:
    static constexpr T big = T(0x1p59);
    decltype(beyond_reach(T(0))) beyond_ = 0;
};

#if defined(__GNUC__) && (defined(__SSE2__) || defined(__ARM_NEON))

#if defined(__clang__) || __GNUC__ >= 12
template <>
[[nodiscard]] inline Lanes<float> moved_up(Lanes<float> const& four, float after) noexcept {
    return {__builtin_shufflevector(four.at, Lanes<float>::Register{after}, 1, 2, 3, 4)};
}

template <int a, int b, int c, int d>
[[nodiscard]] inline Lanes<float> picked(Lanes<float> const& four, Lanes<float> const& more) noexcept {
    return {__builtin_shufflevector(four.at, more.at, a, b, c, d)};
}
#endif

template <>
[[nodiscard]] inline Lanes<float> between(Lanes<float> const& four, float lo, float hi) noexcept {
    using Bits [[gnu::vector_size(16)]] = std::int32_t;
    Bits at;
    std::memcpy(&at, &four, sizeof at);
    Bits const least = Bits{} + order_of(lo), most = Bits{} + order_of(hi);
    at = at < least ? least : at;
    at = at > most ? most : at;
    Lanes<float> made;
    std::memcpy(&made, &at, sizeof at);
    return made;
}

template <>
class BeyondReach<float> {
public:
    void look_at(Lanes<float> const& four) noexcept {
        Bits bits;
        std::memcpy(&bits, &four, sizeof bits);
        beyond_ |= (bits & 0x7fffffffu) + (0x80000000u - 0x5d800000u);
    }
    void look_at_parts(Lanes<float> const& four) noexcept {
        Bits bits;
        std::memcpy(&bits, &four, sizeof bits);
        beyond_ |= (bits & 0x7fffffffu) + (0x80000000u - 0x40000000u);
    }
    void look_for_finite(Lanes<float> const& four) noexcept {
        Bits bits;
        std::memcpy(&bits, &four, sizeof bits);
        beyond_ |= (bits & 0x7fffffffu) + (0x80000000u - 0x7f800000u);
    }
    [[nodiscard]] bool any() const noexcept {
        std::uint64_t halves[2];
        std::memcpy(halves, &beyond_, sizeof halves);
        return ((halves[0] | halves[1]) & 0x8000000080000000u) != 0;
    }

private:
    using Bits [[gnu::vector_size(16)]] = std::uint32_t;
    Bits beyond_ = {};
};

#endif

template <int a, int b, int c, int d, class T>
[[nodiscard]] inline Lanes<T> picked(Lanes<T> const& four) noexcept {
    return picked<a, b, c, d>(four, four);
}

// Rows for columns.
template <class T>
inline void transpose(Lanes<T> (&rows)[4]) noexcept {
    Lanes<T> const a = picked<0, 4, 1, 5>(rows[0], rows[1]), b = picked<0, 4, 1, 5>(rows[2], rows[3]);
    Lanes<T> const c = picked<2, 6, 3, 7>(rows[0], rows[1]), d = picked<2, 6, 3, 7>(rows[2], rows[3]);
    rows[0] = picked<0, 1, 4, 5>(a, b);
    rows[1] = picked<2, 3, 6, 7>(a, b);
    rows[2] = picked<0, 1, 4, 5>(c, d);
    rows[3] = picked<2, 3, 6, 7>(c, d);
}

template <class T>
[[nodiscard]] inline Lanes<T> four_at(T const* values) noexcept {
    Lanes<T> four;
    static_assert(sizeof four == 4 * sizeof(T), "numbers without a gap");
    std::memcpy(&four, values, sizeof four);
    return four;
}

template <class T>
[[nodiscard]] inline Lanes<T> all_four(T value) noexcept {
    return Lanes<T>::of(value, value, value, value);
}

// What edges are divided by to find where they meet a plane; nothing is divided by less. Planes are moved some epsilon
// of the reach of what they bound: along what leans less, none is met within a million times the length of an edge.
template <class T>
inline constexpr T least_divisor = T(1e-6) * std::numeric_limits<T>::epsilon();

template <class T>
[[nodiscard]] inline T not_zero(T value) noexcept {
    return std::abs(value) >= least_divisor<T> ? value : least_divisor<T>;
}
template <class T>
[[nodiscard, gnu::always_inline]] inline Lanes<T> not_zero(Lanes<T> const& value) noexcept {
    Lanes<T> const least = all_four(least_divisor<T>);
    return where_at_most(least, absolute(value), value, least);
}

}  // namespace detail
}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/margin.hpp ========
//
// How many texels of a map's side are left for the body when a filter must not read outside: the kernel needs a margin
// on either side, and a fit that promises one must take it out of the map.

namespace shadowmath {
inline namespace v0 {

// map_too_small where fewer than three texels are left: the body's own, and one to either side that snapping may take.
// A negative margin counts as none (clamped_option).
template <class T>
[[nodiscard]] inline Faults faults_of_margin(int map_size, T const& margin_texels) noexcept {
    if (!all_finite(&margin_texels, 1)) return Fault::not_finite;
    Faults faults;
    if (margin_texels < T(0)) faults |= Fault::clamped_option;
    T const margin = margin_texels > T(0) ? margin_texels : T(0);
    if (!(T(map_size) >= T(3) + T(2) * margin)) faults |= Fault::map_too_small;
    return faults;
}

// Texels between the margins, at least one whatever is given.
template <class T>
[[nodiscard]] inline T usable_texels(int map_size, T const& margin_texels) noexcept {
    if (!all_finite(&margin_texels, 1) || !(margin_texels < T(map_size))) return T(1);
    T const left = T(map_size) - T(2) * (margin_texels > T(0) ? margin_texels : T(0));
    return left > T(1) ? left : T(1);
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/slices.hpp ========
//
// All slices of a view at once, and nothing but the slices: what fit_box and fit_sphere with texel_grid give, twenty
// times as fast as from an inverse matrix and eight corners. For thousands of views, and for renderers whose casters
// are drawn with depth clamp; where scene bounds are to decide how deep a map is, use fit_cascades.
//
//   Along a light axis a, what is seen from depth n to f spans      a.eye + [min(n k, f k), max(n K, f K)],
//   k = a.forward + the least of a.right * side_x + a.up * side_y,  K with the largest.
//
// Four dot products an axis therefore serve every slice, no corner is computed, and the three axes are the lanes of one
// vector: the loops over `axis` below are one instruction a line.
//
// Source: ours; the closed forms of the spheres are those of fit_sphere.

namespace shadowmath {
inline namespace v0 {

namespace detail {

// A view in light space. Lanes are the light's axes: x, y, depth; the fourth is zero.
template <class T>
struct ViewInLight {
    Lanes<T> x, y, z;   // columns of the rotation into light space
    Lanes<T> eye_lo;    // at depth 0, the least, and less by what it may be rounded by
    Lanes<T> eye_hi;    // and the largest
    Lanes<T> slope_lo;  // by which they grow with depth
    Lanes<T> slope_hi;
    Lanes<T> eye, forward, right, up;  // the view's pose
    T sides;                           // how far they are from the middle, all together
    T rounding_slope;                  // by which the rounding of a coordinate grows with depth
};

template <class T>
[[nodiscard]] inline T absolute_sum(Vec3<T> const& v) noexcept {
    return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

// False, where a number is not finite or beyond 2^60 m, a side is crossed, or an axis of the light is no unit vector.
// NOTE: not inlined, it would hand over its twelve registers by way of memory.
template <class T>
[[nodiscard, gnu::always_inline]] inline bool look(LightBasis<T> const& basis, ViewVolume<T> const& view,
                                                   ViewInLight<T>& seen) noexcept {
    seen.x = Lanes<T>::of(basis.x.x, basis.y.x, basis.depth.x, T(0));
    seen.y = Lanes<T>::of(basis.x.y, basis.y.y, basis.depth.y, T(0));
    seen.z = Lanes<T>::of(basis.x.z, basis.y.z, basis.depth.z, T(0));
    BeyondReach<T> beyond;
    if constexpr (sizeof view.pose == 12 * sizeof(T)) {
        for (int i = 0; i < 12; i += 4) beyond.look_at(four_at(&view.pose.position.x + i));
    } else {
        // GLM's aligned vectors have a gap behind each.
        for (Vec3<T> const* v : {&view.pose.position, &view.pose.forward, &view.pose.right, &view.pose.up})
            beyond.look_at(Lanes<T>::of(v->x, v->y, v->z, T(0)));
    }
    beyond.look_at(four_at(&view.left));
    beyond.look_at_parts(seen.x);
    beyond.look_at_parts(seen.y);
    beyond.look_at_parts(seen.z);
    if (beyond.any() || !(view.left < view.right) || !(view.bottom < view.top)) return false;
    auto const along = [&seen](Vec3<T> const& v) {
        return seen.x * all_four(v.x) + seen.y * all_four(v.y) + seen.z * all_four(v.z);
    };
    Pose<T> const& pose = view.pose;
    Lanes<T> const eye = along(pose.position), forward = along(pose.forward);
    Lanes<T> const right = along(pose.right), up = along(pose.up);
    seen.eye = eye, seen.forward = forward, seen.right = right, seen.up = up;
    Lanes<T> const a = right * all_four(view.left), b = right * all_four(view.right);
    Lanes<T> const c = up * all_four(view.bottom), d = up * all_four(view.top);
    Lanes<T> const lo = least(a, b) + least(c, d), hi = largest(a, b) + largest(c, d);
    T const sides = std::abs(view.left) + std::abs(view.right) + std::abs(view.bottom) + std::abs(view.top);
    seen.sides = sides;
    constexpr T unit = T(8) * std::numeric_limits<T>::epsilon();
    if (view.kind == ViewKind::orthographic) {
        Lanes<T> const rounding = all_four(unit * (absolute_sum(pose.position) + sides));
        seen.eye_lo = eye + lo - rounding;
        seen.eye_hi = eye + hi + rounding;
        seen.slope_lo = seen.slope_hi = forward;
        seen.rounding_slope = unit;
    } else {
        Lanes<T> const rounding = all_four(unit * absolute_sum(pose.position));
        seen.eye_lo = eye - rounding;
        seen.eye_hi = eye + rounding;
        seen.slope_lo = forward + lo;
        seen.slope_hi = forward + hi;
        seen.rounding_slope = unit * (T(1) + sides);
    }
    return true;
}

// Neither so near that a reciprocal overflows nor out of reach; increasing, as all functions make them.
template <class T>
[[nodiscard, gnu::always_inline]] inline bool in_range(Splits<T> const& splits) noexcept {
    if (splits.count < 1 || splits.count > max_splits) return false;
    T const* const p = splits.plane;
    auto const zero = order_of(T(0)), nearest = order_of(least_metres<T>), farthest = order_of(farthest_metres<T>);
    if (splits.count == 4) {
        // NOTE: one by one, as they have just been written; a vector of them would wait for the last.
        auto const a = order_of(p[0]), b = order_of(p[1]), c = order_of(p[2]), d = order_of(p[3]), e = order_of(p[4]);
        return (a >= zero) & (b >= nearest) & (a < b) & (b < c) & (c < d) & (d < e) & (e <= farthest);
    }
    auto last = order_of(splits.plane[0]);
    bool good = last >= zero;
    for (int i = 1; i <= splits.count; ++i) {
        auto const next = order_of(splits.plane[i]);
        good = good & (last < next);
        last = next;
    }
    auto const first_end = order_of(p[1]);
    return good & (first_end >= nearest) & (last <= farthest);
}

// As bounding_sphere asks of a slice.
template <class T>
[[nodiscard]] inline bool ball_in_reach(ViewVolume<T> const& view, T farthest) noexcept {
    T const side = largest_side(view);
    return view.kind == ViewKind::orthographic || (side <= T(1e9) && side * farthest <= farthest_metres<T>);
}

// Extent of the map on each axis, and its middle, in the convention.
template <class T>
struct MapInLanes {
    Lanes<T> extent;
    Lanes<T> middle;  // 1 in the fourth: w
};

// `side`: how much of [-1, 1] is used.
template <class T>
[[nodiscard]] inline MapInLanes<T> map_in_lanes(ClipSpace clip, T side) noexcept {
    T const y = clip.ndc_y == YAxis::up ? side : -side;
    T depth = T(1), middle = T(0.5);
    if (clip.depth == DepthOrder::one_to_zero) depth = T(-1);
    if (clip.depth == DepthOrder::minus_one_to_one) depth = T(2), middle = T(0);
    return {Lanes<T>::of(side, y, depth, T(0)), Lanes<T>::of(T(0), T(0), middle, T(1))};
}

template <class T>
inline void write_columns(ViewInLight<T> const& seen, Lanes<T> const& scale, Lanes<T> const& offset,
                          Mat4<T>& clip_from_world) noexcept {
    Lanes<T> const x = seen.x * scale, y = seen.y * scale, z = seen.z * scale;
    static_assert(4 * sizeof x == sizeof clip_from_world, "columns without a gap");
    std::memcpy(&clip_from_world[0].x, &x, sizeof x);
    std::memcpy(&clip_from_world[1].x, &y, sizeof y);
    std::memcpy(&clip_from_world[2].x, &z, sizeof z);
    std::memcpy(&clip_from_world[3].x, &offset, sizeof offset);
}

}  // namespace detail

// clip_from_world[i] is the map of slice i: the smallest light-space box around it, and no depth but the slice's own.
// Each corner of each slice is inside. `border` is the part of the map's side that is kept free on each of the four
// sides, for filters: 2.0f / 2048 for two texels; [0, 0.49]. Writes splits.count matrices and says true; or nowhere()
// and false, where a number is not finite or beyond 2^60 m, an axis is no axis, a side is crossed, or the border
// outside its range.
// NOTE: inlined, as what it is given has mostly just been made.
template <class T>
[[nodiscard, gnu::always_inline]] inline bool fit_slice_boxes(ViewVolume<T> const& view, LightBasis<T> const& basis,
                                                              Splits<T> const& splits, T border, ClipSpace clip,
                                                              Mat4<T>* clip_from_world) noexcept {
    using Lanes = detail::Lanes<T>;
    detail::ViewInLight<T> seen;
    if (!detail::look(basis, view, seen) || !detail::in_range(splits) ||
        !(detail::order_of(border) >= detail::order_of(T(0)) &&
          detail::order_of(border) <= detail::order_of(T(0.49)))) {
        for (int i = 0; i < splits.count; ++i) clip_from_world[i] = nowhere<T>();
        return false;
    }
    detail::MapInLanes<T> const map = detail::map_in_lanes(clip, T(2) - T(4) * border);
    Lanes const slope = detail::all_four(seen.rounding_slope), half = detail::all_four(T(0.5));
    Lanes const n = detail::all_four(splits.plane[0]);
    Lanes n_lo = n * seen.slope_lo, n_hi = n * seen.slope_hi;
    for (int i = 0; i < splits.count; ++i) {
        Lanes const f = detail::all_four(splits.plane[i + 1]), rounding = f * slope;
        Lanes const f_lo = f * seen.slope_lo, f_hi = f * seen.slope_hi;
        Lanes const lo = seen.eye_lo + (least(n_lo, f_lo) - rounding);
        Lanes const hi = seen.eye_hi + (largest(n_hi, f_hi) + rounding);
        Lanes const scale = map.extent / (hi - lo);
        detail::write_columns(seen, scale, map.middle - (lo + hi) * half * scale, clip_from_world[i]);
        n_lo = f_lo, n_hi = f_hi;
    }
    return true;
}

namespace detail {

// What the maps of all spheres of a view have in common.
template <class T>
struct SphereMaps {
    using Exact = decltype(T() + double());
    ViewInLight<T> seen;
    MapInLanes<T> map;
    T texel_per_radius;
    int size;      // texels along a map's side
    Exact eye[2];  // across the light, metres

    // The window around the centre of a ball at these coordinates; false where its texels cannot be counted. Depth is
    // scaled by `along`, and moved by `offset`.
    [[nodiscard, gnu::always_inline]] bool write(Exact x, Exact y, T texel, T along, T offset,
                                                 Mat4<T>& clip_from_world) const noexcept {
        Exact const per_side = 2 / Exact(size), texels = 1 / Exact(texel),
                    middle = Exact(0.5) - Exact(size) * Exact(0.5);
        Exact const left = x * texels + middle, bottom = y * texels + middle;
        if (!(std::abs(left) < Exact(0x1p51) && std::abs(bottom) < Exact(0x1p51)) || !(texel >= least_metres<T>))
            return false;
        auto const whole = [](Exact value) {
            auto const truncated = static_cast<Exact>(static_cast<std::int64_t>(value));
            return truncated - (truncated > value ? Exact(1) : Exact(0));
        };
        T const across = T(per_side * texels), up = map.extent[1];
        T const offset_x = T(-(whole(left) * per_side + 1)), offset_y = T(-(whole(bottom) * per_side + 1));
        write_columns(seen, Lanes<T>::of(across, across * up, along, T(0)),
                      Lanes<T>::of(offset_x, offset_y * up, offset, T(1)), clip_from_world);
        return true;
    }
};

// Slices of a view whose sides are equal, four at a time: the ball around one lies on its axis, no farther than its far
// face. False where one map is too far out or too fine for it: then all are made as those of any view.
// NOTE: loops of a constant length over arrays are what compilers make vectors of.
template <class T>
[[nodiscard, gnu::always_inline]] inline bool write_centred_spheres(SphereMaps<T> const& maps,
                                                                    ViewVolume<T> const& view, Splits<T> const& splits,
                                                                    Mat4<T>* clip_from_world) noexcept {
    using Lanes = Lanes<T>;
    using Exact = typename SphereMaps<T>::Exact;
    auto const all = [](T value) { return all_four(value); };
    T const k2 = view.right * view.right + view.top * view.top;  // k: radius of a face per metre of its depth
    T const per_radius = maps.texel_per_radius, nearest = splits.plane[1] * per_radius;
    T const ahead_x = maps.seen.forward[0], ahead_y = maps.seen.forward[1];
    Exact const eye_x = maps.eye[0], eye_y = maps.eye[1];
    T const farthest =
        T(std::abs(eye_x)) + T(std::abs(eye_y)) + (std::abs(ahead_x) + std::abs(ahead_y)) * splits.plane[splits.count];
    // No texel is finer than that of a ball of the first far face. 2^28 of them, and they no longer count in 32 bits.
    T const finest2 = k2 * nearest * nearest;
    if (!(finest2 >= T(1e-30)) || !(farthest * farthest < T(0x1p56) * finest2) || maps.size > (1 << 28)) return false;
    constexpr T slack = T(8) * std::numeric_limits<T>::epsilon();
    Lanes const lo_0 = all(maps.seen.eye_lo[2]), lo_slope = all(maps.seen.slope_lo[2]);
    Lanes const hi_0 = all(maps.seen.eye_hi[2]), hi_slope = all(maps.seen.slope_hi[2]);
    // Raised so that all places are positive, and conversion to an integer rounds downward.
    constexpr std::int32_t raised = 1 << 29;
    std::int32_t const back = maps.size - 2 * raised;
    Exact const middle = Exact(raised) + Exact(0.5) - Exact(maps.size) * Exact(0.5);
    for (int first = 0; first < splits.count; first += 4) {
        int const left = splits.count - first < 4 ? splits.count - first : 4;
        T const* const p = splits.plane + first;
        Lanes n = four_at(p), f;
        if (left == 4) {
            f = moved_up(n, p[4]);
        } else {
            // The last slice once more in the places that are left.
            n = Lanes::of(p[0], p[left > 1 ? 1 : 0], p[left > 2 ? 2 : left - 1], p[left - 1]);
            f = Lanes::of(p[1], p[left > 1 ? 2 : 1], p[left > 2 ? 3 : left], p[left]);
        }
        // 1 where the ball is centred on the far face: where its half width is no less than its depth.
        Lanes const centre = least((all(T(1)) + n / f) * all(T(0.5)) * all(T(1) + k2), all(T(1)));
        Lanes const behind = all(T(1)) - centre, radius = root(behind * behind + all(k2));
        Lanes const texel = radius * (f * all(per_radius + per_radius * slack)) + f * all(per_radius * slack);
        Lanes const per_texel = all(T(1)) / texel;
        T ahead_in_x[4], ahead_in_y[4], texels[4];
        Lanes const x_ahead = centre * f * all(ahead_x), y_ahead = centre * f * all(ahead_y);
        std::memcpy(ahead_in_x, &x_ahead, sizeof ahead_in_x);
        std::memcpy(ahead_in_y, &y_ahead, sizeof ahead_in_y);
        std::memcpy(texels, &per_texel, sizeof texels);
        Exact x[4], y[4];
        std::int32_t column[4], row[4];
        T offset_x[4], offset_y[4];
        for (int i = 0; i < 4; ++i) {
            x[i] = (eye_x + Exact(ahead_in_x[i])) * Exact(texels[i]) + middle;
            y[i] = (eye_y + Exact(ahead_in_y[i])) * Exact(texels[i]) + middle;
        }
        for (int i = 0; i < 4; ++i) column[i] = static_cast<std::int32_t>(x[i]) * 2 + back;
        for (int i = 0; i < 4; ++i) row[i] = static_cast<std::int32_t>(y[i]) * 2 + back;
        for (int i = 0; i < 4; ++i) offset_x[i] = static_cast<T>(-column[i]);
        for (int i = 0; i < 4; ++i) offset_y[i] = static_cast<T>(-row[i]);
        Lanes const rounding = f * all(maps.seen.rounding_slope);
        Lanes const lo = lo_0 + (least(n * lo_slope, f * lo_slope) - rounding);
        Lanes const hi = hi_0 + (largest(n * hi_slope, f * hi_slope) + rounding);
        Lanes const along = all(maps.map.extent[2]) / (hi - lo);
        T const per_side = T(1) / T(maps.size), up = maps.map.extent[1];
        Lanes scale[4] = {per_texel * all(T(2) * per_side), per_texel * all(T(2) * per_side * up), along, all(T(0))};
        Lanes move[4] = {four_at(offset_x) * all(per_side), four_at(offset_y) * all(per_side * up),
                         all(maps.map.middle[2]) - (lo + hi) * all(T(0.5)) * along, all(T(1))};
        transpose(scale);
        transpose(move);
        for (int i = 0; i < left; ++i) write_columns(maps.seen, scale[i], move[i], clip_from_world[first + i]);
    }
    return true;
}

// Slices of any view, one after the other; nowhere() for those that no map can be made of.
template <class T>
[[nodiscard, gnu::noinline]] inline bool write_spheres(SphereMaps<T> const& maps, ViewVolume<T> const& view,
                                                       LightBasis<T> const& basis, Splits<T> const& splits,
                                                       Mat4<T>* clip_from_world) noexcept {
    using Exact = typename SphereMaps<T>::Exact;
    auto const exact = [](Vec3<T> const& axis, Vec3<T> const& v) {
        return Exact(axis.x) * Exact(v.x) + Exact(axis.y) * Exact(v.y) + Exact(axis.z) * Exact(v.z);
    };
    ViewInLight<T> const& seen = maps.seen;
    Pose<T> const& pose = view.pose;
    ViewVolume<T> part = view;
    bool good = true;
    for (int i = 0; i < splits.count; ++i) {
        T const n = splits.plane[i], f = splits.plane[i + 1];
        part.z_near = n, part.z_far = f;
        BallInView<T> const ball = ball_in_view(part);
        Exact const unit = Exact(ball.unit), depth = Exact(ball.center.z) * unit;
        Exact const right = Exact(ball.center.x) * unit, up = Exact(ball.center.y) * unit;
        auto const across = [&](Vec3<T> const& axis) {
            return exact(axis, pose.forward) * depth + (exact(axis, pose.right) * right + exact(axis, pose.up) * up);
        };
        Exact const x = maps.eye[0] + across(basis.x), y = maps.eye[1] + across(basis.y);
        T const n_lo = n * seen.slope_lo[2], f_lo = f * seen.slope_lo[2];
        T const n_hi = n * seen.slope_hi[2], f_hi = f * seen.slope_hi[2];
        T const rounding = seen.rounding_slope * f;
        T const lo = seen.eye_lo[2] + ((n_lo < f_lo ? n_lo : f_lo) - rounding);
        T const hi = seen.eye_hi[2] + ((n_hi > f_hi ? n_hi : f_hi) + rounding);
        T const along = maps.map.extent[2] / (hi - lo), offset = maps.map.middle[2] - (lo + hi) * T(0.5) * along;
        if (!maps.write(x, y, ball.radius_metres * maps.texel_per_radius, along, offset, clip_from_world[i])) {
            clip_from_world[i] = nowhere<T>();
            good = false;
        }
    }
    return good;
}

}  // namespace detail

// As fit_slice_boxes, with the window of the slice's bounding sphere on the texel grid (texel_grid.hpp) for sides: what
// casts no shimmering shadows. Nothing of the sphere is lost in x and y, and no corner of the slice in depth. False as
// well where the margin leaves no texel, or the view is so far out that its texels cannot be counted.
template <class T>
[[nodiscard]] inline bool fit_slice_spheres(ViewVolume<T> const& view, LightBasis<T> const& basis,
                                            Splits<T> const& splits, int map_size, T margin_texels, ClipSpace clip,
                                            Mat4<T>* clip_from_world) noexcept {
    detail::SphereMaps<T> maps;
    using Exact = typename detail::SphereMaps<T>::Exact;
    Faults const margin = faults_of_margin(map_size, margin_texels);
    if (!detail::look(basis, view, maps.seen) || !detail::in_range(splits) || margin.has(Fault::not_finite) ||
        margin.has(Fault::map_too_small) || !detail::ball_in_reach(view, splits.plane[splits.count])) {
        for (int i = 0; i < splits.count; ++i) clip_from_world[i] = nowhere<T>();
        return false;
    }
    maps.map = detail::map_in_lanes(clip, T(1));
    maps.texel_per_radius =
        (T(2) + T(16) * std::numeric_limits<T>::epsilon()) / (usable_texels(map_size, margin_texels) - T(1));
    maps.size = map_size;
    // Both axes side by side: compilers make one vector of them.
    Exact const x[2] = {Exact(basis.x.x), Exact(basis.y.x)}, y[2] = {Exact(basis.x.y), Exact(basis.y.y)};
    Exact const z[2] = {Exact(basis.x.z), Exact(basis.y.z)};
    Vec3<T> const& eye = view.pose.position;
    for (int i = 0; i < 2; ++i) maps.eye[i] = x[i] * Exact(eye.x) + y[i] * Exact(eye.y) + z[i] * Exact(eye.z);
    bool const centred = view.left == -view.right && view.bottom == -view.top;
    if (centred && view.kind == ViewKind::perspective &&
        detail::write_centred_spheres(maps, view, splits, clip_from_world))
        return true;
    return detail::write_spheres(maps, view, basis, splits, clip_from_world);
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/long_lanes.hpp ========
//
// Several fours (lanes.hpp) that are computed with as one: as many as a register of the processor holds that the
// compiler is told of. Loops take `fours` steps at a time, and are the same source for one, two and four.

namespace shadowmath {
inline namespace v0 {
namespace detail {

template <class T>
struct LongLanesOf {
    using Type = Lanes<T>;
};

#if defined(__GNUC__) && defined(__AVX__) && (defined(__clang__) || __GNUC__ >= 12)

struct LongFloats {
    using Scalar = float;
#if defined(__AVX512F__)
    static constexpr int fours = 4;
#else
    static constexpr int fours = 2;
#endif
    using Register [[gnu::vector_size(16 * fours)]] = float;
    Register at;

#if defined(__AVX512F__)
    [[nodiscard]] static LongFloats all(float a) noexcept {
        return {Register{a, a, a, a, a, a, a, a, a, a, a, a, a, a, a, a}};
    }
#else
    [[nodiscard]] static LongFloats all(float a) noexcept {
        return {Register{a, a, a, a, a, a, a, a}};
    }
#endif
    friend LongFloats operator+(LongFloats const& a, LongFloats const& b) noexcept {
        return {a.at + b.at};
    }
    friend LongFloats operator-(LongFloats const& a, LongFloats const& b) noexcept {
        return {a.at - b.at};
    }
    friend LongFloats operator*(LongFloats const& a, LongFloats const& b) noexcept {
        return {a.at * b.at};
    }
    friend LongFloats operator/(LongFloats const& a, LongFloats const& b) noexcept {
        return {a.at / b.at};
    }
    friend LongFloats least(LongFloats const& a, LongFloats const& b) noexcept {
        return {a.at < b.at ? a.at : b.at};
    }
    friend LongFloats largest(LongFloats const& a, LongFloats const& b) noexcept {
        return {a.at > b.at ? a.at : b.at};
    }
    friend LongFloats where_at_most(LongFloats const& a, LongFloats const& b, LongFloats const& then,
                                    LongFloats const& otherwise) noexcept {
        return {a.at <= b.at ? then.at : otherwise.at};
    }
};

template <>
struct LongLanesOf<float> {
    using Type = LongFloats;
};

#endif

template <class T>
using LongLanes = typename LongLanesOf<T>::Type;

// The same four throughout.
template <class Long, class T>
[[nodiscard]] inline Long repeated(Lanes<T> const& four) noexcept {
    if constexpr (Long::fours == 1) return four;
#if defined(__AVX512F__) && defined(__clang__)
    if constexpr (Long::fours == 4)
        return {__builtin_shufflevector(four.at, four.at, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3)};
#elif defined(__AVX512F__)
    if constexpr (Long::fours == 4)
        return {__builtin_ia32_broadcastf32x4_512(four.at, typename Long::Register{}, 0xffff)};
#elif defined(__AVX__)
    if constexpr (Long::fours == 2) return {__builtin_shufflevector(four.at, four.at, 0, 1, 2, 3, 0, 1, 2, 3)};
#endif
}

// four[first] in the first four places, four[first + 1] in the next.
template <class Long, class T>
[[nodiscard]] inline Long spread(Lanes<T> const& four, int first) noexcept {
    if constexpr (Long::fours == 1) return Long::all(four[first]);
#if defined(__AVX512F__)
    if constexpr (Long::fours == 4) {
        auto const all = repeated<Long>(four).at;
        return {__builtin_shufflevector(all, all, 0, 0, 0, 0, 5, 5, 5, 5, 10, 10, 10, 10, 15, 15, 15, 15)};
    }
#elif defined(__AVX__)
    if constexpr (Long::fours == 2) {
        auto const all = repeated<Long>(four).at;
        return first == 0 ? Long{__builtin_shufflevector(all, all, 0, 0, 0, 0, 5, 5, 5, 5)}
                          : Long{__builtin_shufflevector(all, all, 2, 2, 2, 2, 7, 7, 7, 7)};
    }
#endif
}

// Fours one behind the other.
template <class Long, class T>
[[nodiscard]] inline Long joined(Lanes<T> const* four) noexcept {
    if constexpr (Long::fours == 1) return four[0];
#if defined(__AVX__)
    if constexpr (Long::fours > 1) {
        auto const a = __builtin_shufflevector(four[0].at, four[1].at, 0, 1, 2, 3, 4, 5, 6, 7);
#if defined(__AVX512F__)
        auto const b = __builtin_shufflevector(four[2].at, four[3].at, 0, 1, 2, 3, 4, 5, 6, 7);
        return {__builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15)};
#else
        return {a};
#endif
    }
#endif
}

// `four` in the last four places.
template <class Long, class T>
[[nodiscard]] inline Long with_last([[maybe_unused]] Long const& lanes, Lanes<T> const& four) noexcept {
    if constexpr (Long::fours == 1) return four;
#if defined(__AVX512F__)
    if constexpr (Long::fours == 4) {
        auto const all = repeated<Long>(four).at;
        return {__builtin_shufflevector(lanes.at, all, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 28, 29, 30, 31)};
    }
#elif defined(__AVX__)
    if constexpr (Long::fours == 2)
        return {__builtin_shufflevector(lanes.at, repeated<Long>(four).at, 0, 1, 2, 3, 12, 13, 14, 15)};
#endif
}

template <class Long, class T>
[[nodiscard]] inline Long long_at(T const* values) noexcept {
    Long lanes;
    std::memcpy(&lanes, values, sizeof lanes);
    return lanes;
}

template <class T, class Long>
inline void store_long(T* values, Long const& lanes) noexcept {
    std::memcpy(values, &lanes, sizeof lanes);
}

}  // namespace detail
}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/view_of_box.hpp ========
//
// A box as a view sees it: from the eye, every plane a little farther out, its twelve edges cut by the four sides of
// the view. The half of slice_edges.hpp that no split has to do with.
//
// Source: ours. An edge enters the view where it goes inward through a side, and leaves it where outward.

namespace shadowmath {
inline namespace v0 {
namespace detail {

// A view with what it sees of a box, relative to the eye, every plane `slack` metres farther out. Side `i` of the view
// at depth z is at `slope[i] * z + offset[i]`; left, right, bottom, top.
template <class T>
struct ViewOfBox {
    Pose<T> const* pose;
    ViewInLight<T> lit;
    Lanes<T> slope;
    Lanes<T> offset;
    Lanes<T> lo;  // x, y, z
    Lanes<T> hi;
    T slack;
};

// False where the numbers are none that products of three can be made of, or nothing is there. After look(), which has
// seen that the view is finite and filled in `lit`.
template <class T>
[[nodiscard, gnu::always_inline]] inline bool look_at_box(ViewVolume<T> const& view, T farthest, Aabb<T> const& scene,
                                                          ViewOfBox<T>& seen) noexcept {
    using Lanes = Lanes<T>;
    constexpr T most = T(1e12);
    Vec3<T> const& eye = view.pose.position;
    T const x = std::abs(eye.x), y = std::abs(eye.y), z = std::abs(eye.z), sides = seen.lit.sides;
    bool const flat = view.kind == ViewKind::orthographic;
    T const reach = flat ? farthest + sides : farthest * (T(1) + sides);
    if (!((x <= most) & (y <= most) & (z <= most) & (sides <= most) & (reach <= most))) return false;
    BeyondReach<T> infinite;
    Lanes lo, hi;
    if constexpr (sizeof scene == 6 * sizeof(T)) {
        lo = four_at(&scene.lo.x);
        hi = moved_up(four_at(&scene.lo.z), T(0));
    } else {
        lo = Lanes::of(scene.lo.x, scene.lo.y, scene.lo.z, T(0));
        hi = Lanes::of(scene.hi.x, scene.hi.y, scene.hi.z, T(0));
    }
    infinite.look_for_finite(lo);
    infinite.look_for_finite(hi);
    if (infinite.any() || is_empty(scene)) return false;
    auto const size_of = [](Vec3<T> const& v) { return absolute(Lanes::of(v.x, v.y, v.z, T(0))); };
    Lanes const axes = size_of(view.pose.right) + size_of(view.pose.up) + size_of(view.pose.forward) +
                       (absolute(seen.lit.x) + absolute(seen.lit.y) + absolute(seen.lit.z));
    if (!(axes[0] + axes[1] + axes[2] <= T(12))) return false;  // six unit vectors sum up to less
    seen.slack = T(16) * std::numeric_limits<T>::epsilon() * (reach + (x + y + z));
    Lanes const of_side = four_at(&view.left), slack = all_four(seen.slack);
    Lanes const outward = Lanes::of(-seen.slack, seen.slack, -seen.slack, seen.slack);
    if (flat) {
        seen.slope = all_four(T(0));
        seen.offset = of_side + outward;
    } else {
        seen.slope = of_side;
        // A plane that leans is moved farther along its side than outward.
        seen.offset = outward * (all_four(T(1)) + absolute(of_side));
    }
    // Nothing of the view is farther from the eye along any axis than twice its reach.
    T const limit = T(2) * reach;
    auto const limited = [limit](Lanes const& at) { return largest(least(at, all_four(limit)), all_four(-limit)); };
    Lanes const at_eye = Lanes::of(eye.x, eye.y, eye.z, T(0));
    seen.lo = limited(lo - at_eye - slack);
    seen.hi = limited(hi - at_eye + slack);
    return true;
}

// The twelve edges of the box, four to an axis, from its lower face on; and four more that mean nothing. An edge is
// inside the sides of the view from `first` to `last` metres behind its origin. (x, y, z): origin in light space;
// ahead: metres along the edge that its depth in the view amounts to.
template <class T>
struct EdgesOfBox {
    T first[16], last[16], ahead[16], x[16], y[16], z[16];
    Lanes<T> per_ahead;  // of each axis: metres along it for one of depth
};

// Where an axis has its four edges: at the lower (0) or the upper (1) end of the others.
template <class T>
inline constexpr T edge_at[3][16] = {{0, 0, 0, 0, 0, 1, 0, 1, 0, 1, 0, 1, 0, 0, 0, 0},
                                     {0, 1, 0, 1, 0, 0, 0, 0, 0, 0, 1, 1, 0, 0, 0, 0},
                                     {0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 0, 0, 0, 0, 0, 0}};

template <int i>
struct Place {
    static constexpr int value = i;
};

// Lane i everywhere.
template <int i, class T>
[[nodiscard, gnu::always_inline]] inline Lanes<T> all_of(Lanes<T> const& four) noexcept {
    return picked<i, i, i, i>(four);
}
template <int i, class T>
[[nodiscard, gnu::always_inline]] inline LongLanes<T> long_of(Lanes<T> const& four) noexcept {
    return repeated<LongLanes<T>>(all_of<i>(four));
}

template <class T>
[[gnu::always_inline]] inline void cut_box_edges(ViewOfBox<T> const& seen, EdgesOfBox<T>& edges) noexcept {
    using Long = LongLanes<T>;
    using Lanes = Lanes<T>;
    auto const four = [](Vec3<T> const& v) { return Lanes::of(v.x, v.y, v.z, T(0)); };
    // By how much each axis goes inward through each side, metres a metre.
    Lanes const right = four(seen.pose->right), up = four(seen.pose->up), ahead = four(seen.pose->forward);
    Lanes const inward[4] = {right - ahead * all_of<0>(seen.slope), ahead * all_of<1>(seen.slope) - right,
                             up - ahead * all_of<2>(seen.slope), ahead * all_of<3>(seen.slope) - up};
    // An edge enters where it goes inward, and leaves where not: what it does not do is moved out of the way.
    constexpr T away = T(1e38);
    Lanes inverse[4], not_entered[4], not_left[4];
    for (int i = 0; i < 4; ++i) {
        Lanes const in = not_zero(inward[i]);
        inverse[i] = all_four(T(-1)) / in;
        not_entered[i] = where_at_most(in, all_four(T(0)), all_four(-away), all_four(T(0)));
        not_left[i] = not_entered[i] + all_four(away);
    }
    Lanes const length = seen.hi - seen.lo;
    Long const lo_x = long_of<0>(seen.lo), lo_y = long_of<1>(seen.lo), lo_z = long_of<2>(seen.lo);
    Long const hi_x = long_of<0>(seen.hi), hi_y = long_of<1>(seen.hi), hi_z = long_of<2>(seen.hi);
    edges.per_ahead = all_four(T(1)) / not_zero(ahead);
    for (int axis = 0; axis < 3; axis += Long::fours) {
        auto const end = [&](int i, Long const& lo, Long const& hi) {
            return where_at_most(long_at<Long>(edge_at<T>[i] + 4 * axis), Long::all(T(0)), lo, hi);
        };
        Long const x = end(0, lo_x, hi_x), y = end(1, lo_y, hi_y), z = end(2, lo_z, hi_z);
        auto const along = [&](Lanes const& v) { return x * long_of<0>(v) + y * long_of<1>(v) + z * long_of<2>(v); };
        Long const inside[4] = {along(inward[0]) - long_of<0>(seen.offset), along(inward[1]) + long_of<1>(seen.offset),
                                along(inward[2]) - long_of<2>(seen.offset), along(inward[3]) + long_of<3>(seen.offset)};
        Long first = Long::all(T(0)), last = spread<Long>(length, axis);
        auto const cut = [&](int i) {
            Long const root = inside[i] * spread<Long>(inverse[i], axis);
            first = largest(first, root + spread<Long>(not_entered[i], axis));
            last = least(last, root + spread<Long>(not_left[i], axis));
        };
        cut(0), cut(1), cut(2), cut(3);
        auto const store = [axis](T* to, Long const& lanes) { store_long(to + 4 * axis, lanes); };
        auto const lit = [&](auto place) {
            constexpr int i = decltype(place)::value;
            return x * long_of<i>(seen.lit.x) + y * long_of<i>(seen.lit.y) + z * long_of<i>(seen.lit.z);
        };
        store(edges.first, first);
        store(edges.last, last);
        store(edges.ahead, along(ahead) * spread<Long>(edges.per_ahead, axis));
        store(edges.x, lit(Place<0>()));
        store(edges.y, lit(Place<1>()));
        store(edges.z, lit(Place<2>()));
    }
}

}  // namespace detail
}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/slice_edges.hpp ========
//
// The edges of a view's slices and of a box in it, cut and bounded in light space: the inside of slices_in_scene.hpp.
// What the box comes to by itself is made by view_of_box.hpp.
//
// The corners of what a slice and a box have in common are where edges of one end, inside the other, or pass through
// its faces. So nothing but edges is clipped, each once for all slices, four at a time:
//
//   four corner rays of the view     to the box, then to the depths of every slice
//   four sides of each split plane   to the box; they belong to the slices on either side
//   twelve edges of the box          to the four sides of the view, then to the depths of every slice
//
// Source: ours. Edges instead of faces, as in polytope.hpp, but none is ever new.

namespace shadowmath {
inline namespace v0 {
namespace detail {

// Several vectors at a time.
template <class L>
struct Vectors {
    L x, y, z;

    [[gnu::always_inline]] friend Vectors operator+(Vectors const& a, Vectors const& b) noexcept {
        return {a.x + b.x, a.y + b.y, a.z + b.z};
    }
    [[gnu::always_inline]] friend Vectors operator*(Vectors const& a, L const& s) noexcept {
        return {a.x * s, a.y * s, a.z * s};
    }
    [[gnu::always_inline]] friend Vectors least(Vectors const& a, Vectors const& b) noexcept {
        return {least(a.x, b.x), least(a.y, b.y), least(a.z, b.z)};
    }
    [[gnu::always_inline]] friend Vectors largest(Vectors const& a, Vectors const& b) noexcept {
        return {largest(a.x, b.x), largest(a.y, b.y), largest(a.z, b.z)};
    }
};

template <class T>
using FourVectors = Vectors<Lanes<T>>;
template <class T>
using LongVectors = Vectors<LongLanes<T>>;

// Multiples of one vector.
template <class L, class T>
[[nodiscard, gnu::always_inline]] inline Vectors<L> times(L const& s, Vec3<T> const& v) noexcept {
    return {s * L::all(v.x), s * L::all(v.y), s * L::all(v.z)};
}

template <class T>
[[nodiscard, gnu::always_inline]] inline LongVectors<T> repeated(FourVectors<T> const& v) noexcept {
    using Long = LongLanes<T>;
    return {repeated<Long>(v.x), repeated<Long>(v.y), repeated<Long>(v.z)};
}

// Least and largest light-space coordinates of edges.
template <class L>
struct ExtentInLanes {
    Vectors<L> lo;
    Vectors<L> hi;

    [[gnu::always_inline]] void add(ExtentInLanes const& other) noexcept {
        lo = least(lo, other.lo);
        hi = largest(hi, other.hi);
    }
};

// Half a step along edges, and how long that is along each axis.
template <class L>
struct HalfStep {
    Vectors<L> step;
    Vectors<L> size;
};

// NOTE: no size is zero: an edge that is none must be seen on every axis.
template <class T>
[[nodiscard, gnu::always_inline]] inline HalfStep<LongLanes<T>> half_of(FourVectors<T> const& step) noexcept {
    Lanes<T> const half = all_four(T(0.5)), tiny = all_four(T(1e-18));
    FourVectors<T> const halved = step * half;
    auto const size = [&tiny](Lanes<T> const& a) { return absolute(a) + tiny; };
    return {repeated<T>(halved), repeated<T>(FourVectors<T>{size(halved.x), size(halved.y), size(halved.z)})};
}

// Edges from `origin` on, cut: what is left of them is from `first` to `last` steps along. Where first > last an edge
// is none.
template <class L>
struct CutEdges {
    Vectors<L> origin;
    HalfStep<L> const& half;
    L first, last;

    [[nodiscard, gnu::always_inline]] Vectors<L> middle() const noexcept { return origin + half.step * (first + last); }
    // Steps; of one that is none, less than nothing by more than anything can be long.
    [[nodiscard, gnu::always_inline]] L length() const noexcept {
        return where_at_most(first, last, last - first, L::all(typename L::Scalar(-1e37)));
    }
};

// What edges reach: around their middle, by half their length; inside out where an edge is none.
template <class L>
[[nodiscard, gnu::always_inline]] inline ExtentInLanes<L> extent_of(CutEdges<L> const& edges) noexcept {
    Vectors<L> const middle = edges.middle(), reach = edges.half.size * edges.length();
    return {{middle.x - reach.x, middle.y - reach.y, middle.z - reach.z}, middle + reach};
}

// Metres along edges at which they enter and leave the box between two of its faces, for edges whose origin lies
// `shift` farther along.
template <class L>
struct Passage {
    L enter, leave;

    [[gnu::always_inline]] void cut(L const& shift, L& first, L& last) const noexcept {
        first = largest(first, enter - shift);
        last = least(last, leave - shift);
    }
};

// Edges from `from` on; `inverse`: metres along them for one across.
// NOTE: products before differences: one difference serves all that are parallel, and is as near as that of rounded
// places can be.
template <class L>
[[nodiscard, gnu::always_inline]] inline Passage<L> passage(L const& lo, L const& hi, L const& from,
                                                            L const& inverse) noexcept {
    L const a = lo * inverse, b = hi * inverse, shift = from * inverse;
    return {least(a, b) - shift, largest(a, b) - shift};
}

// Least and largest coordinates of four edges in each of four slices.
template <class T>
struct ExtentsOfSlices {
    T lo[3][16], hi[3][16];

    // Of slices from i on.
    template <class Long>
    [[gnu::always_inline]] void store(int i, ExtentInLanes<Long> const& extent) noexcept {
        store_long(lo[0] + 4 * i, extent.lo.x), store_long(lo[1] + 4 * i, extent.lo.y);
        store_long(lo[2] + 4 * i, extent.lo.z), store_long(hi[0] + 4 * i, extent.hi.x);
        store_long(hi[1] + 4 * i, extent.hi.y), store_long(hi[2] + 4 * i, extent.hi.z);
    }
};

// All edges of four slices and the box.
template <class T>
struct EdgesInLight {
    using Four = Lanes<T>;
    using Long = LongLanes<T>;

    Four nearest, farthest;  // planes of each slice
    Four begins, ends;       // and a little farther apart
    EdgesOfBox<T> of_box;
    HalfStep<Long> along[3];  // its axes
    Four enter[3], leave[3];  // where the slices begin and end along them, had their edges no depth of their own
    // Corners of the view: (left, bottom), (right, bottom), (right, top), (left, top). Rays through them from depth 0.
    LongVectors<T> from, ray;
    HalfStep<Long> along_ray;
    Long first_of_ray, last_of_ray;
    // Sides of a split plane, from corner to corner: right, up, left, down; `length` metres at depth 0, `growth` more
    // for every metre of depth, and their origins `shift` farther along them.
    HalfStep<Long> along_side;
    Passage<Long> side_in_x, side_in_y, side_in_z;
    LongVectors<T> shift;
    Long growth, length;

    [[gnu::always_inline]] EdgesInLight(ViewOfBox<T> const& seen, Four const& begin, Four const& end) noexcept
        : nearest(begin), farthest(end) {
        auto const all = [](T value) { return all_four(value); };
        auto const lit = [](Four const& v) { return FourVectors<T>{all_of<0>(v), all_of<1>(v), all_of<2>(v)}; };
        Vec3<T> const &right = seen.pose->right, &up = seen.pose->up, &ahead = seen.pose->forward;
        begins = nearest - all(seen.slack), ends = farthest + all(seen.slack);
        cut_box_edges(seen, of_box);
        along[0] = half_of<T>(lit(seen.lit.x)), along[1] = half_of<T>(lit(seen.lit.y));
        along[2] = half_of<T>(lit(seen.lit.z));
        for (int axis = 0; axis < 3; ++axis) {
            Four const per_ahead = all(of_box.per_ahead[axis]), a = begins * per_ahead, b = ends * per_ahead;
            enter[axis] = least(a, b), leave[axis] = largest(a, b);
        }
        Four const x_slope = picked<0, 1, 1, 0>(seen.slope), y_slope = picked<2, 2, 3, 3>(seen.slope);
        Four const x_offset = picked<0, 1, 1, 0>(seen.offset), y_offset = picked<2, 2, 3, 3>(seen.offset);
        FourVectors<T> const right_lit = lit(seen.lit.right), up_lit = lit(seen.lit.up);
        FourVectors<T> const corner = times(x_offset, right) + times(y_offset, up);
        FourVectors<T> const outward = times(x_slope, right) + times(y_slope, up) + times(all(T(1)), ahead);
        FourVectors<T> const outward_lit = right_lit * x_slope + up_lit * y_slope + lit(seen.lit.forward);
        from = repeated<T>(right_lit * x_offset + up_lit * y_offset), ray = repeated<T>(outward_lit);
        along_ray = half_of<T>(outward_lit);
        FourVectors<T> const lo = lit(seen.lo), hi = lit(seen.hi);
        Four const one = all(T(1));
        Passage<Four> const x = passage(lo.x, hi.x, corner.x, one / not_zero(outward.x));
        Passage<Four> const y = passage(lo.y, hi.y, corner.y, one / not_zero(outward.y));
        Passage<Four> const z = passage(lo.z, hi.z, corner.z, one / not_zero(outward.z));
        first_of_ray = repeated<Long>(largest(x.enter, largest(y.enter, z.enter)));
        last_of_ray = repeated<Long>(least(x.leave, least(y.leave, z.leave)));
        Four const sideways = Four::of(T(1), T(0), T(-1), T(0)), upward = Four::of(T(0), T(1), T(0), T(-1));
        FourVectors<T> const side = times(sideways, right) + times(upward, up);
        along_side = half_of<T>(right_lit * sideways + up_lit * upward);
        Four const per_x = one / not_zero(side.x), per_y = one / not_zero(side.y), per_z = one / not_zero(side.z);
        auto const sides = [](Passage<Four> const& p) {
            return Passage<Long>{repeated<Long>(p.enter), repeated<Long>(p.leave)};
        };
        side_in_x = sides(passage(lo.x, hi.x, corner.x, per_x)),
        side_in_y = sides(passage(lo.y, hi.y, corner.y, per_y));
        side_in_z = sides(passage(lo.z, hi.z, corner.z, per_z));
        shift = repeated<T>(FourVectors<T>{outward.x * per_x, outward.y * per_y, outward.z * per_z});
        auto const apart = [](Four const& of) { return picked<1, 3, 1, 3>(of) - picked<0, 2, 0, 2>(of); };
        growth = repeated<Long>(apart(seen.slope)), length = repeated<Long>(apart(seen.offset));
    }

    // Planes are where they are: the box that their sides are cut by is larger.
    [[nodiscard, gnu::always_inline]] CutEdges<Long> sides_at(Long const& depth) const noexcept {
        Long first = Long::all(T(0)), last = growth * depth + length;
        side_in_x.cut(shift.x * depth, first, last);
        side_in_y.cut(shift.y * depth, first, last);
        side_in_z.cut(shift.z * depth, first, last);
        return {from + ray * depth, along_side, first, last};
    }
    // Those of slices from i on; their steps are metres of depth.
    [[nodiscard, gnu::always_inline]] CutEdges<Long> rays_in(int i) const noexcept {
        return {from, along_ray, largest(first_of_ray, spread<Long>(begins, i)),
                least(last_of_ray, spread<Long>(ends, i))};
    }
    [[nodiscard, gnu::always_inline]] CutEdges<Long> box_edges_in(int i, int axis) const noexcept {
        auto const at = [axis](T const* edge) { return repeated<Long>(four_at(edge + 4 * axis)); };
        Long const ahead = at(of_box.ahead);
        Long const first = largest(at(of_box.first), spread<Long>(enter[axis], i) - ahead);
        Long const last = least(at(of_box.last), spread<Long>(leave[axis], i) - ahead);
        return {{at(of_box.x), at(of_box.y), at(of_box.z)}, along[axis], first, last};
    }

    // For slices from i on; the far plane of one is the near plane of the next.
    [[gnu::always_inline]] void bound(int i, ExtentInLanes<Long>& sides, ExtentsOfSlices<T>& of) const noexcept {
        ExtentInLanes<Long> extent = sides;
        if (Long::fours > 1) extent = extent_of(sides_at(spread<Long>(nearest, i)));
        sides = extent_of(sides_at(spread<Long>(farthest, i)));
        extent.add(sides);
        extent.add(extent_of(rays_in(i)));
        extent.add(extent_of(box_edges_in(i, 0)));
        extent.add(extent_of(box_edges_in(i, 1)));
        extent.add(extent_of(box_edges_in(i, 2)));
        of.store(i, extent);
    }
};

// For each slice, what is left of its four edges.
template <class T, class Fold>
[[nodiscard, gnu::always_inline]] inline Lanes<T> folded(T const (&edges)[16], Fold const& fold) noexcept {
    Lanes<T> const a = four_at(edges), b = four_at(edges + 4), c = four_at(edges + 8), d = four_at(edges + 12);
    Lanes<T> const of_ab = fold(picked<0, 4, 1, 5>(a, b), picked<2, 6, 3, 7>(a, b));
    Lanes<T> const of_cd = fold(picked<0, 4, 1, 5>(c, d), picked<2, 6, 3, 7>(c, d));
    return fold(picked<0, 1, 4, 5>(of_ab, of_cd), picked<2, 3, 6, 7>(of_ab, of_cd));
}
template <class T>
[[nodiscard, gnu::always_inline]] inline Lanes<T> least_of(T const (&edges)[16]) noexcept {
    return folded(edges, [](Lanes<T> const& a, Lanes<T> const& b) { return least(a, b); });
}
template <class T>
[[nodiscard, gnu::always_inline]] inline Lanes<T> largest_of(T const (&edges)[16]) noexcept {
    return folded(edges, [](Lanes<T> const& a, Lanes<T> const& b) { return largest(a, b); });
}

template <class T>
[[gnu::always_inline]] inline void bound_four_slices(ViewOfBox<T> const& seen, T const* plane,
                                                     ExtentsOfSlices<T>& of) noexcept {
    using Long = LongLanes<T>;
    // NOTE: one by one, as they have mostly just been written.
    Lanes<T> const begin = Lanes<T>::of(plane[0], plane[1], plane[2], plane[3]);
    EdgesInLight<T> const edges(seen, begin, moved_up(begin, plane[4]));
    ExtentInLanes<Long> sides = extent_of(edges.sides_at(Long::all(plane[0])));
    // NOTE: no loop: compilers would keep what it needs in registers that they have not.
    edges.bound(0, sides, of);
    if constexpr (Long::fours == 1) edges.bound(1, sides, of);
    if constexpr (Long::fours <= 2) edges.bound(2, sides, of);
    if constexpr (Long::fours == 1) edges.bound(3, sides, of);
}

}  // namespace detail
}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/wide.hpp ========
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

// ======== shadowmath/slices_in_scene.hpp ========
//
// All slices of a view at once, each cut down to the scene: for worlds that end before the view does, and to fit maps
// to a room. What visible_body gives for each slice, bounded along the axes of the light, a hundred times as fast.
//
// Source: ours; slice_edges.hpp says how.

namespace shadowmath {
inline namespace v0 {
namespace detail {

// bound_four_slices with a slice to a lane: light-space boxes, from the world's origin.
template <class T>
struct FourSlices {
    ViewOfBox<T> const& seen;
    T const* plane;
    FourVectors<T>& lo;
    FourVectors<T>& hi;

    [[gnu::always_inline]] void operator()() const noexcept {
        ExtentsOfSlices<T> of;
        bound_four_slices(seen, plane, of);
        // Where there is nothing, these are numbers that no eye and no slack can move.
        Lanes<T> const least_eye = seen.lit.eye - all_four(seen.slack), most_eye = seen.lit.eye + all_four(seen.slack);
        lo.x = least_of(of.lo[0]) + all_of<0>(least_eye);
        lo.y = least_of(of.lo[1]) + all_of<1>(least_eye);
        lo.z = least_of(of.lo[2]) + all_of<2>(least_eye);
        hi.x = largest_of(of.hi[0]) + all_of<0>(most_eye);
        hi.y = largest_of(of.hi[1]) + all_of<1>(most_eye);
        hi.z = largest_of(of.hi[2]) + all_of<2>(most_eye);
    }
};

// Calls visit(first, count, lo, hi) for up to four slices at a time; false, and never, where nothing can be seen.
template <class T, class Visit>
[[gnu::always_inline]] inline bool visit_slices_in_scene(ViewVolume<T> const& view, LightBasis<T> const& basis,
                                                         Splits<T> const& splits, Aabb<T> const& scene,
                                                         Visit const& visit) noexcept {
    ViewOfBox<T> seen;
    seen.pose = &view.pose;
    if (!look(basis, view, seen.lit) || !in_range(splits) ||
        !look_at_box(view, splits.plane[splits.count], scene, seen))
        return false;
    for (int first = 0; first < splits.count; first += 4) {
        int const left = splits.count - first < 4 ? splits.count - first : 4;
        T const* plane = splits.plane + first;
        T padded[5];
        if (left < 4) {
            for (int i = 0; i < 5; ++i) padded[i] = plane[i < left ? i : left];
            plane = padded;
        }
        FourVectors<T> lo, hi;
        run_widely(FourSlices<T>{seen, plane, lo, hi});
        visit(first, left, lo, hi);
    }
    return true;
}

}  // namespace detail

// in_light[i]: the box along the axes of the light (x, y, depth; metres from the world's origin) around what slice i
// sees of the scene; empty where that is nothing. Every point of both is inside, and none of it is farther out than
// what 256 epsilon of the view's reach and of its place, in metres, may add to slice and scene. Writes splits.count
// boxes, all empty where a number is not finite, a side is crossed or something lies beyond 1e12 m.
template <class T>
inline void bound_slices(ViewVolume<T> const& view, LightBasis<T> const& basis, Splits<T> const& splits,
                         Aabb<T> const& scene, Aabb<T>* in_light) noexcept {
    bool const seen =
        detail::visit_slices_in_scene(view, basis, splits, scene, [&](int first, int count, auto& lo, auto& hi) {
            for (int i = 0; i < count; ++i)
                in_light[first + i] = {Vec3<T>(lo.x[i], lo.y[i], lo.z[i]), Vec3<T>(hi.x[i], hi.y[i], hi.z[i])};
        });
    for (int i = 0; i < splits.count && !seen; ++i) in_light[i] = {};
}

// As fit_slice_boxes, for what each slice sees of the scene. Bit i of the result: slice i sees some of it; nowhere()
// where not. All of it is inside, up to `border`.
template <class T>
[[nodiscard]] inline std::uint32_t fit_slice_focus(ViewVolume<T> const& view, LightBasis<T> const& basis,
                                                   Splits<T> const& splits, Aabb<T> const& scene, T border,
                                                   ClipSpace clip, Mat4<T>* clip_from_world) noexcept {
    using Lanes = detail::Lanes<T>;
    bool const free =
        detail::order_of(border) >= detail::order_of(T(0)) && detail::order_of(border) <= detail::order_of(T(0.49));
    detail::MapInLanes<T> const map = detail::map_in_lanes(clip, free ? T(2) - T(4) * border : T(2));
    detail::ViewInLight<T> columns;
    columns.x = Lanes::of(basis.x.x, basis.y.x, basis.depth.x, T(0));
    columns.y = Lanes::of(basis.x.y, basis.y.y, basis.depth.y, T(0));
    columns.z = Lanes::of(basis.x.z, basis.y.z, basis.depth.z, T(0));
    std::uint32_t visible = 0;
    auto const write = [&](int first, int count, auto& lo, auto& hi) {
        auto const one = detail::all_four(T(1)), half = detail::all_four(T(0.5));
        Lanes scale[4] = {detail::all_four(map.extent[0]) / (hi.x - lo.x),
                          detail::all_four(map.extent[1]) / (hi.y - lo.y),
                          detail::all_four(map.extent[2]) / (hi.z - lo.z), one - one};
        Lanes moved[4] = {detail::all_four(map.middle[0]) - (lo.x + hi.x) * half * scale[0],
                          detail::all_four(map.middle[1]) - (lo.y + hi.y) * half * scale[1],
                          detail::all_four(map.middle[2]) - (lo.z + hi.z) * half * scale[2], one};
        detail::transpose(scale);
        detail::transpose(moved);
        for (int i = 0; i < count; ++i) {
            if (!(lo.x[i] <= hi.x[i])) {  // nothing is nothing on every axis
                clip_from_world[first + i] = nowhere<T>();
                continue;
            }
            detail::write_columns(columns, scale[i], moved[i], clip_from_world[first + i]);
            visible |= 1u << (first + i);
        }
    };
    if (free && detail::visit_slices_in_scene(view, basis, splits, scene, write)) return visible;
    for (int i = 0; i < splits.count; ++i) clip_from_world[i] = nowhere<T>();
    return 0;
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/slices_of_views.hpp ========
//
// The slices of thousands of views at once: what fit_slice_boxes gives for each, at a third of the cost. For simulators
// and for tools that try many cameras under one sun.
//
// Views are lanes: what they have in common is done once for all of them, and each operation is one instruction for as
// many as a register holds.

namespace shadowmath {
inline namespace v0 {
namespace detail {

inline constexpr int views_at_once = 32;

// Four slices of each of views_at_once views, where all of these are ordinary perspective views; otherwise nothing is
// written, and `ordinary` is false.
template <class T>
struct SlicesOfViews {
    ViewVolume<T> const* views;
    LightBasis<T> const& basis;
    T lambda;
    MapInLanes<T> const& map;
    Mat4<T>* clip_from_world;
    bool& ordinary;

    static constexpr int n = views_at_once;
    using Row = T[views_at_once];

    [[gnu::always_inline]] static T less(T a, T b) noexcept { return a < b ? a : b; }
    [[gnu::always_inline]] static T more(T a, T b) noexcept { return a > b ? a : b; }

    // Four numbers of four views, from `from` on, each into its own row.
    [[gnu::always_inline]] static void gather(T const* const (&from)[4], Row* rows, int first) noexcept {
        Lanes<T> four[4] = {four_at(from[0]), four_at(from[1]), four_at(from[2]), four_at(from[3])};
        transpose(four);
        std::memcpy(rows[0] + first, &four[0], sizeof four[0]);
        std::memcpy(rows[1] + first, &four[1], sizeof four[1]);
        std::memcpy(rows[2] + first, &four[2], sizeof four[2]);
        std::memcpy(rows[3] + first, &four[3], sizeof four[3]);
    }

    // Rows: position, right, up, forward, sides; near and far; the roots of far / near, taken here, as processors move
    // numbers meanwhile. False where not all views are perspective.
    [[gnu::always_inline]] bool gather(Row (&in)[20]) const noexcept {
        bool perspective = true;
        for (int first = 0; first < n; first += 4) {
            ViewVolume<T> const &a = views[first], &b = views[first + 1], &c = views[first + 2], &d = views[first + 3];
            T const* pose[4] = {&a.pose.position.x, &b.pose.position.x, &c.pose.position.x, &d.pose.position.x};
            gather({pose[0], pose[1], pose[2], pose[3]}, in, first);
            gather({pose[0] + 4, pose[1] + 4, pose[2] + 4, pose[3] + 4}, in + 4, first);
            gather({pose[0] + 8, pose[1] + 8, pose[2] + 8, pose[3] + 8}, in + 8, first);
            gather({&a.left, &b.left, &c.left, &d.left}, in + 12, first);
            Lanes<T> const z_near = Lanes<T>::of(a.z_near, b.z_near, c.z_near, d.z_near);
            Lanes<T> const z_far = Lanes<T>::of(a.z_far, b.z_far, c.z_far, d.z_far);
            auto const metres = [](Lanes<T> const& z) { return between(z, least_metres<T>, farthest_metres<T>); };
            Lanes<T> const half = root(metres(z_far) / metres(z_near)), quarter = root(half);
            std::memcpy(in[16] + first, &z_near, sizeof z_near);
            std::memcpy(in[17] + first, &z_far, sizeof z_far);
            std::memcpy(in[18] + first, &half, sizeof half);
            std::memcpy(in[19] + first, &quarter, sizeof quarter);
            perspective = perspective & (a.kind == ViewKind::perspective) & (b.kind == ViewKind::perspective) &
                          (c.kind == ViewKind::perspective) & (d.kind == ViewKind::perspective);
        }
        return perspective;
    }

    // Of each view, sums of coordinates regardless of sign, by which roundings are measured.
    struct Lengths {
        Row eye, sides;
    };

    // False where a number is beyond reach, or a little sooner: where sums of them are.
    [[gnu::always_inline]] static bool measure(Row const (&in)[20], Lengths& of) noexcept {
        decltype(beyond_reach(T(0))) any = 0;
        for (int i = 0; i < n; ++i) {
            of.eye[i] = std::abs(in[0][i]) + std::abs(in[1][i]) + std::abs(in[2][i]);
            of.sides[i] = std::abs(in[12][i]) + std::abs(in[13][i]) + std::abs(in[14][i]) + std::abs(in[15][i]);
        }
        for (int i = 0; i < n; ++i) {
            T const right = std::abs(in[3][i]) + std::abs(in[4][i]) + std::abs(in[5][i]);
            T const up = std::abs(in[6][i]) + std::abs(in[7][i]) + std::abs(in[8][i]);
            T const ahead = std::abs(in[9][i]) + std::abs(in[10][i]) + std::abs(in[11][i]);
            any |= beyond_reach(of.eye[i] + of.sides[i] + (right + up + ahead)) |
                   beyond(in[16][i], least_metres<T>, farthest_metres<T>) |
                   beyond(in[17][i], least_metres<T>, farthest_metres<T>);
        }
        return any >> (8 * sizeof any - 1) == 0;
    }

    // False where the planes of a view are not in order, or its sides.
    [[gnu::always_inline]] bool split(Row const (&in)[20], Row (&plane)[5]) const noexcept {
        Row const &half = in[18], &quarter = in[19];
        for (int i = 0; i < n; ++i) {
            T const near_end = in[16][i], far_end = in[17][i], length = far_end - near_end, rest = T(1) - lambda;
            plane[0][i] = near_end;
            plane[1][i] = lambda * (near_end * quarter[i]) + rest * (near_end + length * T(0.25));
            plane[2][i] = lambda * (near_end * half[i]) + rest * (near_end + length * T(0.5));
            plane[3][i] = lambda * (near_end * (half[i] * quarter[i])) + rest * (near_end + length * T(0.75));
            plane[4][i] = far_end;
        }
        std::uint32_t good[n], all_good = ~0u;
        for (int i = 0; i < n; ++i)
            good[i] = ((plane[0][i] < plane[1][i]) & (plane[1][i] < plane[2][i]) & (plane[2][i] < plane[3][i]) &
                       (plane[3][i] < plane[4][i]) & (in[12][i] < in[13][i]) & (in[14][i] < in[15][i]) &
                       (in[16][i] > in[17][i] * T(0x1p-64)))
                          ? ~0u
                          : 0u;
        for (int i = 0; i < n; ++i) all_good &= good[i];
        return all_good != 0;
    }

    // What the maps of all slices do to one axis of the light.
    struct OnAxis {
        Row scale[4], offset[4];
    };

    // `axis`, and so all that it is multiplied with, is halved, which is exact: the middle of two is then their sum.
    [[gnu::always_inline]] static void fit(Row const (&in)[20], Lengths const& of, Row const (&plane)[5],
                                           Vec3<T> const& axis, T extent, T middle, OnAxis& maps) noexcept {
        constexpr T half_unit = T(4) * std::numeric_limits<T>::epsilon();
        Vec3<T> const a = axis * T(0.5);
        Row eye_lo, eye_hi, slope_lo, slope_hi;
        for (int i = 0; i < n; ++i) {
            T const eye = a.x * in[0][i] + a.y * in[1][i] + a.z * in[2][i];
            T const right = a.x * in[3][i] + a.y * in[4][i] + a.z * in[5][i];
            T const up = a.x * in[6][i] + a.y * in[7][i] + a.z * in[8][i];
            T const ahead = a.x * in[9][i] + a.y * in[10][i] + a.z * in[11][i];
            T const b = right * in[12][i], c = right * in[13][i], d = up * in[14][i], e = up * in[15][i];
            T const rounding = half_unit * of.eye[i];
            eye_lo[i] = eye - rounding, slope_lo[i] = ahead + (less(b, c) + less(d, e));
            eye_hi[i] = eye + rounding, slope_hi[i] = ahead + (more(b, c) + more(d, e));
        }
        for (int i = 0; i < n; ++i) {
            T const growth = half_unit * (T(1) + of.sides[i]);
            T from_lo = plane[0][i] * slope_lo[i], from_hi = plane[0][i] * slope_hi[i];
            auto const add = [&](int slice) {
                T const to = plane[slice + 1][i], to_lo = to * slope_lo[i], to_hi = to * slope_hi[i];
                T const lo = eye_lo[i] + (less(from_lo, to_lo) - to * growth);
                T const hi = eye_hi[i] + (more(from_hi, to_hi) + to * growth);
                T const scale = extent * T(0.5) / (hi - lo);
                maps.scale[slice][i] = scale;
                maps.offset[slice][i] = middle - (lo + hi) * scale;
                from_lo = to_lo, from_hi = to_hi;
            };
            add(0), add(1), add(2), add(3);
        }
    }

    // As write_columns, in as few stores as the machine has. Of a few maps they would gain nothing: most of them reach
    // across a cache line.
    [[gnu::always_inline]] static void write_whole(ViewInLight<T> const& seen, Lanes<T> const& scale,
                                                   Lanes<T> const& offset, Mat4<T>& clip_from_world) noexcept {
        using Long = LongLanes<T>;
        if constexpr (Long::fours == 1) {
            write_columns(seen, scale, offset, clip_from_world);
        } else {
            Lanes<T> const column[4] = {seen.x, seen.y, seen.z, offset};
            Long const scales = repeated<Long>(scale);
            for (int i = 0; i < 4; i += Long::fours) {
                Long const scaled = joined<Long>(column + i) * scales;
                store_long(&clip_from_world[0].x + 4 * i, i + Long::fours < 4 ? scaled : with_last(scaled, offset));
            }
        }
    }

    [[gnu::always_inline]] void operator()() const noexcept {
        Row in[20], plane[5];
        Lengths of;
        ordinary = gather(in) && measure(in, of) && split(in, plane);
        if (!ordinary) return;

        OnAxis x, y, depth;
        fit(in, of, plane, basis.x, map.extent[0], map.middle[0], x);
        fit(in, of, plane, basis.y, map.extent[1], map.middle[1], y);
        fit(in, of, plane, basis.depth, map.extent[2], map.middle[2], depth);

        ViewInLight<T> columns;
        columns.x = Lanes<T>::of(basis.x.x, basis.y.x, basis.depth.x, T(0));
        columns.y = Lanes<T>::of(basis.x.y, basis.y.y, basis.depth.y, T(0));
        columns.z = Lanes<T>::of(basis.x.z, basis.y.z, basis.depth.z, T(0));
        Mat4<T>* to = clip_from_world;
        for (int first = 0; first < n; first += 4, to += 16) {
            for (int slice = 0; slice < 4; ++slice) {
                auto const four = [first, slice](Row const(&of_slices)[4]) {
                    return four_at(of_slices[slice] + first);
                };
                Lanes<T> scale[4] = {four(x.scale), four(y.scale), four(depth.scale), all_four(T(0))};
                Lanes<T> offset[4] = {four(x.offset), four(y.offset), four(depth.offset), all_four(T(1))};
                transpose(scale);
                transpose(offset);
                write_whole(columns, scale[0], offset[0], to[slice]);
                write_whole(columns, scale[1], offset[1], to[slice + 4]);
                write_whole(columns, scale[2], offset[2], to[slice + 8]);
                write_whole(columns, scale[3], offset[3], to[slice + 12]);
            }
        }
    }
};

}  // namespace detail

// clip_from_world[splits * i + k] is the map of slice k of view i: what fit_slice_boxes gives for the practical splits
// of the view from z_near to z_far, to a few roundings; maps of slices that there are not, or of views that none can be
// made for, are nowhere(). Says for how many views all maps are there. Four splits are the fast case; views that are
// orthographic or have anything odd are made one by one, and so are those beside them.
template <class T>
[[nodiscard]] inline int fit_slice_boxes_of(ViewVolume<T> const* views, int view_count, LightBasis<T> const& basis,
                                            int splits, T lambda, T border, ClipSpace clip,
                                            Mat4<T>* clip_from_world) noexcept {
    SHADOWMATH_ASSERT(view_count <= 0 || (views != nullptr && clip_from_world != nullptr),
                      "fit_slice_boxes_of needs views, and room for their maps");
    SHADOWMATH_ASSERT(splits >= 1 && splits <= max_splits, "fit_slice_boxes_of makes one to max_splits maps a view");
    auto const weight = detail::order_of(lambda), free = detail::order_of(border);
    detail::BeyondReach<T> beyond;
    for (Vec3<T> const* axis : {&basis.x, &basis.y, &basis.depth})
        beyond.look_at_parts(detail::Lanes<T>::of(axis->x, axis->y, axis->z, T(0)));
    bool const fast = splits == 4 && !beyond.any() && weight > 0 && weight <= detail::order_of(T(1)) &&
                      free >= detail::order_of(T(0)) && free <= detail::order_of(T(0.49));
    detail::MapInLanes<T> const map = detail::map_in_lanes(clip, fast ? T(2) - T(4) * border : T(2));
    int fitted = 0;
    for (int first = 0; first < view_count; first += detail::views_at_once) {
        int const count = view_count - first < detail::views_at_once ? view_count - first : detail::views_at_once;
        Mat4<T>* const maps = clip_from_world + static_cast<std::ptrdiff_t>(first) * splits;
        bool ordinary = false;
        if (fast && count == detail::views_at_once)
            detail::run_widely(detail::SlicesOfViews<T>{views + first, basis, lambda, map, maps, ordinary});
        if (ordinary) {
            fitted += count;
            continue;
        }
        for (int i = 0; i < count; ++i) {
            ViewVolume<T> const& view = views[first + i];
            Splits<T> const planes = practical_splits(view.z_near, view.z_far, splits, lambda);
            bool const good = fit_slice_boxes(view, basis, planes, border, clip, maps + i * splits);
            for (int k = planes.count; k < splits; ++k) maps[i * splits + k] = nowhere<T>();
            if (good && planes.count == splits) ++fitted;
        }
    }
    return fitted;
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/light_box.hpp ========
//
// What every fit for a directional light gives: a box in light space, and the one matrix that makes of it.
//
// fit_sphere and fit_box choose its sides, depth_range its depth, texel_grid its position. The three do not know of
// each other; the box is all that passes between them.

namespace shadowmath {
inline namespace v0 {

template <class T>
struct LightBox {
    LightBasis<T> basis;
    Vec2<T> lo{T(-1)};  // sides in light space, metres from the world origin
    Vec2<T> hi{T(1)};
    T depth_lo = T(0);  // along the light, metres from the world origin: 0 of the map
    T depth_hi = T(1);  // 1 of the map
};

// Metres that one texel covers across the light, in x and y; of a map without texels, as if it had one.
template <class T>
[[nodiscard]] inline Vec2<T> texel_metres(LightBox<T> const& box, int map_size) noexcept {
    return (box.hi - box.lo) / T(map_size > 1 ? map_size : 1);
}

// The box fills the map: its corners land on those of the clip volume. Affine, w = 1 everywhere. A box without
// extent, or so small that its inverse overflows, maps everything outside; fits see to it that theirs are not.
template <class T>
[[nodiscard]] inline Mat4<T> clip_from_world(LightBox<T> const& box, ClipSpace clip) noexcept {
    bool const has_extent = box.lo.x < box.hi.x && box.lo.y < box.hi.y && box.depth_lo < box.depth_hi;
    if (!has_extent) return nowhere<T>();
    // Centre and half extent instead of a product of matrices: one rounding each.
    auto const axis = [](Vec3<T> const& direction, T lo, T hi) {
        T const scale = T(2) / (hi - lo);
        return Vec4<T>(direction * scale, -(hi + lo) / (hi - lo));
    };
    T const depth_scale = T(1) / (box.depth_hi - box.depth_lo);
    Mat4<T> const canonical =
        from_rows(axis(box.basis.x, box.lo.x, box.hi.x), axis(box.basis.y, box.lo.y, box.hi.y),
                  Vec4<T>(box.basis.depth * depth_scale, -box.depth_lo * depth_scale), Vec4<T>(T(0), T(0), T(0), T(1)));
    if (!all_finite(canonical)) return nowhere<T>();
    // Where depth runs from -1 to 1, or the other way, the largest numbers of a float are not enough.
    Mat4<T> const map = clip_from_canonical<T>(clip) * canonical;
    return all_finite(map) ? map : nowhere<T>();
}

// The same map for points given relative to `origin` (a camera-relative renderer): M * translate(origin). Compute it in
// double and round the result to float: near the origin nothing is lost, however far it is from the world's.
template <class T>
[[nodiscard]] inline Mat4<T> rebased(Mat4<T> const& clip_from_world, Vec3<T> const& origin) noexcept {
    Mat4<T> moved = clip_from_world;
    moved[3] = clip_from_world * Vec4<T>(origin, T(1));
    return moved;
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/fit_box.hpp ========
//
// The smallest light-space box around a body: up to twice the texels of the sphere's square, at the price of a size and
// a place that change with every turn of the camera, so that shadow edges crawl. For maps that are drawn once, for
// cameras that stand still, and under a temporal filter; else fit_sphere and texel_grid.
//
// Source: any "fit to frustum" since GPU Gems 3 chapter 10. Departure: the filter's margin is part of the fit.

namespace shadowmath {
inline namespace v0 {

namespace detail {

// The interval, or where it is shorter, one of this length around its middle.
template <class T>
inline void widen(T& lo, T& hi, T least) noexcept {
    if (hi - lo >= least) return;
    T const middle = lo + (hi - lo) * T(0.5);
    lo = middle - least * T(0.5);
    hi = middle + least * T(0.5);
}

}  // namespace detail

// The body, given by its bounds in light space, lies `margin_texels` texels inside the four sides; depth runs from its
// first point to its last. A flat body is widened to a texel of its largest extent, and to what the scalar type can
// tell apart. Bounds that are empty, not finite or beyond 1e18 m, and axes that are not unit, give the box
// [-1, 1]^2 x [0, 1]; a map without room for the margin (faults_of_margin) is treated as one with one usable texel.
template <class T>
[[nodiscard]] inline LightBox<T> box_around(LightBasis<T> const& basis, Aabb<T> const& body_in_light, int map_size,
                                            T margin_texels) noexcept {
    LightBox<T> box;
    Aabb<T> const& body = body_in_light;
    if (!detail::has_unit_axes(basis) || !all_finite(body) || is_empty(body) ||
        !(detail::largest_of(body) <= T(2) * detail::farthest_metres<T>))
        return box;
    T const largest = detail::largest_of(body.hi - body.lo);
    T const rounding = T(4) * std::numeric_limits<T>::epsilon() * detail::largest_of(body);
    T const texels = map_size > 1 ? T(map_size) : T(1);
    // A micrometre: the one point at the origin has no scale of its own.
    T const least = std::fmax(std::fmax(largest / texels, rounding), T(1e-6));
    box.basis = basis;
    for (int axis = 0; axis < 2; ++axis) {
        T lo = body.lo[axis], hi = body.hi[axis];
        detail::widen(lo, hi, least);
        T const usable = usable_texels(map_size, margin_texels);
        T const margin = T(0.5) * (texels - usable) / usable * (hi - lo);
        // The rounding of the points themselves, which margin 0 would leave outside.
        box.lo[axis] = lo - margin - rounding;
        box.hi[axis] = hi + margin + rounding;
    }
    box.depth_lo = body.lo.z - rounding;
    box.depth_hi = body.hi.z + rounding;
    detail::widen(box.depth_lo, box.depth_hi, std::fmax(rounding, T(1e-6)));
    return box;
}

// box_around the eight corners. Corners that are not finite or beyond 1e18 m give the box [-1, 1]^2 x [0, 1].
template <class T>
[[nodiscard]] inline LightBox<T> fit_box(LightBasis<T> const& basis, std::array<Vec3<T>, 8> const& corners_in_world,
                                         int map_size, T margin_texels) noexcept {
    if (!detail::has_unit_axes(basis)) return {};
    Aabb<T> body;
    for (Vec3<T> const& corner : corners_in_world) {
        if (!all_finite(corner) || !(detail::largest_of(corner) <= detail::farthest_metres<T>)) return {};
        body = merge(body, in_light(basis, corner));
    }
    return box_around(basis, body, map_size, margin_texels);
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/depth_range.hpp ========
//
// How deep a map must be: from the first caster that can shadow anything inside its sides, to the last receiver.
//
//        light                 Casters count where they are in the shaft between the sides, from the light down to the
//     |    |    |              receivers; not where their box merely overlaps it. A mountain's box that leans into the
//  c c|cc  |    |   <- lo      shaft at the top counts from the height at which it is inside.
//   c |    |    |
//     |  slice  |              pancake: lo is the first receiver instead. The renderer must turn depth clamp on
//     |_________|   <- hi      (GL_DEPTH_CLAMP, depthClampEnable): casters above lo are then drawn flat at depth 0.
//
// Source: cutting the scene's box by the map's four sides is that of Microsoft's "Common techniques to improve shadow
// depth maps". Departures: edges for triangles, four at a time, and boxes without an end are cut before they are
// computed with.

namespace shadowmath {
inline namespace v0 {

template <class T>
struct DepthRange {
    T lo = T(0);  // metres along the light, from the world origin
    T hi = T(1);
    bool visible = false;  // false: nothing is there, or nothing that could shadow it
};

namespace detail {

// The six sides as planes whose positive half is inside.
template <class T>
[[nodiscard]] inline std::array<Vec4<T>, 6> inner_planes(ViewVolume<T> const& view) noexcept {
    Pose<T> const& pose = view.pose;
    auto const coordinate = [&pose](Vec3<T> const& axis) { return Vec4<T>(axis, -glm::dot(axis, pose.position)); };
    Vec4<T> const x = coordinate(pose.right), y = coordinate(pose.up), depth = coordinate(pose.forward);
    Vec4<T> const one(T(0), T(0), T(0), T(1));
    Vec4<T> const& spread = view.kind == ViewKind::perspective ? depth : one;
    return {x - view.left * spread, view.right * spread - x,   y - view.bottom * spread,
            view.top * spread - y,  depth - view.z_near * one, view.z_far * one - depth};
}

// Least and greatest depth of edges, four at a time.
template <class T>
struct DepthsOfEdges {
    Lanes<T> lo = Lanes<T>::all(std::numeric_limits<T>::max()), hi = Lanes<T>::all(-std::numeric_limits<T>::max());

    // From depth a to depth b, where first <= last.
    [[gnu::always_inline]] void add(Lanes<T> const& a, Lanes<T> const& b, Lanes<T> const& first,
                                    Lanes<T> const& last) noexcept {
        lo = least(lo, where_at_most(first, last, least(a, b), lo));
        hi = largest(hi, where_at_most(first, last, largest(a, b), hi));
    }
};

// The four sides of a volume, moved outward by what rounding may have moved them inward.
template <class T>
struct WidenedSides {
    std::array<Vec4<T>, 4> planes;  // positive inside
    T wider[4];                     // metres, plane by plane

    [[gnu::always_inline]] WidenedSides(ViewVolume<T> const& volume, T const& size, T const& slack) noexcept {
        std::array<Vec4<T>, 6> const given = inner_planes(volume);
        for (std::size_t i = 0; i < 4; ++i) {
            Vec4<T>& plane = planes[i];
            plane = given[i];
            T const growth = std::abs(plane.x) + std::abs(plane.y) + std::abs(plane.z);
            wider[i] = slack * (growth * size + std::abs(plane.w));
            plane.w += wider[i];
        }
    }
};

// The twelve edges of the box between the sides, four to an axis.
template <class T>
[[gnu::always_inline]] inline void add_box_edges(DepthsOfEdges<T>& depths, Aabb<T> const& body,
                                                 WidenedSides<T> const& sides, Pose<T> const& pose) noexcept {
    using Lanes = Lanes<T>;
    auto const all = [](T value) { return Lanes::all(value); };
    constexpr T none = std::numeric_limits<T>::max();
    for (int axis = 0; axis < 3; ++axis) {
        int const next = (axis + 1) % 3, after = (axis + 2) % 3;
        // Where the four are on the other two axes.
        Lanes const u = Lanes::of(body.lo[next], body.hi[next], body.lo[next], body.hi[next]);
        Lanes const v = Lanes::of(body.lo[after], body.lo[after], body.hi[after], body.hi[after]);
        Lanes first = all(body.lo[axis]), last = all(body.hi[axis]);
        for (Vec4<T> const& plane : sides.planes) {
            T const inward = not_zero(plane[axis]);
            Lanes const root = (u * all(plane[next]) + v * all(plane[after]) + all(plane.w)) * all(T(-1) / inward);
            // It enters where it goes inward, and leaves where not.
            if (inward > T(0))
                first = largest(first, least(root, all(none)));
            else
                last = least(last, largest(root, all(-none)));
        }
        Vec3<T> const &eye = pose.position, &ahead = pose.forward;
        Lanes const at = (u - all(eye[next])) * all(ahead[next]) + (v - all(eye[after])) * all(ahead[after]);
        auto const depth = [&](Lanes const& along) {
            // NOTE: of edges that are none, any depth does, as long as it is a number.
            Lanes const on_edge = least(largest(along, all(body.lo[axis])), all(body.hi[axis]));
            return (on_edge - all(eye[axis])) * all(ahead[axis]) + at;
        };
        depths.add(depth(first), depth(last), first, last);
    }
}

// The corner edges of the four sides inside the box: (left, bottom), (right, bottom), (right, top), (left, top).
template <class T>
[[gnu::always_inline]] inline void add_corner_edges(DepthsOfEdges<T>& depths, Aabb<T> const& body,
                                                    WidenedSides<T> const& sides, ViewVolume<T> const& volume,
                                                    T const& rounding) noexcept {
    using Lanes = Lanes<T>;
    auto const all = [](T value) { return Lanes::all(value); };
    constexpr T none = std::numeric_limits<T>::max();
    Pose<T> const& pose = volume.pose;
    bool const flat = volume.kind == ViewKind::orthographic;
    Lanes const x = Lanes::of(volume.left, volume.right, volume.right, volume.left);
    Lanes const y = Lanes::of(volume.bottom, volume.bottom, volume.top, volume.top);
    Lanes const wider_x = Lanes::of(-sides.wider[0], sides.wider[1], sides.wider[1], -sides.wider[0]);
    Lanes const wider_y = Lanes::of(-sides.wider[2], -sides.wider[2], sides.wider[3], sides.wider[3]);
    // Those of a perspective begin at the eye.
    Lanes first = all(flat ? -none : T(0)), last = all(none);
    for (int axis = 0; axis < 3; ++axis) {
        Lanes const across = all(pose.right[axis]), upward = all(pose.up[axis]), sideways = x * across + y * upward;
        Lanes from = all(pose.position[axis]) + (wider_x * across + wider_y * upward), step = all(pose.forward[axis]);
        if (flat)
            from = from + sideways;
        else
            step = step + sideways;
        Lanes const inverse = all(T(1)) / not_zero(step);
        Lanes const a = (all(body.lo[axis] - rounding) - from) * inverse;
        Lanes const b = (all(body.hi[axis] + rounding) - from) * inverse;
        first = largest(first, least(a, b));
        last = least(last, largest(a, b));
    }
    depths.add(first, last, first, last);
}

}  // namespace detail

// Depths along `volume` at which the box is inside it: never less than the truth, and more by rounding only. Any finite
// box will do, however large; the volume must be finite. Not visible where they do not meet.
//
// The least and the greatest depth that the box has between the four sides, however far they go, are where its edges
// enter and leave, where the corner edges of the sides enter and leave the box, or at the eye. What lies between them
// is one piece: near and far end only cut it off.
template <class T>
[[nodiscard]] inline DepthRange<T> depths_inside(Aabb<T> const& box, ViewVolume<T> const& volume) noexcept {
    if (!all_finite(box) || is_empty(box)) return {};
    constexpr T slack = T(8) * std::numeric_limits<T>::epsilon();
    Vec3<T> const& eye = volume.pose.position;
    Aabb<T> const around = merge(bounds_of(corners(volume)), eye);
    // Whatever does not reach the volume goes first: from here on no number is larger than the volume's own.
    T const reach = slack * detail::largest_of(around);
    Aabb<T> const body = intersect(box, Aabb<T>{around.lo - reach, around.hi + reach});
    if (is_empty(body)) return {};
    T const size = detail::largest_of(merge(body, eye)), rounding = slack * size;
    detail::WidenedSides<T> const sides(volume, size, slack);
    detail::DepthsOfEdges<T> depths;
    detail::add_box_edges(depths, body, sides, volume.pose);
    detail::add_corner_edges(depths, body, sides, volume, rounding);
    T lo = depths.lo[0], hi = depths.hi[0];
    for (int i = 1; i < 4; ++i) {
        lo = depths.lo[i] < lo ? depths.lo[i] : lo;
        hi = depths.hi[i] > hi ? depths.hi[i] : hi;
    }
    // The eye, where the sides of a perspective meet: a flat box through it holds that and none of their edges.
    if (volume.kind == ViewKind::perspective && contains(Aabb<T>{body.lo - rounding, body.hi + rounding}, eye)) {
        lo = std::fmin(lo, T(0));
        hi = std::fmax(hi, T(0));
    }
    if (!(lo <= hi)) return {};
    DepthRange<T> const range{std::fmax(lo - rounding, volume.z_near), std::fmin(hi + rounding, volume.z_far), true};
    return range.lo <= range.hi ? range : DepthRange<T>{};
}

// Between lo and hi lies every receiver inside the sides and the slice, and, unless `pancake`, every caster above it.
//
//   sides            of the map; its depths are not read
//   receivers_slice  the first and last depth of the slice, as fit_box finds them
//   casters, receivers   world boxes. Either empty, or nowhere inside: not visible, and no fault.
//
// A caster box that goes on and on toward the light (+-FLT_MAX) is cut 65536 times the size of sides and slice above
// the slice: a depth buffer tells nothing apart in more. Give true bounds, or pancake.
template <class T>
[[nodiscard]] inline DepthRange<T> depth_range(LightBox<T> const& sides, DepthRange<T> const& receivers_slice,
                                               Aabb<T> const& casters, Aabb<T> const& receivers,
                                               bool pancake) noexcept {
    DepthRange<T> const& slice = receivers_slice;
    bool const finite =
        all_finite(sides.lo) && all_finite(sides.hi) && all_finite(&slice.lo, 1) && all_finite(&slice.hi, 1);
    if (!finite || !detail::has_unit_axes(sides.basis) || !slice.visible || !(slice.lo <= slice.hi)) return {};
    T largest = std::fmax(std::abs(slice.lo), std::abs(slice.hi));
    for (T const side : {sides.lo.x, sides.lo.y, sides.hi.x, sides.hi.y}) largest = std::fmax(largest, std::abs(side));
    if (!(largest <= detail::farthest_metres<T>)) return {};
    // Light space is an orthographic view from the world origin.
    ViewVolume<T> shaft = orthographic_view({Vec3<T>(T(0)), sides.basis.x, sides.basis.y, sides.basis.depth},
                                            sides.lo.x, sides.hi.x, sides.lo.y, sides.hi.y, slice.lo, slice.hi);
    DepthRange<T> const received = depths_inside(receivers, shaft);
    if (!received.visible) return {};
    T const size = (sides.hi.x - sides.lo.x) + (sides.hi.y - sides.lo.y) + (slice.hi - slice.lo);
    shaft.z_near = slice.lo - T(65536) * size;
    shaft.z_far = received.hi;
    DepthRange<T> const cast = depths_inside(casters, shaft);
    if (!cast.visible) return {};
    DepthRange<T> range{pancake ? received.lo : std::fmin(cast.lo, received.lo), received.hi, true};
    detail::widen(range.lo, range.hi, std::fmax(T(8) * std::numeric_limits<T>::epsilon() * largest, T(1e-6)));
    return range;
}

// Both ends moved outward to whole multiples of `step_metres`: the depth that a map stores for a point is then the same
// from frame to frame until an end is crossed. A power of two makes the multiples exact. A step that is not positive
// changes nothing.
template <class T>
[[nodiscard]] inline DepthRange<T> in_steps(DepthRange<T> range, T const& step_metres) noexcept {
    if (!all_finite(&step_metres, 1) || !(step_metres > T(0)) || !range.visible) return range;
    T const lo = std::floor(range.lo / step_metres), hi = std::ceil(range.hi / step_metres);
    constexpr T whole_numbers = T(1) / std::numeric_limits<T>::epsilon();
    if (!(std::abs(lo) < whole_numbers && std::abs(hi) < whole_numbers)) return range;
    return {lo * step_metres, hi * step_metres, true};
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/bounds_of_body.hpp ========
//
// Bounds in NDC of one convex body, clipped before the divide: the inside of projected_bounds.hpp, which says what it
// promises.
//
// Source: ours. Edges cut at w_min, without a polygon.

namespace shadowmath {
inline namespace v0 {
namespace detail {

// A quotient may overflow where w is far below the rest; the largest number still bounds it.
template <class T>
[[nodiscard]] inline Vec3<T> within_numbers(Vec3<T> const& ndc) noexcept {
    Vec3<T> const largest(std::numeric_limits<T>::max());
    return glm::clamp(ndc, -largest, largest);
}

template <class T>
[[nodiscard]] inline Aabb<T> bounds_of_body(Mat4<T> const& clip_from_world, std::array<Vec3<T>, 8> const& corners,
                                            T w_min) noexcept {
    if (!all_finite(clip_from_world) || !all_finite(&w_min, 1)) return {};
    T entry = T(0);
    for (int column = 0; column < 4; ++column)
        for (int r = 0; r < 4; ++r) entry = glm::max(entry, std::abs(clip_from_world[column][r]));
    if (!(entry > T(0))) return {};
    // Homogeneous coordinates may be scaled by anything positive. Matrices and points too large to be multiplied are
    // brought down, each point together with its own share of w_min; ordinary ones keep every bit.
    constexpr T ordinary = T(1e15);
    Mat4<T> const clip = entry > ordinary ? clip_from_world * (T(1) / entry) : clip_from_world;
    T const floor = entry > ordinary ? w_min / entry : w_min;
    std::array<Vec4<T>, 8> point;
    std::array<T, 8> share;
    T largest_w = T(0);
    for (unsigned i = 0; i < 8; ++i) {
        if (!all_finite(corners[i])) return {};
        T const reach = glm::max(std::abs(corners[i].x), glm::max(std::abs(corners[i].y), std::abs(corners[i].z)));
        // No farther down than that: 1 / FLT_MAX is no normal number.
        share[i] = reach > ordinary ? ordinary / reach : T(1);
        point[i] = clip * Vec4<T>(corners[i] * share[i], share[i]);
        largest_w = glm::max(largest_w, point[i].w);
    }
    constexpr T tiny = T(8) * std::numeric_limits<T>::min();
    T const least = glm::max(floor > T(0) ? floor : std::numeric_limits<T>::epsilon() * largest_w, tiny);
    Aabb<T> bounds;
    auto const add = [&bounds](Vec4<T> const& p, T w) {
        bounds = merge(bounds, within_numbers(Vec3<T>(p.x / w, p.y / w, p.z / w)));
    };
    for (unsigned i = 0; i < 8; ++i) {
        T const above = point[i].w - least * share[i];
        if (above >= T(0)) add(point[i], glm::max(point[i].w, tiny));
        for (unsigned bit = 1; bit < 8; bit <<= 1) {
            unsigned const j = i | bit;
            T const other = point[j].w - least * share[j];
            if (j == i || (above >= T(0)) == (other >= T(0))) continue;
            T const t = above / (above - other);
            add(point[i] * (T(1) - t) + point[j] * t, glm::max(least * (share[i] * (T(1) - t) + share[j] * t), tiny));
        }
    }
    return bounds;
}

}  // namespace detail
}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/bounds_of_boxes.hpp ========
//
// Bounds in NDC of many boxes together, sixteen at a time: the inside of projected_bounds.hpp.
//
// Source: ours. A corner is X + Y + Z, as in culling.hpp; whether a box reaches beyond what is known needs no quotient.

namespace shadowmath {
inline namespace v0 {
namespace detail {

inline constexpr int bodies_at_once = 16;

// Least and largest NDC so far, one of each for every place in a block of boxes.
template <class T>
struct BoundsInBlocks {
    static constexpr int n = bodies_at_once;
    static constexpr T none = std::numeric_limits<T>::max();
    T lo[3][bodies_at_once];
    T hi[3][bodies_at_once];

    [[gnu::always_inline]] BoundsInBlocks() noexcept {
        for (int r = 0; r < 3; ++r)
            for (int i = 0; i < n; ++i) lo[r][i] = none, hi[r][i] = -none;
    }
    [[gnu::always_inline]] static T less(T a, T b) noexcept { return a < b ? a : b; }
    [[gnu::always_inline]] static T more(T a, T b) noexcept { return a > b ? a : b; }
    // `away`: 0, or `none` for what does not count, which is then farther in than anything.
    [[gnu::always_inline]] void add(int r, int i, T away, T least, T most) noexcept {
        lo[r][i] = less(least + away, lo[r][i]);
        hi[r][i] = more(most - away, hi[r][i]);
    }
    [[nodiscard]] Aabb<T> merged() const noexcept {
        Aabb<T> all;
        for (int r = 0; r < 3; ++r) {
            T least = none, most = -none;
            for (int i = 0; i < n; ++i) least = less(least, lo[r][i]), most = more(most, hi[r][i]);
            all.lo[r] = least, all.hi[r] = most;
        }
        return {within_numbers(all.lo), within_numbers(all.hi)};
    }
};

// Products of a row with both ends of each axis of a box. A corner is X + Y + Z, so that eight corners are six
// products, and the extent of all of them is three sums.
template <class T>
struct EndProducts {
    T x0, x1, y0, y1, z0, z1;

    [[gnu::always_inline]] EndProducts(Vec4<T> const& row, BoxArrays<T> const& at, int i) noexcept
        : x0(row.x * at.lo_x[i]), x1(row.x * at.hi_x[i]), y0(row.y * at.lo_y[i]), y1(row.y * at.hi_y[i]),
          z0(row.z * at.lo_z[i] + row.w), z1(row.z * at.hi_z[i] + row.w) {}
    [[gnu::always_inline]] T least() const noexcept {
        return (x0 < x1 ? x0 : x1) + (y0 < y1 ? y0 : y1) + (z0 < z1 ? z0 : z1);
    }
    [[gnu::always_inline]] T most() const noexcept {
        return (x0 > x1 ? x0 : x1) + (y0 > y1 ? y0 : y1) + (z0 > z1 ? z0 : z1);
    }
};

// Points of one box after another, four at a time: least and largest NDC of those that count, which have nothing
// lacking.
template <class T>
struct BoundsInLanes {
    using Four = Lanes<T>;
    static constexpr T none = std::numeric_limits<T>::max();
    Four lo[3] = {all_four(none), all_four(none), all_four(none)};
    Four hi[3] = {all_four(-none), all_four(-none), all_four(-none)};

    [[gnu::always_inline]] void add(Four const& x, Four const& y, Four const& z, Four const& per_w,
                                    Four const& lacking) noexcept {
        add(0, x * per_w, lacking), add(1, y * per_w, lacking), add(2, z * per_w, lacking);
    }
    [[gnu::always_inline]] void add(int r, Four const& ndc, Four const& lacking) noexcept {
        Four const zero = all_four(T(0));
        lo[r] = least(where_at_most(lacking, zero, ndc, all_four(none)), lo[r]);
        hi[r] = largest(where_at_most(lacking, zero, ndc, all_four(-none)), hi[r]);
    }
    [[nodiscard]] Aabb<T> merged() const noexcept {
        Aabb<T> all;
        for (int r = 0; r < 3; ++r)
            for (int k = 0; k < 4; ++k) {
                all.lo[r] = glm::min(all.lo[r], lo[r][k]);
                all.hi[r] = glm::max(all.hi[r], hi[r][k]);
            }
        return {within_numbers(all.lo), within_numbers(all.hi)};
    }
};

// Bounds of boxes, block by block, under a matrix that projected_bounds.hpp has prepared.
template <class T>
struct BoundsOfBoxes {
    Mat4<T> const& matrix;
    Vec4<T> const (&rows)[4];  // of the matrix
    T w_min;
    BoxArrays<T> const& boxes;
    int count;  // a block and more
    Aabb<T>& bounds;

    static constexpr int n = bodies_at_once;

    [[nodiscard, gnu::always_inline]] int blocks() const noexcept { return (count + n - 1) / n; }
    // The last block has some boxes of the one before once more, which changes nothing.
    [[nodiscard, gnu::always_inline]] int begin_of(int block) const noexcept {
        return block * n + n <= count ? block * n : count - n;
    }

    // What a block of boxes is: all in order and in reach, or some empty, or some that no product can be made of.
    enum class Kind { all_full, some_empty, beyond_reach };

    // As much as all coordinates of a box together.
    [[gnu::always_inline]] static T size_of(BoxArrays<T> const& at, int i) noexcept {
        return std::abs(at.lo_x[i]) + std::abs(at.hi_x[i]) + std::abs(at.lo_y[i]) + std::abs(at.hi_y[i]) +
               std::abs(at.lo_z[i]) + std::abs(at.hi_z[i]);
    }
    [[gnu::always_inline]] static Kind kind_of(BoxArrays<T> const& at, std::uint32_t (&taken)[bodies_at_once],
                                               T (&size)[bodies_at_once]) noexcept {
        decltype(beyond_reach(T(0))) beyond = 0;
        std::uint32_t all_taken = ~0u;
        for (int i = 0; i < n; ++i) {
            size[i] = size_of(at, i);
            beyond |= beyond_reach(size[i]);
        }
        if (beyond >> (8 * sizeof beyond - 1) != 0) return Kind::beyond_reach;
        for (int i = 0; i < n; ++i) {
            taken[i] = full(at, i) ? ~0u : 0u;
            all_taken &= taken[i];
        }
        return all_taken != 0 ? Kind::all_full : Kind::some_empty;
    }
    [[gnu::always_inline]] static bool full(BoxArrays<T> const& at, int i) noexcept {
        return (at.lo_x[i] <= at.hi_x[i]) & (at.lo_y[i] <= at.hi_y[i]) & (at.lo_z[i] <= at.hi_z[i]);
    }

    // w is the same everywhere: one quotient at the end serves all. So is what a row adds to every box. Which end of a
    // box goes farther along a row is a matter of the row's signs.
    [[gnu::always_inline]] void affine() const noexcept {
        BoundsInBlocks<T> so_far;
        std::uint32_t taken[bodies_at_once];
        T size[bodies_at_once], least[bodies_at_once], most[bodies_at_once];
        for (int block = 0; block < blocks(); ++block) {
            BoxArrays<T> const at = boxes_from(boxes, begin_of(block));
            Kind const kind = kind_of(at, taken, size);
            if (kind == Kind::beyond_reach) {
                one_by_one(at);
                continue;
            }
            for (int r = 0; r < 3; ++r) {
                Vec3<T> const above(rows[r]);
                T const *const x0 = above.x > T(0) ? at.lo_x : at.hi_x, *const x1 = above.x > T(0) ? at.hi_x : at.lo_x;
                T const *const y0 = above.y > T(0) ? at.lo_y : at.hi_y, *const y1 = above.y > T(0) ? at.hi_y : at.lo_y;
                T const *const z0 = above.z > T(0) ? at.lo_z : at.hi_z, *const z1 = above.z > T(0) ? at.hi_z : at.lo_z;
                T(&lo)[bodies_at_once] = so_far.lo[r], (&hi)[bodies_at_once] = so_far.hi[r];
                if (kind == Kind::all_full) {
                    for (int i = 0; i < n; ++i) {
                        lo[i] = so_far.less(lo[i], above.x * x0[i] + above.y * y0[i] + above.z * z0[i]);
                        hi[i] = so_far.more(hi[i], above.x * x1[i] + above.y * y1[i] + above.z * z1[i]);
                    }
                    continue;
                }
                for (int i = 0; i < n; ++i) {
                    least[i] = above.x * x0[i] + above.y * y0[i] + above.z * z0[i];
                    most[i] = above.x * x1[i] + above.y * y1[i] + above.z * z1[i];
                }
                // NOTE: in the loop above, this would become a branch.
                for (int i = 0; i < n; ++i) so_far.add(r, i, taken[i] != 0 ? T(0) : so_far.none, least[i], most[i]);
            }
        }
        Aabb<T> const merged = so_far.merged();
        Vec3<T> const offset(matrix[3]);
        auto const ndc = [&](Vec3<T> const& p) { return within_numbers((p + offset) / matrix[3][3]); };
        if (!is_empty(merged)) bounds = merge(bounds, Aabb<T>{ndc(merged.lo), ndc(merged.hi)});
    }

    // Of each box of a block the corner that is farthest along a row, or nearest: a matter of the row's signs.
    struct Ends {
        T const *x, *y, *z;

        [[gnu::always_inline]] Ends from(int begin) const noexcept { return {x + begin, y + begin, z + begin}; }
        // In the order of EndProducts.
        [[gnu::always_inline]] T along(Vec4<T> const& row, int i) const noexcept {
            return (row.x * x[i] + row.y * y[i]) + (row.z * z[i] + row.w);
        }
    };
    [[gnu::always_inline]] static Ends ends_of(BoxArrays<T> const& at, Vec4<T> const& row, bool farthest) noexcept {
        return {(row.x > T(0)) == farthest ? at.hi_x : at.lo_x, (row.y > T(0)) == farthest ? at.hi_y : at.lo_y,
                (row.z > T(0)) == farthest ? at.hi_z : at.lo_z};
    }

    // A side of what is known: a box does not reach beyond x / w = h where x - h w, which is linear, is negative at its
    // farthest corner. No quotient is needed for that.
    struct Side {
        T x, y, z, offset;
        Ends farthest;  // of all boxes
        T growth;       // by what the rounding of a quotient can make of it, for every metre of `size`
    };
    // False where nothing is known.
    bool take_sides(Aabb<T> const& known, Side (&sides)[6]) const noexcept {
        if (is_empty(known)) return false;
        auto const magnitude = [](Vec4<T> const& v) {
            return glm::max(glm::max(std::abs(v.x), std::abs(v.y)), std::abs(v.z));
        };
        constexpr T unsure = T(16) * std::numeric_limits<T>::epsilon();
        Vec4<T> const below = rows[3];
        for (int i = 0; i < 6; ++i) {
            Vec4<T> const above = rows[i / 2];
            T const h = i % 2 == 0 ? known.lo[i / 2] : known.hi[i / 2], further = std::abs(h);
            Vec4<T> const beyond = (above - below * h) * (i % 2 == 0 ? T(-1) : T(1));
            T const offset = beyond.w + unsure * (std::abs(above.w) + further * std::abs(below.w));
            sides[i] = {beyond.x,
                        beyond.y,
                        beyond.z,
                        offset,
                        ends_of(boxes, beyond, true),
                        unsure * (magnitude(above) + further * magnitude(below))};
        }
        return true;
    }
    // Whether a box of the block that is `taken` may reach beyond a side.
    [[gnu::always_inline]] bool may_extend(Side const (&sides)[6], int begin, T const (&size)[bodies_at_once],
                                           std::uint32_t const (&taken)[bodies_at_once]) const noexcept {
        for (int r = 0; r < 3; ++r) {
            Vec4<T> const below(sides[2 * r].x, sides[2 * r].y, sides[2 * r].z, sides[2 * r].offset);
            Vec4<T> const above(sides[2 * r + 1].x, sides[2 * r + 1].y, sides[2 * r + 1].z, sides[2 * r + 1].offset);
            Ends const lower = sides[2 * r].farthest.from(begin), upper = sides[2 * r + 1].farthest.from(begin);
            T const lo_growth = sides[2 * r].growth, hi_growth = sides[2 * r + 1].growth;
            std::uint32_t may = 0;
            // NOTE: what is no number may.
            for (int i = 0; i < n; ++i) {
                std::uint32_t const inside_lo = lower.along(below, i) + lo_growth * size[i] <= T(0) ? ~0u : 0u;
                std::uint32_t const inside_hi = upper.along(above, i) + hi_growth * size[i] <= T(0) ? ~0u : 0u;
                may |= taken[i] & ~(inside_lo & inside_hi);
            }
            if (may != 0) return true;
        }
        return false;
    }

    // Which of a block's boxes are wholly at w >= w_min, and which but partly; false where none is the latter.
    [[gnu::always_inline]] bool sort(Ends const& least, Ends const& most, std::uint32_t (&taken)[bodies_at_once],
                                     std::uint32_t (&astride)[bodies_at_once]) const noexcept {
        Vec4<T> const below = rows[3];
        std::uint32_t any_astride = 0;
        for (int i = 0; i < n; ++i) {
            std::uint32_t const in_front = least.along(below, i) >= w_min ? ~0u : 0u;
            std::uint32_t const reaches = most.along(below, i) >= w_min ? ~0u : 0u;
            astride[i] = taken[i] & reaches & ~in_front;
            taken[i] &= in_front;
            any_astride |= astride[i];
        }
        return any_astride != 0;
    }

    [[gnu::always_inline]] void add_all_corners(BoxArrays<T> const& at, std::uint32_t const (&taken)[bodies_at_once],
                                                BoundsInBlocks<T>& so_far) const noexcept {
        T inverse[8][bodies_at_once], away[bodies_at_once];
        Vec4<T> const below = rows[3];
        for (int i = 0; i < n; ++i) {
            EndProducts<T> const w(below, at, i);
            T const xy00 = w.x0 + w.y0, xy10 = w.x1 + w.y0, xy01 = w.x0 + w.y1, xy11 = w.x1 + w.y1;
            // Corners that do not count may be at w = 0 itself, and farther out than numbers go: they are taken to the
            // origin. Of those that do this changes none.
            T const counts = taken[i] != 0 ? T(1) : T(0);
            auto const over = [this, counts](T corner_w) { return counts / (corner_w > w_min ? corner_w : w_min); };
            inverse[0][i] = over(xy00 + w.z0), inverse[1][i] = over(xy10 + w.z0);
            inverse[2][i] = over(xy01 + w.z0), inverse[3][i] = over(xy11 + w.z0);
            inverse[4][i] = over(xy00 + w.z1), inverse[5][i] = over(xy10 + w.z1);
            inverse[6][i] = over(xy01 + w.z1), inverse[7][i] = over(xy11 + w.z1);
            away[i] = taken[i] != 0 ? T(0) : so_far.none;
        }
        for (int r = 0; r < 3; ++r) {
            Vec4<T> const above = rows[r];
            for (int i = 0; i < n; ++i) {
                EndProducts<T> const p(above, at, i);
                T const xy00 = p.x0 + p.y0, xy10 = p.x1 + p.y0, xy01 = p.x0 + p.y1, xy11 = p.x1 + p.y1;
                T const a = (xy00 + p.z0) * inverse[0][i], b = (xy10 + p.z0) * inverse[1][i];
                T const c = (xy01 + p.z0) * inverse[2][i], d = (xy11 + p.z0) * inverse[3][i];
                T const e = (xy00 + p.z1) * inverse[4][i], f = (xy10 + p.z1) * inverse[5][i];
                T const g = (xy01 + p.z1) * inverse[6][i], h = (xy11 + p.z1) * inverse[7][i];
                auto const less = [](T s, T t) { return BoundsInBlocks<T>::less(s, t); };
                auto const more = [](T s, T t) { return BoundsInBlocks<T>::more(s, t); };
                T const least = less(less(less(a, b), less(c, d)), less(less(e, f), less(g, h)));
                T const most = more(more(more(a, b), more(c, d)), more(more(e, f), more(g, h)));
                so_far.add(r, i, away[i], least, most);
            }
        }
    }

    [[gnu::always_inline]] void perspective() const noexcept {
        BoundsInBlocks<T> so_far;
        Side sides[6];
        std::uint32_t taken[bodies_at_once], astride[bodies_at_once];
        Ends const nearest = ends_of(boxes, rows[3], false), farthest = ends_of(boxes, rows[3], true);
        T size[bodies_at_once];
        BoundsInLanes<T> of_astride;
        bool known = false;
        for (int block = 0; block < blocks(); ++block) {
            int const begin = begin_of(block);
            BoxArrays<T> const at = boxes_from(boxes, begin);
            if (kind_of(at, taken, size) == Kind::beyond_reach) {
                one_by_one(at);
                continue;
            }
            if (sort(nearest.from(begin), farthest.from(begin), taken, astride))
                for (int i = 0; i < n; ++i)
                    if (astride[i] != 0) add_astride(at, i, of_astride);
            // It does not pay sooner, nor to look more often.
            if (block >= 16 && (block & (block - 1)) == 0)
                known = take_sides(merge(bounds, merge(of_astride.merged(), so_far.merged())), sides);
            if (known && !may_extend(sides, begin, size, taken)) continue;
            add_all_corners(at, taken, so_far);
        }
        bounds = merge(bounds, merge(of_astride.merged(), so_far.merged()));
    }

    // A box in reach that is partly at w < w_min: its corners in front of that, and where its edges pass through it.
    [[gnu::always_inline]] void add_astride(BoxArrays<T> const& at, int i, BoundsInLanes<T>& of) const noexcept {
        using Four = Lanes<T>;
        Four const zero = Four::all(T(0)), one = Four::all(T(1)), least_w = Four::all(w_min), per_w = one / least_w;
        Four lower[4], upper[4];  // rows of the corners at either end of z: x grows first, then y
        for (int r = 0; r < 4; ++r) {
            EndProducts<T> const p(rows[r], at, i);
            Four const xy = Four::of(p.x0, p.x1, p.x0, p.x1) + Four::of(p.y0, p.y0, p.y1, p.y1);
            lower[r] = xy + Four::all(p.z0), upper[r] = xy + Four::all(p.z1);
        }
        auto const add_corners = [&](Four const(&corner)[4]) {
            of.add(corner[0], corner[1], corner[2], one / largest(corner[3], least_w),
                   where_at_most(least_w, corner[3], zero, one));
        };
        add_corners(lower), add_corners(upper);
        auto const add_edges = [&](Four const(&from)[4], Four const(&to)[4]) {
            Four const above = from[3] - least_w, other = to[3] - least_w;
            Four const none_behind = where_at_most(zero, least(above, other), one, zero);
            Four const lacking = where_at_most(zero, largest(above, other), none_behind, one);
            // Of an edge that does not pass through: its beginning.
            Four const t = where_at_most(lacking, zero, above, zero) / where_at_most(lacking, zero, above - other, one),
                       rest = one - t;
            of.add(from[0] * rest + to[0] * t, from[1] * rest + to[1] * t, from[2] * rest + to[2] * t, per_w, lacking);
        };
        Four x_from[4], x_to[4], y_from[4], y_to[4];
        for (int r = 0; r < 4; ++r) {
            x_from[r] = picked<0, 2, 4, 6>(lower[r], upper[r]), x_to[r] = picked<1, 3, 5, 7>(lower[r], upper[r]);
            y_from[r] = picked<0, 1, 4, 5>(lower[r], upper[r]), y_to[r] = picked<2, 3, 6, 7>(lower[r], upper[r]);
        }
        add_edges(x_from, x_to), add_edges(y_from, y_to), add_edges(lower, upper);
    }

    // Whatever they are.
    void one_by_one(BoxArrays<T> const& at) const noexcept {
        for (int i = 0; i < n; ++i) {
            Aabb<T> const box = box_at(at, i);
            if (all_finite(box) && !is_empty(box)) bounds = merge(bounds, bounds_of_body(matrix, corners(box), w_min));
        }
    }

    [[gnu::always_inline]] void operator()() const noexcept {
        bool const flat = matrix[0][3] == T(0) && matrix[1][3] == T(0) && matrix[2][3] == T(0);
        if (flat)
            affine();
        else
            perspective();
    }
};

}  // namespace detail
}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/projected_bounds.hpp ========
//
// What a matrix makes of bodies: the bounds in NDC of one, or of a hundred thousand boxes together, clipped before the
// divide. The rectangle of a map that receivers or casters need (region.hpp).
//
// Any matrix will do. Source: ours; boxes as in culling.hpp, a corner is X + Y + Z.

namespace shadowmath {
inline namespace v0 {

// Bounds in NDC of the part of a convex body at w >= w_min; empty when nothing is left, or an input is not finite. The
// body is given by eight corners whose indices differ in one bit along an edge, as those of a box or a view volume.
// Every point of the body at w >= w_min lies inside, to rounding, for any matrix and for boxes of +-FLT_MAX: the
// twelve edges are cut at w_min before anything is divided. A w_min that is not positive becomes the least one whose
// quotients still mean something: epsilon times the largest w.
template <class T>
[[nodiscard]] inline Aabb<T> projected_bounds(Mat4<T> const& clip_from_world, std::array<Vec3<T>, 8> const& corners,
                                              T w_min) noexcept {
    return detail::bounds_of_body(clip_from_world, corners, w_min);
}

// The bounds of many boxes together: what projected_bounds of each, merged, would give, to rounding; a box that is
// empty or not finite adds nothing. Fast where w_min is positive, or the matrix affine; otherwise box by box.
template <class T>
[[nodiscard]] inline Aabb<T> projected_bounds(Mat4<T> const& clip_from_world, BoxArrays<T> const& boxes, int count,
                                              T w_min) noexcept {
    Aabb<T> bounds;
    if (!all_finite(clip_from_world) || !all_finite(&w_min, 1)) return bounds;
    Mat4<T> const& m = clip_from_world;
    T entry = T(0);
    for (int column = 0; column < 4; ++column)
        for (int r = 0; r < 4; ++r) entry = glm::max(entry, std::abs(m[column][r]));
    bool const flat = m[0][3] == T(0) && m[1][3] == T(0) && m[2][3] == T(0);
    bool const ordinary = entry <= T(1e15) && (flat ? m[3][3] >= T(1e-15) && m[3][3] >= w_min : w_min >= T(1e-15));
    constexpr int n = detail::bodies_at_once;
    if (ordinary && count > 0) {
        Vec4<T> const rows[4] = {row(m, 0), row(m, 1), row(m, 2), row(m, 3)};
        // Fewer than a block are filled up with copies of the first, which change nothing.
        T ends[6][n];
        BoxArrays<T> const padded{ends[0], ends[1], ends[2], ends[3], ends[4], ends[5]};
        for (int i = 0; i < n && count < n; ++i) {
            Aabb<T> const box = box_at(boxes, i < count ? i : 0);
            for (int axis = 0; axis < 3; ++axis) ends[axis][i] = box.lo[axis], ends[axis + 3][i] = box.hi[axis];
        }
        detail::run_widely(
            detail::BoundsOfBoxes<T>{m, rows, w_min, count < n ? padded : boxes, count < n ? n : count, bounds});
    }
    for (int i = ordinary ? count : 0; i < count; ++i) {
        Aabb<T> const box = box_at(boxes, i);
        if (all_finite(box) && !is_empty(box)) bounds = merge(bounds, projected_bounds(m, corners(box), w_min));
    }
    return bounds;
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/region.hpp ========
//
// A rectangle of a map, as a matrix on the left: crop to what is used, place in an atlas, compose both. Which rectangle
// a body needs says projected_bounds.hpp, which comes with it.
//
// Use it after any technique: nothing here knows how the matrix was made, and neither the light's law nor the order of
// depth is touched. Source: Kwon 2002 (thesis), 4.1, with its y scale corrected.

namespace shadowmath {
inline namespace v0 {

template <class T>
struct Region {
    Vec2<T> lo{T(-1)};  // NDC; the default is the whole map
    Vec2<T> hi{T(1)};
};

// A square of texels in an atlas. Rows count from texture v = 0.
struct Tile {
    int x = 0;
    int y = 0;
    int size = 0;
    int atlas_width = 0;
    int atlas_height = 0;
};

// Empty as soon as one axis has no length.
template <class T>
[[nodiscard]] inline bool is_empty(Region<T> const& region) noexcept {
    return !(region.lo.x < region.hi.x && region.lo.y < region.hi.y);
}

// May be empty.
template <class T>
[[nodiscard]] inline Region<T> intersect(Region<T> const& a, Region<T> const& b) noexcept {
    return {glm::max(a.lo, b.lo), glm::min(a.hi, b.hi)};
}

template <class T>
[[nodiscard]] inline Region<T> region_of(Aabb<T> const& box_in_ndc) noexcept {
    return {Vec2<T>(box_in_ndc.lo.x, box_in_ndc.lo.y), Vec2<T>(box_in_ndc.hi.x, box_in_ndc.hi.y)};
}

// At least `least` wide on both axes, about the same centre: what a point or a line needs before it can fill a map. One
// texel is 2 / map_size of the whole map.
template <class T>
[[nodiscard]] inline Region<T> widened(Region<T> const& region, T least) noexcept {
    Region<T> wide = region;
    for (int axis = 0; axis < 2; ++axis) {
        if (region.hi[axis] - region.lo[axis] >= least) continue;
        T const centre = region.lo[axis] / T(2) + region.hi[axis] / T(2);
        wide.lo[axis] = centre - least / T(2);
        wide.hi[axis] = centre + least / T(2);
    }
    return wide;
}

// Leaves `margin_texels` of the map free on every side, for the kernel of a filter. 2 * margin_texels < map_size.
template <class T>
[[nodiscard]] inline Region<T> with_margin(Region<T> const& region, int map_size, T margin_texels) noexcept {
    Vec2<T> const border = (region.hi - region.lo) * (margin_texels / (T(map_size) - T(2) * margin_texels));
    return {region.lo - border, region.hi + border};
}

// The region fills the map: lo lands on (-1, -1), hi on (1, 1); depth and w are left alone. A region that is empty or
// not finite gives the identity.
template <class T>
[[nodiscard]] inline Mat4<T> region_matrix(Region<T> const& region) noexcept {
    if (!all_finite(region.lo) || !all_finite(region.hi) || is_empty(region)) return Mat4<T>(T(1));
    Vec2<T> const size = region.hi - region.lo;
    Vec2<T> const scale = T(2) / size, offset = -(region.hi + region.lo) / size;
    if (!all_finite(size) || !all_finite(scale) || !all_finite(offset)) return Mat4<T>(T(1));
    return from_rows(Vec4<T>(scale.x, T(0), T(0), offset.x), Vec4<T>(T(0), scale.y, T(0), offset.y),
                     Vec4<T>(T(0), T(0), T(1), T(0)), Vec4<T>(T(0), T(0), T(0), T(1)));
}

// bad_region for a tile without area, or not wholly inside its atlas.
[[nodiscard]] constexpr Faults faults_of(Tile const& tile) noexcept {
    // Compared by subtraction: x + size may overflow.
    bool const inside = tile.size > 0 && tile.x >= 0 && tile.y >= 0 && tile.atlas_width > 0 && tile.atlas_height > 0 &&
                        tile.x <= tile.atlas_width - tile.size && tile.y <= tile.atlas_height - tile.size;
    return inside ? Faults{} : Faults(Fault::bad_region);
}

// The whole map lands on the tile: tile_matrix * clip_from_world is the map inside its atlas, to look receivers up
// with. The identity where faults_of(tile) says bad_region.
//
// NOTE: nothing clips to the tile. Draw casters with the plain matrix and the tile as the viewport, and test
// a receiver against the plain matrix first: a point beyond the map lands in a neighbour's tile.
template <class T>
[[nodiscard]] inline Mat4<T> tile_matrix(Tile const& tile, ClipSpace clip = {}) noexcept {
    if (faults_of(tile).any()) return Mat4<T>(T(1));
    T const width = T(tile.atlas_width), height = T(tile.atlas_height), size = T(tile.size);
    T const up = clip.ndc_y == clip.texture_v ? T(1) : T(-1);
    T const x = (T(2) * T(tile.x) + size) / width - T(1), y = (T(2) * T(tile.y) + size) / height - T(1);
    return from_rows(Vec4<T>(size / width, T(0), T(0), x), Vec4<T>(T(0), size / height, T(0), up * y),
                     Vec4<T>(T(0), T(0), T(1), T(0)), Vec4<T>(T(0), T(0), T(0), T(1)));
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/fit_crop.hpp ========
//
// Crop: zoom a light's own projection onto a box in its NDC. In post-projective light space a sun and a spot are the
// same case, since every light ray runs along the depth axis there. fit_spot is the whole way for a spot light; for a
// sun use fit_sphere or fit_box, which need no first projection.
//
// Boxes here are in CANONICAL light NDC (clip_space.hpp): x and y in [-1, 1], y up, depth 0 at the light's near plane
// and 1 at its far one. clip_from_canonical goes to the left of everything, at the end.
//
// Source: Zhang, Sun, Nyman, GPU Gems 3 chapter 10.1.3 (2007). Departures: the split's own corners are used, not those
// of its world box; what is behind the light is cut before the division by w; the near plane of a spot comes from its
// casters, in metres, because the depth of a projection with a tiny near plane has lost them.

namespace shadowmath {
inline namespace v0 {

// Everything in the split, and every caster between it and the light.
template <class T>
[[nodiscard]] inline Aabb<T> scene_independent_box(Aabb<T> const& split) noexcept {
    return {Vec3<T>(split.lo.x, split.lo.y, T(0)), split.hi};
}

// Only where a caster and a receiver of the split share light rays can there be a shadow. `receivers` are those of the
// split, cut to it. Points outside must read as lit. Where no ray is shared, the split's own box: harmless, and a sign
// to leave the map out.
template <class T>
[[nodiscard]] inline Aabb<T> scene_dependent_box(Aabb<T> const& split, Aabb<T> const& receivers,
                                                 Aabb<T> const& casters) noexcept {
    Aabb<T> box = intersect(intersect(split, receivers), casters);
    // Depth starts at the first caster, and need not go past the last receiver.
    box.lo.z = std::fmin(split.lo.z, casters.lo.z);
    box.hi.z = std::fmin(split.hi.z, receivers.hi.z);
    return is_empty(box) ? split : box;
}

// The box's corners go to those of the canonical clip volume; the order of depths stays. A flat box is widened to what
// the scalar type can tell apart; one that is empty or not finite gives nowhere().
template <class T>
[[nodiscard]] inline Mat4<T> crop_matrix(Aabb<T> const& box_in_ndc) noexcept {
    if (!all_finite(box_in_ndc) || is_empty(box_in_ndc)) return nowhere<T>();
    Aabb<T> box = box_in_ndc;
    T const largest = std::fmax(detail::largest_of(box), T(1));
    if (!(largest <= detail::farthest_metres<T>)) return nowhere<T>();
    for (int axis = 0; axis < 3; ++axis)
        detail::widen(box.lo[axis], box.hi[axis], T(8) * std::numeric_limits<T>::epsilon() * largest);
    Vec3<T> const extent = box.hi - box.lo, sum = box.hi + box.lo;
    return from_rows(Vec4<T>(T(2) / extent.x, T(0), T(0), -sum.x / extent.x),
                     Vec4<T>(T(0), T(2) / extent.y, T(0), -sum.y / extent.y),
                     Vec4<T>(T(0), T(0), T(1) / extent.z, -box.lo.z / extent.z), Vec4<T>(T(0), T(0), T(0), T(1)));
}

// A spot as a camera: the pyramid around its cone, from z_near to its range. z_near is brought into
// [range / 2^20, range / 2]: the first keeps depth finite, the second a volume.
template <class T>
[[nodiscard]] inline ViewVolume<T> spot_view(Light<T> const& light, T z_near) noexcept {
    LightBasis<T> const basis = light_basis(light.direction);
    T const angle = std::fmin(std::fmax(light.half_angle_radians, T(1e-3)), T(1.5));
    T const side = std::tan(angle);
    ViewVolume<T> view{{light.position, basis.x, basis.y, basis.depth},
                       -side,
                       side,
                       -side,
                       side,
                       z_near,
                       light.range,
                       ViewKind::perspective};
    view.z_near = std::fmin(std::fmax(z_near, light.range / T(1 << 20)), light.range / T(2));
    return view;
}

namespace detail {

// The far corners of the cone's pyramid: tan(1.5) is 14.1.
template <class T>
[[nodiscard]] inline bool is_within_reach(Light<T> const& light) noexcept {
    return std::fmax(T(20) * light.range, largest_of(light.position)) <= farthest_metres<T> &&
           light.range >= least_metres<T>;
}

}  // namespace detail

// The whole cone in one map. nowhere() for a light that is unusable, and for a sun.
template <class T>
[[nodiscard]] inline Mat4<T> spot_clip_from_world(Light<T> const& light, T const& z_near, ClipSpace clip) noexcept {
    if (light.kind != LightKind::spot || unusable(light) || !all_finite(&z_near, 1) || !detail::is_within_reach(light))
        return nowhere<T>();
    return clip_from_world(spot_view(light, z_near), clip);
}

// The map of what the eye sees in this slice of the lit cone: every receiver there, with `margin_texels` texels to
// spare on each side, and every caster between it and the light. Zooms in as far as slice and receivers allow, at most
// until the whole cone would be map_size maps wide.
//
// Lost: what is nearer to the light than 1/4096 of its range. An infinite z_far is cut at the end of the cone. Not
// visible, and no fault: no caster or no receiver in the lit part of the slice. Faults of slice, light and margin are
// handed on; a sun is clamped_option.
template <class T>
[[nodiscard]] inline ShadowMap<T> fit_spot(ViewVolume<T> const& slice, Light<T> const& light, Aabb<T> const& casters,
                                           Aabb<T> const& receivers, int map_size, T margin_texels,
                                           ClipSpace clip) noexcept {
    ShadowMap<T> map;
    map.clip = clip;
    map.faults = faults_of(slice) | faults_of(light) | faults_of_margin(map_size, margin_texels);
    if (light.kind != LightKind::spot) map.faults |= Fault::clamped_option;
    if (!all_finite(casters) || !all_finite(receivers)) map.faults |= Fault::not_finite;
    bool const usable = !map.faults.has(Fault::not_finite) && !map.faults.has(Fault::map_too_small) &&
                        light.kind == LightKind::spot && !unusable(light) && detail::is_within_reach(light);
    if (!usable || is_empty(casters) || is_empty(receivers)) return map;

    // Beyond the end of the cone the eye sees nothing lit.
    ViewVolume<T> seen = slice;
    ViewVolume<T> lit = spot_view(light, light.range / T(4096));
    T const end = eye_depth(slice, light.position) + light.range * (T(1) + T(1.5) * lit.right);
    if (is_positive_infinity(&slice.z_far) || end < slice.z_far) seen.z_far = end;
    if (!(seen.z_near < seen.z_far) || !(bounding_sphere(seen).radius > T(0))) return map;

    std::array<Vec3<T>, 8> const seen_corners = corners(seen);
    Aabb<T> const received = intersect(receivers, bounds_of(seen_corners));
    DepthRange<T> const receiver_depth = depths_inside(received, lit);
    if (!receiver_depth.visible) return map;
    lit.z_far = receiver_depth.hi;
    DepthRange<T> const caster_depth = lit.z_near < lit.z_far ? depths_inside(casters, lit) : DepthRange<T>{};
    if (!caster_depth.visible) return map;

    // A thousandth before the first and behind the last: room for rounding, and a volume where all lies at one depth.
    lit.z_near = std::fmin(caster_depth.lo, receiver_depth.lo) * (T(1) - T(1) / T(1024));
    lit.z_far = lit.z_far * (T(1) + T(1) / T(1024));
    Mat4<T> const canonical = clip_from_world(lit, ClipSpace{});
    // NOTE: depth is known from above, and better: a wide slice's own, cut at a tiny w, is mostly rounding.
    auto const in_cone = [&](std::array<Vec3<T>, 8> const& body) {
        Aabb<T> bounds = projected_bounds(canonical, body, lit.z_near);
        if (is_empty(bounds)) return bounds;
        bounds.lo.z = T(0);
        bounds.hi.z = T(1);
        return intersect(bounds, Aabb<T>{Vec3<T>(T(-1), T(-1), T(0)), Vec3<T>(T(1))});
    };
    Aabb<T> const split = in_cone(seen_corners);
    if (is_empty(split)) return map;
    // Casters do not narrow the sides: then every receiver would still be right, but not every one inside.
    Aabb<T> box = intersect(split, in_cone(corners(received)));
    Aabb<T> const shared = intersect(box, in_cone(corners(intersect(casters, bounds_of(corners(lit))))));
    if (is_empty(shared)) return map;
    T const usable_part = usable_texels(map_size, margin_texels) / T(map_size);
    for (int axis = 0; axis < 2; ++axis) {
        detail::widen(box.lo[axis], box.hi[axis], T(2) / T(map_size));
        detail::widen(box.lo[axis], box.hi[axis], (box.hi[axis] - box.lo[axis]) / usable_part);
    }
    map.clip_from_world = clip_from_canonical<T>(clip) * crop_matrix(box) * canonical;
    map.w_min = lit.z_near;
    map.visible = true;
    return map;
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/fit_cube.hpp ========
//
// A lamp that shines in all directions: six maps, each a spot's, and only those that the eye has a use for. A face is
// skipped where the view, the receivers or the casters do not reach it; those that remain are zoomed in on what is
// seen, and their near planes come from their casters.
//
//          +---+
//          |+y |            face    0   1   2   3   4   5
//      +---+---+---+---+    axis   +x  -x  +y  -y  +z  -z       of the world
//      |-x |+z |+x |-z |
//      +---+---+---+---+    A receiver is looked up in the map of its own face (face_toward). The maps are plain 2D
//          |-y |            ones for tiles of an atlas, each with its own margin, so that filters see no seams between
//          +---+            faces; not layers of a cube texture, which cannot be zoomed in on.
//
// Source: six perspective faces are common knowledge; the crop is that of fit_spot.

namespace shadowmath {
inline namespace v0 {

inline constexpr int cube_faces = 6;

template <class T>
struct CubeMaps {
    std::array<ShadowMap<T>, cube_faces> face;
    int visible_count = 0;  // 0: nothing to draw, everything lit
    Faults faults;
};

// The spot whose pyramid is this face, for bias_for and for drawing. It is wider than the face by a thousandth, so that
// no receiver falls between two. `face` from 0 to 5.
template <class T>
[[nodiscard]] inline Light<T> face_light(Vec3<T> const& position, T range, int face) noexcept {
    SHADOWMATH_ASSERT(face >= 0 && face < cube_faces, "a cube has six faces");
    Vec3<T> axis(T(0));
    axis[face / 2 % 3] = face % 2 == 0 ? T(1) : T(-1);
    constexpr T eighth_of_a_turn = T(0.78539816339744830961566084581987572L);
    return spot(position, axis, eighth_of_a_turn + T(0.5e-3), range);
}

// The face through which the light at `position` sees the point: of its largest coordinate, the earlier axis where two
// are equal. 0 for the position itself.
template <class T>
[[nodiscard]] inline int face_toward(Vec3<T> const& position, Vec3<T> const& point) noexcept {
    Vec3<T> const way = point - position, size(std::abs(way.x), std::abs(way.y), std::abs(way.z));
    int const axis = size.x >= size.y && size.x >= size.z ? 0 : (size.y >= size.z ? 1 : 2);
    return 2 * axis + (way[axis] < T(0) ? 1 : 0);
}

// As fit_spot, for each face: every receiver in the slice and within `range` metres of the light is inside the map of
// its face, with `margin_texels` texels to spare, and every caster between it and the light; nearer than range / 4096
// nothing casts. A face without both is not visible, and that is no fault.
template <class T>
[[nodiscard]] inline CubeMaps<T> fit_cube(ViewVolume<T> const& slice, Vec3<T> const& position, T const& range,
                                          Aabb<T> const& casters, Aabb<T> const& receivers, int map_size,
                                          T margin_texels, ClipSpace clip) noexcept {
    CubeMaps<T> maps;
    // What lies beyond the sphere is not lit; corners of a face's pyramid would reach farther.
    Aabb<T> lit = receivers;
    if (all_finite(position) && all_finite(&range, 1) && all_finite(receivers))
        lit = intersect(receivers, Aabb<T>{position - range, position + range});
    for (int i = 0; i < cube_faces; ++i) {
        ShadowMap<T>& face = maps.face[static_cast<std::size_t>(i)];
        face = fit_spot(slice, face_light(position, range, i), casters, lit, map_size, margin_texels, clip);
        maps.faults |= face.faults;
        maps.visible_count += face.visible ? 1 : 0;
    }
    return maps;
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/polytope.hpp ========
//
// A convex body that planes can cut: what a view sees of a box, what a light reaches of that. No heap, no sorting.
//
// The body is its edges, each with the two faces that meet there. A plane shortens edges; every face that it cuts is
// left with two ends, and the line between them is a new edge, shared with the new face. So nothing ever needs to be
// in order. Each face also keeps its own plane, which sweep.hpp follows the light with. Use it to bound what a map must
// hold; for a box alone bounds.hpp is enough.

namespace shadowmath {
inline namespace v0 {

// Six faces to begin with and up to twenty-six cuts: a polyhedron of f faces has at most 3 f - 6 edges.
inline constexpr int max_body_faces = 32;
inline constexpr int max_body_edges = 3 * max_body_faces - 6;

template <class T>
struct ConvexBody {
    struct Edge {
        Vec3<T> a;
        Vec3<T> b;
        std::array<std::uint8_t, 2> face;
    };
    std::array<Edge, max_body_edges> edges;
    std::array<Vec4<T>, max_body_faces> half_space;  // of each face, >= 0 inside, of any length; 0 where none is known
    int edge_count = 0;                              // 0: nothing left
    int face_count = 0;
};

// From eight corners whose indices differ in one bit along an edge: a box, a view volume. A face without area has no
// plane of its own.
template <class T>
[[nodiscard]] inline ConvexBody<T> convex_body(std::array<Vec3<T>, 8> const& corners) noexcept {
    ConvexBody<T> body;
    body.face_count = 6;
    for (unsigned i = 0; i < 8; ++i)
        for (unsigned axis = 0; axis < 3; ++axis) {
            if ((i >> axis & 1u) != 0) continue;
            // Face 2 * axis is the one at the axis' lower end; an edge along one axis lies in faces of the other two.
            unsigned const u = (axis + 1) % 3, v = (axis + 2) % 3;
            body.edges[static_cast<unsigned>(body.edge_count++)] = {
                corners[i],
                corners[i | 1u << axis],
                {static_cast<std::uint8_t>(2 * u + (i >> u & 1u)), static_cast<std::uint8_t>(2 * v + (i >> v & 1u))}};
        }
    for (unsigned face = 0; face < 6; ++face) {
        unsigned const axis = face / 2, at = (face & 1u) << axis, u = 1u << (axis + 1) % 3, v = 1u << (axis + 2) % 3;
        // The diagonals span the face even where two of its corners are one.
        Vec3<T> const across = corners[at | u | v] - corners[at], aside = corners[at | v] - corners[at | u];
        Vec3<T> const normal = safe_normalize(glm::cross(across, aside)).direction;
        Vec3<T> const middle = (corners[at] + corners[at | u | v]) * T(0.5);
        Vec3<T> const opposite = (corners[at ^ 1u << axis] + corners[(at ^ 1u << axis) | u | v]) * T(0.5);
        T const sign = glm::dot(normal, opposite - middle) < T(0) ? T(-1) : T(1);
        body.half_space[face] = sign * Vec4<T>(normal, -glm::dot(normal, middle));
    }
    return body;
}

// A box: its planes are known even where it is flat.
template <class T>
[[nodiscard]] inline ConvexBody<T> convex_body(Aabb<T> const& box) noexcept {
    ConvexBody<T> body = convex_body(corners(box));
    for (int axis = 0; axis < 3; ++axis) {
        Vec3<T> normal(T(0));
        normal[axis] = T(1);
        body.half_space[static_cast<unsigned>(2 * axis)] = Vec4<T>(normal, -box.lo[axis]);
        body.half_space[static_cast<unsigned>(2 * axis + 1)] = Vec4<T>(-normal, box.hi[axis]);
    }
    return body;
}

// Every vertex, each as often as edges meet there.
template <class T, class Visit>
inline void for_each_vertex(ConvexBody<T> const& body, Visit&& visit) noexcept {
    for (int i = 0; i < body.edge_count; ++i) {
        visit(body.edges[static_cast<unsigned>(i)].a);
        visit(body.edges[static_cast<unsigned>(i)].b);
    }
}

// The part where half_space . (p, 1) >= 0. Flat bodies and planes through vertices are no special case: a vertex is
// inside or outside, the same for all its edges.
template <class T>
[[nodiscard]] inline ConvexBody<T> clipped(ConvexBody<T> const& body, Vec4<T> const& half_space) noexcept {
    SHADOWMATH_ASSERT(body.face_count < max_body_faces, "a convex body was cut too often");
    if (body.face_count >= max_body_faces) return body;
    ConvexBody<T> kept;
    kept.half_space = body.half_space;
    kept.half_space[static_cast<unsigned>(body.face_count)] = half_space;
    auto const add = [&kept](typename ConvexBody<T>::Edge const& edge) {
        if (kept.edge_count < max_body_edges) kept.edges[static_cast<unsigned>(kept.edge_count++)] = edge;
    };
    auto const cap = static_cast<std::uint8_t>(body.face_count);
    kept.face_count = body.face_count + 1;
    std::array<Vec3<T>, max_body_faces> end_of_face;
    std::array<bool, max_body_faces> open{};
    for (int i = 0; i < body.edge_count; ++i) {
        typename ConvexBody<T>::Edge edge = body.edges[static_cast<unsigned>(i)];
        T const at_a = glm::dot(half_space, Vec4<T>(edge.a, T(1))), at_b = glm::dot(half_space, Vec4<T>(edge.b, T(1)));
        bool const a_inside = at_a >= T(0), b_inside = at_b >= T(0);
        if (!a_inside && !b_inside) continue;
        if (a_inside != b_inside) {
            // From the inner end: a far outer one then costs no precision.
            T const t = a_inside ? at_a / (at_a - at_b) : at_b / (at_b - at_a);
            Vec3<T> const cut = a_inside ? edge.a + (edge.b - edge.a) * t : edge.b + (edge.a - edge.b) * t;
            (a_inside ? edge.b : edge.a) = cut;
            for (std::uint8_t const face : edge.face) {
                if (open[face]) add({end_of_face[face], cut, {face, cap}});
                end_of_face[face] = cut;
                open[face] = !open[face];
            }
        }
        add(edge);
    }
    return kept;
}

// The same body elsewhere.
template <class T>
[[nodiscard]] inline ConvexBody<T> translated(ConvexBody<T> const& body, Vec3<T> const& offset) noexcept {
    ConvexBody<T> moved = body;
    for (int i = 0; i < body.edge_count; ++i) {
        moved.edges[static_cast<unsigned>(i)].a += offset;
        moved.edges[static_cast<unsigned>(i)].b += offset;
    }
    for (int i = 0; i < body.face_count; ++i) {
        Vec4<T>& plane = moved.half_space[static_cast<unsigned>(i)];
        plane.w -= glm::dot(Vec3<T>(plane), offset);
    }
    return moved;
}

// What a view sees of a box, RELATIVE TO THE EYE: add view.pose.position for world points. Boxes of +-FLT_MAX are cut
// to the bounds of the view before any arithmetic. A valid view with a finite z_far; an empty box gives an empty body.
// `slack_metres` moves every plane outward: a wedge thinner than a rounding then loses nothing of its tip.
template <class T>
[[nodiscard]] inline ConvexBody<T> visible_body(ViewVolume<T> const& view, Aabb<T> const& box_in_world,
                                                T slack_metres = T(0)) noexcept {
    if (is_empty(box_in_world)) return {};
    Vec3<T> const &x = view.pose.right, &y = view.pose.up, &z = view.pose.forward;
    ViewVolume<T> centred = view;
    centred.pose.position = Vec3<T>(T(0));
    // NOTE: the square of this bound, times a few, still fits into a float.
    Aabb<T> const bound{Vec3<T>(T(-1e12)), Vec3<T>(T(1e12))};
    Vec3<T> const slack(slack_metres);
    Aabb<T> const relative{box_in_world.lo - view.pose.position - slack, box_in_world.hi - view.pose.position + slack};
    Aabb<T> const seen = bounds_of(corners(centred));
    Aabb<T> const box = intersect(intersect(relative, Aabb<T>{seen.lo - slack, seen.hi + slack}), bound);
    if (is_empty(box)) return {};
    bool const flat = view.kind == ViewKind::orthographic;
    auto const side = [&z, flat, slack_metres](Vec3<T> const& inward, T limit) {
        if (flat) return Vec4<T>(inward, slack_metres - limit);
        return Vec4<T>(safe_normalize(inward - z * limit).direction, slack_metres);
    };
    ConvexBody<T> body = convex_body(box);
    body = clipped(body, side(x, view.left));
    body = clipped(body, side(-x, -view.right));
    body = clipped(body, side(y, view.bottom));
    body = clipped(body, side(-y, -view.top));
    body = clipped(body, Vec4<T>(z, slack_metres - view.z_near));
    return clipped(body, Vec4<T>(-z, view.z_far + slack_metres));
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/sweep.hpp ========
//
// A convex body swept along the light: where its shadow's casters are, and where its own shadow falls. As half-spaces:
// to cull casters with, to cut boxes with.
//
//        light                    One formula for suns and spots. With l the homogeneous light and h a face's
//     |    |    |                 half-space, the face is lit when h . l > 0. Where a lit face h1 and an unlit one h2
//     |  __|__  |  <- silhouette  meet, the plane through their edge along the light is
//     | /     \ |
//     |/  body \|                     h = h1 (-h2 . l) + h2 (h1 . l),     so that h . l = 0:
//      \_______/   <- unlit faces
//                                 a sum of half-spaces of the body with weights >= 0, hence one of the body itself.
//
// No edge is ever measured, so short ones do no harm. Faces that meet at a knife's edge make a small sum, of which
// rounding has its share: so only its direction is used, and the plane put where it touches the body.
//
// Source: silhouette planes are common for view frusta (by a table of 64 cases in some engines). Departures: any convex
// body, spots, and padding for filters and for the sun's radius.

namespace shadowmath {
inline namespace v0 {

// Where all of them are >= 0: the dot product with (p, 1), metres from each plane. A frustum on a box gives ten or so;
// what would be more than fit is left out, which only culls less.
template <class T>
struct HalfSpaces {
    std::array<Vec4<T>, max_body_faces> at;  // with unit normals
    int count = 0;                           // 0: everywhere
    bool visible = false;                    // false: of no body, nowhere

    [[nodiscard]] Vec4<T> const* begin() const noexcept { return at.data(); }
    [[nodiscard]] Vec4<T> const* end() const noexcept { return at.data() + count; }
};

// How much a caster may stand beside the body and still matter to it.
template <class T>
struct SweepPadding {
    T metres = T(0);     // everywhere: filter, bias, a spot's own radius; >= 0
    T sun_slope = T(0);  // tan of the sun's angular radius: the sweep widens by this for a metre of height; >= 0
};

namespace detail {

// The half-space with this inward normal that touches the body, and the light where that is a place; of no direction,
// everywhere.
template <class T>
[[nodiscard]] inline Vec4<T> touching(ConvexBody<T> const& body, Vec4<T> const& source,
                                      Vec3<T> const& normal) noexcept {
    T lowest = source.w == T(0) ? std::numeric_limits<T>::max() : glm::dot(normal, Vec3<T>(source) / source.w);
    for_each_vertex(body, [&](Vec3<T> const& v) { lowest = std::fmin(lowest, glm::dot(normal, v)); });
    return Vec4<T>(normal, -lowest);
}

template <class T>
inline void add(HalfSpaces<T>& planes, Vec4<T> const& plane) noexcept {
    if (planes.count < max_body_faces) planes.at[static_cast<unsigned>(planes.count++)] = plane;
}

}  // namespace detail

// Every point of the body and every point on the way from there to the light is inside, `padding` farther out. `source`
// is homogeneous(light), relative to what the body is relative to; its negative sweeps away from the light. A body
// around a spot is all faces, and comes back as itself.
template <class T>
[[nodiscard]] inline HalfSpaces<T> swept_to_light(ConvexBody<T> const& body, Vec4<T> const& source,
                                                  SweepPadding<T> const& padding = {}) noexcept {
    HalfSpaces<T> swept;
    swept.visible = body.edge_count > 0;
    Vec3<T> const travel(source);
    bool const is_sun = source.w == T(0), widens = is_sun && padding.sun_slope > T(0);
    std::array<T, max_body_faces> lit{};
    std::array<bool, max_body_faces> used{};
    for (unsigned face = 0; face < static_cast<unsigned>(body.face_count); ++face)
        lit[face] = glm::dot(body.half_space[face], source);
    for (int i = 0; i < body.edge_count; ++i) {
        auto const [f, g] = body.edges[static_cast<unsigned>(i)].face;
        used[f] = used[g] = true;
        // An unlit face along the light is the silhouette's plane itself, and comes below.
        if (!(lit[f] > T(0) && lit[g] < T(0)) && !(lit[g] > T(0) && lit[f] < T(0))) continue;
        Vec4<T> const sum = body.half_space[f] * std::abs(lit[g]) + body.half_space[g] * std::abs(lit[f]);
        Vec3<T> normal = safe_normalize(Vec3<T>(sum)).direction;
        if (is_sun) normal = safe_normalize(normal - travel * glm::dot(normal, travel)).direction;
        if (normal != Vec3<T>(T(0))) detail::add(swept, detail::touching(body, source, normal));
    }
    for (unsigned face = 0; face < static_cast<unsigned>(body.face_count); ++face) {
        T const length = glm::length(Vec3<T>(body.half_space[face]));
        if (used[face] && !(lit[face] > T(0)) && length > T(0)) detail::add(swept, body.half_space[face] / length);
    }
    T const sine = padding.sun_slope / detail::hypotenuse(T(1), padding.sun_slope);
    for (unsigned i = 0; i < static_cast<unsigned>(swept.count); ++i) {
        // The way to the edge of the sun must not leave through the plane: its normal rises at least by the sun's sine.
        Vec3<T> const normal(swept.at[i]);
        T const rise = -glm::dot(normal, travel);
        if (widens && rise < sine) {
            Vec3<T> const level = safe_normalize(normal + travel * rise).direction;
            Vec3<T> const tilted = safe_normalize(level - travel * padding.sun_slope).direction;
            swept.at[i] = detail::touching(body, source, tilted);
        }
        swept.at[i].w += padding.metres;
    }
    return swept;
}

// False only where the box is outside one of the planes: such a caster has nothing to do with the body.
template <class T>
[[nodiscard]] inline bool may_meet(HalfSpaces<T> const& planes, Aabb<T> const& box) noexcept {
    if (!planes.visible || is_empty(box)) return false;
    for (Vec4<T> const& plane : planes) {
        T distance = plane.w;
        for (int axis = 0; axis < 3; ++axis)
            distance += plane[axis] * (plane[axis] > T(0) ? box.hi[axis] : box.lo[axis]);
        if (distance < T(0)) return false;
    }
    return true;
}

// The part of a body inside all planes; planes that miss it cost nothing. Where a body has run out of faces it comes
// back larger than it should be, never smaller.
template <class T>
[[nodiscard]] inline ConvexBody<T> clipped(ConvexBody<T> const& body, HalfSpaces<T> const& planes) noexcept {
    if (!planes.visible) return {};
    ConvexBody<T> part = body;
    for (Vec4<T> const& plane : planes) {
        bool cuts = false;
        for_each_vertex(part, [&](Vec3<T> const& v) { cuts = cuts || glm::dot(plane, Vec4<T>(v, T(1))) < T(0); });
        if (cuts && part.face_count < max_body_faces) part = clipped(part, plane);
    }
    return part;
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/fit_focus.hpp ========
//
// What a map for a sun must hold, and not a corner more: the receivers that the eye sees and that something can
// shadow, and of the casters only those whose shadow it sees. Both as convex bodies, not as boxes.
//
//     focus.receivers = slice of the view  n  receivers' box  n  casters' box swept down the light
//     focus.casters   = receivers swept up to the light           half-spaces, to cull with
//     focus.depth     = from the first caster in there to the last receiver
//
// Fit any rectangle around it (fit_focus, fit_rectangle). Points outside that rectangle must read as lit: nothing that
// casts reaches them, or nobody sees them.
//
// Source: Wimmer, Scherzer, Purgathofer 2004, the body B. Departures: planes that cut instead of points that are added,
// so the swept part needs no hull; receivers that no caster reaches are left out.

namespace shadowmath {
inline namespace v0 {

template <class T>
struct Focus {
    ConvexBody<T> receivers;  // world
    HalfSpaces<T> casters;    // world; may_meet is false only for what casts on none of them
    DepthRange<T> depth;      // metres along the light, from the world origin
    T first_receiver = T(0);  // where the depth may begin if casters are pancaked
    bool visible = false;     // false: nobody sees a shadow here
};

// Every point of the slice inside `receivers` and below anything inside `casters` is in focus, and so is everything of
// `casters` between it and the light; `padding` widens the casters' half-spaces only. Depth is no more than what those
// span, but for rounding. Not visible: a spot, a light or view with faults, an endless slice, or something beyond 1e12
// m; and where nothing is seen or nothing casts on it. Casters higher above the slice than 65536 times its size, and
// not below that, are cut.
template <class T>
[[nodiscard]] inline Focus<T> focus_of(ViewVolume<T> const& slice, Light<T> const& light, Aabb<T> const& casters,
                                       Aabb<T> const& receivers, SweepPadding<T> const& padding = {}) noexcept {
    Focus<T> focus;
    constexpr T eps = std::numeric_limits<T>::epsilon();
    constexpr T farthest = T(1e12);
    bool const usable = light.kind == LightKind::directional && !unusable(light) && !faults_of(slice).any() &&
                        !is_positive_infinity(&slice.z_far) && all_finite(casters) && all_finite(receivers) &&
                        !is_empty(casters) && !is_empty(receivers);
    if (!usable) return focus;
    if (!detail::sides_are_within(slice, farthest) || !(slice.z_far <= farthest) ||
        !(detail::largest_of(slice.pose.position) <= farthest))
        return focus;
    Vec3<T> const eye = slice.pose.position, travel = light.direction;
    Vec4<T> const down(travel, T(0));
    Aabb<T> const seen = bounds_of(corners(slice));
    T const size = detail::largest_of(seen.hi - seen.lo);
    Vec3<T> const reach(T(65536) * size);
    Aabb<T> const cast_box = intersect(casters, Aabb<T>{seen.lo - reach, seen.hi + reach});
    if (is_empty(cast_box)) return focus;
    // Sixteen roundings stand behind a vertex: a plane, a cut, and the eye's own place. Those of casters are larger.
    T const slack = T(16) * eps * (size + detail::largest_of(seen) + detail::largest_of(eye));
    T const far_slack = slack + T(16) * eps * detail::largest_of(cast_box);

    ConvexBody<T> const casting = convex_body(cast_box);
    focus.receivers = clipped(translated(visible_body(slice, receivers, slack), eye),
                              swept_to_light(casting, -down, SweepPadding<T>{far_slack, T(0)}));
    ConvexBody<T> const shadowing =
        clipped(casting, swept_to_light(focus.receivers, down, SweepPadding<T>{far_slack, T(0)}));
    if (shadowing.edge_count == 0) return focus;
    T first = std::numeric_limits<T>::max(), last = std::numeric_limits<T>::lowest(), caster = first;
    for_each_vertex(focus.receivers, [&](Vec3<T> const& v) {
        first = std::fmin(first, glm::dot(travel, v));
        last = std::fmax(last, glm::dot(travel, v));
    });
    for_each_vertex(shadowing, [&](Vec3<T> const& v) { caster = std::fmin(caster, glm::dot(travel, v)); });
    detail::widen(first, last, std::fmax(T(2) * slack, T(1e-6)));
    focus.first_receiver = first - slack;
    focus.depth = {std::fmin(focus.first_receiver, caster - far_slack), last + slack, true};
    SweepPadding<T> wide = padding;
    wide.metres = std::fmax(wide.metres, T(0)) + slack;
    focus.casters = swept_to_light(focus.receivers, down, wide);
    focus.visible = true;
    return focus;
}

// The light-space box around the focus in the axes given: with sides inside those of fit_box for the whole slice, but
// for rounding. Of a focus that is not visible, the box [-1, 1]^2 x [0, 1].
template <class T>
[[nodiscard]] inline LightBox<T> fit_focus(LightBasis<T> const& basis, Focus<T> const& focus, int map_size,
                                           T margin_texels) noexcept {
    if (!focus.visible || !detail::has_unit_axes(basis)) return {};
    Aabb<T> body;
    for_each_vertex(focus.receivers, [&](Vec3<T> const& v) { body = merge(body, in_light(basis, v)); });
    LightBox<T> box = box_around(basis, body, map_size, margin_texels);
    box.depth_lo = focus.depth.lo;
    box.depth_hi = focus.depth.hi;
    return box;
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/fit_rectangle.hpp ========
//
// The smallest rectangle around a body as the light sees it, at whatever angle: never larger than fit_box, and a
// quarter smaller on average around a view frustum. As with fit_box, size and place change as the camera turns, and
// edges crawl; use it where fit_box would do.
//
//    ___________         A least rectangle has a side along an edge of the hull (Freeman and Shapira 1975). The hull's
//   |   fit_box |        edges are the body's silhouette: those where a face that the light meets joins one that it
//   | /\        |        does not. So each silhouette edge is tried, and no hull is ever built.
//   |/  \__     |
//   |\ least \_ |        Two angles can be equally good, and then the least one jumps between them. The angle of the
//   |_\________\|        last frame is kept while its rectangle is within `hysteresis` of the least.
//
// Source: Freeman and Shapira, "Determining the minimum-area encasing rectangle for an arbitrary closed curve", CACM
// 18(7), 1975. Departures: the silhouette for the hull; the angle's hysteresis.

namespace shadowmath {
inline namespace v0 {

// Turned about the light: x goes to (cosine, sine) in the old axes. The two need not be of length 1 together.
template <class T>
[[nodiscard]] inline LightBasis<T> rolled(LightBasis<T> const& basis, T cosine, T sine) noexcept {
    // Not by hypot, here and below: its last bit differs between platforms, and may turn a box.
    Normalized<T> const x = safe_normalize(Vec3<T>(cosine, sine, T(0)));
    if (!x.ok) return basis;
    T const c = x.direction.x, s = x.direction.y;
    return {basis.x * c + basis.y * s, basis.y * c - basis.x * s, basis.depth};
}

// Square metres across the light.
template <class T>
[[nodiscard]] inline T area(LightBox<T> const& box) noexcept {
    return (box.hi.x - box.lo.x) * (box.hi.y - box.lo.y);
}

// As fit_box holds corners, this holds every vertex of the body (in world space), and area(box) is never more than that
// of fit_box in the same basis. Of the four quarter turns the one nearest to `previous_x` is taken: the x axis of the
// last frame's box, a world direction; or to basis.x where it is zero, or not finite, or along the light. Exactly its
// direction is kept while the area is at most 1 + hysteresis times the least, and no more than fit_box's. Bodies that
// are empty, not finite, or beyond 1e18 m give what fit_box gives for such corners.
template <class T>
[[nodiscard]] inline LightBox<T> fit_rectangle(LightBasis<T> const& basis, ConvexBody<T> const& body, int map_size,
                                               T margin_texels, Vec3<T> const& previous_x = Vec3<T>(T(0)),
                                               T hysteresis = T(0.1)) noexcept {
    if (!detail::has_unit_axes(basis) || body.edge_count == 0) return {};
    std::array<Vec3<T>, 2 * max_body_edges> vertex;  // in light space, edge by edge
    unsigned count = 0;
    bool sound = true;
    Aabb<T> bounds;
    for_each_vertex(body, [&](Vec3<T> const& v) {
        sound = sound && all_finite(v) && detail::largest_of(v) <= detail::farthest_metres<T>;
        vertex[count] = in_light(basis, v);
        bounds = merge(bounds, vertex[count++]);
    });
    if (!sound) return {};

    auto const bounds_along = [&](T c, T s) {
        Aabb<T> turned;
        for (unsigned i = 0; i < count; ++i)
            turned = merge(turned,
                           Vec3<T>(c * vertex[i].x + s * vertex[i].y, c * vertex[i].y - s * vertex[i].x, vertex[i].z));
        return turned;
    };
    auto const area_along = [&](Vec2<T> const& x) {
        Aabb<T> const turned = bounds_along(x.x, x.y);
        return (turned.hi.x - turned.lo.x) * (turned.hi.y - turned.lo.y);
    };
    T const plain = area_along(Vec2<T>(T(1), T(0)));
    Vec2<T> best(T(1), T(0));
    T least = plain;
    for (int i = 0; i < body.edge_count; ++i) {
        auto const [f, g] = body.edges[static_cast<unsigned>(i)].face;
        auto const lit = [&](unsigned face) { return glm::dot(basis.depth, Vec3<T>(body.half_space[face])) > T(0); };
        if (lit(f) == lit(g)) continue;
        Vec2<T> const edge = Vec2<T>(vertex[2 * static_cast<unsigned>(i) + 1] - vertex[2 * static_cast<unsigned>(i)]);
        Normalized<T> const along = safe_normalize(Vec3<T>(edge, T(0)));
        if (!along.ok) continue;
        T const needed = area_along(Vec2<T>(along.direction));
        if (needed < least) {
            least = needed;
            best = Vec2<T>(along.direction);
        }
    }
    // The previous direction, as far as it lies across this light.
    Vec3<T> const before = all_finite(previous_x) ? safe_normalize(previous_x).direction : Vec3<T>(T(0));
    Vec2<T> last(glm::dot(basis.x, before), glm::dot(basis.y, before));
    Normalized<T> const across = safe_normalize(Vec3<T>(last, T(0)));
    bool const has_last = across.length > T(1e-3);
    last = has_last ? Vec2<T>(across.direction) : Vec2<T>(T(1), T(0));
    T const slack = all_finite(&hysteresis, 1) && hysteresis > T(0) ? hysteresis : T(0);
    if (has_last && area_along(last) <= std::fmin(least * (T(1) + slack), plain)) best = last;
    auto const box_along = [&](Vec2<T> x) {
        // Quarter turns, until the new x is within an eighth of the last.
        if (std::abs(glm::dot(x, last)) < std::abs(x.x * last.y - x.y * last.x)) x = Vec2<T>(-x.y, x.x);
        if (glm::dot(x, last) < T(0)) x = -x;
        return box_around(rolled(basis, x.x, x.y), bounds_along(x.x, x.y), map_size, margin_texels);
    };
    // Widened and rounded, the least may have become more than the plain one.
    LightBox<T> const turned = box_along(best), straight = box_along(Vec2<T>(T(1), T(0)));
    return area(turned) <= area(straight) ? turned : straight;
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/map_rows.hpp ========
//
// How a projective technique ends: four rows that obey the light's law become one map that fills itself with what is
// seen, and whose depth reaches from the first caster that matters to the last receiver.
//
// warp.hpp and vdsm.hpp only choose the rows. With l the light, x.l = y.l = w.l = 0 and along.l = 1, so any
//
//   depth row = k along + c w + (a constant)          keeps the order along every light ray.
//
// Which one? Depth is divided by w, and w varies over the map. The constant is chosen so that the end that a depth
// buffer counts from lies at 0 for every w: depth = k (along - first) / w, or 1 - depth = k (last - along) / w where a
// sun's depth is reversed. k is the largest for which no receiver leaves [0, 1]. Then
//   24 bits: a step of the buffer is worth 2^-24 w / k, as fine as any depth row can have it where w is least;
//   float:   the stored value falls with 1 / w as the step does, so its relative precision makes up for it.
// In OpenGL's default depth range the value passes through [-1, 1] and that gain of float is lost.

namespace shadowmath {
inline namespace v0 {

// Rows of a map, RELATIVE TO THE EYE: dotted with (p - eye, 1).
template <class T>
struct MapRows {
    Vec4<T> x;
    Vec4<T> y;
    Vec4<T> w;
    Vec4<T> along;                                     // along . source = 1: grows with the light, in any unit
    Vec4<T> source;                                    // the light itself, homogeneous and relative to the eye
    bool parallel = true;                              // a sun: w is the same all along a light ray
    T along_floor = std::numeric_limits<T>::lowest();  // casters below are cut: keeps them off a spot's position
    T w_min = T(0);                                    // > 0; receivers at or below are not the map's
    T least_width = T(0);  // of the region, in units of x / w and y / w: one texel, when the receivers are a point
    bool crop = true;      // false: the region is [-1, 1]^2 as it is
};

// What every technique asks of its inputs. The map goes on only where `stop` says no.
template <class T>
struct Door {
    Faults faults;
    ViewVolume<T> view;  // with mended axes and a finite z_far
    Light<T> light;      // its direction of length 1 to the last bits
    bool stop = true;
};

template <class T>
[[nodiscard]] inline Door<T> door(ViewVolume<T> const& view, Light<T> const& light, Aabb<T> const& casters,
                                  Aabb<T> const& receivers, int map_size, T const& margin_texels) noexcept {
    Door<T> door;
    door.view = view;
    door.light = light;
    door.faults = faults_of(view) | faults_of(light) | faults_of_margin(map_size, margin_texels);
    if (!all_finite(casters) || !all_finite(receivers)) door.faults |= Fault::not_finite;
    Faults const fatal = Fault::not_finite | Fault::zero_light | Fault::empty_range | Fault::bad_frustum |
                         Fault::bad_pose | Fault::map_too_small;
    door.stop = (door.faults.bits & fatal.bits) != 0 || is_empty(casters) || is_empty(receivers);
    if (door.stop) return door;
    // No coordinate beyond it can be multiplied in a float; no scene has one.
    constexpr T farthest = T(1e12);
    auto const beyond = [](Vec3<T> const& p) {
        return !(std::abs(p.x) <= farthest && std::abs(p.y) <= farthest && std::abs(p.z) <= farthest);
    };
    if (beyond(view.pose.position) || beyond(light.position) || !(light.range <= farthest)) {
        door.faults |= Fault::precision_lost;
        door.stop = true;
        return door;
    }
    door.view.pose = orthonormalized(view.pose);
    door.light.direction = safe_normalize(light.direction).direction;
    if (is_positive_infinity(&view.z_far) || view.z_far > farthest) {
        T end = T(0);
        for (Vec3<T> const& corner : corners(receivers)) end = glm::max(end, eye_depth(door.view, corner));
        door.view.z_far = glm::min(end, farthest);
        door.faults |= Fault::far_clamped;
        door.stop = !(door.view.z_near < door.view.z_far);
    }
    // Nor one that is seen at its sides.
    if (!detail::sides_are_within(door.view, farthest)) {
        door.faults |= Fault::precision_lost;
        door.stop = true;
    }
    return door;
}

namespace detail {

template <class T>
[[nodiscard]] inline T value(Vec4<T> const& row, Vec3<T> const& point) noexcept {
    return glm::dot(Vec3<T>(row), point) + row.w;
}

// Least and largest of one number.
template <class T>
struct Extent {
    T lo = std::numeric_limits<T>::max();
    T hi = std::numeric_limits<T>::lowest();
    void add(T value) noexcept {
        lo = value < lo ? value : lo;
        hi = value > hi ? value : hi;
    }
};

// The casters in the shaft of light that the map sees, from the light down to `last`. Its sides stand out by what the
// farthest caster is rounded by, or one far above a narrow map would seem to lie beside it.
template <class T>
[[nodiscard]] inline ConvexBody<T> casters_in(MapRows<T> const& rows, Vec3<T> const& eye, Aabb<T> const& casters,
                                              T reach_metres, T last) noexcept {
    Aabb<T> const near_enough{Vec3<T>(-reach_metres), Vec3<T>(reach_metres)};
    Aabb<T> const box = intersect(Aabb<T>{casters.lo - eye, casters.hi - eye}, near_enough);
    if (is_empty(box)) return {};
    ConvexBody<T> shaft = convex_body(box);
    Vec4<T> const one(T(0), T(0), T(0), T(1));
    if (!rows.parallel) shaft = clipped(shaft, rows.along - one * rows.along_floor);
    shaft = clipped(shaft, one * last - rows.along);
    T const farthest = glm::length(glm::max(glm::abs(box.lo), glm::abs(box.hi))) + glm::length(eye);
    T const rounding = T(64) * std::numeric_limits<T>::epsilon() * farthest;
    for (Vec4<T> const& side : {rows.w - rows.x, rows.w + rows.x, rows.w - rows.y, rows.w + rows.y})
        shaft = clipped(shaft, side + one * (rounding * glm::length(Vec3<T>(side))));
    return clipped(shaft, rows.parallel ? rows.w - one * rows.w_min : rows.w);
}

}  // namespace detail

// Every vertex of `receivers` (relative to the eye) with w >= w_min lies inside the map, `margin_texels` from its
// sides, with stored depth in [0, 1]; so does every caster between it and the light; those of a sun as far as 1024
// times the receivers' distance from the eye. Farther ones need depth clamp. Not visible, and no fault: no receivers,
// or no caster above them. precision_lost: so far from the world's origin that the matrix moves by more than half a
// texel from one representable place to the next; rebase it (light_box.hpp), or use double.
template <class T>
[[nodiscard]] inline ShadowMap<T> map_from_rows(MapRows<T> rows, Vec3<T> const& eye, ConvexBody<T> const& receivers,
                                                Aabb<T> const& casters, int map_size, T margin_texels,
                                                ClipSpace clip) noexcept {
    constexpr T eps = std::numeric_limits<T>::epsilon();
    ShadowMap<T> map;
    map.clip = clip;
    if (receivers.edge_count == 0) return map;
    detail::Extent<T> x, y, w, along;
    T radius = T(0);
    for_each_vertex(receivers, [&](Vec3<T> const& p) {
        T const w_of_p = glm::max(detail::value(rows.w, p), rows.w_min);
        x.add(detail::value(rows.x, p) / w_of_p);
        y.add(detail::value(rows.y, p) / w_of_p);
        w.add(w_of_p);
        along.add(detail::value(rows.along, p));
        radius = glm::max(radius, glm::length(p));
    });
    Region<T> region;
    if (rows.crop) {
        // A side as thin as the rounding of its points is no side; 64: as many roundings stand behind a corner.
        T const steepest = glm::max(glm::length(Vec3<T>(rows.x)), glm::length(Vec3<T>(rows.y))) / w.lo;
        T const noise = T(64) * eps * (radius + glm::length(eye)) * steepest;
        region = widened(Region<T>{Vec2<T>(x.lo, y.lo), Vec2<T>(x.hi, y.hi)}, glm::max(rows.least_width, noise));
    }
    region = with_margin(region, map_size, glm::max(margin_texels, T(0)));
    // A narrow region magnifies what rounding has left of the light in a row; taken out once more, the law holds again.
    auto const zoom = [&rows](Vec4<T> const& row, T lo, T hi) {
        Vec4<T> const zoomed = row * (T(2) / (hi - lo)) - rows.w * ((hi + lo) / (hi - lo));
        return zoomed - rows.along * glm::dot(zoomed, rows.source);
    };
    rows.x = zoom(rows.x, region.lo.x, region.hi.x);
    rows.y = zoom(rows.y, region.lo.y, region.hi.y);

    T const to_light = rows.parallel ? T(0) : glm::length(Vec3<T>(rows.source));
    ConvexBody<T> const shaft = detail::casters_in(
        rows, eye, casters, T(1024) * radius + T(2) * to_light,
        along.hi + T(1e-3) * (along.hi - along.lo) + T(64) * eps * glm::max(std::abs(along.lo), std::abs(along.hi)));
    if (shaft.edge_count == 0) return map;
    for_each_vertex(shaft, [&](Vec3<T> const& p) { along.lo = glm::min(along.lo, detail::value(rows.along, p)); });
    // A thousandth of room at both ends, and a depth of at least some ulps where everything lies at one.
    T const room = (along.hi - along.lo) / T(1024) +
                   T(64) * eps * (glm::length(Vec3<T>(rows.along)) * radius + std::abs(rows.along.w));
    along.lo = glm::max(along.lo - room, rows.along_floor);
    along.hi += room;
    Vec4<T> const one(T(0), T(0), T(0), T(1));
    Vec4<T> depth;
    if (clip.depth == DepthOrder::one_to_zero && rows.parallel) {
        depth = rows.w - (one * along.hi - rows.along) * (w.lo / (along.hi - along.lo));
    } else {
        T deepest = T(0);
        for_each_vertex(receivers, [&](Vec3<T> const& p) {
            T const w_of_p = glm::max(detail::value(rows.w, p), rows.w_min);
            deepest = glm::max(deepest, (detail::value(rows.along, p) + room - along.lo) / w_of_p);
        });
        depth = (rows.along - one * along.lo) * (T(1) / deepest);
    }
    Mat4<T> const canonical_from_eye = from_rows(rows.x, rows.y, depth, rows.w);
    Mat4<T> const clip_from_world = rebased(clip_from_canonical<T>(clip) * canonical_from_eye, -eye);
    if (!all_finite(clip_from_world)) {
        map.faults = Fault::precision_lost;
        return map;
    }
    T const steepest = glm::max(glm::length(Vec3<T>(rows.x)), glm::length(Vec3<T>(rows.y))) / w.lo;
    if (eps * glm::length(eye) * steepest * T(map_size) > T(1)) map.faults |= Fault::precision_lost;
    map.clip_from_world = clip_from_world;
    map.w_min = rows.w_min;
    map.visible = true;
    return map;
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/tangent.hpp ========
//
// What a projective matrix does to a point and to the small piece of plane around it: the place after the division by
// w, and what that place gains for a metre along a direction. Footprint, bias and filter are all made of these two.
//
// With P = M p and a direction t, the derivative of P.xyz / P.w along t is (Mt.xyz - (P.xyz / P.w) Mt.w) / P.w.

namespace shadowmath {
inline namespace v0 {

// matrix * (point, 1) with its order of sums written out, so that a caster, its receiver, every build of GLM and the
// GLSL twin round alike.
template <class T>
[[nodiscard]] inline Vec4<T> transformed(Mat4<T> const& matrix, Vec3<T> const& point) noexcept {
    return matrix[0] * point.x + (matrix[1] * point.y + (matrix[2] * point.z + matrix[3]));
}

template <class T>
struct Projected {
    Vec3<T> at{T(0)};       // after the division
    T w = T(1);             // before it
    bool in_front = false;  // w exceeds w_min and 0, and `at` is finite; otherwise `at` is 0 and w is 1
};

// Finite for every matrix and point.
template <class T>
[[nodiscard]] inline Projected<T> projected(Mat4<T> const& matrix, Vec3<T> const& point, T w_min = T(0)) noexcept {
    if (!all_finite(matrix) || !all_finite(point)) return {};
    Vec4<T> const clip = transformed(matrix, point);
    if (!(clip.w > T(0)) || !(clip.w > w_min)) return {};
    Vec3<T> const at = Vec3<T>(clip) / clip.w;
    if (!all_finite(at) || !all_finite(&clip.w, 1)) return {};
    return {at, clip.w, true};
}

// The change of `at` for a metre along `direction`, to first order.
template <class T>
[[nodiscard]] inline Vec3<T> gain_along(Mat4<T> const& matrix, Projected<T> const& point,
                                        Vec3<T> const& direction) noexcept {
    Vec4<T> const clip = matrix[0] * direction.x + (matrix[1] * direction.y + matrix[2] * direction.z);
    return (Vec3<T>(clip) - point.at * clip.w) / point.w;
}

template <class T>
struct Tangents {
    Vec3<T> s{T(0)};  // unit, orthogonal to each other and to the normal; zero when `ok` is false
    Vec3<T> t{T(0)};
    bool ok = false;
};

// Two axes of the plane with this normal, of any length but zero.
template <class T>
[[nodiscard]] inline Tangents<T> tangents(Vec3<T> const& normal) noexcept {
    if (!all_finite(normal)) return {};
    Normalized<T> const unit = safe_normalize(normal);
    if (!unit.ok) return {};
    Vec3<T> const& n = unit.direction;
    Vec3<T> const aside = std::abs(n.x) < T(0.5) ? Vec3<T>(T(1), T(0), T(0)) : Vec3<T>(T(0), T(1), T(0));
    Vec3<T> const s = safe_normalize(glm::cross(n, aside)).direction;
    return {s, glm::cross(n, s), true};
}

// Within [-limit, limit] whatever a and b are: a / 0 is the limit with the sign of a, 0 / 0 is 0.
template <class T>
[[nodiscard]] inline T bounded_quotient(T a, T b, T limit) noexcept {
    if (a == T(0)) return T(0);
    if (std::abs(a) < limit * std::abs(b)) return a / b;
    return (a < T(0)) == (b < T(0)) ? limit : -limit;
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/footprint.hpp ========
//
// The one number: how many eye pixels one texel of a shadow map covers, at a point of a surface. It is measured from
// the two matrices alone, so it holds for any technique, this library's or another's, and for spots as for suns.
//
//   major <= 1   the map is as fine as the picture there, whatever the direction
//   minor > 1    blocks of minor x major pixels share one shadow sample
//
// On the tangent plane, J = d(eye pixels) / d(map texels) = A_eye * inverse(A_map), where the columns of A are what
// two tangents gain in pixels and in texels. The footprint is its two singular values. For what theory says of the
// whole view at once see aliasing.hpp.

namespace shadowmath {
inline namespace v0 {

template <class T>
struct Footprint {
    T major = T(0);  // eye pixels per texel along the axis where a texel is longest in the picture
    T minor = T(0);  // and across it; 0 <= minor <= major <= footprint_limit
};

// What a footprint is where no number of texels helps: the map sees the surface edge-on, or does not see it at all.
template <class T>
inline constexpr T footprint_limit = T(1e6);

// Eye pixels, as an area.
template <class T>
[[nodiscard]] inline T area(Footprint<T> const& footprint) noexcept {
    return footprint.major * footprint.minor;
}

// What a footprint of `major` pixels counts for where maps are compared: the pixels that come out wrong, as measured
// over many views. A texel of a pixel and a half is as good as any smaller one; from there on so many more are wrong,
// until a texel of some thirty pixels has lost the shadow, and larger ones lose no more.
template <class T>
[[nodiscard]] inline T price_of(T major) noexcept {
    constexpr T fine = T(1.4), lost = T(30);
    T const excess = major > fine ? major - fine : T(0), share = excess / lost;
    return T(0.1) * (major < fine ? major : fine) + excess / std::sqrt(T(1) + share * share);
}

// The same seen from the map: the axes, in texels, of one eye pixel. Above 1 the map is finer than the picture needs.
template <class T>
[[nodiscard]] inline Footprint<T> texels_per_pixel(Footprint<T> const& footprint) noexcept {
    return {bounded_quotient(T(1), footprint.minor, footprint_limit<T>),
            bounded_quotient(T(1), footprint.major, footprint_limit<T>)};
}

namespace detail {

// Columns of a 2x2 matrix over their largest entry, so that no product of two under- or overflows.
template <class T>
struct ScaledColumns {
    Vec2<T> s{T(0)};
    Vec2<T> t{T(0)};
    T scale = T(0);
};

template <class T>
[[nodiscard]] inline ScaledColumns<T> gains_on_plane(Mat4<T> const& matrix, Projected<T> const& point,
                                                     Tangents<T> const& plane, Vec2<T> const& half_size) noexcept {
    Vec2<T> const s = Vec2<T>(gain_along(matrix, point, plane.s)) * half_size;
    Vec2<T> const t = Vec2<T>(gain_along(matrix, point, plane.t)) * half_size;
    T scale = T(0);
    for (T const entry : {s.x, s.y, t.x, t.y}) scale = std::abs(entry) > scale ? std::abs(entry) : scale;
    if (!all_finite(s) || !all_finite(t) || !(scale > T(0))) return {};
    return {s / scale, t / scale, scale};
}

}  // namespace detail

// Exact on the tangent plane of `normal` (of any length and either sign) at `point`, both in world space.
// `eye_pixels` and `map_texels` are the sizes of picture and map. 0 where the eye does not see the point (w <= 0) and
// where something is not finite; footprint_limit where the map does not hold it, or sees the plane edge-on.
template <class T>
[[nodiscard]] inline Footprint<T> footprint(Mat4<T> const& eye_clip_from_world, Vec2<T> const& eye_pixels,
                                            Mat4<T> const& map_clip_from_world, T map_texels, Vec3<T> const& point,
                                            Vec3<T> const& normal) noexcept {
    Projected<T> const in_eye = projected(eye_clip_from_world, point);
    Tangents<T> const plane = tangents(normal);
    bool const sizes = all_finite(eye_pixels) && eye_pixels.x > T(0) && eye_pixels.y > T(0);
    if (!in_eye.in_front || !plane.ok || !sizes) return {};
    detail::ScaledColumns<T> const eye =
        detail::gains_on_plane(eye_clip_from_world, in_eye, plane, eye_pixels * T(0.5));
    if (!(eye.scale > T(0))) return {};

    constexpr T limit = footprint_limit<T>;
    Footprint<T> const unseen{limit, limit};
    Projected<T> const in_map = projected(map_clip_from_world, point);
    if (!in_map.in_front || !all_finite(&map_texels, 1) || !(map_texels > T(0))) return unseen;
    detail::ScaledColumns<T> const map =
        detail::gains_on_plane(map_clip_from_world, in_map, plane, Vec2<T>(map_texels * T(0.5)));
    if (!(map.scale > T(0))) return unseen;

    // J * det(map) = eye * adjugate(map). The larger singular value is a sum of lengths, so nothing cancels; the
    // smaller one follows from the determinant.
    T const map_det = map.s.x * map.t.y - map.s.y * map.t.x;
    T const eye_det = eye.s.x * eye.t.y - eye.s.y * eye.t.x;
    T const a = eye.s.x * map.t.y - eye.t.x * map.s.y, b = eye.t.x * map.s.x - eye.s.x * map.t.x;
    T const c = eye.s.y * map.t.y - eye.t.y * map.s.y, d = eye.t.y * map.s.x - eye.s.y * map.t.x;
    T const stretch = (detail::hypotenuse(a + d, c - b) + detail::hypotenuse(a - d, c + b)) * T(0.5);
    T const pixels_per_texel = bounded_quotient(eye.scale, map.scale, limit * limit);
    T const major = bounded_quotient(stretch * pixels_per_texel, std::abs(map_det), limit);
    T const minor = bounded_quotient(std::abs(eye_det) * pixels_per_texel, stretch, limit);
    return {major, minor < major ? minor : major};
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/cascade.hpp ========
//
// What cascades are: maps of one light, each with the depths that it serves, and what is asked of them. Values alone,
// for all that reads cascades (gpu.hpp, judge.hpp) or makes them in its own way (sdsm.hpp); cascades.hpp fits them.

namespace shadowmath {
inline namespace v0 {

// What each is good for: cascades.hpp.
enum class CascadeFit : std::uint8_t { stable, tight, rectangle, focus, warped };

template <class T>
struct CascadeOptions {
    int count = 4;        // maps, 1 to max_splits
    int map_size = 2048;  // texels along one side of each
    CascadeFit fit = CascadeFit::stable;
    int steady_maps = 0;       // so many of the nearest maps are stable, whatever `fit` says
    T warp_strength = T(1);    // of CascadeFit::warped: 1 the least aliasing along the view, 0 none; see warp_less
    T lambda = T(0.5);         // of the practical splits: 1 logarithmic, 0 uniform
    T first_split_end = T(0);  // metres of eye depth at which the first split ends; 0: wherever lambda puts it
    T shadow_distance = T(0);  // metres of eye depth up to which shadows are wanted; 0: the view's far distance
    T blend = T(0.1);          // fraction of each slice that fades into the next; 0: hard seams
    int filter_radius = 1;     // half width of the PCF kernel, texels: 0, 1 (3x3), 2 (5x5), ...
    bool pancake = false;      // true: near plane at the slice, and the renderer turns depth clamp ON
    ClipSpace clip = gl_clip;  // the convention of the pass that draws the maps
    std::array<T, max_splits> warp_less{};  // the share of warp_strength that each map goes without, [0, 1]
};

template <class T>
struct Cascade {
    ShadowMap<T> map;
    SliceRange<T> range;    // metres of eye depth that it serves
    T texel_metres = T(0);  // across the light; 0 of a spot or a warped map, whose texels grow with distance
    T depth_metres = T(0);  // along the light, from depth 0 to depth 1; 0 of those
};

template <class T>
struct Cascades {
    Cascade<T> at[max_splits];
    int count = 0;  // 0: nothing to draw, everything lit
    Faults faults;  // of the inputs, and of every map

    [[nodiscard]] Cascade<T> const* begin() const noexcept { return at; }
    [[nodiscard]] Cascade<T> const* end() const noexcept { return at + count; }
};

namespace detail {

// Texels: what is asked for, brought between none and a quarter of the map.
template <class T>
[[nodiscard]] inline int kernel_radius(CascadeOptions<T> const& options, Faults& faults) noexcept {
    int const quarter = options.map_size > 0 ? options.map_size / 4 : 0, most = quarter < 64 ? quarter : 64;
    int const radius = options.filter_radius < 0 ? 0 : (options.filter_radius > most ? most : options.filter_radius);
    if (radius != options.filter_radius) faults |= Fault::clamped_option;
    return radius;
}

}  // namespace detail
}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/sampling.hpp ========
//
// Which map a point is looked up in, and what its shadow does to its colour: what a receiver shader decides, on the
// CPU.
//
//   by_depth   the slice of the view that the point's eye depth falls into, fading into the next one. For cascades.
//   by_map     the first map that holds the point, kernel included. Maps stand in order of preference, so this is also
//              the order of fallback: a warp before the plain map that catches what the warp cannot see. With cascades
//              it uses the sharper map wherever maps overlap, at the cost of seams that move with the view.
//
// Outside everything is lit.

namespace shadowmath {
inline namespace v0 {

template <class T>
struct LookUp {
    int first = -1;   // map to read; -1: none, the point is lit
    int second = -1;  // map to fade into; -1 with blend > 0: into light
    T blend = T(0);   // share of the second, [0, 1]
};

// True when the map can answer for the point: w above w_min, at least `margin_texels` inside the four sides, and not
// beyond the map's far end. Nearer to the light than its near end it can: nothing that matters lies in between.
template <class T>
[[nodiscard]] inline bool contains(ShadowMap<T> const& map, int map_size, T margin_texels,
                                   Vec3<T> const& point) noexcept {
    Projected<T> const at = projected(map.clip_from_world, point, map.w_min);
    if (!map.visible || !at.in_front || map_size < 1 || !all_finite(&margin_texels, 1)) return false;
    T const side = T(1) - T(2) * margin_texels / T(map_size);
    bool const before_far_end = map.clip.depth == DepthOrder::one_to_zero ? at.at.z >= T(0) : at.at.z <= T(1);
    return at.at.x >= -side && at.at.x <= side && at.at.y >= -side && at.at.y <= side && before_far_end;
}

// The first of `count` ranges that ends beyond the eye depth. The index never decreases along a view ray, and
// visibility is continuous across a blend band.
template <class T>
[[nodiscard]] inline LookUp<T> by_depth(SliceRange<T> const* ranges, int count, T eye_depth) noexcept {
    SHADOWMATH_ASSERT(ranges != nullptr || count <= 0, "no ranges to choose from");
    if (!all_finite(&eye_depth, 1)) return {};
    for (int i = 0; i < count; ++i) {
        SliceRange<T> const& range = ranges[i];
        if (!(eye_depth < range.end)) continue;
        if (!(eye_depth > range.blend_begin)) return {i, -1, T(0)};
        int const next = i + 1 < count ? i + 1 : -1;
        return {i, next, (eye_depth - range.blend_begin) / (range.end - range.blend_begin)};
    }
    return {};
}

// The first of `count` maps that contains the point, or none. `margin_texels` is the kernel's reach: filter radius +
// 1.
template <class T>
[[nodiscard]] inline LookUp<T> by_map(ShadowMap<T> const* maps, int count, int map_size, T margin_texels,
                                      Vec3<T> const& point) noexcept {
    SHADOWMATH_ASSERT(maps != nullptr || count <= 0, "no maps to choose from");
    for (int i = 0; i < count; ++i)
        if (contains(maps[i], map_size, margin_texels, point)) return {i, -1, T(0)};
    return {};
}

// Visibility of the two maps of a look-up, mixed; pass 1 for a map that is -1.
template <class T>
[[nodiscard]] constexpr T blended(LookUp<T> const& look_up, T first_visibility, T second_visibility) noexcept {
    return first_visibility * (T(1) - look_up.blend) + second_visibility * look_up.blend;
}

// Light that is let through takes part in diffuse and specular, never in ambient; albedo tints all three (Kwon 2002,
// section 4.4). Linear colours; `visibility` 0 to 1.
template <class T>
[[nodiscard]] inline Vec3<T> shade(Vec3<T> const& ambient, Vec3<T> const& diffuse, Vec3<T> const& specular,
                                   T visibility, Vec3<T> const& albedo) noexcept {
    return (ambient + (diffuse + specular) * visibility) * albedo;
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/judge.hpp ========
//
// What a set of cascades is worth, measured: the footprint at points that the eye sees, each in the map that serves it.
// For showing to a user, for tests of a renderer's own maps, and for choose.hpp.
//
// Points come from the renderer (a depth buffer read back, with its normals) or from receivers' bounds alone, where no
// surface is known (samples_in). There each point gets the neutral normal, which leans as far from the eye as from the
// light: the footprint is then perspective aliasing alone, the part that a fit can do something about.

namespace shadowmath {
inline namespace v0 {

template <class T>
struct SurfacePoint {
    Vec3<T> point{T(0)};   // world
    Vec3<T> normal{T(0)};  // world, of any length
};

inline constexpr int max_samples = 256;

template <class T>
struct Samples {
    std::array<SurfacePoint<T>, max_samples> at;
    int count = 0;
};

// Equally far from the eye and the light in angle; toward the eye where the two are opposite.
template <class T>
[[nodiscard]] inline Vec3<T> neutral_normal(ViewVolume<T> const& view, Light<T> const& light,
                                            Vec3<T> const& point) noexcept {
    bool const flat = view.kind == ViewKind::orthographic;
    Vec3<T> const to_eye = flat ? -view.pose.forward : safe_normalize(view.pose.position - point).direction;
    Normalized<T> const half = safe_normalize(to_eye + toward(light, point));
    return half.length > T(1e-3) ? half.direction : to_eye;
}

// Where a ray of the view is inside a box.
template <class T>
struct DepthSpan {
    T first = T(0);  // eye depth
    T last = T(-1);  // below first: it misses
};

// The ray through (side_x, side_y) of the view's sides, between its near and far ends.
template <class T>
[[nodiscard]] inline DepthSpan<T> depths_in_box(ViewVolume<T> const& view, T side_x, T side_y,
                                                Aabb<T> const& box) noexcept {
    Vec3<T> const start = point_at(view, side_x, side_y, view.z_near);
    Vec3<T> const way = point_at(view, side_x, side_y, view.z_far) - start;
    T first = T(0), last = T(1);  // of the way
    for (int axis = 0; axis < 3; ++axis) {
        T const to_lo = box.lo[axis] - start[axis], to_hi = box.hi[axis] - start[axis];
        if (std::abs(way[axis]) > T(0)) {
            T const a = to_lo / way[axis], b = to_hi / way[axis];
            first = std::fmax(first, std::fmin(a, b));
            last = std::fmin(last, std::fmax(a, b));
        } else if (to_lo > T(0) || to_hi < T(0)) {
            return {};
        }
    }
    T const range = view.z_far - view.z_near;
    return first <= last ? DepthSpan<T>{view.z_near + first * range, view.z_near + last * range} : DepthSpan<T>{};
}

namespace detail {

// Where the ray through the middle of cell `ray`, of `across` by `up` that divide the picture, meets the view's sides.
template <class T>
[[nodiscard]] inline Vec2<T> side_of_ray(ViewVolume<T> const& view, int ray, int across, int up) noexcept {
    T const x = (T(ray % across) + T(0.5)) / T(across), y = (T(ray / across) + T(0.5)) / T(up);
    return {view.left + (view.right - view.left) * x, view.bottom + (view.top - view.bottom) * y};
}

}  // namespace detail

// Points inside the box as the eye sees it: on a grid of eight by eight rays, four on each, evenly over the orders of
// depth from where the ray enters to where it leaves; one where the box is a surface. None of a view with faults, or
// without an end.
template <class T>
[[nodiscard]] inline Samples<T> samples_in(ViewVolume<T> const& view, Light<T> const& light,
                                           Aabb<T> const& receivers) noexcept {
    Samples<T> samples;
    if (faults_of(view).any() || is_positive_infinity(&view.z_far) || unusable(light) || !all_finite(receivers) ||
        is_empty(receivers))
        return samples;
    constexpr int rays = 8, on_each = 4;
    for (int ray = 0; ray < rays * rays; ++ray) {
        Vec2<T> const side = detail::side_of_ray(view, ray, rays, rays);
        DepthSpan<T> const inside = depths_in_box(view, side.x, side.y, receivers);
        if (!(inside.first <= inside.last)) continue;
        T const begin = inside.first, end = inside.last;
        T const floor = std::fmax(begin, end * T(1e-6)), ratio = end / floor;
        int const count = ratio > T(1.001) ? on_each : 1;
        for (int i = 0; i < count; ++i) {
            T const depth = floor * std::pow(ratio, (T(i) + T(0.5)) / T(count));
            Vec3<T> const point = point_at(view, side.x, side.y, depth);
            if (!all_finite(point)) continue;
            samples.at[static_cast<std::size_t>(samples.count++)] = {point, neutral_normal(view, light, point)};
        }
    }
    return samples;
}

template <class T>
struct Worth {
    T worst = T(0);    // eye pixels per texel along the longer axis of the footprint, at the worst point
    T mean = T(0);     // of all points
    T price = T(0);    // the mean of price_of
    int count = 0;     // points
    int unserved = 0;  // of them: no map holds them; they count as footprint_limit
};

template <class T>
struct Judgement {
    Worth<T> all;
    std::array<Worth<T>, max_splits> map;  // of each cascade, over the points at its depths
};

// Each point is judged in the first map whose range holds its depth. Points that the eye does not see (w <= 0) and
// those behind the last range are left out. `eye_pixels`: the size of the picture.
template <class T>
[[nodiscard]] inline Judgement<T> judge(Cascades<T> const& cascades, int map_size, ViewVolume<T> const& view,
                                        Vec2<T> const& eye_pixels, SurfacePoint<T> const* samples,
                                        int sample_count) noexcept {
    SHADOWMATH_ASSERT(samples != nullptr || sample_count <= 0, "judge needs its samples");
    Judgement<T> judgement;
    Mat4<T> const eye = clip_from_world(view, ClipSpace{});
    auto const take = [](Worth<T>& worth, T major) {
        worth.worst = std::fmax(worth.worst, major);
        worth.mean += major;  // sums until the end
        worth.price += price_of(major);
        worth.unserved += major >= footprint_limit<T> ? 1 : 0;
        ++worth.count;
    };
    for (int i = 0; i < sample_count; ++i) {
        SurfacePoint<T> const& sample = samples[i];
        if (!all_finite(sample.point)) continue;
        T const depth = eye_depth(view, sample.point);
        for (int c = 0; c < cascades.count; ++c) {
            Cascade<T> const& cascade = cascades.at[c];
            if (!(depth <= cascade.range.end)) continue;
            T major = footprint_limit<T>;
            // Half a texel for the rounding of points on the map's very side.
            if (contains(cascade.map, map_size, T(-0.5), sample.point)) {
                Footprint<T> const measured =
                    footprint(eye, eye_pixels, cascade.map.clip_from_world, T(map_size), sample.point, sample.normal);
                major = measured.major;
            }
            if (!(major > T(0))) break;
            take(judgement.all, major);
            take(judgement.map[static_cast<std::size_t>(c)], major);
            break;
        }
    }
    auto const close = [](Worth<T>& worth) {
        T const count = T(worth.count > 0 ? worth.count : 1);
        worth.mean /= count;
        worth.price /= count;
    };
    close(judgement.all);
    for (Worth<T>& worth : judgement.map) close(worth);
    return judgement;
}

// Of one map over all the points, whatever their depth.
template <class T>
[[nodiscard]] inline Worth<T> worth_of(ShadowMap<T> const& map, int map_size, ViewVolume<T> const& view,
                                       Vec2<T> const& eye_pixels, SurfacePoint<T> const* samples,
                                       int sample_count) noexcept {
    Cascades<T> alone;
    alone.count = 1;
    alone.at[0].map = map;
    alone.at[0].range.end = std::numeric_limits<T>::max();
    return judge(alone, map_size, view, eye_pixels, samples, sample_count).all;
}

// Whether a map drawn for an earlier view will do for this one: no point has lost its map, and the worst texel is at
// most `factor` times as large as when the map was drawn, or at most `factor` pixels. As long as light and casters are
// what they were its shadows are right in any case; this is about their edges alone.
template <class T>
[[nodiscard]] inline bool still_good(Worth<T> const& drawn, Worth<T> const& now, T factor = T(1.5)) noexcept {
    T const before = drawn.worst > T(1) ? drawn.worst : T(1);
    return now.unserved <= drawn.unserved && now.worst <= before * factor;
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/vdsm.hpp ========
//
// View-dependent shadow map: slide everything along the light onto a shadow plane, look at that from the EYE, keep the
// light's depth. On the plane, a texel covers the same number of eye pixels from the nearest point to the farthest.
//
//   light \   \   \                 One linear map: Q ~ (I - l pi^T / (pi.l)) P. With E the eye's matrix,
//          P   \   \       eye
//           \   \   \     /           M = [ E_x Pi ; E_y Pi ; depth ; E_w Pi ]
//     _______Q___Q___Q___/____ pi
//                                   is an ordinary 4x4, for suns and spots alike.
//
// Use it where most receivers lie near one plane: ground, water, a floor. Not for towers: a receiver well above the
// plane may be seen from the plane point BEHIND the eye that its light ray meets (w <= 0). Such receivers are not the
// map's; test receiver_valid, and light them by a second map.
//
// Source: T. Kwon, "View-dependent Shadow Maps Using Projective Geometry" (in Korean), Seoul National University, 2002;
// the relation to Chong and Gortler 2004: same x, y and w, another depth row. Departures: spots as well as suns; w is
// NOT always positive; the depth row is scaled, since as printed everything projected nearer than one unit is lost to
// the far plane, and measured from the plane, so that it spans the heights of a scene instead of its extent.

namespace shadowmath {
inline namespace v0 {

// The points p with normal . p + offset = 0. Neither length nor sign of the normal matters.
template <class T>
struct ShadowPlane {
    Vec3<T> normal{T(0), T(1), T(0)};
    T offset = T(0);
};

template <class T>
[[nodiscard]] inline ShadowPlane<T> plane_through(Vec3<T> const& point, Vec3<T> const& normal) noexcept {
    Vec3<T> const unit = safe_normalize(normal).direction;
    return {unit, -glm::dot(unit, point)};
}

// The thesis' choice: parallel to the ground, at the middle height of what is to receive shadows. An empty box gives
// the ground through the origin.
template <class T>
[[nodiscard]] inline ShadowPlane<T> mean_height_plane(Aabb<T> const& receivers, Vec3<T> const& ground_normal) noexcept {
    Vec3<T> const middle = is_empty(receivers) ? Vec3<T>(T(0)) : receivers.lo / T(2) + receivers.hi / T(2);
    return plane_through(middle, ground_normal);
}

// Moves points along the rays of the light onto the plane: Pi = I - l pi^T / (pi . l), so that Pi Pi = Pi and Pi l = 0.
// Signs and lengths of the plane and of `homogeneous_light` do not matter, and w stays 1 for a sun; for a spot it is
// the point's height below the light in heights of the light. The identity where the plane contains the light, or an
// input is not finite.
template <class T>
[[nodiscard]] inline Mat4<T> plane_projection(ShadowPlane<T> const& plane, Vec4<T> const& homogeneous_light) noexcept {
    if (!all_finite(plane.normal) || !all_finite(&plane.offset, 1) || !all_finite(homogeneous_light))
        return Mat4<T>(T(1));
    // Over its largest coordinate, each is as good as before and no product over- or underflows.
    auto const scaled = [](Vec4<T> const& v) {
        T const largest = glm::max(glm::max(std::abs(v.x), std::abs(v.y)), glm::max(std::abs(v.z), std::abs(v.w)));
        return largest > T(0) ? Vec4<T>(v.x / largest, v.y / largest, v.z / largest, v.w / largest) : v;
    };
    Vec4<T> const pi = scaled(Vec4<T>(plane.normal, plane.offset)), light = scaled(homogeneous_light);
    T const height = glm::dot(pi, light);
    if (!(std::abs(height) > T(1e-30))) return Mat4<T>(T(1));
    return Mat4<T>(T(1)) - glm::outerProduct(light, pi / height);
}

template <class T>
struct VdsmOptions {
    int map_size = 1024;
    T margin_texels = T(2);  // of the map kept free on each side, for the filter
    bool crop = true;        // zoom in on what the receivers need; false: the whole screen, as it is
    T w_min = T(0);          // metres of eye depth ON THE PLANE below which receivers are not the map's; 0: z_near
    T reach = T(2);          // how far beyond the screen the map goes, in half screens: receivers off the plane may
                             // project there; those beyond are not the map's. >= 1
    T least_sine = T(0.05);  // of the angle between the plane and a sun, or an orthographic view: below it,
                             // invalid_plane. >= 1e-3
};

// One map for what the view sees of the receivers, except those with w at or below `w_min`, or more than `reach` half
// screens out: near the eye's own depth a single such point would take the whole map. Everything on the plane and in
// view is the map's. Casters are drawn as they are; hardware clips those with w <= 0, of which no receiver here knows.
//
// invalid_plane, not visible: the plane has no normal, contains the light (least_sine; spots: 1e-4 of z_far), or
// passes the eye closer than 1e-4 of z_far (an orthographic eye: least_sine), or beyond 1e12 m. Then use a fit. Casters
// in the last 1/1024 of the way to a spot are cut.
template <class T>
[[nodiscard]] inline ShadowMap<T> view_dependent_map(ViewVolume<T> const& view, Light<T> const& light,
                                                     ShadowPlane<T> const& plane, Aabb<T> const& casters,
                                                     Aabb<T> const& receivers, VdsmOptions<T> const& options,
                                                     ClipSpace clip) noexcept {
    ShadowMap<T> map;
    map.clip = clip;
    Door<T> const in = door(view, light, casters, receivers, options.map_size, options.margin_texels);
    map.faults = in.faults;
    if (!all_finite(plane.normal) || !all_finite(&plane.offset, 1) || !all_finite(&options.w_min, 1) ||
        !all_finite(&options.reach, 1) || !all_finite(&options.least_sine, 1)) {
        map.faults |= Fault::not_finite;
        return map;
    }
    Normalized<T> const normal = safe_normalize(plane.normal);
    if (!normal.ok) map.faults |= Fault::invalid_plane;
    if (!normal.ok || in.stop) return map;
    T const least_sine = glm::max(options.least_sine, T(1e-3));
    if (!(options.reach >= T(1)) || options.w_min < T(0) || least_sine != options.least_sine)
        map.faults |= Fault::clamped_option;

    // All relative to the eye: there the plane is known to the last bit of the eye's height.
    ViewVolume<T> eye = in.view;
    Vec3<T> const origin = eye.pose.position;
    eye.pose.position = Vec3<T>(T(0));
    Light<T> const& lamp = in.light;
    bool const sun = lamp.kind == LightKind::directional;
    Vec4<T> const source = sun ? Vec4<T>(lamp.direction, T(0)) : Vec4<T>(origin - lamp.position, T(-1));
    Vec4<T> const pi(normal.direction, glm::dot(normal.direction, origin) + plane.offset / normal.length);
    if (!(std::abs(pi.w) <= T(1e12))) {
        map.faults |= Fault::invalid_plane;
        return map;
    }
    T const height_of_light = glm::dot(pi, source);
    T const least_height = T(1e-4) * eye.z_far;
    // An orthographic eye lies at infinity, against its viewing direction.
    bool const flat = eye.kind == ViewKind::orthographic;
    T const height_of_eye = flat ? glm::dot(normal.direction, eye.pose.forward) : pi.w;
    if (!(std::abs(height_of_eye) >= (flat ? least_sine : least_height)) ||
        !(std::abs(height_of_light) >= (sun ? least_sine : least_height))) {
        map.faults |= Fault::invalid_plane;
        return map;
    }
    // Signed distance from the plane, in light vectors: 0 on it, -1 at a spot. A row of Pi is then E - (E . l) along.
    Vec4<T> const along = pi / height_of_light;
    Mat4<T> const screen = clip_from_world(eye, ClipSpace{});
    auto const slid = [&](int r) { return row(screen, r) - along * glm::dot(row(screen, r), source); };
    MapRows<T> rows;
    rows.x = slid(0);
    rows.y = slid(1);
    rows.w = slid(3);
    rows.along = along;
    rows.source = source;
    rows.parallel = sun;
    constexpr T nearest = T(1) / T(1024);  // the nearest caster to a spot, as a part of the spot's height
    if (!sun) rows.along_floor = nearest - T(1);
    rows.w_min = flat ? nearest : eye.z_near;
    if (!(rows.w_min > T(0))) {
        rows.w_min = eye.z_far / T(1 << 20);
        map.faults |= Fault::near_clamped;
    }
    if (options.w_min > T(0)) rows.w_min = glm::max(options.w_min, rows.w_min / T(1024));
    rows.least_width = T(2) / T(options.map_size);
    rows.crop = options.crop;

    ConvexBody<T> body = visible_body(in.view, receivers);
    Vec4<T> const one(T(0), T(0), T(0), T(1));
    if (!sun) {
        body = clipped(body, along - one * rows.along_floor);
        // The pyramid around the cone: beyond it nothing is lit.
        LightBasis<T> const axes = light_basis(lamp.direction);
        T const slope = std::tan(lamp.half_angle_radians);
        for (Vec3<T> const& side : {axes.x, -axes.x, axes.y, -axes.y}) {
            Vec3<T> const inward = safe_normalize(axes.depth * slope - side).direction;
            body = clipped(body, Vec4<T>(inward, glm::dot(inward, Vec3<T>(source))));
        }
        body = clipped(body, Vec4<T>(-axes.depth, lamp.range - glm::dot(axes.depth, Vec3<T>(source))));
    }
    body = clipped(body, rows.w - one * rows.w_min);
    // What lies beyond the reach takes no part: neither in the region nor in the scale of depth.
    Vec4<T> const edge = rows.w * (options.crop ? glm::max(options.reach, T(1)) : T(1));
    for (Vec4<T> const& side : {edge - rows.x, edge + rows.x, edge - rows.y, edge + rows.y}) body = clipped(body, side);
    Faults const before = map.faults;
    map = map_from_rows(rows, origin, body, casters, options.map_size, options.margin_texels, clip);
    map.faults |= before;
    return map;
}

// Whether the map can answer for a receiver at all; where it can, the usual test of its sides still applies.
template <class T>
[[nodiscard]] inline bool receiver_valid(ShadowMap<T> const& map, Vec3<T> const& point) noexcept {
    return map.visible && glm::dot(row(map.clip_from_world, 3), Vec4<T>(point, T(1))) > map.w_min;
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/plane_choice.hpp ========
//
// Which plane a view-dependent map should be drawn on, from the surfaces that the eye sees. Judged by one number: how
// far the map's texels are from the picture's pixels, as the mean square of the logarithms of the footprint's axes. 0
// is one texel a pixel everywhere, 0.48 twice too long along one axis.
//
//   median height    parallel to the ground, half of what is seen above it: the thesis' choice, made of points; and
//                    with each point's weight that of its pixels, so that the far does not outvote the near
//   least squares    through the points as they lie: slopes, walls
//   least distortion the best of these, moved along its normal until the number is least
//
// A plane that changes makes shadows jump: the one of the last frame is kept until another is better by a tenth.
//
// Source: Kwon 2002 names the problem and the mean height; the rest is derived here.

namespace shadowmath {
inline namespace v0 {

template <class T>
struct PlaneChoice {
    ShadowPlane<T> plane;
    T distortion = T(0);   // of this plane
    bool kept = false;     // it is the previous one
    bool visible = false;  // false: no samples, or no plane that serves any of them
};

namespace detail {

// The direction in which a symmetric matrix (xx, yy, zz; xy, yz, zx) is least; zero where two are least alike.
template <class T>
[[nodiscard]] inline Vec3<T> least_eigenvector(Vec3<T> const& square, Vec3<T> const& mixed) noexcept {
    // By the trigonometric formula for the roots, about the mean of the diagonal.
    T const mean = (square.x + square.y + square.z) / T(3);
    Vec3<T> const off = square - mean;
    T const spread = std::sqrt((glm::dot(off, off) + T(2) * glm::dot(mixed, mixed)) / T(6));
    if (!(spread > T(0))) return Vec3<T>(T(0));
    Vec3<T> const d = off / spread, m = mixed / spread;
    T const half_det =
        (d.x * (d.y * d.z - m.y * m.y) - m.x * (m.x * d.z - m.y * m.z) + m.z * (m.x * m.y - d.y * m.z)) / T(2);
    constexpr T third_of_a_turn = T(2.09439510239319549230842892218633526L);
    T const root = T(2) * std::cos(std::acos(glm::clamp(half_det, T(-1), T(1))) / T(3) + third_of_a_turn);
    // The rows of what is left over are all across the eigenvector.
    Vec3<T> const x(d.x - root, m.x, m.z), y(m.x, d.y - root, m.y), z(m.z, m.y, d.z - root);
    Vec3<T> best(T(0));
    for (Vec3<T> const& across : {glm::cross(x, y), glm::cross(y, z), glm::cross(z, x)})
        if (glm::dot(across, across) > glm::dot(best, best)) best = across;
    return glm::dot(best, best) > T(1e-8) ? safe_normalize(best).direction : Vec3<T>(T(0));
}

}  // namespace detail

// Least sum of squared distances, each over the square of the point's eye depth, so that the far does not outvote the
// near. Its normal is on the side of the eye. A normal of 0: fewer than three points, or all on one line.
template <class T>
[[nodiscard]] inline ShadowPlane<T> least_squares_plane(ViewVolume<T> const& view, SurfacePoint<T> const* samples,
                                                        int sample_count) noexcept {
    SHADOWMATH_ASSERT(samples != nullptr || sample_count <= 0, "a plane needs its samples");
    Vec3<T> const eye = view.pose.position;
    auto const weighted_sum = [&](auto const& add) {
        T total = T(0);
        for (int i = 0; i < sample_count; ++i) {
            Vec3<T> const p = samples[i].point - eye;
            T const depth = glm::dot(p, view.pose.forward);
            if (!all_finite(samples[i].point) || !(depth > T(0)) || !(depth < T(1e9))) continue;
            T const weight = T(1) / std::fmax(depth * depth, T(1e-12));
            total += weight;
            add(p, weight);
        }
        return total;
    };
    Vec3<T> middle(T(0)), square(T(0)), mixed(T(0));
    T const total = weighted_sum([&](Vec3<T> const& p, T weight) { middle += p * weight; });
    if (!(total > T(0))) return {Vec3<T>(T(0)), T(0)};
    middle /= total;
    weighted_sum([&](Vec3<T> const& p, T weight) {
        Vec3<T> const q = p - middle;
        square += q * q * weight;
        mixed += Vec3<T>(q.x * q.y, q.y * q.z, q.z * q.x) * weight;
    });
    Vec3<T> normal = detail::least_eigenvector(square / total, mixed / total);
    if (glm::dot(normal, middle) > T(0)) normal = -normal;
    return {normal, -glm::dot(normal, middle + eye)};
}

// Across `normal`, with half of the points above it and half below; of more than max_samples points every so many-th is
// looked at. A normal of 0 comes back as it is, and so does one without points, through the origin.
template <class T>
[[nodiscard]] inline ShadowPlane<T> median_plane(Vec3<T> const& normal, SurfacePoint<T> const* samples,
                                                 int sample_count) noexcept {
    SHADOWMATH_ASSERT(samples != nullptr || sample_count <= 0, "a plane needs its samples");
    Vec3<T> const unit = safe_normalize(normal).direction;
    std::array<T, max_samples> height;
    std::size_t count = 0;
    int const stride = (sample_count + max_samples - 1) / max_samples;
    for (int i = 0; i < sample_count; i += stride) {
        if (!all_finite(samples[i].point)) continue;
        T const h = glm::dot(unit, samples[i].point);
        std::size_t at = count++;
        for (; at > 0 && height[at - 1] > h; --at) height[at] = height[at - 1];
        height[at] = h;
    }
    return {unit, count > 0 ? -height[count / 2] : T(0)};
}

// Across `normal`, with half of the weight on either side: one over the square of a point's eye depth, as for
// least_squares_plane. Points behind the eye have none. Otherwise as median_plane.
template <class T>
[[nodiscard]] inline ShadowPlane<T> weighted_median_plane(ViewVolume<T> const& view, Vec3<T> const& normal,
                                                          SurfacePoint<T> const* samples, int sample_count) noexcept {
    SHADOWMATH_ASSERT(samples != nullptr || sample_count <= 0, "a plane needs its samples");
    Vec3<T> const unit = safe_normalize(normal).direction;
    std::array<T, max_samples> height, weight;
    std::size_t count = 0;
    T total = T(0);
    int const stride = (sample_count + max_samples - 1) / max_samples;
    for (int i = 0; i < sample_count; i += stride) {
        T const depth = eye_depth(view, samples[i].point);
        if (!all_finite(samples[i].point) || !(depth > T(0)) || !(depth < T(1e9))) continue;
        T const h = glm::dot(unit, samples[i].point), w = T(1) / std::fmax(depth * depth, T(1e-12));
        std::size_t at = count++;
        for (; at > 0 && height[at - 1] > h; --at) {
            height[at] = height[at - 1];
            weight[at] = weight[at - 1];
        }
        height[at] = h;
        weight[at] = w;
        total += w;
    }
    T below = T(0);
    for (std::size_t i = 0; i < count; ++i) {
        below += weight[i];
        if (below * T(2) >= total) return {unit, -height[i]};
    }
    return {unit, T(0)};
}

// Mean square of ln(major) and ln(minor) over the samples, of a map of as many texels as the picture has pixels, before
// any crop. Points that the plane cannot serve count as footprint_limit. The largest number where nothing is served, or
// the plane is none.
template <class T>
[[nodiscard]] inline T plane_distortion(ShadowPlane<T> const& plane, ViewVolume<T> const& view, Light<T> const& light,
                                        SurfacePoint<T> const* samples, int sample_count) noexcept {
    SHADOWMATH_ASSERT(samples != nullptr || sample_count <= 0, "a plane needs its samples");
    T const worst = std::numeric_limits<T>::max();
    Mat4<T> const eye = clip_from_world(view, ClipSpace{});
    Mat4<T> const slid = plane_projection(plane, homogeneous(light));
    if (slid == Mat4<T>(T(1)) || !all_finite(slid)) return worst;
    Mat4<T> const map = eye * slid;
    T sum = T(0);
    int count = 0, served = 0;
    for (int i = 0; i < sample_count; ++i) {
        Footprint<T> const f = footprint(eye, Vec2<T>(T(1000)), map, T(1000), samples[i].point, samples[i].normal);
        if (!(f.major > T(0))) continue;
        T const along = std::log(f.major), across = std::log(std::fmax(f.minor, T(1) / footprint_limit<T>));
        sum += along * along + across * across;
        served += f.major < footprint_limit<T> ? 1 : 0;
        ++count;
    }
    return served > 0 ? sum / T(count) : worst;
}

// The plane of least distortion among: across `ground_normal` at the two median heights, the least squares, and the
// best one's parallels between the points, to a hundredth of their height. `previous`, if not null, is kept while no
// other has less than 1 - `hysteresis` times its distortion.
template <class T>
[[nodiscard]] inline PlaneChoice<T> choose_plane(ViewVolume<T> const& view, Light<T> const& light,
                                                 SurfacePoint<T> const* samples, int sample_count,
                                                 Vec3<T> const& ground_normal, ShadowPlane<T> const* previous = nullptr,
                                                 T hysteresis = T(0.1)) noexcept {
    PlaneChoice<T> best;
    best.distortion = std::numeric_limits<T>::max();
    if (unusable(light) || faults_of(view).any()) return best;
    auto const consider = [&](ShadowPlane<T> const& plane) {
        T const distortion = plane_distortion(plane, view, light, samples, sample_count);
        if (!(distortion < best.distortion)) return;
        best = {plane, distortion, false, true};
    };
    consider(median_plane(ground_normal, samples, sample_count));
    consider(weighted_median_plane(view, ground_normal, samples, sample_count));
    consider(least_squares_plane(view, samples, sample_count));
    if (best.visible) {
        Vec3<T> const normal = best.plane.normal;
        T lo = std::numeric_limits<T>::max(), hi = std::numeric_limits<T>::lowest();
        for (int i = 0; i < sample_count; ++i) {
            if (!all_finite(samples[i].point)) continue;
            lo = std::fmin(lo, glm::dot(normal, samples[i].point));
            hi = std::fmax(hi, glm::dot(normal, samples[i].point));
        }
        for (int round = 0; round < 3 && lo < hi; ++round) {
            constexpr int steps = 8;
            T const step = (hi - lo) / T(steps);
            for (int i = 0; i <= steps; ++i) consider({normal, -(lo + step * T(i))});
            T const height = -best.plane.offset;
            lo = height - step;
            hi = height + step;
        }
    }
    if (previous == nullptr || !all_finite(previous->normal) || !all_finite(&previous->offset, 1)) return best;
    T const kept = plane_distortion(*previous, view, light, samples, sample_count);
    T const share = all_finite(&hysteresis, 1) ? glm::clamp(T(1) - hysteresis, T(0), T(1)) : T(1);
    if (kept < std::numeric_limits<T>::max() && !(best.visible && best.distortion < kept * share))
        best = {*previous, kept, true, true};
    return best;
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/plane_set.hpp ========
//
// Several shadow planes for one view: floor and wall, street and roofs. Each becomes a view-dependent map of its own
// (view_dependent_map), in this order; behind them stands a map that serves what none of them does, cascades or one
// uniform map. by_footprint chooses between them point by point.
//
// The dominant plane is the one on which most of what is seen gets good texels. Candidates are the tangent planes of
// the samples: a compromise between floor and wall serves neither, and least squares finds nothing else. What the plane
// serves well is then taken out, and the next one is chosen for the rest, as long as that is worth a map.
//
// Source: the thesis (Kwon 2002) names several planes as future work; Chong and Gortler 2004 draw floor and wall by two
// maps. The choice is derived here. For one plane of least distortion over all that is seen see plane_choice.hpp.

namespace shadowmath {
inline namespace v0 {

inline constexpr int max_planes = 4;

template <class T>
struct PlaneSet {
    std::array<ShadowPlane<T>, max_planes> at;
    std::array<T, max_planes> share{};  // of the samples that each serves well and none before it does
    int count = 0;                      // 0: no plane is worth a map; use cascades
};

template <class T>
struct PlaneSetOptions {
    int most = 2;             // planes, 1 to max_planes
    T good_pixels = T(2);     // a texel's longer axis up to which a sample counts as well served, of a map with as many
                              // texels as the picture has pixels; > 1
    T least_share = T(0.15);  // of the samples that a plane must serve to be worth a map, (0, 1]
    T hysteresis = T(0.1);    // planes of the last frame stay until another serves so much more
};

namespace detail {

// How many of the samples a map on this plane serves well; `left`, if not null, gets those that it does not.
template <class T>
[[nodiscard]] inline int well_served(ShadowPlane<T> const& plane, Mat4<T> const& eye, Light<T> const& light,
                                     Samples<T> const& samples, T good_pixels, Samples<T>* left = nullptr) noexcept {
    Mat4<T> const slid = plane_projection(plane, homogeneous(light));
    bool const usable = slid != Mat4<T>(T(1)) && all_finite(slid);
    Mat4<T> const map = eye * slid;
    int served = 0;
    for (int i = 0; i < samples.count; ++i) {
        SurfacePoint<T> const& sample = samples.at[static_cast<std::size_t>(i)];
        T const major =
            usable ? footprint(eye, Vec2<T>(T(1000)), map, T(1000), sample.point, sample.normal).major : T(0);
        if (major > T(0) && major <= good_pixels)
            ++served;
        else if (left != nullptr)
            left->at[static_cast<std::size_t>(left->count++)] = sample;
    }
    return served;
}

}  // namespace detail

// Each plane serves more of what the ones before it leave over than any sample's tangent plane does, or is one of the
// last frame's within the hysteresis. Samples that nobody sees or that the light does not reach take no part; of more
// than max_samples every so-many-th is looked at. After at most most * (max_samples + max_planes) looks at all samples;
// for now and then, not for every frame of a small budget.
template <class T>
[[nodiscard]] inline PlaneSet<T> choose_planes(ViewVolume<T> const& view, Light<T> const& light,
                                               SurfacePoint<T> const* samples, int sample_count,
                                               PlaneSetOptions<T> const& options = {},
                                               PlaneSet<T> const* previous = nullptr) noexcept {
    SHADOWMATH_ASSERT(samples != nullptr || sample_count <= 0, "a plane needs its samples");
    PlaneSet<T> planes;
    bool const sound = all_finite(&options.good_pixels, 1) && all_finite(&options.least_share, 1) &&
                       all_finite(&options.hysteresis, 1);
    if (!sound || unusable(light) || faults_of(view).any() || sample_count <= 0) return planes;
    Mat4<T> const eye = clip_from_world(view, ClipSpace{});
    Samples<T> rest;
    int const stride = (sample_count + max_samples - 1) / max_samples;
    for (int i = 0; i < sample_count; i += stride) {
        SurfacePoint<T> const& sample = samples[i];
        bool const seen = all_finite(sample.normal) && projected(eye, sample.point).in_front;
        if (seen && !faces_away(light, sample.point, sample.normal))
            rest.at[static_cast<std::size_t>(rest.count++)] = sample;
    }
    T const all = T(rest.count);
    int const most = options.most < max_planes ? options.most : max_planes;
    // A plane of the last frame that is a little behind stays; of two such the first.
    T const kept_for = T(1) + glm::clamp(options.hysteresis, T(0), T(1));
    while (planes.count < most && rest.count > 0) {
        ShadowPlane<T> best{Vec3<T>(T(0)), T(0)};
        int most_served = 0;
        for (int i = 0; i < rest.count; ++i) {
            SurfacePoint<T> const& sample = rest.at[static_cast<std::size_t>(i)];
            ShadowPlane<T> const tangent = plane_through(sample.point, sample.normal);
            int const served = detail::well_served(tangent, eye, light, rest, options.good_pixels);
            if (served <= most_served) continue;
            most_served = served;
            best = tangent;
        }
        for (int i = 0; previous != nullptr && i < previous->count && i < max_planes; ++i) {
            ShadowPlane<T> const& last = previous->at[static_cast<std::size_t>(i)];
            int const served = detail::well_served(last, eye, light, rest, options.good_pixels);
            if (served == 0 || T(most_served) > T(served) * kept_for) continue;
            most_served = served;
            best = last;
            break;
        }
        if (most_served == 0 || T(most_served) < options.least_share * all) break;
        Samples<T> left;
        std::size_t const place = static_cast<std::size_t>(planes.count++);
        planes.at[place] = best;
        planes.share[place] = T(detail::well_served(best, eye, light, rest, options.good_pixels, &left)) / all;
        rest = left;
    }
    return planes;
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/points.hpp ========
//
// Points into a map, many at once. Every technique ends as one matrix, so this is the vertex transform of all of them,
// the view-dependent map's included: what the thesis does in two products and a division a vertex is one product.

namespace shadowmath {
inline namespace v0 {

// clip[i] = matrix * (points[i], 1), for `count` points; `clip` holds as many and does not overlap them. Columns are
// added from the first to the last, so the sum may differ from glm's in its last bits. Nothing is divided.
template <class T>
inline void clip_points(Mat4<T> const& matrix, Vec3<T> const* points, int count, Vec4<T>* clip) noexcept {
    SHADOWMATH_ASSERT(count <= 0 || (points != nullptr && clip != nullptr), "clip_points needs two arrays");
    using Lanes = detail::Lanes<T>;
    static_assert(sizeof(Lanes) == sizeof(Vec4<T>), "a point in a register");
    Lanes column[4];
    std::memcpy(column, &matrix, sizeof column);
    for (int i = 0; i < count; ++i) {
        Vec3<T> const& p = points[i];
        Lanes const at = column[0] * detail::all_four(p.x) + column[1] * detail::all_four(p.y) +
                         column[2] * detail::all_four(p.z) + column[3];
        std::memcpy(clip + i, &at, sizeof at);
    }
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/shafts_of_light.hpp ========
//
// Where the light that warped maps get first meets the casters' box, four maps at a time: where their depth begins. The
// inside of four_warps.hpp; what depth_range.hpp is for sides that are parallel.
//
// Source: ours.

namespace shadowmath {
inline namespace v0 {
namespace detail {

// A plane that goes up by `growth` along an axis of a box, as what cuts the edges along it: by -1 / growth, out of the
// way at the end that it does not cut.
template <class T>
struct CutAlong {
    Lanes<T> inverse, not_entered, not_left;

    [[gnu::always_inline]] explicit CutAlong(Lanes<T> const& growth) noexcept {
        constexpr T away = T(1e38);
        Lanes<T> const in = not_zero(growth), none = all_four(T(0));
        inverse = all_four(T(-1)) / in;
        not_entered = where_at_most(in, none, all_four(-away), none);
        not_left = not_entered + all_four(away);
    }
    // `inside`: of the edges' origin, above the plane.
    [[gnu::always_inline]] void cut(Lanes<T> const& inside, Lanes<T>& first, Lanes<T>& last) const noexcept {
        Lanes<T> const at = inside * inverse;
        first = largest(first, at + not_entered);
        last = least(last, at + not_left);
    }
};

// The light that a map gets, a map to a lane: between y_lo and y_hi, and between x_lo w and x_hi w.
template <class T>
struct ShaftsOfLight {
    Lanes<T> x_lo, x_hi, y_lo, y_hi;
    Lanes<T> w_slope, w_offset;  // w = w_slope y + w_offset
};

// Where such light first meets a box: on one of the three faces that it falls on, so on one of their nine edges, or
// where one of the shaft's own four edges enters the box.
template <class T>
struct LightOnBox {
    using Four = Lanes<T>;
    static constexpr T none = T(1e37);

    // In the mirror, along every axis of the box that the light goes down: then it goes up all of them.
    Vec3<T> across, upward, travel;
    Four lo[3], hi[3], rounding;  // of the box
    // What the lower and the upper end of the box add to y, and to how far it is inside either side.
    Four y[3][2], above[3][2], below[3][2], above_growth[3], below_growth[3];
    Four from_y, to_y, middle_y, half_y, lo_wider, hi_wider, lo_offset, hi_offset;

    // `box`: relative to the eye, and taken no farther out than `reach`.
    [[gnu::always_inline]] LightOnBox(ShaftsOfLight<T> const& shafts, LightBasis<T> const& axes, Aabb<T> const& box,
                                      Four const& reach) noexcept
        : across(axes.x), upward(axes.y), travel(axes.depth) {
        constexpr T unsure = T(8) * std::numeric_limits<T>::epsilon();
        Four const zero = all_four(T(0)), back = zero - reach, half = all_four(T(0.5));
        Four const lo_slope = shafts.x_lo * shafts.w_slope, hi_slope = shafts.x_hi * shafts.w_slope;
        add_axis<0>(box, back, reach, lo_slope, hi_slope);
        add_axis<1>(box, back, reach, lo_slope, hi_slope);
        add_axis<2>(box, back, reach, lo_slope, hi_slope);
        auto const farther = [](Four const& a, Four const& b) { return largest(absolute(a), absolute(b)); };
        rounding = (farther(lo[0], hi[0]) + farther(lo[1], hi[1]) + farther(lo[2], hi[2])) * all_four(unsure);
        Four const of_offset = absolute(shafts.w_offset) * all_four(unsure);
        lo_wider = rounding + absolute(lo_slope) * rounding + absolute(shafts.x_lo) * of_offset;
        hi_wider = rounding + absolute(hi_slope) * rounding + absolute(shafts.x_hi) * of_offset;
        lo_offset = lo_wider - shafts.x_lo * shafts.w_offset, hi_offset = hi_wider + shafts.x_hi * shafts.w_offset;
        Four const y_lo = least(y[0][0], y[0][1]) + least(y[1][0], y[1][1]) + least(y[2][0], y[2][1]);
        Four const y_hi = largest(y[0][0], y[0][1]) + largest(y[1][0], y[1][1]) + largest(y[2][0], y[2][1]);
        from_y = largest(shafts.y_lo, y_lo) - rounding, to_y = least(shafts.y_hi, y_hi) + rounding;
        middle_y = (from_y + to_y) * half, half_y = (to_y - from_y) * half;
    }
    template <int k>
    [[gnu::always_inline]] void add_axis(Aabb<T> const& box, Four const& back, Four const& reach, Four const& lo_slope,
                                         Four const& hi_slope) noexcept {
        bool const down = travel[k] < T(0);
        across[k] = down ? -across[k] : across[k];
        upward[k] = down ? -upward[k] : upward[k];
        travel[k] = std::abs(travel[k]);
        lo[k] = largest(all_four(down ? -box.hi[k] : box.lo[k]), back);
        hi[k] = least(all_four(down ? -box.lo[k] : box.hi[k]), reach);
        Four const x_of = all_four(across[k]), y_of = all_four(upward[k]);
        above_growth[k] = x_of - lo_slope * y_of, below_growth[k] = hi_slope * y_of - x_of;
        y[k][0] = lo[k] * y_of, y[k][1] = hi[k] * y_of;
        above[k][0] = lo[k] * above_growth[k], above[k][1] = hi[k] * above_growth[k];
        below[k][0] = lo[k] * below_growth[k], below[k][1] = hi[k] * below_growth[k];
    }

    // Of the edge along axis k at the lower (0) or upper (1) ends of the two others.
    template <int k, int a, int b>
    [[gnu::always_inline]] void meet_edge(Four const& inverse_y, Four const& reach_y, CutAlong<T> const& by_above,
                                          CutAlong<T> const& by_below, Four& first_of_all) const noexcept {
        constexpr int u = (k + 1) % 3, v = (k + 2) % 3;
        Four const at = (middle_y - (y[u][a] + y[v][b])) * inverse_y;
        Four first = largest(lo[k], at - reach_y), last = least(hi[k], at + reach_y);
        by_above.cut(above[u][a] + (above[v][b] + lo_offset), first, last);
        by_below.cut(below[u][a] + (below[v][b] + hi_offset), first, last);
        Four const depth = (a == 0 ? lo[u] : hi[u]) * all_four(travel[u]) +
                           (b == 0 ? lo[v] : hi[v]) * all_four(travel[v]) + first * all_four(travel[k]);
        first_of_all = least(first_of_all, where_at_most(first, last, depth, all_four(none)));
    }
    template <int k>
    [[gnu::always_inline]] void meet_edges(Four& first_of_all) const noexcept {
        T const per_y = T(1) / not_zero(upward[k]);
        Four const inverse_y = all_four(per_y), reach_y = half_y * all_four(std::abs(per_y));
        CutAlong<T> const by_above(above_growth[k]), by_below(below_growth[k]);
        meet_edge<k, 0, 0>(inverse_y, reach_y, by_above, by_below, first_of_all);
        meet_edge<k, 0, 1>(inverse_y, reach_y, by_above, by_below, first_of_all);
        meet_edge<k, 1, 0>(inverse_y, reach_y, by_above, by_below, first_of_all);
    }
    template <int k>
    [[gnu::always_inline]] void enter(Four const& at_x, Four const& at_y, T per_step, Four& first,
                                      Four& last) const noexcept {
        Four const at = at_x * all_four(across[k]) + at_y * all_four(upward[k]);
        first = largest(first, (lo[k] - rounding - at) * all_four(per_step));
        last = least(last, (hi[k] + rounding - at) * all_four(per_step));
    }
    [[gnu::always_inline]] void meet_corner(Four const& at_x, Four const& at_y, Vec3<T> const& per_step,
                                            Four& first_of_all) const noexcept {
        Four first = all_four(-none), last = all_four(none);
        enter<0>(at_x, at_y, per_step.x, first, last);
        enter<1>(at_x, at_y, per_step.y, first, last);
        enter<2>(at_x, at_y, per_step.z, first, last);
        first_of_all = least(first_of_all, where_at_most(first, last, first, all_four(none)));
    }
    // Metres along the light, less by rounding; the largest number where it meets nothing.
    [[nodiscard, gnu::always_inline]] Four first_met(ShaftsOfLight<T> const& shafts) const noexcept {
        Four first_of_all = all_four(none);
        meet_edges<0>(first_of_all), meet_edges<1>(first_of_all), meet_edges<2>(first_of_all);
        Vec3<T> const per_step(T(1) / not_zero(travel.x), T(1) / not_zero(travel.y), T(1) / not_zero(travel.z));
        Four const w_lo = shafts.w_offset + shafts.w_slope * from_y, w_hi = shafts.w_offset + shafts.w_slope * to_y;
        meet_corner(shafts.x_lo * w_lo - lo_wider, from_y, per_step, first_of_all);
        meet_corner(shafts.x_hi * w_lo + hi_wider, from_y, per_step, first_of_all);
        meet_corner(shafts.x_lo * w_hi - lo_wider, to_y, per_step, first_of_all);
        meet_corner(shafts.x_hi * w_hi + hi_wider, to_y, per_step, first_of_all);
        // Boxes that are none have edges all the same.
        Four const size = least(hi[0] - lo[0], least(hi[1] - lo[1], hi[2] - lo[2]));
        return where_at_most(all_four(T(0)), least(size, half_y), first_of_all, all_four(none)) - rounding;
    }
};

}  // namespace detail
}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/warp.hpp ========
//
// Perspective warps of a sun's map: texels small near the eye, large far away, in one map.
//
//   seen from the light:      \     far      /         w = 1 + (y - y_near) / a, with y along the projected view
//                              \            /          direction. All warps with one centre line are this one; they
//        eye . . . . y_near ->  \__________/           differ in a, the distance of the centre behind the near end:
//                                                      a -> infinity is the uniform map, a = z_near Stamminger's.
//
//   strength 0   uniform                                   the identity of the family, bit for bit
//   strength 1   the least worst error along the view      LiSPSM (Wimmer 2004): a = (n + sqrt(n f)) / sine
//   strength 2   texels as wide as pixels                  PSM (Stamminger 2002): a = n / sine; worst at the far end
//   between      Lloyd's eta + 1 (2006) above 1, a share of 1 / a below
//   trapezoid    80 % of the map up to a given depth       TSM (Martin and Tan 2004)
//   extended     w grows by a constant per metre           XPSM (Gusev 2007)
//
// PSM is here without its troubles: light from behind the viewer, which turns its depth around, and casters behind
// the eye are ordinary, as depth is measured along the light and w is 1 at the nearest receiver.
//
// Use it for one map and a low sun or a level view. Where light and view are parallel nothing can be gained, and the
// warp fades to a uniform map. Like every map that depends on the view it shimmers when the camera moves; cascades do
// not.
//
// Source: the "very simple perspective shadow map" of a Korean weblog (2012) in its corrected form; a as in the papers
// named above, LiSPSM with Scherzer's general tilt. Departures from the weblog: the whole map is filled, depth is not
// clipped, the centre of projection is free of the camera, and the strength follows the angle of the light. From the
// papers: the warped view is fitted anew, and every warp fades with the same angle.

namespace shadowmath {
inline namespace v0 {

// The warp exactly as the weblog printed it, for points of a light's NDC whose y runs along the view: rows of D3D's
// projection with y in the place of z. With w and h the width and height of the near end: y = z_near goes to 0, not to
// -1, and y = z_far to 1, so half of the map stays empty; depth above h / 2 at the near end leaves the map; y <= 0 is
// behind the centre. Here to be compared with. The identity unless 0 < z_near < z_far, w > 0 and h > 0, all finite.
template <class T>
[[nodiscard]] inline Mat4<T> printed_simple_warp(T const& w, T const& h, T const& z_near, T const& z_far) noexcept {
    bool const numbers = all_finite(&w, 1) && all_finite(&h, 1) && all_finite(&z_near, 1) && all_finite(&z_far, 1);
    if (!numbers || !(w > T(0)) || !(h > T(0)) || !(z_near > T(0)) || !(z_near < z_far)) return Mat4<T>(T(1));
    T const scale = z_far / (z_far - z_near);
    Mat4<T> const warp =
        from_rows(Vec4<T>(T(2) * z_near / w, T(0), T(0), T(0)), Vec4<T>(T(0), scale, T(0), -z_near * scale),
                  Vec4<T>(T(0), T(0), T(2) * z_near / h, T(0)), Vec4<T>(T(0), T(1), T(0), T(0)));
    return all_finite(warp) ? warp : Mat4<T>(T(1));
}

// The same, mended in its own parameters: y = z_near goes to -1 and y = z_far to 1, and depth in [0, 1] stays there. A
// body with |x| <= k y fills the width with w = 2 k z_near. The centre is still at y = 0.
template <class T>
[[nodiscard]] inline Mat4<T> corrected_simple_warp(T const& w, T const& z_near, T const& z_far) noexcept {
    bool const numbers = all_finite(&w, 1) && all_finite(&z_near, 1) && all_finite(&z_far, 1);
    if (!numbers || !(w > T(0)) || !(z_near > T(0)) || !(z_near < z_far)) return Mat4<T>(T(1));
    T const length = z_far - z_near;
    Mat4<T> const warp = from_rows(Vec4<T>(T(2) * z_near / w, T(0), T(0), T(0)),
                                   Vec4<T>(T(0), (z_far + z_near) / length, T(0), T(-2) * z_near * (z_far / length)),
                                   Vec4<T>(T(0), T(0), z_near, T(0)), Vec4<T>(T(0), T(1), T(0), T(0)));
    return all_finite(warp) ? warp : Mat4<T>(T(1));
}

// 1 / a for the a that makes the aliasing along y least: equal at both ends. `z_near`: eye depth of the near end,
// metres, > 0. `length`: of the body along y, metres, >= 0. `sine`: of the angle between view and light, [0, 1]. With
// an overhead light a = n + sqrt(n f). Goes to 0 with the sine: the reciprocal of a is what can fade.
template <class T>
[[nodiscard]] inline T optimal_inverse_centre(T z_near, T length, T sine) noexcept {
    return sine / (z_near * (T(1) + std::sqrt(T(1) + length * sine / z_near)));
}

// The same for Lloyd's eta in [-1, 1]: -1 uniform, 0 the optimum above, 1 Stamminger's z_near / sine. Increases with
// eta.
template <class T>
[[nodiscard]] inline T lloyd_inverse_centre(T eta, T z_near, T length, T sine) noexcept {
    T const growth = length * sine / z_near, root = std::sqrt(T(1) + growth);
    T const share = eta < T(0) ? (T(1) + eta) / (T(1) + root - eta * growth) : (T(1) + eta * root) / (T(1) + root);
    return sine / z_near * share;
}

// Lloyd's fall-off of eta, for a light whose rays are `angle` radians from the view's axis: -1 while the light is
// nearly in the middle of the picture, 0 where it is well outside. `half_fov_radians`: half the view's angle in the
// plane of the light. Continuous; with the first transition mended as later engines have it.
template <class T>
[[nodiscard]] inline T lloyd_eta(T angle, T half_fov_radians) noexcept {
    constexpr T quarter_turn = T(1.57079632679489661923132169163975144L), at_edge = T(-0.2);
    T const gamma = angle > quarter_turn ? T(2) * quarter_turn - angle : angle;
    T const first = half_fov_radians / T(3), edge = half_fov_radians;
    T const last = edge + T(0.3) * (quarter_turn - edge);
    if (!(gamma > first)) return T(-1);
    if (gamma < edge)
        return (at_edge + T(1)) * (T(1) - std::cos(quarter_turn * (gamma - first) / (edge - first))) - T(1);
    if (gamma < last) return at_edge * (T(1) - std::sin(quarter_turn * (gamma - edge) / (last - edge)));
    return T(0);
}

// 1 / a that spreads the first `focus_length` metres of the body over `share` of the map; Martin and Tan's eta is this
// a. 0 where that is no more than they have anyway. `focus_length` and `length` > 0, `share` in (0, 1).
template <class T>
[[nodiscard]] inline T trapezoid_inverse_centre(T length, T focus_length, T share = T(0.8)) noexcept {
    T const inverse = (share / focus_length - T(1) / length) / (T(1) - share);
    return inverse > T(0) ? inverse : T(0);
}

// 1 / a for Gusev's w = 1 + (coefficient / sine) y, y in metres from the eye, of a body that begins at `y_near`. Where
// that is behind the eye w is kept at 0.15 or more, as his demo does.
template <class T>
[[nodiscard]] inline T extended_inverse_centre(T coefficient, T sine, T y_near) noexcept {
    T const slope = glm::clamp(coefficient, T(0), T(1e9)) / glm::max(sine, T(1e-9));
    T const most = y_near < T(0) ? T(-0.85) / y_near : slope;
    T const growth = slope < most ? slope : most;
    return growth / (T(1) + growth * y_near);
}

// The warp itself, before any fit. `axes.y` points from near to far, `y_near` is where w = 1; both relative to
// the eye. `inverse_centre` = 1 / a in [0, 1 / (z_near of the eye)], 0 for the uniform map.
template <class T>
[[nodiscard]] inline MapRows<T> perspective_warp(LightBasis<T> const& axes, T y_near, T inverse_centre) noexcept {
    MapRows<T> rows;
    rows.x = Vec4<T>(axes.x, T(0));
    rows.y = Vec4<T>(axes.y, -y_near);
    rows.w = Vec4<T>(axes.y * inverse_centre, T(1) - y_near * inverse_centre);
    rows.along = Vec4<T>(axes.depth, T(0));
    rows.source = rows.along;
    rows.w_min = T(0.5);
    return rows;
}

template <class T>
struct WarpAxes {
    LightBasis<T> basis;  // y along the projected view direction
    T sine = T(0);        // of the angle between view and light
    T fade = T(0);        // of the warp: 1 from 30 degrees on, 0 below 6
};

// Light space with y along the view. As the view turns into the light its direction there fades, and what is up in the
// picture takes over: for a camera that looks down on its world, y stays where it was. No rule is continuous
// everywhere; this one turns y about only in views tilted some 6 degrees past the light, where there is no warp left to
// notice it.
template <class T>
[[nodiscard]] inline WarpAxes<T> warp_axes(Pose<T> const& eye, Vec3<T> const& travel) noexcept {
    auto const across = [&travel](Vec3<T> const& v) { return v - travel * glm::dot(travel, v); };
    constexpr T none = T(0.1), full = T(0.5);  // sines of 6 and 30 degrees
    Vec3<T> const view = across(eye.forward);
    WarpAxes<T> axes;
    axes.sine = glm::min(glm::length(view), T(1));
    T const t = glm::clamp((axes.sine - none) / (full - none), T(0), T(1));
    axes.fade = t * t * (T(3) - T(2) * t);
    axes.basis = light_basis(travel);
    // Up in the picture weighs no more than the view does where the fade begins: so the two cancel only below.
    Vec3<T> const rough = safe_normalize(view + across(eye.up) * (none * (T(1) - axes.fade))).direction;
    // Across the light once more: what rounding left along it has grown with the normalisation.
    Normalized<T> const y = safe_normalize(across(rough));
    if (!y.ok) return axes;
    axes.basis.y = y.direction;
    axes.basis.x = glm::cross(travel, y.direction);
    return axes;
}

enum class WarpRule : std::uint8_t { by_strength, trapezoid, extended };

template <class T>
struct WarpOptions {
    int map_size = 1024;
    T margin_texels = T(2);  // of the map kept free on each side, for the filter
    T strength = T(1);       // [0, 2]: 0 the uniform map, 1 the least aliasing along the view, 2 Stamminger's;
                             // of the other rules a factor of 1 / a
    WarpRule rule = WarpRule::by_strength;
    T focus_metres = T(20);   // trapezoid: eye depth up to which 80 % of the map go
    T coefficient = T(0.05);  // extended: what w grows by, for a metre across a light at a right angle
};

namespace detail {

// 1 / a by the rules' own measures, none of them stronger than Stamminger's.
template <class T>
[[nodiscard]] inline T inverse_centre(WarpOptions<T> const& options, T strength, T z_near, T y_near, T length,
                                      T sine) noexcept {
    T const most = sine / z_near;
    T inverse = T(0);
    if (options.rule == WarpRule::by_strength) {
        if (strength > T(1)) return lloyd_inverse_centre(strength - T(1), z_near, length, sine);
        return strength * optimal_inverse_centre(z_near, length, sine);
    }
    if (options.rule == WarpRule::trapezoid) {
        // Of eye depth, along the ground: a metre of depth is 1 / sine of light space.
        T const focus = (options.focus_metres - z_near) / glm::max(sine, T(1e-3));
        T const least = length * T(1e-3);
        if (length > T(0)) inverse = trapezoid_inverse_centre(length, focus > least ? focus : least);
    } else {
        inverse = extended_inverse_centre(options.coefficient, sine, y_near);
    }
    return glm::clamp(strength * inverse, T(0), most);
}

}  // namespace detail

// One warped map of what the slice sees of the receivers, and of every caster above it; it fills the map up to the
// margin. w > 0 on all of them: w is 1 at the near end, grows from there, and is the same all along a light ray.
// Orthographic views are served uniformly, as they have no perspective to undo. Spots get the plain fit_spot.
// warp_faded tells that nothing of the warp was left; it is no fault, the map is right.
template <class T>
[[nodiscard]] inline ShadowMap<T> simple_perspective_map(ViewVolume<T> const& slice, Light<T> const& light,
                                                         Aabb<T> const& casters, Aabb<T> const& receivers,
                                                         WarpOptions<T> const& options, ClipSpace clip) noexcept {
    if (light.kind == LightKind::spot)
        return fit_spot(slice, light, casters, receivers, options.map_size, options.margin_texels, clip);
    ShadowMap<T> map;
    map.clip = clip;
    Door<T> const in = door(slice, light, casters, receivers, options.map_size, options.margin_texels);
    map.faults = in.faults;
    bool const finite =
        all_finite(&options.strength, 1) && all_finite(&options.focus_metres, 1) && all_finite(&options.coefficient, 1);
    if (!finite) map.faults |= Fault::not_finite;
    if (in.stop || !finite) return map;
    T const strength = glm::clamp(options.strength, T(0), T(2));
    if (strength != options.strength) map.faults |= Fault::clamped_option;

    ConvexBody<T> const body = visible_body(in.view, receivers);
    if (body.edge_count == 0) return map;
    WarpAxes<T> const axes = warp_axes(in.view.pose, in.light.direction);
    detail::Extent<T> x, y, eye_metres;
    for_each_vertex(body, [&](Vec3<T> const& p) {
        x.add(glm::dot(axes.basis.x, p));
        y.add(glm::dot(axes.basis.y, p));
        eye_metres.add(glm::dot(in.view.pose.forward, p));
    });
    T inverse_centre = T(0);
    if (in.view.kind == ViewKind::perspective) {
        if (axes.fade * strength == T(0)) map.faults |= Fault::warp_faded;
        // Nearer than 2^-20 of the far distance no ratio of depths means anything.
        T const nearest = in.view.z_far / T(1 << 20);
        if (!(in.view.z_near > T(0))) map.faults |= Fault::near_clamped;
        inverse_centre = axes.fade * detail::inverse_centre(options, strength, glm::max(eye_metres.lo, nearest), y.lo,
                                                            y.hi - y.lo, axes.sine);
    }
    MapRows<T> rows = perspective_warp(axes.basis, y.lo, inverse_centre);
    rows.least_width = glm::max(x.hi - x.lo, y.hi - y.lo) / T(options.map_size);
    Faults const before = map.faults;
    map = map_from_rows(rows, in.view.pose.position, body, casters, options.map_size, options.margin_texels, clip);
    map.faults |= before;
    return map;
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/warped_edges.hpp ========
//
// The edges of slices and box (slice_edges.hpp), kept until a warp is known, and then seen behind it: what warps are
// fitted to, without a polygon. The inside of four_warps.hpp.
//
// Source: ours. An edge stays one under x / w: its ends bound it, as long as w > 0.

namespace shadowmath {
inline namespace v0 {
namespace detail {

// Farther than anything is.
template <class T>
inline constexpr T far_away = T(1e37);

// Edges of four slices, four to a slice, as they are kept until the warp is known.
template <class T>
struct KeptEdges {
    using Four = Lanes<T>;
    using Long = LongLanes<T>;
    enum Group { near_sides, far_sides, rays, of_box, groups = of_box + 3 };
    T x[groups][16], y[groups][16], along[groups][16];  // of their middles, relative to the eye
    T length[groups][16];                               // in steps; negative where an edge is none

    // Keeps those of slices from i on, and says what they reach and how near it comes to the eye.
    // NOTE: no loop: compilers would keep what it needs in registers that they have not.
    template <int i = 0>
    [[gnu::always_inline]] void keep_all(ViewOfBox<T> const& seen, EdgesInLight<T> const& edges, ExtentsOfSlices<T>& of,
                                         T (&nearest)[16]) noexcept {
        Long const nothing = Long::all(far_away<T>);
        Long const at_near = spread<Long>(edges.nearest, i), at_far = spread<Long>(edges.farthest, i);
        Reach reach;
        reach.extent = keep(near_sides, i, edges.sides_at(at_near));
        reach.ahead = where_at_most(Long::all(T(0)), at(length, near_sides, i), at_near, nothing);
        reach.extent.add(keep(far_sides, i, edges.sides_at(at_far)));
        CutEdges<Long> const cut_rays = edges.rays_in(i);
        reach.extent.add(keep(rays, i, cut_rays));
        reach.ahead = least(reach.ahead, where_at_most(cut_rays.first, cut_rays.last, cut_rays.first, nothing));
        keep_box_edges(seen, edges, 0, i, reach);
        keep_box_edges(seen, edges, 1, i, reach);
        keep_box_edges(seen, edges, 2, i, reach);
        of.store(i, reach.extent);
        store_long(nearest + 4 * i, reach.ahead);
        if constexpr (i + Long::fours < 4) keep_all<i + Long::fours>(seen, edges, of, nearest);
    }
    struct Reach {
        ExtentInLanes<Long> extent;
        Long ahead;
    };
    [[gnu::always_inline]] void keep_box_edges(ViewOfBox<T> const& seen, EdgesInLight<T> const& edges, int axis, int i,
                                               Reach& reach) noexcept {
        CutEdges<Long> const cut = edges.box_edges_in(i, axis);
        reach.extent.add(keep(of_box + axis, i, cut));
        Long const from = repeated<Long>(four_at(edges.of_box.ahead + 4 * axis));
        Long const growth = Long::all(not_zero(seen.pose->forward[axis]));
        Long const depth = least((from + cut.first) * growth, (from + cut.last) * growth);
        reach.ahead = least(reach.ahead, where_at_most(cut.first, cut.last, depth, Long::all(far_away<T>)));
    }
    [[gnu::always_inline]] ExtentInLanes<Long> keep(int group, int i, CutEdges<Long> const& edges) noexcept {
        Vectors<Long> const middle = edges.middle();
        Long const steps = edges.length();
        store_long(x[group] + 4 * i, middle.x), store_long(y[group] + 4 * i, middle.y);
        store_long(along[group] + 4 * i, middle.z), store_long(length[group] + 4 * i, steps);
        Vectors<Long> const reach = edges.half.size * steps;
        return {{middle.x - reach.x, middle.y - reach.y, middle.z - reach.z}, middle + reach};
    }
    [[nodiscard, gnu::always_inline]] Long at(T const (&of)[groups][16], int group, int i) const noexcept {
        return long_at<Long>(of[group] + 4 * i);
    }
};

// The ends of what was kept, behind the warp w = w_slope y + w_offset.
template <class T>
struct WarpedEnds {
    using Four = Lanes<T>;
    using Long = LongLanes<T>;
    using Kept = KeptEdges<T>;
    T along[Kept::groups][2][16], inverse_w[Kept::groups][2][16];
    T lo[16], hi[16];  // x / w

    struct Span {
        Long lo, hi;
    };
    [[gnu::always_inline]] WarpedEnds(EdgesInLight<T> const& edges, Kept const& kept, Four const& w_slope,
                                      Four const& w_offset) noexcept {
        project_all(edges, kept, w_slope, w_offset);
    }
    template <int i = 0>
    [[gnu::always_inline]] void project_all(EdgesInLight<T> const& edges, Kept const& kept, Four const& w_slope,
                                            Four const& w_offset) noexcept {
        Long const slope = spread<Long>(w_slope, i), offset = spread<Long>(w_offset, i);
        Span span{Long::all(far_away<T>), Long::all(-far_away<T>)};
        project(kept, Kept::near_sides, edges.along_side, i, slope, offset, span);
        project(kept, Kept::far_sides, edges.along_side, i, slope, offset, span);
        project(kept, Kept::rays, edges.along_ray, i, slope, offset, span);
        project(kept, Kept::of_box, edges.along[0], i, slope, offset, span);
        project(kept, Kept::of_box + 1, edges.along[1], i, slope, offset, span);
        project(kept, Kept::of_box + 2, edges.along[2], i, slope, offset, span);
        store_long(lo + 4 * i, span.lo);
        store_long(hi + 4 * i, span.hi);
        if constexpr (i + Long::fours < 4) project_all<i + Long::fours>(edges, kept, w_slope, w_offset);
    }
    [[gnu::always_inline]] void project(Kept const& kept, int group, HalfStep<Long> const& half, int i,
                                        Long const& slope, Long const& offset, Span& span) noexcept {
        Long const nothing = Long::all(far_away<T>), less_than_nothing = Long::all(-far_away<T>);
        Long const zero = Long::all(T(0)), w_min = Long::all(T(0.5)), kept_length = kept.at(kept.length, group, i);
        Long const length = largest(kept_length, Long::all(T(-1)));
        Long const x = kept.at(kept.x, group, i), across = half.step.x * length, ahead = half.step.z * length;
        Long const middle = where_at_most(zero, kept_length, kept.at(kept.along, group, i), less_than_nothing);
        Long const w = kept.at(kept.y, group, i) * slope + offset, growth = half.step.y * length * slope;
        Long const a = Long::all(T(1)) / largest(w - growth, w_min);
        Long const b = Long::all(T(1)) / largest(w + growth, w_min);
        Long const from = (x - across) * a, to = (x + across) * b;
        span.lo = least(span.lo, where_at_most(zero, kept_length, least(from, to), nothing));
        span.hi = largest(span.hi, where_at_most(zero, kept_length, largest(from, to), less_than_nothing));
        store_long(along[group][0] + 4 * i, middle - ahead);
        store_long(along[group][1] + 4 * i, middle + ahead);
        store_long(inverse_w[group][0] + 4 * i, a);
        store_long(inverse_w[group][1] + 4 * i, b);
    }

    // The largest of (depth - first) / w.
    [[nodiscard, gnu::always_inline]] Four deepest(Four const& first) const noexcept {
        T of_slices[16];
        deepest_of_all(first, of_slices);
        return largest_of(of_slices);
    }
    template <int i = 0>
    [[gnu::always_inline]] void deepest_of_all(Four const& first, T (&of_slices)[16]) const noexcept {
        Long const start = spread<Long>(first, i);
        Long most = Long::all(-far_away<T>);
        for (int group = 0; group < Kept::groups; ++group)
            for (int side = 0; side < 2; ++side)
                most = largest(most, (long_at<Long>(along[group][side] + 4 * i) - start) *
                                         long_at<Long>(inverse_w[group][side] + 4 * i));
        store_long(of_slices + 4 * i, most);
        if constexpr (i + Long::fours < 4) deepest_of_all<i + Long::fours>(first, of_slices);
    }
};

}  // namespace detail
}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/four_warps.hpp ========
//
// Four warped maps at once, a map to a lane: the inside of slice_warps.hpp, and the twin of map_rows.hpp in lanes.
//
//   edges of slices and receivers    cut and bounded in light space, as slice_edges.hpp does: y and z_near say 1 / a
//   their ends                       behind the warp, x / w: the sides of the map
//   edges of the casters' box        between those sides, and the sides' own edges: where depth begins
//   the ends again                   depth / w: how far it goes
//
// The first, second and fourth take four edges of a slice at a time (warped_edges.hpp), the third a slice to a lane
// (shafts_of_light.hpp).
//
// Source: that of warp.hpp.

namespace shadowmath {
inline namespace v0 {
namespace detail {

// What the maps of one call have in common.
template <class T>
struct WarpsOfView {
    ViewOfBox<T> seen;  // of the receivers, along `axes`
    WarpAxes<T> axes;
    Aabb<T> casters;  // relative to the eye
    Vec3<T> eye;
    Faults faults;
    T margin;  // texels, for each that is used
    T size;    // texels of a map's side
    ClipSpace clip;
    bool flat;  // orthographic: nothing to undo
};

// One row of four matrices, relative to the eye.
template <class T>
struct FourRows {
    FourVectors<T> normal;
    Lanes<T> offset;
};

// Column by column, of all four. finite[i]: what matrix i holds.
template <class T>
[[gnu::always_inline]] inline void write_rows(FourRows<T> const& x, FourRows<T> const& y, FourRows<T> const& z,
                                              FourRows<T> const& w, Vec3<T> const& eye, int count,
                                              ShadowMap<T>* const* maps, bool (&finite)[4]) noexcept {
    auto const moved = [&eye](FourRows<T> const& row) {
        return row.offset -
               (row.normal.x * all_four(eye.x) + row.normal.y * all_four(eye.y) + row.normal.z * all_four(eye.z));
    };
    Lanes<T> columns[4][4] = {{x.normal.x, y.normal.x, z.normal.x, w.normal.x},
                              {x.normal.y, y.normal.y, z.normal.y, w.normal.y},
                              {x.normal.z, y.normal.z, z.normal.z, w.normal.z},
                              {moved(x), moved(y), moved(z), moved(w)}};
    for (auto& column : columns) transpose(column);
    for (int i = 0; i < count; ++i) {
        BeyondReach<T> infinite;
        for (int column = 0; column < 4; ++column) {
            static_assert(sizeof columns[0][0] == sizeof maps[0]->clip_from_world[0], "columns without a gap");
            std::memcpy(&maps[i]->clip_from_world[column].x, &columns[column][i], sizeof columns[0][0]);
            infinite.look_for_finite(columns[column][i]);
        }
        finite[i] = !infinite.any();
    }
}

// Four maps, a map to a lane; `count` of them are wanted.
template <class T>
struct FourWarps {
    using Four = Lanes<T>;
    using Row = FourRows<T>;
    WarpsOfView<T> const& view;
    Four begin, end;  // of the slices, metres of eye depth
    Four strength;    // [0, 2]
    int count;
    ShadowMap<T>* const* maps;

    static constexpr T eps = std::numeric_limits<T>::epsilon();
    [[nodiscard, gnu::always_inline]] static Four all(T value) noexcept { return all_four(value); }

    // What slices see of the receivers, in light space, relative to the eye; of one that sees nothing, lo > hi, and
    // numbers to compute with.
    struct Seen {
        Four lo, hi;
        Four x_lo, x_hi, y_lo, y_hi, first, last;
        Four nearest;  // metres of eye depth
        Four radius;   // nothing is farther from the eye

        [[nodiscard, gnu::always_inline]] Four or_none(Four const& value) const noexcept {
            return where_at_most(lo, hi, value, all(T(0)));
        }
        [[nodiscard, gnu::always_inline]] Four or_one(Four const& value) const noexcept {
            return where_at_most(lo, hi, value, all(T(1)));
        }
    };
    [[nodiscard, gnu::always_inline]] Seen see(EdgesInLight<T> const& edges, KeptEdges<T>& kept) const noexcept {
        Four const slack = all(view.seen.slack);
        ExtentsOfSlices<T> of;
        T ahead[16];
        kept.keep_all(view.seen, edges, of, ahead);
        Seen seen;
        seen.lo = least_of(of.lo[0]), seen.hi = largest_of(of.hi[0]);
        seen.x_lo = seen.or_none(seen.lo - slack), seen.x_hi = seen.or_none(seen.hi + slack);
        seen.y_lo = seen.or_none(least_of(of.lo[1]) - slack), seen.y_hi = seen.or_none(largest_of(of.hi[1]) + slack);
        seen.first = seen.or_none(least_of(of.lo[2]) - slack), seen.last = seen.or_none(largest_of(of.hi[2]) + slack);
        seen.nearest = largest(least(least_of(ahead), end), begin);
        auto const larger_end = [](Four const& a, Four const& b) { return largest(absolute(a), absolute(b)); };
        Four const x = larger_end(seen.x_lo, seen.x_hi), y = larger_end(seen.y_lo, seen.y_hi);
        Four const z = larger_end(seen.first, seen.last);
        seen.radius = root(x * x + y * y + z * z);
        return seen;
    }

    // w = slope y + offset; the slope is 1 / a of warp.hpp.
    struct Warp {
        Four slope, offset;
    };
    [[nodiscard, gnu::always_inline]] Warp warp_for(Seen const& seen) const noexcept {
        if (view.flat) return {all(T(0)), all(T(1))};
        T const sine = view.axes.sine;
        // Nearer than 2^-20 of the far distance no ratio of depths means anything.
        Four const z_near = largest(seen.nearest, end * all(T(1) / T(1 << 20))), most = all(sine) / z_near;
        Four const root_of_ratio = root(all(T(1)) + (seen.y_hi - seen.y_lo) * most);
        Four const share = least(strength, all(T(1))) + largest(strength - all(T(1)), all(T(0))) * root_of_ratio;
        Four const slope = all(view.axes.fade) * (most * share / (all(T(1)) + root_of_ratio));
        return {slope, all(T(1)) - seen.y_lo * slope};
    }

    // Of the maps: x / w, and (y - y_lo) / w.
    struct Sides {
        Four left, right, bottom, top;
    };
    [[nodiscard, gnu::always_inline]] Sides sides_of(Seen const& seen, Warp const& warp,
                                                     WarpedEnds<T> const& ends) const noexcept {
        Four const zero = all(T(0)), one = all(T(1)), slack = all(view.seen.slack), length = seen.y_hi - seen.y_lo;
        Sides of{seen.or_none(least_of(ends.lo)), seen.or_none(largest_of(ends.hi)), zero,
                 length / (one + length * warp.slope)};
        of.left = of.left - slack * (one + absolute(of.left) * warp.slope);
        of.right = of.right + slack * (one + absolute(of.right) * warp.slope);
        // As wide as a texel and as rounding may be, and a margin.
        Four const noise = (seen.radius + all(glm::length(view.eye))) * all(T(64) * eps);
        Four const texel = largest(seen.x_hi - seen.x_lo, length) * all(T(1) / view.size);
        Four const least_width = seen.or_one(largest(texel, noise));
        auto const widen = [&](Four& lo, Four& hi) {
            Four const more = largest(least_width - (hi - lo), zero) * all(T(0.5));
            lo = lo - more, hi = hi + more;
            Four const border = (hi - lo) * all(view.margin);
            lo = lo - border, hi = hi + border;
        };
        widen(of.left, of.right), widen(of.bottom, of.top);
        return of;
    }

    // Metres along the light: of the first caster between the sides, of the last receiver, and a little more than both.
    struct Depth {
        Four caster, lowest;
        Four from, to, room;
    };
    [[nodiscard, gnu::always_inline]] Depth depth_of(Seen const& seen, Warp const& warp,
                                                     Sides const& of) const noexcept {
        Four const one = all(T(1)), least_w = all(T(1e-6));
        // y of the lower and upper side: where (y - y_lo) / w is `bottom` and `top`; w >= 1/2 below.
        Four const below =
            largest(of.bottom / (one - of.bottom * warp.slope), all(T(-0.5)) / largest(warp.slope, all(T(1e-30))));
        Four const narrowing = one - of.top * warp.slope - all(T(4) * eps);
        Four const above = where_at_most(least_w, narrowing, of.top / largest(narrowing, least_w), all(far_away<T>));
        ShaftsOfLight<T> const shafts{of.left, of.right, seen.y_lo + below, seen.y_lo + above, warp.slope, warp.offset};
        LightOnBox<T> const lit(shafts, view.axes.basis, view.casters, seen.radius * all(T(1024)));
        Depth depth;
        depth.caster = lit.first_met(shafts);
        // No receiver is farther from the light than this.
        depth.lowest = seen.last + all(T(1e-3)) * (seen.last - seen.first) +
                       largest(absolute(seen.first), absolute(seen.last)) * all(T(64) * eps);
        Four const begins = where_at_most(depth.caster, depth.lowest, least(seen.first, depth.caster), seen.first);
        depth.room = (seen.last - begins) * all(T(1) / T(1024)) + seen.radius * all(T(64) * eps) + all(view.seen.slack);
        depth.from = begins - depth.room, depth.to = seen.last + depth.room;
        return depth;
    }

    [[nodiscard, gnu::always_inline]] Row x_row(Warp const& warp, Sides const& of) const noexcept {
        Vec3<T> const &across = view.axes.basis.x, &up = view.axes.basis.y;
        Four const zero = all(T(0)), width = of.right - of.left;
        Four const scale = all(T(2)) / width, shift = (of.right + of.left) / width;
        return {times(scale, across) + times(zero - warp.slope * shift, up), zero - warp.offset * shift};
    }
    [[nodiscard, gnu::always_inline]] Row y_row(Seen const& seen, Warp const& warp, Sides const& of) const noexcept {
        T const sign = view.clip.ndc_y == YAxis::up ? T(1) : T(-1);
        Four const height = of.top - of.bottom, scale = all(sign * T(2)) / height;
        Four const shift = (of.top + of.bottom) / height * all(sign);
        return {times(scale - warp.slope * shift, view.axes.basis.y),
                all(T(0)) - (seen.y_lo * scale + warp.offset * shift)};
    }
    [[nodiscard, gnu::always_inline]] Row z_row(Seen const& seen, Warp const& warp, WarpedEnds<T> const& ends,
                                                Depth const& depth) const noexcept {
        Vec3<T> const &up = view.axes.basis.y, &travel = view.axes.basis.depth;
        Four const zero = all(T(0)), one = all(T(1)), two = all(T(2));
        if (view.clip.depth == DepthOrder::one_to_zero) {
            Four const scale = one / (depth.to - depth.from);
            return {times(zero - scale, travel), depth.to * scale};
        }
        Four const scale = one / seen.or_one(ends.deepest(depth.from - depth.room));
        Row const z{times(scale, travel), zero - depth.from * scale};
        if (view.clip.depth != DepthOrder::minus_one_to_one) return z;
        return {times(two * scale, travel) + times(zero - warp.slope, up), z.offset * two - warp.offset};
    }

    // Everything about the maps but their matrices, which have been written; those that show nothing are taken back.
    [[gnu::always_inline]] void conclude(Seen const& seen, Depth const& depth, Four const& steepest,
                                         bool const (&finite)[4]) const noexcept {
        for (int i = 0; i < count; ++i) {
            ShadowMap<T>& map = *maps[i];
            map.clip = view.clip;
            map.faults = view.faults;
            map.w_min = T(0);
            map.visible = false;
            bool const body = seen.lo[i] <= seen.hi[i];
            if (body && !view.flat && view.axes.fade * strength[i] == T(0)) map.faults |= Fault::warp_faded;
            if (body && !view.flat && !(begin[i] > T(0))) map.faults |= Fault::near_clamped;
            if (!body || !(depth.caster[i] <= depth.lowest[i])) {
                map.clip_from_world = nowhere<T>();
                continue;
            }
            if (!finite[i]) {
                map.clip_from_world = nowhere<T>();
                map.faults |= Fault::precision_lost;
                continue;
            }
            if (steepest[i] > T(1)) map.faults |= Fault::precision_lost;
            map.w_min = T(0.5);
            map.visible = true;
        }
    }

    [[gnu::always_inline]] void operator()() const noexcept {
        EdgesInLight<T> const edges(view.seen, begin, end);
        KeptEdges<T> kept;
        Seen const seen = see(edges, kept);
        Warp const warp = warp_for(seen);
        WarpedEnds<T> const ends(edges, kept, warp.slope, warp.offset);
        Sides const of = sides_of(seen, warp, ends);
        Depth const depth = depth_of(seen, warp, of);

        Row const x = x_row(warp, of), y = y_row(seen, warp, of), z = z_row(seen, warp, ends, depth);
        Row const w{times(warp.slope, view.axes.basis.y), warp.offset};
        bool finite[4];
        write_rows(x, y, z, w, view.eye, count, maps, finite);
        // Texels that the last bit of the eye's place makes.
        auto const squared = [](Vectors<Four> const& v) { return v.x * v.x + v.y * v.y + v.z * v.z; };
        Four const steepest =
            root(largest(squared(x.normal), squared(y.normal))) * all(eps * glm::length(view.eye) * view.size);
        conclude(seen, depth, steepest, finite);
    }
};

}  // namespace detail
}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/slice_warps.hpp ========
//
// All slices of a view at once, each cut down to the receivers and warped (warp.hpp): what simple_perspective_map gives
// for each slice, some forty times as fast. For cascades under a low sun; fit_cascades calls it for CascadeFit::warped.
//
// Source: that of warp.hpp; four_warps.hpp says how. Departure: every plane is 16 epsilon of the view's reach farther
// out, since edges are bounded one by one.

namespace shadowmath {
inline namespace v0 {
namespace detail {

// What warps are made from, checked and mended.
template <class T>
struct WarpInputs {
    ViewVolume<T> const& view;
    Vec3<T> travel;  // unit to the last bits
    Faults faults;   // of every map
    int map_size;
    T margin_texels;
    ClipSpace clip;
};

// False, and nothing written, where the numbers are none for it: then each map is to be made alone. `strengths`: of
// each map, in [0, 2].
template <class T>
[[nodiscard]] inline bool warp_slices(WarpInputs<T> const& in, SliceRange<T> const* ranges, T const* strengths,
                                      int count, Aabb<T> const& casters, Aabb<T> const& receivers,
                                      ShadowMap<T>* const* maps) noexcept {
    WarpsOfView<T> view;
    view.axes = warp_axes(in.view.pose, in.travel);
    view.seen.pose = &in.view.pose;
    if (!look(view.axes.basis, in.view, view.seen.lit) ||
        !look_at_box(in.view, ranges[count - 1].end, receivers, view.seen))
        return false;
    view.eye = in.view.pose.position;
    view.casters = {casters.lo - view.eye, casters.hi - view.eye};
    view.faults = in.faults;
    view.size = T(in.map_size);
    T const margin = in.margin_texels > T(0) ? in.margin_texels : T(0);
    view.margin = margin / (view.size - T(2) * margin);
    view.clip = in.clip;
    view.flat = in.view.kind == ViewKind::orthographic;
    for (int start = 0; start < count; start += 4) {
        int const left = count - start < 4 ? count - start : 4;
        // The last slice once more in the places that are left.
        T begin[4], end[4], strength[4];
        for (int i = 0; i < 4; ++i) {
            int const at = start + (i < left ? i : left - 1);
            begin[i] = ranges[at].begin, end[i] = ranges[at].end, strength[i] = strengths[at];
        }
        run_widely(FourWarps<T>{view, Lanes<T>::of(begin[0], begin[1], begin[2], begin[3]),
                                Lanes<T>::of(end[0], end[1], end[2], end[3]),
                                Lanes<T>::of(strength[0], strength[1], strength[2], strength[3]), left, maps + start});
    }
    return true;
}

}  // namespace detail

// maps[i] is what simple_perspective_map gives for slice i, of splits that fade into each other by `blend` (slice.hpp):
// every receiver in it and every caster above them inside, `margin_texels` from the sides, w > 0 on all of them. It
// differs from that by no more than planes do that are 256 epsilon of the view's reach and of its place apart; where
// casters reach farther than ten times the receivers, depth may begin a thousandth of that sooner. Bit i of the result:
// map i is visible. Writes splits.count maps. A spot, the other rules of WarpOptions and what lies beyond 1e12 m are
// served map by map.
template <class T>
[[nodiscard]] inline std::uint32_t fit_slice_warps(ViewVolume<T> const& view, Light<T> const& light,
                                                   Splits<T> const& splits, T const& blend, Aabb<T> const& casters,
                                                   Aabb<T> const& receivers, WarpOptions<T> const& options,
                                                   ClipSpace clip, ShadowMap<T>* maps) noexcept {
    if (splits.count < 1 || splits.count > max_splits) return 0;
    if (!all_finite(splits.plane, splits.count + 1)) {
        for (int i = 0; i < splits.count; ++i) {
            maps[i] = {};
            maps[i].clip = clip;
            maps[i].faults = Fault::not_finite;
        }
        return 0;
    }
    bool const usable_blend = all_finite(&blend, 1);
    SliceRange<T> ranges[max_splits];
    T strengths[max_splits];
    for (int i = 0; i < splits.count; ++i) ranges[i] = slice_range(splits, i, usable_blend ? blend : T(0));
    bool const plain = light.kind == LightKind::directional && options.rule == WarpRule::by_strength &&
                       all_finite(&options.strength, 1) && all_finite(&options.focus_metres, 1) &&
                       all_finite(&options.coefficient, 1) && detail::in_range(splits);
    bool done = false;
    if (plain) {
        ShadowMap<T>* each[max_splits];
        T const strength = glm::clamp(options.strength, T(0), T(2));
        for (int i = 0; i < splits.count; ++i) strengths[i] = strength, each[i] = maps + i;
        ViewVolume<T> const seen = slice(view, {ranges[0].begin, T(0), ranges[splits.count - 1].end});
        Door<T> const door = shadowmath::door(seen, light, casters, receivers, options.map_size, options.margin_texels);
        Faults const clamped = strength != options.strength ? Faults(Fault::clamped_option) : Faults{};
        detail::WarpInputs<T> const in{door.view,        door.light.direction,  door.faults | clamped,
                                       options.map_size, options.margin_texels, clip};
        done = !door.stop && detail::warp_slices(in, ranges, strengths, splits.count, casters, receivers, each);
    }
    std::uint32_t visible = 0;
    for (int i = 0; i < splits.count; ++i) {
        if (!done) maps[i] = simple_perspective_map(slice(view, ranges[i]), light, casters, receivers, options, clip);
        visible |= maps[i].visible ? 1u << i : 0u;
    }
    return visible;
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/texel_grid.hpp ========
//
// Why shadows stand still: every map of a sphere's size is a window of one endless grid of texels that is fixed in the
// world, and moves over it in whole texels. Shadow edges then never shimmer when the camera moves or turns, as long as
// the light, the map's size and the sphere's radius stay the same.
//
//   . . . . . . . .        the grid: texel (i, j) covers [i, i + 1) x [j, j + 1) times texel_metres, in light space
//   . . +-----+ . .        the window: map_size texels from (x, y), which are 64-bit integers
//   . . |  o  | . .        the sphere's centre, never more than half a texel from the window's
//   . . +-----+ . .
//
// Budget: the window may stand half a texel off on either side, and `margin_texels` are the filter's, so
// texel = 2 R / (map_size - 2 margin - 1). The plain 2 R / map_size cuts the sphere.
//
// Source: Valient, "Stable rendering of cascaded shadow maps", ShaderX6 (2008). Departures: integer origins, the
// budget, and no matrix that rounds on the way.
//
// How far from the origin: a point keeps its place in its texel to 1/64 within 2^15 texels of the world origin in float
// (300 m with centimetre texels) and 2^44 in double (1e11 m). Beyond: precision_lost. Rebase, or use double.

namespace shadowmath {
inline namespace v0 {

template <class T>
struct TexelGrid {
    LightBasis<T> basis;
    std::int64_t x = 0;  // lower-left texel of the window, texels from the world origin in light space
    std::int64_t y = 0;
    T texel_metres = T(1);
    int map_size = 1;  // texels along a side of the window
    Faults faults;
    bool visible = false;  // false: no window, and no map from it
};

// The window of map_size texels whose middle is nearest to `center` while its corner is a whole multiple of
// `step_texels`: 1, or the texels of a page (clipmap.hpp). So the centre is at most half a step off. Not visible:
// arguments that are not finite, or not positive, or out of the reach of the scalar type.
template <class T>
[[nodiscard]] inline TexelGrid<T> grid_window(LightBasis<T> const& basis, Vec3<T> const& center, T const& texel_metres,
                                              int map_size, int step_texels = 1) noexcept {
    TexelGrid<T> grid;
    if (!all_finite(center) || !all_finite(&texel_metres, 1)) grid.faults |= Fault::not_finite;
    if (!detail::has_unit_axes(basis)) grid.faults |= Fault::bad_pose;
    if (map_size < 1 || step_texels < 1) grid.faults |= Fault::map_too_small;
    if (grid.faults.any() || !(texel_metres >= detail::least_metres<T>)) return grid;
    // Double for float too: the rounding to whole texels then adds nothing to what the inputs have lost.
    using Exact = decltype(T() + double());
    Exact const step = Exact(step_texels);
    auto const lower_left = [&](Vec3<T> const& axis) {
        Exact const at = glm::dot(Vec3<Exact>(axis), Vec3<Exact>(center));
        return step * std::floor((at / Exact(texel_metres) - Exact(map_size) / 2) / step + Exact(0.5));
    };
    Exact const x = lower_left(basis.x), y = lower_left(basis.y);
    Exact const reach = std::fmax(std::abs(x), std::abs(y)) + Exact(map_size);
    // Four roundings of a coordinate lie between a world point and its texel: 2^-6 / 4.
    if (!(reach * Exact(std::numeric_limits<T>::epsilon()) <= Exact(1) / 256)) grid.faults |= Fault::precision_lost;
    constexpr Exact whole_numbers = Exact(std::int64_t(1) << 52);
    if (!(reach < whole_numbers)) return grid;
    grid.basis = basis;
    grid.x = static_cast<std::int64_t>(x);
    grid.y = static_cast<std::int64_t>(y);
    grid.texel_metres = texel_metres;
    grid.map_size = map_size;
    grid.visible = true;
    return grid;
}

// Metres of a texel with which a window holds this sphere wherever its centre is, and `margin_texels` around it.
template <class T>
[[nodiscard]] inline T texel_for(T radius, int map_size, T margin_texels) noexcept {
    // Up by the roundings of this line and of the window's own extent.
    return radius / (usable_texels(map_size, margin_texels) - T(1)) *
           (T(2) + T(16) * std::numeric_limits<T>::epsilon());
}

// The window holds the sphere and `margin_texels` texels around it. Its place is a whole number of texels, its texel
// the same bits for the same radius. A radius of 0 (no slice) is not visible and no fault.
template <class T>
[[nodiscard]] inline TexelGrid<T> texel_grid(LightBasis<T> const& basis, Sphere<T> const& sphere, int map_size,
                                             T margin_texels) noexcept {
    TexelGrid<T> none;
    none.faults = faults_of_margin(map_size, margin_texels);
    if (!all_finite(sphere.center) || !all_finite(&sphere.radius, 1)) none.faults |= Fault::not_finite;
    if (!detail::has_unit_axes(basis)) none.faults |= Fault::bad_pose;
    if (none.faults.has(Fault::not_finite) || none.faults.has(Fault::map_too_small) ||
        none.faults.has(Fault::bad_pose) || !(sphere.radius > T(0)) || !(sphere.radius <= detail::farthest_metres<T>))
        return none;
    TexelGrid<T> grid = grid_window(basis, sphere.center, texel_for(sphere.radius, map_size, margin_texels), map_size);
    grid.faults |= none.faults;
    return grid;
}

// A size for what is `needed` that a slow zoom does not change in every frame: the previous one, while that is enough
// and not a quarter too much; else the least eighth of an octave, 2^(k/8), that is enough. At least `needed`, and at
// most 5/4 of it. `needed` itself where it is not positive, or nothing came before (a previous of 0).
template <class T>
[[nodiscard]] inline T held_size(T const& needed, T const& previous) noexcept {
    if (!all_finite(&needed, 1) || !all_finite(&previous, 1) || !(needed > T(0)) || !(previous > T(0))) return needed;
    if (needed <= previous && previous <= needed * T(1.25)) return previous;
    T const steps = std::ceil(std::log2(needed) * T(8));
    T const size = std::exp2(steps / T(8)), next = std::exp2((steps + T(1)) / T(8));
    T const held = size >= needed ? size : next;
    return all_finite(&held, 1) && held <= needed * T(1.25) ? held : needed;
}

// The window as a box, for depth_range. Its sides are rounded to T, which clip_from_world below does not do.
template <class T>
[[nodiscard]] inline LightBox<T> on_grid(TexelGrid<T> const& grid, T depth_lo, T depth_hi) noexcept {
    using Exact = decltype(T() + double());
    Exact const texel = Exact(grid.texel_metres);
    auto const side = [texel](std::int64_t index) { return T(Exact(index) * texel); };
    return {grid.basis, Vec2<T>(side(grid.x), side(grid.y)),
            Vec2<T>(side(grid.x + grid.map_size), side(grid.y + grid.map_size)), depth_lo, depth_hi};
}

// The window fills the map; depth_lo goes to the near end and depth_hi to the far one. Offsets come from the integers,
// not from metres, so texel (x, y) of the grid is texel (0, 0) of the map however far the origin is. nowhere() where
// the grid is not visible, or the depths are not increasing.
template <class T>
[[nodiscard]] inline Mat4<T> clip_from_world(TexelGrid<T> const& grid, T const& depth_lo, T const& depth_hi,
                                             ClipSpace clip) noexcept {
    bool const finite = all_finite(&depth_lo, 1) && all_finite(&depth_hi, 1);
    if (!grid.visible || !finite || !(std::fmax(std::abs(depth_lo), std::abs(depth_hi)) <= T(1e24)) ||
        !(depth_hi - depth_lo >= detail::least_metres<T>))
        return nowhere<T>();
    using Exact = decltype(T() + double());
    Exact const size = Exact(grid.map_size);
    auto const row_of = [](Vec3<T> const& axis, Exact scale, Exact offset) {
        return Vec4<T>(Vec3<T>(Vec3<Exact>(axis) * scale), T(offset));
    };
    auto const side = [&](Vec3<T> const& axis, std::int64_t index) {
        return row_of(axis, 2 / (size * Exact(grid.texel_metres)), -Exact(2 * index + grid.map_size) / size);
    };
    Exact const depth_scale = 1 / (Exact(depth_hi) - Exact(depth_lo));
    Mat4<T> const canonical = from_rows(side(grid.basis.x, grid.x), side(grid.basis.y, grid.y),
                                        row_of(grid.basis.depth, depth_scale, -Exact(depth_lo) * depth_scale),
                                        Vec4<T>(T(0), T(0), T(0), T(1)));
    return clip_from_canonical<T>(clip) * canonical;
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/clipmap.hpp ========
//
// Concentric still windows around the eye, each with texels twice as large as the one before, cut into pages: what a
// virtual shadow map is, but for the page table. Every page is a square of the endless grid with a name that does not
// depend on the camera; what was drawn into it stays right until the light or a caster moves.
//
//   +---------------+      level l: texels of finest * 2^l metres; the window moves in whole pages (grid_window)
//   |   +-------+   |      a page of level l + 1 is exactly four pages of level l
//   |   | +---+ |   |
//   |   | | e | |   |      a receiver takes the finest level that holds it and whose texel its pixel can tell apart
//   |   | +---+ |   |
//   |   +-------+   |      Use it where the virtual texture is; for a few maps in fixed memory cascades are simpler.
//   +---------------+
//
// Source: Sakmary, Ryan, Hall, Lustri, "Virtual shadow maps", GPU Zen 3 (2024), and Epic's documentation of its own,
// from which the sizes are; the selection of the level is derived here.

namespace shadowmath {
inline namespace v0 {

inline constexpr int max_clip_levels = 24;

template <class T>
struct ClipmapOptions {
    int levels = 12;              // 1 to max_clip_levels
    int map_size = 4096;          // texels along a side of each level's window, a multiple of page_texels
    int page_texels = 128;        // along a side of a page
    T finest_metres = T(0x1p-8);  // of a texel of level 0; a power of two keeps all texels exact
};

template <class T>
struct Clipmap {
    std::array<TexelGrid<T>, max_clip_levels> level;
    int count = 0;  // 0: nothing
    int page_texels = 1;
    Faults faults;
};

// A page of one level: [x, x + 1) x [y, y + 1) pages from the world origin in light space.
struct Page {
    int level = -1;  // -1: none
    std::int64_t x = 0;
    std::int64_t y = 0;

    friend constexpr bool operator==(Page const& a, Page const& b) noexcept {
        return a.level == b.level && a.x == b.x && a.y == b.y;
    }
};

// Windows around `center`, which is no more than half a page off the middle of each. The same corner to the bit as long
// as the centre stays within the same half page. A map_size that is no multiple of the page is lowered to one
// (clamped_option). precision_lost: the finest levels are too fine to be still in this scalar type at this distance
// from the origin; where not even their places can be counted, there is no level.
template <class T>
[[nodiscard]] inline Clipmap<T> clipmap(LightBasis<T> const& basis, Vec3<T> const& center,
                                        ClipmapOptions<T> const& options) noexcept {
    Clipmap<T> map;
    int const page = options.page_texels < 1 ? 1 : options.page_texels;
    int const size = options.map_size / page * page;
    int const levels = options.levels < 1 ? 1 : (options.levels > max_clip_levels ? max_clip_levels : options.levels);
    if (page != options.page_texels || size != options.map_size || levels != options.levels)
        map.faults |= Fault::clamped_option;
    map.page_texels = page;
    T texel = options.finest_metres;
    for (int i = 0; i < levels; ++i, texel += texel) {
        TexelGrid<T> const grid = grid_window(basis, center, texel, size, page);
        map.faults |= grid.faults;
        if (!grid.visible) break;
        map.level[static_cast<std::size_t>(map.count++)] = grid;
    }
    return map;
}

// Metres that a pixel of the picture covers at this eye depth, upright and facing the eye.
template <class T>
[[nodiscard]] inline T pixel_metres(ViewVolume<T> const& view, T picture_height, T depth) noexcept {
    T const spread = view.kind == ViewKind::perspective ? depth : T(1);
    return (view.top - view.bottom) * spread / picture_height;
}

// The page of a level in which a world point lies; where the camera is does not enter.
template <class T>
[[nodiscard]] inline Page page_at(Clipmap<T> const& map, int level, Vec3<T> const& point) noexcept {
    if (level < 0 || level >= map.count || !all_finite(point)) return {};
    using Exact = decltype(T() + double());
    TexelGrid<T> const& grid = map.level[static_cast<std::size_t>(level)];
    Exact const page_metres = Exact(grid.texel_metres) * Exact(map.page_texels);
    Exact const x = std::floor(glm::dot(Vec3<Exact>(grid.basis.x), Vec3<Exact>(point)) / page_metres);
    Exact const y = std::floor(glm::dot(Vec3<Exact>(grid.basis.y), Vec3<Exact>(point)) / page_metres);
    constexpr Exact whole_numbers = Exact(std::int64_t(1) << 52);
    if (!(std::abs(x) < whole_numbers && std::abs(y) < whole_numbers)) return {};
    return {level, static_cast<std::int64_t>(x), static_cast<std::int64_t>(y)};
}

// Whether the page is in its level's window, and `margin_pages` from its sides.
template <class T>
[[nodiscard]] inline bool holds(Clipmap<T> const& map, Page const& page, int margin_pages = 0) noexcept {
    if (page.level < 0 || page.level >= map.count) return false;
    TexelGrid<T> const& grid = map.level[static_cast<std::size_t>(page.level)];
    std::int64_t const size = grid.map_size / map.page_texels, margin = margin_pages;
    std::int64_t const x = page.x - grid.x / map.page_texels, y = page.y - grid.y / map.page_texels;
    return x >= margin && y >= margin && x < size - margin && y < size - margin;
}

// The page that serves a receiver whose pixel covers `pixel` metres: of the finest level that holds it and whose next
// finer texel is no more than half a pixel, so that a texel is at most a pixel and more than half of one wherever the
// window's size does not decide. Level -1: no window holds it.
template <class T>
[[nodiscard]] inline Page page_for(Clipmap<T> const& map, Vec3<T> const& point, T const& pixel,
                                   int margin_pages = 0) noexcept {
    if (!all_finite(&pixel, 1)) return {};
    for (int i = 0; i < map.count; ++i) {
        bool const too_fine = i + 1 < map.count && map.level[static_cast<std::size_t>(i + 1)].texel_metres <= pixel;
        Page const page = page_at(map, i, point);
        if (!too_fine && holds(map, page, margin_pages)) return page;
    }
    return {};
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/schedule.hpp ========
//
// Which maps to draw in a frame when not all of them can be: the nearest in every frame, the next in every second, then
// every fourth, and never more than two in one.
//
//   frame   0 1 2 3 4 5 6 7 8 9 ...
//   map 0   x x x x x x x x x x
//   map 1   . x . x . x . x . x
//   map 2   . . x . . . x . . .      the ruler: map i where bit i - 1 is the lowest that is set in the frame's number;
//   map 3   x . . . x . . . x .      the last map takes what is left over
//
// A map that is not drawn keeps its old matrix, and the receivers must be drawn with that one. Let its slice reach
// farther by what the camera can do in `frames_between`. New maps, and those whose light has moved, are due at once.

namespace shadowmath {
inline namespace v0 {

// Frames from one drawing of this map to the next.
[[nodiscard]] constexpr int frames_between(int map, int count) noexcept {
    if (map <= 0 || count <= 1) return 1;
    int const power = map < count - 1 ? map : count - 2;
    return 1 << (power < 30 ? power : 30);
}

// Bit i: map i is due. In any frames_between(i, count) frames in a row each map is due exactly once, and in no frame
// are there more than two. `count` up to 32; `changed`: maps that are due in any case.
[[nodiscard]] constexpr std::uint32_t maps_due(std::uint64_t frame, int count, std::uint32_t changed = 0) noexcept {
    std::uint32_t const all = count <= 0 ? 0u : (count >= 32 ? ~0u : (1u << count) - 1u);
    std::uint32_t due = 1u;
    int map = 1;
    for (std::uint64_t rest = frame; map < count - 1 && (rest & 1u) == 0; rest >>= 1) ++map;
    if (count > 1) due |= 1u << (map < 31 ? map : 31);
    return (due | changed) & all;
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/scroll.hpp ========
//
// What is left of a still map when its window has moved: all but a strip on one or two sides. Far cascades move some
// texels in many frames; draw only what is new, and keep the rest.
//
//   before        after            fresh: the texels of the new window that the old one did not have
//   +-------+     +-------+
//   |       |     |     |2|        Keep texels where they are and address them modulo the map's size (wrapped), or copy
//   |   +---|---+ |-----|2|        the old map by (-x, -y) texels.
//   |   |   | n | |1 1 1|2|
//   +---|---+ n |
//       +-------+                  Valid as long as light, texel, depth range and casters are what they were. Take the
//                                  depth range in steps (in_steps), or it changes with every move.
//
// Source: Losasso and Hoppe, "Geometry clipmaps", SIGGRAPH 2004 (toroidal update); for shadows engines keep it to
// themselves.

namespace shadowmath {
inline namespace v0 {

// Texels [x, x + width) x [y, y + height); y counts up in the picture, as the grid does.
struct TexelRect {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
};

// A few rectangles, none of them empty.
template <unsigned capacity>
struct TexelRects {
    std::array<TexelRect, capacity> at;
    int count = 0;

    constexpr void add(TexelRect const& rect) noexcept {
        if (rect.width > 0 && rect.height > 0 && count < static_cast<int>(capacity))
            at[static_cast<std::size_t>(count++)] = rect;
    }
};

struct Scroll {
    std::int64_t x = 0;  // texels that the window has moved; 0 where nothing is kept
    std::int64_t y = 0;
    TexelRects<2> fresh;  // in the new window, disjoint: 0 where nothing is new
    bool kept = false;    // false: all is new
};

// The fresh rectangles and what is kept cover the new window exactly. Nothing is kept where basis, texel or size differ
// in a bit, or the windows do not meet. A window that is not visible has nothing fresh.
template <class T>
[[nodiscard]] inline Scroll scroll_between(TexelGrid<T> const& before, TexelGrid<T> const& after) noexcept {
    Scroll scroll;
    if (!after.visible) return scroll;
    int const size = after.map_size;
    bool const same = before.visible && before.map_size == size && before.texel_metres == after.texel_metres &&
                      before.basis.x == after.basis.x && before.basis.y == after.basis.y &&
                      before.basis.depth == after.basis.depth;
    std::int64_t const x = after.x - before.x, y = after.y - before.y;
    if (!same || x >= size || -x >= size || y >= size || -y >= size) {
        scroll.fresh.add({0, 0, size, size});
        return scroll;
    }
    scroll.x = x;
    scroll.y = y;
    scroll.kept = true;
    int const columns = static_cast<int>(x < 0 ? -x : x), rows = static_cast<int>(y < 0 ? -y : y);
    int const first_kept = x < 0 ? columns : 0;
    scroll.fresh.add({first_kept, y < 0 ? 0 : size - rows, size - columns, rows});
    scroll.fresh.add({x < 0 ? 0 : size - columns, 0, columns, size});
    return scroll;
}

// Where a texel of the endless grid lies in a map that is addressed modulo its size: in [0, size).
[[nodiscard]] constexpr int wrapped(std::int64_t index, int size) noexcept {
    std::int64_t const rest = size > 0 ? index % size : 0;
    return static_cast<int>(rest < 0 ? rest + size : rest);
}

// A rectangle of the window as one to four rectangles of that map.
template <class T>
[[nodiscard]] inline TexelRects<4> wrapped(TexelGrid<T> const& grid, TexelRect const& rect) noexcept {
    TexelRects<4> parts;
    int const size = grid.map_size;
    if (rect.width > size || rect.height > size) return parts;
    int const x = wrapped(grid.x + rect.x, size), y = wrapped(grid.y + rect.y, size);
    int const left = rect.width < size - x ? rect.width : size - x;
    int const low = rect.height < size - y ? rect.height : size - y;
    parts.add({x, y, left, low});
    parts.add({0, y, rect.width - left, low});
    parts.add({x, 0, left, rect.height - low});
    parts.add({0, 0, rect.width - left, rect.height - low});
    return parts;
}

// Whether a map needs no new drawing for the camera's sake: its matrix is the same to the last bit.
template <class T>
[[nodiscard]] inline bool unchanged(ShadowMap<T> const& before, ShadowMap<T> const& after) noexcept {
    return before.visible == after.visible && before.clip.depth == after.clip.depth &&
           before.clip.ndc_y == after.clip.ndc_y && before.clip_from_world == after.clip_from_world;
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/aliasing.hpp ========
//
// The theory that the footprint is measured against: perspective aliasing in closed form, for light from straight
// above (at a right angle to the view) and a map fitted to the eye depths [n, f] of a symmetric view.
//
//   along   E(z)  = (1/z) dz/ds      eye depth that a step s of the map covers, over the eye depth
//   across  Ex(z)                    the same beside the view axis, 1 where the view's far end fills the map
//
// times pixels_per_texel these are eye pixels per texel. Source: Wimmer, Scherzer, Purgathofer, EGSR 2004, and Lloyd
// et al., EGSR 2006; derived anew here, since the latter give bounds where these are exact. For tilted light replace
// n and f by n / sin(tilt) and n / sin(tilt) + D, D the length of the body across the light.
//
// Every function is 0 for arguments outside its range: 0 < n < f, z > 0, centre > 0.

namespace shadowmath {
inline namespace v0 {
namespace closed_form {

template <class T>
[[nodiscard]] inline bool is_range(T const& z_near, T const& z_far) noexcept {
    return all_finite(&z_near, 1) && all_finite(&z_far, 1) && z_near > T(0) && z_near < z_far;
}

template <class T>
[[nodiscard]] inline bool is_positive(T const& value) noexcept {
    return all_finite(&value, 1) && value > T(0);
}

// Eye pixels per texel for an error of 1 on a surface at half a right angle to both eye and light.
template <class T>
[[nodiscard]] inline T pixels_per_texel(T eye_pixels, T tan_half_fov, T map_texels) noexcept {
    if (!is_positive(tan_half_fov) || !is_positive(map_texels) || !is_positive(eye_pixels)) return T(0);
    return eye_pixels / (T(2) * tan_half_fov * map_texels);
}

// One map over [n, f], not warped: worst at the near end, f/n - 1.
template <class T>
[[nodiscard]] inline T uniform_along(T z, T z_near, T z_far) noexcept {
    return is_range(z_near, z_far) && is_positive(z) ? (z_far - z_near) / z : T(0);
}

template <class T>
[[nodiscard]] inline T uniform_across(T z, T z_near, T z_far) noexcept {
    return is_range(z_near, z_far) && is_positive(z) ? z_far / z : T(0);
}

// The same error everywhere: the least that any map of [n, f] can have at worst.
template <class T>
[[nodiscard]] inline T logarithmic_along(T z_near, T z_far) noexcept {
    return is_range(z_near, z_far) ? std::log(z_far / z_near) : T(0);
}

// A perspective warp with its centre of projection `centre` metres before the near end.
template <class T>
[[nodiscard]] inline T warped_along(T z, T z_near, T z_far, T centre) noexcept {
    if (!is_range(z_near, z_far) || !is_positive(z) || !is_positive(centre)) return T(0);
    T const length = z_far - z_near, w = z - z_near + centre;
    return length * (w / centre) * (w / (centre + length)) / z;
}

// Sound for centre >= n; nearer, the view's near end would no longer fit into the map.
template <class T>
[[nodiscard]] inline T warped_across(T z, T z_near, T z_far, T centre) noexcept {
    if (!is_range(z_near, z_far) || !is_positive(z) || !is_positive(centre)) return T(0);
    return z_far / z * ((z - z_near + centre) / (centre + z_far - z_near));
}

// The larger of the two ends, between which the error has no maximum.
template <class T>
[[nodiscard]] inline T warped_worst(T z_near, T z_far, T centre) noexcept {
    T const at_near = warped_along(z_near, z_near, z_far, centre);
    T const at_far = warped_along(z_far, z_near, z_far, centre);
    return at_near > at_far ? at_near : at_far;
}

// The centre for which both ends are alike and the worst error is least: n + sqrt(n f).
template <class T>
[[nodiscard]] inline T best_centre(T z_near, T z_far) noexcept {
    return is_range(z_near, z_far) ? z_near + std::sqrt(z_near) * std::sqrt(z_far) : T(0);
}

// Worst error along the view of `count` maps over logarithmic splits.
template <class T>
[[nodiscard]] inline T split_uniform_worst(T z_near, T z_far, int count) noexcept {
    return is_range(z_near, z_far) && count > 0 ? std::expm1(std::log(z_far / z_near) / T(count)) : T(0);
}

template <class T>
[[nodiscard]] inline T split_warped_worst(T z_near, T z_far, int count) noexcept {
    return is_range(z_near, z_far) && count > 0 ? T(2) * std::sinh(std::log(z_far / z_near) / T(2 * count)) : T(0);
}

template <class T>
[[nodiscard]] inline T split_logarithmic_worst(T z_near, T z_far, int count) noexcept {
    return count > 0 ? logarithmic_along(z_near, z_far) / T(count) : T(0);
}

// Eye pixels per texel, as an area, of a view-dependent map as fine as the picture (the map is Kwon's, 2002; the
// formula is derived here): 1 on the plane itself. The four projections are lengths along unit normals; w_point and
// w_plane are the eye depths of the point and of its image on the plane along the light.
template <class T>
[[nodiscard]] inline T plane_map_area(T point_normal_to_eye, T plane_normal_to_eye, T point_normal_to_light,
                                      T plane_normal_to_light, T w_point, T w_plane) noexcept {
    for (T const divisor : {w_point, plane_normal_to_eye, point_normal_to_light})
        if (!(std::abs(divisor) > T(0))) return T(0);
    T const bend = w_plane / w_point;
    T const tilt = (point_normal_to_eye / plane_normal_to_eye) * (plane_normal_to_light / point_normal_to_light);
    T const result = std::abs(tilt * bend * bend * bend);
    return is_positive(result) ? result : T(0);
}

}  // namespace closed_form
}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/bias.hpp ========
//
// How much a receiver must be moved toward the light so that it does not shadow itself: given in texels or metres,
// turned into depth of a particular map, the filter's kernel included. Fields go to the shader, which computes
//
//   bias = constant + per_inverse_w / w + slope_texels * (|slope.x| + |slope.y|)
//
// with slope the change of depth per texel on the receiver's plane, less the map's own lean where taps follow the
// plane. It is an amount of stored depth in favour of light, not negative on anything that the map holds: subtract it
// where depth grows away from the light, add it where it is reversed.
//
// Why 1/w: by the law of shadow maps a metre along a directional light adds k to clip depth and nothing to the other
// three coordinates, in a warp or a view-dependent map as in a plain one. So a bias in metres is constant before the
// division.
//
// Source: the slope on the receiver's plane is that of Isidoro, GDC 2006, and Dou et al., I3D 2014; taken from the
// normal instead of screen derivatives, which are wrong at every silhouette. The normal offset is Holbert's, GDC
// 2011.

namespace shadowmath {
inline namespace v0 {

template <class T>
struct DepthSlope {
    T x = T(0);  // stored depth gained per texel
    T y = T(0);
};

// Exact for every projective map, because those take planes to planes: on the plane, depth at a texel is depth at the
// point + slope . (texel - point). Each axis is clamped to [-limit, limit], which is also its value on a plane that
// the light grazes. Zero where the map does not hold the point or the normal has no length; never NaN.
template <class T>
[[nodiscard]] inline DepthSlope<T> slope(ShadowMap<T> const& map, int map_size, Vec3<T> const& point,
                                         Vec3<T> const& normal, T limit) noexcept {
    if (!all_finite(map.clip_from_world)) return {};
    Mat4<T> const texture = texture_from_world(map);
    Projected<T> const at = projected(texture, point, map.w_min);
    Tangents<T> const plane = tangents(normal);
    if (!at.in_front || !plane.ok || map_size < 1 || !all_finite(&limit, 1) || !(limit > T(0))) return {};
    Vec3<T> s = gain_along(texture, at, plane.s);
    Vec3<T> t = gain_along(texture, at, plane.t);
    // Over the largest of them, the product of two gains neither under- nor overflows.
    T largest = T(0);
    for (T const gain : {s.x, s.y, t.x, t.y}) largest = std::abs(gain) > largest ? std::abs(gain) : largest;
    if (!(largest > T(0)) || !all_finite(s) || !all_finite(t)) return {};
    s = s / largest;
    t = t / largest;
    T const area = (s.x * t.y - s.y * t.x) * T(map_size);
    return {bounded_quotient(s.z * t.y - s.y * t.z, area, limit), bounded_quotient(s.x * t.z - s.z * t.x, area, limit)};
}

// The slope of the plane across the light: 0 in an affine map; in any other what the map itself adds to the slope of
// every receiver. No part of it makes a surface shadow itself, as long as each tap is compared with the plane at that
// tap.
template <class T>
[[nodiscard]] inline DepthSlope<T> lean(ShadowMap<T> const& map, int map_size, Vec3<T> const& point, T limit) noexcept {
    if (!all_finite(map.clip_from_world)) return {};
    Mat4<T> const texture = texture_from_world(map);
    Projected<T> const at = projected(texture, point, map.w_min);
    if (!at.in_front) return {};
    // Along a light ray neither u nor v changes: it is at a right angle to both of these.
    Vec3<T> const w(row(texture, 3));
    Vec3<T> const u = Vec3<T>(row(texture, 0)) - at.at.x * w;
    Vec3<T> const v = Vec3<T>(row(texture, 1)) - at.at.y * w;
    return slope(map, map_size, point, glm::cross(safe_normalize(u).direction, safe_normalize(v).direction), limit);
}

// The k of the law: matrix * light = (0, 0, k, 0). For a directional light it is the clip depth that a metre along
// the light adds. Canonical, so positive in every convention; 0 for a light or a map that cannot be used.
template <class T>
[[nodiscard]] inline T depth_gain(ShadowMap<T> const& map, Light<T> const& light) noexcept {
    if (!all_finite(map.clip_from_world) || unusable(light)) return T(0);
    Mat4<T> const canonical = canonical_from_clip<T>(map.clip) * map.clip_from_world;
    T const gain = glm::dot(row(canonical, 2), homogeneous(light));
    return all_finite(&gain, 1) ? std::abs(gain) : T(0);
}

// Stored depth between a point and itself `metres` (>= 0) nearer to the light: exact for any map of this light. The
// way toward a spot is at most half of the distance to it. 0 where the map does not hold the point.
template <class T>
[[nodiscard]] inline T depth_shift(ShadowMap<T> const& map, Light<T> const& light, Vec3<T> const& point,
                                   T metres) noexcept {
    Projected<T> const at = projected(map.clip_from_world, point, map.w_min);
    if (!at.in_front || !all_finite(&metres, 1) || !(metres > T(0)) || unusable(light)) return T(0);
    T way = metres;
    if (light.kind == LightKind::spot) {
        // (p, 1) + s * l / (1 - s) is the point pulled by the share s of the way: clip z gains k s / (1 - s).
        T const distance = safe_normalize(point - light.position).length;
        T const pulled = metres < distance * T(0.5) ? metres : distance * T(0.5);
        way = bounded_quotient(pulled, distance - pulled, T(1));
    }
    T const shift = depth_gain(map, light) * way / at.w;
    return all_finite(&shift, 1) && shift < T(1) ? shift : T(1);
}

// What the shader needs of one map.
template <class T>
struct MapBias {
    T constant = T(0);
    T per_inverse_w = T(0);
    T slope_texels = T(0);
    T slope_limit = T(1);  // the largest change of depth a texel that slope terms believe
};

template <class T>
struct BiasOptions {
    T flat_texels = T(0.75);  // texels of a plane at half a right angle to the light, whatever the receiver's slope:
                              // for steps smaller than a texel, and for curved surfaces
    T texels = T(0.1);        // texels of the receiver's own slope: for surfaces that are not quite their planes
    T metres = T(0);          // along the light, on top
    int filter_radius = 1;    // half width of the kernel, texels
    bool tap_plane = true;    // each tap is compared with the plane's depth there; false: the kernel goes into
                              // slope_texels
    T steepest = T(20);       // tangent of the angle between light and normal beyond which slopes are cut
    T depth_step = T(1) / T(1 << 23);  // of the stored format: 2^-23 for float and for 24 bits, 2^-16 for 16 bits
};

// The bias of one shader invocation: `w` is the receiver's clip w, `at_receiver` its slope.
template <class T>
[[nodiscard]] inline T depth_bias(MapBias<T> const& bias, T w, DepthSlope<T> const& at_receiver) noexcept {
    if (w == T(0)) return T(0);
    T const amount = bias.constant + bias.per_inverse_w / w +
                     bias.slope_texels * (std::abs(at_receiver.x) + std::abs(at_receiver.y));
    return all_finite(&amount, 1) && amount > T(0) ? amount : T(0);
}

// Half the kernel's width and half a texel, as a stored depth is that of its texel's centre. Texels.
template <class T>
[[nodiscard]] constexpr T kernel_reach_texels(int filter_radius) noexcept {
    return (filter_radius > 0 ? T(filter_radius) : T(0)) + T(0.5);
}

// Metres to move a receiver along its unit normal before projecting it, instead of a slope bias: a plane then does
// not shadow itself, and the amount stays bounded at grazing light. `to_light` is unit; 0 for a normal along the
// light.
template <class T>
[[nodiscard]] inline T normal_offset_metres(T texel_metres, int filter_radius, Vec3<T> const& normal,
                                            Vec3<T> const& to_light) noexcept {
    if (!all_finite(normal) || !all_finite(to_light) || !all_finite(&texel_metres, 1) || !(texel_metres > T(0)))
        return T(0);
    T const sine = glm::length(glm::cross(normal, to_light));
    T const reach_metres = kernel_reach_texels<T>(filter_radius) * texel_metres;
    T const offset = T(1.41421356237309504880168872420969808L) * reach_metres * (sine < T(1) ? sine : T(1));
    return all_finite(&offset, 1) ? offset : T(0);
}

// The same for any map, warped and view-dependent ones included, whose texels differ from place to place: the least
// metres along the unit `normal` with which the plane through `point` does not shadow itself in this map. Exact for
// suns: on a plane stored depth is linear in texels, and w is linear in the metres. Of a spot to first order in the
// offset over the distance to it. At most `most_metres`, which is also its value where the map is edge-on to the plane,
// and where a warp's own w runs away from the offset; 0 where the plane faces away, or the map does not hold the point.
template <class T>
[[nodiscard]] inline T normal_offset_at(ShadowMap<T> const& map, Light<T> const& light, int map_size, int filter_radius,
                                        Vec3<T> const& point, Vec3<T> const& normal, T most_metres) noexcept {
    Projected<T> const at = projected(map.clip_from_world, point, map.w_min);
    if (!at.in_front || !all_finite(normal) || !all_finite(&most_metres, 1) || !(most_metres > T(0)) ||
        unusable(light) || !(depth_gain(map, light) > T(0)))
        return T(0);
    T const cosine = glm::dot(normal, toward(light, point));
    if (!(cosine > T(0))) return T(0);
    DepthSlope<T> const s = slope(map, map_size, point, normal, T(1e6));
    // What the kernel needs of clip depth, before the division by w.
    T const needed = kernel_reach_texels<T>(filter_radius) * (std::abs(s.x) + std::abs(s.y)) / depth_gain(map, light);
    T offset = T(0);
    if (light.kind == LightKind::directional) {
        // needed * (w + offset * gain of w) = offset / cosine
        T const gain_of_w = glm::dot(Vec3<T>(row(map.clip_from_world, 3)), normal);
        T const left = T(1) - needed * cosine * gain_of_w;
        offset = left > T(0) ? bounded_quotient(needed * cosine * at.w, left, most_metres) : most_metres;
    } else {
        // The way to the lamp, shortened by the share s, gains k s / (1 - s).
        T const distance = safe_normalize(point - light.position).length, raised = needed * at.w;
        offset = cosine * distance * bounded_quotient(raised, T(1) + raised, T(1));
    }
    return all_finite(&offset, 1) && offset < most_metres ? offset : most_metres;
}

namespace detail {

// In a map so shallow that a texel of a steep plane spans its depth a million times over, nothing can be told apart.
template <class T>
inline constexpr T steepest_slope = T(1e6);

// The most stored depth that a texel can span anywhere in the map along one axis, when w times depth changes by at most
// this per metre across the light. NDC x = X.p / W.p changes by |X - x W| / w per metre, so a texel in metres grows as
// w, its depth shrinks as 1 / w, and only the least of |X - x W| over the map is left.
template <class T>
[[nodiscard]] inline T spanned_by_texel(Mat4<T> const& canonical, int axis, int map_size, T change_per_metre) noexcept {
    Vec3<T> const w_row(row(canonical, 3)), side(row(canonical, axis));
    T const nearest = bounded_quotient(glm::dot(side, w_row), glm::dot(w_row, w_row), T(1));
    T const change = safe_normalize(side - w_row * nearest).length;
    return bounded_quotient(T(2) * change_per_metre, change * T(map_size), steepest_slope<T>);
}

// Of the two axes the one whose texels are longer.
template <class T>
[[nodiscard]] inline T steepest_texel(Mat4<T> const& canonical, int map_size, T change_per_metre) noexcept {
    return glm::max(spanned_by_texel(canonical, 0, map_size, change_per_metre),
                    spanned_by_texel(canonical, 1, map_size, change_per_metre));
}

// And the one whose texels are shorter: across a warp, where depth a texel is the same from near to far. Along it a
// texel at the far end is so long that a bias made for it would hide the contact of everything near.
template <class T>
[[nodiscard]] inline T flattest_texel(Mat4<T> const& canonical, int map_size, T change_per_metre) noexcept {
    return glm::min(spanned_by_texel(canonical, 0, map_size, change_per_metre),
                    spanned_by_texel(canonical, 1, map_size, change_per_metre));
}

// How much longer a texel is than its two sides are apart: 1 where the map's axes cross at a right angle everywhere.
// Along x, with y held, a plane's depth changes by that much more than the change of x alone tells. The worst of a
// sun's map is at a corner, since a convex function over a positive affine one has no maximum inside.
template <class T>
[[nodiscard]] inline T worst_shear(Mat4<T> const& canonical) noexcept {
    Vec3<T> const x_row(row(canonical, 0)), y_row(row(canonical, 1)), w_row(row(canonical, 3));
    T worst = T(1);
    for (T const x : {T(-1), T(1)})
        for (T const y : {T(-1), T(1)}) {
            Vec3<T> const along_x = safe_normalize(x_row - w_row * x).direction;
            Vec3<T> const along_y = safe_normalize(y_row - w_row * y).direction;
            T const sine = glm::length(glm::cross(along_x, along_y));
            worst = glm::max(worst, bounded_quotient(T(1), sine, T(1e3)));
        }
    return worst;
}

// 1 / w on the axis of a spot's map where depth is 0 and where it is 1: on the axis depth = A - k / w.
template <class T>
struct InverseW {
    T nearest = T(0);
    T farthest = T(0);
};

template <class T>
[[nodiscard]] inline InverseW<T> ends_of_axis(Mat4<T> const& canonical, Light<T> const& light, T gain) noexcept {
    Vec4<T> const axis(light.direction, T(0));
    T const w_along = glm::dot(row(canonical, 3), axis);
    if (!(w_along > T(0))) return {};
    T const at_infinity = glm::dot(row(canonical, 2), axis) / w_along;
    InverseW<T> const ends{at_infinity / gain, (at_infinity - T(1)) / gain};
    if (!all_finite(&ends.nearest, 1) || !all_finite(&ends.farthest, 1) || !(ends.nearest > T(0))) return {};
    return {ends.nearest, ends.farthest > T(0) ? ends.farthest : T(0)};
}

template <class T>
[[nodiscard]] inline bool is_affine(Mat4<T> const& matrix) noexcept {
    return row(matrix, 3) == Vec4<T>(T(0), T(0), T(0), T(1));
}

template <class T>
[[nodiscard]] inline T option(T const& value, T fallback) noexcept {
    return all_finite(&value, 1) && value >= T(0) ? value : fallback;
}

// Everything but the metres. Per metre, w times depth changes by `along` in the direction of the light, and by `across`
// on a plane at a right angle to it.
template <class T>
[[nodiscard]] inline MapBias<T> bias_of_kernel(Mat4<T> const& canonical, int map_size, T along, T across,
                                               BiasOptions<T> const& options) noexcept {
    MapBias<T> bias;
    // One step where the map is written and one where it is read. Shaders compute in float whatever T is, and a clip
    // coordinate is a sum of terms as large as its offset from the world's origin: four roundings of half an epsilon
    // when the map is written, four when it is read.
    T const rounding = T(4) * T(std::numeric_limits<float>::epsilon());
    bias.constant = T(2) * option(options.depth_step, T(0));
    bias.per_inverse_w = rounding * std::abs(canonical[3][2]);
    bias.slope_texels = option(options.texels, T(0));
    if (!options.tap_plane) bias.slope_texels += kernel_reach_texels<T>(options.filter_radius);
    if (is_affine(canonical)) {
        T const x = std::abs(canonical[3][0]), y = std::abs(canonical[3][1]);
        bias.slope_texels += rounding * (x > y ? x : y) * T(map_size) * T(0.5);
    }
    T const change = option(options.steepest, T(20)) * along + across;
    T const limit = steepest_texel(canonical, map_size, change);
    bias.slope_limit = limit > T(0) ? limit : T(1);
    return bias;
}

template <class T>
[[nodiscard]] inline MapBias<T> harmless(MapBias<T> const& bias) noexcept {
    bool const finite = all_finite(&bias.constant, 1) && all_finite(&bias.per_inverse_w, 1) &&
                        all_finite(&bias.slope_texels, 1) && all_finite(&bias.slope_limit, 1);
    return finite ? bias : MapBias<T>{};
}

}  // namespace detail

// The bias of a whole map. Of a directional light, `metres` are exact everywhere, in every technique; where w is 1
// everywhere they are part of `constant`. Of a spot the bias in depth falls as 1 / w^2, for which the shader has no
// term: the chord of that curve between the map's ends is used, at least `metres` everywhere, exact at both ends of
// the axis and more between (to first order in metres over distance). For maps of spots whose depth runs along the
// axis, as fit_spot's does; for any other, and where that is too much, use bias_at. Nothing finite to say: no bias.
template <class T>
[[nodiscard]] inline MapBias<T> bias_for(ShadowMap<T> const& map, Light<T> const& light, int map_size,
                                         BiasOptions<T> const& options) noexcept {
    T const gain = depth_gain(map, light);
    if (!(gain > T(0)) || map_size < 1) return {};
    Mat4<T> const canonical = canonical_from_clip<T>(map.clip) * map.clip_from_world;
    T const metres = detail::option(options.metres, T(0));
    T const flat_texels = detail::option(options.flat_texels, T(0));
    if (light.kind == LightKind::directional) {
        // A warp's own w makes depth lean on planes across the light: by Z - depth * W, of which the ends are the most.
        Vec3<T> const z_row(row(canonical, 2)), w_row(row(canonical, 3));
        Vec3<T> const lean = z_row - light.direction * glm::dot(z_row, light.direction);
        T const at_near_end = glm::length(lean), at_far_end = glm::length(lean - w_row);
        T const across = at_near_end > at_far_end ? at_near_end : at_far_end;
        MapBias<T> bias = detail::bias_of_kernel(canonical, map_size, gain, across, options);
        bias.slope_limit *= detail::worst_shear(canonical);
        // A texel in metres grows as w and depth a metre falls as 1 / w: in a bias in texels the two cancel.
        bias.constant += flat_texels * detail::flattest_texel(canonical, map_size, gain);
        bias.per_inverse_w += gain * metres;
        if (detail::is_affine(canonical)) {
            bias.constant += bias.per_inverse_w;
            bias.per_inverse_w = T(0);
        }
        return detail::harmless(bias);
    }
    detail::InverseW<T> const ends = detail::ends_of_axis(canonical, light, gain);
    T const w_per_metre = safe_normalize(Vec3<T>(row(canonical, 3))).length;
    T const at_near_end = gain * w_per_metre * ends.nearest;
    MapBias<T> bias = detail::bias_of_kernel(canonical, map_size, at_near_end, at_near_end, options);
    // Here depth a metre falls as 1 / w^2, so a texel's depth falls as 1 / w from what it is at the near end.
    if (ends.nearest > T(0))
        bias.per_inverse_w += flat_texels * detail::flattest_texel(canonical, map_size, at_near_end) / ends.nearest;
    T const curve = gain * w_per_metre * metres;
    bias.constant -= curve * ends.nearest * ends.farthest;
    bias.per_inverse_w += curve * (ends.nearest + ends.farthest);
    return detail::harmless(bias);
}

// The same with `metres` exact at one point, of any map: for shaders that compute bias per object or per pixel.
template <class T>
[[nodiscard]] inline MapBias<T> bias_at(ShadowMap<T> const& map, Light<T> const& light, int map_size,
                                        BiasOptions<T> const& options, Vec3<T> const& point) noexcept {
    BiasOptions<T> without_metres = options;
    without_metres.metres = T(0);
    MapBias<T> bias = bias_for(map, light, map_size, without_metres);
    bias.constant += depth_shift(map, light, point, detail::option(options.metres, T(0)));
    return detail::harmless(bias);
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/by_footprint.hpp ========
//
// Of several maps that hold a point, the one whose texels look smallest there. For maps of unlike techniques, none of
// which is the sharpest everywhere: view-dependent maps on their planes with cascades around them, a warp and the plain
// map behind it. For cascades alone by_map is as good and asks for no normal.
//
//        pixels a texel      The choice changes where two footprints are equal, so that is where texels change least;
//   B \      / A             within `band` of there the two maps are mixed, half and half where they are equal, and
//      \    /                shadows change over without a seam.
//       \../  <- band
//       /  \                 The light's law makes any such choice right: each map has every caster above its point.

namespace shadowmath {
inline namespace v0 {

// The finest two maps of those met so far, and their footprints.
template <class T>
struct FinestMaps {
    int first = -1;  // -1: none
    int second = -1;
    T first_major = T(0);  // eye pixels
    T second_major = T(0);
};

// With one more map, whose texels are `major` pixels long at the point. The earlier one stays first where two are
// equal.
template <class T>
[[nodiscard]] inline FinestMaps<T> with_map(FinestMaps<T> finest, int map, T major) noexcept {
    if (finest.first < 0 || major < finest.first_major) return {map, finest.first, major, finest.first_major};
    if (finest.second < 0 || major < finest.second_major) {
        finest.second = map;
        finest.second_major = major;
    }
    return finest;
}

// The second takes part where its footprint is less than 1 + band times the first's; its share falls from a half to
// none over the band.
template <class T>
[[nodiscard]] inline LookUp<T> look_up_in(FinestMaps<T> const& finest, T band) noexcept {
    bool const mixes = finest.second >= 0 && all_finite(&band, 1) && band > T(0) && finest.first_major > T(0);
    T const excess = mixes ? (finest.second_major / finest.first_major - T(1)) / band : T(1);
    if (excess < T(1)) return {finest.first, finest.second, T(0.5) * (T(1) - excess)};
    return {finest.first, -1, T(0)};
}

// No map that holds the point, `margin_texels` from its sides, has a smaller footprint (major axis) than the first.
// None of the maps: -1, the point is lit. A normal without length chooses the first map that holds the point.
template <class T>
[[nodiscard]] inline LookUp<T> by_footprint(ShadowMap<T> const* maps, int count, int map_size, T margin_texels,
                                            Mat4<T> const& eye_clip_from_world, Vec2<T> const& eye_pixels,
                                            Vec3<T> const& point, Vec3<T> const& normal, T band = T(0)) noexcept {
    SHADOWMATH_ASSERT(maps != nullptr || count <= 0, "no maps to choose from");
    FinestMaps<T> finest;
    for (int i = 0; i < count; ++i) {
        if (!contains(maps[i], map_size, margin_texels, point)) continue;
        Mat4<T> const& map = maps[i].clip_from_world;
        finest = with_map(finest, i, footprint(eye_clip_from_world, eye_pixels, map, T(map_size), point, normal).major);
    }
    return look_up_in(finest, band);
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/culling.hpp ========
//
// Which maps an object must be drawn into: a bit for each map, and the range [first, last] that one instanced draw
// covers.
//
//        light              A caster counts for a map when it reaches into the shaft of light that ends in the map:
//     |  A |                between its four sides, before its far end, and as far toward the light as you like.
//   B |    | C              A counts although it lies above the near plane: it is drawn flat where depth is clamped,
//     |____|   near         and lost where it is not. B and C cannot shadow anything that the map holds; D lies behind
//     | map|                the last receiver.
//     |____|   far
//       D                   A map's matrix is all that is read, so sun, spot, warped and view-dependent maps mix.
//
// A box is outside a map when it is wholly outside ONE of the five planes: the usual test, which may keep a box that
// passes diagonally by an edge of the shaft, and never drops one that reaches inside. Nothing is divided by w, so boxes
// may lie astride the plane w = 0.
//
// Source: the range of splits of an object is that of Zhang, Sun, Nyman, GPU Gems 3 chapter 10. Departures: the near
// side is open, and all maps of one sun are tested together: they look the same way and share their five normals.

namespace shadowmath {
inline namespace v0 {

// Bit i: the i-th map.
using MapMask = std::uint16_t;

inline constexpr int max_caster_maps = 16;
static_assert(max_splits <= max_caster_maps, "one mask holds all cascades");

struct MapRange {
    int first = 0;
    int last = -1;  // first > last: no map
};

// The shafts of up to max_caster_maps maps, as add_map gives them to caster_mask.
template <class T>
struct CasterMaps {
    // Up to four maps that look the same way. A point p is inside where normal . p >= least, for all five sides.
    struct Bundle {
        Vec3<T> normal[5];  // left, right, bottom, top, far
        T least[5][4] = {};
        MapMask bit[4] = {};  // 0: no map here
    };
    Bundle bundle[max_caster_maps];
    int bundle_count = 0;
    int map_count = 0;  // those that were never visible count too, and keep their bit clear
};

namespace detail {

template <class T>
[[nodiscard]] inline bool all_in_reach(Vec3<T> const& v) noexcept {
    return all_finite(v) && largest_of(v) < T(0x1p60);
}

// Not empty, and in reach.
template <class T>
[[nodiscard]] inline bool is_ordinary(Aabb<T> const& box) noexcept {
    return all_in_reach(box.lo) && all_in_reach(box.hi) && !is_empty(box);
}

// lo > hi, infinite ends included; false where one is NaN, and no signal of one.
template <class T>
[[nodiscard]] inline bool are_crossed(T const& lo, T const& hi) noexcept {
    T const below = -hi;
    return (all_finite(&lo, 1) || is_positive_infinity(&lo)) && (all_finite(&hi, 1) || is_positive_infinity(&below)) &&
           lo > hi;
}

// By how much a box must grow before it is tested, as a part of the sum of the sizes of its coordinates: 6 epsilon for
// the roundings of growing, of a dot product and of its normal, 4 for a normal shared by maps; the rest is room.
template <class T>
inline constexpr T box_slack = T(16) * std::numeric_limits<T>::epsilon();

// xyz over its largest component, which is then 1, so that no product with a coordinate in reach overflows.
template <class T>
[[nodiscard]] inline Vec4<T> side_plane(Vec4<T> const& plane) noexcept {
    T const largest = std::fmax(std::abs(plane.x), std::fmax(std::abs(plane.y), std::abs(plane.z)));
    constexpr T beyond_all = T(0x1p70);
    if (!(largest > T(0))) return Vec4<T>(T(0), T(0), T(0), plane.w < T(0) ? -beyond_all : beyond_all);
    // Up by its own roundings.
    T const offset = plane.w / largest * (T(1) + (plane.w < T(0) ? T(-4) : T(4)) * std::numeric_limits<T>::epsilon());
    return Vec4<T>(plane.x / largest, plane.y / largest, plane.z / largest,
                   offset < -beyond_all ? -beyond_all : (offset > beyond_all ? beyond_all : offset));
}

// How far something reaches along the five normals of a bundle.
template <class T>
struct Reaches {
    T left, right, bottom, top, last;
};

// The maps of one bundle that something with these reaches is inside of.
// NOTE: all is written out, with & for &&: at -O2 compilers unroll no inner loop, and do many boxes at once only where
// there is neither loop nor branch.
template <class T>
[[nodiscard, gnu::always_inline]] inline std::uint32_t bit_if_inside(typename CasterMaps<T>::Bundle const& bundle,
                                                                     Reaches<T> const& reach, int place,
                                                                     std::uint32_t bit) noexcept {
    bool const inside = (reach.left >= bundle.least[0][place]) & (reach.right >= bundle.least[1][place]) &
                        (reach.bottom >= bundle.least[2][place]) & (reach.top >= bundle.least[3][place]) &
                        (reach.last >= bundle.least[4][place]);
    return inside ? bit : 0u;
}

template <class T>
[[nodiscard, gnu::always_inline]] inline std::uint32_t bits_inside(typename CasterMaps<T>::Bundle const& bundle,
                                                                   Reaches<T> const& reach) noexcept {
    return bit_if_inside<T>(bundle, reach, 0, bundle.bit[0]) | bit_if_inside<T>(bundle, reach, 1, bundle.bit[1]) |
           bit_if_inside<T>(bundle, reach, 2, bundle.bit[2]) | bit_if_inside<T>(bundle, reach, 3, bundle.bit[3]);
}

template <class T>
[[nodiscard]] inline MapMask every_bit(CasterMaps<T> const& maps) noexcept {
    unsigned mask = 0;
    for (int b = 0; b < maps.bundle_count; ++b)
        for (MapMask const bit : maps.bundle[b].bit) mask |= bit;
    return static_cast<MapMask>(mask);
}

}  // namespace detail

// The map gets the next bit. One that is not visible, or whose matrix is not finite, is never cast into. At most
// max_caster_maps.
template <class T>
inline void add_map(CasterMaps<T>& maps, ShadowMap<T> const& map) noexcept {
    SHADOWMATH_ASSERT(maps.map_count < max_caster_maps, "more maps than a mask has bits");
    if (maps.map_count >= max_caster_maps) return;
    auto const bit = static_cast<MapMask>(1u << maps.map_count++);
    if (!map.visible || !all_finite(map.clip_from_world)) return;
    // Halves: a sum of two finite numbers may overflow.
    Mat4<T> const m = map.clip_from_world * T(0.5);
    Vec4<T> const x = row(m, 0), y = row(m, 1), z = row(m, 2), w = row(m, 3);
    Vec4<T> const last = map.clip.depth == DepthOrder::one_to_zero ? z : w - z;
    typename CasterMaps<T>::Bundle own;
    int side = 0;
    for (Vec4<T> const& inner : {w + x, w - x, w + y, w - y, last}) {
        Vec4<T> const plane = detail::side_plane(inner);
        own.normal[side] = Vec3<T>(plane);
        own.least[side++][0] = -plane.w;
    }
    own.bit[0] = bit;
    if (maps.bundle_count > 0) {
        auto& bundle = maps.bundle[maps.bundle_count - 1];
        T differ = T(0);
        for (side = 0; side < 5; ++side)
            differ = std::fmax(differ, detail::largest_of(bundle.normal[side] - own.normal[side]));
        int place = 0;
        while (place < 4 && bundle.bit[place] != 0) ++place;
        if (place < 4 && differ <= T(4) * std::numeric_limits<T>::epsilon()) {
            for (side = 0; side < 5; ++side) bundle.least[side][place] = own.least[side][0];
            bundle.bit[place] = bit;
            return;
        }
    }
    maps.bundle[maps.bundle_count++] = own;
}

template <class T>
[[nodiscard]] inline CasterMaps<T> caster_maps(ShadowMap<T> const* maps, int count) noexcept {
    SHADOWMATH_ASSERT(maps != nullptr || count <= 0, "caster_maps needs maps");
    CasterMaps<T> gathered;
    for (int i = 0; i < count; ++i) add_map(gathered, maps[i]);
    return gathered;
}

// Never misses: where any point of the world box lands between the sides of a map (w > 0) and not behind its far end,
// the map's bit is set. Nor is it set elsewhere, but for the rule above and for boxes within 32 epsilon of the sum of
// their coordinates' sizes. An empty box casts nowhere; one with a NaN, an infinity or a coordinate beyond 2^60 m in it
// casts everywhere: a shadow too many is found sooner than one too few.
template <class T>
[[nodiscard]] inline MapMask caster_mask(CasterMaps<T> const& maps, Aabb<T> const& box) noexcept {
    Vec3<T> const &lo = box.lo, &hi = box.hi;
    if (!detail::all_in_reach(lo) || !detail::all_in_reach(hi)) {
        for (int axis = 0; axis < 3; ++axis)
            if (detail::are_crossed(lo[axis], hi[axis])) return 0;
        return detail::every_bit(maps);
    }
    if (lo.x > hi.x || lo.y > hi.y || lo.z > hi.z) return 0;
    T const sizes = std::abs(lo.x) + std::abs(hi.x) + std::abs(lo.y) + std::abs(hi.y) + std::abs(lo.z) + std::abs(hi.z);
    Vec3<T> const grown(detail::box_slack<T> * sizes), first = lo - grown, last = hi + grown;
    std::uint32_t mask = 0;
    for (int b = 0; b < maps.bundle_count; ++b) {
        auto const& bundle = maps.bundle[b];
        auto const reach = [&](int side) {
            Vec3<T> const& normal = bundle.normal[side];
            return normal.x * (normal.x > T(0) ? last.x : first.x) + normal.y * (normal.y > T(0) ? last.y : first.y) +
                   normal.z * (normal.z > T(0) ? last.z : first.z);
        };
        mask |= detail::bits_inside<T>(bundle, {reach(0), reach(1), reach(2), reach(3), reach(4)});
    }
    return static_cast<MapMask>(mask);
}

// As for a box, with the ball in its place; one of negative radius casts nowhere.
template <class T>
[[nodiscard]] inline MapMask caster_mask(CasterMaps<T> const& maps, Sphere<T> const& sphere) noexcept {
    Vec3<T> const& centre = sphere.center;
    if (detail::are_crossed(T(0), sphere.radius)) return 0;
    if (!detail::all_in_reach(centre) || !detail::all_in_reach(Vec3<T>(sphere.radius))) return detail::every_bit(maps);
    T const sizes = std::abs(centre.x) + std::abs(centre.y) + std::abs(centre.z) + sphere.radius;
    T const radius = sphere.radius + detail::box_slack<T> * sizes;
    std::uint32_t mask = 0;
    for (int b = 0; b < maps.bundle_count; ++b) {
        auto const& bundle = maps.bundle[b];
        auto const reach = [&](int side) {
            Vec3<T> const& normal = bundle.normal[side];
            return glm::dot(normal, centre) + radius * std::sqrt(glm::dot(normal, normal));
        };
        mask |= detail::bits_inside<T>(bundle, {reach(0), reach(1), reach(2), reach(3), reach(4)});
    }
    return static_cast<MapMask>(mask);
}

namespace detail {

inline constexpr int boxes_at_once = 64;

// What the reach of a box along a normal must grow by, as a part of the size of its largest coordinate: of the three
// products each may be off by the 10 epsilon of box_slack.
template <class T>
inline constexpr T reach_slack = T(32) * std::numeric_limits<T>::epsilon();

// One block of boxes. Masks of those that are empty, not finite or beyond reach are none; `odd` says that there are
// such.
template <class T>
struct MaskBlock {
    CasterMaps<T> const& maps;
    BoxArrays<T> const& boxes;
    MapMask* masks;
    std::uint32_t const (&bits)[max_caster_maps][4];  // of each bundle: as wide as numbers are
    bool& odd;

    // How far box i reaches along a normal, by the end of each axis that lies farther along it.
    struct Side {
        Vec3<T> normal;
        T const *x, *y, *z;
        [[gnu::always_inline]] T operator()(int i) const noexcept {
            return normal.x * x[i] + normal.y * y[i] + normal.z * z[i];
        }
    };
    [[gnu::always_inline]] Side side_of(Vec3<T> const& normal) const noexcept {
        return {normal, normal.x > T(0) ? boxes.hi_x : boxes.lo_x, normal.y > T(0) ? boxes.hi_y : boxes.lo_y,
                normal.z > T(0) ? boxes.hi_z : boxes.lo_z};
    }

    [[gnu::always_inline]] inline void operator()() const noexcept {
        constexpr int n = boxes_at_once;
        T grown[n];
        std::uint32_t any_odd = 0;
        decltype(beyond_reach(T(0))) beyond = 0;
        auto const less = [](T a, T b) { return a < b ? a : b; };
        auto const more = [](T a, T b) { return a > b ? a : b; };
        for (int i = 0; i < n; ++i) {
            T const lo = less(less(boxes.lo_x[i], boxes.lo_y[i]), boxes.lo_z[i]);
            T const hi = more(more(boxes.hi_x[i], boxes.hi_y[i]), boxes.hi_z[i]);
            T const largest = more(hi, -lo);
            // NOTE: an end that is not a number is in no order, so that `largest` need not know it.
            bool const full =
                (boxes.lo_x[i] <= boxes.hi_x[i]) & (boxes.lo_y[i] <= boxes.hi_y[i]) & (boxes.lo_z[i] <= boxes.hi_z[i]);
            any_odd |= full ? 0u : ~0u;
            beyond |= beyond_reach(largest);
            grown[i] = reach_slack<T> * largest;
        }
        odd = any_odd != 0 || beyond >> (8 * sizeof beyond - 1) != 0;
        if (maps.bundle_count == 0) std::memset(masks, 0, n * sizeof *masks);
        for (int b = 0; b < maps.bundle_count; ++b) {
            typename CasterMaps<T>::Bundle const& bundle = maps.bundle[b];
            // NOTE: side by side, five sides want more registers than there are.
            std::uint32_t const(&bit)[4] = bits[b];
            Side const left = side_of(bundle.normal[0]), right = side_of(bundle.normal[1]);
            Side const bottom = side_of(bundle.normal[2]), top = side_of(bundle.normal[3]);
            Side const last = side_of(bundle.normal[4]);
            T const(&from_left)[4] = bundle.least[0], (&from_right)[4] = bundle.least[1];
            T const(&from_bottom)[4] = bundle.least[2], (&from_top)[4] = bundle.least[3];
            T const(&from_last)[4] = bundle.least[4];
            std::uint32_t in_0[n], in_1[n], in_2[n], in_3[n];  // all ones, or zero
            for (int i = 0; i < n; ++i) {
                T const a = left(i) + grown[i], c = right(i) + grown[i];
                in_0[i] = ((a >= from_left[0]) & (c >= from_right[0])) ? ~0u : 0u;
                in_1[i] = ((a >= from_left[1]) & (c >= from_right[1])) ? ~0u : 0u;
                in_2[i] = ((a >= from_left[2]) & (c >= from_right[2])) ? ~0u : 0u;
                in_3[i] = ((a >= from_left[3]) & (c >= from_right[3])) ? ~0u : 0u;
            }
            for (int i = 0; i < n; ++i) {
                T const a = bottom(i) + grown[i], c = top(i) + grown[i];
                in_0[i] &= ((a >= from_bottom[0]) & (c >= from_top[0])) ? ~0u : 0u;
                in_1[i] &= ((a >= from_bottom[1]) & (c >= from_top[1])) ? ~0u : 0u;
                in_2[i] &= ((a >= from_bottom[2]) & (c >= from_top[2])) ? ~0u : 0u;
                in_3[i] &= ((a >= from_bottom[3]) & (c >= from_top[3])) ? ~0u : 0u;
            }
            for (int i = 0; i < n; ++i) {
                T const a = last(i) + grown[i];
                in_0[i] &= a >= from_last[0] ? ~0u : 0u;
                in_1[i] &= a >= from_last[1] ? ~0u : 0u;
                in_2[i] &= a >= from_last[2] ? ~0u : 0u;
                in_3[i] &= a >= from_last[3] ? ~0u : 0u;
            }
            auto const bits_of = [&](int i) {
                return (in_0[i] & bit[0]) | (in_1[i] & bit[1]) | (in_2[i] & bit[2]) | (in_3[i] & bit[3]);
            };
            if (b == 0)
                for (int i = 0; i < n; ++i) masks[i] = static_cast<MapMask>(bits_of(i));
            else
                for (int i = 0; i < n; ++i) masks[i] = static_cast<MapMask>(masks[i] | bits_of(i));
        }
    }
};

}  // namespace detail

// masks[i] = caster_mask(maps, box i), for `count` boxes in one pass over memory for all maps; the six arrays and
// `masks` hold `count` values each, do not overlap, and need no alignment. Where a box touches a plane to the last
// bits, it may count in one and not in the other; both count every caster.
template <class T>
inline void caster_masks(CasterMaps<T> const& maps, BoxArrays<T> const& boxes, int count, MapMask* masks) noexcept {
    SHADOWMATH_ASSERT(
        count <= 0 || (masks != nullptr && boxes.lo_x != nullptr && boxes.hi_x != nullptr && boxes.lo_y != nullptr &&
                       boxes.hi_y != nullptr && boxes.lo_z != nullptr && boxes.hi_z != nullptr),
        "caster_masks needs six arrays of boxes and one of masks");
    std::uint32_t bits[max_caster_maps][4];
    for (int b = 0; b < maps.bundle_count; ++b)
        for (int place = 0; place < 4; ++place) bits[b][place] = maps.bundle[b].bit[place];
    constexpr int n = detail::boxes_at_once;
    for (int begin = 0; begin < count; begin += n) {
        BoxArrays<T> const block = boxes_from(boxes, begin);
        int const length = count - begin < n ? count - begin : n;
        bool odd = false;
        if (length == n) detail::run_widely(detail::MaskBlock<T>{maps, block, masks + begin, bits, odd});
        if (length == n && !odd) continue;
        for (int i = 0; i < length; ++i) {
            Aabb<T> const box = box_at(block, i);
            if (length < n || !detail::is_ordinary(box)) masks[begin + i] = caster_mask(maps, box);
        }
    }
}

// The least range that holds every map of the mask: the split range of GPU Gems 3, to draw last - first + 1 instances
// of an object. Where the mask has a hole, the range draws into it for nothing.
[[nodiscard]] constexpr MapRange map_range(MapMask mask) noexcept {
    MapRange range;
    for (int i = 0; i < max_caster_maps; ++i) {
        if ((mask >> i & 1) == 0) continue;
        if (range.first > range.last) range.first = i;
        range.last = i;
    }
    return range;
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/map_ray.hpp ========
//
// The light that a matrix is a map of, read from the matrix: the way in which depth grows and the texel stays the same.
// For checking at run time, against the light that it was meant for, any matrix from anywhere: a map that was not
// redrawn when the sun moved, one that was transposed on its way to the shader, a light given as the way to it.
//
// It is the law of shadow maps, M * light = (0, 0, k, 0), asked at a point: NDC x = X.p / W.p is still along a
// direction that is at a right angle to X - x W, and so for y; the cross product of the two is the ray.

namespace shadowmath {
inline namespace v0 {

template <class T>
struct MapRay {
    Vec3<T> direction{T(0)};  // world, unit: the way the light goes there; zero when `ok` is false
    bool ok = false;
};

// The same for every scale of the matrix and in every convention, its depth order included. Not ok where the map does
// not hold the point (w), and where it has no ray: a singular matrix, or one whose depth is the same along it.
template <class T>
[[nodiscard]] inline MapRay<T> map_ray(ShadowMap<T> const& map, Vec3<T> const& point) noexcept {
    Projected<T> const at = projected(map.clip_from_world, point, map.w_min);
    if (!at.in_front) return {};
    Vec3<T> const w(row(map.clip_from_world, 3));
    Vec3<T> const x = Vec3<T>(row(map.clip_from_world, 0)) - w * at.at.x;
    Vec3<T> const y = Vec3<T>(row(map.clip_from_world, 1)) - w * at.at.y;
    Vec3<T> const across = glm::cross(safe_normalize(x).direction, safe_normalize(y).direction);
    Normalized<T> const ray = safe_normalize(across);
    if (!ray.ok || !(ray.length > T(1e-6))) return {};
    T const gain = gain_along(map.clip_from_world, at, ray.direction).z;
    if (!all_finite(&gain, 1) || gain == T(0)) return {};
    bool const forward = (gain > T(0)) == (map.clip.depth != DepthOrder::one_to_zero);
    return {forward ? ray.direction : -ray.direction, true};
}

// The angle at `point` between the light and the light that the map is of, [0, pi]: 0 where the law holds, pi where
// depth runs backwards. pi also where there is no ray to compare, or no light.
template <class T>
[[nodiscard]] inline T light_error_radians(ShadowMap<T> const& map, Light<T> const& light,
                                           Vec3<T> const& point) noexcept {
    MapRay<T> const ray = map_ray(map, point);
    Vec3<T> const travel = unusable(light) ? Vec3<T>(T(0)) : -toward(light, point);
    if (!ray.ok || !(glm::dot(travel, travel) > T(0))) return T(3.14159265358979323846264338327950288L);
    // Not the arc cosine, which has lost half its digits where the angle is small.
    return std::atan2(glm::length(glm::cross(ray.direction, travel)), glm::dot(ray.direction, travel));
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/stillness.hpp ========
//
// How a point moves through the texels from one frame's map to the next. Edges of shadows stand still as long as every
// point moves by whole texels, and shimmer by what is left over. For watching maps at run time, any technique's: those
// on a texel grid (texel_grid.hpp) have nothing left over, all others crawl, and this says by how much.

namespace shadowmath {
inline namespace v0 {

template <class T>
struct TexelShift {
    Vec2<T> texels{T(0)};    // from its place in the first map to that in the second
    Vec2<T> off_grid{T(0)};  // of them, what is left beside the nearest whole number: [-1/2, 1/2]
    bool ok = false;         // false: one of the maps does not hold the point (w), and both are 0
};

// Exact to the rounding of the two places. Both maps are map_size texels along a side; where the point lies beyond
// them, the grid goes on.
template <class T>
[[nodiscard]] inline TexelShift<T> texel_shift(ShadowMap<T> const& before, ShadowMap<T> const& after, int map_size,
                                               Vec3<T> const& point) noexcept {
    Projected<T> const a = projected(texture_from_world(before), point, before.w_min);
    Projected<T> const b = projected(texture_from_world(after), point, after.w_min);
    if (!a.in_front || !b.in_front || map_size < 1) return {};
    Vec2<T> const moved = (Vec2<T>(b.at) - Vec2<T>(a.at)) * T(map_size);
    if (!all_finite(moved)) return {};
    return {moved, moved - Vec2<T>(std::round(moved.x), std::round(moved.y)), true};
}

// The longer of the two parts that are left over, [0, 1/2]: 0 is still. 0 where the shift is not ok.
template <class T>
[[nodiscard]] inline T shimmer_texels(TexelShift<T> const& shift) noexcept {
    return std::fmax(std::abs(shift.off_grid.x), std::abs(shift.off_grid.y));
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/cascades.hpp ========
//
// The one call: a view, a light and two boxes go in, one matrix for each cascade comes out.
//
//   view ── splits ── slices ─┬─ fit ── depth range ── matrix
//   light ── basis ───────────┘
//
//   stable      bounding sphere on a texel grid: nothing shimmers when the camera moves or turns
//   tight       light-space box: up to twice the texels, and shadow edges crawl under motion
//   rectangle   the smallest rectangle at any angle: a quarter fewer metres than tight
//   focus       the smallest around what can be seen in shadow: receivers in view that casters are above
//   warped      a perspective warp of each slice (warp.hpp): texels small near the eye within every map
//
// Use `stable` unless the camera never moves or a temporal filter hides the crawl; or for the nearest maps alone, where
// a crawl is seen most and a finer fit gains least (`steady_maps`). choose.hpp finds the rest by measuring. Every step
// is a header of its own, so a renderer that needs another order calls them itself.
//
// Source: Zhang, Sun, Nyman, GPU Gems 3 chapter 10. Departures: corners come from the sides of the view, not from an
// inverse matrix; maps are fitted to each slice directly, not cropped out of one common light projection; the stable
// fit is the minimal sphere, and its grid has integer origins.

namespace shadowmath {
inline namespace v0 {
namespace detail {

// The view with what can be mended mended: axes orthonormal, far at the shadow distance.
template <class T>
[[nodiscard]] inline ViewVolume<T> shadowed_part(ViewVolume<T> const& view, T const& shadow_distance,
                                                 Faults& faults) noexcept {
    faults |= faults_of(view);
    ViewVolume<T> part = view;
    if (faults.has(Fault::not_finite) || faults.has(Fault::bad_pose)) return part;
    part.pose = orthonormalized(view.pose);
    bool const endless = is_positive_infinity(&view.z_far);
    if (!all_finite(&shadow_distance, 1) || shadow_distance < T(0)) {
        faults |= Fault::clamped_option;
    } else if (shadow_distance > T(0) && (endless || shadow_distance < view.z_far)) {
        part.z_far = shadow_distance;
        if (!(part.z_near < part.z_far)) faults |= Fault::empty_range;
        return part;
    }
    if (endless) {
        // Somewhere shadows must end. A thousand metres, or ten thousand near distances where the unit is larger.
        part.z_far = view.z_near * T(1e4) > T(1000) ? view.z_near * T(1e4) : T(1000);
        faults |= Fault::far_clamped;
    }
    return part;
}

template <class T>
inline void fit_stable(Cascade<T>& cascade, ViewVolume<T> const& part, LightBasis<T> const& basis,
                       DepthRange<T> const& slice_depth, T previous_texel, Aabb<T> const& casters,
                       Aabb<T> const& receivers, T margin_texels, CascadeOptions<T> const& options) noexcept {
    Sphere<T> const sphere = bounding_sphere(part);
    TexelGrid<T> grid = texel_grid(basis, sphere, options.map_size, margin_texels);
    T const held = held_size(grid.texel_metres, previous_texel);
    if (grid.visible && held != grid.texel_metres) grid = grid_window(basis, sphere.center, held, options.map_size);
    cascade.map.faults |= grid.faults;
    if (!grid.visible) return;
    LightBox<T> const sides = on_grid(grid, slice_depth.lo, slice_depth.hi);
    DepthRange<T> const depth = depth_range(sides, slice_depth, casters, receivers, options.pancake);
    if (!depth.visible) return;
    cascade.map.clip_from_world = clip_from_world(grid, depth.lo, depth.hi, options.clip);
    cascade.map.visible = true;
    cascade.texel_metres = grid.texel_metres;
    cascade.depth_metres = depth.hi - depth.lo;
}

// `previous`: the same map in the last frame, or one that is not visible.
template <class T>
inline void fit_directional(Cascade<T>& cascade, CascadeFit cascade_fit, T warp_strength, ViewVolume<T> const& part,
                            Light<T> const& light, Cascade<T> const& previous, Aabb<T> const& casters,
                            Aabb<T> const& receivers, T margin_texels, CascadeOptions<T> const& options) noexcept {
    if (cascade_fit == CascadeFit::warped) {
        WarpOptions<T> const warp{options.map_size, margin_texels, warp_strength};
        cascade.map = simple_perspective_map(part, light, casters, receivers, warp, options.clip);
        return;
    }
    LightBasis<T> const basis = light_basis(light.direction);
    std::array<Vec3<T>, 8> const body = corners(part);
    LightBox<T> sides = fit_box(basis, body, options.map_size, margin_texels);
    DepthRange<T> depth{sides.depth_lo, sides.depth_hi, true};
    if (cascade_fit == CascadeFit::stable) {
        fit_stable(cascade, part, basis, depth, previous.texel_metres, casters, receivers, margin_texels, options);
        return;
    }
    Vec3<T> const previous_x = previous.map.visible ? Vec3<T>(row(previous.map.clip_from_world, 0)) : Vec3<T>(T(0));
    if (cascade_fit == CascadeFit::focus) {
        Focus<T> const focus = focus_of(part, light, casters, receivers);
        if (!focus.visible) return;
        sides = fit_rectangle(basis, focus.receivers, options.map_size, margin_texels, previous_x);
        depth = focus.depth;
        if (options.pancake) depth.lo = focus.first_receiver;
    } else {
        if (cascade_fit == CascadeFit::rectangle)
            sides = fit_rectangle(basis, convex_body(body), options.map_size, margin_texels, previous_x);
        depth = depth_range(sides, depth, casters, receivers, options.pancake);
    }
    if (!depth.visible) return;
    sides.depth_lo = depth.lo;
    sides.depth_hi = depth.hi;
    cascade.map.clip_from_world = clip_from_world(sides, options.clip);
    cascade.map.visible = true;
    Vec2<T> const texel = texel_metres(sides, options.map_size);
    cascade.texel_metres = texel.x > texel.y ? texel.x : texel.y;
    cascade.depth_metres = depth.hi - depth.lo;
}

template <class T>
[[nodiscard]] inline T strength_of(CascadeOptions<T> const& options, int map) noexcept {
    return options.warp_strength * (T(1) - options.warp_less[static_cast<unsigned>(map)]);
}

// All warped maps from `first` on at once; false, and nothing done, where they must be made one by one. `seen` is
// mended.
template <class T>
[[nodiscard]] inline bool fit_warps(Cascades<T>& cascades, int first, ViewVolume<T> const& seen, Light<T> const& light,
                                    Aabb<T> const& casters, Aabb<T> const& receivers, T margin_texels,
                                    CascadeOptions<T> const& options) noexcept {
    SliceRange<T> ranges[max_splits];
    T strengths[max_splits];
    ShadowMap<T>* maps[max_splits];
    int const count = cascades.count - first;
    bool in_range = count > 0 && light.kind == LightKind::directional;
    for (int i = 0; i < count; ++i) {
        Cascade<T>& cascade = cascades.at[first + i];
        ranges[i] = cascade.range, maps[i] = &cascade.map;
        strengths[i] = strength_of(options, first + i);
        in_range = in_range && all_finite(&strengths[i], 1) && strengths[i] >= T(0) && strengths[i] <= T(2);
    }
    if (!in_range) return false;
    WarpInputs<T> const in{
        seen,        safe_normalize(light.direction).direction, faults_of(light), options.map_size, margin_texels,
        options.clip};
    return warp_slices(in, ranges, strengths, count, casters, receivers, maps);
}

}  // namespace detail

// Every point that the eye can see up to the shadow distance and that lies in `receivers` is inside the map of its
// slice, filter margin included, in any clip convention; every caster of `casters` on its way to the light is in that
// map. With CascadeFit::stable and an unmoving light, a world point keeps its place within a texel whatever the camera
// does. With CascadeFit::focus, points that no ray of light reaches through `casters` are left out; they read as lit.
// `casters` and `receivers` are world boxes; either empty: no map is visible, and that is no fault. `previous`, if not
// null: the last frame's. Rectangles keep its angle while that is nearly as good, and stable maps its size while that
// is not a quarter too much: so a slow zoom does not set all shadows crawling.
template <class T>
[[nodiscard]] inline Cascades<T> fit_cascades(ViewVolume<T> const& view, Light<T> const& light, Aabb<T> const& casters,
                                              Aabb<T> const& receivers, CascadeOptions<T> const& options,
                                              Cascades<T> const* previous = nullptr) noexcept {
    Cascades<T> cascades;
    Faults faults = faults_of(light);
    ViewVolume<T> const seen = detail::shadowed_part(view, options.shadow_distance, faults);
    if (!all_finite(casters) || !all_finite(receivers)) faults |= Fault::not_finite;
    bool const unusable_view = faults.has(Fault::not_finite) || faults.has(Fault::bad_frustum) ||
                               faults.has(Fault::bad_pose) || faults.has(Fault::empty_range);
    if (unusable_view || unusable(light)) {
        cascades.faults = faults;
        return cascades;
    }
    bool const pinned = !(options.first_split_end == T(0));
    Splits<T> const splits =
        pinned ? pinned_splits(seen.z_near, seen.z_far, options.count, options.first_split_end, options.lambda)
               : practical_splits(seen.z_near, seen.z_far, options.count, options.lambda);
    // One texel more than the kernel needs: the texel that holds the point may be cut by the map's side.
    T const margin_texels = T(detail::kernel_radius(options, faults) + 1);
    faults |= faults_of_margin(options.map_size, margin_texels);
    if (faults.has(Fault::map_too_small)) {
        cascades.faults = faults;
        return cascades;
    }
    T blend = options.blend;
    if (!all_finite(&options.blend, 1) || blend < T(0) || blend > T(1)) {
        blend = all_finite(&options.blend, 1) && blend > T(1) ? T(1) : T(0);
        faults |= Fault::clamped_option;
    }
    cascades.count = splits.count;
    cascades.faults = faults | splits.faults;
    for (int i = 0; i < splits.count; ++i) {
        cascades.at[i].range = slice_range(splits, i, blend);
        cascades.at[i].map.clip = options.clip;
    }
    if (is_empty(casters) || is_empty(receivers)) return cascades;
    int alone = splits.count;  // so many of the first are made one by one
    if (options.fit == CascadeFit::warped) {
        int const steady = options.steady_maps < 0 ? 0 : (options.steady_maps < alone ? options.steady_maps : alone);
        if (detail::fit_warps(cascades, steady, seen, light, casters, receivers, margin_texels, options))
            alone = steady;
    }
    for (int i = 0; i < alone; ++i) {
        Cascade<T>& cascade = cascades.at[i];
        ViewVolume<T> const part = slice(seen, cascade.range);
        if (light.kind == LightKind::directional) {
            Cascade<T> const last = previous != nullptr && i < previous->count ? previous->at[i] : Cascade<T>{};
            CascadeFit const cascade_fit = i < options.steady_maps ? CascadeFit::stable : options.fit;
            T const strength = detail::strength_of(options, i);
            detail::fit_directional(cascade, cascade_fit, strength, part, light, last, casters, receivers,
                                    margin_texels, options);
        } else {
            cascade.map = fit_spot(part, light, casters, receivers, options.map_size, margin_texels, options.clip);
        }
    }
    for (Cascade<T> const& cascade : cascades) cascades.faults |= cascade.map.faults;
    return cascades;
}

// For caster_mask: bit i is cascade i.
template <class T>
[[nodiscard]] inline CasterMaps<T> caster_maps(Cascades<T> const& cascades) noexcept {
    CasterMaps<T> maps;
    for (Cascade<T> const& cascade : cascades) add_map(maps, cascade.map);
    return maps;
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/choose.hpp ========
//
// Options found by measuring: how many maps, how large, split where, fitted how, so that the worst (or the mean)
// footprint over what the eye sees is least, or the fewest pixels come out wrong, within a number of texels. For a
// settings menu, an editor, the loading of a level, or again when the camera has gone somewhere else; not for every
// frame, since options that change make shadows jump.
//
// It tries them: every number of maps, every fit allowed, eleven values of lambda and then between the best two
// neighbours; of warped maps also each with half of its warp and with none. No randomness, no clock; the same inputs
// give the same options, after at most 29 tries for each pair of count and fit and two for each warped map. Where two
// are equal to a fiftieth the earlier one stays: fewer maps, and the calmer fit.
//
// Source: none; engines leave this to the user's eye. The closed forms (aliasing.hpp) say what is best for one light on
// one plane; this holds for any.

namespace shadowmath {
inline namespace v0 {

enum class Goal : std::uint8_t {
    least_worst,   // of the footprints: no place is much worse than the others
    least_mean,    // of the footprints
    fewest_wrong,  // of the pixels (price_of): the truest picture, and what choose_maps goes by
};

enum class Motion : std::uint8_t {
    still,    // no shimmer at all: stable fits
    at_ease,  // the nearest map still, the others may crawl
    any       // whatever is finest: a camera that stands, or a temporal filter
};

template <class T>
struct ChoiceLimits {
    Vec2<T> eye_pixels{T(1920), T(1080)};
    std::int64_t texels = 4 * 2048 * 2048;  // of all maps together
    int most_maps = 4;                      // 1 to max_splits
    int largest_map = 8192;                 // texels along a side
    Motion motion = Motion::still;
    Goal goal = Goal::least_worst;
};

template <class T>
struct Choice {
    CascadeOptions<T> options;  // those given, with count, map_size, fit, steady_maps, lambda, warp_less chosen
    Judgement<T> judgement;     // of these options
    int tried = 0;
    bool visible = false;  // false: no map showed any of the samples, and the options are those given
    Faults faults;         // clamped_option: a limit outside its range
};

// The side of `count` square maps that together have no more than `texels`, a multiple of 4, no larger than `largest`.
[[nodiscard]] constexpr int map_size_within(std::int64_t texels, int count, int largest) noexcept {
    std::int64_t const each = count > 0 ? texels / count : 0;
    std::int64_t side = 0;
    for (std::int64_t step = std::int64_t(1) << 20; step >= 4; step /= 2)
        if (side + step <= largest && (side + step) * (side + step) <= each) side += step;
    return static_cast<int>(side);
}

// None of the options tried has a lesser worst (mean) footprint over the samples, but for a fiftieth; options given
// (blend, filter, distance, clip, pinned split) are kept. Points with no map count as footprint_limit, so options that
// leave receivers out lose; CascadeFit::focus is tried for them all the same.
template <class T>
[[nodiscard]] inline Choice<T> choose(ViewVolume<T> const& view, Light<T> const& light, Aabb<T> const& casters,
                                      Aabb<T> const& receivers, SurfacePoint<T> const* samples, int sample_count,
                                      CascadeOptions<T> const& given, ChoiceLimits<T> const& limits) noexcept {
    Choice<T> best;
    best.options = given;
    int const most = limits.most_maps < 1 ? 1 : (limits.most_maps > max_splits ? max_splits : limits.most_maps);
    if (most != limits.most_maps || limits.texels < 16 || limits.largest_map < 4) best.faults = Fault::clamped_option;
    T least = footprint_limit<T>;
    auto const value = [&limits](Judgement<T> const& judgement) {
        switch (limits.goal) {
            case Goal::least_mean: return judgement.all.mean;
            case Goal::fewest_wrong: return judgement.all.price;
            default: return judgement.all.worst;
        }
    };
    auto const attempt = [&](CascadeOptions<T> const& options) {
        Cascades<T> const cascades = fit_cascades(view, light, casters, receivers, options);
        ++best.tried;
        return judge(cascades, options.map_size, view, limits.eye_pixels, samples, sample_count);
    };
    CascadeFit const fits[] = {CascadeFit::stable, CascadeFit::tight, CascadeFit::rectangle, CascadeFit::focus,
                               CascadeFit::warped};
    int const fit_count = limits.motion == Motion::still || light.kind == LightKind::spot ? 1 : 5;
    for (int count = 1; count <= most; ++count) {
        CascadeOptions<T> options = given;
        options.count = count;
        options.map_size = map_size_within(limits.texels, count, limits.largest_map);
        options.steady_maps = limits.motion == Motion::at_ease ? 1 : 0;
        if (faults_of_margin(options.map_size, T(given.filter_radius + 1)).any()) continue;
        for (int f = 0; f < fit_count; ++f) {
            options.fit = fits[f];
            if (options.steady_maps >= count && f > 0) break;
            T lo = T(0), hi = T(1);
            T here_least = footprint_limit<T>;
            CascadeOptions<T> here = options;
            Judgement<T> judgement;
            for (int round = 0; round < 3; ++round) {
                // One map has no splits to place.
                int const steps = count > 1 ? (round == 0 ? 10 : 8) : 0;
                T const step = steps > 0 ? (hi - lo) / T(steps) : T(0);
                for (int i = 0; i <= steps; ++i) {
                    options.lambda = lo + step * T(i);
                    Judgement<T> const measured = attempt(options);
                    if (measured.all.count == 0 || !(value(measured) < here_least)) continue;
                    here_least = value(measured);
                    here = options;
                    judgement = measured;
                }
                if (steps == 0) break;
                lo = std::fmax(here.lambda - step, T(0));
                hi = std::fmin(here.lambda + step, T(1));
            }
            if (!(here_least < least * T(0.98))) continue;
            least = here_least;
            best.options = here;
            best.judgement = judgement;
            best.visible = true;
        }
    }
    if (best.options.fit != CascadeFit::warped || !best.visible) return best;
    // A warp helps where the view looks along the ground, and takes from what is far away: each map decides.
    for (int c = 0; c < best.options.count; ++c)
        for (T const less : {T(0.5), T(1)}) {
            CascadeOptions<T> options = best.options;
            options.warp_less[static_cast<unsigned>(c)] = less;
            Judgement<T> const measured = attempt(options);
            if (!(value(measured) < least)) continue;
            least = value(measured);
            best.options = options;
            best.judgement = measured;
        }
    return best;
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/light_samples.hpp ========
//
// What the eye sees, as the light sees it: each surface sample as a place on the light's plane, with what a metre there
// is worth in eye pixels. All that a choice of maps needs to know of a picture.
//
// A sun's map is a homography of the light's plane, whatever technique it comes from. So with G the eye pixels that a
// surface gains for a metre of that plane (2 x 2, measured along the surface), and M the texels that the map gains
// there, the footprint is the singular values of G / M: no point is ever projected again.
//
// A sample stands for a cell of the picture, so its place is a small parallelogram: the cell's shadow on the light's
// plane. Whoever covers the parallelograms covers the picture between the samples, but for what none of them has hit.

namespace shadowmath {
inline namespace v0 {

template <class T>
struct LightSample {
    Vec2<T> place{T(0)};   // metres from the eye along basis.x and basis.y
    T depth = T(0);        // along the light, metres from the eye
    Vec2<T> gain_x{T(0)};  // eye pixels for a metre of the plane along basis.x, on the surface
    Vec2<T> gain_y{T(0)};
    Vec2<T> reach_x{T(0)};  // from `place` to the sides of the cell that the sample stands for, metres
    Vec2<T> reach_y{T(0)};
    T weight = T(1);
    Vec3<T> seen{T(0)};   // right and up for a metre of depth (of an orthographic view metres), and eye depth
    bool usable = false;  // false: behind the eye or the light, or no number
};

// What samples are seen by.
template <class T>
struct LightSampler {
    ViewVolume<T> view;
    LightBasis<T> basis;
    Vec2<T> pixels_per_side{T(0)};  // eye pixels for one unit of the view's sides
    Vec2<T> half_cell{T(0)};        // eye pixels
    bool usable = false;
};

// `eye_pixels`: the picture that shadows are for; `cells`: how many samples there are along its sides.
template <class T>
[[nodiscard]] inline LightSampler<T> light_sampler(ViewVolume<T> const& view, Light<T> const& light,
                                                   Vec2<T> const& eye_pixels, Vec2<T> const& cells) noexcept {
    LightSampler<T> sampler;
    sampler.view = view;
    bool const sizes = all_finite(eye_pixels) && all_finite(cells) && eye_pixels.x > T(0) && eye_pixels.y > T(0) &&
                       cells.x > T(0) && cells.y > T(0);
    if (!sizes || faults_of(view).any() || unusable(light) || light.kind != LightKind::directional) return sampler;
    sampler.view.pose = orthonormalized(view.pose);
    sampler.basis = light_basis(light.direction);
    sampler.pixels_per_side = Vec2<T>(eye_pixels.x / (view.right - view.left), eye_pixels.y / (view.top - view.bottom));
    sampler.half_cell = Vec2<T>(T(0.5) * eye_pixels.x / cells.x, T(0.5) * eye_pixels.y / cells.y);
    sampler.usable = all_finite(sampler.pixels_per_side) && all_finite(sampler.half_cell);
    return sampler;
}

// Surfaces that face away from the light come back with weight 0, and those that the light or the eye grazes are taken
// as a little less steep: no map would help them, and no cell is without an end.
template <class T>
[[nodiscard]] inline LightSample<T> light_sample(LightSampler<T> const& sampler,
                                                 SurfacePoint<T> const& surface) noexcept {
    LightSample<T> sample;
    if (!sampler.usable || !all_finite(surface.point) || !all_finite(surface.normal)) return sample;
    constexpr T least_cosine = T(0.05);
    Pose<T> const& pose = sampler.view.pose;
    Vec3<T> const from_eye = surface.point - pose.position;
    bool const flat = sampler.view.kind == ViewKind::orthographic;
    T const right = glm::dot(pose.right, from_eye), up = glm::dot(pose.up, from_eye);
    T const depth = glm::dot(pose.forward, from_eye), spread = flat ? T(1) : depth;
    if (!(depth > T(0)) || !(depth <= sampler.view.z_far * (T(1) + T(1e-5)))) return sample;
    sample.seen = Vec3<T>(right / spread, up / spread, depth);
    sample.place = Vec2<T>(glm::dot(sampler.basis.x, from_eye), glm::dot(sampler.basis.y, from_eye));
    sample.depth = glm::dot(sampler.basis.depth, from_eye);
    Normalized<T> const unit = safe_normalize(surface.normal);
    Vec3<T> normal = unit.direction;
    Vec3<T> const toward_eye = flat ? -pose.forward : safe_normalize(-from_eye).direction;
    if (!unit.ok) normal = toward_eye;
    if (glm::dot(normal, toward_eye) < T(0)) normal = -normal;
    T const to_light = -glm::dot(normal, sampler.basis.depth);
    sample.weight = to_light > T(0) ? T(1) : T(0);
    // A metre along basis.x on the surface: as far along the light as stays on it.
    T const cosine = to_light > least_cosine ? to_light : (to_light < -least_cosine ? to_light : least_cosine);
    auto const gain = [&](Vec3<T> const& axis) {
        Vec3<T> const way = axis + sampler.basis.depth * (glm::dot(normal, axis) / cosine);
        T const away = flat ? T(0) : glm::dot(pose.forward, way);
        return Vec2<T>((glm::dot(pose.right, way) - sample.seen.x * away) * sampler.pixels_per_side.x / spread,
                       (glm::dot(pose.up, way) - sample.seen.y * away) * sampler.pixels_per_side.y / spread);
    };
    sample.gain_x = gain(sampler.basis.x);
    sample.gain_y = gain(sampler.basis.y);
    // The cell's sides: the gains' inverse. A surface seen edge-on has none; then the cell is as deep as it is wide,
    // eight times.
    T const determinant = sample.gain_x.x * sample.gain_y.y - sample.gain_x.y * sample.gain_y.x;
    T const wide =
        T(8) * spread *
        std::fmax(sampler.half_cell.x / sampler.pixels_per_side.x, sampler.half_cell.y / sampler.pixels_per_side.y);
    auto const reach = [&](Vec2<T> const& pixels) {
        Vec2<T> const scaled(pixels.x * sample.gain_y.y - pixels.y * sample.gain_y.x,
                             pixels.y * sample.gain_x.x - pixels.x * sample.gain_x.y);
        T const longest = std::fmax(std::abs(scaled.x), std::abs(scaled.y));
        if (longest < wide * std::abs(determinant)) return scaled / determinant;
        return longest > T(0) ? scaled * (wide / longest) : Vec2<T>(T(0));
    };
    sample.reach_x = reach(Vec2<T>(sampler.half_cell.x, T(0)));
    sample.reach_y = reach(Vec2<T>(T(0), sampler.half_cell.y));
    sample.usable = all_finite(sample.place) && all_finite(sample.gain_x) && all_finite(sample.gain_y) &&
                    all_finite(sample.reach_x) && all_finite(sample.reach_y);
    return sample;
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/box_samples.hpp ========
//
// What the eye may see, where nothing but boxes is known: guesses at surfaces inside them, for choices that weigh what
// is seen where. With a depth buffer at hand use that instead; its surfaces are no guesses.
//
// Each of a few hundred rays meets some boxes. What they hold is not known, so a ray is taken to end in each box that
// it meets with even odds, and in the last one for certain: there is a ground. A surface in a box is as likely in its
// nearer as in its farther half. Of a box that the eye is in, it sees the room, and its far end where no other box is
// met. A guess's normal leans as far from the eye as from the light (neutral_normal), so what is weighed is perspective
// aliasing alone.

namespace shadowmath {
inline namespace v0 {

inline constexpr int guess_rays_x = 20;
inline constexpr int guess_rays_y = 12;

// A texel is so many times longer on the surfaces that are really there, in the mean, than on one that leans as the
// neutral normal does.
template <class T>
inline constexpr T leaning_surfaces = T(3);

// A surface that the eye may see along one ray.
template <class T>
struct DepthGuess {
    T depth = T(0);   // of the eye
    T weight = T(0);  // of a ray: they sum to 1, or there are none
};

template <class T>
struct RayGuesses {
    std::array<DepthGuess<T>, 8> at;
    int count = 0;
};

// Two in each of the first four boxes that the ray meets. Boxes that are empty or not finite are none.
template <class T>
[[nodiscard]] inline RayGuesses<T> guesses_on_ray(ViewVolume<T> const& view, T side_x, T side_y, Aabb<T> const* boxes,
                                                  int box_count) noexcept {
    constexpr int most = 4;
    RayGuesses<T> guesses;
    std::array<DepthSpan<T>, most> span;  // by their first depths
    DepthSpan<T> around;                  // of the boxes that the eye is in, the one that ends last
    int met = 0;
    for (int b = 0; b < box_count; ++b) {
        if (!all_finite(boxes[b]) || is_empty(boxes[b])) continue;
        DepthSpan<T> const inside = depths_in_box(view, side_x, side_y, boxes[b]);
        if (!(inside.first <= inside.last)) continue;
        if (!(inside.first > view.z_near)) {
            if (inside.last > around.last) around = inside;
            continue;
        }
        if (met == most && !(inside.first < span[most - 1].first)) continue;
        int at = met < most ? met++ : most - 1;
        for (; at > 0 && span[static_cast<unsigned>(at - 1)].first > inside.first; --at)
            span[static_cast<unsigned>(at)] = span[static_cast<unsigned>(at - 1)];
        span[static_cast<unsigned>(at)] = inside;
    }
    auto const guess = [&guesses](DepthSpan<T> const& in, T part, T weight) {
        guesses.at[static_cast<unsigned>(guesses.count++)] = {in.first + (in.last - in.first) * part, weight};
    };
    T left = T(1);
    for (int i = 0; i < met; ++i) {
        T const here = i + 1 < met ? T(0.5) * left : left;
        left -= here;
        guess(span[static_cast<unsigned>(i)], T(0.25), T(0.5) * here);
        guess(span[static_cast<unsigned>(i)], T(0.75), T(0.5) * here);
    }
    if (met == 0 && around.first <= around.last) {
        guess(around, T(0.5), T(0.5));
        guess(around, T(0.9), T(0.5));
    }
    return guesses;
}

// Fills `into` with at most `capacity` weighted guesses and returns how many.
template <class T>
[[nodiscard]] inline int guesses_in_boxes(LightSampler<T> const& sampler, Light<T> const& light, Aabb<T> const* boxes,
                                          int box_count, LightSample<T>* into, int capacity) noexcept {
    constexpr int rays_x = guess_rays_x, rays_y = guess_rays_y;
    int count = 0;
    ViewVolume<T> const& view = sampler.view;
    for (int ray = 0; ray < rays_x * rays_y; ++ray) {
        Vec2<T> const side = detail::side_of_ray(view, ray, rays_x, rays_y);
        RayGuesses<T> const guesses = guesses_on_ray(view, side.x, side.y, boxes, box_count);
        for (int i = 0; i < guesses.count && count < capacity; ++i) {
            DepthGuess<T> const& guess = guesses.at[static_cast<unsigned>(i)];
            Vec3<T> const point = point_at(view, side.x, side.y, guess.depth);
            LightSample<T> sample = light_sample(sampler, {point, neutral_normal(view, light, point)});
            sample.weight = guess.weight;
            if (sample.usable) into[count++] = sample;
        }
    }
    return count;
}

// The same as samples for choose.hpp and judge.hpp, which know no weights: on each of eight by eight rays four, the
// more of them in a box the likelier the ray ends there. None of a view with faults, or without an end.
template <class T>
[[nodiscard]] inline Samples<T> samples_in_boxes(ViewVolume<T> const& view, Light<T> const& light, Aabb<T> const* boxes,
                                                 int box_count) noexcept {
    SHADOWMATH_ASSERT(boxes != nullptr || box_count <= 0, "samples need their boxes");
    Samples<T> samples;
    if (faults_of(view).any() || is_positive_infinity(&view.z_far) || unusable(light)) return samples;
    constexpr int rays = 8, on_each = max_samples / (rays * rays);
    for (int ray = 0; ray < rays * rays; ++ray) {
        Vec2<T> const side = detail::side_of_ray(view, ray, rays, rays);
        RayGuesses<T> const guesses = guesses_on_ray(view, side.x, side.y, boxes, box_count);
        int at = 0;
        T passed = T(0);  // weight of the guesses before `at`
        for (int i = 0; i < on_each && guesses.count > 0; ++i) {
            T const share = (T(i) + T(0.5)) / T(on_each);
            while (at + 1 < guesses.count && passed + guesses.at[static_cast<unsigned>(at)].weight < share)
                passed += guesses.at[static_cast<unsigned>(at++)].weight;
            Vec3<T> const point = point_at(view, side.x, side.y, guesses.at[static_cast<unsigned>(at)].depth);
            if (!all_finite(point)) continue;
            samples.at[static_cast<std::size_t>(samples.count++)] = {point, neutral_normal(view, light, point)};
        }
    }
    return samples;
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/quad_map.hpp ========
//
// A map whose four sides are any four lines of the light's plane: the one homography that takes the quadrilateral
// between them to the square. Boxes, rotated rectangles, every perspective warp, sheared or lopsided, are all this.
//
//          top               Each side is a line l with l(p) >= 0 inside. One combination of four lines in a plane
//        ________            is zero everywhere,
//       /        |
// left /         | right         a left + b right = c bottom + d top,     a, b, c, d > 0,
//     /__________|
//         bottom             and with it w = a left + b right, x = a left - b right, y = c bottom - d top: x = -w on
//                            the left side, x = w on the right one, w > 0 between.
//
// Use it where four sides are known to be good ones (fit_quad.hpp looks for them). One side alone can then be moved or
// turned and the others stay where they are, which two projective numbers and a rectangle cannot.
//
// Source: none known for shadow maps; that four lines fix a homography is the projective theorem of von Staudt.

namespace shadowmath {
inline namespace v0 {

// Left, right, bottom, top: each dotted with (x, y, 1) of the light's plane, >= 0 inside, of any length.
template <class T>
using QuadSides = std::array<Vec3<T>, 4>;

// The homography: x / w and y / w of (x, y, 1) are in [-1, 1] between the sides.
template <class T>
struct Quad {
    Vec3<T> x{T(0)};
    Vec3<T> y{T(0)};
    Vec3<T> w{T(0), T(0), T(1)};  // 1 where it is most, among the corners
    std::array<Vec2<T>, 4> corner{};
    T w_least = T(0);      // at a corner
    bool visible = false;  // false: the lines bound no quadrilateral, or one that ends in a point
};

namespace detail {

template <class T>
[[nodiscard]] inline T triple(Vec3<T> const& a, Vec3<T> const& b, Vec3<T> const& c) noexcept {
    return glm::dot(a, glm::cross(b, c));
}

}  // namespace detail

// w varies by no more than `most_warp` from corner to corner, and texels are no more than `most_shear` times as long as
// their sides are apart; sides that ask for more are not visible. Bias, which must suit a whole map, sets both limits.
template <class T>
[[nodiscard]] inline Quad<T> quad_between(QuadSides<T> const& side, T most_warp = T(4),
                                          T most_shear = T(1.6)) noexcept {
    Quad<T> quad;
    auto const& [left, right, bottom, top] = side;
    // Cramer: the combination that vanishes has the four minors for its weights, with signs in turn.
    T a = detail::triple(right, bottom, top), b = -detail::triple(left, bottom, top);
    T c = -detail::triple(left, right, top), d = detail::triple(left, right, bottom);
    if (a < T(0)) a = -a, b = -b, c = -c, d = -d;
    if (!(a > T(0)) || !(b > T(0)) || !(c > T(0)) || !(d > T(0))) return quad;
    Vec3<T> const w = left * a + right * b;
    T most = T(0), least = T(0);
    for (unsigned i = 0; i < 4; ++i) {
        Vec3<T> const meet = glm::cross(side[i & 1u], side[2u + (i >> 1)]);
        if (meet.z == T(0)) return quad;
        quad.corner[i] = Vec2<T>(meet.x / meet.z, meet.y / meet.z);
        T const here = glm::dot(w, Vec3<T>(quad.corner[i], T(1)));
        most = i == 0 || here > most ? here : most;
        least = i == 0 || here < least ? here : least;
    }
    if (!(least * most_warp >= most) || !(most > T(0))) return quad;
    T const scale = T(1) / most;
    quad.x = (left * a - right * b) * scale;
    quad.y = (bottom * c - top * d) * scale;
    quad.w = w * scale;
    quad.w_least = least * scale;
    for (T const x : {T(-1), T(1)})
        for (T const y : {T(-1), T(1)}) {
            Vec2<T> const along_x = Vec2<T>(quad.x) - Vec2<T>(quad.w) * x;
            Vec2<T> const along_y = Vec2<T>(quad.y) - Vec2<T>(quad.w) * y;
            T const cross = along_x.x * along_y.y - along_x.y * along_y.x;
            T const squares = glm::dot(along_x, along_x) * glm::dot(along_y, along_y);
            if (!(squares <= cross * cross * most_shear * most_shear)) return quad;
        }
    quad.visible = all_finite(quad.x) && all_finite(quad.y) && all_finite(quad.w) && quad.w_least > T(0);
    return quad;
}

// The same quadrilateral elsewhere. Sides are best given about their own middle: far from it their minors are all
// rounding.
template <class T>
[[nodiscard]] inline Quad<T> moved(Quad<T> quad, Vec2<T> const& offset) noexcept {
    for (Vec3<T>* const row : {&quad.x, &quad.y, &quad.w}) row->z -= row->x * offset.x + row->y * offset.y;
    for (Vec2<T>& corner : quad.corner) corner += offset;
    return quad;
}

// Square metres of the light's plane.
template <class T>
[[nodiscard]] inline T area(Quad<T> const& quad) noexcept {
    Vec2<T> const d = quad.corner[3] - quad.corner[0], e = quad.corner[2] - quad.corner[1];
    return T(0.5) * std::abs(d.x * e.y - d.y * e.x);
}

// True inside and on the sides.
template <class T>
[[nodiscard]] inline bool is_in(Quad<T> const& quad, Vec2<T> const& place) noexcept {
    Vec3<T> const p(place, T(1));
    T const w = glm::dot(quad.w, p);
    return w >= quad.w_least * T(0.999) && std::abs(glm::dot(quad.x, p)) <= w && std::abs(glm::dot(quad.y, p)) <= w;
}

// Texels gained for a metre along x and along y of the light's plane, at a place inside.
template <class T>
struct QuadGain {
    Vec2<T> x{T(0)};
    Vec2<T> y{T(0)};
};

template <class T>
[[nodiscard]] inline QuadGain<T> gain_at(Quad<T> const& quad, T usable_texels, Vec2<T> const& place) noexcept {
    Vec3<T> const p(place, T(1));
    T const w = glm::dot(quad.w, p);
    if (w == T(0)) return {};  // at its horizon
    T const scale = usable_texels * T(0.5) / w;
    T const x = glm::dot(quad.x, p) / w, y = glm::dot(quad.y, p) / w;
    return {Vec2<T>(quad.x.x - x * quad.w.x, quad.y.x - y * quad.w.x) * scale,
            Vec2<T>(quad.x.y - x * quad.w.y, quad.y.y - y * quad.w.y) * scale};
}

// The map of everything between the quadrilateral's sides from `first` to `last` along the light: inside with
// `margin_texels` to spare, and every caster of the box between it and the light with stored depth in [0, 1]. The
// light's plane passes through `origin`; places are metres from there along basis.x and basis.y, depths along
// basis.depth. Not visible, and no fault: no caster is above. A sun's.
template <class T>
[[nodiscard]] inline ShadowMap<T> quad_map(Quad<T> const& quad, LightBasis<T> const& basis, Vec3<T> const& origin,
                                           T first, T last, Aabb<T> const& casters, int map_size, T margin_texels,
                                           ClipSpace clip) noexcept {
    ShadowMap<T> map;
    map.clip = clip;
    if (!quad.visible) return map;
    auto const in_world = [&basis](Vec3<T> const& functional) {
        return Vec4<T>(basis.x * functional.x + basis.y * functional.y, functional.z);
    };
    MapRows<T> rows;
    rows.x = in_world(quad.x);
    rows.y = in_world(quad.y);
    rows.w = in_world(quad.w);
    rows.along = Vec4<T>(basis.depth, T(0));
    rows.source = rows.along;
    rows.w_min = quad.w_least * T(0.5);
    rows.crop = false;
    std::array<Vec3<T>, 8> body;
    for (unsigned i = 0; i < 8; ++i) {
        Vec2<T> const& corner = quad.corner[i & 3u];
        body[i] = basis.x * corner.x + basis.y * corner.y + basis.depth * ((i & 4u) != 0 ? last : first);
    }
    return map_from_rows(rows, origin, convex_body(body), casters, map_size, margin_texels, clip);
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/fit_quad.hpp ========
//
// The best four lines around a set of samples: the map in which their texels look smallest in the picture.
//
//   supports      how far the samples reach in each of 64 directions: that is all of their shape that matters
//   start         the best of the sixteen rectangles
//   descent       one side is turned by 45, 22, 11, 6 degrees while that helps, the others stay; then again finer
//
// A side is always a line that touches the samples, so every candidate holds all of them, and no hull is built.
// Directions are even in a frame in which the samples are as wide as they are long: under a low sun they are not.
//
// Source: none; "trapezoids" (Martin and Tan 2004) turn two of the four sides.

namespace shadowmath {
inline namespace v0 {

// Eye pixels along the longer axis of a texel of the quadrilateral's map at the sample.
template <class T>
[[nodiscard]] inline T major_at(Quad<T> const& quad, T usable_texels, LightSample<T> const& sample) noexcept {
    QuadGain<T> const map = gain_at(quad, usable_texels, sample.place);
    T const det = map.x.x * map.y.y - map.x.y * map.y.x;
    // G * adjugate(M), column by column.
    Vec2<T> const p = sample.gain_x * map.y.y - sample.gain_y * map.x.y;
    Vec2<T> const q = sample.gain_y * map.x.x - sample.gain_x * map.y.x;
    T const sum = glm::dot(p, p) + glm::dot(q, q), cross = p.x * q.y - p.y * q.x;
    T const rest = sum * sum - T(4) * cross * cross;
    T const stretch = std::sqrt(T(0.5) * (sum + std::sqrt(rest > T(0) ? rest : T(0))));
    T const size = std::abs(det);
    return stretch < footprint_limit<T> * size ? stretch / size : footprint_limit<T>;
}

// Samples as wide as they are long: coordinates in which directions are told apart.
template <class T>
struct SampleFrame {
    Vec2<T> middle{T(0)};
    Vec2<T> a{T(1), T(0)};  // what a coordinate gains for a metre of the light's plane
    Vec2<T> b{T(0), T(1)};
};

inline constexpr int quad_directions = 64;

template <class T>
struct Supports {
    SampleFrame<T> frame;
    std::array<Vec2<T>, quad_directions> direction;  // in the light's plane, outward
    std::array<T, quad_directions> reach;            // the most of direction . (place - middle)
    int count = 0;                                   // samples
};

// Directions evenly around.
template <class T>
[[nodiscard]] inline Supports<T> no_supports(SampleFrame<T> const& frame) noexcept {
    Supports<T> supports;
    supports.frame = frame;
    constexpr T turn = T(6.28318530717958647692528676655900577L);
    for (int i = 0; i < quad_directions; ++i) {
        T const angle = turn * T(i) / T(quad_directions);
        supports.direction[static_cast<unsigned>(i)] = frame.a * std::cos(angle) + frame.b * std::sin(angle);
        supports.reach[static_cast<unsigned>(i)] = std::numeric_limits<T>::lowest();
    }
    return supports;
}

template <class T>
inline void add(Supports<T>& supports, Vec2<T> const& place) noexcept {
    Vec2<T> const p = place - supports.frame.middle;
    for (unsigned i = 0; i < unsigned(quad_directions); ++i) {
        T const reach = supports.direction[i].x * p.x + supports.direction[i].y * p.y;
        supports.reach[i] = reach > supports.reach[i] ? reach : supports.reach[i];
    }
    ++supports.count;
}

template <class T>
inline void add(Supports<T>& supports, LightSample<T> const& sample) noexcept {
    Vec2<T> const p = sample.place - supports.frame.middle;
    for (unsigned i = 0; i < unsigned(quad_directions); ++i) {
        Vec2<T> const& d = supports.direction[i];
        T const reach = glm::dot(d, p) + std::abs(glm::dot(d, sample.reach_x)) + std::abs(glm::dot(d, sample.reach_y));
        supports.reach[i] = reach > supports.reach[i] ? reach : supports.reach[i];
    }
    ++supports.count;
}

// Between the four sides that touch the samples in these directions (left, right, bottom, top; whole turns never
// matter), moved out by what rounding may take.
template <class T>
[[nodiscard]] inline Quad<T> quad_at(Supports<T> const& supports, std::array<int, 4> const& direction) noexcept {
    QuadSides<T> sides;
    static_assert((quad_directions & (quad_directions - 1)) == 0, "whole turns must not matter below zero");
    for (unsigned k = 0; k < 4; ++k) {
        auto const i = static_cast<unsigned>(direction[k]) % unsigned(quad_directions);
        // Coordinates of the frame are about 1 at the samples' ends.
        T const reach = supports.reach[i], slack = T(1e-4) * std::fmax(T(1), std::abs(reach));
        sides[k] = Vec3<T>(-supports.direction[i], reach + slack);
    }
    return moved(quad_between(sides), supports.frame.middle);
}

template <class T>
struct QuadFit {
    Quad<T> quad;
    std::array<int, 4> direction{};           // of left, right, bottom, top
    T price = std::numeric_limits<T>::max();  // the sum over all samples
};

namespace detail {

// Every stride-th of the samples listed.
template <class T>
[[nodiscard]] inline T price_in(Quad<T> const& quad, T usable_texels, LightSample<T> const* samples,
                                std::uint16_t const* list, int count, int stride) noexcept {
    T sum = T(0);
    for (int i = 0; i < count; i += stride) {
        LightSample<T> const& sample = samples[list[i]];
        if (sample.weight > T(0)) sum += sample.weight * shadowmath::price_of(major_at(quad, usable_texels, sample));
    }
    return sum * T(stride);
}

template <class T>
inline void consider(QuadFit<T>& best, Supports<T> const& supports, std::array<int, 4> const& direction,
                     T usable_texels, LightSample<T> const* samples, std::uint16_t const* list, int count,
                     int stride) noexcept {
    Quad<T> const quad = quad_at(supports, direction);
    if (!quad.visible) return;
    // Of no samples the smallest is as good as any.
    T const price = count > 0 ? price_in(quad, usable_texels, samples, list, count, stride) : area(quad);
    if (!(price < best.price)) return;
    best = {quad, direction, price};
}

}  // namespace detail

// The frame of the samples listed: their principal axes, one unit to their ends.
template <class T>
[[nodiscard]] inline SampleFrame<T> frame_of(LightSample<T> const* samples, std::uint16_t const* list,
                                             int count) noexcept {
    SampleFrame<T> frame;
    if (count <= 0) return frame;
    Vec2<T> sum(T(0));
    for (int i = 0; i < count; ++i) sum += samples[list[i]].place;
    frame.middle = sum / T(count);
    T xx = T(0), xy = T(0), yy = T(0);
    for (int i = 0; i < count; ++i) {
        Vec2<T> const p = samples[list[i]].place - frame.middle;
        xx += p.x * p.x;
        xy += p.x * p.y;
        yy += p.y * p.y;
    }
    T const angle = T(0.5) * std::atan2(T(2) * xy, xx - yy);
    Vec2<T> const a(std::cos(angle), std::sin(angle)), b(-a.y, a.x);
    T reach_a = T(0), reach_b = T(0);
    for (int i = 0; i < count; ++i) {
        LightSample<T> const& sample = samples[list[i]];
        Vec2<T> const p = sample.place - frame.middle;
        auto const along = [&](Vec2<T> const& axis) {
            return std::abs(glm::dot(axis, p)) + std::abs(glm::dot(axis, sample.reach_x)) +
                   std::abs(glm::dot(axis, sample.reach_y));
        };
        reach_a = std::fmax(reach_a, along(a));
        reach_b = std::fmax(reach_b, along(b));
    }
    T const least = std::fmax(std::fmax(reach_a, reach_b) * T(1e-4), T(1e-6));
    frame.a = a / std::fmax(reach_a, least);
    frame.b = b / std::fmax(reach_b, least);
    return frame;
}

// No single turn of a side by a 64th makes the price less. `stride` leaves samples out of the price, never out of the
// map. Not visible where there are no supports.
template <class T>
[[nodiscard]] inline QuadFit<T> fit_quad(Supports<T> const& supports, LightSample<T> const* samples,
                                         std::uint16_t const* list, int count, T usable_texels,
                                         int stride = 1) noexcept {
    QuadFit<T> best;
    if (supports.count == 0) return best;
    constexpr int quarter = quad_directions / 4;
    for (int r = 0; r < quarter; ++r)
        detail::consider(best, supports, {r + 2 * quarter, r, r + 3 * quarter, r + quarter}, usable_texels, samples,
                         list, count, stride);
    for (int step = quarter / 2; step >= 1;) {
        QuadFit<T> const before = best;
        for (unsigned k = 0; k < 4; ++k)
            for (int const turn : {-step, step}) {
                std::array<int, 4> moved = best.direction;
                moved[k] += turn;
                detail::consider(best, supports, moved, usable_texels, samples, list, count, stride);
            }
        // Two at once: a trapezoid's legs.
        for (int const turn : {-step, step}) {
            std::array<int, 4> legs = best.direction, ends = best.direction;
            legs[0] += turn, legs[1] -= turn;
            ends[2] += turn, ends[3] -= turn;
            detail::consider(best, supports, legs, usable_texels, samples, list, count, stride);
            detail::consider(best, supports, ends, usable_texels, samples, list, count, stride);
        }
        if (!(best.price < before.price * T(0.999))) step /= 2;
    }
    return best;
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/part_search.hpp ========
//
// Which part of what is seen gets a map of its own: cuts across depth, or across the picture, where they save most.
//
//   grown     one part to begin with; always the part and the cut that make the price least; depth alone, and freely
//   settled   each cut moves either way while that helps
//
// Cascades cut depth alone. That is nearly best for a street; not for a square seen from above, where four strips have
// texels four times as long as wide, and not for two fronts with a gap between.
//
// Everything is searched on at most max_search_samples samples, and no sum depends on anything but these: no clock, no
// randomness. At most 3 * 7 pairs of fits for a part, seven parts, and 3 * 6 * 3 * 4 fits to settle.
//
// Source: the greedy tree is that of classification trees (Breiman 1984).

namespace shadowmath {
inline namespace v0 {

inline constexpr int max_chosen_maps = 4;
inline constexpr int max_search_samples = 1024;

inline constexpr int max_settling_pieces = 1024;
inline constexpr int max_piece_points = 8;

// Points of the light's plane that one map must hold together (quad_settle.hpp).
template <class T>
struct SettlingPiece {
    std::array<Vec2<T>, max_piece_points> point;
    int count = 0;
};

// What one map makes of them all.
template <class T>
struct SettlingView {
    std::array<T, max_search_samples> price;              // of each sample; below 0: not in the map
    std::array<std::uint8_t, max_settling_pieces> holds;  // each piece
};

// What a search works on: 200 to 400 kB that the caller keeps, so that no stack has to. Nothing in it outlives a call.
template <class T>
struct MapSearch {
    std::array<LightSample<T>, max_search_samples> sample;
    std::array<std::uint16_t, max_search_samples> list;
    int count = 0;
    std::array<SettlingPiece<T>, max_settling_pieces> piece;
    int piece_count = 0;
    std::array<SettlingView<T>, max_chosen_maps + 2> view;
};

// Sides of the view, and eye depth: lo <= (side x, side y, depth) < hi.
template <class T>
struct ViewPart {
    Vec3<T> lo{std::numeric_limits<T>::lowest()};
    Vec3<T> hi{std::numeric_limits<T>::max()};
};

template <class T>
[[nodiscard]] inline bool is_in(ViewPart<T> const& part, Vec3<T> const& seen) noexcept {
    return part.lo.x <= seen.x && seen.x < part.hi.x && part.lo.y <= seen.y && seen.y < part.hi.y &&
           part.lo.z <= seen.z && seen.z < part.hi.z;
}

namespace detail {

inline constexpr int depth_axis = 2;

// Parts as a binary tree of cuts; leaves have no axis.
template <class T>
struct PartTree {
    struct Node {
        ViewPart<T> part;
        int axis = -1;
        T at = T(0);
        int child = 0;  // and the next one
        QuadFit<T> fit;
    };
    std::array<Node, 2 * max_chosen_maps> node;
    int count = 0;
    int leaves = 0;
    T price = std::numeric_limits<T>::max();
};

// `bound(part, count, supports)` adds what a map of the part must hold; the first `count` of work.list are its samples.
template <class T, class Bound>
struct PartSearch {
    MapSearch<T>& work;
    Bound const& bound;
    T usable_texels;
    int most_priced;  // samples that a fit is priced by
    int tried = 0;

    int gather(ViewPart<T> const& part) noexcept {
        unsigned n = 0;
        for (int i = 0; i < work.count; ++i)
            if (is_in(part, work.sample[static_cast<unsigned>(i)].seen)) work.list[n++] = static_cast<std::uint16_t>(i);
        return static_cast<int>(n);
    }

    QuadFit<T> fit(ViewPart<T> const& part) noexcept {
        int const n = gather(part);
        ++tried;
        QuadFit<T> fitted;
        fitted.price = T(0);
        if (n == 0) return fitted;
        Supports<T> supports = no_supports(frame_of(work.sample.data(), work.list.data(), n));
        bound(part, n, supports);
        int const stride = (n + most_priced - 1) / most_priced;
        return fit_quad(supports, work.sample.data(), work.list.data(), n, usable_texels, stride);
    }
};

template <class T>
struct PartPair {
    ViewPart<T> a;
    ViewPart<T> b;
};

template <class T>
[[nodiscard]] inline PartPair<T> cut(ViewPart<T> const& part, int axis, T at) noexcept {
    PartPair<T> pair{part, part};
    pair.a.hi[axis] = at;
    pair.b.lo[axis] = at;
    return pair;
}

// The place `share` of the way between the first and the last sample of the part: evenly, or in ratios of depth.
template <class T>
[[nodiscard]] inline T between_ends(MapSearch<T> const& work, ViewPart<T> const& part, int axis, T share) noexcept {
    T lo = std::numeric_limits<T>::max(), hi = std::numeric_limits<T>::lowest();
    for (int i = 0; i < work.count; ++i) {
        Vec3<T> const& seen = work.sample[static_cast<unsigned>(i)].seen;
        if (!is_in(part, seen)) continue;
        lo = std::fmin(lo, seen[axis]);
        hi = std::fmax(hi, seen[axis]);
    }
    if (!(lo < hi)) return lo;
    return axis == depth_axis ? lo * std::pow(hi / lo, share) : lo + (hi - lo) * share;
}

template <class T>
struct BestCut {
    int axis = -1;  // -1: none saves anything
    T at = T(0);
    T saved = T(0);
    QuadFit<T> a;
    QuadFit<T> b;
};

template <class T, class Bound>
[[nodiscard]] inline BestCut<T> best_cut(PartSearch<T, Bound>& search, ViewPart<T> const& part, T price,
                                         int first_axis) noexcept {
    BestCut<T> best;
    constexpr int steps = 8;
    for (int axis = depth_axis; axis >= first_axis; --axis)
        for (int k = 1; k < steps; ++k) {
            T const at = between_ends(search.work, part, axis, T(k) / T(steps));
            PartPair<T> const halves = cut(part, axis, at);
            QuadFit<T> const a = search.fit(halves.a), b = search.fit(halves.b);
            T const saved = price - a.price - b.price;
            if (saved > best.saved) best = {axis, at, saved, a, b};
        }
    return best;
}

template <class T, class Bound>
[[nodiscard]] inline PartTree<T> grown(PartSearch<T, Bound>& search, int most_leaves, bool by_depth_alone) noexcept {
    PartTree<T> tree;
    tree.node[0].fit = search.fit({});
    tree.price = tree.node[0].fit.price;
    tree.count = tree.leaves = 1;
    std::array<BestCut<T>, 2 * max_chosen_maps> best;
    unsigned known = 0;  // nodes whose best cut has been looked for
    while (tree.leaves < most_leaves) {
        int take = -1;
        for (unsigned n = 0; n < static_cast<unsigned>(tree.count); ++n) {
            auto const& node = tree.node[n];
            if (node.axis >= 0) continue;
            if (n >= known) best[n] = best_cut(search, node.part, node.fit.price, by_depth_alone ? depth_axis : 0);
            if (best[n].axis >= 0 && (take < 0 || best[n].saved > best[static_cast<unsigned>(take)].saved))
                take = static_cast<int>(n);
        }
        known = static_cast<unsigned>(tree.count);
        if (take < 0) break;
        auto& node = tree.node[static_cast<unsigned>(take)];
        BestCut<T> const& found = best[static_cast<unsigned>(take)];
        node.axis = found.axis;
        node.at = found.at;
        node.child = tree.count;
        PartPair<T> const halves = cut(node.part, node.axis, node.at);
        auto &a = tree.node[static_cast<unsigned>(tree.count)], &b = tree.node[static_cast<unsigned>(tree.count) + 1];
        a.part = halves.a;
        a.fit = found.a;
        b.part = halves.b;
        b.fit = found.b;
        tree.count += 2;
        ++tree.leaves;
        tree.price -= found.saved;
    }
    return tree;
}

// After a cut has moved: all parts and their fits anew.
template <class T, class Bound>
inline void refit(PartSearch<T, Bound>& search, PartTree<T>& tree) noexcept {
    tree.price = T(0);
    for (int n = 0; n < tree.count; ++n) {
        auto& node = tree.node[static_cast<unsigned>(n)];
        if (node.axis < 0) {
            node.fit = search.fit(node.part);
            tree.price += node.fit.price;
            continue;
        }
        PartPair<T> const halves = cut(node.part, node.axis, node.at);
        tree.node[static_cast<unsigned>(node.child)].part = halves.a;
        tree.node[static_cast<unsigned>(node.child) + 1].part = halves.b;
    }
}

template <class T, class Bound>
inline void settle(PartSearch<T, Bound>& search, PartTree<T>& tree) noexcept {
    for (T const step : {T(0.06), T(0.03), T(0.015)})
        for (int n = 0; n < tree.count; ++n) {
            if (tree.node[static_cast<unsigned>(n)].axis < 0) continue;
            for (T const way : {-step, step})
                for (int again = 0; again < 3; ++again) {
                    PartTree<T> moved = tree;
                    auto& node = moved.node[static_cast<unsigned>(n)];
                    T const lo = between_ends(search.work, node.part, node.axis, T(0));
                    T const hi = between_ends(search.work, node.part, node.axis, T(1));
                    if (!(lo < hi)) break;
                    node.at = node.axis == depth_axis ? node.at * std::pow(hi / lo, way) : node.at + (hi - lo) * way;
                    refit(search, moved);
                    if (!(moved.price < tree.price)) break;
                    tree = moved;
                }
        }
}

}  // namespace detail
}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/quad_stack.hpp ========
//
// Maps one behind another: the parts of a search as quadrilaterals, finest first, each around what no earlier one
// holds.
//
//   by_map (sampling.hpp) looks a point up in the first map that holds it, so what lies in an earlier one need not be
//   in a later one: that becomes smaller, and its texels finer. A part that the earlier ones hold whole gets no map.
//
// The last step of choose_maps.hpp; of no use without it.
//
// Source: none; that overlapping cascades serve best by containment is folklore.

namespace shadowmath {
inline namespace v0 {
namespace detail {

// The quadrilaterals of the parts, finest first, each around what no earlier one holds.
template <class T>
struct QuadStack {
    std::array<Quad<T>, max_chosen_maps> quad;
    std::array<ViewPart<T>, max_chosen_maps> part;  // that each was made for
    int count = 0;
    std::array<ViewPart<T>, max_chosen_maps> held;  // parts that needed none of their own
    int held_count = 0;

    template <class Visit>
    void for_each_part(Visit const& visit) const noexcept {
        for (int k = 0; k < count; ++k) visit(part[static_cast<unsigned>(k)]);
        for (int k = 0; k < held_count; ++k) visit(held[static_cast<unsigned>(k)]);
    }

    // The first that holds all of the points; -1: none.
    [[nodiscard]] int holder(Vec3<T> const* points, int point_count) const noexcept {
        for (int k = 0; k < count; ++k) {
            int inside = 0;
            while (inside < point_count && is_in(quad[static_cast<unsigned>(k)], Vec2<T>(points[inside]))) ++inside;
            if (inside == point_count) return k;
        }
        return -1;
    }
    [[nodiscard]] int holder(LightSample<T> const& sample) const noexcept {
        Vec3<T> const place(sample.place, sample.depth);
        return holder(&place, 1);
    }
};

// `cover(part, visit)` calls visit(points, count) for convex pieces that together hold all that may be seen in the
// part: a piece that an earlier quadrilateral holds whole is left out, any other is held whole.
template <class T, class Bound, class Cover>
[[nodiscard]] inline QuadStack<T> stacked(PartSearch<T, Bound>& search, PartTree<T> const& tree,
                                          Cover const& cover) noexcept {
    MapSearch<T>& work = search.work;
    std::array<unsigned, max_chosen_maps> order{};
    unsigned leaves = 0;
    for (unsigned n = 0; n < static_cast<unsigned>(tree.count); ++n) {
        if (tree.node[n].axis >= 0) continue;
        unsigned at = leaves++;
        for (; at > 0 && area(tree.node[order[at - 1]].fit.quad) > area(tree.node[n].fit.quad); --at)
            order[at] = order[at - 1];
        order[at] = n;
    }
    QuadStack<T> stack;
    for (unsigned k = 0; k < leaves; ++k) {
        ViewPart<T> const& part = tree.node[order[k]].part;
        int const all = search.gather(part);
        SampleFrame<T> const frame = frame_of(work.sample.data(), work.list.data(), all);
        unsigned own = 0;  // those that are left to this map
        for (unsigned i = 0; i < static_cast<unsigned>(all); ++i)
            if (stack.holder(work.sample[work.list[i]]) < 0) work.list[own++] = work.list[i];
        SampleFrame<T> const own_frame = frame_of(work.sample.data(), work.list.data(), static_cast<int>(own));
        Supports<T> supports = no_supports(own > 2 ? own_frame : frame);
        cover(part, [&](Vec3<T> const* points, int count) {
            if (stack.holder(points, count) >= 0) return;
            for (int i = 0; i < count; ++i) add(supports, Vec2<T>(points[i]));
        });
        QuadFit<T> const fit =
            fit_quad(supports, work.sample.data(), work.list.data(), static_cast<int>(own), search.usable_texels);
        if (!fit.quad.visible) {
            stack.held[static_cast<unsigned>(stack.held_count++)] = part;
            continue;
        }
        stack.part[static_cast<unsigned>(stack.count)] = part;
        stack.quad[static_cast<unsigned>(stack.count++)] = fit.quad;
    }
    return stack;
}

// All samples, each in the first map that holds it; those that none holds are lost.
template <class T>
[[nodiscard]] inline T price_in(QuadStack<T> const& stack, MapSearch<T> const& work, T usable_texels) noexcept {
    T sum = T(0);
    for (int i = 0; i < work.count; ++i) {
        LightSample<T> const& sample = work.sample[static_cast<unsigned>(i)];
        int const k = stack.holder(sample);
        T const major =
            k < 0 ? footprint_limit<T> : major_at(stack.quad[static_cast<unsigned>(k)], usable_texels, sample);
        sum += sample.weight * price_of(major);
    }
    return sum;
}

// Of each map the depths that it serves. A piece inside one map is served there. One that lies across several is in
// each of them with some of its points, and whole in the map of its own part.
template <class T, class Cover>
[[nodiscard]] inline std::array<Extent<T>, max_chosen_maps> depths_served(QuadStack<T> const& stack,
                                                                          Cover const& cover) noexcept {
    std::array<Extent<T>, max_chosen_maps> depth;
    auto const reach = [&](ViewPart<T> const& part, int own) {
        cover(part, [&](Vec3<T> const* points, int count) {
            int const holder = stack.holder(points, count);
            // A side touches its points, so rounding may put one outside: it is its own part's all the same.
            int const serving = holder < 0 ? own : holder;
            for (int i = 0; i < count && serving >= 0; ++i) depth[static_cast<unsigned>(serving)].add(points[i].z);
        });
    };
    for (int k = 0; k < stack.count; ++k) reach(stack.part[static_cast<unsigned>(k)], k);
    for (int k = 0; k < stack.held_count; ++k) reach(stack.held[static_cast<unsigned>(k)], -1);
    return depth;
}

// A map that serves no piece would be drawn for nothing: all of its own part is whole in others.
template <class T>
inline void leave_out_idle(QuadStack<T>& stack, std::array<Extent<T>, max_chosen_maps>& depth) noexcept {
    unsigned kept = 0;
    for (unsigned k = 0; k < static_cast<unsigned>(stack.count); ++k) {
        if (!(depth[k].lo <= depth[k].hi)) {
            stack.held[static_cast<unsigned>(stack.held_count++)] = stack.part[k];
            continue;
        }
        stack.quad[kept] = stack.quad[k];
        stack.part[kept] = stack.part[k];
        depth[kept++] = depth[k];
    }
    stack.count = static_cast<int>(kept);
}

}  // namespace detail
}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/quad_settle.hpp ========
//
// The last tenth: four quadrilaterals move against each other, corner by corner, until no small move makes the picture
// better.
//
//   A part's quadrilateral is the best around that part (fit_quad.hpp). Parts, though, are cut across the picture or
//   across depth, and what lies along a cut may be served better from the other side. Here a corner or a side moves; a
//   piece that falls out is taken in by the neighbour to whom that costs least, who grows around it.
//
// A piece is a few points that one map must hold together, such as a tile between its two depths. The pieces looked at
// are some of all, and those at the rim; at the end all of them are, and a quadrilateral grows around what none holds.
//
// A step of choose_maps.hpp; of no use without it. Source: none.

namespace shadowmath {
inline namespace v0 {
namespace detail {

// Sides of a quadrilateral about its own middle.
template <class T>
struct SidedQuad {
    QuadSides<T> side{};
    Vec2<T> middle{T(0)};
};

// Through corners in the order of Quad::corner.
template <class T>
[[nodiscard]] inline SidedQuad<T> sides_of(std::array<Vec2<T>, 4> const& corner) noexcept {
    SidedQuad<T> sided;
    sided.middle = (corner[0] + corner[1] + corner[2] + corner[3]) * T(0.25);
    auto const through = [&](unsigned i, unsigned j) {
        Vec2<T> const a = corner[i] - sided.middle, b = corner[j] - sided.middle;
        Vec3<T> const line(a.y - b.y, b.x - a.x, a.x * b.y - a.y * b.x);
        return line.z < T(0) ? -line : line;
    };
    sided.side = {through(0, 2), through(1, 3), through(0, 1), through(2, 3)};
    return sided;
}

template <class T>
[[nodiscard]] inline Quad<T> quad_of(SidedQuad<T> const& sided) noexcept {
    return moved(quad_between(sided.side), sided.middle);
}

// Each side moved out, where it stands, until the points (their x and y) are inside and a little more.
template <class T, class Point>
inline void grow(SidedQuad<T>& sided, Point const* points, int count) noexcept {
    for (Vec3<T>& side : sided.side) {
        T least = T(0);
        for (int i = 0; i < count; ++i) {
            Vec2<T> const p = Vec2<T>(points[i]) - sided.middle;
            T const inside = side.x * p.x + side.y * p.y + side.z;
            least = inside < least ? inside : least;
        }
        if (least < T(0)) side.z = (side.z - least) * (T(1) + T(1e-4));
    }
}

template <class T>
[[nodiscard]] inline bool holds(Quad<T> const& quad, SettlingPiece<T> const& piece) noexcept {
    for (int i = 0; i < piece.count; ++i)
        if (!is_in(quad, piece.point[static_cast<unsigned>(i)])) return false;
    return true;
}

template <class T>
class Settling {
public:
    Settling(MapSearch<T>& work, QuadStack<T> const& stack, T usable_texels) noexcept
        : work_(work), stack_(stack), usable_(usable_texels) {
        for (unsigned k = 0; k < maps(); ++k) {
            slot_[k] = k;
            judge(slot_[k], stack_.quad[k]);
        }
        price_ = price_with(maps(), 0, maps(), 0);
    }

    // Until no move of the smallest size helps, or `rounds` are over.
    void run(int rounds) noexcept {
        T step = T(0.16);
        for (int round = 0; round < rounds && step > T(0.01); ++round) {
            T const before = price_;
            for (unsigned k = 0; k < maps(); ++k)
                for (unsigned way = 0; way < ways; ++way) try_move(k, way, step);
            if (!(price_ < before * T(0.995))) step *= T(0.5);
        }
    }

    [[nodiscard]] QuadStack<T> const& stack() const noexcept { return stack_; }

private:
    static constexpr unsigned ways = 24;

    [[nodiscard]] unsigned maps() const noexcept { return static_cast<unsigned>(stack_.count); }

    void judge(unsigned slot, Quad<T> const& quad) noexcept {
        SettlingView<T>& view = work_.view[slot];
        for (unsigned i = 0; i < static_cast<unsigned>(work_.count); ++i) {
            LightSample<T> const& sample = work_.sample[i];
            view.price[i] =
                is_in(quad, sample.place) ? sample.weight * price_of(major_at(quad, usable_, sample)) : T(-1);
        }
        for (unsigned i = 0; i < static_cast<unsigned>(work_.piece_count); ++i)
            view.holds[i] = holds(quad, work_.piece[i]) ? 1 : 0;
    }

    // Of all samples, with map a in slot_a instead of its own, and b in slot_b; maps() for none.
    [[nodiscard]] T price_with(unsigned a, unsigned slot_a, unsigned b, unsigned slot_b) const noexcept {
        std::array<SettlingView<T> const*, max_chosen_maps> view{};
        for (unsigned k = 0; k < maps(); ++k) view[k] = &work_.view[k == a ? slot_a : k == b ? slot_b : slot_[k]];
        T sum = T(0);
        for (unsigned i = 0; i < static_cast<unsigned>(work_.count); ++i) {
            T price = T(-1);
            for (unsigned k = 0; k < maps() && price < T(0); ++k) price = view[k]->price[i];
            sum += price < T(0) ? work_.sample[i].weight * price_of(footprint_limit<T>) : price;
        }
        return sum;
    }

    [[nodiscard]] unsigned free_slot(unsigned but) const noexcept {
        for (unsigned slot = 0;; ++slot) {
            bool taken = slot == but;
            for (unsigned k = 0; k < maps(); ++k) taken = taken || slot_[k] == slot;
            if (!taken) return slot;
        }
    }

    // Each corner along either of its sides, and each side along its two neighbours: out and in.
    [[nodiscard]] static std::array<Vec2<T>, 4> moved_corners(Quad<T> const& quad, unsigned way, T step) noexcept {
        std::array<Vec2<T>, 4> const& c = quad.corner;
        std::array<Vec2<T>, 4> moved = c;
        T const size = way % 2 == 0 ? -step : step;
        unsigned const what = way / 2;
        auto const along_x = [&](unsigned i) { moved[i] += (c[i] - c[i ^ 1u]) * size; };
        auto const along_y = [&](unsigned i) { moved[i] += (c[i] - c[i ^ 2u]) * size; };
        switch (what) {
            case 0: along_x(0), along_x(2); break;
            case 1: along_x(1), along_x(3); break;
            case 2: along_y(0), along_y(1); break;
            case 3: along_y(2), along_y(3); break;
            default:
                if (what % 2 == 0)
                    along_x((what - 4) / 2);
                else
                    along_y((what - 4) / 2);
        }
        return moved;
    }

    void try_move(unsigned k, unsigned way, T step) noexcept {
        Quad<T> const quad = quad_of(sides_of(moved_corners(stack_.quad[k], way, step)));
        if (!quad.visible) return;
        unsigned const slot = free_slot(~0u);
        judge(slot, quad);
        int lost = 0;
        for (unsigned i = 0; i < static_cast<unsigned>(work_.piece_count); ++i) {
            bool held = work_.view[slot].holds[i] != 0;
            for (unsigned j = 0; j < maps() && !held; ++j) held = j != k && work_.view[slot_[j]].holds[i] != 0;
            if (!held) work_.list[static_cast<unsigned>(lost++)] = static_cast<std::uint16_t>(i);
        }
        T const enough = price_ * T(0.9995);
        if (lost == 0) {
            T const price = price_with(k, slot, maps(), 0);
            if (!(price < enough)) return;
            take(k, slot, quad, price);
            return;
        }
        if (4 * lost > work_.piece_count) return;
        T least = enough;
        unsigned best = maps();
        Quad<T> best_quad;
        unsigned const other = free_slot(slot);
        for (unsigned j = 0; j < maps(); ++j) {
            if (j == k) continue;
            Quad<T> const grown = around_lost(j, lost);
            if (!grown.visible) continue;
            judge(other, grown);
            if (!takes_in(other, lost)) continue;
            T const price = price_with(k, slot, j, other);
            if (!(price < least)) continue;
            least = price;
            best = j;
            best_quad = grown;
        }
        if (best == maps()) return;
        judge(other, best_quad);
        take(k, slot, quad, least);
        take(best, other, best_quad, least);
    }

    [[nodiscard]] Quad<T> around_lost(unsigned map, int lost) const noexcept {
        SidedQuad<T> sided = sides_of(stack_.quad[map].corner);
        for (int i = 0; i < lost; ++i) {
            SettlingPiece<T> const& piece = work_.piece[work_.list[static_cast<unsigned>(i)]];
            grow(sided, piece.point.data(), piece.count);
        }
        return quad_of(sided);
    }

    [[nodiscard]] bool takes_in(unsigned slot, int lost) const noexcept {
        for (int i = 0; i < lost; ++i)
            if (work_.view[slot].holds[work_.list[static_cast<unsigned>(i)]] == 0) return false;
        return true;
    }

    void take(unsigned map, unsigned slot, Quad<T> const& quad, T price) noexcept {
        slot_[map] = slot;
        stack_.quad[map] = quad;
        price_ = price;
    }

    MapSearch<T>& work_;
    QuadStack<T> stack_;
    T usable_;
    std::array<unsigned, max_chosen_maps> slot_{};
    T price_ = std::numeric_limits<T>::max();
};

template <class T>
[[nodiscard]] inline T farthest_along(Vec2<T> const& way, Vec3<T> const* points, int count) noexcept {
    T farthest = std::numeric_limits<T>::lowest();
    for (int i = 0; i < count; ++i) {
        T const here = way.x * points[i].x + way.y * points[i].y;
        farthest = here > farthest ? here : farthest;
    }
    return farthest;
}

// The octagon around more points than a piece can keep.
template <class T>
inline void outline(SettlingPiece<T>& piece, Vec3<T> const* points, int count) noexcept {
    constexpr unsigned sides = 8;
    static_assert(sides == max_piece_points);
    T const half = std::sqrt(T(0.5));
    std::array<Vec2<T>, sides> const way{Vec2<T>(1, 0),  Vec2<T>(half, half),   Vec2<T>(0, 1),  Vec2<T>(-half, half),
                                         Vec2<T>(-1, 0), Vec2<T>(-half, -half), Vec2<T>(0, -1), Vec2<T>(half, -half)};
    std::array<T, sides> reach;
    for (unsigned d = 0; d < sides; ++d) reach[d] = farthest_along(way[d], points, count);
    // Where two neighbouring sides meet: half a right angle apart, so the determinant is its sine.
    for (unsigned d = 0; d < sides; ++d) {
        unsigned const e = (d + 1) % sides;
        piece.point[d] =
            Vec2<T>(reach[d] * way[e].y - reach[e] * way[d].y, reach[e] * way[d].x - reach[d] * way[e].x) / half;
    }
}

// Every n-th of the pieces of the stack's parts, n as small as there is room, and in each part those that reach
// farthest in each of the directions of fit_quad.
template <class T, class Cover>
inline void take_pieces(MapSearch<T>& work, QuadStack<T> const& stack, Cover const& cover) noexcept {
    int all = 0;
    stack.for_each_part([&](ViewPart<T> const& part) { cover(part, [&](Vec3<T> const*, int) { ++all; }); });
    work.piece_count = 0;
    auto const put = [&work](unsigned at, Vec3<T> const* points, int count) {
        SettlingPiece<T>& piece = work.piece[at];
        piece.count = count < max_piece_points ? count : max_piece_points;
        if (count <= max_piece_points)
            for (int i = 0; i < count; ++i) piece.point[static_cast<unsigned>(i)] = Vec2<T>(points[i]);
        else
            outline(piece, points, count);
    };
    constexpr int at_rim = quad_directions * max_chosen_maps, even = max_settling_pieces - at_rim;
    Supports<T> const around = no_supports(SampleFrame<T>{});
    int const stride = (all + even - 1) / even;
    int room = even;  // up to the rims of the parts still to come
    stack.for_each_part([&](ViewPart<T> const& part) {
        std::array<T, quad_directions> reach;
        reach.fill(std::numeric_limits<T>::lowest());
        auto const rim = static_cast<unsigned>(work.piece_count);
        work.piece_count += quad_directions;
        room += quad_directions;
        for (unsigned d = 0; d < quad_directions; ++d) work.piece[rim + d].count = 0;
        int seen = 0;
        cover(part, [&](Vec3<T> const* points, int count) {
            for (unsigned d = 0; d < quad_directions; ++d) {
                T const farthest = farthest_along(around.direction[d], points, count);
                if (!(farthest > reach[d])) continue;
                reach[d] = farthest;
                put(rim + d, points, count);
            }
            if (seen++ % stride == 0 && work.piece_count < room)
                put(static_cast<unsigned>(work.piece_count++), points, count);
        });
    });
}

// The stack with its quadrilaterals moved so that its `price` (price_in) is less; every piece of its parts is in one of
// them, whole, as before. Stack and price as they were where that cannot be had.
template <class T, class Cover>
[[nodiscard]] inline QuadStack<T> settled(MapSearch<T>& work, QuadStack<T> const& stack, T usable_texels,
                                          Cover const& cover, T& price) noexcept {
    if (stack.count < 2) return stack;
    take_pieces(work, stack, cover);
    Settling<T> settling(work, stack, usable_texels);
    settling.run(24);
    QuadStack<T> settled = settling.stack();
    std::array<SidedQuad<T>, max_chosen_maps> sided;
    for (unsigned k = 0; k < static_cast<unsigned>(settled.count); ++k) sided[k] = sides_of(settled.quad[k].corner);
    bool sound = true;
    auto const keep = [&](Vec3<T> const* points, int count) {
        if (!sound || settled.holder(points, count) >= 0) return;
        // Whose area grows least, of all.
        T least = std::numeric_limits<T>::max();
        unsigned best = max_chosen_maps;
        SidedQuad<T> best_sides;
        Quad<T> best_quad;
        for (unsigned k = 0; k < static_cast<unsigned>(settled.count); ++k) {
            SidedQuad<T> grown = sided[k];
            grow(grown, points, count);
            Quad<T> const quad = quad_of(grown);
            if (!quad.visible) continue;
            T const more = area(quad) / area(settled.quad[k]);
            if (!(more < least)) continue;
            least = more;
            best = k;
            best_sides = grown;
            best_quad = quad;
        }
        if (best == max_chosen_maps) {
            sound = false;
            return;
        }
        sided[best] = best_sides;
        settled.quad[best] = best_quad;
        sound = settled.holder(points, count) >= 0;
    };
    stack.for_each_part([&](ViewPart<T> const& part) { cover(part, keep); });
    T const after = price_in(settled, work, usable_texels);
    if (!sound || !(after < price)) return stack;
    price = after;
    return settled;
}

}  // namespace detail
}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/choose_maps.hpp ========
//
// Maps instead of options: up to four, put where the picture needs them, found by measuring.
//
//   from a depth buffer   ── what the eye sees, tile by tile ──┐                        ┌─ quad_map ── map 0
//                                                              ├─ parts ── fit_quad ────┼─ quad_map ── map 1
//   from boxes alone      ── what it may see (box_samples) ────┘  (part_search)         └─ ...
//
// Before they are maps, the quadrilaterals move against each other once more (quad_settle.hpp).
//
// Every map of a sun is a homography of the light's plane: a box, a rectangle at any angle, a warp of any strength, a
// view-dependent map. So none of these is a policy here. Each part of the picture gets the quadrilateral whose texels
// look smallest in it, whatever it may be called. Maps come finest first and are looked up by by_map (sampling.hpp): a
// point inside two gets the finer one, and a later map leaves out what an earlier one holds already.
//
// Use it when edges may crawl a little: they move with the camera, as those of all fits to what is seen do. Where
// nothing may, choose.hpp finds options for stable cascades. A search takes milliseconds, not microseconds: at the
// loading of a level, when the camera has gone elsewhere, or on another thread, a frame behind.
//
// Source: none; the parts stand where Lauritzen, Salvi and Lefohn (I3D 2011) have boxes.

namespace shadowmath {
inline namespace v0 {

template <class T>
struct MapLimits {
    Vec2<T> eye_pixels{T(1920), T(1080)};  // the picture that shadows are for
    int maps = 4;                          // at most; 1 to max_chosen_maps
    int map_size = 1024;                   // texels along one side of each
    T margin_texels = T(2);                // free on every side: half the width of the PCF kernel, and one
    ClipSpace clip = gl_clip;              // the convention of the pass that draws the maps
};

// Nearest and farthest eye depth in each of width * height equal tiles of the picture, row by row from its bottom: what
// a renderer's depth pyramid holds, of surfaces within the shadow distance that face the light. A tile where nothing
// is seen has nearest > farthest.
template <class T>
struct DepthTiles {
    T const* nearest = nullptr;
    T const* farthest = nullptr;
    int width = 0;
    int height = 0;
};

// What a map has become, in the words of the other headers.
enum class MapShape : std::uint8_t {
    rectangle,  // at some angle, its texels alike all over
    warp,       // a perspective one: texels grow from one end to the other
    lopsided    // a warp whose sides are not alike, or sheared
};

[[nodiscard]] constexpr char const* describe(MapShape shape) noexcept {
    switch (shape) {
        case MapShape::rectangle: return "a rectangle at the best angle: texels as fine at one end as at the other";
        case MapShape::warp: return "a perspective warp: fine texels where the picture needs them, coarse ones beyond";
        case MapShape::lopsided: return "four free sides: the part is wider, or seen from nearer, at one corner";
    }
    return "no map";
}

template <class T>
struct ChosenMap {
    ShadowMap<T> map;
    ViewPart<T> part;  // of the view that it was made for; it serves whatever else it holds, too
    MapShape shape = MapShape::rectangle;
    T growth = T(1);  // how many times longer a texel is at the coarse end than at the fine one
    int samples = 0;  // of the search, that it serves
    T mean = T(0);    // of their footprints, eye pixels a texel along its longer axis
    T worst = T(0);
};

template <class T>
struct ChosenMaps {
    std::array<ChosenMap<T>, max_chosen_maps> at;
    int count = 0;     // 0: nothing to draw, everything lit
    int tried = 0;     // fits
    T one_map = T(0);  // the price of a sample (price_of) with a single map of this size
    T price = T(0);    // and with those chosen
    Faults faults;

    [[nodiscard]] ChosenMap<T> const* begin() const noexcept { return at.data(); }
    [[nodiscard]] ChosenMap<T> const* end() const noexcept { return at.data() + count; }
};

namespace detail {

// Samples that a candidate is priced by.
inline constexpr int priced_samples = 256;

template <class T>
[[nodiscard]] inline MapShape shape_of(Quad<T> const& quad) noexcept {
    if (quad.w_least > T(0.95)) {
        T const cosine = glm::dot(safe_normalize(Vec3<T>(Vec2<T>(quad.x), T(0))).direction,
                                  safe_normalize(Vec3<T>(Vec2<T>(quad.y), T(0))).direction);
        return std::abs(cosine) < T(0.1) ? MapShape::rectangle : MapShape::lopsided;
    }
    // A warp along one axis leaves w alone along the other.
    T const along_x = std::abs(quad.w.x * quad.y.y - quad.w.y * quad.y.x);
    T const along_y = std::abs(quad.w.x * quad.x.y - quad.w.y * quad.x.x);
    T const lesser = along_x < along_y ? along_x : along_y, greater = along_x < along_y ? along_y : along_x;
    return lesser < T(0.2) * greater ? MapShape::warp : MapShape::lopsided;
}

// `cover(part, visit)` calls visit(points, count) for convex pieces that together hold all that may be seen in the
// part: points in light space, relative to the eye. `bound` as for PartSearch: the same, or quicker and nearly so.
template <class T, class Bound, class Cover>
[[nodiscard]] inline ChosenMaps<T> search_maps(LightSampler<T> const& sampler, Aabb<T> const& casters,
                                               MapLimits<T> const& limits, MapSearch<T>& work, Bound const& bound,
                                               Cover const& cover) noexcept {
    ChosenMaps<T> chosen;
    if (work.count == 0) return chosen;
    PartSearch<T, Bound> search{work, bound, usable_texels(limits.map_size, limits.margin_texels), priced_samples};
    int const most = glm::clamp(limits.maps, 1, max_chosen_maps);
    if (most != limits.maps) chosen.faults |= Fault::count_clamped;
    // Two searches, and the better outcome: what is seen between the samples may cost one of them more.
    QuadStack<T> stack;
    T least = std::numeric_limits<T>::max();
    for (bool const by_depth_alone : {true, false}) {
        PartTree<T> tree = grown(search, most, by_depth_alone);
        chosen.one_map = tree.node[0].fit.price;
        settle(search, tree);
        QuadStack<T> const candidate = stacked(search, tree, cover);
        T const price = price_in(candidate, work, search.usable_texels);
        if (!(price < least)) continue;
        least = price;
        stack = candidate;
    }
    chosen.tried = search.tried;
    stack = settled(work, stack, search.usable_texels, cover, least);

    std::array<Extent<T>, max_chosen_maps> depth = depths_served(stack, cover);
    leave_out_idle(stack, depth);
    for (int k = 0; k < stack.count; ++k) {
        Extent<T> const& along = depth[static_cast<unsigned>(k)];
        Quad<T> const& quad = stack.quad[static_cast<unsigned>(k)];
        ChosenMap<T>& made = chosen.at[static_cast<unsigned>(chosen.count)];
        T const room = T(1e-3) * (along.hi - along.lo) + T(1e-3);
        made.map = quad_map(quad, sampler.basis, sampler.view.pose.position, along.lo - room, along.hi + room, casters,
                            limits.map_size, limits.margin_texels, limits.clip);
        chosen.faults |= made.map.faults;
        if (!made.map.visible) continue;
        made.part = stack.part[static_cast<unsigned>(k)];
        made.shape = shape_of(quad);
        made.growth = T(1) / quad.w_least;
        T sum = T(0);
        for (int i = 0; i < work.count; ++i) {
            LightSample<T> const& sample = work.sample[static_cast<unsigned>(i)];
            if (stack.holder(sample) != k) continue;
            T const major = major_at(quad, search.usable_texels, sample);
            sum += major;
            made.worst = std::fmax(made.worst, major);
            ++made.samples;
        }
        made.mean = made.samples > 0 ? sum / T(made.samples) : T(0);
        ++chosen.count;
    }
    T weight = T(0);
    for (int i = 0; i < work.count; ++i) weight += work.sample[static_cast<unsigned>(i)].weight;
    chosen.one_map /= weight;
    chosen.price = price_in(stack, work, search.usable_texels) / weight;
    return chosen;
}

// At most max_search_samples of the samples, evenly.
template <class T>
inline void take_samples(MapSearch<T>& work, LightSampler<T> const& sampler, SurfacePoint<T> const* samples,
                         int count) noexcept {
    auto const is_asked = [](LightSample<T> const& sample) { return sample.usable && sample.weight > T(0); };
    int asked = 0;
    for (int i = 0; i < count; ++i) asked += is_asked(light_sample(sampler, samples[i])) ? 1 : 0;
    int const stride = (asked + max_search_samples - 1) / max_search_samples;
    int seen = 0;
    work.count = 0;
    for (int i = 0; i < count; ++i) {
        LightSample<T> const sample = light_sample(sampler, samples[i]);
        if (!is_asked(sample)) continue;
        // One of each `stride`, not always the same one: else all might lie in a few columns of the picture.
        if (seen % stride == seen / stride * 7 % stride) work.sample[static_cast<unsigned>(work.count++)] = sample;
        ++seen;
    }
}

// The same of the tiles' own middles, where nothing is known of their surfaces.
template <class T>
inline void take_tiles(MapSearch<T>& work, LightSampler<T> const& sampler, Light<T> const& light,
                       DepthTiles<T> const& tiles) noexcept {
    ViewVolume<T> const& view = sampler.view;
    int const count = tiles.width * tiles.height, stride = (count + max_search_samples - 1) / max_search_samples;
    work.count = 0;
    for (int i = 0; i < count; ++i) {
        T const *const nearest = tiles.nearest + i, *const farthest = tiles.farthest + i;
        if (i % stride != i / stride * 7 % stride || !all_finite(nearest, 1) || !all_finite(farthest, 1)) continue;
        T const depth = glm::clamp(T(0.5) * *nearest + T(0.5) * *farthest, view.z_near, view.z_far);
        if (!(*nearest <= *farthest && *nearest <= view.z_far && *farthest >= view.z_near && depth > T(0))) continue;
        T const x = (T(i % tiles.width) + T(0.5)) / T(tiles.width);
        T const y = (T(i / tiles.width) + T(0.5)) / T(tiles.height);
        Vec3<T> const point =
            point_at(view, view.left + (view.right - view.left) * x, view.bottom + (view.top - view.bottom) * y, depth);
        LightSample<T> sample = light_sample(sampler, {point, neutral_normal(view, light, point)});
        sample.weight = T(1);
        if (sample.usable) work.sample[static_cast<unsigned>(work.count++)] = sample;
    }
}

// Spots have no light's plane.
template <class T>
[[nodiscard]] inline Door<T> door_of_choice(ViewVolume<T> const& view, Light<T> const& light, Aabb<T> const& casters,
                                            MapLimits<T> const& limits) noexcept {
    Door<T> in = door(view, light, casters, casters, limits.map_size, limits.margin_texels);
    bool const pixels = all_finite(limits.eye_pixels) && limits.eye_pixels.x > T(0) && limits.eye_pixels.y > T(0);
    if (light.kind != LightKind::directional || !pixels) in.faults |= Fault::clamped_option;
    in.stop = in.stop || light.kind != LightKind::directional || !pixels;
    return in;
}

}  // namespace detail

// Every point of every tile between its two depths is in one of the maps, with margin_texels to spare on each side, and
// every caster of the box between it and the sun is in that map. `samples`, a surface each from somewhere in a tile,
// only weigh what is worth texels; those turned away from the light count for nothing, and where none is left the tiles
// weigh alike. The same inputs give the same maps. Depths that are no numbers, or not in front of the eye, are no
// tiles; the last are cut at view.z_far.
//
// Not visible, and no fault: no casters, no tiles. A spot is clamped_option, as are pixels <= 0.
template <class T>
[[nodiscard]] inline ChosenMaps<T> choose_maps(ViewVolume<T> const& view, Light<T> const& light, Aabb<T> const& casters,
                                               SurfacePoint<T> const* samples, int sample_count,
                                               DepthTiles<T> const& tiles, MapLimits<T> const& limits,
                                               MapSearch<T>& work) noexcept {
    SHADOWMATH_ASSERT(samples != nullptr || sample_count <= 0, "a choice needs its samples");
    bool const has_tiles = tiles.width > 0 && tiles.height > 0;
    SHADOWMATH_ASSERT(!has_tiles || (tiles.nearest != nullptr && tiles.farthest != nullptr), "tiles need both depths");
    ChosenMaps<T> none;
    Door<T> const in = detail::door_of_choice(view, light, casters, limits);
    none.faults = in.faults;
    if (in.stop || !has_tiles) return none;
    ViewVolume<T> const& eye = in.view;
    LightSampler<T> const sampler =
        light_sampler(eye, in.light, limits.eye_pixels, Vec2<T>(T(tiles.width), T(tiles.height)));
    if (!sampler.usable) return none;
    detail::take_samples(work, sampler, samples, sample_count);
    if (work.count == 0) detail::take_tiles(work, sampler, in.light, tiles);
    Vec3<T> const right = in_light(sampler.basis, eye.pose.right), up = in_light(sampler.basis, eye.pose.up);
    Vec3<T> const forward = in_light(sampler.basis, eye.pose.forward);
    bool const flat = eye.kind == ViewKind::orthographic;
    Vec2<T> const first(eye.left, eye.bottom);
    Vec2<T> const size((eye.right - eye.left) / T(tiles.width), (eye.top - eye.bottom) / T(tiles.height));
    auto const visit_tile = [&](int x, int y, ViewPart<T> const& part, auto const& visit) {
        constexpr T slack = T(1e-5);  // receivers are drawn by another pass than the depths were
        T const* const nearest = tiles.nearest + y * tiles.width + x;
        T const* const farthest = tiles.farthest + y * tiles.width + x;
        if (!all_finite(nearest, 1) || !all_finite(farthest, 1) || !(*nearest <= *farthest)) return;
        Vec2<T> const tile = first + size * Vec2<T>(T(x), T(y));
        Vec3<T> const tile_lo(tile, std::fmax(*nearest * (T(1) - slack), eye.z_near * (T(1) - slack)));
        Vec3<T> const tile_hi(tile + size, std::fmin(*farthest * (T(1) + slack), eye.z_far * (T(1) + slack)));
        Vec3<T> const lo = glm::max(tile_lo, part.lo), hi = glm::min(tile_hi, part.hi);
        if (!(lo.x <= hi.x && lo.y <= hi.y && lo.z <= hi.z && hi.z > T(0))) return;
        std::array<Vec3<T>, 8> points;
        for (unsigned i = 0; i < 8; ++i) {
            T const z = (i & 4u) != 0 ? hi.z : lo.z, spread = flat ? T(1) : z;
            T const side_x = (i & 1u) != 0 ? hi.x : lo.x, side_y = (i & 2u) != 0 ? hi.y : lo.y;
            points[i] = forward * z + (right * side_x + up * side_y) * spread;
        }
        visit(points.data(), 8);
    };
    auto const cover = [&](ViewPart<T> const& part, auto const& visit) {
        for (int y = 0; y < tiles.height; ++y)
            for (int x = 0; x < tiles.width; ++x) visit_tile(x, y, part, visit);
    };
    // To the search the tiles of its samples are all of them.
    auto const bound = [&](ViewPart<T> const& part, int count, Supports<T>& supports) {
        for (int i = 0; i < count; ++i) {
            LightSample<T> const& sample = work.sample[work.list[static_cast<unsigned>(i)]];
            add(supports, sample.place);
            Vec2<T> const tile = (Vec2<T>(sample.seen) - first) / size;
            // One from outside the picture is as good as on its border.
            int const x = static_cast<int>(std::fmin(std::fmax(tile.x, T(0)), T(tiles.width - 1)));
            int const y = static_cast<int>(std::fmin(std::fmax(tile.y, T(0)), T(tiles.height - 1)));
            visit_tile(x, y, part, [&](Vec3<T> const* points, int point_count) {
                for (int k = 0; k < point_count; ++k) add(supports, Vec2<T>(points[k]));
            });
        }
    };
    ChosenMaps<T> chosen = detail::search_maps(sampler, casters, limits, work, bound, cover);
    chosen.faults |= in.faults;
    return chosen;
}

// The same where there is no depth buffer: every point of the boxes that the eye may see, up to view.z_far, is in one
// of the maps, and so is every caster between it and the sun. What is worth texels is guessed (box_samples.hpp). Boxes
// that are empty or not finite are no receivers; large ones are cut to the view.
template <class T>
[[nodiscard]] inline ChosenMaps<T> choose_maps(ViewVolume<T> const& view, Light<T> const& light, Aabb<T> const& casters,
                                               Aabb<T> const* receivers, int receiver_count, MapLimits<T> const& limits,
                                               MapSearch<T>& work) noexcept {
    SHADOWMATH_ASSERT(receivers != nullptr || receiver_count <= 0, "a choice needs its receivers");
    ChosenMaps<T> none;
    Door<T> const in = detail::door_of_choice(view, light, casters, limits);
    none.faults = in.faults;
    if (in.stop) return none;
    ViewVolume<T> const& eye = in.view;
    LightSampler<T> const sampler = light_sampler(eye, in.light, limits.eye_pixels * leaning_surfaces<T>,
                                                  Vec2<T>(T(guess_rays_x), T(guess_rays_y)));
    if (!sampler.usable) return none;
    work.count = guesses_in_boxes(sampler, in.light, receivers, receiver_count, work.sample.data(), max_search_samples);
    auto const cover = [&](ViewPart<T> const& part, auto const& visit) {
        ViewVolume<T> piece = eye;
        piece.left = std::fmax(eye.left, part.lo.x);
        piece.right = std::fmin(eye.right, part.hi.x);
        piece.bottom = std::fmax(eye.bottom, part.lo.y);
        piece.top = std::fmin(eye.top, part.hi.y);
        piece.z_near = std::fmax(eye.z_near, part.lo.z);
        piece.z_far = std::fmin(eye.z_far, part.hi.z);
        if (!(piece.left < piece.right && piece.bottom < piece.top && piece.z_near < piece.z_far)) return;
        T const slack =
            T(16) * std::numeric_limits<T>::epsilon() * (piece.z_far + detail::largest_of(eye.pose.position));
        Aabb<T> around = bounds_of(corners(piece));
        around.lo -= slack;
        around.hi += slack;
        for (int i = 0; i < receiver_count; ++i) {
            if (!all_finite(receivers[i]) || is_empty(intersect(around, receivers[i]))) continue;
            ConvexBody<T> const body = visible_body(piece, receivers[i], slack);
            std::array<Vec3<T>, 2 * max_body_edges> points;
            int count = 0;
            for_each_vertex(
                body, [&](Vec3<T> const& p) { points[static_cast<unsigned>(count++)] = in_light(sampler.basis, p); });
            if (count > 0) visit(points.data(), count);
        }
    };
    auto const bound = [&](ViewPart<T> const& part, int, Supports<T>& supports) {
        cover(part, [&](Vec3<T> const* points, int count) {
            for (int i = 0; i < count; ++i) add(supports, Vec2<T>(points[i]));
        });
    };
    ChosenMaps<T> chosen = detail::search_maps(sampler, casters, limits, work, bound, cover);
    chosen.faults |= in.faults;
    return chosen;
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/sample_bounds.hpp ========
//
// The box in light space of what the eye sees in each split, measured sample by sample, merged from any number of
// tiles or threads. The second half of sample-distribution shadow maps; sdsm.hpp is the whole.
//
// A sample is a pixel and an eye depth. Its place is taken from the sides of the view: depth times a direction, never
// an inverse matrix, and relative to the eye, so a sample a metre away is exact to a micrometre wherever the eye is.
// Three products and sums a coordinate, no division: a shader rounds alike (glsl/sample_bounds.glsl).
//
// Source: Lauritzen, Salvi, Lefohn, "Sample distribution shadow maps", I3D 2011.

namespace shadowmath {
inline namespace v0 {

// From pixels to light space.
template <class T>
struct SampleRays {
    LightBasis<T> basis;
    Vec3<T> eye{T(0)};      // in light space, metres from the world origin
    Vec3<T> forward{T(0)};  // the eye's axes in light space
    Vec3<T> right{T(0)};
    Vec3<T> up{T(0)};
    Vec2<T> first{T(0)};  // sides of the view at the centre of pixel (0, 0)
    Vec2<T> step{T(0)};   // from one pixel to the next
    ViewKind kind = ViewKind::perspective;
    bool usable = false;  // false: all samples lie at the world origin
    Faults faults;        // of view and light
};

// The view is seen by width * height pixels, (0, 0) at its left and bottom sides; a picture that counts rows from the
// top turns its y over first. A view or light with faults gives no rays but those faults; a pose that is nearly
// orthonormal is mended. Suns only: a spot is clamped_option.
template <class T>
[[nodiscard]] inline SampleRays<T> sample_rays(ViewVolume<T> const& view, Light<T> const& light, int width,
                                               int height) noexcept {
    SampleRays<T> rays;
    rays.faults = faults_of(view) | faults_of(light);
    if (light.kind != LightKind::directional || width < 1 || height < 1) rays.faults |= Fault::clamped_option;
    if (rays.faults.any()) return rays;
    T farthest = detail::largest_of(view.pose.position);
    for (T const side : {view.left, view.right, view.bottom, view.top}) farthest = std::fmax(farthest, std::abs(side));
    if (!(farthest <= detail::farthest_metres<T>)) {
        rays.faults = Fault::precision_lost;
        return rays;
    }
    Pose<T> const pose = orthonormalized(view.pose);
    rays.basis = light_basis(light.direction);
    rays.eye = in_light(rays.basis, pose.position);
    rays.forward = in_light(rays.basis, pose.forward);
    rays.right = in_light(rays.basis, pose.right);
    rays.up = in_light(rays.basis, pose.up);
    rays.step = Vec2<T>((view.right - view.left) / T(width), (view.top - view.bottom) / T(height));
    rays.first = Vec2<T>(view.left, view.bottom) + rays.step * T(0.5);
    rays.kind = view.kind;
    rays.usable = true;
    return rays;
}

namespace detail {

template <class T>
[[nodiscard]] inline Vec3<T> from_eye(SampleRays<T> const& rays, Vec2<T> const& side, T depth) noexcept {
    Vec3<T> const aside = rays.right * side.x + rays.up * side.y;
    return rays.kind == ViewKind::perspective ? (rays.forward + aside) * depth : rays.forward * depth + aside;
}

}  // namespace detail

// Light space relative to the eye, metres.
template <class T>
[[nodiscard]] inline Vec3<T> from_eye(SampleRays<T> const& rays, int x, int y, T depth) noexcept {
    return detail::from_eye(rays, rays.first + rays.step * Vec2<T>(T(x), T(y)), depth);
}

// One box a split. A sample near a plane counts for both neighbours: whoever looks it up may compute its depth a little
// differently.
template <class T>
struct SampleBounds {
    SliceRange<T> range[max_splits];  // metres of eye depth
    Aabb<T> box[max_splits];          // light space relative to the eye; empty where nothing is seen
    int count = 0;
    Faults faults;  // of the splits
};

// No samples yet. `blend` as for slice_range.
template <class T>
[[nodiscard]] inline SampleBounds<T> no_bounds(Splits<T> const& splits, T blend = T(0)) noexcept {
    SampleBounds<T> bounds;
    bounds.count = splits.count;
    bounds.faults = splits.faults;
    for (int i = 0; i < splits.count; ++i) bounds.range[i] = slice_range(splits, i, blend);
    return bounds;
}

// True for a depth that the range holds, to 2^-12 of the depth itself.
template <class T>
[[nodiscard]] inline bool is_served(SliceRange<T> const& range, T depth) noexcept {
    return depth * (T(1) + T(0x1p-12)) >= range.begin && depth * (T(1) - T(0x1p-12)) < range.end;
}

// Takes in the sample of pixel (x, y) at an eye depth in metres. Depths that no_depths would not have counted, NaN
// among them, are left out.
template <class T>
inline void add(SampleBounds<T>& bounds, SampleRays<T> const& rays, int x, int y, T const& depth) noexcept {
    if (bounds.count == 0 || !all_finite(&depth, 1)) return;
    if (!(depth >= bounds.range[0].begin && depth < bounds.range[bounds.count - 1].end)) return;
    Vec3<T> const point = from_eye(rays, x, y, depth);
    for (int i = 0; i < bounds.count; ++i)
        if (is_served(bounds.range[i], depth)) bounds.box[i] = merge(bounds.box[i], point);
}

// Takes in all that a tile may hold: its whole cell of the picture from the nearest to the farthest eye depth in it, as
// a depth pyramid has them. `rays` are those of a picture with a pixel for each tile. Depths that are no numbers, and
// nearest > farthest, are no tile; what lies outside all splits is left out.
template <class T>
inline void add_tile(SampleBounds<T>& bounds, SampleRays<T> const& rays, int x, int y, T const& nearest,
                     T const& farthest) noexcept {
    if (!all_finite(&nearest, 1) || !all_finite(&farthest, 1)) return;
    Vec2<T> const middle = rays.first + rays.step * Vec2<T>(T(x), T(y));
    for (int i = 0; i < bounds.count; ++i) {
        T const begin = bounds.range[i].begin * (T(1) - T(0x1p-12)), end = bounds.range[i].end * (T(1) + T(0x1p-12));
        T const first = nearest > begin ? nearest : begin, last = farthest < end ? farthest : end;
        if (!(first <= last)) continue;
        for (T const depth : {first, last})
            for (T const u : {T(-0.5), T(0.5)})
                for (T const v : {T(-0.5), T(0.5)})
                    bounds.box[i] =
                        merge(bounds.box[i], detail::from_eye(rays, middle + rays.step * Vec2<T>(u, v), depth));
    }
}

// Takes in all samples of another part of the same view, cut by the same splits. Order and grouping of parts never
// matter, not by a bit.
template <class T>
inline void add(SampleBounds<T>& bounds, SampleBounds<T> const& part) noexcept {
    for (int i = 0; i < bounds.count; ++i) bounds.box[i] = merge(bounds.box[i], part.box[i]);
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/sample_depths.hpp ========
//
// How deep the eye really sees, and where to cut that: the depths of all visible samples in 512 bins, merged from any
// number of tiles or threads, and splits that follow them. The first half of sample-distribution shadow maps; sdsm.hpp
// is the whole.
//
//   z_near |....ooooooo............ooooo.ooo......| z_far       o  a sample
//   even        |   |   |   |   |  |  |  |                      every split the same ratio of depths, from the first
//               0       1       2      3                        sample to the last
//   adaptive    |   |   |         |  |   |                      the same, but none starts where nothing is
//
// Both are one rule: with the least ratio r for which `count` splits, each from z to r z, reach the last sample. The
// ratio is found by bisection with products alone: no logarithm, no power. A product is rounded alike by every
// processor, so a shader finds the same splits to the last bit (glsl/sample_depths.glsl).
//
// Source: Lauritzen, Salvi, Lefohn, "Sample distribution shadow maps", I3D 2011. Departure: gaps are not looked for by
// a threshold; the greedy cover skips them, and no other placing of as many splits has a smaller worst ratio.

namespace shadowmath {
inline namespace v0 {

inline constexpr int depth_bins = 512;

// The depths of samples that are seen; least and greatest of each bin exactly.
template <class T>
struct SampleDepths {
    T z_near = T(0);  // samples from here, included
    T z_far = T(0);   // to here, excluded, count
    T lo[depth_bins];
    T hi[depth_bins];  // below lo: an empty bin
    std::uint64_t counted = 0;
    std::uint64_t outside = 0;     // sky, and what lies before z_near or from z_far on
    std::uint64_t not_finite = 0;  // ignored as well
    Faults faults;                 // of the range
};

// No samples yet, of a view with this range of eye depth in metres: 0 <= z_near < z_far <= 1e18. Any other range is a
// fault, and nothing will lie in it.
template <class T>
[[nodiscard]] inline SampleDepths<T> no_depths(T const& z_near, T const& z_far) noexcept {
    SampleDepths<T> depths;
    for (int i = 0; i < depth_bins; ++i) {
        depths.lo[i] = std::numeric_limits<T>::max();
        depths.hi[i] = T(-1);
    }
    if (!all_finite(&z_near, 1) || !all_finite(&z_far, 1))
        depths.faults = Fault::not_finite;
    else if (!(z_near >= T(0)) || !(z_near < z_far) || !(z_far <= detail::farthest_metres<T>))
        depths.faults = Fault::empty_range;
    if (depths.faults.any()) return depths;
    depths.z_near = z_near;
    depths.z_far = z_far;
    return depths;
}

namespace detail {

// The bits of a positive float grow with it, evenly in each octave: exponent and 5 bits of mantissa are its bin. The
// sign is shifted out: -0 is not below a near distance of 0.
template <class T>
[[nodiscard]] inline int depth_key(T depth) noexcept {
    float const value = static_cast<float>(depth);
    std::uint32_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    return static_cast<int>((bits & 0x7fffffffu) >> 18);
}

// The sixteen octaves before z_far; what is nearer shares the first bin.
template <class T>
[[nodiscard]] inline int depth_bin(T z_far, T depth) noexcept {
    int const bin = depth_key(depth) - depth_key(z_far) + depth_bins - 1;
    return bin > 0 ? bin : 0;
}

}  // namespace detail

// Takes in one sample: its eye depth in metres. NaN and infinity are counted and ignored, depths outside the range too.
template <class T>
inline void add(SampleDepths<T>& depths, T const& depth) noexcept {
    if (!all_finite(&depth, 1)) {
        ++depths.not_finite;
        return;
    }
    if (!(depth >= depths.z_near && depth < depths.z_far)) {
        ++depths.outside;
        return;
    }
    ++depths.counted;
    int const bin = detail::depth_bin(depths.z_far, depth);
    depths.lo[bin] = depth < depths.lo[bin] ? depth : depths.lo[bin];
    depths.hi[bin] = depth > depths.hi[bin] ? depth : depths.hi[bin];
}

// Takes in all samples of another part of the same view. Order and grouping of parts never matter, not by a bit.
template <class T>
inline void add(SampleDepths<T>& depths, SampleDepths<T> const& part) noexcept {
    for (int i = 0; i < depth_bins; ++i) {
        depths.lo[i] = part.lo[i] < depths.lo[i] ? part.lo[i] : depths.lo[i];
        depths.hi[i] = part.hi[i] > depths.hi[i] ? part.hi[i] : depths.hi[i];
    }
    depths.counted += part.counted;
    depths.outside += part.outside;
    depths.not_finite += part.not_finite;
    depths.faults |= part.faults;
}

enum class SampleSplits : std::uint8_t { even, adaptive };

namespace detail {

// Where the splits start that a given ratio makes: the first at the first sample. At most `most` are made, and the last
// of them takes what is left.
template <class T>
struct Cover {
    T start[max_splits] = {};
    int count = 0;
    bool complete = false;  // the last one ends within the ratio
};

template <class T>
[[nodiscard]] inline T usable_ratio(T const& ratio) noexcept {
    if (!all_finite(&ratio, 1)) return T(1.05);
    return ratio < T(1.0001) ? T(1.0001) : (ratio > T(1 << 20) ? T(1 << 20) : ratio);
}

// A nearer first sample could need ratios beyond 2^20; it joins the first split as it is.
template <class T>
[[nodiscard]] inline T first_depth(T lo, T hi) noexcept {
    return lo > hi * T(0x1p-20) ? lo : hi * T(0x1p-20);
}

template <class T>
[[nodiscard]] inline Cover<T> even_cover(T first, T last, T ratio, int most) noexcept {
    Cover<T> cover;
    T start = first;
    for (; cover.count < most && (cover.count == 0 || start < last); start *= ratio) cover.start[cover.count++] = start;
    cover.complete = start >= last;
    return cover;
}

// Bins are not cut: a split holds a bin when its end lies within the ratio, and a bin of its own in any case.
template <class T>
[[nodiscard]] inline Cover<T> adaptive_cover(SampleDepths<T> const& depths, T first, T ratio, int most) noexcept {
    Cover<T> cover;
    T end = T(0);
    for (int i = 0; i < depth_bins; ++i) {
        if (!(depths.lo[i] <= depths.hi[i]) || (cover.count > 0 && depths.hi[i] <= end)) continue;
        if (cover.count == most) return cover;
        T const start = depths.lo[i] > first ? depths.lo[i] : first;
        cover.start[cover.count++] = start;
        end = start * ratio;
    }
    cover.complete = true;
    return cover;
}

}  // namespace detail

// Splits of [z_near, z_far] whose inner planes follow the samples: a split starts at the first sample that its
// forerunner does not hold. Outer planes stay where the view has them, since the maps are fitted to samples and gain
// nothing by it. As few as reach the last sample where each may be `least_ratio` deep (more than 1; 1.05 is sensible):
// a wall that faces the eye gets one. No sample, no split, and no fault.
//
// The ratio of the deepest split to its start is the least that `count` splits can have: of `even` splits of the whole
// interval, of `adaptive` ones to a bin, a 32nd of an octave. Samples nearer than 2^-20 of the last, for `even`, or
// 2^-16 of z_far, for `adaptive`, belong to the first split whatever its ratio.
template <class T>
[[nodiscard]] inline Splits<T> sample_splits(SampleDepths<T> const& depths, int count, SampleSplits kind,
                                             T least_ratio = T(1.05)) noexcept {
    Splits<T> splits;
    splits.faults = depths.faults;
    int const most = count < 0 ? 0 : (count > max_splits ? max_splits : count);
    if (most != count) splits.faults |= Fault::count_clamped;
    T const least = detail::usable_ratio(least_ratio);
    if (!all_finite(&least_ratio, 1) || least != least_ratio) splits.faults |= Fault::clamped_option;
    if (depths.counted == 0 || most == 0) return splits;

    T lo = depths.z_far, hi = depths.z_near;
    for (int i = 0; i < depth_bins; ++i) {
        lo = depths.lo[i] < lo ? depths.lo[i] : lo;
        hi = depths.hi[i] > hi ? depths.hi[i] : hi;
    }
    T const first = detail::first_depth(lo, hi);
    auto const cover = [&](T ratio) {
        return kind == SampleSplits::even ? detail::even_cover(first, hi, ratio, most)
                                          : detail::adaptive_cover(depths, first, ratio, most);
    };
    // The least number for which the cover is complete: completeness does not end as the ratio grows, for products are
    // rounded in order.
    T enough = least;
    if (!cover(least).complete) {
        T too_little = least;
        enough = T(1 << 20);
        for (T middle = T(0.5) * (too_little + enough); middle > too_little && middle < enough;
             middle = T(0.5) * (too_little + enough))
            (cover(middle).complete ? enough : too_little) = middle;
    }
    detail::Cover<T> const made = cover(enough);
    splits.count = made.count;
    for (int i = 1; i < made.count; ++i) splits.plane[i] = made.start[i];
    detail::close_splits(splits, depths.z_near, depths.z_far);
    return splits;
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/sdsm.hpp ========
//
// Sample-distribution shadow maps: cascades fitted to what the eye sees, pixel by pixel, instead of to all that it
// could see. In the streets of the gallery's town a texel covers 0.9 eye pixels; four tight cascades come to 1.5 and
// four stable ones to 1.8. Use them when the eye's depth is at hand before the maps are drawn: from a depth prepass,
// or from the frame before (then widen the boxes by what may have moved).
//
//   eye depths ── sample_splits ── boxes of samples ── fit_samples ── one matrix a split
//   (pass 1: SampleDepths)          (pass 2: SampleBounds)
//
//   SampleDepths<float> depths = no_depths(view.z_near, view.z_far);
//   for (pixel) add(depths, depth);
//   SampleBounds<float> bounds = no_bounds(sample_splits(depths, 4, SampleSplits::adaptive));
//   SampleRays<float> const rays = sample_rays(view, light, width, height);
//   for (pixel) add(bounds, rays, x, y, depth);
//   Cascades<float> const cascades = fit_samples(rays, bounds, casters, options);
//
// The samples have to be all of them. Every n-th pixel of a picture tells nothing of the leaf, wire or far gap between,
// and what was missed lies outside every map, lit: over the study's views (scripts/quality) one pixel in 64 as samples
// leaves some twenty thousand dark points without a map. From a small picture take the nearest and farthest depth of
// each tile, as a depth pyramid holds them, and add_tile instead of add; or choose_maps.hpp, which takes the same.
//
// glsl/sdsm.glsl is the same for compute shaders: the matrices stay in a buffer and are used from there.
//
// Under motion the boxes change with every pixel that comes into sight, and shadow edges crawl by up to a texel, which
// is a pixel or less here. With `still` the texel is one of eight sizes an octave and the map lies on a grid of whole
// texels, so that nothing crawls as long as no size changes.
//
// Source: Lauritzen, Salvi, Lefohn, "Sample distribution shadow maps", I3D 2011. Departures: each map's own box in
// light space, not a crop of one common projection; the near end is where the light enters the casters' box above the
// map's sides; still maps.

namespace shadowmath {
inline namespace v0 {

template <class T>
struct SampleFitOptions {
    int map_size = 2048;       // texels along one side of each
    T margin_texels = T(2);    // free on every side: half the width of the PCF kernel, and one
    bool still = false;        // true: texels of quantised size on a grid
    bool pancake = false;      // true: near plane at the first sample, and the renderer turns depth clamp ON
    ClipSpace clip = gl_clip;  // the convention of the pass that draws the maps
};

// The next number up whose mantissa has four bits: eight an octave. For x > 0.
template <class T>
[[nodiscard]] inline T eighth_of_octave_up(T x) noexcept {
    int exponent = 0;
    T const mantissa = std::frexp(x, &exponent);
    return std::ldexp(std::ceil(mantissa * T(16)), exponent - 4);
}

namespace detail {

// Cosines of faces that the light runs along: they are taken to stop nothing.
template <class T>
inline constexpr T least_along = T(1e-4);

}  // namespace detail

// Metres along the light, from the world origin, at which the rays between the sides lo and hi (light space) enter the
// box: nothing of it lies before. Never later than the truth, and earlier by what the box's faces rise across the
// sides. Above the far side of the box for rays that pass it by.
template <class T>
[[nodiscard]] inline T light_entry(LightBasis<T> const& basis, Vec2<T> const& lo, Vec2<T> const& hi,
                                   Aabb<T> const& box) noexcept {
    T entry = -detail::farthest_metres<T>;
    for (int k = 0; k < 3; ++k) {
        T const along = basis.depth[k];
        if (!(std::abs(along) > detail::least_along<T>)) continue;
        // On a ray world coordinate k is across + along * depth.
        T const x0 = basis.x[k] * lo.x, x1 = basis.x[k] * hi.x, y0 = basis.y[k] * lo.y, y1 = basis.y[k] * hi.y;
        T const face = along > T(0) ? box.lo[k] : box.hi[k];
        T const across =
            along > T(0) ? (x0 > x1 ? x0 : x1) + (y0 > y1 ? y0 : y1) : (x0 < x1 ? x0 : x1) + (y0 < y1 ? y0 : y1);
        T const rounding = T(4) * std::numeric_limits<T>::epsilon() *
                           (std::abs(face) + std::abs(x0) + std::abs(x1) + std::abs(y0) + std::abs(y1));
        T const enters = ((face - across) - (along > T(0) ? rounding : -rounding)) * (T(1) / along);
        entry = enters > entry ? enters : entry;
    }
    return entry;
}

namespace detail {

// One axis of a map: NDC = scale * (light-space coordinate) + offset.
template <class T>
struct MapSide {
    T lo = T(0);  // metres
    T hi = T(0);
    T scale = T(0);
    T offset = T(0);
    T texel_metres = T(0);
};

template <class T>
[[nodiscard]] inline MapSide<T> tight_side(T lo, T hi, int map_size) noexcept {
    T const extent = hi - lo;
    return {lo, hi, T(2) / extent, -(hi + lo) / extent, extent / T(map_size)};
}

// The window of map_size quantised texels, a whole number of them from the world origin, that holds [lo, hi] and the
// margin wherever rounding puts it: half a texel to either side. Its place comes from the integer, not from metres.
template <class T>
[[nodiscard]] inline MapSide<T> still_side(T lo, T hi, int map_size, T margin_texels, Faults& faults) noexcept {
    constexpr T eps = std::numeric_limits<T>::epsilon();
    T const size = T(map_size), spare = T(1) / (usable_texels(map_size, margin_texels) - T(1)) * (T(1) + T(4) * eps);
    T const texel = eighth_of_octave_up((hi - lo) * spare);
    T const index = std::floor(T(0.5) * (lo + hi) / texel - size * T(0.5) + T(0.5));
    // As for texel_grid: a coordinate's roundings stay below a 64th of a texel.
    if (!((std::abs(index) + size) * eps <= T(1) / T(256))) faults |= Fault::precision_lost;
    return {index * texel, (index + size) * texel, T(2) / (size * texel), -(T(2) * index + size) / size, texel};
}

template <class T>
inline void fit_samples_of(Cascade<T>& cascade, SampleRays<T> const& rays, Aabb<T> const& box, Aabb<T> const& casters,
                           SampleFitOptions<T> const& options) noexcept {
    // Receivers are drawn by another pass than the depths were: their places agree to some ulp of a float.
    T const slack = T(0x1p-18) * largest_of(box);
    Aabb<T> const body{box.lo + rays.eye - slack, box.hi + rays.eye + slack};
    if (!(largest_of(body) <= farthest_metres<T>)) {
        cascade.map.faults |= Fault::precision_lost;
        return;
    }
    T const margin_texels = options.still ? T(0) : options.margin_texels;
    LightBox<T> const sides = box_around(rays.basis, body, options.map_size, margin_texels);
    auto const side = [&](int axis) {
        return options.still ? still_side(sides.lo[axis], sides.hi[axis], options.map_size, options.margin_texels,
                                          cascade.map.faults)
                             : tight_side(sides.lo[axis], sides.hi[axis], options.map_size);
    };
    MapSide<T> const x = side(0), y = side(1);
    T const entry = light_entry(rays.basis, Vec2<T>(x.lo, y.lo), Vec2<T>(x.hi, y.hi), casters);
    if (!(entry <= sides.depth_hi)) return;
    // A depth buffer tells nothing apart in more, as in depth_range. The way from the eye counts: what is seen may be a
    // single point.
    T const size = (x.hi - x.lo) + (y.hi - y.lo) + (sides.depth_hi - sides.depth_lo) + largest_of(box);
    T const deepest = sides.depth_lo - T(65536) * size;
    T const reach = options.pancake ? sides.depth_lo : (entry > deepest ? entry : deepest);
    T const depth_lo = reach < sides.depth_lo ? reach : sides.depth_lo;
    T const depth_scale = T(1) / (sides.depth_hi - depth_lo);
    Mat4<T> const canonical =
        from_rows(Vec4<T>(rays.basis.x * x.scale, x.offset), Vec4<T>(rays.basis.y * y.scale, y.offset),
                  Vec4<T>(rays.basis.depth * depth_scale, -depth_lo * depth_scale), Vec4<T>(T(0), T(0), T(0), T(1)));
    if (!all_finite(canonical)) {
        cascade.map.faults |= Fault::precision_lost;
        return;
    }
    cascade.map.clip_from_world = clip_from_canonical<T>(options.clip) * canonical;
    cascade.map.visible = true;
    cascade.texel_metres = x.texel_metres > y.texel_metres ? x.texel_metres : y.texel_metres;
    cascade.depth_metres = sides.depth_hi - depth_lo;
}

}  // namespace detail

// Every sample of a split is inside its map with margin_texels to spare on each side, and every caster of the box
// between it and the sun is in that map, whatever the clip convention. A split without samples, and samples above all
// casters, give a map that is not visible, and no fault. With `still` a world point keeps its place within a texel from
// one fit to the next, whatever the eye and the samples did, when both fits have texels of the same size.
//
// `casters` is a world box; empty: no map is visible. Suns only: a spot is clamped_option.
template <class T>
[[nodiscard]] inline Cascades<T> fit_samples(SampleRays<T> const& rays, SampleBounds<T> const& bounds,
                                             Aabb<T> const& casters, SampleFitOptions<T> const& options) noexcept {
    Cascades<T> cascades;
    cascades.faults = rays.faults | bounds.faults | faults_of_margin(options.map_size, options.margin_texels);
    if (!all_finite(casters)) cascades.faults |= Fault::not_finite;
    if (!rays.usable || cascades.faults.has(Fault::not_finite) || cascades.faults.has(Fault::map_too_small))
        return cascades;
    cascades.count = bounds.count;
    Vec3<T> const farthest(detail::farthest_metres<T>);
    Aabb<T> const reached = intersect(casters, Aabb<T>{-farthest, farthest});
    for (int i = 0; i < bounds.count; ++i) {
        Cascade<T>& cascade = cascades.at[i];
        cascade.range = bounds.range[i];
        cascade.map.clip = options.clip;
        if (!is_empty(bounds.box[i]) && !is_empty(reached))
            detail::fit_samples_of(cascade, rays, bounds.box[i], reached, options);
        cascades.faults |= cascade.map.faults;
    }
    return cascades;
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/stored_depth.hpp ========
//
// From what a depth buffer holds to eye depth in metres, for a camera drawn with view_volume.hpp's clip_from_world (or
// any matrix with the same near, far and convention): one multiplication, addition and division, never the inverse of a
// view-projection.
//
// What it is worth: a float buffer with reversed depth keeps eye depth to an ulp or so at any distance. With depth from
// 0 to 1 the error grows as depth^2 / z_near: 6 mm at 100 m, 0.6 m at 1000 m for z_near = 0.1 m. The shader's twin is
// glsl/sample_depths.glsl.

namespace shadowmath {
inline namespace v0 {

// Eye depth = (num_scale * stored + num_offset) / (den_scale * stored + den_offset). The default knows no depth: what
// it gives lies behind the eye.
template <class T>
struct DepthCode {
    T num_scale = T(0);
    T num_offset = T(-1);
    T den_scale = T(0);
    T den_offset = T(1);
    T sky = T(1);  // the value that the buffer is cleared to
};

// "Stored" is in [0, 1] in every convention. A view with faults, and an orthographic one without end, give the default.
template <class T>
[[nodiscard]] inline DepthCode<T> depth_code(ViewVolume<T> const& view, ClipSpace clip) noexcept {
    DepthCode<T> code;
    code.sky = far_depth<T>(clip);
    bool const endless = is_positive_infinity(&view.z_far);
    bool const reversed = clip.depth == DepthOrder::one_to_zero;
    if (faults_of(view).any()) return code;
    if (view.kind == ViewKind::perspective) {
        // Depth from the near end is (far - near) / far * (1 - near / z).
        T const share = endless ? T(1) : (view.z_far - view.z_near) / view.z_far;
        T const rest = endless ? T(0) : view.z_near / view.z_far;
        code = {T(0), view.z_near, reversed ? share : -share, reversed ? rest : T(1), code.sky};
    } else if (!endless) {
        T const range = view.z_far - view.z_near;
        code = {reversed ? -range : range, reversed ? view.z_far : view.z_near, T(0), T(1), code.sky};
    }
    return code;
}

// Metres; for the sky a number beyond every depth. NaN gives NaN, which sample reductions leave out.
template <class T>
[[nodiscard]] inline T decoded_depth(DepthCode<T> const& code, T const& stored) noexcept {
    if (stored == code.sky) return std::numeric_limits<T>::max();
    return (code.num_scale * stored + code.num_offset) / (code.den_scale * stored + code.den_offset);
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/filter.hpp ========
//
// Percentage-closer filtering as the receiver shader does it, with depths fetched from wherever they are: a test, an
// offline tool, or a reference image. Comparisons are filtered, never depths (Reeves, Salesin, Cook 1987).
//
// The kernel is a box 2 * radius texels wide, centred on the point: taps at its rim are weighted by the part of their
// texel that it covers, so visibility is continuous everywhere. Radius 0 is the single texel that holds the point.
//
// Texel (x, y) has its centre at (x + 0.5, y + 0.5) texels from texture u = v = 0.

namespace shadowmath {
inline namespace v0 {

inline constexpr int largest_filter_radius = 64;
inline constexpr int largest_map_size =
    1 << 24;  // texels a side: beyond, float coordinates have no fraction to filter by

struct FilterOptions {
    int radius = 1;         // half width of the kernel, texels, 0 to largest_filter_radius: 1, 3x3, 5x5, ... taps
    bool tap_plane = true;  // compare each tap with the receiver plane's depth there, not with the point's
};

// Texels that the kernel covers of texel `tap` (-radius to radius from the one that holds the point) along one axis,
// when the point lies the `fraction` [0, 1) into its texel.
template <class T>
[[nodiscard]] constexpr T covered_texels(int tap, int radius, T fraction) noexcept {
    if (radius == 0) return T(1);
    return tap == -radius ? T(1) - fraction : (tap == radius ? fraction : T(1));
}

// The same as a share of the kernel: the taps of an axis sum to 1.
template <class T>
[[nodiscard]] constexpr T tap_weight(int tap, int radius, T fraction) noexcept {
    return radius == 0 ? T(1) : covered_texels(tap, radius, fraction) / T(2 * radius);
}

// A receiver as the map sees it.
template <class T>
struct Receiver {
    Vec2<T> texel{T(0)};  // from texture u = v = 0
    T depth = T(0);       // stored depth, already moved toward the light by its bias
    DepthSlope<T> slope;  // on its plane
};

// Share of light that reaches the receiver, in [0, 1]: the weighted part of taps with nothing nearer to the light; 1
// and 0 are exact where all taps agree.
// `stored_depth(x, y)` is asked for texels of the map only; those outside hold nothing. Depths are compared within
// [0, 1], as they are stored: a receiver beyond the far end is lit by the cleared map. What is not finite is lit.
template <class T, class StoredDepth>
[[nodiscard]] inline T filtered(Receiver<T> const& receiver, int map_size, ClipSpace clip, FilterOptions options,
                                StoredDepth const& stored_depth) noexcept {
    int const radius =
        options.radius < 0 ? 0 : (options.radius > largest_filter_radius ? largest_filter_radius : options.radius);
    T const reach = T(radius + 1), size = T(map_size);
    Vec2<T> const& at = receiver.texel;
    if (map_size < 1 || map_size > largest_map_size) return T(1);
    if (!all_finite(at) || !all_finite(&receiver.depth, 1) || !all_finite(&receiver.slope.x, 1) ||
        !all_finite(&receiver.slope.y, 1))
        return T(1);
    if (!(at.x >= -reach && at.y >= -reach && at.x <= size + reach && at.y <= size + reach)) return T(1);
    bool const reversed_depth = clip.depth == DepthOrder::one_to_zero;
    auto const is_lit = [&](int x, int y, T depth) {
        if (x < 0 || y < 0 || x >= map_size || y >= map_size) return true;
        T const stored = T(stored_depth(x, y));
        T const kept = depth > T(0) ? (depth < T(1) ? depth : T(1)) : T(0);
        return !(reversed_depth ? kept < stored : kept > stored);
    };
    int const home_x = static_cast<int>(std::floor(at.x)), home_y = static_cast<int>(std::floor(at.y));
    Vec2<T> const fraction(at.x - T(home_x), at.y - T(home_y));
    T lit = T(0), dark = T(0);
    for (int j = -radius; j <= radius; ++j) {
        for (int i = -radius; i <= radius; ++i) {
            T const weight = covered_texels(i, radius, fraction.x) * covered_texels(j, radius, fraction.y);
            Vec2<T> const to_tap = Vec2<T>(T(i), T(j)) + T(0.5) - fraction;
            T const rise = options.tap_plane ? receiver.slope.x * to_tap.x + receiver.slope.y * to_tap.y : T(0);
            (is_lit(home_x + i, home_y + j, receiver.depth + rise) ? lit : dark) += weight;
        }
    }
    return dark == T(0) ? T(1) : lit / (lit + dark);
}

namespace detail {

template <class T>
struct Seen {
    Receiver<T> receiver;
    T w = T(1);           // clip w of the receiver
    bool in_map = false;  // false: the map cannot answer, the point is lit
};

template <class T>
[[nodiscard]] inline Seen<T> seen_by(ShadowMap<T> const& map, int map_size, Vec3<T> const& point, Vec3<T> const& normal,
                                     MapBias<T> const& bias, bool tap_plane) noexcept {
    if (!map.visible || map_size < 1 || !all_finite(map.clip_from_world)) return {};
    Projected<T> const at = projected(texture_from_world(map), point, map.w_min);
    if (!at.in_front) return {};
    DepthSlope<T> const on_plane = slope(map, map_size, point, normal, bias.slope_limit);
    DepthSlope<T> const own = tap_plane ? lean(map, map_size, point, bias.slope_limit) : DepthSlope<T>{};
    T const toward_light = depth_bias(bias, at.w, {on_plane.x - own.x, on_plane.y - own.y});
    bool const reversed_depth = map.clip.depth == DepthOrder::one_to_zero;
    T const depth = reversed_depth ? at.at.z + toward_light : at.at.z - toward_light;
    return {Receiver<T>{Vec2<T>(at.at) * T(map_size), depth, on_plane}, at.w, true};
}

}  // namespace detail

// What a receiver shader does for one map: project the point and the plane through it, subtract the bias, filter. 1
// where the map does not hold the point. `normal` is the surface's own, not the interpolated one.
template <class T, class StoredDepth>
[[nodiscard]] inline T visibility(ShadowMap<T> const& map, int map_size, Vec3<T> const& point, Vec3<T> const& normal,
                                  MapBias<T> const& bias, FilterOptions options,
                                  StoredDepth const& stored_depth) noexcept {
    detail::Seen<T> const seen = detail::seen_by(map, map_size, point, normal, bias, options.tap_plane);
    if (!seen.in_map) return T(1);
    return filtered(seen.receiver, map_size, map.clip, options, stored_depth);
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/penumbra.hpp ========
//
// How wide the edge of a shadow is under a light that has a size: one formula for suns and lamps, in any map.
//
//         light   ====*====   radius r
//                  \  |  /            gap of an occluder, from the receiver's side:
//      occluder  ---- o ----            sun   metres between the two, along the light
//                   \ | /               lamp  (receiver's distance - occluder's) / occluder's
//      receiver  ----\|/----
//                     p               penumbra, metres across the light:  2 r gap
//
// r is a sun's tangent of its angular radius and a lamp's radius in metres. With the light l of light.hpp, the cone
// from a point p to the rim of the light is, in homogeneous coordinates,
//
//   p + gap (r u - l)      u: unit, across the light
//
// for both kinds, and the law of shadow maps (M l = (0, 0, k, 0)) turns it into M p + gap (r M u - (0, 0, k, 0)): an
// occluder's gap is linear in its stored depth, without any linearisation, and a kernel in metres is two vectors a map.
// So penumbrae are the same metres in every cascade, warp and convention, and do not jump between them.
//
// A lamp is a disk at a right angle to the spot's axis. Maps drawn with depth clamp (pancaking) do not know how far
// away the casters before their near end are: give those maps a near end that holds the casters.
//
// Source: the similar triangles of Fernando, Percentage-Closer Soft Shadows, SIGGRAPH 2005 Sketches. Departure: those
// need linear depth and hold for one kind of map each.

namespace shadowmath {
inline namespace v0 {

// Angular radius of the real sun: 16 minutes of arc.
template <class T>
inline constexpr T sun_angular_radius_radians = T(0.00465);

// Gaps are kept at or below this.
template <class T>
inline constexpr T widest_gap = T(1e6);

// The radius of a sun, for what follows: the tangent of its angular radius, which is clamped to [0, 1.5] radians.
template <class T>
[[nodiscard]] inline T sun_radius(T angular_radius_radians) noexcept {
    if (!all_finite(&angular_radius_radians, 1) || !(angular_radius_radians > T(0))) return T(0);
    return std::tan(angular_radius_radians < T(1.5) ? angular_radius_radians : T(1.5));
}

// Metres across the light over which its shadow fades: from no light to all of it.
template <class T>
[[nodiscard]] constexpr T penumbra_metres(T light_radius, T gap) noexcept {
    return T(2) * light_radius * gap;
}

// The gap of an occluder so many metres from the point on its way to the light. A lamp's occluders lie between it and
// the point: gaps end at widest_gap there.
template <class T>
[[nodiscard]] inline T gap_of_metres(Light<T> const& light, Vec3<T> const& point, T metres) noexcept {
    if (!all_finite(&metres, 1) || !(metres > T(0)) || !all_finite(point) || unusable(light)) return T(0);
    if (light.kind == LightKind::directional) return metres < widest_gap<T> ? metres : widest_gap<T>;
    T const distance = safe_normalize(point - light.position).length;
    return metres < distance ? bounded_quotient(metres, distance - metres, widest_gap<T>) : widest_gap<T>;
}

// And back: the metres of a gap.
template <class T>
[[nodiscard]] inline T metres_of_gap(Light<T> const& light, Vec3<T> const& point, T gap) noexcept {
    if (!all_finite(&gap, 1) || !(gap > T(0)) || !all_finite(point) || unusable(light)) return T(0);
    T const kept = gap < widest_gap<T> ? gap : widest_gap<T>;
    if (light.kind == LightKind::directional) return kept;
    T const metres = safe_normalize(point - light.position).length * (kept / (T(1) + kept));
    return all_finite(&metres, 1) ? metres : T(0);
}

// What a shader needs of one map. Places in it are (u w, v w, depth w, w) with depth growing away from the light, in
// any convention: a map whose depth is reversed is read as 1 - depth.
template <class T>
struct MapPenumbra {
    Vec4<T> rim_x{T(0)};            // what a place gains per unit of gap from the cone's axis to its rim
    Vec4<T> rim_y{T(0)};            // and at a right angle to it
    T depth_of_gap = T(1);          // k: depth w lost per unit of gap along the axis, > 0
    T largest_gap = widest_gap<T>;  // what is farther counts as this far: lower it where heights are known
};

// The matrix whose places a MapPenumbra speaks of.
template <class T>
[[nodiscard]] inline Mat4<T> place_from_world(ShadowMap<T> const& map) noexcept {
    Mat4<T> matrix = texture_from_world(map);
    if (map.clip.depth != DepthOrder::one_to_zero) return matrix;
    for (int column = 0; column < 4; ++column) matrix[column].z = matrix[column].w - matrix[column].z;
    return matrix;
}

// Linear in the light's radius. Where that is negative or not finite, or light or map cannot be used, it is 0: shadows
// are hard.
template <class T>
[[nodiscard]] inline MapPenumbra<T> penumbra_for(ShadowMap<T> const& map, Light<T> const& light,
                                                 T light_radius) noexcept {
    MapPenumbra<T> penumbra;
    T const gain = depth_gain(map, light);
    Tangents<T> const disk = tangents(light.direction);
    if (!(gain > T(0)) || !disk.ok || !all_finite(&light_radius, 1)) return penumbra;
    penumbra.depth_of_gap = gain;
    Mat4<T> const place = place_from_world(map);
    T const radius = light_radius > T(0) ? light_radius : T(0);
    Vec4<T> const rim_x = place * Vec4<T>(disk.s * radius, T(0)), rim_y = place * Vec4<T>(disk.t * radius, T(0));
    if (!all_finite(rim_x) || !all_finite(rim_y)) return penumbra;
    penumbra.rim_x = rim_x;
    penumbra.rim_y = rim_y;
    return penumbra;
}

// Where the plane across the light through the receiver is met by the light ray that passes the cone from `receiver` to
// the light at `gap`, toward `u` in the unit disk. Exact in any map; what stands there at that gap lies gap *
// depth_of_gap nearer.
template <class T>
[[nodiscard]] inline Vec4<T> across(MapPenumbra<T> const& penumbra, Vec4<T> const& receiver, Vec2<T> const& u,
                                    T gap) noexcept {
    return receiver + (penumbra.rim_x * u.x + penumbra.rim_y * u.y) * gap;
}

// The gap of what is stored at a place; negative for what lies behind the receiver's plane across the light.
template <class T>
[[nodiscard]] inline T gap_at(MapPenumbra<T> const& penumbra, Vec4<T> const& place, T depth) noexcept {
    return (place.z - depth * place.w) / penumbra.depth_of_gap;
}

// Half the width and height, in texels, of the box around the kernel of a gap, to first order in gap. For choosing a
// filter, or the margin of a map; taps themselves come from across().
template <class T>
[[nodiscard]] inline Vec2<T> kernel_texels(MapPenumbra<T> const& penumbra, Vec4<T> const& receiver, int map_size,
                                           T gap) noexcept {
    if (!all_finite(receiver) || !(receiver.w > T(0)) || !all_finite(&gap, 1) || map_size < 1) return Vec2<T>(T(0));
    T const scale = gap * T(map_size) / receiver.w;
    Vec2<T> const at = Vec2<T>(receiver) / receiver.w;
    Vec2<T> const x = Vec2<T>(penumbra.rim_x) - at * penumbra.rim_x.w;
    Vec2<T> const y = Vec2<T>(penumbra.rim_y) - at * penumbra.rim_y.w;
    Vec2<T> const half_axes(safe_normalize(Vec3<T>(x.x, y.x, T(0))).length,
                            safe_normalize(Vec3<T>(x.y, y.y, T(0))).length);
    Vec2<T> const texels = half_axes * scale;
    return all_finite(texels) ? texels : Vec2<T>(T(0));
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/pcss.hpp ========
//
// Percentage-closer soft shadows: edges that are sharp where the occluder touches and wide where it is far, from one
// ordinary map. Look for occluders, take their mean gap, filter as wide as the penumbra of that gap.
//
// Use it for one light whose shadows are close to the eye, where softness tells how far the caster is; where it would
// not be noticed, filter.hpp costs a tenth. It takes occluders for one plane across the light: where a low and a high
// one overlap, the width of the edge lies in between.
//
// Source: Fernando, SIGGRAPH 2005 Sketches; the disk of taps is Vogel's, Mathematical Biosciences 44, 1979.
// Departures: gaps instead of linear depths (penumbra.hpp). The search counts an occluder only from inside the cone
// that the light subtends at its gap, for from elsewhere it takes no light away: the answer does not depend on how far
// the map's near end is. Taps of the search crowd toward the middle, so that every height of occluder has its share.

namespace shadowmath {
inline namespace v0 {

inline constexpr int largest_tap_count = 256;

template <class T>
struct PcssOptions {
    int search_taps = 32;      // texels read to find occluders, 1 to largest_tap_count
    int filter_taps = 32;      // places compared, four texels each, 1 to largest_tap_count
    Vec2<T> turn{T(1), T(0)};  // cosine and sine: turns the taps, one angle a pixel trades bands for noise
};

template <class T>
struct SoftShadow {
    T visibility = T(1);   // share of the light that is seen, [0, 1]
    T gap = T(0);          // mean of the occluders found; 0 without any
    bool blocked = false;  // some were found
};

// Directions at the golden angle to each other. A rotation by a constant, so that no two compilers' sines differ.
template <class T>
[[nodiscard]] constexpr Vec2<T> next_direction(Vec2<T> const& direction) noexcept {
    T const cosine = T(-0.737368878078319693498L), sine = T(0.675490294261523644571L);
    return Vec2<T>(direction.x * cosine - direction.y * sine, direction.x * sine + direction.y * cosine);
}

namespace detail {

// The map as the taps see it: depth grows away from the light, outside nothing is held.
template <class T, class StoredDepth>
struct TapMap {
    StoredDepth const& stored_depth;
    int size;
    bool reversed_depth;

    [[nodiscard]] bool holds(int x, int y) const noexcept { return x >= 0 && y >= 0 && x < size && y < size; }
    [[nodiscard]] T depth(int x, int y) const noexcept {
        T const stored = T(stored_depth(x, y));
        return reversed_depth ? T(1) - stored : stored;
    }
};

// A receiver and the plane through it, depth growing away from the light.
template <class T>
struct TapPlane {
    Vec2<T> texel;
    T depth;
    DepthSlope<T> slope;

    // The plane's depth at the centre of a texel, as a map would store it.
    [[nodiscard]] T at(int x, int y) const noexcept {
        T const rise = slope.x * (T(x) + T(0.5) - texel.x) + slope.y * (T(y) + T(0.5) - texel.y);
        T const there = depth + rise;
        return there > T(0) ? (there < T(1) ? there : T(1)) : T(0);
    }
};

// Texels of a place, at most one outside of the map; false where it is farther away or nowhere.
template <class T>
[[nodiscard]] inline bool texel_of(Vec4<T> const& place, int map_size, Vec2<T>& texel) noexcept {
    if (!(place.w > T(0))) return false;
    T const size = T(map_size);
    texel = Vec2<T>(place) * size / place.w;
    return texel.x >= T(-1) && texel.y >= T(-1) && texel.x <= size + T(1) && texel.y <= size + T(1);
}

// The four texels around a place, and the mean of what they say by the distance to it: exactly 0 and 1 where they
// agree.
template <class T>
struct Around {
    int x, y;  // of the lower left one
    Vec2<T> share;

    explicit Around(Vec2<T> const& texel) noexcept {
        Vec2<T> const corner(std::floor(texel.x - T(0.5)), std::floor(texel.y - T(0.5)));
        x = static_cast<int>(corner.x);
        y = static_cast<int>(corner.y);
        share = texel - T(0.5) - corner;
    }
    template <class Value>
    [[nodiscard]] T mean(Value const& at) const noexcept {
        T const lower = at(x, y) * (T(1) - share.x) + at(x + 1, y) * share.x;
        T const upper = at(x, y + 1) * (T(1) - share.x) + at(x + 1, y + 1) * share.x;
        return lower * (T(1) - share.y) + upper * share.y;
    }
};

// Mean gap of the occluders that stand in the cone. Its tip is as wide as a texel: the first tap weighs the four around
// the point, so that the edge of a shadow in contact fades on both sides.
template <class T, class StoredDepth>
[[nodiscard]] inline SoftShadow<T> search(TapMap<T, StoredDepth> const& map, TapPlane<T> const& plane,
                                          Vec4<T> const& receiver, MapPenumbra<T> const& penumbra, int taps,
                                          Vec2<T> direction) noexcept {
    // The map holds nothing nearer to the light than depth 0.
    T const nothing_beyond = gap_at(penumbra, receiver, T(0));
    T const allowed = penumbra.largest_gap < widest_gap<T> ? penumbra.largest_gap : widest_gap<T>;
    T const widest = nothing_beyond < allowed ? nothing_beyond : allowed;
    if (!(widest > T(0))) return {};
    // 0 where there is no occluder in the cone.
    auto const gap_in_cone = [&](int x, int y, Vec4<T> const& place, T least_gap) {
        if (!map.holds(x, y)) return T(0);
        T const depth = map.depth(x, y), gap = gap_at(penumbra, place, depth);
        if (!(depth < plane.at(x, y)) || !(gap >= least_gap)) return T(0);
        return gap < widest ? gap : widest;
    };
    T sum = T(0), found = T(0);
    Vec2<T> texel;
    if (texel_of(receiver, map.size, texel)) {
        Around<T> const four(texel);
        sum = four.mean([&](int x, int y) { return gap_in_cone(x, y, receiver, T(0)); });
        found = four.mean([&](int x, int y) { return gap_in_cone(x, y, receiver, T(0)) > T(0) ? T(1) : T(0); });
    }
    for (int i = 1; i < taps; ++i) {
        direction = next_direction(direction);
        T const share = (T(i) + T(0.5)) / T(taps), reach = share * share;
        Vec4<T> const place = across(penumbra, receiver, direction * reach, widest);
        if (!texel_of(place, map.size, texel)) continue;
        int const x = static_cast<int>(std::floor(texel.x)), y = static_cast<int>(std::floor(texel.y));
        T const gap = gap_in_cone(x, y, place, reach * widest);
        if (!(gap > T(0))) continue;
        sum += gap;
        found += T(1);
    }
    if (!(found > T(0))) return {};
    T const mean = sum / found;
    return {T(0), mean < widest ? mean : widest, true};
}

// Share of the four texels around a place that are lit, by their distance to it.
template <class T, class StoredDepth>
[[nodiscard]] inline T lit_around(TapMap<T, StoredDepth> const& map, TapPlane<T> const& plane,
                                  Vec2<T> const& texel) noexcept {
    return Around<T>(texel).mean(
        [&](int x, int y) { return !map.holds(x, y) || !(plane.at(x, y) > map.depth(x, y)) ? T(1) : T(0); });
}

[[nodiscard]] constexpr int tap_count(int asked) noexcept {
    return asked < 1 ? 1 : (asked > largest_tap_count ? largest_tap_count : asked);
}

template <class T>
[[nodiscard]] inline bool is_finite(MapPenumbra<T> const& penumbra) noexcept {
    return all_finite(penumbra.rim_x) && all_finite(penumbra.rim_y) && all_finite(&penumbra.depth_of_gap, 1) &&
           all_finite(&penumbra.largest_gap, 1);
}

}  // namespace detail

// Share of light that reaches a receiver whose clip w is `w`, in [0, 1]. Without an occluder in the cone exactly 1; the
// taps follow the receiver's plane, so that no plane shadows itself however wide the kernel. `stored_depth(x, y)` is
// asked for texels of the map only. What is not finite is lit.
template <class T, class StoredDepth>
[[nodiscard]] inline SoftShadow<T> soft_filtered(Receiver<T> const& receiver, T w, MapPenumbra<T> const& penumbra,
                                                 int map_size, ClipSpace clip, PcssOptions<T> const& options,
                                                 StoredDepth const& stored_depth) noexcept {
    if (map_size < 1 || map_size > largest_map_size || !all_finite(&w, 1) || !(w > T(0))) return {};
    if (!all_finite(receiver.texel) || !all_finite(&receiver.depth, 1) || !all_finite(&receiver.slope.x, 1) ||
        !all_finite(&receiver.slope.y, 1) || !detail::is_finite(penumbra) || !(penumbra.depth_of_gap > T(0)))
        return {};
    bool const reversed_depth = clip.depth == DepthOrder::one_to_zero;
    detail::TapMap<T, StoredDepth> const map{stored_depth, map_size, reversed_depth};
    detail::TapPlane<T> plane{receiver.texel, receiver.depth, receiver.slope};
    if (reversed_depth) {
        plane.depth = T(1) - receiver.depth;
        plane.slope = {-receiver.slope.x, -receiver.slope.y};
    }
    Vec2<T> turn = options.turn;
    if (!all_finite(turn) || !(std::abs(glm::dot(turn, turn) - T(1)) <= T(1e-3))) turn = Vec2<T>(T(1), T(0));
    Vec4<T> const place = Vec4<T>(receiver.texel / T(map_size), plane.depth, T(1)) * w;
    SoftShadow<T> shadow = detail::search(map, plane, place, penumbra, detail::tap_count(options.search_taps), turn);
    if (!shadow.blocked) return {};
    int const taps = detail::tap_count(options.filter_taps);
    T lit = T(0);
    Vec2<T> direction = turn;
    for (int i = 0; i < taps; ++i, direction = next_direction(direction)) {
        Vec2<T> const u = direction * std::sqrt((T(i) + T(0.5)) / T(taps));
        Vec2<T> texel;
        bool const in_map = detail::texel_of(across(penumbra, place, u, shadow.gap), map_size, texel);
        lit += in_map ? detail::lit_around(map, plane, texel) : T(1);
    }
    T const visibility = lit / T(taps);
    shadow.visibility = visibility < T(1) ? visibility : T(1);
    return shadow;
}

// What a receiver shader does for one map: project the point and the plane through it, subtract the bias, search,
// filter. Lit where the map does not hold the point. `normal` is the surface's own, not the interpolated one.
template <class T, class StoredDepth>
[[nodiscard]] inline SoftShadow<T> soft_visibility(ShadowMap<T> const& map, int map_size, Vec3<T> const& point,
                                                   Vec3<T> const& normal, MapBias<T> const& bias,
                                                   MapPenumbra<T> const& penumbra, PcssOptions<T> const& options,
                                                   StoredDepth const& stored_depth) noexcept {
    detail::Seen<T> const seen = detail::seen_by(map, map_size, point, normal, bias, true);
    if (!seen.in_map) return {};
    return soft_filtered(seen.receiver, seen.w, penumbra, map_size, map.clip, options, stored_depth);
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/hfts.hpp ========
//
// Hybrid frustum-traced shadows: exact where the occluder touches, soft where it is far. An exact test (a ray or an
// irregular z-buffer) leaves no gap at contacts and has no texels, but knows nothing of the light's size; PCSS knows
// that, and fails at contacts. The occluder's gap says whom to believe.
//
// Use it for the few metres around the eye. Far away, where a texel of the map is a pixel, PCSS alone is as good.
//
// Source: Story and Wyman, SIGGRAPH 2016 Talks. Departure: gaps (penumbra.hpp), so the same number serves every cascade
// and every light; and where the exact test found nothing, the soft one's own occluders decide: else the outer half of
// each penumbra would be cut off.

namespace shadowmath {
inline namespace v0 {

// What an exact test says of one receiver.
template <class T>
struct ExactShadow {
    T visibility = T(1);  // share of its samples that are lit, [0, 1]
    T gap = T(0);         // of the occluder nearest to the receiver, >= 0
};

// Share of the soft answer: 0 in contact, growing in proportion to the gap, 1 from `soft_gap` on. A soft_gap of 0 or
// less: all soft.
template <class T>
[[nodiscard]] inline T softness(T gap, T soft_gap) noexcept {
    if (!all_finite(&gap, 1) || !all_finite(&soft_gap, 1)) return T(0);
    if (!(gap < soft_gap)) return T(1);
    return gap > T(0) ? gap / soft_gap : T(0);
}

// Between the two answers, the exact one in contact; 1 where neither found an occluder. What is not finite gives the
// exact answer, or light where that is not finite either.
template <class T>
[[nodiscard]] inline T hybrid_visibility(ExactShadow<T> const& exact, SoftShadow<T> const& soft, T soft_gap) noexcept {
    if (!all_finite(&exact.visibility, 1)) return T(1);
    T const hard = exact.visibility > T(0) ? (exact.visibility < T(1) ? exact.visibility : T(1)) : T(0);
    if (!all_finite(&soft.visibility, 1) || !all_finite(&soft.gap, 1) || !all_finite(&exact.gap, 1)) return hard;
    bool const traced = hard < T(1);
    if (!traced && !soft.blocked) return T(1);
    T gap = traced ? exact.gap : soft.gap;
    if (traced && soft.blocked && soft.gap < gap) gap = soft.gap;
    T const mixed_in = soft.visibility > T(0) ? (soft.visibility < T(1) ? soft.visibility : T(1)) : T(0);
    T const share = softness(gap, soft_gap);
    return hard * (T(1) - share) + mixed_in * share;
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/moments.hpp ========
//
// What filterable shadow maps share: texels hold moments of depth, which may be averaged by anything (a blur, mipmaps,
// the sampler), because the moments of a mixture are the mean of the moments. What comes out is a bound on the share of
// the kernel that is lit, from a handful of numbers however wide the kernel is: vsm.hpp two or four, msm.hpp four.
//
// Use them for wide soft edges that a blur once a frame pays for. Not where a lit strip between two occluders must stay
// dark: each bound is in favour of light, and lets some through where depths overlap. filter.hpp never does.
//
// Depths are in [0, 1] and grow away from the light: 1 - depth of a map whose depth is reversed.

namespace shadowmath {
inline namespace v0 {

// Mean of the moments over the box of filter.hpp, 2 * radius texels wide around the point (radius 0: the texel that
// holds it). `outside` is what texels outside the map count as: the moments of depth 1. `stored_moments(x, y)` is asked
// for texels of the map only.
template <class T, class Moments, class StoredMoments>
[[nodiscard]] inline Moments mean_moments(Vec2<T> const& texel, int map_size, int radius, Moments const& outside,
                                          StoredMoments const& stored_moments) noexcept {
    int const kept = radius < 0 ? 0 : (radius > largest_filter_radius ? largest_filter_radius : radius);
    T const reach = T(kept + 1), size = T(map_size);
    if (map_size < 1 || map_size > largest_map_size || !all_finite(texel)) return outside;
    if (!(texel.x >= -reach && texel.y >= -reach && texel.x <= size + reach && texel.y <= size + reach)) return outside;
    int const home_x = static_cast<int>(std::floor(texel.x)), home_y = static_cast<int>(std::floor(texel.y));
    Vec2<T> const fraction(texel.x - T(home_x), texel.y - T(home_y));
    Moments mean(T(0));
    for (int j = -kept; j <= kept; ++j) {
        for (int i = -kept; i <= kept; ++i) {
            int const x = home_x + i, y = home_y + j;
            bool const inside = x >= 0 && y >= 0 && x < map_size && y < map_size;
            T const weight = tap_weight(i, kept, fraction.x) * tap_weight(j, kept, fraction.y);
            mean += (inside ? stored_moments(x, y) : outside) * weight;
        }
    }
    return mean;
}

// Takes the faint light out of overlapping shadows: shares below `amount` [0, 1) become 0, the rest is stretched. What
// it returns is no bound any more; all penumbrae grow narrower.
template <class T>
[[nodiscard]] inline T less_bleeding(T visibility, T amount) noexcept {
    if (!all_finite(&visibility, 1) || !all_finite(&amount, 1)) return T(1);
    T const cut = amount > T(0) ? (amount < T(0.99) ? amount : T(0.99)) : T(0);
    T const share = (visibility - cut) / (T(1) - cut);
    return share < T(1) ? (share > T(0) ? share : T(0)) : T(1);
}

namespace detail {

template <class T>
[[nodiscard]] constexpr T unit_depth(T depth) noexcept {
    return depth > T(0) ? (depth < T(1) ? depth : T(1)) : T(0);
}

// Within [0, 1]; light for what is not a number.
template <class T>
[[nodiscard]] constexpr T share_or_light(T share) noexcept {
    return share < T(1) ? (share > T(0) ? share : T(0)) : T(1);
}

}  // namespace detail

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/msm.hpp ========
//
// Moment shadow maps: the sharpest bound on the lit share of a kernel that four moments of depth allow. Exact where the
// kernel holds two depths (an edge over a floor), where VSM still lets light through.
//
// Of all distributions with the given moments the one that darkens the receiver least has an atom at the receiver's
// depth and two more: the roots of a quadratic whose coefficients solve a 3x3 Hankel system. What lies before the
// receiver in it is occluded. Moments are of z = 2 depth - 1.
//
// Source: Peters and Klein, Moment Shadow Mapping, I3D 2015 (the Hamburger problem); packing and bias as in Peters
// et al., JCGT 6(1), 2017. Departure: roots far outside are kept at a bound instead of being infinite, so there is no
// receiver for which it divides by zero.

namespace shadowmath {
inline namespace v0 {

// Share of a fixed distribution (masses 3/16, 5/8, 3/16 at z = -1, 0, 1) that is mixed into the moments, so that what
// rounding made of them is still that of a distribution. It costs as much of the bound: light is at most 1 - bias.
template <class T>
inline constexpr T msm_bias_float = T(3e-6);  // moments kept and blurred in float
template <class T>
inline constexpr T msm_bias_16_bits = T(6e-5);  // packed into four times 16 bits

// z, z^2, z^3, z^4.
template <class T>
[[nodiscard]] inline Vec4<T> msm_moments(T depth) noexcept {
    T const z = all_finite(&depth, 1) ? T(2) * detail::unit_depth(depth) - T(1) : T(1);
    T const square = z * z;
    return Vec4<T>(z, square, square * z, square * square);
}

// Four numbers in [0, 1] to be stored with 16 bits each and filtered as they are: odd and even moments turned so that
// each fills its range, which makes the volume of possible moments, and the room for rounding, as large as it can be.
template <class T>
[[nodiscard]] inline Vec4<T> msm_packed(Vec4<T> const& moments) noexcept {
    constexpr T root3 = T(1.73205080756887729352744634150587237L);
    return Vec4<T>(T(1.5) * moments.x - T(2) * moments.z + T(0.5), T(4) * (moments.y - moments.w),
                   root3 * (moments.x / T(2) - moments.z * (T(2) / T(9))) + T(0.5), (moments.y + moments.w) / T(2));
}

template <class T>
[[nodiscard]] inline Vec4<T> msm_unpacked(Vec4<T> const& stored) noexcept {
    constexpr T root3 = T(1.73205080756887729352744634150587237L);
    T const first = stored.x - T(0.5), second = root3 * (stored.z - T(0.5));
    return Vec4<T>(second - first / T(3), stored.w + stored.y / T(8), T(0.75) * (second - first),
                   stored.w - stored.y / T(8));
}

namespace detail {

// NOTE: no kernel has moments whose divisors are zero, but a texel that was never written may.
template <class T>
[[nodiscard]] inline T quotient_or_zero(T dividend, T divisor) noexcept {
    return divisor != T(0) ? dividend / divisor : T(0);
}

// Coefficients c of 1, z, z^2 with Hankel(b) c = (1, x, x^2), through L D L^T.
template <class T>
[[nodiscard]] inline Vec3<T> solve_hankel(Vec4<T> const& b, T x) noexcept {
    T const variance = b.y - b.x * b.x, skew = b.z - b.x * b.y;
    T const spread = (b.w - b.y * b.y) * variance - skew * skew;  // det: D3 * D2
    T const c1 = x - b.x, c2 = x * x - b.y - quotient_or_zero(skew, variance) * c1;
    T const z = quotient_or_zero(c2 * variance, spread);
    T const y = quotient_or_zero(c1 - skew * z, variance);
    return Vec3<T>(T(1) - b.x * y - b.y * z, y, z);
}

// The mass before x in the distribution with these moments, an atom at x and atoms at low <= high.
template <class T>
[[nodiscard]] inline T mass_before(Vec4<T> const& b, T x, T low, T high) noexcept {
    if (!(x > low)) return T(0);
    if (!(x > high)) return quotient_or_zero(x * high - b.x * (x + high) + b.y, (high - low) * (x - low));
    return T(1) - quotient_or_zero(low * high - b.x * (low + high) + b.y, (x - low) * (x - high));
}

}  // namespace detail

// Never less than (1 - bias) times the share of the kernel at or beyond `depth`, up to the rounding that the bias
// covers; never growing with depth; within `bias` and rounding exact where the kernel holds one or two depths away from
// the receiver's. `bias` is clamped to what keeps the system regular.
template <class T>
[[nodiscard]] inline T msm_visibility(Vec4<T> const& moments, T depth, T bias) noexcept {
    if (!all_finite(moments) || !all_finite(&depth, 1)) return T(1);
    T const least = T(16) * std::numeric_limits<T>::epsilon();
    T const share = all_finite(&bias, 1) && bias > least ? (bias < T(0.1) ? bias : T(0.1)) : least;
    Vec4<T> const b = moments * (T(1) - share) + Vec4<T>(T(0), T(0.375), T(0), T(0.375)) * share;
    T const x = T(2) * detail::unit_depth(depth) - T(1);
    Vec3<T> const c = detail::solve_hankel(b, x);
    // Roots by the formula in which nothing cancels.
    T const discriminant = c.y * c.y - T(4) * c.z * c.x;
    T const root = std::sqrt(discriminant > T(0) ? discriminant : T(0));
    T const sum = (c.y < T(0) ? root - c.y : -root - c.y) / T(2);
    T const farthest = T(1e4);
    T const one = bounded_quotient(sum, c.z, farthest), other = bounded_quotient(c.x, sum, farthest);
    T const occluded = detail::mass_before(b, x, one < other ? one : other, one < other ? other : one);
    return detail::share_or_light(T(1) - occluded);
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/vsm.hpp ========
//
// Variance shadow maps, plain and exponential: the share of a kernel that is lit is at most
//
//   variance / (variance + (depth - mean)^2)        beyond the mean depth, 1 before it (Cantelli)
//
// whatever the kernel holds. VSM takes two moments of depth; EVSM the same of two growing functions of depth, exp(c z)
// and -exp(-c z), z = 2 depth - 1: order stays, so both bounds hold, and the smaller is far smaller where depths
// overlap. The exponent c is bounded by what squares fit into the format: see largest_exponent_*.
//
// Use EVSM where 128 bits a texel are paid for, VSM with less_bleeding where 64 are; msm.hpp needs 64 and no exponent.
//
// Source: Donnelly and Lauritzen, I3D 2006; Lauritzen and McCool, Graphics Interface 2008. Departure: the least
// variance is given as a deviation of depth, and is carried through the warp by its slope.

namespace shadowmath {
inline namespace v0 {

// exp(2 c) must fit: into 3.4e38 with room for what a bound computes of it, and into 65504.
inline constexpr float largest_exponent_float = 42.0f;
inline constexpr float largest_exponent_half = 5.54f;

template <class T>
[[nodiscard]] inline Vec2<T> vsm_moments(T depth) noexcept {
    if (!all_finite(&depth, 1)) return Vec2<T>(T(1));
    T const kept = detail::unit_depth(depth);
    return Vec2<T>(kept, kept * kept);
}

namespace detail {

// Cantelli's bound; `least_deviation` >= 0, of the same quantity.
template <class T>
[[nodiscard]] inline T most_light(T mean, T mean_square, T value, T least_deviation) noexcept {
    if (!(value > mean)) return T(1);
    T const measured = mean_square - mean * mean, least = least_deviation * least_deviation;
    T const variance = measured > least ? measured : least;
    T const distance = value - mean, sum = variance + distance * distance;
    return sum > T(0) ? share_or_light(variance / sum) : T(1);
}

// Beyond a hundredth of the map's depth nothing would be dark, and the squares of EVSM would overflow.
template <class T>
[[nodiscard]] inline T kept_deviation(T const& deviation) noexcept {
    if (!all_finite(&deviation, 1) || !(deviation > T(0))) return T(0);
    return deviation < T(0.01) ? deviation : T(0.01);
}

template <class T>
[[nodiscard]] inline T kept_exponent(T const& exponent) noexcept {
    if (!all_finite(&exponent, 1) || !(exponent > T(0))) return T(0);
    return exponent < T(largest_exponent_float) ? exponent : T(largest_exponent_float);
}

}  // namespace detail

// Never less than the share of the kernel at or beyond `depth`, and never growing with it; exact where the kernel holds
// one depth. `least_deviation` [0, 0.01] is a spread of depth that every kernel is taken to have at least: it hides the
// rounding of the moments, about 3e-4 for float and 4e-3 for 16 bits.
template <class T>
[[nodiscard]] inline T vsm_visibility(Vec2<T> const& moments, T depth, T least_deviation) noexcept {
    if (!all_finite(moments) || !all_finite(&depth, 1)) return T(1);
    return detail::most_light(moments.x, moments.y, detail::unit_depth(depth), detail::kept_deviation(least_deviation));
}

// Exponents of the growing and of the falling warp, each clamped to [0, largest_exponent_float]. The falling one needs
// less: it answers for receivers before the occluders behind them.
template <class T>
struct EvsmExponents {
    T growing = T(40);
    T falling = T(5);
};

// exp(c z) and -exp(-c z), both growing with depth.
template <class T>
[[nodiscard]] inline Vec2<T> evsm_warp(T depth, EvsmExponents<T> const& exponents) noexcept {
    T const z = all_finite(&depth, 1) ? T(2) * detail::unit_depth(depth) - T(1) : T(1);
    return Vec2<T>(std::exp(detail::kept_exponent(exponents.growing) * z),
                   -std::exp(-detail::kept_exponent(exponents.falling) * z));
}

// Of the growing warp and of its square, of the falling one and of its square. Finite in float.
template <class T>
[[nodiscard]] inline Vec4<T> evsm_moments(T depth, EvsmExponents<T> const& exponents) noexcept {
    Vec2<T> const warp = evsm_warp(depth, exponents);
    return Vec4<T>(warp.x, warp.x * warp.x, warp.y, warp.y * warp.y);
}

// As vsm_visibility, and never more than either warp alone allows; `warp` is that of the receiver's depth.
template <class T>
[[nodiscard]] inline T evsm_bound(Vec4<T> const& moments, Vec2<T> const& warp, EvsmExponents<T> const& exponents,
                                  T least_deviation) noexcept {
    if (!all_finite(moments) || !all_finite(warp)) return T(1);
    T const deviation = T(2) * detail::kept_deviation(least_deviation);
    T const growing =
        detail::most_light(moments.x, moments.y, warp.x, deviation * detail::kept_exponent(exponents.growing) * warp.x);
    T const falling = detail::most_light(moments.z, moments.w, warp.y,
                                         -deviation * detail::kept_exponent(exponents.falling) * warp.y);
    return growing < falling ? growing : falling;
}

template <class T>
[[nodiscard]] inline T evsm_visibility(Vec4<T> const& moments, T depth, EvsmExponents<T> const& exponents,
                                       T least_deviation) noexcept {
    if (!all_finite(&depth, 1)) return T(1);
    return evsm_bound(moments, evsm_warp(depth, exponents), exponents, least_deviation);
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/gpu.hpp ========
//
// What shaders read, as it lies in memory: the structs of glsl/layout.glsl, member by member, and the functions that
// fill them. The layout is the same in std140 and std430, and every offset is asserted here.
//
// In the engine:
//
//   GpuCascades const shadows = gpu_cascades(fit_cascades(view, light, casters, receivers, options), light, options);
//   // Upload it as a uniform block; draw the casters into layer i by shadows.at[i].map.clip_from_world.
//
// In its shader (glslangValidator and shaderc want #extension GL_GOOGLE_include_directive; else paste the files):
//
//   #include "shadowmath/glsl/layout.glsl"
//   #include "shadowmath/glsl/cascades.glsl"
//   layout(std140, binding = 0) uniform Shadows { sm_Cascades shadows; };
//   layout(binding = 1) uniform sampler2DArray depths;
//
//   sm_LookUp look_up = sm_by_depth(shadows.ranges, shadows.count, eye_depth);
//   float lit = sm_cascaded_visibility(depths, look_up, shadows.at[max(look_up.first, 0)],
//                                      shadows.at[max(look_up.second, 0)], shadows.map_size, point, plane_normal,
//                                      shadows.filter_radius, shadows.tap_plane != 0);
//
// A map of any other technique (a warp, a view-dependent map, a spot's) is gpu_map's, and sm_visibility reads it.

namespace shadowmath {
inline namespace v0 {

// sm_ShadowMap
struct GpuShadowMap {
    Mat4<float> clip_from_world = nowhere<float>();
    float w_min = 0.0f;
    std::int32_t depth_order = 0;  // DepthOrder
    std::int32_t flip_v = 0;       // 1: texture v counts against NDC y
    std::int32_t visible = 0;
};
static_assert(offsetof(GpuShadowMap, clip_from_world) == 0);
static_assert(offsetof(GpuShadowMap, w_min) == 64);
static_assert(offsetof(GpuShadowMap, depth_order) == 68);
static_assert(offsetof(GpuShadowMap, flip_v) == 72);
static_assert(offsetof(GpuShadowMap, visible) == 76);
static_assert(sizeof(GpuShadowMap) == 80);

// sm_MapBias
using GpuMapBias = MapBias<float>;
static_assert(offsetof(GpuMapBias, constant) == 0);
static_assert(offsetof(GpuMapBias, per_inverse_w) == 4);
static_assert(offsetof(GpuMapBias, slope_texels) == 8);
static_assert(offsetof(GpuMapBias, slope_limit) == 12);
static_assert(sizeof(GpuMapBias) == 16);

// sm_Cascade: any map, and what its receivers are biased by.
struct GpuCascade {
    GpuShadowMap map;
    GpuMapBias bias;
};
static_assert(offsetof(GpuCascade, map) == 0);
static_assert(offsetof(GpuCascade, bias) == 80);
static_assert(sizeof(GpuCascade) == 96);

// sm_MapPenumbra of glsl/penumbra.glsl: what soft shadows need of one map.
struct GpuMapPenumbra {
    Vec4<float> rim_x{0.0f};
    Vec4<float> rim_y{0.0f};
    float depth_of_gap = 1.0f;
    float largest_gap = 0.0f;
    float unused[2] = {};
};
static_assert(offsetof(GpuMapPenumbra, rim_x) == 0);
static_assert(offsetof(GpuMapPenumbra, rim_y) == 16);
static_assert(offsetof(GpuMapPenumbra, depth_of_gap) == 32);
static_assert(offsetof(GpuMapPenumbra, largest_gap) == 36);
static_assert(sizeof(GpuMapPenumbra) == 48);

// sm_Ranges: metres of eye depth.
struct GpuRanges {
    float blend_begin[max_splits] = {};
    float end[max_splits] = {};
};
static_assert(offsetof(GpuRanges, blend_begin) == 0);
static_assert(offsetof(GpuRanges, end) == 64);
static_assert(sizeof(GpuRanges) == 128);

// sm_Cascades
struct GpuCascades {
    GpuCascade at[max_splits];
    GpuRanges ranges;
    std::int32_t count = 0;
    std::int32_t map_size = 0;
    std::int32_t filter_radius = 0;
    std::int32_t tap_plane = 0;
};
static_assert(offsetof(GpuCascades, at) == 0);
static_assert(offsetof(GpuCascades, ranges) == 1536);
static_assert(offsetof(GpuCascades, count) == 1664);
static_assert(offsetof(GpuCascades, map_size) == 1668);
static_assert(offsetof(GpuCascades, filter_radius) == 1672);
static_assert(offsetof(GpuCascades, tap_plane) == 1676);
static_assert(sizeof(GpuCascades) == 1680);

// Finite whatever T is: a map that float cannot hold serves nothing.
template <class T>
[[nodiscard]] inline GpuShadowMap gpu_shadow_map(ShadowMap<T> const& map) noexcept {
    GpuShadowMap gpu;
    Mat4<float> const clip_from_world(map.clip_from_world);
    float const w_min = static_cast<float>(map.w_min);
    if (map.visible && all_finite(clip_from_world) && all_finite(&w_min, 1)) {
        gpu.clip_from_world = clip_from_world;
        gpu.w_min = w_min;
        gpu.visible = 1;
    }
    gpu.depth_order = static_cast<std::int32_t>(map.clip.depth);
    gpu.flip_v = map.clip.ndc_y == map.clip.texture_v ? 0 : 1;
    return gpu;
}

template <class T>
[[nodiscard]] inline GpuCascade gpu_map(ShadowMap<T> const& map, Light<T> const& light, int map_size,
                                        BiasOptions<T> const& options) noexcept {
    MapBias<T> const bias = bias_for(map, light, map_size, options);
    GpuMapBias gpu{static_cast<float>(bias.constant), static_cast<float>(bias.per_inverse_w),
                   static_cast<float>(bias.slope_texels), static_cast<float>(bias.slope_limit)};
    float const numbers[] = {gpu.constant, gpu.per_inverse_w, gpu.slope_texels, gpu.slope_limit};
    return {gpu_shadow_map(map), all_finite(numbers, 4) ? gpu : GpuMapBias{}};
}

// Hard shadows where float cannot hold the numbers.
template <class T>
[[nodiscard]] inline GpuMapPenumbra gpu_penumbra(MapPenumbra<T> const& penumbra) noexcept {
    GpuMapPenumbra gpu;
    gpu.rim_x = Vec4<float>(penumbra.rim_x);
    gpu.rim_y = Vec4<float>(penumbra.rim_y);
    gpu.depth_of_gap = static_cast<float>(penumbra.depth_of_gap);
    gpu.largest_gap = static_cast<float>(penumbra.largest_gap);
    bool const finite = all_finite(gpu.rim_x) && all_finite(gpu.rim_y) && all_finite(&gpu.depth_of_gap, 2);
    return finite && gpu.depth_of_gap > 0.0f ? gpu : GpuMapPenumbra{};
}

// Everything that a receiver shader needs of the cascades. `options` are those that they were fitted with; the filter
// radius of `bias` is taken from there.
template <class T>
[[nodiscard]] inline GpuCascades gpu_cascades(Cascades<T> const& cascades, Light<T> const& light,
                                              CascadeOptions<T> const& options, BiasOptions<T> bias = {}) noexcept {
    GpuCascades gpu;
    Faults told_already;
    bias.filter_radius = detail::kernel_radius(options, told_already);
    gpu.count = cascades.count;
    gpu.map_size = options.map_size;
    gpu.filter_radius = bias.filter_radius;
    gpu.tap_plane = bias.tap_plane ? 1 : 0;
    for (int i = 0; i < cascades.count; ++i) {
        gpu.at[i] = gpu_map(cascades.at[i].map, light, options.map_size, bias);
        gpu.ranges.blend_begin[i] = static_cast<float>(cascades.at[i].range.blend_begin);
        gpu.ranges.end[i] = static_cast<float>(cascades.at[i].range.end);
    }
    return gpu;
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/gpu_samples.hpp ========
//
// What the compute shaders of a sample-distribution fit are given, laid out as std140 and std430 have it, and what
// their state looks like: the mirror of glsl/sample_layout.glsl. Nothing of it comes back: the shaders write the maps'
// matrices to a buffer, and the passes that draw and read the maps take them from there.
//
//   GpuSampleFit const fit = gpu_sample_fit(camera, camera_clip, light, width, height, casters, splits, options);
//   upload as the uniform block; run sdsm_begin, sdsm_depths, sdsm_splits, sdsm_bounds, sdsm_maps.

namespace shadowmath {
inline namespace v0 {

struct GpuSampleFit {
    Vec4<float> basis_x{0.0f};      // w: z_near, metres of eye depth
    Vec4<float> basis_y{0.0f};      // w: z_far
    Vec4<float> basis_depth{0.0f};  // w: least ratio of a split
    // 1 / basis_depth, 0 where light_entry skips the axis; w: fraction of splits that blends
    Vec4<float> inverse_along{0.0f};
    Vec4<float> eye{0.0f};         // in light space; w: texels along a side of the map
    Vec4<float> forward{0.0f};     // of the eye, in light space; w: margin as a share of the body's extent
    Vec4<float> right{0.0f};       // w: 1 / (usable texels - 1), for still maps
    Vec4<float> up{0.0f};          // w: what the depth buffer is cleared to
    Vec4<float> first_step{0.0f};  // sides at the centre of pixel (0, 0), and from pixel to pixel
    Vec4<float> casters_lo{0.0f};  // world
    Vec4<float> casters_hi{0.0f};
    Vec4<float> depth_code{0.0f};  // numerator's scale and offset, denominator's scale and offset
    Vec4<float> bias{0.0f};        // of BiasOptions: flat_texels, texels, steepest, depth_step
    Mat4<float> clip_from_canonical{1.0f};
    std::int32_t width = 0;  // pixels
    std::int32_t height = 0;
    std::int32_t count = 0;     // splits; 0 where there is nothing to fit
    std::int32_t adaptive = 0;  // 1: SampleSplits::adaptive
    std::int32_t orthographic = 0;
    std::int32_t still = 0;
    std::int32_t pancake = 0;
    std::int32_t unused = 0;
};
static_assert(offsetof(GpuSampleFit, clip_from_canonical) == 208 && offsetof(GpuSampleFit, width) == 272 &&
                  offsetof(GpuSampleFit, orthographic) == 288 && sizeof(GpuSampleFit) == 304,
              "glsl/sample_layout.glsl");

// The shaders' own: bins and boxes as bits that order as the numbers do. For tests, and to size the buffer.
struct GpuSampleState {
    std::uint32_t bin_lo[depth_bins];
    std::uint32_t bin_hi[depth_bins];
    std::uint32_t counted;
    std::uint32_t outside;
    std::uint32_t not_finite;
    std::int32_t count;                   // splits
    Vec4<float> range[max_splits];        // metres of eye depth: begin, blend_begin, end
    std::uint32_t box_lo[max_splits][4];  // light space relative to the eye
    std::uint32_t box_hi[max_splits][4];
};
static_assert(offsetof(GpuSampleState, range) == 4112 && offsetof(GpuSampleState, box_lo) == 4368 &&
                  sizeof(GpuSampleState) == 4880,
              "glsl/sample_layout.glsl");

template <class T>
struct SampleSplitOptions {
    int count = 4;
    SampleSplits kind = SampleSplits::adaptive;
    T least_ratio = T(1.05);
    T blend = T(0);
};

// The maps that the shaders make of these are those of sample_splits and fit_samples at T = float, fed with the same
// samples, to the last bit (as long as no compiler contracts a product and a sum: -ffp-contract=off, `precise`).
//
// `camera` and `camera_clip` are what the depth buffer was drawn with; samples from shadow_distance on get no shadow
// (0: camera.z_far). Inputs with faults give count = 0, and the shaders make no map.
// NOTE: a template for float alone, so that it costs nothing to compile where it is not called.
template <class T>
[[nodiscard]] inline GpuSampleFit gpu_sample_fit(ViewVolume<T> const& camera, ClipSpace camera_clip, T shadow_distance,
                                                 Light<T> const& light, int width, int height, Aabb<T> const& casters,
                                                 SampleSplitOptions<T> const& splits,
                                                 SampleFitOptions<T> const& options,
                                                 BiasOptions<T> const& bias = {}) noexcept {
    static_assert(std::numeric_limits<T>::digits == 24, "shaders compute in float");
    GpuSampleFit fit;
    bool const cut = all_finite(&shadow_distance, 1) && shadow_distance > 0.0f;
    T const z_far = cut && shadow_distance < camera.z_far ? shadow_distance : camera.z_far;
    SampleRays<T> const rays = sample_rays(camera, light, width, height);
    DepthCode<T> const code = depth_code(camera, camera_clip);
    Faults const faults = faults_of_margin(options.map_size, options.margin_texels);
    bool const usable = rays.usable && !no_depths(camera.z_near, z_far).faults.any() && all_finite(casters) &&
                        !is_empty(casters) && !faults.has(Fault::not_finite) && !faults.has(Fault::map_too_small);
    if (!usable) return fit;

    T const size = static_cast<T>(options.map_size);
    T const usable_size = usable_texels(options.map_size, options.margin_texels);
    constexpr T eps = std::numeric_limits<T>::epsilon();
    Vec4<float> inverse_along(0.0f);
    for (int k = 0; k < 3; ++k)
        if (std::abs(rays.basis.depth[k]) > detail::least_along<T>) inverse_along[k] = 1.0f / rays.basis.depth[k];
    inverse_along.w = splits.blend > 0.0f ? (splits.blend < 1.0f ? splits.blend : 1.0f) : 0.0f;
    fit.basis_x = Vec4<float>(rays.basis.x, camera.z_near);
    fit.basis_y = Vec4<float>(rays.basis.y, z_far);
    fit.basis_depth = Vec4<float>(rays.basis.depth, detail::usable_ratio(splits.least_ratio));
    fit.inverse_along = inverse_along;
    fit.eye = Vec4<float>(rays.eye, size);
    fit.forward = Vec4<float>(rays.forward, options.still ? 0.0f : 0.5f * (size - usable_size) / usable_size);
    fit.right = Vec4<float>(rays.right, 1.0f / (usable_size - 1.0f) * (1.0f + 4.0f * eps));
    fit.up = Vec4<float>(rays.up, code.sky);
    fit.first_step = Vec4<float>(rays.first.x, rays.first.y, rays.step.x, rays.step.y);
    Vec3<T> const farthest(detail::farthest_metres<T>);
    Aabb<T> const reached = intersect(casters, Aabb<T>{-farthest, farthest});
    fit.casters_lo = Vec4<float>(reached.lo, 0.0f);
    fit.casters_hi = Vec4<float>(reached.hi, 0.0f);
    fit.depth_code = Vec4<float>(code.num_scale, code.num_offset, code.den_scale, code.den_offset);
    fit.bias = Vec4<float>(detail::option(bias.flat_texels, 0.0f), detail::option(bias.texels, 0.0f),
                           detail::option(bias.steepest, 20.0f), detail::option(bias.depth_step, 0.0f));
    fit.clip_from_canonical = clip_from_canonical<T>(options.clip);
    fit.width = width;
    fit.height = height;
    fit.count = splits.count < 0 ? 0 : (splits.count > max_splits ? max_splits : splits.count);
    fit.adaptive = splits.kind == SampleSplits::adaptive ? 1 : 0;
    fit.orthographic = rays.kind == ViewKind::orthographic ? 1 : 0;
    fit.still = options.still ? 1 : 0;
    fit.pancake = options.pancake ? 1 : 0;
    return fit;
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/irregular/microquad.hpp ========
//
// A pixel as a piece of the surface it shows: the tangent plane at the pixel's point, seen through the pixel's four
// corners. Three numbers a pixel are all that it takes.
//
// Everything irregular is computed in the PIXEL FRAME, the eye's own axes scaled so that a point of depth d that is
// seen at (x, y) pixels from the middle of the picture is d * (x, y, 1); of an orthographic eye it is (x, y, d). There
//
//   one over the depth of a plane is affine in x and y (the depth itself, for an orthographic eye), so a plane is
//   three numbers: q at the pixel's corner, and its gain for a pixel in x and in y;
//   the sign of a half space n . p + c at a point of the surface is that of n.x x + n.y y + n.z + c q, which is affine
//   in x and y as well: seen through one pixel, any half space is a half plane with a straight border, exactly.
//
// Source: Wyman, Hoetzlein and Lefohn, I3D 2015, for the quad and its three stored distances. Here they are inverse
// distances along the eye's axis, which makes every later test linear.

namespace shadowmath {
inline namespace v0 {

// The eye's picture, width x height pixels, as a frame of space.
template <class T>
struct PixelFrame {
    Vec3<T> eye{T(0)};                    // world
    Vec3<T> across{T(1), T(0), T(0)};     // world: one pixel to the right, at depth 1
    Vec3<T> upward{T(0), T(1), T(0)};     // one row on
    Vec3<T> inward{T(0), T(0), T(-1)};    // one metre of depth, through the middle of the picture
    Vec3<T> to_across{T(1), T(0), T(0)};  // rows of the inverse: dotted with point - eye
    Vec3<T> to_upward{T(0), T(1), T(0)};
    Vec3<T> to_inward{T(0), T(0), T(-1)};
    Vec2<T> origin{T(0)};  // orthographic: pixels from the eye's axis to the middle of the picture
    int width = 0;
    int height = 0;
    ViewKind kind = ViewKind::perspective;
    Faults faults;  // of the view; map_too_small for a picture without pixels
};

// `rows`: whether rows of the picture count upward (OpenGL's and this library's backends) or downward.
template <class T>
[[nodiscard]] inline PixelFrame<T> pixel_frame(ViewVolume<T> const& view, int width, int height,
                                               YAxis rows = YAxis::up) noexcept {
    PixelFrame<T> frame;
    frame.faults = faults_of(view);
    if (width < 1 || height < 1) frame.faults |= Fault::map_too_small;
    if (frame.faults.any()) return frame;
    frame.width = width;
    frame.height = height;
    frame.kind = view.kind;
    frame.eye = view.pose.position;
    Vec3<T> const& right = view.pose.right;
    Vec3<T> const up = rows == YAxis::up ? view.pose.up : -view.pose.up;
    T const x_step = (view.right - view.left) / T(width), y_step = (view.top - view.bottom) / T(height);
    T const x_middle = (view.left + view.right) / T(2);
    T const y_middle = (view.bottom + view.top) / (rows == YAxis::up ? T(2) : T(-2));
    frame.across = right * x_step;
    frame.upward = up * y_step;
    frame.to_across = right / x_step;
    frame.to_upward = up / y_step;
    frame.inward = frame.to_inward = view.pose.forward;
    if (view.kind == ViewKind::orthographic) {
        frame.origin = Vec2<T>(x_middle / x_step, y_middle / y_step);
        return frame;
    }
    frame.inward += right * x_middle + up * y_middle;
    frame.to_across -= view.pose.forward * (x_middle / x_step);
    frame.to_upward -= view.pose.forward * (y_middle / y_step);
    return frame;
}

// The same in another scalar type: the three steps as they are, their inverse anew.
template <class Real, class T>
[[nodiscard]] inline PixelFrame<Real> frame_in(PixelFrame<T> const& frame) noexcept {
    PixelFrame<Real> same;
    same.eye = Vec3<Real>(frame.eye);
    same.across = Vec3<Real>(frame.across);
    same.upward = Vec3<Real>(frame.upward);
    same.inward = Vec3<Real>(frame.inward);
    same.origin = Vec2<Real>(frame.origin);
    same.width = frame.width;
    same.height = frame.height;
    same.kind = frame.kind;
    same.faults = frame.faults;
    Vec3<Real> const normal = glm::cross(same.across, same.upward);
    Real const volume = glm::dot(normal, same.inward);
    if (volume == Real(0)) return same;
    same.to_across = glm::cross(same.upward, same.inward) / volume;
    same.to_upward = glm::cross(same.inward, same.across) / volume;
    same.to_inward = normal / volume;
    return same;
}

// A direction, or a point relative to a perspective eye.
template <class T>
[[nodiscard]] inline Vec3<T> direction_in_pixels(PixelFrame<T> const& frame, Vec3<T> const& v) noexcept {
    return Vec3<T>(glm::dot(frame.to_across, v), glm::dot(frame.to_upward, v), glm::dot(frame.to_inward, v));
}

template <class T>
[[nodiscard]] inline Vec3<T> point_in_pixels(PixelFrame<T> const& frame, Vec3<T> const& point) noexcept {
    return direction_in_pixels(frame, point - frame.eye) - Vec3<T>(frame.origin, T(0));
}

// A covector of the pixel frame, arranged so that its value at a point of a surface is x X + y Y + a + b q: half
// spaces are made of it, and the rows of a map's matrix.
template <class T>
struct PixelPlane {
    T x;
    T y;
    T a;
    T b;
};

// The plane whose value at a point of the pixel frame is normal . point + offset, over the point's depth where the eye
// is one of perspective: the same sign.
template <class T>
[[nodiscard]] inline PixelPlane<T> pixel_plane(ViewKind kind, Vec3<T> const& normal, T offset) noexcept {
    if (kind == ViewKind::perspective) return {normal.x, normal.y, normal.z, offset};
    return {normal.x, normal.y, offset, normal.z};
}

template <class T>
struct MicroQuad {
    T q = T(0);    // at the pixel's corner of least x and y: 1 / depth, or depth for an orthographic eye
    T q_x = T(0);  // gained from there to the next corner in x
    T q_y = T(0);
    bool ok = false;
};

// How far one over the depth may change within half a pixel, as a share of its value in the middle: from 2/3 of the
// depth to twice it. A plane that is seen more nearly edge-on is turned toward the eye until it is not.
template <class T>
inline constexpr T steepest_quad = T(0.5);

// The same for an orthographic eye: how many pixels deep half a pixel may be.
template <class T>
inline constexpr T deepest_quad = T(1000);

namespace detail {

// The covector of a world normal: dotted with a point of the pixel frame it is what the normal is with that point.
template <class T>
[[nodiscard]] inline Vec3<T> normal_in_pixels(PixelFrame<T> const& frame, Vec3<T> const& normal) noexcept {
    return Vec3<T>(glm::dot(frame.across, normal), glm::dot(frame.upward, normal), glm::dot(frame.inward, normal));
}

// How much |n.x| + |n.y| weighs against what faces the eye: the reciprocal of twice the limits above.
template <class T>
[[nodiscard]] inline T turn_limit(PixelFrame<T> const& frame) noexcept {
    if (frame.kind == ViewKind::perspective) return T(1) / (T(2) * steepest_quad<T>);
    return T(1) / (T(2) * deepest_quad<T> * glm::length(frame.across));
}

}  // namespace detail

// The piece of the plane through `depth` in the middle of pixel (column, row). The normal is the surface's own, not the
// one for shading; its length and sign do not matter. Not ok where anything is not finite, the normal has no length,
// or the depth is not positive before an eye of perspective.
template <class T>
[[nodiscard]] inline MicroQuad<T> micro_quad(PixelFrame<T> const& frame, int column, int row, T const& depth,
                                             Vec3<T> const& normal_in_world) noexcept {
    bool const flat = frame.kind == ViewKind::orthographic;
    if (!all_finite(&depth, 1) || !all_finite(normal_in_world) || (!flat && !(depth > T(0)))) return {};
    Vec3<T> const n = detail::normal_in_pixels(frame, normal_in_world);
    T const x = T(column) + T(0.5) - T(frame.width) / T(2), y = T(row) + T(0.5) - T(frame.height) / T(2);
    T const facing = flat ? -n.z : n.x * x + n.y * y + n.z;
    T const steep = (std::abs(n.x) + std::abs(n.y)) * detail::turn_limit(frame);
    T const divisor = std::copysign(std::abs(facing) > steep ? std::abs(facing) : steep, facing);
    T const inverse = flat ? divisor : divisor * depth;
    if (inverse == T(0)) return {};
    T const scale = T(1) / inverse;
    MicroQuad<T> quad;
    quad.q_x = n.x * scale;
    quad.q_y = n.y * scale;
    quad.q = (flat ? depth : divisor * scale) - (quad.q_x + quad.q_y) / T(2);
    quad.ok = all_finite(&quad.q, 1) && all_finite(&quad.q_x, 1) && all_finite(&quad.q_y, 1);
    return quad;
}

// The world point of the surface at (u, v) of the pixel, each from 0 at its corner to 1 at the next.
template <class T>
[[nodiscard]] inline Vec3<T> point_on(PixelFrame<T> const& frame, MicroQuad<T> const& quad, int column, int row, T u,
                                      T v) noexcept {
    T const x = T(column) + u - T(frame.width) / T(2), y = T(row) + v - T(frame.height) / T(2);
    T const q = quad.q + quad.q_x * u + quad.q_y * v;
    if (frame.kind == ViewKind::orthographic)
        return frame.eye + frame.across * (x + frame.origin.x) + frame.upward * (y + frame.origin.y) + frame.inward * q;
    return frame.eye + (frame.across * x + frame.upward * y + frame.inward) / q;
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/irregular/plain_lanes.hpp ========
//
// Sixteen numbers at once, as an array: for any scalar type and machine, and the twin that lanes in registers must
// agree with. What an operation means is said here.
//
// A fused operation rounds once or twice, as the machine has it; negating an operand negates the result in any case.

namespace shadowmath {
inline namespace v0 {

inline constexpr int lane_count = 16;

namespace detail {

template <class T>
struct WiderThan {
    using Type = T;
};
template <>
struct WiderThan<float> {
    using Type = double;
};

[[nodiscard]] inline int lowest_bit(std::uint32_t bits) noexcept {
#if defined(__GNUC__)
    return __builtin_ctz(bits);
#else
    int place = 0;
    while ((bits >> place & 1u) == 0) ++place;
    return place;
#endif
}

// Keys are numbers that are only compared: within a byte each, so that sixteen are compared at once. NaN is the last.
template <class T>
[[nodiscard]] inline unsigned char byte_of(T value) noexcept {
    return value < T(255) ? static_cast<unsigned char>(value > T(0) ? value : T(0)) : 255;
}

}  // namespace detail

// What sums of float products are taken in, where their terms cancel; double and long double are their own.
template <class T>
using Wider = typename detail::WiderThan<T>::Type;

template <class T>
struct PlainLanes {
    using Scalar = T;
    using Wide = PlainLanes<Wider<T>>;
    T lane[lane_count];

    [[nodiscard]] static PlainLanes all(T value) noexcept {
        return each([value](int) { return value; });
    }
    template <class From>
    [[nodiscard]] static PlainLanes load(From const* from) noexcept {
        return each([from](int k) { return static_cast<T>(from[k]); });
    }
    [[nodiscard]] static PlainLanes narrow(Wide const& wide) noexcept { return load(wide.lane); }
    void store(T* to) const noexcept {
        for (int k = 0; k < lane_count; ++k) to[k] = lane[k];
    }
    template <class Value>
    [[nodiscard]] static PlainLanes each(Value const& value) noexcept {
        PlainLanes made;
        for (int k = 0; k < lane_count; ++k) made.lane[k] = value(k);
        return made;
    }

    friend PlainLanes operator+(PlainLanes const& a, PlainLanes const& b) noexcept {
        return each([&](int k) { return a.lane[k] + b.lane[k]; });
    }
    friend PlainLanes operator-(PlainLanes const& a, PlainLanes const& b) noexcept {
        return each([&](int k) { return a.lane[k] - b.lane[k]; });
    }
    friend PlainLanes operator*(PlainLanes const& a, PlainLanes const& b) noexcept {
        return each([&](int k) { return a.lane[k] * b.lane[k]; });
    }
    friend PlainLanes operator/(PlainLanes const& a, PlainLanes const& b) noexcept {
        return each([&](int k) { return a.lane[k] / b.lane[k]; });
    }
    // The second where either is NaN.
    friend PlainLanes least(PlainLanes const& a, PlainLanes const& b) noexcept {
        return each([&](int k) { return a.lane[k] < b.lane[k] ? a.lane[k] : b.lane[k]; });
    }
    friend PlainLanes most(PlainLanes const& a, PlainLanes const& b) noexcept {
        return each([&](int k) { return a.lane[k] > b.lane[k] ? a.lane[k] : b.lane[k]; });
    }
    // 1 / a to four roundings; anything where a is 0 or not finite.
    friend PlainLanes reciprocal(PlainLanes const& a) noexcept {
        return each([&](int k) { return a.lane[k] != T(0) ? T(1) / a.lane[k] : T(0); });
    }
    friend PlainLanes absolute(PlainLanes const& a) noexcept {
        return each([&](int k) { return std::abs(a.lane[k]); });
    }
    friend PlainLanes with_sign_of(PlainLanes const& magnitude, PlainLanes const& sign) noexcept {
        return each([&](int k) { return std::copysign(magnitude.lane[k], sign.lane[k]); });
    }
    friend PlainLanes fused(PlainLanes const& a, PlainLanes const& b, PlainLanes const& c) noexcept {
        return each([&](int k) { return a.lane[k] * b.lane[k] + c.lane[k]; });
    }
    // Bit k: a >= b in lane k. Not where either is NaN.
    friend std::uint32_t at_least(PlainLanes const& a, PlainLanes const& b) noexcept {
        std::uint32_t bits = 0;
        for (int k = 0; k < lane_count; ++k) bits |= (a.lane[k] >= b.lane[k] ? 1u : 0u) << k;
        return bits;
    }
    friend T smallest(PlainLanes const& a) noexcept {
        T found = a.lane[0];
        for (int k = 1; k < lane_count; ++k) found = a.lane[k] < found ? a.lane[k] : found;
        return found;
    }
    friend T largest(PlainLanes const& a) noexcept {
        T found = a.lane[0];
        for (int k = 1; k < lane_count; ++k) found = a.lane[k] > found ? a.lane[k] : found;
        return found;
    }
    // Writes those of the sixteen words from `from` on whose bit is set, without gaps; the words behind them, up to
    // sixteen in all, may be anything. Gives how many.
    static std::uint32_t compress(std::uint32_t bits, std::uint32_t const* from, std::uint32_t* to) noexcept {
        std::uint32_t count = 0;
        for (; bits != 0; bits &= bits - 1) to[count++] = from[detail::lowest_bit(bits)];
        return count;
    }
    // Lane 4 j + i: row[j][i].
    [[nodiscard]] static PlainLanes rows(T const* const (&row)[4]) noexcept {
        return each([&row](int k) { return row[k / 4][k % 4]; });
    }
    // The same of three components: row[j][3 i + component].
    static void triples(T const* const (&row)[4], PlainLanes (&components)[3]) noexcept {
        for (int axis = 0; axis < 3; ++axis)
            components[axis] = each([&row, axis](int k) { return row[k / 4][3 * (k % 4) + axis]; });
    }
    // Lane k: the three numbers at at(k).
    template <class At>
    static void points(At const& at, PlainLanes (&xyz)[3]) noexcept {
        for (int axis = 0; axis < 3; ++axis) xyz[axis] = each([&at, axis](int k) { return at(k)[axis]; });
    }
    // From 0 to 255, what is beyond them at the nearer end, without the fraction.
    void store_bytes(unsigned char* to) const noexcept {
        for (int k = 0; k < lane_count; ++k) to[k] = detail::byte_of(lane[k]);
    }
    [[nodiscard]] static PlainLanes load_bytes(unsigned char const* from) noexcept {
        return each([from](int k) { return static_cast<T>(from[k]); });
    }
    // Whole numbers from 0 to 2^31 - 1, without the fraction.
    void store_words(std::uint32_t* to) const noexcept {
        for (int k = 0; k < lane_count; ++k) to[k] = static_cast<std::uint32_t>(static_cast<std::int32_t>(lane[k]));
    }
    // Lanes of a where the bit is set, else those of b.
    friend PlainLanes chosen(std::uint32_t bits, PlainLanes const& a, PlainLanes const& b) noexcept {
        return each([&](int k) { return (bits >> k & 1u) != 0 ? a.lane[k] : b.lane[k]; });
    }
};

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/irregular/x86_lanes.hpp ========
//
// Sixteen floats in registers of an x86 processor:
//
//   Avx512Lanes     one register; where the compiler is told so (-march=native)
//   Avx2Lanes       two registers
//
// What each operation means is said in plain_lanes.hpp.

#if (defined(__AVX512F__) && defined(__AVX512BW__) && defined(__AVX512VL__)) || (defined(__AVX2__) && defined(__FMA__))
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic push  // false alarms inside that header: GCC bug 105593
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#include <immintrin.h>
#pragma GCC diagnostic pop
#else
#include <immintrin.h>
#endif
#endif

namespace shadowmath {
inline namespace v0 {

#if defined(__AVX512F__) && defined(__AVX512BW__) && defined(__AVX512VL__)

// Sixteen doubles, for what is computed once a triangle.
struct Avx512Doubles {
    using Scalar = double;
    __m512d first;
    __m512d second;

    [[nodiscard]] static Avx512Doubles all(double value) noexcept {
        return {_mm512_set1_pd(value), _mm512_set1_pd(value)};
    }
    [[nodiscard]] static Avx512Doubles load(float const* from) noexcept {
        return {_mm512_cvtps_pd(_mm256_loadu_ps(from)), _mm512_cvtps_pd(_mm256_loadu_ps(from + 8))};
    }
    // See PlainLanes: rows.
    [[nodiscard]] static Avx512Doubles rows(double const* const (&row)[4]) noexcept {
        auto const two = [](double const* low, double const* high) {
            return _mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_loadu_pd(low)), _mm256_loadu_pd(high), 1);
        };
        return {two(row[0], row[1]), two(row[2], row[3])};
    }
    void store(double* to) const noexcept {
        _mm512_storeu_pd(to, first);
        _mm512_storeu_pd(to + 8, second);
    }

    friend Avx512Doubles operator+(Avx512Doubles a, Avx512Doubles b) noexcept {
        return {_mm512_add_pd(a.first, b.first), _mm512_add_pd(a.second, b.second)};
    }
    friend Avx512Doubles operator-(Avx512Doubles a, Avx512Doubles b) noexcept {
        return {_mm512_sub_pd(a.first, b.first), _mm512_sub_pd(a.second, b.second)};
    }
    friend Avx512Doubles operator*(Avx512Doubles a, Avx512Doubles b) noexcept {
        return {_mm512_mul_pd(a.first, b.first), _mm512_mul_pd(a.second, b.second)};
    }
    friend Avx512Doubles absolute(Avx512Doubles a) noexcept {
        return {_mm512_abs_pd(a.first), _mm512_abs_pd(a.second)};
    }
    friend Avx512Doubles with_sign_of(Avx512Doubles magnitude, Avx512Doubles sign) noexcept {
        __m512i const top = _mm512_set1_epi64(std::numeric_limits<std::int64_t>::min());
        auto const signed_as = [top](__m512d m, __m512d s) {
            return _mm512_castsi512_pd(
                _mm512_ternarylogic_epi64(top, _mm512_castpd_si512(s), _mm512_castpd_si512(m), 0xca));
        };
        return {signed_as(magnitude.first, sign.first), signed_as(magnitude.second, sign.second)};
    }
    friend Avx512Doubles fused(Avx512Doubles a, Avx512Doubles b, Avx512Doubles c) noexcept {
        return {_mm512_fmadd_pd(a.first, b.first, c.first), _mm512_fmadd_pd(a.second, b.second, c.second)};
    }
    friend std::uint32_t at_least(Avx512Doubles a, Avx512Doubles b) noexcept {
        std::uint32_t const low = _mm512_cmp_pd_mask(a.first, b.first, _CMP_GE_OQ);
        return low | static_cast<std::uint32_t>(_mm512_cmp_pd_mask(a.second, b.second, _CMP_GE_OQ)) << 8;
    }
};

struct Avx512Lanes {
    using Scalar = float;
    using Wide = Avx512Doubles;
    __m512 lanes;

    [[nodiscard]] static Avx512Lanes all(float value) noexcept { return {_mm512_set1_ps(value)}; }
    [[nodiscard]] static Avx512Lanes load(float const* from) noexcept { return {_mm512_loadu_ps(from)}; }
    void store(float* to) const noexcept { _mm512_storeu_ps(to, lanes); }

    friend Avx512Lanes operator+(Avx512Lanes a, Avx512Lanes b) noexcept { return {_mm512_add_ps(a.lanes, b.lanes)}; }
    friend Avx512Lanes operator-(Avx512Lanes a, Avx512Lanes b) noexcept { return {_mm512_sub_ps(a.lanes, b.lanes)}; }
    friend Avx512Lanes operator*(Avx512Lanes a, Avx512Lanes b) noexcept { return {_mm512_mul_ps(a.lanes, b.lanes)}; }
    friend Avx512Lanes operator/(Avx512Lanes a, Avx512Lanes b) noexcept { return {_mm512_div_ps(a.lanes, b.lanes)}; }
    friend Avx512Lanes least(Avx512Lanes a, Avx512Lanes b) noexcept { return {_mm512_min_ps(a.lanes, b.lanes)}; }
    friend Avx512Lanes most(Avx512Lanes a, Avx512Lanes b) noexcept { return {_mm512_max_ps(a.lanes, b.lanes)}; }
    friend Avx512Lanes reciprocal(Avx512Lanes a) noexcept {
        __m512 const rough = _mm512_rcp14_ps(a.lanes);  // 14 bits; a step of Newton's doubles them
        return {_mm512_mul_ps(rough, _mm512_fnmadd_ps(a.lanes, rough, _mm512_set1_ps(2.0f)))};
    }
    friend Avx512Lanes absolute(Avx512Lanes a) noexcept { return {_mm512_abs_ps(a.lanes)}; }
    friend Avx512Lanes with_sign_of(Avx512Lanes magnitude, Avx512Lanes sign) noexcept {
        __m512i const top = _mm512_set1_epi32(static_cast<int>(0x80000000u));
        // a where top, else b.
        return {_mm512_castsi512_ps(_mm512_ternarylogic_epi32(top, _mm512_castps_si512(sign.lanes),
                                                              _mm512_castps_si512(magnitude.lanes), 0xca))};
    }
    friend Avx512Lanes fused(Avx512Lanes a, Avx512Lanes b, Avx512Lanes c) noexcept {
        return {_mm512_fmadd_ps(a.lanes, b.lanes, c.lanes)};
    }
    friend std::uint32_t at_least(Avx512Lanes a, Avx512Lanes b) noexcept {
        return _mm512_cmp_ps_mask(a.lanes, b.lanes, _CMP_GE_OQ);
    }
    friend float smallest(Avx512Lanes a) noexcept { return _mm512_reduce_min_ps(a.lanes); }
    friend float largest(Avx512Lanes a) noexcept { return _mm512_reduce_max_ps(a.lanes); }
    static std::uint32_t compress(std::uint32_t bits, std::uint32_t const* from, std::uint32_t* to) noexcept {
        __m512i const packed = _mm512_maskz_compress_epi32(static_cast<__mmask16>(bits), _mm512_loadu_si512(from));
        _mm512_storeu_si512(to, packed);
        return static_cast<std::uint32_t>(_mm_popcnt_u32(bits));
    }
    friend Avx512Lanes chosen(std::uint32_t bits, Avx512Lanes a, Avx512Lanes b) noexcept {
        return {_mm512_mask_blend_ps(static_cast<__mmask16>(bits), b.lanes, a.lanes)};
    }
    [[nodiscard]] static Avx512Lanes rows(float const* const (&row)[4]) noexcept { return {four_of(row, 0)}; }
    static void triples(float const* const (&row)[4], Avx512Lanes (&components)[3]) noexcept {
        __m512 const a = four_of(row, 0), b = four_of(row, 4), c = four_of(row, 8);  // xyzx yzxy zxyz
        __m512 const x = _mm512_shuffle_ps(b, c, _MM_SHUFFLE(1, 1, 2, 2));
        __m512 const y0 = _mm512_shuffle_ps(a, b, _MM_SHUFFLE(0, 0, 1, 1));
        __m512 const y1 = _mm512_shuffle_ps(b, c, _MM_SHUFFLE(2, 2, 3, 3));
        __m512 const z = _mm512_shuffle_ps(a, b, _MM_SHUFFLE(1, 1, 2, 2));
        components[0] = {_mm512_shuffle_ps(a, x, _MM_SHUFFLE(2, 0, 3, 0))};
        components[1] = {_mm512_shuffle_ps(y0, y1, _MM_SHUFFLE(2, 0, 2, 0))};
        components[2] = {_mm512_shuffle_ps(z, c, _MM_SHUFFLE(3, 0, 2, 0))};
    }
    template <class At>
    static void points(At const& at, Avx512Lanes (&xyz)[3]) noexcept {
        auto const four = [&at](int k) {
            auto const three = [&at](int lane) {
                float const* const from = at(lane);
                __m128 const xy = _mm_castsi128_ps(_mm_loadl_epi64(reinterpret_cast<__m128i const*>(from)));
                return _mm_insert_ps(xy, _mm_load_ss(from + 2), 0x20);
            };
            __m256 const low = _mm256_insertf128_ps(_mm256_castps128_ps256(three(k)), three(k + 4), 1);
            __m256 const high = _mm256_insertf128_ps(_mm256_castps128_ps256(three(k + 8)), three(k + 12), 1);
            return _mm512_castpd_ps(
                _mm512_insertf64x4(_mm512_castps_pd(_mm512_castps256_ps512(low)), _mm256_castps_pd(high), 1));
        };
        auto const pairs_low = [](__m512 a, __m512 b) { return _mm512_castps_pd(_mm512_unpacklo_ps(a, b)); };
        auto const pairs_high = [](__m512 a, __m512 b) { return _mm512_castps_pd(_mm512_unpackhi_ps(a, b)); };
        __m512 const a = four(0), b = four(1), c = four(2), d = four(3);
        xyz[0] = {_mm512_castpd_ps(_mm512_unpacklo_pd(pairs_low(a, b), pairs_low(c, d)))};
        xyz[1] = {_mm512_castpd_ps(_mm512_unpackhi_pd(pairs_low(a, b), pairs_low(c, d)))};
        xyz[2] = {_mm512_castpd_ps(_mm512_unpacklo_pd(pairs_high(a, b), pairs_high(c, d)))};
    }
    void store_bytes(unsigned char* to) const noexcept {
        __m512 const inside = _mm512_min_ps(_mm512_max_ps(lanes, _mm512_setzero_ps()), _mm512_set1_ps(255.0f));
        _mm_storeu_si128(reinterpret_cast<__m128i*>(to), _mm512_cvtepi32_epi8(_mm512_cvttps_epi32(inside)));
    }
    [[nodiscard]] static Avx512Lanes narrow(Wide const& wide) noexcept {
        __m256 const low = _mm512_cvtpd_ps(wide.first), high = _mm512_cvtpd_ps(wide.second);
        return {_mm512_castpd_ps(
            _mm512_insertf64x4(_mm512_castps_pd(_mm512_castps256_ps512(low)), _mm256_castps_pd(high), 1))};
    }
    [[nodiscard]] static Avx512Lanes load_bytes(unsigned char const* from) noexcept {
        __m128i const bytes = _mm_loadu_si128(reinterpret_cast<__m128i const*>(from));
        return {_mm512_cvtepi32_ps(_mm512_cvtepu8_epi32(bytes))};
    }
    void store_words(std::uint32_t* to) const noexcept { _mm512_storeu_si512(to, _mm512_cvttps_epi32(lanes)); }

private:
    // Four numbers of each row.
    [[nodiscard]] static __m512 four_of(float const* const (&row)[4], int first) noexcept {
        __m256 const low =
            _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(row[0] + first)), _mm_loadu_ps(row[1] + first), 1);
        __m256 const high =
            _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(row[2] + first)), _mm_loadu_ps(row[3] + first), 1);
        return _mm512_castpd_ps(
            _mm512_insertf64x4(_mm512_castps_pd(_mm512_castps256_ps512(low)), _mm256_castps_pd(high), 1));
    }
};

#endif

#if defined(__AVX2__) && defined(__FMA__)

struct Avx2Lanes {
    using Scalar = float;
    using Wide = PlainLanes<double>;
    __m256 first;
    __m256 second;

    [[nodiscard]] static Avx2Lanes all(float value) noexcept { return {_mm256_set1_ps(value), _mm256_set1_ps(value)}; }
    [[nodiscard]] static Avx2Lanes load(float const* from) noexcept {
        return {_mm256_loadu_ps(from), _mm256_loadu_ps(from + 8)};
    }
    void store(float* to) const noexcept {
        _mm256_storeu_ps(to, first);
        _mm256_storeu_ps(to + 8, second);
    }

    friend Avx2Lanes operator+(Avx2Lanes a, Avx2Lanes b) noexcept {
        return {_mm256_add_ps(a.first, b.first), _mm256_add_ps(a.second, b.second)};
    }
    friend Avx2Lanes operator-(Avx2Lanes a, Avx2Lanes b) noexcept {
        return {_mm256_sub_ps(a.first, b.first), _mm256_sub_ps(a.second, b.second)};
    }
    friend Avx2Lanes operator*(Avx2Lanes a, Avx2Lanes b) noexcept {
        return {_mm256_mul_ps(a.first, b.first), _mm256_mul_ps(a.second, b.second)};
    }
    friend Avx2Lanes operator/(Avx2Lanes a, Avx2Lanes b) noexcept {
        return {_mm256_div_ps(a.first, b.first), _mm256_div_ps(a.second, b.second)};
    }
    friend Avx2Lanes least(Avx2Lanes a, Avx2Lanes b) noexcept {
        return {_mm256_min_ps(a.first, b.first), _mm256_min_ps(a.second, b.second)};
    }
    friend Avx2Lanes most(Avx2Lanes a, Avx2Lanes b) noexcept {
        return {_mm256_max_ps(a.first, b.first), _mm256_max_ps(a.second, b.second)};
    }
    friend Avx2Lanes reciprocal(Avx2Lanes a) noexcept { return all(1.0f) / a; }
    friend Avx2Lanes absolute(Avx2Lanes a) noexcept {
        __m256 const top = _mm256_set1_ps(-0.0f);
        return {_mm256_andnot_ps(top, a.first), _mm256_andnot_ps(top, a.second)};
    }
    friend Avx2Lanes with_sign_of(Avx2Lanes magnitude, Avx2Lanes sign) noexcept {
        __m256 const top = _mm256_set1_ps(-0.0f);
        return {_mm256_or_ps(_mm256_andnot_ps(top, magnitude.first), _mm256_and_ps(top, sign.first)),
                _mm256_or_ps(_mm256_andnot_ps(top, magnitude.second), _mm256_and_ps(top, sign.second))};
    }
    friend Avx2Lanes fused(Avx2Lanes a, Avx2Lanes b, Avx2Lanes c) noexcept {
        return {_mm256_fmadd_ps(a.first, b.first, c.first), _mm256_fmadd_ps(a.second, b.second, c.second)};
    }
    friend std::uint32_t at_least(Avx2Lanes a, Avx2Lanes b) noexcept {
        int const low = _mm256_movemask_ps(_mm256_cmp_ps(a.first, b.first, _CMP_GE_OQ));
        int const high = _mm256_movemask_ps(_mm256_cmp_ps(a.second, b.second, _CMP_GE_OQ));
        return static_cast<std::uint32_t>(low) | static_cast<std::uint32_t>(high) << 8;
    }
    friend float smallest(Avx2Lanes a) noexcept {
        __m256 const eight = _mm256_min_ps(a.first, a.second);
        __m128 const four = _mm_min_ps(_mm256_castps256_ps128(eight), _mm256_extractf128_ps(eight, 1));
        __m128 const two = _mm_min_ps(four, _mm_movehl_ps(four, four));
        return _mm_cvtss_f32(_mm_min_ss(two, _mm_movehdup_ps(two)));
    }
    friend float largest(Avx2Lanes a) noexcept {
        __m256 const eight = _mm256_max_ps(a.first, a.second);
        __m128 const four = _mm_max_ps(_mm256_castps256_ps128(eight), _mm256_extractf128_ps(eight, 1));
        __m128 const two = _mm_max_ps(four, _mm_movehl_ps(four, four));
        return _mm_cvtss_f32(_mm_max_ss(two, _mm_movehdup_ps(two)));
    }
    static std::uint32_t compress(std::uint32_t bits, std::uint32_t const* from, std::uint32_t* to) noexcept {
        return PlainLanes<float>::compress(bits, from, to);
    }
    friend Avx2Lanes chosen(std::uint32_t bits, Avx2Lanes a, Avx2Lanes b) noexcept {
        __m256i const lane = _mm256_setr_epi32(1, 2, 4, 8, 16, 32, 64, 128);
        auto const mask = [lane](std::uint32_t part) {
            __m256i const here = _mm256_and_si256(_mm256_set1_epi32(static_cast<int>(part)), lane);
            return _mm256_castsi256_ps(_mm256_cmpeq_epi32(here, lane));
        };
        return {_mm256_blendv_ps(b.first, a.first, mask(bits & 0xffu)),
                _mm256_blendv_ps(b.second, a.second, mask(bits >> 8))};
    }
    [[nodiscard]] static Avx2Lanes rows(float const* const (&row)[4]) noexcept {
        return {two_of(row[0], row[1]), two_of(row[2], row[3])};
    }
    static void triples(float const* const (&row)[4], Avx2Lanes (&components)[3]) noexcept {
        halves(row[0], row[1], components[0].first, components[1].first, components[2].first);
        halves(row[2], row[3], components[0].second, components[1].second, components[2].second);
    }
    template <class At>
    static void points(At const& at, Avx2Lanes (&xyz)[3]) noexcept {
        auto const eight = [&at](int k, __m256& x, __m256& y, __m256& z) {
            auto const two = [&at](int lane) {
                auto const three = [](float const* from) {
                    __m128 const xy = _mm_castsi128_ps(_mm_loadl_epi64(reinterpret_cast<__m128i const*>(from)));
                    return _mm_insert_ps(xy, _mm_load_ss(from + 2), 0x20);
                };
                return _mm256_set_m128(three(at(lane + 4)), three(at(lane)));
            };
            __m256 const a = two(k), b = two(k + 1), c = two(k + 2), d = two(k + 3);
            __m256 const ab = _mm256_unpacklo_ps(a, b), cd = _mm256_unpacklo_ps(c, d);
            x = _mm256_shuffle_ps(ab, cd, _MM_SHUFFLE(1, 0, 1, 0));
            y = _mm256_shuffle_ps(ab, cd, _MM_SHUFFLE(3, 2, 3, 2));
            z = _mm256_shuffle_ps(_mm256_unpackhi_ps(a, b), _mm256_unpackhi_ps(c, d), _MM_SHUFFLE(1, 0, 1, 0));
        };
        eight(0, xyz[0].first, xyz[1].first, xyz[2].first);
        eight(8, xyz[0].second, xyz[1].second, xyz[2].second);
    }
    void store_bytes(unsigned char* to) const noexcept {
        auto const inside = [](__m256 eight) {
            return _mm256_cvttps_epi32(
                _mm256_min_ps(_mm256_max_ps(eight, _mm256_setzero_ps()), _mm256_set1_ps(255.0f)));
        };
        __m256i const shorts = _mm256_packs_epi32(inside(first), inside(second));
        __m256i const ordered = _mm256_permute4x64_epi64(shorts, 0xd8);
        _mm_storeu_si128(reinterpret_cast<__m128i*>(to),
                         _mm_packus_epi16(_mm256_castsi256_si128(ordered), _mm256_extracti128_si256(ordered, 1)));
    }
    [[nodiscard]] static Avx2Lanes narrow(Wide const& wide) noexcept {
        auto const four = [&wide](int k) { return _mm256_cvtpd_ps(_mm256_loadu_pd(wide.lane + k)); };
        return {_mm256_set_m128(four(4), four(0)), _mm256_set_m128(four(12), four(8))};
    }
    [[nodiscard]] static Avx2Lanes load_bytes(unsigned char const* from) noexcept {
        auto const eight = [](unsigned char const* bytes) {
            __m128i const here = _mm_loadl_epi64(reinterpret_cast<__m128i const*>(bytes));
            return _mm256_cvtepi32_ps(_mm256_cvtepu8_epi32(here));
        };
        return {eight(from), eight(from + 8)};
    }
    void store_words(std::uint32_t* to) const noexcept {
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), _mm256_cvttps_epi32(first));
        _mm256_storeu_si256(reinterpret_cast<__m256i*>(to + 8), _mm256_cvttps_epi32(second));
    }

private:
    [[nodiscard]] static __m256 two_of(float const* low, float const* high) noexcept {
        return _mm256_insertf128_ps(_mm256_castps128_ps256(_mm_loadu_ps(low)), _mm_loadu_ps(high), 1);
    }
    static void halves(float const* low, float const* high, __m256& x, __m256& y, __m256& z) noexcept {
        __m256 const a = two_of(low, high), b = two_of(low + 4, high + 4), c = two_of(low + 8, high + 8);
        __m256 const x23 = _mm256_shuffle_ps(b, c, _MM_SHUFFLE(1, 1, 2, 2));
        __m256 const y01 = _mm256_shuffle_ps(a, b, _MM_SHUFFLE(0, 0, 1, 1));
        __m256 const y23 = _mm256_shuffle_ps(b, c, _MM_SHUFFLE(2, 2, 3, 3));
        __m256 const z01 = _mm256_shuffle_ps(a, b, _MM_SHUFFLE(1, 1, 2, 2));
        x = _mm256_shuffle_ps(a, x23, _MM_SHUFFLE(2, 0, 3, 0));
        y = _mm256_shuffle_ps(y01, y23, _MM_SHUFFLE(2, 0, 2, 0));
        z = _mm256_shuffle_ps(z01, c, _MM_SHUFFLE(3, 0, 2, 0));
    }
};

#endif

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/irregular/lanes.hpp ========
//
// Sixteen numbers at once: one for each pixel of a 4 x 4 tile, or for sixteen nodes of a list. The kernels of the
// irregular z-buffer are written once, on these operations; which registers hold the numbers is a type.
//
//   PlainLanes<T>             plain_lanes.hpp
//   Avx512Lanes, Avx2Lanes    x86_lanes.hpp
//   BestLanes<T>              the fastest of them in this translation unit
//
// The type is a template argument of every kernel, so translation units built for different machines can be linked.

namespace shadowmath {
inline namespace v0 {

namespace detail {

// The same words for a single number, so that a formula can be written once for one and for sixteen.
template <class T>
[[nodiscard]] inline T fused(T a, T b, T c) noexcept {
    return a * b + c;
}
template <class T>
[[nodiscard]] inline T absolute(T a) noexcept {
    return std::abs(a);
}
template <class T>
[[nodiscard]] inline T with_sign_of(T magnitude, T sign) noexcept {
    return std::copysign(magnitude, sign);
}

// Asks for a line of the caches before it is needed, where the machine can be told.
inline void fetch_soon(void const* line) noexcept {
#if defined(__GNUC__)
    __builtin_prefetch(line);
#else
    static_cast<void>(line);
#endif
}

template <class T>
struct LanesFor {
    using Type = PlainLanes<T>;
};
#if defined(__AVX512F__) && defined(__AVX512BW__) && defined(__AVX512VL__)
template <>
struct LanesFor<float> {
    using Type = Avx512Lanes;
};
#elif defined(__AVX2__) && defined(__FMA__)
template <>
struct LanesFor<float> {
    using Type = Avx2Lanes;
};
#endif

}  // namespace detail

template <class T>
using BestLanes = typename detail::LanesFor<T>::Type;

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/irregular/edge.hpp ========
//
// The shadow volume of a triangle as four half spaces, each arranged so that one pixel of a surface sees it as a half
// plane: the triangle's own plane, and one through the light and each edge.
//
//   a sample is in shadow  <=>  it is behind the triangle, and on the inner side of all three edge planes
//                          <=>  the segment from the sample to the light meets the triangle
//
// An edge's plane depends on its two ends alone and changes nothing but its sign when they are exchanged: the two
// triangles at a shared edge see exactly opposite values, to the last bit. A value of 0 is inside for both, so no light
// leaks between them. Triangles cast on both sides, however they wind.
//
// Source: Wyman, Hoetzlein and Lefohn, I3D 2015; the sums over both ends instead of one are ours.

namespace shadowmath {
inline namespace v0 {

// The light in the pixel frame: how it travels, or where it stands.
template <class T>
struct PixelLight {
    Vec3<T> at{T(0)};
    bool parallel = true;
};

template <class T>
[[nodiscard]] inline PixelLight<T> pixel_light(PixelFrame<T> const& frame, Light<T> const& light) noexcept {
    if (light.kind == LightKind::directional) return {direction_in_pixels(frame, light.direction), true};
    return {point_in_pixels(frame, light.position), false};
}

// A sample nearer to the plane of a triangle than this is not in its shadow: it lies on that triangle, or on a
// neighbour in the same plane, and the side on which rounding left it means nothing.
template <class T>
struct ContactMargin {
    T metres = T(0);
    T share = T(0);  // of the sample's depth, on top
};

// Of one triangle where V is a scalar, of sixteen where it is Lanes. planes[0] is the triangle's own, then its edges'.
template <class V>
struct ShadowVolume {
    PixelPlane<V> planes[4];
    V along;  // the triangle's normal with the light: 0 where it has no area as seen from there, and casts nothing
};

namespace detail {

template <class V>
struct Triple {
    V x, y, z;
};

template <class V>
[[nodiscard]] inline Triple<V> difference(Triple<V> const& a, Triple<V> const& b) noexcept {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class V>
[[nodiscard]] inline Triple<V> sum(Triple<V> const& a, Triple<V> const& b) noexcept {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class V>
[[nodiscard]] inline Triple<V> scaled(Triple<V> const& a, V const& by) noexcept {
    return {a.x * by, a.y * by, a.z * by};
}
template <class V>
[[nodiscard]] inline V inner(Triple<V> const& a, Triple<V> const& b) noexcept {
    return fused(a.x, b.x, fused(a.y, b.y, a.z * b.z));
}
// Negated to the last bit when b is.
template <class V>
[[nodiscard]] inline Triple<V> crossed(Triple<V> const& a, Triple<V> const& b) noexcept {
    V const zero = a.x - a.x;
    return {fused(a.y, b.z, zero - a.z * b.y), fused(a.z, b.x, zero - a.x * b.z), fused(a.x, b.y, zero - a.y * b.x)};
}

// `all` makes a V of a scalar.
template <class V, class T, class All>
[[nodiscard]] inline ShadowVolume<V> volume_of(PixelFrame<T> const& frame, PixelLight<T> const& light,
                                               Triple<V> const (&p)[3], V const& margin_metres, T margin_share,
                                               All const& all) noexcept {
    auto const triple = [&all](Vec3<T> const& v) { return Triple<V>{all(v.x), all(v.y), all(v.z)}; };
    auto const plane = [&frame](Triple<V> const& n, V const& offset) {
        if (frame.kind == ViewKind::perspective) return PixelPlane<V>{n.x, n.y, n.z, offset};
        return PixelPlane<V>{n.x, n.y, offset, n.z};
    };
    Triple<V> const source = triple(light.at);
    Triple<V> const normal = crossed(difference(p[1], p[0]), difference(p[2], p[0]));
    ShadowVolume<V> volume;
    volume.along = inner(normal, light.parallel ? source : difference(p[0], source));
    // Where the light meets the other side, everything is turned over.
    V const sign = with_sign_of(all(T(1)), volume.along);
    Triple<V> const facing = scaled(normal, sign);
    Triple<V> const in_world =
        sum(scaled(triple(frame.to_across), facing.x),
            sum(scaled(triple(frame.to_upward), facing.y), scaled(triple(frame.to_inward), facing.z)));
    V const unit = absolute(in_world.x) + absolute(in_world.y) + absolute(in_world.z);
    volume.planes[0] = plane({facing.x, facing.y, facing.z - unit * all(margin_share)},
                             all(T(0)) - fused(unit, margin_metres, inner(facing, p[0])));
    for (int i = 0; i < 3; ++i) {
        Triple<V> const &from = p[i], &to = p[(i + 1) % 3];
        Triple<V> const both = sum(from, to);
        Triple<V> const away = light.parallel ? source : difference(both, scaled(source, all(T(2))));
        Triple<V> const n = crossed(away, scaled(difference(to, from), sign));
        volume.planes[1 + i] = plane(n, inner(n, both) * all(T(-0.5)));
    }
    return volume;
}

}  // namespace detail

// The vertices are points of the pixel frame, finite. The margin is taken along the triangle's normal: exactly along
// the axes, up to sqrt(3) times as much off them.
template <class T>
[[nodiscard]] inline ShadowVolume<T> shadow_volume(PixelFrame<T> const& frame, PixelLight<T> const& light,
                                                   Vec3<T> const& p0, Vec3<T> const& p1, Vec3<T> const& p2,
                                                   ContactMargin<T> const& margin) noexcept {
    detail::Triple<T> const p[3] = {{p0.x, p0.y, p0.z}, {p1.x, p1.y, p1.z}, {p2.x, p2.y, p2.z}};
    return detail::volume_of(frame, light, p, margin.metres, margin.share, [](T value) { return value; });
}

// What a pixel sees of a half space: inside where c + x u + y v >= 0, u and v from 0 to 1 over the pixel.
template <class T>
struct PixelLine {
    T c = T(0);
    T x = T(0);
    T y = T(0);
};

template <class T>
[[nodiscard]] inline PixelLine<T> line_across(PixelFrame<T> const& frame, PixelPlane<T> const& plane,
                                              MicroQuad<T> const& quad, int column, int row) noexcept {
    T const x = T(column) - T(frame.width) / T(2), y = T(row) - T(frame.height) / T(2);
    return {plane.x * x + plane.y * y + plane.a + plane.b * quad.q, plane.x + plane.b * quad.q_x,
            plane.y + plane.b * quad.q_y};
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/irregular/mask.hpp ========
//
// Thirty-two samples of a pixel as the bits of a word, and which of them a half plane holds: exactly, or out of a table
// of 1024 words.
//
// Use the exact test where arithmetic is wide: it costs two fused operations and a comparison a register. The table is
// for machines where a look-up is cheaper; it moves the line by at most table_displacement of a pixel.
//
// Source: 32 Halton points and 5 + 5 bits of angle and radius, Wyman, Hoetzlein and Lefohn, I3D 2015. How the two are
// rounded is ours.

namespace shadowmath {
inline namespace v0 {

inline constexpr int samples_per_pixel = 32;
inline constexpr std::uint32_t every_sample = 0xffffffffu;

// Digits of `index` in this base, mirrored at the point.
template <class T>
[[nodiscard]] constexpr T radical_inverse(int base, int index) noexcept {
    T value = T(0), place = T(1) / T(base);
    for (; index > 0; index /= base, place /= T(base)) value += T(index % base) * place;
    return value;
}

// In the pixel's unit square, bit i of a mask at (u[i], v[i]): the Halton points of bases 2 and 3 from index 1 on.
template <class T>
struct PixelSamples {
    T u[samples_per_pixel];
    T v[samples_per_pixel];
};

namespace detail {

template <class T>
[[nodiscard]] constexpr PixelSamples<T> halton_samples() noexcept {
    PixelSamples<T> samples{};
    for (int i = 0; i < samples_per_pixel; ++i) {
        samples.u[i] = radical_inverse<T>(2, i + 1);
        samples.v[i] = radical_inverse<T>(3, i + 1);
    }
    return samples;
}

}  // namespace detail

template <class T>
inline constexpr PixelSamples<T> pixel_samples = detail::halton_samples<T>();

// The samples where c + x u + y v >= 0, evaluated as (c + x u) + y v. A line and its negative together hold every
// sample.
template <class Lanes, class T = typename Lanes::Scalar>
[[nodiscard]] inline std::uint32_t half_plane_mask(PixelLine<T> const& line) noexcept {
    Lanes const c = Lanes::all(line.c), x = Lanes::all(line.x), y = Lanes::all(line.y), zero = Lanes::all(T(0));
    PixelSamples<T> const& at = pixel_samples<T>;
    auto const half = [&](int first) {
        return at_least(fused(y, Lanes::load(at.v + first), fused(x, Lanes::load(at.u + first), c)), zero);
    };
    return half(0) | half(lane_count) << lane_count;
}

// The samples that all four hold.
template <class Lanes, class T = typename Lanes::Scalar>
[[nodiscard]] inline std::uint32_t half_planes_mask(PixelLine<T> const (&lines)[4]) noexcept {
    Lanes const zero = Lanes::all(T(0));
    std::uint32_t low = (1u << lane_count) - 1u, high = low;
    for (PixelLine<T> const& line : lines) {
        Lanes const c = Lanes::all(line.c), x = Lanes::all(line.x), y = Lanes::all(line.y);
        PixelSamples<T> const& at = pixel_samples<T>;
        low &= at_least(fused(y, Lanes::load(at.v), fused(x, Lanes::load(at.u), c)), zero);
        high &= at_least(fused(y, Lanes::load(at.v + lane_count), fused(x, Lanes::load(at.u + lane_count), c)), zero);
    }
    return low | high << lane_count;
}

inline constexpr int table_steps = 32;  // of angle, and of radius

// Half a step of radius, and half a step of angle where a radius is longest: sqrt(1/2) (1 / 64 + pi / 32).
inline constexpr double table_displacement = 0.0805;

// The masks of half planes n . (s - middle) >= r, by angle of n and then by r from 0 to sqrt(1/2).
struct HalfPlaneTable {
    std::array<std::uint32_t, table_steps * table_steps> masks;
};

template <class T = double>
[[nodiscard]] inline HalfPlaneTable half_plane_table() noexcept {
    HalfPlaneTable table{};
    double const step = 6.283185307179586 / table_steps, reach = 0.7071067811865476 / table_steps;
    for (int k = 0; k < table_steps; ++k)
        for (int j = 0; j < table_steps; ++j) {
            double const x = std::cos((k + 0.5) * step), y = std::sin((k + 0.5) * step);
            PixelLine<T> const line{-(x + y) / 2.0 - (j + 0.5) * reach, x, y};
            table.masks[static_cast<std::size_t>(k * table_steps + j)] = half_plane_mask<PlainLanes<T>>(line);
        }
    return table;
}

// As half_plane_mask, but that samples within table_displacement of the line may be on either side.
template <class T>
[[nodiscard]] inline std::uint32_t half_plane_mask(HalfPlaneTable const& table, PixelLine<T> const& line) noexcept {
    T const middle = line.c + (line.x + line.y) / T(2);
    T const length = std::sqrt(line.x * line.x + line.y * line.y);
    T const r = -middle;
    T const reach = T(0.70710678118654752440L) * length;
    if (!(r < reach)) return length == T(0) && r <= T(0) ? every_sample : 0u;
    if (r <= -reach) return every_sample;
    // A line beyond the middle is the complement of its opposite.
    bool const beyond = r < T(0);
    T const angle = beyond ? std::atan2(-line.y, -line.x) : std::atan2(line.y, line.x);
    constexpr T turns = T(table_steps) / T(6.283185307179586476925286766559L);
    int const k = static_cast<int>(std::floor(angle * turns)) & (table_steps - 1);
    // NOTE: as an unsigned number: under -ffast-math a length that overflows gives any j at all.
    unsigned const j = static_cast<unsigned>(static_cast<int>(std::abs(r) / reach * T(table_steps)));
    unsigned const last = table_steps - 1;
    std::uint32_t const mask = table.masks[static_cast<unsigned>(k) * table_steps + (j < last ? j : last)];
    return beyond ? ~mask : mask;
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/irregular/buffer.hpp ========
//
// What the irregular z-buffer is made of, and the storage that holds it: plain arrays of the caller's.
//
// Memory, in floats, with the capacity that storage_for takes by itself: 64 bytes a pixel, 12 of them for sorting
// triangles, and 37 a texel of the grid; nothing for each triangle. A capacity known from the frame before spares a
// fifth of it.

namespace shadowmath {
inline namespace v0 {

inline constexpr int tile_side = 4;
inline constexpr int level_shift = 2;  // a texel is 4 x 4 of the next finer level
inline constexpr int most_levels = 8;
inline constexpr int most_divisions = 5;  // of a texel of the finest level: 2^5 x 2^5 parts
inline constexpr int largest_grid = 1 << 11;

// What the eye sees, row by row, `width` pixels each. Sky is a pixel whose normal is zero, whose depth is not positive,
// or of which anything is not finite.
template <class T>
struct Receivers {
    T const* position = nullptr;  // world; three scalars a pixel, `position_stride` apart
    int position_stride = 3;
    T const* depth = nullptr;   // instead of positions: metres along the view's forward axis, one a pixel
    T const* normal = nullptr;  // of the surface, not for shading; any length and sign
    int normal_stride = 3;
};

// Part of a picture; a width or height of 0 stands for all that follows.
struct PixelRect {
    int x = 0;
    int y = 0;
    int width = 0;
    int height = 0;
};

// What the lists of a buffer came to.
struct ListCounts {
    std::uint32_t tiles = 0;  // with a pixel that light may reach
    std::uint32_t parts = 0;  // tiles, and parts of those that straddle a silhouette: what `capacity` must hold
    std::uint32_t nodes = 0;
    std::uint32_t lists = 0;    // texels that are not empty
    std::uint32_t longest = 0;  // nodes in one texel
};

struct StorageSize {
    std::size_t scalars = 0;
    std::size_t words = 0;
};

// The two arrays of a buffer, at least as long as storage_for says.
template <class T>
struct Storage {
    T* scalars = nullptr;
    std::uint32_t* words = nullptr;
    StorageSize size;
};

// A picture's part as the light sees it. Everything is indexed with 32 bits and laid out in arrays of one kind, so that
// it can be handed to a GPU as it is.
template <class T>
struct IrregularBuffer {
    PixelFrame<T> frame;
    PixelLight<T> light;
    Light<Wider<T>> source;
    PixelRect rect;
    Vec4<T> row[4];             // texel x, texel y, depth and w of a point, from its place relative to the eye
    T texel_error = T(0);       // what rounding may add to a texel coordinate times w, for each metre from the eye
    T texel_error_here = T(0);  // and whatever the distance
    T depth_error = T(0);
    T depth_error_here = T(0);
    T contact_reach = T(0);  // metres, and share of the depth, that margins of contact are a part of; see trace.hpp
    T contact_ray = T(0);
    int tiles_across = 0;
    int tile_count = 0;
    int map_size = 0;
    int level_count = 0;
    std::uint32_t level_first[most_levels]{};  // place in `first` of the levels from 1 on
    std::uint32_t levels_used = 0;             // bit l: level l has a node

    // Tiles: sixteen pixels each, four rows of four; tile_scalars and tile_words of each, see below.
    T* surface = nullptr;
    std::uint32_t* state = nullptr;

    // Nodes, sorted by list: lo x, hi x, lo y, hi y in texels of the finest level, the far end of the depths; the tile.
    T* bounds = nullptr;
    std::uint32_t* tile = nullptr;
    std::uint32_t* first = nullptr;  // node of each list, one more at the end
    std::uint32_t list_count = 0;

    // Texels of the finest level.
    T* texel_depth = nullptr;                 // far end over the nodes that touch it
    T* block_depth = nullptr;                 // the same over 2 x 2 texels, of which this is the first
    std::uint32_t* texel_levels = nullptr;    // bit l: level l has a node here
    std::uint32_t* texel_lists = nullptr;     // place in `first`: nodes too wide for its divisions, then the divisions
    std::uint32_t* texel_division = nullptr;  // k: it is divided into 2^k x 2^k; in the making, how many nodes touch it

    // For trace: triangles are put in the order of the lists, a block at a time.
    std::uint32_t* caster = nullptr;  // and those behind it, caster_room each
    std::uint32_t* caster_list = nullptr;
    std::uint32_t* caster_order = nullptr;
    std::uint32_t* caster_end = nullptr;  // of each list
    std::uint32_t caster_room = 0;

    // Over all nodes.
    T least_x = T(0), most_x = T(0), least_y = T(0), most_y = T(0), most_depth = T(0), least_w = T(0), most_w = T(0);

    ListCounts counts;
    Faults faults;
};

// Texels along a side of the level.
[[nodiscard]] constexpr int level_size(int map_size, int level) noexcept {
    return ((map_size - 1) >> level_shift * level) + 1;
}

// What is kept of a tile. Its scalars: the q of each pixel less the tile's, q_x, q_y; then the tile's q, near those of
// its pixels, so that the differences are known to far more digits; and for each of the five keys of tile.hpp, where
// its bytes begin and how long a step of theirs is. Its words: four keys of each pixel, a byte each, and the fifth;
// which pixels light may reach that have a sample not yet covered, a bit each; the masks.
inline constexpr int tile_scalars = 64, tile_words = 48;
inline constexpr int tile_q_at = 48, key_base_at = 49, key_step_at = 54;
inline constexpr int alive_at = 20, mask_at = 32;

// Tiles begin where a line of the caches does: what may be left out before the first, in words and in scalars.
inline constexpr std::size_t cache_line = 64;
inline constexpr std::size_t line_slack = cache_line / 4 - 1;

// What a buffer needs for width x height pixels, a grid of map_size^2 texels and `capacity` parts of tiles. Parts are
// one and a half times as many as tiles in ordinary pictures and 16 times as many at most: three times as many are
// taken where capacity is 0. A map_size outside [1, 2^11] is no grid; 64 to 256 is a good one.
[[nodiscard]] constexpr StorageSize storage_for(int width, int height, int map_size, int capacity = 0) noexcept {
    if (width < 1 || height < 1 || map_size < 1 || map_size > largest_grid) return {};
    auto const tiles_along = [](int size) { return static_cast<std::size_t>((size - 1) / tile_side + 1); };
    std::size_t const tiles = tiles_along(width) * tiles_along(height);
    std::size_t const parts = capacity > 0 ? static_cast<std::size_t>(capacity) : 3 * tiles;
    std::size_t const texels = static_cast<std::size_t>(map_size) * static_cast<std::size_t>(map_size);
    std::size_t coarser = 0;
    for (int level = 1, side = map_size; side != 1; ++level) {
        side = level_size(map_size, level);
        coarser += static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
    }
    // Every four nodes that touch a texel pay for a division. As many triangles as pixels are put in order at once.
    std::size_t const nodes = 4 * parts, lists = 2 * texels + coarser + parts + 2;
    return {tile_scalars * tiles + 5 * nodes + 5 * parts + 2 * texels + line_slack,
            tile_words * tiles + nodes + 2 * lists + 3 * texels + 3 * lane_count * tiles + line_slack};
}

namespace detail {

// Places of the pixels in their tile.
template <class T>
inline constexpr T tile_columns[lane_count] = {0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3, 0, 1, 2, 3};
template <class T>
inline constexpr T tile_rows[lane_count] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3};

// The parts of a buffer that only its making sees.
template <class T>
struct Parts {
    T* bounds = nullptr;             // lo x, hi x, lo y, hi y, depth of each
    std::uint32_t* place = nullptr;  // tile and level; first and last place in x, in y, 16 bits each
    std::uint32_t capacity = 0;
};

template <class T>
[[nodiscard]] inline std::size_t scalars_to_line(T const* from) noexcept {
    return (cache_line - reinterpret_cast<std::uintptr_t>(from) % cache_line) % cache_line / sizeof(T);
}

// The arrays of a buffer, cut from what the caller gave. No capacity where not even the tiles fit.
template <class T>
[[nodiscard]] inline Parts<T> lay_out(IrregularBuffer<T>& buffer, Storage<T> const& storage) noexcept {
    Parts<T> parts;
    // What one part more adds: one of its own and four nodes of each array.
    StorageSize const least = storage_for(buffer.rect.width, buffer.rect.height, buffer.map_size, 1);
    if (storage.scalars == nullptr || storage.words == nullptr || storage.size.scalars < least.scalars ||
        storage.size.words < least.words)
        return parts;
    std::size_t const by_scalars = (storage.size.scalars - least.scalars) / 25;
    std::size_t const by_words = (storage.size.words - least.words) / 6;
    std::size_t const capacity = 1 + (by_scalars < by_words ? by_scalars : by_words);
    // There are no more parts than pixels. Nodes are counted with 32 bits, tiles with 28.
    auto const tiles = static_cast<std::size_t>(buffer.tile_count);
    std::size_t const most = lane_count * tiles < 1u << 28 ? lane_count * tiles : 1u << 28;
    parts.capacity = static_cast<std::uint32_t>(capacity < most ? capacity : most);
    auto const texels = static_cast<std::size_t>(buffer.map_size) * static_cast<std::size_t>(buffer.map_size);
    std::size_t const nodes = 4 * std::size_t{parts.capacity};
    buffer.caster_room = static_cast<std::uint32_t>(lane_count * tiles);
    T* scalars = storage.scalars;
    std::uint32_t* words = storage.words;
    auto const take = [](auto*& from, std::size_t count) {
        auto* const taken = from;
        from += count;
        return taken;
    };
    scalars += scalars_to_line(scalars);
    words += scalars_to_line(words);
    buffer.surface = take(scalars, tile_scalars * tiles);
    buffer.bounds = take(scalars, 5 * nodes);
    buffer.texel_depth = take(scalars, texels);
    buffer.block_depth = take(scalars, texels);
    parts.bounds = scalars;
    buffer.state = take(words, tile_words * tiles);
    for (std::uint32_t** array : {&buffer.caster, &buffer.caster_list, &buffer.caster_order})
        *array = take(words, buffer.caster_room);
    buffer.tile = take(words, nodes);
    for (std::uint32_t** array : {&buffer.texel_levels, &buffer.texel_lists, &buffer.texel_division})
        *array = take(words, texels);
    parts.place = buffer.caster;  // there are no casters yet
    buffer.first = take(words, (static_cast<std::size_t>(storage.words + storage.size.words - words)) / 2);
    buffer.caster_end = words;
    std::memset(buffer.texel_levels, 0, texels * sizeof(std::uint32_t));
    std::memset(buffer.texel_division, 0, texels * sizeof(std::uint32_t));
    for (std::size_t texel = 0; texel < texels; ++texel) buffer.texel_depth[texel] = std::numeric_limits<T>::lowest();
    return parts;
}

}  // namespace detail

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/irregular/lists.hpp ========
//
// The lists of the irregular z-buffer: which of them a rectangle of the grid belongs to, and how nodes are sorted into
// them.

namespace shadowmath {
inline namespace v0 {

namespace detail {

// Places in units of the finest division.
struct PlaceRange {
    int x0, x1, y0, y1;
};

// What lies beside the map belongs to its border.
template <class T>
[[nodiscard]] inline int place_of(T coordinate, T last) noexcept {
    T const place = coordinate * T(1 << most_divisions);
    // Written so that NaN ends at 0.
    T const inside = place > T(0) ? place : T(0);
    return static_cast<int>(inside < last ? inside : last);
}

template <class T>
[[nodiscard]] inline PlaceRange places_of(T const* bounds, int map_size) noexcept {
    T const last = T((map_size << most_divisions) - 1);
    return {place_of(bounds[0], last), place_of(bounds[1], last), place_of(bounds[2], last), place_of(bounds[3], last)};
}

[[nodiscard]] inline PlaceRange coarser(PlaceRange const& range, int shift) noexcept {
    return {range.x0 >> shift, range.x1 >> shift, range.y0 >> shift, range.y1 >> shift};
}

// Texels of a level, 0 being the finest.
[[nodiscard]] inline PlaceRange texels_of(PlaceRange const& places, int level) noexcept {
    return coarser(places, most_divisions + level_shift * level);
}

// The divisions of texel (x, y), divided into 2^k x 2^k, that the places touch.
[[nodiscard]] inline PlaceRange divisions_of(PlaceRange const& places, int x, int y, int k) noexcept {
    int const last = (1 << most_divisions) - 1, left = x << most_divisions, top = y << most_divisions;
    return coarser({places.x0 > left ? places.x0 - left : 0, places.x1 < left + last ? places.x1 - left : last,
                    places.y0 > top ? places.y0 - top : 0, places.y1 < top + last ? places.y1 - top : last},
                   most_divisions - k);
}

template <class T>
inline void add_part(IrregularBuffer<T>& buffer, Parts<T> const& parts, int tile, T const (&bounds)[5]) noexcept {
    std::uint32_t const index = buffer.counts.parts++;
    if (index >= parts.capacity) return;
    T const width = bounds[1] - bounds[0], height = bounds[3] - bounds[2];
    T const extent = width > height ? width : height;
    int level = 0;
    while (level + 1 < buffer.level_count && extent > T(1 << level_shift * level)) ++level;
    buffer.levels_used |= 1u << level;
    PlaceRange const places = places_of(bounds, buffer.map_size);
    for (std::uint32_t i = 0; i < 5; ++i) parts.bounds[5 * index + i] = bounds[i];
    std::uint32_t* const place = parts.place + 3 * index;
    place[0] = static_cast<std::uint32_t>(tile) | static_cast<std::uint32_t>(level) << 28;
    place[1] = static_cast<std::uint32_t>(places.x0) | static_cast<std::uint32_t>(places.x1) << 16;
    place[2] = static_cast<std::uint32_t>(places.y0) | static_cast<std::uint32_t>(places.y1) << 16;
    PlaceRange const texels = texels_of(places, 0);
    for (int y = texels.y0; y <= texels.y1; ++y)
        for (int x = texels.x0; x <= texels.x1; ++x) {
            int const texel = y * buffer.map_size + x;
            buffer.texel_levels[texel] |= 1u << level;
            buffer.texel_depth[texel] = bounds[4] > buffer.texel_depth[texel] ? bounds[4] : buffer.texel_depth[texel];
            if (level == 0) ++buffer.texel_division[texel];
        }
}

// Calls list(i) for each list, by its place in `first`, that part of a tile belongs to.
template <class T, class List>
inline void for_each_list(IrregularBuffer<T> const& buffer, std::uint32_t const* place, List const& list) noexcept {
    PlaceRange const places{static_cast<int>(place[1] & 0xffffu), static_cast<int>(place[1] >> 16),
                            static_cast<int>(place[2] & 0xffffu), static_cast<int>(place[2] >> 16)};
    auto const level = static_cast<int>(place[0] >> 28);
    PlaceRange const texels = texels_of(places, level);
    int const size = level_size(buffer.map_size, level);
    for (int y = texels.y0; y <= texels.y1; ++y)
        for (int x = texels.x0; x <= texels.x1; ++x) {
            auto const texel = static_cast<std::uint32_t>(y * size + x);
            if (level > 0) {
                list(buffer.level_first[level] + texel);
                continue;
            }
            auto const k = static_cast<int>(buffer.texel_division[texel]);
            PlaceRange const in = divisions_of(places, x, y, k);
            std::uint32_t const first = buffer.texel_lists[texel];
            if (k == 0) {
                list(first + 1);
                continue;
            }
            // More than four divisions: listed once, for all triangles of the texel.
            if (in.x1 - in.x0 > 1 || in.y1 - in.y0 > 1)
                list(first);
            else
                for (int j = in.y0; j <= in.y1; ++j)
                    for (int i = in.x0; i <= in.x1; ++i) list(first + 1 + static_cast<std::uint32_t>((j << k) + i));
        }
}

// Divides texels: a division for every four nodes at most.
template <class T>
[[nodiscard]] inline std::uint32_t divide_texels(IrregularBuffer<T>& buffer) noexcept {
    std::uint32_t lists = 0;
    auto const texels = static_cast<std::uint32_t>(buffer.map_size * buffer.map_size);
    for (std::uint32_t texel = 0; texel < texels; ++texel) {
        std::uint32_t const nodes = buffer.texel_division[texel];
        std::uint32_t k = 0;
        while (k < most_divisions && (std::uint32_t(64) << 2 * k) <= nodes) ++k;
        buffer.texel_division[texel] = k;
        buffer.texel_lists[texel] = lists;
        lists += 1 + (1u << 2 * k);
    }
    for (int level = 1; level < buffer.level_count; ++level) {
        int const side = level_size(buffer.map_size, level);
        buffer.level_first[level] = lists;
        lists += static_cast<std::uint32_t>(side * side);
    }
    return lists;
}

template <class T>
inline void find_block_depths(IrregularBuffer<T>& buffer) noexcept {
    int const size = buffer.map_size;
    auto const deeper = [](T a, T b) { return a > b ? a : b; };
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            T const* const row = buffer.texel_depth + y * size;
            T const* const next = y + 1 < size ? row + size : row;
            int const right = x + 1 < size ? x + 1 : x;
            buffer.block_depth[y * size + x] = deeper(deeper(row[x], row[right]), deeper(next[x], next[right]));
        }
}

// False where the nodes are more than four for each part that there is room for.
template <class T>
[[nodiscard]] inline bool sort_parts(IrregularBuffer<T>& buffer, Parts<T> const& parts) noexcept {
    std::uint32_t const lists = buffer.list_count = divide_texels(buffer);
    std::memset(buffer.first, 0, (lists + 2) * sizeof(std::uint32_t));
    std::uint32_t* const end = buffer.first + 1;
    ListCounts& counts = buffer.counts;
    for (std::uint32_t i = 0; i < counts.parts; ++i)
        for_each_list(buffer, parts.place + 3 * i, [end](std::uint32_t list) { ++end[list + 1]; });
    for (std::uint32_t list = 1; list <= lists; ++list) {
        std::uint32_t const length = end[list];
        counts.lists += length > 0 ? 1u : 0u;
        counts.longest = length > counts.longest ? length : counts.longest;
        end[list] = counts.nodes += length;
    }
    if (counts.nodes > 4 * parts.capacity) return false;
    find_block_depths(buffer);
    for (std::uint32_t i = 0; i < counts.parts; ++i) {
        T const* const bounds = parts.bounds + 5 * i;
        std::uint32_t const tile = parts.place[3 * i] & 0x0fffffffu;
        for_each_list(buffer, parts.place + 3 * i, [&](std::uint32_t list) {
            std::uint32_t const node = end[list]++;
            std::memcpy(buffer.bounds + 5 * std::size_t{node}, bounds, 5 * sizeof(T));
            buffer.tile[node] = tile;
        });
    }
    return true;
}

}  // namespace detail

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/irregular/tile.hpp ========
//
// A tile of 4 x 4 pixels as the light sees it: the quads of its pixels, their bounds in the grid, and the nodes that it
// is listed by.
//
// The bounds of a pixel are five keys, (lo x, -hi x, lo y, -hi y, -far depth). A caster with the keys (hi x, -lo x,
// hi y, -lo y, -near depth) can take light from it only if none of its keys is less. The pixels' keys are kept in a
// byte each, in steps of a 255th of the tile's range, a step less than they are: more than rounding can add.

namespace shadowmath {
inline namespace v0 {

namespace detail {

// Sixteen pixels of the picture: their quads, whether light may reach them, and where the light sees them.
template <class Lanes, class T = typename Lanes::Scalar>
struct TileKernel {
    IrregularBuffer<T>& buffer;
    Receivers<T> const& receivers;
    PixelPlane<T> plane[4];  // the rows of the map
    T w_min;
    T turn;
    Lanes column_in_tile, row_in_tile;
    bool flat, affine;

    struct Seen {
        std::uint32_t alive = 0;
        std::uint32_t away = 0;
        Lanes lo_x, hi_x, lo_y, hi_y, depth, lo_w, hi_w;
        T bounds[5];  // of all that are alive: lo x, hi x, lo y, hi y, the far end of the depths
    };

    struct Surface {
        Lanes normal[3];
        Lanes place[3];  // relative to the eye; or the depth alone
    };

    // Rows of a tile that lies within the part of the picture, or copies of its edge where it does not.
    void gather(int column, int row, Surface& surface) const noexcept {
        PixelFrame<T> const& frame = buffer.frame;
        auto const normal_stride = static_cast<std::size_t>(receivers.normal_stride);
        auto const position_stride = static_cast<std::size_t>(receivers.position_stride);
        bool const placed = receivers.position != nullptr;
        int const columns = buffer.rect.x + buffer.rect.width - column, rows = buffer.rect.y + buffer.rect.height - row;
        std::size_t at[tile_side];
        for (int j = 0; j < tile_side; ++j)
            at[j] = static_cast<std::size_t>(row + (j < rows ? j : 0)) * static_cast<std::size_t>(frame.width) +
                    static_cast<std::size_t>(column);
        if (columns >= tile_side && normal_stride == 3 && (!placed || position_stride == 3)) {
            // Written out: as a loop it is made a vector of addresses.
            auto const from = [&at](T const* array, std::size_t stride, T const*(&row_of)[tile_side]) {
                row_of[0] = array + at[0] * stride;
                row_of[1] = array + at[1] * stride;
                row_of[2] = array + at[2] * stride;
                row_of[3] = array + at[3] * stride;
            };
            T const* row_of[tile_side];
            from(receivers.normal, 3, row_of);
            Lanes::triples(row_of, surface.normal);
            from(placed ? receivers.position : receivers.depth, placed ? 3 : 1, row_of);
            if (placed)
                Lanes::triples(row_of, surface.place);
            else
                surface.place[0] = Lanes::rows(row_of);
        } else {
            T in[6][lane_count]{};
            for (int k = 0; k < lane_count; ++k) {
                int const i = k % tile_side;
                std::size_t const pixel = at[k / tile_side] + static_cast<std::size_t>(i < columns ? i : 0);
                for (int axis = 0; axis < 3; ++axis) {
                    auto const offset = static_cast<std::size_t>(axis);
                    in[axis][k] = receivers.normal[pixel * normal_stride + offset];
                    if (placed) in[3 + axis][k] = receivers.position[pixel * position_stride + offset];
                }
                if (!placed) in[3][k] = receivers.depth[pixel];
            }
            for (int axis = 0; axis < 3; ++axis) {
                surface.normal[axis] = Lanes::load(in[axis]);
                surface.place[axis] = Lanes::load(in[3 + axis]);
            }
        }
        if (placed)
            for (int axis = 0; axis < 3; ++axis)
                surface.place[axis] = surface.place[axis] - Lanes::all(frame.eye[axis]);
    }

    [[nodiscard]] static T middle_of(std::uint32_t part, Lanes const& q) noexcept {
        if (part == 0) return T(0);
        T lane[lane_count];
        q.store(lane);
        return lane[lowest_bit(part)];
    }

    [[nodiscard]] static std::uint32_t lanes_inside(int columns, int rows) noexcept {
        std::uint32_t const in_row = columns < tile_side ? (1u << columns) - 1u : 0xfu;
        std::uint32_t inside = 0;
        for (int j = 0; j < tile_side && j < rows; ++j) inside |= in_row << tile_side * j;
        return inside;
    }

    // The quads of sixteen pixels (micro_quad, of which these are the lanes): q + q_x x + q_y y at the corner of a
    // pixel, which is one over the depth, or the depth itself where the eye is flat.
    struct Quads {
        Lanes x, y;  // of the lower corners, pixels from the middle of the picture
        Lanes normal_x, normal_y, normal_z;
        Lanes toward_middle, facing, depth;
        Lanes middle, to_corner, q, q_x, q_y;
        std::uint32_t sound;  // numbers, in the picture

        [[nodiscard]] Lanes size() const noexcept { return absolute(q) + absolute(q_x) + absolute(q_y); }
    };
    [[nodiscard]] Quads quads_of(Surface const& surface, int column, int row) const noexcept {
        PixelFrame<T> const& frame = buffer.frame;
        auto const all = [](T value) { return Lanes::all(value); };
        Lanes const zero = all(T(0)), one = all(T(1)), half = all(T(0.5)), tiny = all(std::numeric_limits<T>::min());
        Quads quads;
        quads.x = all(T(column) - T(frame.width) / T(2)) + column_in_tile;
        quads.y = all(T(row) - T(frame.height) / T(2)) + row_in_tile;
        auto const dot = [&all](Vec3<T> const& v, Lanes const(&a)[3]) {
            return fused(all(v.x), a[0], fused(all(v.y), a[1], all(v.z) * a[2]));
        };
        Lanes const depth = quads.depth =
            receivers.position != nullptr ? dot(frame.to_inward, surface.place) : surface.place[0];
        Lanes const nx = quads.normal_x = dot(frame.across, surface.normal);
        Lanes const ny = quads.normal_y = dot(frame.upward, surface.normal);
        Lanes const nz = quads.normal_z = dot(frame.inward, surface.normal);
        quads.toward_middle = flat ? nz : fused(nx, quads.x + half, fused(ny, quads.y + half, nz));
        Lanes const facing = quads.facing = flat ? zero - nz : quads.toward_middle;
        Lanes const steep = (absolute(nx) + absolute(ny)) * all(turn);
        Lanes const divisor = with_sign_of(most(absolute(facing), steep), facing);
        // A comparison with NaN is false.
        std::uint32_t sound = at_least(absolute(divisor), tiny);
        if (!flat) sound &= at_least(depth, tiny);
        Lanes const scale = one / chosen(sound, flat ? divisor : divisor * depth, one);
        quads.q_x = nx * scale, quads.q_y = ny * scale;
        quads.middle = flat ? depth : divisor * scale, quads.to_corner = (quads.q_x + quads.q_y) * half;
        quads.q = quads.middle - quads.to_corner;
        sound &= at_least(all(std::numeric_limits<T>::max()), quads.size());
        sound &= lanes_inside(buffer.rect.x + buffer.rect.width - column, buffer.rect.y + buffer.rect.height - row);
        quads.sound = sound;
        return quads;
    }

    // Those whose surface has light and eye on the same side.
    [[nodiscard]] std::uint32_t facing_light(Quads const& quads) const noexcept {
        auto const all = [](T value) { return Lanes::all(value); };
        Lanes const half = all(T(0.5)), tiny = all(std::numeric_limits<T>::min()), under = all(T(0)) - tiny;
        Lanes const &nx = quads.normal_x, &ny = quads.normal_y, &nz = quads.normal_z;
        Lanes travel =
            fused(nx, all(buffer.light.at.x), fused(ny, all(buffer.light.at.y), nz * all(buffer.light.at.z)));
        if (!buffer.light.parallel)
            travel = (flat ? fused(nx, quads.x + half, fused(ny, quads.y + half, nz * quads.depth))
                           : quads.depth * quads.facing) -
                     travel;
        return (at_least(travel, tiny) & at_least(quads.toward_middle, tiny)) |
               (at_least(under, travel) & at_least(under, quads.toward_middle));
    }

    // What the four corners of each quad cover as the light sees them, and more by what rounding may add, so that no
    // triangle misses a texel. Those of `among` of which that can be said are alive.
    void cover(Quads const& quads, std::uint32_t among, Seen& seen) const noexcept {
        auto const all = [](T value) { return Lanes::all(value); };
        Lanes const one = all(T(1)), tiny = all(std::numeric_limits<T>::min());
        // Before an eye of perspective, values are over the depth.
        Lanes at[4], gain_x[4], gain_y[4];
        for (int i = 0; i < 4; ++i) {
            PixelPlane<T> const& p = plane[i];
            at[i] = fused(all(p.x), quads.x, fused(all(p.y), quads.y, fused(all(p.b), quads.q, all(p.a))));
            gain_x[i] = fused(all(p.b), quads.q_x, all(p.x));
            gain_y[i] = fused(all(p.b), quads.q_y, all(p.y));
        }
        Lanes steepest = all(T(0));
        for (int corner = 0; corner < 4; ++corner) {
            Lanes value[4], q_here = quads.q;
            for (int i = 0; i < 4; ++i) {
                value[i] = (corner & 1) != 0 ? at[i] + gain_x[i] : at[i];
                if ((corner & 2) != 0) value[i] = value[i] + gain_y[i];
            }
            if ((corner & 1) != 0) q_here = q_here + quads.q_x;
            if ((corner & 2) != 0) q_here = q_here + quads.q_y;
            among &= at_least(value[3], tiny) & ~at_least(flat ? all(w_min) : all(w_min) * q_here, value[3]);
            Lanes const inverse = reciprocal(chosen(among, value[3], one));
            Lanes const tx = value[0] * inverse, ty = value[1] * inverse, tz = value[2] * inverse;
            Lanes const w = affine ? one : flat ? value[3] : value[3] * reciprocal(chosen(among, q_here, one));
            seen.lo_x = corner == 0 ? tx : least(seen.lo_x, tx);
            seen.hi_x = corner == 0 ? tx : most(seen.hi_x, tx);
            seen.lo_y = corner == 0 ? ty : least(seen.lo_y, ty);
            seen.hi_y = corner == 0 ? ty : most(seen.hi_y, ty);
            seen.depth = corner == 0 ? tz : most(seen.depth, tz);
            seen.lo_w = corner == 0 ? w : least(seen.lo_w, w);
            seen.hi_w = corner == 0 ? w : most(seen.hi_w, w);
            steepest = most(steepest, inverse);
        }
        Lanes const ray = all(buffer.contact_ray);
        Lanes const reach = flat ? all(buffer.contact_reach) + quads.size() : ray;
        Lanes const here = flat ? one : quads.size();
        auto const error = [&](T each_metre, T anywhere) {
            return steepest * fused(reach, all(each_metre), here * all(anywhere));
        };
        Lanes const pad = error(buffer.texel_error, buffer.texel_error_here) + all(T(1) / T(128));
        seen.lo_x = seen.lo_x - pad;
        seen.hi_x = seen.hi_x + pad;
        seen.lo_y = seen.lo_y - pad;
        seen.hi_y = seen.hi_y + pad;
        seen.depth = seen.depth + error(buffer.depth_error, buffer.depth_error_here);
        Lanes const span = absolute(seen.lo_x) + absolute(seen.hi_x) + absolute(seen.lo_y) + absolute(seen.hi_y);
        seen.alive = among & at_least(all(std::numeric_limits<T>::max()), span + absolute(seen.depth));
    }

    void see(int tile, int column, int row, Seen& seen) const noexcept {
        seen.alive = seen.away = 0;
        Surface surface;
        gather(column, row, surface);
        Quads const quads = quads_of(surface, column, row);
        if (quads.sound == 0) return;
        std::uint32_t const lit = facing_light(quads);
        seen.away = quads.sound & ~lit;
        if ((quads.sound & lit) == 0) return;
        cover(quads, quads.sound & lit, seen);
        keep_bounds(tile, seen);
        keep_quads(tile, quads, seen.alive);
    }

    void keep_quads(int tile, Quads const& quads, std::uint32_t alive) const noexcept {
        Lanes const zero = Lanes::all(T(0)), one = Lanes::all(T(1));
        T* const kept = buffer.surface + tile_scalars * static_cast<std::size_t>(tile);
        T const tile_q = kept[tile_q_at] = middle_of(alive, quads.q);
        // The division once more, without its rounding.
        T rest[lane_count];
        (flat ? quads.middle : chosen(alive, quads.depth, one)).store(rest);
        for (T& r : rest) r = static_cast<T>((flat ? Wider<T>(r) : Wider<T>(1) / Wider<T>(r)) - Wider<T>(tile_q));
        Lanes const exact = Lanes::load(rest);
        chosen(alive, exact - quads.to_corner, zero).store(kept);
        chosen(alive, quads.q_x, zero).store(kept + lane_count);
        chosen(alive, quads.q_y, zero).store(kept + 2 * lane_count);
    }

    void keep_bounds(int tile, Seen& seen) const noexcept {
        Lanes const zero = Lanes::all(T(0)), huge = Lanes::all(std::numeric_limits<T>::max());
        Lanes const keys[5] = {seen.lo_x, zero - seen.hi_x, seen.lo_y, zero - seen.hi_y, zero - seen.depth};
        T* const base = buffer.surface + tile_scalars * static_cast<std::size_t>(tile) + key_base_at;
        T* const step = base + (key_step_at - key_base_at);
        auto* const bytes =
            reinterpret_cast<unsigned char*>(buffer.state + tile_words * static_cast<std::size_t>(tile));
        for (int i = 0; i < 5; ++i) {
            base[i] = smallest(chosen(seen.alive, keys[i], huge));
            T const span = largest(chosen(seen.alive, keys[i], zero - huge)) - base[i];
            seen.bounds[i] = i == 0 || i == 2 ? base[i] : -base[i];
            // No range to speak of: all are as the least of them.
            bool const ranged = span > std::abs(base[i]) * (T(1) / T(1 << 14)) && span > T(1e-30) && span < T(1e30);
            step[i] = ranged ? span / T(255) : T(0);
            Lanes const gain = Lanes::all(ranged ? T(255) / span : T(0));
            Lanes const steps = (keys[i] - Lanes::all(base[i])) * gain - Lanes::all(T(1));
            chosen(ranged ? seen.alive : 0u, steps, zero).store_bytes(bytes + i * lane_count);
        }
    }

    // The pixels of `part` as one node, or as several if they lie far apart for what each of them covers.
    void insert(Parts<T> const& parts, int tile, Seen const& seen, std::uint32_t part,
                int pixels_across) const noexcept {
        if (part == 0) return;
        Lanes const huge = Lanes::all(std::numeric_limits<T>::max());
        Lanes const low = Lanes::all(std::numeric_limits<T>::lowest());
        T const bounds[5] = {smallest(chosen(part, seen.lo_x, huge)), largest(chosen(part, seen.hi_x, low)),
                             smallest(chosen(part, seen.lo_y, huge)), largest(chosen(part, seen.hi_y, low)),
                             largest(chosen(part, seen.depth, low))};
        insert(parts, tile, seen, part, pixels_across, bounds);
    }

    void insert(Parts<T> const& parts, int tile, Seen const& seen, std::uint32_t part, int pixels_across,
                T const (&bounds)[5]) const noexcept {
        if (pixels_across > 1) {
            T const width = bounds[1] - bounds[0], height = bounds[3] - bounds[2];
            T const extent = width > height ? width : height;
            if (extent > T(1)) {
                Lanes const low = Lanes::all(std::numeric_limits<T>::lowest());
                Lanes const each = most(seen.hi_x - seen.lo_x, seen.hi_y - seen.lo_y);
                if (extent > largest(chosen(part, each, low)) * T(2 * pixels_across)) {
                    if (pixels_across == tile_side)
                        for (std::uint32_t const quarter : {0x0033u, 0x00ccu, 0x3300u, 0xcc00u})
                            insert(parts, tile, seen, part & quarter, 2);
                    else
                        for (; part != 0; part &= part - 1) insert(parts, tile, seen, part & (~part + 1), 1);
                    return;
                }
            }
        }
        IrregularBuffer<T>& b = buffer;
        b.least_x = bounds[0] < b.least_x ? bounds[0] : b.least_x;
        b.most_x = bounds[1] > b.most_x ? bounds[1] : b.most_x;
        b.least_y = bounds[2] < b.least_y ? bounds[2] : b.least_y;
        b.most_y = bounds[3] > b.most_y ? bounds[3] : b.most_y;
        b.most_depth = bounds[4] > b.most_depth ? bounds[4] : b.most_depth;
        add_part(buffer, parts, tile, bounds);
    }
};

}  // namespace detail

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/irregular/grid.hpp ========
//
// The irregular z-buffer: the receivers of a picture, sorted by where the light sees them. Any matrix of this library
// may be the grid. It decides how long the lists are, and so the speed; the answer is the same for all.
//
// A node is a tile of 4 x 4 pixels, or a part of one where the tile straddles a silhouette, with bounds as the light
// sees it. Each is listed in every texel that its footprint touches. Texels where nodes are crowded are divided, up to
// 32 x 32, and footprints larger than a texel are listed in grids of larger ones: however the picture and the map
// differ in scale, lists are short and a node is in few of them. A counting sort lays the lists of a row end to end, in
// the order of the picture; so what a triangle may cover is one run a row.
//
// No memory is taken: the caller hands over two arrays, and storage_for says how long they must be. Rows of a picture
// can be split over several buffers, one a thread, that share nothing.
//
// Source: Johnson et al., TOG 24(4) 2005; Wyman, Hoetzlein and Lefohn, TVCG 22(10) 2016. Theirs lists pixels; tiles of
// sixteen, levels and bounds in the nodes are ours.

namespace shadowmath {
inline namespace v0 {

namespace detail {

// The map's rows for points relative to the eye, x and y in texels; and what rounding may add to them.
template <class T>
inline bool take_map(IrregularBuffer<T>& buffer, ShadowMap<T> const& map, Light<T> const& light) noexcept {
    if (!all_finite(map.clip_from_world) || !all_finite(&map.w_min, 1)) return false;
    Mat4<T> const canonical = canonical_from_clip<T>(map.clip) * map.clip_from_world;
    Vec4<T> const source = homogeneous(light);
    T scale[4];
    for (int i = 0; i < 4; ++i) {
        Vec4<T> const r = row(canonical, i);
        // Axes are made orthogonal to a rounding of their lengths, however small the products of their coordinates are.
        scale[i] = largest_of(Vec3<T>(r)) * largest_of(Vec3<T>(source)) + std::abs(r.w * source.w);
    }
    // The law of shadow maps. Matrices come from products of a few others: 2^8 roundings are allowed for.
    Vec4<T> const image = canonical * source;
    T const slack = T(256) * std::numeric_limits<T>::epsilon();
    for (int i : {0, 1, 3})
        if (!(std::abs(image[i]) <= slack * (scale[i] + scale[3]))) return false;
    if (!(image.z > T(0))) return false;

    T const texels = T(buffer.map_size) / T(2);
    Vec4<T> const w = row(canonical, 3);
    Vec4<T> const rows[4] = {(row(canonical, 0) + w) * texels, (row(canonical, 1) + w) * texels, row(canonical, 2), w};
    // A coordinate is a sum of four products, and the quotient of two such sums.
    T const eps = T(16) * std::numeric_limits<T>::epsilon();
    T steep[4], here[4];
    for (int i = 0; i < 4; ++i) {
        Vec3<T> const axis(rows[i]);
        buffer.row[i] = Vec4<T>(axis, glm::dot(axis, buffer.frame.eye) + rows[i].w);
        if (!all_finite(buffer.row[i])) return false;
        steep[i] = eps * (std::abs(axis.x) + std::abs(axis.y) + std::abs(axis.z));
        here[i] = eps * std::abs(buffer.row[i].w);
    }
    buffer.texel_error = (steep[0] > steep[1] ? steep[0] : steep[1]) + steep[3] * T(buffer.map_size);
    buffer.texel_error_here = (here[0] > here[1] ? here[0] : here[1]) + here[3] * T(buffer.map_size);
    buffer.depth_error = steep[2] + steep[3];
    buffer.depth_error_here = here[2] + here[3];
    return true;
}

template <class T>
[[nodiscard]] inline PixelPlane<T> plane_of_row(PixelFrame<T> const& frame, Vec4<T> const& row) noexcept {
    Vec3<T> const axis(row);
    T const offset =
        row.w + glm::dot(axis, frame.across) * frame.origin.x + glm::dot(axis, frame.upward) * frame.origin.y;
    return pixel_plane(frame.kind, normal_in_pixels(frame, axis), offset);
}

// What tracing needs of the picture, the light and the grid, before any receiver is seen. False where the grid is not a
// map of the light.
template <class T>
inline bool take_view(IrregularBuffer<T>& buffer, Light<T> const& light, ShadowMap<T> const& grid) noexcept {
    PixelFrame<T> const& frame = buffer.frame;
    buffer.light = pixel_light(frame, light);
    buffer.source.kind = light.kind;
    buffer.source.direction = Vec3<Wider<T>>(light.direction);
    buffer.source.position = Vec3<Wider<T>>(light.position);
    buffer.contact_ray = glm::length(frame.across) * T(frame.width) + glm::length(frame.upward) * T(frame.height) +
                         glm::length(frame.inward);
    buffer.contact_reach = T(2) * (std::abs(frame.eye.x) + std::abs(frame.eye.y) + std::abs(frame.eye.z));
    if (frame.kind == ViewKind::orthographic) {
        buffer.contact_reach += buffer.contact_ray + glm::length(frame.across) * std::abs(frame.origin.x) +
                                glm::length(frame.upward) * std::abs(frame.origin.y);
        buffer.contact_ray = T(1);
    }
    return take_map(buffer, grid, light);
}

}  // namespace detail

// Lists what the light may reach of a part of the picture. Pixels that the map does not hold, for its w_min or behind
// it, stay lit; the rest of its frame does not matter. Those that face away from the light are dark in all samples.
//
// Faults leave everything lit: not_finite, zero_light, those of the view, bad_projection where the matrix is not a map
// of this light, map_too_small for a grid outside [1, 2^11], bad_region, and storage_too_small, where counts.parts says
// what capacity would do.
template <class T, class Lanes = BestLanes<T>>
[[nodiscard]] inline IrregularBuffer<T> list_receivers(PixelFrame<T> const& frame, Receivers<T> const& receivers,
                                                       Light<T> const& light, ShadowMap<T> const& grid, int map_size,
                                                       Storage<T> const& storage, PixelRect rect = {}) noexcept {
    SHADOWMATH_ASSERT(receivers.normal != nullptr && (receivers.position != nullptr || receivers.depth != nullptr),
                      "receivers need a normal, and a position or a depth");
    IrregularBuffer<T> buffer;
    buffer.frame = frame;
    buffer.faults = frame.faults | faults_of(light);
    buffer.map_size = map_size;
    if (rect.width < 1) rect.width = frame.width - rect.x;
    if (rect.height < 1) rect.height = frame.height - rect.y;
    bool const inside = rect.x >= 0 && rect.y >= 0 && rect.width > 0 && rect.height > 0 &&
                        rect.x <= frame.width - rect.width && rect.y <= frame.height - rect.height;
    if (map_size < 1 || map_size > largest_grid) buffer.faults |= Fault::map_too_small;
    if (!inside) buffer.faults |= Fault::bad_region;
    if (inside) buffer.rect = rect;
    if (frame.faults.any() || unusable(light) || !inside || buffer.faults.has(Fault::map_too_small)) return buffer;
    if (!detail::take_view(buffer, light, grid)) {
        buffer.faults |= Fault::bad_projection;
        return buffer;
    }
    bool const flat = frame.kind == ViewKind::orthographic;
    buffer.tiles_across = (rect.width - 1) / tile_side + 1;
    buffer.tile_count = buffer.tiles_across * ((rect.height - 1) / tile_side + 1);
    for (int side = 0; side != 1;) side = level_size(map_size, buffer.level_count++);
    detail::Parts<T> const parts = detail::lay_out(buffer, storage);
    if (parts.capacity == 0) {
        buffer.faults |= Fault::storage_too_small;
        buffer.tile_count = 0;
        return buffer;
    }
    T const largest_number = std::numeric_limits<T>::max();
    buffer.least_x = buffer.least_y = largest_number;
    buffer.most_x = buffer.most_y = buffer.most_depth = -largest_number;

    Vec4<T> const* const row = buffer.row;
    detail::TileKernel<Lanes> const kernel{buffer,
                                           receivers,
                                           {detail::plane_of_row(frame, row[0]), detail::plane_of_row(frame, row[1]),
                                            detail::plane_of_row(frame, row[2]), detail::plane_of_row(frame, row[3])},
                                           grid.w_min > T(0) ? grid.w_min : T(0),
                                           detail::turn_limit(frame),
                                           Lanes::load(detail::tile_columns<T>),
                                           Lanes::load(detail::tile_rows<T>),
                                           flat,
                                           Vec3<T>(row[3]) == Vec3<T>(T(0)) && row[3].w == T(1)};
    Lanes const huge = Lanes::all(largest_number), low = Lanes::all(-largest_number);
    Lanes least_w = huge, most_w = low;
    typename detail::TileKernel<Lanes>::Seen seen;
    for (int tile = 0; tile < buffer.tile_count; ++tile) {
        kernel.see(tile, rect.x + tile % buffer.tiles_across * tile_side,
                   rect.y + tile / buffer.tiles_across * tile_side, seen);
        std::uint32_t* const state = buffer.state + tile_words * static_cast<std::size_t>(tile);
        for (unsigned k = 0; k < lane_count; ++k) state[mask_at + k] = 0u - (seen.away >> k & 1u);
        state[alive_at] = seen.alive;
        if (seen.alive == 0) continue;
        ++buffer.counts.tiles;
        least_w = least(least_w, chosen(seen.alive, seen.lo_w, huge));
        most_w = most(most_w, chosen(seen.alive, seen.hi_w, low));
        kernel.insert(parts, tile, seen, seen.alive, tile_side, seen.bounds);
    }
    buffer.least_w = smallest(least_w);
    buffer.most_w = largest(most_w);
    if (buffer.counts.parts > parts.capacity || !detail::sort_parts(buffer, parts)) {
        buffer.faults |= Fault::storage_too_small;
        if (buffer.counts.parts < (buffer.counts.nodes + 3) / 4) buffer.counts.parts = (buffer.counts.nodes + 3) / 4;
        buffer.tile_count = 0;
        buffer.levels_used = 0;
    }
    return buffer;
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/irregular/casters.hpp ========
//
// Triangles that take light, sixteen at once: where they are in the grid, which of them reach a receiver, and their
// shadow volumes.

namespace shadowmath {
inline namespace v0 {

// Triangles: three indices each, or three vertices each where there are none.
template <class T>
struct Casters {
    T const* position = nullptr;  // world; three scalars a vertex, `stride` apart
    int stride = 3;
    std::uint32_t vertex_count = 0;
    std::uint32_t const* index = nullptr;
    std::uint32_t triangle_count = 0;
};

// The surface of a receiver is trusted to one part in 2^20 of the coordinates: what a G-buffer in float is worth.
template <class T>
inline constexpr T contact_share = T(1) / T(1 << 20);

namespace detail {

// Vertices beyond are no scene; below, products of three of them stay within a float.
template <class T>
inline constexpr T farthest_vertex = T(1e9);

// Sixteen triangles: where they are, what they may cover of the grid, and, if asked for, their shadow volumes.
template <class Lanes, class T = typename Lanes::Scalar>
struct CasterBatch {
    std::uint32_t sound;               // bit k: triangle k may take light from a receiver
    T vertex[3][3][lane_count];        // world
    T bounds[4][lane_count];           // lo x, hi x, lo y, hi y in texels
    T depth[lane_count];               // the end nearest to the light
    Wider<T> plane[4][4][lane_count];  // x, y, a, b of each of the four half spaces
    Lanes reach;                       // metres from the eye, at most
};

template <class Lanes, class T = typename Lanes::Scalar>
struct CasterKernel {
    IrregularBuffer<T> const& buffer;
    Casters<T> const& casters;
    PixelFrame<Wider<T>> const& frame;
    PixelLight<Wider<T>> light;
    T w_floor;

    using Wide = typename Lanes::Wide;
    using Real = Wider<T>;
    using Batch = CasterBatch<Lanes>;

    // The bounds of the part of a triangle at w >= w_floor: no receiver is in the shadow of the rest.
    [[nodiscard]] bool clip(T const (&at)[3][4], T (&bounds)[4]) const noexcept {
        T const largest_number = std::numeric_limits<T>::max();
        bounds[0] = bounds[2] = largest_number;
        bounds[1] = bounds[3] = -largest_number;
        auto const add = [&bounds](T x, T y) {
            bounds[0] = x < bounds[0] ? x : bounds[0];
            bounds[1] = x > bounds[1] ? x : bounds[1];
            bounds[2] = y < bounds[2] ? y : bounds[2];
            bounds[3] = y > bounds[3] ? y : bounds[3];
        };
        bool any = false;
        for (int i = 0; i < 3; ++i) {
            T const *const a = at[i], *const b = at[(i + 1) % 3];
            T const above = a[3] - w_floor, other = b[3] - w_floor;
            if (above >= T(0)) {
                add(a[0] / a[3], a[1] / a[3]);
                any = true;
            }
            if ((above >= T(0)) == (other >= T(0))) continue;
            T const t = above / (above - other);
            add((a[0] + (b[0] - a[0]) * t) / w_floor, (a[1] + (b[1] - a[1]) * t) / w_floor);
        }
        return any;
    }

    // Of triangles without indices; where there are some, neighbours share their vertices anyway.
    void fetch(std::uint32_t triangle) const noexcept {
        if (casters.index != nullptr) return;
        T const* const from = casters.position + std::size_t{3} * triangle * static_cast<std::size_t>(casters.stride);
        fetch_soon(from);
        fetch_soon(from + 8);
    }

    // `order` gives the triangles, or they follow each other from `begin` on.
    void load(std::uint32_t begin, std::uint32_t count, std::uint32_t const* order, Batch& batch) const noexcept {
        auto const stride = static_cast<std::size_t>(casters.stride);
        auto const keep = [&batch](int i, auto const& at) {
            Lanes xyz[3];
            Lanes::points(at, xyz);
            for (int axis = 0; axis < 3; ++axis) xyz[axis].store(batch.vertex[i][axis]);
        };
        std::uint32_t sound = 0;
        T const* at[3][lane_count];
        for (std::uint32_t k = 0; k < lane_count; ++k) {
            bool ok = k < count;
            std::size_t const first = std::size_t{3} * (!ok ? 0u : order != nullptr ? order[begin + k] : begin + k);
            if (casters.index == nullptr) {
                ok = ok && first + 2 < casters.vertex_count;
                at[0][k] = casters.position + (ok ? first * stride : 0);
            } else {
                for (std::uint32_t i = 0; i < 3; ++i) {
                    std::size_t const vertex = casters.index[first + i];
                    bool const held = vertex < casters.vertex_count;
                    ok = ok && held;
                    at[i][k] = casters.position + (held ? vertex * stride : 0);
                }
            }
            sound |= (ok ? 1u : 0u) << k;
        }
        batch.sound = sound;
        for (int i = 0; i < 3; ++i) {
            if (casters.index != nullptr)
                keep(i, [&](int k) { return at[i][k]; });
            else
                // Fewer than three vertices in all: the first, three times.
                keep(i, [&at, step = casters.vertex_count < 3 ? 0 : static_cast<std::size_t>(i) * stride](int k) {
                    return at[0][k] + step;
                });
        }
        find(batch);
    }

    // Bounds in the grid, and which of the sixteen reach a receiver's.
    void find(Batch& batch) const noexcept {
        auto const all = [](T value) { return Lanes::all(value); };
        Lanes const largest_number = all(std::numeric_limits<T>::max()),
                    lowest_number = all(std::numeric_limits<T>::lowest());
        Lanes at[3][4];
        Lanes least_w = largest_number, most_w = lowest_number;
        std::uint32_t sound = batch.sound;
        batch.reach = all(T(0));
        for (int i = 0; i < 3; ++i) {
            Vec3<T> const& eye = buffer.frame.eye;
            Lanes const x = Lanes::load(batch.vertex[i][0]) - all(eye.x),
                        y = Lanes::load(batch.vertex[i][1]) - all(eye.y),
                        z = Lanes::load(batch.vertex[i][2]) - all(eye.z);
            Lanes const away = absolute(x) + absolute(y) + absolute(z);
            sound &= at_least(all(farthest_vertex<T>), away);
            batch.reach = most(batch.reach, away);
            for (int r = 0; r < 4; ++r) {
                Vec4<T> const& row = buffer.row[r];
                at[i][r] = fused(all(row.x), x, fused(all(row.y), y, fused(all(row.z), z, all(row.w))));
            }
            least_w = least(least_w, at[i][3]);
            most_w = most(most_w, at[i][3]);
        }
        Lanes const floor = all(w_floor);
        sound &= at_least(most_w, floor);
        Lanes lo_x = largest_number, hi_x = lowest_number, lo_y = lo_x, hi_y = hi_x, depth = lo_x;
        for (int i = 0; i < 3; ++i) {
            Lanes const inverse = reciprocal(most(at[i][3], floor));
            Lanes const x = at[i][0] * inverse, y = at[i][1] * inverse;
            lo_x = least(lo_x, x);
            hi_x = most(hi_x, x);
            lo_y = least(lo_y, y);
            hi_y = most(hi_y, y);
            depth = least(depth, at[i][2] * inverse);
        }
        std::uint32_t const clipped_ones = sound & ~at_least(least_w, floor);
        if (clipped_ones != 0) {
            // A few triangles in a warped map, and those beside a lamp. Their depths would have to be clipped as well.
            T rows[3][4][lane_count], clipped[4][lane_count];
            for (int i = 0; i < 3; ++i)
                for (int r = 0; r < 4; ++r) at[i][r].store(rows[i][r]);
            depth = chosen(clipped_ones, lowest_number, depth);
            lo_x.store(clipped[0]);
            hi_x.store(clipped[1]);
            lo_y.store(clipped[2]);
            hi_y.store(clipped[3]);
            for (std::uint32_t crossing = clipped_ones; crossing != 0; crossing &= crossing - 1) {
                int const k = lowest_bit(crossing);
                T one[3][4], bounds[4];
                for (int i = 0; i < 3; ++i)
                    for (int r = 0; r < 4; ++r) one[i][r] = rows[i][r][k];
                if (!clip(one, bounds)) sound &= ~(1u << k);
                for (int i = 0; i < 4; ++i) clipped[i][k] = bounds[i];
            }
            lo_x = Lanes::load(clipped[0]);
            hi_x = Lanes::load(clipped[1]);
            lo_y = Lanes::load(clipped[2]);
            hi_y = Lanes::load(clipped[3]);
        }
        // What rounding may add, so that no texel is missed.
        Lanes const steepest = reciprocal(most(least_w, floor));
        Lanes const pad = fused(steepest, fused(batch.reach, all(buffer.texel_error), all(buffer.texel_error_here)),
                                all(T(1) / T(128)));
        lo_x = lo_x - pad;
        hi_x = hi_x + pad;
        lo_y = lo_y - pad;
        hi_y = hi_y + pad;
        depth = depth - steepest * fused(batch.reach, all(buffer.depth_error), all(buffer.depth_error_here));
        sound &= at_least(all(buffer.most_x), lo_x) & at_least(hi_x, all(buffer.least_x)) &
                 at_least(all(buffer.most_y), lo_y) & at_least(hi_y, all(buffer.least_y)) &
                 at_least(all(buffer.most_depth), depth);
        lo_x.store(batch.bounds[0]);
        hi_x.store(batch.bounds[1]);
        lo_y.store(batch.bounds[2]);
        hi_y.store(batch.bounds[3]);
        depth.store(batch.depth);
        batch.sound = sound;
    }

    void raise_volumes(Batch& batch) const noexcept {
        auto const all = [](Real value) { return Wide::all(value); };
        Triple<Wide> p[3];
        for (int i = 0; i < 3; ++i) {
            auto const from_eye = [&](int axis) { return Wide::load(batch.vertex[i][axis]) - all(frame.eye[axis]); };
            Triple<Wide> const v{from_eye(0), from_eye(1), from_eye(2)};
            auto const along = [&](Vec3<Real> const& axis) {
                return inner(Triple<Wide>{all(axis.x), all(axis.y), all(axis.z)}, v);
            };
            p[i] = {along(frame.to_across) - all(frame.origin.x), along(frame.to_upward) - all(frame.origin.y),
                    along(frame.to_inward)};
        }
        T reach[lane_count];
        batch.reach.store(reach);
        Real const share = contact_share<Real>;
        Wide const metres = all(share) * (Wide::load(reach) + all(Real(1) + Real(buffer.contact_reach)));
        ShadowVolume<Wide> const volume = volume_of(frame, light, p, metres, share * Real(buffer.contact_ray), all);
        for (int i = 0; i < 4; ++i) {
            volume.planes[i].x.store(batch.plane[0][i]);
            volume.planes[i].y.store(batch.plane[1][i]);
            volume.planes[i].a.store(batch.plane[2][i]);
            volume.planes[i].b.store(batch.plane[3][i]);
        }
        batch.sound &= at_least(absolute(volume.along), all(Real(std::numeric_limits<T>::min())));
    }
};

}  // namespace detail

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/irregular/chunk.hpp ========
//
// Triangles that are next to each other in the grid, raised to shadow volumes and searched sixteen at once: a cell of
// the grid takes those that reach it, and a node of its list takes those that may darken its tile.

namespace shadowmath {
inline namespace v0 {

namespace detail {

inline constexpr std::uint32_t chunk_room = 192;

// What a tile needs of a triangle.
template <class T>
struct RaisedTriangle {
    Wider<T> x[4], y[4], a[4], b[4];  // of each of the four half spaces
    T across[4], upward[4], by_q[4];  // x, y and b once more
    T keys[5];                        // see tile.hpp
};

// Bounds in lanes. What is behind the last, up to sixteen, may be anything.
template <class Lanes, class T = typename Lanes::Scalar>
struct CasterBounds {
    T lo_x[chunk_room + lane_count], hi_x[chunk_room + lane_count];
    T lo_y[chunk_room + lane_count], hi_y[chunk_room + lane_count];
    T depth[chunk_room + lane_count];  // the end nearest to the light
    std::uint32_t slot[chunk_room + lane_count];
    std::uint32_t count = 0;

    // Bit k: the one at `from` + k is there.
    [[nodiscard]] std::uint32_t there(std::uint32_t from) const noexcept {
        return count - from < lane_count ? (1u << (count - from)) - 1u : (1u << lane_count) - 1u;
    }
    // Those that may touch the rectangle, no farther from the light than `far_end`.
    [[nodiscard]] std::uint32_t touching(std::uint32_t from, Lanes const& x0, Lanes const& x1, Lanes const& y0,
                                         Lanes const& y1, Lanes const& far_end) const noexcept {
        return at_least(Lanes::load(hi_x + from), x0) & at_least(x1, Lanes::load(lo_x + from)) &
               at_least(Lanes::load(hi_y + from), y0) & at_least(y1, Lanes::load(lo_y + from)) &
               at_least(far_end, Lanes::load(depth + from));
    }
};

// A rectangle of the grid in texels; those at its border go on without end.
template <class T>
struct Cell {
    T x0, x1, y0, y1;
};

// Cell (x, y) of cells that are 2^shift places wide.
template <class T>
[[nodiscard]] inline Cell<T> cell_at(int x, int y, int shift, int map_size) noexcept {
    auto const edge = [shift, last = map_size << most_divisions](int cell) {
        int const place = cell << shift;
        if (place <= 0) return std::numeric_limits<T>::lowest();
        return place < last ? T(place) * (T(1) / T(1 << most_divisions)) : std::numeric_limits<T>::max();
    };
    return {edge(x), edge(x + 1), edge(y), edge(y + 1)};
}

// The triangles of a chunk that reach a cell. A pair of a triangle and a node is met in every cell that both touch; it
// counts in that where the rectangle they share begins.
template <class Lanes, class T = typename Lanes::Scalar>
struct CellCasters {
    CasterBounds<Lanes> bounds;
    std::uint32_t any[chunk_room / lane_count];      // bit k: is there
    std::uint32_t begin_x[chunk_room / lane_count];  // and begins no farther left than the cell
    std::uint32_t begin_y[chunk_room / lane_count];  // or no lower

    void take(CasterBounds<Lanes> const& from, Cell<T> const& cell, T far_end) noexcept {
        auto const all = [](T value) { return Lanes::all(value); };
        Lanes const x0 = all(cell.x0), x1 = all(cell.x1), y0 = all(cell.y0), y1 = all(cell.y1), depth = all(far_end);
        std::uint32_t n = 0;
        for (std::uint32_t i = 0; i < from.count; i += lane_count)
            n += Lanes::compress(from.there(i) & from.touching(i, x0, x1, y0, y1, depth), from.slot + i,
                                 bounds.slot + n);
        bounds.count = n;
        if (n == 0) return;
        for (std::uint32_t i = 0; i < n; ++i) {
            std::uint32_t const slot = bounds.slot[i];
            bounds.lo_x[i] = from.lo_x[slot];
            bounds.hi_x[i] = from.hi_x[slot];
            bounds.lo_y[i] = from.lo_y[slot];
            bounds.hi_y[i] = from.hi_y[slot];
            bounds.depth[i] = from.depth[slot];
        }
        for (std::uint32_t i = 0, g = 0; i < n; i += lane_count, ++g) {
            any[g] = bounds.there(i);
            begin_x[g] = any[g] & at_least(Lanes::load(bounds.lo_x + i), x0);
            begin_y[g] = any[g] & at_least(Lanes::load(bounds.lo_y + i), y0);
        }
    }

    // The slots of those that may darken a node, without gaps; sixteen more can be written.
    [[nodiscard]] std::uint32_t find(T const* node, Cell<T> const& cell, std::uint32_t* slots) const noexcept {
        Lanes const lo_x = Lanes::all(node[0]), hi_x = Lanes::all(node[1]), lo_y = Lanes::all(node[2]),
                    hi_y = Lanes::all(node[3]), depth = Lanes::all(node[4]);
        std::uint32_t const* const in_x = node[0] >= cell.x0 ? any : begin_x;
        std::uint32_t const* const in_y = node[2] >= cell.y0 ? any : begin_y;
        std::uint32_t n = 0;
        for (std::uint32_t i = 0, g = 0; i < bounds.count; i += lane_count, ++g)
            n += Lanes::compress(in_x[g] & in_y[g] & bounds.touching(i, lo_x, hi_x, lo_y, hi_y, depth), bounds.slot + i,
                                 slots + n);
        return n;
    }
};

template <class Lanes, class T = typename Lanes::Scalar>
struct CasterChunk {
    CasterBounds<Lanes> bounds;
    RaisedTriangle<T> raised[chunk_room];

    void clear() noexcept { bounds.count = 0; }
    [[nodiscard]] bool full() const noexcept { return bounds.count + lane_count > chunk_room; }

    void add(CasterBatch<Lanes> const& batch) noexcept {
        for (std::uint32_t bits = batch.sound; bits != 0; bits &= bits - 1) {
            int const k = lowest_bit(bits);
            std::uint32_t const slot = bounds.count++;
            bounds.slot[slot] = slot;
            RaisedTriangle<T>& one = raised[slot];
            one.keys[1] = -(bounds.lo_x[slot] = batch.bounds[0][k]);
            one.keys[0] = bounds.hi_x[slot] = batch.bounds[1][k];
            one.keys[3] = -(bounds.lo_y[slot] = batch.bounds[2][k]);
            one.keys[2] = bounds.hi_y[slot] = batch.bounds[3][k];
            one.keys[4] = -(bounds.depth[slot] = batch.depth[k]);
            for (int i = 0; i < 4; ++i) {
                one.across[i] = static_cast<T>(one.x[i] = batch.plane[0][i][k]);
                one.upward[i] = static_cast<T>(one.y[i] = batch.plane[1][i][k]);
                one.a[i] = batch.plane[2][i][k];
                one.by_q[i] = static_cast<T>(one.b[i] = batch.plane[3][i][k]);
            }
        }
    }

    // What all of them together may touch, as bounds, and the end nearest to the light.
    void together(T (&all)[5]) const noexcept {
        Lanes const huge = Lanes::all(std::numeric_limits<T>::max());
        Lanes const low = Lanes::all(std::numeric_limits<T>::lowest());
        Lanes lo_x = huge, hi_x = low, lo_y = huge, hi_y = low, depth = huge;
        for (std::uint32_t i = 0; i < bounds.count; i += lane_count) {
            std::uint32_t const there = bounds.there(i);
            lo_x = least(lo_x, chosen(there, Lanes::load(bounds.lo_x + i), huge));
            hi_x = most(hi_x, chosen(there, Lanes::load(bounds.hi_x + i), low));
            lo_y = least(lo_y, chosen(there, Lanes::load(bounds.lo_y + i), huge));
            hi_y = most(hi_y, chosen(there, Lanes::load(bounds.hi_y + i), low));
            depth = least(depth, chosen(there, Lanes::load(bounds.depth + i), huge));
        }
        all[0] = smallest(lo_x);
        all[1] = largest(hi_x);
        all[2] = smallest(lo_y);
        all[3] = largest(hi_y);
        all[4] = smallest(depth);
    }
};

}  // namespace detail

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/irregular/cover.hpp ========
//
// Which samples of their tiles the triangles of a chunk cover. First the pixels whose bounds are out of a triangle's
// reach are left out; the others are held against the four planes of its shadow volume; samples are looked at last, in
// pixels that a plane crosses. Tiles are queued, so that what they need of memory is asked for before it is used; and
// each step is done for all pairs of the queue before the next: a pair waits for no other, and loops are long.

namespace shadowmath {
inline namespace v0 {

namespace detail {

template <class Lanes, class T = typename Lanes::Scalar>
struct CoverKernel {
    IrregularBuffer<T>& buffer;
    PixelFrame<Wider<T>> const& frame;

    using Real = Wider<T>;
    using Wide = typename Lanes::Wide;

    // Tiles that wait, and the slots of the triangles that may darken each.
    struct Queue {
        static constexpr std::uint32_t most_tiles = 16, most_slots = 512;
        std::uint32_t tile[most_tiles];
        std::uint32_t begin[most_tiles + 1];
        std::uint32_t slot[most_slots + chunk_room + lane_count];
        std::uint32_t tiles = 0;
        std::uint32_t slots = 0;

        [[nodiscard]] std::uint32_t* next() noexcept { return slot + slots; }
        [[nodiscard]] bool full() const noexcept { return tiles == most_tiles || slots >= most_slots; }
    };

    // Pairs of a tile and a triangle that remain.
    struct Pairs {
        static constexpr std::uint32_t room = Queue::most_slots + chunk_room;
        std::uint32_t tile[room];
        std::uint32_t slot[room];
        std::uint32_t pixels[room];
        T here[room + 3][4];  // the four planes' values at the corner of the tile
        std::uint32_t count = 0;
    };

    struct Quads {
        Lanes q, q_x, q_y, column, row;
    };

    // A plane as a line across each pixel: inside where c + x u + y v >= 0.
    struct Lines {
        Lanes c, x, y;
    };

    // Takes the next `count` slots of the queue for a tile.
    void enqueue(std::uint32_t tile, std::uint32_t count, Queue& queue) const noexcept {
        queue.tile[queue.tiles] = tile;
        queue.begin[queue.tiles++] = queue.slots;
        queue.slots += count;
        T const* const surface = surface_of(tile);
        std::uint32_t const* const state = state_of(tile);
        for (std::size_t i = 0; i < tile_scalars; i += cache_line / sizeof(T)) fetch_soon(surface + i);
        for (std::size_t i = 0; i < tile_words; i += cache_line / sizeof(std::uint32_t)) fetch_soon(state + i);
    }

    void cover(RaisedTriangle<T> const* raised, Queue& queue) const noexcept {
        Pairs pairs;
        queue.begin[queue.tiles] = queue.slots;
        for (std::uint32_t i = 0; i < queue.tiles; ++i) {
            std::uint32_t const first = pairs.count;
            leave_out(queue.tile[i], raised, queue.slot + queue.begin[i], queue.begin[i + 1] - queue.begin[i], pairs);
            place(queue.tile[i], raised, first, pairs);
        }
        queue.tiles = queue.slots = 0;
        std::uint32_t crossing[Pairs::room];
        std::uint32_t const crossings = cross(raised, pairs, crossing);
        for (std::uint32_t i = 0; i < crossings; ++i) {
            std::uint32_t const n = crossing[i], tile = pairs.tile[n];
            std::uint32_t* const state = state_of(tile);
            state[alive_at] &=
                ~darken(quads_of(tile), raised[pairs.slot[n]], pairs.here[n], pairs.pixels[n], state + mask_at);
        }
    }

    [[nodiscard]] Quads quads_of(std::uint32_t tile) const noexcept {
        T const* const surface = surface_of(tile);
        return {Lanes::load(surface), Lanes::load(surface + lane_count), Lanes::load(surface + 2 * lane_count),
                Lanes::load(tile_columns<T>), Lanes::load(tile_rows<T>)};
    }

    [[nodiscard]] T* surface_of(std::uint32_t tile) const noexcept {
        return buffer.surface + tile_scalars * static_cast<std::size_t>(tile);
    }
    [[nodiscard]] std::uint32_t* state_of(std::uint32_t tile) const noexcept {
        return buffer.state + tile_words * static_cast<std::size_t>(tile);
    }

    // Keeps the triangles that reach the bounds of a pixel.
    void leave_out(std::uint32_t tile, RaisedTriangle<T> const* raised, std::uint32_t const* slots, std::uint32_t count,
                   Pairs& pairs) const noexcept {
        std::uint32_t const* const state = state_of(tile);
        T const* const base = surface_of(tile) + key_base_at;
        T const* const step = surface_of(tile) + key_step_at;
        auto const* const bytes = reinterpret_cast<unsigned char const*>(state);
        auto const bound = [=](int i) {
            return fused(Lanes::load_bytes(bytes + i * lane_count), Lanes::all(step[i]), Lanes::all(base[i]));
        };
        Lanes const bounds[5] = {bound(0), bound(1), bound(2), bound(3), bound(4)};
        std::uint32_t const alive = state[alive_at];
        std::uint32_t kept = pairs.count;
        for (std::uint32_t n = 0; n < count; ++n) {
            T const(&keys)[5] = raised[slots[n]].keys;
            std::uint32_t pixels = alive;
            for (int i = 0; i < 5; ++i) pixels &= at_least(Lanes::all(keys[i]), bounds[i]);
            pairs.tile[kept] = tile;
            pairs.slot[kept] = slots[n];
            pairs.pixels[kept] = pixels;
            kept += pixels != 0 ? 1u : 0u;
        }
        pairs.count = kept;
    }

    // The planes' values at the corner of the tile, of four triangles at once. Here large terms cancel; what is left is
    // no more than a tile's worth.
    void place(std::uint32_t tile, RaisedTriangle<T> const* raised, std::uint32_t first, Pairs& pairs) const noexcept {
        auto const tiles_across = static_cast<std::uint32_t>(buffer.tiles_across);
        auto const all = [](Real value) { return Wide::all(value); };
        Wide const x =
            all(Real(static_cast<int>(tile % tiles_across * tile_side) + buffer.rect.x) - Real(frame.width) / Real(2));
        Wide const y =
            all(Real(static_cast<int>(tile / tiles_across * tile_side) + buffer.rect.y) - Real(frame.height) / Real(2));
        Wide const q = all(Real(surface_of(tile)[tile_q_at]));
        for (std::uint32_t n = first; n < pairs.count; n += 4) {
            // Past the last, the tile's first once more.
            RaisedTriangle<T> const* four[4];
            for (std::uint32_t j = 0; j < 4; ++j) four[j] = raised + pairs.slot[n + j < pairs.count ? n + j : first];
            auto const rows = [&four](Real const(RaisedTriangle<T>::*plane)[4]) {
                Real const* const row[4] = {four[0]->*plane, four[1]->*plane, four[2]->*plane, four[3]->*plane};
                return Wide::rows(row);
            };
            using Raised = RaisedTriangle<T>;
            Lanes::narrow(
                fused(rows(&Raised::x), x, fused(rows(&Raised::y), y, fused(rows(&Raised::b), q, rows(&Raised::a)))))
                .store(pairs.here[n]);
        }
    }

    [[nodiscard]] static Lines lines_of(Quads const& quads, RaisedTriangle<T> const& planes, int i,
                                        T const (&here)[4]) noexcept {
        Lanes const across = Lanes::all(planes.across[i]), upward = Lanes::all(planes.upward[i]),
                    by_q = Lanes::all(planes.by_q[i]);
        return {fused(by_q, quads.q, fused(upward, quads.row, fused(across, quads.column, Lanes::all(here[i])))),
                fused(by_q, quads.q_x, across), fused(by_q, quads.q_y, upward)};
    }

    // Pixels of which a sample may be inside, in the order of half_plane_mask: rounding is monotone.
    [[nodiscard]] static std::uint32_t touched(Lines const& lines) noexcept {
        Lanes const zero = Lanes::all(T(0));
        return at_least((lines.c + most(lines.x, zero)) + most(lines.y, zero), zero);
    }

    // Leaves the pixels of which a sample may be within all four planes, and gives the pairs that have some. The
    // triangle's own plane comes first: half of what it does not shadow lies before it.
    [[nodiscard]] std::uint32_t cross(RaisedTriangle<T> const* raised, Pairs& pairs,
                                      std::uint32_t* crossing) const noexcept {
        std::uint32_t behind = 0;
        for (std::uint32_t n = 0; n < pairs.count; ++n) {
            std::uint32_t const pixels =
                pairs.pixels[n] & touched(lines_of(quads_of(pairs.tile[n]), raised[pairs.slot[n]], 0, pairs.here[n]));
            pairs.pixels[n] = pixels;
            crossing[behind] = n;
            behind += pixels != 0 ? 1u : 0u;
        }
        std::uint32_t kept = 0;
        for (std::uint32_t m = 0; m < behind; ++m) {
            std::uint32_t const n = crossing[m];
            Quads const quads = quads_of(pairs.tile[n]);
            std::uint32_t pixels = pairs.pixels[n];
            for (int i = 1; i < 4; ++i) pixels &= touched(lines_of(quads, raised[pairs.slot[n]], i, pairs.here[n]));
            pairs.pixels[n] = pixels;
            crossing[kept] = n;
            kept += pixels != 0 ? 1u : 0u;
        }
        return kept;
    }

    // Gives the pixels that have no sample left.
    [[nodiscard]] static std::uint32_t darken(Quads const& quads, RaisedTriangle<T> const& planes, T const (&here)[4],
                                              std::uint32_t pixels, std::uint32_t* masks) noexcept {
        T stored[4][3][lane_count];
        for (int i = 0; i < 4; ++i) {
            Lines const lines = lines_of(quads, planes, i, here);
            lines.c.store(stored[i][0]);
            lines.x.store(stored[i][1]);
            lines.y.store(stored[i][2]);
        }
        std::uint32_t done = 0;
        for (std::uint32_t bits = pixels; bits != 0; bits &= bits - 1) {
            int const k = lowest_bit(bits);
            PixelLine<T> lines_here[4];
            for (int i = 0; i < 4; ++i) lines_here[i] = {stored[i][0][k], stored[i][1][k], stored[i][2][k]};
            std::uint32_t const dark = masks[k] |= half_planes_mask<Lanes>(lines_here);
            done |= (dark == every_sample ? 1u : 0u) << k;
        }
        return done;
    }
};

}  // namespace detail

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/irregular/trace.hpp ========
//
// Exact hard shadows: every triangle against the pixels whose light it may take, 32 samples each. No resolution, no
// bias, no filter: a sample is dark when the segment from it to the light meets a triangle.
//
//   storage                    arrays of the caller's, storage_for(...) long
//   list_receivers(...)        once for a picture, or for each part of it
//   trace(buffer, casters)     in any order, any number of times; parts can run on threads of their own
//   write_masks(buffer, out)   one word a pixel: bit i is set where sample i is dark
//
// Use it where shadows must be right to the pixel; on a CPU it is faster than ray tracing as long as every pixel is
// wanted. For a few points, or soft shadows, trace rays instead.
//
// Source: Wyman, Hoetzlein and Lefohn, TVCG 22(10) 2016. Departures: tiles of 4 x 4 pixels are tested at once, first by
// bounds of a byte each, then against all four planes before any sample; triangles are clipped only to find their
// texels; and they are put in the order of the grid, where a node is held against sixteen of its neighbourhood at once.
//
// Against ray tracing (bench/irregular.cpp, 32 samples a pixel, one thread): the whole frame takes a seventh to a
// twelfth of Embree's best, at 100 thousand triangles and at a million; about half of Embree's with one ray a pixel.

namespace shadowmath {
inline namespace v0 {

namespace detail {

template <class Lanes, class T = typename Lanes::Scalar>
struct TraceKernel {
    IrregularBuffer<T>& buffer;
    CasterKernel<Lanes> kernel;
    CoverKernel<Lanes> cover;

    using Batch = CasterBatch<Lanes>;
    using Chunk = CasterChunk<Lanes>;
    using Queue = typename CoverKernel<Lanes>::Queue;

    // The list that a triangle begins in, of those whose cells are no narrower than it.
    [[nodiscard]] std::uint32_t list_of(PlaceRange const& places, int extent) const noexcept {
        PlaceRange const texels = texels_of(places, 0);
        if (extent > 1 << most_divisions) {
            int level = 1;
            while (level + 1 < buffer.level_count && extent > 1 << (most_divisions + level_shift * level)) ++level;
            PlaceRange const at = coarser(texels, level_shift * level);
            if (level < buffer.level_count)
                return buffer.level_first[level] +
                       static_cast<std::uint32_t>(at.y0 * level_size(buffer.map_size, level) + at.x0);
        }
        int const texel = texels.y0 * buffer.map_size + texels.x0;
        auto const k = static_cast<int>(buffer.texel_division[texel]);
        int const first = 1 << most_divisions, shift = most_divisions - k;
        int const in_x = (places.x0 & (first - 1)) >> shift, in_y = (places.y0 & (first - 1)) >> shift;
        return buffer.texel_lists[texel] +
               (extent > 1 << shift ? 0u : 1u + static_cast<std::uint32_t>((in_y << k) + in_x));
    }

    // Keeps the triangles that may touch a node, from `begin` on, until there is no room for more. Gives how many were
    // looked at, and how many kept.
    [[nodiscard]] std::uint32_t keep(std::uint32_t begin, std::uint32_t count, Batch& batch,
                                     std::uint32_t& kept) const noexcept {
        std::uint32_t places[4][lane_count];
        Lanes const zero = Lanes::all(T(0)), last = Lanes::all(T((buffer.map_size << most_divisions) - 1));
        Lanes const scale = Lanes::all(T(1 << most_divisions));
        std::uint32_t done = 0, held = 0;
        for (; done < count && held + lane_count <= buffer.caster_room; done += lane_count) {
            kernel.load(begin + done, count - done, nullptr, batch);
            for (int i = 0; i < 4; ++i)
                least(most(Lanes::load(batch.bounds[i]) * scale, zero), last).store_words(places[i]);
            for (std::uint32_t bits = batch.sound; bits != 0; bits &= bits - 1) {
                int const k = lowest_bit(bits);
                PlaceRange const at{static_cast<int>(places[0][k]), static_cast<int>(places[1][k]),
                                    static_cast<int>(places[2][k]), static_cast<int>(places[3][k])};
                int const width = at.x1 - at.x0, height = at.y1 - at.y0, extent = width > height ? width : height;
                PlaceRange const texels = texels_of(at, 0);
                std::uint32_t const list = list_of(at, extent);
                bool const in_block = extent <= 1 << most_divisions;
                T const far_end = buffer.block_depth[texels.y0 * buffer.map_size + texels.x0];
                std::uint32_t const met = !in_block || far_end >= batch.depth[k] ? 1u : 0u;
                buffer.caster[held] = begin + done + static_cast<std::uint32_t>(k);
                buffer.caster_list[held] = list;
                buffer.caster_end[list + 1] += met;
                held += met;
            }
        }
        kept = held;
        return done < count ? done : count;
    }

    // Puts them in the order of their lists: what is next to each other in the grid is then in the caches, however the
    // mesh was laid out.
    void sort(std::uint32_t kept) const noexcept {
        std::uint32_t* const end = buffer.caster_end;
        for (std::uint32_t list = 0; list < buffer.list_count; ++list) end[list + 1] += end[list];
        for (std::uint32_t i = 0; i < kept; ++i) buffer.caster_order[end[buffer.caster_list[i]]++] = buffer.caster[i];
    }

    void search(Chunk const& chunk, std::uint32_t list, Cell<T> const& cell, T far_end, CellCasters<Lanes>& here,
                Queue& queue) const noexcept {
        std::uint32_t const begin = buffer.first[list], end = buffer.first[list + 1];
        if (begin == end) return;
        here.take(chunk.bounds, cell, far_end);
        if (here.bounds.count == 0) return;
        T const* bounds = buffer.bounds + 5 * std::size_t{begin};
        for (std::uint32_t node = begin; node < end; ++node, bounds += 5) {
            std::uint32_t const found = here.find(bounds, cell, queue.next());
            if (found == 0) continue;
            cover.enqueue(buffer.tile[node], found, queue);
            if (queue.full()) cover.cover(chunk.raised, queue);
        }
    }

    // A chunk against the lists of all cells that it may touch.
    void run(Chunk& chunk, CellCasters<Lanes>& here, Queue& queue) const noexcept {
        if (chunk.bounds.count == 0) return;
        T bounds[5];
        chunk.together(bounds);
        T const anywhere = std::numeric_limits<T>::max();
        PlaceRange const places = places_of(bounds, buffer.map_size);
        for (std::uint32_t levels = buffer.levels_used; levels != 0; levels &= levels - 1) {
            int const level = lowest_bit(levels), shift = most_divisions + level_shift * level;
            int const size = level_size(buffer.map_size, level);
            PlaceRange const range = coarser(places, shift);
            for (int y = range.y0; y <= range.y1; ++y)
                for (int x = range.x0; x <= range.x1; ++x) {
                    int const texel = y * size + x;
                    Cell<T> const cell = cell_at<T>(x, y, shift, buffer.map_size);
                    if (level > 0) {
                        search(chunk, buffer.level_first[level] + static_cast<std::uint32_t>(texel), cell, anywhere,
                               here, queue);
                        continue;
                    }
                    T const far_end = buffer.texel_depth[texel];
                    if (far_end < bounds[4] || (buffer.texel_levels[texel] & 1u) == 0) continue;
                    std::uint32_t const lists = buffer.texel_lists[texel];
                    search(chunk, lists, cell, far_end, here, queue);
                    auto const k = static_cast<int>(buffer.texel_division[texel]);
                    PlaceRange const in = divisions_of(places, x, y, k);
                    for (int j = in.y0; j <= in.y1; ++j)
                        for (int i = in.x0; i <= in.x1; ++i)
                            search(chunk, lists + 1 + static_cast<std::uint32_t>((j << k) + i),
                                   cell_at<T>((x << k) + i, (y << k) + j, most_divisions - k, buffer.map_size), far_end,
                                   here, queue);
                }
        }
        cover.cover(chunk.raised, queue);
        chunk.clear();
    }

    // Gives how many triangles were looked at.
    [[nodiscard]] std::uint32_t run_block(std::uint32_t begin, std::uint32_t count) const noexcept {
        constexpr std::uint32_t ahead = 4 * lane_count;
        Batch batch;
        Chunk chunk;
        CellCasters<Lanes> here;
        Queue queue;
        std::memset(buffer.caster_end, 0, (buffer.list_count + 1) * sizeof(std::uint32_t));
        std::uint32_t kept;
        std::uint32_t const done = keep(begin, count, batch, kept);
        sort(kept);
        for (std::uint32_t i = 0; i < kept; i += lane_count) {
            for (std::uint32_t k = i + ahead; k < i + ahead + lane_count && k < kept; ++k)
                kernel.fetch(buffer.caster_order[k]);
            kernel.load(i, kept - i, buffer.caster_order, batch);
            kernel.raise_volumes(batch);
            chunk.add(batch);
            if (chunk.full()) run(chunk, here, queue);
        }
        run(chunk, here, queue);
        return done;
    }
};

}  // namespace detail

// Takes the light of `count` triangles from `first` on out of the buffer's masks; a count of 0 stands for all that
// follow. The masks that remain do not depend on the order of triangles, on the grid, or on how the work is split.
// Triangles with an index beyond the vertices, with a vertex that is not finite or farther than 1e9 m cast nothing.
template <class T, class Lanes = BestLanes<T>>
inline void trace(IrregularBuffer<T>& buffer, Casters<T> const& casters, std::uint32_t first = 0,
                  std::uint32_t count = 0) noexcept {
    if (buffer.levels_used == 0 || first >= casters.triangle_count || casters.vertex_count == 0) return;
    SHADOWMATH_ASSERT(casters.position != nullptr, "casters need positions");
    std::uint32_t const left = casters.triangle_count - first;
    if (count == 0 || count > left) count = left;
    // All along a ray of a sun w is that of the receiver; toward a lamp it falls to 0.
    T const slack = buffer.light.parallel ? T(0.999) : T(1) / T(1 << 20);
    T const wanted = slack * (buffer.light.parallel ? buffer.least_w : buffer.most_w),
            least = std::numeric_limits<T>::min();
    T const w_floor = wanted > least ? wanted : least;  // what is clipped is divided by it
    PixelFrame<Wider<T>> const frame = frame_in<Wider<T>>(buffer.frame);
    detail::TraceKernel<Lanes> const kernel{
        buffer, {buffer, casters, frame, pixel_light(frame, buffer.source), w_floor}, {buffer, frame}};
    for (std::uint32_t done = 0; done < count;) done += kernel.run_block(first + done, count - done);
}

// One word for each pixel of the buffer's part of the picture, row by row, `stride` words apart: 0 for sky. A stride of
// 0 is the width of that part.
template <class T>
inline void write_masks(IrregularBuffer<T> const& buffer, std::uint32_t* masks, int stride = 0) noexcept {
    PixelRect const& rect = buffer.rect;
    if (stride == 0) stride = rect.width;
    for (int row = 0; row < rect.height; ++row) {
        std::uint32_t* const out = masks + static_cast<std::size_t>(row) * static_cast<std::size_t>(stride);
        if (buffer.tile_count == 0) {
            std::memset(out, 0, static_cast<std::size_t>(rect.width) * sizeof(std::uint32_t));
            continue;
        }
        std::uint32_t const* in = buffer.state +
                                  static_cast<std::size_t>(row / tile_side * buffer.tiles_across) * tile_words +
                                  mask_at + row % tile_side * tile_side;
        for (int column = 0; column < rect.width; column += tile_side, in += tile_words) {
            int const columns = rect.width - column < tile_side ? rect.width - column : tile_side;
            std::memcpy(out + column, in, static_cast<std::size_t>(columns) * sizeof(std::uint32_t));
        }
    }
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/irregular/gpu.hpp ========
//
// What the compute passes of the irregular z-buffer read, as it lies in memory (std140): the members of the block in
// backends/shaders/irregular_buffers.glsl. Plain numbers: who dispatches the passes needs no header of this library.

namespace shadowmath {
inline namespace v0 {

// Three floats in a row, whatever GLM's settings align a vec3 to.
struct GpuFloat3 {
    float x = 0.0f;
    float y = 0.0f;
    float z = 0.0f;
};

// sm_PixelFrame of glsl/irregular.glsl
struct GpuPixelFrame {
    GpuFloat3 eye;
    std::int32_t width = 0;
    GpuFloat3 across;
    std::int32_t height = 0;
    GpuFloat3 upward;
    std::int32_t orthographic = 0;
    GpuFloat3 inward;
    float origin_x = 0.0f;
    GpuFloat3 to_across;
    float origin_y = 0.0f;
    GpuFloat3 to_upward;
    float turn_limit = 1.0f;
    GpuFloat3 to_inward;
    float unused = 0.0f;
};
static_assert(offsetof(GpuPixelFrame, width) == 12 && offsetof(GpuPixelFrame, orthographic) == 44);
static_assert(offsetof(GpuPixelFrame, to_across) == 64 && offsetof(GpuPixelFrame, turn_limit) == 92);
static_assert(offsetof(GpuPixelFrame, to_inward) == 96 && sizeof(GpuPixelFrame) == 112);

struct GpuIrregular {
    GpuPixelFrame frame;
    GpuFloat3 light_at;
    std::int32_t parallel = 1;
    GpuFloat3 source;  // world: how the light travels, or where it stands
    float unused_light = 0.0f;
    Vec4<float> row[4]{};
    Vec4<float> seen[4]{};
    float texel_error = 0.0f;
    float texel_error_here = 0.0f;
    float depth_error = 0.0f;
    float depth_error_here = 0.0f;
    float ray = 0.0f;
    float reach = 0.0f;
    float contact_metres = 0.0f;
    float contact_share = 0.0f;
    float w_min = 0.0f;
    std::int32_t map_size = 0;
    std::uint32_t triangle_count = 0;  // this and what follows: of whoever dispatches
    std::uint32_t vertex_count = 0;
    std::uint32_t node_capacity = 0;
    std::uint32_t unused[3] = {};
};
static_assert(offsetof(GpuIrregular, light_at) == 112 && offsetof(GpuIrregular, parallel) == 124);
static_assert(offsetof(GpuIrregular, source) == 128);
static_assert(offsetof(GpuIrregular, row) == 144 && offsetof(GpuIrregular, seen) == 208);
static_assert(offsetof(GpuIrregular, texel_error) == 272 && offsetof(GpuIrregular, ray) == 288);
static_assert(offsetof(GpuIrregular, w_min) == 304 && offsetof(GpuIrregular, node_capacity) == 320);
static_assert(sizeof(GpuIrregular) == 336);

// Faults leave `gpu` as it was: those of the frame and the light, bad_projection where the grid is not a map of this
// light, map_too_small for a grid outside [1, largest_grid].
// NOTE: a template for float alone, so that it costs nothing to compile where it is not called.
template <class T>
[[nodiscard]] inline Faults gpu_irregular(PixelFrame<T> const& frame, Light<T> const& light, ShadowMap<T> const& grid,
                                          int map_size, GpuIrregular& gpu) noexcept {
    static_assert(std::numeric_limits<T>::digits == 24, "shaders compute in float");
    IrregularBuffer<T> buffer;
    buffer.frame = frame;
    buffer.map_size = map_size;
    Faults faults = frame.faults | faults_of(light);
    if (map_size < 1 || map_size > largest_grid) faults |= Fault::map_too_small;
    if (faults.any()) return faults;
    if (!detail::take_view(buffer, light, grid)) return Fault::bad_projection;
    GpuIrregular filled;
    auto const three = [](Vec3<T> const& v) { return GpuFloat3{v.x, v.y, v.z}; };
    bool const flat = frame.kind == ViewKind::orthographic;
    filled.frame = {three(frame.eye),       frame.width,
                    three(frame.across),    frame.height,
                    three(frame.upward),    flat ? 1 : 0,
                    three(frame.inward),    frame.origin.x,
                    three(frame.to_across), frame.origin.y,
                    three(frame.to_upward), detail::turn_limit(frame),
                    three(frame.to_inward), 0.0f};
    filled.light_at = three(buffer.light.at);
    filled.parallel = buffer.light.parallel ? 1 : 0;
    filled.source = three(buffer.light.parallel ? light.direction : light.position);
    for (int i = 0; i < 4; ++i) {
        PixelPlane<T> const plane = detail::plane_of_row(frame, buffer.row[i]);
        filled.row[i] = buffer.row[i];
        filled.seen[i] = Vec4<float>(plane.x, plane.y, plane.a, plane.b);
    }
    filled.texel_error = buffer.texel_error;
    filled.texel_error_here = buffer.texel_error_here;
    filled.depth_error = buffer.depth_error;
    filled.depth_error_here = buffer.depth_error_here;
    filled.ray = buffer.contact_ray;
    filled.reach = buffer.contact_reach;
    filled.contact_metres = buffer.contact_reach;
    filled.contact_share = contact_share<T>;
    filled.w_min = grid.w_min > 0.0f ? grid.w_min : 0.0f;
    filled.map_size = map_size;
    gpu = filled;
    return {};
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/irregular.hpp ========
//
// Exact hard shadows on the CPU: the irregular z-buffer and frustum tracing, in the order in which data flows.
