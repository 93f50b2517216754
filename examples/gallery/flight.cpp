// SPDX-License-Identifier: MIT
#include "examples/gallery/flight.hpp"

#include "examples/gallery/draw_maps.hpp"

#include <shadowmath/shadowmath.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

namespace shadowmath::gallery {
namespace {

constexpr backend::Extent extent{320,
                                 180};  // of the eye: what fits to samples look at, and where points are taken from
constexpr int points_wanted = 12000;

struct Point {
    glm::dvec3 at{0.0};
    Vec3<float> position{0.0f}, normal{0.0f};
};

// A policy remembers its last frame.
struct Policy {
    std::string id, title;
    bool stable = false;
    std::function<MapSet(scenes::View const&)> fit;
};

enum class Answer : std::uint8_t { unasked, dark, lit };

struct Decision {
    Answer answer = Answer::unasked;
    int map = -1;
};

// What the receiver pass does with a frame's constants, by the C++ of the same functions.
class Receivers {
public:
    Receivers(MapSet const& set, std::vector<backend::Image<float>> const& depths)
        : frame_(set.frame), map_size_(set.map_size), depths_(depths) {
        for (int i = 0; i < frame_.map_count; ++i) {
            backend::MapConstants const& m = frame_.maps[static_cast<std::size_t>(i)];
            ShadowMap<float> map;
            map.clip_from_world = m.clip_from_world;
            map.w_min = m.w_min;
            map.clip = gl_zero_to_one_clip;
            map.visible = true;
            maps_.push_back(map);
            ranges_.push_back({0.0f, m.blend_begin, m.depth_end});
        }
    }

    [[nodiscard]] Decision decide(Point const& point) const {
        LookUp<float> look_up;
        if (frame_.choice == backend::MapChoice::by_depth) {
            glm::vec3 const from_eye = point.position - glm::vec3(frame_.eye_position);
            look_up = by_depth(ranges_.data(), frame_.map_count, glm::dot(glm::vec3(frame_.eye_forward), from_eye));
        } else {
            float const margin = static_cast<float>(frame_.filter_radius + 1);
            look_up = by_map(maps_.data(), frame_.map_count, map_size_, margin, point.position);
        }
        float const share = blended(look_up, share_in(look_up.first, point), share_in(look_up.second, point));
        return {share >= 0.5f ? Answer::lit : Answer::dark, look_up.first};
    }

private:
    [[nodiscard]] float share_in(int index, Point const& point) const {
        if (index < 0) return 1.0f;
        auto const i = static_cast<std::size_t>(index);
        backend::MapConstants const& m = frame_.maps[i];
        MapBias<float> const bias{m.bias_constant, m.bias_w, m.bias_slope_texels, m.slope_limit};
        auto const stored = [&](int x, int y) { return depths_[i].at(x, y); };
        return visibility(maps_[i], map_size_, point.position, point.normal, bias,
                          FilterOptions{frame_.filter_radius, frame_.tap_plane == 1}, stored);
    }

