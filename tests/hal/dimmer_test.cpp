#include "hal/dimmer.h"

#include "tests/hal/dimmer_contract.h"
#include "tests/support/fake_dimmer.h"

namespace tubesight::support {
namespace {

class FakeMaker {
 public:
  hal::Dimmer& dimmer() { return fake_; }

 private:
  FakeDimmer fake_;
};

INSTANTIATE_TYPED_TEST_SUITE_P(Fake, DimmerContract, FakeMaker);

TEST(FakeDimmer, FailsOnceWhenToldAndGoesOn) {
  FakeDimmer fake;
  fake.fail_start(core::Error::kIo);
  EXPECT_FALSE(fake.start());
  ASSERT_TRUE(fake.start());
  ASSERT_TRUE(fake.set_level(100));
  fake.fail_level(core::Error::kDisconnected);

  const auto set = fake.set_level(200);

  ASSERT_FALSE(set);
  EXPECT_EQ(set.error(), core::Error::kDisconnected);
  EXPECT_EQ(fake.level_permille(), 100);
  EXPECT_TRUE(fake.set_level(300));
  fake.stop();
  EXPECT_EQ(fake.levels(), (std::vector<std::int32_t>{100, 300, 0}));
}

}  // namespace
}  // namespace tubesight::support
