// SPDX-License-Identifier: MIT
#include "scenes/furniture.hpp"
#include "scenes/house.hpp"
#include "scenes/plants.hpp"
#include "scenes/scenes.hpp"
#include "scenes/sun.hpp"
#include "scenes/town_ground.hpp"

#include <algorithm>

namespace shadowmath::scenes {

namespace {

constexpr double pi = 3.14159265358979323846;

class Town {
public:
    Town(SceneSize size, std::uint64_t seed)
        : detail_(static_cast<int>(size)), random_(seed), ground_(size == SceneSize::small    ? 3
                                                                  : size == SceneSize::medium ? 5
                                                                                              : 9,
                                                                  size == SceneSize::large ? 5 : 3, seed) {}

    NamedScene build() {
        ground_.add_to(mesh_, detail_);
        int const half_u = ground_.blocks_u() / 2;
        int const half_v = ground_.blocks_v() / 2;
        for (int j = -half_v; j <= half_v; ++j)
            for (int i = -half_u; i <= half_u; ++i) {
                if (i == 0 && j == 0)
                    add_square();
                else if (i == 1 && j == 0)
                    add_church_block();
                else
                    add_block(i, j);
            }
        add_street_furniture();
        add_country();
        return {mesh_.finish("town"), views()};
    }

private:
    static constexpr double block_u = TownGround::pitch_u / 2 - TownGround::half_street - TownGround::pavement;
    static constexpr double block_v = TownGround::pitch_v / 2 - TownGround::half_street - TownGround::pavement;

    void stand(double u, double v, double yaw, double lift = TownGround::kerb) {
        mesh_.frame = ground_.frame(u, v, yaw, lift);
    }

    void add_tree(double u, double v, double lift) {
        double const yaw = random_.between(0.0, 2.0 * pi);
        double const height = random_.between(5.0, 9.0);
        stand(u, v, yaw, lift);
        add_broadleaf(mesh_, random_, height, std::min(detail_, 1));
        mesh_.end_object();
    }

    // Houses shoulder to shoulder along both long sides, gardens between them.
    void add_block(int i, int j) {
        double const centre_u = i * TownGround::pitch_u;
        double const centre_v = j * TownGround::pitch_v;
        double const rank = std::max(std::abs(i), std::abs(j));
        for (double const side : {1.0, -1.0}) {
            double u = -block_u + random_.between(0.3, 1.5);
            while (u < block_u - 6.0) {
                HousePlan plan;
                plan.width = std::min(random_.between(7.0, 11.5), block_u - u);
                plan.depth = random_.between(8.0, 10.5);
                plan.storeys = rank < 2.0 ? 2 + random_.below(2) : 1 + random_.below(2) + random_.below(2);
                plan.gable_in_front = plan.width < 8.8 && random_.chance(0.4);
                plan.detail = detail_;
                double const setback = random_.between(0.1, 0.7);
                stand(centre_u + u + plan.width / 2, centre_v + side * (block_v - setback), side > 0.0 ? 0.0 : pi);
                if (plan.width > 6.0) add_house(mesh_, random_, plan);
                mesh_.end_object();
                double const gap = random_.chance(0.55) ? random_.between(0.5, 0.9) : random_.between(2.5, 4.5);
                u += plan.width + gap;
            }
        }
        int const trees = 1 + detail_ + random_.below(2);
        for (int k = 0; k < trees; ++k) {
            double const u = random_.between(-0.85, 0.85) * block_u;
            double const v = random_.between(-0.2, 0.2) * block_v;
            add_tree(centre_u + u, centre_v + v, TownGround::kerb);
        }
        mesh_.frame = {};
        for (double const end : {1.0, -1.0}) {  // garden fences close the short sides
            double const u = centre_u + end * (block_u - 0.4);
            for (double v = -5.4; v < 5.0; v += 5.4)
                add_fence(mesh_, random_, ground_.world(u, centre_v + v, TownGround::kerb),
                          ground_.world(u, centre_v + v + 5.4, TownGround::kerb), detail_);
        }
        mesh_.end_object();
    }

