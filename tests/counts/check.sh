#!/bin/bash
# SPDX-License-Identifier: MIT
#
# Counts instructions with callgrind and compares them with those written down for this compiler: within two per cent,
# more or fewer (a gain is to be written down too). Time is never compared: machines differ, counts hardly.
#
#   check.sh PROGRAM COUNTS            77: nothing could be compared, and why is said
#   check.sh PROGRAM COUNTS --write    writes COUNTS
set -euo pipefail
program=$1 counts=$2

skip() {
    printf 'SKIPPED, nothing was counted: %s\n' "$1"
    exit 77
}
command -v valgrind > /dev/null || skip 'valgrind is not installed'
grep -qw avx2 /proc/cpuinfo 2> /dev/null ||
    skip 'the counts were taken on a processor with AVX2, which this one has not'

count_of() { # FUNCTION
    valgrind --tool=callgrind --toggle-collect="$1" --callgrind-out-file=/dev/null "$program" 2>&1 |
        awk '/Collected :/ { print $NF }'
}
if [[ ${3:-} == --write ]]; then
    names=$(nm -C "$program" | awk '$2 == "T" && $3 ~ /^count_/ { print $3 }' | sort)
    for name in $names; do printf '%s %s\n' "$name" "$(count_of "$name")"; done > "$counts"
    exit 0
fi
[[ -f $counts ]] || skip "there are no counts for this compiler: $counts (write them with --write)"

worse=0
printf '%-42s %9s %9s\n' '' counted 'written'
while read -r name written; do
    now=$(count_of "$name")
    verdict=$(awk -v now="${now:-0}" -v was="$written" \
        'BEGIN { print (now >= 0.98 * was && now <= 1.02 * was) ? "" : "more than two per cent off" }')
    printf '%-42s %9s %9s  %s\n' "$name" "$now" "$written" "$verdict"
    [[ -z $verdict ]] || worse=1
done < "$counts"
exit "$worse"
