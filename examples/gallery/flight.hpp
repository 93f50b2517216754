// SPDX-License-Identifier: MIT
//
// A camera flies through a scene in which nothing else moves, and points on its surfaces are asked in every frame
// whether they are lit. An answer that is another than in the frame before is a shadow edge that crawled.
//
// A decision at a static point: the point and its surface's own normal are taken from what the eye sees in a few frames
// of the flight, and stay as they are. A frame asks those of them that face the light, lie within the view and the
// shadow distance, and are not hidden from the eye: the shader's own look-up in the maps of that frame, all taps of its
// filter, lit where at least half of the light comes through. A pair of frames that follow each other and both ask a
// point is one decision; it flips where the two answers differ.
//
// Flips are told apart by whether the same map answered in both frames. Within a map a flip is the map's own crawling.
// Where another map took over, coarser texels follow finer ones, whatever the fit: as much of a step as it is in space,
// at the border between two maps. A stable fit promises that neither happens to more than one decision in ten thousand.
#pragma once

#include "backends/backend.hpp"
#include "examples/gallery/techniques.hpp"
#include "oracle/ray_oracle.hpp"

#include <functional>
#include <string>
#include <vector>

namespace shadowmath::gallery {

struct FlightRecord {
    std::string scene, view, policy, title;
    bool stable = false;  // promises that nothing crawls
    int frames = 0;
    int map_size = 0;  // texels along a side
    int maps = 0;      // in the last frame
    long points = 0;
    long decisions = 0, flips = 0;
    long decisions_within = 0, flips_within = 0;  // by the same map in both frames
};

// The share of decisions that flip: all, and those by the same map in both frames.
[[nodiscard]] double shimmer(FlightRecord const& record);
[[nodiscard]] double shimmer_within(FlightRecord const& record);
inline constexpr double most_shimmer = 1e-4;  // of a stable policy

// The view after `frame` frames: 6 m forward and back, swaying, bobbing and looking around, in 300 of them.
[[nodiscard]] scenes::View flown(scenes::View const& view, int frame);
inline constexpr int whole_flight = 300;

// The first `frames` frames through every policy, with as many texels each. The scene of view and oracle must be on the
// backend; the light is a sun. `after_frame` may throw to stop.
[[nodiscard]] std::vector<FlightRecord> fly(backend::Backend& backend, oracle::RayOracle const& oracle,
                                            backend::Scene const& scene, scenes::View const& view, int frames,
                                            int map_size, std::function<void(int frame)> const& after_frame = {});

}  // namespace shadowmath::gallery
