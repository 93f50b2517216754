// SPDX-License-Identifier: MIT
//
// Exact hard shadows on the CPU: the irregular z-buffer and frustum tracing, in the order in which data flows.
#pragma once

#include <shadowmath/irregular/microquad.hpp>

#include <shadowmath/irregular/edge.hpp>
#include <shadowmath/irregular/lanes.hpp>
#include <shadowmath/irregular/mask.hpp>
#include <shadowmath/irregular/plain_lanes.hpp>
#include <shadowmath/irregular/x86_lanes.hpp>

#include <shadowmath/irregular/buffer.hpp>
#include <shadowmath/irregular/grid.hpp>
#include <shadowmath/irregular/lists.hpp>
#include <shadowmath/irregular/tile.hpp>

#include <shadowmath/irregular/casters.hpp>
#include <shadowmath/irregular/chunk.hpp>
#include <shadowmath/irregular/cover.hpp>
#include <shadowmath/irregular/trace.hpp>

#include <shadowmath/irregular/gpu.hpp>
