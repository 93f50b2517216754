// SPDX-License-Identifier: MIT
//
// Sixteen triangles at once, beside one at a time in long double: clipped as a polygon, and each margin as it is said
// to be.
#include <shadowmath/irregular/casters.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

using namespace shadowmath;

namespace {

using Exact = long double;
using E4 = std::array<Exact, 4>;

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();
constexpr double endless = std::numeric_limits<double>::infinity();

template <class Lanes>
struct CastersIn : ::testing::Test {
    using Number = typename Lanes::Scalar;
    using WideNumber = Wider<Number>;
    using Batch = detail::CasterBatch<Lanes>;

    std::mt19937 bits{20021201};
    IrregularBuffer<Number> buffer;
    PixelFrame<WideNumber> frame;
    PixelLight<WideNumber> light;
    Casters<Number> casters;
    std::vector<Number> numbers;
    std::vector<std::uint32_t> indices;
    Number w_floor = Number(0.25);

    CastersIn() {
        ViewVolume<Number> const eye = perspective_view<Number>(
            pose_looking(Vec3<Number>(1, 2, 3), Vec3<Number>(Number(0.3), Number(-0.2), Number(-1)),
                         Vec3<Number>(0, 1, 0)),
            Number(1), Number(1.5), Number(0.1), Number(100));
        see(eye, directional(Vec3<Number>(Number(0.3), Number(-1), Number(0.2))));
        // A warped map: w is from -0.2 to 2.2 over the scene.
        buffer.row[0] = Vec4<Number>(Number(0.9), Number(0.2), Number(-0.1), Number(30));
        buffer.row[1] = Vec4<Number>(Number(-0.2), Number(0.8), Number(0.3), Number(25));
        buffer.row[2] = Vec4<Number>(Number(0.01), Number(0.02), Number(-0.015), Number(0.5));
        buffer.row[3] = Vec4<Number>(Number(0.02), Number(0.01), Number(0.03), Number(1));
        buffer.texel_error = Number(0.02);
        buffer.texel_error_here = Number(0.3);
        buffer.depth_error = Number(0.0015);
        buffer.depth_error_here = Number(0.04);
        buffer.contact_reach = Number(5);
        buffer.contact_ray = Number(3);
        open();
    }
    void see(ViewVolume<Number> const& eye, Light<Number> const& from) {
        buffer.frame = pixel_frame(eye, 48, 32);
        frame = frame_in<WideNumber>(buffer.frame);
        Light<WideNumber> wide;
        wide.kind = from.kind;
        wide.direction = Vec3<WideNumber>(from.direction);
        wide.position = Vec3<WideNumber>(from.position);
        light = pixel_light(frame, wide);
    }
    // Receivers everywhere.
    void open() {
        buffer.least_x = buffer.least_y = -std::numeric_limits<Number>::max();
        buffer.most_x = buffer.most_y = buffer.most_depth = std::numeric_limits<Number>::max();
    }
    double in(double lo, double hi) { return std::uniform_real_distribution<double>(lo, hi)(bits); }
    std::uint32_t below(std::uint32_t end) { return std::uniform_int_distribution<std::uint32_t>(0, end - 1)(bits); }

    void throw_vertices(std::uint32_t count, int stride, double spread) {
        numbers.assign(std::size_t(count) * std::size_t(stride) + 8, Number(-77));
        for (std::uint32_t v = 0; v < count; ++v)
            for (int axis = 0; axis < 3; ++axis)
                numbers[v * std::size_t(stride) + std::size_t(axis)] = Number(in(-spread, spread));
        casters = {};
        casters.position = numbers.data();
        casters.stride = stride;
        casters.vertex_count = count;
        casters.triangle_count = count / 3;
    }
    [[nodiscard]] Number* vertex(std::uint32_t v) { return numbers.data() + v * std::size_t(casters.stride); }
    [[nodiscard]] detail::CasterKernel<Lanes> kernel() const { return {buffer, casters, frame, light, w_floor}; }

