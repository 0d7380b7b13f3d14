#include "board/bench/interruption.h"

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <system_error>
#include <thread>

#include <fcntl.h>
#include <unistd.h>

#include "drivers/files/unfinished.h"

namespace tubesight::board {
namespace {

constexpr std::array kSignals = {SIGINT, SIGTERM, SIGHUP};

/// What the handler writes to: set before the first signal is taken, and never closed.
std::atomic<int> told_descriptor{-1};

void tell_signal(int number) {
  const int before = errno;
  const auto byte = static_cast<unsigned char>(number);
  // A full pipe has told of a signal already.
  [[maybe_unused]] const ssize_t written = ::write(told_descriptor, &byte, 1);
  errno = before;
}

void end_by_signal(int descriptor) {
  unsigned char number = 0;
  while (::read(descriptor, &number, 1) != 1) {
  }
  drivers::remove_unfinished_for_good();
  std::fputs("tubesight: interrupted, what was not whole is removed\n", stderr);
  std::signal(number, SIG_DFL);
  std::raise(number);
}

}  // namespace

void remove_unfinished_when_interrupted() {
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    return;
  }
  try {
    std::thread(end_by_signal, ends[0]).detach();
  } catch (const std::system_error&) {
    ::close(ends[0]);
    ::close(ends[1]);
    return;
  }
  told_descriptor = ends[1];
  for (const int number : kSignals) {
    struct sigaction action {};
    if (::sigaction(number, nullptr, &action) == 0 && action.sa_handler == SIG_IGN) {
      continue;
    }
    action = {};
    action.sa_handler = tell_signal;
    action.sa_flags = SA_RESTART;
    ::sigaction(number, &action, nullptr);
  }
}

}  // namespace tubesight::board
