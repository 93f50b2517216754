// SPDX-License-Identifier: MIT
#include "examples/quality/report.hpp"

#include "examples/support/svg.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>

namespace shadowmath::quality {
namespace {

template <class... Values>
std::string formatted(char const* format, Values... values) {
    int const length = std::snprintf(nullptr, 0, format, values...);
    std::string text(std::size_t(std::max(length, 0)) + 1, '\0');
    std::snprintf(text.data(), text.size(), format, values...);
    text.pop_back();
    return text;
}

// Means over the views; 0 where nothing was sought.
Attainable attainable_of(Results const& results) {
    Attainable mean;
    double const count = double(results.views.size());
    for (ViewResult const& view : results.views) {
        if (!view.attainable) return {};
        mean.footprint_mean += view.attainable->footprint_mean / count;
        mean.footprint_p95 += view.attainable->footprint_p95 / count;
    }
    return mean;
}

}  // namespace

std::string table(Results const& results) {
    std::string text =
        formatted("%-34s %7s %7s %7s %6s | %6s %6s %6s %6s %6s | %6s %6s | %5s %5s %5s | %5s %5s %6s %8s\n",
                  "% of off-edge pixels wrong", "mean", "geom.", "worst", "/folk", "px", "p95", "(med.", "med.)",
                  "<=30", "persp.", "p95", "used%", "most%", "seen%", "ok%", "all%", "dark", "ms");
    for (Summary const& s : summaries(results))
        text += formatted(
            "%-34s %7.4f %7.4f %7.3f %6.3f | %6.2f %6.2f %6.2f %6.2f %6.3f | %6.3f %6.2f | %5.1f %5.1f %5.1f | "
            "%5.1f "
            "%5.1f %6ld %8.2f\n",
            s.policy.title.c_str(), 100.0 * s.mean, 100.0 * s.geometric_mean, 100.0 * s.worst, s.of_best_folk,
            s.footprint_mean, s.footprint_p95, s.footprint_mean_median, s.footprint_p95_median, s.figures.capped_mean,
            s.figures.perspective_mean, s.figures.perspective_p95, 100.0 * s.texels_used, 100.0 * s.figures.texels_most,
            100.0 * s.figures.texels_seen, 100.0 * s.not_worse, 100.0 * s.not_worse_than_any, s.dark_unmapped,
            s.fit_milliseconds);
    text += formatted("%zu views. px, p95: mean over the views, and their medians in brackets; <=30: the mean "
                      "with no pixel counting more than 30, where the shadow is lost. persp.: the same without the "
                      "surface's own share of it, cos(eye) / cos(light).\n"
                      "used: texels that the filter reads for the pixels' centres; most: that so many pixels could "
                      "read; seen: for points all over the pixels.\n",
                      results.views.size());
    if (Attainable const best = attainable_of(results); best.footprint_mean > 0.0)
        text += formatted(
            "A search of many thousand steps in each view, of four free homographies on the exact pixels, has "
            "found px %.2f and p95 %.2f, each sought alone.\n",
            best.footprint_mean, best.footprint_p95);
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
                              {"footprint_median", s.figures.footprint_median},
                              {"capped_mean", s.figures.capped_mean},
                              {"perspective_mean", s.figures.perspective_mean},
                              {"perspective_p95", s.figures.perspective_p95},
                              {"texels_used", s.texels_used},
                              {"texels_most", s.figures.texels_most},
                              {"texels_seen", s.figures.texels_seen},
                              {"dark_unmapped", s.dark_unmapped},
                              {"maps", s.maps},
                              {"fit_milliseconds", s.fit_milliseconds},
                              {"note", s.note}});
        views.push_back({{"scene", view.scene},
                         {"view", view.view},
                         {"shadow_distance", view.shadow_distance},
                         {"scores", scores}});
        if (view.attainable)
            views.back()["attainable"] = {{"footprint_mean", view.attainable->footprint_mean},
                                          {"footprint_p95", view.attainable->footprint_p95}};
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
                        {"footprint_mean_median", s.footprint_mean_median},
                        {"footprint_p95_median", s.footprint_p95_median},
                        {"perspective_mean", s.figures.perspective_mean},
                        {"perspective_p95", s.figures.perspective_p95},
                        {"texels_used", s.texels_used},
                        {"texels_seen", s.figures.texels_seen},
                        {"not_worse", s.not_worse},
                        {"not_worse_than_any", s.not_worse_than_any},
                        {"dark_unmapped", s.dark_unmapped},
                        {"fit_milliseconds", s.fit_milliseconds}});
    return Json{{"width", settings.extent.width},
                {"height", settings.extent.height},
                {"map_size", map_size},
                {"maps", map_count},
                {"driver", results.driver},
                {"fresh", settings.fresh ? Json(*settings.fresh) : Json()},
                {"absent", results.absent},
                {"policies", rows},
                {"views", views}}
        .dump(1);
}

