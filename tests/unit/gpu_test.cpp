// SPDX-License-Identifier: MIT
//
// That the structs for shaders hold what the cascades say. That shaders find it there: tests/twins/layout_test.cpp.
#include <shadowmath/cascades.hpp>
#include <shadowmath/gpu.hpp>

#include <gtest/gtest.h>

#include <limits>

namespace {

using namespace shadowmath;

template <class T>
struct Fitted {
    Light<T> light = directional(Vec3<T>(T(0.3), T(-1), T(0.2)));
    CascadeOptions<T> options;
    Cascades<T> cascades;

    explicit Fitted(ClipSpace clip) {
        Pose<T> const pose =
            pose_looking(Vec3<T>(T(0), T(2), T(0)), Vec3<T>(T(0), T(0), T(-1)), Vec3<T>(T(0), T(1), T(0)));
        Aabb<T> const world{Vec3<T>(T(-50), T(0), T(-50)), Vec3<T>(T(50), T(10), T(50))};
        options.clip = clip;
        options.filter_radius = 2;
        cascades = fit_cascades(perspective_view(pose, T(1), T(1.5), T(0.1), T(100)), light, world, world, options);
    }
};

template <class T>
class Gpu : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Gpu, Scalars);

TYPED_TEST(Gpu, HoldsWhatTheCascadesSay) {
    using T = TypeParam;
    for (ClipSpace const clip : {gl_clip, vulkan_clip, d3d_clip, reversed(d3d_clip)}) {
        Fitted<T> const fitted(clip);
        BiasOptions<T> options;
        options.tap_plane = false;
        GpuCascades const gpu = gpu_cascades(fitted.cascades, fitted.light, fitted.options, options);
        ASSERT_EQ(gpu.count, 4);
        EXPECT_EQ(gpu.map_size, fitted.options.map_size);
        EXPECT_EQ(gpu.filter_radius, 2);
        EXPECT_EQ(gpu.tap_plane, 0);
        options.filter_radius = 2;
        for (int i = 0; i < gpu.count; ++i) {
            Cascade<T> const& cascade = fitted.cascades.at[i];
            EXPECT_TRUE(cascade.map.visible);
            EXPECT_EQ(gpu.at[i].map.visible, 1);
            EXPECT_EQ(gpu.at[i].map.clip_from_world, Mat4<float>(cascade.map.clip_from_world));
            EXPECT_EQ(gpu.at[i].map.w_min, float(cascade.map.w_min));
            EXPECT_EQ(gpu.at[i].map.depth_order, int(clip.depth));
            EXPECT_EQ(gpu.at[i].map.flip_v, clip.ndc_y == clip.texture_v ? 0 : 1);
            auto const bias = bias_for(cascade.map, fitted.light, fitted.options.map_size, options);
            EXPECT_EQ(gpu.at[i].bias.slope_texels, float(bias.slope_texels));
            EXPECT_EQ(gpu.at[i].bias.constant, float(bias.constant));
            EXPECT_EQ(gpu.ranges.end[i], float(cascade.range.end));
            EXPECT_EQ(gpu.ranges.blend_begin[i], float(cascade.range.blend_begin));
        }
    }
}

TEST(Gpu, AMapThatFloatCannotHoldServesNothing) {
    ShadowMap<double> map;
    map.visible = true;
    map.clip_from_world = Mat4<double>(1.0);
    EXPECT_EQ(gpu_shadow_map(map).visible, 1);
    map.clip_from_world[3][0] = 1e300;
    GpuShadowMap const gpu = gpu_shadow_map(map);
    EXPECT_EQ(gpu.visible, 0);
    EXPECT_EQ(gpu.clip_from_world, nowhere<float>());
}

TEST(Gpu, AMapThatIsNotVisibleOrWhoseWFloatCannotHoldServesNothing) {
    ShadowMap<double> map;
    map.clip_from_world = Mat4<double>(1.0);
    EXPECT_EQ(gpu_shadow_map(map).visible, 0);
    map.visible = true;
    map.w_min = 1e300;
    EXPECT_EQ(gpu_shadow_map(map).visible, 0);
    EXPECT_EQ(gpu_shadow_map(map).w_min, GpuShadowMap{}.w_min);
}

