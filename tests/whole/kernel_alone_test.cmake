# Builds SOURCE as a part of a project by a parent whose FLAGS break arithmetic, where nothing can be found but xsimd and TBB; installs it,
# and builds programs of such flags against that. All their answers are those of the program ANSWERS.
# Usage: cmake -DSOURCE=... -DWORK=... -DCOMPILER=... -DFLAGS=... -DXSIMD=... -DTBB=... -DANSWERS=... [-DPARENT=...: its other settings]
#   -P kernel_alone_test.cmake
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)

# Whatever is looked for is looked for below a folder that is empty, but for what is installed there.
set(settings -G Ninja -DCMAKE_CXX_COMPILER=${COMPILER} -DBCH_XSIMD_INCLUDE_DIR=${XSIMD} -DTBB_DIR=${TBB} -DCMAKE_FIND_ROOT_PATH=${WORK}/root)
foreach(mode PACKAGE INCLUDE LIBRARY)
  list(APPEND settings -DCMAKE_FIND_ROOT_PATH_MODE_${mode}=ONLY)
endforeach()
run(${ANSWERS})
if(FLAGS MATCHES "-fno-exceptions")  # these lines are messages of them
  string(REGEX REPLACE "[^\n]+ is not [^\n]+\n" "" output "${output}")
endif()
set(expected "${output}")
function(expect_answers program)
  run(${program})
  if(NOT output STREQUAL expected)
    message(FATAL_ERROR "flags of others change answers:\n${output}expected:\n${expected}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
set(parent -S ${SOURCE}/tests/examples/subproject -B ${WORK}/bch ${settings} -DFETCHCONTENT_SOURCE_DIR_BCH=${SOURCE} "-DCMAKE_CXX_FLAGS=${FLAGS}" ${PARENT})
run(${CMAKE_COMMAND} ${parent})
run(${CMAKE_COMMAND} --build ${WORK}/bch)
expect_answers(${WORK}/bch/answers)

# A part installs nothing, unless it is asked.
run(${CMAKE_COMMAND} --install ${WORK}/bch --prefix ${WORK}/root/usr/local)
if(EXISTS ${WORK}/root)
  message(FATAL_ERROR "a part of a project installs something:\n${output}")
endif()
run(${CMAKE_COMMAND} ${parent} -DBCH_INSTALL=ON)
run(${CMAKE_COMMAND} --install ${WORK}/bch --prefix ${WORK}/root/usr/local)

# Where such flags are not undone, nothing compiles.
run_wrong("need IEEE arithmetic" ${COMPILER} -std=c++20 -Ofast -I${SOURCE} -fsyntax-only -x c++ ${SOURCE}/layout/base/rounding.hpp)

# Every header that was read, whether or not a target asked for its folder.
file(STRINGS ${WORK}/bch/CMakeCache.txt ninja REGEX "^CMAKE_MAKE_PROGRAM:")
string(REGEX REPLACE "^[^=]*=" "" ninja "${ninja}")
run(${ninja} -C ${WORK}/bch -t deps)
set(others eigen3|Eigen|assimp|fcl|xxhash|openmpi)
set(tasks tbb)
if(PARENT MATCHES "BCH_TASKS=(threads|none)")
  set(tasks xsimd)
  string(APPEND others |tbb)
endif()
if(NOT output MATCHES "/xsimd/" OR NOT output MATCHES "/${tasks}/")
  message(FATAL_ERROR "these are not the headers:\n${output}")
endif()
if(output MATCHES "[^\n]*/(${others})[^\n]*")
  message(FATAL_ERROR "the kernel reads ${CMAKE_MATCH_0}")
endif()

# The libraries that a program is linked to, used or not: TBB and what every C++ program has.
run(${CMAKE_COMMAND} -S ${SOURCE}/tests/examples/kernel_consumer -B ${WORK}/consumer ${settings}
  "-DCMAKE_CXX_FLAGS=${FLAGS}" -DCMAKE_BUILD_TYPE=Release -DCMAKE_EXE_LINKER_FLAGS=-Wl,--no-as-needed)
run(${CMAKE_COMMAND} --build ${WORK}/consumer)
expect_answers(${WORK}/consumer/answers)
run(${WORK}/consumer/footprints)
run(ldd ${WORK}/consumer/footprints)
if(NOT output MATCHES "libtbb\\.so" AND tasks STREQUAL "tbb")
  message(FATAL_ERROR "these are not the libraries:\n${output}")
endif()
string(REGEX MATCHALL "[^\n]+" libraries "${output}")
list(FILTER libraries EXCLUDE REGEX
  "^[ \t]*(linux-vdso|/.*/ld-linux[-a-z0-9_]*|lib(tbb|bch_kernel|bch_shapes|stdc\\+\\+|m|gcc_s|c|pthread|dl|rt))\\.so")
if(libraries)
  message(FATAL_ERROR "the kernel drags in more than TBB: ${libraries}")
endif()

# Who asks for more than there is reads why.
run_wrong("bch has no component 'characters'"
  ${CMAKE_COMMAND} -S ${SOURCE}/tests/examples/consumer -B ${WORK}/wrong_consumer ${settings})
run_wrong("import needs the component characters" ${CMAKE_COMMAND} ${parent} -DBCH_COMPONENTS=import)
