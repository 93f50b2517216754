// SPDX-License-Identifier: MIT
#include "examples/doctor/case.hpp"
#include "examples/doctor/fields.hpp"

#include <glm/trigonometric.hpp>

#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

namespace shadowmath::doctor {
namespace {

constexpr std::size_t most_maps = 16;
constexpr std::size_t most_boxes = 100000;

ClipSpace clip_of(Fields& fields) {
    constexpr std::array named{gl_clip, gl_zero_to_one_clip, vulkan_clip, d3d_clip, metal_clip, webgpu_clip};
    std::size_t const api = fields.word("clip", {"opengl", "opengl_zero_to_one", "vulkan", "d3d", "metal", "webgpu"});
    bool const is_reversed = fields.flag("reversed_depth", false);
    return is_reversed ? reversed(named[api]) : named[api];
}

// The pose of a matrix that may be left-handed, or turned by a mirror: which way is forward is the projection's to say.
Pose<double> pose_from(Fields const& fields, glm::dmat4 const& view_from_world, bool looks_along_plus_z) {
    glm::dmat3 const turn(view_from_world);
    glm::dmat3 const world_from_view = glm::transpose(turn);
    Pose<double> pose;
    pose.right = world_from_view[0];
    pose.up = world_from_view[1];
    pose.forward = world_from_view[2] * (looks_along_plus_z ? 1.0 : -1.0);
    pose.position = -(world_from_view * glm::dvec3(view_from_world[3]));
    ViewVolume<double> probe;
    probe.pose = pose;
    if (faults_of(probe).any())
        fields.complaints().refuse(fields.line(),
                                   fields.name("view_from_world") +
                                       ": expected a rotation and a translation; are \"matrices\" stated rightly?");
    return orthonormalized(pose);
}

ViewVolume<double> camera_of(Node const& node, std::string const& path, Complaints& complaints, double aspect,
                             bool column_major) {
    Fields fields(node, path, complaints);
    double const z_near = fields.number("near", 1e-6, largest_number);
    double const z_far = fields.number("far", 1e-6, largest_number);
    if (!(z_near < z_far)) complaints.refuse(node.line, path + ": expected near < far");
    ViewVolume<double> view;
    if (node.find("view_from_world") != nullptr || node.find("clip_from_view") != nullptr) {
        glm::dmat4 const view_from_world = fields.matrix("view_from_world", column_major);
        glm::dmat4 const clip_from_view = fields.matrix("clip_from_view", column_major);
        // w is the depth: where it grows with z the camera looks along +z. An orthographic one shows it in its z row.
        double const along = clip_from_view[2][3] != 0.0 ? clip_from_view[2][3] : -1.0;
        view = view_from_projection(pose_from(fields, view_from_world, along > 0.0), clip_from_view, z_near, z_far);
    } else {
        glm::dvec3 const position = fields.vector("position");
        glm::dvec3 const forward = fields.vector("forward");
        glm::dvec3 const up = fields.vector("up", glm::dvec3(0.0, 1.0, 0.0));
        if (!safe_normalize(forward).ok)
            complaints.refuse(node.find("forward")->line, path + ".forward: expected a direction, found zeros");
        double const fov_y = fields.number("fov_y_degrees", 0.1, 179.0);
        view = perspective_view(pose_looking(position, forward, up), glm::radians(fov_y), aspect, z_near, z_far);
    }
    if (faults_of(view).any())
        complaints.refuse(node.line, path + ": no camera can be read from it: " + describe(faults_of(view)));
    fields.done();
    return view;
}

Light<double> light_of(Node const& node, std::string const& path, Complaints& complaints, bool& all_around) {
    Fields fields(node, path, complaints);
    std::size_t const kind = fields.word("kind", {"directional", "spot", "point"});
    all_around = kind == 2;
    Light<double> light;
    if (kind == 0) {
        light = directional(fields.vector("travel"));
    } else {
        glm::dvec3 const position = fields.vector("position");
        double const range = fields.number("range", 1e-6, largest_number);
        glm::dvec3 const axis = all_around ? glm::dvec3(0.0, -1.0, 0.0) : fields.vector("axis");
        double const angle = all_around ? 60.0 : fields.number("half_angle_degrees", 0.1, 85.0);
        light = spot(position, axis, glm::radians(angle), range);
    }
    if (unusable(light)) complaints.refuse(node.line, path + ": expected a direction that is not zero");
    fields.done();
    return light;
}

EngineMap map_of(Node const& node, std::string const& path, Complaints& complaints, bool column_major) {
    Fields fields(node, path, complaints);
    EngineMap map;
    map.name = fields.text("name", path);
    map.size = fields.whole("size", 4, 1 << 17);
    if (node.find("light_from_world") != nullptr || node.find("clip_from_light") != nullptr)
        map.clip_from_world =
            fields.matrix("clip_from_light", column_major) * fields.matrix("light_from_world", column_major);
    else
        map.clip_from_world = fields.matrix("clip_from_world", column_major);
    Node const* const matrix = node.find("clip_from_world");
    map.line = matrix != nullptr ? matrix->line : node.line;
    if (node.find("range") != nullptr) {
        std::vector<double> const ends = fields.numbers("range", 2);
        if (!(ends[0] >= 0.0 && ends[0] < ends[1]))
            complaints.refuse(node.find("range")->line, path + ".range: expected two eye depths, the nearer one first");
        map.range = SliceRange<double>{ends[0], ends[1], ends[1]};
    }
    fields.done();
    return map;
}

std::vector<EngineMap> maps_of(Node const& list, std::string const& path, Complaints& complaints, bool column_major) {
    if (list.kind != Json::array || list.items.empty() || list.items.size() > most_maps)
        complaints.refuse(list.line, path + ": expected a list of 1 to " + std::to_string(most_maps) + " maps");
    std::vector<EngineMap> maps;
    for (Node const& node : list.items)
        maps.push_back(map_of(node, path + "[" + std::to_string(maps.size()) + "]", complaints, column_major));
    for (std::size_t i = 0; i < maps.size(); ++i)
        if (maps[i].range.has_value() != maps[0].range.has_value())
            complaints.refuse(list.items[i].line, path + ": expected a range in all maps or in none");
    return maps;
}

void read_scene(Node const& node, std::filesystem::path const& folder, Complaints& complaints, Case& made) {
    Fields fields(node, "scene", complaints);
    if (Node const* const obj = fields.optional("obj")) {
        if (obj->kind != Json::string || obj->text.empty())
            complaints.refuse(obj->line, "scene.obj: expected the name of an OBJ file");
        made.obj = folder / obj->text;
    }
    if (Node const* const boxes = fields.optional("boxes")) {
        if (boxes->kind != Json::array || boxes->items.size() > most_boxes)
            complaints.refuse(boxes->line,
                              "scene.boxes: expected a list of at most " + std::to_string(most_boxes) + " boxes");
        for (Node const& item : boxes->items) {
            std::string const path = "scene.boxes[" + std::to_string(made.boxes.size()) + "]";
            Fields box(item, path, complaints);
            SceneBox read{{box.vector("lo"), box.vector("hi")}, box.flag("casts", true)};
            if (is_empty(read.box)) complaints.refuse(item.line, path + ": expected lo <= hi on every axis");
            made.boxes.push_back(read);
            box.done();
        }
    }
    fields.done();
}

Frame frame_of(Fields& fields, std::string const& prefix, Complaints& complaints, double aspect, bool column_major,
               std::optional<Light<double>> const& light, bool& all_around) {
    Frame frame;
    frame.camera =
        camera_of(fields.required("camera", "an object"), prefix + "camera", complaints, aspect, column_major);
    if (light && fields.optional("light") == nullptr)
        frame.light = *light;
    else
        frame.light = light_of(fields.required("light", "an object"), prefix + "light", complaints, all_around);
    frame.maps = maps_of(fields.required("maps", "a list of maps"), prefix + "maps", complaints, column_major);
    return frame;
}

}  // namespace

Case case_from(std::string const& text, std::string const& file, std::filesystem::path const& folder) {
    Node const root = parse_json(text, file);
    Complaints complaints{file, {}};
    Fields fields(root, "", complaints);
    Case made;
    made.about = fields.text("about", "");
    made.clip = clip_of(fields);
    bool const column_major = fields.word("matrices", {"column_major", "row_major"}) == 0;
    made.depth_format = static_cast<DepthFormat>(fields.word("depth_format", {"float32", "unorm24", "unorm16"}, 0));
    made.depth_clamp = fields.flag("depth_clamp", false);
    made.filter_radius = fields.whole("filter_radius", 0, 64, 1);
    std::vector<double> const picture = fields.numbers("picture", 2);
    for (double const side : picture)
        if (!(side >= 1.0 && side <= 65536.0 && side == std::floor(side)))
            complaints.refuse(root.find("picture")->line, "picture: expected width and height in pixels");
    made.picture = {static_cast<int>(picture[0]), static_cast<int>(picture[1])};
    double const aspect = picture[0] / picture[1];
    made.frame = frame_of(fields, "", complaints, aspect, column_major, {}, made.all_around);
    bool const ranged = made.frame.maps[0].range.has_value();
    made.choice =
        fields.word("choice", {"by_depth", "first"}, ranged ? 0 : 1) == 0 ? Selection::by_depth : Selection::first;
    if (made.choice == Selection::by_depth && !ranged)
        complaints.refuse(root.find("choice")->line, "choice: \"by_depth\" needs a range in every map");
    double const last_end = ranged ? made.frame.maps.back().range->end : made.frame.camera.z_far;
    made.shadow_distance = fields.number("shadow_distance", 1e-6, largest_number, last_end);
    if (Node const* const node = fields.optional("bias")) {
        Fields bias(*node, "bias", complaints);
        made.bias = {true, bias.number("depth", 0.0, 1.0, 0.0), bias.number("slope", 0.0, 1e6, 0.0),
                     bias.number("normal_texels", 0.0, 1e6, 0.0)};
        bias.done();
    }
    if (Node const* const node = fields.optional("scene")) read_scene(*node, folder, complaints, made);
    if (Node const* const node = fields.optional("next_frame")) {
        Fields next(*node, "next_frame", complaints);
        bool ignored = false;
        made.next = frame_of(next, "next_frame.", complaints, aspect, column_major, made.frame.light, ignored);
        if (made.next->maps.size() != made.frame.maps.size())
            complaints.refuse(node->line, "next_frame.maps: expected as many maps as in the first frame");
        next.done();
    }
    fields.done();
    made.unknown_keys = complaints.unknown_keys;
    return made;
}

Case read_case(std::filesystem::path const& file) {
    std::ifstream stream(file, std::ios::binary);
    std::error_code ignored;
    if (!stream || std::filesystem::is_directory(file, ignored))
        throw std::runtime_error(file.string() + ": cannot be read");
    std::string text(largest_file + 1, '\0');
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(stream.gcount()));
    return case_from(text, file.string(), file.parent_path());
}

}  // namespace shadowmath::doctor
