// SPDX-License-Identifier: MIT
#include "examples/quality/report.hpp"

#include <nlohmann/json.hpp>

#include <cstdio>

namespace shadowmath::quality {
namespace {

template <class... Values>
std::string formatted(char const* format, Values... values) {
    char text[256];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

}  // namespace

std::string table(Results const& results) {
    std::string text = formatted("%-34s %7s %7s %7s %6s | %6s %6s %6s | %5s %5s %6s %8s\n", "% of off-edge pixels wrong",
                                 "mean", "geom.", "worst", "/folk", "px", "p95", "used%", "ok%", "all%", "dark", "ms");
    for (Summary const& s : summaries(results))
        text += formatted("%-34s %7.4f %7.4f %7.3f %6.3f | %6.3f %6.2f %6.1f | %5.1f %5.1f %6ld %8.2f\n",
                          s.policy.title.c_str(), 100.0 * s.mean, 100.0 * s.geometric_mean, 100.0 * s.worst,
                          s.of_best_folk, s.footprint_mean, s.footprint_p95, 100.0 * s.texels_used,
                          100.0 * s.not_worse, 100.0 * s.not_worse_than_any, s.dark_unmapped, s.fit_milliseconds);
    text += formatted("%zu views\n", results.views.size());
    for (std::string const& what : results.absent) text += "ABSENT, not studied: " + what + "\n";
    return text;
}

std::string results_json(Settings const& settings, Results const& results) {
    using Json = nlohmann::ordered_json;
    Json views = Json::array(), rows = Json::array();
    for (ViewResult const& view : results.views) {
        Json scores = Json::array();
        for (Score const& s : view.scores)
            scores.push_back({{"policy", s.policy},
                              {"wrong", s.wrong},
                              {"off_edge_pixels", s.off_edge_pixels},
                              {"footprint_mean", s.footprint_mean},
                              {"footprint_p95", s.footprint_p95},
                              {"texels_used", s.texels_used},
                              {"dark_unmapped", s.dark_unmapped},
                              {"maps", s.maps},
                              {"fit_milliseconds", s.fit_milliseconds},
                              {"note", s.note}});
        views.push_back({{"scene", view.scene},
                         {"view", view.view},
                         {"shadow_distance", view.shadow_distance},
                         {"scores", scores}});
    }
    for (Summary const& s : summaries(results))
        rows.push_back({{"policy", s.policy.id},
                        {"title", s.policy.title},
                        {"mean", s.mean},
                        {"geometric_mean", s.geometric_mean},
                        {"worst", s.worst},
                        {"worst_view", s.worst_view},
                        {"of_best_folk", s.of_best_folk},
                        {"footprint_mean", s.footprint_mean},
                        {"footprint_p95", s.footprint_p95},
                        {"texels_used", s.texels_used},
                        {"not_worse", s.not_worse},
                        {"not_worse_than_any", s.not_worse_than_any},
                        {"dark_unmapped", s.dark_unmapped},
                        {"fit_milliseconds", s.fit_milliseconds}});
    return Json{{"width", settings.extent.width},
                {"height", settings.extent.height},
                {"map_size", map_size},
                {"maps", map_count},
                {"driver", results.driver},
                {"absent", results.absent},
                {"policies", rows},
                {"views", views}}
        .dump(1);
}

std::string page(Settings const&, Results const&) {
    return {};
}

}  // namespace shadowmath::quality
