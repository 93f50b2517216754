// SPDX-License-Identifier: MIT
//
// The fit of maps to the eye's depth in compute shaders against the C++ at float: bins, splits, boxes and matrices are
// the same bits on every driver, for pictures with everything in them that a depth buffer can hold.
#include "backends/sdsm_passes.hpp"
#include "tests/twins/drivers.hpp"

#include <shadowmath/gpu_samples.hpp>

#include <bit>
#include <cmath>
#include <cstring>
#include <iostream>
#include <random>

namespace {

using namespace shadowmath;
using namespace shadowmath::twins;

static_assert(sizeof(GpuSampleState) == sdsm_state_bytes);

class Sdsm : public OnDriver {};
INSTANTIATE_TEST_SUITE_P(Drivers, Sdsm, every_driver, driver_name);

// One picture: an eye, a sun, casters, options, and what the depth buffer holds.
struct Picture {
    ViewVolume<float> camera;
    ClipSpace camera_clip;
    float shadow_distance = 0.0f;
    Light<float> light;
    Aabb<float> casters;
    SampleSplitOptions<float> splits;
    SampleFitOptions<float> options;
    int width = 1, height = 1;
    std::vector<float> stored;
};

class Draw {
public:
    explicit Draw(std::uint32_t seed) : engine_(seed) {}
    float operator()(float lo, float hi) { return lo + (hi - lo) * float(engine_() >> 8) * 0x1p-24f; }
    float log(float lo, float hi) { return std::exp2((*this)(std::log2(lo), std::log2(hi))); }
    int below(int count) { return int(engine_() % std::uint32_t(count)); }
    glm::vec3 vector(float size) {
        float const x = (*this)(-size, size), y = (*this)(-size, size), z = (*this)(-size, size);
        return {x, y, z};
    }

private:
    std::mt19937 engine_;
};

// The value that the camera's matrix stores for a depth along its axis.
float stored_at(Picture const& picture, float depth) {
    ViewVolume<double> camera;
    camera.z_near = double(picture.camera.z_near);
    camera.z_far = double(picture.camera.z_far);
    camera.kind = picture.camera.kind;
    Mat4<double> const matrix =
        texture_from_clip<double>(picture.camera_clip) * clip_from_world(camera, picture.camera_clip);
    Vec4<double> const clip = matrix * Vec4<double>(0.0, 0.0, -double(depth), 1.0);
    return float(clip.z / clip.w);
}

Picture drawn_picture(std::uint32_t seed) {
    Draw draw(seed);
    Picture p;
    glm::vec3 const position = draw.vector(draw.log(1.0f, 1000.0f)), forward = draw.vector(1.0f);
    Pose<float> const pose = pose_looking(position, forward, glm::vec3(0, 1, 0));
    float const z_near = draw.log(0.01f, 1.0f), z_far = z_near * draw.log(10.0f, 1e4f);
    float const width = draw.log(0.1f, 2.0f), height = draw.log(0.1f, 2.0f), spread = draw.below(4) == 0 ? z_far : 1.0f;
    p.camera = {pose,
                -width * spread,
                width * spread * draw(0.5f, 1.0f),
                -height * spread,
                height * spread,
                z_near,
                z_far,
                spread == 1.0f ? ViewKind::perspective : ViewKind::orthographic};
    ClipSpace const clips[] = {gl_clip, vulkan_clip, reversed(d3d_clip)};
    p.camera_clip = clips[draw.below(3)];
    if (p.camera.kind == ViewKind::perspective && draw.below(3) == 0)
        p.camera.z_far = std::numeric_limits<float>::infinity();
    p.shadow_distance = draw.below(2) == 0 || !std::isfinite(p.camera.z_far) ? z_far * draw(0.2f, 0.9f) : 0.0f;
    p.light = directional(draw.below(5) == 0 ? glm::vec3(0, -1, 0) : draw.vector(1.0f));
    glm::vec3 const centre = position + forward * z_far * draw(0.0f, 1.0f), half = glm::abs(draw.vector(z_far)) + 0.01f;
    p.casters = {centre - half, centre + half};
    p.splits.count = 1 + draw.below(8);
    p.splits.kind = draw.below(2) == 0 ? SampleSplits::even : SampleSplits::adaptive;
    p.splits.blend = draw.below(2) == 0 ? 0.0f : 0.2f;
    p.options.map_size = 32 + draw.below(4000);
    p.options.margin_texels = float(draw.below(4));
    p.options.still = draw.below(2) == 0;
    p.options.pancake = draw.below(3) == 0;
    p.options.clip = clips[draw.below(3)];
    // Past a tile's border on both axes in some.
    p.width = 1 + draw.below(150);
    p.height = 1 + draw.below(100);
    float surface[3];
    for (float& at : surface) at = draw.log(z_near, z_far);
    float const nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    float const nasty[] = {nan, infinity, -infinity, 0.0f, -0.0f, 1.0f, -1.0f, 1e-40f, 3e38f, 0.5f};
    for (int i = 0; i < p.width * p.height; ++i) {
        int const kind = draw.below(24);
        float const relief = draw(1.0f, 1.3f);
        float const depth = kind == 22 ? draw.log(z_near, z_far) : surface[kind % 3] * relief;
        p.stored.push_back(kind == 23               ? nasty[draw.below(10)]
                           : kind > 18 && kind < 22 ? far_depth<float>(p.camera_clip)
                                                    : stored_at(p, depth));
    }
    return p;
}

struct Made {
    GpuSampleState state{};
    std::vector<MapConstants> maps;
};

Made made_on_device(ComputeRunner& runner, Picture const& p) {
    GpuSampleFit const fit = gpu_sample_fit(p.camera, p.camera_clip, p.shadow_distance, p.light, p.width, p.height,
                                            p.casters, p.splits, p.options);
    Storage const state = runner.make_storage(sizeof(GpuSampleState));
    Storage const maps = runner.make_storage(max_maps * sizeof(MapConstants));
    Texture2DArray const depth = runner.make_texture({p.width, p.height}, 1, p.stored);
    std::vector<Dispatch> passes;
    for (ComputeStep const& step : sdsm_steps({p.width, p.height}))
        passes.push_back(
            {step.shader, step.groups, {state, maps}, {depth}, std::as_bytes(std::span(&fit, std::size_t{1}))});
    runner.run(passes);
    return {read_back<GpuSampleState>(runner, state, 1).front(), read_back<MapConstants>(runner, maps, max_maps)};
}

struct Wanted {
    SampleDepths<float> depths;
    SampleBounds<float> bounds;
    Cascades<float> cascades;
};

Wanted made_in_cpp(Picture const& p) {
    float const z_far = p.shadow_distance > 0.0f ? p.shadow_distance : p.camera.z_far;
    DepthCode<float> const code = depth_code(p.camera, p.camera_clip);
    Wanted w;
    w.depths = no_depths(p.camera.z_near, z_far);
    for (float const stored : p.stored) add(w.depths, decoded_depth(code, stored));
    w.bounds = no_bounds(sample_splits(w.depths, p.splits.count, p.splits.kind, p.splits.least_ratio), p.splits.blend);
    SampleRays<float> const rays = sample_rays(p.camera, p.light, p.width, p.height);
    for (int y = 0; y < p.height; ++y)
        for (int x = 0; x < p.width; ++x)
            add(w.bounds, rays, x, y, decoded_depth(code, p.stored[std::size_t(y * p.width + x)]));
    w.cascades = fit_samples(rays, w.bounds, p.casters, p.options);
    return w;
}

// -0 and 0 are the same number.
bool same_bits(float a, float b) {
    return std::bit_cast<std::uint32_t>(a + 0.0f) == std::bit_cast<std::uint32_t>(b + 0.0f);
}

float from_ordered(std::uint32_t ordered) {
    return std::bit_cast<float>((ordered & 0x80000000u) != 0 ? ordered & 0x7fffffffu : ~ordered);
}

TEST_P(Sdsm, BinsSplitsBoxesAndMatricesAreThoseOfTheCppBitForBit) {
    long samples = 0, visible = 0;
    for (std::uint32_t seed = 1; seed <= 60; ++seed) {
        SCOPED_TRACE("picture " + std::to_string(seed));
        Picture const p = drawn_picture(seed);
        Made const made = made_on_device(*runner, p);
        Wanted const wanted = made_in_cpp(p);
        samples += long(wanted.depths.counted);

        ASSERT_EQ(made.state.counted, wanted.depths.counted);
        ASSERT_EQ(made.state.outside, wanted.depths.outside);
        ASSERT_EQ(made.state.not_finite, wanted.depths.not_finite);
        for (int i = 0; i < depth_bins; ++i) {
            bool const empty = made.state.bin_lo[i] > made.state.bin_hi[i];
            ASSERT_EQ(empty, wanted.depths.lo[i] > wanted.depths.hi[i]) << "bin " << i;
            if (empty) continue;
            ASSERT_TRUE(same_bits(std::bit_cast<float>(made.state.bin_lo[i]), wanted.depths.lo[i])) << "bin " << i;
            ASSERT_TRUE(same_bits(std::bit_cast<float>(made.state.bin_hi[i]), wanted.depths.hi[i])) << "bin " << i;
        }
        ASSERT_EQ(made.state.count, wanted.bounds.count);
        for (int i = 0; i < wanted.bounds.count; ++i) {
            SliceRange<float> const& range = wanted.bounds.range[i];
            ASSERT_TRUE(same_bits(made.state.range[i].x, range.begin)) << "split " << i;
            ASSERT_TRUE(same_bits(made.state.range[i].y, range.blend_begin)) << "split " << i;
            ASSERT_TRUE(same_bits(made.state.range[i].z, range.end)) << "split " << i;
            for (int axis = 0; axis < 3; ++axis) {
                ASSERT_TRUE(same_bits(from_ordered(made.state.box_lo[i][axis]), wanted.bounds.box[i].lo[axis]));
                ASSERT_TRUE(same_bits(from_ordered(made.state.box_hi[i][axis]), wanted.bounds.box[i].hi[axis]));
            }
            if (i >= max_maps) continue;
            visible += wanted.cascades.at[i].map.visible;
            Mat4<float> const& a = made.maps[std::size_t(i)].clip_from_world;
            Mat4<float> const& b = wanted.cascades.at[i].map.clip_from_world;
            for (int column = 0; column < 4; ++column)
                for (int r = 0; r < 4; ++r)
                    ASSERT_TRUE(same_bits(a[column][r], b[column][r]))
                        << "map " << i << " column " << column << " row " << r << ": " << a[column][r] << " and "
                        << b[column][r];
        }
        for (int i = wanted.bounds.count; i < max_maps; ++i)
            ASSERT_EQ(made.maps[std::size_t(i)].clip_from_world, nowhere<float>());
    }
    std::cout << name_of(GetParam()) << ": " << samples << " samples in 60 pictures, " << visible
              << " visible maps, all bits alike\n";
    EXPECT_GT(samples, 100000);
    EXPECT_GT(visible, 150);
}

TEST_P(Sdsm, BiasIsThatOfTheCpp) {
    for (std::uint32_t seed = 1; seed <= 10; ++seed) {
        Picture p = drawn_picture(seed);
        p.options.clip = gl_zero_to_one_clip;
        Made const made = made_on_device(*runner, p);
        Wanted const wanted = made_in_cpp(p);
        for (int i = 0; i < wanted.cascades.count; ++i) {
            ShadowMap<float> const& map = wanted.cascades.at[i].map;
            if (!map.visible) continue;
            MapBias<float> const bias = bias_for(map, p.light, p.options.map_size, BiasOptions<float>{});
            MapConstants const& found = made.maps[std::size_t(i)];
            // Lengths of rows there, texels here: some ulp each.
            EXPECT_NEAR(found.bias_constant, bias.constant, 1e-5f * bias.constant);
            EXPECT_NEAR(found.bias_slope_texels, bias.slope_texels, 1e-5f * bias.slope_texels);
            EXPECT_NEAR(found.slope_limit, bias.slope_limit, 1e-5f * bias.slope_limit);
            EXPECT_EQ(found.bias_w, bias.per_inverse_w);
        }
    }
}

TEST_P(Sdsm, AnEmptyScreenAndBadInputsMakeNoMap) {
    Picture empty = drawn_picture(3);
    std::fill(empty.stored.begin(), empty.stored.end(), far_depth<float>(empty.camera_clip));
    Picture sunless = drawn_picture(4), boundless = drawn_picture(5), nameless = drawn_picture(6);
    sunless.light = directional(glm::vec3(0.0f));
    boundless.casters = {};
    nameless.camera.pose.forward.x = std::numeric_limits<float>::quiet_NaN();
    for (Picture const& p : {empty, sunless, boundless, nameless}) {
        Made const made = made_on_device(*runner, p);
        for (MapConstants const& map : made.maps) EXPECT_EQ(map.clip_from_world, nowhere<float>());
    }
}

}  // namespace
