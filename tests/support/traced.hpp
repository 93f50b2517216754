// SPDX-License-Identifier: MIT
//
// A picture of one plane, and the masks that casters leave on it: the whole way through the irregular z-buffer.
#pragma once

#include <shadowmath/irregular.hpp>
#include <shadowmath/light_box.hpp>

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace shadowmath::test {

template <class T>
using Triangle = std::array<Vec3<T>, 3>;

template <class T>
struct PlanePicture {
    PixelFrame<T> frame;
    Vec3<T> point, normal;
    std::vector<T> depth, normals;  // 0 where the plane is not seen
};

// Row 0 is the bottom one.
template <class T>
PlanePicture<T> picture_of_plane(ViewVolume<T> const& eye, int width, int height, Vec3<T> const& point,
                                 Vec3<T> const& normal) {
    PlanePicture<T> picture;
    picture.frame = pixel_frame(eye, width, height);
    picture.point = point;
    picture.normal = normal;
    PixelFrame<T> const& f = picture.frame;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            T const px = T(x) + T(0.5) - T(width) / T(2), py = T(y) + T(0.5) - T(height) / T(2);
            bool const flat = f.kind == ViewKind::orthographic;
            Vec3<T> const aside = f.across * (px + f.origin.x) + f.upward * (py + f.origin.y);
            Vec3<T> const from = flat ? f.eye + aside : f.eye, along = flat ? f.inward : f.inward + aside;
            T const slope = glm::dot(normal, along), depth = glm::dot(normal, point - from) / slope;
            bool const seen = std::abs(slope) > T(1e-3) && depth > T(0.01) && depth < T(1e4);
            picture.depth.push_back(seen ? depth : T(0));
            for (int i = 0; i < 3; ++i) picture.normals.push_back(seen ? normal[i] : T(0));
        }
    return picture;
}

struct Traced {
    std::vector<std::uint32_t> masks;
    ListCounts counts;
    Faults faults;
};

template <class Lanes, class T = typename Lanes::Scalar>
Traced traced(PlanePicture<T> const& picture, std::vector<Triangle<T>> const& casters, Light<T> const& light,
              ShadowMap<T> const& grid, int map_size, PixelRect rect = {}) {
    int const width = rect.width > 0 ? rect.width : picture.frame.width - rect.x;
    int const height = rect.height > 0 ? rect.height : picture.frame.height - rect.y;
    StorageSize const need = storage_for(width, height, map_size, 4 * width * height);
    // Whatever lay there before: storage need not be cleared.
    std::unique_ptr<T[]> const scalars(new T[need.scalars]);
    std::unique_ptr<std::uint32_t[]> const words(new std::uint32_t[need.words]);
    Receivers<T> receivers;
    receivers.depth = picture.depth.data();
    receivers.normal = picture.normals.data();
    IrregularBuffer<T> buffer = list_receivers<T, Lanes>(picture.frame, receivers, light, grid, map_size,
                                                         {scalars.get(), words.get(), need}, rect);
    Casters<T> list;
    list.position = casters.empty() ? nullptr : &casters[0][0].x;
    list.stride = static_cast<int>(sizeof(Vec3<T>) / sizeof(T));  // GLM's aligned vectors have a gap behind each
    list.vertex_count = static_cast<std::uint32_t>(3 * casters.size());
    list.triangle_count = static_cast<std::uint32_t>(casters.size());
    trace<T, Lanes>(buffer, list);
    Traced result;
    result.masks.assign(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0xdeadbeefu);
    write_masks(buffer, result.masks.data());
    result.counts = buffer.counts;
    result.faults = buffer.faults;
    return result;
}

// A uniform map of the sun that holds the cube of this half width about a place.
template <class T>
ShadowMap<T> sun_map(Light<T> const& sun, Vec3<T> const& centre, T half) {
    LightBox<T> box;
    box.basis = light_basis(sun.direction);
    Vec3<T> const c = in_light(box.basis, centre);
    box.lo = Vec2<T>(c.x - half, c.y - half);
    box.hi = Vec2<T>(c.x + half, c.y + half);
    box.depth_lo = c.z - half;
    box.depth_hi = c.z + half;
    ShadowMap<T> map;
    map.clip = gl_zero_to_one_clip;
    map.clip_from_world = clip_from_world(box, map.clip);
    map.visible = true;
    return map;
}

}  // namespace shadowmath::test
