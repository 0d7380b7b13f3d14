// What a robot can order of a running box over the link: its pose with the correction to move by, a
// tube at a place of the picture, the lamp, an end to a verdict.

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>
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

constexpr std::uint8_t kPickBit = 2;
constexpr std::uint8_t kLampBit = 4;
constexpr std::uint8_t kPoseBit = 8;
constexpr std::uint8_t kAcknowledgeBit = 16;
constexpr int kRefused = 4;  // pose_result
constexpr int kMoving = 2;   // pose_reason

/// Value `at` of the block from `first`, a register of two words.
double value(const Bytes& answer, int first, int at, double per_unit) {
  const auto raw =
      static_cast<std::int32_t>(long_at(answer, static_cast<std::size_t>(2 + 2 * (at - first))));
  return raw / per_unit;
}

class RobotCommands : public ::testing::Test {
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
    // One correction, at the centre of tube (40, 60).
    box_.folder().write("zones.csv",
                        "sheet_x_mm,sheet_y_mm,dx_mm,dy_mm,dz_mm,sigma_mm\n"
                        "1524.0,1016.0,0.8,-0.4,1.2,0.1\n");
    box_.write_simulated_settings(
        "script = true\n[link]\nkind = \"modbus\"\nbaud = 115200\nparity = \"none\"\nunit = 17\n"
        "device = \"" +
            line_.device() + "\"\n[pairs]\nfile = \"pairs.csv\"\n[zones]\nfile = \"zones.csv\"\n",
        scenario);
    ASSERT_TRUE(box_.start_and_wait()) << box_.said();
    const std::string status = box_.wait_for("\"state\":\"tracking\"", std::chrono::seconds(20));
    ASSERT_NE(status.find("\"tracking\""), std::string::npos) << box_.said();
  }

  [[nodiscard]] std::uint32_t word(std::uint8_t low) const {
    const Bytes answer = ask(line_, {3, 1, low, 0, 1});  // 256 + low
    return answer.size() == 4 ? answer[2] * 256U + answer[3] : 0xFFFF;
  }

  /// Sets a bit of `command` and waits until the result is there.
  void order(std::uint8_t bit) const {
    EXPECT_EQ(ask(line_, {6, 1, 320 - 256, 0, bit}).size(), 5U);
    for (int i = 0; i < 500 && (word(400 - 256) & bit) == 0; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    EXPECT_EQ(word(400 - 256), bit) << "acknowledge";
    EXPECT_EQ(word(401 - 256), 0U) << "busy";
  }
  void clear_order() const {
    EXPECT_EQ(ask(line_, {6, 1, 320 - 256, 0, 0}).size(), 5U);
    EXPECT_EQ(word(400 - 256), 0U) << "acknowledge goes off with the bit";
  }

  /// Asks for the pose and waits for the result: the registers 424 to 463.
  [[nodiscard]] Bytes ask_for_pose() const {
    order(kPoseBit);
    Bytes answer = ask(line_, {3, 1, 424 - 256, 0, 40});
    clear_order();
    EXPECT_EQ(word(424 - 256), 0U) << "gone once its bit is cleared";
    answer.resize(82);
    return answer;
  }

  Pty line_;
  Daemon box_;
  std::unique_ptr<drivers::ScenarioFile> scenario_ = std::make_unique<drivers::ScenarioFile>();
  std::unique_ptr<drivers::SimulatedWorld> world_ = std::make_unique<drivers::SimulatedWorld>();
};

