#!/bin/sh
# SPDX-License-Identifier: MIT
#
# on_a_display.sh PROGRAM ARGUMENTS...: runs it under an X server of its own, and ends as it does. (xvfb-run ends with 5
# where it cannot clean up after itself, however the program fared.)
set -u
status_file=$(mktemp)
# shellcheck disable=SC2016
xvfb-run --auto-servernum --server-args='-screen 0 640x480x24' \
    sh -c 'file=$1; shift; "$@"; echo $? > "$file"' on_a_display "$status_file" "$@"
status=$(cat "$status_file")
rm -f "$status_file"
exit "${status:-1}"
