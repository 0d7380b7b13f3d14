# Writes a source that tells the commit of a tree; leaves it alone when nothing has changed, so that
# only then something is compiled.
#
# cmake -DTREE=<folder> -DTEMPLATE=<file> -DOUTPUT=<file> -P write_commit.cmake
#
# In the template, @COMMIT@ stands for what `git describe` says, or "unknown": where there is no git, no
# repository (a source archive), or one that is not the tree's own but lies around it.
cmake_minimum_required(VERSION 3.25)

set(COMMIT unknown)
if(EXISTS ${TREE}/.git)
  # No lock is taken: a build must not get into the way of a commit. No variables of git: a build that
  # a hook starts would ask another repository. Without tags, as in a shallow clone, the hash is told.
  execute_process(
    COMMAND ${CMAKE_COMMAND} -E env --unset=GIT_DIR --unset=GIT_WORK_TREE --unset=GIT_INDEX_FILE
      git --no-optional-locks describe --always --dirty --abbrev=12
    WORKING_DIRECTORY ${TREE}
    OUTPUT_VARIABLE described
    OUTPUT_STRIP_TRAILING_WHITESPACE
    ERROR_QUIET
    RESULT_VARIABLE status)
  if(status EQUAL 0 AND described MATCHES "^[A-Za-z0-9._/+-]+$")
    set(COMMIT ${described})
  endif()
endif()
configure_file(${TEMPLATE} ${OUTPUT} @ONLY)
