// SPDX-License-Identifier: MIT
//
// Sixteen pixels at once, beside one at a time: the quad of each, whether light may reach it, where its corners are in
// the grid, and what is kept of it.
#include "tests/support/tile_picture.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>

using namespace shadowmath;
using namespace shadowmath::test;

namespace {

using Exact = long double;

template <class Lanes>
struct TileIn : TilePicture<Lanes> {};
using Kinds = ::testing::Types<PlainLanes<float>, PlainLanes<double>, BestLanes<float>>;
TYPED_TEST_SUITE(TileIn, Kinds);

}  // namespace

TYPED_TEST(TileIn, IsSeenAsItsPixelsAreOneByOne) {
    using T = typename TypeParam::Scalar;
    for (int round = 0; round < 6 * int(std::size(tile_forms)); ++round) {
        TileForm const& form = tile_forms[round % int(std::size(tile_forms))];
        this->take(form);
        int sound = 0, dark = 0, alive = 0;
        for (int tile = 0; tile < this->buffer.tile_count; ++tile) {
            int const column = 2 + tile % 5 * 4, row = 1 + tile / 5 * 4;
            typename TestFixture::Kernel::Seen seen;
            this->kernel().see(tile, column, row, seen);
            auto const lo_x = this->numbers(seen.lo_x), hi_x = this->numbers(seen.hi_x),
                       lo_y = this->numbers(seen.lo_y), hi_y = this->numbers(seen.hi_y),
                       far_end = this->numbers(seen.depth), lo_w = this->numbers(seen.lo_w),
                       hi_w = this->numbers(seen.hi_w);
            T bounds[5];
            for (int i = 0; i < 5; ++i)
                bounds[i] = i == 0 || i == 2 ? std::numeric_limits<T>::max() : std::numeric_limits<T>::lowest();
            T const* const kept = this->buffer.surface + tile * tile_scalars;
            bool first = true;
            for (std::size_t k = 0; k < 16; ++k) {
                auto const pixel = this->slow(column + int(k) % 4, row + int(k) / 4);
                bool const lives = (seen.alive >> k & 1u) != 0;
                bool const is_plain = pixel.least_side > 1e-3L && pixel.least_w_over > 1e-4L;
                if (is_plain) {
                    EXPECT_EQ((seen.away >> k & 1u) != 0, pixel.sound && !pixel.lit) << k;
                    EXPECT_EQ(lives, pixel.alive) << k;
                }
                sound += pixel.sound, dark += pixel.sound && !pixel.lit, alive += lives;
                if (seen.alive == 0) continue;
                if (!lives) {
                    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(kept[16 * i + k], T(0));
                    continue;
                }
                this->expect_near(lo_x[k], pixel.keys[0], "lo x");
                this->expect_near(hi_x[k], pixel.keys[1], "hi x");
                this->expect_near(lo_y[k], pixel.keys[2], "lo y");
                this->expect_near(hi_y[k], pixel.keys[3], "hi y");
                this->expect_near(far_end[k], pixel.keys[4], "depth");
                this->expect_near(lo_w[k], pixel.lo_w, "lo w");
                this->expect_near(hi_w[k], pixel.hi_w, "hi w");
                bounds[0] = std::min(bounds[0], lo_x[k]), bounds[1] = std::max(bounds[1], hi_x[k]);
                bounds[2] = std::min(bounds[2], lo_y[k]), bounds[3] = std::max(bounds[3], hi_y[k]);
                bounds[4] = std::max(bounds[4], far_end[k]);
                // The tile's q is that of its first pixel; what is left over is known to far more digits.
                T const tile_q = kept[tile_q_at];
                if (first) this->expect_near(tile_q, pixel.quad.q, "q");
                first = false;
                this->expect_near(kept[16 + k], pixel.quad.q_x, "q_x");
                this->expect_near(kept[32 + k], pixel.quad.q_y, "q_y");
                T const eps = std::numeric_limits<T>::epsilon();
                double const change = double(std::fabs(pixel.quad.q_x) + std::fabs(pixel.quad.q_y));
                if (!form.placed) {
                    EXPECT_NEAR(double(Exact(kept[k]) + Exact(tile_q) - pixel.quad.q), 0.0,
                                40 * double(eps) * (std::abs(double(kept[k])) + change));
                }
            }
            if (seen.alive == 0) continue;
            for (int i = 0; i < 5; ++i) EXPECT_EQ(seen.bounds[i], bounds[i]) << i;
        }
        EXPECT_GT(sound, 180);
        EXPECT_GT(dark, 5);
        EXPECT_GT(alive, 50);
    }
}

