# SPDX-License-Identifier: MIT
#
# find_package(shadowmath): any GLM from 0.9.9 on, a vendored one too, as long as it is called glm::glm.
include(CMakeFindDependencyMacro)
if(NOT TARGET glm::glm)
    find_dependency(glm)
endif()
include("${CMAKE_CURRENT_LIST_DIR}/shadowmathTargets.cmake")
target_link_libraries(shadowmath::shadowmath INTERFACE glm::glm)
