#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "board/box/overlay_snapshot.h"
#include "core/base/image_view.h"

namespace tubesight::board {

/// One picture as the page shows it, with the marks of its own field. Does not change, but for
/// what is made of it on demand. Any thread.
class PagePicture {
 public:
  PagePicture(const core::ImageView& picture, const OverlaySnapshot& marks);

  [[nodiscard]] std::int64_t field() const { return marks_.field; }
  [[nodiscard]] const OverlaySnapshot& marks() const { return marks_; }
  [[nodiscard]] core::ImageView picture() const {
    return {pixels_.data(), width_px_, height_px_, width_px_};
  }

  /// As JPEG of a quality, made once, whoever asks for it.
  [[nodiscard]] std::shared_ptr<const std::string> jpeg(int quality) const;

 private:
  std::int32_t width_px_;
  std::int32_t height_px_;
  std::vector<std::uint8_t> pixels_;
  OverlaySnapshot marks_;
  mutable std::mutex mutex_;
  mutable std::map<int, std::shared_ptr<const std::string>> jpegs_;
};

}  // namespace tubesight::board
