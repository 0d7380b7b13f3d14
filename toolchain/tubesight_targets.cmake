# Helpers that every folder's CMakeLists.txt uses, and the two interface targets behind them.
#
#   tubesight_add_library(<path>                 # "core/base" -> target tubesight_core_base,
#                         SOURCES a.cpp b.cpp    #   alias tubesight::core_base
#                         HEADERS a.h b.h        # all headers, relative to the folder (FILE_SET)
#                         LINKS tubesight::...   # what the headers need too (PUBLIC)
#                         PRIVATE_LINKS ...      # what only the sources need
#                         [TRACKING_PATH]        # no heap, no throw, frames <= 4096 bytes
#                         [NO_HEAP])             # no heap, no throw
#
#     A static library, or an interface library when SOURCES is left out. Folders under core/, hal/
#     and drivers/ are compiled without exceptions and RTTI. TRACKING_PATH also registers the folder
#     with the checks `symbols`, `no_float` and `stack` (tests/checks/), NO_HEAP with `symbols` alone.
#
#   tubesight_add_program(<name> SOURCES ... [HEADERS ...] LINKS ...)
#
#     A program, written to <build>/bin/<name>.
#
#   tubesight_add_test(<name> SOURCES x_test.cpp ... LINKS tubesight::... [LABELS ...]
#                      [TIMEOUT seconds])
#
#     One GoogleTest program with GoogleTest's own main; each TEST becomes a ctest entry, found when
#     ctest runs. Label `native` keeps it out of the emulated arm64 run.
#
#   Tests may use two definitions: TUBESIGHT_TEST_DATA_DIR (tests/data) and TUBESIGHT_SOURCE_DIR.
#
# Consumers link the aliases only: tubesight::core_base, tubesight::hal, tubesight::drivers_files.

include_guard(GLOBAL)
include(GoogleTest)

define_property(GLOBAL PROPERTY TUBESIGHT_TRACKING_PATH_TARGETS
  BRIEF_DOCS "Libraries that lie on the path field -> sighting -> reply")
define_property(GLOBAL PROPERTY TUBESIGHT_TRACKING_PATH_SOURCES
  BRIEF_DOCS "Absolute names of the sources of those libraries")
define_property(GLOBAL PROPERTY TUBESIGHT_NO_HEAP_TARGETS
  BRIEF_DOCS "Further libraries that may not ask for memory")
define_property(GLOBAL PROPERTY TUBESIGHT_TEST_SOURCES
  BRIEF_DOCS "Absolute names of the sources known to ctest")

# --- How everything of ours is compiled, here and in whoever links it ------------------------------

add_library(tubesight_build_options INTERFACE)
add_library(tubesight::build_options ALIAS tubesight_build_options)
target_compile_features(tubesight_build_options INTERFACE cxx_std_20)
target_include_directories(tubesight_build_options INTERFACE ${PROJECT_SOURCE_DIR})
# aarch64 would fuse multiply-add and Eigen would sum in packets of another width there: then bench
# and box differ in the last bit. Eigen's setting is also part of the layout of its types, so it must
# be the same in every file that is linked together.
target_compile_options(tubesight_build_options INTERFACE -ffp-contract=off)
target_compile_definitions(tubesight_build_options INTERFACE EIGEN_DONT_VECTORIZE EIGEN_MPL2_ONLY)

# --- Warnings, linked PRIVATE ----------------------------------------------------------------------

add_library(tubesight_warnings INTERFACE)
add_library(tubesight::warnings ALIAS tubesight_warnings)
target_compile_options(tubesight_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wdouble-promotion -Wshadow
  -Wold-style-cast -Wnon-virtual-dtor -Woverloaded-virtual -Wundef -Wcast-align
  # clang's -Wconversion minds TUBESIGHT_ASSERT(!"reason").
  $<$<CXX_COMPILER_ID:Clang>:-Wno-string-conversion>)
# Not for boards and tests: they use std::string, in whose move constructor g++ 12 sees a null pointer
# at -O2 that is none.
set(tubesight_core_warnings -Wnull-dereference)

