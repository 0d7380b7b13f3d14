#pragma once

#include <chrono>
#include <cstdint>
#include <utility>

#include "core/base/field.h"
#include "core/base/result.h"

namespace tubesight::hal {

class FieldLease;

/// Delivers the fields of a camera, or of a recording, in the order of their exposure.
///
/// The driver owns the pixel buffers, all obtained in start(); grab_for() lends one field at a time
/// and the lease gives it back when it dies. At most one lease may be alive (a driver may allow
/// more and say so). One thread calls all functions.
class FrameGrabber {
 public:
  /// Opens the source and obtains all buffers. Needs: not started. After an error the grabber is as
  /// before and start() may be tried again.
  ///
  /// Errors: kIo the source cannot be opened, kUnsupported it does not deliver what the settings
  /// say, kNotReady already started.
  [[nodiscard]] virtual core::Result<void> start() = 0;

  /// Stops the source. No lease may be alive. Calling it when not started does nothing.
  virtual void stop() = 0;

  /// Waits for the next field, at most `timeout` from the call.
  ///
  /// A field with status kDamaged still carries sequence and time; its pixels are not to be used.
  /// Errors: kTimeout no field came (the grabber stays started), kEndOfData a finite source ended,
  /// kDataLoss the source ended in the middle of a frame, kDisconnected the camera is gone,
  /// kIo reading failed, kNotReady not started or a lease is alive.
  [[nodiscard]] virtual core::Result<FieldLease> grab_for(std::chrono::milliseconds timeout) = 0;

  /// Takes a lent buffer back; called by FieldLease only.
  virtual void give_back(std::int32_t buffer) = 0;

 protected:
  ~FrameGrabber() = default;
};

/// A field lent by a FrameGrabber, returned on destruction. Move-only; an empty lease lends
/// nothing.
class FieldLease {
 public:
  FieldLease() = default;
  FieldLease(FrameGrabber& owner, std::int32_t buffer, const core::Field& field)
      : owner_(&owner), buffer_(buffer), field_(field) {}
  FieldLease(FieldLease&& other) noexcept
      : owner_(std::exchange(other.owner_, nullptr)),
        buffer_(other.buffer_),
        field_(other.field_) {}
  FieldLease& operator=(FieldLease&& other) noexcept {
    if (this != &other) {
      release();
      owner_ = std::exchange(other.owner_, nullptr);
      buffer_ = other.buffer_;
      field_ = other.field_;
    }
    return *this;
  }
  FieldLease(const FieldLease&) = delete;
  FieldLease& operator=(const FieldLease&) = delete;
  ~FieldLease() { release(); }

  /// The field; its pixels are valid while this lease lives.
  [[nodiscard]] const core::Field& field() const { return field_; }

 private:
  void release() {
    if (owner_ != nullptr) {
      std::exchange(owner_, nullptr)->give_back(buffer_);
    }
  }

  FrameGrabber* owner_ = nullptr;
  std::int32_t buffer_ = 0;
  core::Field field_{};
};

}  // namespace tubesight::hal
