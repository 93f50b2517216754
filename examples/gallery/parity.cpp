// SPDX-License-Identifier: MIT
#include "examples/gallery/parity.hpp"

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <stdexcept>

namespace shadowmath::gallery {
namespace {

using backend::Image;
using backend::Rgba8;

// Depths lie in [0, 1], where the order of floats is that of their bits; + 0 makes one of both zeros.
long ulps_between(float a, float b) {
    return std::labs(long{std::bit_cast<std::int32_t>(a + 0.0f)} - long{std::bit_cast<std::int32_t>(b + 0.0f)});
}

template <class Pixel>
void demand_alike(Image<Pixel> const& a, Image<Pixel> const& b) {
    if (a.extent.width != b.extent.width || a.extent.height != b.extent.height)
        throw std::invalid_argument("parity: images of two sizes");
}

void compare(Parity& parity, Image<float> const& first, Image<float> const& other) {
    demand_alike(first, other);
    ++parity.maps;
    for (std::size_t i = 0; i < first.pixels.size(); ++i) {
        float const a = first.pixels[i], b = other.pixels[i];
        bool const is_covered = a < 1.0f;
        parity.covered_texels += is_covered;
        if (a == b) continue;
        if (is_covered != (b < 1.0f)) {
            ++parity.covered_in_one;
        } else {
            ++parity.unlike_texels;
            parity.largest_ulp = std::max(parity.largest_ulp, ulps_between(a, b));
        }
    }
}

void compare(Parity& parity, Image<Rgba8> const& first, Image<Rgba8> const& other) {
    demand_alike(first, other);
    ++parity.pictures;
    parity.pixels += static_cast<long>(first.pixels.size());
    for (int y = 0; y < first.extent.height; ++y)
        for (int x = 0; x < first.extent.width; ++x) {
            if (difference(first.at(x, y), other.at(x, y)) == 0) continue;
            ++parity.unlike_pixels;
            parity.unlike_off_edges += !is_edge(first, x, y);
        }
}

}  // namespace

int difference(Rgba8 a, Rgba8 b) {
    return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)});
}

bool is_edge(Image<Rgba8> const& picture, int x, int y) {
    for (int v = std::max(y - 1, 0); v <= std::min(y + 1, picture.extent.height - 1); ++v)
        for (int u = std::max(x - 1, 0); u <= std::min(x + 1, picture.extent.width - 1); ++u)
            if (difference(picture.at(u, v), picture.at(x, y)) > 4) return true;
    return false;
}

void compare(Parity& parity, Drawn const& first, Drawn const& other) {
    if (first.maps.size() != other.maps.size()) throw std::invalid_argument("parity: another number of maps");
    compare(parity, first.picture, other.picture);
    for (std::size_t i = 0; i < first.maps.size(); ++i) compare(parity, first.maps[i], other.maps[i]);
}

}  // namespace shadowmath::gallery
