// SPDX-License-Identifier: MIT
#include "examples/quality/quad_corners.hpp"

#include <shadowmath/fit_quad.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace shadowmath::quality {
namespace {

glm::dvec3 line(glm::dvec2 a, glm::dvec2 b) {
    return {a.y - b.y, b.x - a.x, a.x * b.y - a.y * b.x};
}

}  // namespace

double uniform(Random& random) {
    return double(random() >> 11) * 0x1p-53;
}

double normal(Random& random) {
    double const radius = std::sqrt(-2.0 * std::log(1.0 - uniform(random)));
    return radius * std::cos(6.283185307179586 * uniform(random));
}

Quad<double> quad_through(Corners const& c) {
    glm::dvec2 const middle = (c[0] + c[1] + c[2] + c[3]) / 4.0;
    std::array<glm::dvec2, 4> p{};
    for (std::size_t i = 0; i < 4; ++i) p[i] = c[i] - middle;
    QuadSides<double> sides{line(p[0], p[2]), line(p[1], p[3]), line(p[0], p[1]), line(p[2], p[3])};
    for (glm::dvec3& side : sides)
        if (side.z < 0.0) side = -side;
    return moved(quad_between(sides, 1e6, 1e6), middle);
}

Corners rectangle_around(std::vector<Sample> const& samples, std::vector<std::size_t> const& which,
                         double usable_texels) {
    glm::dvec2 mean(0.0);
    for (std::size_t const i : which) mean += samples[i].pixel.place / double(which.size());
    double xx = 0.0, xy = 0.0, yy = 0.0;
    for (std::size_t const i : which) {
        glm::dvec2 const d = samples[i].pixel.place - mean;
        xx += d.x * d.x, xy += d.x * d.y, yy += d.y * d.y;
    }
    double const principal = 0.5 * std::atan2(2.0 * xy, xx - yy);
    Corners best{};
    double least = outside;
    for (int turn = 0; turn < 16; ++turn) {
        double const angle = principal + 1.5707963267948966 * turn / 16.0;
        glm::dvec2 const a(std::cos(angle), std::sin(angle)), b(-a.y, a.x);
        glm::dvec2 lo(outside), hi(-outside);
        for (std::size_t const i : which) {
            glm::dvec2 const d = samples[i].pixel.place - mean, at(glm::dot(a, d), glm::dot(b, d));
            lo = glm::min(lo, at);
            hi = glm::max(hi, at);
        }
        glm::dvec2 const room = (hi - lo) * 0.002 + std::max(hi.x - lo.x, hi.y - lo.y) * 1e-5 + 1e-6;
        lo -= room;
        hi += room;
        auto const at = [&](double x, double y) { return mean + a * x + b * y; };
        Corners const corners{at(lo.x, lo.y), at(hi.x, lo.y), at(lo.x, hi.y), at(hi.x, hi.y)};
        Quad<double> const quad = quad_through(corners);
        if (!quad.visible) continue;
        double price = 0.0;
        std::size_t const stride = 1 + which.size() / 64;
        for (std::size_t k = 0; k < which.size(); k += stride)
            price += price_of(major_in(quad, usable_texels, samples[which[k]].pixel));
        if (price < least) {
            least = price;
            best = corners;
        }
    }
    return best;
}

Corners moved_at_random(Corners const& c, double step, Random& random) {
    static constexpr std::array<std::array<std::size_t, 2>, 4> ends{{{0, 2}, {1, 3}, {0, 1}, {2, 3}}};
    Corners moved = c;
    glm::dvec2 const along = 0.5 * (c[1] - c[0] + c[3] - c[2]), up = 0.5 * (c[2] - c[0] + c[3] - c[1]);
    auto const shift = [&] { return along * (step * normal(random)) + up * (step * normal(random)); };
    switch (random() % 4) {
        case 0: moved[random() % 4] += shift(); break;
        case 1: {  // a side, outward or inward
            std::size_t const side = random() % 4;
            glm::dvec2 const by = (side < 2 ? along : up) * (step * normal(random));
            for (std::size_t const end : ends[side]) moved[end] += by;
            break;
        }
        case 2: {  // a side's length
            auto const& [a, b] = ends[random() % 4];
            glm::dvec2 const by = (c[b] - c[a]) * (step * normal(random));
            moved[a] -= by;
            moved[b] += by;
            break;
        }
        default: {
            glm::dvec2 const by = shift(), middle = (c[0] + c[1] + c[2] + c[3]) / 4.0;
            double const grow = 1.0 + step * normal(random), turn = step * normal(random);
            for (glm::dvec2& corner : moved) {
                glm::dvec2 const d = (corner - middle) * grow;
                corner = middle + by + glm::dvec2(d.x - turn * d.y, d.y + turn * d.x);
            }
        }
    }
    return moved;
}

}  // namespace shadowmath::quality
