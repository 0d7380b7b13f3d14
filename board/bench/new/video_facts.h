#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/base/result.h"
#include "core/base/settings.h"
#include "core/base/tube_address.h"

namespace tubesight::board {

/// A tube-end whose outline was measured.
struct MeasuredPlace {
  core::TubeAddress from_middle;                    ///< rows and columns from that in the middle
  Eigen::Vector2d at_px = Eigen::Vector2d::Zero();  ///< the image of its centre
};

/// The lattice of tube-ends in a video's first frame, where one is found.
struct LatticeFacts {
  std::int32_t elements = 0;
  /// The image of the centre of the element nearest to the picture's middle that stands clear, as
  /// do those beside it, and of those one row and one column on: full-frame pixels. Columns run
  /// rightwards as nearly as they can, and a turn from columns to rows is one from u to v.
  Eigen::Vector2d middle_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d next_row_px = Eigen::Vector2d::Zero();
  Eigen::Vector2d next_column_px = Eigen::Vector2d::Zero();
  double diameter_px = 0.0;  ///< of the element in the middle, along its longer axis
  // In the lattice's own plane, as if seen straight on:
  double angle_deg = 0.0;             ///< between rows and columns
  double diameter_share = 0.0;        ///< the diameter as a share of the shorter step
  std::vector<MeasuredPlace> places;  ///< all that stand clear
};

/// What a video tells of itself.
struct VideoFacts {
  std::int32_t width_px = 0;
  std::int32_t height_px = 0;
  double rate_hz = 0.0;  ///< frames a second; 0: a still, or not stated
  std::optional<core::Scan> scan;
  std::optional<LatticeFacts> lattice;
};

/// Reads the header and the first frame of a recording, or a still. Errors: as StillReader, with
/// one line in `message`.
[[nodiscard]] core::Result<void> read_video_facts(const std::string& file, VideoFacts& facts,
                                                  std::string& message);

/// What a video tells, in one line for a person.
[[nodiscard]] std::string facts_text(const std::string& file, const VideoFacts& facts);

}  // namespace tubesight::board
