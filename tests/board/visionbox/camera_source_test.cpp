#include "board/visionbox/camera_source.h"

#include <chrono>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "tests/hal/frame_grabber_contract.h"

namespace tubesight::board {
namespace {

using core::Error;
using std::chrono::milliseconds;

/// A camera whose faults a test sets while it runs; delivers a field at once.
class FakeCamera final : public Camera, public hal::FrameGrabber {
 public:
  // As a camera.
  hal::FrameGrabber& grabber() override { return *this; }
  void look_after() override { ++looks_; }
  std::string message() const override { return "camera x: is not there"; }
  std::string doubt() const override { return unbound_ ? "calibration is bound to no camera" : ""; }
  core::FieldTime span() const override { return milliseconds(20); }
  std::int32_t fields_at_once() const override { return 2; }
  CameraStatus status() const override {
    const bool well = well_ && !gone_;
    return {well, gone_ ? "the device is gone" : well ? "well" : "no signal", true, true, {}, {}};
  }

  // As its grabber.
  core::Result<void> start() override {
    starting_ = true;
    while (slow_) {
      std::this_thread::sleep_for(milliseconds(1));
    }
    starting_ = false;
    if (absent_) {
      return core::Unexpected(Error::kDisconnected);
    }
    started_ = true;
    return {};
  }
  void stop() override { started_ = false; }
  core::Result<hal::FieldLease> grab_for(milliseconds timeout) override {
    if (gone_) {
      return core::Unexpected(Error::kDisconnected);
    }
    if (silent_) {
      std::this_thread::sleep_for(timeout);
      return core::Unexpected(Error::kTimeout);
    }
    if (!started_ || lent_) {
      return core::Unexpected(Error::kNotReady);
    }
    core::Field field;
    field.sequence = field.number = number_++;
    field.mid_exposure = monotonic_now() - milliseconds(50);
    field.pixels = {pixels_.data(), 4, 2, 4, 0, 1};
    lent_ = true;
    return hal::FieldLease(*this, 0, field);
  }
  void give_back(std::int32_t) override { lent_ = false; }

  std::atomic<bool> absent_{false};
  std::atomic<bool> gone_{false};
  std::atomic<bool> silent_{false};
  std::atomic<bool> slow_{false};  ///< an opening lasts as long as this
  std::atomic<bool> starting_{false};
  std::atomic<bool> unbound_{false};
  std::atomic<bool> well_{true};
  std::atomic<bool> started_{false};
  std::atomic<int> looks_{0};

 private:
  bool lent_ = false;
  std::int64_t number_ = 0;
  std::vector<std::uint8_t> pixels_ = std::vector<std::uint8_t>(8, 50);
};

class SourceMaker {
 public:
  hal::FrameGrabber& grabber() { return source_; }

 private:
  FakeCamera camera_;
  CameraSource source_{camera_, [](const std::string&) {}};
};

}  // namespace
}  // namespace tubesight::board

namespace tubesight::support {
namespace {

INSTANTIATE_TYPED_TEST_SUITE_P(CameraSource, FrameGrabberContract, board::SourceMaker);

}  // namespace
}  // namespace tubesight::support

namespace tubesight::board {
namespace {

class CameraSourceTest : public testing::Test {
 protected:
  static constexpr CameraSource::Waits kWaits{milliseconds(5), milliseconds(20), milliseconds(2)};

  core::Result<void> grab() {
    const auto lease = source_.grab_for(milliseconds(1));
    return lease ? core::Result<void>() : core::Unexpected(lease.error());
  }
  /// False after two seconds.
  bool delivers_again() {
    for (int i = 0; i < 2000; ++i) {
      if (grab()) {
        return true;
      }
      std::this_thread::sleep_for(milliseconds(1));
    }
    return false;
  }
  int told(const std::string& line) {
    const std::lock_guard lock(mutex_);
    return static_cast<int>(std::count(lines_.begin(), lines_.end(), line));
  }

  FakeCamera camera_;
  std::mutex mutex_;
  std::vector<std::string> lines_;
  CameraSource source_{camera_,
                       [this](const std::string& line) {
                         const std::lock_guard lock(mutex_);
                         lines_.push_back(line);
                       },
                       kWaits};
};

TEST_F(CameraSourceTest, ACameraThatIsThereDelivers) {
  ASSERT_TRUE(source_.start());
  EXPECT_EQ(source_.state(), SourceState::kOpening);

  EXPECT_TRUE(grab());
  EXPECT_EQ(source_.state(), SourceState::kPlaying);
  EXPECT_EQ(source_.span(), milliseconds(20));
  EXPECT_EQ(source_.fields_at_once(), 2);
  EXPECT_EQ(source_.passes(), 1);
  EXPECT_EQ(source_.failures(), 0);
  source_.stop();
  EXPECT_FALSE(camera_.started_);
}

TEST_F(CameraSourceTest, TheBoxStartsWithoutACameraAndTakesItWhenItComes) {
  camera_.absent_ = true;
  ASSERT_TRUE(source_.start());
  const auto none = grab();
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error(), Error::kDisconnected);
  EXPECT_EQ(source_.state(), SourceState::kFailed);
  std::this_thread::sleep_for(milliseconds(30));
  EXPECT_EQ(told("camera x: is not there"), 1) << "once, however often it is tried";
  EXPECT_GE(source_.failures(), 2);

