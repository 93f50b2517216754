// SPDX-License-Identifier: MIT
//
// Soft shadows' part of what the twins are tried on.
#pragma once

#include "tests/twins/twin.hpp"

#include <shadowmath/pcss.hpp>

namespace shadowmath::twins {

// Of the map itself; one case in a few with another's numbers.
inline MapPenumbra<float> penumbra_of(Draw& draw, ShadowMap<float> const& map, Light<float> const& light) {
    float const radius = light.kind == LightKind::spot ? draw.log_uniform(1e-3f, 1.0f) : draw.log_uniform(1e-3f, 0.2f);
    MapPenumbra<float> penumbra = penumbra_for(map, light, radius);
    penumbra.largest_gap = draw.one_in(2) ? draw.log_uniform(0.1f, 1e3f) : penumbra.largest_gap;
    for (int i = 0; i < 4; ++i) penumbra.rim_x[i] = draw.spoilt(penumbra.rim_x[i]);
    penumbra.depth_of_gap = draw.spoilt(penumbra.depth_of_gap);
    penumbra.largest_gap = draw.spoilt(penumbra.largest_gap);
    return penumbra;
}

inline void give(Words& given, MapPenumbra<float> const& penumbra) {
    given(penumbra.rim_x)(penumbra.rim_y)(penumbra.depth_of_gap)(penumbra.largest_gap);
}

}  // namespace shadowmath::twins
