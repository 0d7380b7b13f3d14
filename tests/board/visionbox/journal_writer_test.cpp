#include "board/visionbox/journal_writer.h"

#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/events.h"
#include "tests/support/fake_clock.h"

namespace tubesight::board {
namespace {

/// A row as it reached the disk.
struct Written {
  hal::JournalKind kind;
  std::string verdict;
  std::string detail;
  std::string digest;
  std::int64_t count;
  bool picture;
};

/// What the test sees of a disk, and does to it.
struct Disk {
  bool full = false;
  std::atomic<bool> hangs{false};
  std::string last_boot;
  std::vector<Written> rows;
  int opened = 0;
  int signed_times = 0;
};

class FakeStore final : public JournalStore, public hal::Journal {
 public:
  explicit FakeStore(Disk& disk) : disk_(&disk) {}

  core::Result<void> open(const hal::JournalRow&) override {
    if (disk_->full) {
      return core::Unexpected(core::Error::kIo);
    }
    ++disk_->opened;
    return {};
  }
  void close() override {}
  hal::Journal& journal() override { return *this; }
  std::string message() const override { return "J.db: the disk is full"; }
  std::string news() const override { return {}; }
  std::string last_detail(hal::JournalKind kind) override {
    return kind == hal::JournalKind::kBoot ? disk_->last_boot : std::string();
  }

  core::Result<std::int64_t> append(std::span<const hal::JournalRow> rows) override {
    if (disk_->full) {
      return core::Unexpected(core::Error::kIo);
    }
    while (disk_->hangs) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    for (const hal::JournalRow& row : rows) {
      disk_->rows.push_back({row.kind, std::string(row.verdict), std::string(row.detail),
                             std::string(row.seen.field_digest), row.count, !row.picture.empty()});
    }
    return last_safe();
  }
  core::Result<void> sign() override {
    ++disk_->signed_times;
    return {};
  }
  std::int64_t last_safe() const override { return static_cast<std::int64_t>(disk_->rows.size()); }

 private:
  Disk* disk_;
};

class JournalWriterTest : public ::testing::Test {
 protected:
  JournalWriterTest() {
    JournalWriter::Parts parts;
    parts.store = std::make_unique<FakeStore>(disk_);
    parts.compress = [](const core::ImageView& grey) {
      return std::string(static_cast<std::size_t>(grey.height_px), 'j');
    };
    parts.digest = [](std::span<const std::byte>) { return std::string(64, 'd'); };
    writer_ = std::make_unique<JournalWriter>(
        desk_, clock_, "J.db", JournalFrame{"boot", "1.0", "c", "t", "b", "abc"}, std::move(parts),
        [this](const std::string& line) { said_.push_back(line); });
  }

  /// The robot claims, and the box answers by the picture of that field.
  void claim(core::TubeAddress tube, core::ClaimVerdict verdict = core::ClaimVerdict::kConfirmed) {
    const auto input = std::make_unique<core::session::Input>();
    const auto output = std::make_unique<core::session::Output>();
    const std::vector<std::uint8_t> pixels(8);
    input->field.number = ++number_;
    input->field.mid_exposure = clock_.now();
    input->field.pixels = {pixels.data(), 4, 2, 4, 0, 1};
    output->sighting.field = number_;
    core::ClaimReply reply;
    reply.claimed = tube;
    reply.tube = tube;
    reply.verdict = verdict;
    reply.doubt = verdict == core::ClaimVerdict::kUnknown ? core::ClaimDoubt::kNotKnown
                                                          : core::ClaimDoubt::kNone;
    reply.field = number_;
    ASSERT_TRUE(
        output->replies.try_push_back({number_, core::EventOrigin::kRobot, clock_.now(), reply}));
    desk_.take(*input, *output);
    clock_.advance(std::chrono::seconds(1));
  }
  /// Until the writer tries again.
  void recover() {
    disk_.full = false;
    for (int i = 0; i < 400 && writer_->report().state != JournalReport::State::kWriting; ++i) {
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
      writer_->round(false);
    }
  }

