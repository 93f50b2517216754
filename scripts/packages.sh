# SPDX-License-Identifier: MIT
# shellcheck shell=bash disable=SC2034
#
# Sourced by scripts/demo, scripts/test, scripts/bench and scripts/engines: what each needs of Debian, once, and how it
# gets there.

export PATH  # where there is none bash makes one up, and keeps it to itself

demo_packages=(
    g++ cmake ninja-build
    libglm-dev                                                   # the only one that the headers need
    libegl-dev libgl-dev libopengl-dev libosmesa6-dev            # OpenGL, two ways into it
    libegl-mesa0 libgl1-mesa-dri                                 # and a software driver
    libvulkan-dev libvulkan-volk-dev mesa-vulkan-drivers         # Vulkan, loaded at run time, with a software driver
    glslang-tools spirv-tools                                    # its shaders, which OpenGL takes too
    libembree-dev                                                # the ray-traced truth
    libtinyobjloader-dev libpng-dev libcli11-dev nlohmann-json3-dev
)
test_packages=(
    "${demo_packages[@]}"
    libgtest-dev librapidcheck-dev
    vulkan-validationlayers                                      # watch every call of the Vulkan backend
    clang clang-format                                           # the second compiler, the layout of the code
    libclang-rt-14-dev                                           # sanitizers and libFuzzer
    codespell gdb                                                # spelling; the pretty-printers are tried in a debugger
    valgrind                                                     # counts instructions
    pkg-config                                                   # one of the ways to find an installed shadowmath
    chromium                                                     # opens the gallery
    doxygen                                                      # the reference has no warnings
)
engine_packages=(
    libogre-1.12-dev libopenscenegraph-dev                       # the engines that shadowmath is dropped into
    xvfb xauth                                                   # a display for them
)
all_packages=(
    "${engine_packages[@]}"
    clang-19                                                     # the newest compiler
    g++-aarch64-linux-gnu qemu-user-static                       # another processor
    emscripten nodejs                                            # and WebAssembly
    g++-mingw-w64-x86-64-posix libx11-dev                        # the real windows.h and Xlib.h
    gcovr python3                                                # which lines the tests reach; mutants
)

docs_packages=(
    g++ cmake ninja-build libglm-dev libpng-dev                  # the programs that draw what the pages show
    cmark-gfm doxygen                                            # the pages, the reference
)
bench_packages=(g++ cmake ninja-build libglm-dev libbenchmark-dev libembree-dev nlohmann-json3-dev)

# Installs what is missing of the packages given, or prints the line that does and fails.
install_packages() {
    if ! command -v dpkg-query > /dev/null; then
        printf 'No dpkg-query here; going on without a check. Needed, by their names in Debian 12:\n  %s\n' "$*" >&2
        return 0
    fi
    local package missing=() as_root=()
    for package in "$@"; do
        [[ $(dpkg-query -W -f='${db:Status-Status}' "$package" 2> /dev/null) == installed ]] || missing+=("$package")
    done
    ((${#missing[@]})) || return 0

    if ((EUID != 0)); then
        as_root=(sudo -n)
        if ! sudo -n true 2> /dev/null; then
            printf 'Packages are missing. Install them with this line, then start again:\n  %s\n' \
                "sudo sh -c 'apt-get update && apt-get install --no-install-recommends ${missing[*]}'" >&2
            return 1
        fi
    fi
    printf 'Installing %s (takes a minute or two)\n' "${missing[*]}"
    local apt=("${as_root[@]}" env DEBIAN_FRONTEND=noninteractive DEBCONF_NOWARNINGS=yes LC_ALL=C.UTF-8
        apt-get -qq -o DPkg::Lock::Timeout=300 -o Dpkg::Use-Pty=0)
    "${apt[@]}" update < /dev/null || printf 'apt-get update failed; going on with the lists that are there\n' >&2
    "${apt[@]}" install -y --no-install-recommends "${missing[@]}" < /dev/null > /dev/null || {
        printf 'apt-get could not install them; the line was:\n  %s\n' \
            "apt-get install --no-install-recommends ${missing[*]}" >&2
        return 1
    }
}
