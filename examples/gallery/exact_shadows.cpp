// SPDX-License-Identifier: MIT
#include "examples/gallery/exact_shadows.hpp"

#include <shadowmath/irregular.hpp>
#include <shadowmath/shadowmath.hpp>

#include <algorithm>
#include <bit>
#include <chrono>

namespace shadowmath::gallery {
namespace {

double now_ms() {
    using namespace std::chrono;
    return duration<double, std::milli>(steady_clock::now().time_since_epoch()).count();
}

ShadowMap<float> in_float(ShadowMap<double> const& map) {
    ShadowMap<float> same;
    same.clip_from_world = glm::mat4(map.clip_from_world);
    same.clip = map.clip;
    same.w_min = float(map.w_min);
    same.visible = map.visible;
    return same;
}

// The median height of what is seen: where the plane of a view-dependent map serves most pixels.
double median_height(CloseUpPicture const& picture) {
    std::vector<float> heights;
    for (std::size_t i = 0; i < picture.size(); ++i)
        if (picture.shows(i)) heights.push_back(picture.point[i].y);
    if (heights.empty()) return 0.0;
    auto const middle = heights.begin() + static_cast<std::ptrdiff_t>(heights.size() / 2);
    std::ranges::nth_element(heights, middle);
    return double(*middle);
}

std::vector<std::uint32_t> caster_indices(backend::Scene const& scene) {
    std::vector<std::uint32_t> indices;
    for (backend::Object const& object : scene.objects) {
        if (!object.casts) continue;
        auto const first = scene.indices.begin() + static_cast<std::ptrdiff_t>(object.first_index);
        indices.insert(indices.end(), first, first + static_cast<std::ptrdiff_t>(object.index_count));
    }
    return indices;
}

}  // namespace

std::vector<Grid> grids_for(CloseUpPicture const& picture, backend::Scene const& scene) {
    Aabb<double> const box{glm::dvec3(scene.lo), glm::dvec3(scene.hi)};
    ClipSpace const clip = gl_zero_to_one_clip;
    float const end = float(picture.view.z_far);
    std::vector<Grid> grids;
    auto const fitted = [&](char const* name, char const* title, CascadeFit cascade_fit, int count) {
        CascadeOptions<double> options;
        options.count = count;
        options.map_size = grid_size;
        options.fit = cascade_fit;
        options.lambda = 0.65;
        options.clip = clip;
        Grid grid{name, title, {}, {}};
        for (Cascade<double> const& cascade : fit_cascades(picture.view, picture.light, box, box, options)) {
            grid.maps.push_back(in_float(cascade.map));
            grid.ends.push_back(float(cascade.range.end));
        }
        grids.push_back(std::move(grid));
    };
    fitted("uniform", "One uniform map", CascadeFit::tight, 1);
    fitted("cascades", "Four stable cascades", CascadeFit::stable, 4);
    fitted("warp", "Simple perspective map", CascadeFit::warped, 1);
    VdsmOptions<double> options;
    options.map_size = grid_size;
    ShadowPlane<double> const ground{glm::dvec3(0.0, 1.0, 0.0), -median_height(picture)};
    ShadowMap<double> map = view_dependent_map(picture.view, picture.light, ground, box, box, options, clip);
    map.w_min = 0.0;  // a grid lists what its frame does not hold as well
    grids.push_back({"vdsm", "View-dependent map", {in_float(map)}, {end}});
    return grids;
}

ExactShadows exact_shadows(CloseUpPicture const& picture, backend::Scene const& scene, Grid const& grid) {
    ExactShadows shadows;
    int const width = picture.extent.width, height = picture.extent.height;
    std::vector<std::uint32_t> const indices = caster_indices(scene);
    Casters<float> casters;
    casters.position = &scene.vertices.front().position.x;
    casters.stride = int(sizeof(backend::Vertex) / sizeof(float));
    casters.vertex_count = std::uint32_t(scene.vertices.size());
    casters.index = indices.data();
    casters.triangle_count = std::uint32_t(indices.size() / 3);
    Light<float> const light = directional(glm::vec3(picture.light.direction));
    StorageSize const need = storage_for(width, height, grid_size);
    std::vector<float> scalars(need.scalars);
    std::vector<std::uint32_t> words(need.words), masks(picture.size());
    shadows.dark.assign(picture.size(), 0);
    std::uint64_t nodes = 0, lists = 0;
    for (std::size_t m = 0; m < grid.maps.size(); ++m) {
        std::vector<glm::vec3> mine = picture.normal;
        float const begin = m == 0 ? 0.0f : grid.ends[m - 1];
        float const end = m + 1 == grid.maps.size() ? std::numeric_limits<float>::max() : grid.ends[m];
        for (std::size_t i = 0; i < mine.size(); ++i)
            if (picture.depth[i] < begin || picture.depth[i] >= end) mine[i] = glm::vec3(0.0f);
        Receivers<float> receivers;
        receivers.depth = picture.depth.data();
        receivers.normal = &mine.front().x;
        double const start = now_ms();
        IrregularBuffer<float> buffer = list_receivers(picture.frame, receivers, light, grid.maps[m], grid_size,
                                                       Storage<float>{scalars.data(), words.data(), need});
        double const listed = now_ms();
        trace(buffer, casters);
        write_masks(buffer, masks.data());
        shadows.ms_list += listed - start;
        shadows.ms_trace += now_ms() - listed;
        if (buffer.faults.any()) shadows.note = describe(buffer.faults);
        for (std::size_t i = 0; i < masks.size(); ++i) shadows.dark[i] |= masks[i];
        nodes += buffer.counts.nodes;
        lists += buffer.counts.lists;
        shadows.longest_list = std::max(shadows.longest_list, buffer.counts.longest);
        shadows.contact_reach = double(buffer.contact_reach);
        shadows.contact_ray = double(buffer.contact_ray);
    }
    shadows.mean_list = double(nodes) / double(std::max<std::uint64_t>(lists, 1));
    shadows.nodes_per_pixel = double(nodes) / double(picture.size());
    shadows.bytes_per_pixel = 4.0 * double(need.scalars + need.words) / double(picture.size());
    return shadows;
}

std::vector<float> lit_shares(std::vector<std::uint32_t> const& dark) {
    std::vector<float> shares;
    for (std::uint32_t const mask : dark) shares.push_back(1.0f - float(std::popcount(mask)) / 32.0f);
    return shares;
}

}  // namespace shadowmath::gallery
