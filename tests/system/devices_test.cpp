#include <string>

#include <gtest/gtest.h>

#include "tests/system/program.h"

namespace tubesight::tests {
namespace {

TEST(DevicesProgram, ListsPortsOrSaysThatThereAreNone) {
  const support::TemporaryFolder folder;

  const ProgramRun run = run_tubesight(folder, {"devices"});

  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_TRUE(run.out == "no serial ports\n" || run.out.starts_with("serial ports, ")) << run.out;
  EXPECT_EQ(run.err, "");
}

TEST(DevicesProgram, TakesNoArguments) {
  const support::TemporaryFolder folder;

  EXPECT_EQ(run_tubesight(folder, {"devices", "all"}).status, 2);
}

}  // namespace
}  // namespace tubesight::tests
