#include "board/visionbox/real_time.h"

#include <array>
#include <cerrno>
#include <cstddef>
#include <cstring>

#include <pthread.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

namespace tubesight::board {
namespace {

/// The tracking path's frames stay below 16 KiB, all in all (tests/checks/stack.py); the rest is
/// for what stands around it.
constexpr std::size_t kStackTouched = 128 * 1024;
constexpr std::size_t kPage = 4096;

}  // namespace

std::string lock_all_memory() {
  // Within a limit, a lock on memory to come would later turn an allocation into a failure. Root
  // has none whatever the number says.
  rlimit limit{};
  const rlimit all{RLIM_INFINITY, RLIM_INFINITY};
  if (geteuid() != 0 && setrlimit(RLIMIT_MEMLOCK, &all) != 0 &&
      (getrlimit(RLIMIT_MEMLOCK, &limit) != 0 || limit.rlim_cur != RLIM_INFINITY)) {
    return "the limit of locked memory is too small (RLIMIT_MEMLOCK), expected none";
  }
  if (mlockall(MCL_CURRENT | MCL_FUTURE) != 0) {
    return std::strerror(errno);
  }
  return {};
}

std::string schedule_in_real_time(std::int32_t priority) {
  sched_param wanted{};
  wanted.sched_priority = priority;
  const int status = pthread_setschedparam(pthread_self(), SCHED_FIFO, &wanted);
  return status == 0 ? std::string() : std::strerror(status);
}

std::string schedule_before_others() {
  constexpr int kNice = -15;
  const int status = setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kNice);
  return status == 0 ? std::string() : std::strerror(errno);
}

void schedule_behind_others() {
  constexpr int kNice = 10;
  static_cast<void>(setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kNice));
}

void name_this_thread(const char* name) {
  static_cast<void>(pthread_setname_np(pthread_self(), name));
}

[[gnu::noinline]] void touch_stack() {
  std::array<unsigned char, kStackTouched> stack;
  volatile unsigned char* const bytes = stack.data();
  for (std::size_t i = 0; i < kStackTouched; i += kPage) {
    bytes[i] = 0;
  }
}

}  // namespace tubesight::board
