// SPDX-License-Identifier: MIT
#include "scenes/column.hpp"
#include "scenes/furniture.hpp"
#include "scenes/plants.hpp"
#include "scenes/scenes.hpp"
#include "scenes/sun.hpp"

#include <glm/common.hpp>

#include <algorithm>

namespace shadowmath::scenes {

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr double half_pi = pi / 2;

// The court: x from -court_x to court_x, z likewise; its floor at y = 0. Columns stand around it on a platform.
constexpr double court_x = 30.0;
constexpr double court_z = 19.0;
constexpr double platform = 0.75;  // five steps of 15 cm above the floor
constexpr double gallery = 5.2;    // from the front of the columns to the back wall
constexpr double column_height = 7.2;
constexpr double land_edge = 62.0;

class Colonnade {
public:
    Colonnade(SceneSize size, std::uint64_t seed) : detail_(static_cast<int>(size)), random_(seed), seed_(seed) {}

    NamedScene build() {
        add_land();
        add_paving();
        for (int side = 0; side < 4; ++side) add_side(side);
        add_roof();
        add_middle();
        add_flags_and_wires();
        add_surroundings();
        return {mesh_.finish("colonnade"), views()};
    }

private:
    static double land(double x, double z, std::uint64_t seed) {
        double const outside = std::max(std::abs(x) - court_x - 12.0, std::abs(z) - court_z - 12.0);
        double const roll = 2.6 * rough_noise(glm::dvec3(x, 0.0, z) / 24.0, 3, seed);
        return -0.35 + glm::smoothstep(0.0, 16.0, outside) * (roll + 0.12 * std::max(outside, 0.0));
    }

    void add_land() {
        int const cells = detail_ == 0 ? 24 : detail_ == 1 ? 48 : 96;
        int const tiles = 4;
        mesh_.frame = {};
        for (int tile = 0; tile < tiles * tiles; ++tile) {
            auto const point = [&](int i, int j) {
                double const x = -land_edge + 2.0 * land_edge * (i + cells / tiles * (tile % tiles)) / cells;
                double const z = -land_edge + 2.0 * land_edge * (j + cells / tiles * (tile / tiles)) / cells;
                return glm::dvec3(x, land(x, z, seed_), z);
            };
            auto const colour = [&](glm::dvec3 p) {
                double const dry = 0.5 + 0.5 * noise(p / 11.0, seed_ + 1);
                return glm::mix(srgb(0x8F9D58), srgb(0xC4B078), dry) * (1.0 + 0.12 * noise(p / 1.9, seed_ + 2));
            };
            auto const normal = [&](glm::dvec3 p) {
                double const d = 0.25;
                return glm::dvec3(land(p.x - d, p.z, seed_) - land(p.x + d, p.z, seed_), 2.0 * d,
                                  land(p.x, p.z - d, seed_) - land(p.x, p.z + d, seed_));
            };
            mesh_.coloured_patch(cells / tiles, point, normal, colour);
            mesh_.end_object();
        }
    }

    // Slabs of slightly different height and tone, with open joints.
    void add_paving() {
        double const slab = detail_ == 0 ? 4.0 : detail_ == 1 ? 2.0 : 0.75;
        static std::array const tones{srgb(0xD9C8A5), srgb(0xCDBB98), srgb(0xE0D2B4), srgb(0xC7B18C)};
        mesh_.frame = {};
        mesh_.colour = srgb(0x8A7A62);
        mesh_.box({-court_x, -0.6, -court_z}, {court_x, -0.03, court_z});
        mesh_.end_object();
        int const across = static_cast<int>(2.0 * court_x / slab);
        int const along = static_cast<int>(2.0 * court_z / slab);
        int const strip = std::max(1, 300 / along);
        for (int i = 0; i < across; ++i) {
            for (int j = 0; j < along; ++j) {
                glm::dvec3 const tone = random_.pick(tones);
                mesh_.colour = tinted(tone, random_, 0.06);
                double const x = -court_x + slab * i;
                double const z = -court_z + slab * j;
                double const top = random_.between(-0.006, 0.006);
                mesh_.box({x + 0.012, -0.05, z + 0.012}, {x + slab - 0.012, top, z + slab - 0.012});
            }
            if ((i + 1) % strip == 0) mesh_.end_object();
        }
        mesh_.end_object();
    }

