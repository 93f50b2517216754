// SPDX-License-Identifier: MIT
//
// The functions of the irregular z-buffer.
#version 450
#include "twin.glsl"
#include "shadowmath/glsl/irregular.glsl"

sm_PixelFrame take_frame() {
    sm_PixelFrame frame;
    frame.eye = take3();
    frame.width = take_int();
    frame.across = take3();
    frame.height = take_int();
    frame.upward = take3();
    frame.orthographic = take_int();
    frame.inward = take3();
    frame.origin_x = take();
    frame.to_across = take3();
    frame.origin_y = take();
    frame.to_upward = take3();
    frame.turn_limit = take();
    frame.to_inward = take3();
    frame.unused = 0.0;
    return frame;
}

sm_PixelLight take_light() {
    sm_PixelLight light;
    light.at = take3();
    light.parallel = take_int();
    light.source = take3();
    light.unused = 0.0;
    return light;
}

ivec2 take_pixel() {
    int x = take_int();
    return ivec2(x, take_int());
}

void answer(uint function) {
    sm_PixelFrame frame;
    sm_PixelLight light;
    sm_ExactFrame exact;
    sm_MicroQuad quad;
    ivec2 pixel;
    vec3 a, b;
    float depth;
    uint care;
    switch (function) {
        case 0u:
            a = take3();
            b = take3();
            give(sm_inner(a, b));
            give(float(sm_inner(dvec3(a), dvec3(b))));
            give(vec3(sm_cross(dvec3(a), dvec3(b))));
            break;
        case 1u: give(sm_pixel_sample(take_int())); break;
        case 2u:
            frame = take_frame();
            give(sm_pixel_corner(frame, take_pixel()));
            give(sm_normal_in_pixels(frame, take3()));
            break;
        case 3u: give(sm_half_plane_mask(take3())); break;
        case 4u:
            a = take3();
            depth = take();
            quad = sm_MicroQuad(take(), 0.0, 0.0, 0.0, true);
            quad.q_x = take();
            quad.q_y = take();
            give(sm_line_across(vec4(a, depth), take2(), quad));
            break;
        case 5u:
            frame = take_frame();
            pixel = take_pixel();
            a = take3();
            quad = sm_micro_quad(frame, pixel, take(), sm_normal_in_pixels(frame, a));
            give(quad.ok);
            give(quad.ok ? vec3(quad.q, quad.q_x, quad.q_y) : vec3(0.0));
            break;
        case 6u:
            frame = take_frame();
            light = take_light();
            pixel = take_pixel();
            a = take3();
            give(sm_faces_light(frame, light, pixel, take(), sm_normal_in_pixels(frame, a)));
            break;
        case 7u:
            frame = take_frame();
            light = take_light();
            exact = sm_exact_frame(frame, light);
            give(vec3(sm_point_in_pixels(exact, take3())));
            give(vec3(sm_direction_in_pixels(exact, dvec3(take3()))));
            give(vec3(exact.light));
            break;
        case 8u:
            frame = take_frame();
            light = take_light();
            exact = sm_exact_frame(frame, light);
            pixel = take_pixel();
            a = take3();
            quad = sm_micro_quad(frame, pixel, take(), sm_normal_in_pixels(frame, a));
            dvec3 corners[3];
            for (int i = 0; i < 3; ++i) corners[i] = sm_point_in_pixels(exact, take3());
            care = uint(take_int());
            dvec4 planes[4];
            bool casts = sm_shadow_volume(exact, corners, 0.0LF, 0.0LF, planes);
            give(quad.ok && casts);
            give(quad.ok && casts ? sm_occluded(planes, sm_pixel_corner(frame, pixel), quad) & care : 0u);
    }
}
