#include "board/visionbox/script_ports.h"

#include <array>
#include <chrono>
#include <cstdint>

#include <gtest/gtest.h>

#include "drivers/control/socket_station.h"

namespace tubesight::board {
namespace {

constexpr std::int32_t kSide = 8;

/// Plays two fields; before the first the robot says row 1 and the operator row 2.
class TalkingPlayer final : public FieldPlayer {
 public:
  core::Result<void> start(drivers::Messages&) override { return {}; }
  void stop() override {}
  core::Result<void> next(std::int32_t, PlayedField& out, drivers::Messages&) override {
    if (made_ == 2) {
      return core::Unexpected(core::Error::kEndOfData);
    }
    out.field = {};
    out.field.pixels = {pixels_.data(), kSide, kSide, kSide, 0, 1};
    out.field.mid_exposure = std::chrono::milliseconds(5 + 5 * made_);
    out.field.sequence = made_;
    out.events.clear();
    if (made_++ == 0) {
      core::Event event;
      event.id = 1;
      event.origin = core::EventOrigin::kRobot;
      static_cast<void>(out.events.try_push_back(event));
      event.id = 2;
      event.origin = core::EventOrigin::kOperator;
      static_cast<void>(out.events.try_push_back(event));
    }
    return {};
  }
  core::FieldTime span() const override { return std::chrono::milliseconds(5); }
  bool has_lamp() const override { return false; }
  std::int32_t fields_ahead() const override { return 1; }

 private:
  std::int32_t made_ = 0;
  std::array<std::uint8_t, kSide * kSide> pixels_{};
};

class ScriptPorts : public ::testing::Test {
 protected:
  ScriptPorts() {
    EXPECT_TRUE(source_.start());
    EXPECT_TRUE(socket_station_.start());
    EXPECT_TRUE(source_.grab_for(std::chrono::seconds(10)));
  }
  /// The id of what the port says; 0: nothing.
  template <typename Port>
  static std::int64_t said_by(Port& port) {
    const auto event = port.poll_event();
    EXPECT_TRUE(event);
    return event && event->has_value() ? (*event)->id : 0;
  }

  static PlayedSourceSettings settings() {
    PlayedSourceSettings settings;
    settings.loop = false;
    settings.width_px = kSide;
    settings.height_px = kSide;
    return settings;
  }

  TalkingPlayer player_;
  PlayedSource source_{player_, settings(), [](const std::string&) {}};
  drivers::SocketStation socket_station_;
};

TEST_F(ScriptPorts, RobotAndOperatorSayTheirRowsInTheirOrder) {
  ScriptedLink link(source_);
  ScriptedStation station(source_, socket_station_, true);
  EXPECT_TRUE(link.start());

  EXPECT_EQ(said_by(station), 0) << "the robot's row is before";
  EXPECT_EQ(said_by(link), 1);
  EXPECT_EQ(said_by(link), 0);
  EXPECT_EQ(said_by(station), 2);
  EXPECT_EQ(said_by(station), 0);
}

TEST_F(ScriptPorts, BesideARealRobotTheScriptsIsSilent) {
  ScriptedStation station(source_, socket_station_, false);

  EXPECT_EQ(said_by(station), 2);
  EXPECT_EQ(said_by(station), 0);
  EXPECT_EQ(source_.next_said(), nullptr) << "nothing is left to block what comes";
}

}  // namespace
}  // namespace tubesight::board
