// SPDX-License-Identifier: MIT
#include "examples/doctor/sight.hpp"

#include "oracle/ray_oracle.hpp"
#include "scenes/mesh_builder.hpp"
#include "scenes/obj.hpp"

#include <shadowmath/judge.hpp>

#include <algorithm>
#include <cmath>

namespace shadowmath::doctor {
namespace {

constexpr std::size_t most_blockers = 64;  // along one ray

void append(backend::Scene& scene, backend::Scene const& more) {
    auto const vertices = static_cast<std::uint32_t>(scene.vertices.size());
    auto const indices = static_cast<std::uint32_t>(scene.indices.size());
    scene.vertices.insert(scene.vertices.end(), more.vertices.begin(), more.vertices.end());
    for (std::uint32_t const index : more.indices) scene.indices.push_back(index + vertices);
    for (backend::Object object : more.objects) {
        object.first_index += indices;
        scene.objects.push_back(object);
    }
    scene.lo = glm::min(scene.lo, more.lo);
    scene.hi = glm::max(scene.hi, more.hi);
}

// In the lamp's cone and within its range.
bool reached(Light<double> const& light, bool all_around, glm::dvec3 point) {
    if (light.kind == LightKind::directional) return true;
    Normalized<double> const way = safe_normalize(point - light.position);
    if (!way.ok || way.length > light.range) return false;
    return all_around || glm::dot(way.direction, light.direction) >= std::cos(light.half_angle_radians);
}

class Tracer {
public:
    Tracer(Case const& read, backend::Scene const& scene)
        : read_(read), scene_(scene), casters_(scene), all_(every(scene)) {}

    // The nearest surface along a ray of the camera.
    void see(Sight& sight, int pixel, glm::dvec3 origin, glm::dvec3 way) const {
        auto const hit = all_.first_hit(origin, way);
        if (!hit) return;
        Seen seen;
        seen.pixel = pixel;
        seen.point = origin + glm::normalize(way) * hit->distance;
        auto const corner = [&](std::uint32_t k) {
            return glm::dvec3(scene_.vertices[scene_.indices[3 * hit->triangle + k]].position);
        };
        glm::dvec3 const normal = safe_normalize(glm::cross(corner(1) - corner(0), corner(2) - corner(0))).direction;
        seen.normal = glm::dot(normal, way) > 0.0 ? -normal : normal;
        seen.eye_depth = eye_depth(read_.frame.camera, seen.point);
        take(sight, seen);
    }

private:
    static backend::Scene every(backend::Scene scene) {
        for (backend::Object& object : scene.objects) object.casts = true;
        return scene;
    }

    void take(Sight& sight, Seen seen) const {
        Light<double> const& light = read_.frame.light;
        if (seen.eye_depth > read_.shadow_distance || !reached(light, read_.all_around, seen.point)) return;
        seen.faces_light = !faces_away(light, seen.point, seen.normal);
        if (seen.faces_light) {
            seen.first_blocker = sight.blockers.size();
            glm::dvec3 const way = toward(light, seen.point);
            double const offset = oracle::ray_offset(seen.point);
            glm::dvec3 const from = seen.point + seen.normal * offset;
            bool const sun = light.kind == LightKind::directional;
            double const end = sun ? 1e30 : glm::distance(light.position, from);
            double at = 0.0;
            while (sight.blockers.size() - seen.first_blocker < most_blockers) {
                auto const hit = casters_.first_hit(from + way * at, way);
                if (!hit || !(at + hit->distance < end)) break;
                at += hit->distance;
                sight.blockers.push_back(at);
                at += offset;
            }
            seen.blockers = sight.blockers.size() - seen.first_blocker;
            seen.dark = seen.blockers > 0;
        }
        sight.points.push_back(seen);
    }

    Case const& read_;
    backend::Scene const& scene_;
    oracle::RayOracle casters_, all_;
};

}  // namespace

backend::Scene scene_of(Case const& read) {
    backend::Scene scene;
    if (!read.obj.empty()) append(scene, scenes::load_obj_as_it_stands(read.obj));
    if (read.boxes.empty()) return scene;
    scenes::MeshBuilder builder;
    for (SceneBox const& box : read.boxes) {
        builder.box(box.box.lo, box.box.hi);
        builder.end_object(box.casts);
    }
    append(scene, builder.finish("boxes"));
    return scene;
}

Sight look(Case const& read, backend::Scene const& scene, int width) {
    Sight sight;
    ViewVolume<double> const& view = read.frame.camera;
    double const rows = std::round(double(width) * read.picture.height / read.picture.width);
    sight.extent = {width, static_cast<int>(std::clamp(rows, 1.0, 4.0 * width))};
    sight.traced = !scene.indices.empty();
    auto const sides = [&](int x, int y) {
        return glm::dvec2(view.left + (view.right - view.left) * (x + 0.5) / sight.extent.width,
                          view.bottom + (view.top - view.bottom) * (y + 0.5) / sight.extent.height);
    };
    if (sight.traced) {
        Tracer const tracer(read, scene);
        for (int y = 0; y < sight.extent.height; ++y)
            for (int x = 0; x < width; ++x) {
                glm::dvec2 const side = sides(x, y);
                glm::dvec3 const start = point_at(view, side.x, side.y, view.z_near);
                glm::dvec3 const way = point_at(view, side.x, side.y, view.z_near + 1.0) - start;
                tracer.see(sight, y * width + x, start, way);
            }
        return sight;
    }
    // A few on each of a few rays, evenly over the orders of depth; at other depths on the next ray.
    constexpr int step = 8, on_each = 6;
    double const last = std::min(read.shadow_distance, view.z_far) * 0.999, first = std::min(view.z_near * 1.001, last);
    for (int y = step / 2; y < sight.extent.height; y += step)
        for (int x = step / 2; x < width; x += step)
            for (int i = 0; i < on_each; ++i) {
                Seen seen;
                seen.pixel = y * width + x;
                double const shift = (x / step * 5 + y / step * 3) % 8 / 8.0;
                seen.eye_depth = first * std::pow(last / first, (i + shift) / on_each);
                glm::dvec2 const side = sides(x, y);
                seen.point = point_at(view, side.x, side.y, seen.eye_depth);
                seen.normal = neutral_normal(view, read.frame.light, seen.point);
                seen.faces_light = true;
                if (reached(read.frame.light, read.all_around, seen.point)) sight.points.push_back(seen);
            }
    return sight;
}

}  // namespace shadowmath::doctor
