// SPDX-License-Identifier: MIT
//
// A picture of pieces of surface for TileKernel, and what each of its pixels comes to, one at a time in long double.
#pragma once

#include <shadowmath/irregular/tile.hpp>
#include <shadowmath/light.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace shadowmath::test {

inline constexpr int picture_width = 23, picture_height = 15;

// What receivers are given as.
struct TileForm {
    bool flat, lamp, placed;
    int normal_stride, position_stride;
};
inline constexpr TileForm tile_forms[] = {
    {false, false, false, 3, 3}, {false, false, true, 3, 3}, {false, true, false, 5, 3}, {false, true, true, 3, 4},
    {true, false, false, 3, 3},  {true, false, true, 4, 6},  {true, true, false, 3, 3},  {true, true, true, 3, 3}};

template <class Lanes>
struct TilePicture : ::testing::Test {
    using Real = long double;
    using Number = typename Lanes::Scalar;
    using Kernel = detail::TileKernel<Lanes>;

    std::mt19937 bits{20021201};
    IrregularBuffer<Number> buffer;
    PixelFrame<Real> frame;
    Light<Real> light;
    Receivers<Number> receivers;
    std::vector<Number> depth, position, normal;
    std::vector<Number> scalars;
    std::vector<std::uint32_t> words;
    detail::Parts<Number> parts;
    Number w_min = Number(0.02);

    double in(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(bits); }
    Vec3<Number> vector() { return {Number(in(-1, 1)), Number(in(-1, 1)), Number(in(-1, 1))}; }

