#include "board/bench/cold_start/cold_start.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

#include "board/bench/look/look_text.h"
#include "core/tubesheet/sheet_places.h"
#include "core/tubesheet/tubesheet_setup.h"
#include "drivers/files/decimal.h"
#include "drivers/settings/session_checks.h"

namespace tubesight::board {
namespace {

using core::TubeAddress;
using core::detection::LatticeElement;
using core::pose::PictureStart;

constexpr double kDegrees = 180.0 / std::numbers::pi;

/// A heading is given good to this; a degree more for what a lean and the calibration do to it.
constexpr double kHeading_deg = 20.0;
constexpr double kHeadingSlack_deg = 1.0;

/// As for a start of three clicks: more sites that should be closed refute it.
constexpr std::int32_t kMostOpen = 2;

/// A tube-end that stands out by less than this share of the median is not sure to be open.
constexpr double kClearlyOpen = 0.5;

/// Tube-ends that a start is made of: the one clicked and five of the best around it.
constexpr std::size_t kPlaces = 6;
/// Of the edge that was measured, for a place to start from.
constexpr double kWholeEdge = 0.9;

double wrapped_deg(double angle_deg) { return std::remainder(angle_deg, 360.0); }

std::string clicked_text(const PictureStart& click) {
  return drivers::address_text(click.address) + " at " +
         drivers::point_text({click.u_px, click.v_px});
}

/// The address that the middle tube gets: (0, 0), or one beside it where the numbering has none.
TubeAddress middle_address(const core::TubesheetSettings& sheet) {
  const auto at = core::tubesheet::center_mm(sheet, {0, 0});
  return core::tubesheet::nearest_address(sheet, at);
}

void make_relative(core::TubesheetSettings& sheet) {
  constexpr std::int32_t kFar = 200;
  sheet.rows = {-kFar, kFar};
  sheet.columns = {-kFar, kFar};
  sheet.missing.clear();
  sheet.plugged.clear();
  sheet.origin_mm = {};
  const auto center = core::tubesheet::center_mm(sheet, middle_address(sheet));
  sheet.origin_mm = {-center[0], -center[1]};
}

}  // namespace

ColdStart::ColdStart(const core::SessionSettings& settings, bool has_tool,
                     std::optional<double> heading_deg)
    : settings_(settings),
      has_tool_(has_tool),
      heading_deg_(has_tool ? heading_deg : std::nullopt),
      relative_(std::make_unique<core::TubesheetSettings>(settings.tubesheet)),
      finder_(std::make_unique<core::detection::LatticeFinder>()),
      found_(std::make_unique<core::detection::FoundLattice>()) {
  make_relative(*relative_);
  const auto model =
      core::pose::make_pose_model(settings.camera, settings.tool, settings.tubesheet);
  sound_ = model && map_.assign(settings.tubesheet);
  if (model) {
    model_ = *model;
  }
}

std::string ColdStart::find_lattice(const core::picture::AveragedPicture& picture) {
  if (!sound_) {
    return "no pose can be computed with these settings together";
  }
  scratch_.resize(static_cast<std::size_t>(picture.width_px) *
                  static_cast<std::size_t>(picture.height_px));
  const auto refusal = finder_->find(picture, {}, scratch_, *found_);
  if (refusal != core::detection::FinderRefusal::kNone) {
    return "no lattice found: " + std::string(explain(refusal));
  }
  gaps_ = find_gaps(*found_, picture);
  return found_->dark ? "" : "no lattice found: bright dots, expected the dark of tube-ends";
}

/// The element whose outline a place is in; -1: none.
std::int32_t ColdStart::element_at(double u_px, double v_px) const {
  for (std::int32_t i = 0; i < found_->elements.size(); ++i) {
    const core::detection::Ellipse& ellipse = found_->elements[i].ellipse;
    const Eigen::Vector2d off = Eigen::Vector2d(u_px, v_px) - ellipse.center_px;
    if (off.dot(ellipse.shape_px2.inverse() * off) < 1.0) {
      return i;
    }
  }
  return -1;
}

/// Of the tool on the sheet; of the camera, where there is no tool.
double ColdStart::heading_of(const LatticeReading& reading) const {
  Eigen::Matrix3d turn = reading.R_camera_sheet.transpose();
  if (has_tool_) {
    turn = (turn * model_.T_camera_tool.rotation()).eval();
  }
  return std::atan2(turn(1, 0), turn(0, 0)) * kDegrees;
}

/// Tube-ends that are clearly open where the reading has none by the settings.
std::int32_t ColdStart::count_refuted(const LatticeReading& reading) const {
  std::vector<double> contrasts;
  for (const LatticeElement& element : found_->elements) {
    contrasts.push_back(element.contrast);
  }
  const auto middle = contrasts.begin() + static_cast<std::ptrdiff_t>(contrasts.size() / 2);
  std::nth_element(contrasts.begin(), middle, contrasts.end());
  std::int32_t refuted = 0;
  for (std::int32_t i = 0; i < found_->elements.size(); ++i) {
    const LatticeElement& element = found_->elements[i];
    const bool clear = element.share > 0.0 && element.contrast > kClearlyOpen * *middle;
    const bool closed =
        map_.state(reading.tubes[static_cast<std::size_t>(i)]) != core::TubeState::kOpen;
    refuted += clear && closed ? 1 : 0;
  }
  return refuted;
}

/// Sites seen closed that the settings have open tube-ends at: plugs that nobody listed.
std::int32_t ColdStart::count_unlisted(const LatticeReading& reading) const {
  std::int32_t unlisted = 0;
  for (const LatticePlace& gap : gaps_) {
    const Eigen::Vector2d at =
        reading.origin_mm + gap.row * reading.row_mm + gap.column * reading.column_mm;
    const TubeAddress tube =
        core::tubesheet::nearest_address(settings_.tubesheet, {at.x(), at.y()});
    unlisted += map_.state(tube) == core::TubeState::kOpen ? 1 : 0;
  }
  return unlisted;
}

ColdTubes ColdStart::find(const core::picture::AveragedPicture& picture,
                          const std::vector<PictureStart>& clicks) {
  ColdTubes tubes;
  tubes.message = find_lattice(picture);
  std::array<std::int32_t, 2> at{-1, -1};
  for (std::size_t i = 0; i < clicks.size() && tubes.message.empty(); ++i) {
    at[i] = element_at(clicks[i].u_px, clicks[i].v_px);
    if (at[i] < 0) {
      tubes.message = clicked_text(clicks[i]) +
                      ": no tube there, expected a place in the dark of a "
                      "tube-end of the lattice found";
    }
  }
  if (tubes.message.empty() && at[0] == at[1]) {
    tubes.message = drivers::address_text(clicks[0].address) + " and " +
                    drivers::address_text(clicks[1].address) +
                    " were clicked in one tube-end, expected two";
  }
  if (!tubes.message.empty()) {
    return tubes;
  }
  std::vector<LatticeReading> readings =
      find_readings(*found_, at[0], clicks[0].address, model_, settings_.tubesheet);
  if (readings.empty()) {
    tubes.message =
        "the lattice found is none of this sheet: its form or its tube-ends' size do not fit the "
        "steps, bore_mm and [camera] of the settings";
    return tubes;
  }
  tubes.message = choose(readings, clicks, at[1]);
  if (tubes.message.empty()) {
    tubes.places = places_of(readings[0], at[0], &map_);
    if (tubes.places.size() < kWholeStart) {
      tubes.message = "fewer than three whole tube-ends in a triangle around " +
                      clicked_text(clicks[0]) + ", expected a click farther from the edge";
      tubes.places.clear();
    }
  }
  return tubes;
}

/// Leaves the one reading that is meant, or says why not.
std::string ColdStart::choose(std::vector<LatticeReading>& readings,
                              const std::vector<PictureStart>& clicks, std::int32_t second) const {
  const auto keep = [&](auto wanted) {
    readings.erase(std::remove_if(readings.begin(), readings.end(),
                                  [&](const LatticeReading& r) { return !wanted(r); }),
                   readings.end());
  };
  if (second >= 0) {
    keep([&](const LatticeReading& reading) {
      return reading.tubes[static_cast<std::size_t>(second)] == clicks[1].address;
    });
    if (readings.empty()) {
      return "the addresses contradict the lattice: from " + clicked_text(clicks[0]) +
             " it leads to " + clicked_text(clicks[1]) + " in no direction";
    }
  }
  if (heading_deg_) {
    const std::string open = why_open(readings);
    keep([&](const LatticeReading& reading) {
      return std::abs(wrapped_deg(heading_of(reading) - *heading_deg_)) <=
             kHeading_deg + kHeadingSlack_deg;
    });
    if (readings.empty()) {
      std::string text = "heading_deg: ";
      drivers::print(text, "%.1f", *heading_deg_);
      return text + " is more than 20 degrees off each direction that is left; " + open;
    }
  }
  if (readings.size() > 1) {
    leave_by_map(readings);
  }
  if (readings.size() > 1) {
    return why_open(readings) +
           "; expected heading_deg in [start], good to 20 degrees, or a second address";
  }
  if (const std::int32_t refuted = count_refuted(readings[0]); refuted > kMostOpen) {
    return "the map refutes it: " + std::to_string(refuted) +
           " sites that should be closed are open tube-ends (missing, plugged or off the sheet by "
           "the settings)";
  }
  return {};
}

/// Drops the readings that the map refutes beside one that it does not.
void ColdStart::leave_by_map(std::vector<LatticeReading>& readings) const {
  std::vector<std::int32_t> refuted;
  std::vector<std::int32_t> against;
  for (const LatticeReading& reading : readings) {
    refuted.push_back(count_refuted(reading));
    against.push_back(refuted.back() + count_unlisted(reading));
  }
  const auto best = std::min_element(against.begin(), against.end());
  // A map that is wrong somewhere does not choose.
  if (refuted[static_cast<std::size_t>(best - against.begin())] > 0) {
    return;
  }
  std::vector<LatticeReading> left;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    // A gap alone is none: a plug may be missing in the list.
    if (refuted[i] == 0 || against[i] <= *best + kMostOpen) {
      left.push_back(std::move(readings[i]));
    }
  }
  readings = std::move(left);
}

