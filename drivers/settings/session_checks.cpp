#include "drivers/settings/session_checks.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/tubesheet/sheet_places.h"
#include "core/tubesheet/tubesheet_setup.h"
#include "drivers/files/decimal.h"
#include "drivers/settings/session_keys.h"

namespace tubesight::drivers {
namespace {

using core::TubeAddress;
using core::tubesheet::center_mm;
using Vector = std::array<double, 2>;

Vector plus(const Vector& a, const Vector& b, double times) {
  return {a[0] + times * b[0], a[1] + times * b[1]};
}
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1]; }
double cross(const Vector& a, const Vector& b) { return a[0] * b[1] - a[1] * b[0]; }

/// Twice the signed area of a triangle over the square of its longest side: 0.87 when equilateral,
/// 0 when the corners lie in one line.
double fatness(const Vector& a, const Vector& b, const Vector& c) {
  const Vector ab = plus(b, a, -1.0);
  const Vector ac = plus(c, a, -1.0);
  const Vector bc = plus(c, b, -1.0);
  const double longest = std::max({dot(ab, ab), dot(ac, ac), dot(bc, bc)});
  return longest > 0.0 ? cross(ab, ac) / longest : 0.0;
}

/// Below it the corners count as in one line; the source's three tubes give 0.5.
constexpr double kThinnest = 0.05;

}  // namespace

std::string address_text(TubeAddress address) {
  return "tube (" + std::to_string(address.row) + ", " + std::to_string(address.column) + ")";
}

std::string point_text(const std::array<double, 2>& point_px) {
  return "(" + number_text(point_px[0]) + ", " + number_text(point_px[1]) + ")";
}

std::string ranges_text(const core::TubesheetSettings& tubesheet) {
  return "a row from " + std::to_string(tubesheet.rows[0]) + " to " +
         std::to_string(tubesheet.rows[1]) + " and a column from " +
         std::to_string(tubesheet.columns[0]) + " to " + std::to_string(tubesheet.columns[1]);
}

bool in_picture(const core::CameraSettings& camera, const std::array<double, 2>& point_px) {
  return point_px[0] >= 0.0 && point_px[0] <= camera.width_px - 1 && point_px[1] >= 0.0 &&
         point_px[1] <= camera.height_px - 1;
}

std::string why_picture_folds(const core::CameraSettings& camera) {
  const double pixel_width_mm =
      camera.cell_width_mm / camera.horizontal_scale * camera.sensor_columns / camera.frame_columns;
  const double x_mm =
      pixel_width_mm * std::max(camera.center_px[0], camera.width_px - 1 - camera.center_px[0]);
  const double y_mm = camera.cell_height_mm *
                      std::max(camera.center_px[1], camera.height_px - 1 - camera.center_px[1]);
  const double corner = x_mm * x_mm + y_mm * y_mm;
  const double k = camera.distortion_per_mm2;
  const double k2 = camera.distortion2_per_mm4;
  const auto growth = [&](double square) { return 1.0 + square * (3.0 * k + 5.0 * k2 * square); };
  double least = growth(corner);
  if (k2 != 0.0) {
    const double turning = -0.3 * k / k2;
    if (turning > 0.0 && turning < corner) {
      least = std::min(least, growth(turning));
    }
  }
  if (least > 0.0) {
    return {};
  }
  return number_text(k) +
         " folds the picture over, expected 1 + 3 k r^2 + 5 k2 r^4 above 0 up to "
         "the farthest corner, r = " +
         rounded_text(std::sqrt(corner)) + " mm";
}

std::string why_no_lattice(const core::TubesheetSettings& tubesheet) {
  switch (core::tubesheet::check_steps(tubesheet)) {
    case core::tubesheet::StepsFault::kNone: break;
    case core::tubesheet::StepsFault::kShort:
      return "a step below 1 mm, expected row_step_mm and column_step_mm from tube to tube";
    case core::tubesheet::StepsFault::kOneLine:
      return "the steps lie in one line, expected row_step_mm and column_step_mm at least 6 "
             "degrees "
             "apart";
  }
  return {};
}

