// SPDX-License-Identifier: MIT
//
// One map, warped: texels small near the eye, large far away. The squares are eight texels wide; uniform on the left,
// the warp of least aliasing on the right.
#include "examples/support/example.hpp"
#include "examples/support/png.hpp"
#include "examples/support/raster.hpp"

#include <shadowmath/footprint.hpp>
#include <shadowmath/warp.hpp>

#include <cmath>

namespace sm = shadowmath;

int main(int argc, char** argv) {
    sm::example::Proof proof(argc, argv);
    auto const village = sm::example::village();
    auto const view = sm::example::village_view(100.0f);
    auto const sun = sm::directional(glm::vec3(-0.5f, -0.8f, 0.1f));
    glm::mat4 const eye = sm::clip_from_world(view, sm::ClipSpace{});

    std::vector<sm::example::Picture> pictures;
    double worst[2] = {};
    bool in_front = true;
    for (float const strength : {0.0f, 1.0f}) {
        sm::WarpOptions<float> options;
        options.map_size = 1024;
        options.strength = strength;
        auto const map =
            sm::simple_perspective_map(view, sun, village.casters, village.receivers, options, sm::gl_zero_to_one_clip);
        double& most = worst[strength > 0.0f ? 1 : 0];
        pictures.push_back(sm::example::draw_picture(view, 357, 260, village.triangles, [&](auto const& seen) {
            glm::vec4 const at = map.clip_from_world * glm::vec4(seen.point, 1.0f);
            glm::vec2 const texel = (glm::vec2(at) / at.w * 0.5f + 0.5f) * float(options.map_size);
            bool const odd = (int(std::floor(texel.x / 8.0f)) + int(std::floor(texel.y / 8.0f))) % 2 != 0;
            if (seen.normal.y > 0.99f && seen.eye_depth < 100.0f) {
                in_front = in_front && at.w > map.w_min;
                most = std::max(most, double(sm::footprint(eye, glm::vec2(714.0f, 520.0f), map.clip_from_world,
                                                           float(options.map_size), seen.point, seen.normal)
                                                 .major));
            }
            auto plain = seen;
            plain.colour = seen.colour * (odd ? 0.55f : 1.3f);
            return sm::example::sunlit(plain, sun.direction, 0.8f);
        }));
        std::printf("strength %.0f: at worst %.1f eye pixels a texel on the meadow\n", strength, most);
    }
    // Strength 0 is the uniform map itself: w = 1 everywhere, to the bit.
    sm::WarpOptions<float> none;
    none.strength = 0.0f;
    auto const uniform = sm::simple_perspective_map(view, sun, village.casters, village.receivers, none, sm::gl_clip);
    proof.that(sm::row(uniform.clip_from_world, 3) == glm::vec4(0.0f, 0.0f, 0.0f, 1.0f),
               "At strength zero it is the uniform map.");
    proof.that(in_front, "Every receiver in view is in front of the warp's centre.");
    proof.that(worst[1] < 0.5 * worst[0], "The warp halves the worst texel of this view, and more.");
    sm::example::write_png(proof.folder() / "warp.png", sm::example::beside(pictures));
    return proof.result();
}
