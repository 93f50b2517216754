// SPDX-License-Identifier: MIT
#include "oracle/edge_mask.hpp"
#include "oracle/ray_oracle.hpp"
#include "scenes/mesh_builder.hpp"

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>

namespace {

using namespace shadowmath;
using backend::Image;
using backend::Texel4;
using oracle::Judge;
using oracle::RayOracle;
using oracle::Truth;

constexpr glm::dvec3 up{0.0, 1.0, 0.0};
constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

// A floor of 80 m by 80 m at y = 0 and a box over it, about a place.
backend::Scene box_over_floor(glm::dvec3 place, glm::dvec3 lo, glm::dvec3 hi) {
    scenes::MeshBuilder mesh;
    mesh.frame.origin = place;
    mesh.quad({-40, 0, -40}, {-40, 0, 40}, {40, 0, 40}, {40, 0, -40});
    mesh.end_object();
    mesh.box(lo, hi);
    mesh.end_object();
    return mesh.finish("box_over_floor");
}

// Closed form: the metres of a segment from the point to the light that run inside the box grown by margin; the
// shadow of a box is where that is positive. Positive margins widen the shadow, negative ones narrow it.
bool in_box_shadow(glm::dvec3 point, glm::dvec4 light, glm::dvec3 lo, glm::dvec3 hi, double margin) {
    glm::dvec3 const to_light = light.w == 0.0 ? glm::dvec3(light) * 1e3 : glm::dvec3(light) - point;
    double enter = 0.0;
    double leave = 1.0;
    for (int axis = 0; axis < 3; ++axis) {
        double const low = (lo[axis] - margin - point[axis]) / to_light[axis];
        double const high = (hi[axis] + margin - point[axis]) / to_light[axis];
        enter = std::max(enter, std::min(low, high));
        leave = std::min(leave, std::max(low, high));
    }
    return enter < leave;
}

struct Tally {
    int lit = 0;
    int shadowed = 0;
    int wrong = 0;
};

// Compares floor points with the closed form, leaving out those nearer to the border than the margin.
Tally compare_with_closed_form(glm::dvec3 place, glm::dvec3 lo, glm::dvec3 hi, glm::dvec4 light, double half, int steps,
                               double margin) {
    RayOracle const oracle(box_over_floor(place, lo, hi));
    glm::dvec4 const light_there = light.w == 0.0 ? light : light + glm::dvec4(place, 0.0);
    Tally tally;
    for (int j = 0; j < steps; ++j)
        for (int i = 0; i < steps; ++i) {
            glm::dvec3 const point{half * (2.0 * (i + 0.37) / steps - 1.0), 0.0,
                                   half * (2.0 * (j + 0.41) / steps - 1.0)};
            bool const surely = in_box_shadow(point, light, lo, hi, -margin);
            bool const perhaps = in_box_shadow(point, light, lo, hi, margin);
            if (surely != perhaps) continue;
            bool const lit = oracle.lit(glm::dvec3(glm::vec3(point + place)), up, light_there);
            (lit ? tally.lit : tally.shadowed) += 1;
            tally.wrong += lit == surely ? 1 : 0;
        }
    return tally;
}

Image<Truth> picture(std::vector<std::string> const& rows) {  // 'L' lit, 'S' shadowed, 'F' facing away, '.' sky
    Image<Truth> image({static_cast<int>(rows.front().size()), static_cast<int>(rows.size())});
    for (int y = 0; y < image.extent.height; ++y)
        for (int x = 0; x < image.extent.width; ++x) {
            char const c = rows[static_cast<std::size_t>(y)][static_cast<std::size_t>(x)];
            image.at(x, y) = c == 'L'   ? Truth::lit
                             : c == 'S' ? Truth::shadowed
                             : c == 'F' ? Truth::facing_away
                                        : Truth::sky;
        }
    return image;
}

std::vector<std::string> drawn(Image<Judge> const& mask) {  // '-' off edge, 'E' edge, '.' sky
    std::vector<std::string> rows;
    for (int y = 0; y < mask.extent.height; ++y) {
        rows.emplace_back();
        for (int x = 0; x < mask.extent.width; ++x)
            rows.back() += mask.at(x, y) == Judge::off_edge ? '-' : mask.at(x, y) == Judge::edge ? 'E' : '.';
    }
    return rows;
}

using Rows = std::vector<std::string>;

}  // namespace

