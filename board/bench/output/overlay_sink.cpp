#include "board/bench/output/overlay_sink.h"

#include "board/bench/output/background_sink.h"
#include "board/bench/output/encoded_video.h"
#include "board/bench/output/output_paths.h"
#include "board/bench/output/picture_folder.h"
#include "board/bench/output/picture_video.h"
#include "drivers/ffmpeg/ffmpeg_encoder.h"

namespace tubesight::board {

std::unique_ptr<OverlaySink> make_overlay_sink(const std::string& out) {
  if (ending_of(out) == ".y4m") {
    return std::make_unique<PictureVideo>(out);
  }
  if (drivers::FfmpegEncoder::encodes(out)) {
    return std::make_unique<EncodedVideo>(out);
  }
  // Compressing takes most of the time: beside the thread that tracks and draws, and in its place
  // while that waits.
  constexpr std::size_t kWorkers = 2;
  return std::make_unique<BackgroundSink>(std::make_unique<PictureFolder>(out), kWorkers);
}

}  // namespace tubesight::board
