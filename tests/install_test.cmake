# Installs the build given by BUILD into a fresh folder, builds the project outside against it, and runs it.
# Usage: cmake -DBUILD=... -DCONSUMER=... -DWORK=... -DFLAGS=... -P install_test.cmake
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGV}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
run(${CMAKE_COMMAND} -S ${CONSUMER} -B ${WORK}/build -G Ninja -DCMAKE_PREFIX_PATH=${WORK}/prefix -DCMAKE_BUILD_TYPE=Release
  "-DCMAKE_CXX_FLAGS=${FLAGS}" -DCMAKE_CXX_COMPILER=${COMPILER})
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/example)
if(NOT output MATCHES "0 and 1 collide" OR NOT output MATCHES "2 and 3 pass")
  message(FATAL_ERROR "unexpected answers:\n${output}")
endif()
run(${WORK}/build/kernel_only)
run(ldd ${WORK}/build/kernel_only)
if(output MATCHES "assimp|polyclipping")
  message(FATAL_ERROR "the kernel drags in more than TBB:\n${output}")
endif()
