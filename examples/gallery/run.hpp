// SPDX-License-Identifier: MIT
//
// The gallery's work: every technique, through every backend, in every view, against the truth.
#pragma once

#include "examples/gallery/claims.hpp"
#include "examples/gallery/close_ups.hpp"
#include "examples/gallery/device_fit.hpp"
#include "examples/gallery/flight.hpp"
#include "examples/gallery/parity.hpp"
#include "examples/gallery/record.hpp"
#include "examples/gallery/settings.hpp"
#include "examples/gallery/techniques.hpp"
#include "examples/gallery/ways.hpp"
#include "scenes/scenes.hpp"

#include <array>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>

namespace shadowmath::gallery {

using Backends = std::span<std::unique_ptr<backend::Backend> const>;

struct Results {
    std::vector<Record> records;
    std::vector<WayRecord> ways;        // of the first view of each scene
    std::vector<Parity> parity;         // of each scene and backend but the first
    std::vector<FitRecord> fits;        // of each scene and backend
    std::vector<FlightRecord> flights;  // through the first view of each scene that a sun lights, every policy
    std::vector<Claim> claims;
    std::vector<CloseUp> close_ups;
};

// Called with one line for whoever waits, without its end; may throw to stop the work.
using Tell = std::function<void(std::string const& line)>;

// The views of a scene that this run shows: all, or two that span them.
[[nodiscard]] std::span<scenes::View const> chosen_views(scenes::NamedScene const& scene, Settings const& settings);

// Techniques whose pictures of a scene's first view are written from every backend, to stand side by side.
inline constexpr std::array<char const*, 2> shown_on_every_driver{"cascades-4-stable", "sdsm-gpu"};

// Writes the pictures of the first backend below folder, as picture_path names them. The first backend also finds the
// truth and measures the claims; the others give records.
[[nodiscard]] Results run(Settings const& settings, std::span<scenes::NamedScene const> scenes, Backends backends,
                          std::filesystem::path const& folder, Tell const& tell);

// "images/SCENE/VIEW/NAME.png" where NAME is "truth" or "TECHNIQUE-KIND", KIND one of "picture", "difference", "maps",
// "overlay", "footprint"; "picture-BACKEND" of the others.
[[nodiscard]] std::filesystem::path picture_path(std::string const& scene, std::string const& view,
                                                 std::string const& name);

}  // namespace shadowmath::gallery
