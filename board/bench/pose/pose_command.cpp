#include "board/bench/pose/pose_command.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "board/bench/cold_start/cold_start.h"
#include "board/bench/input/recording_input.h"
#include "board/bench/output/output_paths.h"
#include "board/bench/output/pose_rows.h"
#include "board/bench/output/progress_line.h"
#include "board/bench/output/still_averager.h"
#include "board/bench/output/still_reader.h"
#include "board/bench/output/text_output.h"
#include "board/bench/pose/calibration_quality.h"
#include "board/bench/pose/pose_overlay.h"
#include "board/bench/pose/pose_starts.h"
#include "board/bench/pose/pose_text.h"
#include "board/bench/pose/pose_words.h"
#include "board/bench/pose/still_tubes.h"
#include "core/pose/calibration_uncertainty.h"
#include "core/pose/picture_pose.h"
#include "core/pose/pose_model.h"
#include "core/tubesheet/sheet_map.h"
#include "core/verification/position_correction.h"
#include "drivers/files/atomic_file.h"
#include "drivers/files/csv_reader.h"
#include "drivers/files/png_writer.h"
#include "drivers/settings/session_checks.h"
#include "drivers/settings/session_settings.h"

namespace tubesight::board {
namespace {

/// One run of the command; on the heap, as the settings and the workspace are large.
class PoseRun {
 public:
  explicit PoseRun(const PoseCommandOptions& options) : options_(options) {}

  ExitStatus run() {
    if (!open()) {
      return ExitStatus::kWrongInput;
    }
    StillAverager averager(settings().camera, options_.ignore_scan_flag);
    const std::span<const Still> stills = stills_;
    const std::size_t at_once = options_.average ? stills.size() : 1;
    ExitStatus status = ExitStatus::kDone;
    ProgressLine progress;
    for (std::size_t i = 0; i < stills.size(); i += at_once) {
      progress.update(ProgressLine::Clock::now(), stills[i].name(),
                      static_cast<double>(i) / static_cast<double>(stills.size()));
      const ExitStatus one = take(averager, stills.subspan(i, at_once));
      if (one == ExitStatus::kWrongInput) {
        return one;
      }
      status = one == ExitStatus::kDone ? status : one;
    }
    progress.erase();
    if (poses_ > 0 && !write()) {
      return ExitStatus::kJobFailed;
    }
    if (!write_out(text_, goes_to_standard_output({options_.csv, options_.covariance}))) {
      return ExitStatus::kJobFailed;
    }
    return status;
  }

 private:
  [[nodiscard]] const core::SessionSettings& settings() const { return file_.settings; }

  bool open() {
    drivers::Messages messages;
    const bool good = static_cast<bool>(
        drivers::load_session_settings(options_.session, drivers::kPoseNeeds, file_, messages));
    tell(messages);
    if (good) {
      tell_files(file_.files);
    }
    return good && make_model() && take_stills() && take_starts() && take_tubes() &&
           take_extras() && outputs_fit();
  }

  bool make_model() {
    const auto model =
        core::pose::make_pose_model(settings().camera, settings().tool, settings().tubesheet);
    if (!model || !map_.assign(settings().tubesheet)) {
      tell(options_.session +
           ": no pose can be computed with these settings together, expected neighbouring tubes "
           "from 2 mm apart and a picture within 60 degrees of the optical axis");
      return false;
    }
    model_ = *model;
    return true;
  }

  bool take_stills() {
    if (!options_.frames.empty()) {
      if (!parse_frames(options_.frames, frames_)) {
        tell("--frames: " + drivers::in_quotes(options_.frames) +
             ", expected A-B or A: frames of a recording, counted from 0 to 99999, A not behind B");
        return false;
      }
      if (std::none_of(options_.images.begin(), options_.images.end(), is_named_as_recording)) {
        tell(
            "--frames: no recording is given, expected a file that ends in .y4m, .y4m.xz, .mp4 or "
            "as another video");
        return false;
      }
    }
    stills_ = stills_of(options_.images, frames_);
    return true;
  }

  bool take_starts() {
    std::string message;
    if (options_.start.empty()) {
      for (const core::StartPoint& point : settings().start.tubes) {
        starts_.push_back({point.address, point.at_px[0], point.at_px[1]});
      }
      return take_cold();
    }
    if (!parse_starts(options_.start, starts_, message)) {
      tell(message);
      return false;
    }
    if (message = why_starts_wrong(starts_, settings()); !message.empty()) {
      tell("--start: " + message);
      return false;
    }
    return take_cold();
  }

  /// What fewer than three places need: the lattice found cold.
  bool take_cold() {
    if (starts_.size() >= kWholeStart) {
      return true;
    }
    if (options_.only_start) {
      tell("--only-start: " + std::to_string(starts_.size()) +
           " tube-ends are named, expected three at least");
      return false;
    }
    if (file_.heading_deg && !file_.has_tool) {
      tell(options_.session + ": tool: the table is missing, expected it for start.heading_deg");
      return false;
    }
    cold_ = std::make_unique<ColdStart>(settings(), file_.has_tool, file_.heading_deg);
    return !starts_.empty() || take_relative();
  }

