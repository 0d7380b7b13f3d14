#include "drivers/replay/replay_frame_grabber.h"

#include <utility>

#include "core/base/assert.h"
#include "drivers/replay/companion.h"
#include "drivers/replay/field_time.h"
#include "drivers/replay/scan_flag.h"

namespace tubesight::drivers {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

std::string size_words(std::int32_t width_px, std::int32_t height_px) {
  return std::to_string(width_px) + " x " + std::to_string(height_px);
}

}  // namespace

ReplayFrameGrabber::ReplayFrameGrabber(const core::CameraSettings& camera, std::string recording)
    : camera_(camera), recording_(std::move(recording)) {}

ReplayFrameGrabber::ReplayFrameGrabber(const core::CameraSettings& camera,
                                       std::unique_ptr<ByteSource> source, std::string name,
                                       std::string meta_text)
    : camera_(camera),
      recording_(std::move(name)),
      given_source_(std::move(source)),
      given_meta_(std::move(meta_text)),
      from_memory_(true),
      source_given_(true) {}

void ReplayFrameGrabber::read_from(std::unique_ptr<ByteSource> source, bool companions) {
  given_source_ = std::move(source);
  source_given_ = true;
  from_memory_ = !companions;
}

void ReplayFrameGrabber::read_from(std::unique_ptr<StampedSource> source) {
  stamps_ = source.get();
  read_from(std::unique_ptr<ByteSource>(std::move(source)), true);
}

Result<void> ReplayFrameGrabber::start() {
  if (started_) {
    return Unexpected(Error::kNotReady);
  }
  messages_.clear();
  failed_ = false;
  frame_ready_ = false;
  later_field_ = false;
  field_number_ = -1;
  field_time_ = core::FieldTime(0);
  scan_disagrees_ = false;
  next_row_ = 0;
  TUBESIGHT_TRY(open());
  TUBESIGHT_TRY(check_header());
  TUBESIGHT_TRY(check_rate_or_meta());
  pixels_.resize(static_cast<std::size_t>(reader_.header().luma_bytes()));
  if (stamps_ != nullptr && reader_.header().rate_numerator > 0) {
    stamped_time_.begin(reader_.header().rate_numerator, reader_.header().rate_denominator);
  } else {
    stamps_ = nullptr;
  }
  if (const auto first = read_frame(); !first) {
    return first.error() == Error::kEndOfData
               ? fail(Error::kInvalidArgument,
                      recording_ + ": holds no frame, expected at least one")
               : fail(first.error(), reader_.message());
  }
  frame_ready_ = true;
  row_frame_ = by_rows_ ? meta_.rows().front().field / 2 : 0;
  started_ = true;
  return {};
}

void ReplayFrameGrabber::stop() {
  TUBESIGHT_ASSERT(!lent_);
  started_ = false;
}

Result<void> ReplayFrameGrabber::open() {
  std::string meta_text;
  if (source_given_ && given_source_ == nullptr) {
    return fail(Error::kIo, recording_ + ": can be read only once");
  }
  if (from_memory_) {
    meta_name_ = recording_ + ".meta.csv";
    meta_text = given_meta_;
    has_meta_ = !meta_text.empty();
  } else {
    meta_name_ = companion_path(recording_, ".meta.csv");
    const auto present = read_companion(meta_name_, meta_text, messages_);
    if (!present) {
      return Unexpected(present.error());
    }
    has_meta_ = *present;
  }
  const auto opened =
      source_given_ ? reader_.open(std::move(given_source_), recording_) : reader_.open(recording_);
  if (!opened) {
    return fail(opened.error(), reader_.message());
  }
  if (!has_meta_) {
    return by_rows_ ? fail(Error::kInvalidArgument,
                           meta_name_ + ": is missing, expected it beside what a box recorded")
                    : Result<void>();
  }
  TUBESIGHT_TRY(
      meta_.parse(meta_text, meta_name_, messages_,
                  by_rows_ ? ReplayMeta::Writer::kRecorder : ReplayMeta::Writer::kAnybody));
  return by_rows_ && meta_.rows().empty()
             ? fail(Error::kInvalidArgument, meta_name_ + ": has no rows, expected one a field")
             : Result<void>();
}

