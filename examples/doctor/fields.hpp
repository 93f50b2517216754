// SPDX-License-Identifier: MIT
//
// The members of a JSON object, asked for one by one: each is checked against what it must be, and what nobody asked
// for is said at the end.
#pragma once

#include "examples/doctor/json_tree.hpp"

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>

#include <initializer_list>
#include <optional>

namespace shadowmath::doctor {

// Where complaints go: the name of the file, and the keys that were not known.
struct Complaints {
    std::string file;
    std::vector<std::string> unknown_keys;

    [[noreturn]] void refuse(int line, std::string const& what) const { throw CaseError(file, line, what); }
};

inline constexpr double largest_number = 1e12;  // metres, mostly: more is a mistake

class Fields {
public:
    // Refuses what is no object. `path` names it: "camera", "maps[2]".
    Fields(Node const& node, std::string path, Complaints& complaints);

    [[nodiscard]] Node const* optional(char const* key);
    [[nodiscard]] Node const& required(char const* key, char const* what);

    [[nodiscard]] double number(char const* key, double least, double most, std::optional<double> otherwise = {});
    [[nodiscard]] int whole(char const* key, int least, int most, std::optional<int> otherwise = {});
    [[nodiscard]] bool flag(char const* key, bool otherwise);
    [[nodiscard]] std::string text(char const* key, std::optional<std::string> otherwise = {});
    // The place of the text among the words.
    [[nodiscard]] std::size_t word(char const* key, std::initializer_list<char const*> words,
                                   std::optional<std::size_t> otherwise = {});
    [[nodiscard]] glm::dvec3 vector(char const* key, std::optional<glm::dvec3> otherwise = {});
    [[nodiscard]] std::vector<double> numbers(char const* key, std::size_t count);
    // Of column vectors, however its sixteen numbers lie: in one list, or in four lists of four.
    [[nodiscard]] glm::dmat4 matrix(char const* key, bool column_major);

    [[nodiscard]] std::string name(char const* key) const;
    [[nodiscard]] int line() const { return node_.line; }
    [[nodiscard]] Complaints const& complaints() const { return complaints_; }

    // Notes the keys that nobody asked for.
    void done();

private:
    [[noreturn]] void expected(Node const& found, char const* key, std::string const& what) const;
    void take_numbers(Node const& list, char const* key, std::size_t count, std::vector<double>& into) const;

    Node const& node_;
    std::string path_;
    Complaints& complaints_;
    std::vector<std::string> asked_;
};

}  // namespace shadowmath::doctor
