// SPDX-License-Identifier: MIT
//
// Cascades fitted to what the eye sees, pixel by pixel. Seen from the light: the samples of one picture, the maps
// around them, and (dashed) the stable maps of the same splits.
#include "examples/support/drawing.hpp"
#include "examples/support/example.hpp"
#include "examples/support/raster.hpp"

#include <shadowmath/cascades.hpp>
#include <shadowmath/sampling.hpp>
#include <shadowmath/sdsm.hpp>

namespace sm = shadowmath;

int main(int argc, char** argv) {
    sm::example::Proof proof(argc, argv);
    auto const village = sm::example::village();
    auto const view = sm::example::village_view();
    auto const sun = sm::directional(sm::example::afternoon_sun);
    constexpr int width = 480, height = 270;
    auto const seen = sm::example::surfaces_of(view, width, height, village.triangles);

    sm::SampleDepths<float> depths = sm::no_depths(view.z_near, view.z_far);
    for (auto const& pixel : seen) sm::add(depths, pixel.eye_depth);
    sm::SampleBounds<float> bounds = sm::no_bounds(sm::sample_splits(depths, 4, sm::SampleSplits::adaptive));
    sm::SampleRays<float> const rays = sm::sample_rays(view, sun, width, height);
    for (int i = 0; i < width * height; ++i)
        sm::add(bounds, rays, i % width, i / width, seen[std::size_t(i)].eye_depth);
    sm::SampleFitOptions<float> options;
    auto const fitted = sm::fit_samples(rays, bounds, village.casters, options);

    sm::CascadeOptions<float> whole;
    whole.first_split_end = bounds.range[0].end;
    auto const stable = sm::fit_cascades(view, sun, village.casters, village.receivers, whole);

    bool inside = true;
    for (auto const& pixel : seen)
        for (auto const& c : fitted)
            inside = inside && (!sm::is_served(c.range, pixel.eye_depth) ||
                                sm::contains(c.map, options.map_size, options.margin_texels - 0.05f, pixel.point));
    proof.that(inside, "Every sample is inside its map, margin included.");

    sm::LightBasis<float> const basis = sm::light_basis(sun.direction);
    auto const in_light = [&](glm::vec3 p) { return glm::dvec2(glm::dot(basis.x, p), glm::dot(basis.y, p)); };
    sm::example::Drawing drawing("Seen from the light: samples, fitted maps, stable maps", {-75, -50}, {95, 65}, 720);
    for (std::size_t i = 0; i < seen.size(); i += 151)
        for (int c = 0; c < fitted.count; ++c)
            if (sm::is_served(fitted.at[c].range, seen[i].eye_depth))
                drawing.dot(in_light(seen[i].point), "d" + std::to_string(c), 1.0);
    bool smaller = true;
    for (int c = 0; c < fitted.count; ++c) {
        for (auto const* maps : {&fitted, &stable}) {
            std::vector<glm::dvec2> sides;
            for (glm::vec3 const& p : sm::example::corners_at(maps->at[c].map, 0.5f)) sides.push_back(in_light(p));
            drawing.area(sides, maps == &fitted ? "s" + std::to_string(c) : "dash");
        }
        std::printf("map %d: texels of %.1f cm, stable %.1f cm\n", c, 100 * fitted.at[c].texel_metres,
                    100 * stable.at[c].texel_metres);
        smaller = smaller && fitted.at[c].texel_metres < stable.at[c].texel_metres;
    }
    drawing.write(proof.folder() / "sdsm.svg");
    proof.that(smaller, "Each map has smaller texels than the stable one.");
    return proof.result();
}
