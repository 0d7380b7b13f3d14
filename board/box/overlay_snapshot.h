#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <type_traits>

#include "board/box/overlay_news.h"
#include "core/base/scalar.h"
#include "core/base/sighting.h"
#include "core/base/static_vector.h"
#include "core/overlay/overlay.h"
#include "core/session/session.h"
#include "core/tracking/tracker.h"

namespace tubesight::board {

/// What the marks of one field's picture are drawn from, apart from the tracker that goes on: plain
/// bytes that a core::Snapshot carries to whoever draws. About 7 KB.
struct OverlaySnapshot {
  std::int64_t field = 0;  ///< its number
  core::Sighting sighting;
  core::tracking::TubeSightingList tubes;
  std::optional<core::ImagePoint> next_row_px;     ///< centre of the tube at primary row + 1
  std::optional<core::ImagePoint> next_column_px;  ///< centre of the tube at primary column + 1
  /// Centres of the four tubes next to the one above the guidetube, row + 1, row - 1, column + 1
  /// and column - 1, whether they stand or not: how large a tube-end looks there.
  std::optional<std::array<core::ImagePoint, 4>> around_tool_px;
  core::StaticVector<core::overlay::Estimate, core::kMaxTubesInView> estimates;
  OverlayNews news;
  std::optional<core::ImagePoint> claimed_px;  ///< of the tube claimed in vain, while in view
};
static_assert(std::is_trivially_copyable_v<OverlaySnapshot>);

/// Fills `snapshot` with the field, of this number, that `session` has just processed with the
/// answer `output`, and with `news`, which have taken that step; with `estimates` also with the
/// places where tubes are expected, which costs as much as finding them again. On the thread of
/// step(), before the next one.
template <core::Scalar S, typename Margin>
void describe(const core::session::Session<S, Margin>& session, const core::session::Output& output,
              const OverlayNews& news, std::int64_t field, bool estimates,
              OverlaySnapshot& snapshot);

}  // namespace tubesight::board
