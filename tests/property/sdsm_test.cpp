// SPDX-License-Identifier: MIT
#include "tests/laws/sdsm.hpp"
#include "tests/support/sampled_scene.hpp"
#include "tests/support/tolerance.hpp"
#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

namespace {

template <class T>
SampleFitOptions<T> drawn_options() {
    SampleFitOptions<T> options;
    options.map_size = static_cast<int>(64 + *below(4000));
    options.margin_texels = T(*below(5));
    options.still = *below(2) == 0;
    options.pancake = *below(2) == 0;
    options.clip = *clip_space();
    return options;
}

SampleSplits drawn_kind() {
    bool const even = *one_in(2);
    return even ? SampleSplits::even : SampleSplits::adaptive;
}

template <class T>
Aabb<T> everything() {
    return {Vec3<T>(T(-1e6)), Vec3<T>(T(1e6))};
}

template <class T>
class SdsmProperty : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(SdsmProperty, Scalars);

TYPED_TEST(SdsmProperty, EverySampleIsInsideItsMapMarginIncluded) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        SampledScene<T> const scene = *sampled_scene<T>(T(100));
        SampleFitOptions<T> const options = drawn_options<T>();
        int const count = static_cast<int>(1 + *below(6));
        Sampled<T> const all = sampled(scene, count, drawn_kind(), T(0.1));
        SampleRays<T> const& rays = all.rays;
        auto const cascades = fit_samples(rays, all.bounds, everything<T>(), options);
        for_each_sample(scene, [&](int x, int y, T depth) {
            Vec3<T> const point = from_eye(rays, x, y, depth);
            // Coordinates from the world's origin, the axes back from light space, and the rows of the map: 4 each.
            T const lost = tolerance(T(2) * glm::length(rays.eye) + T(2) * glm::length(point), 16);
            int serving = 0;
            for (Cascade<T> const& cascade : cascades) {
                if (!is_served(cascade.range, depth)) continue;
                RC_ASSERT(cascade.map.visible);
                RC_ASSERT(laws::holds_sample(cascade.map, rays, point, options.map_size, options.margin_texels,
                                             options.pancake, static_cast<long double>(lost)));
                ++serving;
            }
            RC_ASSERT(serving >= 1);
        });
    }));
}

TYPED_TEST(SdsmProperty, EveryMapObeysTheLaw) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        SampledScene<T> const scene = *sampled_scene<T>(T(100));
        SampleFitOptions<T> const options = drawn_options<T>();
        Aabb<T> const casters = *box<T>(T(100));
        auto const [depths, rays, bounds] = sampled(scene, 4, drawn_kind());
        for (Cascade<T> const& cascade : fit_samples(rays, bounds, casters, options)) {
            RC_ASSERT(laws::harmless(cascade.map));
            if (cascade.map.visible)
                RC_ASSERT(laws::is_map_of(cascade.map.clip_from_world, scene.light, options.clip, 64));
        }
    }));
}

TYPED_TEST(SdsmProperty, TheLightEntersNoLaterThanTheBoxBegins) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        Light<T> const light = *sun<T>();
        LightBasis<T> const basis = light_basis(light.direction);
        Aabb<T> const casters = *box<T>(T(100));
        Vec3<T> const centre = *point_within<T>(T(150));
        T const half_x = *log_uniform<T>(T(1e-3), T(100));
        T const half_y = *log_uniform<T>(T(1e-3), T(100));
        Vec2<T> const lo(centre.x - half_x, centre.y - half_y), hi(centre.x + half_x, centre.y + half_y);
        RC_ASSERT(laws::is_before_the_box(light_entry(basis, lo, hi, casters), basis, lo, hi, casters));
    }));
}

