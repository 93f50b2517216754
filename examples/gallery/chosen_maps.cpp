// SPDX-License-Identifier: MIT
#include "examples/gallery/technique_fits.hpp"
#include "examples/gallery/tile_depths.hpp"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <vector>

namespace shadowmath::gallery {
namespace {

MapLimits<double> limits_of(Input const& in) {
    MapLimits<double> limits;
    limits.eye_pixels = {in.extent.width, in.extent.height};
    limits.map_size = in.map_size;
    limits.margin_texels = margin_texels;
    limits.clip = drawn_clip;
    return limits;
}

void take(MapSet& set, Input const& in, ChosenMaps<double> const& chosen) {
    note(set, chosen.faults);
    for (ChosenMap<double> const& made : chosen) {
        add(set, in, made.map, whole(in));
        char text[96];
        std::snprintf(text, sizeof text, "%s%.0f samples at %.2f px a texel", set.note.empty() ? "" : "; ",
                      double(made.samples), made.mean);
        set.note += text;
    }
}

}  // namespace

void maps_for_boxes(MapSet& set, Input const& in) {
    std::vector<Aabb<double>> receivers;
    for (backend::Object const& object : in.scene.objects)
        if (object.receives) receivers.push_back(box_of(object));
    auto const work = std::make_unique<MapSearch<double>>();
    take(set, in,
         choose_maps(in.seen, in.light, in.casters, receivers.data(), int(receivers.size()), limits_of(in), *work));
}

void maps_for_depths(MapSet& set, Input const& in) {
    backend::Extent const pixels = in.eye_depth.extent, tiles{std::min(120, pixels.width), std::min(68, pixels.height)};
    DepthCode<float> const code = depth_code(sampling_eye(in.view, in.extent), sampling_clip);
    TileDepths depths(tiles, pixels);
    for (int y = 0; y < pixels.height; ++y)
        for (int x = 0; x < pixels.width; ++x) {
            double const depth = double(decoded_depth(code, in.eye_depth.at(x, y)));
            if (depth > 0.0 && depth <= in.seen.z_far) depths.add(x, y, depth);
        }
    auto const work = std::make_unique<MapSearch<double>>();
    take(set, in, choose_maps<double>(in.seen, in.light, in.casters, nullptr, 0, depths.tiles(), limits_of(in), *work));
}

}  // namespace shadowmath::gallery
