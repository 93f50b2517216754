// SPDX-License-Identifier: MIT
//
// Which maps each object must be drawn into: one pass over the boxes for all maps. Seen from above; what casts into no
// map is grey.
#include "examples/support/drawing.hpp"
#include "examples/support/example.hpp"
#include "examples/support/raster.hpp"

#include <shadowmath/cascades.hpp>

namespace sm = shadowmath;

int main(int argc, char** argv) {
    sm::example::Proof proof(argc, argv);
    auto const village = sm::example::village();
    sm::CascadeOptions<float> options;
    options.count = 3;
    options.shadow_distance = 60.0f;
    auto const cascades = sm::fit_cascades(sm::example::village_view(), sm::directional(sm::example::afternoon_sun),
                                           village.casters, village.receivers, options);
    auto const maps = sm::caster_maps(cascades);

    sm::example::Drawing drawing("The village from above: three maps, and who casts into which", {-45, -38}, {120, 48},
                                 720);
    auto const above = [](glm::vec3 p) { return glm::dvec2(-p.z, p.x); };
    for (int i = cascades.count; i-- > 0;) {
        // Where the map's four sides meet the ground.
        auto const first = sm::example::corners_at(cascades.at[i].map, 0.0f);
        auto const last = sm::example::corners_at(cascades.at[i].map, 1.0f);
        std::vector<glm::dvec2> sides;
        for (std::size_t k = 0; k < 4; ++k)
            sides.push_back(above(first[k] + (last[k] - first[k]) * (first[k].y / (first[k].y - last[k].y))));
        drawing.area(sides, "c" + std::to_string(i));
    }
    int draws = 0, spared = 0;
    bool none_missed = true;
    for (sm::Aabb<float> const& object : village.objects) {
        sm::MapMask const mask = sm::caster_mask(maps, object);
        int first = 4;
        for (int i = 0; i < cascades.count; ++i) {
            bool const casts = (mask >> i & 1) != 0;
            if (casts) first = std::min(first, i);
            (casts ? draws : spared) += 1;
            // A corner that lands between the sides and not behind the far end casts: then the bit must be set.
            for (glm::vec3 const& corner : sm::corners(object)) {
                glm::vec4 const at = cascades.at[i].map.clip_from_world * glm::vec4(corner, 1.0f);
                none_missed = none_missed && (casts || std::abs(at.x) > 1.0f || std::abs(at.y) > 1.0f || at.z > 1.0f);
            }
        }
        drawing.box(above({object.lo.x, 0, object.hi.z}), above({object.hi.x, 0, object.lo.z}),
                    "d" + std::to_string(first));
    }
    drawing.dot(above({0.4f, 0, 7.5f}), "d4", 5);
    drawing.label(above({0.4f, 0, 7.5f}), "eye", "end", {-8, 4}, "small");
    drawing.write(proof.folder() / "culling.svg");
    std::printf("%zu objects, 3 maps: %d draws, %d spared\n", village.objects.size(), draws, spared);
    proof.that(none_missed, "No caster is missed.");
    proof.that(spared > 0, "What casts elsewhere is not drawn.");
    return proof.result();
}
