// SPDX-License-Identifier: MIT
//
// Exact hard shadows in a shader: a pixel as a piece of plane, the shadow volume of a triangle as four half planes of
// that pixel, and which of its 32 samples they hold. The GLSL twin of irregular/microquad.hpp, edge.hpp and mask.hpp;
// every sum in its order written out and kept, so that both triangles at an edge see opposite values to the last bit.
// Where large terms cancel it sums in double, as the C++ does; samples may differ from the C++ that lie on an edge to
// within a float's rounding.
#ifndef SM_IRREGULAR_GLSL
#define SM_IRREGULAR_GLSL

#include "finite.glsl"

const uint sm_every_sample = 0xffffffffu;
const float sm_least_normal = 1.17549435e-38;

// In the order of the C++, last product first.
float sm_inner(vec3 a, vec3 b) {
    precise float sum = a.x * b.x + (a.y * b.y + a.z * b.z);
    return sum;
}

// irregular/gpu.hpp fills these.
struct sm_PixelFrame {
    vec3 eye;  // world
    int width;
    vec3 across;
    int height;
    vec3 upward;
    int orthographic;
    vec3 inward;
    float origin_x;
    vec3 to_across;
    float origin_y;
    vec3 to_upward;
    float turn_limit;
    vec3 to_inward;
    float unused;
};
struct sm_PixelLight {
    vec3 at;
    int parallel;
    vec3 source;  // world: how it travels, or where it stands
    float unused;
};

struct sm_MicroQuad {
    float q;
    float q_rest;  // what its rounding left out
    float q_x;
    float q_y;
    bool ok;
};

// Halton points of bases 2 and 3, from index 1 on.
const float sm_sample_v[32] = float[](
    0.333333343, 0.666666687, 0.111111112, 0.444444448, 0.777777791, 0.222222224, 0.555555582, 0.888888896,
    0.0370370373, 0.370370388, 0.703703701, 0.148148149, 0.481481493, 0.814814806, 0.259259254, 0.592592597,
    0.92592591, 0.0740740746, 0.407407403, 0.740740776, 0.185185194, 0.518518507, 0.851851881, 0.296296299,
    0.629629672, 0.962962985, 0.0123456791, 0.345679015, 0.679012358, 0.123456791, 0.456790119, 0.790123463);

vec2 sm_pixel_sample(int i) {
    return vec2(float(bitfieldReverse(uint(i + 1))) * 2.3283064365386963e-10, sm_sample_v[i]);
}

// The left and lower corner of a pixel, from the middle of the picture.
vec2 sm_pixel_corner(sm_PixelFrame frame, ivec2 pixel) {
    return vec2(pixel) - vec2(frame.width, frame.height) * 0.5;
}
// A world normal as a covector of the pixel frame.
vec3 sm_normal_in_pixels(sm_PixelFrame frame, vec3 normal) {
    return vec3(sm_inner(frame.across, normal), sm_inner(frame.upward, normal), sm_inner(frame.inward, normal));
}

// The plane's piece through `depth` in the middle of the pixel; n is the normal in pixels. Not ok for sky: a normal
// of no length, a depth that is not positive before an eye of perspective, or anything that is not finite.
sm_MicroQuad sm_micro_quad(sm_PixelFrame frame, ivec2 pixel, float depth, vec3 n) {
    bool flat_eye = frame.orthographic != 0;
    sm_MicroQuad none = sm_MicroQuad(0.0, 0.0, 0.0, 0.0, false);
    if (!sm_all_finite(depth) || !sm_all_finite(n) || (!flat_eye && !(depth >= sm_least_normal))) return none;
    vec2 middle = sm_pixel_corner(frame, pixel) + 0.5;
    precise float facing = flat_eye ? -n.z : n.x * middle.x + (n.y * middle.y + n.z);
    precise float steep = (abs(n.x) + abs(n.y)) * frame.turn_limit;
    float size = max(abs(facing), steep);
    if (!(size >= sm_least_normal)) return none;
    float divisor = facing < 0.0 ? -size : size;
    precise float scale = 1.0 / (flat_eye ? divisor : divisor * depth);
    precise float q_x = n.x * scale;
    precise float q_y = n.y * scale;
    precise float to_corner = (q_x + q_y) * 0.5;
    // divisor * scale is one over the depth, whatever the plane was turned to.
    precise double exact = (flat_eye ? double(depth) : 1.0LF / double(depth)) - double(to_corner);
    float q = float(exact);
    precise float rest = float(exact - double(q));
    return sm_MicroQuad(q, rest, q_x, q_y, sm_all_finite(q) && sm_all_finite(q_x) && sm_all_finite(q_y));
}

