// SPDX-License-Identifier: MIT
//
// The knob that nobody can set, set by measuring: how many maps, how large, split where, within a number of texels.
#include "examples/support/drawing.hpp"
#include "examples/support/example.hpp"
#include "examples/support/raster.hpp"

#include <shadowmath/choose.hpp>

#include <cmath>

namespace sm = shadowmath;

int main(int argc, char** argv) {
    sm::example::Proof proof(argc, argv);
    auto const village = sm::example::village();
    auto const view = sm::example::village_view(100.0f);
    auto const sun = sm::directional(sm::example::afternoon_sun);
    std::vector<sm::SurfacePoint<float>> samples;
    for (auto const& seen : sm::example::surfaces_of(view, 64, 36, village.triangles))
        if (seen.eye_depth > 0.0f && glm::dot(seen.normal, sun.direction) < -0.05f)
            samples.push_back({seen.point, seen.normal});
    int const sample_count = int(samples.size());

    sm::CascadeOptions<float> const options;
    sm::ChoiceLimits<float> const limits{.texels = 4 * 1024 * 1024, .goal = sm::Goal::least_mean};
    auto const choice =
        sm::choose(view, sun, village.casters, village.receivers, samples.data(), sample_count, options, limits);
    std::printf("chosen: %d maps of %d texels, lambda %.2f: %.2f eye pixels a texel in the mean, after %d tries\n",
                choice.options.count, choice.options.map_size, choice.options.lambda, choice.judgement.all.mean,
                choice.tried);

    sm::example::Drawing drawing("Eye pixels a texel in the mean, by lambda and number of maps", {-0.06, -0.35},
                                 {1.16, 4.6}, 720, 380);
    for (double const lambda : {0.0, 0.25, 0.5, 0.75, 1.0}) {
        drawing.line({lambda, 0}, {lambda, 4.2}, "faint");
        drawing.label({lambda, 0}, sm::example::figure(lambda), "middle", {0, 16}, "small");
    }
    bool best = true;
    for (int count = 1; count <= 4; ++count) {
        sm::CascadeOptions<float> tried = options;
        tried.count = count;
        tried.map_size = sm::map_size_within(limits.texels, count, limits.largest_map);
        std::vector<glm::dvec2> curve;
        for (int step = 0; step <= 20; ++step) {
            tried.lambda = float(step) / 20.0f;
            auto const cascades = sm::fit_cascades(view, sun, village.casters, village.receivers, tried);
            float const mean =
                sm::judge(cascades, tried.map_size, view, limits.eye_pixels, samples.data(), sample_count).all.mean;
            best = best && choice.judgement.all.mean <= mean * 1.02f;
            curve.emplace_back(tried.lambda, std::log2(mean));
        }
        drawing.path(curve, "s" + std::to_string(count - 1));
        auto const name = std::to_string(count) + (count == 1 ? " map" : " maps");
        drawing.label(curve.back(), name, "start", {6, count == 3 ? 12 : 2});
    }
    for (int octave = 0; octave <= 4; ++octave)
        drawing.label({-0.01, octave}, std::to_string(1 << octave), "end", {0, 4}, "small");
    drawing.dot({choice.options.lambda, std::log2(choice.judgement.all.mean)}, "d4", 6);
    drawing.write(proof.folder() / "choose.svg");
    proof.that(best, "It is no worse than any options that one might try, but for a fiftieth.");
    return proof.result();
}
