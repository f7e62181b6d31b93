# SPDX-License-Identifier: LGPL-2.1-or-later
# The target `reference`: API reference by Doxygen in the folder `reference` of
# the build. What is not documented is an error.
find_program(DOXYGEN doxygen)
if(DOXYGEN)
  set(command ${CMAKE_COMMAND} -E env ABUT_VERSION=${PROJECT_VERSION}
    ABUT_SOURCE=${PROJECT_SOURCE_DIR}
    ABUT_REFERENCE=${PROJECT_BINARY_DIR}/reference
    ${DOXYGEN} ${PROJECT_SOURCE_DIR}/doc/Doxyfile)
  file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/reference)
  add_custom_target(reference COMMAND ${command} VERBATIM)
  if(ABUT_TESTS)
    add_test(NAME reference COMMAND ${command})
    set_tests_properties(reference PROPERTIES LABELS install TIMEOUT 60)
  endif()
endif()
