#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <system_error>

#include <fcntl.h>
#include <poll.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <unistd.h>

#include "drivers/v4l2/kernel.h"

namespace tubesight::drivers::v4l2 {
namespace {

namespace fs = std::filesystem;

class SystemKernel final : public Kernel {
 public:
  int open(const std::string& path) override {
    const int descriptor = ::open(path.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
    return descriptor >= 0 ? descriptor : -errno;
  }

  void close(int descriptor) override { ::close(descriptor); }

  int ioctl(int descriptor, unsigned long request, void* argument) override {
    int status = 0;
    do {
      status = ::ioctl(descriptor, request, argument);
    } while (status == -1 && errno == EINTR);
    return status == -1 ? -errno : 0;
  }

  void* map(int descriptor, std::size_t bytes, std::uint32_t offset) override {
    void* const memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor,
                              static_cast<off_t>(offset));
    return memory == MAP_FAILED ? nullptr : memory;
  }

  void unmap(void* memory, std::size_t bytes) override { munmap(memory, bytes); }

  int poll(int descriptor, short events, int timeout_ms) override {
    pollfd waited{descriptor, events, 0};
    const int status = ::poll(&waited, 1, timeout_ms);
    if (status < 0) {
      return -errno;
    }
    return status == 0 ? 0 : waited.revents;
  }

  std::vector<std::string> list(const std::string& folder) override {
    std::vector<std::string> names;
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
      names.push_back(entry->path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }

  std::string real_path(const std::string& path) override {
    std::error_code error;
    const fs::path real = fs::canonical(path, error);
    return error ? std::string() : real.string();
  }

  std::string first_line(const std::string& path) override {
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0) {
      return {};
    }
    constexpr std::size_t kLongest = 256;
    std::string text(kLongest, '\0');
    const ssize_t bytes = ::read(descriptor, text.data(), text.size());
    ::close(descriptor);
    text.resize(bytes > 0 ? static_cast<std::size_t>(bytes) : 0);
    text.resize(std::min(text.find('\n'), text.size()));
    std::erase_if(text, [](unsigned char c) { return c < 0x20 || c > 0x7e; });
    return text;
  }
};

}  // namespace

Kernel& system_kernel() {
  static SystemKernel kernel;
  return kernel;
}

}  // namespace tubesight::drivers::v4l2
