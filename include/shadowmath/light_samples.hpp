// SPDX-License-Identifier: MIT
//
// What the eye sees, as the light sees it: each surface sample as a place on the light's plane, with what a metre there
// is worth in eye pixels. All that a choice of maps needs to know of a picture.
//
// A sun's map is a homography of the light's plane, whatever technique it comes from. So with G the eye pixels that a
// surface gains for a metre of that plane (2 x 2, measured along the surface), and M the texels that the map gains
// there, the footprint is the singular values of G / M: no point is ever projected again.
//
// A sample stands for a cell of the picture, so its place is a small parallelogram: the cell's shadow on the light's
// plane. Whoever covers the parallelograms covers the picture between the samples, but for what none of them has hit.
#pragma once

#include <shadowmath/config.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/judge.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/view_volume.hpp>

#include <cmath>

namespace shadowmath {
inline namespace v0 {

template <class T>
struct LightSample {
    Vec2<T> place{T(0)};   // metres from the eye along basis.x and basis.y
    T depth = T(0);        // along the light, metres from the eye
    Vec2<T> gain_x{T(0)};  // eye pixels for a metre of the plane along basis.x, on the surface
    Vec2<T> gain_y{T(0)};
    Vec2<T> reach_x{T(0)};  // from `place` to the sides of the cell that the sample stands for, metres
    Vec2<T> reach_y{T(0)};
    T weight = T(1);
    Vec3<T> seen{T(0)};   // right and up for a metre of depth (of an orthographic view metres), and eye depth
    bool usable = false;  // false: behind the eye or the light, or no number
};

// What samples are seen by.
template <class T>
struct LightSampler {
    ViewVolume<T> view;
    LightBasis<T> basis;
    Vec2<T> pixels_per_side{T(0)};  // eye pixels for one unit of the view's sides
    Vec2<T> half_cell{T(0)};        // eye pixels
    bool usable = false;
};

// `eye_pixels`: the picture that shadows are for; `cells`: how many samples there are along its sides.
template <class T>
[[nodiscard]] inline LightSampler<T> light_sampler(ViewVolume<T> const& view, Light<T> const& light,
                                                   Vec2<T> const& eye_pixels, Vec2<T> const& cells) noexcept {
    LightSampler<T> sampler;
    sampler.view = view;
    bool const sizes = all_finite(eye_pixels) && all_finite(cells) && eye_pixels.x > T(0) && eye_pixels.y > T(0) &&
                       cells.x > T(0) && cells.y > T(0);
    if (!sizes || faults_of(view).any() || unusable(light) || light.kind != LightKind::directional) return sampler;
    sampler.view.pose = orthonormalized(view.pose);
    sampler.basis = light_basis(light.direction);
    sampler.pixels_per_side = Vec2<T>(eye_pixels.x / (view.right - view.left), eye_pixels.y / (view.top - view.bottom));
    sampler.half_cell = Vec2<T>(T(0.5) * eye_pixels.x / cells.x, T(0.5) * eye_pixels.y / cells.y);
    sampler.usable = all_finite(sampler.pixels_per_side) && all_finite(sampler.half_cell);
    return sampler;
}

// Surfaces that face away from the light come back with weight 0, and those that the light or the eye grazes are taken
// as a little less steep: no map would help them, and no cell is without an end.
template <class T>
[[nodiscard]] inline LightSample<T> light_sample(LightSampler<T> const& sampler,
                                                 SurfacePoint<T> const& surface) noexcept {
    LightSample<T> sample;
    if (!sampler.usable || !all_finite(surface.point) || !all_finite(surface.normal)) return sample;
    constexpr T least_cosine = T(0.05);
    Pose<T> const& pose = sampler.view.pose;
    Vec3<T> const from_eye = surface.point - pose.position;
    bool const flat = sampler.view.kind == ViewKind::orthographic;
    T const right = glm::dot(pose.right, from_eye), up = glm::dot(pose.up, from_eye);
    T const depth = glm::dot(pose.forward, from_eye), spread = flat ? T(1) : depth;
    if (!(depth > T(0)) || !(depth <= sampler.view.z_far * (T(1) + T(1e-5)))) return sample;
    sample.seen = Vec3<T>(right / spread, up / spread, depth);
    sample.place = Vec2<T>(glm::dot(sampler.basis.x, from_eye), glm::dot(sampler.basis.y, from_eye));
    sample.depth = glm::dot(sampler.basis.depth, from_eye);
    Normalized<T> const unit = safe_normalize(surface.normal);
    Vec3<T> normal = unit.direction;
    Vec3<T> const toward_eye = flat ? -pose.forward : safe_normalize(-from_eye).direction;
    if (!unit.ok) normal = toward_eye;
    if (glm::dot(normal, toward_eye) < T(0)) normal = -normal;
    T const to_light = -glm::dot(normal, sampler.basis.depth);
    sample.weight = to_light > T(0) ? T(1) : T(0);
    // A metre along basis.x on the surface: as far along the light as stays on it.
    T const cosine = to_light > least_cosine ? to_light : (to_light < -least_cosine ? to_light : least_cosine);
    auto const gain = [&](Vec3<T> const& axis) {
        Vec3<T> const way = axis + sampler.basis.depth * (glm::dot(normal, axis) / cosine);
        T const away = flat ? T(0) : glm::dot(pose.forward, way);
        return Vec2<T>((glm::dot(pose.right, way) - sample.seen.x * away) * sampler.pixels_per_side.x / spread,
                       (glm::dot(pose.up, way) - sample.seen.y * away) * sampler.pixels_per_side.y / spread);
    };
    sample.gain_x = gain(sampler.basis.x);
    sample.gain_y = gain(sampler.basis.y);
    // The cell's sides: the gains' inverse. A surface seen edge-on has none; then the cell is as deep as it is wide,
    // eight times.
    T const determinant = sample.gain_x.x * sample.gain_y.y - sample.gain_x.y * sample.gain_y.x;
    T const wide =
        T(8) * spread *
        std::fmax(sampler.half_cell.x / sampler.pixels_per_side.x, sampler.half_cell.y / sampler.pixels_per_side.y);
    auto const reach = [&](Vec2<T> const& pixels) {
        Vec2<T> const scaled(pixels.x * sample.gain_y.y - pixels.y * sample.gain_y.x,
                             pixels.y * sample.gain_x.x - pixels.x * sample.gain_x.y);
        T const longest = std::fmax(std::abs(scaled.x), std::abs(scaled.y));
        if (longest < wide * std::abs(determinant)) return scaled / determinant;
        return longest > T(0) ? scaled * (wide / longest) : Vec2<T>(T(0));
    };
    sample.reach_x = reach(Vec2<T>(sampler.half_cell.x, T(0)));
    sample.reach_y = reach(Vec2<T>(T(0), sampler.half_cell.y));
    sample.usable = all_finite(sample.place) && all_finite(sample.gain_x) && all_finite(sample.gain_y) &&
                    all_finite(sample.reach_x) && all_finite(sample.reach_y);
    return sample;
}

}  // namespace v0
}  // namespace shadowmath
