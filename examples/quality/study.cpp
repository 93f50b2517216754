// SPDX-License-Identifier: MIT
#include "examples/quality/study.hpp"

#include "backends/gl/gl_backend.hpp"
#include "examples/gallery/draw_maps.hpp"
#include "examples/gallery/measure.hpp"
#include "examples/gallery/pictures.hpp"
#include "examples/gallery/truth.hpp"
#include "examples/quality/attainable.hpp"
#include "examples/quality/fresh_views.hpp"
#include "examples/quality/views.hpp"
#include "examples/support/percentile.hpp"
#include "scenes/obj.hpp"
#include "scenes/scenes.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <optional>
#include <stdexcept>

namespace shadowmath::quality {
namespace {

namespace fs = std::filesystem;
using gallery::Question;
using gallery::ViewTruth;
using oracle::Truth;

// What is kept of a truth: two bytes a pixel, behind what it is the truth of.
std::string identity(backend::Scene const& scene, scenes::View const& view, backend::Extent extent) {
    // FNV-1a.
    std::uint64_t sum = 0xcbf29ce484222325u;
    auto const add = [&sum](void const* data, std::size_t size) {
        for (std::size_t i = 0; i < size; ++i) sum = (sum ^ static_cast<std::uint8_t const*>(data)[i]) * 0x100000001b3u;
    };
    for (backend::Vertex const& vertex : scene.vertices) add(&vertex.position, sizeof vertex.position);
    add(scene.indices.data(), scene.indices.size() * sizeof(std::uint32_t));
    std::string text =
        "truth 2 " + std::to_string(sum) + " " + std::to_string(extent.width) + "x" + std::to_string(extent.height);
    for (double const number :
         {view.eye.x, view.eye.y, view.eye.z, view.forward.x, view.forward.y, view.forward.z, view.light_travel.x,
          view.light_travel.y, view.light_travel.z, view.shadow_distance, view.fov_y_radians})
        text += " " + std::to_string(number);
    return text + "\n";
}

std::optional<ViewTruth> kept_truth(fs::path const& file, std::string const& identity, backend::Backend& backend,
                                    scenes::View const& view, backend::Extent extent) {
    std::ifstream stream(file, std::ios::binary);
    std::string line;
    if (!stream || !std::getline(stream, line) || line + "\n" != identity) return std::nullopt;
    ViewTruth truth;
    truth.state = backend::Image<Truth>(extent);
    truth.question = backend::Image<Question>(extent);
    auto const size = std::streamsize(truth.state.pixels.size());
    static_assert(sizeof(Truth) == 1 && sizeof(Question) == 1);
    stream.read(reinterpret_cast<char*>(truth.state.pixels.data()), size);
    stream.read(reinterpret_cast<char*>(truth.question.pixels.data()), size);
    if (!stream) return std::nullopt;
    backend.draw_scene({extent, gallery::unshadowed(view, extent)});
    truth.position = backend.read_frame().position;
    return truth;
}

ViewTruth truth_of(Settings const& settings, backend::Scene const& scene, backend::Backend& backend,
                   oracle::RayOracle const& oracle, scenes::View const& view) {
    fs::path const file = settings.truth / (scene.name + "-" + view.name);
    std::string const id = identity(scene, view, settings.extent);
    if (!settings.truth.empty())
        if (auto kept = kept_truth(file, id, backend, view, settings.extent)) return std::move(*kept);
    ViewTruth truth = gallery::true_view(backend, oracle, view, settings.extent);
    if (!settings.truth.empty()) {
        fs::create_directories(settings.truth);
        std::ofstream stream(file, std::ios::binary);
        auto const size = std::streamsize(truth.state.pixels.size());
        stream << id;
        stream.write(reinterpret_cast<char const*>(truth.state.pixels.data()), size);
        stream.write(reinterpret_cast<char const*>(truth.question.pixels.data()), size);
    }
    return truth;
}

long dark_unmapped(ViewTruth const& truth, backend::Frame const& frame) {
    long count = 0;
    for (std::size_t i = 0; i < truth.state.pixels.size(); ++i) {
        Question const question = truth.question.pixels[i];
        bool const judged = question == Question::near_edge || question == Question::off_edge;
        bool const unmapped = std::abs(frame.position.pixels[i].w + 1.0f) < 0.25f;
        if (judged && unmapped && truth.state.pixels[i] == Truth::shadowed) ++count;
    }
    return count;
}

bool is_wanted(std::vector<std::string> const& only, std::string const& name) {
    return only.empty() || std::ranges::any_of(only, [&](auto const& part) { return name.find(part) != name.npos; });
}

std::vector<scenes::NamedScene> models_in(fs::path const& folder, Results& results) {
    std::vector<fs::path> files;
    std::error_code error;
    for (auto const& entry : fs::directory_iterator(folder, error))
        if (entry.path().extension() == ".obj") files.push_back(entry.path());
    std::ranges::sort(files);
    std::vector<scenes::NamedScene> models;
    for (auto const& file : files) models.push_back(scenes::load_obj(file));
    if (models.empty()) results.absent.push_back("real meshes: no OBJ file in " + folder.string());
    return models;
}

class Study {
public:
    Study(Settings const& settings, fs::path const& folder, std::function<void(std::string const&)> const& tell)
        : settings_(settings), folder_(folder), tell_(tell),
          backend_(backend::make_gl_backend(settings.backend == "osmesa" ? backend::GlContextKind::osmesa
                                                                         : backend::GlContextKind::egl)) {
        results_.driver = backend_->info().driver;
        for (Policy const& policy : policies())
            if (settings.only_policies.empty() ||
                std::ranges::find(settings.only_policies, policy.id) != settings.only_policies.end())
                results_.policies.push_back(policy);
    }

