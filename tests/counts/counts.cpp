// SPDX-License-Identifier: MIT
//
// What tests/counts/check.sh counts the instructions of: one function a row, each called once with everything warm.
// Built with -O2 whatever the rest is built with.
#include "bench/cases.hpp"

#include <shadowmath/shadowmath.hpp>

#include <cstdio>
#include <vector>

using namespace shadowmath;

namespace {

ViewVolume<float> view;
LightBasis<float> basis;
Aabb<float> const scene{glm::vec3(-60, 0, -80), glm::vec3(70, 25, 60)};
Mat4<float> maps[4 * 320];
ShadowMap<float> warped[4];
std::vector<ViewVolume<float>> views;
bench::Boxes boxes;
std::vector<MapMask> masks(640);
CasterMaps<float> casters;
Mat4<float> perspective, affine;
std::vector<glm::vec3> points(640);
std::vector<glm::vec4> clip(640);

// What a call leaves behind is used.
template <class Result>
void keep(Result const& result) {
    asm volatile("" : : "m"(result) : "memory");
}

}  // namespace

#define SHADOWMATH_COUNTED(name) extern "C" [[gnu::noinline]] void name()

SHADOWMATH_COUNTED(count_practical_splits) {
    keep(practical_splits(view.z_near, view.z_far, 4));
}
SHADOWMATH_COUNTED(count_slice_boxes) {
    Splits<float> const splits = practical_splits(view.z_near, view.z_far, 4);
    keep(fit_slice_boxes(view, light_basis(bench::sun), splits, 2.0f / 2048, gl_zero_to_one_clip, maps));
}
SHADOWMATH_COUNTED(count_slice_spheres) {
    Splits<float> const splits = practical_splits(view.z_near, view.z_far, 4);
    keep(fit_slice_spheres(view, light_basis(bench::sun), splits, 2048, 2.0f, gl_zero_to_one_clip, maps));
}
SHADOWMATH_COUNTED(count_slice_focus) {
    Splits<float> const splits = practical_splits(view.z_near, view.z_far, 4);
    keep(fit_slice_focus(view, light_basis(bench::sun), splits, scene, 2.0f / 2048, gl_zero_to_one_clip, maps));
}
SHADOWMATH_COUNTED(count_slice_warps) {
    Splits<float> const splits = practical_splits(view.z_near, view.z_far, 4);
    keep(fit_slice_warps(view, directional(bench::sun), splits, 0.1f, scene, scene, WarpOptions<float>{}, gl_clip,
                         warped));
}
SHADOWMATH_COUNTED(count_boxes_of_320_views) {
    keep(fit_slice_boxes_of(views.data(), 320, basis, 4, 0.5f, 0.0f, gl_zero_to_one_clip, maps));
}
SHADOWMATH_COUNTED(count_masks_of_640_boxes) {
    caster_masks(casters, boxes.arrays(), 640, masks.data());
}
SHADOWMATH_COUNTED(count_perspective_region_of_640_boxes) {
    keep(projected_bounds(perspective, boxes.arrays(), 640, 0.1f));
}
SHADOWMATH_COUNTED(count_affine_region_of_640_boxes) {
    keep(projected_bounds(affine, boxes.arrays(), 640, 0.1f));
}
SHADOWMATH_COUNTED(count_640_points) {
    clip_points(perspective, points.data(), 640, clip.data());
}

int main() {
    bench::Random random;
    textbook::Camera const camera = bench::some_camera(random);
    view = bench::view_of(camera);
    basis = light_basis(bench::sun);
    for (int i = 0; i < 320; ++i) views.push_back(bench::view_of(bench::some_camera(random)));
    boxes = bench::town(640);
    textbook::Maps const cascades = textbook::stable_cascades(camera, bench::sun, 0.5f, 2048.0f);
    for (glm::mat4 const& matrix : cascades)
        add_map(casters, ShadowMap<float>{matrix, gl_zero_to_one_clip, 0, true, {}});
    perspective = clip_from_world(view, gl_zero_to_one_clip);
    affine = cascades[3];
    for (glm::vec3& point : points)
        point = {random.between(-100, 100), random.between(0, 20), random.between(-100, 100)};

    count_practical_splits();
    count_slice_boxes();
    count_slice_spheres();
    count_slice_focus();
    count_slice_warps();
    count_boxes_of_320_views();
    count_masks_of_640_boxes();
    count_perspective_region_of_640_boxes();
    count_affine_region_of_640_boxes();
    count_640_points();
    std::puts("counted");
}
