// SPDX-License-Identifier: MIT
//
// Light from four filtered moments of depth. Textbook: the Hamburger bound of Peters and Klein 2015 by a Cholesky
// factorisation, nothing checked.
#include "bench/cases.hpp"
#include "bench/timed.hpp"

#include <shadowmath/msm.hpp>

#include <cmath>

using namespace shadowmath;

namespace {

struct Kernel {
    glm::vec4 ours, textbook;
    float depth;
};

float hamburger(glm::vec4 const& moments, float x) {
    glm::vec4 const b = glm::mix(moments, glm::vec4(0.5f), 3e-5f);
    float const d22 = b.y - b.x * b.x, l32 = (b.z - b.x * b.y) / d22, d33 = b.w - b.y * b.y - l32 * l32 * d22;
    float c1 = x - b.x, c2 = x * x - b.y - l32 * c1;
    c2 /= d33;
    c1 = c1 / d22 - l32 * c2;
    float const c0 = 1.0f - c1 * b.x - c2 * b.y, half = 0.5f * c1 / c2, root = std::sqrt(half * half - c0 / c2);
    float const lower = -half - root, upper = -half + root;
    if (x <= lower) return 1.0f;
    bool const beyond = x > upper;
    float const from = beyond ? lower : x, other = beyond ? x : lower;
    float const share = (from * upper - b.x * (from + upper) + b.y) / ((upper - other) * (x - lower));
    return 1.0f - glm::clamp(beyond ? 1.0f + share : share, 0.0f, 1.0f);
}

int const registered = [] {
    bench::Random random;
    auto const kernels = bench::inputs([&] {
        float const a = random.between(0, 1), b = random.between(0, 1), a2 = a * a, b2 = b * b;
        return Kernel{(msm_moments(a) + msm_moments(b)) * 0.5f,
                      glm::vec4(a + b, a2 + b2, a * a2 + b * b2, a2 * a2 + b2 * b2) * 0.5f, random.between(0, 1)};
    });
    bench::time("msm/ours", kernels,
                [](Kernel const& k) { return msm_visibility(k.ours, k.depth, msm_bias_float<float>); });
    bench::time("msm/textbook", kernels, [](Kernel const& k) { return hamburger(k.textbook, k.depth); });
    return 0;
}();

}  // namespace
