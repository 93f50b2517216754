// SPDX-License-Identifier: MIT
//
// What an engine says of one frame's shadow maps, as plain data: docs/doctor.md is the format of its file.
#pragma once

#include "backends/image.hpp"

#include <shadowmath/bounds.hpp>
#include <shadowmath/clip_space.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/slice.hpp>
#include <shadowmath/view_volume.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace shadowmath::doctor {

enum class Selection {
    by_depth,  // the first map whose range ends beyond the eye depth
    first      // the first map that holds the point
};

enum class DepthFormat { float32, unorm24, unorm16 };

struct EngineMap {
    std::string name;
    int line = 0;                             // of its matrix in the file
    int size = 0;                             // texels along a side
    glm::dmat4 clip_from_world{1.0};          // column vectors
    std::optional<SliceRange<double>> range;  // metres of eye depth
};

// What the shader, or the rasteriser, adds in favour of light.
struct EngineBias {
    bool given = false;
    double depth = 0.0;          // stored depth
    double slope = 0.0;          // times the depth that the receiver gains in a texel, on its steeper axis
    double normal_texels = 0.0;  // along the normal, times the sine of the angle to the light
};

struct Frame {
    ViewVolume<double> camera;
    Light<double> light;
    std::vector<EngineMap> maps;
};

struct SceneBox {
    Aabb<double> box;
    bool casts = true;
};

struct Case {
    std::string about;
    ClipSpace clip;
    DepthFormat depth_format = DepthFormat::float32;
    bool depth_clamp = false;
    int filter_radius = 1;
    Selection choice = Selection::first;
    EngineBias bias;
    double shadow_distance = 0.0;  // metres of eye depth
    backend::Extent picture;
    bool all_around = false;  // a lamp that shines in all directions, not in its cone alone
    Frame frame;
    std::optional<Frame> next;
    std::filesystem::path obj;
    std::vector<SceneBox> boxes;
    std::vector<std::string> unknown_keys;  // "FILE:LINE: what"
};

// Throws CaseError for what is no case, std::runtime_error "FILE: what" for what cannot be read.
[[nodiscard]] Case read_case(std::filesystem::path const& file);

// The same from text; `folder` is where the files that it names lie.
[[nodiscard]] Case case_from(std::string const& text, std::string const& file, std::filesystem::path const& folder);

}  // namespace shadowmath::doctor
