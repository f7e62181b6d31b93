# SPDX-License-Identifier: LGPL-2.1-or-later
# The target `site`: the manual as pages in the folder `site` of the build, by
# Sphinx. Warnings are errors. The pages need no network. The reference of the headers
# is in its folder `headers`.
find_package(Python3 QUIET COMPONENTS Interpreter)
find_path(ABUT_KATEX katex.min.js PATHS /usr/share/javascript/katex)
find_program(SPHINX_BUILD sphinx-build PATHS /usr/bin NO_DEFAULT_PATH)
find_program(SPHINX_BUILD sphinx-build)
if(SPHINX_BUILD AND ABUT_KATEX)
  set(copy_reference)
  if(TARGET reference)
    set(copy_reference COMMAND ${CMAKE_COMMAND} -E copy_directory
      ${PROJECT_BINARY_DIR}/reference/html ${PROJECT_BINARY_DIR}/site/headers)
  endif()
  add_custom_target(site COMMAND ${CMAKE_COMMAND} -E env
    ABUT_VERSION=${PROJECT_VERSION} ABUT_KATEX=${ABUT_KATEX}
    ${SPHINX_BUILD} -b html -q -W --keep-going -n -j auto
    -d ${PROJECT_BINARY_DIR}/site.cache
    ${PROJECT_SOURCE_DIR}/doc ${PROJECT_BINARY_DIR}/site
    ${copy_reference} VERBATIM)
  if(TARGET reference)
    add_dependencies(site reference)
  endif()
else()
  add_custom_target(site
    COMMAND ${CMAKE_COMMAND} -E echo
      "The site needs Sphinx, MyST, furo and KaTeX. On Debian: .ci/setup --documents"
    COMMAND ${CMAKE_COMMAND} -E false VERBATIM)
endif()
