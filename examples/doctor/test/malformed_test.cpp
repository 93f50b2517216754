// SPDX-License-Identifier: MIT
//
// What is no case is said in one line, with the line of the file and what was expected there.
#include "examples/doctor/case.hpp"
#include "examples/doctor/json_tree.hpp"
#include "examples/doctor/test/case_files.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>

using namespace shadowmath::doctor;

namespace {

std::string good() {
    return text_of(folder / "good.json");
}

std::string with(std::string const& from, std::string const& to) {
    std::string text = good();
    std::size_t const at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    return text.replace(at, from.size(), to);
}

std::string complaint(std::string const& text) {
    try {
        (void)case_from(text, "case.json", folder);
    } catch (CaseError const& error) {
        return error.what();
    }
    return "none";
}

// One line, printable, "case.json:LINE: ..." that says `what`.
void expect_complaint(std::string const& text, int line, std::string const& what) {
    std::string const said = complaint(text);
    EXPECT_EQ(said.rfind("case.json:" + std::to_string(line) + ": ", 0), 0u) << said;
    EXPECT_NE(said.find(what), std::string::npos) << said;
    EXPECT_TRUE(std::ranges::all_of(said, [](char c) { return c >= ' ' && c <= '~'; })) << said;
}

}  // namespace

TEST(DoctorMalformed, WhatIsNoJsonIsSaidWithItsLine) {
    expect_complaint("", 1, "unexpected end of input");
    expect_complaint("{\n  \"clip\": \"vulkan\",\n", 2, "unexpected end of input");
    expect_complaint("{\n\n  \"clip\": NaN\n}", 3, "invalid literal");
    expect_complaint("{\n\n  \"clip\": 1e999\n}", 3, "number overflow");
    expect_complaint("{\n\"clip\": \"vulkan\"\n\"matrices\": 3}", 3, "expected");
    expect_complaint("{} {}", 1, "expected end of input");
    expect_complaint(std::string("\0\x01\xff{", 4), 1, "no JSON");
    expect_complaint("{\n\"a\": \"\x80\x81\"}", 2, "no JSON");
    expect_complaint("{\"clip\": \"vulkan\",\n\"clip\": \"d3d\"}", 2, "for the second time");
}

TEST(DoctorMalformed, EveryTruncationOfAGoodFileIsOneLine) {
    std::string const text = good();
    std::size_t const end = text.find_last_of('}');
    for (std::size_t length = 0; length < end; length += 7)
        expect_complaint(
            text.substr(0, length),
            1 + int(std::count(
                    text.begin(),
                    text.begin() + std::ptrdiff_t(text.find_last_not_of(" \n", length == 0 ? 0 : length - 1)), '\n')),
            "");
}

TEST(DoctorMalformed, WhatIsNotThereIsNamed) {
    expect_complaint("{}", 1, "\"clip\" is missing in the file: one of \"opengl\"");
    expect_complaint("[]", 1, "the file: expected an object { }, found a list of 0");
    expect_complaint("3", 1, "expected an object { }, found 3");
    for (char const* const key : {"\"clip\"", "\"matrices\"", "\"picture\"", "\"light\"", "\"camera\"", "\"maps\""})
        EXPECT_NE(complaint(with(key, "\"x\"")).find(std::string(key) + " is missing"), std::string::npos) << key;
    EXPECT_NE(complaint(with("\"size\"", "\"x\"")).find("\"size\" is missing in maps[0]"), std::string::npos);
}

TEST(DoctorMalformed, WrongTypesAreSaidWithWhatWasExpected) {
    expect_complaint(with("\"vulkan\"", "\"volcano\""), 3,
                     "clip: expected one of \"opengl\" \"opengl_zero_to_one\" "
                     "\"vulkan\" \"d3d\" \"metal\" \"webgpu\", found \"volcano\"");
    expect_complaint(with("\"vulkan\"", "null"), 3, "found null");
    expect_complaint(with("\"vulkan\"", "\"a\\n\\u0000\\u001bb\""), 3, "found \"a???b\"");
    expect_complaint(with("[1920, 1080]", "[1920]"), 5, "picture: expected a list of 2 numbers, found a list of 1");
    expect_complaint(with("[1920, 1080]", "[1920, -1]"), 5, "width and height in pixels");
    expect_complaint(with("[1920, 1080]", "[1920, \"x\"]"), 5, "expected numbers");
    expect_complaint(with("\"size\": 1024", "\"size\": 10.5"), 11, "maps[0].size: expected a whole number");
    expect_complaint(with("\"size\": 1024", "\"size\": 0"), 11, "maps[0].size: expected a number from 4 to 131072");
    expect_complaint(with("\"near\": 0.100000001", "\"near\": true"), 9, "camera.near: expected a number");
    expect_complaint(with("\"near\": 0.100000001", "\"near\": 0.0"), 9, "camera.near: expected a number from");
    expect_complaint(with("\"near\": 0.100000001", "\"near\": 500"), 8, "camera: expected near < far");
    expect_complaint(with("\"fov_y_degrees\": 55", "\"fov_y_degrees\": 180"), 9, "camera.fov_y_degrees");
    expect_complaint(with("\"directional\"", "\"sun\""), 7, "light.kind: expected one of");
    expect_complaint(with("\"bias\": {", "\"bias\": 3, \"x\": {"), 6, "bias: expected an object { }, found 3");
    expect_complaint(with("\"obj\": \"yard.obj\"", "\"obj\": 7"), 56, "scene.obj: expected the name of an OBJ file");
}

