// SPDX-License-Identifier: MIT
#include "examples/gallery/techniques.hpp"

#include <shadowmath/shadowmath.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <span>
#include <utility>

namespace shadowmath::gallery {
namespace {

using backend::FrameConstants;
using backend::MapChoice;
using backend::MapConstants;
using backend::Scene;
using scenes::View;

// Maths in double, rounded to float once, when the matrices go to the shader.
using View3 = ViewVolume<double>;

constexpr ClipSpace clip = gl_zero_to_one_clip;  // what every backend draws with
constexpr double margin_texels = filter_radius + 1.0;

View3 eye_of(View const& view, backend::Extent extent) {
    Pose<double> const pose = pose_looking(view.eye, view.forward, view.up);
    return perspective_view(pose, view.fov_y_radians, double(extent.width) / double(extent.height), view.z_near,
                            std::max(2000.0, 2.0 * view.shadow_distance));
}

Light<double> light_of(View const& view) {
    return view.has_spot ? spot(view.spot_position, view.spot_axis, view.spot_half_angle_radians, view.spot_range)
                         : directional(view.light_travel);
}

Aabb<double> box_of(backend::Object const& object) {
    return {glm::dvec3(object.lo), glm::dvec3(object.hi)};
}

Aabb<double> box_of_all(Scene const& scene, bool backend::Object::*role) {
    Aabb<double> all;
    for (auto const& object : scene.objects)
        if (object.*role) all = merge(all, box_of(object));
    return all;
}

std::vector<std::uint32_t> casters_in(ShadowMap<double> const& map, Scene const& scene) {
    CasterMaps<double> const maps = caster_maps(&map, 1);
    std::vector<std::uint32_t> indices;
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i)
        if (scene.objects[i].casts && caster_mask(maps, box_of(scene.objects[i])) != 0) indices.push_back(i);
    return indices;
}

void note(MapSet& set, Faults faults) {
    for (std::uint32_t bit = 1; bit != 0; bit <<= 1)
        if (faults.bits & bit)
            set.note += (set.note.empty() ? "" : "; ") + std::string(describe(static_cast<Fault>(bit)));
}

// What a technique is given, made once.
struct Input {
    Scene const& scene;
    View3 eye;   // the whole camera
    View3 seen;  // up to the shadow distance
    Light<double> light;
    Aabb<double> casters, receivers;
    int map_size;
    View const& view;
    backend::Extent extent;
    backend::Image<float> const& eye_depth;  // as eye_depth_pass draws it; empty unless the technique asks
};

// Takes a map into the set, with the constants that its receivers need. Maps that serve nothing are left out.
void add(MapSet& set, Input const& in, ShadowMap<double> const& map, SliceRange<double> const& range) {
    note(set, map.faults);
    if (!map.visible) return;
    BiasOptions<double> options;
    options.filter_radius = filter_radius;
    MapBias<double> const bias = bias_for(map, in.light, in.map_size, options);
    MapConstants& constants = set.frame.maps[set.maps.size()];
    constants.clip_from_world = glm::mat4(map.clip_from_world);
    constants.depth_end = float(range.end);
    constants.blend_begin = float(range.blend_begin);
    constants.w_min = float(map.w_min);
    constants.bias_constant = float(bias.constant);
    constants.bias_w = float(bias.per_inverse_w);
    constants.bias_slope_texels = float(bias.slope_texels);
    constants.slope_limit = float(bias.slope_limit);
    set.maps.push_back({map.clip_from_world, casters_in(map, in.scene)});
    set.frame.map_count = int(set.maps.size());
}

SliceRange<double> whole(Input const& in) {
    return {in.seen.z_near, in.seen.z_far, in.seen.z_far};
}

CascadeOptions<double> cascade_options(Input const& in, CascadeFit fit) {
    CascadeOptions<double> options;
    options.fit = fit;
    options.map_size = in.map_size;
    options.filter_radius = filter_radius;
    options.clip = clip;
    return options;
}

void add(MapSet& set, Input const& in, Cascades<double> const& fitted) {
    note(set, fitted.faults);
    for (Cascade<double> const& cascade : fitted) {
        add(set, in, cascade.map, cascade.range);
        set.splits.push_back(cascade.range.end);
    }
    if (fitted.count > 0) set.splits.insert(set.splits.begin(), in.seen.z_near);
}

void cascades(MapSet& set, Input const& in, double lambda, CascadeFit fit, MapChoice choice) {
    set.frame.choice = choice;
    CascadeOptions<double> options = cascade_options(in, fit);
    options.lambda = lambda;
    add(set, in, fit_cascades(in.seen, in.light, in.casters, in.receivers, options));
}

ShadowMap<double> standard_map(Input const& in) {
    CascadeOptions<double> options = cascade_options(in, CascadeFit::tight);
    options.count = 1;
    Cascades<double> const fitted = fit_cascades(in.seen, in.light, in.casters, in.receivers, options);
    ShadowMap<double> map = fitted.count > 0 ? fitted.at[0].map : ShadowMap<double>{};
    map.faults |= fitted.faults;
    return map;
}

// What shows is what would be drawn into a map that looks as the eye does.
CasterMaps<double> screen_of(View3 const& view) {
    ShadowMap<double> screen;
    screen.clip_from_world = clip_from_world(view, clip);
    screen.clip = clip;
    screen.visible = true;
    return caster_maps(&screen, 1);
}

// Height of the ground for the thesis' shadow plane: the median foot of the objects in view.
double ground_height(Input const& in) {
    CasterMaps<double> const seen = screen_of(in.seen);
    std::vector<double> feet;
    for (auto const& object : in.scene.objects)
        if (object.receives && caster_mask(seen, box_of(object)) != 0) feet.push_back(double(object.lo.y));
    if (feet.empty()) return 0.0;
    auto const middle = feet.begin() + std::ptrdiff_t(feet.size() / 2);
    std::nth_element(feet.begin(), middle, feet.end());
    return *middle;
}

ShadowMap<double> thesis_map(Input const& in) {
    VdsmOptions<double> options;
    options.map_size = in.map_size;
    options.margin_texels = margin_texels;
    ShadowPlane<double> const ground{glm::dvec3(0.0, 1.0, 0.0), -ground_height(in)};
    return view_dependent_map(in.seen, in.light, ground, in.casters, in.receivers, options, clip);
}

ShadowMap<double> warped_map(Input const& in) {
    WarpOptions<double> options;
    options.map_size = in.map_size;
    options.margin_texels = margin_texels;
    return simple_perspective_map(in.seen, in.light, in.casters, in.receivers, options, clip);
}

// As the weblog describes it: a plain light map with the camera in its middle and the view along y, then the printed
// warp. Its w, h, zn and zf are found by trial there; these fill the width and cut nothing in depth.
ShadowMap<double> printed_map(Input const& in) {
    ShadowMap<double> map;
    LightBasis<double> const basis = warp_axes(in.eye.pose, in.light.direction).basis;
    LightBox<double> box = fit_box(basis, corners(in.seen), in.map_size, 0.0);
    DepthRange<double> const slice_depth{box.depth_lo, box.depth_hi, true};
    glm::dvec2 const middle(in_light(basis, in.eye.pose.position));
    box.lo = middle - in.seen.z_far;
    box.hi = middle + in.seen.z_far;
    DepthRange<double> const depth = depth_range(box, slice_depth, in.casters, in.receivers, false);
    if (!depth.visible) return map;
    box.depth_lo = depth.lo;
    box.depth_hi = depth.hi;
    map.clip = clip;
    constexpr double zn = 0.05;
    map.clip_from_world = printed_simple_warp(2.0 * zn * in.eye.right, 2.0, zn, 1.0) * clip_from_world(box, clip);
    map.w_min = 0.01;
    map.visible = true;
    return map;
}

// The eye as its depth is drawn for fits: in float, as the device has it, reversed and without an end.
ViewVolume<float> sampling_eye(View const& view, backend::Extent extent) {
    Pose<float> const pose = pose_looking(glm::vec3(view.eye), glm::vec3(view.forward), glm::vec3(view.up));
    return perspective_view(pose, float(view.fov_y_radians), float(extent.width) / float(extent.height),
                            float(view.z_near), std::numeric_limits<float>::infinity());
}
constexpr ClipSpace sampling_clip = reversed(clip);

// In float throughout, so that the device's own fit can be held against it bit for bit. Every split keeps its place,
// seen or not.
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
    options.clip = clip;
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
        MapConstants& constants = set.frame.maps[set.maps.size()];
        constants.clip_from_world = cascade.map.clip_from_world;
        constants.depth_end = cascade.range.end;
        constants.blend_begin = cascade.range.blend_begin;
        constants.bias_constant = bias.constant;
        constants.bias_slope_texels = bias.slope_texels;
        constants.slope_limit = bias.slope_limit;
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

struct Entry {
    Technique technique;
    bool quick;  // also in quick runs
    std::function<void(MapSet&, Input const&)> make;
    bool shown = true;  // false: of the flight alone
};

std::vector<Entry> const& entries() {
    auto const pssm = "GPU Gems 3 ch. 10 (Zhang et al. 2007)";
    // Lambda 0.65: at 0.1 m the near distance is hardly ever where the nearest receivers are, which weakens the
    // logarithm. By the first map that holds the point: a sphere reaches past its slice, and its texels are finer than
    // the next's.
    auto const four = [](double lambda, CascadeFit cascade_fit, MapChoice choice = MapChoice::by_map) {
        return [=](MapSet& set, Input const& in) { cascades(set, in, lambda, cascade_fit, choice); };
    };
    auto const single = [](ShadowMap<double> (*make)(Input const&)) {
        return [=](MapSet& set, Input const& in) { add(set, in, make(in), whole(in)); };
    };
    auto const sdsm = "Lauritzen, Salvi, Lefohn, I3D 2011";
    auto const sampled = [](SampleSplits kind, bool on_device, bool still = false) {
        return [=](MapSet& set, Input const& in) { sampled_maps(set, in, kind, on_device, still); };
    };
    static std::vector<Entry> const all = {
        {{"uniform-1", "One uniform map", "Williams 1978", 1024, 1, true}, true, single(standard_map)},
        {{"uniform-1-2048", "One uniform map, four times the texels", "Williams 1978", 2048, 1, true},
         false,
         single(standard_map)},
        {{"cascades-4-uniform", "Four cascades, uniform splits", pssm, 1024, 4, false},
         false,
         four(0.0, CascadeFit::stable)},
        {{"cascades-4-log", "Four cascades, logarithmic splits", pssm, 1024, 4, false},
         false,
         four(1.0, CascadeFit::stable)},
        {{"cascades-4-stable", "Four cascades, practical (λ 0.65), stable", pssm, 1024, 4, true},
         true,
         four(0.65, CascadeFit::stable)},
        {{"cascades-4-by-depth", "Four stable cascades, by depth, blended", pssm, 1024, 4, true},
         false,
         four(0.65, CascadeFit::stable, MapChoice::by_depth)},
        {{"cascades-4-tight", "Four cascades, practical (λ 0.65), tight", pssm, 1024, 4, true},
         false,
         four(0.65, CascadeFit::tight)},
        {{"sdsm-even", "Four maps fitted to what is seen, even splits", sdsm, 1024, 4, false, true},
         false,
         sampled(SampleSplits::even, false)},
        {{"sdsm", "Four maps fitted to what is seen, splits around gaps", sdsm, 1024, 4, false, true},
         false,
         sampled(SampleSplits::adaptive, false)},
        {{"sdsm-gpu", "The same, fitted on the GPU and used there", sdsm, 1024, 4, false, true},
         true,
         sampled(SampleSplits::adaptive, true)},
        {{"sdsm-still", "The same, still", sdsm, 1024, 4, false, true},
         false,
         sampled(SampleSplits::adaptive, false, true),
         false},
        {{"simple-perspective", "Simple perspective map, corrected", "weblog 2012", 1024, 1, false},
         true,
         single(warped_map)},
        {{"simple-printed", "Simple perspective map, as printed", "weblog 2012", 1024, 1, false},
         false,
         single(printed_map)},
        {{"vdsm", "View-dependent map, lit elsewhere", "Kwon 2002", 1024, 1, true}, false, single(thesis_map)},
        {{"vdsm-fallback", "View-dependent map, uniform map behind it", "Kwon 2002", 1024, 2, true},
         true,
         [](MapSet& set, Input const& in) {
             add(set, in, thesis_map(in), whole(in));
             add(set, in, standard_map(in), whole(in));
         }},
    };
    return all;
}

}  // namespace

