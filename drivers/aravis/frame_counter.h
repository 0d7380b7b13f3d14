#pragma once

#include <cstdint>

namespace tubesight::drivers::aravis {

/// Makes one growing number of the counter that a camera gives its frames.
///
/// Older GigE cameras count with 16 bits, from 1 to 65535 and then from 1 again; newer ones and
/// those of USB with 64. Which of both it is shows at the wrap. One that always says 0 does not
/// count. No heap.
class FrameCounter {
 public:
  struct Step {
    std::int64_t sequence = 0;  ///< in frames
    std::int64_t lost = 0;      ///< frames before this that never came
    bool went_back = false;     ///< the camera's counter did; a gap stands for it
    bool repeated = false;      ///< the same number twice, of a camera that counts
  };

  /// Frames by which numbers jump where the counter begins anew: more than any track coasts over.
  static constexpr std::int64_t kNewBeginning = 120;

  Step next(std::uint64_t id);

  /// The stream begins anew; numbers go on growing.
  void begin_anew() {
    known_ = false;
    counts_ = false;
  }

  /// Whether the camera's counter has moved since the beginning.
  [[nodiscard]] bool counts() const { return counts_; }

 private:
  [[nodiscard]] std::int64_t advance(std::uint64_t id) const;

  std::int64_t sequence_ = 0;
  std::uint64_t id_ = 0;  ///< of the last frame
  bool began_ = false;    ///< there was a frame ever
  bool known_ = false;    ///< there was one since the beginning
  bool counts_ = false;
};

}  // namespace tubesight::drivers::aravis
