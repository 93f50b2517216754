// SPDX-License-Identifier: MIT
#include "examples/gallery/techniques.hpp"

#include "examples/gallery/technique_fits.hpp"

#include <cmath>
#include <functional>

namespace shadowmath::gallery {
namespace {

using backend::FrameConstants;
using backend::MapChoice;
using backend::Scene;
using scenes::View;

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
    auto const warped = [](WarpOptions<double> const& rule) {
        return [=](MapSet& set, Input const& in) { add(set, in, warped_map(in, rule), whole(in)); };
    };
    WarpOptions<double> optimal, stamminger, trapezoid, extended;
    stamminger.strength = 2.0;
    trapezoid.rule = WarpRule::trapezoid;
    extended.rule = WarpRule::extended;
    auto const before_uniform = [](ShadowMap<double> (*make)(Input const&)) {
        return [=](MapSet& set, Input const& in) {
            add(set, in, make(in), whole(in));
            add(set, in, standard_map(in), whole(in));
        };
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
        {{"cascades-4-rectangle", "Four cascades, smallest rectangles", "Freeman, Shapira 1975", 1024, 4, false},
         false,
         four(0.65, CascadeFit::rectangle)},
        {{"cascades-4-focus", "Four cascades, focused on possible shadow", "after Wimmer 2004", 1024, 4, false},
         false,
         four(0.65, CascadeFit::focus)},
        {{"cascades-4-warped", "Four cascades, each warped", "after Lloyd et al. 2006", 1024, 4, false},
         false,
         four(0.65, CascadeFit::warped)},
        {{"sdsm-even", "Four maps fitted to what is seen, even splits", sdsm, 1024, 4, false, true},
         false,
         sampled(SampleSplits::even, false)},
        {{"sdsm", "Four maps fitted to what is seen, splits around gaps", sdsm, 1024, 4, false, true},
         false,
         sampled(SampleSplits::adaptive, false)},
        {{"sdsm-gpu", "Four maps fitted to what is seen, on the GPU", sdsm, 1024, 4, false, true},
         true,
         sampled(SampleSplits::adaptive, true)},
        {{"sdsm-still", "The same, still", sdsm, 1024, 4, false, true},
         false,
         sampled(SampleSplits::adaptive, false, true),
         false},
        {{"chosen-boxes", "Four maps where the boxes need them", "choose_maps.hpp", 1024, 4, false},
         false,
         maps_for_boxes},
        {{"chosen-depth", "Four maps where the picture needs them", "choose_maps.hpp", 1024, 4, false, true},
         false,
         maps_for_depths},
        {{"simple-perspective", "Simple perspective map, corrected", "weblog 2012", 1024, 1, false},
         true,
         warped(optimal)},
        {{"simple-printed", "Simple perspective map, as printed", "weblog 2012", 1024, 1, false},
         false,
         single(printed_map)},
        {{"warp-lloyd", "One warp, its strength by the angle", "Lloyd et al. 2006", 1024, 1, false},
         false,
         single(lloyd_map)},
        {{"warp-trapezoid", "One warp, trapezoidal", "Martin, Tan 2004", 1024, 1, false}, false, warped(trapezoid)},
        {{"warp-extended", "One warp, extended perspective", "Gusev 2007", 1024, 1, false}, false, warped(extended)},
        {{"warp-perspective", "One warp, in the eye's own perspective", "Stamminger, Drettakis 2002", 1024, 1, false},
         false,
         warped(stamminger)},
        {{"vdsm", "View-dependent map, lit elsewhere", "Kwon 2002", 1024, 1, true}, false, single(thesis_map)},
        {{"vdsm-fallback", "View-dependent map, uniform map behind it", "Kwon 2002", 1024, 2, true},
         true,
         before_uniform(thesis_map)},
        {{"vdsm-chosen", "View-dependent map, chosen plane, uniform behind", "after Kwon 2002", 1024, 2, false, true},
         false,
         before_uniform(chosen_plane_map)},
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
    frame.clip_from_world = glm::mat4(clip_from_world(eye, drawn_clip));
    frame.eye_position = glm::vec4(glm::vec3(eye.pose.position), 1.0f);
    frame.eye_forward = glm::vec4(glm::vec3(eye.pose.forward), 0.0f);
    frame.light =
        view.has_spot ? glm::vec4(glm::vec3(light.position), 1.0f) : glm::vec4(glm::vec3(-light.direction), 0.0f);
    if (view.has_spot)
        frame.spot_axis = glm::vec4(glm::vec3(light.direction), float(std::cos(light.half_angle_radians)));
    frame.filter_radius = filter_radius;
    return frame;
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
    options.clip = drawn_clip;
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
    given.clip = drawn_clip;
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
