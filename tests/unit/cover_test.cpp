// SPDX-License-Identifier: MIT
//
// What triangles cover of tiles, sample by sample in long double. Samples within a thousandth of a plane may be on
// either side: floats are all that a line across a pixel is kept in.
#include <shadowmath/irregular/cover.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <random>
#include <vector>

using namespace shadowmath;
using detail::chunk_room;

namespace {

using Exact = long double;

constexpr int tiles_across = 3, tile_rows_of_all = 7, tile_count = tiles_across * tile_rows_of_all;

template <class Lanes>
struct CoverIn : ::testing::Test {
    using Number = typename Lanes::Scalar;
    using WideNumber = Wider<Number>;
    using Raised = detail::RaisedTriangle<Number>;
    using Queue = typename detail::CoverKernel<Lanes>::Queue;

    std::mt19937 bits{20021201};
    IrregularBuffer<Number> buffer;
    PixelFrame<WideNumber> frame;
    std::vector<Number> surface = std::vector<Number>(tile_count * tile_scalars);
    std::vector<std::uint32_t> state = std::vector<std::uint32_t>(tile_count * tile_words);
    std::vector<Raised> raised = std::vector<Raised>(chunk_room);
    std::unique_ptr<Queue> queue = std::make_unique<Queue>();

    CoverIn() {
        buffer.tiles_across = tiles_across;
        buffer.tile_count = tile_count;
        buffer.rect = {5, 3, 4 * tiles_across, 4 * tile_rows_of_all};
        frame.width = 49;
        frame.height = 34;
        buffer.surface = surface.data();
        buffer.state = state.data();
        for (int tile = 0; tile < tile_count; ++tile) {
            Number* const of = surface.data() + tile * tile_scalars;
            for (int k = 0; k < lane_count; ++k) {
                of[k] = Number(in(-0.1, 0.1));
                of[lane_count + k] = Number(in(-0.05, 0.05));
                of[2 * lane_count + k] = Number(in(-0.05, 0.05));
            }
            of[tile_q_at] = Number(in(0.2, 2));
            for (int i = 0; i < 5; ++i) {
                of[key_base_at + i] = Number(in(-5, 0));
                of[key_step_at + i] = Number(in(0, 0.03));
            }
            std::uint32_t* const words = state.data() + tile * tile_words;
            auto* const keys = reinterpret_cast<unsigned char*>(words);
            for (int i = 0; i < 80; ++i) keys[i] = static_cast<unsigned char>(below(256));
            words[alive_at] = below(1u << 16) | below(1u << 16);
            for (int k = 0; k < lane_count; ++k)
                words[mask_at + k] = (words[alive_at] >> k & 1u) != 0 ? word() & word() & 0x7fffffffu : word();
        }
        for (Raised& one : raised) {
            // Four lines about a place among the tiles; two of three are wide apart.
            WideNumber const x = in(-20, -6), y = in(-14, 12), apart = in(0, 1) < 0.7 ? 6 : 1;
            for (int i = 0; i < 4; ++i) {
                double const turn = 1.5707963 * i + in(-0.5, 0.5);
                one.x[i] = std::cos(turn);
                one.y[i] = std::sin(turn);
                one.b[i] = in(-1, 1);
                one.a[i] = WideNumber(apart * in(0, 3)) - one.x[i] * x - one.y[i] * y - one.b[i];
                one.across[i] = Number(one.x[i]);
                one.upward[i] = Number(one.y[i]);
                one.by_q[i] = Number(one.b[i]);
            }
            for (Number& key : one.keys) key = Number(in(-0.5, 6));
        }
    }
    double in(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(bits); }
    std::uint32_t below(std::uint32_t end) { return std::uniform_int_distribution<std::uint32_t>(0, end - 1)(bits); }
    std::uint32_t word() { return static_cast<std::uint32_t>(bits()); }
    [[nodiscard]] detail::CoverKernel<Lanes> kernel() { return {buffer, frame}; }

    void enqueue(std::uint32_t tile, std::vector<std::uint32_t> const& slots) {
        std::copy(slots.begin(), slots.end(), queue->next());
        kernel().enqueue(tile, std::uint32_t(slots.size()), *queue);
    }
    [[nodiscard]] bool reaches(Raised const& one, std::uint32_t tile, int k) const {
        Number const* const of = surface.data() + tile * tile_scalars;
        auto const* const keys = reinterpret_cast<unsigned char const*>(state.data() + tile * tile_words);
        for (int i = 0; i < 5; ++i)
            if (!(Exact(one.keys[i]) >= Exact(keys[16 * i + k]) * of[key_step_at + i] + of[key_base_at + i]))
                return false;
        return true;
    }
    struct Samples {
        std::uint32_t inside = 0, near_a_plane = 0;
    };
    [[nodiscard]] Samples slow(Raised const& one, std::uint32_t tile, int k) const {
        Number const* const of = surface.data() + tile * tile_scalars;
        Samples samples;
        for (int s = 0; s < samples_per_pixel; ++s) {
            Exact const u = Exact(pixel_samples<Number>.u[s]), v = Exact(pixel_samples<Number>.v[s]);
            Exact const x = Exact(int(tile) % tiles_across * 4 + k % 4 + 5) + u - 24.5L;
            Exact const y = Exact(int(tile) / tiles_across * 4 + k / 4 + 3) + v - 17.0L;
            Exact const q = Exact(of[tile_q_at]) + Exact(of[k]) + Exact(of[16 + k]) * u + Exact(of[32 + k]) * v;
            Exact least = 1e9L;
            for (int i = 0; i < 4; ++i)
                least = std::fmin(least, one.x[i] * x + one.y[i] * y + Exact(one.a[i]) + one.b[i] * q);
            samples.inside |= (least >= 0 ? 1u : 0u) << s;
            samples.near_a_plane |= (std::fabs(least) < 1e-3L ? 1u : 0u) << s;
        }
        return samples;
    }
};

using Kinds = ::testing::Types<PlainLanes<float>, PlainLanes<double>, BestLanes<float>>;
TYPED_TEST_SUITE(CoverIn, Kinds);

}  // namespace

