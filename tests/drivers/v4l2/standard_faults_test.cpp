// A signal of another standard than the grabber is set to: torn or rolling pictures, which no
// driver flags. It is named, none of it is taken for good, and it passes when the signal is right
// again.

#include <cerrno>
#include <chrono>

#include <gtest/gtest.h>

#include "drivers/v4l2/video_standard.h"
#include "tests/drivers/v4l2/camera_bench.h"

namespace tubesight::tests {
namespace {

using core::Error;
using core::FieldStatus;
using core::FieldTime;
using drivers::CameraTrouble;
using drivers::v4l2::StandardPace;
using drivers::v4l2::VideoStandard;

constexpr FieldTime kNtscFrame{33'366'667};
constexpr FieldTime kPalFrame{40'000'000};

/// A grabber that is set to one standard, with a signal that may be of another.
class StandardFaults : public testing::TestWithParam<bool> {
 protected:
  StandardFaults() {
    camera().fields = {V4L2_FIELD_INTERLACED};
    camera().standard = own();
    camera().frame_time = pal() ? v4l2_fract{1, 25} : v4l2_fract{1001, 30'000};
    camera().every = frame();
  }

  static bool pal() { return GetParam(); }
  static v4l2_std_id own() { return pal() ? V4L2_STD_PAL : V4L2_STD_NTSC; }
  static v4l2_std_id other() { return pal() ? V4L2_STD_NTSC_M_JP : V4L2_STD_PAL_BG; }
  static FieldTime frame() { return pal() ? kPalFrame : kNtscFrame; }
  static FieldTime other_frame() { return pal() ? kNtscFrame : kPalFrame; }
  FakeCamera& camera() { return bench_.camera(); }

  /// Fields, of so many at most, until the next one is of this status.
  int fields_until(FieldStatus status, int most) {
    int fields = 0;
    while (fields < most && bench_.next_status() != status) {
      ++fields;
    }
    return fields;
  }

  CameraBench bench_{settings_of(core::Scan::kEvenFirst)};
};
INSTANTIATE_TEST_SUITE_P(Both, StandardFaults, testing::Bool(),
                         [](const auto& which) { return which.param ? "Pal" : "Ntsc"; });

TEST_P(StandardFaults, AnotherSignalAtTheOpeningIsRefusedInOneLine) {
  camera().sensed = other();
  const auto started = bench_.grabber().start();
  ASSERT_FALSE(started);
  EXPECT_EQ(started.error(), Error::kUnsupported);
  const std::string name = pal() ? "PAL" : "NTSC";
  const std::string signal = pal() ? "NTSC" : "PAL";
  EXPECT_EQ(bench_.message(), std::string("camera ") + kByPath + ": gets a signal of " + signal +
                                  ", expected " + name + ", to which it is set");

  camera().sensed = own();
  ASSERT_TRUE(bench_.grabber().start()) << "when it is right";
  EXPECT_TRUE(bench_.good_within(1));
}

TEST_P(StandardFaults, ASignalThatChangesIsNamedAndDamagedUntilItIsBack) {
  camera().sensed = own();
  ASSERT_TRUE(bench_.grabber().start()) << bench_.message();
  ASSERT_TRUE(bench_.good_within(2));

  camera().sensed = other();
  bench_.grabber().look_after();
  static_cast<void>(bench_.next_status());  // of the frame before
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(bench_.next_status(), FieldStatus::kDamaged);
  }
  EXPECT_EQ(bench_.report().trouble, CameraTrouble::kStandard);
  EXPECT_STREQ(words_of(bench_.report().trouble), "a signal of another standard");
  EXPECT_EQ(bench_.counters().other_standard, 5);

  camera().sensed = own();
  bench_.grabber().look_after();
  EXPECT_TRUE(bench_.good_within(1));
  EXPECT_EQ(bench_.report().trouble, CameraTrouble::kNone);
}

// It sleeps with the lock in hand that the calls for buffers need.
TEST_P(StandardFaults, ADriverThatTakesLongToSenseIsAskedWhereNoPictureIsGoodAnyway) {
  camera().sensed = own();
  camera().sensing = std::chrono::milliseconds(100);
  ASSERT_TRUE(bench_.grabber().start()) << bench_.message();
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(bench_.next_status(), FieldStatus::kGood);
    bench_.grabber().look_after();
  }
  EXPECT_EQ(bench_.kernel().calls(VIDIOC_QUERYSTD), 1) << "at the opening, before the stream";

