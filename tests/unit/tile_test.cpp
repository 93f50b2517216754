// SPDX-License-Identifier: MIT
//
// Sixteen pixels at once, beside one at a time in long double: the quad of each, whether light may reach it, where its
// corners are in the grid, and what is kept of it.
#include "tests/support/traced.hpp"

#include <shadowmath/irregular/tile.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <random>
#include <vector>

using namespace shadowmath;

namespace {

using Exact = long double;

constexpr int width = 23, height = 15, map_size = 32;

// What receivers are given as.
struct Form {
    bool flat, lamp, placed;
    int normal_stride, position_stride;
};
constexpr Form forms[] = {{false, false, false, 3, 3}, {false, false, true, 3, 3}, {false, true, false, 5, 3},
                          {false, true, true, 3, 4},   {true, false, false, 3, 3}, {true, false, true, 4, 6},
                          {true, true, false, 3, 3},   {true, true, true, 3, 3}};

template <class Lanes>
struct TileIn : ::testing::Test {
    using T = typename Lanes::Scalar;
    using Kernel = detail::TileKernel<Lanes>;

    std::mt19937 bits{20021201};
    IrregularBuffer<T> buffer;
    PixelFrame<Exact> frame;
    Light<Exact> light;
    Receivers<T> receivers;
    std::vector<T> depth, position, normal;
    std::vector<T> scalars;
    std::vector<std::uint32_t> words;
    detail::Parts<T> parts;
    T w_min = T(0.02);

    double in(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(bits); }
    Vec3<T> vector() { return {T(in(-1, 1)), T(in(-1, 1)), T(in(-1, 1))}; }

