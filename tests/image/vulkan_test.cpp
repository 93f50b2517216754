// SPDX-License-Identifier: MIT
//
// That validation sees: each of the backend's deliberate mistakes is reported, and without one nothing is.
// And that what is missing is told in one sentence.
#include "tests/image/contexts.hpp"
#include "tests/image/quad_over_floor.hpp"

#include <algorithm>
#include <cstdlib>
#include <functional>
#include <iostream>

namespace {

using namespace shadowmath::image_test;

struct Seeded {
    char const* name;
    VulkanMistake mistake;
    char const* reported_as;
};

void PrintTo(Seeded const& seeded, std::ostream* out) {
    *out << seeded.name;
}

class Validation : public testing::TestWithParam<Seeded> {};

INSTANTIATE_TEST_SUITE_P(
    Seeded, Validation,
    testing::Values(Seeded{"UsageForgotten", VulkanMistake::usage_forgotten, "VK_IMAGE_USAGE_TRANSFER_SRC_BIT"},
                    Seeded{"DepthPassWithoutBarrier", VulkanMistake::depth_pass_without_barrier,
                           "SYNC-HAZARD-WRITE-AFTER-WRITE"},
                    Seeded{"CopyWithoutBarrier", VulkanMistake::copy_without_barrier, "SYNC-HAZARD-READ-AFTER-WRITE"},
                    Seeded{"Leak", VulkanMistake::leak, "VkSampler"}),
    [](auto const& seeded) { return seeded.param.name; });

// What validation has to say of a backend's whole life.
std::vector<std::string> heard_of(std::unique_ptr<Backend> backend, std::vector<std::string> const& last_words) {
    QuadOverFloor const world;
    draw_quad_over_floor(*backend, world, world.pass({32, 24}, 32));
    EXPECT_EQ(backend->read_depth(0).pixels.size(), 32u * 32u);
    std::vector<std::string> heard = backend->take_messages();
    backend.reset();
    heard.insert(heard.end(), last_words.begin(), last_words.end());
    return heard;
}

TEST_P(Validation, ReportsTheMistakeAndNothingWithoutIt) {
    for (VulkanMistake const mistake : {VulkanMistake::none, GetParam().mistake}) {
        std::vector<std::string> last_words;
        std::unique_ptr<Backend> backend;
        if (!try_vulkan(backend, {.validation = true, .last_words = &last_words, .mistake = mistake}))
            GTEST_SKIP() << not_tested;
        auto const heard = heard_of(std::move(backend), last_words);
        auto const is_it = [](std::string const& m) { return m.find(GetParam().reported_as) != std::string::npos; };
        EXPECT_EQ(std::ranges::any_of(heard, is_it), mistake != VulkanMistake::none)
            << (heard.empty() ? "nothing heard" : heard.front());
        EXPECT_TRUE(mistake != VulkanMistake::none || heard.empty()) << heard.front();
    }
}

// The sentence that a backend without something ends with; the environment is the child's own.
void expect_sentence(std::function<void()> const& change_environment, bool validation, char const* sentence) {
    std::unique_ptr<Backend> backend;
    if (!try_vulkan(backend, {.validation = true})) GTEST_SKIP() << not_tested;
    testing::GTEST_FLAG(death_test_style) = "threadsafe";
    auto const report = [&] {
        change_environment();
        try {
            backend = make_vulkan_backend({.validation = validation});
        } catch (std::runtime_error const& error) {
            std::cerr << error.what() << '\n';
            std::exit(3);
        }
    };
    EXPECT_EXIT(report(), testing::ExitedWithCode(3), sentence);
}

TEST(VulkanDeathTest, AMissingDriverIsOneSentence) {
    expect_sentence(
        [] {
            setenv("VK_DRIVER_FILES", "/nonexistent.json", 1);
            setenv("VK_ICD_FILENAMES", "/nonexistent.json", 1);
        },
        false, "no Vulkan 1.1 driver.*mesa-vulkan-drivers");
}

TEST(VulkanDeathTest, MissingLayersAreOneSentence) {
    expect_sentence([] { setenv("VK_LAYER_PATH", "/nonexistent", 1); }, true,
                    "validation layers are missing.*vulkan-validationlayers");
}

TEST(Vulkan, OneOutlivesAnother) {
    std::unique_ptr<Backend> survivor, other;
    if (!try_vulkan(survivor, {.validation = true})) GTEST_SKIP() << not_tested;
    ASSERT_TRUE(try_vulkan(other, {.validation = true}));
    other.reset();
    QuadOverFloor const world;
    draw_quad_over_floor(*survivor, world, world.pass({32, 24}, 32));
    EXPECT_TRUE(survivor->take_messages().empty());
}

}  // namespace
