// SPDX-License-Identifier: MIT
#include "tests/twins/twin.hpp"

namespace {

using namespace shadowmath;
using namespace shadowmath::twins;

class ShadowMapTwins : public Twins {};
INSTANTIATE_TEST_SUITE_P(Drivers, ShadowMapTwins, twin_drivers, driver_name);

constexpr auto& shader = shaders::shadow_map_comp;

// Of finite maps, as every function that makes one gives: 0 * infinity is NaN in another place than in the shader,
// which does not multiply by 0.
TEST_P(ShadowMapTwins, TextureFromWorld) {
    prove({"texture_from_world", shader, 0}, [](Draw& draw, Words& given, Words& expected) {
        ShadowMap<float> map = draw.seen().map;
        if (!all_finite(map.clip_from_world)) map.clip_from_world = nowhere<float>();
        given(map);
        expected(texture_from_world(map));
    });
}

TEST_P(ShadowMapTwins, FarDepth) {
    prove({"far_depth", shader, 1, 2}, [](Draw& draw, Words& given, Words& expected) {
        ClipSpace const clip = draw.clip_space();
        given(static_cast<int>(clip.depth));
        expected(far_depth<float>(clip));
    });
}

TEST_P(ShadowMapTwins, IsLit) {
    prove({"is_lit", shader, 2, 2}, [](Draw& draw, Words& given, Words& expected) {
        ClipSpace const clip = draw.clip_space();
        float const stored = draw.spoilt(draw.uniform(0.0f, 1.0f)), bias = draw.spoilt(draw.uniform(0.0f, 0.1f));
        // One in four lies exactly at the bias.
        float const receiver = draw.one_in(4) ? stored + bias : draw.number(1.0f);
        given(stored)(receiver)(bias)(static_cast<int>(clip.depth));
        expected(is_lit(stored, receiver, bias, clip));
    });
}

}  // namespace
