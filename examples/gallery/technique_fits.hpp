// SPDX-License-Identifier: MIT
//
// How each technique of the gallery makes its maps: view, light and boxes in, maps taken into the set. techniques.cpp
// lists them by name.
#pragma once

#include "examples/gallery/techniques.hpp"

#include <shadowmath/shadowmath.hpp>

namespace shadowmath::gallery {

// Maths in double, rounded to float once, when the matrices go to the shader.
using View3 = ViewVolume<double>;

// What every backend draws with.
inline constexpr ClipSpace drawn_clip = gl_zero_to_one_clip;

inline constexpr double margin_texels = filter_radius + 1.0;

// What a technique is given, made once.
struct Input {
    backend::Scene const& scene;
    View3 eye;   // the whole camera
    View3 seen;  // up to the shadow distance
    Light<double> light;
    Aabb<double> casters, receivers;
    int map_size;
    scenes::View const& view;
    backend::Extent extent;
    backend::Image<float> const& eye_depth;  // as eye_depth_pass draws it; empty unless the technique asks
};

[[nodiscard]] View3 eye_of(scenes::View const& view, backend::Extent extent);
[[nodiscard]] Light<double> light_of(scenes::View const& view);
[[nodiscard]] Aabb<double> box_of(backend::Object const& object);
[[nodiscard]] Aabb<double> box_of_all(backend::Scene const& scene, bool backend::Object::*role);

// Objects whose boxes meet what this sees are what shows: it looks as the eye does.
[[nodiscard]] CasterMaps<double> screen_of(View3 const& view);

// The objects to draw into a map.
[[nodiscard]] std::vector<std::uint32_t> casters_in(ShadowMap<double> const& map, backend::Scene const& scene);

// What the receiver shader knows of a map.
template <class T>
[[nodiscard]] backend::MapConstants constants_of(ShadowMap<T> const& map, SliceRange<T> const& range,
                                                 MapBias<T> const& bias) {
    backend::MapConstants constants;
    constants.clip_from_world = glm::mat4(map.clip_from_world);
    constants.depth_end = float(range.end);
    constants.blend_begin = float(range.blend_begin);
    constants.w_min = float(map.w_min);
    constants.bias_constant = float(bias.constant);
    constants.bias_slope_texels = float(bias.slope_texels);
    constants.slope_limit = float(bias.slope_limit);
    constants.bias_w = float(bias.per_inverse_w);
    return constants;
}

// Says in words what the library had to say.
void note(MapSet& set, Faults faults);

// Takes a map into the set, with the constants that its receivers need. Maps that serve nothing are left out.
void add(MapSet& set, Input const& in, ShadowMap<double> const& map, SliceRange<double> const& range);

[[nodiscard]] SliceRange<double> whole(Input const& in);

void add(MapSet& set, Input const& in, Cascades<double> const& fitted);
void cascades(MapSet& set, Input const& in, double lambda, CascadeFit fit, backend::MapChoice choice);

// One map for all that is seen.
[[nodiscard]] ShadowMap<double> standard_map(Input const& in);
[[nodiscard]] ShadowMap<double> warped_map(Input const& in, WarpOptions<double> const& rule);
// Lloyd's choice of the strength by the angle of the light.
[[nodiscard]] ShadowMap<double> lloyd_map(Input const& in);
// As the weblog describes it: a plain light map with the camera in its middle and the view along y, then the printed
// warp. Its w, h, zn and zf are found by trial there; these fill the width and cut nothing in depth.
[[nodiscard]] ShadowMap<double> printed_map(Input const& in);
// On the ground at the median foot of the objects in view, as the thesis has it.
[[nodiscard]] ShadowMap<double> thesis_map(Input const& in);
// On the plane of least distortion for points spread over the boxes in view.
[[nodiscard]] ShadowMap<double> chosen_plane_map(Input const& in);

// Maps put where the picture needs them: by what may be seen of the receivers' boxes, and by what is seen, of which the
// eye's depth tells the places and nothing of how the surfaces lean.
void maps_for_boxes(MapSet& set, Input const& in);
void maps_for_depths(MapSet& set, Input const& in);

// The eye as its depth is drawn for fits: in float, as the device has it, reversed and without an end.
[[nodiscard]] ViewVolume<float> sampling_eye(scenes::View const& view, backend::Extent extent);
inline constexpr ClipSpace sampling_clip = reversed(drawn_clip);

// Cascades fitted to the eye's depth, in float throughout, so that the device's own fit can be held against it bit for
// bit. Every split keeps its place, seen or not.
void sampled_maps(MapSet& set, Input const& in, SampleSplits kind, bool on_device, bool still);

}  // namespace shadowmath::gallery
