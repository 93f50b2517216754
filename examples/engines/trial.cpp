// SPDX-License-Identifier: MIT
#include "examples/engines/trial.hpp"

#include "backends/gl/gl_backend.hpp"
#include "examples/gallery/measure.hpp"
#include "examples/gallery/pictures.hpp"
#include "examples/support/png.hpp"
#include "scenes/scenes.hpp"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <utility>

namespace shadowmath::engines {
namespace {

namespace fs = std::filesystem;
using gallery::Outcome;
using gallery::Record;

struct Options {
    fs::path out;
    bool quick = false;
    bool check = false;
    std::vector<std::string> scenes;
    std::vector<std::string> views;
    std::vector<std::string> set_ups;
    std::optional<float> slope_bias;
    [[nodiscard]] backend::Extent extent() const {
        return quick ? backend::Extent{480, 270} : backend::Extent{960, 540};
    }
};

bool wanted(std::vector<std::string> const& names, std::string const& name) {
    return names.empty() || std::ranges::find(names, name) != names.end();
}

struct Stage {
    scenes::NamedScene named;
    std::vector<gallery::ViewTruth> truths;  // one a view
};

// Suns only: an engine aims at spot lights in other ways.
std::vector<Stage> stages(Options const& options) {
    auto const backend = backend::make_gl_backend(backend::GlContextKind::egl);
    std::vector<Stage> stages;
    for (std::string const& name : options.scenes) {
        auto const size = options.quick ? scenes::SceneSize::small : scenes::SceneSize::medium;
        Stage stage{scenes::make_scene(name, size), {}};
        std::erase_if(stage.named.views,
                      [&](scenes::View const& view) { return view.has_spot || !wanted(options.views, view.name); });
        if (options.quick && stage.named.views.size() > 2) stage.named.views.resize(2);
        oracle::RayOracle const oracle(stage.named.scene);
        backend->upload(stage.named.scene);
        for (scenes::View const& view : stage.named.views) {
            std::printf("tracing %s / %s\n", name.c_str(), view.name.c_str());
            std::fflush(stdout);
            stage.truths.push_back(gallery::true_view(*backend, oracle, view, options.extent()));
        }
        stages.push_back(std::move(stage));
    }
    return stages;
}

struct Result {
    SetUp set_up;
    Record record;
    double microseconds = 0.0;
    double false_shadow = 0.0, false_light = 0.0;  // of the pixels off the true edges
};

// The matrices stay the engine's own: every point counts as one that no map of ours serves, so figures are of pictures.
Result judge(SetUp const& set_up, gallery::ViewTruth const& truth, scenes::View const& view, Drawn const& drawn,
             fs::path const& path) {
    backend::Extent const extent = truth.state.extent;
    gallery::MapSet nothing;
    nothing.frame = gallery::unshadowed(view, extent);
    nothing.map_size = map_size;
    gallery::Measurement measured = gallery::measure(truth, nothing, drawn.frame);
    Result result{set_up, std::move(measured.record), drawn.microseconds};
    result.record.technique = set_up.id;
    result.record.view = view.name;
    result.record.maps = set_up.maps;
    result.record.note = drawn.note;
    auto const share = [&](Outcome outcome) {
        auto const count = std::ranges::count(measured.outcome.pixels, outcome);
        return double(count) / double(std::max(1L, result.record.off_edge_pixels));
    };
    result.false_shadow = share(Outcome::false_shadow);
    result.false_light = share(Outcome::false_light);
    auto const file = [&](char const* kind) { return fs::path(path.string() + "-" + set_up.id + kind); };
    gallery::write_png(file(".png"), drawn.frame.colour);
    gallery::write_png(file("-difference.png"), gallery::difference_picture(truth.picture, measured.outcome));
    return result;
}

double mean_wrong(std::vector<Result> const& results, std::string const& id, std::string const& scene) {
    double sum = 0.0;
    int views = 0;
    for (Result const& result : results) {
        if (result.set_up.id != id || (!scene.empty() && result.record.scene != scene)) continue;
        sum += result.record.mis_shadowed_fraction_off_edge;
        ++views;
    }
    return views ? sum / views : 0.0;
}

double median_time(std::vector<Result> const& results, std::string const& id) {
    std::vector<double> times;
    for (Result const& result : results)
        if (result.set_up.id == id) times.push_back(result.microseconds);
    if (times.empty()) return 0.0;
    std::ranges::sort(times);
    return times[times.size() / 2];
}

// In Markdown, so that it can stand in a page as it is.
void print_table(Engine const& engine, std::vector<SetUp> const& set_ups, std::vector<Result> const& results,
                 Options const& options) {
    std::printf("\n%s: pixels wrong away from true shadow edges, %%, mean over the views of a scene; microseconds a "
                "frame, median\n\n| set-up | maps |",
                engine.name().c_str());
    for (std::string const& scene : options.scenes) std::printf(" %s |", scene.c_str());
    std::printf(" all | µs |\n|---|---|");
    for (std::size_t i = 0; i < options.scenes.size() + 2; ++i) std::printf("---|");
    std::printf("\n");
    for (SetUp const& set_up : set_ups) {
        char const* const mark = set_up.ours ? "**" : "";
        std::printf("| %s%s%s | %d |", mark, set_up.title.c_str(), mark, set_up.maps);
        for (std::string const& scene : options.scenes)
            std::printf(" %.2f |", 100.0 * mean_wrong(results, set_up.id, scene));
        std::printf(" %.2f | %.1f |\n", 100.0 * mean_wrong(results, set_up.id, {}), median_time(results, set_up.id));
    }
    std::printf("\n");
}

void write_results(Engine const& engine, std::vector<Result> const& results, Options const& options) {
    nlohmann::json records = nlohmann::json::array();
    for (Result const& result : results) {
        Record const& record = result.record;
        records.push_back({{"scene", record.scene},
                           {"view", record.view},
                           {"set_up", record.technique},
                           {"title", result.set_up.title},
                           {"ours", result.set_up.ours},
                           {"maps", record.maps},
                           {"judged_pixels", record.lit_facing_pixels},
                           {"off_edge_pixels", record.off_edge_pixels},
                           {"mis_shadowed_fraction", record.mis_shadowed_fraction},
                           {"mis_shadowed_fraction_off_edge", record.mis_shadowed_fraction_off_edge},
                           {"false_shadow_fraction_off_edge", result.false_shadow},
                           {"false_light_fraction_off_edge", result.false_light},
                           {"fit_microseconds_a_frame", result.microseconds},
                           {"note", record.note}});
    }
    nlohmann::json const all{{"engine", engine.name()},
                             {"width", options.extent().width},
                             {"height", options.extent().height},
                             {"map_size", map_size},
                             {"records", records}};
    std::ofstream file(options.out / "results.json");
    file << all.dump(1) << '\n';
    if (!file.flush()) throw std::runtime_error((options.out / "results.json").string() + ": cannot be written");
}

// What --check promises of ours: few pixels are wrong, far fewer than without shadows, and no more than the rival's.
bool holds(SetUp const& set_up, std::vector<Result> const& results) {
    double const wrong = mean_wrong(results, set_up.id, {});
    bool good = wrong < (set_up.maps >= 4 ? 0.005 : 0.02);
    if (!set_up.rival.empty()) {
        double const theirs = mean_wrong(results, set_up.rival, {});
        good = good && wrong <= theirs;
        std::printf("%s: %s is wrong in %.3f %% of the pixels, %s in %.3f %%\n", good ? "ok" : "FAILED",
                    set_up.id.c_str(), 100.0 * wrong, set_up.rival.c_str(), 100.0 * theirs);
    } else {
        std::printf("%s: %s is wrong in %.3f %% of the pixels\n", good ? "ok" : "FAILED", set_up.id.c_str(),
                    100.0 * wrong);
    }
    return good;
}

int run(Options const& options, std::function<std::unique_ptr<Engine>()> const& start) {
    std::vector<Stage> const stages = engines::stages(options);
    std::unique_ptr<Engine> const engine = start();
    std::vector<SetUp> set_ups = engine->set_ups();
    std::erase_if(set_ups, [&](SetUp const& set_up) { return !wanted(options.set_ups, set_up.id); });
    for (SetUp& set_up : set_ups) set_up.slope_bias = options.slope_bias.value_or(set_up.slope_bias);
    fs::create_directories(options.out);
    std::vector<Result> results;
    for (Stage const& stage : stages) {
        engine->load(stage.named.scene);
        for (std::size_t i = 0; i < stage.named.views.size(); ++i) {
            scenes::View const& view = stage.named.views[i];
            fs::path const path = options.out / (stage.named.scene.name + "-" + view.name);
            gallery::write_png(path.string() + "-truth.png", stage.truths[i].picture);
            for (SetUp const& set_up : set_ups) {
                Result result =
                    judge(set_up, stage.truths[i], view, engine->draw(set_up, view, options.extent()), path);
                result.record.scene = stage.named.scene.name;
                std::printf("%s / %s / %s: %.2f %% (%.2f in shadow, %.2f in light), %.1f us\n",
                            stage.named.scene.name.c_str(), view.name.c_str(), set_up.id.c_str(),
                            100.0 * result.record.mis_shadowed_fraction_off_edge, 100.0 * result.false_shadow,
                            100.0 * result.false_light, result.microseconds);
                std::fflush(stdout);
                results.push_back(std::move(result));
            }
        }
    }
    print_table(*engine, set_ups, results, options);
    write_results(*engine, results, options);
    if (!options.check) return 0;
    bool good = true;
    for (SetUp const& set_up : set_ups)
        if (set_up.ours) good = holds(set_up, results) && good;
    return good ? 0 : 1;
}

}  // namespace

int run_trial(int argc, char** argv, std::string const& engine, std::function<std::unique_ptr<Engine>()> const& start) {
    Options options;
    options.out = fs::path("out") / "engines" / engine;
    CLI::App app{"Aims shadow cameras inside " + engine + ", with its own set-ups and with shadowmath"};
    app.add_flag("--quick", options.quick, "two views of two small scenes, in small pictures");
    app.add_flag("--check", options.check,
                 "fail unless shadowmath's set-ups are right, and no worse than their rivals");
    app.add_option("--out", options.out, "folder of the pictures and results.json")->capture_default_str();
    app.add_option("--scene", options.scenes, "town, colonnade, forest; all, or the first two if --quick");
    app.add_option("--view", options.views, "by name; all");
    app.add_option("--set-up", options.set_ups, "by id; all");
    app.add_option("--slope-bias", options.slope_bias,
                   "of all casters, in place of the one that suits each set-up best");
    CLI11_PARSE(app, argc, argv);
    if (options.scenes.empty()) {
        for (auto const name : scenes::scene_names()) options.scenes.emplace_back(name);
        if (options.quick) options.scenes.resize(2);
    }
    try {
        return run(options, start);
    } catch (std::exception const& error) {
        std::cerr << engine << ": " << error.what() << '\n';
        return 1;
    }
}

}  // namespace shadowmath::engines
