// SPDX-License-Identifier: MIT
//
// Each sample case has the diagnosis that it was made for and no other; what is well has none. The committed files are
// what the recipes make.
#include "examples/doctor/diagnosis.hpp"
#include "examples/doctor/json_tree.hpp"
#include "examples/doctor/picture.hpp"
#include "examples/doctor/report.hpp"
#include "examples/doctor/sample_cases.hpp"
#include "examples/doctor/test/case_files.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

using namespace shadowmath;
using namespace shadowmath::doctor;

namespace {

struct Examined {
    Case read;
    Sight sight;
    Diagnosis diagnosis;
};

Examined examined(Case const& read, int width = 240) {
    Sight const sight = look(read, scene_of(read), width);
    return {read, sight, diagnose(read, sight)};
}

std::set<std::string> faults(Diagnosis const& diagnosis) {
    std::set<std::string> ids;
    for (Finding const& finding : diagnosis.findings)
        if (finding.fault) ids.insert(id(finding.ill));
    return ids;
}

std::set<int> maps_with(Diagnosis const& diagnosis, Ill ill) {
    std::set<int> maps;
    for (Finding const& finding : diagnosis.findings)
        if (finding.ill == ill) maps.insert(finding.map);
    return maps;
}

using Ids = std::set<std::string>;

// A case with something else in it.
Case changed(std::string const& file, std::string const& from, std::string const& to) {
    std::string text = text_of(folder / file);
    std::size_t const at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    if (at != std::string::npos) text.replace(at, from.size(), to);
    return case_from(text, file, folder);
}

// All numbers of a tree, in order.
void numbers_of(Node const& node, std::vector<double>& numbers) {
    if (node.kind == Json::number) numbers.push_back(node.number);
    for (Node const& item : node.items) numbers_of(item, numbers);
}

}  // namespace

TEST(DoctorCases, EachHasTheFaultThatItWasMadeForAndNoOther) {
    std::map<std::string, Ids> const expected{{"good.json", {}},
                                              {"library.json", {}},
                                              {"spot.json", {}},
                                              {"tutorial.json", {"casters-cut", "shimmer"}},
                                              {"unsnapped_sphere.json", {"shimmer"}},
                                              {"wrong_clip.json", {"wrong-clip"}},
                                              {"other_light.json", {"other-light"}},
                                              {"cut_casters.json", {"casters-cut"}},
                                              {"gap.json", {"ranges"}},
                                              {"constant_bias.json", {"bias-small"}}};
    for (auto const& [file, ids] : expected) {
        Examined const patient = examined(read_case(folder / file));
        EXPECT_EQ(faults(patient.diagnosis), ids) << file << '\n'
                                                  << report(patient.read, patient.sight, patient.diagnosis, {});
        EXPECT_TRUE(patient.read.unknown_keys.empty()) << file;
    }
    for (auto const& [file, text] : sample_cases())
        EXPECT_TRUE(file == "yard.obj" || expected.count(file) == 1) << file << " is not tried";
}

TEST(DoctorCases, AreWhatTheRecipesMake) {
    for (auto const& [file, text] : sample_cases()) {
        if (file == "yard.obj") {
            EXPECT_EQ(text_of(folder / file), text);
            continue;
        }
        std::vector<double> committed, made;
        numbers_of(parse_json(text_of(folder / file), file), committed);
        numbers_of(parse_json(text, file), made);
        ASSERT_EQ(committed.size(), made.size()) << file << ": run doctor_cases examples/doctor/cases";
        for (std::size_t i = 0; i < made.size(); ++i)
            EXPECT_NEAR(committed[i], made[i], 1e-4 * std::max(1.0, std::abs(made[i]))) << file << ", number " << i;
    }
    for (auto const& entry : std::filesystem::directory_iterator(folder))
        EXPECT_EQ(sample_cases().count(entry.path().filename().string()), 1u) << entry.path() << ": no recipe makes it";
}

