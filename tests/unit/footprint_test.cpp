// SPDX-License-Identifier: MIT
#include "tests/laws/footprint.hpp"

#include <shadowmath/aliasing.hpp>
#include <shadowmath/light_box.hpp>
#include <shadowmath/splits.hpp>
#include <shadowmath/view_volume.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

using namespace shadowmath;

namespace {

// The setting of the closed forms: the eye at the origin looks along +x, the light falls along -y, and a map covers eye
// depths [n, f] and the view's width at f. z of the world runs across the view.
constexpr double n = 0.5, f = 80, tan_half_fov = 0.6, pixels = 1000, texels = 1024;

Mat4<double> eye() {
    Pose<double> const pose = pose_looking(Vec3<double>(0), Vec3<double>(1, 0, 0), Vec3<double>(0, 1, 0));
    ViewVolume<double> const view = perspective_view(pose, 2 * std::atan(tan_half_fov), 1.0, n, f);
    return clip_from_world(view, gl_zero_to_one_clip);
}

// Map y runs over eye depth [begin, end] in proportion, x over the view's width at `end`.
Mat4<double> uniform_map(double begin, double end) {
    LightBox<double> box;
    box.basis = LightBasis<double>{Vec3<double>(0, 0, 1), Vec3<double>(1, 0, 0), Vec3<double>(0, -1, 0)};
    box.lo = Vec2<double>(-tan_half_fov * end, begin);
    box.hi = Vec2<double>(tan_half_fov * end, end);
    box.depth_lo = -100;
    box.depth_hi = 100;
    return clip_from_world(box, gl_zero_to_one_clip);
}

// w = x - n + a. With s = (a + d)(x - n) / (d w) over the depth, and the view's width filling the map at f.
Mat4<double> warped_map(double a) {
    double const d = f - n;
    Vec4<double> const w(1, 0, 0, a - n), depth(0, -0.005, 0, 0.5);
    return from_rows(Vec4<double>(0, 0, (a + d) / (tan_half_fov * f), 0),
                     Vec4<double>(1, 0, 0, -n) * (2 * (a + d) / d) - w, depth, w);
}

// On the view axis, on a surface that leans half a right angle to both eye and light: there a step along the view is as
// long in the picture as a step across it.
Footprint<double> on_axis(Mat4<double> const& map, double z) {
    return footprint(eye(), Vec2<double>(pixels), map, texels, Vec3<double>(z, 0, 0), Vec3<double>(-1, 1, 0));
}

void expect_axes(Footprint<double> const& measured, double along, double across) {
    double const scale = closed_form::pixels_per_texel(pixels, tan_half_fov, texels);
    double const by_width = pixels / texels;  // `across` is 1 where the view's far end fills the map
    double const a = along * scale, b = across * by_width;
    EXPECT_NEAR(measured.major, std::max(a, b), 1e-10 * std::max(a, b));
    EXPECT_NEAR(measured.minor, std::min(a, b), 1e-10 * std::min(a, b));
}

constexpr double depths[] = {0.5, 0.6, 1.0, 3.3, 20.0, 79.0, 80.0};

}  // namespace

TEST(Footprint, OfAUniformMapMeetsTheClosedForm) {
    for (double z : depths)
        expect_axes(on_axis(uniform_map(n, f), z), closed_form::uniform_along(z, n, f),
                    closed_form::uniform_across(z, n, f));
}

TEST(Footprint, OfAWarpedMapMeetsTheClosedForm) {
    for (double a : {n, 2.0, closed_form::best_centre(n, f), 500.0})
        for (double z : depths)
            expect_axes(on_axis(warped_map(a), z), closed_form::warped_along(z, n, f, a),
                        closed_form::warped_across(z, n, f, a));
}

TEST(Footprint, OfLogarithmicSplitsMeetsTheClosedFormAndIsWorstAtEveryNearEnd) {
    Splits<double> const splits = practical_splits(n, f, 4, 1.0);
    for (int i = 0; i < 4; ++i) {
        double const begin = splits.plane[i], end = splits.plane[i + 1];
        Mat4<double> const map = uniform_map(begin, end);
        for (double share : {0.0, 0.3, 1.0}) {
            double const z = begin + (end - begin) * share;
            expect_axes(on_axis(map, z), closed_form::uniform_along(z, begin, end),
                        closed_form::uniform_across(z, begin, end));
        }
        double const worst = closed_form::split_uniform_worst(n, f, 4);
        EXPECT_NEAR(closed_form::uniform_along(begin, begin, end), worst, 1e-12 * worst);
    }
}

