#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "board/bench/output/overlay_sink.h"
#include "drivers/files/y4m_writer.h"

namespace tubesight::board {

/// Overlay pictures as a colour video: one progressive frame a field, so at twice the recording's
/// rate when that is interlaced.
class PictureVideo final : public OverlaySink {
 public:
  explicit PictureVideo(std::string path) : path_(std::move(path)) {}

  [[nodiscard]] core::Result<void> open(const drivers::Y4mHeader& recording,
                                        bool interlaced) override;
  [[nodiscard]] core::Result<void> add(std::int64_t field,
                                       const core::RgbImageView& picture) override;
  [[nodiscard]] core::Result<void> commit() override { return writer_.commit(); }
  [[nodiscard]] const std::string& message() const override { return writer_.message(); }

 private:
  std::string path_;
  drivers::Y4mWriter writer_;
};

}  // namespace tubesight::board
