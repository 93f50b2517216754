// SPDX-License-Identifier: MIT
//
// clip_from_world * (point, 1) with its order of sums written out, and kept: a caster, its receiver, and every driver
// with any compiler of this text round alike.

vec4 transformed(mat4 clip_from_world, vec3 point) {
    precise vec4 clip = clip_from_world[0] * point.x +
                        (clip_from_world[1] * point.y + (clip_from_world[2] * point.z + clip_from_world[3]));
    return clip;
}
