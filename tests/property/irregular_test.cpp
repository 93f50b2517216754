// SPDX-License-Identifier: MIT
#include "tests/laws/mask.hpp"
#include "tests/laws/microquad.hpp"
#include "tests/laws/trace.hpp"
#include "tests/support/gen.hpp"
#include "tests/support/show.hpp"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>

using namespace shadowmath;
using namespace shadowmath::test;

namespace {

// A plane, an eye over it, triangles between it and a light, and a grid for that light.
template <class T>
struct Case {
    PlanePicture<T> picture;
    std::vector<Triangle<T>> casters;
    Light<T> light;
    ShadowMap<T> grid;
    int map_size = 16;
};

template <class T>
ShadowMap<T> lamp_map(Light<T> const& lamp) {
    ShadowMap<T> map;
    map.clip = gl_zero_to_one_clip;
    Pose<T> const pose = pose_looking(lamp.position, lamp.direction, Vec3<T>(T(0.1), T(0.2), T(1)));
    map.clip_from_world = clip_from_world(perspective_view<T>(pose, T(2.9), T(1), T(0.05), T(200)), map.clip);
    map.visible = true;
    return map;
}

template <class T>
rc::Gen<Case<T>> any_case() {
    return rc::gen::exec([] {
        Case<T> drawn;
        auto const size = static_cast<int>(1 + *below(8));
        Vec3<T> const tilt = *point_within<T>(T(0.3));
        Vec3<T> const normal = safe_normalize(Vec3<T>(T(0), T(1), T(0)) + tilt).direction;
        Vec3<T> const aside = *point_within<T>(T(3));
        Vec3<T> const place(aside.x, T(4) + aside.y, aside.z);
        Vec3<T> const target = *point_within<T>(T(2));
        Pose<T> const pose =
            pose_looking(place, Vec3<T>(target.x, T(0), target.z) - place, Vec3<T>(T(0.3), T(0), T(1)));
        bool const flat = *one_in(4);
        ViewVolume<T> eye = perspective_view<T>(pose, *uniform<T>(T(0.1), T(1.6)), T(1.5), T(0.05), T(200));
        if (flat) eye = orthographic_view<T>(pose, T(-3), T(2), T(-2), T(1.5), T(0.05), T(200));
        drawn.picture = picture_of_plane(eye, size + 5, size, Vec3<T>(T(0)), normal);
        bool const sun = !*one_in(3);
        Vec3<T> const lean = *point_within<T>(T(0.8));
        Vec3<T> const travel(lean.x, T(-1), lean.z);
        drawn.light =
            sun ? directional(travel) : spot(Vec3<T>(lean.x, T(6), lean.z), Vec3<T>(T(0), T(-1), T(0)), T(1.4), T(100));
        T const reach = *uniform<T>(T(1), T(12));
        drawn.grid = sun ? sun_map(drawn.light, target, reach) : lamp_map(drawn.light);
        drawn.map_size = static_cast<int>(1 + *below(70));
        auto const count = static_cast<int>(1 + *below(12));
        for (int i = 0; i < count; ++i) {
            T const extent = *log_uniform<T>(T(0.02), T(6));
            Vec3<T> const middle = *point_within<T>(T(3));
            Triangle<T> triangle;
            for (Vec3<T>& p : triangle) {
                Vec3<T> const corner = *point_within<T>(T(1));
                p = Vec3<T>(middle.x, std::abs(middle.y) * T(1.5), middle.z) + corner * extent;
            }
            drawn.casters.push_back(triangle);
        }
        return drawn;
    });
}

template <class T>
void showValue(Case<T> const& drawn, std::ostream& out) {
    out << drawn.picture.frame.width << " x " << drawn.picture.frame.height << ", grid " << drawn.map_size << ", "
        << drawn.casters.size() << " triangles, light "
        << (drawn.light.kind == LightKind::directional ? "sun" : "lamp");
}

template <class Lanes>
std::vector<std::uint32_t> masks_of(Case<typename Lanes::Scalar> const& drawn,
                                    std::vector<Triangle<typename Lanes::Scalar>> const& casters) {
    Traced const result = traced<Lanes>(drawn.picture, casters, drawn.light, drawn.grid, drawn.map_size);
    RC_ASSERT(!result.faults.any());
    return result.masks;
}

template <class Lanes>
class AnyTracing : public ::testing::Test {};
using Kinds = ::testing::Types<PlainLanes<float>, PlainLanes<double>>;
TYPED_TEST_SUITE(AnyTracing, Kinds);

}  // namespace

