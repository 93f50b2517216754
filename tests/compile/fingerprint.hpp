// SPDX-License-Identifier: MIT
//
// The bits of what shadowmath computes for one view and one light, technique by technique. The files that include this
// set GLM's macros in opposite ways; a unit test compares what they return.
#pragma once

#include "every_header.hpp"

#include <array>
#include <cstdint>
#include <cstring>

namespace {

using Fingerprint = std::array<std::uint64_t, 6>;

// FNV-1a over the numbers of a matrix, whose layout no macro may change.
std::uint64_t hash(shadowmath::Mat4<double> const& matrix) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (int column = 0; column < 4; ++column)
        for (int r = 0; r < 4; ++r) {
            double const value = matrix[column][r];
            unsigned char bytes[sizeof value];
            std::memcpy(bytes, &value, sizeof value);
            for (unsigned char const byte : bytes) hash = (hash ^ byte) * 0x100000001b3u;
        }
    return hash;
}

Fingerprint fingerprint() {
    using namespace shadowmath;
    using V = Vec3<double>;
    auto const pose = pose_looking(V(3, 2, 5), V(1, -0.2, -2), V(0, 1, 0));
    auto const view = perspective_view(pose, 1.0, 1.5, 0.1, 60.0);
    auto const sun = directional(V(0.4, -1, 0.3));
    auto const lamp = spot(V(8, 9, -6), V(-0.1, -1, 0), 0.6, 30.0);
    Aabb<double> const scene{V(-40, 0, -60), V(40, 6, 10)};
    auto const cascades = fit_cascades(view, sun, scene, scene, CascadeOptions<double>{});
    auto const warped = simple_perspective_map(view, sun, scene, scene, WarpOptions<double>{}, gl_clip);
    auto const on_plane = view_dependent_map(view, sun, mean_height_plane(scene, V(0, 1, 0)), scene, scene,
                                             VdsmOptions<double>{}, gl_clip);
    return {hash(clip_from_world(view, gl_clip)),
            hash(cascades.at[0].map.clip_from_world),
            hash(cascades.at[3].map.clip_from_world),
            hash(fit_spot(view, lamp, scene, scene, 1024, 2.0, gl_clip).clip_from_world),
            hash(warped.clip_from_world),
            hash(on_plane.clip_from_world)};
}

}  // namespace
