// SPDX-License-Identifier: MIT
//
// Projection matrices as the users of GLM have them, for reading views back from: glm's suffixed functions, and what
// engines do to their results.
#pragma once

#include <shadowmath/view_volume.hpp>

#include <glm/ext/matrix_clip_space.hpp>

#include <array>

namespace shadowmath::test {

enum class Hand { right, left };
enum class Depth { zero_to_one, minus_one_to_one, reversed, endless, reversed_endless };
inline constexpr std::array all_depths = {Depth::zero_to_one, Depth::minus_one_to_one, Depth::reversed, Depth::endless,
                                          Depth::reversed_endless};

// The sides and range of `view` as a projection matrix. Without a far plane only perspective makes sense.
template <class T>
[[nodiscard]] Mat4<T> projection_of(ViewVolume<T> const& view, Hand hand, Depth depth, bool y_flipped) {
    bool const backwards = depth == Depth::reversed;
    T const first = backwards ? view.z_far : view.z_near, second = backwards ? view.z_near : view.z_far;
    bool const full = depth == Depth::minus_one_to_one;
    Mat4<T> clip_from_view;
    if (view.kind == ViewKind::orthographic) {
        auto const make = hand == Hand::right ? (full ? glm::orthoRH_NO<T> : glm::orthoRH_ZO<T>)
                                              : (full ? glm::orthoLH_NO<T> : glm::orthoLH_ZO<T>);
        clip_from_view = make(view.left, view.right, view.bottom, view.top, first, second);
    } else {
        // frustum wants its sides where its first distance is; the sides enter divided by it again.
        // NOTE: glm 0.9.9.8's frustumLH has the wrong sign in its third column: off-centre, it does not mirror
        // frustumRH.
        clip_from_view =
            (full ? glm::frustumRH_NO<T> : glm::frustumRH_ZO<T>)(view.left * first, view.right * first,
                                                                 view.bottom * first, view.top * first, first, second);
        if (hand == Hand::left) clip_from_view[2] = -clip_from_view[2];
        T const h = hand == Hand::right ? T(-1) : T(1);
        if (depth == Depth::endless) {
            clip_from_view[2][2] = h;
            clip_from_view[3][2] = -view.z_near;
        }
        if (depth == Depth::reversed_endless) {
            clip_from_view[2][2] = T(0);
            clip_from_view[3][2] = view.z_near;
        }
    }
    if (y_flipped)
        for (int column = 0; column < 4; ++column) clip_from_view[column][1] = -clip_from_view[column][1];
    return clip_from_view;
}

// The volume as it is meant to be read back: a flipped y is a matter of the target, not of what is seen.
template <class T>
[[nodiscard]] ViewVolume<T> read_back(ViewVolume<T> const& view, Mat4<T> const& clip_from_view) {
    return view_from_projection(view.pose, clip_from_view, view.z_near, view.z_far);
}

}  // namespace shadowmath::test
