// SPDX-License-Identifier: MIT
//
// Soft shadows against the truth: the share of the light that a point of the floor sees past a post, by 256 rays a
// point, and the same from one shadow map. Each case prints its figures; the bounds are those figures, rounded up.
#include "oracle/area_light.hpp"
#include "scenes/mesh_builder.hpp"

#include <shadowmath/hfts.hpp>
#include <shadowmath/light_box.hpp>
#include <shadowmath/pcss.hpp>
#include <shadowmath/view_volume.hpp>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cstdio>
#include <optional>

namespace {

using namespace shadowmath;
using oracle::AreaLight;
using oracle::RayOracle;

constexpr glm::dvec3 up{0.0, 1.0, 0.0};

struct Box {
    glm::dvec3 lo, hi;
};

constexpr Box post{{-0.2, 0.0, -0.2}, {0.2, 3.0, 0.2}};
constexpr Box hanging{{-0.2, 2.0, -0.2}, {0.2, 3.0, 0.2}};
constexpr Box canopy{{-1.0, 2.9, -1.0}, {1.0, 3.0, 1.0}};

backend::Scene over_floor(std::initializer_list<Box> boxes) {
    scenes::MeshBuilder mesh;
    mesh.quad({-40, 0, -40}, {-40, 0, 40}, {40, 0, 40}, {40, 0, -40});
    mesh.end_object();
    for (Box const& box : boxes) {
        mesh.box(box.lo, box.hi);
        mesh.end_object();
    }
    return mesh.finish("boxes_over_floor");
}

AreaLight with_size(Light<double> const& light, double radius) {
    bool const lamp = light.kind == LightKind::spot;
    return {lamp ? glm::dvec4(light.position, 1.0) : glm::dvec4(-light.direction, 0.0), light.direction, radius};
}

// A map whose texels hold what rays through their centres hit.
struct TracedMap {
    TracedMap(RayOracle const& oracle, Light<double> const& of, Mat4<double> const& matrix, int map_size)
        : light(of), size(map_size) {
        map.clip = gl_zero_to_one_clip;
        map.clip_from_world = matrix;
        map.visible = true;
        Mat4<double> const texture = texture_from_world(map), world = glm::inverse(texture);
        depths.assign(static_cast<std::size_t>(size) * static_cast<std::size_t>(size), 1.0f);
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                auto const at = [&](double depth) {
                    glm::dvec4 const p = world * glm::dvec4((x + 0.5) / size, (y + 0.5) / size, depth, 1.0);
                    return glm::dvec3(p) / p.w;
                };
                glm::dvec3 const begin = at(0.0), ray = at(1.0) - begin;
                std::optional<oracle::Hit> const hit = oracle.first_hit(begin, ray);
                if (!hit) continue;
                glm::dvec3 const place = begin + glm::normalize(ray) * hit->distance;
                at_texel(x, y) = static_cast<float>(std::min(projected(texture, place).at.z, 1.0));
            }
        bias = bias_for(map, light, size, BiasOptions<double>{});
    }

    float& at_texel(int x, int y) { return depths[static_cast<std::size_t>(y * size + x)]; }
    [[nodiscard]] auto reader() const {
        return [this](int x, int y) { return static_cast<double>(depths[static_cast<std::size_t>(y * size + x)]); };
    }
    [[nodiscard]] SoftShadow<double> soft(glm::dvec3 point, double radius, PcssOptions<double> const& options) const {
        return soft_visibility(map, size, point, up, bias, penumbra_for(map, light, radius), options, reader());
    }
    [[nodiscard]] double hard(glm::dvec3 point, int radius) const {
        return visibility(map, size, point, up, bias, {radius, true}, reader());
    }

    Light<double> light;
    int size;
    ShadowMap<double> map;
    MapBias<double> bias;
    std::vector<float> depths;
};

