// SPDX-License-Identifier: MIT
//
// Nothing but the headers and a renderer of one's own: a ray tracer of twenty lines, which draws maps and picture
// alike. Of shadowmath it needs a matrix and a bias for each map, and where the slices end. (Only the PNG file is
// support's.)
#include "examples/support/example.hpp"
#include "examples/support/png.hpp"

#include <shadowmath/cascades.hpp>
#include <shadowmath/filter.hpp>
#include <shadowmath/sampling.hpp>

#include <glm/matrix.hpp>

#include <cmath>

namespace sm = shadowmath;
using glm::vec3;

struct Ball {
    vec3 centre;
    float radius;
};
Ball const balls[] = {
    {{-2.2f, 1.2f, -7}, 1.0f}, {{1.6f, 0.8f, -9}, 0.8f}, {{-4, 3, -17}, 2}, {{5, 2, -22}, 2}, {{-1, 2.5f, -38}, 2.5f}};

struct Hit {
    float t = 1.0f;  // of the way
    vec3 normal{0.0f};
};
Hit first_hit(vec3 from, vec3 way) {
    Hit hit;
    if (way.y < 0.0f && -from.y / way.y < 1.0f) hit = {-from.y / way.y, vec3(0, 1, 0)};
    for (Ball const& ball : balls) {
        vec3 const to = from - ball.centre;
        float const a = glm::dot(way, way), b = glm::dot(way, to), c = glm::dot(to, to) - ball.radius * ball.radius;
        float const t = (-b - std::sqrt(std::max(b * b - a * c, 0.0f))) / a;
        if (b * b > a * c && t > 0.0f && t < hit.t) hit = {t, (to + way * t) / ball.radius};
    }
    return hit;
}

int main(int argc, char** argv) {
    sm::example::Proof proof(argc, argv);
    auto const eye = sm::pose_looking(vec3(0, 2.2f, 2), vec3(0, -0.14f, -1), vec3(0, 1, 0));
    auto const view = sm::perspective_view(eye, 0.9f, 16.0f / 9.0f, 0.5f, 60.0f);
    auto const sun = sm::directional(vec3(0.5f, -0.7f, -0.35f));
    sm::Aabb<float> casters, receivers{vec3(-80, -0.01f, -80), vec3(80, 6, 80)};
    for (Ball const& ball : balls)
        casters = merge(merge(casters, ball.centre - ball.radius), ball.centre + ball.radius);
    sm::CascadeOptions<float> options;
    options.clip = sm::gl_zero_to_one_clip;
    options.map_size = 512;
    auto const cascades = sm::fit_cascades(view, sun, casters, receivers, options);

    // Along a light ray a texel's depth is the share of the way: the one law, at work.
    std::vector<float> depths[sm::max_splits];
    sm::SliceRange<float> ranges[sm::max_splits];
    int const size = options.map_size;
    for (int i = 0; i < cascades.count; ++i) {
        ranges[i] = cascades.at[i].range;
        glm::mat4 const world_from_clip = glm::inverse(cascades.at[i].map.clip_from_world);
        for (int texel = 0; texel < size * size; ++texel) {
            glm::vec2 const ndc = (glm::vec2(texel % size, texel / size) + 0.5f) * (2.0f / float(size)) - 1.0f;
            vec3 const from(world_from_clip * glm::vec4(ndc, 0, 1)), to(world_from_clip * glm::vec4(ndc, 1, 1));
            depths[i].push_back(first_hit(from, to - from).t);
        }
    }

    constexpr int width = 640, height = 360;
    sm::backend::Image<sm::backend::Rgba8> picture({width, height});
    int wrong = 0, right = 0;
    for (int pixel = 0; pixel < width * height; ++pixel) {
        glm::vec2 const at = (glm::vec2(pixel % width, pixel / width) + 0.5f) / glm::vec2(width, height) * 2.0f - 1.0f;
        vec3 const from = sm::point_at(view, at.x * view.right, at.y * view.top, view.z_near);
        vec3 const way = sm::point_at(view, at.x * view.right, at.y * view.top, view.z_far) - from;
        Hit const hit = first_hit(from, way);
        vec3 colour = glm::mix(vec3(0.85f, 0.9f, 0.94f), vec3(0.45f, 0.65f, 0.9f), at.y);
        if (hit.t < 1.0f) {
            vec3 const point = from + way * hit.t;
            auto const look_up = sm::by_depth(ranges, cascades.count, sm::eye_depth(view, point));
            auto const read = [&](int i) {
                auto const stored = [&](int x, int y) { return depths[i][std::size_t(y * size + x)]; };
                auto const bias = sm::bias_for(cascades.at[i].map, sun, size, sm::BiasOptions<float>{});
                return sm::visibility(cascades.at[i].map, size, point, hit.normal, bias, {}, stored);
            };
            float const lit = sm::blended(look_up, look_up.first < 0 ? 1.0f : read(look_up.first),
                                          look_up.second < 0 ? 1.0f : read(look_up.second));
            // The same question, asked of the ray tracer.
            bool const traced = first_hit(point + hit.normal * 1e-3f, -sun.direction * 100.0f).t == 1.0f;
            if (hit.normal.y == 1.0f && (lit == 0.0f || lit == 1.0f))
                (lit == (traced ? 1.0f : 0.0f) ? right : wrong) += 1;
            bool const odd = (int(std::floor(point.x)) + int(std::floor(point.z))) % 2 != 0;
            vec3 const surface = hit.normal.y == 1.0f ? vec3(odd ? 0.62f : 0.7f) : vec3(0.85f, 0.45f, 0.25f);
            colour = surface * (0.35f + 0.75f * lit * std::max(0.0f, -glm::dot(hit.normal, sun.direction)));
        }
        auto const byte = [](float c) { return std::uint8_t(std::sqrt(glm::clamp(c, 0.0f, 1.0f)) * 255.0f); };
        picture.pixels[std::size_t(pixel)] = {byte(colour.x), byte(colour.y), byte(colour.z), 255};
    }
    std::printf("%d pixels of the floor as the ray tracer has them, %d not\n", right, wrong);
    proof.that(wrong * 1000 < right, "Fewer than one pixel in a thousand is shadowed otherwise than by ray tracing.");
    sm::example::write_png(proof.folder() / "your_own_renderer.png", picture);
    return proof.result();
}
