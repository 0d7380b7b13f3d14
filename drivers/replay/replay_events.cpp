#include "drivers/replay/replay_events.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>

#include "core/base/names.h"
#include "drivers/files/csv_reader.h"
#include "drivers/files/decimal.h"
#include "drivers/replay/companion.h"
#include "drivers/replay/field_time.h"

namespace tubesight::drivers {
namespace {

using core::Error;
using core::Event;
using core::EventOrigin;
using core::Result;
using core::Unexpected;

static_assert(core::kMaxStartPoints == 8);

constexpr std::int32_t kNanometres = 6;   // decimals of a millimetre
constexpr std::int32_t kNanodegrees = 9;  // decimals of a degree

/// Cuts the text before the first `separator` off the front.
std::string_view cut(std::string_view& rest, char separator) {
  const std::size_t end = rest.find(separator);
  const std::string_view part = rest.substr(0, end);
  rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
  return part;
}

/// Cuts the text at each `separator` into exactly N parts.
template <std::size_t N>
bool split(std::string_view text, char separator, std::array<std::string_view, N>& parts) {
  for (std::size_t i = 0; i < N; ++i) {
    if ((i + 1 < N) != (text.find(separator) != std::string_view::npos)) {
      return false;
    }
    parts[i] = cut(text, separator);
  }
  return true;
}

/// A place that could be meant for a picture; whether it lies inside is the session's to say.
bool parse_px(std::string_view text, double& px) {
  constexpr double kFarthest_px = 65536.0;
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() ||
      !(std::abs(value) <= kFarthest_px)) {
    return false;
  }
  px = value;
  return true;
}

bool parse_start(std::string_view text, Event& event) {
  core::Start start;
  event.origin = EventOrigin::kOperator;
  while (!text.empty()) {
    std::array<std::string_view, 4> parts;
    core::StartPoint point;
    if (!split(cut(text, ';'), ',', parts) || !parse_whole(parts[0], point.address.row) ||
        !parse_whole(parts[1], point.address.column) || !parse_px(parts[2], point.at_px[0]) ||
        !parse_px(parts[3], point.at_px[1]) || !start.tubes.try_push_back(point)) {
      return false;
    }
  }
  event.content = start;
  return true;
}

bool parse_pose_reason(std::string_view text, core::PoseReason& reason) {
  for (auto value = core::PoseReason::kNotTracking; value <= core::PoseReason::kEnded;
       value = static_cast<core::PoseReason>(static_cast<int>(value) + 1)) {
    if (text == core::name_of(value)) {
      reason = value;
      return true;
    }
  }
  return false;
}

/// A pose as the event recorder writes it: every number exactly.
bool parse_pose_result(std::string_view text, core::PoseResult& pose) {
  if (parse_pose_reason(text, pose.reason)) {
    return true;
  }
  std::array<std::string_view, 16> parts;
  if (!split(text, ',', parts) || !parse_whole(parts[0], pose.tubes) ||
      !parse_whole(parts[1], pose.nearest.row) || !parse_whole(parts[2], pose.nearest.column) ||
      !parse_decimal(parts[15], kNanometres, pose.offset_nm)) {
    return false;
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (!parse_decimal(parts[3 + i], kNanometres, pose.position_nm[i]) ||
        !parse_decimal(parts[6 + i], kNanodegrees, pose.angles_ndeg[i]) ||
        !parse_decimal(parts[9 + i], kNanometres, pose.position_sigma_nm[i]) ||
        !parse_decimal(parts[12 + i], kNanodegrees, pose.angle_sigma_ndeg[i])) {
      return false;
    }
  }
  pose.reason = core::PoseReason::kNone;
  return true;
}

bool parse_claim(std::string_view text, Event& event) {
  std::array<std::string_view, 2> pair;
  core::Claim claim;
  const bool good = split(text, ',', pair) && parse_whole(pair[0], claim.tube.row) &&
                    parse_whole(pair[1], claim.tube.column);
  event.content = claim;
  return good;
}

bool parse_lamp(std::string_view text, Event& event) {
  core::LampCommand lamp;
  lamp.automatic = text == "auto";
  const bool good = lamp.automatic || (parse_whole(text, lamp.permille) && lamp.permille >= 0 &&
                                       lamp.permille <= 1000);
  event.content = lamp;
  return good;
}

bool parse_pick(std::string_view text, Event& event) {
  std::array<std::string_view, 2> pair;
  core::Pick pick;
  const bool good = split(text, ',', pair) && parse_px(pair[0], pick.at_px[0]) &&
                    parse_px(pair[1], pick.at_px[1]);
  event.origin = EventOrigin::kOperator;
  event.content = pick;
  return good;
}

/// Three lengths, then nothing or three angles (empty where the robot told none), then the angles
/// of as many joints as it told.
bool parse_robot_pose(std::string_view text, core::RobotPose& robot) {
  std::array<std::string_view, 6 + core::kMaxToldJoints> parts;
  const auto count = static_cast<std::size_t>(1 + std::ranges::count(text, ','));
  if ((count != 3 && count < 6) || count > parts.size()) {
    return false;
  }
  for (std::size_t i = 0; i < count; ++i) {
    parts[i] = cut(text, ',');
  }
  robot.turned = !parts[3].empty();
  robot.joints = static_cast<std::int32_t>(std::max<std::size_t>(count, 6) - 6);
  bool good = robot.turned || robot.joints > 0 || count == 3;
  for (std::size_t i = 0; i < 3; ++i) {
    good = good && parse_decimal(parts[i], kNanometres, robot.position_nm[i]) &&
           (robot.turned ? parse_decimal(parts[3 + i], kNanodegrees, robot.angles_ndeg[i])
                         : parts[3 + i].empty());
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(robot.joints); ++i) {
    good = good && parse_decimal(parts[6 + i], kNanodegrees, robot.joints_ndeg[i]);
  }
  return good;
}

bool parse_pose_request(std::string_view text, Event& event) {
  core::PoseRequest request;
  const bool good = text.empty() || parse_robot_pose(text, request.robot.emplace());
  event.content = request;
  return good;
}

bool parse_acknowledge(std::string_view text, Event& event) {
  event.origin = EventOrigin::kOperator;
  event.content = core::Acknowledge{};
  return text.empty();
}

bool parse_pose_result(std::string_view text, Event& event) {
  core::PoseResult pose;
  const bool good = parse_pose_result(text, pose);
  event.content = pose;
  return good;
}

struct Kind {
  std::string_view word;
  const char* values;  ///< what the column `values` is expected to hold
  bool (*parse)(std::string_view values, Event& event);
};

constexpr std::array kKinds = {
    Kind{"claim", "R,C (row and column)", parse_claim},
    Kind{"start", "3 to 8 clicks R,C,U,V separated by ';'", parse_start},
    Kind{"lamp", "a level from 0 to 1000", parse_lamp},
    Kind{"pose", "nothing, or the robot's own X,Y,Z[,ALPHA,BETA,GAMMA[,JOINT...]] (mm, deg)",
         parse_pose_request},
    Kind{"pick", "U,V (pixels)", parse_pick},
    Kind{"acknowledge", "nothing", parse_acknowledge},
    Kind{"pose-result",
         "16 numbers (tubes, row, column, x, y, z mm, alpha, beta, gamma deg, their sigmas, offset "
         "mm) or a reason",
         parse_pose_result},
};

/// Where the header has the columns that were appended in later versions.
struct AppendedColumns {
  explicit AppendedColumns(const CsvReader& csv)
      : id(csv.find_column("id")),
        seen_field(csv.find_column("seen_field")),
        confirm(csv.find_column("confirm")),
        origin(csv.find_column("origin")) {}

