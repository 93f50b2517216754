// SPDX-License-Identifier: MIT
//
// Nothing but the headers and a renderer of one's own: a ray tracer of twenty lines, which draws maps and picture
// alike. Of shadowmath it needs a matrix and a bias for each map, and where the slices end.
#include "examples/support/example.hpp"
#include "examples/support/png.hpp"
#include "examples/support/your_renderer.hpp"

#include <shadowmath/cascades.hpp>
#include <shadowmath/filter.hpp>
#include <shadowmath/sampling.hpp>

#include <glm/matrix.hpp>

namespace sm = shadowmath;
using namespace your_renderer;

int main(int argc, char** argv) {
    sm::example::Proof proof(argc, argv);
    auto const pose = sm::pose_looking(vec3(0, 2.2f, 2), vec3(0, -0.14f, -1), vec3(0, 1, 0));
    auto const view = sm::perspective_view(pose, 0.9f, 16.0f / 9.0f, 0.5f, 60.0f);
    auto const sun = sm::directional(vec3(0.5f, -0.7f, -0.35f));
    sm::Aabb<float> const casters{vec3(-6, 0, -41), vec3(7, 5, -6)}, receivers{vec3(-80, 0, -80), vec3(80, 6, 80)};
    constexpr int size = 512;
    sm::CascadeOptions<float> const options{.map_size = size, .clip = sm::gl_zero_to_one_clip};
    auto const cascades = sm::fit_cascades(view, sun, casters, receivers, options);

    // Along a light ray a texel's depth is the share of the way: the one law, at work.
    std::vector<float> depths[sm::max_splits];
    sm::SliceRange<float> ranges[sm::max_splits];
    for (int i = 0; i < cascades.count; ++i) {
        ranges[i] = cascades.at[i].range;
        glm::mat4 const world_from_clip = glm::inverse(cascades.at[i].map.clip_from_world);
        auto const end = [&](vec2 at, float depth) { return vec3(world_from_clip * glm::vec4(at, depth, 1)); };
        auto const light_ray = [&](vec2 at) { return between(end(at, 0), end(at, 1)); };
        depths[i] = drawn(size, size, light_ray, [](vec2, Ray const&, Hit const& hit) { return hit.t; });
    }
    auto const read = [&](int i, vec3 point, vec3 normal) {  // what a shader would do
        if (i < 0) return 1.0f;
        auto const bias = sm::bias_for(cascades.at[i].map, sun, size, sm::BiasOptions<float>{});
        auto const stored = [&](int x, int y) { return depths[i][std::size_t(y * size + x)]; };
        return sm::visibility(cascades.at[i].map, size, point, normal, bias, {}, stored);
    };

    int wrong = 0, right = 0;
    auto const seen = [&](vec2 at, float z) { return sm::point_at(view, at.x * view.right, at.y * view.top, z); };
    auto const eye_ray = [&](vec2 at) { return between(seen(at, view.z_near), seen(at, view.z_far)); };
    sm::backend::Image<sm::backend::Rgba8> picture({640, 360});
    picture.pixels = drawn(640, 360, eye_ray, [&](vec2 at, Ray const& ray, Hit const& hit) {
        vec3 const point = ray.from + ray.way * hit.t;
        auto const maps = sm::by_depth(ranges, cascades.count, sm::eye_depth(view, point));
        float const lit = sm::blended(maps, read(maps.first, point, hit.normal), read(maps.second, point, hit.normal));
        Hit const occluder = first_hit({point + hit.normal * 1e-3f, -sun.direction * 100.0f});  // the truth
        if (hit.on_floor() && (lit == 0.0f || lit == 1.0f)) (lit == float(occluder.t == 1.0f) ? right : wrong) += 1;
        return shaded(hit, point, lit * std::max(0.0f, -glm::dot(hit.normal, sun.direction)), at.y);
    });
    std::printf("%d pixels of the floor as the ray tracer has them, %d not\n", right, wrong);
    proof.that(wrong * 1000 < right, "Fewer than one pixel in a thousand is shadowed otherwise than by ray tracing.");
    sm::example::write_png(proof.folder() / "your_own_renderer.png", picture);
    return proof.result();
}
