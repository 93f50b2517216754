// SPDX-License-Identifier: MIT
//
// The version, once: the build reads these three lines too.
#pragma once

#define SHADOWMATH_VERSION_MAJOR 0
#define SHADOWMATH_VERSION_MINOR 1
#define SHADOWMATH_VERSION_PATCH 0
