// SPDX-License-Identifier: MIT
//
// The functions of the irregular z-buffer, one by one. The passes as a whole: irregular_test.cpp.
//
// Where the shader sums in another order than the C++, or where large terms cancel, both are held against the C++ at
// double, and a sample on an edge, to within a float's rounding, is not asked.
#include "tests/twins/twin.hpp"

#include <shadowmath/irregular/gpu.hpp>
#include <shadowmath/light_box.hpp>

#include <cstring>

namespace {

using namespace shadowmath;
using namespace shadowmath::twins;

class QuadsTwins : public Twins {};
INSTANTIATE_TEST_SUITE_P(Drivers, QuadsTwins, twin_drivers, driver_name);

constexpr auto& shader = shaders::quads_comp;

// A picture 64 pixels wide, perspective or not, and a sun or a lamp.
struct Picture {
    PixelFrame<float> frame;
    Light<float> light;
    GpuIrregular gpu;
};

Picture picture(Draw& draw) {
    Picture drawn;
    ViewVolume<float> view = perspective_view(pose_looking(draw.within(10.0f), draw.unit(), draw.unit()),
                                              draw.uniform(0.3f, 2.0f), draw.uniform(0.5f, 2.0f), 0.1f, 1000.0f);
    if (draw.one_in(4)) view.kind = ViewKind::orthographic;
    drawn.frame = pixel_frame(view, 64, draw.whole(16, 64));
    bool const lamp = draw.one_in(2);
    Vec3<float> const axis = draw.unit();
    drawn.light = lamp ? spot(draw.within(50.0f), axis, 0.5f, 100.0f) : directional(axis);
    ShadowMap<float> grid;
    grid.visible = true;
    grid.clip = gl_zero_to_one_clip;
    LightBox<float> box;
    box.basis = light_basis(axis);
    box.lo = Vec2<float>(-50.0f);
    box.hi = Vec2<float>(50.0f);
    box.depth_lo = -100.0f;
    box.depth_hi = 100.0f;
    grid.clip_from_world =
        lamp ? clip_from_world(perspective_view(pose_looking(drawn.light.position, axis, Vec3<float>(0.0f, 1.0f, 0.0f)),
                                                1.0f, 1.0f, 0.1f, 100.0f),
                               grid.clip)
             : clip_from_world(box, grid.clip);
    Faults const faults = gpu_irregular(drawn.frame, drawn.light, grid, 64, drawn.gpu);
    EXPECT_FALSE(faults.any()) << describe(faults);
    return drawn;
}

void give(Words& given, GpuFloat3 const& v) {
    given(v.x)(v.y)(v.z);
}
void give_frame(Words& given, GpuPixelFrame const& f) {
    give(given, f.eye);
    given(f.width);
    give(given, f.across);
    given(f.height);
    give(given, f.upward);
    given(f.orthographic);
    give(given, f.inward);
    given(f.origin_x);
    give(given, f.to_across);
    given(f.origin_y);
    give(given, f.to_upward);
    given(f.turn_limit);
    give(given, f.to_inward);
}
void give_light(Words& given, GpuIrregular const& gpu) {
    give(given, gpu.light_at);
    given(gpu.parallel);
    give(given, gpu.source);
}

Vec3<float> three(GpuFloat3 const& v) {
    return Vec3<float>(v.x, v.y, v.z);
}

// What the shader makes of the frame in double.
PixelFrame<double> exact(Picture const& of) {
    return frame_in<double>(of.frame);
}
PixelLight<double> exact_light(Picture const& of) {
    Vec3<double> const source(three(of.gpu.source));
    bool const parallel = of.gpu.parallel != 0;
    return {parallel ? direction_in_pixels(exact(of), source) : point_in_pixels(exact(of), source), parallel};
}

TEST_P(QuadsTwins, InnerAndCross) {
    prove({"inner, cross", shader, 0}, [](Draw& draw, Words& given, Words& expected) {
        auto const vector = [&draw] {
            Vec3<float> const v = draw.vector();
            return all_finite(v) ? v : Vec3<float>(0.0f);
        };
        Vec3<float> a = vector() * 1e-15f, b = vector() * 1e-15f;
        given(a)(b);
        auto const inner = [](auto const& x, auto const& y) {
            return shadowmath::detail::inner<decltype(x.x + y.x)>({x.x, x.y, x.z}, {y.x, y.y, y.z});
        };
        Vec3<double> const c(a), d(b);
        expected(inner(a, b))(static_cast<float>(inner(c, d)));
        auto const crossed = shadowmath::detail::crossed<double>({c.x, c.y, c.z}, {d.x, d.y, d.z});
        expected(static_cast<float>(crossed.x))(static_cast<float>(crossed.y))(static_cast<float>(crossed.z));
    });
}

TEST_P(QuadsTwins, PixelSample) {
    prove({"pixel_sample", shader, 1, 32}, [](Draw& draw, Words& given, Words& expected) {
        int const i = draw.whole(0, samples_per_pixel - 1);
        given(i);
        // The C++ sums digits in float, some ulp off.
        expected(pixel_samples<float>.u[i])(pixel_samples<float>.v[i]);
    });
}

TEST_P(QuadsTwins, PixelCornerAndNormalInPixels) {
    prove({"normal_in_pixels", shader, 2}, [](Draw& draw, Words& given, Words& expected) {
        Picture const of = picture(draw);
        int const x = draw.whole(0, 63), y = draw.whole(0, of.frame.height - 1);
        Vec3<float> const n = draw.direction();
        give_frame(given, of.gpu.frame);
        given(x)(y)(n);
        expected(static_cast<float>(x) - 32.0f)(static_cast<float>(y) - static_cast<float>(of.frame.height) / 2.0f);
        for (Vec3<float> const& axis : {of.frame.across, of.frame.upward, of.frame.inward})
            expected(shadowmath::detail::inner<float>({axis.x, axis.y, axis.z}, {n.x, n.y, n.z}));
    });
}

TEST_P(QuadsTwins, HalfPlaneMask) {
    prove({"half_plane_mask", shader, 3, 500}, [](Draw& draw, Words& given, Words& expected) {
        PixelLine<float> const line{draw.number(1.0f), draw.number(1.0f), draw.number(1.0f)};
        given(line.c)(line.x)(line.y);
        expected(half_plane_mask<PlainLanes<float>>(line));
    });
}

// The shader sums the two large terms last.
TEST_P(QuadsTwins, LineAcross) {
    prove({"line_across", shader, 4}, [](Draw& draw, Words& given, Words& expected) {
        Vec4<float> plane(1.0f);
        for (int i = 0; i < 4; ++i) plane[i] = draw.number(10.0f);
        Vec2<float> const corner(static_cast<float>(draw.whole(-32, 31)), static_cast<float>(draw.whole(-32, 31)));
        float const q = draw.spoilt(draw.log_uniform(1e-3f, 10.0f)), q_x = draw.number(0.1f), q_y = draw.number(0.1f);
        given(plane)(q)(q_x)(q_y)(corner);
        expected(plane.x * corner.x + plane.y * corner.y +
                 (plane.z + plane.w * q))(plane.x + plane.w * q_x)(plane.y + plane.w * q_y);
    });
}

// A pixel and the plane that it shows, at most so steep to the eye that rounding does not tell which side is seen. One
// in eight shows nothing: no depth, none before the eye, no normal, or numbers that are none.
struct Seen {
    int column = 0, row = 0;
    float depth = 1.0f;
    Vec3<float> normal{0.0f};
};
Seen seen(Draw& draw, Picture const& of) {
    PixelFrame<double> const frame = exact(of);
    Seen drawn;
    double facing = 0.0, reach = 1.0;
    while (!(std::abs(facing) > 1e-2 * reach)) {
        drawn = {draw.whole(0, frame.width - 1), draw.whole(0, frame.height - 1), draw.log_uniform(0.5f, 100.0f),
                 draw.unit()};
        Vec3<double> const n = shadowmath::detail::normal_in_pixels(frame, Vec3<double>(drawn.normal));
        double const x = drawn.column + 0.5 - frame.width / 2.0, y = drawn.row + 0.5 - frame.height / 2.0;
        bool const flat = frame.kind == ViewKind::orthographic;
        facing = flat ? n.z : n.x * x + n.y * y + n.z;
        reach = std::abs(n.x * x) + std::abs(n.y * y) + std::abs(n.z);
    }
    if (!draw.one_in(8)) return drawn;
    constexpr float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
    if (draw.one_in(2))
        drawn.normal = draw.one_in(2) ? Vec3<float>(0.0f) : Vec3<float>(nan, 1.0f, infinity);
    else
        drawn.depth = draw.one_in(2) ? nan : infinity;
    return drawn;
}

MicroQuad<double> exact_quad(Picture const& of, Seen const& at) {
    return micro_quad(exact(of), at.column, at.row, static_cast<double>(at.depth), Vec3<double>(at.normal));
}

// What faces the eye is a sum of terms up to 100 times as large: 3 roundings of each, and as many again of the frame's
// own numbers.
TEST_P(QuadsTwins, MicroQuad) {
    prove({"micro_quad", shader, 5}, [](Draw& draw, Words& given, Words& expected) {
        Picture const of = picture(draw);
        Seen const at = seen(draw, of);
        MicroQuad<double> const quad = exact_quad(of, at);
        give_frame(given, of.gpu.frame);
        given(at.column)(at.row)(at.normal)(at.depth);
        expected(quad.ok);
        for (double const number : {quad.q, quad.q_x, quad.q_y})
            expected(quad.ok ? static_cast<float>(number) : 0.0f, 600);
    });
}

// Where light and eye are clearly on one side, or on two.
TEST_P(QuadsTwins, FacesLight) {
    prove({"faces_light", shader, 6, 2}, [](Draw& draw, Words& given, Words& expected) {
        Picture of;
        Seen at;
        double toward_eye = 0.0, toward_light = 0.0;
        do {
            of = picture(draw);
            at = seen(draw, of);
            if (!all_finite(at.normal) || !all_finite(&at.depth, 1)) at = {0, 0, 1.0f, Vec3<float>(0.0f)};
            PixelFrame<float> const& f = of.frame;
            bool const flat = f.kind == ViewKind::orthographic;
            double const x = at.column + 0.5 - f.width / 2.0, y = at.row + 0.5 - f.height / 2.0;
            Vec3<double> const aside = Vec3<double>(f.across) * x + Vec3<double>(f.upward) * y;
            Vec3<double> const inward(f.inward), eye(f.eye), normal(at.normal);
            Vec3<double> const across = Vec3<double>(f.across) * static_cast<double>(f.origin.x);
            Vec3<double> const upward = Vec3<double>(f.upward) * static_cast<double>(f.origin.y);
            Vec3<double> const point = flat ? eye + across + upward + aside + inward * static_cast<double>(at.depth)
                                            : eye + (inward + aside) * static_cast<double>(at.depth);
            Vec3<double> const source(three(of.gpu.source));
            Vec3<double> const travel = of.gpu.parallel != 0 ? source : glm::normalize(point - source);
            toward_eye = glm::dot(normal, glm::normalize(flat ? inward : point - eye));
            toward_light = glm::dot(normal, travel);
        } while (at.normal != Vec3<float>(0.0f) && (std::abs(toward_eye) < 1e-3 || std::abs(toward_light) < 1e-3));
        give_frame(given, of.gpu.frame);
        give_light(given, of.gpu);
        given(at.column)(at.row)(at.normal)(at.depth);
        expected(toward_eye * toward_light > 0.0);
    });
}

// The frame's inverse cancels: terms up to a thousand times the result.
TEST_P(QuadsTwins, PointsDirectionsAndTheLightInPixels) {
    prove({"point_in_pixels", shader, 7}, [](Draw& draw, Words& given, Words& expected) {
        Picture const of = picture(draw);
        Vec3<float> const point = draw.within(100.0f), direction = draw.unit();
        give_frame(given, of.gpu.frame);
        give_light(given, of.gpu);
        given(point)(direction);
        expected(Vec3<float>(point_in_pixels(exact(of), Vec3<double>(point))), 4)(
            Vec3<float>(direction_in_pixels(exact(of), Vec3<double>(direction))), 4)(Vec3<float>(exact_light(of).at),
                                                                                     4);
    });
}

// The samples of a pixel that a triangle darkens, by the C++ at double; those on an edge to 1e-4 of the line's own size
// are not asked. Triangles through and around the way from the pixel to the light.
TEST_P(QuadsTwins, ShadowVolumeAndOccluded) {
    prove({"shadow_volume, occluded", shader, 8, 500}, [](Draw& draw, Words& given, Words& expected) {
        Picture const of = picture(draw);
        Seen const at = seen(draw, of);
        PixelFrame<double> const frame = exact(of);
        PixelLight<double> const light = exact_light(of);
        MicroQuad<double> const quad = exact_quad(of, at);
        Vec3<double> const middle = quad.ok ? point_on(frame, quad, at.column, at.row, 0.5, 0.5) : Vec3<double>(0.0);
        Vec3<double> const source(three(of.gpu.source));
        Vec3<double> const way = light.parallel ? -source * 20.0 : source - middle;
        double const share = static_cast<double>(draw.uniform(-0.2f, 1.0f));
        // As large as a pixel and more.
        double const pixel = glm::length(Vec3<double>(of.frame.across)) *
                             (frame.kind == ViewKind::perspective && quad.ok ? static_cast<double>(at.depth) : 1.0);
        float const size = static_cast<float>(pixel) * draw.log_uniform(0.3f, 30.0f);
        Vec3<float> corner[3];
        for (Vec3<float>& c : corner) c = Vec3<float>(middle + way * share) + draw.within(size);

        Vec3<double> inside[3];
        for (int i = 0; i < 3; ++i) inside[i] = point_in_pixels(frame, Vec3<double>(corner[i]));
        ShadowVolume<double> const volume = shadow_volume(frame, light, inside[0], inside[1], inside[2], {0.0, 0.0});
        bool const casts = quad.ok && std::abs(volume.along) >= static_cast<double>(std::numeric_limits<float>::min());
        std::uint32_t mask = casts ? every_sample : 0u, care = casts ? every_sample : 0u;
        for (PixelPlane<double> const& plane : volume.planes) {
            if (!casts) break;
            PixelLine<double> const line = line_across(frame, plane, quad, at.column, at.row);
            mask &= half_plane_mask<PlainLanes<double>>(line);
            for (int i = 0; i < samples_per_pixel; ++i) {
                double const u = pixel_samples<double>.u[i], v = pixel_samples<double>.v[i];
                double const reach = std::abs(line.c) + std::abs(line.x) + std::abs(line.y);
                // What the quad was rounded to moves the line by as much as it slopes in depth.
                double const moved = 1e-3 * std::abs(plane.b) * (std::abs(quad.q_x) + std::abs(quad.q_y));
                if (std::abs(line.c + line.x * u + line.y * v) <= 1e-4 * reach + moved) care &= ~(1u << i);
            }
        }
        give_frame(given, of.gpu.frame);
        give_light(given, of.gpu);
        given(at.column)(at.row)(at.normal)(at.depth);
        for (Vec3<float> const& c : corner) given(c);
        given(care);
        expected(casts)(mask & care);
    });
}

}  // namespace
