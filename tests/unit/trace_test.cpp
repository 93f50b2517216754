// SPDX-License-Identifier: MIT
#include "tests/laws/trace.hpp"
#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

using namespace shadowmath;
using namespace shadowmath::test;

namespace {

template <class Lanes>
class Tracing : public ::testing::Test {
protected:
    using Number = typename Lanes::Scalar;
    using Point = Vec3<Number>;
    static constexpr int width = 37, height = 22;  // no multiples of a tile

    // Four metres over the floor y = 0, looking down at 45 degrees.
    ViewVolume<Number> eye = perspective_view<Number>(pose_looking(Point(0, 4, 4), Point(0, -1, -1), Point(0, 1, 0)),
                                                      Number(0.8), Number(37) / Number(22), Number(0.1), Number(100));
    PlanePicture<Number> floor = picture_of_plane(eye, width, height, Point(0, 0, 0), Point(0, 1, 0));
    Light<Number> sun = directional(Point(Number(0.3), Number(-1), Number(0.2)));
    Light<Number> lamp = spot(Point(Number(0.5), 3, Number(0.25)), Point(0, -1, 0), Number(1.2), Number(20));

    [[nodiscard]] ShadowMap<Number> sun_grid() const { return sun_map(sun, Point(0, 0, 0), Number(8)); }
    [[nodiscard]] ShadowMap<Number> lamp_grid() const {
        ShadowMap<Number> map;
        map.clip = gl_zero_to_one_clip;
        Pose<Number> const pose = pose_looking(lamp.position, lamp.direction, Point(0, 0, 1));
        map.clip_from_world =
            clip_from_world(perspective_view<Number>(pose, Number(2.8), Number(1), Number(0.1), Number(30)), map.clip);
        map.visible = true;
        return map;
    }
    [[nodiscard]] std::vector<std::uint32_t> under_sun(std::vector<Triangle<Number>> const& casters,
                                                       int map_size = 16) const {
        Traced const result = traced<Lanes>(floor, casters, sun, sun_grid(), map_size);
        EXPECT_FALSE(result.faults.any()) << describe(result.faults);
        return result.masks;
    }
    static std::vector<Triangle<Number>> quad(Point a, Point b, Point c, Point d) { return {{a, b, c}, {a, c, d}}; }
    static std::vector<Triangle<Number>> roof(Number level, Number half) {
        return quad(Point(-half, level, -half), Point(half, level, -half), Point(half, level, half),
                    Point(-half, level, half));
    }
    static std::size_t dark_samples(std::vector<std::uint32_t> const& masks) {
        std::size_t count = 0;
        for (std::uint32_t mask : masks)
            for (; mask != 0; mask &= mask - 1) ++count;
        return count;
    }
};

using Kinds = ::testing::Types<PlainLanes<float>, PlainLanes<double>, PlainLanes<long double>, BestLanes<float>>;
TYPED_TEST_SUITE(Tracing, Kinds);

}  // namespace

TYPED_TEST(Tracing, AgreesWithASegmentForEachSampleUnderASunAndALamp) {
    using T = typename TypeParam::Scalar;
    using V = Vec3<typename TypeParam::Scalar>;
    std::vector<Triangle<T>> const casters{{V(-1, 1, -1), V(1, T(1.5), -1), V(0, T(0.75), 1)},
                                           {V(T(0.5), T(0.5), T(0.25)), V(T(1.5), 2, T(0.5)), V(T(0.75), 1, T(-1.5))},
                                           {V(-2, 0, 0), V(T(-1.5), 1, 0), V(-1, 0, T(0.5))}};
    auto const masks = this->under_sun(casters);
    EXPECT_TRUE(laws::agrees_with_segments(this->floor, masks, casters, this->sun, this->sun_grid()));
    EXPECT_GT(this->dark_samples(masks), 500u);
    Traced const under_lamp = traced<TypeParam>(this->floor, casters, this->lamp, this->lamp_grid(), 16);
    EXPECT_FALSE(under_lamp.faults.any()) << describe(under_lamp.faults);
    EXPECT_TRUE(laws::agrees_with_segments(this->floor, under_lamp.masks, casters, this->lamp, this->lamp_grid()));
    EXPECT_GT(this->dark_samples(under_lamp.masks), 500u);
    EXPECT_FALSE(laws::agrees_with_segments(this->floor, under_lamp.masks, casters, this->sun, this->sun_grid()))
        << "the law sees nothing";
}

