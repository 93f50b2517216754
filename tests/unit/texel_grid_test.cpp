// SPDX-License-Identifier: MIT
#include "tests/laws/texel_grid.hpp"

#include <shadowmath/fit_sphere.hpp>

#include <gtest/gtest.h>

using namespace shadowmath;

namespace {

constexpr ClipSpace all_clips[] = {gl_clip, gl_zero_to_one_clip, vulkan_clip, d3d_clip, reversed(vulkan_clip)};

template <class T>
LightBasis<T> slanted() {
    return light_basis(directional(Vec3<T>(T(0.3), T(-1), T(0.45))).direction);
}

}  // namespace

template <class T>
class TexelGridOf : public ::testing::Test {};
using Scalars = ::testing::Types<float, double, long double>;
TYPED_TEST_SUITE(TexelGridOf, Scalars);

TYPED_TEST(TexelGridOf, AUnitSphereHasTheTexelOfTheBudget) {
    using T = TypeParam;
    // 2 R / (map_size - 2 margin - 1) = 2 / 100.
    TexelGrid<T> const grid = texel_grid(LightBasis<T>{}, Sphere<T>{Vec3<T>(T(0)), T(1)}, 105, T(2));
    EXPECT_TRUE(grid.visible);
    EXPECT_FALSE(grid.faults.any());
    // Rounded up by eight ulp, never down.
    EXPECT_GE(grid.texel_metres, T(0.02L));
    EXPECT_LE(grid.texel_metres, T(0.02L) * (T(1) + T(16) * std::numeric_limits<T>::epsilon()));
    // Light along -y: x is world x, y is world -z. 105 / 2 to either side, floored to whole texels.
    EXPECT_EQ(grid.x, -52);
    EXPECT_EQ(grid.y, -52);
}

TYPED_TEST(TexelGridOf, AnySizeOfMapHoldsSphereAndMargin) {
    using T = TypeParam;
    for (int const size : {3, 4, 5, 16, 17, 1000, 1023, 4096, 70000})
        for (T const margin : {T(0), T(0.5), T(1), T(6)})
            for (T const at : {T(0), T(0.4999), T(-123.456), T(17)}) {
                if (faults_of_margin(size, margin).any()) continue;
                Sphere<T> const sphere{Vec3<T>(at, at * T(0.7), -at * T(1.3)), T(2.5)};
                TexelGrid<T> const grid = texel_grid(slanted<T>(), sphere, size, margin);
                EXPECT_TRUE(laws::holds_sphere_and_margin(grid, sphere, margin)) << size << " " << double(margin);
            }
}

TYPED_TEST(TexelGridOf, TheWindowFillsTheMapInEveryConvention) {
    using T = TypeParam;
    TexelGrid<T> const grid = texel_grid(slanted<T>(), Sphere<T>{Vec3<T>(T(3), T(4), T(5)), T(10)}, 256, T(2));
    LightBox<T> const box = on_grid(grid, T(-7), T(9));
    for (ClipSpace const clip : all_clips)
        for (int corner = 0; corner < 8; ++corner) {
            T const x = corner & 1 ? box.hi.x : box.lo.x, y = corner & 2 ? box.hi.y : box.lo.y;
            T const depth = corner & 4 ? T(9) : T(-7);
            Vec3<T> const world = box.basis.x * x + box.basis.y * y + box.basis.depth * depth;
            auto const at = canonical_from_clip<long double>(clip) *
                            laws::image_of(clip_from_world(grid, T(-7), T(9), clip), Vec4<T>(world, T(1)));
            // Metres up to 20 against half sides of 10 and a depth of 16; the slanted axes are unit to 4 ulp.
            double const rounding = 32 * double(std::numeric_limits<T>::epsilon());
            EXPECT_NEAR(double(at.x), corner & 1 ? 1 : -1, rounding);
            EXPECT_NEAR(double(at.y), corner & 2 ? 1 : -1, rounding);
            EXPECT_NEAR(double(at.z), corner & 4 ? 1 : 0, rounding);
            EXPECT_EQ(double(at.w), 1.0);
        }
}

