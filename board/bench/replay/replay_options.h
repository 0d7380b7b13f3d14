#pragma once

#include <cstdint>
#include <string>

namespace tubesight::board {

/// The arithmetic of the tracking path; `--scalar`.
enum class ScalarChoice : std::uint8_t { kFixed, kFloat, kDouble };

/// The arguments of `tubesight replay`; an empty path is one that was not given, "-" is standard
/// input or output.
struct ReplayOptions {
  std::string session;
  std::string recording;
  std::string fields;
  std::string centers;
  std::string overlay;
  std::string poses;
  std::string pairs;
  std::string replies;
  std::string summary;
  double from_s = -1.0;  ///< below 0: from the beginning
  double to_s = -1.0;    ///< below 0: to the end
  std::int64_t every = 1;
  bool ignore_scan_flag = false;
  bool must_track = false;
  bool overlay_estimates = false;
  ScalarChoice scalar = ScalarChoice::kFixed;
};

/// Says in one line why the outputs of a replay cannot go where they are told to, as find_clash()
/// does; also an overlay whose name is that of something that is not written. Empty when they can.
[[nodiscard]] std::string find_output_conflict(const ReplayOptions& options);

}  // namespace tubesight::board
