// SPDX-License-Identifier: MIT
//
// Kernels of one to six depths: anywhere, in quarters so that some coincide, or close together.
#pragma once

#include "gen.hpp"
#include "tests/laws/moments.hpp"

#include <cmath>

namespace shadowmath::laws {

inline void showValue(Kernel const& kernel, std::ostream& out) {
    for (std::size_t i = 0; i < kernel.depth.size(); ++i) out << kernel.depth[i] << " x " << kernel.weight[i] << "  ";
}

}  // namespace shadowmath::laws

namespace shadowmath::test {

inline rc::Gen<laws::Kernel> kernel(std::uint64_t most_depths) {
    return rc::gen::exec([=] {
        laws::Kernel drawn;
        std::uint64_t const count = 1 + *below(most_depths), kind = *below(3);
        double const middle = *uniform<double>(0.1, 0.9);
        double sum = 0;
        for (std::uint64_t i = 0; i < count; ++i) {
            double const depth = *uniform<double>(0.0, 1.0);
            double const weight = *uniform<double>(0.01, 1.0);
            drawn.depth.push_back(kind == 0   ? depth
                                  : kind == 1 ? std::round(depth * 4) / 4
                                              : middle + (depth - 0.5) * 0.01);
            drawn.weight.push_back(weight);
            sum += weight;
        }
        for (double& weight : drawn.weight) weight /= sum;
        return drawn;
    });
}

}  // namespace shadowmath::test
