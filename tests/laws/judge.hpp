// SPDX-License-Identifier: MIT
//
// What a judgement of cascades adds up to.
#pragma once

#include <shadowmath/judge.hpp>

#include <algorithm>

namespace shadowmath::laws {

// Worst of all is the worst of some map, counts add up, no mean exceeds its worst and no price the worst one's; nothing
// is NaN or negative.
template <class T>
[[nodiscard]] bool adds_up(Judgement<T> const& judgement) {
    Worth<T> sum;
    auto const sound = [](Worth<T> const& w) {
        return w.mean >= T(0) && w.price >= T(0) && w.price <= price_of(w.worst) * T(1.0001) &&
               w.worst >= w.mean * T(0.9999) && w.worst <= footprint_limit<T> &&
               (w.count > 0 || (w.worst == T(0) && w.unserved == 0)) && w.unserved <= w.count;
    };
    for (Worth<T> const& w : judgement.map) {
        if (!sound(w)) return false;
        sum.worst = std::max(sum.worst, w.worst);
        sum.count += w.count;
        sum.unserved += w.unserved;
    }
    return sound(judgement.all) && sum.worst == judgement.all.worst && sum.count == judgement.all.count &&
           sum.unserved == judgement.all.unserved;
}

}  // namespace shadowmath::laws
