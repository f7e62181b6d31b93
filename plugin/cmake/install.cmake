# SPDX-License-Identifier: LGPL-2.1-or-later
# What is installed where.
include(CMakePackageConfigHelpers)

set(ABUT_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/Abut)
set(headers DIRECTORY include/abut DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  FILES_MATCHING PATTERN *.h)

install(TARGETS abut_core_library EXPORT AbutCore
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT AbutCore NAMESPACE Abut:: DESTINATION ${ABUT_CMAKE_DIR})
if(ABUT_CORE_ONLY)
  install(${headers} PATTERN dealii EXCLUDE)
else()
  install(${headers})
  install(TARGETS abut_library abut_headers EXPORT AbutDealii
    LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(EXPORT AbutDealii NAMESPACE Abut:: DESTINATION ${ABUT_CMAKE_DIR})
  install(TARGETS abut_plugin LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
  # Libraries of both build modes may stand side by side; of the program it is
  # the release build that is wanted.
  install(TARGETS abut_app CONFIGURATIONS Release
    RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  install(DIRECTORY prm plugin/tools DESTINATION ${CMAKE_INSTALL_DATADIR}/abut
    PATTERN __pycache__ EXCLUDE)
endif()

configure_package_config_file(plugin/cmake/AbutConfig.cmake.in
  ${PROJECT_BINARY_DIR}/AbutConfig.cmake
  INSTALL_DESTINATION ${ABUT_CMAKE_DIR} PATH_VARS CMAKE_INSTALL_LIBDIR)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/AbutConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/AbutConfig.cmake
  ${PROJECT_BINARY_DIR}/AbutConfigVersion.cmake
  DESTINATION ${ABUT_CMAKE_DIR})

# Found from where the file is, so that an installed tree can be moved.
file(RELATIVE_PATH ABUT_PREFIX_FROM_PKGCONFIG
  /prefix/${CMAKE_INSTALL_LIBDIR}/pkgconfig /prefix)
configure_file(plugin/cmake/abut_core.pc.in ${PROJECT_BINARY_DIR}/abut_core.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/abut_core.pc
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

install(DIRECTORY doc/ DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} RENAME copyright)
