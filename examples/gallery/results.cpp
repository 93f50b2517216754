// SPDX-License-Identifier: MIT
#include "examples/gallery/results.hpp"

#include "examples/gallery/pictures.hpp"
#include "examples/gallery/promises.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <optional>
#include <thread>

namespace shadowmath::gallery {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(Record const& r) {
    return {{"scene", r.scene},
            {"view", r.view},
            {"technique", r.technique},
            {"backend", r.backend},
            {"map_size", r.map_size},
            {"maps", r.maps},
            {"lit_facing_pixels", r.lit_facing_pixels},
            {"off_edge_pixels", r.off_edge_pixels},
            {"beyond_pixels", r.beyond_pixels},
            {"unmapped_pixels", r.unmapped_pixels},
            {"mis_shadowed_fraction", r.mis_shadowed_fraction},
            {"mis_shadowed_fraction_off_edge", r.mis_shadowed_fraction_off_edge},
            {"footprint_max", r.footprint_max},
            {"footprint_p95", r.footprint_p95},
            {"footprint_mean", r.footprint_mean},
            {"map_used_fraction", r.map_used_fraction},
            {"ms_depth", r.ms_depth},
            {"ms_receive", r.ms_receive},
            {"unlike_first_backend_fraction", r.unlike_first_backend_fraction},
            {"splits", r.splits},
            {"note", r.note}};
}

Json to_json(std::optional<backend::DriverCount> const& counted) {
    if (!counted) return nullptr;
    return {{"vertices", counted->vertices},
            {"triangles", counted->triangles},
            {"vertex_runs", counted->vertex_runs},
            {"geometry_runs", counted->geometry_runs},
            {"geometry_triangles", counted->geometry_triangles},
            {"clipper_triangles", counted->clipper_triangles},
            {"raster_triangles", counted->raster_triangles}};
}

Json to_json(WayRecord const& w) {
    return {{"scene", w.scene},
            {"view", w.view},
            {"backend", w.backend},
            {"way", w.way},
            {"with_picture", w.with_picture},
            {"map_size", w.map_size},
            {"maps", w.maps},
            {"maps_in_memory", w.maps_in_memory},
            {"passes", w.work.passes},
            {"draw_calls", w.work.draw_calls},
            {"vertices", w.work.vertices},
            {"triangles", w.work.triangles},
            {"driver", to_json(w.work.driver)},
            {"milliseconds", w.work.milliseconds},
            {"texels", w.texels},
            {"unlike_texels", w.unlike_texels},
            {"largest_difference", w.largest_difference},
            {"pixels", w.pixels},
            {"unlike_pixels", w.unlike_pixels}};
}

Json to_json(Parity const& p) {
    return {{"scene", p.scene},
            {"backend", p.backend},
            {"pictures", p.pictures},
            {"maps", p.maps},
            {"covered_texels", p.covered_texels},
            {"covered_in_one", p.covered_in_one},
            {"unlike_texels", p.unlike_texels},
            {"largest_ulp", p.largest_ulp},
            {"pixels", p.pixels},
            {"unlike_pixels", p.unlike_pixels},
            {"unlike_off_edges", p.unlike_off_edges}};
}

Json to_json(FitRecord const& f) {
    return {{"scene", f.scene},
            {"backend", f.backend},
            {"pictures", f.pictures},
            {"maps", f.maps},
            {"unlike_maps", f.unlike_maps},
            {"texels", f.texels},
            {"unlike_texels", f.unlike_texels},
            {"pixels", f.pixels},
            {"unlike_pixels", f.unlike_pixels}};
}

Json to_json(FlightRecord const& f) {
    return {{"scene", f.scene},
            {"view", f.view},
            {"policy", f.policy},
            {"title", f.title},
            {"stable", f.stable},
            {"frames", f.frames},
            {"map_size", f.map_size},
            {"maps", f.maps},
            {"points", f.points},
            {"decisions", f.decisions},
            {"flips", f.flips},
            {"decisions_within", f.decisions_within},
            {"flips_within", f.flips_within},
            {"shimmer", shimmer(f)},
            {"shimmer_within", shimmer_within(f)}};
}

Json to_json(Claim const& c) {
    return {{"id", c.id},       {"source", c.source}, {"statement", c.statement}, {"measured", c.measured},
            {"holds", c.holds}, {"reason", c.reason}};
}

Json to_json(CloseUpTechnique const& t) {
    return {{"id", t.id},
            {"title", t.title},
            {"truth", t.truth},
            {"wrong_off_edge", t.wrong_off_edge},
            {"wrong_samples_ppm", t.wrong_samples_ppm},
            {"error_hard", t.error_hard},
            {"error", t.error},
            {"error_in_penumbra", t.error_in_penumbra},
            {"ms", t.ms},
            {"bytes_per_pixel", t.bytes_per_pixel}};
}

Json to_json(CloseUpGrid const& g) {
    return {{"name", g.name},
            {"title", g.title},
            {"mean_list", g.mean_list},
            {"longest_list", g.longest_list},
            {"nodes_per_pixel", g.nodes_per_pixel},
            {"ms_list", g.ms_list},
            {"ms_trace", g.ms_trace},
            {"unlike_masks", g.unlike_masks},
            {"note", g.note}};
}

template <class Items>
Json list(Items const& items);

Json to_json(CloseUp const& c) {
    return {{"name", c.name},
            {"title", c.title},
            {"width", c.width},
            {"height", c.height},
            {"triangles", c.triangles},
            {"asked_pixels", c.asked_pixels},
            {"off_edge_pixels", c.off_edge_pixels},
            {"penumbra_pixels", c.penumbra_pixels},
            {"light_rays", c.light_rays},
            {"sun_radius", c.sun_radius},
            {"soft_gap", c.soft_gap},
            {"ms_maps", c.ms_maps},
            {"techniques", list(c.techniques)},
            {"grids", list(c.grids)}};
}

Json to_json(Technique const& t) {
    return {{"id", t.id},         {"title", t.title},
            {"source", t.source}, {"map_size", t.map_size},
            {"maps", t.maps},     {"serves_spots", t.serves_spots}};
}

// Degrees of the light above the horizon.
double elevation(scenes::View const& view) {
    glm::dvec3 const travel = view.has_spot ? view.spot_axis : view.light_travel;
    return std::asin(std::fmin(std::fmax(-travel.y, -1.0), 1.0)) * 180.0 / 3.14159265358979323846;
}

Json to_json(scenes::View const& view) {
    return {{"name", view.name},
            {"light", view.has_spot ? "spot" : "sun"},
            {"light_elevation_degrees", elevation(view)},
            {"shadow_distance", view.shadow_distance},
            {"truth", picture_path("", view.name, "truth").filename().string()}};
}

Json to_json(scenes::NamedScene const& named, Settings const& settings) {
    Json views = Json::array();
    for (scenes::View const& view : chosen_views(named, settings)) views.push_back(to_json(view));
    return {{"name", named.scene.name},
            {"triangles", named.scene.indices.size() / 3},
            {"objects", named.scene.objects.size()},
            {"views", views}};
}

std::string css(Colour c) {
    return "rgb(" + std::to_string(c[0]) + "," + std::to_string(c[1]) + "," + std::to_string(c[2]) + ")";
}

template <class Items>
Json list(Items const& items) {
    Json array = Json::array();
    for (auto const& item : items) array.push_back(to_json(item));
    return array;
}

}  // namespace

