// SPDX-License-Identifier: MIT
#include "backends/vk/vk_backend.hpp"

#include "backends/index_ranges.hpp"
#include "backends/pass_check.hpp"
#include "backends/vk/barrier.hpp"
#include "backends/vk/commands.hpp"
#include "backends/vk/pipelines.hpp"

#include <array>
#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace shadowmath::backend {
namespace {

using namespace vk;

// Uniform blocks lie at multiples of 256 bytes, the coarsest alignment that the specification lets a driver ask for.
struct alignas(256) MapBlock {
    glm::mat4 clip_from_world;
};
struct alignas(256) FrameBlock {
    FrameConstants frame;
};
// The binding is as wide as the widest block, wherever it begins.
constexpr VkDeviceSize constants_size = (max_maps - 1) * sizeof(MapBlock) + sizeof(FrameBlock);
static_assert(constants_size >= 2 * sizeof(FrameBlock));

struct Maps {
    Target target;
    ImageView all;  // what the receiver reads
    std::array<ImageView, max_maps> layer;
    std::array<Framebuffer, max_maps> framebuffer;
    int size = 0;
    int layers = 0;
};

struct FrameTargets {
    Target colour, position, normal, depth;
    ImageView colour_view, position_view, normal_view, depth_view;
    Framebuffer framebuffer;
    Extent extent;
};

class VulkanBackend final : public Backend {
public:
    explicit VulkanBackend(VulkanOptions const& options)
        : mistake_(options.mistake), device_(options), commands_(device_), pipelines_(device_.get()),
          constants_(make_host_buffer(device_, constants_size, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT)) {
        make_descriptors();
        prepare_maps(1, 1);  // the receiver's binding always has an image
        if (mistake_ == VulkanMistake::leak) Pipelines(device_.get()).sampler.forget();
    }

    ~VulkanBackend() override { vkDeviceWaitIdle(device_.get()); }  // a call that threw may have left work behind

    BackendInfo info() const override { return {"vulkan", device_.description(), "SPIR-V"}; }

    void upload(Scene const& scene) override {
        demand_none(fault_of(scene));
        objects_.clear();
        if (!scene.indices.empty()) fill_buffers(scene);
        objects_ = scene.objects;
    }

    double draw_depth(DepthPass const& pass) override {
        demand_none(fault_of(pass, objects_.size()));
        prepare_maps(pass.map_size, static_cast<int>(pass.layers.size()));
        std::array<MapBlock, max_maps> blocks{};
        std::array<IndexRanges, max_maps> ranges;
        for (std::size_t i = 0; i < pass.layers.size(); ++i) {
            blocks[i].clip_from_world = pass.layers[i].clip_from_world;
            for (std::uint32_t const object : pass.layers[i].objects) append(ranges[i], objects_[object]);
        }
        Use const drawn =
            mistake_ == VulkanMistake::depth_pass_without_barrier ? unsynchronised_from(depth_drawn) : depth_drawn;
        VkClearValue far_end{};
        far_end.depthStencil = {1.0f, 0};
        return timed([&](VkCommandBuffer commands) {
            std::memcpy(constants_.mapped, blocks.data(), sizeof(blocks));
            hand_over(commands, maps_.target, fresh, depth_drawn);
            for (std::size_t i = 0; i < pass.layers.size(); ++i) {
                begin(commands, pipelines_.depth_pass, maps_.framebuffer[i], {maps_.size, maps_.size}, {&far_end, 1},
                      pass.depth_clamp ? pipelines_.depth_clamped : pipelines_.depth_clipped);
                draw(commands, i * sizeof(MapBlock), ranges[i]);
                vkCmdEndRenderPass(commands);
            }
            hand_over(commands, maps_.target, drawn, depth_sampled);
        });
    }

