// SPDX-License-Identifier: MIT
//
// What the tutorials do, in GLM, as fast as they do it: the other side of every ratio. Nothing is slower than it is
// found in renderers, and nothing that shadowmath checks for is checked here.
#pragma once

#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <glm/glm.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <span>

namespace textbook {

struct Camera {
    glm::vec3 position{0.0f};
    glm::vec3 forward{0.0f, 0.0f, -1.0f};
    glm::vec3 up{0.0f, 1.0f, 0.0f};
    float fov_y = 1.0f;
    float aspect = 16.0f / 9.0f;
    float z_near = 0.1f;
    float z_far = 200.0f;
};

using Maps = std::array<glm::mat4, 4>;

inline std::array<float, 5> splits(float n, float f, float lambda) {
    std::array<float, 5> plane;
    for (int i = 0; i <= 4; ++i) {
        float const p = static_cast<float>(i) / 4.0f;
        float const log = n * std::pow(f / n, p), uniform = n + (f - n) * p;
        plane[static_cast<std::size_t>(i)] = lambda * log + (1.0f - lambda) * uniform;
    }
    return plane;
}

inline std::array<glm::vec3, 8> frustum_corners(Camera const& camera, float n, float f) {
    glm::mat4 const view = glm::lookAtRH(camera.position, camera.position + camera.forward, camera.up);
    glm::mat4 const inverse = glm::inverse(glm::perspectiveRH_ZO(camera.fov_y, camera.aspect, n, f) * view);
    std::array<glm::vec3, 8> corners;
    std::size_t i = 0;
    for (float const z : {0.0f, 1.0f})
        for (float const y : {-1.0f, 1.0f})
            for (float const x : {-1.0f, 1.0f}) {
                glm::vec4 const at = inverse * glm::vec4(x, y, z, 1.0f);
                corners[i++] = glm::vec3(at) / at.w;
            }
    return corners;
}

inline glm::vec3 centre_of(std::array<glm::vec3, 8> const& corners) {
    glm::vec3 sum(0.0f);
    for (glm::vec3 const& corner : corners) sum += corner;
    return sum / 8.0f;
}

// Inverse view-projection, eight corners, lookAt at their centre, bounds, ortho.
inline Maps tight_cascades(Camera const& camera, glm::vec3 const& light, float lambda) {
    std::array<float, 5> const plane = splits(camera.z_near, camera.z_far, lambda);
    Maps maps;
    for (std::size_t i = 0; i < 4; ++i) {
        std::array<glm::vec3, 8> const corners = frustum_corners(camera, plane[i], plane[i + 1]);
        glm::vec3 const centre = centre_of(corners);
        glm::mat4 const view = glm::lookAtRH(centre - light, centre, glm::vec3(0.0f, 1.0f, 0.0f));
        glm::vec3 lo(std::numeric_limits<float>::max()), hi(std::numeric_limits<float>::lowest());
        for (glm::vec3 const& corner : corners) {
            glm::vec3 const at(view * glm::vec4(corner, 1.0f));
            lo = glm::min(lo, at);
            hi = glm::max(hi, at);
        }
        maps[i] = glm::orthoRH_ZO(lo.x, hi.x, lo.y, hi.y, -hi.z, -lo.z) * view;
    }
    return maps;
}

// The ball around the centre of the corners, its radius rounded up; the origin's texel rounded to a whole one.
inline Maps stable_cascades(Camera const& camera, glm::vec3 const& light, float lambda, float map_size) {
    std::array<float, 5> const plane = splits(camera.z_near, camera.z_far, lambda);
    Maps maps;
    for (std::size_t i = 0; i < 4; ++i) {
        std::array<glm::vec3, 8> const corners = frustum_corners(camera, plane[i], plane[i + 1]);
        glm::vec3 const centre = centre_of(corners);
        float radius = 0.0f;
        for (glm::vec3 const& corner : corners) radius = glm::max(radius, glm::length(corner - centre));
        radius = std::ceil(radius * 16.0f) / 16.0f;
        glm::mat4 const view = glm::lookAtRH(centre - light * radius, centre, glm::vec3(0.0f, 1.0f, 0.0f));
        glm::mat4 projection = glm::orthoRH_ZO(-radius, radius, -radius, radius, 0.0f, 2.0f * radius);
        glm::vec4 const origin = projection * view * glm::vec4(0.0f, 0.0f, 0.0f, 1.0f) * (map_size / 2.0f);
        glm::vec2 const offset = (glm::round(glm::vec2(origin)) - glm::vec2(origin)) * (2.0f / map_size);
        projection[3].x += offset.x;
        projection[3].y += offset.y;
        maps[i] = projection * view;
    }
    return maps;
}

struct Box {
    glm::vec3 lo;
    glm::vec3 hi;
};

using Frustum = std::array<glm::vec4, 6>;

inline Frustum frustum_of(glm::mat4 const& m) {
    auto const row = [&m](int r) { return glm::vec4(m[0][r], m[1][r], m[2][r], m[3][r]); };
    return {row(3) + row(0), row(3) - row(0), row(3) + row(1), row(3) - row(1), row(2), row(3) - row(2)};
}

// The corner farthest along each plane's normal, out at the first plane that has it behind.
inline bool intersects(Frustum const& frustum, Box const& box) {
    for (glm::vec4 const& plane : frustum) {
        glm::vec3 const farthest(plane.x > 0.0f ? box.hi.x : box.lo.x, plane.y > 0.0f ? box.hi.y : box.lo.y,
                                 plane.z > 0.0f ? box.hi.z : box.lo.z);
        if (glm::dot(glm::vec3(plane), farthest) + plane.w < 0.0f) return false;
    }
    return true;
}

inline void masks(std::span<Frustum const> frustums, std::span<Box const> boxes, std::span<std::uint16_t> masks) {
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        unsigned mask = 0;
        for (std::size_t m = 0; m < frustums.size(); ++m)
            if (intersects(frustums[m], boxes[i])) mask |= 1u << m;
        masks[i] = static_cast<std::uint16_t>(mask);
    }
}

