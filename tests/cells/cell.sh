#!/bin/sh
# SPDX-License-Identifier: MIT
#
# cell.sh NAME [--hashes FILE] [--runner PROGRAM] [--replay ARGUMENTS] -- COMPILER FLAGS...
#
# Compiles the laws in one file with these flags, runs them on pseudo-random bytes, and compares the hashes of what came
# out with those of FILE; the first to come writes it. A compiler or runner that is missing is a skipped test.
set -eu
name=$1
hashes='' runner='' replay=''
shift
while [ "$1" != -- ]; do
    case $1 in
        --hashes) hashes=$2 ;;
        --runner) runner=$2 ;;
        --replay) replay=$2 ;;
    esac
    shift 2
done
shift
for program in "$1" ${runner%% *}; do
    command -v "$program" > /dev/null || { printf 'SKIPPED: there is no %s here\n' "$program"; exit 77; }
done
suffix=''
case $runner in *node*) suffix=.js ;; esac
${CELL_CACHE-} "$@" -c replay_in_one.cpp -o "$name.o"
case $replay in none) exit 0 ;; esac
"$@" "$name.o" -o "$name$suffix"
# shellcheck disable=SC2086
$runner "./$name$suffix" $replay > "$name.txt" || { cat "$name.txt"; exit 1; }
cat "$name.txt"
rm -f "$name.o" "$name$suffix" "$name.wasm"
[ -n "$hashes" ] || exit 0
if [ -e "$hashes" ]; then
    diff "$hashes" "$name.txt" || { printf 'Not the bits that other builds compute.\n'; exit 1; }
else
    cp "$name.txt" "$hashes"
fi
