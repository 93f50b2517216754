// SPDX-License-Identifier: MIT
//
// How deep a map must be: from the first caster that can shadow anything between its sides to the last receiver.
#include "examples/support/drawing.hpp"
#include "examples/support/example.hpp"

#include <shadowmath/depth_range.hpp>

namespace sm = shadowmath;

int main(int argc, char** argv) {
    sm::example::Proof proof(argc, argv);
    // Light from straight above; a map of 20 m by 20 m.
    sm::LightBox<float> sides;
    sides.basis = sm::light_basis(glm::vec3(0.0f, -1.0f, 0.0f));
    sides.lo = glm::vec2(-10.0f);
    sides.hi = glm::vec2(10.0f);
    sm::DepthRange<float> const slice{-8.0f, 0.0f, true};  // metres along the light: from 8 m above the ground
    sm::Aabb<float> const ground{glm::vec3(-30.0f, -1.0f, -30.0f), glm::vec3(30.0f, 0.0f, 30.0f)};

    struct Caster {
        char const* name;
        sm::Aabb<float> box;
    } const casters[] = {{"tower", {glm::vec3(2.0f, 0.0f, -2.0f), glm::vec3(5.0f, 21.0f, 2.0f)}},
                         {"beside", {glm::vec3(-26.0f, 0.0f, -4.0f), glm::vec3(-18.0f, 30.0f, 4.0f)}},
                         {"low wall", {glm::vec3(-7.0f, 0.0f, -4.0f), glm::vec3(-6.0f, 3.0f, 4.0f)}}};
    sm::DepthRange<float> ranges[3];
    for (int i = 0; i < 3; ++i) {
        ranges[i] = sm::depth_range(sides, slice, casters[i].box, ground, false);
        std::printf("%-9s %s, depth %.2f to %.2f m along the light\n", casters[i].name,
                    ranges[i].visible ? "casts into the map" : "casts nothing here", ranges[i].lo, ranges[i].hi);
    }
    sm::DepthRange<float> const pancaked = sm::depth_range(sides, slice, casters[0].box, ground, true);
    proof.that(std::abs(ranges[0].lo + 21.0f) < 0.01f, "The range begins at the top of the caster above the map.");
    proof.that(!ranges[1].visible, "A caster beside the sides counts for nothing.");
    proof.that(pancaked.lo > -0.01f, "Pancaked, it begins with the first receiver: the caster is drawn flat.");

    sm::example::Drawing drawing("The shaft of a map, and what is in it", {-32, -3}, {32, 33}, 680);
    drawing.box({-10, 0}, {10, 21}, "c0");
    drawing.box({-32, -1}, {32, 0}, "ground");
    for (Caster const& caster : casters) {
        drawing.box(caster.box.lo, caster.box.hi, "caster");
        drawing.label({0.5 * (caster.box.lo.x + caster.box.hi.x), caster.box.hi.y}, caster.name, "middle", {0, -6},
                      "small");
    }
    for (double const x : {-10.0, 10.0}) drawing.line({x, -2}, {x, 31}, "dash");
    for (double x = -9; x < 10; x += 3) drawing.line({x, 31}, {x, 27}, "light");
    drawing.label({10, 21}, "lo: the first caster", "start", {8, 4});
    drawing.label({10, 0}, "hi: the last receiver", "start", {8, -6});
    drawing.write(proof.folder() / "depth_range.svg");
    return proof.result();
}
