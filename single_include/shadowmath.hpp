// SPDX-License-Identifier: MIT
//
// shadowmath 0.1.0.
// All of its headers as one, made by scripts/amalgamate. Take this file or the folder of headers: both in one
// translation unit define everything twice.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

#include <glm/glm.hpp>

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
// GLM's macros may be set in any way: shadowmath calls nothing whose meaning depends on them.
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
// Is it a number, and how long is it: the two questions asked at the door of every public function.
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

// For the high-precision twin of tests, never built with -ffast-math: formats of long double differ between platforms.
[[nodiscard]] inline bool all_finite(long double const* values, int count) noexcept {
    for (int i = 0; i < count; ++i)
        if (!std::isfinite(values[i])) return false;
    return true;
}

// True for +infinity alone: a camera without a far plane.
template <class T>
[[nodiscard]] inline bool is_positive_infinity(T const* value) noexcept {
    T const infinity = std::numeric_limits<T>::infinity();
    // An x87 long double carries padding behind its ten bytes; the other types none.
    return std::memcmp(value, &infinity, sizeof(T) > 8 ? 10 : sizeof(T)) == 0;
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
    not_finite = 1u << 0,       // a NaN or an infinity where a number was needed
    zero_light = 1u << 1,       // the light's direction has no length
    near_clamped = 1u << 2,     // the near distance was raised so that ratios of distances exist
    empty_range = 1u << 3,      // near < 0, or near >= far
    far_clamped = 1u << 4,      // the far distance is infinite or too far, and was cut
    bad_frustum = 1u << 5,      // sides crossed, equal or not finite: a field of view outside (0, pi), an aspect of 0
    bad_pose = 1u << 6,         // the axes are too far from orthonormal to be mended
    count_clamped = 1u << 7,    // more maps asked for than fit, or than the range can be divided into
    clamped_option = 1u << 8,   // an option outside its stated range was brought to the nearer end
    map_too_small = 1u << 9,    // fewer texels than filter and snapping need
    bad_region = 1u << 10,      // a tile or region without area, or outside its map
    cone_clamped = 1u << 11,    // a spot's half angle was brought into its range
    invalid_plane = 1u << 12,   // a shadow plane that contains the light or the eye, or has no normal
    bad_projection = 1u << 13,  // a given projection matrix from which no view volume can be read
    precision_lost = 1u << 14,  // coordinates too large for the scalar type to keep texels still; use double
    warp_faded = 1u << 15       // light and view are nearly parallel: the warp gave way to a uniform map
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
// forward axis keeps its direction. A worse pose comes back as it is.
template <class T>
[[nodiscard]] inline Pose<T> orthonormalized(Pose<T> const& pose) noexcept {
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
    int kept = 0;
    splits.plane[0] = z_near;
    for (int i = 1; i < splits.count; ++i)
        if (splits.plane[i] > splits.plane[kept] && splits.plane[i] < z_far) splits.plane[++kept] = splits.plane[i];
    splits.plane[++kept] = z_far;
    if (kept != splits.count) splits.faults |= Fault::count_clamped;
    for (int i = kept + 1; i <= splits.count; ++i) splits.plane[i] = T(0);
    splits.count = kept;
}

template <class T>
[[nodiscard]] inline T clamped_lambda(T const& lambda, Faults& faults) noexcept {
    if (all_finite(&lambda, 1) && lambda >= T(0) && lambda <= T(1)) return lambda;
    faults |= Fault::clamped_option;
    return all_finite(&lambda, 1) ? (lambda > T(1) ? T(1) : T(0)) : T(0.5);
}

}  // namespace detail

