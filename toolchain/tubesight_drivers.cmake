# Which boards and drivers are built, and how the libraries that they stand on are looked for.
#
#   tubesight_add_boards()                  # TUBESIGHT_BOARDS: each board/<name>
#   tubesight_need_drivers(<driver>...)     # "files settings"
#
#     Said by whoever links tubesight::drivers_<driver>: a board, another driver, the fuzzers. Only
#     drivers that somebody needs are configured, so only their libraries must be there.
#
#   tubesight_add_needed_drivers()          # each drivers/<name>, after all that need some
#
#   tubesight_find_package(<package> DEBIAN <name> [arguments of find_package])
#   tubesight_find_header(<VARIABLE> <header> DEBIAN <name> [arguments of find_path])
#
#     A library or the folder of a header; where there is none, an error that names Debian's package
#     and who needs it.

include_guard(GLOBAL)

set(TUBESIGHT_BOARDS "bench;visionbox" CACHE STRING "Boards to build, folders of board/ (box always is)")
set(TUBESIGHT_DRIVERS "" CACHE STRING
  "Drivers to build, folders of drivers/, beside those that the boards need")

define_property(GLOBAL PROPERTY TUBESIGHT_NEEDED_DRIVERS
  BRIEF_DOCS "Drivers that somebody needs, each once")

# A missing folder is an error: a build that passes over it would leave its tests out silently.
function(_tubesight_require_folder folder who)
  if(NOT EXISTS ${PROJECT_SOURCE_DIR}/${folder}/CMakeLists.txt)
    message(FATAL_ERROR "${who}: there is no ${folder}/CMakeLists.txt")
  endif()
endfunction()

# Where we are in the tree, to be named in messages.
function(_tubesight_here result)
  file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
  set(${result} "${folder}" PARENT_SCOPE)
endfunction()

function(tubesight_add_boards)
  foreach(board IN LISTS TUBESIGHT_BOARDS)
    if(board STREQUAL "box")
      message(FATAL_ERROR "TUBESIGHT_BOARDS names 'box', which all boards share: it is always built")
    endif()
    _tubesight_require_folder(board/${board} "TUBESIGHT_BOARDS names '${board}'")
    add_subdirectory(board/${board})
  endforeach()
endfunction()

function(tubesight_need_drivers)
  _tubesight_here(who)
  if(NOT who)
    set(who TUBESIGHT_DRIVERS)
  endif()
  foreach(driver IN LISTS ARGN)
    _tubesight_require_folder(drivers/${driver} "${who} needs the driver '${driver}'")
    get_property(needed GLOBAL PROPERTY TUBESIGHT_NEEDED_DRIVERS)
    if(NOT driver IN_LIST needed)
      set_property(GLOBAL APPEND PROPERTY TUBESIGHT_NEEDED_DRIVERS ${driver})
    endif()
    set_property(GLOBAL APPEND PROPERTY TUBESIGHT_WHO_NEEDS_drivers/${driver} ${who})
  endforeach()
endfunction()

function(tubesight_add_needed_drivers)
  set(next 0)
  while(TRUE)
    # Drivers may ask for others while they are added.
    get_property(needed GLOBAL PROPERTY TUBESIGHT_NEEDED_DRIVERS)
    list(LENGTH needed number)
    if(next EQUAL number)
      break()
    endif()
    list(GET needed ${next} driver)
    add_subdirectory(drivers/${driver})
    math(EXPR next "${next} + 1")
  endwhile()
endfunction()

function(_tubesight_missing_library what debian)
  _tubesight_here(who)
  get_property(needed_by GLOBAL PROPERTY TUBESIGHT_WHO_NEEDS_${who})
  if(needed_by)
    list(REMOVE_DUPLICATES needed_by)
    list(JOIN needed_by ", " needed_by)
    string(APPEND who " (needed by ${needed_by})")
  endif()
  if(CMAKE_CROSSCOMPILING)
    set(where "in CMAKE_FIND_ROOT_PATH, where toolchain/ has a recipe of the sysroot")
  else()
    set(where "on this machine")
  endif()
  message(FATAL_ERROR
    "${who}: ${what} was not found ${where}; Debian's package is ${debian}")
endfunction()

# A macro: what find_package() sets belongs to the caller.
macro(tubesight_find_package package)
  cmake_parse_arguments(_tubesight_find "" "DEBIAN" "" ${ARGN})
  find_package(${package} ${_tubesight_find_UNPARSED_ARGUMENTS} QUIET)
  if(NOT ${package}_FOUND)
    _tubesight_missing_library(${package} ${_tubesight_find_DEBIAN})
  endif()
endmacro()

function(tubesight_find_header variable header)
  cmake_parse_arguments(PARSE_ARGV 2 arg "" "DEBIAN" "")
  find_path(${variable} ${header} ${arg_UNPARSED_ARGUMENTS})
  if(NOT ${variable})
    _tubesight_missing_library(${header} ${arg_DEBIAN})
  endif()
endfunction()
