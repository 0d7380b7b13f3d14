#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/math/small_matrix.h"

namespace tubesight::board {

/// What a calibration says of itself beside its table.
struct CalibrationQualityText {
  std::string_view table;  ///< "camera_quality", "tool_quality" or "base_quality"
  core::math::Matrix6d covariance;
  std::string_view verdict;
  std::string_view serial;  ///< of the camera; empty: it is not known
  std::string_view model;   ///< of the camera; empty: it is not known
};

/// The text of a calibrated table with that of its quality behind it: id, which is the table's
/// digest, made_at (now), sigma, correlation, verdict,
/// and which camera it is where that is known.
[[nodiscard]] std::string with_quality(const std::string& calibrated,
                                       const CalibrationQualityText& quality);

/// Puts a settings file in its place; what stood there is kept as `path.bak`. Each of the two is
/// old or new after a power cut, and new once this has returned. False, and why on standard error,
/// when it does not get there.
[[nodiscard]] bool write_settings(const std::string& path, const std::string& text);

/// Reads a file whole; false, and why with its name in `messages`, where it cannot be read.
[[nodiscard]] bool read_whole(const std::string& path, std::string& text,
                              std::vector<std::string>& messages);

}  // namespace tubesight::board
