// SPDX-License-Identifier: MIT
#include "examples/gallery/page.hpp"

#include "examples/gallery/chart.hpp"

#include "gallery/page_text.hpp"  // made by page/embed.cmake

#include <string_view>
#include <utility>

namespace shadowmath::gallery {
namespace {

// Inside a script element "</" could end it; JSON may write the slash as "\/".
std::string for_script(std::string const& json) {
    std::string safe;
    safe.reserve(json.size());
    for (std::size_t i = 0; i < json.size(); ++i) {
        if (json[i] == '<' && i + 1 < json.size() && (json[i + 1] == '/' || json[i + 1] == '!')) {
            safe += "\\u003c";
        } else {
            safe += json[i];
        }
    }
    return safe;
}

}  // namespace

std::string page(std::span<Technique const> techniques, Results const& results, std::string const& json,
                 std::string const& speed) {
    std::pair<std::string_view, std::string> const parts[] = {
        {"@STYLE@", page_css},
        {"@SCRIPT@", page_js},
        {"@TECHNIQUE_CHART@", technique_chart(techniques, results)},
        {"@SPLITS_CHART@", splits_chart()},
        {"@ALIASING_CHART@", aliasing_chart()},
        {"@SPEED@", speed},
        {"@DATA@", for_script(json)},
    };
    std::string text = page_html;
    for (auto const& [mark, part] : parts)
        if (std::size_t const place = text.find(mark); place != std::string::npos)
            text.replace(place, mark.size(), part);
    return text;
}

}  // namespace shadowmath::gallery
