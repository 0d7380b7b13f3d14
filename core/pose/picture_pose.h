#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/base/static_vector.h"
#include "core/base/tube_address.h"
#include "core/picture/averaged_picture.h"
#include "core/picture/rim_measurement.h"
#include "core/picture/tube_scan.h"
#include "core/pose/pose_estimate.h"
#include "core/pose/pose_model.h"
#include "core/tubesheet/sheet_map.h"

namespace tubesight::core::pose {

/// A place inside the dark of a named tube-end, from an operator or from the tracker.
struct PictureStart {
  TubeAddress address;
  double u_px = 0.0;  ///< full-frame pixels, up to 60 % of the radius off the middle
  double v_px = 0.0;
};

/// Places that one pose can start from; an operator gives three, a test nine.
inline constexpr std::int32_t kMaxPictureStarts = 48;

/// Why a picture gave no pose.
enum class PictureRefusal : std::uint8_t {
  kNone,
  kTooFewStarts,  ///< fewer places than the method needs tubes
  kStart,         ///< the place `start` is not inside a tube-end, see `scan`
  kSameTube,      ///< the place `start` is in a tube-end that another place named, too
  kNoSuchTube,    ///< the address of `start` has no open tube-end by the settings
  kPose,          ///< see the pose's refusal
};

/// How a picture is turned into a pose.
struct PictureOptions {
  PoseOptions pose;
  picture::ScanOptions scan;
  picture::RimMeasureOptions rims;
  bool only_start = false;  ///< use the tubes named and no others
};

/// One tube-end that was looked for.
struct PictureTube {
  TubeAddress address;
  picture::RimFinding finding = picture::RimFinding::kMeasured;
  bool used = false;      ///< by the pose
  std::int32_t rim = -1;  ///< index in the workspace's rims; -1: not measured
  double u_px = 0.0;      ///< image of its centre by the pose
  double v_px = 0.0;
};

/// Tube-ends that one picture is searched for, open and plugged ones: 96 measured and as many
/// rejected, of which the nearest to the middle of the starts count.
inline constexpr std::int32_t kMaxPictureTubes = 192;

/// A pose with all that was found on the way, or the reason against one.
struct PictureOutcome {
  PictureRefusal refusal = PictureRefusal::kNone;
  std::int32_t start = -1;  ///< the place that is to blame
  picture::ScanRefusal scan = picture::ScanRefusal::kNone;
  PoseOutcome pose;  ///< also tells the reason of kPose
  StaticVector<PictureTube, kMaxPictureTubes> tubes;

  [[nodiscard]] bool has_value() const { return refusal == PictureRefusal::kNone; }
};

/// Scratch memory of estimate_from_picture(), some 2 MB, owned by the caller. The rims of the last
/// pass stay readable until the next call.
struct PictureWorkspace {
  picture::RimList rims;
  PoseWorkspace pose;
};

/// The pose from an averaged picture at rest: the source's scan at the places given, a first pose
/// from these tube-ends, then all others where this pose predicts them, in rings outwards, each
/// measured across its predicted rim and fitted again.
///
/// Tubes that the settings list as plugged or missing are left out, plugs that they don't list are
/// recognised. Deterministic; costs some 15 ms for 60 tube-ends.
[[nodiscard]] PictureOutcome estimate_from_picture(const picture::AveragedPicture& picture,
                                                   const PoseModel& model,
                                                   const tubesheet::SheetMap& map,
                                                   std::span<const PictureStart> starts,
                                                   const PictureOptions& options,
                                                   PictureWorkspace& workspace);

}  // namespace tubesight::core::pose
