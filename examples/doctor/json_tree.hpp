// SPDX-License-Identifier: MIT
//
// JSON as a tree whose every value knows its line, so that whoever reads it can say where it is wrong. Parsed by
// nlohmann json; // comments are allowed.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace shadowmath::doctor {

enum class Json { null, boolean, number, string, array, object };

struct Node {
    Json kind = Json::null;
    int line = 1;  // where the value begins
    bool truth = false;
    double number = 0.0;
    std::string text;
    std::vector<std::string> keys;  // of an object, in the order of the file; as many as items
    std::vector<Node> items;

    // The member of an object, or null.
    [[nodiscard]] Node const* find(std::string_view key) const;
};

// Without what a terminal would take for a command or a new line.
[[nodiscard]] std::string one_line(std::string text);

// One line, "FILE:LINE: what was expected".
struct CaseError : std::runtime_error {
    CaseError(std::string const& file, int line, std::string const& what);
};

inline constexpr std::size_t largest_file = std::size_t{16} << 20;  // bytes
inline constexpr std::size_t deepest_nesting = 32;

// Throws CaseError, whatever the bytes; `file` is the name that it says.
[[nodiscard]] Node parse_json(std::string_view text, std::string const& file);

}  // namespace shadowmath::doctor