/// In which directions a lattice may lie, for a person.
std::string ColdStart::why_open(const std::vector<LatticeReading>& readings) const {
  std::vector<double> headings;
  for (const LatticeReading& reading : readings) {
    headings.push_back(heading_of(reading));
  }
  std::sort(headings.begin(), headings.end());
  std::string text = "the addresses given leave " + std::to_string(readings.size()) +
                     (readings.size() == 1 ? " direction" : " directions");
  if (has_tool_) {
    text += " (the tool's heading ";
    for (std::size_t i = 0; i < headings.size(); ++i) {
      drivers::print(text, "%s%.1f",
                     i == 0                    ? ""
                     : i + 1 < headings.size() ? ", "
                                               : " or ",
                     headings[i]);
    }
    text += " degrees)";
  }
  return text;
}

ColdTubes ColdStart::find_middle(const core::picture::AveragedPicture& picture) {
  ColdTubes tubes;
  tubes.message = find_lattice(picture);
  if (!tubes.message.empty()) {
    return tubes;
  }
  const Eigen::Vector2d middle(0.5 * (picture.width_px - 1), 0.5 * (picture.height_px - 1));
  std::int32_t anchor = 0;
  for (std::int32_t i = 1; i < found_->elements.size(); ++i) {
    if ((found_->elements[i].center_px - middle).norm() <
        (found_->elements[anchor].center_px - middle).norm()) {
      anchor = i;
    }
  }
  const std::vector<LatticeReading> readings =
      find_readings(*found_, anchor, middle_address(*relative_), model_, *relative_);
  const double heading_deg = heading_deg_.value_or(0.0);
  const auto off = [&](const LatticeReading& reading) {
    return std::abs(wrapped_deg(heading_of(reading) - heading_deg));
  };
  const auto best = std::min_element(
      readings.begin(), readings.end(),
      [&](const LatticeReading& a, const LatticeReading& b) { return off(a) < off(b); });
  if (best == readings.end()) {
    tubes.message =
        "the lattice found is none of this sheet: its form or its tube-ends' size do not fit the "
        "steps, bore_mm and [camera] of the settings";
    return tubes;
  }
  tubes.places = places_of(*best, anchor, nullptr);
  if (tubes.places.size() < kWholeStart) {
    tubes.message = "fewer than three whole tube-ends in a triangle around the picture's middle";
    tubes.places.clear();
  }
  return tubes;
}

