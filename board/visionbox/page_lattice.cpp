#include "board/visionbox/page_lattice.h"

#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <optional>
#include <utility>

#include <Eigen/Core>

#include "core/base/transform.h"
#include "core/detection/lattice_finder.h"
#include "core/picture/averaged_picture.h"
#include "core/tubesheet/sheet_places.h"

namespace tubesight::board {
namespace {

using Vector = std::array<double, 2>;

double cross(const Vector& a, const Vector& b) { return a[0] * b[1] - a[1] * b[0]; }
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1]; }
double length(const Vector& a) { return std::hypot(a[0], a[1]); }

/// Where a pixel's ray meets the sheet, for a tool that stands level below it, as a multiple of the
/// height: the camera looks up askew, and in the picture itself no angle is the sheet's.
class LevelSheet {
 public:
  explicit LevelSheet(const core::SessionSettings& told)
      : camera_(told.camera),
        R_tool_camera_(core::rotation_from_degrees(told.tool.rotation_deg).transpose()) {}

  /// [Fallon eq. 4.5-4.9]; empty: the ray does not meet it.
  [[nodiscard]] std::optional<Vector> place(const Vector& px) const {
    const double width_mm = camera_.cell_width_mm * camera_.sensor_columns /
                            (camera_.horizontal_scale * camera_.frame_columns);
    const double x = (px[0] - camera_.center_px[0]) * width_mm;
    const double y = (px[1] - camera_.center_px[1]) * camera_.cell_height_mm;
    const double r2 = x * x + y * y;
    const double bend = 1.0 + r2 * (camera_.distortion_per_mm2 + r2 * camera_.distortion2_per_mm4);
    const Eigen::Vector3d ray =
        R_tool_camera_ * Eigen::Vector3d(x * bend, y * bend, camera_.focal_length_mm);
    constexpr double kGrazing = 0.05;
    if (ray.z() < kGrazing * ray.norm()) {
      return {};
    }
    return Vector{ray.x() / ray.z(), ray.y() / ray.z()};
  }

 private:
  core::CameraSettings camera_;
  Eigen::Matrix3d R_tool_camera_;
};

/// Of a tool that leans by some degrees.
constexpr double kLengthsAgree = 0.15;
constexpr double kAnglesAgree_rad = 9.0 / 180.0 * std::numbers::pi;

bool are_alike(const Vector& i, const Vector& j, const Vector& on_sheet_i,
               const Vector& on_sheet_j) {
  // The camera looks up at the sheet along the sheet's own normal: nothing is mirrored.
  const double turn = std::atan2(cross(i, j), dot(i, j));
  const double on_sheet_turn =
      std::atan2(cross(on_sheet_i, on_sheet_j), dot(on_sheet_i, on_sheet_j));
  const double ratio = length(i) / length(j) * (length(on_sheet_j) / length(on_sheet_i));
  return std::abs(turn - on_sheet_turn) < kAnglesAgree_rad &&
         std::abs(std::log(ratio)) < kLengthsAgree;
}

using Found = core::detection::FoundLattice;

std::optional<Vector> in_picture(const Vector& px) { return px; }

/// The mean step to the next element along i or j, of the places that `place` makes of pixels.
template <typename Place>
std::optional<Vector> step_of(const Found& found, bool along_i, const Place& place) {
  Vector sum{};
  std::int32_t count = 0;
  for (const auto& from : found.elements) {
    for (const auto& to : found.elements) {
      const bool next = along_i ? to.row == from.row + 1 && to.column == from.column
                                : to.row == from.row && to.column == from.column + 1;
      if (!next) {
        continue;
      }
      const auto begin = place({from.center_px.x(), from.center_px.y()});
      const auto end = place({to.center_px.x(), to.center_px.y()});
      if (begin && end) {
        sum[0] += (*end)[0] - (*begin)[0];
        sum[1] += (*end)[1] - (*begin)[1];
        ++count;
      }
    }
  }
  return count > 0 ? std::optional(Vector{sum[0] / count, sum[1] / count}) : std::nullopt;
}

double rounded(double value) { return std::round(value * 1e3) / 1e3; }

Json vector_json(const Vector& px) { return {{"u", rounded(px[0])}, {"v", rounded(px[1])}}; }