    Results run() {
        std::uint64_t const seed = settings_.fresh.value_or(1);
        for (auto const& name : scenes::scene_names()) show(scenes::make_scene(name, scenes::SceneSize::medium, seed));
        for (auto const& model : models_in(settings_.models, results_)) show(model);
        return std::move(results_);
    }

private:
    void show(scenes::NamedScene const& named) {
        oracle::RayOracle const oracle(named.scene);
        std::vector<scenes::View> views =
            settings_.fresh ? fresh_views(named, oracle, *settings_.fresh) : study_views(named);
        std::erase_if(views, [&](auto const& view) {
            return !is_wanted(settings_.only_views, named.scene.name + "/" + view.name);
        });
        if (views.empty()) return;
        backend_->upload(named.scene);
        for (scenes::View const& view : views) show(named.scene, oracle, view);
    }

    void show(backend::Scene const& scene, oracle::RayOracle const& oracle, scenes::View const& view) {
        ViewTruth const truth = truth_of(settings_, scene, *backend_, oracle, view);
        backend_->draw_scene({settings_.extent, gallery::unshadowed(view, settings_.extent)});
        Coarse const coarse = coarse_of(backend_->read_frame(), view);
        ViewResult result{scene.name, view.name, view.shadow_distance, {}, {}};
        std::string line;
        for (Policy const& policy : results_.policies) {
            Made const made = make_maps(policy, scene, view, settings_.extent, coarse);
            gallery::draw_maps(*backend_, made.maps, settings_.extent);
            gallery::draw_picture(*backend_, made.maps, settings_.extent);
            backend::Frame const frame = backend_->read_frame();
            gallery::Measurement const measured = gallery::measure(truth, made.maps, frame);
            gallery::Record const& record = measured.record;
            result.scores.push_back({policy.id, record.mis_shadowed_fraction_off_edge, record.off_edge_pixels,
                                     record.footprint_mean, record.footprint_p95, record.map_used_fraction,
                                     map_figures(truth, made.maps, frame, view), dark_unmapped(truth, frame),
                                     record.maps, made.milliseconds, made.maps.note});
            if (settings_.search_steps > 0 && policy.id == "chosen-depth")
                result.attainable = sought(truth, frame, made.maps, view);
            keep_pictures(scene.name + "-" + view.name, policy, frame, measured, result);
            char text[64];
            std::snprintf(text, sizeof text, " %s %.3f", policy.id.c_str(),
                          100.0 * record.mis_shadowed_fraction_off_edge);
            line += text;
        }
        for (std::string const& message : backend_->take_messages()) throw std::runtime_error(message);
        tell_(scene.name + "/" + view.name + ":" + line);
        results_.views.push_back(std::move(result));
    }

    [[nodiscard]] Attainable sought(ViewTruth const& truth, backend::Frame const& frame, gallery::MapSet const& maps,
                                    scenes::View const& view) const {
        std::vector<SurfacePoint<double>> surfaces;
        for (std::size_t i = 0; i < truth.question.pixels.size(); ++i) {
            Question const question = truth.question.pixels[i];
            if (question == Question::none || question == Question::beyond) continue;
            backend::Texel4 const &p = frame.position.pixels[i], &n = frame.normal.pixels[i];
            surfaces.push_back({{p.x, p.y, p.z}, {n.x, n.y, n.z}});
        }
        std::vector<LightPixel> const pixels = light_pixels(surfaces, view, settings_.extent);
        double const usable = usable_texels(map_size, gallery::filter_radius + 1.0);
        std::vector<Quad<double>> start;
        for (gallery::Map const& map : maps.maps)
            start.push_back(quad_of(map.clip_from_world, view, usable / map_size));
        SearchEffort effort;
        effort.steps = settings_.search_steps;
        return {searched(pixels, start, Aim::mean, map_count, usable, effort).mean,
                searched(pixels, start, Aim::p95, map_count, usable, effort).p95};
    }

