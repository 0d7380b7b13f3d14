#include "board/bench/budget/budget_command.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <memory>
#include <numbers>
#include <string_view>
#include <tuple>
#include <vector>

#include "board/bench/budget/base_scenarios.h"
#include "board/bench/budget/vision_budget.h"
#include "board/bench/output/line_plot.h"
#include "board/bench/output/output_paths.h"
#include "board/bench/output/progress_line.h"
#include "board/bench/output/text_output.h"
#include "board/bench/pose/calibration_quality.h"
#include "core/overlay/palette.h"
#include "drivers/files/decimal.h"
#include "drivers/settings/session_settings.h"

namespace tubesight::board {
namespace {

using core::kinematics::ErrorMagnitudes;
using core::overlay::Rgb;

constexpr std::array<std::string_view, kVisionItems> kVisionNames = {
    "EFL",        "h_sx",    "c_u",           "c_v",
    "k",          "k2",      "camera",        "tool: tip",
    "tool: axis", "picture", "tubes' places", "vision together"};
constexpr std::array<double, 6> kTouches_mm = {0.05, 0.1, 0.25, 0.5, 1.0, 2.0};
constexpr std::array<Rgb, 7> kColours = {{{20, 120, 220},
                                          {30, 150, 60},
                                          {230, 140, 20},
                                          {210, 40, 40},
                                          {130, 60, 180},
                                          {60, 60, 60},
                                          {0, 160, 160}}};

/// Over all distances alike.
BudgetShare mean_of(const ScenarioResult& result) {
  double across = 0.0;
  double along = 0.0;
  for (const RadiusErrors& radius : result.radii) {
    across += radius.across_rms_mm * radius.across_rms_mm;
    along += radius.along_rms_mm * radius.along_rms_mm;
  }
  const auto count = static_cast<double>(result.radii.size());
  return {std::sqrt(across / count), std::sqrt(along / count)};
}

/// An item of the kinematic chain [Fallon sec. 1.1], alone.
struct ChainItem {
  std::string_view name;
  void (*take)(const ErrorMagnitudes& all, ErrorMagnitudes& alone);
};
constexpr std::array<ChainItem, 10> kChain = {{
    {"1 base",
     [](const ErrorMagnitudes& all, ErrorMagnitudes& alone) {
       alone.base_mm = all.base_mm;
       alone.base_deg = all.base_deg;
     }},
    {"2 lengths",
     [](const ErrorMagnitudes& all, ErrorMagnitudes& alone) { alone.length_mm = all.length_mm; }},
    {"2 twists",
     [](const ErrorMagnitudes& all, ErrorMagnitudes& alone) { alone.twist_deg = all.twist_deg; }},
    {"3 zeros",
     [](const ErrorMagnitudes& all, ErrorMagnitudes& alone) { alone.zero_deg = all.zero_deg; }},
    {"3 resolution", [](const ErrorMagnitudes& all,
                        ErrorMagnitudes& alone) { alone.resolution_deg = all.resolution_deg; }},
    {"3 backlash", [](const ErrorMagnitudes& all,
                      ErrorMagnitudes& alone) { alone.backlash_deg = all.backlash_deg; }},
    {"4 tool",
     [](const ErrorMagnitudes& all, ErrorMagnitudes& alone) {
       alone.tool_mm = all.tool_mm;
       alone.tool_deg = all.tool_deg;
     }},
    {"5 workpiece",
     [](const ErrorMagnitudes& all, ErrorMagnitudes& alone) {
       alone.workpiece_mm = all.workpiece_mm;
       alone.workpiece_deg = all.workpiece_deg;
     }},
    {"6 support",
     [](const ErrorMagnitudes& all, ErrorMagnitudes& alone) {
       alone.support_mm = all.support_mm;
       alone.support_deg = all.support_deg;
     }},
    {"7 deflection",
     [](const ErrorMagnitudes& all, ErrorMagnitudes& alone) {
       alone.flexibility_share = all.flexibility_share;
       alone.tool_mass_share = all.tool_mass_share;
     }},
}};

/// Ways that are tried: the chain's items and all of it, ways to calibrate a base, touches.
constexpr double kTries =
    kChain.size() + 1 + std::tuple_size_v<decltype(source_methods())> + 3 + kTouches_mm.size();

/// One run of the command; on the heap, as the settings are large.
class BudgetRun {
 public:
  explicit BudgetRun(const BudgetOptions& options) : options_(options) {
    scenario_.robots = options.robots;
    scenario_.seed = static_cast<std::uint64_t>(options.seed);
  }

