// SPDX-License-Identifier: MIT
//
// Reads what the two benchmark programs wrote, prints ours against the textbook and against the lower bound, and writes
// ratios.json: name, ours_ns, reference, reference_ns, ratio, goal, met, flags.
//
//   bench_ratios native.json plain.json include_cost.txt ratios.json
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <map>
#include <string>
#include <vector>

namespace {

using nlohmann::json;

// Times, nanoseconds: [case and size][variant].
using Times = std::map<std::string, std::map<std::string, double>>;

struct Goal {
    char const* name;
    char const* reference;
    double native;  // at least so many times as fast as the reference; 0: no goal
    double plain;
};

constexpr Goal goals[] = {
    {"slice_boxes", "textbook", 15, 20},
    {"slice_boxes", "bound", 1 / 1.3, 1 / 1.3},
    {"slice_spheres", "textbook", 14, 20},
    {"slice_spheres", "bound", 1 / 1.3, 1 / 1.3},
    {"slice_focus", "polygons", 90, 23},
    {"many_views/10000", "textbook", 55, 55},
    {"warped_cascades", "ogre", 150, 150},
    {"caster_masks/10000", "textbook", 12, 10},
    {"caster_masks/1000000", "textbook", 12, 10},
    {"caster_masks/4194304", "read", 0.85, 0},
    {"region_perspective/1000", "textbook", 10, 10},
    {"region_perspective/100000", "textbook", 10, 10},
    {"region_affine/1000", "textbook", 24, 24},
    {"region_affine/100000", "textbook", 24, 24},
    {"vdsm_points/1048576", "textbook", 6, 12},
    {"vdsm_points/8388608", "textbook", 6, 12},
    {"vdsm_points/8388608", "copy", 0.85, 0},
};

// "case/variant/size" with its median.
Times medians_of(char const* path) {
    Times times;
    std::ifstream file(path);
    json const report = json::parse(file);
    for (json const& run : report["benchmarks"]) {
        if (run.value("aggregate_name", "") != "median") continue;
        std::string const name = run["run_name"];
        std::size_t const first = name.find('/'), second = name.find('/', first + 1);
        if (first == std::string::npos) continue;
        std::string const size = second == std::string::npos ? "" : name.substr(second);
        times[name.substr(0, first) + size][name.substr(first + 1, second - first - 1)] = run["cpu_time"];
    }
    return times;
}

double goal_of(std::string const& name, std::string const& reference, bool native) {
    for (Goal const& goal : goals)
        if (name == goal.name && reference == goal.reference) return native ? goal.native : goal.plain;
    return 0;
}

json row(std::string const& name, double ours, std::string const& reference, double reference_ns, double goal,
         std::string const& flags) {
    double const ratio = reference_ns / ours;
    json entry = {{"name", name},   {"ours_ns", ours}, {"reference", reference}, {"reference_ns", reference_ns},
                  {"ratio", ratio}, {"goal", nullptr}, {"met", nullptr},         {"flags", flags}};
    if (goal > 0) {
        entry["goal"] = goal;
        entry["met"] = ratio >= goal;
    }
    char const* const verdict = goal > 0 ? (ratio >= goal ? "met" : "MISSED") : "";
    std::printf("%-28s %-10s %14.1f %14.1f %8.2f", name.c_str(), reference.c_str(), ours, reference_ns, ratio);
    std::printf(goal > 0 ? " %8.2f  %s\n" : "\n", goal, verdict);
    return entry;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 5) {
        std::fputs("bench_ratios native.json plain.json include_cost.txt ratios.json\n", stderr);
        return 2;
    }
    json rows = json::array();
    for (bool const native : {true, false}) {
        std::string const flags = native ? "-O3 -march=native" : "-O2";
        std::printf("\n%s\n%-28s %-10s %14s %14s %8s %8s\n", flags.c_str(), "", "against", "ours, ns", "its, ns",
                    "ratio", "goal");
        for (auto const& [name, variants] : medians_of(argv[native ? 1 : 2])) {
            auto const ours = variants.find("ours");
            if (ours == variants.end()) continue;
            for (auto const& [reference, ns] : variants)
                if (reference != "ours")
                    rows.push_back(row(name, ours->second, reference, ns, goal_of(name, reference, native), flags));
        }
    }
    // Lines of "compiler header milliseconds", above an empty file; the first of each compiler is GLM's own.
    std::ifstream cost(argv[3]);
    std::string compiler, header, last_compiler;
    double milliseconds = 0, of_glm = 0;
    std::printf("\n%-40s %10s %10s\n", "-fsyntax-only", "ms", "limit");
    while (cost >> compiler >> header >> milliseconds) {
        std::string const name = compiler == "g++" ? header : header + " (" + compiler + ")";
        if (compiler != last_compiler) {
            of_glm = milliseconds;
            last_compiler = compiler;
            std::printf("%-40s %10.1f\n", name.c_str(), milliseconds);
            continue;
        }
        bool const all = header == "shadowmath/shadowmath.hpp";
        double const above = milliseconds - of_glm, limit = all ? std::max(60.0, 0.25 * of_glm) : 15.0;
        std::printf("%-40s %10.1f %10.1f  %s\n", name.c_str(), above, limit, above <= limit ? "met" : "MISSED");
        rows.push_back({{"name", "include " + name},
                        {"ours_ns", above * 1e6},
                        {"reference", "<glm/glm.hpp>"},
                        {"reference_ns", of_glm * 1e6},
                        {"ratio", above / of_glm},
                        {"goal", limit / of_glm},
                        {"met", above <= limit},
                        {"flags", "-fsyntax-only"}});
    }
    std::ofstream(argv[4]) << rows.dump(2) << '\n';
}
