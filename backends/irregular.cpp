// SPDX-License-Identifier: MIT
#include "backends/irregular.hpp"

#include "backends/shaders/embedded.hpp"

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace shadowmath::backend {
namespace {

constexpr std::size_t group_size = 64, groups_across = 65535, large_groups = 1024;
constexpr std::size_t counter_words = 5;        // Grid's members before its words
constexpr std::size_t triangle_count_at = 312;  // bytes; the block's tail: triangle_count, vertex_count, node_capacity
constexpr std::size_t block_bytes = 336;

// Texels of all levels, each a quarter as wide as the one before it, and their blocks of 4 x 4.
std::size_t words_of(int map_size) {
    std::size_t words = 0;
    for (int level = 0; level < 8; ++level) {
        auto const side = (std::size_t(map_size) + (std::size_t(1) << 2 * level) - 1) >> 2 * level;
        auto const blocks = (side + 3) / 4;
        words += side * side + blocks * blocks;
        if (side == 1) break;
    }
    return words;
}

}  // namespace

IrregularPasses::IrregularPasses(ComputeRunner& runner, IrregularSize const& size) : runner_(runner), size_(size) {
    if (size.width < 1 || size.height < 1 || size.map_size < 1 || size.map_size > 1 << 14)
        throw std::runtime_error("an irregular z-buffer needs a picture, and a grid of 1 to 16384 texels a side");
    pixel_count_ = std::size_t(size.width) * std::size_t(size.height);
    if (size_.node_capacity == 0) size_.node_capacity = std::uint32_t(4 * pixel_count_);
    word_count_ = words_of(size.map_size);
    receivers_ = runner.make_storage(24 * pixel_count_);
    quads_ = runner.make_storage(16 * pixel_count_);
    masks_ = runner.make_storage(4 * pixel_count_);
    grid_ = runner.make_storage(4 * (counter_words + word_count_));
    nodes_ = runner.make_storage(8 * std::size_t(size_.node_capacity));
}

void IrregularPasses::set_casters(std::span<float const> vertices, std::span<std::uint32_t const> indices) {
    vertex_count_ = std::uint32_t(vertices.size() / 3);
    triangle_count_ = std::uint32_t(indices.size() / 3);
    vertices_ = runner_.make_storage(std::max(vertices.size_bytes(), std::size_t(4)));
    triangles_ = runner_.make_storage(std::max(16 * std::size_t(triangle_count_), std::size_t(4)));
    if (!vertices.empty()) runner_.write(vertices_, std::as_bytes(vertices));
    if (triangle_count_ > 0) runner_.write(triangles_, std::as_bytes(indices.first(3 * std::size_t(triangle_count_))));
}

void IrregularPasses::set_receivers(std::span<float const> receivers) {
    if (receivers.size() != 6 * pixel_count_) throw std::runtime_error("receivers are six floats for each pixel");
    runner_.write(receivers_, std::as_bytes(receivers));
}

Dispatch IrregularPasses::pass(shaders::Shader const& shader, std::size_t invocations) const {
    std::size_t const groups = std::max<std::size_t>(1, (invocations + group_size - 1) / group_size);
    glm::uvec3 const shape(std::min(groups, groups_across), (groups + groups_across - 1) / groups_across, 1);
    return {&shader, shape, {receivers_, quads_, masks_, grid_, nodes_, vertices_, triangles_}, {}, constants_};
}

IrregularWork IrregularPasses::trace(std::span<std::byte const> constants) {
    if (constants.size() != block_bytes)
        throw std::runtime_error("the constants of an irregular z-buffer are 336 bytes");
    if (vertex_count_ == 0 && triangle_count_ == 0) set_casters({}, {});
    constants_.assign(constants.begin(), constants.end());
    std::array<std::uint32_t, 3> const counts{triangle_count_, vertex_count_, size_.node_capacity};
    std::memcpy(constants_.data() + triangle_count_at, counts.data(), sizeof counts);

    std::array const list{pass(shaders::irregular_clear_comp, word_count_),
                          pass(shaders::irregular_list_comp, pixel_count_)};
    std::array const cast{pass(shaders::irregular_trace_comp, triangle_count_),
                          pass(shaders::irregular_trace_large_comp, large_groups * group_size)};
    last_ = {};
    last_.ms_list = runner_.run(list);
    last_.ms_trace = runner_.run(cast);
    auto const counted = read_back<std::uint32_t>(runner_, grid_, counter_words);
    last_.nodes = counted[0];
    last_.large_triangles = counted[2];
    last_.storage_too_small = last_.nodes > size_.node_capacity;
    return last_;
}

std::vector<std::uint32_t> IrregularPasses::masks() {
    if (last_.storage_too_small) return std::vector<std::uint32_t>(pixel_count_);
    return read_back<std::uint32_t>(runner_, masks_, pixel_count_);
}

}  // namespace shadowmath::backend
