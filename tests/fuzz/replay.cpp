// SPDX-License-Identifier: MIT
//
// Runs the laws on stored and on pseudo-random bytes, the same on every machine, and prints for each target a hash of
// what came out.
//
//   replay [--finite] [--flush] [--cases N] [--seed S] [target or file ...]
//
// --finite leaves out NaN and infinity, for builds with -ffast-math; --flush takes denormals for zero, as games do (x86
// only). A file belongs to the target that its folder is named after.
#include "tests/fuzz/case.hpp"
#include "tests/support/counted_new.hpp"

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

namespace {

using namespace shadowmath::fuzz;
using Bytes = std::vector<std::uint8_t>;

Numbers numbers = Numbers::any;
int broken = 0;

// splitmix64
std::uint64_t next_random(std::uint64_t& state) {
    std::uint64_t z = state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

std::uint64_t run(Target const& target, Bytes const& bytes, std::string const& label) {
    Case c(bytes.data(), bytes.size(), numbers);
    target.laws(c);
    if (c.broken_law() != nullptr) {
        if (++broken <= 20) std::printf("BROKEN %s, %s: %s\n", target.name, label.c_str(), c.broken_law());
    }
    return c.hash();
}

std::uint64_t run_random(Target const& target, std::uint64_t seed, int cases) {
    std::uint64_t const of_nothing = Case(nullptr, 0, numbers).hash();
    std::uint64_t state = seed, hash = 0;
    bool hashed = false;
    Bytes bytes(512);
    for (int i = 0; i < cases; ++i) {
        for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(next_random(state) >> 56);
        std::uint64_t const of_case = run(target, bytes, "case " + std::to_string(i));
        hashed = hashed || of_case != of_nothing;
        hash = hash * 31 + of_case;
    }
    if (!hashed && ++broken <= 20) std::printf("BROKEN %s: no case hashes anything\n", target.name);
    return hash;
}

int run_file(std::string const& path) {
    std::ifstream file(path, std::ios::binary);
    Bytes const bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    std::string const folder = path.substr(0, path.find_last_of('/'));
    std::string const wanted = folder.substr(folder.find_last_of('/') + 1);
    int found = 0;
    for (Target const& target : targets())
        if (wanted == target.name && !bytes.empty()) {
            run(target, bytes, path);
            ++found;
        }
    if (found == 0) std::printf("BROKEN %s: neither a target nor a file of one\n", path.c_str());
    return found == 0 ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv) {
    int cases = 500, files = 0;
    std::uint64_t seed = 20021201;
    std::vector<std::string> wanted, paths;
    for (int i = 1; i < argc; ++i) {
        std::string const argument = argv[i];
        if (argument == "--finite") numbers = Numbers::finite;
#if defined(__SSE2__)
        else if (argument == "--flush")
            _mm_setcsr(_mm_getcsr() | 0x8040u);
#endif
        else if (argument == "--cases" && i + 1 < argc)
            cases = std::atoi(argv[++i]);
        else if (argument == "--seed" && i + 1 < argc)
            seed = std::strtoull(argv[++i], nullptr, 0);
        else if (argument.find('/') != std::string::npos)
            paths.push_back(argument);
        else
            wanted.push_back(argument);
    }
    for (std::string const& path : paths) {
        broken += run_file(path);
        ++files;
    }
    if (files > 0) std::printf("%d files\n", files);
    for (Target const& target : targets()) {
        bool chosen = wanted.empty() && files == 0;
        for (std::string const& name : wanted) chosen = chosen || name == target.name;
        if (chosen)
            std::printf("%s %d cases %016llx\n", target.name, cases,
                        static_cast<unsigned long long>(run_random(target, seed, cases)));
    }
    if (broken > 0) std::printf("%d cases break a law\n", broken);
    return broken == 0 ? 0 : 1;
}
