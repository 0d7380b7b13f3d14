#include "core/lighting/level_control.h"

#include <algorithm>
#include <cstdint>

#include <gtest/gtest.h>

namespace tubesight::core::lighting {
namespace {

/// A lamp with a lag over tube-ends of some reflectance, sixty fields a second.
class LitSheet : public testing::Test {
 protected:
  void begin(double level, double lag_s) {
    control_.begin(static_cast<std::int32_t>(level));
    wanted_ = static_cast<std::int32_t>(level);
    shine_ = level;
    lag_s_ = lag_s;
  }

  /// Tube-ends of 1000 permille's contrast `full`, half of them brighter by a half.
  void run(double seconds, double full, std::int32_t most = 1000) {
    constexpr double kSpan_s = 1.0 / 60.0;
    least_ = 1'000;
    most_ = 0;
    turns_ = 0;
    for (int i = 0; i < static_cast<int>(seconds * 60.0); ++i) {
      shine_ += (wanted_ - shine_) * (kSpan_s / (kSpan_s + lag_s_));
      Field field;
      now_ += std::chrono::nanoseconds(16'666'667);
      field.mid_exposure = now_;
      field.lamp_permille = wanted_;
      contrast_ = full * shine_ / 1000.0;
      TubeLightList tubes;
      for (int tube = 0; tube < 10; ++tube) {
        const double light = std::min(contrast_ * (tube % 2 == 0 ? 0.75 : 1.25), 235.0);
        static_cast<void>(
            tubes.try_push_back({{tube, 0}, static_cast<std::int32_t>(light * 16.0)}));
      }
      const std::int32_t next = control_.follow(field, tubes, most);
      const int way = next > wanted_ ? 1 : next < wanted_ ? -1 : 0;
      turns_ += way != 0 && way == -last_way_ ? 1 : 0;
      last_way_ = way != 0 ? way : last_way_;
      wanted_ = next;
      least_ = std::min(least_, wanted_);
      most_ = std::max(most_, wanted_);
    }
  }

  LevelControl control_;
  FieldTime now_{0};
  std::int32_t wanted_ = 0;
  double shine_ = 0.0;
  double lag_s_ = 0.0;
  double contrast_ = 0.0;  ///< mean of the last field
  std::int32_t least_ = 0;
  std::int32_t most_ = 0;
  int turns_ = 0;  ///< from brighter to dimmer or back
  int last_way_ = 0;
};

TEST_F(LitSheet, IsLedFromGlareToWhatIsWanted) {
  begin(1000, 0.1);
  run(6.0, 400.0);
  EXPECT_GT(contrast_, 70.0);
  EXPECT_LT(contrast_, 155.0);
  const std::int32_t settled = wanted_;
  run(30.0, 400.0);
  EXPECT_EQ(wanted_, settled);
}

TEST_F(LitSheet, DoesNotHuntAfterStepsOfReflectance) {
  for (const double lag_s : {0.0, 0.1, 0.3, 0.6}) {
    begin(500, lag_s);
    for (const double full : {200.0, 90.0, 700.0, 150.0, 320.0}) {
      run(10.0, full);
      EXPECT_LE(turns_, 2) << "lag " << lag_s << " s, full " << full;
      run(20.0, full);
      EXPECT_EQ(turns_, 0) << "lag " << lag_s << " s, full " << full;
      EXPECT_EQ(least_, most_) << "no limit cycle; lag " << lag_s << " s, full " << full;
      if (full > 100.0) {
        EXPECT_GE(contrast_, 69.0) << "lag " << lag_s << " s, full " << full;
      }
      EXPECT_LE(contrast_, 165.0) << "lag " << lag_s << " s, full " << full;
    }
  }
}

TEST_F(LitSheet, LeavesWhatIsGoodEnoughAlone) {
  begin(600, 0.1);
  run(5.0, 180.0);  // 108 grey levels
  EXPECT_EQ(wanted_, 600);
  run(5.0, 230.0);  // 138
  EXPECT_EQ(wanted_, 600);
  run(5.0, 130.0);  // 78
  EXPECT_EQ(wanted_, 600);
}

TEST_F(LitSheet, NeverPassesTheMost) {
  begin(600, 0.1);
  run(10.0, 50.0, 800);
  EXPECT_EQ(wanted_, 800);
}

TEST_F(LitSheet, ChangesSlowly) {
  begin(1000, 0.0);
  run(0.5, 800.0);
  EXPECT_GE(wanted_, 800) << "3 % in a tenth of a second";
}

TEST_F(LitSheet, WaitsWhileSomethingElseRulesTheLamp) {
  begin(600, 0.1);
  Field field;
  TubeLightList tubes;
  ASSERT_TRUE(tubes.try_push_back({{1, 1}, 30 * 16}));
  for (int i = 0; i < 300; ++i) {
    field.mid_exposure += std::chrono::milliseconds(17);
    field.lamp_permille = 300;  // a bulb that rests
    EXPECT_EQ(control_.follow(field, tubes, 1000), 600);
  }
}

TEST_F(LitSheet, StaysWithoutTubeEnds) {
  begin(600, 0.1);
  Field field;
  field.lamp_permille = 600;
  for (int i = 0; i < 300; ++i) {
    field.mid_exposure += std::chrono::milliseconds(17);
    EXPECT_EQ(control_.follow(field, {}, 1000), 600);
  }
}

}  // namespace
}  // namespace tubesight::core::lighting
