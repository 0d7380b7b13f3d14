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
#                      [TIMEOUT seconds] [COST seconds] [COMPUTES])
#
#     One GoogleTest program with GoogleTest's own main; each TEST becomes a ctest entry, found when
#     ctest runs, or the program is one entry (TUBESIGHT_WHOLE_PROGRAMS: where starting it costs).
#     COST: what takes ten seconds or more anywhere, that ctest begins with it; it need not be exact.
#     COMPUTES: compiled as the product is where a preset does not optimise tests. The linker takes the
#     first of like inline functions, which are the tests' own: the product, too, then runs at their level,
#     up to a hundred times slower where it computes with Eigen. Worth it where that outweighs compiling.
#     Label `native` keeps it out of the emulated arm64 run, `real_time` out of that under sanitizers,
#     `long` out of all but `./test.sh long`.
#
#   Tests may use two definitions: TUBESIGHT_TEST_DATA_DIR (tests/data) and TUBESIGHT_SOURCE_DIR.
#
# Consumers link the aliases only: tubesight::core_base, tubesight::hal, tubesight::drivers_files.

include_guard(GLOBAL)
include(GoogleTest)

# tubesight_join_sources(target) lets several sources of a target be compiled as one, where
# TUBESIGHT_JOIN_SOURCES says so for its kind. What parses and is not compiled again is most of the
# time: half of a build and more. join_sources.py says which sources may stand together.
function(tubesight_join_sources target)
  get_target_property(sources ${target} SOURCES)
  set(absolute)
  foreach(source IN LISTS sources)
    if(source MATCHES "\\.cpp$")
      get_target_property(folder ${target} SOURCE_DIR)
      cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${folder} NORMALIZE)
      list(APPEND absolute ${source})
    endif()
  endforeach()
  string(REPLACE ";" "\\;" absolute "${absolute}")
  set_property(GLOBAL APPEND PROPERTY TUBESIGHT_JOINED_SOURCES "${target}\t${absolute}")
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()

# When all targets are known.
function(tubesight_write_joined_sources)
  get_property(lines GLOBAL PROPERTY TUBESIGHT_JOINED_SOURCES)
  if(NOT lines)
    return()
  endif()
  set(text)
  foreach(line IN LISTS lines)
    string(APPEND text "${line}\n")
  endforeach()
  set(list ${PROJECT_BINARY_DIR}/joined_sources.txt)
  file(WRITE ${list} "${text}")
  execute_process(
    COMMAND ${Python3_EXECUTABLE} -B ${PROJECT_SOURCE_DIR}/toolchain/join_sources.py
      ${PROJECT_SOURCE_DIR} ${list} ${PROJECT_BINARY_DIR}/joined_sources.cmake
    COMMAND_ERROR_IS_FATAL ANY)
  include(${PROJECT_BINARY_DIR}/joined_sources.cmake)
endfunction()
if(TUBESIGHT_JOIN_SOURCES)
  cmake_language(DEFER DIRECTORY ${PROJECT_SOURCE_DIR} CALL tubesight_write_joined_sources)
endif()

# The compiler's answers are kept from one build to the next where ccache is at hand; not those that
# come with a second file (-fcallgraph-info) or with a precompiled header: ccache would lose them.
set(tubesight_launcher)
if(TUBESIGHT_USE_CCACHE AND NOT DEFINED CMAKE_CXX_COMPILER_LAUNCHER)
  find_program(TUBESIGHT_CCACHE ccache)
  if(TUBESIGHT_CCACHE)
    set(tubesight_launcher ${TUBESIGHT_CCACHE})
  endif()
endif()

# Some fifty programs are linked again after a change of core/base: lld does it in a fraction of the
# time, where it is installed. Only for the machine at hand. Not mold: that of Debian 12 (1.10)
# begins a program's read-only part at a thread-local variable, and where that lies before a page's
# end, the program cannot be started ("cannot apply additional memory protection").
if(TUBESIGHT_USE_LLD AND NOT CMAKE_CROSSCOMPILING)
  find_program(TUBESIGHT_LLD ld.lld)
  if(TUBESIGHT_LLD)
    add_link_options(-fuse-ld=lld)
  endif()
endif()

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

# What the box computes with: a twentieth fewer instructions a field than at -O2. All of core/, which shares a
# precompiled header: what is inlined from it is of the header's level. A preset for haste or for a
# debugger keeps its own.
set(tubesight_core_optimisation)
if("${CMAKE_BUILD_TYPE} ${CMAKE_CXX_FLAGS_RELWITHDEBINFO}" MATCHES "^RelWithDebInfo (.* )?-O2")
  set(tubesight_core_optimisation -O3)
