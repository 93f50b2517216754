// SPDX-License-Identifier: MIT
//
// What the receiver pass hands to the driver, worked out once for all APIs: the whole view at once, or in slices of eye
// depth, one for each map.
//
// For slices, GPU Gems 3, section 10.3.1 moves the camera's near and far end to the split's, so that what reaches over
// its ends is clipped there, and sets the viewport's depth range so that depths stay comparable. Both follow from the
// eye's own matrix: with z_begin and z_end its depths at the split's ends, the split's matrix has
// z' = (z - z_begin w) / (z_end - z_begin), and the viewport takes [0, 1] back to [z_begin, z_end]. The other rows stay
// as they are, so a vertex falls on the same point of the picture in every split.
#pragma once

#include "backends/draw_plan.hpp"

#include <cmath>
#include <limits>
#include <span>
#include <vector>

namespace shadowmath::backend {

struct ViewDraw {
    FrameConstants frame;
    std::vector<Draw> draws;
    float z_begin = 0.0f;  // the viewport's depth range
    float z_end = 1.0f;
};

// The receivers, and then the objects that receive nothing: drawn by the same shader with no map to read.
[[nodiscard]] inline std::vector<ViewDraw> plan_view(ScenePass const& pass, std::span<Object const> objects) {
    std::vector<ViewDraw> plan(2, ViewDraw{pass.frame, {}});
    plan[1].frame.map_count = 0;
    for (Object const& object : objects) append(plan[object.receives ? 0 : 1].draws, object);
    return plan;
}

// The eye's depth buffer value, 0 to 1, of what lies so many metres ahead; 1 where there is none.
[[nodiscard]] inline float z_of_depth(FrameConstants const& frame, float depth_metres) {
    glm::dmat4 const clip_from_world(frame.clip_from_world);
    glm::dvec3 const point = glm::dvec3(frame.eye_position) + double(depth_metres) * glm::dvec3(frame.eye_forward);
    glm::dvec4 const clip = clip_from_world * glm::dvec4(point, 1.0);
    double const z = clip.z / clip.w;
    return clip.w > 0.0 && z < 1.0 ? static_cast<float>(std::fmax(z, 0.0)) : 1.0f;
}

// The eye's matrix for what lies between two values of its depth buffer.
[[nodiscard]] inline glm::mat4 cut(glm::mat4 const& clip_from_world, float z_begin, float z_end) {
    glm::dmat4 clip(clip_from_world);
    for (int column = 0; column < 4; ++column)
        clip[column].z = (clip[column].z - double(z_begin) * clip[column].w) / (double(z_end) - double(z_begin));
    return glm::mat4(clip);
}

// Split by split, with memory for one map.
struct SplitPlan {
    std::vector<DrawGroup> maps;
    std::vector<ViewDraw> views;  // one for each map, to be drawn while it is there; two more for the last
};

// The slices lie end to end and fill [0, 1]: one for each map, in order, and one for what lies beyond the last, which
// is lit. A slice with nothing in it has no draws. Last come the objects that receive nothing.
[[nodiscard]] inline SplitPlan plan_split_by_split(DepthPass maps, ScenePass const& pass,
                                                   std::span<Object const> objects) {
    maps.way = DrawWay::pass_per_map;
    SplitPlan plan{plan_draws(maps, objects), {}};
    std::vector<ViewDraw> const whole = plan_view(pass, objects);
    float z = 0.0f;
    for (int i = 0; i <= pass.frame.map_count; ++i) {
        ViewDraw slice{whole[1].frame, {}, z, 1.0f};
        auto const at = static_cast<std::size_t>(i);
        if (i < pass.frame.map_count) {
            slice.z_end = std::fmax(z, z_of_depth(pass.frame, pass.frame.maps[at].depth_end));
            slice.frame.map_count = 1;
            slice.frame.first_map = i;
            // The clipper has chosen the map: the shader need not ask, nor round to the other side.
            MapConstants& map = slice.frame.maps[0] = pass.frame.maps[at];
            map.depth_end = map.blend_begin = std::numeric_limits<float>::max();
        }
        z = slice.z_end;
        if (slice.z_begin < slice.z_end) {
            slice.frame.clip_from_world = cut(pass.frame.clip_from_world, slice.z_begin, slice.z_end);
            if (pass.shown.empty())
                slice.draws = whole[0].draws;
            else
                for (std::uint32_t const object : pass.shown[at])
                    if (objects[object].receives) append(slice.draws, objects[object]);
        }
        plan.views.push_back(std::move(slice));
    }
    plan.views.push_back(whole[1]);
    return plan;
}

// What one pass over these comes to.
[[nodiscard]] inline DrawWork work_of(std::span<ViewDraw const> views) {
    DrawWork work;
    work.passes = 1;
    for (ViewDraw const& view : views) count(work, view.draws);
    return work;
}

[[nodiscard]] inline DrawWork work_of(SplitPlan const& plan) {
    DrawWork work = work_of(DrawWay::pass_per_map, plan.maps);
    work.passes += plan.maps.size();
    for (ViewDraw const& view : plan.views) count(work, view.draws);
    return work;
}

}  // namespace shadowmath::backend
