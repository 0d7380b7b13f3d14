// What nearly every test includes: read once, not once a test, under the sanitizers (where
// TUBESIGHT_PRECOMPILE_TEST_HEADERS says so). Optimised, g++ 12 sees errors in a precompiled
// std::string that are none: preset bench compiles each test without this, and with all warnings.
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
