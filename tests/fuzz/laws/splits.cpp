// SPDX-License-Identifier: MIT
#include "tests/laws/splits.hpp"
#include "tests/fuzz/inputs.hpp"
#include "tests/laws/slice.hpp"

namespace shadowmath::fuzz {
namespace {

template <class T>
void try_splits(Case& c) {
    bool const good = c.one_in(2);
    T const z_near = good ? c.magnitude<T>(-10, 10) : c.number<T>();
    T const z_far = good ? z_near * c.magnitude<T>(1, 20) : c.number<T>();
    T const lambda = good ? c.uniform<T>(T(0), T(1)) : c.number<T>();
    int const count = c.below(24) - 4;
    T const first_end = c.number<T>();
    Splits<T> const uniform = c.call([&] { return uniform_splits(z_near, z_far, count); });
    Splits<T> const practical = c.call([&] { return practical_splits(z_near, z_far, count, lambda); });
    Splits<T> const pinned = c.call([&] { return pinned_splits(z_near, z_far, count, first_end, lambda); });
    int const asked = count < 0 ? 0 : count;
    for (Splits<T> const* splits : {&uniform, &practical, &pinned})
        c.require(laws::is_ordered(*splits, z_near, z_far, asked), "splits rise from near to far");
    for (int i = 0; i < practical.count; ++i) {
        SliceRange<T> const range = slice_range(practical, i, c.number<T>());
        c.require(range.begin < range.end && range.blend_begin <= range.end, "a slice has a range");
    }
    c.hash(uniform.plane, uniform.count + 1);
    if (!good || practical.count == 0 || practical.count != asked) return;
    // With -ffast-math clang makes pow(x, y) of exp2(y * log2(x)), whose error grows with the exponent.
    if (c.numbers() == Numbers::any)
        c.require(laws::follows_the_formula(practical, z_near, z_far, lambda), "practical splits follow their formula");
    T const worth = lambda_for_first_split(z_near, z_far, count, practical.plane[1]);
    c.require(worth >= T(0) && worth <= T(1), "lambda lies in its range");
}

[[maybe_unused]] bool const splits_target =
    add_target("splits", [](Case& c) { c.one_in(2) ? try_splits<float>(c) : try_splits<double>(c); });

}  // namespace
}  // namespace shadowmath::fuzz
