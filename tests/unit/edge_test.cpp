// SPDX-License-Identifier: MIT
#include <shadowmath/irregular/edge.hpp>

#include <gtest/gtest.h>

#include <cmath>

using namespace shadowmath;

namespace {

template <class T>
class AnyEdge : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(AnyEdge, Scalars);

template <class T>
T value_at(PixelFrame<T> const& frame, PixelPlane<T> const& plane, Vec3<T> const& world) {
    Vec3<T> const p = point_in_pixels(frame, world);
    if (frame.kind == ViewKind::orthographic) return plane.x * p.x + plane.y * p.y + plane.a + plane.b * p.z;
    return (plane.x * p.x + plane.y * p.y + plane.a * p.z + plane.b) / p.z;
}

}  // namespace

TYPED_TEST(AnyEdge, IsPositiveOnTheSideOfTheThirdVertexAndBehindTheTriangle) {
    using T = TypeParam;
    using V = Vec3<T>;
    for (ViewKind const kind : {ViewKind::perspective, ViewKind::orthographic})
        for (bool const sun : {true, false})
            for (bool const turned_over : {true, false}) {
                ViewVolume<T> eye;
                eye.pose = pose_looking(V(0, 0, 10), V(0, 0, -1), V(0, 1, 0));
                eye.kind = kind;
                PixelFrame<T> const frame = pixel_frame(eye, 100, 100);
                Light<T> const light = sun ? directional(V(0, 0, -1)) : spot(V(0, 0, 8), V(0, 0, -1), T(1), T(50));
                V const a(-1, -1, 2), b(1, -1, 2), c(0, 1, 2);
                auto const in = [&](V const& p) { return point_in_pixels(frame, p); };
                ShadowVolume<T> const volume =
                    shadow_volume(frame, pixel_light(frame, light), in(a), in(turned_over ? c : b),
                                  in(turned_over ? b : c), ContactMargin<T>{T(1e-3), T(0)});
                EXPECT_NE(volume.along, T(0));
                V const shaded(0, 0, 0), above(0, 0, 3), beside(3, 0, 0);
                for (PixelPlane<T> const& plane : volume.planes) EXPECT_GT(value_at(frame, plane, shaded), T(0));
                EXPECT_LT(value_at(frame, volume.planes[0], above), T(0));
                int outside = 0;
                for (int i = 1; i < 4; ++i) outside += value_at(frame, volume.planes[i], beside) < T(0) ? 1 : 0;
                EXPECT_EQ(outside, 1);
                // The margin: a millimetre behind the triangle is contact, a little more is shadow.
                EXPECT_LT(value_at(frame, volume.planes[0], V(0, 0, T(1.9992))), T(0));
                EXPECT_GT(value_at(frame, volume.planes[0], V(0, 0, T(1.9988))), T(0));
            }
}

TYPED_TEST(AnyEdge, SharedByTwoTrianglesIsOppositeToTheLastBit) {
    using T = TypeParam;
    using V = Vec3<T>;
    ViewVolume<T> eye;
    eye.pose = pose_looking(V(T(3.1), T(4.7), T(5.3)), V(T(-0.3), T(-0.7), T(-0.9)), V(0, 1, 0));
    PixelFrame<T> const frame = pixel_frame(eye, 1280, 720);
    for (bool const sun : {true, false})
        for (int i = 0; i < 200; ++i) {
            auto const coordinate = [i](int k) {
                return static_cast<T>(std::sin(12.9898 * (i * 4 + k) + 78.233) * 3.0);
            };
            V const a(coordinate(0), coordinate(1), coordinate(2)), b(coordinate(3), coordinate(4), coordinate(5));
            V const c(coordinate(6), coordinate(7), coordinate(8)), d(coordinate(9), coordinate(10), coordinate(11));
            Light<T> const light =
                sun ? directional(V(T(0.3), T(-1), T(0.2))) : spot(V(T(0.7), T(9), T(0.3)), V(0, -1, 0), T(1), T(50));
            auto const volume = [&](V const& p, V const& q, V const& r) {
                auto const in = [&](V const& v) { return point_in_pixels(frame, v); };
                return shadow_volume(frame, pixel_light(frame, light), in(p), in(q), in(r), ContactMargin<T>{});
            };
            PixelPlane<T> const one = volume(a, b, c).planes[1], other = volume(b, a, d).planes[1];
            bool const same = one.x == other.x;
            T const sign = same ? T(1) : T(-1);
            EXPECT_EQ(one.x, sign * other.x);
            EXPECT_EQ(one.y, sign * other.y);
            EXPECT_EQ(one.a, sign * other.a);
            EXPECT_EQ(one.b, sign * other.b);
        }
}

