// SPDX-License-Identifier: MIT
//
// Every public function template of shadowmath, instantiated: a template that nobody calls is checked for little more
// than its brackets. Header by header in alphabetical order; where a name is overloaded, or takes a callable, it is
// called. A test reads the headers and fails when one of their functions is missing here.
#pragma once

#include "every_header.hpp"

namespace shadowmath::compile {

// Taking the address of a template's specialization instantiates its body.
template <class... Functions>
constexpr int keep(Functions...) noexcept {
    return static_cast<int>(sizeof...(Functions));
}

// The irregular z-buffer, on lanes of every kind that this machine has.
template <class T, class Lanes>
int every_irregular_function_on() noexcept {
    Storage<T> const storage;
    PixelFrame<T> const frame = pixel_frame(ViewVolume<T>{}, 4, 4, YAxis::down);
    Receivers<T> receivers;
    T const numbers[16] = {};
    std::uint32_t words[32] = {};
    receivers.depth = receivers.normal = numbers;
    IrregularBuffer<T> buffer = list_receivers<T, Lanes>(frame, receivers, Light<T>{}, ShadowMap<T>{}, 16, storage);
    trace<T, Lanes>(buffer, Casters<T>{});
    Lanes const lanes =
        least(most(Lanes::load(numbers), Lanes::all(T(0))), reciprocal(Lanes::all(T(1))) / Lanes::all(T(2)));
    int count =
        smallest(chosen(1u, absolute(lanes), with_sign_of(lanes, lanes))) < largest(fused(lanes, lanes, lanes - lanes));
    count += Lanes::compress(at_least(lanes, lanes), words, words + 16) > 16;
    count += half_plane_mask<Lanes>(PixelLine<T>{}) == half_plane_mask(half_plane_table(), PixelLine<T>{});
    PixelLine<T> const lines[4]{};
    count += half_planes_mask<Lanes>(lines) == every_sample;
    return count;
}

template <class T>
int every_irregular_function() noexcept {
    int count = every_irregular_function_on<T, PlainLanes<T>>() + every_irregular_function_on<T, BestLanes<T>>();
    count +=
        frame_in<Wider<T>>(PixelFrame<T>{}).width + static_cast<int>(storage_for(4, 4, 16).words) + level_size(16, 1);
    count += radical_inverse<T>(2, 1) > T(0);
    count += keep(&direction_in_pixels<T>, &point_in_pixels<T>, &pixel_plane<T>, &micro_quad<T>, &point_on<T>,
                  &pixel_light<T>, &shadow_volume<T>, &line_across<T>, &write_masks<T>);
    return count;
}

template <class T>
int every_overloaded_function() noexcept {
    Vec3<T> const point(T(0));
    Mat4<T> const identity(T(1));
    Aabb<T> const box{point, point + T(1)};
    ViewVolume<T> const view;
    ShadowMap<T> const map;
    int count = 0;
    count += all_finite(&point.x, 3) && all_finite(Vec2<T>(point)) && all_finite(point) && all_finite(identity) &&
             all_finite(box);
    count += is_empty(merge(merge(box, point), intersect(box, box))) || is_empty(intersect(Region<T>{}, Region<T>{}));
    count += is_empty(projected_bounds(identity, corners(box), T(0)));
    count += is_empty(projected_bounds(identity, BoxArrays<T>{}, 0, T(0)));
    count += contains(box, point) || contains(map, 16, T(1), point);
    count += corners(box)[0] == corners(view)[0];
    count += (faults_of(view) | faults_of(Light<T>{}) | faults_of(Tile{})).any();
    count += describe(Fault::not_finite) != describe(Faults{});
    CasterMaps<T> const casters = caster_maps(Cascades<T>{});
    count += caster_mask(casters, box) + caster_mask(caster_maps(&map, 1), Sphere<T>{});
    count += clip_from_world(LightBox<T>{}, reversed(gl_clip)) == clip_from_world(view, vulkan_clip);
    count += clip_from_world(TexelGrid<T>{}, T(0), T(1), d3d_clip) == identity;
    count += area(LightBox<T>{}) > area(Footprint<T>{});
    HalfSpaces<T> const swept = swept_to_light(convex_body(box), Vec4<T>(T(0), T(-1), T(0), T(0)));
    count += may_meet(swept, box) && clipped(clipped(convex_body(box), swept), Vec4<T>(T(1))).edge_count > 0;
    for_each_vertex(convex_body(corners(box)), [&count](Vec3<T> const& vertex) { count += vertex.x > T(0); });
    Quad<T> const quad = quad_between(QuadSides<T>{}, T(8), T(3));
    Supports<T> supports = no_supports(SampleFrame<T>{});
    add(supports, Vec2<T>(T(0)));
    add(supports, LightSample<T>{});
    count += is_in(quad, Vec2<T>(T(0))) && is_in(ViewPart<T>{}, point) && area(moved(quad, Vec2<T>(T(1)))) > T(0);
    MapSearch<T> search;
    SurfacePoint<T> const surface;
    Light<T> const sun;
    count += choose_maps(view, sun, box, &surface, 1, DepthTiles<T>{}, MapLimits<T>{}, search).count;
    count += choose_maps(view, sun, box, &box, 1, MapLimits<T>{}, search).count;
    count += describe(MapShape::warp) != nullptr;
    SampleDepths<T> depths = no_depths(T(1), T(10));
    add(depths, T(2));
    add(depths, depths);
    SampleBounds<T> bounds = no_bounds(sample_splits(depths, 4, SampleSplits::adaptive));
    add(bounds, SampleRays<T>{}, 0, 0, T(2));
    add_tile(bounds, SampleRays<T>{}, 0, 0, T(2), T(3));
    add(bounds, bounds);
    auto const stored_depth = [](int, int) { return T(1); };
    count += filtered(Receiver<T>{}, 16, gl_clip, FilterOptions{}, stored_depth) > T(0);
    count += visibility(map, 16, point, Vec3<T>(T(0), T(1), T(0)), MapBias<T>{}, FilterOptions{}, stored_depth) > T(0);
    count += soft_filtered(Receiver<T>{}, T(1), MapPenumbra<T>{}, 16, gl_clip, PcssOptions<T>{}, stored_depth).blocked;
    count += soft_visibility(map, 16, point, Vec3<T>(T(0), T(1), T(0)), MapBias<T>{}, MapPenumbra<T>{},
                             PcssOptions<T>{}, stored_depth)
                 .blocked;
    auto const stored_moments = [](int, int) { return Vec2<T>(T(1)); };
    count += mean_moments(Vec2<T>(T(1)), 16, 1, Vec2<T>(T(1)), stored_moments).x > T(0);
    count += every_irregular_function<T>() > 0;
    GpuIrregular passes;
    count += gpu_irregular(PixelFrame<float>{}, Light<float>{}, ShadowMap<float>{}, 16, passes).any();
    return count;
}

template <class T>
int every_function() noexcept {
    int count = every_overloaded_function<T>();
    count +=
        keep(&closed_form::is_range<T>, &closed_form::is_positive<T>, &closed_form::pixels_per_texel<T>,
             &closed_form::uniform_along<T>, &closed_form::uniform_across<T>, &closed_form::logarithmic_along<T>,
             &closed_form::warped_along<T>, &closed_form::warped_across<T>, &closed_form::warped_worst<T>,
             &closed_form::best_centre<T>, &closed_form::split_uniform_worst<T>, &closed_form::split_warped_worst<T>,
             &closed_form::split_logarithmic_worst<T>, &closed_form::plane_map_area<T>);
    count += keep(&slope<T>, &lean<T>, &depth_gain<T>, &depth_shift<T>, &depth_bias<T>, &kernel_reach_texels<T>,
                  &normal_offset_metres<T>, &normal_offset_at<T>, &bias_for<T>, &bias_at<T>);
    count += keep(&by_footprint<T>, &with_map<T>, &look_up_in<T>, &choose_planes<T>);
    count += keep(&bounds_of<T>);
    count += keep(&least_squares_plane<T>, &median_plane<T>, &weighted_median_plane<T>, &plane_distortion<T>,
                  &choose_plane<T>, &worth_of<T>, &still_good<T>);
    count += keep(&light_sampler<T>, &light_sample<T>, &depths_in_box<T>, &guesses_on_ray<T>, &guesses_in_boxes<T>,
                  &gain_at<T>, &quad_map<T>, &price_of<T>, &major_at<T>, &quad_at<T>, &frame_of<T>, &fit_quad<T>);
    count += keep(&choose<T>, &neutral_normal<T>, &samples_in<T>, &samples_in_boxes<T>, &judge<T>) +
             map_size_within(64, 1, 8);
    count += keep(&fit_cascades<T>);
    count += keep(&clipmap<T>, &pixel_metres<T>, &page_at<T>, &holds<T>, &page_for<T>);
    count += keep(&far_depth<T>, &clip_from_canonical<T>, &canonical_from_clip<T>, &texture_from_clip<T>, &is_lit<T>);
    count += keep(&row<T>, &from_rows<T>, &nowhere<T>);
    count += keep(&add_map<T>, &caster_masks<T>);
    count += map_range(0).first;
    count += keep(&depths_inside<T>, &depth_range<T>, &in_steps<T>);
    count += keep(&covered_texels<T>, &tap_weight<T>);
    count += keep(&is_positive_infinity<T>, &safe_normalize<T>);
    count += keep(&box_around<T>, &fit_box<T>);
    count += keep(&focus_of<T>, &fit_focus<T>, &rolled<T>, &fit_rectangle<T>);
    count += keep(&scene_independent_box<T>, &scene_dependent_box<T>, &crop_matrix<T>, &spot_view<T>,
                  &spot_clip_from_world<T>, &fit_spot<T>);
    count += keep(&face_light<T>, &face_toward<T>, &fit_cube<T>);
    count += keep(&bounding_sphere<T>);
    count += keep(&gpu_shadow_map<T>, &gpu_map<T>, &gpu_penumbra<T>, &gpu_cascades<T>);
    count += keep(&texels_per_pixel<T>, &footprint<T>);
    count += keep(&softness<T>, &hybrid_visibility<T>);
    count += keep(&directional<T>, &spot<T>, &unusable<T>, &homogeneous<T>, &toward<T>, &faces_away<T>, &light_basis<T>,
                  &in_light<T>);
    count += keep(&texel_metres<T>, &rebased<T>);
    count += keep(&door<T>, &map_from_rows<T>);
    count += keep(&map_ray<T>, &light_error_radians<T>);
    count += keep(&faults_of_margin<T>, &usable_texels<T>);
    count += keep(&less_bleeding<T>);
    count += keep(&msm_moments<T>, &msm_packed<T>, &msm_unpacked<T>, &msm_visibility<T>);
    count += keep(&next_direction<T>);
    count += keep(&sun_radius<T>, &penumbra_metres<T>, &gap_of_metres<T>, &metres_of_gap<T>, &place_from_world<T>,
                  &penumbra_for<T>, &across<T>, &gap_at<T>, &kernel_texels<T>);
    count += keep(&translated<T>, &visible_body<T>);
    count += keep(&region_of<T>, &widened<T>, &with_margin<T>, &region_matrix<T>, &tile_matrix<T>);
    count += keep(&by_depth<T>, &by_map<T>, &blended<T>, &shade<T>);
    count +=
        keep(&sample_rays<T>, &from_eye<T>, &is_served<T>, &eighth_of_octave_up<T>, &light_entry<T>, &fit_samples<T>);
    count += keep(&depth_code<T>, &decoded_depth<T>, &gpu_sample_fit<float>);
    count += keep(&texture_from_world<T>);
    count += keep(&bound_slices<T>, &fit_slice_focus<T>, &fit_slice_boxes_of<T>);
    count += keep(&fit_slice_warps<T>);
    count += keep(&fit_slice_boxes<T>, &fit_slice_spheres<T>, &clip_points<T>, &box_at<T>, &boxes_from<T>);
    count += keep(&slice_range<T>, &slice<T>);
    count += keep(&texel_shift<T>, &shimmer_texels<T>);
    count += keep(&practical_splits<T>, &uniform_splits<T>, &logarithmic_splits<T>, &pinned_splits<T>,
                  &explicit_splits<T>, &lambda_for_first_split<T>);
    count += keep(&transformed<T>, &projected<T>, &gain_along<T>, &tangents<T>, &bounded_quotient<T>);
    count += keep(&texel_grid<T>, &on_grid<T>, &grid_window<T>, &texel_for<T>, &held_size<T>);
    count += keep(&scroll_between<T>, &unchanged<T>) + frames_between(1, 4) + (maps_due(3, 4) != 0);
    count += wrapped(std::int64_t(-1), 8) + wrapped(TexelGrid<T>{}, TexelRect{}).count;
    count += keep(&plane_through<T>, &mean_height_plane<T>, &plane_projection<T>, &view_dependent_map<T>,
                  &receiver_valid<T>);
    count += keep(&pose_looking<T>, &perspective_view<T>, &orthographic_view<T>, &view_from_projection<T>,
                  &orthonormalized<T>, &point_at<T>, &eye_depth<T>);
    count +=
        keep(&vsm_moments<T>, &vsm_visibility<T>, &evsm_warp<T>, &evsm_moments<T>, &evsm_bound<T>, &evsm_visibility<T>);
    count += keep(&lloyd_inverse_centre<T>, &lloyd_eta<T>, &trapezoid_inverse_centre<T>, &extended_inverse_centre<T>);
    count += keep(&printed_simple_warp<T>, &corrected_simple_warp<T>, &optimal_inverse_centre<T>, &perspective_warp<T>,
                  &warp_axes<T>, &simple_perspective_map<T>);
    return count;
}

}  // namespace shadowmath::compile
