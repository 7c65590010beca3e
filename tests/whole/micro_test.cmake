# The benchmark programs start, find their own answers right, and name what they must. Nothing is timed.
set(sizes --poses=2 --pairs=200 --agents=300)

execute_process(COMMAND ${MICRO} ${sizes} --benchmark_min_time=0.0001 OUTPUT_VARIABLE output ERROR_VARIABLE output
  RESULT_VARIABLE code)
if(NOT code EQUAL 0 OR output MATCHES "ERROR OCCURRED")
  message(FATAL_ERROR "bch_micro: ${code}\n${output}")
endif()
foreach(workload colliding near_miss no_hit crowd paper500 paper500_cached)
  foreach(rest sse2/boundary/threads:1 scalar/solid/threads:1 reference/boundary/threads:1 obb_full/boundary/threads:1)
    if(NOT output MATCHES "collide/${workload}/${rest} [^\n]*false_positives=[^\n]*ns_per_pair=")
      message(FATAL_ERROR "bch_micro: no collide/${workload}/${rest}\n${output}")
    endif()
  endforeach()
endforeach()
foreach(query clearance time_of_impact)
  foreach(rest near_miss/sse2/threads:1 crowd/scalar/threads:1 crowd/reference/threads:1)
    if(NOT output MATCHES "${query}/${rest} [^\n]*ns_per_pair=")
      message(FATAL_ERROR "bch_micro: no ${query}/${rest}\n${output}")
    endif()
  endforeach()
endforeach()
foreach(benchmark contacts/colliding/sse2/threads:1 contacts/crowd/reference/threads:1 penetration/crowd/scalar/threads:1
    penetration/colliding/reference/threads:1 collide_all/crowd/sse2/threads:1)
  if(NOT output MATCHES "${benchmark} [^\n]*ns_per_pair=")
    message(FATAL_ERROR "bch_micro: no ${benchmark}\n${output}")
  endif()
endforeach()
foreach(stage skin outline hierarchy hierarchy_welzl levels interior all skin/2864 all/183296 shape_set obb_full single_cylinder)
  if(NOT output MATCHES "build/${stage} ")
    message(FATAL_ERROR "bch_micro: no build/${stage}\n${output}")
  endif()
endforeach()

foreach(part map read map_alone checksum_alone validation_alone)
  if(NOT output MATCHES "load/${part} ")
    message(FATAL_ERROR "bch_micro: no load/${part}\n${output}")
  endif()
endforeach()

execute_process(COMMAND ${RATIOS} ${sizes} --runs=1 --shapes=5000 OUTPUT_VARIABLE output ERROR_VARIABLE output RESULT_VARIABLE code)
if(NOT code EQUAL 0 OR NOT output MATCHES "colliding, solid: 200 pairs" OR NOT output MATCHES "OBB tree, outline \\| 4630" OR
    NOT output MATCHES "an agent of a crowd of 1 000 000" OR NOT output MATCHES "a pair among 5 000 shapes" OR NOT output MATCHES "sse2 [^\n]*at most 90" OR
    NOT output MATCHES "hierarchy over the same builder" OR NOT output MATCHES "183 296 " OR
    NOT output MATCHES "plan of a scene" OR NOT output MATCHES "clearance within 0.5 m, near_miss" OR NOT output MATCHES "time of impact within 0.5 s, crowd" OR
    NOT output MATCHES "collide_all  [^\n]*over collide's")
  message(FATAL_ERROR "bch_ratios: ${code}\n${output}")
endif()

foreach(program ${MICRO} ${RATIOS})
  execute_process(COMMAND ${program} --character=absent.glb OUTPUT_VARIABLE output ERROR_VARIABLE output
    RESULT_VARIABLE code TIMEOUT 600)
  if(code EQUAL 0 OR NOT output MATCHES "absent.glb")
    message(FATAL_ERROR "${program} does not name the file it cannot read: ${code}\n${output}")
  endif()
endforeach()
