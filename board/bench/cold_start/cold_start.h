#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "board/bench/cold_start/lattice_gaps.h"
#include "board/bench/cold_start/lattice_readings.h"
#include "core/base/settings.h"
#include "core/base/tube_address.h"
#include "core/detection/lattice_finder.h"
#include "core/picture/averaged_picture.h"
#include "core/pose/picture_pose.h"
#include "core/pose/pose_model.h"
#include "core/tubesheet/sheet_map.h"

namespace tubesight::board {

/// Tube-ends of one picture with their addresses, or why none can be named.
struct ColdTubes {
  std::vector<core::pose::PictureStart>
      places;           ///< the first is the one clicked, or the middle one
  std::string message;  ///< why there are none; else empty
};

/// From this many clicks on a start needs no lattice found cold.
inline constexpr std::size_t kWholeStart = 3;

/// Turns a start of one or two clicks into one of three or more, by the lattice that is found cold
/// in the picture clicked into.
///
/// One address leaves several readings of a lattice (find_readings()). A second address decides, or
/// the tool's heading good to 20 degrees; or the map does: of the sites that the settings say are
/// closed none may look open by the reading that is left, and each other one must have such a site
/// and contradict the picture three times more often, closed sites that it calls open counted. What
/// is then still open is refused, and what has more than two such sites, as any start. Holds 6 MB.
class ColdStart {
 public:
  /// `heading_deg` is the tool's on the sheet; of no use without a tool. The settings are copied.
  ColdStart(const core::SessionSettings& settings, bool has_tool,
            std::optional<double> heading_deg);

  /// The clicks and tube-ends around them. Clicks: one or two.
  [[nodiscard]] ColdTubes find(const core::picture::AveragedPicture& picture,
                               const std::vector<core::pose::PictureStart>& clicks);

  /// Tube-ends around the one nearest to the picture's middle, which is given the address (0, 0),
  /// or one beside it where the numbering has none, and stands at (0, 0) mm. Which of the readings
  /// is meant nobody knows: the one whose heading is nearest to the one given, or to 0. The sheet
  /// is relative_sheet().
  [[nodiscard]] ColdTubes find_middle(const core::picture::AveragedPicture& picture);

  /// The settings' lattice around tube (0, 0), without lists and without an end.
  [[nodiscard]] const core::TubesheetSettings& relative_sheet() const { return *relative_; }

 private:
  [[nodiscard]] std::string find_lattice(const core::picture::AveragedPicture& picture);
  [[nodiscard]] std::int32_t element_at(double u_px, double v_px) const;
  [[nodiscard]] double heading_of(const LatticeReading& reading) const;
  [[nodiscard]] std::int32_t count_refuted(const LatticeReading& reading) const;
  [[nodiscard]] std::int32_t count_unlisted(const LatticeReading& reading) const;
  [[nodiscard]] std::string choose(std::vector<LatticeReading>& readings,
                                   const std::vector<core::pose::PictureStart>& clicks,
                                   std::int32_t second) const;
  void leave_by_map(std::vector<LatticeReading>& readings) const;
  [[nodiscard]] std::string why_open(const std::vector<LatticeReading>& readings) const;
  [[nodiscard]] std::vector<core::pose::PictureStart> places_of(
      const LatticeReading& reading, std::int32_t anchor,
      const core::tubesheet::SheetMap* map) const;

  core::SessionSettings settings_;
  bool has_tool_;
  std::optional<double> heading_deg_;
  core::pose::PoseModel model_;
  core::tubesheet::SheetMap map_;
  bool sound_ = false;  ///< the settings give a model
  std::unique_ptr<core::TubesheetSettings> relative_;
  std::unique_ptr<core::detection::LatticeFinder> finder_;
  std::unique_ptr<core::detection::FoundLattice> found_;
  std::vector<std::uint16_t> scratch_;
  std::vector<LatticePlace> gaps_;  ///< of the lattice found
};

}  // namespace tubesight::board
