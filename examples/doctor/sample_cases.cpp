// SPDX-License-Identifier: MIT
#include "examples/doctor/sample_cases.hpp"

#include <shadowmath/cascades.hpp>
#include <shadowmath/fit_crop.hpp>

#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>

#include <array>
#include <cmath>
#include <sstream>
#include <vector>

namespace shadowmath::doctor {
namespace {

struct Box {
    glm::vec3 lo, hi;
};

// A yard: a wall, a shed, two rows of houses, a tower, posts along the way; behind the camera, a chimney.
std::vector<Box> yard() {
    std::vector<Box> boxes{{{-120.0f, -0.5f, -120.0f}, {120.0f, 0.0f, 120.0f}},
                           {{-3.2f, 0.0f, 8.0f}, {-2.9f, 1.4f, 13.0f}},
                           {{2.2f, 0.0f, 6.0f}, {5.0f, 2.4f, 9.5f}},
                           {{14.0f, 0.0f, -6.0f}, {20.0f, 30.0f, 0.0f}},
                           {{9.0f, 0.0f, 19.4f}, {10.5f, 28.0f, 20.9f}}};
    for (int i = 0; i < 4; ++i) {
        float const z = -4.0f - 14.0f * float(i);
        boxes.push_back({{-16.0f, 0.0f, z - 9.0f}, {-7.0f, 6.0f + float(i), z}});
        boxes.push_back({{8.0f, 0.0f, z - 19.0f}, {15.0f, 7.0f, z - 10.0f}});
    }
    for (int i = 0; i < 6; ++i) {
        float const z = 10.0f - 6.0f * float(i);
        boxes.push_back({{-1.6f, 0.0f, z}, {-1.5f, 1.1f, z + 0.1f}});
        boxes.push_back({{1.5f, 0.0f, z}, {1.6f, 1.1f, z + 0.1f}});
    }
    return boxes;
}

std::string yard_obj() {
    std::ostringstream text;
    text << "# A yard of boxes, in metres, y up.\n";
    int first = 1;
    for (Box const& box : yard()) {
        for (int i = 0; i < 8; ++i)
            text << "v " << (i & 1 ? box.hi.x : box.lo.x) << ' ' << (i & 2 ? box.hi.y : box.lo.y) << ' '
                 << (i & 4 ? box.hi.z : box.lo.z) << '\n';
        for (auto const& f :
             {std::array{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}})
            text << "f " << first + f[0] << ' ' << first + f[1] << ' ' << first + f[2] << ' ' << first + f[3] << '\n';
        first += 8;
    }
    return text.str();
}

// What an engine knows.
struct Camera {
    glm::vec3 position{0.4f, 1.7f, 16.0f};
    glm::vec3 forward = glm::normalize(glm::vec3(0.06f, -0.1f, -1.0f));
    float fov_y_degrees = 55.0f;
    float z_near = 0.1f;
    float z_far = 80.0f;
};

constexpr int width = 1920, height = 1080, map_size = 1024;
constexpr float aspect = 1920.0f / 1080.0f;
glm::vec3 const sun = glm::normalize(glm::vec3(-0.55f, -0.62f, -0.35f));
glm::vec3 const up(0.0f, 1.0f, 0.0f);

// A step ahead and a little to the side, with a glance to the right.
Camera stepped(Camera camera) {
    camera.position += glm::vec3(0.137f, 0.0f, -0.211f);
    camera.forward = glm::normalize(camera.forward + glm::vec3(0.021f, 0.003f, 0.0f));
    return camera;
}

struct Map {
    glm::mat4 clip_from_world;
    float begin, end;
    int size = map_size;
};

std::vector<float> splits_of(Camera const& camera) {
    std::vector<float> planes;
    for (int i = 0; i <= 4; ++i) {
        float const p = float(i) / 4.0f;
        planes.push_back(0.7f * camera.z_near * std::pow(camera.z_far / camera.z_near, p) +
                         0.3f * (camera.z_near + (camera.z_far - camera.z_near) * p));
    }
    planes.front() = camera.z_near;
    planes.back() = camera.z_far;
    return planes;
}

// The inverse of the view-projection, eight corners of the clip cube.
std::vector<glm::vec3> corners_of(Camera const& camera, float begin, float end) {
    glm::mat4 const view = glm::lookAtRH(camera.position, camera.position + camera.forward, up);
    glm::mat4 const inverse =
        glm::inverse(glm::perspectiveRH_ZO(glm::radians(camera.fov_y_degrees), aspect, begin, end) * view);
    std::vector<glm::vec3> corners;
    for (int i = 0; i < 8; ++i) {
        glm::vec4 const at = inverse * glm::vec4(i & 1 ? 1.0f : -1.0f, i & 2 ? 1.0f : -1.0f, i & 4 ? 1.0f : 0.0f, 1.0f);
        corners.push_back(glm::vec3(at) / at.w);
    }
    return corners;
}

glm::vec3 middle_of(std::vector<glm::vec3> const& corners) {
    glm::vec3 sum(0.0f);
    for (glm::vec3 const& corner : corners) sum += corner;
    return sum / float(corners.size());
}

struct BallOptions {
    bool snapped = true;
    float toward_light = 60.0f;  // metres that the near plane stands before the ball
    glm::vec3 travel = sun;
    bool gl_depth = false;
};

// The ball around the middle of the corners, as most engines have it.
Map ball_map(Camera const& camera, float begin, float end, BallOptions const& options) {
    std::vector<glm::vec3> const corners = corners_of(camera, begin, end);
    glm::vec3 const middle = middle_of(corners);
    float radius = 0.0f;
    for (glm::vec3 const& corner : corners) radius = std::max(radius, glm::length(corner - middle));
    // A kernel's room, and a radius that rounding does not change.
    radius = std::ceil(radius * 1.01f * 64.0f) / 64.0f;
    float const before = radius + options.toward_light;
    glm::mat4 const view = glm::lookAtRH(middle - options.travel * before, middle, up);
    glm::mat4 projection = options.gl_depth ? glm::orthoRH_NO(-radius, radius, -radius, radius, 0.0f, before + radius)
                                            : glm::orthoRH_ZO(-radius, radius, -radius, radius, 0.0f, before + radius);
    if (options.snapped) {
        glm::vec4 const origin = projection * view * glm::vec4(0.0f, 0.0f, 0.0f, 1.0f) * (map_size / 2.0f);
        projection[3].x += (std::round(origin.x) - origin.x) * (2.0f / map_size);
        projection[3].y += (std::round(origin.y) - origin.y) * (2.0f / map_size);
    }
    return {projection * view, begin, end};
}

std::vector<Map> ball_maps(Camera const& camera, BallOptions const& options) {
    std::vector<float> const planes = splits_of(camera);
    std::vector<Map> maps;
    for (std::size_t i = 0; i < 4; ++i) maps.push_back(ball_map(camera, planes[i], planes[i + 1], options));
    return maps;
}

// A box around the corners of each slice, its depth stretched tenfold for what casts into it: the tutorial's way.
std::vector<Map> tutorial_maps(Camera const& camera) {
    float const f = camera.z_far;
    std::vector<float> const planes{camera.z_near, f / 50.0f, f / 25.0f, f / 10.0f, f / 2.0f, f};
    std::vector<Map> maps;
    for (std::size_t i = 0; i + 1 < planes.size(); ++i) {
        std::vector<glm::vec3> const corners = corners_of(camera, planes[i], planes[i + 1]);
        glm::vec3 const middle = middle_of(corners);
        glm::mat4 const view = glm::lookAtRH(middle - sun, middle, up);
        glm::vec3 lo(1e30f), hi(-1e30f);
        for (glm::vec3 const& corner : corners) {
            glm::vec3 const at(view * glm::vec4(corner, 1.0f));
            lo = glm::min(lo, at);
            hi = glm::max(hi, at);
        }
        float const stretch = 10.0f;
        lo.z *= lo.z < 0.0f ? stretch : 1.0f / stretch;
        hi.z *= hi.z < 0.0f ? 1.0f / stretch : stretch;
        maps.push_back({glm::orthoRH_NO(lo.x, hi.x, lo.y, hi.y, -hi.z, -lo.z) * view, planes[i], planes[i + 1]});
    }
    return maps;
}

ViewVolume<float> view_of(Camera const& camera) {
    return perspective_view(pose_looking(camera.position, camera.forward, up), glm::radians(camera.fov_y_degrees),
                            aspect, camera.z_near, camera.z_far);
}

Aabb<float> yard_box() {
    Aabb<float> all;
    for (Box const& box : yard()) all = merge(all, Aabb<float>{box.lo, box.hi});
    return all;
}

std::vector<Map> library_maps(Camera const& camera) {
    CascadeOptions<float> options;
    options.map_size = map_size;
    options.lambda = 0.7f;
    options.clip = vulkan_clip;
    std::vector<Map> maps;
    for (auto const& cascade : fit_cascades(view_of(camera), directional(sun), yard_box(), yard_box(), options))
        maps.push_back({cascade.map.clip_from_world, cascade.range.begin, cascade.range.end});
    return maps;
}

struct Lamp {
    glm::vec3 position{4.0f, 5.0f, 13.0f};
    glm::vec3 axis = glm::normalize(glm::vec3(-0.6f, -0.8f, -0.5f));
    float half_angle_degrees = 40.0f;
    float range = 18.0f;
};

// A field of view of the cone's angle, and a little more for the kernel.
Map lamp_map(Lamp const& lamp) {
    float const fov = glm::radians(2.0f * lamp.half_angle_degrees + 1.0f);
    return {glm::perspectiveRH_ZO(fov, 1.0f, 0.1f, lamp.range + 0.5f) *
                glm::lookAtRH(lamp.position, lamp.position + lamp.axis, up),
            0.0f, 0.0f};
}

// The file as an engine would write it.
class Writer {
public:
    explicit Writer(std::string const& about) { text_ << "{\n  \"about\": \"" << about << "\",\n"; }

