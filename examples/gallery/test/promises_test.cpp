// SPDX-License-Identifier: MIT
//
// Each promise is seen to break.
#include "examples/gallery/promises.hpp"

#include "backends/null/null_backend.hpp"

#include <gtest/gtest.h>

#include <functional>

namespace shadowmath::gallery {
namespace {

// Two drivers and two ways, all of them right.
Results good() {
    Results results;
    Parity parity{"town", "vulkan"};
    parity.covered_texels = 1000;
    parity.largest_ulp = 2;
    parity.unlike_texels = 9;
    parity.unlike_pixels = 4;
    results.parity = {parity};
    for (char const* const way : {"one pass a map", "instances", "all maps, then the picture", "split by split"}) {
        WayRecord record;
        record.scene = "town";
        record.backend = "vulkan";
        record.way = way;
        record.with_picture = results.ways.size() >= 2;
        record.work.triangles = record.with_picture ? 900 : 700;
        record.work.driver = backend::DriverCount{};
        record.work.driver->clipper_triangles = record.work.triangles;
        results.ways.push_back(record);
    }
    FitRecord fit{"town", "vulkan"};
    fit.maps = 4;
    fit.pixels = 200000;
    fit.unlike_pixels = 2;
    results.fits = {fit};
    FlightRecord stable{"town", "street", "stable", "Stable"};
    stable.stable = true;
    stable.decisions = 200000;
    stable.flips = 20;
    FlightRecord tight{"town", "street", "tight", "Tight"};
    tight.decisions = tight.flips = 200000;
    results.flights = {stable, tight};
    return results;
}

TEST(Promises, HoldOfWhatIsRight) {
    EXPECT_EQ(broken_promises(good()), std::vector<std::string>{});
    EXPECT_EQ(broken_promises({}), std::vector<std::string>{});
}

TEST(Promises, OneThatIsBrokenIsOneSentenceThatSaysWhereAndHowMany) {
    struct Case {
        std::function<void(Results&)> spoil;
        char const* sentence;
    };
    Case const cases[] = {
        {[](Results& r) { r.parity[0].covered_in_one = 1; },
         "town, vulkan: 1 texels are covered in one driver's maps alone"},
        {[](Results& r) { r.parity[0].largest_ulp = 3; }, "town, vulkan: 3 ulp lie between two drivers' depths"},
        {[](Results& r) { r.parity[0].unlike_off_edges = 2; },
         "town, vulkan: 2 pixels off edges are unlike the first driver's"},
        {[](Results& r) { r.ways[1].unlike_texels = 5; },
         "town, vulkan, instances: 5 texels are unlike those of one pass a map"},
        {[](Results& r) { r.ways[1].work.triangles = 701; },
         "town, vulkan, instances: 1 triangles more or fewer than one pass a map"},
        {[](Results& r) { r.ways[1].work.driver->clipper_triangles = 690; },
         "town, vulkan, instances: 10 triangles more or fewer reached the clipper than objects cast into maps"},
        {[](Results& r) { r.ways[3].unlike_pixels = 1; },
         "town, vulkan, split by split: 1 pixels are unlike those of all maps at once"},
        {[](Results& r) { r.flights[0].flips = 21; }, "town, stable under way: 21 of 200000 decisions flip"},
        {[](Results& r) { r.fits[0].unlike_maps = 1; },
         "town, vulkan, fitted on the device: 1 maps are not those of the C++"},
        {[](Results& r) { r.fits[0].unlike_texels = 1; },
         "town, vulkan, fitted on the device: 1 texels are unlike those that the C++'s matrices give"},
        {[](Results& r) { r.fits[0].unlike_pixels = 3; },
         "town, vulkan, fitted on the device: 3 pixels are unlike those that the C++'s maps give"},
    };
    for (Case const& spoilt : cases) {
        Results results = good();
        spoilt.spoil(results);
        EXPECT_EQ(broken_promises(results), std::vector<std::string>{spoilt.sentence});
    }
}

TEST(Promises, AreJudgedOfMesasSoftwareDriversAlone) {
    std::vector<std::unique_ptr<backend::Backend>> backends;
    EXPECT_TRUE(share_a_rasteriser(backends));
    backends.push_back(std::make_unique<backend::NullBackend>());
    EXPECT_FALSE(share_a_rasteriser(backends));
}

// One map as the device made it and as the C++ did.
struct Fits {
    std::vector<backend::MapConstants> fitted{backend::max_maps};
    MapSet cpp;
    Drawn drawn{backend::Image<backend::Rgba8>({4, 2}), {backend::Image<float>({2, 2}, 0.5f)}};

    Fits() {
        cpp.maps.resize(1);
        cpp.frame.maps[0] = fitted[0];
    }
    [[nodiscard]] FitRecord record(Drawn const& from_cpp) const {
        FitRecord made;
        compare(made, fitted, drawn, cpp, from_cpp);
        return made;
    }
};

TEST(FitRecord, OfTheSameIsZero) {
    Fits const fits;
    FitRecord const record = fits.record(fits.drawn);
    EXPECT_EQ(record.pictures, 1);
    EXPECT_EQ(record.maps, 1);
    EXPECT_EQ(record.texels, 4);
    EXPECT_EQ(record.pixels, 8);
    EXPECT_EQ(record.unlike_maps + record.unlike_texels + record.unlike_pixels, 0);
}

TEST(FitRecord, CountsMapsTexelsAndPixelsThatDiffer) {
    Fits fits;
    fits.fitted[0].clip_from_world[3][0] = 1e-7f;
    Drawn other = fits.drawn;
    other.maps[0].at(1, 1) = 1.0f;
    other.picture.at(3, 1).g = 1;
    FitRecord record = fits.record(other);
    EXPECT_EQ(record.unlike_maps, 1);
    EXPECT_EQ(record.unlike_texels, 1);
    EXPECT_EQ(record.unlike_pixels, 1);
    fits.fitted[0] = fits.cpp.frame.maps[0];
    fits.fitted[0].depth_end = 2.0f;
    EXPECT_EQ(fits.record(other).unlike_maps, 1);
    fits.fitted.clear();
    EXPECT_THROW(static_cast<void>(fits.record(other)), std::invalid_argument);
}

}  // namespace
}  // namespace shadowmath::gallery