    struct Found {
        bool sound = true;
        Exact bounds[4], depth, reach = 0;
    };
    // Of a triangle of the batch, without what its receivers say.
    Found slow(Batch const& batch, std::size_t k) const {
        Found found;
        std::vector<E4> corners;
        Exact least_w = endless;
        for (auto const& of : batch.vertex) {
            Exact away = 0;
            std::array<Exact, 3> p;
            for (std::size_t axis = 0; axis < 3; ++axis) {
                p[axis] = Exact(of[axis][k]) - Exact(buffer.frame.eye[int(axis)]);
                away += std::fabs(p[axis]);
            }
            found.sound = found.sound && away <= 1e9L;
            found.reach = std::fmax(found.reach, away);
            E4 at;
            for (std::size_t r = 0; r < 4; ++r) {
                auto const& row = buffer.row[r];
                at[r] = Exact(row.x) * p[0] + Exact(row.y) * p[1] + Exact(row.z) * p[2] + Exact(row.w);
            }
            corners.push_back(at);
            least_w = std::fmin(least_w, at[3]);
        }
        std::vector<E4> kept;
        Exact const floor = Exact(w_floor);
        for (std::size_t i = 0; i < 3; ++i) {
            E4 const &a = corners[i], &b = corners[(i + 1) % 3];
            if (a[3] >= floor) kept.push_back(a);
            if ((a[3] < floor) == (b[3] < floor)) continue;
            E4 cut;
            for (std::size_t r = 0; r < 4; ++r) cut[r] = a[r] + (b[r] - a[r]) * (floor - a[3]) / (b[3] - a[3]);
            kept.push_back(cut);
        }
        found.sound = found.sound && !kept.empty();
        Exact const steepest = 1 / std::fmax(least_w, floor);
        Exact const pad =
            steepest * (found.reach * Exact(buffer.texel_error) + Exact(buffer.texel_error_here)) + Exact(1) / 128;
        for (std::size_t axis = 0; axis < 2; ++axis) {
            Exact lo = endless, hi = -endless;
            for (E4 const& at : kept) lo = std::fmin(lo, at[axis] / at[3]), hi = std::fmax(hi, at[axis] / at[3]);
            found.bounds[2 * axis] = lo - pad;
            found.bounds[2 * axis + 1] = hi + pad;
        }
        Exact depth = endless;
        for (E4 const& at : kept) depth = std::fmin(depth, at[2] / at[3]);
        found.depth =
            least_w < floor
                ? Exact(std::numeric_limits<Number>::lowest())
                : depth - steepest * (found.reach * Exact(buffer.depth_error) + Exact(buffer.depth_error_here));
        return found;
    }
    static void expect_near(Number value, Exact wanted) {
        Exact const slack = 64 * Exact(std::numeric_limits<Number>::epsilon()) * (1 + std::fabs(wanted)) * 10;
        EXPECT_NEAR(double(Exact(value) - wanted), 0.0, double(slack)) << value << ", not " << double(wanted);
    }
};

using Kinds = ::testing::Types<PlainLanes<float>, PlainLanes<double>, BestLanes<float>>;
TYPED_TEST_SUITE(CastersIn, Kinds);

}  // namespace

TYPED_TEST(CastersIn, HaveTheBoundsOfTheirPartAboveTheLeastWAndWhatRoundingMayAdd) {
    int clipped = 0, behind = 0, whole = 0;
    for (int round = 0; round < 60; ++round) {
        this->throw_vertices(48, 3, round % 3 == 0 ? 4.0 : 40.0);
        // Within a metre of the eye.
        for (std::uint32_t i = 0; i < 144 && round % 3 == 1; ++i)
            this->numbers[i] = this->numbers[i] / 200 + this->buffer.frame.eye[int(i % 3)];
        typename TestFixture::Batch batch{};
        this->kernel().load(0, 16, nullptr, batch);
        TypeParam const reach = batch.reach;
        typename TypeParam::Scalar reaches[lane_count];
        reach.store(reaches);
        for (std::size_t k = 0; k < lane_count; ++k) {
            auto const wanted = this->slow(batch, k);
            EXPECT_EQ((batch.sound >> k & 1u) != 0, wanted.sound) << k;
            this->expect_near(reaches[k], wanted.reach);
            if (!wanted.sound) {
                ++behind;
                continue;
            }
            for (std::size_t i = 0; i < 4; ++i) this->expect_near(batch.bounds[i][k], wanted.bounds[i]);
            bool const is_whole = wanted.depth > -1e9L;
            ++(is_whole ? whole : clipped);
            if (is_whole)
                this->expect_near(batch.depth[k], wanted.depth);
            else
                EXPECT_LT(batch.depth[k], typename TypeParam::Scalar(-1e30));
        }
    }
    EXPECT_GT(clipped, 50);
    EXPECT_GT(behind, 3);
    EXPECT_GT(whole, 300);
}

