// Plugs and places without a tube, as the settings list them, against what the picture shows.

#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "tests/core/session/sheet_run.h"

namespace tubesight::core::session {
namespace {

using tests::content_of;

/// Sites around the tube that the tool is under.
const std::vector<TubeAddress> kAround{{20, 11}, {19, 10}, {21, 11}, {19, 9}};

class MapOf : public ::testing::Test {
 protected:
  /// Sites that the settings tell to be plugged (or without a tube), and those that are.
  void make(const std::vector<TubeAddress>& told, const std::vector<TubeAddress>& true_ones,
            bool missing = false) {
    for (const TubeAddress site : told) {
      auto& list = missing ? run_.settings->tubesheet.missing : run_.settings->tubesheet.plugged;
      ASSERT_TRUE(list.try_push_back(site));
    }
    run_.configure();
    // Drawn without the lists.
    const auto drawn = std::make_unique<SessionSettings>(*run_.settings);
    drawn->tubesheet.missing.clear();
    drawn->tubesheet.plugged.clear();
    run_.sheet = std::make_unique<SyntheticSheet>(*drawn);
    run_.sheet->look.flush_plugs = true_ones;
  }

  /// A start over kTube with tube-ends that are open; each address so many columns off.
  StartRefusal start(std::int32_t off) {
    tests::set_clicks(*run_.sheet, kOverTube, {{20, 10}, {21, 10}, {20, 9}}, {3.0, -2.0},
                      *run_.settings);
    Start clicks{run_.settings->start.tubes, {}, false};
    for (StartPoint& click : clicks.tubes) {
      click.address.column += off;
    }
    run_.add(tests::event_of(clicks));
    run_.step(kOverTube);
    return content_of<StartReply>(run_.output().replies[0]).refusal;
  }

  SheetRun<FixedPoint> run_;
};

TEST_F(MapOf, AStartWhoseAddressesAreOffIsRefusedBesideListedPlugs) {
  make(kAround, kAround);
  for (const std::int32_t off : {1, -1}) {
    EXPECT_EQ(start(off), StartRefusal::kMap) << off;
    EXPECT_EQ(run_.sighting().state, TrackState::kWaiting);
  }
  EXPECT_EQ(start(0), StartRefusal::kNone);
  EXPECT_TRUE(run_.sighting().aligned);
}

TEST_F(MapOf, AStartWhoseAddressesAreOffIsRefusedBesideListedVoids) {
  make(kAround, kAround, true);  // a flush plug and bare plate look the same
  EXPECT_EQ(start(-1), StartRefusal::kMap);
  EXPECT_EQ(start(0), StartRefusal::kNone);
}

TEST_F(MapOf, TwoListedPlugsThatAreOneStepOffAreEnough) {
  make({kAround[0], kAround[1]}, {kAround[0], kAround[1]});
  EXPECT_EQ(start(-1), StartRefusal::kMap);
  EXPECT_EQ(start(0), StartRefusal::kNone);
}

TEST_F(MapOf, PlugsThatNobodyListedAreNoReasonAlone) {
  make({{20, 11}}, {{20, 11}, {19, 10}, {21, 11}, {19, 9}, {22, 10}});
  EXPECT_EQ(start(0), StartRefusal::kNone);
  for (int i = 0; i < 30; ++i) {
    run_.step(kOverTube);
    ASSERT_EQ(run_.sighting().state, TrackState::kTracking);
  }
}

TEST_F(MapOf, TwoPlugsThatFellOutAndOnesThatNobodyListedAreNoReason) {
  make(kAround, {kAround[0], kAround[1], {22, 11}, {18, 9}});
  EXPECT_EQ(start(0), StartRefusal::kNone);
  for (int i = 0; i < 60; ++i) {
    run_.step(kOverTube);
    ASSERT_EQ(run_.sighting().state, TrackState::kTracking);
    ASSERT_TRUE(run_.sighting().aligned);
  }
}

TEST_F(MapOf, ATrackEndsWhereTheMapComesIntoViewAndRefutesIt) {
  // Far to the right; the settings list them, and open tube-ends stand there.
  make({{20, 16}, {21, 16}, {19, 16}, {20, 17}, {22, 17}}, {});
  ASSERT_EQ(start(0), StartRefusal::kNone);
  for (int i = 0; i < 120 && run_.sighting().state != TrackState::kLost; ++i) {
    run_.step(moved(kOverTube, way_after(i / 60.0, 6 * kPitch_mm, 120.0, 1000.0)));
  }
  EXPECT_EQ(run_.sighting().state, TrackState::kLost);
  EXPECT_EQ(run_.sighting().reason, Reason::kMap);
  // Nobody is told any more what the box said just before.
  Event claim = tests::event_of(Claim{{20, 15}});
  claim.at = run_.now - 2 * kFieldSpan;
  run_.add(claim);
  run_.step(moved(kOverTube, 6 * kPitch_mm));
  EXPECT_EQ(content_of<ClaimReply>(run_.output().replies[0]).verdict, ClaimVerdict::kUnknown);
}

}  // namespace
}  // namespace tubesight::core::session
