// SPDX-License-Identifier: MIT
#include "examples/gallery/run.hpp"

#include "examples/gallery/draw_maps.hpp"
#include "examples/gallery/measure.hpp"
#include "examples/gallery/pictures.hpp"
#include "examples/gallery/truth.hpp"

#include <algorithm>
#include <cstdio>
#include <iterator>
#include <limits>

namespace shadowmath::gallery {
namespace {

namespace fs = std::filesystem;

struct Rendered {
    backend::Frame frame;
    double ms_depth = 0.0;
    double ms_receive = 0.0;
};

// The fastest of the runs is timed: the first one may also compile shaders and allocate.
Rendered render(backend::Backend& backend, MapSet const& maps, backend::Extent extent, int runs) {
    Rendered rendered;
    rendered.ms_depth = rendered.ms_receive = std::numeric_limits<double>::max();
    for (int i = 0; i < runs; ++i) {
        rendered.ms_depth = std::min(rendered.ms_depth, draw_maps(backend, maps, extent));
        rendered.ms_receive = std::min(rendered.ms_receive, draw_picture(backend, maps, extent));
    }
    rendered.frame = backend.read_frame();
    return rendered;
}

std::vector<backend::Image<float>> maps_of(backend::Backend& backend, int count) {
    std::vector<backend::Image<float>> maps;
    for (int i = 0; i < count; ++i) maps.push_back(backend.read_depth(i));
    return maps;
}

// One view of one scene, with what its techniques share.
class ViewShow {
public:
    ViewShow(Settings const& settings, backend::Scene const& scene, scenes::View const& view, Backends backends,
             oracle::RayOracle const& oracle, fs::path const& folder)
        : settings_(settings), scene_(scene), view_(view), backends_(backends), folder_(folder),
          truth_(true_view(*backends.front(), oracle, view, settings.extent)) {
        fs::create_directories(folder_ / picture_path(scene.name, view.name, "truth").parent_path());
        write_png(path("truth"), truth_.picture);
    }

    // One record a backend, each given to `take` as soon as it is there; parity holds one for each but the first.
    // `beside`: the others' pictures are written too.
    void show(Technique const& technique, bool beside, std::span<Parity> parity, std::span<FitRecord> fits,
              std::function<void(Record)> const& take) {
        MapSet const maps = fit_on(*backends_.front(), technique, scene_, view_, settings_.extent);
        Drawn first;
        for (std::size_t i = 0; i < backends_.size(); ++i) {
            auto const& backend = backends_[i];
            bool const is_first = i == 0;
            Rendered const rendered = render(*backend, maps, settings_.extent, is_first ? 2 : 1);
            Measurement measured = measure(truth_, maps, rendered.frame);
            Record& record = measured.record;
            record.scene = scene_.name;
            record.view = view_.name;
            record.technique = technique.id;
            record.backend = backend->info().name;
            record.ms_depth = rendered.ms_depth;
            record.ms_receive = rendered.ms_receive;
            for (std::string const& message : backend->take_messages())
                record.note += (record.note.empty() ? "driver: " : "; driver: ") + message;
            Drawn drawn{rendered.frame.colour, maps_of(*backend, record.maps)};
            if (!maps.device_fit.empty()) hold_against_cpp(fits[i], technique, *backend, drawn);
            if (is_first) {
                write_pictures(technique, rendered.frame, drawn.maps, measured);
                first = std::move(drawn);
            } else {
                if (beside && std::ranges::count(shown_on_every_driver, technique.id) > 0)
                    write_png(path(technique.id + "-picture-" + record.backend), drawn.picture);
                record.unlike_first_backend_fraction = unlike_fraction(first.picture, drawn.picture);
                compare(parity[i - 1], first, drawn);
            }
            take(std::move(record));
        }
    }

    // Of four stable cascades.
    [[nodiscard]] std::vector<WayRecord> ways(backend::Backend& backend) const {
        std::vector<Technique> const all = techniques(true);
        auto const cascades = std::ranges::find(all, "cascades-4-stable", &Technique::id);
        MapSet const maps = fit(*cascades, scene_, view_, settings_.extent);
        SplitObjects const shown = objects_in_splits(maps, scene_, view_, settings_.extent);
        auto records = measure_ways(backend, maps, shown, settings_.extent, settings_.way_runs());
        for (WayRecord& record : records) {
            record.scene = scene_.name;
            record.view = view_.name;
            record.backend = backend.info().name;
        }
        return records;
    }

private:
    // Of the last fit of the backend and what was drawn with it. The C++ takes the depth that this backend drew.
    void hold_against_cpp(FitRecord& record, Technique const& technique, backend::Backend& backend,
                          Drawn const& drawn) const {
        std::vector<backend::MapConstants> const fitted = backend.read_fit();
        MapSet cpp = fit_on(backend, technique, scene_, view_, settings_.extent);
        cpp.device_fit.clear();
        draw_maps(backend, cpp, settings_.extent);
        draw_picture(backend, cpp, settings_.extent);
        compare(record, fitted, drawn, cpp, {backend.read_frame().colour, maps_of(backend, cpp.frame.map_count)});
    }

