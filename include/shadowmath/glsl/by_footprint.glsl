// SPDX-License-Identifier: MIT
//
// Of several maps that hold a point, the one whose texels look smallest there: the GLSL twin of by_footprint.hpp, equal
// to it bit for bit where the driver divides as IEEE 754 does (Mesa's software drivers). by_footprint of the C++ is a
// loop in the shader itself, as maps stay in the uniform block that they are in:
//
//   sm_FinestMaps finest = sm_no_maps();
//   for (int i = 0; i < count; ++i)
//       if (sm_contains(maps[i], map_size, margin_texels, point))
//           finest = sm_with_map(finest, i, sm_footprint(eye, eye_pixels, maps[i].clip_from_world, float(map_size),
//                                                        point, normal).major);
//   sm_LookUp look_up = sm_look_up_in(finest, band);
#ifndef SM_BY_FOOTPRINT_GLSL
#define SM_BY_FOOTPRINT_GLSL

#include "footprint.glsl"
#include "sampling.glsl"

// The finest two maps of those met so far, and their footprints.
struct sm_FinestMaps {
    int first;  // -1: none
    int second;
    float first_major;  // eye pixels
    float second_major;
};

sm_FinestMaps sm_no_maps() {
    return sm_FinestMaps(-1, -1, 0.0, 0.0);
}

// With one more map, whose texels are `major` pixels long at the point. The earlier one stays first where two are
// equal.
sm_FinestMaps sm_with_map(sm_FinestMaps finest, int map, float major) {
    if (finest.first < 0 || major < finest.first_major)
        return sm_FinestMaps(map, finest.first, major, finest.first_major);
    if (finest.second < 0 || major < finest.second_major) {
        finest.second = map;
        finest.second_major = major;
    }
    return finest;
}

// The second takes part where its footprint is less than 1 + band times the first's; its share falls from a half to
// none over the band.
sm_LookUp sm_look_up_in(sm_FinestMaps finest, float band) {
    bool mixes = finest.second >= 0 && sm_all_finite(band) && band > 0.0 && finest.first_major > 0.0;
    if (!mixes) return sm_LookUp(finest.first, -1, 0.0);
    precise float excess = (finest.second_major / finest.first_major - 1.0) / band;
    precise float share = 0.5 * (1.0 - excess);
    return excess < 1.0 ? sm_LookUp(finest.first, finest.second, share) : sm_LookUp(finest.first, -1, 0.0);
}

#endif