// x, y and w of the eye after the slide along the light onto the plane, and any depth.
TEST(Footprint, OfAViewDependentMapIsOneOnItsPlaneAndTheClosedFormOffIt) {
    Vec3<double> const normal = glm::normalize(Vec3<double>(0.1, 1, 0.2)),
                       travel = glm::normalize(Vec3<double>(0.5, -1, 0.3));
    Vec4<double> const plane(normal, 2.0), light(travel, 0.0);
    Mat4<double> slide(1.0);  // I - l p^T / (p . l)
    for (int column = 0; column < 4; ++column) slide[column] -= light * (plane[column] / glm::dot(plane, light));
    Mat4<double> const from_eye = eye() * slide;
    Mat4<double> const map =
        from_rows(row(from_eye, 0), row(from_eye, 1), Vec4<double>(0.01 * travel, 0.3), row(from_eye, 3));
    Vec2<double> const picture(pixels);
    for (double z : {3.0, 10.0, 40.0}) {
        Vec3<double> on(z, 0, 0.3 * z);
        on.y = -(2.0 + normal.x * on.x + normal.z * on.z) / normal.y;
        Footprint<double> const same = footprint(eye(), picture, map, pixels, on, normal);
        EXPECT_NEAR(same.major, 1.0, 1e-10);
        EXPECT_NEAR(same.minor, 1.0, 1e-10);

        for (double height : {-0.5, 0.4, 1.1}) {
            Vec3<double> const off = on - travel * height;
            Vec3<double> const leaning = glm::normalize(Vec3<double>(-0.3, 1, 0.1));
            // The eye is the origin, so that a point is also the way to it.
            double const wanted = closed_form::plane_map_area(
                std::abs(glm::dot(leaning, off)), std::abs(glm::dot(normal, on)), std::abs(glm::dot(leaning, travel)),
                std::abs(glm::dot(normal, travel)), off.x, on.x);
            EXPECT_NEAR(area(footprint(eye(), picture, map, pixels, off, leaning)), wanted, 1e-10 * wanted);
        }
    }
}

TEST(Footprint, BehindTheEyeIsNothing) {
    Footprint<double> const behind = on_axis(uniform_map(n, f), -3.0);
    EXPECT_EQ(behind.major, 0.0);
    EXPECT_EQ(behind.minor, 0.0);
}

TEST(Footprint, IsTheLimitWhereTheMapIsEdgeOnOrDoesNotHoldThePoint) {
    Vec3<double> const point(5, 0, 0), wall(-1, 0, 0);
    Footprint<double> const edge_on = footprint(eye(), Vec2<double>(pixels), uniform_map(n, f), texels, point, wall);
    EXPECT_EQ(edge_on.major, footprint_limit<double>);
    EXPECT_TRUE(laws::is_footprint(edge_on));
    Footprint<double> const behind = on_axis(warped_map(n) * -1.0, 5.0);
    EXPECT_EQ(behind.minor, footprint_limit<double>);
    EXPECT_EQ(on_axis(nowhere<double>(), 5.0).minor, footprint_limit<double>);
}

TEST(Footprint, OfASurfaceThatTheEyeSeesEdgeOnIsALine) {
    Footprint<double> const line =
        footprint(eye(), Vec2<double>(pixels), uniform_map(n, f), texels, Vec3<double>(5, 0, 0), Vec3<double>(0, 1, 0));
    EXPECT_GT(line.major, 0.1);
    EXPECT_NEAR(line.minor, 0.0, 1e-12);
}

