// SPDX-License-Identifier: MIT
#include "tests/laws/microquad.hpp"
#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

using namespace shadowmath;

namespace {

using V = Vec3<double>;

ViewVolume<double> off_centre_eye(ViewKind kind) {
    ViewVolume<double> eye;
    eye.pose = pose_looking(V(3, 5, 2), V(0.3, -0.8, -0.5), V(0, 1, 0));
    eye.left = -0.4;
    eye.right = 0.9;
    eye.bottom = -0.7;
    eye.top = 0.2;
    eye.kind = kind;
    return eye;
}

}  // namespace

TEST(PixelFrame, PutsWhatIsSeenAtAPixelThere) {
    for (ViewKind const kind : {ViewKind::perspective, ViewKind::orthographic})
        for (YAxis const rows : {YAxis::up, YAxis::down}) {
            ViewVolume<double> const eye = off_centre_eye(kind);
            PixelFrame<double> const frame = pixel_frame(eye, 640, 360, rows);
            // The corner of least x and greatest y of the picture, seven metres away.
            V const at = point_in_pixels(frame, point_at(eye, eye.left, eye.top, 7.0));
            double const depth = kind == ViewKind::perspective ? 7.0 : 1.0;
            EXPECT_NEAR(at.x / depth, -320.0, 1e-9);
            EXPECT_NEAR(at.y / depth, rows == YAxis::up ? 180.0 : -180.0, 1e-9);
            EXPECT_NEAR(at.z, 7.0, 1e-12);
            PixelFrame<double> const same = frame_in<double>(frame);
            EXPECT_LT(glm::length(same.to_across - frame.to_across), 1e-9 * glm::length(frame.to_across));
            EXPECT_LT(glm::length(same.to_upward - frame.to_upward), 1e-9 * glm::length(frame.to_upward));
            EXPECT_LT(glm::length(same.to_inward - frame.to_inward), 1e-12);
        }
}

TEST(PixelFrame, SaysWhatIsWrongWithTheView) {
    EXPECT_TRUE(pixel_frame(off_centre_eye(ViewKind::perspective), 0, 10).faults.has(Fault::map_too_small));
    EXPECT_TRUE(pixel_frame(off_centre_eye(ViewKind::perspective), 10, 0).faults.has(Fault::map_too_small));
    EXPECT_FALSE(pixel_frame(off_centre_eye(ViewKind::perspective), 1, 1).faults.any()) << "a picture of one pixel";
    ViewVolume<double> crossed = off_centre_eye(ViewKind::perspective);
    crossed.left = 2.0;
    EXPECT_TRUE(pixel_frame(crossed, 10, 10).faults.has(Fault::bad_frustum));
}

TEST(PixelFrame, OfPixelsAMetreLargeIsInvertedLikeAnyOther) {
    ViewVolume<double> eye;
    eye.left = eye.bottom = -1.0;
    eye.right = eye.top = 1.0;
    for (YAxis const rows : {YAxis::up, YAxis::down}) {
        PixelFrame<double> const frame = pixel_frame(eye, 2, 2, rows), same = frame_in<double>(frame);
        EXPECT_EQ(same.to_across, frame.to_across);
        EXPECT_EQ(same.to_upward, frame.to_upward);
        EXPECT_EQ(same.to_inward, frame.to_inward);
    }
}

TEST(PixelFrame, WithoutAVolumeHasNoInverseAndDividesNothingByZero) {
    PixelFrame<float> level;
    level.inward = level.across;
    auto const same = test::watched([&] { return frame_in<float>(level); });
    EXPECT_TRUE(same.calm());
    EXPECT_TRUE(all_finite(same.result.to_across) && all_finite(same.result.to_inward));
}

TEST(MicroQuad, EverySampleLiesOnThePlaneAndInThePixel) {
    for (ViewKind const kind : {ViewKind::perspective, ViewKind::orthographic}) {
        PixelFrame<double> const frame = pixel_frame(off_centre_eye(kind), 64, 36);
        for (V const& normal : {V(0, 1, 0), V(0.2, 3.0, -0.4), V(0, -1, 0.3)}) {
            bool const flat = kind == ViewKind::orthographic;
            V const ray = frame.across * (10.5 - 32.0 + frame.origin.x) + frame.upward * (20.5 - 18.0 + frame.origin.y);
            V const point = flat ? frame.eye + ray + frame.inward * 6.0 : frame.eye + (frame.inward + ray) * 6.0;
            MicroQuad<double> const quad = micro_quad(frame, 10, 20, 6.0, normal);
            ASSERT_TRUE(quad.ok);
            for (double const u : {0.0, 0.5, 1.0})
                for (double const v : {0.0, 0.3, 1.0})
                    EXPECT_TRUE(laws::is_on_the_plane_and_in_the_pixel(frame, quad, 10, 20, u, v, point, normal, 16));
        }
    }
}

TEST(MicroQuad, TheFourthCornerFollowsFromThree) {
    // 1 / t is affine in the picture: 1/t11 = 1/t10 + 1/t01 - 1/t00.
    PixelFrame<double> const frame = pixel_frame(off_centre_eye(ViewKind::perspective), 64, 36);
    V const normal(0.2, 3.0, -0.4);
    MicroQuad<double> const quad = micro_quad(frame, 3, 30, 4.0, normal);
    auto const inverse_depth = [&](double u, double v) {
        return 1.0 / glm::dot(frame.to_inward, point_on(frame, quad, 3, 30, u, v) - frame.eye);
    };
    EXPECT_NEAR(inverse_depth(1, 1), inverse_depth(1, 0) + inverse_depth(0, 1) - inverse_depth(0, 0), 1e-14);
    EXPECT_NEAR(inverse_depth(0.5, 0.5), 0.25, 1e-14);
}

