#include "drivers/files/picture_reader.h"

#include <string_view>

#include <gtest/gtest.h>

#include "tests/support/temporary_folder.h"

namespace tubesight::drivers {
namespace {

using Pixels = std::vector<std::uint8_t>;

// Made with zlib by the format's specification, not by libpng.
// 2 x 2, 8-bit grey 0 64 128 255, gAMA 1.0: a reader that corrects gamma would change 64 and 128.
constexpr std::string_view kGreyWithGamma =
    "89504e470d0a1a0a0000000d494844520000000200000002080000000057dd52f80000000467414d"
    "41000186a031e8965f0000000e49444154789c6360706068f80f00030501c04e335be90000000049"
    "454e44ae426082";
// 3 x 1, 8-bit RGB: (255, 0, 0) (0, 255, 0) (10, 20, 30).
constexpr std::string_view kRgb =
    "89504e470d0a1a0a0000000d4948445200000003000000010802000000948283e300000012494441"
    "54789c63f8cfc0c0f09f814b440e000e60023b7852be010000000049454e44ae426082";
constexpr std::string_view kSixteenBits =
    "89504e470d0a1a0a0000000d49484452000000010000000110000000006aee47160000000b494441"
    "54789c6360640200000700047649e3280000000049454e44ae426082";
// 2 x 1, 4-bit grey: 3 and 15 of 15.
constexpr std::string_view kFourBits =
    "89504e470d0a1a0a0000000d494844520000000200000001040000000014b9cd570000000a494441"
    "54789c63b00700004100408d6ed5130000000049454e44ae426082";

// 3 x 3, 8-bit grey 10 20 ... 90, interlaced by Adam7.
constexpr std::string_view kInterlaced =
    "89504e470d0a1a0a0000000d49484452000000030000000308000000010444daf500000017494441"
    "5478da63e0629063708b6210610860d030b201000b1d01c3f1e7f5cf0000000049454e44ae426082";
// 2 x 1, 8-bit grey with alpha: 10 (transparent), 200.
constexpr std::string_view kAlpha =
    "89504e470d0a1a0a0000000d49484452000000020000000108040000005e2bb7010000000d494441"
    "5478da63e06238f11f0002bc01d2e9e0ec590000000049454e44ae426082";
// 2 x 1 from a palette of greys 30 (transparent by tRNS) and 90.
constexpr std::string_view kPalette =
    "89504e470d0a1a0a0000000d4948445200000002000000010803000000c3fc8fb800000006504c54"
    "451e1e1e5a5a5a596c75390000000174524e530040e6d8660000000b4944415478da636060040000"
    "0400022cde48ad0000000049454e44ae426082";
// Its header says 2 x 1, its data have a second line; and 2 x 2 with one line.
constexpr std::string_view kLineTooMany =
    "89504e470d0a1a0a0000000d4948445200000002000000010800000000d14920560000000e494441"
    "5478da6360646260660100001d000b10dd1c700000000049454e44ae426082";
constexpr std::string_view kLineTooFew =
    "89504e470d0a1a0a0000000d494844520000000200000002080000000057dd52f80000000b494441"
    "5478da636064020000070004e5ed94cf0000000049454e44ae426082";

std::string from_hex(std::string_view hex) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2) {
    bytes += static_cast<char>(std::stoi(std::string(hex.substr(i, 2)), nullptr, 16));
  }
  return bytes;
}

core::Result<void> read(const std::string& bytes, GreyPicture& picture, std::string& message) {
  return read_grey_picture(std::as_bytes(std::span(bytes)), picture, message);
}

/// The message of a picture that is refused.
std::string why(const std::string& bytes, core::Error error) {
  GreyPicture picture;
  std::string message;
  const auto outcome = read(bytes, picture, message);
  EXPECT_FALSE(outcome);
  if (!outcome) {
    EXPECT_EQ(outcome.error(), error);
  }
  return message;
}