TracedMap sun_map(RayOracle const& oracle, Light<double> const& sun, double half_metres, int size,
                  double metres_above = 8.0) {
    LightBox<double> box;
    box.basis = light_basis(sun.direction);
    glm::dvec3 const centre = in_light(box.basis, {1.0, 0.0, 0.5});
    box.lo = glm::dvec2(centre) - half_metres;
    box.hi = glm::dvec2(centre) + half_metres;
    box.depth_lo = centre.z - metres_above;
    box.depth_hi = centre.z + 8.0;
    return {oracle, sun, clip_from_world(box, gl_zero_to_one_clip), size};
}

TracedMap lamp_map(RayOracle const& oracle, Light<double> const& lamp, int size) {
    Pose<double> const pose = pose_looking(lamp.position, lamp.direction, {0.0, 0.0, 1.0});
    ViewVolume<double> const view = perspective_view(pose, 2.0 * lamp.half_angle_radians, 1.0, 1.0, lamp.range);
    return {oracle, lamp, clip_from_world(view, gl_zero_to_one_clip), size};
}

// Places on the floor around the post and its shadow, but not inside the post: a fixed sequence without a pattern.
std::vector<glm::dvec3> floor_points(int count, glm::dvec2 lo, glm::dvec2 hi) {
    std::vector<glm::dvec3> points;
    for (int i = 1; static_cast<int>(points.size()) < count; ++i) {
        double const u = std::fmod(i * 0.7548776662466927, 1.0), v = std::fmod(i * 0.5698402909980532, 1.0);
        glm::dvec3 const point(lo.x + (hi.x - lo.x) * u, 0.0, lo.y + (hi.y - lo.y) * v);
        if (std::abs(point.x) > 0.21 || std::abs(point.z) > 0.21) points.push_back(point);
    }
    return points;
}

struct Errors {
    double mean = 0.0, in_penumbra = 0.0, most = 0.0, bias = 0.0;
    int penumbra = 0;

    void add(double visibility, double truth) {
        double const error = std::abs(visibility - truth);
        mean += error;
        bias += visibility - truth;
        most = std::max(most, error);
        if (truth > 0.0 && truth < 1.0) {
            ++penumbra;
            in_penumbra += error;
        }
    }
    Errors over(int count, char const* name) {
        mean /= count;
        bias /= count;
        in_penumbra /= std::max(penumbra, 1);
        std::printf("  %-44s mean %.4f, in the penumbra (%d of %d) %.4f, bias %+.4f, most %.3f\n", name, mean, penumbra,
                    count, in_penumbra, bias, most);
        return *this;
    }
};

template <class Visibility>
Errors errors_of(char const* name, std::vector<glm::dvec3> const& points, std::vector<double> const& truth,
                 Visibility const& visibility) {
    Errors errors;
    for (std::size_t i = 0; i < points.size(); ++i) errors.add(visibility(points[i]), truth[i]);
    return errors.over(static_cast<int>(points.size()), name);
}

std::vector<double> truth_at(RayOracle const& oracle, std::vector<glm::dvec3> const& points, AreaLight const& light) {
    std::vector<double> truth;
    for (glm::dvec3 const& point : points) truth.push_back(lit_share(oracle, point, up, light));
    return truth;
}

Light<double> const sun = directional(glm::dvec3(0.7, -1.0, 0.3));
Light<double> const lamp = spot(glm::dvec3(-2, 6, -1), glm::dvec3(3, -6, 1.5), 0.6, 20.0);

}  // namespace

TEST(AreaLight, IsSeenAsTheSegmentOfADiskPastAStraightEdge) {
    // A wall whose upper edge is 2 m above the floor, across a sun overhead at 45 degrees: a point whose central ray
    // passes the edge by x radii sees the disk's share below the chord at x.
    RayOracle const oracle(over_floor({{{-10, 0, -30}, {0, 2, 30}}}));
    AreaLight const light{{-std::sqrt(0.5), std::sqrt(0.5), 0, 0}, {-std::sqrt(0.5), std::sqrt(0.5), 0}, 0.05};
    double const penumbra_radius = 0.05 * 2.0 * std::sqrt(2.0);  // at the edge's distance, across the light
    for (double x = -1.2; x <= 1.2; x += 0.1) {
        double const chord = std::clamp(x, -1.0, 1.0);
        double const share = 0.5 + (chord * std::sqrt(1.0 - chord * chord) + std::asin(chord)) / 3.14159265358979;
        glm::dvec3 const point(2.0 + x * penumbra_radius * std::sqrt(2.0), 0.0, 0.3);
        // The floor slopes away from the plane across the light, which moves the edge's distance by up to 5 percent;
        // 256 points tell shares apart to about 1 percent.
        EXPECT_NEAR(lit_share(oracle, point, up, light), share, 0.03) << x;
    }
}

