// What a camera, its cable and its driver do wrong. Each test injects one fault and shows the state
// that follows, what was counted, and how it ends.

#include <cerrno>
#include <chrono>
#include <random>

#include <gtest/gtest.h>
#include <poll.h>

#include "tests/drivers/v4l2/camera_bench.h"

namespace tubesight::tests {
namespace {

using core::Error;
using core::FieldStatus;
using core::Scan;
using drivers::CameraTrouble;
using std::chrono::milliseconds;
using std::chrono::seconds;

using Memory = std::span<std::byte>;

void fill(Memory memory, int grey) {
  std::fill(memory.begin(), memory.end(), static_cast<std::byte>(grey));
}

class CameraFaults : public testing::Test {
 protected:
  void SetUp() override { ASSERT_TRUE(bench_.grabber().start()) << bench_.message(); }

  /// Every picture from now on is this.
  void show(std::function<void(Memory)> picture) {
    bench_.camera().tamper = [picture](auto, v4l2_buffer&, Memory memory) { picture(memory); };
  }
  void expect_error(Error error) {
    const auto lease = bench_.grab(2000);
    ASSERT_FALSE(lease);
    EXPECT_EQ(lease.error(), error);
    const auto again = bench_.grab();
    ASSERT_FALSE(again) << "it stays until the camera is started anew";
    EXPECT_EQ(again.error(), error);
  }
  void expect_recovery() {
    ASSERT_TRUE(bench_.start_anew()) << bench_.message();
    EXPECT_TRUE(bench_.good_within(1));
    EXPECT_EQ(bench_.report().trouble, CameraTrouble::kNone);
    EXPECT_EQ(bench_.kernel().open_devices(), 1) << "the old one was closed";
    EXPECT_EQ(bench_.kernel().mapped(), 6);
  }

