// SPDX-License-Identifier: MIT
//
// What the theory says, drawn; and the techniques in order of what they got wrong.
#pragma once

#include "examples/gallery/run.hpp"

#include <string>

namespace shadowmath::gallery {

// Where each split scheme cuts 1 m to 1 km four times, on a logarithmic axis of depth.
[[nodiscard]] std::string splits_chart();

// Perspective aliasing along the depth of a view, light overhead: closed forms as lines, the library's footprints of
// actual matrices as dots upon them.
[[nodiscard]] std::string aliasing_chart();

// Mis-shadowed pixels off edges, a bar a technique (the mean over all views of the first backend), a dot a scene.
[[nodiscard]] std::string technique_chart(std::span<Technique const> techniques, Results const& results);

}  // namespace shadowmath::gallery