TYPED_TEST(TexelGridOf, TheMatrixIsAMapOfTheLight) {
    using T = TypeParam;
    Light<T> const light = directional(Vec3<T>(T(0.3), T(-1), T(0.45)));
    TexelGrid<T> const grid = texel_grid(slanted<T>(), Sphere<T>{Vec3<T>(T(3), T(4), T(5)), T(10)}, 256, T(2));
    for (ClipSpace const clip : all_clips)
        EXPECT_TRUE(laws::is_map_of(clip_from_world(grid, T(-100), T(9), clip), light, clip));
}

// A sixth of a turn and a few metres a frame, centimetre texels, as far as a planet is wide.
TEST(TexelGrid, StandsStillTenThousandKilometresFromTheOriginInDouble) {
    for (double const distance : {0.0, 1e6, 1e7}) {
        Vec3<double> const point(distance + 1.234, 5.678, -distance - 9.012);
        TexelGrid<double> first;
        for (int frame = 0; frame < 200; ++frame) {
            Vec3<double> const eye = point + Vec3<double>(std::sin(frame), 0.1 * std::cos(3 * frame), 0.37 * frame);
            Vec3<double> const forward(std::cos(frame / 6.0), -0.2, std::sin(frame / 6.0));
            auto const view = perspective_view(pose_looking(eye, forward, Vec3<double>(0, 1, 0)), 1.0, 1.6, 0.5, 12.0);
            TexelGrid<double> const grid = texel_grid(slanted<double>(), bounding_sphere(view), 2048, 2.0);
            ASSERT_TRUE(grid.visible);
            EXPECT_FALSE(grid.faults.any());
            if (frame == 0) first = grid;
            EXPECT_TRUE(laws::keeps_its_place_in_the_texel(first, grid, vulkan_clip, point))
                << distance << " " << frame;
        }
    }
}

TEST(TexelGrid, StandsStillInFloatWithinItsStatedReach) {
    Vec3<float> const point(200.25f, 3.5f, -150.125f);
    TexelGrid<float> first;
    int told = 0;
    for (int frame = 0; frame < 200; ++frame) {
        Vec3<float> const eye = point + Vec3<float>(std::sin(float(frame)), 0.1f, 0.07f * float(frame));
        auto const view = perspective_view(
            pose_looking(eye, Vec3<float>(std::cos(float(frame)), -0.2f, 1.0f), {0, 1, 0}), 1.0f, 1.6f, 0.5f, 12.0f);
        TexelGrid<float> const grid = texel_grid(slanted<float>(), bounding_sphere(view), 2048, 2.0f);
        if (frame == 0) first = grid;
        told += grid.faults.has(Fault::precision_lost);
        EXPECT_TRUE(laws::keeps_its_place_in_the_texel(first, grid, gl_clip, point)) << frame;
    }
    EXPECT_EQ(told, 0);
}

TEST(TexelGrid, SaysWhereFloatCannotStandStill) {
    // 1 cm texels: 2^15 of them are 328 m.
    auto const faults_at = [](float metres) {
        return texel_grid(LightBasis<float>{}, Sphere<float>{Vec3<float>(metres, 0, 0), 5.0f}, 1001, 0.0f).faults;
    };
    EXPECT_FALSE(faults_at(300).any());
    EXPECT_TRUE(faults_at(400).has(Fault::precision_lost));
}

