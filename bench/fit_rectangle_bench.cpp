// SPDX-License-Identifier: MIT
//
// The smallest rectangle across the light around a slice. Textbook: the best of ninety angles.
#include "bench/cases.hpp"
#include "bench/timed.hpp"

#include <shadowmath/fit_rectangle.hpp>

#include <cmath>
#include <limits>

using namespace shadowmath;

static int const registered = [] {
    bench::Random random;
    auto const bodies = bench::inputs([&] { return corners(bench::view_of(bench::some_camera(random))); });
    LightBasis<float> const basis = light_basis(bench::sun);
    bench::time("fit_rectangle/ours", bodies, [basis](std::array<glm::vec3, 8> const& body) {
        return fit_rectangle(basis, convex_body(body), 2048, 2.0f);
    });
    bench::time("fit_rectangle/textbook", bodies, [basis](std::array<glm::vec3, 8> const& body) {
        float best = std::numeric_limits<float>::max(), angle = 0.0f;
        for (int degrees = 0; degrees < 90; ++degrees) {
            float const turn = glm::radians(static_cast<float>(degrees));
            glm::vec3 const x = basis.x * std::cos(turn) + basis.y * std::sin(turn), y = glm::cross(basis.depth, x);
            glm::vec2 lo(std::numeric_limits<float>::max()), hi(std::numeric_limits<float>::lowest());
            for (glm::vec3 const& corner : body) {
                glm::vec2 const at(glm::dot(x, corner), glm::dot(y, corner));
                lo = glm::min(lo, at), hi = glm::max(hi, at);
            }
            float const area = (hi.x - lo.x) * (hi.y - lo.y);
            if (area < best) best = area, angle = turn;
        }
        return angle;
    });
    return 0;
}();
