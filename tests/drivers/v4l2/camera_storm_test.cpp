// All that goes wrong with a camera at once, in any order. What is lent as good was delivered
// whole, by the right input, with a signal, and once; and in the end nothing is left behind.

#include <cerrno>
#include <chrono>
#include <functional>
#include <map>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <poll.h>

#include "tests/drivers/v4l2/camera_bench.h"

namespace tubesight::tests {
namespace {

using core::FieldStatus;
using std::chrono::milliseconds;

using Memory = std::span<std::byte>;

class CameraStorm : public testing::TestWithParam<unsigned> {
 protected:
  CameraStorm()
      : bench_(settings_of(interlaced() ? core::Scan::kEvenFirst : core::Scan::kProgressive)) {
    bench_.camera().inputs.push_back({"Composite 1", 0});
    if (interlaced()) {
      bench_.camera().fields = {V4L2_FIELD_INTERLACED};
    }
    bench_.camera().tamper = [this](auto, v4l2_buffer& buffer, Memory memory) {
      expose(buffer, memory);
    };
  }

  static bool interlaced() { return GetParam() % 2 != 0; }
  bool one_in(unsigned of) { return random_() % of == 0; }

  /// One buffer in four is wrong in some way.
  void expose(v4l2_buffer& buffer, Memory memory) {
    FakeCamera& camera = bench_.camera();
    bool bad = camera.input != 0 || next_unwritten_;
    if (one_in(4)) {
      bad = spoil(buffer, memory) || bad;
    }
    bad_[memory.data()] = bad;
    next_unwritten_ = one_in(16);
    if (next_unwritten_) {
      camera.unwritten = {{0, 48}};
    }
  }

  bool spoil(v4l2_buffer& buffer, Memory memory) {
    switch (random_() % 8) {
      case 0: buffer.flags |= V4L2_BUF_FLAG_ERROR; return true;
      case 1: buffer.bytesused -= 7; return true;
      case 2: buffer.bytesused = 0; return true;
      case 3: std::fill(memory.begin(), memory.end(), std::byte{35}); return true;
      case 4: buffer.timestamp.tv_sec += 1'000; return true;
      case 5: buffer.timestamp.tv_sec -= 5; return true;
      case 6: buffer.sequence += 3; return false;
      default:
        for (std::byte& pixel : memory) {
          pixel = static_cast<std::byte>(random_() >> 24);
        }
        return true;
    }
  }

  /// What befalls the device beside its pictures.
  void befall() {
    FakeCamera& camera = bench_.camera();
    constexpr unsigned long kRefused[] = {VIDIOC_QBUF,  VIDIOC_DQBUF,   VIDIOC_STREAMON,
                                          VIDIOC_S_FMT, VIDIOC_REQBUFS, VIDIOC_QUERYBUF,
                                          VIDIOC_G_FMT, VIDIOC_DQEVENT, VIDIOC_STREAMOFF};
    constexpr int kErrors[] = {-EIO, -EINVAL, -EBUSY, -EPIPE, -ENOMEM};
    switch (random_() % 7) {
      case 0:
        camera.results[kRefused[random_() % std::size(kRefused)]].push_back(
            kErrors[random_() % std::size(kErrors)]);
        break;
      case 1: camera.poll_results.push_back(one_in(2) ? POLLERR : -EINTR); break;
      case 2: camera.poll_results.push_back(one_in(2) ? POLLPRI : POLLIN); break;
      case 3: camera.input = 1 - camera.input; break;
      case 4: {
        v4l2_event change{};
        change.type = V4L2_EVENT_SOURCE_CHANGE;
        camera.events.push_back(change);
        break;
      }
      case 5: camera.every = one_in(3) ? core::FieldTime{0} : core::FieldTime{33'333'333}; break;
      default: replug(); break;
    }
  }

  void replug() {
    const int next = 1 - node_;
    bench_.kernel().unplug(node_);
    bench_.kernel().plug(next, bench_.shared_camera());
    bench_.kernel().link(kByPath, "/dev/video" + std::to_string(next));
    node_ = next;
  }

  [[nodiscard]] bool of_a_bad_buffer(const core::Field& field) const {
    const auto* const pixels = reinterpret_cast<const std::byte*>(field.pixels.pixels);
    auto at = bad_.upper_bound(pixels);
    return at == bad_.begin() || (--at)->second;
  }

  std::mt19937 random_{GetParam()};
  std::map<const std::byte*, bool> bad_;
  bool next_unwritten_ = false;  ///< the driver hands the next buffer out as it got it
  int node_ = 0;
  CameraBench bench_;
};

TEST_P(CameraStorm, NothingWrongIsLentAsGood) {
  std::int64_t last_number = -1;
  core::FieldTime last_time{0};
  int good = 0;
  bool open = false;
  for (int i = 0; i < 5'000; ++i) {
    if (one_in(40)) {
      befall();
    }
    if (!open) {
      bench_.grabber().stop();
      bench_.kernel().advance(milliseconds(500));
      open = static_cast<bool>(bench_.grabber().start());
      bench_.camera().every = core::FieldTime{33'333'333};
      continue;
    }
    const auto lease = bench_.grab(60);
    if (lease) {
      const core::Field& field = lease->field();
      ASSERT_GT(field.number, last_number) << i;
      ASSERT_GT(field.mid_exposure, last_time) << i;
      last_number = field.number;
      last_time = field.mid_exposure;
      if (field.status == FieldStatus::kGood) {
        ASSERT_FALSE(of_a_bad_buffer(field)) << i;
        ++good;
      }
      if (one_in(100)) {
        replug();  // in our hands
      }
    } else {
      open = lease.error() == core::Error::kTimeout;
    }
  }
  EXPECT_GT(good, 1'000);

  bench_.grabber().stop();
  EXPECT_EQ(bench_.kernel().open_devices(), 0);
  EXPECT_EQ(bench_.kernel().mapped(), 0);
  bench_.camera().results.clear();
  bench_.camera().poll_results.clear();
  bench_.camera().events.clear();
  bench_.camera().tamper = nullptr;
  bench_.camera().unwritten.clear();
  bench_.camera().every = core::FieldTime{33'333'333};
  ASSERT_TRUE(bench_.grabber().start()) << bench_.message();
  EXPECT_EQ(bench_.camera().input, 0);
  EXPECT_TRUE(bench_.good_within(2));
}

INSTANTIATE_TEST_SUITE_P(Seeds, CameraStorm, testing::Range(1u, 3u));

}  // namespace
}  // namespace tubesight::tests
