// SPDX-License-Identifier: MIT
//
// Soft shadows: penumbrae, taps, moments and the blend with exact ones, of any map and of any numbers.
#include "tests/fuzz/inputs.hpp"
#include "tests/laws/hfts.hpp"
#include "tests/laws/moments.hpp"
#include "tests/laws/pcss.hpp"
#include "tests/laws/penumbra.hpp"

#include <shadowmath/light_box.hpp>
#include <shadowmath/msm.hpp>
#include <shadowmath/vsm.hpp>

namespace shadowmath::fuzz {
namespace {

template <class T>
ShadowMap<T> sun_map(Case& c, Light<T> const& sun) {
    ShadowMap<T> map;
    map.clip = any_clip(c);
    map.visible = true;
    Vec3<T> const centre = point_within<T>(c, T(100));
    T const half = c.magnitude<T>(-1, 8), depth = c.magnitude<T>(0, 10);
    LightBox<T> const box{light_basis(sun.direction), Vec2<T>(centre.x - half, centre.y - half),
                          Vec2<T>(centre.x + half, centre.y + half), centre.z - depth, centre.z + depth};
    map.clip_from_world = clip_from_world(box, map.clip);
    return map;
}

template <class T>
void try_taps(Case& c) {
    Light<T> const sun = good_sun<T>(c);
    ShadowMap<T> map = sun_map(c, sun);
    int const replaced = c.one_in(2) ? c.below(4) : 0;
    for (int i = 0; i < replaced; ++i) map.clip_from_world[c.below(4)][c.below(4)] = c.number<T>();
    Light<T> const light = c.one_in(3) ? any_light<T>(c) : sun;
    T const radius = c.one_in(2) ? c.number<T>() : c.magnitude<T>(-10, 2);
    MapPenumbra<T> penumbra = c.call([&] { return penumbra_for(map, light, radius); });
    c.require(overflow_unseen || laws::is_harmless(penumbra), "a penumbra is finite");
    c.hash(&penumbra.rim_x.x, 4);
    c.hash(&penumbra.rim_y.x, 4);
    Vec3<T> const point = c.one_in(3) ? any_vector<T>(c) : point_within<T>(c, T(200));
    Vec3<T> const normal = c.one_in(3) ? any_vector<T>(c) : direction<T>(c);
    T const metres = c.number<T>();
    c.require(laws::is_gap(c.call([&] { return gap_of_metres(light, point, metres); })), "a gap is bounded");
    T const back = c.call([&] { return metres_of_gap(light, point, metres); });
    c.require(all_finite(&back, 1) && back >= T(0), "metres of a gap are finite");
    Vec3<T> const any_place = any_vector<T>(c);
    Vec4<T> const place(any_place, c.number<T>());
    c.require(all_finite(kernel_texels(penumbra, place, 1024, metres)), "a kernel has a size");
    for (T* const number : {&penumbra.rim_x.x, &penumbra.rim_y.w, &penumbra.depth_of_gap, &penumbra.largest_gap})
        if (c.one_in(5)) *number = c.number<T>();
    MapBias<T> bias;
    if (c.one_in(2)) bias.constant = c.number<T>();
    if (c.one_in(2)) bias.slope_limit = c.number<T>();
    PcssOptions<T> taps;
    taps.search_taps = c.below(12) - 1;
    taps.filter_taps = c.below(12) - 1;
    if (c.one_in(2)) taps.turn.x = c.number<T>();
    if (c.one_in(2)) taps.turn.y = c.number<T>();
    T const depth = c.number<T>(), other = c.uniform<T>(T(0), T(1));
    auto const stored = [depth, other](int x, int y) { return (x + y) % 2 == 0 ? depth : other; };
    int const size = c.below(300) - 2;
    SoftShadow<T> const soft =
        c.call([&] { return soft_visibility(map, size, point, normal, bias, penumbra, taps, stored); });
    c.require(laws::is_soft_shadow(soft), "a soft shadow is a share of light and a gap");
    c.hash(&soft.visibility, 1);
    ExactShadow<T> const exact{c.number<T>(), c.number<T>()};
    SoftShadow<T> const any{c.number<T>(), c.number<T>(), c.one_in(2)};
    for (SoftShadow<T> const& one : {soft, any}) {
        T const mixed = c.call([&] { return hybrid_visibility(exact, one, metres); });
        c.require(all_finite(&mixed, 1) && mixed >= T(0) && mixed <= T(1), "a blend is a share of light");
    }
    T const hard = c.uniform<T>(T(0), T(1)), share = c.uniform<T>(T(0), T(1));
    ExactShadow<T> const traced{hard, c.magnitude<T>(-10, 10)};
    SoftShadow<T> const searched{share, c.magnitude<T>(-10, 10), true};
    T const blend = hybrid_visibility(traced, searched, c.magnitude<T>(-10, 7));
    c.require(laws::is_between(blend, hard, share, T(8) * std::numeric_limits<T>::epsilon()),
              "a blend lies between its two answers");
}

// A sun's penumbra is where plain geometry puts it.
void try_rays(Case& c) {
    Light<double> const sun = good_sun<double>(c);
    ShadowMap<double> const map = sun_map(c, sun);
    Vec3<double> const point = point_within<double>(c, 100.0);
    double const radius = c.magnitude<double>(-10, -2), gap = c.magnitude<double>(-10, 3);
    Vec2<double> const u{c.uniform<double>(-0.7, 0.7), c.uniform<double>(-0.7, 0.7)};
    MapPenumbra<double> const penumbra = c.calm_call([&] { return penumbra_for(map, sun, radius); });
    Vec4<double> tap = across(penumbra, place_from_world(map) * Vec4<double>(point, 1.0), u, gap);
    tap.z -= gap * penumbra.depth_of_gap;
    auto const truth = laws::place_of(map, laws::toward_disk(sun, radius, point, u, gap));
    // Offsets of up to 200 half extents, a dozen roundings.
    c.require(laws::apart(Vec4<long double>(tap), truth) <= 1e-10L, "a tap lies on the ray to its part of the light");
}

template <class T>
void try_moments(Case& c) {
    laws::Kernel kernel;
    int const count = 1 + c.below(6);
    double sum = 0;
    bool const in_quarters = c.one_in(3);
    for (int i = 0; i < count; ++i) {
        double const depth = c.uniform<double>(0.0, 1.0);
        kernel.depth.push_back(in_quarters ? std::round(depth * 4) / 4 : depth);
        kernel.weight.push_back(c.uniform<double>(0.01, 1.0));
        sum += kernel.weight.back();
    }
    for (double& weight : kernel.weight) weight /= sum;
    T const receiver = c.one_in(5) ? static_cast<T>(kernel.depth.front()) : c.uniform<T>(T(0), T(1));
    EvsmExponents<T> warp{c.uniform<T>(T(0.5), T(10)), c.uniform<T>(T(0.5), T(10))};
    double const truth = kernel.lit(receiver), eps = std::numeric_limits<T>::epsilon();
    Vec2<T> const vsm = kernel.mean<T>(vsm_moments<T>);
    Vec4<T> const evsm = kernel.mean<T>([&warp](T depth) { return evsm_moments(depth, warp); });
    Vec4<T> const msm = kernel.mean<T>(msm_moments<T>);
    // See the property of the same name for what rounding costs.
    T const deviation = T(0.01), bias = sizeof(T) == 4 ? msm_bias_float<T> : T(1e-9);
    double const lost = 24 * eps + 6 * eps / 1e-4;
    double const by_two = c.calm_call([&] { return vsm_visibility(vsm, receiver, deviation); });
    double const warped = c.calm_call([&] { return evsm_visibility(evsm, receiver, warp, deviation); });
    double const by_four = c.calm_call([&] { return msm_visibility(msm, receiver, bias); });
    c.hash(&by_two, 1);
    c.hash(&by_four, 1);
    c.require(by_two >= truth - lost && warped >= truth - lost, "two moments are never darker than the kernel");
    c.require(by_four >= (1 - static_cast<double>(bias)) * truth - 64 * eps,
              "four moments are never darker than the kernel");
    T const a = c.number<T>(), b = c.number<T>();
    Vec4<T> const any(any_vector<T>(c), a);
    warp = {c.number<T>(), c.number<T>()};
    for (T const share : {c.call([&] { return vsm_visibility(Vec2<T>(any), a, b); }),
                          c.call([&] { return evsm_visibility(any, b, warp, a); }),
                          c.call([&] { return msm_visibility(any, b, a); }), less_bleeding(a, b)})
        c.require(fast_math || laws::is_share_of_light(share), "moments of anything are a share of light");
    c.require(all_finite(vsm_moments(a)) && all_finite(msm_packed(msm_moments(a))) && all_finite(evsm_moments(a, warp)),
              "moments are finite");
}

template <class T>
void try_soft(Case& c) {
    switch (c.below(3)) {
        case 0: return try_taps<T>(c);
        case 1: return try_rays(c);
        default: return try_moments<T>(c);
    }
}

[[maybe_unused]] bool const soft_target =
    add_target("soft", [](Case& c) { c.one_in(2) ? try_soft<float>(c) : try_soft<double>(c); });

}  // namespace
}  // namespace shadowmath::fuzz
