// SPDX-License-Identifier: MIT
//
// How deep a map of a slice must be. Textbook: the depths of the scene's eight corners, which is deeper than need be.
#include "bench/cases.hpp"
#include "bench/timed.hpp"

#include <shadowmath/depth_range.hpp>

#include <limits>

using namespace shadowmath;

static int const registered = [] {
    bench::Random random;
    Aabb<float> const town{glm::vec3(-120, 0, -120), glm::vec3(120, 30, 120)};
    LightBasis<float> const basis = light_basis(bench::sun);
    auto const boxes =
        bench::inputs([&] { return fit_box(basis, corners(bench::view_of(bench::some_camera(random))), 2048, 2.0f); });
    bench::time("depth_range/ours", boxes, [town](LightBox<float> const& sides) {
        return depth_range(sides, {sides.depth_lo, sides.depth_hi, true}, town, town, false);
    });
    bench::time("depth_range/textbook", boxes, [town](LightBox<float> const& sides) {
        glm::vec2 range(std::numeric_limits<float>::max(), std::numeric_limits<float>::lowest());
        for (glm::vec3 const& corner : corners(town)) {
            float const depth = glm::dot(sides.basis.depth, corner);
            range = glm::vec2(glm::min(range.x, depth), glm::max(range.y, depth));
        }
        return range;
    });
    return 0;
}();
