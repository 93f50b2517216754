// SPDX-License-Identifier: MIT
#include "examples/gallery/promises.hpp"

#include <algorithm>

namespace shadowmath::gallery {
namespace {

constexpr long most_ulp = 2;

class Broken {
public:
    explicit Broken(std::vector<std::string>& sentences) : sentences_(sentences) {}

    // Whose figures the next ones are.
    void of(std::string const& whose) { whose_ = whose; }

    // "town, vulkan: 3 texels are covered in one driver's maps alone"
    void beyond(long most, long count, std::string const& what) {
        if (count > most) sentences_.push_back(whose_ + ": " + std::to_string(count) + " " + what);
    }

private:
    std::vector<std::string>& sentences_;
    std::string whose_;
};

void judge(Broken& broken, Parity const& p) {
    broken.of(p.scene + ", " + p.backend);
    broken.beyond(0, p.covered_in_one, "texels are covered in one driver's maps alone");
    broken.beyond(most_ulp, p.largest_ulp, "ulp lie between two drivers' depths");
    broken.beyond(0, p.unlike_off_edges, "pixels off edges are unlike the first driver's");
}

// `first`: one pass a map, of the same scene and driver.
void judge(Broken& broken, WayRecord const& w, WayRecord const& first) {
    broken.of(w.scene + ", " + w.backend + ", " + w.way);
    broken.beyond(0, w.unlike_texels, "texels are unlike those of one pass a map");
    broken.beyond(0, w.unlike_pixels, "pixels are unlike those of all maps at once");
    if (w.with_picture) return;
    auto const differ = [](std::uint64_t a, std::uint64_t b) { return static_cast<long>(a > b ? a - b : b - a); };
    broken.beyond(0, differ(w.work.triangles, first.work.triangles), "triangles more or fewer than one pass a map");
    if (w.work.driver)
        broken.beyond(0, differ(w.work.driver->clipper_triangles, first.work.triangles),
                      "triangles more or fewer reached the clipper than objects cast into maps");
}

void judge(Broken& broken, FitRecord const& f) {
    broken.of(f.scene + ", " + f.backend + ", fitted on the device");
    broken.beyond(0, f.unlike_maps, "maps are not those of the C++");
    broken.beyond(0, f.unlike_texels, "texels are unlike those that the C++'s matrices give");
    broken.beyond(f.pixels / 100000, f.unlike_pixels, "pixels are unlike those that the C++'s maps give");
}

// A few thousand decisions are too few to tell one in ten thousand.
void judge(Broken& broken, FlightRecord const& f) {
    if (!f.stable || f.decisions < 100000) return;
    broken.of(f.scene + ", " + f.policy + " under way");
    broken.beyond(static_cast<long>(most_shimmer * static_cast<double>(f.decisions)), f.flips,
                  "of " + std::to_string(f.decisions) + " decisions flip");
}

}  // namespace

bool share_a_rasteriser(Backends backends) {
    return std::ranges::all_of(
        backends, [](auto const& backend) { return backend->info().driver.find("llvmpipe") != std::string::npos; });
}

std::vector<std::string> broken_promises(Results const& results) {
    std::vector<std::string> sentences;
    Broken broken(sentences);
    for (Parity const& parity : results.parity) judge(broken, parity);
    for (WayRecord const& way : results.ways) {
        auto const is_first = [&way](WayRecord const& w) { return w.scene == way.scene && w.backend == way.backend; };
        judge(broken, way, *std::ranges::find_if(results.ways, is_first));
    }
    for (FitRecord const& fit : results.fits) judge(broken, fit);
    for (FlightRecord const& flight : results.flights) judge(broken, flight);
    return sentences;
}

}  // namespace shadowmath::gallery
