# bch_ratios starts and finds its own answers right; ratios.py runs it and prints what it must. Nothing is timed.
# Usage: cmake -DRATIOS=... -DSCRIPT=... -DPYTHON=... -DWORK=... -P ratios_test.cmake
set(sizes --poses=2 --pairs=200 --agents=300 --drafts)

# Runs a command, whose exit code has to be as expected. Sets output.
function(run expected)
  execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE code)
  if(NOT code EQUAL ${expected})
    message(FATAL_ERROR "exit code ${code}, where ${expected} is expected, of ${ARGN}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

function(expect_output)
  foreach(pattern IN LISTS ARGN)
    if(NOT output MATCHES "${pattern}")
      message(FATAL_ERROR "'${pattern}' is not in\n${output}")
    endif()
  endforeach()
endfunction()

set(script ${PYTHON} ${SCRIPT})
run(0 ${script} --program ${RATIOS} --runs 1 -- ${sizes} --benchmark_filter=-shapes/50000)
foreach(table kernel leaves stages peers calls crowd distances responses obstacles bodies shapes plans construction load paper)
  expect_output("# ${table}: 1 runs")
endforeach()
expect_output("collide/colliding: reference / discs/sse2 +[0-9.]+ x\n" "collide/crowd: reference_segments / segments/sse2 +[0-9.]+ x\n"
  "crowd/1000000/step#MiB +[0-9.]+\n" "shapes: 5000 / 200 +[0-9.]+ x" "shapes/50000 / shapes/200: not in this build" "construction/1/sse2( +[0-9.]+)+"
  "ns an item +map +read" "plans/mixed [^\n]*bytes" "tests a pair. +place +profiles" "plans: depth_3/query / all/query +[0-9.]+ x\n"
  "collisions/crowd/[a-z0-9]+ / collide/crowd" "obb_contour / reference +[0-9.]+ x +4630 ns")

# Here of what no table tells.
run(0 ${RATIOS} ${sizes} --benchmark_min_time=0.0001 --benchmark_filter=-^\(crowd|shapes|threads\)/)
set(names penetration/colliding/reference contacts/crowd/scalar collisions/crowd/sse2 load/read plans/all/bake
  construction/1/sse2/hierarchy)
foreach(workload colliding near_miss no_hit crowd candidates paper500 paper500_cached)
  list(APPEND names collide/${workload}/segments/sse2 collide/${workload}/discs/scalar
    collide/${workload}/obb_full collide/${workload}/reference_segments
    clearance/${workload}/reference within/${workload}/reference time_of_impact/${workload}/sse2)
endforeach()
foreach(name IN LISTS names)
  expect_output("${name} [^\n]*per_item=")
endforeach()

# Ratios of times that are given, medians or the least ones, and nothing else; wrong answers are an error.
function(write_times file more)
  set(benchmark "\"run_type\": \"iteration\", \"repetition_index\": 0")
  set(runs "")
  foreach(seconds 4e-8 1.5e-8 2e-8)
    string(APPEND runs "{\"run_name\": \"batches/16\", ${benchmark}, \"per_item\": ${seconds}${more}}, ")
  endforeach()
  file(WRITE ${WORK}/${file} "{\"benchmarks\": [${runs}{\"run_name\": \"batches/512\", ${benchmark}, \"per_item\": 1e-8}]}")
endfunction()
file(MAKE_DIRECTORY ${WORK})
write_times(times.json "")
write_times(wrong.json ", \"error_occurred\": true, \"error_message\": \"pair 7 is answered wrongly\"")
run(0 ${script} --json ${WORK}/times.json)
expect_output("batches: 16 / 512 +2.00 x\n" "threads/1 / threads/2: not in this build")
run(0 ${script} --json ${WORK}/times.json --min)
expect_output("batches: 16 / 512 +1.50 x\n")
run(1 ${script} --json ${WORK}/wrong.json)
expect_output("batches/16: pair 7 is answered wrongly")
run(0 ${script} --program ${RATIOS} --against ${RATIOS} --table bodies --runs 2)
expect_output("bodies/loop +[0-9 .]+ / +[0-9 .]+ ns +[0-9.]+ x" "mean [0-9.]+ x")

execute_process(COMMAND ${RATIOS} --character=absent.glb OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE code TIMEOUT 600)
if(code EQUAL 0 OR NOT output MATCHES "absent.glb")
  message(FATAL_ERROR "bch_ratios does not name the file that it cannot read: ${code}\n${output}")
endif()