TEST(DoctorMalformed, ZerosAndHugeNumbersAreRefused) {
    std::string const text = good();
    std::size_t const at = text.find("\"travel\": [") + 10;
    std::string const travel = text.substr(at, text.find(']', at) + 1 - at);
    expect_complaint(with(travel, "[0, 0, 0]"), 7, "light: expected a direction that is not zero");
    expect_complaint(with(travel, "[1e300, 0, 0]"), 7, "light.travel: expected numbers up to 1e+12");
    expect_complaint(with(travel, "[0, -1]"), 7, "light.travel: expected a list of 3 numbers, found a list of 2");
    expect_complaint(with("\"size\": 1024", "\"size\": 1e30"), 11, "maps[0].size");
    std::string deep(100000, '[');
    expect_complaint(deep, 1, "nested more than 32 brackets deep");
    expect_complaint("{\"a\": \"" + std::string(largest_file, 'x') + "\"}", 1, "larger than 16 MiB");
    std::string many = "[";
    for (int i = 0; i < 17; ++i) many += "{},";
    many.back() = ']';
    std::string swapped = with("\"maps\": [", "\"maps\": " + many + ", \"other\": [");
    expect_complaint(swapped, 10, "maps: expected a list of 1 to 16 maps");
}

TEST(DoctorMalformed, MatricesMayStandInFourRowsAndRangesMustRise) {
    std::string const text = good();
    std::size_t const at = text.find("\"clip_from_world\": [") + 19;
    std::string const matrix = text.substr(at, text.find(']', at) + 1 - at);
    EXPECT_EQ(complaint(with(matrix, "[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,1]]")), "none");
    expect_complaint(with(matrix, "[[1,0,0,0],[0,1,0,0],[0,0,1],[0,0,0,1]]"), 11, "expected a list of 4 numbers");
    expect_complaint(with(matrix, "[1,0,0,0]"), 11, "expected a list of 4 numbers, found 1");
    std::size_t const range = text.find("\"range\": [") + 9;
    std::string const ends = text.substr(range, text.find(']', range) + 1 - range);
    expect_complaint(with(ends, "[5, 3]"), 11, "maps[0].range: expected two eye depths, the nearer one first");
}

TEST(DoctorMalformed, UnknownKeysAreSaidWithWhatTheyMayMean) {
    Case const read = case_from(with("\"name\"", "\"nmae\""), "case.json", folder);
    ASSERT_EQ(read.unknown_keys.size(), 1u);
    EXPECT_EQ(read.unknown_keys[0], "case.json:11: unknown key \"nmae\" in maps[0]; did you mean \"name\"?");
    EXPECT_EQ(read.frame.maps[0].name, "maps[0]");
}

