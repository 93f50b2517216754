// SPDX-License-Identifier: MIT
//
// Exact hard shadows on the CPU: an irregular z-buffer, 32 samples a pixel, no texels and no bias. A map of 512 texels
// on the left, the exact answer on the right, three times enlarged.
#include "examples/support/example.hpp"
#include "examples/support/png.hpp"
#include "examples/support/raster.hpp"

#include <shadowmath/cascades.hpp>
#include <shadowmath/filter.hpp>
#include <shadowmath/irregular.hpp>

#include <bit>

namespace sm = shadowmath;

int main(int argc, char** argv) {
    sm::example::Proof proof(argc, argv);
    auto const village = sm::example::village();
    auto const view = sm::example::village_view(40.0f);
    auto const sun = sm::directional(sm::example::afternoon_sun);
    constexpr int width = 480, height = 270;
    sm::CascadeOptions<float> const options{.count = 1, .map_size = 512, .clip = sm::gl_zero_to_one_clip};
    sm::ShadowMap<float> const map = sm::fit_cascades(view, sun, village.casters, village.receivers, options).at[0].map;

    // What the eye sees, and what casts, as they lie in memory.
    auto const seen = sm::example::surfaces_of(view, width, height, village.triangles);
    constexpr int stride = sizeof(sm::example::Surface) / sizeof(float);
    sm::Receivers<float> const receivers{&seen[0].point.x, stride, nullptr, &seen[0].normal.x, stride};
    std::vector<glm::vec3> vertices;
    for (auto const& t : village.triangles) vertices.insert(vertices.end(), t.at.begin(), t.at.end());
    auto const vertex_count = std::uint32_t(vertices.size());
    sm::Casters<float> const casters{&vertices[0].x, 3, vertex_count, nullptr, vertex_count / 3};

    sm::StorageSize const size = sm::storage_for(width, height, 128);
    std::vector<float> scalars(size.scalars);
    std::vector<std::uint32_t> words(size.words), masks(seen.size());
    auto buffer = sm::list_receivers(sm::pixel_frame(view, width, height), receivers, sun, map, 128,
                                     sm::Storage<float>{scalars.data(), words.data(), size});
    sm::trace(buffer, casters);
    sm::write_masks(buffer, masks.data());
    proof.that(!buffer.faults.any(), sm::describe(buffer.faults));

    auto const drawn = sm::example::draw_depths(map, options.map_size, village.triangles);
    auto const bias = sm::bias_for(map, sun, options.map_size, sm::BiasOptions<float>{});
    sm::example::Picture by_map({width, height}), exactly({width, height});
    int partly = 0, apart = 0;
    for (std::size_t i = 0; i < seen.size(); ++i) {
        float const exact = 1.0f - float(std::popcount(masks[i])) / 32.0f;
        float const lit = sm::visibility(map, options.map_size, seen[i].point, seen[i].normal, bias, {1, true}, drawn);
        partly += exact > 0.0f && exact < 1.0f;
        apart += std::abs(exact - lit) > 0.5f;
        by_map.pixels[i] = sm::example::encoded(sm::example::sunlit(seen[i], sun.direction, lit));
        exactly.pixels[i] = sm::example::encoded(sm::example::sunlit(seen[i], sun.direction, exact));
    }
    std::printf("%d pixels lie on a shadow's edge; the map decides %d pixels otherwise\n", partly, apart);
    proof.that(partly > 100 && apart < int(seen.size()) / 20, "The map and the exact answer agree but along edges.");
    sm::example::Picture const pictures[] = {sm::example::enlarged(by_map, 230, 30, 119, 100, 3),
                                             sm::example::enlarged(exactly, 230, 30, 119, 100, 3)};
    sm::example::write_png(proof.folder() / "irregular.png", sm::example::beside(pictures));
    return proof.result();
}
