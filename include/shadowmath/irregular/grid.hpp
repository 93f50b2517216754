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
#include <shadowmath/irregular/edge.hpp>
#include <shadowmath/irregular/lanes.hpp>
#include <shadowmath/irregular/mask.hpp>
#include <shadowmath/irregular/microquad.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/reach.hpp>
#include <shadowmath/shadow_map.hpp>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

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

    // Tiles: sixteen pixels each, four rows of four.
    T* quad = nullptr;               // q less the tile's, q_x, q_y: three times sixteen
    T* tile_q = nullptr;             // near the q of its pixels: what differs from it is known to far more digits
    std::uint32_t* mask = nullptr;   // sixteen
    std::uint32_t* state = nullptr;  // bit k: light may reach pixel k, and a sample of it is not yet covered; and one
                                     // more than the index of the triangle that was tested last

    // Nodes, sorted by list: bounds in texels of the finest level, the far end of the depths, the tile.
    T* lo_x = nullptr;
    T* hi_x = nullptr;
    T* lo_y = nullptr;
    T* hi_y = nullptr;
    T* depth = nullptr;
    std::uint32_t* tile = nullptr;
    std::uint32_t* first = nullptr;  // node of each list, one more at the end

    // Texels of the finest level.
    T* texel_depth = nullptr;                 // far end over the nodes that touch it
    std::uint32_t* texel_levels = nullptr;    // bit l: level l has a node here
    std::uint32_t* texel_lists = nullptr;     // place in `first`: nodes too wide for its divisions, then the divisions
    std::uint32_t* texel_division = nullptr;  // k: it is divided into 2^k x 2^k; in the making, how many nodes touch it

    // For trace: triangles are put in order of their texels, a block at a time.
    std::uint32_t* block_texel = nullptr;
    std::uint32_t* block_order = nullptr;
    std::uint32_t* block_count = nullptr;

    // Over all nodes.
    T least_x = T(0), most_x = T(0), least_y = T(0), most_y = T(0), most_depth = T(0), least_w = T(0), most_w = T(0);

    ListCounts counts;
    Faults faults;
};

// Texels along a side of the level.
[[nodiscard]] constexpr int level_size(int map_size, int level) noexcept {
    return ((map_size - 1) >> level_shift * level) + 1;
}

inline constexpr int caster_block = 1 << 15;

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
    // Behind each array of nodes sixteen more can be read. Every four nodes that touch a texel pay for a division.
    std::size_t const nodes = 4 * parts + lane_count;
    return {(3 * lane_count + 1) * tiles + 5 * nodes + 5 * parts + texels,
            (lane_count + 2) * tiles + nodes + 3 * parts + (2 * texels + coarser + parts + 2) + 4 * texels + 2 +
                2 * caster_block};
}

