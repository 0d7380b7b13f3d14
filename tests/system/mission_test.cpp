// A mission in real time: tubesightd on a simulated sheet, and a robot that is not ours, by
// pymodbus, twenty times a second. A minute; by hand as many seconds as the environment says in
// TUBESIGHT_MISSION_S, an hour for the figures in docs/performance.md.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "drivers/control/json_line.h"
#include "drivers/scenario/scenario_file.h"
#include "drivers/simulated/simulated_world.h"
#include "tests/system/daemon.h"
#include "tests/system/mission_log.h"
#include "tests/system/tcp_line.h"

namespace tubesight::tests {
namespace {

constexpr int kTooOld = 2;  // verdict_reason
constexpr std::int64_t kOldest_ms = 250;
constexpr double kWithin_us = 50'000.0;  // claim_within_s
constexpr double kUsual_s = 60.0;

double mission_s() {
  const char* const told = std::getenv("TUBESIGHT_MISSION_S");
  return told == nullptr ? kUsual_s : std::atof(told);
}

/// The plant of the first run, in which the tool visits tube after tube.
std::string scenario_text(double seconds, const std::string& example) {
  constexpr double kRest_s = 10.0;  // in which the robot starts the box
  constexpr double kMove_s = 0.7;   // between neighbours
  constexpr double kMostVisits = 1000.0;
  const double pause_s = std::max(0.6, (seconds - kRest_s) / kMostVisits - kMove_s);
  return example.substr(0, example.find("[[step]]")) +
         "[video]\nwindow_margin_px = 24\nlength_s = " + std::to_string(seconds + 30.0) +
         // A black stretch that no track outlives: the robot starts the box anew.
         "\n[[fault]]\nkind = \"black\"\nat_s = 20\nfor_s = 1.5" +
         "\n[[step]]\nrest_s = " + std::to_string(kRest_s) +
         "\n[[step]]\ntour = [[40, 60], [64, 99]]\nclaim = false\npause_s = " +
         std::to_string(pause_s) + "\n";
}

/// The member of the status's object `object`.
std::int64_t number_in(const std::string& status, const std::string& object,
                       const std::string& key) {
  const std::size_t at = status.find("\"" + object + "\":{");
  return at == std::string::npos ? -1 : drivers::find_json_number(status.substr(at), key, -1);
}

struct Tally {
  std::array<int, 4> verdicts{};  ///< by MissionVerdict
  int wrong = 0;
  int not_at_its_instant = 0;
  int too_old = 0;             ///< of those that were
  std::vector<double> off_ms;  ///< exposure of the field judged by, less the claim's instant
  std::string first;           ///< that was wrong
};

class RobotMission : public ::testing::Test {
 protected:
  void SetUp() override {
    std::ifstream file(TUBESIGHT_SOURCE_DIR "/docs/examples/steam-generator.toml");
    const std::string example{std::istreambuf_iterator<char>(file), {}};
    box_.folder().write("mission.toml", scenario_text(mission_s(), example));
    drivers::Messages messages;
    ASSERT_TRUE(drivers::load_scenario(box_.folder().path("mission.toml"), {-1, true}, *scenario_,
                                       messages))
        << messages.front();
    ASSERT_TRUE(world_->configure(scenario_->scenario));
    const int port = free_port();
    line_ = address(port);
    box_.write_simulated_settings(tcp_link(port), box_.folder().path("mission.toml"));
  }

  [[nodiscard]] double span_us() const {
    return std::chrono::duration<double, std::micro>(world_->slot_time(1) - world_->slot_time(0))
        .count();
  }
  [[nodiscard]] core::TubeAddress true_tube(std::int64_t slot) {
    return world_->truth_of(std::clamp<std::int64_t>(slot, 0, world_->slots() - 1))
        .axis.nearest.address;
  }

  /// A line for each rest of the tool: first and last slot, row, column.
  [[nodiscard]] std::string rests() {
    constexpr std::int64_t kStep = 6;  // a tenth of a second
    std::string text;
    std::int64_t first = -1;
    for (std::int64_t slot = 0; slot < world_->slots(); slot += kStep) {
      const drivers::FieldTruth truth = world_->truth_of(slot);
      const bool rests = truth.speed_mm_s < 0.01;
      if (rests && first < 0) {
        first = slot;
      } else if (!rests && first >= 0) {
        const core::TubeAddress tube = true_tube(slot - kStep);
        text += std::to_string(first) + " " + std::to_string(slot - kStep) + " " +
                std::to_string(tube.row) + " " + std::to_string(tube.column) + "\n";
        first = -1;
      }
    }
    return text;
  }

