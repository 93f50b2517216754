// SPDX-License-Identifier: MIT
//
// One command buffer, recorded, submitted and waited for at a time: nothing is ever in flight between calls.
#pragma once

#include "backends/vk/objects.hpp"

#include <chrono>

namespace shadowmath::backend::vk {

class Commands {
public:
    explicit Commands(Device const& device) : device_(&device) {
        VkCommandPoolCreateInfo pool{};
        pool.sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO;
        pool.flags = VK_COMMAND_POOL_CREATE_TRANSIENT_BIT;
        pool.queueFamilyIndex = device.queue_family();
        pool_ = {device.get(), vkCreateCommandPool, pool, "make a command pool"};
        VkCommandBufferAllocateInfo buffer{};
        buffer.sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO;
        buffer.commandPool = pool_;
        buffer.level = VK_COMMAND_BUFFER_LEVEL_PRIMARY;
        buffer.commandBufferCount = 1;
        demand(vkAllocateCommandBuffers(device.get(), &buffer, &commands_), "make a command buffer");
        VkFenceCreateInfo fence{};
        fence.sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO;
        finished_ = {device.get(), vkCreateFence, fence, "make a fence"};
    }

    // `record` is called with the command buffer.
    template <class Record>
    void submit(Record const& record) const {
        demand(vkResetCommandPool(device_->get(), pool_, 0), "reset its commands");
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
        demand(vkQueueSubmit(device_->queue(), 1, &info, finished_), "submit its commands");
        demand(vkWaitForFences(device_->get(), 1, finished_.address(), VK_TRUE, UINT64_MAX), "wait for its commands");
        demand(vkResetFences(device_->get(), 1, finished_.address()), "reset a fence");
    }

    // The same; milliseconds until the device has finished.
    template <class Record>
    double timed(Record const& record) const {
        auto const begun = std::chrono::steady_clock::now();
        submit(record);
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begun).count();
    }

private:
    Device const* device_;
    CommandPool pool_;
    VkCommandBuffer commands_ = VK_NULL_HANDLE;
    Fence finished_;
};

}  // namespace shadowmath::backend::vk
