// SPDX-License-Identifier: MIT
//
// What this library would make of the same view with as many maps of the same size: so that figures have something to
// stand beside.
#pragma once

#include "examples/doctor/diagnosis.hpp"

#include <shadowmath/cascades.hpp>

#include <optional>

namespace shadowmath::doctor {

struct Advice {
    CascadeFit fit = CascadeFit::stable;
    double lambda = 0.0;
    Footprints footprint;
};

// The best of eleven lambdas by the 95th percentile of the footprint. Nothing for a lamp, for maps of unlike sizes and
// without a scene.
[[nodiscard]] std::optional<Advice> advice(Case const& read, backend::Scene const& scene, Sight const& sight,
                                           CascadeFit fit);

}  // namespace shadowmath::doctor