  std::optional<std::size_t> id;
  std::optional<std::size_t> seen_field;
  std::optional<std::size_t> confirm;
  std::optional<std::size_t> origin;
};

/// Reads one row; each cell that is wrong gives a message.
class RowReader {
 public:
  RowReader(const CsvReader& csv, Messages& messages) : csv_(csv), messages_(messages) {}

  bool read(const AppendedColumns& appended, std::int64_t& field, Event& event) {
    read_field_and_time(field, event);
    const std::string& word = csv_.cells()[2];
    const Kind* kind = nullptr;
    for (const Kind& candidate : kKinds) {
      kind = candidate.word == word ? &candidate : kind;
    }
    if (kind == nullptr) {
      complain("kind", word, "claim, start, lamp, pose, pick, acknowledge or pose-result");
      return false;
    }
    const std::string& values = csv_.cells()[3];
    // A box's recorder names the origin, and writes what came, sensible or not.
    const std::string* const origin = filled(appended.origin);
    if (!kind->parse(values, event) || (origin == nullptr && has_few_clicks(event))) {
      complain("values", values, std::string(kind->values) + " for " + word);
    }
    if (const std::string* const cell = filled(appended.id);
        cell != nullptr && !parse_whole(*cell, event.id)) {
      complain("id", *cell, "a whole number, or nothing");
    }
    read_seen_field(filled(appended.seen_field), origin != nullptr, field, word, event);
    read_confirm(filled(appended.confirm), word, event);
    read_origin(origin, event);
    return good_;
  }

 private:
  void complain(const char* column, std::string_view cell, const std::string& expected) {
    messages_.push_back(csv_.place() + column + ": " + in_quotes(cell) + ", expected " + expected);
    good_ = false;
  }

  /// The cell of a column that may be missing; null where there is nothing.
  [[nodiscard]] const std::string* filled(std::optional<std::size_t> column) const {
    return column && !csv_.cells()[*column].empty() ? &csv_.cells()[*column] : nullptr;
  }

