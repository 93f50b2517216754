// SPDX-License-Identifier: MIT
//
// The diagnosis in words.
#pragma once

#include "examples/doctor/advice.hpp"

#include <span>

namespace shadowmath::doctor {

[[nodiscard]] std::string report(Case const& read, Sight const& sight, Diagnosis const& diagnosis,
                                 std::span<Advice const> advice);

}  // namespace shadowmath::doctor
