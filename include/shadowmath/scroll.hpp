// SPDX-License-Identifier: MIT
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
#pragma once

#include <shadowmath/config.hpp>
#include <shadowmath/shadow_map.hpp>
#include <shadowmath/texel_grid.hpp>

#include <array>
#include <cstdint>

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
