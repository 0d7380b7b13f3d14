#include "drivers/control/control_server.h"

#include <algorithm>
#include <array>
#include <cerrno>

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include "drivers/control/json_line.h"

namespace tubesight::drivers {
namespace {

/// What is read of a client at a time.
constexpr std::size_t kChunk = 4096;
/// Lines of one client that are answered before the next one's turn.
constexpr int kLinesATurn = 16;

std::string refusal(std::string_view why) {
  return JsonLine().add("ok", false).add("error", why).finish();
}

}  // namespace

core::Result<void> ControlServer::start(const std::string& path) {
  clients_.reserve(kMostClients);
  return socket_.open(path);
}

void ControlServer::stop() {
  for (Client& client : clients_) {
    send_waiting(client);
    if (client.fd >= 0) {
      close(client.fd);
    }
  }
  clients_.clear();
  socket_.close();
}

bool ControlServer::serve(std::chrono::milliseconds timeout, int other) {
  std::array<pollfd, kMostClients + 2> wanted{};
  const std::size_t known = clients_.size();
  bool more = false;  // lines that are here already
  for (std::size_t i = 0; i < known; ++i) {
    const Client& client = clients_[i];
    const bool room = client.received.size() <= kLongestLine && !client.leaving;
    wanted[i].events =
        static_cast<short>((room ? POLLIN : 0) | (client.unsent.empty() ? 0 : POLLOUT));
    // One that has closed and waits for an answer would be told of again and again.
    wanted[i].fd = wanted[i].events != 0 ? client.fd : -1;
    more = more || (!client.waiting && client.received.find('\n') != std::string::npos);
  }
  wanted[known] = {socket_.fd(), POLLIN, 0};
  wanted[known + 1] = {other, POLLIN, 0};
  if (poll(wanted.data(), known + 2, more ? 0 : static_cast<int>(timeout.count())) < 0) {
    return false;  // a signal; the caller comes again
  }
  for (std::size_t i = 0; i < known; ++i) {
    Client& client = clients_[i];
    if ((wanted[i].revents & (POLLIN | POLLHUP | POLLERR)) != 0) {
      receive(client);
    }
    take_lines(client);
    send_waiting(client);
  }
  drop_those_gone();
  if ((wanted[known].revents & POLLIN) != 0) {
    accept_all();
  }
  return (wanted[known + 1].revents & POLLIN) != 0;
}

void ControlServer::accept_all() {
  while (true) {
    const int fd = accept4(socket_.fd(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK);
    if (fd < 0) {
      return;
    }
    make_room();
    clients_.push_back({next_number_++, fd, {}, {}, false, false, ++activity_});
  }
}

void ControlServer::make_room() {
  if (clients_.size() < kMostClients) {
    return;
  }
  const auto silent =
      std::min_element(clients_.begin(), clients_.end(),
                       [](const Client& a, const Client& b) { return a.active_at < b.active_at; });
  send_away(*silent, "too many clients, the one silent longest makes room");
  send_waiting(*silent);
  if (silent->fd >= 0) {
    close(silent->fd);
  }
  clients_.erase(silent);
}

void ControlServer::receive(Client& client) {
  std::array<char, kChunk> bytes;
  const ssize_t got = recv(client.fd, bytes.data(), bytes.size(), 0);
  if (got > 0) {
    client.received.append(bytes.data(), static_cast<std::size_t>(got));
    client.active_at = ++activity_;
  } else if (got == 0 || (errno != EAGAIN && errno != EINTR)) {
    // What he asked before he closed is still answered.
    client.leaving = true;
  }
}

void ControlServer::take_lines(Client& client) {
  for (int i = 0; i < kLinesATurn && !client.waiting; ++i) {
    const std::size_t end = client.received.find('\n');
    if (std::min(end, client.received.size()) > kLongestLine) {
      client.received.clear();
      send_away(client, "line too long, expected at most 1024 bytes");
      return;
    }
    if (end == std::string::npos) {
      return;
    }
    std::string line = client.received.substr(0, end);
    client.received.erase(0, end + 1);
    if (!line.empty() && line.back() == '\r') {
      line.pop_back();
    }
    if (const auto answered = handler_->handle(client.number, line)) {
      queue(client, *answered);
    } else {
      client.waiting = true;
    }
  }
}

void ControlServer::answer(ControlClient client, std::string_view line) {
  const auto found = std::find_if(clients_.begin(), clients_.end(),
                                  [&](const Client& each) { return each.number == client; });
  if (found != clients_.end() && found->waiting) {
    found->waiting = false;
    queue(*found, line);
    send_waiting(*found);
  }
}

void ControlServer::queue(Client& client, std::string_view line) {
  if (client.unsent.size() + line.size() > kMostUnread) {
    client.unsent.clear();
    send_away(client, "answers are not read");
    return;
  }
  client.unsent += line;
  client.unsent += '\n';
}

void ControlServer::send_away(Client& client, std::string_view why) {
  ++sent_away_;
  client.waiting = false;
  client.leaving = true;
  client.received.clear();
  client.unsent += refusal(why) + '\n';
}

void ControlServer::send_waiting(Client& client) {
  while (!client.unsent.empty()) {
    const ssize_t sent =
        send(client.fd, client.unsent.data(), client.unsent.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent > 0) {
      client.unsent.erase(0, static_cast<std::size_t>(sent));
    } else if (errno == EINTR) {
      continue;
    } else {
      if (errno != EAGAIN) {
        client.unsent.clear();
        client.leaving = true;
        client.waiting = false;
      }
      return;
    }
  }
}

/// Who is leaving goes when he has his answers, or does not read them at once: nobody is kept for
/// somebody who may never come back.
void ControlServer::drop_those_gone() {
  for (Client& client : clients_) {
    const bool asks = client.waiting || client.received.find('\n') != std::string::npos;
    if (client.leaving && !asks) {
      close(client.fd);
      client.fd = -1;
    }
  }
  std::erase_if(clients_, [](const Client& client) { return client.fd < 0; });
}

}  // namespace tubesight::drivers