namespace detail {

[[nodiscard]] inline int lowest_bit(std::uint32_t bits) noexcept {
#if defined(__GNUC__)
    return __builtin_ctz(bits);
#else
    int place = 0;
    while ((bits >> place & 1u) == 0) ++place;
    return place;
#endif
}

// The parts of a buffer that only its making sees.
template <class T>
struct Parts {
    T* bounds = nullptr;             // lo x, hi x, lo y, hi y, depth of each
    std::uint32_t* place = nullptr;  // tile and level; first and last place in x, in y, 16 bits each
    std::uint32_t capacity = 0;
};

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
        while (k < most_divisions && (std::uint32_t(16) << 2 * k) <= nodes) ++k;
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

// False where the nodes are more than four for each part that there is room for.
template <class T>
[[nodiscard]] inline bool sort_parts(IrregularBuffer<T>& buffer, Parts<T> const& parts) noexcept {
    std::uint32_t const lists = divide_texels(buffer);
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
    for (std::uint32_t i = 0; i < counts.parts; ++i) {
        T const* const bounds = parts.bounds + 5 * i;
        std::uint32_t const tile = parts.place[3 * i] & 0x0fffffffu;
        for_each_list(buffer, parts.place + 3 * i, [&](std::uint32_t list) {
            std::uint32_t const node = end[list]++;
            buffer.lo_x[node] = bounds[0];
            buffer.hi_x[node] = bounds[1];
            buffer.lo_y[node] = bounds[2];
            buffer.hi_y[node] = bounds[3];
            buffer.depth[node] = bounds[4];
            buffer.tile[node] = tile;
        });
    }
    return true;
}

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
    };

    // The normal's three components and the depth, or the place relative to the eye, into lanes.
    void gather(int column, int row, T (&into)[6][lane_count]) const noexcept {
        PixelFrame<T> const& frame = buffer.frame;
        auto const normal_stride = static_cast<std::size_t>(receivers.normal_stride);
        auto const position_stride = static_cast<std::size_t>(receivers.position_stride);
        int const columns = buffer.rect.x + buffer.rect.width - column, rows = buffer.rect.y + buffer.rect.height - row;
        for (int j = 0; j < tile_side; ++j) {
            std::size_t const pixel =
                static_cast<std::size_t>(row + (j < rows ? j : 0)) * static_cast<std::size_t>(frame.width) +
                static_cast<std::size_t>(column);
            for (int i = 0; i < tile_side; ++i) {
                std::size_t const at = pixel + static_cast<std::size_t>(i < columns ? i : 0);
                int const k = j * tile_side + i;
                T const* const n = receivers.normal + at * normal_stride;
                into[0][k] = n[0];
                into[1][k] = n[1];
                into[2][k] = n[2];
                if (receivers.position != nullptr) {
                    T const* const p = receivers.position + at * position_stride;
                    into[3][k] = p[0] - frame.eye.x;
                    into[4][k] = p[1] - frame.eye.y;
                    into[5][k] = p[2] - frame.eye.z;
                } else {
                    into[3][k] = receivers.depth[at];
                }
            }
        }
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

    void see(int tile, int column, int row, Seen& seen) const noexcept {
        PixelFrame<T> const& frame = buffer.frame;
        auto const all = [](T value) { return Lanes::all(value); };
        T in[6][lane_count];
        gather(column, row, in);
        Lanes const zero = all(T(0)), one = all(T(1)), half = all(T(0.5)), tiny = all(std::numeric_limits<T>::min());
        Lanes const x = all(T(column) - T(frame.width) / T(2)) + column_in_tile;
        Lanes const y = all(T(row) - T(frame.height) / T(2)) + row_in_tile;
        Lanes const m[3] = {Lanes::load(in[0]), Lanes::load(in[1]), Lanes::load(in[2])};
        auto const dot = [&all](Vec3<T> const& v, Lanes const(&a)[3]) {
            return fused(all(v.x), a[0], fused(all(v.y), a[1], all(v.z) * a[2]));
        };
        Lanes depth = Lanes::load(in[3]);
        if (receivers.position != nullptr) {
            Lanes const p[3] = {depth, Lanes::load(in[4]), Lanes::load(in[5])};
            depth = dot(frame.to_inward, p);
        }
        Lanes const nx = dot(frame.across, m), ny = dot(frame.upward, m), nz = dot(frame.inward, m);

        // The quad; see micro_quad, of which these are the lanes.
        Lanes const toward_middle = flat ? nz : fused(nx, x + half, fused(ny, y + half, nz));
        Lanes const facing = flat ? zero - nz : toward_middle;
        Lanes const steep = (absolute(nx) + absolute(ny)) * all(turn);
        Lanes const divisor = with_sign_of(most(absolute(facing), steep), facing);
        // A comparison with NaN is false.
        Lanes const largest_number = all(std::numeric_limits<T>::max());
        std::uint32_t sound = at_least(absolute(divisor), tiny);
        if (!flat) sound &= at_least(depth, tiny);
        Lanes const scale = one / chosen(sound, flat ? divisor : divisor * depth, one);
        Lanes const q_x = nx * scale, q_y = ny * scale;
        Lanes const middle = flat ? depth : divisor * scale, to_corner = (q_x + q_y) * half;
        Lanes const q = middle - to_corner;
        sound &= at_least(largest_number, absolute(q) + absolute(q_x) + absolute(q_y));
        sound &= lanes_inside(buffer.rect.x + buffer.rect.width - column, buffer.rect.y + buffer.rect.height - row);
        seen.alive = seen.away = 0;
        if (sound == 0) return;

        // Light and eye on the same side?
        Lanes travel =
            fused(nx, all(buffer.light.at.x), fused(ny, all(buffer.light.at.y), nz * all(buffer.light.at.z)));
        if (!buffer.light.parallel)
            travel = (flat ? fused(nx, x + half, fused(ny, y + half, nz * depth)) : depth * facing) - travel;
        Lanes const under = zero - tiny;
        std::uint32_t const lit = (at_least(travel, tiny) & at_least(toward_middle, tiny)) |
                                  (at_least(under, travel) & at_least(under, toward_middle));
        seen.away = sound & ~lit;
        sound &= lit;
        if (sound == 0) return;

        // The four corners as the light sees them. Before an eye of perspective, values are over the depth.
        Lanes at[4], gain_x[4], gain_y[4];
        for (int i = 0; i < 4; ++i) {
            PixelPlane<T> const& p = plane[i];
            at[i] = fused(all(p.x), x, fused(all(p.y), y, fused(all(p.b), q, all(p.a))));
            gain_x[i] = fused(all(p.b), q_x, all(p.x));
            gain_y[i] = fused(all(p.b), q_y, all(p.y));
        }
        Lanes steepest = zero;
        for (int corner = 0; corner < 4; ++corner) {
            Lanes value[4], q_here = q;
            for (int i = 0; i < 4; ++i) {
                value[i] = (corner & 1) != 0 ? at[i] + gain_x[i] : at[i];
                if ((corner & 2) != 0) value[i] = value[i] + gain_y[i];
            }
            if ((corner & 1) != 0) q_here = q_here + q_x;
            if ((corner & 2) != 0) q_here = q_here + q_y;
            sound &= at_least(value[3], tiny) & ~at_least(flat ? all(w_min) : all(w_min) * q_here, value[3]);
            Lanes const inverse = reciprocal(chosen(sound, value[3], one));
            Lanes const tx = value[0] * inverse, ty = value[1] * inverse, tz = value[2] * inverse;
            Lanes const w = affine ? one : flat ? value[3] : value[3] * reciprocal(chosen(sound, q_here, one));
            seen.lo_x = corner == 0 ? tx : least(seen.lo_x, tx);
            seen.hi_x = corner == 0 ? tx : most(seen.hi_x, tx);
            seen.lo_y = corner == 0 ? ty : least(seen.lo_y, ty);
            seen.hi_y = corner == 0 ? ty : most(seen.hi_y, ty);
            seen.depth = corner == 0 ? tz : most(seen.depth, tz);
            seen.lo_w = corner == 0 ? w : least(seen.lo_w, w);
            seen.hi_w = corner == 0 ? w : most(seen.hi_w, w);
            steepest = most(steepest, inverse);
        }
        // What rounding may add, so that no triangle misses a texel.
        Lanes const ray = all(buffer.contact_ray);
        Lanes const reach = flat ? all(buffer.contact_reach) + absolute(q) + absolute(q_x) + absolute(q_y) : ray;
        Lanes const here = flat ? one : absolute(q) + absolute(q_x) + absolute(q_y);
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
        seen.alive = sound & at_least(largest_number, span + absolute(seen.depth));

        T* const quads = buffer.quad + 3 * lane_count * static_cast<std::size_t>(tile);
        // The division once more, without its rounding.
        T const tile_q = buffer.tile_q[tile] = middle_of(seen.alive, q);
        T rest[lane_count];
        (flat ? middle : chosen(seen.alive, depth, one)).store(rest);
        for (T& r : rest) r = static_cast<T>((flat ? Wider<T>(r) : Wider<T>(1) / Wider<T>(r)) - Wider<T>(tile_q));
        Lanes const exact = Lanes::load(rest);
        chosen(seen.alive, exact - to_corner, zero).store(quads);
        chosen(seen.alive, q_x, zero).store(quads + lane_count);
        chosen(seen.alive, q_y, zero).store(quads + 2 * lane_count);
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
        if (pixels_across > 1) {
            T const width = bounds[1] - bounds[0], height = bounds[3] - bounds[2];
            T const extent = width > height ? width : height;
            if (extent > T(1)) {
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
    std::size_t const by_words = (storage.size.words - least.words) / 8;
    std::size_t const capacity = 1 + (by_scalars < by_words ? by_scalars : by_words);
    // Nodes are counted with 32 bits, tiles with 28.
    parts.capacity = static_cast<std::uint32_t>(capacity < 1u << 28 ? capacity : 1u << 28);
    auto const tiles = static_cast<std::size_t>(buffer.tile_count);
    auto const texels = static_cast<std::size_t>(buffer.map_size) * static_cast<std::size_t>(buffer.map_size);
    std::size_t const nodes = 4 * std::size_t{parts.capacity} + lane_count;
    T* scalars = storage.scalars;
    std::uint32_t* words = storage.words;
    auto const take = [](auto*& from, std::size_t count) {
        auto* const taken = from;
        from += count;
        return taken;
    };
    buffer.quad = take(scalars, 3 * lane_count * tiles);
    buffer.tile_q = take(scalars, tiles);
    for (T** array : {&buffer.lo_x, &buffer.hi_x, &buffer.lo_y, &buffer.hi_y, &buffer.depth})
        *array = take(scalars, nodes);
    buffer.texel_depth = take(scalars, texels);
    parts.bounds = scalars;
    buffer.mask = take(words, lane_count * tiles);
    buffer.state = take(words, 2 * tiles);
    buffer.tile = take(words, nodes);
    for (std::uint32_t** array : {&buffer.texel_levels, &buffer.texel_lists, &buffer.texel_division})
        *array = take(words, texels);
    buffer.block_count = take(words, texels + 2);
    buffer.block_texel = take(words, caster_block);
    buffer.block_order = take(words, caster_block);
    parts.place = take(words, 3 * std::size_t{parts.capacity});
    buffer.first = words;
    std::memset(buffer.texel_levels, 0, texels * sizeof(std::uint32_t));
    std::memset(buffer.texel_division, 0, texels * sizeof(std::uint32_t));
    for (std::size_t texel = 0; texel < texels; ++texel) buffer.texel_depth[texel] = std::numeric_limits<T>::lowest();
    return parts;
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

    T columns[lane_count], rows[lane_count];
    for (int k = 0; k < lane_count; ++k) {
        columns[k] = T(k % tile_side);
        rows[k] = T(k / tile_side);
    }
    Vec4<T> const* const row = buffer.row;
    detail::TileKernel<Lanes> const kernel{buffer,
                                           receivers,
                                           {detail::plane_of_row(frame, row[0]), detail::plane_of_row(frame, row[1]),
                                            detail::plane_of_row(frame, row[2]), detail::plane_of_row(frame, row[3])},
                                           grid.w_min > T(0) ? grid.w_min : T(0),
                                           detail::turn_limit(frame),
                                           Lanes::load(columns),
                                           Lanes::load(rows),
                                           flat,
                                           Vec3<T>(row[3]) == Vec3<T>(T(0)) && row[3].w == T(1)};
    Lanes const huge = Lanes::all(largest_number), low = Lanes::all(-largest_number);
    Lanes least_w = huge, most_w = low;
    typename detail::TileKernel<Lanes>::Seen seen;
    for (int tile = 0; tile < buffer.tile_count; ++tile) {
        kernel.see(tile, rect.x + tile % buffer.tiles_across * tile_side,
                   rect.y + tile / buffer.tiles_across * tile_side, seen);
        std::uint32_t* const mask = buffer.mask + static_cast<std::size_t>(tile) * lane_count;
        for (unsigned k = 0; k < lane_count; ++k) mask[k] = 0u - (seen.away >> k & 1u);
        buffer.state[2 * tile] = seen.alive;
        buffer.state[2 * tile + 1] = 0;
        if (seen.alive == 0) continue;
        ++buffer.counts.tiles;
        least_w = least(least_w, chosen(seen.alive, seen.lo_w, huge));
        most_w = most(most_w, chosen(seen.alive, seen.hi_w, low));
        kernel.insert(parts, tile, seen, seen.alive, tile_side);
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
