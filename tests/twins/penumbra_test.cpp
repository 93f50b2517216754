// SPDX-License-Identifier: MIT
#include "tests/twins/soft.hpp"

namespace {

using namespace shadowmath;
using namespace shadowmath::twins;

class PenumbraTwins : public Twins {};
INSTANTIATE_TEST_SUITE_P(Drivers, PenumbraTwins, twin_drivers, driver_name);

constexpr auto& shader = shaders::penumbra_comp;

Vec4<float> place(Draw& draw, Draw::Seen const& seen) {
    Vec4<float> drawn = place_from_world(seen.map) * Vec4<float>(seen.point, 1.0f);
    for (int i = 0; i < 4; ++i) drawn[i] = draw.spoilt(drawn[i]);
    return drawn;
}

// A light that can be used: as C++ and as the shader take it.
struct Both {
    Light<float> light;
    Vec4<float> given;
};
Both light(Draw& draw) {
    Vec3<float> const axis = draw.unit(), position = draw.within(100.0f);
    bool const lamp = draw.one_in(2);
    Light<float> const drawn = lamp ? spot(position, axis, 0.5f, 10.0f) : directional(axis);
    return {drawn, lamp ? Vec4<float>(position, 1.0f) : Vec4<float>(-drawn.direction, 0.0f)};
}

TEST_P(PenumbraTwins, PenumbraMetres) {
    prove({"penumbra_metres", shader, 0}, [](Draw& draw, Words& given, Words& expected) {
        float const radius = draw.number(1.0f), gap = draw.number(10.0f);
        given(radius)(gap);
        expected(penumbra_metres(radius, gap));
    });
}

TEST_P(PenumbraTwins, GapOfMetres) {
    prove({"gap_of_metres", shader, 1}, [](Draw& draw, Words& given, Words& expected) {
        auto const [of, as_given] = light(draw);
        Vec3<float> const point = draw.point(100.0f);
        float const metres = draw.spoilt(draw.log_uniform(1e-3f, 200.0f));
        given(as_given)(point)(metres);
        expected(gap_of_metres(of, point, metres));
    });
}

TEST_P(PenumbraTwins, MetresOfGap) {
    prove({"metres_of_gap", shader, 2}, [](Draw& draw, Words& given, Words& expected) {
        auto const [of, as_given] = light(draw);
        Vec3<float> const point = draw.point(100.0f);
        float const gap = draw.spoilt(draw.log_uniform(1e-3f, 100.0f));
        given(as_given)(point)(gap);
        expected(metres_of_gap(of, point, gap));
    });
}

TEST_P(PenumbraTwins, Across) {
    prove({"across", shader, 3}, [](Draw& draw, Words& given, Words& expected) {
        auto const seen = draw.seen();
        MapPenumbra<float> const penumbra = penumbra_of(draw, seen.map, seen.light);
        Vec4<float> const receiver = place(draw, seen);
        float const x = draw.number(1.0f), y = draw.number(1.0f), gap = draw.spoilt(draw.log_uniform(1e-3f, 100.0f));
        give(given, penumbra);
        given(receiver)(x)(y)(gap);
        expected(across(penumbra, receiver, Vec2<float>(x, y), gap));
    });
}

TEST_P(PenumbraTwins, GapAt) {
    prove({"gap_at", shader, 4}, [](Draw& draw, Words& given, Words& expected) {
        auto const seen = draw.seen();
        MapPenumbra<float> const penumbra = penumbra_of(draw, seen.map, seen.light);
        Vec4<float> const at = place(draw, seen);
        float const depth = draw.spoilt(draw.uniform(0.0f, 1.0f));
        give(given, penumbra);
        given(at)(depth);
        expected(gap_at(penumbra, at, depth));
    });
}

TEST_P(PenumbraTwins, KernelTexels) {
    prove({"kernel_texels", shader, 5}, [](Draw& draw, Words& given, Words& expected) {
        auto const seen = draw.seen();
        Vec4<float> const receiver = place(draw, seen);
        int const size = draw.one_in(32) ? draw.whole(-1, 0) : 1 << draw.whole(4, 13);
        float const gap = draw.spoilt(draw.log_uniform(1e-3f, 100.0f));
        MapPenumbra<float> const penumbra = penumbra_of(draw, seen.map, seen.light);
        give(given, penumbra);
        given(receiver)(size)(gap);
        expected(kernel_texels(penumbra, receiver, size, gap));
    });
}

TEST_P(PenumbraTwins, IsFinite) {
    prove({"is_finite", shader, 6, 2}, [](Draw& draw, Words& given, Words& expected) {
        auto const seen = draw.seen();
        MapPenumbra<float> const penumbra = penumbra_of(draw, seen.map, seen.light);
        give(given, penumbra);
        expected(detail::is_finite(penumbra));
    });
}

}  // namespace
