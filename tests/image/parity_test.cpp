// SPDX-License-Identifier: MIT
//
// The same matrix gives the same map and the same picture, whichever API draws it and in whichever form the driver got
// the shaders. Exactly so on Mesa's software drivers, which share a rasteriser; on other drivers these are skipped.
#include "tests/image/contexts.hpp"
#include "tests/image/quad_over_floor.hpp"
#include "tests/image/triangles.hpp"

#include "scenes/scenes.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <iostream>

namespace {

using namespace shadowmath::image_test;

// Two backends that are to agree: `reference` on OpenGL, `other` on OpenGL or Vulkan.
struct Pair {
    char const* name;
    std::unique_ptr<Backend> (*open_other)();
};

void PrintTo(Pair const& pair, std::ostream* out) {
    *out << pair.name;
}

std::unique_ptr<Backend> open_vulkan() {
    std::unique_ptr<Backend> backend;
    static_cast<void>(try_vulkan(backend, {.software = true, .validation = true}));
    return backend;
}
std::unique_ptr<Backend> open_osmesa() {
    return make_gl_backend(GlContextKind::osmesa);
}
std::unique_ptr<Backend> open_text() {
    return make_gl_backend(GlContextKind::egl, GlShaders::text);
}

class Parity : public testing::TestWithParam<Pair> {
protected:
    void SetUp() override {
        reference = make_gl_backend(GlContextKind::egl);
        other = GetParam().open_other();
        if (other == nullptr) GTEST_SKIP() << not_tested;
        if (reference->info().driver.find("llvmpipe") == std::string::npos)
            GTEST_SKIP() << "NOT TESTED: EGL drives " << reference->info().driver << ", another rasteriser";
    }
    void TearDown() override {
        for (Backend* backend : {reference.get(), other.get()})
            if (backend != nullptr)
                for (std::string const& message : backend->take_messages()) ADD_FAILURE() << "driver: " << message;
    }

    std::unique_ptr<Backend> reference, other;
};

INSTANTIATE_TEST_SUITE_P(WithEgl, Parity,
                         testing::Values(Pair{"vulkan", open_vulkan}, Pair{"osmesa", open_osmesa},
                                         Pair{"glsl_text", open_text}),
                         [](auto const& pair) { return std::string(pair.param.name); });

struct MapDifference {
    int covered = 0;  // texels that hold a caster in the reference
    int coverage = 0;
    int ulp = 0;  // the largest
};

// Depths lie in [0, 1], where the order of floats is that of their bits.
MapDifference difference(Image<float> const& a, Image<float> const& b) {
    MapDifference d;
    EXPECT_EQ(a.pixels.size(), b.pixels.size());
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        d.covered += a.pixels[i] < 1.0f;
        d.coverage += (a.pixels[i] < 1.0f) != (b.pixels[i] < 1.0f);
        d.ulp = std::max(d.ulp, std::abs(std::bit_cast<std::int32_t>(a.pixels[i] + 0.0f) -
                                         std::bit_cast<std::int32_t>(b.pixels[i] + 0.0f)));
    }
    return d;
}

TEST_P(Parity, DepthMapsOfRandomTrianglesCoverTheSameTexelsWithinTwoUlp) {
    glm::mat4 const seen_in_perspective =
        glm::perspectiveRH_ZO(1.2f, 1.0f, 0.3f, 4.0f) *
        glm::lookAtRH(glm::vec3(0.4f, 0.9f, 1.6f), glm::vec3(0.0f), glm::vec3(0, 1, 0));
    MapDifference worst;
    for (std::uint32_t seed = 1; seed <= 20; ++seed) {
        Scene const scene = random_triangles(seed, 100);
        bool const perspective = seed % 2 == 0, clamp = seed % 4 < 2;
        auto const map = [&](Backend& backend) {
            return draw_map(backend, scene, seed % 3 == 0 ? 256 : 193, clamp, all_objects(scene),
                            perspective ? seen_in_perspective : glm::mat4(1.0f));
        };
        MapDifference const d = difference(map(*reference), map(*other));
        EXPECT_GT(d.covered, 10000);
        worst = {worst.covered + d.covered, worst.coverage + d.coverage, std::max(worst.ulp, d.ulp)};
    }
    std::cout << GetParam().name << ": of " << worst.covered << " covered texels " << worst.coverage
              << " are covered in one only; depth differs by at most " << worst.ulp << " ulp\n";
    EXPECT_EQ(worst.coverage, 0);
    EXPECT_LE(worst.ulp, 2);
}

// A map of the whole scene along the view's sun, and the view itself.
ScenePass pass_of(Scene const& scene, shadowmath::scenes::View const& view, Extent extent, int map_size) {
    glm::vec3 const eye(view.eye), forward(view.forward), travel(view.light_travel);
    glm::vec3 const centre = 0.5f * (scene.lo + scene.hi);
    float const radius = 0.5f * glm::length(scene.hi - scene.lo);
    glm::vec3 const up = std::fabs(travel.y) < 0.9f ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
    ScenePass pass{extent, {}};
    FrameConstants& frame = pass.frame;
    frame.clip_from_world = glm::perspectiveRH_ZO(float(view.fov_y_radians), float(extent.width) / float(extent.height),
                                                  float(view.z_near), 2000.0f) *
                            glm::lookAtRH(eye, eye + forward, glm::vec3(view.up));
    frame.eye_position = glm::vec4(eye, 1.0f);
    frame.eye_forward = glm::vec4(forward, 0.0f);
    frame.light = glm::vec4(-travel, 0.0f);
    frame.map_count = 1;
    frame.filter_radius = 1;
    frame.map_size = float(map_size);
    frame.maps[0].clip_from_world = glm::orthoRH_ZO(-radius, radius, -radius, radius, 0.0f, 2.0f * radius) *
                                    glm::lookAtRH(centre - radius * travel, centre, up);
    frame.maps[0].depth_end = frame.maps[0].blend_begin = 2000.0f;
    frame.maps[0].bias_constant = 1e-4f;
    return pass;
}

