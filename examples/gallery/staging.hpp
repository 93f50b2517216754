// SPDX-License-Identifier: MIT
//
// A folder that appears whole or not at all: written beside its destination, moved there at the end.
#pragma once

#include <filesystem>

namespace shadowmath::gallery {

class Staging {
public:
    // Makes an empty folder beside `destination`. Throws std::runtime_error, one line, when that cannot be done, or
    // when something other than an earlier gallery stands at the destination: it will not be overwritten.
    explicit Staging(std::filesystem::path const& destination);
    ~Staging();  // removes what was not published
    Staging(Staging const&) = delete;
    Staging& operator=(Staging const&) = delete;

    [[nodiscard]] std::filesystem::path const& folder() const noexcept { return folder_; }

    // Puts the folder in the destination's place; an older gallery goes only now.
    void publish();

private:
    std::filesystem::path destination_;
    std::filesystem::path folder_;
};

}  // namespace shadowmath::gallery
