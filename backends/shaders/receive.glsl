// SPDX-License-Identifier: MIT
//
// What the receiver pass reads: backends/backend.hpp's FrameConstants in std140, member by member.

const int max_maps = 8;
const int choose_by_depth = 0;

struct MapConstants {
    mat4 clip_from_world;
    float depth_end;
    float blend_begin;
    float w_min;
    float bias_constant;
    float bias_slope_texels;
    float slope_limit;
    float bias_w;
};

layout(std140, binding = 0) uniform FrameConstants {
    mat4 clip_from_world;
    vec4 eye_position;
    vec4 eye_forward;
    vec4 light;
    vec4 spot_axis;
    vec4 ambient;
    vec4 light_colour;
    vec4 sky;
    int map_count;
    int choice;
    int filter_radius;
    int tap_plane;
    float map_size;
    float specular;
    float specular_power;
    int split;
    MapConstants maps[max_maps];
} frame;
