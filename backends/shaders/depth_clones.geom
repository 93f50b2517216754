// SPDX-License-Identifier: MIT
//
// Clones a caster's triangle into each map that its object is listed in (Zhang, Sun, Nyman 2007, 10.3.3). The chapter
// has a first and a last split; a set of maps may also have holes.
#version 450
#include "maps.glsl"
#include "shadowmath/glsl/tangent.glsl"

layout(triangles) in;
layout(triangle_strip, max_vertices = 24) out;

layout(location = 0) in vec3 point[];
layout(location = 1) flat in uint maps[];

void main() {
    for (int map = 0; map < clip_from_world.length(); ++map) {
        if ((maps[0] >> map & 1u) == 0u) continue;
        for (int corner = 0; corner < 3; ++corner) {
            gl_Layer = map;
            gl_Position = sm_transformed(clip_from_world[map], point[corner]);
            EmitVertex();
        }
        EndPrimitive();
    }
}
