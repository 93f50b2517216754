// SPDX-License-Identifier: MIT
#include "tests/laws/vdsm.hpp"
#include "tests/support/gen.hpp"
#include "tests/support/seen_case.hpp"
#include "tests/support/watched.hpp"

#include <gtest/gtest.h>

using namespace shadowmath;
using namespace shadowmath::test;

// The law, the point in view and the caster on its light ray, in their order: the same for every light.
template <class T>
void serves_receiver_and_caster(SeenCase<T> const& scene, Light<T> const& light, ShadowPlane<T> const& plane,
                                Vec3<T> const& caster) {
    VdsmOptions<T> const options;
    ShadowMap<T> const map = view_dependent_map(scene.view, light, plane, merge(scene.receivers, caster),
                                                scene.receivers, options, scene.clip);
    RC_ASSERT(laws::harmless(map));
    RC_ASSERT(map.visible);
    RC_ASSERT(laws::is_map_of(map.clip_from_world, light, scene.clip));
    T const margin = T(2) * options.margin_texels / T(options.map_size);
    RC_ASSERT(laws::serves(map, scene.point, margin));
    RC_ASSERT(laws::serves(map, caster, margin));
    RC_ASSERT(laws::keeps_the_order(map, caster, scene.point));
}

template <class T>
class VdsmProperty : public ::testing::Test {};
using Scalars = ::testing::Types<float, double>;
TYPED_TEST_SUITE(VdsmProperty, Scalars);

namespace {

// A plane through the seen point, neither along the light nor through the eye. The technique's own bounds are looser.
template <class T>
ShadowPlane<T> plane_under(SeenCase<T> const& scene, Vec3<T> const& travel) {
    Vec3<T> const normal = *direction<T>();
    RC_PRE(std::abs(glm::dot(normal, travel)) > T(0.06));
    bool const flat = scene.view.kind == ViewKind::orthographic;
    RC_PRE(!flat || std::abs(glm::dot(normal, scene.view.pose.forward)) > T(0.06));
    RC_PRE(flat || std::abs(glm::dot(normal, scene.point - scene.view.pose.position)) > T(2e-4) * scene.view.z_far);
    return plane_through(scene.point, normal);
}

}  // namespace

TYPED_TEST(VdsmProperty, ProjectsOntoThePlaneAlongTheLight) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        Vec3<T> const normal = *direction<T>();
        T const offset = *centred<T>(T(10));
        Vec3<T> const point = *point_within<T>(T(10));
        bool const positional = *one_in(2);
        Vec3<T> const place = *point_within<T>(T(10));
        Light<T> const far_light = *sun<T>();
        Vec4<T> const light = positional ? Vec4<T>(-place, T(-1)) : homogeneous(far_light);
        RC_PRE(std::abs(glm::dot(Vec4<T>(normal, offset), light)) > T(0.05));
        RC_ASSERT(laws::projects_onto(ShadowPlane<T>{normal, offset}, light, point));
    }));
}

TYPED_TEST(VdsmProperty, ServesThePlaneInViewAndTheCastersBetweenItAndASun) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        SeenCase<T> const scene = *seen_case<T>();
        Light<T> const light = *sun<T>();
        ShadowPlane<T> const plane = plane_under(scene, light.direction);
        T const away = *log_uniform<T>(T(1e-3), T(100));
        T const distance = away * glm::length(scene.point - scene.view.pose.position);
        Vec3<T> const caster = scene.point - light.direction * distance;
        serves_receiver_and_caster(scene, light, plane, caster);
    }));
}

TYPED_TEST(VdsmProperty, ServesThePlaneInViewAndTheCastersBetweenItAndASpot) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        SeenCase<T> const scene = *seen_case<T>();
        Vec3<T> const travel = *direction<T>();
        ShadowPlane<T> const plane = plane_under(scene, travel);
        T const away = *log_uniform<T>(T(0.1), T(10));
        T const share = *uniform<T>(T(0.01), T(1));
        T const distance = away * scene.view.z_far;
        Vec3<T> const place = scene.point - travel * distance;
        RC_PRE(std::abs(glm::dot(plane.normal, travel)) * distance > T(2e-4) * scene.view.z_far);
        // The law weighs a spot's k against a light vector of a metre: in smaller scenes it drowns in that.
        RC_PRE(std::abs(glm::dot(plane.normal, travel)) * distance > T(0.05));
        Light<T> const light = spot(place, travel, T(0.5), T(2) * distance);
        Vec3<T> const caster = scene.point + (place - scene.point) * (T(1) - share);
        serves_receiver_and_caster(scene, light, plane, caster);
    }));
}

TYPED_TEST(VdsmProperty, IsFiniteAndCalmForAnyInput) {
    using T = TypeParam;
    EXPECT_TRUE(rc::check([] {
        ViewVolume<T> const view = *nasty_view_volume<T>();
        Vec3<T> const travel = *nasty_vec3<T>();
        Vec3<T> const place = *nasty_vec3<T>();
        T const angle = *nasty<T>();
        T const range = *nasty<T>();
        bool const from_spot = *one_in(2);
        Light<T> light = from_spot ? spot(place, travel, angle, range) : directional(travel);
        bool const raw = *one_in(3);
        if (raw) light.direction = travel;
        if (raw) light.half_angle_radians = angle;
        Aabb<T> const casters = *nasty_box<T>();
        Aabb<T> const receivers = *nasty_box<T>();
        ShadowPlane<T> plane;
        bool const odd = *one_in(2);
        Vec3<T> const normal = *nasty_vec3<T>();
        T const offset = *nasty<T>();
        if (odd) plane = {normal, offset};
        VdsmOptions<T> options;
        bool const strange = *one_in(3);
        T const values[] = {*nasty<T>(), *nasty<T>(), *nasty<T>(), *nasty<T>()};
        if (strange) {
            options.margin_texels = values[0];
            options.w_min = values[1];
            options.reach = values[2];
            options.least_sine = values[3];
        }
        ClipSpace const clip = *clip_space();
        auto const map =
            watched([&] { return view_dependent_map(view, light, plane, casters, receivers, options, clip); });
        RC_ASSERT(laws::harmless(map.result));
        RC_ASSERT(map.calm());
        RC_ASSERT(watched([&] { return plane_projection(plane, Vec4<T>(place, range)); }).calm());
        RC_ASSERT(all_finite(plane_projection(plane, Vec4<T>(place, range))));
    }));
}
