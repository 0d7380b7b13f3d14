// What a camera of GigE Vision, its network and its clock do wrong. Each test injects one fault and
// shows the state that follows, what was counted, and how it ends.

#include <algorithm>
#include <chrono>
#include <random>

#include <gtest/gtest.h>

#include "tests/drivers/aravis/gige_bench.h"

namespace tubesight::tests {
namespace {

using core::Error;
using core::FieldStatus;
using drivers::AravisTrouble;
using drivers::aravis::Picture;
using std::chrono::milliseconds;
using std::chrono::seconds;

using Memory = std::span<std::byte>;

class GigeFaults : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(bench_.settle()) << bench_.message(); }

  /// Every picture from now on.
  void tamper(std::function<void(Picture&)> with) {
    bench_.camera().tamper = [with](auto, Picture& picture, Memory) { with(picture); };
  }
  /// The next picture alone.
  void tamper_once(std::function<void(Picture&)> with) {
    bench_.camera().tamper = [this, with](auto, Picture& picture, Memory) {
      with(picture);
      bench_.camera().tamper = nullptr;
    };
  }
  /// Every picture from now on is this.
  void show(std::function<void(Memory)> picture) {
    bench_.camera().tamper = [picture](auto, Picture&, Memory memory) { picture(memory); };
  }
  void expect_damaged(AravisTrouble trouble) {
    EXPECT_EQ(bench_.next_status(), FieldStatus::kDamaged);
    EXPECT_EQ(bench_.report().trouble, trouble);
  }
  void expect_well(int within = 1) {
    EXPECT_TRUE(bench_.good_within(within));
    EXPECT_EQ(bench_.report().trouble, AravisTrouble::kNone);
  }
  void expect_error(Error error, AravisTrouble trouble) {
    const auto lease = bench_.grab(6000);
    ASSERT_FALSE(lease);
    EXPECT_EQ(lease.error(), error);
    EXPECT_EQ(bench_.report().trouble, trouble);
    const auto again = bench_.grab();
    ASSERT_FALSE(again) << "it stays until the camera is started anew";
    EXPECT_EQ(again.error(), error);
  }
  void expect_recovery() {
    ASSERT_TRUE(bench_.start_anew()) << bench_.message();
    expect_well(4);
    EXPECT_EQ(bench_.library().open_devices(), 1) << "the old one was closed";
  }

  GigeBench bench_;
};

TEST_F(GigeFaults, AnIncompletePictureIsNeverGood) {
  tamper([](Picture& picture) { picture.complete = false; });
  for (int i = 0; i < 20; ++i) {
    expect_damaged(AravisTrouble::kIncomplete);
  }
  EXPECT_EQ(bench_.counters().incomplete, 20);

  bench_.camera().tamper = nullptr;
  expect_well();
}

TEST_F(GigeFaults, PicturesLostAltogetherAreAGap) {
  const auto before = bench_.grab()->field().sequence;
  tamper([](Picture& picture) { picture.frame_id += 3; });
  const auto lease = bench_.grab();
  ASSERT_TRUE(lease);

  EXPECT_EQ(lease->field().status, FieldStatus::kGood);
  EXPECT_EQ(lease->field().sequence, before + 4);
  EXPECT_EQ(bench_.counters().lost_fields, 3);
}

TEST_F(GigeFaults, TheCountersWrapIsNoGap) {
  bench_.camera().first_id = 65'530;
  ASSERT_TRUE(bench_.start_anew());
  const std::int64_t lost = bench_.counters().lost_fields;
  for (int i = 0; i < 20; ++i) {
    ASSERT_TRUE(bench_.grab());
  }
  EXPECT_EQ(bench_.counters().lost_fields, lost);
  EXPECT_EQ(bench_.counters().counter_back, 0);
}

TEST_F(GigeFaults, ACounterThatGoesBackIsAGap) {
  const auto before = bench_.grab()->field().sequence;
  tamper([](Picture& picture) { picture.frame_id = 1; });
  EXPECT_EQ(bench_.grab()->field().sequence, before + 120);
  EXPECT_EQ(bench_.counters().counter_back, 1);
}

TEST_F(GigeFaults, TheSamePictureTwiceIsDamaged) {
  std::uint64_t id = 0;
  tamper([&](Picture& picture) { id = id == 0 ? picture.frame_id : id, picture.frame_id = id; });
  EXPECT_EQ(bench_.next_status(), FieldStatus::kGood);
  expect_damaged(AravisTrouble::kRepeated);
  EXPECT_EQ(bench_.counters().counter_repeated, 1);

  bench_.camera().tamper = nullptr;
  expect_well();
}

