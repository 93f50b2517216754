// SPDX-License-Identifier: MIT
//
// Where the study looks from and what it looks by: every kind of place under every kind of sun.
#pragma once

#include "scenes/scenes.hpp"

#include <vector>

namespace shadowmath::quality {

// The views of a scene of the project by its name, or of a model's stage for any other: places are the scene's own,
// suns from 88 degrees down to 3, in the viewer's back, in his face and at his side; shadow distances from 60 m to
// 800 m.
[[nodiscard]] std::vector<scenes::View> study_views(scenes::NamedScene const& named);

}  // namespace shadowmath::quality
