#include "drivers/modbus/rtu_framer.h"

#include <array>
#include <cstddef>

#include "core/base/assert.h"
#include "drivers/modbus/crc16.h"

namespace tubesight::drivers {
namespace {

constexpr std::int32_t kShortest = 4;    // unit, function, check sum
constexpr std::int32_t kTrailer = 2;     // the check sum
constexpr std::int32_t kAnyLength = -1;  // the function's requests are of any length
constexpr std::int32_t kNotYet = -2;     // the byte that tells the length is still to come
constexpr std::uint8_t kBroadcastUnit = 0;
constexpr std::uint8_t kException = 0x80;

// Bytes that a line driver may add in front of a frame while it is switched on.
constexpr std::int32_t kMostGlitches = 3;

/// A length that the byte at `at` adds to.
std::int32_t counted(const RtuFrame& frame, std::int32_t at, std::int32_t fixed) {
  return frame.size() > at ? fixed + frame[at] : kNotYet;
}

/// Bytes of the request that begins so, whole frame.
std::int32_t request_length(const RtuFrame& frame) {
  switch (frame[1]) {
    case 1:
    case 2:
    case 3:
    case 4:
    case 5:
    case 6:
    case 8: return 8;
    case 7:
    case 11:
    case 12:
    case 17: return 4;
    case 15:
    case 16: return counted(frame, 6, 9);
    case 22: return 10;
    case 23: return counted(frame, 10, 13);
    case 24: return 6;
    default: return kAnyLength;
  }
}

/// Bytes of the answer that begins so, whole frame.
std::int32_t answer_length(const RtuFrame& frame) {
  if ((frame[1] & kException) != 0) {
    return 5;
  }
  switch (frame[1]) {
    case 1:
    case 2:
    case 3:
    case 4:
    case 12:
    case 17:
    case 23: return counted(frame, 2, 5);
    case 5:
    case 6:
    case 8:
    case 11:
    case 15:
    case 16: return 8;
    case 7: return 5;
    case 22: return 10;
    default: return kAnyLength;
  }
}

}  // namespace

void RtuFramer::append(std::uint8_t byte) {
  const bool fits = bytes_.try_push_back(byte);
  TUBESIGHT_ASSERT(fits);  // next() makes room
}

Found RtuFramer::next() {
  while (true) {
    while (scanned_ < bytes_.size()) {
      const std::uint8_t byte = bytes_[scanned_];
      crc_ = crc16(std::span(&byte, 1), crc_);
      ++scanned_;
      if (scanned_ >= kShortest && crc_ == 0 && ends_frame(scanned_)) {
        if (const Found found = deliver(scanned_); found != Found::kNothing) {
          return found;
        }
      }
    }
    if (!bytes_.full()) {
      return Found::kNothing;
    }
    // Longer than any frame: the next may begin with the next byte that is our unit.
    std::int32_t stray = 1;
    while (stray < bytes_.size() && bytes_[stray] != unit_) {
      ++stray;
    }
    counters_->stray_bytes += static_cast<std::uint32_t>(stray);
    drop(stray);
  }
}

bool RtuFramer::ends_frame(std::int32_t bytes) const {
  const bool ours = bytes_[0] == unit_ || bytes_[0] == kBroadcastUnit;
  const std::int32_t request = request_length(bytes_);
  // Of our own answers only exceptions can be told from requests.
  const bool told = !ours || (bytes_[1] & kException) != 0;
  const std::int32_t answer = told ? answer_length(bytes_) : kNotYet;
  if (request == kAnyLength && answer == kAnyLength) {
    return true;  // its check sum fits, and nothing else can tell; for us only a silence ends it
  }
  return request == bytes || answer == bytes;
}

/// Takes the first bytes out, a frame whose check sum fits.
Found RtuFramer::deliver(std::int32_t bytes) {
  const std::uint8_t unit = bytes_[0];
  Found found = Found::kNothing;
  if (unit == unit_ && (bytes_[1] & kException) != 0) {
    // An exception: our own that came back, or somebody else's under our unit.
    counters_->stray_bytes += static_cast<std::uint32_t>(bytes);
  } else if (unit == unit_) {
    ++counters_->requests;
    found = Found::kRequest;
  } else if (unit == kBroadcastUnit) {
    ++counters_->broadcasts;
    found = Found::kBroadcast;
  } else {
    ++counters_->other_units;
  }
  request_.clear();
  for (std::int32_t i = 1; i < bytes - kTrailer; ++i) {
    static_cast<void>(request_.try_push_back(bytes_[i]));
  }
  drop(bytes);
  return found;
}

Found RtuFramer::silence() {
  const std::int32_t count = bytes_.size();
  if (count == 0) {
    return Found::kNothing;
  }
  // A frame of another length than its function says still is one: the answer is an exception.
  if (count >= kShortest && crc_ == 0) {
    return deliver(count);
  }
  if (const Found found = deliver_behind_noise(); found != Found::kNothing) {
    return found;
  }
  const std::int32_t expected = count < 2 ? kNotYet : request_length(bytes_);
  if (count < kShortest || expected == kNotYet || count < expected) {
    ++counters_->cut_frames;
  } else {
    ++counters_->crc_errors;
  }
  drop(count);
  return Found::kNothing;
}

Found RtuFramer::deliver_behind_noise() {
  const std::int32_t count = bytes_.size();
  for (std::int32_t noise = 1; noise <= kMostGlitches && noise + kShortest <= count; ++noise) {
    const auto frame = bytes_.view().subspan(static_cast<std::size_t>(noise));
    if (frame[0] == unit_ && (frame[1] & kException) == 0 && crc16(frame) == 0) {
      counters_->stray_bytes += static_cast<std::uint32_t>(noise);
      drop(noise);
      return deliver(count - noise);
    }
  }
  return Found::kNothing;
}

void RtuFramer::drop(std::int32_t bytes) {
  const std::int32_t left = bytes_.size() - bytes;
  for (std::int32_t i = 0; i < left; ++i) {
    bytes_[i] = bytes_[i + bytes];
  }
  bytes_.truncate(left);
  scanned_ = 0;
  crc_ = 0xFFFF;
}

void RtuFramer::reset() { drop(bytes_.size()); }

void RtuFramer::wrap(std::uint8_t unit, std::span<const std::uint8_t> answer, RtuFrame& frame) {
  frame.clear();
  bool fits = frame.try_push_back(unit);
  for (const std::uint8_t byte : answer) {
    fits = frame.try_push_back(byte) && fits;
  }
  const std::uint16_t crc = crc16(frame.view());
  fits = frame.try_push_back(static_cast<std::uint8_t>(crc & 0xFFU)) && fits;
  fits = frame.try_push_back(static_cast<std::uint8_t>(crc >> 8U)) && fits;
  TUBESIGHT_ASSERT(fits);
}

}  // namespace tubesight::drivers
