// What stands before the emulated board's camera: plays a recording into the output of the kernel's
// virtual camera, which shows it to its capture node, and sets that node's controls, which inject
// faults.
//
// Usage: board_camera play DEVICE RECORDING.y4m FIRST:LAST...
//        board_camera set DEVICE NAME VALUE|WORD
//
// `play` shows the frames FIRST to LAST in a circle until SIGUSR1 comes, then all that follow up to
// the end of the next circle, which goes on in turn; behind the last one comes the first. At rest
// all frames of a circle show the tool in one place.

#include <array>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include <fcntl.h>
#include <linux/videodev2.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

namespace {

constexpr std::uint32_t kWidth_px = 720;
constexpr std::uint32_t kHeight_px = 480;
constexpr std::size_t kFrameBytes = std::size_t{kWidth_px} * kHeight_px;
constexpr std::string_view kFrameHead = "FRAME\n";

volatile std::sig_atomic_t go_on = 0;

[[noreturn]] void fail(const std::string& what) {
  std::fprintf(stderr, "board_camera: %s: %s\n", what.c_str(), std::strerror(errno));
  std::exit(1);
}

template <typename T>
void ask(int device, unsigned long request, T* argument, const char* what) {
  while (::ioctl(device, request, argument) != 0) {
    if (errno != EINTR) {
      fail(what);
    }
  }
}

int open_device(const char* path) {
  const int device = ::open(path, O_RDWR | O_CLOEXEC);
  if (device < 0) {
    fail(path);
  }
  return device;
}

/// The first frames of a recording of whole grey pictures, in memory: a read may be late.
class Recording {
 public:
  Recording(const char* path, std::int64_t frames)
      : pixels_(static_cast<std::size_t>(frames) * kFrameBytes) {
    std::FILE* const file = std::fopen(path, "rb");
    std::array<char, 256> head{};
    if (file == nullptr || std::fgets(head.data(), head.size(), file) == nullptr) {
      fail(path);
    }
    const std::string_view text(head.data());
    if (!text.starts_with("YUV4MPEG2 W720 H480 ") || text.find("Cmono") == std::string_view::npos) {
      errno = EINVAL;
      fail(std::string(path) + ": expected 720 x 480 grey");
    }
    for (std::size_t at = 0; at < pixels_.size(); at += kFrameBytes) {
      if (std::fread(head.data(), kFrameHead.size(), 1, file) != 1 ||
          std::fread(&pixels_[at], kFrameBytes, 1, file) != 1) {
        fail(std::string(path) + " ends too early");
      }
    }
    std::fclose(file);
  }

  void copy(std::int64_t frame, void* into) const {
    std::memcpy(into, &pixels_[static_cast<std::size_t>(frame) * kFrameBytes], kFrameBytes);
  }

 private:
  std::vector<char> pixels_;
};

struct Circle {
  std::int64_t first;
  std::int64_t last;
};

/// Which frame comes next.
class Order {
 public:
  explicit Order(std::vector<Circle> circles)
      : circles_(std::move(circles)), frame_(circles_.front().first) {}

  std::int64_t next() {
    const std::int64_t frame = frame_++;
    if (go_on != 0) {
      go_on = 0;
      at_ = (at_ + 1) % circles_.size();
      if (at_ == 0) {
        frame_ = circles_.front().first;
      }
    }
    if (frame_ > circles_[at_].last) {
      frame_ = circles_[at_].first;
    }
    return frame;
  }

