#include "core/pose/picture_pose.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Core>

#include "core/picture/rim_outline.h"
#include "core/picture/sheet_view.h"

namespace tubesight::core::pose {
namespace {

// Addresses that are tried around the first start: 32 steps of 17 mm reach beyond what the picture
// resolves.
constexpr std::int32_t kAddressReach = 32;

/// One pass over the picture: which tube-ends, and how far from the prediction they are looked for.
struct Pass {
  double ring_steps;  ///< tube-ends up to this many lattice steps from a start
  double search_px;
  double loose;  ///< the pose's limits of residual and sigma are times this
};

constexpr double kEverywhere = 1e9;
constexpr std::array kPasses = {Pass{0.0, 4.0, 6.0}, Pass{1.6, 4.0, 4.0}, Pass{3.2, 3.5, 3.0},
                                Pass{kEverywhere, 3.0, 2.0}, Pass{kEverywhere, 2.0, 1.0}};

/// A tube-end to look for, by its distance from the starts.
struct Wanted {
  TubeAddress address;
  double distance_mm = 0.0;
};
using WantedList = StaticVector<Wanted, kMaxPictureTubes>;

class PicturePose {
 public:
  PicturePose(const picture::AveragedPicture& picture, const PoseModel& model,
              const tubesheet::SheetMap& map, std::span<const PictureStart> starts,
              const PictureOptions& options, PictureWorkspace& workspace)
      : picture_(picture),
        model_(model),
        map_(map),
        starts_(starts),
        options_(options),
        workspace_(workspace) {}

  PictureOutcome run() {
    if (!scan_starts() || !fit(kPasses.front().loose)) {
      return outcome_;
    }
    for (const Pass& pass : kPasses) {
      measure(pass);
      if (!fit(pass.loose)) {
        return outcome_;
      }
    }
    tell_tubes();
    return outcome_;
  }

 private:
  bool refuse(PictureRefusal refusal, std::int32_t start) {
    outcome_.refusal = refusal;
    outcome_.start = start;
    return false;
  }

  /// The source's scan at every start.
  bool scan_starts() {
    workspace_.rims.clear();
    if (std::cmp_less(starts_.size(), options_.pose.min_tubes)) {
      return refuse(PictureRefusal::kTooFewStarts, -1);
    }
    StaticVector<picture::TubeScan, kMaxPictureStarts> scans;
    for (std::int32_t i = 0; i < static_cast<std::int32_t>(starts_.size()); ++i) {
      const PictureStart& start = starts_[static_cast<std::size_t>(i)];
      if (map_.state(start.address) != TubeState::kOpen || !model_.lattice.has(start.address)) {
        return refuse(PictureRefusal::kNoSuchTube, i);
      }
      scan_rim_.address = start.address;
      const picture::TubeScan scan =
          picture::scan_tube(picture_, start.u_px, start.v_px, options_.scan, scan_rim_);
      if (scan.refusal != picture::ScanRefusal::kNone) {
        outcome_.scan = scan.refusal;
        return refuse(PictureRefusal::kStart, i);
      }
      for (std::int32_t k = 0; k < scans.size(); ++k) {
        if (same_place(scan, scans[k]) ||
            starts_[static_cast<std::size_t>(k)].address == start.address) {
          return refuse(PictureRefusal::kSameTube, i);
        }
      }
      static_cast<void>(scans.try_push_back(scan));
      static_cast<void>(workspace_.rims.try_push_back(scan_rim_));
    }
    return true;
  }

  static bool same_place(const picture::TubeScan& a, const picture::TubeScan& b) {
    const auto middle = [](const picture::TubeScan& scan, std::size_t axis) {
      return (scan.box_px[axis] + scan.box_px[axis + 2]) / 2.0;
    };
    const auto half = [](const picture::TubeScan& scan, std::size_t axis) {
      return (scan.box_px[axis + 2] - scan.box_px[axis]) / 2.0;
    };
    return std::abs(middle(a, 0) - middle(b, 0)) < half(a, 0) &&
           std::abs(middle(a, 1) - middle(b, 1)) < half(a, 1);
  }

  bool fit(double loose) {
    PoseOptions options = options_.pose;
    options.max_rms_px *= loose;
    options.max_sigma_mm *= loose;
    // Whatever the method, tube-ends are looked for from the best pose there is.
    options.method = loose > 1.0 ? PoseMethod::kRims : options.method;
    outcome_.pose = estimate_pose(model_, workspace_.rims, options, workspace_.pose);
    if (!outcome_.pose.has_value()) {
      return refuse(PictureRefusal::kPose, -1);
    }
    return true;
  }

  [[nodiscard]] double distance_from_starts_mm(const Eigen::Vector2d& center_mm) const {
    double least = std::numeric_limits<double>::max();
    for (const PictureStart& start : starts_) {
      least = std::min(least, (model_.center_mm(start.address) - center_mm).norm());
    }
    return least;
  }

