// SPDX-License-Identifier: MIT
#include "tests/twins/twin.hpp"

#include <shadowmath/msm.hpp>
#include <shadowmath/vsm.hpp>

namespace {

using namespace shadowmath;
using namespace shadowmath::twins;

class MomentsTwins : public Twins {
protected:
    static constexpr int size = 32;
    static constexpr int layers = 2;

    void SetUp() override {
        Twins::SetUp();
        if (IsSkipped()) return;
        Draw draw(7u);
        for (float& texel : texels) texel = draw.uniform(0.0f, 1.0f);
        textures = {runner->make_texture({size, size}, layers, texels)};
    }

    std::vector<float> texels = std::vector<float>(std::size_t(size * size * layers));
    std::vector<Texture2DArray> textures;
};
INSTANTIATE_TEST_SUITE_P(Drivers, MomentsTwins, twin_drivers, driver_name);

constexpr auto& shader = shaders::moments_comp;

float depth(Draw& draw) {
    return draw.spoilt(draw.uniform(-0.1f, 1.1f));
}

// The mean of one to four depths' moments, as a blur leaves them.
template <class Moments>
auto mean(Draw& draw, Moments const& moments_of) {
    decltype(moments_of(0.0f)) sum(0.0f);
    int const count = draw.whole(1, 4);
    for (int i = 0; i < count; ++i) sum += moments_of(draw.uniform(0.0f, 1.0f)) / static_cast<float>(count);
    for (int k = 0; k < decltype(sum)::length(); ++k) sum[k] = draw.spoilt(sum[k]);
    return sum;
}

EvsmExponents<float> exponents(Draw& draw) {
    float const growing = draw.spoilt(draw.uniform(1.0f, 42.0f)), falling = draw.spoilt(draw.uniform(1.0f, 42.0f));
    return {growing, falling};
}

TEST_P(MomentsTwins, MeanMoments) {
    prove({"mean_moments", shader, 0, 2500, textures}, [this](Draw& draw, Words& given, Words& expected) {
        int const layer = draw.whole(0, layers - 1), side = draw.one_in(64) ? draw.whole(-1, 0) : size;
        int const radius = draw.one_in(32) ? draw.whole(-2, 12) : draw.whole(0, 3);
        float const x = draw.spoilt(draw.uniform(-5.0f, 37.0f)), y = draw.spoilt(draw.uniform(-5.0f, 37.0f));
        float const outside = draw.number(1.0f);
        auto const stored = [&](int i, int j) {
            return Vec4<float>(texels[std::size_t((layer * size + j) * size + i)]);
        };
        given(layer)(x)(y)(side)(radius)(outside);
        expected(mean_moments(Vec2<float>(x, y), side, radius, Vec4<float>(outside), stored).x);
    });
}

TEST_P(MomentsTwins, LessBleeding) {
    prove({"less_bleeding", shader, 1, 2500, textures}, [](Draw& draw, Words& given, Words& expected) {
        float const visibility = draw.spoilt(draw.uniform(0.0f, 1.0f)), amount = draw.number(1.0f);
        given(visibility)(amount);
        expected(less_bleeding(visibility, amount));
    });
}

TEST_P(MomentsTwins, VsmMoments) {
    prove({"vsm_moments", shader, 2, 2500, textures}, [](Draw& draw, Words& given, Words& expected) {
        float const at = depth(draw);
        given(at);
        expected(vsm_moments(at));
    });
}

TEST_P(MomentsTwins, VsmVisibility) {
    prove({"vsm_visibility", shader, 3, 2500, textures}, [](Draw& draw, Words& given, Words& expected) {
        Vec2<float> const moments = mean(draw, vsm_moments<float>);
        float const at = depth(draw), deviation = draw.number(0.01f);
        given(moments)(at)(deviation);
        expected(vsm_visibility(moments, at, deviation));
    });
}

// x rounds to half an ulp of 42 / ln 2 before two is raised to it: 42 half ulps of the result; Mesa's polynomial adds
// as much again.
TEST_P(MomentsTwins, EvsmWarp) {
    prove({"evsm_warp", shader, 4, 2500, textures}, [](Draw& draw, Words& given, Words& expected) {
        float const at = depth(draw);
        EvsmExponents<float> const warp = exponents(draw);
        given(at)(warp.growing)(warp.falling);
        expected(evsm_warp(at, warp), 128);
    });
}

TEST_P(MomentsTwins, EvsmMoments) {
    prove({"evsm_moments", shader, 5, 2500, textures}, [](Draw& draw, Words& given, Words& expected) {
        float const at = depth(draw);
        EvsmExponents<float> const warp = exponents(draw);
        given(at)(warp.growing)(warp.falling);
        expected(evsm_moments(at, warp), 256);
    });
}

TEST_P(MomentsTwins, EvsmBound) {
    prove({"evsm_bound", shader, 6, 2500, textures}, [](Draw& draw, Words& given, Words& expected) {
        EvsmExponents<float> const warp = exponents(draw);
        Vec4<float> const moments = mean(draw, [&](float at) { return evsm_moments(at, warp); });
        Vec2<float> const receiver = evsm_warp(depth(draw), warp);
        float const deviation = draw.number(0.01f);
        given(moments)(receiver)(warp.growing)(warp.falling)(deviation);
        expected(evsm_bound(moments, receiver, warp, deviation));
    });
}

// Two mathematical libraries' exponentials may fall to different sides of a step. Asked is where nothing is near: a
// receiver moved by more than the warps differ (63 ulp are 4e-6 of depth at the least exponent) has the same answer.
TEST_P(MomentsTwins, EvsmVisibility) {
    prove({"evsm_visibility", shader, 11, 2, textures}, [](Draw& draw, Words& given, Words& expected) {
        EvsmExponents<float> warp{draw.uniform(1.0f, 42.0f), 5.0f};
        warp.falling = draw.uniform(1.0f, 42.0f);
        Vec4<float> moments = mean(draw, [&](float at) { return evsm_moments(at, warp); });
        float deviation = draw.number(0.01f), at = depth(draw);
        float const middle = evsm_visibility(moments, at, warp, deviation);
        auto const is_like_the_middle = [&](float where) {
            return std::abs(evsm_visibility(moments, where, warp, deviation) - middle) < 0.05f;
        };
        bool const inside = at > 1e-3f && at < 0.999f && (middle < 0.4f || middle > 0.6f);
        if (!inside || !is_like_the_middle(at - 1e-4f) || !is_like_the_middle(at + 1e-4f)) {
            warp = {};
            deviation = 1e-4f;
            at = 0.5f;
            moments = evsm_moments(draw.one_in(2) ? 0.2f : 0.8f, warp);
        }
        given(moments)(at)(warp.growing)(warp.falling)(deviation);
        expected(evsm_visibility(moments, at, warp, deviation) < 0.5f);
    });
}

TEST_P(MomentsTwins, MsmMoments) {
    prove({"msm_moments", shader, 7, 2500, textures}, [](Draw& draw, Words& given, Words& expected) {
        float const at = depth(draw);
        given(at);
        expected(msm_moments(at));
    });
}

TEST_P(MomentsTwins, MsmPackedAndUnpacked) {
    auto const four = [](Draw& draw) {
        float const x = draw.number(1.0f), y = draw.number(1.0f), z = draw.number(1.0f);
        return Vec4<float>(x, y, z, draw.number(1.0f));
    };
    prove({"msm_packed", shader, 8, 2500, textures}, [&](Draw& draw, Words& given, Words& expected) {
        Vec4<float> const moments = four(draw);
        given(moments);
        expected(msm_packed(moments));
    });
    prove({"msm_unpacked", shader, 9, 2500, textures}, [&](Draw& draw, Words& given, Words& expected) {
        Vec4<float> const stored = four(draw);
        given(stored);
        expected(msm_unpacked(stored));
    });
}

TEST_P(MomentsTwins, WhatIsKeptOfANumber) {
    prove({"unit_depth, kept_...", shader, 12, 2500, textures}, [](Draw& draw, Words& given, Words& expected) {
        float const number = draw.one_in(2) ? draw.number(2.0f) : draw.number(50.0f);
        given(number);
        expected(detail::unit_depth(number))(detail::share_or_light(number))(detail::kept_deviation(number))(
            detail::kept_exponent(number));
    });
}

TEST_P(MomentsTwins, MostLight) {
    prove({"most_light", shader, 13, 2500, textures}, [](Draw& draw, Words& given, Words& expected) {
        float const mean = draw.number(1.0f), square = draw.number(1.0f), value = draw.number(1.0f);
        float const deviation = draw.spoilt(draw.log_uniform(1e-6f, 1.0f));
        given(mean)(square)(value)(deviation);
        expected(detail::most_light(mean, square, value, deviation));
    });
}

TEST_P(MomentsTwins, SolveHankel) {
    prove({"solve_hankel", shader, 14, 2500, textures}, [](Draw& draw, Words& given, Words& expected) {
        Vec4<float> const moments = mean(draw, msm_moments<float>);
        float const x = draw.number(1.0f);
        given(moments)(x);
        expected(detail::solve_hankel(moments, x));
    });
}

TEST_P(MomentsTwins, MassBefore) {
    prove({"mass_before", shader, 15, 2500, textures}, [](Draw& draw, Words& given, Words& expected) {
        Vec4<float> const moments = mean(draw, msm_moments<float>);
        float const x = draw.number(1.0f), low = draw.number(1.0f), high = draw.number(1.0f);
        given(moments)(x)(low)(high);
        expected(detail::mass_before(moments, x, low, high));
    });
}

TEST_P(MomentsTwins, MsmVisibility) {
    prove({"msm_visibility", shader, 10, 2500, textures}, [](Draw& draw, Words& given, Words& expected) {
        Vec4<float> const moments = mean(draw, msm_moments<float>);
        float const at = depth(draw), bias = draw.spoilt(draw.log_uniform(1e-7f, 1e-3f));
        given(moments)(at)(bias);
        expected(msm_visibility(moments, at, bias));
    });
}

}  // namespace