TYPED_TEST(TexelGridOf, BadInputIsNamedAndHarmless) {
    using T = TypeParam;
    T const nan = std::numeric_limits<T>::quiet_NaN(), huge = std::numeric_limits<T>::max();
    Sphere<T> const good{Vec3<T>(T(1)), T(5)};
    auto const grid = [](Sphere<T> const& sphere, int size, T margin) {
        TexelGrid<T> const made = texel_grid(LightBasis<T>{}, sphere, size, margin);
        EXPECT_TRUE(laws::is_harmless(made, T(0), T(1), gl_clip));
        return made;
    };
    EXPECT_TRUE(grid(good, 3, T(0)).visible);
    for (int const size : {-7, 0, 1, 2}) {
        EXPECT_TRUE(grid(good, size, T(0)).faults.has(Fault::map_too_small)) << size;
        EXPECT_FALSE(grid(good, size, T(0)).visible) << size;
    }
    EXPECT_TRUE(grid(good, 1024, T(1e9)).faults.has(Fault::map_too_small));
    EXPECT_TRUE(grid(good, 1024, T(-1)).faults.has(Fault::clamped_option));
    EXPECT_TRUE(grid(good, 1024, T(-1)).visible);
    EXPECT_TRUE(grid(good, 1024, nan).faults.has(Fault::not_finite));
    EXPECT_TRUE(grid({Vec3<T>(nan, T(0), T(0)), T(5)}, 1024, T(0)).faults.has(Fault::not_finite));
    EXPECT_TRUE(grid({Vec3<T>(T(1)), nan}, 1024, T(0)).faults.has(Fault::not_finite));
    EXPECT_FALSE(grid({Vec3<T>(T(1)), T(0)}, 1024, T(0)).visible);
    EXPECT_FALSE(grid({Vec3<T>(T(1)), T(0)}, 1024, T(0)).faults.any());
    EXPECT_TRUE(grid({Vec3<T>(huge), T(1)}, 1024, T(0)).faults.has(Fault::precision_lost));
    EXPECT_FALSE(grid({Vec3<T>(huge), T(1)}, 1024, T(0)).visible);
    TexelGrid<T> const usable = grid(good, 1024, T(0));
    EXPECT_TRUE(laws::is_harmless(usable, nan, T(1), gl_clip));
    EXPECT_EQ(clip_from_world(usable, T(1), T(1), gl_clip), nowhere<T>());
    EXPECT_EQ(clip_from_world(usable, T(2), T(1), gl_clip), nowhere<T>());
    EXPECT_EQ(clip_from_world(usable, T(2), nan, gl_clip), nowhere<T>());
}

TEST(HeldSize, IsEnoughAndNoMoreThanAQuarterTooMuch) {
    for (double needed = 0.01; needed < 100.0; needed *= 1.013)
        for (double const before : {0.0, 0.02, 1.0, 7.0, 50.0}) {
            double const held = held_size(needed, before);
            EXPECT_GE(held, needed);
            EXPECT_LE(held, needed * 1.25);
            EXPECT_EQ(held_size(needed, held), held);
        }
}

TEST(HeldSize, IsEnoughJustAboveAnEighthOfAnOctave) {
    for (int k = -80; k <= 80; ++k) {
        float needed = std::exp2(float(k) / 8);
        for (int ulp = 0; ulp < 4; ++ulp, needed = std::nextafter(needed, 1e9f)) {
            EXPECT_GE(held_size(needed, needed / 2), needed);
            EXPECT_LE(held_size(needed, needed / 2), needed * 1.25f);
        }
    }
}

TEST(HeldSize, ChangesInEighthsOfAnOctaveWhileASlowZoomGoesOn) {
    // In and out by a factor of four, a thousandth a frame: two octaves of eighths each way, and no more.
    double size = 1.0;
    int changes = 0;
    for (int i = 0; i < 4 * 1386; ++i) {
        double const needed = std::exp2(2.0 * std::abs(std::sin(3.14159265 * i / 2772)));
        double const held = held_size(needed, size);
        changes += held != size;
        size = held;
    }
    EXPECT_LE(changes, 4 * (2 * 8 + 1));
    EXPECT_GT(changes, 16);
}

TEST(HeldSize, IsWhatIsNeededWhereThereIsNothingToHold) {
    EXPECT_EQ(held_size(0.3, 0.0), 0.3);
    EXPECT_EQ(held_size(0.0, 1.0), 0.0);
    EXPECT_EQ(held_size(1e38f, 1.0f), held_size(1e38f, 1.0f));
    EXPECT_GE(held_size(3.3e38f, 1.0f), 3.3e38f);
    double const nan_ = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(held_size(0.3, nan_), 0.3);
}

