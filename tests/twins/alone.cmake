# SPDX-License-Identifier: MIT
#
# cmake -DGLSLANG=glslangValidator -DOUT=<folder> -P alone.cmake
# Every file of the GLSL library compiles alone, and all of them together: pasted into OpenGL 4.3 text, and included by
# a compiler for Vulkan.
cmake_path(GET CMAKE_CURRENT_LIST_DIR PARENT_PATH tests)
cmake_path(GET tests PARENT_PATH root)
file(GLOB library "${root}/include/shadowmath/glsl/*.glsl")
list(LENGTH library count)
if(count LESS 10)
    message(FATAL_ERROR "the library has ${count} files")
endif()

function(run)
    execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE said ERROR_VARIABLE said RESULT_VARIABLE status)
    if(NOT status EQUAL 0)
        message(FATAL_ERROR "${said}")
    endif()
endfunction()

function(compile name)
    set(shader "layout(local_size_x = 1) in;\n")
    foreach(path IN LISTS ARGN)
        cmake_path(GET path FILENAME file)
        string(APPEND shader "#include \"shadowmath/glsl/${file}\"\n")
    endforeach()
    string(APPEND shader "void main() {}\n")
    file(WRITE "${OUT}/pasted_${name}.comp" "#version 430 core\n${shader}")
    run(${CMAKE_COMMAND} -DOUT=${OUT}/text -DSHADERS=${OUT}/pasted_${name}.comp
        -P "${root}/backends/shaders/embed.cmake")
    run("${GLSLANG}" "${OUT}/text/pasted_${name}.comp")
    file(WRITE "${OUT}/${name}.comp"
         "#version 450\n#extension GL_GOOGLE_include_directive : require\n${shader}")
    run("${GLSLANG}" -V "-I${root}/include" -o "${OUT}/${name}.spv" "${OUT}/${name}.comp")
endfunction()

foreach(path IN LISTS library)
    cmake_path(GET path STEM name)
    compile(${name} "${path}")
endforeach()
compile(all_together ${library})
