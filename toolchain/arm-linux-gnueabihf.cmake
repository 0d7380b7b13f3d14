# 32-bit Arm Linux with floating point in hardware (Debian's armhf).
set(CMAKE_SYSTEM_PROCESSOR arm)
set(CMAKE_LIBRARY_ARCHITECTURE arm-linux-gnueabihf)
set(CMAKE_C_FLAGS_INIT "-march=armv7-a+fp")
# Without a note for each call that GCC 6 passed otherwise: nothing here was built by it.
set(CMAKE_CXX_FLAGS_INIT "-march=armv7-a+fp -Wno-psabi")
set(board_emulator qemu-arm-static)
include(${CMAKE_CURRENT_LIST_DIR}/debian_board.cmake)
