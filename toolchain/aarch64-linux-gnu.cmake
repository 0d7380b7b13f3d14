# 64-bit Arm Linux (Debian's arm64).
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(CMAKE_LIBRARY_ARCHITECTURE aarch64-linux-gnu)
set(CMAKE_C_FLAGS_INIT "-march=armv8-a")
set(CMAKE_CXX_FLAGS_INIT "-march=armv8-a")
set(board_emulator qemu-aarch64-static)
include(${CMAKE_CURRENT_LIST_DIR}/debian_board.cmake)