TYPED_TEST(Tracing, AgreesWithSegmentsForAnOrthographicEye) {
    using T = typename TypeParam::Scalar;
    using V = Vec3<typename TypeParam::Scalar>;
    ViewVolume<T> const flat_eye = orthographic_view<T>(pose_looking(V(1, 4, 4), V(T(0.1), -1, -1), V(0, 1, 0)), T(-3),
                                                        T(2), T(-1.5), T(2), T(0.1), T(50));
    PlanePicture<T> const tilted = picture_of_plane(flat_eye, 30, 21, V(0, 0, 0), V(T(0.1), 1, 0));
    std::vector<Triangle<T>> const casters{{V(-1, 1, -1), V(1, T(1.5), -1), V(0, T(0.75), 1)}};
    Traced const result = traced<TypeParam>(tilted, casters, this->sun, this->sun_grid(), 16);
    EXPECT_FALSE(result.faults.any()) << describe(result.faults);
    EXPECT_TRUE(laws::agrees_with_segments(tilted, result.masks, casters, this->sun, this->sun_grid()));
    EXPECT_GT(this->dark_samples(result.masks), 500u);
}

TYPED_TEST(Tracing, FullCoverGivesAllOnes) {
    auto const masks = this->under_sun(this->roof(2, 20));
    EXPECT_TRUE(std::all_of(masks.begin(), masks.end(), [](std::uint32_t mask) { return mask == every_sample; }));
}

// More than a block holds, and more than wait for their tiles at once.
TYPED_TEST(Tracing, FullCoverByThousandsOfTrianglesGivesAllOnes) {
    using T = typename TypeParam::Scalar;
    using V = Vec3<typename TypeParam::Scalar>;
    std::vector<Triangle<T>> mesh;
    for (int z = 0; z < 64; ++z)
        for (int x = 0; x < 64; ++x) {
            auto const at = [](int i, int j) { return V(T(i - 32) / T(4), T(1.5), T(j - 32) / T(4)); };
            for (auto const& triangle : this->quad(at(x, z), at(x + 1, z), at(x + 1, z + 1), at(x, z + 1)))
                mesh.push_back(triangle);
        }
    ASSERT_GT(mesh.size(), std::size_t(this->width * this->height));
    auto const whole =
        this->under_sun(this->quad(V(-8, T(1.5), -8), V(8, T(1.5), -8), V(8, T(1.5), 8), V(-8, T(1.5), 8)));
    ASSERT_EQ(this->dark_samples(whole), std::size_t(32 * this->width * this->height));
    for (int const map_size : {1, 16, 64}) EXPECT_EQ(this->under_sun(mesh, map_size), whole) << map_size;
}

TYPED_TEST(Tracing, NoLightLeaksAlongSharedEdgesOrThroughSharedCorners) {
    using T = typename TypeParam::Scalar;
    using V = Vec3<typename TypeParam::Scalar>;
    // A fan around a point above the middle of the picture.
    std::vector<Triangle<T>> fan;
    V const hub(T(0.123), 1, T(0.077));
    for (int i = 0; i < 23; ++i) {
        auto const rim = [](int k) {
            double const angle = 6.283185307179586 * (k % 23) / 23;
            return V(static_cast<T>(30.0 * std::cos(angle)), T(1), static_cast<T>(30.0 * std::sin(angle)));
        };
        fan.push_back({hub, rim(i), rim(i + 1)});
    }
    for (int map_size : {1, 5, 64}) {
        auto const masks = this->under_sun(fan, map_size);
        EXPECT_TRUE(std::all_of(masks.begin(), masks.end(), [](std::uint32_t mask) { return mask == every_sample; }));
    }
}