TEST(Footprint, OfBadNumbersIsNothing) {
    double const nan = std::numeric_limits<double>::quiet_NaN();
    Mat4<double> const map = uniform_map(n, f);
    Vec3<double> const point(5, 0, 0), up(0, 1, 0);
    for (Footprint<double> const& bad : {footprint(eye(), Vec2<double>(pixels), map, texels, Vec3<double>(nan), up),
                                         footprint(eye(), Vec2<double>(nan), map, texels, point, up),
                                         footprint(eye(), Vec2<double>(-pixels, pixels), map, texels, point, up),
                                         footprint(eye(), Vec2<double>(pixels, -pixels), map, texels, point, up),
                                         footprint(eye(), Vec2<double>(pixels), map, texels, point, Vec3<double>(0)),
                                         footprint(eye() * nan, Vec2<double>(pixels), map, texels, point, up)})
        EXPECT_EQ(bad.major, 0.0);
}

TEST(Footprint, SeenFromTheMapIsItsInverse) {
    Footprint<double> const inverse = texels_per_pixel(Footprint<double>{4.0, 0.5});
    EXPECT_EQ(inverse.major, 2.0);
    EXPECT_EQ(inverse.minor, 0.25);
    EXPECT_EQ(texels_per_pixel(Footprint<double>{}).major, footprint_limit<double>);
}

// Entries of 1e-20 and 1e15 metres a texel: products of two leave the range of float.
TEST(Footprint, SurvivesFloatsSmallestAndLargestMaps) {
    for (float size : {1e-15f, 1e15f}) {
        LightBox<float> box;
        box.lo = Vec2<float>(-size);
        box.hi = Vec2<float>(size);
        Mat4<float> const map = clip_from_world(box, gl_zero_to_one_clip);
        Footprint<float> const same =
            footprint(map, Vec2<float>(512.0f), map, 1024.0f, Vec3<float>(0.0f), Vec3<float>(0.0f, 1.0f, 0.0f));
        EXPECT_NEAR(same.major, 0.5f, 1e-6f);
        EXPECT_NEAR(same.minor, 0.5f, 1e-6f);
    }
}

TEST(Footprint, OfAMapWithoutTexelsIsTheLimit) {
    Mat4<double> const map = uniform_map(n, f);
    auto const of = [&](double map_texels) {
        return footprint(eye(), Vec2<double>(pixels), map, map_texels, Vec3<double>(3, 0, 0), Vec3<double>(-1, 1, 0));
    };
    EXPECT_LT(of(texels).major, 100.0);
    for (double const none :
         {0.0, -texels, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()})
        EXPECT_EQ(of(none).major, footprint_limit<double>) << none;
}

TEST(Footprint, OfAPictureOfHalfAPixelIsNotNothing) {
    Footprint<double> const half =
        footprint(eye(), Vec2<double>(0.5), uniform_map(n, f), texels, Vec3<double>(5, 0, 0), Vec3<double>(-1, 1, 0));
    EXPECT_GT(half.major, 0.0);
}

TEST(Footprint, InAMapOfOneTexelIsThatOfItsSize) {
    Vec3<double> const point(10, -1, 0), up(0, 1, 0);
    double const one = footprint(eye(), Vec2<double>(pixels), uniform_map(n, f), 1.0, point, up).major;
    EXPECT_NEAR(one, 4.0 * footprint(eye(), Vec2<double>(pixels), uniform_map(n, f), 4.0, point, up).major, 1e-9 * one);
}

// Pixels a metre beyond what the type holds, along one axis of the picture.
TEST(Footprint, OfAPictureTooLargeForItsTypeIsNothing) {
    double const most = std::numeric_limits<double>::max();
    for (Vec2<double> const& size : {Vec2<double>(most, pixels), Vec2<double>(pixels, most)}) {
        Footprint<double> const none =
            footprint(eye(), size, uniform_map(n, f), texels, Vec3<double>(0.6, -0.9, 0), Vec3<double>(0, 1, 0));
        EXPECT_EQ(none.major, 0.0);
        EXPECT_EQ(none.minor, 0.0);
    }
}

TEST(PriceOf, IsATenthOfAFineTexelAndEndsWhereTheShadowIsLost) {
    EXPECT_NEAR(price_of(1.0), 0.1, 1e-15);
    EXPECT_NEAR(price_of(1.4), 0.14, 1e-15);
    EXPECT_NEAR(price_of(31.4), 0.14 + 30 / std::sqrt(2.0), 1e-13);
    EXPECT_NEAR(price_of(1e9), 30.14, 1e-6);
}
