// SPDX-License-Identifier: MIT
#include "examples/gallery/staging.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <stdexcept>

namespace shadowmath::gallery {
namespace {

namespace fs = std::filesystem;

class StagingTest : public ::testing::Test {
protected:
    StagingTest() : place_(fs::temp_directory_path() / ("staging test " + std::to_string(::getpid()))) {
        fs::create_directory(place_);
    }
    ~StagingTest() override { fs::remove_all(place_); }

    static void write(fs::path const& file, std::string const& text) { std::ofstream(file) << text; }
    static std::string read(fs::path const& file) {
        std::string text;
        std::getline(std::ifstream(file), text);
        return text;
    }
    // What stands in the folder, hidden things included.
    [[nodiscard]] long count() const { return std::distance(fs::directory_iterator(place_), fs::directory_iterator()); }

    fs::path place_;
};

void fill(Staging const& staging, std::string const& text) {
    for (char const* name : {"index.html", "results.json"}) std::ofstream(staging.folder() / name) << text;
}

TEST_F(StagingTest, ShowsNothingUntilItIsPublished) {
    {
        Staging const staging(place_ / "gallery");
        fill(staging, "new");
        EXPECT_FALSE(fs::exists(place_ / "gallery"));
    }
    EXPECT_EQ(count(), 0);
}

TEST_F(StagingTest, PublishesEverythingAtOnce) {
    Staging staging(place_ / "deep" / "gallery");
    fill(staging, "new");
    staging.publish();
    EXPECT_EQ(read(place_ / "deep" / "gallery" / "index.html"), "new");
}

TEST_F(StagingTest, ReplacesAnOlderGalleryOnlyWhenPublished) {
    for (char const* text : {"old", "new"}) {
        Staging staging(place_ / "gallery/");
        fill(staging, text);
        if (std::string(text) == "new") {
            EXPECT_EQ(read(place_ / "gallery" / "index.html"), "old");
        }
        staging.publish();
    }
    EXPECT_EQ(read(place_ / "gallery" / "index.html"), "new");
    EXPECT_EQ(count(), 1);
}

TEST_F(StagingTest, NeverReplacesWhatIsNoGallery) {
    fs::create_directory(place_ / "letters");
    write(place_ / "letters" / "dear.txt", "dear");
    write(place_ / "file", "text");
    EXPECT_THROW(Staging(place_ / "letters"), std::runtime_error);
    EXPECT_THROW(Staging(place_ / "file"), std::runtime_error);
    EXPECT_THROW(Staging(place_ / "file" / "below"), std::runtime_error);
    EXPECT_EQ(count(), 2);
    EXPECT_EQ(read(place_ / "letters" / "dear.txt"), "dear");
}

}  // namespace
}  // namespace shadowmath::gallery