  ExitStatus run() {
    if (!open()) {
      return ExitStatus::kWrongInput;
    }
    if (!tell_vision()) {
      return ExitStatus::kJobFailed;
    }
    tell_chain();
    tell_methods();
    tell_sweep();
    progress_.erase();
    if (!write_out(text_)) {
      return ExitStatus::kJobFailed;
    }
    std::string message;
    if (!options_.plot.empty() && !write_plot(options_.plot, panels_, message)) {
      tell(message);
      return ExitStatus::kJobFailed;
    }
    return ExitStatus::kDone;
  }

 private:
  bool open() {
    const std::string clash = find_clash(std::array{NamedPath{"the settings", options_.settings}},
                                         std::array{NamedPath{"--plot", options_.plot}});
    if (!clash.empty()) {
      tell(clash);
      return false;
    }
    constexpr drivers::NeededTables kNeeds{true, true, true, false};
    drivers::Messages messages;
    const bool good = static_cast<bool>(
        drivers::load_session_settings(options_.settings, kNeeds, file_, messages));
    tell(messages);
    if (good) {
      tell_files(file_.files);
    }
    return good;
  }

  void append_row(std::string_view name, const BudgetShare& share, const char* remark) {
    drivers::print(text_, "  %-24.*s %9.4f %9.4f%s\n", static_cast<int>(name.size()), name.data(),
                   share.across_mm, share.along_mm, remark);
  }

  void show(const std::string& what) {
    progress_.update(ProgressLine::Clock::now(), "budget: " + what,
                     static_cast<double>(tries_++) / kTries);
  }

  bool tell_vision() {
    const auto model = core::pose::make_pose_model(file_.settings.camera, file_.settings.tool,
                                                   file_.settings.tubesheet);
    VisionAssumptions assumptions;
    assumptions.height_mm = options_.height_mm;
    if (!model) {
      tell(options_.settings + ": camera, tool and tubesheet make no pose");
      return false;
    }
    const auto budget =
        vision_budget(*model, file_.settings.tubesheet, uncertainty_of(file_), assumptions);
    if (!budget) {
      tell(options_.settings +
           ": no budget: fewer than four tube-ends are in the picture below the middle of the "
           "sheet, expected another --height-mm, or the [tool] of this camera");
      return false;
    }
    drivers::print(text_,
                   "tool's tip by vision, %g mm below the sheet, %d tube-ends in the picture; one "
                   "sigma, mm\n  %-24s %9s %9s\n",
                   options_.height_mm, budget->tubes, "", "across", "along");
    const std::string picture = "  assumed: " + drivers::number_text(assumptions.center_px) +
                                " px of a centre, each coordinate";
    const std::string places = "  assumed: " + drivers::number_text(assumptions.tube_place_mm) +
                               " mm of a tube-end, each axis";
    for (std::size_t i = 0; i < kVisionItems; ++i) {
      const auto item = static_cast<VisionItem>(i);
      const bool camera = item <= VisionItem::kCamera;
      const bool tool = item == VisionItem::kToolPlace || item == VisionItem::kToolAxis;
      append_row(kVisionNames[i], budget->shares[i],
                 camera && !file_.camera_quality.has_sigma ? "  taken as exact: no [camera_quality]"
                 : tool && !file_.tool_quality.has_sigma   ? "  taken as exact: no [tool_quality]"
                 : item == VisionItem::kToolAxis           ? "  where the axis meets the sheet"
                 : item == VisionItem::kPicture            ? picture.c_str()
                 : item == VisionItem::kTubePlaces         ? places.c_str()
                                                           : "");
    }
    vision_ = budget->shares[static_cast<std::size_t>(VisionItem::kTogether)];
    return true;
  }

  void tell_chain() {
    drivers::print(
        text_,
        "tool's tip by the kinematic chain, Cobra-like arm, base calibrated by vision at "
        "8 places; %d robots, RMS over the generator, mm\n",
        options_.robots);
    BaseMethod perfect = source_methods()[0];
    perfect.sigma_mm = 0.0;
    for (const ChainItem& item : kChain) {
      ScenarioOptions alone = scenario_;
      alone.magnitudes = {};
      item.take(scenario_.magnitudes, alone.magnitudes);
      show("the chain's " + std::string(item.name));
      append_row(item.name, mean_of(try_method(perfect, alone)), "");
    }
    show("the chain together");
    append_row("chain together", mean_of(try_method(perfect, scenario_)), "");
    if (file_.base_quality.has_sigma) {
      const auto& s = file_.base_quality.sigma;
      drivers::print(text_,
                     "  [base_quality]           place %.3f, %.3f, %.3f mm, turn %.4f, %.4f, %.4f "
                     "deg; one sigma\n",
                     s[0], s[1], s[2], s[3], s[4], s[5]);
    }
  }

