// SPDX-License-Identifier: MIT
//
// Soft shadows from one ordinary map: sharp where the post meets the ground, wide where its top casts. The real sun,
// one four times as wide, and one sixteen times.
#include "examples/support/example.hpp"
#include "examples/support/png.hpp"
#include "examples/support/raster.hpp"

#include <shadowmath/cascades.hpp>
#include <shadowmath/pcss.hpp>

namespace sm = shadowmath;

int main(int argc, char** argv) {
    sm::example::Proof proof(argc, argv);
    auto const village = sm::example::village();
    auto view = sm::example::village_view(30.0f);
    view.left = -0.28f, view.right = 0.28f, view.bottom = -0.42f, view.top = 0.28f;
    auto const sun = sm::directional(glm::vec3(-0.6f, -0.38f, 0.25f));
    sm::CascadeOptions<float> options;
    options.count = 1;
    options.map_size = 2048;
    options.clip = sm::gl_zero_to_one_clip;
    sm::ShadowMap<float> const map = sm::fit_cascades(view, sun, village.casters, village.receivers, options).at[0].map;
    auto const drawn = sm::example::draw_depths(map, options.map_size, village.triangles);
    auto const bias = sm::bias_for(map, sun, options.map_size, sm::BiasOptions<float>{});

    std::vector<sm::example::Picture> pictures;
    int half_dark[3] = {};
    for (int i = 0; i < 3; ++i) {
        float const radius = sm::sun_radius(sm::sun_angular_radius_radians<float> * float(1 << (2 * i)));
        auto const penumbra = sm::penumbra_for(map, sun, radius);
        sm::PcssOptions<float> taps;
        taps.search_taps = taps.filter_taps = 64;
        pictures.push_back(sm::example::draw_picture(view, 236, 295, village.triangles, [&](auto const& seen) {
            auto const soft =
                sm::soft_visibility(map, options.map_size, seen.point, seen.normal, bias, penumbra, taps, drawn);
            half_dark[i] += soft.visibility > 0.0f && soft.visibility < 1.0f;
            return sm::example::sunlit(seen, sun.direction, soft.visibility);
        }));
        std::printf(
            "angular radius %.2f degrees: a penumbra of %.1f cm for each metre to the occluder, %d samples in it\n",
            57.29578f * std::atan(radius), 100.0f * sm::penumbra_metres(radius, 1.0f), half_dark[i]);
    }
    proof.that(half_dark[0] < half_dark[1] && half_dark[1] < half_dark[2], "A wider light has wider penumbrae.");
    proof.that(std::abs(sm::penumbra_metres(sm::sun_radius(0.00465f), 1.0f) - 0.0093f) < 1e-5f,
               "Of the real sun it is a centimetre for each metre.");
    sm::example::write_png(proof.folder() / "pcss.png", sm::example::beside(pictures));
    return proof.result();
}