TEST(AreaLight, OfRadiusZeroIsHard) {
    RayOracle const oracle(over_floor({post}));
    EXPECT_EQ(lit_share(oracle, {1.0, 0.0, 0.43}, up, with_size(sun, 0.0)), 0.0);
    EXPECT_EQ(lit_share(oracle, {-1.0, 0.0, 0.0}, up, with_size(sun, 0.0)), 1.0);
}

TEST(Pcss, AgreesWithRaysToAWideSunAroundAPost) {
    RayOracle const oracle(over_floor({post}));
    TracedMap const map = sun_map(oracle, sun, 5.0, 1024);
    double const radius = 0.05;
    auto const points = floor_points(4000, {-1.0, -1.0}, {3.0, 2.0});
    auto const truth = truth_at(oracle, points, with_size(sun, radius));
    Errors const hard = errors_of("wide sun, post: PCF 3x3", points, truth, [&](auto p) { return map.hard(p, 1); });
    Errors const soft = errors_of("wide sun, post: PCSS 32 + 32", points, truth,
                                  [&](auto p) { return map.soft(p, radius, {}).visibility; });
    Errors const more = errors_of("wide sun, post: PCSS 128 + 128", points, truth, [&](auto p) {
        return map.soft(p, radius, {128, 128, {1, 0}}).visibility;
    });
    EXPECT_GT(soft.penumbra, 300);
    EXPECT_GT(hard.mean, 0.015) << "a light without a size must fail here";
    EXPECT_LT(soft.mean, 0.003);
    EXPECT_LT(soft.in_penumbra, 0.03);
    EXPECT_LT(more.mean, 0.0014);
    EXPECT_LT(more.in_penumbra, 0.012);
    EXPECT_LT(soft.most, 0.6) << "at the foot of the post, where a texel spans the penumbra";
}

TEST(Pcss, AgreesWithRaysToTheRealSunAroundAPost) {
    RayOracle const oracle(over_floor({post}));
    TracedMap const map = sun_map(oracle, sun, 2.5, 1024);
    double const radius = sun_radius(sun_angular_radius_radians<double>);
    auto const points = floor_points(4000, {-0.4, -0.4}, {2.4, 1.2});
    auto const truth = truth_at(oracle, points, with_size(sun, radius));
    Errors const hard = errors_of("real sun, post: PCF 3x3", points, truth, [&](auto p) { return map.hard(p, 1); });
    Errors const soft = errors_of("real sun, post: PCSS 32 + 32", points, truth,
                                  [&](auto p) { return map.soft(p, radius, {}).visibility; });
    EXPECT_GT(hard.mean, 0.003);
    EXPECT_LT(soft.mean, 0.0012);
    EXPECT_LT(soft.in_penumbra, 0.04);
}

