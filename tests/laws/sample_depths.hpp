// SPDX-License-Identifier: MIT
//
// Laws of splits that follow samples: order does not matter, everything is held, and no placing is better.
#pragma once

#include <shadowmath/sample_depths.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace shadowmath::laws {

template <class T>
[[nodiscard]] SampleDepths<T> depths_of(std::vector<T> const& samples, T z_near, T z_far) {
    SampleDepths<T> depths = no_depths(z_near, z_far);
    for (T const sample : samples) add(depths, sample);
    return depths;
}

template <class T>
[[nodiscard]] bool same(SampleDepths<T> const& a, SampleDepths<T> const& b) {
    return std::equal(std::begin(a.lo), std::end(a.lo), std::begin(b.lo)) &&
           std::equal(std::begin(a.hi), std::end(a.hi), std::begin(b.hi)) && a.counted == b.counted &&
           a.outside == b.outside && a.not_finite == b.not_finite && a.faults == b.faults;
}

// Bins hold later depths than the bins before them, and each sample is within its bin's ends.
template <class T>
[[nodiscard]] bool is_in_order(SampleDepths<T> const& depths) {
    T last = T(-1);
    for (int i = 0; i < depth_bins; ++i) {
        if (!(depths.lo[i] <= depths.hi[i])) continue;
        if (!(depths.lo[i] > last) || depths.lo[i] < depths.z_near || !(depths.hi[i] < depths.z_far)) return false;
        last = depths.hi[i];
    }
    return true;
}

// z_near = plane[0] < plane[1] < ... = z_far, or no split without a sample or with a fault.
template <class T>
[[nodiscard]] bool is_ordered(Splits<T> const& splits, SampleDepths<T> const& depths, int asked) {
    if (splits.count == 0) return depths.counted == 0 || asked <= 0;
    if (splits.count < 0 || splits.count > asked || splits.count > max_splits) return false;
    if (splits.plane[0] != depths.z_near || splits.plane[splits.count] != depths.z_far) return false;
    for (int i = 0; i < splits.count; ++i)
        if (!(splits.plane[i] < splits.plane[i + 1])) return false;
    return true;
}

// Last sample over first sample of the deepest split; 1 where no split has two samples. Samples before `first` count as
// there. `samples` ascending, all in range.
template <class T>
[[nodiscard]] long double worst_ratio(Splits<T> const& splits, std::vector<T> const& samples, T first) {
    long double worst = 1;
    for (int i = 0; i < splits.count; ++i) {
        auto const begin = std::lower_bound(samples.begin(), samples.end(), splits.plane[i]);
        auto const end = std::lower_bound(samples.begin(), samples.end(), splits.plane[i + 1]);
        if (begin != end) {
            long double const nearest = std::max(*begin, first);
            worst = std::fmax(worst, static_cast<long double>(*(end - 1)) / nearest);
        }
    }
    return worst;
}

// The least worst ratio with which `count` splits can hold the samples, found by trying every sample as the end of the
// first one, and so on: the oracle of the greedy cover. For few samples.
template <class T>
[[nodiscard]] long double least_worst_ratio(std::vector<T> const& samples, int count) {
    std::size_t const n = samples.size();
    // best[i]: of the samples from i on, with as many splits as rounds have passed.
    std::vector<long double> best(n + 1, HUGE_VALL);
    best[n] = 1;
    for (int round = 0; round < count; ++round)
        for (std::size_t i = 0; i < n; ++i)
            for (std::size_t j = i; j < n; ++j) {
                long double const here = static_cast<long double>(samples[j]) / static_cast<long double>(samples[i]);
                best[i] = std::fmin(best[i], std::fmax(here, best[j + 1]));
            }
    return best[0];
}

}  // namespace shadowmath::laws
