#include "board/visionbox/page_gallery.h"

#include <cstdint>
#include <memory>
#include <utility>

namespace tubesight::board {

drivers::PageAnswer picture_answer(const PagePicture& picture, int quality,
                                   const core::SessionSettings& told,
                                   const PageSurroundings& around) {
  const std::string words = text(sighting_json(picture.marks(), told, around));
  const auto jpeg = picture.jpeg(quality);
  const auto size = static_cast<std::uint32_t>(words.size());
  std::string body;
  body.reserve(sizeof(size) + words.size() + jpeg->size());
  for (const unsigned shift : {0U, 8U, 16U, 24U}) {
    body += static_cast<char>((size >> shift) & 0xFFU);
  }
  body += words;
  body += *jpeg;
  drivers::PageAnswer answer;
  answer.type = "application/octet-stream";
  answer.body = std::make_shared<const std::string>(std::move(body));
  return answer;
}

void FrozenPictures::keep(const std::string& cookie, const PictureHub::Picture& picture) {
  drop(cookie);
  const std::lock_guard lock(mutex_);
  if (frozen_.size() >= kMost) {
    frozen_.erase(frozen_.begin());
  }
  frozen_.push_back({cookie, picture});
}

void FrozenPictures::drop(const std::string& cookie) {
  const std::lock_guard lock(mutex_);
  std::erase_if(frozen_, [&](const Frozen& each) { return each.cookie == cookie; });
}

PictureHub::Picture FrozenPictures::of(const std::string& cookie) const {
  const std::lock_guard lock(mutex_);
  for (const Frozen& each : frozen_) {
    if (each.cookie == cookie) {
      return each.picture;
    }
  }
  return nullptr;
}

}  // namespace tubesight::board