std::string why_bore_too_wide(const core::TubesheetSettings& tubesheet) {
  const double step_mm = core::tubesheet::shortest_step_mm(tubesheet);
  if (tubesheet.bore_mm < step_mm) {
    return {};
  }
  // Steps of which one alone is too short, and addresses missing between: shares of a step written
  // as steps. There is a better way to say it.
  const auto [row_mm, column_mm] = core::tubesheet::step_lengths_mm(tubesheet);
  const bool shares = !tubesheet.missing.empty() && tubesheet.bore_mm < std::max(row_mm, column_mm);
  return number_text(tubesheet.bore_mm) + ", expected less than the " + rounded_text(step_mm) +
         " mm between neighbouring tubes" +
         (shares ? ", missing ones included (a sheet of shifted rows has an odd_row_shift)" : "");
}

std::string why_fields_too_seldom(const core::MotionSettings& motion,
                                  const core::TubesheetSettings& tubesheet, double span_s) {
  // As core/tracking has it: a prediction from the field before is off by up to a t^2, never by
  // more than from one greatest speed to the other, and 0.1 mm (three times) is never known better.
  constexpr double kLimit = 0.4;
  constexpr double kNeverKnown_mm = 0.3;
  constexpr double kLongest_s = 1.0;
  const double step_mm = core::tubesheet::shortest_step_mm(tubesheet);
  const double room_mm = kLimit * step_mm - kNeverKnown_mm;
  const double reach_mm = std::min(motion.max_acceleration_mm_s2 * span_s * span_s,
                                   2.0 * motion.max_speed_mm_s * span_s);
  if (reach_mm <= room_mm && span_s < kLongest_s) {
    return {};
  }
  // What is advised leaves a tenth for the picture's noise, in two digits on the safe side.
  const double advised_mm = 0.9 * room_mm;
  const auto two_digits = [](double value, double (*towards)(double)) {
    const double unit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
    return rounded_text(towards(value / unit) * unit);
  };
  const auto down = [](double value) { return std::floor(value); };
  const auto up = [](double value) { return std::ceil(value); };
  const double longest_s = std::max(std::sqrt(advised_mm / motion.max_acceleration_mm_s2),
                                    advised_mm / (2.0 * motion.max_speed_mm_s));
  std::string text = rounded_text(1.0 / span_s) +
                     " fields a second are too few: from one to the next the tool can be " +
                     rounded_text(reach_mm) + " mm off its course, expected at most " +
                     rounded_text(room_mm) + " mm with " + rounded_text(step_mm) +
                     " mm between neighbouring tubes, as by ";
  if (span_s < kLongest_s) {
    text += "max_acceleration_mm_s2 = " + two_digits(advised_mm / (span_s * span_s), down) +
            " or max_speed_mm_s = " + two_digits(advised_mm / (2.0 * span_s), down) + " or ";
  }
  return text + two_digits(1.0 / std::min(longest_s, 0.9 * kLongest_s), up) + " fields a second";
}

std::string why_sheet_too_large(const core::TubesheetSettings& tubesheet) {
  for (const TubeAddress address : core::tubesheet::outermost(tubesheet)) {
    const Vector place = center_mm(tubesheet, address);
    if (std::max(std::abs(place[0]), std::abs(place[1])) > kLargestSheet_mm) {
      return address_text(address) + " would stand at (" + rounded_text(place[0]) + ", " +
             rounded_text(place[1]) + ") mm, expected within 30000 mm of the origin";
    }
  }
  return {};
}

std::optional<TubeAddress> listed_twice(const core::TubesheetSettings& tubesheet) {
  std::vector<TubeAddress> missing(tubesheet.missing.begin(), tubesheet.missing.end());
  std::sort(missing.begin(), missing.end());
  for (const TubeAddress address : tubesheet.plugged) {
    if (std::binary_search(missing.begin(), missing.end(), address)) {
      return address;
    }
  }
  return {};
}

std::string why_no_tube(const core::TubesheetSettings& tubesheet, TubeAddress address) {
  switch (core::tubesheet::check_address(tubesheet, address)) {
    case core::tubesheet::AddressFault::kNone: break;
    case core::tubesheet::AddressFault::kOutside:
      return address_text(address) + " is outside the tubesheet, expected " +
             ranges_text(tubesheet);
    case core::tubesheet::AddressFault::kNotNumbered:
      return address_text(address) + " does not exist, expected " +
             std::string(kAddressRules[static_cast<std::size_t>(tubesheet.addresses)]);
    case core::tubesheet::AddressFault::kMissing:
      return address_text(address) + " is listed as missing, expected a tube that stands";
  }
  return {};
}

