// SPDX-License-Identifier: MIT
#include "examples/gallery/truth.hpp"

#include "examples/gallery/techniques.hpp"

#include <glm/geometric.hpp>

namespace shadowmath::gallery {
namespace {

backend::Frame drawn(backend::Backend& backend, backend::Extent extent, backend::FrameConstants const& frame) {
    backend.draw_scene({extent, frame});
    return backend.read_frame();
}

glm::dvec3 point_of(backend::Texel4 const& texel) {
    return {texel.x, texel.y, texel.z};
}

bool outside_cone(backend::FrameConstants const& frame, glm::dvec3 point) {
    if (frame.spot_axis.w <= -2.0f) return false;
    glm::dvec3 const travel = glm::normalize(point - glm::dvec3(frame.light));
    constexpr double rim = 1e-4;  // the shader's float cosine decides within it
    return glm::dot(travel, glm::dvec3(frame.spot_axis)) <= double(frame.spot_axis.w) + rim;
}

bool beyond_shadows(backend::FrameConstants const& frame, scenes::View const& view, glm::dvec3 point) {
    double const depth = glm::dot(glm::dvec3(frame.eye_forward), point - glm::dvec3(frame.eye_position));
    return depth > view.shadow_distance ||
           (view.has_spot && glm::distance(point, view.spot_position) > view.spot_range);
}

Question question_at(backend::FrameConstants const& frame, scenes::View const& view, glm::dvec3 point,
                     oracle::Truth state, oracle::Judge judge) {
    bool const faces_light = state == oracle::Truth::lit || state == oracle::Truth::shadowed;
    if (!faces_light || outside_cone(frame, point)) return Question::none;
    if (beyond_shadows(frame, view, point)) return Question::beyond;
    return judge == oracle::Judge::off_edge ? Question::off_edge : Question::near_edge;
}

}  // namespace

ViewTruth true_view(backend::Backend& backend, oracle::RayOracle const& oracle, scenes::View const& view,
                    backend::Extent extent) {
    backend::FrameConstants const frame = unshadowed(view, extent);
    backend::FrameConstants dark = frame;
    dark.light_colour = glm::vec4(0.0f);
    glm::dvec4 const light(frame.light);

    backend::Extent const twice{2 * extent.width, 2 * extent.height};
    backend::Frame const fine = drawn(backend, twice, unshadowed(view, twice));
    auto const samples = oracle.truth(fine.position, fine.normal, light);
    backend::Frame const in_light = drawn(backend, extent, frame);
    backend::Frame const in_dark = drawn(backend, extent, dark);

    ViewTruth truth;
    truth.state = oracle.truth(in_light.position, in_light.normal, light);
    auto const judges = oracle::edge_mask(truth.state, samples);
    truth.position = in_light.position;
    truth.question = backend::Image<Question>(extent);
    truth.picture = backend::Image<backend::Rgba8>(extent);
    for (std::size_t i = 0; i < truth.state.pixels.size(); ++i) {
        oracle::Truth const state = truth.state.pixels[i];
        truth.question.pixels[i] =
            question_at(frame, view, point_of(in_light.position.pixels[i]), state, judges.pixels[i]);
        truth.picture.pixels[i] = (state == oracle::Truth::shadowed ? in_dark : in_light).colour.pixels[i];
    }
    return truth;
}

}  // namespace shadowmath::gallery
