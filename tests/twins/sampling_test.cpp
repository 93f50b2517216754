// SPDX-License-Identifier: MIT
#include "tests/twins/twin.hpp"

#include <shadowmath/sampling.hpp>

#include <array>

namespace {

using namespace shadowmath;
using namespace shadowmath::twins;

class SamplingTwins : public Twins {};
INSTANTIATE_TEST_SUITE_P(Drivers, SamplingTwins, twin_drivers, driver_name);

constexpr auto& shader = shaders::sampling_comp;

TEST_P(SamplingTwins, Contains) {
    prove({"contains", shader, 0, 2}, [](Draw& draw, Words& given, Words& expected) {
        auto const [map, light, point] = draw.seen();
        int const size = draw.one_in(32) ? draw.whole(-1, 1) : 1 << draw.whole(1, 13);
        float const margin = draw.spoilt(draw.uniform(-1.0f, 4.0f));
        given(map)(size)(margin)(point);
        expected(contains(map, size, margin, point));
    });
}

TEST_P(SamplingTwins, ByDepth) {
    prove({"by_depth", shader, 1, 1000}, [](Draw& draw, Words& given, Words& expected) {
        std::array<SliceRange<float>, max_splits> ranges{};
        float end = 0.0f;
        for (SliceRange<float>& range : ranges) {
            range.begin = end;
            end += draw.uniform(0.0f, 10.0f);  // one of no length may be among them
            range.end = draw.spoilt(end);
            range.blend_begin = draw.spoilt(draw.uniform(range.begin, end));
        }
        int const count = draw.whole(-1, max_splits);
        // One in four lies exactly where something begins or ends.
        SliceRange<float> const& any = ranges[draw.below(max_splits)];
        float const at_end = draw.one_in(2) ? any.end : any.blend_begin;
        float const depth = draw.one_in(4) ? at_end : draw.spoilt(draw.uniform(0.0f, 8.0f * float(count + 1)));
        for (auto const& range : ranges) given(range.blend_begin);
        for (auto const& range : ranges) given(range.end);
        given(count)(depth);
        auto const look_up = by_depth(ranges.data(), count, depth);
        expected(look_up.first)(look_up.second)(look_up.blend);
    });
}

TEST_P(SamplingTwins, Blended) {
    prove({"blended", shader, 2}, [](Draw& draw, Words& given, Words& expected) {
        LookUp<float> const look_up{0, draw.whole(-1, 1), draw.spoilt(draw.uniform(0.0f, 1.0f))};
        float const first = draw.spoilt(draw.uniform(0.0f, 1.0f)), second = draw.spoilt(draw.uniform(0.0f, 1.0f));
        given(look_up.first)(look_up.second)(look_up.blend)(first)(second);
        expected(blended(look_up, first, second));
    });
}

TEST_P(SamplingTwins, Shade) {
    prove({"shade", shader, 3}, [](Draw& draw, Words& given, Words& expected) {
        Vec3<float> const ambient = draw.point(1.0f), diffuse = draw.point(1.0f), specular = draw.point(1.0f);
        float const share = draw.spoilt(draw.uniform(0.0f, 1.0f));
        Vec3<float> const albedo = draw.point(1.0f);
        given(ambient)(diffuse)(specular)(share)(albedo);
        expected(shade(ambient, diffuse, specular, share, albedo));
    });
}

}  // namespace
