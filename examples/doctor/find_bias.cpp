// SPDX-License-Identifier: MIT
#include "examples/doctor/find.hpp"

#include <shadowmath/bias.hpp>

#include <algorithm>
#include <cmath>

namespace shadowmath::doctor {
namespace {

constexpr double steepest_cosine = 0.17;  // beyond 80 degrees a surface is dark by its shading alone

// All in stored depth.
struct Amounts {
    double have = 0.0;
    double need = 0.0;
    double metre = 0.0;  // what a metre toward the light is worth
};

Amounts amounts(Examination const& e, std::size_t m, Seen const& seen) {
    Case const& read = e.read;
    ShadowMap<double> const& map = e.maps[m];
    int const size = read.frame.maps[m].size;
    glm::dvec3 const to_light = toward(read.frame.light, seen.point);
    DepthSlope<double> const at = slope(map, size, seen.point, seen.normal, 1e6);
    double const x = std::abs(at.x), y = std::abs(at.y);
    double const cosine = glm::dot(seen.normal, to_light), sine = std::sqrt(std::max(0.0, 1.0 - cosine * cosine));
    Amounts amount;
    amount.metre = depth_shift(map, read.frame.light, seen.point, 1e-3) * 1e3;
    // Along the normal by d lifts by d / cosine along the light.
    double const lift = read.bias.normal_texels * texel_at(map, size, seen.point) * sine / cosine;
    amount.have = read.bias.depth + read.bias.slope * std::max(x, y) + lift * amount.metre;
    amount.need = kernel_reach_texels<double>(read.filter_radius) * (x + y);
    return amount;
}

// No caster is nearer to the light than the point by more than `bias`.
bool is_lost(Examination const& e, Seen const& seen, std::size_t m, double bias) {
    return std::ranges::none_of(e.sight.blockers_of(seen), [&](double metres) {
        return depth_shift(e.maps[m], e.read.frame.light, seen.point, metres) >= bias;
    });
}

void find_bias_of(Examination& e, std::size_t m) {
    std::vector<double> have, need, metres, missing, texels;
    int lit = 0, acne = 0, dark = 0, lost = 0, lost_anyway = 0;
    int const size = e.read.frame.maps[m].size;
    for (int const i : e.points[m]) {
        Seen const& seen = e.seen(i);
        if (e.found.places[static_cast<std::size_t>(i)].served != Served::yes || !seen.faces_light) continue;
        if (glm::dot(seen.normal, toward(e.read.frame.light, seen.point)) < steepest_cosine) continue;
        Amounts const amount = amounts(e, m, seen);
        if (!(amount.metre > 0.0)) continue;
        double const texel = texel_at(e.maps[m], size, seen.point);
        metres.push_back(amount.have / amount.metre);
        texels.push_back(amount.have / amount.metre / texel);
        need.push_back(amount.need / amount.metre);
        have.push_back(amount.need / amount.metre / texel);
        if (seen.dark) {
            ++dark;
            lost += is_lost(e, seen, m, amount.have) ? 1 : 0;
            lost_anyway += is_lost(e, seen, m, amount.need) ? 1 : 0;
            continue;
        }
        ++lit;
        if (amount.have >= amount.need * 0.98) continue;
        ++acne;
        missing.push_back((amount.need - amount.have) / amount.metre);
        e.found.acne[static_cast<std::size_t>(i)] = e.read.bias.given;
    }
    MapFigures& figures = e.found.maps[m];
    figures.bias_metres = percentile(metres, 0.5);
    figures.bias_texels = percentile(texels, 0.5);
    figures.needed_metres = percentile(need, 0.95);
    figures.needed_texels = percentile(have, 0.95);
    if (!e.read.bias.given) return;
    if (lit >= 20 && acne > lit / 50) {
        e.fault(
            Ill::bias_small, m,
            "too little bias: " + percent(double(acne) / lit) +
                " of the lit points in it may shadow themselves. A plane there needs up to " +
                digits(figures.needed_metres) + " m, " + digits(figures.needed_texels) +
                " texels, for a kernel of radius " + std::to_string(e.read.filter_radius) + "; it gets " +
                digits(figures.bias_metres) + " m at the median, " + digits(percentile(missing, 0.95)) +
                " m too little where it is least.",
            "add (filter radius + 1/2) times the depth that the receiver gains in a texel, on both axes; or move it "
            "along its normal by sqrt(2) (filter radius + 1/2) texels times the sine of its angle to the light.");
    }
    if (dark >= 20 && lost - lost_anyway > dark / 50) {
        e.fault(
            Ill::bias_large, m,
            "too much bias: " + percent(double(lost) / dark) +
                " of the dark points in it lose their shadow, whose caster is nearer than the bias of " +
                digits(figures.bias_metres) + " m, " + digits(figures.bias_texels) +
                " texels; what planes need would lose " + percent(double(lost_anyway) / dark) + ".",
            "give bias in texels of each map: a constant in stored depth grows with the map's depth range, which is " +
                digits(
                    1.0 /
                    std::max(depth_shift(e.maps[m], e.read.frame.light, e.seen(e.points[m].front()).point, 1e-3) * 1e3,
                             1e-12)) +
                " m here.");
    }
}

}  // namespace

void find_bias(Examination& e) {
    for (std::size_t m = 0; m < e.maps.size(); ++m)
        if (e.sound[m] && !e.points[m].empty()) find_bias_of(e, m);
}

}  // namespace shadowmath::doctor