TEST(Pcss, AgreesWithRaysToADiskLampAroundAPost) {
    RayOracle const oracle(over_floor({post}));
    TracedMap const map = lamp_map(oracle, lamp, 1024);
    double const radius = 0.25;
    auto const points = floor_points(4000, {-1.0, -1.0}, {3.0, 2.0});
    auto const truth = truth_at(oracle, points, with_size(lamp, radius));
    Errors const hard = errors_of("disk lamp, post: PCF 3x3", points, truth, [&](auto p) { return map.hard(p, 1); });
    Errors const soft = errors_of("disk lamp, post: PCSS 32 + 32", points, truth,
                                  [&](auto p) { return map.soft(p, radius, {}).visibility; });
    Errors const more = errors_of("disk lamp, post: PCSS 128 + 128", points, truth, [&](auto p) {
        return map.soft(p, radius, {128, 128, {1, 0}}).visibility;
    });
    EXPECT_GT(hard.mean, 0.03);
    EXPECT_LT(soft.mean, 0.006);
    EXPECT_LT(soft.in_penumbra, 0.035);
    EXPECT_LT(more.mean, 0.0032);
    EXPECT_LT(more.in_penumbra, 0.017);
    EXPECT_LT(soft.most, 0.6);
}

TEST(Pcss, AgreesWithRaysWhereOccludersOverlap) {
    RayOracle const oracle(over_floor({post, canopy}));
    TracedMap const map = sun_map(oracle, sun, 5.0, 1024);
    double const radius = 0.05;
    auto const points = floor_points(4000, {-1.0, -1.0}, {3.0, 2.0});
    auto const truth = truth_at(oracle, points, with_size(sun, radius));
    Errors const soft = errors_of("wide sun, post under a canopy: PCSS 32 + 32", points, truth,
                                  [&](auto p) { return map.soft(p, radius, {}).visibility; });
    EXPECT_LT(soft.mean, 0.005);
    EXPECT_LT(soft.in_penumbra, 0.024);
}

// Two cascades: texels of 10 and 20 mm, near ends 8 and 40 m toward the light.
TEST(Pcss, GivesTheSamePenumbraFromMapsOfAnyTexelSizeAndDepthRange) {
    RayOracle const oracle(over_floor({hanging}));
    TracedMap const fine = sun_map(oracle, sun, 5.0, 1024), coarse = sun_map(oracle, sun, 10.0, 1024);
    TracedMap const deep = sun_map(oracle, sun, 10.0, 1024, 40.0);
    double const radius = 0.05;
    auto const points = floor_points(4000, {-1.0, -1.0}, {3.0, 2.0});
    std::vector<double> in_fine;
    for (glm::dvec3 const& point : points) in_fine.push_back(fine.soft(point, radius, {}).visibility);
    Errors const jump = errors_of("from texels of 10 mm to 20 mm", points, in_fine,
                                  [&](auto p) { return coarse.soft(p, radius, {}).visibility; });
    Errors const deeper = errors_of("and to a near end five times as far", points, in_fine,
                                    [&](auto p) { return deep.soft(p, radius, {}).visibility; });
    EXPECT_LT(jump.mean, 0.001);
    EXPECT_LT(jump.most, 0.1);
    EXPECT_LT(deeper.mean, 0.0022);
}

TEST(Hfts, KeepsContactsExactAndPenumbraeSoft) {
    RayOracle const oracle(over_floor({post}));
    TracedMap const map = sun_map(oracle, sun, 5.0, 256);  // texels of 4 cm: PCSS alone has no contact
    double const radius = 0.05, soft_gap = 0.5;
    auto const hybrid = [&](glm::dvec3 const& point) {
        ExactShadow<double> exact;
        glm::dvec3 const start = point + up * oracle::ray_offset(point);
        if (std::optional<oracle::Hit> const hit = oracle.first_hit(start, -sun.direction))
            exact = {0.0, hit->distance};
        return hybrid_visibility(exact, map.soft(point, radius, {}), soft_gap);
    };
    auto const near_contact = floor_points(2000, {-0.3, -0.3}, {0.5, 0.4});
    auto const truth = truth_at(oracle, near_contact, with_size(sun, radius));
    Errors const soft = errors_of("at the foot of the post: PCSS, 4 cm texels", near_contact, truth,
                                  [&](auto p) { return map.soft(p, radius, {}).visibility; });
    Errors const both = errors_of("at the foot of the post: HFTS, 4 cm texels", near_contact, truth, hybrid);
    EXPECT_LT(both.mean, 0.7 * soft.mean);
}
