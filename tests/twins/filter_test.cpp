// SPDX-License-Identifier: MIT
#include "tests/twins/twin.hpp"

#include <shadowmath/filter.hpp>
#include <shadowmath/sampling.hpp>

namespace {

using namespace shadowmath;
using namespace shadowmath::twins;

class FilterTwins : public Twins {
protected:
    static constexpr int size = 32;
    static constexpr int layers = 3;

    // Depths all over [0, 1], both ends among them, and one that is no number.
    void SetUp() override {
        Twins::SetUp();
        if (IsSkipped()) return;
        Draw draw(7u);
        for (float& texel : texels) texel = draw.one_in(8) ? float(draw.whole(0, 1)) : draw.uniform(0.0f, 1.0f);
        texels[40] = std::numeric_limits<float>::quiet_NaN();
        textures = {runner->make_texture({size, size}, layers, texels)};
    }

    auto layer_of(int layer) const {
        return [this, layer](int x, int y) { return texels[std::size_t((layer * size + y) * size + x)]; };
    }

    static MapBias<float> bias(Draw& draw) {
        float const constant = draw.spoilt(draw.uniform(0.0f, 1e-3f)), per_inverse_w = draw.number(1e-3f);
        float const texels = draw.spoilt(draw.uniform(0.0f, 3.0f)), limit = draw.spoilt(draw.log_uniform(1e-3f, 1.0f));
        return {constant, per_inverse_w, texels, limit};
    }
    static void give(Words& given, MapBias<float> const& bias) {
        given(bias.constant)(bias.per_inverse_w)(bias.slope_texels)(bias.slope_limit);
    }

