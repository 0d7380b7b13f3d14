#include "board/bench/replay/replay_command.h"

#include <chrono>
#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "board/bench/cold_start/cold_start.h"
#include "board/bench/cold_start/first_field.h"
#include "board/bench/input/recording_input.h"
#include "board/bench/output/output_paths.h"
#include "board/bench/output/overlay_sink.h"
#include "board/bench/output/pose_rows.h"
#include "board/bench/output/progress_line.h"
#include "board/bench/output/replies_rows.h"
#include "board/bench/output/result_files.h"
#include "board/bench/output/text_output.h"
#include "board/bench/replay/replay_job.h"
#include "board/bench/replay/replay_statistics.h"
#include "board/bench/replay/summary_json.h"
#include "board/bench/replay/summary_text.h"
#include "board/box/pose_service.h"
#include "core/overlay/overlay.h"
#include "drivers/files/atomic_file.h"
#include "drivers/files/decimal.h"
#include "drivers/files/messages.h"
#include "drivers/files/pairs_file.h"
#include "drivers/replay/companion.h"
#include "drivers/replay/replay_events.h"
#include "drivers/replay/replay_frame_grabber.h"
#include "drivers/settings/session_checks.h"
#include "drivers/settings/session_settings.h"

namespace tubesight::board {
namespace {

/// The files of one replay and what is written from them.
class Replay {
 public:
  explicit Replay(const ReplayOptions& options)
      : options_(options),
        recording_(options.recording == kStandardStream ? "standard input" : options.recording) {}

  ExitStatus run() {
    if (!open_inputs() || !open_outputs()) {
      return ExitStatus::kWrongInput;
    }
    tell_how_read();
    const ReplayEnd end = replay();
    progress_.erase();
    tell(end.messages);
    if (end.status != ExitStatus::kDone) {
      return end.status;
    }
    if (statistics_.fields() == 0 && !grabber_->choice().all()) {
      tell(recording_ + ": has no field there, expected some from --from to --to");
      return ExitStatus::kWrongInput;
    }
    tell_events_left();
    tell_request_left();
    if (!commit(end.cut_short)) {
      return ExitStatus::kJobFailed;
    }
    return summarise(end.cut_short);
  }

 private:
  bool open_inputs() {
    if (options_.to_s >= 0.0 && options_.from_s > options_.to_s) {
      tell("--from: is after --to, expected it before");
      return false;
    }
    drivers::Messages messages;
    bool good = read_state(messages);
    drivers::NeededTables needed = drivers::kReplayNeeds;
    needed.start = !has_state_;  // a box may have been started by its robot
    good =
        drivers::load_session_settings(options_.session, needed, *session_file_, messages) && good;
    if (good) {
      tell_files(session_file_->files);
    }
    // A recording can be judged only against sound settings, its events without any.
    if (good) {
      grabber_ = make_grabber(messages);
      good = grabber_ != nullptr && start(*grabber_, messages);
    }
    good = good && (has_state_ || fields_come_often_enough(messages));
    if (!from_standard_input()) {
      good = static_cast<bool>(events_.load_beside(options_.recording, messages)) && good;
    }
    if (good && !has_state_) {
      expand_start(messages);
    }
    tell(messages);
    return good;
  }

  [[nodiscard]] bool from_standard_input() const { return options_.recording == kStandardStream; }

  [[nodiscard]] drivers::FrameChoice frame_choice() const {
    const auto time = [](double seconds) {
      return std::chrono::duration_cast<core::FieldTime>(std::chrono::duration<double>(seconds));
    };
    drivers::FrameChoice choice;
    choice.from = options_.from_s >= 0.0 ? time(options_.from_s) : choice.from;
    choice.to = options_.to_s >= 0.0 ? time(options_.to_s) : choice.to;
    choice.every = options_.every;
    return choice;
  }

  /// A grabber of the recording that is told all and not started; null when it cannot be read.
  std::unique_ptr<drivers::ReplayFrameGrabber> make_grabber(drivers::Messages& messages) {
    auto grabber =
        std::make_unique<drivers::ReplayFrameGrabber>(session_file_->settings.camera, recording_);
    if (has_state_ && !frame_choice().all()) {
      messages.push_back(recording_ +
                         ": of a box's recorder, whose state holds for its first "
                         "field, expected neither --from nor --to nor --every");
      return nullptr;
    }
    std::string why;
    if (!feed(*grabber, options_.recording, options_.ignore_scan_flag, why)) {
      messages.push_back(why);
      return nullptr;
    }
    if (has_state_) {
      grabber->follow_rows();
    }
    grabber->choose(frame_choice());
    return grabber;
  }

