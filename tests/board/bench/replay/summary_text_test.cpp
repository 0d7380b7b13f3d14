#include "board/bench/replay/summary_text.h"

#include <memory>

#include <gtest/gtest.h>

namespace tubesight::board {
namespace {

using core::Reason;
using core::TrackState;
using std::chrono::milliseconds;

core::Sighting aligned(int time_ms, core::TubeAddress tube) {
  core::Sighting sighting;
  sighting.time = milliseconds(time_ms);
  sighting.state = TrackState::kTracking;
  sighting.reason = Reason::kNone;
  sighting.tracked = 20;
  sighting.tool_known = true;
  sighting.tool = tube;
  sighting.aligned = true;
  sighting.offset_um_q8 = 256 * 250;     // 0.25 mm
  sighting.height_um_q8 = 256 * 60'000;  // 60 mm
  sighting.velocity_known = true;
  sighting.velocity_um_s = {0, 12'500};
  return sighting;
}

TEST(SummaryText, TellsAReplay) {
  ReplayStatistics statistics;
  const auto output = std::make_unique<core::session::Output>();
  core::Reply reply;
  reply.content = core::StartReply{};
  ASSERT_TRUE(output->replies.try_push_back(reply));
  output->sighting = aligned(0, {40, 60});
  statistics.add(*output);
  output->replies.clear();
  core::ClaimReply claim;
  claim.claimed = {40, 61};
  claim.verdict = core::ClaimVerdict::kContradicted;
  claim.tube = {40, 60};
  reply.at = milliseconds(300);
  reply.content = claim;
  ASSERT_TRUE(output->replies.try_push_back(reply));
  core::TubeSighting plug;
  plug.address = {41, -3};
  plug.plug = true;
  ASSERT_TRUE(output->tubes.try_push_back(plug));
  output->sighting = aligned(300, {40, 60});
  statistics.add(*output);
  output->replies.clear();
  output->sighting = aligned(600, {40, 61});
  statistics.add(*output);
  output->sighting = {};
  output->sighting.time = milliseconds(700);
  output->sighting.state = TrackState::kLost;
  output->sighting.reason = Reason::kJump;
  statistics.add(*output);
  statistics.finish();

  const std::string text = summary_text({"r.y4m", 635, 480, true, false}, statistics);

  EXPECT_EQ(text,
            "r.y4m: 4 fields of 635 x 480 pixels, interlaced, 0.800 s from 0.000 s\n"
            "  tracking        0.700 s   87.50 %  3 fields\n"
            "  degraded        0.000 s    0.00 %  0 fields\n"
            "  lost            0.100 s   12.50 %  1 field\n"
            "  waiting         0.000 s    0.00 %  0 fields\n"
            "  lost at 0.700 s for 0.100 s: jump: the picture contradicts any motion within the "
            "limits\n"
            "  start at 0.000 s taken\n"
            "  claims: 1, 0 confirmed, 1 contradicted, 0 unknown\n"
            "    at 0.300 s the robot claimed row 40 column 61, the box saw row 40 column 60\n"
            "  tube-ends measured: 20.0 a field\n"
            "  largest speed: 12.5 mm/s at 0.000 s\n"
            "  plugs recognised (row, column): (41, -3)\n"
            "  tubes passed in less than 0.2 s: 1: (40, 61)\n"
            "  tubes visited: 1\n"
            "       row  column      from_s     dwell_s  mean_offset_mm  mean_height_mm\n"
            "        40      60       0.000       0.600            0.25           60.00\n");
}

TEST(SummaryText, NamesTwentyTubesPassedAtMost) {
  ReplayStatistics statistics;
  const auto output = std::make_unique<core::session::Output>();
  for (int i = 0; i < 21; ++i) {
    output->sighting = aligned(20 * i, {7, i});
    statistics.add(*output);
  }
  statistics.finish();

  const std::string text = summary_text({"r.y4m", 64, 64, false, false}, statistics);

  EXPECT_NE(text.find("passed in less than 0.2 s: 21: (7, 0) (7, 1) "), std::string::npos) << text;
  EXPECT_NE(text.find(" (7, 19) ...\n"), std::string::npos) << text;
  EXPECT_EQ(text.find("(7, 20)"), std::string::npos) << text;
}

TEST(SummaryText, TellsWhyAStartWasRefused) {
  ReplayStatistics statistics;
  const auto output = std::make_unique<core::session::Output>();
  core::Reply reply;
  reply.content = core::StartReply{core::tracking::StartRefusal::kNoTubeThere};
  ASSERT_TRUE(output->replies.try_push_back(reply));
  statistics.add(*output);
  statistics.finish();

  const std::string text = summary_text({"r.y4m", 64, 64, false, true}, statistics);

  EXPECT_TRUE(
      text.starts_with("r.y4m: 1 field of 64 x 64 pixels, progressive, 0.000 s from "
                       "0.000 s (cut short)\n"))
      << text;
  EXPECT_NE(text.find("  start at 0.000 s refused: no-tube-there: no dark tube-end around a "
                      "click: plate, or no light of the lamp\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("  tubes visited: 0\n"), std::string::npos) << text;
}

}  // namespace
}  // namespace tubesight::board
