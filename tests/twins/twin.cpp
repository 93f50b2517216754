// SPDX-License-Identifier: MIT
#include "tests/twins/twin.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>
#include <sstream>

namespace shadowmath::twins {
namespace {

struct Row {
    std::string name, driver;
    std::int64_t allowed = 0, seen = 0;
    std::size_t distinct = 0;
};

// Printed after the last test.
class Table : public testing::Environment {
public:
    std::vector<Row> rows;

    void TearDown() override {
        if (rows.empty()) return;
        std::stable_sort(rows.begin(), rows.end(), [](Row const& a, Row const& b) { return a.name < b.name; });
        std::printf("%-26s %-9s %12s %12s %12s   of %u cases\n", "GLSL function", "driver", "ulps seen", "ulps stated",
                    "answers", case_count);
        for (Row const& row : rows)
            std::printf("%-26s %-9s %12lld %12lld %12zu\n", row.name.c_str(), row.driver.c_str(),
                        static_cast<long long>(row.seen), static_cast<long long>(row.allowed), row.distinct);
    }
};

Table& table() {
    static auto* const rows = static_cast<Table*>(testing::AddGlobalTestEnvironment(new Table));
    return *rows;
}
[[maybe_unused]] Table const& registered = table();  // before the tests begin

// Floats in their own order, as integers that are one apart where the floats are neighbours.
std::int64_t ordered(float v) {
    auto const bits = std::bit_cast<std::int32_t>(v);
    return bits >= 0 ? bits : -static_cast<std::int64_t>(bits & 0x7fffffff);
}

std::int64_t ulps_between(float a, float b) {
    if (std::isnan(a) && std::isnan(b)) return 0;
    if (std::isnan(a) || std::isnan(b)) return std::numeric_limits<std::int64_t>::max();
    constexpr float least_normal = std::numeric_limits<float>::min();
    if (std::fabs(a) < least_normal && std::fabs(b) < least_normal) return 0;
    return std::llabs(ordered(a) - ordered(b));
}

std::string shown(std::span<std::uint32_t const> words) {
    std::string text;
    char word[64];
    for (std::uint32_t const bits : words) {
        std::snprintf(word, sizeof word, " %.9g (%08x)", static_cast<double>(std::bit_cast<float>(bits)), bits);
        text += word;
    }
    return text;
}

}  // namespace

void hold_together(ComputeRunner& runner, std::string const& driver, Twin const& twin, Words const& given,
                   Words const& expected) {
    std::size_t const in = given.words().size() / case_count, out = expected.words().size() / case_count;
    ASSERT_EQ(in * case_count, given.words().size());
    ASSERT_EQ(out * case_count, expected.words().size());
    std::array const question{twin.function, case_count, static_cast<std::uint32_t>(in),
                              static_cast<std::uint32_t>(out)};
    Dispatch const pass{&twin.shader,
                        {(case_count + 63) / 64, 1, 1},
                        {upload(runner, given.words()), runner.make_storage(expected.words().size() * 4)},
                        twin.textures,
                        std::as_bytes(std::span(question))};
    runner.run({&pass, 1});
    auto const found = read_back<std::uint32_t>(runner, pass.storage[1], expected.words().size());

    Row row{twin.name, driver};
    std::set<std::vector<std::uint32_t>> distinct;
    int disagreements = 0;
    for (std::size_t i = 0; i < case_count; ++i) {
        std::span const answer = std::span(expected.words()).subspan(i * out, out);
        distinct.emplace(answer.begin(), answer.end());
        for (std::size_t k = i * out; k < (i + 1) * out; ++k) {
            std::int64_t const allowed = expected.allowed_ulps(k);
            std::int64_t const apart =
                allowed < 0 ? (found[k] == expected.words()[k] ? 0 : std::numeric_limits<std::int64_t>::max())
                            : ulps_between(std::bit_cast<float>(found[k]), std::bit_cast<float>(expected.words()[k]));
            row.allowed = std::max(row.allowed, allowed);
            row.seen = std::max(row.seen, apart);
            if (apart <= std::max(allowed, std::int64_t{0}) || ++disagreements > 3) continue;
            ADD_FAILURE() << twin.name << " on " << driver << ", case " << i << ", word " << k - i * out << ": "
                          << apart << " ulps apart, " << std::max(allowed, std::int64_t{0}) << " stated\n  given"
                          << shown(std::span(given.words()).subspan(i * in, in)) << "\n  C++  " << shown(answer)
                          << "\n  GLSL " << shown(std::span(found).subspan(i * out, out));
        }
    }
    EXPECT_EQ(disagreements, 0) << twin.name << " on " << driver;
    EXPECT_GE(distinct.size(), twin.least_distinct) << twin.name << ": too few different answers";
    row.distinct = distinct.size();
    table().rows.push_back(row);
}

}  // namespace shadowmath::twins
