// SPDX-License-Identifier: MIT
//
// How rapidcheck prints a counterexample: with all digits, so that it can be pasted into a unit test.
#pragma once

#include <shadowmath/bounds.hpp>
#include <shadowmath/clip_space.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/view_volume.hpp>

#include <limits>
#include <ostream>

// rapidcheck finds these by argument-dependent lookup, so each stands in the namespace of what it shows.
namespace glm {

template <length_t N, class T, qualifier Q>
void showValue(vec<N, T, Q> const& v, std::ostream& out) {
    out.precision(std::numeric_limits<T>::max_digits10);
    for (length_t i = 0; i < N; ++i) out << (i == 0 ? "(" : ", ") << v[i];
    out << ")";
}

template <length_t C, length_t R, class T, qualifier Q>
void showValue(mat<C, R, T, Q> const& m, std::ostream& out) {
    for (length_t i = 0; i < C; ++i) {
        out << (i == 0 ? "columns " : ", ");
        showValue(m[i], out);
    }
}

}  // namespace glm

namespace shadowmath {
inline namespace v0 {

template <class T>
void showValue(Pose<T> const& pose, std::ostream& out) {
    out << "position ";
    showValue(pose.position, out);
    out << " right ";
    showValue(pose.right, out);
    out << " up ";
    showValue(pose.up, out);
    out << " forward ";
    showValue(pose.forward, out);
}

template <class T>
void showValue(ViewVolume<T> const& view, std::ostream& out) {
    showValue(view.pose, out);
    out << (view.kind == ViewKind::perspective ? " perspective" : " orthographic") << " left " << view.left << " right "
        << view.right << " bottom " << view.bottom << " top " << view.top << " z_near " << view.z_near << " z_far "
        << view.z_far;
}

template <class T>
void showValue(Light<T> const& light, std::ostream& out) {
    out << (light.kind == LightKind::directional ? "directional " : "spot ");
    showValue(light.direction, out);
    out << " position ";
    showValue(light.position, out);
    out << " half angle " << light.half_angle_radians << " range " << light.range << " faults " << light.faults.bits;
}

template <class T>
void showValue(Aabb<T> const& box, std::ostream& out) {
    out << "lo ";
    showValue(box.lo, out);
    out << " hi ";
    showValue(box.hi, out);
}

inline void showValue(ClipSpace clip, std::ostream& out) {
    char const* const orders[] = {"0..1", "1..0", "-1..1"};
    out << "depth " << orders[static_cast<int>(clip.depth)] << (clip.ndc_y == YAxis::up ? " y up" : " y down")
        << (clip.texture_v == YAxis::up ? " v up" : " v down");
}

inline void showValue(Faults faults, std::ostream& out) {
    out << describe(faults) << " (bits " << faults.bits << ")";
}

}  // namespace v0
}  // namespace shadowmath
