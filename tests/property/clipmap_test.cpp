// SPDX-License-Identifier: MIT
#include "tests/laws/clipmap.hpp"
#include "tests/support/gen.hpp"
#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

namespace {

template <class T>
class ClipmapProperty : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(ClipmapProperty, Scalars);

TYPED_TEST(ClipmapProperty, NestsAndNamesPagesWithoutTheCamera) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        auto const basis = light_basis((*sun<T>()).direction);
        Vec3<T> const center = *point_within<T>(world_radius<T>);
        Vec3<T> const elsewhere = *point_within<T>(world_radius<T>);
        Vec3<T> const point = center + *point_within<T>(T(40));
        ClipmapOptions<T> options;
        options.page_texels = static_cast<int>(1 + *below(128));
        options.map_size = options.page_texels * static_cast<int>(4 + *below(40));
        Clipmap<T> const map = clipmap(basis, center, options), other = clipmap(basis, elsewhere, options);
        RC_ASSERT(laws::nests(map));
        for (int level = 0; level < map.count; ++level) {
            Page const page = page_at(map, level, point);
            RC_ASSERT(page == page_at(other, level, point));
            if (level + 1 < map.count) RC_ASSERT(laws::is_quarter_of(page, page_at(map, level + 1, point)));
        }
    }));
}

TYPED_TEST(ClipmapProperty, TakesTheTexelThatFitsThePixelAndCoarserOnesFartherOff) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        auto const basis = light_basis((*sun<T>()).direction);
        Vec3<T> const center = *point_within<T>(T(100));
        Vec3<T> const way = *point_within<T>(T(300));
        T const share = *uniform<T>(T(0), T(1));
        T const pixel = *log_uniform<T>(T(1e-4), T(100));
        Clipmap<T> const map = clipmap(basis, center, ClipmapOptions<T>{});
        RC_ASSERT(laws::fits_the_pixel(map, center + way, pixel));
        // Pixels grow with distance from the eye. A page's own width may count for one level.
        int const nearer = page_for(map, center + way * share, pixel * share).level;
        int const farther = page_for(map, center + way, pixel).level;
        if (nearer >= 0 && farther >= 0) RC_ASSERT(nearer <= farther);
    }));
}

TYPED_TEST(ClipmapProperty, IsCalmForAnyInput) {
    EXPECT_TRUE(rc::check([] {
        using T = TypeParam;
        Vec3<T> const travel = *nasty_vec3<T>();
        Vec3<T> const center = *nasty_vec3<T>();
        Vec3<T> const point = *nasty_vec3<T>();
        T const pixel = *nasty<T>();
        ClipmapOptions<T> options;
        options.finest_metres = *nasty<T>();
        options.levels = static_cast<int>(*below(40)) - 5;
        options.page_texels = static_cast<int>(*below(200)) - 20;
        auto const page = watched([&] {
            return page_for(clipmap(light_basis(safe_normalize(travel).direction), center, options), point, pixel);
        });
        RC_ASSERT(page.allocations == 0u);
    }));
}

}  // namespace
