#include "board/bench/replay/replay_job.h"

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "board/bench/output/pose_rows.h"
#include "board/bench/output/replies_rows.h"
#include "board/bench/replay/replay_station.h"
#include "board/bench/script/replay_script.h"
#include "board/bench/script/scripted_ports.h"
#include "board/box/box_loop.h"
#include "board/box/frame_view.h"
#include "board/box/overlay_composer.h"
#include "board/box/overlay_snapshot.h"
#include "board/box/pair_desk.h"
#include "core/base/instantiate.h"
#include "core/base/snapshot.h"
#include "core/session/session.h"
#include "drivers/replay/companion.h"
#include "drivers/replay/replay_clock.h"
#include "hal/operator_station.h"

namespace tubesight::board {
namespace {

using core::Error;
using core::Result;

/// What make_tracking_model() asks for beyond the ranges of the single keys.
constexpr const char* kBeyondArithmetic =
    ": the tracking cannot compute with these settings together, expected neighbouring tubes from "
    "2 "
    "mm apart and a picture within 60 degrees of the optical axis";

/// Why a state was refused, behind its file's name.
std::string why_refused(Error error, const std::string& session) {
  switch (error) {
    case Error::kDataLoss: return ": damaged or cut short, expected the file as the box wrote it";
    case Error::kUnsupported:
      return ": of another version of Tubesight or another arithmetic, expected the state of a box "
             "of this one (its arithmetic is fixed)";
    case Error::kInvalidArgument:
      return ": of a box with other settings, expected those of " + session;
    default: return ": holds what no box comes to, expected the file as the box wrote it";
  }
}

/// What an overlay is made with.
struct Display {
  explicit Display(const core::SessionSettings& settings)
      : view(settings.camera.width_px, settings.camera.height_px), composer(settings) {}

  FrameView view;
  OverlayComposer composer;
  core::Snapshot<OverlaySnapshot> latest;
  OverlaySnapshot shown;
};

/// One replay; holds what a field needs, so that nothing large lies on the stack.
template <core::Scalar S>
class ReplayJob {
 public:
  ReplayJob(ReplayInputs inputs, ReplayOutputs outputs)
      : in_(inputs),
        out_(outputs),
        script_(inputs.settings.start, inputs.events, inputs.grabber),
        clock_(inputs.grabber),
        link_(script_,
              inputs.state ? ScriptedRobotLink::Rows::kAll : ScriptedRobotLink::Rows::kRobots),
        station_(script_, inputs.grabber, outputs.overlay) {
    if (outputs.overlay != nullptr) {
      display_.emplace(inputs.settings);
    }
  }

  ReplayEnd run() {
    if (!session_.configure(in_.settings) || !out_.poses.configure(in_.settings)) {
      return {ExitStatus::kWrongInput, false, {in_.session + kBeyondArithmetic}};
    }
    if (!in_.grabber.choice().all()) {
      script_.begin_at_first_field();
    }
    if (in_.settings.start.tubes.empty()) {
      script_.leave_start_out();  // nobody has named tubes yet
    }
    if (in_.state) {
      script_.leave_start_out();
      if (const auto restored = session_.restore(*in_.state); !restored) {
        return {ExitStatus::kWrongInput,
                false,
                {drivers::companion_path(in_.recording, ".state") +
                 why_refused(restored.error(), in_.session)}};
      }
    }
    BoxLoop<S>& loop = loop_.emplace(
        session_, BoxPorts{&in_.grabber, &clock_, nullptr, &link_, station()}, services());
    if (const auto started = loop.start(); !started) {
      return ended(started.error());
    }
    while (true) {
      if (const auto turned = loop.turn(std::chrono::milliseconds(0)); !turned) {
        return ended(turned.error());
      }
      if (const auto written = write_down(loop.input().field, loop.output()); !written) {
        return {ExitStatus::kJobFailed, false, {std::move(message_)}};
      }
    }
  }

 private:
  /// A box's events come in the order in which it took them, whoever sent them: over the link. The
  /// station then only shows pictures.
  hal::OperatorStation* station() {
    const bool only_shows = in_.state && station_.start();
    return only_shows ? nullptr : &station_;
  }

