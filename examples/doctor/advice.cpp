// SPDX-License-Identifier: MIT
#include "examples/doctor/advice.hpp"
#include "examples/doctor/find.hpp"

#include <shadowmath/footprint.hpp>
#include <shadowmath/sampling.hpp>

namespace shadowmath::doctor {

std::optional<Advice> advice(Case const& read, backend::Scene const& scene, Sight const& sight, CascadeFit fit) {
    std::vector<EngineMap> const& maps = read.frame.maps;
    if (!sight.traced || sight.points.empty() || read.frame.light.kind != LightKind::directional) return std::nullopt;
    for (EngineMap const& map : maps)
        if (map.size != maps[0].size) return std::nullopt;
    Aabb<double> const box{glm::dvec3(scene.lo), glm::dvec3(scene.hi)};
    glm::dmat4 const eye = clip_from_world(read.frame.camera, ClipSpace{});
    glm::dvec2 const pixels(read.picture.width, read.picture.height);
    std::optional<Advice> best;
    for (int tenth = 0; tenth <= 10; ++tenth) {
        CascadeOptions<double> options;
        options.count = static_cast<int>(maps.size()) < max_splits ? static_cast<int>(maps.size()) : max_splits;
        options.map_size = maps[0].size;
        options.filter_radius = read.filter_radius;
        options.fit = fit;
        options.lambda = tenth / 10.0;
        options.shadow_distance = read.shadow_distance;
        Cascades<double> const fitted = fit_cascades(read.frame.camera, read.frame.light, box, box, options);
        std::vector<double> footprints;
        for (Seen const& seen : sight.points) {
            if (!seen.faces_light) continue;
            for (Cascade<double> const& cascade : fitted) {
                if (!contains(cascade.map, options.map_size, -0.5, seen.point)) continue;
                footprints.push_back(footprint(eye, pixels, cascade.map.clip_from_world, double(options.map_size),
                                               seen.point, seen.normal)
                                         .major);
                break;
            }
        }
        if (footprints.empty()) continue;
        Advice const tried{fit,
                           options.lambda,
                           {percentile(footprints, 0.5), percentile(footprints, 0.95), percentile(footprints, 1.0)}};
        if (!best || tried.footprint.p95 < best->footprint.p95) best = tried;
    }
    return best;
}

}  // namespace shadowmath::doctor
