// SPDX-License-Identifier: MIT
//
// A virtual shadow map without its page table: concentric still windows, and the pages that the picture asks for.
#include "examples/support/drawing.hpp"
#include "examples/support/example.hpp"
#include "examples/support/raster.hpp"

#include <shadowmath/clipmap.hpp>

#include <set>
#include <tuple>

namespace sm = shadowmath;

int main(int argc, char** argv) {
    sm::example::Proof proof(argc, argv);
    auto const village = sm::example::village();
    auto const view = sm::example::village_view();
    auto const basis = sm::light_basis(sm::directional(sm::example::afternoon_sun).direction);

    sm::ClipmapOptions<float> const options{.levels = 6, .map_size = 2048, .finest_metres = 1.0f / 128.0f};
    auto const windows = sm::clipmap(basis, view.pose.position, options);

    constexpr int width = 960, height = 540;
    std::set<std::tuple<int, std::int64_t, std::int64_t>> asked;
    bool fits = true;
    for (auto const& seen : sm::example::surfaces_of(view, width, height, village.triangles)) {
        if (!(seen.eye_depth > 0.0f)) continue;
        float const pixel = sm::pixel_metres(view, float(height), seen.eye_depth);
        sm::Page const page = sm::page_for(windows, seen.point, pixel);
        if (page.level < 0) continue;
        asked.insert({page.level, page.x, page.y});
        float const texel = windows.level[std::size_t(page.level)].texel_metres;
        fits = fits && (texel <= pixel || page.level == 0 ||
                        !sm::holds(windows, sm::page_at(windows, page.level - 1, seen.point)));
    }
    std::printf("%zu pages of %d^2 texels serve %d x %d pixels\n", asked.size(), options.page_texels, width, height);
    proof.that(fits, "A texel is no larger than its pixel, wherever a finer window holds the point.");

    auto const moved = sm::clipmap(basis, view.pose.position + glm::vec3(3.0f, 0.0f, 2.0f), options);
    glm::vec3 const point(1.0f, 0.0f, -3.0f);
    proof.that(sm::page_at(windows, 2, point) == sm::page_at(moved, 2, point), "Pages are named without the camera.");

    auto const& last = windows.level[std::size_t(windows.count - 1)];
    glm::dvec2 const middle = double(last.texel_metres) * (glm::dvec2(last.x, last.y) + 0.5 * last.map_size);
    double const half = 0.25 * double(last.texel_metres) * last.map_size;
    sm::example::Drawing drawing("In light space: the windows, and the pages that the picture asks for", middle - half,
                                 middle + half, 620);
    auto const square = [&](int level, glm::dvec2 lo, int side, std::string const& css_class) {  // in texels
        double const texel = double(windows.level[std::size_t(level)].texel_metres);
        drawing.box(texel * lo, texel * (lo + double(side)), css_class);
    };
    int const side = options.page_texels;
    for (auto const& [level, x, y] : asked)
        square(level, glm::dvec2(x, y) * double(side), side, "c" + std::to_string(level % 4));
    for (int level = 0; level < windows.count; ++level) {
        auto const& grid = windows.level[std::size_t(level)];
        square(level, {grid.x, grid.y}, grid.map_size, "ink");
    }
    drawing.write(proof.folder() / "clipmap.svg");
    return proof.result();
}
