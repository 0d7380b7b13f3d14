#pragma once

#include <cstdint>

namespace tubesight::drivers::v4l2 {

/// What one buffer holds.
enum class BufferKind : std::uint8_t {
  kFrame,     ///< a progressive frame
  kPair,      ///< both fields of a frame
  kOneField,  ///< fields by turns
};

/// Makes one number a field of the counter that a driver gives its buffers.
///
/// That counter has 32 bits and begins anew at their end; it may stand still for ever (many drivers
/// don't count), count frames although each buffer is a field (both fields of a frame share one, as
/// the V4L2 specification wants it), or count those too. Which of these it is shows itself, and
/// what was given out before stays. No heap.
class SequenceCounter {
 public:
  struct Step {
    std::int64_t sequence = 0;  ///< of the buffer's first field
    std::int64_t lost = 0;      ///< fields before it that never came
    bool went_back = false;     ///< the driver's counter did; a gap stands for it
    bool repeated = false;      ///< as the one before, of a driver that counts
  };

  /// Fields by which numbers jump where the driver's counter begins anew: more than any track
  /// coasts over.
  static constexpr std::int64_t kNewBeginning = 120;

  explicit SequenceCounter(BufferKind kind) : kind_(kind) {}

  /// The next buffer's counter; `odd`: of the fields by turns, this has the odd lines.
  Step next(std::uint32_t number, bool odd);

  /// The stream begins anew.
  void begin_anew(BufferKind kind);

  /// Whether the driver's counter has ever moved.
  [[nodiscard]] bool counts() const { return counts_; }

 private:
  [[nodiscard]] std::int64_t usual() const { return kind_ == BufferKind::kPair ? 2 : 1; }
  void look_for_pairs(bool moved, bool odd);
  [[nodiscard]] std::int64_t advance(std::uint32_t number, bool odd) const;

  BufferKind kind_;
  std::int64_t sequence_ = 0;  ///< of the last buffer's first field
  std::uint32_t number_ = 0;   ///< of the last buffer
  bool odd_ = false;           ///< the last buffer
  bool began_ = false;         ///< there was a buffer ever
  bool known_ = false;         ///< there was one since the beginning
  bool counts_ = false;
  bool pair_ = false;       ///< the last two buffers had one number and different lines
  bool shared_ = false;     ///< both fields of a frame have one number
  bool odd_first_ = false;  ///< of those
};

}  // namespace tubesight::drivers::v4l2
