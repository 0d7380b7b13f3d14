#include "board/bench/calibrate/base_text.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>

#include "board/bench/calibrate/calibration_file.h"
#include "core/math/covariance.h"
#include "drivers/files/decimal.h"
#include "drivers/settings/toml_writer.h"

namespace tubesight::board {
namespace {

using core::calibration::BaseCalibration;
using core::calibration::BaseRefusal;
using core::calibration::BaseVerdict;
using core::calibration::PairOutcome;

constexpr double kDegrees = 180.0 / std::numbers::pi;

void append_pose(std::string& text, const BaseReport& report) {
  const BaseCalibration& base = report.base;
  const auto& v = base.values;
  const auto sigma = [&](int i) { return core::math::sigma_of(base.covariance, i); };
  drivers::print(text, "  position              x %.3f  y %.3f  z %.3f mm\n", v(0), v(1), v(2));
  drivers::print(text, "    one sigma             %.3f  %.3f  %.3f mm\n", sigma(0), sigma(1),
                 sigma(2));
  drivers::print(text, "  rotation              alpha %.4f  beta %.4f  gamma %.4f deg\n", v(3),
                 v(4), v(5));
  drivers::print(text, "    one sigma             %.4f  %.4f  %.4f deg%s\n", sigma(3), sigma(4),
                 sigma(5), report.knowledge.level ? ", level as known beforehand" : "");
  const bool up = base.fit.pose.T_sheet_base.rotation()(2, 2) > 0.0;
  drivers::print(text, "  its z axis            points %s the sheet", up ? "to" : "away from");
  if (base.lean_sigma_rad > 0.0) {
    drivers::print(text, ", leans %.3f +- %.3f deg by the pairs", base.lean_rad * kDegrees,
                   base.lean_sigma_rad * kDegrees);
  }
  text += '\n';
  if (base.fit.turn_sigma_rad > 0.0) {
    const auto& X = base.fit.pose.X;
    drivers::print(text, "  turn of the tool      %.4f +- %.4f deg, from the robot's to vision's\n",
                   kDegrees * std::atan2(X(1, 0), X(0, 0)), base.fit.turn_sigma_rad * kDegrees);
  }
  drivers::print(text,
                 "  the robot's scatter   %.3f mm across, %.3f mm along the tool, %.4f deg; one "
                 "sigma an axis\n",
                 base.fit.scatter.across_mm, base.fit.scatter.along_mm,
                 base.fit.scatter.turn_rad * kDegrees);
}

void append_pair(std::string& text, const BaseReport& report, std::int32_t i) {
  const PairOutcome& outcome = report.outcomes[i];
  const auto& d = outcome.place_mm;
  drivers::print(text, "  pair %-16s dx %.3f  dy %.3f  dz %.3f mm",
                 report.names[static_cast<std::size_t>(i)].substr(0, 60).c_str(), d.x(), d.y(),
                 d.z());
  if (report.pairs[i].turned) {
    drivers::print(text, "  turned %.4f deg", outcome.turn_rad.norm() * kDegrees);
  }
  text += outcome.outlier        ? ": does not fit, left out\n"
          : !report.pairs[i].use ? ": compared only\n"
                                 : "\n";
}

/// One heading: an offset of the tool's tip would be in the base, and nothing would show it.
bool has_one_heading(const BaseReport& report) {
  constexpr double kSame = 0.98;  // 11 degrees
  const core::calibration::BasePair* first = nullptr;
  for (const core::calibration::BasePair& pair : report.pairs) {
    if (!pair.turned) {
      continue;
    }
    first = first == nullptr ? &pair : first;
    const Eigen::Vector3d x = pair.T_base_tool.rotation().col(0);
    if (x.dot(first->T_base_tool.rotation().col(0)) < kSame) {
      return false;
    }
  }
  return true;
}

}  // namespace

std::string_view use_of(BaseVerdict verdict) {
  switch (verdict) {
    case BaseVerdict::kCalibration:
      return "base calibration: the base puts the tool within 0.5 mm (one sigma) everywhere";
    case BaseVerdict::kPositioning:
      return "positioning: the base puts the tool within 1.25 mm (one sigma) everywhere";
    case BaseVerdict::kZones: return "positioning near the pairs; more pairs elsewhere are wanted";
  }
  return "";
}

std::string base_text(const BaseReport& report) {
  const BaseCalibration& base = report.base;
  std::string text;
  drivers::print(text, "base from %d pairs", base.used);
  if (base.outliers > 0) {
    drivers::print(text, ", %d left out", base.outliers);
  }
  text += '\n';
  append_pose(text, report);
  for (std::int32_t i = 0; i < report.outcomes.size(); ++i) {
    append_pair(text, report, i);
  }
  if (has_one_heading(report)) {
    text +=
        "  one heading           or none told: an offset of the tool's tip would be in the base "
        "unseen\n";
  }
  drivers::print(text,
                 "  tool over the sheet   across %.3f mm RMS (one sigma), %.3f mm at (%.0f, %.0f); "
                 "along %.3f mm RMS, %.3f mm at worst\n",
                 base.mean.across_mm, base.worst.across_mm, base.worst_mm_at.x(),
                 base.worst_mm_at.y(), base.mean.along_mm, base.worst.along_mm);
  const double scatter = base.fit.scatter.across_mm;
  drivers::print(text, "    with the scatter      across %.3f mm RMS\n",
                 std::sqrt(base.mean.across_mm * base.mean.across_mm + 2.0 * scatter * scatter));
  drivers::print(text,
                 "  next                  a pair at (%.0f, %.0f) would bring that to %.3f mm RMS, "
                 "%.3f mm at worst\n",
                 report.next.at_mm.x(), report.next.at_mm.y(), report.next.mean.across_mm,
                 report.next.worst.across_mm);
  text += "  good for              ";
  text += use_of(base.verdict);
  return text + "\n";
}

std::string why_no_base(const BaseCalibration& base, std::string_view generator) {
  std::string why = "no base: ";
  switch (base.refusal) {
    case BaseRefusal::kNone: break;
    case BaseRefusal::kTooFew:
      why += "fewer than three pairs are in use, expected three or more";
      break;
    case BaseRefusal::kOnePlace:
      why +=
          "all pairs stand at one place, which does not tell how the base is turned, expected "
          "places in different parts of the generator";
      break;
    case BaseRefusal::kCollinear:
      why +=
          "all places are in one line and have no angles, which does not tell how the base "
          "leans or which way up it is, expected one beside it";
      break;
    case BaseRefusal::kOtherUnit:
      drivers::print(why,
                     "distances by vision are %.4g times those of the robot, expected millimetres "
                     "in both",
                     base.scale);
      break;
    case BaseRefusal::kContradiction:
      drivers::print(why,
                     "the pairs contradict each other, most by some %.1f mm, expected the same "
                     "base for all but a few",
                     base.worst_mm > 0.0 ? base.worst_mm : base.fit.scatter.across_mm);
      break;
    case BaseRefusal::kTurnContradiction:
      why +=
          "the places fit one base and the angles do not, expected alpha, beta, gamma of both "
          "poses in degrees, and the tool's z axis towards the sheet in both";
      break;
    case BaseRefusal::kNotLevel:
      drivers::print(why,
                     "the pairs say that the base leans by %.2f deg, expected a level one, or "
                     "no --level",
                     base.lean_rad * kDegrees);
      break;
    case BaseRefusal::kVague:
      drivers::print(why,
                     "the tool would be known to %.1f mm only at (%.0f, %.0f) of %.*s, expected 5 "
                     "mm at most; pairs farther apart are wanted",
                     base.worst.across_mm, base.worst_mm_at.x(), base.worst_mm_at.y(),
                     static_cast<int>(generator.size()), generator.data());
      break;
  }
  return why;
}

std::string base_settings(const BaseReport& report) {
  drivers::TomlWriter toml(drivers::TomlManner::kPlain);
  std::array<double, 3> position{};
  std::array<double, 3> rotation{};
  for (int i = 0; i < 3; ++i) {
    position[static_cast<std::size_t>(i)] = report.base.values(i);
    rotation[static_cast<std::size_t>(i)] = report.base.values(i + 3);
  }
  toml.table("base");
  toml.numbers("position_mm", position);
  toml.numbers("rotation_deg", rotation);
  std::string verdict;
  drivers::print(verdict, "%d pairs, %d left out; %s", report.base.used, report.base.outliers,
                 std::string(use_of(report.base.verdict)).c_str());
  return with_quality(toml.take(), {"base_quality", report.base.covariance, verdict, {}, {}});
}

}  // namespace tubesight::board
