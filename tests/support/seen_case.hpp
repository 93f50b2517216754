// SPDX-License-Identifier: MIT
//
// A view, a point that it sees, boxes around that point and between it and a light: what techniques that fit a map to
// the view are tried on. Boxes drawn without regard to the view would be out of sight in nearly every case.
#pragma once

#include "tests/support/gen.hpp"

#include <algorithm>

namespace shadowmath::test {

template <class T>
struct SeenCase {
    ViewVolume<T> view;
    Vec3<T> point;  // world, in view, inside `receivers`
    Aabb<T> receivers;
    ClipSpace clip;
};

template <class T>
void showValue(SeenCase<T> const& drawn, std::ostream& out) {
    showValue(drawn.view, out);
    out << "\npoint ";
    showValue(drawn.point, out);
    out << "\nreceivers ";
    showValue(drawn.receivers, out);
    out << "\n";
    showValue(drawn.clip, out);
}

template <class T>
rc::Gen<SeenCase<T>> seen_case() {
    return rc::gen::exec([] {
        SeenCase<T> drawn;
        drawn.view = *view_volume<T>();
        ViewVolume<T>& view = drawn.view;
        if (sizeof(T) == 4) {
            // What a float sees must not drown in the rounding of where it is: near the origin, and not a hundred times
            // wider than deep.
            T const largest = std::max(std::max(-view.left, view.right), std::max(-view.bottom, view.top));
            T const shrink = std::min(T(1), (view.kind == ViewKind::perspective ? T(3) : view.z_near) / largest);
            for (T* const side : {&view.left, &view.right, &view.bottom, &view.top}) *side *= shrink;
            view.pose.position *= T(10) * view.z_near / world_radius<T>;
        }
        // Away from the sides by more than the rounding of a point there.
        T const across = *uniform<T>(T(0.05), T(0.95));
        T const up = *uniform<T>(T(0.05), T(0.95));
        T const margin = T(1e-3) * (view.z_far - view.z_near);
        T const depth = *log_uniform<T>(view.z_near + margin, view.z_far - margin);
        drawn.point = point_at(view, view.left + (view.right - view.left) * across,
                               view.bottom + (view.top - view.bottom) * up, depth);
        Vec3<T> half(T(0));
        for (int axis = 0; axis < 3; ++axis) {
            bool const flat = *one_in(5);
            T const extent = *log_uniform<T>(T(1e-3), T(3));
            half[axis] = flat ? T(0) : extent * depth;
        }
        drawn.receivers = {drawn.point - half, drawn.point + half};
        drawn.clip = *clip_space();
        return drawn;
    });
}

}  // namespace shadowmath::test
