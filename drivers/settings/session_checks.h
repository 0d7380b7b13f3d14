#pragma once

#include <array>
#include <optional>
#include <string>

#include "core/base/settings.h"

namespace tubesight::drivers {

// What single values cannot tell: whether they make sense together. A `why_...` function says what
// is wrong and what was expected, and nothing when all is well.

/// How far from the sheet's origin a tube may stand: 30 m, under what 16 bits of millimetres hold.
inline constexpr double kLargestSheet_mm = 30000.0;

[[nodiscard]] std::string address_text(core::TubeAddress address);
[[nodiscard]] std::string point_text(const std::array<double, 2>& point_px);
[[nodiscard]] std::string ranges_text(const core::TubesheetSettings& tubesheet);

[[nodiscard]] bool in_picture(const core::CameraSettings& camera,
                              const std::array<double, 2>& point_px);

/// The mapping from distorted to ideal places must grow outwards as far as the picture reaches, or
/// it has no inverse there: 1 + 3 k r^2 + 5 k2 r^4 > 0, the derivative of r (1 + k r^2 + k2 r^4).
[[nodiscard]] std::string why_picture_folds(const core::CameraSettings& camera);

/// The steps must have a length and not lie in one line (at least 6 degrees apart).
[[nodiscard]] std::string why_no_lattice(const core::TubesheetSettings& tubesheet);

/// Two tube-ends must not overlap. Needs a lattice.
[[nodiscard]] std::string why_bore_too_wide(const core::TubesheetSettings& tubesheet);

/// From field to field, `span_s` apart, the tool must not be able to reach 0.4 of the way to
/// another tube: no track would live longer than two fields. Says which values would do. Needs a
/// lattice.
[[nodiscard]] std::string why_fields_too_seldom(const core::MotionSettings& motion,
                                                const core::TubesheetSettings& tubesheet,
                                                double span_s);

/// All tubes must stand within kLargestSheet_mm.
[[nodiscard]] std::string why_sheet_too_large(const core::TubesheetSettings& tubesheet);

/// An address that is both in `missing` and in `plugged`.
[[nodiscard]] std::optional<core::TubeAddress> listed_twice(
    const core::TubesheetSettings& tubesheet);

/// A clicked tube must exist.
[[nodiscard]] std::string why_no_tube(const core::TubesheetSettings& tubesheet,
                                      core::TubeAddress address);

/// Moved by these rows and columns the lattice must lie on itself.
[[nodiscard]] std::string why_no_move(const core::TubesheetSettings& tubesheet,
                                      core::TubeAddress by);

/// Where the tool may be: up to half a step beyond the last rows and columns.
[[nodiscard]] std::string why_off_the_sheet(const core::TubesheetSettings& tubesheet,
                                            const std::array<double, 2>& point_mm);

/// Clicks must have addresses of their own, must not lie in one line, neither in the picture nor on
/// the sheet, and must go round the same way in both: seen from the camera the sheet is not
/// mirrored. `tubesheet` may be null.
[[nodiscard]] std::string why_clicks_contradict(const core::StartSettings& start,
                                                const core::TubesheetSettings* tubesheet);

/// The window must lie in the picture (where `camera` is not null) and hold a few tube-ends.
[[nodiscard]] std::string why_no_window(const std::array<std::int32_t, 4>& window_px,
                                        const core::CameraSettings* camera);

}  // namespace tubesight::drivers
