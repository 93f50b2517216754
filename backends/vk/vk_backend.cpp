// SPDX-License-Identifier: MIT
#include "backends/vk/vk_backend.hpp"

#include "backends/constants.hpp"
#include "backends/pass_check.hpp"
#include "backends/vk/barrier.hpp"
#include "backends/vk/commands.hpp"
#include "backends/vk/compute.hpp"
#include "backends/vk/descriptors.hpp"
#include "backends/vk/mesh.hpp"
#include "backends/vk/read_back.hpp"
#include "backends/vk/record.hpp"
#include "backends/vk/statistics.hpp"
#include "backends/vk/targets.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>
#include <optional>
#include <stdexcept>
#include <utility>

namespace shadowmath::backend {
namespace {

using namespace vk;

class VulkanBackend final : public Backend {
public:
    explicit VulkanBackend(VulkanOptions const& options)
        : mistake_(options.mistake), device_(options),
          views_at_once_(std::min(device_.abilities().views_at_once, std::uint32_t{max_maps})), pipelines_(device_),
          commands_(device_), compute_(device_, commands_), statistics_(device_),
          constants_(make_host_buffer(device_, sizeof(Constants),
                                      VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT)),
          mesh_(device_), descriptors_(device_.get(), pipelines_.set_layout, constants_, sizeof(FrameBlock)) {
        prepare_maps(1, 1);  // the receiver's binding always has an image
        if (views_at_once_ > 1u && !second_view_works()) views_at_once_ = 1u;
        if (mistake_ == VulkanMistake::leak) Pipelines(device_).sampler.forget();
    }

    ~VulkanBackend() override { vkDeviceWaitIdle(device_.get()); }  // a call that threw may have left work behind

    BackendInfo info() const override { return {"vulkan", device_.description(), "SPIR-V"}; }

    std::vector<DrawWay> ways() const override {
        std::vector<DrawWay> ways{DrawWay::pass_per_map};
        if (device_.abilities().geometry_shader) ways.push_back(DrawWay::geometry_clones);
        if (device_.abilities().layer_from_vertex_shader) ways.push_back(DrawWay::instances);
        if (views_at_once_ > 0u) ways.push_back(DrawWay::multiview);
        return ways;
    }

    void upload(Scene const& scene) override {
        demand_none(fault_of(scene));
        objects_.clear();
        if (!scene.indices.empty()) mesh_.upload(commands_, scene);
        objects_ = scene.objects;
    }

    DrawWork draw_depth(DepthPass const& pass) override {
        demand_none(fault_of(pass, objects_.size()));
        demand_none(fault_of(pass.way, ways()));
        demand_none(fault_of_fitted(pass.fitted, fitted_maps_.has_value()));
        prepare_maps(pass.map_size, static_cast<int>(pass.layers.size()));
        bool const multiview = pass.way == DrawWay::multiview;
        std::uint32_t const at_once = multiview ? views_at_once_ : std::uint32_t{max_maps};
        std::vector<DrawGroup> const groups = plan_draws(pass, objects_, at_once);
        Constants constants;
        constants.set(pass.layers, at_once);
        Use const drawn =
            mistake_ == VulkanMistake::depth_pass_without_barrier ? unsynchronised_from(depth_drawn) : depth_drawn;
        return timed(work_of(pass.way, groups), [&](VkCommandBuffer commands) {
            std::memcpy(constants_.mapped, &constants, sizeof(constants));
            if (pass.fitted) take_fitted(commands, Constants::copies_of_maps(pass.layers.size(), at_once));
            hand_over(commands, maps_.target, fresh, depth_drawn);
            if (multiview) clear_maps(commands);
            for (DrawGroup const& group : groups) draw_group(commands, pass, group);
            hand_over(commands, maps_.target, drawn, depth_sampled);
        });
    }

    DrawWork draw_scene(ScenePass const& pass) override {
        demand_none(fault_of(pass, maps_.layers));
        demand_none(fault_of_fitted(pass.fitted, fitted_maps_.has_value()));
        prepare_frame(pass.extent);
        std::vector<ViewDraw> const views = plan_view(pass, objects_);
        Constants constants;
        constants.set(views);
        return timed(work_of(views), [&](VkCommandBuffer commands) {
            std::memcpy(constants_.mapped, &constants, sizeof(constants));
            if (pass.fitted) take_fitted(commands, Constants::copies_of_frames(views.size()));
            begin_view(commands, pass.frame.sky);
            for (std::size_t i = 0; i < views.size(); ++i) draw_view(commands, views[i], i);
            vkCmdEndRenderPass(commands);
            finish_view(commands);
        });
    }

