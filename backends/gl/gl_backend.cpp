// SPDX-License-Identifier: MIT
#include "backends/gl/gl_backend.hpp"

#include "backends/constants.hpp"
#include "backends/gl/compute.hpp"
#include "backends/gl/objects.hpp"
#include "backends/gl/session.hpp"
#include "backends/gl/statistics.hpp"
#include "backends/gl/targets.hpp"
#include "backends/pass_check.hpp"
#include "backends/shaders/embedded.hpp"

#include <cstddef>
#include <optional>
#include <stdexcept>

namespace shadowmath::backend {
namespace {

using namespace gl;

// All that belongs to the context and dies before it.
struct Resources {
    explicit Resources(Procs const& gl)
        : vertices(make_buffer(gl)), indices(make_buffer(gl)), numbers(make_buffer(gl)), constants(make_buffer(gl)),
          draws(make_buffer(gl)), geometry(make_vertex_array(gl)), compute(gl),
          depth(make_program(gl, {{GL_VERTEX_SHADER, shaders::depth_vert}})),
          depth_clones(make_program(
              gl, {{GL_VERTEX_SHADER, shaders::depth_clones_vert}, {GL_GEOMETRY_SHADER, shaders::depth_clones_geom}})),
          receive(make_program(
              gl, {{GL_VERTEX_SHADER, shaders::receive_vert}, {GL_FRAGMENT_SHADER, shaders::receive_frag}})) {
        if (gl.has_extension("GL_ARB_shader_viewport_layer_array"))
            depth_instances = make_program(gl, {{GL_VERTEX_SHADER, shaders::depth_instances_vert}});
        if (gl.has_extension("GL_ARB_pipeline_statistics_query")) statistics.emplace(gl);
    }

    [[nodiscard]] GLuint depth_program(DrawWay way) const {
        return way == DrawWay::geometry_clones ? depth_clones : way == DrawWay::instances ? depth_instances : depth;
    }

    Buffer vertices, indices, numbers, constants, draws;
    VertexArray geometry;
    Compute compute;
    Program depth, depth_clones, depth_instances, receive;  // depth_instances: 0 where the driver has no such shaders
    std::optional<Statistics> statistics;

    Maps maps;
    FrameTargets frame;  // the last one
    EyeDepth eye;        // what the last fit looked at
    std::optional<Storage> fit_state, fitted_maps;
};

class GlBackend final : public Backend {
public:
    GlBackend(GlContextKind kind, GlShaders shaders) : session_(kind, shaders), gl_(&session_.procs()) {
        Current const current = session_.current();
        resources_.emplace(*gl_);
        describe_vertices();
        prepare_maps(1, 1);  // the receiver's sampler always has a texture
        gl_->Enable(GL_DEPTH_TEST);
        gl_->DepthFunc(GL_LESS);
        gl_->Enable(GL_FRAMEBUFFER_SRGB);
        gl_->ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
        gl_->ProvokingVertex(GL_FIRST_VERTEX_CONVENTION);  // as in Vulkan: rasterisers start their sums from it
    }

    ~GlBackend() override {
        Current const current = session_.current();
        resources_.reset();
    }

    BackendInfo info() const override { return session_.info(takes_spirv(*gl_, shaders::depth_vert)); }

    std::vector<DrawWay> ways() const override {
        std::vector<DrawWay> ways{DrawWay::pass_per_map, DrawWay::geometry_clones};
        if (resources_->depth_instances != 0u) ways.push_back(DrawWay::instances);
        return ways;
    }

    void upload(Scene const& scene) override {
        demand_none(fault_of(scene));
        Current const current = session_.current();
        auto const fill = [this](GLuint buffer, auto const& items) {
            gl_->NamedBufferData(buffer, static_cast<GLsizeiptr>(items.size() * sizeof(items[0])), items.data(),
                                 GL_STATIC_DRAW);
        };
        fill(resources_->vertices, scene.vertices);
        fill(resources_->indices, scene.indices);
        objects_ = scene.objects;
    }

    DrawWork draw_depth(DepthPass const& pass) override {
        demand_none(fault_of(pass, objects_.size()));
        demand_none(fault_of(pass.way, ways()));
        demand_none(fault_of_fitted(pass.fitted, resources_->fitted_maps.has_value()));
        Current const current = session_.current();
        prepare_maps(pass.map_size, static_cast<int>(pass.layers.size()));

        std::vector<DrawGroup> const groups = plan_draws(pass, objects_);
        Constants constants;
        constants.set(pass.layers);
        return timed(work_of(pass.way, groups), [&] {
            write_constants(constants);
            if (pass.fitted) take_fitted(Constants::copies_of_maps(pass.layers.size()));
            for (DrawGroup const& group : groups) draw_group(pass, group);
        });
    }

