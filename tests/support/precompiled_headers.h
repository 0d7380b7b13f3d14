// What nearly every test includes: read once, not once a test (TUBESIGHT_PRECOMPILE_HEADERS).
// Optimised, g++ 12 sees errors in a precompiled std::string that are none: preset bench-long
// compiles each test without this, and with all warnings.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <memory>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <gtest/gtest.h>
