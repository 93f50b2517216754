// SPDX-License-Identifier: MIT
#include "tests/support/seen_boxes.hpp"

#include <shadowmath/map_rows.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace shadowmath;

namespace {

using V3 = Vec3<double>;
using V4 = Vec4<double>;
using Real = long double;
using R3 = Vec3<Real>;
using R4 = Vec4<Real>;

Real at(R4 const& row, R3 const& p) {
    return glm::dot(R3(row), p) + row.w;
}

struct Extents {
    Real lo = 1e30L, hi = -1e30L;
    void add(Real value) { lo = std::min(lo, value), hi = std::max(hi, value); }
};

struct MapsFromRows : ::testing::Test {
    test::SeenBoxes<double> some;
    MapRows<double> rows;
    V3 eye{0};
    Aabb<double> receivers;  // relative to the eye, as all but the casters
    Aabb<double> casters;
    int map_size = 1024;
    double margin = 2;
    ClipSpace clip = vulkan_clip;

    ShadowMap<double> made() const {
        return map_from_rows(rows, eye, convex_body(receivers), casters, map_size, margin, clip);
    }

    // A sun along some axes, w = 1 at the near end.
    void draw_sun() {
        LightBasis<double> const basis = some.light();
        V3 const centre = some.point(30);
        V3 const half(some.from_to(1, 10), some.from_to(1, 10), some.from_to(1, 10));
        receivers = {centre - half, centre + half};
        Extents y;
        for (V3 const& p : corners(receivers)) y.add(glm::dot(p, basis.y));
        double const slope = some.from_to(0, 0.2), near_end = double(y.lo);
        rows = {};
        rows.x = V4(basis.x, 0);
        rows.y = V4(basis.y, -near_end);
        rows.w = V4(basis.y * slope, 1 - near_end * slope);
        rows.along = V4(basis.depth, some.from_to(-3, 3));
        rows.source = V4(basis.depth, 0);
        rows.w_min = 0.5;
        draw_rest(-basis.depth);
    }
    // A lamp that shines on all of it.
    void draw_lamp(double nearest = 30, double farthest = 60) {
        LightBasis<double> const basis = some.light();
        V3 const centre = some.point(30);
        V3 const half(some.from_to(1, 10), some.from_to(1, 10), some.from_to(1, 10));
        receivers = {centre - half, centre + half};
        V3 const lamp = centre - basis.depth * some.from_to(nearest, farthest);
        rows = {};
        rows.parallel = false;
        rows.x = V4(basis.x, -glm::dot(basis.x, lamp));
        rows.y = V4(basis.y, -glm::dot(basis.y, lamp));
        rows.w = V4(basis.depth, -glm::dot(basis.depth, lamp));
        double const share = some.from_to(0, 0.01);
        rows.along = rows.w * share - V4(0, 0, 0, 1);
        rows.source = V4(-lamp, -1);
        rows.along_floor = share - 1;  // one metre before the lamp
        rows.w_min = 0.5;
        draw_rest(-basis.depth);
    }
    void draw_rest(V3 const& to_light) {
        eye = some.point(100);
        casters = merge(receivers, Aabb<double>{receivers.lo + to_light * 20.0, receivers.hi + to_light * 20.0});
        casters = {casters.lo + eye, casters.hi + eye};
        margin = some.from_to(0, 8);
        map_size = 512;
    }

    R4 canonical_row(ShadowMap<double> const& map, int r) const {
        Mat4<Real> const world = canonical_from_clip<Real>(map.clip) * Mat4<Real>(map.clip_from_world);
        R4 found(row(world, r));
        found.w += glm::dot(R3(found), R3(eye));
        return found;
    }
    Real close = 1e-9L;
    void expect_row(R4 const& found, R4 const& wanted) const {
        EXPECT_LT(glm::length(found - wanted), close * glm::length(wanted));
    }

