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
  bool overlay_estimates = false;
  ScalarChoice scalar = ScalarChoice::kFixed;
};

}  // namespace tubesight::board