TEST(RayOracle, AgreesWithTheClosedFormShadowOfABoxUnderASun) {
    // The shadow is the box's base swept by (1, 0.5): 4 + 2 + 1 square metres, at 625 points each.
    Tally const tally = compare_with_closed_form({}, {-1, 1, -1}, {1, 3, 1}, {0.5, 1.0, 0.25, 0.0}, 6.0, 300, 1e-4);
    EXPECT_EQ(tally.wrong, 0);
    EXPECT_NEAR(tally.shadowed, 7 * 625, 100);
    EXPECT_GT(tally.lit, 5000);
}

TEST(RayOracle, AgreesWithTheClosedFormShadowOfABoxUnderALamp) {
    Tally const tally = compare_with_closed_form({}, {-1, 1, -1}, {1, 3, 1}, {2.5, 6.0, 1.25, 1.0}, 8.0, 300, 1e-4);
    EXPECT_EQ(tally.wrong, 0);
    EXPECT_GT(tally.shadowed, 5000);
    EXPECT_GT(tally.lit, 5000);
}

TEST(RayOracle, StaysRightOneKilometreFromTheOrigin) {
    // Offset 1.9 mm, rounding of the vertices 0.06 mm, a sun at 42 degrees: the border moves by less than 4 mm.
    Tally const tally =
        compare_with_closed_form({1000, 3, -800}, {-1, 1, -1}, {1, 3, 1}, {0.5, 0.5, 0.25, 0.0}, 8.0, 300, 4e-3);
    EXPECT_EQ(tally.wrong, 0);
    EXPECT_GT(tally.shadowed, 3000);
    EXPECT_GT(tally.lit, 50000);
}

TEST(RayOracle, SeesTheShadowOfAWireOneCentimetreThick) {
    Tally const tally =
        compare_with_closed_form({}, {-10, 5, -0.005}, {10, 5.01, 0.005}, {0.3, 1.0, 0.2, 0.0}, 1.2, 600, 5e-4);
    EXPECT_EQ(tally.wrong, 0);
    EXPECT_GE(tally.shadowed, 2 * 600) << "the strip at z = -1 is 12 mm wide, the rows of 600 points are 4 mm apart";
}

TEST(RayOracle, LeavesAFlatFloorLitUnderGrazingLight) {
    for (glm::dvec3 const place :
         {glm::dvec3(0.0), glm::dvec3(317.0, 41.0, -219.0), glm::dvec3(1000.0, 120.0, -1000.0)}) {
        RayOracle const oracle(box_over_floor(place, {-39, 20, -39}, {-38, 21, -38}));
        for (double const elevation : {0.5, 0.05, 0.005, 0.0005}) {
            glm::dvec4 const sun{1.0, elevation, 0.3, 0.0};
            int dark = 0;
            for (int i = 0; i < 2000; ++i) {
                glm::dvec3 point = place + glm::dvec3(-30.0 + 0.029 * i, 0.0, 25.0 - 0.023 * i);
                point = glm::dvec3(glm::vec3(point));
                point.y -= (i % 8) * 0x1p-24 * glm::length(place);  // as a rasteriser's interpolation may leave it
                dark += oracle.lit(point, up, sun) ? 0 : 1;
            }
            EXPECT_EQ(dark, 0) << elevation;
        }
    }
}

TEST(RayOracle, TellsFacingAwayFromShadowed) {
    RayOracle const oracle(box_over_floor({}, {-1, 1, -1}, {1, 3, 1}));
    EXPECT_EQ(oracle.truth({0, 0, 0}, up, {0, 1, 0, 0}), Truth::shadowed);
    EXPECT_EQ(oracle.truth({5, 0, 0}, up, {0, 1, 0, 0}), Truth::lit);
    EXPECT_EQ(oracle.truth({5, 0, 0}, -up, {0, 1, 0, 0}), Truth::facing_away);
    EXPECT_EQ(oracle.truth({5, 0, 0}, up, {1, 0, 0, 0}), Truth::facing_away) << "light in the surface's plane";
    EXPECT_EQ(oracle.truth({5, 0, 0}, up, {5, -2, 0, 1}), Truth::facing_away) << "a lamp below the floor";
    EXPECT_EQ(oracle.truth({0, 0, 0}, up, {0, 0.5, 0, 1}), Truth::lit) << "a lamp below the box";
}

