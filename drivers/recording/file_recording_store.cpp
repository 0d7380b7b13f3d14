#include "drivers/recording/file_recording_store.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "drivers/files/recording_rows.h"

namespace tubesight::drivers {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

constexpr std::int64_t kMegabyte = 1 << 20;
constexpr std::int64_t kRowBytes = 128;  // of a field's row and an event now and then

Y4mInterlacing interlacing_of(core::Scan scan) {
  switch (scan) {
    case core::Scan::kEvenFirst: return Y4mInterlacing::kEvenFirst;
    case core::Scan::kOddFirst: return Y4mInterlacing::kOddFirst;
    case core::Scan::kProgressive: return Y4mInterlacing::kProgressive;
  }
  return Y4mInterlacing::kUnstated;
}

}  // namespace

FileRecordingStore::FileRecordingStore(std::string folder, std::int64_t most_mb,
                                       std::string session, WallClock wall_clock)
    : folder_(std::move(folder), most_mb * kMegabyte),
      session_(std::move(session)),
      wall_clock_(std::move(wall_clock)) {}

template <typename File>
Result<void> FileRecordingStore::checked(Result<void> result, const File& file) {
  if (!result) {
    message_ = file.message();
  }
  return result;
}

/// Nothing of a recording that failed stays.
Result<void> FileRecordingStore::given_up(Result<void> result) {
  if (!result) {
    files_.reset();
  }
  return result;
}

Result<void> FileRecordingStore::open() { return checked(folder_.open(), folder_); }

Result<std::int64_t> FileRecordingStore::room_mb() {
  const auto room = folder_.room();
  if (!room) {
    message_ = folder_.message();
    return Unexpected(room.error());
  }
  return *room / kMegabyte;
}

Result<void> FileRecordingStore::begin(const hal::RecordingHead& head) {
  files_.reset();
  const std::int64_t picture = std::int64_t{head.width_px} * head.height_px;
  const std::int64_t frames =
      head.scan == core::Scan::kProgressive ? head.fields : head.fields / 2 + 1;
  const std::int64_t bytes = frames * picture + head.fields * kRowBytes +
                             static_cast<std::int64_t>(head.state.size() + session_.size());
  TUBESIGHT_TRY(checked(folder_.make_room(bytes), folder_));
  path_ = folder_.next_path(wall_clock_(), head.reason);
  width_px_ = head.width_px;
  height_px_ = head.height_px;
  frame_.assign(static_cast<std::size_t>(picture), 0);
  frame_number_.reset();
  return given_up(open_files(head));
}

Result<void> FileRecordingStore::open_files(const hal::RecordingHead& head) {
  Files& files = files_.emplace();
  const auto open_text = [&](AtomicFile& file, const char* ending,
                             std::string_view header) -> Result<void> {
    TUBESIGHT_TRY(checked(file.open(path_ + ending), file));
    return checked(file.write(std::string(header) + "\n"), file);
  };
  TUBESIGHT_TRY(open_text(files.meta, ".meta.csv", kMetaHeader));
  TUBESIGHT_TRY(open_text(files.events, ".events.csv", kRecordedEventsHeader));
  TUBESIGHT_TRY(checked(files.session.open(path_ + ".session.toml"), files.session));
  TUBESIGHT_TRY(checked(files.session.write(std::string_view(session_)), files.session));
  TUBESIGHT_TRY(checked(files.state.open(path_ + ".state"), files.state));
  TUBESIGHT_TRY(checked(files.state.write(head.state), files.state));
  // No rate: the meta file has the times.
  const Y4mHeader header{head.width_px, head.height_px, 0, 0, interlacing_of(head.scan), 0};
  return checked(files.video.open(path_ + ".y4m", header, Y4mWriter::Colour::kMono), files.video);
}

Result<void> FileRecordingStore::add(const core::Field& field,
                                     std::span<const core::Event> events) {
  if (!files_) {
    return Unexpected(Error::kNotReady);
  }
  const std::int64_t frame = field.number / 2;
  if (frame_number_ && *frame_number_ != frame) {
    TUBESIGHT_TRY(given_up(write_frame()));
  }
  frame_number_ = frame;
  const core::FieldView& from = field.pixels;
  for (std::int32_t line = 0; line < from.lines; ++line) {
    const std::int32_t to = from.first_line + line * from.line_step;
    if (to >= height_px_ || from.width_px != width_px_) {
      break;  // a damaged field may have any size
    }
    std::copy_n(from.pixels + static_cast<std::ptrdiff_t>(line) * from.stride_px, from.width_px,
                frame_.begin() + static_cast<std::ptrdiff_t>(to) * width_px_);
  }
  rows_.clear();
  append_meta_row(rows_, field);
  TUBESIGHT_TRY(given_up(checked(files_->meta.write(std::string_view(rows_)), files_->meta)));
  rows_.clear();
  for (const core::Event& event : events) {
    append_recorded_event_row(rows_, field.number, event);
  }
  return given_up(checked(files_->events.write(std::string_view(rows_)), files_->events));
}

Result<void> FileRecordingStore::write_frame() {
  const core::ImageView picture{frame_.data(), width_px_, height_px_, width_px_};
  TUBESIGHT_TRY(checked(files_->video.write_frame(picture), files_->video));
  std::fill(frame_.begin(), frame_.end(), std::uint8_t{0});
  return {};
}

Result<void> FileRecordingStore::finish() {
  if (!files_) {
    return Unexpected(Error::kNotReady);
  }
  if (frame_number_) {
    TUBESIGHT_TRY(given_up(write_frame()));
  }
  const auto placed = put_in_place();
  files_.reset();
  if (!placed) {
    folder_.remove(path_);  // what was in its place already
  }
  return placed;
}

/// After a power cut a picture stands for a whole recording, so it goes last.
Result<void> FileRecordingStore::put_in_place() {
  const auto texts = {&files_->meta, &files_->events, &files_->state, &files_->session};
  for (AtomicFile* const text : texts) {
    TUBESIGHT_TRY(checked(text->sync(), *text));
  }
  TUBESIGHT_TRY(checked(files_->video.sync(), files_->video));
  for (AtomicFile* const text : texts) {
    TUBESIGHT_TRY(checked(text->commit(), *text));
  }
  TUBESIGHT_TRY(checked(folder_.sync(), folder_));
  TUBESIGHT_TRY(checked(files_->video.commit(), files_->video));
  return checked(folder_.sync(), folder_);
}

}  // namespace tubesight::drivers
