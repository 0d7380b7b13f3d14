#include "core/tracking/field_order.h"

#include <algorithm>
#include <cstdlib>

namespace tubesight::core::tracking {
namespace {

using Place = ToolPlaceQ10;

constexpr std::int32_t mm_q10(std::int64_t thousandths) {
  return static_cast<std::int32_t>(thousandths * 1024 / 1000);
}

// A mean step, or a zigzag, that counts: 0.04 mm are 2.4 mm/s at 60 fields a second, and some
// deviations of what is measured.
constexpr std::int64_t kCounts = mm_q10(40);
// Frames that must have moved before the order is called right, or wrong: a vibration near half the
// rate of the fields looks like a zigzag of one size for as long as the beat of the two lasts.
constexpr std::int32_t kEnoughForRight = 4;
constexpr std::int32_t kEnoughForWrong = 16;

Place minus(const Place& a, const Place& b) { return {a.x - b.x, a.y - b.y}; }

std::int64_t dot(const Place& a, const Place& b) {
  return std::int64_t{a.x} * b.x + std::int64_t{a.y} * b.y;
}

std::int64_t square(const Place& a) { return dot(a, a); }

// The square of the change of speed over three places at growing times, a field and field.
std::int64_t change_squared(const std::array<Place, 3>& at,
                            const std::array<std::int32_t, 3>& time) {
  const std::int32_t early = time[1] - time[0];
  const std::int32_t late = time[2] - time[1];
  const auto along = [&](std::int32_t a, std::int32_t b, std::int32_t c) {
    const std::int64_t difference = std::int64_t{c - b} * early - std::int64_t{b - a} * late;
    return 2 * difference / (early * late * (early + late));
  };
  const std::int64_t x = along(at[0].x, at[1].x, at[2].x);
  const std::int64_t y = along(at[0].y, at[1].y, at[2].y);
  return x * x + y * y;
}

}  // namespace

void FieldOrder::miss() { count_ = 0; }

void FieldOrder::shift(const ToolPlaceQ10& by) {
  for (Seen& seen : seen_) {
    seen.place = {seen.place.x + by.x, seen.place.y + by.y};
  }
}

void FieldOrder::take(const ToolPlaceQ10& place, bool first) {
  // Two of a kind in a row: a field is missing between them.
  if (count_ > 0 && seen_[static_cast<std::size_t>(count_ - 1)].first == first) {
    count_ = 0;
  }
  if (count_ == kPlaces) {
    std::copy(seen_.begin() + 1, seen_.end(), seen_.begin());
    --count_;
  }
  seen_[static_cast<std::size_t>(count_)] = {place, first};
  ++count_;
  if (first && count_ >= 3 && verdict_ == Verdict::kOpen) {
    const auto newest = static_cast<std::size_t>(count_ - 1);
    weigh(seen_[newest], seen_[newest - 1], seen_[newest - 2]);
  }
}

void FieldOrder::weigh(const Seen& into, const Seen& within, const Seen& from) {
  const Place between = minus(into.place, within.place);
  const Place inside = minus(within.place, from.place);
  // Both halved: the mean step of a field, and how far the steps stray from it to and fro.
  const Place step{(between.x + inside.x) / 2, (between.y + inside.y) / 2};
  const Place zigzag{(between.x - inside.x) / 2, (between.y - inside.y) / 2};
  const bool moved = square(step) >= kCounts * kCounts;
  if (!moved && square(zigzag) < kCounts * kCounts) {
    return;  // at rest, or as good as
  }
  moved_ += moved ? 1 : 0;
  step_step_ += square(step);
  zigzag_step_ += dot(zigzag, step);
  zigzag_zigzag_ += square(zigzag);
  way_x_ += step.x;
  way_y_ += step.y;
  // A verdict may stay open for hours: what is long ago counts less then, and the sums stay small.
  constexpr std::int32_t kMostMoved = 1 << 16;
  if (moved_ >= kMostMoved) {
    moved_ /= 2;
    for (std::int64_t* const sum :
         {&step_step_, &zigzag_step_, &zigzag_zigzag_, &way_x_, &way_y_}) {
      *sum /= 2;
    }
  }
  if (moved_ >= kEnoughForRight && 2 * std::abs(zigzag_step_) < step_step_ &&
      2 * zigzag_zigzag_ < step_step_) {
    verdict_ = Verdict::kRight;
    return;
  }
  // Sums of squares of up to 2^20 each, and products of such sums: halved until they fit.
  std::int64_t ss = step_step_;
  std::int64_t zs = zigzag_step_;
  std::int64_t zz = zigzag_zigzag_;
  while (std::max({ss, std::abs(zs), zz}) >= std::int64_t{1} << 28) {
    ss /= 2;
    zs /= 2;
    zz /= 2;
  }
  // Once or twice the step, give or take a tenth, and nine tenths of the zigzag are that.
  const bool once = 10 * zs > 9 * ss && 10 * zs < 11 * ss;
  const bool twice = 10 * zs > 18 * ss && 10 * zs < 22 * ss;
  const bool explained = 10 * zs * zs > 9 * ss * zz;
  // It went somewhere, rather than to and fro.
  const std::int64_t way2 = way_x_ * way_x_ + way_y_ * way_y_;
  const bool went = 4 * way2 > moved_ * step_step_;
  if (moved_ >= kEnoughForWrong && (once || twice) && explained && went) {
    verdict_ = Verdict::kWrong;
  }
}

bool FieldOrder::explains(std::int32_t fastest_change) const {
  return verdict_ != Verdict::kRight &&
         (explained_by_swapping(fastest_change) || explained_by_one_instant());
}

bool FieldOrder::explained_by_swapping(std::int32_t fastest_change) const {
  // By the time that each was taken if the order is wrong: the frame's second field a field earlier
  // than told, its first one later.
  std::array<Place, kPlaces> at{};
  std::array<std::int32_t, kPlaces> time{};
  for (std::int32_t i = 0; i < count_; ++i) {
    const auto index = static_cast<std::size_t>(i);
    const std::int32_t taken = seen_[index].first ? i + 1 : i - 1;
    std::size_t place = index;
    for (; place > 0 && time[place - 1] > taken; --place) {
      time[place] = time[place - 1];
      at[place] = at[place - 1];
    }
    time[place] = taken;
    at[place] = seen_[index].place;
  }
  std::int64_t told = 0;
  std::int64_t swapped = 0;
  for (std::size_t i = 0; static_cast<std::int32_t>(i) + 2 < count_; ++i) {
    told = std::max(
        told, change_squared({seen_[i].place, seen_[i + 1].place, seen_[i + 2].place}, {0, 1, 2}));
    swapped = std::max(swapped, change_squared({at[i], at[i + 1], at[i + 2]},
                                               {time[i], time[i + 1], time[i + 2]}));
  }
  // A motion within the limits, give or take what is measured, and by much a smoother one.
  constexpr std::int32_t kMeasured = mm_q10(150);
  constexpr std::int32_t kFewest = 5;
  const std::int64_t most = std::int64_t{fastest_change} + kMeasured;
  return count_ >= kFewest && swapped <= most * most && told > 6 * swapped &&
         told > std::int64_t{kMeasured} * kMeasured;
}

bool FieldOrder::explained_by_one_instant() const {
  // Two frames must have moved in one direction, and none within itself: a single jump between two
  // frames looks so once.
  constexpr std::int64_t kMoved = mm_q10(500);
  constexpr std::int64_t kStill = mm_q10(120);
  std::int32_t moved = 0;
  Place last{};
  for (std::int32_t i = 1; i < count_; ++i) {
    const auto index = static_cast<std::size_t>(i);
    const Place step = minus(seen_[index].place, seen_[index - 1].place);
    if (!seen_[index].first) {
      if (square(step) > kStill * kStill) {
        return false;
      }
      continue;
    }
    if (square(step) > kMoved * kMoved) {
      if (moved > 0 && dot(step, last) <= 0) {
        return false;
      }
      ++moved;
      last = step;
    }
  }
  return moved >= 2;
}

}  // namespace tubesight::core::tracking
