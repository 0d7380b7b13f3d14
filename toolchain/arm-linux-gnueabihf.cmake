# 32-bit Arm Linux with floating point in hardware (Debian's armhf), built on a Debian PC with its cross
# compiler and run there under emulation.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR arm)
set(CMAKE_LIBRARY_ARCHITECTURE arm-linux-gnueabihf)

set(CMAKE_C_COMPILER arm-linux-gnueabihf-gcc)
set(CMAKE_CXX_COMPILER arm-linux-gnueabihf-g++)
set(CMAKE_C_FLAGS_INIT "-march=armv7-a+fp")
# Without a note for each call that GCC 6 passed otherwise: nothing here was built by it.
set(CMAKE_CXX_FLAGS_INIT "-march=armv7-a+fp -Wno-psabi")

# Libraries and headers come from CMAKE_FIND_ROOT_PATH alone (the recipe debian_sysroot.sh makes such a
# folder), never from the PC's own; programs are the PC's.
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)

# Taken by every program that the build or ctest starts. A program's own path to the libraries holds for
# those that it names, not for what these need in turn.
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-arm-static -L /usr/arm-linux-gnueabihf
  -E LD_LIBRARY_PATH=${CMAKE_FIND_ROOT_PATH}/usr/lib/arm-linux-gnueabihf)