TEST(DoctorMalformed, CamerasMayBeGivenAsMatricesOfEitherHand) {
    Case const read = case_from(good(), "case.json", folder);
    auto const list = [](glm::dmat4 const& m) {
        std::ostringstream text;
        text.precision(17);
        for (int i = 0; i < 16; ++i) text << (i == 0 ? "[" : ", ") << m[i / 4][i % 4];
        return text.str() + "]";
    };
    auto const& pose = read.frame.camera.pose;
    for (double const hand : {-1.0, 1.0}) {
        glm::dmat4 view(1.0), projection(0.0);
        for (int axis = 0; axis < 3; ++axis) {
            view[axis][0] = pose.right[axis];
            view[axis][1] = pose.up[axis];
            view[axis][2] = pose.forward[axis] * hand;
        }
        view[3] = glm::dvec4(-glm::dmat3(view[0], view[1], view[2]) * pose.position, 1.0);
        projection[0][0] = 1.0 / read.frame.camera.right;
        projection[1][1] = 1.0 / read.frame.camera.top;
        projection[2][2] = hand;
        projection[2][3] = hand;
        projection[3][2] = -0.1;
        std::string const text = good();
        std::size_t const at = text.find("\"camera\": {") + 10;
        std::string const camera = text.substr(at, text.find('}', at) + 1 - at);
        Case const again =
            case_from(with(camera, "{\"view_from_world\": " + list(view) + ", \"clip_from_view\": " + list(projection) +
                                       ", \"near\": 0.1, \"far\": 80}"),
                      "case.json", folder);
        EXPECT_LT(glm::distance(again.frame.camera.pose.forward, pose.forward), 1e-9) << hand;
        EXPECT_LT(glm::distance(again.frame.camera.pose.position, pose.position), 1e-9) << hand;
        EXPECT_NEAR(again.frame.camera.right, read.frame.camera.right, 1e-12);
    }
    EXPECT_NE(complaint(with("\"position\"", "\"view_from_world\": [1,0,0,0, 0,2,0,0, 0,0,1,0, 0,0,0,1], "
                                             "\"clip_from_view\": [1,0,0,0, 0,1,0,0, 0,0,-1,-1, 0,0,-1,0], \"x\""))
                  .find("expected a rotation and a translation"),
              std::string::npos);
}

// From outside.
class DoctorProgram : public ::testing::Test {
protected:
    static void SetUpTestSuite() {
        place_ = std::filesystem::temp_directory_path() / ("doctor test " + std::to_string(::getpid()));
        std::filesystem::create_directory(place_);
    }
    static void TearDownTestSuite() { std::filesystem::remove_all(place_); }

    struct Ended {
        int status;
        std::string out, err;
    };
    static Ended doctor(std::string const& arguments) {
        std::string const line =
            "cd '" + place_.string() + "' && '" DOCTOR "' " + arguments + " > .out 2> .err < /dev/null";
        int const status = std::system(line.c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(place_ / ".out"), text_of(place_ / ".err")};
    }
    static void expect_refusal(std::string const& arguments, std::string const& says) {
        Ended const ended = doctor(arguments);
        EXPECT_EQ(ended.status, 2) << arguments;
        EXPECT_EQ(ended.out, "");
        EXPECT_EQ(std::ranges::count(ended.err, '\n'), 1) << ended.err;
        EXPECT_NE(ended.err.find(says), std::string::npos) << ended.err;
    }
    static inline std::filesystem::path place_;
};

TEST_F(DoctorProgram, EndsWithZeroForTheWellAndWithOneForTheIll) {
    Ended const well = doctor("'" + (folder / "good.json").string() + "' --picture well.png");
    EXPECT_EQ(well.status, 0) << well.err;
    EXPECT_NE(well.out.find("Nothing is wrong with these maps."), std::string::npos) << well.out;
    EXPECT_EQ(text_of(place_ / "well.png").substr(1, 3), "PNG");
    Ended const ill = doctor("'" + (folder / "unsnapped_sphere.json").string() + "'");
    EXPECT_EQ(ill.status, 1) << ill.err;
    EXPECT_NE(ill.out.find("1. shimmer"), std::string::npos) << ill.out;
}

TEST_F(DoctorProgram, SaysInOneLineWhatItCannotRead) {
    std::ofstream(place_ / "cut.json") << good().substr(0, 900);
    std::ofstream(place_ / "empty.json");
    std::ofstream(place_ / "nowhere.json") << with("yard.obj", "nothing.obj");
    std::ofstream(place_ / "bad.obj") << "v 0 0 x\n";
    std::ofstream(place_ / "bad_obj.json") << with("yard.obj", "bad.obj");
    expect_refusal("cut.json", "cut.json:17: no JSON");
    expect_refusal("empty.json", "empty.json:1: no JSON");
    expect_refusal("absent.json", "absent.json: cannot be read");
    expect_refusal(".", ".: cannot be read");
    expect_refusal("nowhere.json", "nothing.obj: cannot be read");
    expect_refusal("bad_obj.json", "bad.obj: line 1 does not hold three finite numbers");
    expect_refusal("", "case is required");
    expect_refusal("cut.json --width 3", "--width");
    expect_refusal("'" + (folder / "good.json").string() + "' --picture no/where.png --width 16", "no/where.png");
}