  void tell_methods() {
    text_ += "tool's error after calibrating the base so; RMS mm, in brackets 95 % within\n";
    drivers::print(text_, "  %-32s", "across, at mm from the base");
    for (const double radius : kScenarioRadii_mm) {
      drivers::print(text_, "  %11.0f", radius);
    }
    text_ += '\n';
    Panel across{
        "Error across the tubes after calibrating the base", "mm from the base", "mm RMS", {}};
    Panel along{"Error along the tubes", "mm from the base", "mm RMS", {}};
    std::string heights;
    std::vector<BaseMethod> methods;
    for (const BaseMethod& method : source_methods()) {
      methods.push_back(method);
    }
    const double vision_mm = vision_.across_mm / std::numbers::sqrt2;
    methods.push_back({"vision, by these settings", true, vision_mm, 8, 0, 0});
    methods.push_back({"the same, 40 zone corrections", true, vision_mm, 8, 0, 40});
    methods.push_back({"the same, links of 40 pairs", true, vision_mm, 8, 40, 0});
    for (std::size_t m = 0; m < methods.size(); ++m) {
      const std::string name(methods[m].name);
      show(name);
      const ScenarioResult result = try_method(methods[m], scenario_);
      Series series{name, kColours[m], {}};
      Series height{name, kColours[m], {}};
      drivers::print(text_, "  %-32s", name.c_str());
      drivers::print(heights, "  %-32s", name.c_str());
      for (std::size_t r = 0; r < kScenarioRadii_mm.size(); ++r) {
        const RadiusErrors& errors = result.radii[r];
        drivers::print(text_, "  %.2f (%.2f)", errors.across_rms_mm, errors.across_95_mm);
        drivers::print(heights, "  %11.2f", errors.along_rms_mm);
        series.points.push_back({kScenarioRadii_mm[r], errors.across_rms_mm});
        height.points.push_back({kScenarioRadii_mm[r], errors.along_rms_mm});
      }
      drivers::print(text_, result.refused > 0 ? "  %d refused\n" : "\n", result.refused);
      heights += '\n';
      across.series.push_back(series);
      along.series.push_back(height);
      means_.push_back(mean_of(result));
    }
    text_ += "  along\n" + heights;
    panels_.push_back(across);
    panels_.push_back(along);
  }

  void tell_sweep() {
    text_ +=
        "three touches, by the error of a touch (one sigma, each axis); RMS over the generator, "
        "mm\n";
    Panel panel{"Three touches, by the error of a touch", "mm, one sigma", "mm RMS across", {}};
    Series touches{"touch", kColours[3], {}};
    Series vision{"vision, 0.25 mm", kColours[0], {}};
    for (const double sigma : kTouches_mm) {
      show("touches of " + drivers::number_text(sigma) + " mm");
      const BudgetShare mean = mean_of(try_method({"touch", false, sigma, 3, 0, 0}, scenario_));
      drivers::print(text_, "  %5.2f  across %.3f  along %.3f\n", sigma, mean.across_mm,
                     mean.along_mm);
      touches.points.push_back({sigma, mean.across_mm});
      vision.points.push_back({sigma, means_[0].across_mm});
    }
    drivers::print(text_, "  vision: across %.3f  along %.3f\n", means_[0].across_mm,
                   means_[0].along_mm);
    panel.series = {touches, vision};
    panels_.push_back(panel);
  }

  const BudgetOptions& options_;
  ScenarioOptions scenario_;
  drivers::SessionFile file_;
  BudgetShare vision_;
  std::vector<BudgetShare> means_;
  std::vector<Panel> panels_;
  std::string text_;
  ProgressLine progress_;
  int tries_ = 0;  ///< of kTries
};

}  // namespace

ExitStatus run_budget(const BudgetOptions& options) {
  return std::make_unique<BudgetRun>(options)->run();
}

}  // namespace tubesight::board
