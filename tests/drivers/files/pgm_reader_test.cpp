#include "drivers/files/pgm_reader.h"

#include <gtest/gtest.h>

namespace tubesight::drivers {
namespace {

using Pixels = std::vector<std::uint8_t>;

// Three pixels of which none may be mistaken for part of a header; 10 is a line feed.
constexpr const char* kRaster = "\x01\n\xFE";
const Pixels kPixels = {1, 10, 254};
constexpr const char* kWrongHeader =
    "damaged PGM: expected P5, width, height and largest value, then one white-space character";

std::string why(const std::string& bytes, core::Error error) {
  GreyPicture picture;
  std::string message;
  const auto outcome = read_pgm(bytes, picture, message);
  EXPECT_FALSE(outcome) << bytes;
  if (!outcome) {
    EXPECT_EQ(outcome.error(), error);
  }
  return message;
}

TEST(ReadPgm, TakesEveryHeaderOfTheFormat) {
  for (const std::string header :
       {"P5\n3 1\n255\n", "P5 3 1 255 ", "P5\t3\v1\f255\r", "P5  \n\n 3 \t 1\n\n 255\n",
        "P5 # a comment\n# another\n3 1\n255\n", "P5#c\n3#width\n1# height\n\n255\n",
        "P5\n#\n3 1\n# lamp 500\n255\n", "P5\r# a Macintosh\r3 1\r255\r", "P5 0003 01 255\n"}) {
    GreyPicture picture;
    std::string message;

    ASSERT_TRUE(read_pgm(header + kRaster, picture, message)) << header << message;

    EXPECT_EQ(picture.width_px, 3);
    EXPECT_EQ(picture.height_px, 1);
    EXPECT_EQ(picture.pixels, kPixels) << header;
  }
}

TEST(ReadPgm, TakesFormsBesideTheFormatWithoutShiftingThePicture) {
  for (const std::string header :
       {"P5\r\n3 1\r\n255\r\n", "P5\r\n# c\r\n3 1\r\n255\r\n", "P5\n3 1\n255 # lamp 500\n",
        "P5\n3 1\n255# lamp 500\n", "P5\n3 1\n255\n# made by hand\n",
        "P5\r\n3 1\r\n255 # lamp 500\r\n", "P5\n3 1\n255 # 50 \xC2\xB0\x43\tor so\n"}) {
    GreyPicture picture;
    std::string message;

    ASSERT_TRUE(read_pgm(header + kRaster, picture, message)) << header << message;

    EXPECT_EQ(picture.pixels, kPixels) << header;
  }
}

TEST(ReadPgm, TakesPixelsThatLookLikeText) {
  // By the format these are pixels, and they fill the file.
  for (const std::string raster : {"#\n1", "# \n", "   ", "\n\n\n", "P5 "}) {
    GreyPicture picture;
    std::string message;

    ASSERT_TRUE(read_pgm("P5\n3 1\n255\n" + raster, picture, message)) << message;

    EXPECT_EQ(picture.pixels, Pixels(raster.begin(), raster.end()));
  }
}

TEST(ReadPgm, RefusesWhatIsLeftOver) {
  const std::string whole = std::string("P5\n3 1\n255\n") + kRaster;
  const std::string left = " left over behind the 3 of the picture, expected none";

  EXPECT_EQ(why(whole + "\n", core::Error::kInvalidArgument), "damaged PGM: 1 byte" + left);
  EXPECT_EQ(why(whole + std::string(512, '\0'), core::Error::kInvalidArgument),
            "damaged PGM: 512 bytes" + left);
  EXPECT_EQ(why(whole + whole, core::Error::kInvalidArgument),
            "damaged PGM: 14 bytes" + left + " (a further picture follows)");
  // Which of the two ends the header cannot be told.
  EXPECT_EQ(why(std::string("P5\n3 1\n255 \n") + kRaster, core::Error::kInvalidArgument),
            "damaged PGM: 1 byte" + left);
  // A comment behind the largest value that is not all that is left over.
  EXPECT_EQ(why(std::string("P5\n3 1\n255 #c\n") + kRaster + "\n", core::Error::kInvalidArgument),
            "damaged PGM: 4 bytes" + left);
}

TEST(ReadPgm, RefusesWhatIsMissing) {
  EXPECT_EQ(why("P5\n3 1\n255\nab", core::Error::kInvalidArgument),
            "damaged PGM: the file ends early, expected 1 byte more of the picture's 3");
  // By the letter of the format the LF would be the first pixel, and all others shifted.
  EXPECT_EQ(why("P5\r\n3 1\r\n255\r\nab", core::Error::kInvalidArgument),
            "damaged PGM: the file ends early, expected 1 byte more of the picture's 3");
  EXPECT_EQ(why("P5\n3 1\n255# no end", core::Error::kInvalidArgument),
            "damaged PGM: the file ends early, expected 3 bytes more of the picture's 3");
}

TEST(ReadPgm, RefusesAHeaderThatIsNone) {
  using std::string_literals::operator""s;
  for (const std::string& bytes :
       {"P5"s, "P5\n3 1\n"s, "P5\n3 1\n255"s, "P5\n3 1\n255;abc"s, "P53 1 255\nabc"s,
        "P5\n3 x 255\nabc"s, "P5\n3\0001 255\nabc"s, "P5\n-3 1\n255\nabc"s, "P5\n0 1\n255\n"s,
        "P5\n99999999999 1\n255\nabc"s, "P5\n3 1 # 255\nabc"s}) {
    EXPECT_EQ(why(bytes, core::Error::kInvalidArgument), kWrongHeader) << bytes;
  }
}

}  // namespace
}  // namespace tubesight::drivers
