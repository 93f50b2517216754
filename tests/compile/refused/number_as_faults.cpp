// SPDX-License-Identifier: MIT
//
// Faults are asked by name, and no number is one.
// refused: (cannot convert|no known conversion|cannot initialize|invalid conversion)
#include <shadowmath/fault.hpp>

namespace sm = shadowmath;

bool is_finite(sm::Faults faults) {
#ifdef WRONG
    return !faults.has(1);
#else
    return !faults.has(sm::Fault::not_finite);
#endif
}
