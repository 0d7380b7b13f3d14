// Empty: CMake hangs the precompiled header on a source.
