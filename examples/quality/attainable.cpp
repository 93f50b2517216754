// SPDX-License-Identifier: MIT
#include "examples/quality/attainable.hpp"

#include "examples/quality/partition.hpp"
#include "examples/quality/quad_corners.hpp"

#include <shadowmath/footprint.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace shadowmath::quality {
namespace {

class Search {
public:
    Search(std::vector<LightPixel> const& pixels, std::vector<Quad<double>> const& given, Aim aim, int maps,
           double usable_texels, SearchEffort const& effort)
        : aim_(aim), maps_(std::size_t(maps)), usable_(usable_texels), effort_(effort), random_(effort.seed) {
        take(pixels, given);
    }

    std::vector<Quad<double>> run(std::vector<Quad<double>> const& given) {
        double least = outside;
        std::vector<Quad<double>> best;
        auto const keep = [&] {
            if (!(value_ < least)) return;
            least = value_;
            best = quads_;
        };
        if (!given.empty() && start_from(given)) {
            keep();
            anneal();
            keep();
        }
        for (int restart = 0; restart < effort_.restarts; ++restart) {
            if (!start_at_random()) continue;
            anneal();
            keep();
        }
        return best;
    }

private:
    // The mean is made by few pixels, so these are drawn the more often: a half of all evenly, a quarter by what they
    // cost in the given maps, and a quarter by what they would in a map alike all over.
    void take(std::vector<LightPixel> const& pixels, std::vector<Quad<double>> const& given) {
        std::vector<double> cost(pixels.size(), 1.0), even(pixels.size(), 1.0);
        for (std::size_t i = 0; i < pixels.size() && aim_ == Aim::mean; ++i) {
            LightPixel const& p = pixels[i];
            double least = outside;
            for (Quad<double> const& quad : given) least = std::min(least, major_in(quad, usable_, p));
            if (least < outside) cost[i] = least;
            double const longest = std::sqrt(glm::dot(p.gain_x, p.gain_x) + glm::dot(p.gain_y, p.gain_y));
            even[i] = std::min(longest, footprint_limit<double>);
        }
        double sum = 0.0, even_sum = 0.0;
        for (double const one : cost) sum += one;
        for (double const one : even) even_sum += one;
        double const count = double(pixels.size()), wanted = double(effort_.samples);
        if (count == 0.0) return;
        double carried = uniform(random_);
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            double const expected =
                std::min(1.0, wanted * (0.5 / count + 0.25 * cost[i] / sum + 0.25 * even[i] / even_sum));
            carried += expected;
            if (carried < 1.0) continue;
            carried -= 1.0;
            samples_.push_back({pixels[i], 1.0 / expected});
        }
        total_ = 0.0;
        for (Sample const& sample : samples_) total_ += sample.weight;
        // What lies on the rim of all pixels must be inside, too: the far ones in 32 directions weigh nothing.
        for (int k = 0; k < 32; ++k) {
            glm::dvec2 const d(std::cos(0.19634954 * k), std::sin(0.19634954 * k));
            auto const far =
                std::ranges::max_element(pixels, {}, [&](LightPixel const& pixel) { return glm::dot(pixel.place, d); });
            samples_.push_back({*far, 0.0});
        }
    }

    double value_of(std::vector<double> const& major) {
        if (aim_ == Aim::p95) {
            sorted_.clear();
            for (std::size_t i = 0; i < samples_.size(); ++i) {
                if (!(major[i] < outside)) return outside;
                if (samples_[i].weight > 0.0) sorted_.push_back(major[i]);
            }
            auto const at = sorted_.begin() + std::ptrdiff_t(0.95 * double(sorted_.size() - 1));
            std::ranges::nth_element(sorted_, at);
            // Percentiles alone have plateaus: a little of the mean of what lies below shows the way.
            double sum = 0.0;
            for (auto it = sorted_.begin(); it != at; ++it) sum += *it;
            return *at + 0.05 * sum / double(sorted_.size());
        }
        double sum = 0.0;
        for (std::size_t i = 0; i < samples_.size(); ++i) {
            if (!(major[i] < outside)) return outside;
            sum += samples_[i].weight * major[i];
        }
        return sum / total_;
    }

    void judge_map(Quad<double> const& quad, std::vector<double>& into) const {
        for (std::size_t i = 0; i < samples_.size(); ++i) into[i] = major_in(quad, usable_, samples_[i].pixel);
    }

    bool settle() {
        if (quads_.empty()) return false;
        majors_.assign(quads_.size(), std::vector<double>(samples_.size()));
        for (std::size_t k = 0; k < quads_.size(); ++k) judge_map(quads_[k], majors_[k]);
        least_.assign(samples_.size(), outside);
        for (auto const& majors : majors_)
            for (std::size_t i = 0; i < majors.size(); ++i) least_[i] = std::min(least_[i], majors[i]);
        value_ = value_of(least_);
        return value_ < outside;
    }

