#include "drivers/aravis/grey_format.h"

#include <array>
#include <cstddef>
#include <vector>

#include <gtest/gtest.h>

namespace tubesight::tests {
namespace {

std::vector<int> extracted(const char* format, std::vector<unsigned> bytes, std::int32_t width_px) {
  std::vector<std::byte> from;
  for (const unsigned byte : bytes) {
    from.push_back(static_cast<std::byte>(byte));
  }
  std::vector<std::uint8_t> to(static_cast<std::size_t>(width_px), 7);
  drivers::aravis::extract_line(*drivers::aravis::grey_format_named(format), from.data(), width_px,
                                to.data());
  return {to.begin(), to.end()};
}

// Values by hand, from the figures of the standards.
TEST(GreyFormat, WordsGiveTheirUpperBits) {
  EXPECT_EQ(extracted("Mono10", {0xff, 0x03, 0x04, 0x00, 0x00, 0x02}, 3),
            (std::vector<int>{255, 1, 128}));
  EXPECT_EQ(extracted("Mono12", {0xff, 0x0f, 0x10, 0x00, 0x00, 0x08}, 3),
            (std::vector<int>{255, 1, 128}));
}

TEST(GreyFormat, MoreThanTheBitsOfAWordIsAsBrightAsItGets) {
  EXPECT_EQ(extracted("Mono10", {0x00, 0x04}, 1), std::vector<int>{255});
  EXPECT_EQ(extracted("Mono12", {0x00, 0x10}, 1), std::vector<int>{255});
}

// The low bits of both stand between their upper ones.
TEST(GreyFormat, PackedGroupsGiveTheirOuterBytes) {
  for (const char* const format : {"Mono10Packed", "Mono12Packed"}) {
    EXPECT_EQ(extracted(format, {0x12, 0xff, 0x34, 0x56, 0x00, 0x78}, 4),
              (std::vector<int>{0x12, 0x34, 0x56, 0x78}));
  }
}

// 0x123, 0x456: 23 61 45 from the lowest bit on.
TEST(GreyFormat, RunsOfTwelveBits) {
  EXPECT_EQ(extracted("Mono12p", {0x23, 0x61, 0x45}, 2), (std::vector<int>{0x12, 0x45}));
}

// 1023, 0, 4, 512: bits 0 to 9 set, bit 22 (the third of pixel 2), bit 39 (the last of pixel 3).
TEST(GreyFormat, RunsOfTenBits) {
  EXPECT_EQ(extracted("Mono10p", {0xff, 0x03, 0x40, 0x00, 0x80}, 4),
            (std::vector<int>{255, 0, 1, 128}));
}

TEST(GreyFormat, LinesAreWholeGroups) {
  EXPECT_EQ(drivers::aravis::grey_format_named("Mono8")->line_bytes(635), 635);
  EXPECT_EQ(drivers::aravis::grey_format_named("Mono10p")->line_bytes(640), 800);
  EXPECT_EQ(drivers::aravis::grey_format_named("Mono12p")->line_bytes(640), 960);
  EXPECT_EQ(drivers::aravis::grey_format_named("Mono12Packed")->line_bytes(640), 960);
  EXPECT_EQ(drivers::aravis::grey_format_named("Mono12")->line_bytes(640), 1280);
  EXPECT_FALSE(drivers::aravis::grey_format_named("BayerRG8"));
}

}  // namespace
}  // namespace tubesight::tests
