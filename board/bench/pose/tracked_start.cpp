#include "board/bench/pose/tracked_start.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <utility>

#include "board/bench/cold_start/first_field.h"
#include "board/bench/input/recording_input.h"
#include "board/bench/script/replay_script.h"
#include "board/bench/script/scripted_ports.h"
#include "board/box/box_loop.h"
#include "board/box/start_text.h"
#include "core/base/names.h"
#include "core/session/session.h"
#include "drivers/files/messages.h"
#include "drivers/replay/replay_clock.h"
#include "drivers/replay/replay_events.h"
#include "drivers/replay/replay_frame_grabber.h"

namespace tubesight::board {
namespace {

using core::TrackState;

constexpr double kQ16 = 65536.0;

TrackedFrame failed(ExitStatus status, std::string message) {
  TrackedFrame frame;
  frame.status = status;
  frame.message = std::move(message);
  return frame;
}

std::string joined(const drivers::Messages& messages) {
  std::string text;
  for (const std::string& message : messages) {
    text += (text.empty() ? "" : "\n") + message;
  }
  return text;
}

double smallest_distance(const PictureStarts& places) {
  double smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < places.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k) {
      smallest = std::min(
          smallest, std::hypot(places[i].u_px - places[k].u_px, places[i].v_px - places[k].v_px));
    }
  }
  return smallest;
}

}  // namespace

/// One pass over one recording.
struct TrackedStart::Run {
  Run(const core::SessionSettings& settings, std::string name, const core::StartSettings& start)
      : recording(std::move(name)),
        grabber(settings.camera, recording),
        clock(grabber),
        script(start, events, grabber) {}

  /// Opens everything; the message of a failure stays for every frame.
  bool open(const core::SessionSettings& settings, StartFrame where) {
    drivers::Messages messages;
    std::string why;
    if (!feed(grabber, recording, where.ignore_scan_flag, why)) {
      trouble = why;
      return false;
    }
    bool good = start(grabber, messages);
    if (where.with_events) {
      good = static_cast<bool>(events.load_beside(recording, messages)) && good;
    }
    if (good && !session.configure(settings)) {
      messages = {recording + ": its frames cannot be tracked with these settings together"};
      good = false;
    }
    good = good && loop.start();
    trouble = joined(messages);
    return good;
  }

  /// Takes one field; false when there is none.
  bool step(std::int64_t from_field) {
    // Before the clicks nothing is known: those fields are passed over.
    const std::int64_t last = grabber.field_number();
    const std::int64_t next = last < 0 ? 0 : last + (grabber.interlaced() ? 1 : 2);
    const bool known = next >= from_field;
    const TrackState before = loop.output().sighting.state;
    const auto taken = known ? loop.turn(std::chrono::milliseconds(0)) : pass_over();
    if (!taken) {
      trouble = taken.error() == core::Error::kEndOfData
                    ? recording + ": ends before the frame that is wanted"
                    : joined(grabber.messages());
      return false;
    }
    const std::int64_t number = grabber.field_number();
    if (known && (number == from_field || loop.output().sighting.state != before)) {
      state_since = number;
    }
    return true;
  }

  core::Result<void> pass_over() {
    const auto lease = grabber.grab_for(std::chrono::milliseconds(0));
    return lease ? core::Result<void>() : core::Unexpected(lease.error());
  }

  /// Why the field last taken does not tell which tubes are seen.
  [[nodiscard]] std::string why_unknown() const {
    const core::Sighting& seen = loop.output().sighting;
    const core::StartReply start{session.tracker().start_refusal(),
                                 session.tracker().refused_click()};
    const bool refused = seen.reason == core::Reason::kStartRefused;
    std::string text = "which tubes this frame shows is not known: ";
    switch (seen.state) {
      case TrackState::kLost: text += "the tracking lost them in field "; break;
      case TrackState::kDegraded: text += "the tracking is degraded from field "; break;
      default: text += refused ? "the start was refused in field " : "no start until field "; break;
    }
    text += std::to_string(state_since) + " (";
    text += refused ? name_of(start.refusal) : core::name_of(seen.reason);
    text += ": ";
    text += refused ? refusal_text(start) : std::string(explain(seen.reason));
    return text + "), expected tubes tracked from the start to this frame";
  }

