#!/bin/sh
# SPDX-License-Identifier: MIT
#
# quick.sh PROGRAM FOLDER [REASON]: the quick trial of an engine, on a display of its own; 77 where REASON says why not.
set -eu
if [ $# -gt 2 ]; then
    printf 'SKIPPED: %s\n' "$3"
    exit 77
fi
if ! command -v xvfb-run > /dev/null; then
    printf 'SKIPPED: there is no xvfb-run here (xvfb, xauth)\n'
    exit 77
fi
exec "$(dirname -- "$0")/on_a_display.sh" "$1" --quick --check --out "$2"
