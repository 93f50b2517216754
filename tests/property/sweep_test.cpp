// SPDX-License-Identifier: MIT
#include "tests/laws/sweep.hpp"
#include "tests/support/gen.hpp"
#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

namespace {

// A box of some metres with up to ten corners and edges cut off, and a point inside.
template <class T>
struct Cut {
    ConvexBody<T> body;
    Vec3<T> inner;
};

template <class T>
Cut<T> drawn_body() {
    Aabb<T> const start = *box<T>(T(10));
    Vec3<T> const share = *point_within<T>(T(0.5));
    Cut<T> cut{convex_body(start), start.lo + (start.hi - start.lo) * (share + T(0.5))};
    std::uint64_t const cuts = *below(10);
    for (std::uint64_t i = 0; i < cuts; ++i) {
        Vec3<T> const normal = *direction<T>();
        T const distance = *uniform<T>(T(0), T(5));
        cut.body = clipped(cut.body, Vec4<T>(normal, distance - glm::dot(normal, cut.inner)));
    }
    return cut;
}

template <class T>
Light<T> drawn_light() {
    bool const sun_or_spot = *one_in(2);
    Light<T> const sky = *sun<T>();
    Vec3<T> const place = *point_within<T>(T(50));
    return sun_or_spot ? sky : spot(place, sky.direction, T(1), T(100));
}

// Coordinates of at most 35 m, or 250 m on the way to the light; ten cuts of twenty roundings, and the sum of two
// planes twenty more. The sum is divided by its length, which at a thousandth of a turn is a thousandth.
template <class T>
constexpr T slack = T(220) * std::numeric_limits<T>::epsilon() * T(250);

template <class T>
class SweepProperty : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(SweepProperty, Scalars);

TYPED_TEST(SweepProperty, HoldsTheBodyAndAllOfTheWayToTheLight) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        auto const [body, inner] = drawn_body<T>();
        Light<T> const light = drawn_light<T>();
        T const share = *uniform<T>(T(0), T(1));
        T const metres = *uniform<T>(T(0), T(2));
        T const slope = *uniform<T>(T(0), T(0.1));
        bool const is_sun = light.kind == LightKind::directional;
        Vec3<T> const way = is_sun ? -light.direction * T(200) : light.position - inner;
        auto const swept = swept_to_light(body, homogeneous(light), SweepPadding<T>{metres, slope});
        RC_ASSERT(laws::inside(swept, inner + way * share, slack<T>));
        for_each_vertex(body, [&](Vec3<T> const& v) { RC_ASSERT(laws::inside(swept, v, slack<T>)); });
        // What stands beside the ray by no more than the sun's radius is on the way from the sun's edge.
        Vec3<T> const beside = light_basis(light.direction).x * (slope * T(200) * share);
        if (is_sun) RC_ASSERT(laws::inside(swept, inner + way * share + beside, slack<T>));
    }));
}

TYPED_TEST(SweepProperty, HoldsNothingThatDoesNotCastOnTheBody) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        auto const [body, inner] = drawn_body<T>();
        Light<T> const light = drawn_light<T>();
        Vec3<T> const point = inner + *point_within<T>(T(30));
        auto const swept = swept_to_light(body, homogeneous(light));
        if (laws::inside(swept, point, T(0)))
            RC_ASSERT(laws::casts_on(body, homogeneous(light), point, T(1e-3)));
        else
            RC_ASSERT(!laws::casts_on(body, homogeneous(light), point, T(-1e-3)));
    }));
}

TYPED_TEST(SweepProperty, CutsABoxToWhatCasts) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        auto const [body, inner] = drawn_body<T>();
        Light<T> const light = drawn_light<T>();
        Aabb<T> const casters = *box<T>(T(60));
        auto const swept = swept_to_light(body, homogeneous(light));
        auto const part = clipped(convex_body(casters), swept);
        if (part.edge_count > 0) RC_ASSERT(may_meet(swept, casters));
        if (part.face_count < max_body_faces)
            for_each_vertex(part, [&](Vec3<T> const& v) { RC_ASSERT(laws::inside(swept, v, slack<T>)); });
    }));
}

TYPED_TEST(SweepProperty, IsCalmForEveryFiniteBody) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        Aabb<T> const any = *box<T>(T(1e12));
        Light<T> const light = drawn_light<T>();
        auto const swept = watched([&] { return swept_to_light(convex_body(any), homogeneous(light)); });
        RC_ASSERT(swept.calm());
        for (Vec4<T> const& plane : swept.result) RC_ASSERT(all_finite(plane));
    }));
}

}  // namespace
