// SPDX-License-Identifier: MIT
//
// One matrix: the smallest box around what the eye sees, along the light. And the smallest rectangle, at any angle.
#include "examples/support/drawing.hpp"
#include "examples/support/example.hpp"
#include "examples/support/village.hpp"

#include <shadowmath/fit_rectangle.hpp>

namespace sm = shadowmath;

int main(int argc, char** argv) {
    sm::example::Proof proof(argc, argv);
    sm::Light<float> const sun = sm::directional(sm::example::afternoon_sun);
    sm::LightBasis<float> const basis = sm::light_basis(sun.direction);
    auto const corners = sm::corners(sm::example::village_view(60.0f));
    constexpr int map_size = 1024;
    sm::LightBox<float> const box = sm::fit_box(basis, corners, map_size, 2.0f);
    sm::LightBox<float> const least = sm::fit_rectangle(basis, sm::convex_body(corners), map_size, 2.0f);

    // Every corner of the view inside the map, two texels from its sides, whatever the API calls up, near and far.
    bool inside = true;
    for (sm::ClipSpace const clip : {sm::gl_clip, sm::vulkan_clip, sm::d3d_clip, sm::reversed(sm::vulkan_clip)})
        for (glm::vec3 const& corner : corners) {
            glm::vec4 const at = sm::clip_from_world(box, clip) * glm::vec4(corner, 1.0f);
            float const side = 1.0f - 2.0f * 2.0f / float(map_size) + 1e-5f;
            inside = inside && std::abs(at.x) <= side && std::abs(at.y) <= side && at.w == 1.0f;
        }
    proof.that(inside, "Each corner of the view is in the map, filter margin included, in every clip convention.");
    float const smaller = sm::area(least) / sm::area(box);
    std::printf("box %.0f m2, least rectangle %.0f m2: %.0f %%\n", sm::area(box), sm::area(least), 100 * smaller);
    proof.that(smaller <= 1.0f, "The least rectangle needs no more than the box.");

    // Seen from the light: metres across it.
    auto const seen = [&](glm::vec3 p) { return glm::dvec2(glm::dot(basis.x, p), glm::dot(basis.y, p)); };
    std::vector<glm::dvec2> rectangle;
    for (auto const& [x, y] : {std::pair{least.lo.x, least.lo.y},
                               {least.hi.x, least.lo.y},
                               {least.hi.x, least.hi.y},
                               {least.lo.x, least.hi.y}})
        rectangle.push_back(seen(least.basis.x * x + least.basis.y * y));
    sm::example::Drawing drawing("Seen from the light: the view, its box, its least rectangle",
                                 {box.lo.x - 4, box.lo.y - 14}, {box.hi.x + 4, box.hi.y + 34}, 620);
    drawing.box(box.lo, box.hi, "c0");
    drawing.area(rectangle, "c1");
    for (unsigned i = 0; i < 8; ++i)
        for (unsigned const bit : {1u, 2u, 4u})
            if ((i & bit) == 0) drawing.line(seen(corners[i]), seen(corners[i | bit]), "ink");
    drawing.label({box.lo.x, box.lo.y}, "fit_box", "start", {8, -8});
    drawing.label({0.5 * (box.lo.x + box.hi.x), box.hi.y}, "fit_rectangle", "middle", {60, -20});
    drawing.write(proof.folder() / "fit_box.svg");
    return proof.result();
}
