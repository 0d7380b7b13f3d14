#pragma once

#include <cstdint>
#include <string>

namespace tubesight::board {

/// The arithmetic of the tracking path; `--scalar`.
enum class ScalarChoice : std::uint8_t { kFixed, kFloat, kDouble };

/// The arguments of `tubesight replay`; an empty path is one that was not given.
struct ReplayOptions {
  std::string session;
  std::string recording;
  std::string fields;
  std::string centers;
  std::string overlay;
  std::string poses;
  std::string pairs;
  bool overlay_estimates = false;
  ScalarChoice scalar = ScalarChoice::kFixed;
};

/// Says in one line why the outputs of a replay cannot go where they are told to, as find_clash()
/// does; also a compressed video. Empty when they can.
[[nodiscard]] std::string find_output_conflict(const ReplayOptions& options);

}  // namespace tubesight::board