// True where light and eye are on the same side of the pixel's surface.
bool sm_faces_light(sm_PixelFrame frame, sm_PixelLight light, ivec2 pixel, float depth, vec3 n) {
    bool flat_eye = frame.orthographic != 0;
    vec2 middle = sm_pixel_corner(frame, pixel) + 0.5;
    precise float toward_middle = flat_eye ? n.z : n.x * middle.x + (n.y * middle.y + n.z);
    precise float travel = n.x * light.at.x + (n.y * light.at.y + n.z * light.at.z);
    if (light.parallel == 0) {
        precise float there = flat_eye ? n.x * middle.x + (n.y * middle.y + n.z * depth) : depth * toward_middle;
        precise float gone = there - travel;
        travel = gone;
    }
    return (travel >= sm_least_normal && toward_middle >= sm_least_normal) ||
           (travel <= -sm_least_normal && toward_middle <= -sm_least_normal);
}

// The frame and the light as shadow volumes need them: sums in them cancel, and a float would be left with noise.
struct sm_ExactFrame {
    dvec3 eye;
    dvec3 origin;
    dvec3 to_across;
    dvec3 to_upward;
    dvec3 to_inward;
    dvec3 light;
    bool parallel;
    bool orthographic;
};

double sm_inner(dvec3 a, dvec3 b) {
    precise double sum = a.x * b.x + (a.y * b.y + a.z * b.z);
    return sum;
}
dvec3 sm_cross(dvec3 a, dvec3 b) {
    precise dvec3 c = dvec3(a.y * b.z - b.y * a.z, a.z * b.x - b.z * a.x, a.x * b.y - b.x * a.y);
    return c;
}

dvec3 sm_direction_in_pixels(sm_ExactFrame frame, dvec3 v) {
    return dvec3(sm_inner(frame.to_across, v), sm_inner(frame.to_upward, v), sm_inner(frame.to_inward, v));
}
dvec3 sm_point_in_pixels(sm_ExactFrame frame, vec3 point) {
    precise dvec3 at = sm_direction_in_pixels(frame, dvec3(point) - frame.eye) - frame.origin;
    return at;
}

sm_ExactFrame sm_exact_frame(sm_PixelFrame frame, sm_PixelLight light) {
    dvec3 across = dvec3(frame.across);
    dvec3 upward = dvec3(frame.upward);
    dvec3 inward = dvec3(frame.inward);
    dvec3 normal = sm_cross(across, upward);
    double volume = sm_inner(normal, inward);
    sm_ExactFrame exact;
    exact.eye = dvec3(frame.eye);
    exact.origin = dvec3(frame.origin_x, frame.origin_y, 0.0);
    exact.to_across = sm_cross(upward, inward) / volume;
    exact.to_upward = sm_cross(inward, across) / volume;
    exact.to_inward = normal / volume;
    exact.parallel = light.parallel != 0;
    exact.orthographic = frame.orthographic != 0;
    exact.light = exact.parallel ? sm_direction_in_pixels(exact, dvec3(light.source))
                                 : sm_point_in_pixels(exact, light.source);
    return exact;
}

dvec4 sm_pixel_plane(sm_ExactFrame frame, dvec3 n, double offset) {
    return frame.orthographic ? dvec4(n.xy, offset, n.z) : dvec4(n, offset);
}

