// SPDX-License-Identifier: MIT
//
// The functions that the fit to samples is made of, one by one. The passes as a whole: sdsm_test.cpp.
#include "tests/twins/twin.hpp"

#include <shadowmath/gpu_samples.hpp>

#include <cstring>

namespace {

using namespace shadowmath;
using namespace shadowmath::twins;

class SamplesTwins : public Twins {};
INSTANTIATE_TEST_SUITE_P(Drivers, SamplesTwins, twin_drivers, driver_name);

constexpr auto& shader = shaders::samples_comp;

// What a fit is given, as the C++ and as the shader take it.
struct Fit {
    SampleRays<float> rays;
    Light<float> light;
    Aabb<float> casters;
    SampleFitOptions<float> options;
    GpuSampleFit gpu;
};

// Of inputs without faults, for with them no split is asked for.
Fit fit(Draw& draw) {
    Fit drawn;
    Vec3<float> const eye = draw.within(draw.log_uniform(1.0f, 1000.0f)), forward = draw.unit();
    float const z_near = draw.log_uniform(0.01f, 1.0f), z_far = z_near * draw.log_uniform(10.0f, 1e4f);
    ViewVolume<float> camera = perspective_view(pose_looking(eye, forward, draw.unit()), draw.uniform(0.3f, 2.0f),
                                                draw.uniform(0.5f, 2.0f), z_near, z_far);
    if (draw.one_in(4)) camera.kind = ViewKind::orthographic;
    drawn.light = directional(draw.unit());
    Vec3<float> const centre = eye + forward * draw.uniform(0.0f, z_far);
    Vec3<float> const half = glm::abs(draw.within(z_far)) + 0.01f;
    drawn.casters = {centre - half, centre + half};
    drawn.options.map_size = draw.whole(32, 4096);
    drawn.options.margin_texels = static_cast<float>(draw.whole(0, 3));
    drawn.options.still = draw.one_in(2);
    drawn.options.pancake = draw.one_in(3);
    drawn.options.clip = draw.clip_space();
    int const width = draw.whole(1, 4000), height = draw.whole(1, 4000);
    drawn.rays = sample_rays(camera, drawn.light, width, height);
    drawn.gpu =
        gpu_sample_fit(camera, draw.clip_space(), 0.0f, drawn.light, width, height, drawn.casters, {}, drawn.options);
    EXPECT_GT(drawn.gpu.count, 0);
    return drawn;
}

void give(Words& given, GpuSampleFit const& gpu) {
    std::uint32_t words[sizeof gpu / 4];
    std::memcpy(words, &gpu, sizeof gpu);
    for (std::uint32_t const word : words) given(word);
}

// Of samples in light space, relative to the eye: one in eight is flat, one in sixteen empty.
Aabb<float> box(Draw& draw) {
    Vec3<float> const at = draw.within(draw.log_uniform(0.1f, 1000.0f)),
                      size = draw.within(draw.log_uniform(0.1f, 500.0f));
    Aabb<float> drawn{at, at + glm::abs(size)};
    if (draw.one_in(8)) drawn.hi[draw.whole(0, 2)] = drawn.lo[draw.whole(0, 2)];
    if (draw.one_in(16)) drawn = {};
    return drawn;
}

Cascade<float> fitted(Fit const& of, Aabb<float> const& samples) {
    SampleBounds<float> bounds;
    bounds.count = 1;
    bounds.box[0] = samples;
    return fit_samples(of.rays, bounds, of.casters, of.options).at[0];
}

TEST_P(SamplesTwins, Quotient) {
    prove({"quotient", shader, 0}, [](Draw& draw, Words& given, Words& expected) {
        float const a = draw.spoilt(draw.uniform(-1.0f, 1.0f) * draw.log_uniform(1e-20f, 1e20f));
        float const b = draw.spoilt(draw.uniform(-1.0f, 1.0f) * draw.log_uniform(1e-20f, 1e20f));
        given(a)(b);
        expected(a / b);
    });
}

// Numbers; a shader orders nothing else.
TEST_P(SamplesTwins, OrderedBits) {
    prove({"ordered_bits", shader, 1}, [](Draw& draw, Words& given, Words& expected) {
        float value = draw.number(1e3f);
        if (std::isnan(value)) value = 0.0f;
        auto const bits = std::bit_cast<std::uint32_t>(value);
        given(value);
        expected((bits & 0x80000000u) != 0u ? ~bits : bits | 0x80000000u)(value);
    });
}

TEST_P(SamplesTwins, DecodedDepth) {
    prove({"decoded_depth", shader, 2}, [](Draw& draw, Words& given, Words& expected) {
        ViewVolume<float> view;
        view.z_near = draw.log_uniform(1e-3f, 10.0f);
        view.z_far =
            draw.one_in(4) ? std::numeric_limits<float>::infinity() : view.z_near * draw.log_uniform(2.0f, 1e6f);
        if (draw.one_in(4)) view.kind = ViewKind::orthographic;
        DepthCode<float> const code = depth_code(view, draw.clip_space());
        float const stored = draw.one_in(8) ? code.sky : draw.spoilt(draw.uniform(0.0f, 1.0f));
        given(code.num_scale)(code.num_offset)(code.den_scale)(code.den_offset)(code.sky)(stored);
        expected(decoded_depth(code, stored));
    });
}

TEST_P(SamplesTwins, KindOfDepth) {
    prove({"kind_of_depth", shader, 3, 3}, [](Draw& draw, Words& given, Words& expected) {
        float const z_near = draw.one_in(8) ? 0.0f : draw.log_uniform(0.1f, 10.0f),
                    z_far = draw.log_uniform(20.0f, 1e4f);
        // One in four lies exactly at an end, or at the other zero.
        float const at_end = draw.one_in(3) ? z_far : (draw.one_in(2) ? z_near : -z_near);
        float const depth = draw.one_in(4) ? at_end : draw.spoilt(draw.log_uniform(1e-2f, 1e5f));
        SampleDepths<float> depths = no_depths(z_near, z_far);
        add(depths, depth);
        given(depth)(z_near)(z_far);
        expected(depths.counted != 0 ? 0 : (depths.outside != 0 ? 1 : 2));
    });
}

// Of depths that count.
TEST_P(SamplesTwins, DepthBin) {
    prove({"depth_bin", shader, 4, 400}, [](Draw& draw, Words& given, Words& expected) {
        float const z_far = draw.log_uniform(1e-3f, 1e18f);
        float depth = z_far * (draw.one_in(2) ? draw.uniform(0.0f, 1.0f) : draw.log_uniform(1e-6f, 1.0f));
        if (draw.one_in(16)) depth = draw.one_in(2) ? 0.0f : -0.0f;
        given(z_far)(depth);
        expected(detail::depth_bin(z_far, depth));
    });
}

TEST_P(SamplesTwins, FromEye) {
    prove({"from_eye", shader, 5}, [](Draw& draw, Words& given, Words& expected) {
        Fit const of = fit(draw);
        int const x = draw.whole(0, 4000), y = draw.whole(0, 4000);
        float const depth = draw.spoilt(draw.log_uniform(0.01f, 1e4f));
        give(given, of.gpu);
        given(x)(y)(depth);
        expected(from_eye(of.rays, x, y, depth));
    });
}

TEST_P(SamplesTwins, IsServed) {
    prove({"is_served", shader, 6, 2}, [](Draw& draw, Words& given, Words& expected) {
        float const begin = draw.spoilt(draw.uniform(0.0f, 10.0f)), end = draw.spoilt(draw.uniform(5.0f, 20.0f));
        // One in three lies about where a depth stops to count.
        float const edge =
            (draw.one_in(2) ? begin : end) * (1.0f + static_cast<float>(draw.whole(-2050, 2050)) * 0x1p-23f);
        float const depth = draw.one_in(3) ? edge : draw.spoilt(draw.uniform(0.0f, 25.0f));
        given(begin)(0.0f)(end)(0.0f)(depth);
        expected(is_served(SliceRange<float>{begin, 0.0f, end}, depth));
    });
}

// Of numbers, and of normal ones: smaller than a micrometre is never asked.
TEST_P(SamplesTwins, LargestOfWidenedAndEighthOfOctaveUp) {
    prove({"largest_of, widened, ...", shader, 7}, [](Draw& draw, Words& given, Words& expected) {
        auto const number = [&draw] {
            float const drawn = draw.uniform(-1.0f, 1.0f) * draw.log_uniform(1e-6f, 1e18f);
            return std::abs(drawn) < 1e-7f ? 1e-7f : drawn;
        };
        float const x = number(), y = number(), least = draw.log_uniform(1e-6f, 10.0f);
        float lo = x, hi = y;
        detail::widen(lo, hi, least);
        given(x)(y)(least);
        expected(detail::largest_of(Vec3<float>(x, y, least)))(lo)(hi)(eighth_of_octave_up(std::abs(x)));
    });
}

void give(Words& expected, detail::MapSide<float> const& side) {
    expected(side.lo)(side.hi)(side.scale)(side.offset)(side.texel_metres);
}

TEST_P(SamplesTwins, TightSide) {
    prove({"tight_side", shader, 8}, [](Draw& draw, Words& given, Words& expected) {
        float const lo = draw.number(1e4f), hi = draw.spoilt(lo + draw.log_uniform(1e-3f, 1e4f));
        int const size = draw.whole(1, 8192);
        given(lo)(hi)(static_cast<float>(size));
        give(expected, detail::tight_side(lo, hi, size));
    });
}

TEST_P(SamplesTwins, StillSide) {
    prove({"still_side", shader, 9}, [](Draw& draw, Words& given, Words& expected) {
        float const lo = draw.uniform(-1e4f, 1e4f), hi = lo + draw.log_uniform(1e-1f, 1e4f);
        int const size = draw.whole(16, 8192);
        float const margin = static_cast<float>(draw.whole(0, 3));
        float const spare =
            1.0f / (usable_texels(size, margin) - 1.0f) * (1.0f + 4.0f * std::numeric_limits<float>::epsilon());
        Faults faults;
        given(lo)(hi)(static_cast<float>(size))(spare);
        give(expected, detail::still_side(lo, hi, size, margin, faults));
    });
}

TEST_P(SamplesTwins, LightEntry) {
    prove({"light_entry", shader, 10}, [](Draw& draw, Words& given, Words& expected) {
        Fit const of = fit(draw);
        Vec2<float> const lo(draw.within(1000.0f)), hi = lo + glm::abs(Vec2<float>(draw.within(100.0f)));
        give(given, of.gpu);
        given(lo)(hi);
        expected(light_entry(of.rays.basis, lo, hi, of.casters));
    });
}

// NaN, infinities and the largest numbers among the boxes. What the map's row of texels is in metres the C++ tells as
// the longer of both.
TEST_P(SamplesTwins, FitSamples) {
    prove({"fit_samples", shader, 11}, [](Draw& draw, Words& given, Words& expected) {
        Fit const of = fit(draw);
        Aabb<float> samples = box(draw);
        samples = {draw.spoilt(samples.lo), draw.spoilt(samples.hi)};
        Cascade<float> const cascade = fitted(of, samples);
        float const size = static_cast<float>(of.options.map_size);
        give(given, of.gpu);
        given(samples.lo)(samples.hi);
        bool const visible = cascade.map.visible;
        expected(visible ? cascade.map.clip_from_world : nowhere<float>());
        // One over the length of a row: some ulp from the side's own.
        Mat4<float> const& m = cascade.map.clip_from_world;
        for (int axis = 0; axis < 2; ++axis) {
            double const row = glm::length(Vec3<double>(m[0][axis], m[1][axis], m[2][axis]));
            expected(visible ? static_cast<float>(2.0 / (row * static_cast<double>(size))) : 0.0f, 16);
        }
        expected(visible ? cascade.depth_metres : 0.0f)(visible);
    });
}

// Of maps with depth from 0 to 1. The C++ takes lengths of rows and quotients of them where the shader has texels: 4
// ulp for a length, 2 for a quotient of it, and as many again for the products and sums that follow (7 seen).
TEST_P(SamplesTwins, BiasOf) {
    prove({"bias_of", shader, 12}, [](Draw& draw, Words& given, Words& expected) {
        Fit of;
        Aabb<float> samples;
        Cascade<float> cascade;
        while (!cascade.map.visible) {
            of = fit(draw);
            of.options.clip = gl_zero_to_one_clip;
            of.gpu.clip_from_canonical = clip_from_canonical<float>(gl_zero_to_one_clip);
            samples = box(draw);
            cascade = fitted(of, samples);
        }
        auto const bias = bias_for(cascade.map, of.light, of.options.map_size, BiasOptions<float>{});
        give(given, of.gpu);
        given(samples.lo)(samples.hi);
        expected(bias.constant, 12)(bias.slope_texels, 12)(bias.slope_limit, 12);
    });
}

TEST_P(SamplesTwins, NoMap) {
    prove({"no_map", shader, 13, 1}, [](Draw&, Words& given, Words& expected) {
        given(0);
        expected(nowhere<float>())(0.0f)(0.0f)(0.0f)(false);
    });
}

}  // namespace
