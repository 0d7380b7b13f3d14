#include "board/bench/calibrate/zones_command.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string_view>
#include <system_error>
#include <vector>

#include "board/bench/calibrate/base_pairs_file.h"
#include "board/bench/calibrate/calibration_file.h"
#include "board/bench/calibrate/plan_picture.h"
#include "board/bench/calibrate/zones_file.h"
#include "board/bench/output/output_paths.h"
#include "board/bench/output/text_output.h"
#include "core/calibration/zone_field.h"
#include "drivers/files/decimal.h"
#include "drivers/settings/base_settings.h"

namespace tubesight::board {
namespace {

using core::calibration::kZoneContradiction;
using core::calibration::ZoneCorrection;
using core::calibration::ZonePoint;
using core::calibration::ZoneShape;

// A base leaves the tool within 5 mm "over the entire generator" [Fallon sec. 5.3]; what is more is
// another tube or another base.
constexpr double kMostZone_mm = 5.0;
// How well a robot comes back to a place: its backlash [docs/kinematics.md].
constexpr double kRepeat_mm = 0.1;

std::string_view name_of(ZoneShape shape) {
  switch (shape) {
    case ZoneShape::kExponential: return "exponential";
    case ZoneShape::kMatern: return "Matern 3/2";
    case ZoneShape::kGaussian: return "Gaussian";
  }
  return "";
}

/// One run of the command; on the heap, as field and pairs are large.
class ZonesRun {
 public:
  explicit ZonesRun(const CalibrateZonesOptions& options) : options_(options) {}

  ExitStatus run() {
    if (!open()) {
      return ExitStatus::kWrongInput;
    }
    if (!take_new() || !agree()) {
      return ExitStatus::kJobFailed;
    }
    tell_field();
    if (!write_out(text_)) {
      return ExitStatus::kJobFailed;
    }
    std::string message;
    if (!options_.picture.empty() && !draw(message)) {
      tell(message);
      return ExitStatus::kJobFailed;
    }
    return options_.out.empty() || write_settings(options_.out, zones_text(points_))
               ? ExitStatus::kDone
               : ExitStatus::kJobFailed;
  }

 private:
  bool open() {
    if (options_.base.empty()) {
      tell("--base: is missing, expected a settings file with the [base] that is corrected");
      return false;
    }
    const std::string clash = find_clash(
        std::array{NamedPath{"the pairs", options_.pairs}, NamedPath{"--base", options_.base}},
        std::array{NamedPath{"--out", options_.out}, NamedPath{"--picture", options_.picture}});
    if (!clash.empty()) {
      tell(clash);
      return false;
    }
    std::vector<std::string> messages;
    drivers::BaseSettings base;
    bool good = read_base_pairs(options_.pairs, pairs_, messages);
    good = static_cast<bool>(drivers::load_base_settings(options_.base, base, messages)) && good;
    std::error_code error;
    if (!options_.out.empty() && std::filesystem::exists(options_.out, error)) {
      good = read_zones(options_.out, points_, messages) && good;
    }
    tell(messages);
    if (good) {
      tell_more(options_.pairs + ": read, " + std::to_string(pairs_.pairs.size()) + " pairs");
    }
    old_ = points_.size();
    T_sheet_base_ = {
        core::rotation_from_degrees(base.rotation_deg),
        Eigen::Vector3d(base.position_mm[0], base.position_mm[1], base.position_mm[2])};
    return good;
  }

  bool refuse(const std::string& why) {
    tell(options_.pairs + ": no zones: " + why);
    return false;
  }

  bool take_new() {
    if (old_ > 0) {
      field_.choose(points_);
    }
    for (std::int32_t i = 0; i < pairs_.pairs.size(); ++i) {
      const auto& pair = pairs_.pairs[i];
      if (!pair.use) {
        continue;
      }
      const Eigen::Vector3d place = pair.T_sheet_tool.translation_mm();
      ZonePoint point;
      point.at_mm = place.head<2>();
      point.off_mm = place - T_sheet_base_ * pair.T_base_tool.translation_mm();
      point.sigma_mm = std::hypot(kRepeat_mm, pair.sigma_mm.maxCoeff());
      const std::string& name = pairs_.names[static_cast<std::size_t>(i)];
      std::string why;
      if (point.off_mm.norm() > kMostZone_mm) {
        drivers::print(why,
                       "pair %s is %.1f mm off the base, expected %.0f mm at most; a wrong "
                       "tube, or another base",
                       name.c_str(), point.off_mm.norm(), kMostZone_mm);
        return refuse(why);
      }
      if (old_ > 0 && field_.contradiction(point) > kZoneContradiction) {
        const ZoneCorrection said = field_.at(point.at_mm);
        drivers::print(why,
                       "pair %s has dx %.2f  dy %.2f  dz %.2f mm where the corrections so far say "
                       "%.2f, %.2f, %.2f +- %.2f mm, expected the two to agree",
                       name.c_str(), point.off_mm.x(), point.off_mm.y(), point.off_mm.z(),
                       said.off_mm.x(), said.off_mm.y(), said.off_mm.z(), said.across_mm);
        return refuse(why);
      }
      if (!points_.try_push_back(point)) {
        drivers::print(why, "more than %d corrections, expected at most that many",
                       core::calibration::kMaxZones);
        return refuse(why);
      }
      new_names_.push_back(name);
    }
    return new_names_.empty() ? refuse("no pair is in use, expected one at least") : true;
  }