Json elements_json(const Found& found) {
  Json elements = Json::array();
  for (const auto& element : found.elements) {
    elements.push_back(
        {{"i", element.row},
         {"j", element.column},
         {"u", rounded(element.center_px.x())},
         {"v", rounded(element.center_px.y())},
         {"size_px", rounded(2.0 * std::pow(element.ellipse.shape_px2.determinant(), 0.25))}});
  }
  return elements;
}

Json not_found(const char* words) { return {{"found", false}, {"words", words}}; }

}  // namespace

std::vector<LatticeWay> lattice_ways(const core::TubesheetSettings& sheet, const Vector& i,
                                     const Vector& j) {
  using core::tubesheet::check_move;
  using core::tubesheet::move_mm;
  using core::tubesheet::MoveFault;
  // From row to row another kind of tube: neighbours in the picture are no steps of the lattice.
  if (check_move(sheet, {1, 0}) == MoveFault::kRows) {
    return {};
  }
  // Of numberings that leave out every other address, neighbours are two numbers apart.
  const std::int32_t area = check_move(sheet, {0, 1}) == MoveFault::kNone ? 1 : 2;
  constexpr std::int32_t kMost = 2;
  std::vector<LatticeWay> ways;
  for (std::int32_t a = -kMost; a <= kMost; ++a) {
    for (std::int32_t c = -kMost; c <= kMost; ++c) {
      for (std::int32_t b = -kMost; b <= kMost; ++b) {
        for (std::int32_t d = -kMost; d <= kMost; ++d) {
          if (std::abs(a * d - b * c) == area && check_move(sheet, {a, c}) == MoveFault::kNone &&
              check_move(sheet, {b, d}) == MoveFault::kNone &&
              are_alike(i, j, move_mm(sheet, {a, c}), move_mm(sheet, {b, d}))) {
            ways.push_back({a, b, c, d});
          }
        }
      }
    }
  }
  return ways;
}

Json find_page_lattice(const core::ImageView& picture, const core::SessionSettings& told) {
  const std::size_t size =
      static_cast<std::size_t>(picture.width_px) * static_cast<std::size_t>(picture.height_px);
  std::vector<std::uint16_t> sums(size);
  std::vector<std::uint16_t> scratch(size);
  core::picture::PictureAverage average(sums, picture.width_px, picture.height_px);
  if (!average.add(core::field_of(picture, core::Parity::kProgressive))) {
    return not_found("the picture cannot be used");
  }
  const auto averaged = average.finish();
  if (!averaged) {
    return not_found("the picture cannot be used");
  }
  const auto finder = std::make_unique<core::detection::LatticeFinder>();
  const auto found = std::make_unique<Found>();
  switch (finder->find(*averaged, {}, scratch, *found)) {
    case core::detection::FinderRefusal::kNone: break;
    case core::detection::FinderRefusal::kSize: return not_found("the picture has another size");
    case core::detection::FinderRefusal::kFlat: return not_found("the picture has no contrast");
    case core::detection::FinderRefusal::kTooMany:
      return not_found("too many spots: a texture, and no tube-ends");
    case core::detection::FinderRefusal::kNoLattice:
      return not_found("no five tube-ends that make rows and columns");
  }
  const auto i_px = step_of(*found, true, in_picture);
  const auto j_px = step_of(*found, false, in_picture);
  const LevelSheet sheet(told);
  const auto place = [&sheet](const Vector& px) { return sheet.place(px); };
  const auto i = step_of(*found, true, place);
  const auto j = step_of(*found, false, place);
  if (!found->dark || !i_px || !j_px || !i || !j) {
    return not_found("no tube-ends that make rows and columns");
  }
  const std::vector<LatticeWay> ways = lattice_ways(told.tubesheet, *i, *j);
  Json ways_json = Json::array();
  for (const LatticeWay& way : ways) {
    ways_json.push_back(
        {{"a", way.a}, {"b", way.b}, {"c", way.c}, {"d", way.d}, {"likely", ways.size() == 1}});
  }
  return {{"found", true},
          {"elements", elements_json(*found)},
          {"basis", {{"i", vector_json(*i_px)}, {"j", vector_json(*j_px)}}},
          {"ways", std::move(ways_json)}};
}

}  // namespace tubesight::board
