// SPDX-License-Identifier: MIT
//
// Compute passes on a device: what the runner of backends/compute.hpp is made of, and what a backend that also draws
// can hold beside its own objects. It must die before the device.
#pragma once

#include "backends/compute.hpp"
#include "backends/vk/commands.hpp"
#include "backends/vk/objects.hpp"

#include <map>
#include <span>
#include <vector>

namespace shadowmath::backend::vk {

class Compute {
public:
    Compute(Device const& device, Commands const& commands);

    [[nodiscard]] Storage make_storage(std::size_t byte_count);
    void write(Storage storage, std::span<std::byte const> bytes);
    void read(Storage storage, std::span<std::byte> bytes) const;
    [[nodiscard]] Texture2DArray make_texture(Extent extent, int layers, std::span<float const> texels);

    // Kept until the commands that it was recorded into have run.
    struct Recorded {
        std::vector<Buffer> uniforms;
        std::vector<DescriptorPool> descriptors;
    };
    // `after` are bound behind the pass's own textures: arrays that someone else keeps, in the layout of computed_with.
    void record(VkCommandBuffer commands, Dispatch const& pass, Recorded& kept,
                std::span<VkImageView const> after = {});

    [[nodiscard]] VkBuffer buffer(Storage storage) const { return buffers_.at(std::size_t(storage)).handle; }

private:
    struct Kernel {
        SetLayout set_layout;
        PipelineLayout layout;
        Pipeline pipeline;
    };
    struct Array {
        Target target;
        ImageView view;
    };

    [[nodiscard]] Kernel const& kernel(Dispatch const& pass, std::span<VkDescriptorType const> bindings);

    Device const& device_;
    Commands const& commands_;
    Sampler sampler_;
    std::vector<Buffer> buffers_;
    std::vector<Array> textures_;
    std::map<shaders::Shader const*, Kernel> kernels_;
};

}  // namespace shadowmath::backend::vk
