# SPDX-License-Identifier: MIT
#
# For work on shadowmath itself; a project that uses it never gets here.
option(SHADOWMATH_BUILD_BACKENDS "Build the OpenGL backends, the scenes and the ray-traced truth" ON)
option(SHADOWMATH_BUILD_EXAMPLES "Build the examples, the documentation's programs and, with backends, the gallery" ON)
option(SHADOWMATH_BUILD_TESTS "Build the tests" ON)
option(SHADOWMATH_BUILD_BENCH "Build the benchmarks; scripts/bench does, and runs them" OFF)

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
    set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release, RelWithDebInfo or MinSizeRel" FORCE)
endif()
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY "${PROJECT_BINARY_DIR}/bin")

find_program(CCACHE ccache)
mark_as_advanced(CCACHE)
if(CCACHE AND NOT DEFINED CMAKE_CXX_COMPILER_LAUNCHER)
    # Without the sloppiness nothing that uses a precompiled header is ever found again.
    set(CMAKE_CXX_COMPILER_LAUNCHER "${CMAKE_COMMAND}" -E env CCACHE_SLOPPINESS=pch_defines,time_macros "${CCACHE}")
endif()

add_compile_options(-Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wshadow -Wdouble-promotion
                    -Wold-style-cast)
if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
    add_compile_options(-Wno-restrict)  # false alarms about "literal" + std::string, GCC bug 105651
endif()

if(SHADOWMATH_BUILD_TESTS)
    # Every header compiles alone: all_verify_interface_header_sets, which CMake makes, is part of `all` here.
    set_target_properties(shadowmath PROPERTIES VERIFY_INTERFACE_HEADER_SETS ON)
    add_custom_target(headers_alone ALL)
    cmake_language(DEFER DIRECTORY "${PROJECT_SOURCE_DIR}" CALL
                   add_dependencies headers_alone shadowmath_verify_interface_header_sets)

    enable_testing()
    add_test(NAME "The house is in order" COMMAND "${PROJECT_SOURCE_DIR}/scripts/check")
endif()

if(SHADOWMATH_BUILD_BACKENDS)
    set(parts backends scenes oracle)
endif()
if(SHADOWMATH_BUILD_EXAMPLES)
    list(APPEND parts examples docs)
endif()
if(SHADOWMATH_BUILD_TESTS)
    list(APPEND parts tests tests/cells tests/consume)
endif()
if(SHADOWMATH_BUILD_BENCH)
    list(APPEND parts bench)
endif()
foreach(part IN LISTS parts)
    if(EXISTS "${PROJECT_SOURCE_DIR}/${part}/CMakeLists.txt")
        add_subdirectory(${part})
    endif()
endforeach()
