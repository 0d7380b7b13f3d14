#include "board/bench/calibrate/base_command.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <vector>

#include "board/bench/calibrate/base_pairs_file.h"
#include "board/bench/calibrate/base_picture.h"
#include "board/bench/calibrate/base_text.h"
#include "board/bench/calibrate/calibration_file.h"
#include "board/bench/output/output_paths.h"
#include "board/bench/output/text_output.h"
#include "core/calibration/base_calibration.h"
#include "core/tubesheet/sheet_places.h"
#include "core/tubesheet/tubesheet_setup.h"
#include "drivers/files/decimal.h"
#include "drivers/settings/session_settings.h"

namespace tubesight::board {
namespace {

using core::calibration::BaseCalibration;
using core::calibration::BaseRefusal;
using core::calibration::PairOutcomes;
using core::calibration::PlaceList;

/// Where no tubesheet is given: a generator of the source's size [Fallon sec. 5.3: "over a three
/// meter diameter workspace"] around the middle of the pairs.
constexpr double kGeneratorRadius_mm = 1500.0;
constexpr double kGeneratorStep_mm = 100.0;

/// Steps through rows or columns so that both ends are there and at most 31 of them: 31 squared
/// places fit.
std::vector<std::int32_t> some_of(const std::array<std::int32_t, 2>& range) {
  constexpr std::int32_t kMost = 30;
  const std::int32_t count = std::min(kMost, range[1] - range[0]);
  std::vector<std::int32_t> some = {range[0]};
  for (std::int32_t i = 1; i <= count; ++i) {
    some.push_back(range[0] + static_cast<std::int32_t>(std::lround(
                                  static_cast<double>(range[1] - range[0]) * i / count)));
  }
  return some;
}

/// Some hundreds of tubes all over a sheet.
void sample_sheet(const core::TubesheetSettings& sheet, PlaceList& places) {
  for (const std::int32_t row : some_of(sheet.rows)) {
    for (const std::int32_t column : some_of(sheet.columns)) {
      if (core::tubesheet::check_address(sheet, {row, column}) !=
          core::tubesheet::AddressFault::kMissing) {
        const auto [x, y] = core::tubesheet::center_mm(sheet, {row, column});
        static_cast<void>(places.try_push_back({x, y}));
      }
    }
  }
}

void sample_disc(const core::calibration::BasePairs& pairs, PlaceList& places) {
  Eigen::Vector2d least = Eigen::Vector2d::Constant(1e9);
  Eigen::Vector2d most = -least;
  for (const auto& pair : pairs) {
    least = least.cwiseMin(pair.T_sheet_tool.translation_mm().head<2>());
    most = most.cwiseMax(pair.T_sheet_tool.translation_mm().head<2>());
  }
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  if (!pairs.empty()) {
    middle = 0.5 * (least + most);
  }
  const auto steps = static_cast<int>(kGeneratorRadius_mm / kGeneratorStep_mm);
  for (int x = -steps; x <= steps; ++x) {
    for (int y = -steps; y <= steps; ++y) {
      if (x * x + y * y <= steps * steps) {
        static_cast<void>(places.try_push_back(
            {middle.x() + kGeneratorStep_mm * x, middle.y() + kGeneratorStep_mm * y}));
      }
    }
  }
}

/// One run of the command; on the heap, as pairs and settings are large.
class BaseRun {
 public:
  explicit BaseRun(const CalibrateBaseOptions& options) : options_(options) {
    knowledge_.level = options.level;
    knowledge_.tool_known = options.tool_known;
  }

  ExitStatus run() {
    if (!open()) {
      return ExitStatus::kWrongInput;
    }
    core::calibration::calibrate_base(pairs_.pairs, knowledge_, places_.view(), base_, outcomes_);
    if (base_.refusal != BaseRefusal::kNone) {
      tell(options_.pairs + ": " + why_no_base(base_, generator()));
      return ExitStatus::kJobFailed;
    }
    bool turned = true;
    for (const auto& pair : pairs_.pairs) {
      turned = turned && pair.turned;
    }
    const BaseReport report{
        base_,
        outcomes_,
        pairs_.pairs,
        pairs_.names,
        knowledge_,
        core::calibration::next_place(base_, knowledge_, turned, places_.view(), places_.view())};
    std::string text = base_text(report);
    if (!options_.touches.empty() && !compare(text)) {
      return ExitStatus::kJobFailed;
    }
    if (!write_out(text)) {
      return ExitStatus::kJobFailed;
    }
    std::string message;
    if (!options_.picture.empty() &&
        !write_base_picture(options_.picture, report, places_.view(), message)) {
      tell(message);
      return ExitStatus::kJobFailed;
    }
    return options_.out.empty() || write_settings(options_.out, base_settings(report))
               ? ExitStatus::kDone
               : ExitStatus::kJobFailed;
  }