TEST(ReadGreyPicture, TakesGreyValuesAsStored) {
  GreyPicture picture;
  std::string message;

  ASSERT_TRUE(read(from_hex(kGreyWithGamma), picture, message)) << message;

  EXPECT_EQ(picture.width_px, 2);
  EXPECT_EQ(picture.height_px, 2);
  EXPECT_EQ(picture.pixels, (Pixels{0, 64, 128, 255}));
}

TEST(ReadGreyPicture, TakesTheLumaOfColour) {
  GreyPicture picture;
  std::string message;

  ASSERT_TRUE(read(from_hex(kRgb), picture, message)) << message;

  // 0.299 * 255 = 76.2; 0.587 * 255 = 149.7; 2.99 + 11.74 + 3.42 = 18.15
  EXPECT_EQ(picture.pixels, (Pixels{76, 150, 18}));
}

TEST(ReadGreyPicture, ExpandsFewerBits) {
  GreyPicture picture;
  std::string message;

  ASSERT_TRUE(read(from_hex(kFourBits), picture, message)) << message;

  EXPECT_EQ(picture.pixels, (Pixels{51, 255}));
}

TEST(ReadGreyPicture, TakesEachFormOfPngAsItStands) {
  GreyPicture picture;
  std::string message;

  ASSERT_TRUE(read(from_hex(kInterlaced), picture, message)) << message;
  EXPECT_EQ(picture.pixels, (Pixels{10, 20, 30, 40, 50, 60, 70, 80, 90}));
  ASSERT_TRUE(read(from_hex(kAlpha), picture, message)) << message;
  EXPECT_EQ(picture.pixels, (Pixels{10, 200}));
  ASSERT_TRUE(read(from_hex(kPalette), picture, message)) << message;
  EXPECT_EQ(picture.pixels, (Pixels{30, 90}));
  ASSERT_TRUE(read(from_hex(kSixteenBits), picture, message)) << message;
  EXPECT_EQ(picture.pixels, (Pixels{1}));  // 258 of 65535
  // Each chunk says its length: what stands behind the last one cannot shift the picture.
  ASSERT_TRUE(read(from_hex(kAlpha) + "behind", picture, message)) << message;
  EXPECT_EQ(picture.pixels, (Pixels{10, 200}));
}

TEST(ReadGreyPicture, TellsWhatItDoesNotServe) {
  EXPECT_EQ(why("P5 1 1 65535 aa", core::Error::kUnsupported),
            "PGM with largest value 65535: expected 255 (8 bits)");
  EXPECT_EQ(why("P5 9000 1 255 ", core::Error::kUnsupported),
            "expected at most 8192 pixels a side");
  EXPECT_EQ(why("GIF89a..", core::Error::kInvalidArgument),
            "neither PNG nor PGM: expected an 8-bit grey still");
}

TEST(ReadGreyPicture, TellsDamage) {
  const std::string whole = from_hex(kGreyWithGamma);

  EXPECT_EQ(why(whole.substr(0, 60), core::Error::kInvalidArgument),
            "damaged PNG: the file ends early");
  EXPECT_EQ(why(whole.substr(0, 20), core::Error::kInvalidArgument),
            "damaged PNG: the file ends early");
  for (const std::string_view lines : {kLineTooMany, kLineTooFew}) {
    EXPECT_TRUE(why(from_hex(lines), core::Error::kInvalidArgument).starts_with("damaged PNG: "));
  }
  EXPECT_EQ(why("P5 2 2 255\nabc", core::Error::kInvalidArgument),
            "damaged PGM: the file ends early, expected 1 byte more of the picture's 4");
}

TEST(ReadGreyPicture, NamesTheFile) {
  const support::TemporaryFolder folder;
  GreyPicture picture;
  std::string message;

  EXPECT_FALSE(read_grey_picture(folder.path("none.png"), picture, message));
  EXPECT_EQ(message, folder.path("none.png") + ": cannot be read: No such file or directory");
  EXPECT_FALSE(read_grey_picture(folder.write("a.png", "text"), picture, message));
  EXPECT_EQ(message, folder.path("a.png") + ": neither PNG nor PGM: expected an 8-bit grey still");
}

}  // namespace
}  // namespace tubesight::drivers
