// SPDX-License-Identifier: MIT
#include "backends/gl/gl_backend.hpp"
#include "backends/null/null_backend.hpp"
#include "tests/image/quad_over_floor.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>
#include <iostream>
#include <limits>
#include <random>
#include <utility>

namespace {

using namespace shadowmath::image_test;

constexpr float epsilon = std::numeric_limits<float>::epsilon();

Scene triangles(std::vector<glm::vec3> const& corners) {
    Scene scene;
    scene.name = "triangles";
    for (glm::vec3 const& corner : corners) scene.vertices.push_back({corner, {0, 0, 1}, {255, 255, 255, 255}});
    for (std::uint32_t i = 0; i < corners.size(); ++i) scene.indices.push_back(i);
    for (std::uint32_t i = 0; i < corners.size(); i += 3) {
        Object object;
        object.first_index = i;
        object.index_count = 3;
        scene.objects.push_back(object);
    }
    return scene;
}

// Draws one map with the identity, so that positions are clip coordinates.
Image<float> draw_in_clip(Backend& backend, Scene const& scene, int map_size, bool depth_clamp,
                          std::vector<std::uint32_t> const& objects) {
    backend.upload(scene);
    DepthLayer const layer{glm::mat4(1.0f), objects};
    backend.draw_depth({map_size, {&layer, 1}, depth_clamp});
    return backend.read_depth(0);
}

Frame draw_quad_over_floor(Backend& backend, QuadOverFloor const& world, ScenePass const& pass) {
    std::array<std::uint32_t, 2> const both{QuadOverFloor::floor, QuadOverFloor::quad};
    std::array<DepthLayer, max_maps> layers;
    for (int i = 0; i < pass.frame.map_count; ++i)
        layers[std::size_t(i)] = {pass.frame.maps[std::size_t(i)].clip_from_world, both};
    backend.upload(world.scene);
    backend.draw_depth({int(pass.frame.map_size), {layers.data(), std::size_t(pass.frame.map_count)}, true});
    backend.draw_scene(pass);
    return backend.read_frame();
}

bool is_floor(Texel4 const& position) { return position.w > -2.0f && position.y < 0.5f; }
bool is_sky(Texel4 const& position) { return position.w == -2.0f; }

struct Disagreement {
    int pixels_compared = 0;
    int in_shadow = 0;
    int wrong = 0;
};

// Compares the floor with the shadow that geometry predicts, except within margin_metres of its edge; the quad's top
// must be lit everywhere.
Disagreement compare_with_geometry(QuadOverFloor const& world, Frame const& frame, float margin_metres) {
    Disagreement result;
    for (std::size_t i = 0; i < frame.position.pixels.size(); ++i) {
        Texel4 const& p = frame.position.pixels[i];
        if (is_sky(p)) continue;
        float const depth = is_floor(p) ? world.metres_into_shadow({p.x, p.y, p.z}) : -1.0f;
        if (std::fabs(depth) < margin_metres) continue;
        ++result.pixels_compared;
        result.in_shadow += depth > 0.0f;
        result.wrong += frame.normal.pixels[i].w != (depth > 0.0f ? 0.0f : 1.0f);
    }
    return result;
}

class GlBackend : public testing::TestWithParam<GlContextKind> {
protected:
    void TearDown() override {
        for (std::string const& message : backend->take_messages()) ADD_FAILURE() << "driver: " << message;
    }
    std::unique_ptr<Backend> backend = make_gl_backend(GetParam());
};

INSTANTIATE_TEST_SUITE_P(Contexts, GlBackend, testing::Values(GlContextKind::egl, GlContextKind::osmesa),
                         [](auto const& kind) { return kind.param == GlContextKind::egl ? "egl" : "osmesa"; });

TEST_P(GlBackend, KnowsItsName) {
    EXPECT_EQ(backend->info().name, GetParam() == GlContextKind::egl ? "egl" : "osmesa");
    EXPECT_NE(backend->info().driver.find("OpenGL"), std::string::npos);
}

TEST_P(GlBackend, DrawsATrianglesDepthWhereItsCornersSay) {
    constexpr int size = 64;
    Image<float> const map = draw_in_clip(
        *backend, triangles({{-0.5f, -0.5f, 0.25f}, {0.53f, -0.5f, 0.25f}, {-0.5f, 0.5f, 0.75f}}), size, false, {0});
    for (int row = 0; row < size; ++row)
        for (int column = 0; column < size; ++column) {
            double const x = (column + 0.5) * 2.0 / size - 1.0;
            double const y = (row + 0.5) * 2.0 / size - 1.0;
            bool const covered = x > -0.5 && y > -0.5 && (x + 0.5) / 1.03 + (y + 0.5) < 1.0;
            // A plane equation in float: a handful of roundings of values below 1. A rasteriser may also snap corners to
            // 1/256 texel, which moves depth by the slope (0.5 / 32 a texel) times as much.
            double const expected = covered ? 0.25 + 0.5 * (y + 0.5) : 1.0;
            double const tolerance = covered ? 8.0 * double(epsilon) + 0.5 / 32.0 / 256.0 : 0.0;
            ASSERT_NEAR(double(map.at(column, row)), expected, tolerance) << column << ", " << row;
        }
}

TEST_P(GlBackend, PancakesWhatLiesInFrontOfTheMapOnlyWhenClamped) {
    Scene const in_front = triangles({{-1, -1, -3}, {3, -1, -3}, {-1, 3, -3}});
    EXPECT_EQ(draw_in_clip(*backend, in_front, 8, true, {0}).pixels, std::vector<float>(64, 0.0f));
    EXPECT_EQ(draw_in_clip(*backend, in_front, 8, false, {0}).pixels, std::vector<float>(64, 1.0f));
}

TEST_P(GlBackend, DrawsTheListedObjectsOnly) {
    Scene const scene = triangles({{-1, -1, 0.2f}, {3, -1, 0.2f}, {-1, 3, 0.2f},      //
                                   {-1, -1, 0.4f}, {3, -1, 0.4f}, {-1, 3, 0.4f},      //
                                   {-1, -1, 0.6f}, {3, -1, 0.6f}, {-1, 3, 0.6f}});
    EXPECT_EQ(draw_in_clip(*backend, scene, 4, true, {}).at(1, 1), 1.0f);
    EXPECT_FLOAT_EQ(draw_in_clip(*backend, scene, 4, true, {0, 1, 2}).at(1, 1), 0.2f);
    EXPECT_FLOAT_EQ(draw_in_clip(*backend, scene, 4, true, {1, 2}).at(1, 1), 0.4f);
    EXPECT_FLOAT_EQ(draw_in_clip(*backend, scene, 4, true, {2, 1}).at(1, 1), 0.4f);
    EXPECT_FLOAT_EQ(draw_in_clip(*backend, scene, 4, true, {0, 2}).at(1, 1), 0.2f);
    EXPECT_FLOAT_EQ(draw_in_clip(*backend, scene, 4, true, {2}).at(1, 1), 0.6f);
}

TEST_P(GlBackend, KeepsEachLayerApart) {
    backend->upload(triangles({{-1, -1, 0.2f}, {3, -1, 0.2f}, {-1, 3, 0.2f}, {-1, -1, 0.4f}, {3, -1, 0.4f}, {-1, 3, 0.4f}}));
    std::array<std::uint32_t, 2> const objects{0, 1};
    std::array<DepthLayer, max_maps> layers;
    for (std::size_t i = 0; i < layers.size(); ++i) {
        layers[i].clip_from_world[3][2] = 0.0625f * float(i);
        layers[i].objects = std::span(objects).subspan(i % 2, 1);
    }
    backend->draw_depth({16, layers, true});
    for (int i = 0; i < max_maps; ++i)
        EXPECT_FLOAT_EQ(backend->read_depth(i).at(8, 8), (i % 2 == 0 ? 0.2f : 0.4f) + 0.0625f * float(i)) << i;
    EXPECT_THROW(static_cast<void>(backend->read_depth(max_maps)), std::runtime_error);
}

// Without bias but for rounding: the tap's plane depth is exact. Map depths lie in [0, 1], formed from products and
// sums of terms below 2, in the vertex shader, the rasteriser and the receiver: 32 roundings are generous.
constexpr float rounding_bias = 32.0f * epsilon;

TEST_P(GlBackend, ShadowFallsWhereGeometrySaysAndNowhereElse) {
    QuadOverFloor const world;
    for (int radius : {0, 1, 2})
        for (int tap_plane : {0, 1}) {
            ScenePass pass = world.pass({320, 240}, 512);
            pass.frame.filter_radius = radius;
            pass.frame.tap_plane = tap_plane;
            pass.frame.maps[0].bias_constant = rounding_bias;
            // A tap lies up to radius + 1/2 texels from the receiver along each axis (math of a planar receiver).
            pass.frame.maps[0].bias_slope_texels = tap_plane == 1 ? 0.0f : float(radius) + 0.5f;
            float const texel = 2.0f * QuadOverFloor::half_map_metres / 512.0f;
            float const margin = float(radius + 1) * texel * 1.5f / -world.light_travel.y;
            Disagreement const d = compare_with_geometry(world, draw_quad_over_floor(*backend, world, pass), margin);
            EXPECT_GT(d.pixels_compared, 40000);
            EXPECT_GT(d.in_shadow, 1000);
            EXPECT_EQ(d.wrong, 0) << "radius " << radius << ", tap_plane " << tap_plane;
        }
}

TEST_P(GlBackend, WithoutBiasOrTapPlaneTheFloorHasAcne) {
    QuadOverFloor const world;
    ScenePass pass = world.pass({320, 240}, 512);
    pass.frame.tap_plane = 0;
    EXPECT_GT(compare_with_geometry(world, draw_quad_over_floor(*backend, world, pass), 0.1f).wrong, 10000);
}

TEST_P(GlBackend, FilteredVisibilityIsContinuousAcrossThePicture) {
    QuadOverFloor const world;
    for (int radius : {1, 2}) {
        ScenePass pass = world.pass({640, 480}, 64);
        pass.frame.filter_radius = radius;
        // The plane's normal comes from differences of positions that round by 4 epsilon of their distance, a pixel
        // (0.002 of the distance) apart: 2.4e-4 rad. Over 2.5 texels of 0.25 m on both axes, on a slope whose secant is
        // 1.15, that is 2.8e-4 m or 1.8e-5 of the map's 16 m.
        pass.frame.maps[0].bias_constant = 2e-5f;
        Frame const frame = draw_quad_over_floor(*backend, world, pass);
        glm::mat4 const sun = world.clip_from_world_of_sun();
        auto const texel_of = [&](Texel4 const& p) { return glm::vec2(sun * glm::vec4(p.x, p.y, p.z, 1.0f)) * 32.0f; };
        int partial = 0;
        for (int y = 0; y < 480; ++y)
            for (int x = 1; x < 640; ++x) {
                Texel4 const& left = frame.position.at(x - 1, y);
                Texel4 const& right = frame.position.at(x, y);
                if (!is_floor(left) || !is_floor(right)) continue;
                glm::vec2 const moved = glm::abs(texel_of(right) - texel_of(left));
                float const change = std::fabs(frame.normal.at(x, y).w - frame.normal.at(x - 1, y).w);
                // A box 2 * radius wide that moves by d gains or loses at most d / (2 * radius) of itself.
                ASSERT_LE(change, (moved.x + moved.y) / (2.0f * float(radius)) + 1e-4f) << x << ", " << y;
                partial += frame.normal.at(x, y).w > 0.01f && frame.normal.at(x, y).w < 0.99f;
            }
        EXPECT_GT(partial, 1000);
    }
}

TEST_P(GlBackend, ReportsPositionNormalAndSky) {
    QuadOverFloor const world;
    ScenePass pass = world.pass({160, 120}, 256);
    pass.frame.sky = {0.0f, 0.5f, 1.0f, 1.0f};
    Frame const frame = draw_quad_over_floor(*backend, world, pass);
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

float eye_depth(ScenePass const& pass, Texel4 const& p) {
    return glm::dot(glm::vec3(pass.frame.eye_forward),
                    glm::vec3(p.x, p.y, p.z) - glm::vec3(pass.frame.eye_position));
}

TEST_P(GlBackend, ChoosesAndBlendsMapsByEyeDepth) {
    QuadOverFloor const world;
    ScenePass pass = world.pass({160, 120}, 512);
    pass.frame.map_count = 2;
    pass.frame.maps[0].bias_constant = rounding_bias;
    pass.frame.maps[1] = pass.frame.maps[0];
    pass.frame.maps[1].bias_constant = 1.0f;  // the second map calls everything lit
    pass.frame.maps[0].blend_begin = 8.0f;
    pass.frame.maps[0].depth_end = 11.0f;
    pass.frame.maps[1].depth_end = 12.0f;
    Frame const frame = draw_quad_over_floor(*backend, world, pass);
    std::array<int, 3> used{};
    int blended = 0;
    for (std::size_t i = 0; i < frame.position.pixels.size(); ++i) {
        Texel4 const& p = frame.position.pixels[i];
        if (is_sky(p)) continue;
        float const depth = eye_depth(pass, p);
        if (std::fabs(depth - 11.0f) < 1e-3f || std::fabs(depth - 12.0f) < 1e-3f) continue;
        float const expected = depth < 11.0f ? 0.0f : depth < 12.0f ? 1.0f : -1.0f;
        ASSERT_EQ(p.w, expected);
        ++used[std::size_t(expected + 1.0f)];
        if (!is_floor(p) || world.metres_into_shadow({p.x, p.y, p.z}) < 0.1f) continue;
        float const share = std::fmin(std::fmax((depth - 8.0f) / 3.0f, 0.0f), 1.0f);
        EXPECT_NEAR(frame.normal.pixels[i].w, share, 1e-4f);
        blended += share > 0.1f && share < 0.9f;
    }
    EXPECT_GT(used[0], 100);
    EXPECT_GT(used[1], 100);
    EXPECT_GT(used[2], 100);
    EXPECT_GT(blended, 100);
}

TEST_P(GlBackend, ChoosesTheFirstMapThatHoldsThePointAndItsFilter) {
    QuadOverFloor const world;
    ScenePass pass = world.pass({160, 120}, 128);
    pass.frame.map_count = 2;
    pass.frame.choice = MapChoice::by_map;
    pass.frame.filter_radius = 1;
    glm::mat4 const sun = world.clip_from_world_of_sun();
    pass.frame.maps[0].clip_from_world = glm::scale(glm::mat4(1.0f), glm::vec3(4.0f, 4.0f, 1.0f)) * sun;
    pass.frame.maps[1].clip_from_world = glm::scale(glm::mat4(1.0f), glm::vec3(2.0f, 2.0f, 1.0f)) * sun;
    Frame const frame = draw_quad_over_floor(*backend, world, pass);
    std::array<int, 3> used{};
    for (Texel4 const& p : frame.position.pixels) {
        if (is_sky(p)) continue;
        glm::vec2 const ndc = glm::abs(glm::vec2(sun * glm::vec4(p.x, p.y, p.z, 1.0f)));
        float const reach = std::fmax(ndc.x, ndc.y);
        float const margin = 1.0f - 2.0f * 2.0f / 128.0f;  // radius + 1 texels at either side
        if (std::fabs(4.0f * reach - margin) < 1e-4f || std::fabs(2.0f * reach - margin) < 1e-4f) continue;
        float const expected = 4.0f * reach < margin ? 0.0f : 2.0f * reach < margin ? 1.0f : -1.0f;
        ASSERT_EQ(p.w, expected);
        ++used[std::size_t(expected + 1.0f)];
    }
    for (int const count : used) EXPECT_GT(count, 100);
}

TEST_P(GlBackend, PointsThatAMapCannotHoldAreLit) {
    QuadOverFloor const world;
    auto const shadowed_pixels = [&](std::function<void(FrameConstants&)> const& change) {
        ScenePass pass = world.pass({160, 120}, 256);
        pass.frame.maps[0].bias_constant = rounding_bias;
        change(pass.frame);
        Frame const frame = draw_quad_over_floor(*backend, world, pass);
        int count = 0;
        for (Texel4 const& normal : frame.normal.pixels) {
            EXPECT_TRUE(normal.w >= 0.0f && normal.w <= 1.0f);
            count += normal.w < 1.0f;
        }
        return count;
    };
    EXPECT_GT(shadowed_pixels([](FrameConstants&) {}), 200);
    EXPECT_EQ(shadowed_pixels([](FrameConstants& f) { f.maps[0].w_min = 2.0f; }), 0);
    EXPECT_EQ(shadowed_pixels([](FrameConstants& f) { f.maps[0].depth_end = 0.0f; }), 0);
    EXPECT_EQ(shadowed_pixels([](FrameConstants& f) { f.maps[0].clip_from_world[3][0] += 1e30f; }), 0);
    EXPECT_EQ(shadowed_pixels([](FrameConstants& f) { f.maps[0].clip_from_world = glm::mat4(0.0f); }), 0);
    EXPECT_EQ(shadowed_pixels([](FrameConstants& f) { f.maps[0].bias_slope_texels = NAN; }), 0);
    // Casters and receivers beyond the map's range in depth: all of them store and compare as the far end.
    EXPECT_EQ(shadowed_pixels([](FrameConstants& f) { f.maps[0].clip_from_world[3][2] += 3.0f; }), 0);
}

TEST_P(GlBackend, ASpotLightsMapAgreesWithItsGeometryAndItsConeEndsTheLight) {
    QuadOverFloor const world;
    glm::vec3 const light(0.0f, 5.0f, 0.0f);
    float const cos_half_angle = std::cos(0.7f);
    ScenePass pass = world.pass({320, 240}, 512);
    pass.frame.light = glm::vec4(light, 1.0f);
    pass.frame.spot_axis = {0.0f, -1.0f, 0.0f, cos_half_angle};
    pass.frame.maps[0].clip_from_world = glm::perspectiveRH_ZO(1.4f, 1.0f, 0.5f, 10.0f) *
                                         glm::lookAtRH(light, glm::vec3(0.0f), glm::vec3(0, 0, -1));
    pass.frame.maps[0].bias_constant = rounding_bias;
    pass.frame.filter_radius = 1;
    Frame const frame = draw_quad_over_floor(*backend, world, pass);
    int dark = 0, lit = 0, outside = 0;
    for (std::size_t i = 0; i < frame.position.pixels.size(); ++i) {
        Texel4 const& p = frame.position.pixels[i];
        if (!is_floor(p) || is_sky(p)) continue;
        // The quad, 3 m below the light, casts a square 5/3 times its size on the floor, 5 m below.
        float const into_shadow = 5.0f / 3.0f - std::fmax(std::fabs(p.x), std::fabs(p.z));
        float const into_cone = 5.0f * std::tan(0.7f) - std::hypot(p.x, p.z);
        if (std::fabs(into_shadow) < 0.1f || std::fabs(into_cone) < 0.01f) continue;
        bool const expect_lit = into_shadow < 0.0f && into_cone > 0.0f;
        ASSERT_EQ(frame.normal.pixels[i].w, expect_lit ? 1.0f : 0.0f) << p.x << ", " << p.z;
        ++(into_cone < 0.0f ? outside : expect_lit ? lit : dark);
    }
    EXPECT_GT(dark, 1000);
    EXPECT_GT(lit, 1000);
    EXPECT_GT(outside, 1000);
}

TEST_P(GlBackend, ObjectsThatReceiveNothingAreLit) {
    QuadOverFloor world;
    world.scene.objects[QuadOverFloor::floor].receives = false;
    Frame const frame = draw_quad_over_floor(*backend, world, world.pass({160, 120}, 256));
    for (std::size_t i = 0; i < frame.normal.pixels.size(); ++i)
        if (is_floor(frame.position.pixels[i])) {
            EXPECT_EQ(frame.normal.pixels[i].w, 1.0f);
            EXPECT_EQ(frame.position.pixels[i].w, -1.0f);
        }
}

TEST_P(GlBackend, DrawsTheSameTwiceAndAfterOtherSizes) {
    QuadOverFloor const world;
    auto const colours = [&](Extent extent, int map_size) {
        Frame const frame = draw_quad_over_floor(*backend, world, world.pass(extent, map_size));
        std::vector<std::uint32_t> packed;
        for (Rgba8 const& c : frame.colour.pixels) packed.push_back(std::uint32_t{c.r} << 16u | std::uint32_t{c.g} << 8u | c.b);
        return packed;
    };
    auto const first = colours({160, 120}, 256);
    EXPECT_EQ(colours({160, 120}, 256), first);
    EXPECT_NE(colours({33, 77}, 100), first);
    EXPECT_EQ(colours({160, 120}, 256), first);
}

TEST_P(GlBackend, TellsWhatTheDriverRefusesAndGoesOn) {
    DepthLayer const layer;
    EXPECT_THROW(backend->draw_depth({1 << 20, {&layer, 1}, true}), std::runtime_error);
    EXPECT_FALSE(backend->take_messages().empty()) << "the driver's own error was not heard";
    EXPECT_TRUE(backend->take_messages().empty()) << "messages are told once";
    EXPECT_EQ(draw_in_clip(*backend, Scene{}, 4, true, {}).pixels, std::vector<float>(16, 1.0f));
}

TEST_P(GlBackend, RejectsPassesThatCannotBeDrawn) {
    DepthLayer layer;
    std::array<std::uint32_t, 1> const missing{7};
    EXPECT_THROW(backend->draw_depth({64, {}, true}), std::runtime_error);
    EXPECT_THROW(backend->draw_depth({0, {&layer, 1}, true}), std::runtime_error);
    layer.objects = missing;
    EXPECT_THROW(backend->draw_depth({64, {&layer, 1}, true}), std::runtime_error);
    ScenePass pass{{8, 8}, {}};
    pass.frame.map_count = 2;
    EXPECT_THROW(backend->draw_scene(pass), std::runtime_error);
    Scene scene = triangles({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    scene.indices[1] = 9;
    EXPECT_THROW(backend->upload(scene), std::runtime_error);
}

TEST(GlContexts, TwoKindsTakeTurnsInOneProcessAndDrawTheSameBits) {
    auto const egl = make_gl_backend(GlContextKind::egl);
    auto const osmesa = make_gl_backend(GlContextKind::osmesa);
    std::mt19937 random(7);
    auto const coordinate = [&random] { return float(random() >> 8) * 0x1p-23f - 1.0f; };
    std::vector<glm::vec3> corners(3 * 200);
    for (glm::vec3& corner : corners)
        for (int axis = 0; axis < 3; ++axis) corner[axis] = coordinate();
    Scene const scene = triangles(corners);
    std::vector<std::uint32_t> all(scene.objects.size());
    std::iota(all.begin(), all.end(), 0u);

    auto const in_egl = draw_in_clip(*egl, scene, 256, true, all).pixels;
    auto const in_osmesa = draw_in_clip(*osmesa, scene, 256, true, all).pixels;
    EXPECT_EQ(draw_in_clip(*egl, scene, 256, true, all).pixels, in_egl);
    EXPECT_TRUE(egl->take_messages().empty());
    EXPECT_TRUE(osmesa->take_messages().empty());
    if (egl->info().driver != osmesa->info().driver) GTEST_SKIP() << "EGL drives " << egl->info().driver;
    EXPECT_EQ(in_egl, in_osmesa);
}

TEST(GlContexts, OneOfAKindOutlivesAnother) {
    for (GlContextKind const kind : {GlContextKind::egl, GlContextKind::osmesa}) {
        auto survivor = make_gl_backend(kind);
        make_gl_backend(kind).reset();
        EXPECT_EQ(draw_in_clip(*survivor, Scene{}, 4, true, {}).pixels, std::vector<float>(16, 1.0f));
        EXPECT_TRUE(survivor->take_messages().empty());
    }
}

TEST(GlContextsDeathTest, AMissingDriverIsOneSentence) {
    testing::GTEST_FLAG(death_test_style) = "threadsafe";
    auto const report = [] {
        setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nonexistent.json", 1);
        try {
            auto const backend = make_gl_backend(GlContextKind::egl);
        } catch (std::runtime_error const& error) {
            std::cerr << error.what() << '\n';
            std::exit(3);
        }
    };
    EXPECT_EXIT(report(), testing::ExitedWithCode(3), "no OpenGL 4.5 core context.*libegl1");
}

TEST(NullBackend, RecordsWhatItIsAsked) {
    NullBackend backend;
    QuadOverFloor const world;
    ScenePass const pass = world.pass({16, 12}, 32);
    Frame const frame = draw_quad_over_floor(backend, world, pass);
    EXPECT_TRUE(backend.take_messages().empty());
    ASSERT_EQ(backend.calls().size(), 4u);
    EXPECT_EQ(std::get<UploadCall>(backend.calls()[0]).object_count, 2u);
    auto const& depth = std::get<DrawDepthCall>(backend.calls()[1]);
    EXPECT_EQ(depth.map_size, 32);
    ASSERT_EQ(depth.layers.size(), 1u);
    EXPECT_EQ(depth.layers[0].clip_from_world, world.clip_from_world_of_sun());
    EXPECT_EQ(depth.layers[0].objects, (std::vector<std::uint32_t>{0, 1}));
    EXPECT_EQ(std::get<DrawSceneCall>(backend.calls()[2]).pass.extent.width, 16);
    EXPECT_TRUE(std::holds_alternative<ReadFrameCall>(backend.calls()[3]));
    ASSERT_EQ(frame.colour.pixels.size(), 16u * 12u);
    EXPECT_EQ(frame.position.at(3, 3).w, -2.0f);
    EXPECT_EQ(backend.read_depth(0).pixels, std::vector<float>(32 * 32, 1.0f));
}

TEST(NullBackend, SaysWhatIsWrongWithACall) {
    NullBackend backend;
    QuadOverFloor const world;
    auto const complaint_of = [&](auto const& call) {
        backend.upload(world.scene);
        DepthLayer const layer{glm::mat4(1.0f), {}};
        backend.draw_depth({8, {&layer, 1}, true});
        EXPECT_TRUE(backend.take_messages().empty());
        call();
        auto const messages = backend.take_messages();
        return messages.size() == 1 ? messages[0] : std::string();
    };
    auto const depth_with = [&](auto const& change) {
        std::vector<DepthLayer> layers(1);
        std::vector<std::uint32_t> objects{0};
        DepthPass pass;
        change(pass, layers, objects);
        for (DepthLayer& layer : layers) layer.objects = objects;
        pass.layers = layers;
        return complaint_of([&] { backend.draw_depth(pass); });
    };
    auto const scene_with = [&](auto const& change) {
        ScenePass pass = world.pass({8, 8}, 8);
        change(pass);
        return complaint_of([&] { backend.draw_scene(pass); });
    };
    EXPECT_EQ(depth_with([](auto&, auto&, auto&) {}), "");
    EXPECT_EQ(depth_with([](auto& pass, auto&, auto&) { pass.map_size = 0; }), "depth pass: map_size is 0");
    EXPECT_EQ(depth_with([](auto&, auto& layers, auto&) { layers.clear(); }), "depth pass: 0 layers, not 1 to 8");
    EXPECT_EQ(depth_with([](auto&, auto& layers, auto&) { layers.resize(9); }), "depth pass: 9 layers, not 1 to 8");
    EXPECT_EQ(depth_with([](auto&, auto&, auto& objects) { objects[0] = 2; }),
              "depth pass: layer 0 draws object 2, which is not there");
    EXPECT_EQ(depth_with([](auto&, auto& layers, auto&) { layers[0].clip_from_world[2][1] = NAN; }),
              "depth pass: layer 0 has a matrix that is not finite");
    EXPECT_EQ(scene_with([](auto&) {}), "");
    EXPECT_EQ(scene_with([](auto& pass) { pass.extent.width = 0; }), "scene pass: the extent is empty");
    EXPECT_EQ(scene_with([](auto& pass) { pass.frame.map_count = 2; }), "scene pass: reads 2 maps, but 1 are drawn");
    EXPECT_EQ(scene_with([](auto& pass) { pass.frame.filter_radius = 3; }), "scene pass: filter_radius is not 0, 1 or 2");
    EXPECT_EQ(scene_with([](auto& pass) { pass.frame.maps[0].clip_from_world[0][0] = INFINITY; }),
              "scene pass: map 0 has a matrix that is not finite");
    EXPECT_EQ(complaint_of([&] { static_cast<void>(backend.read_depth(1)); }), "read_depth: layer 1 of 1");
    Scene broken = world.scene;
    broken.objects[1].index_count = 300;
    EXPECT_EQ(complaint_of([&] { backend.upload(broken); }),
              "scene 'quad_over_floor': object 1 reaches past the last index");
}

}  // namespace
