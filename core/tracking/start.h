#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/base/image_view.h"
#include "core/base/reply.h"
#include "core/base/scalar.h"
#include "core/base/settings.h"
#include "core/tracking/clicked_tube.h"
#include "core/tracking/field_measurement.h"
#include "core/tracking/sheet_pose.h"
#include "core/tracking/tracking_model.h"
#include "core/tubesheet/sheet_map.h"

namespace tubesight::core::tracking {

using core::StartRefusal;

/// A click as the path takes it: address and full-frame position in 1/65536 px.
struct StartClick {
  TubeAddress address{};
  std::int32_t u_q16 = 0;
  std::int32_t v_q16 = 0;

  /// The members of the state; see core/base/state_stream.h.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [tube, u, v] = self;
    stream(tube, u, v);
  }
};

/// What became of a start.
struct StartAnswer {
  StartRefusal refusal = StartRefusal::kNone;
  std::int32_t click = -1;  ///< the one to blame, as listed; -1: none alone is

  // Most refusals blame no click.
  StartAnswer() = default;
  // NOLINTNEXTLINE(google-explicit-constructor)
  StartAnswer(StartRefusal why, std::int32_t by = -1) : refusal(why), click(by) {}

  [[nodiscard]] bool taken() const { return refusal == StartRefusal::kNone; }

  /// The members of the state; see core/base/state_stream.h.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [why, by] = self;
    stream.choice(why, kLastStartRefusal);
    stream.number(by, -1, std::int32_t{kMaxStartPoints});
  }
};

using StartClickList = StaticVector<StartClick, kMaxStartPoints>;

/// Finds the pose from an operator's rough clicks in one field [Fallon 6.1].
///
/// Each click's tube-end is found by `search`; their centres on the virtual plane give heading,
/// height and place of a level sheet, whose handedness and residual refute wrong addresses. The
/// caller's fit on the whole window then confirms it. `pose` is written on kNone only, and then
/// `light` knows how dark tube-ends are, where they were looked for as circles.
template <Scalar S>
[[nodiscard]] StartAnswer find_start_pose(const TrackingModel<S>& model,
                                          const tubesheet::SheetMap& map, const FieldView& field,
                                          const StartClickList& clicks, ClickSearch search,
                                          LightLevels& light, SheetPose<S>& pose);

/// The clicks of one start in one field, and what either search makes of them: each is done once,
/// whoever asks. All that it is made of outlives it.
template <Scalar S>
class StartSearch {
 public:
  StartSearch(const TrackingModel<S>& model, const tubesheet::SheetMap& map, const FieldView& field,
              const StartClickList& clicks)
      : model_(&model), map_(&map), field_(&field), clicks_(&clicks) {}

  /// What find_start_pose() finds.
  struct Found {
    StartAnswer answer{};
    SheetPose<S> pose{};      ///< valid when taken
    LightLevels light{};      ///< the first, and how dark the clicked tube-ends are
    bool overflowed = false;  ///< a number left its range
  };
  [[nodiscard]] const Found& by(ClickSearch search);

  [[nodiscard]] const TrackingModel<S>& model() const { return *model_; }
  [[nodiscard]] const FieldView& field() const { return *field_; }
  [[nodiscard]] const StartClickList& clicks() const { return *clicks_; }

 private:
  const TrackingModel<S>* model_;
  const tubesheet::SheetMap* map_;
  const FieldView* field_;
  const StartClickList* clicks_;
  std::array<std::optional<Found>, 2> found_{};  ///< by ClickSearch
};

}  // namespace tubesight::core::tracking