  camera_.absent_ = false;
  EXPECT_TRUE(delivers_again());
  EXPECT_EQ(told("camera: opened"), 1);
  EXPECT_EQ(source_.state(), SourceState::kPlaying);
}

TEST_F(CameraSourceTest, ACameraThatGoesIsClosedAndOpenedAnew) {
  ASSERT_TRUE(source_.start());
  ASSERT_TRUE(grab());
  camera_.gone_ = true;
  camera_.absent_ = true;

  const auto gone = grab();
  ASSERT_FALSE(gone);
  EXPECT_EQ(gone.error(), Error::kDisconnected);
  EXPECT_EQ(source_.state(), SourceState::kFailed);
  for (int i = 0; i < 2000 && camera_.started_; ++i) {
    std::this_thread::sleep_for(milliseconds(1));
  }
  EXPECT_FALSE(camera_.started_) << "closed, on the source's thread";
  EXPECT_EQ(told("camera: the device is gone"), 1);

  camera_.gone_ = false;
  camera_.absent_ = false;
  EXPECT_TRUE(delivers_again());
  EXPECT_EQ(source_.passes(), 2);
}

// An absent camera of a network keeps its library for 2.5 s.
TEST_F(CameraSourceTest, AnOpeningThatTakesLongKeepsNobodyWaiting) {
  ASSERT_TRUE(source_.start());
  ASSERT_TRUE(grab());
  camera_.slow_ = true;
  camera_.gone_ = true;
  ASSERT_FALSE(grab());
  for (int i = 0; i < 2000 && !camera_.starting_; ++i) {
    std::this_thread::sleep_for(milliseconds(1));
  }
  ASSERT_TRUE(camera_.starting_) << "on the source's thread";

  for (int i = 0; i < 100; ++i) {
    const auto none = grab();
    ASSERT_FALSE(none);
    EXPECT_EQ(none.error(), Error::kDisconnected);
  }
  EXPECT_TRUE(camera_.starting_) << "while it goes on";

  camera_.gone_ = false;
  camera_.slow_ = false;
  EXPECT_TRUE(delivers_again());
}

TEST_F(CameraSourceTest, AFieldThatDoesNotComeIsATimeout) {
  ASSERT_TRUE(source_.start());
  camera_.silent_ = true;

  const auto none = grab();

  ASSERT_FALSE(none);
  EXPECT_EQ(none.error(), Error::kTimeout);
  camera_.silent_ = false;
  EXPECT_TRUE(grab()) << "it stays open";
}

TEST_F(CameraSourceTest, IsLookedAfterWhileItIsOpen) {
  ASSERT_TRUE(source_.start());
  for (int i = 0; i < 2000 && camera_.looks_ < 3; ++i) {
    std::this_thread::sleep_for(milliseconds(1));
  }

  EXPECT_GE(camera_.looks_, 3);
}

TEST_F(CameraSourceTest, ATroubleThatStaysIsToldOnceAndItsEnd) {
  ASSERT_TRUE(source_.start());
  ASSERT_TRUE(grab());
  camera_.well_ = false;
  const auto told_within = [this](const std::string& line) {
    for (int i = 0; i < 2000 && told(line) == 0; ++i) {
      std::this_thread::sleep_for(milliseconds(1));
    }
    std::this_thread::sleep_for(milliseconds(20));
    return told(line);
  };
  EXPECT_EQ(told_within("camera: no signal"), 1);
  camera_.well_ = true;
  EXPECT_EQ(told_within("camera: well again"), 1);
}

// A line says that it was opened: without another one all would seem well.
TEST_F(CameraSourceTest, ATroubleThatOutlivesAnOpeningIsToldAgain) {
  const auto told_within = [this](const std::string& line, int times) {
    for (int i = 0; i < 2000 && told(line) < times; ++i) {
      std::this_thread::sleep_for(milliseconds(1));
    }
    return told(line);
  };
  camera_.well_ = false;
  ASSERT_TRUE(source_.start());
  ASSERT_TRUE(grab());
  ASSERT_EQ(told_within("camera: no signal", 1), 1);
  camera_.gone_ = true;
  ASSERT_FALSE(grab());
  ASSERT_EQ(told_within("camera: the device is gone", 1), 1);
  camera_.gone_ = false;
  ASSERT_TRUE(delivers_again());
  EXPECT_EQ(told_within("camera: no signal", 2), 2);
  camera_.well_ = true;
  EXPECT_EQ(told_within("camera: well again", 1), 1);
}

TEST_F(CameraSourceTest, WhatTheCalibrationLeavesOpenIsToldOnce) {
  camera_.unbound_ = true;
  ASSERT_TRUE(source_.start());
  ASSERT_TRUE(grab());
  EXPECT_EQ(source_.doubt(), "calibration is bound to no camera");
  camera_.gone_ = true;
  ASSERT_FALSE(grab());
  camera_.gone_ = false;
  EXPECT_TRUE(delivers_again());
  EXPECT_EQ(told("camera: calibration is bound to no camera"), 1);
}

TEST_F(CameraSourceTest, AFieldIsDueAfterTheShortestWayOfItsKind) {
  ASSERT_TRUE(source_.start());
  ASSERT_TRUE(grab());
  EXPECT_EQ(source_.due(), source_.handed_over()) << "the first one is its own measure";
  for (int i = 0; i < 20; ++i) {
    ASSERT_TRUE(grab());
    EXPECT_LE(source_.due(), source_.handed_over());
  }
}

}  // namespace
}  // namespace tubesight::board