  /// Without any address: the lattice around the middle tube takes the sheet's place.
  bool take_relative() {
    if (!options_.correct.empty()) {
      tell("--correct: no tube-end is named, expected an address in [start] or --start");
      return false;
    }
    const auto model =
        core::pose::make_pose_model(settings().camera, settings().tool, cold_->relative_sheet());
    if (!model || !map_.assign(cold_->relative_sheet())) {
      tell(options_.session + ": no pose can be computed with these settings together");
      return false;
    }
    model_ = *model;
    return true;
  }

  /// What tells the tubes of each still from the start.
  bool take_tubes() {
    // [start] was clicked in the first frame of a recording and counts as in a replay; places named
    // for the frames asked for are those of the first of them, whatever the recording tells.
    const StartFrame where = options_.start.empty()
                                 ? StartFrame{0, true, options_.ignore_scan_flag}
                                 : StartFrame{frames_.first, false, options_.ignore_scan_flag};
    tubes_.emplace(settings(), StillClicks{starts_, where, options_.only_start}, cold_.get());
    if (starts_.empty()) {
      return true;  // each still by itself
    }
    // Of an average the first frame alone: the further ones agree with it.
    const auto tracked = std::find_if(stills_.begin(), stills_.end(), [this](const Still& still) {
      return !tubes_->was_clicked(still) && !(options_.average && still.frame > frames_.first);
    });
    if (tracked != stills_.end() && !file_.has_tool) {
      tell(options_.session + ": tool: the table is missing, expected it for " + tracked->name() +
           ", as its tubes must be tracked from frame " + std::to_string(where.frame));
      return false;
    }
    return true;
  }

  /// `--total` and `--correct`.
  bool take_extras() {
    if ((options_.total || !options_.correct.empty()) && !file_.has_tool) {
      tell(options_.session + ": tool: the table is missing, expected it for " +
           (options_.total ? "--total" : "--correct"));
      return false;
    }
    if (options_.total && !file_.camera_quality.has_sigma && !file_.tool_quality.has_sigma) {
      tell(options_.session +
           ": --total needs the calibrations' uncertainties, expected sigma = [six numbers] in "
           "[camera_quality] or [tool_quality]");
      return false;
    }
    calibrations_ = uncertainty_of(file_);
    correction_.limit_mm = options_.limit_mm;
    if (!options_.correct.empty() && (!parse_address(options_.correct, correction_.tube) ||
                                      map_.state(correction_.tube) == core::TubeState::kAbsent)) {
      tell("--correct: " + drivers::in_quotes(options_.correct) +
           ", expected ROW,COLUMN of a tube that stands");
      return false;
    }
    return true;
  }

  bool outputs_fit() {
    if (!options_.overlay.empty() && !options_.average && stills_.size() > 1) {
      tell("--overlay: one picture for " + std::to_string(stills_.size()) +
           " poses, expected one still or --average");
      return false;
    }
    if (const std::string clash = find_output_conflict(options_); !clash.empty()) {
      tell(clash);
      return false;
    }
    if (const std::string wrong = why_no_png("--overlay", options_.overlay); !wrong.empty()) {
      tell(wrong);
      return false;
    }
    return true;
  }

  /// One pose, with its rows and its text.
  ExitStatus take(StillAverager& averager, std::span<const Still> stills) {
    const StillsRead read = averager.read(stills);
    PoseRow row{stills.front().name(), nullptr, core::math::Matrix6d::Zero(), file_.has_tool, true};
    ExitStatus status = read.status;
    std::string message = read.message;
    TubesFound tubes;
    if (status == ExitStatus::kDone) {
      tubes = find_tubes(stills, read.picture);
      status = tubes.status;
      message = tubes.message;
    }
    if (status == ExitStatus::kDone) {
      core::pose::PictureOptions how;
      how.pose.method = options_.method;
      how.rims.edge.method = options_.edge;
      how.only_start = options_.only_start;
      if (settings().edges.initial_threshold > 0) {
        how.scan.initial_threshold = settings().edges.initial_threshold;
      }
      outcome_ = core::pose::estimate_from_picture(read.picture, model_, map_, tubes.places, how,
                                                   *workspace_);
      if (outcome_.has_value() && tubes.tool && !(*tubes.tool == outcome_.pose.estimate.nearest)) {
        message = row.image + ": no pose: it would be under " +
                  drivers::address_text(outcome_.pose.estimate.nearest) +
                  ", and the tracking sees " + drivers::address_text(*tubes.tool);
      } else if (outcome_.has_value()) {
        row.estimate = &outcome_.pose.estimate;
        row.covariance = outcome_.pose.estimate.covariance;
        add_calibrations(how.pose.rims, row);
        row.has_tube = !starts_.empty() &&
                       map_.state(outcome_.pose.estimate.nearest) != core::TubeState::kAbsent;
        text_ += pose_text({row, outcome_, model_, map_, static_cast<std::int32_t>(stills.size()),
                            read.frame_shift_px, read.field_shift_px, options_.total,
                            middle_of(tubes.places)});
        if (!options_.correct.empty()) {
          text_ +=
              correction_text(core::verification::correct_position(
                                  model_, row.estimate->T_sheet_tool, row.covariance, correction_),
                              correction_);
        }
        draw(averager);
        ++poses_;
      } else {
        message = row.image + ": " + explain(outcome_, tubes.places);
      }
    }
    append_pose_row(poses_csv_, row);
    append_covariance_row(covariances_csv_, row);
    if (!message.empty()) {
      tell(message);
    }
    return status == ExitStatus::kDone && row.estimate == nullptr ? ExitStatus::kJobFailed : status;
  }

