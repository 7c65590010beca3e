# run(command...): runs it, ends the test with its output if it fails, and leaves the output in the caller's `output`.
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGV}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

# run_wrong(message command...): the same for a command that has to fail with the message, a regular expression.
function(run_wrong message)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  string(REGEX REPLACE "[ \n]+" " " output "${output}")  # CMake wraps its errors
  if(result EQUAL 0 OR NOT output MATCHES "${message}")
    message(FATAL_ERROR "not the error '${message}': ${ARGN}\n${result}\n${output}")
  endif()
endfunction()
