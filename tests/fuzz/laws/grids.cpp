// SPDX-License-Identifier: MIT
//
// Stillness: texel grids, strips to redraw, clip maps, all slices at once.
#include "tests/fuzz/inputs.hpp"
#include "tests/laws/clipmap.hpp"
#include "tests/laws/scroll.hpp"
#include "tests/laws/slices.hpp"
#include "tests/laws/texel_grid.hpp"

namespace shadowmath::fuzz {
namespace {

template <class T>
void try_grids(Case& c) {
    LightBasis<T> basis = light_basis(good_sun<T>(c).direction);
    T margin = c.uniform<T>(T(0), T(8));
    int const size = 19 + c.below(8000);
    ClipSpace const clip = any_clip(c);
    Sphere<T> sphere{point_within<T>(c, T(100)), c.magnitude<T>(0, 13)};
    TexelGrid<T> const grid = c.calm_call([&] { return texel_grid(basis, sphere, size, margin); });
    c.require(laws::holds_sphere_and_margin(grid, sphere, margin), "a grid holds its sphere and margin");
    Sphere<T> const moved{point_within<T>(c, T(1000)), sphere.radius};
    TexelGrid<T> const after = texel_grid(basis, moved, size, margin);
    Vec3<T> const point = moved.center + point_within<T>(c, T(1));
    if (!grid.faults.any() && !after.faults.any())
        c.require(laws::keeps_its_place_in_the_texel(grid, after, clip, point), "a point keeps its place in a texel");
    c.hash(clip_from_world(grid, T(0), T(1), clip));
    for (T* const number : {&sphere.center.x, &sphere.center.z, &sphere.radius, &margin, &basis.x.y})
        if (c.one_in(2)) *number = c.number<T>();
    T const lo = c.number<T>(), hi = c.number<T>();
    int const any_size = static_cast<int>(static_cast<std::int32_t>(c.bits(4)));
    TexelGrid<T> const odd = c.call([&] { return texel_grid(basis, sphere, any_size, margin); });
    c.require(laws::is_harmless(odd, lo, hi, clip), "any grid is harmless");
}

template <class T>
void try_scroll(Case& c) {
    int const size = 1 + c.below(24);
    LightBasis<T> const basis = light_basis(good_sun<T>(c).direction);
    Vec3<T> const start = point_within<T>(c, T(100)), step = point_within<T>(c, T(2) * T(size));
    TexelGrid<T> const before = grid_window(basis, start, T(1), size);
    TexelGrid<T> const after = grid_window(basis, start + step, T(1), size);
    Scroll const scroll = c.call([&] { return scroll_between(before, after); });
    c.require(laws::covers_once(before, after, scroll), "each texel is kept or drawn, once");
    for (int i = 0; i < scroll.fresh.count; ++i)
        c.require(laws::wraps_once(after, scroll.fresh.at[static_cast<std::size_t>(i)]), "parts wrap once");
    Vec3<T> const place = any_vector<T>(c);
    T const texel = c.number<T>();
    TexelGrid<T> const elsewhere = grid_window(basis, place, texel, c.below(40) - 5);
    (void)c.call([&] { return scroll_between(elsewhere, after).kept || scroll_between(before, elsewhere).kept; });
}

template <class T>
void try_clipmaps(Case& c) {
    LightBasis<T> const basis = light_basis(good_sun<T>(c).direction);
    Vec3<T> const center = point_within<T>(c, T(1000)), elsewhere = point_within<T>(c, T(1000));
    Vec3<T> const point = center + point_within<T>(c, T(40));
    ClipmapOptions<T> options;
    options.page_texels = 1 + c.below(128);
    options.map_size = options.page_texels * (4 + c.below(40));
    Clipmap<T> const map = c.call([&] { return clipmap(basis, center, options); });
    Clipmap<T> const other = clipmap(basis, elsewhere, options);
    c.require(laws::nests(map), "levels nest");
    for (int level = 0; level < map.count; ++level) {
        Page const page = page_at(map, level, point);
        c.require(level >= other.count || page == page_at(other, level, point), "the camera names no page");
        if (level + 1 < map.count)
            c.require(laws::is_quarter_of(page, page_at(map, level + 1, point)), "a page is a quarter of the next");
    }
    c.require(laws::fits_the_pixel(map, point, c.magnitude<T>(-14, 7)), "a texel fits its pixel");
    options.finest_metres = c.number<T>();
    options.levels = c.below(40) - 5;
    options.page_texels = c.below(200) - 20;
    Vec3<T> const any = any_vector<T>(c);
    T const pixel = c.number<T>();
    (void)c.call([&] { return page_for(clipmap(basis, any, options), any, pixel).level; });
}

template <class T>
void try_slices(Case& c) {
    ViewVolume<T> view = good_view<T>(c);
    LightBasis<T> basis = light_basis(good_sun<T>(c).direction);
    Splits<T> splits = uniform_splits(view.z_near, view.z_far, 1 + c.below(6));
    ClipSpace const clip = any_clip(c);
    T border = c.uniform<T>(T(0), T(0.1));
    int const size = 64 + c.below(4096);
    Mat4<T> boxes[max_splits], spheres[max_splits];
    bool const boxed = c.calm_call([&] { return fit_slice_boxes(view, basis, splits, border, clip, boxes); });
    bool const rounded = c.calm_call([&] { return fit_slice_spheres(view, basis, splits, size, T(2), clip, spheres); });
    c.require(boxed && rounded, "a good view has all its slices");
    for (int i = 0; boxed && rounded && i < splits.count; ++i) {
        ViewVolume<T> const part = slice(view, slice_range(splits, i));
        c.require(laws::holds_corners(boxes[i], clip, part, 2 * static_cast<long double>(border)),
                  "boxes hold every corner inside their border");
        c.require(laws::is_filled(boxes[i], clip, part, border), "boxes are filled");
        long double const rounding =
            laws::slice_rounding(part) * glm::length(Vec3<long double>(Vec4<long double>(row(spheres[i], 0))));
        c.require(laws::holds_corners(spheres[i], clip, part, 2 * 2.0L / size - rounding), "spheres hold every corner");
        c.require(laws::is_on_the_grid(spheres[i], basis, part, size, T(2), clip), "spheres stand on the texel grid");
        c.hash(boxes[i]);
    }
    spoil(c, view);
    if (c.one_in(3)) splits.plane[c.below(splits.count + 1)] = c.number<T>();
    if (c.one_in(3)) border = c.number<T>();
    if (c.one_in(3)) basis.x = any_vector<T>(c);
    bool const some = c.call([&] { return fit_slice_boxes(view, basis, splits, border, clip, boxes); });
    (void)c.call([&] { return fit_slice_spheres(view, basis, splits, size, border, clip, spheres); });
    for (int i = 0; i < splits.count; ++i) {
        c.require(all_finite(boxes[i]) && all_finite(spheres[i]), "slices of anything are finite");
        c.require(some || boxes[i] == nowhere<T>(), "slices of nothing are nowhere");
    }
}

template <class T>
void try_stillness(Case& c) {
    switch (c.below(4)) {
        case 0: return try_grids<T>(c);
        case 1: return try_scroll<T>(c);
        case 2: return try_clipmaps<T>(c);
        default: return try_slices<T>(c);
    }
}

[[maybe_unused]] bool const grids_target =
    add_target("grids", [](Case& c) { c.one_in(2) ? try_stillness<float>(c) : try_stillness<double>(c); });

}  // namespace
}  // namespace shadowmath::fuzz
