// SPDX-License-Identifier: MIT
#include "scenes/plants.hpp"
#include "scenes/scenes.hpp"
#include "scenes/sun.hpp"

#include <glm/common.hpp>

#include <algorithm>

namespace shadowmath::scenes {

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double land_edge = 75.0;

class Forest {
public:
    Forest(SceneSize size, std::uint64_t seed) : detail_(static_cast<int>(size)), random_(seed), seed_(seed) {}

    NamedScene build() {
        add_land();
        add_trees();
        add_undergrowth();
        add_deadwood();
        return {mesh_.finish("forest"), views()};
    }

private:
    static constexpr double clearing_radius = 8.0;

    // The path winds along z through the clearing at the origin.
    [[nodiscard]] static double path_x(double z) { return 5.0 * std::sin(z / 17.0) * (1.0 - std::exp(-z * z / 300.0)); }
    [[nodiscard]] static double off_path(double x, double z) { return std::abs(x - path_x(z)); }
    [[nodiscard]] static double openness(double x, double z) {  // 1 on the path and in the clearing, 0 in the wood
        return std::max(1.0 - glm::smoothstep(1.0, 3.2, off_path(x, z)),
                        1.0 - glm::smoothstep(clearing_radius * 0.6, clearing_radius, std::hypot(x, z)));
    }

    [[nodiscard]] double land(double x, double z) const {
        glm::dvec3 const p{x, 0.0, z};
        double const swell = 3.4 * rough_noise(p / 38.0, 2, seed_ + 1);
        double const rough = 0.28 * rough_noise(p / 2.4, 3, seed_ + 2) * (1.0 - 0.85 * openness(x, z));
        return swell + rough - 0.25 * (1.0 - glm::smoothstep(0.6, 2.4, off_path(x, z)));
    }

    void stand(double x, double z, double yaw, double lift = 0.0) {
        mesh_.frame = standing_at({x, land(x, z) + lift, z}, yaw);
    }

    void add_land() {
        int const cells = detail_ == 0 ? 56 : detail_ == 1 ? 98 : 280;
        int const tiles = 7;
        int const per_tile = cells / tiles;
        auto const colour = [&](glm::dvec3 p) {
            double const open = openness(p.x, p.z);
            double const trodden = 1.0 - glm::smoothstep(0.5, 1.5, off_path(p.x, p.z));
            glm::dvec3 const floor = glm::mix(srgb(0x7A6A48), srgb(0x6C8244), 0.5 + 0.5 * noise(p / 4.3, seed_ + 3));
            glm::dvec3 const green = glm::mix(floor, srgb(0x8FA552), open);
            return glm::mix(green, srgb(0xB09A74), trodden) * (1.0 + 0.14 * noise(p / 1.1, seed_ + 4));
        };
        auto const normal = [&](glm::dvec3 p) {
            double const d = 0.2;
            return glm::dvec3(land(p.x - d, p.z) - land(p.x + d, p.z), 2.0 * d,
                              land(p.x, p.z - d) - land(p.x, p.z + d));
        };
        mesh_.frame = {};
        for (int tile = 0; tile < tiles * tiles; ++tile) {
            auto const point = [&](int i, int j) {
                double const x = -land_edge + 2.0 * land_edge * (i + per_tile * (tile % tiles)) / cells;
                double const z = -land_edge + 2.0 * land_edge * (j + per_tile * (tile / tiles)) / cells;
                return glm::dvec3(x, land(x, z), z);
            };
            mesh_.coloured_patch(per_tile, point, normal, colour);
            mesh_.end_object();
        }
    }

    // Trees keep a distance to each other, to the path and to the clearing; a few pines stand among them.
    void add_trees() {
        int const wanted = detail_ == 0 ? 80 : detail_ == 1 ? 170 : 260;
        int const leaves = detail_ == 0 ? 60 : detail_ == 1 ? 130 : 1350;
        double const apart = detail_ == 0 ? 5.2 : 4.0;
        std::vector<glm::dvec2> standing;
        for (int tries = 0; tries < 40 * wanted && static_cast<int>(standing.size()) < wanted; ++tries) {
            double const x = random_.between(-land_edge + 3.0, land_edge - 3.0);
            double const z = random_.between(-land_edge + 3.0, land_edge - 3.0);
            glm::dvec2 const here{x, z};
            bool const crowded =
                std::ranges::any_of(standing, [&](glm::dvec2 q) { return glm::length(q - here) < apart; });
            if (crowded || off_path(x, z) < 2.6 || std::hypot(x, z) < clearing_radius) continue;
            if (random_.chance(0.85 * glm::smoothstep(22.0, 70.0, std::hypot(x, z))))
                continue;  // denser where one looks
            standing.push_back(here);
            double const yaw = random_.between(0.0, 2.0 * pi);
            double const height = random_.between(10.0, 18.0);
            stand(x, z, yaw);
            if (random_.chance(0.2))
                add_conifer(mesh_, random_, height * 1.15, detail_);
            else
                add_leafy_tree(mesh_, random_, height, leaves, detail_);
            mesh_.end_object();
        }
    }