    void add_square() {
        stand(-7.0, 2.0, 0.0);
        add_fountain(mesh_, detail_);
        mesh_.end_object();
        for (int k = 0; k < 3 + 2 * detail_; ++k) {
            double const u = -19.0 + 4.6 * (k % 5);
            double const v = (k < 5 ? -13.5 : 14.5);
            double const turn = random_.between(-0.12, 0.12);
            stand(u, v, (k < 5 ? 0.0 : pi) + turn);
            add_stall(mesh_, random_, detail_);
            mesh_.end_object();
        }
        for (double const u : {-16.0, 2.0})
            for (double const v : {-6.0, 10.0}) {
                stand(u, v, v > 0.0 ? pi : 0.0);
                add_bench(mesh_);
                mesh_.end_object();
            }
        for (double const u : {-21.5, 16.0, 21.0})
            for (double const v : {-15.0, 15.0}) add_tree(u, v, TownGround::kerb);
        mesh_.frame = {};
        double const high = 6.3;
        for (int k = 0; k < 2 + 2 * detail_; ++k) {  // bunting from the middle to the corners
            double const angle = 2.0 * pi * (k + 0.35) / (2 + 2 * detail_);
            add_bunting(mesh_, ground_.world(-7.0, 2.0, high + 0.6),
                        ground_.world(-7.0 + 20.0 * std::cos(angle), 2.0 + 15.0 * std::sin(angle), high), 1.1,
                        14 + 4 * detail_);
            mesh_.end_object();
        }
        std::array const mast{ground_.world(-7.0, 2.0, 3.8), ground_.world(-7.0, 2.0, high + 1.1)};
        mesh_.colour = srgb(0x3B3F44);
        mesh_.tube(mast, 0.04, 0.03, 8);
        for (int k = 0; k < 2 + 2 * detail_; ++k) {
            double const angle = 2.0 * pi * (k + 0.35) / (2 + 2 * detail_);
            double const u = -7.0 + 20.0 * std::cos(angle);
            double const v = 2.0 + 15.0 * std::sin(angle);
            std::array const pole{ground_.world(u, v, -0.3), ground_.world(u, v, high + 0.15)};
            mesh_.tube(pole, 0.06, 0.04, 8);
        }
        mesh_.end_object();
    }

    void add_church_block() {
        stand(TownGround::pitch_u - block_u + 4.0, 0.0, -pi / 2);
        add_church(mesh_, random_, detail_);
        mesh_.end_object();
        for (double const v : {-12.5, 12.5})
            for (double u = -14.0; u <= 20.0; u += 8.5) {
                stand(TownGround::pitch_u + u, v, 0.0);
                double const height = random_.between(8.0, 12.0);
                add_cypress(mesh_, random_, height, detail_);
                mesh_.end_object();
            }
    }

    // Along every pavement: lamps, bollards at the crossings, railings, benches, a bunting across the street.
    void add_street_furniture() {
        int const half_u = ground_.blocks_u() / 2;
        int const half_v = ground_.blocks_v() / 2;
        double const kerb_in = TownGround::half_street + 0.35;
        for (int j = -half_v; j <= half_v + 1; ++j) {
            double const street = (j - 0.5) * TownGround::pitch_v;
            for (int i = -half_u; i <= half_u; ++i) {
                double const centre = i * TownGround::pitch_u;
                for (double const side : {1.0, -1.0}) {
                    double const v = street + side * kerb_in;
                    stand(centre + 0.45 * side * block_u, v, side > 0.0 ? pi : 0.0);
                    add_lamp_post(mesh_, detail_);
                    mesh_.end_object();
                    for (double const end : {1.0, -1.0}) {
                        for (int k = 0; k < 1 + std::min(detail_, 1); ++k) {
                            stand(centre + end * (block_u - 1.3 * k), v, 0.0);
                            add_bollard(mesh_, detail_);
                        }
                        mesh_.end_object();
                    }
                    if (std::abs(i) >= std::max(detail_, 1)) continue;
                    mesh_.frame = {};
                    for (int k = 0; k < 2; ++k)
                        add_railing(mesh_, ground_.world(centre - 4.0 + 4.0 * k, v, TownGround::kerb),
                                    ground_.world(centre + 4.0 * k, v, TownGround::kerb), detail_ == 0 ? 0.3 : 0.14,
                                    detail_);
                    mesh_.end_object();
                }
                if (std::abs(i) > 1 || std::abs(j) > 2) continue;
                for (double const u : {-8.0, 6.0}) {
                    mesh_.frame = {};
                    add_bunting(mesh_, ground_.world(centre + u, street - 6.5, 5.2),
                                ground_.world(centre + u + 2.0, street + 6.5, 5.2), 0.7, 12);
                    mesh_.end_object();
                }
            }
        }
    }

