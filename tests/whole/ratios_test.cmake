# bch_ratios starts, finds its own answers right, and prints what it must. Nothing is timed.
set(sizes --poses=2 --pairs=200 --agents=300)

execute_process(COMMAND ${RATIOS} ${sizes} --runs=1 --shapes=5000 OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE code)
if(NOT code EQUAL 0 OR NOT output MATCHES "colliding, solid: 200 pairs" OR NOT output MATCHES "OBB tree, outline \\| 4630" OR
    NOT output MATCHES "an agent of a crowd of 1 000 000" OR NOT output MATCHES "a pair among 5 000 shapes" OR NOT output MATCHES "sse2 [^\n]*at most 90" OR
    NOT output MATCHES "hierarchy over the same builder" OR NOT output MATCHES "183 296 " OR NOT output MATCHES "map_alone" OR
    NOT output MATCHES "plan of a scene" OR NOT output MATCHES "clearance within 0.5 m, near_miss" OR NOT output MATCHES "whether within 0.1 m, crowd" OR NOT output MATCHES "time of impact within 0.5 s, crowd" OR
    NOT output MATCHES "collide_all  [^\n]*over collide's" OR NOT output MATCHES "300 agents on a floor")
  message(FATAL_ERROR "bch_ratios: ${code}\n${output}")
endif()

# With an option of Google Benchmark's its own report: here of what no table tells.
execute_process(COMMAND ${RATIOS} ${sizes} --runs=1 --benchmark_min_time=0.0001 --benchmark_filter=-^\(check|crowd|growth|motions|shapes|threads\)/
  OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE code)
if(NOT code EQUAL 0 OR output MATCHES "ERROR OCCURRED")
  message(FATAL_ERROR "bch_ratios: ${code}\n${output}")
endif()
set(names penetration/colliding/reference contacts/crowd/scalar collide_all/crowd/sse2 load/checksum_alone plans/3/bake
  construction/1/sse2/hierarchy_welzl)
foreach(workload colliding near_miss no_hit crowd candidates paper500 paper500_cached)
  list(APPEND names collide/${workload}/boundary/segments/sse2 collide/${workload}/solid/discs/scalar
    collide/${workload}/boundary/obb_full clearance/${workload}/reference within/${workload}/reference time_of_impact/${workload}/sse2)
endforeach()
foreach(name IN LISTS names)
  if(NOT output MATCHES "${name} [^\n]*per_item=")
    message(FATAL_ERROR "bch_ratios: no ${name}\n${output}")
  endif()
endforeach()

execute_process(COMMAND ${RATIOS} --character=absent.glb OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE code TIMEOUT 600)
if(code EQUAL 0 OR NOT output MATCHES "absent.glb")
  message(FATAL_ERROR "bch_ratios does not name the file that it cannot read: ${code}\n${output}")
endif()
