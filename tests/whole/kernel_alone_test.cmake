# Builds SOURCE as a subproject without components, where no package but TBB can be found and by a parent whose flags break
# arithmetic; installs it, and builds a program against that. The subproject's answers are those of the program ANSWERS.
# Usage: cmake -DSOURCE=... -DWORK=... -DCOMPILER=... -DFLAGS=... -DANSWERS=... -P kernel_alone_test.cmake
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)

set(settings -G Ninja -DCMAKE_UNITY_BUILD=ON -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_PREFIX_PATH=${WORK}/prefix)
set(alone -DBCH_XXHASH_INCLUDE_DIR=/nonexistent -DBCH_COMPONENTS=)
foreach(package Eigen3 PkgConfig fcl CLI11 nlohmann_json fmt benchmark GTest)
  list(APPEND alone -DCMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
endforeach()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} -S ${SOURCE}/tests/examples/subproject -B ${WORK}/bch -DBCH_SOURCE=${SOURCE} ${settings} ${alone}
  "-DCMAKE_CXX_FLAGS=${FLAGS} -O1 -ffast-math -march=native")
foreach(unused BCH_XXHASH_INCLUDE_DIR CMAKE_DISABLE_FIND_PACKAGE_Eigen3 CMAKE_DISABLE_FIND_PACKAGE_PkgConfig)
  if(NOT output MATCHES "were not used by the project:.*${unused}")  # as CMake warns
    message(FATAL_ERROR "something looked at ${unused}:\n${output}")
  endif()
endforeach()
run(${CMAKE_COMMAND} --build ${WORK}/bch)
run(${CMAKE_COMMAND} --install ${WORK}/bch --prefix ${WORK}/prefix)
run(${ANSWERS})
set(expected "${output}")
run(${WORK}/bch/answers)
if(NOT output STREQUAL expected)
  message(FATAL_ERROR "the parent's flags change answers:\n${output}expected:\n${expected}")
endif()

# Where such flags are not undone, nothing compiles.
run_wrong("need IEEE arithmetic" ${COMPILER} -std=c++20 -Ofast -I${SOURCE} -fsyntax-only -x c++ ${SOURCE}/layout/base/rounding.hpp)

# Every header that was read, whether or not a target asked for its folder.
file(STRINGS ${WORK}/bch/CMakeCache.txt ninja REGEX "^CMAKE_MAKE_PROGRAM:")
string(REGEX REPLACE "^[^=]*=" "" ninja "${ninja}")
run(${ninja} -C ${WORK}/bch -t deps)
if(NOT output MATCHES "/xsimd/" OR NOT output MATCHES "/tbb/")
  message(FATAL_ERROR "these are not the headers:\n${output}")
endif()
if(output MATCHES "[^\n]*/(eigen3|Eigen|assimp|fcl|xxhash|openmpi)[^\n]*")
  message(FATAL_ERROR "the kernel reads ${CMAKE_MATCH_0}")
endif()

# The libraries that a program is linked to, used or not: TBB and what every C++ program has.
run(${CMAKE_COMMAND} -S ${SOURCE}/tests/examples/kernel_consumer -B ${WORK}/consumer ${settings}
  -DCMAKE_EXE_LINKER_FLAGS=-Wl,--no-as-needed)
run(${CMAKE_COMMAND} --build ${WORK}/consumer)
run(${WORK}/consumer/footprints)
run(ldd ${WORK}/consumer/footprints)
if(NOT output MATCHES "libtbb\\.so")
  message(FATAL_ERROR "these are not the libraries:\n${output}")
endif()
string(REGEX MATCHALL "[^\n]+" libraries "${output}")
list(FILTER libraries EXCLUDE REGEX
  "^[ \t]*(linux-vdso|/.*/ld-linux[-a-z0-9_]*|lib(tbb|stdc\\+\\+|m|gcc_s|c|pthread|dl|rt))\\.so")
if(libraries)
  message(FATAL_ERROR "the kernel drags in more than TBB: ${libraries}")
endif()

# Who asks for more than there is reads why.
run_wrong("bch has no component 'characters'"
  ${CMAKE_COMMAND} -S ${SOURCE}/tests/examples/consumer -B ${WORK}/wrong_consumer ${settings})
run_wrong("import needs the component characters"
  ${CMAKE_COMMAND} -S ${SOURCE}/tests/examples/subproject -B ${WORK}/bch -DBCH_COMPONENTS=import)
