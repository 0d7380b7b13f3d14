# tubesight_add_commit(<target> <template>)
#
#   Adds to the target a source made of the template, in which @COMMIT@ stands for the commit of the
#   project's tree (see write_commit.cmake). Every build asks for the commit, so it is right after one
#   without configuring anew; only this one source is compiled when it has changed.

include_guard(GLOBAL)
set(TUBESIGHT_WRITE_COMMIT ${CMAKE_CURRENT_LIST_DIR}/write_commit.cmake)

function(tubesight_add_commit target template)
  cmake_path(GET template STEM LAST_ONLY name)  # commit.cpp.in -> commit.cpp
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${name})
  add_custom_target(${target}_commit
    COMMAND ${CMAKE_COMMAND} -DTREE=${PROJECT_SOURCE_DIR}
      -DTEMPLATE=${CMAKE_CURRENT_SOURCE_DIR}/${template} -DOUTPUT=${source}
      -P ${TUBESIGHT_WRITE_COMMIT}
    BYPRODUCTS ${source}
    COMMENT "Asking for the commit"
    VERBATIM)
  target_sources(${target} PRIVATE ${source})
  add_dependencies(${target} ${target}_commit)
  set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()
