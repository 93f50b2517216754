// SPDX-License-Identifier: MIT
#include "tests/twins/twin.hpp"

#include <shadowmath/footprint.hpp>

namespace {

using namespace shadowmath;
using namespace shadowmath::twins;

class FootprintTwins : public Twins {};
INSTANTIATE_TEST_SUITE_P(Drivers, FootprintTwins, twin_drivers, driver_name);

constexpr auto& shader = shaders::footprint_comp;

// With u half an epsilon: share 1 u, its square 3 u, of which at most half enters the sum; the sum 2.5 u, its root
// 2.25 u, the product 3.25 u; std::hypot 1 u. A ulp is at least 1 u, so 4 ulp.
// Of finite numbers; of others the footprint asks for no length.
TEST_P(FootprintTwins, Hypot) {
    prove({"hypot", shader, 0}, [](Draw& draw, Words& given, Words& expected) {
        Vec3<float> v = draw.vector();
        if (!all_finite(v)) v = draw.within(1.0f);
        given(v.x)(v.y);
        expected(std::hypot(v.x, v.y), 4);
    });
}

TEST_P(FootprintTwins, Area) {
    prove({"area", shader, 1}, [](Draw& draw, Words& given, Words& expected) {
        Footprint<float> const footprint{draw.number(1e3f), draw.number(10.0f)};
        given(footprint.major)(footprint.minor);
        expected(area(footprint));
    });
}

TEST_P(FootprintTwins, TexelsPerPixel) {
    prove({"texels_per_pixel", shader, 2}, [](Draw& draw, Words& given, Words& expected) {
        Footprint<float> const footprint{draw.number(1e3f), draw.number(10.0f)};
        auto const seen_from_map = texels_per_pixel(footprint);
        given(footprint.major)(footprint.minor);
        expected(seen_from_map.major)(seen_from_map.minor);
    });
}

TEST_P(FootprintTwins, GainsOnPlane) {
    prove({"gains_on_plane", shader, 4}, [](Draw& draw, Words& given, Words& expected) {
        auto const [map, light, point] = draw.seen();
        Vec2<float> const half(draw.spoilt(draw.uniform(1.0f, 4000.0f)), draw.spoilt(draw.uniform(1.0f, 4000.0f)));
        Vec3<float> const normal = draw.vector();
        given(map.clip_from_world)(point)(half)(normal);
        auto const gains =
            detail::gains_on_plane(map.clip_from_world, projected(map.clip_from_world, point), tangents(normal), half);
        expected(gains.s)(gains.t)(gains.scale);
    });
}

// Up to the lengths both sides are equal; these differ by 4 u, their sum, two products and the quotient add 2 u each.
TEST_P(FootprintTwins, Footprint) {
    prove({"footprint", shader, 3}, [](Draw& draw, Words& given, Words& expected) {
        auto const [map, light, point] = draw.seen();
        Mat4<float> const eye = draw.eye_near(point);
        Vec2<float> const pixels(draw.spoilt(draw.uniform(1.0f, 4000.0f)), draw.spoilt(draw.uniform(1.0f, 4000.0f)));
        float const texels = draw.spoilt(draw.uniform(1.0f, 8192.0f));
        Vec3<float> const normal = draw.vector();
        auto const of_texel = footprint(eye, pixels, map.clip_from_world, texels, point, normal);
        given(eye)(pixels)(map.clip_from_world)(texels)(point)(normal);
        expected(of_texel.major, 12)(of_texel.minor, 12);
    });
}

}  // namespace