TYPED_TEST(Tracing, DoesNotDependOnTheOrderOfTrianglesOnWindingOrOnTheGrid) {
    using T = typename TypeParam::Scalar;
    using V = Vec3<typename TypeParam::Scalar>;
    std::vector<Triangle<T>> casters;
    for (int i = 0; i < 40; ++i) {
        T const x = T(i % 8) / T(2) - T(2), z = T(i / 8) / T(2) - T(1.5), y = T(1) + T(i % 5) / T(4);
        casters.push_back({V(x, y, z), V(x + T(0.7), y + T(0.1), z), V(x, y, z + T(0.4))});
    }
    auto const masks = this->under_sun(casters);
    std::reverse(casters.begin(), casters.end());
    EXPECT_EQ(this->under_sun(casters), masks);
    for (int map_size : {1, 2, 3, 64, 200}) EXPECT_EQ(this->under_sun(casters, map_size), masks) << map_size;
    ShadowMap<T> const elsewhere = sun_map(this->sun, V(3, 0, 1), T(2));  // most of the picture lies beside it
    EXPECT_EQ(traced<TypeParam>(this->floor, casters, this->sun, elsewhere, 32).masks, masks);
    ShadowMap<T> reversed_map = this->sun_grid();
    reversed_map.clip = reversed(d3d_clip);
    reversed_map.clip_from_world = clip_from_canonical<T>(reversed_map.clip) * this->sun_grid().clip_from_world;
    EXPECT_EQ(traced<TypeParam>(this->floor, casters, this->sun, reversed_map, 32).masks, masks);
}

// To the horizon: its last tiles are longer than the map, its first ones a thousandth of it.
TYPED_TEST(Tracing, ATexelFullOfTilesOfAllSizesIsAsGoodAsAFineGrid) {
    using T = typename TypeParam::Scalar;
    using V = Vec3<typename TypeParam::Scalar>;
    ViewVolume<T> const low = perspective_view<T>(pose_looking(V(0, T(1.2), 4), V(0, T(-0.3), -1), V(0, 1, 0)), T(0.8),
                                                  T(1), T(0.1), T(1000));
    PlanePicture<T> const ground = picture_of_plane(low, 96, 96, V(0, 0, 0), V(0, 1, 0));
    std::vector<Triangle<T>> casters;
    for (int i = 0; i < 60; ++i) {
        T const z = T(3) - T(i * i) / T(60), x = T(i % 7) - T(3);
        casters.push_back({V(x, T(0.2), z), V(x + T(1.5), 2, z), V(x, T(0.7), z - 1)});
    }
    auto const masks_on = [&](int map_size) {
        Traced const result = traced<TypeParam>(ground, casters, this->sun, this->sun_grid(), map_size);
        EXPECT_FALSE(result.faults.any()) << describe(result.faults);
        return result.masks;
    };
    auto const masks = masks_on(64);
    EXPECT_GT(this->dark_samples(masks), 1000u);
    for (int const map_size : {1, 2, 4}) EXPECT_EQ(masks_on(map_size), masks) << map_size;
}

TYPED_TEST(Tracing, AddsAndNeverClears) {
    auto const few = this->under_sun(this->roof(1, 1));
    auto both = this->roof(1, 1);
    for (auto const& t : this->roof(2, typename TypeParam::Scalar(0.7))) both.push_back(t);
    EXPECT_TRUE(laws::only_adds(few, this->under_sun(both)));
    EXPECT_FALSE(laws::only_adds(this->under_sun(this->roof(1, 2)), few));
}

TYPED_TEST(Tracing, PartsOfAPictureAddUpToTheWhole) {
    auto const casters = this->roof(1, 1);
    auto const whole = this->under_sun(casters);
    for (PixelRect const rect :
         {PixelRect{0, 0, 17, 9}, PixelRect{17, 9, 20, 13}, PixelRect{5, 3, 1, 1}, PixelRect{30, 20, 0, 0}}) {
        Traced const part = traced<TypeParam>(this->floor, casters, this->sun, this->sun_grid(), 8, rect);
        int const columns = rect.width > 0 ? rect.width : this->width - rect.x;
        for (std::size_t i = 0; i < part.masks.size(); ++i) {
            auto const x = rect.x + static_cast<int>(i) % columns, y = rect.y + static_cast<int>(i) / columns;
            EXPECT_EQ(part.masks[i], whole[static_cast<std::size_t>(y * this->width + x)]);
        }
    }
}

