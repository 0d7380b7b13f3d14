#include "core/rendering/tube_ends.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/rendering/random.h"

namespace tubesight::core::rendering {
namespace {

enum Use : std::uint32_t { kBore = 1, kPlugKind = 2 };

/// The entry of a list sorted by address; nullptr when there is none.
// Which addresses there are and where their tubes stand is written anew here: a mistake in
// core/tubesheet would hide if the pictures that test it were drawn with it.

template <typename List>
auto find_address(const List& list, TubeAddress address) -> decltype(list.begin()) {
  const auto* found = std::lower_bound(
      list.begin(), list.end(), address,
      [](const auto& entry, TubeAddress wanted) { return entry.address < wanted; });
  return found != list.end() && found->address == address ? found : nullptr;
}

template <typename List>
void sort_by_address(List& list) {
  std::sort(list.begin(), list.end(),
            [](const auto& a, const auto& b) { return a.address < b.address; });
}

}  // namespace

Result<void> TubeEnds::configure(const Scene& scene) {
  const TubesheetSettings& sheet = scene.sheet;
  const double determinant = sheet.row_step_mm[0] * sheet.column_step_mm[1] -
                             sheet.row_step_mm[1] * sheet.column_step_mm[0];
  const double lengths = std::hypot(sheet.row_step_mm[0], sheet.row_step_mm[1]) *
                         std::hypot(sheet.column_step_mm[0], sheet.column_step_mm[1]);
  if (!(std::abs(determinant) > 0.05 * lengths) || !(sheet.bore_mm > 0.0) ||
      !std::isfinite(lengths) || !std::isfinite(sheet.bore_mm) ||
      !(std::abs(sheet.odd_row_shift) <= 1.0)) {
    return Unexpected(Error::kInvalidArgument);
  }
  if (const Result<void> assigned = map_.assign(sheet); !assigned.has_value()) {
    return Unexpected(assigned.error());
  }
  plugs_ = scene.plugs;
  displaced_ = scene.displaced;
  sort_by_address(plugs_);
  sort_by_address(displaced_);
  origin_mm_ = sheet.origin_mm;
  row_step_mm_ = sheet.row_step_mm;
  column_step_mm_ = sheet.column_step_mm;
  addresses_ = sheet.addresses;
  odd_row_shift_ = sheet.odd_row_shift;
  bore_mm_ = sheet.bore_mm;
  bore_spread_mm_ = scene.look.bore_spread_mm;
  seed_ = scene.seed;
  return {};
}

TubeEndKind TubeEnds::kind_at(TubeAddress address) const {
  const TubeState state = map_.state(address);
  if (state == TubeState::kAbsent) {
    return TubeEndKind::kVoid;
  }
  if (const Plug* plug = find_address(plugs_, address); plug != nullptr) {
    return plug->kind == PlugKind::kRolled ? TubeEndKind::kPlugRolled : TubeEndKind::kPlugFlush;
  }
  if (state == TubeState::kPlugged) {
    const bool rolled = (mixed(seed_, address.row, address.column, kPlugKind) & 1U) != 0;
    return rolled ? TubeEndKind::kPlugRolled : TubeEndKind::kPlugFlush;
  }
  return TubeEndKind::kOpen;
}

TubeEnd TubeEnds::at(TubeAddress address) const {
  TubeEnd end;
  end.kind = kind_at(address);
  const std::array<double, 2> point = lattice_point(address);
  end.center_mm = {point[0], point[1], 0.0};
  if (const DisplacedTube* moved = find_address(displaced_, address); moved != nullptr) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      end.center_mm[axis] += moved->by_mm[axis];
    }
  }
  const double spread =
      bore_spread_mm_ * bounded_normal(mixed(seed_, address.row, address.column, kBore));
  end.radius_mm = 0.5 * std::max(bore_mm_ + spread, 0.5 * bore_mm_);
  return end;
}

std::array<double, 2> TubeEnds::lattice_point(TubeAddress address) const {
  const double row = address.row;
  const double column = address.column + (address.row % 2 != 0 ? odd_row_shift_ : 0.0);
  return {origin_mm_[0] + row * row_step_mm_[0] + column * column_step_mm_[0],
          origin_mm_[1] + row * row_step_mm_[1] + column * column_step_mm_[1]};
}

NearestTube TubeEnds::nearest(const std::array<double, 2>& point_mm) const {
  const double determinant =
      row_step_mm_[0] * column_step_mm_[1] - row_step_mm_[1] * column_step_mm_[0];
  const double x = point_mm[0] - origin_mm_[0];
  const double y = point_mm[1] - origin_mm_[1];
  const double row = (x * column_step_mm_[1] - y * column_step_mm_[0]) / determinant;
  const double column = (y * row_step_mm_[0] - x * row_step_mm_[1]) / determinant;
  // Far beyond any sheet an address would not fit; the farthest one serves there.
  constexpr double kFar = 1e8;
  const auto near_row = static_cast<std::int32_t>(std::lround(std::clamp(row, -kFar, kFar)));
  NearestTube best;
  best.offset_mm = std::numeric_limits<double>::infinity();
  constexpr std::int32_t kReach = 3;  // oblique steps: the nearest need not be the rounded one
  for (std::int32_t r = near_row - kReach; r <= near_row + kReach; ++r) {
    const double in_row = column - (r % 2 != 0 ? odd_row_shift_ : 0.0);
    const auto near_column =
        static_cast<std::int32_t>(std::lround(std::clamp(in_row, -kFar, kFar)));
    for (std::int32_t c = near_column - kReach; c <= near_column + kReach; ++c) {
      const bool odd = ((r + c) & 1) != 0;
      if ((addresses_ == AddressParity::kEvenSum && odd) ||
          (addresses_ == AddressParity::kOddSum && !odd)) {
        continue;
      }
      const std::array<double, 2> center = lattice_point({r, c});
      const std::array<double, 2> off{point_mm[0] - center[0], point_mm[1] - center[1]};
      const double distance = std::hypot(off[0], off[1]);
      if (distance < best.offset_mm) {
        best = {{r, c}, TubeEndKind::kVoid, off, distance};
      }
    }
  }
  best.kind = kind_at(best.address);
  return best;
}

}  // namespace tubesight::core::rendering
