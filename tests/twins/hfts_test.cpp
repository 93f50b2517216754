// SPDX-License-Identifier: MIT
#include "tests/twins/twin.hpp"

#include <shadowmath/hfts.hpp>

namespace {

using namespace shadowmath;
using namespace shadowmath::twins;

class HftsTwins : public Twins {};
INSTANTIATE_TEST_SUITE_P(Drivers, HftsTwins, twin_drivers, driver_name);

constexpr auto& shader = shaders::hfts_comp;

float gap(Draw& draw) {
    return draw.spoilt(draw.one_in(8) ? 0.0f : draw.log_uniform(1e-4f, 1e2f));
}

TEST_P(HftsTwins, Softness) {
    prove({"softness", shader, 0}, [](Draw& draw, Words& given, Words& expected) {
        float const of = gap(draw), soft_gap = gap(draw);
        given(of)(soft_gap);
        expected(softness(of, soft_gap));
    });
}

TEST_P(HftsTwins, HybridVisibility) {
    prove({"hybrid_visibility", shader, 1}, [](Draw& draw, Words& given, Words& expected) {
        ExactShadow<float> exact;
        exact.visibility = draw.spoilt(static_cast<float>(draw.whole(0, 32)) / 32.0f);
        exact.gap = gap(draw);
        SoftShadow<float> soft;
        soft.blocked = draw.one_in(2);
        soft.visibility = draw.spoilt(draw.uniform(0.0f, 1.0f));
        soft.gap = gap(draw);
        float const soft_gap = gap(draw);
        given(exact.visibility)(exact.gap)(soft.visibility)(soft.gap)(soft.blocked)(soft_gap);
        expected(hybrid_visibility(exact, soft, soft_gap));
    });
}

}  // namespace
