# What the toolchains of boards share: Linux on an Arm processor, built on a Debian PC with its cross
# compiler and run there under emulation.
#
# Included by a toolchain that has set CMAKE_SYSTEM_PROCESSOR, the compilers' flags, and
#   CMAKE_LIBRARY_ARCHITECTURE     Debian's name of the machine, with which its compilers' names begin
#   board_emulator                 the program that runs the machine's programs
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_C_COMPILER ${CMAKE_LIBRARY_ARCHITECTURE}-gcc)
set(CMAKE_CXX_COMPILER ${CMAKE_LIBRARY_ARCHITECTURE}-g++)

# Libraries and headers come from CMAKE_FIND_ROOT_PATH alone (the recipe debian_sysroot.sh makes such a
# folder), never from the PC's own; programs are the PC's.
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)

# Taken by every program that the build or ctest starts. A program's own path to the libraries holds for
# those that it names, not for what these need in turn.
set(CMAKE_CROSSCOMPILING_EMULATOR ${board_emulator} -L /usr/${CMAKE_LIBRARY_ARCHITECTURE}
  -E LD_LIBRARY_PATH=${CMAKE_FIND_ROOT_PATH}/usr/lib/${CMAKE_LIBRARY_ARCHITECTURE})
