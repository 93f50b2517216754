// SPDX-License-Identifier: MIT
#include "examples/quality/figures.hpp"

#include "examples/support/percentile.hpp"

#include <shadowmath/footprint.hpp>
#include <shadowmath/judge.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

namespace shadowmath::quality {
namespace {

class Seen {
public:
    Seen(gallery::MapSet const& maps, backend::Frame const& frame)
        : maps_(maps), eye_(maps.frame.eye_position), forward_(maps.frame.eye_forward),
          world_from_clip_(glm::inverse(glm::dmat4(maps.frame.clip_from_world))), size_(maps.map_size),
          extent_(frame.position.extent),
          touched_(maps.maps.size(), std::vector<std::uint8_t>(std::size_t(size_) * std::size_t(size_))) {}

    // The pixel's part of the plane through its surface: a grid of points as dense as the kernel needs, were the
    // footprint a third of a texel or more.
    void add(int x, int y, std::size_t map, glm::dvec3 const& point, glm::dvec3 const& normal) {
        constexpr int steps = 3;
        double const height = glm::dot(normal, point - eye_);
        for (int j = 0; j < steps; ++j)
            for (int i = 0; i < steps; ++i) {
                glm::dvec3 const way = ray(x + (i + 0.5) / steps, y + (j + 0.5) / steps);
                double const cosine = glm::dot(normal, way);
                // Seen edge-on a pixel has no end; the next ones stand for it.
                glm::dvec3 const there =
                    std::abs(cosine) > 0.02 * glm::length(way) ? eye_ + way * (height / cosine) : point;
                touch(touched_[map], maps_.maps[map].clip_from_world, there);
            }
    }

    [[nodiscard]] double share() const {
        long used = 0, all = 0;
        for (auto const& texels : touched_) {
            used += std::count(texels.begin(), texels.end(), std::uint8_t{1});
            all += long(texels.size());
        }
        return all > 0 ? double(used) / double(all) : 0.0;
    }

private:
    [[nodiscard]] glm::dvec3 ray(double x, double y) const {
        glm::dvec2 const ndc(2.0 * x / extent_.width - 1.0, 2.0 * y / extent_.height - 1.0);
        glm::dvec4 const far = world_from_clip_ * glm::dvec4(ndc, 0.5, 1.0);
        return glm::dvec3(far) / far.w - eye_;
    }

    void touch(std::vector<std::uint8_t>& texels, glm::dmat4 const& clip_from_world, glm::dvec3 const& point) const {
        glm::dvec4 const clip = clip_from_world * glm::dvec4(point, 1.0);
        if (!(clip.w > 0.0)) return;
        glm::dvec2 const home = glm::floor((glm::dvec2(clip) / clip.w * 0.5 + 0.5) * double(size_));
        int const reach = gallery::filter_radius;
        if (!(home.x >= reach && home.y >= reach && home.x < size_ - reach && home.y < size_ - reach)) return;
        for (int v = int(home.y) - reach; v <= int(home.y) + reach; ++v)
            for (int u = int(home.x) - reach; u <= int(home.x) + reach; ++u)
                texels[std::size_t(v) * std::size_t(size_) + std::size_t(u)] = 1;
    }

    gallery::MapSet const& maps_;
    glm::dvec3 eye_, forward_;
    glm::dmat4 world_from_clip_;
    int size_;
    backend::Extent extent_;
    std::vector<std::vector<std::uint8_t>> touched_;
};

}  // namespace

MapFigures map_figures(gallery::ViewTruth const& truth, gallery::MapSet const& maps, backend::Frame const& frame,
                       scenes::View const& view) {
    using gallery::Question;
    backend::Extent const extent = truth.question.extent;
    glm::dmat4 const eye_clip_from_world(maps.frame.clip_from_world);
    glm::dvec2 const eye_pixels(extent.width, extent.height);
    ViewVolume<double> const eye =
        perspective_view(pose_looking(view.eye, view.forward, view.up), view.fov_y_radians,
                         double(extent.width) / double(extent.height), view.z_near, view.shadow_distance);
    Light<double> const light = directional(view.light_travel);
    std::vector<float> whole, perspective;
    long mapped = 0;
    Seen seen(maps, frame);
    for (int y = 0; y < extent.height; ++y)
        for (int x = 0; x < extent.width; ++x) {
            backend::Texel4 const &p = frame.position.at(x, y), &n = frame.normal.at(x, y);
            auto const map = std::ptrdiff_t(p.w);
            if (p.w < 0.0f || map >= std::ptrdiff_t(maps.maps.size())) continue;
            glm::dvec3 const point(p.x, p.y, p.z), normal(n.x, n.y, n.z);
            seen.add(x, y, std::size_t(map), point, normal);
            ++mapped;
            Question const question = truth.question.at(x, y);
            if (question == Question::none || question == Question::beyond) continue;
            glm::dmat4 const& clip_from_world = maps.maps[std::size_t(map)].clip_from_world;
            auto const major = [&](glm::dvec3 const& lean) {
                return float(
                    footprint(eye_clip_from_world, eye_pixels, clip_from_world, double(maps.map_size), point, lean)
                        .major);
            };
            whole.push_back(major(normal));
            perspective.push_back(major(neutral_normal(eye, light, point)));
        }
    MapFigures figures;
    for (float const one : perspective) figures.perspective_mean += double(one) / double(perspective.size());
    for (float const one : whole) figures.capped_mean += std::min(double(one), lost_pixels) / double(whole.size());
    figures.footprint_median = example::percentile(whole, 0.5);
    figures.perspective_p95 = example::percentile(perspective, 0.95);
    figures.texels_seen = seen.share();
    int const taps = 2 * gallery::filter_radius + 1;
    double const texels = double(maps.maps.size()) * double(maps.map_size) * double(maps.map_size);
    figures.texels_most = texels > 0.0 ? std::min(1.0, double(mapped) * taps * taps / texels) : 0.0;
    return figures;
}

}  // namespace shadowmath::quality
