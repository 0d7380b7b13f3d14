#include "hal/watchdog.h"

#include "tests/hal/watchdog_contract.h"
#include "tests/support/fake_watchdog.h"

namespace tubesight::support {
namespace {

class FakeMaker {
 public:
  hal::Watchdog& watchdog() { return fake_; }

 private:
  FakeWatchdog fake_;
};

INSTANTIATE_TYPED_TEST_SUITE_P(Fake, WatchdogContract, FakeMaker);

TEST(FakeWatchdog, FailsOnceWhenToldAndGoesOn) {
  FakeWatchdog fake;
  fake.fail_start(core::Error::kIo);
  EXPECT_FALSE(fake.start(std::chrono::seconds(15)));
  ASSERT_TRUE(fake.start(std::chrono::seconds(15)));
  fake.fail_feed();
  EXPECT_EQ(fake.feed().error(), core::Error::kDisconnected);
  EXPECT_TRUE(fake.feed());
  fake.stop();
  EXPECT_EQ(fake.meals(), 1);
  EXPECT_EQ(fake.stops(), 1);
}

}  // namespace
}  // namespace tubesight::support
