#include "drivers/aravis/aravis_frame_grabber.h"

#include <algorithm>

#include "core/base/assert.h"

namespace tubesight::drivers {
namespace {

using core::Error;
using core::FieldTime;
using core::Result;
using core::Unexpected;
using std::chrono::milliseconds;

/// What the buffers bridge while nobody takes any.
constexpr FieldTime kBridged = milliseconds(250);
constexpr std::int32_t kFewestBuffers = 8;

std::int32_t buffers_at(FieldTime frame) {
  const auto bridging = static_cast<std::int32_t>(
      std::min<std::int64_t>(kBridged / std::max(frame, FieldTime{1}), 1000));
  return std::clamp(bridging, kFewestBuffers, aravis::Device::kMostBuffers);
}

}  // namespace

AravisFrameGrabber::AravisFrameGrabber(const AravisSettings& settings, const hal::Clock& clock,
                                       aravis::Library& library)
    : settings_(settings), clock_(&clock), library_(&library), identity_(settings.calibrated) {}

Result<void> AravisFrameGrabber::start() {
  if (started_) {
    return Unexpected(Error::kNotReady);
  }
  messages_.clear();
  std::string message;
  if (const auto opened = open(message); !opened) {
    messages_.push_back("camera " + settings_.device + ": " + message);
    if (device_ != nullptr) {
      library_->close(*device_);
      device_ = nullptr;
    }
    report_.trouble = AravisTrouble::kNotOpen;
    publish();
    return opened;
  }
  judge_.begin(settings_.scan, agreed_);
  counted_ = {};
  fields_left_ = 0;
  failed_ = false;
  silence_.begin(clock_->now());
  started_ = true;
  report_.trouble = AravisTrouble::kNone;
  publish();
  return {};
}

Result<void> AravisFrameGrabber::open(std::string& message) {
  const auto opened = library_->open(settings_.device, message);
  if (!opened) {
    return Unexpected(opened.error());
  }
  device_ = *opened;
  const CameraIdentity found{device_->serial(), device_->maker_and_model()};
  message = identity_.refusal(found);
  if (!message.empty()) {
    return Unexpected(Error::kUnsupported);
  }
  agreed_ = {};
  TUBESIGHT_TRY(aravis::set_up(*device_, settings_, safe_packets_, agreed_, message));
  const std::int32_t buffers = buffers_at(agreed_.frame());
  pool_.resize(agreed_.buffer_bytes * static_cast<std::size_t>(buffers));
  if (!agreed_.format.lendable()) {
    grey_.resize(static_cast<std::size_t>(agreed_.width_px) *
                 static_cast<std::size_t>(agreed_.height_px));
  }
  const aravis::StreamPlan plan{pool_,           agreed_.buffer_bytes, buffers, settings_.resend,
                                agreed_.frame(), settings_.priority};
  std::string why;
  if (!device_->begin(plan, *clock_, why)) {
    message = "does not start to stream: " + why;
    return Unexpected(Error::kIo);
  }
  identity_.keep(found);
  return {};
}

void AravisFrameGrabber::stop() {
  TUBESIGHT_ASSERT(!lent_);
  if (!started_) {
    return;
  }
  look_after();
  started_ = false;
  // What was negotiated may be more than the network takes: cameras and switches err there.
  const bool negotiated = agreed_.packet_bytes != 0 && settings_.packet_bytes == 0;
  safe_packets_ = negotiated && failed_ && !judge_.had_complete() && !safe_packets_;
  // One that is silent is stopped at the next start, should it live.
  device_->end(failed_);
  library_->close(*device_);
  device_ = nullptr;
  report_.trouble = AravisTrouble::kNotOpen;
  publish();
}

void AravisFrameGrabber::look_after() {
  if (!started_) {
    return;
  }
  device_->look_after();
  const aravis::StreamCounts now = device_->counts();
  underruns_ += now.underruns - counted_.underruns;
  resent_packets_ += now.resent_packets - counted_.resent_packets;
  missing_packets_ += now.missing_packets - counted_.missing_packets;
  counted_ = now;
}

Result<hal::FieldLease> AravisFrameGrabber::grab_for(milliseconds timeout) {
  if (!started_ || lent_) {
    return Unexpected(Error::kNotReady);
  }
  if (failed_) {
    return Unexpected(failure_);
  }
  if (fields_left_ == 0) {
    if (const auto got = next_picture(timeout); !got) {
      publish();
      return Unexpected(got.error());
    }
  }
  hal::FieldLease lease = lend();
  publish();
  return lease;
}

Result<void> AravisFrameGrabber::next_picture(milliseconds timeout) {
  aravis::Picture picture;
  switch (device_->take(timeout, picture)) {
    case aravis::Taken::kNothing: return nothing_came();
    case aravis::Taken::kControlLost:
      ++report_.counters.controls_lost;
      return break_off(AravisTrouble::kControlLost, Error::kDisconnected);
    case aravis::Taken::kPicture: break;
  }
  silence_.broken(clock_->now());
  held_ = picture.buffer;
  fields_left_ = fields_a_picture();
  next_ = judge_.first_field(picture);
  // A packet size that does not come through, from the start or since something on the path is
  // another: pictures begin and none is ever whole.
  if (picture.complete) {
    silence_.whole();
  }
  if (silence_.broken_for_long(agreed_.span)) {
    device_->give_back(held_);
    fields_left_ = 0;
    return break_off(AravisTrouble::kIncomplete, Error::kIo);
  }
  return {};
}

Result<void> AravisFrameGrabber::nothing_came() {
  if (!silence_.too_long(clock_->now(), agreed_.span)) {
    return Unexpected(Error::kTimeout);
  }
  ++report_.counters.silences;
  return break_off(AravisTrouble::kSilent, Error::kIo);
}

Result<void> AravisFrameGrabber::break_off(AravisTrouble trouble, Error error) {
  report_.trouble = trouble;
  failed_ = true;
  failure_ = error;
  return Unexpected(error);
}

core::FieldView AravisFrameGrabber::view_of(core::Parity parity) {
  const std::int32_t width = agreed_.width_px;
  const std::byte* const picture =
      pool_.data() + static_cast<std::size_t>(held_) * agreed_.buffer_bytes;
  if (agreed_.format.lendable()) {
    return core::field_of(
        {reinterpret_cast<const std::uint8_t*>(picture), width, agreed_.height_px, width}, parity);
  }
  const core::FieldView lines =
      core::field_of({grey_.data(), width, agreed_.height_px, width}, parity);
  const std::ptrdiff_t line_bytes = agreed_.format.line_bytes(width);
  for (std::int32_t line = 0; line < lines.lines; ++line) {
    const std::ptrdiff_t v = lines.first_line + line * lines.line_step;
    aravis::extract_line(agreed_.format, picture + v * line_bytes, width, grey_.data() + v * width);
  }
  return lines;
}

hal::FieldLease AravisFrameGrabber::lend() {
  core::Field field = next_;
  field.pixels = view_of(field.parity);
  judge_.look_at_picture(field);
  if (--fields_left_ > 0) {
    next_ = judge_.second_field();
  }
  lent_ = true;
  return {*this, held_, field};
}

void AravisFrameGrabber::give_back(std::int32_t buffer) {
  TUBESIGHT_ASSERT(lent_ && buffer == held_);
  lent_ = false;
  if (fields_left_ == 0) {
    device_->give_back(held_);
  }
}

void AravisFrameGrabber::publish() {
  report_.counters.underruns = underruns_;
  report_.counters.resent_packets = resent_packets_;
  report_.counters.missing_packets = missing_packets_;
  latest_.publish(report_);
}

AravisReport AravisFrameGrabber::report() const {
  AravisReport report;
  static_cast<void>(latest_.try_read(report));
  return report;
}

}  // namespace tubesight::drivers