TYPED_TEST(CoverIn, DarkenTheSamplesWithinAllFourPlanesOfPixelsThatTheyReach) {
    int dark = 0, done = 0;
    for (int round = 0; round < 8; ++round) {
        auto const before = this->state;
        // Of some tiles none, of some one, of most a few; the same tile may come twice.
        std::vector<std::vector<std::uint32_t>> slots_of(tile_count);
        for (int i = 0; i < 16; ++i) {
            std::uint32_t const tile = this->below(tile_count);
            std::vector<std::uint32_t> slots(i == 3 ? 0 : i == 4 ? 1 : this->below(30));
            for (std::uint32_t& slot : slots) slot = this->below(chunk_room);
            this->enqueue(tile, slots);
            slots_of[tile].insert(slots_of[tile].end(), slots.begin(), slots.end());
        }
        EXPECT_TRUE(this->queue->full());
        this->kernel().cover(this->raised.data(), *this->queue);
        EXPECT_FALSE(this->queue->full());
        EXPECT_EQ(this->queue->tiles, 0u);
        EXPECT_EQ(this->queue->slots, 0u);
        for (std::uint32_t tile = 0; tile < tile_count; ++tile) {
            std::uint32_t const* const now = this->state.data() + tile * tile_words;
            std::uint32_t const* const was = before.data() + tile * tile_words;
            EXPECT_TRUE(std::equal(now, now + alive_at, was)) << "keys are read";
            std::uint32_t alive = was[alive_at];
            for (int k = 0; k < lane_count; ++k) {
                std::uint32_t mask = was[mask_at + k], either = 0;
                for (std::uint32_t const slot : slots_of[tile]) {
                    if ((alive >> k & 1u) == 0 || !this->reaches(this->raised[slot], tile, k)) continue;
                    auto const samples = this->slow(this->raised[slot], tile, k);
                    mask |= samples.inside & ~samples.near_a_plane;
                    either |= samples.near_a_plane;
                }
                std::uint32_t const is = now[mask_at + k];
                EXPECT_EQ(is & ~either, mask & ~either) << tile << ' ' << k;
                bool const all_dark = is == every_sample && is != was[mask_at + k];
                EXPECT_EQ(now[alive_at] >> k & 1u, all_dark ? 0u : alive >> k & 1u) << tile << ' ' << k;
                dark += is != was[mask_at + k];
                done += all_dark;
            }
        }
    }
    EXPECT_GT(dark, 200);
    EXPECT_GT(done, 20);
}

// A tile whose pixels are all reached, by as many triangles as a queue holds and one chunk more.
TYPED_TEST(CoverIn, AFullQueueAndAChunkMoreAreAllLookedAt) {
    using T = typename TypeParam::Scalar;
    constexpr std::uint32_t last = TestFixture::Queue::most_slots - 1;
    for (auto& one : this->raised) {
        for (T& key : one.keys) key = T(1e9);
        // None but that in the last slot covers anything.
        for (int i = 0; i < 4; ++i) {
            one.x[i] = one.y[i] = one.b[i] = 0;
            one.across[i] = one.upward[i] = one.by_q[i] = 0;
            one.a[i] = &one == &this->raised.back() ? 1 : -1;
        }
    }
    std::vector<std::uint32_t> slots(last, 0u), more(chunk_room, 0u);
    more.back() = chunk_room - 1;
    std::uint32_t* const words = this->state.data() + 4 * tile_words;
    words[alive_at] = 0xffffu;
    std::fill(words + mask_at, words + mask_at + lane_count, 0u);
    this->enqueue(2, slots);
    EXPECT_FALSE(this->queue->full());
    this->enqueue(4, more);
    EXPECT_TRUE(this->queue->full());
    this->kernel().cover(this->raised.data(), *this->queue);
    EXPECT_EQ(words[alive_at], 0u);
    for (int k = 0; k < lane_count; ++k) EXPECT_EQ(words[mask_at + k], every_sample);
}

TYPED_TEST(CoverIn, AQueueIsFullOfSixteenTilesOrFiveHundredAndTwelveSlots) {
    for (std::uint32_t tile = 0; tile < 16; ++tile) {
        EXPECT_FALSE(this->queue->full()) << tile;
        EXPECT_EQ(this->queue->next(), this->queue->slot + tile);
        this->enqueue(tile, {tile});
    }
    EXPECT_TRUE(this->queue->full());
    this->queue->tiles = 0;
    this->queue->slots = 511;
    EXPECT_FALSE(this->queue->full());
    this->queue->slots = 512;
    EXPECT_TRUE(this->queue->full());
}
