// SPDX-License-Identifier: MIT
#include "tests/laws/footprint.hpp"
#include "tests/support/any_map.hpp"
#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

namespace {

// An eye that sees a point of a surface that a map sees too, neither of them edge-on.
struct Sight {
    AnyMap<double> any;
    Mat4<double> eye;
    Vec2<double> eye_pixels;
    double map_texels;
    Vec3<double> point, normal;

    [[nodiscard]] Footprint<double> measure() const {
        return footprint(eye, eye_pixels, any.map.clip_from_world, map_texels, point, normal);
    }
};

void showValue(Sight const& sight, std::ostream& out) {
    showValue(sight.any, out);
    out << " point ";
    showValue(sight.point, out);
    out << " normal ";
    showValue(sight.normal, out);
}

rc::Gen<Sight> sight() {
    return rc::gen::exec([] {
        Sight s;
        s.any = *any_map<double>();
        s.point = *point_in(s.any.map);
        s.normal = *normal_facing(s.any.light, s.point, 10.0);
        auto const distance = *log_uniform<double>(0.5, 500.0);
        auto const to_eye = *direction<double>();
        auto const miss = *point_within<double>(0.3);
        RC_PRE(std::abs(glm::dot(to_eye, s.normal)) > 0.05);
        Pose<double> const pose = pose_looking(s.point + to_eye * distance, miss - to_eye, Vec3<double>(0, 1, 0));
        bool const flat = *one_in(4);
        ViewVolume<double> const view = flat ? orthographic_view(pose, -30.0, 40.0, -20.0, 25.0, 0.1, 1e3)
                                             : perspective_view(pose, 1.2, 1.6, 0.1, 1e3);
        ClipSpace const clip = *clip_space();
        s.eye = clip_from_world(view, clip);
        s.eye_pixels = Vec2<double>(1600, 1000);
        s.map_texels = static_cast<double>(16 + *below(8192));
        return s;
    });
}

template <class T>
class AnyFootprint : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(AnyFootprint, Scalars);

}  // namespace

TYPED_TEST(AnyFootprint, OfAnythingAtAllIsFiniteOrderedAndWithinItsLimit) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        ShadowMap<T> const eye = *nasty_map<T>();
        ShadowMap<T> const map = *nasty_map<T>();
        auto const good = *any_map<T>();
        bool const nasty_point = *one_in(3);
        Vec3<T> const point = nasty_point ? *nasty_vec3<T>() : *point_in(good.map);
        Vec3<T> const normal = *nasty_vec3<T>();
        T const pixels = *nasty<T>();
        T const texels = *nasty<T>();
        Mat4<T> const& fine = good.map.clip_from_world;
        Vec2<T> const usual(T(800), T(600));
        Vec3<T> const up(T(0), T(1), T(0));
        for (auto const& f : {footprint(eye.clip_from_world, usual, fine, T(1024), point, up),
                              footprint(fine, usual, map.clip_from_world, T(1024), point, up),
                              footprint(fine, Vec2<T>(pixels, texels), fine, texels, point, normal),
                              footprint(fine, usual, fine, texels, point, up)}) {
            RC_ASSERT(laws::is_footprint(f));
            RC_ASSERT(laws::is_footprint(texels_per_pixel(f)));
        }
    }));
}

// Two numbers of a 2x2 matrix fix its singular values: their product is the determinant, their squares sum to the
// squares of its entries. Differences over 1e-6 m of places with 1e3 m in them leave 1e-10 of long double.
TEST(FootprintProperty, IsTheSingularValuesOfHowAMoveByTexelsMovesThePicture) {
    EXPECT_TRUE(rc::check([] {
        Sight const s = *sight();
        Footprint<double> const f = s.measure();
        auto const jacobian = laws::measured_jacobian(s.eye, s.eye_pixels, s.any.map.clip_from_world, s.map_texels,
                                                      s.point, tangents(s.normal), 1e-6L);
        long double const major = f.major, minor = f.minor;
        long double const squares = glm::dot(jacobian[0], jacobian[0]) + glm::dot(jacobian[1], jacobian[1]);
        RC_ASSERT(std::abs(major * major + minor * minor - squares) <= 1e-8L * squares);
        RC_ASSERT(std::abs(major * minor - std::abs(glm::determinant(jacobian))) <= 1e-8L * squares);
    }));
}

TEST(FootprintProperty, NoDirectionOfATexelIsLongerOrShorterInThePicture) {
    EXPECT_TRUE(rc::check([] {
        Sight const s = *sight();
        Footprint<double> const f = s.measure();
        auto const jacobian = laws::measured_jacobian(s.eye, s.eye_pixels, s.any.map.clip_from_world, s.map_texels,
                                                      s.point, tangents(s.normal), 1e-6L);
        auto const angle = static_cast<long double>(*uniform<double>(0.0, 6.28));
        long double const pixels = glm::length(jacobian * Vec2<long double>(std::cos(angle), std::sin(angle)));
        RC_ASSERT(pixels <= f.major * (1 + 1e-8L));
        RC_ASSERT(pixels >= f.minor * (1 - 1e-8L) - f.major * 1e-8L);
    }));
}

TEST(FootprintProperty, KnowsNothingOfConventionsOrOfTheNormalsLengthAndSign) {
    EXPECT_TRUE(rc::check([] {
        Sight const s = *sight();
        Sight other = s;
        ClipSpace const clip = *clip_space();
        other.any.map.clip_from_world =
            in_convention(canonical_from_clip<double>(s.any.map.clip) * s.any.map.clip_from_world, clip);
        other.normal = s.normal * -37.0;
        RC_ASSERT(laws::same(s.measure(), other.measure(), 1e-9));
    }));
}

TEST(FootprintProperty, ScalesWithPixelsAndShrinksWithTexels) {
    EXPECT_TRUE(rc::check([] {
        Sight const s = *sight();
        Sight finer = s;
        finer.map_texels = s.map_texels * 4;
        finer.eye_pixels = s.eye_pixels * 3.0;
        Footprint<double> const f = s.measure(), g = finer.measure();
        RC_PRE(f.major < footprint_limit<double>);
        RC_ASSERT(laws::same(g, Footprint<double>{f.major * 0.75, f.minor * 0.75}, 1e-12));
    }));
}

TEST(FootprintProperty, OfTheEyesOwnPictureIsOnePixel) {
    EXPECT_TRUE(rc::check([] {
        Sight s = *sight();
        s.eye_pixels = Vec2<double>(s.map_texels);
        s.any.map.clip_from_world = s.eye;
        RC_ASSERT(laws::same(s.measure(), Footprint<double>{1.0, 1.0}, 1e-9));
    }));
}

TEST(FootprintProperty, RaisesNothingAndAllocatesNothing) {
    EXPECT_TRUE(rc::check([] {
        Sight const s = *sight();
        RC_ASSERT(watched([&s] { return s.measure(); }).calm_in_range());
    }));
}
