// SPDX-License-Identifier: MIT
//
// What every pass draws: the vertices and indices of a scene on the device, and the numbers of instances beside them.
#pragma once

#include "backends/draw_plan.hpp"
#include "backends/vk/barrier.hpp"
#include "backends/vk/commands.hpp"
#include "backends/vk/objects.hpp"

#include <array>
#include <cstddef>
#include <cstring>
#include <span>

namespace shadowmath::backend::vk {

class Mesh {
public:
    explicit Mesh(Device const& device)
        : device_(&device),
          numbers_(make_host_buffer(device, sizeof(instance_numbers), VK_BUFFER_USAGE_VERTEX_BUFFER_BIT)) {
        std::memcpy(numbers_.mapped, instance_numbers.data(), sizeof(instance_numbers));
    }

    // The scene has indices.
    void upload(Commands const& commands, Scene const& scene) {
        VkDeviceSize const vertex_bytes = scene.vertices.size() * sizeof(Vertex);
        VkDeviceSize const index_bytes = scene.indices.size() * sizeof(std::uint32_t);
        Buffer const staging = make_host_buffer(*device_, vertex_bytes + index_bytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
        std::memcpy(staging.mapped, scene.vertices.data(), vertex_bytes);
        std::memcpy(static_cast<std::byte*>(staging.mapped) + vertex_bytes, scene.indices.data(), index_bytes);
        vertices_ = make_device_buffer(*device_, vertex_bytes,
                                       VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT);
        indices_ = make_device_buffer(*device_, index_bytes,
                                      VK_BUFFER_USAGE_INDEX_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT);
        commands.submit([&](VkCommandBuffer buffer) {
            VkBufferCopy const of_vertices{0, 0, vertex_bytes}, of_indices{vertex_bytes, 0, index_bytes};
            vkCmdCopyBuffer(buffer, staging.handle, vertices_.handle, 1, &of_vertices);
            vkCmdCopyBuffer(buffer, staging.handle, indices_.handle, 1, &of_indices);
            finish_copies(buffer, VK_PIPELINE_STAGE_VERTEX_INPUT_BIT,
                          VK_ACCESS_VERTEX_ATTRIBUTE_READ_BIT | VK_ACCESS_INDEX_READ_BIT);
        });
    }

    // Inside a pass whose pipeline and descriptors are bound.
    void draw(VkCommandBuffer commands, std::span<Draw const> draws) const {
        std::array<VkBuffer, 2> const buffers{vertices_.handle, numbers_.handle};
        constexpr std::array<VkDeviceSize, 2> from_start{};
        vkCmdBindVertexBuffers(commands, 0, 2, buffers.data(), from_start.data());
        vkCmdBindIndexBuffer(commands, indices_.handle, 0, VK_INDEX_TYPE_UINT32);
        for (Draw const& draw : draws)
            vkCmdDrawIndexed(commands, draw.index_count, draw.instance_count, draw.first_index, draw.vertex_offset,
                             draw.first_instance);
    }

private:
    Device const* device_;
    Buffer numbers_, vertices_, indices_;
};

}  // namespace shadowmath::backend::vk
