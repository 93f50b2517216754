// SPDX-License-Identifier: MIT
//
// Maps instead of options: up to four, put where the picture needs them, found by measuring.
//
//   from a depth buffer   ── what the eye sees, tile by tile ──┐                        ┌─ quad_map ── map 0
//                                                              ├─ parts ── fit_quad ────┼─ quad_map ── map 1
//   from boxes alone      ── what it may see (box_samples) ────┘  (part_search)         └─ ...
//
// Before they are maps, the quadrilaterals move against each other once more (quad_settle.hpp).
//
// Every map of a sun is a homography of the light's plane: a box, a rectangle at any angle, a warp of any strength, a
// view-dependent map. So none of these is a policy here. Each part of the picture gets the quadrilateral whose texels
// look smallest in it, whatever it may be called. Maps come finest first and are looked up by by_map (sampling.hpp): a
// point inside two gets the finer one, and a later map leaves out what an earlier one holds already.
//
// Use it when edges may crawl a little: they move with the camera, as those of all fits to what is seen do. Where
// nothing may, choose.hpp finds options for stable cascades. A search takes milliseconds, not microseconds: at the
// loading of a level, when the camera has gone elsewhere, or on another thread, a frame behind.
//
// Source: none; the parts stand where Lauritzen, Salvi and Lefohn (I3D 2011) have boxes.
#pragma once

