// SPDX-License-Identifier: MIT
//
// The view-dependent map: on its plane a texel covers as many eye pixels near the eye as far away. The squares are four
// texels wide.
#include "examples/support/example.hpp"
#include "examples/support/png.hpp"
#include "examples/support/raster.hpp"

#include <shadowmath/footprint.hpp>
#include <shadowmath/vdsm.hpp>

#include <cmath>
#include <limits>

namespace sm = shadowmath;

int main(int argc, char** argv) {
    sm::example::Proof proof(argc, argv);
    auto const village = sm::example::village();
    auto const view = sm::example::village_view(100.0f);
    auto const sun = sm::directional(glm::vec3(-0.35f, -0.5f, 0.6f));
    glm::mat4 const eye = sm::clip_from_world(view, sm::ClipSpace{});
    glm::vec2 const eye_pixels(720.0f, 405.0f);

    sm::ShadowPlane<float> const meadow = sm::plane_through(glm::vec3(0.0f), glm::vec3(0.0f, 1.0f, 0.0f));
    sm::VdsmOptions<float> options;
    options.map_size = 512;
    auto const map =
        sm::view_dependent_map(view, sun, meadow, village.casters, village.receivers, options, sm::gl_zero_to_one_clip);

    float least = std::numeric_limits<float>::max(), most = 0.0f;
    auto const picture = sm::example::draw_picture(view, 720, 405, village.triangles, [&](auto const& seen) {
        glm::vec4 const at = map.clip_from_world * glm::vec4(seen.point, 1.0f);
        glm::vec2 const texel = (glm::vec2(at) / at.w * 0.5f + 0.5f) * float(options.map_size);
        if (seen.point.y == 0.0f || (seen.normal.y > 0.99f && std::abs(seen.point.y) < 0.001f)) {
            auto const there =
                sm::footprint(eye, eye_pixels, map.clip_from_world, float(options.map_size), seen.point, seen.normal);
            least = std::min(least, there.major);
            most = std::max(most, there.major);
        }
        bool const odd = (int(std::floor(texel.x / 4.0f)) + int(std::floor(texel.y / 4.0f))) % 2 != 0;
        auto plain = seen;
        plain.colour = seen.colour * (odd ? 0.55f : 1.3f);
        return sm::example::sunlit(plain, sun.direction, 0.8f);
    });
    std::printf("on the meadow %.3f to %.3f eye pixels a texel, from the eye's feet to 100 m\n", least, most);
    proof.that(most <= least * 1.01f, "On its plane a texel covers the same number of eye pixels everywhere.");
    glm::vec4 const light = map.clip_from_world * sm::homogeneous(sun);
    proof.that(std::abs(light.x) < 1e-5f && std::abs(light.y) < 1e-5f && std::abs(light.w) < 1e-5f && light.z > 0.0f,
               "It obeys the law of shadow maps: M l = (0, 0, k, 0), k > 0.");
    glm::vec3 const top_of_a_tower(0.0f, 30.0f, -5.0f);  // whose shadow falls behind the eye
    proof.that(!sm::receiver_valid(map, top_of_a_tower), "It says which receivers are not its own.");
    sm::example::write_png(proof.folder() / "vdsm.png", picture);
    return proof.result();
}
