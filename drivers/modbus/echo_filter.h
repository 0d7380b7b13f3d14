#pragma once

#include <cstdint>
#include <span>

#include "core/base/field.h"
#include "drivers/modbus/rtu_framer.h"

namespace tubesight::drivers {

/// Keeps what comes back of the box's own answers from being taken for requests: on two wires a
/// receiver that is not switched off while the driver sends hears it.
///
/// What comes back comes before anything else, so that only the first bytes after an answer are
/// compared with it. The answer to function 6 equals its request, and the same request may come
/// again: it is an echo on a line that has given one before, and on one of which nothing is known
/// where it comes sooner than a master can have heard the answer and asked again, or as the fourth
/// in quick succession. No line, no clock, no heap.
class EchoFilter {
 public:
  enum class Byte : std::uint8_t {
    kHeld,   ///< may belong to an echo: more bytes tell
    kEcho,   ///< the last byte of one; answer_bytes() have come back
    kOther,  ///< held() is to be read, this byte included
  };

  /// An answer was sent; before `soonest` no master can have sent as many bytes in reply.
  void expect(const RtuFrame& answer, core::FieldTime soonest);

  [[nodiscard]] Byte take(std::uint8_t byte, core::FieldTime arrival);

  /// A request was found in what was let through. Whether it is an echo all the same, behind noise.
  [[nodiscard]] bool is_echo(std::span<const std::uint8_t> request, core::FieldTime arrival);

  /// Whether bytes wait for more, or for silence.
  [[nodiscard]] bool holds() const { return compares_ && !held_.empty(); }
  /// The line fell silent: what is held is no echo.
  void let_go();

  [[nodiscard]] std::span<const std::uint8_t> held() const { return held_.view(); }
  [[nodiscard]] std::int32_t answer_bytes() const { return answer_.size(); }

 private:
  enum class Line : std::uint8_t { kNew, kEchoes, kDoesNot };

  [[nodiscard]] bool comes_as_echo(core::FieldTime arrival) const;

  RtuFrame answer_;
  core::FieldTime soonest_{0};
  RtuFrame held_;
  bool compares_ = false;         ///< all that came since the answer was like it
  bool waits_for_frame_ = false;  ///< nothing sound has come since the answer
  std::int32_t passed_ = 0;       ///< bytes let through since the answer
  std::int32_t same_ = 0;         ///< writes like the answer before them, in succession
  Line line_ = Line::kNew;
};

}  // namespace tubesight::drivers