    DrawWork draw_scene(ScenePass const& pass) override {
        demand_none(fault_of(pass, resources_->maps.layers));
        demand_none(fault_of_fitted(pass.fitted, resources_->fitted_maps.has_value()));
        Current const current = session_.current();
        prepare_frame(pass.extent);

        std::vector<ViewDraw> const views = plan_view(pass, objects_);
        Constants constants;
        constants.set(views);
        return timed(work_of(views), [&] {
            write_constants(constants);
            if (pass.fitted) take_fitted(Constants::copies_of_frames(views.size()));
            clear_frame(pass.frame.sky);
            begin_view();
            for (std::size_t i = 0; i < views.size(); ++i) draw_view(views[i], i);
        });
    }

    DrawWork draw_split_by_split(DepthPass const& pass, ScenePass const& view) override {
        demand_none(fault_of(pass, view, objects_.size()));
        DepthPass maps = pass;
        maps.way = DrawWay::pass_per_map;
        Current const current = session_.current();
        prepare_maps(maps.map_size, 1);
        prepare_frame(view.extent);

        SplitPlan const plan = plan_split_by_split(maps, view, objects_);
        Constants constants;
        constants.set(maps.layers);
        constants.set(plan.views);
        return timed(work_of(plan), [&] {
            write_constants(constants);
            clear_frame(view.frame.sky);
            for (std::size_t i = 0; i < plan.views.size(); ++i) {
                if (i < plan.maps.size()) {
                    draw_group(maps, plan.maps[i]);
                    begin_view();
                }
                draw_view(plan.views[i], i);
            }
        });
    }

    DrawWork fit_maps(FitPass const& pass) override {
        demand_none(fault_of(pass));
        Current const current = session_.current();
        prepare_fit(pass);

        ViewDraw eye;
        for (Object const& object : objects_) append(eye.draws, object);
        DepthLayer const layer{pass.clip_from_world, {}};
        Constants constants;
        constants.set(std::span(&layer, 1));
        return timed(work_of(std::span(&eye, 1)), [&] {
            write_constants(constants);
            draw_eye_depth(pass.extent, eye.draws);
            gl_->BindTextureUnit(3, resources_->eye.texture);
            for (ComputeStep const& step : pass.steps)
                resources_->compute.run(
                    {step.shader, step.groups, {*resources_->fit_state, *resources_->fitted_maps}, {}, pass.constants});
        });
    }

    Image<float> read_depth(int layer) override {
        Maps const& maps = resources_->maps;
        if (layer < 0 || layer >= maps.layers)
            throw std::runtime_error("read_depth: layer " + std::to_string(layer) + " of " +
                                     std::to_string(maps.layers));
        Current const current = session_.current();
        Image<float> image(Extent{maps.size, maps.size});
        gl_->GetTextureSubImage(maps.texture, 0, 0, 0, layer, maps.size, maps.size, 1, GL_DEPTH_COMPONENT, GL_FLOAT,
                                byte_count(image), image.pixels.data());
        return image;
    }

    Frame read_frame() override {
        Current const current = session_.current();
        FrameTargets const& drawn = resources_->frame;
        Frame frame{Image<Rgba8>(drawn.extent), Image<Texel4>(drawn.extent), Image<Texel4>(drawn.extent)};
        if (frame.colour.pixels.empty()) return frame;
        auto const read = [this](GLuint texture, GLenum type, auto& image) {
            gl_->GetTextureImage(texture, 0, GL_RGBA, type, byte_count(image), image.pixels.data());
        };
        read(drawn.colour, GL_UNSIGNED_BYTE, frame.colour);
        read(drawn.position, GL_FLOAT, frame.position);
        read(drawn.normal, GL_FLOAT, frame.normal);
        return frame;
    }

    Image<float> read_eye_depth() override {
        Current const current = session_.current();
        Image<float> image(resources_->eye.extent);
        if (!image.pixels.empty())
            gl_->GetTextureImage(resources_->eye.texture, 0, GL_DEPTH_COMPONENT, GL_FLOAT, byte_count(image),
                                 image.pixels.data());
        return image;
    }

