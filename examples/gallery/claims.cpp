// SPDX-License-Identifier: MIT
#include "examples/gallery/claims.hpp"

#include "examples/gallery/draw_maps.hpp"
#include "examples/gallery/measure.hpp"
#include "oracle/ray_oracle.hpp"
#include "scenes/scenes.hpp"

#include <shadowmath/shadowmath.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

namespace shadowmath::gallery {
namespace {

using backend::Extent;

std::string text(char const* format, auto... values) {
    char buffer[512];
    std::snprintf(buffer, sizeof buffer, format, values...);
    return buffer;
}

// A camera at a person's height over flat ground, looking ahead, the sun at the zenith: where theory and picture meet.
constexpr Extent screen{960, 540};
constexpr double ground_distance = 200.0;

ViewVolume<double> walker() {
    Pose<double> const pose =
        pose_looking(glm::dvec3(0.0, 1.7, 0.0), glm::dvec3(0.0, 0.0, -1.0), glm::dvec3(0.0, 1.0, 0.0));
    return perspective_view(pose, 1.0, double(screen.width) / screen.height, 0.1, ground_distance);
}

Aabb<double> flat_world() {
    return {glm::dvec3(-400.0, 0.0, -400.0), glm::dvec3(400.0, 10.0, 400.0)};
}

// Of a texel on the ground straight ahead at this eye depth.
Footprint<double> ground_footprint(glm::dmat4 const& map, double map_size, double depth) {
    return footprint(clip_from_world(walker(), gl_zero_to_one_clip), glm::dvec2(screen.width, screen.height), map,
                     map_size, glm::dvec3(0.0, 0.0, -depth), glm::dvec3(0.0, 1.0, 0.0));
}

// Square pixels that a texel covers, the mean over eye depths from `begin` to `end` metres, with four cascades at this
// lambda, each fitted to its slice's corners as in the chapter. The area, because splits act along the view alone: how
// far a slice reaches across is a matter of where it ends. (A stable sphere would not do: that of a wide slice is
// centred on the far end, and where the slice begins does not matter.)
double cascade_footprint(double lambda, double begin, double end) {
    CascadeOptions<double> options;
    options.lambda = lambda;
    options.map_size = 1024;
    options.blend = 0.0;
    options.fit = CascadeFit::tight;
    options.clip = gl_zero_to_one_clip;
    auto const fitted =
        fit_cascades(walker(), directional(glm::dvec3(0.0, -1.0, 0.0)), flat_world(), flat_world(), options);
    double sum = 0.0;
    constexpr int samples = 200;
    for (int i = 0; i < samples; ++i) {
        double const depth = begin + (end - begin) * (i + 0.5) / samples;
        for (auto const& cascade : fitted)
            if (depth < cascade.range.end) {
                sum += area(ground_footprint(cascade.map.clip_from_world, options.map_size, depth));
                break;
            }
    }
    return sum / samples;
}

Claim practical_near() {
    double const practical = cascade_footprint(0.5, 2.0, 10.0), uniform = cascade_footprint(0.0, 2.0, 10.0);
    return {"000-near-footprint",
            "GPU Gems 3, 10.1",
            "Practical splits at lambda = 1/2 have a smaller footprint near the eye than uniform splits",
            text("2 to 10 m ahead, mean: practical %.2f, uniform %.2f square pixels a texel", practical, uniform),
            practical < uniform,
            "the first practical split is shorter, so its map covers less"};
}

Claim practical_far() {
    double const practical = cascade_footprint(0.5, 120.0, 200.0), log = cascade_footprint(1.0, 120.0, 200.0);
    return {"000-far-footprint",
            "GPU Gems 3, 10.1",
            "Practical splits at lambda = 1/2 have a smaller footprint far away than logarithmic splits",
            text("120 to 200 m ahead, mean: practical %.3f, logarithmic %.3f square pixels a texel", practical, log),
            practical < log,
            "the last practical split is shorter than the last logarithmic one"};
}

Claim log_occupancy() {
    auto const splits = logarithmic_splits(1.0, 1000.0, 3);
    double const first = 100.0 * (splits.plane[1] - splits.plane[0]) / 999.0;
    double const second = 100.0 * (splits.plane[2] - splits.plane[1]) / 999.0;
    return {"000-log-occupancy",
            "GPU Gems 3, 10.1.1 as retold",
            "With n = 1, f = 1000 and three logarithmic splits, the first two take 1 % and 10 % of the range",
            text("they take %.4f %% and %.4f %%", first, second),
            std::abs(first - 1.0) < 0.005 && std::abs(second - 10.0) < 0.005,
            "the splits END at 1 % and 10 % of the far distance; what they occupy is 9/999 and 90/999"};
}

Claim worked_example() {
    auto const splits = practical_splits(1.0, 1000.0, 4);
    double const printed[] = {1.0, 128.185, 266.05, 463.625, 1000.0};
    double worst = 0.0;
    for (int i = 0; i <= 4; ++i) worst = std::max(worst, std::abs(splits.plane[i] - printed[i]));
    return {"002-worked-example",
            "weblog 2021 on practical splits",
            "n = 1, f = 1000, four splits, lambda = 1/2 gives 1, 128.185, 266.05, 463.625, 1000",
            text("1, %.9f, %.9f, %.9f, 1000", splits.plane[1], splits.plane[2], splits.plane[3]),
            worst < 1e-3,
            text("rounded too early on paper; the largest difference is %.3f m", worst)};
}

Claim worked_example_code() {
    // As the listing computes it: amount = 4 planes, fractions i / amount, the last overwritten by the far distance.
    double listing[4] = {1.0, 0.0, 0.0, 1000.0};
    for (int i = 1; i < 3; ++i) {
        double const fraction = i / 4.0;
        listing[i] = 0.5 * std::pow(1000.0, fraction) + 0.5 * (1.0 + 999.0 * fraction);
    }
    auto const right = practical_splits(1.0, 1000.0, 3);
    double const worst = std::max(std::abs(listing[1] - right.plane[1]), std::abs(listing[2] - right.plane[2]));
    return {"002-listing",
            "weblog 2021 on practical splits",
            "The listing's four planes are the practical splits of three slices",
            text("listing 1, %.2f, %.2f, 1000; three practical slices 1, %.2f, %.2f, 1000", listing[1], listing[2],
                 right.plane[1], right.plane[2]),
            worst < 0.01,
            "the fraction divides by the number of planes instead of slices, so the last slice takes two shares"};
}

ShadowMap<double> ground_vdsm(Light<double> const& light) {
    VdsmOptions<double> options;
    options.map_size = 1024;
    ShadowPlane<double> const ground{glm::dvec3(0.0, 1.0, 0.0), 0.0};
    return view_dependent_map(walker(), light, ground, flat_world(), flat_world(), options, gl_zero_to_one_clip);
}

Claim vdsm_constant() {
    auto const light = directional(glm::dvec3(0.4, -1.0, 0.3));
    auto const map = ground_vdsm(light);
    double least = std::numeric_limits<double>::max(), most = 0.0;
    for (double depth = 4.0; depth < ground_distance; depth *= 1.05) {
        double const here = ground_footprint(map.clip_from_world, 1024.0, depth).major;
        least = std::min(least, here);
        most = std::max(most, here);
    }
    return {"003-constant-footprint",
            "Kwon 2002, chapter 3",
            "On the shadow plane the ratio of map texels to screen pixels is constant from near to far",
            text("4 to 200 m ahead on the plane: %.6f to %.6f pixels a texel", least, most),
            map.visible && most / least < 1.0 + 1e-6,
            "map and screen see the plane from the same eye; only the region's scale lies between them"};
}

Claim vdsm_positive_w() {
    // A wall ahead, lit from the front: light rays through its upper part meet the ground behind the eye.
    auto const map = ground_vdsm(directional(glm::dvec3(0.0, -0.5, 1.0)));
    int behind = 0, all = 0;
    for (double height = 0.05; height < 10.0; height += 0.1, ++all) {
        glm::dvec4 const clip = map.clip_from_world * glm::dvec4(0.0, height, -10.0, 1.0);
        behind += clip.w <= 0.0;
    }
    return {"003-positive-w",
            "Kwon 2002, 3.1.3",
            "The projected clip w is always positive",
            text("on a wall 10 m ahead, sun in front at 27 degrees: %d of %d points have w <= 0", behind, all),
            map.visible && behind == 0,
            "a receiver whose light ray meets the plane behind the eye has w <= 0; the sampler falls back for it"};
}

struct Timing {
    double depth_ms = 0.0, receive_ms = 0.0;
};

Timing timed(backend::Backend& backend, MapSet const& set, Extent extent) {
    Timing timing;
    timing.depth_ms = draw_maps(backend, set, extent);
    timing.receive_ms = draw_picture(backend, set, extent);
    return timing;
}

double median(std::vector<double> values) {
    auto const middle = values.begin() + std::ptrdiff_t(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

Technique technique(std::string const& id) {
    for (Technique const& t : techniques(false))
        if (t.id == id) return t;
    return {};
}

Claim vdsm_cost(backend::Backend& backend, scenes::NamedScene const& town, Extent extent, int rounds) {
    scenes::View const& view = town.views.front();
    MapSet const standard = fit(technique("uniform-1"), town.scene, view, extent);
    MapSet const vdsm = fit(technique("vdsm"), town.scene, view, extent);
    std::vector<double> depth_ratios, receive_ratios;
    for (int i = 0; i < rounds; ++i) {
        Timing const a = timed(backend, standard, extent), b = timed(backend, vdsm, extent);
        if (i == 0) continue;  // the first round pays for buffers
        depth_ratios.push_back(b.depth_ms / a.depth_ms);
        receive_ratios.push_back(b.receive_ms / a.receive_ms);
    }
    double const depth = median(depth_ratios), receive = median(receive_ratios);
    return {"003-cost",
            "Kwon 2002, chapter 5",
            "The view-dependent map costs no more than the standard map",
            text("view-dependent / standard, median of %d: drawing the map %.2f, drawing the picture %.2f (town, %s)",
                 rounds - 1, depth, receive, view.name.c_str()),
            depth <= 1.1 && receive <= 1.1,
            "one matrix either way; what differs is how many triangles fall into the map and how large they are there"};
}

struct NearErrors {
    long wrong = 0, judged = 0;
};

// Pixels nearer than a tenth of the shadow distance, facing the light, whose answer differs from the traced one.
NearErrors near_errors(backend::Backend& backend, oracle::RayOracle const& rays, scenes::NamedScene const& town,
                       scenes::View const& view, std::string const& id, Extent extent) {
    MapSet const set = fit(technique(id), town.scene, view, extent);
    timed(backend, set, extent);
    backend::Frame const frame = backend.read_frame();
    auto const truth = rays.truth(frame.position, frame.normal, glm::dvec4(set.frame.light));
    glm::dvec3 const eye(set.frame.eye_position), forward(set.frame.eye_forward);
    NearErrors errors;
    for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
        auto const& p = frame.position.pixels[i];
        bool const shadowed = truth.pixels[i] == oracle::Truth::shadowed;
        if (!shadowed && truth.pixels[i] != oracle::Truth::lit) continue;
        if (glm::dot(forward, glm::dvec3(p.x, p.y, p.z) - eye) > 0.1 * view.shadow_distance) continue;
        ++errors.judged;
        errors.wrong += (frame.normal.pixels[i].w < 0.5f) != shadowed;
    }
    return errors;
}

Claim simple_near(backend::Backend& backend, scenes::NamedScene const& town, Extent extent) {
    oracle::RayOracle const rays(town.scene);
    NearErrors simple, standard;
    for (scenes::View const& view : town.views) {
        if (view.has_spot) continue;
        for (auto [id, sum] : {std::pair{"simple-perspective", &simple}, std::pair{"uniform-1-2048", &standard}}) {
            NearErrors const here = near_errors(backend, rays, town, view, id, extent);
            sum->wrong += here.wrong;
            sum->judged += here.judged;
        }
    }
    auto const percent = [](NearErrors const& e) {
        return e.judged > 0 ? 100.0 * double(e.wrong) / double(e.judged) : 0.0;
    };
    return {"004-near-pixels",
            "weblog 2012 on a simple perspective map",
            "The simple perspective map at 1024 squared has fewer mis-shadowed near pixels than the standard one at "
            "2048 squared",
            text("near pixels of the town's views that are wrong: simple %ld of %ld (%.2f %%), standard %ld of %ld "
                 "(%.2f %%)",
                 simple.wrong, simple.judged, percent(simple), standard.wrong, standard.judged, percent(standard)),
            simple.judged > 0 && simple.wrong < standard.wrong,
            "the warp spends texels near the eye wherever light and view are far from parallel"};
}

Claim fitted_on_the_device(backend::Backend& backend, scenes::NamedScene const& town, Extent extent) {
    int pictures = 0;
    long unlike = 0;
    for (scenes::View const& view : town.views) {
        if (view.has_spot) continue;
        std::array<backend::Image<backend::Rgba8>, 2> pair;
        for (auto [id, picture] : {std::pair{"sdsm", &pair[0]}, std::pair{"sdsm-gpu", &pair[1]}}) {
            timed(backend, fit_on(backend, technique(id), town.scene, view, extent), extent);
            *picture = backend.read_frame().colour;
        }
        unlike += unlike_pixels(pair[0], pair[1]);
        ++pictures;
    }
    return {"sdsm-device",
            "shadowmath",
            "Maps fitted on the GPU and used there without read-back give the picture of those fitted in C++",
            text("%ld pixels of %d pictures of the town are unlike", unlike, pictures),
            pictures > 0 && unlike == 0,
            "the shaders round as the C++ does: the matrices are the same bits"};
}

Claim simple_wastes_half() {
    // As printed: the row of y maps [zn, zf] to [0, 1], and the map is [-1, 1].
    glm::dmat4 const printed = printed_simple_warp(1.0, 2.0, 0.1, 1.0);
    auto const y_at = [&](double y) {
        glm::dvec4 const p = printed * glm::dvec4(0.0, y, 0.5, 1.0);
        return p.y / p.w;
    };
    return {"004-whole-map",
            "weblog 2012 on a simple perspective map",
            "The printed matrix spreads the ground over the whole map",
            text("near end of the ground at y = %.3f, far end at y = %.3f of [-1, 1]", y_at(0.1), y_at(1.0)),
            y_at(0.1) <= -0.999,
            "the row was taken from a projection whose depth runs from 0 to 1: half of the texels stay empty"};
}

}  // namespace

std::vector<Claim> measure_claims(backend::Backend& backend, bool quick) {
    Extent const extent = quick ? Extent{480, 270} : screen;
    auto const town = scenes::make_scene("town", quick ? scenes::SceneSize::small : scenes::SceneSize::medium);
    backend.upload(town.scene);
    return {practical_near(),
            practical_far(),
            log_occupancy(),
            worked_example(),
            worked_example_code(),
            vdsm_constant(),
            vdsm_positive_w(),
            vdsm_cost(backend, town, extent, quick ? 4 : 8),
            simple_near(backend, town, extent),
            simple_wastes_half(),
            fitted_on_the_device(backend, town, extent)};
}

}  // namespace shadowmath::gallery
