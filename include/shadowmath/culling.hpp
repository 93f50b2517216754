// SPDX-License-Identifier: MIT
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
#pragma once

#include <shadowmath/bounds.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/reach.hpp>
#include <shadowmath/shadow_map.hpp>
#include <shadowmath/splits.hpp>
#include <shadowmath/wide.hpp>

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
