#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>

#include "board/box/event_recorder.h"
#include "board/box/frame_view.h"
#include "board/box/journal_desk.h"
#include "board/box/overlay_news.h"
#include "board/box/overlay_snapshot.h"
#include "board/box/pair_desk.h"
#include "board/box/picture_tap.h"
#include "board/box/pose_desk.h"
#include "core/base/event.h"
#include "core/base/field.h"
#include "core/base/result.h"
#include "core/base/scalar.h"
#include "core/base/snapshot.h"
#include "core/lighting/lamp_policy.h"
#include "core/session/session.h"
#include "core/tracking/margin_policy.h"
#include "hal/clock.h"
#include "hal/dimmer.h"
#include "hal/frame_grabber.h"
#include "hal/lamp_history.h"
#include "hal/operator_station.h"
#include "hal/robot_link.h"

namespace tubesight::board {

/// What a box is connected to; null: it is not there. All outlive the loop.
struct BoxPorts {
  hal::FrameGrabber* grabber = nullptr;  ///< always there
  const hal::Clock* clock = nullptr;     ///< always there; stamps the grabber's fields
  hal::Dimmer* dimmer = nullptr;
  hal::RobotLink* link = nullptr;
  hal::OperatorStation* station = nullptr;
  const hal::LampHistory* lamp_history = nullptr;  ///< null: the dimmer's level is in force at once
};

/// What works beside the tracking; null: nobody needs it. All outlive the loop.
struct BoxServices {
  PoseDesk* poses = nullptr;  ///< null: pose results come as events, or never
  FrameView* view = nullptr;  ///< keeps the two last fields for display
  core::Snapshot<OverlaySnapshot>* overlay = nullptr;  ///< what the marks are drawn from
  bool estimates = false;             ///< with the places where tubes are expected in it
  EventRecorder* recorder = nullptr;  ///< keeps the last fields for a replay
  core::lighting::LampPolicy lamp{};  ///< what the session may do with the dimmer's lamp
  PairDesk* pairs = nullptr;          ///< keeps poses by the robot and by the box side by side
  PictureTap* tap = nullptr;          ///< hands fields and their marks to whoever shows them
  JournalDesk* journal = nullptr;     ///< hands over what belongs into the journal
};

/// What went wrong on one line so far.
struct PortCounters {
  std::int64_t garbled = 0;       ///< messages lost on their way to the box
  std::int64_t gone = 0;          ///< turns in which the other side was gone, or the line failed
  std::int64_t lost_replies = 0;  ///< answers that found no room or nobody
};

/// What the loop has come to so far.
struct BoxCounters {
  std::int64_t fields = 0;  ///< steps, those without a field too
  std::int64_t missing = 0;
  std::int64_t dimmer_errors = 0;
  PortCounters link;
  PortCounters station;
};

/// The loop of every assembly: grab, step, answer, lamp, pose.
///
/// One turn() takes one field, or the news that none came, and leaves everything done that follows
/// from it. Only the grabber waits. After start() no turn allocates. One thread; some 20 KB.
/// `Margin` is the session's policy.
template <core::Scalar S, typename Margin = core::tracking::MarginChecked>
class BoxLoop {
 public:
  /// `session` is configured and outlives the loop.
  BoxLoop(core::session::Session<S, Margin>& session, const BoxPorts& ports,
          const BoxServices& services = {});

  /// Starts the lamp, which then shines in full, the link and the station. The grabber is the
  /// caller's to start, before the first turn: only he knows what to do when its fields end.
  ///
  /// Errors: kNotReady already started, and those of the ports; what was started before is stopped
  /// again.
  [[nodiscard]] core::Result<void> start();

  /// Stops what start() started, in reverse; the lamp goes dark. Calling it when not started does
  /// nothing.
  void stop();

  /// Takes the next field, waiting at most `timeout` for it.
  ///
  /// When none comes in time, a step is made without one: what the box says is never older than it
  /// looks. A frame that fails to come lacks two fields, so on an interlaced source the turn after
  /// that gives the second at once, and numbers stay even for each frame's first field. Errors are
  /// those of the grabber other than kTimeout; nothing was stepped, events wait, and the caller
  /// decides: a recording has ended, a camera is started anew.
  [[nodiscard]] core::Result<void> turn(std::chrono::milliseconds timeout);

  /// A turn without a field, without asking the grabber: for the time until a camera is back.
  void turn_without_field();

  /// Of the last turn. The field's pixels are not valid any more.
  [[nodiscard]] const core::session::Input& input() const { return input_; }
  [[nodiscard]] const core::session::Output& output() const { return output_; }

  [[nodiscard]] const BoxCounters& counters() const { return counters_; }

 private:
  /// Who has events; in the order in which events of the same instant are handed over.
  enum Source : std::size_t { kLink, kStation, kPoses, kSources };

  void number(core::Field& field);
  void take(const core::Field& field);
  void gather_events();
  void fetch(Source source);
  template <typename Port>
  void fetch_from(Port* port, Source source, PortCounters& counters);
  [[nodiscard]] std::optional<core::Event>* earliest();
  void answer();
  template <typename Port>
  void send(Port* port, const core::Reply& reply, PortCounters& counters);
  void set_lamp();
  void serve_poses();
  void publish();
  void publish_marks();
  void record();
  void keep_state();

  core::session::Session<S, Margin>* session_;
  BoxPorts ports_;
  BoxServices services_;
  core::session::Input input_;
  core::session::Output output_;
  BoxCounters counters_;

  std::array<std::optional<core::Event>, kSources> next_{};  ///< polled, not handed over yet
  std::array<bool, kSources> asked_enough_{};                ///< in this turn
  std::int32_t garbled_now_ = 0;                             ///< in this turn

  bool started_ = false;
  core::Parity parity_ = core::Parity::kEven;        ///< of the last field that came
  core::Parity first_parity_ = core::Parity::kEven;  ///< of a frame's first field
  bool frame_half_missing_ = false;                  ///< the next turn brings its other field
  std::int64_t last_number_ = -1;
  std::int64_t number_shift_ = 0;  ///< from the grabber's numbers to ours: missing ones are counted
  OverlayNews news_;
  OverlaySnapshot overlay_;
};

}  // namespace tubesight::board
