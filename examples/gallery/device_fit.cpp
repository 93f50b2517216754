// SPDX-License-Identifier: MIT
#include "examples/gallery/device_fit.hpp"

#include <stdexcept>

namespace shadowmath::gallery {

void compare(FitRecord& record, std::span<backend::MapConstants const> fitted, Drawn const& on_device,
             MapSet const& cpp, Drawn const& from_cpp) {
    if (fitted.size() < cpp.maps.size()) throw std::invalid_argument("device fit: fewer maps than the C++ makes");
    for (std::size_t i = 0; i < cpp.maps.size(); ++i) {
        backend::MapConstants const &a = fitted[i], &b = cpp.frame.maps[i];
        ++record.maps;
        record.unlike_maps +=
            a.clip_from_world != b.clip_from_world || a.depth_end != b.depth_end || a.blend_begin != b.blend_begin;
    }
    Parity drawn;
    compare(drawn, from_cpp, on_device);
    ++record.pictures;
    for (auto const& map : from_cpp.maps) record.texels += static_cast<long>(map.pixels.size());
    record.unlike_texels += drawn.covered_in_one + drawn.unlike_texels;
    record.pixels += drawn.pixels;
    record.unlike_pixels += drawn.unlike_pixels;
}

}  // namespace shadowmath::gallery
