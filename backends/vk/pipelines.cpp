// SPDX-License-Identifier: MIT
#include "backends/vk/pipelines.hpp"

#include "backends/shaders/embedded.hpp"

#include <cstddef>
#include <vector>

namespace shadowmath::backend::vk {
namespace {

Sampler make_sampler(VkDevice device) {
    VkSamplerCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO;
    return {device, vkCreateSampler, info, "make a sampler"};
}

SetLayout make_set_layout(Device const& device) {
    VkShaderStageFlags stages = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;
    if (device.abilities().geometry_shader) stages |= VK_SHADER_STAGE_GEOMETRY_BIT;
    std::array<VkDescriptorSetLayoutBinding, 2> const bindings{
        {{0, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC, 1, stages, nullptr},
         {1, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, VK_SHADER_STAGE_FRAGMENT_BIT, nullptr}}};
    return vk::make_set_layout(device.get(), bindings);
}

// Begins with its attachments cleared, or with what they hold. Depth comes last. With a mask of views, multiview.
RenderPass make_render_pass(VkDevice device, std::span<VkFormat const> colours, VkAttachmentLoadOp begin,
                            std::uint32_t views = 0) {
    std::vector<VkAttachmentDescription> attachments;
    std::vector<VkAttachmentReference> references;
    auto const attach = [&](VkFormat format, VkImageLayout layout) {
        references.push_back({static_cast<std::uint32_t>(references.size()), layout});
        attachments.push_back({0, format, VK_SAMPLE_COUNT_1_BIT, begin, VK_ATTACHMENT_STORE_OP_STORE,
                               VK_ATTACHMENT_LOAD_OP_DONT_CARE, VK_ATTACHMENT_STORE_OP_DONT_CARE, layout, layout});
    };
    for (VkFormat const format : colours) attach(format, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
    attach(depth_format, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL);

    VkSubpassDescription subpass{};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = static_cast<std::uint32_t>(colours.size());
    subpass.pColorAttachments = references.data();
    subpass.pDepthStencilAttachment = &references.back();
    VkRenderPassMultiviewCreateInfo multiview{};
    multiview.sType = VK_STRUCTURE_TYPE_RENDER_PASS_MULTIVIEW_CREATE_INFO;
    multiview.subpassCount = 1;
    multiview.pViewMasks = &views;
    VkRenderPassCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
    info.pNext = views != 0u ? &multiview : nullptr;
    info.attachmentCount = static_cast<std::uint32_t>(attachments.size());
    info.pAttachments = attachments.data();
    info.subpassCount = 1;
    info.pSubpasses = &subpass;
    return {device, vkCreateRenderPass, info, "make a render pass"};
}

struct Stage {
    VkShaderStageFlagBits stage;
    VkShaderModule shader;
};

constexpr std::array<VkVertexInputAttributeDescription, 4> every_attribute{
    {{3, 1, VK_FORMAT_R32_UINT, 0},  // the instance's number
     {0, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(Vertex, position)},
     {1, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(Vertex, normal)},
     {2, 0, VK_FORMAT_R8G8B8A8_UNORM, offsetof(Vertex, albedo)}}};
using Attributes = std::span<VkVertexInputAttributeDescription const>;
constexpr Attributes number_and_position = Attributes(every_attribute).first(2);
constexpr Attributes position_alone = Attributes(every_attribute).subspan(1, 1);
constexpr Attributes all_of_vertex = Attributes(every_attribute).subspan(1);

// What differs between the pipelines.
struct Recipe {
    std::span<Stage const> stages;
    VkRenderPass render_pass;
    Attributes attributes;
    std::uint32_t colours;
    bool depth_clamp;
    VkCompareOp nearer = VK_COMPARE_OP_LESS;
};

Pipeline make_pipeline(VkDevice device, VkPipelineLayout layout, Recipe const& recipe) {
    std::vector<VkPipelineShaderStageCreateInfo> stages;
    for (auto const& [stage, shader] : recipe.stages)
        stages.push_back(
            {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO, nullptr, 0, stage, shader, "main", nullptr});

    constexpr std::array<VkVertexInputBindingDescription, 2> bindings{
        {{0, sizeof(Vertex), VK_VERTEX_INPUT_RATE_VERTEX}, {1, sizeof(std::uint32_t), VK_VERTEX_INPUT_RATE_INSTANCE}}};
    VkPipelineVertexInputStateCreateInfo vertices{};
    vertices.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
    vertices.vertexBindingDescriptionCount = static_cast<std::uint32_t>(bindings.size());
    vertices.pVertexBindingDescriptions = bindings.data();
    vertices.vertexAttributeDescriptionCount = static_cast<std::uint32_t>(recipe.attributes.size());
    vertices.pVertexAttributeDescriptions = recipe.attributes.data();

    VkPipelineInputAssemblyStateCreateInfo assembly{};
    assembly.sType = VK_STRUCTURE_TYPE_PIPELINE_INPUT_ASSEMBLY_STATE_CREATE_INFO;
    assembly.topology = VK_PRIMITIVE_TOPOLOGY_TRIANGLE_LIST;
    VkPipelineViewportStateCreateInfo viewport{};
    viewport.sType = VK_STRUCTURE_TYPE_PIPELINE_VIEWPORT_STATE_CREATE_INFO;
    viewport.viewportCount = viewport.scissorCount = 1;
    VkPipelineRasterizationStateCreateInfo rasteriser{};
    rasteriser.sType = VK_STRUCTURE_TYPE_PIPELINE_RASTERIZATION_STATE_CREATE_INFO;
    rasteriser.depthClampEnable = recipe.depth_clamp ? VK_TRUE : VK_FALSE;
    rasteriser.lineWidth = 1.0f;
    VkPipelineMultisampleStateCreateInfo samples{};
    samples.sType = VK_STRUCTURE_TYPE_PIPELINE_MULTISAMPLE_STATE_CREATE_INFO;
    samples.rasterizationSamples = VK_SAMPLE_COUNT_1_BIT;
    VkPipelineDepthStencilStateCreateInfo depth{};
    depth.sType = VK_STRUCTURE_TYPE_PIPELINE_DEPTH_STENCIL_STATE_CREATE_INFO;
    depth.depthTestEnable = depth.depthWriteEnable = VK_TRUE;
    depth.depthCompareOp = recipe.nearer;
    VkPipelineColorBlendAttachmentState write_all{};
    write_all.colorWriteMask =
        VK_COLOR_COMPONENT_R_BIT | VK_COLOR_COMPONENT_G_BIT | VK_COLOR_COMPONENT_B_BIT | VK_COLOR_COMPONENT_A_BIT;
    std::vector<VkPipelineColorBlendAttachmentState> const outputs(recipe.colours, write_all);
    VkPipelineColorBlendStateCreateInfo blend{};
    blend.sType = VK_STRUCTURE_TYPE_PIPELINE_COLOR_BLEND_STATE_CREATE_INFO;
    blend.attachmentCount = recipe.colours;
    blend.pAttachments = outputs.data();
    constexpr std::array set_when_drawing{VK_DYNAMIC_STATE_VIEWPORT, VK_DYNAMIC_STATE_SCISSOR};
    VkPipelineDynamicStateCreateInfo dynamic{};
    dynamic.sType = VK_STRUCTURE_TYPE_PIPELINE_DYNAMIC_STATE_CREATE_INFO;
    dynamic.dynamicStateCount = static_cast<std::uint32_t>(set_when_drawing.size());
    dynamic.pDynamicStates = set_when_drawing.data();

    VkGraphicsPipelineCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_GRAPHICS_PIPELINE_CREATE_INFO;
    info.stageCount = static_cast<std::uint32_t>(stages.size());
    info.pStages = stages.data();
    info.pVertexInputState = &vertices;
    info.pInputAssemblyState = &assembly;
    info.pViewportState = &viewport;
    info.pRasterizationState = &rasteriser;
    info.pMultisampleState = &samples;
    info.pDepthStencilState = &depth;
    info.pColorBlendState = &blend;
    info.pDynamicState = &dynamic;
    info.layout = layout;
    info.renderPass = recipe.render_pass;
    VkPipeline pipeline = VK_NULL_HANDLE;
    demand(vkCreateGraphicsPipelines(device, VK_NULL_HANDLE, 1, &info, nullptr, &pipeline), "make a pipeline");
    return {device, pipeline};
}

DepthPipelines make_depth_pipelines(VkDevice device, VkPipelineLayout layout, std::span<Stage const> stages,
                                    VkRenderPass render_pass, Attributes attributes) {
    return {make_pipeline(device, layout, {stages, render_pass, attributes, 0, false}),
            make_pipeline(device, layout, {stages, render_pass, attributes, 0, true})};
}

}  // namespace

Pipelines::Pipelines(Device const& device)
    : sampler(make_sampler(device.get())), set_layout(make_set_layout(device)),
      layout(make_layout(device.get(), set_layout)), device_(device.get()) {
    constexpr std::array frame_formats{colour_format, geometry_format, geometry_format};
    depth_pass = make_render_pass(device_, {}, VK_ATTACHMENT_LOAD_OP_CLEAR);
    receive_pass = make_render_pass(device_, frame_formats, VK_ATTACHMENT_LOAD_OP_CLEAR);
    receive_pass_resumed = make_render_pass(device_, frame_formats, VK_ATTACHMENT_LOAD_OP_LOAD);

    ShaderModule const depth_vert = make_shader(device_, shaders::depth_vert.spirv);
    std::array<Stage, 1> const one_map{{{VK_SHADER_STAGE_VERTEX_BIT, depth_vert}}};
    per_map = make_depth_pipelines(device_, layout, one_map, depth_pass, position_alone);
    eye_depth = make_pipeline(device_, layout, {one_map, depth_pass, position_alone, 0, false, VK_COMPARE_OP_GREATER});

    if (device.abilities().geometry_shader) {
        ShaderModule const vert = make_shader(device_, shaders::depth_clones_vert.spirv);
        ShaderModule const geom = make_shader(device_, shaders::depth_clones_geom.spirv);
        std::array<Stage, 2> const stages{{{VK_SHADER_STAGE_VERTEX_BIT, vert}, {VK_SHADER_STAGE_GEOMETRY_BIT, geom}}};
        clones = make_depth_pipelines(device_, layout, stages, depth_pass, number_and_position);
    }
    if (device.abilities().layer_from_vertex_shader) {
        ShaderModule const vert = make_shader(device_, shaders::depth_instances_vert.spirv);
        std::array<Stage, 1> const stages{{{VK_SHADER_STAGE_VERTEX_BIT, vert}}};
        instances = make_depth_pipelines(device_, layout, stages, depth_pass, number_and_position);
    }
    if (device.abilities().views_at_once > 0u) depth_views_ = make_shader(device_, shaders::depth_views_vert.spirv);

    ShaderModule const receive_vert = make_shader(device_, shaders::receive_vert.spirv);
    ShaderModule const receive_frag = make_shader(device_, shaders::receive_frag.spirv);
    std::array<Stage, 2> const receiving{
        {{VK_SHADER_STAGE_VERTEX_BIT, receive_vert}, {VK_SHADER_STAGE_FRAGMENT_BIT, receive_frag}}};
    receive = make_pipeline(device_, layout, {receiving, receive_pass, all_of_vertex, 3, false});
}

ViewsPass const& Pipelines::views(std::uint32_t mask) {
    ViewsPass& made = views_[mask];
    if (made.pass != VK_NULL_HANDLE) return made;
    std::array<Stage, 1> const stages{{{VK_SHADER_STAGE_VERTEX_BIT, depth_views_}}};
    made.pass = make_render_pass(device_, {}, VK_ATTACHMENT_LOAD_OP_LOAD, mask);
    made.pipelines = make_depth_pipelines(device_, layout, stages, made.pass, position_alone);
    return made;
}

}  // namespace shadowmath::backend::vk
