// SPDX-License-Identifier: MIT
//
// A convention is named, and no bool or number stands for it.
// refused: (no viable (overloaded|conversion)|no match for .operator=.)
#include <shadowmath/cascades.hpp>

namespace sm = shadowmath;

sm::CascadeOptions<float> options() {
    sm::CascadeOptions<float> made;
#ifdef WRONG
    made.clip = true;
#else
    made.clip = sm::vulkan_clip;
#endif
    return made;
}