// A converter of analogue video behind a network goes on without a signal, and says nothing of it.
TEST_F(GigeFaults, SnowWithoutAnyFlagIsDamaged) {
  std::mt19937 random(3);
  show([&](Memory memory) {
    for (std::byte& pixel : memory) {
      pixel = static_cast<std::byte>(random() >> 24);
    }
  });
  expect_damaged(AravisTrouble::kNoise);
  expect_damaged(AravisTrouble::kNoise);
  EXPECT_EQ(bench_.counters().noise, 2);

  bench_.camera().tamper = nullptr;
  expect_well();
}

TEST_F(GigeFaults, OneGreyAllOverIsDamaged) {
  for (const int grey : {35, 128, 235}) {
    show([grey](Memory memory) { std::ranges::fill(memory, static_cast<std::byte>(grey)); });
    expect_damaged(AravisTrouble::kBlank);
  }
  EXPECT_EQ(bench_.counters().blank, 3);

  bench_.camera().tamper = nullptr;
  expect_well();
}

TEST_F(GigeFaults, ABlackPictureIsCountedAndLeftToTheSession) {
  show([](Memory memory) { std::ranges::fill(memory, std::byte{16}); });
  expect_well();
  EXPECT_EQ(bench_.counters().black, 1);
}

// Each field is looked at, of a frame that holds both.
TEST(GigePairFaults, SnowInOneFieldOfAFrameDamagesThatFieldAlone) {
  GigeBench bench(gige_settings(core::Scan::kEvenFirst));
  ASSERT_TRUE(bench.settle()) << bench.message();
  ASSERT_TRUE(bench.grab()) << "the second field of the frame";
  std::mt19937 random(3);
  bench.camera().tamper = [&](auto, Picture&, Memory memory) {
    for (std::size_t at = 0; at < memory.size(); ++at) {
      memory[at] = at / 64 % 2 == 1 ? static_cast<std::byte>(random() >> 24) : memory[at];
    }
  };
  EXPECT_EQ(bench.next_status(), FieldStatus::kGood);
  EXPECT_EQ(bench.next_status(), FieldStatus::kDamaged);
  EXPECT_EQ(bench.counters().noise, 1);
}

TEST_F(GigeFaults, APictureOfAnotherSizeOrFormatIsDamaged) {
  tamper_once([](Picture& picture) { picture.width_px = 32; });
  expect_damaged(AravisTrouble::kOtherSize);
  tamper_once([](Picture& picture) { picture.height_px = 24; });
  expect_damaged(AravisTrouble::kOtherSize);
  tamper_once([](Picture& picture) { picture.format = 0x01080009; });
  expect_damaged(AravisTrouble::kOtherSize);
  tamper_once([](Picture& picture) { picture.padding_bytes = 4; });
  expect_damaged(AravisTrouble::kOtherSize);
  tamper_once([](Picture& picture) { picture.bytes -= 1; });
  expect_damaged(AravisTrouble::kOtherSize);
  EXPECT_EQ(bench_.counters().other_size, 5);
  expect_well();
}

// A calibration holds for one place on one sensor.
TEST_F(GigeFaults, ACameraThatComesBackWithAnotherSensorIsNotTaken) {
  bench_.camera().sensor = {0, 0, 48, 48};
  const auto started = bench_.start_anew();
  ASSERT_FALSE(started);
  EXPECT_EQ(started.error(), Error::kUnsupported);
  EXPECT_EQ(bench_.message(),
            "camera address:10.0.0.2: refuses its region (out of range) of its 48 x 48, expected "
            "64 x 48 at 0, 0");
  EXPECT_EQ(bench_.report().trouble, AravisTrouble::kNotOpen);

  bench_.camera().sensor = {0, 0, 1024, 768};
  expect_recovery();
}

