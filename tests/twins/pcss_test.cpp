// SPDX-License-Identifier: MIT
#include "tests/twins/soft.hpp"

namespace {

using namespace shadowmath;
using namespace shadowmath::twins;

class PcssTwins : public Twins {
protected:
    static constexpr int size = 32;
    static constexpr int layers = 3;

    // One layer of depths all over [0, 1] and one that is no number, one of a wall over a floor, one empty.
    void SetUp() override {
        Twins::SetUp();
        if (IsSkipped()) return;
        Draw draw(7u);
        for (int i = 0; i < size * size; ++i) {
            at(0, i) = draw.one_in(8) ? float(draw.whole(0, 1)) : draw.uniform(0.0f, 1.0f);
            at(1, i) = i % size < size / 2 ? draw.uniform(0.3f, 0.32f) : 0.8f;
            at(2, i) = 1.0f;
        }
        at(0, 40) = std::numeric_limits<float>::quiet_NaN();
        textures = {runner->make_texture({size, size}, layers, texels)};
    }

    float& at(int layer, int texel) { return texels[std::size_t(layer * size * size + texel)]; }
    auto layer_of(int layer) const {
        return [this, layer](int x, int y) { return texels[std::size_t((layer * size + y) * size + x)]; };
    }

    std::vector<float> texels = std::vector<float>(std::size_t(size * size * layers));
    std::vector<Texture2DArray> textures;
};
INSTANTIATE_TEST_SUITE_P(Drivers, PcssTwins, twin_drivers, driver_name);

constexpr auto& shader = shaders::pcss_comp;

PcssOptions<float> options(Draw& draw) {
    PcssOptions<float> drawn;
    drawn.search_taps = draw.one_in(32) ? draw.whole(-2, 300) : draw.whole(1, 40);
    drawn.filter_taps = draw.one_in(32) ? draw.whole(-2, 300) : draw.whole(1, 40);
    float const angle = draw.uniform(0.0f, 6.28f);
    drawn.turn = Vec2<float>(draw.spoilt(std::cos(angle)), draw.spoilt(std::sin(angle)));
    return drawn;
}

void give(Words& given, PcssOptions<float> const& options) {
    given(options.search_taps)(options.filter_taps)(options.turn);
}
void give(Words& expected, SoftShadow<float> const& shadow) {
    expected(shadow.visibility)(shadow.gap)(shadow.blocked);
}

TEST_P(PcssTwins, NextDirection) {
    prove({"next_direction", shader, 0, 2500, textures}, [](Draw& draw, Words& given, Words& expected) {
        Vec2<float> const direction(draw.number(1.0f), draw.number(1.0f));
        given(direction);
        expected(next_direction(direction));
    });
}

TEST_P(PcssTwins, SoftFiltered) {
    prove({"soft_filtered", shader, 1, 2500, textures}, [this](Draw& draw, Words& given, Words& expected) {
        int const layer = draw.whole(0, layers - 1), side = draw.one_in(64) ? draw.whole(-1, 0) : size;
        float const x = draw.spoilt(draw.uniform(-5.0f, 37.0f)), y = draw.spoilt(draw.uniform(-5.0f, 37.0f));
        float const depth = draw.spoilt(draw.uniform(-0.1f, 1.1f));
        float const along_x = draw.number(0.01f), along_y = draw.number(0.01f);
        float const w = draw.spoilt(draw.log_uniform(0.1f, 10.0f));
        // Kernels of up to a third of the map.
        MapPenumbra<float> penumbra;
        for (int i = 0; i < 4; ++i) {
            penumbra.rim_x[i] = draw.number(i == 3 ? 0.02f : 0.1f);
            penumbra.rim_y[i] = draw.number(i == 3 ? 0.02f : 0.1f);
        }
        penumbra.depth_of_gap = draw.spoilt(draw.log_uniform(0.1f, 1.0f));
        penumbra.largest_gap = draw.spoilt(draw.log_uniform(0.1f, 1e3f));
        ClipSpace const clip = draw.clip_space();
        PcssOptions<float> const taps = options(draw);
        given(layer)(x)(y)(depth)(along_x)(along_y)(w);
        twins::give(given, penumbra);
        given(side)(static_cast<int>(clip.depth));
        give(given, taps);
        give(expected, soft_filtered(Receiver<float>{{x, y}, depth, {along_x, along_y}}, w, penumbra, side, clip, taps,
                                     layer_of(layer)));
    });
}

TEST_P(PcssTwins, SoftVisibility) {
    prove({"soft_visibility", shader, 2, 2500, textures}, [this](Draw& draw, Words& given, Words& expected) {
        int const layer = draw.whole(0, 1), side = draw.one_in(64) ? draw.whole(-1, 0) : size;
        auto const [map, light, point] = draw.seen();
        MapBias<float> const bias{draw.spoilt(draw.uniform(0.0f, 1e-3f)), draw.number(1e-3f),
                                  draw.spoilt(draw.uniform(0.0f, 3.0f)), draw.spoilt(draw.log_uniform(1e-3f, 1.0f))};
        MapPenumbra<float> const penumbra = penumbra_of(draw, map, light);
        Vec3<float> const normal = draw.direction();
        PcssOptions<float> const taps = options(draw);
        given(layer)(map)(bias.constant)(bias.per_inverse_w)(bias.slope_texels)(bias.slope_limit);
        twins::give(given, penumbra);
        given(side)(point)(normal);
        give(given, taps);
        give(expected, soft_visibility(map, side, point, normal, bias, penumbra, taps, layer_of(layer)));
    });
}

// The steps. A plane before or behind the depths of the map.
detail::TapPlane<float> plane(Draw& draw) {
    float const x = draw.spoilt(draw.uniform(-1.0f, 33.0f)), y = draw.spoilt(draw.uniform(-1.0f, 33.0f));
    float const depth = draw.spoilt(draw.uniform(0.0f, 1.0f)), along_x = draw.number(0.01f),
                along_y = draw.number(0.01f);
    return {Vec2<float>(x, y), depth, {along_x, along_y}};
}
void give(Words& given, detail::TapPlane<float> const& plane) {
    given(plane.texel)(plane.depth)(plane.slope.x)(plane.slope.y);
}

MapPenumbra<float> penumbra(Draw& draw) {
    MapPenumbra<float> drawn;
    for (int i = 0; i < 4; ++i) {
        drawn.rim_x[i] = draw.number(i == 3 ? 0.02f : 0.1f);
        drawn.rim_y[i] = draw.number(i == 3 ? 0.02f : 0.1f);
    }
    drawn.depth_of_gap = draw.log_uniform(0.1f, 1.0f);
    drawn.largest_gap = draw.spoilt(draw.log_uniform(0.1f, 1e3f));
    return drawn;
}

Vec4<float> place(Draw& draw) {
    float const w = draw.spoilt(draw.log_uniform(0.1f, 10.0f)), x = draw.spoilt(draw.uniform(-0.1f, 1.1f) * w);
    float const y = draw.spoilt(draw.uniform(-0.1f, 1.1f) * w);
    return Vec4<float>(x, y, draw.spoilt(draw.uniform(0.0f, 1.0f) * w), w);
}

TEST_P(PcssTwins, TapsAndTheirPlane) {
    prove({"tap_depth, plane_depth", shader, 3, 2500, textures}, [this](Draw& draw, Words& given, Words& expected) {
        int const layer = draw.whole(0, layers - 1), x = draw.whole(-2, size + 1), y = draw.whole(-2, size + 1);
        bool const reversed_depth = draw.one_in(2);
        auto const stored = layer_of(layer);
        detail::TapMap<float, decltype(stored)> const map{stored, size, reversed_depth};
        auto const drawn = plane(draw);
        given(layer)(size)(static_cast<int>(reversed_depth ? DepthOrder::one_to_zero : DepthOrder::zero_to_one))(x)(y);
        give(given, drawn);
        expected(map.holds(x, y))(map.holds(x, y) ? map.depth(x, y) : 0.0f)(drawn.at(x, y));
    });
}

TEST_P(PcssTwins, TexelOf) {
    prove({"texel_of", shader, 4, 2500, textures}, [](Draw& draw, Words& given, Words& expected) {
        int const side = 1 << draw.whole(0, 13);
        Vec4<float> const at = place(draw);
        Vec2<float> texel(0.0f);
        bool const is_near = detail::texel_of(at, side, texel);
        given(side)(at);
        expected(is_near)(is_near ? texel : Vec2<float>(0.0f));
    });
}

TEST_P(PcssTwins, MeanOfFour) {
    prove({"mean_of_four", shader, 5, 2500, textures}, [](Draw& draw, Words& given, Words& expected) {
        Vec4<float> values(1.0f);
        for (int i = 0; i < 4; ++i) values[i] = draw.spoilt(draw.uniform(0.0f, 1.0f));
        detail::Around<float> four(Vec2<float>(draw.uniform(0.0f, 32.0f), draw.uniform(0.0f, 32.0f)));
        given(values)(four.share);
        expected(four.mean([&](int x, int y) { return values[(x - four.x) + 2 * (y - four.y)]; }));
    });
}

TEST_P(PcssTwins, Search) {
    prove({"search", shader, 6, 2500, textures}, [this](Draw& draw, Words& given, Words& expected) {
        int const layer = draw.whole(0, 1), taps = draw.whole(1, 40);
        bool const reversed_depth = draw.one_in(2);
        auto const stored = layer_of(layer);
        detail::TapMap<float, decltype(stored)> const map{stored, size, reversed_depth};
        auto const drawn = plane(draw);
        Vec4<float> const receiver = place(draw);
        MapPenumbra<float> const of_map = penumbra(draw);
        float const angle = draw.uniform(0.0f, 6.28f);
        Vec2<float> const direction(std::cos(angle), std::sin(angle));
        given(layer);
        give(given, drawn);
        given(receiver);
        twins::give(given, of_map);
        given(static_cast<int>(reversed_depth ? DepthOrder::one_to_zero : DepthOrder::zero_to_one))(taps)(direction);
        auto const found = detail::search(map, drawn, receiver, of_map, taps, direction);
        expected(found.blocked ? 0.0f : 1.0f)(found.gap)(found.blocked);
    });
}

// Texels that casts can reach: of a place that texel_of takes.
TEST_P(PcssTwins, LitAround) {
    prove({"lit_around", shader, 7, 1000, textures}, [this](Draw& draw, Words& given, Words& expected) {
        int const layer = draw.whole(0, 1);
        bool const reversed_depth = draw.one_in(2);
        auto const stored = layer_of(layer);
        detail::TapMap<float, decltype(stored)> const map{stored, size, reversed_depth};
        auto const drawn = plane(draw);
        Vec2<float> const texel(draw.uniform(-1.0f, 33.0f), draw.uniform(-1.0f, 33.0f));
        given(layer);
        give(given, drawn);
        given(static_cast<int>(reversed_depth ? DepthOrder::one_to_zero : DepthOrder::zero_to_one))(texel);
        expected(detail::lit_around(map, drawn, texel));
    });
}

// What search asks of one tap, written out.
TEST_P(PcssTwins, GapInCone) {
    prove({"gap_in_cone", shader, 8, 2000, textures}, [this](Draw& draw, Words& given, Words& expected) {
        int const layer = draw.whole(0, 1), x = draw.whole(-2, size + 1), y = draw.whole(-2, size + 1);
        bool const reversed_depth = draw.one_in(2);
        auto const stored = layer_of(layer);
        detail::TapMap<float, decltype(stored)> const map{stored, size, reversed_depth};
        auto const drawn = plane(draw);
        Vec4<float> const at = place(draw);
        MapPenumbra<float> const of_map = penumbra(draw);
        float const least = draw.spoilt(draw.uniform(0.0f, 0.1f)), widest = draw.log_uniform(0.1f, 10.0f);
        given(layer);
        give(given, drawn);
        given(at);
        twins::give(given, of_map);
        given(static_cast<int>(reversed_depth ? DepthOrder::one_to_zero : DepthOrder::zero_to_one))(x)(
            y)(least)(widest);
        float gap = 0.0f;
        if (map.holds(x, y)) {
            gap = gap_at(of_map, at, map.depth(x, y));
            bool const blocks = map.depth(x, y) < drawn.at(x, y) && gap >= least;
            gap = blocks ? (gap < widest ? gap : widest) : 0.0f;
        }
        expected(gap);
    });
}

}  // namespace
