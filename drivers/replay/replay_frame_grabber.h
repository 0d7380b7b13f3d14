#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/base/settings.h"
#include "drivers/files/byte_source.h"
#include "drivers/files/messages.h"
#include "drivers/files/y4m_reader.h"
#include "drivers/replay/replay_meta.h"
#include "hal/frame_grabber.h"

namespace tubesight::drivers {

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

  /// The shortest time between two fields, by the meta file or the header; zero where neither
  /// tells. Valid once started.
  [[nodiscard]] core::FieldTime shortest_span() const;

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

  core::CameraSettings camera_;
  std::string recording_;
  std::unique_ptr<ByteSource> given_source_;
  std::string given_meta_;
  bool from_memory_ = false;

  Y4mReader reader_;
  ReplayMeta meta_;
  std::string meta_name_;
  bool has_meta_ = false;
  std::vector<std::uint8_t> pixels_;
  Messages messages_;
  std::int64_t field_number_ = -1;
  core::FieldTime field_time_{0};
  std::int64_t sequence_ = 0;
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
