#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/base/field.h"

namespace tubesight::drivers::aravis {

/// Turns stamps of a camera's own clock into instants of ours.
///
/// A picture arrives after its stamp by a delay that is never shorter than some least one; the
/// smallest difference of both clocks that was seen is that of a picture which nothing kept
/// waiting. So
///
///     time = stamp + min over recent pictures (arrival - stamp),
///
/// the instant at which the picture would have arrived without waiting, whatever moment of its
/// exposure the camera stamps. Quartzes differ by up to 100 millionths: the minima of whole seconds
/// are kept for eight of them, and the line through the older and the newer half of them is
/// followed. Differences that grow faster than two quartzes part are pictures that wait, as a
/// camera with much memory behind a slow network lets them: they keep their own times, and are
/// never taken for present ones. No heap.
class CameraClock {
 public:
  enum class Verdict : std::uint8_t {
    kGood,
    kSettling,   ///< too few pictures, or old ones that a camera still had: not to be believed yet
    kJumped,     ///< the camera's clock went ahead of ours
    kWentBack,   ///< the stamp is not after the one before
    kTooOld,     ///< the picture waited longer than all buffers together hold, or the clock is slow
    kByArrival,  ///< there is no stamp to go by: the time is that of arrival
  };

  struct Reading {
    core::FieldTime time{0};
    Verdict verdict = Verdict::kGood;
  };

  /// Pictures in a row that must agree before any is believed.
  static constexpr std::int32_t kSettled = 3;
  /// Pictures without agreement after which the stamps are not looked at until the next begin().
  static constexpr std::int32_t kMostUnsettled = 60;

  /// The stream begins anew, with `frame` from one picture to the next.
  void begin(core::FieldTime frame);

  /// A picture's stamp, 0: it has none, and when it arrived.
  Reading read(std::uint64_t stamp_ns, core::FieldTime arrival);

  /// Whether stamps are gone by.
  [[nodiscard]] bool trusted() const { return last_stamp_ != 0 && !distrusted_; }

 private:
  /// The smallest difference within a second of the camera's.
  struct Least {
    std::int64_t second = 0;
    std::int64_t at = 0;  ///< stamp
    std::int64_t difference = 0;
  };
  static constexpr std::size_t kSeconds = 8;

  void forget();
  void take(std::int64_t stamp, std::int64_t difference);
  void follow_drift();
  [[nodiscard]] std::int64_t least_at(std::int64_t stamp) const;
  [[nodiscard]] std::int64_t floor_at(std::int64_t stamp) const;
  [[nodiscard]] const Least& least_of(std::size_t from, std::size_t to) const;
  Reading doubt(Verdict verdict, core::FieldTime arrival);

  core::FieldTime frame_{0};
  std::array<Least, kSeconds> least_{};  ///< the oldest first
  std::size_t seconds_ = 0;              ///< of those, known
  std::int64_t drift_ppb_ = 0;           ///< of the difference
  std::int64_t floor_ = INT64_MAX;       ///< difference of a picture that did not wait; unknown
  std::int64_t floor_at_ = 0;            ///< stamp
  std::int64_t last_stamp_ = 0;          ///< 0: there was none
  std::int32_t agreed_ = 0;              ///< pictures in a row
  std::int32_t unsettled_ = 0;           ///< pictures in a row
  bool distrusted_ = false;
};

}  // namespace tubesight::drivers::aravis