  CameraBench bench_;
};

TEST_F(CameraFaults, AnInputWithoutSignalDamagesWhatIsDelivered) {
  bench_.camera().inputs[0].status = V4L2_IN_ST_NO_SIGNAL;
  bench_.grabber().look_after();

  EXPECT_EQ(bench_.next_status(), FieldStatus::kDamaged);
  EXPECT_EQ(bench_.report().trouble, CameraTrouble::kNoSignal);
  EXPECT_EQ(bench_.counters().without_signal, 1);

  bench_.camera().inputs[0].status = 0;
  bench_.grabber().look_after();
  EXPECT_TRUE(bench_.good_within(1));
  EXPECT_EQ(bench_.report().trouble, CameraTrouble::kNone);
}

TEST_F(CameraFaults, LossOfLockIsLossOfSignalAndLossOfColourIsNot) {
  bench_.camera().inputs[0].status = V4L2_IN_ST_NO_H_LOCK;
  bench_.grabber().look_after();
  EXPECT_EQ(bench_.next_status(), FieldStatus::kDamaged);

  bench_.camera().inputs[0].status = V4L2_IN_ST_NO_COLOR | V4L2_IN_ST_COLOR_KILL;
  bench_.grabber().look_after();
  EXPECT_EQ(bench_.next_status(), FieldStatus::kGood) << "cameras are black and white";
}

TEST_F(CameraFaults, SnowWithoutAnyFlagIsDamaged) {
  std::mt19937 random(3);
  show([&](Memory memory) {
    for (std::byte& pixel : memory) {
      pixel = static_cast<std::byte>(random() >> 24);
    }
  });

  EXPECT_EQ(bench_.next_status(), FieldStatus::kDamaged);
  EXPECT_EQ(bench_.report().trouble, CameraTrouble::kNoise);
  EXPECT_EQ(bench_.counters().noise, 1);

  bench_.camera().tamper = nullptr;
  EXPECT_TRUE(bench_.good_within(1));
}

TEST_F(CameraFaults, ABlueScreenIsDamaged) {
  show([](Memory memory) { fill(memory, 35); });

  EXPECT_EQ(bench_.next_status(), FieldStatus::kDamaged);
  EXPECT_EQ(bench_.report().trouble, CameraTrouble::kBlank);
  EXPECT_EQ(bench_.counters().blank, 1);

  bench_.camera().tamper = nullptr;
  EXPECT_TRUE(bench_.good_within(1));
}

// The session says of it that the picture shows no light, and vouches for nothing.
TEST_F(CameraFaults, ABlackPictureIsCountedAndLeftToTheSession) {
  show([](Memory memory) { fill(memory, 16); });

  EXPECT_EQ(bench_.next_status(), FieldStatus::kGood);
  EXPECT_EQ(bench_.counters().black, 1);
}

TEST_F(CameraFaults, ABufferFlaggedWithAnErrorIsDamaged) {
  bench_.camera().tamper = [](auto, v4l2_buffer& buffer, Memory) {
    buffer.flags |= V4L2_BUF_FLAG_ERROR;
    buffer.bytesused = 0;
  };

  EXPECT_EQ(bench_.next_status(), FieldStatus::kDamaged);
  EXPECT_EQ(bench_.report().trouble, CameraTrouble::kDamaged);
  EXPECT_EQ(bench_.counters().flagged, 1);
  EXPECT_EQ(bench_.counters().cut_short, 0) << "told once";

  bench_.camera().tamper = nullptr;
  EXPECT_TRUE(bench_.good_within(1));
}

TEST_F(CameraFaults, ABufferWithLessThanThePictureIsDamaged) {
  bench_.camera().tamper = [](auto, v4l2_buffer& buffer, Memory) { buffer.bytesused -= 1; };

  EXPECT_EQ(bench_.next_status(), FieldStatus::kDamaged);
  EXPECT_EQ(bench_.counters().cut_short, 1);

  bench_.camera().tamper = nullptr;
  EXPECT_TRUE(bench_.good_within(1));
}

TEST_F(CameraFaults, OneRefusalToTakeABufferBackPasses) {
  for (const int error : {-EIO, -EINVAL}) {
    const std::int64_t before = bench_.counters().queue_errors;
    bench_.camera().results[VIDIOC_QBUF] = {error};

    EXPECT_TRUE(bench_.good_within(1));
    EXPECT_TRUE(bench_.good_within(1));
    EXPECT_EQ(bench_.counters().queue_errors, before + 1);
  }
  for (int i = 0; i < 12; ++i) {
    EXPECT_TRUE(bench_.good_within(1)) << "no buffer was lost on the way";
  }
}

TEST_F(CameraFaults, RefusalsToTakeABufferBackEndTheStream) {
  bench_.camera().results[VIDIOC_QBUF] = std::deque<int>(100, -EIO);
  ASSERT_TRUE(bench_.good_within(1));
  ASSERT_TRUE(bench_.good_within(1));
  ASSERT_TRUE(bench_.good_within(1)) << "there are others meanwhile";

  expect_error(Error::kIo);
  EXPECT_EQ(bench_.report().trouble, CameraTrouble::kStream);
  bench_.camera().results.clear();
  expect_recovery();
}

TEST_F(CameraFaults, OneRefusalToGiveABufferPasses) {
  for (const int error : {-EIO, -EINVAL}) {
    bench_.camera().results[VIDIOC_DQBUF] = {error};

    EXPECT_TRUE(bench_.good_within(1));
  }
  EXPECT_EQ(bench_.counters().dequeue_errors, 2);
  EXPECT_EQ(bench_.report().trouble, CameraTrouble::kNone);
}

TEST_F(CameraFaults, RefusalsToGiveABufferEndTheStream) {
  bench_.camera().results[VIDIOC_DQBUF] = {-EINVAL, -EINVAL, -EINVAL};

  expect_error(Error::kIo);
  EXPECT_EQ(bench_.report().trouble, CameraTrouble::kStream);
  EXPECT_EQ(bench_.counters().dequeue_errors, 3);
  expect_recovery();
}

TEST_F(CameraFaults, AFatalErrorOfTheStreamEndsIt) {
  bench_.camera().poll_results = {POLLERR, POLLERR, POLLERR};
  bench_.camera().results[VIDIOC_DQBUF] = {-EIO, -EIO, -EIO};

  expect_error(Error::kIo);
  EXPECT_EQ(bench_.report().trouble, CameraTrouble::kStream);
  expect_recovery();
}

TEST_F(CameraFaults, ABufferThatTheDriverDoesNotHaveEndsTheStream) {
  bench_.camera().tamper = [](auto, v4l2_buffer& buffer, Memory) { buffer.index = 99; };

  expect_error(Error::kIo);
  bench_.camera().tamper = nullptr;
  expect_recovery();
}

TEST_F(CameraFaults, ADeviceThatAnnouncesAndHasNothingIsNotAskedForEver) {
  bench_.camera().poll_results = std::deque<int>(100, POLLIN);

  expect_error(Error::kIo);
  EXPECT_EQ(bench_.counters().idle_wakes, 8);
  EXPECT_LT(bench_.kernel().calls(VIDIOC_DQBUF), 10);
  bench_.camera().poll_results.clear();
  expect_recovery();
}

TEST_F(CameraFaults, EventsAnnouncedWithoutEndDoNotKeepAProcessorBusy) {
  bench_.camera().poll_results = std::deque<int>(100, POLLPRI);

  expect_error(Error::kIo);
  EXPECT_LT(bench_.kernel().calls(VIDIOC_DQEVENT), 10);
  bench_.camera().poll_results.clear();
  expect_recovery();
}

TEST_F(CameraFaults, ASignalOfTheSystemIsNoTimeout) {
  bench_.camera().poll_results = {-EINTR, -EINTR};

  EXPECT_TRUE(bench_.good_within(1));
}

TEST_F(CameraFaults, ADeviceThatIsGoneIsFoundOnAnotherNodeWhenItIsBack) {
  ASSERT_TRUE(bench_.good_within(3));
  bench_.kernel().unplug(0);

  expect_error(Error::kDisconnected);
  EXPECT_EQ(bench_.report().trouble, CameraTrouble::kGone);
  EXPECT_EQ(bench_.counters().disconnects, 1);

  const auto absent = bench_.start_anew();
  ASSERT_FALSE(absent);
  EXPECT_EQ(absent.error(), Error::kDisconnected);
  EXPECT_EQ(bench_.message(),
            std::string("camera ") + kByPath + ": is not there, expected one of: no camera is");
  EXPECT_EQ(bench_.kernel().mapped(), 0) << "all memory was given back all the same";

  bench_.kernel().plug(3, bench_.shared_camera());
  bench_.kernel().link(kByPath, "/dev/video3");
  expect_recovery();
}

// Without a number in the calibration nothing else would tell it from the one that was there.
TEST_F(CameraFaults, AnotherCameraAtTheSamePlaceIsNotTaken) {
  EXPECT_EQ(bench_.grabber().doubt(),
            "calibration is bound to no camera: this one is model = \"fake Grabber\"");
  bench_.kernel().unplug(0);
  expect_error(Error::kDisconnected);

  const auto other = std::make_shared<FakeCamera>();
  other->serial = "4712";
  bench_.kernel().plug(0, other);
  const auto started = bench_.start_anew();
  ASSERT_FALSE(started);
  EXPECT_EQ(started.error(), Error::kUnsupported);
  EXPECT_EQ(bench_.message(), std::string("camera ") + kByPath +
                                  ": has the serial number 4712, expected one without, the one "
                                  "that this box has used so far");

  bench_.kernel().plug(0, bench_.shared_camera());
  expect_recovery();
}

// Its calibration holds for one size; pictures of another are not stretched to it.
TEST_F(CameraFaults, ACameraThatComesBackWithAnotherSizeIsNotTaken) {
  bench_.kernel().unplug(0);
  expect_error(Error::kDisconnected);
  bench_.camera().widths_of = 80;
  bench_.kernel().plug(0, bench_.shared_camera());

  const auto started = bench_.start_anew();
  ASSERT_FALSE(started);
  EXPECT_EQ(started.error(), Error::kUnsupported);
  EXPECT_NE(bench_.message().find("offers GREY 80 x 48 progressive, expected"), std::string::npos)
      << bench_.message();

  bench_.camera().widths_of = 1;
  expect_recovery();
}

TEST_F(CameraFaults, ADeviceThatGoesInTheMiddleOfACallIsGone) {
  bench_.camera().results[VIDIOC_DQBUF] = {-ENODEV};

  expect_error(Error::kDisconnected);
  EXPECT_EQ(bench_.report().trouble, CameraTrouble::kGone);
  expect_recovery();
}

TEST_F(CameraFaults, SilenceEndsTheStreamAfterASecond) {
  ASSERT_TRUE(bench_.good_within(1));
  bench_.camera().every = {};
  const core::FieldTime begin = bench_.kernel().now();
  for (int i = 0; i < 9; ++i) {
    const auto lease = bench_.grab(100);
    ASSERT_FALSE(lease);
    EXPECT_EQ(lease.error(), Error::kTimeout) << i;
  }

  expect_error(Error::kIo);
  EXPECT_LE(bench_.kernel().now() - begin, seconds(3));
  EXPECT_EQ(bench_.report().trouble, CameraTrouble::kSilent);
  EXPECT_EQ(bench_.counters().silences, 1);
  bench_.camera().every = milliseconds(33);
  expect_recovery();
}

TEST_F(CameraFaults, BeforeItsFirstPictureACameraMaySettleForSomeSeconds) {
  bench_.grabber().stop();
  bench_.camera().every = milliseconds(4000);
  ASSERT_TRUE(bench_.grabber().start());
  for (int i = 0; i < 3; ++i) {
    const auto lease = bench_.grab(1000);
    ASSERT_FALSE(lease);
    EXPECT_EQ(lease.error(), Error::kTimeout) << i;
  }
  EXPECT_TRUE(bench_.grab(1500));

  bench_.camera().every = {};
  ASSERT_TRUE(bench_.start_anew());
  for (int i = 0; i < 4; ++i) {
    ASSERT_EQ(bench_.grab(1000).error(), Error::kTimeout) << i;
  }
  expect_error(Error::kIo);
  EXPECT_EQ(bench_.report().trouble, CameraTrouble::kSilent);
}

TEST_F(CameraFaults, AChangeOfTheSourceIsANewBeginning) {
  v4l2_event change{};
  change.type = V4L2_EVENT_SOURCE_CHANGE;
  bench_.camera().events = {v4l2_event{}, change};

  expect_error(Error::kIo);
  EXPECT_EQ(bench_.report().trouble, CameraTrouble::kSourceChanged);
  EXPECT_EQ(bench_.counters().source_changes, 1);
  expect_recovery();
}

// Behind the other input there is the camera of another tool.
TEST_F(CameraFaults, AnInputThatSomebodySwitchedIsChosenAnew) {
  bench_.camera().inputs.push_back({"Composite 1", 0});
  ASSERT_TRUE(bench_.good_within(1));
  bench_.camera().input = 1;

  expect_error(Error::kIo);
  EXPECT_EQ(bench_.report().trouble, CameraTrouble::kSwitched);
  EXPECT_EQ(bench_.counters().source_changes, 1);
  expect_recovery();
  EXPECT_EQ(bench_.camera().input, 0) << "that of the first start, where the settings name none";
}

TEST_F(CameraFaults, AnInputThatCannotBeChosenAnewIsNotExchangedForAnother) {
  bench_.camera().inputs.push_back({"Composite 1", 0});
  bench_.camera().input = 1;
  expect_error(Error::kIo);
  const std::string stands = std::string("camera ") + kByPath +
                             ": stands at input 1, expected 0, the one that this box has used so "
                             "far";
  bench_.camera().results[VIDIOC_S_INPUT] = {-EBUSY};
  ASSERT_FALSE(bench_.start_anew());
  EXPECT_EQ(bench_.message(), stands + ": Device or resource busy");
  bench_.camera().stays_at_input = true;
  ASSERT_FALSE(bench_.start_anew());
  EXPECT_EQ(bench_.message(), stands);

  bench_.camera().stays_at_input = false;
  expect_recovery();
  EXPECT_EQ(bench_.camera().input, 0);
}

TEST_F(CameraFaults, OtherEventsAreNone) {
  bench_.camera().events = {v4l2_event{}};

  EXPECT_TRUE(bench_.good_within(1));
  EXPECT_EQ(bench_.counters().source_changes, 0);
}

TEST_F(CameraFaults, TheLastBufferOfADriverIsANewBeginning) {
  bench_.camera().results[VIDIOC_DQBUF] = {-EPIPE};

  expect_error(Error::kIo);
  expect_recovery();
}

}  // namespace
}  // namespace tubesight::tests
