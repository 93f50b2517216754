// SPDX-License-Identifier: MIT
#include "examples/support/village.hpp"

#include <glm/geometric.hpp>

namespace shadowmath::example {
namespace {

using glm::vec3;

struct Builder {
    Village made;
    Aabb<float> object;

    void triangle(vec3 a, vec3 b, vec3 c, vec3 colour) {
        made.triangles.push_back({{a, b, c}, glm::normalize(glm::cross(b - a, c - a)), colour});
        for (vec3 const& p : {a, b, c}) object = merge(object, p);
    }
    void quad(vec3 a, vec3 b, vec3 c, vec3 d, vec3 colour) {
        triangle(a, b, c, colour);
        triangle(a, c, d, colour);
    }
    void cuboid(vec3 lo, vec3 hi, vec3 colour) {
        auto const at = [&](int i) {
            return vec3((i & 1) != 0 ? hi.x : lo.x, (i & 2) != 0 ? hi.y : lo.y, (i & 4) != 0 ? hi.z : lo.z);
        };
        quad(at(4), at(5), at(7), at(6), colour);
        quad(at(1), at(0), at(2), at(3), colour);
        quad(at(5), at(1), at(3), at(7), colour);
        quad(at(0), at(4), at(6), at(2), colour);
        quad(at(6), at(7), at(3), at(2), colour);
    }
    void close() {
        made.objects.push_back(object);
        made.casters = merge(made.casters, object);
        object = {};
    }