// Along one ray, the faces' rise across the sides is none: entry is where the box begins, to rounding of the division
// by the least cosine of light_entry.
TYPED_TEST(SdsmProperty, AlongOneRayTheLightEntersWhereTheBoxBegins) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        Light<T> const light = *sun<T>();
        LightBasis<T> const basis = light_basis(light.direction);
        Aabb<T> const casters = *box<T>(T(100));
        T const u = *uniform<T>(T(0), T(1)), v = *uniform<T>(T(0), T(1)), w = *uniform<T>(T(0), T(1));
        Vec3<T> const inside = casters.lo + (casters.hi - casters.lo) * Vec3<T>(u, v, w);
        Vec3<T> const at = in_light(basis, inside);
        Vec2<T> const ray(at.x, at.y);
        T const entry = light_entry(basis, ray, ray, casters);
        // From a point inside back to the nearest face that the light came through.
        T way = std::numeric_limits<T>::max(), least = T(1);
        for (int k = 0; k < 3; ++k) {
            T const along = basis.depth[k];
            if (!(std::abs(along) > T(1e-4))) continue;
            T const here = ((along > T(0) ? casters.lo[k] : casters.hi[k]) - inside[k]) / -along;
            way = here < way ? here : way;
            least = std::abs(along) < least ? std::abs(along) : least;
        }
        T const rounding = tolerance(T(600), 16) / least;
        RC_ASSERT(std::abs(entry - (at.z - way)) <= rounding);
    }));
}

TYPED_TEST(SdsmProperty, NoCasterBeforeASampleIsCutOff) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        SampledScene<T> const scene = *sampled_scene<T>(T(100));
        SampleFitOptions<T> options = drawn_options<T>();
        options.pancake = false;
        options.clip = ClipSpace{};
        Sampled<T> const all = sampled(scene, 3, drawn_kind());
        SampleRays<T> const& rays = all.rays;
        T const above = *log_uniform<T>(T(0.01), T(100));
        Vec3<T> const half = Vec3<T>(*log_uniform<T>(T(0.01), T(10)));
        for_each_sample(scene, [&](int x, int y, T depth) {
            // A box around a point on the sample's way to the light.
            Vec3<T> const point = from_eye(rays, x, y, depth) + rays.eye - Vec3<T>(T(0), T(0), above);
            Vec3<T> const world = rays.basis.x * point.x + rays.basis.y * point.y + rays.basis.depth * point.z;
            auto const cascades = fit_samples(rays, all.bounds, Aabb<T>{world - half, world + half}, options);
            for (Cascade<T> const& cascade : cascades) {
                if (!is_served(cascade.range, depth)) continue;
                RC_ASSERT(cascade.map.visible);
                Vec4<long double> const at = laws::image_of(cascade.map.clip_from_world, Vec4<T>(world, T(1)));
                RC_ASSERT(at.z >= 0);
            }
        });
    }));
}

TYPED_TEST(SdsmProperty, AMapIsNeverWiderThanThatOfItsWholeSlice) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        SampledScene<T> const scene = *sampled_scene<T>(T(10));
        SampleFitOptions<T> options = drawn_options<T>();
        options.still = false;
        auto const [depths, rays, bounds] = sampled(scene, 4, drawn_kind());
        Cascades<T> const cascades = fit_samples(rays, bounds, everything<T>(), options);
        for (int i = 0; i < cascades.count; ++i) {
            if (!cascades.at[i].map.visible) continue;
            SliceRange<T> range = cascades.at[i].range;
            // Samples within 2^-12 of a plane count for both sides of it.
            range.begin *= T(1) - T(0x1p-11);
            range.end *= T(1) + T(0x1p-11);
            LightBox<T> const whole =
                fit_box(rays.basis, corners(slice(scene.view, range)), options.map_size, options.margin_texels);
            Vec2<T> const texel = texel_metres(whole, options.map_size);
            T const least = texel.x > texel.y ? texel.x : texel.y;
            // Boxes end 2^-18 of the way from the eye farther out, on both sides.
            T const lost = (tolerance(glm::length(rays.eye) + range.end * T(8), 64) + range.end * T(8) * T(0x1p-17)) /
                           T(options.map_size);
            RC_ASSERT(cascades.at[i].texel_metres <= least + lost + T(2e-6) / T(options.map_size));
        }
    }));
}