  BoxServices services() {
    BoxServices services;
    // What the recording tells of poses is not computed again; a box's tells of all.
    const bool told = in_.events.has_pose_results() || in_.state;
    services.poses = told ? nullptr : &out_.poses;
    services.pairs = out_.pairs == nullptr ? nullptr : &pair_desk_;
    if (display_) {
      services.view = &display_->view;
      services.overlay = &display_->latest;
      services.estimates = out_.overlay_estimates;
    }
    return services;
  }

  Result<void> write_down(const core::Field& field, const core::session::Output& output) {
    write_down_pose();
    while (const auto pair = pair_desk_.take_pair()) {
      if (!out_.pairs->append(*pair, message_)) {
        return core::Unexpected(Error::kInvalidArgument);
      }
    }
    out_.statistics.add(output);
    if (const auto written = write_down_replies(output); !written) {
      return written;
    }
    out_.progress.update(ProgressLine::Clock::now(), out_.statistics.fields(), field.mid_exposure,
                         share_done(field.mid_exposure));
    if (const auto written =
            out_.results.add(field.number, field.parity, output.sighting, output.tubes);
        !written) {
      message_ = out_.results.message();
      return written;
    }
    return show(output.sighting);
  }

  /// Of the job: by what was read of a file, by the length that a video tells, or by --to,
  /// whichever comes to its end first. Below 0: nobody knows.
  [[nodiscard]] double share_done(core::FieldTime time) const {
    const double now_s = std::chrono::duration<double>(time).count();
    double share = in_.grabber.share_read();
    if (share < 0.0 && in_.length_s > 0.0) {
      share = now_s / in_.length_s;
    }
    const core::FieldTime to = in_.grabber.choice().to;
    if (to != core::FieldTime::max() && to > core::FieldTime{0}) {
      share = std::max(share, now_s / std::chrono::duration<double>(to).count());
    }
    return share;
  }

  Result<void> write_down_replies(const core::session::Output& output) {
    if (out_.replies == nullptr || output.replies.empty()) {
      return {};
    }
    rows_.clear();
    for (const core::Reply& reply : output.replies) {
      append_reply_row(rows_, in_.grabber.field_number(), reply);
    }
    const auto written = out_.replies->write(std::string_view(rows_));
    if (!written) {
      message_ = out_.replies->message();
    }
    return written;
  }

  Result<void> show(const core::Sighting& sighting) {
    // The loop has published just now, on this thread.
    if (!display_ || !display_->latest.try_read(display_->shown)) {
      return {};
    }
    const auto picture = display_->composer.compose(display_->view.picture(), display_->shown);
    const auto shown = station_.show(picture, sighting);
    if (!shown) {
      message_ = out_.overlay->message();
    }
    return shown;
  }

  /// The first cell is the recording and the number of the field that the request came before.
  void write_down_pose() {
    const auto& computed = out_.poses.computed();
    if (!computed) {
      return;
    }
    PoseRow row;
    row.image = in_.recording + ":" + std::to_string(computed->field);
    if (computed->estimate != nullptr) {
      row.estimate = computed->estimate;
      row.covariance = computed->estimate->covariance;
      row.has_tube = computed->has_tube;
    }
    append_pose_row(out_.pose_rows, row);
  }

  ReplayEnd ended(Error why) {
    out_.statistics.finish();
    switch (why) {
      case Error::kEndOfData: return {};
      case Error::kDataLoss: return {ExitStatus::kDone, true, in_.grabber.messages()};
      default: return {ExitStatus::kWrongInput, false, in_.grabber.messages()};
    }
  }

  ReplayInputs in_;
  ReplayOutputs out_;
  ReplayScript script_;
  drivers::ReplayClock clock_;
  ScriptedRobotLink link_;
  ReplayStation station_;
  core::session::Session<S> session_;
  PairDesk pair_desk_;
  std::optional<Display> display_;
  std::optional<BoxLoop<S>> loop_;
  std::string rows_;
  std::string message_;
};

}  // namespace

template <core::Scalar S>
ReplayEnd replay_fields(ReplayInputs inputs, ReplayOutputs outputs) {
  return std::make_unique<ReplayJob<S>>(inputs, outputs)->run();
}

#define TUBESIGHT_INSTANTIATE(S) template ReplayEnd replay_fields<S>(ReplayInputs, ReplayOutputs);
TUBESIGHT_FOR_EACH_SCALAR(TUBESIGHT_INSTANTIATE)
#undef TUBESIGHT_INSTANTIATE

}  // namespace tubesight::board
