#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/base/settings.h"
#include "drivers/files/byte_source.h"
#include "drivers/files/messages.h"
#include "drivers/files/stamped_source.h"
#include "drivers/files/y4m_reader.h"
#include "drivers/replay/replay_meta.h"
#include "drivers/replay/stamped_time.h"
#include "hal/frame_grabber.h"

namespace tubesight::drivers {

/// Which frames of a recording are delivered. What is left out is missing in sequence and time.
struct FrameChoice {
  core::FieldTime from = core::FieldTime::min();  ///< mid exposure of the first field, at least
  core::FieldTime to = core::FieldTime::max();    ///< of the last one, at most
  /// Every n-th frame, counted from the recording's first; above 1 the earlier field alone of an
  /// interlaced one, so that fields come at even times.
  std::int64_t every = 1;

  [[nodiscard]] bool all() const {
    return from == core::FieldTime::min() && to == core::FieldTime::max() && every == 1;
  }
};

/// Delivers the fields of a recording, as fast as they are asked for.
///
/// An interlaced frame gives two fields in the order of their exposure, a progressive one gives
/// one. Sequence, time, status and lamp level come from `NAME.meta.csv` where it stands beside the
/// recording, and else are: counted from 0, nominal_field_time() of the header's rate, good,
/// unknown. A meta file must have a row for each field and no others. The picture of a field that
/// it calls missing is a filler and is not delivered.
///
/// Whatever fails leaves its lines in messages(), complete with the file's name.
class ReplayFrameGrabber final : public hal::FrameGrabber {
 public:
  /// `camera` is what the recording must agree with: its size, and its scan where the header says
  /// one. Both references are copied.
  ReplayFrameGrabber(const core::CameraSettings& camera, std::string recording);

  /// The same from memory, for tests and fuzzing: `source` is read once, so start() works once.
  /// An empty `meta_text` stands for no meta file.
  ReplayFrameGrabber(const core::CameraSettings& camera, std::unique_ptr<ByteSource> source,
                     std::string name, std::string meta_text);

  /// Takes the recording for one of a box's recorder, which begins in the middle of a mission: the
  /// rows of its meta file are the steps, with the numbers that the box counted, each of the frame
  /// with half that number; the recording has the frames that rows name. There must be a meta file.
  /// Call before start().
  void follow_rows() { by_rows_ = true; }

  /// Takes the pictures from `source` in place of the file, whose name still stands in messages;
  /// companions are read beside it when `companions`. start() then works once. Call before start().
  void read_from(std::unique_ptr<ByteSource> source, bool companions);
  /// The same from a source that tells the times of frames, which then count where there is no meta
  /// file.
  void read_from(std::unique_ptr<StampedSource> source);

  /// Takes the order of lines from the settings alone, whatever the recording's header says of it.
  /// Call before start().
  void ignore_scan_flag() { ignores_scan_flag_ = true; }
  /// Whether start() failed because header and settings disagree about the order of lines.
  [[nodiscard]] bool scan_disagrees() const { return scan_disagrees_; }

  /// Delivers these frames alone; not together with follow_rows(). Call before start().
  void choose(const FrameChoice& choice) { choice_ = choice; }
  [[nodiscard]] const FrameChoice& choice() const { return choice_; }

  /// Opens recording and meta file and reads the first frame. Beside the errors of the interface:
  /// kInvalidArgument the file is no recording, disagrees with `camera`, has no frame or no rate,
  /// or its meta file is wrong; kDataLoss it is cut short within its first frame.
  [[nodiscard]] core::Result<void> start() override;
  void stop() override;

  /// Never waits longer than the disk; `timeout` is not used. Beside the errors of the interface:
  /// kDataLoss the recording is cut short (all fields before are sound; messages() says how many
  /// frames), kIo it is corrupt (the fields before are not to be trusted), kInvalidArgument the
  /// meta file has no row for the next field, or at the end has rows left over. Errors stay.
  [[nodiscard]] core::Result<hal::FieldLease> grab_for(std::chrono::milliseconds timeout) override;
  void give_back(std::int32_t buffer) override;

  /// Number in files of the field last delivered: twice the frame's, plus 1 for the later field of
  /// an interlaced frame. -1 before the first.
  [[nodiscard]] std::int64_t field_number() const { return field_number_; }

  /// Mid-exposure of the field last delivered, and the latest of all since start(): the recording's
  /// own time may run backwards.
  [[nodiscard]] core::FieldTime field_time() const { return field_time_; }

  /// The last frame read, both fields: to draw an overlay on. Valid until the next grab_for().
  [[nodiscard]] core::ImageView frame() const;

  /// What the recording's header says; valid once started.
  [[nodiscard]] const Y4mHeader& header() const { return reader_.header(); }

  /// Whether fields are those of interlaced frames; valid once started.
  [[nodiscard]] bool interlaced() const { return camera_.scan != core::Scan::kProgressive; }

  /// The shortest time between two fields that are delivered, by the meta file or the header; zero
  /// where neither tells. Valid once started.
  [[nodiscard]] core::FieldTime shortest_span() const;

  /// Whether a meta file stands beside the recording; valid once started.
  [[nodiscard]] bool has_meta() const { return has_meta_; }

  /// The share of the recording that was read, 0..1; below 0 where that is not known.
  [[nodiscard]] double share_read() const { return reader_.share_read(); }

  /// Complete frames read so far.
  [[nodiscard]] std::int64_t frames_read() const { return reader_.frames_read(); }

  /// Why start() or grab_for() failed, one line an error.
  [[nodiscard]] const Messages& messages() const { return messages_; }

 private:
  core::Result<void> open();
  core::Result<void> check_header();
  core::Result<void> check_rate_or_meta();
  core::Result<void> fail(core::Error error, std::string message);
  core::Result<void> next_frame();
  core::Result<void> check_meta_used_up();
  core::Result<void> describe(std::int64_t number, core::Field& field);
  core::Result<std::int64_t> next_number();
  core::Result<std::int64_t> next_row_number();
  core::Result<void> read_frame();
  core::Result<core::Field> next_field();
  [[nodiscard]] bool passed_over(const core::Field& field) const;

  core::CameraSettings camera_;
  std::string recording_;
  std::unique_ptr<ByteSource> given_source_;
  std::string given_meta_;
  bool from_memory_ = false;  ///< the meta file is, or there is none
  bool source_given_ = false;
  StampedSource* stamps_ = nullptr;  ///< where the reader's bytes come from; null: no stamps there
  StampedTime stamped_time_;
  FrameChoice choice_;
  bool ignores_scan_flag_ = false;
  bool scan_disagrees_ = false;

  Y4mReader reader_;
  ReplayMeta meta_;
  std::string meta_name_;
  bool has_meta_ = false;
  std::vector<std::uint8_t> pixels_;
  Messages messages_;
  std::int64_t field_number_ = -1;
  core::FieldTime field_time_{0};
  bool by_rows_ = false;
  std::size_t next_row_ = 0;    ///< of the meta file, when it is followed
  std::int64_t row_frame_ = 0;  ///< frame in pixels_, by the rows' numbers
  bool started_ = false;
  bool lent_ = false;
  bool frame_ready_ = false;  ///< the frame in pixels_ has fields that were not delivered
  bool later_field_ = false;  ///< of those, the later one is next
  bool failed_ = false;
  core::Error failure_ = core::Error::kNotReady;
};

}  // namespace tubesight::drivers
