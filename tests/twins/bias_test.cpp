// SPDX-License-Identifier: MIT
#include "tests/twins/twin.hpp"

#include <shadowmath/bias.hpp>

namespace {

using namespace shadowmath;
using namespace shadowmath::twins;

class BiasTwins : public Twins {};
INSTANTIATE_TEST_SUITE_P(Drivers, BiasTwins, twin_drivers, driver_name);

constexpr auto& shader = shaders::bias_comp;

int map_size(Draw& draw) {
    return draw.one_in(32) ? draw.whole(-1, 1) : 1 << draw.whole(1, 13);
}

TEST_P(BiasTwins, Slope) {
    prove({"slope", shader, 0}, [](Draw& draw, Words& given, Words& expected) {
        auto const [map, light, point] = draw.seen();
        int const size = map_size(draw);
        // One plane in eight is grazed by the light.
        Vec3<float> const normal = draw.one_in(8) ? glm::cross(light.direction, draw.unit()) : draw.direction();
        float const limit = draw.spoilt(draw.log_uniform(1e-4f, 10.0f));
        auto const on_plane = slope(map, size, point, normal, limit);
        given(map)(size)(point)(normal)(limit);
        expected(on_plane.x)(on_plane.y);
    });
}

TEST_P(BiasTwins, Lean) {
    prove({"lean", shader, 1}, [](Draw& draw, Words& given, Words& expected) {
        auto const [map, light, point] = draw.seen();
        int const size = map_size(draw);
        float const limit = draw.spoilt(draw.log_uniform(1e-4f, 10.0f));
        auto const own = lean(map, size, point, limit);
        given(map)(size)(point)(limit);
        expected(own.x)(own.y);
    });
}

TEST_P(BiasTwins, DepthBias) {
    prove({"depth_bias", shader, 2}, [](Draw& draw, Words& given, Words& expected) {
        float const constant = draw.number(1e-2f), per_inverse_w = draw.number(1.0f), texels = draw.number(4.0f);
        MapBias<float> const bias{constant, per_inverse_w, texels, 1.0f};
        float const w = draw.spoilt(draw.log_uniform(1e-3f, 1e3f)), x = draw.number(0.1f), y = draw.number(0.1f);
        given(constant)(per_inverse_w)(texels)(1.0f)(w)(x)(y);
        expected(depth_bias(bias, w, {x, y}));
    });
}

TEST_P(BiasTwins, KernelReachTexels) {
    prove({"kernel_reach_texels", shader, 3, 8}, [](Draw& draw, Words& given, Words& expected) {
        int const radius = draw.whole(-3, 64);
        given(radius);
        expected(kernel_reach_texels<float>(radius));
    });
}

TEST_P(BiasTwins, NormalOffsetMetres) {
    prove({"normal_offset_metres", shader, 4}, [](Draw& draw, Words& given, Words& expected) {
        float const texel = draw.spoilt(draw.log_uniform(1e-4f, 10.0f));
        int const radius = draw.whole(-1, 5);
        Vec3<float> const normal = draw.direction(), to_light = draw.direction();
        given(texel)(radius)(normal)(to_light);
        expected(normal_offset_metres(texel, radius, normal, to_light));
    });
}

TEST_P(BiasTwins, NormalOffsetAt) {
    prove({"normal_offset_at", shader, 5}, [](Draw& draw, Words& given, Words& expected) {
        auto const [map, light, point] = draw.seen();
        int const size = map_size(draw), radius = draw.whole(-1, 5);
        Vec3<float> const normal = draw.direction(), to_light = toward(light, point);
        bool const is_sun = light.kind == LightKind::directional;
        float const distance = is_sun ? 0.0f : safe_normalize(point - light.position).length;
        float const most = draw.spoilt(draw.log_uniform(1e-3f, 10.0f));
        given(map)(size)(radius)(point)(normal)(to_light);
        given(distance)(depth_gain(map, light))(most);
        expected(normal_offset_at(map, light, size, radius, point, normal, most));
    });
}

}  // namespace
