// SPDX-License-Identifier: MIT
//
// What was wrong with the data, and which fallback was taken: a set of bits inside every result.
//
// Data (whatever a level, a configuration file, a window or a user can produce) never aborts and never poisons. A
// result says `visible` when its matrix serves something; `faults` says why not, or what was mended on the way.
// A result may be visible with faults (mended), and invisible without any (there was simply nothing to see).
#pragma once

#include <cstdint>

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
