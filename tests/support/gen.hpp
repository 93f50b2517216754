// SPDX-License-Identifier: MIT
//
// What the properties are tried on. Made from rapidcheck's integers only: its floats are never NaN, infinite or
// denormal. Every draw goes into a named local, because compilers differ in the order in which they evaluate arguments,
// and the same seed must mean the same case everywhere.
//
//   EXPECT_TRUE(rc::check([] {
//       auto const view = *view_volume<double>();
//       RC_ASSERT(laws::contains_every_corner(fit(view), view));
//   }));
//
// Valid inputs (view_volume, sun, spot_light, box) hold what the headers' contracts ask for, up to their edges; nasty
// ones hold anything that fits into the type; any_ are of both kinds. Cases shrink toward zero, the axes and the unit
// box.
#pragma once

#include "show.hpp"

#include <shadowmath/bounds.hpp>
#include <shadowmath/clip_space.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/view_volume.hpp>

#include <rapidcheck.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

namespace shadowmath::test {

// A whole number in [0, count), spread evenly at every size of rapidcheck; shrinks toward 0.
inline rc::Gen<std::uint64_t> below(std::uint64_t count) {
    return rc::gen::resize(rc::kNominalSize, rc::gen::inRange<std::uint64_t>(0, count));
}

// One case in `count`.
inline rc::Gen<bool> one_in(std::uint64_t count) {
    return rc::gen::map(below(count), [count](std::uint64_t drawn) { return drawn + 1 == count; });
}

// In [lo, hi], both ends included; shrinks toward lo.
template <class T>
rc::Gen<T> uniform(T lo, T hi) {
    constexpr std::uint64_t steps = std::uint64_t(1) << std::numeric_limits<T>::digits;
    return rc::gen::map(below(steps + 1), [=](std::uint64_t drawn) {
        T const share = static_cast<T>(drawn) / static_cast<T>(steps);
        return lo * (T(1) - share) + hi * share;
    });
}

// In [lo, hi], evenly over the orders of magnitude; 0 < lo. Shrinks toward lo.
template <class T>
rc::Gen<T> log_uniform(T lo, T hi) {
    return rc::gen::map(uniform<T>(std::log2(lo), std::log2(hi)), [=](T power) {
        T const value = std::exp2(power);
        return value < lo ? lo : (value > hi ? hi : value);
    });
}

// In [-radius, radius]; shrinks toward 0.
template <class T>
rc::Gen<T> centred(T radius) {
    return rc::gen::exec([=] {
        bool const negative = *one_in(2);
        T const magnitude = *uniform<T>(T(0), radius);
        return negative ? -magnitude : magnitude;
    });
}

// Zeros, denormals, the ends of the range, neighbours of powers of two, infinities, NaN; any bit pattern; any
// magnitude.
template <class T>
rc::Gen<T> nasty() {
    using Limits = std::numeric_limits<T>;
    using Bits = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
    return rc::gen::exec([] {
        std::uint64_t const kind = *below(10);
        if (kind < 5) {
            bool const negative = *one_in(2);
            T const magnitude = *log_uniform<T>(Limits::min(), Limits::max() / T(2));
            return negative ? -magnitude : magnitude;
        }
        if (kind < 7) {
            auto const high = static_cast<Bits>(*below(std::uint64_t(1) << 32));
            auto const low = static_cast<Bits>(*below(std::uint64_t(1) << 32));
            Bits const bits = sizeof(T) == 4 ? low : static_cast<Bits>((static_cast<std::uint64_t>(high) << 32) | low);
            T value;
            std::memcpy(&value, &bits, sizeof value);
            return value;
        }
        T const one = T(1);
        T const special[] = {T(0),
                             Limits::denorm_min(),
                             Limits::min(),
                             Limits::epsilon(),
                             one,
                             std::nextafter(one, T(0)),
                             std::nextafter(one, T(2)),
                             T(2),
                             Limits::max(),
                             Limits::infinity(),
                             Limits::quiet_NaN()};
        T const value = special[*below(std::size(special))];
        bool const negative = *one_in(2);
        return negative ? -value : value;
    });
}

// Anywhere in the cube of this half width.
template <class T>
rc::Gen<Vec3<T>> point_within(T radius) {
    return rc::gen::exec([=] {
        T const x = *centred<T>(radius);
        T const y = *centred<T>(radius);
        T const z = *centred<T>(radius);
        return Vec3<T>(x, y, z);
    });
}

template <class T>
rc::Gen<Vec3<T>> nasty_vec3() {
    return rc::gen::exec([] {
        T const x = *nasty<T>();
        T const y = *nasty<T>();
        T const z = *nasty<T>();
        return Vec3<T>(x, y, z);
    });
}

// Unit: a third the six axes, a third within 0.1 down to 1e-30 of one, a third anywhere.
template <class T>
rc::Gen<Vec3<T>> direction() {
    return rc::gen::exec([] {
        std::uint64_t const kind = *below(3);
        std::uint64_t const axis = *below(3);
        bool const negative = *one_in(2);
        Vec3<T> along(T(0));
        along[static_cast<int>(axis)] = negative ? T(-1) : T(1);
        if (kind == 0) return along;
        Vec3<T> const aside = *point_within<T>(T(1));
        T const tilt = kind == 1 ? *log_uniform<T>(T(1e-30), T(0.1)) : T(1);
        Vec3<T> const towards = kind == 1 ? along + aside * tilt : aside;
        Normalized<T> const unit = safe_normalize(towards);
        return unit.ok ? unit.direction : along;
    });
}

template <class T>
rc::Gen<Pose<T>> pose(T radius) {
    return rc::gen::exec([=] {
        Vec3<T> const position = *point_within<T>(radius);
        Vec3<T> const forward = *direction<T>();
        Vec3<T> const rough_up = *direction<T>();
        return pose_looking(position, forward, rough_up);
    });
}

// How far from the origin valid cases lie: where a metre still has some thousand representable parts.
template <class T>
inline constexpr T world_radius = sizeof(T) == 4 ? T(1e3) : T(1e7);

// No faults, z_far finite. Symmetric, off-centre (even past the axis) and orthographic; from 1e-3 to 3.1 radians wide;
// far / near from 1.01 to 1e6 (float) or 1e9, far at most 1e5 or 1e8 m.
template <class T>
rc::Gen<ViewVolume<T>> view_volume() {
    return rc::gen::exec([] {
        ViewVolume<T> view;
        view.pose = *pose<T>(world_radius<T>);
        std::uint64_t const kind = *below(4);
        view.z_near = *log_uniform<T>(T(1e-2), T(10));
        T const ratio = *log_uniform<T>(T(1.01), sizeof(T) == 4 ? T(1e6) : T(1e9));
        T const farthest = sizeof(T) == 4 ? T(1e5) : T(1e8);
        view.z_far = view.z_near * ratio < farthest ? view.z_near * ratio : farthest;
        bool const flat = kind == 3;
        view.kind = flat ? ViewKind::orthographic : ViewKind::perspective;
        T const half_height = flat ? *log_uniform<T>(T(0.01), T(1e4)) : std::tan(*log_uniform<T>(T(5e-4), T(1.55)));
        T const aspect = *log_uniform<T>(T(0.25), T(4));
        T const half_width = half_height * aspect;
        bool const off_centre = kind >= 2;
        T const x = off_centre ? *centred<T>(T(1.5)) * half_width : T(0);
        T const y = off_centre ? *centred<T>(T(1.5)) * half_height : T(0);
        view.left = x - half_width;
        view.right = x + half_width;
        view.bottom = y - half_height;
        view.top = y + half_height;
        return view;
    });
}

// A valid view of which one to three numbers were replaced by nasty ones.
template <class T>
rc::Gen<ViewVolume<T>> nasty_view_volume() {
    return rc::gen::exec([] {
        ViewVolume<T> view = *view_volume<T>();
        std::uint64_t const replaced = 1 + *below(3);
        for (std::uint64_t i = 0; i < replaced; ++i) {
            auto const field = static_cast<int>(*below(18));
            T const value = *nasty<T>();
            Pose<T>& pose = view.pose;
            Vec3<T>* const vectors[] = {&pose.position, &pose.right, &pose.up, &pose.forward};
            T* const scalars[] = {&view.left, &view.right, &view.bottom, &view.top, &view.z_near, &view.z_far};
            if (field < 12)
                (*vectors[field / 3])[field % 3] = value;
            else
                *scalars[field - 12] = value;
        }
        return view;
    });
}

template <class T>
rc::Gen<Light<T>> sun() {
    return rc::gen::map(direction<T>(), [](Vec3<T> const& travel) { return directional(travel); });
}

template <class T>
rc::Gen<Light<T>> spot_light() {
    return rc::gen::exec([] {
        Vec3<T> const position = *point_within<T>(world_radius<T>);
        Vec3<T> const axis = *direction<T>();
        T const half_angle_radians = *log_uniform<T>(T(1.1e-3), T(1.5));
        T const range = *log_uniform<T>(T(0.1), T(1e4));
        return spot(position, axis, half_angle_radians, range);
    });
}

// What a caller may come with: half of them valid, half with nasty numbers in them.
template <class T>
rc::Gen<ViewVolume<T>> any_view() {
    return rc::gen::exec([] {
        bool const good = *one_in(2);
        return good ? *view_volume<T>() : *nasty_view_volume<T>();
    });
}

// A third valid, a third made of nasty numbers, a third with nasty numbers written past the door.
template <class T>
rc::Gen<Light<T>> any_sun() {
    return rc::gen::exec([] {
        std::uint64_t const kind = *below(3);
        if (kind == 0) return *sun<T>();
        Vec3<T> const travel = *nasty_vec3<T>();
        Light<T> light = directional(travel);
        if (kind == 2) light.direction = travel;
        return light;
    });
}

// Never empty; one in five is a plane, a line or a point. Centre and half extents within `radius`.
template <class T>
rc::Gen<Aabb<T>> box(T radius) {
    return rc::gen::exec([=] {
        Vec3<T> const centre = *point_within<T>(radius);
        bool const degenerate = *one_in(5);
        Vec3<T> half(T(0));
        for (int axis = 0; axis < 3; ++axis) {
            T const extent = *log_uniform<T>(radius * T(1e-5), radius);
            bool const flat = degenerate && *one_in(2);
            half[axis] = flat ? T(0) : extent;
        }
        return Aabb<T>{centre - half, centre + half};
    });
}

// Empty, inverted, as large as the type allows, or with nasty numbers in it.
template <class T>
rc::Gen<Aabb<T>> nasty_box() {
    return rc::gen::exec([] {
        std::uint64_t const kind = *below(5);
        Aabb<T> drawn = *box<T>(T(100));
        if (kind == 0) return Aabb<T>{};
        if (kind == 1) return Aabb<T>{drawn.hi, drawn.lo};
        if (kind == 2)
            return Aabb<T>{Vec3<T>(std::numeric_limits<T>::lowest()), Vec3<T>(std::numeric_limits<T>::max())};
        Vec3<T> const lo = *nasty_vec3<T>();
        Vec3<T> const hi = *nasty_vec3<T>();
        if (kind == 3) return Aabb<T>{lo, hi};
        drawn.hi = hi;
        return drawn;
    });
}

// All twelve.
inline rc::Gen<ClipSpace> clip_space() {
    return rc::gen::map(below(12), [](std::uint64_t drawn) {
        ClipSpace clip;
        clip.depth = static_cast<DepthOrder>(drawn % 3);
        clip.ndc_y = static_cast<YAxis>(drawn / 3 % 2);
        clip.texture_v = static_cast<YAxis>(drawn / 6);
        return clip;
    });
}

}  // namespace shadowmath::test