Result<void> ReplayFrameGrabber::check_header() {
  const Y4mHeader& header = reader_.header();
  if (header.width_px != camera_.width_px || header.height_px != camera_.height_px) {
    return fail(Error::kInvalidArgument,
                recording_ + ": " + size_words(header.width_px, header.height_px) +
                    " pixels, expected " + size_words(camera_.width_px, camera_.height_px) +
                    " as [camera] of the settings says");
  }
  if (const std::string why = why_other_scan(header.interlacing, camera_.scan);
      !why.empty() && !ignores_scan_flag_) {
    scan_disagrees_ = true;
    return fail(Error::kInvalidArgument, recording_ + ": " + why);
  }
  if (interlaced() && header.height_px < 2) {
    return fail(Error::kInvalidArgument,
                recording_ + ": 1 line, expected at least 2 in an interlaced picture");
  }
  return {};
}

Result<void> ReplayFrameGrabber::check_rate_or_meta() {
  if (!has_meta_ && reader_.header().rate_numerator == 0) {
    return fail(Error::kInvalidArgument,
                recording_ +
                    ": header says no frame rate, expected F<number>:<number> there or "
                    "times in " +
                    meta_name_);
  }
  return {};
}

Result<void> ReplayFrameGrabber::fail(Error error, std::string message) {
  messages_.push_back(std::move(message));
  failed_ = true;
  failure_ = error;
  return Unexpected(error);
}

Result<void> ReplayFrameGrabber::read_frame() {
  const auto read = reader_.read_frame(pixels_);
  if (read && stamps_ != nullptr) {
    stamped_time_.place(stamps_->next_stamp());
  }
  return read;
}

Result<void> ReplayFrameGrabber::next_frame() {
  const auto outcome = read_frame();
  if (outcome) {
    frame_ready_ = true;
    return {};
  }
  if (outcome.error() == Error::kEndOfData) {
    TUBESIGHT_TRY(check_meta_used_up());
    failed_ = true;
    failure_ = Error::kEndOfData;
    return Unexpected(failure_);
  }
  return fail(outcome.error(), reader_.message());
}

Result<void> ReplayFrameGrabber::check_meta_used_up() {
  // Fields that were passed over count.
  const std::int64_t last =
      by_rows_ ? field_number_ : 2 * (reader_.frames_read() - 1) + (interlaced() ? 1 : 0);
  if (!has_meta_ || meta_.rows().empty() || meta_.rows().back().field <= last) {
    return {};
  }
  return fail(Error::kInvalidArgument, meta_name_ + ":" + std::to_string(meta_.rows().back().line) +
                                           ": field: " + std::to_string(meta_.rows().back().field) +
                                           ", expected at most " + std::to_string(last) +
                                           ", the last field of " + recording_);
}

Result<void> ReplayFrameGrabber::describe(std::int64_t number, core::Field& field) {
  field.number = number;
  field.sequence = interlaced() ? number : number / 2;  // the fields, one after the other
  if (!has_meta_ && stamps_ != nullptr) {
    field.mid_exposure = stamped_time_.time(number % 2 == 1);
    return {};
  }
  if (!has_meta_) {
    const Y4mHeader& header = reader_.header();
    field.mid_exposure = nominal_field_time(number, header.rate_numerator, header.rate_denominator);
    return {};
  }
  const FieldMeta* const row = meta_.find(number);
  if (row == nullptr) {
    return fail(Error::kInvalidArgument, meta_name_ + ": no row for field " +
                                             std::to_string(number) +
                                             ", expected one for each field of " + recording_);
  }
  field.sequence = row->sequence;
  field.mid_exposure = row->time;
  field.status = row->status;
  field.lamp_permille = row->lamp_permille.value_or(core::kFullLamp_permille);
  return {};
}