TEST_F(RobotCommands, TheCorrectionBringsTheAxisThroughTheTubeInTheToolsFrame) {
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

TEST_F(RobotCommands, WhatTheRobotTellsOfItsPoseIsKeptBesideTheBoxs) {
  // Place and angles and two joints: 1234.5678, -1, 960 mm; 30, 0, -0.00001 degrees; 10, -20
  // degrees.
  const Bytes tell = {16,   2,    88,   0,    18,   36,   0,    2,    0,    2,    0x00,
                      0xBC, 0x61, 0x4E, 0xFF, 0xFF, 0xD8, 0xF0, 0x00, 0x92, 0x7C, 0x00,
                      0x00, 0x2D, 0xC6, 0xC0, 0,    0,    0,    0,    0xFF, 0xFF, 0xFF,
                      0xFF, 0x00, 0x0F, 0x42, 0x40, 0xFF, 0xE1, 0x7B, 0x80};
  Bytes told;
  for (int i = 0; i < 20 && (i == 0 || (told[3] == kRefused && told[5] == kMoving)); ++i) {
    ASSERT_EQ(ask(line_, tell).size(), 5U);
    told = ask_for_pose();
    EXPECT_EQ(ask(line_, {3, 2, 88, 0, 2}), (Bytes{3, 4, 0, 0, 0, 0})) << "told of one pose alone";
  }
  ASSERT_EQ(told[3], 1) << "pose_result: confirmed; pose_reason: " << int{told[5]};
  static_cast<void>(ask_for_pose());  // of which the robot tells nothing

  // The registers 542 to 545, and bit 5 of 500.
  const auto counts = [&] { return ask(line_, {3, 2, 30, 0, 4}); };
  for (int i = 0; i < 100 && counts() != (Bytes{3, 8, 0, 0, 0, 1, 0, 0, 0, 0}); ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
  EXPECT_EQ(counts(), (Bytes{3, 8, 0, 0, 0, 1, 0, 0, 0, 0})) << "one written, none lost";
  EXPECT_EQ(ask(line_, {3, 1, 500 - 256, 0, 1}).at(3) & 32, 32) << "health_valid";
  const std::string text = box_.folder().read("pairs.csv");
  EXPECT_NE(
      text.find(",use,joint_1_deg,joint_2_deg\np1,1234.5678,-1.0000,960.0000,30.00000,0.00000,"
                "-0.00001,"),
      std::string::npos)
      << text;
  EXPECT_TRUE(text.ends_with(",1,10.00000,-20.00000\n")) << text;
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2);
  // Vision's part is what the robot was told.
  std::array<char, 64> seen{};
  std::snprintf(seen.data(), seen.size(), ",%.4f,%.4f,%.4f,", value(told, 424, 432, kLength),
                value(told, 424, 434, kLength), value(told, 424, 436, kLength));
  EXPECT_NE(text.find(seen.data()), std::string::npos) << text << seen.data();
  const std::string status = box_.ask({"status"}).out;
  EXPECT_NE(status.find("pairs.csv, 1 written"), std::string::npos) << status;
}

TEST_F(RobotCommands, ACorrectionByZonesIsToldForAnyTube) {
  // Function 23: the tube to 640, the block zone, 16 registers from 650.
  const auto ask_at = [&](std::uint8_t row, std::uint8_t column) {
    Bytes told = ask(line_, {23, 2, 138, 0, 16, 2, 128, 0, 4, 8, 0, 0, 0, row, 0, 0, 0, column});
    told.resize(34);
    return told;
  };
  Bytes there = ask_at(40, 60);
  for (int i = 0; i < 100 && there[3] == 0; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    there = ask_at(40, 60);
  }
  const auto at = [](const Bytes& told, int address) { return value(told, 650, address, kLength); };
  ASSERT_EQ(there[3], 1) << "zone_valid";
  EXPECT_EQ(long_at(there, 6), 40U) << "the tube, sent back";
  EXPECT_EQ(long_at(there, 10), 60U);
  // Nearly all of what was seen; some sizes of a millimetre and less beside 0.1 mm are expected.
  EXPECT_NEAR(at(there, 656), 0.8, 0.08);
  EXPECT_NEAR(at(there, 658), -0.4, 0.04);
  EXPECT_NEAR(at(there, 660), 1.2, 0.12);
  EXPECT_NEAR(at(there, 662), 0.1, 0.02);
  // Half a metre away there is less of it, and it is less sure; beyond the sheet nothing is known.
  const Bytes away = ask_at(60, 60);
  EXPECT_LT(at(away, 656), 0.7);
  EXPECT_GT(at(away, 656), 0.05);
  EXPECT_GT(at(away, 662), 0.2);
  const Bytes beyond = ask_at(40, 200);
  EXPECT_EQ(beyond[3], 0);
  EXPECT_EQ(long_at(beyond, 14), 0x80000000U);
}

TEST_F(RobotCommands, EachResultStaysUntilItsBitIsCleared) {
  // command_id 9, and the place 318, 190 in the picture, that of the tube the tool is under.
  ASSERT_EQ(ask(line_, {16,   1,    66,   0, 8, 16,   0,    0, 0, 9,    0xFF,
                        0xFF, 0xFF, 0xFF, 0, 4, 0xDA, 0x30, 0, 2, 0xE6, 0x30})
                .size(),
            5U);
  order(kPickBit);
  const Bytes pick = ask(line_, {4, 1, 408 - 256, 0, 12});
  ASSERT_EQ(pick.size(), 26U);
  EXPECT_EQ(pick[3], 1) << "pick_result";
  EXPECT_EQ(long_at(pick, 6), 9U) << "pick_id";
  EXPECT_EQ(long_at(pick, 10), 318'000U) << "the place, sent back";
  EXPECT_EQ(long_at(pick, 18), 40U);
  EXPECT_EQ(long_at(pick, 22), 60U);
  EXPECT_EQ(ask(line_, {4, 1, 408 - 256, 0, 12}), pick) << "as often as it is read";
  clear_order();
  EXPECT_EQ(word(408 - 256), 0U);

  ASSERT_EQ(ask(line_, {6, 1, 330 - 256, 3, 0xB6}).size(), 5U);  // 950 permille
  order(kLampBit);
  EXPECT_EQ(word(420 - 256), 1U) << "lamp_result";
  EXPECT_EQ(word(421 - 256), 950U) << "lamp_taken";
  clear_order();
  for (int i = 0; i < 100 && word(504 - 256) != 950; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_EQ(word(504 - 256), 950U) << "lamp_now";

  // A claim of (40, 60), its verdict, and nothing of it once it is acknowledged.
  ASSERT_EQ(ask(line_, {23, 0, 200, 0, 24, 1, 44, 0, 8,  16, 0, 0, 0,
                        7,  0, 0,   0, 40, 0, 0,  0, 60, 0,  0, 0, 1})
                .size(),
            50U);
  EXPECT_EQ(ask(line_, {3, 0, 204, 0, 1}).at(3) & 1, 1) << "a verdict is there";
  order(kAcknowledgeBit);
  clear_order();
  EXPECT_EQ(ask(line_, {3, 0, 204, 0, 2}), (Bytes{3, 4, 0, 0, 0, 0})) << "none";
}

}  // namespace
}  // namespace tubesight::tests
