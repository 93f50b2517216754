// SPDX-License-Identifier: MIT
#include "examples/doctor/find.hpp"

#include <shadowmath/light.hpp>

#include <algorithm>
#include <cmath>

namespace shadowmath::doctor {
namespace {

// Fewer are the rounding of what was printed.
bool enough(int count, std::size_t all) {
    return count >= 3 && double(count) > 2e-4 * double(all);
}

double share(int part, std::size_t all) {
    return all > 0 ? double(part) / double(all) : 0.0;
}

std::string of_points(int count, Examination const& e) {
    return percent(share(count, e.sight.points.size())) + " of what is seen";
}

void find_gaps(Examination& e) {
    if (e.read.choice != Selection::by_depth) return;
    auto const& maps = e.read.frame.maps;
    for (std::size_t m = 1; m < maps.size(); ++m) {
        double const end = maps[m - 1].range->end, begin = maps[m].range->begin;
        if (maps[m].range->end <= end) {
            e.fault(Ill::ranges, m,
                    "its range ends at " + digits(maps[m].range->end) + " m, not beyond that of \"" + e.name(m - 1) +
                        "\": it is never used.",
                    "let ranges end at increasing depths.");
        } else if (begin > end * (1.0 + 1e-5)) {
            int inside_gap = 0;
            for (Seen const& seen : e.sight.points)
                inside_gap += seen.eye_depth >= end && seen.eye_depth < begin ? 1 : 0;
            e.fault(Ill::ranges, m,
                    "a gap between the splits: \"" + e.name(m - 1) + "\" ends at " + digits(end) +
                        " m and this one begins at " + digits(begin) + " m; " + of_points(inside_gap, e) +
                        " lies between.",
                    "begin each map where the one before it ends, or before that where they blend: an overlap that is "
                    "added where it should be taken away does this, and splits that shader and fit compute twice.");
        }
    }
}

void find_holes(Examination& e, std::size_t m) {
    int outside = 0, dark = 0, past = 0;
    double nearest = 1e30, farthest = 0.0;
    for (int const i : e.points[m]) {
        Place const place = e.found.places[static_cast<std::size_t>(i)];
        if (place.served == Served::past_end) ++past;
        if (place.served != Served::outside && place.served != Served::behind) continue;
        ++outside;
        dark += e.seen(i).dark ? 1 : 0;
        nearest = std::min(nearest, e.seen(i).eye_depth);
        farthest = std::max(farthest, e.seen(i).eye_depth);
    }
    std::size_t const all = e.sight.points.size();
    if (enough(outside, all)) {
        std::string what = of_points(outside, e) + ", from " + digits(nearest) + " to " + digits(farthest) +
                           " m, lies outside the map that its depth chooses";
        std::string const mend =
            "fit the map to the same splits that the shader chooses by, all eight corners of the slice, and the "
            "kernel's reach beyond them.";
        if (e.sight.traced && enough(dark, all))
            e.fault(
                Ill::uncovered, m,
                what + "; " + percent(share(dark, std::size_t(outside))) + " of it should be dark and is drawn lit.",
                mend);
        else
            e.remark(Ill::uncovered, m,
                     what + (e.sight.traced ? "; all of it is lit, so nothing shows in this view."
                                            : ". Nothing is known to be there: give a scene to be sure."),
                     mend);
    }
    if (enough(past, all)) {
        std::string const what = of_points(past, e) + " lies beyond the map's far plane: dark where depth is kept in "
                                                      "float, lit where the comparison clamps.";
        std::string const mend = "let the far plane lie behind the last receiver of the slice.";
        e.sight.traced ? e.fault(Ill::past_far_end, m, what, mend) : e.remark(Ill::past_far_end, m, what, mend);
    }
}

// Where maps are tried in turn, what none of them holds.
void find_unserved(Examination& e) {
    if (e.read.choice != Selection::first) return;
    int unserved = 0, dark = 0;
    double nearest = 1e30;
    for (std::size_t i = 0; i < e.sight.points.size(); ++i) {
        if (e.found.places[i].map >= 0) continue;
        ++unserved;
        if (!e.sight.points[i].dark) continue;
        ++dark;
        nearest = std::min(nearest, e.sight.points[i].eye_depth);
    }
    if (!enough(dark, e.sight.points.size())) return;
    e.found.findings.push_back({Ill::uncovered, -1, true,
                                "no map holds " + of_points(unserved, e) + "; " +
                                    percent(share(dark, std::size_t(unserved))) +
                                    " of it should be dark and is drawn lit, the nearest at " + digits(nearest) + " m.",
                                "enlarge the last map, or state a \"shadow_distance\" if shadows are meant to end."});
}

void find_cut_casters(Examination& e, std::size_t m) {
    if (e.read.depth_clamp) return;
    int dark = 0, lost = 0;
    std::vector<double> beyond;
    for (int const i : e.points[m]) {
        Seen const& seen = e.seen(i);
        if (!seen.dark || e.found.places[static_cast<std::size_t>(i)].served != Served::yes) continue;
        ++dark;
        glm::dvec3 const way = toward(e.read.frame.light, seen.point);
        double first_cut = 0.0;
        bool kept = false;
        for (double const metres : e.sight.blockers_of(seen)) {
            Inside const place = inside(e.maps[m], seen.point + way * metres);
            if (place.in_front && place.at.z >= -1e-6) kept = true;
            if (first_cut == 0.0) first_cut = metres;
        }
        if (kept) continue;
        ++lost;
        e.found.lost_cut[static_cast<std::size_t>(i)] = true;
        // From where on the way the near plane cuts, by halving.
        double lo = 0.0, hi = first_cut;
        for (int step = 0; step < 40; ++step) {
            double const middle = (lo + hi) / 2.0;
            Inside const place = inside(e.maps[m], seen.point + way * middle);
            (place.in_front && place.at.z >= 0.0 ? lo : hi) = middle;
        }
        beyond.push_back(first_cut - lo);
    }
    if (!enough(lost, e.sight.points.size())) return;
    e.fault(Ill::casters_cut, m,
            "the near plane cuts off casters: " + percent(share(lost, std::size_t(dark))) +
                " of the points that should be dark in it (" + of_points(lost, e) +
                ") are drawn lit, as all that shadows them stands beyond the near plane, up to " +
                digits(percentile(beyond, 1.0)) + " m.",
            "move the near plane " + digits(std::ceil(percentile(beyond, 1.0))) +
                " m and more toward the light, to the nearest caster; or draw the maps with depth clamp and state "
                "\"depth_clamp\": true.");
}

void find_margin(Examination& e, std::size_t m) {
    int over = 0;
    double const margin = double(e.read.filter_radius) / e.read.frame.maps[m].size;
    for (int const i : e.points[m]) {
        if (e.found.places[static_cast<std::size_t>(i)].served != Served::yes) continue;
        glm::dvec3 const at = inside(e.maps[m], e.seen(i).point).at;
        if (std::min(at.x, at.y) < margin || std::max(at.x, at.y) > 1.0 - margin) ++over;
    }
    if (!enough(over, e.sight.points.size())) return;
    e.remark(Ill::filter_margin, m, "at " + of_points(over, e) + " the kernel reads beyond the map's side.",
             "leave " + std::to_string(e.read.filter_radius + 1) +
                 " texels free on every side, and let the outside "
                 "read as lit.");
}

}  // namespace

void find_coverage(Examination& e) {
    find_gaps(e);
    find_unserved(e);
    for (std::size_t m = 0; m < e.maps.size(); ++m) {
        if (!e.sound[m]) continue;
        if (e.read.choice == Selection::by_depth) find_holes(e, m);
        find_cut_casters(e, m);
        if (e.read.choice == Selection::by_depth) find_margin(e, m);
    }
}

}  // namespace shadowmath::doctor