    [[nodiscard]] static Frame side_frame(int side) { return standing_at({}, half_pi * side); }  // z out of the court
    [[nodiscard]] static double reach(int side) { return side % 2 == 0 ? court_z : court_x; }
    [[nodiscard]] static double half_span(int side) { return side % 2 == 0 ? court_x : court_z; }

    // One side of the court: platform and steps, columns, the beam they carry, the wall behind.
    void add_side(int side) {
        Frame const frame = side_frame(side);
        double const z = reach(side);
        double const half = half_span(side);
        double const end = half + gallery + 1.2;
        mesh_.frame = frame;

        for (int step = 0; step < 5; ++step) {
            mesh_.colour = tinted(srgb(0xDCCDAE), random_, 0.04);
            double const in = 0.38 * (4 - step);
            double const top = 0.15 * (step + 1);
            double const front = z + 0.2 - in;
            // Corners belong to the long sides.
            double const wide = side % 2 == 0 ? half + 0.2 - in : half + 0.2 - in - 0.38;
            mesh_.box({-wide, -0.5, front}, {wide, top, front + 0.40 + (step == 4 ? gallery + 1.0 : 0.0)});
        }
        mesh_.end_object();

        int const bays = side % 2 == 0 ? 14 : 8;
        for (int i = (side % 2 == 0 ? 0 : 1); i <= bays - (side % 2 == 0 ? 0 : 1); ++i) {
            mesh_.frame = frame.moved({-half - 1.0 + (2.0 * half + 2.0) * i / bays, platform, z + 1.0});
            mesh_.colour = tinted(srgb(0xE8DBBF), random_, 0.05);
            bool const ruined = side == 3 && (i == 2 || i == 5 || i == 6);
            double const standing = ruined ? random_.between(0.35, 0.8) : 1.0;
            add_column(mesh_, random_, column_height, detail_, standing);
            mesh_.end_object();
        }

        mesh_.frame = frame;
        if (side == 3) return;  // this side is a ruin: no beam, no wall, a view of the land
        double const beam_y = platform + column_height;
        double const beam_end = side % 2 == 0 ? half + 1.9 : half + 0.1;
        mesh_.colour = srgb(0xE3D5B6);
        mesh_.box({-beam_end, beam_y - 0.02, z + 0.48}, {beam_end, beam_y + 0.62, z + 1.52});
        mesh_.colour = srgb(0xD9B98C);
        mesh_.box({-beam_end, beam_y + 0.60, z + 0.42}, {beam_end, beam_y + 1.15, z + 1.58});
        mesh_.colour = srgb(0xEADFC6);
        mesh_.box({-beam_end - 0.1, beam_y + 1.13, z + 0.12}, {beam_end + 0.1, beam_y + 1.38, z + 1.88});
        int const dentils = static_cast<int>(beam_end * (detail_ == 0 ? 1.0 : 2.6));
        for (int i = 0; i < dentils; ++i) {
            double const x = -beam_end + 2.0 * beam_end * (i + 0.5) / dentils;
            mesh_.box({x - 0.09, beam_y + 0.93, z + 0.22}, {x + 0.09, beam_y + 1.14, z + 0.44});
        }
        mesh_.end_object();

        mesh_.colour = srgb(0xC98F6B);
        mesh_.box({-end, -0.5, z + gallery + 1.0}, {end, beam_y + 3.58, z + gallery + 1.6});
        mesh_.colour = srgb(0x8D4A38);
        mesh_.box({-end, platform - 0.1, z + gallery + 0.96}, {end, platform + 1.1, z + gallery + 1.05});
        mesh_.end_object();
    }

