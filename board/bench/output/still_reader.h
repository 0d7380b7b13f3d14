#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "board/bench/output/progress_line.h"
#include "core/base/result.h"
#include "drivers/files/picture_reader.h"
#include "drivers/files/y4m_reader.h"

namespace tubesight::board {

/// A still: a picture's file, or one frame of a recording.
struct Still {
  std::string file;
  std::int64_t frame = -1;  ///< counted from 0; -1: `file` is a picture

  /// As messages and tables call it: the file, with " frame N" behind a recording.
  [[nodiscard]] std::string name() const;
};

/// The frames that are taken of each recording, both ends included.
struct FrameRange {
  std::int64_t first = 0;  ///< the frame in which the operator clicked, by default
  std::int64_t last = 0;
};

/// Reads "A" or "A-B", 0 <= A <= B <= 99999. False when it is anything else.
[[nodiscard]] bool parse_frames(std::string_view text, FrameRange& frames);

/// Each picture once, each file named as a recording once for each of `frames`, in the order given.
[[nodiscard]] std::vector<Still> stills_of(std::span<const std::string> files, FrameRange frames);

/// Reads stills one by one; frames of one recording, taken in rising order, in one pass over it.
/// With `-v` it says how each file is read.
class StillReader {
 public:
  /// PNG and PGM are read by ourselves, other pictures through ffmpeg. Errors: those of
  /// drivers::read_grey_picture(), drivers::Y4mReader and open_foreign_still(); kOutOfRange the
  /// recording has no such frame. `message` is one line that begins with the file's name.
  [[nodiscard]] core::Result<void> read(const Still& still, drivers::GreyPicture& picture,
                                        std::string& message);

  /// What the recording of the still last read says of itself; nothing of a picture's file.
  [[nodiscard]] const drivers::Y4mHeader& header() const { return header_; }
  /// What it says of the order of lines.
  [[nodiscard]] drivers::Y4mInterlacing interlacing() const { return header_.interlacing; }

 private:
  static core::Result<void> read_foreign(const std::string& file, drivers::GreyPicture& picture,
                                         std::string& message);
  core::Result<void> read_frame(const Still& still, drivers::GreyPicture& picture,
                                std::string& message);

  drivers::Y4mReader reader_;
  drivers::Y4mHeader header_;
  ProgressLine progress_;  ///< of frames that are passed over
  std::string open_;       ///< the recording in reader_; empty: none, or one that failed
};

}  // namespace tubesight::board
