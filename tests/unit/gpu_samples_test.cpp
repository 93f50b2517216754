// SPDX-License-Identifier: MIT
//
// What the shaders are given. That they make of it what the C++ makes is for the twin tests.
#include <shadowmath/gpu_samples.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

using namespace shadowmath;

namespace {

GpuSampleFit fit_of(ViewVolume<float> const& camera, Light<float> const& light, Aabb<float> const& casters,
                    SampleFitOptions<float> const& options = {}) {
    return gpu_sample_fit(camera, reversed(gl_zero_to_one_clip), 50.0f, light, 320, 180, casters, {}, options);
}

Aabb<float> const brick{Vec3<float>(-1), Vec3<float>(1)};

}  // namespace

TEST(GpuSamples, TakeTheRangeOfTheShadows) {
    ViewVolume<float> camera;
    camera.z_far = std::numeric_limits<float>::infinity();
    GpuSampleFit const fit = fit_of(camera, Light<float>{}, brick);
    EXPECT_EQ(fit.count, 4);
    EXPECT_EQ(fit.adaptive, 1);
    EXPECT_EQ(fit.basis_x.w, camera.z_near);
    EXPECT_EQ(fit.basis_y.w, 50.0f);
    EXPECT_EQ(fit.width, 320);
    EXPECT_EQ(fit.up.w, 0.0f);
}

TEST(GpuSamples, InputsWithFaultsAskForNoSplit) {
    ViewVolume<float> camera, endless, bad;
    endless.z_far = std::numeric_limits<float>::infinity();
    bad.left = bad.right;
    EXPECT_EQ(fit_of(bad, Light<float>{}, brick).count, 0);
    EXPECT_EQ(fit_of(camera, directional(Vec3<float>(0)), brick).count, 0);
    EXPECT_EQ(fit_of(camera, Light<float>{}, Aabb<float>{}).count, 0);
    EXPECT_EQ(fit_of(camera, Light<float>{}, {Vec3<float>(std::nanf("")), Vec3<float>(1)}).count, 0);
    SampleFitOptions<float> tiny;
    tiny.map_size = 4;
    EXPECT_EQ(fit_of(camera, Light<float>{}, brick, tiny).count, 0);
    // Shadows without an end have no last split.
    auto const far_away = gpu_sample_fit(endless, gl_clip, 0.0f, Light<float>{}, 4, 4, brick, {}, {});
    EXPECT_EQ(far_away.count, 0);
}

TEST(GpuSamples, AFaceThatTheLightRunsAlongIsSkipped) {
    GpuSampleFit const fit = fit_of(ViewVolume<float>{}, Light<float>{}, brick);
    EXPECT_EQ(Vec3<float>(fit.inverse_along), Vec3<float>(0.0f, -1.0f, 0.0f));
    GpuSampleFit const slanting = fit_of(ViewVolume<float>{}, directional(Vec3<float>(0.6f, -0.8f, 0.0f)), brick);
    EXPECT_NEAR(slanting.inverse_along.x, 1 / 0.6f, 1e-6f);
    EXPECT_NEAR(slanting.inverse_along.y, -1 / 0.8f, 1e-6f);
    EXPECT_EQ(slanting.inverse_along.z, 0.0f);
}

TEST(GpuSamples, SayWhatWasAskedFor) {
    SampleSplitOptions<float> splits;
    SampleFitOptions<float> options;
    auto const fit = [&](ViewVolume<float> const& camera, float distance = 50.0f) {
        return gpu_sample_fit(camera, gl_clip, distance, Light<float>{}, 320, 180, brick, splits, options);
    };
    ViewVolume<float> const camera;
    EXPECT_EQ(fit(camera).orthographic, 0);
    EXPECT_EQ(fit(orthographic_view(Pose<float>{}, -4.0f, 4.0f, -3.0f, 3.0f, 0.1f, 90.0f)).orthographic, 1);
    for (bool const on : {false, true}) {
        options.still = options.pancake = on;
        EXPECT_EQ(fit(camera).still, on ? 1 : 0);
        EXPECT_EQ(fit(camera).pancake, on ? 1 : 0);
        EXPECT_EQ(fit(camera).forward.w == 0.0f, on) << "still maps take their margin from the grid";
    }
    options.still = false;
    options.map_size = 512;
    options.margin_texels = 6.0f;
    EXPECT_EQ(fit(camera).forward.w, 0.5f * 12.0f / 500.0f) << "half of what is left, as a share of what is used";
    EXPECT_NEAR(fit(camera).right.w * 499.0f, 1.0f, 1e-6f);
    EXPECT_GT(fit(camera).right.w * 499.0f, 1.0f) << "rounded upward";
    splits.kind = SampleSplits::even;
    EXPECT_EQ(fit(camera).adaptive, 0);
    for (auto const& [count, kept] : {std::pair(-2, 0), std::pair(3, 3), std::pair(1000, max_splits)}) {
        splits.count = count;
        EXPECT_EQ(fit(camera).count, kept);
    }
    for (auto const& [blend, kept] :
         {std::pair(-1.0f, 0.0f), std::pair(0.25f, 0.25f), std::pair(7.0f, 1.0f), std::pair(std::nanf(""), 0.0f)}) {
        splits.blend = blend;
        EXPECT_EQ(fit(camera).inverse_along.w, kept);
    }
    for (float const none : {0.0f, -1.0f, std::nanf(""), camera.z_far * 2.0f})
        EXPECT_EQ(fit(camera, none).basis_y.w, camera.z_far) << none;
    options.margin_texels = std::nanf("");
    GpuSampleFit const none = fit(camera), zero{};
    EXPECT_EQ(none.count, 0) << "a margin that is no number is a fault";
    EXPECT_EQ(std::memcmp(&none, &zero, sizeof none), 0) << "and nothing of what lay in memory is handed on";
}