TEST_F(GigeFaults, ACameraThatFallsSilentIsLostAfterASecond) {
  const core::FieldTime before = bench_.library().now();
  bench_.camera().absent = true;
  while (true) {
    const auto lease = bench_.grab();
    ASSERT_FALSE(lease);
    if (lease.error() != Error::kTimeout) {
      EXPECT_EQ(lease.error(), Error::kIo);
      break;
    }
  }
  EXPECT_LE(bench_.library().now() - before, milliseconds(1100)) << "the library says it after 5 s";
  EXPECT_EQ(bench_.report().trouble, AravisTrouble::kSilent);
  EXPECT_EQ(bench_.counters().silences, 1);

  const auto started = bench_.start_anew();
  EXPECT_FALSE(bench_.camera().stopped) << "each question to it would take seconds";
  ASSERT_FALSE(started);
  EXPECT_EQ(started.error(), Error::kDisconnected);
  EXPECT_EQ(bench_.report().trouble, AravisTrouble::kNotOpen);
  EXPECT_EQ(bench_.library().open_devices(), 0);

  bench_.camera().absent = false;
  expect_recovery();
}

TEST_F(GigeFaults, ACameraThatNeverBeginsIsGivenFiveSeconds) {
  bench_.camera().every = core::FieldTime{0};
  ASSERT_TRUE(bench_.start_anew());
  EXPECT_EQ(bench_.grab(4900).error(), Error::kTimeout);
  EXPECT_EQ(bench_.grab(200).error(), Error::kIo);

  bench_.camera().every = milliseconds(33);
  expect_recovery();
}

TEST_F(GigeFaults, ASlowCameraIsNotSilentForTwentyFields) {
  bench_.camera().numbers[drivers::aravis::Quantity::kFrames_per_s].value = 2.0;
  bench_.camera().every = milliseconds(500);
  ASSERT_TRUE(bench_.start_anew());
  ASSERT_TRUE(bench_.grab(1000));
  bench_.camera().every = core::FieldTime{0};
  EXPECT_EQ(bench_.grab(9000).error(), Error::kTimeout);
  EXPECT_EQ(bench_.grab(1500).error(), Error::kIo);
}

TEST_F(GigeFaults, ControlLostEndsTheStreamAtOnce) {
  bench_.camera().taken = true;
  expect_error(Error::kDisconnected, AravisTrouble::kControlLost);
  EXPECT_EQ(bench_.counters().controls_lost, 1);

  bench_.camera().busy = true;
  ASSERT_FALSE(bench_.start_anew());
  EXPECT_EQ(bench_.message(),
            "camera address:10.0.0.2: is busy: another program has its control, expected it free");
  bench_.camera().busy = false;
  expect_recovery();
}

TEST_F(GigeFaults, AZeroStampAmongOthersIsDamaged) {
  tamper_once([](Picture& picture) { picture.stamp_ns = 0; });
  expect_damaged(AravisTrouble::kStamps);
  EXPECT_EQ(bench_.counters().clock_back, 1);
  expect_well(4);
}

TEST_F(GigeFaults, ACameraWithoutAClockGoesByArrival) {
  tamper([](Picture& picture) { picture.stamp_ns = 0; });
  ASSERT_TRUE(bench_.start_anew());
  expect_well(4);
  EXPECT_FALSE(bench_.report().stamps);
  EXPECT_EQ(bench_.counters().without_stamp, 4);
}

TEST_F(GigeFaults, TimeThatGoesBackIsDamaged) {
  tamper_once([](Picture& picture) { picture.stamp_ns -= 500'000'000; });
  expect_damaged(AravisTrouble::kStamps);
  EXPECT_EQ(bench_.counters().clock_back, 1);
  expect_well(5);
}

TEST_F(GigeFaults, AClockThatJumpsAheadIsDamagedUntilItSettles) {
  bench_.camera().clock_ahead_ns += 3'000'000'000;
  expect_damaged(AravisTrouble::kStamps);
  EXPECT_EQ(bench_.counters().clock_jumps, 1);
  expect_damaged(AravisTrouble::kSettling);
  expect_damaged(AravisTrouble::kSettling);
  expect_well();
}

TEST_F(GigeFaults, InstantsGrowWhateverStampsDo) {
  core::FieldTime last = bench_.grab()->field().mid_exposure;
  const std::vector<std::int64_t> shifts{-2'000'000'000, 5'000'000'000, -40'000'000, 20'000'000};
  for (const std::int64_t shift : shifts) {
    bench_.camera().clock_ahead_ns += shift;
    for (int i = 0; i < 6; ++i) {
      const auto lease = bench_.grab();
      ASSERT_TRUE(lease);
      EXPECT_GT(lease->field().mid_exposure, last) << shift;
      last = lease->field().mid_exposure;
    }
  }
}

