// SPDX-License-Identifier: MIT
//
// The irregular z-buffer: sample masks, pixels as pieces of a plane, and the whole way from casters to masks.
#include "tests/fuzz/inputs.hpp"
#include "tests/laws/mask.hpp"
#include "tests/laws/microquad.hpp"
#include "tests/laws/trace.hpp"

namespace shadowmath::fuzz {
namespace {

void try_masks(Case& c) {
    static HalfPlaneTable const table = half_plane_table();
    double const scale = c.magnitude<double>(-20, 20);
    double const offset = c.uniform<double>(-1.0, 1.0), x = c.uniform<double>(-1.0, 1.0);
    PixelLine<double> const line{offset * scale, x * scale, c.uniform<double>(-1.0, 1.0) * scale};
    PixelLine<double> const other{-line.c, -line.x, -line.y};
    std::uint32_t const exact = c.call([&] { return half_plane_mask<PlainLanes<double>>(line); });
    std::uint32_t const read = c.call([&] { return half_plane_mask(table, line); });
    c.require(laws::differ_only_near(line, read, exact, table_displacement), "table and exact differ near the line");
    c.require((exact | half_plane_mask<PlainLanes<double>>(other)) == every_sample, "two halves hold every sample");
    PixelLine<double> const any{c.number<double>(), c.number<double>(), c.number<double>()};
    (void)c.call([&] { return half_plane_mask<PlainLanes<double>>(any) ^ half_plane_mask(table, any); });
}

template <class T>
void try_quads(Case& c) {
    ViewVolume<T> const eye = good_view<T>(c);
    PixelFrame<T> const frame = c.call([&] { return pixel_frame(eye, 64, 36); });
    int const column = c.below(64), row = c.below(36);
    T const depth = c.number<T>();
    Vec3<T> const normal = any_vector<T>(c);
    MicroQuad<T> const quad = c.call([&] { return micro_quad(frame, column, row, depth, normal); });
    T const u = c.uniform<T>(T(0), T(1)), v = c.uniform<T>(T(0), T(1));
    c.require(overflow_unseen || !quad.ok || all_finite(&quad.q, 1), "a quad is finite");
    // A plane ten metres or so away, not seen edge on: there it is turned.
    Vec3<T> const facing = -eye.pose.forward + eye.pose.right * c.uniform<T>(T(-1), T(1));
    T const there = c.uniform<T>(T(1), T(10));
    if (eye.kind != ViewKind::perspective || std::abs(eye.right) + std::abs(eye.left) > T(2) || eye.top > T(2)) return;
    ViewVolume<T> const still = [&] {
        ViewVolume<T> moved = eye;
        moved.pose.position = Vec3<T>(T(0));
        return moved;
    }();
    PixelFrame<T> const centred = pixel_frame(still, 64, 36);
    T const px = T(column) + T(0.5) - T(32), py = T(row) + T(0.5) - T(18);
    Vec3<T> const ray = centred.inward + centred.across * px + centred.upward * py;
    if (!(std::abs(glm::dot(ray, facing)) > T(0.2) * glm::length(ray) * glm::length(facing))) return;
    MicroQuad<T> const good = micro_quad(centred, column, row, there, facing);
    c.require(good.ok, "a plane that faces the eye has a quad");
    c.require(laws::is_on_the_plane_and_in_the_pixel(centred, good, column, row, u, v, ray * there, facing, 256),
              "a quad lies on its plane and in its pixel");
}

template <class T>
void try_tracing(Case& c) {
    int const size = 1 + c.below(3);
    Vec3<T> const tilt = point_within<T>(c, T(0.3)), aside = point_within<T>(c, T(3)), aim = point_within<T>(c, T(2));
    Vec3<T> const normal = safe_normalize(Vec3<T>(T(0), T(1), T(0)) + tilt).direction;
    Vec3<T> const place(aside.x, T(4) + aside.y, aside.z), target(aim.x, T(0), aim.z);
    Pose<T> const pose = pose_looking(place, target - place, Vec3<T>(T(0.3), T(0), T(1)));
    ViewVolume<T> eye = perspective_view<T>(pose, c.uniform<T>(T(0.1), T(1.6)), T(1.5), T(0.05), T(200));
    if (c.one_in(4)) eye = orthographic_view<T>(pose, T(-3), T(2), T(-2), T(1.5), T(0.05), T(200));
    test::PlanePicture<T> picture = test::picture_of_plane(eye, size + 1, size, Vec3<T>(T(0)), normal);
    Vec3<T> const lean = point_within<T>(c, T(0.8));
    Light<T> light = directional(Vec3<T>(lean.x, T(-1), lean.z));
    ShadowMap<T> grid = test::sun_map(light, target, c.uniform<T>(T(1), T(12)));
    if (c.one_in(3)) {
        light = spot(Vec3<T>(lean.x, T(6), lean.z), Vec3<T>(T(0), T(-1), T(0)), T(1.4), T(100));
        Pose<T> const lamp = pose_looking(light.position, light.direction, Vec3<T>(T(0.1), T(0.2), T(1)));
        grid.clip_from_world = clip_from_world(perspective_view<T>(lamp, T(2.9), T(1), T(0.05), T(200)), grid.clip);
    }
    int const map_size = 1 + c.below(20);
    std::vector<test::Triangle<T>> casters(static_cast<std::size_t>(1 + c.below(3)));
    for (test::Triangle<T>& triangle : casters) {
        T const extent = c.magnitude<T>(-6, 3);
        Vec3<T> const middle = point_within<T>(c, T(3));
        for (Vec3<T>& p : triangle)
            p = Vec3<T>(middle.x, std::abs(middle.y) * T(1.5), middle.z) + point_within<T>(c, T(1)) * extent;
    }
    using Plain = PlainLanes<T>;
    test::Traced const whole = test::traced<Plain>(picture, casters, light, grid, map_size);
    c.hash(whole.masks.data(), static_cast<int>(whole.masks.size()));
    c.require(!whole.faults.any(), "a good scene is traced without fault");
    c.require(laws::agrees_with_segments(picture, whole.masks, casters, light, grid), "masks agree with segments");
    if (c.one_in(2)) {
        std::vector<test::Triangle<T>> const one(casters.begin(), casters.begin() + 1);
        c.require(laws::only_adds(test::traced<Plain>(picture, one, light, grid, map_size).masks, whole.masks),
                  "casters only add to a mask");
        return;
    }
    if (c.one_in(2)) picture.depth[0] = c.number<T>();
    if (c.one_in(2)) picture.normals[1] = c.number<T>();
    if (c.one_in(2)) casters[0][1] = any_vector<T>(c);
    if (c.one_in(2)) grid.clip_from_world[c.below(4)][c.below(4)] = c.number<T>();
    if (c.one_in(2)) light.direction = any_vector<T>(c);
    test::Traced const odd = test::traced<Plain>(picture, casters, light, grid, map_size);
    c.require(picture.depth[0] > T(0) || eye.kind == ViewKind::orthographic || odd.masks[0] == 0u,
              "what is not seen is not shadowed");
    for (std::uint32_t const mask : odd.masks) c.require(mask != 0xdeadbeefu, "every mask is written");
}

template <class T>
void try_exact(Case& c) {
    switch (c.below(4)) {
        case 0:
        case 1: return try_masks(c);
        case 2: return try_quads<T>(c);
        default: return try_tracing<T>(c);
    }
}

[[maybe_unused]] bool const exact_target =
    add_target("exact", [](Case& c) { c.one_in(2) ? try_exact<float>(c) : try_exact<double>(c); });

}  // namespace
}  // namespace shadowmath::fuzz