    // Tiles on a slope that falls toward the court, on the three sides that still have it.
    void add_roof() {
        double const beam_y = platform + column_height + 1.38;
        for (int side = 0; side < 3; ++side) {
            mesh_.frame = side_frame(side);
            double const z = reach(side);
            double const half = half_span(side) + (side % 2 == 0 ? gallery + 1.2 : 1.0);
            double const low = z - 0.15;
            double const high = z + gallery + 1.9;
            auto const y = [&](double at) { return beam_y + 0.04 + 0.34 * (at - low); };
            mesh_.colour = srgb(0xA85A40);
            mesh_.hexahedron({glm::dvec3(-half, y(low) - 0.06, low),
                              {half, y(low) - 0.06, low},
                              {-half, y(low) + 0.10, low},
                              {half, y(low) + 0.10, low},
                              {-half, y(high) - 0.06, high},
                              {half, y(high) - 0.06, high},
                              {-half, y(high) + 0.10, high},
                              {half, y(high) + 0.10, high}});
            int const rows = static_cast<int>(half * (detail_ == 0 ? 0.5 : detail_ == 1 ? 2.4 : 3.4));
            for (int i = 0; i <= rows; ++i) {
                double const x = -half + 0.15 + (2.0 * half - 0.3) * i / rows;
                mesh_.colour = tinted(srgb(0xB9684A), random_, 0.14);
                std::array const path{glm::dvec3(x, y(low) + 0.10, low - 0.06), glm::dvec3(x, y(high) + 0.10, high)};
                mesh_.tube(path, 0.085, 0.085, 6);
                if (i % 24 == 23) mesh_.end_object();
            }
            mesh_.end_object();
        }
    }

    // A pool with an obelisk, balustrades, urns with cypresses and a few benches.
    void add_middle() {
        mesh_.frame = {};
        mesh_.colour = srgb(0xDDD0B4);
        double const px = 9.0;
        double const pz = 4.0;
        for (double const s : {1.0, -1.0}) {
            mesh_.box({-px - 0.5, -0.2, s * (pz + 0.25) - 0.25}, {px + 0.5, 0.45, s * (pz + 0.25) + 0.25});
            mesh_.box({s * (px + 0.25) - 0.25, -0.2, -pz}, {s * (px + 0.25) + 0.25, 0.45, pz});
        }
        mesh_.colour = srgb(0x6C9FA6);
        mesh_.box({-px, -0.1, -pz}, {px, 0.30, pz});
        mesh_.colour = srgb(0xD3B48C);
        add_obelisk(mesh_, 9.5);
        mesh_.end_object();

        mesh_.colour = srgb(0xE2D6BC);
        for (double const s : {1.0, -1.0}) {
            add_balustrade(mesh_, {s * 12.5, 0.0, -7.0}, {s * 12.5, 0.0, -1.8}, detail_);
            add_balustrade(mesh_, {s * 12.5, 0.0, 1.8}, {s * 12.5, 0.0, 7.0}, detail_);
            mesh_.end_object();
            for (double const t : {1.0, -1.0}) {
                add_balustrade(mesh_, {s * 12.0, 0.0, t * 7.5}, {s * 3.5, 0.0, t * 7.5}, detail_);
                mesh_.end_object();
            }
        }
        for (double const x : {-21.0, -16.0, 16.0, 21.0})
            for (double const z : {-12.0, 12.0}) {
                mesh_.frame = standing_at({x, 0.0, z});
                mesh_.colour = srgb(0xC98E68);
                add_urn(mesh_, 1.1, detail_);
                mesh_.frame = mesh_.frame.moved({0.0, 0.9, 0.0});
                if (std::abs(x) > 18.0)
                    add_cypress(mesh_, random_, 4.2, std::min(detail_, 1));
                else
                    add_bush(mesh_, random_, 1.2, detail_);
                mesh_.end_object();
            }
        for (double const x : {-7.0, 7.0})
            for (double const z : {-9.6, 9.6}) {
                mesh_.frame = standing_at({x, 0.0, z}, z > 0.0 ? pi : 0.0);
                add_bench(mesh_);
                mesh_.end_object();
            }
        mesh_.frame = {};
        for (double const z : {-court_z + 2.6, court_z - 2.6}) {
            add_railing(mesh_, {-24.0, 0.0, z}, {-6.0, 0.0, z}, detail_ == 0 ? 0.3 : 0.13, detail_);
            add_railing(mesh_, {6.0, 0.0, z}, {24.0, 0.0, z}, detail_ == 0 ? 0.3 : 0.13, detail_);
            mesh_.end_object();
        }
    }

