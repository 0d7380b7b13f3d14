#include "board/bench/replay_job.h"

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "board/bench/overlay_composer.h"
#include "core/base/instantiate.h"
#include "core/session/session.h"

namespace tubesight::board {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

/// What make_tracking_model() asks for beyond the ranges of the single keys.
constexpr const char* kBeyondArithmetic =
    ": the tracking cannot compute with these settings together, expected neighbouring tubes from "
    "2 "
    "mm apart and a picture within 60 degrees of the optical axis";

/// One replay; holds what a field needs, so that nothing large lies on the stack.
template <core::Scalar S>
class ReplayJob {
 public:
  ReplayJob(ReplayInputs inputs, ReplayOutputs outputs)
      : in_(inputs), out_(outputs), feed_(inputs.settings.start) {
    if (outputs.overlay != nullptr) {
      composer_.emplace(inputs.settings, outputs.overlay_estimates);
    }
  }

  ReplayEnd run() {
    if (!session_.configure(in_.settings) || !out_.poses.configure(in_.settings)) {
      return {ExitStatus::kWrongInput, false, {in_.session + kBeyondArithmetic}};
    }
    while (true) {
      const auto lease = in_.grabber.grab_for(std::chrono::milliseconds(0));
      if (!lease) {
        return ended(lease.error());
      }
      if (const auto taken = take(lease->field()); !taken) {
        return {ExitStatus::kJobFailed, false, {std::move(message_)}};
      }
    }
  }

 private:
  Result<void> take(const core::Field& field) {
    const std::int64_t number = field.number;
    input_.field = field;
    feed_.take_before(number, in_.events, input_.events);
    hand_pose_result();
    session_.step(input_, output_);
    if (!in_.events.has_pose_results()) {
      out_.poses.take(field, number, output_.order);
    }
    out_.statistics.add(output_);
    out_.progress.update(ProgressLine::Clock::now(), out_.statistics.fields(), field.mid_exposure);
    if (const auto written =
            out_.results.add(number, field.parity, output_.sighting, output_.tubes);
        !written) {
      message_ = out_.results.message();
      return written;
    }
    if (composer_) {
      const auto picture = composer_->compose(in_.grabber.frame(), number, session_, output_);
      if (const auto written = out_.overlay->add(number, picture); !written) {
        message_ = out_.overlay->message();
        return written;
      }
    }
    return {};
  }

  /// The pose that was computed since the last field; what finds no room waits.
  void hand_pose_result() {
    if (!input_.events.full()) {
      if (const auto result = out_.poses.take_result()) {
        static_cast<void>(input_.events.try_push_back(*result));
      }
    }
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
  EventFeed feed_;
  core::session::Session<S> session_;
  core::session::Input input_;
  core::session::Output output_;
  std::optional<OverlayComposer<S>> composer_;
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
