// SPDX-License-Identifier: MIT
//
// No false alarms: whatever this library fits, to any view of the scenes, is well.
#include "examples/doctor/diagnosis.hpp"
#include "examples/doctor/report.hpp"
#include "scenes/scenes.hpp"

#include <shadowmath/shadowmath.hpp>

#include <gtest/gtest.h>

#include <span>

using namespace shadowmath;
using namespace shadowmath::doctor;

namespace {

constexpr int map_size = 1024;

Aabb<double> box_of(backend::Scene const& scene) {
    return {glm::dvec3(scene.lo), glm::dvec3(scene.hi)};
}

Case case_of(scenes::View const& view, ClipSpace clip) {
    Case made;
    made.about = view.name;
    made.clip = clip;
    made.picture = {960, 540};
    made.shadow_distance = view.shadow_distance;
    made.frame.camera = perspective_view(pose_looking(view.eye, view.forward, view.up), view.fov_y_radians,
                                         960.0 / 540.0, view.z_near, view.shadow_distance);
    made.frame.light = view.has_spot
                           ? spot(view.spot_position, view.spot_axis, view.spot_half_angle_radians, view.spot_range)
                           : directional(view.light_travel);
    return made;
}

// Rounded to float, as an engine has it.
void add(Frame& frame, ShadowMap<double> const& map, std::optional<SliceRange<double>> range) {
    if (!map.visible) return;
    frame.maps.push_back(
        {"map " + std::to_string(frame.maps.size()), 1, map_size, glm::dmat4(glm::mat4(map.clip_from_world)), range});
}

Frame with_cascades(Frame frame, backend::Scene const& scene, CascadeFit fit, double lambda, ClipSpace clip,
                    Cascades<double> const* previous, Cascades<double>& fitted) {
    CascadeOptions<double> options;
    options.map_size = map_size;
    options.fit = fit;
    options.lambda = lambda;
    options.clip = clip;
    frame.maps.clear();
    fitted = fit_cascades(frame.camera, frame.light, box_of(scene), box_of(scene), options, previous);
    for (auto const& cascade : fitted) add(frame, cascade.map, cascade.range);
    return frame;
}

int examined = 0;  // sets of maps with a picture to judge

void expect_well(Case const& read, backend::Scene const& scene, std::string const& technique) {
    if (read.frame.maps.empty()) return;
    Sight const sight = look(read, scene, 120);
    Diagnosis const diagnosis = diagnose(read, sight);
    if (diagnosis.maps[0].points + diagnosis.maps.back().points > 100) ++examined;
    EXPECT_EQ(diagnosis.faults(), 0) << scene.name << ", " << technique << '\n' << report(read, sight, diagnosis, {});
}

void examine_scene(scenes::NamedScene const& named) {
    backend::Scene const& scene = named.scene;
    int clips = 0;
    for (scenes::View const& view : named.views) {
        ClipSpace const clip = std::array{gl_clip, vulkan_clip, reversed(d3d_clip)}[std::size_t(clips++ % 3)];
        Case patient = case_of(view, clip);
        if (view.has_spot) {
            patient.choice = Selection::first;
            add(patient.frame,
                fit_spot(patient.frame.camera, patient.frame.light, box_of(scene), box_of(scene), map_size, 2.0, clip),
                std::nullopt);
            expect_well(patient, scene, "spot");
            continue;
        }
        patient.choice = Selection::by_depth;
        for (auto const fit :
             {CascadeFit::stable, CascadeFit::tight, CascadeFit::rectangle, CascadeFit::focus, CascadeFit::warped}) {
            Cascades<double> first, second;
            patient.frame = with_cascades(patient.frame, scene, fit, 0.65, clip, nullptr, first);
            patient.next.reset();
            if (fit == CascadeFit::stable) {
                Frame later = patient.frame;
                later.camera.pose = pose_looking(view.eye + glm::dvec3(0.37, 0.05, -0.21),
                                                 view.forward + glm::dvec3(0.03, 0.01, -0.02), view.up);
                patient.next = with_cascades(later, scene, fit, 0.65, clip, &first, second);
            }
            expect_well(patient, scene, view.name + ", fit " + std::to_string(int(fit)));
        }
        Case plane = case_of(view, clip);
        plane.choice = Selection::first;
        VdsmOptions<double> options;
        options.map_size = map_size;
        options.margin_texels = 2.0;
        add(plane.frame,
            view_dependent_map(plane.frame.camera, plane.frame.light, ShadowPlane<double>{{0.0, 1.0, 0.0}, 0.0},
                               box_of(scene), box_of(scene), options, clip),
            std::nullopt);
        Cascades<double> behind;
        Frame const fallback = with_cascades(plane.frame, scene, CascadeFit::tight, 0.65, clip, nullptr, behind);
        for (EngineMap map : fallback.maps) {
            map.range.reset();
            plane.frame.maps.push_back(map);
        }
        expect_well(plane, scene, view.name + ", view-dependent with cascades behind it");
    }
}

}  // namespace

class DoctorHealth : public ::testing::TestWithParam<std::string_view> {};

TEST_P(DoctorHealth, WhatThisLibraryFitsHasNoFault) {
    examined = 0;
    examine_scene(scenes::make_scene(GetParam(), scenes::SceneSize::small));
    EXPECT_GE(examined, 24) << "five views, five fits and more";
}

INSTANTIATE_TEST_SUITE_P(Scenes, DoctorHealth, ::testing::Values("town", "colonnade", "forest"),
                         [](auto const& scene) { return std::string(scene.param); });
