#!/bin/bash
# SPDX-License-Identifier: MIT
#
# check.sh PROGRAMS [--update]: what a machine can tell about the documentation; one line for each breach. PROGRAMS is
# the folder of the built examples. --update takes what they draw and write now as what the pages show.
set -eu
shopt -s nullglob
programs=$(realpath -- "$1")
update=${2-}
cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.."
export LC_ALL=C.UTF-8
fresh=$(mktemp -d)
trap 'rm -rf -- "$fresh"' EXIT

breaches=0
report() { # SENTENCE: one breach for each place on standard input
    local place
    while IFS= read -r place; do
        printf '%s: %s\n' "$place" "$1"
        breaches=$((breaches + 1))
    done
}
shopt -s lastpipe
pages=(docs/*.md)
texts=(README.md CONTRIBUTING.md CHANGELOG.md "${pages[@]}" packaging/*.md packaging/*/*.md)
prose() { awk '/^```/ { code = !code; next } !code' "$1"; } # FILE: without its blocks of code

# Pictures and tables are what the programs make of the headers today.
mkdir "$fresh/images"
for program in "$programs"/example_[0-9]* "$programs/docs_pictures"; do
    "$program" "$fresh/images" > "$fresh/log" || { basename "$program"; cat "$fresh/log" >&2; }
done | report 'does not prove what it says'
"$programs/docs_accuracy" "$fresh/accuracy" "$fresh/images/accuracy.svg"
if [[ $update == --update ]]; then
    cp -- "$fresh"/images/* docs/images/
    sed -i -e '/^<!-- written by docs\/programs\/accuracy/,/^<!-- end -->/{//!d}' \
        -e "/^<!-- written by docs\/programs\/accuracy/r $fresh/accuracy" docs/accuracy.md
fi
for picture in "$fresh"/images/*; do
    shown=docs/images/${picture##*/}
    "$programs/same_picture" "$picture" "$shown" > "$fresh/log" 2>&1 || printf '%s\n' "$shown"
done | report 'not what is drawn today (scripts/docs --update)'
sed -n '/^<!-- written by docs\/programs\/accuracy/,/^<!-- end -->/{//!p}' docs/accuracy.md |
    cmp -s - "$fresh/accuracy" || printf 'docs/accuracy.md\n' | report 'not the table of today (scripts/docs --update)'
find "$fresh/images" -size +150k -printf '%f\n' | report 'larger than 150 kB'
for image in docs/images/*; do
    grep -qF -- "images/${image##*/}" "${texts[@]}" || printf '%s\n' "$image"
done | report 'shown nowhere'

# Links and pictures lead somewhere.
slugs() { # FILE: the anchors of its headings, as GitHub makes them
    prose "$1" | sed -nE 's/^#+ +//p' | tr '[:upper:]' '[:lower:]' | sed -E 's/[^[:alnum:] _-]//g; s/ /-/g'
}
for text in "${texts[@]}"; do
    prose "$text" | grep -oP '\]\(\K[^)\s]+' | sort -u | while IFS= read -r link; do
        case $link in http://* | https://*) continue ;; esac
        file=${link%%#*} anchor=
        [[ $link == *'#'* ]] && anchor=${link#*#}
        target=$(dirname -- "$text")/$file
        [[ -n $file ]] || target=$text
        if [[ ! -e $target ]] || { [[ -n $anchor ]] && ! slugs "$target" | grep -qxF -- "$anchor"; }; then
            printf '%s: %s\n' "$text" "$link"
        fi
    done
done | report 'leads nowhere'
for page in "${pages[@]}"; do
    name=${page#docs/}
    grep -qE "\]\((docs/|\.\./docs/)?${name//./\\.}[)#]" "${texts[@]}" || printf '%s\n' "$page"
done | report 'no text links to it; the index is docs/README.md'

# Every header and every file of the GLSL library is named on a page, every test that is named exists.
find include/shadowmath \( -name '*.hpp' -o -name '*.glsl' \) -printf '%P\n' | sort | while IFS= read -r header; do
    [[ $header == shadowmath.hpp ]] || grep -qE -- "\`(glsl/)?${header#glsl/}\`" "${pages[@]}" ||
        printf '%s\n' "$header"
done | report 'on no page'
grep -rhoP '^(TEST|TEST_F|TEST_P|TYPED_TEST|RC_GTEST_PROP)\(\K\w+, *\w+' tests examples --include='*.cpp' |
    sed 's/, */./' | sort -u > "$fresh/tests"
grep -noP '`\K[A-Z]\w+\.[A-Z]\w+(?=`)' "${pages[@]}" | while IFS=: read -r page line name; do
    grep -qxF -- "$name" "$fresh/tests" ||
        grep -rqF "${name%%_*}" --include=CMakeLists.txt examples tests ||
        printf '%s:%s: %s\n' "$page" "$line" "$name"
done | report 'no such test'

# The code compiles: each block a function, its includes before all of them.
awk '
    FNR == 1 { page = FILENAME }
    /^```cpp$/ { code = 1; line = FNR; body = ""; next }
    /^```/ && code {
        code = 0
        blocks = blocks "namespace block_" ++count " {\nvoid block() {\n#line " line + 1 " \"" page "\"\n" body "}\n}\n"
        next
    }
    code && /^#include/ { includes = includes $0 "\n"; body = body "\n"; next }
    code { body = body $0 "\n" }
    END { printf "#include \"docs/programs/names.hpp\"\n%s%s", includes, blocks }
' "${pages[@]}" > "$fresh/blocks.cpp"
"${CXX:-g++}" -std=c++17 -fsyntax-only -Wall -Wextra -Werror -I. -Iinclude "$fresh/blocks.cpp" 2> "$fresh/log" ||
    { grep -E '^docs/.*error' "$fresh/log" || cat "$fresh/log"; } | report 'does not compile'

printf '%d pages, %d pictures, %d blocks of code, %d breaches\n' "${#pages[@]}" \
    "$(find "$fresh/images" -type f | wc -l)" "$(grep -c '^namespace block_' "$fresh/blocks.cpp")" "$breaches"
((breaches == 0))
