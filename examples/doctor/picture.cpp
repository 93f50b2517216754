// SPDX-License-Identifier: MIT
#include "examples/doctor/picture.hpp"

#include <shadowmath/slice.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace shadowmath::doctor {
namespace {

using backend::Rgba8;
using Picture = backend::Image<Rgba8>;

constexpr int gap = 8;     // pixels between the parts
constexpr int tile = 232;  // pixels along the side of a map
constexpr Rgba8 paper{24, 26, 30, 255};
constexpr Rgba8 frame_colour{70, 74, 82, 255};
constexpr Rgba8 outline{230, 230, 230, 255};
constexpr Rgba8 no_map{235, 40, 50, 255};
constexpr Rgba8 lost{255, 70, 230, 255};
constexpr Rgba8 acne_colour{255, 196, 0, 255};
constexpr std::array<Rgba8, 8> tints{{{108, 160, 220, 255},
                                      {120, 190, 120, 255},
                                      {205, 165, 90, 255},
                                      {160, 130, 200, 255},
                                      {90, 185, 185, 255},
                                      {200, 130, 130, 255},
                                      {170, 180, 90, 255},
                                      {150, 150, 160, 255}}};

Rgba8 scaled(Rgba8 colour, double brightness) {
    auto const channel = [&](std::uint8_t c) {
        return static_cast<std::uint8_t>(std::clamp(std::lround(c * brightness), 0l, 255l));
    };
    return {channel(colour.r), channel(colour.g), channel(colour.b), 255};
}

// What a point is painted in both parts.
Rgba8 colour_of(Case const& read, Sight const& sight, Diagnosis const& diagnosis, std::size_t i) {
    Seen const& seen = sight.points[i];
    Place const place = diagnosis.places[i];
    if (place.served != Served::yes) return seen.dark || !sight.traced ? no_map : scaled(no_map, 0.6);
    if (diagnosis.lost_cut[i]) return lost;
    if (diagnosis.acne[i]) return acne_colour;
    Rgba8 const tint = tints[static_cast<std::size_t>(place.map) % tints.size()];
    double const facing = std::max(0.0, glm::dot(seen.normal, toward(read.frame.light, seen.point)));
    return scaled(tint, seen.dark || !seen.faces_light ? 0.3 : 0.45 + 0.55 * facing);
}

struct Canvas {
    Picture& picture;

    void dot(int x, int y, Rgba8 colour) const {
        if (x >= 0 && y >= 0 && x < picture.extent.width && y < picture.extent.height) picture.at(x, y) = colour;
    }
    void block(int x, int y, int width, int height, Rgba8 colour) const {
        for (int j = 0; j < height; ++j)
            for (int i = 0; i < width; ++i) dot(x + i, y + j, colour);
    }
};

struct Tile {
    int x, y;  // its lower-left pixel
};

// A line between two places of the map, each in [0, 1] where it is inside.
void line(Canvas const& canvas, Tile at, glm::dvec2 a, glm::dvec2 b) {
    int const steps = 2 * tile;
    for (int i = 0; i <= steps; ++i) {
        glm::dvec2 const p = a + (b - a) * (double(i) / steps);
        if (std::min(p.x, p.y) < 0.0 || std::max(p.x, p.y) > 1.0) continue;
        canvas.dot(at.x + int(p.x * (tile - 1)), at.y + int(p.y * (tile - 1)), outline);
    }
}

// The part of the view that the map is meant for.
void slice_outline(Canvas const& canvas, Tile at, Case const& read, std::size_t m) {
    EngineMap const& map = read.frame.maps[m];
    ViewVolume<double> part = read.frame.camera;
    if (map.range) part = slice(part, *map.range);
    if (!(part.z_far < 1e9)) return;
    ShadowMap<double> const engine = map_of(map, read.clip);
    std::array<glm::dvec3, 8> const corner = corners(part);
    for (unsigned i = 0; i < 8; ++i)
        for (unsigned bit = 1; bit < 8; bit *= 2) {
            if (i & bit) continue;
            Inside const a = inside(engine, corner[i]), b = inside(engine, corner[i | bit]);
            if (!a.in_front || !b.in_front || glm::length(a.at) > 1e4 || glm::length(b.at) > 1e4) continue;
            line(canvas, at, glm::dvec2(a.at), glm::dvec2(b.at));
        }
}

void draw_map(Canvas const& canvas, Tile at, Case const& read, Sight const& sight, Diagnosis const& diagnosis,
              std::size_t m) {
    canvas.block(at.x - 1, at.y - 1, tile + 2, tile + 2, frame_colour);
    canvas.block(at.x, at.y, tile, tile, scaled(paper, 0.6));
    ShadowMap<double> const engine = map_of(read.frame.maps[m], read.clip);
    for (std::size_t i = 0; i < sight.points.size(); ++i) {
        if (diagnosis.places[i].map != static_cast<int>(m)) continue;
        Inside const place = inside(engine, sight.points[i].point);
        if (!place.in_front || std::min(place.at.x, place.at.y) < 0.0 || std::max(place.at.x, place.at.y) > 1.0)
            continue;
        canvas.dot(at.x + int(place.at.x * (tile - 1)), at.y + int(place.at.y * (tile - 1)),
                   colour_of(read, sight, diagnosis, i));
    }
    slice_outline(canvas, at, read, m);
}

}  // namespace

char const* legend() {
    return "the camera's view, a tint for each map, dark where shadow falls; red: no map holds it; magenta: its shadow "
           "is lost, as casters are cut off; yellow: too little bias. Below, the maps: what falls on each, and the "
           "outline of the part of the view that it is meant for.";
}

Picture picture(Case const& read, Sight const& sight, Diagnosis const& diagnosis) {
    int const maps = static_cast<int>(read.frame.maps.size());
    int const zoom = std::max(1, 960 / sight.extent.width);
    int const width = std::max(sight.extent.width * zoom, 4 * tile + 3 * gap) + 2 * gap;
    int const columns = std::max(1, (width - gap) / (tile + gap));
    int const rows = (maps + columns - 1) / columns;
    int const below = rows * (tile + gap);
    Picture drawn({width, below + sight.extent.height * zoom + 2 * gap}, paper);
    Canvas const canvas{drawn};
    int const left = (width - sight.extent.width * zoom) / 2;
    canvas.block(left, below + gap, sight.extent.width * zoom, sight.extent.height * zoom, frame_colour);
    for (std::size_t i = 0; i < sight.points.size(); ++i) {
        int const x = sight.points[i].pixel % sight.extent.width, y = sight.points[i].pixel / sight.extent.width;
        int const dot = sight.traced ? zoom : 3 * zoom;
        canvas.block(left + x * zoom, below + gap + y * zoom, dot, dot, colour_of(read, sight, diagnosis, i));
    }
    for (int m = 0; m < maps; ++m)
        draw_map(canvas, {gap + (m % columns) * (tile + gap), below - (m / columns + 1) * (tile + gap) + gap}, read,
                 sight, diagnosis, static_cast<std::size_t>(m));
    return drawn;
}

}  // namespace shadowmath::doctor
