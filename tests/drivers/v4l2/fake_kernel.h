#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <linux/videodev2.h>

#include "drivers/v4l2/kernel.h"
#include "hal/clock.h"
#include "tests/drivers/v4l2/fake_camera.h"

namespace tubesight::tests {

/// A kernel with cameras, whose time goes on only while somebody waits for it.
class FakeKernel final : public drivers::v4l2::Kernel, public hal::Clock {
 public:
  /// Plugs a camera in as /dev/videoNUMBER.
  std::shared_ptr<FakeCamera> plug(int number, std::shared_ptr<FakeCamera> camera);
  /// Pulls it out: whoever has it open gets ENODEV for everything from now on.
  void unplug(int number);
  /// A path that leads to another.
  void link(const std::string& from, const std::string& to) { links_[from] = to; }

  /// A camera's source changes, told with this number: whoever has subscribed to it is told, and
  /// nobody else ever.
  void change_source(FakeCamera& camera, std::uint32_t id = 0);
  /// A control gets another value, told in the same way.
  void change_control(FakeCamera& camera, std::uint32_t id, std::int32_t value);

  void advance(core::FieldTime by) { now_ += by; }
  [[nodiscard]] core::FieldTime now() const override { return now_; }

  /// What was not given back.
  [[nodiscard]] int open_devices() const { return static_cast<int>(opened_.size()); }
  [[nodiscard]] int mapped() const { return mapped_; }
  /// Calls of one request so far, by all.
  [[nodiscard]] int calls(unsigned long request) const;

  int open(const std::string& path) override;
  void close(int descriptor) override;
  int ioctl(int descriptor, unsigned long request, void* argument) override;
  void* map(int descriptor, std::size_t bytes, std::uint32_t offset) override;
  void unmap(void* memory, std::size_t bytes) override;
  int poll(int descriptor, short events, int timeout_ms) override;
  std::vector<std::string> list(const std::string& folder) override;
  std::string real_path(const std::string& path) override;
  std::string first_line(const std::string& path) override;

 private:
  struct Buffer {
    std::vector<std::byte> memory;
    bool queued = false;
    v4l2_buffer told{};
  };
  struct Opened {
    std::shared_ptr<FakeCamera> camera;
    int number = 0;
    v4l2_pix_format format{};
    std::vector<Buffer> buffers;
    std::vector<std::uint32_t> queue;
    std::vector<std::uint32_t> done;
    bool streams = false;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> subscribed;  ///< types and numbers
    std::uint32_t sequence = 0;
    bool bottom = false;  ///< the next of alternate fields
    core::FieldTime next{0};
  };

  [[nodiscard]] bool plugged(const Opened& opened) const;
  int answer(Opened& opened, unsigned long request, void* argument);
  int answer_format(Opened& opened, unsigned long request, void* argument);
  int answer_stream(Opened& opened, unsigned long request, void* argument);
  int set_format(Opened& opened, v4l2_format& format) const;
  [[nodiscard]] bool others_stream(const Opened& opened) const;
  void tell(FakeCamera& camera, const v4l2_event& event);
  int give_buffers(Opened& opened, v4l2_requestbuffers& wanted) const;
  int dequeue(Opened& opened, v4l2_buffer& buffer);
  void expose(Opened& opened);

  core::FieldTime now_{1'000'000'000'000};
  std::map<int, std::shared_ptr<FakeCamera>> cameras_;
  std::map<std::string, std::string> links_;
  std::map<int, Opened> opened_;
  std::map<unsigned long, int> calls_;
  int next_descriptor_ = 3;
  int mapped_ = 0;
  std::int64_t exposed_ = 0;
};

}  // namespace tubesight::tests
