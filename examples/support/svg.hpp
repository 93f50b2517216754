// SPDX-License-Identifier: MIT
//
// The few marks that a chart needs, as SVG text. Colours are classes: those of the page that it stands in, or of the
// style sheet that it brings along.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace shadowmath::example {

using Points = std::vector<std::pair<double, double>>;

// `text` for use inside HTML, SVG and attribute values.
[[nodiscard]] std::string escaped(std::string_view text);

class Svg {
public:
    // width, height: of the view box; title: what a screen reader says; style: CSS, for a file that stands alone.
    Svg(double width, double height, std::string_view title, std::string_view style = {});

    void line(double x0, double y0, double x1, double y1, std::string_view css_class);
    void polyline(Points const& points, std::string_view css_class);
    void polygon(Points const& points, std::string_view css_class);
    void dot(double x, double y, double radius, std::string_view css_class, std::string_view hint = {});
    void rect(double x, double y, double width, double height, std::string_view css_class, std::string_view hint = {});
    void text(double x, double y, std::string_view anchor, std::string_view css_class, std::string_view text);

    [[nodiscard]] std::string str() const { return text_ + "</svg>\n"; }

private:
    std::string text_;
};

// A number as people write it: three significant digits, no exponent.
[[nodiscard]] std::string figure(double value);

}  // namespace shadowmath::example