/// Frames one after the other, each field of them.
Result<std::int64_t> ReplayFrameGrabber::next_number() {
  if (!frame_ready_) {
    TUBESIGHT_TRY(next_frame());
  }
  const std::int64_t number = 2 * (reader_.frames_read() - 1) + (later_field_ ? 1 : 0);
  return number;
}

/// The rows one after the other, each with its frame. That a number has no row is no mistake: the
/// box made no step of it.
Result<std::int64_t> ReplayFrameGrabber::next_row_number() {
  const auto& rows = meta_.rows();
  if (next_row_ == rows.size()) {
    TUBESIGHT_TRY(next_frame());
    return Unexpected(
        fail(Error::kInvalidArgument, meta_name_ + ": no row for the last frames of " + recording_)
            .error());
  }
  const std::int64_t number = rows[next_row_].field;
  if (number / 2 != row_frame_) {
    if (const auto read = next_frame(); !read) {
      return Unexpected(read.error());
    }
    row_frame_ = number / 2;
  }
  later_field_ = number % 2 == 1;
  ++next_row_;
  return number;
}

Result<hal::FieldLease> ReplayFrameGrabber::grab_for(std::chrono::milliseconds) {
  if (!started_ || lent_) {
    return Unexpected(Error::kNotReady);
  }
  if (failed_) {
    return Unexpected(failure_);
  }
  auto next = next_field();
  while (next && passed_over(*next)) {
    next = next_field();
  }
  if (!next) {
    return Unexpected(next.error());
  }
  if (next->mid_exposure > choice_.to) {
    failed_ = true;
    failure_ = Error::kEndOfData;
    return Unexpected(failure_);
  }
  field_number_ = next->number;
  field_time_ = next->mid_exposure;
  lent_ = true;
  return hal::FieldLease(*this, 0, *next);
}

bool ReplayFrameGrabber::passed_over(const core::Field& field) const {
  const bool between = field.number / 2 % choice_.every != 0 ||  // a frame, or
                       (choice_.every > 1 && field.number % 2 == 1);
  return between || field.mid_exposure < choice_.from;
}

Result<core::Field> ReplayFrameGrabber::next_field() {
  const auto next = by_rows_ ? next_row_number() : next_number();
  if (!next) {
    return Unexpected(next.error());
  }
  core::Field field;
  field.parity = core::parity_of(camera_.scan, later_field_);
  field.pixels = core::field_of(frame(), field.parity);
  TUBESIGHT_TRY(describe(*next, field));
  if (field.status == core::FieldStatus::kMissing) {
    field.pixels = {};  // the picture in the file is a filler
  }
  if (!by_rows_) {
    frame_ready_ = interlaced() && !later_field_;
    later_field_ = frame_ready_;
  }
  return field;
}

core::FieldTime ReplayFrameGrabber::shortest_span() const {
  core::FieldTime shortest{0};
  const std::int64_t apart =
      choice_.every == 1 ? 1 : choice_.every * (interlaced() ? 2 : 1);  // fields
  if (!has_meta_) {
    const Y4mHeader& header = reader_.header();
    return apart *
           nominal_field_time(interlaced() ? 1 : 2, header.rate_numerator, header.rate_denominator);
  }
  const auto& rows = meta_.rows();
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const core::FieldTime span = rows[i].time - rows[i - 1].time;
    if (span > core::FieldTime{0} && (shortest == core::FieldTime{0} || span < shortest)) {
      shortest = span;
    }
  }
  return apart * shortest;
}

void ReplayFrameGrabber::give_back(std::int32_t buffer) {
  TUBESIGHT_ASSERT(lent_ && buffer == 0);
  lent_ = false;
}

core::ImageView ReplayFrameGrabber::frame() const {
  const Y4mHeader& header = reader_.header();
  return {pixels_.data(), header.width_px, header.height_px, header.width_px};
}

}  // namespace tubesight::drivers
