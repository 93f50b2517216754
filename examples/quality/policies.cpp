// SPDX-License-Identifier: MIT
#include "examples/quality/policies.hpp"

#include "examples/gallery/technique_fits.hpp"
#include "examples/quality/recipes.hpp"

#include <shadowmath/choose_maps.hpp>
#include <shadowmath/shadowmath.hpp>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <functional>
#include <limits>
#include <stdexcept>

namespace shadowmath::quality {
namespace {

using gallery::box_of;
using gallery::eye_of;
using gallery::margin_texels;
using scenes::View;

constexpr ClipSpace clip = gallery::drawn_clip;

struct Input {
    backend::Scene const& scene;
    ViewVolume<double> eye, seen;  // the whole camera, and up to the shadow distance
    Light<double> light;
    Aabb<double> casters, receivers;
    std::vector<Aabb<double>> caster_boxes, receiver_boxes;
    backend::Extent picture;
    Coarse const& coarse;
    glm::dvec3 forward;
};

struct FittedMap {
    ShadowMap<double> map;
    double end = 0.0;  // eye depth, where maps are chosen by it
};

struct Fitted {
    std::vector<FittedMap> maps;
    std::string note;
};

Camera camera_of(Input const& in) {
    Pose<double> const& pose = in.seen.pose;
    return {pose.position, pose.right,  pose.up,        pose.forward,
            in.seen.right, in.seen.top, in.seen.z_near, in.seen.z_far};
}

Fitted folk(Input const& in, RecipeMaps (*recipe)(Camera const&, glm::dvec3, Box const&, int)) {
    Fitted fitted;
    Aabb<double> const all = merge(in.casters, in.receivers);
    for (RecipeMap const& made : recipe(camera_of(in), in.light.direction, {all.lo, all.hi}, map_size)) {
        ShadowMap<double> map;
        map.clip_from_world = made.clip_from_world;
        map.clip = clip;
        map.w_min = made.w_min;
        map.visible = made.visible;
        fitted.maps.push_back({map, made.end});
    }
    return fitted;
}

CascadeOptions<double> cascade_options(CascadeFit fit) {
    CascadeOptions<double> options;
    options.fit = fit;
    options.count = map_count;
    options.map_size = map_size;
    options.filter_radius = gallery::filter_radius;
    options.blend = 0.0;
    options.clip = clip;
    return options;
}

Fitted with(Cascades<double> const& cascades) {
    Fitted fitted;
    for (Cascade<double> const& cascade : cascades) fitted.maps.push_back({cascade.map, cascade.range.end});
    return fitted;
}

Fitted cascades(Input const& in, CascadeFit fit) {
    return with(fit_cascades(in.seen, in.light, in.casters, in.receivers, cascade_options(fit)));
}

// The best options for what is seen at `samples`.
Fitted chosen_options(Input const& in, SurfacePoint<double> const* samples, int count) {
    ChoiceLimits<double> limits;
    limits.eye_pixels = {in.picture.width, in.picture.height};
    limits.texels = std::int64_t(map_count) * map_size * map_size;
    limits.most_maps = map_count;
    limits.largest_map = map_size;
    limits.motion = Motion::any;
    limits.goal = Goal::fewest_wrong;
    CascadeOptions<double> const given = cascade_options(CascadeFit::tight);
    Choice<double> const choice = choose(in.seen, in.light, in.casters, in.receivers, samples, count, given, limits);
    CascadeOptions<double> options = choice.options;
    options.map_size = map_size;
    return with(fit_cascades(in.seen, in.light, in.casters, in.receivers, options));
}

Fitted options_from_boxes(Input const& in) {
    Samples<double> const samples =
        samples_in_boxes(in.seen, in.light, in.receiver_boxes.data(), int(in.receiver_boxes.size()));
    return chosen_options(in, samples.at.data(), samples.count);
}

// One in so many, `max_samples` at most; those that the light reaches.
std::vector<SurfacePoint<double>> few_samples(Input const& in) {
    std::vector<SurfacePoint<double>> facing;
    for (SurfacePoint<double> const& sample : in.coarse.points)
        if (glm::dot(sample.normal, in.light.direction) < 0.0) facing.push_back(sample);
    std::size_t const stride = std::max<std::size_t>(1, (facing.size() + max_samples - 1) / max_samples);
    std::vector<SurfacePoint<double>> samples;
    for (std::size_t i = 0; i < facing.size(); i += stride) samples.push_back(facing[i]);
    return samples;
}

Fitted options_from_depth(Input const& in) {
    auto const samples = few_samples(in);
    return chosen_options(in, samples.data(), int(samples.size()));
}

Fitted sampled(Input const& in, SampleSplits kind) {
    DepthTiles<double> const tiles = in.coarse.depths.tiles();
    int const count = tiles.width * tiles.height;
    SampleDepths<double> depths = no_depths(in.seen.z_near, in.seen.z_far);
    for (int i = 0; i < count; ++i)
        if (tiles.nearest[i] <= tiles.farthest[i])
            for (double const depth : {tiles.nearest[i], tiles.farthest[i]}) add(depths, depth);
    SampleBounds<double> bounds = no_bounds(sample_splits(depths, map_count, kind, 1.25), 0.0);
    SampleRays<double> const rays = sample_rays(in.eye, in.light, tiles.width, tiles.height);
    for (int i = 0; i < count; ++i)
        add_tile(bounds, rays, i % tiles.width, i / tiles.width, tiles.nearest[i], tiles.farthest[i]);
    SampleFitOptions<double> options;
    options.map_size = map_size;
    options.margin_texels = margin_texels;
    options.clip = clip;
    return with(fit_samples(rays, bounds, in.casters, options));
}

// The thesis' map on the plane of least distortion, and three cascades behind it.
Fitted plane_first(Input const& in) {
    std::vector<SurfacePoint<double>> samples;
    std::size_t const stride = std::max<std::size_t>(1, in.coarse.points.size() / max_samples);
    for (std::size_t i = 0; i < in.coarse.points.size(); i += stride) samples.push_back(in.coarse.points[i]);
    PlaneChoice<double> const plane =
        choose_plane(in.seen, in.light, samples.data(), int(samples.size()), glm::dvec3(0.0, 1.0, 0.0));
    VdsmOptions<double> options;
    options.map_size = map_size;
    options.margin_texels = margin_texels;
    Fitted fitted;
    fitted.maps.push_back(
        {view_dependent_map(in.seen, in.light, plane.plane, in.casters, in.receivers, options, clip), in.seen.z_far});
    CascadeOptions<double> behind = cascade_options(CascadeFit::focus);
    behind.count = map_count - 1;
    for (FittedMap const& map : with(fit_cascades(in.seen, in.light, in.casters, in.receivers, behind)).maps)
        fitted.maps.push_back(map);
    return fitted;
}

MapLimits<double> limits_of(Input const& in) {
    MapLimits<double> limits;
    limits.eye_pixels = {in.picture.width, in.picture.height};
    limits.maps = map_count;
    limits.map_size = map_size;
    limits.margin_texels = margin_texels;
    limits.clip = clip;
    return limits;
}

// The choice in words.
Fitted with(Input const& in, ChosenMaps<double> const& chosen) {
    Fitted fitted;
    for (ChosenMap<double> const& map : chosen) {
        fitted.maps.push_back({map.map, in.seen.z_far});
        ViewPart<double> const& part = map.part;
        double const across = std::min(part.hi.x, in.seen.right) - std::max(part.lo.x, in.seen.left);
        double const up = std::min(part.hi.y, in.seen.top) - std::max(part.lo.y, in.seen.bottom);
        char text[256];
        std::snprintf(text, sizeof text, "%s%.3g to %.3g m, %.0f x %.0f %% of the picture: %s (growth %.2f), %.2f px",
                      fitted.note.empty() ? "" : "; ", std::max(part.lo.z, in.seen.z_near),
                      std::min(part.hi.z, in.seen.z_far), 100.0 * across / (in.seen.right - in.seen.left),
                      100.0 * up / (in.seen.top - in.seen.bottom), describe(map.shape), map.growth, map.mean);
        fitted.note += text;
    }
    return fitted;
}

Fitted chosen_from_depth(Input const& in) {
    static MapSearch<double> work;
    MapLimits<double> const limits = limits_of(in);
    ChosenMaps<double> const chosen = choose_maps(in.seen, in.light, in.casters, in.coarse.points.data(),
                                                  int(in.coarse.points.size()), in.coarse.depths.tiles(), limits, work);
    return with(in, chosen);
}

Fitted chosen_from_boxes(Input const& in) {
    static MapSearch<double> work;
    return with(in, choose_maps(in.seen, in.light, in.casters, in.receiver_boxes.data(), int(in.receiver_boxes.size()),
                                limits_of(in), work));
}

struct Entry {
    Policy policy;
    std::function<Fitted(Input const&)> make;
};

std::vector<Entry> const& entries() {
    auto const recipe = [](auto* make) { return [make](Input const& in) { return folk(in, make); }; };
    auto const fit = [](CascadeFit kind) { return [kind](Input const& in) { return cascades(in, kind); }; };
    static std::vector<Entry> const all = {
        {{"folk-box", "textbook box", Family::folk, true}, recipe(textbook_box)},
        {{"folk-sphere", "centroid sphere, snapped", Family::folk, true}, recipe(centroid_sphere)},
        {{"folk-focus", "focus: slice and union of boxes", Family::folk, true}, recipe(focus)},
        {{"folk-lispsm", "LiSPSM with the published n", Family::folk, true}, recipe(lispsm)},
        {{"stable", "stable", Family::library}, fit(CascadeFit::stable)},
        {{"tight", "tight", Family::library}, fit(CascadeFit::tight)},
        {{"rectangle", "rectangle", Family::library}, fit(CascadeFit::rectangle)},
        {{"focus", "focus", Family::library}, fit(CascadeFit::focus)},
        {{"warped", "warped", Family::library}, fit(CascadeFit::warped)},
        {{"plane", "plane (VDSM), focus behind it", Family::library, false, true}, plane_first},
        {{"sdsm", "samples, splits around gaps", Family::library, false, true},
         [](Input const& in) { return sampled(in, SampleSplits::adaptive); }},
        {{"options", "options chosen from boxes", Family::library}, options_from_boxes},
        {{"options-depth", "options chosen from a depth buffer", Family::library, false, true}, options_from_depth},
        {{"chosen-boxes", "maps chosen from boxes alone", Family::chosen}, chosen_from_boxes},
        {{"chosen-depth", "maps chosen from a depth buffer", Family::chosen, false, true}, chosen_from_depth},
    };
    return all;
}

void add(gallery::MapSet& set, Input const& in, FittedMap const& fitted) {
    ShadowMap<double> const& map = fitted.map;
    bool const holds_place = set.frame.choice == backend::MapChoice::by_depth;
    if (!map.visible && !holds_place) return;
    BiasOptions<double> options;
    options.filter_radius = gallery::filter_radius;
    SliceRange<double> const range{in.seen.z_near, fitted.end, fitted.end};
    set.frame.maps[set.maps.size()] = gallery::constants_of(map, range, bias_for(map, in.light, map_size, options));
    set.maps.push_back({map.clip_from_world, gallery::casters_in(map, in.scene)});
    set.frame.map_count = int(set.maps.size());
}

}  // namespace

std::vector<Policy> const& policies() {
    static std::vector<Policy> const all = [] {
        std::vector<Policy> list;
        for (Entry const& entry : entries()) list.push_back(entry.policy);
        return list;
    }();
    return all;
}

Coarse coarse_of(backend::Frame const& frame, View const& view) {
    backend::Extent const extent = frame.position.extent;
    Coarse coarse(extent);
    for (int y = 0; y < extent.height; ++y)
        for (int x = 0; x < extent.width; ++x) {
            backend::Texel4 const &p = frame.position.at(x, y), &n = frame.normal.at(x, y);
            if (p.w < -1.5f) continue;
            glm::dvec3 const point(p.x, p.y, p.z), normal(n.x, n.y, n.z);
            double const depth = glm::dot(view.forward, point - view.eye);
            if (depth > view.shadow_distance) continue;
            if (glm::dot(normal, view.light_travel) < 0.0) coarse.depths.add(x, y, depth);
            if (coarse.depths.is_middle(x, y)) coarse.points.push_back({point, normal});
        }
    return coarse;
}

Made make_maps(Policy const& policy, backend::Scene const& scene, View const& view, backend::Extent picture,
               Coarse const& coarse) {
    Made made;
    made.maps.map_size = map_size;
    made.maps.frame = gallery::unshadowed(view, picture);
    made.maps.frame.map_size = float(map_size);
    made.maps.frame.choice = policy.by_depth ? backend::MapChoice::by_depth : backend::MapChoice::by_map;
    Input in{
        scene,  eye_of(view, picture), eye_of(view, picture), directional(view.light_travel), {}, {}, {}, {}, picture,
        coarse, view.forward};
    in.seen.z_far = view.shadow_distance;
    for (auto const& object : scene.objects) {
        if (object.casts) in.caster_boxes.push_back(box_of(object));
        if (object.receives) in.receiver_boxes.push_back(box_of(object));
    }
    for (auto const& box : in.caster_boxes) in.casters = merge(in.casters, box);
    for (auto const& box : in.receiver_boxes) in.receivers = merge(in.receivers, box);
    for (Entry const& entry : entries()) {
        if (entry.policy.id != policy.id) continue;
        auto const begin = std::chrono::steady_clock::now();
        Fitted const fitted = entry.make(in);
        made.milliseconds = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
        for (FittedMap const& map : fitted.maps) add(made.maps, in, map);
        made.maps.note = fitted.note;
        return made;
    }
    throw std::runtime_error("no policy is called " + policy.id);
}

}  // namespace shadowmath::quality