    DrawWork draw_split_by_split(DepthPass const& pass, ScenePass const& view) override {
        demand_none(fault_of(pass, view, objects_.size()));
        DepthPass maps = pass;
        maps.way = DrawWay::pass_per_map;
        prepare_maps(maps.map_size, 1);
        prepare_frame(view.extent);
        SplitPlan const plan = plan_split_by_split(maps, view, objects_);
        Constants constants;
        constants.set(maps.layers);
        constants.set(plan.views);
        return timed(work_of(plan), [&](VkCommandBuffer commands) {
            std::memcpy(constants_.mapped, &constants, sizeof(constants));
            for (std::size_t i = 0; i < plan.maps.size(); ++i) {
                hand_over(commands, maps_.target, i == 0 ? fresh : depth_sampled, depth_drawn);
                draw_group(commands, maps, plan.maps[i]);
                hand_over(commands, maps_.target, depth_drawn, depth_sampled);
                if (i == 0)
                    begin_view(commands, view.frame.sky);
                else
                    resume_view(commands);
                std::size_t const end = i + 1 == plan.maps.size() ? plan.views.size() : i + 1;
                for (std::size_t k = i; k < end; ++k) draw_view(commands, plan.views[k], k);
                vkCmdEndRenderPass(commands);
            }
            finish_view(commands);
        });
    }

    DrawWork fit_maps(FitPass const& pass) override {
        demand_none(fault_of(pass));
        prepare_fit(pass);
        ViewDraw eye;
        for (Object const& object : objects_) append(eye.draws, object);
        DepthLayer const layer{pass.clip_from_world, {}};
        Constants constants;
        constants.set(std::span(&layer, 1));
        Compute::Recorded kept;
        return timed(work_of(std::span(&eye, 1)), [&](VkCommandBuffer commands) {
            std::memcpy(constants_.mapped, &constants, sizeof(constants));
            hand_over(commands, eye_.target, fresh, depth_drawn);
            VkClearValue const nothing{};
            begin_pass(commands, pipelines_.depth_pass, eye_.framebuffer, eye_.extent, {&nothing, 1},
                       pipelines_.eye_depth);
            draw(commands, Constants::offset_of_map(0), eye.draws);
            vkCmdEndRenderPass(commands);
            hand_over(commands, eye_.target, depth_drawn, computed_with);
            for (ComputeStep const& step : pass.steps)
                compute_.record(commands, {step.shader, step.groups, {*fit_state_, *fitted_maps_}, {}, pass.constants},
                                kept, {eye_.array.address(), 1});
        });
    }

    Image<float> read_depth(int layer) override {
        if (layer < 0 || layer >= maps_.layers)
            throw std::runtime_error("read_depth: layer " + std::to_string(layer) + " of " +
                                     std::to_string(maps_.layers));
        Use const reading =
            mistake_ == VulkanMistake::copy_without_barrier ? unsynchronised_to(copied_from) : copied_from;
        return read_layer(device_, commands_, maps_.target, layer, {maps_.size, maps_.size}, depth_sampled, reading);
    }

    Frame read_frame() override { return read_pictures(device_, commands_, frame_); }

    Image<float> read_eye_depth() override {
        return read_layer(device_, commands_, eye_.target, 0, eye_.extent, computed_with);
    }

    std::vector<MapConstants> read_fit() override {
        demand_none(fault_of_fitted(true, fitted_maps_.has_value()));
        std::vector<MapConstants> maps(max_maps);
        compute_.read(*fitted_maps_, std::as_writable_bytes(std::span(maps)));
        return maps;
    }

