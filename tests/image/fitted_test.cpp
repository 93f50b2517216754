// SPDX-License-Identifier: MIT
//
// Maps that are fitted on the device to what the eye sees, and used without a look by the CPU: on every driver the
// constants are those that the C++ makes of the same depths, and so are the maps and the picture.
#include "backends/sdsm_passes.hpp"
#include "tests/image/contexts.hpp"

#include "scenes/scenes.hpp"

#include <shadowmath/gpu_samples.hpp>

#include <algorithm>
#include <iostream>

namespace {

using namespace shadowmath;
using namespace shadowmath::image_test;

class Fitted : public InContext {};
INSTANTIATE_TEST_SUITE_P(EveryContext, Fitted, every_context, context_name);

constexpr Extent extent{320, 180};
constexpr int map_size = 512;
constexpr ClipSpace eye_clip = reversed(gl_zero_to_one_clip);

// Everything that a fit is given, and the pass that reads the maps.
struct Given {
    ViewVolume<float> camera;
    float shadow_distance = 0.0f;
    Light<float> light;
    Aabb<float> casters;
    SampleSplitOptions<float> splits;
    SampleFitOptions<float> options;
    ScenePass view;
};

Given given_by(Scene const& scene, scenes::View const& view) {
    Given given;
    Pose<float> const pose = pose_looking(glm::vec3(view.eye), glm::vec3(view.forward), glm::vec3(view.up));
    given.camera = perspective_view(pose, float(view.fov_y_radians), float(extent.width) / float(extent.height),
                                    float(view.z_near), std::numeric_limits<float>::infinity());
    given.shadow_distance = float(view.shadow_distance);
    given.light = directional(glm::vec3(view.light_travel));
    for (Object const& object : scene.objects)
        if (object.casts) given.casters = merge(given.casters, Aabb<float>{object.lo, object.hi});
    given.splits.blend = 0.1f;
    given.options.map_size = map_size;
    given.options.clip = gl_zero_to_one_clip;
    given.view = {extent, {}};
    FrameConstants& frame = given.view.frame;
    frame.clip_from_world = clip_from_world(given.camera, gl_zero_to_one_clip);
    frame.eye_position = glm::vec4(pose.position, 1.0f);
    frame.eye_forward = glm::vec4(pose.forward, 0.0f);
    frame.light = glm::vec4(-given.light.direction, 0.0f);
    frame.map_count = given.splits.count;
    frame.filter_radius = 1;
    frame.map_size = float(map_size);
    return given;
}

struct Drawn {
    std::vector<MapConstants> constants;
    std::vector<Image<float>> maps;
    Frame frame;
};

Drawn drawn(Backend& backend, Scene const& scene, ScenePass const& view) {
    std::vector<std::uint32_t> casters;
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i)
        if (scene.objects[i].casts) casters.push_back(i);
    std::vector<DepthLayer> layers;
    for (int i = 0; i < view.frame.map_count; ++i)
        layers.push_back({view.frame.maps[std::size_t(i)].clip_from_world, casters});
    backend.draw_depth({map_size, layers, true, DrawWay::pass_per_map, view.fitted});
    backend.draw_scene(view);
    Drawn result;
    for (int i = 0; i < view.frame.map_count; ++i) result.maps.push_back(backend.read_depth(i));
    result.frame = backend.read_frame();
    return result;
}

Drawn drawn_on_device(Backend& backend, Scene const& scene, Given const& given) {
    GpuSampleFit const fit = gpu_sample_fit(given.camera, eye_clip, given.shadow_distance, given.light, extent.width,
                                            extent.height, given.casters, given.splits, given.options);
    std::vector<ComputeStep> const steps = sdsm_steps(extent);
    backend.fit_maps({extent, clip_from_world(given.camera, eye_clip), steps,
                      std::as_bytes(std::span(&fit, std::size_t{1})), sdsm_state_bytes});
    ScenePass view = given.view;
    view.fitted = true;
    Drawn result = drawn(backend, scene, view);
    result.constants = backend.read_fit();
    return result;
}

// Of the eye's depth as the last fit left it.
Cascades<float> fitted_in_cpp(Image<float> const& stored, Given const& given) {
    DepthCode<float> const code = depth_code(given.camera, eye_clip);
    SampleDepths<float> depths = no_depths(given.camera.z_near, given.shadow_distance);
    for (float const depth : stored.pixels) add(depths, decoded_depth(code, depth));
    SampleBounds<float> bounds = no_bounds(
        sample_splits(depths, given.splits.count, given.splits.kind, given.splits.least_ratio), given.splits.blend);
    SampleRays<float> const rays = sample_rays(given.camera, given.light, extent.width, extent.height);
    for (int y = 0; y < extent.height; ++y)
        for (int x = 0; x < extent.width; ++x) add(bounds, rays, x, y, decoded_depth(code, stored.at(x, y)));
    return fit_samples(rays, bounds, given.casters, given.options);
}

Drawn drawn_from_cpp(Backend& backend, Scene const& scene, Given const& given) {
    Cascades<float> const cascades = fitted_in_cpp(backend.read_eye_depth(), given);
    ScenePass view = given.view;
    for (int i = 0; i < view.frame.map_count; ++i) {
        MapConstants& constants = view.frame.maps[std::size_t(i)];
        constants.clip_from_world = nowhere<float>();
        constants.depth_end = constants.blend_begin = given.shadow_distance;
        if (i >= cascades.count) continue;
        Cascade<float> const& cascade = cascades.at[i];
        MapBias<float> const bias = bias_for(cascade.map, given.light, map_size, BiasOptions<float>{});
        constants.clip_from_world = cascade.map.clip_from_world;
        constants.depth_end = cascade.range.end;
        constants.blend_begin = cascade.range.blend_begin;
        constants.bias_constant = bias.constant;
        constants.bias_slope_texels = bias.slope_texels;
        constants.slope_limit = bias.slope_limit;
    }
    Drawn result = drawn(backend, scene, view);
    result.constants.assign(view.frame.maps.begin(), view.frame.maps.begin() + view.frame.map_count);
    return result;
}

