// SPDX-License-Identifier: MIT
//
// Views, lights and boxes about what is seen, always the same ones: for tests that must be quick.
#pragma once

#include <shadowmath/bounds.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/view_volume.hpp>

#include <random>

namespace shadowmath::test {

template <class T>
class SeenBoxes {
public:
    T from_to(double lo, double hi) { return T(lo + (hi - lo) * (double(random_()) / 4294967296.0)); }
    Vec3<T> point(double most) { return {from_to(-most, most), from_to(-most, most), from_to(-most, most)}; }

    // `aligned`: along the axes of the world.
    ViewVolume<T> view(ViewKind kind, bool aligned = false) {
        ViewVolume<T> view;
        view.kind = kind;
        view.pose = pose_looking(point(20), aligned ? Vec3<T>(T(0), T(0), T(-1)) : point(1),
                                 aligned ? Vec3<T>(T(0), T(1), T(0)) : point(1));
        T const size = kind == ViewKind::orthographic ? T(30) : T(1);
        view.left = size * from_to(-1.2, 0.2), view.right = view.left + size * from_to(0.3, 1.5);
        view.bottom = size * from_to(-1.2, 0.2), view.top = view.bottom + size * from_to(0.3, 1.5);
        view.z_near = from_to(0.1, 2), view.z_far = from_to(20, 80);
        return view;
    }
    LightBasis<T> light(bool aligned = false) {
        return aligned ? LightBasis<T>{} : light_basis(safe_normalize(point(1)).direction);
    }
    // `flat`: of no height along that axis; 3: none.
    Aabb<T> box(ViewVolume<T> const& view, int flat = 3) {
        Vec3<T> const centre = point_at(view, from_to(-1, 1), from_to(-1, 1), view.z_far * from_to(0, 0.8));
        Vec3<T> half(from_to(0, 30), from_to(0, 30), from_to(0, 30));
        if (flat < 3) half[flat] = T(0);
        return {centre - half, centre + half};
    }

private:
    std::mt19937 random_{20021201};
};

}  // namespace shadowmath::test