    std::vector<MapConstants> read_fit() override {
        demand_none(fault_of_fitted(true, resources_->fitted_maps.has_value()));
        Current const current = session_.current();
        std::vector<MapConstants> maps(max_maps);
        resources_->compute.read(*resources_->fitted_maps, std::as_writable_bytes(std::span(maps)));
        return maps;
    }

    std::vector<std::string> take_messages() override { return session_.take_messages(); }

private:
    template <class Pixel>
    static GLsizei byte_count(Image<Pixel> const& image) {
        return static_cast<GLsizei>(image.pixels.size() * sizeof(Pixel));
    }

    void describe_vertices() {
        GLuint const geometry = resources_->geometry;
        gl_->VertexArrayVertexBuffer(geometry, 0, resources_->vertices, 0, sizeof(Vertex));
        gl_->VertexArrayElementBuffer(geometry, resources_->indices);
        auto const attribute = [&](GLuint location, GLint size, GLenum type, GLboolean normalised, std::size_t offset) {
            gl_->EnableVertexArrayAttrib(geometry, location);
            gl_->VertexArrayAttribFormat(geometry, location, size, type, normalised, static_cast<GLuint>(offset));
            gl_->VertexArrayAttribBinding(geometry, location, 0);
        };
        attribute(0, 3, GL_FLOAT, GL_FALSE, offsetof(Vertex, position));
        attribute(1, 3, GL_FLOAT, GL_FALSE, offsetof(Vertex, normal));
        attribute(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, offsetof(Vertex, albedo));

        gl_->NamedBufferData(resources_->numbers, sizeof(instance_numbers), instance_numbers.data(), GL_STATIC_DRAW);
        gl_->VertexArrayVertexBuffer(geometry, 1, resources_->numbers, 0, sizeof(std::uint32_t));
        gl_->VertexArrayBindingDivisor(geometry, 1, 1);
        gl_->EnableVertexArrayAttrib(geometry, 3);
        gl_->VertexArrayAttribIFormat(geometry, 3, 1, GL_UNSIGNED_INT, 0);
        gl_->VertexArrayAttribBinding(geometry, 3, 1);
    }

    void prepare_maps(int size, int layers) {
        Maps& maps = resources_->maps;
        if (size == maps.size && layers == maps.layers) return;
        maps = {};  // the old ones need not find room beside the new
        maps = make_maps(*gl_, size, layers);
    }

    void prepare_frame(Extent extent) {
        FrameTargets& frame = resources_->frame;
        if (extent.width == frame.extent.width && extent.height == frame.extent.height) return;
        frame = {};
        frame = make_frame(*gl_, extent);
    }

    void prepare_fit(FitPass const& pass) {
        EyeDepth& eye = resources_->eye;
        if (pass.extent.width != eye.extent.width || pass.extent.height != eye.extent.height) {
            eye = {};
            eye = make_eye_depth(*gl_, pass.extent);
        }
        if (!resources_->fit_state || state_bytes_ != pass.state_bytes)
            resources_->fit_state = resources_->compute.make_storage(pass.state_bytes);
        state_bytes_ = pass.state_bytes;
        if (!resources_->fitted_maps && !pass.steps.empty())
            resources_->fitted_maps = resources_->compute.make_storage(max_maps * sizeof(MapConstants));
    }

    void draw_eye_depth(Extent extent, std::span<Draw const> draws) const {
        constexpr float nothing = 0.0f;
        begin(resources_->eye.framebuffer, extent, resources_->depth);
        bind_constants<MapBlock>(Constants::offset_of_map(0));
        gl_->ClearNamedFramebufferfv(resources_->eye.framebuffer, GL_DEPTH, 0, &nothing);
        gl_->DepthFunc(GL_GREATER);
        draw(draws);
        gl_->DepthFunc(GL_LESS);
    }

    void take_fitted(std::vector<BlockCopy> const& copies) const {
        GLuint const from = resources_->compute.buffer(*resources_->fitted_maps);
        for (BlockCopy const& copy : copies)
            gl_->CopyNamedBufferSubData(from, resources_->constants, static_cast<GLintptr>(copy.from),
                                        static_cast<GLintptr>(copy.to), static_cast<GLsizeiptr>(copy.size));
    }

    void write_constants(Constants const& constants) const {
        gl_->NamedBufferData(resources_->constants, sizeof(constants), &constants, GL_STREAM_DRAW);
    }