    backend::FrameConstants const& frame_;
    int map_size_;
    std::vector<backend::Image<float>> const& depths_;
    std::vector<ShadowMap<float>> maps_;
    std::vector<SliceRange<float>> ranges_;
};

// From four frames of the flight, what faces the light, one in so many pixels.
std::vector<Point> points_seen(backend::Backend& backend, scenes::View const& view, int frames) {
    std::vector<Point> all;
    glm::dvec3 const to_light = -view.light_travel;
    for (int quarter = 0; quarter < 4; ++quarter) {
        scenes::View const there = flown(view, frames * quarter / 4);
        backend.draw_scene({extent, unshadowed(there, extent)});
        backend::Frame const seen = backend.read_frame();
        for (std::size_t i = 0; i < seen.position.pixels.size(); ++i) {
            backend::Texel4 const &p = seen.position.pixels[i], &n = seen.normal.pixels[i];
            Point const point{{p.x, p.y, p.z}, {p.x, p.y, p.z}, {n.x, n.y, n.z}};
            if (p.w == -2.0f || !(glm::dot(glm::dvec3(point.normal), to_light) > 0.0)) continue;
            all.push_back(point);
        }
    }
    std::size_t const step = std::max<std::size_t>(1, all.size() / points_wanted);
    std::vector<Point> some;
    for (std::size_t i = 0; i < all.size(); i += step) some.push_back(all[i]);
    return some;
}

// Points that a frame asks.
std::vector<bool> asked_in(scenes::View const& view, std::vector<Point> const& points,
                           oracle::RayOracle const& oracle) {
    double const half_y = std::tan(view.fov_y_radians / 2.0), half_x = half_y * extent.width / extent.height;
    Pose<double> const pose = pose_looking(view.eye, view.forward, view.up);
    std::vector<bool> asked(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
        glm::dvec3 const way = points[i].at - pose.position;
        double const depth = glm::dot(way, pose.forward), distance = glm::length(way);
        if (!(depth > view.z_near) || !(depth < 0.999 * view.shadow_distance)) continue;
        if (std::abs(glm::dot(way, pose.right)) >= half_x * depth || std::abs(glm::dot(way, pose.up)) >= half_y * depth)
            continue;
        auto const hit = oracle.first_hit(pose.position, way / distance);
        asked[i] = !hit || hit->distance >= distance - 1e-3 - 1e-4 * distance;
    }
    return asked;
}

void count(FlightRecord& record, std::vector<Decision> const& before, std::vector<Decision> const& now) {
    for (std::size_t i = 0; i < now.size(); ++i) {
        if (before[i].answer == Answer::unasked || now[i].answer == Answer::unasked) continue;
        bool const flips = before[i].answer != now[i].answer, within = before[i].map == now[i].map;
        ++record.decisions;
        record.flips += flips;
        record.decisions_within += within;
        record.flips_within += within && flips;
    }
}

std::vector<Policy> policies(backend::Backend& backend, backend::Scene const& scene, scenes::View const& first,
                             std::vector<Point> const& points, std::vector<bool> const& asked, int map_size) {
    CascadeOptions<double> given;
    given.map_size = map_size;
    given.lambda = 0.65;
    auto const cascades = [&scene](std::string id, std::string title, CascadeOptions<double> const& options) {
        bool const stable = options.fit == CascadeFit::stable;
        return Policy{std::move(id), std::move(title), stable,
                      [&scene, options, last = Cascades<double>{}](scenes::View const& view) mutable {
                          return fit_cascade_maps(scene, view, extent, options, last);
                      }};
    };
    auto const with = [&given](CascadeFit cascade_fit) {
        CascadeOptions<double> options = given;
        options.fit = cascade_fit;
        return options;
    };
    std::vector<SurfacePoint<double>> samples;
    for (std::size_t i = 0; i < points.size(); i += 8)
        if (asked[i]) samples.push_back({points[i].at, Vec3<double>(points[i].normal)});
    auto const chosen = [&](Motion motion) {
        ChoiceLimits<double> limits;
        limits.eye_pixels = Vec2<double>(extent.width, extent.height);
        limits.texels = std::int64_t{4} * map_size * map_size;
        limits.motion = motion;
        limits.goal = Goal::least_mean;
        return choose_cascades(scene, first, extent, samples, given, limits);
    };
    auto const technique = [&](char const* id, std::string title, int maps, bool samples_wanted) {
        Technique const made{id, title, "", map_size, maps, false, samples_wanted};
        return Policy{id, title, false, [&backend, &scene, made](scenes::View const& view) {
                          return fit_on(backend, made, scene, view, extent);
                      }};
    };
    return {cascades("stable", "Four stable cascades", with(CascadeFit::stable)),
            cascades("tight", "Four tight cascades", with(CascadeFit::tight)),
            cascades("rectangle", "Four least rectangles", with(CascadeFit::rectangle)),
            cascades("focus", "Four focused maps", with(CascadeFit::focus)),
            cascades("warped", "Four warped maps", with(CascadeFit::warped)),
            technique("vdsm-fallback", "View-dependent map, uniform map behind it", 2, false),
            technique("vdsm-chosen", "View-dependent map on a chosen plane, uniform behind", 2, true),
            technique("sdsm", "Four maps fitted to samples", 4, true),
            technique("sdsm-still", "The same, texels of eight sizes an octave", 4, true),
            technique("chosen-boxes", "Four maps where the boxes need them", 4, false),
            technique("chosen-depth", "Four maps where the picture needs them", 4, true),
            cascades("chosen-still", "Chosen, nothing may move", chosen(Motion::still)),
            cascades("chosen", "Chosen, whatever is finest", chosen(Motion::any))};
}

}  // namespace

double shimmer(FlightRecord const& record) {
    return static_cast<double>(record.flips) / static_cast<double>(std::max(record.decisions, 1L));
}
double shimmer_within(FlightRecord const& record) {
    return static_cast<double>(record.flips_within) / static_cast<double>(std::max(record.decisions_within, 1L));
}

scenes::View flown(scenes::View const& view, int frame) {
    double const turn = 2.0 * 3.14159265358979323846 * frame / whole_flight;
    glm::dvec3 const level(view.forward.x, 0.0, view.forward.z);
    glm::dvec3 const ahead = glm::length(level) > 1e-3 ? glm::normalize(level) : glm::dvec3(0.0, 0.0, -1.0);
    glm::dvec3 const right(-ahead.z, 0.0, ahead.x);
    scenes::View there = view;
    there.eye += ahead * (3.0 * (1.0 - std::cos(turn))) + right * (1.2 * std::sin(turn));
    there.eye.y += 0.15 * std::sin(2.0 * turn);
    double const yaw = 0.3 * std::sin(turn), pitch = 0.06 * std::sin(2.0 * turn);
    glm::dvec3 const turned = view.forward * std::cos(yaw) +
                              glm::cross(glm::dvec3(0.0, 1.0, 0.0), view.forward) * std::sin(yaw) +
                              glm::dvec3(0.0, view.forward.y * (1.0 - std::cos(yaw)), 0.0);
    there.forward = glm::normalize(turned + glm::dvec3(0.0, pitch, 0.0));
    return there;
}

std::vector<FlightRecord> fly(backend::Backend& backend, oracle::RayOracle const& oracle, backend::Scene const& scene,
                              scenes::View const& view, int frames, int map_size,
                              std::function<void(int)> const& after_frame) {
    std::vector<Point> const points = points_seen(backend, view, frames);
    std::vector<bool> asked = asked_in(view, points, oracle);
    std::vector<Policy> all = policies(backend, scene, view, points, asked, map_size);
    std::vector<FlightRecord> records;
    for (Policy const& policy : all) {
        FlightRecord record{scene.name, view.name, policy.id, policy.title, policy.stable, frames};
        record.points = static_cast<long>(points.size());
        records.push_back(record);
    }
    std::vector<std::vector<Decision>> before(all.size(), std::vector<Decision>(points.size()));
    for (int frame = 0; frame < frames; ++frame) {
        scenes::View const there = flown(view, frame);
        asked = asked_in(there, points, oracle);
        for (std::size_t i = 0; i < all.size(); ++i) {
            MapSet const set = all[i].fit(there);
            draw_maps(backend, set, extent);
            std::vector<backend::Image<float>> depths;
            for (int map = 0; map < set.frame.map_count; ++map) depths.push_back(backend.read_depth(map));
            Receivers const receivers(set, depths);
            std::vector<Decision> now(points.size());
            for (std::size_t k = 0; k < points.size(); ++k)
                if (asked[k]) now[k] = receivers.decide(points[k]);
            count(records[i], before[i], now);
            before[i] = std::move(now);
            records[i].map_size = set.map_size;
            records[i].maps = set.frame.map_count;
        }
        if (after_frame) after_frame(frame);
    }
    return records;
}

}  // namespace shadowmath::gallery
