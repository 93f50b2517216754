// SPDX-License-Identifier: MIT
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
#pragma once

#include <shadowmath/config.hpp>

#include <cstdint>

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
