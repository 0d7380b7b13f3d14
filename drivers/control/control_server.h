#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "drivers/control/control_socket.h"

namespace tubesight::drivers {

/// Which client asked; never used twice.
using ControlClient = std::int64_t;

/// Answers what clients of a control socket ask.
class ControlHandler {
 public:
  /// The answer to a line, without a line feed; empty: it comes later, by ControlServer::answer().
  [[nodiscard]] virtual std::optional<std::string> handle(ControlClient client,
                                                          std::string_view line) = 0;

 protected:
  ~ControlHandler() = default;
};

/// Serves clients of a control socket: lines in, one line out for each, in their order.
///
/// Clients are bounded in number, in the length of a line and in what waits to be read by them;
/// whoever exceeds it is told where possible and sent away. When all places are taken, the client
/// that has been silent longest makes room. Nobody waits for a client. One thread.
class ControlServer {
 public:
  static constexpr std::size_t kMostClients = 16;
  static constexpr std::size_t kLongestLine = 1024;
  static constexpr std::size_t kMostUnread = 64 * 1024;

  /// `handler` outlives the server.
  explicit ControlServer(ControlHandler& handler) : handler_(&handler) {}
  ControlServer(const ControlServer&) = delete;
  ControlServer& operator=(const ControlServer&) = delete;
  ~ControlServer() { stop(); }

  /// Errors as ControlSocket::open(), with message().
  [[nodiscard]] core::Result<void> start(const std::string& path);
  void stop();
  [[nodiscard]] const std::string& message() const { return socket_.message(); }

  /// Serves whoever wants something, waiting for it at most `timeout`, or until `other` (a
  /// descriptor, -1: none) can be read; says whether that was so.
  bool serve(std::chrono::milliseconds timeout, int other = -1);

  /// The answer to a client whose line waits for one; nothing happens when he has gone.
  void answer(ControlClient client, std::string_view line);

  [[nodiscard]] std::size_t clients() const { return clients_.size(); }
  /// Clients sent away, for a line too long or for not reading, or to make room.
  [[nodiscard]] std::int64_t sent_away() const { return sent_away_; }

 private:
  struct Client {
    ControlClient number = 0;
    int fd = -1;
    std::string received;
    std::string unsent;
    bool waiting = false;        ///< for an answer() to his last line
    bool leaving = false;        ///< goes when all is sent: he closed, or was sent away
    std::int64_t active_at = 0;  ///< counts what clients did
  };

  void accept_all();
  void make_room();
  void receive(Client& client);
  void take_lines(Client& client);
  void queue(Client& client, std::string_view line);
  void send_away(Client& client, std::string_view why);
  void send_waiting(Client& client);
  void drop_those_gone();

  ControlHandler* handler_;
  ControlSocket socket_;
  std::vector<Client> clients_;
  ControlClient next_number_ = 1;
  std::int64_t activity_ = 0;
  std::int64_t sent_away_ = 0;
};

}  // namespace tubesight::drivers
