// SPDX-License-Identifier: MIT
#include "tests/laws/cascades.hpp"
#include "tests/support/gen.hpp"
#include "tests/support/tolerance.hpp"
#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

namespace {

template <class T>
CascadeOptions<T> drawn_options() {
    CascadeOptions<T> options;
    options.count = static_cast<int>(1 + *below(6));
    options.map_size = static_cast<int>(64 + *below(4000));
    options.fit = static_cast<CascadeFit>(*below(4));
    options.lambda = *uniform<T>(T(0), T(1));
    options.blend = *uniform<T>(T(0), T(0.5));
    options.filter_radius = static_cast<int>(*below(4));
    options.pancake = *below(2) == 0;
    options.clip = *clip_space();
    return options;
}

// A view whose shadows one would draw: what it sees is small enough for texels to mean something.
template <class T>
ViewVolume<T> drawn_view(T radius) {
    ViewVolume<T> view = *view_volume<T>();
    view.pose = *pose<T>(radius);
    view.z_far = view.z_near * *log_uniform<T>(T(2), T(1e4));
    return view;
}

template <class T>
class CascadesProperty : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(CascadesProperty, Scalars);

TYPED_TEST(CascadesProperty, EveryVisibleReceiverIsInsideItsMapFilterMarginIncluded) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        ViewVolume<T> const view = drawn_view<T>(T(100));
        Light<T> const light = *sun<T>();
        CascadeOptions<T> const options = drawn_options<T>();
        T const reach = T(4) * (view.z_far + glm::length(view.pose.position)) *
                        (T(1) + std::max(std::abs(view.left), std::abs(view.right)) +
                         std::max(std::abs(view.bottom), std::abs(view.top)));
        Aabb<T> const everything{Vec3<T>(-reach), Vec3<T>(reach)};
        auto const cascades = fit_cascades(view, light, everything, everything, options);
        RC_ASSERT(laws::well_formed(cascades));
        for (auto const& c : cascades) RC_ASSERT(c.map.visible);
        for (int i = 0; i < 16; ++i) {
            T const across = *uniform<T>(T(0), T(1));
            T const upward = *uniform<T>(T(0), T(1));
            T const deep = *uniform<T>(T(0), T(1));
            T const depth = view.z_near + (view.z_far - view.z_near) * deep;
            Vec3<T> const world = point_at(view, view.left + (view.right - view.left) * across,
                                           view.bottom + (view.top - view.bottom) * upward, depth);
            // The point itself is rounded at the far corner's distance: some ulp of that, in the finest texels.
            T const lost_metres = tolerance(glm::length(world) + glm::length(view.pose.position), 64);
            T const slack = lost_metres / cascades.at[0].texel_metres;
            RC_PRE(slack < T(1));
            RC_ASSERT(laws::serves(cascades, options, world, depth, T(options.filter_radius), slack));
        }
    }));
}

TYPED_TEST(CascadesProperty, EveryMapObeysTheLaw) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        ViewVolume<T> const view = drawn_view<T>(T(100));
        Light<T> const light = *sun<T>();
        CascadeOptions<T> options = drawn_options<T>();
        options.fit = static_cast<CascadeFit>(*below(5));
        options.steady_maps = static_cast<int>(*below(3));
        Aabb<T> const casters = *box<T>(T(100));
        Aabb<T> const receivers = *box<T>(T(100));
        auto const cascades = fit_cascades(view, light, casters, receivers, options);
        for (auto const& c : cascades)
            if (c.map.visible) RC_ASSERT(laws::is_map_of(c.map.clip_from_world, light, options.clip, 64));
    }));
}

TYPED_TEST(CascadesProperty, StableMapsKeepEveryPointInItsPlaceUnderAnyCameraMotion) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        ViewVolume<T> view = drawn_view<T>(sizeof(T) == 4 ? T(10) : T(1e6));
        Light<T> const light = *sun<T>();
        CascadeOptions<T> options = drawn_options<T>();
        options.fit = CascadeFit::stable;
        Aabb<T> const everything{Vec3<T>(T(-1e9)), Vec3<T>(T(1e9))};
        auto const before = fit_cascades(view, light, everything, everything, options);
        Vec3<T> const step = *point_within<T>(T(1));
        Vec3<T> const forward = *direction<T>();
        view.pose = pose_looking(view.pose.position + step, forward, view.pose.up);
        auto const after = fit_cascades(view, light, everything, everything, options);
        RC_PRE(!before.faults.has(Fault::precision_lost) && !after.faults.has(Fault::precision_lost));
        RC_ASSERT(before.count == after.count);
        Vec3<T> const witness = point_at(view, view.left, view.top, view.z_near);
        for (int i = 0; i < before.count; ++i) {
            RC_ASSERT(before.at[i].texel_metres == after.at[i].texel_metres);
            RC_ASSERT(laws::keeps_its_place(before.at[i].map.clip_from_world, after.at[i].map.clip_from_world,
                                            options.map_size, witness, 1.0L / 64));
        }
    }));
}