TEST(HeldSize, IsWhatIsNeededAtTheEndsOfTheType) {
    float const most = std::numeric_limits<float>::max(), nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(held_size(most, 1.0f), most) << "there is no eighth of an octave above";
    EXPECT_EQ(held_size(2.0f, nan), 2.0f);
    EXPECT_TRUE(std::isnan(held_size(nan, 2.0f)));
}

TEST(GridWindow, StandsOnWholePages) {
    LightBasis<double> const axes = light_basis(glm::dvec3(0, -1, 0));
    for (double x = -300; x < 300; x += 1.7) {
        auto const grid = grid_window(axes, glm::dvec3(x, 0, 2 * x), 0.25, 512, 128);
        EXPECT_TRUE(grid.visible);
        EXPECT_EQ(grid.x % 128, 0);
        EXPECT_EQ(grid.y % 128, 0);
        EXPECT_LE(std::abs(double(grid.x) + 256 - x * 4), 64.0);
    }
    EXPECT_FALSE(grid_window(axes, glm::dvec3(0), 0.0, 512).visible);
    EXPECT_FALSE(grid_window(axes, glm::dvec3(0), 1.0, 512, 0).visible);
    EXPECT_FALSE(grid_window(axes, glm::dvec3(1e300), 1.0, 512).visible);
}

TEST(GridWindow, NamesEachThingThatIsWrong) {
    using V3 = glm::dvec3;
    double const nan = std::numeric_limits<double>::quiet_NaN();
    LightBasis<double> const axes = light_basis(V3(0, -1, 0));
    auto const faults = [&](V3 const& center, double texel, int size, int step) {
        auto const grid = grid_window(axes, center, texel, size, step);
        EXPECT_EQ(grid.visible, !grid.faults.any());
        return grid.faults;
    };
    EXPECT_EQ(faults(V3(1), 0.25, 1, 1), Faults()) << "a window of one texel";
    EXPECT_EQ(faults(V3(nan), 0.25, 64, 1), Faults(Fault::not_finite));
    EXPECT_EQ(faults(V3(1), nan, 64, 1), Faults(Fault::not_finite));
    EXPECT_EQ(faults(V3(1), 0.25, 0, 1), Faults(Fault::map_too_small));
    EXPECT_EQ(faults(V3(1), 0.25, 64, 0), Faults(Fault::map_too_small));
    LightBasis<double> flat = axes;
    flat.depth = V3(0);
    EXPECT_EQ(grid_window(flat, V3(1), 0.25, 64).faults, Faults(Fault::bad_pose));
    EXPECT_FALSE(grid_window(flat, V3(1), 0.25, 64).visible);
}

TEST(HeldSize, IsTheNextEighthOfAnOctaveBelowOneAndAtAnEighthToo) {
    EXPECT_DOUBLE_EQ(held_size(0.3, 0.05), std::exp2(std::ceil(std::log2(0.3) * 8) / 8));
    EXPECT_EQ(held_size(2.0, 1.0), 2.0);
}

TEST(TexelGrid, IsNowhereBetweenDepthsThatAreNoneOrTooFarOut) {
    auto const grid = grid_window(light_basis(glm::dvec3(0, -1, 0)), glm::dvec3(1), 0.25, 64);
    double const nan = std::numeric_limits<double>::quiet_NaN(), endless = std::numeric_limits<double>::infinity();
    EXPECT_NE(clip_from_world(grid, -1.0, 9.0, gl_clip), nowhere<double>());
    for (double const bad : {nan, endless, 1e30}) {
        EXPECT_EQ(clip_from_world(grid, -1.0, bad, gl_clip), nowhere<double>()) << bad;
        EXPECT_EQ(clip_from_world(grid, -bad, 9.0, gl_clip), nowhere<double>()) << bad;
    }
}
