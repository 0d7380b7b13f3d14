#include "drivers/files/frame_line_search.h"

#include <string_view>

namespace tubesight::drivers {

void FrameLineSearch::look_through(std::span<const std::byte> part) {
  constexpr std::string_view kFrame = "FRAME";
  const std::string_view text(reinterpret_cast<const char*>(part.data()), part.size());
  std::size_t i = 0;
  while (found_at_ < 0 && i < text.size()) {
    if (matched_ == 0) {
      i = text.find(kFrame.front(), i);
      if (i == std::string_view::npos) {
        break;
      }
    }
    const bool fits =
        matched_ < kFrame.size() ? text[i] == kFrame[matched_] : text[i] == '\n' || text[i] == ' ';
    if (!fits) {
      // Its first letter stands nowhere else in it, so that the match can begin here at the
      // earliest.
      matched_ = 0;
      continue;
    }
    ++i;
    ++matched_;
    if (matched_ > kFrame.size()) {
      found_at_ = bytes_ + static_cast<std::int64_t>(i) - static_cast<std::int64_t>(matched_);
    }
  }
  bytes_ += static_cast<std::int64_t>(text.size());
}

}  // namespace tubesight::drivers