    // Of the recipe to beat and of what is chosen.
    void keep_pictures(std::string const& name, Policy const& policy, backend::Frame const& frame,
                       gallery::Measurement const& measured, ViewResult& result) const {
        if (!settings_.pictures || (policy.id != "folk-focus" && policy.family != Family::chosen)) return;
        std::string const file = name + "-" + policy.id + ".png";
        gallery::write_png(folder_ / file, gallery::footprint_picture(frame, measured.footprint));
        result.pictures.emplace_back(policy.id, file);
    }

    Settings const& settings_;
    fs::path const& folder_;
    std::function<void(std::string const&)> const& tell_;
    std::unique_ptr<backend::Backend> backend_;
    Results results_;
};

// The index of the least; -1 of none.
template <class Items, class Value>
std::ptrdiff_t least_of(Items const& items, Value&& value) {
    std::ptrdiff_t best = -1;
    for (std::size_t i = 0; i < items.size(); ++i) {
        if (!value(i)) continue;
        if (best < 0 || *value(i) < *value(std::size_t(best))) best = std::ptrdiff_t(i);
    }
    return best;
}

double median_of(Results const& results, std::function<double(ViewResult const&)> const& value) {
    std::vector<double> values;
    for (ViewResult const& view : results.views) values.push_back(value(view));
    return example::percentile(std::move(values), 0.5);
}

}  // namespace

Results run_study(Settings const& settings, fs::path const& folder,
                  std::function<void(std::string const&)> const& tell) {
    return Study(settings, folder, tell).run();
}

std::vector<Summary> summaries(Results const& results) {
    std::vector<Summary> all;
    for (Policy const& policy : results.policies) all.push_back({.policy = policy, .worst_view = {}, .figures = {}});
    double const count = std::max<double>(1.0, double(results.views.size()));
    for (ViewResult const& view : results.views)
        for (std::size_t p = 0; p < all.size(); ++p) {
            Score const& score = view.scores[p];
            Summary& sum = all[p];
            double const pixels = double(std::max(score.off_edge_pixels, 1l));
            sum.mean += score.wrong / count;
            sum.geometric_mean += std::log(std::max(score.wrong, 0.5 / pixels)) / count;
            if (score.wrong > sum.worst) {
                sum.worst = score.wrong;
                sum.worst_view = view.scene + "/" + view.view;
            }
            sum.footprint_mean += score.footprint_mean / count;
            sum.footprint_p95 += score.footprint_p95 / count;
            sum.texels_used += score.texels_used / count;
            sum.figures.footprint_median += score.figures.footprint_median / count;
            sum.figures.perspective_mean += score.figures.perspective_mean / count;
            sum.figures.perspective_p95 += score.figures.perspective_p95 / count;
            sum.figures.texels_seen += score.figures.texels_seen / count;
            sum.figures.texels_most += score.figures.texels_most / count;
            sum.figures.capped_mean += score.figures.capped_mean / count;
            sum.dark_unmapped += score.dark_unmapped;
            sum.fit_milliseconds += score.fit_milliseconds / count;
        }
    auto const is_folk = [&](std::size_t p) { return all[p].policy.family == Family::folk; };
    auto const best = least_of(all, [&](std::size_t p) -> std::optional<double> {
        return is_folk(p) ? std::optional(all[p].mean) : std::nullopt;
    });
    for (std::size_t p = 0; p < all.size(); ++p) {
        Summary& sum = all[p];
        sum.geometric_mean = std::exp(sum.geometric_mean);
        sum.footprint_mean_median = median_of(results, [&](ViewResult const& v) { return v.scores[p].footprint_mean; });
        sum.footprint_p95_median = median_of(results, [&](ViewResult const& v) { return v.scores[p].footprint_p95; });
        if (best < 0) continue;
        double const least = all[std::size_t(best)].mean;
        sum.of_best_folk = least > 0.0 ? sum.mean / least : 0.0;
        for (ViewResult const& view : results.views) {
            double folk_here = std::numeric_limits<double>::max();
            for (std::size_t q = 0; q < all.size(); ++q)
                if (is_folk(q)) folk_here = std::min(folk_here, view.scores[q].wrong);
            sum.not_worse += (view.scores[p].wrong <= view.scores[std::size_t(best)].wrong ? 1.0 : 0.0) / count;
            sum.not_worse_than_any += (view.scores[p].wrong <= folk_here ? 1.0 : 0.0) / count;
        }
    }
    return all;
}

}  // namespace shadowmath::quality