#include <shadowmath/bounds.hpp>
#include <shadowmath/box_samples.hpp>
#include <shadowmath/clip_space.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/fault.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/fit_quad.hpp>
#include <shadowmath/judge.hpp>
#include <shadowmath/light.hpp>
#include <shadowmath/light_samples.hpp>
#include <shadowmath/map_rows.hpp>
#include <shadowmath/margin.hpp>
#include <shadowmath/part_search.hpp>
#include <shadowmath/polytope.hpp>
#include <shadowmath/quad_map.hpp>
#include <shadowmath/quad_settle.hpp>
#include <shadowmath/quad_stack.hpp>
#include <shadowmath/shadow_map.hpp>
#include <shadowmath/view_volume.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace shadowmath {
inline namespace v0 {

template <class T>
struct MapLimits {
    Vec2<T> eye_pixels{T(1920), T(1080)};  // the picture that shadows are for
    int maps = 4;                          // at most; 1 to max_chosen_maps
    int map_size = 1024;                   // texels along one side of each
    T margin_texels = T(2);                // free on every side: half the width of the PCF kernel, and one
    ClipSpace clip = gl_clip;              // the convention of the pass that draws the maps
};

// Nearest and farthest eye depth in each of width * height equal tiles of the picture, row by row from its bottom: what
// a renderer's depth pyramid holds, of surfaces within the shadow distance that face the light. A tile where nothing
// is seen has nearest > farthest.
template <class T>
struct DepthTiles {
    T const* nearest = nullptr;
    T const* farthest = nullptr;
    int width = 0;
    int height = 0;
};

// What a map has become, in the words of the other headers.
enum class MapShape : std::uint8_t {
    rectangle,  // at some angle, its texels alike all over
    warp,       // a perspective one: texels grow from one end to the other
    lopsided    // a warp whose sides are not alike, or sheared
};

[[nodiscard]] constexpr char const* describe(MapShape shape) noexcept {
    switch (shape) {
        case MapShape::rectangle: return "a rectangle at the best angle: texels as fine at one end as at the other";
        case MapShape::warp: return "a perspective warp: fine texels where the picture needs them, coarse ones beyond";
        case MapShape::lopsided: return "four free sides: the part is wider, or seen from nearer, at one corner";
    }
    return "no map";
}

template <class T>
struct ChosenMap {
    ShadowMap<T> map;
    ViewPart<T> part;  // of the view that it was made for; it serves whatever else it holds, too
    MapShape shape = MapShape::rectangle;
    T growth = T(1);  // how many times longer a texel is at the coarse end than at the fine one
    int samples = 0;  // of the search, that it serves
    T mean = T(0);    // of their footprints, eye pixels a texel along its longer axis
    T worst = T(0);
};

template <class T>
struct ChosenMaps {
    std::array<ChosenMap<T>, max_chosen_maps> at;
    int count = 0;     // 0: nothing to draw, everything lit
    int tried = 0;     // fits
    T one_map = T(0);  // the price of a sample (price_of) with a single map of this size
    T price = T(0);    // and with those chosen
    Faults faults;

    [[nodiscard]] ChosenMap<T> const* begin() const noexcept { return at.data(); }
    [[nodiscard]] ChosenMap<T> const* end() const noexcept { return at.data() + count; }
};

namespace detail {

// Samples that a candidate is priced by.
inline constexpr int priced_samples = 256;

template <class T>
[[nodiscard]] inline MapShape shape_of(Quad<T> const& quad) noexcept {
    if (quad.w_least > T(0.95)) {
        T const cosine = glm::dot(safe_normalize(Vec3<T>(Vec2<T>(quad.x), T(0))).direction,
                                  safe_normalize(Vec3<T>(Vec2<T>(quad.y), T(0))).direction);
        return std::abs(cosine) < T(0.1) ? MapShape::rectangle : MapShape::lopsided;
    }
    // A warp along one axis leaves w alone along the other.
    T const along_x = std::abs(quad.w.x * quad.y.y - quad.w.y * quad.y.x);
    T const along_y = std::abs(quad.w.x * quad.x.y - quad.w.y * quad.x.x);
    T const lesser = along_x < along_y ? along_x : along_y, greater = along_x < along_y ? along_y : along_x;
    return lesser < T(0.2) * greater ? MapShape::warp : MapShape::lopsided;
}

// `cover(part, visit)` calls visit(points, count) for convex pieces that together hold all that may be seen in the
// part: points in light space, relative to the eye. `bound` as for PartSearch: the same, or quicker and nearly so.
template <class T, class Bound, class Cover>
[[nodiscard]] inline ChosenMaps<T> search_maps(LightSampler<T> const& sampler, Aabb<T> const& casters,
                                               MapLimits<T> const& limits, MapSearch<T>& work, Bound const& bound,
                                               Cover const& cover) noexcept {
    ChosenMaps<T> chosen;
    if (work.count == 0) return chosen;
    PartSearch<T, Bound> search{work, bound, usable_texels(limits.map_size, limits.margin_texels), priced_samples};
    int const most = glm::clamp(limits.maps, 1, max_chosen_maps);
    if (most != limits.maps) chosen.faults |= Fault::count_clamped;
    // Two searches, and the better outcome: what is seen between the samples may cost one of them more.
    QuadStack<T> stack;
    T least = std::numeric_limits<T>::max();
    for (bool const by_depth_alone : {true, false}) {
        PartTree<T> tree = grown(search, most, by_depth_alone);
        chosen.one_map = tree.node[0].fit.price;
        settle(search, tree);
        QuadStack<T> const candidate = stacked(search, tree, cover);
        T const price = price_in(candidate, work, search.usable_texels);
        if (!(price < least)) continue;
        least = price;
        stack = candidate;
    }
    chosen.tried = search.tried;
    stack = settled(work, stack, search.usable_texels, cover, least);

    std::array<Extent<T>, max_chosen_maps> depth = depths_served(stack, cover);
    leave_out_idle(stack, depth);
    for (int k = 0; k < stack.count; ++k) {
        Extent<T> const& along = depth[static_cast<unsigned>(k)];
        Quad<T> const& quad = stack.quad[static_cast<unsigned>(k)];
        ChosenMap<T>& made = chosen.at[static_cast<unsigned>(chosen.count)];
        T const room = T(1e-3) * (along.hi - along.lo) + T(1e-3);
        made.map = quad_map(quad, sampler.basis, sampler.view.pose.position, along.lo - room, along.hi + room, casters,
                            limits.map_size, limits.margin_texels, limits.clip);
        chosen.faults |= made.map.faults;
        if (!made.map.visible) continue;
        made.part = stack.part[static_cast<unsigned>(k)];
        made.shape = shape_of(quad);
        made.growth = T(1) / quad.w_least;
        T sum = T(0);
        for (int i = 0; i < work.count; ++i) {
            LightSample<T> const& sample = work.sample[static_cast<unsigned>(i)];
            if (stack.holder(sample) != k) continue;
            T const major = major_at(quad, search.usable_texels, sample);
            sum += major;
            made.worst = std::fmax(made.worst, major);
            ++made.samples;
        }
        made.mean = made.samples > 0 ? sum / T(made.samples) : T(0);
        ++chosen.count;
    }
    T weight = T(0);
    for (int i = 0; i < work.count; ++i) weight += work.sample[static_cast<unsigned>(i)].weight;
    chosen.one_map /= weight;
    chosen.price = price_in(stack, work, search.usable_texels) / weight;
    return chosen;
}

// At most max_search_samples of the samples, evenly.
template <class T>
inline void take_samples(MapSearch<T>& work, LightSampler<T> const& sampler, SurfacePoint<T> const* samples,
                         int count) noexcept {
    auto const is_asked = [](LightSample<T> const& sample) { return sample.usable && sample.weight > T(0); };
    int asked = 0;
    for (int i = 0; i < count; ++i) asked += is_asked(light_sample(sampler, samples[i])) ? 1 : 0;
    int const stride = (asked + max_search_samples - 1) / max_search_samples;
    int seen = 0;
    work.count = 0;
    for (int i = 0; i < count; ++i) {
        LightSample<T> const sample = light_sample(sampler, samples[i]);
        if (!is_asked(sample)) continue;
        // One of each `stride`, not always the same one: else all might lie in a few columns of the picture.
        if (seen % stride == seen / stride * 7 % stride) work.sample[static_cast<unsigned>(work.count++)] = sample;
        ++seen;
    }
}

// The same of the tiles' own middles, where nothing is known of their surfaces.
template <class T>
inline void take_tiles(MapSearch<T>& work, LightSampler<T> const& sampler, Light<T> const& light,
                       DepthTiles<T> const& tiles) noexcept {
    ViewVolume<T> const& view = sampler.view;
    int const count = tiles.width * tiles.height, stride = (count + max_search_samples - 1) / max_search_samples;
    work.count = 0;
    for (int i = 0; i < count; ++i) {
        T const *const nearest = tiles.nearest + i, *const farthest = tiles.farthest + i;
        if (i % stride != i / stride * 7 % stride || !all_finite(nearest, 1) || !all_finite(farthest, 1)) continue;
        T const depth = glm::clamp(T(0.5) * *nearest + T(0.5) * *farthest, view.z_near, view.z_far);
        if (!(*nearest <= *farthest && *nearest <= view.z_far && *farthest >= view.z_near && depth > T(0))) continue;
        T const x = (T(i % tiles.width) + T(0.5)) / T(tiles.width);
        T const y = (T(i / tiles.width) + T(0.5)) / T(tiles.height);
        Vec3<T> const point =
            point_at(view, view.left + (view.right - view.left) * x, view.bottom + (view.top - view.bottom) * y, depth);
        LightSample<T> sample = light_sample(sampler, {point, neutral_normal(view, light, point)});
        sample.weight = T(1);
        if (sample.usable) work.sample[static_cast<unsigned>(work.count++)] = sample;
    }
}

// Spots have no light's plane.
template <class T>
[[nodiscard]] inline Door<T> door_of_choice(ViewVolume<T> const& view, Light<T> const& light, Aabb<T> const& casters,
                                            MapLimits<T> const& limits) noexcept {
    Door<T> in = door(view, light, casters, casters, limits.map_size, limits.margin_texels);
    bool const pixels = all_finite(limits.eye_pixels) && limits.eye_pixels.x > T(0) && limits.eye_pixels.y > T(0);
    if (light.kind != LightKind::directional || !pixels) in.faults |= Fault::clamped_option;
    in.stop = in.stop || light.kind != LightKind::directional || !pixels;
    return in;
}

}  // namespace detail

// Every point of every tile between its two depths is in one of the maps, with margin_texels to spare on each side, and
// every caster of the box between it and the sun is in that map. `samples`, a surface each from somewhere in a tile,
// only weigh what is worth texels; those turned away from the light count for nothing, and where none is left the tiles
// weigh alike. The same inputs give the same maps. Depths that are no numbers, or not in front of the eye, are no
// tiles; the last are cut at view.z_far.
//
// Not visible, and no fault: no casters, no tiles. A spot is clamped_option, as are pixels <= 0.
template <class T>
[[nodiscard]] inline ChosenMaps<T> choose_maps(ViewVolume<T> const& view, Light<T> const& light, Aabb<T> const& casters,
                                               SurfacePoint<T> const* samples, int sample_count,
                                               DepthTiles<T> const& tiles, MapLimits<T> const& limits,
                                               MapSearch<T>& work) noexcept {
    SHADOWMATH_ASSERT(samples != nullptr || sample_count <= 0, "a choice needs its samples");
    bool const has_tiles = tiles.width > 0 && tiles.height > 0;
    SHADOWMATH_ASSERT(!has_tiles || (tiles.nearest != nullptr && tiles.farthest != nullptr), "tiles need both depths");
    ChosenMaps<T> none;
    Door<T> const in = detail::door_of_choice(view, light, casters, limits);
    none.faults = in.faults;
    if (in.stop || !has_tiles) return none;
    ViewVolume<T> const& eye = in.view;
    LightSampler<T> const sampler =
        light_sampler(eye, in.light, limits.eye_pixels, Vec2<T>(T(tiles.width), T(tiles.height)));
    if (!sampler.usable) return none;
    detail::take_samples(work, sampler, samples, sample_count);
    if (work.count == 0) detail::take_tiles(work, sampler, in.light, tiles);
    Vec3<T> const right = in_light(sampler.basis, eye.pose.right), up = in_light(sampler.basis, eye.pose.up);
    Vec3<T> const forward = in_light(sampler.basis, eye.pose.forward);
    bool const flat = eye.kind == ViewKind::orthographic;
    Vec2<T> const first(eye.left, eye.bottom);
    Vec2<T> const size((eye.right - eye.left) / T(tiles.width), (eye.top - eye.bottom) / T(tiles.height));
    auto const visit_tile = [&](int x, int y, ViewPart<T> const& part, auto const& visit) {
        constexpr T slack = T(1e-5);  // receivers are drawn by another pass than the depths were
        T const* const nearest = tiles.nearest + y * tiles.width + x;
        T const* const farthest = tiles.farthest + y * tiles.width + x;
        if (!all_finite(nearest, 1) || !all_finite(farthest, 1) || !(*nearest <= *farthest)) return;
        Vec2<T> const tile = first + size * Vec2<T>(T(x), T(y));
        Vec3<T> const tile_lo(tile, std::fmax(*nearest * (T(1) - slack), eye.z_near * (T(1) - slack)));
        Vec3<T> const tile_hi(tile + size, std::fmin(*farthest * (T(1) + slack), eye.z_far * (T(1) + slack)));
        Vec3<T> const lo = glm::max(tile_lo, part.lo), hi = glm::min(tile_hi, part.hi);
        if (!(lo.x <= hi.x && lo.y <= hi.y && lo.z <= hi.z && hi.z > T(0))) return;
        std::array<Vec3<T>, 8> points;
        for (unsigned i = 0; i < 8; ++i) {
            T const z = (i & 4u) != 0 ? hi.z : lo.z, spread = flat ? T(1) : z;
            T const side_x = (i & 1u) != 0 ? hi.x : lo.x, side_y = (i & 2u) != 0 ? hi.y : lo.y;
            points[i] = forward * z + (right * side_x + up * side_y) * spread;
        }
        visit(points.data(), 8);
    };
    auto const cover = [&](ViewPart<T> const& part, auto const& visit) {
        for (int y = 0; y < tiles.height; ++y)
            for (int x = 0; x < tiles.width; ++x) visit_tile(x, y, part, visit);
    };
    // To the search the tiles of its samples are all of them.
    auto const bound = [&](ViewPart<T> const& part, int count, Supports<T>& supports) {
        for (int i = 0; i < count; ++i) {
            LightSample<T> const& sample = work.sample[work.list[static_cast<unsigned>(i)]];
            add(supports, sample.place);
            Vec2<T> const tile = (Vec2<T>(sample.seen) - first) / size;
            // One from outside the picture is as good as on its border.
            int const x = static_cast<int>(std::fmin(std::fmax(tile.x, T(0)), T(tiles.width - 1)));
            int const y = static_cast<int>(std::fmin(std::fmax(tile.y, T(0)), T(tiles.height - 1)));
            visit_tile(x, y, part, [&](Vec3<T> const* points, int point_count) {
                for (int k = 0; k < point_count; ++k) add(supports, Vec2<T>(points[k]));
            });
        }
    };
    ChosenMaps<T> chosen = detail::search_maps(sampler, casters, limits, work, bound, cover);
    chosen.faults |= in.faults;
    return chosen;
}

// The same where there is no depth buffer: every point of the boxes that the eye may see, up to view.z_far, is in one
// of the maps, and so is every caster between it and the sun. What is worth texels is guessed (box_samples.hpp). Boxes
// that are empty or not finite are no receivers; large ones are cut to the view.
template <class T>
[[nodiscard]] inline ChosenMaps<T> choose_maps(ViewVolume<T> const& view, Light<T> const& light, Aabb<T> const& casters,
                                               Aabb<T> const* receivers, int receiver_count, MapLimits<T> const& limits,
                                               MapSearch<T>& work) noexcept {
    SHADOWMATH_ASSERT(receivers != nullptr || receiver_count <= 0, "a choice needs its receivers");
    ChosenMaps<T> none;
    Door<T> const in = detail::door_of_choice(view, light, casters, limits);
    none.faults = in.faults;
    if (in.stop) return none;
    ViewVolume<T> const& eye = in.view;
    LightSampler<T> const sampler = light_sampler(eye, in.light, limits.eye_pixels * leaning_surfaces<T>,
                                                  Vec2<T>(T(guess_rays_x), T(guess_rays_y)));
    if (!sampler.usable) return none;
    work.count = guesses_in_boxes(sampler, in.light, receivers, receiver_count, work.sample.data(), max_search_samples);
    auto const cover = [&](ViewPart<T> const& part, auto const& visit) {
        ViewVolume<T> piece = eye;
        piece.left = std::fmax(eye.left, part.lo.x);
        piece.right = std::fmin(eye.right, part.hi.x);
        piece.bottom = std::fmax(eye.bottom, part.lo.y);
        piece.top = std::fmin(eye.top, part.hi.y);
        piece.z_near = std::fmax(eye.z_near, part.lo.z);
        piece.z_far = std::fmin(eye.z_far, part.hi.z);
        if (!(piece.left < piece.right && piece.bottom < piece.top && piece.z_near < piece.z_far)) return;
        T const slack =
            T(16) * std::numeric_limits<T>::epsilon() * (piece.z_far + detail::largest_of(eye.pose.position));
        Aabb<T> around = bounds_of(corners(piece));
        around.lo -= slack;
        around.hi += slack;
        for (int i = 0; i < receiver_count; ++i) {
            if (!all_finite(receivers[i]) || is_empty(intersect(around, receivers[i]))) continue;
            ConvexBody<T> const body = visible_body(piece, receivers[i], slack);
            std::array<Vec3<T>, 2 * max_body_edges> points;
            int count = 0;
            for_each_vertex(
                body, [&](Vec3<T> const& p) { points[static_cast<unsigned>(count++)] = in_light(sampler.basis, p); });
            if (count > 0) visit(points.data(), count);
        }
    };
    auto const bound = [&](ViewPart<T> const& part, int, Supports<T>& supports) {
        cover(part, [&](Vec3<T> const* points, int count) {
            for (int i = 0; i < count; ++i) add(supports, Vec2<T>(points[i]));
        });
    };
    ChosenMaps<T> chosen = detail::search_maps(sampler, casters, limits, work, bound, cover);
    chosen.faults |= in.faults;
    return chosen;
}

}  // namespace v0
}  // namespace shadowmath