    template <class Block>
    void bind_constants(std::size_t offset) const {
        gl_->BindBufferRange(GL_UNIFORM_BUFFER, 0, resources_->constants, static_cast<GLintptr>(offset), sizeof(Block));
    }

    // One submission, however many ranges.
    void draw(std::span<Draw const> draws) const {
        if (draws.empty()) return;
        gl_->NamedBufferData(resources_->draws, static_cast<GLsizeiptr>(draws.size_bytes()), draws.data(),
                             GL_STREAM_DRAW);
        gl_->BindBuffer(GL_DRAW_INDIRECT_BUFFER, resources_->draws);
        gl_->MultiDrawElementsIndirect(GL_TRIANGLES, GL_UNSIGNED_INT, nullptr, static_cast<GLsizei>(draws.size()), 0);
    }

    // Clears its maps and draws them.
    void draw_group(DepthPass const& pass, DrawGroup const& group) const {
        bool const layered = pass.way != DrawWay::pass_per_map;
        auto const map = static_cast<std::size_t>(std::countr_zero(group.maps));
        Maps const& maps = resources_->maps;
        begin(maps.framebuffer, {maps.size, maps.size}, resources_->depth_program(pass.way));
        if (layered) {
            gl_->NamedFramebufferTexture(maps.framebuffer, GL_DEPTH_ATTACHMENT, maps.texture, 0);
            bind_constants<MapsBlock>(Constants::offset_of_maps(0));
        } else {
            int const layer = static_cast<int>(map) % maps.layers;  // a lone layer serves every map in turn
            gl_->NamedFramebufferTextureLayer(maps.framebuffer, GL_DEPTH_ATTACHMENT, maps.texture, 0, layer);
            bind_constants<MapBlock>(Constants::offset_of_map(map));
        }
        clear_depth(maps.framebuffer);
        if (pass.depth_clamp) gl_->Enable(GL_DEPTH_CLAMP);
        draw(group.draws);
        gl_->Disable(GL_DEPTH_CLAMP);
    }

    void begin_view() const {
        begin(resources_->frame.framebuffer, resources_->frame.extent, resources_->receive);
        gl_->BindTextureUnit(1, resources_->maps.texture);
    }

    void draw_view(ViewDraw const& view, std::size_t index) const {
        bind_constants<FrameBlock>(Constants::offset_of_frame(index));
        draw(view.draws);
    }

    void begin(GLuint framebuffer, Extent extent, GLuint program) const {
        gl_->BindFramebuffer(GL_FRAMEBUFFER, framebuffer);
        gl_->Viewport(0, 0, extent.width, extent.height);
        gl_->UseProgram(program);
        gl_->BindVertexArray(resources_->geometry);
    }

    void clear_depth(GLuint framebuffer) const {
        constexpr float far_end = 1.0f;
        gl_->ClearNamedFramebufferfv(framebuffer, GL_DEPTH, 0, &far_end);
    }

    void clear_frame(glm::vec4 const& sky) const {
        glm::vec4 const no_point{0.0f, 0.0f, 0.0f, -2.0f};
        glm::vec4 const no_normal_lit{0.0f, 0.0f, 0.0f, 1.0f};
        gl_->ClearNamedFramebufferfv(resources_->frame.framebuffer, GL_COLOR, 0, &sky.x);
        gl_->ClearNamedFramebufferfv(resources_->frame.framebuffer, GL_COLOR, 1, &no_point.x);
        gl_->ClearNamedFramebufferfv(resources_->frame.framebuffer, GL_COLOR, 2, &no_normal_lit.x);
        clear_depth(resources_->frame.framebuffer);
    }

    template <class Do>
    [[nodiscard]] DrawWork timed(DrawWork work, Do const& draw_all) const {
        if (resources_->statistics) resources_->statistics->begin();
        work.milliseconds = session_.milliseconds_of(draw_all);
        if (resources_->statistics) work.driver = resources_->statistics->end();
        return work;
    }

    Session session_;  // dies last of all that follows
    Procs const* gl_;
    std::optional<Resources> resources_;
    std::vector<Object> objects_;
    std::size_t state_bytes_ = 0;
};

}  // namespace

std::unique_ptr<Backend> make_gl_backend(GlContextKind kind, GlShaders shaders) {
    return std::make_unique<GlBackend>(kind, shaders);
}

}  // namespace shadowmath::backend
