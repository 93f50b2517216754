// SPDX-License-Identifier: MIT
//
// Region, crop and atlas tile are one thing: a matrix on the left. Four cascades share an atlas.
#include "examples/support/example.hpp"
#include "examples/support/png.hpp"
#include "examples/support/raster.hpp"

#include <shadowmath/cascades.hpp>

namespace sm = shadowmath;

int main(int argc, char** argv) {
    sm::example::Proof proof(argc, argv);
    auto const village = sm::example::village();
    sm::CascadeOptions<float> options;
    options.map_size = 280;
    options.shadow_distance = 100.0f;
    options.clip = sm::gl_zero_to_one_clip;
    auto const cascades = sm::fit_cascades(sm::example::village_view(), sm::directional(sm::example::afternoon_sun),
                                           village.casters, village.receivers, options);

    int const side = 2 * options.map_size;
    sm::example::DepthMap atlas{{}, side, std::vector<float>(std::size_t(side) * std::size_t(side), 1.0f)};
    bool same = true, beside = true;
    for (int i = 0; i < cascades.count; ++i) {
        sm::ShadowMap<float> const& map = cascades.at[i].map;
        sm::Tile const tile{i % 2 * options.map_size, i / 2 * options.map_size, options.map_size, side, side};
        // Casters are drawn with the plain matrix, into the tile as the viewport.
        auto const drawn = sm::example::draw_depths(map, options.map_size, village.triangles);
        for (int y = 0; y < tile.size; ++y)
            for (int x = 0; x < tile.size; ++x)
                atlas.depth[std::size_t((tile.y + y) * side + tile.x + x)] = drawn(x, y);

        // Receivers are looked up with the tile's matrix on the left.
        glm::mat4 const in_tile = sm::tile_matrix<float>(tile, options.clip) * map.clip_from_world;
        for (auto const& triangle : village.triangles) {
            glm::vec4 const alone = map.clip_from_world * glm::vec4(triangle.at[0], 1.0f);
            glm::vec4 const shared = in_tile * glm::vec4(triangle.at[0], 1.0f);
            glm::vec2 const texel = (glm::vec2(alone) * 0.5f + 0.5f) * float(tile.size) + glm::vec2(tile.x, tile.y);
            glm::vec2 const found = (glm::vec2(shared) * 0.5f + 0.5f) * float(side);
            same = same && std::abs(texel.x - found.x) < 0.01f && std::abs(texel.y - found.y) < 0.01f;
            same = same && alone.z == shared.z && alone.w == shared.w;
        }
    }
    // A tile that does not lie in its atlas is no tile, and says so.
    sm::Tile const outside{side - 10, 0, options.map_size, side, side};
    beside = sm::faults_of(outside).has(sm::Fault::bad_region) && sm::tile_matrix<float>(outside) == glm::mat4(1.0f);
    proof.that(same, "A texel of the map is the same texel of its tile; depth and w are left alone.");
    proof.that(beside, "A tile outside its atlas is a bad region and the identity.");
    sm::example::write_png(proof.folder() / "region.png", sm::example::picture_of(atlas));
    return proof.result();
}
