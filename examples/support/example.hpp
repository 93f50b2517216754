// SPDX-License-Identifier: MIT
//
// How a numbered example ends: it says what it has proved, writes its picture, and fails where either is not so.
//
//   example [FOLDER]     the picture goes into this folder, or where one stands
#pragma once

#include <cstdio>
#include <cstdlib>
#include <filesystem>

namespace shadowmath::example {

class Proof {
public:
    Proof(int argc, char** argv) : folder_(argc > 1 ? argv[1] : ".") {}

    // Prints the sentence with yes or no before it.
    void that(bool holds, char const* sentence) {
        std::printf("%s  %s\n", holds ? "yes" : "NO ", sentence);
        all_ = all_ && holds;
    }
    [[nodiscard]] std::filesystem::path const& folder() const { return folder_; }
    [[nodiscard]] int result() const { return all_ ? EXIT_SUCCESS : EXIT_FAILURE; }

private:
    std::filesystem::path folder_;
    bool all_ = true;
};

}  // namespace shadowmath::example
