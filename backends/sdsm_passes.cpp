// SPDX-License-Identifier: MIT
#include "backends/sdsm_passes.hpp"

#include "backends/shaders/embedded.hpp"

namespace shadowmath::backend {

std::vector<ComputeStep> sdsm_steps(Extent extent) {
    constexpr int tile = 64;  // sdsm_blocks.glsl
    auto const tiles = [](int pixels) { return static_cast<unsigned>((pixels + tile - 1) / tile); };
    glm::uvec3 const all_pixels(tiles(extent.width), tiles(extent.height), 1u), once(1u);
    return {{&shaders::sdsm_begin_comp, once},
            {&shaders::sdsm_depths_comp, all_pixels},
            {&shaders::sdsm_splits_comp, once},
            {&shaders::sdsm_bounds_comp, all_pixels},
            {&shaders::sdsm_maps_comp, once}};
}

}  // namespace shadowmath::backend
