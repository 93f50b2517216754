// SPDX-License-Identifier: MIT
//
// The diagnosis as a picture: what the camera sees, tinted by the map that serves it, and below it the maps, each with
// what falls on it.
#pragma once

#include "examples/doctor/diagnosis.hpp"
#include "examples/support/png.hpp"

namespace shadowmath::doctor {

[[nodiscard]] backend::Image<backend::Rgba8> picture(Case const& read, Sight const& sight, Diagnosis const& diagnosis);

// What its colours mean, in words.
[[nodiscard]] char const* legend();

}  // namespace shadowmath::doctor