    // A picture of pieces of surface that lie anywhere, seen from the left of the middle; its part is no whole tiles.
    void take(Form const& form) {
        auto const pose = pose_looking(Vec3<T>(1, 4, 5), Vec3<T>(T(0.1), T(-0.8), T(-1)), Vec3<T>(0, 1, 0));
        ViewVolume<T> eye = form.flat ? orthographic_view<T>(pose, -6, 9, -5, 5, T(0.1), 100)
                                      : perspective_view<T>(pose, T(0.9), T(1.5), T(0.1), T(100));
        eye.left *= T(1.25);
        buffer = {};
        buffer.frame = pixel_frame(eye, width, height);
        frame = frame_in<Exact>(buffer.frame);
        auto const from = form.lamp ? spot(Vec3<T>(2, 9, 1), Vec3<T>(0, -1, 0), T(0.7), T(50))
                                    : directional(Vec3<T>(T(0.3), T(-1), T(0.2)));
        light.kind = from.kind;
        light.direction = Vec3<Exact>(from.direction);
        light.position = Vec3<Exact>(from.position);
        buffer.light = pixel_light(buffer.frame, from);
        buffer.rect = {2, 1, 18, 13};
        buffer.map_size = map_size;
        buffer.tiles_across = 5;
        buffer.tile_count = 20;
        buffer.level_count = 4;
        // Of a sun all are at w = 1; of a lamp w falls to 0 where the light stands.
        buffer.row[0] = Vec4<T>(T(0.9), T(0.2), T(-0.1), T(16));
        buffer.row[1] = Vec4<T>(T(-0.2), T(0.3), T(0.8), T(12));
        buffer.row[2] = Vec4<T>(T(0.02), T(0.03), T(-0.04), T(0.5));
        buffer.row[3] = form.lamp ? Vec4<T>(T(0.02), T(-0.1), T(0.01), T(0.1)) : Vec4<T>(0, 0, 0, 1);
        // Before a flat eye some have a w beyond 1.
        if (form.lamp && form.flat)
            for (auto& row : buffer.row) row *= T(40);
        buffer.texel_error = T(0.02);
        buffer.texel_error_here = T(0.3);
        buffer.depth_error = T(0.0015);
        buffer.depth_error_here = T(0.04);
        buffer.contact_reach = T(5);
        buffer.contact_ray = T(3);
        StorageSize const size = storage_for(width, height, map_size, 500);
        scalars.assign(size.scalars, T(-77));
        words.assign(size.words, 0xabadcafeu);
        parts = detail::lay_out(buffer, {scalars.data(), words.data(), size});
        buffer.least_x = buffer.least_y = std::numeric_limits<T>::max();
        buffer.most_x = buffer.most_y = buffer.most_depth = std::numeric_limits<T>::lowest();

        auto const pixels = std::size_t(width * height);
        depth.assign(pixels, 0);
        position.assign(pixels * std::size_t(form.position_stride), T(-77));
        normal.assign(pixels * std::size_t(form.normal_stride), T(-77));
        for (std::size_t i = 0; i < pixels; ++i) {
            int const column = int(i) % width, row = int(i) / width;
            T const no_number = std::numeric_limits<T>::quiet_NaN();
            // Tiles of one depth, and others that are not; sky and what is no number among both.
            depth[i] = T(column / 4 % 2 == 0 ? 6 + 0.1 * row : in(3, 9));
            Vec3<T> n = in(0, 1) < 0.8 ? Vec3<T>(0, 1, 0) + vector() * T(0.4) : vector();
            int const odd = int(in(0, 60));
            if (odd == 0) n = Vec3<T>(0);
            if (odd == 1) depth[i] = form.flat ? no_number : T(0);
            if (odd == 2) depth[i] = no_number;
            if (odd == 3) n.y = no_number;
            if (odd == 4 && !form.flat) depth[i] = -depth[i];
            for (int axis = 0; axis < 3; ++axis)
                normal[i * std::size_t(form.normal_stride) + std::size_t(axis)] = n[axis];
            PixelFrame<T> const& f = buffer.frame;
            T const x = T(column) + T(0.5) - T(width) / 2, y = T(row) + T(0.5) - T(height) / 2;
            Vec3<T> const p =
                f.eye + (form.flat ? f.across * (x + f.origin.x) + f.upward * (y + f.origin.y) + f.inward * depth[i]
                                   : (f.across * x + f.upward * y + f.inward) * depth[i]);
            for (int axis = 0; axis < 3; ++axis)
                position[i * std::size_t(form.position_stride) + std::size_t(axis)] = p[axis];
        }
        receivers = {};
        receivers.normal = normal.data();
        receivers.normal_stride = form.normal_stride;
        receivers.depth = form.placed ? nullptr : depth.data();
        receivers.position = form.placed ? position.data() : nullptr;
        receivers.position_stride = form.position_stride;
    }
    [[nodiscard]] PixelPlane<T> plane(int i) const {
        PixelFrame<T> const& f = buffer.frame;
        Vec3<T> const axis(buffer.row[i]);
        T const offset =
            buffer.row[i].w + glm::dot(axis, f.across) * f.origin.x + glm::dot(axis, f.upward) * f.origin.y;
        return pixel_plane(f.kind, detail::normal_in_pixels(f, axis), offset);
    }
    [[nodiscard]] Kernel kernel() {
        bool const flat = frame.kind == ViewKind::orthographic;
        return {buffer,
                receivers,
                {plane(0), plane(1), plane(2), plane(3)},
                w_min,
                detail::turn_limit(buffer.frame),
                Lanes::load(detail::tile_columns<T>),
                Lanes::load(detail::tile_rows<T>),
                flat,
                buffer.row[3] == Vec4<T>(0, 0, 0, 1)};
    }

