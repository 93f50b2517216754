// SPDX-License-Identifier: MIT
#include "backends/gl/gl_backend.hpp"

#include "backends/gl/context.hpp"
#include "backends/gl/listen.hpp"
#include "backends/gl/objects.hpp"
#include "backends/index_ranges.hpp"
#include "backends/pass_check.hpp"
#include "backends/shaders/embedded.hpp"

#include <chrono>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <utility>

namespace shadowmath::backend {
namespace {

using namespace gl;

// Uniform blocks lie at multiples of 256 bytes, the coarsest alignment that the specification lets a driver ask for.
struct alignas(256) MapBlock {
    glm::mat4 clip_from_world;
};
struct alignas(256) FrameBlock {
    FrameConstants frame;
};

void draw(Procs const& gl, IndexRanges const& ranges) {
    std::vector<GLsizei> counts;
    std::vector<void const*> offsets;
    for (IndexRange const& range : ranges) {
        counts.push_back(static_cast<GLsizei>(range.count));
        offsets.push_back(reinterpret_cast<void const*>(std::uintptr_t{range.first} * sizeof(std::uint32_t)));
    }
    if (!counts.empty())
        gl.MultiDrawElements(GL_TRIANGLES, counts.data(), GL_UNSIGNED_INT, offsets.data(),
                             static_cast<GLsizei>(counts.size()));
}

// All that belongs to the context and dies before it.
struct Resources {
    explicit Resources(Procs const& gl)
        : vertices(make_buffer(gl)), indices(make_buffer(gl)), constants(make_buffer(gl)),
          geometry(make_vertex_array(gl)), depth_program(make_program(gl, {{GL_VERTEX_SHADER, shaders::depth_vert}})),
          receive_program(make_program(
              gl, {{GL_VERTEX_SHADER, shaders::receive_vert}, {GL_FRAGMENT_SHADER, shaders::receive_frag}})) {}

    Buffer vertices, indices, constants;
    VertexArray geometry;
    Program depth_program, receive_program;

    Texture maps;  // an array, one layer a map
    Framebuffer map_target;
    Texture colour, position, normal, depth;  // the last frame
    Framebuffer frame_target;
};

class GlBackend final : public Backend {
public:
    GlBackend(std::unique_ptr<Context> context, GlShaders shaders) : context_(std::move(context)) {
        Current const current(*context_);
        gl_.emplace([this](char const* name) { return context_->proc(name); });
        if (shaders == GlShaders::text) gl_->SpecializeShader = nullptr;
        listen(*gl_, messages_);
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
        context_->make_current();
        resources_.reset();
        context_->release();
    }

    BackendInfo info() const override {
        Current const current(*context_);
        auto const text = [this](GLenum what) {
            return std::string(reinterpret_cast<char const*>(gl_->GetString(what)));
        };
        return {context_->name(), text(GL_RENDERER) + ", OpenGL " + text(GL_VERSION),
                takes_spirv(*gl_, shaders::depth_vert) ? "SPIR-V" : "GLSL"};
    }

    void upload(Scene const& scene) override {
        demand_none(fault_of(scene));
        Current const current(*context_);
        auto const fill = [this](GLuint buffer, auto const& items) {
            gl_->NamedBufferData(buffer, static_cast<GLsizeiptr>(items.size() * sizeof(items[0])), items.data(),
                                 GL_STATIC_DRAW);
        };
        fill(resources_->vertices, scene.vertices);
        fill(resources_->indices, scene.indices);
        objects_ = scene.objects;
    }

    double draw_depth(DepthPass const& pass) override {
        demand_none(fault_of(pass, objects_.size()));
        Current const current(*context_);
        auto const layer_count = static_cast<int>(pass.layers.size());
        prepare_maps(pass.map_size, layer_count);

        std::array<MapBlock, max_maps> blocks{};
        std::array<IndexRanges, max_maps> ranges;
        for (std::size_t i = 0; i < pass.layers.size(); ++i) {
            blocks[i].clip_from_world = pass.layers[i].clip_from_world;
            for (std::uint32_t const object : pass.layers[i].objects) append(ranges[i], objects_[object]);
        }

        return timed([&] {
            write_constants(blocks);
            begin(resources_->map_target, {pass.map_size, pass.map_size}, resources_->depth_program);
            if (pass.depth_clamp) gl_->Enable(GL_DEPTH_CLAMP);
            for (int i = 0; i < layer_count; ++i) {
                gl_->NamedFramebufferTextureLayer(resources_->map_target, GL_DEPTH_ATTACHMENT, resources_->maps, 0, i);
                clear_depth(resources_->map_target);
                bind_constants<MapBlock>(i);
                backend::draw(*gl_, ranges[static_cast<std::size_t>(i)]);
            }
            gl_->Disable(GL_DEPTH_CLAMP);
        });
    }

    // Objects that receive nothing are drawn by the same shader with no map to read.
    double draw_scene(ScenePass const& pass) override {
        demand_none(fault_of(pass, layers_));
        Current const current(*context_);
        prepare_frame(pass.extent);

        std::array<FrameBlock, 2> blocks{FrameBlock{pass.frame}, FrameBlock{pass.frame}};
        blocks[1].frame.map_count = 0;
        std::array<IndexRanges, 2> ranges;
        for (Object const& object : objects_) append(ranges[object.receives ? 0 : 1], object);

        return timed([&] {
            write_constants(blocks);
            begin(resources_->frame_target, pass.extent, resources_->receive_program);
            clear_frame(pass.frame.sky);
            gl_->BindTextureUnit(1, resources_->maps);
            for (int i = 0; i < 2; ++i) {
                bind_constants<FrameBlock>(i);
                backend::draw(*gl_, ranges[static_cast<std::size_t>(i)]);
            }
        });
    }

