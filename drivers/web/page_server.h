#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "core/base/result.h"

namespace tubesight::drivers {

/// What a browser asks for.
struct PageRequest {
  std::string method;   ///< GET, POST or PUT; others never come
  std::string path;     ///< with its escapes resolved, without the query
  std::string address;  ///< the browser's, without port
  std::string host;     ///< header Host
  std::string origin;   ///< header Origin; empty: none
  std::string type;     ///< header Content-Type
  std::string cookie;   ///< the value of the server's cookie; empty: none
  std::string token;    ///< header X-Tubesight
  std::map<std::string, std::string> query;
  std::string body;
};

/// Text that goes to one browser as it comes (`text/event-stream`), until one of the two ends it.
/// Any thread.
class PageStream {
 public:
  /// Adds text. False: the browser has gone, or does not read what it is sent, and the stream is at
  /// its end.
  virtual bool push(std::string_view text) = 0;
  virtual void end() = 0;

 protected:
  ~PageStream() = default;
};

/// What it is told.
struct PageAnswer {
  unsigned status = 200;
  std::string type = "application/json";
  std::shared_ptr<const std::string> body;  ///< shared: one picture goes to many; null: empty
  std::string cookie;                       ///< a new value; empty: as it was
  bool forget_cookie = false;
  int file = -1;  ///< an open file to be sent in the body's place; closed afterwards
  std::vector<std::pair<std::string, std::string>> headers;  ///< further ones
};

/// A request that is answered later, or by a stream. Any thread.
class PageCall {
 public:
  /// Answers it, once; a second answer is dropped.
  virtual void answer(PageAnswer answer) = 0;
  /// Answers it with a stream.
  [[nodiscard]] virtual std::shared_ptr<PageStream> stream() = 0;

 protected:
  ~PageCall() = default;
};

/// Answers what browsers ask for. On the server's thread alone, which serves nobody meanwhile.
class PageHandler {
 public:
  /// Looks at a request whose body has not come yet: an answer refuses it. `body_bytes` is what the
  /// browser announces, 0 for none.
  [[nodiscard]] virtual std::optional<PageAnswer> refuse(const PageRequest& request,
                                                         std::uint64_t body_bytes) = 0;
  /// How long a body may be.
  [[nodiscard]] virtual std::size_t most_body_bytes(const PageRequest& request) const = 0;
  /// The answer; empty: `call` is kept and answered later.
  [[nodiscard]] virtual std::optional<PageAnswer> handle(const PageRequest& request,
                                                         const std::shared_ptr<PageCall>& call) = 0;

 protected:
  ~PageHandler() = default;
};

/// Where and how browsers are served.
struct PageServerSettings {
  std::string address = "127.0.0.1";  ///< IPv4 or IPv6
  std::int32_t port = 8080;           ///< 0: any that is free
  std::string certificate;            ///< PEM text; empty: no TLS
  std::string key;                    ///< PEM text
};

/// Serves browsers over HTTP, or HTTPS, by libmicrohttpd: one thread of little priority for all of
/// them, whose connections, and what each may hold in memory, are bounded.
///
/// A request that waits for its answer costs no thread. Above kMostConnections the answer is 503,
/// above a few more none.
class PageServer {
 public:
  static constexpr unsigned kMostConnections = 64;
  static constexpr unsigned kMostPerAddress = 32;
  static constexpr std::size_t kLongestPath = 200;
  static constexpr const char* kCookieName = "tubesight";

  /// `handler` outlives the server.
  explicit PageServer(PageHandler& handler);
  PageServer(const PageServer&) = delete;
  PageServer& operator=(const PageServer&) = delete;
  ~PageServer();

  /// Errors: kNotReady started already, kIo with message().
  [[nodiscard]] core::Result<void> start(const PageServerSettings& settings);
  /// Ends streams, answers what waits with 503, and closes.
  void stop();
  [[nodiscard]] const std::string& message() const { return message_; }

  /// Where it listens; valid when started.
  [[nodiscard]] std::int32_t port() const { return port_; }

 private:
  class Hub;
  std::unique_ptr<Hub> hub_;
  std::string message_;
  std::int32_t port_ = 0;
  std::thread thread_;
  std::atomic<bool> stopping_{false};
};

}  // namespace tubesight::drivers
