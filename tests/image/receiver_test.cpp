// SPDX-License-Identifier: MIT
//
// The receiver pass against geometry: where shadows fall and which map is read. What is shaded: shading_test.cpp.
#include "tests/image/contexts.hpp"
#include "tests/image/quad_over_floor.hpp"

#include <functional>
#include <limits>

namespace {

using namespace shadowmath::image_test;

constexpr float epsilon = std::numeric_limits<float>::epsilon();

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

class Receiver : public InContext {};
INSTANTIATE_TEST_SUITE_P(Contexts, Receiver, every_context, context_name);

// Without bias but for rounding: the tap's plane depth is exact. Map depths lie in [0, 1], formed from products and
// sums of terms below 2, in the vertex shader, the rasteriser and the receiver: 32 roundings are generous.
constexpr float rounding_bias = 32.0f * epsilon;

TEST_P(Receiver, ShadowFallsWhereGeometrySaysAndNowhereElse) {
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

TEST_P(Receiver, WithoutBiasOrTapPlaneTheFloorHasAcne) {
    QuadOverFloor const world;
    ScenePass pass = world.pass({320, 240}, 512);
    pass.frame.tap_plane = 0;
    EXPECT_GT(compare_with_geometry(world, draw_quad_over_floor(*backend, world, pass), 0.1f).wrong, 10000);

    pass.frame.maps[0].bias_slope_texels = 0.5f;
    EXPECT_EQ(compare_with_geometry(world, draw_quad_over_floor(*backend, world, pass), 0.1f).wrong, 0);
    pass.frame.maps[0].slope_limit = 0.0f;  // a slope that nobody believes gives no bias
    EXPECT_GT(compare_with_geometry(world, draw_quad_over_floor(*backend, world, pass), 0.1f).wrong, 10000);
}

TEST_P(Receiver, FilteredVisibilityIsContinuousAcrossThePicture) {
    QuadOverFloor const world;
    glm::mat4 const centred = world.clip_from_world_of_sun();
    float const shadow_x = (centred * glm::vec4(1.0f, 0.0f, 0.5f, 1.0f)).x;
    glm::mat4 const shadow_on_the_border = glm::translate(glm::mat4(1.0f), glm::vec3(1.0f - shadow_x, 0, 0)) * centred;
    for (auto const& [radius, sun] :
         {std::pair(1, centred), {2, centred}, {1, shadow_on_the_border}, {2, shadow_on_the_border}}) {
        ScenePass pass = world.pass({640, 480}, 64);
        pass.frame.filter_radius = radius;
        pass.frame.maps[0].clip_from_world = sun;
        // The plane's normal comes from differences of positions that round by 4 epsilon of their distance, a pixel
        // (0.002 of the distance) apart: 2.4e-4 rad. Over 2.5 texels of 0.25 m on both axes, on a slope whose secant is
        // 1.15, that is 2.8e-4 m or 1.8e-5 of the map's 16 m.
        pass.frame.maps[0].bias_constant = 2e-5f;
        Frame const frame = draw_quad_over_floor(*backend, world, pass);
        auto const texel_of = [map = sun](Texel4 const& p) {
            return glm::vec2(map * glm::vec4(p.x, p.y, p.z, 1.0f)) * 32.0f;
        };
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

float eye_depth(ScenePass const& pass, Texel4 const& p) {
    return glm::dot(glm::vec3(pass.frame.eye_forward), glm::vec3(p.x, p.y, p.z) - glm::vec3(pass.frame.eye_position));
}

TEST_P(Receiver, ChoosesAndBlendsMapsByEyeDepth) {
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

TEST_P(Receiver, BlendsTheLastMapIntoLight) {
    QuadOverFloor const world;
    ScenePass pass = world.pass({160, 120}, 512);
    pass.frame.maps[0].bias_constant = rounding_bias;
    pass.frame.maps[0].blend_begin = 8.0f;
    pass.frame.maps[0].depth_end = 11.0f;
    pass.frame.maps[1] = pass.frame.maps[0];  // beyond map_count: not to be read
    Frame const frame = draw_quad_over_floor(*backend, world, pass);
    int blended = 0;
    for (std::size_t i = 0; i < frame.position.pixels.size(); ++i) {
        Texel4 const& p = frame.position.pixels[i];
        if (!is_floor(p) || world.metres_into_shadow({p.x, p.y, p.z}) < 0.1f) continue;
        float const share = std::fmin(std::fmax((eye_depth(pass, p) - 8.0f) / 3.0f, 0.0f), 1.0f);
        EXPECT_NEAR(frame.normal.pixels[i].w, share, 1e-4f);
        blended += share > 0.1f && share < 0.9f;
    }
    EXPECT_GT(blended, 100);
}

TEST_P(Receiver, ChoosesTheFirstMapThatHoldsThePointAndItsFilter) {
    QuadOverFloor const world;
    ScenePass pass = world.pass({160, 120}, 128);
    pass.frame.map_count = 3;
    pass.frame.choice = MapChoice::by_map;
    pass.frame.filter_radius = 1;
    glm::mat4 const sun = world.clip_from_world_of_sun();
    pass.frame.maps[0].clip_from_world =
        glm::translate(glm::mat4(1.0f), glm::vec3(0, 0, 1)) * sun;  // everything beyond it
    pass.frame.maps[1].clip_from_world = glm::scale(glm::mat4(1.0f), glm::vec3(4, 4, 1)) * sun;
    pass.frame.maps[2].clip_from_world = glm::scale(glm::mat4(1.0f), glm::vec3(2, 2, 1)) * sun;
    Frame const frame = draw_quad_over_floor(*backend, world, pass);
    std::array<int, 4> used{};
    for (Texel4 const& p : frame.position.pixels) {
        if (is_sky(p)) continue;
        glm::vec2 const ndc = glm::abs(glm::vec2(sun * glm::vec4(p.x, p.y, p.z, 1.0f)));
        float const reach = std::fmax(ndc.x, ndc.y);
        float const margin = 1.0f - 2.0f * 2.0f / 128.0f;  // radius + 1 texels at either side
        if (std::fabs(4.0f * reach - margin) < 1e-4f || std::fabs(2.0f * reach - margin) < 1e-4f) continue;
        float const expected = 4.0f * reach < margin ? 1.0f : 2.0f * reach < margin ? 2.0f : -1.0f;
        ASSERT_EQ(p.w, expected);
        ++used[std::size_t(expected + 1.0f)];
    }
    EXPECT_GT(used[0], 100);
    EXPECT_EQ(used[1], 0);
    EXPECT_GT(used[2], 100);
    EXPECT_GT(used[3], 100);
}

TEST_P(Receiver, PointsThatAMapCannotHoldAreLit) {
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

TEST_P(Receiver, ASpotLightsMapAgreesWithItsGeometryAndItsConeEndsTheLight) {
    QuadOverFloor const world;
    glm::vec3 const light(0.0f, 5.0f, 0.0f);
    float const cos_half_angle = std::cos(0.7f);
    ScenePass pass = world.pass({320, 240}, 512);
    pass.frame.light = glm::vec4(light, 1.0f);
    pass.frame.spot_axis = {0.0f, -1.0f, 0.0f, cos_half_angle};
    pass.frame.maps[0].clip_from_world =
        glm::perspectiveRH_ZO(1.4f, 1.0f, 0.5f, 10.0f) * glm::lookAtRH(light, glm::vec3(0.0f), glm::vec3(0, 0, -1));
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

// The spot light's map is perspective, so depth on a plane is not linear in world units, only in texels.
TEST_P(Receiver, ATiltedSpotLightsMapShowsNoAcneOnTheFloor) {
    QuadOverFloor world;
    world.scene.objects.pop_back();
    world.scene.objects.push_back({6u, 0u, {}, {}, true, true});  // the quad, emptied
    glm::vec3 const light(-5.0f, 4.0f, -3.0f);
    ScenePass pass = world.pass({320, 240}, 128);
    pass.frame.light = glm::vec4(light, 1.0f);
    pass.frame.maps[0].clip_from_world =
        glm::perspectiveRH_ZO(1.2f, 1.0f, 0.5f, 20.0f) * glm::lookAtRH(light, glm::vec3(0.0f), glm::vec3(0, 1, 0));
    pass.frame.choice = MapChoice::by_map;
    pass.frame.filter_radius = 2;
    pass.frame.maps[0].bias_constant = 2e-5f;  // the noise of the plane's normal, as above
    Frame const frame = draw_quad_over_floor(*backend, world, pass);
    int held = 0, dark = 0;
    for (std::size_t i = 0; i < frame.position.pixels.size(); ++i) {
        held += frame.position.pixels[i].w == 0.0f;
        dark += frame.normal.pixels[i].w < 1.0f;
    }
    EXPECT_GT(held, 10000);
    EXPECT_EQ(dark, 0);
}

// Depth is a + b / w with b = -n f / (f - n); quad and floor lie at w = 3 and 5, so that b (1/5 - 1/3) parts them in
// depth and a bias of 2/3 |b| over w = 5 closes the gap.
TEST_P(Receiver, BiasWIsDividedByClipW) {
    QuadOverFloor const world;
    glm::vec3 const light(0.0f, 5.0f, 0.0f);
    float const b = 0.5f * 10.0f / 9.5f;
    ScenePass pass = world.pass({160, 120}, 256);
    pass.frame.light = glm::vec4(light, 1.0f);
    pass.frame.maps[0].clip_from_world =
        glm::perspectiveRH_ZO(1.4f, 1.0f, 0.5f, 10.0f) * glm::lookAtRH(light, glm::vec3(0.0f), glm::vec3(0, 0, -1));
    for (float const share : {0.65f, 0.68f}) {
        pass.frame.maps[0].bias_w = share * b;
        Frame const frame = draw_quad_over_floor(*backend, world, pass);
        int inside = 0;
        for (std::size_t i = 0; i < frame.position.pixels.size(); ++i) {
            Texel4 const& p = frame.position.pixels[i];
            if (!is_floor(p) || std::fmax(std::fabs(p.x), std::fabs(p.z)) > 1.5f) continue;
            EXPECT_EQ(frame.normal.pixels[i].w, share < 2.0f / 3.0f ? 0.0f : 1.0f);
            ++inside;
        }
        EXPECT_GT(inside, 500);
    }
}

TEST_P(Receiver, APlaneThatTheLightGrazesStaysFinite) {
    QuadOverFloor world;
    world.light_travel = {1.0f, 0.0f, 0.0f};
    for (int radius : {0, 1, 2}) {
        ScenePass pass = world.pass({160, 120}, 256);
        pass.frame.filter_radius = radius;
        pass.frame.maps[0].bias_slope_texels = 1.0f;
        Frame const frame = draw_quad_over_floor(*backend, world, pass);
        for (Texel4 const& normal : frame.normal.pixels) EXPECT_TRUE(normal.w >= 0.0f && normal.w <= 1.0f) << normal.w;
    }
}

TEST_P(Receiver, ObjectsThatReceiveNothingAreLit) {
    QuadOverFloor world;
    world.scene.objects[QuadOverFloor::floor].receives = false;
    Frame const frame = draw_quad_over_floor(*backend, world, world.pass({160, 120}, 256));
    for (std::size_t i = 0; i < frame.normal.pixels.size(); ++i)
        if (is_floor(frame.position.pixels[i])) {
            EXPECT_EQ(frame.normal.pixels[i].w, 1.0f);
            EXPECT_EQ(frame.position.pixels[i].w, -1.0f);
        }
}

}  // namespace