endif()

# Release builds only: sanitizers enlarge every frame. The check `stack` reads the call graphs.
set(tubesight_tracking_path_options)
if(CMAKE_BUILD_TYPE MATCHES "^Rel" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  set(tubesight_tracking_path_options -Wframe-larger-than=4096 -fcallgraph-info=su)
endif()

# What nearly every source of the product includes, read once: compiled as core and drivers are, and as
# boards are. (tests/support/ has that of the tests.) Optimised, g++ 12 sees errors in a precompiled
# std::string that are none: there, drivers and boards do without.
function(tubesight_add_precompiled_headers)
  foreach(floor IN ITEMS core board)
    if(floor IN_LIST TUBESIGHT_PRECOMPILE_HEADERS)
      find_package(Eigen3 REQUIRED NO_MODULE)
      set(target tubesight_precompiled_${floor})
      set(source ${PROJECT_BINARY_DIR}/precompiled_${floor}.cpp)
      file(CONFIGURE OUTPUT ${source} CONTENT "// The headers are all there is.\n")
      add_library(${target} OBJECT ${source})
      target_precompile_headers(${target} PRIVATE ${PROJECT_SOURCE_DIR}/toolchain/precompiled_headers.h)
      target_link_libraries(${target} PRIVATE
        tubesight::warnings tubesight::build_options Eigen3::Eigen)
    endif()
  endforeach()
  if(TARGET tubesight_precompiled_core)
    target_compile_options(tubesight_precompiled_core PRIVATE
      -fno-exceptions -fno-rtti ${tubesight_core_warnings} ${tubesight_core_optimisation})
  endif()
endfunction()
tubesight_add_precompiled_headers()

# Each header must compile alone. The target `headers` sees to that, with a few headers a compilation
# (chain_headers.py says which may stand together); all_verify_interface_header_sets takes one at a time
# where TUBESIGHT_VERIFY_EVERY_HEADER says so. Called when all libraries are known.
function(tubesight_add_header_check)
  get_property(headers GLOBAL PROPERTY TUBESIGHT_HEADERS)
  get_property(libraries GLOBAL PROPERTY TUBESIGHT_LIBRARIES)
  list(JOIN headers "\n" lines)
  set(folder ${PROJECT_BINARY_DIR}/headers)
  file(WRITE ${folder}/headers.txt "${lines}\n")
  execute_process(
    COMMAND ${Python3_EXECUTABLE} -B ${PROJECT_SOURCE_DIR}/toolchain/chain_headers.py
      ${PROJECT_SOURCE_DIR} ${folder}/headers.txt ${folder}
    OUTPUT_VARIABLE number
    COMMAND_ERROR_IS_FATAL ANY)
  math(EXPR last "${number} - 1")
  set(sources)
  foreach(index RANGE ${last})
    list(APPEND sources ${folder}/headers_${index}.cpp)
  endforeach()
  add_library(headers OBJECT EXCLUDE_FROM_ALL ${sources})
  target_link_libraries(headers PRIVATE tubesight::build_options ${libraries})
  target_compile_options(headers PRIVATE -O0 -g0)
  if(tubesight_launcher)
    set_target_properties(headers PROPERTIES CXX_COMPILER_LAUNCHER ${tubesight_launcher})
  endif()
endfunction()

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
    if(folder MATCHES "^core/")
      target_compile_options(${target} PRIVATE ${tubesight_core_optimisation})
    endif()
    # What reads things from outside tells the fuzzers which way it went. All else would be compiled and
    # run slower for nobody.
    if(TUBESIGHT_BUILD_FUZZERS AND folder MATCHES "^(core/(base|session)|drivers|board/visionbox)(/|$)")
      target_compile_options(${target} PRIVATE
        -fsanitize-coverage=inline-8bit-counters,indirect-calls,trace-cmp,pc-table)
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
    list(TRANSFORM arg_HEADERS PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
    set_property(GLOBAL APPEND PROPERTY TUBESIGHT_HEADERS ${arg_HEADERS})
    set_property(GLOBAL APPEND PROPERTY TUBESIGHT_LIBRARIES ${target})
  endif()
  if(arg_SOURCES)
    if("product" IN_LIST TUBESIGHT_JOIN_SOURCES)
      tubesight_join_sources(${target})
    endif()
    string(REGEX MATCH "^[a-z]+" floor "${path}")
    if(floor IN_LIST TUBESIGHT_PRECOMPILE_HEADERS)
      string(REPLACE "drivers" "core" floor ${floor})
      target_precompile_headers(${target} REUSE_FROM tubesight_precompiled_${floor})
    elseif(tubesight_launcher AND NOT arg_TRACKING_PATH)
      set_target_properties(${target} PROPERTIES CXX_COMPILER_LAUNCHER ${tubesight_launcher})
    endif()
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
  cmake_parse_arguments(PARSE_ARGV 1 arg "COMPUTES" "TIMEOUT;COST" "SOURCES;LINKS;LABELS")
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
  set(options ${TUBESIGHT_TEST_OPTIONS})
  set(as_product FALSE)
  if(arg_COMPUTES AND "-O0" IN_LIST options)
    list(REMOVE_ITEM options -O0)
    set(as_product TRUE)
  endif()
  # The precompiled header is of the other tests' level.
  if("tests" IN_LIST TUBESIGHT_PRECOMPILE_HEADERS AND NOT as_product)
    target_precompile_headers(${name} REUSE_FROM tubesight_precompiled_tests)
    # In a precompiled std::string g++ 12 sees bounds trespassed that are none.
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
      target_compile_options(${name} PRIVATE
        -Wno-array-bounds -Wno-stringop-overflow -Wno-stringop-overread -Wno-restrict)
    endif()
  elseif(tubesight_launcher)
    set_target_properties(${name} PROPERTIES CXX_COMPILER_LAUNCHER ${tubesight_launcher})
  endif()
  if("tests" IN_LIST TUBESIGHT_JOIN_SOURCES)
    tubesight_join_sources(${name})
  endif()
  target_compile_options(${name} PRIVATE ${options})
  target_compile_definitions(${name} PRIVATE
    $<$<BOOL:${TUBESIGHT_TESTS_FIXED_ONLY}>:TUBESIGHT_TESTS_FIXED_ONLY>
    TUBESIGHT_SOURCE_DIR="${PROJECT_SOURCE_DIR}"
    TUBESIGHT_TEST_DATA_DIR="${PROJECT_SOURCE_DIR}/tests/data")
  foreach(source IN LISTS arg_SOURCES)
    cmake_path(ABSOLUTE_PATH source NORMALIZE OUTPUT_VARIABLE absolute)
    set_property(GLOBAL APPEND PROPERTY TUBESIGHT_TEST_SOURCES ${absolute})
  endforeach()
  set(cost)
  if(arg_COST)
    set(cost COST ${arg_COST})
  endif()
  set(properties TIMEOUT ${arg_TIMEOUT} ${cost})
  if(arg_LABELS)
    list(APPEND properties LABELS "${arg_LABELS}")
  endif()
  if(TUBESIGHT_WHOLE_PROGRAMS)
    # Twelve times the time of one: a program has many tests.
    math(EXPR timeout "12 * ${arg_TIMEOUT}")
    tubesight_add_whole_program(${name} ${name} "${TUBESIGHT_TESTS_LEFT_OUT}")
    set_tests_properties(${name} PROPERTIES ${properties} TIMEOUT ${timeout})
    return()
  endif()
  gtest_discover_tests(${name} DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60 NO_PRETTY_VALUES
    PROPERTIES ${properties})
  # The same for `./test.sh quick`: one process a program, without what takes a second or more.
  if(NOT arg_LABELS MATCHES "campaign|scenarios|statistics|long")
    tubesight_add_whole_program(quick.${name} ${name} @${PROJECT_SOURCE_DIR}/tests/slow_tests.txt)
    set_tests_properties(quick.${name} PROPERTIES LABELS quick ${cost})
    set_property(GLOBAL APPEND PROPERTY TUBESIGHT_QUICK_PROGRAMS ${name})
  endif()
endfunction()

# tubesight_add_whole_program(<name of the test> <program> <regular expression or @file of them>) runs
# a program once with all its tests but those named. scripts/ctest_summary.py counts them one by one.
function(tubesight_add_whole_program name program left_out)
  # Not by its target, which would be run under the emulator.
  add_test(NAME ${name}
    COMMAND ${Python3_EXECUTABLE} -B ${PROJECT_SOURCE_DIR}/scripts/run_test_program.py
      --results ${PROJECT_BINARY_DIR}/results/${name}.xml --leave-out "${left_out}" --
      ${CMAKE_CROSSCOMPILING_EMULATOR} $<TARGET_FILE:${program}>)
endfunction()