/// The anchor and the nearest of the whole tube-ends around it, not all in one line.
std::vector<PictureStart> ColdStart::places_of(const LatticeReading& reading, std::int32_t anchor,
                                               const core::tubesheet::SheetMap* map) const {
  const LatticeElement& first = found_->elements[anchor];
  std::vector<std::int32_t> order;
  for (std::int32_t i = 0; i < found_->elements.size(); ++i) {
    const LatticeElement& element = found_->elements[i];
    const bool open = map == nullptr || map->state(reading.tubes[static_cast<std::size_t>(i)]) ==
                                            core::TubeState::kOpen;
    const auto& [left, top, right, bottom] = settings_.start.window_px;
    const bool in_window = element.center_px.x() >= left && element.center_px.x() <= right &&
                           element.center_px.y() >= top && element.center_px.y() <= bottom;
    if (i != anchor && open && in_window && element.share >= kWholeEdge) {
      order.push_back(i);
    }
  }
  std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    return (found_->elements[a].center_px - first.center_px).squaredNorm() <
           (found_->elements[b].center_px - first.center_px).squaredNorm();
  });
  std::vector<PictureStart> places;
  bool triangle = false;
  const auto take = [&](std::int32_t i) {
    const LatticeElement& element = found_->elements[i];
    places.push_back(
        {reading.tubes[static_cast<std::size_t>(i)], element.center_px.x(), element.center_px.y()});
  };
  take(anchor);
  for (const std::int32_t i : order) {
    const LatticeElement& element = found_->elements[i];
    if (places.size() == 1) {
      take(i);
      continue;
    }
    const Eigen::Vector2d a(places[1].u_px - places[0].u_px, places[1].v_px - places[0].v_px);
    const Eigen::Vector2d b = element.center_px - first.center_px;
    const bool off_line = std::abs(a.x() * b.y() - a.y() * b.x()) > 0.3 * a.norm() * b.norm();
    if (places.size() < kPlaces && (triangle || off_line || places.size() + 1 < kPlaces)) {
      triangle = triangle || off_line;
      take(i);
    }
  }
  if (!triangle) {
    places.resize(1);
  }
  return places;
}

}  // namespace tubesight::board
