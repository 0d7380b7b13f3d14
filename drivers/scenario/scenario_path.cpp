#include "drivers/scenario/scenario_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <string_view>

#include "core/tubesheet/sheet_places.h"
#include "core/tubesheet/tubesheet_setup.h"
#include "drivers/scenario/scenario_keys.h"
#include "drivers/settings/read_table.h"
#include "drivers/settings/session_checks.h"
#include "drivers/settings/table_reader.h"
#include "drivers/simulated/dice.h"

namespace tubesight::drivers {
namespace {

using core::TubeAddress;
using core::kinematics::PathSegment;
using core::kinematics::SegmentKind;
using core::kinematics::ToolPlace;
using drivers::TableReader;

constexpr NumberRange kOffset{-100.0, 100.0, " mm"};
constexpr NumberRange kScatter{0.0, 10.0, " mm"};

/// What a step may do: the key that says so.
constexpr std::array<std::string_view, 8> kActions = {
    "rest_s", "to", "to_mm", "height_mm", "dock_mm", "heading_deg", "lean_deg", "tour"};
/// How a step does it, beside kProfileKey, kMoveKeys and kTurnKeys.
constexpr std::array<std::string_view, 5> kManners = {"claim", "claim_tube", "pause_s", "at_most",
                                                      "offset_mm"};
constexpr const char* kOneAction =
    "one of rest_s, to, to_mm, height_mm, dock_mm, heading_deg, lean_deg, tour";

}  // namespace

PathReader::PathReader(const core::TubesheetSettings& sheet, std::uint64_t seed,
                       drivers::Scenario& scenario)
    : sheet_(&sheet),
      scenario_(&scenario),
      path_(std::make_unique<core::kinematics::ToolPath>()),
      seed_(drivers::derived_seed(seed, 0x9A7F)) {}

PathReader::~PathReader() = default;

bool PathReader::read(drivers::SettingsDocument& document) {
  scenario_->path.clear();
  scenario_->events.clear();
  claims_.clear();
  const bool start =
      drivers::read_table(document, "path", true, [&](TableReader& table) { read_start(table); });
  if (!start) {
    return false;  // where the steps lead cannot be told
  }
  return drivers::read_each_table(document, "step",
                                  [&](TableReader& table, std::size_t) { read_step(table); });
}

void PathReader::read_start(TableReader& table) {
  ToolPlace& from = scenario_->from;
  std::array<double, 2> place{};
  bool placed = false;
  std::string_view key = "tube";
  if (table.has(kPlaceKey)) {
    key = kPlaceKey;
    placed = table.numbers(kPlaceKey, kPathPlace, place);
    table.ignore("tube");
    if (table.has("tube")) {
      table.complain("tube", "at_mm is given as well, expected one of them");
    }
  } else {
    TubeAddress tube;
    placed = read_tube(table, "tube", tube);
    place = placed ? core::tubesheet::center_mm(*sheet_, tube) : place;
    table.ignore(kPlaceKey);
  }
  std::array<double, 2> offset{};
  std::array<double, 2> lean{};
  from = {0.0, 0.0, 60.0, 0.0, 0.0, 0.0};
  table.optional_numbers("offset_mm", kOffset, offset);
  drivers::read_keys(table, kFromKeys, from);
  table.optional_numbers(kLeanKey, kLean, lean);
  table.optional_number("scatter_mm", kScatter, scatter_mm_);
  read_manner(table, manner_, false);
  read_manner(table, manner_, true);
  from.x_mm = place[0] + offset[0];
  from.y_mm = place[1] + offset[1];
  from.beta_deg = lean[0];
  from.gamma_deg = lean[1];
  if (const std::string wrong =
          placed ? drivers::why_off_the_sheet(*sheet_, {from.x_mm, from.y_mm}) : "";
      !wrong.empty()) {
    table.complain(key, wrong);
  }
  static_cast<void>(path_->begin(from));  // finite: all were read within ranges
}

void PathReader::read_manner(TableReader& table, Manner& manner, bool turn) {
  std::size_t shape = static_cast<std::size_t>(manner.shape);
  table.optional_word(kProfileKey, kProfileWords, shape);
  manner.shape = static_cast<core::kinematics::SpeedShape>(shape);
  if (turn) {
    drivers::read_keys(table, kTurnKeys, manner.turn);
  } else {
    drivers::read_keys(table, kMoveKeys, manner.move);
  }
}

void PathReader::read_step(TableReader& table) {
  std::string_view action;
  for (const std::string_view candidate : kActions) {
    if (!table.has(candidate)) {
      continue;
    }
    if (!action.empty()) {
      table.complain(candidate, std::string(action) + " is in the same step, expected " +
                                    std::string(kOneAction));
      table.ignore(candidate);
      continue;
    }
    action = candidate;
  }
  if (action.empty()) {
    table.complain("rest_s", std::string("missing, expected ") + kOneAction);
    for (const std::string_view key : kManners) {
      table.ignore(key);  // whose they are cannot be told
    }
    table.ignore(kProfileKey);
    drivers::ignore_keys(table, kMoveKeys);
    drivers::ignore_keys(table, kTurnKeys);
    return;
  }
  if (action == "rest_s") {
    read_rest(table);
    return;
  }
  if (action == "tour") {
    read_tour(table);
    return;
  }
  PathSegment segment;
  const bool turn = action == "heading_deg" || action == "lean_deg";
  Manner manner = manner_;
  read_manner(table, manner, turn);
  segment.shape = manner.shape;
  segment.limits = turn ? manner.turn : manner.move;
  const std::size_t before = table.problems().size();
  if (action == "height_mm") {
    segment.kind = SegmentKind::kHeight;
    drivers::read_key(table, kStepHeight, segment);
  } else if (action == "dock_mm") {
    segment.kind = SegmentKind::kDock;
    drivers::read_key(table, kStepDock, segment);
  } else if (action == "heading_deg") {
    segment.kind = SegmentKind::kTurn;
    drivers::read_key(table, kStepHeading, segment);
  } else if (action == "lean_deg") {
    segment.kind = SegmentKind::kLean;
    drivers::read_key(table, kStepLean, segment);
  } else {
    read_move(table, segment);
  }
  if (table.problems().size() == before) {
    append(table, action, segment);
  }
}

void PathReader::read_rest(TableReader& table) {
  PathSegment rest;
  rest.kind = SegmentKind::kRest;
  bool claims = false;
  table.optional_switch("claim", claims);
  const ToolPlace& place = path_->end();
  TubeAddress tube = core::tubesheet::nearest_address(*sheet_, {place.x_mm, place.y_mm});
  if (table.has("claim_tube")) {
    claims = read_tube(table, "claim_tube", tube);
  } else {
    table.ignore("claim_tube");
    if (const std::string wrong = claims ? drivers::why_no_tube(*sheet_, tube) : "";
        !wrong.empty()) {
      table.complain("claim", wrong);  // a robot that knows of the void claims nothing there
    }
  }
  const double from_s = path_->duration_s();
  drivers::read_key(table, kStepRest, rest);
  if (table.sound(kStepRest.key) && append(table, kStepRest.key, rest) && claims) {
    claim(table, table.has("claim_tube") ? "claim_tube" : "claim", tube,
          from_s + rest.rest_s / 2.0);
  }
}

void PathReader::read_move(TableReader& table, PathSegment& segment) {
  segment.kind = SegmentKind::kMove;
  const std::size_t before = table.problems().size();
  if (table.has(kStepTo.key)) {
    drivers::read_key(table, kStepTo, segment);
    return;
  }
  TubeAddress tube;
  std::array<double, 2> offset{};
  read_tube(table, "to", tube);
  const bool exact = table.has("offset_mm");
  table.optional_numbers("offset_mm", kOffset, offset);
  if (table.problems().size() == before) {
    const auto place = core::tubesheet::center_mm(*sheet_, tube);
    const auto error = exact ? std::array<double, 2>{} : scattered();
    segment.to_mm = {place[0] + offset[0] + error[0], place[1] + offset[1] + error[1]};
  }
}

/// From one corner of a block of tubes to the other, along the rows, there and back again.
void PathReader::read_tour(TableReader& table) {
  Manner manner = manner_;
  read_manner(table, manner, false);
  double rest_s = 0.5;
  bool claims = true;
  std::int32_t most = 1000;
  table.optional_number("pause_s", kRest, rest_s);
  table.optional_switch("claim", claims);
  table.optional_whole("at_most", {1, 2000}, most);
  const toml::array* const corners = table.list("tour", true, "[[row, column], [row, column]]");
  TubeAddress a;
  TubeAddress b;
  if (corners == nullptr) {
    return;
  }
  if (corners->size() != 2 || !drivers::read_address((*corners)[0], a) ||
      !drivers::read_address((*corners)[1], b)) {
    table.complain("tour", "not two addresses, expected [[row, column], [row, column]]");
    return;
  }
  for (const TubeAddress corner : {a, b}) {
    if (!core::tubesheet::in_ranges(*sheet_, corner)) {
      table.complain("tour",
                     drivers::address_text(corner) + ", expected " + drivers::ranges_text(*sheet_));
      return;
    }
  }
  PathSegment move;
  move.kind = SegmentKind::kMove;
  move.shape = manner.shape;
  move.limits = manner.move;
  const std::int32_t down = a.row <= b.row ? 1 : -1;
  std::int32_t visits = 0;
  for (std::int32_t row = a.row; row != b.row + down && visits < most; row += down) {
    const std::int32_t along = a.column <= b.column ? 1 : -1;
    for (std::int32_t column = a.column; column != b.column + along && visits < most;
         column += along) {
      if (drivers::why_no_tube(*sheet_, {row, column}).empty()) {
        visit(table, {row, column}, rest_s, claims, move);
        ++visits;
      }
    }
    std::swap(a.column, b.column);
  }
  if (visits == 0) {
    table.complain("tour", "no tube stands there, expected at least one");
  }
}

void PathReader::visit(TableReader& table, TubeAddress tube, double rest_s, bool claims,
                       PathSegment move) {
  const auto place = core::tubesheet::center_mm(*sheet_, tube);
  const auto error = scattered();
  move.to_mm = {place[0] + error[0], place[1] + error[1]};
  PathSegment rest;
  rest.rest_s = rest_s;
  if (!append(table, "tour", move)) {
    return;
  }
  const double from_s = path_->duration_s();
  if (append(table, "tour", rest) && claims) {
    claim(table, "tour", tube, from_s + rest_s / 2.0);
  }
}

bool PathReader::read_tube(TableReader& table, std::string_view key, TubeAddress& tube) {
  if (!table.address(key, tube)) {
    return false;
  }
  const std::string wrong = drivers::why_no_tube(*sheet_, tube);
  if (!wrong.empty()) {
    table.complain(key, wrong);
  }
  return wrong.empty();
}

bool PathReader::append(TableReader& table, std::string_view key, const PathSegment& segment) {
  if (segment.kind == SegmentKind::kMove) {
    if (const std::string wrong = drivers::why_off_the_sheet(*sheet_, segment.to_mm);
        !wrong.empty()) {
      table.complain(key, wrong);
      return false;
    }
  }
  const auto added = path_->add(segment);
  if (!added) {
    table.complain(key, added.error() == core::Error::kBufferTooSmall
                            ? "the path is too long, expected at most " +
                                  std::to_string(core::kinematics::kMaxPathSegments) + " segments"
                            : "no such motion, expected speeds and accelerations that can be");
    return false;
  }
  scenario_->path.push_back(segment);
  return true;
}

void PathReader::claim(const TableReader& table, std::string_view key, TubeAddress tube,
                       double at_s) {
  drivers::ScenarioEvent told;
  told.at_s = at_s;
  told.event.content = core::Claim{tube};
  scenario_->events.push_back(told);
  claims_.push_back({table.name() + "." + std::string(key), table.place_of(key), true});
}

/// Where a robot stops instead of exactly under the tube.
std::array<double, 2> PathReader::scattered() {
  drivers::Dice dice(drivers::derived_seed(seed_, draws_++));
  while (true) {
    const double x = dice.between(-1.0, 1.0);
    const double y = dice.between(-1.0, 1.0);
    if (x * x + y * y <= 1.0) {
      return {scatter_mm_ * x, scatter_mm_ * y};
    }
  }
}

}  // namespace tubesight::drivers