  /// The tube-ends of a pass, the nearest to the starts first.
  void list_wanted(const picture::SheetView& view, const Pass& pass) {
    wanted_.clear();
    const double ring_mm = (pass.ring_steps + 0.01) * model_.lattice.parameters().shortest_step;
    if (options_.only_start || pass.ring_steps == 0.0) {
      for (const PictureStart& start : starts_) {
        static_cast<void>(wanted_.try_push_back({start.address, 0.0}));
      }
      return;
    }
    const TubeAddress middle = starts_.front().address;
    for (std::int32_t row = -kAddressReach; row <= kAddressReach; ++row) {
      for (std::int32_t column = -kAddressReach; column <= kAddressReach; ++column) {
        consider(view, {middle.row + row, middle.column + column}, ring_mm);
      }
    }
    std::sort(wanted_.begin(), wanted_.end(), [](const Wanted& a, const Wanted& b) {
      return a.distance_mm != b.distance_mm ? a.distance_mm < b.distance_mm : a.address < b.address;
    });
  }

  void consider(const picture::SheetView& view, TubeAddress address, double ring_mm) {
    if (!model_.lattice.has(address)) {
      return;
    }
    const Eigen::Vector2d center_mm = model_.center_mm(address);
    const double distance_mm = distance_from_starts_mm(center_mm);
    if (distance_mm > ring_mm || map_.state(address) != TubeState::kOpen ||
        !reaches_picture(view, center_mm)) {
      return;
    }
    if (!wanted_.try_push_back({address, distance_mm})) {
      Wanted* const farthest = std::max_element(
          wanted_.begin(), wanted_.end(),
          [](const Wanted& a, const Wanted& b) { return a.distance_mm < b.distance_mm; });
      if (farthest->distance_mm > distance_mm) {
        *farthest = {address, distance_mm};
      }
    }
  }

  /// Whether a good part of a tube-end can be in the picture, and is not seen too flat.
  [[nodiscard]] bool reaches_picture(const picture::SheetView& view,
                                     const Eigen::Vector2d& center_mm) const {
    const auto center = view.to_pixel(center_mm);
    const double radius_mm = model_.bore_mm / 2.0;
    if (!center) {
      return false;
    }
    double half_u = 0.0;
    double half_v = 0.0;
    for (const Eigen::Vector2d& step :
         {Eigen::Vector2d(radius_mm, 0.0), Eigen::Vector2d(0.0, radius_mm)}) {
      const auto pixel = view.to_pixel(Eigen::Vector2d(center_mm + step));
      if (!pixel) {
        return false;
      }
      half_u = std::hypot(half_u, pixel->x() - center->x());
      half_v = std::hypot(half_v, pixel->y() - center->y());
    }
    const auto overlaps = [](double middle, double half, std::int32_t size) {
      return middle + half > 0.0 && middle - half < size;
    };
    return std::min(half_u, half_v) > 0.7 * options_.rims.least_half_px &&
           overlaps(center->x(), half_u, picture_.width_px) &&
           overlaps(center->y(), half_v, picture_.height_px);
  }

  void measure(const Pass& pass) {
    const picture::SheetView view(model_.camera, outcome_.pose.estimate.T_camera_sheet);
    list_wanted(view, pass);
    workspace_.rims.clear();
    outcome_.tubes.clear();
    picture::RimMeasureOptions options = options_.rims;
    options.edge.search_px = pass.search_px;
    for (const Wanted& wanted : wanted_) {
      PictureTube tube{wanted.address};
      if (!picture::project_rim(view, model_.center_mm(wanted.address), model_.bore_mm / 2.0,
                                options.arc_px, outline_)) {
        continue;
      }
      scan_rim_.address = wanted.address;
      tube.finding = picture::measure_rim(picture_, outline_, options, scan_rim_);
      tube.u_px = outline_.center_u_px;
      tube.v_px = outline_.center_v_px;
      const bool measured = tube.finding == picture::RimFinding::kMeasured ||
                            tube.finding == picture::RimFinding::kPartly;
      if (measured && workspace_.rims.try_push_back(scan_rim_)) {
        tube.rim = workspace_.rims.size() - 1;
      }
      static_cast<void>(outcome_.tubes.try_push_back(tube));
    }
  }

  /// What the pose made of each tube-end.
  void tell_tubes() {
    for (PictureTube& tube : outcome_.tubes) {
      if (tube.rim >= 0 && tube.rim < outcome_.pose.rims.size()) {
        const RimVerdict& verdict = outcome_.pose.rims[tube.rim];
        tube.used = verdict.used;
        tube.u_px = verdict.center_px[0];
        tube.v_px = verdict.center_px[1];
      }
    }
  }

  const picture::AveragedPicture& picture_;
  const PoseModel& model_;
  const tubesheet::SheetMap& map_;
  std::span<const PictureStart> starts_;
  const PictureOptions& options_;
  PictureWorkspace& workspace_;
  PictureOutcome outcome_;
  WantedList wanted_;
  picture::RimOutline outline_;
  picture::Rim scan_rim_;
};

}  // namespace

PictureOutcome estimate_from_picture(const picture::AveragedPicture& picture,
                                     const PoseModel& model, const tubesheet::SheetMap& map,
                                     std::span<const PictureStart> starts,
                                     const PictureOptions& options, PictureWorkspace& workspace) {
  return PicturePose(picture, model, map, starts, options, workspace).run();
}

}  // namespace tubesight::core::pose