TYPED_TEST(CastersIn, HaveAPartWhereOneCornerIsJustAtTheLeastW) {
    using T = typename TypeParam::Scalar;
    T const floor = this->w_floor;
    T const at[3][4] = {{T(1), T(2), T(0), floor}, {T(9), T(9), T(0), T(0.1)}, {T(-9), T(-9), T(0), T(-3)}};
    T bounds[4];
    EXPECT_TRUE(this->kernel().clip(at, bounds));
    EXPECT_EQ(bounds[0], T(4));
    EXPECT_EQ(bounds[1], T(4));
    EXPECT_EQ(bounds[2], T(8));
    EXPECT_EQ(bounds[3], T(8));
}

// The receivers' bounds end at those of the triangles, once just before and once just beyond.
TYPED_TEST(CastersIn, TakeNothingFromReceiversThatTheyDoNotReach) {
    using T = typename TypeParam::Scalar;
    this->throw_vertices(48, 3, 4.0);
    typename TestFixture::Batch all{}, batch{};
    this->kernel().load(0, 16, nullptr, all);
    ASSERT_EQ(all.sound, 0xffffu);
    for (std::size_t k = 0; k < lane_count; ++k)
        for (int side = 0; side < 5; ++side)
            for (double const beyond : {-0.01, 0.0, 0.01}) {
                T const by = T(beyond);
                this->open();
                if (side == 0) this->buffer.most_x = all.bounds[0][k] + by;
                if (side == 1) this->buffer.least_x = all.bounds[1][k] - by;
                if (side == 2) this->buffer.most_y = all.bounds[2][k] + by;
                if (side == 3) this->buffer.least_y = all.bounds[3][k] - by;
                if (side == 4) this->buffer.most_depth = all.depth[k] + by;
                this->kernel().load(0, 16, nullptr, batch);
                EXPECT_EQ((batch.sound >> k & 1u) != 0, beyond >= 0.0) << k << ' ' << side << ' ' << beyond;
                EXPECT_EQ(batch.bounds[0][k], all.bounds[0][k]);
            }
}

TYPED_TEST(CastersIn, CastNothingFarAwayOrWithoutNumbers) {
    using T = typename TypeParam::Scalar;
    this->throw_vertices(48, 3, 4.0);
    this->buffer.row[3] = Vec4<T>(0, 0, 0, 1);
    double const odd[] = {no_number, endless, -endless, 1.1e9, -1.1e9, 0.9e9, -0.9e9};
    for (std::uint32_t i = 0; i < 7; ++i) this->vertex(3 * i + i % 3)[i % 2] = T(odd[i]);
    typename TestFixture::Batch batch{};
    this->kernel().load(0, 16, nullptr, batch);
    EXPECT_EQ(batch.sound, 0xffffu & ~0x1fu);
}

TYPED_TEST(CastersIn, AreLoadedInAnyOrderFromAnyStrideAndByIndicesThatThereAre) {
    using T = typename TypeParam::Scalar;
    this->buffer.row[3] = Vec4<T>(0, 0, 0, 1);
    for (int round = 0; round < 40; ++round) {
        bool const indexed = round % 2 == 1, ordered = round % 4 >= 2;
        std::uint32_t const triangles = 40, count = round < 8 ? 16 : 1 + this->below(16);
        this->throw_vertices(3 * triangles, 3 + round % 3, 4.0);
        std::vector<std::uint32_t> order(triangles);
        for (std::uint32_t& of : order) of = this->below(triangles);
        if (indexed) {
            this->indices.clear();
            for (std::uint32_t i = 0; i < 3 * triangles; ++i)
                this->indices.push_back(this->below(3 * triangles + (round < 20 ? 0 : 12)));
            // The first that is none.
            for (int i = 0; i < 20 && round >= 20; ++i) this->indices[this->below(3 * triangles)] = 3 * triangles;
            this->casters.index = this->indices.data();
        } else if (round >= 20) {
            this->casters.vertex_count -= 1 + this->below(60);
        }
        std::uint32_t const begin = this->below(triangles - count + 1);
        typename TestFixture::Batch batch{};
        this->kernel().load(begin, count, ordered ? order.data() : nullptr, batch);
        for (std::uint32_t k = 0; k < lane_count; ++k) {
            bool sound = k < count;
            std::uint32_t const triangle = !sound ? 0 : ordered ? order[begin + k] : begin + k;
            std::uint32_t at[3];
            for (std::uint32_t i = 0; i < 3; ++i) {
                at[i] = indexed ? this->indices[3 * triangle + i] : 3 * triangle + i;
                sound = sound && at[i] < this->casters.vertex_count;
            }
            EXPECT_EQ((batch.sound >> k & 1u) != 0, sound) << round << ' ' << k;
            for (std::size_t i = 0; i < 3 && sound; ++i)
                for (std::size_t axis = 0; axis < 3; ++axis)
                    EXPECT_EQ(batch.vertex[i][axis][k], this->vertex(at[i])[axis]) << round << ' ' << k;
        }
    }
}

