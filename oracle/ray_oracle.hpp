// SPDX-License-Identifier: MIT
//
// The truth that pictures are judged by: hard shadows by ray tracing (Embree 3, robust traversal).
//
// A point is lit when its surface faces the light and no caster crosses the segment from the point to the light.
// Points are what a G-buffer holds, float positions, so a ray starts a little off the surface; see ray_offset.
// Anything that is not finite is answered without a ray: a point as sky, a normal or a light as facing away.
#pragma once

#include "backends/backend.hpp"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace shadowmath::oracle {

enum class Truth : std::uint8_t { sky, facing_away, shadowed, lit };

// How far off the surface, in metres, a shadow ray starts.
// A position interpolated in float errs by some roundings of its largest coordinate, 2^-24 relative each: 32 of them
// are allowed for, and never less than 0.05 mm. That is 0.2 mm at 100 m from the origin and 2 mm at 1 km, thinner than
// the thinnest wire of the scenes.
[[nodiscard]] double ray_offset(glm::dvec3 point) noexcept;

struct Hit {
    double distance = 0.0;       // metres, along a unit direction
    std::uint32_t triangle = 0;  // of Scene::indices, counted in threes
    double u = 0.0;              // weight of the triangle's second vertex
    double v = 0.0;              // weight of the third
    bool back_face = false;      // seen from the side from which the triangle winds clockwise
};

class RayOracle {
public:
    // Copies the triangles of the objects that cast, but for those with a bad index or a position that is not finite.
    // Throws std::runtime_error when Embree cannot start.
    explicit RayOracle(backend::Scene const& scene);
    ~RayOracle();
    RayOracle(RayOracle&&) noexcept;
    RayOracle& operator=(RayOracle&&) noexcept;

    // light: (direction toward the light, 0) or (position, 1), world. normal: geometric, toward the eye, any length.
    [[nodiscard]] Truth truth(glm::dvec3 point, glm::dvec3 normal, glm::dvec4 light) const;
    [[nodiscard]] bool lit(glm::dvec3 point, glm::dvec3 normal, glm::dvec4 light) const {
        return truth(point, normal, light) == Truth::lit;
    }

    // 1 where lit, else 0. The spans are equally long.
    [[nodiscard]] std::vector<std::uint8_t> lit(std::span<glm::dvec3 const> points, std::span<glm::dvec3 const> normals,
                                                glm::dvec4 light, int threads = 2) const;

    // The G-buffer of backend::Frame, pixel by pixel; position.w = -2 is sky.
    [[nodiscard]] backend::Image<Truth> truth(backend::Image<backend::Texel4> const& position,
                                              backend::Image<backend::Texel4> const& normal, glm::dvec4 light,
                                              int threads = 2) const;

    // The first caster along a ray; none also for a ray that is not finite.
    [[nodiscard]] std::optional<Hit> first_hit(glm::dvec3 origin, glm::dvec3 direction) const;

private:
    struct Embree;
    std::unique_ptr<Embree> embree_;
};

}  // namespace shadowmath::oracle
