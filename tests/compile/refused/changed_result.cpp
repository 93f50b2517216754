// SPDX-License-Identifier: MIT
//
// Walking through cascades reads them.
// refused: (assignment of member .*in read-only|cannot assign to)
#include <shadowmath/cascades.hpp>

namespace sm = shadowmath;

int visible(sm::Cascades<float> const& cascades) {
    int count = 0;
    for (auto& cascade : cascades) {
#ifdef WRONG
        cascade.map.visible = true;
#endif
        count += cascade.map.visible;
    }
    return count;
}