TEST(DoctorCases, ThePageExplainsEveryWordThatTheDoctorUses) {
    std::string const page = text_of(DOCTOR_PAGE);
    for (int i = 0; i <= static_cast<int>(Ill::bias_large); ++i)
        EXPECT_NE(page.find("| `" + std::string(id(static_cast<Ill>(i))) + "`"), std::string::npos)
            << id(static_cast<Ill>(i));
    for (auto const& [file, text] : sample_cases())
        EXPECT_TRUE(file == "yard.obj" || page.find("| `" + file + "`") != std::string::npos) << file;
}

TEST(DoctorCases, SunThatMovedIsFoundByItsAngle) {
    Examined const patient = examined(read_case(folder / "other_light.json"));
    EXPECT_EQ(maps_with(patient.diagnosis, Ill::other_light), (std::set<int>{0, 1, 2, 3}));
    ASSERT_FALSE(patient.diagnosis.findings.empty());
    EXPECT_NE(patient.diagnosis.findings.front().what.find("10.5 degrees apart"), std::string::npos)
        << patient.diagnosis.findings.front().what;
}

TEST(DoctorCases, CutCastersAreMendedByDepthClampOrAsFarAsTheDoctorSays) {
    EXPECT_EQ(
        faults(examined(changed("cut_casters.json", "\"picture\"", "\"depth_clamp\": true, \"picture\"")).diagnosis),
        Ids{});
}

TEST(DoctorCases, AMatrixThatWentTheOtherWayRoundIsRecognised) {
    EXPECT_EQ(faults(examined(changed("good.json", "column_major", "row_major")).diagnosis), Ids{"transposed"});
}

TEST(DoctorCases, AWayToTheLightInsteadOfTheWayItGoesIsRecognised) {
    std::string const text = text_of(folder / "other_light.json");
    Case read = case_from(text_of(folder / "good.json"), "good.json", folder);
    read.frame.light.direction = -read.frame.light.direction;
    read.next.reset();
    EXPECT_EQ(faults(examined(read).diagnosis), Ids{"backwards"});
}

TEST(DoctorCases, ReversedDepthThatIsNotStatedIsRecognised) {
    Case read = read_case(folder / "good.json");
    for (EngineMap& map : read.frame.maps)
        map.clip_from_world = clip_from_canonical<double>(reversed(vulkan_clip)) *
                              canonical_from_clip<double>(vulkan_clip) * map.clip_from_world;
    read.next.reset();
    EXPECT_EQ(faults(examined(read).diagnosis), Ids{"backwards"});
    read.clip = reversed(read.clip);
    EXPECT_EQ(faults(examined(read).diagnosis), Ids{});
}

TEST(DoctorCases, OneBufferForAllMapsIsRecognised) {
    Case read = read_case(folder / "good.json");
    for (EngineMap& map : read.frame.maps) map.clip_from_world = read.frame.maps[0].clip_from_world;
    read.next.reset();
    Examined const patient = examined(read);
    EXPECT_EQ(maps_with(patient.diagnosis, Ill::same_matrix), (std::set<int>{1, 2, 3}));
    EXPECT_EQ(maps_with(patient.diagnosis, Ill::uncovered), (std::set<int>{1, 2, 3}));
}

TEST(DoctorCases, MapsFittedToTheWholeViewWasteTheirTexels) {
    Case read = read_case(folder / "good.json");
    read.frame.maps[0].clip_from_world = read.frame.maps[3].clip_from_world;
    read.next.reset();
    Examined const patient = examined(read);
    EXPECT_EQ(maps_with(patient.diagnosis, Ill::texels_wasted), std::set<int>{0});
}

TEST(DoctorCases, DepthOfSixteenBitsOverAKilometreIsCoarse) {
    Case read = read_case(folder / "good.json");
    read.depth_format = DepthFormat::unorm16;
    EXPECT_EQ(faults(examined(read).diagnosis), Ids{});
    for (EngineMap& map : read.frame.maps) {
        glm::dmat4 far_plane(1.0);
        far_plane[2][2] = 0.03;
        map.clip_from_world = far_plane * map.clip_from_world;
    }
    read.next.reset();
    EXPECT_EQ(faults(examined(read).diagnosis), Ids{"depth-coarse"});
}

