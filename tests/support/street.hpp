// SPDX-License-Identifier: MIT
//
// A street in the morning, as maps for it are chosen by: depths of tiles, surfaces, and boxes.
#pragma once

#include "tests/support/town.hpp"

#include <shadowmath/choose_maps.hpp>

#include <algorithm>
#include <limits>
#include <vector>

namespace shadowmath::test {

[[nodiscard]] inline ViewVolume<double> street_view() {
    return perspective_view(pose_looking(V3(0, 1.7, 0), V3(0.4, -0.05, -1), V3(0, 1, 0)), 1.0, 1.6, 0.1, 150.0);
}

inline Light<double> const street_morning = directional(V3(0.8, -0.5, 0.4));
inline Aabb<double> const street_town{V3(-300, -1, -300), V3(300, 20, 300)};

// The ground at 0 and walls 8 m to either side, seen through the view: every tile's nearest and farthest depth, and a
// surface in its middle.
struct Street {
    ViewVolume<double> view = street_view();
    int width, height;
    std::vector<double> nearest, farthest;
    std::vector<SurfacePoint<double>> samples;
    std::vector<Aabb<double>> boxes{
        {V3(-300, -1, -300), V3(300, 0, 300)}, {V3(-18, 0, -300), V3(-8, 12, 300)}, {V3(8, 0, -300), V3(18, 15, 300)}};

    explicit Street(ViewVolume<double> const& seen = street_view(), int tiles_x = 40, int tiles_y = 25,
                    int sample_every = 4)
        : view(seen), width(tiles_x), height(tiles_y) {
        nearest.assign(std::size_t(width * height), std::numeric_limits<double>::max());
        farthest.assign(std::size_t(width * height), std::numeric_limits<double>::lowest());
        constexpr int fine = 4;
        for (int y = 0; y < fine * height; ++y)
            for (int x = 0; x < fine * width; ++x) {
                auto const hit = surface(side_of(x, fine * width, view.left, view.right),
                                         side_of(y, fine * height, view.bottom, view.top));
                double const depth = eye_depth(view, hit.point);
                if (!(depth > view.z_near && depth < view.z_far)) continue;
                auto const tile = std::size_t(y / fine * width + x / fine);
                nearest[tile] = std::min(nearest[tile], depth);
                farthest[tile] = std::max(farthest[tile], depth);
                if (x % sample_every == sample_every / 2 && y % sample_every == sample_every / 2)
                    samples.push_back(hit);
            }
    }
    static double side_of(int i, int count, double lo, double hi) { return lo + (hi - lo) * (i + 0.5) / count; }

    [[nodiscard]] SurfacePoint<double> surface(double side_x, double side_y) const {
        V3 const eye = view.pose.position, way = point_at(view, side_x, side_y, 1.0) - eye;
        double nearest_hit = std::numeric_limits<double>::infinity();
        V3 normal(0, 1, 0);
        auto const try_plane = [&](V3 n, double offset) {
            double const t = -(glm::dot(n, eye) + offset) / glm::dot(n, way);
            if (t > 0.0 && t < nearest_hit) nearest_hit = t, normal = n;
        };
        try_plane(V3(0, 1, 0), 0.0);
        try_plane(V3(1, 0, 0), 8.0);
        try_plane(V3(-1, 0, 0), 8.0);
        return {eye + way * std::min(nearest_hit, 1e6), normal};
    }
    [[nodiscard]] DepthTiles<double> tiles() const { return {nearest.data(), farthest.data(), width, height}; }
    [[nodiscard]] ChosenMaps<double> chosen(MapLimits<double> const& limits = {},
                                            Light<double> const& light = street_morning) const {
        static MapSearch<double> work;
        return choose_maps(view, light, street_town, samples.data(), int(samples.size()), tiles(), limits, work);
    }
    [[nodiscard]] ChosenMaps<double> chosen_from_boxes(MapLimits<double> const& limits = {},
                                                       Light<double> const& light = street_morning) const {
        static MapSearch<double> work;
        return choose_maps(view, light, street_town, boxes.data(), int(boxes.size()), limits, work);
    }
};

}  // namespace shadowmath::test
