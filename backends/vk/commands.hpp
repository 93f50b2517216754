// SPDX-License-Identifier: MIT
//
// Records, submits and waits: nothing is ever in flight between calls.
#pragma once

#include "backends/vk/objects.hpp"

namespace shadowmath::backend::vk {

class Commands {
public:
    explicit Commands(Device const& device) : device_(device.get()), queue_(device.queue()) {
        VkCommandPoolCreateInfo pool{};
        pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
        pool.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
        pool.queueFamilyIndex = device.queue_family();
        pool_ = {device_, vkCreateCommandPool, pool, "make a command pool"};
        VkCommandBufferAllocateInfo buffer{};
        buffer.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
        buffer.commandPool = pool_;
        buffer.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
        buffer.commandBufferCount = 1;
        demand(vkAllocateCommandBuffers(device_, &buffer, &commands_), "make a command buffer");
        VkFenceCreateInfo fence{};
        fence.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
        finished_ = {device_, vkCreateFence, fence, "make a fence"};
    }

    // `record` is called with the command buffer.
    template <class Record>
    void submit(Record const& record) const {
        demand(vkResetCommandPool(device_, pool_, 0), "reset its commands");
        VkCommandBufferBeginInfo begin{};
        begin.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO;
        begin.flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT;
        demand(vkBeginCommandBuffer(commands_, &begin), "begin its commands");
        record(commands_);
        demand(vkEndCommandBuffer(commands_), "end its commands");
        VkSubmitInfo info{};
        info.sType = VK_STRUCTURE_TYPE_SUBMIT_INFO;
        info.commandBufferCount = 1;
        info.pCommandBuffers = &commands_;
        demand(vkQueueSubmit(queue_, 1, &info, finished_), "submit its commands");
        demand(vkWaitForFences(device_, 1, finished_.address(), VK_TRUE, UINT64_MAX), "wait for its commands");
        demand(vkResetFences(device_, 1, finished_.address()), "reset a fence");
    }

private:
    VkDevice device_;
    VkQueue queue_;
    CommandPool pool_;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    Fence finished_;
};

}  // namespace shadowmath::backend::vk
