#!/bin/sh
# SPDX-License-Identifier: MIT
#
# build_by_hand.sh COMPILER include-path|single-header|pkg-config FOLDER
set -eu
here=$(dirname -- "$0")
program=./consumer-$2
case $2 in
    include-path) "$1" -std=c++17 -I"$3" "$here/consumer.cpp" -o "$program" ;;
    single-header)
        sed 's,<shadowmath/shadowmath.hpp>,<shadowmath.hpp>,' "$here/consumer.cpp" > single.cpp
        "$1" -std=c++17 -I"$3" single.cpp -o "$program" ;;
    pkg-config)
        flags=$(PKG_CONFIG_PATH=$3 pkg-config --cflags shadowmath)
        eval "\"\$1\" -std=c++17 $flags \"\$here/consumer.cpp\" -o \"\$program\"" ;;
esac
"$program"