TYPED_TEST(AnyTracing, AgreesWithASegmentForEachSample) {
    EXPECT_TRUE(rc::check([] {
        using T = typename TypeParam::Scalar;
        Case<T> const drawn = *any_case<T>();
        std::vector<std::uint32_t> const masks = masks_of<TypeParam>(drawn, drawn.casters);
        RC_ASSERT(laws::agrees_with_segments(drawn.picture, masks, drawn.casters, drawn.light, drawn.grid));
    }));
}

TYPED_TEST(AnyTracing, DoesNotDependOnOrderOrGridAndOnlyAdds) {
    EXPECT_TRUE(rc::check([] {
        using T = typename TypeParam::Scalar;
        Case<T> drawn = *any_case<T>();
        std::vector<std::uint32_t> const masks = masks_of<TypeParam>(drawn, drawn.casters);
        std::vector<Triangle<T>> reversed_order(drawn.casters.rbegin(), drawn.casters.rend());
        RC_ASSERT(masks_of<TypeParam>(drawn, reversed_order) == masks);
        auto const fewer = static_cast<std::ptrdiff_t>(*below(drawn.casters.size() + 1));
        std::vector<Triangle<T>> const some(drawn.casters.begin(), drawn.casters.begin() + fewer);
        RC_ASSERT(laws::only_adds(masks_of<TypeParam>(drawn, some), masks));
        drawn.map_size = static_cast<int>(1 + *below(200));
        Vec3<T> const elsewhere = *point_within<T>(T(3));
        T const half = *log_uniform<T>(T(0.2), T(100));
        if (drawn.light.kind == LightKind::directional) drawn.grid = sun_map(drawn.light, elsewhere, half);
        RC_ASSERT(masks_of<TypeParam>(drawn, drawn.casters) == masks);
    }));
}

TYPED_TEST(AnyTracing, SplittingATriangleChangesNothingOffItsEdges) {
    EXPECT_TRUE(rc::check([] {
        using T = typename TypeParam::Scalar;
        Case<T> const drawn = *any_case<T>();
        std::vector<Triangle<T>> halves;
        for (Triangle<T> const& t : drawn.casters) {
            Vec3<T> const middle = (t[0] + t[1]) * T(0.5);
            halves.push_back({t[0], middle, t[2]});
            halves.push_back({middle, t[1], t[2]});
        }
        // The halves against the whole triangles' segments.
        RC_ASSERT(laws::agrees_with_segments(drawn.picture, masks_of<TypeParam>(drawn, halves), drawn.casters,
                                             drawn.light, drawn.grid));
    }));
}

TYPED_TEST(AnyTracing, OfAnythingAtAllWritesEveryMaskAndNothingElse) {
    EXPECT_TRUE(rc::check([] {
        using T = typename TypeParam::Scalar;
        Case<T> drawn = *any_case<T>();
        for (T& depth : drawn.picture.depth)
            if (*one_in(6)) depth = *nasty<T>();
        for (T& normal : drawn.picture.normals)
            if (*one_in(12)) normal = *nasty<T>();
        for (Triangle<T>& triangle : drawn.casters)
            if (*one_in(2)) triangle[*below(3)] = *nasty_vec3<T>();
        bool const bad_map = *one_in(4);
        if (bad_map) drawn.grid.clip_from_world[static_cast<int>(*below(4))][static_cast<int>(*below(4))] = *nasty<T>();
        bool const bad_light = *one_in(4);
        if (bad_light) drawn.light.direction = *nasty_vec3<T>();
        Traced const result = traced<TypeParam>(drawn.picture, drawn.casters, drawn.light, drawn.grid, drawn.map_size);
        for (std::size_t i = 0; i < result.masks.size(); ++i)
            RC_ASSERT(drawn.picture.depth[i] > T(0) || drawn.picture.frame.kind == ViewKind::orthographic ||
                      result.masks[i] == 0u);
    }));
}

TEST(MaskProperty, TableAndExactDifferOnlyNearTheLine) {
    HalfPlaneTable const table = half_plane_table();
    EXPECT_TRUE(rc::check([&table] {
        Vec3<double> const drawn = *point_within<double>(1.0);
        double const scale = *log_uniform<double>(1e-6, 1e6);
        PixelLine<double> const line{drawn.z * scale, drawn.x * scale, drawn.y * scale};
        RC_ASSERT(laws::differ_only_near(line, half_plane_mask(table, line), half_plane_mask<PlainLanes<double>>(line),
                                         table_displacement));
        PixelLine<double> const other{-line.c, -line.x, -line.y};
        RC_ASSERT((half_plane_mask<PlainLanes<double>>(line) | half_plane_mask<PlainLanes<double>>(other)) ==
                  every_sample);
    }));
}
