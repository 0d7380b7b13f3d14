#include "drivers/files/decimal.h"

#include <limits>
#include <string>

#include <gtest/gtest.h>

namespace tubesight::drivers {
namespace {

std::string decimal(std::int64_t numerator, std::int64_t denominator, std::int32_t digits) {
  std::string text;
  append_decimal(text, numerator, denominator, digits);
  return text;
}

TEST(AppendDecimal, RoundsHalfAwayFromZero) {
  EXPECT_EQ(decimal(5, 10000, 3), "0.001");  // 0.0005
  EXPECT_EQ(decimal(-5, 10000, 3), "-0.001");
  EXPECT_EQ(decimal(4999, 10000000, 3), "0.000");
  EXPECT_EQ(decimal(25, 10, 0), "3");
  EXPECT_EQ(decimal(-25, 10, 0), "-3");
  EXPECT_EQ(decimal(1, 3, 4), "0.3333");
  EXPECT_EQ(decimal(2, 3, 4), "0.6667");
}

TEST(AppendDecimal, CarriesIntoTheWholePart) {
  EXPECT_EQ(decimal(99996, 100000, 4), "1.0000");
  EXPECT_EQ(decimal(-1999999, 1000000, 3), "-2.000");
}

TEST(AppendDecimal, GivesZeroNoSign) {
  EXPECT_EQ(decimal(-1, 100000, 3), "0.000");
  EXPECT_EQ(decimal(0, 1, 2), "0.00");
}

TEST(AppendDecimal, ServesTheLimits) {
  EXPECT_EQ(decimal(std::numeric_limits<std::int64_t>::min(), 1, 0), "-9223372036854775808");
  EXPECT_EQ(decimal(std::numeric_limits<std::int64_t>::max(), 1000000000, 9),
            "9223372036.854775807");
  EXPECT_EQ(decimal(999999999, 1000000000, 9), "0.999999999");
}

TEST(AppendDecimal, PrintsThirtiethsOfASecond) {
  EXPECT_EQ(decimal(16666667, 1000000000, 6), "0.016667");
  EXPECT_EQ(decimal(3083333333, 1000000000, 6), "3.083333");
}

TEST(RoundedText, HasSoManySignificantDigits) {
  EXPECT_EQ(rounded_text(1234.56), "1235");
  EXPECT_EQ(rounded_text(0.0123456), "0.01235");
  EXPECT_EQ(rounded_text(-25.40049, 5), "-25.4");
  EXPECT_EQ(rounded_text(123456.0, 5), "1.2346e+05");
}

TEST(Print, AppendsAsPrintfWrites) {
  std::string text = "a";
  print(text, " %d %.2f %s", 7, 0.125, "b");
  EXPECT_EQ(text, "a 7 0.12 b");
}

TEST(ParseDecimal, ReadsExactly) {
  std::int64_t value = 0;

  EXPECT_TRUE(parse_decimal("12.5", 9, value));
  EXPECT_EQ(value, 12500000000);
  EXPECT_TRUE(parse_decimal("-0.016667", 9, value));
  EXPECT_EQ(value, -16667000);
  EXPECT_TRUE(parse_decimal(".5", 1, value));
  EXPECT_EQ(value, 5);
  EXPECT_TRUE(parse_decimal("7.", 2, value));
  EXPECT_EQ(value, 700);
  EXPECT_TRUE(parse_decimal("1.2500", 2, value));
  EXPECT_EQ(value, 125);
  EXPECT_TRUE(parse_decimal("9223372036.854775807", 9, value));
  EXPECT_EQ(value, std::numeric_limits<std::int64_t>::max());
}

TEST(ParseDecimal, RefusesEverythingElse) {
  std::int64_t value = 42;
  for (const char* const text : {"", "-", ".", "1e3", " 1", "1,5", "1.2.3", "+1", "nan", "1.234",
                                 "92233720368547758.08", "99999999999999999999"}) {
    EXPECT_FALSE(parse_decimal(text, 2, value)) << text;
  }
  EXPECT_EQ(value, 42);
}

TEST(Print, CutsOffWhatIsLongerThanItsBuffer) {
  std::string out;

  print(out, "%s", std::string(600, 'x').c_str());

  EXPECT_EQ(out, std::string(499, 'x'));
}

}  // namespace
}  // namespace tubesight::drivers
