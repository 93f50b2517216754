// SPDX-License-Identifier: MIT
//
// The backend that draws nothing: it records what it is asked and says what is wrong with it.
// Use it to test code that feeds a backend without a driver; its images are empty maps and empty skies. What a pass
// would have handed to a driver it counts like the others.
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
    DrawWay way = DrawWay::pass_per_map;
};
struct DrawSceneCall {
    ScenePass pass;
};
struct DrawSplitBySplitCall {
    DrawDepthCall maps;
    ScenePass view;
};
struct ReadDepthCall {
    int layer = 0;
};
struct ReadFrameCall {};
struct FitMapsCall {
    Extent extent;
    std::size_t step_count = 0;
};
struct ReadEyeDepthCall {};
struct ReadFitCall {};

using Call = std::variant<UploadCall, DrawDepthCall, DrawSceneCall, DrawSplitBySplitCall, FitMapsCall, ReadDepthCall,
                          ReadFrameCall, ReadEyeDepthCall, ReadFitCall>;

class NullBackend final : public Backend {
public:
    [[nodiscard]] BackendInfo info() const override { return {"null", "none"}; }
    [[nodiscard]] std::vector<DrawWay> ways() const override { return {every_way.begin(), every_way.end()}; }
    void upload(Scene const& scene) override;
    DrawWork draw_depth(DepthPass const& pass) override;
    DrawWork draw_scene(ScenePass const& pass) override;
    DrawWork draw_split_by_split(DepthPass const& maps, ScenePass const& view) override;
    DrawWork fit_maps(FitPass const& pass) override;
    [[nodiscard]] Image<float> read_depth(int layer) override;
    [[nodiscard]] Frame read_frame() override;
    [[nodiscard]] Image<float> read_eye_depth() override;
    [[nodiscard]] std::vector<MapConstants> read_fit() override;
    [[nodiscard]] std::vector<std::string> take_messages() override;

    [[nodiscard]] std::vector<Call> const& calls() const noexcept { return calls_; }

private:
    bool accept(std::string const& fault);

    std::vector<Call> calls_;
    std::vector<std::string> messages_;
    std::vector<Object> objects_;
    int map_size_ = 0;
    int layers_ = 0;
    bool there_is_a_fit_ = false;
    Extent extent_, fit_extent_;
    glm::vec4 sky_{0.0f};
};

}  // namespace shadowmath::backend
