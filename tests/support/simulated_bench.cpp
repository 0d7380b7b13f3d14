#include "tests/support/simulated_bench.h"

#include <chrono>
#include <cmath>

#include <gtest/gtest.h>

#include "core/kinematics/cobra_arm.h"
#include "core/rendering/truth.h"
#include "tests/support/source_camera.h"

namespace tubesight::tests {
namespace {

constexpr double kFieldsASecond = 60.0;

/// Clicks on the tube-end nearest to the optimum point and on two beside it, where they truly are.
void click(const core::rendering::Truth& truth,
           const core::Transform<core::frames::Sheet, core::frames::Tool>& T_sheet_tool,
           core::StartSettings& start) {
  const auto axis = truth.axis(T_sheet_tool);
  ASSERT_TRUE(axis);
  core::TubeAddress best{};
  double best_px = 1e9;
  for (std::int32_t row = -3; row <= 3; ++row) {
    for (std::int32_t column = -3; column <= 3; ++column) {
      const core::TubeAddress address{axis->nearest.address.row + row,
                                      axis->nearest.address.column + column};
      const auto image = truth.tube_image(T_sheet_tool, address);
      const double off_px = image ? std::hypot(image->center_px[0] - start.optimum_px[0],
                                               image->center_px[1] - start.optimum_px[1])
                                  : 1e9;
      if (off_px < best_px) {
        best = address;
        best_px = off_px;
      }
    }
  }
  start.tubes.clear();
  for (const core::TubeAddress address : {best, core::TubeAddress{best.row + 1, best.column},
                                          core::TubeAddress{best.row, best.column + 1}}) {
    const auto image = truth.tube_image(T_sheet_tool, address);
    ASSERT_TRUE(image);
    ASSERT_TRUE(start.tubes.try_push_back({address, image->center_px}));
  }
}

}  // namespace

void make_ordinary_scenario(drivers::Scenario& scenario) {
  core::CameraSettings& camera = scenario.scene.camera;
  camera = source_camera();
  scenario.scene.tool = {{-3.074, 31.629, 112.789}, {-0.0639, -0.8174, 47.9947}};
  core::TubesheetSettings& sheet = scenario.scene.sheet;
  sheet.row_step_mm = {0.0, 25.4};
  sheet.column_step_mm = {25.4, 0.0};
  sheet.bore_mm = 18.6;
  sheet.rows = {0, 120};
  sheet.columns = {0, 120};
  scenario.told.camera = camera;
  scenario.told.tool = scenario.scene.tool;
  scenario.told.tubesheet = sheet;
  scenario.told.start.window_px = {40, 40, 595, 330};
  scenario.told.start.optimum_px = {318.0, 190.0};
  scenario.video.length_s = 60.0;
}

drivers::SimulatedRobotSettings make_ordinary_robot() {
  drivers::SimulatedRobotSettings settings;
  settings.believed.arm = core::kinematics::cobra_arm();
  settings.believed.T_sheet_base = {Eigen::Matrix3d::Identity(),
                                    Eigen::Vector3d(700.0, 600.0, -1000.0)};
  settings.believed.flexibility = core::kinematics::cobra_flexibility();
  settings.believed.load = core::kinematics::cobra_load();
  settings.near_rad = core::kinematics::cobra_ready();
  settings.home = {1524.0, 1016.0, 40.0, 0.0, 0.0, 0.0};
  settings.limits = {150.0, 600.0, 6000.0};
  settings.claim_period_s = 0.25;
  return settings;
}

SimulatedBench::SimulatedBench()
    : robot_settings(make_ordinary_robot()),
      world_(std::make_unique<drivers::SimulatedWorld>()),
      robot_(std::make_unique<drivers::SimulatedRobot>()),
      session_(std::make_unique<core::session::Session<core::FixedPoint>>()) {
  make_ordinary_scenario(scenario);
}

void SimulatedBench::start(const drivers::LineNoise& noise) {
  ASSERT_TRUE(robot_->configure(robot_settings, scenario.told.tubesheet));
  const auto truth = std::make_unique<core::rendering::Truth>();
  ASSERT_TRUE(truth->configure(scenario.scene));
  click(*truth, robot_->pose_at(-1.0), scenario.told.start);
  grabber_ = std::make_unique<drivers::SimulatedFrameGrabber>(*world_, scenario);
  dimmer_ = std::make_unique<drivers::SimulatedDimmer>(*world_);
  link_ = std::make_unique<drivers::SimulatedRobotLink>(*robot_, noise);
  ASSERT_TRUE(grabber_->start());
  world_->steer(robot_.get());
  ASSERT_TRUE(session_->configure(scenario.told));
  ASSERT_TRUE(poses_.configure(scenario.told));
  clock_ = std::make_unique<drivers::SimulatedClock>(*grabber_);
  script_ = std::make_unique<board::SimulatedScript>(*grabber_);
  station_ = std::make_unique<board::ScriptedOperatorStation>(*script_);
  loop_ = std::make_unique<board::BoxLoop<core::FixedPoint>>(
      *session_,
      board::BoxPorts{grabber_.get(), clock_.get(), dimmer_.get(), link_.get(), station_.get()},
      board::BoxServices{
          .poses = &poses_, .view = nullptr, .overlay = nullptr, .lamp = lamp, .pairs = &pairs_});
  ASSERT_TRUE(loop_->start());
}

void SimulatedBench::step() {
  ASSERT_TRUE(loop_->turn(std::chrono::milliseconds(0))) << "the recording is too short";
  ASSERT_EQ(script_->next(), nullptr) << "the scenario speaks for the robot, which is here itself";
  EXPECT_EQ(loop_->counters().dimmer_errors, 0);
  const auto& axis = grabber_->last().truth.axis.nearest;
  wrong_ += sighting().aligned && sighting().tool != axis.address ? 1 : 0;
}

void SimulatedBench::run(double seconds) {
  const auto fields = static_cast<int>(seconds * kFieldsASecond + 0.5);
  for (int i = 0; i < fields && !testing::Test::HasFatalFailure(); ++i) {
    step();
  }
}

void SimulatedBench::run_to_rest() {
  while (!robot_->at_rest() && !testing::Test::HasFatalFailure()) {
    step();
  }
  run(0.5);
}

double SimulatedBench::grey() const {
  const core::ImageView frame = world_->frame();
  const auto& [left, top, right, bottom] = scenario.told.start.window_px;
  double sum = 0.0;
  for (std::int32_t v = top; v <= bottom; ++v) {
    for (std::int32_t u = left; u <= right; ++u) {
      sum += frame.pixels[static_cast<std::ptrdiff_t>(v) * frame.stride_px + u];
    }
  }
  return sum / ((right - left + 1.0) * (bottom - top + 1.0));
}

}  // namespace tubesight::tests
