// A robot asks a running box for its pose over the link, and moves by the correction that it gets.

#include <chrono>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "core/base/transform.h"
#include "core/pose/pose_model.h"
#include "core/verification/position_correction.h"
#include "drivers/scenario/scenario_file.h"
#include "drivers/simulated/simulated_world.h"
#include "tests/drivers/modbus/serial_robot.h"
#include "tests/system/daemon.h"

namespace tubesight::tests {
namespace {

using core::verification::correct_position;
using SheetTool = core::Transform<core::frames::Sheet, core::frames::Tool>;

constexpr double kLength = 1e4;  // registers a millimetre
constexpr double kAngle = 1e5;   // and a degree

constexpr int kRefused = 4;  // pose_result
constexpr int kMoving = 2;   // pose_reason

/// Value `at` of the block from `first`, a register of two words.
double value(const Bytes& answer, int first, int at, double per_unit) {
  const auto raw =
      static_cast<std::int32_t>(long_at(answer, static_cast<std::size_t>(2 + 2 * (at - first))));
  return raw / per_unit;
}

class RobotPose : public ::testing::Test {
 protected:
  /// The plant of the first run; the tool rests beside the tube's centre, turned and leaning.
  void SetUp() override {
    std::ifstream file(TUBESIGHT_SOURCE_DIR "/docs/examples/steam-generator.toml");
    const std::string example{std::istreambuf_iterator<char>(file), {}};
    const std::string scenario = box_.folder().write(
        "leaning.toml", example.substr(0, example.find("[[step]]")) +
                            "offset_mm = [1.1, -0.7]\nheading_deg = 30\nlean_deg = [0.6, -0.4]\n"
                            "[[step]]\nrest_s = 20\n");
    drivers::Messages messages;
    ASSERT_TRUE(drivers::load_scenario(scenario, {-1, true}, *scenario_, messages))
        << messages.front();
    ASSERT_TRUE(world_->configure(scenario_->scenario));
    box_.write_simulated_settings(
        "script = true\n[link]\nkind = \"modbus\"\nbaud = 115200\nparity = \"none\"\nunit = 17\n"
        "device = \"" +
            line_.device() + "\"\n",
        scenario);
    ASSERT_TRUE(box_.start_and_wait()) << box_.said();
  }

  [[nodiscard]] std::uint32_t word(std::uint8_t low) const {
    const Bytes answer = ask(line_, {3, 1, low, 0, 1});  // 256 + low
    return answer.size() == 4 ? answer[2] * 256U + answer[3] : 0xFFFF;
  }

  /// Asks for the pose and waits for the result: the registers 424 to 463.
  [[nodiscard]] Bytes ask_for_pose() const {
    constexpr std::uint8_t kPoseBit = 8;
    constexpr std::uint8_t kAcknowledge = 400 - 256;
    EXPECT_EQ(ask(line_, {6, 1, 320 - 256, 0, kPoseBit}).size(), 5U);
    for (int i = 0; i < 500 && (word(kAcknowledge) & kPoseBit) == 0; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    Bytes answer = ask(line_, {3, 1, 424 - 256, 0, 40});
    EXPECT_EQ(ask(line_, {6, 1, 320 - 256, 0, 0}).size(), 5U);
    EXPECT_EQ(word(424 - 256), 0U) << "gone once its bit is cleared";
    answer.resize(82);
    return answer;
  }

  Pty line_;
  Daemon box_;
  std::unique_ptr<drivers::ScenarioFile> scenario_ = std::make_unique<drivers::ScenarioFile>();
  std::unique_ptr<drivers::SimulatedWorld> world_ = std::make_unique<drivers::SimulatedWorld>();
};

TEST_F(RobotPose, TheCorrectionBringsTheAxisThroughTheTubeInTheToolsFrame) {
  ASSERT_NE(box_.wait_for("\"state\":\"tracking\"", std::chrono::seconds(20)).find("\"tracking\""),
            std::string::npos);

  Bytes told = ask_for_pose();
  for (int i = 0; i < 20 && told[3] == kRefused && told[5] == kMoving; ++i) {
    told = ask_for_pose();  // a track that has just begun does not know yet that it is at rest
  }

  const auto length = [&](int at) { return value(told, 424, at, kLength); };
  ASSERT_EQ(told[3], 1) << "pose_result: confirmed; pose_reason: " << int{told[5]};
  EXPECT_EQ(told[2 + 2 * (457 - 424) + 1], 7) << "pose_valid: pose, tube, correction";
  const core::TubeAddress tube{static_cast<std::int32_t>(value(told, 424, 428, 1.0)),
                               static_cast<std::int32_t>(value(told, 424, 430, 1.0))};
  EXPECT_EQ(tube, (core::TubeAddress{40, 60}));
  const auto& plant = scenario_->scenario.told;
  const auto model = core::pose::make_pose_model(plant.camera, plant.tool, plant.tubesheet);
  ASSERT_TRUE(model);
  const SheetTool seen(
      core::rotation_from_degrees({value(told, 424, 438, kAngle), value(told, 424, 440, kAngle),
                                   value(told, 424, 442, kAngle)}),
      Eigen::Vector3d(length(432), length(434), length(436)));
  const Eigen::Vector3d move(length(458), length(460), length(462));
  const auto wanted = [&](const SheetTool& tool) {
    return correct_position(
               *model, tool, core::math::Matrix6d::Zero(),
               {.tube = tube, .goal = core::verification::CorrectionGoal::kAxisThrough})
        .move.translation_mm();
  };
  // By the pose of the very answer, and by the truth of the plant.
  EXPECT_LT((move - wanted(seen)).norm(), 0.05) << move.transpose();
  EXPECT_LT((move - wanted(world_->truth_of(60).T_sheet_tool)).norm(), 0.05) << move.transpose();
  EXPECT_GT(move.norm(), 1.0) << "there was something to correct";
}

}  // namespace
}  // namespace tubesight::tests
