// SPDX-License-Identifier: MIT
//
// The backend that draws nothing: it records what it is asked and says what is wrong with it.
// Use it to test code that feeds a backend without a driver; its images are empty maps and empty skies.
#pragma once

#include "backends/backend.hpp"

#include <variant>

namespace shadowmath::backend {

struct UploadCall {
    std::string scene;
    std::size_t object_count = 0;
};
struct DrawDepthCall {
    struct Layer {
        glm::mat4 clip_from_world{1.0f};
        std::vector<std::uint32_t> objects;
    };
    int map_size = 0;
    bool depth_clamp = false;
    std::vector<Layer> layers;
};
struct DrawSceneCall {
    ScenePass pass;
};
struct ReadDepthCall {
    int layer = 0;
};
struct ReadFrameCall {};

using Call = std::variant<UploadCall, DrawDepthCall, DrawSceneCall, ReadDepthCall, ReadFrameCall>;

class NullBackend final : public Backend {
public:
    [[nodiscard]] BackendInfo info() const override { return {"null", "none"}; }
    void upload(Scene const& scene) override;
    double draw_depth(DepthPass const& pass) override;
    double draw_scene(ScenePass const& pass) override;
    [[nodiscard]] Image<float> read_depth(int layer) override;
    [[nodiscard]] Frame read_frame() override;
    [[nodiscard]] std::vector<std::string> take_messages() override;

    [[nodiscard]] std::vector<Call> const& calls() const noexcept { return calls_; }

private:
    bool accept(std::string const& fault);

    std::vector<Call> calls_;
    std::vector<std::string> messages_;
    std::size_t object_count_ = 0;
    int map_size_ = 0;
    int layers_ = 0;
    Extent extent_;
    glm::vec4 sky_{0.0f};
};

}  // namespace shadowmath::backend
