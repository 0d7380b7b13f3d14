#pragma once

#include <cstdint>
#include <span>

#include "core/base/static_vector.h"
#include "drivers/modbus/request_handler.h"

namespace tubesight::drivers {

/// Head of a frame of Modbus TCP: number, protocol, length (two bytes each), unit.
inline constexpr std::int32_t kTcpHeadBytes = 7;
using TcpFrame = core::StaticVector<std::uint8_t, kTcpHeadBytes + kMostPduBytes>;

/// Finds the frames of Modbus TCP in a stream of bytes. No line, no clock, no heap.
class TcpFramer {
 public:
  enum class Found : std::uint8_t {
    kNothing,
    kRequest,
    kBroken,  ///< not Modbus: nothing that follows can be understood
  };

  /// Takes a byte; needs room, which next() makes.
  void append(std::uint8_t byte);
  [[nodiscard]] Found next();

  /// The request found last and whom it is for; valid until the next call of next().
  [[nodiscard]] std::span<const std::uint8_t> request() const;
  [[nodiscard]] std::uint8_t unit() const { return frame_[kTcpHeadBytes - 1]; }

  /// The frame that carries the answer to that request.
  void wrap(std::span<const std::uint8_t> answer, TcpFrame& frame) const;

  void reset();

 private:
  TcpFrame bytes_;  ///< of the frame that is coming in
  TcpFrame frame_;  ///< that was found last
};

}  // namespace tubesight::drivers
