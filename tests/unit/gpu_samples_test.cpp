// SPDX-License-Identifier: MIT
//
// What the shaders are given. That they make of it what the C++ makes is for the twin tests.
#include <shadowmath/gpu_samples.hpp>

#include <gtest/gtest.h>

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
}