TYPED_TEST(CascadesProperty, EachFitCoversNoMoreGroundThanTheOneBeforeIt) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        ViewVolume<T> const view = drawn_view<T>(T(100));
        Light<T> const light = *sun<T>();
        CascadeOptions<T> options = drawn_options<T>();
        Aabb<T> const world = *box<T>(T(200));
        std::array<long double, max_splits> before;
        before.fill(std::numeric_limits<long double>::max());
        for (CascadeFit const cascade_fit : {CascadeFit::tight, CascadeFit::rectangle, CascadeFit::focus}) {
            options.fit = cascade_fit;
            auto const cascades = fit_cascades(view, light, world, world, options);
            for (int i = 0; i < cascades.count; ++i) {
                if (!cascades.at[i].map.visible) continue;
                long double const covered = laws::square_metres(cascades.at[i].map);
                // Clipped bodies carry sixteen roundings a vertex, and thin ones are widened to a texel of their
                // length.
                T const lost = tolerance(glm::length(view.pose.position) + view.z_far, 64) * T(options.map_size) /
                               cascades.at[i].texel_metres / T(options.map_size);
                long double const slack =
                    cascade_fit == CascadeFit::focus ? 1 + 1e-3L + static_cast<long double>(lost) : 1 + 1e-5L;
                RC_ASSERT(covered <= before[static_cast<std::size_t>(i)] * slack);
                before[static_cast<std::size_t>(i)] = covered;
            }
        }
    }));
}

TYPED_TEST(CascadesProperty, TheSamePointHasTheSamePlaceInEveryClipSpace) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        ViewVolume<T> const view = drawn_view<T>(T(100));
        Light<T> const light = *sun<T>();
        CascadeOptions<T> options = drawn_options<T>();
        Aabb<T> const everything{Vec3<T>(T(-1e6)), Vec3<T>(T(1e6))};
        auto const there = fit_cascades(view, light, everything, everything, options);
        ClipSpace const clip = options.clip;
        options.clip = ClipSpace{};
        auto const here = fit_cascades(view, light, everything, everything, options);
        for (int i = 0; i < here.count; ++i) {
            // The rows differ by the convention alone: one rounding more, of the row's own length.
            Mat4<T> const back = canonical_from_clip<T>(clip) * there.at[i].map.clip_from_world;
            for (int r = 0; r < 4; ++r) {
                Vec4<T> const difference = row(back, r) - row(here.at[i].map.clip_from_world, r);
                T const scale = T(1) + glm::length(row(here.at[i].map.clip_from_world, r));
                RC_ASSERT(glm::length(difference) <= tolerance(scale, 4));
            }
        }
    }));
}

TYPED_TEST(CascadesProperty, NoInputMakesANaNAnAllocationOrATrap) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        ViewVolume<T> const view = *nasty_view_volume<T>();
        Vec3<T> const travel = *nasty_vec3<T>();
        Vec3<T> const position = *nasty_vec3<T>();
        T const angle = *nasty<T>();
        T const range = *nasty<T>();
        Light<T> const light = *below(2) == 0 ? directional(travel) : spot(position, travel, angle, range);
        Aabb<T> const casters = *nasty_box<T>();
        Aabb<T> const receivers = *nasty_box<T>();
        CascadeOptions<T> options = drawn_options<T>();
        options.fit = static_cast<CascadeFit>(*below(5));
        options.warp_strength = *nasty<T>();
        options.lambda = *nasty<T>();
        options.blend = *nasty<T>();
        options.shadow_distance = *nasty<T>();
        options.first_split_end = *nasty<T>();
        options.map_size = static_cast<int>(*below(200)) - 20;
        options.count = static_cast<int>(*below(40)) - 5;
        auto const run = watched([&] { return fit_cascades(view, light, casters, receivers, options); });
        RC_ASSERT(run.allocations == 0u);
        for (auto const& c : run.result) RC_ASSERT(laws::harmless(c.map));
    }));
}

}  // namespace
