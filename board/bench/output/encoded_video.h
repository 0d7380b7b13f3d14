#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "board/bench/output/overlay_sink.h"
#include "drivers/ffmpeg/ffmpeg_encoder.h"

namespace tubesight::board {

/// Overlay pictures as an encoded video, made by ffmpeg: one frame a field, as PictureVideo.
class EncodedVideo final : public OverlaySink {
 public:
  explicit EncodedVideo(std::string path) : path_(std::move(path)) {}

  [[nodiscard]] core::Result<void> open(const drivers::Y4mHeader& recording,
                                        bool interlaced) override;
  [[nodiscard]] core::Result<void> add(std::int64_t field,
                                       const core::RgbImageView& picture) override;
  [[nodiscard]] core::Result<void> commit() override { return encoder_.commit(); }
  [[nodiscard]] const std::string& message() const override { return encoder_.message(); }

 private:
  std::string path_;
  drivers::FfmpegEncoder encoder_;
};

}  // namespace tubesight::board
