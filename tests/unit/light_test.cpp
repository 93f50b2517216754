// SPDX-License-Identifier: MIT
#include "tests/laws/light.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <utility>

using namespace shadowmath;

namespace {

void expect_basis(glm::dvec3 const& travel, glm::dvec3 const& x, glm::dvec3 const& y) {
    LightBasis<double> const basis = light_basis(travel);
    EXPECT_EQ(basis.x, x);
    EXPECT_EQ(basis.y, y);
    EXPECT_EQ(basis.depth, travel);
    EXPECT_TRUE(laws::is_orthonormal(basis));
}

}  // namespace

TEST(LightBasis, OfAnOverheadSunLooksDownWithNorthUp) {
    expect_basis({0, -1, 0}, {1, 0, 0}, {0, 0, -1});
}

TEST(LightBasis, IsDefinedStraightUpTheOneSingularDirection) {
    expect_basis({0, 1, 0}, {1, 0, 0}, {0, 0, 1});
}

TEST(LightBasis, IsDefinedOnTheOtherAxes) {
    expect_basis({1, 0, 0}, {0, 1, 0}, {0, 0, -1});
    expect_basis({-1, 0, 0}, {0, -1, 0}, {0, 0, -1});
    expect_basis({0, 0, 1}, {1, 0, 0}, {0, -1, 0});
    expect_basis({0, 0, -1}, {1, 0, 0}, {0, 1, 0});
}

TEST(LightBasis, ASunCrossingTheZenithMakesNoJump) {
    for (double t = -0.01; t < 0.01; t += 1e-4) {
        glm::dvec3 const before = glm::normalize(glm::dvec3(t, -1, 1e-3));
        glm::dvec3 const after = glm::normalize(glm::dvec3(t + 1e-4, -1, 1e-3));
        EXPECT_LT(glm::length(light_basis(before).x - light_basis(after).x), 2e-4) << t;
    }
}

TEST(LightBasis, StaysOrthonormalAllTheWayIntoTheSingularDirection) {
    for (float tilt = 1.0f; tilt > 0.0f; tilt /= 2.0f) {
        EXPECT_TRUE(laws::is_orthonormal(light_basis(safe_normalize(glm::vec3(tilt, 1, -tilt)).direction))) << tilt;
        EXPECT_TRUE(laws::is_orthonormal(light_basis(safe_normalize(glm::vec3(0, 1, tilt)).direction))) << tilt;
    }
}

TEST(LightBasis, LightSpaceKeepsLengthsAndMeasuresDepthAlongTheLight) {
    LightBasis<double> const basis = light_basis(glm::normalize(glm::dvec3(1, -2, 0.5)));
    glm::dvec3 const point(3, 4, 12);
    EXPECT_NEAR(glm::length(in_light(basis, point)), 13.0, 1e-14);
    EXPECT_NEAR(in_light(basis, basis.depth * 7.0).z, 7.0, 1e-14);
}

TEST(Light, ASunShinesFromWhereItIs) {
    Light<float> const sun = directional(glm::vec3(0, -3, 0));
    EXPECT_EQ(sun.direction, glm::vec3(0, -1, 0));
    EXPECT_EQ(toward(sun, glm::vec3(5)), glm::vec3(0, 1, 0));
    EXPECT_FALSE(faces_away(sun, glm::vec3(0), glm::vec3(0, 1, 0)));
    EXPECT_TRUE(faces_away(sun, glm::vec3(0), glm::vec3(0, -1, 0)));
    EXPECT_TRUE(faces_away(sun, glm::vec3(0), glm::vec3(1, 0, 0))) << "a grazed wall receives nothing";
}

TEST(Light, ASpotShinesFromItsPosition) {
    Light<double> const lamp = spot(glm::dvec3(0, 4, 0), glm::dvec3(0, -1, 0), 0.5, 20.0);
    EXPECT_FALSE(unusable(lamp));
    EXPECT_EQ(toward(lamp, glm::dvec3(3, 0, 0)), glm::dvec3(-0.6, 0.8, 0));
    EXPECT_EQ(toward(lamp, lamp.position), glm::dvec3(0)) << "no direction at the light itself";
    EXPECT_TRUE(laws::is_where_its_rays_meet(lamp));
}

TEST(Light, AHandMadeLightIsJudgedToo) {
    Light<float> bad;
    bad.direction = glm::vec3(0, -2, 0);
    EXPECT_TRUE(faults_of(bad).has(Fault::zero_light));
    bad.direction.x = std::numeric_limits<float>::quiet_NaN();
    EXPECT_TRUE(faults_of(bad).has(Fault::not_finite));
    EXPECT_TRUE(unusable(bad));
}

TEST(Light, NamesWhicheverNumberIsNone) {
    double const nan = std::numeric_limits<double>::quiet_NaN();
    Light<double> const good = spot(Vec3<double>(0, 5, 0), Vec3<double>(0, -1, 0), 0.5, 10.0);
    EXPECT_FALSE(faults_of(good).any());
    for (double Light<double>::*number : {&Light<double>::half_angle_radians, &Light<double>::range}) {
        Light<double> bad = good;
        bad.*number = nan;
        EXPECT_TRUE(faults_of(bad).has(Fault::not_finite));
    }
    for (Vec3<double> Light<double>::*vector : {&Light<double>::position, &Light<double>::direction}) {
        Light<double> bad = good;
        (bad.*vector).z = nan;
        EXPECT_TRUE(faults_of(bad).has(Fault::not_finite));
    }
}

TEST(Light, OfAnyRangeAboveNoneIsOne) {
    EXPECT_FALSE(spot(Vec3<double>(0.0), Vec3<double>(0, -1, 0), 0.5, 0.25).faults.any());
    EXPECT_TRUE(spot(Vec3<double>(0.0), Vec3<double>(0, -1, 0), 0.5, 0.0).faults.has(Fault::empty_range));
}

TEST(Light, OfAPlaceOrAnAngleThatIsNoNumberSaysSo) {
    double const nan = std::numeric_limits<double>::quiet_NaN();
    glm::dvec3 const down(0, -1, 0);
    EXPECT_EQ(spot(glm::dvec3(nan, 0, 0), down, 0.5, 10.0).faults, Faults(Fault::not_finite));
    EXPECT_EQ(spot(glm::dvec3(0), down, nan, 10.0).faults, Faults(Fault::not_finite));
    EXPECT_EQ(spot(glm::dvec3(0), down, 0.5, nan).faults, Faults(Fault::not_finite));
}

TEST(Light, OfAConeOutsideItsRangeHasTheNearestAndSaysSo) {
    glm::dvec3 const down(0, -1, 0);
    for (auto const& [asked, given] : {std::pair{0.5e-3, 1e-3}, std::pair{-1.0, 1e-3}, std::pair{2.0, 1.5}}) {
        Light<double> const light = spot(glm::dvec3(0), down, asked, 10.0);
        EXPECT_EQ(light.half_angle_radians, given);
        EXPECT_EQ(light.faults, Faults(Fault::cone_clamped));
    }
    EXPECT_FALSE(spot(glm::dvec3(0), down, 1.5, 10.0).faults.any());
}
