#include "board/bench/output/still_reader.h"

#include "board/bench/input/recording_input.h"
#include "board/bench/output/text_output.h"
#include "drivers/files/csv_reader.h"

namespace tubesight::board {
namespace {

// An hour of video: what a range makes is held in memory.
constexpr std::int64_t kLastFrame = 99'999;

bool parse_frame(std::string_view text, std::int64_t& frame) {
  return drivers::parse_whole(text, frame) && frame >= 0 && frame <= kLastFrame;
}

}  // namespace

std::string Still::name() const {
  return frame < 0 ? file : file + " frame " + std::to_string(frame);
}

bool parse_frames(std::string_view text, FrameRange& frames) {
  const std::size_t dash = text.find('-');
  if (dash == std::string_view::npos) {
    return parse_frame(text, frames.first) && parse_frame(text, frames.last);
  }
  return parse_frame(text.substr(0, dash), frames.first) &&
         parse_frame(text.substr(dash + 1), frames.last) && frames.first <= frames.last;
}

std::vector<Still> stills_of(std::span<const std::string> files, FrameRange frames) {
  std::vector<Still> stills;
  for (const std::string& file : files) {
    if (!is_named_as_recording(file)) {
      stills.push_back({file});
      continue;
    }
    for (std::int64_t frame = frames.first; frame <= frames.last; ++frame) {
      stills.push_back({file, frame});
    }
  }
  return stills;
}

core::Result<void> StillReader::read(const Still& still, drivers::GreyPicture& picture,
                                     std::string& message) {
  if (still.frame >= 0) {
    return read_frame(still, picture, message);
  }
  header_ = {};
  const auto read = drivers::read_grey_picture(still.file, picture, message);
  const bool foreign =
      !read &&
      (read.error() == core::Error::kUnsupported ||
       (read.error() == core::Error::kInvalidArgument && !drivers::is_grey_picture(still.file)));
  if (foreign) {
    return read_foreign(still.file, picture, message);
  }
  if (read) {
    tell_more(still.file + ": " + std::to_string(picture.width_px) + " x " +
              std::to_string(picture.height_px) + " pixels, read by itself");
  }
  return read;
}

core::Result<void> StillReader::read_foreign(const std::string& file, drivers::GreyPicture& picture,
                                             std::string& message) {
  drivers::Y4mReader reader;
  TUBESIGHT_TRY(open_foreign_still(reader, file, message));
  picture.width_px = reader.header().width_px;
  picture.height_px = reader.header().height_px;
  picture.pixels.resize(static_cast<std::size_t>(reader.header().luma_bytes()));
  const auto read = reader.read_frame(picture.pixels);
  if (!read) {
    message =
        read.error() == core::Error::kEndOfData ? file + ": holds no picture" : reader.message();
  } else {
    tell_more(file + ": " + std::to_string(picture.width_px) + " x " +
              std::to_string(picture.height_px) + " pixels, read through ffmpeg");
  }
  return read;
}

core::Result<void> StillReader::read_frame(const Still& still, drivers::GreyPicture& picture,
                                           std::string& message) {
  const auto fail = [&](core::Error error) {
    open_.clear();
    message = error == core::Error::kEndOfData
                  ? still.file + ": has no frame " + std::to_string(still.frame) +
                        ", expected --frames within its " + std::to_string(reader_.frames_read()) +
                        ", counted from 0"
                  : reader_.message();
    return core::Unexpected(error == core::Error::kEndOfData ? core::Error::kOutOfRange : error);
  };
  if (open_ != still.file || reader_.frames_read() > still.frame) {
    if (const auto opened = open_frames(reader_, still.file, message); !opened) {
      open_.clear();
      return opened;
    }
    open_ = still.file;
    tell_more(how_read(still.file, reader_.header()));
  }
  header_ = reader_.header();
  picture.width_px = reader_.header().width_px;
  picture.height_px = reader_.header().height_px;
  picture.pixels.resize(static_cast<std::size_t>(reader_.header().luma_bytes()));
  while (reader_.frames_read() <= still.frame) {
    progress_.update(
        ProgressLine::Clock::now(), still.name() + ": reading up to it",
        static_cast<double>(reader_.frames_read()) / static_cast<double>(still.frame + 1));
    if (const auto frame = reader_.read_frame(picture.pixels); !frame) {
      return fail(frame.error());
    }
  }
  progress_.erase();
  return {};
}

}  // namespace tubesight::board