    // A picture of pieces of surface that lie anywhere, seen from the left of the middle; its part is no whole tiles.
    void take(TileForm const& form) {
        auto const pose = pose_looking(Vec3<Number>(1, 4, 5), Vec3<Number>(Number(0.1), Number(-0.8), Number(-1)),
                                       Vec3<Number>(0, 1, 0));
        ViewVolume<Number> eye =
            form.flat ? orthographic_view<Number>(pose, -6, 9, -5, 5, Number(0.1), 100)
                      : perspective_view<Number>(pose, Number(0.9), Number(1.5), Number(0.1), Number(100));
        eye.left *= Number(1.25);
        buffer = {};
        buffer.frame = pixel_frame(eye, picture_width, picture_height);
        frame = frame_in<Real>(buffer.frame);
        auto const from = form.lamp ? spot(Vec3<Number>(2, 9, 1), Vec3<Number>(0, -1, 0), Number(0.7), Number(50))
                                    : directional(Vec3<Number>(Number(0.3), Number(-1), Number(0.2)));
        light.kind = from.kind;
        light.direction = Vec3<Real>(from.direction);
        light.position = Vec3<Real>(from.position);
        buffer.light = pixel_light(buffer.frame, from);
        buffer.rect = {2, 1, 18, 13};
        buffer.map_size = 32;
        buffer.tiles_across = 5;
        buffer.tile_count = 20;
        buffer.level_count = 4;
        // Of a sun all are at w = 1; of a lamp w falls to 0 where the light stands.
        buffer.row[0] = Vec4<Number>(Number(0.9), Number(0.2), Number(-0.1), Number(16));
        buffer.row[1] = Vec4<Number>(Number(-0.2), Number(0.3), Number(0.8), Number(12));
        buffer.row[2] = Vec4<Number>(Number(0.02), Number(0.03), Number(-0.04), Number(0.5));
        buffer.row[3] =
            form.lamp ? Vec4<Number>(Number(0.02), Number(-0.1), Number(0.01), Number(0.1)) : Vec4<Number>(0, 0, 0, 1);
        // Before a flat eye some have a w beyond 1.
        if (form.lamp && form.flat)
            for (auto& row : buffer.row) row *= Number(40);
        buffer.texel_error = Number(0.02);
        buffer.texel_error_here = Number(0.3);
        buffer.depth_error = Number(0.0015);
        buffer.depth_error_here = Number(0.04);
        buffer.contact_reach = Number(5);
        buffer.contact_ray = Number(3);
        StorageSize const size = storage_for(picture_width, picture_height, 32, 500);
        scalars.assign(size.scalars, Number(-77));
        words.assign(size.words, 0xabadcafeu);
        parts = detail::lay_out(buffer, {scalars.data(), words.data(), size});
        buffer.least_x = buffer.least_y = std::numeric_limits<Number>::max();
        buffer.most_x = buffer.most_y = buffer.most_depth = std::numeric_limits<Number>::lowest();

        auto const pixels = std::size_t(picture_width * picture_height);
        depth.assign(pixels, 0);
        position.assign(pixels * std::size_t(form.position_stride), Number(-77));
        normal.assign(pixels * std::size_t(form.normal_stride), Number(-77));
        for (std::size_t i = 0; i < pixels; ++i) {
            int const column = int(i) % picture_width, row = int(i) / picture_width;
            Number const no_number = std::numeric_limits<Number>::quiet_NaN();
            // Tiles of one depth, and others that are not; sky and what is no number among both.
            depth[i] = Number(column / 4 % 2 == 0 ? 6 + 0.1 * row : in(3, 9));
            Vec3<Number> n = in(0, 1) < 0.8 ? Vec3<Number>(0, 1, 0) + vector() * Number(0.4) : vector();
            int const odd = int(in(0, 60));
            if (odd == 0) n = Vec3<Number>(0);
            if (odd == 1) depth[i] = form.flat ? no_number : Number(0);
            if (odd == 2) depth[i] = no_number;
            if (odd == 3) n.y = no_number;
            if (odd == 4 && !form.flat) depth[i] = -depth[i];
            for (int axis = 0; axis < 3; ++axis)
                normal[i * std::size_t(form.normal_stride) + std::size_t(axis)] = n[axis];
            PixelFrame<Number> const& f = buffer.frame;
            Number const x = Number(column) + Number(0.5) - Number(picture_width) / 2,
                         y = Number(row) + Number(0.5) - Number(picture_height) / 2;
            Vec3<Number> const p =
                f.eye + (form.flat ? f.across * (x + f.origin.x) + f.upward * (y + f.origin.y) + f.inward * depth[i]
                                   : (f.across * x + f.upward * y + f.inward) * depth[i]);
            for (int axis = 0; axis < 3; ++axis)
                position[i * std::size_t(form.position_stride) + std::size_t(axis)] = p[axis];
        }
        receivers = {};
        receivers.normal = normal.data();
        receivers.normal_stride = form.normal_stride;
        receivers.depth = form.placed ? nullptr : depth.data();
        receivers.position = form.placed ? position.data() : nullptr;
        receivers.position_stride = form.position_stride;
    }
    [[nodiscard]] PixelPlane<Number> plane(int i) const {
        PixelFrame<Number> const& f = buffer.frame;
        Vec3<Number> const axis(buffer.row[i]);
        Number const offset =
            buffer.row[i].w + glm::dot(axis, f.across) * f.origin.x + glm::dot(axis, f.upward) * f.origin.y;
        return pixel_plane(f.kind, detail::normal_in_pixels(f, axis), offset);
    }
    [[nodiscard]] Kernel kernel() {
        bool const flat = frame.kind == ViewKind::orthographic;
        return {buffer,
                receivers,
                {plane(0), plane(1), plane(2), plane(3)},
                w_min,
                detail::turn_limit(buffer.frame),
                Lanes::load(detail::tile_columns<Number>),
                Lanes::load(detail::tile_rows<Number>),
                flat,
                buffer.row[3] == Vec4<Number>(0, 0, 0, 1)};
    }

