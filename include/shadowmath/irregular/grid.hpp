// SPDX-License-Identifier: MIT
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
#pragma once

#include <shadowmath/clip_space.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/fault.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/irregular/buffer.hpp>
#include <shadowmath/irregular/edge.hpp>
#include <shadowmath/irregular/lanes.hpp>
#include <shadowmath/irregular/lists.hpp>
#include <shadowmath/irregular/microquad.hpp>
#include <shadowmath/irregular/tile.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/reach.hpp>
#include <shadowmath/shadow_map.hpp>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

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
