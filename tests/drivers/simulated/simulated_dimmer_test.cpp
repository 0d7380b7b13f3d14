#include "drivers/simulated/simulated_dimmer.h"

#include <memory>

#include <gtest/gtest.h>

#include "tests/hal/dimmer_contract.h"
#include "tests/support/simulated_bench.h"

namespace tubesight::drivers {
namespace {

class SimulatedMaker {
 public:
  SimulatedMaker()
      : scenario_(std::make_unique<Scenario>()), world_(std::make_unique<SimulatedWorld>()) {
    tests::make_ordinary_scenario(*scenario_);
    EXPECT_TRUE(world_->configure(*scenario_));
  }
  SimulatedDimmer& dimmer() { return dimmer_; }
  SimulatedWorld& world() { return *world_; }

 private:
  std::unique_ptr<Scenario> scenario_;
  std::unique_ptr<SimulatedWorld> world_;
  SimulatedDimmer dimmer_{*world_};
};

}  // namespace
}  // namespace tubesight::drivers

namespace tubesight::support {
INSTANTIATE_TYPED_TEST_SUITE_P(Simulated, DimmerContract, drivers::SimulatedMaker);
}  // namespace tubesight::support

namespace tubesight::drivers {
namespace {

TEST(SimulatedDimmer, SetsTheWorldsLamp) {
  SimulatedMaker maker;
  EXPECT_EQ(maker.world().lamp_permille(), 1000) << "the scenario's";
  ASSERT_TRUE(maker.dimmer().start());
  EXPECT_EQ(maker.world().lamp_permille(), 0);
  ASSERT_TRUE(maker.dimmer().set_level(420));
  EXPECT_EQ(maker.world().lamp_permille(), 420);
  maker.dimmer().stop();
  EXPECT_EQ(maker.world().lamp_permille(), 0);
}

TEST(SimulatedDimmer, ABrokenOneLeavesTheLampAsItIs) {
  SimulatedMaker maker;
  ASSERT_TRUE(maker.dimmer().start());
  ASSERT_TRUE(maker.dimmer().set_level(420));
  maker.dimmer().break_down(core::Error::kDisconnected);

  const auto set = maker.dimmer().set_level(900);

  ASSERT_FALSE(set);
  EXPECT_EQ(set.error(), core::Error::kDisconnected);
  EXPECT_EQ(maker.world().lamp_permille(), 420);
  maker.dimmer().repair();
  EXPECT_TRUE(maker.dimmer().set_level(900));
}

}  // namespace
}  // namespace tubesight::drivers
