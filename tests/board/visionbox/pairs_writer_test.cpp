#include "board/visionbox/pairs_writer.h"

#include <algorithm>
#include <filesystem>
#include <mutex>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/event.h"
#include "core/base/reply.h"
#include "tests/support/events.h"
#include "tests/support/temporary_folder.h"

namespace tubesight::board {
namespace {

class PairsWriterTest : public ::testing::Test {
 protected:
  /// The robot asks, and the box confirms.
  void make_pair() {
    core::Event event = tests::event_of(core::PoseRequest{core::RobotPose{}});
    event.id = ++id_;
    core::PoseReply pose;
    pose.verdict = core::PoseVerdict::kConfirmed;
    core::EventList events;
    core::ReplyList replies;
    ASSERT_TRUE(events.try_push_back(event));
    ASSERT_TRUE(replies.try_push_back({id_, event.origin, {}, core::PoseRequestReply{}}));
    ASSERT_TRUE(replies.try_push_back({id_, event.origin, {}, pose}));
    desk_.take(events, replies);
  }

  PairsWriter::Tell tell() {
    return [this](const std::string& line) {
      const std::lock_guard lock(mutex_);
      lines_.push_back(line);
    };
  }

  support::TemporaryFolder folder_;
  PairDesk desk_;
  std::int64_t id_ = 0;
  std::mutex mutex_;
  std::vector<std::string> lines_;
};

TEST_F(PairsWriterTest, WritesWhatWasHandedOverBeforeItEnds) {
  PairsWriter writer(desk_, folder_.path("p.csv"), tell());
  for (int i = 0; i < 3; ++i) {
    make_pair();
  }

  writer.start();
  writer.stop();

  const std::string text = folder_.read("p.csv");
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 4) << text;
  EXPECT_EQ(writer.report().written, 3);
  EXPECT_EQ(writer.report().lost, 0);
  EXPECT_TRUE(lines_.empty());
}

TEST_F(PairsWriterTest, SaysAndCountsWhatIsLostAndGoesOn) {
  PairsWriter writer(desk_, folder_.path("later/p.csv"), tell());
  for (int i = 0; i < 10; ++i) {
    make_pair();  // two find no room
  }
  writer.start();
  writer.stop();
  EXPECT_EQ(writer.written(), 0);
  EXPECT_EQ(writer.lost(), 10);
  ASSERT_EQ(lines_.size(), 8U);
  EXPECT_TRUE(lines_[0].starts_with("a pair of poses is lost: ")) << lines_[0];
  EXPECT_NE(writer.report().trouble.find("later/p.csv: cannot be written"), std::string::npos);

  std::filesystem::create_directory(folder_.path("later"));
  make_pair();
  writer.start();
  writer.stop();

  EXPECT_EQ(writer.written(), 1);
  EXPECT_EQ(writer.report().trouble, "") << "over";
}

}  // namespace
}  // namespace tubesight::board