  void judge(const MissionLog& log, const MissionClaim& claim, Tally& tally) {
    ++tally.verdicts[static_cast<std::size_t>(claim.verdict) % 4];
    const auto fault = [&](int& count, const char* what) {
      if (++count == 1) {
        tally.first += std::string(what) + ": sent at " + std::to_string(claim.sent_us) +
                       " by field " + std::to_string(claim.field) + "\n";
      }
    };
    if (claim.age_ms > kOldest_ms) {
      tally.too_old += claim.reason == kTooOld ? 1 : 0;
      if (claim.verdict != MissionVerdict::kCannotSay) {
        fault(tally.wrong, "too old");
      }
      return;
    }
    if (claim.verdict == MissionVerdict::kCannotSay) {
      return;
    }
    const double exposed_us = log.exposed_us(claim.field);
    const core::TubeAddress truth = true_tube(log.slot_at(exposed_us));
    const bool agree = claim.verdict == MissionVerdict::kAgree;
    if (agree != (claim.tube == truth) || !claim.named || claim.seen != truth) {
      fault(tally.wrong, "wrong");
    }
    // The claim arrived after it was sent and before it was taken.
    const double instant_us = static_cast<double>(claim.sent_us - 1000 * claim.age_ms);
    if (true_tube(log.slot_at(instant_us)) != truth) {
      fault(tally.wrong, "another tube at the claim's instant");
    }
    constexpr double kReads_us = 3000.0;  // what the robot knows of the exposure
    const double off_us = exposed_us - instant_us;
    const auto took_us = static_cast<double>(claim.taken_us - claim.sent_us);
    // Where fields did not come, the nearest may be as far as the box allows.
    const double reach_us = log.health().missing > 0 ? kWithin_us : span_us() / 2.0;
    if (off_us < -reach_us - kReads_us || off_us > took_us + reach_us + kReads_us) {
      fault(tally.not_at_its_instant, "not at its instant");
    }
    tally.off_ms.push_back(off_us / 1000.0);
  }

