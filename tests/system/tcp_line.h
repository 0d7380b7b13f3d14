#pragma once

#include <string>

#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

namespace tubesight::tests {

/// A port that nobody listens at just now.
inline int free_port() {
  const int descriptor = socket(AF_INET, SOCK_STREAM, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  EXPECT_EQ(bind(descriptor, reinterpret_cast<sockaddr*>(&address), size), 0);
  EXPECT_EQ(getsockname(descriptor, reinterpret_cast<sockaddr*>(&address), &size), 0);
  close(descriptor);
  return ntohs(address.sin_port);
}

/// The settings of a link there, and how a master calls it.
inline std::string tcp_link(int port) {
  return "[link]\nkind = \"modbus\"\ntcp_port = " + std::to_string(port) + "\n";
}
inline std::string address(int port) { return "127.0.0.1:" + std::to_string(port); }

}  // namespace tubesight::tests
