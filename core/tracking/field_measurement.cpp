#include "core/tracking/field_measurement.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <utility>

#include "core/base/constant.h"
#include "core/base/instantiate.h"
#include "core/edges/dark_region.h"
#include "core/edges/edge_search.h"
#include "core/tracking/projection.h"
#include "core/tracking/rim_box.h"
#include "core/tracking/rim_outline.h"

namespace tubesight::core::tracking {
namespace {

// A quick look whether a rim will leave the window: a tilted circle's image still reaches over 0.45
// of its upright radius in every direction that a toolhead camera sees.
template <Scalar S>
bool cut_by_window(const TrackingModel<S>& model, const Vector2<Px<S>>& center, Mm<S> depth) {
  const Mm<S> px_per_mm = quotient<Mm<S>>(model.camera.parameters().scale_px.y, depth);
  const Mm<S> share = constant<Mm<S>>(0.45);
  const std::int32_t reach = rounded(times(times(model.bore_radius_mm, share), px_per_mm)) - 2;
  const std::int32_t u = rounded(center.x);
  const std::int32_t v = rounded(center.y);
  return u - reach < model.window.left || u + reach > model.window.right ||
         v - reach < model.window.top || v + reach > model.window.bottom;
}

// A plug's hole is narrower than the tube-end: a wide upper edge on fillet sheets, a shadow between
// rim and hole on flush ones [Fallon 6.5]. Both leave a dark region well below the rim's top.
bool is_plug_hole(const edges::DarkRegion& region, const RimBox& box) {
  if (!region.found) {
    return false;
  }
  const std::int32_t rim_height = 2 * box.half_v * 65536;
  const std::int32_t upper_edge = region.top_q16 - (box.v - box.half_v) * 65536;
  const bool narrow = region.width_q16() < 2 * box.half_u * 65536 / 4 * 3 &&
                      region.width_q16() > 2 * box.half_u * 65536 / 8;
  const bool inside = std::abs(region.center_u_q16() / 65536 - box.u) < box.half_u * 2 / 3 &&
                      std::abs(region.center_v_q16() / 65536 - box.v) < box.half_v;
  return narrow && inside && upper_edge > rim_height / 6;
}

constexpr std::int32_t kLeastHalfHeightPx = 7;

constexpr std::int32_t kNearlyAll = 13;  // of the pixels of a cross-hair

template <Scalar S>
MeasurementBounds bounds_of(const TrackingModel<S>& model) {
  MeasurementBounds bounds;
  bounds.thin_rim = model.weld == Weld::kFillet;
  bounds.taps = bounds.thin_rim ? edges::kFilletTaps : edges::kHorizontalTaps;
  return bounds;
}

// A site whose rim lies in the window, and is large enough to be measured.
template <Scalar S>
struct SiteInView {
  RimOutline<S> rim;
  RimBox box;
};

template <Scalar S>
std::optional<SiteInView<S>> in_view(const TrackingModel<S>& model, const SheetPose<S>& pose,
                                     const RimSpokes<S>& spokes, const Candidate<S>& site) {
  const Vector3<Mm<S>> center = pose.origin + pose.along(site.local);
  if (cut_by_window<S>(model, site.center_px, center.z)) {
    return std::nullopt;
  }
  const auto rim = project_rim<S>(model, center, spokes);
  if (!rim) {
    return std::nullopt;
  }
  const RimBox box = box_of<S>(*rim);
  if (box.half_v < kLeastHalfHeightPx) {
    return std::nullopt;
  }
  return SiteInView<S>{*rim, box};
}

// The mean of the sheet a fifth of the radius outside a rim.
template <Scalar S>
std::int32_t grey_around(const FieldView& field, const RimOutline<S>& rim) {
  std::int32_t sum = 0;
  for (const Vector2<Px<S>>& point : rim.points) {
    const auto outwards = [](Px<S> at, Px<S> middle) {
      return rounded(at) + (rounded(at) - rounded(middle)) / 5;
    };
    const std::int32_t u = outwards(point.x, rim.middle.x);
    const std::int32_t line =
        (outwards(point.y, rim.middle.y) - field.first_line) / field.line_step;
    sum += field.pixels[static_cast<std::ptrdiff_t>(std::clamp(line, 0, field.lines - 1)) *
                            field.stride_px +
                        std::clamp(u, 0, field.width_px - 1)];
  }
  return sum / kRimPoints;
}

// Whether a tube-end that was not measured is one grey value alone, a quarter of its radius beyond
// the rim, too.
bool is_blank(const FieldView& field, const RimBox& box) {
  return edges::look_at_cross_hair(field, box.u, box.v, box.half_u * 5 / 4, box.half_v * 5 / 4)
      .blank;
}

// Counts and lists a tube-end that was not measured. `blank`: one grey value, its rim and beyond;
// `flat`: as dark around as inside.
void note_site(TubeAddress address, Finding finding, bool blank, bool flat, FindingCount& count,
               SiteSightings& sites) {
  count.blank += blank ? 1 : 0;
  if (finding == Finding::kBright) {
    ++count.bright;
    count.bright_blank += blank ? 1 : 0;
    if (sites.bright.try_push_back(address) && blank) {
      sites.blank |= std::uint32_t{1} << (sites.bright.size() - 1);
    }
  }
  if (finding == Finding::kDisagrees) {
    ++count.disagreeing;
    if (sites.dark.try_push_back(address) && flat) {
      sites.flat |= std::uint32_t{1} << (sites.dark.size() - 1);
    }
  }
}

// What a tube-end that was not measured says about a plug.
template <Scalar S>
void note_plug(const FieldView& field, TubeAddress address, const Vector2<Px<S>>& center,
               const RimBox& box, const MeasurementBounds& look, Finding finding,
               FieldRecord<S>& record) {
  bool plug = finding == Finding::kBright;
  if (finding == Finding::kDisagrees) {
    edges::DynamicThreshold threshold = record.light.edge_threshold;
    plug = is_plug_hole(edges::find_dark_region(field, box.u, box.v, box.half_u + look.range_px,
                                                threshold, look.step_px),
                        box);
  }
  if (plug) {
    record.plugs.saw_plug(address);
  }
  if (record.plugs.is_plug(address)) {
    static_cast<void>(record.plugs_seen.try_push_back({address, center}));
  }
}

}  // namespace

template <Scalar S>
FindingCount measure_field(const TrackingModel<S>& model, const FieldView& field,
                           const SheetPose<S>& pose, const CandidateList<S>& candidates,
                           const LookRange& look, FieldRecord<S>& record) {
  FindingCount count;
  LightLevels& light = record.light;
  const RimSpokes<S> spokes = make_rim_spokes<S>(pose, model.bore_radius_mm);
  MeasurementBounds bounds = bounds_of<S>(model);
  count.next = look.first;
  while (count.next < look.end && record.measured.size() < look.enough) {
    const Candidate<S>& candidate = candidates[count.next++];
    if (candidate.state != TubeState::kOpen) {
      continue;
    }
    const auto seen = in_view<S>(model, pose, spokes, candidate);
    if (!seen) {
      continue;
    }
    const auto& [rim, box] = *seen;
    ++count.looked_at;
    TubeMeasurement<S> tube;
    tube.address = candidate.address;
    tube.local = candidate.local;
    tube.predicted_px = rim.center;
    const auto [inside, dark, still] = edges::look_at_cross_hair(
        field, box.u, box.v, box.half_u / 2, box.half_v / 2, light.region_threshold);
    Finding finding = Finding::kBright;
    bounds.step_px = reading_step<S>(model, box);
    // Specks spoil the mean, not the most of the pixels.
    if (inside <= light.region_threshold || dark >= kNearlyAll) {
      bounds.range_px = std::min(look.range_px, std::max(3, box.half_u / 2));
      finding = measure_tube<S>(field, rim, bounds, light.edge_threshold, tube);
    }
    if (finding == Finding::kMeasured) {
      ++count.measured;
      count.noisy += still ? 0 : 1;
      record.plugs.saw_open(candidate.address);
      static_cast<void>(record.measured.try_push_back(tube));
      // Midway between this tube-end's inside and its surroundings, followed slowly.
      const std::int32_t middle = inside + tube.contrast_q4 / 32;
      light.region_threshold += (middle - light.region_threshold) / 4;
      light.region_threshold = std::max(light.region_threshold, 16);
      continue;
    }
    const bool flat =
        finding == Finding::kDisagrees && grey_around<S>(field, rim) <= light.region_threshold;
    note_site(candidate.address, finding, still && is_blank(field, box), flat, count, record.sites);
    MeasurementBounds around = bounds;
    around.range_px = look.range_px;
    note_plug<S>(field, candidate.address, rim.center, box, around, finding, record);
  }
  return count;
}

template <Scalar S>
bool follow_darkness(const TrackingModel<S>& model, const FieldView& field,
                     const SheetPose<S>& pose, const CandidateList<S>& candidates,
                     LightLevels& light) {
  constexpr std::int32_t kMost = 12;
  constexpr std::int32_t kFewest = 3;
  constexpr std::int32_t kLeastContrast = 24;  // grey levels: less is a stain
  StaticVector<std::int32_t, kMost> inside;
  StaticVector<std::int32_t, kMost> around;
  const RimSpokes<S> spokes = make_rim_spokes<S>(pose, model.bore_radius_mm);
  for (const Candidate<S>& candidate : candidates) {
    if (inside.size() == kMost) {
      break;
    }
    const auto seen = in_view<S>(model, pose, spokes, candidate);
    if (candidate.state != TubeState::kOpen || !seen) {
      continue;
    }
    const auto& [rim, box] = *seen;
    static_cast<void>(inside.try_push_back(
        edges::cross_hair_mean(field, box.u, box.v, box.half_u / 2, box.half_v / 2)));
    static_cast<void>(around.try_push_back(grey_around<S>(field, rim)));
  }
  if (inside.size() < kFewest) {
    return false;
  }
  std::sort(inside.begin(), inside.end());
  std::sort(around.begin(), around.end());
  // Medians: plugs and bright spots are the fewer, or it is no other light.
  const std::int32_t dark = inside[inside.size() / 2];
  const std::int32_t bright = around[around.size() / 2];
  const std::int32_t midway = (dark + bright) / 2;
  if (bright - dark < std::max(kLeastContrast, bright / 4) || midway <= light.region_threshold) {
    return false;
  }
  light.region_threshold = midway;
  return true;
}

template <Scalar S>
void look_at_sites(const TrackingModel<S>& model, const FieldView& field, const SheetPose<S>& pose,
                   const SiteList<S>& closed, const LightLevels& light, SiteSightings& sites) {
  if (closed.empty()) {
    return;
  }
  const RimSpokes<S> spokes = make_rim_spokes<S>(pose, model.bore_radius_mm);
  MeasurementBounds bounds = bounds_of<S>(model);
  for (const Candidate<S>& site : closed) {
    const auto seen = in_view<S>(model, pose, spokes, site);
    if (!seen) {
      continue;
    }
    const auto& [rim, box] = *seen;
    if (edges::cross_hair_mean(field, box.u, box.v, box.half_u / 2, box.half_v / 2) >
        light.region_threshold) {
      static_cast<void>(sites.closed.try_push_back(site.address));
      continue;
    }
    edges::DynamicThreshold threshold = light.edge_threshold;
    bounds.step_px = reading_step<S>(model, box);
    TubeMeasurement<S> tube;
    tube.predicted_px = rim.center;
    if (measure_tube<S>(field, rim, bounds, threshold, tube) == Finding::kMeasured) {
      static_cast<void>(sites.open.try_push_back(site.address));
    }
  }
}

namespace {

// A tube-end found by bisection near its predicted place, as a shift over the sheet.
template <Scalar S>
std::optional<Vector2<Mm<S>>> shift_of(const TrackingModel<S>& model, const FieldView& field,
                                       const SheetPose<S>& pose, const Candidate<S>& candidate,
                                       const RimSpokes<S>& spokes, LightLevels& light) {
  const auto rim = project_rim<S>(model, pose.origin + pose.along(candidate.local), spokes);
  if (!rim) {
    return std::nullopt;
  }
  const RimBox box = box_of<S>(*rim);
  // The predicted place first, then places most of a radius around it: the small local search.
  constexpr std::array<std::array<std::int32_t, 2>, 9> kAround{
      {{0, 0}, {-1, 0}, {1, 0}, {0, -1}, {0, 1}, {-1, -1}, {1, -1}, {-1, 1}, {1, 1}}};
  for (const auto& [du, dv] : kAround) {
    const std::int32_t u = box.u + du * box.half_u * 3 / 4;
    const std::int32_t v = box.v + dv * box.half_v * 3 / 4;
    if (u < 0 || v < 0 || u >= field.width_px || v >= model.picture_height_px ||
        edges::cross_hair_mean(field, u, v, 4, 4) > light.region_threshold) {
      continue;
    }
    edges::DynamicThreshold threshold = light.edge_threshold;
    const auto region =
        edges::find_dark_region(field, u, v, std::max(box.half_u, box.half_v) * 2 + 4, threshold,
                                reading_step<S>(model, box));
    if (!region.found) {
      continue;
    }
    const std::int32_t width = region.width_q16() / 65536;
    const std::int32_t height = region.height_q16() / 65536;
    // The width-to-height ratio's precaution against shadows, against the predicted size.
    if (std::abs(width - 2 * box.half_u) > box.half_u / 2 + 2 ||
        std::abs(height - 2 * box.half_v) > box.half_v / 2 + 3) {
      continue;
    }
    const Vector2<Px<S>> center{from_scaled<Px<S>>(region.center_u_q16(), 16),
                                from_scaled<Px<S>>(region.center_v_q16(), 16)};
    const auto found = to_sheet<S>(model, pose, center);
    const auto expected = to_sheet<S>(model, pose, rim->middle);
    if (found && expected) {
      return *found - *expected;
    }
  }
  return std::nullopt;
}

template <typename M>
M median(std::array<M, 8> values, std::int32_t count) {
  // Eight at most: insertion.
  for (std::size_t i = 1; i < static_cast<std::size_t>(count); ++i) {
    for (std::size_t j = i; j > 0 && values[j] < values[j - 1]; --j) {
      std::swap(values[j], values[j - 1]);
    }
  }
  return values[static_cast<std::size_t>(count / 2)];
}

}  // namespace

template <Scalar S>
bool shift_onto_dark_regions(const TrackingModel<S>& model, const FieldView& field,
                             const CandidateList<S>& candidates, Mm<S> reach_mm, LightLevels& light,
                             SheetPose<S>& pose) {
  using M = Mm<S>;
  const RimSpokes<S> spokes = make_rim_spokes<S>(pose, model.bore_radius_mm);
  std::array<M, 8> x{};
  std::array<M, 8> y{};
  std::int32_t count = 0;
  std::int32_t looked_at = 0;
  for (const Candidate<S>& candidate : candidates) {
    if (count == 8 || looked_at == 16) {
      break;
    }
    if (candidate.state != TubeState::kOpen) {
      continue;
    }
    ++looked_at;
    if (const auto shift = shift_of<S>(model, field, pose, candidate, spokes, light)) {
      x[static_cast<std::size_t>(count)] = shift->x;
      y[static_cast<std::size_t>(count)] = shift->y;
      ++count;
    }
  }
  if (count < 2) {
    return false;
  }
  const Vector2<M> middle{median(x, count), median(y, count)};
  // A tenth of the lattice step: what bisection, lean and heading leave between tube-ends.
  const M near = times(model.lattice.parameters().shortest_step, constant<M>(0.1));
  std::int32_t agreeing = 0;
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    if (absolute(x[i] - middle.x) < near && absolute(y[i] - middle.y) < near) {
      ++agreeing;
    }
  }
  if (agreeing < 2 || 2 * agreeing < count || absolute(middle.x) > reach_mm ||
      absolute(middle.y) > reach_mm) {
    return false;
  }
  pose.origin = pose.origin + pose.along(middle);
  return true;
}

#define TUBESIGHT_INSTANTIATE(S)                                                                   \
  template FindingCount measure_field<S>(const TrackingModel<S>&, const FieldView&,                \
                                         const SheetPose<S>&, const CandidateList<S>&,             \
                                         const LookRange&, FieldRecord<S>&);                       \
  template bool follow_darkness<S>(const TrackingModel<S>&, const FieldView&, const SheetPose<S>&, \
                                   const CandidateList<S>&, LightLevels&);                         \
  template void look_at_sites<S>(const TrackingModel<S>&, const FieldView&, const SheetPose<S>&,   \
                                 const SiteList<S>&, const LightLevels&, SiteSightings&);          \
  template bool shift_onto_dark_regions<S>(const TrackingModel<S>&, const FieldView&,              \
                                           const CandidateList<S>&, Mm<S>, LightLevels&,           \
                                           SheetPose<S>&);
TUBESIGHT_FOR_EACH_SCALAR(TUBESIGHT_INSTANTIATE)
#undef TUBESIGHT_INSTANTIATE

}  // namespace tubesight::core::tracking