  std::string recording;
  drivers::ReplayFrameGrabber grabber;
  drivers::ReplayEvents events;
  drivers::ReplayClock clock;
  ReplayScript script;
  ScriptedRobotLink link{script};
  ScriptedOperatorStation station{script};
  core::session::Session<core::FixedPoint> session;
  BoxLoop<core::FixedPoint> loop{session, BoxPorts{&grabber, &clock, nullptr, &link, &station}};
  std::int64_t state_since = 0;  ///< field from which the state is what it is
  std::string trouble;
};

TrackedStart::TrackedStart(const core::SessionSettings& settings, const PictureStarts& clicks,
                           StartFrame where, ColdStart* cold)
    : settings_(settings), start_(settings.start), clicks_(clicks), where_(where), cold_(cold) {
  set_start(clicks_);
}

void TrackedStart::set_start(const PictureStarts& places) {
  start_.tubes.clear();
  for (const core::pose::PictureStart& place : places) {
    static_cast<void>(start_.tubes.try_push_back({place.address, {place.u_px, place.v_px}}));
  }
}

std::string TrackedStart::expand(const std::string& recording) {
  if (cold_ == nullptr || clicks_.size() >= kWholeStart) {
    return {};
  }
  const RecordedField field =
      read_first_field(settings_.camera, recording, where_.frame, where_.ignore_scan_flag);
  if (!field.message.empty()) {
    return field.message;
  }
  const ColdTubes tubes = cold_->find(field.picture, clicks_);
  set_start(tubes.places);
  return tubes.message;
}

TrackedStart::~TrackedStart() = default;

TrackedFrame TrackedStart::find(const std::string& recording, std::int64_t frame) {
  if (run_ == nullptr || run_->recording != recording ||
      run_->grabber.field_number() / 2 >= frame) {
    if (const std::string why = expand(recording); !why.empty()) {
      return failed(ExitStatus::kJobFailed, "which tubes this frame shows is not known: " + why);
    }
    run_ = std::make_unique<Run>(settings_, recording, start_);
    if (!run_->open(settings_, where_)) {
      const std::string trouble = run_->trouble;
      run_.reset();
      return failed(ExitStatus::kWrongInput, trouble);
    }
  }
  Run& run = *run_;
  std::string unknown;
  const std::int64_t last_field = 2 * frame + (run.grabber.interlaced() ? 1 : 0);
  while (run.grabber.field_number() < last_field) {
    if (!run.step(2 * where_.frame)) {
      const std::string trouble = run.trouble;
      run_.reset();
      return failed(ExitStatus::kWrongInput, trouble);
    }
    if (run.grabber.field_number() >= 2 * frame && unknown.empty() &&
        run.loop.output().sighting.state != TrackState::kTracking) {
      unknown = run.why_unknown();
    }
  }
  if (!unknown.empty()) {
    return failed(ExitStatus::kJobFailed, unknown);
  }
  TrackedFrame found;
  for (const core::TubeSighting& tube : run.loop.output().tubes) {
    if (!tube.plug && tube.quality_permyriad > 0) {
      found.tubes.push_back(
          {tube.address, tube.center_px.u_q16 / kQ16, tube.center_px.v_q16 / kQ16});
    }
  }
  if (run.loop.output().sighting.tool_known) {
    found.tool = run.loop.output().sighting.tool;
  }
  return found;
}

bool agree_on_tubes(const PictureStarts& one, const PictureStarts& other) {
  const double half_step = std::min(smallest_distance(one), smallest_distance(other)) / 2.0;
  bool shared = false;
  for (const core::pose::PictureStart& a : one) {
    for (const core::pose::PictureStart& b : other) {
      if (a.address == b.address) {
        shared = true;
        if (std::hypot(a.u_px - b.u_px, a.v_px - b.v_px) >= half_step) {
          return false;
        }
      }
    }
  }
  return shared;
}

}  // namespace tubesight::board
