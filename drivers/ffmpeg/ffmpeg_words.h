#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace tubesight::drivers {

/// What to say where the program is not installed.
inline constexpr std::string_view kNoFfmpeg =
    "ffmpeg is not installed, expected the package ffmpeg (apt install ffmpeg)";

/// Collects what ffmpeg says on its standard error, bounded: the first lines and the last one.
class FfmpegWords {
 public:
  /// Takes the next bytes, in parts of any size.
  void take(std::string_view part);

  /// Whether it said anything.
  [[nodiscard]] bool empty() const { return first_.empty() && line_.empty(); }

  /// Cause and outcome in one line: the first and the last line, without addresses of its objects
  /// and without the name `file` of what it worked on. At most 300 bytes, none of them a control
  /// character.
  [[nodiscard]] std::string in_one_line(const std::string& file) const;

 private:
  void end_line();

  std::string first_;
  std::string last_;
  std::string line_;  ///< the one not ended yet
};

}  // namespace tubesight::drivers