    // Objects that receive nothing are drawn by the same shader with no map to read.
    double draw_scene(ScenePass const& pass) override {
        demand_none(fault_of(pass, maps_.layers));
        prepare_frame(pass.extent);
        std::array<FrameBlock, 2> blocks{FrameBlock{pass.frame}, FrameBlock{pass.frame}};
        blocks[1].frame.map_count = 0;
        std::array<IndexRanges, 2> ranges;
        for (Object const& object : objects_) append(ranges[object.receives ? 0 : 1], object);

        glm::vec4 const& sky = pass.frame.sky;
        std::array<VkClearValue, 4> clear{};
        clear[0].color = {{sky.r, sky.g, sky.b, sky.a}};
        clear[1].color = {{0.0f, 0.0f, 0.0f, -2.0f}};  // no point
        clear[2].color = {{0.0f, 0.0f, 0.0f, 1.0f}};   // no normal, lit
        clear[3].depthStencil = {1.0f, 0};
        return timed([&](VkCommandBuffer commands) {
            std::memcpy(constants_.mapped, blocks.data(), sizeof(blocks));
            for (Target const* target : {&frame_.colour, &frame_.position, &frame_.normal})
                hand_over(commands, *target, fresh, colour_drawn);
            hand_over(commands, frame_.depth, fresh, depth_drawn);
            begin(commands, pipelines_.receive_pass, frame_.framebuffer, frame_.extent, clear, pipelines_.receive);
            for (std::size_t i = 0; i < ranges.size(); ++i) draw(commands, i * sizeof(FrameBlock), ranges[i]);
            vkCmdEndRenderPass(commands);
            for (Target const* target : {&frame_.colour, &frame_.position, &frame_.normal})
                hand_over(commands, *target, colour_drawn, copied_from);
        });
    }

    Image<float> read_depth(int layer) override {
        if (layer < 0 || layer >= maps_.layers)
            throw std::runtime_error("read_depth: layer " + std::to_string(layer) + " of " +
                                     std::to_string(maps_.layers));
        Image<float> image(Extent{maps_.size, maps_.size});
        Use const reading =
            mistake_ == VulkanMistake::copy_without_barrier ? unsynchronised_to(copied_from) : copied_from;
        Buffer const staging = make_host_buffer(device_, byte_count(image), VK_BUFFER_USAGE_TRANSFER_DST_BIT);
        submit([&](VkCommandBuffer commands) {
            hand_over(commands, maps_.target, depth_sampled, reading);
            copy(commands, maps_.target, layer, image.extent, staging, 0);
            hand_over(commands, maps_.target, copied_from, depth_sampled);
            finish_copies(commands, VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT);
        });
        std::memcpy(image.pixels.data(), staging.mapped, byte_count(image));
        return image;
    }

    Frame read_frame() override {
        Extent const extent = frame_.extent;
        Frame frame{Image<Rgba8>(extent), Image<Texel4>(extent), Image<Texel4>(extent)};
        if (frame.colour.pixels.empty()) return frame;
        VkDeviceSize const geometry = byte_count(frame.position);
        Buffer const staging =
            make_host_buffer(device_, 2 * geometry + byte_count(frame.colour), VK_BUFFER_USAGE_TRANSFER_DST_BIT);
        submit([&](VkCommandBuffer commands) {
            copy(commands, frame_.position, 0, extent, staging, 0);
            copy(commands, frame_.normal, 0, extent, staging, geometry);
            copy(commands, frame_.colour, 0, extent, staging, 2 * geometry);
            finish_copies(commands, VK_PIPELINE_STAGE_HOST_BIT, VK_ACCESS_HOST_READ_BIT);
        });
        auto const* const bytes = static_cast<std::byte const*>(staging.mapped);
        std::memcpy(frame.position.pixels.data(), bytes, geometry);
        std::memcpy(frame.normal.pixels.data(), bytes + geometry, geometry);
        std::memcpy(frame.colour.pixels.data(), bytes + 2 * geometry, byte_count(frame.colour));
        return frame;
    }

    std::vector<std::string> take_messages() override { return std::exchange(device_.messages, {}); }

private:
    template <class Pixel>
    static VkDeviceSize byte_count(Image<Pixel> const& image) {
        return image.pixels.size() * sizeof(Pixel);
    }

