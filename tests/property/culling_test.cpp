// SPDX-License-Identifier: MIT
#include "tests/laws/culling.hpp"
#include "tests/support/any_map.hpp"
#include "tests/support/gen.hpp"
#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

#include <vector>

using namespace shadowmath;
using namespace shadowmath::test;

template <class T>
class CullingProperty : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(CullingProperty, Scalars);

namespace {

// Some of them cascades: the same map, cropped.
template <class T>
std::vector<ShadowMap<T>> some_maps() {
    std::vector<ShadowMap<T>> maps;
    std::uint64_t const count = 1 + *below(6);
    for (std::uint64_t i = 0; i < count; ++i) {
        bool const fresh = *one_in(3);
        AnyMap<T> const any = *any_map<T>();
        T const zoom = *log_uniform<T>(T(0.1), T(10));
        ShadowMap<T> map = any.map;
        if (!fresh && !maps.empty()) {
            map = maps.back();
            Mat4<T> crop(T(1));
            crop[0][0] = crop[1][1] = zoom;
            map.clip_from_world = crop * map.clip_from_world;
        }
        maps.push_back(map);
    }
    return maps;
}

template <class T>
Vec3<T> somewhere() {
    T const x = *uniform<T>(T(0), T(1));
    T const y = *uniform<T>(T(0), T(1));
    T const z = *uniform<T>(T(0), T(1));
    return Vec3<T>(x, y, z);
}

template <class T>
std::vector<Aabb<T>> some_boxes(std::size_t count) {
    std::vector<Aabb<T>> boxes;
    T const radius = *log_uniform<T>(T(0.1), T(1000));
    for (std::size_t i = 0; i < count; ++i) {
        Vec3<T> const centre = *point_within<T>(T(200));
        Aabb<T> const drawn = *box<T>(radius);
        boxes.push_back({drawn.lo + centre, drawn.hi + centre});
    }
    return boxes;
}

template <class T>
std::vector<MapMask> masks_of(CasterMaps<T> const& maps, std::vector<Aabb<T>> const& boxes) {
    std::vector<T> columns[6];
    for (Aabb<T> const& box : boxes)
        for (int axis = 0; axis < 3; ++axis) {
            columns[axis].push_back(box.lo[axis]);
            columns[axis + 3].push_back(box.hi[axis]);
        }
    std::vector<MapMask> masks(boxes.size());
    BoxArrays<T> const arrays{columns[0].data(), columns[1].data(), columns[2].data(),
                              columns[3].data(), columns[4].data(), columns[5].data()};
    caster_masks(maps, arrays, static_cast<int>(boxes.size()), masks.data());
    return masks;
}

}  // namespace

TYPED_TEST(CullingProperty, MissesNoPointAndKeepsToTheRule) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        auto const maps = some_maps<T>();
        CasterMaps<T> const casters = caster_maps(maps.data(), static_cast<int>(maps.size()));
        for (Aabb<T> const& box : some_boxes<T>(4)) {
            unsigned const mask = caster_mask(casters, box);
            Vec3<T> const share = somewhere<T>();
            for (std::size_t i = 0; i < maps.size(); ++i) {
                RC_ASSERT(laws::misses_no_point(maps[i], box, share, (mask >> i & 1) != 0));
                RC_ASSERT(laws::keeps_to_the_rule(maps[i], box, (mask >> i & 1) != 0));
            }
        }
    }));
}

// Points on the very sides of the map, where rounding decides.
TYPED_TEST(CullingProperty, MissesNoPointAtTheEdgeOfTheMap) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        ShadowMap<T> const map = (*any_map<T>()).map;
        for (int i = 0; i < 16; ++i) {
            Vec3<T> at = somewhere<T>();
            auto const side = static_cast<int>(*below(3));
            bool const upper = *one_in(2);
            at[side] = side == 2 ? far_depth<T>(map.clip) : (upper ? T(1) : T(0));
            Vec3<T> const point = point_at_texture(map, at);
            Aabb<T> const box{point, point};
            bool const bit = caster_mask(caster_maps(&map, 1), box) != 0;
            RC_ASSERT(laws::misses_no_point(map, box, Vec3<T>(T(0)), bit));
        }
    }));
}

TYPED_TEST(CullingProperty, OfABallMissesNoPoint) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        ShadowMap<T> const map = (*any_map<T>()).map;
        Vec3<T> const centre = *point_within<T>(T(300));
        Vec3<T> const towards = *direction<T>();
        T const radius = *log_uniform<T>(T(0.01), T(300));
        bool const bit = caster_mask(caster_maps(&map, 1), Sphere<T>{centre, radius}) != 0;
        long double const inward = 1 - 4 * static_cast<long double>(std::numeric_limits<T>::epsilon());
        Vec3<long double> const point =
            Vec3<long double>(centre) + Vec3<long double>(towards) * (inward * static_cast<long double>(radius));
        RC_ASSERT(bit || !laws::may_shadow(map, point));
        // The ball inside the box: what the ball reaches, the box does.
        Aabb<T> const around{centre - radius, centre + radius};
        RC_ASSERT(!bit || laws::touches_a_side(map, around) || caster_mask(caster_maps(&map, 1), around) != 0);
    }));
}

TYPED_TEST(CullingProperty, InArraysIsThatOfTheBoxesOneByOne) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        auto const maps = some_maps<T>();
        CasterMaps<T> const casters = caster_maps(maps.data(), static_cast<int>(maps.size()));
        auto const boxes = some_boxes<T>(64 + *below(8));
        auto const masks = masks_of(casters, boxes);
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            unsigned const differ = masks[i] ^ caster_mask(casters, boxes[i]);
            for (std::size_t m = 0; m < maps.size(); ++m) {
                RC_ASSERT((differ >> m & 1) == 0 || laws::touches_a_side(maps[m], boxes[i]));
                RC_ASSERT(laws::misses_no_point(maps[m], boxes[i], Vec3<T>(T(0.5)), (masks[i] >> m & 1) != 0));
            }
        }
    }));
}

TYPED_TEST(CullingProperty, OfAnyBoxIntoAnyMapIsCalmAndBrokenBoxesCastEverywhere) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        ShadowMap<T> const map = *nasty_map<T>();
        std::vector<Aabb<T>> boxes;
        Aabb<T> const unit{Vec3<T>(T(0)), Vec3<T>(T(1))};
        for (int i = 0; i < 64; ++i) boxes.push_back(i % 8 == 0 ? *nasty_box<T>() : unit);
        auto const casters = watched([&] { return caster_maps(&map, 1); });
        RC_ASSERT(casters.calm());
        bool const usable = map.visible && all_finite(map.clip_from_world);
        auto const masks = masks_of(casters.result, boxes);
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            auto const mask = watched([&] { return caster_mask(casters.result, boxes[i]); });
            RC_ASSERT(mask.calm());
            RC_ASSERT(mask.result == masks[i]);
            Vec3<T> const &lo = boxes[i].lo, &hi = boxes[i].hi;
            bool const empty = lo.x > hi.x || lo.y > hi.y || lo.z > hi.z;
            if (empty) RC_ASSERT(mask.result == 0);
            if (!empty && !all_finite(boxes[i])) RC_ASSERT((mask.result != 0) == usable);
        }
    }));
}