bool is_shadowed(Texel4 const& normal) {
    return normal.w < 0.5f;
}

TEST_P(Fitted, MapsThatTheDeviceFitsAreThoseOfTheCppAndSoIsThePicture) {
    int pictures = 0, maps = 0, unlike = 0, shadowed = 0;
    for (std::string_view const name : scenes::scene_names()) {
        auto const named = scenes::make_scene(name, scenes::SceneSize::small);
        backend->upload(named.scene);
        for (auto const& view : std::span(named.views).first(std::min<std::size_t>(2, named.views.size()))) {
            if (view.has_spot) continue;
            SCOPED_TRACE(std::string(name) + " " + view.name);
            Given given = given_by(named.scene, view);
            given.splits.kind = pictures % 2 == 0 ? SampleSplits::adaptive : SampleSplits::even;
            given.options.still = pictures % 3 == 0;
            Drawn const device = drawn_on_device(*backend, named.scene, given);
            Drawn const cpp = drawn_from_cpp(*backend, named.scene, given);
            for (std::size_t i = 0; i < cpp.constants.size(); ++i) {
                MapConstants const &a = device.constants[i], &b = cpp.constants[i];
                EXPECT_EQ(a.clip_from_world, b.clip_from_world) << "map " << i;
                EXPECT_EQ(a.depth_end, b.depth_end) << "map " << i;
                EXPECT_EQ(a.blend_begin, b.blend_begin) << "map " << i;
                EXPECT_TRUE(device.maps[i].pixels == cpp.maps[i].pixels) << "map " << i;
                maps += b.clip_from_world != nowhere<float>();
            }
            for (std::size_t i = 0; i < cpp.frame.colour.pixels.size(); ++i) {
                Rgba8 const &a = device.frame.colour.pixels[i], &b = cpp.frame.colour.pixels[i];
                unlike += a.r != b.r || a.g != b.g || a.b != b.b;
                shadowed += is_shadowed(cpp.frame.normal.pixels[i]);
            }
            ++pictures;
        }
    }
    std::cout << name_of(GetParam()) << ": " << pictures << " pictures, " << maps << " maps, " << unlike
              << " pixels unlike\n";
    EXPECT_GE(maps, 2 * pictures);
    EXPECT_GT(shadowed, 1000 * pictures);
    // The biases agree to some ulp: that can turn a comparison.
    EXPECT_LE(unlike, pictures * extent.width * extent.height / 100000);
}

TEST_P(Fitted, EveryReceiverWithinTheShadowDistanceIsInItsMap) {
    auto const named = scenes::make_scene(scenes::scene_names().front(), scenes::SceneSize::small);
    backend->upload(named.scene);
    Given given = given_by(named.scene, named.views.front());
    given.view.frame.choice = MapChoice::by_map;  // it asks for the filter's margin as well
    Frame const frame = drawn_on_device(*backend, named.scene, given).frame;
    int receivers = 0, outside = 0;
    for (Texel4 const& at : frame.position.pixels) {
        if (at.w == -2.0f) continue;
        float const depth = eye_depth(given.camera, Vec3<float>(at.x, at.y, at.z));
        if (!(depth < given.shadow_distance * 0.999f)) continue;
        ++receivers;
        outside += at.w == -1.0f;
    }
    EXPECT_GT(receivers, 10000);
    EXPECT_EQ(outside, 0);
}

TEST_P(Fitted, EveryWayDrawsFittedMapsAlike) {
    auto const named = scenes::make_scene(scenes::scene_names().front(), scenes::SceneSize::small);
    backend->upload(named.scene);
    Given const given = given_by(named.scene, named.views.front());
    Drawn const reference = drawn_on_device(*backend, named.scene, given);
    std::vector<std::uint32_t> casters;
    for (std::uint32_t i = 0; i < named.scene.objects.size(); ++i)
        if (named.scene.objects[i].casts) casters.push_back(i);
    std::vector<DepthLayer> const layers(std::size_t(given.splits.count), DepthLayer{glm::mat4(0.0f), casters});
    for (DrawWay const way : backend->ways()) {
        backend->draw_depth({map_size, layers, true, way, true});
        for (int i = 0; i < given.splits.count; ++i)
            EXPECT_TRUE(backend->read_depth(i).pixels == reference.maps[std::size_t(i)].pixels) << name_of(way) << i;
    }
}

TEST_P(Fitted, PassesThatTakeAFitNeedOne) {
    std::vector<DepthLayer> const layers(1);
    EXPECT_THROW(backend->draw_depth({8, layers, true, DrawWay::pass_per_map, true}), std::runtime_error);
    EXPECT_THROW(backend->draw_scene({{8, 8}, {}, true}), std::runtime_error);
    EXPECT_THROW(static_cast<void>(backend->read_fit()), std::runtime_error);
    EXPECT_THROW(backend->fit_maps({}), std::runtime_error);
    EXPECT_TRUE(backend->read_eye_depth().pixels.empty());
}

}  // namespace
