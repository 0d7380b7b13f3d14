# The machine at hand, with Debian's compiler. No CPU flags: the baseline of the architecture, so that
# a result does not depend on which PC made it.
set(CMAKE_C_COMPILER gcc)
set(CMAKE_CXX_COMPILER g++)
