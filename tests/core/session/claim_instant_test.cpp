// A claim speaks of its own instant, however long the link took to bring it.

#include <array>
#include <memory>

#include <gtest/gtest.h>

#include "tests/core/session/sheet_run.h"

namespace tubesight::core::session {
namespace {

using std::chrono::milliseconds;

struct Counts {
  int confirmed = 0;
  int contradicted = 0;
  int unknown = 0;
};

constexpr std::array kDelays_ms = {0, 10, 30, 50, 70, 90, 120};

/// A tool that goes over ten tubes at 300 mm/s while a robot says, delayed by the link, under which
/// tube it is (`sound`) or that it is under the next one.
class ClaimsOnTheMove {
 public:
  ClaimsOnTheMove() {
    run_.settings->motion.max_acceleration_mm_s2 = 3000.0;
    run_.configure();
    run_.begin();
    begin_ = run_.now;
  }

  Counts run(bool sound, bool with_instant) {
    const double whole_s = 10 * kPitch_mm / 300.0 + 0.4;
    while (run_.now - begin_ < std::chrono::duration<double>(whole_s)) {
      for (const int delay_ms : kDelays_ms) {
        claim(run_.now - milliseconds(delay_ms), sound, with_instant);
      }
      // Just behind this field's mid-exposure: it waits for the next one.
      claim(run_.now + milliseconds(4), sound, with_instant);
      run_.step(place_at(run_.now));
      EXPECT_EQ(run_.sighting().state, TrackState::kTracking);
      take_replies();
    }
    return counts_;
  }

 private:
  [[nodiscard]] ToolPlace place_at(FieldTime at) const {
    const double t = std::chrono::duration<double>(at - begin_).count();
    return moved(kOverTube, way_after(t, 10 * kPitch_mm, 300.0, 2800.0));
  }

  void claim(FieldTime at, bool sound, bool with_instant) {
    TubeAddress tube = run_.sheet->nearest(run_.sheet->axis_point(place_at(at)));
    tube.column += sound ? 0 : 1;
    Event event = tests::event_of(Claim{tube});
    if (with_instant) {
      event.at = at;
    }
    run_.add(event);
  }

  void take_replies() {
    for (const Reply& reply : run_.output().replies) {
      const auto claim = tests::content_of<ClaimReply>(reply);
      counts_.confirmed += claim.verdict == ClaimVerdict::kConfirmed ? 1 : 0;
      counts_.contradicted += claim.verdict == ClaimVerdict::kContradicted ? 1 : 0;
      counts_.unknown += claim.verdict == ClaimVerdict::kUnknown ? 1 : 0;
    }
  }

  SheetRun<FixedPoint> run_;
  FieldTime begin_{0};
  Counts counts_;
};

TEST(ClaimsOnTheMove, AreNeverContradictedWhenSound) {
  const Counts counts = std::make_unique<ClaimsOnTheMove>()->run(true, true);
  EXPECT_EQ(counts.contradicted, 0);
  EXPECT_GT(counts.confirmed, 100);
}

TEST(ClaimsOnTheMove, AreNeverConfirmedWhenWrong) {
  const Counts counts = std::make_unique<ClaimsOnTheMove>()->run(false, true);
  EXPECT_EQ(counts.confirmed, 0);
  EXPECT_GT(counts.contradicted, 100);
}

// What the instant is for: judged in the field that they meet, sound claims of a tool that has gone
// on are contradicted, and wrong ones confirmed.
TEST(ClaimsOnTheMove, WouldBeJudgedWrongInTheFieldThatTheyMeet) {
  EXPECT_GT(std::make_unique<ClaimsOnTheMove>()->run(true, false).contradicted, 20);
  EXPECT_GT(std::make_unique<ClaimsOnTheMove>()->run(false, false).confirmed, 20);
}

}  // namespace
}  // namespace tubesight::core::session
