#!/bin/sh
# SPDX-License-Identifier: MIT
#
# symbols.sh SOURCE COMPILER FLAGS...: what the headers' functions, all of them compiled, ask of a program. Mathematics
# and memcpy they may; malloc, a throw, a stream, a lock would show here, and so would a variable that keeps state.
set -eu
source=$1
shift
"$@" -O0 -DNDEBUG -c "$source" -o symbols.o
functions=$(nm --defined-only symbols.o | wc -l)
[ "$functions" -gt 500 ] || { printf 'Only %s symbols: the functions are not there.\n' "$functions"; exit 1; }

roots='sqrt|cbrt|hypot|pow|exp2?|expm1|log(2|10|1p)?|ldexp|frexp'
angles='a?(sin|cos|tan)h?|atan2'
processor='__cpu_model|__cpu_indicator_init'  # libgcc's: which instructions it has
rounding='floor|ceil|round|trunc|rint|nearbyint|fmod|fmin|fmax|fabs|copysign'
compiler='mem(cpy|cmp|set|move)|_GLOBAL_OFFSET_TABLE_|__stack_chk_fail'
others=$(nm -u symbols.o | awk '{ print $NF }' |
    grep -Evx "($roots|$angles|$rounding)[fl]?|$compiler|$processor" || true)
[ -z "$others" ] || { printf 'Not among the few that a drop-in may need:\n%s\n' "$others" | c++filt; exit 1; }
state=$(objdump -t symbols.o | awk '/ O \.(data|bss|tdata|tbss)/ && !/\.rel\.ro/ { print $NF }')
[ -z "$state" ] || { printf 'Variables:\n%s\n' "$state" | c++filt; exit 1; }
rm symbols.o
printf '%s functions, nothing but mathematics asked for.\n' "$functions"
