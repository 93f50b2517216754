// SPDX-License-Identifier: MIT
//
// What is asked of a map once it exists, with any map, point and option: bias, footprint, choice of map, filter.
#include "tests/fuzz/inputs.hpp"
#include "tests/laws/bias.hpp"
#include "tests/laws/filter.hpp"
#include "tests/laws/footprint.hpp"
#include "tests/laws/map_ray.hpp"
#include "tests/laws/sampling.hpp"
#include "tests/laws/stillness.hpp"

#include <shadowmath/light_box.hpp>

namespace shadowmath::fuzz {
namespace {

template <class T>
ShadowMap<T> any_map(Case& c, Light<T> const& light) {
    ShadowMap<T> map;
    map.clip = any_clip(c);
    map.visible = !c.one_in(8);
    Vec3<T> const centre = point_within<T>(c, T(100));
    T const half = c.magnitude<T>(-2, 8);
    LightBox<T> const box{light_basis(light.direction), Vec2<T>(centre.x - half, centre.y - half),
                          Vec2<T>(centre.x + half, centre.y + half), centre.z - T(50), centre.z + T(50)};
    map.clip_from_world = clip_from_world(box, map.clip);
    int const replaced = c.one_in(2) ? c.below(4) : 0;
    for (int i = 0; i < replaced; ++i) map.clip_from_world[c.below(4)][c.below(4)] = c.number<T>();
    return map;
}

template <class T>
void try_receivers(Case& c) {
    Light<T> const light = c.one_in(2) ? any_light<T>(c) : good_sun<T>(c);
    ShadowMap<T> const map = any_map(c, light), eye = any_map(c, light);
    Vec3<T> const point = c.one_in(2) ? any_vector<T>(c) : point_within<T>(c, T(200));
    Vec3<T> const normal = c.one_in(2) ? any_vector<T>(c) : point_within<T>(c, T(1));
    BiasOptions<T> options;
    for (T* const option : {&options.flat_texels, &options.texels, &options.metres, &options.steepest})
        if (c.one_in(3)) *option = c.number<T>();
    int const map_size = c.one_in(4) ? c.below(70000) - 10 : 1024;

    MapBias<T> const bias = c.call([&] { return bias_for(map, light, map_size, options); });
    MapBias<T> const bias_here = c.call([&] { return bias_at(map, light, map_size, options, point); });
    c.require(overflow_unseen || (laws::is_harmless(bias) && laws::is_harmless(bias_here)), "bias is finite");
    Footprint<T> const texel = c.call([&] {
        return footprint(eye.clip_from_world, Vec2<T>(T(800), T(600)), map.clip_from_world, T(map_size), point, normal);
    });
    c.hash(&texel.major, 1);
    c.require(laws::is_footprint(texel), "a footprint is two ordered, bounded lengths");
    ShadowMap<T> const maps[] = {map, eye};
    LookUp<T> const look_up = c.call([&] { return by_map(maps, 2, map_size, T(2), point); });
    c.require(laws::is_look_up(look_up, 2), "a look-up names maps that exist");
    MapRay<T> const ray = c.call([&] { return map_ray(map, point); });
    T const error = c.call([&] { return light_error_radians(map, light, point); });
    c.require(laws::is_ray(ray) && laws::is_angle(error), "a ray is a unit direction or none");
    TexelShift<T> const shift = c.call([&] { return texel_shift(map, eye, map_size, point); });
    c.require(overflow_unseen || laws::is_texel_shift(shift),
              "what is left beside whole texels is at most half of one");
    T const stored = c.number<T>();
    FilterOptions const filter{c.below(6) - 1, c.one_in(2)};
    T const lit = c.call(
        [&] { return visibility(map, map_size, point, normal, bias, filter, [stored](int, int) { return stored; }); });
    c.require(laws::is_share(lit), "visibility lies in [0, 1]");
}

[[maybe_unused]] bool const receivers_target =
    add_target("receivers", [](Case& c) { c.one_in(2) ? try_receivers<float>(c) : try_receivers<double>(c); });

}  // namespace
}  // namespace shadowmath::fuzz
