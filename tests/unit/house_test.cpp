// SPDX-License-Identifier: MIT
//
// The rules of the house that a compiler does not see, read from the sources: who includes whom, and what is never
// called.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

fs::path const root = SHADOWMATH_SOURCE_DIR;

std::string text_of(fs::path const& path) {
    std::ostringstream text;
    text << std::ifstream(path).rdbuf();
    return text.str();
}

std::string code_of(fs::path const& path) {
    return std::regex_replace(text_of(path), std::regex("//[^\n]*"), "");
}

std::vector<fs::path> sources_under(char const* folder) {
    std::vector<fs::path> found;
    for (fs::directory_entry const& entry : fs::recursive_directory_iterator(root / folder))
        if (entry.path().extension() == ".hpp" || entry.path().extension() == ".cpp") found.push_back(entry.path());
    EXPECT_FALSE(found.empty()) << folder;
    return found;
}

std::vector<std::string> matches(std::string const& text, std::regex const& pattern, std::size_t group = 1) {
    std::vector<std::string> found;
    for (auto it = std::sregex_iterator(text.begin(), text.end(), pattern); it != std::sregex_iterator(); ++it)
        found.push_back((*it)[group]);
    return found;
}

// From a function's name to the brace that closes it, in the first column.
std::string body_of(std::string const& text, std::string const& name) {
    std::smatch found;
    if (!std::regex_search(text, found, std::regex("\n\\w+ " + name + "\\("))) return {};
    auto const begin = static_cast<std::size_t>(found.position());
    return text.substr(begin, text.find("\n}", begin) - begin);
}

std::vector<std::string> includes_of(fs::path const& path) {
    return matches(text_of(path), std::regex("# *include *[<\"]([^>\"]+)[>\"]"));
}

}  // namespace

TEST(House, TheReadmeShowsCodeThatCompiles) {
    std::string const readme = text_of(root / "README.md");
    std::string const open = "```cpp\n";
    std::size_t const begin = readme.find(open) + open.size(), end = readme.find("```", begin);
    ASSERT_TRUE(begin >= open.size() && end != std::string::npos);
    std::istringstream shown(readme.substr(begin, end - begin));
    std::string const compiled = text_of(root / "tests/compile/readme_example.cpp");
    std::size_t at = 0;
    int lines = 0;
    for (std::string line; std::getline(shown, line); ++lines) {
        at = compiled.find(line + "\n", at);
        ASSERT_NE(at, std::string::npos) << "line " << lines + 1 << " of the README's code is not compiled: " << line;
    }
    EXPECT_GE(lines, 12);
}

TEST(House, HeadersIncludeGlmAndLightStandardHeadersOnly) {
    std::set<std::string> const light = {"array",   "cmath",  "cstddef", "cstdint",
                                         "cstring", "limits", "cassert", "shadowmath_user_config.hpp"};
    for (fs::path const& header : sources_under("include/shadowmath"))
        for (std::string const& included : includes_of(header))
            EXPECT_TRUE(light.count(included) == 1 || included.rfind("shadowmath/", 0) == 0 ||
                        (included.rfind("glm/", 0) == 0 && header.filename() == "config.hpp") ||
                        (included == "immintrin.h" && header.filename() == "x86_lanes.hpp"))
                << header << " includes " << included;
}

TEST(House, BackendsKnowNoTechnique) {
    for (fs::path const& source : sources_under("backends"))
        for (std::string const& included : includes_of(source))
            EXPECT_NE(included.rfind("shadowmath/", 0), 0u) << source << " includes " << included;
}

TEST(House, NobodyCallsAGlmFunctionWhoseMeaningDependsOnMacros) {
    std::regex const unsuffixed(
        R"(\b(?:glm::)(ortho|perspective|perspectiveFov|frustum|lookAt|infinitePerspective|unProject|project)\s*[(<])");
    for (char const* folder : {"include", "backends", "scenes", "oracle", "examples"})
        for (fs::path const& source : sources_under(folder))
            for (std::string const& called : matches(code_of(source), unsuffixed))
                ADD_FAILURE() << source << " calls glm::" << called;
}

TEST(House, HeadersNeitherThrowNorAllocateNorKeepState) {
    std::regex const forbidden(
        R"(\b(throw|try|catch|new|delete|malloc|static_assert\(false|thread_local|typeid|dynamic_cast)\b)");
    for (fs::path const& header : sources_under("include/shadowmath"))
        for (std::string const& word : matches(code_of(header), forbidden)) ADD_FAILURE() << header << " says " << word;
}

TEST(House, EveryPublicFunctionIsInstantiatedByTheCompileTests) {
    // A function at the level of the namespace starts its line; names in namespace detail are not public.
    std::regex const declaration(R"(\n(?:\[\[nodiscard\]\] )?(?:inline|constexpr) (?:[^;{}=()]*? )?(\w+)\()");
    std::regex const hidden(R"(\nnamespace detail \{[\s\S]*?\n\}  ?\n)");
    std::string const called = text_of(root / "tests/compile/every_function.hpp");
    for (fs::path const& header : sources_under("include/shadowmath"))
        for (std::string const& name : matches(std::regex_replace(code_of(header), hidden, "\n"), declaration))
            EXPECT_TRUE(std::regex_search(called, std::regex("\\b" + name + "\\b"))) << header << ": " << name;
}

