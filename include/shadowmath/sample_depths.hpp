// SPDX-License-Identifier: MIT
//
// How deep the eye really sees, and where to cut that: the depths of all visible samples in 512 bins, merged from any
// number of tiles or threads, and splits that follow them. The first half of sample-distribution shadow maps; sdsm.hpp
// is the whole.
//
//   z_near |....ooooooo............ooooo.ooo......| z_far       o  a sample
//   even        |   |   |   |   |  |  |  |                      every split the same ratio of depths, from the first
//               0       1       2      3                        sample to the last
//   adaptive    |   |   |         |  |   |                      the same, but none starts where nothing is
//
// Both are one rule: with the least ratio r for which `count` splits, each from z to r z, reach the last sample. The
// ratio is found by bisection with products alone: no logarithm, no power. A product is rounded alike by every
// processor, so a shader finds the same splits to the last bit (glsl/sample_depths.glsl).
//
// Source: Lauritzen, Salvi, Lefohn, "Sample distribution shadow maps", I3D 2011. Departure: gaps are not looked for by
// a threshold; the greedy cover skips them, and no other placing of as many splits has a smaller worst ratio.
#pragma once

#include <shadowmath/config.hpp>
#include <shadowmath/fault.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/reach.hpp>
#include <shadowmath/splits.hpp>

#include <cstdint>
#include <cstring>
#include <limits>

