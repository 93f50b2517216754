#!/bin/sh
# SPDX-License-Identifier: MIT
#
# refuse.sh FILE COMPILER FLAGS...: FILE compiles as it is, and with -DWRONG fails with the message that it names in its
# line "// refused: EXTENDED REGULAR EXPRESSION".
set -u
file=$1
shift
message=$(sed -n 's,^// refused: ,,p' "$file")
[ -n "$message" ] || { printf '%s names no message\n' "$file"; exit 1; }
"$@" -fsyntax-only "$file" || { printf 'The right way does not compile.\n'; exit 1; }
if output=$("$@" -fsyntax-only -DWRONG "$file" 2>&1); then
    printf 'The wrong way compiles.\n'
    exit 1
fi
printf '%s\n' "$output" | grep -Eq "$message" || { printf 'Another message:\n%s\n' "$output"; exit 1; }
