#pragma once

#include <cstdint>

#include "core/base/image_view.h"
#include "core/base/scalar.h"
#include "core/edges/dynamic_threshold.h"
#include "core/tracking/candidates.h"
#include "core/tracking/plug_memory.h"
#include "core/tracking/pose_fit.h"
#include "core/tracking/sheet_pose.h"
#include "core/tracking/tracking_model.h"

namespace tubesight::core::tracking {

/// How the looks at all candidates of a field ended.
struct FindingCount {
  std::int32_t looked_at = 0;  ///< open tube-ends wholly inside the window
  std::int32_t measured = 0;
  std::int32_t bright = 0;  ///< no dark inside where one should be
  std::int32_t disagreeing = 0;
  std::int32_t noisy = 0;         ///< measured, and not one grey value inside
  std::int32_t blank = 0;         ///< not measured, and one grey value from inside to outside
  std::int32_t bright_blank = 0;  ///< of these, the bright ones
  std::int32_t next = 0;          ///< position of the first candidate not looked at

  FindingCount& operator+=(const FindingCount& other) {
    looked_at += other.looked_at;
    measured += other.measured;
    bright += other.bright;
    disagreeing += other.disagreeing;
    noisy += other.noisy;
    blank += other.blank;
    bright_blank += other.bright_blank;
    next = other.next;
    return *this;
  }
};

/// Light levels that the thresholds follow from field to field.
struct LightLevels {
  std::int32_t region_threshold = 60;  ///< a cross-hair's mean above this is sheet
  edges::DynamicThreshold edge_threshold{};

  /// The members of the state; see core/base/state_stream.h.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [region, edge] = self;
    stream.number(region, 0, 1 << 16);
    stream(edge);
  }
};

/// Those that a start begins with.
template <Scalar S>
[[nodiscard]] LightLevels first_light(const TrackingModel<S>& model) {
  LightLevels light{.edge_threshold = edges::DynamicThreshold(model.initial_threshold)};
  if (model.region_threshold > 0) {
    light.region_threshold = model.region_threshold;
  }
  return light;
}

/// A place of a recognised plug in this field.
template <Scalar S>
struct PlugSighting {
  TubeAddress address{};
  Vector2<Px<S>> center_px{};
};

template <Scalar S>
using PlugList = StaticVector<PlugSighting<S>, 64>;

/// What sites look like in this field against what the settings say of them; those that cannot be
/// told are in no list.
struct SiteSightings {
  using List = StaticVector<TubeAddress, 24>;

  List open;    ///< and should be closed
  List closed;  ///< as they should be
  List bright;  ///< and should be open tube-ends
  List dark;    ///< as they should be, but without a rim
  /// Bit n: bright[n] is one grey value from inside to outside.
  std::uint32_t blank = 0;
  std::uint32_t flat = 0;  ///< bit n: around dark[n] the sheet is as dark as inside it

  void clear() {
    open.clear();
    closed.clear();
    bright.clear();
    dark.clear();
    blank = 0;
    flat = 0;
  }
};

/// What measure_field() works on from call to call.
template <Scalar S>
struct FieldRecord {
  LightLevels light{};
  PlugMemory plugs{};
  PlugList<S> plugs_seen{};       ///< in this field
  MeasurementList<S> measured{};  ///< in this field
  SiteSightings sites{};          ///< in this field

  void begin_field() {
    plugs_seen.clear();
    measured.clear();
    sites.clear();
  }

  /// The members of the state; see core/base/state_stream.h. The last three are of one field.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [levels, plug_memory, seen, tubes, closed_sites] = self;
    stream(levels, plug_memory);
  }
};

/// Which candidates a call of measure_field() looks at, and how far around their rims.
struct LookRange {
  std::int32_t first = 0;  ///< position in the list
  std::int32_t end = 0;    ///< behind the last
  std::int32_t range_px = 3;
  std::int32_t enough = kMaxTubesInView;  ///< measured tube-ends in the record that end the call
};

/// Measures every usable tube-end among the candidates: verifies it by the cross-hair, measures its
/// rim, recognises plugs that no list names. Appends to the record.
///
/// Candidates' places are predicted anew by `pose`.
template <Scalar S>
[[nodiscard]] FindingCount measure_field(const TrackingModel<S>& model, const FieldView& field,
                                         const SheetPose<S>& pose,
                                         const CandidateList<S>& candidates, const LookRange& look,
                                         FieldRecord<S>& record);

/// Takes another light for granted when most of the tube-ends that should be open are clearly
/// darker than the sheet around them, though brighter than the threshold: a raised black level,
/// less contrast. `light` is changed on true only. For fields in which nothing was measured; looks
/// at the first twelve candidates in the window, some 1,500 instructions each.
template <Scalar S>
[[nodiscard]] bool follow_darkness(const TrackingModel<S>& model, const FieldView& field,
                                   const SheetPose<S>& pose, const CandidateList<S>& candidates,
                                   LightLevels& light);

/// Looks at sites that should be closed, with a pose that fits the field: `sites` gets what they
/// look like. An open tube-end is one that would be measured as such. Light is not followed. Some
/// 500 instructions for a closed one.
template <Scalar S>
void look_at_sites(const TrackingModel<S>& model, const FieldView& field, const SheetPose<S>& pose,
                   const SiteList<S>& closed, const LightLevels& light, SiteSightings& sites);

/// Shifts the predicted pose onto the tube-ends found by bisection from the predicted centres: for
/// predictions up to 0.4 of a lattice step off, when searches across predicted rims would not
/// reach.
///
/// Uses up to eight tube-ends nearest to the optimum point, which must agree. False when fewer than
/// two are found where `reach_mm` allows them.
template <Scalar S>
[[nodiscard]] bool shift_onto_dark_regions(const TrackingModel<S>& model, const FieldView& field,
                                           const CandidateList<S>& candidates, Mm<S> reach_mm,
                                           LightLevels& light, SheetPose<S>& pose);

}  // namespace tubesight::core::tracking