  /// One or two clicks become a start by the lattice in the first field. Where they do not, the
  /// session refuses them as too few, and the message says why.
  void expand_start(drivers::Messages& messages) {
    core::StartSettings& start = session_file_->settings.start;
    if (start.tubes.empty() || start.tubes.size() >= static_cast<std::int32_t>(kWholeStart)) {
      return;
    }
    if (from_standard_input()) {
      messages.push_back(options_.session +
                         ": start: standard input is read once, expected three clicks");
      return;
    }
    const auto again = make_grabber(messages);
    if (again == nullptr) {
      return;
    }
    const RecordedField field =
        read_first_field(*again, session_file_->settings.camera, options_.recording, 0);
    if (!field.message.empty()) {
      messages.push_back(field.message);
      return;
    }
    std::vector<core::pose::PictureStart> clicks;
    for (const core::StartPoint& point : start.tubes) {
      clicks.push_back({point.address, point.at_px[0], point.at_px[1]});
    }
    ColdStart cold(session_file_->settings, true, session_file_->heading_deg);
    const ColdTubes tubes = cold.find(field.picture, clicks);
    if (!tubes.message.empty()) {
      messages.push_back(options_.session + ": start: " + tubes.message);
      return;
    }
    start.tubes.clear();
    for (const core::pose::PictureStart& place : tubes.places) {
      static_cast<void>(start.tubes.try_push_back({place.address, {place.u_px, place.v_px}}));
    }
  }

  /// With a state beside it, the recording is of a box's recorder.
  bool read_state(drivers::Messages& messages) {
    if (from_standard_input()) {
      return true;
    }
    const auto present = drivers::read_companion(
        drivers::companion_path(options_.recording, ".state"), state_, messages);
    has_state_ = present.value_or(false);
    return present.has_value();
  }

  /// A recording that no track can follow whatever it shows is refused before anything is written.
  [[nodiscard]] bool fields_come_often_enough(drivers::Messages& messages) const {
    const core::FieldTime span = grabber_->shortest_span();
    if (span <= core::FieldTime{0}) {
      return true;
    }
    const core::SessionSettings& settings = session_file_->settings;
    const std::string why = drivers::why_fields_too_seldom(
        settings.motion, settings.tubesheet, std::chrono::duration<double>(span).count());
    if (!why.empty()) {
      messages.push_back(options_.session + ": motion: " + recording_ + ": " + why);
    }
    return why.empty();
  }

  bool open_outputs() {
    if (const std::string conflict = find_output_conflict(options_); !conflict.empty()) {
      tell(conflict);
      return false;
    }
    if (!results_.open(options_.fields, options_.centers)) {
      tell(results_.message());
      return false;
    }
    if (!options_.poses.empty() &&
        (!open_output(poses_file_, options_.poses) ||
         !poses_file_.write(std::string_view(std::string(kPoseHeader) + '\n')))) {
      tell(poses_file_.message());
      return false;
    }
    if (std::string ignored;
        !options_.pairs.empty() &&
        !(pairs_.begin({}, options_.pairs, ignored) && open_output(pairs_file_, options_.pairs))) {
      tell(pairs_file_.message());
      return false;
    }
    if (!options_.replies.empty() &&
        (!open_output(replies_file_, options_.replies) ||
         !replies_file_.write(std::string_view(std::string(kRepliesHeader) + '\n')))) {
      tell(replies_file_.message());
      return false;
    }
    if (!options_.summary.empty() && !open_output(summary_file_, options_.summary)) {
      tell(summary_file_.message());
      return false;
    }
    if (!options_.overlay.empty()) {
      overlay_ = make_overlay_sink(options_.overlay);
      drivers::Y4mHeader shown = grabber_->header();
      shown.height_px = core::overlay::overlay_height_px(shown.width_px, shown.height_px);
      if (!overlay_->open(shown, grabber_->interlaced())) {
        tell(overlay_->message());
        return false;
      }
    }
    return true;
  }

  /// What is known of the length, where somebody looks at the progress.
  [[nodiscard]] double length_s() const {
    return progress_.shown() ? told_length_s(options_.recording).value_or(0.0) : 0.0;
  }

