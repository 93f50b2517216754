#!/bin/sh
# SPDX-License-Identifier: MIT
#
# module.sh COMPILER TREE GENERATED: builds modules/shadowmath.cppm, and two units of one program: one imports the
# module, instantiates every public function through it and takes the fingerprint of tests/compile/, the other takes the
# same fingerprint through the headers. Both must find the same bits.
set -eu
compiler=$1 tree=$2 generated=$3
command -v "$compiler" > /dev/null || { printf 'SKIPPED: there is no %s here\n' "$compiler"; exit 77; }
folder=module
rm -rf "$folder"
mkdir -p "$folder/imported"
: > "$folder/imported/every_header.hpp" # nothing: whatever is used must come from the module
cat > "$folder/imports.cpp" << 'END'
#include <glm/glm.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>

import shadowmath;

#include "tests/compile/every_function.hpp"
#include "tests/compile/fingerprint.hpp"
Fingerprint imported() {
    return fingerprint();
}
int instantiated() {
    return shadowmath::compile::every_function<float>() + shadowmath::compile::every_function<double>();
}
int maps_in(shadowmath::Cascades<float> const& cascades) {
    return cascades.count;
}
END
cat > "$folder/includes.cpp" << 'END'
#include "tests/compile/fingerprint.hpp"

#include <cstdio>
Fingerprint imported();
int instantiated();
int maps_in(shadowmath::Cascades<float> const& cascades);
int main() {
    shadowmath::Cascades<float> cascades;
    cascades.count = 3;
    bool const alike = imported() == fingerprint() && maps_in(cascades) == 3 && instantiated() > 0;
    std::printf(alike ? "The same bits through the module as through the headers.\n" : "Not the same bits\n");
    return alike ? 0 : 1;
}
END
set -- "$compiler" -std=c++20 -Wall -Wextra -Werror "-I$tree/include" "-I$tree"
"$@" -x c++-module "$tree/modules/shadowmath.cppm" --precompile -o "$folder/shadowmath.pcm"
"$compiler" -std=c++20 -c "$folder/shadowmath.pcm" -o "$folder/module.o"
"$@" "-I$folder/imported" "-fmodule-file=shadowmath=$folder/shadowmath.pcm" -c "$folder/imports.cpp" \
    -o "$folder/imports.o"
"$@" "-I$generated" -c "$folder/includes.cpp" -o "$folder/includes.o"
"$@" "$folder/imports.o" "$folder/includes.o" "$folder/module.o" -o "$folder/program"
"$folder/program"