  /// The tubes in stills of one pose; what one or two clicks do not tell, or none, the lattice
  /// does.
  TubesFound find_tubes(std::span<const Still> stills,
                        const core::picture::AveragedPicture& picture) {
    TubesFound tubes;
    if (!starts_.empty()) {
      tubes = tubes_->find(stills);
    }
    if (tubes.status != ExitStatus::kDone || cold_ == nullptr ||
        (!starts_.empty() && !tubes_->was_clicked(stills.front()))) {
      return tubes;
    }
    ColdTubes cold = starts_.empty() ? cold_->find_middle(picture) : cold_->find(picture, starts_);
    if (!cold.message.empty()) {
      tubes.status = ExitStatus::kJobFailed;
      tubes.message = stills.front().name() + ": no pose: " + cold.message;
    }
    tubes.places = std::move(cold.places);
    return tubes;
  }

  /// The tube-end that places count from where no address was given.
  [[nodiscard]] std::optional<std::array<double, 2>> middle_of(const PictureStarts& places) const {
    if (!starts_.empty() || places.empty()) {
      return std::nullopt;
    }
    return std::array{places.front().u_px, places.front().v_px};
  }

  /// With `--total`, the calibrations' share of the covariance.
  void add_calibrations(const core::pose::RimBundleOptions& how, PoseRow& row) {
    if (options_.total) {
      const auto share = core::pose::calibration_covariance(model_, workspace_->rims, *row.estimate,
                                                            calibrations_, how, workspace_->pose);
      if (share) {
        row.covariance += *share;
      } else {
        tell(row.image +
             ": the calibrations' share of the uncertainty cannot be computed and is "
             "left out");
      }
    }
  }

  void draw(const StillAverager& averager) {
    if (!options_.overlay.empty()) {
      overlay_ = draw_pose(averager.picture(), outcome_, workspace_->rims, model_, file_.has_tool,
                           overlay_pixels_);
    }
  }

  bool write() {
    if (!write_table(options_.csv, std::string(kPoseHeader) + '\n' + poses_csv_) ||
        !write_table(options_.covariance,
                     std::string(kCovarianceHeader) + '\n' + covariances_csv_)) {
      return false;
    }
    std::string message;
    if (overlay_.pixels != nullptr && !drivers::write_png(options_.overlay, overlay_, message)) {
      tell(message);
      return false;
    }
    return true;
  }

  static bool write_table(const std::string& path, const std::string& text) {
    drivers::AtomicFile file;
    if (path.empty()) {
      return true;
    }
    if (!open_output(file, path) || !file.write(std::string_view(text)) || !file.commit()) {
      tell(file.message());
      return false;
    }
    return true;
  }

  const PoseCommandOptions& options_;
  drivers::SessionFile file_;
  core::tubesheet::SheetMap map_;
  core::pose::PoseModel model_;
  FrameRange frames_;  ///< of recordings; by default the first frame alone
  std::vector<Still> stills_;
  PictureStarts starts_;
  std::unique_ptr<ColdStart> cold_;  ///< where fewer than three places are given
  std::optional<StillTubes> tubes_;
  core::pose::CalibrationUncertainty calibrations_;
  core::verification::CorrectionRequest correction_;
  core::pose::PictureOutcome outcome_;
  std::unique_ptr<core::pose::PictureWorkspace> workspace_ =
      std::make_unique<core::pose::PictureWorkspace>();
  std::string poses_csv_;
  std::string covariances_csv_;
  std::string text_;
  std::vector<std::uint8_t> overlay_pixels_;
  core::RgbImageView overlay_;
  std::int32_t poses_ = 0;
};

}  // namespace

ExitStatus run_pose(const PoseCommandOptions& options) {
  return std::make_unique<PoseRun>(options)->run();
}

}  // namespace tubesight::board
