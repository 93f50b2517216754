// SPDX-License-Identifier: MIT
//
// Options found by measuring: how many maps, how large, split where, fitted how, so that the worst (or the mean)
// footprint over what the eye sees is least, or the fewest pixels come out wrong, within a number of texels. For a
// settings menu, an editor, the loading of a level, or again when the camera has gone somewhere else; not for every
// frame, since options that change make shadows jump.
//
// It tries them: every number of maps, every fit allowed, eleven values of lambda and then between the best two
// neighbours; of warped maps also each with half of its warp and with none. No randomness, no clock; the same inputs
// give the same options, after at most 29 tries for each pair of count and fit and two for each warped map. Where two
// are equal to a fiftieth the earlier one stays: fewer maps, and the calmer fit.
//
// Source: none; engines leave this to the user's eye. The closed forms (aliasing.hpp) say what is best for one light on
// one plane; this holds for any.
#pragma once

#include <shadowmath/bounds.hpp>
#include <shadowmath/cascades.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/fault.hpp>
#include <shadowmath/judge.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/view_volume.hpp>

#include <cmath>
#include <cstdint>

namespace shadowmath {
inline namespace v0 {

enum class Goal : std::uint8_t {
    least_worst,   // of the footprints: no place is much worse than the others
    least_mean,    // of the footprints
    fewest_wrong,  // of the pixels (price_of): the truest picture, and what choose_maps goes by
};

enum class Motion : std::uint8_t {
    still,    // no shimmer at all: stable fits
    at_ease,  // the nearest map still, the others may crawl
    any       // whatever is finest: a camera that stands, or a temporal filter
};

template <class T>
struct ChoiceLimits {
    Vec2<T> eye_pixels{T(1920), T(1080)};
    std::int64_t texels = 4 * 2048 * 2048;  // of all maps together
    int most_maps = 4;                      // 1 to max_splits
    int largest_map = 8192;                 // texels along a side
    Motion motion = Motion::still;
    Goal goal = Goal::least_worst;
};

template <class T>
struct Choice {
    CascadeOptions<T> options;  // those given, with count, map_size, fit, steady_maps, lambda, warp_less chosen
    Judgement<T> judgement;     // of these options
    int tried = 0;
    bool visible = false;  // false: no map showed any of the samples, and the options are those given
    Faults faults;         // clamped_option: a limit outside its range
};

// The side of `count` square maps that together have no more than `texels`, a multiple of 4, no larger than `largest`.
[[nodiscard]] constexpr int map_size_within(std::int64_t texels, int count, int largest) noexcept {
    std::int64_t const each = count > 0 ? texels / count : 0;
    std::int64_t side = 0;
    for (std::int64_t step = std::int64_t(1) << 20; step >= 4; step /= 2)
        if (side + step <= largest && (side + step) * (side + step) <= each) side += step;
    return static_cast<int>(side);
}

// None of the options tried has a lesser worst (mean) footprint over the samples, but for a fiftieth; options given
// (blend, filter, distance, clip, pinned split) are kept. Points with no map count as footprint_limit, so options that
// leave receivers out lose; CascadeFit::focus is tried for them all the same.
template <class T>
[[nodiscard]] inline Choice<T> choose(ViewVolume<T> const& view, Light<T> const& light, Aabb<T> const& casters,
                                      Aabb<T> const& receivers, SurfacePoint<T> const* samples, int sample_count,
                                      CascadeOptions<T> const& given, ChoiceLimits<T> const& limits) noexcept {
    Choice<T> best;
    best.options = given;
    int const most = limits.most_maps < 1 ? 1 : (limits.most_maps > max_splits ? max_splits : limits.most_maps);
    if (most != limits.most_maps || limits.texels < 16 || limits.largest_map < 4) best.faults = Fault::clamped_option;
    T least = footprint_limit<T>;
    auto const value = [&limits](Judgement<T> const& judgement) {
        switch (limits.goal) {
            case Goal::least_mean: return judgement.all.mean;
            case Goal::fewest_wrong: return judgement.all.price;
            default: return judgement.all.worst;
        }
    };
    auto const attempt = [&](CascadeOptions<T> const& options) {
        Cascades<T> const cascades = fit_cascades(view, light, casters, receivers, options);
        ++best.tried;
        return judge(cascades, options.map_size, view, limits.eye_pixels, samples, sample_count);
    };
    CascadeFit const fits[] = {CascadeFit::stable, CascadeFit::tight, CascadeFit::rectangle, CascadeFit::focus,
                               CascadeFit::warped};
    int const fit_count = limits.motion == Motion::still || light.kind == LightKind::spot ? 1 : 5;
    for (int count = 1; count <= most; ++count) {
        CascadeOptions<T> options = given;
        options.count = count;
        options.map_size = map_size_within(limits.texels, count, limits.largest_map);
        options.steady_maps = limits.motion == Motion::at_ease ? 1 : 0;
        if (faults_of_margin(options.map_size, T(given.filter_radius + 1)).any()) continue;
        for (int f = 0; f < fit_count; ++f) {
            options.fit = fits[f];
            if (options.steady_maps >= count && f > 0) break;
            T lo = T(0), hi = T(1);
            T here_least = footprint_limit<T>;
            CascadeOptions<T> here = options;
            Judgement<T> judgement;
            for (int round = 0; round < 3; ++round) {
                // One map has no splits to place.
                int const steps = count > 1 ? (round == 0 ? 10 : 8) : 0;
                T const step = steps > 0 ? (hi - lo) / T(steps) : T(0);
                for (int i = 0; i <= steps; ++i) {
                    options.lambda = lo + step * T(i);
                    Judgement<T> const measured = attempt(options);
                    if (measured.all.count == 0 || !(value(measured) < here_least)) continue;
                    here_least = value(measured);
                    here = options;
                    judgement = measured;
                }
                if (steps == 0) break;
                lo = std::fmax(here.lambda - step, T(0));
                hi = std::fmin(here.lambda + step, T(1));
            }
            if (!(here_least < least * T(0.98))) continue;
            least = here_least;
            best.options = here;
            best.judgement = judgement;
            best.visible = true;
        }
    }
    if (best.options.fit != CascadeFit::warped || !best.visible) return best;
    // A warp helps where the view looks along the ground, and takes from what is far away: each map decides.
    for (int c = 0; c < best.options.count; ++c)
        for (T const less : {T(0.5), T(1)}) {
            CascadeOptions<T> options = best.options;
            options.warp_less[static_cast<unsigned>(c)] = less;
            Judgement<T> const measured = attempt(options);
            if (!(value(measured) < least)) continue;
            least = value(measured);
            best.options = options;
            best.judgement = measured;
        }
    return best;
}

}  // namespace v0
}  // namespace shadowmath
