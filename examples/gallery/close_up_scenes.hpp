// SPDX-License-Identifier: MIT
//
// What the gallery looks at from close by: where thin things, contacts and penumbrae fill the picture.
#pragma once

#include "backends/scene.hpp"
#include "examples/gallery/settings.hpp"
#include "scenes/view.hpp"

#include <string>
#include <vector>

namespace shadowmath::gallery {

struct CloseUpScene {
    std::string name;   // a file-name-safe word
    std::string title;  // a few words for people
    backend::Scene scene;
    scenes::View view;  // by a sun
    int light_rays;     // a pixel, to the area light
};

// A railing, leaves, a car, each where its scene is among those asked for, and always a post; quick runs: the post.
[[nodiscard]] std::vector<CloseUpScene> close_up_scenes(Settings const& settings);

}  // namespace shadowmath::gallery
