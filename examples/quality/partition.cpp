// SPDX-License-Identifier: MIT
#include "examples/quality/partition.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace shadowmath::quality {
namespace {

constexpr std::size_t features = 7;
using Feature = std::array<double, features>;

Feature features_of(LightPixel const& p) {
    // The direction in which a texel looks longest, and how much longer than wide.
    double const a = glm::dot(p.gain_x, p.gain_x), b = glm::dot(p.gain_x, p.gain_y), c = glm::dot(p.gain_y, p.gain_y);
    double const twice = std::atan2(2.0 * b, a - c);
    double const det = std::abs(p.gain_x.x * p.gain_y.y - p.gain_x.y * p.gain_y.x);
    double const ratio = std::log((a + c) / std::max(det, 1e-12));
    Feature at{p.seen.x, p.seen.y, std::log(p.seen.z)};
    at[3] = std::cos(twice) * ratio;
    at[4] = std::sin(twice) * ratio;
    at[5] = ratio;
    at[6] = std::log(a + c);
    return at;
}

Feature drawn_scale(Random& random) {
    Feature scale{};
    for (double& one : scale) one = uniform(random) < 0.5 ? 0.0 : uniform(random);
    if (std::ranges::all_of(scale, [](double s) { return s == 0.0; })) scale[2] = 1.0;
    return scale;
}

// Each feature with mean 0 and deviation `scale`.
std::vector<Feature> normalised(std::vector<Sample> const& samples, Feature const& scale) {
    std::vector<Feature> at(samples.size());
    Feature mean{}, deviation{};
    for (std::size_t i = 0; i < samples.size(); ++i) {
        at[i] = features_of(samples[i].pixel);
        for (std::size_t f = 0; f < features; ++f) mean[f] += at[i][f] / double(samples.size());
    }
    for (Feature const& one : at)
        for (std::size_t f = 0; f < features; ++f)
            deviation[f] += (one[f] - mean[f]) * (one[f] - mean[f]) / double(samples.size());
    for (Feature& one : at)
        for (std::size_t f = 0; f < features; ++f)
            one[f] = scale[f] * (one[f] - mean[f]) / std::sqrt(std::max(deviation[f], 1e-12));
    return at;
}

}  // namespace

std::vector<std::size_t> drawn_partition(std::vector<Sample> const& samples, std::size_t parts, Random& random) {
    std::vector<Feature> const at = normalised(samples, drawn_scale(random));
    std::vector<Feature> centre(parts);  // k-means from here on
    for (Feature& one : centre) one = at[random() % at.size()];
    std::vector<std::size_t> of(samples.size(), 0);
    for (int round = 0; round < 12; ++round) {
        std::vector<Feature> sum(parts, Feature{});
        std::vector<double> count(parts, 0.0);
        for (std::size_t i = 0; i < at.size(); ++i) {
            double nearest = outside;
            for (std::size_t k = 0; k < parts; ++k) {
                double distance = 0.0;
                for (std::size_t f = 0; f < features; ++f)
                    distance += (at[i][f] - centre[k][f]) * (at[i][f] - centre[k][f]);
                if (distance < nearest) nearest = distance, of[i] = k;
            }
            count[of[i]] += 1.0;
            for (std::size_t f = 0; f < features; ++f) sum[of[i]][f] += at[i][f];
        }
        for (std::size_t k = 0; k < parts; ++k)
            for (std::size_t f = 0; f < features; ++f)
                if (count[k] > 0.0) centre[k][f] = sum[k][f] / count[k];
    }
    return of;
}

}  // namespace shadowmath::quality