TYPED_TEST(AnyEdge, SeenThroughAPixelIsAStraightLine) {
    using T = TypeParam;
    using V = Vec3<T>;
    ViewVolume<T> eye;
    eye.pose = pose_looking(V(0, 4, 4), V(0, -1, -1), V(0, 1, 0));
    for (ViewKind const kind : {ViewKind::perspective, ViewKind::orthographic}) {
        eye.kind = kind;
        PixelFrame<T> const frame = pixel_frame(eye, 16, 16);
        auto const in = [&](V const& p) { return point_in_pixels(frame, p); };
        ShadowVolume<T> const volume =
            shadow_volume(frame, pixel_light(frame, directional(V(T(0.3), -1, T(0.2)))), in(V(-1, 1, 0)),
                          in(V(1, 1, 0)), in(V(0, T(1.5), 1)), ContactMargin<T>{});
        MicroQuad<T> const quad = micro_quad(frame, 5, 3, T(4), V(T(0.1), 1, T(0.2)));
        for (PixelPlane<T> const& plane : volume.planes) {
            PixelLine<T> const line = line_across(frame, plane, quad, 5, 3);
            for (T const u : {T(0), T(0.3), T(1)})
                for (T const v : {T(0), T(0.7), T(1)}) {
                    T const at = value_at(frame, plane, point_on(frame, quad, 5, 3, u, v));
                    T const scale = std::abs(plane.x) * T(8) + std::abs(plane.y) * T(8) + std::abs(plane.a) +
                                    std::abs(plane.b) * (T(1) + std::abs(quad.q));
                    // A dozen roundings of the largest term on either way.
                    EXPECT_NEAR(line.c + line.x * u + line.y * v, at,
                                T(24) * std::numeric_limits<T>::epsilon() * scale);
                }
        }
    }
}

// Along the triangle's normal, from once to sqrt(3) times as far as it says.
TYPED_TEST(AnyEdge, AMarginBeginsBehindTheTriangleWhateverItsSlope) {
    using T = TypeParam;
    using V = Vec3<T>;
    ViewVolume<T> eye;
    eye.pose = pose_looking(V(0, 4, 12), V(T(0.1), T(-0.2), -1), V(0, 1, 0));
    V const travel(T(0.3), T(-1), T(0.2));
    for (ViewKind const kind : {ViewKind::perspective, ViewKind::orthographic})
        for (int i = 0; i < 100; ++i) {
            eye.kind = kind;
            PixelFrame<T> const frame = pixel_frame(eye, 1280, 720);
            auto const coordinate = [i](int k) {
                return static_cast<T>(std::sin(12.9898 * (i * 9 + k) + 78.233) * 3.0);
            };
            V const a(coordinate(0), coordinate(1), coordinate(2)), b(coordinate(3), coordinate(4), coordinate(5));
            V const c(coordinate(6), coordinate(7), coordinate(8));
            V behind = glm::normalize(glm::cross(b - a, c - a));
            if (glm::dot(behind, travel) < T(0)) behind = -behind;
            for (bool const by_share : {false, true}) {
                ContactMargin<T> const margin{T(by_share ? 0 : 0.2), T(by_share ? 0.02 : 0)};
                ShadowVolume<T> const volume =
                    shadow_volume(frame, pixel_light(frame, directional(travel)), point_in_pixels(frame, a),
                                  point_in_pixels(frame, b), point_in_pixels(frame, c), margin);
                V const middle = (a + b + c) / T(3);
                T const metres = by_share ? T(0.02) * point_in_pixels(frame, middle).z : T(0.2);
                EXPECT_LT(value_at(frame, volume.planes[0], middle + behind * (metres * T(0.95))), T(0)) << i;
                EXPECT_GT(value_at(frame, volume.planes[0], middle + behind * (metres * T(1.85))), T(0)) << i;
            }
        }
}
