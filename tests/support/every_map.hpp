// SPDX-License-Identifier: MIT
//
// Every technique on one input, for tests of what a bad one gives: data never aborts and never poisons, and a result
// says what was wrong.
#pragma once

#include "tests/laws/shadow_map.hpp"

#include <shadowmath/shadowmath.hpp>

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

namespace shadowmath::test {

inline constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
inline constexpr double infinity = std::numeric_limits<double>::infinity();

// All that a map is made from; the default is a good view of a good scene.
template <class T>
struct Input {
    ViewVolume<T> view = perspective_view(
        pose_looking(Vec3<T>(T(0), T(2), T(8)), Vec3<T>(T(0.1), T(-0.2), T(-1)), Vec3<T>(T(0), T(1), T(0))), T(1),
        T(1.5), T(0.1), T(60));
    Light<T> sun = directional(Vec3<T>(T(0.4), T(-1), T(0.3)));
    Light<T> lamp = spot(Vec3<T>(T(1), T(9), T(2)), Vec3<T>(T(-0.1), T(-1), T(-0.2)), T(0.7), T(40));
    Aabb<T> casters{Vec3<T>(T(-20), T(0), T(-40)), Vec3<T>(T(20), T(5), T(10))};
    Aabb<T> receivers{Vec3<T>(T(-30), T(0), T(-50)), Vec3<T>(T(30), T(5), T(15))};
    ShadowPlane<T> plane = mean_height_plane(receivers, Vec3<T>(T(0), T(1), T(0)));
    CascadeOptions<T> cascades;
    int map_size = 512;
    T margin_texels = T(2);
    ClipSpace clip = vulkan_clip;
};

template <class T>
struct Made {
    std::string technique;
    Light<T> light;
    ShadowMap<T> map;
};

// Every technique on one input. Whatever the input is, what comes out is harmless: here that is checked for all tests.
template <class T>
std::vector<Made<T>> every_map(Input<T> const& in) {
    std::vector<Made<T>> made;
    struct Named {
        CascadeFit fit;
        char const* name;
    };
    for (auto const& [fit, name] :
         {Named{CascadeFit::stable, "stable cascade"}, Named{CascadeFit::tight, "tight cascade"},
          Named{CascadeFit::rectangle, "rectangle cascade"}, Named{CascadeFit::focus, "focus cascade"},
          Named{CascadeFit::warped, "warped cascade"}}) {
        CascadeOptions<T> options = in.cascades;
        options.fit = fit;
        options.clip = in.clip;
        Cascades<T> const cascades = fit_cascades(in.view, in.sun, in.casters, in.receivers, options);
        // What was wrong with the inputs is said once, for all cascades.
        ShadowMap<T> none;
        none.faults = cascades.faults;
        if (cascades.count == 0) made.push_back({name, in.sun, none});
        for (Cascade<T> const& cascade : cascades) {
            made.push_back({name, in.sun, cascade.map});
            made.back().map.faults |= cascades.faults;
        }
    }
    WarpOptions<T> warp;
    warp.map_size = in.map_size;
    warp.margin_texels = in.margin_texels;
    VdsmOptions<T> vdsm;
    vdsm.map_size = in.map_size;
    vdsm.margin_texels = in.margin_texels;
    for (WarpRule const rule : {WarpRule::by_strength, WarpRule::trapezoid, WarpRule::extended}) {
        warp.rule = rule;
        made.push_back({"simple perspective map", in.sun,
                        simple_perspective_map(in.view, in.sun, in.casters, in.receivers, warp, in.clip)});
    }
    for (Light<T> const& light : {in.sun, in.lamp})
        made.push_back({"view-dependent map", light,
                        view_dependent_map(in.view, light, in.plane, in.casters, in.receivers, vdsm, in.clip)});
    made.push_back({"spot", in.lamp,
                    fit_spot(in.view, in.lamp, in.casters, in.receivers, in.map_size, in.margin_texels, in.clip)});
    // A lamp without an axis: of its six faces most serve nothing, and a bad axis is no fault.
    CubeMaps<T> const cube = fit_cube(in.view, in.lamp.position, in.lamp.range, in.casters, in.receivers, in.map_size,
                                      in.margin_texels, in.clip);
    for (ShadowMap<T> const& face : cube.face) EXPECT_TRUE(laws::harmless(face)) << "face of a cube";
    for (Made<T> const& one : made) EXPECT_TRUE(laws::harmless(one.map)) << one.technique;
    return made;
}

template <class T>
void expect_visible(Input<T> const& in) {
    for (Made<T> const& one : every_map(in)) {
        EXPECT_TRUE(one.map.visible) << one.technique << ": " << describe(one.map.faults);
        EXPECT_TRUE(laws::is_map_of(one.map.clip_from_world, one.light, in.clip, 256)) << one.technique;
    }
}

template <class T>
void expect_none_visible(Input<T> const& in, Fault wanted) {
    for (Made<T> const& one : every_map(in)) {
        EXPECT_FALSE(one.map.visible) << one.technique;
        EXPECT_TRUE(one.map.faults.has(wanted)) << one.technique << " says: " << describe(one.map.faults);
    }
}

}  // namespace shadowmath::test
