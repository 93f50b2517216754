// SPDX-License-Identifier: MIT
#include "tests/laws/sampling.hpp"
#include "tests/support/any_map.hpp"

#include <shadowmath/splits.hpp>

#include <gtest/gtest.h>

#include <vector>

using namespace shadowmath;
using namespace shadowmath::test;

namespace {

template <class T>
class SamplingProperty : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(SamplingProperty, Scalars);

template <class T>
rc::Gen<std::vector<SliceRange<T>>> ranges() {
    return rc::gen::exec([] {
        auto const count = static_cast<int>(1 + *below(6));
        T const lambda = *uniform<T>(T(0), T(1));
        T const blend = *uniform<T>(T(0), T(1));
        Splits<T> const splits = practical_splits(T(0.5), T(200), count, lambda);
        std::vector<SliceRange<T>> drawn;
        for (int i = 0; i < splits.count; ++i) drawn.push_back(slice_range(splits, i, blend));
        return drawn;
    });
}

}  // namespace

namespace shadowmath {
inline namespace v0 {
template <class T>
void showValue(SliceRange<T> const& range, std::ostream& out) {
    out << range.begin << " .. " << range.blend_begin << " .. " << range.end;
}
}  // namespace v0
}  // namespace shadowmath

TYPED_TEST(SamplingProperty, AnyEyeDepthGivesALookUpAmongTheMaps) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        auto const slices = *ranges<T>();
        auto const count = static_cast<int>(slices.size());
        T const eye_depth = *nasty<T>();
        RC_ASSERT(laws::is_look_up(by_depth(slices.data(), count, eye_depth), count));
    }));
}

TYPED_TEST(SamplingProperty, EveryDepthOfTheViewHasAMapAndNoneComesBack) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        auto const slices = *ranges<T>();
        auto const count = static_cast<int>(slices.size());
        T const a = *uniform<T>(T(0.5), T(199.9));
        T const b = *uniform<T>(a, T(199.9));
        auto const near_one = by_depth(slices.data(), count, a), far_one = by_depth(slices.data(), count, b);
        RC_ASSERT(near_one.first >= 0);
        RC_ASSERT(far_one.first >= near_one.first);
        RC_ASSERT(by_depth(slices.data(), count, T(200)).first == -1);
    }));
}

// The slice before a band's map starts where the band starts, so neither map is asked for what it was not fitted to.
TYPED_TEST(SamplingProperty, BothMapsOfABandServeThatDepth) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        auto const slices = *ranges<T>();
        auto const count = static_cast<int>(slices.size());
        T const depth = *uniform<T>(T(0.5), T(199.9));
        auto const found = by_depth(slices.data(), count, depth);
        T const slack = T(8) * std::numeric_limits<T>::epsilon() * T(200);
        for (int index : {found.first, found.second})
            if (index >= 0) {
                auto const& slice = slices[static_cast<std::size_t>(index)];
                RC_ASSERT(depth >= slice.begin - slack && depth < slice.end);
            }
    }));
}

// Weights change no faster than one over the narrowest band; hard seams (no band) are left out.
TEST(SamplingByDepth, FadesWithoutAStep) {
    EXPECT_TRUE(rc::check([] {
        auto slices = *ranges<double>();
        auto const count = static_cast<int>(slices.size());
        double narrowest = 1;
        for (auto const& slice : slices)
            if (slice.end > slice.blend_begin) narrowest = std::min(narrowest, slice.end - slice.blend_begin);
        auto const a = *uniform<double>(0.5, 199.0);
        double const step = 1e-6 * narrowest;
        for (auto const& slice : slices) RC_PRE(slice.end > slice.blend_begin || &slice == &slices.back());
        auto const here = by_depth(slices.data(), count, a), there = by_depth(slices.data(), count, a + step);
        for (int i = -1; i < count; ++i)
            RC_ASSERT(std::abs(laws::weight_of(here, i) - laws::weight_of(there, i)) <= 1.1e-6);
    }));
}

TYPED_TEST(SamplingProperty, AMapThatContainsAPointHasEveryTexelThatTheKernelTouches) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        auto const any = *any_map<T>();
        T const u = *uniform<T>(T(-0.2), T(1.2));
        T const v = *uniform<T>(T(-0.2), T(1.2));
        Vec3<T> const point = point_at_texture(any.map, Vec3<T>(u, v, T(0.5)));
        auto const radius = static_cast<int>(*below(4));
        if (contains(any.map, 64, static_cast<T>(radius + 1), point))
            RC_ASSERT(laws::kernel_fits(any.map, 64, radius, point));
    }));
}

TEST(SamplingByMap, ContainsExactlyWhatLiesInsideTheMarginAndBeforeTheFarEnd) {
    EXPECT_TRUE(rc::check([] {
        auto any = *any_map<double>();
        auto const u = *uniform<double>(-0.2, 1.2);
        auto const v = *uniform<double>(-0.2, 1.2);
        auto const depth = *uniform<double>(-0.05, 1.05);
        auto const margin = static_cast<double>(*below(8));
        bool const far_is_zero = any.map.clip.depth == DepthOrder::one_to_zero;
        double const beyond = far_is_zero ? -depth : depth - 1;
        double const inset = std::min(std::min(u, 1 - u), std::min(v, 1 - v)) * 64 - margin;
        RC_PRE(std::abs(inset) > 1e-6 && std::abs(beyond) > 1e-6);
        Vec3<double> const point = point_at_texture(any.map, Vec3<double>(u, v, depth));
        RC_PRE(projected(any.map.clip_from_world, point).in_front);
        RC_ASSERT(contains(any.map, 64, margin, point) == (inset > 0 && beyond < 0));
        any.map.visible = false;
        RC_ASSERT(!contains(any.map, 64, margin, point));
    }));
}

TYPED_TEST(SamplingProperty, AnyPointGivesALookUpAmongTheMaps) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        ShadowMap<T> const maps[2] = {*nasty_map<T>(), *nasty_map<T>()};
        Vec3<T> const point = *nasty_vec3<T>();
        T const margin = *nasty<T>();
        auto const size = static_cast<int>(*below(100)) - 1;
        RC_ASSERT(laws::is_look_up(by_map(maps, 2, size, margin, point), 2));
        RC_ASSERT(by_map(maps, 0, size, margin, point).first == -1);
    }));
}
