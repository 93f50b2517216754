// SPDX-License-Identifier: MIT
//
// The parts of a diagnosis, one question each.
#pragma once

#include "examples/doctor/diagnosis.hpp"
#include "examples/support/percentile.hpp"

namespace shadowmath::doctor {

struct Examination {
    Case const& read;
    Sight const& sight;
    std::vector<ShadowMap<double>> maps;   // of the first frame
    std::vector<std::vector<int>> points;  // of the sight, that the map serves or should serve
    std::vector<bool> sound;               // false: what is wrong explains whatever else looks wrong with the map
    Diagnosis found;

    [[nodiscard]] std::string const& name(std::size_t map) const { return read.frame.maps[map].name; }
    [[nodiscard]] Seen const& seen(int point) const { return sight.points[static_cast<std::size_t>(point)]; }
    void fault(Ill ill, std::size_t map, std::string what, std::string mend);
    void remark(Ill ill, std::size_t map, std::string what, std::string mend);
};

// Which light the matrices are maps of, and in which convention. First: it says which maps are sound.
void find_law(Examination& examination);
// Points that no map holds, ranges with gaps, casters beyond the near plane, kernels over the side.
void find_coverage(Examination& examination);
// Texels larger than they need be, and depth too coarse.
void find_waste(Examination& examination);
// Points that change their place within the texel from frame to frame.
void find_shimmer(Examination& examination);
// Bias too small or too large.
void find_bias(Examination& examination);
// Fills in the figures.
void measure(Examination& examination);

// Metres across the light that a texel is long at the point, along its longer side.
[[nodiscard]] double texel_at(ShadowMap<double> const& map, int size, glm::dvec3 point);

// w is the same everywhere.
[[nodiscard]] bool is_affine(ShadowMap<double> const& map);

// "12.3", "0.0456": three digits that mean something.
[[nodiscard]] std::string digits(double number);
[[nodiscard]] std::string percent(double share);

using example::percentile;

}  // namespace shadowmath::doctor
