#pragma once

#include <cstdint>
#include <mutex>
#include <string>
#include <system_error>
#include <utility>

#include "board/bench/output/overlay_sink.h"

namespace tubesight::board {

/// Overlay pictures as `field-000123.png` in a folder.
///
/// They are collected in a folder of their own inside it, whose name ends in ".part", and moved at
/// commit(), which also removes pictures of an earlier replay; other files stay.
class PictureFolder final : public OverlaySink {
 public:
  explicit PictureFolder(std::string folder) : folder_(std::move(folder)) {}
  PictureFolder(const PictureFolder&) = delete;
  PictureFolder& operator=(const PictureFolder&) = delete;
  ~PictureFolder() override;

  [[nodiscard]] core::Result<void> open(const drivers::Y4mHeader& recording,
                                        bool interlaced) override;
  /// May be called by several threads at once, each with pictures of its own.
  [[nodiscard]] core::Result<void> add(std::int64_t field,
                                       const core::RgbImageView& picture) override;
  [[nodiscard]] core::Result<void> commit() override;
  [[nodiscard]] const std::string& message() const override { return message_; }

 private:
  core::Result<void> fail(const char* what, const std::error_code& why);

  std::string folder_;
  std::string collecting_;    ///< empty when there is nothing to remove
  std::mutex message_mutex_;  ///< of add() alone
  std::string message_;
  int descriptor_ = -1;  ///< holds the lock of `collecting_`
  bool made_folder_ = false;
};

}  // namespace tubesight::board
