// SPDX-License-Identifier: MIT
#include "tests/twins/twin.hpp"

#include <shadowmath/vdsm.hpp>

namespace {

using namespace shadowmath;
using namespace shadowmath::twins;

class VdsmTwins : public Twins {};
INSTANTIATE_TEST_SUITE_P(Drivers, VdsmTwins, twin_drivers, driver_name);

constexpr auto& shader = shaders::vdsm_comp;

TEST_P(VdsmTwins, PlaneThrough) {
    prove({"plane_through", shader, 0}, [](Draw& draw, Words& given, Words& expected) {
        Vec3<float> const point = draw.point(100.0f), normal = draw.vector();
        auto const plane = plane_through(point, normal);
        given(point)(normal);
        expected(plane.normal)(plane.offset);
    });
}

TEST_P(VdsmTwins, PlaneProjection) {
    prove({"plane_projection", shader, 1}, [](Draw& draw, Words& given, Words& expected) {
        ShadowPlane<float> const plane{draw.vector(), draw.number(100.0f)};
        // One sun in eight travels within the plane.
        bool const within = draw.one_in(8), sun = draw.one_in(2);
        Vec3<float> const travel = within ? glm::cross(plane.normal, draw.unit()) : draw.direction();
        Vec4<float> const light = sun ? Vec4<float>(travel, 0.0f) : Vec4<float>(draw.point(100.0f), -1.0f);
        given(plane.normal)(plane.offset)(light);
        expected(plane_projection(plane, light));
    });
}

TEST_P(VdsmTwins, ReceiverValid) {
    prove({"receiver_valid", shader, 2, 2}, [](Draw& draw, Words& given, Words& expected) {
        auto const [map, light, point] = draw.seen();
        Vec3<float> const anywhere = draw.one_in(2) ? point : draw.point(200.0f);
        given(map)(anywhere);
        expected(receiver_valid(map, anywhere));
    });
}

// A step of plane_projection, of finite numbers as there.
TEST_P(VdsmTwins, OverLargest) {
    prove({"over_largest", shader, 3}, [](Draw& draw, Words& given, Words& expected) {
        Vec4<float> v(draw.vector(), draw.number(100.0f));
        if (draw.one_in(64) || !all_finite(v)) v = Vec4<float>(0.0f);
        float const largest =
            std::fmax(std::fmax(std::abs(v.x), std::abs(v.y)), std::fmax(std::abs(v.z), std::abs(v.w)));
        given(v);
        expected(largest > 0.0f ? Vec4<float>(v.x / largest, v.y / largest, v.z / largest, v.w / largest) : v);
    });
}

}  // namespace
