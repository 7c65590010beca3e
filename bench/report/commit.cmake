cmake_minimum_required(VERSION 3.25)
# Writes OUT, a header with the commit of the sources in SOURCE; only if it has changed, so that little is built again.
find_package(Git QUIET)
set(commit unknown)
if(Git_FOUND)
  execute_process(COMMAND ${GIT_EXECUTABLE} -C ${SOURCE} describe --always --dirty=+changes --abbrev=12
    OUTPUT_VARIABLE described OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
  if(NOT failed)
    set(commit ${described})
  endif()
endif()
file(CONFIGURE OUTPUT ${OUT} @ONLY CONTENT "#define BCH_COMMIT \"@commit@\"\n#define BCH_BUILD \"@BUILD@\"\n")
