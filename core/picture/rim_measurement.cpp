#include "core/picture/rim_measurement.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Core>

#include "core/picture/rim_in_shade.h"

namespace tubesight::core::picture {
namespace {

/// An edge found at one piece of the outline.
struct Finding {
  double offset_px = 0.0;
  double sigma_px = 0.0;
  double contrast = 0.0;
  std::int32_t arc = 0;
  bool used = true;
};
using Findings = StaticVector<Finding, kMaxRimPoints>;

constexpr std::int32_t kShape = 5;  // shift, growth, and the two ways of an ellipse
using ShapeRow = Eigen::Matrix<double, kShape, 1>;
using ShapeNormal = Eigen::Matrix<double, kShape, kShape>;

ShapeRow shape_row(const OutlineArc& arc) {
  const double c2 = arc.normal_u * arc.normal_u - arc.normal_v * arc.normal_v;
  const double s2 = 2.0 * arc.normal_u * arc.normal_v;
  ShapeRow row;
  row << 1.0, arc.normal_u, arc.normal_v, c2, s2;
  return row;
}

// An edge's deviation from its rim's form; one that is known far worse counts less.
constexpr double kTypical_px = 0.06;

/// Fits shift, growth and form to the edges in use. The form is held near zero, so that a short
/// arc does not make one up.
ShapeRow fit_shape(const RimOutline& outline, const Findings& findings) {
  ShapeNormal normal = ShapeNormal::Zero();
  ShapeRow right = ShapeRow::Zero();
  for (const Finding& finding : findings) {
    if (finding.used) {
      const ShapeRow row = shape_row(outline.arcs[finding.arc]);
      const double weight = 1.0 / (1.0 + std::pow(finding.sigma_px / kTypical_px, 2));
      normal += weight * row * row.transpose();
      right += weight * finding.offset_px * row;
    }
  }
  constexpr double kHold = 0.3;
  normal.diagonal() += (ShapeRow() << kHold, kHold, kHold, 4.0, 4.0).finished();
  return normal.ldlt().solve(right);
}

// Grown by so much beyond the scatter an edge is not the tube-end's.
constexpr double kLeastGate_px = 0.2;
constexpr double kMostGate_px = 1.0;

/// Half the offsets are nearer to the shape than this.
double median_off(const RimOutline& outline, const Findings& findings, const ShapeRow& shape) {
  std::array<double, kMaxRimPoints> off{};
  std::size_t count = 0;
  for (const Finding& finding : findings) {
    if (finding.used) {
      off[count++] = std::abs(finding.offset_px - shape.dot(shape_row(outline.arcs[finding.arc])));
    }
  }
  if (count == 0) {
    return 0.0;
  }
  auto* const middle = off.data() + count / 2;
  std::nth_element(off.data(), middle, off.data() + count);
  return *middle;
}

/// Marks what does not agree with the others; says whether enough did.
void reject_strangers(const RimOutline& outline, Findings& findings) {
  constexpr int kRounds = 6;
  for (int round = 0; round < kRounds; ++round) {
    const ShapeRow shape = fit_shape(outline, findings);
    const double gate =
        std::clamp(4.5 * median_off(outline, findings, shape), kLeastGate_px, kMostGate_px);
    bool changed = false;
    for (Finding& finding : findings) {
      const double off =
          std::abs(finding.offset_px - shape.dot(shape_row(outline.arcs[finding.arc])));
      const bool use = off <= std::max(gate, 4.0 * finding.sigma_px);
      changed = changed || use != finding.used;
      finding.used = use;
    }
    if (!changed) {
      break;
    }
  }
}

std::int32_t count_used(const Findings& findings) {
  return static_cast<std::int32_t>(std::count_if(
      findings.begin(), findings.end(), [](const Finding& finding) { return finding.used; }));
}

/// Whether the inside of the outline is as bright as its outside: mean levels at half the way to
/// the outline and as far outside it.
bool is_bright(const AveragedPicture& picture, const RimOutline& outline,
               const RimDarkness& darkness) {
  double inside = 0.0;
  double outside = 0.0;
  double count = 0.0;
  for (const OutlineArc& arc : outline.arcs) {
    const auto level = [&](double share, double& sum) {
      const double u = outline.center_u_px + share * (arc.u_px - outline.center_u_px);
      const double v = outline.center_v_px + share * (arc.v_px - outline.center_v_px);
      if (u < 0.0 || v < 0.0 || u > picture.width_px - 1.0 || v > picture.height_px - 1.0) {
        return false;
      }
      sum += picture.at(static_cast<std::int32_t>(u + 0.5), static_cast<std::int32_t>(v + 0.5));
      return true;
    };
    double in = 0.0;
    double out = 0.0;
    if (level(0.6, in) && level(1.15, out)) {
      inside += in;
      outside += out;
      count += 1.0;
    }
  }
  const double black = darkness.black_grey * kGreyScale * count;
  return count > 0.0 && inside - black > darkness.most_inside * (outside - black);
}

}  // namespace

RimFinding measure_rim(const AveragedPicture& picture, const RimOutline& outline,
                       const RimMeasureOptions& options, Rim& rim) {
  return measure_rim_in_shade(picture, outline, options, {}, rim);
}

RimFinding measure_rim_in_shade(const AveragedPicture& picture, const RimOutline& outline,
                                const RimMeasureOptions& options, const RimDarkness& darkness,
                                Rim& rim) {
  rim.points.clear();
  if (std::min(outline.half_width_px, outline.half_height_px) < options.least_half_px) {
    return RimFinding::kTooSmall;
  }
  Findings findings;
  std::int32_t outside = 0;
  for (std::int32_t i = 0; i < outline.arcs.size(); ++i) {
    const ArcEdge edge = find_arc_edge(picture, outline.arcs[i], options.edge);
    outside += edge.refusal == ArcRefusal::kOutside ? 1 : 0;
    if (edge.refusal == ArcRefusal::kNone) {
      static_cast<void>(findings.try_push_back(
          {edge.offset_px, edge.sigma_px, edge.bright - edge.dark, i, true}));
    }
  }
  const std::int32_t all = outline.arcs.size();
  const auto least = std::max(options.least_points,
                              static_cast<std::int32_t>(std::ceil(options.least_share * all)));
  if (all - outside < least) {
    return RimFinding::kOutside;
  }
  if (is_bright(picture, outline, darkness)) {
    return RimFinding::kBright;
  }
  if (findings.size() < std::max(least, (all - outside) / 3)) {
    return RimFinding::kNoEdge;
  }
  reject_strangers(outline, findings);
  if (count_used(findings) < std::max(least, findings.size() / 2)) {
    return RimFinding::kOutOfShape;
  }
  for (const Finding& finding : findings) {
    if (finding.used) {
      const OutlineArc& arc = outline.arcs[finding.arc];
      static_cast<void>(rim.points.try_push_back({arc.u_px + finding.offset_px * arc.normal_u,
                                                  arc.v_px + finding.offset_px * arc.normal_v,
                                                  arc.normal_u, arc.normal_v, finding.sigma_px}));
    }
  }
  return rim.points.size() * 10 >= all * 8 ? RimFinding::kMeasured : RimFinding::kPartly;
}

}  // namespace tubesight::core::picture