  Disk disk_;
  JournalDesk desk_{4, 2};
  support::FakeClock clock_;
  std::vector<std::string> said_;
  std::unique_ptr<JournalWriter> writer_;
  std::int64_t number_ = 0;
};

TEST_F(JournalWriterTest, AStopIsARowAtOnceAndOneAtItsEnd) {
  claim({40, 60});
  writer_->round(false);
  ASSERT_EQ(disk_.rows.size(), 1U);
  EXPECT_EQ(disk_.rows[0].verdict, "confirmed");
  EXPECT_EQ(disk_.rows[0].digest, std::string(64, 'd'));
  EXPECT_TRUE(disk_.rows[0].picture);
  EXPECT_EQ(writer_->report().safe, 1);
  claim({40, 60});
  claim({40, 60});
  writer_->round(false);
  EXPECT_EQ(disk_.rows.size(), 1U);

  writer_->round(true);

  ASSERT_EQ(disk_.rows.size(), 2U);
  EXPECT_EQ(disk_.rows[1].count, 2);
  EXPECT_EQ(disk_.rows[1].detail.substr(0, 15), "stop=1 part=end");
  EXPECT_FALSE(disk_.rows[1].picture);
  EXPECT_EQ(disk_.rows[1].digest, std::string(64, 'd'));
  EXPECT_GE(disk_.signed_times, 1);
  EXPECT_TRUE(said_.empty()) << said_[0];
}

TEST_F(JournalWriterTest, AFullDiskLetsTheNumberStandStillAndKeepsTheRows) {
  claim({40, 60});
  writer_->round(false);
  disk_.full = true;
  claim({40, 61}, core::ClaimVerdict::kContradicted);
  writer_->round(false);

  EXPECT_EQ(writer_->report().state, JournalReport::State::kStanding);
  EXPECT_EQ(writer_->report().safe, 1);
  EXPECT_EQ(writer_->report().waiting, 1);
  ASSERT_EQ(said_.size(), 1U);
  EXPECT_EQ(said_[0], "the journal stands still: J.db: the disk is full");

  recover();

  EXPECT_EQ(writer_->report().state, JournalReport::State::kWriting);
  ASSERT_EQ(disk_.rows.size(), 2U);
  EXPECT_EQ(disk_.rows[1].verdict, "contradicted");
  EXPECT_EQ(writer_->report().safe, 2);
  EXPECT_EQ(said_.back(), "the journal goes on");
}

TEST_F(JournalWriterTest, WhatFindsNoRoomIsCountedAndARowTellsHowMany) {
  disk_.full = true;
  for (std::size_t i = 0; i < JournalWriter::kMostWaiting + 5; ++i) {
    writer_->add({});
    writer_->round(false);
  }
  EXPECT_EQ(writer_->report().lost, 5);
  EXPECT_EQ(writer_->report().waiting, static_cast<std::int64_t>(JournalWriter::kMostWaiting));

  recover();

  ASSERT_EQ(disk_.rows.size(), JournalWriter::kMostWaiting + 1);
  EXPECT_EQ(disk_.rows.back().kind, hal::JournalKind::kFault);
  EXPECT_EQ(disk_.rows.back().detail, "part=journal what=over rows_lost=5");
}

TEST_F(JournalWriterTest, ADiskThatHangsIsSeenFromOutside) {
  disk_.hangs = true;
  writer_->start();
  writer_->add({});
  std::this_thread::sleep_for(JournalWriter::kSlow + std::chrono::milliseconds(300));
  EXPECT_EQ(writer_->report().state, JournalReport::State::kStanding);
  EXPECT_EQ(writer_->report().trouble, "J.db: the disk takes long");
  EXPECT_EQ(writer_->report().safe, 0);

  disk_.hangs = false;
  writer_->stop();

  EXPECT_EQ(writer_->report().safe, 1);
}

TEST_F(JournalWriterTest, AJournalThatCannotBeOpenedIsTriedAgain) {
  disk_.full = true;
  claim({40, 60});
  writer_->round(false);
  EXPECT_EQ(writer_->report().state, JournalReport::State::kStanding);
  EXPECT_EQ(writer_->report().safe, 0);

  recover();

  EXPECT_EQ(disk_.opened, 1);
  EXPECT_EQ(disk_.rows.size(), 1U);
}

TEST_F(JournalWriterTest, AJournalThatWasBegunAnewCountsAnew) {
  for (int column = 0; column < 5; ++column) {
    claim({40, column});
  }
  writer_->round(false);
  EXPECT_EQ(writer_->report().safe, 5);
  disk_.full = true;
  claim({40, 60});
  writer_->round(false);
  EXPECT_EQ(writer_->report().safe, 5) << "it stands still";

  disk_.rows.clear();  // it was damaged, and moved aside
  recover();

  EXPECT_EQ(writer_->report().safe, 1);
}

TEST_F(JournalWriterTest, WhoStartedIsNamedWhereThePageSaid) {
  const auto input = std::make_unique<core::session::Input>();
  const auto output = std::make_unique<core::session::Output>();
  core::Event event = tests::event_of(core::Start{}, core::EventOrigin::kOperator);
  event.id = 77;
  ASSERT_TRUE(input->events.try_push_back(event));
  ASSERT_TRUE(
      output->replies.try_push_back({77, core::EventOrigin::kOperator, {}, core::StartReply{}}));
  writer_->name(77, "Ann B. <x>");
  desk_.take(*input, *output);
  writer_->round(false);

  ASSERT_EQ(disk_.rows.size(), 1U);
  EXPECT_EQ(disk_.rows[0].kind, hal::JournalKind::kStart);
  EXPECT_EQ(disk_.rows[0].verdict, "taken");
  EXPECT_EQ(disk_.rows[0].detail, "by=Ann%20B.%20%3cx%3e");
}

TEST_F(JournalWriterTest, AStartWithOtherSettingsThanTheOneBeforeIsAChange) {
  disk_.last_boot = "what=ended settings=abd golden=good";
  writer_->round(false);
  ASSERT_EQ(disk_.rows.size(), 1U);
  EXPECT_EQ(disk_.rows[0].kind, hal::JournalKind::kSetting);
  EXPECT_EQ(disk_.rows[0].detail, "what=changed settings=abc before=abd");
}

TEST_F(JournalWriterTest, AStartWithTheSettingsOfTheOneBeforeIsNone) {
  disk_.last_boot = "what=ended settings=abc golden=good";
  writer_->round(false);
  EXPECT_TRUE(disk_.rows.empty());
}

TEST(DetailWord, EscapesWhatIsNoWord) {
  EXPECT_EQ(detail_word("words", "a b=c%\n\xc3\xa9"), "words=a%20b%3dc%25%0a%c3%a9");
}

}  // namespace
}  // namespace tubesight::board
