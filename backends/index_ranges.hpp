// SPDX-License-Identifier: MIT
//
// What a pass draws of the index array: neighbours in it become one range, so that most passes need few draw calls.
#pragma once

#include "backends/scene.hpp"

#include <cstdint>
#include <vector>

namespace shadowmath::backend {

struct IndexRange {
    std::uint32_t first = 0;
    std::uint32_t count = 0;
};
using IndexRanges = std::vector<IndexRange>;

inline void append(IndexRanges& ranges, Object const& object) {
    if (object.index_count == 0u) return;
    if (!ranges.empty() && ranges.back().first + ranges.back().count == object.first_index)
        ranges.back().count += object.index_count;
    else
        ranges.push_back({object.first_index, object.index_count});
}

}  // namespace shadowmath::backend
