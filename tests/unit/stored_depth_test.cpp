// SPDX-License-Identifier: MIT
#include <shadowmath/stored_depth.hpp>

#include <gtest/gtest.h>

using namespace shadowmath;

template <class T>
class StoredDepth : public ::testing::Test {};
using Scalars = ::testing::Types<float, double, long double>;
TYPED_TEST_SUITE(StoredDepth, Scalars);

namespace {

template <class T>
ViewVolume<T> camera(ViewKind kind, T z_far) {
    ViewVolume<T> view;
    view.kind = kind;
    view.z_near = T(0.5);
    view.z_far = z_far;
    return view;
}

// What the matrix stores of a point at this depth on the view's axis, and what the code makes of that.
template <class T>
T there_and_back(ViewVolume<T> const& view, ClipSpace clip, T depth) {
    Mat4<T> const texture_from_world = texture_from_clip<T>(clip) * clip_from_world(view, clip);
    Vec4<T> const at = texture_from_world * Vec4<T>(T(0), T(0), -depth, T(1));
    return decoded_depth(depth_code(view, clip), at.z / at.w);
}

}  // namespace

TYPED_TEST(StoredDepth, IsDecodedInEveryConvention) {
    using T = TypeParam;
    T const endless = std::numeric_limits<T>::infinity(), eps = std::numeric_limits<T>::epsilon();
    for (ClipSpace const clip : {gl_clip, gl_zero_to_one_clip, vulkan_clip, reversed(d3d_clip)})
        for (ViewKind const kind : {ViewKind::perspective, ViewKind::orthographic})
            for (T const z_far : {T(100), endless}) {
                if (kind == ViewKind::orthographic && z_far == endless) continue;
                for (T const depth : {T(0.5), T(0.75), T(3), T(50)}) {
                    // A stored value is known to an ulp of 1, which is worth depth^2 / z_near.
                    T const slack = T(16) * eps * (depth * depth / T(0.5) + T(100));
                    T const found = there_and_back(camera(kind, z_far), clip, depth);
                    EXPECT_NEAR(double(found), double(depth), double(slack));
                }
            }
}

TYPED_TEST(StoredDepth, ReversedAndEndlessKeepsEveryDigit) {
    using T = TypeParam;
    auto const view = camera(ViewKind::perspective, std::numeric_limits<T>::infinity());
    for (T const depth : {T(1), T(1000), T(1e6), T(1e9)})
        EXPECT_NEAR(double(there_and_back(view, reversed(d3d_clip), depth) / depth), 1.0,
                    double(T(4) * std::numeric_limits<T>::epsilon()));
}

TYPED_TEST(StoredDepth, TheSkyLiesBeyondEveryDepth) {
    using T = TypeParam;
    auto const view = camera(ViewKind::perspective, T(100));
    EXPECT_EQ(decoded_depth(depth_code(view, gl_clip), T(1)), std::numeric_limits<T>::max());
    EXPECT_EQ(decoded_depth(depth_code(view, reversed(gl_clip)), T(0)), std::numeric_limits<T>::max());
}

TYPED_TEST(StoredDepth, AViewWithoutDepthsPutsEverythingBehindTheEye) {
    using T = TypeParam;
    auto bad = camera(ViewKind::perspective, T(0.1));
    EXPECT_EQ(decoded_depth(depth_code(bad, gl_clip), T(0.5)), T(-1));
    auto endless = camera(ViewKind::orthographic, std::numeric_limits<T>::infinity());
    EXPECT_EQ(decoded_depth(depth_code(endless, gl_clip), T(0.5)), T(-1));
}
