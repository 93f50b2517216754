// SPDX-License-Identifier: MIT
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
#pragma once

#include <cstdint>

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