    // Of the map in long double, by the words of the header. False where there is none.
    void expect_made() const {
        ShadowMap<double> const map = made();
        ASSERT_TRUE(map.visible);
        EXPECT_EQ(map.faults.bits, 0u);
        EXPECT_EQ(map.w_min, rows.w_min);
        Extents x, y, w, along;
        Real radius = 0;
        for (V3 const& corner : corners(receivers)) {
            R3 const p(corner);
            Real const w_of_p = at(R4(rows.w), p);
            x.add(at(R4(rows.x), p) / w_of_p), y.add(at(R4(rows.y), p) / w_of_p);
            w.add(w_of_p), along.add(at(R4(rows.along), p));
            radius = std::max(radius, glm::length(p));
        }
        if (!rows.crop) x.lo = y.lo = -1, x.hi = y.hi = 1;
        Real const free = margin > 0 ? margin / Real(map_size) : 0;
        auto const filled = [&](R4 const& of, Extents const& sides) {
            Real const scale = 2 * (1 - 2 * free) / (sides.hi - sides.lo);
            return (of - R4(rows.w) * ((sides.hi + sides.lo) / 2)) * scale;
        };
        R4 const x_row = filled(R4(rows.x), x), y_row = filled(R4(rows.y), y);
        expect_row(canonical_row(map, 0), x_row);
        expect_row(canonical_row(map, 1), y_row);
        expect_row(canonical_row(map, 3), R4(rows.w));

        Real const last = along.hi + 1e-3L * (along.hi - along.lo);
        Real const reach = 1024 * radius + (rows.parallel ? 0 : 2 * glm::length(R3(rows.source)));
        Aabb<Real> const box =
            intersect(Aabb<Real>{R3(casters.lo) - R3(eye), R3(casters.hi) - R3(eye)}, {R3(-reach), R3(reach)});
        ConvexBody<Real> shaft = convex_body(box);
        for (R4 const& side :
             {R4(rows.w) - x_row, R4(rows.w) + x_row, R4(rows.w) - y_row, R4(rows.w) + y_row,
              R4(0, 0, 0, last) - R4(rows.along), rows.parallel ? R4(rows.w) - R4(0, 0, 0, rows.w_min) : R4(rows.w)})
            shaft = clipped(shaft, side);
        if (!rows.parallel) shaft = clipped(shaft, R4(rows.along) - R4(0, 0, 0, rows.along_floor));
        for_each_vertex(shaft, [&](R3 const& p) { along.lo = std::min(along.lo, at(R4(rows.along), p)); });
        Real const room = (along.hi - along.lo) / 1024;
        Real const first = std::max(along.lo - room, Real(rows.along_floor)), end = along.hi + room;
        R4 const z = canonical_row(map, 2);
        if (clip.depth == DepthOrder::one_to_zero && rows.parallel) {
            // 1 - depth = k (last - along) / w
            Real const k = w.lo / (end - first);
            expect_row(z, R4(rows.w) - (R4(0, 0, 0, end) - R4(rows.along)) * k);
        } else {
            Real deepest = 0;
            for (V3 const& corner : corners(receivers))
                deepest =
                    std::max(deepest, (at(R4(rows.along), R3(corner)) + room - first) / at(R4(rows.w), R3(corner)));
            expect_row(z, (R4(rows.along) - R4(0, 0, 0, first)) / deepest);
        }
    }
};

}  // namespace

TEST_F(MapsFromRows, OfASunAreFilledByReceiversAndBeginAtTheFirstCaster) {
    for (ClipSpace const& each : {gl_clip, vulkan_clip, d3d_clip, reversed(d3d_clip), reversed(vulkan_clip)})
        for (int i = 0; i < 12; ++i) {
            clip = each;
            draw_sun();
            expect_made();
        }
}

TEST_F(MapsFromRows, OfALampAreFilledByReceiversAndBeginAtTheFirstCaster) {
    for (ClipSpace const& each : {gl_clip, vulkan_clip, reversed(d3d_clip)})
        for (int i = 0; i < 12; ++i) {
            clip = each;
            draw_lamp();
            expect_made();
        }
}

TEST_F(MapsFromRows, WithoutACropAreThoseOfTheRows) {
    for (int i = 0; i < 12; ++i) {
        draw_lamp();
        rows.crop = false;
        expect_made();
    }
}

TEST_F(MapsFromRows, AreWithoutAMarginWhereThatIsLessThanNothing) {
    draw_sun();
    margin = -3;
    expect_made();
}

TEST_F(MapsFromRows, HoldCastersOfASunUpTo1024TimesAsFarAsReceivers) {
    for (int i = 0; i < 12; ++i) {
        draw_sun();
        V3 const up = V3(rows.source) * -1e6;
        casters = merge(casters, Aabb<double>{casters.lo + up, casters.hi + up});
        expect_made();
    }
}

TEST_F(MapsFromRows, HoldCastersUpToALamp) {
    for (int i = 0; i < 12; ++i) {
        draw_lamp();
        casters = {casters.lo - V3(200), casters.hi + V3(200)};
        expect_made();
    }
}

TEST_F(MapsFromRows, HoldCastersUpToALampFarAway) {
    close = 1e-6L;
    for (int i = 0; i < 12; ++i) {
        draw_lamp(1e5, 2e5);
        casters = {V3(-4e5), V3(4e5)};
        expect_made();
    }
}

