# Fails when REFERENCE is not what `PROGRAM parameters` prints.
execute_process(COMMAND ${PROGRAM} parameters OUTPUT_VARIABLE printed
  RESULT_VARIABLE code)
if(NOT code EQUAL 0)
  message(FATAL_ERROR "'abut parameters' ended with code ${code}")
endif()
file(READ ${REFERENCE} committed)
if(NOT printed STREQUAL committed)
  message(FATAL_ERROR "${REFERENCE} is out of date; renew it by\n"
    "  build/release/abut parameters > doc/parameters.md")
endif()
