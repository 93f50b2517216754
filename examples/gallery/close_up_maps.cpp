// SPDX-License-Identifier: MIT
#include "examples/gallery/close_up_maps.hpp"

#include <shadowmath/bias.hpp>
#include <shadowmath/filter.hpp>
#include <shadowmath/hfts.hpp>

#include <cmath>

namespace shadowmath::gallery {
namespace {

constexpr int map_size = 1024;
constexpr int map_count = 4;
constexpr int filter_radius = 1;

// One map as the filters want it.
struct Lookup {
    ShadowMap<float> map;
    MapBias<float> bias;
    MapPenumbra<float> penumbra;
    backend::Image<float> const* depth;

    // The map holds the point, filter margin included.
    [[nodiscard]] bool holds(glm::vec3 const& point) const {
        Projected<float> const at = projected(texture_from_world(map), point, map.w_min);
        float const margin = float(filter_radius + 1) / float(map_size);
        auto const inside = [&](float x) { return x >= margin && x <= 1.0f - margin; };
        return at.in_front && inside(at.at.x) && inside(at.at.y) && at.at.z >= 0.0f && at.at.z <= 1.0f;
    }
    [[nodiscard]] auto reader() const {
        return [this](int x, int y) { return depth->at(x, y); };
    }
};

std::vector<Lookup> lookups(CloseUpPicture const& picture, CloseUpMaps const& maps, double sun_radius) {
    std::vector<Lookup> made;
    Light<float> const light = directional(glm::vec3(picture.light.direction));
    BiasOptions<float> options;
    options.filter_radius = filter_radius;
    for (std::size_t i = 0; i < maps.depth.size(); ++i) {
        ShadowMap<double> const& fitted = maps.cascades.at[i].map;
        Lookup lookup;
        lookup.map.clip_from_world = glm::mat4(fitted.clip_from_world);
        lookup.map.clip = fitted.clip;
        lookup.map.w_min = float(fitted.w_min);
        lookup.map.visible = fitted.visible;
        lookup.bias = bias_for(lookup.map, light, map_size, options);
        lookup.penumbra = penumbra_for(lookup.map, light, float(sun_radius));
        lookup.depth = &maps.depth[i];
        made.push_back(lookup);
    }
    return made;
}

// Calls answer(pixel, lookup) for every pixel that some map holds.
template <class Answer>
void over_held(CloseUpPicture const& picture, std::vector<Lookup> const& maps, Answer const& answer) {
    for (std::size_t i = 0; i < picture.size(); ++i) {
        if (!picture.shows(i) || !picture.faces_light(i)) continue;
        for (Lookup const& map : maps)
            if (map.holds(picture.point[i])) {
                answer(i, map);
                break;
            }
    }
}

// An angle for each pixel that its neighbours do not have: bands become fine noise. Source: Jimenez, SIGGRAPH 2014.
Vec2<float> turn_of(std::size_t pixel, int width) {
    float const x = float(pixel % std::size_t(width)), y = float(pixel / std::size_t(width));
    float const share = 52.9829189f * std::fmod(0.06711056f * x + 0.00583715f * y, 1.0f);
    float const angle = 6.2831853f * (share - std::floor(share));
    return {std::cos(angle), std::sin(angle)};
}

}  // namespace

CloseUpMaps close_up_maps(backend::Backend& backend, CloseUpPicture const& picture, backend::Scene const& scene) {
    CloseUpMaps maps;
    maps.map_size = map_size;
    Aabb<double> const box{glm::dvec3(scene.lo), glm::dvec3(scene.hi)};
    CascadeOptions<double> options;
    options.count = map_count;
    options.map_size = map_size;
    options.lambda = 0.65;
    options.filter_radius = filter_radius;
    options.clip = gl_zero_to_one_clip;
    maps.cascades = fit_cascades(picture.view, picture.light, box, box, options);
    std::vector<std::uint32_t> casters;
    for (std::uint32_t i = 0; i < scene.objects.size(); ++i)
        if (scene.objects[i].casts) casters.push_back(i);
    std::vector<backend::DepthLayer> layers;
    for (Cascade<double> const& cascade : maps.cascades)
        layers.push_back({glm::mat4(cascade.map.clip_from_world), casters});
    backend::DepthPass pass;
    pass.map_size = map_size;
    pass.layers = layers;
    maps.ms_draw = backend.draw_depth(pass).milliseconds;
    for (int i = 0; i < maps.cascades.count; ++i) maps.depth.push_back(backend.read_depth(i));
    return maps;
}

std::vector<float> pcf(CloseUpPicture const& picture, CloseUpMaps const& maps) {
    std::vector<float> lit(picture.size(), 1.0f);
    over_held(picture, lookups(picture, maps, 0.0), [&](std::size_t i, Lookup const& at) {
        lit[i] = visibility(at.map, map_size, picture.point[i], picture.normal[i], at.bias, {filter_radius, true},
                            at.reader());
    });
    return lit;
}

std::vector<SoftShadow<float>> pcss(CloseUpPicture const& picture, CloseUpMaps const& maps, double sun_radius) {
    std::vector<SoftShadow<float>> soft(picture.size());
    over_held(picture, lookups(picture, maps, sun_radius), [&](std::size_t i, Lookup const& at) {
        PcssOptions<float> options;
        options.turn = turn_of(i, picture.extent.width);
        soft[i] = soft_visibility(at.map, map_size, picture.point[i], picture.normal[i], at.bias, at.penumbra, options,
                                  at.reader());
    });
    return soft;
}

std::vector<float> hfts(std::vector<float> const& lit, std::vector<SoftShadow<float>> const& soft, float soft_gap) {
    std::vector<float> visibility(lit.size());
    for (std::size_t i = 0; i < lit.size(); ++i)
        visibility[i] = hybrid_visibility(ExactShadow<float>{lit[i], soft[i].gap}, soft[i], soft_gap);
    return visibility;
}

}  // namespace shadowmath::gallery
