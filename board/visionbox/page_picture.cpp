#include "board/visionbox/page_picture.h"

#include <cstddef>

#include "drivers/web/jpeg_picture.h"

namespace tubesight::board {

PagePicture::PagePicture(const core::ImageView& picture, const OverlaySnapshot& marks)
    : width_px_(picture.width_px), height_px_(picture.height_px), marks_(marks) {
  pixels_.reserve(static_cast<std::size_t>(width_px_) * static_cast<std::size_t>(height_px_));
  for (std::int32_t v = 0; v < height_px_; ++v) {
    pixels_.insert(pixels_.end(), picture.line(v), picture.line(v) + width_px_);
  }
}

std::shared_ptr<const std::string> PagePicture::jpeg(int quality) const {
  const std::lock_guard lock(mutex_);
  std::shared_ptr<const std::string>& made = jpegs_[quality];
  if (made == nullptr) {
    made = std::make_shared<const std::string>(drivers::jpeg_of(picture(), quality));
  }
  return made;
}

}  // namespace tubesight::board
