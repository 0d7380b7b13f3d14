#include "core/base/fnv1a.h"

#include <array>
#include <cstdint>
#include <string_view>

#include <gtest/gtest.h>

namespace tubesight::core {
namespace {

// Test vectors of the algorithm's authors (draft-eastlake-fnv).
TEST(Fnv1a, IsTheAlgorithmOfItsAuthors) {
  const auto of = [](std::string_view text) {
    Fnv1a digest;
    digest.add(text);
    return digest.value();
  };
  EXPECT_EQ(of(""), 0xcbf29ce484222325U);
  EXPECT_EQ(of("a"), 0xaf63dc4c8601ec8cU);
  EXPECT_EQ(of("foobar"), 0x85944171f73967e8U);
}

TEST(Fnv1a, TakesANumberAsItsBytesTheLowestFirst) {
  Fnv1a number;
  number.add(std::int64_t{0x0807060504030201});
  Fnv1a bytes;
  bytes.add(std::array<std::uint8_t, 8>{1, 2, 3, 4, 5, 6, 7, 8});
  EXPECT_EQ(number.value(), bytes.value());
}

TEST(Fnv1a, TakesANumberInOneStepAsAByteWhereItIsOne) {
  Fnv1a step;
  step.step('a');
  Fnv1a byte;
  byte.add("a");
  EXPECT_EQ(step.value(), byte.value());
  step.step(0x1234);
  byte.add(std::int64_t{0x1234});
  EXPECT_NE(step.value(), byte.value());
}

}  // namespace
}  // namespace tubesight::core