    bool start_from(std::vector<Quad<double>> const& given) {
        quads_ = given;
        quads_.resize(std::min(quads_.size(), maps_));
        corners_.clear();
        for (Quad<double>& quad : quads_) {
            // A little larger: their sides touch the samples, and rounding may put one outside.
            glm::dvec2 const middle = (quad.corner[0] + quad.corner[1] + quad.corner[2] + quad.corner[3]) / 4.0;
            Corners corners{};
            for (std::size_t i = 0; i < 4; ++i) corners[i] = middle + (quad.corner[i] - middle) * 1.01;
            corners_.push_back(corners);
            quad = quad_through(corners);
            if (!quad.visible) return false;
        }
        cover();
        return settle();
    }

    // Grows the largest map around all samples that no other holds.
    void cover() {
        std::vector<std::size_t> lost;
        for (std::size_t i = 0; i < samples_.size(); ++i) {
            bool held = false;
            for (Quad<double> const& quad : quads_) held = held || major_in(quad, usable_, samples_[i].pixel) < outside;
            if (!held) lost.push_back(i);
        }
        if (lost.empty()) return;
        std::size_t largest = 0;
        for (std::size_t k = 1; k < quads_.size(); ++k)
            if (area(quads_[k]) > area(quads_[largest])) largest = k;
        for (std::size_t i = 0; i < samples_.size(); ++i)
            if (major_in(quads_[largest], usable_, samples_[i].pixel) < outside) lost.push_back(i);
        corners_[largest] = rectangle_around(samples_, lost, usable_);
        quads_[largest] = quad_through(corners_[largest]);
    }

    bool start_at_random() {
        std::vector<std::size_t> const of = drawn_partition(samples_, maps_, random_);
        corners_.clear();
        quads_.clear();
        for (std::size_t k = 0; k < maps_; ++k) {
            std::vector<std::size_t> own;
            for (std::size_t i = 0; i < of.size(); ++i)
                if (of[i] == k) own.push_back(i);
            if (own.empty()) own.push_back(random_() % of.size());
            Corners const corners = rectangle_around(samples_, own, usable_);
            Quad<double> const quad = quad_through(corners);
            if (!quad.visible) return false;
            corners_.push_back(corners);
            quads_.push_back(quad);
        }
        return settle();
    }

    void anneal() {
        std::vector<double> tried(samples_.size()), least(samples_.size());
        std::vector<Quad<double>> best = quads_;
        std::vector<Corners> best_corners = corners_;
        double best_value = value_;
        for (int step = 0; step < effort_.steps; ++step) {
            double const progress = double(step) / double(effort_.steps);
            double const heat = 0.03 * (1.0 - progress) * (1.0 - progress);
            std::size_t const k = random_() % quads_.size();
            double const size = std::exp(-1.0 - 8.0 * uniform(random_));
            Corners const corners = moved_at_random(corners_[k], size, random_);
            Quad<double> const quad = quad_through(corners);
            if (!quad.visible) continue;
            judge_map(quad, tried);
            bool held = true;
            for (std::size_t i = 0; i < samples_.size(); ++i) {
                double one = tried[i];
                for (std::size_t other = 0; other < quads_.size(); ++other)
                    if (other != k) one = std::min(one, majors_[other][i]);
                least[i] = one;
                if (!(one < outside)) {
                    held = false;
                    break;
                }
            }
            if (!held) continue;
            double const value = value_of(least);
            bool const take =
                value < value_ || (heat > 0.0 && uniform(random_) < std::exp((value_ - value) / (heat * value_)));
            if (!take) continue;
            corners_[k] = corners;
            quads_[k] = quad;
            majors_[k] = tried;
            value_ = value;
            if (value < best_value) {
                best_value = value;
                best = quads_;
                best_corners = corners_;
            }
        }
        quads_ = best;
        corners_ = best_corners;
        value_ = best_value;
    }

    Aim aim_;
    std::size_t maps_;
    double usable_;
    SearchEffort effort_;
    Random random_;
    std::vector<Sample> samples_;
    double total_ = 0.0;
    std::vector<Corners> corners_;
    std::vector<Quad<double>> quads_;
    std::vector<std::vector<double>> majors_;
    std::vector<double> least_, sorted_;
    double value_ = outside;
};

}  // namespace

Found measured(std::vector<LightPixel> const& pixels, std::vector<Quad<double>> const& maps, double usable_texels) {
    Found found;
    found.maps = maps;
    std::vector<double> majors;
    for (LightPixel const& pixel : pixels) {
        double least = outside;
        for (Quad<double> const& quad : maps) least = std::min(least, major_in(quad, usable_texels, pixel));
        if (least < outside) majors.push_back(least);
    }
    if (majors.empty()) return found;
    for (double const major : majors) found.mean += major / double(majors.size());
    auto const at = majors.begin() + std::ptrdiff_t(0.95 * double(majors.size() - 1));
    std::ranges::nth_element(majors, at);
    found.p95 = *at;
    found.unmapped = 1.0 - double(majors.size()) / double(pixels.size());
    return found;
}

Found searched(std::vector<LightPixel> const& pixels, std::vector<Quad<double>> const& given, Aim aim, int maps,
               double usable_texels, SearchEffort const& effort) {
    if (pixels.empty()) return {};
    std::vector<Quad<double>> found = Search(pixels, given, aim, maps, usable_texels, effort).run(given);
    std::ranges::sort(found, {}, [](Quad<double> const& quad) { return area(quad); });
    return measured(pixels, found, usable_texels);
}

}  // namespace shadowmath::quality
