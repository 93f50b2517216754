#!/bin/bash
# SPDX-License-Identifier: MIT
#
# port.sh COMPILER SOURCES FOLDER: with the options of the vcpkg port, the headers install where nothing but GLM is to
# be found, and nothing is compiled. (vcpkg itself is not in Debian.)
set -euo pipefail
compiler=$1 sources=$2 folder=$3
rm -rf -- "$folder"
mapfile -t options < <(sed -n '/OPTIONS/,/)/p' "$sources/packaging/vcpkg/shadowmath/portfile.cmake" |
    grep -o -- '-D[A-Z_]*=[A-Z]*')
((${#options[@]})) || { echo 'the port has no options any more'; exit 1; }
mapfile -t hidden < <(grep -rhoP '\bfind_package\(\K\w+' --include=CMakeLists.txt --include='*.cmake' \
    "$sources"/{CMakeLists.txt,cmake,backends,bench,docs,examples,oracle,scenes,tests} | sort -u |
    grep -vxE 'glm|shadowmath' | sed 's/.*/-DCMAKE_DISABLE_FIND_PACKAGE_&=ON/')
cmake -S "$sources" -B "$folder/build" -G Ninja -DCMAKE_CXX_COMPILER="$compiler" \
    -DCMAKE_INSTALL_PREFIX="$folder/prefix" --log-level=WARNING --no-warn-unused-cli "${options[@]}" "${hidden[@]}"
cmake --build "$folder/build" --target install > /dev/null
[[ -z $(find "$folder/build" -name '*.o' -not -path '*/CMakeFiles/3*') ]] || { echo 'something was compiled'; exit 1; }
diff -r "$sources/include/shadowmath" "$folder/prefix/include/shadowmath"
[[ -f $folder/prefix/share/cmake/shadowmath/shadowmathConfig.cmake && -f $folder/prefix/share/pkgconfig/shadowmath.pc ]]
printf '%s options of the port, %s packages hidden\n' "${#options[@]}" "${#hidden[@]}"
