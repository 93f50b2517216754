// SPDX-License-Identifier: MIT
#include "backends/null/null_backend.hpp"

#include "backends/pass_check.hpp"
#include "backends/view_plan.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace shadowmath::backend {
namespace {

std::uint8_t srgb_from_linear(float linear) {
    float const x = std::clamp(linear, 0.0f, 1.0f);
    float const encoded = x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1.0f / 2.4f) - 0.055f;
    return static_cast<std::uint8_t>(std::lround(255.0f * encoded));
}

DrawDepthCall record(DepthPass const& pass) {
    DrawDepthCall call{pass.map_size, pass.depth_clamp, {}, pass.way};
    for (DepthLayer const& layer : pass.layers)
        call.layers.push_back({layer.clip_from_world, {layer.objects.begin(), layer.objects.end()}});
    return call;
}

}  // namespace

bool NullBackend::accept(std::string const& fault) {
    if (!fault.empty()) messages_.push_back(fault);
    return fault.empty();
}

void NullBackend::upload(Scene const& scene) {
    calls_.emplace_back(UploadCall{scene.name, scene.objects.size()});
    objects_ = accept(fault_of(scene)) ? scene.objects : std::vector<Object>{};
}

DrawWork NullBackend::draw_depth(DepthPass const& pass) {
    calls_.emplace_back(record(pass));
    bool const accepted =
        accept(fault_of(pass, objects_.size())) && accept(fault_of_fitted(pass.fitted, there_is_a_fit_));
    map_size_ = accepted ? pass.map_size : 0;
    layers_ = accepted ? static_cast<int>(pass.layers.size()) : 0;
    return accepted ? work_of(pass.way, plan_draws(pass, objects_)) : DrawWork{};
}

DrawWork NullBackend::draw_scene(ScenePass const& pass) {
    calls_.emplace_back(DrawSceneCall{pass});
    bool const accepted = accept(fault_of(pass, layers_)) && accept(fault_of_fitted(pass.fitted, there_is_a_fit_));
    extent_ = accepted ? pass.extent : Extent{};
    sky_ = pass.frame.sky;
    return accepted ? work_of(plan_view(pass, objects_)) : DrawWork{};
}

DrawWork NullBackend::draw_split_by_split(DepthPass const& maps, ScenePass const& view) {
    calls_.emplace_back(DrawSplitBySplitCall{record(maps), view});
    bool const accepted = accept(fault_of(maps, view, objects_.size()));
    map_size_ = accepted ? maps.map_size : 0;
    layers_ = accepted ? 1 : 0;
    extent_ = accepted ? view.extent : Extent{};
    sky_ = view.frame.sky;
    return accepted ? work_of(plan_split_by_split(maps, view, objects_)) : DrawWork{};
}

DrawWork NullBackend::fit_maps(FitPass const& pass) {
    calls_.emplace_back(FitMapsCall{pass.extent, pass.steps.size()});
    bool const accepted = accept(fault_of(pass));
    fit_extent_ = accepted ? pass.extent : Extent{};
    there_is_a_fit_ = accepted && !pass.steps.empty();
    ViewDraw eye;
    for (Object const& object : objects_) append(eye.draws, object);
    return accepted ? work_of(std::span(&eye, 1)) : DrawWork{};
}

Image<float> NullBackend::read_eye_depth() {
    calls_.emplace_back(ReadEyeDepthCall{});
    return Image<float>(fit_extent_, 0.0f);
}

std::vector<MapConstants> NullBackend::read_fit() {
    calls_.emplace_back(ReadFitCall{});
    accept(fault_of_fitted(true, there_is_a_fit_));
    return std::vector<MapConstants>(max_maps);
}

Image<float> NullBackend::read_depth(int layer) {
    calls_.emplace_back(ReadDepthCall{layer});
    bool const drawn = layer >= 0 && layer < layers_;
    accept(drawn ? "" : "read_depth: layer " + std::to_string(layer) + " of " + std::to_string(layers_));
    return Image<float>(Extent{map_size_, map_size_}, 1.0f);
}

Frame NullBackend::read_frame() {
    calls_.emplace_back(ReadFrameCall{});
    Rgba8 const sky{srgb_from_linear(sky_.r), srgb_from_linear(sky_.g), srgb_from_linear(sky_.b), 255};
    return {Image<Rgba8>(extent_, sky), Image<Texel4>(extent_, {0.0f, 0.0f, 0.0f, -2.0f}),
            Image<Texel4>(extent_, {0.0f, 0.0f, 0.0f, 1.0f})};
}

std::vector<std::string> NullBackend::take_messages() {
    return std::exchange(messages_, {});
}

}  // namespace shadowmath::backend
