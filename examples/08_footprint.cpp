// SPDX-License-Identifier: MIT
//
// The one number: how many eye pixels a texel covers. One map beside four, the same village, blue where a texel is
// finer than a pixel and red where it is sixteen of them long.
#include "examples/support/example.hpp"
#include "examples/support/png.hpp"
#include "examples/support/raster.hpp"

#include <shadowmath/cascades.hpp>
#include <shadowmath/footprint.hpp>

#include <cmath>

namespace sm = shadowmath;

int main(int argc, char** argv) {
    sm::example::Proof proof(argc, argv);
    auto const village = sm::example::village();
    auto const view = sm::example::village_view();
    auto const sun = sm::directional(sm::example::afternoon_sun);
    glm::vec2 const eye_pixels(1920.0f, 1080.0f);
    glm::mat4 const eye = sm::clip_from_world(view, sm::ClipSpace{});

    std::vector<sm::example::Picture> pictures;
    double mean[2] = {};
    for (int const count : {1, 4}) {
        sm::CascadeOptions<float> options;
        options.count = count;
        options.map_size = 4096 / (count == 4 ? 2 : 1);  // as many texels in all
        options.shadow_distance = 100.0f;
        auto const cascades = sm::fit_cascades(view, sun, village.casters, village.receivers, options);
        double sum = 0.0, points = 0.0;
        pictures.push_back(sm::example::draw_picture(view, 357, 300, village.triangles, [&](auto const& seen) {
            int map = 0;
            while (map + 1 < cascades.count && seen.eye_depth >= cascades.at[map].range.end) ++map;
            sm::Footprint<float> const texel = sm::footprint(eye, eye_pixels, cascades.at[map].map.clip_from_world,
                                                             float(options.map_size), seen.point, seen.normal);
            bool const faces_light = glm::dot(seen.normal, sun.direction) < -0.05f;
            float const shade = 0.5f + 0.5f * std::abs(seen.normal.y);
            if (!faces_light || seen.eye_depth > 100.0f) return glm::vec3(0.25f) * shade;
            sum += double(texel.major);
            points += 1.0;
            return sm::example::heat(std::log2(texel.major) / 4.0f) * shade;
        }));
        mean[count / 4] = sum / points;
        std::printf("%d map%s of %d texels a side: %.2f eye pixels a texel in the mean\n", count, count > 1 ? "s" : "",
                    options.map_size, mean[count / 4]);
    }
    proof.that(mean[1] < 0.5 * mean[0], "Four cascades cover less than half as many pixels a texel as one map.");
    // The eye's own picture as the map: one pixel a texel.
    sm::Footprint<float> const own =
        sm::footprint(eye, glm::vec2(1024.0f), eye, 1024.0f, glm::vec3(1.0f, 0.0f, -9.0f), glm::vec3(0.0f, 1.0f, 0.0f));
    proof.that(std::abs(own.major - 1.0f) < 1e-3f && std::abs(own.minor - 1.0f) < 1e-3f,
               "Of the eye's own picture it is one pixel.");
    sm::example::write_png(proof.folder() / "footprint.png", sm::example::beside(pictures));
    return proof.result();
}
