// SPDX-License-Identifier: MIT
//
// What the twins are tried on: one seeded generator, much faster than rapidcheck's, as nothing here is shrunk. Three
// cases in four are ordinary; in the fourth any number may have become a nasty one: NaN, infinity, a denormal, a zero,
// the largest, any bits at all.
#pragma once

#include <shadowmath/light_box.hpp>
#include <shadowmath/shadow_map.hpp>
#include <shadowmath/view_volume.hpp>

#include <glm/matrix.hpp>

#include <bit>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <random>

namespace shadowmath::twins {

class Draw {
public:
    explicit Draw(std::uint32_t seed) : engine_(seed) {}

    void next_case() { nasty_case_ = one_in(4); }

    [[nodiscard]] std::uint32_t below(std::uint32_t count) { return static_cast<std::uint32_t>(engine_() % count); }
    [[nodiscard]] bool one_in(std::uint32_t count) { return below(count) == 0; }
    [[nodiscard]] int whole(int lo, int hi) {
        return lo + static_cast<int>(below(static_cast<std::uint32_t>(hi - lo + 1)));
    }

    // These four are always ordinary.
    [[nodiscard]] float uniform(float lo, float hi) {
        float const share = static_cast<float>(below((1u << 24) + 1)) / static_cast<float>(1u << 24);
        return lo * (1.0f - share) + hi * share;
    }
    [[nodiscard]] float log_uniform(float lo, float hi) {
        float const value = std::exp2(uniform(std::log2(lo), std::log2(hi)));
        return value < lo ? lo : (value > hi ? hi : value);
    }
    [[nodiscard]] Vec3<float> within(float radius) {
        float const x = uniform(-radius, radius), y = uniform(-radius, radius);
        return Vec3<float>(x, y, uniform(-radius, radius));
    }
    // A third the axes, a third within a hair of one, a third anywhere.
    [[nodiscard]] Vec3<float> unit() {
        Vec3<float> along(0.0f);
        along[whole(0, 2)] = one_in(2) ? 1.0f : -1.0f;
        std::uint32_t const kind = below(3);
        if (kind == 0) return along;
        Vec3<float> const aside = within(1.0f);
        auto const drawn = safe_normalize(kind == 1 ? along + aside * log_uniform(1e-30f, 0.1f) : aside);
        return drawn.ok ? drawn.direction : along;
    }

    // The rest is nasty in nasty cases.
    [[nodiscard]] float spoilt(float ordinary) { return nasty_case_ && one_in(4) ? nasty() : ordinary; }
    [[nodiscard]] Vec3<float> spoilt(Vec3<float> const& ordinary) {
        float const x = spoilt(ordinary.x), y = spoilt(ordinary.y);
        return Vec3<float>(x, y, spoilt(ordinary.z));
    }
    [[nodiscard]] float number(float radius) { return spoilt(uniform(-radius, radius)); }
    [[nodiscard]] Vec3<float> point(float radius) { return spoilt(within(radius)); }
    [[nodiscard]] Vec3<float> direction() { return spoilt(unit()); }
    [[nodiscard]] Vec3<float> vector() { return spoilt(unit() * log_uniform(1e-30f, 1e30f)); }
    [[nodiscard]] Mat4<float> spoilt(Mat4<float> matrix) {
        if (nasty_case_ && one_in(2))
            for (int i = whole(1, 3); i > 0; --i) matrix[whole(0, 3)][whole(0, 3)] = nasty();
        return matrix;
    }

    [[nodiscard]] ClipSpace clip_space() {
        ClipSpace clip;
        clip.depth = static_cast<DepthOrder>(below(3));
        clip.ndc_y = static_cast<YAxis>(below(2));
        clip.texture_v = static_cast<YAxis>(below(2));
        return clip;
    }

    struct Seen {
        ShadowMap<float> map;
        Light<float> light;
        Vec3<float> point{0.0f};  // in the map or a little outside
    };

