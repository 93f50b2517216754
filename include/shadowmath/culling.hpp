// SPDX-License-Identifier: MIT
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
#pragma once

#include <shadowmath/bounds.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/reach.hpp>
#include <shadowmath/shadow_map.hpp>
#include <shadowmath/splits.hpp>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

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
    // Up to four maps that look the same way. A point p is inside where half_normal . 2 p >= least, for all five sides.
    struct Bundle {
        Vec3<T> half_normal[5];  // left, right, bottom, top, far
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

// All numbers, and of size below 2^60 (which is above farthest_metres). By their bits (finite.hpp), and without a
// branch among them, so that many cost little.
[[nodiscard]] inline bool all_in_reach(float const* values, int count) noexcept {
    std::uint32_t beyond = 0;
    for (int i = 0; i < count; ++i) {
        std::uint32_t bits;
        std::memcpy(&bits, values + i, sizeof bits);
        beyond |= (bits & 0x7fffffffu) + (0x80000000u - 0x5d800000u);
    }
    return (beyond & 0x80000000u) == 0;
}

[[nodiscard]] inline bool all_in_reach(double const* values, int count) noexcept {
    constexpr std::uint64_t sign = 0x8000000000000000u;
    std::uint64_t beyond = 0;
    for (int i = 0; i < count; ++i) {
        std::uint64_t bits;
        std::memcpy(&bits, values + i, sizeof bits);
        beyond |= (bits & ~sign) + (sign - 0x43b0000000000000u);
    }
    return (beyond & sign) == 0;
}

[[nodiscard]] inline bool all_in_reach(long double const* values, int count) noexcept {
    for (int i = 0; i < count; ++i)
        if (!all_finite(values + i, 1) || !(std::abs(values[i]) < 0x1p60L)) return false;
    return true;
}

// lo > hi, infinite ends included; false where one is NaN, and no signal of one.
template <class T>
[[nodiscard]] inline bool are_crossed(T const& lo, T const& hi) noexcept {
    T const below = -hi;
    return (all_finite(&lo, 1) || is_positive_infinity(&lo)) && (all_finite(&hi, 1) || is_positive_infinity(&below)) &&
           lo > hi;
}

// By how much a box must grow before it is tested, as a part of the sum of the sizes of its coordinates. 2 for sum and
// difference of lo and hi, 6 for the roundings of a dot product and its normal, 4 for a normal shared by maps.
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

// How far a box reaches along the normal of a side. x2, y2, z2: the sum of its ends, which is twice its centre.
template <class T>
[[nodiscard]] inline T reach_of(Vec3<T> const& half_normal, T x2, T y2, T z2, T width, T height, T depth) noexcept {
    return half_normal.x * x2 + half_normal.y * y2 + half_normal.z * z2 + std::abs(half_normal.x) * width +
           std::abs(half_normal.y) * height + std::abs(half_normal.z) * depth;
}

// The maps of one bundle that something with these reaches is inside of.
template <class T>
[[nodiscard]] inline std::uint32_t bits_inside(typename CasterMaps<T>::Bundle const& bundle,
                                               T const (&reach)[5]) noexcept {
    std::uint32_t bits = 0;
    for (int place = 0; place < 4; ++place) {
        bool inside = true;
        // NOTE: & and not &&: a branch would keep compilers from doing many boxes at once.
        for (int side = 0; side < 5; ++side) inside = inside & (reach[side] >= bundle.least[side][place]);
        bits |= inside ? std::uint32_t(bundle.bit[place]) : 0u;
    }
    return bits;
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
        own.half_normal[side] = Vec3<T>(plane) * T(0.5);
        own.least[side++][0] = -plane.w;
    }
    own.bit[0] = bit;
    if (maps.bundle_count > 0) {
        auto& bundle = maps.bundle[maps.bundle_count - 1];
        T differ = T(0);
        for (side = 0; side < 5; ++side)
            differ = std::fmax(differ, detail::largest_of(bundle.half_normal[side] - own.half_normal[side]));
        int place = 0;
        while (place < 4 && bundle.bit[place] != 0) ++place;
        if (place < 4 && differ <= T(2) * std::numeric_limits<T>::epsilon()) {
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
    if (!detail::all_in_reach(&lo.x, 3) || !detail::all_in_reach(&hi.x, 3)) {
        for (int axis = 0; axis < 3; ++axis)
            if (detail::are_crossed(lo[axis], hi[axis])) return 0;
        return detail::every_bit(maps);
    }
    if (lo.x > hi.x || lo.y > hi.y || lo.z > hi.z) return 0;
    T const sizes = std::abs(lo.x) + std::abs(hi.x) + std::abs(lo.y) + std::abs(hi.y) + std::abs(lo.z) + std::abs(hi.z);
    Vec3<T> const centre2 = lo + hi, extent = hi - lo + Vec3<T>(detail::box_slack<T> * sizes);
    std::uint32_t mask = 0;
    for (int b = 0; b < maps.bundle_count; ++b) {
        auto const& bundle = maps.bundle[b];
        T reach[5];
        for (int side = 0; side < 5; ++side)
            reach[side] = detail::reach_of(bundle.half_normal[side], centre2.x, centre2.y, centre2.z, extent.x,
                                           extent.y, extent.z);
        mask |= detail::bits_inside<T>(bundle, reach);
    }
    return static_cast<MapMask>(mask);
}

// As for a box, with the ball in its place; one of negative radius casts nowhere.
template <class T>
[[nodiscard]] inline MapMask caster_mask(CasterMaps<T> const& maps, Sphere<T> const& sphere) noexcept {
    Vec3<T> const& centre = sphere.center;
    if (detail::are_crossed(T(0), sphere.radius)) return 0;
    if (!detail::all_in_reach(&centre.x, 3) || !detail::all_in_reach(&sphere.radius, 1)) return detail::every_bit(maps);
    T const sizes = std::abs(centre.x) + std::abs(centre.y) + std::abs(centre.z) + sphere.radius;
    T const diameter = T(2) * sphere.radius + detail::box_slack<T> * sizes;
    std::uint32_t mask = 0;
    for (int b = 0; b < maps.bundle_count; ++b) {
        auto const& bundle = maps.bundle[b];
        T reach[5];
        for (int side = 0; side < 5; ++side)
            reach[side] = T(2) * glm::dot(bundle.half_normal[side], centre) +
                          diameter * std::sqrt(glm::dot(bundle.half_normal[side], bundle.half_normal[side]));
        mask |= detail::bits_inside<T>(bundle, reach);
    }
    return static_cast<MapMask>(mask);
}

namespace detail {

inline constexpr int boxes_at_once = 64;

// Straight loops of constant length over one bundle, for a compiler to turn into vector code: see caster_masks.
template <class T>
inline void mask_block(CasterMaps<T> const& maps, BoxArrays<T> const& boxes, MapMask* masks) noexcept {
    constexpr int n = boxes_at_once;
    T x2[n], y2[n], z2[n], width[n], height[n], depth[n];
    std::uint32_t mask[n], full[n];  // full: all ones, or zero for an empty box
    for (int i = 0; i < n; ++i) {
        T const lo_x = boxes.lo_x[i], lo_y = boxes.lo_y[i], lo_z = boxes.lo_z[i];
        T const hi_x = boxes.hi_x[i], hi_y = boxes.hi_y[i], hi_z = boxes.hi_z[i];
        T const grown = box_slack<T> * (std::abs(lo_x) + std::abs(hi_x) + std::abs(lo_y) + std::abs(hi_y) +
                                        std::abs(lo_z) + std::abs(hi_z));
        full[i] = ((lo_x <= hi_x) & (lo_y <= hi_y) & (lo_z <= hi_z)) ? ~0u : 0u;
        mask[i] = 0;
        x2[i] = lo_x + hi_x;
        y2[i] = lo_y + hi_y;
        z2[i] = lo_z + hi_z;
        width[i] = hi_x - lo_x + grown;
        height[i] = hi_y - lo_y + grown;
        depth[i] = hi_z - lo_z + grown;
    }
    for (int b = 0; b < maps.bundle_count; ++b) {
        typename CasterMaps<T>::Bundle const bundle = maps.bundle[b];
        for (int i = 0; i < n; ++i) {
            T reach[5];
            for (int side = 0; side < 5; ++side)
                reach[side] = reach_of(bundle.half_normal[side], x2[i], y2[i], z2[i], width[i], height[i], depth[i]);
            mask[i] |= bits_inside<T>(bundle, reach);
        }
    }
    for (int i = 0; i < n; ++i) masks[i] = static_cast<MapMask>(mask[i] & full[i]);
}

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
    for (int begin = 0; begin < count; begin += detail::boxes_at_once) {
        BoxArrays<T> const block = from(begin);
        int const left = count - begin, length = left < detail::boxes_at_once ? left : detail::boxes_at_once;
        bool const in_reach = detail::all_in_reach(block.lo_x, length) && detail::all_in_reach(block.lo_y, length) &&
                              detail::all_in_reach(block.lo_z, length) && detail::all_in_reach(block.hi_x, length) &&
                              detail::all_in_reach(block.hi_y, length) && detail::all_in_reach(block.hi_z, length);
        if (in_reach && length == detail::boxes_at_once) {
            detail::mask_block(maps, block, masks + begin);
            continue;
        }
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
