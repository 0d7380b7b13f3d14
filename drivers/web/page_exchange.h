#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <microhttpd.h>

#include "drivers/web/page_server.h"

namespace tubesight::drivers {

/// One request on its way through the server, and whoever answers it.
///
/// libmicrohttpd forgets a connection only when it is not suspended, so that one that waits may be
/// woken at any time; `connection_` is null from the moment it ends.
class PageExchange final : public PageCall, public PageStream {
 public:
  explicit PageExchange(MHD_Connection* connection) : connection_(connection) {}

  PageRequest request;
  bool begun = false;  ///< refuse() was asked
  bool handed_over = false;
  bool too_long = false;

  void answer(PageAnswer answer) override {
    const std::lock_guard lock(mutex_);
    if (!answer_ && !streaming_) {
      answer_ = std::move(answer);
      wake();
    }
  }

  std::shared_ptr<PageStream> stream() override {
    const std::lock_guard lock(mutex_);
    streaming_ = !answer_;
    wake();
    return {self_.lock(), this};
  }

  bool push(std::string_view text) override {
    const std::lock_guard lock(mutex_);
    if (ended_ || connection_ == nullptr || unsent_.size() + text.size() > kMostUnread) {
      ended_ = true;
      wake();
      return false;
    }
    unsent_ += text;
    wake();
    return true;
  }

  void end() override {
    const std::lock_guard lock(mutex_);
    ended_ = true;
    wake();
  }

  void know_itself(const std::shared_ptr<PageExchange>& self) { self_ = self; }

  /// Of the server's thread: waits for an answer unless there is one.
  [[nodiscard]] bool wait() {
    const std::lock_guard lock(mutex_);
    if (answer_ || streaming_) {
      return false;
    }
    suspend();
    return true;
  }

  [[nodiscard]] std::optional<PageAnswer> taken() {
    const std::lock_guard lock(mutex_);
    return answer_;
  }
  [[nodiscard]] bool streaming() {
    const std::lock_guard lock(mutex_);
    return streaming_;
  }

  /// Of the server's thread: up to `room` bytes of the stream.
  ssize_t read(char* into, std::size_t room) {
    const std::lock_guard lock(mutex_);
    if (unsent_.empty()) {
      if (ended_) {
        return MHD_CONTENT_READER_END_OF_STREAM;
      }
      suspend();
      return 0;
    }
    const std::size_t count = std::min(room, unsent_.size());
    std::memcpy(into, unsent_.data(), count);
    unsent_.erase(0, count);
    return static_cast<ssize_t>(count);
  }

  void forget_connection() {
    const std::lock_guard lock(mutex_);
    connection_ = nullptr;
    ended_ = true;
  }

  /// What a stream may have waiting before its browser counts as gone.
  static constexpr std::size_t kMostUnread = std::size_t{256} * 1024;

 private:
  void suspend() {
    suspended_ = true;
    MHD_suspend_connection(connection_);
  }
  void wake() {
    if (suspended_ && connection_ != nullptr) {
      suspended_ = false;
      MHD_resume_connection(connection_);
    }
  }

  std::mutex mutex_;
  MHD_Connection* connection_;
  std::weak_ptr<PageExchange> self_;
  std::optional<PageAnswer> answer_;
  std::string unsent_;
  bool suspended_ = false;
  bool streaming_ = false;
  bool ended_ = false;
};

/// Whom a connection comes from, without port; an IPv4 address as such. Empty: not known.
[[nodiscard]] std::string address_of(MHD_Connection* connection);

/// Whether a request says once at most, in digits alone, how long its body is. Where two readers of
/// a line could disagree on that, one request hides in another.
[[nodiscard]] bool has_one_length(MHD_Connection* connection);

/// What sends a browser the stream of its exchange; null: no memory.
[[nodiscard]] MHD_Response* make_stream(const std::shared_ptr<PageExchange>& exchange);

}  // namespace tubesight::drivers
