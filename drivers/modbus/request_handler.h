#pragma once

#include <cstdint>
#include <span>

#include "core/base/field.h"
#include "core/base/static_vector.h"
#include "drivers/modbus/dialogue.h"

namespace tubesight::drivers {

/// A request or an answer without what the line adds: 253 bytes at most.
inline constexpr std::int32_t kMostPduBytes = 253;
using Pdu = core::StaticVector<std::uint8_t, kMostPduBytes>;

/// The functions that may be sent to all units.
inline constexpr std::uint8_t kWriteOneFunction = 6;
inline constexpr std::uint8_t kWriteManyFunction = 16;

/// Answers Modbus requests for one dialogue: functions 3 and 4 (alike), 6, 16 and 23.
///
/// Bytes in, bytes out: no line, no clock, no heap. Whatever the request holds, there is an answer,
/// at once or, where function 23 wrote a claim, when its verdict is there.
class RequestHandler {
 public:
  enum class Outcome : std::uint8_t {
    kAnswered,  ///< `answer` is whole
    kRefused,   ///< it is an exception
    kWaits,     ///< a claim is to be judged first: finish() makes the answer
  };

  /// `dialogue` outlives the handler.
  explicit RequestHandler(Dialogue& dialogue) : dialogue_(&dialogue) {}

  /// Takes a request, at least its function code, that arrived at an instant.
  [[nodiscard]] Outcome take(std::span<const std::uint8_t> request, core::FieldTime arrival,
                             Pdu& answer);

  /// The answer that was waited for, as the dialogue stands now.
  void finish(core::FieldTime now, Pdu& answer);

 private:
  struct Range {
    std::int32_t first = 0;
    std::int32_t count = 0;
  };

  [[nodiscard]] Refusal read(std::span<const std::uint8_t> request, core::FieldTime now,
                             Pdu& answer);
  [[nodiscard]] Refusal write_one(std::span<const std::uint8_t> request, core::FieldTime arrival,
                                  Pdu& answer);
  [[nodiscard]] Refusal write_many(std::span<const std::uint8_t> request, core::FieldTime arrival,
                                   Pdu& answer);
  [[nodiscard]] Refusal write_and_read(std::span<const std::uint8_t> request,
                                       core::FieldTime arrival, Pdu& answer, bool& waits);
  void answer_range(std::uint8_t function, const Range& range, core::FieldTime now, Pdu& answer);

  Dialogue* dialogue_;
  Range awaited_;  ///< what function 23 reads when its claim is judged
};

}  // namespace tubesight::drivers