// Of one ray of light, up to where it is rounded most.
TEST(MapsOfOneRay, HoldACasterFarAboveOnePoint) {
    test::SeenBoxes<float> some;
    using F3 = Vec3<float>;
    using F4 = Vec4<float>;
    for (int i = 0; i < 100; ++i) {
        LightBasis<float> const basis = some.light();
        F3 const point = some.point(3), far_above = point - basis.depth * (some.from_to(300, 900) * glm::length(point));
        MapRows<float> rows;
        rows.x = F4(basis.x, 0), rows.y = F4(basis.y, -glm::dot(basis.y, point));
        rows.w = F4(0, 0, 0, 1);
        rows.along = rows.source = F4(basis.depth, 0);
        rows.w_min = 0.5f;
        Aabb<float> const receivers{point, point};
        ShadowMap<float> const map =
            map_from_rows(rows, F3(0), convex_body(receivers), merge(receivers, far_above), 1024, 2.0f, vulkan_clip);
        ASSERT_TRUE(map.visible);
        float const last = glm::dot(basis.depth, point), first = glm::dot(basis.depth, far_above);
        EXPECT_NEAR((map.clip_from_world * F4(far_above, 1)).z, 1.0f / 1024, 1e-4f) << last - first;
        EXPECT_NEAR((map.clip_from_world * F4(point, 1)).z, 1023.0f / 1024, 2e-3f) << last - first;
    }
}

TEST_F(MapsFromRows, HoldNoCasterThatIsNotInFrontOfThem) {
    rows.x = V4(1, 0, 0, 0), rows.y = V4(0, 0, 1, 0), rows.w = V4(0, 0, 3, 1);
    rows.along = rows.source = V4(0, -1, 0, 0);
    rows.w_min = 0.5;
    rows.crop = false;
    receivers = {V3(-0.1, -1, 0), V3(0.1, 0, 0.3)};
    casters = {V3(-0.1, 1, -0.15), V3(0.1, 2, -0.1)};  // w from 0.55 on
    EXPECT_TRUE(made().visible);
    casters = {V3(-0.1, 1, -0.24), V3(0.1, 2, -0.17)};  // w from 0.28 to 0.49
    EXPECT_FALSE(made().visible);
}

TEST_F(MapsFromRows, OfAFloorHaveADepthForIt) {
    for (ClipSpace const& each : {gl_clip, vulkan_clip, reversed(d3d_clip)})
        for (double const offset : {0.0, 1e4}) {
            clip = each;
            rows.x = V4(1, 0, 0, 0), rows.y = V4(0, 0, 1, 0), rows.w = V4(0, 0, 0, 1);
            rows.along = V4(0, -1, 0, offset), rows.source = V4(0, -1, 0, 0);
            rows.w_min = 0.5;
            eye = V3(3, 7, 0.1);
            receivers = {V3(-4, -2, -4), V3(4, -2, 4)};
            casters = {receivers.lo + eye, receivers.hi + eye};
            ShadowMap<double> const map = made();
            ASSERT_TRUE(map.visible) << "a receiver is a caster too";
            R4 const z = canonical_row(map, 2);
            EXPECT_GT(at(z, R3(receivers.lo)), 0);
            EXPECT_LT(at(z, R3(receivers.lo)), 1);
            EXPECT_GT(glm::dot(z, R4(rows.source)), 0);
        }
}

TEST_F(MapsFromRows, HoldTheFloorOfARoomAlone) {
    rows.x = V4(1, 0, 0, 0), rows.y = V4(0, 0, 1, 0), rows.w = V4(0, 0, 0, 1);
    rows.along = rows.source = V4(0, -1, 0, 0);
    rows.w_min = 0.5;
    receivers = {V3(-4, -2, -4), V3(4, 10, 4)};
    casters = {V3(-4, -2, -4), V3(4, -2, 4)};
    EXPECT_TRUE(made().visible);
}

TEST_F(MapsFromRows, OfAPointAreSeenFromAnywhere) {
    for (int i = 0; i < 100; ++i) {
        draw_sun();
        eye = some.point(1e5);
        receivers.lo = receivers.hi = some.point(2e3);
        rows.w = V4(0, 0, 0, 1);
        rows.along.w = 0;
        casters = {receivers.lo + eye, receivers.hi + eye};
        EXPECT_TRUE(made().visible) << i;
    }
}

