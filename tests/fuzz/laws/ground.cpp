// SPDX-License-Identifier: MIT
//
// Boxes, lengths, lights, regions: what every technique stands on.
#include "tests/fuzz/inputs.hpp"
#include "tests/laws/bounds.hpp"
#include "tests/laws/fit_box.hpp"
#include "tests/laws/fit_sphere.hpp"
#include "tests/laws/light.hpp"
#include "tests/laws/region.hpp"
#include "tests/laws/view_volume.hpp"

namespace shadowmath::fuzz {
namespace {

template <class T>
void try_boxes(Case& c) {
    Aabb<T> const a = good_box<T>(c), b = good_box<T>(c);
    Vec3<T> const point = point_within<T>(c, T(300));
    c.require(laws::merges(a, b, point), "a merged box is the smallest around both");
    c.require(laws::intersects(a, b, point), "an intersection holds what both hold");
    Aabb<T> const any = any_box<T>(c), other = any_box<T>(c);
    (void)c.call([&] { return is_empty(intersect(merge(any, other), a)) || contains(any, point); });
}

template <class T>
void try_lights(Case& c) {
    Light<T> const any = c.call([&] { return any_light<T>(c); });
    c.require(!unusable(any) || faults_of(any).any(), "a light says what it lacks");
    Vec3<T> const axis = any_vector<T>(c);
    c.require(laws::is_usable_or_says_why(directional(axis)), "a sun is usable, or says why not");
    Light<T> const sun = good_sun<T>(c);
    LightBasis<T> const basis = c.calm_call([&] { return light_basis(sun.direction); });
    c.require(laws::is_orthonormal(basis), "the axes of a light are orthonormal");
    for (Vec3<T> const* const v : {&basis.x, &basis.y, &basis.depth}) c.hash(&v->x, 3);
}

template <class T>
void try_views(Case& c) {
    ViewVolume<T> view = good_view<T>(c);
    c.require(!faults_of(view).any(), "a good view has no fault");
    c.require(laws::has_accurate_corners(view), "corners are right to 4 ulp");
    c.require(laws::holds_every_corner(view), "the bounding sphere holds every corner");
    c.hash(c.calm_call([&] { return clip_from_world(view, any_clip(c)); }));
    Sphere<T> const sphere = c.calm_call([&] { return bounding_sphere(view); });
    c.hash(&sphere.center.x, 3);
    c.hash(&sphere.radius, 1);
    LightBox<T> const box =
        c.call([&] { return fit_box(light_basis(good_sun<T>(c).direction), corners(view), 512, T(2)); });
    c.require(laws::is_a_box(box), "a fitted box has an extent");
    spoil(c, view);
    c.require(laws::is_finite_or_nothing(view), "the sphere of any view is finite, or says why not");
    Mat4<T> const matrix = c.call([&] { return clip_from_world(view, any_clip(c)); });
    c.require(overflow_unseen || all_finite(matrix), "any view has a finite matrix");
    Mat4<T> projection(T(0));
    for (int i = 0; i < 16; ++i) projection[i / 4][i % 4] = c.one_in(3) ? c.number<T>() : c.uniform<T>(T(-2), T(2));
    ViewVolume<T> const read = c.call([&] { return view_from_projection(view.pose, projection, T(0.1), T(10)); });
    c.require(overflow_unseen || all_finite(clip_from_world(read, gl_clip)),
              "a view read from any matrix has a finite one");
}

template <class T>
void try_regions(Case& c) {
    Tile const tile{c.below(300) - 20, c.below(300) - 20, c.below(100) - 10, c.below(300) - 20, c.below(300) - 20};
    c.require(all_finite(c.call([&] { return tile_matrix<T>(tile, any_clip(c)); })), "a tile's matrix is finite");
    T const x = c.number<T>(), y = c.number<T>(), z = c.number<T>(), w = c.number<T>();
    Region<T> const region{Vec2<T>(x, y), Vec2<T>(z, w)};
    c.require(all_finite(c.call([&] { return region_matrix(region); })), "a region's matrix is finite");
}

template <class T>
void try_ground(Case& c) {
    switch (c.below(4)) {
        case 0: return try_boxes<T>(c);
        case 1: return try_lights<T>(c);
        case 2: return try_views<T>(c);
        default: return try_regions<T>(c);
    }
}

[[maybe_unused]] bool const ground_target =
    add_target("ground", [](Case& c) { c.one_in(2) ? try_ground<float>(c) : try_ground<double>(c); });

}  // namespace
}  // namespace shadowmath::fuzz
