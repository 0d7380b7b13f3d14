#pragma once

#include <optional>

#include "core/base/field.h"
#include "core/base/scalar.h"
#include "core/base/sighting.h"
#include "core/tracking/candidates.h"
#include "core/tracking/doubt.h"
#include "core/tracking/field_clock.h"
#include "core/tracking/field_order_watch.h"
#include "core/tracking/field_report.h"
#include "core/tracking/last_place.h"
#include "core/tracking/map_watch.h"
#include "core/tracking/margin_policy.h"
#include "core/tracking/motion.h"
#include "core/tracking/old_picture_watch.h"
#include "core/tracking/primary_tube.h"
#include "core/tracking/refuted_motion.h"
#include "core/tracking/sheet_observer.h"
#include "core/tracking/sheet_pose.h"
#include "core/tracking/site_memory.h"
#include "core/tracking/start.h"
#include "core/tracking/tool_gate.h"
#include "core/tracking/tracking_model.h"
#include "core/tubesheet/sheet_map.h"

namespace tubesight::core::tracking {

/// Follows the tubesheet from field to field and names the tube above the guidetube [Fallon ch. 6].
///
/// Each field is told by the clock, predicted by the motion, looked at by the observer, let in by
/// the gate, and then believed, doubted or passed over (coasted) until the track is lost. An
/// address is never guessed: it carries over by rounding to the lattice, and only while the region
/// that the tool can have reached stays within 0.4 of the shortest lattice step; see docs.
///
/// One thread; no heap, no clock; the same inputs leave the same bytes on every machine in fixed
/// point. `model` and `map` outlive the tracker and do not change. `Margin` is MarginChecked, but
/// in the campaign's self-proof.
template <Scalar S, typename Margin = MarginChecked>
class Tracker {
 public:
  Tracker(const TrackingModel<S>& model, const tubesheet::SheetMap& map)
      : model_(&model),
        map_(&map),
        gate_(model),
        refuted_(model),
        order_(model),
        observer_(model, map) {}

  /// Takes clicks made in the field that the next step() gets; a running track is given up, unless
  /// they put the tool where it cannot have come since it was seen last: then the start is refused
  /// and all else goes on, until somebody insists (`confirmed`).
  void request_start(const StartClickList& clicks, bool confirmed = false) {
    clicks_ = clicks;
    confirmed_ = confirmed;
  }

  /// Processes one field. Costs some 20,000 instructions a tube-end in view.
  void step(const Field& field, Sighting& sighting, TubeSightingList& tubes);

  /// Ends the track after a step for a reason that the picture alone does not show, and tells of
  /// the field anew.
  void give_up(Reason reason, const Field& field, Sighting& sighting, TubeSightingList& tubes) {
    lose(reason);
    report(field, sighting, tubes);
  }

  /// Why the last start was refused.
  [[nodiscard]] StartRefusal start_refusal() const { return start_answer_.refusal; }
  /// The click to blame for it; -1: none alone is.
  [[nodiscard]] std::int32_t refused_click() const { return start_answer_.click; }

  /// Where every tube of the window is expected after the last step() [Fallon 6.1]; empty unless
  /// tracking.
  void list_estimates(CandidateList<S>& estimates) const;

  /// Image of a tube's centre after the last step(); false unless tracking and projectable.
  [[nodiscard]] bool locate(TubeAddress address, ImagePoint& pixel) const;

  /// How the sheet stood in the last step(): as fitted, or as predicted while coasting. Valid while
  /// tracking or degraded.
  [[nodiscard]] const SheetPose<S>& shown() const { return shown_.pose; }

  /// The members of the state; see core/base/state_stream.h. Model and map are the settings'.
  template <typename Self, typename Stream>
  static void transfer(Self& self, Stream& stream) {
    auto& [model, map, state, reason, clicks, start_answer, good, motion, shown, judged, primary,
           clock, gate, doubts, refuted, old_pictures, order, observer, last_place, map_watch,
           sites, confirmed] = self;
    stream.choice(state, TrackState::kLost);
    stream.choice(reason, kLastReason);
    stream(clicks, start_answer);
    stream(good, motion, shown, judged, primary, clock, gate, doubts, refuted, old_pictures, order,
           observer, last_place, map_watch, sites, confirmed);
  }

 private:
  [[nodiscard]] bool knows_place() const {
    return state_ == TrackState::kTracking || state_ == TrackState::kDegraded;
  }
  [[nodiscard]] bool coasts() const;
  [[nodiscard]] bool starts(const Field& field);
  void start(const Field& field, StartSearch<S>& search);
  void follow(const Field& field);
  void follow_unchecked(const Field& field);  ///< is defined in the self-proof alone
  [[nodiscard]] bool shows_old_picture(const Field& field);
  [[nodiscard]] Reason gate(const Observation<S>& seen, const SheetPose<S>& predicted,
                            Unit<S> span_s) const;
  void accept(const Observation<S>& seen, const Field& field);
  void watch_map();
  void remember_sites();
  void judge(const Observation<S>& seen);
  void reanchor();
  void doubt(Reason reason, const Field& field, const SheetPose<S>& predicted,
             const Observation<S>& seen);
  [[nodiscard]] bool is_jump(const Field& field, const SheetPose<S>& predicted,
                             const Observation<S>& seen);
  [[nodiscard]] bool doubts() const { return doubt_.lasts() || refuted_.undecided(); }
  void coast(Reason reason, const SheetPose<S>& predicted);
  void lose(Reason reason);
  void report(const Field& field, Sighting& sighting, TubeSightingList& tubes) const;

  const TrackingModel<S>* model_;
  const tubesheet::SheetMap* map_;

  TrackState state_ = TrackState::kWaiting;
  Reason reason_ = Reason::kNoStart;
  std::optional<StartClickList> clicks_;  ///< of a start with the next field
  StartAnswer start_answer_{};

  Observation<S> good_{};  ///< of the last field that was believed
  Motion<S> motion_{};     ///< between the last two of those
  Place<S> shown_{};       ///< of this field: fitted, or predicted while coasting
  bool judged_ = false;    ///< this field was believed
  PrimaryTube primary_{};

  FieldClock clock_{};
  ToolGate<S> gate_;
  Doubt doubt_{};
  RefutedMotion<S> refuted_;
  OldPictureWatch old_pictures_{};
  FieldOrderWatch<S> order_;
  SheetObserver<S> observer_;
  LastPlace<S> last_place_{};
  MapWatch map_watch_{};
  SiteMemory sites_{};
  bool confirmed_ = false;  ///< somebody insists on `clicks_`
};

}  // namespace tubesight::core::tracking
