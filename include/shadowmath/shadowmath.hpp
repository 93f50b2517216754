// SPDX-License-Identifier: MIT
//
// Everything, in the order in which data flows through it.
#pragma once

#include <shadowmath/version.hpp>

#include <shadowmath/bounds.hpp>
#include <shadowmath/clip_space.hpp>
#include <shadowmath/config.hpp>
#include <shadowmath/fault.hpp>
#include <shadowmath/finite.hpp>

#include <shadowmath/light.hpp>
#include <shadowmath/view_volume.hpp>

#include <shadowmath/slice.hpp>
#include <shadowmath/splits.hpp>

#include <shadowmath/depth_range.hpp>
#include <shadowmath/fit_box.hpp>
#include <shadowmath/fit_crop.hpp>
#include <shadowmath/fit_sphere.hpp>
#include <shadowmath/light_box.hpp>

#include <shadowmath/vdsm.hpp>
#include <shadowmath/warp.hpp>

#include <shadowmath/region.hpp>
#include <shadowmath/texel_grid.hpp>

#include <shadowmath/bias.hpp>
#include <shadowmath/footprint.hpp>

#include <shadowmath/cascades.hpp>
#include <shadowmath/shadow_map.hpp>

#include <shadowmath/filter.hpp>
#include <shadowmath/sampling.hpp>