TYPED_TEST(Tracing, ASurfaceDoesNotShadowItselfNorItsNeighboursInThePlane) {
    EXPECT_EQ(this->dark_samples(this->under_sun(this->roof(0, 20))), 0u);
    using T = typename TypeParam::Scalar;
    using V = Vec3<typename TypeParam::Scalar>;
    // A kilometre from the origin, where a float counts in 0.06 mm.
    V const place(1000, 120, -1000);
    ViewVolume<T> far_eye = this->eye;
    far_eye.pose.position += place;
    PlanePicture<T> const far_floor = picture_of_plane(far_eye, this->width, this->height, place, V(0, 1, 0));
    std::vector<Triangle<T>> ground = this->roof(0, 20);
    for (auto& t : ground)
        for (V& p : t) p += place;
    Traced const result = traced<TypeParam>(far_floor, ground, this->sun, sun_map(this->sun, place, T(8)), 32);
    EXPECT_FALSE(result.faults.any()) << describe(result.faults);
    EXPECT_EQ(this->dark_samples(result.masks), 0u);
}

TYPED_TEST(Tracing, DegenerateEdgeOnHugeAndBrokenTrianglesDoNoHarm) {
    using T = typename TypeParam::Scalar;
    using V = Vec3<typename TypeParam::Scalar>;
    T const nan = std::numeric_limits<T>::quiet_NaN(), infinity = std::numeric_limits<T>::infinity();
    V const along = this->sun.direction;
    std::vector<Triangle<T>> const harmless{
        {V(0, 1, 0), V(0, 1, 0), V(0, 1, 0)},     // a point
        {V(0, 1, 0), V(1, 1, 0), V(2, 1, 0)},     // a line
        {V(0, -1, 0), V(5, -2, 0), V(0, -3, 5)},  // behind the receivers
        {V(nan, 1, 0), V(5, 1, 0), V(0, 1, 5)},
        {V(infinity, 1, 0), V(5, 1, 0), V(0, 1, 5)},
        {V(0, 1, 0), V(5, -infinity, 0), V(0, 1, 5)},
        {V(T(1e30), 1, 0), V(5, 1, T(1e30)), V(0, 1, 5)},  // beyond any scene
    };
    EXPECT_EQ(this->dark_samples(this->under_sun(harmless)), 0u);
    // Edge-on: no more than what rounding makes of a line.
    std::vector<Triangle<T>> const edge_on{{V(0, 1, 0), V(0, 1, 0) - along, V(T(0.5), 1, T(0.1))},
                                           {V(0, 1, 0), V(0, 1, 0) - along, V(0, 1, 0) - along * T(2)}};
    EXPECT_TRUE(
        laws::agrees_with_segments(this->floor, this->under_sun(edge_on), edge_on, this->sun, this->sun_grid()));
    T const far = T(1e6);
    std::vector<Triangle<T>> const huge{{V(-far, 2, -far), V(far, 2, -far), V(0, 2, far)}};
    auto const masks = this->under_sun(huge);
    EXPECT_TRUE(std::all_of(masks.begin(), masks.end(), [](std::uint32_t mask) { return mask == every_sample; }));
}

TYPED_TEST(Tracing, BehindALampNothingCastsAndBesideItTheRestDoes) {
    using T = typename TypeParam::Scalar;
    using V = Vec3<typename TypeParam::Scalar>;
    std::vector<Triangle<T>> const behind{{V(-5, 4, -5), V(5, 4, -5), V(0, 4, 5)}};
    Traced const none = traced<TypeParam>(this->floor, behind, this->lamp, this->lamp_grid(), 16);
    EXPECT_EQ(this->dark_samples(none.masks), 0u);
    // From above the lamp down past it.
    std::vector<Triangle<T>> const past{{V(-1, 5, -1), V(T(0.25), T(0.5), -2), V(T(0.25), T(0.5), 2)}};
    Traced const some = traced<TypeParam>(this->floor, past, this->lamp, this->lamp_grid(), 16);
    EXPECT_TRUE(laws::agrees_with_segments(this->floor, some.masks, past, this->lamp, this->lamp_grid()));
    EXPECT_GT(this->dark_samples(some.masks), 100u);
}

