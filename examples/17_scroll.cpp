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
    double const x = double(scroll.x), y = double(scroll.y);
    std::printf("the window moves by (%.0f, %.0f) texels\n", x, y);

    // Each texel of the new window is either kept or drawn, exactly once.
    std::vector<int> times(size * size, 0);
    int fresh = 0;
    for (int i = 0; i < scroll.fresh.count; ++i) {
        sm::TexelRect const& rect = scroll.fresh.at[std::size_t(i)];
        fresh += rect.width * rect.height;
        for (int v = rect.y; v < rect.y + rect.height; ++v)
            for (int u = rect.x; u < rect.x + rect.width; ++u) ++times[std::size_t(v * size + u)];
    }
    bool once = scroll.kept;
    for (int v = 0; v < size; ++v)
        for (int u = 0; u < size; ++u) {
            std::int64_t const old_u = u + scroll.x, old_v = v + scroll.y;
            bool const kept = old_u >= 0 && old_u < size && old_v >= 0 && old_v < size;
            once = once && times[std::size_t(v * size + u)] + (kept ? 1 : 0) == 1;
        }
    std::printf("%d of %d texels are drawn anew\n", fresh, size * size);
    proof.that(once, "Each texel is kept or drawn, exactly once.");

    sm::example::Drawing drawing("The window moves; and where its texels lie in the map", {-2, -2.5}, {46, 22}, 720);
    drawing.box({0, 0}, {size, size}, "ground");
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
