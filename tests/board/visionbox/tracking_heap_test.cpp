// The tracking thread allocates nothing after the start, while the thread of the source reads a
// recording, that of poses computes one, that of the robot's link waits for masters, that of the
// recorder writes, and a client asks.

#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "board/visionbox/box_settings.h"
#include "board/visionbox/vision_box.h"
#include "tests/support/events.h"
#include "tests/support/heap_guard.h"
#include "tests/support/temporary_folder.h"

namespace tubesight::board {
namespace {

constexpr const char* kFolder = TUBESIGHT_TEST_DATA_DIR "/recordings/square_flush/";

TEST(TrackingHeap, IsNotTouchedByATurn) {
  const auto settings = std::make_unique<BoxSettings>();
  drivers::Messages messages;
  ASSERT_TRUE(drivers::load_session_settings(std::string(kFolder) + "session.toml",
                                             drivers::kReplayNeeds, settings->session, messages));
  settings->source.recording = std::string(kFolder) + "recording.y4m.xz";
  settings->source.script = true;
  settings->link.kind = LinkKind::kModbus;
  settings->link.modbus.tcp_port = 0;
  const support::TemporaryFolder folder;
  settings->record.folder = folder.path(".");
  settings->record.recorder.fields_after = 10;
  const auto box = std::make_unique<VisionBox>(*settings, [](const std::string&) {});
  ASSERT_TRUE(box->start_without_tracking());
  int tracked = 0;
  tests::HeapCalls calls;
  // The recording, the gap behind it, and the first fields of the next pass.
  for (int i = 0; i < 160; ++i) {
    static_cast<void>(box->station().submit(
        tests::event_of(core::Pick{{313.0, 196.0}, {}}, core::EventOrigin::kOperator)));
    {
      const tests::HeapGuard guard(tests::HeapScope::kThisThread);
      box->tracking().turn();
      const tests::HeapCalls now = guard.calls();
      calls.allocations += now.allocations;
      calls.releases += now.releases;
    }
    if (i == 20 || i == 100) {
      static_cast<void>(box->request_recording());
    }
    tracked += box->loop().output().sighting.state == core::TrackState::kTracking ? 1 : 0;
  }

  EXPECT_GT(tracked, 40) << "hardly tracked: the guard saw an idle path";
  EXPECT_GT(box->loop().counters().missing, 10);
  box->stop();
  EXPECT_EQ(box->report().recorder.counters.written, 3U) << "asked for twice, and lost once";
  EXPECT_EQ(calls.allocations, 0);
  EXPECT_EQ(calls.releases, 0);
}

}  // namespace
}  // namespace tubesight::board
