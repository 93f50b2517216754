// SPDX-License-Identifier: MIT
#include "examples/gallery/speed.hpp"

#include "examples/support/svg.hpp"

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <vector>

namespace shadowmath::gallery {
namespace {

std::string with_digits(double value, int digits, char const* unit) {
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%.*f%s", digits, value, unit);
    return text.data();
}

// Three digits.
std::string three(double value, char const* unit) {
    double const size = std::abs(value);
    return with_digits(value, size < 9.995 ? 2 : (size < 99.95 ? 1 : 0), unit);
}

std::string time(double nanoseconds) {
    // What an include costs above GLM may be less than nothing.
    double const size = std::abs(nanoseconds);
    if (size < 1e3) return three(nanoseconds, "&nbsp;ns");
    if (size < 1e6) return three(nanoseconds / 1e3, "&nbsp;µs");
    return three(nanoseconds / 1e6, "&nbsp;ms");
}

std::string cell(std::string const& text, char const* classes = "") {
    return "<td" + (*classes != '\0' ? " class=\"" + std::string(classes) + "\"" : std::string()) + ">" + text +
           "</td>";
}

std::string row(nlohmann::json const& entry) {
    bool const has_goal = entry.at("goal").is_number(), is_include = entry.at("flags") == "-fsyntax-only";
    std::string line = "<tr><th scope=\"row\">" + example::escaped(entry.at("name").get<std::string>()) + "</th>";
    line += cell(example::escaped(entry.at("reference").get<std::string>()), "left");
    line += cell(time(entry.at("ours_ns"))) + cell(time(entry.at("reference_ns")));
    line += cell(three(entry.at("ratio"), "&nbsp;×"));
    if (!has_goal) return line + cell("") + cell("") + "</tr>\n";
    line += cell((is_include ? "≤ " : "≥ ") + three(entry.at("goal"), "&nbsp;×"));
    return line + cell(entry.at("met").get<bool>() ? "met" : "missed", "left") + "</tr>\n";
}

}  // namespace

std::string speed_table(std::filesystem::path const& ratios) {
    std::ifstream file(ratios);
    if (!file)
        return "<p class=\"about\">Nothing has been timed here yet: <code>scripts/bench</code> does that in some "
               "minutes, "
               "and the next <code>scripts/demo</code> shows its table in this place.</p>\n";
    nlohmann::json entries;
    try {
        entries = nlohmann::json::parse(file);
    } catch (nlohmann::json::exception const& error) {
        throw std::runtime_error(ratios.string() + ": " + error.what());
    }
    std::vector<std::string> builds;
    for (auto const& entry : entries)
        if (std::string const flags = entry.at("flags"); builds.empty() || builds.back() != flags)
            builds.push_back(flags);
    std::string html;
    for (std::string const& flags : builds) {
        html +=
            "<h3>" + example::escaped(flags == "-fsyntax-only" ? "What an include costs, above GLM" : "g++ " + flags) +
            "</h3>\n<div class=\"scroll sticky-head tall\"><table><thead><tr><th scope=\"col\" class=\"left\">Job</th>"
            "<th scope=\"col\" class=\"left\">Against</th><th scope=\"col\">Ours</th><th scope=\"col\">Its</th>"
            "<th scope=\"col\">Ratio</th><th scope=\"col\">Goal</th><th scope=\"col\" class=\"left\"></th></tr></thead>"
            "<tbody>\n";
        for (auto const& entry : entries)
            if (entry.at("flags") == flags) html += row(entry);
        html += "</tbody></table></div>\n";
    }
    return html;
}

}  // namespace shadowmath::gallery
