// SPDX-License-Identifier: MIT
#include "examples/doctor/fields.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace shadowmath::doctor {
namespace {

std::string what_is(Node const& node) {
    switch (node.kind) {
        case Json::null: return "null";
        case Json::boolean: return node.truth ? "true" : "false";
        case Json::number: {
            std::ostringstream text;
            text << node.number;
            return text.str();
        }
        case Json::string: return "\"" + node.text.substr(0, 40) + "\"";
        case Json::array: return "a list of " + std::to_string(node.items.size());
        case Json::object: break;
    }
    return "an object";
}

std::string printed(double number) {
    std::ostringstream text;
    text << number;
    return text.str();
}

// How many letters must change to make one word the other.
std::size_t letters_between(std::string_view a, std::string_view b) {
    std::vector<std::size_t> row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        std::size_t corner = row[0];
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            std::size_t const changed = corner + (a[i - 1] == b[j - 1] ? 0 : 1);
            corner = row[j];
            row[j] = std::min({changed, row[j] + 1, row[j - 1] + 1});
        }
    }
    return row.back();
}

}  // namespace

Fields::Fields(Node const& node, std::string path, Complaints& complaints)
    : node_(node), path_(std::move(path)), complaints_(complaints) {
    if (node.kind == Json::object) return;
    complaints_.refuse(node.line,
                       (path_.empty() ? "the file" : path_) + ": expected an object { }, found " + what_is(node));
}

std::string Fields::name(char const* key) const {
    return path_.empty() ? key : path_ + "." + key;
}

void Fields::expected(Node const& found, char const* key, std::string const& what) const {
    complaints_.refuse(found.line, name(key) + ": expected " + what + ", found " + what_is(found));
}

Node const* Fields::optional(char const* key) {
    asked_.emplace_back(key);
    return node_.find(key);
}

Node const& Fields::required(char const* key, char const* what) {
    Node const* const found = optional(key);
    if (found == nullptr)
        complaints_.refuse(node_.line, "\"" + std::string(key) + "\" is missing in " +
                                           (path_.empty() ? "the file" : path_) + ": " + what);
    return *found;
}

double Fields::number(char const* key, double least, double most, std::optional<double> otherwise) {
    std::string const what = "a number from " + printed(least) + " to " + printed(most);
    if (otherwise && node_.find(key) == nullptr) return (void)optional(key), *otherwise;
    Node const& found = required(key, what.c_str());
    if (found.kind != Json::number || !(found.number >= least && found.number <= most)) expected(found, key, what);
    return found.number;
}

int Fields::whole(char const* key, int least, int most, std::optional<int> otherwise) {
    double const value =
        number(key, least, most, otherwise ? std::optional<double>(*otherwise) : std::optional<double>());
    if (value != std::floor(value)) expected(*node_.find(key), key, "a whole number");
    return static_cast<int>(value);
}

bool Fields::flag(char const* key, bool otherwise) {
    Node const* const found = optional(key);
    if (found == nullptr) return otherwise;
    if (found->kind != Json::boolean) expected(*found, key, "true or false");
    return found->truth;
}

std::string Fields::text(char const* key, std::optional<std::string> otherwise) {
    if (otherwise && node_.find(key) == nullptr) return (void)optional(key), *otherwise;
    Node const& found = required(key, "a text");
    if (found.kind != Json::string) expected(found, key, "a text");
    return found.text;
}

std::size_t Fields::word(char const* key, std::initializer_list<char const*> words,
                         std::optional<std::size_t> otherwise) {
    std::string what = "one of";
    for (char const* const word : words) what += " \"" + std::string(word) + "\"";
    if (otherwise && node_.find(key) == nullptr) return (void)optional(key), *otherwise;
    Node const& found = required(key, what.c_str());
    auto const at = std::ranges::find(words, found.text, [](char const* word) { return std::string_view(word); });
    if (found.kind != Json::string || at == words.end()) expected(found, key, what);
    return static_cast<std::size_t>(at - words.begin());
}

void Fields::take_numbers(Node const& list, char const* key, std::size_t count, std::vector<double>& into) const {
    if (list.kind != Json::array || list.items.size() != count)
        expected(list, key, "a list of " + std::to_string(count) + " numbers");
    for (Node const& item : list.items) {
        if (item.kind != Json::number || !(std::abs(item.number) <= largest_number))
            expected(item, key, "numbers up to " + printed(largest_number));
        into.push_back(item.number);
    }
}

std::vector<double> Fields::numbers(char const* key, std::size_t count) {
    std::vector<double> found;
    std::string const what = "a list of " + std::to_string(count) + " numbers";
    take_numbers(required(key, what.c_str()), key, count, found);
    return found;
}

glm::dvec3 Fields::vector(char const* key, std::optional<glm::dvec3> otherwise) {
    if (otherwise && node_.find(key) == nullptr) return (void)optional(key), *otherwise;
    std::vector<double> const n = numbers(key, 3);
    return {n[0], n[1], n[2]};
}

glm::dmat4 Fields::matrix(char const* key, bool column_major) {
    Node const& found = required(key, "the sixteen numbers of a matrix");
    std::vector<double> n;
    if (found.kind == Json::array && found.items.size() == 4)
        for (Node const& four : found.items) take_numbers(four, key, 4, n);
    else
        take_numbers(found, key, 16, n);
    glm::dmat4 matrix;
    for (int i = 0; i < 16; ++i)
        matrix[column_major ? i / 4 : i % 4][column_major ? i % 4 : i / 4] = n[static_cast<std::size_t>(i)];
    return matrix;
}

void Fields::done() {
    for (std::size_t i = 0; i < node_.keys.size(); ++i) {
        std::string const& key = node_.keys[i];
        if (std::ranges::find(asked_, key) != asked_.end()) continue;
        std::string line = complaints_.file + ":" + std::to_string(node_.items[i].line) + ": unknown key \"" +
                           key.substr(0, 60) + "\"";
        if (!path_.empty()) line += " in " + path_;
        auto const nearest =
            std::ranges::min_element(asked_, {}, [&](std::string const& known) { return letters_between(known, key); });
        if (nearest != asked_.end() && letters_between(*nearest, key) <= 3)
            line += "; did you mean \"" + *nearest + "\"?";
        complaints_.unknown_keys.push_back(one_line(line));
    }
}

}  // namespace shadowmath::doctor
