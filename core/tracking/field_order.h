#pragma once

#include <array>
#include <cstdint>

namespace tubesight::core::tracking {

/// Where a field showed the tool, in 1/1024 mm over the sheet from any fixed place.
struct ToolPlaceQ10 {
  std::int32_t x = 0;
  std::int32_t y = 0;
};

/// Judges by the motion whether the two fields of a frame were taken in the order that they are
/// told in: a recorder may flag it wrongly, and a camera of whole frames may be told to be
/// interlaced.
///
/// At a speed of v a field the fields in the wrong order go -v, +3v, -v, ...; those of one instant
/// 0, +2v, 0, ... So the zigzag (half of the step into a frame less the step within) is 2 or 1
/// times the mean step, in its direction, whatever the motion; in the right order it is none of it.
/// A vibration is not tied to the motion; one within half a hertz of half the fields' rate, from
/// the moment that the tool moves first, was not tried and may look so: it costs the track alone.
///
/// Slow motion is tracked all the same, and told by sixteen frames that moved. Fast motion
/// contradicts itself and is lost within three fields: then those few must make a motion within the
/// limits if they are taken in the other order, and none as they are told. A motion in the right
/// order settles it until the next start. Integers alone.
class FieldOrder {
 public:
  /// A new start: nothing is known.
  void begin() { *this = {}; }

  /// Takes the place of a field that follows the one before it without a gap; `first`: of its
  /// frame.
  void take(const ToolPlaceQ10& place, bool first);

  /// Nothing is known of this field's place: what comes is told from here on.
  void miss();

  /// Places taken so far were seen from another tube: they move by so much.
  void shift(const ToolPlaceQ10& by);

  /// Whether the fields that were believed come in the wrong order beyond doubt.
  [[nodiscard]] bool wrong() const { return verdict_ == Verdict::kWrong; }

  /// Whether the last places, which refute every motion within the limits, are one in another
  /// order. `fastest_change` in 1/1024 mm a field and field: the greatest acceleration.
  [[nodiscard]] bool explains(std::int32_t fastest_change) const;

  /// The members of the state; see core/base/state_stream.h.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [seen, count, verdict, moved, step_step, zigzag_step, zigzag_zigzag, way_x, way_y] = self;
    stream(seen);
    stream.number(count, 0, kPlaces);
    stream.choice(verdict, Verdict::kWrong);
    stream.number(moved, 0, 1 << 20);
    constexpr std::int64_t kMostSum = std::int64_t{1} << 60;
    stream.number(step_step, -kMostSum, kMostSum);
    stream.number(zigzag_step, -kMostSum, kMostSum);
    stream.number(zigzag_zigzag, -kMostSum, kMostSum);
    stream.number(way_x, -kMostSum, kMostSum);
    stream.number(way_y, -kMostSum, kMostSum);
  }

 private:
  enum class Verdict : std::uint8_t { kOpen, kRight, kWrong };
  static constexpr std::int32_t kPlaces = 8;

  struct Seen {
    ToolPlaceQ10 place{};
    bool first = false;

    template <typename Self, typename Stream>
    static void transfer(Self& self, Stream& stream) {
      auto& [at, is_first] = self;
      auto& [x, y] = at;
      constexpr std::int32_t kFarthest = 1 << 28;  // differences of differences fit
      stream.number(x, -kFarthest, kFarthest);
      stream.number(y, -kFarthest, kFarthest);
      stream(is_first);
    }
  };

  void weigh(const Seen& into, const Seen& within, const Seen& from);
  [[nodiscard]] bool explained_by_swapping(std::int32_t fastest_change) const;
  [[nodiscard]] bool explained_by_one_instant() const;

  std::array<Seen, kPlaces> seen_{};  ///< the last without a gap, the newest last
  std::int32_t count_ = 0;
  Verdict verdict_ = Verdict::kOpen;
  std::int32_t moved_ = 0;  ///< frames that moved
  std::int64_t step_step_ = 0;
  std::int64_t zigzag_step_ = 0;
  std::int64_t zigzag_zigzag_ = 0;
  std::int64_t way_x_ = 0;
  std::int64_t way_y_ = 0;
};

}  // namespace tubesight::core::tracking
