// SPDX-License-Identifier: MIT
//
// An ordinary view, sun and world for cascades, in float and in double.
#pragma once

#include <shadowmath/cascades.hpp>

#include <gtest/gtest.h>

namespace shadowmath::test {

template <class T>
class CascadesOf : public ::testing::Test {
protected:
    ViewVolume<T> view = perspective_view(Pose<T>{Vec3<T>(T(3), T(1.7), T(-2))}, T(1), T(1.6), T(0.1), T(400));
    Light<T> sun = directional(Vec3<T>(T(0.3), T(-1), T(0.2)));
    Aabb<T> world{Vec3<T>(T(-500), T(-5), T(-500)), Vec3<T>(T(500), T(40), T(500))};
    CascadeOptions<T> options;

    [[nodiscard]] Cascades<T> fitted() const { return fit_cascades(view, sun, world, world, options); }
};

}  // namespace shadowmath::test
