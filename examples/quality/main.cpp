// SPDX-License-Identifier: MIT
//
// Picture truth at an equal budget: every policy and every folk recipe over some fifty views, in one table.
#include "examples/gallery/extent.hpp"
#include "examples/gallery/staging.hpp"
#include "examples/quality/report.hpp"

#include <CLI/CLI.hpp>

#include <fstream>
#include <iostream>

namespace shadowmath::quality {
namespace {

void write_text(std::filesystem::path const& path, std::string const& text) {
    std::ofstream file(path, std::ios::binary);
    file << text;
    file.close();
    if (!file) throw std::runtime_error(path.string() + ": cannot be written");
}

int study(int argc, char** argv) {
    Settings settings;
    std::string size;
    CLI::App app{"Draws some fifty views with every policy of the library and with the recipes that engines use, four "
                 "maps of 1024 texels squared each, and counts the pixels that ray tracing shows to be wrong."};
    app.add_option("--out", settings.out, "folder to write")->capture_default_str();
    app.add_option("--models", settings.models, "folder of Wavefront OBJ files to study too");
    app.add_option("--size", size, "WIDTHxHEIGHT of the pictures")->check([&](std::string const& text) {
        return gallery::parse_extent(text, 64, settings.extent)
                   ? ""
                   : text + " is no size such as 960x540, 64 to 4096 a side";
    });
    app.add_option("--policy", settings.only_policies, "only these policies, by id");
    app.add_option("--view", settings.only_views, "only views whose scene/name holds one of these");
    app.add_option("--truth", settings.truth, "folder in which traced truths are kept for later runs");
    app.add_option("--backend", settings.backend, "egl or osmesa")->check(CLI::IsMember({"egl", "osmesa"}));
    app.add_option("--fresh", settings.fresh, "views drawn by a rule from this seed, instead of those of the study");
    app.add_option("--attainable", settings.search_steps,
                   "steps of a search for the least footprints that four maps can have in each view (40000: half a "
                   "minute a view); goes with the policy chosen-depth");
    app.add_flag("!--no-pictures", settings.pictures, "no heat maps");
    try {
        app.parse(argc, argv);
    } catch (CLI::ParseError const& error) {
        if (error.get_exit_code() == 0) return app.exit(error);
        std::cerr << "quality: " << error.what() << " (--help tells the options)\n";
        return 2;
    }
    gallery::Staging staging(settings.out);
    Results const results =
        run_study(settings, staging.folder(), [](std::string const& line) { std::cerr << line << std::endl; });
    write_text(staging.folder() / "results.json", results_json(settings, results));
    write_text(staging.folder() / "index.html", page(settings, results));
    staging.publish();
    std::cout << table(results) << (settings.out / "index.html").string() << '\n';
    return 0;
}

}  // namespace
}  // namespace shadowmath::quality

int main(int argc, char** argv) {
    try {
        return shadowmath::quality::study(argc, argv);
    } catch (std::exception const& error) {
        std::cerr << "quality: " << error.what() << '\n';
        return 1;
    }
}