// Ends exact, strictly increasing, between the uniform and the logarithmic planes; lambda = 1 is logarithmic, 0
// uniform. z_near and z_far in metres, 0 <= z_near < z_far < infinity; count from 1 to max_splits (0 gives no split and
// no fault). Where no ratio of distances exists (z_near = 0, or below 2^-64 of z_far) the logarithmic part starts at
// 2^-20 of z_far (near_clamped).
template <class T>
[[nodiscard]] inline Splits<T> practical_splits(T z_near, T z_far, int count, T lambda = T(0.5)) noexcept {
    Splits<T> splits = detail::open_splits(z_near, z_far, count);
    T const weight = detail::clamped_lambda(lambda, splits.faults);
    if (splits.count == 0) return splits;
    bool const has_ratio = z_near > z_far * T(0x1p-64);
    if (weight > T(0) && !has_ratio) splits.faults |= Fault::near_clamped;
    T const ratio = has_ratio ? z_far / z_near : T(1 << 20);
    T const log_near = has_ratio ? z_near : z_far / ratio;
    for (int i = 1; i < splits.count; ++i) {
        T const fraction = T(i) / T(splits.count);
        T const uniform = z_near + (z_far - z_near) * fraction;
        T const logarithmic = weight > T(0) ? log_near * std::pow(ratio, fraction) : T(0);
        splits.plane[i] = weight * logarithmic + (T(1) - weight) * uniform;
    }
    detail::close_splits(splits, z_near, z_far);
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
    T const at = end - share * (end - begin);
    return at > begin ? at : begin;
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
    // Centre and half extent instead of a product of matrices: one rounding each.
    auto const axis = [](Vec3<T> const& direction, T lo, T hi) {
        T const scale = T(2) / (hi - lo);
        return Vec4<T>(direction * scale, -(hi + lo) / (hi - lo));
    };
    T const depth_scale = T(1) / (box.depth_hi - box.depth_lo);
    Mat4<T> const canonical =
        from_rows(axis(box.basis.x, box.lo.x, box.hi.x), axis(box.basis.y, box.lo.y, box.hi.y),
                  Vec4<T>(box.basis.depth * depth_scale, -box.depth_lo * depth_scale), Vec4<T>(T(0), T(0), T(0), T(1)));
    bool const has_extent = box.lo.x < box.hi.x && box.lo.y < box.hi.y && box.depth_lo < box.depth_hi;
    return has_extent && all_finite(canonical) ? clip_from_canonical<T>(clip) * canonical : nowhere<T>();
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

template <class T>
[[nodiscard]] inline T largest_of(Vec3<T> const& v) noexcept {
    return std::fmax(std::abs(v.x), std::fmax(std::abs(v.y), std::abs(v.z)));
}

template <class T>
[[nodiscard]] inline T largest_of(Aabb<T> const& box) noexcept {
    return std::fmax(largest_of(box.lo), largest_of(box.hi));
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
// Source: clipping the scene's box against the map's four sides is that of Microsoft's "Common techniques to improve
// shadow depth maps". Departures: polygons for triangles, and boxes without an end are cut before they are computed
// with.

namespace shadowmath {
inline namespace v0 {

template <class T>
struct DepthRange {
    T lo = T(0);  // metres along the light, from the world origin
    T hi = T(1);
    bool visible = false;  // false: nothing is there, or nothing that could shadow it
};

namespace detail {

// A quadrilateral and what cutting by six planes can add: a corner each.
template <class T>
struct Polygon {
    Vec3<T> at[10];
    int count = 0;
};

// What is left where plane.xyz * p + plane.w >= 0; Sutherland and Hodgman 1974.
template <class T>
[[nodiscard]] inline Polygon<T> clipped(Polygon<T> const& whole, Vec4<T> const& plane) noexcept {
    Polygon<T> part;
    for (int i = 0; i < whole.count; ++i) {
        Vec3<T> const &a = whole.at[i], &b = whole.at[i + 1 < whole.count ? i + 1 : 0];
        T const above_a = glm::dot(Vec3<T>(plane), a) + plane.w, above_b = glm::dot(Vec3<T>(plane), b) + plane.w;
        // NOTE: rounding can make a convex polygon cross a plane more than twice; the spare corners are dropped.
        if (above_a >= T(0) && part.count < 10) part.at[part.count++] = a;
        if ((above_a >= T(0)) != (above_b >= T(0)) && part.count < 10)
            part.at[part.count++] = a + (b - a) * (above_a / (above_a - above_b));
    }
    return part;
}

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

}  // namespace detail

// Depths along `volume` at which the box is inside it: never less than the truth, and more by rounding only. Any finite
// box will do, however large; the volume must be finite. Not visible where they do not meet.
//
// The least and the greatest depth of the common part are at its corners, and those are corners of the volume inside
// the box, or lie on the box's faces.
template <class T>
[[nodiscard]] inline DepthRange<T> depths_inside(Aabb<T> const& box, ViewVolume<T> const& volume) noexcept {
    if (!all_finite(box) || is_empty(box)) return {};
    std::array<Vec3<T>, 8> const volume_corners = corners(volume);
    constexpr T slack = T(8) * std::numeric_limits<T>::epsilon();
    Aabb<T> const around = merge(bounds_of(volume_corners), volume.pose.position);
    // Whatever does not reach the volume goes first: from here on no number is larger than the volume's own.
    T const reach = slack * detail::largest_of(around);
    Aabb<T> const body = intersect(box, Aabb<T>{around.lo - reach, around.hi + reach});
    if (is_empty(body)) return {};
    T const largest = detail::largest_of(merge(body, volume.pose.position)), rounding = slack * largest;
    DepthRange<T> range{volume.z_far, volume.z_near, false};
    auto const reaches = [&](Vec3<T> const& point) {
        T const depth = eye_depth(volume, point);
        range.lo = depth < range.lo ? depth : range.lo;
        range.hi = depth > range.hi ? depth : range.hi;
        range.visible = true;
    };
    for (Vec3<T> const& corner : volume_corners)
        if (contains(body, corner)) reaches(corner);
    std::array<Vec4<T>, 6> planes = detail::inner_planes(volume);
    for (Vec4<T>& plane : planes)
        plane.w += slack * ((std::abs(plane.x) + std::abs(plane.y) + std::abs(plane.z)) * largest + std::abs(plane.w));
    std::array<Vec3<T>, 8> const at = corners(body);
    for (unsigned axis = 0; axis < 3; ++axis) {
        std::size_t const u = std::size_t(1) << (axis + 1) % 3, v = std::size_t(1) << (axis + 2) % 3;
        for (std::size_t const first : {std::size_t(0), std::size_t(1) << axis}) {
            detail::Polygon<T> face{{at[first], at[first + u], at[first + u + v], at[first + v]}, 4};
            for (Vec4<T> const& plane : planes) face = detail::clipped(face, plane);
            for (int i = 0; i < face.count; ++i) reaches(face.at[i]);
        }
    }
    if (!range.visible) return {};
    range.lo = std::fmax(range.lo - rounding, volume.z_near);
    range.hi = std::fmin(range.hi + rounding, volume.z_far);
    return range;
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
    T const side = std::fmax(std::fmax(std::abs(slice.left), std::abs(slice.right)),
                             std::fmax(std::abs(slice.bottom), std::abs(slice.top)));
    if (!(std::fmax(slice.z_far, detail::largest_of(p)) <= detail::farthest_metres<T>) ||
        !(side <= (flat ? detail::farthest_metres<T> : T(1e9))) ||
        (!flat && !(side * slice.z_far <= detail::farthest_metres<T>)))
        return {};
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
        ball = detail::ball_of_unit_slice(slice, slice.z_near / slice.z_far);
    }
    // Up by what the coordinates of corner and centre were rounded by.
    T const slack = T(8) * std::numeric_limits<T>::epsilon();
    return {p + (f * ball.center.z + r * ball.center.x + u * ball.center.y) * unit,
            (ball.radius + slack * (T(1) + ball.radius)) * unit};
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/region.hpp ========
//
// A rectangle of a map, as a matrix on the left: crop to what is used, place in an atlas, compose both. And the
// rectangle that a body needs, clipped before the divide.
//
// Use it after any technique: nothing here knows how the matrix was made, and neither the light's law nor the order of
// depth is touched. Source: Kwon 2002 (thesis), 4.1, with its y scale corrected; the clip before the divide is ours.

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

// The region fills the map: lo lands on (-1, -1), hi on (1, 1); depth and w are left alone. A region that is empty, not
// finite, or so small or so large that its scale would not be, gives the identity.
template <class T>
[[nodiscard]] inline Mat4<T> region_matrix(Region<T> const& region) noexcept {
    if (!all_finite(region.lo) || !all_finite(region.hi) || is_empty(region)) return Mat4<T>(T(1));
    Vec2<T> const scale = T(2) / (region.hi - region.lo);
    Vec2<T> const offset = -(region.hi + region.lo) / (region.hi - region.lo);
    if (!all_finite(scale) || !all_finite(offset)) return Mat4<T>(T(1));
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

// Bounds in NDC of the part of a convex body at w >= w_min; empty when nothing is left, or an input is not finite. The
// body is given by eight corners whose indices differ in one bit along an edge, as those of a box or a view volume.
// Every point of the body at w >= w_min lies inside, to rounding, for any matrix and for boxes of +-FLT_MAX: the
// twelve edges are cut at w_min before anything is divided. A w_min that is not positive becomes the least one whose
// quotients still mean something: epsilon times the largest w.
template <class T>
[[nodiscard]] inline Aabb<T> projected_bounds(Mat4<T> const& clip_from_world, std::array<Vec3<T>, 8> const& corners,
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
        share[i] = reach > ordinary ? T(1) / reach : T(1);
        point[i] = clip * Vec4<T>(corners[i] * share[i], share[i]);
        largest_w = glm::max(largest_w, point[i].w);
    }
    constexpr T tiny = T(8) * std::numeric_limits<T>::min();
    T const least = glm::max(floor > T(0) ? floor : std::numeric_limits<T>::epsilon() * largest_w, tiny);
    T const largest = std::numeric_limits<T>::max();
    Aabb<T> bounds;
    auto const add = [&bounds, largest](Vec4<T> const& p, T w) {
        // A quotient may overflow where w is far below the rest; the largest number still bounds it.
        Vec3<T> const ndc(p.x / w, p.y / w, p.z / w);
        bounds = merge(bounds, glm::clamp(ndc, Vec3<T>(-largest), Vec3<T>(largest)));
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
    T metres = T(0);      // everywhere: filter, bias, a spot's own radius; >= 0
    T sun_slope = T(0);   // tan of the sun's angular radius: the sweep widens by this for a metre of height; >= 0
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
    T const sine = padding.sun_slope / std::hypot(T(1), padding.sun_slope);
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
    bool const flat = slice.kind == ViewKind::orthographic;
    T const side = std::fmax(std::fmax(std::abs(slice.left), std::abs(slice.right)),
                             std::fmax(std::abs(slice.bottom), std::abs(slice.top)));
    T const spread = flat ? T(1) : slice.z_far;
    bool const usable = light.kind == LightKind::directional && !unusable(light) && !faults_of(slice).any() &&
                        !is_positive_infinity(&slice.z_far) && all_finite(casters) && all_finite(receivers) &&
                        !is_empty(casters) && !is_empty(receivers);
    if (!usable || !(side <= farthest / std::fmax(spread, T(1))) || !(slice.z_far <= farthest) ||
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
// The smallest rectangle around a body as the light sees it, at whatever angle: never more texels than fit_box, a
// quarter fewer over a view frustum in the mean. As with fit_box, size and place change as the camera turns, and
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
// direction is kept while the area is at most 1 + hysteresis times the least, and no more than fit_box's. Bodies that are empty, not
// finite, or beyond 1e18 m give what fit_box gives for such corners.
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

// The casters in the shaft of light that the map sees, from the light down to `last`.
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
    for (Vec4<T> const& side : {rows.w - rows.x, rows.w + rows.x, rows.w - rows.y, rows.w + rows.y})
        shaft = clipped(shaft, side);
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

// ======== shadowmath/warp.hpp ========
//
// Perspective warps of a sun's map: texels small near the eye, large far away, in one map.
//
//   seen from the light:      \     far      /         w = 1 + (y - y_near) / a, with y along the projected view
//                              \            /          direction. All warps with one centre line are this one; they
//        eye . . . . y_near ->  \__________/           differ in a, the distance of the centre behind the near end:
//                                                      a -> infinity is the uniform map, a = z_near Stamminger's.
//
// Use it for one map and a low sun or a level view. Where light and view are parallel nothing can be gained, and the
// warp fades to a uniform map. Like every map that depends on the view it shimmers when the camera moves; cascades do
// not.
//
// Source: the "very simple perspective shadow map" of a Korean weblog (2012) in its corrected form; a as in Wimmer,
// Scherzer, Purgathofer 2004 (LiSPSM), with Scherzer's general tilt. Departures from the weblog: the whole of the map
// is filled, depth is not clipped, the centre of projection is free of the camera, and the strength follows the angle
// of the light.

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
    Normalized<T> const rough = safe_normalize(view + across(eye.up) * (none * (T(1) - axes.fade)));
    // Across the light once more: what rounding left along it has grown with the normalisation.
    Normalized<T> const y = safe_normalize(across(rough.direction));
    if (!rough.ok || !y.ok) return axes;
    axes.basis.y = y.direction;
    axes.basis.x = glm::cross(travel, y.direction);
    return axes;
}

template <class T>
struct WarpOptions {
    int map_size = 1024;
    T margin_texels = T(2);  // of the map kept free on each side, for the filter
    T strength = T(1);       // [0, 1]: 1 the least aliasing along the view, 0 the uniform map
};

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
    if (!all_finite(&options.strength, 1)) map.faults |= Fault::not_finite;
    if (in.stop || !all_finite(&options.strength, 1)) return map;
    T const strength = glm::clamp(options.strength, T(0), T(1));
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
        inverse_centre =
            strength * axes.fade * optimal_inverse_centre(glm::max(eye_metres.lo, nearest), y.hi - y.lo, axes.sine);
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

// The window holds the sphere and `margin_texels` texels around it. Its place is a whole number of texels, its texel
// the same bits for the same radius. A radius of 0 (no slice) is not visible and no fault.
template <class T>
[[nodiscard]] inline TexelGrid<T> texel_grid(LightBasis<T> const& basis, Sphere<T> const& sphere, int map_size,
                                             T margin_texels) noexcept {
    TexelGrid<T> grid;
    grid.faults = faults_of_margin(map_size, margin_texels);
    if (!all_finite(sphere.center) || !all_finite(&sphere.radius, 1)) grid.faults |= Fault::not_finite;
    if (!detail::has_unit_axes(basis)) grid.faults |= Fault::bad_pose;
    if (grid.faults.has(Fault::not_finite) || grid.faults.has(Fault::map_too_small) ||
        grid.faults.has(Fault::bad_pose) || !(sphere.radius > T(0)))
        return grid;
    constexpr T eps = std::numeric_limits<T>::epsilon();
    // Up by the roundings of this line and of the window's own extent.
    T const texel = sphere.radius / (usable_texels(map_size, margin_texels) - T(1)) * (T(2) + T(16) * eps);
    // Double for float too: the rounding to whole texels then adds nothing to what the inputs have lost.
    using Exact = decltype(T() + double());
    auto const lower_left = [&](Vec3<T> const& axis) {
        Exact const center = glm::dot(Vec3<Exact>(axis), Vec3<Exact>(sphere.center));
        return std::floor(center / Exact(texel) - Exact(map_size) / 2 + Exact(0.5));
    };
    Exact const x = lower_left(basis.x), y = lower_left(basis.y);
    Exact const reach = std::fmax(std::abs(x), std::abs(y)) + Exact(map_size);
    // Four roundings of a coordinate lie between a world point and its texel: 2^-6 / 4.
    if (!(reach * Exact(eps) <= Exact(1) / 256)) grid.faults |= Fault::precision_lost;
    constexpr Exact whole_numbers = Exact(std::int64_t(1) << 52);
    if (!(reach < whole_numbers) || !(texel >= detail::least_metres<T>) ||
        !(sphere.radius <= detail::farthest_metres<T>))
        return grid;
    grid.basis = basis;
    grid.x = static_cast<std::int64_t>(x);
    grid.y = static_cast<std::int64_t>(y);
    grid.texel_metres = texel;
    grid.map_size = map_size;
    grid.visible = true;
    return grid;
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
    T const bend = w_plane / w_point;
    T const tilt = (point_normal_to_eye / plane_normal_to_eye) * (plane_normal_to_light / point_normal_to_light);
    T const result = std::abs(tilt * bend * bend * bend);
    return is_positive(result) ? result : T(0);
}

}  // namespace closed_form
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
    Vec4<T> const clip = matrix * Vec4<T>(point, T(1));
    if (!(clip.w > T(0)) || !(clip.w > w_min)) return {};
    Vec3<T> const at = Vec3<T>(clip) / clip.w;
    if (!all_finite(at) || !all_finite(&clip.w, 1)) return {};
    return {at, clip.w, true};
}

// The change of `at` for a metre along `direction`, to first order.
template <class T>
[[nodiscard]] inline Vec3<T> gain_along(Mat4<T> const& matrix, Projected<T> const& point,
                                        Vec3<T> const& direction) noexcept {
    Vec4<T> const clip = matrix * Vec4<T>(direction, T(0));
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
    if (!(largest > T(0)) || !all_finite(&largest, 1) || !all_finite(s) || !all_finite(t)) return {};
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
    Projected<T> const at = projected(map.clip_from_world, point, map.w_min);
    if (!at.in_front) return {};
    // Along a light ray neither x nor y of NDC changes: it is at a right angle to both of these.
    Vec3<T> const w(row(map.clip_from_world, 3));
    Vec3<T> const x = Vec3<T>(row(map.clip_from_world, 0)) - at.at.x * w;
    Vec3<T> const y = Vec3<T>(row(map.clip_from_world, 1)) - at.at.y * w;
    return slope(map, map_size, point, glm::cross(safe_normalize(x).direction, safe_normalize(y).direction), limit);
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

// ======== shadowmath/culling.hpp ========
//
// Which maps an object must be drawn into: a bit for each, and the range [first, last] that one instanced draw covers.
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

namespace detail {

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
    return value < 0x1p60L ? 0 : ~std::uint64_t(0);
}

template <class T>
[[nodiscard]] inline bool all_in_reach(Vec3<T> const& v) noexcept {
    return all_finite(v) && largest_of(v) < T(0x1p60);
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
                                                                     Reaches<T> const& reach, int place) noexcept {
    bool const inside = (reach.left >= bundle.least[0][place]) & (reach.right >= bundle.least[1][place]) &
                        (reach.bottom >= bundle.least[2][place]) & (reach.top >= bundle.least[3][place]) &
                        (reach.last >= bundle.least[4][place]);
    return inside ? bundle.bit[place] : 0u;
}

template <class T>
[[nodiscard, gnu::always_inline]] inline std::uint32_t bits_inside(typename CasterMaps<T>::Bundle const& bundle,
                                                                   Reaches<T> const& reach) noexcept {
    return bit_if_inside<T>(bundle, reach, 0) | bit_if_inside<T>(bundle, reach, 1) |
           bit_if_inside<T>(bundle, reach, 2) | bit_if_inside<T>(bundle, reach, 3);
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

// One block of boxes; does nothing where a box is not in reach, and says so.
template <class T>
struct MaskBlock {
    CasterMaps<T> const& maps;
    BoxArrays<T> const& boxes;
    MapMask* masks;
    bool& in_reach;

    [[gnu::always_inline]] inline void operator()() const noexcept {
        constexpr int n = boxes_at_once;
        T grown[n], first_x[n], first_y[n], first_z[n], last_x[n], last_y[n], last_z[n];
        std::uint32_t mask[n], full[n];  // full: all ones, or zero for an empty box
        decltype(beyond_reach(T(0))) beyond = 0;
        for (int i = 0; i < n; ++i) {
            T const sizes = std::abs(boxes.lo_x[i]) + std::abs(boxes.hi_x[i]) + std::abs(boxes.lo_y[i]) +
                            std::abs(boxes.hi_y[i]) + std::abs(boxes.lo_z[i]) + std::abs(boxes.hi_z[i]);
            beyond |= beyond_reach(sizes);
            grown[i] = box_slack<T> * sizes;
            mask[i] = 0;
        }
        in_reach = beyond >> (8 * sizeof beyond - 1) == 0;
        if (!in_reach) return;
        for (int i = 0; i < n; ++i) {
            T const lo_x = boxes.lo_x[i], lo_y = boxes.lo_y[i], lo_z = boxes.lo_z[i];
            T const hi_x = boxes.hi_x[i], hi_y = boxes.hi_y[i], hi_z = boxes.hi_z[i];
            full[i] = ((lo_x <= hi_x) & (lo_y <= hi_y) & (lo_z <= hi_z)) ? ~0u : 0u;
            first_x[i] = lo_x - grown[i];
            first_y[i] = lo_y - grown[i];
            first_z[i] = lo_z - grown[i];
            last_x[i] = hi_x + grown[i];
            last_y[i] = hi_y + grown[i];
            last_z[i] = hi_z + grown[i];
        }
        for (int b = 0; b < maps.bundle_count; ++b) {
            typename CasterMaps<T>::Bundle const bundle = maps.bundle[b];
            struct Side {
                Vec3<T> normal;
                T const *x, *y, *z;  // the end of the boxes that lies farther along it
                [[gnu::always_inline]] T operator()(int i) const noexcept {
                    return normal.x * x[i] + normal.y * y[i] + normal.z * z[i];
                }
            };
            auto const side_of = [&](Vec3<T> const& normal) {
                return Side{normal, normal.x > T(0) ? last_x : first_x, normal.y > T(0) ? last_y : first_y,
                            normal.z > T(0) ? last_z : first_z};
            };
            Side const left = side_of(bundle.normal[0]), right = side_of(bundle.normal[1]);
            Side const bottom = side_of(bundle.normal[2]), top = side_of(bundle.normal[3]);
            Side const end = side_of(bundle.normal[4]);
            for (int i = 0; i < n; ++i)
                mask[i] |= bits_inside<T>(bundle, {left(i), right(i), bottom(i), top(i), end(i)});
        }
        for (int i = 0; i < n; ++i) masks[i] = static_cast<MapMask>(mask[i] & full[i]);
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
    auto const from = [&boxes](int i) {
        return BoxArrays<T>{boxes.lo_x + i, boxes.lo_y + i, boxes.lo_z + i,
                            boxes.hi_x + i, boxes.hi_y + i, boxes.hi_z + i};
    };
    constexpr int n = detail::boxes_at_once;
    for (int begin = 0; begin < count; begin += n) {
        BoxArrays<T> const block = from(begin);
        int const length = count - begin < n ? count - begin : n;
        bool in_reach = false;
        if (length == n) detail::run_widely(detail::MaskBlock<T>{maps, block, masks + begin, in_reach});
        if (in_reach) continue;
        for (int i = 0; i < length; ++i)
            masks[begin + i] = caster_mask(maps, Aabb<T>{Vec3<T>(block.lo_x[i], block.lo_y[i], block.lo_z[i]),
                                                         Vec3<T>(block.hi_x[i], block.hi_y[i], block.hi_z[i])});
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
    if (!(scale > T(0)) || !all_finite(&scale, 1)) return {};
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
    T const stretch = (std::hypot(a + d, c - b) + std::hypot(a - d, c + b)) * T(0.5);
    T const pixels_per_texel = bounded_quotient(eye.scale, map.scale, limit * limit);
    T const major = bounded_quotient(stretch * pixels_per_texel, std::abs(map_det), limit);
    T const minor = bounded_quotient(std::abs(eye_det) * pixels_per_texel, stretch, limit);
    return {major, minor < major ? minor : major};
}

}  // namespace v0
}  // namespace shadowmath

// ======== shadowmath/cascades.hpp ========
//
// The one call: a view, a light and two boxes in; one matrix a cascade out.
//
//   view ── splits ── slices ─┬─ fit ── depth range ── matrix
//   light ── basis ───────────┘
//
//   stable      bounding sphere on a texel grid: nothing shimmers when the camera moves or turns
//   tight       light-space box: up to twice the texels, and shadow edges crawl under motion
//   rectangle   the smallest rectangle at any angle: a quarter fewer metres than tight
//   focus       the smallest around what can be seen in shadow: receivers in view that casters are above
//
// Use `stable` unless the camera never moves or a temporal filter hides the crawl. Every step is a header of its own,
// so a renderer that needs another order calls them itself.
//
// Source: Zhang, Sun, Nyman, GPU Gems 3 chapter 10. Departures: corners come from the sides of the view, not from an
// inverse matrix; maps are fitted to each slice directly, not cropped out of one common light projection; the stable
// fit is the minimal sphere, and its grid has integer origins.

namespace shadowmath {
inline namespace v0 {

enum class CascadeFit : std::uint8_t { stable, tight, rectangle, focus };

template <class T>
struct CascadeOptions {
    int count = 4;        // maps, 1 to max_splits
    int map_size = 2048;  // texels along one side of each
    CascadeFit fit = CascadeFit::stable;
    T lambda = T(0.5);         // of the practical splits: 1 logarithmic, 0 uniform
    T first_split_end = T(0);  // metres of eye depth at which the first split ends; 0: wherever lambda puts it
    T shadow_distance = T(0);  // metres of eye depth up to which shadows are wanted; 0: the view's far distance
    T blend = T(0.1);          // fraction of each slice that fades into the next; 0: hard seams
    int filter_radius = 1;     // half width of the PCF kernel, texels: 0, 1 (3x3), 2 (5x5), ...
    bool pancake = false;      // true: near plane at the slice, and the renderer turns depth clamp ON
    ClipSpace clip = gl_clip;  // the convention of the pass that draws the maps
};

template <class T>
struct Cascade {
    ShadowMap<T> map;
    SliceRange<T> range;    // metres of eye depth that it serves
    T texel_metres = T(0);  // across the light; 0 of a spot, whose texels grow with distance
    T depth_metres = T(0);  // along the light, from depth 0 to depth 1; 0 of a spot
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
[[nodiscard]] inline int kernel_radius(CascadeOptions<T> const& options, Faults& faults) noexcept {
    int const quarter = options.map_size > 0 ? options.map_size / 4 : 0, most = quarter < 64 ? quarter : 64;
    int const radius = options.filter_radius < 0 ? 0 : (options.filter_radius > most ? most : options.filter_radius);
    if (radius != options.filter_radius) faults |= Fault::clamped_option;
    return radius;
}

template <class T>
inline void fit_stable(Cascade<T>& cascade, ViewVolume<T> const& part, LightBasis<T> const& basis,
                       DepthRange<T> const& slice_depth, Aabb<T> const& casters, Aabb<T> const& receivers,
                       T margin_texels, CascadeOptions<T> const& options) noexcept {
    TexelGrid<T> const grid = texel_grid(basis, bounding_sphere(part), options.map_size, margin_texels);
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

// `previous_x`: of the map's x axis in the last frame.
template <class T>
inline void fit_directional(Cascade<T>& cascade, ViewVolume<T> const& part, Light<T> const& light,
                            Vec3<T> const& previous_x, Aabb<T> const& casters, Aabb<T> const& receivers,
                            T margin_texels, CascadeOptions<T> const& options) noexcept {
    LightBasis<T> const basis = light_basis(light.direction);
    std::array<Vec3<T>, 8> const body = corners(part);
    LightBox<T> sides = fit_box(basis, body, options.map_size, margin_texels);
    DepthRange<T> depth{sides.depth_lo, sides.depth_hi, true};
    if (options.fit == CascadeFit::stable) {
        fit_stable(cascade, part, basis, depth, casters, receivers, margin_texels, options);
        return;
    }
    if (options.fit == CascadeFit::focus) {
        Focus<T> const focus = focus_of(part, light, casters, receivers);
        if (!focus.visible) return;
        sides = fit_rectangle(basis, focus.receivers, options.map_size, margin_texels, previous_x);
        depth = focus.depth;
        if (options.pancake) depth.lo = focus.first_receiver;
    } else {
        if (options.fit == CascadeFit::rectangle)
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

}  // namespace detail

// Every point that the eye can see up to the shadow distance and that lies in `receivers` is inside the map of its
// slice, filter margin included, in any clip convention; every caster of `casters` on its way to the light is in that
// map. With CascadeFit::stable and an unmoving light, a world point keeps its place within a texel whatever the camera
// does. With CascadeFit::focus, points that no ray of light reaches through `casters` are left out; they read as lit.
// `casters` and `receivers` are world boxes; either empty: no map is visible, and that is no fault. `previous`, if not
// null: the last frame's, whose angles rectangles keep while they are nearly as good.
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
        Cascade<T>& cascade = cascades.at[i];
        cascade.range = slice_range(splits, i, blend);
        cascade.map.clip = options.clip;
        ViewVolume<T> const part = slice(seen, cascade.range);
        if (is_empty(casters) || is_empty(receivers)) continue;
        if (light.kind == LightKind::directional) {
            bool const has_previous = previous != nullptr && i < previous->count && previous->at[i].map.visible;
            Vec3<T> const x = has_previous ? Vec3<T>(row(previous->at[i].map.clip_from_world, 0)) : Vec3<T>(T(0));
            detail::fit_directional(cascade, part, light, x, casters, receivers, margin_texels, options);
        } else {
            cascade.map = fit_spot(part, light, casters, receivers, options.map_size, margin_texels, options.clip);
        }
        cascades.faults |= cascade.map.faults;
    }
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

// Light space relative to the eye, metres.
template <class T>
[[nodiscard]] inline Vec3<T> from_eye(SampleRays<T> const& rays, int x, int y, T depth) noexcept {
    Vec2<T> const side = rays.first + rays.step * Vec2<T>(T(x), T(y));
    Vec3<T> const aside = rays.right * side.x + rays.up * side.y;
    return rays.kind == ViewKind::perspective ? (rays.forward + aside) * depth : rays.forward * depth + aside;
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
inline constexpr int depth_bins_an_octave = 32;

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

// The bits of a positive float grow with it, evenly in each octave: exponent and 5 bits of mantissa are its bin.
template <class T>
[[nodiscard]] inline int depth_key(T depth) noexcept {
    float const value = static_cast<float>(depth);
    std::uint32_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    return static_cast<int>(bits >> 18);
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
    T least = all_finite(&least_ratio, 1) ? least_ratio : T(1.05);
    least = least < T(1.0001) ? T(1.0001) : (least > T(1 << 20) ? T(1 << 20) : least);
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
// Sample-distribution shadow maps: cascades fitted to what the eye sees, pixel by pixel, instead of to all that it could
// see. Indoors, over a plain, down a street they give several times the texels of the best fit to the view volume. Use
// them when the eye's depth is at hand before the maps are drawn: from a depth prepass, or from the frame before (then
// widen the boxes by what may have moved).
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

// Metres along the light, from the world origin, at which the rays between the sides lo and hi (light space) enter the
// box: nothing of it lies before. Never later than the truth, and earlier by what the box's faces rise across the
// sides. Above the far side of the box for rays that pass it by.
template <class T>
[[nodiscard]] inline T light_entry(LightBasis<T> const& basis, Vec2<T> const& lo, Vec2<T> const& hi,
                                   Aabb<T> const& box) noexcept {
    T entry = -detail::farthest_metres<T>;
    for (int k = 0; k < 3; ++k) {
        T const along = basis.depth[k];
        // Faces that the light runs along stop nothing.
        if (!(std::abs(along) > T(1e-4))) continue;
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
    Aabb<T> const body{box.lo + rays.eye, box.hi + rays.eye};
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

// Share of the kernel that texel `tap` (-radius to radius from the one that holds the point) covers along one axis,
// when the point lies the `fraction` [0, 1) into its texel. The taps of an axis sum to 1.
template <class T>
[[nodiscard]] constexpr T tap_weight(int tap, int radius, T fraction) noexcept {
    if (radius == 0) return T(1);
    T const covered = tap == -radius ? T(1) - fraction : (tap == radius ? fraction : T(1));
    return covered / T(2 * radius);
}

// A receiver as the map sees it.
template <class T>
struct Receiver {
    Vec2<T> texel{T(0)};  // from texture u = v = 0
    T depth = T(0);       // stored depth, already moved toward the light by its bias
    DepthSlope<T> slope;  // on its plane
};

// Share of light that reaches the receiver, in [0, 1]: the weighted part of taps with nothing nearer to the light.
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
    T visibility = T(0);
    for (int j = -radius; j <= radius; ++j) {
        for (int i = -radius; i <= radius; ++i) {
            T const weight = tap_weight(i, radius, fraction.x) * tap_weight(j, radius, fraction.y);
            Vec2<T> const to_tap = Vec2<T>(T(i), T(j)) + T(0.5) - fraction;
            T const rise = options.tap_plane ? receiver.slope.x * to_tap.x + receiver.slope.y * to_tap.y : T(0);
            if (is_lit(home_x + i, home_y + j, receiver.depth + rise)) visibility += weight;
        }
    }
    return visibility < T(1) ? visibility : T(1);
}

// What a receiver shader does for one map: project the point and the plane through it, subtract the bias, filter. 1
// where the map does not hold the point. `normal` is the surface's own, not the interpolated one.
template <class T, class StoredDepth>
[[nodiscard]] inline T visibility(ShadowMap<T> const& map, int map_size, Vec3<T> const& point, Vec3<T> const& normal,
                                  MapBias<T> const& bias, FilterOptions options,
                                  StoredDepth const& stored_depth) noexcept {
    if (!map.visible || map_size < 1 || !all_finite(map.clip_from_world)) return T(1);
    Projected<T> const at = projected(texture_from_world(map), point, map.w_min);
    if (!at.in_front) return T(1);
    DepthSlope<T> const on_plane = slope(map, map_size, point, normal, bias.slope_limit);
    DepthSlope<T> const own = options.tap_plane ? lean(map, map_size, point, bias.slope_limit) : DepthSlope<T>{};
    T const toward_light = depth_bias(bias, at.w, {on_plane.x - own.x, on_plane.y - own.y});
    bool const reversed_depth = map.clip.depth == DepthOrder::one_to_zero;
    T const depth = reversed_depth ? at.at.z + toward_light : at.at.z - toward_light;
    return filtered(Receiver<T>{Vec2<T>(at.at) * T(map_size), depth, on_plane}, map_size, map.clip, options,
                    stored_depth);
}

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
