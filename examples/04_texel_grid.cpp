// SPDX-License-Identifier: MIT
//
// Why shadows stand still: a world point keeps its place within a texel while the camera walks and turns. With a tight
// box it does not.
#include "examples/support/drawing.hpp"
#include "examples/support/example.hpp"
#include "examples/support/village.hpp"

#include <shadowmath/fit_box.hpp>
#include <shadowmath/fit_sphere.hpp>
#include <shadowmath/texel_grid.hpp>

namespace sm = shadowmath;

int main(int argc, char** argv) {
    sm::example::Proof proof(argc, argv);
    constexpr int map_size = 1024, frames = 120;
    constexpr double margin_texels = 2.0;
    glm::dvec3 const point(3.0, 1.0, -20.0);
    sm::LightBasis<double> const basis = sm::light_basis(glm::normalize(glm::dvec3(-0.55, -0.6, -0.42)));
    // Where in its texel the point lies, across the map: 0 to 1.
    auto const place = [&](glm::dmat4 const& clip_from_world) {
        double const texels = (clip_from_world * glm::dvec4(point, 1.0)).x * map_size / 2.0;
        return texels - std::floor(texels);
    };

    std::vector<glm::dvec2> still, crawling;
    double least = 1.0, most = 0.0;
    for (int frame = 0; frame < frames; ++frame) {
        double const t = double(frame) / frames;
        sm::Pose<double> const pose = sm::pose_looking(glm::dvec3(2.0 * t, 1.7, 4.0 - 6.0 * t),
                                                       glm::dvec3(0.4 * t, -0.1, -1.0), glm::dvec3(0, 1, 0));
        sm::ViewVolume<double> const view = sm::perspective_view(pose, 0.95, 16.0 / 9.0, 0.5, 60.0);
        sm::TexelGrid<double> const grid = sm::texel_grid(basis, sm::bounding_sphere(view), map_size, margin_texels);
        sm::LightBox<double> const box = sm::fit_box(basis, sm::corners(view), map_size, margin_texels);
        double const on_grid = place(sm::clip_from_world(grid, 0.0, 100.0, sm::gl_clip));
        least = std::min(least, on_grid);
        most = std::max(most, on_grid);
        still.emplace_back(frame, on_grid);
        crawling.emplace_back(frame, place(sm::clip_from_world(box, sm::gl_clip)));
    }
    std::printf("moves by %.2g texels in %d frames\n", most - least, frames);
    proof.that(most - least <= 1.0 / 64.0, "A world point keeps its place within a texel to 1/64 of a texel.");

    sm::example::Drawing drawing("Where in its texel one world point lies, frame by frame", {-4, -0.12}, {124, 1.15},
                                 720, 300);
    drawing.line({0, 0}, {frames, 0}, "faint");
    drawing.line({0, 1}, {frames, 1}, "faint");
    for (glm::dvec2 const at : crawling) drawing.dot(at, "d1", 2.2);
    drawing.path(still, "s0");
    drawing.label({0, 1}, "1 texel", "start", {0, -5}, "small");
    drawing.label({frames, still.back().y}, "stable: sphere on the texel grid", "end", {0, -8});
    drawing.label({frames, 1}, "dots: the tight box, which crawls", "end", {0, -5});
    drawing.write(proof.folder() / "texel_grid.svg");
    return proof.result();
}