    std::vector<float> texels = std::vector<float>(std::size_t(size * size * layers));
    std::vector<Texture2DArray> textures;
};
INSTANTIATE_TEST_SUITE_P(Drivers, FilterTwins, twin_drivers, driver_name);

constexpr auto& shader = shaders::filter_comp;

int radius(Draw& draw) {
    return draw.one_in(32) ? draw.whole(-2, 12) : draw.whole(0, 3);
}
int map_size(Draw& draw, int size) {
    return draw.one_in(64) ? draw.whole(-1, 0) : size;
}

TEST_P(FilterTwins, CoveredTexels) {
    prove({"covered_texels", shader, 0, 2500, textures}, [](Draw& draw, Words& given, Words& expected) {
        int const reach = radius(draw), tap = draw.whole(-reach - 1, reach + 1);
        float const fraction = draw.spoilt(draw.uniform(0.0f, 1.0f));
        given(tap)(reach)(fraction);
        expected(covered_texels(tap, reach, fraction));
    });
}

TEST_P(FilterTwins, TapWeight) {
    prove({"tap_weight", shader, 1, 2500, textures}, [](Draw& draw, Words& given, Words& expected) {
        int const reach = radius(draw), tap = draw.whole(-reach - 1, reach + 1);
        float const fraction = draw.spoilt(draw.uniform(0.0f, 1.0f));
        given(tap)(reach)(fraction);
        expected(tap_weight(tap, reach, fraction));
    });
}

TEST_P(FilterTwins, Filtered) {
    prove({"filtered", shader, 2, 2500, textures}, [this](Draw& draw, Words& given, Words& expected) {
        int const layer = draw.whole(0, layers - 1), side = map_size(draw, size);
        float const x = draw.spoilt(draw.uniform(-5.0f, 37.0f)), y = draw.spoilt(draw.uniform(-5.0f, 37.0f));
        float const depth = draw.spoilt(draw.uniform(-0.1f, 1.1f));
        float const along_x = draw.number(0.1f), along_y = draw.number(0.1f);
        ClipSpace const clip = draw.clip_space();
        FilterOptions const options{radius(draw), draw.one_in(2)};
        given(layer)(x)(y)(depth)(along_x)(along_y)(side)(static_cast<int>(clip.depth))(options.radius)(
            options.tap_plane);
        expected(filtered(Receiver<float>{{x, y}, depth, {along_x, along_y}}, side, clip, options, layer_of(layer)));
    });
}

TEST_P(FilterTwins, Visibility) {
    prove({"visibility", shader, 3, 2500, textures}, [this](Draw& draw, Words& given, Words& expected) {
        int const layer = draw.whole(0, layers - 1), side = map_size(draw, size);
        auto const [map, light, point] = draw.seen();
        MapBias<float> const of_map = bias(draw);
        Vec3<float> const normal = draw.direction();
        FilterOptions const options{radius(draw), draw.one_in(2)};
        given(layer)(map);
        give(given, of_map);
        given(side)(point)(normal)(options.radius)(options.tap_plane);
        expected(visibility(map, side, point, normal, of_map, options, layer_of(layer)));
    });
}

TEST_P(FilterTwins, SeenBy) {
    prove({"seen_by", shader, 5, 2500, textures}, [](Draw& draw, Words& given, Words& expected) {
        int const side = map_size(draw, size);
        auto const [map, light, point] = draw.seen();
        MapBias<float> const of_map = bias(draw);
        Vec3<float> const normal = draw.direction();
        bool const tap_plane = draw.one_in(2);
        given(map);
        give(given, of_map);
        given(side)(point)(normal)(tap_plane);
        auto const seen = detail::seen_by(map, side, point, normal, of_map, tap_plane);
        expected(seen.receiver.texel)(seen.receiver.depth)(seen.receiver.slope.x)(seen.receiver.slope.y)(seen.w)(
            seen.in_map);
    });
}

// One tap of a kernel is the share of a kernel of one.
TEST_P(FilterTwins, IsTapLit) {
    prove({"is_tap_lit", shader, 6, 2, textures}, [this](Draw& draw, Words& given, Words& expected) {
        int const layer = draw.whole(0, layers - 1), side = map_size(draw, size);
        int const x = draw.whole(-2, size + 1), y = draw.whole(-2, size + 1);
        float depth = draw.spoilt(draw.uniform(-0.1f, 1.1f));
        // One in four is exactly what is stored there.
        if (draw.one_in(4) && x >= 0 && y >= 0 && x < size && y < size) depth = layer_of(layer)(x, y);
        if (!all_finite(&depth, 1)) depth = 0.5f;
        ClipSpace const clip = draw.clip_space();
        given(layer)(side)(static_cast<int>(clip.depth))(x)(y)(depth);
        Receiver<float> const there{{static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f}, depth, {}};
        bool const inside = x >= 0 && y >= 0 && x < side && y < side;
        expected(!inside || filtered(there, side, clip, FilterOptions{0, false}, layer_of(layer)) == 1.0f);
    });
}

TEST_P(FilterTwins, CascadedVisibility) {
    prove({"cascaded_visibility", shader, 4, 2500, textures}, [this](Draw& draw, Words& given, Words& expected) {
        int const side = map_size(draw, size);
        auto const seen = draw.seen();
        ShadowMap<float> const first = seen.map;
        // The next cascade holds the point too.
        ShadowMap<float> second = seen.map;
        Mat4<float> wider(1.0f);
        wider[0][0] = wider[1][1] = 0.7f;
        second.clip_from_world = wider * second.clip_from_world;
        MapBias<float> const of_first = bias(draw), of_second = bias(draw);
        LookUp<float> look_up;
        look_up.first = draw.whole(-1, 1);
        look_up.second = draw.one_in(2) ? -1 : look_up.first + 1;
        look_up.blend = draw.one_in(2) ? 0.0f : draw.spoilt(draw.uniform(0.0f, 1.0f));
        Vec3<float> const normal = draw.direction();
        FilterOptions const options{radius(draw), draw.one_in(2)};
        auto const of = [&](int layer, ShadowMap<float> const& map, MapBias<float> const& its_bias) {
            return layer < 0 ? 1.0f : visibility(map, side, seen.point, normal, its_bias, options, layer_of(layer));
        };
        given(look_up.first)(look_up.second)(look_up.blend)(first);
        give(given, of_first);
        given(second);
        give(given, of_second);
        given(side)(seen.point)(normal)(options.radius)(options.tap_plane);
        expected(blended(look_up, of(look_up.first, first, of_first), of(look_up.second, second, of_second)));
    });
}

}  // namespace