  Daemon box_;
  std::string line_;
  std::unique_ptr<drivers::ScenarioFile> scenario_ = std::make_unique<drivers::ScenarioFile>();
  std::unique_ptr<drivers::SimulatedWorld> world_ = std::make_unique<drivers::SimulatedWorld>();
};

void print_figures(const MissionLog& log, const Tally& tally, const std::string& status) {
  std::vector<double> off;
  for (const double each : tally.off_ms) {
    off.push_back(std::abs(each));
  }
  std::sort(off.begin(), off.end());
  const MissionHealth& health = log.health();
  std::printf(
      "mission: %.0f s, %zu claims and %zu polls: %d AGREE, %d DISAGREE, %d CANNOT SAY (%d too "
      "old), %d wrong\n"
      "restarts: %zu, %zu of them taken; without a track in %zu polls\n"
      "fields: %lld, %lld did not come (%lld made too late by the source), %lld later than the "
      "deadline\n"
      "grab to sighting: median %lld us, 99 %% %lld us, worst %lld us\n"
      "claims: judged by a field %.1f ms (median), %.1f ms (worst) from their instant\n"
      "link: %lld requests, answered within %lld us, claims within %lld us\n",
      mission_s(), log.claims().size(), log.polls().size(), tally.verdicts[1], tally.verdicts[2],
      tally.verdicts[3], tally.too_old, tally.wrong, log.restarts().size(), log.restarts_taken(),
      log.polls_while_lost(), static_cast<long long>(health.fields),
      static_cast<long long>(health.missing),
      static_cast<long long>(number_in(status, "source", "made_late")),
      static_cast<long long>(health.late),
      static_cast<long long>(number_in(status, "grab_to_sighting", "median_us")),
      static_cast<long long>(number_in(status, "grab_to_sighting", "p99_us")),
      static_cast<long long>(number_in(status, "grab_to_sighting", "worst_us")),
      off.empty() ? 0.0 : off[off.size() / 2], off.empty() ? 0.0 : off.back(),
      static_cast<long long>(health.requests), static_cast<long long>(health.worst_us),
      static_cast<long long>(health.claim_worst_us));
}

TEST_F(RobotMission, EveryClaimIsJudgedAtItsOwnInstantAndNoFieldIsDropped) {
  box_.folder().write("rests", rests());
  ASSERT_TRUE(box_.start_and_wait()) << box_.said();

  const Answered run =
      run_program("/usr/bin/python3",
                  {"-B", TUBESIGHT_SOURCE_DIR "/tests/system/mission_robot.py",
                   TUBESIGHT_SOURCE_DIR "/docs/examples", line_, std::to_string(mission_s()),
                   box_.folder().path("rests"), std::to_string(span_us())});
  const std::string status = box_.ask({"status", "--json"}).out;

  ASSERT_EQ(run.status, 0) << run.err << box_.said();
  const MissionLog log(run.out, span_us());
  EXPECT_EQ(log.strange(), "");
  Tally tally;
  for (const MissionClaim& claim : log.claims()) {
    judge(log, claim, tally);
  }
  print_figures(log, tally, status);
  EXPECT_EQ(tally.wrong, 0) << tally.first;
  EXPECT_EQ(tally.not_at_its_instant, 0) << tally.first;
  const auto claims = static_cast<int>(log.claims().size());
  EXPECT_GE(claims, static_cast<int>(mission_s() * 20.0) - 20);
  EXPECT_EQ(tally.verdicts[0], 0) << "a claim without a verdict";
  EXPECT_GE(tally.too_old, claims / 8 - 1);
  // On its way from tube to tube it can vouch for none.
  EXPECT_GT(tally.verdicts[1], claims / 5);
  EXPECT_GT(tally.verdicts[2], claims / 5);
  EXPECT_GE(log.restarts_taken(), 1U) << "after the black stretch";
  EXPECT_EQ(log.health().exceptions, 0);
  EXPECT_EQ(log.health().crc_errors, 0);
  EXPECT_GT(log.health().requests, 2 * claims);
  // Where the machine has no time to draw the fields, the box cannot have them.
  const std::int64_t made_late = number_in(status, "source", "made_late");
  ASSERT_GE(made_late, 0) << status;
  if (made_late == 0) {
    EXPECT_EQ(log.health().missing, 0);
    EXPECT_EQ(log.restarts_taken(), 1U) << "lost without a reason";
  }
}

/// A log by hand: field 30 was exposed at 1 s, the tool rests under (40, 60).
std::string log_with(const std::string& claim) {
  return "P 1004500 1005500 767 30 5 40,60 1 1\n" + claim + "\n";
}

TEST_F(RobotMission, AWrongVerdictOrAnotherInstantWouldBeFound) {
  struct Case {
    const char* claim;
    int wrong;
    int not_at_its_instant;
  };
  // Fields are 16.7 ms apart; each claim is sent at 1.2 s and answered 20 ms later.
  for (const auto& [claim, wrong, not_at_its_instant] :
       {Case{"C 1200000 1220000 1220000 0 40,60 1 0 40,60 42", 0, 0},
        Case{"C 1200000 1220000 1220000 0 41,60 2 0 40,60 42", 0, 0},
        Case{"C 1200000 1220000 1220000 200 40,60 1 0 40,60 30", 0, 0},
        Case{"C 1200000 1220000 1220000 300 40,60 3 2 - -1", 0, 0},
        Case{"C 1200000 1220000 1220000 300 40,60 1 0 40,60 42", 1, 0},
        Case{"C 1200000 1220000 1220000 0 41,60 1 0 41,60 42", 1, 0},
        Case{"C 1200000 1220000 1220000 0 40,60 2 0 41,60 42", 1, 0},
        Case{"C 1200000 1220000 1220000 0 40,60 2 0 40,60 42", 1, 0},
        Case{"C 1200000 1220000 1220000 0 40,60 1 0 - 42", 1, 0},
        Case{"C 1200000 1220000 1220000 0 40,60 1 0 40,60 41", 0, 1},
        Case{"C 1200000 1220000 1220000 0 40,60 1 0 40,60 45", 0, 1},
        Case{"C 1200000 1220000 1220000 200 40,60 1 0 40,60 42", 0, 1}}) {
    const MissionLog log(log_with(claim), span_us());
    ASSERT_EQ(log.strange(), "");
    ASSERT_EQ(log.claims().size(), 1U);
    Tally tally;
    judge(log, log.claims().front(), tally);
    EXPECT_EQ(tally.wrong, wrong) << claim;
    EXPECT_EQ(tally.not_at_its_instant, not_at_its_instant) << claim;
  }
  EXPECT_NE(MissionLog("C 1 2 3 0 here 1 0 - 4\n", span_us()).strange(), "");
}

}  // namespace
}  // namespace tubesight::tests
