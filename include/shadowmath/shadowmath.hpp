// SPDX-License-Identifier: MIT
//
// Everything, in the order in which data flows through it.
#pragma once

#include <shadowmath/version.hpp>

// The ground.
#include <shadowmath/bounds.hpp>
#include <shadowmath/clip_space.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/fault.hpp>
#include <shadowmath/finite.hpp>
#include <shadowmath/shadow_map.hpp>

// What the user has.
#include <shadowmath/light.hpp>
#include <shadowmath/view_volume.hpp>

// Where along the view.
#include <shadowmath/slice.hpp>
#include <shadowmath/slices.hpp>
#include <shadowmath/slices_in_scene.hpp>
#include <shadowmath/slices_of_views.hpp>
#include <shadowmath/splits.hpp>

// How to look from the light.
#include <shadowmath/depth_range.hpp>
#include <shadowmath/fit_box.hpp>
#include <shadowmath/fit_crop.hpp>
#include <shadowmath/fit_cube.hpp>
#include <shadowmath/fit_focus.hpp>
#include <shadowmath/fit_rectangle.hpp>
#include <shadowmath/fit_sphere.hpp>
#include <shadowmath/light_box.hpp>
#include <shadowmath/margin.hpp>
#include <shadowmath/polytope.hpp>
#include <shadowmath/sweep.hpp>

// Other ways to look.
#include <shadowmath/map_rows.hpp>
#include <shadowmath/plane_choice.hpp>
#include <shadowmath/plane_set.hpp>
#include <shadowmath/points.hpp>
#include <shadowmath/slice_warps.hpp>
#include <shadowmath/vdsm.hpp>
#include <shadowmath/warp.hpp>

// Stillness; translate and scale.
#include <shadowmath/clipmap.hpp>
#include <shadowmath/projected_bounds.hpp>
#include <shadowmath/region.hpp>
#include <shadowmath/schedule.hpp>
#include <shadowmath/scroll.hpp>
#include <shadowmath/texel_grid.hpp>

// What a matrix is worth, and needs.
#include <shadowmath/aliasing.hpp>
#include <shadowmath/bias.hpp>
#include <shadowmath/by_footprint.hpp>
#include <shadowmath/culling.hpp>
#include <shadowmath/footprint.hpp>
#include <shadowmath/map_ray.hpp>
#include <shadowmath/stillness.hpp>
#include <shadowmath/tangent.hpp>

// The one call.
#include <shadowmath/cascade.hpp>
#include <shadowmath/cascades.hpp>

// Which options.
#include <shadowmath/choose.hpp>
#include <shadowmath/judge.hpp>

// Which maps.
#include <shadowmath/box_samples.hpp>
#include <shadowmath/choose_maps.hpp>
#include <shadowmath/fit_quad.hpp>
#include <shadowmath/light_samples.hpp>
#include <shadowmath/part_search.hpp>
#include <shadowmath/quad_map.hpp>
#include <shadowmath/quad_settle.hpp>
#include <shadowmath/quad_stack.hpp>

// The same for what is seen, pixel by pixel.
#include <shadowmath/sample_bounds.hpp>
#include <shadowmath/sample_depths.hpp>
#include <shadowmath/sdsm.hpp>
#include <shadowmath/stored_depth.hpp>

// What the shader does, on the CPU.
#include <shadowmath/filter.hpp>
#include <shadowmath/hfts.hpp>
#include <shadowmath/moments.hpp>
#include <shadowmath/msm.hpp>
#include <shadowmath/pcss.hpp>
#include <shadowmath/penumbra.hpp>
#include <shadowmath/sampling.hpp>
#include <shadowmath/vsm.hpp>

// And what it reads.
#include <shadowmath/gpu.hpp>
#include <shadowmath/gpu_samples.hpp>

// Exact hard shadows.
#include <shadowmath/irregular.hpp>
