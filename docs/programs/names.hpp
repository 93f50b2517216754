// SPDX-License-Identifier: MIT
//
// What the code on the pages takes for granted: a view, lights, boxes, a renderer. scripts/docs compiles every block
// against it, so a name that is not here is one that a page must introduce.
#pragma once

#include <shadowmath/shadowmath.hpp>

#include <cstdint>
#include <vector>

namespace sm = shadowmath;

// The eye and what it sees.
extern glm::vec3 const eye, forward, up;  // world
extern float const fov_y_radians, aspect, z_near, z_far;
extern sm::ViewVolume<float> const view;
extern glm::mat4 const projection;  // clip_from_view, of the renderer
extern glm::vec2 const eye_pixels;
extern int const width, height;  // of the picture
extern float const eye_depth;    // of the receiver, metres

// Lights and the scene.
extern glm::vec3 const sun_travel, lamp_position, lamp_axis;
extern sm::Light<float> const sun, lamp;
extern sm::Aabb<float> const casters, receivers;  // world boxes
extern glm::vec3 const point, normal;             // of a receiver
extern std::uint64_t const frame;

// Maps.
extern int const map_size;
extern sm::ShadowMap<float> const map;
extern sm::MapBias<float> const bias;
extern sm::Cascades<float> const cascades;
extern sm::CascadeOptions<float> const options;

// The renderer.
float stored_depth(int x, int y);
void draw_depth(glm::mat4 const& clip_from_world);
void draw_into(sm::MapMask maps);
void upload(void const* bytes, std::size_t size);
void log(char const* sentence);
