#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/settings.h"
#include "core/picture/averaged_picture.h"
#include "core/pose/picture_pose.h"
#include "core/pose/pose_model.h"
#include "core/tubesheet/sheet_map.h"
#include "tests/support/synthetic_sheet.h"

namespace tubesight::core::pose {

/// Under tube (20, 10), 40 mm below, turned and leaning a little.
inline constexpr TubeAddress kUnderTube{20, 10};
inline constexpr tests::ToolPlace kStillPlace{254.6, 507.5, 40.0, 12.0, 0.3, -0.2};

/// A drawn still with its model: the truth comes from the drawing, not from the code under test.
struct StillPicture {
  std::unique_ptr<SessionSettings> settings = std::make_unique<SessionSettings>();
  std::unique_ptr<tests::SyntheticSheet> sheet;
  std::unique_ptr<tubesheet::SheetMap> map = std::make_unique<tubesheet::SheetMap>();
  PoseModel model;
  tests::Frame frame;
  std::vector<std::uint16_t> sums;

  explicit StillPicture(std::int32_t divisor = 1) {
    tests::make_synthetic_settings(*settings, divisor);
    configure();
  }

  /// Takes changed settings over.
  void configure() {
    sheet = std::make_unique<tests::SyntheticSheet>(*settings);
    const auto made = make_pose_model(settings->camera, settings->tool, settings->tubesheet);
    ASSERT_TRUE(made.has_value());
    model = *made;
    ASSERT_TRUE(map->assign(settings->tubesheet).has_value());
    sums.resize(static_cast<std::size_t>(settings->camera.width_px) *
                static_cast<std::size_t>(settings->camera.height_px));
  }

  /// Both fields at `place`.
  void draw(const tests::ToolPlace& place, std::uint32_t seed = 1) {
    sheet->draw(place, Parity::kEven, seed, frame);
    sheet->draw(place, Parity::kOdd, seed + 100, frame);
  }

  [[nodiscard]] FieldView field(Parity parity) const {
    return field_of({frame.data(), settings->camera.width_px, settings->camera.height_px,
                     settings->camera.width_px},
                    parity);
  }

  /// The frame as an average of one.
  [[nodiscard]] picture::AveragedPicture averaged() {
    picture::PictureAverage average(sums, settings->camera.width_px, settings->camera.height_px);
    EXPECT_TRUE(average.add(field(Parity::kEven)).has_value());
    EXPECT_TRUE(average.add(field(Parity::kOdd)).has_value());
    const auto picture = average.finish();
    EXPECT_TRUE(picture.has_value());
    return picture.value_or(picture::AveragedPicture{});
  }

  /// A start inside a tube-end, some pixels off its centre.
  [[nodiscard]] PictureStart start(const tests::ToolPlace& place, TubeAddress address,
                                   double off_px = 4.0) const {
    const std::array<double, 2> at = sheet->image_of(place, address);
    return {address, at[0] + off_px, at[1] - off_px / 2.0};
  }
};

}  // namespace tubesight::core::pose