    void add_undergrowth() {
        int const ferns = detail_ == 0 ? 120 : detail_ == 1 ? 480 : 3000;
        for (int i = 0; i < ferns; ++i) {
            double const x = random_.between(-45.0, 45.0);
            double const z = random_.between(-45.0, 45.0);
            double const yaw = random_.between(0.0, 2.0 * pi);
            double const height = random_.between(0.25, 0.8);
            if (off_path(x, z) < 1.3 || (openness(x, z) > 0.5 && random_.chance(0.6))) continue;
            stand(x, z, yaw);
            add_fern(mesh_, random_, height, 7 + 3 * detail_);
            if (i % 12 == 11) mesh_.end_object();
        }
        mesh_.end_object();
        for (int i = 0; i < 30 + 20 * detail_; ++i) {
            double const x = random_.between(-60.0, 60.0);
            double const z = random_.between(-60.0, 60.0);
            double const height = random_.between(0.5, 1.3);
            if (openness(x, z) > 0.3) continue;
            stand(x, z, 0.0);
            add_bush(mesh_, random_, height, detail_);
            mesh_.end_object();
        }
    }

    // Fallen trunks, stumps, boulders and a ring of stones around logs in the clearing.
    void add_deadwood() {
        for (int i = 0; i < 14; ++i) {
            double const x = random_.between(-40.0, 40.0);
            double const z = random_.between(-40.0, 40.0);
            double const angle = random_.between(0.0, 2.0 * pi);
            double const length = random_.between(3.0, 7.0);
            double const radius = random_.between(0.14, 0.32);
            if (off_path(x, z) < 5.5) continue;
            double const dx = std::cos(angle) * length / 2;
            double const dz = std::sin(angle) * length / 2;
            mesh_.frame = {};
            mesh_.colour = tinted(srgb(0x6E563F), random_, 0.15);
            std::array const log{glm::dvec3(x - dx, land(x - dx, z - dz) + radius * 0.7, z - dz),
                                 glm::dvec3(x + dx, land(x + dx, z + dz) + radius * 0.5, z + dz)};
            mesh_.tube(log, radius, radius * 0.8, 8 + 6 * detail_);
            mesh_.end_object();
        }
        for (int i = 0; i < 26; ++i) {
            double const x = random_.between(-45.0, 45.0);
            double const z = random_.between(-45.0, 45.0);
            double const size = random_.between(0.2, 1.1);
            std::uint64_t const shape = random_.bits();
            if (off_path(x, z) < 2.5) continue;
            stand(x, z, 0.0, 0.12 * size);
            mesh_.colour = tinted(srgb(0x8B897C), random_, 0.15);
            mesh_.blob({}, {size, 0.65 * size, 0.85 * size}, 3 + 2 * detail_, 0.3, shape, false);
            mesh_.end_object();
        }
        double const fire_x = -4.5;
        double const fire_z = 2.0;
        for (int k = 0; k < 9; ++k) {
            double const angle = 2.0 * pi * k / 9;
            std::uint64_t const shape = random_.bits();
            stand(fire_x + 0.8 * std::cos(angle), fire_z + 0.8 * std::sin(angle), angle, 0.05);
            mesh_.colour = tinted(srgb(0x8F8C82), random_, 0.15);
            mesh_.blob({}, {0.20, 0.15, 0.17}, 3 + detail_, 0.3, shape, false);
        }
        for (double const angle : {0.3, 2.2, 4.4}) {
            double const x = fire_x + 2.3 * std::cos(angle);
            double const z = fire_z + 2.3 * std::sin(angle);
            stand(x, z, -angle, 0.22);
            mesh_.colour = tinted(srgb(0x7A6047), random_, 0.1);
            std::array const log{glm::dvec3(0.0, 0.0, -1.1), glm::dvec3(0.0, 0.0, 1.1)};
            mesh_.tube(log, 0.24, 0.22, 8 + 6 * detail_);
        }
        mesh_.end_object();
    }

    [[nodiscard]] std::vector<View> views() const {
        auto const at = [&](double x, double z, double lift) { return glm::dvec3(x, land(x, z) + lift, z); };
        auto const on_path = [&](double z, double lift) { return at(path_x(z), z, lift); };
        return {
            view_toward("street", on_path(34.0, 1.7), on_path(8.0, 2.6), 58.0, 90.0, sun_travel(35.0, 200.0)),
            view_toward("hill", at(-34.0, 46.0, 27.0), at(4.0, -6.0, 2.0), 50.0, 120.0, sun_travel(35.0, 110.0)),
            view_toward("down", at(2.0, 9.0, 15.0), at(-2.0, 0.0, 0.0), 58.0, 60.0, sun_travel(60.0, 150.0)),
            view_toward("up", on_path(22.0, 1.5), at(4.0, 9.0, 9.0), 64.0, 60.0, sun_travel(35.0, 330.0)),
            view_toward("low_sun", at(6.5, -1.5, 1.7), at(-12.0, 1.0, 2.6), 60.0, 80.0, sun_travel(12.0, 172.0)),
            view_toward("side", at(-1.5, 8.5, 1.7), at(0.5, -14.0, 2.2), 58.0, 80.0, sun_travel(20.0, 5.0)),
            view_toward("noon", on_path(-30.0, 1.7), on_path(-6.0, 2.0), 56.0, 80.0, sun_travel(80.0, 60.0)),
        };
    }

    int detail_;
    Random random_;
    std::uint64_t seed_;
    MeshBuilder mesh_;
};

}  // namespace

NamedScene make_forest(SceneSize size, std::uint64_t seed) {
    return Forest(size, seed).build();
}

}  // namespace shadowmath::scenes