TYPED_TEST(SdsmProperty, StillMapsKeepEveryPointInItsPlaceWhileTheirTexelsAreTheSame) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        SampledScene<T> scene = *sampled_scene<T>(sizeof(T) == 4 ? T(10) : T(1e5));
        SampleFitOptions<T> options = drawn_options<T>();
        options.still = true;
        auto const before = sampled(scene, 1, SampleSplits::even);
        auto const one = fit_samples(before.rays, before.bounds, everything<T>(), options);
        Vec3<T> const step = *point_within<T>(T(1));
        scene.view.pose.position += step;
        std::uint64_t const changed = *below(scene.depth.size());
        scene.depth[changed] *= T(1.01);
        auto const after = sampled(scene, 1, SampleSplits::even);
        auto const other = fit_samples(after.rays, after.bounds, everything<T>(), options);
        RC_PRE(one.count == 1 && other.count == 1 && one.at[0].map.visible && other.at[0].map.visible);
        RC_PRE(!one.faults.has(Fault::precision_lost) && !other.faults.has(Fault::precision_lost));
        Mat4<T> const &a = one.at[0].map.clip_from_world, &b = other.at[0].map.clip_from_world;
        bool const same_texels = row(a, 0).x == row(b, 0).x && row(a, 0).y == row(b, 0).y &&
                                 row(a, 0).z == row(b, 0).z && row(a, 1).x == row(b, 1).x &&
                                 row(a, 1).y == row(b, 1).y && row(a, 1).z == row(b, 1).z;
        RC_CLASSIFY(same_texels);
        if (same_texels) RC_ASSERT(laws::keeps_its_place(a, b, options.map_size, scene.view.pose.position, 1.0L / 64));
    }));
}

// Half a texel on either side is what the size of a texel leaves room for.
TYPED_TEST(SdsmProperty, TheMiddleOfAStillMapIsWithinHalfATexelOfTheMiddleOfItsSamples) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        SampledScene<T> const scene = *sampled_scene<T>(T(10));
        SampleFitOptions<T> options = drawn_options<T>();
        options.still = true;
        options.clip = ClipSpace{};
        auto const [depths, rays, bounds] = sampled(scene, 2, drawn_kind());
        Cascades<T> const cascades = fit_samples(rays, bounds, everything<T>(), options);
        for (int i = 0; i < cascades.count; ++i) {
            if (!cascades.at[i].map.visible || cascades.at[i].map.faults.any()) continue;
            Vec3<T> const middle = rays.eye + (bounds.box[i].lo + bounds.box[i].hi) * T(0.5);
            Vec3<T> const world = rays.basis.x * middle.x + rays.basis.y * middle.y + rays.basis.depth * middle.z;
            Vec4<long double> const at = laws::image_of(cascades.at[i].map.clip_from_world, Vec4<T>(world, T(1)));
            // In texels; a 64th is what precision_lost allows each of the four roundings on the way.
            for (int axis = 0; axis < 2; ++axis)
                RC_ASSERT(std::abs(at[axis]) * options.map_size / 2 <= 0.5L + 1.0L / 16);
        }
    }));
}

TYPED_TEST(SdsmProperty, NoInputMakesANaNAnAllocationOrATrap) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        SampledScene<T> scene = *sampled_scene<T>(T(100));
        bool const bad_view = *one_in(2);
        if (bad_view) scene.view = *nasty_view_volume<T>();
        Vec3<T> const travel = *nasty_vec3<T>();
        bool const bad_light = *one_in(2);
        if (bad_light) scene.light = directional(travel);
        auto const result = sampled(scene, 4, drawn_kind());
        Aabb<T> const casters = *nasty_box<T>();
        SampleFitOptions<T> options = drawn_options<T>();
        options.map_size = static_cast<int>(*below(200)) - 20;
        bool const bad_margin = *one_in(3);
        if (bad_margin) options.margin_texels = *nasty<T>();
        auto const run = watched([&] { return fit_samples(result.rays, result.bounds, casters, options); });
        RC_ASSERT(run.allocations == 0u);
        for (Cascade<T> const& cascade : run.result) {
            RC_ASSERT(laws::harmless(cascade.map));
            RC_ASSERT(all_finite(&cascade.texel_metres, 1) && all_finite(&cascade.depth_metres, 1));
        }
    }));
}

}  // namespace
