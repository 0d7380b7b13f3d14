#pragma once

#include <cstddef>
#include <mutex>
#include <string>
#include <vector>

#include "board/visionbox/page_json.h"
#include "board/visionbox/picture_hub.h"
#include "core/base/settings.h"
#include "drivers/web/page_server.h"

namespace tubesight::board {

/// A picture and its sighting in one body, so that the two belong together beyond doubt: the length
/// of the JSON in four bytes, the lowest first, the JSON, and the picture as JPEG.
[[nodiscard]] drivers::PageAnswer picture_answer(const PagePicture& picture, int quality,
                                                 const core::SessionSettings& told,
                                                 const PageSurroundings& around);

/// Pictures that were frozen: the last one of each session, of a few sessions. Any thread.
class FrozenPictures {
 public:
  static constexpr std::size_t kMost = 8;

  void keep(const std::string& cookie, const PictureHub::Picture& picture);
  void drop(const std::string& cookie);
  /// Null: there is none.
  [[nodiscard]] PictureHub::Picture of(const std::string& cookie) const;

 private:
  struct Frozen {
    std::string cookie;
    PictureHub::Picture picture;
  };
  mutable std::mutex mutex_;
  std::vector<Frozen> frozen_;
};

}  // namespace tubesight::board
