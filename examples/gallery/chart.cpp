// SPDX-License-Identifier: MIT
#include "examples/gallery/chart.hpp"

#include "examples/support/svg.hpp"

#include <shadowmath/aliasing.hpp>
#include <shadowmath/footprint.hpp>
#include <shadowmath/splits.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>

namespace shadowmath::gallery {

using example::figure;
using example::Points;
using example::Svg;
namespace {

constexpr double z_near = 1.0, z_far = 1000.0;
constexpr double width = 720.0;

// Positions on a logarithmic scale.
struct LogAxis {
    double from_value, to_value, from_place, to_place;

    [[nodiscard]] double at(double value) const {
        double const t =
            std::log(std::clamp(value, from_value, to_value) / from_value) / std::log(to_value / from_value);
        return from_place + (to_place - from_place) * t;
    }
};

void depth_axis(Svg& svg, LogAxis const& x, double top, double bottom) {
    for (double const z : {1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0}) {
        svg.line(x.at(z), top, x.at(z), bottom, "grid");
        svg.text(x.at(z), bottom + 16, "middle", "tick", figure(z));
    }
    svg.text((x.from_place + x.to_place) / 2, bottom + 34, "middle", "tick", "eye depth, metres");
}

// A map of the depths begin to end under a light from straight above, `centre` behind its near end the centre of its
// projection (infinite: orthographic). World: x right, y up, eye at the origin looking along +z. The map's width is
// so small that a texel's longer axis always lies along the depth.
glm::dmat4 overhead_map(double begin, double end, double centre) {
    double const narrow = 1e-4;
    if (std::isinf(centre)) {
        double const scale = 2.0 / (end - begin);
        return from_rows<double>({1.0 / narrow, 0, 0, 0}, {0, 0, scale, -1.0 - scale * begin}, {0, -1e-3, 0, 0.5},
                                 {0, 0, 0, 1});
    }
    // y_ndc = A + B / w with w = z - begin + centre, -1 at begin and 1 at end.
    double const w0 = centre, w1 = centre + end - begin;
    double const b = -2.0 / (1.0 / w0 - 1.0 / w1), a = 1.0 - b / w1;
    glm::dvec4 const w(0, 0, 1, centre - begin);
    return from_rows<double>({1.0 / narrow, 0, 0, 0}, a * w + glm::dvec4(0, 0, 0, b), {0, -1e-3, 0, 0.5}, w);
}

// E(z) = (1/z) dz/ds of a map, by way of the footprint: at a point on the view axis, on a plane that leans equally
// toward eye and light, where no projection aliasing comes in.
double measured_aliasing(glm::dmat4 const& map_clip_from_world, double z) {
    glm::dmat4 const eye_clip_from_world = from_rows<double>({1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, -1}, {0, 0, 1, 0});
    constexpr double texels = 1024.0, pixels = 1024.0;  // and tan(fov / 2) = 1
    glm::dvec3 const normal = glm::normalize(glm::dvec3(0.0, 1.0, -1.0));
    auto const texel = footprint(eye_clip_from_world, glm::dvec2(pixels), map_clip_from_world, texels,
                                 glm::dvec3(0.0, 0.0, z), normal);
    return texel.major / closed_form::pixels_per_texel(pixels, 1.0, texels);
}

std::string percent_of(double fraction) {
    char text[32];
    std::snprintf(text, sizeof text, "%.2f %%", 100.0 * fraction);
    return text;
}

double mean(std::vector<double> const& values) {
    double sum = 0.0;
    for (double const value : values) sum += value;
    return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

}  // namespace

std::string splits_chart() {
    struct Scheme {
        char const* name;
        double lambda;
    };
    constexpr Scheme schemes[] = {
        {"uniform", 0.0}, {"practical, \xce\xbb 0.5", 0.5}, {"practical, \xce\xbb 0.9", 0.9}, {"logarithmic", 1.0}};
    LogAxis const x{z_near, z_far, 130.0, width - 24.0};
    Svg svg(width, 230.0, "Split planes of four cascades between 1 m and 1 km for each scheme, on a logarithmic axis");
    depth_axis(svg, x, 14.0, 180.0);
    double y = 24.0;
    for (Scheme const& scheme : schemes) {
        auto const splits = practical_splits(z_near, z_far, 4, scheme.lambda);
        svg.text(x.from_place - 12, y + 18, "end", "label", scheme.name);
        for (int i = 0; i < splits.count; ++i) {
            double const left = x.at(splits.plane[i]), right = x.at(splits.plane[i + 1]);
            svg.rect(left + 1, y + 2, right - left - 2, 24, "map" + std::to_string(i),
                     figure(splits.plane[i]) + " to " + figure(splits.plane[i + 1]) + " m");
            if (right - left > 34 && i + 1 < splits.count)
                svg.text(right - 6, y + 19, "end", "onmap", figure(splits.plane[i + 1]));
        }
        y += 38.0;
    }
    return svg.str();
}

std::string aliasing_chart() {
    double const endless = std::numeric_limits<double>::infinity();
    double const best_centre = closed_form::best_centre(z_near, z_far);
    struct Scheme {
        char const* name;
        char const* css_class;
        double lambda;  // of four cascades; below 0: one map
        double centre;
    };
    Scheme const schemes[] = {{"one uniform map", "s0", -1.0, endless},
                              {"four practical cascades", "s1", 0.5, endless},
                              {"four logarithmic cascades", "s2", 1.0, endless},
                              {"one map, best perspective warp", "s3", -1.0, best_centre}};

    LogAxis const x{z_near, z_far, 56.0, width - 24.0};
    LogAxis const y{0.3, 1500.0, 330.0, 44.0};
    Svg svg(width, 380.0,
            "Perspective aliasing along eye depth for four schemes: closed forms and measured footprints");
    depth_axis(svg, x, y.to_place, y.from_place);
    for (double const e : {0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0}) {
        svg.line(x.from_place, y.at(e), x.to_place, y.at(e), "grid");
        svg.text(x.from_place - 8, y.at(e) + 4, "end", "tick", figure(e));
    }

    double legend = x.from_place;
    for (Scheme const& scheme : schemes) {
        std::string const css_class = scheme.css_class;
        svg.line(legend, 18, legend + 20, 18, "curve " + css_class);
        svg.dot(legend + 10, 18, 3.2, "measured " + css_class);
        svg.text(legend + 26, 22, "start", "tick", scheme.name);
        legend += 46.0 + 5.6 * static_cast<double>(std::string_view(scheme.name).size());

        auto const splits = practical_splits(z_near, z_far, scheme.lambda < 0.0 ? 1 : 4, std::max(scheme.lambda, 0.0));
        for (int i = 0; i < splits.count; ++i) {
            double const n = splits.plane[i], f = splits.plane[i + 1], centre = scheme.centre;
            auto const predicted = [=](double z) {
                return std::isinf(centre) ? closed_form::uniform_along(z, n, f)
                                          : closed_form::warped_along(z, n, f, centre);
            };
            glm::dmat4 const map = overhead_map(n, f, centre);
            Points curve;
            for (int k = 0; k <= 60; ++k) {
                double const z = n * std::pow(f / n, k / 60.0);
                curve.emplace_back(x.at(z), y.at(predicted(z)));
            }
            svg.polyline(curve, "curve " + css_class);
            int const dots = splits.count == 1 ? 12 : 4;
            for (int k = 0; k < dots; ++k) {
                double const z = n * std::pow(f / n, (k + 0.5) / dots), e = measured_aliasing(map, z);
                svg.dot(x.at(z), y.at(e), 3.2, "measured " + css_class,
                        "at " + figure(z) + " m: measured " + figure(e) + ", closed form " + figure(predicted(z)));
            }
        }
    }
    double const best = closed_form::logarithmic_along(z_near, z_far);
    svg.line(x.from_place, y.at(best), x.to_place, y.at(best), "bound");
    svg.text(x.from_place + 6, y.at(best) - 6, "start", "tick halo",
             "one logarithmic map, the optimum: ln(far/near) = " + figure(best));
    return svg.str();
}

std::string technique_chart(std::span<Technique const> techniques, Results const& results) {
    std::map<std::string, std::map<std::string, std::vector<double>>> by_technique;  // then by scene
    std::vector<std::string> scenes;
    double highest = 1e-3;
    for (Record const& record : results.records) {
        if (record.backend != results.records.front().backend) continue;
        by_technique[record.technique][record.scene].push_back(record.mis_shadowed_fraction_off_edge);
        if (std::ranges::find(scenes, record.scene) == scenes.end()) scenes.push_back(record.scene);
    }
    struct Bar {
        Technique const* technique;
        double mean;
        std::vector<double> of_scene;
    };
    std::vector<Bar> bars;
    for (Technique const& technique : techniques) {
        std::vector<double> all, of_scene;
        for (std::string const& scene : scenes) {
            auto const& values = by_technique[technique.id][scene];
            all.insert(all.end(), values.begin(), values.end());
            of_scene.push_back(values.empty() ? -1.0 : mean(values));
            highest = std::max(highest, of_scene.back());
        }
        if (!all.empty()) bars.push_back({&technique, mean(all), of_scene});
    }
    std::ranges::sort(bars, {}, &Bar::mean);

    // Techniques differ by orders of magnitude, hence the logarithmic scale; less than its start is drawn at its start.
    double const row = 26.0, bottom = 40.0 + row * static_cast<double>(bars.size());
    LogAxis const x{1e-4, std::max(1e-2, 1.1 * highest), 370.0, width - 84.0};
    Svg svg(width, bottom + 24.0, "Mis-shadowed pixels off edges for each technique, percent, on a logarithmic axis");
    for (double const tick : {1e-4, 1e-3, 1e-2, 1e-1, 1.0}) {
        if (tick > x.to_value) break;
        svg.line(x.at(tick), 32, x.at(tick), bottom, "grid");
        svg.text(x.at(tick), bottom + 16, "middle", "tick", figure(100.0 * tick) + " %");
    }
    double legend = x.from_place;
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        svg.dot(legend, 16, 4.5, "scene s" + std::to_string(i % 4));
        svg.text(legend + 9, 20, "start", "tick", scenes[i]);
        legend += 28.0 + 6.2 * static_cast<double>(scenes[i].size());
    }
    double y = 34.0;
    for (Bar const& bar : bars) {
        std::string const percent = percent_of(bar.mean);
        svg.text(x.from_place - 12, y + 16, "end", "label", bar.technique->title);
        svg.rect(x.from_place, y + 3, std::max(x.at(bar.mean) - x.from_place, 1.0), row - 8, "bar",
                 bar.technique->id + ": " + percent);
        for (std::size_t i = 0; i < bar.of_scene.size(); ++i) {
            if (bar.of_scene[i] < 0.0) continue;
            svg.dot(x.at(bar.of_scene[i]), y + row / 2 - 1, 4.5, "scene s" + std::to_string(i % 4),
                    scenes[i] + ": " + percent_of(bar.of_scene[i]));
        }
        svg.text(width - 8, y + 16, "end", "label", percent);
        y += row;
    }
    return svg.str();
}

}  // namespace shadowmath::gallery
