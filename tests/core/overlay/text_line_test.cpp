#include "core/overlay/text_line.h"

#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace tubesight::core::overlay {
namespace {

std::string decimal(std::int64_t value, std::int32_t decimals) {
  TextLine line;
  return std::string(line.decimal(value, decimals).view());
}

std::string integer(std::int64_t value) {
  TextLine line;
  return std::string(line.integer(value).view());
}

TEST(TextLine, WritesWholeNumbers) {
  EXPECT_EQ(integer(0), "0");
  EXPECT_EQ(integer(-7), "-7");
  EXPECT_EQ(integer(1200), "1200");
  EXPECT_EQ(integer(std::numeric_limits<std::int64_t>::min()), "-9223372036854775808");
}

TEST(TextLine, WritesDecimalsWithLeadingZeros) {
  EXPECT_EQ(decimal(0, 2), "0.00");
  EXPECT_EQ(decimal(5, 2), "0.05");
  EXPECT_EQ(decimal(-5, 2), "-0.05");
  EXPECT_EQ(decimal(-1234, 3), "-1.234");
  EXPECT_EQ(decimal(600, 1), "60.0");
}

TEST(TextLine, JoinsWhatIsAppended) {
  TextLine line;

  line.words("offset ").decimal(55, 2).words(" mm, ").integer(-3);

  EXPECT_EQ(line.view(), "offset 0.55 mm, -3");
}

TEST(NearestQuotient, RoundsTiesAwayFromZero) {
  EXPECT_EQ(nearest_quotient(0, 10), 0);
  EXPECT_EQ(nearest_quotient(4, 10), 0);
  EXPECT_EQ(nearest_quotient(5, 10), 1);
  EXPECT_EQ(nearest_quotient(-4, 10), 0);
  EXPECT_EQ(nearest_quotient(-5, 10), -1);
  EXPECT_EQ(nearest_quotient(14, 10), 1);
  EXPECT_EQ(nearest_quotient(-16, 10), -2);
  EXPECT_EQ(nearest_quotient(4, 3), 1);
  EXPECT_EQ(nearest_quotient(5, 3), 2);
  EXPECT_EQ(nearest_quotient(-5, 3), -2);
  EXPECT_EQ(nearest_quotient(std::numeric_limits<std::int64_t>::max(), 2), std::int64_t{1} << 62);
}

TEST(TextLineDeathTest, RefusesToCutALine) {
  TextLine line;
  const std::string full(TextLine::kCapacity, 'x');
  line.words(full);

  EXPECT_EQ(line.view(), full);
  EXPECT_DEATH(line.integer(1), "");
}

}  // namespace
}  // namespace tubesight::core::overlay