// Beside and below the part of the picture, copies of what is within it: nothing else is read.
TYPED_TEST(TileIn, IsGatheredFromThePartOfThePictureAlone) {
    for (TileForm const& form : tile_forms) {
        this->take(form);
        // Each pixel by its number.
        for (int i = 0; i < picture_width * picture_height; ++i) {
            using T = typename TypeParam::Scalar;
            this->depth[std::size_t(i)] = T(i);
            for (int axis = 0; axis < 3; ++axis) {
                this->normal[std::size_t(i * form.normal_stride + axis)] = T(1000 * axis + i);
                this->position[std::size_t(i * form.position_stride + axis)] = T(2000 * axis + i);
            }
        }
        this->buffer.frame.eye = Vec3<typename TypeParam::Scalar>(1, 2, 3);
        for (int row = 1; row < 14; row += 4)
            for (int column = 2; column < 20; column += 4) {
                typename TestFixture::Kernel::Surface surface;
                this->kernel().gather(column, row, surface);
                for (int k = 0; k < lane_count; ++k) {
                    int const x = column + k % 4 < 20 ? column + k % 4 : column,
                              y = row + k / 4 < 14 ? row + k / 4 : row;
                    int const pixel = y * picture_width + x;
                    for (int axis = 0; axis < 3; ++axis) {
                        EXPECT_EQ(this->numbers(surface.normal[axis])[std::size_t(k)], 1000 * axis + pixel);
                        if (!form.placed) continue;
                        EXPECT_EQ(this->numbers(surface.place[axis])[std::size_t(k)], 2000 * axis + pixel - axis - 1);
                    }
                    if (form.placed) continue;
                    EXPECT_EQ(this->numbers(surface.place[0])[std::size_t(k)], pixel);
                }
            }
    }
}

// Rows of the map so large that some corners are at no number.
TYPED_TEST(TileIn, NoPixelLivesWhoseBoundsAreNoNumbers) {
    using T = typename TypeParam::Scalar;
    int dead = 0;
    for (TileForm const& form : tile_forms)
        for (int r = 0; r < 3; ++r)
            for (T const sign : {T(-1), T(1)}) {
                this->take(form);
                double const fits = (form.lamp && form.flat ? 40 : 1) * (r == 2 ? 0.7 : 20.0);
                this->buffer.row[r] *= T(double(sign) / fits) * std::numeric_limits<T>::max();
                for (int tile = 0; tile < this->buffer.tile_count; ++tile) {
                    typename TestFixture::Kernel::Seen seen;
                    this->kernel().see(tile, 2 + tile % 5 * 4, 1 + tile / 5 * 4, seen);
                    if (seen.alive == 0) continue;
                    for (TypeParam const& bound : {seen.lo_x, seen.hi_x, seen.lo_y, seen.hi_y, seen.depth}) {
                        auto const numbers = this->numbers(bound);
                        for (std::size_t k = 0; k < 16; ++k) {
                            dead += !std::isfinite(numbers[k]);
                            EXPECT_TRUE(std::isfinite(numbers[k]) || (seen.alive >> k & 1u) == 0) << r;
                        }
                    }
                }
            }
    EXPECT_GT(dead, 100);
}