    // Farms, trees and rocks out to 500 m and more.
    void add_country() {
        auto const somewhere = [&](double from, double to) {
            double const angle = random_.between(0.0, 2.0 * pi);
            double const out = std::sqrt(random_.unit()) * (to - from);
            double const scale = 1.0 / std::max(std::abs(std::cos(angle)), std::abs(std::sin(angle)));
            return glm::dvec2((ground_.half_u() + from + out) * std::cos(angle) * std::min(scale, 1.25),
                              (ground_.half_v() + from + out) * std::sin(angle) * std::min(scale, 1.25));
        };
        auto const on_road = [&](glm::dvec2 p) { return std::abs(p.x + TownGround::pitch_u / 2) < 14.0; };
        int const farms = 8 + 14 * detail_;
        for (int k = 0; k < farms; ++k) {
            glm::dvec2 const p = somewhere(30.0, 330.0);
            double const yaw = random_.between(0.0, 2.0 * pi);
            HousePlan plan;
            plan.width = random_.between(9.0, 14.0);
            plan.depth = random_.between(8.0, 10.0);
            plan.storeys = 1 + random_.below(2);
            plan.detail = std::max(detail_ - 1, 0);
            if (on_road(p)) continue;
            stand(p.x, p.y, yaw, 0.3);
            add_house(mesh_, random_, plan);
            mesh_.end_object();
        }
        int const groves = 8 + 18 * detail_;
        for (int g = 0; g < groves; ++g) {
            glm::dvec2 const centre = somewhere(25.0, 520.0);
            bool const conifers = random_.chance(0.45);
            int const trees = 3 + random_.below(4 + 3 * detail_);
            for (int k = 0; k < trees; ++k) {
                double const du = random_.between(-18.0, 18.0);
                double const dv = random_.between(-18.0, 18.0);
                double const yaw = random_.between(0.0, 2.0 * pi);
                double const height = random_.between(7.0, 13.0);
                glm::dvec2 const p = centre + glm::dvec2(du, dv);
                if (on_road(p) || (std::abs(p.x) < ground_.half_u() + 8.0 && std::abs(p.y) < ground_.half_v() + 8.0))
                    continue;
                stand(p.x, p.y, yaw, 0.0);
                if (conifers)
                    add_conifer(mesh_, random_, height * 1.25, 0);
                else
                    add_broadleaf(mesh_, random_, height, 0);
                mesh_.end_object();
            }
        }
        for (int k = 0; k < 12 + 20 * detail_; ++k) {
            glm::dvec2 const p = somewhere(30.0, 560.0);
            double const size = random_.between(0.6, 3.5);
            std::uint64_t const shape = random_.bits();
            if (on_road(p)) continue;
            stand(p.x, p.y, 0.0, size * 0.25);
            mesh_.colour = tinted(srgb(0x9A9488), random_, 0.15);
            mesh_.blob({}, {size, size * 0.8, size * 0.9}, 3 + detail_, 0.30, shape, false);
            mesh_.end_object();
        }
    }

    [[nodiscard]] std::vector<View> views() const {
        auto const at = [&](double u, double v, double lift) { return ground_.world(u, v, lift); };
        double const street = -0.5 * TownGround::pitch_v;
        double const lane = -1.5 * TownGround::pitch_v;
        double const u = ground_.half_u();
        double const v = ground_.half_v();
        return {
            view_toward("street", at(-30.0, street + 1.4, 1.7), at(20.0, street - 1.5, 3.4), 58.0, 180.0,
                        sun_travel(24.0, 105.0)),
            view_toward("square", at(-21.5, 9.0, 1.75), at(14.0, -3.0, 6.8), 62.0, 150.0, sun_travel(35.0, 165.0)),
            view_toward("hill", at(-u - 60.0, v + 62.0, 44.0), at(10.0, -10.0, 4.0), 46.0, 600.0,
                        sun_travel(35.0, 20.0)),
            view_toward("down", at(-32.0, 32.0, 52.0), at(-4.0, -2.0, 0.0), 52.0, 200.0, sun_travel(60.0, 150.0)),
            view_toward("up", at(28.5, -6.0, 1.6), at(38.5, 0.5, 11.5), 66.0, 160.0, sun_travel(35.0, 200.0)),
            view_toward("low_sun", at(-33.0, v + 44.0, 3.2), at(8.0, 0.0, 8.0), 54.0, 250.0, sun_travel(12.0, -72.0)),
            view_toward("side", at(-22.5, 11.0, 1.75), at(20.0, 1.0, 5.0), 60.0, 150.0, sun_travel(20.0, -80.0)),
            view_toward("noon", at(-20.0, lane - 3.6, 8.0), at(26.0, lane + 9.0, 2.6), 56.0, 300.0,
                        sun_travel(80.0, 40.0)),
        };
    }

    int detail_;
    Random random_;
    TownGround ground_;
    MeshBuilder mesh_;
};

}  // namespace

NamedScene make_town(SceneSize size, std::uint64_t seed) {
    return Town(size, seed).build();
}

}  // namespace shadowmath::scenes
