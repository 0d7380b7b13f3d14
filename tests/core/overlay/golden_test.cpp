#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "tests/core/overlay/legend.h"
#include "tests/core/overlay/png_picture.h"
#include "tests/core/overlay/scenes.h"

namespace tubesight::tests {
namespace {

std::string golden_path(const Scene& scene) {
  return std::string(TUBESIGHT_TEST_DATA_DIR) + "/golden/overlay-" + std::string(scene.name) +
         ".png";
}

// Empty where two pictures agree, otherwise one line on where they first differ and how much.
std::string difference(const Picture& expected, const Picture& actual) {
  const auto size = [](const Picture& picture) {
    return std::to_string(picture.width_px) + " x " + std::to_string(picture.height_px);
  };
  if (expected.width_px != actual.width_px || expected.height_px != actual.height_px ||
      expected.bytes.size() != actual.bytes.size()) {
    return "expected " + size(expected) + " px, drawn " + size(actual);
  }
  std::size_t pixels = 0;
  std::string first;
  for (std::size_t i = 0; i < expected.bytes.size(); i += 3) {
    if (std::equal(&expected.bytes[i], &expected.bytes[i] + 3, &actual.bytes[i])) {
      continue;
    }
    ++pixels;
    if (first.empty()) {
      const std::size_t place = i / 3;
      const auto width = static_cast<std::size_t>(expected.width_px);
      first = "(" + std::to_string(place % width) + ", " + std::to_string(place / width) + ")";
    }
  }
  return pixels == 0 ? "" : std::to_string(pixels) + " pixels differ, the first at " + first;
}

TEST(OverlayGolden, EverySceneIsDrawnPixelForPixel) {
  for (const Scene& scene : scenes()) {
    const Picture actual = scene.draw();
    const auto golden = read_png(golden_path(scene));
    const std::string found = golden ? difference(*golden, actual) : "cannot be read";
    if (!found.empty()) {
      const std::string written =
          std::string(TUBESIGHT_ACTUAL_DIR) + "/overlay-" + std::string(scene.name) + ".png";
      EXPECT_TRUE(write_png(written, actual));
      ADD_FAILURE() << golden_path(scene) << ": " << found << "; drawn picture: " << written
                    << " (look at it; if it is right, put it in place of the golden one, and its "
                    << "digest 0x" << std::hex << digest_of(actual) << " into scenes.cpp)";
    }
  }
}

TEST(OverlayLegend, OfTheDocumentsIsWhatTheProgramDraws) {
  const std::string path = std::string(TUBESIGHT_SOURCE_DIR) + "/docs/pictures/overlay-legend.png";
  const Picture actual = draw_legend();
  const auto shown = read_png(path);
  const std::string found = shown ? difference(*shown, actual) : "cannot be read";
  if (!found.empty()) {
    const std::string written = std::string(TUBESIGHT_ACTUAL_DIR) + "/overlay-legend.png";
    EXPECT_TRUE(write_png(written, actual));
    ADD_FAILURE() << path << ": " << found << "; as drawn: " << written
                  << " (look at it, and put it in place of the old one)";
  }
}

TEST(OverlayGolden, DigestsAreThoseOfTheGoldenPictures) {
  for (const Scene& scene : scenes()) {
    const auto golden = read_png(golden_path(scene));
    ASSERT_TRUE(golden.has_value()) << golden_path(scene);
    EXPECT_EQ(digest_of(*golden), scene.digest) << scene.name;
  }
}

TEST(OverlayGolden, ADamagedGoldenPictureIsNoticed) {
  for (const Scene& scene : scenes()) {
    auto golden = read_png(golden_path(scene));
    ASSERT_TRUE(golden.has_value()) << golden_path(scene);
    const Picture actual = scene.draw();
    ASSERT_EQ(difference(*golden, actual), "") << scene.name;

    // Blue of pixel (2, 1), by one.
    golden->bytes[static_cast<std::size_t>(3 * (golden->width_px + 2) + 2)] ^= 1U;
    EXPECT_EQ(difference(*golden, actual), "1 pixels differ, the first at (2, 1)");

    golden->bytes.resize(golden->bytes.size() - static_cast<std::size_t>(3 * golden->width_px));
    --golden->height_px;
    EXPECT_NE(difference(*golden, actual), "");
  }
}

TEST(OverlayGolden, AMissingOrBrokenFileIsNoticed) {
  EXPECT_FALSE(read_png(std::string(TUBESIGHT_TEST_DATA_DIR) + "/golden/no-such.png").has_value());
  EXPECT_FALSE(read_png(std::string(TUBESIGHT_SOURCE_DIR) + "/CMakeLists.txt").has_value());
}

}  // namespace
}  // namespace tubesight::tests
