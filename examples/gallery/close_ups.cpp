// SPDX-License-Identifier: MIT
#include "examples/gallery/close_ups.hpp"

#include "examples/gallery/close_up_maps.hpp"
#include "examples/gallery/close_up_truth.hpp"
#include "examples/support/png.hpp"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace shadowmath::gallery {

using example::write_png;
namespace {

namespace fs = std::filesystem;

constexpr double sun_radius = 0.02;  // four of the real sun: what a thin haze makes of it
constexpr float soft_gap = 0.5f;     // metres: a penumbra of 2 cm, some texels of the nearest map

double now_ms() {
    using namespace std::chrono;
    return duration<double, std::milli>(steady_clock::now().time_since_epoch()).count();
}

struct Answer {
    CloseUpTechnique technique;
    std::vector<float> visibility;
};

// Pixels that face away see no light, whatever a map says of them.
Answer answered(CloseUpPicture const& picture, CloseUpTechnique technique, std::vector<float> visibility) {
    for (std::size_t i = 0; i < visibility.size(); ++i)
        if (picture.shows(i) && !picture.faces_light(i)) visibility[i] = 0.0f;
    return {std::move(technique), std::move(visibility)};
}

void judge(Answer& answer, CloseUpTruth const& truth, CloseUp const& show) {
    CloseUpTechnique& t = answer.technique;
    for (std::size_t i = 0; i < truth.asked.size(); ++i) {
        if (truth.asked[i] == 0) continue;
        if (truth.off_edge[i] != 0 && (answer.visibility[i] >= 0.5f) != (truth.dark[i] == 0)) ++t.wrong_off_edge;
        t.error_hard += std::abs(double(answer.visibility[i]) - double(truth.lit[i]));
        double const error = std::abs(double(answer.visibility[i]) - double(truth.soft[i]));
        t.error += error;
        if (truth.soft[i] > 0.0f && truth.soft[i] < 1.0f) t.error_in_penumbra += error;
    }
    t.error_hard /= double(std::max(show.asked_pixels, 1l));
    t.error /= double(std::max(show.asked_pixels, 1l));
    t.error_in_penumbra /= double(std::max(show.penumbra_pixels, 1l));
}

double wrong_samples_ppm(std::vector<std::uint32_t> const& dark, CloseUpTruth const& truth, long asked) {
    long wrong = 0;
    for (std::size_t i = 0; i < dark.size(); ++i)
        if (truth.asked[i] != 0) wrong += std::popcount(dark[i] ^ truth.dark[i]);
    return 1e6 * double(wrong) / (32.0 * double(std::max(asked, 1l)));
}

std::vector<Answer> answers_for(CloseUpPicture const& picture, CloseUpMaps const& maps, ExactShadows const& exact) {
    double const pixels = double(picture.size());
    double const map_bytes = 4.0 * double(maps.map_size) * double(maps.map_size) * double(maps.depth.size()) / pixels;
    double const exact_ms = exact.ms_list + exact.ms_trace, exact_bytes = exact.bytes_per_pixel + 4.0;
    std::vector<float> const lit = lit_shares(exact.dark);
    std::vector<Answer> answers;
    auto const add = [&](char const* id, char const* title, char const* truth, double ms, double bytes,
                         std::vector<float> visibility) {
        CloseUpTechnique technique;
        technique.id = id;
        technique.title = title;
        technique.truth = truth;
        technique.ms = ms;
        technique.bytes_per_pixel = bytes;
        answers.push_back(answered(picture, std::move(technique), std::move(visibility)));
    };
    double const start = now_ms();
    std::vector<float> filtered = pcf(picture, maps);
    double const pcf_end = now_ms();
    std::vector<SoftShadow<float>> const soft = pcss(picture, maps, sun_radius);
    double const pcss_end = now_ms();
    std::vector<float> hybrid = hfts(lit, soft, soft_gap);
    double const hfts_ms = now_ms() - pcss_end + (pcss_end - pcf_end) + exact_ms;
    std::vector<float> penumbrae;
    for (SoftShadow<float> const& shadow : soft) penumbrae.push_back(shadow.visibility);
    add("pcf", "PCF, 3 × 3 taps", "hard", pcf_end - start, map_bytes, std::move(filtered));
    add("exact", "Exact, 32 samples", "hard", exact_ms, exact_bytes, lit);
    add("pcss", "PCSS, 32 + 32 taps", "soft", pcss_end - pcf_end, map_bytes, std::move(penumbrae));
    add("hfts", "HFTS: exact in contact, else PCSS", "soft", hfts_ms, map_bytes + exact_bytes, std::move(hybrid));
    return answers;
}

CloseUp show_one(CloseUpScene const& close_up, backend::Backend& backend, backend::Extent extent,
                 fs::path const& folder) {
    backend.upload(close_up.scene);
    CloseUpPicture const picture = close_up_picture(backend, close_up.view, extent);
    CloseUpMaps const maps = close_up_maps(backend, picture, close_up.scene);

    CloseUp show;
    show.name = close_up.name;
    show.title = close_up.title;
    show.width = extent.width;
    show.height = extent.height;
    show.triangles = long(close_up.scene.indices.size() / 3);
    show.light_rays = close_up.light_rays;
    show.sun_radius = sun_radius;
    show.soft_gap = double(soft_gap);
    show.ms_maps = maps.ms_draw;

    std::vector<ExactShadows> exact;
    for (Grid const& grid : grids_for(picture, close_up.scene)) {
        exact.push_back(exact_shadows(picture, close_up.scene, grid));
        ExactShadows const& made = exact.back();
        CloseUpGrid record{
            grid.name,     grid.title, made.mean_list, made.nodes_per_pixel, long(made.longest_list), made.ms_list,
            made.ms_trace, 0,          made.note};
        for (std::size_t i = 0; i < made.dark.size(); ++i)
            record.unlike_masks += made.dark[i] != exact.front().dark[i] ? 1 : 0;
        show.grids.push_back(std::move(record));
    }

    oracle::RayOracle const oracle(close_up.scene);
    CloseUpTruth const truth =
        close_up_truth(picture, close_up.scene, oracle, exact.front(), sun_radius, close_up.light_rays);
    for (std::size_t i = 0; i < truth.asked.size(); ++i) {
        show.asked_pixels += truth.asked[i];
        show.off_edge_pixels += truth.off_edge[i];
        show.penumbra_pixels += truth.asked[i] != 0 && truth.soft[i] > 0.0f && truth.soft[i] < 1.0f ? 1 : 0;
    }

    fs::path const images = folder / "images" / "close-ups" / close_up.name;
    fs::create_directories(images);
    write_png(images / "hard.png", shaded(picture, truth.lit));
    write_png(images / "soft.png", shaded(picture, truth.soft));
    for (Answer& answer : answers_for(picture, maps, exact.front())) {
        judge(answer, truth, show);
        CloseUpTechnique& technique = answer.technique;
        if (technique.id == "exact")
            technique.wrong_samples_ppm = wrong_samples_ppm(exact.front().dark, truth, show.asked_pixels);
        write_png(images / (technique.id + "-picture.png"), shaded(picture, answer.visibility));
        write_png(
            images / (technique.id + "-difference.png"),
            visibility_difference(picture, technique.truth == "hard" ? truth.lit : truth.soft, answer.visibility));
        show.techniques.push_back(std::move(technique));
    }
    return show;
}

std::string line_of(CloseUp const& show) {
    std::string line = "close-up " + show.name + ":";
    for (CloseUpTechnique const& t : show.techniques) {
        char text[96];
        if (t.truth == "hard")
            std::snprintf(text, sizeof text, " %s %ld of %ld wrong,", t.id.c_str(), t.wrong_off_edge,
                          show.off_edge_pixels);
        else
            std::snprintf(text, sizeof text, " %s %.4f from the area light,", t.id.c_str(), t.error);
        line += text;
    }
    line.pop_back();
    return line;
}

}  // namespace

std::vector<CloseUp> show_close_ups(Settings const& settings, backend::Backend& backend, fs::path const& folder,
                                    std::function<void(std::string const&)> const& tell) {
    backend::Extent const extent{std::max(settings.extent.width / 2, 16), std::max(settings.extent.height / 2, 16)};
    std::vector<CloseUp> shows;
    for (CloseUpScene const& close_up : close_up_scenes(settings)) {
        shows.push_back(show_one(close_up, backend, extent, folder));
        tell(line_of(shows.back()));
    }
    return shows;
}

}  // namespace shadowmath::gallery