 private:
  std::vector<Circle> circles_;
  std::size_t at_ = 0;
  std::int64_t frame_;
};

/// The standard comes before the format on both nodes, or the kernel takes another size.
void set_up(int device) {
  v4l2_std_id standard = V4L2_STD_NTSC;
  ask(device, VIDIOC_S_STD, &standard, "standard");
  v4l2_format format{};
  format.type = V4L2_BUF_TYPE_VIDEO_OUTPUT;
  format.fmt.pix.width = kWidth_px;
  format.fmt.pix.height = kHeight_px;
  format.fmt.pix.pixelformat = V4L2_PIX_FMT_GREY;
  format.fmt.pix.field = V4L2_FIELD_INTERLACED;
  ask(device, VIDIOC_S_FMT, &format, "format");
  if (format.fmt.pix.width != kWidth_px || format.fmt.pix.height != kHeight_px ||
      format.fmt.pix.sizeimage != kFrameBytes || format.fmt.pix.field != V4L2_FIELD_INTERLACED) {
    errno = EINVAL;
    fail("format is another one");
  }
}

void play(const char* path, const Recording& recording, Order order) {
  const int device = open_device(path);
  set_up(device);
  v4l2_requestbuffers wanted{};
  wanted.count = 8;
  wanted.type = V4L2_BUF_TYPE_VIDEO_OUTPUT;
  wanted.memory = V4L2_MEMORY_MMAP;
  ask(device, VIDIOC_REQBUFS, &wanted, "buffers");
  std::vector<void*> places;
  const auto put = [&](std::uint32_t index) {
    recording.copy(order.next(), places[index]);
    v4l2_buffer buffer{};
    buffer.index = index;
    buffer.type = V4L2_BUF_TYPE_VIDEO_OUTPUT;
    buffer.memory = V4L2_MEMORY_MMAP;
    buffer.field = V4L2_FIELD_INTERLACED;
    buffer.bytesused = kFrameBytes;
    // One refusal is meant for the box.
    if (::ioctl(device, VIDIOC_QBUF, &buffer) != 0) {
      ask(device, VIDIOC_QBUF, &buffer, "queue");
    }
  };
  for (std::uint32_t i = 0; i < wanted.count; ++i) {
    v4l2_buffer buffer{};
    buffer.index = i;
    buffer.type = V4L2_BUF_TYPE_VIDEO_OUTPUT;
    buffer.memory = V4L2_MEMORY_MMAP;
    ask(device, VIDIOC_QUERYBUF, &buffer, "buffer");
    void* const place = ::mmap(nullptr, buffer.length, PROT_READ | PROT_WRITE, MAP_SHARED, device,
                               static_cast<off_t>(buffer.m.offset));
    if (place == MAP_FAILED) {
      fail("memory of a buffer");
    }
    places.push_back(place);
    put(i);
  }
  // Before what the test asks on the board meanwhile; behind the box.
  const sched_param priority{40};
  static_cast<void>(::sched_setscheduler(0, SCHED_FIFO, &priority));
  int type = V4L2_BUF_TYPE_VIDEO_OUTPUT;
  ask(device, VIDIOC_STREAMON, &type, "stream");
  std::puts("playing");
  std::fflush(stdout);
  while (true) {
    v4l2_buffer buffer{};
    buffer.type = V4L2_BUF_TYPE_VIDEO_OUTPUT;
    buffer.memory = V4L2_MEMORY_MMAP;
    ask(device, VIDIOC_DQBUF, &buffer, "take back");
    put(buffer.index);
  }
}

/// The number behind a menu's word, or the number itself.
std::int32_t value_of(int device, const v4l2_queryctrl& control, const std::string& text) {
  if (control.type == V4L2_CTRL_TYPE_MENU) {
    v4l2_querymenu entry{};
    entry.id = control.id;
    for (std::int32_t i = control.minimum; i <= control.maximum; ++i) {
      entry.index = static_cast<std::uint32_t>(i);
      if (::ioctl(device, VIDIOC_QUERYMENU, &entry) == 0 &&
          text == reinterpret_cast<const char*>(entry.name)) {
        return i;
      }
    }
  }
  return std::atoi(text.c_str());
}

void set(const char* path, const std::string& name, const std::string& text) {
  const int device = open_device(path);
  v4l2_queryctrl found{};
  found.id = V4L2_CTRL_FLAG_NEXT_CTRL;
  while (::ioctl(device, VIDIOC_QUERYCTRL, &found) == 0) {
    if (name == reinterpret_cast<const char*>(found.name)) {
      v4l2_control control{found.id, value_of(device, found, text)};
      ask(device, VIDIOC_S_CTRL, &control, name.c_str());
      return;
    }
    found.id |= V4L2_CTRL_FLAG_NEXT_CTRL;
  }
  errno = ENOENT;
  fail("control '" + name + "'");
}

std::vector<Circle> circles_of(char** begin, char** end) {
  std::vector<Circle> circles;
  for (; begin != end; ++begin) {
    long long first = 0;
    long long last = 0;
    if (std::sscanf(*begin, "%lld:%lld", &first, &last) != 2 || first > last) {
      errno = EINVAL;
      fail(*begin);
    }
    circles.push_back({first, last});
  }
  return circles;
}

}  // namespace

int main(int count, char** words) {
  const std::string_view command = count > 1 ? words[1] : "";
  if (command == "play" && count > 4) {
    std::signal(SIGUSR1, [](int) { go_on = 1; });
    const std::vector<Circle> circles = circles_of(words + 4, words + count);
    play(words[2], Recording(words[3], circles.back().last + 1), Order(circles));
  } else if (command == "set" && count == 5) {
    set(words[2], words[3], words[4]);
    return 0;
  }
  std::fputs(
      "usage: board_camera play DEVICE RECORDING.y4m FIRST:LAST...\n"
      "       board_camera set DEVICE NAME VALUE|WORD\n",
      stderr);
  return 2;
}
