// As journal_power_cut_test.cpp, ten times as often.

#include <gtest/gtest.h>

#include "tests/drivers/journal/power_cut_bench.h"

namespace tubesight {
namespace {

TEST_F(JournalPowerCut, LosesNoneInAThousandCuts) {
  support::RecordingVfs vfs;
  write(vfs, 2400);

  EXPECT_EQ(count_losses(vfs.events(), 1000, 2), 0) << "seed 2";
}

}  // namespace
}  // namespace tubesight
