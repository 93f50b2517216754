// SPDX-License-Identifier: MIT
#include "scenes/house.hpp"

#include <algorithm>

namespace shadowmath::scenes {

namespace {

constexpr double half_pi = 1.57079632679489661923;
constexpr double storey_height = 2.9;
constexpr double below_ground = -1.5;

struct Paint {
    glm::dvec3 wall, roof, shutter, stone, wood;
};

Paint choose_paint(Random& random) {
    static std::array const walls{srgb(0xE8D2AC), srgb(0xDDB988), srgb(0xF1E6CF), srgb(0xE3BF86), srgb(0xDCA890),
                                  srgb(0xEFE9DC), srgb(0xC9CFC8), srgb(0xE6C9B0), srgb(0xD8C39A)};
    static std::array const roofs{srgb(0xB2573A), srgb(0xC06A47), srgb(0xA34C34), srgb(0xCB7D55),
                                  srgb(0x96503C), srgb(0xB86B4C), srgb(0x6D7076)};
    static std::array const shutters{srgb(0x5E7F6B), srgb(0x4F6D8A), srgb(0x8A4038), srgb(0x7A8C5A), srgb(0xE9E4D6)};
    Paint paint;
    paint.wall = tinted(random.pick(walls), random, 0.06);
    paint.roof = tinted(random.pick(roofs), random, 0.12);
    paint.shutter = random.pick(shutters);
    paint.stone = tinted(srgb(0xC9BCA4), random, 0.08);
    paint.wood = tinted(srgb(0x6B4A32), random, 0.15);
    return paint;
}

// A body under a gable roof, centred on y; the ridge runs along x. Returns the height of the ridge.
struct Gabled {
    double half_length, half_width, eaves, slope, overhang, floor;
};

double add_gabled(MeshBuilder& mesh, Gabled const& g, glm::dvec3 wall, glm::dvec3 roof) {
    auto const [a, b, eaves, slope, o, floor] = g;
    double const ridge = eaves + slope * b;
    mesh.colour = wall;
    for (double const s : {1.0, -1.0}) {  // a front and an end, then the same turned by half a turn
        auto const p = [&](double x, double y, double z) { return glm::dvec3(s * x, y, s * z); };
        mesh.quad(p(-a, floor, b), p(a, floor, b), p(a, eaves, b), p(-a, eaves, b));
        mesh.quad(p(a, floor, b), p(a, floor, -b), p(a, eaves, -b), p(a, eaves, b));
        mesh.triangle(p(a, eaves, b), p(a, eaves, -b), p(a, ridge, 0.0));
    }
    mesh.colour = roof;
    double const end = a + 0.6 * o;
    for (double const s : {1.0, -1.0}) {
        auto const top = [&](double z) { return ridge - g.slope * std::abs(z); };
        double const z_lo = s > 0.0 ? 0.0 : -(b + o);
        double const z_hi = s > 0.0 ? b + o : 0.0;
        std::array<glm::dvec3, 8> slab;
        for (unsigned i = 0; i < 8; ++i) {
            double const z = (i & 4u) != 0 ? z_hi : z_lo;
            slab[i] = {(i & 1u) != 0 ? end : -end, top(z) + ((i & 2u) != 0 ? 0.20 : -0.04), z};
        }
        mesh.hexahedron(slab);
    }
    mesh.colour = roof * 0.82;
    mesh.box({-end - 0.03, ridge + 0.05, -0.16}, {end + 0.03, ridge + 0.28, 0.16});
    return ridge;
}

// A board on a wall, z outward: a box without the face that the wall hides.
void add_board(MeshBuilder& mesh, glm::dvec2 lo, glm::dvec2 hi, double thickness) {
    std::array const back{glm::dvec3(lo, 0.0), glm::dvec3(hi.x, lo.y, 0.0), glm::dvec3(hi, 0.0),
                          glm::dvec3(lo.x, hi.y, 0.0)};
    auto const front = [&](std::size_t i) { return back[i] + glm::dvec3(0.0, 0.0, thickness); };
    mesh.quad(front(0), front(1), front(2), front(3));
    for (std::size_t i = 0; i < 4; ++i) {
        std::size_t const next = (i + 1) % 4;
        mesh.quad(back[i], back[next], front(next), front(i));
    }
}

// In the frame of a wall, z outward: a window around x, its sill at y.
void add_window(MeshBuilder& mesh, Paint const& paint, double x, double y, bool shutters, int detail) {
    double const w = 0.48;
    double const h = 1.35;
    mesh.colour = srgb(0x2B3640);
    mesh.quad({x - w, y, 0.05}, {x + w, y, 0.05}, {x + w, y + h, 0.05}, {x - w, y + h, 0.05});
    if (detail == 0) return;
    mesh.colour = paint.stone;
    add_board(mesh, {x - w - 0.12, y - 0.10}, {x + w + 0.12, y}, 0.16);
    if (shutters) {
        mesh.colour = paint.shutter;
        add_board(mesh, {x - w - 0.50, y}, {x - w - 0.03, y + h}, 0.07);
        add_board(mesh, {x + w + 0.03, y}, {x + w + 0.50, y + h}, 0.07);
    }
    if (detail < 2) return;
    mesh.colour = paint.stone;
    add_board(mesh, {x - w - 0.08, y + h}, {x + w + 0.08, y + h + 0.14}, 0.11);
    mesh.colour = srgb(0xEDE8DC);
    add_board(mesh, {x - 0.03, y}, {x + 0.03, y + h}, 0.08);
}

void add_chimney(MeshBuilder& mesh, Paint const& paint, glm::dvec3 foot, double top, int detail) {
    mesh.colour = paint.roof * 0.75 + paint.stone * 0.2;
    mesh.box({foot.x - 0.40, foot.y, foot.z - 0.30}, {foot.x + 0.40, top, foot.z + 0.30});
    mesh.colour = paint.stone;
    mesh.box({foot.x - 0.48, top, foot.z - 0.38}, {foot.x + 0.48, top + 0.12, foot.z + 0.38});
    if (detail == 0) return;
    mesh.colour = paint.roof;
    Frame const frame = mesh.frame;
    for (double const x : {-0.2, 0.2}) {
        mesh.frame = frame.moved({foot.x + x, top + 0.1, foot.z});
        mesh.lathe({{0.13, 0.0}, {0.10, 0.45}, {0.0, 0.45}}, circle(4 + 2 * detail));
    }
    mesh.frame = frame;
}

void add_dormer(MeshBuilder& mesh, Paint const& paint, double x, double z, double roof_height, double slope,
                int detail) {
    Frame const frame = mesh.frame;
    double const half = 0.75;
    double const eaves = 1.25;
    mesh.frame = frame.moved({x, roof_height, z - 0.9}).turned(-half_pi);
    add_gabled(mesh, {0.9, half, eaves, std::min(slope, 0.8), 0.15, -1.0}, paint.wall, paint.roof);
    mesh.frame = frame.moved({x, roof_height, z});
    add_window(mesh, paint, 0.0, 0.12, false, detail);
    mesh.frame = frame;
}

}  // namespace

void add_house(MeshBuilder& mesh, Random& random, HousePlan const& plan) {
    Frame const front = mesh.frame;
    Paint const paint = choose_paint(random);
    double const eaves = plan.storeys * storey_height + 0.45;
    double const slope = random.between(0.62, 0.95);
    double const overhang = random.between(0.35, 0.55);
    Frame const centre = front.moved({0.0, 0.0, -plan.depth / 2});

    double const half_width = plan.width / 2;
    double const half_depth = plan.depth / 2;
    double ridge = 0.0;
    if (plan.gable_in_front) {
        mesh.frame = centre.turned(half_pi);
        ridge =
            add_gabled(mesh, {half_depth, half_width, eaves, slope, overhang, below_ground}, paint.wall, paint.roof);
    } else {
        mesh.frame = centre;
        ridge =
            add_gabled(mesh, {half_width, half_depth, eaves, slope, overhang, below_ground}, paint.wall, paint.roof);
        if (plan.detail > 0 && random.chance(0.45)) {
            double const z = half_depth * 0.62;
            double const x = random.between(-0.4, 0.4) * half_width;
            add_dormer(mesh, paint, x, z, ridge - slope * z, slope, plan.detail);
        }
    }
    mesh.frame = centre;
    double const chimney_x =
        random.between(0.35, 0.8) * half_width * (random.chance(0.5) ? 1.0 : -1.0) * (plan.gable_in_front ? 0.5 : 1.0);
    double const chimney_z = random.between(-0.4, 0.4) * half_depth;
    add_chimney(mesh, paint, {chimney_x, eaves, chimney_z}, ridge + random.between(0.5, 0.9), plan.detail);

    mesh.frame = front;
    if (plan.detail > 0) {
        mesh.colour = paint.stone * 0.85;
        mesh.box({-half_width - 0.06, below_ground, -plan.depth - 0.06}, {half_width + 0.06, 0.45, 0.06});  // plinth
    }
    int const bays = std::max(2, static_cast<int>(plan.width / 2.5));
    int const door_bay = random.below(bays);
    bool const shutters = random.chance(0.65);
    auto const bay_x = [&](int bay) { return (bay + 0.5) * plan.width / bays - half_width; };
    auto const sill = [](int storey) { return storey * storey_height + 1.25; };
    for (int storey = 0; storey < plan.storeys; ++storey)
        for (int bay = 0; bay < bays; ++bay)
            if (storey > 0 || bay != door_bay) add_window(mesh, paint, bay_x(bay), sill(storey), shutters, plan.detail);

    double const door = bay_x(door_bay);
    mesh.colour = paint.wood;
    mesh.box({door - 0.52, -0.3, -0.05}, {door + 0.52, 2.45, 0.10});
    mesh.colour = paint.stone;
    mesh.box({door - 0.75, below_ground, 0.0}, {door + 0.75, 0.20, 0.75});
    if (plan.detail > 0) {
        mesh.colour = paint.roof;
        mesh.beam({door, 2.72, -0.05}, {door, 2.60, 0.85}, 1.7, 0.09);
    }

    int const back_bays = std::max(1, bays - 1);
    mesh.frame = front.moved({0.0, 0.0, -plan.depth}).turned(2.0 * half_pi);
    for (int storey = 0; storey < plan.storeys; ++storey)
        for (int bay = 0; bay < back_bays; ++bay) {
            double const x = (bay + 0.5) * plan.width / back_bays - half_width;
            add_window(mesh, paint, x, sill(storey), false, std::max(plan.detail - 1, 0));
        }
    for (double const side : {1.0, -1.0}) {
        mesh.frame = centre.moved({side * half_width, 0.0, 0.0}).turned(side * half_pi);
        for (int storey = plan.storeys - 1; storey >= (plan.detail > 1 ? 0 : plan.storeys - 1); --storey)
            add_window(mesh, paint, 0.0, sill(storey), false, std::max(plan.detail - 1, 0));
    }
    mesh.frame = front;
}

namespace {

// In the wall of a nave, from x + 1.5 to x + 2.9.
void add_pointed_window(MeshBuilder& mesh, double x) {
    mesh.colour = srgb(0x36424D);
    mesh.box({x + 1.5, 3.0, -0.1}, {x + 2.9, 8.2, 0.08});
    mesh.frame = mesh.frame.moved({x + 2.2, 8.2, -0.1});
    mesh.hexahedron({glm::dvec3(-0.7, -0.01, 0),
                     {0.7, -0.01, 0},
                     {-0.05, 1.1, 0},
                     {0.05, 1.1, 0},
                     {-0.7, -0.01, 0.18},
                     {0.7, -0.01, 0.18},
                     {-0.05, 1.1, 0.18},
                     {0.05, 1.1, 0.18}});
    mesh.frame = mesh.frame.moved({-x - 2.2, -8.2, 0.1});
}

// It slopes out toward its foot.
void add_buttress(MeshBuilder& mesh, Paint const& paint, double x) {
    mesh.colour = paint.stone;
    mesh.hexahedron({glm::dvec3(x - 0.5, below_ground, -0.1),
                     {x + 0.5, below_ground, -0.1},
                     {x - 0.5, 9.5, -0.1},
                     {x + 0.5, 9.5, -0.1},
                     {x - 0.5, below_ground, 1.6},
                     {x + 0.5, below_ground, 1.6},
                     {x - 0.5, 7.0, 0.9},
                     {x + 0.5, 7.0, 0.9}});
}

void add_nave(MeshBuilder& mesh, Frame const& front, Paint const& paint) {
    double const nave_eaves = 11.0;
    mesh.frame = front.moved({0.0, 0.0, -24.0}).turned(half_pi);
    add_gabled(mesh, {15.8, 7.0, nave_eaves, 0.95, 0.5, below_ground}, paint.wall, paint.roof);
    for (double const side : {1.0, -1.0}) {
        mesh.frame = front.moved({side * 7.0, 0.0, -24.0}).turned(side * half_pi);
        for (int k = -3; k <= 3; ++k) {
            double const x = 4.4 * k;
            if (k != 3) add_pointed_window(mesh, x);
            add_buttress(mesh, paint, x);
        }
    }
}

void add_tower(MeshBuilder& mesh, Frame const& tower, Paint const& paint, int detail) {
    mesh.frame = tower;
    mesh.colour = paint.wall * 0.97;
    mesh.box({-3.6, below_ground, -3.6}, {3.6, 22.0, 3.6});
    mesh.colour = paint.stone;
    for (double const y : {8.0, 15.5, 21.6}) mesh.box({-3.85, y, -3.85}, {3.85, y + 0.45, 3.85});
    for (int corner = 0; corner < 4; ++corner) {  // the belfry stands open between four piers
        mesh.frame = tower.turned(half_pi * corner);
        mesh.colour = paint.wall * 0.97;
        mesh.box({2.2, 22.0, 2.2}, {3.55, 28.0, 3.55});
        mesh.box({-0.25, 22.0, 3.0}, {0.25, 27.2, 3.5});
        mesh.colour = srgb(0x4A3A2C);
        int const louvres = 4 + 3 * detail;
        for (int k = 0; k < louvres; ++k) {
            double const y = 23.2 + 4.0 * k / louvres;
            mesh.beam({-2.25, y, 3.1}, {2.25, y, 3.1}, 0.45, 0.06);
        }
    }
}

void add_spire(MeshBuilder& mesh, Frame const& tower, Paint const& paint) {
    mesh.frame = tower;
    mesh.colour = paint.stone;
    mesh.box({-3.9, 27.6, -3.9}, {3.9, 28.4, 3.9});
    mesh.colour = srgb(0x5E7D74);
    Ring const square = circle(4);
    mesh.frame = tower.moved({0.0, 28.4, 0.0}).turned(half_pi / 2);
    Ring const octagon = circle(8);
    mesh.lathe({{5.3, -0.05}, {5.3, 0.15}, {3.2, 3.2}, {0.0, 4.5}}, square);
    mesh.frame = tower.moved({0.0, 28.4, 0.0}).turned(half_pi / 4);
    mesh.lathe({{2.9, 2.0}, {0.12, 17.5}, {0.0, 17.6}}, octagon);
    mesh.frame = tower;
    mesh.colour = srgb(0xC9A94E);
    mesh.box({-0.05, 45.8, -0.05}, {0.05, 48.2, 0.05});
    mesh.box({-0.6, 47.2, -0.045}, {0.6, 47.3, 0.045});
}

void add_porch(MeshBuilder& mesh, Frame const& front, Paint const& paint) {
    mesh.frame = front;
    mesh.colour = srgb(0x5A3B28);
    mesh.box({-1.3, -0.3, -1.6}, {1.3, 3.6, -1.28});
    mesh.colour = paint.stone;
    for (int step = 0; step < 3; ++step)
        mesh.box({-2.6 - 0.4 * step, below_ground, -1.5}, {2.6 + 0.4 * step, 0.54 - 0.18 * step, -0.5 + 0.4 * step});
}

void add_clock_faces(MeshBuilder& mesh, Frame const& tower) {
    for (int side = 0; side < 4; ++side) {
        mesh.frame = tower.turned(half_pi * side);
        mesh.colour = srgb(0xEFE7D2);
        mesh.box({-1.1, 17.0, 3.5}, {1.1, 19.2, 3.7});
        mesh.colour = srgb(0x2A2A2E);
        mesh.box({-0.05, 18.05, 3.7}, {0.05, 18.95, 3.78});
        mesh.box({-0.05, 18.05, 3.7}, {0.62, 18.15, 3.77});
    }
}

}  // namespace

void add_church(MeshBuilder& mesh, Random& random, int detail) {
    Frame const front = mesh.frame;
    Paint paint = choose_paint(random);
    paint.wall = srgb(0xE9DAB9);
    paint.roof = srgb(0xA9583F);
    paint.stone = srgb(0xD2C4A6);
    Frame const tower = front.moved({0.0, 0.0, -5.0});
    add_nave(mesh, front, paint);
    add_tower(mesh, tower, paint, detail);
    add_spire(mesh, tower, paint);
    add_porch(mesh, front, paint);
    add_clock_faces(mesh, tower);
    mesh.frame = front;
}

}  // namespace shadowmath::scenes
