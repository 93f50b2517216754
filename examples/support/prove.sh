#!/bin/bash
# SPDX-License-Identifier: MIT
#
# prove.sh EXAMPLE SAME_PICTURE FOLDER: the example proves what it says, and writes one picture that shows something.
set -euo pipefail
example=$1 same_picture=$2 folder=$3
rm -rf -- "$folder"
mkdir -p -- "$folder"
"$example" "$folder"
pictures=("$folder"/*)
((${#pictures[@]} == 1)) && [[ -f ${pictures[0]} ]] || { printf 'Not one picture: %s\n' "${pictures[*]}"; exit 1; }
"$same_picture" "${pictures[0]}"
