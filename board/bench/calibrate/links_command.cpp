#include "board/bench/calibrate/links_command.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <numbers>
#include <vector>

#include "board/bench/calibrate/base_pairs_file.h"
#include "board/bench/calibrate/base_text.h"
#include "board/bench/calibrate/calibration_file.h"
#include "board/bench/calibrate/links_picture.h"
#include "board/bench/output/output_paths.h"
#include "board/bench/output/text_output.h"
#include "core/calibration/base_calibration.h"
#include "core/calibration/link_calibration.h"
#include "core/math/rotation.h"
#include "drivers/files/decimal.h"
#include "drivers/scenario/scenario_robot.h"
#include "drivers/settings/toml_writer.h"

namespace tubesight::board {
namespace {

using core::calibration::BaseRefusal;
using core::calibration::LinkRefusal;
using core::kinematics::Link;

constexpr double kDegrees = 180.0 / std::numbers::pi;

/// One run of the command; on the heap, as pairs and workspace are large.
class LinksRun {
 public:
  explicit LinksRun(const CalibrateLinksOptions& options) : options_(options) {}

  ExitStatus run() {
    if (!open()) {
      return ExitStatus::kWrongInput;
    }
    core::calibration::PlaceList places;
    for (const auto& pair : pairs_.pairs) {
      static_cast<void>(places.try_push_back(pair.T_sheet_tool.translation_mm().head<2>()));
    }
    if (places.empty()) {
      tell(options_.pairs + ": no links: there are no pairs, expected 12 or more");
      return ExitStatus::kJobFailed;
    }
    core::calibration::calibrate_base(pairs_.pairs, {}, places.view(), base_, outcomes_);
    if (base_.refusal != BaseRefusal::kNone) {
      tell(options_.pairs + ": " + why_no_base(base_, "the pairs' own places"));
      return ExitStatus::kJobFailed;
    }
    core::calibration::calibrate_links(arm_, pairs_.pairs, pairs_.joints, base_.good.view(),
                                       base_.fit.pose, {}, workspace_, links_);
    if (links_.refusal != LinkRefusal::kNone) {
      static_cast<void>(draw());
      tell(options_.pairs + ": no links: " + why());
      return ExitStatus::kJobFailed;
    }
    tell_links();
    if (!write_out(text_) || !draw()) {
      return ExitStatus::kJobFailed;
    }
    return options_.out.empty() || write_settings(options_.out, settings_text())
               ? ExitStatus::kDone
               : ExitStatus::kJobFailed;
  }

 private:
  bool open() {
    if (options_.arm.empty()) {
      tell("--arm: is missing, expected a settings file whose [robot] has links");
      return false;
    }
    const std::string clash = find_clash(
        std::array{NamedPath{"the pairs", options_.pairs}, NamedPath{"--arm", options_.arm}},
        std::array{NamedPath{"--out", options_.out}, NamedPath{"--picture", options_.picture}});
    if (!clash.empty()) {
      tell(clash);
      return false;
    }
    std::vector<std::string> messages;
    bool good = read_base_pairs(options_.pairs, pairs_, messages);
    good = static_cast<bool>(drivers::load_arm(options_.arm, arm_, messages)) && good;
    if (good && pairs_.joint_columns != arm_.joints()) {
      messages.push_back(options_.pairs + ":1: " + std::to_string(pairs_.joint_columns) +
                         " columns joint_1_deg and so on, expected " +
                         std::to_string(arm_.joints()) + ", as " + options_.arm + " has links");
      good = false;
    }
    tell(messages);
    if (good) {
      tell_more(options_.pairs + ": read, " + std::to_string(pairs_.pairs.size()) + " pairs");
    }
    return good;
  }

  /// The picture, where one is asked for and there is something to be seen; also of links that are
  /// refused as no better, as that shows why.
  bool draw() {
    std::string message;
    if (options_.picture.empty() || workspace_.misses.empty() ||
        write_links_picture(options_.picture, pairs_, links_, workspace_.misses, message)) {
      return true;
    }
    tell(message);
    return false;
  }