TEST(DoctorCases, SlabsOfBiasLoseShadows) {
    Case read = read_case(folder / "good.json");
    read.bias.depth = 0.02;
    Diagnosis const diagnosis = examined(read).diagnosis;
    EXPECT_EQ(faults(diagnosis), Ids{"bias-large"});
}

TEST(DoctorCases, NormalOffsetOfTheTextbookIsEnough) {
    Case read = read_case(folder / "good.json");
    read.bias = {true, 1e-6, 0.0, 1.41422 * 1.5};
    EXPECT_EQ(faults(examined(read).diagnosis), Ids{});
    read.bias.normal_texels *= 0.7;
    EXPECT_EQ(faults(examined(read).diagnosis), Ids{"bias-small"});
}

TEST(DoctorCases, FarFromTheOriginFloatMatricesAreNotTrusted) {
    Case read = read_case(folder / "good.json");
    glm::dvec3 const far_away(4e5, 0.0, 0.0);
    glm::dmat4 here(1.0);
    here[3] = glm::dvec4(-far_away, 1.0);
    read.frame.camera.pose.position += far_away;
    read.obj.clear();
    read.next.reset();
    for (EngineMap& map : read.frame.maps) map.clip_from_world = map.clip_from_world * here;
    EXPECT_EQ(faults(examined(read).diagnosis), Ids{"precision"});
}

TEST(DoctorCases, WithoutASceneHolesAreRemarksOnly) {
    Case read = read_case(folder / "gap.json");
    read.obj.clear();
    EXPECT_EQ(faults(examined(read).diagnosis), Ids{"ranges"});
    for (std::size_t i = 0; i + 1 < read.frame.maps.size(); ++i)
        read.frame.maps[i].range->end = read.frame.maps[i + 1].range->begin;
    read.frame.maps[1].clip_from_world = read.frame.maps[0].clip_from_world * 1.5;
    Diagnosis const diagnosis = examined(read).diagnosis;
    EXPECT_EQ(faults(diagnosis), Ids{});
    EXPECT_EQ(maps_with(diagnosis, Ill::uncovered), std::set<int>{1});
}

TEST(DoctorCases, TheMapsMayBeTriedInTurnWithoutRanges) {
    Case read = read_case(folder / "library.json");
    read.choice = Selection::first;
    EXPECT_EQ(faults(examined(read).diagnosis), Ids{});
    read.frame.maps.pop_back();
    read.next.reset();
    EXPECT_EQ(faults(examined(read).diagnosis), Ids{"uncovered"});
    read.shadow_distance = 25.0;
    EXPECT_EQ(faults(examined(read).diagnosis), Ids{});
}

TEST(DoctorCases, ThePictureShowsWhatIsWrong) {
    auto const count = [](backend::Image<backend::Rgba8> const& picture, backend::Rgba8 colour) {
        return std::ranges::count_if(
            picture.pixels, [&](backend::Rgba8 p) { return p.r == colour.r && p.g == colour.g && p.b == colour.b; });
    };
    backend::Rgba8 const red{235, 40, 50, 255}, magenta{255, 70, 230, 255}, yellow{255, 196, 0, 255};
    auto const drawn = [](char const* file) {
        Examined const patient = examined(read_case(folder / file));
        return picture(patient.read, patient.sight, patient.diagnosis);
    };
    auto const good = drawn("good.json");
    for (auto const colour : {red, magenta, yellow}) EXPECT_EQ(count(good, colour), 0);
    EXPECT_GT(count(drawn("gap.json"), red), 100);
    EXPECT_GT(count(drawn("cut_casters.json"), magenta), 100);
    EXPECT_GT(count(drawn("constant_bias.json"), yellow), 1000);
}
