// SPDX-License-Identifier: MIT
//
// That the compute runner does what it says on every driver.
#include "tests/twins/drivers.hpp"

#include "twins/embedded.hpp"

#include <array>

namespace {

using namespace shadowmath::twins;

class Runner : public OnDriver {};
INSTANTIATE_TEST_SUITE_P(Drivers, Runner, every_driver, driver_name);

struct Uniforms {
    std::uint32_t count = 0;
    float factor = 0.0f;
    float unused[2] = {};
};

TEST_P(Runner, EachPassSeesWhatThoseBeforeItWrote) {
    constexpr std::size_t count = 1000;
    std::vector<float> values(count);
    for (std::size_t i = 0; i < count; ++i) values[i] = float(i);
    Storage const value = upload(*runner, values), counted = runner->make_storage(sizeof(std::uint32_t));
    // Two layers of 2 x 1 texels; the shader reads the second.
    Texture2DArray const texture = runner->make_texture({2, 1}, 2, std::array{9.0f, 9.0f, 0.25f, 0.5f});
    std::array<Uniforms, 3> const uniforms{{{count, 2.0f}, {count, 0.5f}, {count, 0.0f}}};
    std::vector<Dispatch> passes;
    for (Uniforms const& u : uniforms)
        passes.push_back({&shaders::runner_comp,
                          {(count + 63) / 64, 1, 1},
                          {value, counted},
                          {texture},
                          std::as_bytes(std::span(&u, 1))});
    EXPECT_GE(runner->run({passes.data(), 2}), 0.0);

    auto const after_two = read_back<float>(*runner, value, count);
    std::uint32_t above_one = 0;
    for (std::size_t i = 0; i < count; ++i) {
        float const texel = i % 2 == 0 ? 0.25f : 0.5f, once = float(i) * 2.0f + texel, twice = once * 0.5f + texel;
        EXPECT_EQ(after_two[i], twice);
        above_one += std::uint32_t(once > 1.0f) + std::uint32_t(twice > 1.0f);
    }
    EXPECT_EQ(read_back<std::uint32_t>(*runner, counted, 1).front(), above_one);

    EXPECT_GE(runner->run({passes.data() + 2, 1}), 0.0);  // what lies on the device has stayed there
    EXPECT_EQ(read_back<float>(*runner, value, count)[7], 0.5f);
    EXPECT_EQ(read_back<std::uint32_t>(*runner, counted, 1).front(), above_one);
}

TEST_P(Runner, StorageBeginsAsZerosAndMayBeEmpty) {
    Storage const zeros = runner->make_storage(12), nothing = runner->make_storage(0);
    EXPECT_EQ(read_back<std::uint32_t>(*runner, zeros, 3), std::vector<std::uint32_t>(3));
    EXPECT_TRUE(read_back<std::uint32_t>(*runner, nothing, 0).empty());
}

}  // namespace
