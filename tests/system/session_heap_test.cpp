// The path field -> sighting -> reply allocates nothing: the heap guard is armed around step() over
// the recording that ships with the repository.

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

#include <gtest/gtest.h>

#include "core/session/session.h"
#include "drivers/files/messages.h"
#include "drivers/replay/replay_frame_grabber.h"
#include "drivers/settings/session_settings.h"
#include "tests/support/heap_guard.h"
#include "tests/support/scalars.h"

namespace tubesight::tests {
namespace {

using core::session::Input;
using core::session::Output;
using core::session::Session;

constexpr const char* kFolder = TUBESIGHT_TEST_DATA_DIR "/recordings/square_flush/";

template <typename S>
class SessionHeap : public ::testing::Test {};

using tests::Scalars;
TYPED_TEST_SUITE(SessionHeap, Scalars);

TYPED_TEST(SessionHeap, IsNotTouchedByAStep) {
  const auto file = std::make_unique<drivers::SessionFile>();
  drivers::Messages messages;
  ASSERT_TRUE(drivers::load_session_settings(std::string(kFolder) + "session.toml",
                                             drivers::kReplayNeeds, *file, messages))
      << (messages.empty() ? "" : messages.front());
  drivers::ReplayFrameGrabber grabber(file->settings.camera,
                                      std::string(kFolder) + "recording.y4m.xz");
  ASSERT_TRUE(grabber.start()) << (grabber.messages().empty() ? "" : grabber.messages().front());
  const auto session = std::make_unique<Session<TypeParam>>();
  const auto input = std::make_unique<Input>();
  const auto output = std::make_unique<Output>();
  ASSERT_TRUE(session->configure(file->settings));
  core::Event start;
  start.content = core::Start{file->settings.start.tubes, {}, false};
  ASSERT_TRUE(input->events.try_push_back(start));
  core::Event claim;  // one to answer in every field, right or wrong

  std::int64_t fields = 0;
  std::int64_t tracked = 0;
  HeapCalls calls;
  while (auto lease = grabber.grab_for(std::chrono::milliseconds(0))) {
    input->field = lease->field();
    ASSERT_TRUE(input->events.try_push_back(claim));
    {
      const HeapGuard guard;
      session->step(*input, *output);
      const HeapCalls now = guard.calls();
      calls.allocations += now.allocations;
      calls.releases += now.releases;
    }
    input->events.clear();
    ++fields;
    tracked += output->sighting.state == core::TrackState::kTracking ? 1 : 0;
  }

  EXPECT_GE(fields, 50);
  EXPECT_GT(2 * tracked, fields) << "the recording is hardly tracked: the guard saw an idle path";
  EXPECT_EQ(calls.allocations, 0);
  EXPECT_EQ(calls.releases, 0);
}

}  // namespace
}  // namespace tubesight::tests
