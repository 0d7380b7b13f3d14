#include "hal/clock.h"

#include <chrono>

#include "tests/hal/clock_contract.h"
#include "tests/support/fake_clock.h"

namespace tubesight::support {
namespace {

using std::chrono::milliseconds;

class FakeMaker {
 public:
  [[nodiscard]] const hal::Clock& clock() const { return fake_; }
  void pass() { fake_.advance(milliseconds(1)); }

 private:
  FakeClock fake_;
};

INSTANTIATE_TYPED_TEST_SUITE_P(Fake, ClockContract, FakeMaker);

TEST(FakeClock, MovesOnlyWhenTold) {
  FakeClock clock;

  EXPECT_EQ(clock.now(), core::FieldTime(0));
  clock.advance(milliseconds(20));
  EXPECT_EQ(clock.now(), milliseconds(20));
  EXPECT_EQ(clock.now(), milliseconds(20));
}

}  // namespace
}  // namespace tubesight::support