// Eight corners, and where some of them lie behind w_min, the twelve edges cut there.
inline Box region(glm::mat4 const& m, std::span<Box const> boxes, float w_min) {
    Box bounds{glm::vec3(std::numeric_limits<float>::max()), glm::vec3(std::numeric_limits<float>::lowest())};
    auto const add = [&bounds](glm::vec4 const& p) {
        glm::vec3 const ndc = glm::vec3(p) / p.w;
        bounds.lo = glm::min(bounds.lo, ndc);
        bounds.hi = glm::max(bounds.hi, ndc);
    };
    for (Box const& box : boxes) {
        std::array<glm::vec4, 8> corner;
        for (std::size_t i = 0; i < 8; ++i)
            corner[i] = m * glm::vec4(i & 1 ? box.hi.x : box.lo.x, i & 2 ? box.hi.y : box.lo.y,
                                      i & 4 ? box.hi.z : box.lo.z, 1.0f);
        for (std::size_t i = 0; i < 8; ++i) {
            if (corner[i].w >= w_min) add(corner[i]);
            for (std::size_t bit = 1; bit < 8; bit <<= 1) {
                std::size_t const j = i | bit;
                if (j == i || (corner[i].w >= w_min) == (corner[j].w >= w_min)) continue;
                add(glm::mix(corner[i], corner[j], (w_min - corner[i].w) / (corner[j].w - corner[i].w)));
            }
        }
    }
    return bounds;
}

// The vertex program of the thesis (3.1.3), line by line: to the world; to the light's clip space; along the light onto
// the plane; from there to the eye's clip space; and the light's z in the place of the eye's.
struct ThesisMap {
    glm::mat4 world, light_view, light_projection, eye_view, eye_projection;
    glm::vec3 light;
    glm::vec4 plane;
};

inline glm::vec4 vertex(ThesisMap const& map, glm::vec3 const& p_object) {
    glm::vec4 const p_world = map.world * glm::vec4(p_object, 1.0f);
    glm::vec4 const p_light = map.light_projection * (map.light_view * p_world);
    glm::vec3 const p = glm::vec3(p_world), normal = glm::vec3(map.plane);
    glm::vec3 const q = p - map.light * ((glm::dot(p, normal) + map.plane.w) / glm::dot(map.light, normal));
    glm::vec4 const q_eye = map.eye_projection * (map.eye_view * glm::vec4(q, 1.0f));
    return glm::vec4(q_eye.x, q_eye.y, p_light.z, q_eye.w);
}

// A program that is run once a vertex, as vertex programs are.
[[gnu::noinline]] inline glm::vec4 vertex_program(ThesisMap const& map, glm::vec3 const& p_object) {
    return vertex(map, p_object);
}

inline void vertices(ThesisMap const& map, std::span<glm::vec3 const> points, std::span<glm::vec4> clip) {
    for (std::size_t i = 0; i < points.size(); ++i) clip[i] = vertex_program(map, points[i]);
}

// One loop with all of it inside: at -O3 compilers take several vertices at once.
struct ThesisLoop : ThesisMap {};

inline void vertices(ThesisLoop const& map, std::span<glm::vec3 const> points, std::span<glm::vec4> clip) {
    for (std::size_t i = 0; i < points.size(); ++i) clip[i] = vertex(map, points[i]);
}

// The same loop with what does not change from vertex to vertex multiplied beforehand, and no world matrix.
struct FoldedThesisMap {
    glm::mat4 light_clip_from_world, eye_clip_from_world;
    glm::vec3 light;
    glm::vec4 plane;
};

inline FoldedThesisMap folded(ThesisMap const& map) {
    return {map.light_projection * map.light_view, map.eye_projection * map.eye_view, map.light, map.plane};
}

inline void vertices(FoldedThesisMap const& map, std::span<glm::vec3 const> points, std::span<glm::vec4> clip) {
    for (std::size_t i = 0; i < points.size(); ++i) {
        glm::vec3 const& p = points[i];
        float const height = glm::dot(glm::vec3(map.plane), p) + map.plane.w;
        glm::vec3 const on_plane = p - map.light * (height / glm::dot(glm::vec3(map.plane), map.light));
        glm::vec4 const seen = map.eye_clip_from_world * glm::vec4(on_plane, 1.0f);
        glm::vec4 const lit = map.light_clip_from_world * glm::vec4(p, 1.0f);
        clip[i] = glm::vec4(seen.x, seen.y, lit.z, seen.w);
    }
}

}  // namespace textbook
