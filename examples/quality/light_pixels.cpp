// SPDX-License-Identifier: MIT
#include "examples/quality/light_pixels.hpp"

#include <shadowmath/fit_quad.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/view_volume.hpp>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <cmath>

namespace shadowmath::quality {

std::vector<LightPixel> light_pixels(std::vector<SurfacePoint<double>> const& surfaces, scenes::View const& view,
                                     backend::Extent extent) {
    Pose<double> const pose = pose_looking(view.eye, view.forward, view.up);
    LightBasis<double> const basis = light_basis(view.light_travel);
    double const top = std::tan(view.fov_y_radians / 2.0), scale = 0.5 * extent.height / top;
    std::vector<LightPixel> pixels;
    for (SurfacePoint<double> const& surface : surfaces) {
        glm::dvec3 const from_eye = surface.point - pose.position, n = glm::normalize(surface.normal);
        LightPixel pixel;
        double const depth = glm::dot(pose.forward, from_eye), lean = -glm::dot(n, basis.depth);
        pixel.seen = {glm::dot(pose.right, from_eye) / depth, glm::dot(pose.up, from_eye) / depth, depth};
        pixel.place = {glm::dot(basis.x, from_eye), glm::dot(basis.y, from_eye)};
        auto const gain = [&](glm::dvec3 const& axis) {
            glm::dvec3 const way = axis + basis.depth * (glm::dot(n, axis) / lean);
            double const away = glm::dot(pose.forward, way);
            return glm::dvec2(glm::dot(pose.right, way) - pixel.seen.x * away,
                              glm::dot(pose.up, way) - pixel.seen.y * away) *
                   (scale / depth);
        };
        pixel.gain_x = gain(basis.x);
        pixel.gain_y = gain(basis.y);
        if (depth > 0.0 && lean > 0.0) pixels.push_back(pixel);
    }
    return pixels;
}

Quad<double> quad_of(glm::dmat4 const& clip_from_world, scenes::View const& view, double share) {
    LightBasis<double> const basis = light_basis(view.light_travel);
    glm::dmat4 const rows = glm::transpose(clip_from_world);
    auto const on_plane = [&](glm::dvec4 const& row) {
        glm::dvec3 const n(row);
        return glm::dvec3(glm::dot(n, basis.x), glm::dot(n, basis.y), row.w + glm::dot(n, view.eye));
    };
    Quad<double> quad;
    quad.x = on_plane(rows[0]) / share;
    quad.y = on_plane(rows[1]) / share;
    quad.w = on_plane(rows[3]);
    for (unsigned i = 0; i < 4; ++i) {
        double const x = (i & 1u) != 0 ? 1.0 : -1.0, y = (i & 2u) != 0 ? 1.0 : -1.0;
        glm::dvec3 const corner = glm::cross(quad.x - x * quad.w, quad.y - y * quad.w);
        quad.corner[i] = glm::dvec2(corner) / corner.z;
    }
    quad.visible = true;
    return quad;
}

double major_in(Quad<double> const& quad, double usable_texels, LightPixel const& pixel) {
    glm::dvec3 const p(pixel.place, 1.0);
    double const w = glm::dot(quad.w, p);
    if (!(w > 0.0) || std::abs(glm::dot(quad.x, p)) > w || std::abs(glm::dot(quad.y, p)) > w) return outside;
    LightSample<double> sample;
    sample.place = pixel.place;
    sample.gain_x = pixel.gain_x;
    sample.gain_y = pixel.gain_y;
    return major_at(quad, usable_texels, sample);
}

}  // namespace shadowmath::quality
