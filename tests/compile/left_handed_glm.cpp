// SPDX-License-Identifier: MIT
#define GLM_FORCE_LEFT_HANDED
#define GLM_FORCE_DEPTH_ZERO_TO_ONE
#define GLM_FORCE_RADIANS
#include "tests/compile/fingerprint.hpp"

std::array<std::uint64_t, 6> fingerprint_with_left_handed_glm() {
    return fingerprint();
}