std::string why_no_move(const core::TubesheetSettings& tubesheet, TubeAddress by) {
  switch (core::tubesheet::check_move(tubesheet, by)) {
    case core::tubesheet::MoveFault::kNone: break;
    case core::tubesheet::MoveFault::kRows:
      return "an odd number of rows, expected an even one on this sheet";
    case core::tubesheet::MoveFault::kSum:
      return "an odd sum of rows and columns, expected an even one on this sheet";
  }
  return {};
}

std::string why_off_the_sheet(const core::TubesheetSettings& tubesheet,
                              const std::array<double, 2>& point_mm) {
  if (core::tubesheet::on_the_sheet(tubesheet, point_mm)) {
    return {};
  }
  const auto at = core::tubesheet::lattice_place(tubesheet, point_mm);
  return "(" + rounded_text(point_mm[0], 5) + ", " + rounded_text(point_mm[1], 5) +
         ") mm is off the sheet, at row " + rounded_text(at[0], 5) + " and column " +
         rounded_text(at[1], 5) + ", expected " + ranges_text(tubesheet);
}

std::string why_clicks_contradict(const core::StartSettings& start,
                                  const core::TubesheetSettings* tubesheet) {
  double fattest = 0.0;
  double fattest_on_sheet = 0.0;
  double sheet_at_fattest = 0.0;
  const auto& tubes = start.tubes;
  for (std::int32_t i = 0; i < tubes.size(); ++i) {
    for (std::int32_t j = i + 1; j < tubes.size(); ++j) {
      if (tubes[i].address == tubes[j].address) {
        return address_text(tubes[i].address) + " is named twice, expected different tubes";
      }
      for (std::int32_t k = j + 1; k < tubes.size(); ++k) {
        const double seen = fatness(tubes[i].at_px, tubes[j].at_px, tubes[k].at_px);
        double meant = 0.0;
        if (tubesheet != nullptr) {
          meant = fatness(center_mm(*tubesheet, tubes[i].address),
                          center_mm(*tubesheet, tubes[j].address),
                          center_mm(*tubesheet, tubes[k].address));
        }
        fattest_on_sheet = std::max(fattest_on_sheet, std::abs(meant));
        if (std::abs(seen) > std::abs(fattest)) {
          fattest = seen;
          sheet_at_fattest = meant;
        }
      }
    }
  }
  if (tubes.size() < 3) {
    return {};  // the lattice found tells more
  }
  if (std::abs(fattest) < kThinnest) {
    return "the clicks lie in one line in the picture, expected a triangle";
  }
  if (tubesheet == nullptr) {
    return {};
  }
  if (fattest_on_sheet < kThinnest) {
    return "the tubes lie in one line on the sheet, expected a triangle";
  }
  // Camera and sheet both have z pointing away from the tool, so that x, y turn the same way.
  if (std::abs(sheet_at_fattest) >= kThinnest && (fattest > 0.0) != (sheet_at_fattest > 0.0)) {
    return "the clicks go round the other way than their addresses, expected the order of "
           "row_step_mm and column_step_mm (rows and columns swapped, or a step's sign?)";
  }
  return {};
}

std::string why_no_window(const std::array<std::int32_t, 4>& window_px,
                          const core::CameraSettings* camera) {
  constexpr std::int32_t kLeastSide_px = 64;
  const auto& [left, top, right, bottom] = window_px;
  if (right - left + 1 < kLeastSide_px || bottom - top + 1 < kLeastSide_px) {
    return std::to_string(right - left + 1) + " x " + std::to_string(bottom - top + 1) +
           " pixels, expected left, top, right, bottom at least 64 apart";
  }
  if (camera != nullptr && (right >= camera->width_px || bottom >= camera->height_px)) {
    return "reaches to (" + std::to_string(right) + ", " + std::to_string(bottom) +
           "), expected at most (" + std::to_string(camera->width_px - 1) + ", " +
           std::to_string(camera->height_px - 1) + ")";
  }
  return {};
}

}  // namespace tubesight::drivers
