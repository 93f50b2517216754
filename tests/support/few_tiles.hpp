// SPDX-License-Identifier: MIT
//
// A view of a few tiles, for choices of maps that take no time.
#pragma once

#include "tests/support/town.hpp"

#include <shadowmath/choose_maps.hpp>

#include <memory>
#include <vector>

namespace shadowmath::test {

inline Light<double> const sun_of_tiles = directional(V3(0.8, -0.5, 0.4));
inline Aabb<double> const everywhere{V3(-300), V3(300)};

[[nodiscard]] inline ViewVolume<double> view_of_tiles(bool flat) {
    auto const pose = pose_looking(V3(3, 20, 5), V3(0.4, -0.6, -1), V3(0, 1, 0));
    ViewVolume<double> view =
        flat ? orthographic_view(pose, -12.0, 20.0, -9.0, 7.0, 0.5, 90.0) : perspective_view(pose, 0.9, 1.6, 0.5, 90.0);
    view.left *= 0.8;
    return view;
}

[[nodiscard]] inline MapSearch<double>& search_of_tiles() {
    static auto const work = std::make_unique<MapSearch<double>>();
    return *work;
}

// Tiles of which nothing is seen until they are given depths.
struct FewTiles {
    ViewVolume<double> view;
    int width, height;
    std::vector<double> nearest, farthest;

    FewTiles(ViewVolume<double> const& of, int across, int upward)
        : view(of), width(across), height(upward), nearest(std::size_t(across * upward), 1.0),
          farthest(std::size_t(across * upward), 0.0) {}

    void see(int tile, double from, double to) {
        nearest[std::size_t(tile)] = from;
        farthest[std::size_t(tile)] = to;
    }
    [[nodiscard]] DepthTiles<double> depths() const { return {nearest.data(), farthest.data(), width, height}; }
    // A place of a tile, from 0 to 1 across and upward.
    [[nodiscard]] V3 at(int tile, double u, double v, double depth) const {
        double const x = (tile % width + u) / width, y = (tile / width + v) / height;
        return point_at(view, view.left + (view.right - view.left) * x, view.bottom + (view.top - view.bottom) * y,
                        depth);
    }
    [[nodiscard]] ChosenMaps<double> chosen(MapLimits<double> const& limits,
                                            std::vector<SurfacePoint<double>> const& samples = {}) const {
        return choose_maps(view, sun_of_tiles, everywhere, samples.data(), int(samples.size()), depths(), limits,
                           search_of_tiles());
    }
};

[[nodiscard]] inline MapLimits<double> limits_of(int maps) {
    MapLimits<double> limits;
    limits.maps = maps;
    return limits;
}

// Samples of a tile's middle, at a depth between its two.
[[nodiscard]] inline std::vector<SurfacePoint<double>> middles(FewTiles const& tiles) {
    std::vector<SurfacePoint<double>> samples;
    for (int i = 0; i < tiles.width * tiles.height; ++i) {
        double const from = tiles.nearest[std::size_t(i)], to = tiles.farthest[std::size_t(i)];
        if (from <= to) samples.push_back({tiles.at(i, 0.5, 0.5, 0.3 * from + 0.7 * to), V3(0, 1, 0)});
    }
    return samples;
}

[[nodiscard]] inline FewTiles hills(bool flat) {
    FewTiles tiles(view_of_tiles(flat), 6, 4);
    for (int i = 0; i < 24; ++i)
        if (i % 7 != 3) tiles.see(i, 10.0 + i % 6 + i / 6 * 12, 11.0 + i % 6 + i / 6 * 13);
    return tiles;
}

}  // namespace shadowmath::test