    void make_descriptors() {
        std::array<VkDescriptorPoolSize, 2> const sizes{
            {{VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC, 1}, {VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1}}};
        VkDescriptorPoolCreateInfo pool{};
        pool.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO;
        pool.maxSets = 1;
        pool.poolSizeCount = static_cast<std::uint32_t>(sizes.size());
        pool.pPoolSizes = sizes.data();
        descriptors_ = {device_.get(), vkCreateDescriptorPool, pool, "make a descriptor pool"};
        VkDescriptorSetAllocateInfo set{};
        set.sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO;
        set.descriptorPool = descriptors_;
        set.descriptorSetCount = 1;
        set.pSetLayouts = pipelines_.set_layout.address();
        demand(vkAllocateDescriptorSets(device_.get(), &set, &descriptor_set_), "make a descriptor set");

        VkDescriptorBufferInfo const block{constants_.handle, 0, sizeof(FrameBlock)};
        VkWriteDescriptorSet write = write_binding(0, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC);
        write.pBufferInfo = &block;
        vkUpdateDescriptorSets(device_.get(), 1, &write, 0, nullptr);
    }

    VkWriteDescriptorSet write_binding(std::uint32_t binding, VkDescriptorType type) const {
        VkWriteDescriptorSet write{};
        write.sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        write.dstSet = descriptor_set_;
        write.dstBinding = binding;
        write.descriptorCount = 1;
        write.descriptorType = type;
        return write;
    }

    void fill_buffers(Scene const& scene) {
        VkDeviceSize const vertex_bytes = scene.vertices.size() * sizeof(Vertex);
        VkDeviceSize const index_bytes = scene.indices.size() * sizeof(std::uint32_t);
        Buffer const staging = make_host_buffer(device_, vertex_bytes + index_bytes, VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
        std::memcpy(staging.mapped, scene.vertices.data(), vertex_bytes);
        std::memcpy(static_cast<std::byte*>(staging.mapped) + vertex_bytes, scene.indices.data(), index_bytes);
        vertices_ = make_device_buffer(device_, vertex_bytes,
                                       VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT);
        indices_ = make_device_buffer(device_, index_bytes,
                                      VK_BUFFER_USAGE_INDEX_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT);
        submit([&](VkCommandBuffer commands) {
            VkBufferCopy const of_vertices{0, 0, vertex_bytes}, of_indices{vertex_bytes, 0, index_bytes};
            vkCmdCopyBuffer(commands, staging.handle, vertices_.handle, 1, &of_vertices);
            vkCmdCopyBuffer(commands, staging.handle, indices_.handle, 1, &of_indices);
            finish_copies(commands, VK_PIPELINE_STAGE_VERTEX_INPUT_BIT,
                          VK_ACCESS_VERTEX_ATTRIBUTE_READ_BIT | VK_ACCESS_INDEX_READ_BIT);
        });
    }

    void prepare_maps(int size, int layers) {
        if (size == maps_.size && layers == maps_.layers) return;
        Maps maps;
        VkImageUsageFlags usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
        if (mistake_ != VulkanMistake::usage_forgotten) usage |= VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
        maps.target = make_target(device_, {depth_format, {size, size}, layers, usage},
                                  std::to_string(layers) + " shadow maps of " + std::to_string(size));
        maps.all = make_view(device_.get(), maps.target, depth_format, VK_IMAGE_VIEW_TYPE_2D_ARRAY, 0, layers);
        for (int i = 0; i < layers; ++i) {
            auto const at = static_cast<std::size_t>(i);
            maps.layer[at] = make_view(device_.get(), maps.target, depth_format, VK_IMAGE_VIEW_TYPE_2D, i, 1);
            maps.framebuffer[at] =
                make_framebuffer(device_.get(), pipelines_.depth_pass, {size, size}, {maps.layer[at].address(), 1});
        }
        maps.size = size;
        maps.layers = layers;
        submit([&](VkCommandBuffer commands) { hand_over(commands, maps.target, fresh, depth_sampled); });

        VkDescriptorImageInfo const image{pipelines_.sampler, maps.all, depth_sampled.layout};
        VkWriteDescriptorSet write = write_binding(1, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER);
        write.pImageInfo = &image;
        vkUpdateDescriptorSets(device_.get(), 1, &write, 0, nullptr);
        maps_ = std::move(maps);
    }

    void prepare_frame(Extent extent) {
        if (extent.width == frame_.extent.width && extent.height == frame_.extent.height) return;
        FrameTargets frame;
        auto const make = [&](Target& target, ImageView& view, VkFormat format, VkImageUsageFlags usage) {
            target = make_target(device_, {format, extent, 1, usage},
                                 "a frame of " + std::to_string(extent.width) + " x " + std::to_string(extent.height));
            view = make_view(device_.get(), target, format, VK_IMAGE_VIEW_TYPE_2D, 0, 1);
        };
        constexpr auto kept = VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT | VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
        make(frame.colour, frame.colour_view, colour_format, kept);
        make(frame.position, frame.position_view, geometry_format, kept);
        make(frame.normal, frame.normal_view, geometry_format, kept);
        make(frame.depth, frame.depth_view, depth_format, VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT);
        std::array<VkImageView, 4> const views{frame.colour_view, frame.position_view, frame.normal_view,
                                               frame.depth_view};
        frame.framebuffer = make_framebuffer(device_.get(), pipelines_.receive_pass, extent, views);
        frame.extent = extent;
        frame_ = std::move(frame);
    }

    // A positive viewport: NDC y = -1 is row 0, as in the other backends.
    void begin(VkCommandBuffer commands, VkRenderPass render_pass, VkFramebuffer framebuffer, Extent extent,
               std::span<VkClearValue const> clear, VkPipeline pipeline) const {
        VkRect2D const area{{0, 0},
                            {static_cast<std::uint32_t>(extent.width), static_cast<std::uint32_t>(extent.height)}};
        VkViewport const viewport{0.0f, 0.0f, static_cast<float>(extent.width), static_cast<float>(extent.height),
                                  0.0f, 1.0f};
        VkRenderPassBeginInfo info{};
        info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_BEGIN_INFO;
        info.renderPass = render_pass;
        info.framebuffer = framebuffer;
        info.renderArea = area;
        info.clearValueCount = static_cast<std::uint32_t>(clear.size());
        info.pClearValues = clear.data();
        vkCmdBeginRenderPass(commands, &info, VK_SUBPASS_CONTENTS_INLINE);
        vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipeline);
        vkCmdSetViewport(commands, 0, 1, &viewport);
        vkCmdSetScissor(commands, 0, 1, &area);
    }

