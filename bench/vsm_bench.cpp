// SPDX-License-Identifier: MIT
//
// Light from filtered moments of depth. Textbook: Chebyshev's bound as in Donnelly and Lauritzen 2006, nothing checked.
#include "bench/cases.hpp"
#include "bench/timed.hpp"

#include <shadowmath/vsm.hpp>

using namespace shadowmath;

static int const registered = [] {
    bench::Random random;
    auto const kernels = bench::inputs([&] {
        float const a = random.between(0, 1), b = random.between(0, 1);
        return glm::vec3((a + b) / 2.0f, (a * a + b * b) / 2.0f, random.between(0, 1));
    });
    bench::time("vsm/ours", kernels, [](glm::vec3 const& k) { return vsm_visibility(glm::vec2(k), k.z, 3e-4f); });
    bench::time("vsm/textbook", kernels, [](glm::vec3 const& k) {
        float const variance = glm::max(k.y - k.x * k.x, 1e-7f), d = k.z - k.x;
        return k.z <= k.x ? 1.0f : variance / (variance + d * d);
    });
    return 0;
}();