    Writer& pair(char const* key, std::string const& value) {
        text_ << "  \"" << key << "\": " << value << ",\n";
        return *this;
    }
    Writer& word(char const* key, std::string const& value) { return pair(key, "\"" + value + "\""); }
    Writer& camera(Camera const& camera) { return pair("camera", camera_text(camera)); }
    Writer& maps(std::vector<Map> const& maps) { return pair("maps", maps_text(maps, "    ")); }
    Writer& next(Camera const& camera, std::vector<Map> const& maps) {
        text_ << "  \"next_frame\": {\n    \"camera\": " << camera_text(camera)
              << ",\n    \"maps\": " << maps_text(maps, "      ") << "\n  },\n";
        return *this;
    }
    [[nodiscard]] std::string end() {
        text_ << "  \"scene\": {\"obj\": \"yard.obj\"}\n}\n";
        return text_.str();
    }

    static std::string vector(glm::vec3 v) {
        std::ostringstream text;
        text.precision(9);
        text << '[' << v.x << ", " << v.y << ", " << v.z << ']';
        return text.str();
    }

private:
    static std::string camera_text(Camera const& camera) {
        std::ostringstream text;
        text.precision(9);
        text << "{\"position\": " << vector(camera.position) << ", \"forward\": " << vector(camera.forward)
             << ",\n    \"fov_y_degrees\": " << camera.fov_y_degrees << ", \"near\": " << camera.z_near
             << ", \"far\": " << camera.z_far << '}';
        return text.str();
    }

