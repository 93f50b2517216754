// SPDX-License-Identifier: MIT
#include "examples/support/png.hpp"

#include <png.h>

#include <stdexcept>

namespace shadowmath::example {
namespace {

void write(std::filesystem::path const& path, backend::Extent extent, std::uint32_t format, int channels,
           std::uint8_t const* pixels, Colour const* palette, std::size_t palette_size) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(extent.width);
    image.height = static_cast<png_uint_32>(extent.height);
    image.format = format;
    image.colormap_entries = static_cast<png_uint_32>(palette_size);
    // A negative stride is libpng's word for "the bottom row comes first".
    if (png_image_write_to_file(&image, path.c_str(), 0, pixels, -extent.width * channels, palette) == 0)
        throw std::runtime_error(path.string() + ": " + image.message);
}

}  // namespace

void write_png(std::filesystem::path const& path, backend::Image<backend::Rgba8> const& picture) {
    std::vector<std::uint8_t> rgb;
    rgb.reserve(picture.pixels.size() * 3);
    for (backend::Rgba8 const p : picture.pixels) rgb.insert(rgb.end(), {p.r, p.g, p.b});
    write(path, picture.extent, PNG_FORMAT_RGB, 3, rgb.data(), nullptr, 0);
}

void write_png(std::filesystem::path const& path, IndexedPicture const& picture) {
    write(path, picture.indices.extent, PNG_FORMAT_RGB_COLORMAP, 1, picture.indices.pixels.data(),
          picture.palette.data(), picture.palette.size());
}

}  // namespace shadowmath::example
