// SPDX-License-Identifier: MIT
//
// Which maps a caster must be drawn into: never too few, whatever the maps and boxes are.
#include "tests/laws/culling.hpp"
#include "tests/fuzz/inputs.hpp"

#include <shadowmath/light_box.hpp>

namespace shadowmath::fuzz {
namespace {

template <class T>
void try_culling(Case& c) {
    ShadowMap<T> maps[3];
    for (ShadowMap<T>& map : maps) {
        map.clip = any_clip(c);
        map.visible = !c.one_in(8);
        LightBasis<T> const basis = light_basis(good_sun<T>(c).direction);
        Vec3<T> const centre = point_within<T>(c, T(100));
        T const half = c.magnitude<T>(-2, 8);
        map.clip_from_world =
            clip_from_world(LightBox<T>{basis, Vec2<T>(centre.x - half, centre.y - half),
                                        Vec2<T>(centre.x + half, centre.y + half), centre.z - half, centre.z + half},
                            map.clip);
        if (c.one_in(8)) map.clip_from_world[c.below(4)][c.below(4)] = c.magnitude<T>(-30, 30);
    }
    CasterMaps<T> const gathered = c.call([&] { return caster_maps(maps, 3); });
    bool const good = c.one_in(2);
    Aabb<T> const box = good ? good_box<T>(c) : any_box<T>(c);
    MapMask const mask = c.call([&] { return caster_mask(gathered, box); });
    c.hash(&mask, 1);
    c.require((mask >> 3) == 0, "a mask has a bit for each map and no other");
    c.require(laws::spans(map_range(mask), mask), "the range holds every bit of the mask");
    T const s = c.uniform<T>(T(0), T(1));
    T const t = c.uniform<T>(T(0), T(1));
    T const u = c.uniform<T>(T(0), T(1));
    if (!good) return;
    for (int i = 0; i < 3; ++i)
        c.require(!maps[i].visible || !all_finite(maps[i].clip_from_world) ||
                      laws::misses_no_point(maps[i], box, Vec3<T>(s, t, u), (mask >> i & 1) != 0),
                  "no caster is missed");
}

[[maybe_unused]] bool const culling_target =
    add_target("culling", [](Case& c) { c.one_in(2) ? try_culling<float>(c) : try_culling<double>(c); });

}  // namespace
}  // namespace shadowmath::fuzz
