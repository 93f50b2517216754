// SPDX-License-Identifier: MIT
#include "backends/vk/barrier.hpp"
#include "backends/vk/compute.hpp"

#include <algorithm>
#include <cstring>
#include <utility>

namespace shadowmath::backend {
namespace vk {
namespace {

constexpr VkBufferUsageFlags storage_usage =
    VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
constexpr VkAccessFlags any_access = VK_ACCESS_MEMORY_READ_BIT | VK_ACCESS_MEMORY_WRITE_BIT;

// Whatever comes next sees what the pass wrote.
void finish_pass(VkCommandBuffer commands) {
    VkMemoryBarrier barrier{};
    barrier.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER;
    barrier.srcAccessMask = VK_ACCESS_SHADER_WRITE_BIT;
    barrier.dstAccessMask = any_access;
    vkCmdPipelineBarrier(commands, VK_PIPELINE_STAGE_COMPUTE_SHADER_BIT, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, 0, 1,
                         &barrier, 0, nullptr, 0, nullptr);
}

std::vector<VkDescriptorType> bindings_of(Dispatch const& pass, std::size_t more_textures) {
    std::vector<VkDescriptorType> types{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER};
    types.insert(types.end(), pass.storage.size(), VK_DESCRIPTOR_TYPE_STORAGE_BUFFER);
    types.insert(types.end(), pass.textures.size() + more_textures, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);
    return types;
}

SetLayout make_set_layout(VkDevice device, std::span<VkDescriptorType const> types) {
    std::vector<VkDescriptorSetLayoutBinding> bindings;
    for (VkDescriptorType const type : types)
        bindings.push_back(
            {static_cast<std::uint32_t>(bindings.size()), type, 1, VK_SHADER_STAGE_COMPUTE_BIT, nullptr});
    return vk::make_set_layout(device, bindings);
}

Pipeline make_pipeline(VkDevice device, VkPipelineLayout layout, shaders::Shader const& shader) {
    ShaderModule const module = make_shader(device, shader.spirv);
    VkComputePipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_COMPUTE_PIPELINE_CREATE_INFO;
    info.stage = {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO,
                  nullptr,
                  0,
                  VK_SHADER_STAGE_COMPUTE_BIT,
                  module,
                  "main",
                  nullptr};
    info.layout = layout;
    VkPipeline pipeline = VK_NULL_HANDLE;
    demand(vkCreateComputePipelines(device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline), "make a pipeline");
    return {device, pipeline};
}

}  // namespace

Compute::Compute(Device const& device, Commands const& commands) : device_(device), commands_(commands) {
    VkSamplerCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
    sampler_ = {device.get(), vkCreateSampler, info, "make a sampler"};
}

Storage Compute::make_storage(std::size_t byte_count) {
    // A buffer of nothing cannot be, and what is filled with zeros is so in fours.
    VkDeviceSize const size = std::max((byte_count + 3) / 4 * 4, std::size_t{4});
    buffers_.push_back(make_device_buffer(device_, size, storage_usage));
    commands_.submit([&](VkCommandBuffer commands) {
        vkCmdFillBuffer(commands, buffers_.back().handle, 0, VK_WHOLE_SIZE, 0);
        finish_copies(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, any_access);
    });
    return Storage(buffers_.size() - 1);
}

void Compute::write(Storage storage, std::span<std::byte const> bytes) {
    if (bytes.empty()) return;
    Buffer const staging = make_host_buffer(device_, bytes.size(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    std::memcpy(staging.mapped, bytes.data(), bytes.size());
    commands_.submit([&](VkCommandBuffer commands) {
        VkBufferCopy const all{0, 0, bytes.size()};
        vkCmdCopyBuffer(commands, staging.handle, buffer(storage), 1, &all);
        finish_copies(commands, VK_PIPELINE_STAGE_ALL_COMMANDS_BIT, any_access);
    });
}

void Compute::read(Storage storage, std::span<std::byte> bytes) const {
    if (bytes.empty()) return;
    Buffer const staging = make_host_buffer(device_, bytes.size(), VK_BUFFER_USAGE_TRANSFER_DST_BIT);
    commands_.submit([&](VkCommandBuffer commands) {
        VkBufferCopy const all{0, 0, bytes.size()};
        vkCmdCopyBuffer(commands, buffer(storage), staging.handle, 1, &all);
        finish_copies(commands, VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT);
    });
    std::memcpy(bytes.data(), staging.mapped, bytes.size());
}

Texture2DArray Compute::make_texture(Extent extent, int layers, std::span<float const> texels) {
    constexpr VkFormat format = VK_FORMAT_R32_SFLOAT;
    Array array;
    array.target =
        make_target(device_, {format, extent, layers, VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT},
                    std::to_string(layers) + " textures");
    array.view = make_view(device_.get(), array.target, format, VK_IMAGE_VIEW_TYPE_2D_ARRAY, 0, layers);
    Buffer const staging = make_host_buffer(device_, texels.size_bytes(), VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
    std::memcpy(staging.mapped, texels.data(), texels.size_bytes());
    commands_.submit([&](VkCommandBuffer commands) {
        VkBufferImageCopy region{};
        region.imageSubresource = {array.target.aspect, 0, 0, static_cast<std::uint32_t>(layers)};
        region.imageExtent = {static_cast<std::uint32_t>(extent.width), static_cast<std::uint32_t>(extent.height), 1};
        hand_over(commands, array.target, fresh, copied_to);
        vkCmdCopyBufferToImage(commands, staging.handle, array.target.image, copied_to.layout, 1, &region);
        hand_over(commands, array.target, copied_to, computed_with);
    });
    textures_.push_back(std::move(array));
    return Texture2DArray(textures_.size() - 1);
}

Compute::Kernel const& Compute::kernel(Dispatch const& pass, std::span<VkDescriptorType const> bindings) {
    auto const known = kernels_.find(pass.shader);
    if (known != kernels_.end()) return known->second;
    Kernel made;
    made.set_layout = make_set_layout(device_.get(), bindings);
    made.layout = make_layout(device_.get(), made.set_layout);
    made.pipeline = make_pipeline(device_.get(), made.layout, *pass.shader);
    return kernels_.emplace(pass.shader, std::move(made)).first->second;
}

void Compute::record(VkCommandBuffer commands, Dispatch const& pass, Recorded& kept,
                     std::span<VkImageView const> after) {
    std::vector<VkDescriptorType> const bindings = bindings_of(pass, after.size());
    Kernel const& kernel_of_pass = kernel(pass, bindings);
    VkDescriptorPoolSize const sizes[] = {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, 1},
                                          {VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, max_storage_blocks},
                                          {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER,
                                           static_cast<std::uint32_t>(pass.textures.size() + after.size()) + 1}};
    VkDescriptorPoolCreateInfo pool{};
    pool.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
    pool.maxSets = 1;
    pool.poolSizeCount = 3;
    pool.pPoolSizes = sizes;
    DescriptorPool const& descriptors =
        kept.descriptors.emplace_back(device_.get(), vkCreateDescriptorPool, pool, "make a descriptor pool");
    VkDescriptorSetAllocateInfo allocate{};
    allocate.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
    allocate.descriptorPool = descriptors;
    allocate.descriptorSetCount = 1;
    allocate.pSetLayouts = kernel_of_pass.set_layout.address();
    VkDescriptorSet set = VK_NULL_HANDLE;
    demand(vkAllocateDescriptorSets(device_.get(), &allocate, &set), "make a descriptor set");

    // A pass without uniforms has a block all the same, which nothing reads.
    std::size_t const uniform_bytes = std::max(pass.uniforms.size(), std::size_t{16});
    Buffer const& uniforms =
        kept.uniforms.emplace_back(make_host_buffer(device_, uniform_bytes, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT));
    if (!pass.uniforms.empty()) std::memcpy(uniforms.mapped, pass.uniforms.data(), pass.uniforms.size());

    std::vector<VkDescriptorBufferInfo> buffers{{uniforms.handle, 0, VK_WHOLE_SIZE}};
    for (Storage const storage : pass.storage) buffers.push_back({buffer(storage), 0, VK_WHOLE_SIZE});
    std::vector<VkDescriptorImageInfo> images;
    for (Texture2DArray const texture : pass.textures)
        images.push_back({sampler_, textures_.at(std::size_t(texture)).view, computed_with.layout});
    for (VkImageView const view : after) images.push_back({sampler_, view, computed_with.layout});
    std::vector<VkWriteDescriptorSet> writes;
    for (VkDescriptorType const type : bindings) {
        std::size_t const binding = writes.size();
        VkWriteDescriptorSet write{};
        write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        write.dstSet = set;
        write.dstBinding = static_cast<std::uint32_t>(binding);
        write.descriptorCount = 1;
        write.descriptorType = type;
        if (binding < buffers.size())
            write.pBufferInfo = &buffers[binding];
        else
            write.pImageInfo = &images[binding - buffers.size()];
        writes.push_back(write);
    }
    vkUpdateDescriptorSets(device_.get(), static_cast<std::uint32_t>(writes.size()), writes.data(), 0, nullptr);

    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, kernel_of_pass.pipeline);
    vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_COMPUTE, kernel_of_pass.layout, 0, 1, &set, 0, nullptr);
    vkCmdDispatch(commands, pass.groups.x, pass.groups.y, pass.groups.z);
    finish_pass(commands);
}

}  // namespace vk

namespace {

using namespace vk;

class VulkanCompute final : public ComputeRunner {
public:
    explicit VulkanCompute(VulkanOptions const& options)
        : device_(options), commands_(device_), compute_(device_, commands_) {}

