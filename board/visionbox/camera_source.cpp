#include "board/visionbox/camera_source.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace tubesight::board {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;
using std::chrono::milliseconds;

/// Until the camera was opened: a field of 60 a second.
constexpr core::FieldTime kUsualSpan{16'666'667};
/// Longer than opening takes as a rule; a start that takes longer goes on beside the box.
constexpr std::chrono::seconds kLongestStart{2};

}  // namespace

CameraSource::CameraSource(Camera& camera, Tell tell, const Waits& waits)
    : camera_(&camera), tell_(std::move(tell)), waits_(waits), span_ns_(kUsualSpan.count()) {}

Result<void> CameraSource::start() {
  if (started_) {
    return Unexpected(Error::kNotReady);
  }
  started_ = true;
  stopping_ = false;
  thread_ = std::thread([this] { keep(); });
  opened_.wait_until(monotonic_now() + kLongestStart);
  return {};
}

void CameraSource::stop() {
  if (!started_) {
    return;
  }
  stopping_ = true;
  stirred_.wake();
  thread_.join();
  started_ = false;
  camera_->grabber().stop();
  phase_ = Phase::kClosed;
}

void CameraSource::keep() {
  milliseconds wait = waits_.first;
  while (!stopping_) {
    if (phase_ == Phase::kOpen) {
      camera_->look_after();
      tell_state();
      pause(waits_.look);
      continue;
    }
    if (phase_ == Phase::kBroken) {
      ++failures_;
      tell_once("camera: " + camera_->status().words);
      camera_->grabber().stop();
      wait = delivered_ ? waits_.first : wait;
      phase_ = Phase::kClosed;
    } else if (open()) {
      opened_.wake();
      continue;
    }
    opened_.wake();
    pause(wait);
    wait = std::min(2 * wait, waits_.longest);
  }
}

bool CameraSource::open() {
  const auto started = camera_->grabber().start();
  tried_ = true;
  if (!started) {
    ++failures_;
    tell_once(camera_->message());
    return false;
  }
  told_.clear();
  tell_("camera: opened");
  const std::string doubt = camera_->doubt();
  if (!doubt.empty() && doubt != this->doubt()) {
    tell_("camera: " + doubt);
  }
  {
    const std::scoped_lock lock(doubt_mutex_);
    doubt_ = doubt;
  }
  state_told_ = false;
  state_looks_ = 0;  // what it was before the opening was told of that one
  span_ns_ = camera_->span().count();
  fields_at_once_ = camera_->fields_at_once();
  delivered_ = false;
  ++passes_;
  phase_ = Phase::kOpen;
  return true;
}

/// One that is tried again and again fails in the same way.
void CameraSource::tell_once(const std::string& line) {
  if (line != told_) {
    tell_(line);
    told_ = line;
  }
}

void CameraSource::pause(milliseconds longest) { stirred_.wait_until(monotonic_now() + longest); }

/// A trouble that stays, while fields come: one look may find a single field's.
void CameraSource::tell_state() {
  constexpr std::int32_t kLooks = 4;
  const CameraStatus now = camera_->status();
  state_looks_ = now.words == state_ ? state_looks_ + 1 : 1;
  state_ = now.words;
  if (state_looks_ != kLooks || (now.well && !state_told_)) {
    return;
  }
  tell_("camera: " + now.words + (now.well ? " again" : ""));
  state_told_ = !now.well;
}

std::string CameraSource::doubt() const {
  const std::scoped_lock lock(doubt_mutex_);
  return doubt_;
}

SourceState CameraSource::state() const {
  if (phase_ == Phase::kOpen) {
    return delivered_ ? SourceState::kPlaying : SourceState::kOpening;
  }
  return tried_ ? SourceState::kFailed : SourceState::kOpening;
}

Result<hal::FieldLease> CameraSource::grab_for(milliseconds timeout) {
  if (!started_) {
    return Unexpected(Error::kNotReady);
  }
  if (phase_ != Phase::kOpen) {
    return Unexpected(Error::kDisconnected);
  }
  auto lease = camera_->grabber().grab_for(timeout);
  if (lease) {
    measure(lease->field());
    delivered_ = true;
    return lease;
  }
  if (lease.error() == Error::kTimeout || lease.error() == Error::kNotReady) {
    return lease;
  }
  phase_ = Phase::kBroken;
  stirred_.wake();
  return Unexpected(Error::kDisconnected);
}

void CameraSource::measure(const core::Field& field) {
  handed_over_ = monotonic_now();
  if (pass_ != passes_) {
    pass_ = passes_;
    shortest_way_.fill(core::FieldTime::max());
  }
  core::FieldTime& shortest = shortest_way_[static_cast<std::size_t>(field.number % 2)];
  shortest = std::min(shortest, handed_over_ - field.mid_exposure);
  due_ = field.mid_exposure + shortest;
}

}  // namespace tubesight::board
