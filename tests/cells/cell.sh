#!/bin/sh
# SPDX-License-Identifier: MIT
#
# cell.sh NAME [--write FILE | --compare FILE] [--runner PROGRAM] [--replay ARGUMENTS] -- COMPILER FLAGS...
#
# Compiles the laws in one file with these flags, runs them on pseudo-random bytes, and writes the hashes of what came
# out to FILE, or compares them with it. A compiler or runner that is missing is a skipped test.
set -eu
name=$1
written='' compared='' runner='' replay=''
shift
while [ "$1" != -- ]; do
    case $1 in
        --write) written=$2 ;;
        --compare) compared=$2 ;;
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
if [ -n "$written" ]; then cp "$name.txt" "$written"; fi
[ -z "$compared" ] || diff "$compared" "$name.txt" || { printf 'Not the bits that other builds compute.\n'; exit 1; }
