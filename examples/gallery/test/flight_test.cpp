// SPDX-License-Identifier: MIT
//
// Stable policies stand still, and the measurement sees those that do not.
#include "examples/gallery/flight.hpp"
#include "backends/gl/gl_backend.hpp"
#include "scenes/scenes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

namespace shadowmath::gallery {
namespace {

TEST(Flight, SetsNoStableMapCrawlingInTwentyFrames) {
    auto const backend = backend::make_gl_backend(backend::GlContextKind::egl);
    int stable = 0;
    for (std::string_view const name : scenes::scene_names()) {
        auto const named = scenes::make_scene(name, scenes::SceneSize::small);
        oracle::RayOracle const oracle(named.scene);
        backend->upload(named.scene);
        auto const records = fly(*backend, oracle, named.scene, named.views.front(), 20, 512);
        for (FlightRecord const& record : records) {
            std::printf("%-10s %-14s %d x %4d: %.1e of %ld decisions flip, %.1e of those within a map\n",
                        record.scene.c_str(), record.policy.c_str(), record.maps, record.map_size, shimmer(record),
                        record.decisions, shimmer_within(record));
            EXPECT_GT(record.decisions_within, 100000) << record.policy;
            EXPECT_GE(record.decisions, record.decisions_within) << record.policy;
            stable += record.stable;
            if (record.stable) {
                EXPECT_LE(shimmer(record), most_shimmer) << name << ": " << record.policy;
                EXPECT_LE(shimmer_within(record), most_shimmer) << name << ": " << record.policy;
            }
        }
        auto const tight = std::ranges::find(records, "tight", &FlightRecord::policy);
        ASSERT_NE(tight, records.end());
        EXPECT_GT(shimmer(*tight), 1e-3) << "a fit that crawls must be seen to crawl";
        for (std::string const& message : backend->take_messages()) ADD_FAILURE() << "driver: " << message;
    }
    EXPECT_EQ(stable, 6) << "the stable cascades, and those chosen to be still, of three scenes";
}

TEST(Flight, EndsWhereItBegan) {
    scenes::View view;
    view.eye = {1.0, 2.0, 3.0};
    for (int const frame : {0, whole_flight}) {
        scenes::View const there = flown(view, frame);
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_NEAR(there.eye[axis], view.eye[axis], 1e-9);
            EXPECT_NEAR(there.forward[axis], view.forward[axis], 1e-9);
        }
    }
    EXPECT_NE(flown(view, whole_flight / 2).eye, view.eye);
}

}  // namespace
}  // namespace shadowmath::gallery