// Of a scene that is there already.
Frame draw_with_one_map(Backend& backend, Scene const& scene, ScenePass const& pass) {
    std::vector<std::uint32_t> casters;
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i)
        if (scene.objects[i].casts) casters.push_back(i);
    DepthLayer const layer{pass.frame.maps[0].clip_from_world, casters};
    backend.draw_depth({int(pass.frame.map_size), {&layer, 1}, true});
    backend.draw_scene(pass);
    return backend.read_frame();
}

int difference(Rgba8 a, Rgba8 b) {
    return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

// An outline or the border of a shadow runs through the pixel or touches it.
bool is_edge(Frame const& frame, int x, int y) {
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, frame.colour.extent.height - 1); ++v)
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, frame.colour.extent.width - 1); ++u)
            if (difference(frame.colour.at(u, v), frame.colour.at(x, y)) > 4) return true;
    return false;
}

TEST_P(Parity, PicturesOfTheScenesDifferAtEdgesOnly) {
    constexpr Extent extent{320, 180};
    for (std::string_view const name : shadowmath::scenes::scene_names()) {
        auto const named = shadowmath::scenes::make_scene(name, shadowmath::scenes::SceneSize::small);
        int pixels = 0, unlike = 0, unlike_off_edges = 0;
        MapDifference maps;
        reference->upload(named.scene);
        other->upload(named.scene);
        for (auto const& view : named.views) {
            if (view.has_spot) continue;
            ScenePass const pass = pass_of(named.scene, view, extent, 512);
            Frame const a = draw_with_one_map(*reference, named.scene, pass);
            Frame const b = draw_with_one_map(*other, named.scene, pass);
            MapDifference const d = difference(reference->read_depth(0), other->read_depth(0));
            maps = {maps.covered + d.covered, maps.coverage + d.coverage, std::max(maps.ulp, d.ulp)};
            for (int y = 0; y < extent.height; ++y)
                for (int x = 0; x < extent.width; ++x) {
                    bool const differs = difference(a.colour.at(x, y), b.colour.at(x, y)) > 0;
                    ++pixels;
                    unlike += differs;
                    unlike_off_edges += differs && !is_edge(a, x, y);
                }
        }
        std::cout << GetParam().name << ", " << name << ": " << maps.coverage << " of " << maps.covered
                  << " texels covered in one only, depth within " << maps.ulp << " ulp; " << unlike << " of " << pixels
                  << " pixels unlike, " << unlike_off_edges << " of them off edges\n";
        EXPECT_GT(maps.covered, 10000);
        EXPECT_EQ(maps.coverage, 0);
        EXPECT_LE(maps.ulp, 2);
        EXPECT_LE(unlike, pixels / 1000);
        EXPECT_EQ(unlike_off_edges, 0);
    }
}

TEST(ShaderSource, OpenGlTakesTheCompiledWordsWhereTheyAreThere) {
    auto const egl = make_gl_backend(GlContextKind::egl);
    auto const text = make_gl_backend(GlContextKind::egl, GlShaders::text);
    EXPECT_EQ(text->info().shaders, "GLSL");
    if (egl->info().driver.find("llvmpipe") == std::string::npos) GTEST_SKIP() << "NOT TESTED on another driver";
    std::unique_ptr<Backend> vulkan;
    if (!try_vulkan(vulkan, {})) GTEST_SKIP() << "NOT TESTED: the build may have had no glslangValidator";
    EXPECT_EQ(egl->info().shaders, "SPIR-V");
    EXPECT_EQ(vulkan->info().shaders, "SPIR-V");
}

// As on a driver that cannot take compiled words. Mesa reads the variable once in a process, before its first context.
TEST(ShaderSourceDeathTest, OpenGlFallsBackToTextWhereTheExtensionIsAbsent) {
    testing::GTEST_FLAG(death_test_style) = "threadsafe";
    auto const report = [] {
        setenv("MESA_EXTENSION_OVERRIDE", "-GL_ARB_gl_spirv", 1);
        auto const egl = make_gl_backend(GlContextKind::egl);
        QuadOverFloor const world;
        Frame const frame = draw_quad_over_floor(*egl, world, world.pass({64, 48}, 64));
        auto const is_dark = [](Texel4 const& normal) { return normal.w == 0.0f; };
        bool const shadowed = std::ranges::any_of(frame.normal.pixels, is_dark) && egl->take_messages().empty();
        bool const mesa = egl->info().driver.find("Mesa") != std::string::npos;
        std::cerr << (mesa ? egl->info().shaders : "GLSL") << (shadowed ? ", with a shadow\n" : ", without\n");
        std::exit(0);
    };
    EXPECT_EXIT(report(), testing::ExitedWithCode(0), "^GLSL, with a shadow\n$");
}

}  // namespace
