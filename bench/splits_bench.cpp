// SPDX-License-Identifier: MIT
//
// Four practical splits. Textbook: one power a split.
#include "bench/cases.hpp"
#include "bench/timed.hpp"

#include <shadowmath/splits.hpp>

using namespace shadowmath;

static int const registered = [] {
    bench::Random random;
    auto const ranges = bench::inputs([&] { return glm::vec2(random.between(0.05f, 1), random.between(50, 2000)); });
    bench::time("splits/ours", ranges, [](glm::vec2 const& r) { return practical_splits(r.x, r.y, 4, 0.7f); });
    bench::time("splits/textbook", ranges, [](glm::vec2 const& r) { return textbook::splits(r.x, r.y, 0.7f); });
    return 0;
}();
