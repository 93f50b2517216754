// SPDX-License-Identifier: MIT
//
// Filterable maps: bounds from a few moments of depth. Where two occluders overlap, the bounds let light through: PCF,
// then VSM, EVSM and MSM from the same kernel.
#include "examples/support/example.hpp"
#include "examples/support/png.hpp"
#include "examples/support/raster.hpp"

#include <shadowmath/filter.hpp>
#include <shadowmath/fit_box.hpp>
#include <shadowmath/msm.hpp>
#include <shadowmath/vsm.hpp>

namespace sm = shadowmath;

int main(int argc, char** argv) {
    sm::example::Proof proof(argc, argv);
    // A floor, a board just above it on the left, and a high one that crosses both.
    auto const scene = sm::example::boards(
        {{{-6, 0, -6}, {6, 0, 6}}, {{-4.5f, 0.6f, -3}, {-0.5f, 0.6f, 3}}, {{-3, 6, -2}, {3, 6, 2}}});
    auto const floor = std::span(scene).first(2);

    constexpr int size = 256, radius = 6;
    auto const down = sm::pose_looking(glm::vec3(0, 8, 0), glm::vec3(0, -1, 0), glm::vec3(0, 0, -1));
    auto const view = sm::orthographic_view(down, -6.0f, 6.0f, -6.0f, 6.0f, 1.0f, 9.0f);
    auto const sun = sm::directional(glm::vec3(0.12f, -1.0f, 0.06f));
    auto const box = sm::fit_box(sm::light_basis(sun.direction), sm::corners(view), size, 2.0f);
    sm::ShadowMap<float> map;
    map.clip = sm::gl_zero_to_one_clip;
    map.clip_from_world = sm::clip_from_world(box, map.clip);
    auto const drawn = sm::example::draw_depths(map, size, scene);
    sm::EvsmExponents<float> const exponents;

    std::vector<sm::example::Picture> pictures;
    float darkest[4] = {1, 1, 1, 1};
    bool bounds = true;
    for (int kind = 0; kind < 4; ++kind)
        pictures.push_back(sm::example::draw_picture(view, 176, 176, floor, [&](auto const& seen) {
            auto const at = sm::projected(sm::texture_from_world(map), seen.point);
            glm::vec2 const texel = glm::vec2(at.at) * float(size);
            float const depth = at.at.z - 0.012f;
            auto const mean = [&](auto const& of_depth) {
                return sm::mean_moments(texel, size, radius, of_depth(1.0f),
                                        [&](int x, int y) { return of_depth(drawn(x, y)); });
            };
            auto const evsm_moments = [&](float d) { return sm::evsm_moments(d, exponents); };
            float const exact =
                sm::filtered(sm::Receiver<float>{texel, depth, {}}, size, map.clip, {radius, false}, drawn);
            float const lit = kind == 0   ? exact
                              : kind == 1 ? sm::vsm_visibility(mean(sm::vsm_moments<float>), depth, 3e-4f)
                              : kind == 2
                                  ? sm::evsm_visibility(mean(evsm_moments), depth, exponents, 3e-4f)
                                  : sm::msm_visibility(mean(sm::msm_moments<float>), depth, sm::msm_bias_float<float>);
            darkest[kind] = std::min(darkest[kind], lit);
            bounds = bounds && lit >= exact - 0.01f;
            return glm::vec3(0.06f + 0.8f * lit);
        }));
    proof.that(bounds, "Moments are never darker than the kernel.");
    proof.that(darkest[0] == 0.0f, "PCF is dark where nothing is lit.");
    sm::example::write_png(proof.folder() / "moments.png", sm::example::beside(pictures));
    return proof.result();
}
