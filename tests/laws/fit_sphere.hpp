// SPDX-License-Identifier: MIT
//
// Laws of the bounding sphere. Corners are recomputed in long double from the slice's numbers.
#pragma once

#include <shadowmath/fit_sphere.hpp>

#include <cmath>

namespace shadowmath::laws {

using Long = long double;

template <class T>
[[nodiscard]] ViewVolume<Long> widened_to_long(ViewVolume<T> const& v) {
    Pose<Long> const pose{Vec3<Long>(v.pose.position), Vec3<Long>(v.pose.right), Vec3<Long>(v.pose.up),
                          Vec3<Long>(v.pose.forward)};
    return {pose, v.left, v.right, v.bottom, v.top, v.z_near, v.z_far, v.kind};
}

// The radius that a ball around `center` needs.
[[nodiscard]] inline Long needed_radius(std::array<Vec3<Long>, 8> const& points, Vec3<Long> const& center) {
    Long needed = 0;
    for (Vec3<Long> const& point : points) needed = std::fmax(needed, glm::distance(point, center));
    return needed;
}

// What the centre is rounded by: three products and their sum, from axes that are unit to a few ulp.
template <class T>
[[nodiscard]] Long centre_rounding(ViewVolume<T> const& slice, Sphere<T> const& sphere) {
    Long const reach = glm::length(Vec3<Long>(slice.pose.position)) + Long(slice.z_far) + Long(sphere.radius);
    return 8 * Long(std::numeric_limits<T>::epsilon()) * reach;
}

template <class T>
[[nodiscard]] bool holds_every_corner(ViewVolume<T> const& slice) {
    Sphere<T> const sphere = bounding_sphere(slice);
    Long const needed = needed_radius(corners(widened_to_long(slice)), Vec3<Long>(sphere.center));
    return sphere.radius > T(0) && needed <= Long(sphere.radius) + centre_rounding(slice, sphere);
}

// No smaller ball: the radius needed is a convex function of the centre, and grows (or stays) in all 26 directions, at
// steps from an ulp-sized to a radius-sized one.
template <class T>
[[nodiscard]] bool no_other_centre_needs_less(ViewVolume<T> const& slice) {
    Sphere<T> const sphere = bounding_sphere(slice);
    ViewVolume<Long> const exact = widened_to_long(slice);
    std::array<Vec3<Long>, 8> const points = corners(exact);
    // The slack that bounding_sphere adds is of the size of the roundings in view space.
    Long const rounding = 4 * centre_rounding(slice, sphere);
    Long const radius = Long(sphere.radius) - rounding;
    for (int i = 0; i < 27; ++i)
        for (Long step = 1; step > 1e-7L; step /= 8) {
            Vec3<Long> const way(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
            Vec3<Long> const aside = exact.pose.right * way.x + exact.pose.up * way.y + exact.pose.forward * way.z;
            if (needed_radius(points, Vec3<Long>(sphere.center) + aside * (step * Long(sphere.radius))) < radius)
                return false;
        }
    return true;
}

// How many corners lie on the sphere.
template <class T>
[[nodiscard]] int corners_on_sphere(ViewVolume<T> const& slice, int operations = 64) {
    Sphere<T> const sphere = bounding_sphere(slice);
    int count = 0;
    for (Vec3<Long> const& corner : corners(widened_to_long(slice))) {
        Long const gap = std::abs(glm::distance(corner, Vec3<Long>(sphere.center)) - Long(sphere.radius));
        count += gap <= operations * centre_rounding(slice, sphere) / 8;
    }
    return count;
}

// Bit for bit.
template <class T>
[[nodiscard]] bool has_the_same_radius_from(ViewVolume<T> slice, Pose<T> const& other) {
    T const here = bounding_sphere(slice).radius;
    slice.pose = other;
    return bounding_sphere(slice).radius == here;
}

// For any numbers at all: finite, and a radius of 0 exactly where there is a reason.
template <class T>
[[nodiscard]] bool is_finite_or_nothing(ViewVolume<T> const& slice) {
    Sphere<T> const sphere = bounding_sphere(slice);
    bool const finite = all_finite(sphere.center) && all_finite(&sphere.radius, 1) && sphere.radius >= T(0);
    return finite && (!faults_of(slice).any() || sphere.radius == T(0));
}

}  // namespace shadowmath::laws
