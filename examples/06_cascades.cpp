// SPDX-License-Identifier: MIT
//
// The one call: four stable cascades, drawn, read, and coloured by the map that serves each pixel.
#include "examples/support/example.hpp"
#include "examples/support/png.hpp"
#include "examples/support/raster.hpp"

#include <shadowmath/cascades.hpp>
#include <shadowmath/filter.hpp>
#include <shadowmath/sampling.hpp>

namespace sm = shadowmath;

int main(int argc, char** argv) {
    sm::example::Proof proof(argc, argv);
    auto const village = sm::example::village();
    auto const view = sm::example::village_view();
    auto const sun = sm::directional(sm::example::afternoon_sun);

    sm::CascadeOptions<float> options;
    options.map_size = 1024;
    options.shadow_distance = 100.0f;
    options.clip = sm::gl_zero_to_one_clip;
    auto const cascades = sm::fit_cascades(view, sun, village.casters, village.receivers, options);

    std::vector<sm::example::DepthMap> maps;
    std::vector<sm::MapBias<float>> biases;
    std::vector<sm::SliceRange<float>> ranges;
    for (sm::Cascade<float> const& cascade : cascades) {
        std::printf("%.2f m to %.2f m: texels of %.1f cm, %.0f m deep\n", cascade.range.begin, cascade.range.end,
                    100.0f * cascade.texel_metres, cascade.depth_metres);
        maps.push_back(sm::example::draw_depths(cascade.map, options.map_size, village.triangles));
        biases.push_back(sm::bias_for(cascade.map, sun, options.map_size, sm::BiasOptions<float>{}));
        ranges.push_back(cascade.range);
    }
    proof.that(!cascades.faults.any(), sm::describe(cascades.faults));

    int unserved = 0;
    auto const picture = sm::example::draw_picture(view, 720, 405, village.triangles, [&](auto const& seen) {
        auto const look_up = sm::by_depth(ranges.data(), cascades.count, seen.eye_depth);
        if (look_up.first < 0) return sm::example::sunlit(seen, sun.direction, 1.0f);
        auto const read = [&](int i) {
            auto const& drawn = maps[std::size_t(i)];
            unserved += !sm::contains(drawn.map, drawn.size, 1.0f, seen.point);
            return sm::visibility(drawn.map, drawn.size, seen.point, seen.normal, biases[std::size_t(i)], {}, drawn);
        };
        float const next = look_up.second < 0 ? 1.0f : read(look_up.second);
        glm::vec3 const tint[] = {{0.75f, 0.95f, 1.3f}, {1.3f, 0.95f, 0.7f}, {0.8f, 1.25f, 0.8f}, {1.15f, 0.8f, 1.3f}};
        glm::vec3 const lit = sm::example::sunlit(seen, sun.direction, sm::blended(look_up, read(look_up.first), next));
        return lit * tint[look_up.first];
    });
    proof.that(unserved == 0, "Every receiver in view is inside its map, filter margin included.");
    sm::example::write_png(proof.folder() / "cascades.png", picture);
    return proof.result();
}
