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

SetLayout make_set_layout(VkDevice device) {
    constexpr VkShaderStageFlags both = VK_SHADER_STAGE_VERTEX_BIT | VK_SHADER_STAGE_FRAGMENT_BIT;
    std::array<VkDescriptorSetLayoutBinding, 2> const bindings{
        {{0, VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER_DYNAMIC, 1, both, nullptr},
         {1, VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, 1, VK_SHADER_STAGE_FRAGMENT_BIT, nullptr}}};
    return vk::make_set_layout(device, bindings);
}

// Clears its attachments and keeps them. Depth comes last.
RenderPass make_render_pass(VkDevice device, std::span<VkFormat const> colours) {
    std::vector<VkAttachmentDescription> attachments;
    std::vector<VkAttachmentReference> references;
    auto const attach = [&](VkFormat format, VkImageLayout layout) {
        references.push_back({static_cast<std::uint32_t>(references.size()), layout});
        attachments.push_back({0, format, VK_SAMPLE_COUNT_1_BIT, VK_ATTACHMENT_LOAD_OP_CLEAR,
                               VK_ATTACHMENT_STORE_OP_STORE, VK_ATTACHMENT_LOAD_OP_DONT_CARE,
                               VK_ATTACHMENT_STORE_OP_DONT_CARE, layout, layout});
    };
    for (VkFormat const format : colours) attach(format, VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL);
    attach(depth_format, VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL);

    VkSubpassDescription subpass{};
    subpass.pipelineBindPoint = VK_PIPELINE_BIND_POINT_GRAPHICS;
    subpass.colorAttachmentCount = static_cast<std::uint32_t>(colours.size());
    subpass.pColorAttachments = references.data();
    subpass.pDepthStencilAttachment = &references.back();
    VkRenderPassCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_RENDER_PASS_CREATE_INFO;
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

// What differs between the pipelines; attributes are the first so many of Vertex.
struct Recipe {
    std::span<Stage const> stages;
    VkRenderPass render_pass;
    std::uint32_t attributes;
    std::uint32_t colours;
    bool depth_clamp;
};

Pipeline make_pipeline(VkDevice device, VkPipelineLayout layout, Recipe const& recipe) {
    std::vector<VkPipelineShaderStageCreateInfo> stages;
    for (auto const& [stage, shader] : recipe.stages)
        stages.push_back(
            {VK_STRUCTURE_TYPE_PIPELINE_SHADER_STAGE_CREATE_INFO, nullptr, 0, stage, shader, "main", nullptr});

    VkVertexInputBindingDescription const binding{0, sizeof(Vertex), VK_VERTEX_INPUT_RATE_VERTEX};
    std::array<VkVertexInputAttributeDescription, 3> const attributes{
        {{0, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(Vertex, position)},
         {1, 0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(Vertex, normal)},
         {2, 0, VK_FORMAT_R8G8B8A8_UNORM, offsetof(Vertex, albedo)}}};
    VkPipelineVertexInputStateCreateInfo vertices{};
    vertices.sType = VK_STRUCTURE_TYPE_PIPELINE_VERTEX_INPUT_STATE_CREATE_INFO;
    vertices.vertexBindingDescriptionCount = 1;
    vertices.pVertexBindingDescriptions = &binding;
    vertices.vertexAttributeDescriptionCount = recipe.attributes;
    vertices.pVertexAttributeDescriptions = attributes.data();

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
    depth.depthCompareOp = VK_COMPARE_OP_LESS;
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

}  // namespace

Pipelines::Pipelines(VkDevice device)
    : sampler(make_sampler(device)), set_layout(make_set_layout(device)), layout(make_layout(device, set_layout)) {
    constexpr std::array frame_formats{colour_format, geometry_format, geometry_format};
    depth_pass = make_render_pass(device, {});
    receive_pass = make_render_pass(device, frame_formats);

    ShaderModule const depth_vert = make_shader(device, shaders::depth_vert.spirv);
    ShaderModule const receive_vert = make_shader(device, shaders::receive_vert.spirv);
    ShaderModule const receive_frag = make_shader(device, shaders::receive_frag.spirv);
    std::array<Stage, 1> const casting{{{VK_SHADER_STAGE_VERTEX_BIT, depth_vert}}};
    std::array<Stage, 2> const receiving{
        {{VK_SHADER_STAGE_VERTEX_BIT, receive_vert}, {VK_SHADER_STAGE_FRAGMENT_BIT, receive_frag}}};
    depth_clipped = make_pipeline(device, layout, {casting, depth_pass, 1, 0, false});
    depth_clamped = make_pipeline(device, layout, {casting, depth_pass, 1, 0, true});
    receive = make_pipeline(device, layout, {receiving, receive_pass, 3, 3, false});
}

}  // namespace shadowmath::backend::vk
