// SPDX-License-Identifier: MIT
//
// Where to cut the view along its depth: three schemes, and what lambda does between two of them.
#include "examples/support/drawing.hpp"
#include "examples/support/example.hpp"

#include <shadowmath/splits.hpp>

namespace sm = shadowmath;

int main(int argc, char** argv) {
    sm::example::Proof proof(argc, argv);
    struct Scheme {
        char const* name;
        sm::Splits<double> splits;
    } const schemes[] = {
        {"uniform", sm::uniform_splits(1.0, 100.0, 4)},
        {"practical, lambda 0.5", sm::practical_splits(1.0, 100.0, 4, 0.5)},
        {"practical, lambda 0.8", sm::practical_splits(1.0, 100.0, 4, 0.8)},
        {"logarithmic", sm::logarithmic_splits(1.0, 100.0, 4)},
        {"pinned at 3 m", sm::pinned_splits(1.0, 100.0, 4, 3.0)},
    };

    sm::example::Drawing drawing("Four splits of 1 m to 100 m of eye depth", {-2, -0.6}, {102, 5.2}, 720, 330);
    double row = 4.3;
    for (auto const& [name, splits] : schemes) {
        std::printf("%-22s", name);
        for (int i = 0; i <= splits.count; ++i) std::printf(" %8.3f", splits.plane[i]);
        std::printf("\n");
        for (int i = 0; i < splits.count; ++i) {
            std::string const css_class = "c" + std::to_string(i);
            drawing.box({splits.plane[i], row}, {splits.plane[i + 1], row + 0.5}, css_class);
        }
        drawing.label({1, row}, name, "start", {2, 14}, "small");
        row -= 1.0;
    }
    for (double const z : {1.0, 25.0, 50.0, 75.0, 100.0})
        drawing.label({z, -0.35}, std::to_string(static_cast<int>(z)) + " m", "middle", {0, 0}, "small");
    drawing.write(proof.folder() / "splits.svg");

    bool exact = true, increasing = true;
    for (auto const& [name, splits] : schemes) {
        exact = exact && splits.plane[0] == 1.0 && splits.plane[splits.count] == 100.0;
        for (int i = 0; i < splits.count; ++i) increasing = increasing && splits.plane[i] < splits.plane[i + 1];
    }
    proof.that(exact, "Splits start at near and end at the shadow distance, exactly.");
    proof.that(increasing, "They are strictly increasing.");
    proof.that(schemes[4].splits.plane[1] == 3.0, "A pinned first split ends where it is pinned.");
    return proof.result();
}
