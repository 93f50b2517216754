// SPDX-License-Identifier: MIT
//
// The smallest ball around a slice keeps its size when the camera turns; and how much smaller it is than the usual one.
#include "examples/support/drawing.hpp"
#include "examples/support/example.hpp"

#include <shadowmath/fit_sphere.hpp>
#include <shadowmath/slice.hpp>

#include <glm/geometric.hpp>

namespace sm = shadowmath;

int main(int argc, char** argv) {
    sm::example::Proof proof(argc, argv);
    auto const view_along = [](glm::vec3 forward) {
        sm::Pose<float> const pose = sm::pose_looking(glm::vec3(0.0f), forward, glm::vec3(0.0f, 1.0f, 0.0f));
        return sm::perspective_view(pose, 0.6f, 1.6f, 1.0f, 60.0f);
    };
    sm::Splits<float> const splits = sm::practical_splits(1.0f, 60.0f, 3, 0.7f);
    sm::example::Drawing drawing("Three slices, the ball of each, and (dashed) the ball around its centroid",
                                 {-10, -42}, {94, 42}, 680);
    bool holds = true, same = true;
    for (int i = 0; i < splits.count; ++i) {
        sm::ViewVolume<float> const slice = sm::slice(view_along({0, 0, -1}), sm::slice_range(splits, i));
        sm::Sphere<float> const ball = sm::bounding_sphere(slice);

        // What is usual: the middle of the eight corners, and the farthest of them.
        glm::vec3 middle(0.0f);
        for (glm::vec3 const& corner : sm::corners(slice)) middle += corner / 8.0f;
        float reach = 0.0f;
        for (glm::vec3 const& corner : sm::corners(slice)) {
            reach = std::max(reach, glm::distance(corner, middle));
            holds = holds && glm::distance(corner, ball.center) <= ball.radius * 1.000001f;
        }
        float const saved = 1.0f - ball.radius * ball.radius / (reach * reach);
        std::printf("slice %d: radius %.3f m, around the centroid %.3f m: %.0f %% of the map saved\n", i, ball.radius,
                    reach, 100 * saved);
        for (float const turn : {0.3f, 1.0f, 2.0f, 4.0f}) {
            auto const turned =
                sm::slice(view_along({std::sin(turn), 0.2f, std::cos(turn)}), sm::slice_range(splits, i));
            same = same && sm::bounding_sphere(turned).radius == ball.radius;
        }
        std::string const filled = "c" + std::to_string(i);
        drawing.circle({-ball.center.z, ball.center.x}, ball.radius, filled);
        drawing.circle({-middle.z, middle.x}, reach, "dash");
        std::vector<glm::dvec2> outline;
        for (unsigned const corner : {0u, 1u, 5u, 4u}) {
            glm::vec3 const p = sm::corners(slice)[corner];
            outline.emplace_back(-p.z, p.x);
        }
        drawing.area(outline, "ink");
    }
    drawing.dot({0, 0}, "d4", 4);
    drawing.write(proof.folder() / "fit_sphere.svg");
    proof.that(holds, "The ball contains every corner of the slice.");
    proof.that(same, "Its radius is the same to the last bit wherever the camera looks.");
    return proof.result();
}
