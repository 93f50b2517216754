#!/bin/sh
# SPDX-License-Identifier: MIT
#
# clashing_glm.sh COMPILER TREE GENERATED: the units of tests/compile/ that set GLM's macros in opposite ways, in one
# program, linked in either order. Both must find the same bits in both.
set -eu
compiler=$1 tree=$2 generated=$3
folder=clashing_glm
mkdir -p "$folder"
cat > "$folder/main.cpp" << 'END'
#include <array>
#include <cstdint>
#include <cstdio>
std::array<std::uint64_t, 6> fingerprint_with_left_handed_glm();
std::array<std::uint64_t, 6> fingerprint_with_right_handed_glm();
int main() {
    auto const left = fingerprint_with_left_handed_glm(), right = fingerprint_with_right_handed_glm();
    for (auto const bits : left) std::printf("%016llx\n", static_cast<unsigned long long>(bits));
    return left == right ? 0 : 1;
}
END
for unit in left_handed_glm right_handed_glm; do
    "$compiler" -std=c++17 -O0 "-I$tree/include" "-I$tree" "-I$generated" -c "$tree/tests/compile/$unit.cpp" \
        -o "$folder/$unit.o"
done
"$compiler" -std=c++17 "$folder/main.cpp" "$folder/left_handed_glm.o" "$folder/right_handed_glm.o" -o "$folder/one"
"$compiler" -std=c++17 "$folder/main.cpp" "$folder/right_handed_glm.o" "$folder/left_handed_glm.o" -o "$folder/other"
"$folder/one" > "$folder/one.txt" || { printf 'The units disagree\n'; exit 1; }
"$folder/other" > "$folder/other.txt" || { printf 'The units disagree\n'; exit 1; }
diff "$folder/one.txt" "$folder/other.txt" || { printf 'The order of linking decides\n'; exit 1; }
printf 'The same bits in both units, in either order of linking.\n'
