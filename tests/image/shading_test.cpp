// SPDX-License-Identifier: MIT
//
// What the receiver pass leaves in each pixel besides visibility: position, normal and colour.
#include "tests/image/contexts.hpp"
#include "tests/image/quad_over_floor.hpp"

#include <limits>

namespace {

using namespace shadowmath::image_test;

constexpr float epsilon = std::numeric_limits<float>::epsilon();

class Shading : public InContext {};
INSTANTIATE_TEST_SUITE_P(Contexts, Shading, every_context, context_name);

void expect_true_positions_and_normals(Backend& backend, bool mirrored) {
    QuadOverFloor const world;
    ScenePass pass = world.pass({160, 120}, 256);
    pass.frame.sky = {0.0f, 0.5f, 1.0f, 1.0f};
    if (mirrored)
        pass.frame.clip_from_world = glm::scale(glm::mat4(1), glm::vec3(-1, 1, 1)) * pass.frame.clip_from_world;
    Frame const frame = draw_quad_over_floor(backend, world, pass);
    int floor_pixels = 0, quad_pixels = 0, sky_pixels = 0;
    for (int y = 0; y < 120; ++y)
        for (int x = 0; x < 160; ++x) {
            Texel4 const& p = frame.position.at(x, y);
            Rgba8 const& colour = frame.colour.at(x, y);
            if (is_sky(p)) {
                ++sky_pixels;
                EXPECT_EQ(int(colour.r), 0);
                EXPECT_NEAR(int(colour.g), 188, 1);  // sRGB of 0.5
                EXPECT_EQ(int(colour.b), 255);
                continue;
            }
            (is_floor(p) ? floor_pixels : quad_pixels) += 1;
            // World coordinates below 16 with a handful of roundings each in interpolation.
            EXPECT_NEAR(p.y, is_floor(p) ? 0.0f : QuadOverFloor::height_metres, 64.0f * 16.0f * epsilon);
            EXPECT_NEAR(frame.normal.at(x, y).y, 1.0f, 1e-4f);
            glm::vec4 const clip = pass.frame.clip_from_world * glm::vec4(p.x, p.y, p.z, 1.0f);
            EXPECT_NEAR((clip.x / clip.w * 0.5f + 0.5f) * 160.0f, float(x) + 0.5f, 0.01f);
            EXPECT_NEAR((clip.y / clip.w * 0.5f + 0.5f) * 120.0f, float(y) + 0.5f, 0.01f);
        }
    EXPECT_GT(floor_pixels, 5000);
    EXPECT_GT(quad_pixels, 200);
    EXPECT_GT(sky_pixels, 1000);
}

TEST_P(Shading, ReportsPositionNormalAndSky) {
    expect_true_positions_and_normals(*backend, false);
}
TEST_P(Shading, ReportsPositionNormalAndSkyInAMirroredPicture) {
    expect_true_positions_and_normals(*backend, true);
}

float srgb_from_linear(float x) {
    x = std::fmin(std::fmax(x, 0.0f), 1.0f);
    return 255.0f * (x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1.0f / 2.4f) - 0.055f);
}

void expect_shaded_as_written(Backend& backend, QuadOverFloor const& world, FrameConstants const& light) {
    ScenePass pass = world.pass({160, 120}, 256);
    pass.frame.light = light.light;
    pass.frame.spot_axis = light.spot_axis;
    pass.frame.specular = 0.4f;
    pass.frame.specular_power = 10.0f;
    pass.frame.ambient = {0.05f, 0.06f, 0.07f, 0.0f};
    pass.frame.light_colour = {0.5f, 0.6f, 0.4f, 0.0f};
    pass.frame.maps[0].bias_constant = 32.0f * epsilon;
    Frame const frame = draw_quad_over_floor(backend, world, pass);
    glm::vec3 const up(0, 1, 0);
    float const cos_outer = pass.frame.spot_axis.w;
    int lit = 0, rim = 0;
    for (std::size_t i = 0; i < frame.position.pixels.size(); ++i) {
        Texel4 const& p = frame.position.pixels[i];
        if (is_sky(p)) continue;
        glm::vec3 const point(p.x, p.y, p.z);
        glm::vec3 const light_at(pass.frame.light);
        glm::vec3 const to_light = glm::normalize(light_at - pass.frame.light.w * point);
        glm::vec3 const half = glm::normalize(to_light + glm::normalize(world.eye - point));
        float const into_cone =
            (glm::dot(-to_light, glm::vec3(pass.frame.spot_axis)) - cos_outer) / (0.1f * (1.0f - cos_outer));
        float const t = cos_outer <= -2.0f ? 1.0f : std::fmin(std::fmax(into_cone, 0.0f), 1.0f);
        float const spot = t * t * (3.0f - 2.0f * t);
        float const direct = glm::dot(up, to_light) + 0.4f * std::pow(glm::dot(up, half), 10.0f);
        Vertex const& vertex = world.scene.vertices[is_floor(p) ? 0u : 4u];
        std::array<std::uint8_t, 3> const got{frame.colour.pixels[i].r, frame.colour.pixels[i].g,
                                              frame.colour.pixels[i].b};
        for (int k = 0; k < 3; ++k) {
            float const linear =
                (pass.frame.ambient[k] + pass.frame.light_colour[k] * direct * spot * frame.normal.pixels[i].w) *
                float(vertex.albedo[k]) / 255.0f;
            EXPECT_NEAR(float(got[std::size_t(k)]), srgb_from_linear(linear), 1.5f);
        }
        lit += frame.normal.pixels[i].w == 1.0f;
        rim += spot > 0.1f && spot < 0.9f;
    }
    EXPECT_GT(lit, 1000);
    EXPECT_TRUE(cos_outer <= -2.0f || rim > 100) << rim;
}

TEST_P(Shading, ShadesAmbientDiffuseAndHighlight) {
    QuadOverFloor world;
    FrameConstants light;
    light.light = glm::vec4(-world.light_travel, 0.0f);
    expect_shaded_as_written(*backend, world, light);
    for (Vertex& vertex : world.scene.vertices) vertex.normal = -vertex.normal;  // seen from behind
    expect_shaded_as_written(*backend, world, light);
    light.light = {1.0f, 6.0f, 1.0f, 1.0f};
    light.spot_axis = {0.0f, -1.0f, 0.0f, 0.8f};
    expect_shaded_as_written(*backend, world, light);
}

}  // namespace
