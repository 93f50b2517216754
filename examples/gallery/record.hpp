// SPDX-License-Identifier: MIT
//
// What the gallery says in numbers: one record for each scene, view, technique and backend.
#pragma once

#include <string>
#include <vector>

namespace shadowmath::gallery {

struct Record {
    std::string scene, view, technique, backend;
    int map_size = 0;  // texels along a side
    int maps = 0;

    // Pixels whose surface faces the light, within the shadow distance; the fractions are of these.
    long lit_facing_pixels = 0;
    long off_edge_pixels = 0;                     // of those, how many are clear of every true shadow edge
    long beyond_pixels = 0;                       // facing the light, too far away to be judged
    long unmapped_pixels = 0;                     // to be judged, but in no map: drawn lit
    double mis_shadowed_fraction = 0.0;           // of lit_facing_pixels
    double mis_shadowed_fraction_off_edge = 0.0;  // of off_edge_pixels

    // Eye pixels that one texel covers along its longer axis, over the judged pixels that a map serves.
    double footprint_max = 0.0, footprint_p95 = 0.0, footprint_mean = 0.0;
    double map_used_fraction = 0.0;  // texels of all maps that the lookup of some visible pixel touches

    double ms_depth = 0.0, ms_receive = 0.0;
    double unlike_first_backend_fraction = 0.0;  // pixels whose colour differs from the first backend's
    std::vector<double> splits;                  // eye depths, metres
    std::string note;                            // the library's faults in words, and what the driver complained of
};

}  // namespace shadowmath::gallery
