// SPDX-License-Identifier: MIT
//
// From a technique's answer to maps on a backend: drawn with its matrices, or fitted on the device and drawn from
// there.
#pragma once

#include "backends/sdsm_passes.hpp"
#include "examples/gallery/techniques.hpp"

namespace shadowmath::gallery {

// What the technique is told of the view: the eye's depth, if it asks for it.
[[nodiscard]] inline MapSet fit_on(backend::Backend& backend, Technique const& technique, backend::Scene const& scene,
                                   scenes::View const& view, backend::Extent extent) {
    if (!technique.fits_to_samples) return fit(technique, scene, view, extent);
    backend.fit_maps(eye_depth_pass(view, extent));
    return fit(technique, scene, view, extent, backend.read_eye_depth());
}

// Milliseconds until the driver has finished, the fit on the device included.
inline double draw_maps(backend::Backend& backend, MapSet const& set, backend::Extent extent) {
    std::vector<backend::DepthLayer> layers;
    for (Map const& map : set.maps) layers.push_back({glm::mat4(map.clip_from_world), map.casters});
    if (layers.empty()) return 0.0;
    bool const fitted = !set.device_fit.empty();
    double milliseconds = 0.0;
    if (fitted) {
        std::vector<backend::ComputeStep> const steps = backend::sdsm_steps(extent);
        backend::FitPass const fit{extent, set.eye_depth_from_world, steps, set.device_fit, backend::sdsm_state_bytes};
        milliseconds += backend.fit_maps(fit).milliseconds;
    }
    return milliseconds +
           backend.draw_depth({set.map_size, layers, true, backend::DrawWay::pass_per_map, fitted}).milliseconds;
}

inline double draw_picture(backend::Backend& backend, MapSet const& set, backend::Extent extent) {
    return backend.draw_scene({extent, set.frame, !set.device_fit.empty()}).milliseconds;
}

}  // namespace shadowmath::gallery
