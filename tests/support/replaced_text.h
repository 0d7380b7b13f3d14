#pragma once

#include <string>

#include <gtest/gtest.h>

namespace tubesight::support {

/// The text with the first `what` in it replaced by `by`; fails the test where there is none.
[[nodiscard]] inline std::string replaced(std::string text, const std::string& what,
                                          const std::string& by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return at == std::string::npos ? text : text.replace(at, what.size(), by);
}

}  // namespace tubesight::support
