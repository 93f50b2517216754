// SPDX-License-Identifier: MIT
//
// What the device counts between two points of a command buffer, neither of them inside a render pass.
#pragma once

#include "backends/backend.hpp"
#include "backends/vk/objects.hpp"

#include <array>
#include <optional>

namespace shadowmath::backend::vk {

class Statistics {
public:
    explicit Statistics(Device const& device) {
        if (!device.abilities().statistics) return;
        VkQueryPoolCreateInfo info{};
        info.sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO;
        info.queryType = VK_QUERY_TYPE_PIPELINE_STATISTICS;
        info.queryCount = 1;
        info.pipelineStatistics = VK_QUERY_PIPELINE_STATISTIC_INPUT_ASSEMBLY_VERTICES_BIT |
                                  VK_QUERY_PIPELINE_STATISTIC_INPUT_ASSEMBLY_PRIMITIVES_BIT |
                                  VK_QUERY_PIPELINE_STATISTIC_VERTEX_SHADER_INVOCATIONS_BIT |
                                  VK_QUERY_PIPELINE_STATISTIC_GEOMETRY_SHADER_INVOCATIONS_BIT |
                                  VK_QUERY_PIPELINE_STATISTIC_GEOMETRY_SHADER_PRIMITIVES_BIT |
                                  VK_QUERY_PIPELINE_STATISTIC_CLIPPING_INVOCATIONS_BIT |
                                  VK_QUERY_PIPELINE_STATISTIC_CLIPPING_PRIMITIVES_BIT;
        pool_ = {device.get(), vkCreateQueryPool, info, "make a query pool"};
    }

    void begin(VkCommandBuffer commands) const {
        if (pool_ == VK_NULL_HANDLE) return;
        vkCmdResetQueryPool(commands, pool_, 0, 1);
        vkCmdBeginQuery(commands, pool_, 0, 0);
    }
    void end(VkCommandBuffer commands) const {
        if (pool_ != VK_NULL_HANDLE) vkCmdEndQuery(commands, pool_, 0);
    }

    // Once the commands have run. Counts come in the order of their bits, which is that of DriverCount.
    [[nodiscard]] std::optional<DriverCount> read(VkDevice device) const {
        if (pool_ == VK_NULL_HANDLE) return std::nullopt;
        std::array<std::uint64_t, 7> n{};
        demand(vkGetQueryPoolResults(device, pool_, 0, 1, sizeof(n), n.data(), sizeof(n),
                                     VK_QUERY_RESULT_64_BIT | VK_QUERY_RESULT_WAIT_BIT),
               "read its statistics");
        return DriverCount{n[0], n[1], n[2], n[3], n[4], n[5], n[6]};
    }

private:
    QueryPool pool_;
};

}  // namespace shadowmath::backend::vk
