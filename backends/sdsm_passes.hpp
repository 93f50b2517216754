// SPDX-License-Identifier: MIT
//
// The compute passes that fit maps to what the eye sees, as plain data for FitPass or a compute runner: their uniform
// block (binding 0) is shadowmath's GpuSampleFit, byte for byte, their buffers a GpuSampleState (1) and the
// MapConstants that they make (2), their texture the eye's depth (3).
#pragma once

#include "backends/backend.hpp"

#include <cstddef>
#include <vector>

namespace shadowmath::backend {

// `extent` of the eye's depth. In this order, each seeing what those before it wrote; all with the same bindings.
[[nodiscard]] std::vector<ComputeStep> sdsm_steps(Extent extent);

inline constexpr std::size_t sdsm_state_bytes = 4880;

}  // namespace shadowmath::backend