namespace shadowmath {
inline namespace v0 {

inline constexpr int depth_bins = 512;

// The depths of samples that are seen; least and greatest of each bin exactly.
template <class T>
struct SampleDepths {
    T z_near = T(0);  // samples from here, included
    T z_far = T(0);   // to here, excluded, count
    T lo[depth_bins];
    T hi[depth_bins];  // below lo: an empty bin
    std::uint64_t counted = 0;
    std::uint64_t outside = 0;     // sky, and what lies before z_near or from z_far on
    std::uint64_t not_finite = 0;  // ignored as well
    Faults faults;                 // of the range
};

// No samples yet, of a view with this range of eye depth in metres: 0 <= z_near < z_far <= 1e18. Any other range is a
// fault, and nothing will lie in it.
template <class T>
[[nodiscard]] inline SampleDepths<T> no_depths(T const& z_near, T const& z_far) noexcept {
    SampleDepths<T> depths;
    for (int i = 0; i < depth_bins; ++i) {
        depths.lo[i] = std::numeric_limits<T>::max();
        depths.hi[i] = T(-1);
    }
    if (!all_finite(&z_near, 1) || !all_finite(&z_far, 1))
        depths.faults = Fault::not_finite;
    else if (!(z_near >= T(0)) || !(z_near < z_far) || !(z_far <= detail::farthest_metres<T>))
        depths.faults = Fault::empty_range;
    if (depths.faults.any()) return depths;
    depths.z_near = z_near;
    depths.z_far = z_far;
    return depths;
}

namespace detail {

// The bits of a positive float grow with it, evenly in each octave: exponent and 5 bits of mantissa are its bin. The
// sign is shifted out: -0 is not below a near distance of 0.
template <class T>
[[nodiscard]] inline int depth_key(T depth) noexcept {
    float const value = static_cast<float>(depth);
    std::uint32_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    return static_cast<int>((bits & 0x7fffffffu) >> 18);
}

// The sixteen octaves before z_far; what is nearer shares the first bin.
template <class T>
[[nodiscard]] inline int depth_bin(T z_far, T depth) noexcept {
    int const bin = depth_key(depth) - depth_key(z_far) + depth_bins - 1;
    return bin > 0 ? bin : 0;
}

}  // namespace detail

// Takes in one sample: its eye depth in metres. NaN and infinity are counted and ignored, depths outside the range too.
template <class T>
inline void add(SampleDepths<T>& depths, T const& depth) noexcept {
    if (!all_finite(&depth, 1)) {
        ++depths.not_finite;
        return;
    }
    if (!(depth >= depths.z_near && depth < depths.z_far)) {
        ++depths.outside;
        return;
    }
    ++depths.counted;
    int const bin = detail::depth_bin(depths.z_far, depth);
    depths.lo[bin] = depth < depths.lo[bin] ? depth : depths.lo[bin];
    depths.hi[bin] = depth > depths.hi[bin] ? depth : depths.hi[bin];
}

// Takes in all samples of another part of the same view. Order and grouping of parts never matter, not by a bit.
template <class T>
inline void add(SampleDepths<T>& depths, SampleDepths<T> const& part) noexcept {
    for (int i = 0; i < depth_bins; ++i) {
        depths.lo[i] = part.lo[i] < depths.lo[i] ? part.lo[i] : depths.lo[i];
        depths.hi[i] = part.hi[i] > depths.hi[i] ? part.hi[i] : depths.hi[i];
    }
    depths.counted += part.counted;
    depths.outside += part.outside;
    depths.not_finite += part.not_finite;
    depths.faults |= part.faults;
}

enum class SampleSplits : std::uint8_t { even, adaptive };

namespace detail {

// Where the splits start that a given ratio makes: the first at the first sample. At most `most` are made, and the last
// of them takes what is left.
template <class T>
struct Cover {
    T start[max_splits] = {};
    int count = 0;
    bool complete = false;  // the last one ends within the ratio
};

template <class T>
[[nodiscard]] inline T usable_ratio(T const& ratio) noexcept {
    if (!all_finite(&ratio, 1)) return T(1.05);
    return ratio < T(1.0001) ? T(1.0001) : (ratio > T(1 << 20) ? T(1 << 20) : ratio);
}

// A nearer first sample could need ratios beyond 2^20; it joins the first split as it is.
template <class T>
[[nodiscard]] inline T first_depth(T lo, T hi) noexcept {
    return lo > hi * T(0x1p-20) ? lo : hi * T(0x1p-20);
}

template <class T>
[[nodiscard]] inline Cover<T> even_cover(T first, T last, T ratio, int most) noexcept {
    Cover<T> cover;
    T start = first;
    for (; cover.count < most && (cover.count == 0 || start < last); start *= ratio) cover.start[cover.count++] = start;
    cover.complete = start >= last;
    return cover;
}

// Bins are not cut: a split holds a bin when its end lies within the ratio, and a bin of its own in any case.
template <class T>
[[nodiscard]] inline Cover<T> adaptive_cover(SampleDepths<T> const& depths, T first, T ratio, int most) noexcept {
    Cover<T> cover;
    T end = T(0);
    for (int i = 0; i < depth_bins; ++i) {
        if (!(depths.lo[i] <= depths.hi[i]) || (cover.count > 0 && depths.hi[i] <= end)) continue;
        if (cover.count == most) return cover;
        T const start = depths.lo[i] > first ? depths.lo[i] : first;
        cover.start[cover.count++] = start;
        end = start * ratio;
    }
    cover.complete = true;
    return cover;
}

}  // namespace detail

// Splits of [z_near, z_far] whose inner planes follow the samples: a split starts at the first sample that its
// forerunner does not hold. Outer planes stay where the view has them, since the maps are fitted to samples and gain
// nothing by it. As few as reach the last sample where each may be `least_ratio` deep (more than 1; 1.05 is sensible):
// a wall that faces the eye gets one. No sample, no split, and no fault.
//
// The ratio of the deepest split to its start is the least that `count` splits can have: of `even` splits of the whole
// interval, of `adaptive` ones to a bin, a 32nd of an octave. Samples nearer than 2^-20 of the last, for `even`, or
// 2^-16 of z_far, for `adaptive`, belong to the first split whatever its ratio.
template <class T>
[[nodiscard]] inline Splits<T> sample_splits(SampleDepths<T> const& depths, int count, SampleSplits kind,
                                             T least_ratio = T(1.05)) noexcept {
    Splits<T> splits;
    splits.faults = depths.faults;
    int const most = count < 0 ? 0 : (count > max_splits ? max_splits : count);
    if (most != count) splits.faults |= Fault::count_clamped;
    T const least = detail::usable_ratio(least_ratio);
    if (!all_finite(&least_ratio, 1) || least != least_ratio) splits.faults |= Fault::clamped_option;
    if (depths.counted == 0 || most == 0) return splits;

    T lo = depths.z_far, hi = depths.z_near;
    for (int i = 0; i < depth_bins; ++i) {
        lo = depths.lo[i] < lo ? depths.lo[i] : lo;
        hi = depths.hi[i] > hi ? depths.hi[i] : hi;
    }
    T const first = detail::first_depth(lo, hi);
    auto const cover = [&](T ratio) {
        return kind == SampleSplits::even ? detail::even_cover(first, hi, ratio, most)
                                          : detail::adaptive_cover(depths, first, ratio, most);
    };
    // The least number for which the cover is complete: completeness does not end as the ratio grows, for products are
    // rounded in order.
    T enough = least;
    if (!cover(least).complete) {
        T too_little = least;
        enough = T(1 << 20);
        for (T middle = T(0.5) * (too_little + enough); middle > too_little && middle < enough;
             middle = T(0.5) * (too_little + enough))
            (cover(middle).complete ? enough : too_little) = middle;
    }
    detail::Cover<T> const made = cover(enough);
    splits.count = made.count;
    for (int i = 1; i < made.count; ++i) splits.plane[i] = made.start[i];
    detail::close_splits(splits, depths.z_near, depths.z_far);
    return splits;
}

}  // namespace v0
}  // namespace shadowmath
