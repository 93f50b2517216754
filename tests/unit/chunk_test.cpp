// SPDX-License-Identifier: MIT
#include <shadowmath/irregular/chunk.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <random>
#include <vector>

using namespace shadowmath;
using detail::Cell, detail::cell_at, detail::chunk_room;

namespace {

template <class Lanes>
class Chunk : public ::testing::Test {
protected:
    using Real = typename Lanes::Scalar;
    using Kept = detail::CasterChunk<Lanes>;

    // What is behind the last one may be anything.
    void SetUp() override {
        detail::CasterBounds<Lanes>& bounds = chunk->bounds;
        std::fill(std::begin(bounds.lo_x), std::end(bounds.lo_x), Real(-1e30));
        std::fill(std::begin(bounds.lo_y), std::end(bounds.lo_y), Real(-1e30));
        std::fill(std::begin(bounds.hi_x), std::end(bounds.hi_x), Real(1e30));
        std::fill(std::begin(bounds.hi_y), std::end(bounds.hi_y), Real(1e30));
        std::fill(std::begin(bounds.depth), std::end(bounds.depth), Real(-1e30));
    }

    // Off every edge of a cell.
    Real between(Real lo, Real hi) {
        auto const odd = static_cast<Real>(2 * (random() >> 16) + 1) / Real(0x1p17);
        return lo + (hi - lo) * odd;
    }
    detail::CasterBatch<Lanes> batch(std::uint32_t sound) {
        detail::CasterBatch<Lanes> made{};
        made.sound = sound;
        for (std::size_t k = 0; k < lane_count; ++k) {
            for (std::size_t axis = 0; axis < 4; axis += 2) {
                made.bounds[axis][k] = between(Real(-4), Real(60));
                made.bounds[axis + 1][k] = made.bounds[axis][k] + between(Real(0), Real(12));
            }
            made.depth[k] = between(Real(0), Real(1));
            for (auto& row : made.plane)
                for (auto& of_lane : row) of_lane[k] = between(Real(-1), Real(1));
        }
        return made;
    }
    void fill() {
        while (!chunk->full()) chunk->add(batch(static_cast<std::uint32_t>(random()) & 0xffffu));
    }

    std::mt19937 random{7};
    std::unique_ptr<Kept> chunk = std::make_unique<Kept>();
};
using Kinds = ::testing::Types<PlainLanes<float>, PlainLanes<double>, BestLanes<float>
#if defined(__AVX2__) && defined(__FMA__)
                               ,
                               Avx2Lanes
#endif
                               >;
TYPED_TEST_SUITE(Chunk, Kinds);

}  // namespace

TYPED_TEST(Chunk, KeepsTheSoundTrianglesOfABatchAndNoOther) {
    using T = typename TypeParam::Scalar;
    auto const batch = this->batch(0b1000000000100101u);
    this->chunk->add(batch);
    auto const& bounds = this->chunk->bounds;
    ASSERT_EQ(bounds.count, 4u);
    EXPECT_EQ(bounds.there(0), 0b1111u);
    std::uint32_t slot = 0;
    for (int const k : {0, 2, 5, 15}) {
        auto const& raised = this->chunk->raised[slot];
        EXPECT_EQ(bounds.slot[slot], slot);
        EXPECT_EQ(bounds.lo_x[slot], batch.bounds[0][k]);
        EXPECT_EQ(bounds.hi_x[slot], batch.bounds[1][k]);
        EXPECT_EQ(bounds.lo_y[slot], batch.bounds[2][k]);
        EXPECT_EQ(bounds.hi_y[slot], batch.bounds[3][k]);
        EXPECT_EQ(bounds.depth[slot], batch.depth[k]);
        // The larger a key, the more the triangle may touch.
        EXPECT_EQ(raised.keys[0], batch.bounds[1][k]);
        EXPECT_EQ(raised.keys[1], -batch.bounds[0][k]);
        EXPECT_EQ(raised.keys[2], batch.bounds[3][k]);
        EXPECT_EQ(raised.keys[3], -batch.bounds[2][k]);
        EXPECT_EQ(raised.keys[4], -batch.depth[k]);
        for (int i = 0; i < 4; ++i) {
            EXPECT_EQ(raised.x[i], batch.plane[0][i][k]);
            EXPECT_EQ(raised.y[i], batch.plane[1][i][k]);
            EXPECT_EQ(raised.a[i], batch.plane[2][i][k]);
            EXPECT_EQ(raised.b[i], batch.plane[3][i][k]);
            EXPECT_EQ(raised.across[i], T(raised.x[i]));
            EXPECT_EQ(raised.upward[i], T(raised.y[i]));
            EXPECT_EQ(raised.by_q[i], T(raised.b[i]));
        }
        ++slot;
    }
    this->chunk->clear();
    EXPECT_EQ(bounds.count, 0u);
}

TYPED_TEST(Chunk, IsFullWhereAWholeBatchMightNotFit) {
    for (std::uint32_t had = 0; had + lane_count <= chunk_room; had += lane_count) {
        EXPECT_FALSE(this->chunk->full()) << had;
        this->chunk->add(this->batch(0xffffu));
    }
    EXPECT_TRUE(this->chunk->full());
    EXPECT_EQ(this->chunk->bounds.count, chunk_room);
    EXPECT_EQ(this->chunk->bounds.there(chunk_room - lane_count), 0xffffu);
}

