// SPDX-License-Identifier: MIT
//
// The one descriptor set: binding 0 a uniform block at a dynamic offset, binding 1 the array of maps.
#pragma once

#include "backends/vk/objects.hpp"

#include <array>

namespace shadowmath::backend::vk {

class Descriptors {
public:
    Descriptors(VkDevice device, SetLayout const& layout, Buffer const& constants, VkDeviceSize widest_block)
        : device_(device) {
        std::array<VkDescriptorPoolSize, 2> const sizes{
            {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC, 1}, {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1}}};
        VkDescriptorPoolCreateInfo pool{};
        pool.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
        pool.maxSets = 1;
        pool.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
        pool.pPoolSizes = sizes.data();
        pool_ = {device, vkCreateDescriptorPool, pool, "make a descriptor pool"};
        VkDescriptorSetAllocateInfo set{};
        set.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
        set.descriptorPool = pool_;
        set.descriptorSetCount = 1;
        set.pSetLayouts = layout.address();
        demand(vkAllocateDescriptorSets(device, &set, &set_), "make a descriptor set");

        VkDescriptorBufferInfo const block{constants.handle, 0, widest_block};
        VkWriteDescriptorSet write = writing(0, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC);
        write.pBufferInfo = &block;
        vkUpdateDescriptorSets(device, 1, &write, 0, nullptr);
    }

    void read_maps(VkSampler sampler, VkImageView maps, VkImageLayout layout) const {
        VkDescriptorImageInfo const image{sampler, maps, layout};
        VkWriteDescriptorSet write = writing(1, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);
        write.pImageInfo = &image;
        vkUpdateDescriptorSets(device_, 1, &write, 0, nullptr);
    }

    [[nodiscard]] VkDescriptorSet const* address() const noexcept { return &set_; }

private:
    [[nodiscard]] VkWriteDescriptorSet writing(std::uint32_t binding, VkDescriptorType type) const {
        VkWriteDescriptorSet write{};
        write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        write.dstSet = set_;
        write.dstBinding = binding;
        write.descriptorCount = 1;
        write.descriptorType = type;
        return write;
    }

    VkDevice device_;
    DescriptorPool pool_;
    VkDescriptorSet set_ = VK_NULL_HANDLE;
};

}  // namespace shadowmath::backend::vk
