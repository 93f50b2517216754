// SPDX-License-Identifier: MIT
//
// Boxes and spheres in whatever space they are said to be in. An empty box is a value, the default one: merging with it
// changes nothing, and a fit that is given one has nothing to see.
#pragma once

#include <shadowmath/config.hpp>
#include <shadowmath/finite.hpp>

#include <array>
#include <limits>

namespace shadowmath {
inline namespace v0 {

template <class T>
struct Aabb {
    Vec3<T> lo{std::numeric_limits<T>::max()};
    Vec3<T> hi{std::numeric_limits<T>::lowest()};
};

template <class T>
struct Sphere {
    Vec3<T> center{T(0)};
    T radius = T(0);
};

// Boxes as structure of arrays: box i is [lo_x[i], hi_x[i]] x ...
template <class T>
struct BoxArrays {
    T const* lo_x = nullptr;
    T const* lo_y = nullptr;
    T const* lo_z = nullptr;
    T const* hi_x = nullptr;
    T const* hi_y = nullptr;
    T const* hi_z = nullptr;
};

template <class T>
[[nodiscard]] inline Aabb<T> box_at(BoxArrays<T> const& boxes, int i) noexcept {
    return {Vec3<T>(boxes.lo_x[i], boxes.lo_y[i], boxes.lo_z[i]), Vec3<T>(boxes.hi_x[i], boxes.hi_y[i], boxes.hi_z[i])};
}

// The boxes from `begin` on.
template <class T>
[[nodiscard]] inline BoxArrays<T> boxes_from(BoxArrays<T> const& boxes, int begin) noexcept {
    return {boxes.lo_x + begin, boxes.lo_y + begin, boxes.lo_z + begin,
            boxes.hi_x + begin, boxes.hi_y + begin, boxes.hi_z + begin};
}

// Empty as soon as one axis has lo > hi, or a NaN.
template <class T>
[[nodiscard]] inline bool is_empty(Aabb<T> const& box) noexcept {
    return !(box.lo.x <= box.hi.x && box.lo.y <= box.hi.y && box.lo.z <= box.hi.z);
}

template <class T>
[[nodiscard]] inline bool all_finite(Aabb<T> const& box) noexcept {
    return all_finite(box.lo) && all_finite(box.hi);
}

template <class T>
[[nodiscard]] inline Aabb<T> merge(Aabb<T> const& box, Vec3<T> const& point) noexcept {
    return {glm::min(box.lo, point), glm::max(box.hi, point)};
}

template <class T>
[[nodiscard]] inline Aabb<T> merge(Aabb<T> const& a, Aabb<T> const& b) noexcept {
    return {glm::min(a.lo, b.lo), glm::max(a.hi, b.hi)};
}

// May be empty.
template <class T>
[[nodiscard]] inline Aabb<T> intersect(Aabb<T> const& a, Aabb<T> const& b) noexcept {
    return {glm::max(a.lo, b.lo), glm::min(a.hi, b.hi)};
}

template <class T>
[[nodiscard]] inline bool contains(Aabb<T> const& box, Vec3<T> const& point) noexcept {
    return box.lo.x <= point.x && point.x <= box.hi.x && box.lo.y <= point.y && point.y <= box.hi.y &&
           box.lo.z <= point.z && point.z <= box.hi.z;
}

// Bit 0 of the index chooses x, bit 1 y, bit 2 z; two corners share an edge when their indices differ in one bit.
template <class T>
[[nodiscard]] inline std::array<Vec3<T>, 8> corners(Aabb<T> const& box) noexcept {
    return {box.lo,
            Vec3<T>(box.hi.x, box.lo.y, box.lo.z),
            Vec3<T>(box.lo.x, box.hi.y, box.lo.z),
            Vec3<T>(box.hi.x, box.hi.y, box.lo.z),
            Vec3<T>(box.lo.x, box.lo.y, box.hi.z),
            Vec3<T>(box.hi.x, box.lo.y, box.hi.z),
            Vec3<T>(box.lo.x, box.hi.y, box.hi.z),
            box.hi};
}

template <class T>
[[nodiscard]] inline Aabb<T> bounds_of(std::array<Vec3<T>, 8> const& points) noexcept {
    Aabb<T> box;
    for (Vec3<T> const& point : points) box = merge(box, point);
    return box;
}

}  // namespace v0
}  // namespace shadowmath
