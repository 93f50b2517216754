// SPDX-License-Identifier: MIT
//
// Stops where a debugger can look at one of each; printed.sh compares what it sees.
#include <shadowmath/shadowmath.hpp>

int main() {
    namespace sm = shadowmath;
    sm::Aabb<float> const box{glm::vec3(-20, 0, -20), glm::vec3(20, 5, 20)};
    auto const nothing = sm::Aabb<float>{};
    auto const view = sm::perspective_view(sm::Pose<float>{}, 1.0f, 1.5f, 0.5f, 50.0f);
    auto const sun = sm::directional(glm::vec3(0, -2, 0));
    auto const splits = sm::uniform_splits(1.0, 9.0, 2);
    auto const cascades = sm::fit_cascades(view, sun, box, box, sm::CascadeOptions<float>{});
    sm::Faults const faults = sm::Fault::not_finite | sm::Fault::bad_pose;
    auto const clip = sm::vulkan_clip;
    auto const map = sm::ShadowMap<double>{};

    auto const ball = sm::Sphere<float>{glm::vec3(1, 2, 3), 4};
    auto const range = sm::slice_range(splits, 0, 0.5);
    auto const depth = sm::DepthRange<float>{-8, 2, true};
    auto const light_box = sm::LightBox<float>{};
    auto const grid = sm::grid_window(sm::LightBasis<float>{}, glm::vec3(0), 0.5f, 64);
    auto const region = sm::Region<float>{};
    auto const plane = sm::ShadowPlane<float>{glm::vec3(0, 1, 0), -3};
    auto const texel = sm::Footprint<float>{2, 0.5f};
    auto const worth = sm::Worth<float>{4, 2, 3, 100, 3};
    auto const bias = sm::MapBias<float>{0.25f, 0, 1.5f, 1};
    auto const look_up = sm::LookUp<float>{1, 2, 0.25f};
    auto const lit = sm::LookUp<float>{};
    auto const soft = sm::SoftShadow<float>{0.5f, 2, true};
    auto const cube = sm::CubeMaps<float>{};
    auto const levels =
        sm::clipmap(sm::LightBasis<float>{}, glm::vec3(0), sm::ClipmapOptions<float>{3, 256, 128, 0.5f});
    auto const casters = sm::caster_maps(cascades);
    auto const body = sm::convex_body(sm::corners(box));
    auto const irregular = sm::IrregularBuffer<float>{};
    auto const tile = sm::Tile{16, 32, 64, 128, 256};
    auto const strip = sm::TexelRect{1, 2, 3, 4};
    auto const part = sm::PixelRect{4, 3, 2, 1};
    auto const page = sm::Page{2, -1, 5};
    auto const scroll =
        sm::scroll_between(grid, sm::grid_window(sm::LightBasis<float>{}, glm::vec3(2, 0, 0), 0.5f, 64));
    void const* const looked_at[] = {&ball,  &range,     &depth,   &light_box, &grid, &region, &plane,  &texel,
                                     &worth, &bias,      &look_up, &lit,       &soft, &cube,   &levels, &casters,
                                     &body,  &irregular, &tile,    &strip,     &part, &page,   &scroll};
    auto const seen = [&] {
        return &box && &nothing && &splits && &faults && &clip && &map && cascades.count == 4 && *looked_at;
    };
    return seen() ? 0 : 1;  // stop here
}
