#pragma once

#include <cstdint>
#include <span>

#include "core/base/static_vector.h"
#include "drivers/modbus/link_state.h"
#include "drivers/modbus/request_handler.h"

namespace tubesight::drivers {

/// Longest frame of Modbus RTU: unit, request or answer, check sum.
inline constexpr std::int32_t kMostFrameBytes = 256;
using RtuFrame = core::StaticVector<std::uint8_t, kMostFrameBytes>;

/// What came for this box.
enum class Found : std::uint8_t {
  kNothing,
  kRequest,    ///< to this unit
  kBroadcast,  ///< to all units: to be obeyed, not to be answered
};

/// Finds the frames of Modbus RTU in a stream of bytes.
///
/// A frame ends where its function says and its check sum fits, at once, or where the line falls
/// silent; only there a new one begins. What other units ask and answer is followed by the same
/// rules, so that nothing inside it is taken for a request. After a frame that is cut or garbled
/// the next begins with the next silence; on a line that never is silent, where the bytes make
/// sense again. An exception is nobody's request. All is counted. No line, no clock, no heap.
class RtuFramer {
 public:
  /// Counts into `counters`, which outlive the framer.
  RtuFramer(std::uint8_t unit, LinkCounters& counters) : unit_(unit), counters_(&counters) {}

  /// Takes a byte; call next() after each until there is nothing.
  void append(std::uint8_t byte);
  [[nodiscard]] Found next();

  /// The line has been silent for longer than within a frame.
  [[nodiscard]] Found silence();

  /// Whether bytes wait for more, or for silence.
  [[nodiscard]] bool waits() const { return !bytes_.empty(); }

  /// The request found last; valid until the next call of next() or silence().
  [[nodiscard]] std::span<const std::uint8_t> request() const { return request_.view(); }

  /// Forgets what came: the line was opened anew.
  void reset();

  /// The frame that carries an answer of this unit.
  static void wrap(std::uint8_t unit, std::span<const std::uint8_t> answer, RtuFrame& frame);

 private:
  [[nodiscard]] bool ends_frame(std::int32_t bytes) const;
  [[nodiscard]] Found deliver(std::int32_t bytes);
  [[nodiscard]] Found deliver_behind_noise();
  void drop(std::int32_t bytes);

  std::uint8_t unit_;
  LinkCounters* counters_;
  RtuFrame bytes_;
  std::int32_t scanned_ = 0;  ///< of them; their check sum:
  std::uint16_t crc_ = 0xFFFF;
  Pdu request_;
};

}  // namespace tubesight::drivers
