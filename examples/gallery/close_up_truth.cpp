// SPDX-License-Identifier: MIT
#include "examples/gallery/close_up_truth.hpp"

#include "oracle/area_light.hpp"

#include <shadowmath/irregular.hpp>

#include <glm/geometric.hpp>

#include <algorithm>
#include <thread>

namespace shadowmath::gallery {
namespace {

// One asked pixel's samples and the rays from them.
class SampleRays {
public:
    SampleRays(CloseUpPicture const& picture, backend::Scene const& scene, oracle::RayOracle const& oracle,
               ExactShadows const& margins)
        : picture_(picture), scene_(scene), oracle_(oracle), frame_(frame_in<double>(picture.frame)),
          margins_(margins) {}

    [[nodiscard]] MicroQuad<double> quad(std::size_t pixel) const {
        return micro_quad(frame_, column(pixel), row(pixel), double(picture_.depth[pixel]),
                          glm::dvec3(picture_.normal[pixel]));
    }
    [[nodiscard]] glm::dvec3 sample(MicroQuad<double> const& quad, std::size_t pixel, int k) const {
        return point_on(frame_, quad, column(pixel), row(pixel), pixel_samples<double>.u[k],
                        pixel_samples<double>.v[k]);
    }

    // Looks on behind hits in contact.
    [[nodiscard]] bool dark(glm::dvec3 sample, double depth) const {
        glm::dvec3 const way = -picture_.light.direction;
        double const rounding = 0x1p-22 * (1.0 + glm::length(sample));
        double begun = 0.0;
        for (int looks = 0; looks < 16; ++looks) {
            auto const hit = oracle_.first_hit(sample + way * begun, way);
            if (!hit) return false;
            if (!in_contact(sample, depth, hit->triangle)) return true;
            begun += hit->distance + rounding;
        }
        return false;
    }

private:
    [[nodiscard]] int column(std::size_t pixel) const { return int(pixel % std::size_t(picture_.extent.width)); }
    [[nodiscard]] int row(std::size_t pixel) const { return int(pixel / std::size_t(picture_.extent.width)); }

    // The margin of irregular/trace.hpp, in double.
    [[nodiscard]] bool in_contact(glm::dvec3 sample, double depth, std::uint32_t triangle) const {
        glm::dvec3 corner[3];
        double reach = 0.0;
        for (std::size_t i = 0; i < 3; ++i) {
            corner[i] = glm::dvec3(scene_.vertices[scene_.indices[3 * std::size_t{triangle} + i]].position);
            glm::dvec3 const r = glm::abs(corner[i] - frame_.eye);
            reach = std::max(reach, r.x + r.y + r.z);
        }
        glm::dvec3 n = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
        double const length = glm::length(n);
        if (!(length > 0.0)) return true;
        n *= (glm::dot(n, picture_.light.direction) < 0.0 ? -1.0 : 1.0) / length;
        double const weight = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
        double const metres = 1.0 + margins_.contact_reach + reach + margins_.contact_ray * depth;
        return glm::dot(n, sample - corner[0]) < weight * contact_share<double> * metres;
    }

    CloseUpPicture const& picture_;
    backend::Scene const& scene_;
    oracle::RayOracle const& oracle_;
    PixelFrame<double> frame_;
    ExactShadows const& margins_;
};

template <class Work>
void over_pixels(std::size_t count, Work const& work) {
    std::size_t const threads = std::clamp(std::thread::hardware_concurrency(), 1u, 8u);
    std::vector<std::thread> running;
    for (std::size_t t = 0; t < threads; ++t)
        running.emplace_back([&work, t, threads, count] {
            for (std::size_t i = t; i < count; i += threads) work(i);
        });
    for (std::thread& thread : running) thread.join();
}

// Dark all over, or lit all over, and so are the pixels around.
bool clear_of_edges(CloseUpTruth const& truth, CloseUpPicture const& picture, std::size_t pixel) {
    std::uint32_t const own = truth.dark[pixel];
    if (own != 0 && own != every_sample) return false;
    int const width = picture.extent.width, x = int(pixel) % width, y = int(pixel) / width;
    for (int j = std::max(y - 1, 0); j <= std::min(y + 1, picture.extent.height - 1); ++j)
        for (int i = std::max(x - 1, 0); i <= std::min(x + 1, width - 1); ++i) {
            std::size_t const beside = std::size_t(j) * std::size_t(width) + std::size_t(i);
            if (picture.shows(beside) && truth.dark[beside] != own) return false;
        }
    return true;
}

}  // namespace

CloseUpTruth close_up_truth(CloseUpPicture const& picture, backend::Scene const& scene, oracle::RayOracle const& oracle,
                            ExactShadows const& margins, double sun_radius, int rays) {
    CloseUpTruth truth;
    truth.dark.assign(picture.size(), 0);
    truth.soft.assign(picture.size(), 1.0f);
    truth.asked.assign(picture.size(), 0);
    truth.off_edge.assign(picture.size(), 0);
    SampleRays const samples(picture, scene, oracle, margins);
    glm::dvec3 const to_light = -picture.light.direction;
    std::vector<glm::dvec4> sun;
    for (int k = 0; k < rays; ++k)
        sun.push_back(oracle::point_of({glm::dvec4(to_light, 0.0), to_light, sun_radius}, k, rays));
    over_pixels(picture.size(), [&](std::size_t pixel) {
        if (!picture.shows(pixel)) return;
        if (!picture.faces_light(pixel)) {
            truth.dark[pixel] = every_sample;
            truth.soft[pixel] = 0.0f;
            return;
        }
        truth.asked[pixel] = 1;
        MicroQuad<double> const quad = samples.quad(pixel);
        glm::dvec3 at[samples_per_pixel];
        for (int k = 0; k < samples_per_pixel; ++k) {
            at[k] = samples.sample(quad, pixel, k);
            if (samples.dark(at[k], double(picture.depth[pixel]))) truth.dark[pixel] |= 1u << k;
        }
        int seen = 0;
        glm::dvec3 const normal(picture.normal[pixel]);
        for (int k = 0; k < rays; ++k)
            seen += oracle.lit(at[k % samples_per_pixel], normal, sun[std::size_t(k)]) ? 1 : 0;
        truth.soft[pixel] = float(seen) / float(rays);
    });
    truth.lit = lit_shares(truth.dark);
    for (std::size_t i = 0; i < picture.size(); ++i)
        truth.off_edge[i] = truth.asked[i] != 0 && clear_of_edges(truth, picture, i) ? 1 : 0;
    return truth;
}

}  // namespace shadowmath::gallery
