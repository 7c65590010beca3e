# Installs the build given by BUILD into a fresh folder WORK, builds the projects outside against it, and runs them.
# Usage: cmake -DBUILD=... -DTESTS=... -DWORK=... -DCOMPILER=... -DFLAGS=... -P install_test.cmake
include(${CMAKE_CURRENT_LIST_DIR}/run.cmake)

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
foreach(project consumer kernel_consumer)
  run(${CMAKE_COMMAND} -S ${TESTS}/${project} -B ${WORK}/${project} -G Ninja -DCMAKE_PREFIX_PATH=${WORK}/prefix
    -DCMAKE_BUILD_TYPE=Release "-DCMAKE_CXX_FLAGS=${FLAGS}" -DCMAKE_CXX_COMPILER=${COMPILER}
    -DCMAKE_EXE_LINKER_FLAGS=-Wl,--no-as-needed)  # ldd is to show what is linked, used or not
  run(${CMAKE_COMMAND} --build ${WORK}/${project})
endforeach()
run(${WORK}/consumer/example)
if(NOT output MATCHES "0 and 1 collide" OR NOT output MATCHES "2 and 3 pass")
  message(FATAL_ERROR "unexpected answers:\n${output}")
endif()
run(${WORK}/consumer/crowd_step)
message(STATUS "${output}")
if(NOT output MATCHES "cylinders: .*none after.*hierarchies: .*none after")
  message(FATAL_ERROR "a crowd that is not pushed apart:\n${output}")
endif()
run(${WORK}/consumer/continuous_motion)
message(STATUS "${output}")
if(NOT output MATCHES "discrete: .* [1-9][0-9]* times.*continuous: .* 0 times")
  message(FATAL_ERROR "a crowd that walks through itself:\n${output}")
endif()
foreach(program consumer/baked kernel_consumer/kernel_only)
  run(${WORK}/${program})
  run(ldd ${WORK}/${program})
  if(output MATCHES "assimp|polyclipping|xxhash")
    message(FATAL_ERROR "${program} drags in more than TBB:\n${output}")
  endif()
endforeach()
