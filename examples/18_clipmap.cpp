// SPDX-License-Identifier: MIT
//
// A virtual shadow map without its page table: concentric still windows, and the pages that the picture asks for.
#include "examples/support/drawing.hpp"
#include "examples/support/example.hpp"
#include "examples/support/raster.hpp"

#include <shadowmath/clipmap.hpp>

#include <map>
#include <tuple>

namespace sm = shadowmath;

int main(int argc, char** argv) {
    sm::example::Proof proof(argc, argv);
    auto const village = sm::example::village();
    auto const view = sm::example::village_view();
    auto const sun = sm::directional(sm::example::afternoon_sun);

    sm::ClipmapOptions<float> options;
    options.levels = 6;
    options.map_size = 2048;
    options.finest_metres = 1.0f / 128.0f;
    auto const windows = sm::clipmap(sm::light_basis(sun.direction), view.pose.position, options);

    constexpr int width = 960, height = 540;
    std::map<std::tuple<int, std::int64_t, std::int64_t>, int> asked;
    bool fits = true;
    for (auto const& seen : sm::example::surfaces_of(view, width, height, village.triangles)) {
        if (!(seen.eye_depth > 0.0f)) continue;
        float const pixel = sm::pixel_metres(view, float(height), seen.eye_depth);
        sm::Page const page = sm::page_for(windows, seen.point, pixel);
        if (page.level < 0) continue;
        ++asked[{page.level, page.x, page.y}];
        float const texel = windows.level[std::size_t(page.level)].texel_metres;
        fits = fits && (texel <= pixel || page.level == 0 ||
                        !sm::holds(windows, sm::page_at(windows, page.level - 1, seen.point)));
    }
    std::printf("%zu pages of %d x %d texels serve %d x %d pixels\n", asked.size(), options.page_texels,
                options.page_texels, width, height);
    proof.that(fits, "A texel is no larger than its pixel, wherever a finer window holds the point.");

    // The same page has the same name from a hundred metres farther on.
    auto const moved =
        sm::clipmap(sm::light_basis(sun.direction), view.pose.position + glm::vec3(3.0f, 0.0f, 2.0f), options);
    glm::vec3 const point(1.0f, 0.0f, -3.0f);
    proof.that(sm::page_at(windows, 2, point) == sm::page_at(moved, 2, point), "Pages are named without the camera.");

    auto const& last = windows.level[std::size_t(windows.count - 1)];
    double const half = 0.25 * options.map_size * double(last.texel_metres);
    glm::dvec2 const middle((double(last.x) + 0.5 * last.map_size) * double(last.texel_metres),
                            (double(last.y) + 0.5 * last.map_size) * double(last.texel_metres));
    sm::example::Drawing drawing("In light space: the windows, and the pages that the picture asks for", middle - half,
                                 middle + half, 620);
    for (auto const& [page, pixels] : asked) {
        auto const& [level, x, y] = page;
        double const metres = double(windows.level[std::size_t(level)].texel_metres) * options.page_texels;
        drawing.box(metres * glm::dvec2(x, y), metres * glm::dvec2(x + 1, y + 1), "c" + std::to_string(level % 4));
    }
    for (int level = 0; level < windows.count; ++level) {
        auto const& grid = windows.level[std::size_t(level)];
        glm::dvec2 const lo = double(grid.texel_metres) * glm::dvec2(grid.x, grid.y);
        drawing.box(lo, lo + double(grid.texel_metres) * grid.map_size, "ink");
    }
    drawing.write(proof.folder() / "clipmap.svg");
    return proof.result();
}
