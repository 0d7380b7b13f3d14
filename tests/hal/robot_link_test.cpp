#include "hal/robot_link.h"

#include "tests/hal/robot_link_contract.h"
#include "tests/support/fake_robot_link.h"

namespace tubesight::support {
namespace {

class FakeMaker {
 public:
  static constexpr int kStartTubes = core::kMaxStartPoints;

  hal::RobotLink& link() { return fake_; }
  void say(const core::Event& event) { fake_.say(event); }
  [[nodiscard]] std::size_t replies() const { return fake_.replies().size(); }
  [[nodiscard]] std::size_t sightings() const { return fake_.sightings().size(); }

 private:
  FakeRobotLink fake_;
};

INSTANTIATE_TYPED_TEST_SUITE_P(Fake, RobotLinkContract, FakeMaker);

TEST(FakeRobotLink, GoesOnAfterAGarbledMessage) {
  FakeRobotLink fake;
  ASSERT_TRUE(fake.start());
  fake.say_error(core::Error::kDataLoss);
  fake.say({});

  const auto garbled = fake.poll_event();
  ASSERT_FALSE(garbled);
  EXPECT_EQ(garbled.error(), core::Error::kDataLoss);
  const auto sound = fake.poll_event();
  ASSERT_TRUE(sound);
  EXPECT_TRUE(sound->has_value());
}

TEST(FakeRobotLink, SaysWhenTheRobotIsGoneAndDeliversWhenItIsBack) {
  FakeRobotLink fake;
  ASSERT_TRUE(fake.start());
  fake.say({});
  fake.connect(false);

  const auto gone = fake.poll_event();
  ASSERT_FALSE(gone);
  EXPECT_EQ(gone.error(), core::Error::kDisconnected);
  EXPECT_FALSE(fake.send_reply({}));
  EXPECT_FALSE(fake.send_sighting({}));
  fake.connect(true);
  const auto back = fake.poll_event();
  ASSERT_TRUE(back);
  EXPECT_TRUE(back->has_value());
}

TEST(FakeRobotLink, ASlowLineRefusesRepliesAndLeavesOutSightings) {
  FakeRobotLink fake;
  ASSERT_TRUE(fake.start());
  fake.limit_replies(1);

  EXPECT_TRUE(fake.send_reply({}));
  const auto full = fake.send_reply({});
  ASSERT_FALSE(full);
  EXPECT_EQ(full.error(), core::Error::kBufferTooSmall);
  EXPECT_TRUE(fake.send_sighting({}));
  EXPECT_EQ(fake.replies().size(), 1u);
  EXPECT_TRUE(fake.sightings().empty());
}

TEST(FakeRobotLink, StartsAfterAFailedStart) {
  FakeRobotLink fake;
  fake.fail_start(core::Error::kIo);

  EXPECT_FALSE(fake.start());
  EXPECT_TRUE(fake.start());
}

}  // namespace
}  // namespace tubesight::support
