#include "board/bench/output/encoded_video.h"

namespace tubesight::board {

core::Result<void> EncodedVideo::open(const drivers::Y4mHeader& recording, bool interlaced) {
  // A recording whose meta file alone tells times has no rate.
  constexpr std::int64_t kUsualRate = 25;
  const std::int64_t rate = recording.rate_numerator > 0 ? recording.rate_numerator : kUsualRate;
  const std::int64_t fields = interlaced ? 2 : 1;
  return encoder_.open(path_, fields * rate,
                       recording.rate_numerator > 0 ? recording.rate_denominator : 1);
}

core::Result<void> EncodedVideo::add(std::int64_t, const core::RgbImageView& picture) {
  return encoder_.write_frame(picture);
}

}  // namespace tubesight::board
