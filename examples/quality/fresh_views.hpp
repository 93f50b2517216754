// SPDX-License-Identifier: MIT
//
// Views that nobody has chosen, to see whether the figures of those that somebody has hold elsewhere. The rule:
//
//   scenes     the built-in ones, grown from another seed; a model's stage
//   eye        1.7 m above the ground (half of the views), 6, 20 or 45 m, anywhere within 60 m of the middle under an
//              open sky; around a model anywhere at 1.3 to 3 times its size
//   direction  any; from level to steeply down, the more the higher the eye; toward a model's middle
//   sun        3 to 88 degrees high, from any side
//   shadows    up to 60 m and as far as 800 m (150 m in the smaller scenes), evenly over the orders
//
// Drawn again where the eye is closer than 0.7 m to something, or where fewer than a third of the directions in view
// meet a surface within the shadow distance. Nothing else is asked, least of all what any policy makes of it.
#pragma once

#include "oracle/ray_oracle.hpp"
#include "scenes/scenes.hpp"

#include <cstdint>
#include <vector>

namespace shadowmath::quality {

[[nodiscard]] std::vector<scenes::View> fresh_views(scenes::NamedScene const& named, oracle::RayOracle const& oracle,
                                                    std::uint64_t seed);

}  // namespace shadowmath::quality
