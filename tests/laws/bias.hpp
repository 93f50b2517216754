// SPDX-License-Identifier: MIT
#pragma once

#include "tangent.hpp"

#include <shadowmath/bias.hpp>

#include <glm/matrix.hpp>

#include <cmath>

namespace shadowmath::laws {

template <class T>
[[nodiscard]] Vec3<long double> texture_place(ShadowMap<T> const& map, Vec3<long double> const& point) {
    Mat4<long double> const texture = texture_from_clip<long double>(map.clip) * Mat4<long double>(map.clip_from_world);
    return place(texture, point);
}

// A plane in the world, and what a rasteriser leaves of it in a map: the depth where the light ray through a texel's
// centre meets it. Exact to long double; nothing of the library's slopes enters.
template <class T>
class RasterisedPlane {
public:
    RasterisedPlane(ShadowMap<T> const& map, int map_size, Vec3<T> const& point, Vec3<T> const& normal)
        : map_(map), map_size_(map_size), point_(point), normal_(normal),
          world_from_texture_(
              glm::inverse(texture_from_clip<long double>(map.clip) * Mat4<long double>(map.clip_from_world))) {}

    [[nodiscard]] long double depth_at(long double texel_x, long double texel_y) const {
        Vec3<long double> const a = world_at(texel_x, texel_y, 0.25L), b = world_at(texel_x, texel_y, 0.75L);
        long double const share = glm::dot(normal_, point_ - a) / glm::dot(normal_, b - a);
        return texture_place(map_, a + (b - a) * share).z;
    }

    [[nodiscard]] long double operator()(int x, int y) const {
        long double const depth = depth_at(static_cast<long double>(x) + 0.5L, static_cast<long double>(y) + 0.5L);
        return depth > 0 ? (depth < 1 ? depth : 1) : 0;  // as depth clamp stores it
    }

private:
    [[nodiscard]] Vec3<long double> world_at(long double x, long double y, long double depth) const {
        Vec4<long double> const world =
            world_from_texture_ * Vec4<long double>(x / map_size_, y / map_size_, depth, 1.0L);
        return Vec3<long double>(world) / world.w;
    }

    ShadowMap<T> map_;
    long double map_size_;
    Vec3<long double> point_, normal_;
    Mat4<long double> world_from_texture_;
};

// By how much stored depth really changes, in favour of light, when the point is pulled toward the light.
template <class T>
[[nodiscard]] long double measured_shift(ShadowMap<T> const& map, Light<T> const& light, Vec3<T> const& point,
                                         long double metres) {
    Vec3<long double> const p(point);
    Vec3<long double> const way = light.kind == LightKind::directional ? -Vec3<long double>(light.direction)
                                                                       : Vec3<long double>(light.position) - p;
    long double const moved = texture_place(map, p + glm::normalize(way) * metres).z - texture_place(map, p).z;
    return map.clip.depth == DepthOrder::one_to_zero ? moved : -moved;
}

template <class T>
[[nodiscard]] bool is_harmless(MapBias<T> const& bias) {
    return all_finite(&bias.constant, 1) && all_finite(&bias.per_inverse_w, 1) && all_finite(&bias.slope_texels, 1) &&
           all_finite(&bias.slope_limit, 1) && bias.slope_texels >= T(0) && bias.slope_limit > T(0);
}

template <class T>
[[nodiscard]] bool is_within(DepthSlope<T> const& slope, T limit) {
    return std::abs(slope.x) <= limit && std::abs(slope.y) <= limit;
}

}  // namespace shadowmath::laws
