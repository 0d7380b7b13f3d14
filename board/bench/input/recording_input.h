#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "drivers/files/messages.h"
#include "drivers/files/y4m_reader.h"
#include "drivers/replay/replay_frame_grabber.h"

namespace tubesight::board {

/// What stands for standard input, or for standard output.
inline constexpr std::string_view kStandardStream = "-";

/// How a recording is read.
enum class RecordingKind : std::uint8_t {
  kY4m,            ///< by ourselves
  kStandardInput,  ///< the same from "-"
  kVideo,          ///< through ffmpeg
};

/// How the recording of this name is read: by ourselves what is named `.y4m` or `.y4m.xz`, begins
/// like one, or is no regular file; through ffmpeg all else that can be opened.
[[nodiscard]] RecordingKind kind_of_recording(const std::string& recording);

/// Whether a file's name ends as that of a recording or a video: `.y4m`, `.y4m.xz`, `.mp4` ...
[[nodiscard]] bool is_named_as_recording(std::string_view file);

/// Lets a grabber of `recording` read it however it is to be read, and the settings tell the order
/// of lines with `ignore_scan_flag`; call before start(). Errors: kIo, kUnsupported ffmpeg is not
/// installed; `message` is one line that begins with the name.
[[nodiscard]] core::Result<void> feed(drivers::ReplayFrameGrabber& grabber,
                                      const std::string& recording, bool ignore_scan_flag,
                                      std::string& message);

/// What ends a message about a wrong flag of the order of lines: the way out.
inline constexpr std::string_view kScanFlagWayOut =
    "; where the recording's flag is what is wrong: --ignore-scan-flag";

/// Starts a grabber that was fed. What is wrong is added to `messages`, with the way out where the
/// settings and the recording's flag disagree about the order of lines.
[[nodiscard]] bool start(drivers::ReplayFrameGrabber& grabber, drivers::Messages& messages);

/// How a recording of this header is read, in one line for `-v` that begins with its name.
[[nodiscard]] std::string how_read(const std::string& recording, const drivers::Y4mHeader& header);

/// How long a recording is that ffmpeg reads, s; none where nobody can tell.
[[nodiscard]] std::optional<double> told_length_s(const std::string& recording);

/// Opens a recording's frames without companions. Errors: as feed(), and of Y4mReader::open().
[[nodiscard]] core::Result<void> open_frames(drivers::Y4mReader& reader,
                                             const std::string& recording, std::string& message);

/// The same of a still that ffmpeg reads: its first frame is the picture.
[[nodiscard]] core::Result<void> open_foreign_still(drivers::Y4mReader& reader,
                                                    const std::string& still, std::string& message);

}  // namespace tubesight::board
