// SPDX-License-Identifier: MIT
//
// The small interface behind which a graphics API draws shadow maps and the receivers that read them.
//
// A backend knows matrices, nothing else: it never sees a split, a fit, a warp or a plane, and includes no
// shadowmath header. Whatever a technique is called, it arrives here as one clip_from_world a map.
//
// Convention of all backends: clip depth 0 (near) to 1 (far), NDC y = -1 is row 0 of the map and texture v = 0.
// In shadowmath that is ClipSpace shadowmath::gl_zero_to_one_clip.
//
// Backends throw std::runtime_error with one plain sentence when the driver cannot do what is asked.
#pragma once

#include "backends/image.hpp"
#include "backends/scene.hpp"
#include "backends/shaders/shader.hpp"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace shadowmath::backend {

inline constexpr int max_maps = 8;

// One shadow map to draw: a layer of the map array.
struct DepthLayer {
    glm::mat4 clip_from_world{1.0f};
    std::span<std::uint32_t const> objects;  // indices into Scene::objects: the casters, in any order
};

// How several maps are drawn. Every way gives the same maps, texel by texel, and draws an object into those alone that
// list it; they differ in what they cost. Where a driver rounds otherwise behind a geometry shader (llvmpipe does, in
// the viewport), clones agree but for that rounding, and wholly if map_size is a power of two.
enum class DrawWay {
    pass_per_map,     // one pass a map; every driver has it
    geometry_clones,  // one pass; a geometry shader clones each triangle into its maps
    instances,        // one pass; each map of an object is an instance, and the vertex shader names the layer
    multiview,        // Vulkan alone. Views belong to a pass: one for each set of maps that some object is listed in
};
inline constexpr std::array every_way{DrawWay::pass_per_map, DrawWay::geometry_clones, DrawWay::instances,
                                      DrawWay::multiview};

[[nodiscard]] constexpr char const* name_of(DrawWay way) {
    constexpr std::array names{"one pass a map", "geometry-shader clones", "instances", "multiview"};
    return names[static_cast<std::size_t>(way)];
}

struct DepthPass {
    int map_size = 1024;                 // texels along one side; all layers share it
    std::span<DepthLayer const> layers;  // 1 to max_maps
    bool depth_clamp = true;             // pancake casters outside [0, 1] in depth instead of clipping them
    DrawWay way = DrawWay::pass_per_map;
    bool fitted = false;  // the matrices are the last fit's, known to the device alone; the layers' are not read
};

enum class MapChoice : std::int32_t {
    by_depth = 0,  // the first map whose depth_end lies beyond the point's eye depth; outside it the point is lit
    by_map = 1,    // the first map that holds the point, filter margin included; none: lit
};

// What the receiver shader knows of one map. The layout is std140, where each begins at a multiple of sixteen bytes.
struct alignas(16) MapConstants {
    glm::mat4 clip_from_world{1.0f};  // the matrix that the layer was drawn with
    float depth_end = 0.0f;           // eye depth in metres where it stops to serve and the next begins (by_depth)
    float blend_begin = 0.0f;         // eye depth from which it blends into the next map; >= depth_end: no blending
    float w_min = 0.0f;               // clip w at or below this: the map does not hold the point
    float bias_constant = 0.0f;       // depth (of [0, 1]) subtracted from every receiver depth
    float bias_slope_texels = 0.0f;   // texels of the receiver plane's slope subtracted on top
    float slope_limit = 1.0f;         // largest change of depth a texel that the slope terms believe
    float bias_w = 0.0f;              // depth subtracted times 1 / clip w: a bias that is constant in clip z
};

// Everything that the receiver pass reads; one std140 uniform block.
struct FrameConstants {
    glm::mat4 clip_from_world{1.0f};               // the eye's
    glm::vec4 eye_position{0.0f};                  // world
    glm::vec4 eye_forward{0.0f};                   // unit, world; eye depth = dot(forward, p - position)
    glm::vec4 light{0.0f, 1.0f, 0.0f, 0.0f};       // (direction toward the light, 0) or (position, 1)
    glm::vec4 spot_axis{0.0f, 0.0f, 0.0f, -2.0f};  // unit axis of travel, cosine of the outer half angle; -2: no cone
    glm::vec4 ambient{0.30f, 0.34f, 0.42f, 0.0f};
    glm::vec4 light_colour{1.0f, 0.95f, 0.85f, 0.0f};
    glm::vec4 sky{0.62f, 0.74f, 0.88f, 1.0f};
    std::int32_t map_count = 0;  // 0: everything lit
    MapChoice choice = MapChoice::by_depth;
    std::int32_t filter_radius = 0;  // 0, 1, 2: 1, 3x3, 5x5 taps
    std::int32_t tap_plane = 1;      // 1: each tap is compared with the receiver plane's depth at that tap
    float map_size = 1.0f;           // texels
    float specular = 0.15f;
    float specular_power = 24.0f;
    // Split by split: the map that is there, alone and as layer 0, and what reads another is left out. map_count: what
    // reads none is drawn. -1: all maps are there.
    std::int32_t split = -1;
    std::array<MapConstants, max_maps> maps{};
};
static_assert(sizeof(MapConstants) == 96 && sizeof(FrameConstants) == 64 + 7 * 16 + 2 * 16 + max_maps * 96,
              "std140 layout of backends/shaders/receive.glsl");

