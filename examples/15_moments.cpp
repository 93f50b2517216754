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
using sm::example::Triangle;

int main(int argc, char** argv) {
    sm::example::Proof proof(argc, argv);
    // A floor, a board just above it on the left, and a high one that crosses both.
    std::vector<Triangle> scene;
    auto const board = [&scene](glm::vec3 lo, glm::vec3 hi, glm::vec3 colour) {
        glm::vec3 const a(lo.x, hi.y, hi.z), b(hi.x, hi.y, hi.z), c(hi.x, hi.y, lo.z), d(lo.x, hi.y, lo.z), up(0, 1, 0);
        scene.push_back({{a, b, c}, up, colour});
        scene.push_back({{a, c, d}, up, colour});
    };
    board({-6, 0, -6}, {6, 0, 6}, glm::vec3(0.6f));
    std::size_t const floor = scene.size();
    board({-4.5f, 0.6f, -3}, {-0.5f, 0.6f, 3}, glm::vec3(0.6f));
    board({-3, 6, -2}, {3, 6, 2}, glm::vec3(0.6f));

    constexpr int size = 256, radius = 6;
    sm::ViewVolume<float> const view =
        sm::orthographic_view(sm::pose_looking(glm::vec3(0, 8, 0), glm::vec3(0, -1, 0), glm::vec3(0, 0, -1)), -6.0f,
                              6.0f, -6.0f, 6.0f, 1.0f, 9.0f);
    auto const sun = sm::directional(glm::vec3(0.12f, -1.0f, 0.06f));
    sm::ShadowMap<float> map;
    map.clip = sm::gl_zero_to_one_clip;
    map.clip_from_world =
        sm::clip_from_world(sm::fit_box(sm::light_basis(sun.direction), sm::corners(view), size, 2.0f), map.clip);
    map.visible = true;
    auto const drawn = sm::example::draw_depths(map, size, scene);
    sm::EvsmExponents<float> const exponents;

    std::vector<sm::example::Picture> pictures;
    float darkest[4] = {1, 1, 1, 1};
    bool bounds = true;
    for (int kind = 0; kind < 4; ++kind)
        pictures.push_back(
            sm::example::draw_picture(view, 176, 176, std::span(scene).first(floor), [&](auto const& seen) {
                auto const at = sm::projected(sm::texture_from_world(map), seen.point);
                glm::vec2 const texel = glm::vec2(at.at) * float(size);
                auto const mean = [&](auto const& of_depth) {
                    return sm::mean_moments(texel, size, radius, of_depth(1.0f),
                                            [&](int x, int y) { return of_depth(drawn(x, y)); });
                };
                float const depth = at.at.z - 0.012f, exact = sm::filtered(sm::Receiver<float>{texel, depth, {}}, size,
                                                                           map.clip, {radius, false}, drawn);
                float const lit =
                    kind == 0   ? exact
                    : kind == 1 ? sm::vsm_visibility(mean(sm::vsm_moments<float>), depth, 3e-4f)
                    : kind == 2 ? sm::evsm_visibility(mean([&](float d) { return sm::evsm_moments(d, exponents); }),
                                                      depth, exponents, 3e-4f)
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
