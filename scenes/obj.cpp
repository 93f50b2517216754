// SPDX-License-Identifier: MIT
#include "scenes/obj.hpp"

#include "scenes/mesh_builder.hpp"
#include "scenes/sun.hpp"

#include <tiny_obj_loader.h>
#include <glm/common.hpp>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <limits>
#include <map>
#include <numeric>
#include <span>
#include <sstream>
#include <stdexcept>
#include <tuple>

namespace shadowmath::scenes {

namespace {

constexpr double model_height = 2.0;
constexpr double crease_cosine = 0.642787609686539;  // 50 degrees
constexpr std::size_t triangles_per_object = 3000;

struct Corner {
    std::size_t position;
    std::ptrdiff_t normal;  // -1: the file gives none
};
using Face = std::array<Corner, 3>;

struct Mesh {
    std::vector<glm::dvec3> positions;
    std::vector<glm::dvec3> normals;
    std::vector<Face> faces;
    std::string fault;  // the first thing found wrong
};

bool finite(glm::dvec3 v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

// tinyobjloader reads what is no number as 0; here it is a fault.
bool starts_with_three_numbers(std::string_view text) {
    for (int k = 0; k < 3; ++k) {
        std::size_t const begin = text.find_first_not_of(" \t+");
        if (begin == std::string_view::npos) return false;
        text.remove_prefix(begin);
        double value = 0.0;
        auto const [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
        if (error != std::errc{} || !std::isfinite(value)) return false;
        text.remove_prefix(static_cast<std::size_t>(end - text.data()));
        if (!text.empty() && text.front() != ' ' && text.front() != '\t') return false;
    }
    return true;
}

// Only the statements that make geometry reach the library: others can ask it for any amount of memory.
std::string geometry_statements(std::istream& text, Mesh& mesh) {
    std::string kept;
    std::string line;
    for (std::size_t number = 1; std::getline(text, line); ++number) {
        while (!line.empty() && (line.back() == '\r' || line.back() == ' ' || line.back() == '\t')) line.pop_back();
        std::size_t const begin = std::min(line.find_first_not_of(" \t"), line.size());
        std::string_view const statement = std::string_view(line).substr(begin);
        auto const is = [&](std::string_view word) {
            return statement.size() > word.size() && statement.starts_with(word) &&
                   (statement[word.size()] == ' ' || statement[word.size()] == '\t');
        };
        if (is("v") || is("vn")) {
            if (!starts_with_three_numbers(statement.substr(2))) {
                mesh.fault = "line " + std::to_string(number) + " does not hold three finite numbers";
                return {};
            }
        } else if (!is("f")) {
            continue;
        }
        kept.append(statement).push_back('\n');
    }
    return kept;
}

// OBJ counts from 1, or back from the newest with negative numbers. -1 when the index names nothing.
std::ptrdiff_t resolved(int index, std::size_t count) {
    auto const size = static_cast<std::ptrdiff_t>(count);
    std::ptrdiff_t const at = index > 0 ? index - 1 : index < 0 ? size + index : -1;
    return at < size ? std::max<std::ptrdiff_t>(at, -1) : -1;
}

void add_face(void* user, tinyobj::index_t* indices, int count) {
    Mesh& mesh = *static_cast<Mesh*>(user);
    if (!mesh.fault.empty()) return;
    if (count < 3) {
        mesh.fault = "a face has only " + std::to_string(count) + " corners";
        return;
    }
    std::vector<Corner> corners;
    for (tinyobj::index_t const& index : std::span(indices, static_cast<std::size_t>(count))) {
        std::ptrdiff_t const position = resolved(index.vertex_index, mesh.positions.size());
        if (position < 0) {
            mesh.fault = "a face names vertex " + std::to_string(index.vertex_index) + ", of " +
                         std::to_string(mesh.positions.size()) + " given before it";
            return;
        }
        corners.push_back({static_cast<std::size_t>(position), resolved(index.normal_index, mesh.normals.size())});
    }
    for (std::size_t k = 2; k < corners.size(); ++k) mesh.faces.push_back({corners[0], corners[k - 1], corners[k]});
}

Mesh parse(std::istream& text) {
    Mesh mesh;
    std::istringstream statements(geometry_statements(text, mesh));
    if (!mesh.fault.empty()) return mesh;
    auto const add_position = [](void* user, float x, float y, float z, float) {
        Mesh& m = *static_cast<Mesh*>(user);
        m.positions.push_back(glm::dvec3(glm::vec3(x, y, z)));
        if (!finite(m.positions.back()) && m.fault.empty()) m.fault = "a vertex is too large for a float";
    };
    auto const add_normal = [](void* user, float x, float y, float z) {
        static_cast<Mesh*>(user)->normals.push_back(glm::dvec3(glm::vec3(x, y, z)));
    };
    tinyobj::callback_t callbacks;
    callbacks.vertex_cb = add_position;
    callbacks.normal_cb = add_normal;
    callbacks.index_cb = add_face;
    std::string error;
    bool const read = tinyobj::LoadObjWithCallback(statements, callbacks, &mesh, nullptr, nullptr, &error);
    if (!read && mesh.fault.empty()) mesh.fault = "tinyobjloader: " + error.substr(0, error.find('\n'));
    if (mesh.fault.empty() && mesh.faces.empty()) mesh.fault = "holds no triangle";
    return mesh;
}

// Scales and moves the mesh to stand on y = 0 over the origin. Returns the half width of its footprint.
double stand_up(Mesh& mesh) {
    glm::dvec3 lo{std::numeric_limits<double>::max()};
    glm::dvec3 hi{std::numeric_limits<double>::lowest()};
    for (Face const& face : mesh.faces)
        for (Corner const& corner : face) {
            lo = glm::min(lo, mesh.positions[corner.position]);
            hi = glm::max(hi, mesh.positions[corner.position]);
        }
    glm::dvec3 const size = hi - lo;
    double const widest = std::max(size.x, size.z);
    double const reach = std::max(size.y, widest / 2.5);  // what is flat and wide is judged by its width
    double const scale = reach > 0.0 ? model_height / reach : 1.0;
    glm::dvec3 const foot{0.5 * (lo.x + hi.x), lo.y, 0.5 * (lo.z + hi.z)};
    for (glm::dvec3& p : mesh.positions) p = (p - foot) * scale;
    return 0.5 * widest * scale;
}

// Each corner's normal: the file's, or the mean of the faces around that lie within the crease angle of its own face.
std::vector<std::array<glm::dvec3, 3>> corner_normals(Mesh const& mesh) {
    std::map<std::tuple<double, double, double>, std::vector<std::size_t>> faces_at;
    std::vector<glm::dvec3> areas;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) {
        std::array<glm::dvec3, 3> p;
        for (std::size_t c = 0; c < 3; ++c) {
            p[c] = mesh.positions[mesh.faces[f][c].position];
            faces_at[{p[c].x, p[c].y, p[c].z}].push_back(f);
        }
        areas.push_back(glm::cross(p[1] - p[0], p[2] - p[0]));
    }
    std::vector<std::array<glm::dvec3, 3>> normals(mesh.faces.size());
    for (std::size_t f = 0; f < mesh.faces.size(); ++f)
        for (std::size_t c = 0; c < 3; ++c) {
            Corner const& corner = mesh.faces[f][c];
            glm::dvec3& normal = normals[f][c];
            if (corner.normal >= 0) normal = mesh.normals[static_cast<std::size_t>(corner.normal)];
            if (finite(normal) && glm::dot(normal, areas[f]) > 0.0) continue;
            glm::dvec3 const p = mesh.positions[corner.position];
            normal = glm::dvec3(0.0);
            for (std::size_t const g : faces_at[{p.x, p.y, p.z}])
                if (glm::dot(areas[f], areas[g]) >= crease_cosine * glm::length(areas[f]) * glm::length(areas[g]))
                    normal += areas[g];
        }
    return normals;
}

// Halves the faces along their widest axis until each part is a culling unit.
template <class AddPart>
void in_parts(std::span<std::size_t> faces, std::vector<glm::dvec3> const& centres, AddPart const& add) {
    if (faces.size() <= triangles_per_object) return add(faces);
    glm::dvec3 lo{std::numeric_limits<double>::max()};
    glm::dvec3 hi{std::numeric_limits<double>::lowest()};
    for (std::size_t const f : faces) {
        lo = glm::min(lo, centres[f]);
        hi = glm::max(hi, centres[f]);
    }
    glm::dvec3 const size = hi - lo;
    int const axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    std::size_t const half = faces.size() / 2;
    std::ranges::nth_element(faces, faces.begin() + static_cast<std::ptrdiff_t>(half), {},
                             [&](std::size_t f) { return std::pair(centres[f][axis], f); });
    in_parts(faces.first(half), centres, add);
    in_parts(faces.subspan(half), centres, add);
}

void add_model(MeshBuilder& builder, Mesh const& mesh) {
    auto const normals = corner_normals(mesh);
    auto const at = [&](std::size_t f, std::size_t c) { return mesh.positions[mesh.faces[f][c].position]; };
    std::vector<glm::dvec3> centres;
    for (std::size_t f = 0; f < mesh.faces.size(); ++f) centres.push_back((at(f, 0) + at(f, 1) + at(f, 2)) / 3.0);
    std::vector<std::size_t> order(mesh.faces.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    builder.colour = srgb(0xC9825C);
    in_parts(order, centres, [&](std::span<std::size_t const> faces) {
        for (std::size_t const f : faces) builder.triangle({at(f, 0), at(f, 1), at(f, 2)}, normals[f]);
        builder.end_object();
    });
}

// The slab, in squares of two tones, and the props. The model sinks into it by a hair.
void add_stage(MeshBuilder& builder, double half_width) {
    double const half = 6.0 * std::max(model_height, 2.0 * half_width);
    int const squares = 16;
    double const cell = 2.0 * half / squares;
    builder.colour = srgb(0xA59A88);
    builder.box({-half, -0.5, -half}, {half, -0.02, half});
    builder.end_object();
    for (int j = 0; j < squares; ++j)
        for (int i = 0; i < squares; ++i) {
            builder.colour = (i + j) % 2 == 0 ? srgb(0xD9D0BE) : srgb(0xC4BBA8);
            glm::dvec3 const corner{-half + cell * i, -0.1, -half + cell * j};
            builder.box(corner + glm::dvec3(0.01, 0.0, 0.01), corner + glm::dvec3(cell - 0.01, 0.102, cell - 0.01));
            if (i == squares - 1 && j % 4 == 3) builder.end_object();
        }
    double const out = half_width + 0.9;
    builder.frame = standing_at({out, 0.0, -0.5 * out}, 0.3);
    builder.colour = srgb(0x4F6D7A);
    builder.lathe({{0.16, -0.05}, {0.16, 0.08}, {0.05, 0.14}, {0.05, 2.5}, {0.09, 2.55}, {0.0, 2.68}}, circle(20));
    builder.beam({-0.6, 2.2, 0.0}, {0.6, 2.2, 0.0}, 0.03, 0.03);
    builder.end_object();
    builder.frame = standing_at({-out, 0.0, 0.45 * out}, 0.5);
    builder.colour = srgb(0xB9944F);
    builder.box({-0.35, -0.05, -0.35}, {0.35, 0.7, 0.35});
    builder.end_object();
    builder.frame = {};
}

std::vector<View> views_around(double half_width) {
    double const d = std::max(model_height, 1.7 * half_width);  // the model's size, as a camera feels it
    glm::dvec3 const middle{0.0, 0.45 * model_height, 0.0};
    View spot = view_toward("spot", {-1.5 * d, 1.1 * d, 2.0 * d}, middle, 48.0, 12.0 * d, sun_travel(45.0, 60.0));
    spot.has_spot = true;
    spot.spot_position = {1.9 * d, 2.0 * d, 1.3 * d};
    spot.spot_axis = glm::normalize(middle - spot.spot_position);
    spot.spot_half_angle_radians = 0.50;
    spot.spot_range = 10.0 * d;
    return {
        view_toward("front", {0.8 * d, 0.9 * d, 2.3 * d}, middle, 46.0, 12.0 * d, sun_travel(35.0, 150.0)),
        view_toward("close", {-0.55 * d, 0.75 * d, 1.25 * d}, middle, 50.0, 8.0 * d, sun_travel(60.0, 20.0)),
        view_toward("above", {0.9 * d, 2.9 * d, 1.5 * d}, {0.0, 0.2, 0.0}, 46.0, 12.0 * d, sun_travel(80.0, 200.0)),
        view_toward("low_sun", {2.2 * d, 0.6 * d, 1.2 * d}, middle, 46.0, 14.0 * d, sun_travel(12.0, 220.0)),
        view_toward("side", {-2.2 * d, 0.7 * d, -1.3 * d}, middle, 46.0, 14.0 * d, sun_travel(20.0, 300.0)),
        spot,
    };
}

Mesh sound_mesh(std::istream& text, std::string const& name) {
    Mesh mesh = parse(text);
    if (!mesh.fault.empty()) throw std::runtime_error(name + ": " + mesh.fault);
    return mesh;
}

MeshBuilder built(Mesh const& mesh, std::string const& name) {
    MeshBuilder builder;
    add_model(builder, mesh);
    if (builder.triangle_count() == 0) throw std::runtime_error(name + ": holds no triangle with an area");
    return builder;
}

std::string scene_name(std::string const& file) {
    std::string stem = std::filesystem::path(file).stem().string();
    for (char& c : stem)
        if (std::string_view(" \t/\\:*?\"<>|'&;").find(c) != std::string_view::npos) c = '_';
    return stem.empty() ? "model" : stem;
}

std::ifstream opened(std::filesystem::path const& file) {
    std::ifstream text(file, std::ios::binary);
    std::error_code ignored;
    if (!text || std::filesystem::is_directory(file, ignored))
        throw std::runtime_error(file.string() + ": cannot be read");
    return text;
}

}  // namespace

NamedScene read_obj(std::istream& text, std::string const& name) {
    Mesh mesh = sound_mesh(text, name);
    double const half_width = stand_up(mesh);
    MeshBuilder builder = built(mesh, name);
    add_stage(builder, half_width);
    return {builder.finish(scene_name(name)), views_around(half_width)};
}

NamedScene load_obj(std::filesystem::path const& file) {
    std::ifstream text = opened(file);
    return read_obj(text, file.string());
}

backend::Scene load_obj_as_it_stands(std::filesystem::path const& file) {
    std::ifstream text = opened(file);
    return built(sound_mesh(text, file.string()), file.string()).finish(scene_name(file.string()));
}

}  // namespace shadowmath::scenes
