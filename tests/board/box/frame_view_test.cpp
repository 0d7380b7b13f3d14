#include "board/box/frame_view.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

namespace tubesight::board {
namespace {

using core::FieldStatus;
using core::Parity;

constexpr std::int32_t kWidth = 3;

/// A frame of which every line has one grey, and its fields.
class Frame {
 public:
  explicit Frame(const std::vector<std::uint8_t>& greys)
      : height_px_(static_cast<std::int32_t>(greys.size())) {
    for (const std::uint8_t grey : greys) {
      pixels_.insert(pixels_.end(), kWidth, grey);
      pixels_.insert(pixels_.end(), {255, 255});  // between lines, not to be seen
    }
  }

  [[nodiscard]] core::Field field(Parity parity, FieldStatus status = FieldStatus::kGood) const {
    core::Field field;
    field.pixels = core::field_of({pixels_.data(), kWidth, height_px_, kWidth + 2}, parity);
    field.parity = parity;
    field.status = status;
    return field;
  }

 private:
  std::int32_t height_px_;
  std::vector<std::uint8_t> pixels_;
};

/// The grey of each line of the view, all of whose pixels must have it.
std::vector<int> greys_of(const FrameView& view) {
  std::vector<int> greys;
  const core::ImageView picture = view.picture();
  for (std::int32_t v = 0; v < picture.height_px; ++v) {
    greys.push_back(picture.line(v)[0]);
    for (std::int32_t u = 0; u < picture.width_px; ++u) {
      EXPECT_EQ(picture.line(v)[u], greys.back()) << "line " << v;
    }
  }
  return greys;
}

TEST(FrameView, IsBlackBeforeTheFirstField) {
  const FrameView view(kWidth, 3);

  EXPECT_EQ(greys_of(view), (std::vector<int>{0, 0, 0}));
}

TEST(FrameView, ShowsTheTwoLastFields) {
  FrameView view(kWidth, 4);
  const Frame first({10, 11, 12, 13});
  const Frame second({20, 21, 22, 23});

  view.take(first.field(Parity::kEven));
  view.take(first.field(Parity::kOdd));
  EXPECT_EQ(greys_of(view), (std::vector<int>{10, 11, 12, 13}));
  view.take(second.field(Parity::kEven));
  EXPECT_EQ(greys_of(view), (std::vector<int>{20, 11, 22, 13}));
  view.take(second.field(Parity::kOdd));
  EXPECT_EQ(greys_of(view), (std::vector<int>{20, 21, 22, 23}));
}

TEST(FrameView, LetsTheFirstFieldsLinesStandForTheirNeighbours) {
  const Frame frame({10, 11, 12, 13, 14});
  FrameView even(kWidth, 5);
  FrameView odd(kWidth, 5);

  even.take(frame.field(Parity::kEven));
  odd.take(frame.field(Parity::kOdd));

  EXPECT_EQ(greys_of(even), (std::vector<int>{10, 10, 12, 12, 14}));
  EXPECT_EQ(greys_of(odd), (std::vector<int>{11, 11, 11, 13, 13}));
}

TEST(FrameView, KeepsAFieldWhoseNeighbourIsDamagedOrNeverCame) {
  FrameView view(kWidth, 4);
  const Frame good({10, 11, 12, 13});
  const Frame bad({20, 21, 22, 23});
  view.take(good.field(Parity::kEven));
  view.take(good.field(Parity::kOdd));

  view.take(bad.field(Parity::kEven, FieldStatus::kDamaged));

  EXPECT_EQ(greys_of(view), (std::vector<int>{10, 11, 12, 13}));
}

TEST(FrameView, TakesAProgressiveFrameWhole) {
  FrameView view(kWidth, 3);

  view.take(Frame({7, 8, 9}).field(Parity::kProgressive));

  EXPECT_EQ(greys_of(view), (std::vector<int>{7, 8, 9}));
}

}  // namespace
}  // namespace tubesight::board
