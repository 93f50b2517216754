// SPDX-License-Identifier: MIT
//
// What slice_warps.hpp promises beyond the laws of every map: that its maps are those of warp.hpp.
#pragma once

#include "tests/laws/slices_in_scene.hpp"
#include "tests/laws/warp.hpp"

#include <shadowmath/slice_warps.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace shadowmath::laws {

// How far apart two maps put the same receivers, in NDC; and how far they may, where planes lie `metres` apart.
struct Apart {
    long double across = 0;
    long double allowed = 0;
};

// `part`: one slice. The twin is made in long double, from the same numbers.
template <class T>
[[nodiscard]] ShadowMap<long double> exact_warp(ViewVolume<T> const& part, Light<T> const& light,
                                                Aabb<T> const& casters, Aabb<T> const& receivers,
                                                WarpOptions<T> const& options, ClipSpace clip) {
    using Real = long double;
    auto const box = [](Aabb<T> const& b) { return Aabb<Real>{Vec3<Real>(b.lo), Vec3<Real>(b.hi)}; };
    WarpOptions<Real> exact;
    exact.map_size = options.map_size;
    exact.margin_texels = options.margin_texels;
    exact.strength = options.strength;
    return simple_perspective_map(exact_view(part), directional(Vec3<Real>(light.direction)), box(casters),
                                  box(receivers), exact, clip);
}

// A body whose ends are moved by d metres and that is s metres long is moved by d / s of it. The warp follows: y by
// d / a, and 1 / a by d / z_near of itself; a is no less than z_near / sine, and 4 of each are allowed. d is what
// `metres` between the planes make of the ends: more where planes meet at a small angle.
template <class T>
[[nodiscard]] Apart apart(ShadowMap<T> const& ours, ShadowMap<long double> const& twin, ViewVolume<T> const& part,
                          Light<T> const& light, Aabb<T> const& receivers, long double metres) {
    using Real = long double;
    ViewVolume<Real> const exact = exact_view(part);
    WarpAxes<Real> const axes = warp_axes(exact.pose, directional(Vec3<Real>(light.direction)).direction);
    ConvexBody<Real> const body = visible_body(exact, Aabb<Real>{Vec3<Real>(receivers.lo), Vec3<Real>(receivers.hi)});
    Mat4<Real> const ours_canonical = canonical_from_clip<Real>(ours.clip) * Mat4<Real>(ours.clip_from_world);
    Mat4<Real> const twin_canonical = canonical_from_clip<Real>(twin.clip) * twin.clip_from_world;
    detail::Extent<Real> x, y, depth;
    Apart found;
    for_each_vertex(body, [&](Vec3<Real> const& p) {
        x.add(glm::dot(axes.basis.x, p));
        y.add(glm::dot(axes.basis.y, p));
        depth.add(glm::dot(exact.pose.forward, p));
        Vec4<Real> const world(p + exact.pose.position, 1);
        Vec4<Real> const a = ours_canonical * world, b = twin_canonical * world;
        if (!(a.w > 0)) found.across = 1e30L;
        for (int axis = 0; axis < 2; ++axis)
            found.across = std::max(found.across, std::abs(a[axis] / a.w - b[axis] / b.w));
    });
    detail::Extent<Real> wider_x, wider_y, wider_depth;
    for_each_vertex(visible_body(exact, Aabb<Real>{Vec3<Real>(receivers.lo), Vec3<Real>(receivers.hi)}, metres),
                    [&](Vec3<Real> const& p) {
                        wider_x.add(glm::dot(axes.basis.x, p));
                        wider_y.add(glm::dot(axes.basis.y, p));
                        wider_depth.add(glm::dot(exact.pose.forward, p));
                    });
    for (auto const& [wide, tight] : {std::pair(wider_x, x), std::pair(wider_y, y), std::pair(wider_depth, depth)})
        metres = std::max(metres, std::max(tight.lo - wide.lo, wide.hi - tight.hi));
    // Of a body that is flat or a point nothing can be said: what it allows is too much to compare.
    Real const narrow = std::max(std::min(x.hi - x.lo, y.hi - y.lo), 1e-30L);
    Real const nearest = std::max(depth.lo, exact.z_far / (1 << 20));
    Real const grows = exact.kind == ViewKind::perspective ? 1 + (y.hi - y.lo) * axes.sine / nearest : 1;
    found.allowed = 4 * metres * (2 / narrow * grows + axes.sine / nearest * grows);
    return found;
}

}  // namespace shadowmath::laws
