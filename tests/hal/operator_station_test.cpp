#include "hal/operator_station.h"

#include "tests/hal/operator_station_contract.h"
#include "tests/support/fake_operator_station.h"

namespace tubesight::support {
namespace {

class FakeMaker {
 public:
  hal::OperatorStation& station() { return fake_; }
  void say(const core::Event& event) { fake_.say(event); }
  [[nodiscard]] std::size_t replies() const { return fake_.replies().size(); }
  [[nodiscard]] std::size_t pictures() const { return fake_.shown().size(); }

 private:
  FakeOperatorStation fake_;
};

INSTANTIATE_TYPED_TEST_SUITE_P(Fake, OperatorStationContract, FakeMaker);

TEST(FakeOperatorStation, GoesOnAfterSomethingWasDropped) {
  FakeOperatorStation fake;
  ASSERT_TRUE(fake.start());
  fake.say_error(core::Error::kDataLoss);
  fake.say({});

  const auto dropped = fake.poll_event();
  ASSERT_FALSE(dropped);
  EXPECT_EQ(dropped.error(), core::Error::kDataLoss);
  const auto sound = fake.poll_event();
  ASSERT_TRUE(sound);
  EXPECT_TRUE(sound->has_value());
}

TEST(FakeOperatorStation, SaysWhenItIsGoneAndDeliversWhenItIsBack) {
  FakeOperatorStation fake;
  ASSERT_TRUE(fake.start());
  fake.say({});
  fake.connect(false);

  const auto gone = fake.poll_event();
  ASSERT_FALSE(gone);
  EXPECT_EQ(gone.error(), core::Error::kDisconnected);
  EXPECT_FALSE(fake.send_reply({}));
  EXPECT_FALSE(fake.show({}, {}));
  fake.connect(true);
  const auto back = fake.poll_event();
  ASSERT_TRUE(back);
  EXPECT_TRUE(back->has_value());
}

TEST(FakeOperatorStation, RefusesRepliesThatFindNoRoom) {
  FakeOperatorStation fake;
  ASSERT_TRUE(fake.start());
  fake.limit_replies(1);

  EXPECT_TRUE(fake.send_reply({}));
  const auto full = fake.send_reply({});
  ASSERT_FALSE(full);
  EXPECT_EQ(full.error(), core::Error::kBufferTooSmall);
}

TEST(FakeOperatorStation, StartsAfterAFailedStart) {
  FakeOperatorStation fake;
  fake.fail_start(core::Error::kIo);

  EXPECT_FALSE(fake.start());
  EXPECT_TRUE(fake.start());
}

}  // namespace
}  // namespace tubesight::support