    Image<float> read_depth(int layer) override {
        if (layer < 0 || layer >= layers_)
            throw std::runtime_error("read_depth: layer " + std::to_string(layer) + " of " + std::to_string(layers_));
        Current const current(*context_);
        Image<float> image(Extent{map_size_, map_size_});
        gl_->GetTextureSubImage(resources_->maps, 0, 0, 0, layer, map_size_, map_size_, 1, GL_DEPTH_COMPONENT, GL_FLOAT,
                                byte_count(image), image.pixels.data());
        return image;
    }

    Frame read_frame() override {
        Current const current(*context_);
        Frame frame{Image<Rgba8>(extent_), Image<Texel4>(extent_), Image<Texel4>(extent_)};
        if (frame.colour.pixels.empty()) return frame;
        auto const read = [this](GLuint texture, GLenum type, auto& image) {
            gl_->GetTextureImage(texture, 0, GL_RGBA, type, byte_count(image), image.pixels.data());
        };
        read(resources_->colour, GL_UNSIGNED_BYTE, frame.colour);
        read(resources_->position, GL_FLOAT, frame.position);
        read(resources_->normal, GL_FLOAT, frame.normal);
        return frame;
    }

    std::vector<std::string> take_messages() override { return std::exchange(messages_, {}); }

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
    }

    void prepare_maps(int size, int layers) {
        if (size == map_size_ && layers == layers_) return;
        map_size_ = layers_ = 0;  // until the new ones are there
        resources_->maps = make_texture(*gl_, GL_TEXTURE_2D_ARRAY);
        gl_->TextureStorage3D(resources_->maps, 1, GL_DEPTH_COMPONENT32F, size, size, layers);
        gl_->TextureParameteri(resources_->maps, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
        gl_->TextureParameteri(resources_->maps, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
        resources_->map_target = make_framebuffer(*gl_);
        gl_->NamedFramebufferTextureLayer(resources_->map_target, GL_DEPTH_ATTACHMENT, resources_->maps, 0, 0);
        demand_complete(resources_->map_target, std::to_string(layers) + " shadow maps of " + std::to_string(size));
        map_size_ = size;
        layers_ = layers;
    }

    void prepare_frame(Extent extent) {
        if (extent.width == extent_.width && extent.height == extent_.height) return;
        extent_ = {};
        resources_->frame_target = make_framebuffer(*gl_);
        auto const attach = [&](Texture& texture, GLenum format, GLenum attachment) {
            texture = make_texture(*gl_, GL_TEXTURE_2D);
            gl_->TextureStorage2D(texture, 1, format, extent.width, extent.height);
            gl_->NamedFramebufferTexture(resources_->frame_target, attachment, texture, 0);
        };
        attach(resources_->colour, GL_SRGB8_ALPHA8, GL_COLOR_ATTACHMENT0);
        attach(resources_->position, GL_RGBA32F, GL_COLOR_ATTACHMENT1);
        attach(resources_->normal, GL_RGBA32F, GL_COLOR_ATTACHMENT2);
        attach(resources_->depth, GL_DEPTH_COMPONENT32F, GL_DEPTH_ATTACHMENT);
        constexpr std::array<GLenum, 3> outputs{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1, GL_COLOR_ATTACHMENT2};
        gl_->NamedFramebufferDrawBuffers(resources_->frame_target, 3, outputs.data());
        demand_complete(resources_->frame_target,
                        "a frame of " + std::to_string(extent.width) + " x " + std::to_string(extent.height));
        extent_ = extent;
    }

    void demand_complete(GLuint framebuffer, std::string const& what) const {
        if (gl_->CheckNamedFramebufferStatus(framebuffer, GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
            throw std::runtime_error("the driver cannot hold " + what);
    }

    template <class Blocks>
    void write_constants(Blocks const& blocks) const {
        gl_->NamedBufferData(resources_->constants, sizeof(blocks), blocks.data(), GL_STREAM_DRAW);
    }

    template <class Block>
    void bind_constants(int index) const {
        gl_->BindBufferRange(GL_UNIFORM_BUFFER, 0, resources_->constants, index * GLintptr{sizeof(Block)},
                             sizeof(Block));
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
        gl_->ClearNamedFramebufferfv(resources_->frame_target, GL_COLOR, 0, &sky.x);
        gl_->ClearNamedFramebufferfv(resources_->frame_target, GL_COLOR, 1, &no_point.x);
        gl_->ClearNamedFramebufferfv(resources_->frame_target, GL_COLOR, 2, &no_normal_lit.x);
        clear_depth(resources_->frame_target);
    }

    template <class Draw>
    double timed(Draw const& draw) const {
        gl_->Finish();
        auto const begun = std::chrono::steady_clock::now();
        draw();
        gl_->Finish();
        return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begun).count();
    }

    std::vector<std::string> messages_;
    std::unique_ptr<Context> context_;
    std::optional<Procs> gl_;
    std::optional<Resources> resources_;
    std::vector<Object> objects_;
    int map_size_ = 0;
    int layers_ = 0;
    Extent extent_;
};

}  // namespace

std::unique_ptr<Backend> make_gl_backend(GlContextKind kind, GlShaders shaders) {
    return std::make_unique<GlBackend>(kind == GlContextKind::egl ? make_egl_context() : make_osmesa_context(),
                                       shaders);
}

}  // namespace shadowmath::backend
