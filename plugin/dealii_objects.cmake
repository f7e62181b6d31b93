# Common set-up of the targets that use deal.II.

# What is taken back of deal.II's own flags: debug information in release builds,
# and unrolled loops, which cost a quarter of the time to compile and gain nothing.
# With sanitizers names of functions and lines are wanted, and less to compile.
set(ABUT_LESS_THAN_DEALII $<$<CONFIG:Release>:-g0> -fno-unroll-loops
    -fno-unroll-all-loops)
if(ABUT_SANITIZE)
  list(APPEND ABUT_LESS_THAN_DEALII -O1 -g1)
endif()

# Sources of each folder in groups that are compiled as one.
function(abut_unity_groups target)
  foreach(source ${ARGN})
    get_filename_component(folder ${source} DIRECTORY)
    string(MAKE_C_IDENTIFIER "n_${folder}" n)
    math(EXPR ${n} "${${n}} + 1")
    math(EXPR group "(${${n}} - 1) / ${ABUT_UNITY_FILES}")
    get_filename_component(name ${folder} NAME)
    set_source_files_properties(${source} PROPERTIES
      UNITY_GROUP ${name}_${group})
  endforeach()
  set_target_properties(${target} PROPERTIES
    UNITY_BUILD ON UNITY_BUILD_MODE GROUP
    UNITY_BUILD_CODE_AFTER_INCLUDE "#undef ABUT_INSTANTIATE")
  # Members of unnamed namespaces are no mistake in a file that is included once.
  target_compile_options(${target} PRIVATE -Wno-subobject-linkage)
endfunction()

# An object library of the C++ sources of this folder, compiled with deal.II's
# flags and with the precompiled header of plugin/pch.h, which is built once.
# Further arguments are sources of the folder that do not belong to it.
#
# With ABUT_UNITY, up to ABUT_UNITY_FILES sources of a folder are compiled as one:
# what the headers bring costs more than most files. Names in unnamed namespaces
# must therefore differ within a folder.
function(abut_dealii_objects target)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS
    ${CMAKE_CURRENT_SOURCE_DIR}/*.cc)
  list(REMOVE_ITEM sources ${ARGN} "")
  add_library(${target} OBJECT ${sources})
  deal_ii_setup_target(${target})
  target_include_directories(${target} PUBLIC ${PROJECT_SOURCE_DIR}/include)
  target_include_directories(${target} PRIVATE ${PROJECT_SOURCE_DIR}/plugin)
  target_compile_options(${target} PRIVATE ${ABUT_CXX_WARNINGS}
    ${ABUT_LESS_THAN_DEALII})
  # What is exported is decided by the list of symbols at link time.
  set_target_properties(${target} PROPERTIES CXX_VISIBILITY_PRESET default)
  if(ABUT_UNITY)
    abut_unity_groups(${target} ${sources})
  endif()
  if(target STREQUAL "abut_shim")
    target_precompile_headers(${target} PRIVATE
      ${PROJECT_SOURCE_DIR}/plugin/pch.h)
  else()
    target_precompile_headers(${target} REUSE_FROM abut_shim)
  endif()
endfunction()

# The precompiled header, which is one for libraries, in a program that is set up
# for deal.II, too; with the same flags.
function(abut_precompiled_headers target)
  target_compile_options(${target} PRIVATE -fPIC ${ABUT_LESS_THAN_DEALII})
  target_precompile_headers(${target} REUSE_FROM abut_shim)
endfunction()

# What sees the inside of Abut: a program or objects of a test or benchmark.
function(abut_inside target)
  deal_ii_setup_target(${target})
  target_include_directories(${target} PRIVATE
    ${PROJECT_SOURCE_DIR}/include ${PROJECT_SOURCE_DIR}/plugin)
  target_compile_options(${target} PRIVATE ${ABUT_CXX_WARNINGS})
  abut_precompiled_headers(${target})
endfunction()

function(abut_inside_program target)
  add_executable(${target} ${ARGN})
  abut_inside(${target})
  target_link_libraries(${target} abut_inside)
endfunction()
