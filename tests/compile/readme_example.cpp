// SPDX-License-Identifier: MIT
//
// The lines of the README, word for word: House.TheReadmeShowsCodeThatCompiles holds the two together.
#include <shadowmath/cascades.hpp>
namespace sm = shadowmath;

int readme_example(glm::vec3 eye, glm::vec3 forward, glm::vec3 up, float fov_y_radians, float aspect,
                   glm::vec3 sun_travel, sm::Aabb<float> const& casters, sm::Aabb<float> const& receivers);

namespace {
int drawn = 0;
void draw_depth(glm::mat4 const& clip_from_world, float depth_end) {
    drawn += sm::all_finite(clip_from_world) && depth_end > 0.0f;
}
void log(char const* sentence) {
    drawn -= sentence == nullptr;
}
}  // namespace

int readme_example(glm::vec3 eye, glm::vec3 forward, glm::vec3 up, float fov_y_radians, float aspect,
                   glm::vec3 sun_travel, sm::Aabb<float> const& casters, sm::Aabb<float> const& receivers) {
    // clang-format off
auto pose = sm::pose_looking(eye, forward, up);  // world space, metres
auto view = sm::perspective_view(pose, fov_y_radians, aspect, 0.1f, 1000.0f);
auto sun = sm::directional(sun_travel);          // the way the light goes
sm::CascadeOptions<float> options;               // 4 maps of 2048 texels, stable
options.shadow_distance = 250.0f;
options.clip = sm::vulkan_clip;                  // or gl_clip, d3d_clip, reversed(...)
auto cascades = sm::fit_cascades(view, sun, casters, receivers, options);
for (auto const& c : cascades)                   // one matrix, one split distance
    if (c.map.visible) draw_depth(c.map.clip_from_world, c.range.end);
if (cascades.faults.any()) log(sm::describe(cascades.faults));  // said, never thrown
    // clang-format on
    return drawn;
}