std::string results_json(Settings const& settings, std::span<scenes::NamedScene const> scenes, Backends backends,
                         Results const& results) {
    Json drivers = Json::array();
    for (auto const& backend : backends)
        drivers.push_back({{"name", backend->info().name}, {"driver", backend->info().driver}});
    Json shown = Json::array();
    for (auto const& named : scenes) shown.push_back(to_json(named, settings));
    Json heat = Json::array(), tints = Json::array();
    for (Colour const colour : footprint_scale(16)) heat.push_back(css(colour));
    for (int map = 0; map < backend::max_maps; ++map) tints.push_back(css(map_tint(map)));

    Json const document = {
        {"records", list(results.records)},
        {"ways", list(results.ways)},
        {"parity", list(results.parity)},
        {"fits", list(results.fits)},
        {"flights", list(results.flights)},
        {"judged", share_a_rasteriser(backends)},
        {"broken", broken_promises(results)},
        {"claims", list(results.claims)},
        {"close_ups", list(results.close_ups)},
        {"machine", {{"backends", drivers}, {"threads", std::thread::hardware_concurrency()}}},
        {"settings",
         {{"width", settings.extent.width},
          {"height", settings.extent.height},
          {"quick", settings.quick},
          {"seed", settings.seed},
          {"way_runs", settings.way_runs()},
          {"filter_radius", filter_radius},
          {"edge_radius_pixels", 1.25}}},
        {"shown_on_every_driver", shown_on_every_driver},
        {"techniques", list(techniques(settings.quick))},
        {"scenes", shown},
        {"palette", {{"footprint", heat}, {"maps", tints}}},
    };
    // Driver strings and file names may hold any byte; what is no UTF-8 is replaced.
    return document.dump(1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace shadowmath::gallery
