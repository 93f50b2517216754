// SPDX-License-Identifier: MIT
//
// A spot light, cropped to what the eye sees of its cone; and a lamp in all directions, whose unseen faces are skipped.
// The whole cone on the left, the crop on the right: as many texels each.
#include "examples/support/example.hpp"
#include "examples/support/png.hpp"
#include "examples/support/raster.hpp"

#include <shadowmath/fit_cube.hpp>

namespace sm = shadowmath;

int main(int argc, char** argv) {
    sm::example::Proof proof(argc, argv);
    auto const village = sm::example::village();
    auto view = sm::example::village_view(24.0f);
    view.left *= 0.4f, view.right *= 0.4f;
    sm::ClipSpace const clip = sm::gl_zero_to_one_clip;
    constexpr int map_size = 350;

    sm::Light<float> const lamp =
        sm::spot(glm::vec3(-14.0f, 16.0f, 4.0f), glm::vec3(0.75f, -0.75f, -0.75f), 0.7f, 80.0f);
    sm::ShadowMap<float> whole;
    whole.clip = clip;
    whole.clip_from_world = sm::spot_clip_from_world(lamp, 1.0f, clip);
    whole.visible = true;
    sm::ShadowMap<float> const crop =
        sm::fit_spot(view, lamp, village.casters, village.receivers, map_size, 2.0f, clip);
    proof.that(crop.visible && !crop.faults.any(), sm::describe(crop.faults));

    // What the eye sees and the lamp lights is inside the crop.
    int lit = 0, lost = 0;
    for (auto const& seen : sm::example::surfaces_of(view, 320, 180, village.triangles)) {
        glm::vec3 const way = seen.point - lamp.position;
        bool const in_cone = glm::dot(glm::normalize(way), lamp.direction) > std::cos(lamp.half_angle_radians);
        if (!(seen.eye_depth > 0.0f) || seen.eye_depth > view.z_far || !in_cone || glm::length(way) > lamp.range)
            continue;
        glm::vec4 const at = crop.clip_from_world * glm::vec4(seen.point, 1.0f);
        ++lit;
        lost += !(at.w > crop.w_min) || std::abs(at.x) > at.w || std::abs(at.y) > at.w;
    }
    std::printf("%d pixels seen and lit, %d outside the crop\n", lit, lost);
    proof.that(lit > 1000 && lost == 0, "Every receiver that is seen and lit is inside its map.");

    // A lamp in all directions, held behind the eye: only those of its six faces that the eye has a use for.
    auto const lamps = sm::fit_cube(view, glm::vec3(1.5f, 3.0f, 12.0f), 25.0f, village.casters, village.receivers,
                                    map_size, 2.0f, clip);
    std::printf("lamp behind the eye: %d of 6 faces have something to show\n", lamps.visible_count);
    proof.that(lamps.visible_count > 0 && lamps.visible_count < 6, "Faces that nobody sees are skipped.");

    sm::example::Picture const pictures[] = {
        sm::example::picture_of(sm::example::draw_depths(whole, map_size, village.triangles)),
        sm::example::picture_of(sm::example::draw_depths(crop, map_size, village.triangles))};
    sm::example::write_png(proof.folder() / "fit_crop.png", sm::example::beside(pictures));
    return proof.result();
}
