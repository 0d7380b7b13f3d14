#pragma once

#include <optional>
#include <string>

namespace tubesight::drivers {

/// How long a video is, s, as its container says: asked of `ffprobe`, which comes with ffmpeg.
///
/// None where the container does not say, there is no such program, or it does not answer within
/// some seconds. Good for a progress display alone: containers err.
[[nodiscard]] std::optional<double> video_length_s(const std::string& path);

}  // namespace tubesight::drivers
