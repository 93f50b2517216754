#!/bin/bash
# SPDX-License-Identifier: MIT
#
# The reference, made from the headers into a folder that is thrown away: doxygen has nothing to complain of.
set -euo pipefail
command -v doxygen > /dev/null || { echo 'SKIPPED: there is no doxygen here'; exit 77; }
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
folder=$(mktemp -d)
trap 'rm -rf -- "$folder"' EXIT
{ cat docs/Doxyfile; printf 'OUTPUT_DIRECTORY = %s\n' "$folder"; } | doxygen -
printf '%d pages, no warning\n' "$(find "$folder" -name '*.html' | wc -l)"
