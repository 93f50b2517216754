// SPDX-License-Identifier: MIT
//
//   same_picture A          fails where the file is no picture, or one of a single colour
//   same_picture A B        and where B is another one
//
// SVG files are compared byte by byte. Of PNG files one pixel in a thousand may differ: a compiler that fuses a product
// and a sum moves a texel here and there.
#include <png.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

struct Pixels {
    unsigned width = 0, height = 0;
    std::vector<unsigned char> rgb;
};

Pixels read_png(std::filesystem::path const& path) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    if (png_image_begin_read_from_file(&image, path.c_str()) == 0)
        throw std::runtime_error(path.string() + ": " + image.message);
    image.format = PNG_FORMAT_RGB;
    Pixels pixels{image.width, image.height, std::vector<unsigned char>(PNG_IMAGE_SIZE(image))};
    if (png_image_finish_read(&image, nullptr, pixels.rgb.data(), 0, nullptr) == 0)
        throw std::runtime_error(path.string() + ": " + image.message);
    return pixels;
}

std::string read_text(std::filesystem::path const& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file) throw std::runtime_error(path.string() + ": cannot be read");
    return {std::istreambuf_iterator<char>(file), {}};
}

void refuse_if(bool wrong, std::filesystem::path const& path, char const* what) {
    if (wrong) throw std::runtime_error(path.string() + ": " + what);
}

void compare_png(std::filesystem::path const& a, std::filesystem::path const* b) {
    Pixels const one = read_png(a);
    std::set<std::string> colours;
    for (std::size_t i = 0; i + 2 < one.rgb.size() && colours.size() < 16; i += 3)
        colours.insert({reinterpret_cast<char const*>(&one.rgb[i]), 3});
    refuse_if(colours.size() < 16, a, "has fewer than sixteen colours");
    if (b == nullptr) return;
    Pixels const other = read_png(*b);
    refuse_if(one.width != other.width || one.height != other.height, *b, "is of another size");
    std::size_t different = 0;
    for (std::size_t i = 0; i + 2 < one.rgb.size(); i += 3) {
        int difference = 0;
        for (std::size_t c = i; c < i + 3; ++c) difference = std::max(difference, std::abs(one.rgb[c] - other.rgb[c]));
        different += difference > 2;
    }
    refuse_if(different * 1000 > std::size_t(one.width) * one.height, *b, "shows something else");
}

void compare_svg(std::filesystem::path const& a, std::filesystem::path const* b) {
    std::string const one = read_text(a);
    std::size_t marks = 0;
    for (std::size_t at = 0; (at = one.find("/>", at)) != std::string::npos; at += 2) ++marks;
    refuse_if(marks < 8 || one.find("</svg>") == std::string::npos, a, "is no drawing of eight marks and more");
    if (b != nullptr) refuse_if(read_text(*b) != one, *b, "draws something else");
}

}  // namespace

int main(int argc, char** argv) {
    try {
        if (argc < 2) throw std::runtime_error("same_picture A [B]");
        std::filesystem::path const a = argv[1], b = argc > 2 ? argv[2] : "";
        (a.extension() == ".png" ? compare_png : compare_svg)(a, argc > 2 ? &b : nullptr);
        return EXIT_SUCCESS;
    } catch (std::exception const& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return EXIT_FAILURE;
    }
}
