// SPDX-License-Identifier: MIT
#include "examples/gallery/technique_fits.hpp"

#include <limits>
#include <span>

namespace shadowmath::gallery {

using backend::MapChoice;

ViewVolume<float> sampling_eye(scenes::View const& view, backend::Extent extent) {
    Pose<float> const pose = pose_looking(glm::vec3(view.eye), glm::vec3(view.forward), glm::vec3(view.up));
    return perspective_view(pose, float(view.fov_y_radians), float(extent.width) / float(extent.height),
                            float(view.z_near), std::numeric_limits<float>::infinity());
}

backend::FitPass eye_depth_pass(scenes::View const& view, backend::Extent extent) {
    return {extent, clip_from_world(sampling_eye(view, extent), sampling_clip), {}, {}, 0};
}

void sampled_maps(MapSet& set, Input const& in, SampleSplits kind, bool on_device, bool still) {
    ViewVolume<float> const camera = sampling_eye(in.view, in.extent);
    Light<float> const light = directional(glm::vec3(in.view.light_travel));
    float const shadow_distance = float(in.view.shadow_distance);
    Aabb<float> const casters{glm::vec3(in.casters.lo), glm::vec3(in.casters.hi)};
    int const width = in.extent.width, height = in.extent.height;
    SampleSplitOptions<float> splits;
    splits.kind = kind;
    SampleFitOptions<float> options;
    options.map_size = in.map_size;
    options.margin_texels = float(margin_texels);
    options.clip = drawn_clip;
    options.still = still;

    DepthCode<float> const code = depth_code(camera, sampling_clip);
    SampleDepths<float> depths = no_depths(camera.z_near, shadow_distance);
    for (float const stored : in.eye_depth.pixels) add(depths, decoded_depth(code, stored));
    SampleBounds<float> bounds =
        no_bounds(sample_splits(depths, splits.count, splits.kind, splits.least_ratio), splits.blend);
    SampleRays<float> const rays = sample_rays(camera, light, width, height);
    for (int y = 0; y < in.eye_depth.extent.height; ++y)
        for (int x = 0; x < in.eye_depth.extent.width; ++x)
            add(bounds, rays, x, y, decoded_depth(code, in.eye_depth.at(x, y)));
    Cascades<float> const fitted = fit_samples(rays, bounds, casters, options);

    note(set, fitted.faults);
    set.frame.choice = MapChoice::by_depth;
    std::vector<std::uint32_t> all_casters;
    for (std::uint32_t i = 0; i < in.scene.objects.size(); ++i)
        if (in.scene.objects[i].casts) all_casters.push_back(i);
    for (int i = 0; i < (on_device ? splits.count : fitted.count); ++i) {
        Cascade<float> cascade;  // of a split that was not needed: it ends where it begins, at the far end
        cascade.map.clip_from_world = nowhere<float>();
        cascade.range = {shadow_distance, shadow_distance, shadow_distance};
        if (i < fitted.count) cascade = fitted.at[i];
        MapBias<float> const bias = bias_for(cascade.map, light, in.map_size, BiasOptions<float>{});
        set.frame.maps[set.maps.size()] = constants_of(cascade.map, cascade.range, bias);
        set.maps.push_back({glm::dmat4(cascade.map.clip_from_world), all_casters});
        if (i < fitted.count) set.splits.push_back(cascade.range.end);
    }
    set.frame.map_count = int(set.maps.size());
    if (!set.splits.empty()) set.splits.insert(set.splits.begin(), in.seen.z_near);
    if (!on_device) return;
    GpuSampleFit const constants =
        gpu_sample_fit(camera, sampling_clip, shadow_distance, light, width, height, casters, splits, options);
    auto const bytes = std::as_bytes(std::span(&constants, std::size_t{1}));
    set.device_fit.assign(bytes.begin(), bytes.end());
    set.eye_depth_from_world = clip_from_world(camera, sampling_clip);
}

}  // namespace shadowmath::gallery
