// SPDX-License-Identifier: MIT
//
// Bias in texels: how far a receiver must move toward the light so that no plane shadows itself. None on the left,
// bias_for in the middle, ten times too much on the right.
#include "examples/support/example.hpp"
#include "examples/support/png.hpp"
#include "examples/support/raster.hpp"

#include <shadowmath/cascades.hpp>
#include <shadowmath/filter.hpp>

namespace sm = shadowmath;

int main(int argc, char** argv) {
    sm::example::Proof proof(argc, argv);
    auto const village = sm::example::village();
    auto view = sm::example::village_view(40.0f);
    view.left *= 0.42f, view.right *= 0.42f;  // a slimmer picture of the same height
    auto const sun = sm::directional(glm::vec3(-0.75f, -0.42f, -0.35f));
    sm::CascadeOptions<float> options;
    options.count = 1;
    options.map_size = 512;
    options.clip = sm::gl_zero_to_one_clip;
    auto const cascades = sm::fit_cascades(view, sun, village.casters, village.receivers, options);
    sm::ShadowMap<float> const& map = cascades.at[0].map;
    auto const drawn = sm::example::draw_depths(map, options.map_size, village.triangles);
    auto const meadow = sm::example::draw_depths(map, options.map_size, std::span(village.triangles).last(6));

    std::vector<sm::example::Picture> pictures;
    sm::MapBias<float> const right = sm::bias_for(map, sun, options.map_size, sm::BiasOptions<float>{});
    sm::BiasOptions<float> far_too_much;
    far_too_much.flat_texels = 7.5f;
    far_too_much.texels = 10.0f;
    int self_shadowed[3] = {};
    for (int i = 0; i < 3; ++i) {
        sm::MapBias<float> const bias = i == 0   ? sm::MapBias<float>{}
                                        : i == 1 ? right
                                                 : sm::bias_for(map, sun, options.map_size, far_too_much);
        sm::FilterOptions const filter{1, i > 0};
        pictures.push_back(sm::example::draw_picture(view, 236, 300, village.triangles, [&](auto const& seen) {
            // The meadow alone, which nothing stands on here, must be lit all over.
            self_shadowed[i] +=
                seen.point.y < 0.01f && seen.normal.y > 0.9f && seen.eye_depth < 40.0f &&
                sm::visibility(map, options.map_size, seen.point, seen.normal, bias, filter, meadow) < 1.0f;
            float const lit = seen.eye_depth < 40.0f
                                  ? sm::visibility(map, options.map_size, seen.point, seen.normal, bias, filter, drawn)
                                  : 1.0f;
            return sm::example::sunlit(seen, sun.direction, lit);
        }));
    }
    std::printf("self-shadowed samples of a bare meadow: %d without bias, %d with bias_for\n", self_shadowed[0],
                self_shadowed[1]);
    proof.that(self_shadowed[0] > 0, "Without a bias, a lit plane shadows itself.");
    proof.that(self_shadowed[1] == 0, "With bias_for, no lit plane shadows itself.");
    sm::example::write_png(proof.folder() / "bias.png", sm::example::beside(pictures));
    return proof.result();
}
