#pragma once

#include <array>
#include <cstddef>
#include <cstdio>
#include <string>

#include <gtest/gtest.h>

namespace tubesight::tests {

/// The three numbers of `key` in the text of a settings file. Fails the test where they are not
/// there.
[[nodiscard]] inline std::array<double, 3> list_of(const std::string& settings,
                                                   const std::string& key) {
  std::array<double, 3> values{};
  const std::size_t at = settings.find(key + " = [");
  EXPECT_NE(at, std::string::npos) << key;
  if (at != std::string::npos) {
    EXPECT_EQ(std::sscanf(settings.c_str() + at + key.size() + 4, "%lf, %lf, %lf", &values[0],
                          &values[1], &values[2]),
              3);
  }
  return values;
}

}  // namespace tubesight::tests
