// SPDX-License-Identifier: MIT
//
// What counts as unlike, on images of a few pixels.
#include "examples/gallery/parity.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace shadowmath::gallery {
namespace {

// A picture whose left half is dark and whose right half is bright, and one map, of which two texels hold casters.
Drawn drawn() {
    Drawn d{backend::Image<backend::Rgba8>({8, 3}, {10, 10, 10}), {backend::Image<float>({4, 1}, 1.0f)}};
    for (int y = 0; y < 3; ++y)
        for (int x = 4; x < 8; ++x) d.picture.at(x, y) = {200, 200, 200};
    d.maps[0].at(0, 0) = 0.25f;
    d.maps[0].at(1, 0) = 0.5f;
    return d;
}

Parity compared(Drawn const& other) {
    Parity parity;
    compare(parity, drawn(), other);
    return parity;
}

TEST(Parity, OfTheSameIsZero) {
    Parity const parity = compared(drawn());
    EXPECT_EQ(parity.pictures, 1);
    EXPECT_EQ(parity.maps, 1);
    EXPECT_EQ(parity.pixels, 24);
    EXPECT_EQ(parity.covered_texels, 2);
    EXPECT_EQ(parity.covered_in_one + parity.unlike_texels + parity.largest_ulp, 0);
    EXPECT_EQ(parity.unlike_pixels + parity.unlike_off_edges, 0);
}

TEST(Parity, CountsTheStepsOfAFloatBetweenDepths) {
    Drawn other = drawn();
    other.maps[0].at(0, 0) = std::nextafter(std::nextafter(0.25f, 1.0f), 1.0f);
    other.maps[0].at(1, 0) = std::nextafter(0.5f, 0.0f);
    Parity const parity = compared(other);
    EXPECT_EQ(parity.unlike_texels, 2);
    EXPECT_EQ(parity.largest_ulp, 2);
    EXPECT_EQ(parity.covered_in_one, 0);
}

TEST(Parity, BothZerosAreOneDepth) {
    Drawn first = drawn(), other = drawn();
    first.maps[0].at(0, 0) = 0.0f;
    other.maps[0].at(0, 0) = -0.0f;
    Parity parity;
    compare(parity, first, other);
    EXPECT_EQ(parity.unlike_texels, 0);
}

TEST(Parity, ATexelThatOneCoversAloneHasNoDepthToCompare) {
    Drawn other = drawn();
    other.maps[0].at(0, 0) = 1.0f;
    other.maps[0].at(3, 0) = 0.75f;
    Parity const parity = compared(other);
    EXPECT_EQ(parity.covered_in_one, 2);
    EXPECT_EQ(parity.unlike_texels, 0);
    EXPECT_EQ(parity.largest_ulp, 0);
}

TEST(Parity, TellsPixelsAtEdgesFromOthers) {
    Drawn other = drawn();
    for (int const x : {0, 3, 4, 6}) other.picture.at(x, 1).g = 11;  // the border lies between 3 and 4
    Parity const parity = compared(other);
    EXPECT_EQ(parity.unlike_pixels, 4);
    EXPECT_EQ(parity.unlike_off_edges, 2);
}

TEST(Parity, AddsUpOverPictures) {
    Drawn other = drawn();
    other.picture.at(0, 0).r = 0;
    other.maps[0].at(0, 0) = std::nextafter(0.25f, 1.0f);
    Parity parity;
    compare(parity, drawn(), other);
    compare(parity, drawn(), drawn());
    EXPECT_EQ(parity.pictures, 2);
    EXPECT_EQ(parity.pixels, 48);
    EXPECT_EQ(parity.unlike_pixels, 1);
    EXPECT_EQ(parity.largest_ulp, 1);
}

TEST(Parity, RefusesImagesOfOtherSizes) {
    Parity parity;
    Drawn fewer = drawn(), smaller = drawn();
    fewer.maps.clear();
    smaller.maps[0] = backend::Image<float>({2, 2});
    EXPECT_THROW(compare(parity, drawn(), fewer), std::invalid_argument);
    EXPECT_THROW(compare(parity, drawn(), smaller), std::invalid_argument);
}

}  // namespace
}  // namespace shadowmath::gallery
