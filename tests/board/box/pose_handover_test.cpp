#include "board/box/pose_handover.h"

#include <array>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/events.h"

namespace tubesight::board {
namespace {

constexpr std::int32_t kWidth = 8;
constexpr std::int32_t kHeight = 6;

/// Notes what it is given, and has a result after so many fields.
class NotingDesk final : public PoseDesk {
 public:
  struct Taken {
    std::int64_t number = 0;
    std::int32_t first_line = 0;
    std::uint8_t first = 0;
    std::uint8_t last = 0;
    bool wanted = false;
    std::int64_t id = 0;
  };
  void take(const core::Field& field, std::int64_t number, const core::PoseOrder& order) override {
    const core::FieldView& lines = field.pixels;
    const std::uint8_t* const last =
        lines.pixels + static_cast<std::ptrdiff_t>(lines.lines - 1) * lines.stride_px;
    taken.push_back({number, lines.first_line, lines.pixels[0], last[lines.width_px - 1],
                     order.wanted, order.id});
  }
  std::optional<core::Event> take_result() override {
    if (taken.size() != result_after) {
      return {};
    }
    return tests::event_of(core::PoseResult{});
  }
  std::vector<Taken> taken;
  std::size_t result_after = 3;
};

class PoseHandoverTest : public ::testing::Test {
 protected:
  core::Field field(std::uint8_t grey) {
    pixels_.fill(grey);
    core::Field field;
    field.parity = core::Parity::kOdd;
    field.pixels = core::field_of({pixels_.data(), kWidth, kHeight, kWidth}, field.parity);
    return field;
  }
  static core::PoseOrder order(std::int64_t id) {
    core::PoseOrder order;
    order.wanted = true;
    order.id = id;
    return order;
  }

  std::array<std::uint8_t, kWidth * kHeight> pixels_{};
  NotingDesk desk_;
  PoseHandover handover_{desk_, kWidth, kHeight};
};

TEST_F(PoseHandoverTest, CopiesNothingWhileNoPoseIsWanted) {
  handover_.take(field(1), 0, {});

  EXPECT_FALSE(handover_.serve());
  EXPECT_FALSE(handover_.take_result());
}

TEST_F(PoseHandoverTest, CarriesOrderFieldsAndResult) {
  handover_.take(field(1), 10, order(7));
  handover_.take(field(2), 11, {});
  handover_.take(field(3), 12, {});
  pixels_.fill(99);
  while (handover_.serve()) {
  }

  ASSERT_EQ(desk_.taken.size(), 3U);
  EXPECT_TRUE(desk_.taken[0].wanted);
  EXPECT_EQ(desk_.taken[0].id, 7);
  EXPECT_EQ(desk_.taken[0].number, 10);
  EXPECT_EQ(desk_.taken[0].first_line, 1);
  EXPECT_FALSE(desk_.taken[1].wanted);
  EXPECT_EQ(desk_.taken[2].first, 3);
  EXPECT_EQ(desk_.taken[2].last, 3);
  EXPECT_TRUE(handover_.take_result());
  EXPECT_FALSE(handover_.take_result());
  handover_.take(field(4), 13, {});
  EXPECT_FALSE(handover_.serve()) << "the request is answered: nothing more is copied";
}

TEST_F(PoseHandoverTest, PassesOverWhatFindsNoRoomAndKeepsTheOrder) {
  for (int i = 0; i < 20; ++i) {
    handover_.take(field(static_cast<std::uint8_t>(i)), i, i == 0 ? order(7) : core::PoseOrder{});
  }
  while (handover_.serve()) {
  }

  EXPECT_EQ(handover_.passed_over(), 16);
  ASSERT_EQ(desk_.taken.size(), 4U);
  EXPECT_EQ(desk_.taken[3].first, 3);
}

TEST_F(PoseHandoverTest, AnOrderWaitsForAFieldThatHasAPicture) {
  core::Field missing;
  missing.status = core::FieldStatus::kMissing;
  handover_.take(missing, 0, order(7));
  EXPECT_FALSE(handover_.serve());
  handover_.take(field(5), 1, {});

  ASSERT_TRUE(handover_.serve());

  EXPECT_TRUE(desk_.taken[0].wanted);
  EXPECT_EQ(desk_.taken[0].number, 1);
}

TEST_F(PoseHandoverTest, WorksBetweenTwoThreads) {
  desk_.result_after = 200;
  std::atomic<bool> done{false};
  std::thread worker([&] {
    while (!done) {
      handover_.serve();
    }
  });
  bool answered = false;
  // Patient, as the machine may be busy with something else.
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  for (int i = 0; !answered && std::chrono::steady_clock::now() < end; ++i) {
    handover_.take(field(static_cast<std::uint8_t>(i)), i, i == 0 ? order(7) : core::PoseOrder{});
    answered = handover_.take_result().has_value();
  }
  done = true;
  worker.join();

  EXPECT_TRUE(answered);
  for (const NotingDesk::Taken& taken : desk_.taken) {
    EXPECT_EQ(taken.first, static_cast<std::uint8_t>(taken.number));
    EXPECT_EQ(taken.last, taken.first);
  }
}

}  // namespace
}  // namespace tubesight::board