 private:
  [[nodiscard]] std::string generator() const {
    return options_.sheet.empty() ? "a generator of 3 m around the pairs, expected --sheet if it "
                                    "is another and"
                                  : "the tubesheet";
  }

  bool open() {
    const std::string clash = find_clash(
        std::array{NamedPath{"the pairs", options_.pairs}, NamedPath{"--touches", options_.touches},
                   NamedPath{"--sheet", options_.sheet}},
        std::array{NamedPath{"--out", options_.out}, NamedPath{"--picture", options_.picture}});
    if (!clash.empty()) {
      tell(clash);
      return false;
    }
    std::vector<std::string> messages;
    bool good = read_base_pairs(options_.pairs, pairs_, messages);
    if (!options_.touches.empty()) {
      good = read_base_pairs(options_.touches, touches_, messages) && good;
    }
    if (!options_.sheet.empty()) {
      constexpr drivers::NeededTables kNeeds{false, false, true, false};
      good = static_cast<bool>(
                 drivers::load_session_settings(options_.sheet, kNeeds, file_, messages)) &&
             good;
    }
    tell(messages);
    if (good) {
      tell_more(options_.pairs + ": read, " + std::to_string(pairs_.pairs.size()) + " pairs");
    }
    if (good && options_.sheet.empty()) {
      sample_disc(pairs_.pairs, places_);
    } else if (good) {
      sample_sheet(file_.settings.tubesheet, places_);
    }
    return good;
  }

  /// The base that dockings tell: places alone, and level, as the source's old way has it.
  bool compare(std::string& text) {
    for (auto& pair : touches_.pairs) {
      pair.turned = false;
    }
    core::calibration::BaseKnowledge knowledge;
    knowledge.level = true;
    PairOutcomes outcomes;
    auto touched = std::make_unique<BaseCalibration>();
    core::calibration::calibrate_base(touches_.pairs, knowledge, places_.view(), *touched,
                                      outcomes);
    if (touched->refusal == BaseRefusal::kNotLevel) {
      knowledge.level = false;
      core::calibration::calibrate_base(touches_.pairs, knowledge, places_.view(), *touched,
                                        outcomes);
    }
    if (touched->refusal != BaseRefusal::kNone) {
      tell(options_.touches + ": " + why_no_base(*touched, generator()));
      return false;
    }
    double squares = 0.0;
    double worst = 0.0;
    for (const Eigen::Vector2d& at : places_) {
      const Eigen::Vector3d place(at.x(), at.y(), base_.height_mm);
      const Eigen::Vector3d off =
          touched->fit.pose.T_sheet_base * (base_.fit.pose.T_sheet_base.inverse() * place) - place;
      squares += off.head<2>().squaredNorm();
      worst = std::max(worst, off.head<2>().norm());
    }
    drivers::print(text,
                   "by %d dockings, %s across %.3f mm RMS (one sigma), %.3f mm at worst; the "
                   "two bases differ by %.3f mm RMS, %.3f mm at worst\n",
                   touched->used, knowledge.level ? "level  " : "leaning", touched->mean.across_mm,
                   touched->worst.across_mm, std::sqrt(squares / places_.size()), worst);
    return true;
  }

  const CalibrateBaseOptions& options_;
  core::calibration::BaseKnowledge knowledge_;
  NamedPairs pairs_;
  NamedPairs touches_;
  drivers::SessionFile file_;
  PlaceList places_;
  BaseCalibration base_;
  PairOutcomes outcomes_;
};

}  // namespace

ExitStatus run_calibrate_base(const CalibrateBaseOptions& options) {
  return std::make_unique<BaseRun>(options)->run();
}

}  // namespace tubesight::board
