// SPDX-License-Identifier: MIT
//
// Renders scenes through every technique and backend, holds each picture against ray-traced truth, and writes a page
// that shows it all.
#include "backends/gl/gl_backend.hpp"
#include "backends/vk/vk_backend.hpp"
#include "examples/gallery/extent.hpp"
#include "examples/gallery/page.hpp"
#include "examples/gallery/promises.hpp"
#include "examples/gallery/results.hpp"
#include "examples/gallery/run.hpp"
#include "examples/gallery/speed.hpp"
#include "examples/gallery/staging.hpp"
#include "scenes/obj.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <iostream>
#include <optional>

namespace shadowmath::gallery {
namespace {

volatile std::sig_atomic_t interrupted = 0;

struct Interrupted {};

void tell(std::string const& line) {
    if (interrupted != 0) throw Interrupted{};
    std::cout << line << std::endl;
}

// Fills settings. The program ends here with a status where there is nothing to run.
std::optional<int> parse(int argc, char** argv, Settings& settings) {
    CLI::App app{"Renders scenes through every shadow-map technique, compares each picture with ray-traced truth and "
                 "writes a gallery page."};
    std::string size;
    auto const names = scenes::scene_names();
    std::vector<std::string> const built_in(names.begin(), names.end());
    std::vector<std::string> choices = built_in;
    choices.emplace_back("none");
    app.add_option("obj", settings.models, "Wavefront OBJ models to show beside the built-in scenes");
    app.add_option("--scene", settings.scenes, "a built-in scene to show, or none; may be repeated (default: all)")
        ->check(CLI::IsMember(choices))
        ->expected(1)
        ->allow_extra_args(false)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
    app.add_flag("--quick", settings.quick, "fewer views and techniques, smaller scenes and pictures");
    app.add_option("--out", settings.out, "folder to write; an earlier gallery there is replaced")
        ->capture_default_str();
    app.add_option("--backend", settings.backend, "egl, osmesa, vulkan or all")
        ->check(CLI::IsMember({"egl", "osmesa", "vulkan", "all"}))
        ->capture_default_str();
    app.add_option("--size", size, "WIDTHxHEIGHT of the pictures (960x540; quick: 640x360)")
        ->check([&](std::string const& text) {
            return parse_extent(text, 16, settings.extent) ? ""
                                                           : text + " is no size such as 960x540, 16 to 4096 a side";
        });
    app.add_option("--ratios", settings.ratios, "the times that scripts/bench wrote, to be shown")
        ->capture_default_str();
    app.add_flag("--validate", settings.validate,
                 "Vulkan under its validation layers; what they say stands in the notes");
    app.add_option("--flight", settings.flight, "frames of the camera's flight through each scene (300; quick: 12)")
        ->check(CLI::Range(2, 3000));
    app.add_option("--seed", settings.seed, "of the built-in scenes")->capture_default_str();
    try {
        app.parse(argc, argv);
    } catch (CLI::ParseError const& error) {
        if (error.get_exit_code() == 0) return app.exit(error);
        std::cerr << "gallery: " << error.what() << " (--help tells the options)\n";
        return 2;
    }
    if (size.empty() && settings.quick) settings.extent = {640, 360};
    if (settings.scenes.empty()) settings.scenes = built_in;
    std::erase(settings.scenes, "none");
    if (!settings.models.empty() || !settings.scenes.empty()) return std::nullopt;
    std::cerr << "gallery: --scene none needs a model to show\n";
    return 2;
}

std::vector<std::unique_ptr<backend::Backend>> open_backends(std::string const& wanted, bool validate) {
    std::vector<std::unique_ptr<backend::Backend>> open;
    std::string missing;
    auto const add = [&](char const* name, auto const& make) {
        if (wanted != "all" && wanted != name) return;
        try {
            open.push_back(make());
        } catch (std::runtime_error const& error) {
            missing += (missing.empty() ? "" : "; ") + std::string(error.what());
        }
    };
    add("egl", [] { return backend::make_gl_backend(backend::GlContextKind::egl); });
    add("osmesa", [] { return backend::make_gl_backend(backend::GlContextKind::osmesa); });
    add("vulkan", [validate] { return backend::make_vulkan_backend({.validation = validate}); });
    if (open.empty()) throw std::runtime_error(missing);
    if (!missing.empty()) tell("left out: " + missing);
    for (auto const& backend : open) tell(backend->info().name + ": " + backend->info().driver);
    return open;
}

std::vector<scenes::NamedScene> load_scenes(Settings const& settings) {
    std::vector<scenes::NamedScene> loaded;
    auto const add = [&](scenes::NamedScene named) {
        // Pictures lie in a folder a scene, so names are made unique.
        std::string const name = named.scene.name;
        auto const taken = [&] {
            return std::ranges::any_of(loaded, [&](auto const& other) { return other.scene.name == named.scene.name; });
        };
        for (int copy = 2; taken(); ++copy) named.scene.name = name + "-" + std::to_string(copy);
        tell("scene " + named.scene.name + ": " + std::to_string(named.scene.indices.size() / 3) + " triangles, " +
             std::to_string(chosen_views(named, settings).size()) + " views");
        loaded.push_back(std::move(named));
    };
    for (auto const& model : settings.models) add(scenes::load_obj(model));
    auto const size = settings.quick ? scenes::SceneSize::small : scenes::SceneSize::medium;
    for (auto const& name : settings.scenes) add(scenes::make_scene(name, size, settings.seed));
    return loaded;
}

void write_text(std::filesystem::path const& path, std::string const& text) {
    std::ofstream file(path, std::ios::binary);
    file << text;
    file.close();
    if (!file) throw std::runtime_error(path.string() + ": cannot be written");
}

// "; egl, osmesa, vulkan: 0 of 12441600 pixels unlike"
std::string agreement(Backends backends, Results const& results) {
    if (backends.size() < 2) return {};
    std::string names;
    for (auto const& backend : backends) names += (names.empty() ? "; " : ", ") + backend->info().name;
    long unlike = 0, pixels = 0;
    for (Parity const& parity : results.parity) {
        unlike += parity.unlike_pixels;
        pixels += parity.pixels;
    }
    return names + ": " + std::to_string(unlike) + " of " + std::to_string(pixels) + " pixels unlike";
}

// Says what did not hold; the program's status. The gallery stands all the same, for it shows where.
int judged(Backends backends, std::vector<std::string> const& broken) {
    bool const counts = share_a_rasteriser(backends);
    for (std::string const& sentence : broken)
        std::cerr << "gallery: " << (counts ? "BROKEN: " : "not judged, for drivers differ: ") << sentence << '\n';
    return counts && !broken.empty() ? 3 : 0;
}

int make_gallery(Settings const& settings) {
    std::string const speed = speed_table(settings.ratios);
    Staging staging(settings.out);
    auto const scenes = load_scenes(settings);
    auto const backends = open_backends(settings.backend, settings.validate);
    Results const results = run(settings, scenes, backends, staging.folder(), tell);
    std::string const json = results_json(settings, scenes, backends, results);
    write_text(staging.folder() / "results.json", json);
    write_text(staging.folder() / "index.html", page(techniques(settings.quick), results, json, speed));
    staging.publish();
    tell("wrote " + (settings.out / "index.html").string() + agreement(backends, results));
    return judged(backends, broken_promises(results));
}

}  // namespace
}  // namespace shadowmath::gallery

int main(int argc, char** argv) {
    using namespace shadowmath::gallery;
    Settings settings;
    for (int const signal : {SIGINT, SIGTERM}) std::signal(signal, [](int) { interrupted = 1; });
    try {
        if (auto const status = parse(argc, argv, settings)) return *status;
        return make_gallery(settings);
    } catch (Interrupted const&) {
        std::cerr << "gallery: stopped; nothing was written\n";
        return 130;
    } catch (std::bad_alloc const&) {
        std::cerr << "gallery: out of memory\n";
    } catch (std::exception const& error) {
        std::string line = error.what();
        std::ranges::replace(line, '\n', ' ');
        std::cerr << "gallery: " << line << '\n';
    }
    return 1;
}
