// SPDX-License-Identifier: MIT
#include "tests/twins/twin.hpp"

#include <shadowmath/by_footprint.hpp>

namespace {

using namespace shadowmath;
using namespace shadowmath::twins;

class ByFootprintTwins : public Twins {};
INSTANTIATE_TEST_SUITE_P(Drivers, ByFootprintTwins, twin_drivers, driver_name);

TEST_P(ByFootprintTwins, FinestTwoAndTheirMixture) {
    prove({"by_footprint", shaders::by_footprint_comp, 0}, [](Draw& draw, Words& given, Words& expected) {
        int const count = draw.whole(0, 6);
        FinestMaps<float> finest;
        given(count);
        for (int i = 0; i < 6; ++i) {
            // Whole pixels, so that two are equal now and then.
            float const major = draw.one_in(4) ? float(draw.whole(0, 4)) : draw.log_uniform(1.0f, 10.0f);
            given(major);
            if (i < count) finest = with_map(finest, i, major);
        }
        float const band = draw.spoilt(draw.log_uniform(0.05f, 50.0f));
        given(band);
        LookUp<float> const look_up = look_up_in(finest, band);
        expected(look_up.first)(look_up.second)(look_up.blend);
    });
}

}  // namespace
