// SPDX-License-Identifier: MIT
//
// Laws of the set of faults: a set, and one sentence for each member.
#pragma once

#include <shadowmath/fault.hpp>

#include <cstdint>
#include <cstring>

namespace shadowmath::laws {

// Union neither loses nor invents, in whatever order and however often.
[[nodiscard]] constexpr bool is_a_union(Faults a, Faults b) {
    Faults const both = a | b;
    return both.bits == (a.bits | b.bits) && both == (b | a) && (both | a) == both &&
           both.any() == (a.any() || b.any());
}

// The sentence is that of the lowest fault in the set.
[[nodiscard]] inline bool describes_the_lowest(Faults faults) {
    char const* const sentence = describe(faults);
    for (std::uint32_t bit = 1; bit != 0; bit <<= 1)
        if ((faults.bits & bit) != 0) return std::strcmp(sentence, describe(static_cast<Fault>(bit))) == 0;
    return std::strcmp(sentence, "no fault") == 0;
}

}  // namespace shadowmath::laws
