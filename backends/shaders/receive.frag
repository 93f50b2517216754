// SPDX-License-Identifier: MIT
//
// Shades what the eye sees: (ambient + (diffuse + specular) * shadow) * albedo, with Blinn's highlight
// (Kwon 2002, section 4.4). Colours are linear; the sRGB attachment encodes them.
#version 450
#include "receive.glsl"
#include "shadow.glsl"

layout(location = 0) in vec3 position_from_eye;
layout(location = 1) in vec3 shading_normal;
layout(location = 2) in vec3 reflectance;

layout(location = 0) out vec4 colour;
layout(location = 1) out vec4 position_and_map;       // world; w: map, -1 none
layout(location = 2) out vec4 normal_and_visibility;  // geometric, toward the eye

// All sums are written out and kept, or drivers would fuse them differently and some pixels differ by one of 255.
vec3 direction_or(vec3 v, vec3 fallback) {
    precise float size = sqrt(sm_dot(v, v));
    precise vec3 direction = v / size;
    return size > 0.0 ? direction : fallback;
}

// The triangle's own plane: interpolated normals belong to a surface that is not there.
vec3 geometric_normal(vec3 to_eye) {
    vec3 normal = direction_or(sm_cross(dFdx(position_from_eye), dFdy(position_from_eye)), to_eye);
    return sm_dot(normal, to_eye) < 0.0 ? -normal : normal;
}

// 0 outside the spot light's cone, 1 inside, with a soft rim on its inner side.
float cone(vec3 to_light) {
    float cos_outer = frame.spot_axis.w;
    if (cos_outer <= -2.0) return 1.0;
    precise float rim = (1.0 - cos_outer) * 0.1;
    precise float inward = clamp((sm_dot(-to_light, frame.spot_axis.xyz) - cos_outer) / rim, 0.0, 1.0);
    precise float share = inward * inward * (3.0 - 2.0 * inward);
    return share;
}

void main() {
    precise vec3 point = frame.eye_position.xyz + position_from_eye;
    precise vec3 way = frame.light.xyz - point;
    vec3 to_eye = direction_or(-position_from_eye, -frame.eye_forward.xyz);
    vec3 to_light = direction_or(frame.light.w == 0.0 ? frame.light.xyz : way, to_eye);
    vec3 plane_normal = geometric_normal(to_eye);
    float spot = cone(to_light);

    sm_LookUp look_up = look_up_at(point, sm_dot(frame.eye_forward.xyz, position_from_eye));
    if (is_of_another_split(look_up)) discard;
    float visibility = spot == 0.0 ? 0.0 : visibility_at(look_up, point, plane_normal);

    vec3 normal = direction_or(shading_normal, plane_normal);
    if (sm_dot(normal, plane_normal) < 0.0) normal = -normal;  // the back of an open mesh
    float diffuse = max(sm_dot(normal, to_light), 0.0);
    precise vec3 between = to_light + to_eye;
    float facing_half = max(sm_dot(normal, direction_or(between, normal)), 0.0);
    precise float specular = diffuse > 0.0 ? frame.specular * pow(facing_half, frame.specular_power) : 0.0;
    precise vec3 direct = frame.light_colour.rgb * ((diffuse + specular) * spot * visibility);
    precise vec3 shaded = (frame.ambient.rgb + direct) * reflectance;

    colour = vec4(shaded, 1.0);
    position_and_map = vec4(point, float(look_up.first));
    normal_and_visibility = vec4(plane_normal, visibility);
}