    std::vector<std::string> take_messages() override { return std::exchange(device_.messages, {}); }

private:
    // Mesa 22.3's software driver transforms every view of a draw, but rasterises them all into the first one's map. So
    // two are drawn and looked at; where the second is missing, one view at once is what multiview comes to.
    bool second_view_works() {
        Scene scene;
        for (glm::vec2 const corner : {glm::vec2(-1, -1), glm::vec2(3, -1), glm::vec2(-1, 3)})
            scene.vertices.push_back({glm::vec3(corner, 0.5f), {0, 0, 1}, {255, 255, 255, 255}});
        scene.indices = {0, 1, 2};
        scene.objects = {{0, 3}};
        upload(scene);
        std::array<std::uint32_t, 1> const triangle{0};
        std::array<DepthLayer, 2> const both{{{glm::mat4(1.0f), triangle}, {glm::mat4(1.0f), triangle}}};
        draw_depth({1, both, true, DrawWay::multiview});
        bool const works = read_depth(1).at(0, 0) < 1.0f;
        upload({});
        prepare_maps(1, 1);
        return works;
    }

    void prepare_maps(int size, int layers) {
        if (size == maps_.size && layers == maps_.layers) return;
        VkImageUsageFlags usage = VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT | VK_IMAGE_USAGE_SAMPLED_BIT;
        if (mistake_ != VulkanMistake::usage_forgotten) usage |= VK_IMAGE_USAGE_TRANSFER_SRC_BIT;
        Maps maps = make_maps(device_, pipelines_, size, layers, static_cast<int>(views_at_once_), usage);
        commands_.submit([&](VkCommandBuffer commands) { hand_over(commands, maps.target, fresh, depth_sampled); });

        descriptors_.read_maps(pipelines_.sampler, maps.all, depth_sampled.layout);
        maps_ = std::move(maps);
    }

    void prepare_frame(Extent extent) {
        if (extent.width == frame_.extent.width && extent.height == frame_.extent.height) return;
        frame_ = make_frame(device_, pipelines_, extent);
    }

    void prepare_fit(FitPass const& pass) {
        if (pass.extent.width != eye_.extent.width || pass.extent.height != eye_.extent.height)
            eye_ = make_eye_depth(device_, pipelines_, pass.extent);
        if (!fit_state_ || state_bytes_ != pass.state_bytes) fit_state_ = compute_.make_storage(pass.state_bytes);
        state_bytes_ = pass.state_bytes;
        if (!fitted_maps_ && !pass.steps.empty()) fitted_maps_ = compute_.make_storage(max_maps * sizeof(MapConstants));
    }

    void take_fitted(VkCommandBuffer commands, std::span<BlockCopy const> copies) const {
        std::vector<VkBufferCopy> regions;
        for (BlockCopy const& copy : copies) regions.push_back({copy.from, copy.to, copy.size});
        vkCmdCopyBuffer(commands, compute_.buffer(*fitted_maps_), constants_.handle,
                        static_cast<std::uint32_t>(regions.size()), regions.data());
        finish_copies(commands, VK_PIPELINE_STAGE_ALL_GRAPHICS_BIT, VK_ACCESS_UNIFORM_READ_BIT);
    }

    void draw(VkCommandBuffer commands, std::size_t block_offset, std::span<Draw const> draws) const {
        if (draws.empty()) return;
        auto const offset = static_cast<std::uint32_t>(block_offset);
        vkCmdBindDescriptorSets(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, pipelines_.layout, 0, 1,
                                descriptors_.address(), 1, &offset);
        mesh_.draw(commands, draws);
    }

    // A render pass clears the maps of its views alone.
    void clear_maps(VkCommandBuffer commands) const {
        VkClearValue const clear = far_end();
        begin_pass(commands, pipelines_.depth_pass, maps_.layered, {maps_.size, maps_.size}, {&clear, 1},
                   pipelines_.per_map.get(true));
        vkCmdEndRenderPass(commands);
    }

    struct MapTarget {
        VkRenderPass render_pass;
        VkFramebuffer framebuffer;
        DepthPipelines const& pipelines;
        std::size_t block_offset;
    };

