// SPDX-License-Identifier: MIT
//
// Proves a function of the GLSL library equal to the C++: both answer the same thousands of generated cases, and each
// number must agree within the ulps that the library states. A disagreement prints the input, both answers and the
// ulps; the largest seen are printed as a table when the program ends.
//
// What counts as equal whatever the ulps: NaN and NaN, of any payload; 0 and -0; two magnitudes below the least normal
// number, for a driver may flush them.
#pragma once

#include "tests/twins/draw.hpp"
#include "tests/twins/drivers.hpp"

#include "twins/embedded.hpp"

#include <cstdint>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace shadowmath::twins {

// What a case consists of, and what the C++ makes of it.
class Words {
public:
    // Equal within so many ulps; integers and bools are always equal.
    Words& operator()(float v, std::uint32_t ulps = 0) {
        words_.push_back(std::bit_cast<std::uint32_t>(v));
        allowed_.push_back(static_cast<std::int64_t>(ulps));
        return *this;
    }
    template <int N>
    Words& operator()(glm::vec<N, float, glm::defaultp> const& v, std::uint32_t ulps = 0) {
        for (int i = 0; i < N; ++i) (*this)(v[i], ulps);
        return *this;
    }
    Words& operator()(Mat4<float> const& m, std::uint32_t ulps = 0) {
        for (int i = 0; i < 4; ++i) (*this)(m[i], ulps);
        return *this;
    }
    template <class Whole>
    requires std::is_integral_v<Whole> Words& operator()(Whole v) {
        words_.push_back(static_cast<std::uint32_t>(v));
        allowed_.push_back(-1);
        return *this;
    }
    Words& operator()(ShadowMap<float> const& map) {
        return (*this)(map.clip_from_world)(map.w_min)(static_cast<int>(map.clip.depth))(
            map.clip.ndc_y != map.clip.texture_v)(map.visible);
    }

    [[nodiscard]] std::vector<std::uint32_t> const& words() const { return words_; }
    [[nodiscard]] std::int64_t allowed_ulps(std::size_t i) const { return allowed_[i]; }  // -1: not a float

private:
    std::vector<std::uint32_t> words_;
    std::vector<std::int64_t> allowed_;
};

struct Twin {
    char const* name;
    shaders::Shader const& shader;
    std::uint32_t function;
    std::uint32_t least_distinct = 2500;  // answers: a generator that always ends the same way proves nothing
    std::vector<Texture2DArray> textures = {};
};

inline constexpr std::uint32_t case_count = 12000;

// Runs the shader and compares; `given` and `expected` hold case_count cases each.
void hold_together(ComputeRunner& runner, std::string const& driver, Twin const& twin, Words const& given,
                   Words const& expected);

class Twins : public OnDriver {
protected:
    void SetUp() override {
        OnDriver::SetUp();
        if (runner != nullptr && runner->info().driver.find("llvmpipe") == std::string::npos)
            GTEST_SKIP() << "NOT TESTED: " << runner->info().driver << " may divide with other roundings than stated";
    }

    // one_case(draw, given, expected) draws a case, puts it down in the order in which the shader takes it, and puts
    // down what the C++ answers.
    template <class OneCase>
    void prove(Twin const& twin, OneCase const& one_case) {
        Draw draw(20021201u);
        Words given, expected;
        for (std::uint32_t i = 0; i < case_count; ++i) {
            draw.next_case();
            one_case(draw, given, expected);
        }
        hold_together(*runner, name_of(GetParam()), twin, given, expected);
    }
};

}  // namespace shadowmath::twins
