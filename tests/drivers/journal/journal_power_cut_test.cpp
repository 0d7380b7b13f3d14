// The power goes after any write, and takes what was not synced with it or not.

#include <gtest/gtest.h>

#include "tests/drivers/journal/power_cut_bench.h"

namespace tubesight {
namespace {

TEST_F(JournalPowerCut, LosesNoRowThatWasToldSafe) {
  support::RecordingVfs vfs;
  write(vfs, 240);

  EXPECT_EQ(count_losses(vfs.events(), 100, 1), 0) << "seed 1";
}

TEST_F(JournalPowerCut, IsFoundOutWhereNothingIsSynced) {
  support::RecordingVfs vfs;
  vfs.leave_out_syncs();
  write(vfs, 40);

  EXPECT_GT(count_losses(vfs.events(), 20, 3), 2) << "of ten that lose what was not synced";
}

}  // namespace
}  // namespace tubesight