TEST(RayOracle, AnswersWhatIsNotFiniteWithoutARay) {
    RayOracle const oracle(box_over_floor({}, {-1, 1, -1}, {1, 3, 1}));
    for (double const bad : {nan_value, infinity, -infinity, 1e300}) {
        EXPECT_EQ(oracle.truth({bad, 0, 0}, up, {0, 1, 0, 0}), Truth::sky);
        EXPECT_EQ(oracle.truth({5, 0, 0}, {0, bad, 0}, {0, 1, 0, 0}), Truth::facing_away);
        EXPECT_EQ(oracle.truth({5, 0, 0}, up, {0, bad, 0, 0}), Truth::facing_away);
        EXPECT_FALSE(oracle.first_hit({bad, 0, 0}, up).has_value());
        EXPECT_FALSE(oracle.first_hit({0, 0, 0}, {0, bad, 0}).has_value());
    }
    EXPECT_EQ(oracle.truth({5, 0, 0}, up, {0, 1, 0, nan_value}), Truth::facing_away);
    EXPECT_EQ(oracle.truth({5, 0, 0}, {0, 0, 0}, {0, 1, 0, 0}), Truth::facing_away);
    EXPECT_EQ(oracle.truth({5, 0, 0}, up, {0, 0, 0, 0}), Truth::facing_away);
    EXPECT_EQ(oracle.truth({5, 0, 0}, up, {5, 0, 0, 1}), Truth::facing_away) << "a lamp at the point";
}

TEST(RayOracle, LeavesOutTrianglesThatAreNotSound) {
    backend::Scene scene = box_over_floor({}, {-1, 1, -1}, {1, 3, 1});
    std::size_t const box = scene.objects[1].first_index;
    for (std::size_t i = box; i < box + scene.objects[1].index_count; i += 3) {
        if (i % 2 == 0)
            scene.indices[i] = 0xffffffffu;
        else
            scene.vertices[scene.indices[i]].position.x = std::numeric_limits<float>::quiet_NaN();
    }
    EXPECT_EQ(RayOracle(scene).truth({0, 0, 0}, up, {0, 1, 0, 0}), Truth::lit);
    EXPECT_EQ(RayOracle(backend::Scene{}).truth({0, 0, 0}, up, {0, 1, 0, 0}), Truth::lit) << "nothing casts";
}

TEST(RayOracle, LetsOnlyCastersCast) {
    backend::Scene scene = box_over_floor({}, {-1, 1, -1}, {1, 3, 1});
    scene.objects[1].casts = false;
    EXPECT_TRUE(RayOracle(scene).lit({0, 0, 0}, up, {0, 1, 0, 0}));
}

TEST(RayOracle, FindsTheFirstHitAndItsSide) {
    RayOracle const oracle(box_over_floor({}, {-1, 1, -1}, {1, 3, 1}));
    auto const top = oracle.first_hit({0.2, 10, 0.1}, {0, -2, 0});
    ASSERT_TRUE(top.has_value());
    EXPECT_NEAR(top->distance, 7.0, 1e-5);
    EXPECT_FALSE(top->back_face);
    auto const from_inside = oracle.first_hit({0.2, 2, 0.1}, {0, 1, 0});
    ASSERT_TRUE(from_inside.has_value());
    EXPECT_TRUE(from_inside->back_face);
    EXPECT_FALSE(oracle.first_hit({0, 10, 0}, {0, 1, 0}).has_value());
}

