#include "core/base/image_view.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace tubesight::core {
namespace {

constexpr std::int32_t kWidth = 3;
constexpr std::int32_t kStride = 5;

// A picture whose pixels hold their line's number; the bytes behind each line hold 255.
std::vector<std::uint8_t> numbered_lines(std::int32_t height) {
  std::vector<std::uint8_t> pixels(static_cast<std::size_t>(height * kStride), 255);
  for (std::int32_t v = 0; v < height; ++v) {
    for (std::int32_t u = 0; u < kWidth; ++u) {
      pixels[static_cast<std::size_t>(v * kStride + u)] = static_cast<std::uint8_t>(v);
    }
  }
  return pixels;
}

std::vector<int> lines_of(const FieldView& field) {
  std::vector<int> lines;
  for (std::int32_t l = 0; l < field.lines; ++l) {
    const std::uint8_t* line = field.pixels + static_cast<std::ptrdiff_t>(l) * field.stride_px;
    lines.push_back(line[0] == line[field.width_px - 1] ? line[0] : -1);
  }
  return lines;
}

struct Case {
  std::int32_t height;
  Parity parity;
  std::vector<int> lines;
};

TEST(FieldOf, ReadsTheLinesOfItsParity) {
  const Case cases[] = {
      {6, Parity::kEven, {0, 2, 4}},
      {6, Parity::kOdd, {1, 3, 5}},
      {7, Parity::kEven, {0, 2, 4, 6}},
      {7, Parity::kOdd, {1, 3, 5}},
      {3, Parity::kProgressive, {0, 1, 2}},
      {1, Parity::kEven, {0}},
      {2, Parity::kOdd, {1}},
      {1, Parity::kProgressive, {0}},
  };
  for (const Case& c : cases) {
    const std::vector<std::uint8_t> pixels = numbered_lines(c.height);
    const FieldView field = field_of({pixels.data(), kWidth, c.height, kStride}, c.parity);
    EXPECT_EQ(lines_of(field), c.lines) << "height " << c.height;
    EXPECT_EQ(field.width_px, kWidth);
  }
}

TEST(FieldOf, SaysWhichFrameLinesItHolds) {
  const std::vector<std::uint8_t> pixels = numbered_lines(5);
  const ImageView frame{pixels.data(), kWidth, 5, kStride};
  for (const Parity parity : {Parity::kEven, Parity::kOdd, Parity::kProgressive}) {
    const FieldView field = field_of(frame, parity);
    const std::vector<int> lines = lines_of(field);
    for (std::size_t l = 0; l < lines.size(); ++l) {
      EXPECT_EQ(field.first_line + static_cast<int>(l) * field.line_step, lines[l]);
    }
  }
}

TEST(ImageView, FindsItsLines) {
  const std::vector<std::uint8_t> pixels = numbered_lines(4);
  const ImageView frame{pixels.data(), kWidth, 4, kStride};
  EXPECT_EQ(*frame.line(0), 0);
  EXPECT_EQ(*frame.line(3), 3);
}

TEST(FieldOfDeathTest, AnOddFieldOfOneLineTraps) {
  const std::array<std::uint8_t, 3> pixels{};
  EXPECT_DEATH(static_cast<void>(field_of({pixels.data(), 3, 1, 3}, Parity::kOdd)), "");
}

}  // namespace
}  // namespace tubesight::core