    struct Pixel {
        bool sound = false, lit = false, alive = false;
        Exact least_side = 1;  // how near it is to facing neither the light nor the eye
        MicroQuad<Exact> quad;
        Exact keys[5];  // lo x, hi x, lo y, hi y, depth; with their margins
        Exact lo_w = 1e30L, hi_w = -1e30L, least_w_over = 1;
    };
    [[nodiscard]] Pixel slow(int column, int row) const {
        Pixel pixel;
        PixelRect const& rect = buffer.rect;
        if (column >= rect.x + rect.width || row >= rect.y + rect.height) return pixel;
        auto const i = std::size_t(row * width + column);
        bool const flat = frame.kind == ViewKind::orthographic;
        Vec3<Exact> n, p;
        for (int axis = 0; axis < 3; ++axis) {
            n[axis] = Exact(normal[i * std::size_t(receivers.normal_stride) + std::size_t(axis)]);
            p[axis] = Exact(position[i * std::size_t(receivers.position_stride) + std::size_t(axis)]);
        }
        Exact const away = receivers.position != nullptr ? glm::dot(frame.to_inward, p - frame.eye) : Exact(depth[i]);
        pixel.quad = micro_quad(frame, column, row, away, n);
        pixel.sound = pixel.quad.ok;
        if (!pixel.sound) return pixel;
        // The middle of a quad has the pixel's own depth, however the quad was turned.
        Vec3<Exact> const middle = point_on(frame, pixel.quad, column, row, 0.5L, 0.5L);
        Vec3<Exact> const travel = light.kind == LightKind::directional ? light.direction : middle - light.position;
        Vec3<Exact> const sight = flat ? frame.inward : middle - frame.eye;
        Exact const by_light = glm::dot(n, travel) / glm::length(n) / glm::length(travel);
        Exact const by_eye = glm::dot(n, sight) / glm::length(n) / glm::length(sight);
        pixel.least_side = std::fmin(std::fabs(by_light), std::fabs(by_eye));
        pixel.lit = (by_light > 0) == (by_eye > 0);
        if (!pixel.lit) return pixel;
        pixel.alive = true;
        Exact steepest = 0;
        for (Exact& key : pixel.keys) key = -1e30L;
        pixel.keys[0] = pixel.keys[2] = 1e30L;
        for (Exact const u : {0.0L, 1.0L})
            for (Exact const v : {0.0L, 1.0L}) {
                Vec3<Exact> const corner = point_on(frame, pixel.quad, column, row, u, v) - frame.eye;
                Exact at[4];
                for (int r = 0; r < 4; ++r)
                    at[r] = glm::dot(Vec3<Exact>(buffer.row[r]), corner) + Exact(buffer.row[r].w);
                pixel.alive = pixel.alive && at[3] > Exact(w_min);
                pixel.least_w_over = std::fmin(pixel.least_w_over, std::fabs(at[3] - Exact(w_min)));
                Exact const x = at[0] / at[3], y = at[1] / at[3];
                pixel.keys[0] = std::fmin(pixel.keys[0], x), pixel.keys[1] = std::fmax(pixel.keys[1], x);
                pixel.keys[2] = std::fmin(pixel.keys[2], y), pixel.keys[3] = std::fmax(pixel.keys[3], y);
                pixel.keys[4] = std::fmax(pixel.keys[4], at[2] / at[3]);
                pixel.lo_w = std::fmin(pixel.lo_w, at[3]), pixel.hi_w = std::fmax(pixel.hi_w, at[3]);
                // Before an eye of perspective, of what is over the depth.
                Exact const q = pixel.quad.q + pixel.quad.q_x * u + pixel.quad.q_y * v;
                steepest = std::fmax(steepest, 1 / (flat ? at[3] : at[3] * q));
            }
        auto const& q = pixel.quad;
        Exact const size = std::fabs(q.q) + std::fabs(q.q_x) + std::fabs(q.q_y);
        Exact const reach = flat ? Exact(buffer.contact_reach) + size : Exact(buffer.contact_ray),
                    here = flat ? 1 : size;
        auto const error = [&](T each_metre, T anywhere) {
            return steepest * (reach * Exact(each_metre) + here * Exact(anywhere));
        };
        Exact const pad = error(buffer.texel_error, buffer.texel_error_here) + Exact(1) / 128;
        pixel.keys[0] -= pad, pixel.keys[1] += pad, pixel.keys[2] -= pad, pixel.keys[3] += pad;
        pixel.keys[4] += error(buffer.depth_error, buffer.depth_error_here);
        return pixel;
    }
    static void expect_near(T value, Exact wanted, char const* what) {
        Exact const slack = 2000 * Exact(std::numeric_limits<T>::epsilon()) * (1 + std::fabs(wanted));
        EXPECT_NEAR(double(Exact(value) - wanted), 0.0, double(slack))
            << what << ' ' << value << ", not " << double(wanted);
    }
    static std::array<T, 16> numbers(Lanes const& lanes) {
        std::array<T, 16> stored;
        lanes.store(stored.data());
        return stored;
    }
};

using Kinds = ::testing::Types<PlainLanes<float>, PlainLanes<double>, BestLanes<float>>;
TYPED_TEST_SUITE(TileIn, Kinds);

}  // namespace

