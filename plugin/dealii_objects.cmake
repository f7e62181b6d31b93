# Common set-up of the targets that use deal.II.

# An object library of the C++ sources of this folder, compiled with deal.II's
# flags and with the precompiled header of plugin/pch.h, which is built once.
# Further arguments are sources of the folder that do not belong to it.
function(abut_dealii_objects target)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS
    ${CMAKE_CURRENT_SOURCE_DIR}/*.cc)
  list(REMOVE_ITEM sources ${ARGN} "")
  add_library(${target} OBJECT ${sources})
  deal_ii_setup_target(${target})
  target_include_directories(${target} PUBLIC ${PROJECT_SOURCE_DIR}/include)
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/plugin)
  # deal.II's flags ask for debug information in release builds too.
  target_compile_options(${target} PRIVATE ${ABUT_CXX_WARNINGS}
    $<$<CONFIG:Release>:-g0>)
  # What is exported is decided by the list of symbols at link time.
  set_target_properties(${target} PROPERTIES CXX_VISIBILITY_PRESET default)
  if(target STREQUAL "abut_shim")
    target_precompile_headers(${target} PRIVATE
      ${PROJECT_SOURCE_DIR}/plugin/pch.h)
  else()
    target_precompile_headers(${target} REUSE_FROM abut_shim)
  endif()
endfunction()

# A program that uses the inside of Abut: a test or benchmark.
function(abut_inside_program target)
  add_executable(${target} ${ARGN})
  deal_ii_setup_target(${target})
  target_include_directories(${target} PRIVATE
    ${PROJECT_SOURCE_DIR}/include ${PROJECT_SOURCE_DIR}/plugin)
  # The precompiled header is one for libraries.
  target_compile_options(${target} PRIVATE ${ABUT_CXX_WARNINGS} -fPIC
    $<$<CONFIG:Release>:-g0>)
  target_precompile_headers(${target} REUSE_FROM abut_shim)
  target_link_libraries(${target} abut_inside)
endfunction()
