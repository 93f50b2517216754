// SPDX-License-Identifier: MIT
//
// What is left of a still map when the camera moves: all but a strip. In a map addressed modulo its size only the strip
// is drawn anew.
#include "examples/support/drawing.hpp"
#include "examples/support/example.hpp"

#include <shadowmath/schedule.hpp>
#include <shadowmath/scroll.hpp>

namespace sm = shadowmath;

int main(int argc, char** argv) {
    sm::example::Proof proof(argc, argv);
    constexpr int size = 16;
    sm::LightBasis<double> const basis = sm::light_basis(glm::dvec3(0, -1, 0));
    auto const window = [&](double x, double z) { return sm::grid_window(basis, glm::dvec3(x, 0, z), 0.25, size); };
    auto const before = window(3.0, -2.0), after = window(4.0, -2.75);
    sm::Scroll const scroll = sm::scroll_between(before, after);
    std::printf("the window moves by (%lld, %lld) texels\n", static_cast<long long>(scroll.x),
                static_cast<long long>(scroll.y));

    // Each texel of the new window is either kept or drawn, exactly once.
    std::vector<int> times(size * size, 0);
    int fresh = 0;
    for (int i = 0; i < scroll.fresh.count; ++i) {
        sm::TexelRect const& rect = scroll.fresh.at[std::size_t(i)];
        fresh += rect.width * rect.height;
        for (int y = rect.y; y < rect.y + rect.height; ++y)
            for (int x = rect.x; x < rect.x + rect.width; ++x) ++times[std::size_t(y * size + x)];
    }
    bool once = scroll.kept;
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            std::int64_t const old_x = x + scroll.x, old_y = y + scroll.y;
            bool const kept = old_x >= 0 && old_x < size && old_y >= 0 && old_y < size;
            once = once && times[std::size_t(y * size + x)] + (kept ? 1 : 0) == 1;
        }
    std::printf("%d of %d texels are drawn anew\n", fresh, size * size);
    proof.that(once, "Each texel is kept or drawn, exactly once.");

    sm::example::Drawing drawing("The window moves; and where its texels lie in the map", {-2, -2.5}, {46, 22}, 720);
    drawing.box({0, 0}, {size, size}, "ground");
    double const x = double(scroll.x), y = double(scroll.y);
    drawing.box({x, y}, {x + size, y + size}, "ink");
    drawing.box({26, 0}, {26 + size, size}, "ground");
    for (int i = 0; i < scroll.fresh.count; ++i) {
        sm::TexelRect const& rect = scroll.fresh.at[std::size_t(i)];
        std::string const css_class = "c" + std::to_string(i);
        drawing.box({x + rect.x, y + rect.y}, {x + rect.x + rect.width, y + rect.y + rect.height}, css_class);
        auto const parts = sm::wrapped(after, rect);
        for (int k = 0; k < parts.count; ++k) {
            sm::TexelRect const& part = parts.at[std::size_t(k)];
            drawing.box({26 + part.x, part.y}, {26 + part.x + part.width, part.y + part.height}, css_class);
        }
    }
    drawing.label({0, -1.6}, "the world: grey what the old window held", "start", {0, 0}, "small");
    drawing.label({26, -1.6}, "the map, addressed modulo its size: what is drawn", "start", {0, 0}, "small");
    drawing.write(proof.folder() / "scroll.svg");
    return proof.result();
}
