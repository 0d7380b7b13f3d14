#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "board/visionbox/page_json.h"
#include "drivers/web/page_server.h"

namespace tubesight::board {

/// Browsers that hear what happens, as events of a stream; whoever does not read is left out.
/// Guarded by the caller.
class PageListeners {
 public:
  static constexpr std::size_t kMost = 16;

  /// What is told to the session of a cookie.
  using Words = std::function<std::string(const std::string& cookie)>;
  using Ended = std::function<bool(const std::string& cookie)>;

  [[nodiscard]] bool full() const { return listeners_.size() >= kMost; }
  [[nodiscard]] bool empty() const { return listeners_.empty(); }
  void add(std::shared_ptr<drivers::PageStream> stream, const std::string& cookie) {
    listeners_.push_back({std::move(stream), cookie});
    listeners_.back().stream->push("retry: 2000\n\n");
  }

  void tell_all(std::string_view event, const std::string& data) {
    tell_each(event, [&data](const std::string& /*cookie*/) { return data; });
  }
  /// `data` may differ from one to the other.
  void tell_each(std::string_view event, const Words& data) {
    std::erase_if(listeners_, [&](const Listener& each) {
      return !each.stream->push("event: " + std::string(event) + "\ndata: " + data(each.cookie) +
                                "\n\n");
    });
  }
  /// A line that says nothing: whoever is gone is noticed, and the browser that the box is there.
  void beat() {
    std::erase_if(listeners_,
                  [](const Listener& each) { return !each.stream->push(": beat\n\n"); });
  }
  /// Ends the streams of sessions that have ended.
  void drop(const Ended& ended) {
    std::erase_if(listeners_, [&](const Listener& each) {
      const bool gone = ended(each.cookie);
      if (gone) {
        each.stream->end();
      }
      return gone;
    });
  }

 private:
  struct Listener {
    std::shared_ptr<drivers::PageStream> stream;
    std::string cookie;
  };
  std::vector<Listener> listeners_;
};

}  // namespace tubesight::board
