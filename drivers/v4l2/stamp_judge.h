#pragma once

#include <cstdint>

#include "core/base/field.h"

namespace tubesight::drivers::v4l2 {

/// How a camera's fields lie in time.
struct FieldTiming {
  core::FieldTime span{0};      ///< from one field to the next
  core::FieldTime exposure{0};  ///< how long each is exposed
  std::int32_t fields_a_buffer = 1;
};

/// Which clock a buffer's stamp is of, and which moment, as the driver's flags say.
enum class StampKind : std::uint8_t {
  kUnknown,          ///< of a clock that the driver does not name
  kEndOfFrame,       ///< monotonic, when the last line had come
  kStartOfExposure,  ///< monotonic
};

/// Turns the stamps of buffers into instants of mid-exposure, and finds those that cannot be.
///
/// The camera's readout is taken to last one field. Without a stamp that can be used the instant of
/// arrival stands for the end of the frame: as late as the program was. No heap.
class StampJudge {
 public:
  struct Judged {
    core::FieldTime mid_exposure{0};  ///< of the buffer's first field; each grows
    bool wrong = false;               ///< the stamp cannot be: the picture may be of any time
    bool by_arrival = false;          ///< there is no stamp to go by
  };

  /// Stamps in a row that are of no clock of ours, after which arrival stands for them. One that
  /// goes on and lies too far in the past may be true: it is wrong however often it comes.
  static constexpr std::int32_t kMostWrong = 8;

  /// The stream begins at `now`. Instants go on growing over it.
  void begin(const FieldTiming& timing, core::FieldTime now);

  /// A buffer that arrived at `arrival`, with the driver's stamp.
  Judged judge(StampKind kind, core::FieldTime stamp, core::FieldTime arrival);

 private:
  [[nodiscard]] core::FieldTime mid_of_first(StampKind kind, core::FieldTime stamp) const;
  [[nodiscard]] bool old(core::FieldTime stamp, core::FieldTime arrival) const;
  [[nodiscard]] bool plausible(core::FieldTime stamp, core::FieldTime arrival) const;

  FieldTiming timing_;
  core::FieldTime begin_{0};
  core::FieldTime last_{INT64_MIN};        ///< mid-exposure of the last field
  core::FieldTime last_stamp_{INT64_MIN};  ///< that was plausible
  core::FieldTime last_told_{0};           ///< whatever it was
  std::int32_t wrong_in_a_row_ = 0;
  bool distrusted_ = false;
};

}  // namespace tubesight::drivers::v4l2
