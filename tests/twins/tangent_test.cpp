// SPDX-License-Identifier: MIT
#include "tests/twins/twin.hpp"

#include <shadowmath/tangent.hpp>

namespace {

using namespace shadowmath;
using namespace shadowmath::twins;

class TangentTwins : public Twins {};
INSTANTIATE_TEST_SUITE_P(Drivers, TangentTwins, twin_drivers, driver_name);

constexpr auto& shader = shaders::tangent_comp;

TEST_P(TangentTwins, AllFinite) {
    prove({"all_finite", shader, 0, 2}, [](Draw& draw, Words& given, Words& expected) {
        Vec3<float> const v = draw.vector();
        given(v);
        expected(all_finite(v));
    });
}

TEST_P(TangentTwins, SafeNormalize) {
    prove({"safe_normalize", shader, 1}, [](Draw& draw, Words& given, Words& expected) {
        Vec3<float> const v = draw.vector();
        auto const unit = safe_normalize(v);
        given(v);
        expected(unit.direction)(unit.length)(unit.ok);
    });
}

TEST_P(TangentTwins, Transformed) {
    prove({"transformed", shader, 2}, [](Draw& draw, Words& given, Words& expected) {
        auto const seen = draw.seen();
        given(seen.map.clip_from_world)(seen.point);
        expected(transformed(seen.map.clip_from_world, seen.point));
    });
}

TEST_P(TangentTwins, Projected) {
    prove({"projected", shader, 3}, [](Draw& draw, Words& given, Words& expected) {
        auto const [map, light, point] = draw.seen();
        auto const at = projected(map.clip_from_world, point, map.w_min);
        given(map.clip_from_world)(point)(map.w_min);
        expected(at.at)(at.w)(at.in_front);
    });
}

TEST_P(TangentTwins, GainAlong) {
    prove({"gain_along", shader, 4}, [](Draw& draw, Words& given, Words& expected) {
        auto const [map, light, point] = draw.seen();
        Vec3<float> const direction = draw.direction();
        given(map.clip_from_world)(point)(direction);
        expected(gain_along(map.clip_from_world, projected(map.clip_from_world, point), direction));
    });
}

TEST_P(TangentTwins, Tangents) {
    prove({"tangents", shader, 5}, [](Draw& draw, Words& given, Words& expected) {
        Vec3<float> const normal = draw.vector();
        auto const plane = tangents(normal);
        given(normal);
        expected(plane.s)(plane.t)(plane.ok);
    });
}

TEST_P(TangentTwins, BoundedQuotient) {
    prove({"bounded_quotient", shader, 6}, [](Draw& draw, Words& given, Words& expected) {
        float const a = draw.number(10.0f), b = draw.number(10.0f), limit = draw.spoilt(draw.log_uniform(0.1f, 1e6f));
        given(a)(b)(limit);
        expected(bounded_quotient(a, b, limit));
    });
}

// One number in thirty is not finite.
TEST_P(TangentTwins, AllFiniteOfEveryShape) {
    prove({"all_finite, every shape", shader, 7, 6}, [](Draw& draw, Words& given, Words& expected) {
        Mat4<float> matrix(1.0f);
        for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = draw.one_in(30) ? draw.nasty() : draw.uniform(-1.0f, 1.0f);
        given(matrix);
        expected(all_finite(matrix))(all_finite(matrix[0]))(all_finite(Vec2<float>(matrix[1])))(
            all_finite(&matrix[2].x, 1));
    });
}

TEST_P(TangentTwins, DotAndCross) {
    prove({"dot, cross", shader, 8}, [](Draw& draw, Words& given, Words& expected) {
        Mat4<float> matrix(1.0f);
        for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = draw.number(1e3f);
        Vec3<float> const a(matrix[0]), b(matrix[1]);
        given(matrix);
        expected(glm::dot(a, b))(glm::dot(matrix[2], matrix[3]))(glm::cross(a, b));
    });
}

}  // namespace
