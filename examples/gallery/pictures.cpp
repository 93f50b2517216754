// SPDX-License-Identifier: MIT
#include "examples/gallery/pictures.hpp"

#include "examples/support/percentile.hpp"

#include <algorithm>
#include <cmath>

namespace shadowmath::gallery {
namespace {

constexpr double finest_footprint = 0.25;    // eye pixels a texel, the cold end of the scale
constexpr double coarsest_footprint = 16.0;  // and the bright one

// Dark blue to pale yellow with evenly rising lightness, so that it reads in grey and to every eye.
constexpr std::array<Colour, 8> heat{{{38, 20, 86},
                                      {52, 66, 148},
                                      {34, 112, 160},
                                      {30, 148, 146},
                                      {82, 180, 110},
                                      {170, 203, 72},
                                      {240, 214, 78},
                                      {255, 246, 205}}};

constexpr std::array<Colour, 8> tints{{{214, 72, 66},
                                       {236, 156, 58},
                                       {228, 213, 84},
                                       {96, 178, 96},
                                       {62, 164, 190},
                                       {78, 104, 196},
                                       {146, 92, 190},
                                       {204, 104, 158}}};

std::uint8_t byte(double value) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 255.0)));
}

Colour mix(Colour a, Colour b, double t) {
    Colour mixed{};
    for (std::size_t i = 0; i < 3; ++i) mixed[i] = byte(a[i] + (double(b[i]) - a[i]) * t);
    return mixed;
}

Colour scaled(Colour c, double brightness) {
    return mix({0, 0, 0}, c, brightness);
}

Colour heat_at(double t) {
    double const place = std::clamp(t, 0.0, 1.0) * (heat.size() - 1);
    auto const below = std::min(static_cast<std::size_t>(place), heat.size() - 2);
    return mix(heat[below], heat[below + 1], place - static_cast<double>(below));
}

double lightness(backend::Rgba8 p) {
    return (0.299 * p.r + 0.587 * p.g + 0.114 * p.b) / 255.0;
}

struct DepthRange {
    float lo, hi;
};

// The middle 96 % of what was drawn, so that a steeple or a distant hill does not take the contrast from the rest.
DepthRange contrast_range(backend::Image<float> const& depth) {
    std::vector<float> drawn;
    for (std::size_t i = 0; i < depth.pixels.size(); i += 7)
        if (depth.pixels[i] < 1.0f) drawn.push_back(depth.pixels[i]);
    if (drawn.empty()) return {0.0f, 1.0f};
    float const lo = example::percentile(drawn, 0.02);
    return {lo, std::max(example::percentile(drawn, 0.98), lo + 1e-9f)};
}

// A palette laid out as bands: `shade` runs from 0 to 1 within each.
class Bands {
public:
    explicit Bands(int shades) : shades_(shades) {}

    template <class ColourOfShade>
    void add(ColourOfShade const& colour_of_shade) {
        for (int i = 0; i < shades_; ++i) palette_.push_back(colour_of_shade(double(i) / (shades_ - 1)));
    }

    [[nodiscard]] std::uint8_t index(int band, double shade) const {
        return static_cast<std::uint8_t>(band * shades_ +
                                         static_cast<int>(std::lround(std::clamp(shade, 0.0, 1.0) * (shades_ - 1))));
    }

    [[nodiscard]] std::vector<Colour> take() { return std::move(palette_); }

private:
    int shades_;
    std::vector<Colour> palette_;
};

Colour grey(double low, double high, double shade) {
    std::uint8_t const v = byte(low + (high - low) * shade);
    return {v, v, v};
}

// From a colour's shadow side to its light side.
auto toned(Colour colour, double darkest, double whitest) {
    return [=](double shade) {
        return mix(scaled(colour, darkest + (1.0 - darkest) * shade), {255, 255, 255}, whitest * shade);
    };
}

}  // namespace

std::vector<Colour> footprint_scale(int steps) {
    std::vector<Colour> scale;
    for (int i = 0; i < steps; ++i) scale.push_back(heat_at(steps > 1 ? double(i) / (steps - 1) : 0.0));
    return scale;
}

Colour map_tint(int map) {
    return tints[static_cast<std::size_t>(std::max(map, 0)) % tints.size()];
}

