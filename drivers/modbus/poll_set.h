#pragma once

#include <cstddef>
#include <cstdint>

#include <poll.h>

#include "core/base/static_vector.h"

namespace tubesight::drivers {

/// What a thread waits for. One thread; no heap.
class PollSet {
 public:
  void clear() { entries_.clear(); }

  /// Adds a descriptor to be read; below 0: nothing. There is room for all of a link.
  void add(int descriptor) {
    if (descriptor >= 0) {
      static_cast<void>(entries_.try_push_back({descriptor, POLLIN, 0}));
    }
  }

  /// Waits until one of them has something.
  void wait() {
    if (poll(entries_.begin(), static_cast<nfds_t>(entries_.size()), -1) < 0) {
      for (pollfd& entry : entries_) {
        entry.revents = 0;
      }
    }
  }

  [[nodiscard]] bool readable(int descriptor) const {
    return (events_of(descriptor) & POLLIN) != 0;
  }
  /// The device behind it is gone.
  [[nodiscard]] bool gone(int descriptor) const {
    return (events_of(descriptor) & (POLLHUP | POLLERR | POLLNVAL)) != 0;
  }

 private:
  [[nodiscard]] int events_of(int descriptor) const {
    for (const pollfd& entry : entries_) {
      if (entry.fd == descriptor) {
        return entry.revents;
      }
    }
    return 0;
  }

  core::StaticVector<pollfd, 32> entries_;
};

}  // namespace tubesight::drivers