// What a camera still has of its last stream.
TEST_F(GigeFaults, OldPicturesFirstAreNotBelieved) {
  const std::int64_t settling = bench_.counters().settling;
  ASSERT_TRUE(bench_.start_anew());
  std::int64_t first = -1;
  bench_.camera().tamper = [&](std::int64_t number, Picture& picture, Memory) {
    first = first < 0 ? number : first;
    if (number < first + 6) {
      picture.stamp_ns -= static_cast<std::uint64_t>(900'000'000 - 100'000'000 * (number - first));
    }
  };
  for (int i = 0; i < 9; ++i) {
    EXPECT_EQ(bench_.next_status(), FieldStatus::kDamaged) << i;
  }
  EXPECT_EQ(bench_.report().trouble, AravisTrouble::kSettling);
  EXPECT_TRUE(bench_.good_within(1));
  EXPECT_EQ(bench_.counters().settling - settling, 9);
}

TEST_F(GigeFaults, APictureThatWaitedTooLongIsDamaged) {
  tamper_once([](Picture& picture) { picture.arrival += milliseconds(2500); });
  expect_damaged(AravisTrouble::kStamps);
  EXPECT_EQ(bench_.counters().too_old, 1);
  expect_well(5);
}

// Nobody takes pictures for a while: those that were kept come first, with their own times, and
// then there is a gap.
TEST_F(GigeFaults, AnUnderrunIsAGapAndItsPicturesKeepTheirTimes) {
  const core::FieldTime before = bench_.grab()->field().mid_exposure;
  bench_.library().advance(seconds(1));
  core::FieldTime last = before;
  std::int64_t taken = 0;
  while (bench_.counters().lost_fields == 0) {
    const auto lease = bench_.grab();
    ASSERT_TRUE(lease);
    ASSERT_EQ(lease->field().status, FieldStatus::kGood);
    if (bench_.counters().lost_fields == 0) {
      EXPECT_NEAR(static_cast<double>((lease->field().mid_exposure - last).count()), 33'333'333.0,
                  10.0);
      ++taken;
    }
    last = lease->field().mid_exposure;
  }
  bench_.grabber().look_after();
  ASSERT_TRUE(bench_.grab());
  EXPECT_EQ(taken, 8) << "the pool";
  EXPECT_EQ(bench_.counters().lost_fields, bench_.counters().underruns);
  EXPECT_GE(bench_.counters().underruns, 20);
}

TEST_F(GigeFaults, PacketsThatDoNotComeThroughAreMadeSmallerAtTheNextStart) {
  bench_.camera().path = 1500;
  ASSERT_TRUE(bench_.start_anew());
  for (int i = 0; i < 200; ++i) {
    const auto lease = bench_.grab();
    if (!lease) {
      EXPECT_EQ(lease.error(), Error::kIo);
      break;
    }
    EXPECT_EQ(lease->field().status, FieldStatus::kDamaged);
    ASSERT_LT(i, 160) << "5 s";
  }
  EXPECT_EQ(bench_.report().trouble, AravisTrouble::kIncomplete);

  ASSERT_TRUE(bench_.start_anew());
  EXPECT_EQ(bench_.camera().packet, 1400);
  EXPECT_TRUE(bench_.good_within(4));

  bench_.camera().path = 9000;
  ASSERT_TRUE(bench_.start_anew());
  EXPECT_EQ(bench_.camera().packet, 8000) << "negotiated again: all was well";
}

TEST_F(GigeFaults, ACameraThatIsWellIsStopped) {
  bench_.grabber().stop();
  EXPECT_TRUE(bench_.camera().stopped);
}

TEST_F(GigeFaults, WhatTheLibraryCountsIsAddedUpOverStarts) {
  bench_.camera().counts = {3, 5, 7};
  bench_.grabber().look_after();
  bench_.camera().counts = {4, 6, 9};
  bench_.grabber().stop();
  EXPECT_EQ(bench_.counters().underruns, 4);
  bench_.camera().counts = {};
  ASSERT_TRUE(bench_.grabber().start());
  bench_.camera().counts = {1, 0, 2};
  bench_.grabber().look_after();
  ASSERT_TRUE(bench_.grab());

  EXPECT_EQ(bench_.counters().underruns, 5);
  EXPECT_EQ(bench_.counters().resent_packets, 6);
  EXPECT_EQ(bench_.counters().missing_packets, 11);
}

}  // namespace
}  // namespace tubesight::tests