TEST(RayOracle, GivesTheSameAnswersInBatchesOnAnyNumberOfThreads) {
    RayOracle const oracle(box_over_floor({}, {-1, 1, -1}, {1, 3, 1}));
    glm::dvec4 const sun{0.5, 1.0, 0.25, 0.0};
    int const side = 61;
    Image<Texel4> position({side, side});
    Image<Texel4> normal({side, side}, {0.0f, 1.0f, 0.0f, 1.0f});
    std::vector<glm::dvec3> points;
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            position.at(x, y) = {0.1f * static_cast<float>(x) - 3.0f, 0.0f, 0.1f * static_cast<float>(y) - 3.0f, 0.0f};
            points.emplace_back(position.at(x, y).x, 0.0, position.at(x, y).z);
        }
    position.at(3, 3).w = -2.0f;
    std::vector<glm::dvec3> const normals(points.size(), up);
    for (int const threads : {-1, 1, 2, 7}) {
        Image<Truth> const truth = oracle.truth(position, normal, sun, threads);
        std::vector<std::uint8_t> const lit = oracle.lit(points, normals, sun, threads);
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x) {
                auto const i = static_cast<std::size_t>(y * side + x);
                Truth const expected = oracle.truth(points[i], up, sun);
                ASSERT_EQ(lit[i] == 1, expected == Truth::lit);
                ASSERT_EQ(truth.at(x, y), x == 3 && y == 3 ? Truth::sky : expected);
            }
    }
}

TEST(EdgeMask, LeavesAUniformPictureOffEdge) {
    EXPECT_EQ(drawn(edge_mask(picture({"LL", "LL"}), picture({"LLLL", "LLLL", "LLLL", "LLLL"}))), (Rows{"--", "--"}));
    EXPECT_EQ(drawn(edge_mask(picture({"SF", "FS"}), picture({"SSFF", "SSFF", "FFSS", "FFSS"}))), (Rows{"--", "--"}))
        << "facing away and shadowed are both dark";
}

TEST(EdgeMask, MarksThePixelsOnBothSidesOfABorder) {
    // The border runs between pixels 2 and 3; the samples of pixels 1 and 4 that face it are 1.25 pixels away on the
    // axis alone, so farther than 1.25 in the plane.
    EXPECT_EQ(drawn(edge_mask(picture({"LLLSSS", "LLLSSS"}),
                              picture({"LLLLLLSSSSSS", "LLLLLLSSSSSS", "LLLLLLSSSSSS", "LLLLLLSSSSSS"}))),
              (Rows{"--EE--", "--EE--"}));
}

TEST(EdgeMask, SeesASampleThatOnlyTheFineGridHas) {
    Image<Truth> const centres = picture({"LLLL", "LLLL", "LLLL"});
    Image<Truth> samples({8, 6}, Truth::lit);
    samples.at(3, 2) = Truth::shadowed;  // in pixel (1, 1), the half toward pixel (2, 1), the row toward pixel (1, 0)
    EXPECT_EQ(drawn(edge_mask(centres, samples)), (Rows{"-EE-", "-EE-", "----"}));
}

TEST(EdgeMask, CountsSkyForNeitherSide) {
    EXPECT_EQ(drawn(edge_mask(picture({"L.S"}), picture({"LL..SS", "LL..SS"}))), (Rows{"-.-"}));
    EXPECT_EQ(drawn(edge_mask(picture({"L..."}), picture({"LL.S....", "LL......"}))), (Rows{"-..."}));
}

TEST(EdgeMask, GrowsWithTheRadius) {
    Image<Truth> const centres = picture({"LLLLSSSS"});
    Image<Truth> const samples = picture({"LLLLLLLLSSSSSSSS", "LLLLLLLLSSSSSSSS"});
    EXPECT_EQ(drawn(edge_mask(centres, samples, 0.5)), (Rows{"--------"}));
    EXPECT_EQ(drawn(edge_mask(centres, samples, 1.0)), (Rows{"---EE---"}));
    EXPECT_EQ(drawn(edge_mask(centres, samples, 2.0)), (Rows{"--EEEE--"}));
}

TEST(EdgeMask, JudgesNothingWhereTheGridsDoNotFit) {
    EXPECT_EQ(drawn(edge_mask(picture({"LL"}), picture({"LLLL"}))), (Rows{"EE"}));
}
