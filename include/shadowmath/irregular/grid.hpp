// SPDX-License-Identifier: MIT
//
// The irregular z-buffer: the receivers of a picture, sorted by where the light sees them. Any matrix of this library
// may be the grid. It decides how long the lists are, and so the speed; the answer is the same for all.
//
// A node is a tile of 4 x 4 pixels, or a part of one where the tile straddles a silhouette, with bounds as the light
// sees it. Each is listed in every texel that its footprint touches, at the level whose texels are as large as the
// footprint: never more than 2 x 2, however the picture and the map differ in scale. A counting sort lays the lists of
// a row of texels end to end, in the order of the picture; so what a triangle may cover is one run a row.
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
#include <shadowmath/shadow_map.hpp>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

namespace shadowmath {
inline namespace v0 {

inline constexpr int tile_side = 4;
inline constexpr int most_levels = 16;

// What the eye sees, row by row, `width` pixels each. Sky is a pixel whose normal is zero, whose depth is not positive,
// or of which anything is not finite.
template <class T>
struct Receivers {
    T const* position = nullptr;  // world; three scalars a pixel, `position_stride` apart
    int position_stride = 3;
    T const* depth = nullptr;     // instead of positions: metres along the view's forward axis, one a pixel
    T const* normal = nullptr;    // of the surface, not for shading; any length and sign
    int normal_stride = 3;
};

// What the lists of a buffer came to.
struct ListCounts {
    std::uint32_t tiles = 0;     // with a pixel that light may reach
    std::uint32_t parts = 0;     // tiles, and parts of those that straddle a silhouette: what `capacity` must hold
    std::uint32_t nodes = 0;
    std::uint32_t lists = 0;     // texels that are not empty
    std::uint32_t longest = 0;   // nodes in one texel
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

template <class T>
struct IrregularBuffer {
    PixelFrame<T> frame;
    PixelLight<T> light;
    Vec4<T> row[4];            // texel x, texel y, depth, w of a point relative to the eye
    T texel_error = T(0);      // rounding of a texel coordinate times w, for a metre from the eye
    T depth_error = T(0);
    T texel_error_here = T(0); // and whatever the distance
    T depth_error_here = T(0);
    T contact_reach = T(0);    // metres from the world's origin to the eye, twice, and
    T contact_ray = T(0);      // the longest ray of the picture at depth 1: margins of contact, see trace.hpp
    int first_row = 0;         // of the picture
    int row_count = 0;
    int tiles_across = 0;
    int tile_count = 0;
    int map_size = 0;
    int level_count = 0;
    std::uint32_t levels_used = 0;               // bit l: level l has a node
    std::uint32_t texels_before[most_levels]{};  // of the finer levels

    // Tiles: sixteen pixels each, four rows of four.
    T* quad = nullptr;                    // q, q_x, q_y: three times sixteen
    std::uint32_t* mask = nullptr;        // sixteen
    std::uint32_t* alive = nullptr;       // bit k: the light may reach pixel k, and a sample of it is not yet covered
    std::uint32_t* last_caster = nullptr; // one more than the index of the triangle that was tested last

    // Nodes, sorted by texel.
    T* lo_x = nullptr;  // bounds in texels of level 0, and depth, of which the far end is kept
    T* hi_x = nullptr;
    T* lo_y = nullptr;
    T* hi_y = nullptr;
    T* depth = nullptr;
    std::uint32_t* tile = nullptr;
    std::uint32_t* first = nullptr;  // node of each texel, all levels end to end; one more at the end

    // Over all nodes.
    T least_x = T(0), most_x = T(0), least_y = T(0), most_y = T(0), most_depth = T(0), least_w = T(0), most_w = T(0);

    ListCounts counts;
    Faults faults;  // not_finite, bad_projection, ..., storage_too_small; nothing is listed then
};

// Texels of the level: half as many along each side as of the finer one, rounded up.
[[nodiscard]] constexpr int level_size(int map_size, int level) noexcept {
    return static_cast<int>((static_cast<std::int64_t>(map_size) + (std::int64_t(1) << level) - 1) >> level);
}

// What a buffer needs for `rows` rows of a picture, a grid of map_size^2 texels and `capacity` parts of tiles. Parts
// are few more than tiles: the default takes twice as many. 16 times as many are always enough.
[[nodiscard]] constexpr StorageSize storage_for(int width, int rows, int map_size, int capacity = 0) noexcept {
    if (width < 1 || rows < 1 || map_size < 1) return {};
    auto const up = [](int pixels) { return (static_cast<std::size_t>(pixels) + 3) / 4; };
    std::size_t const tiles = up(width) * up(rows);
    std::size_t const parts = capacity > 0 ? static_cast<std::size_t>(capacity) : 2 * tiles;
    std::size_t texels = 0;
    for (int level = 0; level < most_levels; ++level) {
        auto const side = static_cast<std::size_t>(level_size(map_size, level));
        texels += side * side;
        if (side == 1) break;
    }
    // Behind each array of nodes sixteen more can be read.
    std::size_t const nodes = 4 * parts + lane_count;
    return {48 * tiles + 5 * parts + 5 * nodes + lane_count, 18 * tiles + 2 * parts + nodes + texels + 2};
}

namespace detail {

// The parts of a buffer that only its making sees.
template <class T>
struct Parts {
    T* bounds = nullptr;              // lo x, hi x, lo y, hi y, depth of each
    std::uint32_t* place = nullptr;   // tile and level
    std::uint32_t capacity = 0;
};

template <class T>
struct TexelRange {
    int x0, x1, y0, y1;
};

template <class T>
[[nodiscard]] inline int texel_of(T coordinate, int size) noexcept {
    // Written so that NaN ends at 0.
    T const last = T(size - 1);
    T const inside = coordinate > T(0) ? coordinate : T(0);
    return static_cast<int>(inside < last ? inside : last);
}

// Texels at a level; what lies beside the map belongs to its border.
template <class T>
[[nodiscard]] inline TexelRange<T> texels_at(T const* bounds, int map_size, int level) noexcept {
    return {texel_of(bounds[0], map_size) >> level, texel_of(bounds[1], map_size) >> level,
            texel_of(bounds[2], map_size) >> level, texel_of(bounds[3], map_size) >> level};
}

template <class T>
inline void add_part(IrregularBuffer<T>& buffer, Parts<T> const& parts, int tile, T const (&bounds)[5]) noexcept {
    std::uint32_t const index = buffer.counts.parts++;
    if (index >= parts.capacity) return;
    T const width = bounds[1] - bounds[0], height = bounds[3] - bounds[2];
    T const extent = width > height ? width : height;
    int level = 0;
    while (level + 1 < buffer.level_count && extent > T(std::int64_t(1) << level)) ++level;
    for (int i = 0; i < 5; ++i) parts.bounds[5 * index + static_cast<std::uint32_t>(i)] = bounds[i];
    parts.place[2 * index] = static_cast<std::uint32_t>(tile);
    parts.place[2 * index + 1] = static_cast<std::uint32_t>(level);
    buffer.levels_used |= 1u << level;
    int const size = level_size(buffer.map_size, level);
    TexelRange<T> const range = texels_at(bounds, buffer.map_size, level);
    std::uint32_t* const count = buffer.first + 2 + buffer.texels_before[level];
    for (int y = range.y0; y <= range.y1; ++y)
        for (int x = range.x0; x <= range.x1; ++x) ++count[y * size + x];
}

template <class T>
inline void sort_parts(IrregularBuffer<T>& buffer, Parts<T> const& parts, std::uint32_t texel_count) noexcept {
    std::uint32_t* const end = buffer.first + 1;
    ListCounts& counts = buffer.counts;
    for (std::uint32_t t = 1; t <= texel_count; ++t) {
        std::uint32_t const length = end[t];
        counts.lists += length > 0 ? 1u : 0u;
        counts.longest = length > counts.longest ? length : counts.longest;
        end[t] = counts.nodes += length;
    }
    for (std::uint32_t i = 0; i < counts.parts; ++i) {
        T const* const bounds = parts.bounds + 5 * i;
        auto const level = static_cast<int>(parts.place[2 * i + 1]);
        int const size = level_size(buffer.map_size, level);
        TexelRange<T> const range = texels_at(bounds, buffer.map_size, level);
        std::uint32_t* const next = end + buffer.texels_before[level];
        for (int y = range.y0; y <= range.y1; ++y)
            for (int x = range.x0; x <= range.x1; ++x) {
                std::uint32_t const node = next[y * size + x]++;
                buffer.lo_x[node] = bounds[0];
                buffer.hi_x[node] = bounds[1];
                buffer.lo_y[node] = bounds[2];
                buffer.hi_y[node] = bounds[3];
                buffer.depth[node] = bounds[4];
                buffer.tile[node] = parts.place[2 * i];
            }
    }
}

// Sixteen pixels of the picture: their quads, whether light may reach them, and where the light sees them.
template <class Lanes, class T = typename Lanes::Scalar>
struct TileKernel {
    IrregularBuffer<T>& buffer;
    Receivers<T> const& receivers;
    PixelPlane<T> plane[4];  // the rows of the map
    T w_min;

    struct Seen {
        std::uint32_t alive = 0;
        std::uint32_t away = 0;
        Lanes lo_x, hi_x, lo_y, hi_y, depth, lo_w, hi_w;
    };

    // Depth and the normal's three components, gathered into lanes. Sky has depth 0.
    void gather(int column, int row, T (&into)[4][lane_count]) const noexcept {
        PixelFrame<T> const& frame = buffer.frame;
        for (int k = 0; k < lane_count; ++k) {
            int const x = column + k % tile_side, y = row + k / tile_side;
            if (x >= frame.width || y >= buffer.first_row + buffer.row_count) {
                for (int i = 0; i < 4; ++i) into[i][k] = T(0);
                continue;
            }
            std::size_t const pixel = static_cast<std::size_t>(y) * static_cast<std::size_t>(frame.width) + static_cast<std::size_t>(x);
            T const* const n = receivers.normal + pixel * static_cast<std::size_t>(receivers.normal_stride);
            for (int i = 0; i < 3; ++i) into[1 + i][k] = n[i];
            if (receivers.position != nullptr) {
                T const* const p = receivers.position + pixel * static_cast<std::size_t>(receivers.position_stride);
                into[0][k] = frame.to_inward.x * (p[0] - frame.eye.x) + frame.to_inward.y * (p[1] - frame.eye.y) +
                             frame.to_inward.z * (p[2] - frame.eye.z);
            } else {
                into[0][k] = receivers.depth[pixel];
            }
        }
    }

    [[nodiscard]] Seen see(int tile, int column, int row) const noexcept {
        PixelFrame<T> const& frame = buffer.frame;
        bool const flat = frame.kind == ViewKind::orthographic;
        T in[4][lane_count], xs[lane_count], ys[lane_count];
        gather(column, row, in);
        for (int k = 0; k < lane_count; ++k) {
            xs[k] = T(column + k % tile_side) - T(frame.width) / T(2);
            ys[k] = T(row + k / tile_side) - T(frame.height) / T(2);
        }
        auto const all = [](T value) { return Lanes::all(value); };
        Lanes const zero = all(T(0)), one = all(T(1)), half = all(T(0.5)), tiny = all(std::numeric_limits<T>::min());
        Lanes const x = Lanes::load(xs), y = Lanes::load(ys), depth = Lanes::load(in[0]);
        Lanes const m[3] = {Lanes::load(in[1]), Lanes::load(in[2]), Lanes::load(in[3])};
        auto const dot = [&](Vec3<T> const& v) { return fused(all(v.x), m[0], fused(all(v.y), m[1], all(v.z) * m[2])); };
        Lanes const nx = dot(frame.across), ny = dot(frame.upward), nz = dot(frame.inward);

        // The quad; see micro_quad, of which these are the lanes.
        Lanes const toward_middle = flat ? nz : fused(nx, x + half, fused(ny, y + half, nz));
        Lanes const facing = flat ? zero - nz : toward_middle;
        Lanes const steep = (absolute(nx) + absolute(ny)) * all(turn_limit(frame));
        Lanes const divisor = with_sign_of(most(absolute(facing), steep), facing);
        Lanes const scale = one / (flat ? divisor : divisor * depth);
        Lanes const q_x = nx * scale, q_y = ny * scale;
        Lanes const q = (flat ? depth : divisor * scale) - (q_x + q_y) * half;

        // A comparison with NaN is false.
        Lanes const largest_number = all(std::numeric_limits<T>::max());
        std::uint32_t sound = at_least(largest_number, absolute(q) + absolute(q_x) + absolute(q_y));
        sound &= at_least(absolute(divisor), tiny);
        if (!flat) sound &= at_least(depth, tiny);

        // Light and eye on the same side?
        Lanes travel = fused(nx, all(buffer.light.at.x), fused(ny, all(buffer.light.at.y), nz * all(buffer.light.at.z)));
        if (!buffer.light.parallel)
            travel = (flat ? fused(nx, x + half, fused(ny, y + half, nz * depth)) : depth * facing) - travel;
        std::uint32_t const lit = at_least(travel, tiny) & at_least(toward_middle, tiny);
        std::uint32_t const lit_behind = at_least(zero - tiny, travel) & at_least(zero - tiny, toward_middle);
        Seen seen;
        seen.away = sound & ~(lit | lit_behind);

        // The four corners as the light sees them.
        Lanes at[4], gain_x[4], gain_y[4];
        for (int i = 0; i < 4; ++i) {
            PixelPlane<T> const& p = plane[i];
            at[i] = fused(all(p.x), x, fused(all(p.y), y, fused(all(p.b), q, all(p.a))));
            gain_x[i] = fused(all(p.b), q_x, all(p.x));
            gain_y[i] = fused(all(p.b), q_y, all(p.y));
        }
        std::uint32_t held = every_sample;
        Lanes widest = zero;
        for (int corner = 0; corner < 4; ++corner) {
            auto const value = [&](int i) {
                Lanes const along = (corner & 1) != 0 ? at[i] + gain_x[i] : at[i];
                return (corner & 2) != 0 ? along + gain_y[i] : along;
            };
            Lanes q_here = (corner & 1) != 0 ? q + q_x : q;
            if ((corner & 2) != 0) q_here = q_here + q_y;
            Lanes const w = value(3), inverse = one / w;
            // Before an eye of perspective, values are over the depth, and 1 / q is the depth.
            Lanes const true_w = flat ? w : w / q_here;
            held &= at_least(w, tiny) & ~at_least(all(w_min), true_w);
            Lanes const tx = value(0) * inverse, ty = value(1) * inverse, tz = value(2) * inverse;
            if (corner == 0) {
                seen.lo_x = seen.hi_x = tx;
                seen.lo_y = seen.hi_y = ty;
                seen.depth = tz;
                seen.lo_w = seen.hi_w = true_w;
                widest = inverse;
                continue;
            }
            seen.lo_x = least(seen.lo_x, tx);
            seen.hi_x = most(seen.hi_x, tx);
            seen.lo_y = least(seen.lo_y, ty);
            seen.hi_y = most(seen.hi_y, ty);
            seen.depth = most(seen.depth, tz);
            seen.lo_w = least(seen.lo_w, true_w);
            seen.hi_w = most(seen.hi_w, true_w);
            widest = most(widest, inverse);
        }
        // Rounding, so that no triangle misses a texel; before an eye of perspective everything is over the depth.
        PixelFrame<T> const& f = frame;
        T const far_ray = glm::length(f.across) * T(f.width) + glm::length(f.upward) * T(f.height) + glm::length(f.inward);
        Lanes const reach = flat ? fused(absolute(q), all(T(2)), all(far_ray)) : all(far_ray);
        Lanes const here = flat ? one : absolute(q) + absolute(q_x) + absolute(q_y);
        Lanes const pad = fused(widest, fused(reach, all(buffer.texel_error), here * all(buffer.texel_error_here)),
                                all(T(1) / T(128)));
        Lanes const deeper = widest * fused(reach, all(buffer.depth_error), here * all(buffer.depth_error_here));
        seen.lo_x = seen.lo_x - pad;
        seen.hi_x = seen.hi_x + pad;
        seen.lo_y = seen.lo_y - pad;
        seen.hi_y = seen.hi_y + pad;
        seen.depth = seen.depth + deeper;
        Lanes const span = absolute(seen.lo_x) + absolute(seen.hi_x) + absolute(seen.lo_y) + absolute(seen.hi_y);
        held &= at_least(largest_number, span + absolute(seen.depth));
        seen.alive = sound & (lit | lit_behind) & held;

        T* const quads = buffer.quad + 3 * lane_count * tile;
        chosen(seen.alive, q, zero).store(quads);
        chosen(seen.alive, q_x, zero).store(quads + lane_count);
        chosen(seen.alive, q_y, zero).store(quads + 2 * lane_count);
        return seen;
    }

    // The pixels of `part` as one node, or as several if they lie far apart for what each of them covers.
    void insert(Parts<T> const& parts, int tile, Seen const& seen, std::uint32_t part, int pixels_across) const noexcept {
        if (part == 0) return;
        Lanes const huge = Lanes::all(std::numeric_limits<T>::max());
        Lanes const low = Lanes::all(std::numeric_limits<T>::lowest());
        T const bounds[5] = {smallest(chosen(part, seen.lo_x, huge)), largest(chosen(part, seen.hi_x, low)),
                             smallest(chosen(part, seen.lo_y, huge)), largest(chosen(part, seen.hi_y, low)),
                             largest(chosen(part, seen.depth, low))};
        if (pixels_across > 1) {
            Lanes const extent = most(seen.hi_x - seen.lo_x, seen.hi_y - seen.lo_y);
            T const pixel = largest(chosen(part, extent, low));
            T const width = bounds[1] - bounds[0], height = bounds[3] - bounds[2];
            T const roomy = pixel * T(2 * pixels_across);
            if ((width > height ? width : height) > (roomy > T(1) ? roomy : T(1))) {
                if (pixels_across == tile_side)
                    for (std::uint32_t const quarter : {0x0033u, 0x00ccu, 0x3300u, 0xcc00u})
                        insert(parts, tile, seen, part & quarter, 2);
                else
                    for (std::uint32_t k = 0; k < lane_count; ++k) insert(parts, tile, seen, part & 1u << k, 1);
                return;
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
        scale[i] = std::abs(r.x * source.x) + std::abs(r.y * source.y) + std::abs(r.z * source.z) + std::abs(r.w * source.w);
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
    T const offset = row.w + glm::dot(axis, frame.across) * frame.origin.x + glm::dot(axis, frame.upward) * frame.origin.y;
    return pixel_plane(frame.kind, normal_in_pixels(frame, axis), offset);
}

// The arrays of a buffer, cut from what the caller gave.
template <class T>
[[nodiscard]] inline Parts<T> lay_out(IrregularBuffer<T>& buffer, Storage<T> const& storage, std::uint32_t texel_count) noexcept {
    auto const tiles = static_cast<std::size_t>(buffer.tile_count);
    T* scalars = storage.scalars;
    std::uint32_t* words = storage.words;
    auto const take = [](auto*& from, std::size_t count) {
        auto* const taken = from;
        from += count;
        return taken;
    };
    Parts<T> parts;
    std::size_t const fixed_scalars = 48 * tiles + 6 * lane_count, fixed_words = 18 * tiles + lane_count + texel_count + 2;
    if (scalars == nullptr || words == nullptr || storage.size.scalars < fixed_scalars || storage.size.words < fixed_words)
        return parts;
    std::size_t const by_scalars = (storage.size.scalars - fixed_scalars) / 25;
    std::size_t const by_words = (storage.size.words - fixed_words) / 6;
    parts.capacity = static_cast<std::uint32_t>(by_scalars < by_words ? by_scalars : by_words);
    std::size_t const nodes = 4 * std::size_t{parts.capacity} + lane_count;
    buffer.quad = take(scalars, 48 * tiles);
    for (T** array : {&buffer.lo_x, &buffer.hi_x, &buffer.lo_y, &buffer.hi_y, &buffer.depth}) *array = take(scalars, nodes);
    parts.bounds = scalars;
    buffer.mask = take(words, 16 * tiles);
    buffer.alive = take(words, tiles);
    buffer.last_caster = take(words, tiles);
    buffer.first = take(words, texel_count + 2);
    buffer.tile = take(words, nodes);
    parts.place = words;
    return parts;
}

}  // namespace detail

// Lists what the light may reach of `row_count` rows of the picture from `first_row` on; both count in fours, but for
// the end of the picture, and a row_count of 0 stands for all that follow. Pixels that the map does not hold, its
// w_min included, stay lit; those that face away from the light are dark in all samples.
//
// Faults leave everything lit: not_finite, zero_light, those of the view, bad_projection where the matrix is not a map
// of this light, map_too_small, and storage_too_small, where counts.parts says what capacity would do.
template <class T, class Lanes = BestLanes<T>>
[[nodiscard]] inline IrregularBuffer<T> list_receivers(PixelFrame<T> const& frame, Receivers<T> const& receivers,
                                                       Light<T> const& light, ShadowMap<T> const& grid, int map_size,
                                                       Storage<T> const& storage, int first_row = 0,
                                                       int row_count = 0) noexcept {
    SHADOWMATH_ASSERT(receivers.normal != nullptr && (receivers.position != nullptr || receivers.depth != nullptr),
                      "receivers need a normal, and a position or a depth");
    IrregularBuffer<T> buffer;
    buffer.frame = frame;
    buffer.faults = frame.faults | faults_of(light);
    buffer.first_row = first_row;
    buffer.row_count = row_count > 0 ? row_count : frame.height - first_row;
    buffer.map_size = map_size;
    if (map_size < 1 || map_size > 1 << (most_levels - 1)) buffer.faults |= Fault::map_too_small;
    if (first_row < 0 || buffer.row_count < 1 || first_row > frame.height - buffer.row_count) buffer.faults |= Fault::bad_region;
    if (frame.faults.any() || unusable(light) || buffer.faults.has(Fault::map_too_small) || buffer.faults.has(Fault::bad_region)) {
        buffer.row_count = 0;
        return buffer;
    }
    buffer.light = pixel_light(frame, light);
    buffer.contact_reach = T(2) * (std::abs(frame.eye.x) + std::abs(frame.eye.y) + std::abs(frame.eye.z));
    buffer.contact_ray = glm::length(frame.across) * T(frame.width) / T(2) +
                         glm::length(frame.upward) * T(frame.height) / T(2) + glm::length(frame.inward);
    if (frame.kind == ViewKind::orthographic) {
        buffer.contact_reach += buffer.contact_ray;
        buffer.contact_ray = T(1);
    }
    buffer.tiles_across = (frame.width + tile_side - 1) / tile_side;
    buffer.tile_count = buffer.tiles_across * ((buffer.row_count + tile_side - 1) / tile_side);
    if (!detail::take_map(buffer, grid, light)) {
        buffer.faults |= Fault::bad_projection;
        buffer.tile_count = 0;
        return buffer;
    }
    std::uint32_t texel_count = 0;
    for (int side = 2; side > 1 && buffer.level_count < most_levels;) {
        side = level_size(map_size, buffer.level_count);
        buffer.texels_before[buffer.level_count++] = texel_count;
        texel_count += static_cast<std::uint32_t>(side) * static_cast<std::uint32_t>(side);
    }
    detail::Parts<T> const parts = detail::lay_out(buffer, storage, texel_count);
    if (parts.bounds == nullptr) {
        buffer.faults |= Fault::storage_too_small;
        buffer.tile_count = 0;
        return buffer;
    }
    std::memset(buffer.first, 0, (texel_count + 2) * sizeof(std::uint32_t));
    T const largest_number = std::numeric_limits<T>::max();
    buffer.least_x = buffer.least_y = buffer.least_w = largest_number;
    buffer.most_x = buffer.most_y = buffer.most_w = buffer.most_depth = -largest_number;

    detail::TileKernel<Lanes> const kernel{buffer, receivers,
                                           {detail::plane_of_row(frame, buffer.row[0]), detail::plane_of_row(frame, buffer.row[1]),
                                            detail::plane_of_row(frame, buffer.row[2]), detail::plane_of_row(frame, buffer.row[3])},
                                           grid.w_min > T(0) ? grid.w_min : T(0)};
    Lanes const huge = Lanes::all(largest_number), low = Lanes::all(-largest_number);
    Lanes least_w = huge, most_w = low;
    for (int tile = 0; tile < buffer.tile_count; ++tile) {
        int const column = tile % buffer.tiles_across * tile_side;
        int const row = first_row + tile / buffer.tiles_across * tile_side;
        auto const seen = kernel.see(tile, column, row);
        for (int k = 0; k < lane_count; ++k)
            buffer.mask[tile * lane_count + k] = (seen.away >> k & 1u) != 0 ? every_sample : 0u;
        buffer.alive[tile] = seen.alive;
        buffer.last_caster[tile] = 0;
        if (seen.alive == 0) continue;
        ++buffer.counts.tiles;
        least_w = least(least_w, chosen(seen.alive, seen.lo_w, huge));
        most_w = most(most_w, chosen(seen.alive, seen.hi_w, low));
        kernel.insert(parts, tile, seen, seen.alive, tile_side);
    }
    buffer.least_w = smallest(least_w);
    buffer.most_w = largest(most_w);
    if (buffer.counts.parts > parts.capacity) {
        buffer.faults |= Fault::storage_too_small;
        buffer.tile_count = 0;
        buffer.levels_used = 0;
        return buffer;
    }
    detail::sort_parts(buffer, parts, texel_count);
    return buffer;
}

}  // namespace v0
}  // namespace shadowmath
