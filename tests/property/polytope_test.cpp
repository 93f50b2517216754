// SPDX-License-Identifier: MIT
#include "tests/laws/polytope.hpp"
#include "tests/support/gen.hpp"
#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

template <class T>
class PolytopeProperty : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(PolytopeProperty, Scalars);

TYPED_TEST(PolytopeProperty, KeepsWhatIsInsideEveryCutAndNothingElse) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        Aabb<T> const start = *box<T>(T(10));
        Vec3<T> const share = *point_within<T>(T(0.5));
        Vec3<T> const kept = start.lo + (start.hi - start.lo) * (share + T(0.5));
        ConvexBody<T> body = convex_body(corners(start));
        std::uint64_t const cuts = *below(18);
        // Twenty roundings a cut over coordinates of at most 35 m; errors of one cut's places shift the next one's.
        T const slack = T(20 * 18) * std::numeric_limits<T>::epsilon() * T(35);
        for (std::uint64_t i = 0; i < cuts; ++i) {
            Vec3<T> const normal = *direction<T>();
            T const distance = *uniform<T>(T(0), T(5));
            Vec4<T> const cut(normal, distance - glm::dot(normal, kept));
            body = clipped(body, cut);
            RC_ASSERT(laws::lies_inside(body, cut, slack));
        }
        RC_ASSERT(laws::may_contain(body, kept, slack));
        RC_ASSERT(laws::is_a_polyhedron(body));
    }));
}

TYPED_TEST(PolytopeProperty, IsCalmForEveryViewAndEveryFiniteBox) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        ViewVolume<T> const view = *view_volume<T>();
        Aabb<T> const any = *nasty_box<T>();
        RC_PRE(all_finite(any));
        auto const seen = watched([&] { return visible_body(view, any); });
        RC_ASSERT(seen.calm());
        for_each_vertex(seen.result, [](Vec3<T> const& v) { RC_ASSERT(all_finite(v)); });
    }));
}