    ~VulkanCompute() override { vkDeviceWaitIdle(device_.get()); }  // a call that threw may have left work behind

    BackendInfo info() const override { return {"vulkan", device_.description(), "SPIR-V"}; }

    Storage make_storage(std::size_t byte_count) override { return compute_.make_storage(byte_count); }
    void write(Storage storage, std::span<std::byte const> bytes) override { compute_.write(storage, bytes); }
    void read(Storage storage, std::span<std::byte> bytes) override { compute_.read(storage, bytes); }
    Texture2DArray make_texture(Extent extent, int layers, std::span<float const> texels) override {
        return compute_.make_texture(extent, layers, texels);
    }

    double run(std::span<Dispatch const> passes) override {
        Compute::Recorded kept;
        return commands_.timed([&](VkCommandBuffer commands) {
            for (Dispatch const& pass : passes) compute_.record(commands, pass, kept);
        });
    }

    std::vector<std::string> take_messages() override { return std::exchange(device_.messages, {}); }

private:
    Device device_;  // dies last of all that follows
    Commands commands_;
    Compute compute_;
};

}  // namespace

std::unique_ptr<ComputeRunner> make_vulkan_compute(VulkanOptions const& options) {
    return std::make_unique<VulkanCompute>(options);
}

}  // namespace shadowmath::backend