std::vector<Technique> techniques(bool quick) {
    std::vector<Technique> list;
    for (Entry const& entry : entries())
        if (entry.shown && (entry.quick || !quick)) list.push_back(entry.technique);
    return list;
}

FrameConstants unshadowed(View const& view, backend::Extent extent) {
    View3 const eye = eye_of(view, extent);
    Light<double> const light = light_of(view);
    FrameConstants frame;
    frame.clip_from_world = glm::mat4(clip_from_world(eye, clip));
    frame.eye_position = glm::vec4(glm::vec3(eye.pose.position), 1.0f);
    frame.eye_forward = glm::vec4(glm::vec3(eye.pose.forward), 0.0f);
    frame.light =
        view.has_spot ? glm::vec4(glm::vec3(light.position), 1.0f) : glm::vec4(glm::vec3(-light.direction), 0.0f);
    if (view.has_spot)
        frame.spot_axis = glm::vec4(glm::vec3(light.direction), float(std::cos(light.half_angle_radians)));
    frame.filter_radius = filter_radius;
    return frame;
}

backend::FitPass eye_depth_pass(View const& view, backend::Extent extent) {
    return {extent, clip_from_world(sampling_eye(view, extent), sampling_clip), {}, {}, 0};
}

namespace {

Input input_of(Scene const& scene, View const& view, backend::Extent extent, int map_size,
               backend::Image<float> const& eye_depth) {
    View3 const eye = eye_of(view, extent);
    View3 seen = eye;
    seen.z_far = view.shadow_distance;
    return {scene,
            eye,
            seen,
            light_of(view),
            box_of_all(scene, &backend::Object::casts),
            box_of_all(scene, &backend::Object::receives),
            map_size,
            view,
            extent,
            eye_depth};
}

MapSet no_maps(View const& view, backend::Extent extent, int map_size) {
    MapSet set;
    set.map_size = map_size;
    set.frame = unshadowed(view, extent);
    set.frame.map_size = float(map_size);
    set.frame.choice = MapChoice::by_map;
    return set;
}

}  // namespace