TEST(Gpu, ABiasThatFloatCannotHoldIsNone) {
    ShadowMap<double> map;
    map.clip_from_world = Mat4<double>(1.0);
    map.clip = gl_zero_to_one_clip;
    map.visible = true;
    Light<double> const sun = directional(Vec3<double>(0, 0, 1));
    BiasOptions<double> options;
    EXPECT_GT(gpu_map(map, sun, 512, options).bias.constant, 0.0f);
    options.metres = 1e300;
    GpuCascade const none = gpu_map(map, sun, 512, options);
    EXPECT_EQ(none.bias.constant, GpuMapBias{}.constant);
    EXPECT_EQ(none.bias.slope_limit, GpuMapBias{}.slope_limit);
    EXPECT_EQ(none.map.visible, 1) << "the map itself is as good as before";
}

TEST(Gpu, APenumbraThatFloatCannotHoldIsHard) {
    MapPenumbra<double> penumbra;
    penumbra.rim_x = Vec4<double>(0.25, 0, 0, 0);
    penumbra.rim_y = Vec4<double>(0, 0.5, 0, 0);
    penumbra.depth_of_gap = 2.0;
    penumbra.largest_gap = 3.0;
    GpuMapPenumbra const gpu = gpu_penumbra(penumbra);
    EXPECT_EQ(gpu.rim_x.x, 0.25f);
    EXPECT_EQ(gpu.rim_y.y, 0.5f);
    EXPECT_EQ(gpu.depth_of_gap, 2.0f);
    EXPECT_EQ(gpu.largest_gap, 3.0f);
    auto const is_hard = [](MapPenumbra<double> const& of) {
        GpuMapPenumbra const it = gpu_penumbra(of);
        return it.rim_x == Vec4<float>(0.0f) && it.rim_y == Vec4<float>(0.0f) && it.depth_of_gap == 1.0f;
    };
    for (double const bad : {1e300, std::numeric_limits<double>::quiet_NaN()}) {
        for (double Vec4<double>::*axis : {&Vec4<double>::x, &Vec4<double>::w})
            for (Vec4<double> MapPenumbra<double>::*rim : {&MapPenumbra<double>::rim_x, &MapPenumbra<double>::rim_y}) {
                MapPenumbra<double> spoilt = penumbra;
                spoilt.*rim.*axis = bad;
                EXPECT_TRUE(is_hard(spoilt));
            }
        for (double MapPenumbra<double>::*number :
             {&MapPenumbra<double>::depth_of_gap, &MapPenumbra<double>::largest_gap}) {
            MapPenumbra<double> spoilt = penumbra;
            spoilt.*number = bad;
            EXPECT_TRUE(is_hard(spoilt));
        }
    }
    penumbra.depth_of_gap = 1e-300;
    EXPECT_TRUE(is_hard(penumbra)) << "zero, in a float";
}

TEST(Gpu, NoCascadesAreNone) {
    GpuCascades const gpu = gpu_cascades(Cascades<float>{}, directional(Vec3<float>(0.0f)), CascadeOptions<float>{});
    EXPECT_EQ(gpu.count, 0);
    EXPECT_EQ(gpu.at[0].map.visible, 0);
}

}  // namespace

TEST(Gpu, HoldsAsManyMapsAsThereCanBe) {
    Cascades<float> cascades;
    cascades.count = max_splits;
    cascades.at[max_splits - 1].range.end = 7.0f;
    GpuCascades const gpu = gpu_cascades(cascades, directional(Vec3<float>(0, -1, 0)), CascadeOptions<float>{});
    EXPECT_EQ(gpu.count, max_splits);
    EXPECT_EQ(gpu.ranges.end[max_splits - 1], 7.0f);
}