TEST(House, EveryFunctionOfTheGlslLibraryIsHeldAgainstTheCppByATwin) {
    // A few are steps of one other function and differ from it by a line: that one is asked, and calls them.
    std::map<std::string, std::string> const steps = {{"sm_slope_at", "sm_slope"},
                                                      {"sm_lean_at", "sm_lean"},
                                                      {"sm_pixel_plane", "sm_shadow_volume"},
                                                      {"sm_quotient_or_zero", "sm_solve_hankel"}};
    auto const calls = [](std::string const& text, std::string const& name) {
        return std::regex_search(text, std::regex("\\b" + name + "\\("));
    };
    std::string asked, library;
    for (fs::directory_entry const& entry : fs::directory_iterator(root / "tests/twins"))
        if (entry.path().extension() == ".comp") asked += code_of(entry.path());
    for (fs::directory_entry const& entry : fs::directory_iterator(root / "include/shadowmath/glsl"))
        library += code_of(entry.path());
    int count = 0;
    for (fs::directory_entry const& entry : fs::directory_iterator(root / "include/shadowmath/glsl")) {
        std::string const text = code_of(entry.path());
        for (std::string const& name : matches(text, std::regex(R"(\n\w+ (sm_\w+)\([^;{]*\) \{)"))) {
            ++count;
            auto const step = steps.find(name);
            if (step == steps.end()) {
                EXPECT_TRUE(calls(asked, name)) << entry.path() << ": no shader of tests/twins asks " << name;
                continue;
            }
            std::string const caller = body_of(library, step->second);
            EXPECT_TRUE(calls(asked, step->second) && calls(caller, name)) << name << " is no step of " << step->second;
        }
    }
    EXPECT_GE(count, 120);
}

TEST(House, EveryAssertionIsSeenToFail) {
    std::regex const assertion(R"re(\bSHADOWMATH_ASSERT\([^;]*"([^"]+)"\);)re");
    std::string const broken = text_of(root / "tests/misuse/misuse_test.cpp");
    int count = 0;
    for (fs::path const& header : sources_under("include/shadowmath"))
        for (std::string const& sentence : matches(code_of(header), assertion)) {
            ++count;
            EXPECT_NE(broken.find('"' + sentence + '"'), std::string::npos) << header << ": " << sentence;
        }
    EXPECT_GE(count, 5);
}

TEST(House, TheVisualStudioDebuggerKnowsEveryFault) {
    std::string const natvis = text_of(root / "debug/shadowmath.natvis");
    std::string const header = text_of(root / "include/shadowmath/fault.hpp");
    std::regex const enumerator(R"(\n    (\w+) = 1u << (\d+))");
    int count = 0;
    for (auto it = std::sregex_iterator(header.begin(), header.end(), enumerator); it != std::sregex_iterator();
         ++it, ++count) {
        std::string const bit = std::to_string(1u << std::stoi((*it)[2]));
        std::string const item = "<Item Name=\"" + (*it)[1].str() + "\" Condition=\"(bits &amp; " + bit + ") != 0\">";
        EXPECT_NE(natvis.find(item), std::string::npos) << item;
    }
    EXPECT_GE(count, 16);
}

TEST(House, BothDebuggersKnowTheSameTypes) {
    std::string const natvis = text_of(root / "debug/shadowmath.natvis"),
                      gdb = text_of(root / "debug/shadowmath_gdb.py");
    auto const seen_by_natvis = matches(natvis, std::regex("<Type Name=\"shadowmath::v0::(\\w+)"));
    for (std::string const& type : seen_by_natvis)
        EXPECT_TRUE(std::regex_search(gdb, std::regex("\n    \"" + type + "\": |for kind in \\(.*\\b" + type + "\\b")))
            << type;
    for (std::string const& type : matches(gdb, std::regex("\n    \"(\\w+)\": ")))
        EXPECT_NE(natvis.find("v0::" + type), std::string::npos) << type;
    EXPECT_GE(seen_by_natvis.size(), 30u);
}

TEST(House, EveryHeaderHasLawsOrAUnitTest) {
    // Parts of another header, which is the only one that calls them.
    std::map<std::string, std::string> const part_of{{"lists", "grid"},
                                                     {"tile", "grid"},
                                                     {"casters", "trace"},
                                                     {"chunk", "trace"},
                                                     {"cover", "trace"},
                                                     {"plain_lanes", "irregular_lanes"},
                                                     {"x86_lanes", "irregular_lanes"},
                                                     {"bounds_of_body", "projected_bounds"},
                                                     {"bounds_of_boxes", "projected_bounds"},
                                                     {"slice_edges", "slices_in_scene"},
                                                     {"view_of_box", "slices_in_scene"},
                                                     {"four_warps", "slice_warps"},
                                                     {"warped_edges", "slice_warps"},
                                                     {"shafts_of_light", "slice_warps"}};
    for (fs::path const& header : sources_under("include/shadowmath")) {
        std::string name = header.stem().string();
        if (part_of.count(name) != 0) name = part_of.at(name);
        // Without a function of their own: macros and names, and what only other headers call.
        if (name == "version" || name == "config" || name == "shadowmath" || name == "irregular" || name == "reach")
            continue;
        bool const covered =
            fs::exists(root / "tests/laws" / (name + ".hpp")) || fs::exists(root / "tests/unit" / (name + "_test.cpp"));
        EXPECT_TRUE(covered) << header;
    }
}