  // Another camera is plugged in, and then the right one.
  const auto look_with = [&](std::uint32_t status, v4l2_std_id sensed) {
    camera().inputs[0].status = status;
    camera().sensed = sensed;
    bench_.grabber().look_after();
    static_cast<void>(bench_.next_status());  // of the frame before
    return bench_.next_status();
  };
  EXPECT_EQ(look_with(V4L2_IN_ST_NO_SIGNAL, own()), FieldStatus::kDamaged);
  EXPECT_EQ(look_with(0, other()), FieldStatus::kDamaged);
  EXPECT_EQ(bench_.report().trouble, CameraTrouble::kStandard);
  EXPECT_EQ(look_with(0, own()), FieldStatus::kGood);
  bench_.grabber().look_after();
  EXPECT_EQ(bench_.kernel().calls(VIDIOC_QUERYSTD), 3);
}

TEST_P(StandardFaults, ADriverThatRefusesToSenseWhileItStreamsIsNotAskedAgain) {
  camera().sensed = own();
  camera().results[VIDIOC_QUERYSTD] = {0, -EBUSY};
  ASSERT_TRUE(bench_.grabber().start()) << bench_.message();
  for (int i = 0; i < 10; ++i) {
    EXPECT_EQ(bench_.next_status(), FieldStatus::kGood);
    bench_.grabber().look_after();
  }
  EXPECT_EQ(bench_.kernel().calls(VIDIOC_QUERYSTD), 2) << "that of the opening, and the refused";

  ASSERT_TRUE(bench_.start_anew()) << bench_.message();
  EXPECT_EQ(bench_.kernel().calls(VIDIOC_QUERYSTD), 4) << "a new stream may bear it";
}

// Most grabbers cannot say it: the fields come at the pace of the other standard.
TEST_P(StandardFaults, WhereTheDriverCannotSayItThePaceDoes) {
  ASSERT_TRUE(bench_.grabber().start()) << bench_.message();
  for (int i = 0; i < 60; ++i) {
    ASSERT_EQ(bench_.next_status(), FieldStatus::kGood) << i;
  }

  camera().every = other_frame();
  EXPECT_LE(fields_until(FieldStatus::kDamaged, 100), 2 * StandardPace::kMost + 2);
  EXPECT_EQ(bench_.report().trouble, CameraTrouble::kStandard);
  EXPECT_GE(bench_.counters().other_standard, 1);
  for (int i = 0; i < 60; ++i) {
    EXPECT_EQ(bench_.next_status(), FieldStatus::kDamaged) << i;
  }

  camera().every = frame();
  EXPECT_LE(fields_until(FieldStatus::kGood, 100), 2 * StandardPace::kMost + 2);
  EXPECT_EQ(bench_.report().trouble, CameraTrouble::kNone);
}

TEST_P(StandardFaults, AnInputThatKnowsNotTheStandardSaysSo) {
  ASSERT_TRUE(bench_.grabber().start()) << bench_.message();
  camera().inputs[0].status = V4L2_IN_ST_NO_STD_LOCK;
  bench_.grabber().look_after();
  EXPECT_EQ(bench_.next_status(), FieldStatus::kDamaged);
  EXPECT_EQ(bench_.report().trouble, CameraTrouble::kStandard);

  camera().inputs[0].status = 0;
  bench_.grabber().look_after();
  EXPECT_TRUE(bench_.good_within(2));
}

TEST_P(StandardFaults, ADriverThatNamesAllStandardsSaysNothing) {
  camera().sensed = V4L2_STD_ALL;
  ASSERT_TRUE(bench_.grabber().start()) << bench_.message();
  bench_.grabber().look_after();
  EXPECT_TRUE(bench_.good_within(1));
}

TEST_P(StandardFaults, AStandardThatIsSetAlreadyIsNotSetAgain) {
  auto settings = settings_of(core::Scan::kEvenFirst);
  settings.standard = pal() ? "PAL" : "NTSC";
  CameraBench bench(settings);
  bench.camera().fields = {V4L2_FIELD_INTERLACED};
  bench.camera().standard = own();
  bench.camera().frame_time = {0, 0};
  ASSERT_TRUE(bench.grabber().start()) << bench.message();
  EXPECT_EQ(bench.kernel().calls(VIDIOC_S_STD), 0) << "some chips look for their signal anew";

  bench.camera().standard = other();
  ASSERT_TRUE(bench.start_anew()) << bench.message();
  EXPECT_EQ(bench.kernel().calls(VIDIOC_S_STD), 1);
}

// From the choice of the standard on whatever changes is told by an event of the stream.
TEST(SourceChange, WithinAnOpeningIsNeverMissed) {
  for (const unsigned long moment : {VIDIOC_S_FMT, VIDIOC_G_PARM, VIDIOC_STREAMON}) {
    CameraBench bench;
    bench.camera().before = [&](unsigned long request) {
      if (request == moment) {
        bench.kernel().change_source(bench.camera());
      }
    };
    ASSERT_TRUE(bench.grabber().start()) << bench.message();
    bench.camera().before = nullptr;
    EXPECT_EQ(bench.grab().error(), Error::kIo);
    EXPECT_EQ(bench.report().trouble, CameraTrouble::kSourceChanged);
    EXPECT_EQ(bench.counters().source_changes, 1);

    bench.camera().events.clear();
    ASSERT_TRUE(bench.start_anew());
    EXPECT_TRUE(bench.good_within(1));
  }
}

// Drivers tell it with the number of the input, or with 0 whatever the input.
TEST(SourceChange, IsHeardWithWhateverNumberItIsTold) {
  for (const std::uint32_t id : {0U, 1U}) {
    auto settings = settings_of();
    settings.input = "Composite 1";
    CameraBench bench(settings);
    bench.camera().inputs.push_back({"Composite 1", 0});
    ASSERT_TRUE(bench.grabber().start()) << bench.message();
    bench.kernel().change_source(bench.camera(), id);

    EXPECT_EQ(bench.grab().error(), Error::kIo) << id;
    EXPECT_EQ(bench.report().trouble, CameraTrouble::kSourceChanged);
  }
}

// What our own choice of a standard brings about would open the camera anew without end.
TEST(SourceChange, ByOurOwnChoiceOfAStandardIsNone) {
  auto settings = settings_of();
  settings.standard = "NTSC";
  CameraBench bench(settings);
  bench.camera().standard = V4L2_STD_PAL;
  bench.camera().before = [&](unsigned long request) {
    if (request == VIDIOC_S_STD) {
      bench.kernel().change_source(bench.camera());
    }
  };
  bench.camera().frame_time = {0, 0};
  ASSERT_TRUE(bench.grabber().start()) << bench.message();
  EXPECT_TRUE(bench.good_within(1));
  EXPECT_EQ(bench.counters().source_changes, 0);
}

/// Frames of NTSC with some interval between two of them; whether the other standard is found.
template <typename Interval>
bool taken_for_pal(const Interval& interval) {
  StandardPace pace;
  pace.begin(VideoStandard::kNtsc);
  FieldTime at{0};
  bool other = false;
  for (std::int64_t i = 0; i < 400; ++i) {
    pace.take(at, 2 * i);
    at += interval(i);
    other = other || pace.other();
  }
  return other;
}

TEST(StandardPace, LossesWithoutACounterAreNoOtherStandard) {
  EXPECT_FALSE(taken_for_pal([](std::int64_t i) {
    return i % 5 == 0 ? 2 * kNtscFrame : kNtscFrame;
  })) << "a mean of 40 ms, as of PAL";
  EXPECT_FALSE(taken_for_pal([](std::int64_t i) {
    return kNtscFrame + (i % 2 == 0 ? 1 : -1) * std::chrono::milliseconds(6);
  })) << "late by turns";
  EXPECT_TRUE(taken_for_pal([](std::int64_t i) {
    return kPalFrame + (i % 2 == 0 ? 1 : -1) * std::chrono::microseconds(800);
  }));
}

TEST(StandardPace, WithoutAStandardNothingIsFound) {
  StandardPace pace;
  pace.begin(VideoStandard::kNone);
  for (std::int64_t i = 0; i < 100; ++i) {
    pace.take(i * kPalFrame, 2 * i);
  }
  EXPECT_FALSE(pace.other());
}

}  // namespace
}  // namespace tubesight::tests