MapSet fit(Technique const& technique, Scene const& scene, View const& view, backend::Extent extent,
           backend::Image<float> const& eye_depth) {
    MapSet set = no_maps(view, extent, technique.map_size);
    Input const in = input_of(scene, view, extent, technique.map_size, eye_depth);
    for (Entry const& entry : entries())
        if (entry.technique.id == technique.id) entry.make(set, in);
    return set;
}

MapSet fit_cascade_maps(Scene const& scene, View const& view, backend::Extent extent, CascadeOptions<double> options,
                        Cascades<double>& last) {
    MapSet set = no_maps(view, extent, options.map_size);
    backend::Image<float> const no_depth;
    Input const in = input_of(scene, view, extent, options.map_size, no_depth);
    options.filter_radius = filter_radius;
    options.clip = clip;
    last = fit_cascades(in.seen, in.light, in.casters, in.receivers, options, &last);
    add(set, in, last);
    return set;
}

CascadeOptions<double> choose_cascades(Scene const& scene, View const& view, backend::Extent extent,
                                       std::span<SurfacePoint<double> const> samples,
                                       CascadeOptions<double> const& options, ChoiceLimits<double> const& limits) {
    backend::Image<float> const no_depth;
    Input const in = input_of(scene, view, extent, options.map_size, no_depth);
    CascadeOptions<double> given = options;
    given.filter_radius = filter_radius;
    given.clip = clip;
    return choose(in.seen, in.light, in.casters, in.receivers, samples.data(), int(samples.size()), given, limits)
        .options;
}

SplitObjects objects_in_splits(MapSet const& set, Scene const& scene, View const& view, backend::Extent extent) {
    View3 const eye = eye_of(view, extent);
    CasterMaps<double> const screen = screen_of(eye);
    SplitObjects shown(set.maps.size() + 1);
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i) {
        Aabb<double> const box = box_of(scene.objects[i]);
        if (caster_mask(screen, box) == 0) continue;
        double const middle = glm::dot(eye.pose.forward, 0.5 * (box.lo + box.hi) - eye.pose.position);
        double const reach = glm::dot(glm::abs(eye.pose.forward), 0.5 * (box.hi - box.lo));
        double begin = 0.0;
        for (std::size_t split = 0; split < shown.size(); ++split) {
            bool const is_last = split == set.maps.size();
            double const end = is_last ? eye.z_far : double(set.frame.maps[split].depth_end);
            constexpr double slack = 1e-2;  // the eye's depth buffer rounds an end by end / z_near * 2^-24 of it
            if (middle - reach <= end * (1.0 + slack) && middle + reach >= begin * (1.0 - slack))
                shown[split].push_back(i);
            begin = end;
        }
    }
    return shown;
}

}  // namespace shadowmath::gallery
