// SPDX-License-Identifier: MIT
#include "examples/support/drawing.hpp"

#include <fstream>
#include <stdexcept>

namespace shadowmath::example {
namespace {

constexpr double border = 14.0, head = 30.0;

// Blue, orange, green, purple: told apart by any eye, and in grey.
constexpr std::string_view style = R"(
.page,.head{fill:#fbfaf7}.frame{fill:none;stroke:#d9d5cc}
text{font:13px system-ui,sans-serif;fill:#38342c}
.title{font-size:15px;font-weight:600}
.small{font-size:11px;fill:#6d675c}
.c0{fill:#3b78b8;fill-opacity:.28;stroke:#2d6099}.c1{fill:#e08a2e;fill-opacity:.3;stroke:#b96d1b}
.c2{fill:#4a9a55;fill-opacity:.3;stroke:#38783f}.c3{fill:#8a5fb0;fill-opacity:.3;stroke:#6d4791}
.s0,.s1,.s2,.s3{fill:none;stroke-width:2}
.s0{stroke:#3b78b8}.s1{stroke:#e08a2e}.s2{stroke:#4a9a55}.s3{stroke:#8a5fb0}
.d0{fill:#3b78b8}.d1{fill:#e08a2e}.d2{fill:#4a9a55}.d3{fill:#8a5fb0}.d4{fill:#b9b3a6}
.ink{fill:none;stroke:#38342c;stroke-width:1.5}.faint{fill:none;stroke:#d3cec2}
.dash{fill:none;stroke:#6d675c;stroke-dasharray:5 4}.light{fill:none;stroke:#d9a400;stroke-width:1.5}
.caster{fill:#6d675c;stroke:#38342c}.ground{fill:#e7e2d6;stroke:#a9a293}.dark{fill:#38342c;fill-opacity:.45}
)";

}  // namespace

Drawing::Drawing(std::string_view title, glm::dvec2 lo, glm::dvec2 hi, double width)
    : Drawing(title, lo, hi, width, (width - 2 * border) * (hi.y - lo.y) / (hi.x - lo.x) + 2 * border + head) {}

Drawing::Drawing(std::string_view title, glm::dvec2 lo, glm::dvec2 hi, double width, double height)
    : svg_(width, height, title, style), title_(title), width_(width), lo_(lo),
      scale_((glm::dvec2(width, height - head) - 2 * border) / (hi - lo)), height_(height) {
    svg_.rect(0, 0, width, height, "page");
}

std::pair<double, double> Drawing::place(glm::dvec2 at) const {
    return {border + (at.x - lo_.x) * scale_.x, height_ - border - (at.y - lo_.y) * scale_.y};
}

void Drawing::area(std::vector<glm::dvec2> const& corners, std::string_view css_class) {
    Points points;
    for (glm::dvec2 const corner : corners) points.push_back(place(corner));
    svg_.polygon(points, css_class);
}

void Drawing::path(std::vector<glm::dvec2> const& points, std::string_view css_class) {
    Points placed;
    for (glm::dvec2 const point : points) placed.push_back(place(point));
    svg_.polyline(placed, css_class);
}

void Drawing::box(glm::dvec2 lo, glm::dvec2 hi, std::string_view css_class) {
    area({lo, {hi.x, lo.y}, hi, {lo.x, hi.y}}, css_class);
}

void Drawing::circle(glm::dvec2 centre, double radius, std::string_view css_class) {
    auto const [x, y] = place(centre);
    svg_.dot(x, y, radius * scale_.x, css_class);
}

void Drawing::dot(glm::dvec2 at, std::string_view css_class, double pixels) {
    auto const [x, y] = place(at);
    svg_.dot(x, y, pixels, css_class);
}

void Drawing::label(glm::dvec2 at, std::string_view text, std::string_view anchor, glm::dvec2 pixels,
                    std::string_view css_class) {
    auto const [x, y] = place(at);
    svg_.text(x + pixels.x, y + pixels.y, anchor, css_class, text);
}

void Drawing::write(std::filesystem::path const& path) const {
    // Over whatever reaches beyond the range.
    Svg titled = svg_;
    titled.rect(0, 0, width_, head + 6, "head");
    titled.text(border, 24, "start", "title", title_);
    titled.rect(0.5, 0.5, width_ - 1, height_ - 1, "frame");
    std::ofstream file(path, std::ios::binary);
    file << titled.str();
    file.close();
    if (!file) throw std::runtime_error(path.string() + ": cannot be written");
}

}  // namespace shadowmath::example
