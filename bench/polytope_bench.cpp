// SPDX-License-Identifier: MIT
//
// What a view sees of a box. Textbook: the box's six polygons in vectors, cut by the six planes of the view's matrix;
// it leaves the new faces away.
#include "bench/cases.hpp"
#include "bench/timed.hpp"

#include <shadowmath/polytope.hpp>

#include <vector>

using namespace shadowmath;

namespace {

Aabb<float> const town{glm::vec3(-120, 0, -120), glm::vec3(120, 30, 120)};

using Polygon = std::vector<glm::vec3>;

Polygon clipped(Polygon const& whole, glm::vec4 const& plane) {
    Polygon part;
    for (std::size_t i = 0; i < whole.size(); ++i) {
        glm::vec3 const &a = whole[i], &b = whole[(i + 1) % whole.size()];
        float const above_a = glm::dot(plane, glm::vec4(a, 1.0f)), above_b = glm::dot(plane, glm::vec4(b, 1.0f));
        if (above_a >= 0.0f) part.push_back(a);
        if ((above_a >= 0.0f) != (above_b >= 0.0f)) part.push_back(glm::mix(a, b, above_a / (above_a - above_b)));
    }
    return part;
}

std::vector<Polygon> polygons_in(textbook::Frustum const& frustum) {
    std::array<glm::vec3, 8> const at = corners(town);
    std::vector<Polygon> faces;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        std::size_t const u = std::size_t(1) << (axis + 1) % 3, v = std::size_t(1) << (axis + 2) % 3;
        for (std::size_t const first : {std::size_t(0), std::size_t(1) << axis})
            faces.push_back({at[first], at[first + u], at[first + u + v], at[first + v]});
    }
    for (Polygon& face : faces)
        for (glm::vec4 const& plane : frustum) face = clipped(face, plane);
    return faces;
}

int const registered = [] {
    bench::Random random;
    auto const views = bench::inputs([&] { return bench::view_of(bench::some_camera(random)); });
    std::vector<textbook::Frustum> frustums;
    for (ViewVolume<float> const& view : views)
        frustums.push_back(textbook::frustum_of(clip_from_world(view, gl_zero_to_one_clip)));
    bench::time("visible_body/ours", views, [](ViewVolume<float> const& view) { return visible_body(view, town); });
    bench::time("visible_body/textbook", frustums, polygons_in);
    return 0;
}();

}  // namespace
