#include "board/bench/replay/visit_log.h"

#include <gtest/gtest.h>

namespace tubesight::board {
namespace {

using core::FieldTime;
using std::chrono::milliseconds;

constexpr FieldTime kSpan = milliseconds(20);

core::Sighting at(milliseconds time, core::TubeAddress tube, bool aligned) {
  core::Sighting sighting;
  sighting.time = time;
  sighting.tool_known = true;
  sighting.tool = tube;
  sighting.aligned = aligned;
  sighting.offset_um_q8 = 256 * 100;
  sighting.height_um_q8 = 256 * 60000;
  return sighting;
}

TEST(VisitLog, CountsTheTimeUntilTheNextField) {
  VisitLog log;
  log.add(at(milliseconds(100), {4, 6}, true), kSpan);
  log.add(at(milliseconds(120), {4, 6}, true), kSpan);

  ASSERT_EQ(log.visits().size(), 1U);
  EXPECT_EQ(log.visits()[0].tube, (core::TubeAddress{4, 6}));
  EXPECT_EQ(log.visits()[0].from, milliseconds(100));
  EXPECT_EQ(log.visits()[0].dwell(), milliseconds(40));
  EXPECT_EQ(log.visits()[0].fields, 2);
  EXPECT_EQ(log.visits()[0].offset_sum_um_q8, 2 * 256 * 100);
}

TEST(VisitLog, TakesOnlyWhatTheBoxVouchesFor) {
  VisitLog log;
  log.add(at(milliseconds(100), {4, 6}, false), kSpan);

  EXPECT_TRUE(log.visits().empty());
}

TEST(VisitLog, BridgesAShortInterruption) {
  VisitLog log;
  log.add(at(milliseconds(0), {4, 6}, true), kSpan);
  log.add(at(milliseconds(520), {4, 6}, true), kSpan);  // 500 ms after the end of the first

  EXPECT_EQ(log.visits().size(), 1U);
}

TEST(VisitLog, EndsAVisitByALongInterruption) {
  VisitLog log;
  log.add(at(milliseconds(0), {4, 6}, true), kSpan);
  log.add(at(milliseconds(521), {4, 6}, true), kSpan);

  EXPECT_EQ(log.visits().size(), 2U);
}

TEST(VisitLog, EndsAVisitByAnotherTube) {
  VisitLog log;
  log.add(at(milliseconds(0), {4, 6}, true), kSpan);
  log.add(at(milliseconds(20), {4, 7}, true), kSpan);
  log.add(at(milliseconds(40), {4, 6}, true), kSpan);

  ASSERT_EQ(log.visits().size(), 3U);
  EXPECT_EQ(log.visits()[1].tube, (core::TubeAddress{4, 7}));
}

}  // namespace
}  // namespace tubesight::board
