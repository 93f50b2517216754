// SPDX-License-Identifier: MIT
//
// What the receiver pass hands to the driver, worked out once for all APIs: the whole view at once, or split by split,
// what reads one map after what reads another.
//
// For a split, GPU Gems 3, section 10.3.1 moves the camera's near and far end to the split's, so that what reaches
// over its ends is clipped there. A clipped triangle is another triangle: what is interpolated along it rounds
// otherwise, and shows as pixels that are dark here and lit in the whole view. So the camera stays, and the shader
// leaves out what reads another map: a split's pixels are bit for bit those of the whole view.
#pragma once

#include "backends/draw_plan.hpp"

#include <limits>
#include <span>
#include <vector>

namespace shadowmath::backend {

struct ViewDraw {
    FrameConstants frame;
    std::vector<Draw> draws;
};

// The receivers, and then the objects that receive nothing: drawn by the same shader with no map to read.
[[nodiscard]] inline std::vector<ViewDraw> plan_view(ScenePass const& pass, std::span<Object const> objects) {
    std::vector<ViewDraw> plan(2, ViewDraw{pass.frame, {}});
    plan[1].frame.map_count = 0;
    for (Object const& object : objects) append(plan[object.receives ? 0 : 1].draws, object);
    return plan;
}

// Split by split, with memory for one map.
struct SplitPlan {
    std::vector<DrawGroup> maps;
    std::vector<ViewDraw> views;  // one for each map, to be drawn while it is there; two more for the last
};

// The splits lie end to end: one for each map, in order, and one for what lies beyond the last, which is lit. One that
// ends where those before it do, or nearer, has no draws. Last come the objects that receive nothing.
[[nodiscard]] inline SplitPlan plan_split_by_split(DepthPass maps, ScenePass const& pass,
                                                   std::span<Object const> objects) {
    maps.way = DrawWay::pass_per_map;
    SplitPlan plan{plan_draws(maps, objects), {}};
    std::vector<ViewDraw> const whole = plan_view(pass, objects);
    FrameConstants unblended = pass.frame;  // no second map is there
    for (MapConstants& map : unblended.maps) map.blend_begin = map.depth_end;
    constexpr float beyond_all = std::numeric_limits<float>::infinity();
    float begin = -beyond_all;
    for (int i = 0; i <= pass.frame.map_count; ++i) {
        auto const at = static_cast<std::size_t>(i);
        ViewDraw view{unblended, {}};
        view.frame.split = i;
        float const end = i < pass.frame.map_count ? pass.frame.maps[at].depth_end : beyond_all;
        if (begin < end) {
            if (pass.shown.empty())
                view.draws = whole[0].draws;
            else
                for (std::uint32_t const object : pass.shown[at])
                    if (objects[object].receives) append(view.draws, objects[object]);
            begin = end;
        }
        plan.views.push_back(std::move(view));
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
