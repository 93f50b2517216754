#!/bin/bash
# SPDX-License-Identifier: MIT
#
# printed.sh COMPILER PROJECT: what gdb shows of shadowmath's values with the printers of debug/.
set -euo pipefail
compiler=$1 project=$2
command -v gdb > /dev/null || { echo 'SKIPPED: there is no gdb here'; exit 77; }
"$compiler" -std=c++17 -g -O0 -I"$project/include" "$project/tests/debug/printed.cpp" -o printed
line=$(grep -n 'stop here' "$project/tests/debug/printed.cpp" | cut -d : -f 1)
shown=$(gdb -nx -batch -ex "source $project/debug/shadowmath_gdb.py" -ex "break printed.cpp:$line" -ex run \
    -ex 'print box' -ex 'print nothing' -ex 'print view' -ex 'print sun' -ex 'print splits' -ex 'print faults' \
    -ex 'print clip' -ex 'print map' -ex 'print cascades.at[0].map.visible' -ex 'print cascades' \
    -ex 'print sun.direction' -ex 'print ball' -ex 'print range' -ex 'print depth' -ex 'print light_box' \
    -ex 'print grid' -ex 'print region' -ex 'print plane' -ex 'print texel' -ex 'print worth' -ex 'print bias' \
    -ex 'print look_up' -ex 'print lit' -ex 'print soft' -ex 'print cube' -ex 'print levels' -ex 'print casters' \
    -ex 'print body' -ex 'print irregular' -ex 'print tile' -ex 'print strip' -ex 'print part' -ex 'print page' \
    -ex 'print scroll' ./printed 2>&1) || { printf '%s\n' "$shown"; exit 1; }
case $shown in
    *'Could not trace'* | *'Operation not permitted'*) echo 'SKIPPED: gdb may not trace here'; exit 77 ;;
esac
status=0
while IFS= read -r expected; do
    grep -qF -- "$expected" <<< "$shown" || { printf 'Not shown: %s\n' "$expected"; status=1; }
done << 'END'
$1 = (-20, 0, -20) to (20, 5, 20)
$2 = empty
$3 = perspective, 0.5 m to 50 m
$4 = directional along (0, -1, 0), faults: none
$5 = 2 splits at {1, 5, 9} m, faults: none
$6 = not_finite | bad_pose
$7 = depth zero_to_one, ndc y
$8 = not visible, faults: none
$10 = 4 cascades, faults: none
$11 = (0, -1, 0)
$12 = radius 4 at (1, 2, 3)
$13 = 1 m to 5 m, fading from 3 m
$14 = -8 m to 2 m
$15 = (-1, -1) to (1, 1) m, depth 0 to 1 m
$16 = 64 texels of 0.5 m from (-32, -32), faults: none
$17 = (-1, -1) to (1, 1)
$18 = (0, 1, 0) . p + -3 = 0
$19 = 2 x 0.5 eye pixels a texel
$20 = worst 4, mean 2 eye pixels a texel over 100 points, 3 without a map
$21 = 0.25 + 0 / w + 1.5 slope
$22 = map 1, 0.25 of 2
$23 = no map: lit
$24 = 0.5 of the light, occluders at a gap of 2
$25 = 0 of 6 faces visible, faults: none
$26 = 3 levels, faults: none
$27 = 4 maps in 1 bundles
$28 = 12 edges
$29 = 0 nodes in 0 lists, faults: none
$30 = 64 texels at (16, 32) of 128 x 256
$31 = 3 x 4 at (1, 2)
$32 = 2 x 1 at (4, 3)
$33 = (-1, 5) of level 2
$34 = by (4, 0), 1 strips fresh
END
((status == 0)) || printf '%s\n' "$shown"
exit "$status"
