// SPDX-License-Identifier: MIT
#include "examples/doctor/report.hpp"
#include "examples/doctor/find.hpp"

#include <algorithm>
#include <iomanip>
#include <sstream>

namespace shadowmath::doctor {
namespace {

constexpr std::size_t line_length = 100;

// As many words a line as fit.
std::string wrapped(std::string const& text, std::string const& first, std::string const& indent) {
    std::istringstream words(text);
    std::string out, line = first;
    bool fresh = true;
    for (std::string word; words >> word;) {
        if (!fresh && line.size() + 1 + word.size() > line_length) {
            out += line + "\n";
            line = indent;
            fresh = true;
        }
        line += (fresh ? "" : " ") + word;
        fresh = false;
    }
    return out + line + "\n";
}

std::string padded(std::string const& text, std::size_t width) {
    // Letters, not bytes: what continues a letter in UTF-8 takes no room.
    auto const letters = std::ranges::count_if(text, [](char c) { return (c & 0xC0) != 0x80; });
    std::size_t const room = width > std::size_t(letters) ? width - std::size_t(letters) : 0;
    return std::string(room, ' ') + text;
}

std::string table(std::vector<std::vector<std::string>> const& rows) {
    std::string out;
    for (auto const& cells : rows) {
        std::string line;
        for (std::size_t column = 0; column < cells.size(); ++column) {
            std::size_t width = 0;
            for (auto const& other : rows) width = std::max(width, other[column].size());
            std::string const cell = padded(cells[column], width);
            line += column == 0 ? cells[0] + std::string(width - cells[0].size(), ' ') : "  " + cell;
        }
        out += "  " + line + "\n";
    }
    return out;
}

std::string both(double texels, double metres) {
    return digits(texels) + " = " + digits(metres) + " m";
}

std::string figures(Case const& read, Diagnosis const& diagnosis) {
    std::vector<std::vector<std::string>> rows{
        {"map", "size", "range m", "points", "used", "texel m", "depth m", "px a texel: median", "95 %", "worst"}};
    std::vector<std::vector<std::string>> biases{{"map", "a plane needs, texels", "it gets, texels"}};
    for (std::size_t m = 0; m < read.frame.maps.size(); ++m) {
        EngineMap const& map = read.frame.maps[m];
        MapFigures const& f = diagnosis.maps[m];
        std::string const range = map.range ? digits(map.range->begin) + " - " + digits(map.range->end) : "";
        rows.push_back({map.name, std::to_string(map.size), range, std::to_string(f.points), percent(f.used),
                        digits(f.texel_metres), digits(f.depth_metres), digits(f.footprint.median),
                        digits(f.footprint.p95), digits(f.footprint.worst)});
        biases.push_back({map.name, both(f.needed_texels, f.needed_metres),
                          read.bias.given ? both(f.bias_texels, f.bias_metres) : "not stated"});
    }
    return table(rows) + "\nBias along the light (for 95 % of the surfaces; at the median):\n" + table(biases);
}

// Findings of one kind, with what would mend them all said once.
std::string group_text(Case const& read, std::span<Finding const> group, int number) {
    std::string const count = std::to_string(number) + ". ";
    std::string const indent(count.size(), ' ');
    std::string out = count + id(group[0].ill) + "\n", mend;
    for (Finding const& finding : group) {
        std::string const of = finding.map < 0 ? "" : "\"" + read.frame.maps[std::size_t(finding.map)].name + "\": ";
        out += wrapped(of + finding.what, indent, indent + "  ");
        if (finding.mend != mend) out += wrapped("Mend: " + finding.mend, indent + "  ", indent + "    ");
        mend = finding.mend;
    }
    return out;
}

}  // namespace

std::string report(Case const& read, Sight const& sight, Diagnosis const& diagnosis, std::span<Advice const> advice) {
    std::ostringstream out;
    if (!read.about.empty()) out << wrapped(read.about, "", "") << '\n';
    for (std::string const& line : read.unknown_keys) out << line << '\n';
    if (!read.unknown_keys.empty()) out << '\n';
    out << sight.points.size() << (sight.traced ? " visible points" : " points of the view, without a scene,")
        << " up to " << digits(read.shadow_distance) << " m";
    if (sight.traced) {
        auto const dark = std::ranges::count_if(sight.points, [](Seen const& seen) { return seen.dark; });
        out << ", " << dark << " of them in shadow";
    }
    out << ".\n" << figures(read, diagnosis);
    out << "\nAll maps: " << digits(diagnosis.footprint.median) << " eye pixels a texel at the median, "
        << digits(diagnosis.footprint.p95) << " at the 95th percentile, " << digits(diagnosis.footprint.worst)
        << " at worst.\n";
    for (Advice const& other : advice)
        out << "With as many maps of this size, shadowmath's "
            << (other.fit == CascadeFit::stable ? "stable" : "tightest") << " fit at lambda " << digits(other.lambda)
            << ": " << digits(other.footprint.median) << ", " << digits(other.footprint.p95) << ", "
            << digits(other.footprint.worst) << ".\n";
    std::vector<std::span<Finding const>> groups;
    std::span<Finding const> rest(diagnosis.findings);
    std::size_t faults = 0;
    while (!rest.empty()) {
        auto const other = std::ranges::find_if(
            rest, [&](Finding const& finding) { return finding.ill != rest[0].ill || finding.fault != rest[0].fault; });
        groups.push_back(rest.first(static_cast<std::size_t>(other - rest.begin())));
        if (rest[0].fault) ++faults;
        rest = rest.subspan(groups.back().size());
    }
    out << '\n'
        << (faults == 0   ? "Nothing is wrong with these maps."
            : faults == 1 ? "One thing is wrong:"
                          : std::to_string(faults) + " things are wrong:")
        << '\n';
    for (std::size_t i = 0; i < groups.size(); ++i) {
        if (i == faults) out << "\nRemarks, which may be as they should:\n";
        out << '\n' << group_text(read, groups[i], static_cast<int>(i + 1));
    }
    return out.str();
}

}  // namespace shadowmath::doctor
