# SPDX-License-Identifier: LGPL-2.1-or-later
# cpack -G DEB makes a Debian package. Its dependencies are those of the
# libraries that the installed files are linked to, as dpkg-shlibdeps knows them.
# deal.II programs are developed in Debug mode and run in Release: the package of
# a release build brings the libraries of build/dev, too, where they are.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME abut)
set(CPACK_PACKAGE_CONTACT "Abut maintainers <abut@localhost>")
set(CPACK_PACKAGE_DESCRIPTION "Contact search, mortar and other constraints, \
contact laws, and solvers\nfor elastic bodies and membranes in contact: a program, \
a library for\ndeal.II, a plugin for deal.II programs, and a C library.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION math)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR})
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")
# To run in parallel, to draw, and to compile programs: one rank and figures
# need none of them.
if(NOT ABUT_CORE_ONLY)
  set(CPACK_DEBIAN_PACKAGE_RECOMMENDS
    "python3-matplotlib, libdeal.ii-dev, mpi-default-bin")
endif()
if(CMAKE_BUILD_TYPE STREQUAL "Release" AND NOT ABUT_CORE_ONLY)
  set(ABUT_DEBUG_BUILD ${PROJECT_SOURCE_DIR}/build/dev)
  configure_file(${CMAKE_CURRENT_LIST_DIR}/both_modes.cmake.in
    ${PROJECT_BINARY_DIR}/both_modes.cmake @ONLY)
  set(CPACK_PROJECT_CONFIG_FILE ${PROJECT_BINARY_DIR}/both_modes.cmake)
endif()
include(CPack)
