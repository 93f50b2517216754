// SPDX-License-Identifier: MIT
//
// From what a depth buffer holds to eye depth in metres, for a camera drawn with view_volume.hpp's clip_from_world (or
// any matrix with the same near, far and convention): one multiplication, addition and division, never the inverse of a
// view-projection.
//
// What it is worth: a float buffer with reversed depth keeps eye depth to an ulp or so at any distance. With depth from
// 0 to 1 the error grows as depth^2 / z_near: 6 mm at 100 m, 0.6 m at 1000 m for z_near = 0.1 m. The shader's twin is
// glsl/sample_depths.glsl.
#pragma once

#include <shadowmath/clip_space.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/fault.hpp>
#include <shadowmath/view_volume.hpp>

#include <limits>

namespace shadowmath {
inline namespace v0 {

// Eye depth = (num_scale * stored + num_offset) / (den_scale * stored + den_offset). The default knows no depth: what
// it gives lies behind the eye.
template <class T>
struct DepthCode {
    T num_scale = T(0);
    T num_offset = T(-1);
    T den_scale = T(0);
    T den_offset = T(1);
    T sky = T(1);  // the value that the buffer is cleared to
};

// "Stored" is in [0, 1] in every convention. A view with faults, and an orthographic one without end, give the default.
template <class T>
[[nodiscard]] inline DepthCode<T> depth_code(ViewVolume<T> const& view, ClipSpace clip) noexcept {
    DepthCode<T> code;
    code.sky = far_depth<T>(clip);
    bool const endless = is_positive_infinity(&view.z_far);
    bool const reversed = clip.depth == DepthOrder::one_to_zero;
    if (faults_of(view).any()) return code;
    if (view.kind == ViewKind::perspective) {
        // Depth from the near end is (far - near) / far * (1 - near / z).
        T const share = endless ? T(1) : (view.z_far - view.z_near) / view.z_far;
        T const rest = endless ? T(0) : view.z_near / view.z_far;
        code = {T(0), view.z_near, reversed ? share : -share, reversed ? rest : T(1), code.sky};
    } else if (!endless) {
        T const range = view.z_far - view.z_near;
        code = {reversed ? -range : range, reversed ? view.z_far : view.z_near, T(0), T(1), code.sky};
    }
    return code;
}

// Metres; for the sky a number beyond every depth. NaN gives NaN, which sample reductions leave out.
template <class T>
[[nodiscard]] inline T decoded_depth(DepthCode<T> const& code, T const& stored) noexcept {
    if (stored == code.sky) return std::numeric_limits<T>::max();
    return (code.num_scale * stored + code.num_offset) / (code.den_scale * stored + code.den_offset);
}

}  // namespace v0
}  // namespace shadowmath