// What lies behind the last vertex is not touched: fewer than three are read as the first, three times.
TYPED_TEST(CastersIn, OfFewerVerticesThanATriangleHasNoneIsCastAndNoOtherIsRead) {
    this->throw_vertices(3, 3, 4.0);
    for (std::uint32_t const vertices : {1u, 2u}) {
        this->casters.vertex_count = vertices;
        typename TestFixture::Batch batch{};
        this->kernel().load(0, 16, nullptr, batch);
        EXPECT_EQ(batch.sound, 0u);
        for (auto const& of : batch.vertex)
            for (std::size_t axis = 0; axis < 3; ++axis) EXPECT_EQ(of[axis][7], this->vertex(0)[axis]);
    }
    this->casters.vertex_count = 3;
    typename TestFixture::Batch batch{};
    this->kernel().load(0, 16, nullptr, batch);
    EXPECT_EQ(batch.sound, 1u);
}

TYPED_TEST(CastersIn, RaiseTheVolumesOfEachTriangleWithItsMargin) {
    using T = typename TypeParam::Scalar;
    using Real = Wider<T>;
    auto const pose = pose_looking(Vec3<T>(1, 2, 3), Vec3<T>(T(0.3), T(-0.2), T(-1)), Vec3<T>(0, 1, 0));
    for (bool const flat : {false, true})
        for (bool const lamp : {false, true}) {
            ViewVolume<T> const eye = flat ? orthographic_view<T>(pose, -9, 7, -5, 6, T(0.1), 100)
                                           : perspective_view<T>(pose, T(1), T(1.5), T(0.1), T(100));
            this->see(eye, lamp ? spot(Vec3<T>(2, 9, 1), Vec3<T>(0, -1, 0), T(0.7), T(50))
                                : directional(Vec3<T>(T(0.3), T(-1), T(0.2))));
            this->throw_vertices(48, 3, 6.0);
            typename TestFixture::Batch batch{};
            this->kernel().load(0, 16, nullptr, batch);
            std::uint32_t const sound = batch.sound;
            this->kernel().raise_volumes(batch);
            EXPECT_EQ(batch.sound, sound);
            T reach[lane_count];
            batch.reach.store(reach);
            for (std::size_t k = 0; k < lane_count; ++k) {
                Vec3<Real> p[3];
                for (std::size_t i = 0; i < 3; ++i)
                    p[i] = point_in_pixels(
                        this->frame, Vec3<Real>(batch.vertex[i][0][k], batch.vertex[i][1][k], batch.vertex[i][2][k]));
                // A part in 2^20 of how far out it is, of the eye's own place, and of a metre.
                Real const share = Real(1) / Real(1 << 20);
                ContactMargin<Real> const margin{share * (Real(reach[k]) + 1 + Real(this->buffer.contact_reach)),
                                                 share * Real(this->buffer.contact_ray)};
                ShadowVolume<Real> const volume = shadow_volume(this->frame, this->light, p[0], p[1], p[2], margin);
                for (int i = 0; i < 4; ++i) {
                    PixelPlane<Real> const& plane = volume.planes[i];
                    Real const size = std::abs(plane.x) + std::abs(plane.y) + std::abs(plane.a) + std::abs(plane.b);
                    EXPECT_NEAR(batch.plane[0][i][k], plane.x, size * Real(1e-11));
                    EXPECT_NEAR(batch.plane[1][i][k], plane.y, size * Real(1e-11));
                    EXPECT_NEAR(batch.plane[2][i][k], plane.a, size * Real(1e-11));
                    EXPECT_NEAR(batch.plane[3][i][k], plane.b, size * Real(1e-11));
                }
            }
        }
}

TYPED_TEST(CastersIn, CastNothingWithoutAnAreaThatTheLightSees) {
    using T = typename TypeParam::Scalar;
    this->throw_vertices(48, 3, 4.0);
    std::copy(this->vertex(0), this->vertex(0) + 3, this->vertex(1));
    for (std::uint32_t v : {6u, 7u, 8u}) std::fill(this->vertex(v), this->vertex(v) + 3, T(1));
    typename TestFixture::Batch batch{};
    this->kernel().load(0, 16, nullptr, batch);
    EXPECT_EQ(batch.sound, 0xffffu);
    this->kernel().raise_volumes(batch);
    EXPECT_EQ(batch.sound, 0xfffau);
}