TYPED_TEST(Chunk, TogetherTheyTouchWhatOneOfThemDoes) {
    using T = typename TypeParam::Scalar;
    T farther = 0;
    for (std::uint32_t const sound : {1u, 0b10110u, 0x8000u, 0xffffu, 0xffffu}) {
        auto batch = this->batch(sound);
        for (std::size_t k = 0; k < lane_count; ++k) {  // the later, the farther on each side
            for (int const lo : {0, 2}) batch.bounds[lo][k] -= farther;
            for (int const hi : {1, 3}) batch.bounds[hi][k] += farther;
            batch.depth[k] -= farther;
        }
        farther += T(100);
        this->chunk->add(batch);
        auto const& bounds = this->chunk->bounds;
        T all[5];
        this->chunk->together(all);
        auto const count = static_cast<std::ptrdiff_t>(bounds.count);
        EXPECT_EQ(all[0], *std::min_element(bounds.lo_x, bounds.lo_x + count));
        EXPECT_EQ(all[1], *std::max_element(bounds.hi_x, bounds.hi_x + count));
        EXPECT_EQ(all[2], *std::min_element(bounds.lo_y, bounds.lo_y + count));
        EXPECT_EQ(all[3], *std::max_element(bounds.hi_y, bounds.hi_y + count));
        EXPECT_EQ(all[4], *std::min_element(bounds.depth, bounds.depth + count));
    }
}

TYPED_TEST(Chunk, CellsLeaveNoGapAndGoOnBeyondTheMap) {
    using T = typename TypeParam::Scalar;
    constexpr int map_size = 64, shift = most_divisions + 3;  // eight texels a cell
    for (int i = 0; i < 8; ++i) {
        Cell<T> const cell = cell_at<T>(i, 7 - i, shift, map_size);
        EXPECT_EQ(cell.x0, i == 0 ? std::numeric_limits<T>::lowest() : T(8 * i));
        EXPECT_EQ(cell.x1, i == 7 ? std::numeric_limits<T>::max() : T(8 * i + 8));
        EXPECT_EQ(cell.y0, i == 7 ? std::numeric_limits<T>::lowest() : T(8 * (7 - i)));
        EXPECT_EQ(cell.y1, i == 0 ? std::numeric_limits<T>::max() : T(8 * (7 - i) + 8));
    }
}

TYPED_TEST(Chunk, MeetsATriangleAndANodeThatTouchInOneCellAndOthersInNone) {
    using T = typename TypeParam::Scalar;
    constexpr int cells = 4, map_size = 64, shift = most_divisions + 4;
    this->fill();
    auto const& bounds = this->chunk->bounds;
    auto const here = std::make_unique<detail::CellCasters<TypeParam>>();
    int met = 0, missed = 0;
    for (int trial = 0; trial < 50; ++trial) {
        // Every other node begins where a cell does.
        T const x = trial % 2 == 0 ? this->between(T(-4), T(60)) : T(16 * (1 + trial % 3));
        T const y = trial % 4 < 2 ? this->between(T(-4), T(60)) : T(16 * (1 + trial % 3));
        T const node[5] = {x, x + this->between(T(0), T(20)), y, y + this->between(T(0), T(20)),
                           this->between(T(0), T(1))};
        std::vector<int> found(bounds.count, 0);
        for (int j = 0; j < cells; ++j)
            for (int i = 0; i < cells; ++i) {
                Cell<T> const cell = cell_at<T>(i, j, shift, map_size);
                bool const lists_it =
                    node[1] >= cell.x0 && node[0] < cell.x1 && node[3] >= cell.y0 && node[2] < cell.y1;
                if (!lists_it) continue;
                here->take(bounds, cell, T(1));
                std::uint32_t slots[chunk_room + lane_count];
                std::uint32_t const count = here->find(node, cell, slots);
                for (std::uint32_t n = 0; n < count; ++n) ++found.at(slots[n]);
            }
        for (std::uint32_t k = 0; k < bounds.count; ++k) {
            bool const touches = bounds.hi_x[k] >= node[0] && bounds.lo_x[k] <= node[1] && bounds.hi_y[k] >= node[2] &&
                                 bounds.lo_y[k] <= node[3] && bounds.depth[k] <= node[4];
            EXPECT_EQ(found[k], touches ? 1 : 0) << trial << ' ' << k;
            ++(touches ? met : missed);
        }
    }
    EXPECT_GT(met, 100);
    EXPECT_GT(missed, 100);
}

TYPED_TEST(Chunk, TakesNothingIntoACellBeyondItsFarEnd) {
    using T = typename TypeParam::Scalar;
    this->fill();
    auto const here = std::make_unique<detail::CellCasters<TypeParam>>();
    Cell<T> const whole = cell_at<T>(0, 0, most_divisions + 6, 64);
    auto const& bounds = this->chunk->bounds;
    for (T const far_end : {T(-1), T(0.25), T(0.5), T(2)}) {
        here->take(bounds, whole, far_end);
        EXPECT_EQ(here->bounds.count,
                  std::count_if(bounds.depth, bounds.depth + static_cast<std::ptrdiff_t>(bounds.count),
                                [&](T depth) { return depth <= far_end; }));
        for (std::uint32_t i = 0; i < here->bounds.count; ++i) EXPECT_LE(here->bounds.depth[i], far_end);
    }
}

TYPED_TEST(Chunk, AllOfAFullOneFitIntoACell) {
    using T = typename TypeParam::Scalar;
    while (!this->chunk->full()) this->chunk->add(this->batch(0xffffu));
    auto const here = std::make_unique<detail::CellCasters<TypeParam>>();
    Cell<T> const cell{T(-4), T(100), T(-4), T(100)};
    here->take(this->chunk->bounds, cell, T(1));
    EXPECT_EQ(here->bounds.count, chunk_room);
    T const node[5] = {T(-100), T(100), T(-100), T(100), T(1)};
    std::uint32_t slots[chunk_room + lane_count];
    EXPECT_EQ(here->find(node, cell, slots), chunk_room);
}