  /// The new ones with all others.
  bool agree() {
    field_.choose(points_);
    for (std::int32_t i = old_; i < points_.size(); ++i) {
      if (field_.contradiction(i) > kZoneContradiction) {
        return refuse("pair " + new_names_[static_cast<std::size_t>(i - old_)] +
                      " contradicts the others around it, expected errors that change slowly "
                      "from place to place");
      }
    }
    return true;
  }

  void tell_field() {
    drivers::print(text_, "corrections at %d places, %d of them new\n", points_.size(),
                   points_.size() - old_);
    const std::string_view shape = name_of(field_.shape());
    drivers::print(text_,
                   "  between them          %.*s, %.0f mm long; %.2f mm across, %.2f mm along (one "
                   "sigma, as the places make most likely)\n",
                   static_cast<int>(shape.size()), shape.data(), field_.length_mm(),
                   field_.across_mm(), field_.along_mm());
    for (std::int32_t i = old_; i < points_.size(); ++i) {
      const ZonePoint& point = points_[i];
      const ZoneCorrection here = field_.at(point.at_mm);
      drivers::print(text_,
                     "  %-16s seen dx %.3f  dy %.3f  dz %.3f +- %.3f mm; corrected by %.3f, %.3f, "
                     "%.3f +- %.3f mm\n",
                     new_names_[static_cast<std::size_t>(i - old_)].c_str(), point.off_mm.x(),
                     point.off_mm.y(), point.off_mm.z(), point.sigma_mm, here.off_mm.x(),
                     here.off_mm.y(), here.off_mm.z(), here.across_mm);
    }
  }

  bool draw(std::string& message) const {
    constexpr int kSteps = 24;
    constexpr double kBeyond_mm = 200.0;
    Eigen::Vector2d least = points_[0].at_mm;
    Eigen::Vector2d most = least;
    for (const ZonePoint& point : points_) {
      least = least.cwiseMin(point.at_mm);
      most = most.cwiseMax(point.at_mm);
    }
    least.array() -= kBeyond_mm;
    most.array() += kBeyond_mm;
    const double step = (most - least).maxCoeff() / kSteps;
    PlanPicture picture;
    for (double x = least.x(); x <= most.x() + 0.5 * step; x += step) {
      for (double y = least.y(); y <= most.y() + 0.5 * step; y += step) {
        const ZoneCorrection here = field_.at({x, y});
        picture.places.push_back({{x, y}, here.across_mm, here.off_mm.head<2>()});
      }
    }
    for (std::int32_t i = 0; i < points_.size(); ++i) {
      const std::string name =
          i < old_ ? std::string() : new_names_[static_cast<std::size_t>(i - old_)];
      picture.marks.push_back({i < old_ ? PlanMark::kCompared : PlanMark::kPair, points_[i].at_mm,
                               points_[i].off_mm.head<2>(), name});
    }
    picture.caption = {"corrections over the sheet, 200 times as long as they are",
                       "green: known exactly, red: 1.25 mm (one sigma) and more",
                       "yellow: new places, grey: those before"};
    return write_plan(options_.picture, picture, message);
  }

  const CalibrateZonesOptions& options_;
  NamedPairs pairs_;
  core::Transform<core::frames::Sheet, core::frames::Base> T_sheet_base_;
  core::calibration::ZonePoints points_;
  std::int32_t old_ = 0;  ///< how many of them were there before
  std::vector<std::string> new_names_;
  core::calibration::ZoneField field_;
  std::string text_;
};

}  // namespace

ExitStatus run_calibrate_zones(const CalibrateZonesOptions& options) {
  return std::make_unique<ZonesRun>(options)->run();
}

}  // namespace tubesight::board
