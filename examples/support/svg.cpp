// SPDX-License-Identifier: MIT
#include "examples/support/svg.hpp"

#include <cmath>
#include <cstdio>

namespace shadowmath::example {
namespace {

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2f", std::isfinite(value) ? value : 0.0);
    return text;
}

std::string attribute(std::string_view name, std::string_view value) {
    std::string text = " ";
    return text.append(name).append("=\"").append(escaped(value)).append("\"");
}

std::string attribute(std::string_view name, double value) {
    return attribute(name, number(value));
}

// The end of an element, with what the pointer hovering over it is told.
std::string closed(std::string_view element, std::string_view hint) {
    return hint.empty() ? "/>\n" : "><title>" + escaped(hint) + "</title></" + std::string(element) + ">\n";
}

}  // namespace

std::string escaped(std::string_view text) {
    std::string safe;
    for (char const c : text) {
        switch (c) {
            case '&': safe += "&amp;"; break;
            case '<': safe += "&lt;"; break;
            case '>': safe += "&gt;"; break;
            case '"': safe += "&quot;"; break;
            default: safe += c;
        }
    }
    return safe;
}

std::string figure(double value) {
    if (!std::isfinite(value) || value == 0.0) return "0";
    int const leading = static_cast<int>(std::floor(std::log10(std::abs(value))));
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", leading >= 2 ? 0 : std::min(2 - leading, 6), value);
    std::string shown = text;
    if (shown.find('.') != std::string::npos) {
        shown.erase(shown.find_last_not_of('0') + 1);
        if (shown.back() == '.') shown.pop_back();
    }
    return shown;
}

Svg::Svg(double width, double height, std::string_view title, std::string_view style)
    : text_("<svg class=\"chart\" role=\"img\" viewBox=\"0 0 " + number(width) + " " + number(height) +
            "\" xmlns=\"http://www.w3.org/2000/svg\"><title>" + escaped(title) + "</title>\n") {
    if (!style.empty()) text_.append("<style>").append(style).append("</style>\n");
}

void Svg::line(double x0, double y0, double x1, double y1, std::string_view css_class) {
    text_ += "<line" + attribute("x1", x0) + attribute("y1", y0) + attribute("x2", x1) + attribute("y2", y1) +
             attribute("class", css_class) + "/>\n";
}

void Svg::polyline(Points const& points, std::string_view css_class) {
    std::string path;
    for (auto const& [x, y] : points) path += number(x) + "," + number(y) + " ";
    text_ += "<polyline" + attribute("points", path) + attribute("class", css_class) + "/>\n";
}

void Svg::polygon(Points const& points, std::string_view css_class) {
    std::string path;
    for (auto const& [x, y] : points) path += number(x) + "," + number(y) + " ";
    text_ += "<polygon" + attribute("points", path) + attribute("class", css_class) + "/>\n";
}

void Svg::dot(double x, double y, double radius, std::string_view css_class, std::string_view hint) {
    text_ += "<circle" + attribute("cx", x) + attribute("cy", y) + attribute("r", radius) +
             attribute("class", css_class) + closed("circle", hint);
}

void Svg::rect(double x, double y, double width, double height, std::string_view css_class, std::string_view hint) {
    text_ += "<rect" + attribute("x", x) + attribute("y", y) + attribute("width", width) + attribute("height", height) +
             attribute("class", css_class) + closed("rect", hint);
}

void Svg::text(double x, double y, std::string_view anchor, std::string_view css_class, std::string_view text) {
    text_ += "<text" + attribute("x", x) + attribute("y", y) + attribute("text-anchor", anchor) +
             attribute("class", css_class) + ">" + escaped(text) + "</text>\n";
}

}  // namespace shadowmath::example