TYPED_TEST(TileIn, IsSeenAsItsPixelsAreOneByOne) {
    using T = typename TypeParam::Scalar;
    for (int round = 0; round < 6 * int(std::size(forms)); ++round) {
        Form const& form = forms[round % int(std::size(forms))];
        this->take(form);
        int sound = 0, dark = 0, alive = 0;
        for (int tile = 0; tile < this->buffer.tile_count; ++tile) {
            int const column = 2 + tile % 5 * 4, row = 1 + tile / 5 * 4;
            typename TestFixture::Kernel::Seen seen;
            this->kernel().see(tile, column, row, seen);
            auto const lo_x = this->numbers(seen.lo_x), hi_x = this->numbers(seen.hi_x),
                       lo_y = this->numbers(seen.lo_y), hi_y = this->numbers(seen.hi_y),
                       depth = this->numbers(seen.depth), lo_w = this->numbers(seen.lo_w),
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
                this->expect_near(depth[k], pixel.keys[4], "depth");
                this->expect_near(lo_w[k], pixel.lo_w, "lo w");
                this->expect_near(hi_w[k], pixel.hi_w, "hi w");
                bounds[0] = std::min(bounds[0], lo_x[k]), bounds[1] = std::max(bounds[1], hi_x[k]);
                bounds[2] = std::min(bounds[2], lo_y[k]), bounds[3] = std::max(bounds[3], hi_y[k]);
                bounds[4] = std::max(bounds[4], depth[k]);
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
    for (Form const& form : forms) {
        this->take(form);
        // Each pixel by its number.
        for (int i = 0; i < width * height; ++i) {
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
                    int const pixel = y * width + x;
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
    for (Form const& form : forms)
        for (int r = 0; r < 3; ++r)
            for (T const sign : {T(-1), T(1)}) {
                this->take(form);
                this->buffer.row[r] *= sign * std::numeric_limits<T>::max() / T(form.lamp && form.flat ? 400 : 40);
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

// (lo x, -hi x, lo y, -hi y, -depth) in steps of a 255th of the tile's range, from one to two steps less than they are.
TYPED_TEST(TileIn, KeepsTheKeysOfItsPixelsInAByteEach) {
    using T = typename TypeParam::Scalar;
    int several = 0;
    for (Form const& form : forms) {
        this->take(form);
        for (int tile = 0; tile < this->buffer.tile_count; ++tile) {
            typename TestFixture::Kernel::Seen seen;
            this->kernel().see(tile, 2 + tile % 5 * 4, 1 + tile / 5 * 4, seen);
            if (seen.alive == 0) continue;
            std::array<T, 16> keys[5] = {this->numbers(seen.lo_x), this->numbers(seen.hi_x), this->numbers(seen.lo_y),
                                         this->numbers(seen.hi_y), this->numbers(seen.depth)};
            for (std::size_t i : {1u, 3u, 4u})
                for (T& key : keys[i]) key = -key;
            T const* const kept = this->buffer.surface + tile * tile_scalars;
            auto const* const bytes = reinterpret_cast<unsigned char const*>(this->buffer.state + tile * tile_words);
            for (std::size_t i = 0; i < 5; ++i) {
                T least = std::numeric_limits<T>::max(), most = std::numeric_limits<T>::lowest();
                for (std::size_t k = 0; k < 16; ++k)
                    if ((seen.alive >> k & 1u) != 0)
                        least = std::min(least, keys[i][k]), most = std::max(most, keys[i][k]);
                T const base = kept[key_base_at + i], step = kept[key_step_at + i];
                EXPECT_EQ(base, least);
                if (most == least) {
                    EXPECT_EQ(step, T(0));
                    continue;
                }
                ++several;
                EXPECT_NEAR(double(step), double((most - least) / 255), double(most - least) * 1e-6);
                for (std::size_t k = 0; k < 16; ++k) {
                    if ((seen.alive >> k & 1u) == 0) {
                        EXPECT_EQ(bytes[16 * i + k], 0);
                        continue;
                    }
                    double const steps = double((keys[i][k] - base) / step), slack = 1e-3;
                    double const wanted = std::fmax(0.0, steps - 1.0);
                    EXPECT_LE(bytes[16 * i + k], wanted + slack);
                    EXPECT_GT(bytes[16 * i + k], wanted - 1.0 - slack);
                }
            }
        }
    }
    EXPECT_GT(several, 100);
}

// Made up: sixteen pixels of these bounds, alike in y and depth.
TYPED_TEST(TileIn, KeysOfNoRangeToSpeakOfAreAsTheLeast) {
    using T = typename TypeParam::Scalar;
    struct Row {
        double first, rest;
        bool ranged;
    };
    for (Row const& row : {Row{5, 5, false}, Row{5, 5.0001, false}, Row{5, 5.001, true}, Row{0, 1e-31, false},
                           Row{0, 1e-29, true}, Row{-1e15, 1e15, true}, Row{-1e31, 1e31, false}, Row{0, 1e29, true},
                           Row{16384, 16384.9, false}, Row{-16384, -16385.5, true}}) {
        this->take(forms[0]);
        typename TestFixture::Kernel::Seen seen;
        T lanes[lane_count];
        for (int k = 0; k < lane_count; ++k) lanes[k] = T(k % 5 == 0 ? row.first : row.rest);
        seen.lo_x = seen.hi_x = seen.depth = TypeParam::load(lanes);
        seen.lo_y = seen.hi_y = TypeParam::all(T(3));
        seen.alive = 0xffffu;
        this->kernel().keep_bounds(0, seen);
        T const* const kept = this->buffer.surface;
        EXPECT_EQ(kept[key_step_at] > T(0), row.ranged) << row.first << ' ' << row.rest;
        EXPECT_EQ(kept[key_step_at + 1] > T(0), row.ranged) << row.first << ' ' << row.rest;
        EXPECT_EQ(kept[key_step_at + 2], T(0));
        EXPECT_EQ(kept[key_base_at], T(std::min(row.first, row.rest)));
        EXPECT_EQ(kept[key_base_at + 1], -T(std::max(row.first, row.rest)));
        auto const* const bytes = reinterpret_cast<unsigned char const*>(this->buffer.state);
        for (int k = 0; k < lane_count; ++k) {
            bool const upper = row.ranged && lanes[k] > T(std::min(row.first, row.rest));
            EXPECT_NEAR(bytes[k], upper ? 254 : 0, row.ranged ? 1 : 0);
        }
    }
}

// A tile whose pixels lie far apart for their size is listed in quarters, and those by single pixels.
TYPED_TEST(TileIn, IsListedInPartsThatLieTogether) {
    using T = typename TypeParam::Scalar;
    // What sixteen pixels of half a texel each are listed as: where the right half lies this far off, and the last
    // pixel of the first quarter.
    struct Row {
        double half, one;
        std::uint32_t alive, nodes;
    };
    // A quarter is two by two pixels: 0, 1, 4, 5. Together they reach over eight times a pixel, or four times.
    for (Row const& row :
         {Row{0, 0, 0xffff, 1}, Row{3.4, 0, 0xffff, 1}, Row{3.6, 0, 0xffff, 4}, Row{3.6, 1.4, 0xffff, 4},
          Row{3.6, 1.6, 0xffff, 7}, Row{3.6, 1.6, 0xffee, 5}, Row{3.6, 0, 0xff33, 3}, Row{3.6, 1.6, 0x0000, 0}}) {
        for (bool const upward : {false, true}) {
            this->take(forms[0]);
            typename TestFixture::Kernel::Seen seen;
            T lo[lane_count], hi[lane_count], depth[lane_count];
            for (int k = 0; k < lane_count; ++k) {
                lo[k] = T(5 + (k % 4 >= 2 ? row.half : 0) + (k == 5 ? row.one : 0));
                hi[k] = lo[k] + T(0.5);
                depth[k] = T(k);
            }
            auto const all = [](double value) { return TypeParam::all(T(value)); };
            (upward ? seen.lo_y : seen.lo_x) = TypeParam::load(lo);
            (upward ? seen.hi_y : seen.hi_x) = TypeParam::load(hi);
            (upward ? seen.lo_x : seen.lo_y) = all(7);
            (upward ? seen.hi_x : seen.hi_y) = all(7.25);
            seen.depth = TypeParam::load(depth);
            seen.alive = row.alive;
            this->kernel().insert(this->parts, 3, seen, row.alive, tile_side);
            auto const& b = this->buffer;
            EXPECT_EQ(b.counts.parts, row.nodes) << row.half << ' ' << row.one;
            if (row.nodes == 0) continue;
            // Every pixel lies in a node, and each node ends at one.
            T least = T(1e9), most = T(-1e9), deepest = T(-1e9);
            for (int k = 0; k < lane_count; ++k) {
                if ((row.alive >> k & 1u) == 0) continue;
                least = std::min(least, lo[k]), most = std::max(most, hi[k]), deepest = std::max(deepest, depth[k]);
                bool held = false;
                for (std::uint32_t n = 0; n < row.nodes; ++n) {
                    T const* const node = this->parts.bounds + 5 * n;
                    EXPECT_EQ(this->parts.place[3 * n] & 0x0fffffffu, 3u);
                    EXPECT_EQ(node[upward ? 0 : 2], T(7));
                    EXPECT_EQ(node[upward ? 1 : 3], T(7.25));
                    T const from = node[upward ? 2 : 0], to = node[upward ? 3 : 1];
                    EXPECT_LE(to - from, row.nodes > 1 ? T(2.0001) : T(4.0001));
                    held = held || (from <= lo[k] && hi[k] <= to && depth[k] <= node[4]);
                }
                EXPECT_TRUE(held) << k;
            }
            EXPECT_EQ(upward ? b.least_y : b.least_x, least);
            EXPECT_EQ(upward ? b.most_y : b.most_x, most);
            EXPECT_EQ(upward ? b.least_x : b.least_y, T(7));
            EXPECT_EQ(upward ? b.most_x : b.most_y, T(7.25));
            EXPECT_EQ(b.most_depth, deepest);
        }
    }
}

// Nothing smaller than a texel is worth a node more, however small its pixels are.
TYPED_TEST(TileIn, IsOneNodeWithinATexel) {
    using T = typename TypeParam::Scalar;
    for (double const extent : {0.9, 1.1}) {
        this->take(forms[0]);
        typename TestFixture::Kernel::Seen seen;
        T lo[lane_count];
        for (int k = 0; k < lane_count; ++k) lo[k] = T(k % 4 >= 2 ? extent : 0);
        seen.lo_x = seen.hi_x = TypeParam::load(lo);
        seen.lo_y = seen.hi_y = seen.depth = TypeParam::all(T(1));
        this->kernel().insert(this->parts, 3, seen, 0xffffu, tile_side);
        EXPECT_EQ(this->buffer.counts.parts, extent < 1.0 ? 1u : 4u);
    }
}