TEST_F(MapsFromRows, ObeyTheLawToTheLastBitsThoughTheRowsDoNot) {
    for (int i = 0; i < 12; ++i) {
        draw_sun();
        V4 const off = rows.along * 1e-7;
        rows.x += off, rows.y -= off;
        ShadowMap<double> const map = made();
        ASSERT_TRUE(map.visible);
        for (int r = 0; r < 2; ++r) {
            R4 const of(row(map.clip_from_world, r));
            EXPECT_LT(std::abs(glm::dot(of, R4(rows.source))), 1e-14L * glm::length(of));
        }
    }
}

TEST_F(MapsFromRows, WithoutReceiversOrWithoutCastersAboveThemAreNotVisible) {
    draw_sun();
    EXPECT_TRUE(made().visible);
    ShadowMap<double> const none = map_from_rows(rows, eye, ConvexBody<double>{}, casters, map_size, margin, clip);
    EXPECT_FALSE(none.visible);
    EXPECT_EQ(none.faults.bits, 0u);
    EXPECT_EQ(none.clip.depth, clip.depth);
    Aabb<double> const was = casters;
    V3 const down = V3(rows.source) * 200.0;
    V3 const aside = V3(rows.x) * 200.0, ahead = V3(rows.y) * 400.0;
    for (V3 const& by : {down, aside, -aside, ahead, -ahead}) {
        casters = {was.lo + by, was.hi + by};
        EXPECT_FALSE(made().visible);
        EXPECT_EQ(made().faults.bits, 0u);
        EXPECT_EQ(made().clip_from_world, nowhere<double>());
    }
    casters = {};
    EXPECT_FALSE(made().visible);
}

TEST_F(MapsFromRows, OfAPointAreAsWideAsTheyMustBe) {
    draw_sun();
    receivers.hi = receivers.lo;
    rows.w = V4(0, 0, 0, 4);
    rows.least_width = 0.25;
    ShadowMap<double> const map = made();
    ASSERT_TRUE(map.visible);
    double const free = 2 * margin / map_size;
    for (int r = 0; r < 2; ++r) EXPECT_NEAR(double(glm::length(R3(canonical_row(map, r)))), 8 * (1 - free), 1e-9);
    // As wide as rounding may be, of a place and of the eye's.
    rows.least_width = 0;
    rows.x *= 30;
    for (double const far_out : {0.0, 1e6}) {
        V3 const moved = V3(far_out, -far_out, far_out) - eye;
        eye += moved;
        casters = {casters.lo + moved, casters.hi + moved};
        ShadowMap<double> const narrow = made();
        ASSERT_TRUE(narrow.visible);
        double const place = glm::length(receivers.lo) + glm::length(eye);
        double const unit = 30.0 / 4 * std::numeric_limits<double>::epsilon() * place;
        double const width = 2 / double(glm::length(R3(canonical_row(narrow, 1)))) * (1 - free);
        EXPECT_GT(width, 32 * unit) << far_out;
        EXPECT_LT(width, 128 * unit) << far_out;
    }
}

// The last bit of the eye's place, in texels.
TEST_F(MapsFromRows, SayWhereTheLastBitOfAPlaceIsMoreThanATexel) {
    for (int i = 0; i < 12; ++i) {
        draw_sun();
        rows.x *= 4, rows.y *= 4, rows.w *= 4;
        Aabb<double> const relative{casters.lo - eye, casters.hi - eye};
        ShadowMap<double> const map = made();
        double const across = double(glm::length(R3(canonical_row(map, 0))));
        double const along = double(glm::length(R3(canonical_row(map, 1))));
        double const limit = 4 / (std::numeric_limits<double>::epsilon() * std::max(across, along) * map_size);
        for (double const share : {0.5, 0.95, 1.05, 1.5}) {
            eye = V3(0, share * limit, 0);
            casters = {relative.lo + eye, relative.hi + eye};
            ShadowMap<double> const far_out = made();
            EXPECT_TRUE(far_out.visible);
            EXPECT_EQ(far_out.faults.has(Fault::precision_lost), share > 1) << share;
        }
    }
}

// A depth of nearly nothing, so far out that the matrix has no number for it.
TEST_F(MapsFromRows, ThatAreNoNumbersAreNone) {
    rows.x = V4(1, 0, 0, 0), rows.y = V4(0, 0, 1, 0), rows.w = V4(0, 0, 0, 1);
    rows.along = rows.source = V4(0, -1, 0, 0);
    rows.w_min = 0.5;
    receivers = {V3(-1e-200), V3(1e-200)};
    eye = V3(1e150);
    casters = {V3(-1e151), V3(1e151)};
    ShadowMap<double> const map = made();
    EXPECT_FALSE(map.visible);
    EXPECT_EQ(map.faults.bits, Faults(Fault::precision_lost).bits);
    EXPECT_EQ(map.clip_from_world, nowhere<double>());
}
