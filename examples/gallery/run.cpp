// SPDX-License-Identifier: MIT
#include "examples/gallery/run.hpp"

#include "examples/gallery/measure.hpp"
#include "examples/gallery/pictures.hpp"
#include "examples/gallery/truth.hpp"

#include <algorithm>
#include <cstdio>
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
    std::vector<backend::DepthLayer> layers;
    for (Map const& map : maps.maps) layers.push_back({glm::mat4(map.clip_from_world), map.casters});
    Rendered rendered;
    rendered.ms_depth = layers.empty() ? 0.0 : std::numeric_limits<double>::max();
    rendered.ms_receive = std::numeric_limits<double>::max();
    for (int i = 0; i < runs; ++i) {
        if (!layers.empty())
            rendered.ms_depth = std::min(rendered.ms_depth, backend.draw_depth({maps.map_size, layers}).milliseconds);
        rendered.ms_receive = std::min(rendered.ms_receive, backend.draw_scene({extent, maps.frame}).milliseconds);
    }
    rendered.frame = backend.read_frame();
    return rendered;
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

    // One record a backend, each given to `take` as soon as it is there.
    void show(Technique const& technique, std::function<void(Record)> const& take) {
        MapSet const maps = fit(technique, scene_, view_, settings_.extent);
        backend::Image<backend::Rgba8> first_colour;
        for (auto const& backend : backends_) {
            bool const is_first = &backend == &backends_.front();
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
            if (is_first) {
                write_pictures(technique, *backend, rendered.frame, measured);
                first_colour = rendered.frame.colour;
            } else {
                record.unlike_first_backend_fraction = unlike_fraction(first_colour, rendered.frame.colour);
            }
            take(std::move(record));
        }
    }

private:
    [[nodiscard]] fs::path path(std::string const& name) const {
        return folder_ / picture_path(scene_.name, view_.name, name);
    }

    void write_pictures(Technique const& technique, backend::Backend& backend, backend::Frame const& frame,
                        Measurement const& measured) const {
        write_png(path(technique.id + "-picture"), frame.colour);
        write_png(path(technique.id + "-difference"), difference_picture(truth_.picture, measured.outcome));
        write_png(path(technique.id + "-overlay"), overlay_picture(frame));
        write_png(path(technique.id + "-footprint"), footprint_picture(frame, measured.footprint));
        if (measured.touched.empty()) return;
        std::vector<backend::Image<float>> depths;
        for (int i = 0; i < measured.record.maps; ++i) depths.push_back(backend.read_depth(i));
        write_png(path(technique.id + "-maps"), maps_picture(depths, measured.touched));
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
        for (scenes::View const& view : chosen_views(named, settings)) {
            ViewShow show(settings, named.scene, view, backends, oracle, folder);
            for (Technique const& technique : all) {
                if (!serves(view)(technique)) continue;
                show.show(technique, [&](Record record) {
                    results.records.push_back(std::move(record));
                    Record const& kept = results.records.back();
                    tell(place(results.records.size(), total, kept) + percent(kept.mis_shadowed_fraction_off_edge) +
                         " off edge");
                });
            }
        }
    }
    tell("measuring what the sources claim");
    results.claims = measure_claims(*backends.front(), settings.quick);
    tell("looking closer");
    results.close_ups = show_close_ups(settings, *backends.front(), folder, tell);
    return results;
}

}  // namespace shadowmath::gallery