# Release builds only: sanitizers enlarge every frame. The check `stack` reads the call graphs.
set(tubesight_tracking_path_options)
if(CMAKE_BUILD_TYPE MATCHES "^Rel" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  set(tubesight_tracking_path_options -Wframe-larger-than=4096 -fcallgraph-info=su)
endif()

function(tubesight_add_library path)
  cmake_parse_arguments(PARSE_ARGV 1 arg "TRACKING_PATH;NO_HEAP" ""
    "SOURCES;HEADERS;LINKS;PRIVATE_LINKS")
  if(DEFINED arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "tubesight_add_library(${path}): unknown '${arg_UNPARSED_ARGUMENTS}'")
  endif()
  string(REPLACE "/" "_" name "${path}")
  set(target tubesight_${name})

  if(arg_SOURCES)
    add_library(${target} STATIC ${arg_SOURCES})
    set(scope PUBLIC)
    target_link_libraries(${target} PRIVATE tubesight::warnings ${arg_PRIVATE_LINKS})
    file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR} ${CMAKE_CURRENT_SOURCE_DIR})
    if(folder MATCHES "^(core|hal|drivers)(/|$)")
      target_compile_options(${target} PRIVATE
        -fno-exceptions -fno-rtti ${tubesight_core_warnings})
    endif()
  else()
    add_library(${target} INTERFACE)
    set(scope INTERFACE)
  endif()
  add_library(tubesight::${name} ALIAS ${target})
  target_link_libraries(${target} ${scope} tubesight::build_options ${arg_LINKS})
  if(arg_HEADERS)
    target_sources(${target} ${scope}
      FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${arg_HEADERS})
  endif()

  if(arg_NO_HEAP AND arg_SOURCES)
    set_property(GLOBAL APPEND PROPERTY TUBESIGHT_NO_HEAP_TARGETS ${target})
  endif()
  if(arg_TRACKING_PATH)
    # A library of headers only has no object to scan.
    if(arg_SOURCES)
      target_compile_options(${target} PRIVATE ${tubesight_tracking_path_options})
      set_property(GLOBAL APPEND PROPERTY TUBESIGHT_TRACKING_PATH_TARGETS ${target})
      foreach(source IN LISTS arg_SOURCES)
        set_property(GLOBAL APPEND PROPERTY TUBESIGHT_TRACKING_PATH_SOURCES
          ${CMAKE_CURRENT_SOURCE_DIR}/${source})
      endforeach()
    endif()
  endif()
endfunction()

function(tubesight_add_program name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "" "SOURCES;HEADERS;LINKS")
  if(DEFINED arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "tubesight_add_program(${name}): unknown '${arg_UNPARSED_ARGUMENTS}'")
  endif()
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE
    tubesight::warnings tubesight::build_options ${arg_LINKS})
  if(arg_HEADERS)
    target_sources(${name} PRIVATE
      FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${arg_HEADERS})
  endif()
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)
endfunction()

function(tubesight_add_test name)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "TIMEOUT" "SOURCES;LINKS;LABELS")
  if(DEFINED arg_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "tubesight_add_test(${name}): unknown '${arg_UNPARSED_ARGUMENTS}'")
  endif()
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 300)
  endif()
  # Tests that a preset leaves out by their label need not be compiled there.
  foreach(label IN LISTS arg_LABELS)
    if(label IN_LIST TUBESIGHT_LABELS_NOT_BUILT)
      return()
    endif()
  endforeach()
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE
    tubesight::warnings tubesight::build_options ${arg_LINKS} GTest::gtest_main)
  if(TUBESIGHT_PRECOMPILE_TEST_HEADERS)
    target_precompile_headers(${name} REUSE_FROM tubesight_precompiled_headers)
    # In a precompiled std::string g++ 12 sees bounds trespassed that are none.
    target_compile_options(${name} PRIVATE -Wno-array-bounds)
  endif()
  target_compile_definitions(${name} PRIVATE
    TUBESIGHT_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
    TUBESIGHT_TEST_DATA_DIR="${PROJECT_SOURCE_DIR}/tests/data")
  foreach(source IN LISTS arg_SOURCES)
    cmake_path(ABSOLUTE_PATH source NORMALIZE OUTPUT_VARIABLE absolute)
    set_property(GLOBAL APPEND PROPERTY TUBESIGHT_TEST_SOURCES ${absolute})
  endforeach()
  set(properties TIMEOUT ${arg_TIMEOUT})
  if(arg_LABELS)
    list(APPEND properties LABELS "${arg_LABELS}")
  endif()
  gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60 NO_PRETTY_VALUES
    PROPERTIES ${properties})
endfunction()