  void read_field_and_time(std::int64_t& field, Event& event) {
    const auto& cells = csv_.cells();
    if (!parse_whole(cells[0], field) || field < 0) {
      complain("field", cells[0], "a whole number from 0");
    }
    core::FieldTime time{};
    const char* expected = nullptr;
    if (cells[1].empty()) {
      return;
    }
    if (parse_time(cells[1], time, expected)) {
      event.at = time;
    } else {
      complain("time_s", cells[1], std::string(expected) + ", or nothing");
    }
  }

  static bool has_few_clicks(const Event& event) {
    constexpr std::int32_t kFewest = 3;
    const auto* const start = core::content_if<core::Start>(event);
    return start != nullptr && start->tubes.size() < kFewest;
  }

  void read_origin(const std::string* cell, Event& event) {
    if (cell == nullptr) {
      return;
    }
    if (*cell != "robot" && *cell != "operator") {
      complain("origin", *cell, "robot, operator or nothing");
    }
    event.origin = *cell == "robot" ? EventOrigin::kRobot : EventOrigin::kOperator;
  }

  void read_seen_field(const std::string* cell, bool recorded, std::int64_t field,
                       const std::string& word, Event& event) {
    if (cell == nullptr) {
      return;
    }
    std::int64_t seen = 0;
    auto* const start = core::content_if<core::Start>(event);
    auto* const pick = core::content_if<core::Pick>(event);
    if (start == nullptr && pick == nullptr) {
      complain("seen_field", *cell, "nothing for " + word);
    } else if (!parse_whole(*cell, seen) || (!recorded && (seen < 0 || seen > field))) {
      complain("seen_field", *cell, "a whole number from 0 to the row's field, or nothing");
    } else {
      (start != nullptr ? start->seen_field : pick->seen_field) = seen;
    }
  }

  void read_confirm(const std::string* cell, const std::string& word, Event& event) {
    if (cell == nullptr) {
      return;
    }
    auto* const start = core::content_if<core::Start>(event);
    if (start == nullptr) {
      complain("confirm", *cell, "nothing for " + word);
    } else if (*cell != "0" && *cell != "1") {
      complain("confirm", *cell, "1, 0 or nothing");
    } else {
      start->confirmed = *cell == "1";
    }
  }

  const CsvReader& csv_;
  Messages& messages_;
  bool good_ = true;
};

}  // namespace

Result<void> ReplayEvents::load_beside(std::string_view recording, Messages& messages) {
  rows_.clear();
  taken_ = 0;
  has_pose_results_ = false;
  const std::string path = companion_path(recording, ".events.csv");
  std::string text;
  const auto present = read_companion(path, text, messages);
  if (!present) {
    return Unexpected(present.error());
  }
  return *present ? parse(text, path, messages) : Result<void>();
}

Result<void> ReplayEvents::parse(std::string_view text, const std::string& name,
                                 Messages& messages) {
  rows_.clear();
  taken_ = 0;
  has_pose_results_ = false;
  Messages found;
  CsvReader csv(text, name);
  std::int64_t number = 0;
  std::int32_t in_field = 0;
  // Commas in `values` need no quotation marks as long as it is the last column.
  if (csv.read_header({"field", "time_s", "kind", "values"}, found, CsvReader::LastColumn::kRest)) {
    const AppendedColumns appended(csv);
    while (found.size() < CsvReader::kMostMessages && csv.next(found)) {
      Row row;
      ++number;
      row.event.id = number;  // unless the file has one
      if (!RowReader(csv, found).read(appended, row.field, row.event)) {
        continue;
      }
      if (!rows_.empty() && row.field < rows_.back().field) {
        found.push_back(csv.place() + "field: " + std::to_string(row.field) +
                        ", expected no less than in the row before (" +
                        std::to_string(rows_.back().field) + ")");
        continue;
      }
      in_field = !rows_.empty() && row.field == rows_.back().field ? in_field + 1 : 1;
      if (in_field > core::kMaxEventsPerField) {
        found.push_back(csv.place() + "field: more than " +
                        std::to_string(core::kMaxEventsPerField) + " events before field " +
                        std::to_string(row.field) + ", expected at most that many");
        continue;
      }
      rows_.push_back(row);
      has_pose_results_ =
          has_pose_results_ || core::content_if<core::PoseResult>(row.event) != nullptr;
    }
  }
  messages.insert(messages.end(), found.begin(), found.end());
  return found.empty() ? Result<void>() : Unexpected(Error::kInvalidArgument);
}

const Event* ReplayEvents::next_before(std::int64_t field) const {
  return taken_ < rows_.size() && rows_[taken_].field <= field ? &rows_[taken_].event : nullptr;
}

void ReplayEvents::take_before(std::int64_t field, core::EventList& events) {
  events.clear();
  // Were the list ever full, the rest would be handed before the next field.
  for (const Event* next = next_before(field); next != nullptr && events.try_push_back(*next);
       next = next_before(field)) {
    take_next();
  }
}

}  // namespace tubesight::drivers