namespace {

constexpr char const* page_head = R"(<!doctype html>
<html lang="en"><head><meta charset="utf-8"><title>shadowmath: picture truth at an equal budget</title>
<meta name="viewport" content="width=device-width"><style>
body { font: 15px/1.5 system-ui, sans-serif; margin: 2rem auto; max-width: 84rem; padding: 0 1rem; color: #222; }
h1 { font-weight: 600; } table { border-collapse: collapse; width: 100%; }
td, th { padding: .25rem .6rem; text-align: right; border-bottom: 1px solid #ddd; font-variant-numeric: tabular-nums; }
td:first-child, th:first-child { text-align: left; } td { white-space: nowrap; }
.folk { color: #888; } .chosen { font-weight: 600; }
figure { margin: 1rem 0; display: grid; grid-template-columns: repeat(3, 1fr); gap: .5rem; }
figure img { width: 100%; } figcaption { grid-column: 1 / -1; } .bar { fill: #8aa; } .bar.folk { fill: #ccc; }
.bar.chosen { fill: #2a7; } text { font-size: 12px; } .scale { height: 1rem; width: 16rem; vertical-align: middle; }
@media (prefers-color-scheme: dark) { body { background: #16181a; color: #ddd; } td, th { border-color: #333; }
.bar { fill: #577; } .bar.folk { fill: #444; } text { fill: #ddd; } }
</style></head><body>
)";

char const* class_of(Family family) {
    return family == Family::folk ? "folk" : family == Family::chosen ? "chosen" : "";
}

std::string rows_of(std::vector<Summary> const& all) {
    std::string text =
        "<table><tr><th>wrong, % of off-edge pixels</th><th>mean</th><th>geometric</th><th>worst</th><th>of the best "
        "recipe</th><th>footprint, px</th><th>95th</th><th>perspective alone</th><th>95th</th><th>texels used</th>"
        "<th>seen</th><th>not worse in</th><th>dark without a "
        "map</th><th>ms</th></tr>\n";
    for (Summary const& s : all)
        text += formatted("<tr class=\"%s\"><td>%s</td><td>%.4f</td><td>%.4f</td><td>%.3f</td><td>%.2f</td>"
                          "<td>%.2f</td><td>%.1f</td><td>%.2f</td><td>%.1f</td><td>%.0f %%</td><td>%.0f %%</td>"
                          "<td>%.0f %%</td><td>%ld</td><td>%.1f</td></tr>\n",
                          class_of(s.policy.family), example::escaped(s.policy.title).c_str(), 100.0 * s.mean,
                          100.0 * s.geometric_mean, 100.0 * s.worst, s.of_best_folk, s.footprint_mean, s.footprint_p95,
                          s.figures.perspective_mean, s.figures.perspective_p95, 100.0 * s.texels_used,
                          100.0 * s.figures.texels_seen, 100.0 * s.not_worse, s.dark_unmapped, s.fit_milliseconds);
    return text + "</table>\n";
}

std::string bars_of(std::vector<Summary> const& all) {
    double most = 1e-12;
    for (Summary const& s : all) most = std::max(most, s.mean);
    double const height = 22.0 * double(all.size());
    std::string text =
        formatted("<svg viewBox=\"0 0 900 %.0f\" role=\"img\" aria-label=\"mean share of wrong pixels\">", height);
    double y = 0.0;
    for (Summary const& s : all) {
        text += formatted("<text x=\"260\" y=\"%.0f\" text-anchor=\"end\">%s</text>"
                          "<rect class=\"bar %s\" x=\"270\" y=\"%.0f\" width=\"%.1f\" height=\"16\"/>"
                          "<text x=\"%.1f\" y=\"%.0f\">%.3f %%</text>\n",
                          y + 15.0, example::escaped(s.policy.title).c_str(), class_of(s.policy.family), y + 2.0,
                          540.0 * s.mean / most, 276.0 + 540.0 * s.mean / most, y + 15.0, 100.0 * s.mean);
        y += 22.0;
    }
    return text + "</svg>\n";
}

// The views in which the recipe to beat and the last choice differ most.
std::string heat_maps_of(Results const& results) {
    auto const wrong = [](ViewResult const& view, std::string const& policy) {
        for (Score const& score : view.scores)
            if (score.policy == policy) return score;
        return Score{};
    };
    std::vector<ViewResult const*> views;
    for (ViewResult const& view : results.views)
        if (view.pictures.size() > 1) views.push_back(&view);
    std::ranges::stable_sort(views, [&](ViewResult const* a, ViewResult const* b) {
        auto const gain = [&](ViewResult const& v) {
            return wrong(v, "folk-focus").wrong - wrong(v, "chosen-depth").wrong;
        };
        return gain(*a) > gain(*b);
    });
    if (views.size() > 8) views.resize(8);
    std::string text = "<h2>Why: eye pixels a texel</h2><p>From &frac14; (blue) to 16 (white); grey where no map is "
                       "asked. Beside each picture of the recipe to beat what was chosen for the same view.</p>\n";
    for (ViewResult const* view : views) {
        text += "<figure><figcaption><b>" + example::escaped(view->scene + ", " + view->view) + "</b>";
        for (auto const& [policy, file] : view->pictures) {
            Score const score = wrong(*view, policy);
            text +=
                formatted("; %s: %.3f %% wrong, %.2f px", policy.c_str(), 100.0 * score.wrong, score.footprint_mean);
        }
        text += "</figcaption>";
        for (auto const& [policy, file] : view->pictures)
            text += "<img src=\"" + file + "\" alt=\"footprints of " + policy + "\" title=\"" +
                    example::escaped(policy + ": " + wrong(*view, policy).note) + "\">";
        text += "</figure>\n";
    }
    return text;
}

}  // namespace

std::string page(Settings const& settings, Results const& results) {
    std::vector<Summary> const all = summaries(results);
    std::string text = page_head;
    text += formatted(
        "<h1>Picture truth at an equal budget</h1><p>%zu views of %d &times; %d pixels; %d maps of %d "
        "&times; %d texels for everybody, one bias rule, one filter (3 &times; 3). A pixel is wrong when it "
        "is on the other side of the light than ray tracing says, and no true edge is within a pixel and a "
        "quarter. Recipes choose a map by eye depth, everything else by what holds the point.</p>\n"
        "<p>A footprint is perspective aliasing times cos(eye) / cos(light), which is the surface's own and has no "
        "bound where the light grazes it; perspective alone is what maps decide. Texels are used where the "
        "filter reads them for the pixels' centres, seen where it would for points all over the pixels.</p>\n",
        results.views.size(), settings.extent.width, settings.extent.height, map_count, map_size, map_size);
    for (std::string const& what : results.absent)
        text += "<p><b>Absent, not studied:</b> " + example::escaped(what) + "</p>";
    return text + bars_of(all) + rows_of(all) + heat_maps_of(results) + "</body></html>\n";
}

}  // namespace shadowmath::quality
