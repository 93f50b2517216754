// SPDX-License-Identifier: MIT
#include "examples/doctor/json_tree.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <iterator>

namespace shadowmath::doctor {
namespace {

// The line of what was read last, blanks aside. A lexer is at most one character ahead of its token, and then that is a
// blank, a bracket or a comma on the same line.
struct Lines {
    int now = 1;
    int token = 1;

    void pass(char c) {
        if (c == '\n')
            ++now;
        else if (c != ' ' && c != '\t' && c != '\r')
            token = now;
    }
};

class Reading {
public:
    using iterator_category = std::input_iterator_tag;
    using value_type = char;
    using difference_type = std::ptrdiff_t;
    using pointer = char const*;
    using reference = char const&;

    Reading(char const* at, Lines* lines) : at_(at), lines_(lines) {}
    reference operator*() const { return *at_; }
    Reading& operator++() {
        lines_->pass(*at_++);
        return *this;
    }
    Reading operator++(int) {
        Reading const before = *this;
        ++*this;
        return before;
    }
    friend bool operator==(Reading const& a, Reading const& b) { return a.at_ == b.at_; }
    friend bool operator!=(Reading const& a, Reading const& b) { return a.at_ != b.at_; }

private:
    char const* at_;
    Lines* lines_;
};

// Parsers quote what they stumbled over; here only what any terminal can show.
std::string printable(std::string text) {
    std::ranges::replace_if(
        text, [](char c) { return c < ' ' || c > '~'; }, '?');
    if (text.size() > 160) text.replace(157, std::string::npos, "...");
    return text;
}

class Builder : public nlohmann::json_sax<nlohmann::json> {
public:
    Builder(std::string const& file, Lines const& lines) : file_(file), lines_(lines) {}
    [[nodiscard]] Node take() { return std::move(root_); }

    bool null() override { return add(Json::null), true; }
    bool boolean(bool value) override { return add(Json::boolean).truth = value, true; }
    bool number_integer(number_integer_t value) override { return number(static_cast<double>(value)); }
    bool number_unsigned(number_unsigned_t value) override { return number(static_cast<double>(value)); }
    bool number_float(number_float_t value, string_t const&) override { return number(value); }
    bool string(string_t& value) override { return add(Json::string).text = value, true; }
    bool binary(binary_t&) override { return false; }
    bool start_object(std::size_t) override { return open(Json::object); }
    bool start_array(std::size_t) override { return open(Json::array); }
    bool end_object() override { return open_.pop_back(), true; }
    bool end_array() override { return open_.pop_back(), true; }
    bool key(string_t& value) override {
        Node& object = *open_.back();
        if (object.find(value) != nullptr)
            throw CaseError(file_, lines_.token,
                            "the key \"" + printable(value) + "\" stands here for the second time");
        object.keys.push_back(value);
        return true;
    }
    bool parse_error(std::size_t, std::string const&, nlohmann::json::exception const& error) override {
        // "[json.exception.parse_error.101] parse error at line 3, column 5: what"
        std::string what = error.what();
        for (std::string_view const mark : {"] ", "column "}) {
            std::size_t const at = what.find(mark);
            if (at != std::string::npos) what.erase(0, at + mark.size());
        }
        what.erase(0, what.find_first_not_of("0123456789: "));
        throw CaseError(file_, lines_.token, printable("no JSON: " + what));
    }

private:
    Node& add(Json kind) {
        Node* node = &root_;
        if (!open_.empty()) node = &open_.back()->items.emplace_back();
        node->kind = kind;
        node->line = lines_.token;
        return *node;
    }
    bool number(double value) { return add(Json::number).number = value, true; }
    bool open(Json kind) {
        if (open_.size() >= deepest_nesting)
            throw CaseError(file_, lines_.token,
                            "nested more than " + std::to_string(deepest_nesting) + " brackets deep");
        // NOTE: a list grows only while none of its items is open, so what is pointed to stays where it is.
        open_.push_back(&add(kind));
        return true;
    }

    std::string const& file_;
    Lines const& lines_;
    Node root_;
    std::vector<Node*> open_;
};

}  // namespace

Node const* Node::find(std::string_view key) const {
    auto const at = std::ranges::find(keys, key);
    return at == keys.end() ? nullptr : &items[static_cast<std::size_t>(at - keys.begin())];
}

std::string one_line(std::string text) {
    std::ranges::replace_if(
        text, [](char c) { return (c >= '\0' && c < ' ') || c == '\x7f'; }, '?');
    return text;
}

CaseError::CaseError(std::string const& file, int line, std::string const& what)
    : std::runtime_error(file + ":" + std::to_string(line) + ": " + one_line(what)) {}

Node parse_json(std::string_view text, std::string const& file) {
    if (text.size() > largest_file)
        throw CaseError(file, 1, "larger than " + std::to_string(largest_file >> 20) + " MiB, which no case needs");
    Lines lines;
    Builder builder(file, lines);
    nlohmann::json::sax_parse(Reading(text.data(), &lines), Reading(text.data() + text.size(), &lines), &builder,
                              nlohmann::json::input_format_t::json, true, true);
    return builder.take();
}

}  // namespace shadowmath::doctor