    // Masts with flags and stays, wires with lanterns from beam to beam: 1 to 3 cm thick.
    void add_flags_and_wires() {
        static std::array const firsts{srgb(0xB5382F), srgb(0x2F6E86), srgb(0xD89A35), srgb(0x4F7A45)};
        int const segments = 10 + 10 * detail_;
        int colour = 0;
        for (double const x : {-25.0, -13.5, 13.5, 25.0}) {
            double const z = std::abs(x) > 20.0 ? 8.5 : -14.0;
            mesh_.frame = standing_at({x, 0.0, z}, random_.between(0.2, 0.7));
            mesh_.colour = srgb(0xCFC5B0);
            mesh_.box({-0.3, -0.2, -0.3}, {0.3, 0.35, 0.3});
            mesh_.colour = srgb(0xEDEAE2);
            mesh_.lathe({{0.06, 0.3}, {0.035, 9.6}, {0.0, 9.65}}, circle(8 + 4 * detail_));
            mesh_.colour = srgb(0x4A453C);
            add_wire(mesh_, {0.07, 0.9, 0.02}, {0.05, 9.5, 0.0}, 0.02, 0.006, 6, 4);  // the halyard
            for (double const angle : {0.4, 2.5, 4.6}) {
                glm::dvec3 const foot{2.4 * std::cos(angle), -0.02, 2.4 * std::sin(angle)};
                add_wire(mesh_, foot, {0.0, 7.4, 0.0}, 0.05, 0.008, segments / 2, 4);
            }
            Frame const mast = mesh_.frame;
            mesh_.frame = mast.moved({0.06, 9.4, 0.0});
            add_flag(mesh_, random_, 2.6, 1.7, firsts[static_cast<std::size_t>(colour++)], srgb(0xF1E8D3), detail_);
            mesh_.end_object();
        }

        double const high = platform + column_height + 0.3;
        mesh_.frame = {};
        int const strings = 4 + 2 * detail_;
        for (int i = 0; i < strings; ++i) {
            double const x = -24.0 + 48.0 * (i + 0.5) / strings;
            double const slant = random_.between(-4.0, 4.0);
            glm::dvec3 const a{x, high, -court_z - 0.6};
            glm::dvec3 const b{x + slant, high, court_z + 0.6};
            mesh_.colour = srgb(0x3A352E);
            add_wire(mesh_, a, b, 1.6, 0.012, segments, 5);
            int const lanterns = 7 + detail_;
            for (int k = 1; k < lanterns; ++k) {
                double const t = static_cast<double>(k) / lanterns;
                mesh_.frame = standing_at(a + (b - a) * t - glm::dvec3(0.0, 4.0 * 1.6 * t * (1.0 - t) + 0.42, 0.0));
                mesh_.colour = k % 2 == 0 ? srgb(0xE9B24C) : srgb(0xF3E6C6);
                mesh_.lathe({{0.0, 0.0}, {0.10, 0.02}, {0.16, 0.16}, {0.11, 0.31}, {0.02, 0.34}, {0.012, 0.44}},
                            circle(6 + 3 * detail_));
            }
            mesh_.frame = {};
            mesh_.end_object();
        }
        for (double const z : {-court_z - 0.2, court_z + 0.2}) {  // three thin cables along the beams
            mesh_.colour = srgb(0x3A352E);
            for (double const y : {6.2, 6.5, 6.9})
                add_wire(mesh_, {-court_x - 0.5, y, z}, {court_x + 0.5, y, z}, 0.25, 0.005 + 0.005 * (y - 6.0),
                         segments, 4);
            mesh_.end_object();
        }
    }

