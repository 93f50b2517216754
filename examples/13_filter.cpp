// SPDX-License-Identifier: MIT
//
// Percentage-closer filtering: comparisons are filtered, never depths. Kernels of one texel, 3x3 and 9x9, four times
// enlarged.
#include "examples/support/example.hpp"
#include "examples/support/png.hpp"
#include "examples/support/raster.hpp"

#include <shadowmath/cascades.hpp>
#include <shadowmath/filter.hpp>

namespace sm = shadowmath;

int main(int argc, char** argv) {
    sm::example::Proof proof(argc, argv);
    auto const village = sm::example::village();
    auto const view = sm::example::village_view(30.0f);
    auto const sun = sm::directional(sm::example::afternoon_sun);
    sm::CascadeOptions<float> options;
    options.count = 1;
    options.filter_radius = 4;  // the fit leaves room for it
    options.clip = sm::gl_zero_to_one_clip;
    options.map_size = 900;
    sm::ShadowMap<float> const map = sm::fit_cascades(view, sun, village.casters, village.receivers, options).at[0].map;
    auto const drawn = sm::example::draw_depths(map, options.map_size, village.triangles);

    std::vector<sm::example::Picture> pictures;
    for (int const radius : {0, 1, 4}) {
        sm::BiasOptions<float> bias_options;
        bias_options.filter_radius = radius;
        auto const bias = sm::bias_for(map, sun, options.map_size, bias_options);
        bool share = true;
        int between = 0;
        auto const picture = sm::example::draw_picture(view, 480, 270, village.triangles, [&](auto const& seen) {
            float const lit =
                sm::visibility(map, options.map_size, seen.point, seen.normal, bias, {radius, true}, drawn);
            share = share && lit >= 0.0f && lit <= 1.0f;
            between += lit > 0.0f && lit < 1.0f;
            return sm::example::sunlit(seen, sun.direction, lit);
        });
        pictures.push_back(sm::example::enlarged(picture, 268, 30, 59, 75, 4));
        std::printf("radius %d: %d samples in half shadow\n", radius, between);
        proof.that(share, "Visibility is a share of light.");
        if (radius == 0) proof.that(between == 0, "A kernel of one texel is hard.");
    }
    // The weights of an axis sum to one wherever in its texel the point lies.
    float worst = 0.0f;
    for (float fraction = 0.0f; fraction < 1.0f; fraction += 0.01f) {
        float sum = 0.0f;
        for (int tap = -4; tap <= 4; ++tap) sum += sm::tap_weight(tap, 4, fraction);
        worst = std::max(worst, std::abs(sum - 1.0f));
    }
    proof.that(worst < 1e-6f, "Weights of an axis sum to one.");
    sm::example::write_png(proof.folder() / "filter.png", sm::example::beside(pictures));
    return proof.result();
}
