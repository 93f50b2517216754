// SPDX-License-Identifier: MIT
//
// Laws of what depends on one float, for every float that there is: all 2^32 patterns, NaNs and denormals among them.
//
//   sweep [--stride N] [name ...]      every N-th pattern; an odd N meets all exponents
//
// Another function of one float is one more line in `sweeps`.
#include "tests/laws/finite.hpp"
#include "tests/laws/light.hpp"
#include "tests/laws/splits.hpp"

#include <shadowmath/shadowmath.hpp>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <thread>
#include <vector>

namespace {

using namespace shadowmath;

struct Sweep {
    char const* name;
    bool (*holds)(float);
};

bool is_in(float value, float lo, float hi) {
    return value >= lo && value <= hi;
}

Sweep const sweeps[] = {
    {"finite", [](float x) { return laws::tells_numbers_apart(x); }},
    {"normalize_axis",
     [](float x) {
         Normalized<float> const unit = safe_normalize(glm::vec3(0, x, 0));
         bool const has_direction = std::isfinite(x) && x != 0.0f;
         return has_direction
                    ? unit.ok && unit.direction == glm::vec3(0, x < 0 ? -1 : 1, 0) && unit.length == std::abs(x)
                    : !unit.ok && unit.direction == glm::vec3(0);
     }},
    {"normalize_oblique", [](float x) { return !std::isfinite(x) || laws::normalizes(glm::vec3(x, 1, -x)); }},
    {"sun", [](float x) { return laws::is_usable_or_says_why(directional(glm::vec3(x, -1, 0.5f))); }},
    {"basis",
     [](float x) {
         return !std::isfinite(x) || laws::is_orthonormal(light_basis(directional(glm::vec3(x, 1, 0)).direction));
     }},
    {"cone",
     [](float x) {
         Light<float> const lamp = spot(glm::vec3(0), glm::vec3(0, -1, 0), x, 10.0f);
         bool const kept = is_in(x, 1e-3f, 1.5f);
         return is_in(lamp.half_angle_radians, 1e-3f, 1.5f) && lamp.faults.any() != kept &&
                (!kept || lamp.half_angle_radians == x);
     }},
    {"lambda",
     [](float x) {
         Splits<float> const splits = practical_splits(1.0f, 100.0f, 2, x);
         return laws::is_ordered(splits, 1.0f, 100.0f, 2) && splits.faults.any() != is_in(x, 0.0f, 1.0f) &&
                is_in(splits.plane[1], 9.9999f, 50.5001f);
     }},
    {"near", [](float x) { return laws::is_ordered(uniform_splits(x, 100.0f, 3), x, 100.0f, 3); }},
    {"far", [](float x) { return laws::is_ordered(practical_splits(1.0f, x, 3), 1.0f, x, 3); }},
    {"blend",
     [](float x) {
         SliceRange<float> const range = slice_range(uniform_splits(1.0f, 9.0f, 2), 0, x);
         return is_in(range.blend_begin, range.begin, range.end);
     }},
    {"field_of_view",
     [](float x) {
         ViewVolume<float> const view = perspective_view(Pose<float>{}, x, 1.0f, 0.1f, 100.0f);
         // The half of the least number there is, is none.
         return faults_of(view).any() != (x / 2 > 0.0f && x < 3.14159265f) &&
                all_finite(clip_from_world(view, gl_clip));
     }},
    {"region",
     [](float x) {
         return all_finite(region_matrix(Region<float>{glm::vec2(0), glm::vec2(x, 1)}));
     }},
};

std::uint64_t sweep(Sweep const& one, std::uint64_t stride) {
    std::atomic<std::uint64_t> broken{0}, next{0};
    constexpr std::uint64_t all = std::uint64_t(1) << 32, chunk = 1 << 20;
    auto const work = [&] {
        for (std::uint64_t begin = next.fetch_add(chunk * stride); begin < all; begin = next.fetch_add(chunk * stride))
            for (std::uint64_t i = begin; i < begin + chunk * stride && i < all; i += stride) {
                auto const bits = static_cast<std::uint32_t>(i);
                float value;
                std::memcpy(&value, &bits, sizeof value);
                if (!one.holds(value) && broken++ < 5)
                    std::printf("BROKEN %s at 0x%08x = %a\n", one.name, bits, static_cast<double>(value));
            }
    };
    std::vector<std::thread> threads;
    for (unsigned i = 0; i < std::thread::hardware_concurrency(); ++i) threads.emplace_back(work);
    for (std::thread& thread : threads) thread.join();
    return broken;
}

}  // namespace

int main(int argc, char** argv) {
    std::uint64_t stride = 1;
    std::vector<std::string> wanted;
    for (int i = 1; i < argc; ++i) {
        if (std::strcmp(argv[i], "--stride") == 0 && i + 1 < argc)
            stride = std::strtoull(argv[++i], nullptr, 0);
        else
            wanted.push_back(argv[i]);
    }
    std::uint64_t broken = 0;
    for (Sweep const& one : sweeps) {
        bool chosen = wanted.empty();
        for (std::string const& name : wanted) chosen = chosen || name == one.name;
        if (!chosen) continue;
        std::uint64_t const here = sweep(one, stride == 0 ? 1 : stride);
        std::printf("%s: %llu broken\n", one.name, static_cast<unsigned long long>(here));
        std::fflush(stdout);
        broken += here;
    }
    return broken == 0 ? 0 : 1;
}