  ReplayEnd replay() {
    ReplayInputs inputs{
        options_.session, recording_, session_file_->settings, *grabber_, events_, {}, length_s()};
    if (has_state_) {
      inputs.state = std::as_bytes(std::span(state_.data(), state_.size()));
    }
    const ReplayOutputs outputs{results_,
                                overlay_.get(),
                                options_.overlay_estimates,
                                poses_,
                                pose_rows_,
                                options_.replies.empty() ? nullptr : &replies_file_,
                                options_.pairs.empty() ? nullptr : &pairs_,
                                statistics_,
                                progress_};
    switch (options_.scalar) {
      case ScalarChoice::kFloat: return replay_fields<float>(inputs, outputs);
      case ScalarChoice::kDouble: return replay_fields<double>(inputs, outputs);
      case ScalarChoice::kFixed: break;
    }
    return replay_fields<core::FixedPoint>(inputs, outputs);
  }

  /// With `-v`; and of --from what whoever clicked has to know.
  void tell_how_read() const {
    if (options_.from_s > 0.0 && !has_state_ && !session_file_->settings.start.tubes.empty()) {
      tell(options_.session +
           ": start: taken to be clicked in the first field from --from on, and earlier events are "
           "left out");
    }
    if (talk() == Talk::kVerbose) {
      std::string text = how_read(options_.recording, grabber_->header());
      text += grabber_->interlaced() ? ", taken as interlaced" : ", taken as progressive";
      text += grabber_->has_meta() ? ", times by its meta file" : ", no meta file";
      drivers::print(text, ", %lld events", static_cast<long long>(events_.size()));
      tell_more(text);
    }
  }

  void tell_events_left() {
    if (events_.left() > 0) {
      tell(drivers::companion_path(options_.recording, ".events.csv") + ": the last " +
           std::to_string(events_.left()) + " of " + std::to_string(events_.size()) +
           " events are after the recording's end and were left out");
    }
  }

  void tell_request_left() {
    if (poses_.unanswered() >= 0) {
      tell(recording_ + ": the pose request before field " + std::to_string(poses_.unanswered()) +
           " got no answer: the recording ended before it was ready");
    }
  }

  [[nodiscard]] RecordingFacts facts(bool cut_short) const {
    const drivers::Y4mHeader& header = grabber_->header();
    return {recording_, header.width_px, header.height_px, grabber_->interlaced(), cut_short};
  }

  bool commit(bool cut_short) {
    if (!results_.commit()) {
      tell(results_.message());
      return false;
    }
    if (!options_.poses.empty() &&
        (!poses_file_.write(std::string_view(pose_rows_)) || !poses_file_.commit())) {
      tell(poses_file_.message());
      return false;
    }
    if (!options_.pairs.empty() && (!pairs_file_.write(pairs_.text()) || !pairs_file_.commit())) {
      tell(pairs_file_.message());
      return false;
    }
    if (!options_.replies.empty() && !replies_file_.commit()) {
      tell(replies_file_.message());
      return false;
    }
    if (!options_.summary.empty() &&
        (!summary_file_.write(std::string_view(summary_json(facts(cut_short), statistics_))) ||
         !summary_file_.commit())) {
      tell(summary_file_.message());
      return false;
    }
    // Last, as pictures in a folder cannot wait for the files (drivers::CommitTogether).
    if (overlay_ != nullptr && !overlay_->commit()) {
      tell(overlay_->message());
      return false;
    }
    return true;
  }

  ExitStatus summarise(bool cut_short) {
    const bool taken =
        goes_to_standard_output({options_.fields, options_.centers, options_.poses, options_.pairs,
                                 options_.replies, options_.summary});
    if (!write_out(summary_text(facts(cut_short), statistics_), taken)) {
      return ExitStatus::kJobFailed;
    }
    const std::string lost = options_.must_track ? why_not_tracked(recording_, statistics_) : "";
    if (!lost.empty()) {
      tell(lost);
      return ExitStatus::kNotTracked;
    }
    return ExitStatus::kDone;
  }

  ReplayOptions options_;
  std::string recording_;  ///< as messages call it
  std::unique_ptr<drivers::SessionFile> session_file_ = std::make_unique<drivers::SessionFile>();
  std::unique_ptr<drivers::ReplayFrameGrabber> grabber_;
  drivers::ReplayEvents events_;
  std::string state_;
  bool has_state_ = false;
  ResultFiles results_;
  std::unique_ptr<OverlaySink> overlay_;
  PoseService poses_;
  std::string pose_rows_;
  drivers::AtomicFile poses_file_;
  drivers::PairsText pairs_;
  drivers::AtomicFile pairs_file_;
  drivers::AtomicFile replies_file_;
  drivers::AtomicFile summary_file_;
  ReplayStatistics statistics_;
  ProgressLine progress_;
};

}  // namespace

ExitStatus run_replay(const ReplayOptions& options) { return Replay(options).run(); }

}  // namespace tubesight::board
