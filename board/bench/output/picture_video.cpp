#include "board/bench/output/picture_video.h"

namespace tubesight::board {

core::Result<void> PictureVideo::open(const drivers::Y4mHeader& recording, bool interlaced) {
  drivers::Y4mHeader header = recording;
  header.interlacing = drivers::Y4mInterlacing::kProgressive;
  if (interlaced && header.rate_denominator % 2 == 0) {
    header.rate_denominator /= 2;
  } else if (interlaced) {
    header.rate_numerator *= 2;
  }
  return writer_.open(path_, header, drivers::Y4mWriter::Colour::k444);
}

core::Result<void> PictureVideo::add(std::int64_t, const core::RgbImageView& picture) {
  return writer_.write_frame(picture);
}

}  // namespace tubesight::board
