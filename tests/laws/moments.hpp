// SPDX-License-Identifier: MIT
//
// What a kernel may hold, and the truth about it: depths with weights that sum to 1.
#pragma once

#include <shadowmath/moments.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace shadowmath::laws {

struct Kernel {
    std::vector<double> depth, weight;

    template <class T>
    [[nodiscard]] double lit(T receiver) const {
        double share = 0;
        for (std::size_t i = 0; i < depth.size(); ++i)
            if (!(static_cast<T>(depth[i]) < receiver)) share += weight[i];
        return share;
    }

    template <class T, class Moments>
    [[nodiscard]] auto mean(Moments const& moments_of) const -> decltype(moments_of(T(0))) {
        decltype(moments_of(T(0))) sum(T(0));
        for (std::size_t i = 0; i < depth.size(); ++i)
            sum += moments_of(static_cast<T>(depth[i])) * static_cast<T>(weight[i]);
        return sum;
    }

    [[nodiscard]] double distance_to(double receiver) const {
        double nearest = 1;
        for (double const d : depth) nearest = std::min(nearest, std::abs(d - receiver));
        return nearest;
    }
};

template <class T>
[[nodiscard]] bool is_share_of_light(T visibility) {
    return all_finite(&visibility, 1) && visibility >= T(0) && visibility <= T(1);
}

// Not growing over 64 receivers from depth 0 to 1, but for `slack`.
template <class Visibility>
[[nodiscard]] bool never_grows(Visibility const& visibility_at, double slack) {
    double last = 1;
    for (int i = 0; i <= 64; ++i) {
        double const here = visibility_at(i / 64.0);
        if (!(here <= last + slack)) return false;
        last = here;
    }
    return true;
}

}  // namespace shadowmath::laws
