#include "board/bench/output/overlay_sink.h"

#include "board/bench/output/picture_folder.h"
#include "board/bench/output/picture_video.h"

namespace tubesight::board {

std::unique_ptr<OverlaySink> make_overlay_sink(const std::string& out) {
  if (out.ends_with(".y4m")) {
    return std::make_unique<PictureVideo>(out);
  }
  return std::make_unique<PictureFolder>(out);
}

}  // namespace tubesight::board