TYPED_TEST(Tracing, FacingAwayIsDarkAndSkyIsNot) {
    using V = Vec3<typename TypeParam::Scalar>;
    Light<typename TypeParam::Scalar> const from_below = directional(V(0, 1, 0));
    Traced const result = traced<TypeParam>(this->floor, {}, from_below,
                                            sun_map(from_below, V(0, 0, 0), typename TypeParam::Scalar(8)), 8);
    EXPECT_TRUE(
        std::all_of(result.masks.begin(), result.masks.end(), [](std::uint32_t mask) { return mask == every_sample; }));
    auto sky = this->floor;
    std::fill(sky.depth.begin(), sky.depth.end(), std::numeric_limits<typename TypeParam::Scalar>::infinity());
    EXPECT_EQ(this->dark_samples(traced<TypeParam>(sky, this->roof(2, 20), this->sun, this->sun_grid(), 8).masks), 0u);
}

// Its axis says which side of a surface an orthographic eye sees, not where it stands.
TYPED_TEST(Tracing, AnOrthographicEyeBelowThePlaneSeesTheLitSideOfWhatItLooksDownOn) {
    using T = typename TypeParam::Scalar;
    using V = Vec3<typename TypeParam::Scalar>;
    ViewVolume<T> const view = orthographic_view<T>(pose_looking(V(0, T(-0.5), 4), V(0, T(-0.2), -1), V(0, 1, 0)),
                                                    T(-3), T(3), T(-1), T(3), T(0.1), T(100));
    auto const picture = picture_of_plane(view, 12, 8, V(0, 0, 0), V(0, 1, 0));
    ASSERT_TRUE(std::any_of(picture.depth.begin(), picture.depth.end(), [](T depth) { return depth > T(0); }));
    Traced const lit = traced<TypeParam>(picture, {}, this->sun, this->sun_grid(), 16);
    EXPECT_EQ(this->dark_samples(lit.masks), 0u);
    EXPECT_TRUE(laws::agrees_with_segments(picture, lit.masks, {}, this->sun, this->sun_grid()));
}

TYPED_TEST(Tracing, TakesIndicesAndLeavesOutThoseBeyondTheVertices) {
    using T = typename TypeParam::Scalar;
    using V = Vec3<typename TypeParam::Scalar>;
    std::vector<V> const corners{V(-1, 1, -1), V(1, 1, -1), V(1, 1, 1), V(-1, 1, 1)};
    std::vector<std::uint32_t> const indices{0, 1, 2, 0, 2, 3, 0, 1, 4, 0xffffffffu, 1, 2};
    StorageSize const need = storage_for(this->width, this->height, 8);
    std::vector<T> scalars(need.scalars);
    std::vector<std::uint32_t> words(need.words), masks(this->floor.depth.size());
    Receivers<T> receivers;
    receivers.depth = this->floor.depth.data();
    receivers.normal = this->floor.normals.data();
    IrregularBuffer<T> buffer = list_receivers<T, TypeParam>(this->floor.frame, receivers, this->sun, this->sun_grid(),
                                                             8, {scalars.data(), words.data(), need});
    Casters<T> casters;
    casters.position = &corners[0].x;
    casters.vertex_count = 4;
    casters.index = indices.data();
    casters.triangle_count = 4;
    trace<T, TypeParam>(buffer, casters, 1);
    trace<T, TypeParam>(buffer, casters, 0, 1);
    trace<T, TypeParam>(buffer, casters, 4);
    write_masks(buffer, masks.data());
    EXPECT_EQ(masks, this->under_sun(this->roof(1, 1)));
    EXPECT_EQ(test::watched([&] {
                  trace<T, TypeParam>(buffer, casters);
                  return 0;
              }).allocations,
              0u);
}
