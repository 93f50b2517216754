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
    -ex 'print sun.direction' ./printed 2>&1) || { printf '%s\n' "$shown"; exit 1; }
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
END
((status == 0)) || printf '%s\n' "$shown"
exit "$status"
