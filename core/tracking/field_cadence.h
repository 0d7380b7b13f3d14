#pragma once

#include <cstdint>

#include "core/base/field.h"

namespace tubesight::core::tracking {

/// The even beat of a camera, fitted to the numbers and the wavering stamps of its fields.
///
/// A straight line through (number, stamp): instant and period by a filter of growing memory
/// [Brookner1998 ch. 1], which is least squares for the first fields and forgets after 32 of
/// them. A stamp that is farther from it than stamps waver is none of it: after two the line goes
/// on from there with the period that it had, and after a few with none. Numbers must grow from
/// field to field, or there is no beat. Integers alone.
class FieldCadence {
 public:
  /// What a field's stamp is against the beat.
  enum class Stamp : std::uint8_t {
    kAlone,  ///< no beat is known, or it is lost here: the stamps are all there is
    kExact,  ///< on it, to half a millisecond
    kWavers  ///< beside it
  };

  /// What the next field's stamp is, `numbers` after the last one.
  [[nodiscard]] Stamp judge(FieldTime stamp, std::int64_t numbers) const;

  /// Takes the next field, or the first.
  void follow(FieldTime stamp, std::int64_t numbers);

  /// Time of so many numbers. Valid where a stamp is not kAlone.
  [[nodiscard]] FieldTime time_of(std::int64_t numbers) const {
    return FieldTime(numbers * std::int64_t{period_ns_});
  }

  /// By how much numbers grow from field to field; 1 at least. Valid where a stamp is not kAlone.
  [[nodiscard]] std::int64_t step() const { return step_; }

  /// The members of the state; see core/base/state_stream.h.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [beat, period, waver, step, count, strayed] = self;
    constexpr std::int32_t kSecond_ns = 1'000'000'000;
    stream(beat);
    stream.number(period, 0, kSecond_ns);
    stream.number(waver, 0, kSecond_ns);
    stream.number(step, 0, kMostNumbers);
    stream.number(count, 0, kMemory);
    stream(strayed);
  }

 private:
  static constexpr std::int32_t kMostNumbers = 1'000;
  static constexpr std::int32_t kMemory = 32;

  void begin_at(FieldTime stamp);

  FieldTime beat_{0};           ///< of the last field
  std::int32_t period_ns_ = 0;  ///< of a number; 0: not known
  std::int32_t waver_ns_ = 0;   ///< of stamps beside the beat, on average
  std::int32_t step_ = 0;       ///< by which numbers grow without a gap; 0: not known
  std::int32_t count_ = 0;      ///< fields on this beat
  bool strayed_ = false;        ///< the last stamp was none of it
};

}  // namespace tubesight::core::tracking
