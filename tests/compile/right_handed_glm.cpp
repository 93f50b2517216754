// SPDX-License-Identifier: MIT
#include "tests/compile/fingerprint.hpp"

std::array<std::uint64_t, 6> fingerprint_with_right_handed_glm() {
    return fingerprint();
}
