#pragma once

#include <cstdint>
#include <string>

#include "core/base/result.h"

namespace tubesight::drivers {

/// Where masters of Modbus TCP come in; libmodbus opens it. One thread.
class TcpListener {
 public:
  TcpListener() = default;
  TcpListener(const TcpListener&) = delete;
  TcpListener& operator=(const TcpListener&) = delete;
  ~TcpListener() { close(); }

  /// Listens at an address of this machine; port 0 takes any that is free. kIo: it cannot.
  [[nodiscard]] core::Result<void> open(const std::string& address, std::int32_t port);
  void close();

  /// For poll(); -1: closed.
  [[nodiscard]] int descriptor() const { return descriptor_; }
  /// The port that it listens at.
  [[nodiscard]] std::int32_t port() const;
  /// A master that has come in, as a descriptor that does not wait; -1: none.
  [[nodiscard]] int accept();

 private:
  void* context_ = nullptr;  ///< of libmodbus
  int descriptor_ = -1;
};

}  // namespace tubesight::drivers