    void draw(VkCommandBuffer commands, std::size_t block_offset, IndexRanges const& ranges) const {
        if (ranges.empty()) return;
        auto const offset = static_cast<std::uint32_t>(block_offset);
        VkDeviceSize const from_start = 0;
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_.layout, 0, 1, &descriptor_set_, 1,
                                &offset);
        vkCmdBindVertexBuffers(commands, 0, 1, vertices_.handle.address(), &from_start);
        vkCmdBindIndexBuffer(commands, indices_.handle, 0, VK_INDEX_TYPE_UINT32);
        for (IndexRange const& range : ranges) vkCmdDrawIndexed(commands, range.count, 1, range.first, 0, 0);
    }

    static void copy(VkCommandBuffer commands, Target const& from, int layer, Extent extent, Buffer const& to,
                     VkDeviceSize offset) {
        VkBufferImageCopy region{};
        region.bufferOffset = offset;
        region.imageSubresource = {from.aspect, 0, static_cast<std::uint32_t>(layer), 1};
        region.imageExtent = {static_cast<std::uint32_t>(extent.width), static_cast<std::uint32_t>(extent.height), 1};
        vkCmdCopyImageToBuffer(commands, from.image, copied_from.layout, to.handle, 1, &region);
    }

    template <class Record>
    void submit(Record const& record) const {
        commands_.submit(record);
    }

    template <class Record>
    double timed(Record const& record) const {
        return commands_.timed(record);
    }

    VulkanMistake mistake_;
    Device device_;  // dies last of all that follows
    Commands commands_;
    Pipelines pipelines_;
    Buffer constants_;
    DescriptorPool descriptors_;
    VkDescriptorSet descriptor_set_ = VK_NULL_HANDLE;
    Buffer vertices_, indices_;
    std::vector<Object> objects_;
    Maps maps_;
    FrameTargets frame_;
};

}  // namespace

std::unique_ptr<Backend> make_vulkan_backend(VulkanOptions const& options) {
    return std::make_unique<VulkanBackend>(options);
}

}  // namespace shadowmath::backend