TEST(MicroQuad, IsOneWithItsNegativeNormalAndItsLength) {
    PixelFrame<double> const frame = pixel_frame(off_centre_eye(ViewKind::perspective), 64, 36);
    MicroQuad<double> const a = micro_quad(frame, 3, 30, 4.0, V(0.2, 3.0, -0.4)),
                            b = micro_quad(frame, 3, 30, 4.0, V(-0.4, -6.0, 0.8));
    EXPECT_DOUBLE_EQ(a.q, b.q);
    EXPECT_DOUBLE_EQ(a.q_x, b.q_x);
    EXPECT_DOUBLE_EQ(a.q_y, b.q_y);
}

TEST(MicroQuad, OfAPlaneSeenEdgeOnStaysBetweenTwoThirdsAndTwiceItsDepth) {
    PixelFrame<double> const frame = pixel_frame(off_centre_eye(ViewKind::perspective), 64, 36);
    V const ray = frame.inward + frame.across * (10.5 - 32.0) + frame.upward * (20.5 - 18.0);
    V const edge_on = glm::cross(ray, frame.across);
    for (double const turn : {0.0, 1e-9, 1e-4, -1e-4}) {
        MicroQuad<double> const quad = micro_quad(frame, 10, 20, 6.0, edge_on + ray * turn);
        ASSERT_TRUE(quad.ok);
        for (double const u : {0.0, 1.0})
            for (double const v : {0.0, 1.0}) {
                double const depth = 1.0 / (quad.q + quad.q_x * u + quad.q_y * v);
                EXPECT_GE(depth, 6.0 * 2.0 / 3.0 - 1e-9);
                EXPECT_LE(depth, 12.0 + 1e-9);
            }
    }
}

TEST(MicroQuad, OfAPlaneSeenEdgeOnIsAsSteepAsAQuadMayBe) {
    for (ViewKind const kind : {ViewKind::perspective, ViewKind::orthographic}) {
        PixelFrame<double> const frame = pixel_frame(off_centre_eye(kind), 64, 36);
        bool const flat = kind == ViewKind::orthographic;
        V const ray = flat ? frame.inward : frame.inward + frame.across * (10.5 - 32.0) + frame.upward * (20.5 - 18.0);
        double const most = flat ? deepest_quad<double> * glm::length(frame.across) : steepest_quad<double> / 6.0;
        for (V const& aside : {frame.across, frame.upward, frame.across + frame.upward * 3.0}) {
            MicroQuad<double> const quad = micro_quad(frame, 10, 20, 6.0, glm::cross(ray, aside));
            ASSERT_TRUE(quad.ok);
            EXPECT_NEAR((std::abs(quad.q_x) + std::abs(quad.q_y)) / 2, most, 1e-9 * most);
            EXPECT_NEAR(quad.q + (quad.q_x + quad.q_y) / 2, flat ? 6.0 : 1.0 / 6.0, 1e-9 * (1 + most));
        }
    }
}

// One over the depth is a number in the middle of the pixel, but not in the corner that is nearer to the eye.
TEST(MicroQuad, ThatIsOkHasANumberAtItsCorner) {
    PixelFrame<double> const frame = pixel_frame(perspective_view<double>({}, 1.0, 1.0, 0.1, 10.0), 2, 2);
    int ok = 0, not_ok = 0;
    for (int const pixel : {0, 1})
        for (V const& normal : {V(10, 0, 1), V(0, 10, 1)}) {
            MicroQuad<double> const quad = micro_quad(frame, pixel, pixel, 7e-309, normal);
            EXPECT_EQ(quad.ok, all_finite(&quad.q, 1));
            ++(quad.ok ? ok : not_ok);
        }
    EXPECT_GT(ok, 0);
    EXPECT_GT(not_ok, 0);
}

TEST(MicroQuad, OfWhatIsNoSurfaceIsNotOk) {
    PixelFrame<float> const frame = pixel_frame(ViewVolume<float>{}, 8, 8);
    Vec3<float> const up(0, 1, 1);
    float const nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    for (float const depth : {0.0f, -1.0f, nan, infinity}) EXPECT_FALSE(micro_quad(frame, 1, 1, depth, up).ok);
    EXPECT_FALSE(micro_quad(frame, 1, 1, 2.0f, Vec3<float>(0)).ok);
    EXPECT_FALSE(micro_quad(frame, 1, 1, 2.0f, Vec3<float>(0, nan, 1)).ok);
    EXPECT_TRUE(micro_quad(frame, 1, 1, 2.0f, up).ok);
}

TEST(MicroQuad, OfADepthWhoseReciprocalOverflowsIsNotOkAndDividesNothingByZero) {
    PixelFrame<float> const frame = pixel_frame(perspective_view<float>({}, 1.0f, 1.0f, 0.1f, 10.0f), 4, 4);
    float const denormal = std::numeric_limits<float>::denorm_min();
    auto const quad =
        test::watched([&] { return micro_quad(frame, 1, 2, denormal, Vec3<float>(0.01f, 0.02f, 0.03f)); });
    EXPECT_FALSE(quad.result.ok);
    EXPECT_TRUE(quad.calm());
}