    void house(float x, float z, float width, float depth, float height, vec3 wall, vec3 roof) {
        vec3 const lo(x - width / 2, 0.0f, z - depth / 2), hi(x + width / 2, height, z + depth / 2);
        cuboid(lo, hi, wall);
        float const eaves = 0.4f, top = height + width * 0.42f;
        vec3 const front(x, top, hi.z + eaves), back(x, top, lo.z - eaves);
        vec3 const left(lo.x - eaves, height - 0.2f, 0.0f), right(hi.x + eaves, height - 0.2f, 0.0f);
        auto const at_z = [](vec3 p, float with) { return vec3(p.x, p.y, with); };
        quad(at_z(left, front.z), front, back, at_z(left, back.z), roof);
        quad(front, at_z(right, front.z), at_z(right, back.z), back, roof);
        // The way a light from below would see it: so that the roof casts from every side.
        quad(at_z(left, back.z), back, front, at_z(left, front.z), roof * 0.6f);
        quad(back, at_z(right, back.z), at_z(right, front.z), front, roof * 0.6f);
        triangle(vec3(lo.x, height, hi.z), vec3(hi.x, height, hi.z), at_z(front, hi.z), wall);
        triangle(vec3(hi.x, height, lo.z), vec3(lo.x, height, lo.z), at_z(back, lo.z), wall);
        cuboid(vec3(x + width * 0.18f, height, z - 0.4f), vec3(x + width * 0.18f + 0.8f, top + 0.5f, z + 0.4f),
               vec3(0.42f, 0.2f, 0.16f));
        close();
    }
    void fir(float x, float z, float height) {
        cuboid(vec3(x - 0.2f, 0.0f, z - 0.2f), vec3(x + 0.2f, height * 0.25f, z + 0.2f), vec3(0.2f, 0.12f, 0.07f));
        for (int tier = 0; tier < 3; ++tier) {
            float const foot = height * (0.18f + 0.24f * float(tier)), tip = foot + height * 0.36f;
            float const reach = height * (0.25f - 0.055f * float(tier));
            vec3 const colour = vec3(0.055f, 0.17f, 0.075f) * (1.0f + 0.3f * float(tier));
            vec3 const corner[] = {
                {x + reach, foot, z}, {x, foot, z - reach}, {x - reach, foot, z}, {x, foot, z + reach}};
            for (int side = 0; side < 4; ++side)
                triangle(corner[side], corner[(side + 1) % 4], vec3(x, tip, z), colour);
            quad(corner[3], corner[2], corner[1], corner[0], colour * 0.5f);
        }
        close();
    }
};

}  // namespace

Village village() {
    Builder build;
    vec3 const white(0.78f, 0.74f, 0.66f), ochre(0.72f, 0.5f, 0.26f), rose(0.66f, 0.4f, 0.34f),
        grey(0.5f, 0.52f, 0.52f);
    vec3 const tile(0.42f, 0.13f, 0.075f), slate(0.16f, 0.18f, 0.22f), straw(0.44f, 0.32f, 0.14f);
    build.house(-7.0f, -9.0f, 7.0f, 9.0f, 4.0f, white, tile);
    build.house(8.0f, -12.0f, 6.0f, 8.0f, 5.0f, ochre, slate);
    build.house(-9.5f, -25.0f, 8.0f, 8.0f, 4.5f, rose, slate);
    build.house(9.0f, -30.0f, 7.0f, 11.0f, 4.0f, white, tile);
    build.house(-6.0f, -43.0f, 6.0f, 8.0f, 4.0f, grey, tile);
    build.house(10.0f, -52.0f, 9.0f, 9.0f, 6.0f, rose, straw);
    build.house(-12.0f, -62.0f, 8.0f, 10.0f, 5.0f, ochre, tile);
    // The tower at the end of the street.
    build.cuboid(vec3(-2.5f, 0.0f, -84.0f), vec3(2.5f, 17.0f, -79.0f), grey);
    build.cuboid(vec3(-3.0f, 17.0f, -84.5f), vec3(3.0f, 18.0f, -78.5f), slate);
    build.close();
    float const firs[][3] = {{15.0f, -4.0f, 8.0f},   {-15.5f, -14.0f, 9.0f}, {16.0f, -22.0f, 7.0f},
                             {3.4f, -21.0f, 4.0f},   {-17.0f, -34.0f, 10.f}, {-3.8f, -33.0f, 4.5f},
                             {17.0f, -41.0f, 9.0f},  {3.6f, -44.0f, 4.0f},   {20.0f, -66.0f, 11.f},
                             {-21.0f, -52.0f, 9.0f}, {12.0f, -72.0f, 8.0f},  {-9.0f, -76.0f, 7.0f}};
    for (auto const& [x, z, height] : firs) build.fir(x, z, height);
    // A fence beside the path, and the pole of a lamp.
    vec3 const wood(0.36f, 0.24f, 0.13f);
    for (int post = 0; post < 9; ++post) {
        float const z = 2.0f - 2.0f * float(post);
        build.cuboid(vec3(2.55f, 0.0f, z - 0.09f), vec3(2.73f, 1.25f, z + 0.09f), wood);
        build.close();
    }
    for (float const height : {0.45f, 0.95f}) {
        build.cuboid(vec3(2.6f, height, -14.0f), vec3(2.68f, height + 0.14f, 2.0f), wood);
        build.close();
    }
    build.cuboid(vec3(-1.9f, 0.0f, -2.4f), vec3(-1.76f, 4.2f, -2.26f), slate);
    build.cuboid(vec3(-2.0f, 4.2f, -2.5f), vec3(-1.66f, 4.7f, -2.16f), vec3(0.8f, 0.7f, 0.4f));
    build.close();

    build.made.receivers =
        merge(build.made.casters, Aabb<float>{vec3(-60.0f, -0.01f, -130.0f), vec3(60.0f, 0.0f, 10.0f)});
    vec3 const grass(0.2f, 0.3f, 0.1f), sand(0.5f, 0.42f, 0.29f);
    build.quad(vec3(-60.0f, 0.0f, 10.0f), vec3(-1.5f, 0.0f, 10.0f), vec3(-1.5f, 0.0f, -130.0f),
               vec3(-60.0f, 0.0f, -130.0f), grass);
    build.quad(vec3(1.5f, 0.0f, 10.0f), vec3(60.0f, 0.0f, 10.0f), vec3(60.0f, 0.0f, -130.0f), vec3(1.5f, 0.0f, -130.0f),
               grass);
    build.quad(vec3(-1.5f, 0.0f, 10.0f), vec3(1.5f, 0.0f, 10.0f), vec3(1.5f, 0.0f, -130.0f), vec3(-1.5f, 0.0f, -130.0f),
               sand);
    return build.made;
}

std::vector<Triangle> boards(std::vector<Aabb<float>> const& boxes) {
    Builder build;
    for (auto const& [lo, hi] : boxes)
        build.quad(vec3(lo.x, hi.y, hi.z), hi, vec3(hi.x, hi.y, lo.z), vec3(lo.x, hi.y, lo.z), vec3(0.6f));
    return build.made.triangles;
}

ViewVolume<float> village_view(float z_far) {
    Pose<float> const pose = pose_looking(vec3(0.4f, 2.6f, 7.5f), vec3(-0.02f, -0.09f, -1.0f), vec3(0.0f, 1.0f, 0.0f));
    return perspective_view(pose, 0.95f, 16.0f / 9.0f, 0.5f, z_far);
}

}  // namespace shadowmath::example
