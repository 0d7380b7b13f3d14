#include "drivers/v4l2/pixel_format.h"

#include <array>

#include <gtest/gtest.h>

namespace tubesight::drivers::v4l2 {
namespace {

using Greys = std::array<int, 3>;

/// Three pixels out of six bytes.
Greys greys_of(const char* name, std::array<int, 6> told) {
  std::array<std::byte, 6> bytes{};
  for (std::size_t i = 0; i < told.size(); ++i) {
    bytes[i] = static_cast<std::byte>(told[i]);
  }
  std::array<std::uint8_t, 3> greys{};
  extract_line(*pixel_format_named(name), bytes.data(), 3, greys.data());
  return {greys[0], greys[1], greys[2]};
}

TEST(PixelFormat, LumaOfPackedFormatsIsTakenOut) {
  EXPECT_EQ(greys_of("YUYV", {1, 90, 2, 91, 255, 92}), (Greys{1, 2, 255}));
  EXPECT_EQ(greys_of("UYVY", {90, 1, 91, 2, 92, 255}), (Greys{1, 2, 255}));
}

TEST(PixelFormat, DeeperGreysAreShiftedTo8Bits) {
  // 10 bits, the low byte first: 0, 1023, 0x155 = 341.
  EXPECT_EQ(greys_of("Y10", {0, 0, 0xff, 0x03, 0x55, 0x01}), (Greys{0, 255, 85}));
  // 16 bits: 0x00ff, 0xffff, 0x8001.
  EXPECT_EQ(greys_of("Y16", {0xff, 0x00, 0xff, 0xff, 0x01, 0x80}), (Greys{0, 255, 128}));
}

TEST(PixelFormat, MoreBitsThanAFormatHasAreAsBrightAsItGets) {
  EXPECT_EQ(greys_of("Y10", {0x00, 0x04, 0xff, 0xff, 0, 0}), (Greys{255, 255, 0}));
}

TEST(PixelFormat, OnlyWhatHasAByteAPixelIsLent) {
  EXPECT_TRUE(pixel_format_named("GREY")->lendable());
  EXPECT_TRUE(pixel_format_named("NV12")->lendable());
  for (const char* packed : {"YUYV", "UYVY", "Y10", "Y16"}) {
    EXPECT_FALSE(pixel_format_named(packed)->lendable()) << packed;
  }
  EXPECT_FALSE(pixel_format_named("MJPG"));
}

TEST(PixelFormat, ACodeIsToldByItsLetters) {
  EXPECT_STREQ(code_text(0x47504a4d).data(), "MJPG");
  EXPECT_STREQ(code_text(0x20303159).data(), "Y10 ");
  EXPECT_STREQ(code_text(0x01020304).data(), "????");
}

}  // namespace
}  // namespace tubesight::drivers::v4l2