// The four half spaces of a triangle's shadow: its own plane, then one through light and each edge; x, y, a, b as in
// irregular/microquad.hpp. Vertices in pixels. False where it has no area as seen from the light: it casts nothing.
bool sm_shadow_volume(sm_ExactFrame frame, dvec3 p[3], double margin_metres, double margin_share,
                      out dvec4 planes[4]) {
    precise dvec3 first = p[1] - p[0];
    precise dvec3 second = p[2] - p[0];
    precise dvec3 source = p[0] - frame.light;
    dvec3 normal = sm_cross(first, second);
    double along = sm_inner(normal, frame.parallel ? frame.light : source);
    double turn = along < 0.0LF ? -1.0LF : 1.0LF;
    dvec3 facing = normal * turn;
    precise dvec3 in_world =
        frame.to_across * facing.x + (frame.to_upward * facing.y + frame.to_inward * facing.z);
    precise double unit = abs(in_world.x) + abs(in_world.y) + abs(in_world.z);
    precise double lifted = facing.z - unit * margin_share;
    precise double offset = -(unit * margin_metres + sm_inner(facing, p[0]));
    planes[0] = sm_pixel_plane(frame, dvec3(facing.xy, lifted), offset);
    for (int i = 0; i < 3; ++i) {
        dvec3 from = p[i];
        dvec3 to = p[(i + 1) % 3];
        precise dvec3 both = from + to;
        precise dvec3 beyond = both - frame.light * 2.0LF;
        precise dvec3 edge = (to - from) * turn;
        dvec3 n = sm_cross(frame.parallel ? frame.light : beyond, edge);
        precise double c = sm_inner(n, both) * -0.5LF;
        planes[1 + i] = sm_pixel_plane(frame, n, c);
    }
    return abs(along) >= double(sm_least_normal);
}

// c + x u + y v >= 0 inside, u and v from 0 to 1 over the pixel.
vec3 sm_line_across(dvec4 plane, vec2 corner, sm_MicroQuad quad) {
    precise double q = double(quad.q) + double(quad.q_rest);
    // Here large terms cancel.
    precise double c = plane.x * double(corner.x) + plane.y * double(corner.y) + (plane.z + plane.w * q);
    precise float x = float(plane.x) + float(plane.w) * quad.q_x;
    precise float y = float(plane.y) + float(plane.w) * quad.q_y;
    return vec3(float(c), x, y);
}
vec3 sm_line_across(vec4 plane, vec2 corner, sm_MicroQuad quad) {
    precise float c = plane.x * corner.x + plane.y * corner.y + (plane.z + plane.w * quad.q);
    precise float x = plane.x + plane.w * quad.q_x;
    precise float y = plane.y + plane.w * quad.q_y;
    return vec3(c, x, y);
}

// The samples that the half plane holds.
uint sm_half_plane_mask(vec3 line) {
    uint mask = 0u;
    for (int i = 0; i < 32; ++i) {
        vec2 at = sm_pixel_sample(i);
        precise float value = (line.x + line.y * at.x) + line.z * at.y;
        mask |= (value >= 0.0 ? 1u : 0u) << i;
    }
    return mask;
}

// The samples of a pixel that the triangle with these planes takes the light of.
uint sm_occluded(dvec4 planes[4], vec2 corner, sm_MicroQuad quad) {
    vec3 lines[4];
    bool covered = true;
    for (int i = 0; i < 4; ++i) {
        lines[i] = sm_line_across(planes[i], corner, quad);
        // Rounded as a sample is, and rounding is monotone: no sample lies beyond these.
        precise float most = (lines[i].x + max(lines[i].y, 0.0)) + max(lines[i].z, 0.0);
        if (!(most >= 0.0)) return 0u;
        precise float least = (lines[i].x + min(lines[i].y, 0.0)) + min(lines[i].z, 0.0);
        covered = covered && least >= 0.0;
    }
    if (covered) return sm_every_sample;
    uint mask = sm_every_sample;
    for (int i = 0; i < 4; ++i) mask &= sm_half_plane_mask(lines[i]);
    return mask;
}

#endif
