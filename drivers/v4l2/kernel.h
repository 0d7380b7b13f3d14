#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tubesight::drivers::v4l2 {

/// The system calls that a camera takes, and nothing else of the system: where a test puts a kernel
/// of its own. What fails gives -errno.
class Kernel {
 public:
  /// Opens a device for reading and writing, without waiting; gives its descriptor.
  [[nodiscard]] virtual int open(const std::string& path) = 0;
  virtual void close(int descriptor) = 0;
  /// 0 when done. One that a signal broke off is made again.
  [[nodiscard]] virtual int ioctl(int descriptor, unsigned long request, void* argument) = 0;
  /// Memory that the device shares; null when it cannot be had.
  [[nodiscard]] virtual void* map(int descriptor, std::size_t bytes, std::uint32_t offset) = 0;
  virtual void unmap(void* memory, std::size_t bytes) = 0;
  /// Waits for `events` of poll(); gives those that came, 0 after the time.
  [[nodiscard]] virtual int poll(int descriptor, short events, int timeout_ms) = 0;

  /// Names in a folder, sorted; empty where there is none.
  [[nodiscard]] virtual std::vector<std::string> list(const std::string& folder) = 0;
  /// Where a path leads when all links are followed; empty where it leads nowhere.
  [[nodiscard]] virtual std::string real_path(const std::string& path) = 0;
  /// The first line of a small file, printable ASCII alone; empty where there is none.
  [[nodiscard]] virtual std::string first_line(const std::string& path) = 0;

 protected:
  ~Kernel() = default;
};

/// This machine's.
[[nodiscard]] Kernel& system_kernel();

}  // namespace tubesight::drivers::v4l2
