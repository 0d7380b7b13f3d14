#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "tests/system/program.h"

namespace tubesight::tests {
namespace {

TEST(DevicesProgram, ListsEveryKindOrSaysThatThereAreNone) {
  const support::TemporaryFolder folder;

  const ProgramRun run = run_tubesight(folder, {"devices"});

  EXPECT_EQ(run.status, 0) << run.err;
  std::size_t before = 0;
  for (const std::string kind : {"cameras", "GPIO chips", "PWM chips", "serial ports"}) {
    const std::size_t none = run.out.find("no " + kind + "\n");
    const std::size_t some = run.out.find(kind + ", by the ");
    EXPECT_NE(none == std::string::npos, some == std::string::npos) << kind << ": " << run.out;
    EXPECT_GE(std::min(none, some), before) << "in this order";
    before = std::min(none, some);
  }
  EXPECT_EQ(run.err, "");
}

TEST(DevicesProgram, TakesNoArguments) {
  const support::TemporaryFolder folder;

  EXPECT_EQ(run_tubesight(folder, {"devices", "all"}).status, 2);
}

}  // namespace
}  // namespace tubesight::tests
