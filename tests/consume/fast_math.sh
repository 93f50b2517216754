#!/bin/sh
# SPDX-License-Identifier: MIT
#
# fast_math.sh COMPILER TREE GENERATED: every header and every function under -ffast-math, without a warning. The newest
# clang warns where a header so much as names infinity.
set -eu
compiler=$1 tree=$2 generated=$3
command -v "$compiler" > /dev/null || { printf 'SKIPPED: there is no %s here\n' "$compiler"; exit 77; }
printf '#include "tests/compile/every_function.hpp"\n' |
    "$compiler" -std=c++17 -ffast-math -Wall -Wextra -Werror -fsyntax-only -x c++ "-I$tree/include" "-I$tree" \
        "-I$generated" -
