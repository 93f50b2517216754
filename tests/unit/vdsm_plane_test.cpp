// SPDX-License-Identifier: MIT
//
// The shadow plane and the projection along the light onto it. The map: vdsm_test.cpp.
#include "tests/laws/vdsm.hpp"
#include "tests/support/vdsm_cases.hpp"
#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

TEST(PlaneProjection, OfASunIsTheThesisFormula) {
    ShadowPlane<double> const plane{V3(0.2, 0.9, -0.1), -2.0};
    V3 const p(3, 5, -7), light = morning.direction;
    V3 const q = p - light * ((glm::dot(p, plane.normal) + plane.offset) / glm::dot(light, plane.normal));
    V4 const image = plane_projection(plane, homogeneous(morning)) * V4(p, 1.0);
    EXPECT_NEAR(glm::length(V3(image) - q), 0.0, 1e-14 * 30);
    EXPECT_EQ(image.w, 1.0);
}

TEST(PlaneProjection, KillsTheLightAndLandsOnThePlane) {
    for (Light<double> const& light : {morning, spot(V3(2, 9, 1), V3(0, -1, 0.2), 0.7, 50.0)})
        for (V3 const& p : {V3(1, 2, 3), V3(0, 20, 0), V3(-40, -3, 7)})
            EXPECT_TRUE(laws::projects_onto(ShadowPlane<double>{V3(0.1, 0.8, 0.2), 0.5}, homogeneous(light), p));
}

TEST(PlaneProjection, DependsNeitherOnSignNorOnLengthOfPlaneAndLight) {
    ShadowPlane<double> const plane{V3(0.1, 0.8, 0.2), 0.5};
    V4 const light(2, 9, 1, 1);
    glm::dmat4 const once = plane_projection(plane, light);
    for (double const scale : {-1.0, 2.0, -0.25, 1024.0}) {
        EXPECT_EQ(plane_projection(plane, light * scale), once);
        EXPECT_EQ(plane_projection(ShadowPlane<double>{plane.normal * scale, plane.offset * scale}, light), once);
    }
    glm::dmat4 const twice = once * once;
    for (int c = 0; c < 4; ++c)
        for (int r = 0; r < 4; ++r) EXPECT_NEAR(twice[c][r], once[c][r], 1e-14);
}

TEST(PlaneProjection, OfALightInThePlaneIsTheIdentity) {
    EXPECT_EQ(plane_projection(ground, V4(1, 0, 0, 0)), glm::dmat4(1.0));
    EXPECT_EQ(plane_projection(ground, V4(3, 0, 5, 1)), glm::dmat4(1.0));
    EXPECT_EQ(plane_projection(ShadowPlane<double>{V3(nan_), 0.0}, V4(0, 1, 0, 0)), glm::dmat4(1.0));
}

TEST(PlaneProjection, OfWhatIsNotFiniteOrHasNoNormalIsTheIdentityAndDividesByNothing) {
    ShadowPlane<double> const unknown{V3(0, nan_, 0), 0.0}, beyond{V3(0, 1, 0), inf}, none{V3(0.0), 0.0};
    V4 const down(0, -1, 0, 0);
    EXPECT_EQ(plane_projection(unknown, down), glm::dmat4(1.0));
    EXPECT_EQ(plane_projection(beyond, down), glm::dmat4(1.0));
    EXPECT_EQ(plane_projection(ground, V4(0, nan_, 0, 0)), glm::dmat4(1.0));
    for (auto const& run : {test::watched([&] { return plane_projection(none, down); }),
                            test::watched([&] { return plane_projection(ground, V4(0.0)); })}) {
        EXPECT_TRUE(run.calm_in_range());
        EXPECT_EQ(run.result, glm::dmat4(1.0));
    }
}

TEST(ShadowPlane, AtMeanHeightHalvesWhatReceives) {
    ShadowPlane<double> const plane = mean_height_plane(Aabb<double>{V3(-5, 2, -5), V3(5, 8, 5)}, V3(0, 3, 0));
    EXPECT_EQ(plane.normal, V3(0, 1, 0));
    EXPECT_EQ(plane.offset, -5.0);
    EXPECT_EQ(mean_height_plane(Aabb<double>{}, V3(0, 1, 0)).offset, 0.0);
}
