// SPDX-License-Identifier: MIT
#include "tests/twins/twin.hpp"

#include <shadowmath/slice.hpp>
#include <shadowmath/splits.hpp>

namespace {

using namespace shadowmath;
using namespace shadowmath::twins;

class SplitsTwins : public Twins {
protected:
    void prove_splits(char const* name, bool uniform_only, std::uint32_t ulps) {
        prove({name, shaders::splits_comp, 0}, [=](Draw& draw, Words& given, Words& expected) {
            float z_near = draw.spoilt(draw.log_uniform(1e-3f, 100.0f));
            float z_far = draw.spoilt(z_near * draw.log_uniform(1.01f, 1e7f));
            // Planes that fall together: which of them stay is the rounding's choice, on either side.
            if (z_far > z_near && z_far - z_near < z_far * 1e-4f) z_far = z_near;
            int const count = draw.one_in(16) ? draw.whole(-2, 20) : draw.whole(1, 16);
            float const lambda = uniform_only ? 0.0f : draw.spoilt(draw.uniform(-0.1f, 1.1f));
            auto const splits = practical_splits(z_near, z_far, count, lambda);
            given(z_near)(z_far)(count)(lambda);
            for (float const plane : splits.plane) expected(plane, ulps);
            expected(splits.count)(splits.faults.bits);
        });
    }
};
INSTANTIATE_TEST_SUITE_P(Drivers, SplitsTwins, twin_drivers, driver_name);

// With u half an epsilon: std::pow takes i / count rounded, which costs u * ln(ratio), 45 u where the ratio is 2^64;
// the shader's root is good to 2 u and each of up to 15 products adds that and one more.
TEST_P(SplitsTwins, PracticalSplits) {
    prove_splits("practical_splits", false, 96);
}

TEST_P(SplitsTwins, UniformSplitsAreEqual) {
    prove_splits("uniform splits", true, 0);
}

TEST_P(SplitsTwins, SliceRange) {
    prove({"slice_range", shaders::splits_comp, 1}, [](Draw& draw, Words& given, Words& expected) {
        float const z_near = draw.log_uniform(1e-3f, 100.0f), z_far = z_near * draw.log_uniform(1.01f, 1e7f);
        Splits<float> splits = practical_splits(z_near, z_far, draw.whole(1, 16));
        for (int i = 0; i <= splits.count; ++i) splits.plane[i] = draw.spoilt(splits.plane[i]);
        int const index = draw.whole(0, splits.count - 1);
        float const blend = draw.spoilt(draw.uniform(-0.1f, 1.1f));
        auto const range = slice_range(splits, index, blend);
        for (float const plane : splits.plane) given(plane);
        given(splits.count)(index)(blend);
        expected(range.begin)(range.blend_begin)(range.end);
    });
}

TEST_P(SplitsTwins, FadeBegin) {
    prove({"fade_begin", shaders::splits_comp, 2}, [](Draw& draw, Words& given, Words& expected) {
        float const begin = draw.number(100.0f), end = draw.number(200.0f), share = draw.number(1.0f);
        given(begin)(end)(share);
        expected(detail::fade_begin(begin, end, share));
    });
}

// One step of Newton's method from a power that is off by thousands of ulp leaves their square: nothing; the step
// itself rounds twice.
TEST_P(SplitsTwins, Root) {
    prove({"root", shaders::splits_comp, 3, 2000}, [](Draw& draw, Words& given, Words& expected) {
        float const ratio = draw.log_uniform(1.0f, 18446744073709551616.0f);
        int const count = draw.whole(1, 16);
        given(ratio)(count);
        expected(static_cast<float>(std::pow(static_cast<double>(ratio), 1.0 / count)), 2);
    });
}

}  // namespace
