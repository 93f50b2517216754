// SPDX-License-Identifier: MIT
//
// A drawing in metres, or any other unit, as an SVG file that looks the same on a light page and a dark one. x grows to
// the right and y up. Colours are classes:
//
//   c0 c1 c2 c3     filled, in the colours of four maps          ink  faint  dash     lines
//   s0 s1 s2 s3     lines of the same colours                    caster  ground       filled
#pragma once

#include "examples/support/svg.hpp"

#include <glm/vec2.hpp>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace shadowmath::example {

class Drawing {
public:
    // Shows [lo, hi], `width` pixels wide, at one scale for both axes.
    Drawing(std::string_view title, glm::dvec2 lo, glm::dvec2 hi, double width = 720.0);
    // The same, `height` pixels high whatever the unit of y.
    Drawing(std::string_view title, glm::dvec2 lo, glm::dvec2 hi, double width, double height);

    void area(std::vector<glm::dvec2> const& corners, std::string_view css_class);
    void path(std::vector<glm::dvec2> const& points, std::string_view css_class);
    void line(glm::dvec2 a, glm::dvec2 b, std::string_view css_class) { path({a, b}, css_class); }
    void box(glm::dvec2 lo, glm::dvec2 hi, std::string_view css_class);
    void circle(glm::dvec2 centre, double radius, std::string_view css_class);  // radius in the unit of x
    void dot(glm::dvec2 at, std::string_view css_class, double pixels = 3.0);
    // `pixels` away from the place, y down as in the file.
    void label(glm::dvec2 at, std::string_view text, std::string_view anchor = "start", glm::dvec2 pixels = {0, 0},
               std::string_view css_class = "label");

    // Throws std::runtime_error when the file cannot be written.
    void write(std::filesystem::path const& path) const;

private:
    [[nodiscard]] std::pair<double, double> place(glm::dvec2 at) const;

    Svg svg_;
    std::string title_;
    double width_;
    glm::dvec2 lo_, scale_;
    double height_;
};

}  // namespace shadowmath::example
