// SPDX-License-Identifier: MIT
//
// Two maps whose depths, texels and tangents can be told by heart: a box under light straight down, and a spot's.
#pragma once

#include <shadowmath/light.hpp>
#include <shadowmath/light_box.hpp>
#include <shadowmath/shadow_map.hpp>
#include <shadowmath/view_volume.hpp>

namespace shadowmath::test {

// 10 m by 20 m across, 40 m deep, light straight down: x of the map is x of the world, y is -z, depth is -y.
struct Overhead {
    Light<double> light = directional(Vec3<double>(0, -1, 0));
    ShadowMap<double> map;

    explicit Overhead(ClipSpace clip = gl_zero_to_one_clip) {
        LightBox<double> box;
        box.lo = Vec2<double>(-5, -10);
        box.hi = Vec2<double>(5, 10);
        box.depth_lo = -20;
        box.depth_hi = 20;
        map.clip_from_world = clip_from_world(box, clip);
        map.clip = clip;
        map.visible = true;
    }
};

[[nodiscard]] inline ShadowMap<double> spot_map(double z_near, double z_far) {
    ShadowMap<double> map;
    Pose<double> const pose = pose_looking(Vec3<double>(0), Vec3<double>(0, -1, 0), Vec3<double>(0, 0, 1));
    map.clip_from_world = clip_from_world(perspective_view(pose, 1.0, 1.0, z_near, z_far), gl_zero_to_one_clip);
    map.clip = gl_zero_to_one_clip;
    map.visible = true;
    return map;
}

}  // namespace shadowmath::test
