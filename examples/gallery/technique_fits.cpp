// SPDX-License-Identifier: MIT
#include "examples/gallery/technique_fits.hpp"

#include <algorithm>
#include <cmath>

namespace shadowmath::gallery {

using backend::MapChoice;
using backend::Scene;
using scenes::View;

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

void add(MapSet& set, Input const& in, ShadowMap<double> const& map, SliceRange<double> const& range) {
    note(set, map.faults);
    if (!map.visible) return;
    BiasOptions<double> options;
    options.filter_radius = filter_radius;
    set.frame.maps[set.maps.size()] = constants_of(map, range, bias_for(map, in.light, in.map_size, options));
    set.maps.push_back({map.clip_from_world, casters_in(map, in.scene)});
    set.frame.map_count = int(set.maps.size());
}

SliceRange<double> whole(Input const& in) {
    return {in.seen.z_near, in.seen.z_far, in.seen.z_far};
}

namespace {

CascadeOptions<double> cascade_options(Input const& in, CascadeFit fit) {
    CascadeOptions<double> options;
    options.fit = fit;
    options.map_size = in.map_size;
    options.filter_radius = filter_radius;
    options.clip = drawn_clip;
    return options;
}

}  // namespace

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

CasterMaps<double> screen_of(View3 const& view) {
    ShadowMap<double> screen;
    screen.clip_from_world = clip_from_world(view, drawn_clip);
    screen.clip = drawn_clip;
    screen.visible = true;
    return caster_maps(&screen, 1);
}

namespace {

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

ShadowMap<double> map_on(ShadowPlane<double> const& plane, Input const& in) {
    VdsmOptions<double> options;
    options.map_size = in.map_size;
    options.margin_texels = margin_texels;
    return view_dependent_map(in.seen, in.light, plane, in.casters, in.receivers, options, drawn_clip);
}

// Surfaces of every so many-th pixel, from the eye's depth.
std::vector<SurfacePoint<double>> surfaces_seen(Input const& in) {
    ViewVolume<float> const camera = sampling_eye(in.view, in.extent);
    DepthCode<float> const code = depth_code(camera, sampling_clip);
    auto const [width, height] = in.eye_depth.extent;
    auto const point = [&](int x, int y) {
        double const depth = double(decoded_depth(code, in.eye_depth.at(x, y)));
        double const across = in.eye.left + (in.eye.right - in.eye.left) * (x + 0.5) / width;
        double const upward = in.eye.bottom + (in.eye.top - in.eye.bottom) * (y + 0.5) / height;
        return point_at(in.eye, across, upward, depth);
    };
    std::vector<SurfacePoint<double>> surfaces;
    int const step = std::max(1, width / 24);
    for (int y = step / 2; y + 1 < height; y += step)
        for (int x = step / 2; x + 1 < width; x += step) {
            glm::dvec3 const at = point(x, y);
            if (!(eye_depth(in.eye, at) < in.seen.z_far)) continue;
            surfaces.push_back({at, glm::cross(point(x + 1, y) - at, point(x, y + 1) - at)});
        }
    return surfaces;
}

}  // namespace

ShadowMap<double> thesis_map(Input const& in) {
    return map_on({glm::dvec3(0.0, 1.0, 0.0), -ground_height(in)}, in);
}

ShadowMap<double> chosen_plane_map(Input const& in) {
    std::vector<SurfacePoint<double>> const seen = surfaces_seen(in);
    PlaneChoice<double> const choice =
        choose_plane(in.seen, in.light, seen.data(), int(seen.size()), glm::dvec3(0.0, 1.0, 0.0));
    return choice.visible ? map_on(choice.plane, in) : ShadowMap<double>{};
}

ShadowMap<double> warped_map(Input const& in, WarpOptions<double> const& rule) {
    WarpOptions<double> options = rule;
    options.map_size = in.map_size;
    options.margin_texels = margin_texels;
    return simple_perspective_map(in.seen, in.light, in.casters, in.receivers, options, drawn_clip);
}

ShadowMap<double> lloyd_map(Input const& in) {
    double const angle = std::acos(glm::clamp(glm::dot(in.seen.pose.forward, in.light.direction), -1.0, 1.0));
    WarpOptions<double> rule;
    rule.strength = 1.0 + lloyd_eta(angle, std::atan(in.seen.top));
    return warped_map(in, rule);
}

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
    map.clip = drawn_clip;
    constexpr double zn = 0.05;
    map.clip_from_world = printed_simple_warp(2.0 * zn * in.eye.right, 2.0, zn, 1.0) * clip_from_world(box, drawn_clip);
    map.w_min = 0.01;
    map.visible = true;
    return map;
}

}  // namespace shadowmath::gallery
