// SPDX-License-Identifier: MIT
//
// Stops where a debugger can look at one of each; printed.sh compares what it sees.
#include <shadowmath/cascades.hpp>

int main() {
    namespace sm = shadowmath;
    sm::Aabb<float> const box{glm::vec3(-20, 0, -20), glm::vec3(20, 5, 20)};
    auto const nothing = sm::Aabb<float>{};
    auto const view = sm::perspective_view(sm::Pose<float>{}, 1.0f, 1.5f, 0.5f, 50.0f);
    auto const sun = sm::directional(glm::vec3(0, -2, 0));
    auto const splits = sm::uniform_splits(1.0, 9.0, 2);
    auto const cascades = sm::fit_cascades(view, sun, box, box, sm::CascadeOptions<float>{});
    sm::Faults const faults = sm::Fault::not_finite | sm::Fault::bad_pose;
    auto const clip = sm::vulkan_clip;
    auto const map = sm::ShadowMap<double>{};
    auto const seen = [&] { return &box && &nothing && &splits && &faults && &clip && &map && cascades.count == 4; };
    return seen() ? 0 : 1;  // stop here
}
