// SPDX-License-Identifier: MIT
//
// Wavefront OBJ files (through tinyobjloader), as a scene around one mesh: the model, 2 m high, on a ground slab twelve
// times its size, with a post and a box beside it so that shadows fall across; or alone, where its file puts it.
// Materials, textures, lines and points are ignored; polygons are cut into fans; missing normals are made, kept sharp
// where faces meet at more than 50 degrees.
#pragma once

#include "scenes/scenes.hpp"

#include <filesystem>
#include <istream>

namespace shadowmath::scenes {

// Throws std::runtime_error "FILE: what" when the file cannot be read, is malformed (a face that names no vertex, a
// number that is not one) or holds no triangle with an area. Never anything else, whatever the bytes.
[[nodiscard]] NamedScene load_obj(std::filesystem::path const& file);

// The same from a stream; name stands for the file in errors, its stem names the scene.
[[nodiscard]] NamedScene read_obj(std::istream& text, std::string const& name);

// The mesh alone, its coordinates as they stand in the file, in objects of at most 3000 triangles. Throws as load_obj.
[[nodiscard]] backend::Scene load_obj_as_it_stands(std::filesystem::path const& file);

}  // namespace shadowmath::scenes