    struct Pixel {
        bool sound = false, lit = false, alive = false;
        Real least_side = 1;  // how near it is to facing neither the light nor the eye
        MicroQuad<Real> quad;
        Real keys[5];  // lo x, hi x, lo y, hi y, depth; with their margins
        Real lo_w = 1e30L, hi_w = -1e30L, least_w_over = 1;
    };
    [[nodiscard]] Pixel slow(int column, int row) const {
        Pixel pixel;
        PixelRect const& rect = buffer.rect;
        if (column >= rect.x + rect.width || row >= rect.y + rect.height) return pixel;
        auto const i = std::size_t(row * picture_width + column);
        bool const flat = frame.kind == ViewKind::orthographic;
        Vec3<Real> n, p;
        for (int axis = 0; axis < 3; ++axis) {
            n[axis] = Real(normal[i * std::size_t(receivers.normal_stride) + std::size_t(axis)]);
            p[axis] = Real(position[i * std::size_t(receivers.position_stride) + std::size_t(axis)]);
        }
        Real const away = receivers.position != nullptr ? glm::dot(frame.to_inward, p - frame.eye) : Real(depth[i]);
        pixel.quad = micro_quad(frame, column, row, away, n);
        pixel.sound = pixel.quad.ok;
        if (!pixel.sound) return pixel;
        // The middle of a quad has the pixel's own depth, however the quad was turned.
        Vec3<Real> const middle = point_on(frame, pixel.quad, column, row, 0.5L, 0.5L);
        Vec3<Real> const travel = light.kind == LightKind::directional ? light.direction : middle - light.position;
        Vec3<Real> const sight = flat ? frame.inward : middle - frame.eye;
        Real const by_light = glm::dot(n, travel) / glm::length(n) / glm::length(travel);
        Real const by_eye = glm::dot(n, sight) / glm::length(n) / glm::length(sight);
        pixel.least_side = std::fmin(std::fabs(by_light), std::fabs(by_eye));
        pixel.lit = (by_light > 0) == (by_eye > 0);
        if (!pixel.lit) return pixel;
        pixel.alive = true;
        Real steepest = 0;
        for (Real& key : pixel.keys) key = -1e30L;
        pixel.keys[0] = pixel.keys[2] = 1e30L;
        for (Real const u : {0.0L, 1.0L})
            for (Real const v : {0.0L, 1.0L}) {
                Vec3<Real> const corner = point_on(frame, pixel.quad, column, row, u, v) - frame.eye;
                Real at[4];
                for (int r = 0; r < 4; ++r) at[r] = glm::dot(Vec3<Real>(buffer.row[r]), corner) + Real(buffer.row[r].w);
                pixel.alive = pixel.alive && at[3] > Real(w_min);
                pixel.least_w_over = std::fmin(pixel.least_w_over, std::fabs(at[3] - Real(w_min)));
                Real const x = at[0] / at[3], y = at[1] / at[3];
                pixel.keys[0] = std::fmin(pixel.keys[0], x), pixel.keys[1] = std::fmax(pixel.keys[1], x);
                pixel.keys[2] = std::fmin(pixel.keys[2], y), pixel.keys[3] = std::fmax(pixel.keys[3], y);
                pixel.keys[4] = std::fmax(pixel.keys[4], at[2] / at[3]);
                pixel.lo_w = std::fmin(pixel.lo_w, at[3]), pixel.hi_w = std::fmax(pixel.hi_w, at[3]);
                // Before an eye of perspective, of what is over the depth.
                Real const q = pixel.quad.q + pixel.quad.q_x * u + pixel.quad.q_y * v;
                steepest = std::fmax(steepest, 1 / (flat ? at[3] : at[3] * q));
            }
        auto const& q = pixel.quad;
        Real const size = std::fabs(q.q) + std::fabs(q.q_x) + std::fabs(q.q_y);
        Real const reach = flat ? Real(buffer.contact_reach) + size : Real(buffer.contact_ray), here = flat ? 1 : size;
        auto const error = [&](Number each_metre, Number anywhere) {
            return steepest * (reach * Real(each_metre) + here * Real(anywhere));
        };
        Real const pad = error(buffer.texel_error, buffer.texel_error_here) + Real(1) / 128;
        pixel.keys[0] -= pad, pixel.keys[1] += pad, pixel.keys[2] -= pad, pixel.keys[3] += pad;
        pixel.keys[4] += error(buffer.depth_error, buffer.depth_error_here);
        return pixel;
    }
    static void expect_near(Number value, Real wanted, char const* what) {
        Real const slack = 2000 * Real(std::numeric_limits<Number>::epsilon()) * (1 + std::fabs(wanted));
        EXPECT_NEAR(double(Real(value) - wanted), 0.0, double(slack))
            << what << ' ' << value << ", not " << double(wanted);
    }
    static std::array<Number, 16> numbers(Lanes const& lanes) {
        std::array<Number, 16> stored;
        lanes.store(stored.data());
        return stored;
    }
};

}  // namespace shadowmath::test
