// SPDX-License-Identifier: MIT
//
// Every technique, on good inputs and on spoilt ones.
#include "tests/fuzz/inputs.hpp"
#include "tests/laws/cascades.hpp"
#include "tests/laws/map_rows.hpp"

#include <shadowmath/shadowmath.hpp>

namespace shadowmath::fuzz {
namespace {

template <class T>
struct Input {
    ViewVolume<T> view;
    Light<T> light;
    Aabb<T> casters, receivers;
    CascadeOptions<T> cascades;
    WarpOptions<T> warp;
    VdsmOptions<T> vdsm;
    ShadowPlane<T> plane;
    ClipSpace clip;
};

template <class T>
Input<T> good_input(Case& c) {
    Input<T> in;
    in.view = good_view<T>(c);
    in.light = good_sun<T>(c);
    in.receivers = good_box<T>(c);
    in.casters = good_box<T>(c);
    in.plane = mean_height_plane(in.receivers, Vec3<T>(T(0), T(1), T(0)));
    in.clip = any_clip(c);
    in.cascades.count = 1 + c.below(max_splits);
    in.cascades.map_size = in.warp.map_size = in.vdsm.map_size = 64 + c.below(2000);
    in.cascades.fit = static_cast<CascadeFit>(c.below(4));
    in.cascades.lambda = T(0);  // logarithms come from the library, whose last bit differs between platforms
    in.cascades.pancake = c.one_in(2);
    in.cascades.clip = in.clip;
    return in;
}

template <class T>
void spoil(Case& c, Input<T>& in) {
    if (c.one_in(2)) spoil(c, in.view);
    if (c.one_in(2)) in.light = any_light<T>(c);
    if (c.one_in(3)) in.casters = any_box<T>(c);
    if (c.one_in(3)) in.receivers = any_box<T>(c);
    if (c.one_in(3)) in.plane = {any_vector<T>(c), c.number<T>()};
    if (c.one_in(3)) in.cascades.count = c.below(60) - 10;
    if (c.one_in(3)) in.cascades.map_size = in.warp.map_size = in.vdsm.map_size = c.below(64) - 20;
    if (c.one_in(3)) in.cascades.lambda = c.number<T>();
    if (c.one_in(3)) in.cascades.blend = c.number<T>();
    if (c.one_in(3)) in.cascades.shadow_distance = c.number<T>();
    if (c.one_in(3)) in.cascades.first_split_end = c.number<T>();
    if (c.one_in(3)) in.cascades.filter_radius = c.below(200) - 50;
    if (c.one_in(3)) in.warp.strength = c.number<T>();
    if (c.one_in(3)) in.warp.margin_texels = in.vdsm.margin_texels = c.number<T>();
}

// Of a map of a good sun: that it is one, and the rounding of the axes that it was made with.
template <class T>
void require_map_of(Case& c, ShadowMap<T> const& map, Light<T> const& light) {
    c.require(!map.visible || laws::is_map_of(map.clip_from_world, light, map.clip, 256),
              "a map is a map of its light");
}

template <class T>
void try_maps(Case& c) {
    Input<T> in = good_input<T>(c);
    bool const good = c.one_in(2);
    if (!good) spoil(c, in);
    Cascades<T> const cascades =
        c.call([&] { return fit_cascades(in.view, in.light, in.casters, in.receivers, in.cascades); });
    ShadowMap<T> const warped =
        c.call([&] { return simple_perspective_map(in.view, in.light, in.casters, in.receivers, in.warp, in.clip); });
    ShadowMap<T> const on_plane = c.call(
        [&] { return view_dependent_map(in.view, in.light, in.plane, in.casters, in.receivers, in.vdsm, in.clip); });
    ShadowMap<T> const of_spot = c.call([&] {
        return fit_spot(in.view, in.light, in.casters, in.receivers, in.warp.map_size, in.warp.margin_texels, in.clip);
    });
    c.require(laws::well_formed(cascades), "cascades join, and each map is harmless");
    for (ShadowMap<T> const* const map : {&warped, &on_plane, &of_spot})
        c.require(laws::harmless(*map), "a map is finite, and shows nothing when it is not visible");
    if (!good) return;
    for (Cascade<T> const& cascade : cascades) {
        require_map_of(c, cascade.map, in.light);
        c.hash(cascade.map.clip_from_world);
    }
    require_map_of(c, warped, in.light);
    require_map_of(c, on_plane, in.light);
    c.hash(warped.clip_from_world);
    c.hash(on_plane.clip_from_world);
}

[[maybe_unused]] bool const maps_target =
    add_target("maps", [](Case& c) { c.one_in(2) ? try_maps<float>(c) : try_maps<double>(c); });

}  // namespace
}  // namespace shadowmath::fuzz