    [[nodiscard]] fs::path path(std::string const& name) const {
        return folder_ / picture_path(scene_.name, view_.name, name);
    }

    void write_pictures(Technique const& technique, backend::Frame const& frame,
                        std::span<backend::Image<float> const> maps, Measurement const& measured) const {
        write_png(path(technique.id + "-picture"), frame.colour);
        write_png(path(technique.id + "-difference"), difference_picture(truth_.picture, measured.outcome));
        write_png(path(technique.id + "-overlay"), overlay_picture(frame));
        write_png(path(technique.id + "-footprint"), footprint_picture(frame, measured.footprint));
        if (!maps.empty()) write_png(path(technique.id + "-maps"), maps_picture(maps, measured.touched));
    }

    Settings const& settings_;
    backend::Scene const& scene_;
    scenes::View const& view_;
    Backends backends_;
    fs::path const& folder_;
    ViewTruth truth_;
};

std::string percent(double fraction) {
    char text[32];
    std::snprintf(text, sizeof text, "%6.2f %%", 100.0 * fraction);
    return text;
}

// "[ 12/148] town / street / vdsm / egl"
std::string place(std::size_t done, std::size_t total, Record const& record) {
    std::string const all = std::to_string(total);
    std::string count = std::to_string(done);
    count.insert(0, all.size() - std::min(all.size(), count.size()), ' ');
    return "[" + count + "/" + all + "] " + record.scene + " / " + record.view + " / " + record.technique + " / " +
           record.backend;
}

}  // namespace

fs::path picture_path(std::string const& scene, std::string const& view, std::string const& name) {
    return fs::path("images") / scene / view / (name + ".png");
}

std::span<scenes::View const> chosen_views(scenes::NamedScene const& scene, Settings const& settings) {
    std::span<scenes::View const> const all(scene.views);
    return settings.quick ? all.first(std::min<std::size_t>(2, all.size())) : all;
}

Results run(Settings const& settings, std::span<scenes::NamedScene const> scenes, Backends backends,
            fs::path const& folder, Tell const& tell) {
    std::vector<Technique> const all = techniques(settings.quick);
    auto const serves = [](scenes::View const& view) {
        return [&view](Technique const& technique) { return technique.serves_spots || !view.has_spot; };
    };
    std::size_t total = 0;
    for (auto const& named : scenes)
        for (scenes::View const& view : chosen_views(named, settings))
            total += backends.size() * static_cast<std::size_t>(std::ranges::count_if(all, serves(view)));

    Results results;
    for (auto const& named : scenes) {
        oracle::RayOracle const oracle(named.scene);
        for (auto const& backend : backends) backend->upload(named.scene);
        std::vector<Parity> parity;
        for (auto const& backend : backends.subspan(1)) parity.push_back({named.scene.name, backend->info().name});
        std::vector<FitRecord> fits;
        for (auto const& backend : backends) fits.push_back({named.scene.name, backend->info().name});
        for (scenes::View const& view : chosen_views(named, settings)) {
            bool const is_first = &view == named.views.data();
            ViewShow show(settings, named.scene, view, backends, oracle, folder);
            for (Technique const& technique : all) {
                if (!serves(view)(technique)) continue;
                show.show(technique, is_first, parity, fits, [&](Record record) {
                    results.records.push_back(std::move(record));
                    Record const& kept = results.records.back();
                    tell(place(results.records.size(), total, kept) + percent(kept.mis_shadowed_fraction_off_edge) +
                         " off edge");
                });
            }
            if (!is_first) continue;
            tell("measuring the ways to draw the maps of " + named.scene.name);
            for (auto const& backend : backends) {
                std::ranges::move(show.ways(*backend), std::back_inserter(results.ways));
                for (std::string const& message : backend->take_messages()) tell("driver: " + message);
            }
            if (view.has_spot) continue;
            tell("flying through " + named.scene.name + ", " + std::to_string(settings.flight_frames()) + " frames");
            std::ranges::move(
                fly(*backends.front(), oracle, named.scene, view, settings.flight_frames(), settings.flight_map_size(),
                    [&tell](int frame) {
                        if (frame % 50 == 49) tell("frame " + std::to_string(frame + 1));
                    }),
                std::back_inserter(results.flights));
        }
        std::ranges::move(parity, std::back_inserter(results.parity));
        std::ranges::move(fits, std::back_inserter(results.fits));
    }
    tell("measuring what the sources claim");
    results.claims = measure_claims(*backends.front(), settings.quick);
    tell("looking closer");
    results.close_ups = show_close_ups(settings, *backends.front(), folder, tell);
    return results;
}

}  // namespace shadowmath::gallery
