// SPDX-License-Identifier: MIT
//
// What the eye may see, where nothing but boxes is known: guesses at surfaces inside them, for choices that weigh what
// is seen where. With a depth buffer at hand use that instead; its surfaces are no guesses.
//
// Each of a few hundred rays meets some boxes. What they hold is not known, so a ray is taken to end in each box that
// it meets with even odds, and in the last one for certain: there is a ground. A surface in a box is as likely in its
// nearer as in its farther half. Of a box that the eye is in, it sees the room, and its far end where no other box is
// met. A guess's normal leans as far from the eye as from the light (neutral_normal), so what is weighed is perspective
// aliasing alone.
#pragma once

#include <shadowmath/bounds.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/judge.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/light_samples.hpp>
#include <shadowmath/view_volume.hpp>

#include <array>
#include <cmath>

namespace shadowmath {
inline namespace v0 {

inline constexpr int guess_rays_x = 20;
inline constexpr int guess_rays_y = 12;

// A texel is so many times longer on the surfaces that are really there, in the mean, than on one that leans as the
// neutral normal does.
template <class T>
inline constexpr T leaning_surfaces = T(3);

// A surface that the eye may see along one ray.
template <class T>
struct DepthGuess {
    T depth = T(0);   // of the eye
    T weight = T(0);  // of a ray: they sum to 1, or there are none
};

template <class T>
struct RayGuesses {
    std::array<DepthGuess<T>, 8> at;
    int count = 0;
};

// Two in each of the first four boxes that the ray meets. Boxes that are empty or not finite are none.
template <class T>
[[nodiscard]] inline RayGuesses<T> guesses_on_ray(ViewVolume<T> const& view, T side_x, T side_y, Aabb<T> const* boxes,
                                                  int box_count) noexcept {
    constexpr int most = 4;
    RayGuesses<T> guesses;
    std::array<DepthSpan<T>, most> span;  // by their first depths
    DepthSpan<T> around;                  // of the boxes that the eye is in, the one that ends last
    int met = 0;
    for (int b = 0; b < box_count; ++b) {
        if (!all_finite(boxes[b]) || is_empty(boxes[b])) continue;
        DepthSpan<T> const inside = depths_in_box(view, side_x, side_y, boxes[b]);
        if (!(inside.first <= inside.last)) continue;
        if (!(inside.first > view.z_near)) {
            if (inside.last > around.last) around = inside;
            continue;
        }
        if (met == most && !(inside.first < span[most - 1].first)) continue;
        int at = met < most ? met++ : most - 1;
        for (; at > 0 && span[static_cast<unsigned>(at - 1)].first > inside.first; --at)
            span[static_cast<unsigned>(at)] = span[static_cast<unsigned>(at - 1)];
        span[static_cast<unsigned>(at)] = inside;
    }
    auto const guess = [&guesses](DepthSpan<T> const& in, T part, T weight) {
        guesses.at[static_cast<unsigned>(guesses.count++)] = {in.first + (in.last - in.first) * part, weight};
    };
    T left = T(1);
    for (int i = 0; i < met; ++i) {
        T const here = i + 1 < met ? T(0.5) * left : left;
        left -= here;
        guess(span[static_cast<unsigned>(i)], T(0.25), T(0.5) * here);
        guess(span[static_cast<unsigned>(i)], T(0.75), T(0.5) * here);
    }
    if (met == 0 && around.first <= around.last) {
        guess(around, T(0.5), T(0.5));
        guess(around, T(0.9), T(0.5));
    }
    return guesses;
}

// Fills `into` with at most `capacity` weighted guesses and returns how many.
template <class T>
[[nodiscard]] inline int guesses_in_boxes(LightSampler<T> const& sampler, Light<T> const& light, Aabb<T> const* boxes,
                                          int box_count, LightSample<T>* into, int capacity) noexcept {
    constexpr int rays_x = guess_rays_x, rays_y = guess_rays_y;
    int count = 0;
    ViewVolume<T> const& view = sampler.view;
    for (int ray = 0; ray < rays_x * rays_y; ++ray) {
        Vec2<T> const side = detail::side_of_ray(view, ray, rays_x, rays_y);
        RayGuesses<T> const guesses = guesses_on_ray(view, side.x, side.y, boxes, box_count);
        for (int i = 0; i < guesses.count && count < capacity; ++i) {
            DepthGuess<T> const& guess = guesses.at[static_cast<unsigned>(i)];
            Vec3<T> const point = point_at(view, side.x, side.y, guess.depth);
            LightSample<T> sample = light_sample(sampler, {point, neutral_normal(view, light, point)});
            sample.weight = guess.weight;
            if (sample.usable) into[count++] = sample;
        }
    }
    return count;
}

// The same as samples for choose.hpp and judge.hpp, which know no weights: on each of eight by eight rays four, the
// more of them in a box the likelier the ray ends there. None of a view with faults, or without an end.
template <class T>
[[nodiscard]] inline Samples<T> samples_in_boxes(ViewVolume<T> const& view, Light<T> const& light, Aabb<T> const* boxes,
                                                 int box_count) noexcept {
    SHADOWMATH_ASSERT(boxes != nullptr || box_count <= 0, "samples need their boxes");
    Samples<T> samples;
    if (faults_of(view).any() || is_positive_infinity(&view.z_far) || unusable(light)) return samples;
    constexpr int rays = 8, on_each = max_samples / (rays * rays);
    for (int ray = 0; ray < rays * rays; ++ray) {
        Vec2<T> const side = detail::side_of_ray(view, ray, rays, rays);
        RayGuesses<T> const guesses = guesses_on_ray(view, side.x, side.y, boxes, box_count);
        int at = 0;
        T passed = T(0);  // weight of the guesses before `at`
        for (int i = 0; i < on_each && guesses.count > 0; ++i) {
            T const share = (T(i) + T(0.5)) / T(on_each);
            while (at + 1 < guesses.count && passed + guesses.at[static_cast<unsigned>(at)].weight < share)
                passed += guesses.at[static_cast<unsigned>(at++)].weight;
            Vec3<T> const point = point_at(view, side.x, side.y, guesses.at[static_cast<unsigned>(at)].depth);
            if (!all_finite(point)) continue;
            samples.at[static_cast<std::size_t>(samples.count++)] = {point, neutral_normal(view, light, point)};
        }
    }
    return samples;
}

}  // namespace v0
}  // namespace shadowmath
