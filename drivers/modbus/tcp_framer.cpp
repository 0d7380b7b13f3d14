#include "drivers/modbus/tcp_framer.h"

#include <cstddef>

#include "core/base/assert.h"

namespace tubesight::drivers {
namespace {

// The length counts the unit and what follows.
constexpr std::int32_t kBeforeUnit = kTcpHeadBytes - 1;

}  // namespace

void TcpFramer::append(std::uint8_t byte) {
  const bool fits = bytes_.try_push_back(byte);
  TUBESIGHT_ASSERT(fits);
}

TcpFramer::Found TcpFramer::next() {
  if (bytes_.size() < kBeforeUnit) {
    return Found::kNothing;
  }
  const std::int32_t length = bytes_[4] << 8 | bytes_[5];
  if (bytes_[2] != 0 || bytes_[3] != 0 || length < 2 || length > 1 + kMostPduBytes) {
    return Found::kBroken;
  }
  if (bytes_.size() < kBeforeUnit + length) {
    return Found::kNothing;
  }
  frame_ = bytes_;
  bytes_.clear();
  return Found::kRequest;
}

std::span<const std::uint8_t> TcpFramer::request() const {
  return frame_.view().subspan(static_cast<std::size_t>(kTcpHeadBytes));
}

void TcpFramer::wrap(std::span<const std::uint8_t> answer, TcpFrame& frame) const {
  frame.clear();
  const auto length = static_cast<std::int32_t>(answer.size()) + 1;
  for (const std::int32_t byte : {std::int32_t{frame_[0]}, std::int32_t{frame_[1]}, 0, 0,
                                  length >> 8, length & 0xFF, std::int32_t{unit()}}) {
    static_cast<void>(frame.try_push_back(static_cast<std::uint8_t>(byte)));
  }
  bool fits = true;
  for (const std::uint8_t byte : answer) {
    fits = frame.try_push_back(byte) && fits;
  }
  TUBESIGHT_ASSERT(fits);
}

void TcpFramer::reset() { bytes_.clear(); }

}  // namespace tubesight::drivers
