#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/base/snapshot.h"
#include "drivers/aravis/aravis_report.h"
#include "drivers/aravis/aravis_settings.h"
#include "drivers/aravis/camera_setup.h"
#include "drivers/aravis/library.h"
#include "drivers/aravis/picture_judge.h"
#include "drivers/camera/camera_identity.h"
#include "drivers/camera/silence.h"
#include "hal/clock.h"
#include "hal/frame_grabber.h"

namespace tubesight::drivers {

/// A camera of GigE Vision or USB3 Vision, by the library Aravis, with what is wanted of it agreed
/// and checked; pictures come into buffers of our own.
///
/// Lines of 8 bits are lent where the library put them; of deeper formats the upper 8 bits of one
/// field are taken out when it is lent. A picture may hold both fields of an interlaced frame, line
/// by line: so converters of analogue video deliver.
///
/// What cannot be believed is a damaged field: what is incomplete, of another size, snow, a picture
/// of one grey, what comes twice or with a time that cannot be, and the first ones after a start.
/// What ends the stream ends it for good: grab_for() says the error until stop() and start(), which
/// take seconds when the camera is gone. The library tells a loss 5 s late: a time-out of our own
/// is what finds it.
///
/// start(), stop() and look_after() belong to one thread, grab_for() and give_back() to another or
/// the same; between the two kinds whoever owns the grabber hands it over. Those two allocate
/// nothing; the library's own threads do.
class AravisFrameGrabber final : public hal::FrameGrabber {
 public:
  /// `clock` is the system's monotonic one; it and `library` outlive the grabber.
  AravisFrameGrabber(const AravisSettings& settings, const hal::Clock& clock,
                     aravis::Library& library = aravis::system_library());
  AravisFrameGrabber(const AravisFrameGrabber&) = delete;
  AravisFrameGrabber& operator=(const AravisFrameGrabber&) = delete;
  ~AravisFrameGrabber() { stop(); }

  /// May take seconds. Errors beside those of the interface: kDisconnected the camera is not there;
  /// messages() says what is wrong.
  [[nodiscard]] core::Result<void> start() override;
  void stop() override;

  [[nodiscard]] core::Result<hal::FieldLease> grab_for(std::chrono::milliseconds timeout) override;
  void give_back(std::int32_t buffer) override;

  /// Reads what the library has counted; to be called some times a second between start() and
  /// stop().
  void look_after();

  /// Lines of the last start(), for a person.
  [[nodiscard]] const std::vector<std::string>& messages() const { return messages_; }

  /// What the calibration leaves open of the camera that was opened last; of the thread that
  /// starts.
  [[nodiscard]] std::string doubt() const { return identity_.doubt(); }

  /// From one field to the next, and fields that come at once; valid once started.
  [[nodiscard]] core::FieldTime span() const { return agreed_.span; }
  [[nodiscard]] std::int32_t fields_a_picture() const { return agreed_.pair ? 2 : 1; }
  /// What was agreed; valid once started.
  [[nodiscard]] const aravis::AgreedPicture& agreed() const { return agreed_; }

  /// How the camera is doing. Any thread.
  [[nodiscard]] AravisReport report() const;

 private:
  core::Result<void> open(std::string& message);
  core::Result<void> next_picture(std::chrono::milliseconds timeout);
  core::Result<void> nothing_came();
  core::Result<void> break_off(AravisTrouble trouble, core::Error error);
  hal::FieldLease lend();
  [[nodiscard]] core::FieldView view_of(core::Parity parity);
  void publish();

  AravisSettings settings_;
  const hal::Clock* clock_;
  aravis::Library* library_;
  std::vector<std::string> messages_;

  // Of the thread that starts.
  IdentityWatch identity_;
  aravis::Device* device_ = nullptr;
  aravis::StreamCounts counted_;    ///< of this stream, so far
  bool safe_packets_ = false;       ///< the next start does not negotiate them
  std::vector<std::byte> pool_;     ///< what pictures come into
  std::vector<std::uint8_t> grey_;  ///< of one field, where it is taken out
  aravis::AgreedPicture agreed_;

  AravisReport report_;
  aravis::PictureJudge judge_{report_};
  bool started_ = false;
  bool lent_ = false;
  bool failed_ = false;
  core::Error failure_ = core::Error::kNotReady;
  std::int32_t held_ = 0;         ///< the buffer in our hands
  std::int32_t fields_left_ = 0;  ///< of it, not lent yet
  core::Field next_;              ///< the first of those, but for its pixels
  Silence silence_;

  std::atomic<std::int64_t> underruns_{0};
  std::atomic<std::int64_t> resent_packets_{0};
  std::atomic<std::int64_t> missing_packets_{0};
  core::Snapshot<AravisReport> latest_;
};

}  // namespace tubesight::drivers
