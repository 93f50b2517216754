// SPDX-License-Identifier: MIT
//
// The land under the town: streets on a bent grid, kerbs, gardens, then fields and hills out to 1 km.
//
// Plan coordinates (u, v) are straight: streets are strips of u or of v. world() bends them into the world.
// One grid whose lines are the kerbs themselves covers everything, so that no two pieces of ground ever overlap.
#pragma once

#include "scenes/mesh_builder.hpp"

namespace shadowmath::scenes {

class TownGround {
public:
    static constexpr double pitch_u = 58.0;  // from street to street, metres
    static constexpr double pitch_v = 46.0;
    static constexpr double half_street = 4.0;
    static constexpr double kerb = 0.14;     // height of the pavement over the street
    static constexpr double pavement = 2.0;  // width
    static constexpr double edge = 1000.0;   // the land ends here

    // Odd counts, so that the block in the middle is the square.
    TownGround(int blocks_u, int blocks_v, std::uint64_t seed)
        : blocks_u_(blocks_u), blocks_v_(blocks_v), seed_(seed) {}

    [[nodiscard]] int blocks_u() const { return blocks_u_; }
    [[nodiscard]] int blocks_v() const { return blocks_v_; }
    [[nodiscard]] double half_u() const { return 0.5 * blocks_u_ * pitch_u; }  // the outermost streets run here
    [[nodiscard]] double half_v() const { return 0.5 * blocks_v_ * pitch_v; }
    [[nodiscard]] double land(double u, double v) const;  // height of the streets
    [[nodiscard]] glm::dvec3 world(double u, double v, double lift = 0.0) const;
    [[nodiscard]] Frame frame(double u, double v, double yaw_radians = 0.0, double lift = 0.0) const;

    enum class Cover { street, pavement, square, garden, field };
    [[nodiscard]] Cover cover(double u, double v) const;

    // detail 0, 1, 2: coarser or finer cells.
    void add_to(MeshBuilder& mesh, int detail) const;

private:
    [[nodiscard]] std::vector<double> lines(int blocks, double pitch, int detail) const;
    [[nodiscard]] glm::dvec3 colour(Cover cover, double u, double v) const;

    int blocks_u_;
    int blocks_v_;
    std::uint64_t seed_;
};

}  // namespace shadowmath::scenes
