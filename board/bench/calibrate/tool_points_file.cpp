#include "board/bench/calibrate/tool_points_file.h"

#include <array>
#include <cstddef>
#include <cstdint>

#include "board/bench/calibrate/calibration_file.h"
#include "drivers/files/csv_reader.h"
#include "drivers/files/decimal.h"

namespace tubesight::board {
namespace {

using core::calibration::ToolPointsRefusal;

constexpr std::array<std::string_view, 5> kColumns = {"x_mm", "y_mm", "z_mm", "u_px", "v_px"};
constexpr double kMost_mm = 1000.0;

/// Reads the present row; false, and why, for anything but numbers within their ranges.
bool read_row(const drivers::CsvReader& csv, const core::CameraSettings& camera,
              core::calibration::ToolPoint& point, std::string& message) {
  constexpr std::int32_t kDigits = 9;
  std::array<double, kColumns.size()> numbers{};
  for (std::size_t i = 0; i < kColumns.size(); ++i) {
    std::int64_t value = 0;
    const double most = i < 3 ? kMost_mm : (i == 3 ? camera.width_px : camera.height_px) - 0.5;
    const double least = i < 3 ? -kMost_mm : -0.5;
    const bool number = drivers::parse_decimal(csv.cells()[i], kDigits, value);
    numbers[i] = 1e-9 * static_cast<double>(value);
    if (!number || numbers[i] < least || numbers[i] > most) {
      message = csv.place() + std::string(kColumns[i]) + ": " + drivers::in_quotes(csv.cells()[i]) +
                ", expected a number from " + drivers::number_text(least) + " to " +
                drivers::number_text(most) + " with up to 9 decimals";
      return false;
    }
  }
  point.place_mm << numbers[0], numbers[1], numbers[2];
  point.seen_px << numbers[3], numbers[4];
  return true;
}

}  // namespace

bool read_tool_points(const std::string& path, const core::CameraSettings& camera,
                      ToolPointsFile& file, std::string& message) {
  std::string text;
  drivers::Messages messages;
  if (!read_whole(path, text, messages)) {
    message = messages.front();
    return false;
  }
  drivers::CsvReader csv(text, path);
  if (!csv.read_header({kColumns.begin(), kColumns.end()}, messages)) {
    message = messages.front();
    return false;
  }
  while (csv.next(messages)) {
    core::calibration::ToolPoint point;
    if (!read_row(csv, camera, point, message)) {
      return false;
    }
    if (!file.points.try_push_back(point)) {
      message = csv.place() + "more than " + std::to_string(core::calibration::kMaxToolPoints) +
                " points, expected at most that many";
      return false;
    }
    file.lines.push_back(csv.line_number());
  }
  if (!messages.empty()) {
    message = messages.front();
    return false;
  }
  return true;
}

std::string_view explain(ToolPointsRefusal refusal) {
  switch (refusal) {
    case ToolPointsRefusal::kNone: return "";
    case ToolPointsRefusal::kTooFew:
      return "fewer than 6 points, expected 6 or more, so that a wrong one can be told";
    case ToolPointsRefusal::kOneLine: return "all points are on one line, expected some beside it";
    case ToolPointsRefusal::kNoPose:
      return "no pose puts half of the points where they are seen: another order of rows, another "
             "unit, or another camera's settings";
    case ToolPointsRefusal::kMirrored:
      return "the points fit mirrored, or seen through the guidetube: columns or signs exchanged, "
             "or a z axis that does not point to the tip; expected right-handed places, z along "
             "the guidetube to the tubesheet";
    case ToolPointsRefusal::kAmbiguous:
      return "two poses fit the points equally well: they lie in a plane and are too small in the "
             "picture, expected some beside that plane";
    case ToolPointsRefusal::kManyOutliers:
      return "more than a third of the points lie off, or fewer than five agree: rows exchanged, "
             "or points measured wrongly";
    case ToolPointsRefusal::kUncertain:
      return "the points leave the tip open by more than 1 mm (one sigma): more points, farther "
             "apart, nearer to the tip";
  }
  return "";
}

std::string points_text(const ToolPointsFile& file,
                        const core::calibration::ToolPointsOutcome& outcome) {
  std::string text;
  drivers::print(text, "tool from %d points%s: RMS %.3f px, %.3f px sigma of a coordinate\n",
                 outcome.used, outcome.coplanar ? " of a plane" : "", outcome.rms_px,
                 outcome.sigma_px);
  for (std::int32_t i = 0; i < outcome.points.size(); ++i) {
    const auto& point = outcome.points[i];
    if (!point.used) {
      drivers::print(text, "  line %lld             left out: %.1f px off (du %.1f, dv %.1f)\n",
                     static_cast<long long>(file.lines[static_cast<std::size_t>(i)]),
                     point.off_px.norm(), point.off_px.x(), point.off_px.y());
    }
  }
  return text;
}

}  // namespace tubesight::board
