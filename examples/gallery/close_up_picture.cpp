// SPDX-License-Identifier: MIT
#include "examples/gallery/close_up_picture.hpp"

#include "examples/gallery/techniques.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace shadowmath::gallery {
namespace {

double linear_of(std::uint8_t byte) {
    static std::array<double, 256> const table = [] {
        std::array<double, 256> made{};
        for (std::size_t i = 0; i < made.size(); ++i) {
            double const c = static_cast<double>(i) / 255.0;
            made[i] = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
        }
        return made;
    }();
    return table[byte];
}

std::uint8_t srgb_of(double linear) {
    double const c = std::clamp(linear, 0.0, 1.0);
    return static_cast<std::uint8_t>(
        std::lround(255.0 * (c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1.0 / 2.4) - 0.055)));
}

// The direct light is linear in the visibility.
backend::Rgba8 mixed(backend::Rgba8 dark, backend::Rgba8 light, double share) {
    auto const channel = [&](std::uint8_t d, std::uint8_t l) {
        return d == l ? d : srgb_of(linear_of(d) + (linear_of(l) - linear_of(d)) * share);
    };
    return {channel(dark.r, light.r), channel(dark.g, light.g), channel(dark.b, light.b), 255};
}

}  // namespace

CloseUpPicture close_up_picture(backend::Backend& backend, scenes::View const& view, backend::Extent extent) {
    CloseUpPicture picture;
    picture.extent = extent;
    picture.light = directional(view.light_travel);
    picture.view = perspective_view(pose_looking(view.eye, view.forward, view.up), view.fov_y_radians,
                                    double(extent.width) / double(extent.height), view.z_near, view.shadow_distance);
    ViewVolume<float> const eye = perspective_view(
        pose_looking(glm::vec3(view.eye), glm::vec3(view.forward), glm::vec3(view.up)), float(view.fov_y_radians),
        float(extent.width) / float(extent.height), float(view.z_near), float(view.shadow_distance));
    picture.frame = pixel_frame(eye, extent.width, extent.height);

    backend::FrameConstants const lit = unshadowed(view, extent);
    backend::FrameConstants dark = lit;
    dark.light_colour = glm::vec4(0.0f);
    backend.draw_scene({extent, dark});
    picture.in_dark = backend.read_frame().colour;
    backend.draw_scene({extent, lit});
    backend::Frame frame = backend.read_frame();
    picture.in_light = std::move(frame.colour);
    for (std::size_t i = 0; i < frame.position.pixels.size(); ++i) {
        backend::Texel4 const& p = frame.position.pixels[i];
        backend::Texel4 const& n = frame.normal.pixels[i];
        glm::vec3 const point(p.x, p.y, p.z);
        float const depth = glm::dot(eye.pose.forward, point - eye.pose.position);
        bool const shown = p.w > -1.5f && depth > eye.z_near && depth < eye.z_far;
        picture.point.push_back(shown ? point : glm::vec3(0.0f));
        picture.normal.push_back(shown ? glm::vec3(n.x, n.y, n.z) : glm::vec3(0.0f));
        picture.depth.push_back(shown ? depth : 0.0f);
    }
    return picture;
}

backend::Image<backend::Rgba8> shaded(CloseUpPicture const& picture, std::vector<float> const& visibility) {
    backend::Image<backend::Rgba8> image(picture.extent);
    for (std::size_t i = 0; i < picture.size(); ++i)
        image.pixels[i] = mixed(picture.in_dark.pixels[i], picture.in_light.pixels[i], double(visibility[i]));
    return image;
}

backend::Image<backend::Rgba8> visibility_difference(CloseUpPicture const& picture, std::vector<float> const& truth,
                                                     std::vector<float> const& answer) {
    constexpr glm::dvec3 too_dark(242, 65, 42), too_light(47, 150, 255);
    backend::Image<backend::Rgba8> image = shaded(picture, truth);
    for (std::size_t i = 0; i < picture.size(); ++i) {
        backend::Rgba8& pixel = image.pixels[i];
        glm::dvec3 const grey(20.0 + 0.5 * (0.299 * pixel.r + 0.587 * pixel.g + 0.114 * pixel.b));
        double const error = picture.shows(i) && picture.faces_light(i) ? double(answer[i]) - double(truth[i]) : 0.0;
        // A root, so that an eighth of the light, which the eye sees, is not lost in grey.
        glm::dvec3 const c = glm::mix(grey, error < 0.0 ? too_dark : too_light, std::sqrt(std::abs(error)));
        pixel = {std::uint8_t(c.r), std::uint8_t(c.g), std::uint8_t(c.b), 255};
    }
    return image;
}

}  // namespace shadowmath::gallery