    MapTarget target_of(DrawWay way, MapSet maps) {
        auto const first = static_cast<std::size_t>(std::countr_zero(maps));
        switch (way) {
            case DrawWay::geometry_clones:
                return {pipelines_.depth_pass, maps_.layered, pipelines_.clones, Constants::offset_of_maps(0)};
            case DrawWay::instances:
                return {pipelines_.depth_pass, maps_.layered, pipelines_.instances, Constants::offset_of_maps(0)};
            case DrawWay::multiview: {
                std::size_t const block = first / views_at_once_;
                ViewsPass const& views = pipelines_.views(maps >> block * views_at_once_);
                Framebuffer& framebuffer = maps_.of_views[maps];
                if (framebuffer == VK_NULL_HANDLE)
                    framebuffer = make_framebuffer(device_.get(), views.pass, {maps_.size, maps_.size},
                                                   {maps_.views[block].address(), 1});
                return {views.pass, framebuffer, views.pipelines, Constants::offset_of_maps(block)};
            }
            case DrawWay::pass_per_map: break;
        }
        // A lone layer serves every map in turn.
        std::size_t const layer = first % static_cast<std::size_t>(maps_.layers);
        return {pipelines_.depth_pass, maps_.framebuffer[layer], pipelines_.per_map, Constants::offset_of_map(first)};
    }

    // Clears its maps and draws them; with multiview they are clear.
    void draw_group(VkCommandBuffer commands, DepthPass const& pass, DrawGroup const& group) {
        VkClearValue const clear = far_end();
        MapTarget const to = target_of(pass.way, group.maps);
        if (pass.way == DrawWay::multiview) hand_over(commands, maps_.target, depth_drawn, depth_drawn);
        begin_pass(commands, to.render_pass, to.framebuffer, {maps_.size, maps_.size}, {&clear, 1},
                   to.pipelines.get(pass.depth_clamp));
        draw(commands, to.block_offset, group.draws);
        vkCmdEndRenderPass(commands);
    }

    void begin_view(VkCommandBuffer commands, glm::vec4 const& sky) const {
        std::array<VkClearValue, 4> clear{};
        clear[0].color = {{sky.r, sky.g, sky.b, sky.a}};
        clear[1].color = {{0.0f, 0.0f, 0.0f, -2.0f}};  // no point
        clear[2].color = {{0.0f, 0.0f, 0.0f, 1.0f}};   // no normal, lit
        clear[3] = far_end();
        hand_over_view(commands, fresh, colour_drawn);
        hand_over(commands, frame_.depth, fresh, depth_drawn);
        begin_pass(commands, pipelines_.receive_pass, frame_.framebuffer, frame_.extent, clear, pipelines_.receive);
    }

    void resume_view(VkCommandBuffer commands) const {
        hand_over_view(commands, colour_drawn, colour_drawn);
        hand_over(commands, frame_.depth, depth_drawn, depth_drawn);
        begin_pass(commands, pipelines_.receive_pass_resumed, frame_.framebuffer, frame_.extent, {},
                   pipelines_.receive);
    }

    void draw_view(VkCommandBuffer commands, ViewDraw const& view, std::size_t index) const {
        draw(commands, Constants::offset_of_frame(index), view.draws);
    }

    void finish_view(VkCommandBuffer commands) const { hand_over_view(commands, colour_drawn, copied_from); }

    void hand_over_view(VkCommandBuffer commands, Use from, Use to) const {
        for (Target const* target : {&frame_.colour, &frame_.position, &frame_.normal})
            hand_over(commands, *target, from, to);
    }

    template <class Record>
    [[nodiscard]] DrawWork timed(DrawWork work, Record const& record) const {
        work.milliseconds = commands_.timed([&](VkCommandBuffer commands) {
            statistics_.begin(commands);
            record(commands);
            statistics_.end(commands);
        });
        work.driver = statistics_.read(device_.get());
        return work;
    }

    VulkanMistake mistake_;
    Device device_;  // dies last of all that follows
    std::uint32_t views_at_once_;
    Pipelines pipelines_;
    Commands commands_;
    Compute compute_;
    Statistics statistics_;
    Buffer constants_;
    Mesh mesh_;
    Descriptors descriptors_;
    std::vector<Object> objects_;
    Maps maps_;
    FrameTargets frame_;
    EyeDepth eye_;
    std::optional<Storage> fit_state_, fitted_maps_;
    std::size_t state_bytes_ = 0;
};

}  // namespace

std::unique_ptr<Backend> make_vulkan_backend(VulkanOptions const& options) {
    return std::make_unique<VulkanBackend>(options);
}

}  // namespace shadowmath::backend