IndexedPicture difference_picture(backend::Image<backend::Rgba8> const& truth, backend::Image<Outcome> const& outcome) {
    Bands bands(36);
    bands.add([](double s) { return grey(14, 60, s); });                         // unasked
    bands.add([](double s) { return grey(14, 60, s); });                         // beyond
    bands.add([](double s) { return grey(34, 150, s); });                        // right
    bands.add([](double s) { return mix({112, 52, 44}, {168, 110, 96}, s); });   // edge_shadow
    bands.add([](double s) { return mix({40, 66, 112}, {96, 128, 176}, s); });   // edge_light
    bands.add([](double s) { return mix({226, 40, 24}, {255, 104, 70}, s); });   // false_shadow
    bands.add([](double s) { return mix({20, 120, 255}, {90, 190, 255}, s); });  // false_light
    IndexedPicture picture{backend::Image<std::uint8_t>(outcome.extent), {}};
    for (std::size_t i = 0; i < outcome.pixels.size(); ++i)
        picture.indices.pixels[i] = bands.index(static_cast<int>(outcome.pixels[i]), lightness(truth.pixels[i]));
    picture.palette = bands.take();
    return picture;
}

IndexedPicture overlay_picture(backend::Frame const& frame) {
    Bands bands(28);
    bands.add([](double s) { return grey(10, 235, s); });
    for (Colour const tint : tints) bands.add(toned(tint, 0.12, 0.45));
    IndexedPicture picture{backend::Image<std::uint8_t>(frame.colour.extent), {}};
    for (std::size_t i = 0; i < frame.colour.pixels.size(); ++i) {
        int const map = static_cast<int>(frame.position.pixels[i].w);
        int const band = map < 0 ? 0 : 1 + map % static_cast<int>(tints.size());
        picture.indices.pixels[i] = bands.index(band, lightness(frame.colour.pixels[i]));
    }
    picture.palette = bands.take();
    return picture;
}

IndexedPicture footprint_picture(backend::Frame const& frame, backend::Image<float> const& footprint) {
    constexpr int steps = 31;
    Bands bands(8);
    bands.add([](double s) { return grey(20, 96, s); });
    for (Colour const colour : footprint_scale(steps))
        bands.add([colour](double s) { return scaled(colour, 0.72 + 0.28 * s); });
    double const octaves = std::log2(coarsest_footprint / finest_footprint);
    IndexedPicture picture{backend::Image<std::uint8_t>(footprint.extent), {}};
    for (std::size_t i = 0; i < footprint.pixels.size(); ++i) {
        double const size = footprint.pixels[i];
        double const t = size > 0.0 ? std::clamp(std::log2(size / finest_footprint) / octaves, 0.0, 1.0) : 0.0;
        int const band = size > 0.0 ? 1 + static_cast<int>(std::lround(t * (steps - 1))) : 0;
        picture.indices.pixels[i] = bands.index(band, lightness(frame.colour.pixels[i]));
    }
    picture.palette = bands.take();
    return picture;
}

IndexedPicture maps_picture(std::span<backend::Image<float> const> depths,
                            std::span<backend::Image<std::uint8_t> const> touched) {
    constexpr int gap = 6;
    enum Band { paper, empty, empty_read, drawn, drawn_read };
    Bands bands(50);
    bands.add([](double) { return Colour{128, 132, 138}; });
    bands.add([](double) { return Colour{16, 20, 30}; });
    bands.add([](double) { return Colour{74, 52, 36}; });
    bands.add([](double s) { return mix({26, 34, 52}, {108, 130, 158}, s); });
    bands.add([](double s) { return mix({84, 44, 26}, {255, 238, 204}, s); });

    int const count = static_cast<int>(depths.size());
    int const size = count > 0 ? depths.front().extent.width : 0;
    int const shown = std::min(size, std::max(384, 1280 / std::max(count, 1)));
    IndexedPicture picture{backend::Image<std::uint8_t>({count * shown + std::max(count - 1, 0) * gap, shown}), {}};
    for (int map = 0; map < count; ++map) {
        auto const& depth = depths[static_cast<std::size_t>(map)];
        auto const& read = touched[static_cast<std::size_t>(map)];
        auto const [lo, hi] = contrast_range(depth);
        for (int y = 0; y < shown; ++y) {
            for (int x = 0; x < shown; ++x) {
                int const from_x = x * size / shown, to_x = std::max((x + 1) * size / shown, from_x + 1);
                int const from_y = y * size / shown, to_y = std::max((y + 1) * size / shown, from_y + 1);
                float nearest = 1.0f;
                bool is_read = false;
                for (int j = from_y; j < to_y; ++j)
                    for (int i = from_x; i < to_x; ++i)
                        nearest = std::min(nearest, depth.at(i, j)), is_read |= read.at(i, j) != 0;
                bool const is_drawn = nearest < 1.0f;
                Band const band = is_drawn ? (is_read ? drawn_read : drawn) : is_read ? empty_read : empty;
                picture.indices.at(map * (shown + gap) + x, y) =
                    bands.index(band, is_drawn ? 1.0 - double((nearest - lo) / (hi - lo)) : 0.0);
            }
        }
    }
    picture.palette = bands.take();
    return picture;
}

}  // namespace shadowmath::gallery