    // Olives, cypresses, fallen drums and rocks on the land around.
    void add_surroundings() {
        int const plants = 26 + 14 * detail_;
        for (int i = 0; i < plants; ++i) {
            double const x = random_.between(-58.0, 58.0);
            double const z = random_.between(-58.0, 58.0);
            double const yaw = random_.between(0.0, 2.0 * pi);
            double const height = random_.between(4.0, 6.5);
            bool const tall = random_.chance(0.4);
            double const outside = std::max(std::abs(x) - court_x, std::abs(z) - court_z);
            if (outside < 13.0) continue;
            mesh_.frame = standing_at({x, land(x, z, seed_) - 0.05, z}, yaw);
            if (tall)
                add_cypress(mesh_, random_, height * 1.7, detail_);
            else
                add_broadleaf(mesh_, random_, height, detail_);
            mesh_.end_object();
        }
        for (int i = 0; i < 9; ++i) {
            double const x = random_.between(-court_x - 15.0, -court_x - 6.5);
            double const z = random_.between(-14.0, 14.0);
            double const yaw = random_.between(0.0, 2.0 * pi);
            Frame lying = standing_at({x, land(x, z, seed_) + 0.25, z}, yaw);
            mesh_.frame = {lying.origin, lying.x, lying.z, -lying.y};
            mesh_.colour = tinted(srgb(0xDCCDB0), random_, 0.06);
            Ring const ring = detail_ == 0 ? circle(14) : fluted(20, 2 * detail_, 0.075);
            mesh_.lathe({{0.0, -0.6}, {0.38, -0.6}, {0.37, 0.6}, {0.0, 0.6}}, ring);
            mesh_.end_object();
        }
        for (int i = 0; i < 16; ++i) {
            double const angle = random_.between(0.0, 2.0 * pi);
            double const out = random_.between(48.0, 58.0);
            double const size = random_.between(0.4, 1.4);
            double const x = out * std::cos(angle);
            double const z = out * std::sin(angle);
            std::uint64_t const shape = random_.bits();
            mesh_.frame = standing_at({x, land(x, z, seed_) + 0.15 * size, z});
            mesh_.colour = tinted(srgb(0xA89C88), random_, 0.1);
            mesh_.blob({}, {size, 0.7 * size, 0.9 * size}, 3 + detail_, 0.3, shape, false);
            mesh_.end_object();
        }
    }

    [[nodiscard]] static std::vector<View> views() {
        View spot = view_toward("spot", {-22.5, 1.7, -3.5}, {-29.5, 3.6, 6.5}, 62.0, 60.0, sun_travel(35.0, 60.0));
        spot.has_spot = true;
        spot.spot_position = {-19.0, 5.2, -1.5};
        spot.spot_axis = glm::normalize(glm::dvec3(-30.5, 2.6, 8.0) - spot.spot_position);
        spot.spot_half_angle_radians = 0.62;
        spot.spot_range = 40.0;
        return {
            view_toward("street", {28.0, 1.75, -6.5}, {-12.0, 4.0, 3.5}, 60.0, 110.0, sun_travel(35.0, 110.0)),
            view_toward("hill", {-54.0, 24.0, 15.0}, {0.0, 0.0, -1.0}, 46.0, 120.0, sun_travel(35.0, 145.0)),
            view_toward("down", {14.0, 27.0, 17.0}, {0.0, 0.0, -1.0}, 52.0, 80.0, sun_travel(60.0, 40.0)),
            view_toward("up", {-16.0, 1.5, -15.2}, {-9.0, 7.4, -22.0}, 66.0, 80.0, sun_travel(35.0, 70.0)),
            view_toward("low_sun", {25.0, 1.8, -1.5}, {-30.0, 3.2, 0.5}, 56.0, 100.0, sun_travel(12.0, 176.0)),
            view_toward("side", {-27.0, platform + 1.7, court_z + 4.0}, {24.0, 3.4, court_z + 2.2}, 62.0, 90.0,
                        sun_travel(20.0, -80.0)),
            view_toward("noon", {-20.5, 1.7, -6.5}, {8.0, 3.0, 4.0}, 58.0, 100.0, sun_travel(80.0, 30.0)),
            spot,
        };
    }

    int detail_;
    Random random_;
    std::uint64_t seed_;
    MeshBuilder mesh_;
};

}  // namespace

NamedScene make_colonnade(SceneSize size, std::uint64_t seed) {
    return Colonnade(size, seed).build();
}

}  // namespace shadowmath::scenes