    // Affine, warped across the light, or of a spot; in any convention.
    [[nodiscard]] Seen seen() {
        Seen drawn;
        std::uint32_t const kind = below(3);
        Mat4<float> canonical(1.0f);
        if (kind < 2) {
            drawn.light = directional(unit());
            LightBox<float> box;
            box.basis = light_basis(drawn.light.direction);
            Vec3<float> const centre = within(100.0f);
            float const half = log_uniform(0.5f, 200.0f), depth = log_uniform(1.0f, 1000.0f);
            box.lo = Vec2<float>(centre.x - half, centre.y - half);
            box.hi = Vec2<float>(centre.x + half, centre.y + half);
            box.depth_lo = centre.z - depth;
            box.depth_hi = centre.z + depth;
            canonical = clip_from_world(box, gl_zero_to_one_clip);
            if (kind == 1) {
                Mat4<float> warp(1.0f);
                warp[0][3] = uniform(-0.4f, 0.4f);
                warp[1][3] = uniform(-0.4f, 0.4f);
                warp[2][2] = 0.2f;
                canonical = warp * canonical;
            }
        } else {
            Vec3<float> const position = within(100.0f), axis = unit();
            float const half_angle = uniform(0.1f, 1.3f), z_near = log_uniform(0.1f, 2.0f);
            float const z_far = z_near * log_uniform(4.0f, 200.0f);
            drawn.light = spot(position, axis, half_angle, z_far);
            canonical = clip_from_world(perspective_view(pose_looking(position, axis, Vec3<float>(0.0f, 1.0f, 0.0f)),
                                                         half_angle * 2.0f, 1.0f, z_near, z_far),
                                        gl_zero_to_one_clip);
        }
        drawn.point = spoilt(point_at(canonical));
        drawn.map.clip = clip_space();
        drawn.map.clip_from_world = spoilt(clip_from_canonical<float>(drawn.map.clip) * canonical);
        drawn.map.w_min = one_in(4) ? spoilt(log_uniform(1e-3f, 10.0f)) : 0.0f;
        drawn.map.visible = !one_in(16);
        return drawn;
    }

    // An eye that sees the point, or nearly.
    [[nodiscard]] Mat4<float> eye_near(Vec3<float> const& seen_point) {
        bool const finite = all_finite(seen_point) && std::abs(seen_point.x + seen_point.y + seen_point.z) < 1e6f;
        Vec3<float> const at = finite ? seen_point : Vec3<float>(0.0f);
        Vec3<float> const forward = unit();
        Vec3<float> const eye = at - (forward + within(0.5f)) * log_uniform(0.1f, 100.0f);
        auto const view = perspective_view(pose_looking(eye, forward, unit()), uniform(0.3f, 2.0f), uniform(0.5f, 2.0f),
                                           0.01f, 1000.0f);
        return spoilt(clip_from_world(view, gl_zero_to_one_clip));
    }

    // Zeros, denormals, the ends of the range, neighbours of one, infinities, NaN; any bits; any magnitude.
    [[nodiscard]] float nasty() {
        using Limits = std::numeric_limits<float>;
        constexpr float special[] = {0.0f,
                                     Limits::denorm_min(),
                                     1e-40f,
                                     Limits::min(),
                                     Limits::epsilon(),
                                     0.99999994f,
                                     1.0f,
                                     1.00000012f,
                                     2.0f,
                                     1e30f,
                                     Limits::max(),
                                     Limits::infinity(),
                                     Limits::quiet_NaN()};
        float const sign = one_in(2) ? -1.0f : 1.0f;
        std::uint32_t const kind = below(4);
        if (kind == 0) return std::bit_cast<float>(static_cast<std::uint32_t>(engine_()));
        if (kind == 1) return sign * log_uniform(Limits::min(), 1e38f);
        return sign * special[below(static_cast<std::uint32_t>(std::size(special)))];
    }

private:
    // In the canonical map, or up to a tenth outside.
    [[nodiscard]] Vec3<float> point_at(Mat4<float> const& canonical) {
        float const x = uniform(-1.1f, 1.1f), y = uniform(-1.1f, 1.1f);
        Vec4<double> const ndc(x, y, uniform(-0.1f, 1.1f), 1.0);
        Vec4<double> const world = glm::inverse(Mat4<double>(canonical)) * ndc;
        return Vec3<float>(Vec3<double>(world) / world.w);
    }

    std::mt19937 engine_;
    bool nasty_case_ = false;
};

}  // namespace shadowmath::twins