struct ScenePass {
    Extent extent;
    FrameConstants frame;  // reads the maps of the last depth pass
    bool fitted = false;   // the constants of its maps are those of the last fit; the frame's are not read

    // For draw_split_by_split alone: the objects that each split shows, and last those beyond; empty: all, every time.
    std::span<std::span<std::uint32_t const> const> shown{};
};

// One compute pass of a fit.
struct ComputeStep {
    shaders::Shader const* shader = nullptr;
    glm::uvec3 groups{1u};
};

// Makes the constants of maps on the device: draws the depth that the eye sees, and runs compute shaders on it. Nothing
// returns: depth and scene passes that are `fitted` take matrices, ranges and biases from where the shaders put them.
//
//   binding 0   the uniform block      binding 2   MapConstants[max_maps], which the last step fills
//   binding 1   state_bytes of storage for the steps' own use
//   binding 3   the eye's depth: a sampler2DArray of one layer, reversed, cleared to 0
struct FitPass {
    Extent extent;                         // of the eye's depth
    glm::mat4 clip_from_world{1.0f};       // the eye's, reversed: depth 1 at the near end, 0 at the far one
    std::span<ComputeStep const> steps;    // each sees what those before it wrote; none: the depth is drawn, no more
    std::span<std::byte const> constants;  // the uniform block of all steps
    std::size_t state_bytes = 0;
};

struct Texel4 {
    float x = 0, y = 0, z = 0, w = 0;
};
struct Rgba8 {
    std::uint8_t r = 0, g = 0, b = 0, a = 255;
};

// What the receiver pass leaves, pixel by pixel.
struct Frame {
    Image<Rgba8> colour;     // shaded, sRGB-encoded
    Image<Texel4> position;  // world position; w: index of the map used, -1 none, -2 sky
    Image<Texel4> normal;    // geometric normal, unit, toward the eye; w: visibility of the light, 0 to 1
};

// What the driver counted. How it does so is its own affair; software drivers count as written here.
struct DriverCount {
    std::uint64_t vertices = 0;            // read by the input assembly
    std::uint64_t triangles = 0;           // assembled from them
    std::uint64_t vertex_runs = 0;         // of the vertex shader
    std::uint64_t geometry_runs = 0;       // of the geometry shader
    std::uint64_t geometry_triangles = 0;  // that it gave
    std::uint64_t clipper_triangles = 0;   // that reached the clipper: once for each map that they are drawn into
    std::uint64_t raster_triangles = 0;    // that the clipper gave
};

// What a pass handed to the driver, and what that cost.
struct DrawWork {
    double milliseconds = 0.0;          // until the driver has finished
    std::uint64_t passes = 0;           // times that it was given somewhere to draw to
    std::uint64_t draw_calls = 0;       // ranges of the index array
    std::uint64_t vertices = 0;         // indices in these ranges, times their instances
    std::uint64_t triangles = 0;        // each counted once for each map or picture that it is drawn into
    std::optional<DriverCount> driver;  // where the driver counts
};

struct BackendInfo {
    std::string name;             // "egl", "osmesa", "vulkan", "null"
    std::string driver;           // as the driver calls itself
    std::string shaders{"none"};  // the form in which it took them: "SPIR-V", "GLSL"
};

class Backend {
public:
    virtual ~Backend() = default;
    Backend() = default;
    Backend(Backend const&) = delete;
    Backend& operator=(Backend const&) = delete;

    [[nodiscard]] virtual BackendInfo info() const = 0;
    [[nodiscard]] virtual std::vector<DrawWay> ways() const = 0;  // that draw_depth takes here
    virtual void upload(Scene const& scene) = 0;
    virtual DrawWork draw_depth(DepthPass const& pass) = 0;
    virtual DrawWork draw_scene(ScenePass const& pass) = 0;

    // Both in turns, with memory for one map (Zhang, Sun, Nyman 2007, 10.3.1): each map is drawn over the last, and at
    // once the receivers between the depth_end of the map before and its own. It leaves the picture of draw_depth and
    // draw_scene, but for pixels that blend, for no second map is there; and the last map, as layer 0. The maps are
    // chosen by depth. The way of the pass is of no account.
    virtual DrawWork draw_split_by_split(DepthPass const& maps, ScenePass const& view) = 0;

    virtual DrawWork fit_maps(FitPass const& pass) = 0;  // the eye sees all objects

    [[nodiscard]] virtual Image<float> read_depth(int layer) = 0;
    [[nodiscard]] virtual Frame read_frame() = 0;

    // What the last fit looked at, and what it made: for fits on the CPU and for tests. To draw, nothing needs them.
    [[nodiscard]] virtual Image<float> read_eye_depth() = 0;
    [[nodiscard]] virtual std::vector<MapConstants> read_fit() = 0;

    // Warnings and errors that the driver reported since the last call, one line each; empty when all is well.
    [[nodiscard]] virtual std::vector<std::string> take_messages() = 0;
};

}  // namespace shadowmath::backend
