#include "drivers/modbus/tcp_listener.h"

#include <fcntl.h>
#include <modbus/modbus.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace tubesight::drivers {
namespace {

using core::Error;
using core::Result;
using core::Unexpected;

bool stop_waiting(int descriptor) {
  const int flags = fcntl(descriptor, F_GETFL);
  return flags >= 0 && fcntl(descriptor, F_SETFL, flags | O_NONBLOCK) == 0;
}

}  // namespace

Result<void> TcpListener::open(const std::string& address, std::int32_t port) {
  modbus_t* const context = modbus_new_tcp(address.c_str(), port);
  if (context == nullptr) {
    return Unexpected(Error::kIo);
  }
  constexpr int kWaitingMasters = 4;
  context_ = context;
  descriptor_ = modbus_tcp_listen(context, kWaitingMasters);
  if (descriptor_ < 0 || !stop_waiting(descriptor_)) {
    close();
    return Unexpected(Error::kIo);
  }
  return {};
}

void TcpListener::close() {
  if (descriptor_ >= 0) {
    ::close(descriptor_);
  }
  descriptor_ = -1;
  if (context_ != nullptr) {
    modbus_free(static_cast<modbus_t*>(context_));
    context_ = nullptr;
  }
}

std::int32_t TcpListener::port() const {
  sockaddr_in address{};
  socklen_t size = sizeof address;
  if (getsockname(descriptor_, reinterpret_cast<sockaddr*>(&address), &size) != 0) {
    return 0;
  }
  return ntohs(address.sin_port);
}

int TcpListener::accept() {
  const int master = ::accept(descriptor_, nullptr, nullptr);
  if (master < 0) {
    return -1;
  }
  const int on = 1;
  static_cast<void>(setsockopt(master, SOL_SOCKET, SO_KEEPALIVE, &on, sizeof on));
  if (!stop_waiting(master)) {
    ::close(master);
    return -1;
  }
  return master;
}

}  // namespace tubesight::drivers