    static std::string maps_text(std::vector<Map> const& maps, std::string const& indent) {
        std::ostringstream text;
        text.precision(9);
        text << "[";
        for (std::size_t i = 0; i < maps.size(); ++i) {
            Map const& map = maps[i];
            text << (i == 0 ? "\n" : ",\n") << indent << "{\"name\": \"map " << i << "\", \"size\": " << map.size
                 << ", ";
            if (map.end > 0.0f) text << "\"range\": [" << map.begin << ", " << map.end << "], ";
            text << "\"clip_from_world\": [\n";
            for (int column = 0; column < 4; ++column) {
                text << indent << "  ";
                for (int row = 0; row < 4; ++row)
                    text << map.clip_from_world[column][row]
                         << (column == 3 && row == 3 ? "]}"
                             : row == 3              ? ",\n"
                                                     : ", ");
            }
        }
        text << "]";
        return text.str();
    }

    std::ostringstream text_;
};

Writer begun(std::string const& about, std::string const& clip) {
    Writer writer(about);
    writer.word("clip", clip).word("matrices", "column_major");
    writer.pair("picture", "[" + std::to_string(width) + ", " + std::to_string(height) + "]");
    return writer;
}

std::string sunlight(glm::vec3 travel) {
    return "{\"kind\": \"directional\", \"travel\": " + Writer::vector(travel) + "}";
}

// Of one sun; `maps_of` fits them to a camera.
template <class MapsOf>
std::string two_frames(std::string const& about, std::string const& clip, Camera const& camera, MapsOf const& maps_of,
                       std::string const& bias = {}) {
    Camera const next = stepped(camera);
    Writer writer = begun(about, clip);
    if (!bias.empty()) writer.pair("bias", bias);
    writer.pair("light", sunlight(sun)).camera(camera).maps(maps_of(camera)).next(next, maps_of(next));
    return writer.end();
}

std::string one_frame(std::string const& about, std::string const& clip, std::vector<Map> const& maps,
                      std::string const& bias = {}) {
    Writer writer = begun(about, clip);
    if (!bias.empty()) writer.pair("bias", bias);
    writer.pair("light", sunlight(sun)).camera(Camera{}).maps(maps);
    return writer.end();
}

}  // namespace

std::map<std::string, std::string> sample_cases() {
    Camera const camera;
    std::map<std::string, std::string> files;
    files["yard.obj"] = yard_obj();

    BallOptions const good;
    auto const balls = [](BallOptions const& options) {
        return [options](Camera const& of) { return ball_maps(of, options); };
    };
    files["good.json"] =
        two_frames("Four maps around the balls of their slices, moved by whole texels; bias that grows with the slope.",
                   "vulkan", camera, balls(good), "{\"depth\": 1e-5, \"slope\": 3.2}");
    files["library.json"] = two_frames("Four stable cascades of shadowmath.", "vulkan", camera, library_maps);
    Camera down = camera;
    down.position.y = 0.9f;
    down.forward = glm::normalize(glm::vec3(0.06f, -0.45f, -1.0f));
    files["tutorial.json"] =
        two_frames("Five boxes around the corners of their slices, depth stretched tenfold, nothing snapped.", "opengl",
                   down, tutorial_maps);
    BallOptions unsnapped;
    unsnapped.snapped = false;
    files["unsnapped_sphere.json"] = two_frames("Balls that follow the camera without being moved by whole texels.",
                                                "vulkan", camera, balls(unsnapped));
    BallOptions gl_depth;
    gl_depth.gl_depth = true;
    gl_depth.toward_light = 2.0f;
    files["wrong_clip.json"] = one_frame("Projections for depth from -1 to 1, drawn with an API whose depth is 0 to 1.",
                                         "vulkan", ball_maps(camera, gl_depth));
    BallOptions yesterday;
    yesterday.travel = glm::normalize(sun + glm::vec3(0.2f, 0.0f, 0.1f));
    files["other_light.json"] =
        one_frame("Maps that were drawn before the sun moved.", "vulkan", ball_maps(camera, yesterday));
    BallOptions shallow;
    shallow.toward_light = 0.0f;
    files["cut_casters.json"] = one_frame("The near plane lies at the ball: nothing before it casts, and depth is not "
                                          "clamped.",
                                          "vulkan", ball_maps(camera, shallow));
    std::vector<Map> gaps = ball_maps(camera, good);
    for (std::size_t i = 0; i + 1 < gaps.size(); ++i) gaps[i].end -= 0.1f * (gaps[i].end - gaps[i].begin);
    files["gap.json"] = one_frame("An overlap of a tenth for blending, with the wrong sign.", "vulkan", gaps);
    files["constant_bias.json"] = one_frame("A constant bias that somebody found for another scene.", "vulkan",
                                            ball_maps(camera, good), "{\"depth\": 0.0005}");
    Lamp const lamp;
    std::ostringstream light;
    light << "{\"kind\": \"spot\", \"position\": " << Writer::vector(lamp.position)
          << ",\n    \"axis\": " << Writer::vector(lamp.axis) << ", \"half_angle_degrees\": " << lamp.half_angle_degrees
          << ", \"range\": " << lamp.range << "}";
    Writer spot_case = begun("A lamp over the yard, one map of its cone.", "vulkan");
    files["spot.json"] = spot_case.pair("light", light.str()).camera(camera).maps({lamp_map(lamp)}).end();
    return files;
}

}  // namespace shadowmath::doctor
