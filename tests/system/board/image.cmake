# The box's image. Its scripts are tried here; the image itself is booted once in the arm64 stage, and in
# all its ways in `./test.sh long`.
set(here ${CMAKE_CURRENT_LIST_DIR})
find_package(Python3 3.9 REQUIRED COMPONENTS Interpreter)

if(NOT CMAKE_CROSSCOMPILING AND CMAKE_BUILD_TYPE MATCHES "^Rel")
  add_test(NAME board.image_parts COMMAND Python3::Interpreter -B ${here}/image_parts_test.py)
  set_tests_properties(board.image_parts PROPERTIES TIMEOUT 600)
  # With the package that package.sh builds.
  add_test(NAME board.image_long COMMAND Python3::Interpreter -B ${here}/image_test.py --long)
  set_tests_properties(board.image_long PROPERTIES LABELS "board;long" TIMEOUT 14400 RUN_SERIAL ON)
elseif(CMAKE_SYSTEM_PROCESSOR STREQUAL aarch64 AND TARGET tubesightd)
  add_test(NAME board.image COMMAND ${Python3_EXECUTABLE} -B ${here}/image_test.py
    --cpack ${CMAKE_CPACK_COMMAND} --build ${PROJECT_BINARY_DIR})
  set_tests_properties(board.image PROPERTIES LABELS board TIMEOUT 1500 COST 1000
    RESOURCE_LOCK steady_board)
endif()