  [[nodiscard]] std::string why() const {
    std::string text;
    switch (links_.refusal) {
      case LinkRefusal::kNone: break;
      case LinkRefusal::kTooFew:
        drivers::print(text, "%d pairs are in use, expected 12 or more", base_.used);
        break;
      case LinkRefusal::kForeignJoints:
        text = "at the joint angles of pair " +
               pairs_.names[static_cast<std::size_t>(links_.pair)] +
               " this arm is not where the robot says, expected the links, the order and the "
               "signs of the robot's own";
        break;
      case LinkRefusal::kNoBetter:
        drivers::print(text,
                       "half of the pairs foretell the others to %.3f mm with them and to %.3f mm "
                       "by the base alone, expected a fifth less at least; more pairs, or "
                       "corrections by zones",
                       links_.with_links_mm, links_.base_alone_mm);
        break;
    }
    return text;
  }

  void append_number(const char* name, std::size_t at, double unit) {
    drivers::print(text_, "  %s %.4f +- %.4f", name, links_.values[at] * unit,
                   links_.sigmas[at] * unit);
  }

  void tell_links() {
    drivers::print(text_, "links of %d joints from %d pairs\n", arm_.joints(), base_.used);
    drivers::print(text_,
                   "  half of the pairs foretells the others to %.3f mm RMS, by the base alone to "
                   "%.3f mm\n",
                   links_.with_links_mm, links_.base_alone_mm);
    std::size_t at = 0;
    for (std::int32_t i = 0; i < arm_.joints(); ++i) {
      drivers::print(text_, "  link %d", i + 1);
      append_number("a", at, 1.0);
      append_number("d", at + 1, 1.0);
      append_number("mm, twist", at + 2, kDegrees);
      append_number("zero", at + 3, kDegrees);
      text_ += links_.standing[static_cast<std::size_t>(i)] ? " deg; stands still\n" : " deg\n";
      at += core::calibration::kLinkNumbers;
    }
    text_ += "  tip";
    append_number("x", at, 1.0);
    append_number("y", at + 1, 1.0);
    append_number("z", at + 2, 1.0);
    text_ +=
        " mm\n  all are true less given; a sigma as large as before (0.4 mm, 0.023 deg, 0.040 "
        "deg, 0.6 mm) says that the pairs tell nothing of that number\n";
  }

  [[nodiscard]] std::string settings_text() const {
    drivers::TomlWriter toml(drivers::TomlManner::kPlain);
    std::string links = "[";
    for (const Link& link : links_.arm.links()) {
      links += links.size() > 1 ? ", [" : "[";
      const std::array numbers = {link.a_mm,
                                  link.d_mm,
                                  link.twist_rad * kDegrees,
                                  link.offset_rad * kDegrees,
                                  link.lowest_rad * kDegrees,
                                  link.highest_rad * kDegrees};
      for (std::size_t i = 0; i < numbers.size(); ++i) {
        links += (i > 0 ? ", " : "") + drivers::toml_number(numbers[i], toml.manner());
      }
      links += "]";
    }
    const Eigen::Vector3d tip = links_.arm.T_last_tool().translation_mm();
    toml.table("robot");
    toml.raw("links", links + "]");
    toml.numbers("tool_mm", std::array{tip.x(), tip.y(), tip.z()});
    const Eigen::Vector3d place = links_.pose.T_sheet_base.translation_mm();
    const auto angles = core::math::angles_of(links_.pose.T_sheet_base.rotation());
    toml.table("base");
    toml.numbers("position_mm", std::array{place.x(), place.y(), place.z()});
    toml.numbers("rotation_deg",
                 std::array{angles[0] * kDegrees, angles[1] * kDegrees, angles[2] * kDegrees});
    return toml.take();
  }

  const CalibrateLinksOptions& options_;
  NamedPairs pairs_;
  core::kinematics::SerialArm arm_;
  core::calibration::BaseCalibration base_;
  core::calibration::PairOutcomes outcomes_;
  core::calibration::LinkWorkspace workspace_;
  core::calibration::LinkCalibration links_;
  std::string text_;
};

}  // namespace

ExitStatus run_calibrate_links(const CalibrateLinksOptions& options) {
  return std::make_unique<LinksRun>(options)->run();
}

}  // namespace tubesight::board
